//! The Vulkan base of everything that draws: device choice, memory, buffers, images, pipelines, commands.
//!
//! [`Gpu`] is one device with one queue. Resources hold it alive, and give their memory back when the device has
//! finished with them, so they can be dropped at any time.

mod barriers;
mod bindless;
mod buffer;
mod commands;
mod device;
pub mod doctor;
mod error;
mod features;
mod garbage;
mod gpu;
mod health;
mod image;
mod instance;
pub mod lavapipe;
mod memory;
mod overlay;
mod pipeline;
mod pipeline_cache;
mod rendering;
mod sampler;
mod swapchain;
mod timeline;
mod timer;
mod transfer;
mod validation;

pub use ash::{self, vk};
pub use barriers::{Access, image_barrier, image_barrier_of, memory_barrier};
pub use bindless::{BindlessKind, BindlessSizes, BindlessTable};
pub use buffer::{Buffer, BufferDesc, BufferKind};
pub use commands::{Commands, Recording, Submission};
pub use device::{DeviceInfo, DeviceKind};
pub use error::{GpuError, Refusal};
pub use features::Features;
pub use gpu::{Gpu, GpuOptions};
pub use health::Faults;
pub use image::{Image, ImageDesc, ImageKind, ViewDesc, aspects};
pub use memory::{Heap, MemoryUse};
pub use overlay::Overlay;
pub use pipeline::{ComputeDesc, ComputePipeline, PipelineLayout, ShaderModule, Specialization};
pub use sampler::Sampler;
pub use swapchain::{Presented, Swapchain, WindowSurface};
pub use timer::{GpuTimer, Scope, Timing};
pub use transfer::ImageRegion;
