//! Which light of many each pixel keeps, before rays are sent.

use afterglow_frame_graph::{Access, GraphBuilder, PassKind};

use crate::pathtrace::schedule::{ViewNeeds, ViewResources};
use crate::schedule::Resources;

pub(crate) fn declare(graph: &mut GraphBuilder, frame: &Resources, views: &ViewResources, needs: &ViewNeeds) {
    let mut pass = graph.pass("reservoir", PassKind::Compute);
    pass.read(views.surfaces, Access::StorageReadCompute)
        .read(views.lists, Access::StorageReadCompute)
        .read(frame.geometry, Access::StorageReadCompute)
        .when(needs.keeps_lights.is_ok(), needs.keeps_lights.err().unwrap_or_default());
    if let Some([now, before]) = views.reservoirs {
        pass.write(now, Access::StorageWriteCompute);
        if needs.has_lights_before {
            pass.read(before, Access::StorageReadCompute);
            if let Some(surfaces) = views.surfaces_before {
                pass.read(surfaces, Access::StorageReadCompute);
            }
        }
    }
}
