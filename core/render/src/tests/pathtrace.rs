//! A world of a few triangles, traced: what a program draws with OpenGL's calls, and what rays make of it.

use std::sync::{Arc, Mutex};

use afterglow_api::constants::*;
use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::{Frame, PixelBuffer, Rect};
use afterglow_gl::{Context, Params, SharedNames};
use glam::Vec3;

use crate::testing::*;
use crate::{Displaced, Mode, PathtraceOptions, Renderer};

pub(super) const SIZE: (u32, u32) = (96, 72);
/// The middle of the shadow of the slab, and a place on the floor as far from the light that is open to it.
pub(super) const SHADOW: [u32; 2] = [48, 42];
pub(super) const OPEN: [u32; 2] = [16, 42];

/// One renderer that is looked at while a context draws with it.
pub(super) struct Stage {
    pub(super) gl: Context,
    pub(super) renderer: Arc<Mutex<Renderer>>,
}

struct Shared(Arc<Mutex<Renderer>>);

impl Backend for Shared {
    fn submit(&mut self, frame: Frame, end: End) {
        self.0.lock().unwrap().submit(frame, end);
    }

    fn answer(&mut self, so_far: Frame, request: Request) -> Reply {
        self.0.lock().unwrap().answer(so_far, request)
    }
}

impl Stage {
    pub(super) fn new(mode: Mode, change: impl FnOnce(&mut PathtraceOptions)) -> Self {
        let mut options = PathtraceOptions { spp: 4, accumulate: false, ..PathtraceOptions::default() };
        change(&mut options);
        let mut renderer = renderer();
        renderer.set_mode(mode, &options).unwrap();
        let renderer = Arc::new(Mutex::new(renderer));
        let mut gl = Context::new(Box::new(Shared(renderer.clone())), SharedNames::default());
        gl.set_drawable(SIZE.0, SIZE.1);
        Self { gl, renderer }
    }

    /// A lit floor, a slab over it that hides the light from its middle, and a strip of interface on top.
    /// `amid` is called when the floor was drawn.
    fn frame(&mut self, amid: impl FnOnce(&mut Context)) {
        let gl = &mut self.gl;
        gl.clear_color(0.1, 0.2, 0.3, 1.0);
        gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        look_down(gl);
        for capability in [GL_LIGHTING, GL_LIGHT0, GL_DEPTH_TEST] {
            gl.enable(capability);
        }
        gl.light(GL_LIGHT0, GL_POSITION, Params::Floats(&[0.0, 5.0, 0.0, 1.0]));
        slab(gl, 4.0);
        amid(gl);
        gl.translate(0.0, 1.5, 0.0);
        slab(gl, 0.8);
        for capability in [GL_LIGHTING, GL_DEPTH_TEST] {
            gl.disable(capability);
        }
        gl.matrix_mode(GL_PROJECTION);
        gl.load_identity();
        gl.color([1.0, 0.0, 0.0, 1.0]);
        gl.load_identity();
        gl.matrix_mode(GL_MODELVIEW);
        gl.load_identity();
        gl.rect([-1.0, 0.9], [1.0, 1.0]);
        gl.swap_buffers();
    }

    pub(super) fn picture(&self) -> Vec<u8> {
        self.renderer.lock().unwrap().read_color().unwrap()
    }

    /// The green of a pixel; rows count from the top.
    pub(super) fn brightness(&self, [x, y]: [u32; 2]) -> i32 {
        i32::from(self.picture()[((y * SIZE.0 + x) * 4 + 1) as usize])
    }
}

/// The camera of these worlds, which looks down at their floor.
pub(super) fn look_down(gl: &mut Context) {
    gl.matrix_mode(GL_PROJECTION);
    gl.load_identity();
    gl.frustum(-0.8, 0.8, -0.6, 0.6, 1.0, 50.0);
    gl.matrix_mode(GL_MODELVIEW);
    gl.load_identity();
    gl.translate(0.0, -0.5, -6.0);
    gl.rotate(35.0, 1.0, 0.0, 0.0);
}

