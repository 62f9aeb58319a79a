//! What each pixel shows, from the visibility buffer.

use afterglow_frame_graph::{Access, GraphBuilder, PassKind};

use crate::pathtrace::denoise::Store;
use crate::pathtrace::schedule::{IDLE_REASON, ViewNeeds, ViewResources};
use crate::schedule::Resources;

pub(crate) fn declare(
    graph: &mut GraphBuilder,
    frame: &Resources,
    views: &ViewResources,
    view: usize,
    needs: &ViewNeeds,
) {
    let mut pass = graph.pass("surface", PassKind::Compute);
    pass.read(views.visibility, Access::SampledCompute)
        .read(views.albedo, Access::SampledCompute)
        // Not read yet, but named by the same array of images, which must all be ready then.
        .read(frame.color, Access::StorageReadCompute)
        .read(views.lists, Access::StorageReadCompute)
        .read(frame.geometry, Access::StorageReadCompute)
        .read(frame.textures, Access::StorageReadCompute)
        .write(views.surfaces, Access::StorageWriteCompute)
        .when(!needs.is_idle, IDLE_REASON);
    for store in [Store::Guides, Store::Motions] {
        if let Some(resource) = views.store(view, store) {
            pass.write(resource, Access::StorageWriteCompute);
        }
    }
}
