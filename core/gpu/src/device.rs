//! Which physical device serves, and which of those is taken.

use ash::vk;
use serde::Serialize;

use crate::error::{Doing, GpuError, Refusal};
use crate::features::{self, Features, OPTIONAL_EXTENSIONS};
use crate::instance::{Instance, LEAST_VERSION, Names, version_text};

/// Kinds of devices, the preferred one first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum DeviceKind {
    Discrete,
    Integrated,
    Virtual,
    Other,
    Cpu,
}

impl DeviceKind {
    /// Whether the device computes on the processor, so that its times say nothing of a graphics card.
    pub fn is_software(self) -> bool {
        self == Self::Cpu
    }
}

impl From<vk::PhysicalDeviceType> for DeviceKind {
    fn from(kind: vk::PhysicalDeviceType) -> Self {
        match kind {
            vk::PhysicalDeviceType::DISCRETE_GPU => Self::Discrete,
            vk::PhysicalDeviceType::INTEGRATED_GPU => Self::Integrated,
            vk::PhysicalDeviceType::VIRTUAL_GPU => Self::Virtual,
            vk::PhysicalDeviceType::CPU => Self::Cpu,
            _ => Self::Other,
        }
    }
}

/// What a person or a report wants to know of a device.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct DeviceInfo {
    pub name: String,
    pub kind: DeviceKind,
    /// The driver's name and version, in its own words.
    pub driver: String,
    /// The device's Vulkan version, as `1.3.255`.
    pub api_version: String,
    pub features: Features,
    /// Why it does not serve; empty if it does.
    pub refused: Vec<String>,
}

/// A physical device that was examined.
pub(crate) struct Candidate {
    pub(crate) physical: vk::PhysicalDevice,
    pub(crate) info: DeviceInfo,
    /// The highest version that both the instance and the device know.
    pub(crate) api_version: u32,
    pub(crate) properties: vk::PhysicalDeviceProperties,
    pub(crate) extensions: Names,
    /// A queue family for drawing, computing and copying.
    pub(crate) queue_family: u32,
    pub(crate) timestamp_valid_bits: u32,
}

/// Examines every device of an instance.
pub(crate) fn candidates(instance: &Instance) -> Result<Vec<Candidate>, GpuError> {
    // SAFETY: the instance is alive.
    match unsafe { instance.raw.enumerate_physical_devices() } {
        // What a loader without any driver answers.
        Err(vk::Result::ERROR_INITIALIZATION_FAILED) => Ok(Vec::new()),
        list => list.doing("list devices")?.into_iter().map(|physical| examine(instance, physical)).collect(),
    }
}

fn examine(instance: &Instance, physical: vk::PhysicalDevice) -> Result<Candidate, GpuError> {
    let raw = &instance.raw;
    // SAFETY: the physical device is the instance's, here and below.
    let properties = unsafe { raw.get_physical_device_properties(physical) };
    let api_version = properties.api_version.min(instance.loader.api_version);
    // SAFETY: as above.
    let extensions =
        unsafe { raw.enumerate_device_extension_properties(physical) }.doing("list a device's extensions")?;
    let extensions = Names::of_extensions(&extensions);
    // SAFETY: as above.
    let families = unsafe { raw.get_physical_device_queue_family_properties(physical) };
    let family = families
        .iter()
        .position(|family| family.queue_flags.contains(vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE));

    let mut refused = Vec::new();
    let mut features = Features::default();
    if properties.api_version < LEAST_VERSION {
        // Older devices do not know the structures that the features are asked with.
        refused.push(format!("only Vulkan {}", version_text(properties.api_version)));
    } else {
        let report = features::query(raw, physical, api_version, &extensions);
        features = report.features;
        refused.extend(report.missing.iter().map(|name| format!("no {name}")));
    }
    if family.is_none() {
        refused.push("no queue that draws and computes".to_owned());
    }
    Ok(Candidate {
        physical,
        info: DeviceInfo {
            name: text(properties.device_name_as_c_str()),
            kind: properties.device_type.into(),
            driver: driver_text(raw, physical, &properties),
            api_version: version_text(properties.api_version),
            features,
            refused,
        },
        api_version,
        properties,
        extensions,
        queue_family: family.map_or(0, |index| index as u32),
        timestamp_valid_bits: family.map_or(0, |index| families[index].timestamp_valid_bits),
    })
}

fn driver_text(
    instance: &ash::Instance,
    physical: vk::PhysicalDevice,
    properties: &vk::PhysicalDeviceProperties,
) -> String {
    if properties.api_version < LEAST_VERSION {
        return format!("driver {:#x}", properties.driver_version);
    }
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut root = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
    // SAFETY: the device knows Vulkan 1.2, which has this structure.
    unsafe { instance.get_physical_device_properties2(physical, &mut root) };
    format!("{} {}", text(driver.driver_name_as_c_str()), text(driver.driver_info_as_c_str()))
}

