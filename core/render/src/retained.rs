//! Ranges of vertices and indices that outlive a frame, in the device's own memory.
//!
//! A range is copied there when a frame first names it, and stays until the program has dropped it.

use std::ops::Range;
use std::sync::{Arc, Weak};

use afterglow_gl::frame::RetainedRange;
use afterglow_gpu::{Buffer, BufferDesc, BufferKind, Commands, Gpu, GpuError, vk};
use hashbrown::HashMap;
use range_alloc::RangeAllocator;

use crate::uploads::{Upload, UploadArena};

/// Bytes of an ordinary slab; larger ranges get a slab of their own.
const SLAB_BYTES: u64 = 8 << 20;
/// Of ranges in a slab: a vertex's floats need 4, copies and caches like more.
const ALIGNMENT: u64 = 64;
/// Frames after which memory that a frame used is idle: those in flight, and the one being recorded.
const FRAMES_IN_USE: u64 = 3;
/// How often dropped ranges are looked for, in frames.
const SWEEP_INTERVAL: u64 = 16;

struct Slab {
    buffer: Buffer,
    free: RangeAllocator<u64>,
}

struct Entry {
    range: Weak<RetainedRange>,
    slab: usize,
    bytes: Range<u64>,
    resident: Resident,
}

/// Where a range is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Resident {
    /// Address of its first vertex.
    pub(crate) vertices: u64,
    /// Words of all vertices.
    pub(crate) words: u32,
    /// The buffer that holds its indices.
    pub(crate) index_buffer: vk::Buffer,
    /// Number of the first index, counted from the start of that buffer.
    pub(crate) first_index: u32,
    /// How many indices there are.
    pub(crate) indices: u32,
}

/// A copy that brings a range to its place.
pub(crate) struct RangeCopy {
    from: Upload,
    to: vk::Buffer,
    offset: u64,
    bytes: u64,
}

/// All ranges on the device.
pub(crate) struct RetainedRanges {
    gpu: Gpu,
    slabs: Vec<Option<Slab>>,
    entries: HashMap<u64, Entry>,
    /// Memory of dropped ranges, with the frame that noticed.
    dropped: Vec<(u64, usize, Range<u64>)>,
    frame: u64,
}

impl RetainedRanges {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self { gpu: gpu.clone(), slabs: Vec::new(), entries: HashMap::new(), dropped: Vec::new(), frame: 0 }
    }

    /// A new frame begins: memory of ranges that were dropped long enough ago becomes free.
    pub(crate) fn begin_frame(&mut self) {
        self.frame += 1;
        if self.frame.is_multiple_of(SWEEP_INTERVAL) {
            self.sweep();
        }
        let idle = |noticed: u64| noticed + FRAMES_IN_USE <= self.frame;
        let (free, kept) =
            std::mem::take(&mut self.dropped).into_iter().partition(|(noticed, _, _)| idle(*noticed));
        self.dropped = kept;
        let free: Vec<(u64, usize, Range<u64>)> = free;
        for (_, slab, bytes) in free {
            self.free(slab, bytes);
        }
    }

    /// Where `range` is; if it is new, `copies` gets what brings it there.
    pub(crate) fn resident(
        &mut self,
        range: &Arc<RetainedRange>,
        arena: &mut UploadArena,
        copies: &mut Vec<RangeCopy>,
    ) -> Result<Resident, GpuError> {
        if let Some(entry) = self.entries.get(&range.id()) {
            return Ok(entry.resident);
        }
        let words: &[u8] = bytemuck::cast_slice(&range.words);
        let indices: &[u8] = bytemuck::cast_slice(&range.indices);
        let bytes = (words.len() + indices.len()).max(4) as u64;
        let (slab, place) = self.allocate(bytes.next_multiple_of(ALIGNMENT))?;
        let buffer = self.slab_buffer(slab);
        let resident = Resident {
            vertices: buffer.address() + place.start,
            words: range.words.len() as u32,
            index_buffer: buffer.raw(),
            first_index: ((place.start + words.len() as u64) / 4) as u32,
            indices: range.indices.len() as u32,
        };
        for (content, offset) in [(words, place.start), (indices, place.start + words.len() as u64)] {
            if !content.is_empty() {
                copies.push(RangeCopy {
                    from: arena.push(content)?,
                    to: resident.index_buffer,
                    offset,
                    bytes: content.len() as u64,
                });
            }
        }
        let entry = Entry { range: Arc::downgrade(range), slab, bytes: place, resident };
        self.entries.insert(range.id(), entry);
        Ok(resident)
    }

    /// Ranges on the device.
    pub(crate) fn len(&self) -> usize {
        self.entries.len()
    }

    /// Puts the ranges that nobody holds any more aside.
    fn sweep(&mut self) {
        let (frame, dropped) = (self.frame, &mut self.dropped);
        self.entries.retain(|_, entry| {
            let held = entry.range.strong_count() > 0;
            if !held {
                dropped.push((frame, entry.slab, entry.bytes.clone()));
            }
            held
        });
    }

    fn slab_buffer(&self, slab: usize) -> &Buffer {
        // Entries and callers only hold numbers of slabs that are there: a slab goes with its last range.
        let slab = self.slabs[slab].as_ref();
        &slab.expect("a slab in use is kept").buffer
    }

    fn allocate(&mut self, bytes: u64) -> Result<(usize, Range<u64>), GpuError> {
        for (index, slab) in self.slabs.iter_mut().enumerate() {
            let place = slab.as_mut().and_then(|slab| slab.free.allocate_range(bytes).ok());
            if let Some(place) = place {
                return Ok((index, place));
            }
        }
        let size = bytes.max(SLAB_BYTES);
        let desc = BufferDesc::new("retained ranges", BufferKind::Device, size)
            .usage(vk::BufferUsageFlags::INDEX_BUFFER);
        let mut slab = Slab { buffer: self.gpu.create_buffer(&desc)?, free: RangeAllocator::new(0..size) };
        // A fresh slab holds at least this range.
        let place = slab.free.allocate_range(bytes).unwrap_or(0..bytes);
        let vacant = self.slabs.iter().position(Option::is_none);
        let index = vacant.unwrap_or(self.slabs.len());
        if vacant.is_none() {
            self.slabs.push(None);
        }
        self.slabs[index] = Some(slab);
        Ok((index, place))
    }

    fn free(&mut self, index: usize, bytes: Range<u64>) {
        let Some(slab) = &mut self.slabs[index] else {
            return;
        };
        slab.free.free_range(bytes);
        if slab.free.is_empty() && slab.buffer.size() > SLAB_BYTES {
            self.slabs[index] = None;
        }
    }
}

