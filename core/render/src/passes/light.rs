//! Light of each pixel, by rays.

use afterglow_frame_graph::{Access, GraphBuilder, PassKind};

use crate::pathtrace::schedule::{IDLE_REASON, ViewNeeds, ViewResources};
use crate::schedule::Resources;

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
        .write(views.indirect[0], Access::StorageWriteCompute)
        .when(!needs.is_idle, IDLE_REASON);
    match needs.continues {
        true => pass.read_write(views.light[view], Access::StorageWriteCompute),
        false => pass.write(views.light[view], Access::StorageWriteCompute),
    };
}
