//! The Vulkan instance: the loader, its layers and extensions, and which drivers it is given.

use std::collections::HashSet;
use std::ffi::{CStr, CString, c_char};
use std::path::Path;
use std::sync::Arc;

use ash::vk;
use parking_lot::{Mutex, ReentrantMutex};

use crate::error::{Doing, GpuError};
use crate::lavapipe::PrivateLavapipe;
use crate::validation::{self, MessageLog, Messenger};

/// The highest version asked for; newer loaders and devices offer it too.
const WANTED_VERSION: u32 = vk::API_VERSION_1_3;
/// What the loader and a device must know.
pub(crate) const LEAST_VERSION: u32 = vk::API_VERSION_1_2;

/// Instance extensions for windows, enabled where the loader has them.
const SURFACE_EXTENSIONS: [&CStr; 6] = [
    ash::khr::surface::NAME,
    ash::khr::xcb_surface::NAME,
    ash::khr::xlib_surface::NAME,
    ash::khr::wayland_surface::NAME,
    ash::khr::win32_surface::NAME,
    ash::ext::headless_surface::NAME,
];

/// Where the loader takes drivers from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Drivers<'a> {
    /// What is installed on the system.
    System,
    /// Only the private lavapipe.
    Private(&'a PrivateLavapipe),
    /// The same, by the environment variables that older loaders read.
    PrivateByEnvironment(&'a PrivateLavapipe),
}

/// Names of layers or extensions that are there.
#[derive(Debug, Default)]
pub(crate) struct Names(HashSet<CString>);

impl Names {
    pub(crate) fn of_extensions(list: &[vk::ExtensionProperties]) -> Self {
        Self::collect(list.iter().map(|item| item.extension_name_as_c_str()))
    }

    pub(crate) fn of_layers(list: &[vk::LayerProperties]) -> Self {
        Self::collect(list.iter().map(|item| item.layer_name_as_c_str()))
    }

    pub(crate) fn has(&self, name: &CStr) -> bool {
        self.0.contains(name)
    }

    fn collect<'a, E>(names: impl Iterator<Item = Result<&'a CStr, E>>) -> Self {
        Self(names.flatten().map(CStr::to_owned).collect())
    }
}

/// A loaded Vulkan loader.
pub(crate) struct Loader {
    pub(crate) entry: ash::Entry,
    /// What the loader supports, capped at what is asked for.
    pub(crate) api_version: u32,
    extensions: Names,
    layers: Names,
    layer_extensions: Names,
}

impl Loader {
    /// Loads `library`, or the system's Vulkan loader.
    pub(crate) fn load(library: Option<&Path>) -> Result<Self, GpuError> {
        // SAFETY: loading the Vulkan loader runs its initialisers, which is what every Vulkan program does.
        let entry = unsafe {
            match library {
                Some(path) => ash::Entry::load_from(path),
                None => ash::Entry::load(),
            }
        }
        .map_err(|error| GpuError::NoVulkan(error.to_string()))?;
        // SAFETY: plain queries on a loaded entry, here and below.
        let version = unsafe { entry.try_enumerate_instance_version() }
            .doing("ask the loader's version")?
            .unwrap_or(vk::API_VERSION_1_0);
        if version < LEAST_VERSION {
            return Err(GpuError::NoVulkan(format!(
                "the loader only knows Vulkan {}",
                version_text(version)
            )));
        }
        // SAFETY: as above.
        let (extensions, layers) = unsafe {
            (entry.enumerate_instance_extension_properties(None), entry.enumerate_instance_layer_properties())
        };
        // SAFETY: as above; a missing layer is an error, and then there are none.
        let of_layer = unsafe { entry.enumerate_instance_extension_properties(Some(validation::LAYER)) };
        Ok(Self {
            api_version: version.min(WANTED_VERSION),
            extensions: Names::of_extensions(&extensions.doing("list instance extensions")?),
            layers: Names::of_layers(&layers.doing("list layers")?),
            layer_extensions: Names::of_extensions(&of_layer.unwrap_or_default()),
            entry,
        })
    }

    pub(crate) fn has_validation(&self) -> bool {
        self.layers.has(validation::LAYER)
    }

    /// How this loader is given the private lavapipe and nothing else: as a function if it knows how.
    pub(crate) fn private_drivers<'a>(&self, lavapipe: &'a PrivateLavapipe) -> Drivers<'a> {
        if self.extensions.has(ash::lunarg::direct_driver_loading::NAME) {
            Drivers::Private(lavapipe)
        } else {
            Drivers::PrivateByEnvironment(lavapipe)
        }
    }
}

