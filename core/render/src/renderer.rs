//! Frames in, pixels out.

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::{Frame, PixelBuffer, Rect};
use afterglow_gpu::{BindlessSizes, BindlessTable, Gpu, GpuError};
use afterglow_scene::Scene;
use hashbrown::HashMap;

use crate::drawables::Seat;
use crate::error::RenderError;
use crate::parts::Parts;
use crate::passes::accumulate::Accumulator;
use crate::passes::copy::Flip;
use crate::passes::raster::RasterState;
use crate::passes::readback::{Asked, Question};
use crate::pathtrace::{Mode, PathtraceOptions, Tracer};
use crate::rectangles::Rectangles;
use crate::replacements::Replacements;
use crate::report::FrameReport;
use crate::retained::RetainedRanges;
use crate::slot::Slot;
use crate::store::Store;
use crate::tables::Scratch;
use crate::target::Target;
use crate::textures::Textures;

/// Frames that the device may still be working on while the next one is recorded.
const FRAMES_IN_FLIGHT: usize = 2;
/// Empty frames that are kept to be filled again.
const RECYCLED_FRAMES: usize = 3;

/// How to render.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct RenderOptions {
    /// Take the device's time of each pass, for [`Renderer::frame_report`].
    pub timing: bool,
}

/// Executes the frames of one window.
pub struct Renderer {
    pub(crate) gpu: Gpu,
    pub(crate) target: Target,
    pub(crate) textures: Textures,
    pub(crate) ranges: RetainedRanges,
    pub(crate) raster: RasterState,
    pub(crate) flip: Flip,
    pub(crate) accumulator: Accumulator,
    pub(crate) store: Store,
    pub(crate) texture_state: afterglow_frame_graph::ResourceState,
    pub(crate) geometry_state: afterglow_frame_graph::ResourceState,
    pub(crate) slots: [Slot; FRAMES_IN_FLIGHT],
    /// The slot of the frame that is being recorded, or else of the next one.
    pub(crate) current: usize,
    pub(crate) scratch: Scratch,
    pub(crate) rectangles: Rectangles,
    /// Buffer swaps so far.
    pub(crate) swaps: u64,
    pub(crate) report: FrameReport,
    /// Path tracing; none in `raster` mode.
    pub(crate) tracer: Option<Tracer>,
    /// What takes the place of textures while frames are traced.
    pub(crate) replacements: Option<Replacements>,
    /// Looks after shaders; none if nobody has asked for it.
    #[cfg(feature = "reload")]
    pub(crate) reloader: Option<afterglow_shaders::reload::Reloader>,
    /// The number of the selected drawable; 0 before one was selected.
    pub(crate) drawable: u64,
    /// The other drawables.
    pub(crate) seats: HashMap<u64, Seat>,
    recycled: Vec<Frame>,
    failure: Option<RenderError>,
    /// Dropped last of all: slots of the table are given back to it.
    pub(crate) table: BindlessTable,
}

impl Renderer {
    /// A renderer with a window of one pixel; the first frame resizes it.
    pub fn new(gpu: &Gpu, options: &RenderOptions) -> Result<Self, RenderError> {
        let table = gpu.create_bindless_table(BindlessSizes::default())?;
        let slot = || Slot::new(gpu, options.timing);
        Ok(Self {
            gpu: gpu.clone(),
            target: Target::new(gpu, [1, 1])?,
            textures: Textures::new(gpu, &table)?,
            ranges: RetainedRanges::new(gpu),
            raster: RasterState::new(gpu, &table)?,
            flip: Flip::new(gpu)?,
            accumulator: Accumulator::new(gpu),
            store: Store::new(gpu),
            texture_state: afterglow_frame_graph::ResourceState::SETTLED,
            geometry_state: afterglow_frame_graph::ResourceState::SETTLED,
            slots: [slot()?, slot()?],
            current: 0,
            scratch: Scratch::default(),
            rectangles: Rectangles::default(),
            swaps: 0,
            report: FrameReport::default(),
            tracer: None,
            replacements: None,
            #[cfg(feature = "reload")]
            reloader: afterglow_shaders::reload::Reloader::from_environment(),
            drawable: 0,
            seats: HashMap::new(),
            recycled: Vec::new(),
            failure: None,
            table,
        })
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Width and height of the window in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.target.size
    }

