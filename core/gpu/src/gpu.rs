//! One device with one queue, and how it is found.

use std::path::PathBuf;
use std::sync::Arc;

use ash::vk;
use parking_lot::Mutex;

use crate::commands::Recorder;
use crate::device::{self, Candidate, DeviceInfo, DeviceKind};
use crate::error::{Doing, GpuError, Refusal};
use crate::features::{self, Features};
use crate::garbage::Garbage;
use crate::health::{Faults, Health};
use crate::instance::{Drivers, Instance, InstanceOptions, Loader, OPENING_AND_CLOSING};
use crate::lavapipe::{self, PrivateLavapipe};
use crate::memory::Memory;
use crate::pipeline_cache::PipelineCache;
use crate::ray_tracing::RayTracing;
use crate::timeline::Timeline;

/// What to look for, and with how much checking.
#[derive(Debug, Clone)]
pub struct GpuOptions {
    /// Part of the device's name, in any case, or `lavapipe`; the best device if absent.
    pub device: Option<String>,
    /// Load the validation layer. An error if it is not installed.
    pub validation: bool,
    /// With `validation`: also find hazards between commands.
    pub synchronization_validation: bool,
    /// The Vulkan loader to use instead of the system's.
    pub loader: Option<PathBuf>,
    /// The folder that holds the private lavapipe and compiled pipelines; nothing is looked for or kept if absent.
    pub cache_folder: Option<PathBuf>,
    /// Failures to make up, for tests.
    pub faults: Faults,
}

impl Default for GpuOptions {
    fn default() -> Self {
        Self {
            device: None,
            validation: false,
            synchronization_validation: true,
            loader: None,
            cache_folder: lavapipe::cache_folder(),
            faults: Faults::default(),
        }
    }
}

impl GpuOptions {
    /// What tests run on: lavapipe under validation. The environment may name another device
    /// (`AFTERGLOW_DEVICE`) and switch validation off (`AFTERGLOW_VALIDATION=0`).
    pub fn for_tests() -> Self {
        let variable = |name| std::env::var(name).ok();
        Self {
            device: Some(variable("AFTERGLOW_DEVICE").unwrap_or_else(|| "lavapipe".to_owned())),
            validation: variable("AFTERGLOW_VALIDATION").as_deref() != Some("0"),
            ..Self::default()
        }
    }

    /// Whether software devices were asked for by name.
    fn wants_lavapipe(&self) -> bool {
        self.device
            .as_deref()
            .is_some_and(|name| ["lavapipe", "llvmpipe"].contains(&name.to_lowercase().as_str()))
    }
}

/// A Vulkan device. Cheap to clone; the device lives until its last clone and its last resource are gone.
#[derive(Clone)]
pub struct Gpu {
    pub(crate) shared: Arc<Shared>,
}

/// What every resource of a device holds on to.
pub(crate) struct Shared {
    pub(crate) device: ash::Device,
    /// Functions of extensions that Vulkan 1.3 has in its core; `None` where the core's are to be used.
    pub(crate) synchronization2: Option<ash::khr::synchronization2::Device>,
    pub(crate) dynamic_rendering: Option<ash::khr::dynamic_rendering::Device>,
    /// None on a device without acceleration structures and ray-tracing pipelines.
    pub(crate) ray_tracing: Option<RayTracing>,
    pub(crate) debug_utils: Option<ash::ext::debug_utils::Device>,
    pub(crate) queue: Mutex<vk::Queue>,
    pub(crate) memory: Memory,
    pub(crate) timeline: Timeline,
    pub(crate) health: Health,
    pub(crate) garbage: Garbage,
    pub(crate) recorder: Recorder,
    pub(crate) pipeline_cache: PipelineCache,
    pub(crate) candidate: Candidate,
    pub(crate) instance: Instance,
}

impl Gpu {
    /// Finds a device and opens it.
    ///
    /// The preferred devices are discrete, then integrated, then virtual. If none serves, or lavapipe is asked
    /// for, the private lavapipe is taken if it is set up, and else a software device of the system's.
    pub fn new(options: &GpuOptions) -> Result<Self, GpuError> {
        let _alone = OPENING_AND_CLOSING.lock();
        let loader = Arc::new(Loader::load(options.loader.as_deref())?);
        let found = find(&loader, options)?;
        let info = &found.candidate.info;
        tracing::info!(device = %info.name, driver = %info.driver, why = found.why, "device");
        open(found.instance, found.candidate, options)
    }

    /// The device's name, kind, driver and features.
    pub fn info(&self) -> &DeviceInfo {
        &self.shared.candidate.info
    }

