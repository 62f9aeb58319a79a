//! Light of each pixel, by rays.

use afterglow_frame_graph::{Access, GraphBuilder, PassKind};

use crate::pathtrace::denoise::Store;
use crate::pathtrace::schedule::{IDLE_REASON, ViewNeeds, ViewResources};
use crate::schedule::Resources;

/// Sets the counters of what light leaves out to 0.
pub(crate) fn declare_clear(graph: &mut GraphBuilder, views: &ViewResources) {
    graph.pass("clear counters", PassKind::Transfer).write(views.counters, Access::TransferDst);
}

pub(crate) fn declare(
    graph: &mut GraphBuilder,
    frame: &Resources,
    views: &ViewResources,
    view: usize,
    needs: &ViewNeeds,
) {
    let mut pass = graph.pass("light", views.backend.pass());
    pass.read(views.surfaces, views.backend.reads())
        .read(views.world, views.backend.meets())
        .read(views.lists, views.backend.reads())
        .read(frame.geometry, views.backend.reads())
        .read(frame.textures, views.backend.reads())
        .read_write(views.counters, views.backend.writes())
        .when(!needs.is_idle, IDLE_REASON);
    if let Some(sky) = &views.sky {
        pass.read(sky.texels, views.backend.reads());
    }
    if let (Some([reservoirs, _]), Ok(())) = (views.reservoirs, needs.keeps_lights) {
        pass.read(reservoirs, views.backend.reads());
    }
    if let Some(light) = views.light.get(view) {
        match needs.continues {
            true => pass.read_write(*light, views.backend.writes()),
            false => pass.write(*light, views.backend.writes()),
        };
    }
    if let Some(strata) = views.store(view, Store::Strata) {
        pass.read(strata, views.backend.reads());
    }
    if let Some(guides) = views.store(view, Store::Guides) {
        pass.read(guides, views.backend.reads());
    }
    for store in [Store::Noisy, Store::Luminances] {
        if let Some(resource) = views.store(view, store) {
            pass.write(resource, views.backend.writes());
        }
    }
}
