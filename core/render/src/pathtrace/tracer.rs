//! What path tracing keeps from frame to frame.

use std::sync::Arc;

use afterglow_frame_graph::{CompiledGraph, ResourceState};
use afterglow_gl::frame::Frame;
use afterglow_gpu::{BindlessTable, Gpu, GpuError};
use afterglow_records::Paint;
use afterglow_scene::{Camera, Recovery, Scene};

use super::arrange::{Arrangement, arrange};
use super::buffers::ViewBuffers;
use super::change::History;
use super::denoise::{Denoiser, Plan, StagePipelines};
use super::kept_tree::KeptTree;
use super::lists::Lists;
use super::options::{Mode, PathtraceOptions};
use super::past::Past;
use super::pipelines::TracePipelines;
use super::prepare::PreparedTrace;
use super::rays::PixelRays;
use super::schedule::{ExposureUse, ViewResources};
use super::sky::SkyMap;
use super::unseen;
use super::world::WorldBuilder;
use crate::parts::Parts;
use crate::report::SceneReport;
use crate::target::Target;

/// A frame that was judged.
#[derive(Debug)]
pub(crate) struct Understood {
    pub(crate) report: SceneReport,
    /// None if there is nothing to trace: the frame stays as it is.
    pub(crate) tracing: Option<Tracing>,
}

/// A frame that is to be traced.
#[derive(Debug, Default)]
pub(crate) struct Tracing {
    pub(crate) scene: Scene,
    pub(crate) arrangement: Arrangement,
    /// Operations of the frame that are rasterized; what comes after them is for rays alone.
    pub(crate) rasterized: usize,
    /// The scene is all that there is: in `reference` mode rays of the camera see it, and no draw.
    pub(crate) is_staged: bool,
}

/// Path tracing of one window.
pub(crate) struct Tracer {
    /// `Pathtrace` or `Reference`.
    pub(crate) mode: Mode,
    pub(crate) options: PathtraceOptions,
    pub(crate) recovery: Recovery,
    pub(crate) world: WorldBuilder,
    /// How the last frame left the meshes.
    pub(crate) world_state: ResourceState,
    pub(crate) lists: Lists,
    /// How the last frame left those.
    pub(crate) lists_state: ResourceState,
    pub(crate) pipelines: Arc<TracePipelines>,
    /// Of the window's size; none before the first traced frame.
    pub(crate) buffers: Option<ViewBuffers>,
    /// Of each view.
    pub(crate) history: Vec<History>,
    pub(crate) past: Past,
    /// What the denoiser does.
    pub(crate) plan: Plan,
    /// The pipelines that do it.
    pub(crate) stages: StagePipelines,
    pub(crate) light_tree: KeptTree,
    /// What rays see of the sky; none before one was first seen.
    pub(crate) sky: Option<SkyMap>,
    /// The last frame was seen by rays of the camera.
    pub(crate) has_camera_rays: bool,
    /// A line has said that some frames cannot be traced.
    has_said_blind: bool,
    /// The last frame was traced.
    pub(crate) is_tracing: bool,
    /// An earlier frame has found an exposure.
    pub(crate) has_exposure: bool,
    /// What was handed over of the frame that is going on.
    pub(crate) parts: Parts,
    /// A part of a frame that nobody will see was submitted, and not its end.
    pub(crate) has_begun_unseen: bool,
    /// The window before that frame.
    pub(crate) before: Option<Target>,
}

impl Tracer {
    /// None if the device lacks what the visibility buffer needs.
    pub(crate) fn new(
        gpu: &Gpu,
        table: &BindlessTable,
        mode: Mode,
        options: PathtraceOptions,
    ) -> Result<Option<Self>, GpuError> {
        let features = gpu.features();
        // Triangles' numbers in fragments, colour and visibility that are blended differently, two numbers a pixel.
        let serves =
            features.geometry_shader && features.independent_blend && features.storage_image_extended_formats;
        if !serves {
            tracing::warn!("the device cannot number triangles: frames are rasterized");
            return Ok(None);
        }
        let pipelines = Arc::new(TracePipelines::new(gpu, table, options.backend)?);
        Self::with(gpu, mode, options, pipelines).map(Some)
    }

