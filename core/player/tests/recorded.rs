//! Traces of small programs (`data/*.c`), recorded with apitrace: what reaches the contexts must be what the
//! programs did.

#![allow(clippy::unwrap_used, reason = "what a test expects, or else it fails")]

use std::sync::{Arc, Mutex};

use afterglow_api::constants::*;
use afterglow_gl::Context;
use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::{Format, Frame, Operation, Slot};
use afterglow_player::{DrawableSizes, Player, Step, TraceSummary};
use afterglow_trace::TraceReader;

/// Keeps the frames of all contexts, and parts of frames as they are asked about.
#[derive(Clone, Default)]
struct Kept(Arc<Mutex<Vec<Frame>>>);

impl Backend for Kept {
    fn submit(&mut self, frame: Frame, _: End) {
        self.0.lock().unwrap().push(frame);
    }

    fn answer(&mut self, so_far: Frame, _: Request) -> Reply {
        self.0.lock().unwrap().push(so_far);
        Reply::Unavailable
    }
}

fn path(name: &str) -> String {
    format!("{}/tests/data/{name}.trace", env!("CARGO_MANIFEST_DIR"))
}

fn player(name: &str) -> (Player, Kept) {
    let kept = Kept::default();
    let sizes = TraceSummary::open(path(name)).unwrap().sizes();
    let frames = kept.clone();
    let factory = move |_| Box::new(frames.clone()) as Box<dyn Backend>;
    (Player::new(TraceReader::open(path(name)).unwrap(), sizes, Box::new(factory)), kept)
}

/// Plays a frame and gives the context that drew it.
fn next_frame(player: &mut Player) -> &mut Context {
    player.next_frame().unwrap();
    player.context().unwrap()
}

fn array_buffer(gl: &mut Context, bytes: isize) -> Vec<u8> {
    gl.get_buffer_sub_data(GL_ARRAY_BUFFER, 0, bytes)
}

#[test]
fn a_summary_tells_sizes_and_counts() {
    let summary = TraceSummary::open(path("shared")).unwrap();
    assert_eq!((summary.calls, summary.swaps), (30, 3));
    assert_eq!(summary.largest_viewport, Some((64, 48)));
    assert_eq!(summary.drawables.values().copied().collect::<Vec<_>>(), [(64, 48), (32, 16)]);
    assert_eq!(summary.functions["glXSwapBuffers"], 3);
    assert!(summary.end.unwrap().is_clean());
}

#[test]
fn mapped_buffers_hold_what_the_program_wrote() {
    let (mut player, _) = player("mapped");
    let gl = next_frame(&mut player);
    let mut expected: Vec<u8> = (1..=36).collect();
    assert_eq!(array_buffer(gl, 36), expected);
    assert_eq!(gl.get_buffer_sub_data(GL_ELEMENT_ARRAY_BUFFER, 0, 3), [2, 7, 0]);

    expected[8..12].copy_from_slice(b"abcd");
    assert_eq!(array_buffer(next_frame(&mut player), 36), expected);

    expected[16..20].copy_from_slice(&[200, 201, 202, 203]);
    assert_eq!(array_buffer(next_frame(&mut player), 36), expected);
    assert_eq!(player.next_frame(), None);
    let report = player.report();
    assert!(report.unsupported.is_empty() && report.malformed.is_empty(), "{report:?}");
    assert_eq!(report.errors, []);
}

#[test]
fn lists_are_called_by_all_types_of_names() {
    let (mut player, _) = player("forms");
    let gl = next_frame(&mut player);
    assert_eq!(gl.get_float(GL_CURRENT_COLOR), [1.0 / 255.0, 2.0 / 255.0, 3.0 / 255.0, 1.0]);
    assert_eq!(gl.get_float(GL_CURRENT_NORMAL), [1.0, 1.0 / 255.0, -1.0]);
    // It was never generated; the two that were are deleted.
    assert!(gl.is_list(1000) && !gl.is_list(1) && !gl.is_list(2));
}

#[test]
fn arrays_in_the_programs_memory_are_drawn() {
    let (mut player, frames) = player("forms");
    player.next_frame();
    player.next_frame();
    let frames = frames.0.lock().unwrap();
    let frame = &frames[1];
    // Three quads; two lists of triangles twice; a quad and a triangle of locked arrays; a triangle by elements;
    // one of interleaved arrays. How many draws they are is up to the context.
    let indices: u32 = frame.draws().map(|(_, draw)| draw.index_count).sum();
    assert_eq!(indices, 3 * 6 + 4 * 3 + 6 + 3 + 3 + 3);
    let (_, last) = frame.draws().last().unwrap();
    let color = last.layout.offset(Slot::Color as usize);
    assert_eq!(last.layout.format(Slot::Color as usize), Format::Unorm8x4);
    let (words, indices) = frame.geometry(last);
    let colors = indices.iter().map(|&i| words[i as usize * last.layout.stride() + color].to_le_bytes());
    // A frame's triangles begin with the vertex that provokes flat shading: OpenGL's last.
    assert_eq!(colors.collect::<Vec<_>>(), [[9, 10, 11, 12], [1, 2, 3, 4], [5, 6, 7, 8]]);
}

