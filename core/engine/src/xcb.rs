//! Connections of our own to X servers.

use std::collections::HashMap;

use afterglow_gpu::{Gpu, GpuError, WindowSurface};
use x11rb::errors::ReplyError;
use x11rb::protocol::xproto::ConnectionExt;
use x11rb::xcb_ffi::XCBConnection;

/// Connections by the server's name. They are never closed: surfaces depend on them.
#[derive(Default)]
pub(crate) struct Servers {
    connections: HashMap<String, XCBConnection>,
}

impl Servers {
    /// The surface of a window.
    pub(crate) fn surface(
        &mut self,
        gpu: &Gpu,
        display: &str,
        window: u32,
    ) -> Result<WindowSurface, GpuError> {
        let connection = self
            .connection(display)
            .map_err(|detail| GpuError::Invalid { what: "X server", detail })?
            .get_raw_xcb_connection();
        // SAFETY: connections live as long as the thread that owns all surfaces, and only it uses them.
        unsafe { gpu.xcb_surface(connection, window) }
    }

    /// Width and height of a window, pixels.
    pub(crate) fn size(&mut self, display: &str, window: u32) -> Option<(u32, u32)> {
        let answer = self.connection(display).ok()?.get_geometry(window).ok()?.reply().ok()?;
        Some((answer.width.into(), answer.height.into()))
    }

    pub(crate) fn connection(&mut self, display: &str) -> Result<&XCBConnection, String> {
        if !self.connections.contains_key(display) {
            self.connections.insert(display.to_owned(), connect(display)?);
        }
        Ok(&self.connections[display])
    }

    /// Whether a server has such a window. `true` where that cannot be known.
    pub(crate) fn has_window(&self, display: &str, window: u32) -> bool {
        let Some(connection) = self.connections.get(display) else { return true };
        let answer = connection.get_geometry(window).map(|cookie| cookie.reply());
        !matches!(answer, Ok(Err(ReplyError::X11Error(_))))
    }
}

fn connect(display: &str) -> Result<XCBConnection, String> {
    let name = std::ffi::CString::new(display).map_err(|error| error.to_string())?;
    XCBConnection::connect(Some(&name)).map(|(connection, _)| connection).map_err(|error| error.to_string())
}
