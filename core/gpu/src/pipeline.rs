//! Compute pipelines, and what every pipeline is made of.

use std::ffi::CStr;
use std::sync::Arc;

use ash::vk;

use crate::commands::Commands;
use crate::error::{Doing, GpuError};
use crate::gpu::{Gpu, Shared};

/// The word that every SPIR-V module begins with.
const SPIRV_MAGIC: u32 = 0x0723_0203;

/// A compute pipeline to create.
#[derive(Debug, Clone, Copy)]
pub struct ComputeDesc<'a> {
    pub name: &'a str,
    pub spirv: &'a [u32],
    pub entry: &'a CStr,
    /// A multiple of 4, at most the device's limit.
    pub push_constant_bytes: u32,
    /// Set 0 first.
    pub set_layouts: &'a [vk::DescriptorSetLayout],
    /// Constant ids and the bits of their values.
    pub specialization: &'a [(u32, u32)],
}

impl<'a> ComputeDesc<'a> {
    pub fn new(name: &'a str, spirv: &'a [u32]) -> Self {
        Self { name, spirv, entry: c"main", push_constant_bytes: 0, set_layouts: &[], specialization: &[] }
    }

    pub fn push_constants(self, push_constant_bytes: u32) -> Self {
        Self { push_constant_bytes, ..self }
    }

    pub fn set_layouts(self, set_layouts: &'a [vk::DescriptorSetLayout]) -> Self {
        Self { set_layouts, ..self }
    }

    pub fn specialization(self, specialization: &'a [(u32, u32)]) -> Self {
        Self { specialization, ..self }
    }
}

/// A compiled compute shader with its layout. It may be dropped while in use.
pub struct ComputePipeline {
    raw: vk::Pipeline,
    layout: PipelineLayout,
}

/// How a pipeline's resources are laid out. It may be dropped while in use.
pub struct PipelineLayout {
    shared: Arc<Shared>,
    raw: vk::PipelineLayout,
    stages: vk::ShaderStageFlags,
    push_constant_bytes: u32,
}

/// A SPIR-V module, needed only until its pipelines are made.
pub struct ShaderModule {
    shared: Arc<Shared>,
    raw: vk::ShaderModule,
}

impl Gpu {
    /// Hands SPIR-V to the driver. The code itself is trusted: it comes from this project's own shaders.
    pub fn create_shader_module(&self, name: &str, spirv: &[u32]) -> Result<ShaderModule, GpuError> {
        if spirv.first() != Some(&SPIRV_MAGIC) {
            return Err(GpuError::Invalid { what: "a shader is not SPIR-V", detail: name.to_owned() });
        }
        let info = vk::ShaderModuleCreateInfo::default().code(spirv);
        // SAFETY: the code is SPIR-V from this project's compiler.
        let raw = unsafe { self.shared.device.create_shader_module(&info, None) }
            .doing("create a shader module")?;
        self.shared.set_name(raw, name);
        Ok(ShaderModule { shared: self.shared.clone(), raw })
    }

    /// A layout with one range of push constants, seen by all of `stages`.
    pub fn create_pipeline_layout(
        &self,
        set_layouts: &[vk::DescriptorSetLayout],
        stages: vk::ShaderStageFlags,
        push_constant_bytes: u32,
    ) -> Result<PipelineLayout, GpuError> {
        let most = self.limits().max_push_constants_size;
        if push_constant_bytes > most || !push_constant_bytes.is_multiple_of(4) {
            return Err(GpuError::Invalid {
                what: "push constants do not fit",
                detail: format!("{push_constant_bytes} bytes of {most}"),
            });
        }
        let ranges = [vk::PushConstantRange { stage_flags: stages, offset: 0, size: push_constant_bytes }];
        let ranges = if push_constant_bytes == 0 { &[] } else { &ranges[..] };
        let info =
            vk::PipelineLayoutCreateInfo::default().set_layouts(set_layouts).push_constant_ranges(ranges);
        // SAFETY: the set layouts are this device's.
        let raw = unsafe { self.shared.device.create_pipeline_layout(&info, None) }
            .doing("create a pipeline layout")?;
        Ok(PipelineLayout { shared: self.shared.clone(), raw, stages, push_constant_bytes })
    }

    pub fn create_compute_pipeline(&self, desc: &ComputeDesc<'_>) -> Result<ComputePipeline, GpuError> {
        let layout = self.create_pipeline_layout(
            desc.set_layouts,
            vk::ShaderStageFlags::COMPUTE,
            desc.push_constant_bytes,
        )?;
        let module = self.create_shader_module(desc.name, desc.spirv)?;
        let specialization = Specialization::new(desc.specialization);
        let specialization = specialization.info();
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module.raw)
            .name(desc.entry)
            .specialization_info(&specialization);
        let info = [vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout.raw)];
        let cache = self.shared.pipeline_cache.raw;
        // SAFETY: all that `info` points to is alive; the cache synchronises itself.
        let raw = unsafe { self.shared.device.create_compute_pipelines(cache, &info, None) }
            .map_err(|(_, result)| result)
            .doing("create a compute pipeline")?[0];
        self.shared.set_name(raw, desc.name);
        Ok(ComputePipeline { raw, layout })
    }

    /// The cache that pipelines are to be created with.
    pub fn pipeline_cache(&self) -> vk::PipelineCache {
        self.shared.pipeline_cache.raw
    }
}

