//! An X server for tests, without a screen, and windows on it.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use afterglow_engine::Surface;
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{
    ConfigureWindowAux, ConnectionExt, CreateWindowAux, ImageFormat, InputFocus, KEY_PRESS_EVENT,
    KEY_RELEASE_EVENT, WindowClass,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::xcb_ffi::XCBConnection;

/// How long something is waited for that must come.
const PATIENCE: Duration = Duration::from_secs(60);

pub(crate) struct Server {
    process: Child,
    display: String,
    connection: XCBConnection,
}

impl Server {
    /// A server of its own; none where there is no Xvfb.
    pub(crate) fn start() -> Option<Self> {
        let arguments = ["-displayfd", "1", "-screen", "0", "320x240x24", "-noreset"];
        let started =
            Command::new("Xvfb").args(arguments).stdout(Stdio::piped()).stderr(Stdio::null()).spawn();
        let Ok(mut process) = started else {
            eprintln!("there is no Xvfb: nothing was tested");
            return None;
        };
        let mut number = String::new();
        BufReader::new(process.stdout.as_mut().unwrap()).read_line(&mut number).unwrap();
        let display = format!(":{}", number.trim());
        let name = std::ffi::CString::new(display.clone()).unwrap();
        let (connection, _) = XCBConnection::connect(Some(&name)).unwrap();
        Some(Self { process, display, connection })
    }

    /// A window that is to be seen.
    pub(crate) fn window(&self, side: u32) -> u32 {
        self.window_at(8, side)
    }

    /// Likewise, so far from the screen's left edge.
    pub(crate) fn window_at(&self, x: i16, side: u32) -> u32 {
        self.window_within(self.root(), x, side)
    }

    /// Likewise, within another window.
    pub(crate) fn window_within(&self, around: u32, x: i16, side: u32) -> u32 {
        let (window, side) = (self.connection.generate_id().unwrap(), side as u16);
        let class = WindowClass::INPUT_OUTPUT;
        let values = CreateWindowAux::new();
        self.connection.create_window(24, window, around, x, 8, side, side, 0, class, 0, &values).unwrap();
        self.connection.map_window(window).unwrap().check().unwrap();
        window
    }

    pub(crate) fn surface(&self, window: u32) -> Surface {
        Surface::X11 { display: self.display.clone(), window }
    }

    pub(crate) fn resize(&self, window: u32, width: u32, height: u32) {
        let size = ConfigureWindowAux::new().width(width).height(height);
        self.connection.configure_window(window, &size).unwrap().check().unwrap();
    }

    fn root(&self) -> u32 {
        self.connection.setup().roots[0].root
    }

    /// Moves the pointer to a place on the screen.
    pub(crate) fn point(&self, x: i16, y: i16) {
        let moved = self.connection.warp_pointer(x11rb::NONE, self.root(), 0, 0, 0, 0, x, y);
        moved.unwrap().check().unwrap();
    }

    /// Gives a window, or nobody, the keyboard's focus.
    pub(crate) fn focus(&self, window: u32) {
        let set = self.connection.set_input_focus(InputFocus::NONE, window, x11rb::CURRENT_TIME);
        set.unwrap().check().unwrap();
    }

    /// Presses keys one after the other, holds them a moment as a hand does, and lets them go.
    pub(crate) fn press(&self, keysyms: &[u32]) {
        let codes: Vec<u8> = keysyms.iter().map(|keysym| self.keycode(*keysym)).collect();
        codes.iter().for_each(|code| self.fake(KEY_PRESS_EVENT, *code));
        std::thread::sleep(Duration::from_millis(60));
        codes.iter().rev().for_each(|code| self.fake(KEY_RELEASE_EVENT, *code));
    }

    fn fake(&self, kind: u8, keycode: u8) {
        let faked = self.connection.xtest_fake_input(kind, keycode, 0, x11rb::NONE, 0, 0, 0);
        faked.unwrap().check().unwrap();
    }

    fn keycode(&self, keysym: u32) -> u8 {
        let (first, last) = (self.connection.setup().min_keycode, self.connection.setup().max_keycode);
        let mapping = self.connection.get_keyboard_mapping(first, last - first + 1).unwrap().reply().unwrap();
        let width = usize::from(mapping.keysyms_per_keycode);
        let found = mapping.keysyms.chunks(width).position(|keysyms| keysyms[0] == keysym);
        first + found.expect("the server's keyboard has the key") as u8
    }

    /// What a window shows, as programs read it: four bytes a pixel, the lowest row first.
    fn shown(&self, window: u32, width: u32, height: u32) -> Vec<u8> {
        let (format, size) = (ImageFormat::Z_PIXMAP, (width as u16, height as u16));
        let image = self.connection.get_image(format, window, 0, 0, size.0, size.1, !0).unwrap();
        let pixels = image.reply().unwrap().data;
        let rows = pixels.chunks(width as usize * 4).rev();
        rows.flat_map(|row| row.chunks(4).flat_map(|pixel| [pixel[2], pixel[1], pixel[0], 255])).collect()
    }

    /// Waits until a window shows what serves. `draw` is called before each look.
    pub(crate) fn wait_for(
        &self,
        window: u32,
        (width, height): (u32, u32),
        what: &str,
        mut draw: impl FnMut(),
        serves: impl Fn(&[u8]) -> bool,
    ) {
        let begun = Instant::now();
        loop {
            draw();
            let shown = self.shown(window, width, height);
            if serves(&shown) {
                return;
            }
            let corner = shown[shown.len() - 4..].to_vec();
            assert!(begun.elapsed() < PATIENCE, "never shown: {what}; the upper right pixel is {corner:?}");
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
