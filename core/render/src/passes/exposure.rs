//! How bright the traced picture must be shown to be as bright as the program's own.

use afterglow_frame_graph::{Access, GraphBuilder, PassKind};

use crate::pathtrace::denoise::Store;
use crate::pathtrace::schedule::{ExposureUse, IDLE_REASON, ViewNeeds, ViewResources};
use crate::schedule::Resources;

/// Why no exposure is found.
const NOT_NEEDED: &str = "the program's colours are its light";

/// Sums of moving draws begin at zero.
pub(crate) fn declare_clear(graph: &mut GraphBuilder, views: &ViewResources, needs: &ViewNeeds) {
    graph
        .pass("exposure clear", PassKind::Transfer)
        .write(views.movers, Access::TransferDst)
        .when(!needs.is_idle, IDLE_REASON);
}

pub(crate) fn declare_sum(
    graph: &mut GraphBuilder,
    frame: &Resources,
    views: &ViewResources,
    view: usize,
    needs: &ViewNeeds,
) {
    let mut pass = graph.pass("exposure sums", PassKind::Compute);
    pass.read(views.visibility, Access::SampledCompute)
        .read(views.surfaces, Access::StorageReadCompute)
        .read(frame.color, Access::StorageReadCompute)
        .write(views.sums, Access::StorageWriteCompute)
        .when(!needs.is_idle, IDLE_REASON)
        .when(needs.exposure != ExposureUse::None || needs.has_movers, NOT_NEEDED);
    for resource in [views.clean_light(view), views.store(view, Store::Guides)].into_iter().flatten() {
        pass.read(resource, Access::StorageReadCompute);
    }
    if needs.has_movers {
        pass.read_write(views.movers, Access::StorageWriteCompute);
    }
}

/// The first exposure is found at once, so that nothing needs to have been there before.
pub(crate) fn declare(graph: &mut GraphBuilder, views: &ViewResources, needs: &ViewNeeds) {
    let mut pass = graph.pass("exposure", PassKind::Compute);
    pass.read(views.sums, Access::StorageReadCompute)
        .when(!needs.is_idle, IDLE_REASON)
        .when(needs.exposure != ExposureUse::None, NOT_NEEDED);
    match needs.exposure {
        ExposureUse::Found { continues: true } => {
            pass.read_write(views.exposure, Access::StorageWriteCompute)
        }
        _ => pass.write(views.exposure, Access::StorageWriteCompute),
    };
}
