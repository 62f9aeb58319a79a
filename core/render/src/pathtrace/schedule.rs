//! The passes that light a view, declared in order.

use afterglow_frame_graph::{Format, GraphBuilder, ImageDesc, ResourceDesc, ResourceId, ResourceState};
use afterglow_records::SKY_EDGE;

use super::backend::Backend;
use super::buffers::{Tracked, VIEW_FORMATS, ViewBuffers};
use super::denoise::{Plan, Store, StoreResources};
use super::prepare::PreparedTrace;
use super::sky::{SIDES, SkyMap};
use crate::passes::{build, composite, edges, exposure, light, reference, reservoir, sky, surface};
use crate::schedule::Resources;

/// What a pass of a view records; the number is the view's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TraceWork {
    Lists,
    Build,
    Refit,
    ClearCounters,
    /// The sky on the sides of a cube.
    DrawSky,
    CopySky,
    /// A level of its map.
    SkyLevel(u32),
    /// Radiance by the camera's own rays.
    Reference(usize),
    Surface(usize),
    /// Which light of many each pixel keeps.
    Reservoir(usize),
    Light(usize),
    /// A step of the denoiser's before light is traced, by its number.
    BeforeLight(usize, usize),
    /// And after that.
    AfterLight(usize, usize),
    ClearSums,
    Sum(usize),
    Exposure(usize),
    Composite(usize),
    /// The smoothing of edges.
    Edges(usize),
}

/// What of a view's light is needed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ViewNeeds {
    /// The camera's own rays see it: nothing else is needed of it.
    pub(crate) is_reference: bool,
    /// Whether pixels keep lights from frame to frame, and why not.
    pub(crate) keeps_lights: Result<(), &'static str>,
    /// The frame before has left lights.
    pub(crate) has_lights_before: bool,
    /// Nothing in the picture would change by light.
    pub(crate) is_idle: bool,
    /// The frame before has left a history of the view.
    pub(crate) has_history: bool,
    pub(crate) smooths_edges: bool,
    /// The view's samples go on from earlier frames'.
    pub(crate) continues: bool,
    pub(crate) exposure: ExposureUse,
    /// Something moves in it among baked surfaces.
    pub(crate) has_movers: bool,
}

/// Where a view's exposure comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ExposureUse {
    /// Nothing in it needs one.
    None,
    /// It is found from this view's pixels; `continues` if there is an earlier frame's to go on from.
    Found { continues: bool },
    /// An earlier view of the frame has found it.
    Shared,
}

/// What must be done for the sky.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SkyNews {
    /// Nothing.
    None,
    /// It is drawn, and its map holds nothing yet that would be kept.
    Begins,
    /// It is drawn again.
    Changes,
}

/// Why nothing is lit in a view that needs no light.
pub(crate) const IDLE_REASON: &str = "nothing moves among surfaces with baked light";

/// The graph's resources that the sky's map is made of.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SkyResources {
    pub(crate) sides: ResourceId,
    pub(crate) drawn: ResourceId,
    pub(crate) texels: ResourceId,
}

/// The graph's resources that belong to views.
#[derive(Debug, Clone)]
pub(crate) struct ViewResources {
    /// What shoots rays.
    pub(crate) backend: Backend,
    pub(crate) visibility: ResourceId,
    pub(crate) albedo: ResourceId,
    pub(crate) world: ResourceId,
    /// Surfaces, lights, and what else rays read.
    pub(crate) lists: ResourceId,
    pub(crate) surfaces: ResourceId,
    pub(crate) surfaces_before: Option<ResourceId>,
    /// This frame's and those of the one before.
    pub(crate) reservoirs: Option<[ResourceId; 2]>,
    pub(crate) light: Vec<ResourceId>,
    pub(crate) stores: Vec<StoreResources>,
    /// Which of these holds clean light, and which is free then.
    clean: Option<Store>,
    spare: Option<Store>,
    composed: Option<ResourceId>,
    pub(crate) sums: ResourceId,
    pub(crate) exposure: ResourceId,
    pub(crate) movers: ResourceId,
    pub(crate) counters: ResourceId,
    pub(crate) radiance: Option<ResourceId>,
    /// None where the sky is the same everywhere.
    pub(crate) sky: Option<SkyResources>,
}

