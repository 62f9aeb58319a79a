//! Brings this frame's new meshes, its top level, and the lists that rays read to the device.

use afterglow_frame_graph::{Access, GraphBuilder, PassKind};

use crate::pathtrace::schedule::ViewResources;

pub(crate) fn declare(graph: &mut GraphBuilder, views: &ViewResources, has_builds: bool) {
    let (kind, access) = views.backend.building();
    graph.pass("build", kind).read_write(views.world, access).when(has_builds, "nothing is new in the world");
}

pub(crate) fn declare_lists(graph: &mut GraphBuilder, views: &ViewResources, has_copies: bool) {
    graph
        .pass("lists", PassKind::Transfer)
        .read_write(views.lists, Access::TransferDst)
        .when(has_copies, "rays read what was written, or nothing has changed");
}
