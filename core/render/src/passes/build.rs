//! Brings this frame's new meshes, and its top level, to the device.

use afterglow_frame_graph::GraphBuilder;

use crate::pathtrace::schedule::ViewResources;

pub(crate) fn declare(graph: &mut GraphBuilder, views: &ViewResources, has_builds: bool) {
    let (kind, access) = views.backend.building();
    graph.pass("build", kind).read_write(views.world, access).when(has_builds, "nothing is new in the world");
}
