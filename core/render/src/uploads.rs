//! Memory that the processor fills for one frame: vertices, tables, texels on their way to images.

use afterglow_gpu::{Buffer, BufferDesc, BufferKind, Gpu, GpuError, STRUCTURE_INPUT, vk};

/// Bytes of an ordinary chunk; larger data get a chunk of their own.
const CHUNK_BYTES: u64 = 4 << 20;
/// Suits every use: copies, index buffers, structures of 64-bit addresses, whole cache lines.
const ALIGNMENT: u64 = 64;
/// Chunks that a frame left unused for so long are given back.
const IDLE_FRAMES: u32 = 120;

struct Chunk {
    buffer: Buffer,
    used: u64,
    idle_frames: u32,
}

/// Bytes in an upload buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Upload {
    pub(crate) buffer: vk::Buffer,
    /// From the start of the buffer, in bytes.
    pub(crate) offset: u64,
    /// Where shaders find the first byte.
    pub(crate) address: u64,
}

/// Hands out upload memory until it is reset, which may happen once the device has read it all.
pub(crate) struct UploadArena {
    gpu: Gpu,
    chunks: Vec<Chunk>,
    bytes: u64,
}

impl UploadArena {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self { gpu: gpu.clone(), chunks: Vec::new(), bytes: 0 }
    }

    /// Forgets everything. The device must have finished with it.
    pub(crate) fn reset(&mut self) {
        for chunk in &mut self.chunks {
            chunk.idle_frames = if chunk.used == 0 { chunk.idle_frames + 1 } else { 0 };
            chunk.used = 0;
        }
        self.chunks.retain(|chunk| chunk.idle_frames < IDLE_FRAMES);
        self.bytes = 0;
    }

    /// Bytes handed out since the last reset.
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Copies `bytes`, which may be none, to where the device can read them.
    pub(crate) fn push(&mut self, bytes: &[u8]) -> Result<Upload, GpuError> {
        let size = bytes.len() as u64;
        let index = match self.chunks.iter().position(|chunk| chunk.fits(size)) {
            Some(index) => index,
            None => self.add_chunk(size)?,
        };
        let chunk = &mut self.chunks[index];
        let offset = chunk.used;
        chunk.buffer.write(offset, bytes)?;
        chunk.used = (offset + size).next_multiple_of(ALIGNMENT);
        self.bytes += size;
        Ok(Upload { buffer: chunk.buffer.raw(), offset, address: chunk.buffer.address() + offset })
    }

    /// As [`push`](Self::push), for a table. An empty one gets one element of zeros, so that there is always an
    /// element to read.
    pub(crate) fn push_table<T: bytemuck::Pod>(&mut self, table: &[T]) -> Result<Upload, GpuError> {
        if table.is_empty() {
            self.push(bytemuck::bytes_of(&T::zeroed()))
        } else {
            self.push(bytemuck::cast_slice(table))
        }
    }

    fn add_chunk(&mut self, size: u64) -> Result<usize, GpuError> {
        let desc = BufferDesc::new("uploads", BufferKind::Upload, size.max(CHUNK_BYTES))
            .usage(vk::BufferUsageFlags::INDEX_BUFFER | structure_input(&self.gpu));
        self.chunks.push(Chunk { buffer: self.gpu.create_buffer(&desc)?, used: 0, idle_frames: 0 });
        Ok(self.chunks.len() - 1)
    }
}

/// What acceleration structures are built from may lie here, where there are any.
fn structure_input(gpu: &Gpu) -> vk::BufferUsageFlags {
    match gpu.ray_tracing() {
        Some(_) => STRUCTURE_INPUT,
        None => vk::BufferUsageFlags::empty(),
    }
}

impl Chunk {
    fn fits(&self, size: u64) -> bool {
        self.used.checked_add(size).is_some_and(|end| end <= self.buffer.size())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::gpu;

    #[test]
    fn memory_is_handed_out_aligned_and_used_again() {
        let gpu = gpu();
        let mut arena = UploadArena::new(&gpu);
        let first = arena.push(&[1, 2, 3]).unwrap();
        let second = arena.push(&[4]).unwrap();
        assert_eq!((first.offset, second.offset), (0, ALIGNMENT));
        assert_eq!(second.address % ALIGNMENT, 0);
        assert_eq!(arena.bytes(), 4);

        let large = vec![7; CHUNK_BYTES as usize + 1];
        assert_ne!(arena.push(&large).unwrap().buffer, first.buffer);
        arena.reset();
        assert_eq!(arena.push(&[5]).unwrap(), first);
        assert_eq!(arena.chunks.len(), 2);
        for _ in 0..=IDLE_FRAMES {
            arena.reset();
        }
        assert!(arena.chunks.is_empty());
    }
}
