//! A buffer of the device's own for pixels on their way from the window to somewhere else.

use afterglow_frame_graph::ResourceState;
use afterglow_gpu::{Buffer, BufferDesc, BufferKind, Gpu, GpuError};

/// Grows to the largest need; passes of one frame use it one after the other.
pub(crate) struct Store {
    gpu: Gpu,
    buffer: Option<Buffer>,
    pub(crate) state: ResourceState,
}

impl Store {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self { gpu: gpu.clone(), buffer: None, state: ResourceState::SETTLED }
    }

    /// Makes room for so many bytes. What the buffer held may be lost.
    pub(crate) fn reserve(&mut self, bytes: u64) -> Result<(), GpuError> {
        if bytes > self.bytes() {
            let size = bytes.next_power_of_two();
            let desc = BufferDesc::new("pixel store", BufferKind::Device, size);
            self.buffer = Some(self.gpu.create_buffer(&desc)?);
            self.state = ResourceState::SETTLED;
        }
        Ok(())
    }

    /// Bytes that there is room for.
    pub(crate) fn bytes(&self) -> u64 {
        self.buffer.as_ref().map_or(0, Buffer::size)
    }

    /// None if nothing was ever reserved.
    pub(crate) fn buffer(&self) -> Option<&Buffer> {
        self.buffer.as_ref()
    }

    pub(crate) fn address(&self) -> u64 {
        self.buffer.as_ref().map_or(0, Buffer::address)
    }
}
