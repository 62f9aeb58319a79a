//! What can go wrong while a frame is executed.

use afterglow_frame_graph::GraphError;
use afterglow_gpu::GpuError;

#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device, or the memory that it has, did not serve.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The frame's passes make no sense together: a mistake in the renderer.
    #[error("the frame graph: {0}")]
    Graph(#[from] GraphError),
    /// Asked for something after the device had failed.
    #[error("the device has failed before")]
    Failed,
}

impl RenderError {
    /// Whether the device would have served with more memory.
    pub fn is_out_of_memory(&self) -> bool {
        matches!(self, Self::Gpu(error) if error.is_out_of_memory())
    }

    /// Whether the device was lost: nothing that was created from it works any more.
    pub fn is_device_lost(&self) -> bool {
        matches!(self, Self::Gpu(error) if error.is_device_lost())
    }
}