/// A square that lies flat.
pub(super) fn slab(gl: &mut Context, half: f32) {
    gl.begin(GL_QUADS);
    gl.normal([0.0, 1.0, 0.0]);
    for [x, z] in [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
        gl.tex_coord([x, -z, 0.0, 1.0]);
        gl.vertex([x * half, 0.0, z * half, 1.0]);
    }
    gl.end();
}

#[test]
fn what_is_over_the_floor_shadows_it() {
    let mut raster = Stage::new(Mode::Raster, |_| {});
    raster.frame(|_| {});
    let mut traced = Stage::new(Mode::Pathtrace, |_| {});
    traced.frame(|_| {});
    assert!(raster.brightness(SHADOW) > 100, "the slab does not hide the place from the camera");
    let ratio = |stage: &Stage| f64::from(stage.brightness(SHADOW)) / f64::from(stage.brightness(OPEN));
    assert!(ratio(&raster) > 0.95, "{}", ratio(&raster));
    assert!(ratio(&traced) < 0.7, "{}", ratio(&traced));
    // The interface is what the program drew.
    assert_eq!(traced.picture()[..4], [255, 0, 0, 255]);
    assert_valid();
}

#[test]
fn the_shadow_follows_light_and_slab() {
    let still = |change: &dyn Fn(&mut PathtraceOptions)| {
        let mut stage = Stage::new(Mode::Pathtrace, change);
        stage.frame(|_| {});
        stage.brightness(SHADOW)
    };
    let shadowed = still(&|_| {});
    let light_aside = still(&|options| options.move_light = Some((0, Vec3::new(8.0, 0.0, 0.0))));
    let slab_aside =
        still(&|options| options.move_draw = Some((Displaced::Draw(1), Vec3::new(0.0, 0.0, -30.0))));
    assert!(light_aside > shadowed + 30, "{light_aside} {shadowed}");
    assert!(slab_aside > shadowed + 30, "{slab_aside} {shadowed}");
}

#[test]
fn two_runs_give_the_same_bits() {
    let picture = || {
        let mut stage = Stage::new(Mode::Pathtrace, |_| {});
        stage.frame(|_| {});
        stage.frame(|_| {});
        stage.picture()
    };
    assert_eq!(picture(), picture());
}

#[test]
fn a_question_amid_a_frame_changes_nothing_in_it() {
    let mut whole = Stage::new(Mode::Pathtrace, |_| {});
    let mut cut = Stage::new(Mode::Pathtrace, |_| {});
    for _ in 0..2 {
        whole.frame(|_| {});
        cut.frame(|gl| {
            let mut pixel = [0; 4];
            gl.read_pixels(SHADOW[0] as i32, 20, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, &mut pixel);
            assert_eq!(pixel[3], 255);
            assert!(pixel[1] > 100, "answered from what was drawn so far: {pixel:?}");
        });
        assert!(whole.picture() == cut.picture());
    }
    assert_valid();
}

#[test]
fn a_picture_of_the_finished_frame_is_what_is_shown() {
    let mut stage = Stage::new(Mode::Pathtrace, |_| {});
    stage.frame(|_| {});
    let shown = stage.picture();
    let rect = Rect { x: 0, y: 0, width: SIZE.0 as i32, height: SIZE.1 as i32 };
    let frame = Frame { size: SIZE, ..Frame::default() };
    let request = Request::Pixels { buffer: PixelBuffer::Color, rect };
    let reply = stage.renderer.lock().unwrap().answer(frame, request);
    let Reply::Color(pixels) = reply else { panic!("{reply:?}") };
    let rows: Vec<_> = pixels.chunks(SIZE.0 as usize * 4).rev().flatten().copied().collect();
    assert!(rows == shown);
}

#[test]
fn drawables_keep_their_pictures() {
    let mut stage = Stage::new(Mode::Pathtrace, |_| {});
    let select = |stage: &Stage, drawable| stage.renderer.lock().unwrap().select(drawable).unwrap();
    select(&stage, 1);
    stage.frame(|_| {});
    let first = stage.picture();
    select(&stage, 2);
    let mut small = FrameBuilder::new(8, 8);
    small.clear([0.0, 1.0, 0.0, 1.0]);
    stage.renderer.lock().unwrap().execute(&small.frame).unwrap();
    assert_eq!(stage.picture(), GREEN.repeat(64));
    select(&stage, 1);
    assert!(stage.picture() == first);
    stage.renderer.lock().unwrap().forget(2);
    stage.frame(|_| {});
    assert_valid();
}

