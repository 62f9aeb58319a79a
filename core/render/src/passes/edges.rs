//! Smooth edges of triangles in what is composed, on its way into the window's colour.

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
    let mut pass = graph.pass("edges", PassKind::Compute);
    pass.read(views.visibility, Access::SampledCompute)
        .read(views.surfaces, Access::StorageReadCompute)
        .read_write(frame.color, Access::StorageWriteCompute)
        .when(!needs.is_idle, IDLE_REASON);
    if let Some(composed) = views.composed(view) {
        pass.read(composed, Access::StorageReadCompute);
    }
    if let Some(radiance) = views.radiance {
        pass.read_write(radiance, Access::StorageWriteCompute);
    }
}
