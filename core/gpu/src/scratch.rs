//! Scratch memory that builds of acceleration structures share: bounded, so builds go in chunks.

use std::ops::Range;

use ash::vk;

use crate::acceleration::StructureBuild;
use crate::barriers::Access;
use crate::buffer::{Buffer, BufferDesc, BufferKind};
use crate::commands::Commands;
use crate::error::GpuError;
use crate::gpu::Gpu;

/// Memory for builds. It grows to what is asked for, at most to its bound or to what a single build needs.
pub struct BuildScratch {
    gpu: Gpu,
    most: u64,
    alignment: u64,
    buffer: Option<Buffer>,
}

impl Gpu {
    /// Scratch memory of up to so many bytes, none of them yet.
    ///
    /// # Errors
    /// [`GpuError::Unsupported`] on a device without acceleration structures.
    pub fn create_build_scratch(&self, most_bytes: u64) -> Result<BuildScratch, GpuError> {
        let alignment = u64::from(self.shared.ray_tracing()?.limits.scratch_alignment);
        Ok(BuildScratch { gpu: self.clone(), most: most_bytes, alignment, buffer: None })
    }
}

impl BuildScratch {
    /// Makes room for builds that take so many bytes each. To be called before they are recorded.
    pub fn reserve(&mut self, builds: impl Iterator<Item = u64>) -> Result<(), GpuError> {
        let aligned = builds.map(|bytes| bytes.next_multiple_of(self.alignment));
        let (sum, largest) =
            aligned.fold((0_u64, 0), |(sum, largest), bytes| (sum.saturating_add(bytes), bytes.max(largest)));
        let needed = sum.min(self.most).max(largest);
        if needed > self.capacity() {
            let desc = BufferDesc::new("build scratch", BufferKind::Device, needed + self.alignment);
            self.buffer = Some(self.gpu.create_buffer(&desc)?);
        }
        Ok(())
    }

    /// Bytes that builds at the same time may take.
    fn capacity(&self) -> u64 {
        self.buffer.as_ref().map_or(0, |buffer| buffer.size() - self.alignment)
    }

    fn address(&self) -> vk::DeviceAddress {
        self.buffer.as_ref().map_or(0, |buffer| buffer.address().next_multiple_of(self.alignment))
    }
}

impl Commands<'_> {
    /// Builds structures that do not need each other, as many at once as there is scratch memory for, which was reserved.
    /// Later builds and copies of structures come after them.
    pub fn build_structures(&self, builds: &[StructureBuild<'_>], scratch: &BuildScratch) {
        let sizes: Vec<u64> =
            builds.iter().map(|build| build.scratch_bytes.next_multiple_of(scratch.alignment)).collect();
        for chunk in chunks(&sizes, scratch.capacity()) {
            let mut address = scratch.address();
            let addresses: Vec<_> = sizes[chunk.clone()]
                .iter()
                .map(|bytes| {
                    let own = address;
                    address += bytes;
                    own
                })
                .collect();
            self.build_chunk(&builds[chunk], &addresses);
            self.memory_barrier(Access::BUILD_STRUCTURE, Access::BUILD_STRUCTURE);
        }
    }
}

/// Ranges of builds that fit the scratch memory together; a build that does not fit it alone was not reserved for, and
/// is left out.
fn chunks(sizes: &[u64], capacity: u64) -> Vec<Range<usize>> {
    let mut chunks: Vec<Range<usize>> = Vec::new();
    let mut used = capacity;
    for (index, &bytes) in sizes.iter().enumerate() {
        if bytes > capacity {
            used = capacity;
            continue;
        }
        match chunks.last_mut() {
            Some(chunk) if chunk.end == index && used + bytes <= capacity => {
                chunk.end += 1;
                used += bytes;
            }
            _ => {
                chunks.push(index..index + 1);
                used = bytes;
            }
        }
    }
    chunks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn builds_share_memory_as_far_as_it_goes() {
        assert_eq!(chunks(&[4, 4, 4, 4], 12), [0..3, 3..4]);
        assert_eq!(chunks(&[4, 4, 4, 12, 1], 8), [0..2, 2..3, 4..5]);
        assert_eq!(chunks(&[0, 0, 1, 0], 0), [0..2, 3..4]);
        assert_eq!(chunks(&[], 8), Vec::<Range<usize>>::new());
    }
}