impl ViewResources {
    /// Declares what `buffers` holds, as the last frame left it, and what of it the next frame may need.
    pub(crate) fn declare(
        graph: &mut GraphBuilder,
        buffers: &ViewBuffers,
        [world, lists]: [ResourceState; 2],
        backend: Backend,
        parity: usize,
        plan: &Plan,
        sky: Option<&SkyMap>,
    ) -> Self {
        let visibility = &buffers.visibility;
        let [visibility_desc, albedo_desc] =
            VIEW_FORMATS.map(|format| ImageDesc::flat(buffers.size.into(), format));
        let visibility = graph.import("visibility", visibility_desc, visibility.state);
        let albedo = graph.import("albedo", albedo_desc, buffers.albedo.state);
        let world = graph.import("world", ResourceDesc::Buffer { bytes: 1 }, world);
        let lists = graph.import("lists", ResourceDesc::Buffer { bytes: 1 }, lists);
        let stores = buffers.stores.iter().map(|stores| stores.declare(graph, parity)).collect();
        let mut import = |name: &'static str, tracked: &super::buffers::Tracked| {
            let bytes = tracked.buffer.size();
            graph.import(name, ResourceDesc::Buffer { bytes }, tracked.state)
        };
        let resources = Self {
            backend,
            visibility,
            albedo,
            world,
            lists,
            surfaces: import("surfaces", &buffers.surfaces),
            surfaces_before: buffers.surfaces_before.as_ref().map(|before| import("surfaces before", before)),
            reservoirs: buffers.reservoirs.as_ref().map(|both| {
                [import("reservoirs", &both[parity]), import("reservoirs before", &both[1 - parity])]
            }),
            light: buffers.light.iter().map(|light| import("light", light)).collect(),
            stores,
            clean: plan.output,
            spare: plan.spare,
            composed: buffers.composed.as_ref().map(|composed| import("composed", composed)),
            sums: import("exposure sums", &buffers.sums),
            exposure: import("exposure", &buffers.exposure),
            movers: import("mover sums", &buffers.movers),
            counters: import("trace counters", &buffers.counters),
            radiance: buffers.radiance.as_ref().map(|radiance| import("radiance", radiance)),
            sky: sky.map(|sky| SkyResources::declare(graph, sky)),
        };
        graph.output(resources.world);
        graph.output(resources.lists);
        graph.output(resources.exposure);
        graph.output(resources.counters);
        graph.output(resources.surfaces);
        for resource in resources.reservoirs.into_iter().flatten() {
            graph.output(resource);
        }
        if let Some(radiance) = resources.radiance {
            graph.output(radiance);
        }
        if let Some(sky) = resources.sky {
            graph.output(sky.texels);
        }
        for light in &resources.light {
            graph.output(*light);
        }
        resources
    }
}

impl ViewResources {
    /// What composition takes the light of a view from.
    pub(crate) fn clean_light(&self, view: usize) -> Option<ResourceId> {
        match self.clean {
            Some(store) => self.stores.get(view)?.get(store),
            None => self.light.get(view).copied(),
        }
    }

    /// Where that is, if no store has room for what is shown before edges are smoothed.
    pub(crate) fn composed_alone(&self) -> Option<ResourceId> {
        self.composed
    }

    /// What is shown of a view before edges are smoothed.
    pub(crate) fn composed(&self, view: usize) -> Option<ResourceId> {
        self.composed.or_else(|| self.stores.get(view)?.get(self.spare?))
    }

    /// A store of a view, if there are any.
    pub(crate) fn store(&self, view: usize, store: Store) -> Option<ResourceId> {
        self.stores.get(view)?.get(store)
    }
}

