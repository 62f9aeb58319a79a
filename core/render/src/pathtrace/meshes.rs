//! Structures of the software backend: bottom levels on the device, found by their content, and a top level a frame.
//! Where a mesh that does not last is gone and another has the same triangles in the same order, only moved, its structure
//! moves with them.
//!
//! What lasts is built by another thread where frames do not wait for it: until it comes, rays pass through it. So that little
//! is missing for long, a few small meshes a frame are built at once, and small ones come before large ones.

use afterglow_bvh::layout::FLAG_ALPHA_TESTED;
use afterglow_bvh::{
    Aabb, Blas, BlasInput, Instance, Quality, TriangleAttributes, build_blas_with, build_tlas,
};
use afterglow_gpu::{Commands, Gpu, GpuError};
use afterglow_records::MEMBER_SHIFT;
use hashbrown::hash_map::Entry;
use hashbrown::{HashMap, HashSet};

use super::background::{Background, Finished, Order};
use super::refit::Movable;
use super::slabs::Part;
use super::staging::Staging;
use super::structures::{Builder, Changing, Member, MeshInput, Placed, Shapes, TopLevel, longest_side};
use crate::uploads::UploadArena;

/// Bytes of a slab.
const SLAB_BYTES: u64 = 16 << 20;
/// Meshes of more triangles are built fast where frames wait for them.
const MOST_IMPROVED: usize = 20_000;
/// Triangles that a frame builds at once where it does not wait for others: about a millisecond's.
const MOST_AT_ONCE: usize = 2_000;

/// A bottom level on the device.
struct Mesh {
    part: Part,
    bounds: Aabb,
    /// Of meshes that do not last: the structure.
    movable: Option<Movable>,
}

/// All meshes that rays can meet, and the copies that this frame's new structures need.
pub(crate) struct Meshes {
    staging: Staging,
    meshes: HashMap<u64, Mesh>,
    /// None if frames wait for all that they need.
    background: Option<Background>,
    /// Meshes that are still being built.
    waiting: HashSet<u64>,
    /// Triangles of lasting meshes that this frame has built at once.
    at_once: usize,
}

impl Meshes {
    /// `waits`: frames wait for all that they need.
    pub(crate) fn new(gpu: &Gpu, waits: bool) -> Self {
        let build = |order: &Order, quality| of_triangles(&order.corners, &order.members, quality);
        Self {
            staging: Staging::new(gpu, "meshes", SLAB_BYTES),
            meshes: HashMap::new(),
            background: (!waits).then(|| Background::new(build)),
            waiting: HashSet::new(),
            at_once: 0,
        }
    }

    fn insert(&mut self, content: u64, blas: &Blas, arena: &mut UploadArena) -> Result<&mut Mesh, GpuError> {
        let part = self.staging.bring(bytemuck::cast_slice(&blas.words), arena)?;
        let mesh = Mesh { part, bounds: blas.bounds, movable: None };
        let entry = self.meshes.entry(content);
        if let Entry::Occupied(former) = &entry {
            self.staging.free(former.get().part.clone());
        }
        Ok(entry.insert(mesh).into_mut())
    }

    /// Builds a mesh that lasts.
    fn build_lasting(
        &mut self,
        content: u64,
        corners: &[[f32; 3]],
        members: &[Member],
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        let triangles = corners.len() / 3;
        let is_small = triangles <= MOST_IMPROVED;
        let mut quality = if is_small { Quality::Good } else { Quality::Fast };
        if let Some(background) = &mut self.background {
            let is_built = self.at_once + triangles <= MOST_AT_ONCE;
            let (corners, members) = (corners.to_vec(), members.to_vec());
            if background.ask(Order { content, corners, members, is_built }).is_ok() {
                quality = Quality::Fast;
                if !is_built {
                    self.waiting.insert(content);
                    return Ok(());
                }
                self.at_once += triangles;
            }
        }
        let blas = of_triangles(corners, members, quality);
        blas.map_or(Ok(()), |blas| self.insert(content, &blas, arena).map(|_| ()))
    }

    /// Takes what was built meanwhile.
    fn take_finished(&mut self, arena: &mut UploadArena) -> Result<(), GpuError> {
        let finished = self.background.as_mut().map(Background::take).unwrap_or_default();
        for Finished { content, blas } in finished {
            let is_needed = self.waiting.remove(&content) || self.meshes.contains_key(&content);
            if let Some(blas) = blas.filter(|_| is_needed) {
                self.insert(content, &blas, arena)?;
            }
        }
        Ok(())
    }

