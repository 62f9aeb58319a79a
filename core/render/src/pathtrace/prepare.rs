//! From a judged frame to what its passes read: surfaces, the world, a record a view.

use afterglow_gpu::GpuError;
use afterglow_records::{
    MASK_MOVING, MeshMember, Paint, SurfaceKind, TRACE_PARALLEL, TRACE_SMOOTH_EDGES, ViewRecord,
};
use afterglow_scene::Camera;
use bytemuck::Zeroable;
use glam::Vec3;

use super::backend::Backend;
use super::buffers::{Tracked, ViewBuffers, sum_count};
use super::change::{ChangeHasher, History, changes_textures};
use super::denoise::{Plan, Store};
use super::estimator::Estimator;
use super::gather::{Surfaces, TraceInput, gather};
use super::lights::{LightList, highlight};
use super::lists::{FramePlace, List};
use super::options::{Mode, SkyChoice};
use super::past::Left;
use super::rays::PixelRays;
use super::schedule::{ExposureUse, ViewNeeds};
use super::sky::{self, SkyUse};
use super::tracer::{Tracer, Tracing};
use super::world::{Traced, World};
use crate::passes::raster::DrawMark;
use crate::uploads::UploadArena;

/// How far things that move darken surfaces, as a share of the world's extent.
const CONTACT_SHARE: f32 = 0.03;
/// How much of the way to its new value exposure goes in a frame.
const EXPOSURE_RATE: f32 = 0.15;
/// Samples that a texel of whose light little is known may have besides, at most.
const MOST_SPARE: u32 = 7;

/// A view ready to be recorded.
#[derive(Debug)]
pub(crate) struct PreparedView {
    /// Address of its record.
    pub(crate) record: u64,
    pub(crate) needs: ViewNeeds,
}

/// A frame's views ready to be recorded.
#[derive(Debug)]
pub(crate) struct PreparedTrace {
    /// What each draw of the frame leaves in the visibility buffer.
    pub(crate) marks: Vec<DrawMark>,
    pub(crate) views: Vec<PreparedView>,
    /// Which buffers are this frame's, and which the one's before.
    pub(crate) parity: usize,
    /// Texels of light.
    pub(crate) light_size: [u32; 2],
    pub(crate) backend: Backend,
    pub(crate) sky: SkyUse,
    /// The world must be brought to the device.
    pub(crate) has_builds: bool,
    /// Structures there must be moved.
    pub(crate) has_moves: bool,
    /// Lists must be brought there, too.
    pub(crate) has_lists: bool,
    /// Rays may meet spheres.
    pub(crate) has_spheres: bool,
    pub(crate) counts: TraceCounts,
}

/// What a frame's world is made of.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct TraceCounts {
    /// Draws that the camera sees by rays' light.
    pub traced_draws: usize,
    /// Parts of the world that were drawn in earlier frames, and that only rays see.
    pub unseen: usize,
    /// Instances that rays can meet.
    pub instances: usize,
    /// Triangles that were built into structures for this frame.
    pub built_triangles: usize,
    /// Meshes that rays miss because they are still being built.
    pub waiting: usize,
    /// Lights.
    pub lights: usize,
    /// Samples a pixel in the first view, earlier frames' included.
    pub samples: usize,
    /// What rays see of the sky.
    pub sky: SkyChoice,
    /// Bytes of what is as large as the window, the window itself included.
    pub screen_bytes: u64,
    /// Times that the sky was drawn for rays so far.
    pub sky_drawings: usize,
}

/// What rays find in a frame.
struct Found<'a, 'f> {
    surfaces: &'a Surfaces<'f>,
    world: &'a World,
    sky: &'a SkyUse,
    lists: &'a ListAddresses,
}

/// What all views of a frame share.
struct Common {
    record: ViewRecord,
    hash: u64,
    may_continue: bool,
}

