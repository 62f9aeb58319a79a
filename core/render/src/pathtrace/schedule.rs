//! The passes that light a view, declared in order.

use afterglow_frame_graph::{GraphBuilder, ResourceId, ResourceState};

use super::backend::Backend;
use super::buffers::ViewBuffers;
use super::prepare::PreparedTrace;
use crate::passes::{build, composite, exposure, filter, light, reference, reservoir, surface};
use crate::schedule::Resources;

/// What a pass of a view records; the number is the view's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TraceWork {
    Lists,
    Build,
    ClearCounters,
    /// Radiance by the camera's own rays.
    Reference(usize),
    Surface(usize),
    /// Which light of many each pixel keeps.
    Reservoir(usize),
    Light(usize),
    /// A step of the filter, of so many.
    Filter(usize, u32),
    ClearSums,
    Sum(usize),
    Exposure(usize),
    Composite(usize),
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
    /// Steps of the filter.
    pub(crate) filter_steps: u32,
    /// Why these are not more.
    pub(crate) filter_reason: &'static str,
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

/// Why nothing is lit in a view that needs no light.
pub(crate) const IDLE_REASON: &str = "nothing moves among surfaces with baked light";

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
    pub(crate) surfaces_before: ResourceId,
    /// This frame's and those of the one before.
    pub(crate) reservoirs: Option<[ResourceId; 2]>,
    pub(crate) light: Vec<ResourceId>,
    pub(crate) indirect: [ResourceId; 2],
    pub(crate) sums: ResourceId,
    pub(crate) exposure: ResourceId,
    pub(crate) movers: ResourceId,
    pub(crate) counters: ResourceId,
    pub(crate) radiance: Option<ResourceId>,
}

impl ViewResources {
    /// Declares what `buffers` holds, as the last frame left it, and what of it the next frame may need.
    pub(crate) fn declare(
        graph: &mut GraphBuilder,
        buffers: &ViewBuffers,
        [world, lists]: [ResourceState; 2],
        backend: Backend,
        parity: usize,
    ) -> Self {
        use afterglow_frame_graph::{Format, ImageDesc, ResourceDesc};
        let visibility = &buffers.visibility;
        let visibility_desc = ImageDesc::flat(buffers.size.into(), Format::Rg32Uint);
        let visibility = graph.import("visibility", visibility_desc, visibility.state);
        let albedo_desc = ImageDesc::flat(buffers.size.into(), Format::Rgba8Unorm);
        let albedo = graph.import("albedo", albedo_desc, buffers.albedo.state);
        let world = graph.import("world", ResourceDesc::Buffer { bytes: 1 }, world);
        let lists = graph.import("lists", ResourceDesc::Buffer { bytes: 1 }, lists);
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
            surfaces: import("surfaces", &buffers.surfaces[parity]),
            surfaces_before: import("surfaces before", &buffers.surfaces[1 - parity]),
            reservoirs: buffers.reservoirs.as_ref().map(|both| {
                [import("reservoirs", &both[parity]), import("reservoirs before", &both[1 - parity])]
            }),
            light: buffers.light.iter().map(|light| import("light", light)).collect(),
            indirect: [import("indirect", &buffers.indirect[0]), import("indirect", &buffers.indirect[1])],
            sums: import("exposure sums", &buffers.sums),
            exposure: import("exposure", &buffers.exposure),
            movers: import("mover sums", &buffers.movers),
            counters: import("trace counters", &buffers.counters),
            radiance: buffers.radiance.as_ref().map(|radiance| import("radiance", radiance)),
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
        for light in &resources.light {
            graph.output(*light);
        }
        resources
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
) {
    let needs = &prepared.views[view].needs;
    if view == 0 {
        work.push(TraceWork::Lists);
        build::declare_lists(graph, views, prepared.has_lists);
        work.push(TraceWork::Build);
        build::declare(graph, views, prepared.has_builds);
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
    surface::declare(graph, frame, views, needs);
    work.push(TraceWork::Reservoir(view));
    reservoir::declare(graph, frame, views, needs);
    work.push(TraceWork::Light(view));
    light::declare(graph, frame, views, view, needs);
    for step in 0..needs.filter_steps {
        work.push(TraceWork::Filter(view, step));
        filter::declare(graph, views, step, needs);
    }
    if needs.filter_steps == 0 {
        work.push(TraceWork::Filter(view, 0));
        filter::declare_culled(graph, views, needs);
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
}
