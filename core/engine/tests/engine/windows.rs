//! Windows on an X server show what programs draw.

use afterglow_gpu::Faults;
use afterglow_render::Mode;

use crate::failures::{lost_at, undisturbed};
use crate::program::{Program, SIDE};
use crate::server::Server;

/// Rows of the line of figures.
const LINE_ROWS: usize = 24;
const SIZE: (u32, u32) = (SIDE, SIDE);

fn without_windows() -> Faults {
    let mut faults = Faults::default();
    faults.no_windows = true;
    faults
}

#[test]
fn windows_show_what_is_drawn() {
    let Some(server) = Server::start() else { return };
    let expected = undisturbed(Mode::Raster, 3);
    for (way, faults) in [("swapchain", Faults::default()), ("copies", without_windows())] {
        let window = server.window(SIDE);
        let mut program = Program::on(server.surface(window), Mode::Raster, &faults, false);
        program.frames(3);
        server.wait_for(window, SIZE, way, || (), |shown| shown == expected);
    }
}

#[test]
fn pictures_follow_the_size_of_the_window() {
    let Some(server) = Server::start() else { return };
    for faults in [Faults::default(), without_windows()] {
        let window = server.window(SIDE);
        let mut program = Program::on(server.surface(window), Mode::Raster, &faults, false);
        program.frames(3);
        for (width, height) in [(SIDE + 24, SIDE + 8), (SIDE - 24, SIDE), (1, 1), (SIDE, SIDE)] {
            server.resize(window, width, height);
            let drawable = program.drawable.clone();
            // The clear's colour reaches the upper right corner.
            let is_filled = |shown: &[u8]| {
                drawable.size() == (width, height) && shown[shown.len() - 4..] == [51, 102, 153, 255]
            };
            let what = format!("{width} x {height}");
            server.wait_for(window, (width, height), &what, || program.frame(), is_filled);
        }
    }
}

#[test]
fn windows_show_pictures_again_after_a_loss() {
    let Some(server) = Server::start() else { return };
    let expected = undisturbed(Mode::Raster, 3);
    // Two submissions a frame: drawing, and copying to the window.
    for submission in [9, 10] {
        let (window, faults) = (server.window(SIDE), lost_at(&[submission]));
        let mut program = Program::on(server.surface(window), Mode::Raster, &faults, false);
        program.frames(12);
        assert!(faults.all_struck());
        server.wait_for(
            window,
            SIZE,
            "a picture after the loss",
            || program.frame(),
            |shown| shown == expected,
        );
    }
}

#[test]
fn figures_are_over_what_is_shown_and_not_in_what_is_read() {
    let Some(server) = Server::start() else { return };
    let expected = undisturbed(Mode::Raster, 3);
    let below = (SIDE as usize - LINE_ROWS) * SIDE as usize * 4;
    for faults in [Faults::default(), without_windows()] {
        let window = server.window(SIDE);
        let mut program = Program::on(server.surface(window), Mode::Raster, &faults, true);
        program.frames(3);
        let has_line = |shown: &[u8]| {
            let (picture, line) = shown.split_at(below);
            let is_grey = |pixel: &[u8]| pixel[0] == pixel[1] && pixel[1] == pixel[2];
            picture == &expected[..below] && line.chunks(4).all(is_grey)
        };
        server.wait_for(window, SIZE, "figures", || program.frame(), has_line);
        assert!(program.picture() == expected);
    }
}
