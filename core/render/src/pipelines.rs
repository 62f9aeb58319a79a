//! Graphics pipelines: made when a state is first drawn with, and kept.

use afterglow_gl::frame::{STATE_WORDS, StateWords, Topology, VertexLayout};
use afterglow_gpu::{BindlessTable, Gpu, GpuError, PipelineLayout, ShaderModule, Specialization, vk};
use afterglow_records::{ClearPush, DrawPush};
use hashbrown::HashMap;

use crate::numbers::LineFunctions;
use crate::pathtrace::buffers::VISIBILITY_FORMAT;
use crate::pipeline_state::PipelineRaster;
use crate::target::{COLOR_FORMAT, DepthFormat};

/// Constants beside the state words: layout, topology, clamps.
const OTHER_CONSTANTS: usize = 3;

/// Mask of the views that are the sides of a cube.
pub(crate) const ALL_SIDES: u32 = 0b11_1111;

/// Which shaders a pipeline is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Program {
    /// Vertices.
    Draw,
    /// A rectangle of pixels.
    Pixels,
    /// A clear that is drawn.
    Clear,
    /// Vertices, on all sides of the cube of the sky at once.
    Sky,
    /// The same on one side.
    SkySide,
}

/// Whether a pipeline draws to the visibility buffer beside the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub(crate) enum Visibility {
    /// There is none.
    #[default]
    Absent,
    /// What it holds stays.
    Kept,
    Written,
}

/// What a pipeline depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct PipelineKey {
    pub(crate) program: Program,
    pub(crate) words: StateWords,
    pub(crate) layout: VertexLayout,
    pub(crate) topology: Topology,
    /// Coordinates that the shader clamps, three bits a unit.
    pub(crate) clamps: u32,
    pub(crate) raster: PipelineRaster,
    pub(crate) visibility: Visibility,
}

struct Modules {
    draw: ShaderModule,
    draw_clipped: ShaderModule,
    draw_fragment: ShaderModule,
    /// Without and with clip planes.
    visibility: [ShaderModule; 2],
    visibility_fragment: ShaderModule,
    pixels: ShaderModule,
    pixels_fragment: ShaderModule,
    clear: ShaderModule,
    clear_fragment: ShaderModule,
    /// None where the device has no multiview.
    sky: Option<ShaderModule>,
    sky_side: ShaderModule,
}

/// All pipelines that draw to the window.
pub(crate) struct Pipelines {
    gpu: Gpu,
    modules: Modules,
    depth_format: DepthFormat,
    /// Of draws and rectangles of pixels.
    pub(crate) draw_layout: PipelineLayout,
    pub(crate) clear_layout: PipelineLayout,
    pipelines: HashMap<PipelineKey, vk::Pipeline>,
    /// There if lines can be stippled; the pattern is then set while recording.
    pub(crate) stipple: Option<LineFunctions>,
}

impl Pipelines {
    pub(crate) fn new(gpu: &Gpu, table: &BindlessTable) -> Result<Self, GpuError> {
        let stages = vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT;
        let sets = [table.layout()];
        let features = gpu.features();
        let has_stipple = features.stippled_bresenham_lines || features.stippled_smooth_lines;
        Ok(Self {
            gpu: gpu.clone(),
            modules: Modules::new(gpu)?,
            depth_format: DepthFormat::of(gpu),
            draw_layout: gpu.create_pipeline_layout(&sets, stages, size_of::<DrawPush>() as u32)?,
            clear_layout: gpu.create_pipeline_layout(&[], stages, size_of::<ClearPush>() as u32)?,
            pipelines: HashMap::new(),
            stipple: has_stipple.then(|| LineFunctions::new(gpu.instance(), gpu.device())),
        })
    }

    /// The pipeline of a state, made now if there is none yet.
    pub(crate) fn get(&mut self, key: &PipelineKey) -> Result<vk::Pipeline, GpuError> {
        if let Some(pipeline) = self.pipelines.get(key) {
            return Ok(*pipeline);
        }
        let pipeline = self.create(key)?;
        self.pipelines.insert(*key, pipeline);
        Ok(pipeline)
    }

    /// Makes everything of the shaders as they are now. What there was stays if that fails.
    #[cfg(feature = "reload")]
    pub(crate) fn reload(&mut self) -> Result<(), GpuError> {
        self.modules = Modules::new(&self.gpu)?;
        self.retire();
        Ok(())
    }

