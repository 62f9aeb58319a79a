//! What can go wrong between asking for a device and getting a result from it.

use ash::vk;
use serde::Serialize;

/// A device that was looked at and not taken.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Refusal {
    /// The device's own name, or the name of what was looked for.
    pub device: String,
    /// Why it does not serve, one reason an entry.
    pub reasons: Vec<String>,
}

#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// There is no Vulkan loader, or it is older than Vulkan 1.2.
    #[error("no Vulkan: {0}")]
    NoVulkan(String),
    /// There is Vulkan, but no device that serves. Empty if it lists no device at all.
    #[error("no usable Vulkan device{}", list_refusals(.0))]
    NoDevice(Vec<Refusal>),
    #[error("validation was asked for, but the layer VK_LAYER_KHRONOS_validation is not installed")]
    NoValidationLayer,
    /// A call of Vulkan's that failed.
    #[error("could not {what}: {result}")]
    Vulkan { what: &'static str, result: vk::Result },
    #[error("could not get {bytes} bytes of device memory for {name}: {source}")]
    Memory { name: String, bytes: u64, source: gpu_allocator::AllocationError },
    /// A size, range or count that the resource or the device does not allow.
    #[error("{what}: {detail}")]
    Invalid { what: &'static str, detail: String },
    /// What is asked for is beyond the device's features.
    #[error("{device} has no {what}")]
    Unsupported { what: &'static str, device: String },
    /// The table of bindless resources of one kind has no free slot.
    #[error("all {capacity} bindless slots for {kind} are taken")]
    BindlessFull { kind: &'static str, capacity: u32 },
    /// Commands were to be recorded while the same thread was recording already.
    #[error("a recording was begun inside another")]
    NestedRecording,
    /// The device did not finish in the time allowed.
    #[error("the device did not finish within {seconds} s")]
    Timeout { seconds: u64 },
}

impl GpuError {
    /// Whether the machine lacks a device, as opposed to a device that failed.
    pub fn is_no_device(&self) -> bool {
        matches!(self, Self::NoVulkan(_) | Self::NoDevice(_))
    }

    /// Whether there was not enough memory on the device.
    pub fn is_out_of_memory(&self) -> bool {
        matches!(
            self,
            Self::Memory { .. } | Self::Vulkan { result: vk::Result::ERROR_OUT_OF_DEVICE_MEMORY, .. }
        )
    }

    /// Whether the device was lost: nothing that was created from it works any more.
    pub fn is_device_lost(&self) -> bool {
        matches!(self, Self::Vulkan { result: vk::Result::ERROR_DEVICE_LOST, .. })
    }
}

/// Says what was being done when a Vulkan call failed.
pub(crate) trait Doing<T> {
    fn doing(self, what: &'static str) -> Result<T, GpuError>;
}

impl<T> Doing<T> for Result<T, vk::Result> {
    fn doing(self, what: &'static str) -> Result<T, GpuError> {
        self.map_err(|result| GpuError::Vulkan { what, result })
    }
}

fn list_refusals(refusals: &[Refusal]) -> String {
    if refusals.is_empty() {
        return ": none is listed".to_owned();
    }
    refusals.iter().map(|refusal| format!("; {}: {}", refusal.device, refusal.reasons.join(", "))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_says_who_and_why() {
        let error = GpuError::NoDevice(vec![Refusal {
            device: "Old One".to_owned(),
            reasons: vec!["Vulkan 1.0".to_owned(), "no shaderInt64".to_owned()],
        }]);
        let text = error.to_string();
        assert!(text.contains("Old One: Vulkan 1.0, no shaderInt64"));
        assert!(error.is_no_device());
    }
}
