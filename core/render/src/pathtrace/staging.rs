//! Brings bytes to the device's own memory: they are written where the processor can write, and copied by a pass before
//! any shader reads them.

use afterglow_gpu::{Commands, Gpu, GpuError, vk};

use super::slabs::{Part, Slabs};
use crate::uploads::{Upload, UploadArena};

/// A copy to a place on the device.
#[derive(Debug, Clone, Copy)]
struct Copy {
    from: Upload,
    to: vk::Buffer,
    offset: u64,
    bytes: u64,
}

/// Memory on the device, and the copies that this frame makes to it.
pub(crate) struct Staging {
    slabs: Slabs,
    copies: Vec<Copy>,
}

impl Staging {
    /// Memory comes in slabs of so many bytes; larger pieces have one of their own.
    pub(crate) fn new(gpu: &Gpu, name: &'static str, slab_bytes: u64) -> Self {
        Self { slabs: Slabs::new(gpu, name, slab_bytes), copies: Vec::new() }
    }

    /// A new frame begins.
    pub(crate) fn begin_frame(&mut self) {
        self.copies.clear();
        self.slabs.begin_frame();
    }

    /// Brings bytes to the device. They stay until the part is freed.
    pub(crate) fn bring(&mut self, bytes: &[u8], arena: &mut UploadArena) -> Result<Part, GpuError> {
        let part = self.slabs.allocate(bytes.len() as u64)?;
        if !bytes.is_empty() {
            self.copy(arena.push(bytes)?, bytes.len() as u64, &part);
        }
        Ok(part)
    }

    /// Brings bytes that were written already.
    pub(crate) fn bring_uploaded(&mut self, from: Upload, bytes: u64) -> Result<Part, GpuError> {
        let part = self.slabs.allocate(bytes)?;
        if bytes > 0 {
            self.copy(from, bytes, &part);
        }
        Ok(part)
    }

    /// Brings bytes that only this frame reads. Returns their address.
    pub(crate) fn bring_once(&mut self, bytes: &[u8], arena: &mut UploadArena) -> Result<u64, GpuError> {
        let part = self.bring(bytes, arena)?;
        let address = part.address;
        self.free(part);
        Ok(address)
    }

    /// Gives a part back; frames in flight may still use it.
    pub(crate) fn free(&mut self, part: Part) {
        self.slabs.free(part);
    }

    /// Whether this frame copies anything.
    pub(crate) fn has_work(&self) -> bool {
        !self.copies.is_empty()
    }

    /// Records this frame's copies.
    pub(crate) fn record(&self, commands: &Commands<'_>) {
        for copy in &self.copies {
            let regions =
                [vk::BufferCopy { src_offset: copy.from.offset, dst_offset: copy.offset, size: copy.bytes }];
            // SAFETY: both buffers are this device's and hold these bytes; the target's are allocated for this copy.
            unsafe {
                commands.device().cmd_copy_buffer(commands.raw(), copy.from.buffer, copy.to, &regions);
            }
        }
    }

    fn copy(&mut self, from: Upload, bytes: u64, part: &Part) {
        if let Some((to, offset)) = self.slabs.place(part) {
            self.copies.push(Copy { from, to, offset, bytes });
        }
    }
}

#[cfg(test)]
impl Staging {
    /// The words of a part, once the device has finished.
    pub(crate) fn read(&self, gpu: &Gpu, part: &Part) -> Vec<u32> {
        let bytes = self.slabs.download(gpu, part);
        bytemuck::cast_slice(&bytes).to_vec()
    }
}
