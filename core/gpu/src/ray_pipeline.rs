//! Ray-tracing pipelines with their shader binding tables.

use std::ops::Range;

use ash::vk;

use crate::buffer::{Buffer, BufferDesc, BufferKind};
use crate::commands::Commands;
use crate::error::{Doing, GpuError};
use crate::gpu::Gpu;
use crate::pipeline::{PipelineLayout, ShaderModule, Specialization};
use crate::ray_tracing::{RayTracing, RayTracingLimits};

/// The stages that push constants of these pipelines are seen by.
const STAGES: vk::ShaderStageFlags = vk::ShaderStageFlags::from_raw(
    vk::ShaderStageFlags::RAYGEN_KHR.as_raw()
        | vk::ShaderStageFlags::MISS_KHR.as_raw()
        | vk::ShaderStageFlags::CLOSEST_HIT_KHR.as_raw()
        | vk::ShaderStageFlags::ANY_HIT_KHR.as_raw()
        | vk::ShaderStageFlags::INTERSECTION_KHR.as_raw(),
);

/// What happens where rays meet instances of one hit group, as SPIR-V.
#[derive(Debug, Clone, Copy, Default)]
pub struct HitGroup<'a> {
    pub closest_hit: Option<&'a [u32]>,
    pub any_hit: Option<&'a [u32]>,
    /// For boxes; triangles have none.
    pub intersection: Option<&'a [u32]>,
}

/// A ray-tracing pipeline to create. Its rays start in the ray-generation shader alone.
#[derive(Debug, Clone, Copy)]
pub struct RayPipelineDesc<'a> {
    pub name: &'a str,
    pub ray_generation: &'a [u32],
    pub miss: &'a [u32],
    /// By the instances' hit groups.
    pub hits: &'a [HitGroup<'a>],
    /// A multiple of 4, at most the device's limit; seen by all stages.
    pub push_constant_bytes: u32,
    /// Set 0 first.
    pub set_layouts: &'a [vk::DescriptorSetLayout],
    /// Constant ids and the bits of their values, for all shaders.
    pub specialization: &'a [(u32, u32)],
}

/// Compiled ray-tracing shaders with their layout and table. It may be dropped while in use.
pub struct RayPipeline {
    raw: vk::Pipeline,
    layout: PipelineLayout,
    /// Memory of the table.
    _table: Buffer,
    regions: [vk::StridedDeviceAddressRegionKHR; 3],
    most_invocations: u32,
}

impl Gpu {
    /// Compiles a pipeline.
    ///
    /// # Errors
    /// [`GpuError::Unsupported`] on a device without ray-tracing pipelines.
    pub fn create_ray_pipeline(&self, desc: &RayPipelineDesc<'_>) -> Result<RayPipeline, GpuError> {
        let ray_tracing = self.shared.ray_tracing()?;
        let layout = self.create_pipeline_layout(desc.set_layouts, STAGES, desc.push_constant_bytes)?;
        let shaders = Shaders::new(self, desc)?;
        let raw = self.compile(ray_tracing, desc, &shaders, &layout)?;
        self.shared.set_name(raw, desc.name);
        // From here on the pipeline is destroyed with this value.
        let raw = OwnedPipeline { raw, layout: Some(layout) };
        let handles = handles(ray_tracing, raw.raw, shaders.groups.len() as u32)?;
        let plan = TablePlan::new(&ray_tracing.limits, desc.hits.len() as u64);
        let (table, first) = self.create_table(desc.name, &plan, &handles, &ray_tracing.limits)?;
        let regions = plan.regions(first);
        let (raw, layout) = raw.into_parts()?;
        let most_invocations = ray_tracing.limits.invocations;
        Ok(RayPipeline { raw, layout, _table: table, regions, most_invocations })
    }

    fn compile(
        &self,
        ray_tracing: &RayTracing,
        desc: &RayPipelineDesc<'_>,
        shaders: &Shaders,
        layout: &PipelineLayout,
    ) -> Result<vk::Pipeline, GpuError> {
        let specialization = Specialization::new(desc.specialization);
        let specialization = specialization.info();
        let stages: Vec<_> = shaders
            .modules
            .iter()
            .map(|(stage, module)| {
                vk::PipelineShaderStageCreateInfo::default()
                    .stage(*stage)
                    .module(module.raw())
                    .name(c"main")
                    .specialization_info(&specialization)
            })
            .collect();
        let info = [vk::RayTracingPipelineCreateInfoKHR::default()
            .stages(&stages)
            .groups(&shaders.groups)
            .max_pipeline_ray_recursion_depth(1)
            .layout(layout.raw())];
        // SAFETY: all that `info` points to is alive; the cache synchronises itself.
        let pipelines = unsafe {
            ray_tracing.pipelines.create_ray_tracing_pipelines(
                vk::DeferredOperationKHR::null(),
                self.pipeline_cache(),
                &info,
                None,
            )
        };
        Ok(pipelines.map_err(|(_, result)| result).doing("create a ray-tracing pipeline")?[0])
    }

