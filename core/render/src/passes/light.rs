//! Light of each pixel, by rays.

use afterglow_frame_graph::{Access, GraphBuilder, PassKind};

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
    let mut pass = graph.pass("light", PassKind::Compute);
    pass.read(views.surfaces, Access::StorageReadCompute)
        .read(views.world, Access::StorageReadCompute)
        .read(frame.geometry, Access::StorageReadCompute)
        .read(frame.textures, Access::StorageReadCompute)
        .read_write(views.counters, Access::StorageWriteCompute)
        .write(views.indirect[0], Access::StorageWriteCompute)
        .when(!needs.is_idle, IDLE_REASON);
    match needs.continues {
        true => pass.read_write(views.light[view], Access::StorageWriteCompute),
        false => pass.write(views.light[view], Access::StorageWriteCompute),
    };
}
