//! One frame from its operations to a submission.

use std::time::Instant;

use afterglow_gl::frame::Frame;
use afterglow_gpu::{Commands, GpuError};

use crate::error::RenderError;
use crate::graph::{Bound, record_barriers};
use crate::passes::accumulate::Accumulated;
use crate::passes::copy::{self, FlipRecords};
use crate::passes::raster::{self, RasterFrame, RasterPass, RasterView};
use crate::passes::readback::{Question, Readback};
use crate::passes::{pixels, transfers};
use crate::pathtrace::schedule::TraceWork;
use crate::pathtrace::{self, PreparedTrace, TraceContext, TraceInput, Tracing, Understood};
use crate::plan::{Plan, Planner, Step};
use crate::rectangles::PixelStore;
use crate::renderer::Renderer;
use crate::replacements::Replacements;
use crate::report::{FrameReport, SceneReport};
use crate::retained::RangeCopy;
use crate::schedule::{Lasting, LastingBuffer, Schedule, TracedViews, Work, schedule};
use crate::slot::PassClock;
use crate::tables::{self, Uploaded};

/// What is ready to be recorded.
struct Prepared {
    plan: Plan,
    schedule: Schedule,
    /// Address of the frame's record.
    address: u64,
    range_copies: Vec<RangeCopy>,
    /// Of each batch of copies to textures.
    flips: Vec<FlipRecords>,
    readback: Option<Readback>,
    traced: Option<PreparedTrace>,
}

impl Renderer {
    /// Makes the window as large as the frame says.
    pub(crate) fn resize(&mut self, frame: &Frame) -> Result<(), GpuError> {
        let most = self.gpu.limits().max_image_dimension2_d;
        let size = [frame.size.0, frame.size.1].map(|side| side.clamp(1, most));
        if size != self.target.size {
            self.target = self.target.resized(&self.gpu, size)?;
        }
        Ok(())
    }

    /// Executes a frame, and reads what `question` asks for. `understood` is what is known of it, if its world is to be
    /// traced.
    pub(crate) fn execute_and_read(
        &mut self,
        frame: &Frame,
        question: Option<Question>,
        understood: Option<&Understood>,
    ) -> Result<Option<Readback>, RenderError> {
        #[cfg(feature = "reload")]
        self.reload_shaders();
        self.collect(self.current)?;
        self.resize(frame)?;
        self.slots[self.current].arena.reset();
        self.ranges.begin_frame();
        self.raster.begin_frame(frame);
        let tracing = understood.and_then(|understood| understood.tracing.as_ref());
        self.replace_textures(frame);
        let prepared = self.prepare(frame, question, tracing)?;
        let recorded = self.record(frame, &prepared);
        if recorded.is_err() {
            let pool = &mut self.slots[self.current].pool;
            self.raster.queries.abandon(pool);
            if let Some(tracer) = &mut self.tracer {
                tracer.forget();
            }
        }
        recorded?;
        let rasterized = tracing.map_or(frame.operations.len(), |tracing| tracing.rasterized);
        self.note(frame, rasterized, &prepared, understood.map(|understood| understood.report.clone()));
        self.advance();
        for image in &prepared.plan.dropped {
            self.textures.remove(&self.table, *image);
        }
        if let Some(replacements) = &mut self.replacements {
            replacements.end_frame(&prepared.plan.dropped);
        }
        Ok(prepared.readback)
    }

    /// Finds what replaces the textures of a frame.
    fn replace_textures(&mut self, frame: &Frame) {
        let (Some(replacements), Some(tracer)) = (&mut self.replacements, &mut self.tracer) else { return };
        if replacements.begin_frame(frame, &tracer.recovery) {
            tracer.forget();
        }
    }