    /// The table's memory, and the address of its first region.
    fn create_table(
        &self,
        name: &str,
        plan: &TablePlan,
        handles: &[u8],
        limits: &RayTracingLimits,
    ) -> Result<(Buffer, vk::DeviceAddress), GpuError> {
        let alignment = u64::from(limits.base_alignment);
        let desc = BufferDesc::new(name, BufferKind::Upload, plan.bytes + alignment)
            .usage(vk::BufferUsageFlags::SHADER_BINDING_TABLE_KHR);
        let mut buffer = self.create_buffer(&desc)?;
        let first = buffer.address().next_multiple_of(alignment);
        let start = first - buffer.address();
        for (group, handle) in handles.chunks_exact(limits.handle_bytes as usize).enumerate() {
            buffer.write(start + plan.offset(group as u64), handle)?;
        }
        Ok((buffer, first))
    }
}

/// Modules and groups of a pipeline: ray generation, miss, then hits.
struct Shaders {
    modules: Vec<(vk::ShaderStageFlags, ShaderModule)>,
    groups: Vec<vk::RayTracingShaderGroupCreateInfoKHR<'static>>,
}

impl Shaders {
    fn new(gpu: &Gpu, desc: &RayPipelineDesc<'_>) -> Result<Self, GpuError> {
        let mut shaders = Self { modules: Vec::new(), groups: Vec::new() };
        for (stage, spirv) in [
            (vk::ShaderStageFlags::RAYGEN_KHR, desc.ray_generation),
            (vk::ShaderStageFlags::MISS_KHR, desc.miss),
        ] {
            let shader = shaders.add(gpu, desc.name, stage, Some(spirv))?;
            shaders.groups.push(group(vk::RayTracingShaderGroupTypeKHR::GENERAL).general_shader(shader));
        }
        for hit in desc.hits {
            let kind = match hit.intersection {
                Some(_) => vk::RayTracingShaderGroupTypeKHR::PROCEDURAL_HIT_GROUP,
                None => vk::RayTracingShaderGroupTypeKHR::TRIANGLES_HIT_GROUP,
            };
            let mut add = |stage, spirv| shaders.add(gpu, desc.name, stage, spirv);
            let hit_group = group(kind)
                .closest_hit_shader(add(vk::ShaderStageFlags::CLOSEST_HIT_KHR, hit.closest_hit)?)
                .any_hit_shader(add(vk::ShaderStageFlags::ANY_HIT_KHR, hit.any_hit)?)
                .intersection_shader(add(vk::ShaderStageFlags::INTERSECTION_KHR, hit.intersection)?);
            shaders.groups.push(hit_group);
        }
        Ok(shaders)
    }

    /// Adds a shader, if there is one. Returns its number.
    fn add(
        &mut self,
        gpu: &Gpu,
        name: &str,
        stage: vk::ShaderStageFlags,
        spirv: Option<&[u32]>,
    ) -> Result<u32, GpuError> {
        let Some(spirv) = spirv else {
            return Ok(vk::SHADER_UNUSED_KHR);
        };
        self.modules.push((stage, gpu.create_shader_module(name, spirv)?));
        Ok(self.modules.len() as u32 - 1)
    }
}

/// A group without shaders.
fn group(kind: vk::RayTracingShaderGroupTypeKHR) -> vk::RayTracingShaderGroupCreateInfoKHR<'static> {
    vk::RayTracingShaderGroupCreateInfoKHR::default()
        .ty(kind)
        .general_shader(vk::SHADER_UNUSED_KHR)
        .closest_hit_shader(vk::SHADER_UNUSED_KHR)
        .any_hit_shader(vk::SHADER_UNUSED_KHR)
        .intersection_shader(vk::SHADER_UNUSED_KHR)
}

fn handles(ray_tracing: &RayTracing, pipeline: vk::Pipeline, groups: u32) -> Result<Vec<u8>, GpuError> {
    let bytes = groups as usize * ray_tracing.limits.handle_bytes as usize;
    // SAFETY: the pipeline has so many groups.
    unsafe { ray_tracing.pipelines.get_ray_tracing_shader_group_handles(pipeline, 0, groups, bytes) }
        .doing("read the handles of shader groups")
}

/// Where the handles of groups lie in a table: the ray-generation group, the miss group, the hit groups.
#[derive(Debug, Clone, PartialEq, Eq)]
struct TablePlan {
    /// Bytes from one record of a region to the next.
    stride: u64,
    /// Bytes of each region.
    regions: [Range<u64>; 3],
    bytes: u64,
}