    /// Traces otherwise from now on.
    ///
    /// # Errors
    /// If the device lacks another backend that is asked for: nothing has changed then.
    pub(crate) fn set_options(
        &mut self,
        gpu: &Gpu,
        table: &BindlessTable,
        mode: Mode,
        options: &PathtraceOptions,
    ) -> Result<(), GpuError> {
        let (backend, waits) = (options.backend, options.waits_for_builds);
        if backend != self.options.backend {
            let pipelines = Arc::new(TracePipelines::new(gpu, table, backend)?);
            self.world = WorldBuilder::new(gpu, backend, waits)?;
            self.pipelines = pipelines;
        } else if waits != self.options.waits_for_builds {
            self.world = WorldBuilder::new(gpu, backend, waits)?;
        }
        self.mode = mode;
        self.options = options.clone();
        self.recovery.set_memory(options.memory_bytes);
        Ok(())
    }

    /// For another window of the same renderer.
    pub(crate) fn beside(&self, gpu: &Gpu) -> Result<Self, GpuError> {
        Self::with(gpu, self.mode, self.options.clone(), self.pipelines.clone())
    }

    fn with(
        gpu: &Gpu,
        mode: Mode,
        options: PathtraceOptions,
        pipelines: Arc<TracePipelines>,
    ) -> Result<Self, GpuError> {
        let world = WorldBuilder::new(gpu, options.backend, options.waits_for_builds)?;
        let mut recovery = Recovery::with_profile(options.profile.clone())
            .with_relighting(options.relighting, options.replacing);
        recovery.set_memory(options.memory_bytes);
        if let Some(cache) = &options.cache {
            recovery.set_cache(cache);
        }
        Ok(Self {
            mode,
            options,
            recovery,
            world,
            world_state: ResourceState::SETTLED,
            lists: Lists::new(gpu),
            light_tree: KeptTree::default(),
            lists_state: ResourceState::SETTLED,
            pipelines,
            buffers: None,
            history: Vec::new(),
            past: Past::default(),
            plan: Plan::default(),
            stages: StagePipelines::default(),
            sky: None,
            has_camera_rays: false,
            has_said_blind: false,
            is_tracing: false,
            has_exposure: false,
            parts: Parts::None,
            has_begun_unseen: false,
            before: None,
        })
    }

    /// Judges a frame, and puts it in order if it has a world.
    pub(crate) fn understand(&mut self, frame: &mut Frame) -> Understood {
        let scene = self.recovery.understand(frame);
        self.put_in_order(frame, scene, false)
    }

    /// Puts a frame in order whose scene is known.
    pub(crate) fn stage(&mut self, frame: &mut Frame, scene: Scene) -> Understood {
        self.put_in_order(frame, scene, true)
    }

    /// Whether a camera shows the world; says so once if it does not. Rays of its own need pixels that are apart.
    fn can_see(&mut self, camera: &Camera, is_staged: bool) -> bool {
        let has_rays = is_staged && self.mode == Mode::Reference;
        let is_undone = camera.projection.as_dmat4().inverse().is_finite();
        let can_see = is_undone && (!has_rays || PixelRays::new(camera, [1, 1]).are_apart());
        if !can_see && !std::mem::replace(&mut self.has_said_blind, true) {
            tracing::warn!("no rays for a projection: frames with it are rasterized");
        }
        can_see
    }

    fn put_in_order(&mut self, frame: &mut Frame, mut scene: Scene, is_staged: bool) -> Understood {
        if scene.cut {
            self.forget();
            self.has_exposure = false;
        }
        let report = SceneReport::of(&scene);
        let camera = scene.camera.filter(|camera| self.can_see(camera, is_staged));
        let mut arrangement = camera.map(|_| arrange(frame, &scene));
        if let (Some(arrangement), true) = (&mut arrangement, is_staged && self.mode == Mode::Reference) {
            arrangement.see_anything(frame);
        }
        let arrangement = arrangement.filter(|arrangement| !arrangement.views.is_empty());
        let tracing = arrangement.map(|mut arrangement| {
            arrangement.apply(frame, &mut scene);
            let rasterized = frame.operations.len();
            unseen::append(frame, &mut scene, &mut arrangement);
            Tracing { scene, arrangement, rasterized, is_staged }
        });
        self.is_tracing = tracing.is_some();
        Understood { report, tracing }
    }

