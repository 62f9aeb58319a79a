//! Draws and clears of a run of operations, as OpenGL defines them.

use afterglow_gl::frame::{Cull, Draw, FixedState, Frame, Operation, Topology, VertexLayout, Viewport};
use afterglow_gpu::{BindlessTable, Commands, Gpu, GpuError, vk};
use afterglow_records::DrawPush;
use hashbrown::HashMap;

use crate::bindings::{Lookup, ResolvedBindings};
use crate::numbers::Numbers;
use crate::passes::clear::{self, LoadOps};
use crate::pipeline_state::PipelineRaster;
use crate::pipelines::{PipelineKey, Pipelines, Program, Visibility};
use crate::plan::RasterStep;
use crate::queries::{Queries, SegmentPool};
use crate::rectangles::Rectangles;
use crate::replacements::Replacements;
use crate::samplers::Samplers;
use crate::tables::DrawCommand;
use crate::target::Target;
use crate::textures::Textures;
use crate::window;

/// What a frame's pipelines are looked up by: the fixed state's number, layout, topology, clamps.
type FrameKey = (u32, VertexLayout, Topology, u32, Visibility);

/// What a draw of a traced view leaves in the visibility buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum DrawMark {
    /// What was there. With a `BAKE_` constant at `BAKE_SHIFT`.
    Kept(u32),
    /// The number of its surface plus 1, or 0 where nothing is traced; with `WHITE_ALBEDO` or without, and likewise.
    Written(u32),
}

/// Where a traced view is drawn beside the window.
#[derive(Clone, Copy)]
pub(crate) struct RasterView<'a> {
    pub(crate) visibility: vk::ImageView,
    pub(crate) albedo: vk::ImageView,
    /// The visibility buffer is empty at first.
    pub(crate) begins: bool,
    /// By the frame's numbers of draws.
    pub(crate) marks: &'a [DrawMark],
}

/// What recording draws needs from frame to frame.
pub(crate) struct RasterState {
    pub(crate) pipelines: Pipelines,
    pub(crate) samplers: Samplers,
    pub(crate) queries: Queries,
    pub(crate) bindings: ResolvedBindings,
    /// The pipelines of this frame's states.
    pub(crate) frame_pipelines: HashMap<FrameKey, vk::Pipeline>,
}

/// What a pass reads of its frame.
#[derive(Clone, Copy)]
pub(crate) struct RasterFrame<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) frame: &'a Frame,
    pub(crate) target: &'a Target,
    pub(crate) textures: &'a Textures,
    pub(crate) replacements: Option<&'a Replacements>,
    pub(crate) table: &'a BindlessTable,
    /// Address of the frame's record.
    pub(crate) address: u64,
    pub(crate) draws: &'a [DrawCommand],
    pub(crate) rectangles: &'a Rectangles,
    pub(crate) view: Option<RasterView<'a>>,
}

/// Records one run of operations.
pub(crate) struct RasterPass<'a> {
    pub(crate) commands: &'a Commands<'a>,
    pub(crate) input: RasterFrame<'a>,
    pub(crate) state: &'a mut RasterState,
    pub(crate) pool: &'a mut SegmentPool,
    pub(crate) bound: Bound,
}

/// What the command buffer has bound, so that nothing is bound twice.
#[derive(Default)]
pub(crate) struct Bound {
    pipeline: vk::Pipeline,
    key: Option<FrameKey>,
    /// The fixed state whose numbers are set.
    fixed: Option<u32>,
    numbers: Numbers,
    viewport: Option<(u32, bool)>,
    /// The bound viewport is one that draws can be seen in.
    is_visible: bool,
    index_buffer: vk::Buffer,
    /// Bindings and environment of the push constants.
    push: Option<(u32, u32)>,
}

impl RasterState {
    pub(crate) fn new(gpu: &Gpu, table: &BindlessTable) -> Result<Self, GpuError> {
        Ok(Self {
            pipelines: Pipelines::new(gpu, table)?,
            samplers: Samplers::new(gpu, table)?,
            queries: Queries::default(),
            bindings: ResolvedBindings::default(),
            frame_pipelines: HashMap::new(),
        })
    }

    /// Forgets what is numbered by the last frame's tables.
    pub(crate) fn begin_frame(&mut self, frame: &Frame) {
        self.bindings.reset(frame);
        self.frame_pipelines.clear();
    }
}

