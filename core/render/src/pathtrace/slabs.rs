//! Memory on the device for structures that come and go: parts of a few large buffers.

use std::ops::Range;

use afterglow_gpu::{Buffer, BufferDesc, BufferKind, Gpu, GpuError, vk};
use range_alloc::RangeAllocator;

/// Of parts in a slab.
const ALIGNMENT: u64 = 64;
/// Frames after which memory that a frame used is idle: those in flight, and the one being recorded.
const FRAMES_IN_USE: u64 = 3;

struct Slab {
    buffer: Buffer,
    free: RangeAllocator<u64>,
}

/// A part of a slab.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    slab: usize,
    bytes: Range<u64>,
    /// Where shaders find it.
    pub(crate) address: u64,
}

/// All slabs.
pub(crate) struct Slabs {
    gpu: Gpu,
    name: &'static str,
    /// Bytes of an ordinary slab; larger parts get a slab of their own.
    slab_bytes: u64,
    slabs: Vec<Option<Slab>>,
    /// Parts that are free once the device has finished with them, with the frame that freed them.
    freed: Vec<(u64, Part)>,
    frame: u64,
}

impl Slabs {
    pub(crate) fn new(gpu: &Gpu, name: &'static str, slab_bytes: u64) -> Self {
        Self { gpu: gpu.clone(), name, slab_bytes, slabs: Vec::new(), freed: Vec::new(), frame: 0 }
    }

    /// A new frame begins: what was freed long enough ago can be used again.
    pub(crate) fn begin_frame(&mut self) {
        self.frame += 1;
        let frame = self.frame;
        let (idle, kept): (Vec<_>, Vec<_>) = std::mem::take(&mut self.freed)
            .into_iter()
            .partition(|(freed, _)| freed + FRAMES_IN_USE <= frame);
        self.freed = kept;
        for (_, part) in idle {
            self.reclaim(&part);
        }
    }

    /// Room for so many bytes, their contents undefined.
    pub(crate) fn allocate(&mut self, bytes: u64) -> Result<Part, GpuError> {
        let bytes = bytes.max(4).next_multiple_of(ALIGNMENT);
        for (slab, entry) in self.slabs.iter_mut().enumerate() {
            let Some(entry) = entry else { continue };
            if let Ok(bytes) = entry.free.allocate_range(bytes) {
                let address = entry.buffer.address() + bytes.start;
                return Ok(Part { slab, bytes, address });
            }
        }
        self.allocate_in_new(bytes)
    }

    /// Gives a part back; frames in flight may still use it.
    pub(crate) fn free(&mut self, part: Part) {
        self.freed.push((self.frame, part));
    }

    /// The buffer that holds a part, and the part's first byte in it.
    pub(crate) fn place(&self, part: &Part) -> Option<(vk::Buffer, u64)> {
        let slab = self.slabs.get(part.slab)?.as_ref()?;
        Some((slab.buffer.raw(), part.bytes.start))
    }

    fn allocate_in_new(&mut self, bytes: u64) -> Result<Part, GpuError> {
        let size = bytes.max(self.slab_bytes);
        let buffer = self.gpu.create_buffer(&BufferDesc::new(self.name, BufferKind::Device, size))?;
        let mut free = RangeAllocator::new(0..size);
        // A fresh slab holds at least this part.
        let bytes = free.allocate_range(bytes).unwrap_or(0..bytes);
        let address = buffer.address() + bytes.start;
        let vacant = self.slabs.iter().position(Option::is_none);
        let slab = vacant.unwrap_or(self.slabs.len());
        if vacant.is_none() {
            self.slabs.push(None);
        }
        self.slabs[slab] = Some(Slab { buffer, free });
        Ok(Part { slab, bytes, address })
    }

    fn reclaim(&mut self, part: &Part) {
        let Some(Some(slab)) = self.slabs.get_mut(part.slab) else {
            return;
        };
        slab.free.free_range(part.bytes.clone());
        if slab.free.is_empty() && slab.buffer.size() > self.slab_bytes {
            self.slabs[part.slab] = None;
        }
    }
}

#[cfg(test)]
impl Slabs {
    /// A part's bytes, once the device has finished.
    pub(crate) fn download(&self, gpu: &Gpu, part: &Part) -> Vec<u8> {
        let slab = self.slabs[part.slab].as_ref().unwrap();
        let range = part.bytes.start as usize..part.bytes.end as usize;
        gpu.download_buffer(&slab.buffer).unwrap()[range].to_vec()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::gpu;

    const SLAB_BYTES: u64 = 1 << 20;

    #[test]
    fn memory_is_used_again_when_the_device_has_finished() {
        let mut slabs = Slabs::new(&gpu(), "slabs", SLAB_BYTES);
        let first = slabs.allocate(100).unwrap();
        let second = slabs.allocate(100).unwrap();
        assert_eq!(second.address - first.address, 128);
        let address = first.address;
        slabs.free(first);
        assert_ne!(slabs.allocate(100).unwrap().address, address);
        for _ in 0..FRAMES_IN_USE {
            slabs.begin_frame();
        }
        assert_eq!(slabs.allocate(100).unwrap().address, address);
    }

    #[test]
    fn a_large_part_has_a_slab_that_goes_with_it() {
        let mut slabs = Slabs::new(&gpu(), "slabs", SLAB_BYTES);
        let large = slabs.allocate(SLAB_BYTES + 1).unwrap();
        assert_eq!(slabs.place(&large).unwrap().1, 0);
        let again = large.clone();
        slabs.free(large);
        for _ in 0..FRAMES_IN_USE {
            slabs.begin_frame();
        }
        assert!(slabs.place(&again).is_none());
    }
}
