//! Radiance by rays of the camera.

use afterglow_frame_graph::GraphBuilder;

use crate::pathtrace::schedule::{ViewNeeds, ViewResources};
use crate::schedule::Resources;

pub(crate) fn declare(graph: &mut GraphBuilder, frame: &Resources, views: &ViewResources, needs: &ViewNeeds) {
    let Some(radiance) = views.radiance else { return };
    let mut pass = graph.pass("reference", views.backend.pass());
    pass.read(views.world, views.backend.meets())
        .read(views.lists, views.backend.reads())
        .read(frame.geometry, views.backend.reads())
        .read(frame.textures, views.backend.reads())
        .read_write(views.counters, views.backend.writes());
    match needs.continues {
        true => pass.read_write(radiance, views.backend.writes()),
        false => pass.write(radiance, views.backend.writes()),
    };
}