fn text<E>(name: Result<&std::ffi::CStr, E>) -> String {
    name.map_or_else(|_| "?".to_owned(), |name| name.to_string_lossy().into_owned())
}

impl Candidate {
    /// The extensions to enable.
    pub(crate) fn wanted_extensions(&self, has_surface: bool) -> Vec<*const std::ffi::c_char> {
        let ray_tracing = [
            ash::khr::deferred_host_operations::NAME,
            ash::khr::acceleration_structure::NAME,
            ash::khr::ray_tracing_pipeline::NAME,
            ash::khr::ray_query::NAME,
        ];
        OPTIONAL_EXTENSIONS
            .into_iter()
            .filter(|name| self.extensions.has(name))
            // The three others need the first two.
            .filter(|name| self.info.features.acceleration_structure || !ray_tracing.contains(name))
            .filter(|name| has_surface || *name != ash::khr::swapchain::NAME)
            .map(std::ffi::CStr::as_ptr)
            .collect()
    }
}

/// Whether `info` is what a person means by `wanted`: part of its name, in any case. `lavapipe` is what everyone
/// calls the driver whose device says `llvmpipe`.
fn is_meant(info: &DeviceInfo, wanted: &str) -> bool {
    let wanted = wanted.to_lowercase();
    let wanted = wanted.replace("lavapipe", "llvmpipe");
    info.name.to_lowercase().contains(&wanted)
}

/// Picks the best device that serves: the preferred kind, and among equals the first that the driver lists.
/// `allow_cpu` false leaves out software devices unless they were asked for by name.
pub(crate) fn choose<'a>(
    devices: impl Iterator<Item = &'a DeviceInfo>,
    wanted: Option<&str>,
    allow_cpu: bool,
) -> Result<usize, Vec<Refusal>> {
    let mut refusals = Vec::new();
    let mut best: Option<(DeviceKind, usize)> = None;
    for (index, info) in devices.enumerate() {
        let mut reasons = info.refused.clone();
        match wanted {
            Some(name) if !is_meant(info, name) => reasons.push(format!("not called {name}")),
            None if info.kind == DeviceKind::Cpu && !allow_cpu => {
                reasons.push("is software".to_owned());
            }
            _ => {}
        }
        if !reasons.is_empty() {
            refusals.push(Refusal { device: info.name.clone(), reasons });
        } else if best.is_none_or(|(kind, _)| info.kind < kind) {
            best = Some((info.kind, index));
        }
    }
    best.map(|(_, index)| index).ok_or(refusals)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn device(name: &str, kind: DeviceKind, refused: &[&str]) -> DeviceInfo {
        DeviceInfo {
            name: name.to_owned(),
            kind,
            driver: String::new(),
            api_version: "1.3.0".to_owned(),
            features: Features::default(),
            refused: refused.iter().map(ToString::to_string).collect(),
        }
    }

    #[test]
    fn the_preferred_kind_that_serves_is_taken() {
        let devices = [
            device("llvmpipe (LLVM 15)", DeviceKind::Cpu, &[]),
            device("Built In", DeviceKind::Integrated, &[]),
            device("Old Card", DeviceKind::Discrete, &["no shaderInt64"]),
            device("Card", DeviceKind::Discrete, &[]),
            device("Second Card", DeviceKind::Discrete, &[]),
        ];
        let choose = |wanted| choose(devices.iter(), wanted, true);
        assert_eq!(choose(None), Ok(3));
        assert_eq!(choose(Some("second")), Ok(4));
        assert_eq!(choose(Some("lavapipe")), Ok(0));
        assert_eq!(choose(Some("built in")), Ok(1));
    }

    #[test]
    fn refusals_give_every_reason() {
        let devices = [
            device("Old Card", DeviceKind::Discrete, &["no shaderInt64"]),
            device("llvmpipe", DeviceKind::Cpu, &[]),
        ];
        let refusals = choose(devices.iter(), None, false).unwrap_err();
        assert_eq!(refusals[0].reasons, ["no shaderInt64"]);
        assert_eq!(refusals[1].reasons, ["is software"]);
        let refusals = choose(devices.iter(), Some("card"), true).unwrap_err();
        assert_eq!(refusals[0].reasons, ["no shaderInt64"]);
        assert_eq!(refusals[1].reasons, ["not called card"]);
        assert_eq!(choose(std::iter::empty(), None, true), Err(Vec::new()));
    }
}