    /// Executes a frame's operations, and waits for nothing.
    ///
    /// # Errors
    /// If the device fails; then the frame, and what comes after it, may be lost.
    pub fn execute(&mut self, frame: &Frame) -> Result<(), RenderError> {
        self.execute_and_read(frame, None, None).map(|_| ())
    }

    /// Executes a frame with its world traced, in [`Mode::Pathtrace`] and where there is a world. The frame's
    /// operations may change their order.
    ///
    /// # Errors
    /// If the device fails; then the frame, and what comes after it, may be lost.
    pub fn execute_traced(&mut self, frame: &mut Frame) -> Result<(), RenderError> {
        let understood = self.tracer.as_mut().map(|tracer| tracer.understand(frame));
        self.execute_and_read(frame, None, understood.as_ref()).map(|_| ())
    }

    /// Executes a frame whose scene is known: nothing is recovered.
    ///
    /// # Errors
    /// As [`Renderer::execute_traced`].
    pub fn execute_staged(&mut self, frame: &mut Frame, scene: Scene) -> Result<(), RenderError> {
        let understood = self.tracer.as_mut().map(|tracer| tracer.stage(frame, scene));
        self.execute_and_read(frame, None, understood.as_ref())?;
        self.swaps += 1;
        Ok(())
    }

    /// Sets what frames become from now on.
    ///
    /// # Errors
    /// If the device fails. One that cannot trace stays in [`Mode::Raster`].
    pub fn set_mode(&mut self, mode: Mode, options: &PathtraceOptions) -> Result<(), RenderError> {
        match (mode, &mut self.tracer) {
            (Mode::Raster, _) => self.stop_tracing(),
            (Mode::Pathtrace | Mode::Reference, Some(tracer)) => {
                tracer.set_options(&self.gpu, &self.table, mode, options)?;
            }
            (Mode::Pathtrace | Mode::Reference, None) => {
                self.tracer = Tracer::new(&self.gpu, &self.table, mode, options.clone())?;
            }
        }
        if let (Some(images), None, Some(_)) = (&options.images, &self.replacements, &self.tracer) {
            self.replacements = Replacements::open(&self.gpu, images);
        }
        Ok(())
    }

    /// What frames become.
    pub fn mode(&self) -> Mode {
        self.tracer.as_ref().map_or(Mode::Raster, |tracer| tracer.mode)
    }

    /// Executes a frame's operations and answers a question about the result.
    ///
    /// # Errors
    /// If the device fails.
    pub fn execute_and_answer(&mut self, frame: &Frame, request: &Request) -> Result<Reply, RenderError> {
        self.resize(frame)?;
        let asked = Question::of(request, frame, self.target.size, &self.textures);
        let question = match &asked {
            Asked::Read(question) => Some(*question),
            Asked::Answered(_) => None,
        };
        let readback = self.execute_and_read(frame, question, None)?;
        self.finish()?;
        Ok(match (asked, readback, request) {
            (_, _, Request::Query(id)) => Reply::Samples(self.raster.queries.samples(*id)),
            (Asked::Answered(reply), _, _) => reply,
            (Asked::Read(_), Some(readback), _) => {
                readback.reply(self.target.depth_format, &self.textures)?
            }
            (Asked::Read(_), None, _) => Reply::Unavailable,
        })
    }

    /// The window's colours: four bytes a pixel, the highest row first.
    ///
    /// # Errors
    /// If the device fails.
    pub fn read_color(&mut self) -> Result<Vec<u8>, RenderError> {
        let [width, height] = self.target.size;
        let rect = Rect { x: 0, y: 0, width: width as i32, height: height as i32 };
        let question = Question::Window { buffer: PixelBuffer::Color, rect, clipped: rect };
        let frame = Frame { size: (width, height), ..Frame::default() };
        let readback = self.execute_and_read(&frame, Some(question), None)?;
        self.finish()?;
        readback.map_or_else(|| Ok(Vec::new()), |readback| Ok(readback.bytes()?))
    }

    /// Waits until the device has executed everything.
    ///
    /// # Errors
    /// If the device fails.
    pub fn finish(&mut self) -> Result<(), RenderError> {
        for offset in 0..FRAMES_IN_FLIGHT {
            // The oldest frame first, so that queries add up in order.
            self.collect((self.current + offset) % FRAMES_IN_FLIGHT)?;
        }
        Ok(())
    }

    /// What the last frame cost. Waits for it.
    ///
    /// # Errors
    /// If the device fails.
    pub fn frame_report(&mut self) -> Result<&FrameReport, RenderError> {
        self.finish()?;
        Ok(&self.report)
    }

