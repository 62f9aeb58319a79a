//! Steps of the filter over indirect light.

use afterglow_frame_graph::{Access, GraphBuilder, PassKind};

use crate::pathtrace::schedule::{IDLE_REASON, ViewNeeds, ViewResources};

pub(crate) fn declare(graph: &mut GraphBuilder, views: &ViewResources, step: u32, needs: &ViewNeeds) {
    let from = step as usize % 2;
    graph
        .pass("filter", PassKind::Compute)
        .read(views.surfaces, Access::StorageReadCompute)
        .read(views.indirect[from], Access::StorageReadCompute)
        .write(views.indirect[1 - from], Access::StorageWriteCompute)
        .when(!needs.is_idle, IDLE_REASON);
}

/// A view that needs no filter, so that reports say why.
pub(crate) fn declare_culled(graph: &mut GraphBuilder, views: &ViewResources, needs: &ViewNeeds) {
    graph
        .pass("filter", PassKind::Compute)
        .write(views.indirect[1], Access::StorageWriteCompute)
        .when(!needs.is_idle, IDLE_REASON)
        .when(false, needs.filter_reason);
}
