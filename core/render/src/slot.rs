//! What a frame in flight keeps until the device has finished with it.

use afterglow_gpu::{Gpu, GpuError, GpuTimer, Submission};

use crate::queries::{Queries, SegmentPool};
use crate::report::FrameReport;
use crate::uploads::UploadArena;

/// Passes of a submission whose times are taken; further ones are not.
const MOST_TIMED_PASSES: u32 = 64;

/// One of the frames in flight.
pub(crate) struct Slot {
    pub(crate) arena: UploadArena,
    pub(crate) pool: SegmentPool,
    pub(crate) timer: Option<GpuTimer>,
    pub(crate) report: FrameReport,
    /// Of the frame that uses this slot; none once it was collected.
    pub(crate) submission: Option<Submission>,
}

impl Slot {
    pub(crate) fn new(gpu: &Gpu, is_timed: bool) -> Result<Self, GpuError> {
        Ok(Self {
            arena: UploadArena::new(gpu),
            pool: SegmentPool::new(gpu),
            timer: match is_timed {
                true => Some(gpu.create_timer(MOST_TIMED_PASSES)?),
                false => None,
            },
            report: FrameReport::default(),
            submission: None,
        })
    }

    /// Waits until the device has finished with the slot's frame, and takes what it has counted.
    pub(crate) fn collect(
        &mut self,
        gpu: &Gpu,
        queries: &mut Queries,
        report: &mut FrameReport,
    ) -> Result<(), GpuError> {
        let Some(submission) = self.submission.take() else {
            return Ok(());
        };
        gpu.wait(submission)?;
        queries.collect(&mut self.pool)?;
        if let Some(timer) = &self.timer {
            for timing in timer.results()? {
                self.report.add_time(&timing.name, timing.nanoseconds);
            }
        }
        report.merge(std::mem::take(&mut self.report));
        Ok(())
    }
}