/// Makes what the passes of a frame's views read.
pub(crate) fn prepare(
    tracer: &mut Tracer,
    mut input: TraceInput<'_>,
    tracing: &Tracing,
    camera: &Camera,
    size: [u32; 2],
) -> Result<PreparedTrace, GpuError> {
    tracer.world.begin_frame(input.arena)?;
    tracer.lists.begin_frame();
    // In f32, so that differences to what is near it are exact.
    let origin = camera.view.inverse().w_axis.truncate().as_vec3().as_dvec3();
    let frame_place = tracer.lists.bring_frame(input.uploaded, input.arena)?;
    let geometry = &mut tracer.world.geometry;
    let mut surfaces = gather(geometry, &tracer.options, &mut input, &frame_place, tracing, origin)?;
    tracer.has_camera_rays = tracing.is_staged && tracer.mode == Mode::Reference;
    if let Some(buffers) = &mut tracer.buffers {
        buffers.reserve_movers(input.gpu, surfaces.records.len())?;
        if tracer.options.keeps_lights && tracer.mode == Mode::Pathtrace {
            buffers.reserve_reservoirs(input.gpu)?;
        }
        if tracer.has_camera_rays || tracer.options.keeps_radiance {
            buffers.reserve_radiance(input.gpu)?;
        }
    }
    surfaces.list_lights(&tracing.scene.lights, origin, &tracer.options, &mut tracer.light_tree);
    let world = tracer.world.build(input.frame, &surfaces.traced, &surfaces.lights, origin, input.arena)?;
    for (traced, reach) in surfaces.traced.iter().zip(&tracer.world.reaches) {
        surfaces.records[traced.surface as usize].reach = *reach;
    }
    let lists = tracer.bring_lists(&surfaces, &world.members, &frame_place, input.arena)?;
    let Tracer { sky: map, recovery, options, .. } = &mut *tracer;
    let sky = sky::prepare(map, recovery, &mut input, &tracing.scene, camera, options.sky)?;
    let found = Found { surfaces: &surfaces, world: &world, sky: &sky, lists: &lists };
    let common = tracer.common(&input, tracing, camera, &found, size);
    let program = match tracer.has_camera_rays {
        true => &tracer.pipelines.reference,
        false => &tracer.pipelines.light,
    };
    program.make_ready(input.gpu, input.table, world.has_spheres)?;
    let mut views = Vec::with_capacity(tracing.arrangement.views.len());
    let mut finds_exposure = true;
    let parity = tracer.past.parity();
    let view_count = tracing.arrangement.views.len();
    let mut left =
        Left { lights: false, histories: if tracer.plan.output.is_some() { view_count } else { 0 } };
    for (index, operations) in tracing.arrangement.views.iter().enumerate() {
        let kinds = surfaces.kinds_within(operations);
        let (mut needs, mut record) = tracer.view(index, view_count, &kinds, &common, &mut finds_exposure);
        needs.keeps_lights = tracer.keep_lights(&surfaces.lights, view_count, &mut record);
        needs.has_lights_before = record.reservoirs_before != 0;
        left.lights = needs.keeps_lights.is_ok();
        // A view without light has no history.
        left.histories = if needs.is_idle { 0 } else { left.histories };
        let record = input.arena.push(bytemuck::bytes_of(&record))?.address;
        views.push(PreparedView { record, needs });
    }
    tracer.past.end(camera, origin, &surfaces.lights, common.record.samples, left);
    let seen_sky = if sky.is_mapped() { SkyChoice::Cube } else { SkyChoice::Constant };
    Ok(PreparedTrace {
        marks: surfaces.marks,
        views,
        parity,
        light_size: tracer.light_size(size),
        backend: tracer.options.backend,
        sky,
        has_builds: tracer.world.structures().has_work(),
        has_moves: tracer.world.structures().has_moves(),
        has_lists: tracer.lists.has_work(),
        has_spheres: world.has_spheres,
        counts: TraceCounts {
            traced_draws: surfaces.seen,
            unseen: surfaces.traced.len() - surfaces.seen,
            instances: world.instances as usize,
            built_triangles: tracer.world.structures().built(),
            waiting: world.waiting,
            lights: common.record.light_count as usize,
            samples: tracer.history.first().map_or(0, |history| history.samples() as usize),
            sky: seen_sky,
            screen_bytes: tracer.buffers.as_ref().map_or(0, ViewBuffers::bytes),
            sky_drawings: tracer.sky.as_ref().map_or(0, |sky| sky.drawings() as usize),
        },
    })
}

/// Where a frame's lists are.
struct ListAddresses {
    /// The frame's record.
    frame: u64,
    surfaces: u64,
    members: u64,
    lights: u64,
    light_nodes: u64,
}