impl RasterPass<'_> {
    pub(crate) fn record(&mut self, step: &RasterStep) -> Result<(), GpuError> {
        let frame = self.input.frame;
        let size = self.input.target.size;
        let (load, start) = clear::leading(frame, step.operations.clone(), size);
        let sets = [self.input.table.set()];
        let layout = &self.state.pipelines.draw_layout;
        self.commands.bind_sets(vk::PipelineBindPoint::GRAPHICS, layout, &sets);
        let commands = *self.commands;
        rendering(&commands, self.input.target, self.input.view, &load, || {
            self.state.queries.resume(&commands, self.pool)?;
            self.operations(start..step.operations.end, step)?;
            self.state.queries.suspend(&commands, self.pool);
            Ok(())
        })
    }

    fn operations(&mut self, range: std::ops::Range<usize>, step: &RasterStep) -> Result<(), GpuError> {
        let (mut draw_number, mut rectangle) = (step.first_draw, step.first_pixels);
        let frame = self.input.frame;
        for operation in &frame.operations[range] {
            match operation {
                Operation::Draw(draw) => {
                    self.draw(draw, draw_number)?;
                    draw_number += 1;
                }
                Operation::Clear(clear) => self.clear(clear)?,
                Operation::Pixels(pixels) => {
                    self.pixels(&(&**pixels).into(), rectangle)?;
                    rectangle += 1;
                }
                Operation::CopyPixels(copy) => {
                    self.pixels(&(&**copy).into(), rectangle)?;
                    rectangle += 1;
                }
                Operation::BeginQuery(id) => {
                    self.state.queries.begin(self.commands, self.pool, *id)?;
                }
                Operation::EndQuery(_) => self.state.queries.end(self.commands, self.pool),
                // These were moved to the front, or take no commands.
                Operation::DefineImage { .. }
                | Operation::Upload(_)
                | Operation::CopyImage { .. }
                | Operation::DropImage(_) => {}
                // These end a run of drawing.
                Operation::ClearAccumulation(_) | Operation::CopyToImage(_) | Operation::Accumulate(..) => {}
            }
        }
        Ok(())
    }

    fn draw(&mut self, draw: &Draw, number: usize) -> Result<(), GpuError> {
        let command = self.input.draws[number];
        if command.index_count == 0
            || !self.bind_viewport(draw.viewport, draw.topology != Topology::Triangles)
        {
            return Ok(());
        }
        let fixed = &self.input.frame.fixed[draw.fixed as usize];
        if draw.topology == Topology::Triangles && fixed.raster.cull == Cull::FrontAndBack {
            return Ok(());
        }
        let mark = self.mark(number);
        self.bind_pipeline(draw, fixed, mark)?;
        self.bind_push(draw.bindings, draw.environment)?;
        match mark {
            Some(DrawMark::Written(word) | DrawMark::Kept(word)) => self.push_surface(word),
            None => {}
        }
        let (device, raw) = (self.commands.device(), self.commands.raw());
        // SAFETY: the pipeline's state is complete; `tables` has checked that the indices lie in their buffer.
        unsafe {
            if self.bound.index_buffer != command.index_buffer {
                self.bound.index_buffer = command.index_buffer;
                device.cmd_bind_index_buffer(raw, command.index_buffer, 0, vk::IndexType::UINT32);
            }
            // The instance's number tells the shader which draw it is.
            device.cmd_draw_indexed(raw, command.index_count, 1, command.first_index, 0, number as u32);
        }
        Ok(())
    }

    /// What a draw leaves in the visibility buffer, if there is one.
    fn mark(&self, number: usize) -> Option<DrawMark> {
        let view = self.input.view?;
        Some(view.marks.get(number).copied().unwrap_or(DrawMark::Kept(0)))
    }

    /// How pipelines treat the visibility buffer that write nothing to it.
    pub(crate) fn kept_visibility(&self) -> Visibility {
        self.input.view.map_or(Visibility::Absent, |_| Visibility::Kept)
    }

    /// Sets the number that fragments write to the visibility buffer.
    fn push_surface(&mut self, word: u32) {
        let layout = &self.state.pipelines.draw_layout;
        let offset = std::mem::offset_of!(DrawPush, pixels) as u32;
        // SAFETY: the layout's push constants are a `DrawPush`.
        unsafe {
            self.commands.device().cmd_push_constants(
                self.commands.raw(),
                layout.raw(),
                layout.stages(),
                offset,
                &word.to_ne_bytes(),
            );
        }
    }

    fn bind_pipeline(
        &mut self,
        draw: &Draw,
        fixed: &FixedState,
        mark: Option<DrawMark>,
    ) -> Result<(), GpuError> {
        let clamps = self.clamps(draw.bindings)?;
        let visibility = match mark {
            None => Visibility::Absent,
            Some(DrawMark::Kept(_)) => Visibility::Kept,
            Some(DrawMark::Written(_)) => Visibility::Written,
        };
        let key = (draw.fixed, draw.layout, draw.topology, clamps, visibility);
        if self.bound.key != Some(key) {
            let pipeline = match self.state.frame_pipelines.get(&key) {
                Some(pipeline) => *pipeline,
                None => self.find_pipeline(key, fixed)?,
            };
            self.bound.key = Some(key);
            self.set_pipeline(pipeline);
        }
        if self.bound.fixed != Some(draw.fixed) {
            self.bound.fixed = Some(draw.fixed);
            self.set_numbers(fixed);
        }
        Ok(())
    }

    fn find_pipeline(&mut self, key: FrameKey, fixed: &FixedState) -> Result<vk::Pipeline, GpuError> {
        let (_, layout, topology, clamps, visibility) = key;
        let antialiased = fixed.words.global.smooth() != 0;
        let features = self.input.gpu.features();
        let pipeline = self.state.pipelines.get(&PipelineKey {
            program: Program::Draw,
            words: fixed.words,
            layout,
            topology,
            clamps,
            raster: PipelineRaster::new(&fixed.raster, topology, antialiased, features),
            visibility,
        })?;
        self.state.frame_pipelines.insert(key, pipeline);
        Ok(pipeline)
    }

    pub(crate) fn set_pipeline(&mut self, pipeline: vk::Pipeline) {
        if self.bound.pipeline != pipeline {
            self.bound.pipeline = pipeline;
            // SAFETY: the pipeline is this device's, made for these attachments.
            unsafe {
                self.commands.device().cmd_bind_pipeline(
                    self.commands.raw(),
                    vk::PipelineBindPoint::GRAPHICS,
                    pipeline,
                );
            }
        }
    }

    pub(crate) fn set_numbers(&mut self, fixed: &FixedState) {
        let stipple = self.state.pipelines.stipple.as_ref();
        let numbers = &mut self.bound.numbers;
        numbers.set(self.commands, self.input.gpu, fixed, stipple);
    }

    /// Binds a viewport and its scissor, for lines and points (`thin`) or polygons. Says whether anything can be
    /// seen in it.
    fn bind_viewport(&mut self, index: u32, thin: bool) -> bool {
        if self.bound.viewport != Some((index, thin)) {
            let viewport = &self.input.frame.viewports[index as usize];
            let size = self.input.target.size;
            let raw = window::viewport(viewport, size, self.input.gpu.limits())
                .map(|raw| if thin { window::for_thin(raw) } else { raw });
            self.bound.viewport = Some((index, thin));
            self.bound.is_visible = raw.is_some();
            if let Some(raw) = raw {
                self.set_viewport(raw, viewport);
            }
        }
        self.bound.is_visible
    }

    pub(crate) fn set_viewport(&self, raw: vk::Viewport, viewport: &Viewport) {
        let scissor = window::scissor(viewport.scissor.as_ref(), self.input.target.size);
        let (device, buffer) = (self.commands.device(), self.commands.raw());
        // SAFETY: the viewport is within the device's limits, the scissor within the window.
        unsafe {
            device.cmd_set_viewport(buffer, 0, &[raw]);
            device.cmd_set_scissor(buffer, 0, &[scissor]);
        }
    }

    pub(crate) fn clamps(&mut self, bindings: u32) -> Result<u32, GpuError> {
        let RasterState { samplers, bindings: resolved, .. } = &mut *self.state;
        resolved.clamps(&mut lookup(&self.input, samplers), bindings)
    }

    pub(crate) fn push_of(&mut self, bindings: u32, environment: u32) -> Result<DrawPush, GpuError> {
        let RasterState { samplers, bindings: resolved, .. } = &mut *self.state;
        let mut lookup = lookup(&self.input, samplers);
        resolved.push(&mut lookup, self.input.address, bindings, environment)
    }

    fn bind_push(&mut self, bindings: u32, environment: u32) -> Result<(), GpuError> {
        if self.bound.push != Some((bindings, environment)) {
            let push = self.push_of(bindings, environment)?;
            self.commands.push_constants(&self.state.pipelines.draw_layout, &push);
            self.bound.push = Some((bindings, environment));
        }
        Ok(())
    }

    /// Forgets what a draw of another kind has bound in place of a draw's.
    pub(crate) fn unbind(&mut self) {
        self.bound.key = None;
        self.bound.fixed = None;
        self.bound.viewport = None;
        self.bound.push = None;
    }
}