    /// Plans the frame, and uploads what it needs.
    fn prepare(
        &mut self,
        frame: &Frame,
        question: Option<Question>,
        tracing: Option<&Tracing>,
    ) -> Result<Prepared, RenderError> {
        let size = self.target.size;
        let arena = &mut self.slots[self.current].arena;
        let planner = Planner {
            textures: &mut self.textures,
            table: &self.table,
            arena,
            size,
            views: tracing.map_or(&[], |tracing| &tracing.arrangement.views),
            arrived: self.replacements.as_mut().map(Replacements::take_arrived).unwrap_or_default(),
            operations: tracing.map_or(frame.operations.len(), |tracing| tracing.rasterized),
        };
        let mut plan = planner.plan(frame)?;
        plan.dropped.extend(self.replacements.iter_mut().flat_map(Replacements::take_dropped));
        self.reserve(frame, &plan)?;
        let arena = &mut self.slots[self.current].arena;
        let store = PixelStore {
            address: self.store.address(),
            has_depth24: self.target.depth_format.maximum() != 0,
        };
        self.rectangles.prepare(frame, size, store, arena)?;
        let records = &self.rectangles.records;
        let (uploaded, range_copies) =
            tables::upload(frame, records, size, arena, &mut self.ranges, &mut self.scratch)?;
        let flip = |batch| copy::prepare(batch, &self.store, arena);
        let flips = plan.batches.iter().map(flip).collect::<Result<_, _>>()?;
        let traced = match tracing {
            Some(tracing) => self.try_trace(frame, &uploaded, tracing)?,
            None => None,
        };
        let views = match (&self.tracer, &traced) {
            (Some(tracer), Some(prepared)) => tracer.buffers.as_ref().map(|buffers| TracedViews {
                buffers,
                world: [tracer.world_state, tracer.lists_state],
                prepared,
                denoising: &tracer.plan,
                sky: tracer.sky.as_ref().filter(|_| prepared.sky.is_mapped()),
            }),
            _ => None,
        };
        let lasting = Lasting {
            textures: self.texture_state,
            geometry: self.geometry_state,
            store: LastingBuffer { state: self.store.state, bytes: self.store.bytes() },
            accumulation: LastingBuffer { state: self.accumulator.state, bytes: self.accumulator.bytes() },
        };
        let has_first = !plan.defined.is_empty()
            || !range_copies.is_empty()
            || matches!(plan.steps.first(), Some(Step::Transfers(range)) if !range.is_empty());
        let question = question.as_ref();
        let schedule = schedule(&plan, frame, &self.target, &lasting, has_first, question, views.as_ref())?;
        let readback = question.map(|question| Readback::new(&self.gpu, *question));
        let (address, readback) = (uploaded.address, readback.transpose()?);
        Ok(Prepared { plan, schedule, address, range_copies, flips, readback, traced })
    }

    /// As [`prepare_trace`](Self::prepare_trace). Where there is not enough memory, this frame is rasterized already.
    fn try_trace(
        &mut self,
        frame: &Frame,
        uploaded: &Uploaded,
        tracing: &Tracing,
    ) -> Result<Option<PreparedTrace>, GpuError> {
        match self.prepare_trace(frame, uploaded, tracing) {
            Err(error) if error.is_out_of_memory() => {
                self.trace_no_more(&error.into());
                Ok(None)
            }
            other => other,
        }
    }

    /// Makes what the passes of a frame's views read.
    fn prepare_trace(
        &mut self,
        frame: &Frame,
        uploaded: &Uploaded,
        tracing: &Tracing,
    ) -> Result<Option<PreparedTrace>, GpuError> {
        let (Some(tracer), Some(camera)) = (&mut self.tracer, &tracing.scene.camera) else {
            return Ok(None);
        };
        let views = tracing.arrangement.views.len();
        tracer.reserve(&self.gpu, &self.table, &self.target, views)?;
        let input = TraceInput {
            gpu: &self.gpu,
            frame,
            uploaded,
            scratch: &self.scratch,
            raster: &mut self.raster,
            textures: &self.textures,
            replacements: self.replacements.as_ref(),
            table: &self.table,
            arena: &mut self.slots[self.current].arena,
        };
        pathtrace::prepare(tracer, input, tracing, camera, self.target.size).map(Some)
    }

    /// Makes room for what passes leave to the next ones.
    fn reserve(&mut self, frame: &Frame, plan: &Plan) -> Result<(), GpuError> {
        let size = self.target.size;
        let mut bytes = plan.batches.iter().map(copy::store_bytes).max().unwrap_or(0);
        for step in &plan.steps {
            let needed = match step {
                Step::ReadPixels(operation) => pixels::store_bytes(frame, *operation, size),
                Step::Accumulate(operation) => {
                    self.accumulator.reserve(size)?;
                    Accumulated::of(frame, *operation, size).map_or(0, |item| item.store_bytes())
                }
                Step::Transfers(_) | Step::Raster(_) | Step::Copy(_) => 0,
            };
            bytes = bytes.max(needed);
        }
        self.store.reserve(bytes)
    }