    /// Takes the structure of a mesh that becomes another one.
    fn take(&mut self, content: u64) -> Option<Movable> {
        let mesh = self.meshes.remove(&content)?;
        self.staging.free(mesh.part);
        mesh.movable
    }
}

impl Builder for Meshes {
    fn begin_frame(&mut self, arena: &mut UploadArena) -> Result<(), GpuError> {
        self.staging.begin_frame();
        self.at_once = 0;
        self.take_finished(arena)
    }

    fn has_room(&self, triangles: usize) -> bool {
        self.background.as_ref().is_none_or(|background| background.has_room(triangles))
    }

    fn build(
        &mut self,
        content: u64,
        input: &MeshInput<'_>,
        changing: Option<&Changing<'_>>,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        match input.shapes {
            Shapes::Spheres(spheres) => {
                let blas = built(&BlasInput { spheres, ..BlasInput::default() }, Quality::Fast);
                blas.map_or(Ok(()), |blas| self.insert(content, &blas, arena).map(|_| ()))
            }
            Shapes::Triangles { corners, members } if input.is_lasting => {
                self.build_lasting(content, corners, members, arena)
            }
            Shapes::Triangles { corners, members } => {
                let former = changing.and_then(|changing| self.take(changing.former?));
                let anew = || of_triangles(corners, members, Quality::Fast).map(Movable::new);
                let moved = former.and_then(|former| former.moved(corners, members));
                let Some(movable) = moved.or_else(anew) else { return Ok(()) };
                let mesh = self.insert(content, &movable.blas, arena)?;
                mesh.movable = Some(movable);
                Ok(())
            }
        }
    }

    fn is_met(&self, content: u64) -> bool {
        self.meshes.contains_key(&content)
    }

    fn is_waiting(&self, content: u64) -> bool {
        self.waiting.contains(&content)
    }

    fn free(&mut self, content: u64) {
        self.take(content);
        self.waiting.remove(&content);
        if let Some(background) = &mut self.background {
            background.cancel(content);
        }
    }

    fn top_level(&mut self, placed: &[Placed], arena: &mut UploadArena) -> Result<TopLevel, GpuError> {
        let instance = |placed: &Placed| {
            let mesh = self.meshes.get(&placed.content)?;
            Some(Instance {
                object_to_world: placed.object_to_world,
                blas: mesh.part.address,
                bounds: mesh.bounds,
                id: placed.id,
                mask: placed.mask,
                flags: 0,
            })
        };
        let instances: Vec<_> = placed.iter().filter_map(instance).collect();
        let tlas = build_tlas(&instances).unwrap_or_else(|error| {
            tracing::warn!("rays meet nothing: {error}");
            build_tlas(&[]).unwrap_or_else(|_| unreachable!("no instances are not too many"))
        });
        Ok(TopLevel {
            address: self.staging.bring_once(bytemuck::cast_slice(&tlas.words), arena)?,
            instances: tlas.instance_count,
            extent: longest_side(&tlas.bounds),
        })
    }

    fn has_work(&self) -> bool {
        self.staging.has_work()
    }

    fn record(&self, commands: &Commands<'_>) {
        self.staging.record(commands);
    }
}

/// A structure; none if there is nothing to meet.
fn built(input: &BlasInput<'_>, quality: Quality) -> Option<Blas> {
    build_blas_with(input, quality)
        .map_err(|error| tracing::warn!("a mesh is left out: {error}"))
        .ok()
        .filter(|blas| blas.triangle_count > 0)
}

fn of_triangles(corners: &[[f32; 3]], members: &[Member], quality: Quality) -> Option<Blas> {
    let attributes = attributes(members);
    let indices: Vec<[u32; 3]> = (0..attributes.len() as u32)
        .map(|triangle| [3 * triangle, 3 * triangle + 1, 3 * triangle + 2])
        .collect();
    let input =
        BlasInput { positions: corners, indices: &indices, attributes: &attributes, ..BlasInput::default() };
    built(&input, quality)
}

/// What hits report of the members' triangles, in order.
fn attributes(members: &[Member]) -> Vec<TriangleAttributes> {
    let of_member = |(number, member): (usize, &Member)| {
        let first = (number as u32) << MEMBER_SHIFT;
        let flags = if member.is_alpha_tested { FLAG_ALPHA_TESTED } else { 0 };
        (0..member.triangles).map(move |triangle| TriangleAttributes { primitive: first | triangle, flags })
    };
    members.iter().enumerate().flat_map(of_member).collect()
}