impl Tracer {
    fn bring_lists(
        &mut self,
        surfaces: &Surfaces<'_>,
        members: &[MeshMember],
        frame: &FramePlace,
        arena: &mut UploadArena,
    ) -> Result<ListAddresses, GpuError> {
        let lights = &surfaces.lights;
        Ok(ListAddresses {
            frame: frame.record,
            surfaces: self.lists.bring(List::Surfaces, &surfaces.records, arena)?,
            members: self.lists.bring(List::Members, members, arena)?,
            lights: self.lists.bring(List::Lights, &lights.sources, arena)?,
            light_nodes: self.lists.bring(List::LightNodes, &lights.nodes, arena)?,
        })
    }

    fn common(
        &self,
        input: &TraceInput<'_>,
        tracing: &Tracing,
        camera: &Camera,
        &Found { surfaces, world, sky, lists }: &Found<'_, '_>,
        size: [u32; 2],
    ) -> Common {
        let (scene, options) = (&tracing.scene, &self.options);
        let estimator = Estimator::of(self.mode, options);
        let origin = camera.view.inverse().w_axis.truncate();
        let mut record = ViewRecord::zeroed();
        self.past.write(&mut record, origin);
        let light_size = self.light_size(size);
        let mut traits = estimator.traits;
        sky.write(&mut record);
        let mut hasher =
            ChangeHasher::new(size, camera, scene, &surfaces.lights.sources, &estimator, options);
        hasher.add_sky(sky);
        for traced in &surfaces.traced {
            let record = &surfaces.records[traced.surface as usize];
            hasher.add(input.frame, traced.draw, record, traced.triangles.hash);
        }
        hasher.add_waiting(world.waiting);
        let is_mover = |traced: &Traced<'_>| u32::from(traced.mask) & MASK_MOVING != 0;
        let rays = PixelRays::new(camera, size);
        if rays.is_parallel {
            traits |= TRACE_PARALLEL;
        }
        if self.smooths_edges() {
            traits |= TRACE_SMOOTH_EDGES;
        }
        Common {
            record: ViewRecord {
                frame: lists.frame,
                draws: lists.surfaces,
                members: lists.members,
                lights: lists.lights,
                light_nodes: lists.light_nodes,
                world: world.top_level,
                width: size[0],
                height: size[1],
                light_width: light_size[0],
                light_height: light_size[1],
                light_step: [0, 1].map(|side| size[side] as f32 / light_size[side] as f32),
                spare_samples: options.spare_samples(light_size),
                most_spare_samples: MOST_SPARE,
                longest: options.histories.map(|frames| frames.clamp(1, 63) as f32),
                far_count: surfaces.lights.far_count as u32,
                light_count: surfaces.lights.sources.len() as u32,
                most_surfaces: estimator.surfaces,
                asked: estimator.asked,
                candidates: estimator.candidates,
                traits,
                most_radiance: estimator.most_radiance,
                highlight: highlight(&input.frame.lights, &scene.lights),
                samples: options.spp.max(1),
                seed: options.seed,
                bake_scale: scene.relit.as_ref().map_or(0.0, |relit| relit.scale),
                bounce: scene.relit.as_ref().map_or([-1.0; 3], |relit| relit.bounce.to_array()),
                sky: scene.sky.to_array(),
                contact_reach: CONTACT_SHARE * world.extent,
                ambient: scene.ambient.to_array(),
                paint: options.paint as u32,
                pixel_spread: Vec3::from(rays.down).length(),
                has_movers: surfaces.traced.iter().any(is_mover).into(),
                sum_count: sum_count(size),
                exposure_rate: if self.has_exposure { EXPOSURE_RATE } else { 1.0 },
                forward: rays.forward,
                pixel_origin: rays.origin,
                pixel_right: rays.right,
                pixel_down: rays.down,
                ..record
            },
            hash: hasher.finish(),
            may_continue: estimator.accumulates
                && self.plan.output.is_none()
                && !changes_textures(input.frame),
        }
    }

