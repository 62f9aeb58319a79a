//! Commands that the window system takes part in.

use afterglow_gl::Context;

/// glFlush: what is drawn to a single buffer is shown.
pub fn flush(gl: &mut Context) {
    gl.flush();
    #[cfg(target_os = "linux")]
    crate::glx::flushed(gl);
}

/// glFinish: what is drawn to a single buffer is handed over first.
pub fn finish(gl: &mut Context) {
    #[cfg(target_os = "linux")]
    crate::glx::flushed(gl);
    gl.finish();
}

/// glViewport: a program that was told of its window's new size comes here first.
pub fn viewport(gl: &mut Context, x: i32, y: i32, width: i32, height: i32) {
    gl.viewport(x, y, width, height);
    #[cfg(target_os = "linux")]
    crate::glx::viewport_set(gl, width, height);
}
