//! Samplers.

use std::sync::Arc;

use ash::vk;

use crate::error::{Doing, GpuError};
use crate::gpu::{Gpu, Shared};

/// A sampler. It may be dropped while in use.
pub struct Sampler {
    shared: Arc<Shared>,
    raw: vk::Sampler,
}

impl Gpu {
    /// Creates a sampler. Anisotropy, custom borders and mirror-once need the features of the same name.
    pub fn create_sampler(&self, info: &vk::SamplerCreateInfo<'_>) -> Result<Sampler, GpuError> {
        // SAFETY: the device is alive; the validation layer checks the description.
        let raw = unsafe { self.shared.device.create_sampler(info, None) }.doing("create a sampler")?;
        Ok(Sampler { shared: self.shared.clone(), raw })
    }
}

impl Sampler {
    pub fn raw(&self) -> vk::Sampler {
        self.raw
    }
}

impl Drop for Sampler {
    fn drop(&mut self) {
        let raw = self.raw;
        self.shared.retire(move |shared: &Shared| {
            // SAFETY: the device has finished with it, and its handle goes with it.
            unsafe { shared.device.destroy_sampler(raw, None) };
        });
    }
}