    /// Records and submits; the states of what lives longer than the frame are those that it leaves.
    fn record(&mut self, frame: &Frame, prepared: &Prepared) -> Result<(), RenderError> {
        let gpu = self.gpu.clone();
        let mut recording = gpu.record()?;
        if let PassClock::Device(timer) = &mut self.slots[self.current].clock {
            timer.restart(&recording);
        }
        let graph = &prepared.schedule.graph;
        for step in graph.steps() {
            if !step.barriers.is_empty() {
                record_barriers(&recording, step.barriers, &self.bound(prepared));
            }
            let name = graph.pass_name(step.pass).unwrap_or_default();
            let slot = &mut self.slots[self.current];
            slot.report.add_pass(name);
            let scope = match &mut slot.clock {
                PassClock::Device(timer) => Some(timer.begin(&recording, name)),
                PassClock::Host | PassClock::None => None,
            };
            let work = &prepared.schedule.work[step.pass.index()];
            self.work(&recording, work, frame, prepared)?;
            let slot = &mut self.slots[self.current];
            match (&mut slot.clock, scope) {
                (PassClock::Device(timer), Some(scope)) => timer.end(&recording, scope),
                (PassClock::Host, _) => {
                    let begun = Instant::now();
                    gpu.wait(recording.submit()?)?;
                    slot.report.add_time(name, begun.elapsed().as_nanos() as u64);
                    recording = gpu.record()?;
                }
                _ => {}
            }
        }
        self.slots[self.current].submission = Some(recording.submit()?);
        self.keep_states(&prepared.schedule);
        let views = prepared.schedule.views.as_ref();
        if let (Some(tracer), Some(views), Some(traced)) = (&mut self.tracer, views, &prepared.traced) {
            tracer.keep_states(&prepared.schedule.graph, views, traced);
        }
        Ok(())
    }

