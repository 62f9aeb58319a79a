//! Structures that last are made as small as they can be, once the device has said how small that is.

use std::sync::Arc;

use afterglow_gpu::{AccelerationStructure, Commands, CompactedSizes, Gpu, GpuError};

/// Frames after which the device has finished one.
pub(super) const FRAMES_IN_FLIGHT: u64 = 3;
/// What compaction gives back at least, as the share 1/n of a structure.
const LEAST_SHARE: u64 = 8;

/// A structure by its mesh's content.
pub(super) type Named = (u64, Arc<AccelerationStructure>);

/// A copy into a smaller structure.
pub(super) struct Smaller {
    pub(super) content: u64,
    from: Arc<AccelerationStructure>,
    pub(super) to: Arc<AccelerationStructure>,
}

struct Asked {
    frame: u64,
    sizes: CompactedSizes,
    structures: Vec<Named>,
}

/// Questions to the device, and copies that follow from its answers.
#[derive(Default)]
pub(super) struct Compaction {
    /// This frame's new structures.
    new: Vec<Named>,
    asked: Vec<Asked>,
    /// This frame's copies.
    pub(super) copies: Vec<Smaller>,
}

impl Compaction {
    /// A new frame begins: plans copies of what the device has answered for.
    pub(super) fn begin_frame(&mut self, gpu: &Gpu, frame: u64) -> Result<(), GpuError> {
        self.new.clear();
        self.copies.clear();
        let is_finished = |asked: &mut Asked| asked.frame + FRAMES_IN_FLIGHT <= frame;
        for asked in self.asked.extract_if(.., is_finished) {
            let sizes = asked.sizes.get()?.unwrap_or_default();
            for ((content, from), bytes) in asked.structures.into_iter().zip(sizes) {
                if bytes > 0 && bytes <= from.size() - from.size() / LEAST_SHARE {
                    let to = Arc::new(gpu.create_structure("mesh", false, bytes)?);
                    self.copies.push(Smaller { content, from, to });
                }
            }
        }
        Ok(())
    }

    /// Notes a structure that this frame builds.
    pub(super) fn note(&mut self, content: u64, structure: &Arc<AccelerationStructure>) {
        self.new.push((content, structure.clone()));
    }

    /// All of the frame's structures are noted.
    pub(super) fn ask(&mut self, gpu: &Gpu, frame: u64) -> Result<(), GpuError> {
        if !self.new.is_empty() {
            let sizes = gpu.create_compacted_sizes(self.new.len() as u32)?;
            self.asked.push(Asked { frame, sizes, structures: std::mem::take(&mut self.new) });
        }
        Ok(())
    }

    /// Records this frame's copies.
    pub(super) fn record_copies(&self, commands: &Commands<'_>) {
        for copy in &self.copies {
            commands.compact_structure(&copy.from, &copy.to);
        }
    }

    /// Records this frame's questions, after the builds.
    pub(super) fn record_questions(&self, commands: &Commands<'_>, frame: u64) {
        for asked in self.asked.iter().filter(|asked| asked.frame == frame) {
            let structures: Vec<_> =
                asked.structures.iter().map(|(_, structure)| structure.as_ref()).collect();
            commands.write_compacted_sizes(&asked.sizes, &structures);
        }
    }
}