    /// Which optional abilities the device has; all of them are enabled.
    pub fn features(&self) -> &Features {
        &self.shared.candidate.info.features
    }

    pub fn limits(&self) -> &vk::PhysicalDeviceLimits {
        &self.shared.candidate.properties.limits
    }

    /// The version of Vulkan whose functions may be called: 1.2 or 1.3.
    pub fn api_version(&self) -> u32 {
        self.shared.candidate.api_version
    }

    /// Vulkan's functions, for what this crate has no words for.
    pub fn device(&self) -> &ash::Device {
        &self.shared.device
    }

    pub fn instance(&self) -> &ash::Instance {
        &self.shared.instance.raw
    }

    pub fn entry(&self) -> &ash::Entry {
        &self.shared.instance.loader.entry
    }

    pub fn physical_device(&self) -> vk::PhysicalDevice {
        self.shared.candidate.physical
    }

    pub fn queue_family(&self) -> u32 {
        self.shared.candidate.queue_family
    }

    /// Calls `use_queue` while nobody else uses the queue.
    pub fn with_queue<T>(&self, use_queue: impl FnOnce(vk::Queue) -> T) -> T {
        use_queue(*self.shared.queue.lock())
    }

    /// What an optimal image of this format can be used for.
    pub fn format_features(&self, format: vk::Format) -> vk::FormatFeatureFlags {
        // SAFETY: a plain query on a device that is alive.
        unsafe { self.instance().get_physical_device_format_properties(self.physical_device(), format) }
            .optimal_tiling_features
    }

    /// Warnings and errors of the validation layer since the device was opened; 0 without validation.
    pub fn validation_count(&self) -> usize {
        self.shared.instance.log.count()
    }

    /// The first of the messages that [`Gpu::validation_count`] counts.
    pub fn validation_messages(&self) -> Vec<String> {
        self.shared.instance.log.texts()
    }

    /// Calls `destroy` when the device has finished all that was submitted, and what is being recorded, by now.
    pub fn retire(&self, destroy: impl FnOnce(&ash::Device) + Send + 'static) {
        self.shared.retire(move |shared: &Shared| destroy(&shared.device));
    }
}

impl Shared {
    pub(crate) fn retire(&self, destroy: impl FnOnce(&Self) + Send + 'static) {
        self.garbage.push(self.timeline.claimed(), Box::new(destroy));
    }

    /// Gives names to objects in the validation layer's messages and in debuggers.
    pub(crate) fn set_name(&self, object: impl vk::Handle, name: &str) {
        let Some(functions) = &self.debug_utils else {
            return;
        };
        let Ok(name) = std::ffi::CString::new(name) else {
            return;
        };
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(object).object_name(&name);
        // SAFETY: the object is alive and this device's. A failure would only lose a name.
        let _ = unsafe { functions.set_debug_utils_object_name(&info) };
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        let _alone = OPENING_AND_CLOSING.lock();
        // SAFETY: nothing holds the device any more, so nothing submits; after the wait nothing is in use.
        unsafe {
            // A lost device cannot be waited for; it has stopped as well.
            let _ = self.device.device_wait_idle();
            self.garbage.run_all(self);
            self.recorder.destroy(&self.device);
            self.timeline.destroy(&self.device);
            self.pipeline_cache.save_and_destroy(&self.device);
            self.memory.destroy();
            self.device.destroy_device(None);
        }
    }
}

/// A device, not yet opened, and why it is the one.
pub(crate) struct Found {
    pub(crate) instance: Instance,
    pub(crate) candidate: Candidate,
    pub(crate) why: &'static str,
}

/// Finds the device that [`Gpu::new`] opens.
pub(crate) fn find(loader: &Arc<Loader>, options: &GpuOptions) -> Result<Found, GpuError> {
    let private = options.cache_folder.as_deref().and_then(PrivateLavapipe::find_in);
    let wanted = options.device.as_deref();
    let mut refusals = Vec::new();
    if !(options.wants_lavapipe() && private.is_some()) {
        // Software of the system's is the last resort: it may be years older than the private one.
        let allow_cpu = private.is_none();
        match find_among(loader, options, Drivers::System, wanted, allow_cpu)? {
            Ok((instance, candidate)) => {
                return Ok(Found { why: why_system(wanted, candidate.info.kind), instance, candidate });
            }
            Err(list) => refusals.extend(list),
        }
    }
    if let Some(lavapipe) = &private
        && (wanted.is_none() || options.wants_lavapipe())
    {
        let drivers = loader.private_drivers(lavapipe);
        match find_among(loader, options, drivers, None, true)? {
            Ok((instance, candidate)) => {
                return Ok(Found {
                    why: match wanted {
                        Some(_) => "lavapipe was asked for, and the private one is set up",
                        None => "no graphics card serves; the private lavapipe does",
                    },
                    instance,
                    candidate,
                });
            }
            Err(list) => refusals.extend(list),
        }
    }
    Err(GpuError::NoDevice(refusals))
}

