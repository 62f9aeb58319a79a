//! What the validation layer says: logged, counted and kept for tests to look at.

use std::borrow::Cow;
use std::ffi::{CStr, c_void};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use ash::vk;
use parking_lot::Mutex;

use crate::error::{Doing, GpuError};

pub(crate) const LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Texts kept; later messages are only counted and logged.
const KEPT: usize = 64;

/// The warnings and errors of one instance.
#[derive(Debug, Default)]
pub struct MessageLog {
    count: AtomicUsize,
    texts: Mutex<Vec<String>>,
}

impl MessageLog {
    /// How many warnings and errors there were.
    pub fn count(&self) -> usize {
        self.count.load(Ordering::Acquire)
    }

    /// The first messages.
    pub fn texts(&self) -> Vec<String> {
        self.texts.lock().clone()
    }

    fn push(&self, text: Cow<'_, str>) {
        let mut texts = self.texts.lock();
        if texts.len() < KEPT {
            texts.push(text.into_owned());
        }
        self.count.fetch_add(1, Ordering::AcqRel);
    }
}

/// A messenger that writes to a [`MessageLog`].
pub(crate) struct Messenger {
    functions: ash::ext::debug_utils::Instance,
    raw: vk::DebugUtilsMessengerEXT,
}

impl Messenger {
    /// # Safety
    /// The log must outlive the instance: it is written to until the instance is destroyed.
    pub(crate) unsafe fn new(
        entry: &ash::Entry,
        instance: &ash::Instance,
        log: &Arc<MessageLog>,
    ) -> Result<Self, GpuError> {
        let functions = ash::ext::debug_utils::Instance::new(entry, instance);
        // SAFETY: the extension is enabled, and the caller keeps the log alive.
        let raw = unsafe { functions.create_debug_utils_messenger(&create_info(log), None) }
            .doing("create a debug messenger")?;
        Ok(Self { functions, raw })
    }

    /// # Safety
    /// The instance must still be alive, and this must be called once.
    pub(crate) unsafe fn destroy(&self) {
        // SAFETY: upheld by the caller.
        unsafe { self.functions.destroy_debug_utils_messenger(self.raw, None) };
    }
}

/// Settings of a messenger that writes to `log`, which must outlive the messenger.
pub(crate) fn create_info(log: &Arc<MessageLog>) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
    vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(
            vk::DebugUtilsMessageSeverityFlagsEXT::WARNING | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
        )
        // Not GENERAL: through it the loader reports about drivers and layers that have nothing to do with us.
        .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION)
        .pfn_user_callback(Some(on_message))
        .user_data(Arc::as_ptr(log).cast_mut().cast())
}

unsafe extern "system" fn on_message(
    severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _types: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user_data: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: `create_info` put a log there that outlives the messenger; only shared references are made of it.
    let log = unsafe { &*user_data.cast::<MessageLog>() };
    // SAFETY: Vulkan passes valid data; its message is null or a string that ends in a zero.
    let text = unsafe { (*data).message_as_c_str() }.map(CStr::to_string_lossy).unwrap_or_default();
    if severity.contains(vk::DebugUtilsMessageSeverityFlagsEXT::ERROR) {
        tracing::error!(target: "vulkan", "{text}");
    } else {
        tracing::warn!(target: "vulkan", "{text}");
    }
    log.push(text);
    vk::FALSE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flood_of_messages_is_counted_but_not_kept() {
        let log = MessageLog::default();
        for _ in 0..1000 {
            log.push("again".into());
        }
        assert_eq!(log.count(), 1000);
        assert_eq!(log.texts().len(), KEPT);
    }
}