    /// What was measured of the last frame that the device is known to have finished. Waits for nothing.
    pub fn last_report(&self) -> &FrameReport {
        &self.report
    }

    /// Why nothing is executed any more, if a frame that was submitted has failed. Another renderer may serve, with
    /// all images defined anew.
    pub fn failure(&self) -> Option<&RenderError> {
        self.failure.as_ref()
    }

    /// Waits for the frame that uses a slot.
    pub(crate) fn collect(&mut self, slot: usize) -> Result<(), GpuError> {
        let queries = &mut self.raster.queries;
        self.slots[slot].collect(&self.gpu, queries, &mut self.report)
    }

    /// Moves on to the slot of the next submission.
    pub(crate) fn advance(&mut self) {
        self.current = (self.current + 1) % FRAMES_IN_FLIGHT;
    }

    /// Takes a frame that nobody will see, for the state that it leaves: it is rasterized in every mode.
    pub fn submit_unlit(&mut self, frame: Frame, end: End) {
        if let Some(tracer) = &mut self.tracer {
            tracer.recovery.observe(&frame);
            tracer.parts = Parts::None;
        }
        self.unless_failed(|renderer| renderer.execute(&frame));
        self.end(frame, end);
    }

    /// The same for frames before the first that is seen. Later ones are understood by what whole frames show of the world;
    /// draws are left out after that, unless their pixels become texels.
    pub fn submit_unseen(&mut self, mut frame: Frame, end: End) {
        if let Some(tracer) = &mut self.tracer {
            let is_whole = matches!(tracer.parts, Parts::None) && !tracer.has_begun_unseen;
            match is_whole && end == End::Swap {
                true => drop(tracer.recovery.understand(&mut frame)),
                false => tracer.recovery.observe(&frame),
            }
            tracer.has_begun_unseen = end == End::Continued;
            tracer.parts = Parts::None;
        }
        frame.keep_state();
        self.unless_failed(|renderer| renderer.execute(&frame));
        self.end(frame, end);
    }

    fn end(&mut self, frame: Frame, end: End) {
        if end == End::Swap {
            self.swaps += 1;
        }
        self.recycle_frame(frame);
    }

    /// Rasterizes from now on: there is not enough memory to trace.
    pub(crate) fn trace_no_more(&mut self, error: &RenderError) {
        tracing::error!("path tracing is off, frames are rasterized: {error}");
        self.stop_tracing();
    }

    /// Gives back all that path tracing has on the device.
    fn stop_tracing(&mut self) {
        let waiting = self.seats.values_mut().filter_map(|seat| seat.tracer.take());
        for buffers in waiting.chain(self.tracer.take()).filter_map(|tracer| tracer.buffers) {
            buffers.release(&self.table);
        }
        for image in self.replacements.take().iter().flat_map(Replacements::images) {
            self.textures.remove(&self.table, image);
        }
    }

    fn recycle_frame(&mut self, mut frame: Frame) {
        if self.recycled.len() < RECYCLED_FRAMES {
            frame.clear();
            self.recycled.push(frame);
        }
    }

    /// Runs `work` unless some has failed before. A lost device is left to its owner to speak of.
    fn unless_failed<T>(&mut self, work: impl FnOnce(&mut Self) -> Result<T, RenderError>) -> Option<T> {
        if self.failure.is_some() {
            return None;
        }
        match work(self) {
            Ok(value) => Some(value),
            Err(error) => {
                match &error {
                    error if self.tracer.is_some() && error.is_out_of_memory() => self.trace_no_more(error),
                    error if error.is_device_lost() => {}
                    error => tracing::error!("a frame could not be executed: {error}"),
                }
                self.failure = Some(error);
                None
            }
        }
    }
}

impl Backend for Renderer {
    fn submit(&mut self, mut frame: Frame, end: End) {
        self.unless_failed(|renderer| renderer.execute_part(&mut frame, end));
        self.end(frame, end);
    }

    fn answer(&mut self, mut so_far: Frame, request: Request) -> Reply {
        let reply = self.unless_failed(|renderer| renderer.answer_part(&mut so_far, &request));
        self.recycle_frame(so_far);
        reply.unwrap_or(Reply::Unavailable)
    }

    fn recycle(&mut self) -> Frame {
        self.recycled.pop().unwrap_or_default()
    }
}