/// Records copies of ranges to their places.
pub(crate) fn record_copies(commands: &Commands<'_>, copies: &[RangeCopy]) {
    for copy in copies {
        let regions =
            [vk::BufferCopy { src_offset: copy.from.offset, dst_offset: copy.offset, size: copy.bytes }];
        // SAFETY: both buffers are this device's and hold these bytes; the target's are allocated for this range.
        unsafe {
            commands.device().cmd_copy_buffer(commands.raw(), copy.from.buffer, copy.to, &regions);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::gpu;
    use afterglow_gl::frame::VertexLayout;

    fn range(words: usize) -> Arc<RetainedRange> {
        let range = RetainedRange::new(VertexLayout::default(), vec![0; words], vec![0, 1, 2]);
        Arc::new(range)
    }

    #[test]
    fn a_range_is_copied_once_and_its_memory_used_again() {
        let gpu = gpu();
        let (mut ranges, mut arena) = (RetainedRanges::new(&gpu), UploadArena::new(&gpu));
        let mut copies = Vec::new();
        let kept = range(100);
        let first = ranges.resident(&kept, &mut arena, &mut copies).unwrap();
        let again = ranges.resident(&kept, &mut arena, &mut copies).unwrap();
        assert_eq!((copies.len(), first.vertices), (2, again.vertices));
        assert_eq!((first.first_index, first.indices), (100, 3));

        let dropped = range(10);
        let place = ranges.resident(&dropped, &mut arena, &mut copies).unwrap();
        drop(dropped);
        for _ in 0..SWEEP_INTERVAL + FRAMES_IN_USE {
            ranges.begin_frame();
        }
        assert_eq!(ranges.len(), 1);
        let reused = ranges.resident(&range(10), &mut arena, &mut copies).unwrap();
        assert_eq!(reused.vertices, place.vertices);
    }

    #[test]
    fn a_large_range_has_a_slab_that_goes_with_it() {
        let gpu = gpu();
        let (mut ranges, mut arena) = (RetainedRanges::new(&gpu), UploadArena::new(&gpu));
        let large = range(SLAB_BYTES as usize / 4 + 1);
        let _ = ranges.resident(&large, &mut arena, &mut Vec::new()).unwrap();
        assert!(ranges.slabs[0].is_some());
        drop(large);
        for _ in 0..SWEEP_INTERVAL + FRAMES_IN_USE {
            ranges.begin_frame();
        }
        assert!(ranges.slabs[0].is_none());
    }
}
