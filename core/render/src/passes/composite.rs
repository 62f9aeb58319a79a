//! Traced light in place of the program's own in the window's colour.

use afterglow_frame_graph::{Access, GraphBuilder, PassKind};

use crate::pathtrace::denoise::Store;
use crate::pathtrace::schedule::{ExposureUse, IDLE_REASON, ViewNeeds, ViewResources};
use crate::schedule::Resources;

pub(crate) fn declare(
    graph: &mut GraphBuilder,
    frame: &Resources,
    views: &ViewResources,
    view: usize,
    needs: &ViewNeeds,
) {
    let mut pass = graph.pass("composite", PassKind::Compute);
    pass.read(views.visibility, Access::SampledCompute)
        .read(views.surfaces, Access::StorageReadCompute)
        .read_write(frame.color, Access::StorageWriteCompute)
        .when(!needs.is_idle, IDLE_REASON);
    let shown = [Store::Guides, Store::Motions, Store::History].map(|store| views.store(view, store));
    for resource in shown.into_iter().chain([views.clean_light(view)]).flatten() {
        pass.read(resource, Access::StorageReadCompute);
    }
    if let (Some(composed), true) = (views.composed(view), needs.smooths_edges) {
        pass.write(composed, Access::StorageWriteCompute);
    }
    if let Some(sky) = &views.sky {
        pass.read(sky.texels, Access::StorageReadCompute);
    }
    if let Some(radiance) = views.radiance {
        pass.write(radiance, Access::StorageWriteCompute);
    }
    if needs.has_movers {
        pass.read(views.movers, Access::StorageReadCompute);
    }
    if needs.exposure != ExposureUse::None {
        pass.read(views.exposure, Access::StorageReadCompute);
    }
}