impl TablePlan {
    fn new(limits: &RayTracingLimits, hits: u64) -> Self {
        let stride = u64::from(limits.handle_bytes).next_multiple_of(u64::from(limits.handle_alignment));
        let base = u64::from(limits.base_alignment);
        let mut end = 0;
        let regions = [1, 1, hits].map(|records| {
            let start = u64::next_multiple_of(end, base);
            end = start + records * stride;
            start..end
        });
        Self { stride, regions, bytes: end }
    }

    /// Where the handle of a group goes.
    fn offset(&self, group: u64) -> u64 {
        match group {
            0 | 1 => self.regions[group as usize].start,
            hit => self.regions[2].start + (hit - 2) * self.stride,
        }
    }

    fn regions(&self, first: vk::DeviceAddress) -> [vk::StridedDeviceAddressRegionKHR; 3] {
        self.regions.clone().map(|bytes| vk::StridedDeviceAddressRegionKHR {
            device_address: first + bytes.start,
            stride: self.stride,
            size: bytes.end - bytes.start,
        })
    }
}

/// A pipeline that goes with its layout, unless it is taken out.
struct OwnedPipeline {
    raw: vk::Pipeline,
    layout: Option<PipelineLayout>,
}

impl OwnedPipeline {
    fn into_parts(mut self) -> Result<(vk::Pipeline, PipelineLayout), GpuError> {
        let layout = self.layout.take();
        let layout =
            layout.ok_or(GpuError::Invalid { what: "a pipeline has no layout", detail: String::new() })?;
        Ok((self.raw, layout))
    }
}

impl Drop for OwnedPipeline {
    fn drop(&mut self) {
        if let Some(layout) = &self.layout {
            layout.retire_pipeline(self.raw);
        }
    }
}

impl RayPipeline {
    pub fn layout(&self) -> &PipelineLayout {
        &self.layout
    }
}

impl Drop for RayPipeline {
    fn drop(&mut self) {
        self.layout.retire_pipeline(self.raw);
    }
}

impl Commands<'_> {
    /// Binds, pushes and starts so many invocations of the ray-generation shader. More than the device takes at once are
    /// left out.
    pub fn trace_rays<T: bytemuck::NoUninit>(
        &self,
        pipeline: &RayPipeline,
        sets: &[vk::DescriptorSet],
        constants: &T,
        [width, height]: [u32; 2],
    ) {
        let Some(ray_tracing) = &self.shared.ray_tracing else {
            return;
        };
        let height = height.min(pipeline.most_invocations / width.max(1));
        let point = vk::PipelineBindPoint::RAY_TRACING_KHR;
        // SAFETY: the pipeline is this device's.
        unsafe { self.device().cmd_bind_pipeline(self.raw(), point, pipeline.raw) };
        if !sets.is_empty() {
            self.bind_sets(point, &pipeline.layout, sets);
        }
        if size_of::<T>() > 0 {
            self.push_constants(&pipeline.layout, constants);
        }
        let [generation, miss, hit] = &pipeline.regions;
        let callable = vk::StridedDeviceAddressRegionKHR::default();
        // SAFETY: the pipeline is bound, and the regions are those of its own table.
        unsafe {
            ray_tracing.pipelines.cmd_trace_rays(
                self.raw(),
                generation,
                miss,
                hit,
                &callable,
                width,
                height,
                1,
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits(handle_bytes: u32, handle_alignment: u32, base_alignment: u32) -> RayTracingLimits {
        RayTracingLimits {
            handle_bytes,
            handle_alignment,
            base_alignment,
            scratch_alignment: 128,
            invocations: 1 << 30,
            primitives: 1 << 29,
            geometries: 1 << 24,
            instances: 1 << 24,
        }
    }

    #[test]
    fn records_and_regions_are_aligned() {
        let plan = TablePlan::new(&limits(32, 32, 64), 2);
        assert_eq!((plan.stride, plan.bytes), (32, 192));
        assert_eq!(plan.regions, [0..32, 64..96, 128..192]);
        assert_eq!([0, 1, 2, 3].map(|group| plan.offset(group)), [0, 64, 128, 160]);
        let plan = TablePlan::new(&limits(20, 16, 64), 3);
        assert_eq!(plan.stride, 32);
        let regions = plan.regions(1 << 32);
        // The ray-generation region has one record.
        assert_eq!((regions[0].size, regions[0].stride), (32, 32));
        assert!(regions.iter().all(|region| region.device_address.is_multiple_of(64)));
        assert_eq!(TablePlan::new(&limits(32, 32, 64), 0).regions[2], 128..128);
    }
}