    /// Pipelines made so far.
    pub(crate) fn len(&self) -> usize {
        self.pipelines.len()
    }

    fn create(&self, key: &PipelineKey) -> Result<vk::Pipeline, GpuError> {
        let modules = &self.modules;
        let (vertex, fragment) = match key.program {
            Program::Draw if key.words.global.clip_planes() != 0 => {
                (&modules.draw_clipped, &modules.draw_fragment)
            }
            Program::Draw => (&modules.draw, &modules.draw_fragment),
            Program::Pixels => (&modules.pixels, &modules.pixels_fragment),
            Program::Clear => (&modules.clear, &modules.clear_fragment),
            Program::Sky => (modules.sky.as_ref().unwrap_or(&modules.sky_side), &modules.draw_fragment),
            Program::SkySide => (&modules.sky_side, &modules.draw_fragment),
        };
        let (vertex, fragment) = match (key.program, key.visibility) {
            (Program::Draw, Visibility::Kept | Visibility::Written) => {
                let clipped = key.words.global.clip_planes() != 0;
                (&modules.visibility[usize::from(clipped)], &modules.visibility_fragment)
            }
            _ => (vertex, fragment),
        };
        let constants = constants(key);
        let specialization = Specialization::new(&constants);
        let specialization = specialization.info();
        let stage = |stage, module: &ShaderModule| {
            vk::PipelineShaderStageCreateInfo::default().stage(stage).module(module.raw()).name(c"main")
        };
        let mut stages =
            [stage(vk::ShaderStageFlags::VERTEX, vertex), stage(vk::ShaderStageFlags::FRAGMENT, fragment)];
        if key.program != Program::Clear {
            stages = stages.map(|stage| stage.specialization_info(&specialization));
        }
        self.create_from(key, &stages)
    }

    fn create_from(
        &self,
        key: &PipelineKey,
        stages: &[vk::PipelineShaderStageCreateInfo<'_>],
    ) -> Result<vk::Pipeline, GpuError> {
        let vertex_input = vk::PipelineVertexInputStateCreateInfo::default();
        let input_assembly =
            vk::PipelineInputAssemblyStateCreateInfo::default().topology(match key.topology {
                Topology::Points => vk::PrimitiveTopology::POINT_LIST,
                Topology::Lines => vk::PrimitiveTopology::LINE_LIST,
                Topology::Triangles => vk::PrimitiveTopology::TRIANGLE_LIST,
            });
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let mut lines = key.raster.lines();
        let mut provoking = key.raster.provoking_vertex();
        let mut rasterization = key.raster.rasterization();
        if let Some(provoking) = &mut provoking {
            rasterization = rasterization.push_next(provoking);
        }
        if let Some(lines) = &mut lines {
            rasterization = rasterization.push_next(lines);
        }
        let multisample = vk::PipelineMultisampleStateCreateInfo::default()
            .rasterization_samples(vk::SampleCountFlags::TYPE_1);
        let depth_stencil = key.raster.depth_stencil();
        let color = key.raster.blend_attachment();
        let attachments = [color, key.visibility.attachment(), color];
        let count = if key.visibility == Visibility::Absent { 1 } else { attachments.len() };
        let mut blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments[..count]);
        if let Some(op) = key.raster.logic_op() {
            blend = blend.logic_op_enable(true).logic_op(op);
        }
        let dynamic_states = self.dynamic_states();
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic_states);
        let color_formats = [COLOR_FORMAT, VISIBILITY_FORMAT, COLOR_FORMAT];
        let depth_format = match key.program {
            Program::Sky | Program::SkySide => vk::Format::UNDEFINED,
            Program::Draw | Program::Pixels | Program::Clear => self.depth_format.vulkan,
        };
        let mut rendering = vk::PipelineRenderingCreateInfo::default()
            .view_mask(if key.program == Program::Sky { ALL_SIDES } else { 0 })
            .color_attachment_formats(&color_formats[..count])
            .depth_attachment_format(depth_format)
            .stencil_attachment_format(depth_format);
        let layout = match key.program {
            Program::Clear => &self.clear_layout,
            Program::Draw | Program::Pixels | Program::Sky | Program::SkySide => &self.draw_layout,
        };
        let info = vk::GraphicsPipelineCreateInfo::default()
            .stages(stages)
            .vertex_input_state(&vertex_input)
            .input_assembly_state(&input_assembly)
            .viewport_state(&viewport)
            .rasterization_state(&rasterization)
            .multisample_state(&multisample)
            .depth_stencil_state(&depth_stencil)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(layout.raw())
            .push_next(&mut rendering);
        // SAFETY: all that `info` points to is alive; the cache synchronises itself.
        let created =
            unsafe { self.gpu.device().create_graphics_pipelines(self.gpu.pipeline_cache(), &[info], None) };
        match created {
            Ok(pipelines) => Ok(pipelines[0]),
            Err((_, result)) => Err(GpuError::Vulkan { what: "create a graphics pipeline", result }),
        }
    }

    /// Every pipeline leaves the same states to commands, so that none is lost when another is bound.
    fn dynamic_states(&self) -> Vec<vk::DynamicState> {
        let mut states = vec![
            vk::DynamicState::VIEWPORT,
            vk::DynamicState::SCISSOR,
            vk::DynamicState::LINE_WIDTH,
            vk::DynamicState::DEPTH_BIAS,
            vk::DynamicState::BLEND_CONSTANTS,
            vk::DynamicState::STENCIL_COMPARE_MASK,
            vk::DynamicState::STENCIL_WRITE_MASK,
            vk::DynamicState::STENCIL_REFERENCE,
        ];
        if self.stipple.is_some() {
            states.push(vk::DynamicState::LINE_STIPPLE_EXT);
        }
        states
    }
}