    /// What a view needs, and its record. The first view that has an exposure finds it for the others.
    fn view(
        &mut self,
        view: usize,
        views: usize,
        kinds: &[SurfaceKind],
        common: &Common,
        finds_exposure: &mut bool,
    ) -> (ViewNeeds, ViewRecord) {
        let is_baked = kinds.iter().all(|kind| *kind == SurfaceKind::Baked);
        let is_picture = self.options.paint == Paint::Picture;
        let is_idle = is_baked && common.record.has_movers == 0 && is_picture && !self.options.keeps_radiance;
        if self.history.len() <= view {
            self.history.resize(view + 1, History::default());
        }
        let samples = common.record.samples;
        let may_continue = common.may_continue && !is_idle;
        let accumulated =
            self.history[view].advance(common.hash, may_continue, samples, common.record.frame_number);
        let has = |kind: SurfaceKind| kinds.contains(&kind);
        // What is relit is as bright as the bake.
        let is_relit = common.record.bake_scale > 0.0;
        let exposure = match has(SurfaceKind::Lit) && !is_relit {
            false => ExposureUse::None,
            true if std::mem::take(finds_exposure) => ExposureUse::Found { continues: self.has_exposure },
            true => ExposureUse::Shared,
        };
        let needs = ViewNeeds {
            is_reference: self.has_camera_rays,
            keeps_lights: Err(""),
            has_lights_before: false,
            is_idle,
            has_history: self.plan.output.is_some() && self.past.has_histories(views),
            smooths_edges: self.smooths_edges(),
            continues: accumulated > 0,
            exposure,
            has_movers: has(SurfaceKind::BakedMover),
        };
        let mut record = ViewRecord { accumulated, ..common.record };
        if self.plan.output.is_none() {
            record.first_sample = accumulated;
        }
        if self.plan.output.is_none() && self.mode == Mode::Pathtrace {
            // Each frame has other numbers, but those that add up have one sequence. Frames of `reference` are complete in
            // themselves.
            record.seed ^= self.history[view].begun().wrapping_mul(0x9e37_79b9);
        }
        if let Some(buffers) = &self.buffers {
            name_buffers(&mut record, buffers, &self.plan, self.past.parity(), view, needs.has_history);
        }
        (needs, record)
    }

    /// Whether pixels of a view keep lights; if so its record says where.
    fn keep_lights(
        &self,
        lights: &LightList,
        views: usize,
        record: &mut ViewRecord,
    ) -> Result<(), &'static str> {
        let reservoirs = self.buffers.as_ref().and_then(|buffers| buffers.reservoirs.as_ref());
        let reservoirs = reservoirs.filter(|_| self.options.keeps_lights && self.mode == Mode::Pathtrace);
        let [now, before] = match reservoirs {
            None => return Err("not asked for"),
            Some(both) => [self.past.parity(), 1 - self.past.parity()].map(|of| both[of].buffer.address()),
        };
        self.past.serves_lights(lights, record.asked, views, record.accumulated)?;
        record.reservoirs = now;
        if self.past.has_lights(lights) {
            record.reservoirs_before = before;
        }
        Ok(())
    }
}

/// Tells a record where the window's buffers are.
fn name_buffers(
    record: &mut ViewRecord,
    buffers: &ViewBuffers,
    plan: &Plan,
    parity: usize,
    view: usize,
    has_history: bool,
) {
    let optional = |tracked: &Option<Tracked>| tracked.as_ref().map_or(0, |of| of.buffer.address());
    record.surfaces = buffers.surfaces.buffer.address();
    record.surfaces_before = optional(&buffers.surfaces_before);
    record.light = buffers.light.get(view).map_or(0, |light| light.buffer.address());
    record.sums = buffers.sums.buffer.address();
    record.counters = buffers.counters.buffer.address();
    record.radiance = optional(&buffers.radiance);
    record.composed = optional(&buffers.composed);
    record.movers = buffers.movers.buffer.address();
    record.exposure = buffers.exposure.buffer.address();
    record.visibility = buffers.visibility_index;
    record.color = buffers.color_index;
    record.albedo = buffers.albedo_index;
    let Some(stores) = buffers.stores.get(view) else { return };
    let address = |store: Store| stores.address(store, parity);
    record.guides = address(Store::Guides);
    record.guides_before = if has_history { address(Store::GuidesBefore) } else { 0 };
    record.motions = address(Store::Motions);
    record.noisy = address(Store::Noisy);
    record.history = address(Store::History);
    if let (None, Some(spare)) = (&buffers.composed, plan.spare) {
        record.composed = address(spare);
    }
    record.denoised = plan.output.map_or(0, address);
    record.strata = address(Store::Strata);
    record.gradients = plan.gradients.map_or(0, address);
    record.luminances = address(Store::Luminances);
    record.fits = address(Store::Fits);
}
