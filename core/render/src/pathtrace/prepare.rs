//! From a judged frame to what its passes read: surfaces, the world, a record a view.

use afterglow_gpu::GpuError;
use afterglow_records::{MASK_MOVING, MeshMember, Paint, SurfaceKind, TRACE_PARALLEL, ViewRecord};
use afterglow_scene::Camera;
use bytemuck::Zeroable;
use glam::Vec3;

use super::backend::Backend;
use super::buffers::{ViewBuffers, sum_count};
use super::change::{ChangeHasher, History, changes_textures};
use super::estimator::Estimator;
use super::gather::{Surfaces, TraceInput, gather};
use super::lights::{LightList, highlight};
use super::lists::{FramePlace, List};
use super::options::{Mode, SkyChoice};
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
/// Samples a pixel below which indirect light is filtered in so many steps.
const FILTER_STEPS: [(u32, u32); 4] = [(16, 4), (64, 3), (128, 2), (512, 1)];

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
    tracer.kept.begin(&surfaces.lights);
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
    let parity = tracer.kept.parity();
    let mut keeps_lights = false;
    for (index, operations) in tracing.arrangement.views.iter().enumerate() {
        let kinds = surfaces.kinds_within(operations);
        let (mut needs, mut record) = tracer.view(index, &kinds, &common, &mut finds_exposure);
        needs.keeps_lights =
            tracer.keep_lights(&surfaces.lights, tracing.arrangement.views.len(), &mut record);
        needs.has_lights_before = record.reservoirs_before != 0;
        keeps_lights = needs.keeps_lights.is_ok();
        let record = input.arena.push(bytemuck::bytes_of(&record))?.address;
        views.push(PreparedView { record, needs });
    }
    tracer.kept.end(camera, origin, &surfaces.lights, keeps_lights);
    let seen_sky = if sky.is_mapped() { SkyChoice::Cube } else { SkyChoice::Constant };
    Ok(PreparedTrace {
        marks: surfaces.marks,
        views,
        parity,
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
        self.kept.write(&mut record, origin);
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
                far_count: surfaces.lights.far_count as u32,
                light_count: surfaces.lights.sources.len() as u32,
                most_surfaces: estimator.surfaces,
                asked: estimator.asked,
                candidates: estimator.candidates,
                traits: estimator.traits | if rays.is_parallel { TRACE_PARALLEL } else { 0 },
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
            may_continue: estimator.accumulates && !changes_textures(input.frame),
        }
    }

    /// What a view needs, and its record. The first view that has an exposure finds it for the others.
    fn view(
        &mut self,
        view: usize,
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
        let (filter_steps, filter_reason) = self.filter_steps(accumulated + samples);
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
            filter_steps,
            filter_reason,
            continues: accumulated > 0,
            exposure,
            has_movers: has(SurfaceKind::BakedMover),
        };
        // What is kept from frame to frame needs other numbers in each, but for those that go on with the same sequence.
        let begun = if self.options.keeps_lights { self.history[view].begun() } else { 0 };
        let seed = common.record.seed ^ begun.wrapping_mul(0x9e37_79b9);
        let mut record = ViewRecord { accumulated, seed, ..common.record };
        if let Some(buffers) = &self.buffers {
            name_buffers(&mut record, buffers, self.kept.parity(), view, filter_steps);
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
            Some(both) => [self.kept.parity(), 1 - self.kept.parity()].map(|of| both[of].buffer.address()),
        };
        self.kept.serves(lights, record.asked, views, record.accumulated)?;
        record.reservoirs = now;
        if self.kept.has_before() {
            record.reservoirs_before = before;
        }
        Ok(())
    }

    /// Steps of the filter for so many samples, and why there are no more.
    fn filter_steps(&self, samples: u32) -> (u32, &'static str) {
        if !self.options.filter || self.mode == Mode::Reference {
            return (0, "not asked for");
        }
        let steps = FILTER_STEPS.iter().find(|(most, _)| samples < *most);
        (steps.map_or(0, |(_, steps)| *steps), "there are samples enough")
    }
}

/// Tells a record where the window's buffers are.
fn name_buffers(
    record: &mut ViewRecord,
    buffers: &ViewBuffers,
    parity: usize,
    view: usize,
    filter_steps: u32,
) {
    record.surfaces = buffers.surfaces[parity].buffer.address();
    record.surfaces_before = buffers.surfaces[1 - parity].buffer.address();
    record.light = buffers.light.get(view).map_or(0, |light| light.buffer.address());
    record.indirect = buffers.indirect[filter_steps as usize % 2].buffer.address();
    record.sums = buffers.sums.buffer.address();
    record.counters = buffers.counters.buffer.address();
    record.radiance = buffers.radiance.as_ref().map_or(0, |radiance| radiance.buffer.address());
    record.movers = buffers.movers.buffer.address();
    record.exposure = buffers.exposure.buffer.address();
    record.visibility = buffers.visibility_index;
    record.color = buffers.color_index;
    record.albedo = buffers.albedo_index;
}