/// A caster that is drawn at first and culled later; the program's camera can turn about.
fn stand(stage: &mut Stage, draws_slab: bool, turned: f32) {
    let gl = &mut stage.gl;
    gl.clear_color(0.1, 0.2, 0.3, 1.0);
    gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.matrix_mode(GL_PROJECTION);
    gl.load_identity();
    gl.frustum(-0.8, 0.8, -0.6, 0.6, 1.0, 50.0);
    gl.matrix_mode(GL_MODELVIEW);
    gl.load_identity();
    gl.rotate(turned, 1.0, 0.0, 0.0);
    gl.translate(0.0, -0.5, -6.0);
    gl.rotate(35.0, 1.0, 0.0, 0.0);
    for capability in [GL_LIGHTING, GL_LIGHT0, GL_DEPTH_TEST] {
        gl.enable(capability);
    }
    gl.light(GL_LIGHT0, GL_POSITION, Params::Floats(&[0.0, 5.0, 0.0, 1.0]));
    for height in [0.0, 1.5].into_iter().take(if draws_slab { 2 } else { 1 }) {
        gl.begin(GL_QUADS);
        gl.normal([0.0, 1.0, 0.0]);
        let half = if height > 0.0 { 0.8 } else { 4.0 };
        for [x, z] in [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
            gl.vertex([x * half, height, z * half, 1.0]);
        }
        gl.end();
    }
    gl.swap_buffers();
}

/// Degrees by which the camera looks down so that the slab is above the picture and its shadow is in it.
const DOWN: f32 = 30.0;

#[test]
fn what_was_drawn_before_shadows_the_floor_after_it_was_culled() {
    // Exposure still settles from frame to frame: the camera stays for a while before the slab is culled.
    let change = |memory: u64| {
        let mut stage = Stage::new(Mode::Pathtrace, |options| options.memory_bytes = memory);
        let mut brightness = |draws_slab: bool| {
            stand(&mut stage, draws_slab, DOWN);
            stage.picture().chunks(4).map(|pixel| f64::from(pixel[1])).sum::<f64>()
        };
        for _ in 0..30 {
            brightness(true);
        }
        let before = brightness(true);
        brightness(false) / before
    };
    let (with, without) = (change(1 << 20), change(0));
    assert!((with - 1.0).abs() < 0.005, "rays meet the slab as if it were drawn: {with}");
    assert!(without > 1.02, "without a memory its shadow is gone: {without}");
    assert_valid();
}

#[test]
fn what_is_gone_shadows_nothing() {
    let mut stage = Stage::new(Mode::Pathtrace, |_| {});
    for _ in 0..3 {
        stand(&mut stage, true, 0.0);
    }
    let shadowed = stage.brightness(SHADOW);
    for _ in 0..13 {
        stand(&mut stage, false, 0.0);
    }
    let bright = stage.brightness(SHADOW);
    assert!(bright > shadowed + 30, "{bright} {shadowed}");
    assert_valid();
}

#[test]
fn what_the_camera_turned_away_from_still_shadows() {
    // Stood at first so that the slab is in the picture; then it looks down by degrees until it is above the picture, and
    // the program culls it. Both programs end with the same picture rasterized.
    let shadow = |memory: u64, was_seen: bool| {
        let mut stage = Stage::new(Mode::Pathtrace, |options| options.memory_bytes = memory);
        for step in 0..=10 {
            let turned = DOWN * step as f32 / 10.0;
            stand(&mut stage, was_seen && turned < 0.9 * DOWN, turned);
        }
        // Exposure settles.
        for _ in 0..30 {
            stand(&mut stage, false, DOWN);
        }
        stage.picture().chunks(4).map(|pixel| f64::from(pixel[1])).sum::<f64>()
    };
    let (with, without, never) = (shadow(1 << 20, true), shadow(0, true), shadow(1 << 20, false));
    assert!(with < 0.98 * without, "the slab that was seen shadows the floor: {with} {without}");
    assert!((without / never - 1.0).abs() < 0.005, "without a memory nothing does: {without} {never}");
    assert_valid();
}