fn lookup<'a>(input: &RasterFrame<'a>, samplers: &'a mut Samplers) -> Lookup<'a> {
    Lookup {
        frame: input.frame,
        textures: input.textures,
        replacements: input.replacements,
        samplers,
        table: input.table,
    }
}

/// Records draws to a target's images.
fn rendering<T>(
    commands: &Commands<'_>,
    target: &Target,
    view: Option<RasterView<'_>>,
    load: &LoadOps,
    record: impl FnOnce() -> T,
) -> T {
    let attachment = |view, layout, clear: Option<vk::ClearValue>| {
        vk::RenderingAttachmentInfo::default()
            .image_view(view)
            .image_layout(layout)
            .load_op(match clear {
                Some(_) => vk::AttachmentLoadOp::CLEAR,
                None => vk::AttachmentLoadOp::LOAD,
            })
            .store_op(vk::AttachmentStoreOp::STORE)
            .clear_value(clear.unwrap_or_default())
    };
    let depth_layout = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    let color_layout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
    let nothing = view.filter(|view| view.begins).map(|_| vk::ClearValue::default());
    let mut colors = vec![attachment(target.color.view(), color_layout, load.color())];
    if let Some(view) = view {
        colors.push(attachment(view.visibility, color_layout, nothing));
        colors.push(attachment(view.albedo, color_layout, nothing));
    }
    let depth = attachment(target.depth.view(), depth_layout, load.depth());
    let stencil = attachment(target.depth.view(), depth_layout, load.stencil());
    let info = vk::RenderingInfo::default()
        .render_area(window::whole(target.size))
        .layer_count(1)
        .color_attachments(&colors)
        .depth_attachment(&depth)
        .stencil_attachment(&stencil);
    commands.rendering(&info, record)
}
