//! What rays meet: this frame's traced draws as instances of meshes.
//!
//! A draw of a retained range is a mesh of its own, built once; so is a block of remembered ones. Other draws change, or are sent anew with every
//! frame: those that share a matrix are one mesh, built again when any of them has changed.

use afterglow_gl::frame::{Draw, Frame, VertexSource};
use afterglow_gpu::{Gpu, GpuError};
use afterglow_records::{MASK_STATIC, MEMBER_OF_LIGHTS, MEMBER_SHIFT, MeshMember};
use glam::{DMat3, DVec3, Mat4, Vec3};
use hashbrown::HashMap;
use xxhash_rust::xxh3::{Xxh3, xxh3_64_with_seed};

use super::anchors::{Anchor, Reach};
use super::backend::Backend;
use super::geometry::{GeometryReader, Triangles};
use super::lights::{Lamps, LightList};
use super::structures::{Member, MeshInput, Placed, Shapes, Structures, TopLevel};
use crate::uploads::UploadArena;

/// Triangles of a member, and members of a mesh, that a hit's primitive can name.
const MOST_TRIANGLES: u32 = 1 << MEMBER_SHIFT;
const MOST_MEMBERS: usize = 1 << (32 - MEMBER_SHIFT);

/// Seed of the hash of lamps: no draw has the same.
const LAMPS: u64 = 0x6c61_6d70;

/// A traced draw.
#[derive(Debug, Clone)]
pub(crate) struct Traced<'a> {
    /// Its number among the frame's surfaces.
    pub(crate) surface: u32,
    pub(crate) draw: &'a Draw,
    pub(crate) triangles: Triangles,
    pub(crate) model: Mat4,
    /// What rays meet it; 0 if none do.
    pub(crate) mask: u8,
    pub(crate) is_alpha_tested: bool,
    /// Draws of ranges with the same number are one mesh: they come and go together.
    pub(crate) block: Option<u32>,
}

/// The top level on the device, and what its hits are numbered by.
#[derive(Debug, Clone, Default)]
pub(crate) struct World {
    pub(crate) top_level: u64,
    pub(crate) members: Vec<MeshMember>,
    pub(crate) instances: u32,
    /// Meshes that rays miss because they are still being built.
    pub(crate) waiting: usize,
    /// Whether rays may meet spheres.
    pub(crate) has_spheres: bool,
    /// The longest side of its box.
    pub(crate) extent: f32,
}

/// Draws that make one mesh.
struct Group {
    model: Mat4,
    mask: u8,
    is_lasting: bool,
    /// Numbers among the traced draws.
    draws: Vec<usize>,
    members: usize,
    reach: Reach,
    /// The matrix cannot be undone, so that rays have no place in object space: the mesh is built in the world.
    is_flat: bool,
}

impl Group {
    /// From where the mesh is built to the world.
    fn placing(&self) -> Mat4 {
        if self.is_flat { Mat4::IDENTITY } else { self.model }
    }

    fn triangles(&self, traced: &[Traced<'_>]) -> usize {
        self.draws.iter().map(|&draw| traced[draw].triangles.count as usize).sum()
    }

    fn anchor(&self) -> Anchor {
        if self.is_flat { Anchor::ORIGIN } else { Anchor::of(self.reach) }
    }
}

/// What groups are found by: the matrix's bits, the mask, the block.
type GroupKey = ([u32; 16], u8, Option<u32>);

/// Keeps meshes from frame to frame.
pub(crate) struct WorldBuilder {
    structures: Structures,
    pub(crate) geometry: GeometryReader,
    /// Of each traced draw of the frame that was built: `SurfaceDraw::reach`.
    pub(crate) reaches: Vec<f32>,
}

impl WorldBuilder {
    /// `waits`: frames wait for the structures that they need.
    ///
    /// # Errors
    /// If the device lacks the backend.
    pub(crate) fn new(gpu: &Gpu, backend: Backend, waits: bool) -> Result<Self, GpuError> {
        Ok(Self {
            structures: Structures::new(gpu, backend, waits)?,
            geometry: GeometryReader::default(),
            reaches: Vec::new(),
        })
    }

    pub(crate) fn begin_frame(&mut self, arena: &mut UploadArena) -> Result<(), GpuError> {
        self.geometry.begin_frame();
        self.structures.begin_frame(arena)
    }

    pub(crate) fn structures(&self) -> &Structures {
        &self.structures
    }