#[test]
fn numbers_of_all_types_are_converted() {
    let (mut player, frames) = player("forms");
    player.next_frame();
    player.next_frame();
    let gl = next_frame(&mut player);
    assert_eq!(gl.get_light(GL_LIGHT0, GL_SPOT_EXPONENT).unwrap().floats(), [7.0]);
    let ambient = gl.get_light(GL_LIGHT0, GL_AMBIENT).unwrap().floats();
    assert!(ambient[0] == 1.0 && ambient[1].abs() < 1e-9, "{ambient:?}");
    assert_eq!(gl.get_tex_gen(GL_S, GL_OBJECT_PLANE).unwrap().floats(), [1.0, 2.0, 3.0, 4.0]);
    assert_eq!(gl.get_clip_plane(GL_CLIP_PLANE0), Some([1.0, 2.0, 3.0, 4.0]));
    assert_eq!(gl.get_pixel_map(GL_PIXEL_MAP_R_TO_R), [0.0, 1.0]);
    assert_eq!(gl.get_float(GL_CURRENT_RASTER_POSITION)[..2], [5.0, 6.0]);
    assert_eq!(gl.get_boolean(GL_EDGE_FLAG), [true]);
    assert_eq!(gl.get_float(GL_CURRENT_SECONDARY_COLOR)[..3], [1.0, 0.0, 128.0 / 255.0]);
    assert_eq!(gl.get_float(GL_CURRENT_FOG_COORDINATE), [0.5]);
    assert_eq!(gl.get_integer(GL_LINE_STIPPLE_PATTERN), [0xaaaa]);
    gl.active_texture(GL_TEXTURE1);
    assert_eq!(gl.get_float(GL_CURRENT_TEXTURE_COORDS), [3.0, 4.0, 0.0, 1.0]);
    let errors = player.report().errors;
    assert_eq!((errors.len(), &*errors[0].function, errors[0].error), (1, "glEnable", GL_INVALID_ENUM));
    let frames = frames.0.lock().unwrap();
    let rectangles: u32 = frames[2].draws().map(|(_, draw)| draw.index_count).sum();
    let clears = frames[2].operations.iter().filter(|operation| matches!(operation, Operation::Clear(_)));
    // The rectangle whose corners are one point covers nothing, but is drawn.
    assert_eq!((rectangles, clears.count()), (12, 1));
}

#[test]
fn images_have_the_programs_pixels() {
    let (mut player, frames) = player("forms");
    for _ in 0..3 {
        player.next_frame().unwrap();
    }
    let is_deleting = |player: &Player| {
        let signature = player.reader().signature(player.call().signature);
        &*signature.name == "glDeleteTextures"
    };
    let mut texels = [0; 64];
    while !is_deleting(&player) {
        player.context().unwrap().get_tex_image(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, &mut texels);
        player.context().unwrap().get_error();
        assert_eq!(player.step(), Step::Call);
    }
    // The part that was replaced begins with the second texel of the second row.
    assert_eq!((&texels[..5], &texels[20..25]), (&[1, 2, 3, 4, 0][..], &[1, 2, 3, 4, 0][..]));
    player.next_frame().unwrap();
    let gl = player.context().unwrap();
    assert_eq!(gl.get_polygon_stipple(), [0x33; 128]);
    assert_eq!(gl.get_tex_level_parameter(GL_TEXTURE_1D, 0, GL_TEXTURE_WIDTH), Some(4));
    let frames = frames.0.lock().unwrap();
    // Of the fourth frame, glReadPixels has handed over what came before.
    let before_reading = frames[3].operations.iter();
    let rectangles = before_reading.filter(|operation| matches!(operation, Operation::Pixels(_)));
    assert_eq!(rectangles.count(), 2, "one of two bitmaps is empty");
    drop(frames);
    let report = player.report();
    assert!(report.unsupported.is_empty() && report.malformed.is_empty(), "{report:?}");
}

#[test]
fn contexts_share_what_the_program_let_them_share() {
    let (mut player, _) = player("shared");
    let first = player.next_frame().unwrap();
    assert_eq!((first.frame, first.context), (0, Some(1)));
    let gl = player.context().unwrap();
    assert_eq!(gl.drawable(), (32, 16));
    assert_eq!(gl.get_float(GL_CURRENT_COLOR), [0.0, 1.0, 0.0, 1.0]);

    let second = player.next_frame().unwrap();
    assert_eq!((second.context, player.context().unwrap().drawable()), (Some(0), (64, 48)));

    let third = player.next_frame().unwrap();
    assert_eq!(third.context, Some(2));
    assert!(!player.context().unwrap().is_list(7), "it shares nothing");
    assert_eq!(player.next_frame(), None);
    assert_eq!(player.report().without_context, [("glEnable".into(), 1)].into());
}

#[test]
fn a_trace_that_is_cut_is_played_as_far_as_it_goes() {
    let whole = std::fs::read(path("forms")).unwrap();
    for length in (0..whole.len()).step_by(997) {
        let Ok(reader) = TraceReader::from_reader(std::io::Cursor::new(whole[..length].to_vec())) else {
            continue;
        };
        let frames = Kept::default();
        let factory = move |_| Box::new(frames.clone()) as Box<dyn Backend>;
        let mut player = Player::new(reader, DrawableSizes::all(8, 8), Box::new(factory));
        while player.next_frame().is_some() {}
        let report = player.report();
        assert!(report.failure.is_some() || !report.end.unwrap().is_clean(), "{length}: {report:?}");
        assert!(report.malformed.is_empty(), "{length}: {report:?}");
    }
}
