//! What a device can do beyond what is required: asked for, never assumed.

use std::ffi::CStr;

use ash::vk;
use serde::Serialize;

use crate::instance::Names;

/// Device extensions that are enabled wherever the device has them.
pub(crate) const OPTIONAL_EXTENSIONS: [&CStr; 16] = [
    ash::khr::synchronization2::NAME,
    ash::khr::dynamic_rendering::NAME,
    ash::khr::swapchain::NAME,
    ash::khr::deferred_host_operations::NAME,
    ash::khr::acceleration_structure::NAME,
    ash::khr::ray_tracing_pipeline::NAME,
    ash::khr::ray_query::NAME,
    ash::khr::fragment_shader_barycentric::NAME,
    ash::ext::line_rasterization::NAME,
    ash::ext::provoking_vertex::NAME,
    ash::ext::custom_border_color::NAME,
    ash::ext::depth_clip_enable::NAME,
    ash::ext::depth_clip_control::NAME,
    ash::ext::extended_dynamic_state3::NAME,
    ash::ext::primitive_topology_list_restart::NAME,
    ash::ext::memory_budget::NAME,
];

/// Defines `Features` and how each of its fields is read from, and written to, Vulkan's structures.
macro_rules! features {
    ($($(#[$doc:meta])* $name:ident = $($structure:ident).+ ;)*) => {
        /// Optional abilities of a device, all enabled where they are there. Extensions' abilities are named after
        /// the extension's feature.
        #[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
        #[non_exhaustive]
        pub struct Features {
            $($(#[$doc])* pub $name: bool,)*
        }

        impl Features {
            fn read(chain: &FeatureChain) -> Self {
                Self { $($name: chain.$($structure).+ != vk::FALSE,)* }
            }

            fn write(&self, chain: &mut FeatureChain) {
                $(chain.$($structure).+ = self.$name.into();)*
            }
        }
    };
}

features! {
    dual_source_blend = core.dual_src_blend;
    independent_blend = core.independent_blend;
    fill_mode_non_solid = core.fill_mode_non_solid;
    large_points = core.large_points;
    wide_lines = core.wide_lines;
    sampler_anisotropy = core.sampler_anisotropy;
    shader_clip_distance = core.shader_clip_distance;
    shader_cull_distance = core.shader_cull_distance;
    depth_clamp = core.depth_clamp;
    depth_bias_clamp = core.depth_bias_clamp;
    logic_op = core.logic_op;
    geometry_shader = core.geometry_shader;
    image_cube_array = core.image_cube_array;
    multi_draw_indirect = core.multi_draw_indirect;
    draw_indirect_first_instance = core.draw_indirect_first_instance;
    occlusion_query_precise = core.occlusion_query_precise;
    fragment_stores_and_atomics = core.fragment_stores_and_atomics;
    vertex_stores_and_atomics = core.vertex_pipeline_stores_and_atomics;
    storage_image_extended_formats = core.shader_storage_image_extended_formats;
    storage_image_read_without_format = core.shader_storage_image_read_without_format;
    storage_image_write_without_format = core.shader_storage_image_write_without_format;
    shader_float64 = core.shader_float64;
    shader_int16 = core.shader_int16;
    texture_compression_bc = core.texture_compression_bc;
    storage_16bit = v11.storage_buffer16_bit_access;
    multiview = v11.multiview;
    shader_draw_parameters = v11.shader_draw_parameters;
    storage_8bit = v12.storage_buffer8_bit_access;
    shader_float16 = v12.shader_float16;
    shader_int8 = v12.shader_int8;
    buffer_int64_atomics = v12.shader_buffer_int64_atomics;
    sampler_mirror_clamp_to_edge = v12.sampler_mirror_clamp_to_edge;
    shader_output_layer = v12.shader_output_layer;
    bresenham_lines = lines.bresenham_lines;
    rectangular_lines = lines.rectangular_lines;
    smooth_lines = lines.smooth_lines;
    stippled_bresenham_lines = lines.stippled_bresenham_lines;
    stippled_rectangular_lines = lines.stippled_rectangular_lines;
    stippled_smooth_lines = lines.stippled_smooth_lines;
    provoking_vertex_last = provoking_vertex.provoking_vertex_last;
    custom_border_colors = border_color.custom_border_colors;
    custom_border_color_without_format = border_color.custom_border_color_without_format;
    depth_clip_enable = depth_clip_enable.depth_clip_enable;
    /// Clip space may have z from -w to w, as OpenGL has it.
    depth_clip_control = depth_clip_control.depth_clip_control;
    dynamic_color_blend_enable = dynamic_state3.extended_dynamic_state3_color_blend_enable;
    dynamic_color_blend_equation = dynamic_state3.extended_dynamic_state3_color_blend_equation;
    dynamic_color_write_mask = dynamic_state3.extended_dynamic_state3_color_write_mask;
    dynamic_logic_op_enable = dynamic_state3.extended_dynamic_state3_logic_op_enable;
    dynamic_polygon_mode = dynamic_state3.extended_dynamic_state3_polygon_mode;
    dynamic_depth_clamp_enable = dynamic_state3.extended_dynamic_state3_depth_clamp_enable;
    dynamic_depth_clip_enable = dynamic_state3.extended_dynamic_state3_depth_clip_enable;
    dynamic_provoking_vertex = dynamic_state3.extended_dynamic_state3_provoking_vertex_mode;
    dynamic_line_stipple_enable = dynamic_state3.extended_dynamic_state3_line_stipple_enable;
    dynamic_line_rasterization_mode =
        dynamic_state3.extended_dynamic_state3_line_rasterization_mode;
    list_restart = list_restart.primitive_topology_list_restart;
    fragment_shader_barycentric = barycentric.fragment_shader_barycentric;
    acceleration_structure = acceleration_structure.acceleration_structure;
    ray_tracing_pipeline = ray_tracing_pipeline.ray_tracing_pipeline;
    ray_query = ray_query.ray_query;
}

/// Defines `REQUIRED`: the features without which a device does not serve.
macro_rules! required {
    ($($name:literal = $($structure:ident).+ ;)*) => {
        fn missing(chain: &FeatureChain) -> Vec<&'static str> {
            let all = [$(($name, chain.$($structure).+),)*];
            all.into_iter().filter(|(_, has)| *has == vk::FALSE).map(|(name, _)| name).collect()
        }

        fn enable_required(chain: &mut FeatureChain) {
            $(chain.$($structure).+ = vk::TRUE;)*
        }
    };
}

required! {
    "shaderInt64" = core.shader_int64;
    "shaderSampledImageArrayDynamicIndexing" = core.shader_sampled_image_array_dynamic_indexing;
    "shaderStorageImageArrayDynamicIndexing" = core.shader_storage_image_array_dynamic_indexing;
    "bufferDeviceAddress" = v12.buffer_device_address;
    "timelineSemaphore" = v12.timeline_semaphore;
    "scalarBlockLayout" = v12.scalar_block_layout;
    "descriptorIndexing" = v12.descriptor_indexing;
    "runtimeDescriptorArray" = v12.runtime_descriptor_array;
    "descriptorBindingPartiallyBound" = v12.descriptor_binding_partially_bound;
    "descriptorBindingUpdateUnusedWhilePending" =
        v12.descriptor_binding_update_unused_while_pending;
    "descriptorBindingSampledImageUpdateAfterBind" =
        v12.descriptor_binding_sampled_image_update_after_bind;
    "descriptorBindingStorageImageUpdateAfterBind" =
        v12.descriptor_binding_storage_image_update_after_bind;
    "shaderSampledImageArrayNonUniformIndexing" =
        v12.shader_sampled_image_array_non_uniform_indexing;
    "hostQueryReset" = v12.host_query_reset;
    "synchronization2" = synchronization2.synchronization2;
    "dynamicRendering" = dynamic_rendering.dynamic_rendering;
}

/// Vulkan's feature structures, to be asked with and to create a device with.
#[derive(Default)]
pub(crate) struct FeatureChain {
    core: vk::PhysicalDeviceFeatures,
    v11: vk::PhysicalDeviceVulkan11Features<'static>,
    v12: vk::PhysicalDeviceVulkan12Features<'static>,
    synchronization2: vk::PhysicalDeviceSynchronization2Features<'static>,
    dynamic_rendering: vk::PhysicalDeviceDynamicRenderingFeatures<'static>,
    lines: vk::PhysicalDeviceLineRasterizationFeaturesKHR<'static>,
    provoking_vertex: vk::PhysicalDeviceProvokingVertexFeaturesEXT<'static>,
    border_color: vk::PhysicalDeviceCustomBorderColorFeaturesEXT<'static>,
    depth_clip_enable: vk::PhysicalDeviceDepthClipEnableFeaturesEXT<'static>,
    depth_clip_control: vk::PhysicalDeviceDepthClipControlFeaturesEXT<'static>,
    dynamic_state3: vk::PhysicalDeviceExtendedDynamicState3FeaturesEXT<'static>,
    list_restart: vk::PhysicalDevicePrimitiveTopologyListRestartFeaturesEXT<'static>,
    barycentric: vk::PhysicalDeviceFragmentShaderBarycentricFeaturesKHR<'static>,
    acceleration_structure: vk::PhysicalDeviceAccelerationStructureFeaturesKHR<'static>,
    ray_tracing_pipeline: vk::PhysicalDeviceRayTracingPipelineFeaturesKHR<'static>,
    ray_query: vk::PhysicalDeviceRayQueryFeaturesKHR<'static>,
}

impl FeatureChain {
    /// Chains the structures that the device knows. Call it once for a chain: a structure that is chained twice
    /// points to itself.
    fn link(&mut self, api_version: u32, extensions: &Names) -> vk::PhysicalDeviceFeatures2<'_> {
        let core13 = api_version >= vk::API_VERSION_1_3;
        let mut root = vk::PhysicalDeviceFeatures2::default()
            .features(self.core)
            .push_next(&mut self.v11)
            .push_next(&mut self.v12);
        macro_rules! link_if {
            ($($condition:expr => $field:ident),* $(,)?) => {
                $(if $condition { root = root.push_next(&mut self.$field); })*
            };
        }
        link_if! {
            core13 || extensions.has(ash::khr::synchronization2::NAME) => synchronization2,
            core13 || extensions.has(ash::khr::dynamic_rendering::NAME) => dynamic_rendering,
            extensions.has(ash::ext::line_rasterization::NAME) => lines,
            extensions.has(ash::ext::provoking_vertex::NAME) => provoking_vertex,
            extensions.has(ash::ext::custom_border_color::NAME) => border_color,
            extensions.has(ash::ext::depth_clip_enable::NAME) => depth_clip_enable,
            extensions.has(ash::ext::depth_clip_control::NAME) => depth_clip_control,
            extensions.has(ash::ext::extended_dynamic_state3::NAME) => dynamic_state3,
            extensions.has(ash::ext::primitive_topology_list_restart::NAME) => list_restart,
            extensions.has(ash::khr::fragment_shader_barycentric::NAME) => barycentric,
            has_acceleration_structure(extensions) => acceleration_structure,
            has_ray_tracing_pipeline(extensions) => ray_tracing_pipeline,
            has_ray_query(extensions) => ray_query,
        }
        root
    }
}

fn has_acceleration_structure(extensions: &Names) -> bool {
    extensions.has(ash::khr::acceleration_structure::NAME)
        && extensions.has(ash::khr::deferred_host_operations::NAME)
}

fn has_ray_tracing_pipeline(extensions: &Names) -> bool {
    has_acceleration_structure(extensions) && extensions.has(ash::khr::ray_tracing_pipeline::NAME)
}

fn has_ray_query(extensions: &Names) -> bool {
    has_acceleration_structure(extensions) && extensions.has(ash::khr::ray_query::NAME)
}

/// What was found out about a device's features.
pub(crate) struct FeatureReport {
    pub(crate) features: Features,
    pub(crate) missing: Vec<&'static str>,
}

/// Asks a device, which must know Vulkan 1.2, for its features.
pub(crate) fn query(
    instance: &ash::Instance,
    physical: vk::PhysicalDevice,
    api_version: u32,
    extensions: &Names,
) -> FeatureReport {
    let mut chain = FeatureChain::default();
    let mut root = chain.link(api_version, extensions);
    // SAFETY: the chain only holds structures that the device knows.
    unsafe { instance.get_physical_device_features2(physical, &mut root) };
    chain.core = root.features;
    FeatureReport { features: Features::read(&chain), missing: missing(&chain) }
}

/// Calls `create` with the chain that enables the required features and the given optional ones.
pub(crate) fn with_enabled<T>(
    features: &Features,
    api_version: u32,
    extensions: &Names,
    create: impl FnOnce(&mut vk::PhysicalDeviceFeatures2<'_>) -> T,
) -> T {
    let mut chain = FeatureChain::default();
    features.write(&mut chain);
    enable_required(&mut chain);
    create(&mut chain.link(api_version, extensions))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let features = Features {
            wide_lines: true,
            multiview: true,
            stippled_bresenham_lines: true,
            ..Features::default()
        };
        let mut chain = FeatureChain::default();
        features.write(&mut chain);
        assert_eq!(Features::read(&chain), features);
        assert!(missing(&chain).contains(&"timelineSemaphore"));
        enable_required(&mut chain);
        assert!(missing(&chain).is_empty());
    }
}