fn why_system(wanted: Option<&str>, kind: DeviceKind) -> &'static str {
    match (wanted, kind) {
        (Some(_), _) => "its name is the one asked for",
        (None, DeviceKind::Cpu) => "no graphics card serves, and no private lavapipe is set up",
        (None, _) => "it is of the best kind among those that serve",
    }
}

/// The best device of the given drivers, or why each was refused.
fn find_among(
    loader: &Arc<Loader>,
    options: &GpuOptions,
    drivers: Drivers<'_>,
    wanted: Option<&str>,
    allow_cpu: bool,
) -> Result<Result<(Instance, Candidate), Vec<Refusal>>, GpuError> {
    let instance_options = InstanceOptions {
        drivers,
        validation: options.validation,
        synchronization_validation: options.synchronization_validation,
    };
    let instance = match Instance::new(loader.clone(), &instance_options) {
        // What a loader without any driver answers.
        Err(GpuError::Vulkan { result: vk::Result::ERROR_INCOMPATIBLE_DRIVER, .. }) => {
            return Ok(Err(Vec::new()));
        }
        other => other?,
    };
    let mut candidates = device::candidates(&instance)?;
    let chosen = device::choose(candidates.iter().map(|item| &item.info), wanted, allow_cpu);
    Ok(chosen.map(|index| (instance, candidates.swap_remove(index))))
}

fn open(instance: Instance, candidate: Candidate, options: &GpuOptions) -> Result<Gpu, GpuError> {
    let device = create_device(&instance, &candidate)?;
    let parts = match Parts::new(&instance, &candidate, &device, options) {
        Ok(parts) => parts,
        Err(error) => {
            // SAFETY: nothing else holds the device yet.
            unsafe { device.destroy_device(None) };
            return Err(error);
        }
    };
    // SAFETY: the queue was asked for when the device was created.
    let queue = unsafe { device.get_device_queue(candidate.queue_family, 0) };
    let core13 = candidate.api_version >= vk::API_VERSION_1_3;
    let raw = &instance.raw;
    Ok(Gpu {
        shared: Arc::new(Shared {
            synchronization2: (!core13).then(|| ash::khr::synchronization2::Device::new(raw, &device)),
            dynamic_rendering: (!core13).then(|| ash::khr::dynamic_rendering::Device::new(raw, &device)),
            ray_tracing: RayTracing::load(&instance, &candidate, &device),
            debug_utils: instance.has_debug_utils.then(|| ash::ext::debug_utils::Device::new(raw, &device)),
            queue: Mutex::new(queue),
            memory: parts.memory,
            timeline: parts.timeline,
            health: Health::new(options.faults.clone()),
            garbage: Garbage::default(),
            recorder: parts.recorder,
            pipeline_cache: parts.pipeline_cache,
            device,
            candidate,
            instance,
        }),
    })
}

/// What an open device is given before it serves.
struct Parts {
    memory: Memory,
    timeline: Timeline,
    recorder: Recorder,
    pipeline_cache: PipelineCache,
}

impl Parts {
    fn new(
        instance: &Instance,
        candidate: &Candidate,
        device: &ash::Device,
        options: &GpuOptions,
    ) -> Result<Self, GpuError> {
        let cache_folder = options.cache_folder.as_deref();
        Ok(Self {
            memory: Memory::new(&instance.raw, device, candidate.physical, options.faults.memory)?,
            timeline: Timeline::new(device)?,
            recorder: Recorder::new(device, candidate.queue_family)?,
            pipeline_cache: PipelineCache::open(device, &candidate.properties, cache_folder)?,
        })
    }
}

fn create_device(instance: &Instance, candidate: &Candidate) -> Result<ash::Device, GpuError> {
    let priorities = [1.0];
    let queues = [vk::DeviceQueueCreateInfo::default()
        .queue_family_index(candidate.queue_family)
        .queue_priorities(&priorities)];
    let extensions = candidate.wanted_extensions(instance.has_surface());
    let features = &candidate.info.features;
    features::with_enabled(features, candidate.api_version, &candidate.extensions, |enabled| {
        let info = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .enabled_extension_names(&extensions)
            .push_next(enabled);
        let _alone = OPENING_AND_CLOSING.lock();
        // SAFETY: the physical device is this instance's, and all that `info` points to is alive.
        unsafe { instance.raw.create_device(candidate.physical, &info, None) }.doing("open the device")
    })
}
