//! What rays go through, of either backend, behind one interface.
//!
//! A frame says which meshes it has, by content; those that are new are built; then instances of them become the top level.
//! What must be done on the device for that is recorded by the `build` pass, before any ray is shot.

use afterglow_bvh::Aabb;
use afterglow_gpu::{Commands, Gpu, GpuError};

use super::backend::Backend;
use super::hardware::HardwareStructures;
use super::meshes::Meshes;
use crate::uploads::UploadArena;

/// Frames after which a mesh that no frame has used is given up.
pub(super) const IDLE_FRAMES: u64 = 60;

/// A mesh to build.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeshInput<'a> {
    pub(crate) shapes: Shapes<'a>,
    /// Whether it will be used for long.
    pub(crate) is_lasting: bool,
}

/// What a mesh is made of, in object space. A hit's primitive is the number of the member, shifted by `MEMBER_SHIFT`, and
/// of the triangle in it; spheres are one member.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Shapes<'a> {
    /// Three corners a triangle, the members' triangles one after another.
    Triangles { corners: &'a [[f32; 3]], members: &'a [Member] },
    /// Centre and radius of each; instances may be moved, but nothing else.
    Spheres(&'a [[f32; 4]]),
}

/// Triangles of one draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Member {
    /// At most `1 << MEMBER_SHIFT`.
    pub(crate) triangles: u32,
    pub(crate) is_alpha_tested: bool,
}

/// An instance of a mesh that is there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placed {
    pub(crate) content: u64,
    pub(crate) object_to_world: [[f32; 4]; 3],
    /// Number of the first member among the frame's.
    pub(crate) id: u32,
    pub(crate) mask: u8,
}

/// A frame's top level.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct TopLevel {
    pub(crate) address: u64,
    pub(crate) instances: u32,
    /// The longest side of the box of all that rays can meet.
    pub(crate) extent: f32,
}

/// The structures of a backend, kept from frame to frame.
#[expect(clippy::large_enum_variant, reason = "a window has one")]
pub(crate) enum Structures {
    Software(Meshes),
    Hardware(HardwareStructures),
}

impl Structures {
    /// # Errors
    /// If the device lacks what the backend needs.
    pub(crate) fn new(gpu: &Gpu, backend: Backend) -> Result<Self, GpuError> {
        Ok(match backend {
            Backend::Software => Self::Software(Meshes::new(gpu)),
            Backend::Hardware => Self::Hardware(HardwareStructures::new(gpu)?),
        })
    }

    /// A new frame begins: what was not used for long goes.
    pub(crate) fn begin_frame(&mut self) -> Result<(), GpuError> {
        match self {
            Self::Software(meshes) => meshes.begin_frame(),
            Self::Hardware(structures) => return structures.begin_frame(),
        }
        Ok(())
    }

    /// Whether a mesh is there, so that it need not be built.
    pub(crate) fn has(&self, content: u64) -> bool {
        match self {
            Self::Software(meshes) => meshes.has(content),
            Self::Hardware(structures) => structures.has(content),
        }
    }

    /// Builds a mesh that is not there.
    pub(crate) fn build(
        &mut self,
        content: u64,
        input: &MeshInput<'_>,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        match self {
            Self::Software(meshes) => meshes.build(content, input, arena),
            Self::Hardware(structures) => structures.build(content, input, arena),
        }
    }

    /// Says that this frame uses a mesh, and whether rays can meet anything of it.
    pub(crate) fn take(&mut self, content: u64) -> bool {
        match self {
            Self::Software(meshes) => meshes.take(content),
            Self::Hardware(structures) => structures.take(content),
        }
    }

    /// Makes the top level of a frame. It is empty if the instances are more than a device takes.
    pub(crate) fn top_level(
        &mut self,
        placed: &[Placed],
        arena: &mut UploadArena,
    ) -> Result<TopLevel, GpuError> {
        match self {
            Self::Software(meshes) => meshes.top_level(placed, arena),
            Self::Hardware(structures) => structures.top_level(placed, arena),
        }
    }

    /// Triangles and spheres built in this frame.
    pub(crate) fn built(&self) -> usize {
        match self {
            Self::Software(meshes) => meshes.built,
            Self::Hardware(structures) => structures.built,
        }
    }

    /// Whether this frame has anything to record.
    pub(crate) fn has_work(&self) -> bool {
        match self {
            Self::Software(meshes) => meshes.has_work(),
            Self::Hardware(structures) => structures.has_work(),
        }
    }

    /// Records what brings this frame's structures to the device.
    pub(crate) fn record(&self, commands: &Commands<'_>) {
        match self {
            Self::Software(meshes) => meshes.record(commands),
            Self::Hardware(structures) => structures.record(commands),
        }
    }
}

/// The longest side of a box, 0 if it is empty.
pub(super) fn longest_side(bounds: &Aabb) -> f32 {
    if bounds.is_empty() { 0.0 } else { (bounds.max - bounds.min).max_element() }
}