    /// What the graph's resources are, in the order of declaration.
    fn bound(&self, prepared: &Prepared) -> Vec<Bound<'_>> {
        let resources = &prepared.schedule.resources;
        let mut bound = vec![Bound::Memory; prepared.schedule.graph.resources().len()];
        bound[resources.color.index()] = Bound::Image(&self.target.color);
        bound[resources.depth.index()] = Bound::Image(&self.target.depth);
        let buffers = self.tracer.as_ref().and_then(|tracer| tracer.buffers.as_ref());
        if let (Some(views), Some(buffers)) = (&prepared.schedule.views, buffers) {
            bound[views.visibility.index()] = Bound::Image(&buffers.visibility.image);
            bound[views.albedo.index()] = Bound::Image(&buffers.albedo.image);
        }
        let map = self.tracer.as_ref().and_then(|tracer| tracer.sky.as_ref());
        let sky = prepared.schedule.views.as_ref().and_then(|views| views.sky);
        if let (Some(sky), Some(map)) = (sky, map) {
            bound[sky.sides.index()] = Bound::Image(&map.sides.image);
        }
        bound
    }

    fn keep_states(&mut self, schedule: &Schedule) {
        let resources = &schedule.resources;
        let keep = |state: &mut afterglow_frame_graph::ResourceState, resource| {
            *state = schedule.graph.final_state(resource).unwrap_or(*state);
        };
        keep(&mut self.target.color_state, resources.color);
        keep(&mut self.target.depth_state, resources.depth);
        keep(&mut self.texture_state, resources.textures);
        keep(&mut self.geometry_state, resources.geometry);
        keep(&mut self.store.state, resources.store);
        keep(&mut self.accumulator.state, resources.accumulation);
    }

    fn work(
        &mut self,
        commands: &Commands<'_>,
        work: &Work,
        frame: &Frame,
        prepared: &Prepared,
    ) -> Result<(), GpuError> {
        let plan = &prepared.plan;
        let (target, textures, store) = (&self.target, &self.textures, &self.store);
        match work {
            Work::First(range) => {
                transfers::record_first(commands, plan, textures, &prepared.range_copies);
                transfers::record(commands, &plan.transfers[range.clone()], textures);
            }
            Work::Transfers(range) => {
                transfers::record(commands, &plan.transfers[range.clone()], textures);
            }
            Work::Raster(step, begins_view) => {
                let buffers = self.tracer.as_ref().and_then(|tracer| tracer.buffers.as_ref());
                let view = match (step.view, buffers, &prepared.traced) {
                    (Some(_), Some(buffers), Some(traced)) => Some(RasterView {
                        visibility: buffers.visibility.image.view(),
                        albedo: buffers.albedo.image.view(),
                        begins: *begins_view,
                        marks: &traced.marks,
                    }),
                    _ => None,
                };
                let mut pass = RasterPass {
                    commands,
                    input: RasterFrame {
                        gpu: &self.gpu,
                        frame,
                        target,
                        textures,
                        replacements: self.replacements.as_ref(),
                        table: &self.table,
                        address: prepared.address,
                        draws: &self.scratch.commands,
                        rectangles: &self.rectangles,
                        view,
                    },
                    state: &mut self.raster,
                    pool: &mut self.slots[self.current].pool,
                    bound: raster::Bound::default(),
                };
                pass.record(step)?;
            }
            Work::CopyRead(batch) => {
                copy::record_read(commands, target, &plan.batches[*batch], store);
            }
            Work::CopyFlip(batch) => {
                let records = prepared.flips[*batch];
                self.flip.record(commands, target, &plan.batches[*batch], records);
            }
            Work::CopyWrite(batch) => {
                copy::record_write(commands, &plan.batches[*batch], store, textures);
            }
            Work::ReadPixels(operation) => {
                pixels::record_read(commands, frame, *operation, target, store);
            }
            Work::AccumulateRead(item) => item.record_read(commands, target, store),
            Work::Accumulate(item) => self.accumulator.record(commands, item, store),
            Work::AccumulateWrite(item) => item.record_write(commands, target, store),
            Work::Trace(TraceWork::DrawSky) => self.draw_sky(commands, frame, prepared)?,
            Work::Trace(work) => {
                let tracer = self.tracer.as_ref();
                let buffers = tracer.and_then(|tracer| tracer.buffers.as_ref());
                if let (Some(tracer), Some(buffers), Some(traced)) = (tracer, buffers, &prepared.traced) {
                    let context = TraceContext {
                        commands,
                        table: &self.table,
                        pipelines: &tracer.pipelines,
                        plan: &tracer.plan,
                        stages: &tracer.stages,
                        structures: tracer.world.structures(),
                        lists: &tracer.lists,
                        buffers,
                        prepared: traced,
                        sky: tracer.sky.as_ref(),
                    };
                    context.record(*work);
                }
            }
            Work::ReadBack => {
                if let Some(readback) = &prepared.readback {
                    readback.record(commands, target, textures);
                }
            }
        }
        Ok(())
    }

    /// Draws the sky as rays see it.
    fn draw_sky(
        &mut self,
        commands: &Commands<'_>,
        frame: &Frame,
        prepared: &Prepared,
    ) -> Result<(), GpuError> {
        let map = self.tracer.as_ref().and_then(|tracer| tracer.sky.as_ref());
        let sky = prepared.traced.as_ref().and_then(|traced| traced.sky.prepared.as_ref());
        let (Some(map), Some(sky)) = (map, sky) else { return Ok(()) };
        let mut pass = RasterPass {
            commands,
            input: RasterFrame {
                gpu: &self.gpu,
                frame,
                target: &self.target,
                textures: &self.textures,
                replacements: self.replacements.as_ref(),
                table: &self.table,
                address: sky.record,
                draws: &self.scratch.commands,
                rectangles: &self.rectangles,
                view: None,
            },
            state: &mut self.raster,
            pool: &mut self.slots[self.current].pool,
            bound: raster::Bound::default(),
        };
        pass.record_sky(sky, map)
    }

    /// Counts what the frame took, of which so many operations were rasterized.
    fn note(&mut self, frame: &Frame, rasterized: usize, prepared: &Prepared, scene: Option<SceneReport>) {
        let draws = || frame.draws().take_while(|(operation, _)| *operation < rasterized);
        let slot = &mut self.slots[self.current];
        let passes = std::mem::take(&mut slot.report.passes);
        let graph = prepared.schedule.graph.report();
        slot.report = FrameReport {
            index: self.swaps,
            passes,
            draws: draws().count(),
            indices: draws().map(|(_, draw)| u64::from(draw.index_count)).sum(),
            uploaded_bytes: slot.arena.bytes(),
            pipelines: self.raster.pipelines.len(),
            textures: self.textures.len(),
            retained_ranges: self.ranges.len(),
            culled: graph.culled,
            bytes: graph.bytes,
            scene,
            traced: prepared.traced.as_ref().map(|traced| traced.counts),
        };
    }
}
