//! Structures of the software backend: bottom levels on the device, found by their content, and a top level a frame.
//! Where a mesh that does not last is gone and another has the same triangles in the same order, only moved, its structure
//! moves with them: a small one is moved by the processor, a large one by the device.
//!
//! What lasts is built by another thread where frames do not wait for it: until it comes, rays pass through it. So that little
//! is missing for long, a few small meshes a frame are built at once, and small ones come before large ones.

use afterglow_bvh::layout::FLAG_ALPHA_TESTED;
use afterglow_bvh::{
    Aabb, Blas, BlasInput, Instance, Quality, TriangleAttributes, build_blas_with, build_tlas,
};
use afterglow_gpu::{Commands, Gpu, GpuError};
use afterglow_records::MEMBER_SHIFT;
use hashbrown::{HashMap, HashSet};

use super::background::{Background, Finished, Order};
use super::device_refit::{DeviceTree, LEAST_TRIANGLES, Refitter};
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
    moving: Option<Moving>,
}

/// How a mesh that does not last is moved.
enum Moving {
    /// By the processor, which has the structure.
    Processor(Movable),
    Device(DeviceTree),
}

/// All meshes that rays can meet, and the copies that this frame's new structures need.
pub(crate) struct Meshes {
    staging: Staging,
    meshes: HashMap<u64, Mesh>,
    /// None where the processor moves all.
    refitter: Option<Refitter>,
    /// Meshes of fewer triangles are moved by the processor anyway.
    least_refitted: usize,
    /// None if frames wait for all that they need.
    background: Option<Background>,
    /// Meshes that are still being built.
    waiting: HashSet<u64>,
    /// Triangles of lasting meshes that this frame has built at once.
    at_once: usize,
}

impl Meshes {
    /// `waits`: frames wait for all that they need.
    pub(crate) fn new(gpu: &Gpu, waits: bool) -> Result<Self, GpuError> {
        let build = |order: &Order, quality| of_triangles(&order.corners, &order.members, quality);
        Ok(Self {
            staging: Staging::new(gpu, "meshes", SLAB_BYTES),
            meshes: HashMap::new(),
            // A processor that plays the device is no faster than itself.
            refitter: match gpu.info().kind.is_software() {
                true => None,
                false => Some(Refitter::new(gpu)?),
            },
            least_refitted: LEAST_TRIANGLES,
            background: (!waits).then(|| Background::new(build)),
            waiting: HashSet::new(),
            at_once: 0,
        })
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
        blas.map_or(Ok(()), |blas| self.keep(content, &blas, arena))
    }

    /// Takes what was built meanwhile.
    fn take_finished(&mut self, arena: &mut UploadArena) -> Result<(), GpuError> {
        let finished = self.background.as_mut().map(Background::take).unwrap_or_default();
        for Finished { content, blas } in finished {
            let is_needed = self.waiting.remove(&content) || self.meshes.contains_key(&content);
            if let Some(blas) = blas.filter(|_| is_needed) {
                self.keep(content, &blas, arena)?;
            }
        }
        Ok(())
    }

    /// Builds a mesh that does not last, or moves another.
    fn build_changing(
        &mut self,
        content: u64,
        corners: &[[f32; 3]],
        members: &[Member],
        changing: &Changing<'_>,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        let former = changing.former.and_then(|former| self.meshes.remove(&former));
        let moved = match former {
            Some(former) => self.moved(former, corners, members, changing.input.bounds, arena)?,
            None => None,
        };
        let mesh = match moved {
            Some(moved) => Some(moved),
            None => self.movable(corners, members, arena)?,
        };
        self.meshes.extend(mesh.map(|mesh| (content, mesh)));
        Ok(())
    }

