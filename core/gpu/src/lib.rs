//! The Vulkan base of everything that draws: device choice, memory, buffers, images, pipelines, commands.
//!
//! [`Gpu`] is one device with one queue. Resources hold it alive, and give their memory back when the device has
//! finished with them, so they can be dropped at any time.

mod acceleration;
mod barriers;
mod bindless;
mod buffer;
mod commands;
mod compaction;
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
mod ray_pipeline;
mod ray_tracing;
mod rendering;
mod sampler;
mod scratch;
mod swapchain;
mod timeline;
mod timer;
mod transfer;
mod validation;

pub use acceleration::{
    AccelerationStructure, STRUCTURE_INPUT, StructureBuild, StructureGeometry, StructureInput,
    StructureInstance, StructureShape, StructureSizes, StructureUse,
};
pub use ash::{self, vk};
pub use barriers::{Access, image_barrier, image_barrier_of, memory_barrier};
pub use bindless::{BindlessKind, BindlessSizes, BindlessTable};
pub use buffer::{Buffer, BufferDesc, BufferKind};
pub use commands::{Commands, Recording, Submission};
pub use compaction::CompactedSizes;
pub use device::{DeviceInfo, DeviceKind};
pub use error::{GpuError, Refusal};
pub use features::Features;
pub use gpu::{Gpu, GpuOptions};
pub use health::Faults;
pub use image::{Image, ImageDesc, ImageKind, ViewDesc, aspects};
pub use memory::{Heap, MemoryUse};
pub use overlay::Overlay;
pub use pipeline::{ComputeDesc, ComputePipeline, PipelineLayout, ShaderModule, Specialization};
pub use ray_pipeline::{HitGroup, RayPipeline, RayPipelineDesc};
pub use ray_tracing::RayTracingLimits;
pub use sampler::Sampler;
pub use scratch::BuildScratch;
pub use swapchain::{Presented, Swapchain, WindowSurface};
pub use timer::{GpuTimer, Scope, Timing};
pub use transfer::ImageRegion;