    /// Makes buffers that fit the window, for so many views.
    pub(crate) fn reserve(
        &mut self,
        gpu: &Gpu,
        table: &BindlessTable,
        target: &Target,
        views: usize,
    ) -> Result<(), GpuError> {
        if !self.buffers.as_ref().is_some_and(|buffers| buffers.fits(target)) {
            if let Some(old) = self.buffers.take() {
                old.release(table);
            }
            self.forget();
            self.has_exposure = false;
            self.buffers = Some(ViewBuffers::new(gpu, table, target)?);
        }
        let light_size = self.light_size(target.size);
        self.plan = self.denoiser().plan();
        if self.options.spare_samples(light_size) == 0 {
            self.plan.spare_nothing();
        }
        self.stages.make_ready(gpu, table, &self.plan)?;
        let Some(buffers) = &mut self.buffers else { return Ok(()) };
        if !buffers.reserve_views(gpu, views, &self.plan, light_size)? {
            self.past.forget();
            self.history.iter_mut().for_each(History::forget);
        }
        let spare = self.plan.spare;
        match self.smooths_edges() {
            true => self.buffers.as_mut().map_or(Ok(()), |buffers| buffers.reserve_composed(gpu, spare)),
            false => Ok(()),
        }
    }

    /// The denoiser; none where light adds up without any.
    fn denoiser(&self) -> Denoiser {
        if self.mode == Mode::Reference { Denoiser::None } else { self.options.denoiser }
    }

    /// Whether edges of triangles are smoothed.
    pub(crate) fn smooths_edges(&self) -> bool {
        self.mode == Mode::Pathtrace && self.options.smooth_edges && self.options.paint == Paint::Picture
    }

    /// Texels of light in a window of a size.
    pub(crate) fn light_size(&self, size: [u32; 2]) -> [u32; 2] {
        let scale = match self.mode {
            // Without a denoiser nothing knows which texels a pixel may take its light from.
            Mode::Pathtrace if self.options.denoiser != Denoiser::None => {
                self.options.light_scale.clamp(0.5, 1.0)
            }
            _ => 1.0,
        };
        // Not max(): what that makes of NaN is not wanted.
        let scale = if scale.is_finite() { f64::from(scale) } else { 1.0 };
        size.map(|side| ((f64::from(side) * scale).ceil() as u32).clamp(1, side.max(1)))
    }

    /// Takes over how a frame leaves what lives longer than it.
    pub(crate) fn keep_states(
        &mut self,
        graph: &CompiledGraph,
        resources: &ViewResources,
        prepared: &PreparedTrace,
    ) {
        let keep = |state: &mut ResourceState, resource| {
            *state = graph.final_state(resource).unwrap_or(*state);
        };
        keep(&mut self.world_state, resources.world);
        keep(&mut self.lists_state, resources.lists);
        if let (Some(sky), Some(resources)) = (&mut self.sky, resources.sky) {
            keep(&mut sky.sides.state, resources.sides);
            keep(&mut sky.drawn.state, resources.drawn);
            keep(&mut sky.texels.state, resources.texels);
        }
        if let Some(buffers) = &mut self.buffers {
            keep(&mut buffers.visibility.state, resources.visibility);
            keep(&mut buffers.albedo.state, resources.albedo);
            let parity = prepared.parity;
            keep(&mut buffers.surfaces.state, resources.surfaces);
            if let (Some(before), Some(resource)) = (&mut buffers.surfaces_before, resources.surfaces_before)
            {
                keep(&mut before.state, resource);
            }
            buffers.swap_surfaces();
            if let (Some(both), Some([now, before])) = (&mut buffers.reservoirs, resources.reservoirs) {
                keep(&mut both[parity].state, now);
                keep(&mut both[1 - parity].state, before);
            }
            keep(&mut buffers.sums.state, resources.sums);
            keep(&mut buffers.movers.state, resources.movers);
            keep(&mut buffers.counters.state, resources.counters);
            if let (Some(radiance), Some(resource)) = (&mut buffers.radiance, resources.radiance) {
                keep(&mut radiance.state, resource);
            }
            keep(&mut buffers.exposure.state, resources.exposure);
            for (light, resource) in buffers.light.iter_mut().zip(&resources.light) {
                keep(&mut light.state, *resource);
            }
            for (stores, resources) in buffers.stores.iter_mut().zip(&resources.stores) {
                stores.keep_states(graph, resources, parity);
            }
            if let (Some(composed), Some(resource)) = (&mut buffers.composed, resources.composed_alone()) {
                keep(&mut composed.state, resource);
            }
        }
        let finds = |exposure| matches!(exposure, ExposureUse::Found { .. });
        self.has_exposure |= prepared.views.iter().any(|view| finds(view.needs.exposure));
    }

    /// After a frame that was not recorded: what its passes would have left is not there.
    pub(crate) fn forget(&mut self) {
        self.past.forget();
        self.lists.forget();
        self.sky.iter_mut().for_each(SkyMap::forget);
        self.history.iter_mut().for_each(History::forget);
    }
}
