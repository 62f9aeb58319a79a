//! Which of the two implementations traces rays, and what that means for the passes that shoot them.

use std::fmt;

use afterglow_frame_graph::{Access, PassKind};
use afterglow_gpu::{Gpu, GpuError};

/// What traces rays.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum Backend {
    /// A two-level BVH of our own in compute shaders.
    #[default]
    Software,
    /// The driver's structures and ray-tracing pipelines.
    Hardware,
}

impl Backend {
    /// Whether a device has it.
    pub fn is_on(self, gpu: &Gpu) -> bool {
        self == Self::Software || gpu.ray_tracing().is_some()
    }

    /// Fails, and says why, on a device that does not have it.
    pub(crate) fn require(self, gpu: &Gpu) -> Result<(), GpuError> {
        match self.is_on(gpu) {
            true => Ok(()),
            false => Err(GpuError::Unsupported {
                what: "ray-tracing pipelines (the software backend needs none)",
                device: gpu.info().name.clone(),
            }),
        }
    }

    /// What a pass that shoots rays is.
    pub(crate) fn pass(self) -> PassKind {
        self.choose(PassKind::Compute, PassKind::Trace)
    }

    /// How such a pass uses the world.
    pub(crate) fn meets(self) -> Access {
        self.choose(Access::StorageReadCompute, Access::AccelerationTrace)
    }

    /// How it reads buffers and textures.
    pub(crate) fn reads(self) -> Access {
        self.choose(Access::StorageReadCompute, Access::StorageReadTrace)
    }

    /// How it writes buffers.
    pub(crate) fn writes(self) -> Access {
        self.choose(Access::StorageWriteCompute, Access::StorageWriteTrace)
    }

    /// What the pass is that makes the world, and how it uses that.
    pub(crate) fn building(self) -> (PassKind, Access) {
        self.choose((PassKind::Transfer, Access::TransferDst), (PassKind::Build, Access::AccelerationBuild))
    }

    fn choose<T>(self, software: T, hardware: T) -> T {
        match self {
            Self::Software => software,
            Self::Hardware => hardware,
        }
    }
}

impl fmt::Display for Backend {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.choose("software", "hardware"))
    }
}