/// Held while devices and instances are opened and closed: doing so on several threads at once hangs NVIDIA's
/// driver (580).
pub(crate) static OPENING_AND_CLOSING: ReentrantMutex<()> = ReentrantMutex::new(());

/// What an instance is created with.
pub(crate) struct InstanceOptions<'a> {
    pub(crate) drivers: Drivers<'a>,
    pub(crate) validation: bool,
    /// Also find hazards between commands; only with `validation`.
    pub(crate) synchronization_validation: bool,
}

/// An instance with its loader and, under validation, its messenger.
pub(crate) struct Instance {
    pub(crate) loader: Arc<Loader>,
    pub(crate) raw: ash::Instance,
    pub(crate) log: Arc<MessageLog>,
    /// Names of objects reach the validation layer's messages.
    pub(crate) has_debug_utils: bool,
    messenger: Option<Messenger>,
}

impl Instance {
    pub(crate) fn new(loader: Arc<Loader>, options: &InstanceOptions<'_>) -> Result<Self, GpuError> {
        if options.validation && !loader.has_validation() {
            return Err(GpuError::NoValidationLayer);
        }
        let log = Arc::new(MessageLog::default());
        let raw = create(&loader, options, &log)?;
        let mut instance = Self { loader, raw, log, has_debug_utils: options.validation, messenger: None };
        if options.validation {
            // SAFETY: the log lives in the same structure and is dropped after the instance is destroyed.
            let messenger = unsafe { Messenger::new(&instance.loader.entry, &instance.raw, &instance.log) };
            instance.messenger = Some(messenger?);
        }
        Ok(instance)
    }

    /// Whether an X server's windows can be drawn to, if the device can.
    pub(crate) fn knows_xcb(&self) -> bool {
        self.has_surface() && self.loader.extensions.has(ash::khr::xcb_surface::NAME)
    }

    /// Whether windows can be drawn to, if the device can.
    pub(crate) fn has_surface(&self) -> bool {
        self.loader.extensions.has(ash::khr::surface::NAME)
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        let _alone = OPENING_AND_CLOSING.lock();
        // SAFETY: whoever holds the instance has destroyed its children; nothing uses it after this.
        unsafe {
            if let Some(messenger) = &self.messenger {
                messenger.destroy();
            }
            self.raw.destroy_instance(None);
        }
    }
}

fn create(
    loader: &Loader,
    options: &InstanceOptions<'_>,
    log: &Arc<MessageLog>,
) -> Result<ash::Instance, GpuError> {
    let application = vk::ApplicationInfo::default()
        .application_name(c"afterglow")
        .engine_name(c"afterglow")
        .api_version(loader.api_version);
    let (layers, extensions) = wanted_names(loader, options);
    let mut info = vk::InstanceCreateInfo::default()
        .application_info(&application)
        .enabled_layer_names(&layers)
        .enabled_extension_names(&extensions);

    let mut messenger = validation::create_info(log);
    let enabled = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
    let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enabled);
    if options.validation {
        info = info.push_next(&mut messenger);
        if synchronization_validation(loader, options) {
            info = info.push_next(&mut features);
        }
    }

    let mut direct = Vec::new();
    if let Drivers::Private(lavapipe) = options.drivers {
        direct.push(direct_driver(&lavapipe.library)?);
    }
    let mut list = vk::DirectDriverLoadingListLUNARG::default()
        .mode(vk::DirectDriverLoadingModeLUNARG::EXCLUSIVE)
        .drivers(&direct);
    if !direct.is_empty() {
        info = info.push_next(&mut list);
    }

    let create = || {
        // SAFETY: all that `info` points to lives until the end of this function.
        unsafe { loader.entry.create_instance(&info, None) }.doing("create a Vulkan instance")
    };
    match options.drivers {
        Drivers::PrivateByEnvironment(lavapipe) => with_driver_files(&lavapipe.icd_file, create),
        Drivers::System | Drivers::Private(_) => create(),
    }
}

fn synchronization_validation(loader: &Loader, options: &InstanceOptions<'_>) -> bool {
    options.synchronization_validation && loader.layer_extensions.has(ash::ext::validation_features::NAME)
}