/// Values of specialization constants, in the form that Vulkan takes.
pub struct Specialization {
    entries: Vec<vk::SpecializationMapEntry>,
    values: Vec<u32>,
}

impl Specialization {
    /// From constant ids and the bits of their values.
    pub fn new(constants: &[(u32, u32)]) -> Self {
        let entry = |(index, (id, _)): (usize, &(u32, u32))| vk::SpecializationMapEntry {
            constant_id: *id,
            offset: index as u32 * 4,
            size: 4,
        };
        Self {
            entries: constants.iter().enumerate().map(entry).collect(),
            values: constants.iter().map(|(_, value)| *value).collect(),
        }
    }

    pub fn info(&self) -> vk::SpecializationInfo<'_> {
        vk::SpecializationInfo::default().map_entries(&self.entries).data(bytemuck::cast_slice(&self.values))
    }
}

impl ComputePipeline {
    pub fn raw(&self) -> vk::Pipeline {
        self.raw
    }

    pub fn layout(&self) -> &PipelineLayout {
        &self.layout
    }
}

impl PipelineLayout {
    pub fn raw(&self) -> vk::PipelineLayout {
        self.raw
    }

    /// Destroys a pipeline of this layout, whose handle is given up, when the device has finished with it.
    pub(crate) fn retire_pipeline(&self, pipeline: vk::Pipeline) {
        self.shared.retire(move |shared: &Shared| {
            // SAFETY: the device has finished with it, and its handle goes with it.
            unsafe { shared.device.destroy_pipeline(pipeline, None) };
        });
    }

    /// The stages that see the push constants.
    pub fn stages(&self) -> vk::ShaderStageFlags {
        self.stages
    }
}

impl ShaderModule {
    pub fn raw(&self) -> vk::ShaderModule {
        self.raw
    }
}

impl Drop for ComputePipeline {
    fn drop(&mut self) {
        self.layout.retire_pipeline(self.raw);
    }
}

impl Drop for PipelineLayout {
    fn drop(&mut self) {
        let raw = self.raw;
        self.shared.retire(move |shared: &Shared| {
            // SAFETY: as for pipelines.
            unsafe { shared.device.destroy_pipeline_layout(raw, None) };
        });
    }
}

impl Drop for ShaderModule {
    fn drop(&mut self) {
        // SAFETY: modules are only read while pipelines are created, which borrows them.
        unsafe { self.shared.device.destroy_shader_module(self.raw, None) };
    }
}

impl Commands<'_> {
    pub fn bind_compute(&self, pipeline: &ComputePipeline) {
        // SAFETY: the pipeline is this device's.
        unsafe {
            self.device().cmd_bind_pipeline(self.raw(), vk::PipelineBindPoint::COMPUTE, pipeline.raw);
        }
    }

    /// Sets the first bytes of a layout's push constants. `T` has no padding; its layout is the shader's.
    pub fn push_constants<T: bytemuck::NoUninit>(&self, layout: &PipelineLayout, constants: &T) {
        let bytes = bytemuck::bytes_of(constants);
        debug_assert!(bytes.len() <= layout.push_constant_bytes as usize);
        // SAFETY: the layout has a range of these stages that the bytes fit.
        unsafe {
            self.device().cmd_push_constants(self.raw(), layout.raw, layout.stages, 0, bytes);
        }
    }

    pub fn bind_sets(
        &self,
        bind_point: vk::PipelineBindPoint,
        layout: &PipelineLayout,
        sets: &[vk::DescriptorSet],
    ) {
        // SAFETY: the sets are this device's, and were made with the layouts of the pipeline's layout.
        unsafe {
            self.device().cmd_bind_descriptor_sets(self.raw(), bind_point, layout.raw, 0, sets, &[]);
        }
    }

    /// Runs the bound compute pipeline with so many workgroups.
    pub fn dispatch(&self, [x, y, z]: [u32; 3]) {
        // SAFETY: a compute pipeline is bound; the validation layer checks that and the limits.
        unsafe { self.device().cmd_dispatch(self.raw(), x, y, z) };
    }

    /// Binds, pushes and dispatches in one go.
    pub fn compute<T: bytemuck::NoUninit>(
        &self,
        pipeline: &ComputePipeline,
        sets: &[vk::DescriptorSet],
        constants: &T,
        groups: [u32; 3],
    ) {
        self.bind_compute(pipeline);
        if !sets.is_empty() {
            self.bind_sets(vk::PipelineBindPoint::COMPUTE, &pipeline.layout, sets);
        }
        if size_of::<T>() > 0 {
            self.push_constants(&pipeline.layout, constants);
        }
        self.dispatch(groups);
    }
}
