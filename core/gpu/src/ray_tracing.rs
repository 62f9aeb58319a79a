//! What a device has for hardware ray tracing: Vulkan's functions and the limits that callers must keep.

use ash::vk;

use crate::device::Candidate;
use crate::gpu::{Gpu, Shared};
use crate::instance::Instance;

/// Limits of acceleration structures and ray-tracing pipelines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct RayTracingLimits {
    /// Bytes of a shader group's handle.
    pub handle_bytes: u32,
    /// Records of a shader binding table lie at multiples of so many bytes.
    pub handle_alignment: u32,
    /// The parts of a shader binding table begin at multiples of so many bytes.
    pub base_alignment: u32,
    /// Scratch memory of a build begins at a multiple of so many bytes.
    pub scratch_alignment: u32,
    /// Invocations of one trace.
    pub invocations: u32,
    /// Primitives of one bottom level.
    pub primitives: u64,
    /// Geometries of one bottom level.
    pub geometries: u64,
    /// Instances of one top level.
    pub instances: u64,
}

/// Functions and limits of a device that traces rays.
pub(crate) struct RayTracing {
    pub(crate) structures: ash::khr::acceleration_structure::Device,
    pub(crate) pipelines: ash::khr::ray_tracing_pipeline::Device,
    pub(crate) limits: RayTracingLimits,
}

impl RayTracing {
    /// None on a device without ray-tracing pipelines.
    pub(crate) fn load(instance: &Instance, candidate: &Candidate, device: &ash::Device) -> Option<Self> {
        let features = &candidate.info.features;
        (features.acceleration_structure && features.ray_tracing_pipeline).then(|| Self {
            structures: ash::khr::acceleration_structure::Device::new(&instance.raw, device),
            pipelines: ash::khr::ray_tracing_pipeline::Device::new(&instance.raw, device),
            limits: query_limits(&instance.raw, candidate.physical),
        })
    }
}

fn query_limits(instance: &ash::Instance, physical: vk::PhysicalDevice) -> RayTracingLimits {
    let mut structures = vk::PhysicalDeviceAccelerationStructurePropertiesKHR::default();
    let mut pipelines = vk::PhysicalDeviceRayTracingPipelinePropertiesKHR::default();
    let mut root =
        vk::PhysicalDeviceProperties2::default().push_next(&mut structures).push_next(&mut pipelines);
    // SAFETY: the device has the extensions that these structures belong to.
    unsafe { instance.get_physical_device_properties2(physical, &mut root) };
    RayTracingLimits {
        handle_bytes: pipelines.shader_group_handle_size,
        handle_alignment: pipelines.shader_group_handle_alignment.max(1),
        base_alignment: pipelines.shader_group_base_alignment.max(1),
        scratch_alignment: structures.min_acceleration_structure_scratch_offset_alignment.max(1),
        invocations: pipelines.max_ray_dispatch_invocation_count,
        primitives: structures.max_primitive_count,
        geometries: structures.max_geometry_count,
        instances: structures.max_instance_count,
    }
}

impl Gpu {
    /// The limits of hardware ray tracing; none on a device without acceleration structures and ray-tracing pipelines.
    pub fn ray_tracing(&self) -> Option<&RayTracingLimits> {
        self.shared.ray_tracing.as_ref().map(|ray_tracing| &ray_tracing.limits)
    }
}

impl Shared {
    /// The functions, or why there are none.
    pub(crate) fn ray_tracing(&self) -> Result<&RayTracing, crate::GpuError> {
        self.ray_tracing.as_ref().ok_or_else(|| crate::GpuError::Unsupported {
            what: "ray-tracing pipelines",
            device: self.candidate.info.name.clone(),
        })
    }
}
