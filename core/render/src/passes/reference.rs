//! Radiance by rays of the camera.

use afterglow_frame_graph::{Access, GraphBuilder, PassKind};

use crate::pathtrace::schedule::{ViewNeeds, ViewResources};
use crate::schedule::Resources;

pub(crate) fn declare(graph: &mut GraphBuilder, frame: &Resources, views: &ViewResources, needs: &ViewNeeds) {
    let Some(radiance) = views.radiance else { return };
    let mut pass = graph.pass("reference", PassKind::Compute);
    pass.read(views.world, Access::StorageReadCompute)
        .read(frame.geometry, Access::StorageReadCompute)
        .read(frame.textures, Access::StorageReadCompute)
        .read_write(views.counters, Access::StorageWriteCompute);
    match needs.continues {
        true => pass.read_write(radiance, Access::StorageWriteCompute),
        false => pass.write(radiance, Access::StorageWriteCompute),
    };
}
