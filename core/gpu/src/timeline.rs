//! The count of submissions: a timeline semaphore that the device advances by one each.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use ash::vk;

use crate::error::{Doing, GpuError};

/// Longer than any sane submission takes, on a software device as well.
const PATIENCE: Duration = Duration::from_secs(300);

pub(crate) struct Timeline {
    pub(crate) semaphore: vk::Semaphore,
    /// The value of the last submission.
    submitted: AtomicU64,
    /// The value of the recording in progress, or of the last submission.
    claimed: AtomicU64,
}

impl Timeline {
    pub(crate) fn new(device: &ash::Device) -> Result<Self, GpuError> {
        let mut kind = vk::SemaphoreTypeCreateInfo::default().semaphore_type(vk::SemaphoreType::TIMELINE);
        let info = vk::SemaphoreCreateInfo::default().push_next(&mut kind);
        // SAFETY: the device has timeline semaphores enabled.
        let semaphore =
            unsafe { device.create_semaphore(&info, None) }.doing("create a timeline semaphore")?;
        Ok(Self { semaphore, submitted: AtomicU64::new(0), claimed: AtomicU64::new(0) })
    }

    /// Begins a recording; only one at a time.
    pub(crate) fn claim(&self) -> u64 {
        let value = self.submitted() + 1;
        self.claimed.store(value, Ordering::Release);
        value
    }

    /// The recording was submitted.
    pub(crate) fn commit(&self, value: u64) {
        self.submitted.store(value, Ordering::Release);
    }

    /// The recording was thrown away.
    pub(crate) fn abandon(&self) {
        self.claimed.store(self.submitted(), Ordering::Release);
    }

    pub(crate) fn submitted(&self) -> u64 {
        self.submitted.load(Ordering::Acquire)
    }

    /// The value after which the device uses nothing that can be reached now.
    pub(crate) fn claimed(&self) -> u64 {
        self.claimed.load(Ordering::Acquire)
    }

    /// The value of the last submission that the device has finished.
    pub(crate) fn completed(&self, device: &ash::Device) -> Result<u64, GpuError> {
        // SAFETY: the semaphore is alive and a timeline semaphore.
        unsafe { device.get_semaphore_counter_value(self.semaphore) }.doing("ask how far the device is")
    }

    /// Waits until the device has finished submission `value`, which must have been submitted.
    pub(crate) fn wait(&self, device: &ash::Device, value: u64) -> Result<(), GpuError> {
        let semaphores = [self.semaphore];
        let values = [value];
        let info = vk::SemaphoreWaitInfo::default().semaphores(&semaphores).values(&values);
        let nanoseconds = PATIENCE.as_nanos() as u64;
        // SAFETY: as in `completed`.
        match unsafe { device.wait_semaphores(&info, nanoseconds) } {
            Err(vk::Result::TIMEOUT) => Err(GpuError::Timeout { seconds: PATIENCE.as_secs() }),
            other => other.doing("wait for the device"),
        }
    }

    /// # Safety
    /// The device must be idle, and this must be called once.
    pub(crate) unsafe fn destroy(&self, device: &ash::Device) {
        // SAFETY: upheld by the caller.
        unsafe { device.destroy_semaphore(self.semaphore, None) };
    }
}