    /// Builds the world as seen from `origin`, in world space.
    pub(crate) fn build(
        &mut self,
        frame: &Frame,
        traced: &[Traced<'_>],
        lights: &LightList,
        origin: DVec3,
        arena: &mut UploadArena,
    ) -> Result<World, GpuError> {
        let groups: Vec<_> =
            groups(traced).into_iter().map(|group| (content_of(&group, traced), group)).collect();
        // What is there is taken first: the rest may be made of what is not.
        for (content, _) in &groups {
            self.structures.take(*content);
        }
        let mut members = Vec::new();
        let mut placed = Vec::new();
        let mut waiting = 0;
        self.reaches.clear();
        self.reaches.resize(traced.len(), f32::INFINITY);
        for (content, group) in &groups {
            let anchor = group.anchor();
            group.draws.iter().for_each(|&draw| self.reaches[draw] = anchor.reach);
            let has_room = || !group.is_lasting || self.structures.has_room(group.triangles(traced));
            if !self.structures.has(*content) && has_room() {
                self.build_mesh(frame, group, traced, *content, arena)?;
            }
            waiting += usize::from(self.structures.is_waiting(*content));
            if self.structures.take(*content) {
                placed.push(Placed {
                    content: *content,
                    object_to_world: anchored(&group.placing(), anchor.place, origin),
                    id: members.len() as u32,
                    mask: group.mask,
                });
                members.extend(group.draws.iter().flat_map(|&draw| members_of(&traced[draw])));
            }
        }
        let lamps = self.lamps(&lights.lamps, origin, members.len(), arena)?;
        let has_spheres = lamps.is_some();
        if let Some(lamps) = lamps {
            placed.push(lamps);
            let first = lights.lamps.first_light as u32;
            members.push(MeshMember { draw: MEMBER_OF_LIGHTS | first, first_triangle: 0 });
        }
        let top = self.structures.top_level(&placed, arena)?;
        let TopLevel { address: top_level, instances, extent } = top;
        Ok(World { top_level, members, instances, waiting, has_spheres, extent })
    }

    fn build_mesh(
        &mut self,
        frame: &Frame,
        group: &Group,
        traced: &[Traced<'_>],
        content: u64,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        let mut corners = Vec::new();
        let mut members = Vec::new();
        for &index in &group.draws {
            let traced = &traced[index];
            let mut range = traced.triangles.corners.clone();
            if range.is_empty() {
                range = self.geometry.corners(frame, traced.draw);
            }
            corners.extend_from_slice(&self.geometry.corners[range]);
            members.extend(members_of(traced).map(|member| Member {
                triangles: MOST_TRIANGLES.min(traced.triangles.count - member.first_triangle),
                is_alpha_tested: traced.is_alpha_tested,
            }));
        }
        if group.is_flat {
            let model = group.model.as_dmat4();
            let placed = |corner: &[f32; 3]| model.transform_point3(Vec3::from(*corner).as_dvec3()).as_vec3();
            corners.iter_mut().for_each(|corner| *corner = placed(corner).to_array());
        }
        group.anchor().subtract_from(&mut corners);
        let shapes = Shapes::Triangles { corners: &corners, members: &members };
        self.structures.build(content, &MeshInput { shapes, is_lasting: group.is_lasting }, arena)
    }

    /// The lights that are spheres, as one instance; `member` is the number of what its hits name.
    fn lamps(
        &mut self,
        lamps: &Lamps,
        origin: DVec3,
        member: usize,
        arena: &mut UploadArena,
    ) -> Result<Option<Placed>, GpuError> {
        if lamps.spheres.is_empty() || lamps.spheres.len() > MOST_TRIANGLES as usize {
            return Ok(None);
        }
        let content = xxh3_64_with_seed(bytemuck::cast_slice(&lamps.spheres), LAMPS);
        if !self.structures.has(content) {
            let input = MeshInput { shapes: Shapes::Spheres(&lamps.spheres), is_lasting: true };
            self.structures.build(content, &input, arena)?;
        }
        Ok(self.structures.take(content).then(|| Placed {
            content,
            object_to_world: relative(&Mat4::IDENTITY, origin - lamps.anchor),
            id: member as u32,
            mask: MASK_STATIC as u8,
        }))
    }
}

/// A model matrix, its translation relative to `origin`: rows of a 3x4 matrix.
pub(crate) fn relative(model: &Mat4, origin: DVec3) -> [[f32; 4]; 3] {
    let translation = model.w_axis.truncate().as_dvec3() - origin;
    std::array::from_fn(|row| {
        let linear = model.row(row).truncate();
        [linear.x, linear.y, linear.z, translation[row] as f32]
    })
}

/// The same for corners that are relative to a place in object space.
fn anchored(model: &Mat4, place: Vec3, origin: DVec3) -> [[f32; 4]; 3] {
    if place == Vec3::ZERO {
        return relative(model, origin);
    }
    let translation = model.as_dmat4().transform_point3(place.as_dvec3()) - origin;
    let mut rows = relative(model, origin);
    rows.iter_mut().zip(translation.to_array()).for_each(|(row, along)| row[3] = along as f32);
    rows
}

fn groups(traced: &[Traced<'_>]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut open: HashMap<GroupKey, usize> = HashMap::new();
    for (index, traced) in traced.iter().enumerate() {
        let members = member_count(traced);
        if traced.triangles.count == 0 || members > MOST_MEMBERS || traced.mask == 0 {
            continue;
        }
        let new = Group {
            model: traced.model,
            mask: traced.mask,
            is_lasting: matches!(traced.draw.source, VertexSource::Retained { .. }),
            draws: vec![index],
            members,
            reach: traced.triangles.reach,
            is_flat: is_flat(&traced.model),
        };
        if new.is_lasting && traced.block.is_none() {
            groups.push(new);
            continue;
        }
        let key = (traced.model.to_cols_array().map(f32::to_bits), traced.mask, traced.block);
        match open.get(&key).map(|&group| &mut groups[group]) {
            Some(group) if group.members + members <= MOST_MEMBERS => {
                group.draws.push(index);
                group.members += members;
                group.reach = group.reach.union(traced.triangles.reach);
            }
            _ => {
                open.insert(key, groups.len());
                groups.push(new);
            }
        }
    }
    groups
}

/// Whether a matrix makes flat what is not, as far as f32 can tell.
fn is_flat(model: &Mat4) -> bool {
    const LEAST_VOLUME: f64 = 1e-6;
    let linear = DMat3::from_mat4(model.as_dmat4());
    let sides: f64 = [linear.x_axis, linear.y_axis, linear.z_axis].iter().map(|side| side.length()).product();
    // False where these are no numbers.
    let is_solid = linear.determinant().abs() > LEAST_VOLUME * sides;
    !is_solid
}

/// What a mesh is made of: its draws' triangles in order.
fn content_of(group: &Group, traced: &[Traced<'_>]) -> u64 {
    let mut hasher = Xxh3::new();
    if group.is_flat {
        hasher.update(bytemuck::bytes_of(&group.model.to_cols_array()));
    }
    for &index in &group.draws {
        let traced = &traced[index];
        hasher.update(&traced.triangles.hash.to_le_bytes());
        hasher.update(&traced.triangles.count.to_le_bytes());
        hasher.update(&[u8::from(traced.is_alpha_tested)]);
    }
    hasher.digest()
}

fn member_count(traced: &Traced<'_>) -> usize {
    traced.triangles.count.div_ceil(MOST_TRIANGLES) as usize
}

fn members_of(traced: &Traced<'_>) -> impl Iterator<Item = MeshMember> + use<> {
    let surface = traced.surface;
    (0..member_count(traced) as u32)
        .map(move |member| MeshMember { draw: surface, first_triangle: member * MOST_TRIANGLES })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{FrameBuilder, RED, gpu};
    use afterglow_gl::frame::{Format, Operation, RetainedRange, Slot, VertexLayout};
    use std::time::{Duration, Instant};

    /// Two draws under one matrix and one under another, as a frame.
    fn frame(z: f32) -> Frame {
        let mut builder = FrameBuilder::new(8, 8);
        builder.fill(0.0, RED).fill(z, RED).fill(0.5, RED);
        builder.frame
    }

    fn world(builder: &mut WorldBuilder, frame: &Frame) -> (World, usize) {
        let draws: Vec<_> = frame.draws().map(|(_, draw)| *draw).collect();
        let world = world_of(builder, frame, &draws);
        (world, builder.structures().built())
    }

    fn world_of(builder: &mut WorldBuilder, frame: &Frame, draws: &[Draw]) -> World {
        let mut arena = UploadArena::new(&gpu());
        builder.begin_frame(&mut arena).unwrap();
        let traced: Vec<_> = draws
            .iter()
            .enumerate()
            .map(|(number, draw)| Traced {
                surface: number as u32,
                draw,
                triangles: builder.geometry.read(frame, draw),
                model: match number {
                    2 => Mat4::from_scale(glam::Vec3::splat(2.0)),
                    _ => Mat4::IDENTITY,
                },
                mask: 1,
                is_alpha_tested: false,
                block: None,
            })
            .collect();
        builder.build(frame, &traced, &LightList::default(), DVec3::ZERO, &mut arena).unwrap()
    }

    #[test]
    fn draws_of_one_matrix_are_one_mesh_that_is_built_when_it_changes() {
        let mut builder = WorldBuilder::new(&gpu(), Backend::Software, true).unwrap();
        let (first, built) = world(&mut builder, &frame(0.25));
        assert_eq!((first.instances, built), (2, 6));
        assert_eq!(world(&mut builder, &frame(0.25)).1, 0);
        assert_eq!(world(&mut builder, &frame(0.75)).1, 4);
    }

    /// A level of so many triangles, as one retained range.
    fn level(triangles: u32) -> Frame {
        let layout = VertexLayout::default().with(Slot::Position as usize, Format::F3);
        let side = triangles.isqrt() as f32;
        let corner = |vertex: u32| {
            let (triangle, corner) = (vertex / 3, vertex % 3);
            let place = [triangle as f32 % side, (triangle as f32 / side).floor()];
            [
                place[0] + (corner == 1) as u32 as f32,
                place[1] + (corner == 2) as u32 as f32,
                (place[0] * 0.3).sin(),
            ]
        };
        let words = (0..3 * triangles).flat_map(corner).map(f32::to_bits).collect();
        let range = RetainedRange::new(layout, words, (0..3 * triangles).collect());
        let mut builder = FrameBuilder::new(8, 8);
        let mut draw = builder.state();
        (draw.layout, draw.index_count) = (layout, 3 * triangles);
        builder.frame.retained.push(range.into());
        builder.push(Operation::Draw(draw));
        builder.frame
    }

    /// Brings levels into the world frame by frame until all are there. Returns the longest frame's milliseconds, and how
    /// many instances each had.
    fn bring(levels: &[Frame], waits: bool) -> (f64, Vec<u32>) {
        let mut builder = WorldBuilder::new(&gpu(), Backend::Software, waits).unwrap();
        let (mut longest, mut instances) = (0.0, Vec::new());
        let begun = Instant::now();
        let mut waiting = 1;
        while waiting > 0 {
            assert!(begun.elapsed() < Duration::from_secs(300));
            let frame_begun = Instant::now();
            let retained = levels.iter().flat_map(|level| level.retained.clone()).collect();
            let all = Frame { retained, ..Frame::default() };
            let mut draws: Vec<_> = levels.iter().map(|level| *level.draws().next().unwrap().1).collect();
            for (number, draw) in draws.iter_mut().enumerate() {
                draw.source = VertexSource::Retained { range: number as u32, first_index: 0 };
            }
            let world = world_of(&mut builder, &all, &draws);
            longest = f64::max(longest, frame_begun.elapsed().as_secs_f64() * 1e3);
            instances.push(world.instances);
            waiting = world.waiting;
            std::thread::sleep(Duration::from_millis(5));
        }
        (longest, instances)
    }

    #[test]
    fn a_new_level_does_not_hold_a_frame_up() {
        let levels = [level(300_000), level(30)];
        let ((stalled, waited), (longest, brought)) = (bring(&levels, true), bring(&levels, false));
        println!(
            "the longest frame: {stalled:.1} ms waiting for a level of 300,000 triangles, {longest:.1} ms not"
        );
        assert_eq!(waited, [2]);
        // What is small is there at once.
        assert_eq!((brought[0], *brought.last().unwrap()), (1, 2));
        assert!(longest < 0.8 * stalled);
    }

    #[test]
    fn flat_is_what_cannot_be_undone() {
        for flat in [glam::Vec3::new(1.0, 0.0, 1.0), glam::Vec3::ZERO, glam::Vec3::NAN] {
            assert!(is_flat(&Mat4::from_scale(flat)), "{flat}");
        }
        for solid in [glam::Vec3::new(1e3, 1e-3, 1.0), glam::Vec3::splat(-1e-10), glam::Vec3::splat(1e10)] {
            assert!(!is_flat(&Mat4::from_scale(solid)), "{solid}");
        }
    }

    #[test]
    fn translations_are_relative_to_the_origin() {
        let model = Mat4::from_translation(glam::Vec3::new(1e6, 2.0, 3.0));
        let rows = relative(&model, DVec3::new(1e6 - 0.25, 0.0, 0.0));
        assert_eq!(rows[0], [1.0, 0.0, 0.0, 0.25]);
        assert_eq!(rows[2], [0.0, 0.0, 1.0, 3.0]);
    }
}
