//! Structures of the software backend: bottom levels on the device, found by their content, and a top level a frame.
//! Where a mesh that does not last is gone and another has the same triangles in the same order, only moved, its structure
//! moves with them.

use afterglow_bvh::layout::FLAG_ALPHA_TESTED;
use afterglow_bvh::{
    Aabb, Blas, BlasInput, Instance, Quality, TriangleAttributes, build_blas_with, build_tlas,
};
use afterglow_gpu::{Commands, Gpu, GpuError};
use afterglow_records::MEMBER_SHIFT;
use hashbrown::HashMap;

use super::refit::Movable;
use super::slabs::Part;
use super::staging::Staging;
use super::structures::{Builder, Changing, Member, MeshInput, Placed, Shapes, TopLevel, longest_side};
use crate::uploads::UploadArena;

/// Bytes of a slab.
const SLAB_BYTES: u64 = 16 << 20;
/// Meshes of more triangles are built fast, whatever they are.
const MOST_IMPROVED: usize = 20_000;

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
}

impl Meshes {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self { staging: Staging::new(gpu, "meshes", SLAB_BYTES), meshes: HashMap::new() }
    }

    fn insert(&mut self, content: u64, blas: &Blas, arena: &mut UploadArena) -> Result<&mut Mesh, GpuError> {
        let part = self.staging.bring(bytemuck::cast_slice(&blas.words), arena)?;
        let mesh = Mesh { part, bounds: blas.bounds, movable: None };
        Ok(self.meshes.entry(content).insert(mesh).into_mut())
    }

    /// Takes the structure of a mesh that becomes another one.
    fn take(&mut self, content: u64) -> Option<Movable> {
        let mesh = self.meshes.remove(&content)?;
        self.staging.free(mesh.part);
        mesh.movable
    }
}

impl Builder for Meshes {
    fn begin_frame(&mut self) -> Result<(), GpuError> {
        self.staging.begin_frame();
        Ok(())
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
                let is_small = corners.len() / 3 <= MOST_IMPROVED;
                let quality = if is_small { Quality::Good } else { Quality::Fast };
                let blas = of_triangles(corners, members, quality);
                blas.map_or(Ok(()), |blas| self.insert(content, &blas, arena).map(|_| ()))
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

    fn free(&mut self, content: u64) {
        self.take(content);
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
