//! A frame's plan as passes of the frame graph.

use std::ops::Range;

use afterglow_frame_graph::{
    Access, CompiledGraph, GraphBuilder, GraphError, PassKind, ResourceDesc, ResourceId, ResourceState,
};
use afterglow_gl::frame::{Frame, Operation, PixelBuffer};

use crate::passes::accumulate::Accumulated;
use crate::passes::readback::Question;
use crate::pathtrace::buffers::ViewBuffers;
use crate::pathtrace::schedule::{TraceWork, ViewResources, declare_view};
use crate::pathtrace::sky::SkyMap;
use crate::pathtrace::{PreparedTrace, denoise};
use crate::plan::{Plan, RasterStep, Step};
use crate::target::Target;

/// What a pass records.
#[derive(Debug, Clone)]
pub(crate) enum Work {
    /// The frame's new images, its early texels, and its new retained ranges.
    First(Range<usize>),
    /// A part of the plan's transfers.
    Transfers(Range<usize>),
    /// A run of drawing operations, and whether a traced view begins with it.
    Raster(RasterStep, bool),
    /// A batch of copies to textures, in three steps.
    CopyRead(usize),
    CopyFlip(usize),
    CopyWrite(usize),
    /// The pixels of this operation (glCopyPixels).
    ReadPixels(usize),
    AccumulateRead(Accumulated),
    Accumulate(Accumulated),
    AccumulateWrite(Accumulated),
    ReadBack,
    /// A pass of a traced view.
    Trace(TraceWork),
}

/// How the last frame left what lives longer than a frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lasting {
    /// Texture images, which keep their layout, as if they were one buffer.
    pub(crate) textures: ResourceState,
    /// Retained ranges.
    pub(crate) geometry: ResourceState,
    pub(crate) store: LastingBuffer,
    pub(crate) accumulation: LastingBuffer,
}

/// A buffer that lives longer than a frame, and may not be there yet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LastingBuffer {
    pub(crate) state: ResourceState,
    pub(crate) bytes: u64,
}

/// The graph's resources; the numbers of those that have been declared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Resources {
    pub(crate) color: ResourceId,
    pub(crate) depth: ResourceId,
    pub(crate) textures: ResourceId,
    pub(crate) geometry: ResourceId,
    pub(crate) store: ResourceId,
    pub(crate) accumulation: ResourceId,
}

/// A frame ready to be recorded.
pub(crate) struct Schedule {
    pub(crate) graph: CompiledGraph,
    pub(crate) resources: Resources,
    /// Those of traced views, if there are any.
    pub(crate) views: Option<ViewResources>,
    /// By the numbers of the graph's passes.
    pub(crate) work: Vec<Work>,
}

/// The views of a frame that is traced.
pub(crate) struct TracedViews<'a> {
    pub(crate) buffers: &'a ViewBuffers,
    /// How the last frame left the world's meshes, and the lists.
    pub(crate) world: [ResourceState; 2],
    pub(crate) prepared: &'a PreparedTrace,
    /// What the denoiser does.
    pub(crate) denoising: &'a denoise::Plan,
    /// The map of the sky, if rays look at it.
    pub(crate) sky: Option<&'a SkyMap>,
}

/// Declares and compiles the passes of a frame. `has_first` says whether its first step has anything to do.
pub(crate) fn schedule(
    plan: &Plan,
    frame: &Frame,
    target: &Target,
    lasting: &Lasting,
    has_first: bool,
    question: Option<&Question>,
    traced: Option<&TracedViews<'_>>,
) -> Result<Schedule, GraphError> {
    let mut graph = GraphBuilder::new();
    // The graph knows no empty buffers.
    let buffer = |bytes: u64| ResourceDesc::Buffer { bytes: bytes.max(1) };
    let resources = Resources {
        color: graph.import("color", target.color_desc(), target.color_state),
        depth: graph.import("depth", target.depth_desc(), target.depth_state),
        textures: graph.import("textures", buffer(1), lasting.textures),
        geometry: graph.import("geometry", buffer(1), lasting.geometry),
        store: graph.import("store", buffer(lasting.store.bytes), lasting.store.state),
        accumulation: graph.import(
            "accumulation",
            buffer(lasting.accumulation.bytes),
            lasting.accumulation.state,
        ),
    };
    for output in
        [resources.color, resources.depth, resources.textures, resources.geometry, resources.accumulation]
    {
        graph.output(output);
    }
    let views = traced.map(|traced| {
        let prepared = traced.prepared;
        let (backend, parity) = (prepared.backend, prepared.parity);
        let plan = traced.denoising;
        ViewResources::declare(&mut graph, traced.buffers, traced.world, backend, parity, plan, traced.sky)
    });
    let mut declaring =
        Declaring { graph, resources, views, begun: None, work: Vec::with_capacity(plan.steps.len() + 1) };
    for (index, step) in plan.steps.iter().enumerate() {
        if index > 0 || has_first {
            declaring.step(index, step, plan, frame, target.size);
        }
        if let (Some(traced), Some(view)) = (traced, plan.finished_view(index)) {
            declaring.view(view, traced);
        }
    }
    if let Some(question) = question {
        declaring.read_back(question);
    }
    Ok(Schedule {
        graph: declaring.graph.compile()?,
        resources,
        views: declaring.views,
        work: declaring.work,
    })
}

struct Declaring {
    graph: GraphBuilder,
    resources: Resources,
    views: Option<ViewResources>,
    /// The view that has been drawn to last.
    begun: Option<usize>,
    work: Vec<Work>,
}

