//! What a frame in flight keeps until the device has finished with it.

use afterglow_gpu::{DeviceKind, Gpu, GpuError, GpuTimer, Submission};

use crate::queries::{Queries, SegmentPool};
use crate::report::FrameReport;
use crate::uploads::UploadArena;

/// Passes of a submission whose times are taken; further ones are not.
const MOST_TIMED_PASSES: u32 = 64;

/// How the time of passes is taken.
pub(crate) enum PassClock {
    /// Not at all.
    None,
    /// By the device's own clock.
    Device(GpuTimer),
    /// Each pass is waited for. A processor that plays the device notes the time of drawing when it gets to it, not
    /// in the order of commands, so that its own clock says nothing.
    Host,
}

/// One of the frames in flight.
pub(crate) struct Slot {
    pub(crate) arena: UploadArena,
    pub(crate) pool: SegmentPool,
    pub(crate) clock: PassClock,
    pub(crate) report: FrameReport,
    /// Of the frame that uses this slot; none once it was collected.
    pub(crate) submission: Option<Submission>,
}

impl Slot {
    pub(crate) fn new(gpu: &Gpu, is_timed: bool) -> Result<Self, GpuError> {
        Ok(Self {
            arena: UploadArena::new(gpu),
            pool: SegmentPool::new(gpu),
            clock: match (is_timed, gpu.info().kind) {
                (false, _) => PassClock::None,
                (true, DeviceKind::Cpu) => PassClock::Host,
                (true, _) => PassClock::Device(gpu.create_timer(MOST_TIMED_PASSES)?),
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
        if let PassClock::Device(timer) = &self.clock {
            for timing in timer.results()? {
                self.report.add_time(&timing.name, timing.nanoseconds);
            }
        }
        report.merge(std::mem::take(&mut self.report));
        Ok(())
    }
}