    /// What a mesh becomes; none if it must be built anew.
    fn moved(
        &mut self,
        former: Mesh,
        corners: &[[f32; 3]],
        members: &[Member],
        bounds: Aabb,
        arena: &mut UploadArena,
    ) -> Result<Option<Mesh>, GpuError> {
        match (former.moving, &mut self.refitter) {
            (Some(Moving::Device(mut tree)), Some(refitter)) => {
                let (structure, area) = (former.part.address, bounds.half_area());
                if refitter.moves(&mut tree, structure, corners, area, &mut self.staging, arena)? {
                    return Ok(Some(Mesh { bounds, moving: Some(Moving::Device(tree)), ..former }));
                }
                tree.free(&mut self.staging);
                self.staging.free(former.part);
                Ok(None)
            }
            (Some(Moving::Processor(movable)), _) => {
                self.staging.free(former.part);
                let Some(moved) = movable.moved(corners, members) else { return Ok(None) };
                let mesh = self.bring(&moved.blas, arena)?;
                Ok(Some(Mesh { moving: Some(Moving::Processor(moved)), ..mesh }))
            }
            _ => {
                self.staging.free(former.part);
                Ok(None)
            }
        }
    }

    /// A mesh that is built now and may be moved later; none if there is nothing to meet.
    fn movable(
        &mut self,
        corners: &[[f32; 3]],
        members: &[Member],
        arena: &mut UploadArena,
    ) -> Result<Option<Mesh>, GpuError> {
        let Some(blas) = of_triangles(corners, members, Quality::Fast) else { return Ok(None) };
        let mesh = self.bring(&blas, arena)?;
        let is_large = corners.len() / 3 >= self.least_refitted;
        let moving = match is_large && self.refitter.is_some() {
            true => Moving::Device(DeviceTree::new(&blas, members, &mut self.staging, arena)?),
            false => Moving::Processor(Movable::new(blas)),
        };
        Ok(Some(Mesh { moving: Some(moving), ..mesh }))
    }

    /// Brings a structure to the device.
    fn bring(&mut self, blas: &Blas, arena: &mut UploadArena) -> Result<Mesh, GpuError> {
        let part = self.staging.bring(bytemuck::cast_slice(&blas.words), arena)?;
        Ok(Mesh { part, bounds: blas.bounds, moving: None })
    }

    /// Keeps a mesh that lasts, in the place of a worse one.
    fn keep(&mut self, content: u64, blas: &Blas, arena: &mut UploadArena) -> Result<(), GpuError> {
        let mesh = self.bring(blas, arena)?;
        if let Some(worse) = self.meshes.insert(content, mesh) {
            self.staging.free(worse.part);
        }
        Ok(())
    }
}

impl Builder for Meshes {
    fn begin_frame(&mut self, arena: &mut UploadArena) -> Result<(), GpuError> {
        self.staging.begin_frame();
        if let Some(refitter) = &mut self.refitter {
            refitter.begin_frame();
        }
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
                blas.map_or(Ok(()), |blas| self.keep(content, &blas, arena))
            }
            Shapes::Triangles { corners, members } if input.is_lasting => {
                self.build_lasting(content, corners, members, arena)
            }
            Shapes::Triangles { corners, members } => match changing {
                Some(changing) => self.build_changing(content, corners, members, changing, arena),
                None => Ok(()),
            },
        }
    }

    fn is_met(&self, content: u64) -> bool {
        self.meshes.contains_key(&content)
    }

    fn is_waiting(&self, content: u64) -> bool {
        self.waiting.contains(&content)
    }

    fn free(&mut self, content: u64) {
        if let Some(mesh) = self.meshes.remove(&content) {
            self.staging.free(mesh.part);
            if let Some(Moving::Device(tree)) = mesh.moving {
                tree.free(&mut self.staging);
            }
        }
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

    #[cfg(test)]
    fn always_refit(&mut self, gpu: &Gpu) {
        (self.refitter, self.least_refitted) = (Some(Refitter::new(gpu).unwrap()), 0);
    }

    fn has_moves(&self) -> bool {
        self.refitter.as_ref().is_some_and(Refitter::has_work)
    }

    fn record_moves(&self, commands: &Commands<'_>) {
        if let Some(refitter) = &self.refitter {
            refitter.record(commands);
        }
    }
}

/// A structure; none if there is nothing to meet.
fn built(input: &BlasInput<'_>, quality: Quality) -> Option<Blas> {
    build_blas_with(input, quality)
        .map_err(|error| tracing::warn!("a mesh is left out: {error}"))
        .ok()
        .filter(|blas| blas.triangle_count > 0)
}

pub(super) fn of_triangles(corners: &[[f32; 3]], members: &[Member], quality: Quality) -> Option<Blas> {
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