impl Declaring {
    fn step(&mut self, index: usize, step: &Step, plan: &Plan, frame: &Frame, size: [u32; 2]) {
        match step {
            Step::Transfers(range) if index == 0 => self.first(range),
            Step::Transfers(range) => self.transfers(range),
            Step::Raster(step) => self.raster(step, frame),
            Step::Copy(batch) => self.copy(*batch, plan),
            Step::ReadPixels(operation) => self.read_pixels(*operation, frame),
            Step::Accumulate(operation) => {
                if let Some(item) = Accumulated::of(frame, *operation, size) {
                    self.accumulate(item);
                }
            }
        }
    }

    fn first(&mut self, range: &Range<usize>) {
        self.work.push(Work::First(range.clone()));
        self.graph
            .pass("upload", PassKind::Transfer)
            .read_write(self.resources.textures, Access::TransferDst)
            .read_write(self.resources.geometry, Access::TransferDst);
    }

    fn transfers(&mut self, range: &Range<usize>) {
        self.work.push(Work::Transfers(range.clone()));
        self.graph
            .pass("upload", PassKind::Transfer)
            .read_write(self.resources.textures, Access::TransferDst);
    }

    fn raster(&mut self, step: &RasterStep, frame: &Frame) {
        let begins_view = step.view.is_some() && self.begun != step.view;
        self.work.push(Work::Raster(step.clone(), begins_view));
        // Only the first operation after pixels were read can draw them.
        let draws_store = matches!(frame.operations[step.operations.start], Operation::CopyPixels(_));
        let name = if step.view.is_some() { "visibility" } else { "raster" };
        let mut pass = self.graph.pass(name, PassKind::Graphics);
        pass.read_write(self.resources.color, Access::ColorAttachment)
            .read_write(self.resources.depth, Access::DepthAttachment)
            .read(self.resources.textures, Access::StorageReadFragment)
            .read(self.resources.geometry, Access::StorageReadVertex)
            .read(self.resources.geometry, Access::IndexRead);
        if draws_store {
            pass.read(self.resources.store, Access::StorageReadFragment);
        }
        if let (Some(views), Some(_)) = (&self.views, step.view) {
            for image in [views.visibility, views.albedo] {
                match self.begun == step.view {
                    true => pass.read_write(image, Access::ColorAttachment),
                    false => pass.write(image, Access::ColorAttachment),
                };
            }
        }
        self.begun = step.view.or(self.begun);
    }

    /// The passes that light a view, which has been drawn.
    fn view(&mut self, view: usize, traced: &TracedViews<'_>) {
        let Some(views) = &self.views else { return };
        let mut work = Vec::new();
        let (prepared, denoising) = (traced.prepared, traced.denoising);
        declare_view(&mut self.graph, &mut work, &self.resources, views, view, prepared, denoising);
        self.work.extend(work.into_iter().map(Work::Trace));
    }

    fn copy(&mut self, batch: usize, plan: &Plan) {
        let Resources { color, depth, textures, store, .. } = self.resources;
        let source = if plan.batches[batch].from_depth { depth } else { color };
        self.work.push(Work::CopyRead(batch));
        self.graph
            .pass("copy to texture", PassKind::Transfer)
            .read(source, Access::TransferSrc)
            .write(store, Access::TransferDst);
        self.work.push(Work::CopyFlip(batch));
        self.graph.pass("copy to texture", PassKind::Compute).read_write(store, Access::StorageWriteCompute);
        self.work.push(Work::CopyWrite(batch));
        self.graph
            .pass("copy to texture", PassKind::Transfer)
            .read(store, Access::TransferSrc)
            .read_write(textures, Access::TransferDst);
    }

    fn read_pixels(&mut self, operation: usize, frame: &Frame) {
        let is_color = match &frame.operations[operation] {
            Operation::CopyPixels(copy) => copy.buffer == PixelBuffer::Color,
            _ => true,
        };
        let Resources { color, depth, store, .. } = self.resources;
        self.work.push(Work::ReadPixels(operation));
        self.graph
            .pass("copy pixels", PassKind::Transfer)
            .read(if is_color { color } else { depth }, Access::TransferSrc)
            .write(store, Access::TransferDst);
    }

    fn accumulate(&mut self, item: Accumulated) {
        let Resources { color, store, accumulation, .. } = self.resources;
        if item.reads_window() {
            self.work.push(Work::AccumulateRead(item));
            self.graph
                .pass("accumulate", PassKind::Transfer)
                .read(color, Access::TransferSrc)
                .write(store, Access::TransferDst);
        }
        self.work.push(Work::Accumulate(item));
        let mut pass = self.graph.pass("accumulate", PassKind::Compute);
        if item.writes_window() {
            pass.read(accumulation, Access::StorageReadCompute).write(store, Access::StorageWriteCompute);
        } else {
            pass.read_write(accumulation, Access::StorageWriteCompute);
        }
        if item.reads_window() {
            pass.read(store, Access::StorageReadCompute);
        }
        if item.writes_window() {
            self.work.push(Work::AccumulateWrite(item));
            self.graph
                .pass("accumulate", PassKind::Transfer)
                .read(store, Access::TransferSrc)
                .read_write(color, Access::TransferDst);
        }
    }

    fn read_back(&mut self, question: &Question) {
        self.work.push(Work::ReadBack);
        let source = match question {
            Question::Window { buffer: PixelBuffer::Color, .. } => self.resources.color,
            Question::Window { .. } => self.resources.depth,
            Question::Texels { .. } => self.resources.textures,
        };
        self.graph.pass("read back", PassKind::Transfer).side_effect().read(source, Access::TransferSrc);
    }
}