impl Pipelines {
    /// Gives all pipelines up. Commands in flight may use them.
    fn retire(&mut self) {
        let pipelines: Vec<_> = self.pipelines.drain().map(|(_, pipeline)| pipeline).collect();
        self.gpu.retire(move |device| {
            for pipeline in pipelines {
                // SAFETY: the device has finished with it, and its handle goes with it.
                unsafe { device.destroy_pipeline(pipeline, None) };
            }
        });
    }
}

impl Drop for Pipelines {
    fn drop(&mut self) {
        self.retire();
    }
}

impl Visibility {
    fn attachment(self) -> vk::PipelineColorBlendAttachmentState {
        let written = match self {
            Self::Written => vk::ColorComponentFlags::R | vk::ColorComponentFlags::G,
            Self::Absent | Self::Kept => vk::ColorComponentFlags::empty(),
        };
        vk::PipelineColorBlendAttachmentState::default().color_write_mask(written)
    }
}

impl Modules {
    fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        use afterglow_shaders as shaders;
        let module = |name, spirv| gpu.create_shader_module(name, shaders::current(spirv));
        Ok(Self {
            draw: module("raster.vert", shaders::RASTER_VERT)?,
            draw_clipped: module("clip.vert", shaders::RASTER_CLIP_VERT)?,
            draw_fragment: module("raster.frag", shaders::RASTER_FRAG)?,
            visibility: [
                module("visibility.vert", shaders::VISIBILITY_VERT)?,
                module("visibility clip.vert", shaders::VISIBILITY_CLIP_VERT)?,
            ],
            visibility_fragment: module("visibility.frag", shaders::VISIBILITY_FRAG)?,
            pixels: module("pixels.vert", shaders::PIXELS_VERT)?,
            pixels_fragment: module("pixels.frag", shaders::PIXELS_FRAG)?,
            clear: module("clear.vert", shaders::CLEAR_VERT)?,
            clear_fragment: module("clear.frag", shaders::CLEAR_FRAG)?,
            sky: gpu.features().multiview.then(|| module("sky.vert", shaders::SKY_VERT)).transpose()?,
            sky_side: module("sky side.vert", shaders::SKY_SIDE_VERT)?,
        })
    }
}

/// Specialisation constants: the state words by their numbers, then the others (see specialized.glsl).
fn constants(key: &PipelineKey) -> [(u32, u32); STATE_WORDS + OTHER_CONSTANTS] {
    let words: &[u32] = bytemuck::cast_slice(std::slice::from_ref(&key.words));
    let others = [key.layout.0, key.topology as u32, key.clamps];
    std::array::from_fn(|i| {
        let value = match i.checked_sub(STATE_WORDS) {
            None => words[i],
            Some(other) => others[other],
        };
        (i as u32, value)
    })
}
