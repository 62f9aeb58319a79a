//! Whether the device still works, and failures that are made up to test what follows them.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use ash::vk;

use crate::error::GpuError;
use crate::gpu::Gpu;

/// Failures to make up. Submissions are counted over all devices that are opened with clones of the same faults, so
/// that a device that takes a lost one's place is not lost at the same count again.
#[derive(Debug, Clone, Default)]
pub struct Faults {
    /// Submissions, counted from 1, that find the device lost.
    pub losses: Vec<u64>,
    /// Bytes of memory that a device has.
    pub memory: Option<u64>,
    /// Devices cannot show pictures in windows.
    pub no_windows: bool,
    submissions: Arc<AtomicU64>,
}

impl Faults {
    /// Whether all losses have come about.
    pub fn all_struck(&self) -> bool {
        self.losses.iter().all(|loss| *loss <= self.submissions.load(Ordering::Relaxed))
    }

    /// Counts a submission; whether it finds the device lost.
    fn strikes(&self) -> bool {
        !self.losses.is_empty() && {
            let count = self.submissions.fetch_add(1, Ordering::Relaxed) + 1;
            self.losses.contains(&count)
        }
    }
}

/// What is known of a device's state.
pub(crate) struct Health {
    is_lost: AtomicBool,
    pub(crate) faults: Faults,
}

impl Health {
    pub(crate) fn new(faults: Faults) -> Self {
        Self { is_lost: AtomicBool::new(false), faults }
    }

    /// Calls Vulkan, unless the device is known to be lost, and takes note if the call finds it lost.
    pub(crate) fn guard<T>(&self, call: impl FnOnce() -> Result<T, GpuError>) -> Result<T, GpuError> {
        if self.is_lost() {
            return Err(lost());
        }
        let result = call();
        if result.as_ref().is_err_and(GpuError::is_device_lost) {
            self.is_lost.store(true, Ordering::Relaxed);
        }
        result
    }

    /// As [`guard`](Self::guard), for a submission.
    pub(crate) fn guard_submission(
        &self,
        submit: impl FnOnce() -> Result<(), GpuError>,
    ) -> Result<(), GpuError> {
        self.guard(|| if self.faults.strikes() { Err(lost()) } else { submit() })
    }

    fn is_lost(&self) -> bool {
        self.is_lost.load(Ordering::Relaxed)
    }
}

impl Gpu {
    /// Whether the device was lost: then all that was made with it is of no use, and another one may be opened once
    /// that has been dropped.
    pub fn is_lost(&self) -> bool {
        self.shared.health.is_lost()
    }
}

fn lost() -> GpuError {
    GpuError::Vulkan { what: "use the device", result: vk::Result::ERROR_DEVICE_LOST }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BufferDesc, BufferKind, GpuOptions};

    fn gpu(faults: &Faults) -> Gpu {
        Gpu::new(&GpuOptions { faults: faults.clone(), ..GpuOptions::for_tests() }).unwrap()
    }

    #[test]
    fn a_device_without_windows_says_so() {
        let gpu = gpu(&Faults { no_windows: true, ..Faults::default() });
        // SAFETY: the connection is not looked at.
        let surface = unsafe { gpu.xcb_surface(std::ptr::null_mut(), 1) };
        assert!(surface.err().unwrap().to_string().contains("cannot show pictures"));
    }

    #[test]
    fn a_lost_device_stays_lost_and_another_one_serves() {
        let faults = Faults { losses: vec![2], ..Faults::default() };
        let first = gpu(&faults);
        first.run(|_| {}).unwrap();
        assert!(!first.is_lost());
        assert!(first.run(|_| {}).unwrap_err().is_device_lost());
        assert!(first.is_lost() && first.run(|_| {}).is_err() && first.wait_idle().is_err());
        assert_eq!(first.validation_count(), 0);
        drop(first);
        let second = gpu(&faults);
        (0..4).for_each(|_| second.run(|_| {}).unwrap());
        assert!(!second.is_lost() && faults.all_struck());
    }

    #[test]
    fn memory_ends_where_it_is_said_to() {
        let gpu = gpu(&Faults { memory: Some(1 << 20), ..Faults::default() });
        let buffer = |bytes| gpu.create_buffer(&BufferDesc::new("test", BufferKind::Device, bytes));
        let small = buffer(512 << 10).unwrap();
        assert!(buffer(768 << 10).err().unwrap().is_out_of_memory());
        drop(small);
        gpu.collect().unwrap();
        buffer(768 << 10).unwrap();
        assert!(!gpu.is_lost());
    }
}