fn wanted_names(loader: &Loader, options: &InstanceOptions<'_>) -> (Vec<*const c_char>, Vec<*const c_char>) {
    let mut layers = Vec::new();
    let mut extensions: Vec<*const c_char> = SURFACE_EXTENSIONS
        .iter()
        .filter(|name| loader.extensions.has(name))
        .map(|name| name.as_ptr())
        .collect();
    if options.validation {
        layers.push(validation::LAYER.as_ptr());
        extensions.push(ash::ext::debug_utils::NAME.as_ptr());
        if synchronization_validation(loader, options) {
            extensions.push(ash::ext::validation_features::NAME.as_ptr());
        }
    }
    if let Drivers::Private(_) = options.drivers {
        extensions.push(ash::lunarg::direct_driver_loading::NAME.as_ptr());
    }
    (layers, extensions)
}

/// Loads a driver and finds the function through which the loader learns all its others.
fn direct_driver(library: &Path) -> Result<vk::DirectDriverLoadingInfoLUNARG<'static>, GpuError> {
    let no_driver = |error: libloading::Error| {
        GpuError::NoVulkan(format!("{} cannot be loaded: {error}", library.display()))
    };
    // SAFETY: the library is Mesa's driver; its initialisers have no requirements.
    let driver = unsafe { libloading::Library::new(library) }.map_err(no_driver)?;
    // SAFETY: every driver exports this function with this type (loader and driver interface, version 0).
    let function =
        unsafe { driver.get(b"vk_icdGetInstanceProcAddr\0") }.map(|symbol| *symbol).map_err(no_driver)?;
    // The loader does not keep the library open for us, and drivers may leave threads running: it stays loaded.
    std::mem::forget(driver);
    Ok(vk::DirectDriverLoadingInfoLUNARG { pfn_get_instance_proc_addr: Some(function), ..Default::default() })
}

/// Runs `create` while the variables that name the drivers point to `icd_file`, then puts them back.
fn with_driver_files<T>(icd_file: &Path, create: impl FnOnce() -> T) -> T {
    static ENVIRONMENT: Mutex<()> = Mutex::new(());
    const VARIABLES: [&str; 2] = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"];
    let _one_at_a_time = ENVIRONMENT.lock();
    let before = VARIABLES.map(std::env::var_os);
    if before.iter().all(|value| value.as_deref() == Some(icd_file.as_os_str())) {
        return create();
    }
    for name in VARIABLES {
        // SAFETY: this crate changes the environment only here, under a lock. C code that reads the environment
        // on another thread meanwhile could be disturbed; only loaders from before 2023 make this necessary.
        unsafe { std::env::set_var(name, icd_file) };
    }
    let result = create();
    for (name, value) in VARIABLES.iter().zip(before) {
        // SAFETY: as above.
        unsafe {
            match value {
                Some(value) => std::env::set_var(name, value),
                None => std::env::remove_var(name),
            }
        }
    }
    result
}

/// `1.3.255` for a packed version.
pub(crate) fn version_text(version: u32) -> String {
    format!(
        "{}.{}.{}",
        vk::api_version_major(version),
        vk::api_version_minor(version),
        vk::api_version_patch(version)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device;

    /// Both ways of giving the loader the private lavapipe and nothing else.
    #[test]
    fn the_private_lavapipe_is_the_only_device() {
        // The environment is changed while an instance is made.
        let _alone = OPENING_AND_CLOSING.lock();
        // Not unpacked where the system's own is recent enough.
        let Some(lavapipe) = PrivateLavapipe::find() else {
            return;
        };
        let loader = Arc::new(Loader::load(None).expect("`./x setup` installs the loader"));
        // Loaders know the first way since 1.3.250 or so, and then it is the first to be taken.
        for drivers in [loader.private_drivers(&lavapipe), Drivers::PrivateByEnvironment(&lavapipe)] {
            let before = std::env::var_os("VK_DRIVER_FILES");
            let options = InstanceOptions { drivers, validation: false, synchronization_validation: false };
            let instance = Instance::new(loader.clone(), &options).unwrap();
            let devices = device::candidates(&instance).unwrap();
            assert_eq!(devices.len(), 1, "{drivers:?}");
            assert!(devices[0].info.name.contains("llvmpipe"));
            assert_eq!(devices[0].info.refused, Vec::<String>::new());
            assert_eq!(std::env::var_os("VK_DRIVER_FILES"), before);
        }
    }
}
