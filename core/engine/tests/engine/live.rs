//! What a player changes while a program plays.

use std::path::Path;
use std::sync::mpsc;
use std::time::{Duration, Instant};

use afterglow_engine::{EngineOptions, Keys, OptionsSource};
use afterglow_gpu::Faults;
use afterglow_render::{Mode, Paint};
use x11rb::protocol::xproto::InputFocus;

use crate::failures::undisturbed;
use crate::program::{Program, SIDE, options};
use crate::server::Server;

const SIZE: (u32, u32) = (SIDE, SIDE);
/// Bytes of a picture below a message: rows come from the lowest one.
const BELOW: usize = (SIDE as usize - 24) * SIDE as usize * 4;

const CONTROL: u32 = 0xffe3;
const SHIFT: u32 = 0xffe1;
const HOME: u32 = 0xff50;
const PAGE_UP: u32 = 0xff55;
const PAGE_DOWN: u32 = 0xff56;
const END: u32 = 0xff57;
const INSERT: u32 = 0xff63;

/// With keys, and screenshots in a folder.
fn with_keys(mode: Mode, folder: &Path) -> EngineOptions {
    EngineOptions {
        keys: Some(Keys::default()),
        screenshots: Some(folder.to_owned()),
        ..options(mode, &Faults::default())
    }
}

/// The first file in a folder, once there is one that is written.
fn picture_in(folder: &Path, mut draw: impl FnMut()) -> image::RgbaImage {
    let begun = Instant::now();
    loop {
        draw();
        let file = std::fs::read_dir(folder).unwrap().next();
        if let Some(picture) = file.and_then(|file| image::open(file.unwrap().path()).ok()) {
            return picture.to_rgba8();
        }
        assert!(begun.elapsed() < Duration::from_secs(60), "there is no screenshot");
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn keys_change_the_mode_and_write_what_is_shown() {
    let Some(server) = Server::start() else { return };
    let (folder, raster) = (tempfile::tempdir().unwrap(), undisturbed(Mode::Raster, 3));
    let window = server.window(SIDE);
    server.focus(window);
    let mut program = Program::with(server.surface(window), with_keys(Mode::Raster, folder.path()), None);
    server.wait_for(window, SIZE, "a picture", || program.frame(), |shown| shown == raster);

    server.press(&[CONTROL, SHIFT, INSERT]);
    let shot = picture_in(folder.path(), || program.frame());
    assert_eq!(shot.dimensions(), SIZE);
    let rows = shot.as_raw().chunks(SIDE as usize * 4).rev().flatten().copied();
    assert!(rows.eq(raster.iter().copied()), "the file has another picture");
    server.wait_for(window, SIZE, "the message's end", || program.frame(), |shown| shown == raster);

    let press = |program: &mut Program, key, what: &str, serves: &dyn Fn(&[u8]) -> bool| {
        server.press(&[CONTROL, SHIFT, key]);
        server.wait_for(window, SIZE, what, || program.frame(), |shown| serves(&shown[..BELOW]));
    };
    press(&mut program, HOME, "another mode", &|shown| shown != &raster[..BELOW]);
    let traced = program.picture();
    assert!(traced[..BELOW] != raster[..BELOW]);
    press(&mut program, PAGE_DOWN, "another view", &|shown| shown != &traced[..BELOW]);
    // The reference, and the first again.
    server.press(&[CONTROL, SHIFT, HOME]);
    program.frames(3);
    press(&mut program, HOME, "the first mode", &|shown| shown == &raster[..BELOW]);
    server.press(&[CONTROL, SHIFT, PAGE_UP]);
    server.wait_for(window, SIZE, "no message", || program.frame(), |shown| shown == raster);
    assert!(program.picture() == raster);
}

#[test]
fn keys_of_other_windows_mean_nothing() {
    let Some(server) = Server::start() else { return };
    let (folder, raster) = (tempfile::tempdir().unwrap(), undisturbed(Mode::Raster, 3));
    let (window, other) = (server.window(SIDE), server.window_at(200, SIDE));
    server.focus(other);
    let mut program = Program::with(server.surface(window), with_keys(Mode::Raster, folder.path()), None);
    program.frames(3);
    let below = |shown: &[u8]| shown[..BELOW] == raster[..BELOW];
    server.wait_for(window, SIZE, "a picture", || program.frame(), below);
    for focus in [other, x11rb::NONE] {
        server.focus(focus);
        for keys in [HOME, INSERT, END] {
            server.press(&[CONTROL, SHIFT, keys]);
            program.frames(3);
        }
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    assert!(program.picture() == raster);
    // It was heard, though: with the focus it means something.
    server.focus(window);
    server.press(&[CONTROL, SHIFT, INSERT]);
    picture_in(folder.path(), || program.frame());
}

#[test]
fn the_focus_may_be_around_the_window_or_within_it_or_follow_the_pointer() {
    let Some(server) = Server::start() else { return };
    let around = server.window(SIDE);
    let window = server.window_within(around, 0, SIDE / 2);
    let within = server.window_within(window, 0, 4);
    server.point(20, 30);
    for focus in [around, window, within, InputFocus::POINTER_ROOT.into()] {
        let folder = tempfile::tempdir().unwrap();
        server.focus(focus);
        let options = with_keys(Mode::Raster, folder.path());
        let mut program = Program::with(server.surface(window), options, None);
        program.frames(5);
        program.picture();
        server.press(&[CONTROL, SHIFT, INSERT]);
        picture_in(folder.path(), || program.frame());
    }
    // Elsewhere the keys are another's.
    server.point(300, 200);
    let folder = tempfile::tempdir().unwrap();
    let mut program = Program::with(server.surface(window), with_keys(Mode::Raster, folder.path()), None);
    program.frames(5);
    program.picture();
    server.press(&[CONTROL, SHIFT, INSERT]);
    program.frames(5);
    program.picture();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// Options that a test sends.
struct Sent(mpsc::Receiver<EngineOptions>);

impl OptionsSource for Sent {
    fn changed(&mut self) -> Option<EngineOptions> {
        self.0.try_recv().ok()
    }
}

#[test]
fn a_source_changes_options_between_frames() {
    let (sender, receiver) = mpsc::channel();
    let first = options(Mode::Raster, &Faults::default());
    let source = Box::new(Sent(receiver));
    let mut program = Program::with(afterglow_engine::Surface::None, first.clone(), Some(source));
    let wait_for = |program: &mut Program, serves: &dyn Fn(&[u8]) -> bool| {
        let begun = Instant::now();
        while !serves(&program.picture()) {
            assert!(begun.elapsed() < Duration::from_secs(60), "nothing has changed");
            program.frame();
            std::thread::sleep(Duration::from_millis(20));
        }
    };
    program.frames(3);
    let raster = program.picture();
    let mut next = EngineOptions { mode: Some(Mode::Pathtrace), ..first };
    sender.send(next.clone()).unwrap();
    wait_for(&mut program, &|picture| picture != raster);
    program.frames(3);
    let traced = program.picture();
    next.pathtrace.paint = Paint::Normal;
    sender.send(next.clone()).unwrap();
    wait_for(&mut program, &|picture| picture != raster && picture != traced);
    next.mode = Some(Mode::Raster);
    sender.send(next).unwrap();
    wait_for(&mut program, &|picture| picture == raster);
}
