//! Brings this frame's new meshes, and its top level, to the device.

use afterglow_frame_graph::{Access, GraphBuilder, PassKind};
use afterglow_gpu::Commands;

use crate::pathtrace::meshes::{MeshCopy, record_copies};
use crate::pathtrace::schedule::ViewResources;

pub(crate) fn declare(graph: &mut GraphBuilder, views: &ViewResources, has_new_meshes: bool) {
    graph
        .pass("build", PassKind::Transfer)
        .read_write(views.world, Access::TransferDst)
        .when(has_new_meshes, "nothing is new in the world");
}

pub(crate) fn record(commands: &Commands<'_>, copies: &[MeshCopy]) {
    record_copies(commands, copies);
}
