//! What there is on this machine to draw with, and what would be taken: for people whose game stays dark.

use std::path::PathBuf;
use std::sync::Arc;

use serde::Serialize;

use crate::device::{self, DeviceInfo};
use crate::error::{GpuError, Refusal};
use crate::gpu::{self, GpuOptions};
use crate::instance::{Drivers, Instance, InstanceOptions, Loader, OPENING_AND_CLOSING, version_text};
use crate::lavapipe::PrivateLavapipe;

/// What was found, in the order in which it is needed.
#[derive(Debug, Clone, Serialize)]
pub struct DoctorReport {
    /// The version of Vulkan that the loader is used with.
    pub loader_version: Option<String>,
    pub validation_layer: bool,
    pub private_lavapipe: PrivateLavapipeReport,
    pub devices: Vec<DeviceReport>,
    /// The device that would be taken.
    pub chosen: Option<Choice>,
    /// Why none would be.
    pub error: Option<String>,
    pub refusals: Vec<Refusal>,
}

#[derive(Debug, Clone, Serialize)]
pub struct PrivateLavapipeReport {
    pub library: Option<PathBuf>,
    /// How to get it.
    pub advice: Option<&'static str>,
}

#[derive(Debug, Clone, Serialize)]
pub struct DeviceReport {
    /// Whether it is the private lavapipe rather than one that the system lists.
    pub private: bool,
    #[serde(flatten)]
    pub info: DeviceInfo,
    /// Names of the ray-tracing abilities that the driver has.
    pub ray_tracing: Vec<&'static str>,
}

#[derive(Debug, Clone, Serialize)]
pub struct Choice {
    pub device: String,
    pub driver: String,
    pub why: &'static str,
}

/// Looks at everything, and opens nothing but instances.
pub fn examine(options: &GpuOptions) -> DoctorReport {
    let _alone = OPENING_AND_CLOSING.lock();
    let private = options.cache_folder.as_deref().and_then(PrivateLavapipe::find_in);
    let mut report = DoctorReport {
        loader_version: None,
        validation_layer: false,
        private_lavapipe: PrivateLavapipeReport::new(private.as_ref()),
        devices: Vec::new(),
        chosen: None,
        error: None,
        refusals: Vec::new(),
    };
    if let Err(error) = examine_loader(&mut report, options, private.as_ref()) {
        report.error = Some(error.to_string());
        if let GpuError::NoDevice(refusals) = error {
            report.refusals = refusals;
        }
    }
    report
}

fn examine_loader(
    report: &mut DoctorReport,
    options: &GpuOptions,
    private: Option<&PrivateLavapipe>,
) -> Result<(), GpuError> {
    let loader = Arc::new(Loader::load(options.loader.as_deref())?);
    report.loader_version = Some(version_text(loader.api_version));
    report.validation_layer = loader.has_validation();
    report.devices = devices_of(&loader, Drivers::System, false);
    if let Some(lavapipe) = private {
        let drivers = loader.private_drivers(lavapipe);
        report.devices.extend(devices_of(&loader, drivers, true));
    }
    let found = gpu::find(&loader, options)?;
    report.chosen = Some(Choice {
        why: found.why,
        device: found.candidate.info.name,
        driver: found.candidate.info.driver,
    });
    Ok(())
}

impl PrivateLavapipeReport {
    fn new(private: Option<&PrivateLavapipe>) -> Self {
        Self {
            library: private.map(|found| found.library.clone()),
            advice: private.is_none().then_some("`./x setup` in the project's folder unpacks it"),
        }
    }
}

/// The devices that some drivers list; none if they cannot even be asked.
fn devices_of(loader: &Arc<Loader>, drivers: Drivers<'_>, private: bool) -> Vec<DeviceReport> {
    let options = InstanceOptions { drivers, validation: false, synchronization_validation: false };
    Instance::new(loader.clone(), &options)
        .and_then(|instance| device::candidates(&instance))
        .unwrap_or_default()
        .into_iter()
        .map(|candidate| DeviceReport {
            private,
            ray_tracing: ray_tracing(&candidate.info),
            info: candidate.info,
        })
        .collect()
}

fn ray_tracing(info: &DeviceInfo) -> Vec<&'static str> {
    let abilities = [
        ("acceleration structures", info.features.acceleration_structure),
        ("ray-tracing pipelines", info.features.ray_tracing_pipeline),
        ("ray queries", info.features.ray_query),
    ];
    abilities.iter().filter(|(_, has)| *has).map(|(name, _)| *name).collect()
}
