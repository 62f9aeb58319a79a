//! Mapped buffers: what the program wrote is recorded as a copy of the whole when they are unmapped.

use afterglow_api::constants::*;
use afterglow_gl::Context;
use afterglow_trace::write::Function;

use super::recorder::{Recorder, id_beyond_commands};
use super::thread;

/// Records the content of the buffer that glUnmapBuffer is about to take back.
pub fn before_unmap(recorder: &mut Recorder, gl: &mut Context, arguments: &[u64]) {
    let target = arguments[0] as u32;
    let Some(buffer) = gl.mapped_buffer(target) else { return };
    if gl.get_buffer_parameter(target, GL_BUFFER_ACCESS) == Some(GL_READ_ONLY as i32) {
        return;
    }
    let buffer = buffer.lock();
    if !buffer.data.is_empty() {
        copy(recorder, buffer.data.as_ptr() as u64, &buffer.data);
    }
}

/// Records `memcpy`.
fn copy(recorder: &mut Recorder, to: u64, bytes: &[u8]) {
    let function = Function { id: id_beyond_commands(0), name: "memcpy", arguments: &["dest", "src", "n"] };
    let writer = &mut recorder.writer;
    let number = writer.enter(thread(), &function);
    writer.fake();
    writer.argument(0);
    writer.pointer(to);
    writer.argument(1);
    writer.blob(bytes);
    writer.argument(2);
    writer.uint(bytes.len() as u64);
    writer.end();
    writer.leave(number);
    writer.end();
}