impl SkyResources {
    fn declare(graph: &mut GraphBuilder, sky: &SkyMap) -> Self {
        let sides = ImageDesc { layers: SIDES, ..ImageDesc::flat((SKY_EDGE, SKY_EDGE), Format::Rgba8Unorm) };
        let mut buffer = |name, tracked: &Tracked| {
            graph.import(name, ResourceDesc::Buffer { bytes: tracked.buffer.size() }, tracked.state)
        };
        let (drawn, texels) = (buffer("drawn sky", &sky.drawn), buffer("sky map", &sky.texels));
        Self { sides: graph.import("sky", sides, sky.sides.state), drawn, texels }
    }
}

/// Declares the passes that make the map of the sky, of which nothing is recorded where nothing is new.
fn declare_sky(
    graph: &mut GraphBuilder,
    work: &mut Vec<TraceWork>,
    frame: &Resources,
    sky: &SkyResources,
    new: SkyNews,
) {
    let is_new = new != SkyNews::None;
    work.push(TraceWork::DrawSky);
    sky::declare_draw(graph, frame, sky, is_new);
    work.push(TraceWork::CopySky);
    sky::declare_copy(graph, sky, is_new);
    for level in sky::levels() {
        work.push(TraceWork::SkyLevel(level));
        let holds = level > 0 || new != SkyNews::Begins;
        sky::declare_level(graph, sky, holds, is_new);
    }
}

/// Declares the passes of a view; `work` gets what each of them records.
pub(crate) fn declare_view(
    graph: &mut GraphBuilder,
    work: &mut Vec<TraceWork>,
    frame: &Resources,
    views: &ViewResources,
    view: usize,
    prepared: &PreparedTrace,
    plan: &Plan,
) {
    let needs = &prepared.views[view].needs;
    if let (0, Some(sky)) = (view, &views.sky) {
        declare_sky(graph, work, frame, sky, prepared.sky.news());
    }
    if view == 0 {
        work.push(TraceWork::Lists);
        build::declare_lists(graph, views, prepared.has_lists);
        work.push(TraceWork::Build);
        build::declare(graph, views, prepared.has_builds);
        work.push(TraceWork::Refit);
        build::declare_moves(graph, views, prepared.has_moves);
        work.push(TraceWork::ClearCounters);
        light::declare_clear(graph, views);
    }
    if needs.is_reference {
        if view == 0 {
            work.push(TraceWork::Reference(view));
            reference::declare(graph, frame, views, needs);
        }
        return;
    }
    work.push(TraceWork::Surface(view));
    surface::declare(graph, frame, views, view, needs);
    work.push(TraceWork::Reservoir(view));
    reservoir::declare(graph, frame, views, needs);
    let stores = views.stores.get(view).cloned().unwrap_or_default();
    for (number, step) in plan.before_light.iter().enumerate() {
        work.push(TraceWork::BeforeLight(view, number));
        step.declare(graph, &stores, views.counters, needs);
    }
    work.push(TraceWork::Light(view));
    light::declare(graph, frame, views, view, needs);
    for (number, step) in plan.after_light.iter().enumerate() {
        work.push(TraceWork::AfterLight(view, number));
        step.declare(graph, &stores, views.counters, needs);
    }
    if needs.has_movers {
        work.push(TraceWork::ClearSums);
        exposure::declare_clear(graph, views, needs);
    }
    if needs.exposure != ExposureUse::Shared || needs.has_movers {
        work.push(TraceWork::Sum(view));
        exposure::declare_sum(graph, frame, views, view, needs);
    }
    if needs.exposure != ExposureUse::Shared {
        work.push(TraceWork::Exposure(view));
        exposure::declare(graph, views, needs);
    }
    work.push(TraceWork::Composite(view));
    composite::declare(graph, frame, views, view, needs);
    if needs.smooths_edges {
        work.push(TraceWork::Edges(view));
        edges::declare(graph, frame, views, view, needs);
    }
}
