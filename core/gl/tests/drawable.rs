//! When frames end, by what the drawable has.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

use std::sync::{Arc, Mutex};

use afterglow_api::constants::*;
use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::{Frame, Operation};
use afterglow_gl::{Buffers, Context, SharedNames};

/// What was handed over: operations and end.
#[derive(Clone, Default)]
struct Recorder(Arc<Mutex<Vec<(Frame, End)>>>);

impl Recorder {
    fn ends(&self) -> Vec<(usize, End)> {
        self.0.lock().unwrap().iter().map(|(frame, end)| (frame.operations.len(), *end)).collect()
    }
}

impl Backend for Recorder {
    fn submit(&mut self, frame: Frame, end: End) {
        self.0.lock().unwrap().push((frame, end));
    }

    fn answer(&mut self, so_far: Frame, _: Request) -> Reply {
        self.submit(so_far, End::Continued);
        Reply::Color(vec![255; 4 * 4 * 4])
    }
}

fn context(is_double: bool) -> (Context, Recorder) {
    let recorder = Recorder::default();
    let mut context = Context::new(Box::new(recorder.clone()), SharedNames::default());
    context.set_buffers(Buffers { is_double, ..Buffers::default() });
    context.set_drawable(4, 4);
    (context, recorder)
}

#[test]
fn a_single_buffer_has_pictures_and_what_is_drawn_over_them() {
    let (mut gl, recorder) = context(false);
    assert!(gl.shows_at_once());
    gl.hand_over_picture();
    gl.rect([-1.0; 2], [1.0; 2]);
    gl.hand_over_picture();
    gl.clear(GL_COLOR_BUFFER_BIT);
    gl.rect([-1.0; 2], [1.0; 2]);
    gl.hand_over_picture();
    gl.rect([-1.0; 2], [1.0; 2]);
    gl.hand_over_picture();
    assert_eq!(recorder.ends(), [(1, End::Over), (2, End::Swap), (1, End::Over)]);
}

#[test]
fn a_clear_begins_a_picture_unless_it_is_of_a_part() {
    let (mut gl, recorder) = context(false);
    gl.clear(GL_COLOR_BUFFER_BIT);
    gl.hand_over_picture();
    gl.rect([-1.0; 2], [1.0; 2]);
    gl.hand_over_picture();
    gl.enable(GL_SCISSOR_TEST);
    gl.scissor(0, 0, 2, 4);
    gl.clear(GL_COLOR_BUFFER_BIT);
    gl.rect([-1.0; 2], [1.0; 2]);
    gl.hand_over_picture();
    assert_eq!(recorder.ends(), [(1, End::Continued), (1, End::Swap), (2, End::Over)]);
}

#[test]
fn the_front_buffer_of_two_shows_once() {
    let (mut gl, recorder) = context(true);
    assert!(!gl.shows_at_once());
    gl.draw_buffer(GL_FRONT);
    gl.rect([-1.0; 2], [1.0; 2]);
    assert!(gl.shows_at_once());
    gl.draw_buffer(GL_BACK);
    assert!(gl.shows_at_once() && !gl.shows_at_once());
    gl.swap_buffers();
    // What a program that swaps draws to the front buffer is no frame.
    gl.clear(GL_COLOR_BUFFER_BIT);
    gl.rect([-1.0; 2], [1.0; 2]);
    gl.hand_over_picture();
    assert_eq!(recorder.ends(), [(1, End::Swap), (2, End::Continued)]);
}

#[test]
fn copies_from_elsewhere_are_uploads() {
    let (mut gl, recorder) = context(true);
    gl.set_reads_elsewhere(true);
    gl.copy_tex_image(GL_TEXTURE_2D, 0, GL_RGBA, 0, 0, 4, Some(4), 0);
    gl.copy_pixels(0, 0, 4, 4, GL_COLOR);
    gl.set_reads_elsewhere(false);
    gl.copy_tex_image(GL_TEXTURE_2D, 0, GL_RGBA, 0, 0, 4, Some(4), 0);
    gl.swap_buffers();
    let frames = recorder.0.lock().unwrap();
    let count = |is_it: fn(&Operation) -> bool| {
        frames.iter().flat_map(|(frame, _)| &frame.operations).filter(|operation| is_it(operation)).count()
    };
    assert_eq!(
        count(|operation| matches!(operation, Operation::Upload(upload) if upload.texels[0] == 255)),
        1
    );
    assert_eq!(count(|operation| matches!(operation, Operation::Pixels(_))), 1);
    assert_eq!(count(|operation| matches!(operation, Operation::CopyToImage(_))), 1);
    assert_eq!(count(|operation| matches!(operation, Operation::CopyPixels(_))), 0);
}

#[test]
fn errors_between_begin_and_end_come_when_a_list_is_executed() {
    let (mut gl, _) = context(true);
    gl.new_list(1, GL_COMPILE);
    gl.begin(GL_TRIANGLES);
    gl.line_width(2.0);
    gl.end();
    gl.end_list();
    assert_eq!(gl.get_error(), GL_NO_ERROR);
    gl.call_list(1);
    assert_eq!(gl.get_error(), GL_INVALID_OPERATION);
    assert_eq!(gl.get_float(GL_LINE_WIDTH), [1.0]);
}
