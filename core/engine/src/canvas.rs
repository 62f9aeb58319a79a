//! Windows that pictures are copied to through the X server, where the device has no way to show them itself.

use std::error::Error;

use afterglow_gpu::GpuError;
use x11rb::connection::{Connection, RequestConnection};
use x11rb::protocol::xproto::{
    ConnectionExt, CreateGCAux, Gcontext, ImageFormat, ImageOrder, Setup, Visualid, Visualtype,
};

use crate::window::invalid;
use crate::xcb::Servers;

/// Bytes of the request before the pixels, rounded up.
const HEADER_BYTES: usize = 64;

/// A window to copy to.
pub(crate) struct Canvas {
    display: String,
    window: u32,
    /// As many bits a pixel as the window has.
    depth: u8,
    context: Gcontext,
}

impl Servers {
    /// A window of this server to copy to. Its pixels must have four bytes: blue, green, red and one more.
    pub(crate) fn canvas(&mut self, display: &str, window: u32) -> Result<Canvas, GpuError> {
        let connection = self.connection(display).map_err(|error| invalid("X server", error))?;
        let open = || -> Result<Canvas, Box<dyn Error>> {
            let depth = connection.get_geometry(window)?.reply()?.depth;
            let visual = connection.get_window_attributes(window)?.reply()?.visual;
            if !serves(connection.setup(), depth, visual) {
                return Err("its pixels do not have 8 bits a component".into());
            }
            let context = connection.generate_id()?;
            connection.create_gc(context, window, &CreateGCAux::new())?.check()?;
            Ok(Canvas { display: display.to_owned(), window, depth, context })
        };
        open().map_err(|error| invalid("window", error))
    }

    /// Copies a picture to a window: `width` pixels a row, of four bytes, red first, the highest row first. Returns the
    /// window's size.
    pub(crate) fn put(
        &mut self,
        canvas: &Canvas,
        width: u32,
        mut picture: Vec<u8>,
    ) -> Result<(u32, u32), GpuError> {
        for [red, _, blue, alpha] in picture.as_chunks_mut::<4>().0 {
            std::mem::swap(red, blue);
            *alpha = 255;
        }
        let connection = self.connection(&canvas.display).map_err(|error| invalid("X server", error))?;
        let row_bytes = width as usize * 4;
        let rows = ((connection.maximum_request_bytes() - HEADER_BYTES) / row_bytes.max(1)).max(1);
        let copy = || -> Result<(u32, u32), Box<dyn Error>> {
            for (index, pixels) in picture.chunks(rows * row_bytes).enumerate() {
                let piece = (pixels.len() / row_bytes) as u16;
                let (width, y) = (u16::try_from(width)?, i16::try_from(index * rows)?);
                let Canvas { window, depth, context, .. } = *canvas;
                let format = ImageFormat::Z_PIXMAP;
                let cookie =
                    connection.put_image(format, window, context, width, piece, 0, y, 0, depth, pixels)?;
                cookie.ignore_error();
            }
            // The answer comes when all of it was copied: no more than one picture is ever on its way.
            let answer = connection.get_geometry(canvas.window)?.reply()?;
            Ok((answer.width.into(), answer.height.into()))
        };
        copy().map_err(|error| invalid("window", error))
    }

    /// Gives back what the server holds for a canvas.
    pub(crate) fn release(&mut self, canvas: &Canvas) {
        if let Ok(connection) = self.connection(&canvas.display)
            && let Ok(cookie) = connection.free_gc(canvas.context)
        {
            cookie.ignore_error();
        }
    }
}

/// Whether pixels of this depth and visual are what is copied.
fn serves(setup: &Setup, depth: u8, visual: Visualid) -> bool {
    let has_four_bytes =
        |setup: &Setup| setup.pixmap_formats.iter().any(|it| it.depth == depth && it.bits_per_pixel == 32);
    let mut visuals = setup.roots.iter().flat_map(|root| &root.allowed_depths).flat_map(|it| &it.visuals);
    let is_blue_first = |it: &Visualtype| {
        it.visual_id == visual && (it.red_mask, it.green_mask, it.blue_mask) == (0xff_0000, 0xff00, 0xff)
    };
    setup.image_byte_order == ImageOrder::LSB_FIRST && has_four_bytes(setup) && visuals.any(is_blue_first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use x11rb::protocol::xproto::{Depth, Format, Screen};

    fn setup(bits_per_pixel: u8, red_mask: u32) -> Setup {
        let visual =
            Visualtype { visual_id: 33, red_mask, green_mask: 0xff00, blue_mask: 0xff, ..Default::default() };
        let depth = Depth { depth: 24, visuals: vec![visual] };
        Setup {
            pixmap_formats: vec![Format { depth: 24, bits_per_pixel, scanline_pad: 32 }],
            roots: vec![Screen { allowed_depths: vec![depth], ..Default::default() }],
            ..Default::default()
        }
    }

    #[test]
    fn pixels_have_four_bytes_with_blue_first() {
        assert!(serves(&setup(32, 0xff_0000), 24, 33));
        assert!(!serves(&setup(32, 0xff_0000), 24, 34));
        assert!(!serves(&setup(24, 0xff_0000), 24, 33));
        assert!(!serves(&setup(32, 0x7c00), 24, 33));
    }
}
