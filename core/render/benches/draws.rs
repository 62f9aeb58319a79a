//! What a draw costs the processor, and what a screen of fragments costs the device.
//!
//! `cargo bench -p afterglow-render` prints a line for each; `AFTERGLOW_DEVICE` names another device than lavapipe.

use std::time::{Duration, Instant};

use afterglow_gl::frame::{
    BaseFormat, Compare, Cull, CurrentAttributes, Depth, Dimension, Draw, Environment, FixedState, Format,
    Frame, ImageKey, ImageShape, ImageUpload, Operation, RasterState, Rect, Region, Sampler, Slot,
    StateWords, TexelFormat, TextureBinding, Topology, Transform, VertexLayout, VertexSource, Viewport, Wrap,
};
use afterglow_gpu::{Gpu, GpuOptions};
use afterglow_render::{RenderOptions, Renderer};
use bytemuck::Zeroable;

/// Pixels of the window.
const SIZE: (u32, u32) = (640, 480);
/// Draws of a frame: as many as a game of many small objects has.
const DRAWS: usize = 6500;
/// Fixed states that the draws change between.
const STATES: usize = 24;
/// Screens that are filled for one time.
const FILLS: usize = 40;
/// Runs of which the shortest counts.
const RUNS: usize = 10;

fn main() {
    let device = std::env::var("AFTERGLOW_DEVICE").unwrap_or_else(|_| "lavapipe".to_owned());
    let options = GpuOptions { device: Some(device), ..GpuOptions::default() };
    let gpu = match Gpu::new(&options) {
        Ok(gpu) => gpu,
        Err(error) => return println!("no device: {error}"),
    };
    println!("{}", gpu.info().name);
    for changes in [false, true] {
        let (recording, _) = times(&gpu, &many_draws(changes));
        let each = recording.as_secs_f64() * 1e6 / DRAWS as f64;
        let kind = if changes { "changing state" } else { "the same state" };
        println!("recording {DRAWS} draws of {kind}: {each:.2} us a draw");
    }
    for units in 0..=2 {
        let (_, whole) = times(&gpu, &fills(units));
        let pixels = (FILLS as u32 * SIZE.0 * SIZE.1) as f64;
        println!("filling with {units} textures: {:.2} ns a pixel", whole.as_secs_f64() * 1e9 / pixels);
    }
}

/// The shortest time until a frame was recorded, and until it was drawn.
fn times(gpu: &Gpu, frames: &[Frame; 2]) -> (Duration, Duration) {
    let mut renderer = Renderer::new(gpu, &RenderOptions::default()).expect("a renderer");
    renderer.execute(&frames[0]).expect("textures");
    let mut best = (Duration::MAX, Duration::MAX);
    for _ in 0..RUNS {
        renderer.finish().expect("a device that works");
        let start = Instant::now();
        renderer.execute(&frames[1]).expect("a frame");
        best.0 = best.0.min(start.elapsed());
        renderer.finish().expect("a device that works");
        best.1 = best.1.min(start.elapsed());
    }
    best
}

/// A frame that defines textures, and one of many small draws.
fn many_draws(changes: bool) -> [Frame; 2] {
    let (textures, image) = texture();
    let mut frame = scene(1, image);
    for state in 0..STATES {
        let mut fixed = frame.fixed[0];
        fixed.words.global.set_fog_mode((state % 4) as u32);
        fixed.raster.color_mask = 0b1000 | (state % 8) as u8;
        frame.fixed.push(fixed);
    }
    frame.viewports[0].rect = Rect { width: 8, height: 8, ..Rect::default() };
    for number in 0..DRAWS {
        let mut draw = full_screen();
        if changes {
            draw.fixed = (number * 7 % STATES) as u32;
        }
        frame.operations.push(Operation::Draw(draw));
    }
    [textures, frame]
}

/// A frame that defines textures, and one that fills the window again and again.
fn fills(units: usize) -> [Frame; 2] {
    let (textures, image) = texture();
    let mut frame = scene(units, image);
    frame.operations = vec![Operation::Draw(full_screen()); FILLS];
    [textures, frame]
}

fn texture() -> (Frame, ImageKey) {
    const SIDE: u32 = 256;
    let image = ImageKey::unique();
    let shape = ImageShape {
        dimension: Dimension::D2,
        width: SIDE,
        height: SIDE,
        depth: 1,
        levels: 1,
        format: TexelFormat::Rgba8,
        base_format: BaseFormat::Rgb,
    };
    let region = Region { level: 0, layer: 0, offset: [0; 3], extent: [SIDE, SIDE, 1] };
    let texels = vec![77; (SIDE * SIDE * 4) as usize].into();
    let operations = vec![
        Operation::DefineImage { image, shape },
        Operation::Upload(ImageUpload { image, region, texels }),
    ];
    (Frame { size: SIZE, operations, ..Frame::default() }, image)
}

/// A frame without operations: a quad over the viewport, with that many textures.
fn scene(units: usize, image: ImageKey) -> Frame {
    let sampler = Sampler {
        mag_linear: true,
        min_linear: true,
        mip_linear: None,
        wrap: [Wrap::Repeat; 3],
        min_lod: 0.0.into(),
        max_lod: 0.0.into(),
        border_color: [0.0.into(); 4],
        anisotropy: 1.0.into(),
        compare: None,
    };
    let mut frame = Frame { size: SIZE, ..Frame::default() };
    let mut words = StateWords::default();
    words.global.set_alpha_func(Compare::Always as u32);
    let mut bindings = [None; 4];
    #[expect(clippy::needless_range_loop, reason = "the unit numbers its own texture")]
    for unit in 0..units {
        words.units[unit].set_target(Dimension::D2 as u32);
        words.units[unit].set_base_format(BaseFormat::Rgb as u32);
        bindings[unit] = Some(TextureBinding { image, sampler });
    }
    frame.fixed.push(FixedState { words, raster: raster() });
    let rect = Rect { x: 0, y: 0, width: SIZE.0 as i32, height: SIZE.1 as i32 };
    frame.viewports.push(Viewport { rect, depth_range: [0.0, 1.0], scissor: None });
    frame.bindings.push(bindings);
    let mut transform = Transform::zeroed();
    for axis in 0..4 {
        transform.modelview[axis][axis] = 1.0;
        transform.modelview_projection[axis][axis] = 1.0;
    }
    frame.transforms.push(transform);
    frame.environments.push(Environment { fog_end: 1.0, ..Environment::zeroed() });
    frame.current.push(CurrentAttributes { color: [1.0; 4], ..CurrentAttributes::zeroed() });
    for corner in [[-1.0_f32, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
        let [x, y] = corner.map(f32::to_bits);
        frame.words.extend([x, y, 0, u32::MAX, x, y]);
    }
    frame.indices.extend([0, 1, 2, 0, 2, 3]);
    frame
}

fn raster() -> RasterState {
    RasterState {
        blend: None,
        logic_op: None,
        color_mask: 0xf,
        depth: Some(Depth { compare: Compare::Always, write: true }),
        stencil: None,
        cull: Cull::None,
        front_ccw: true,
        depth_bias: None,
        line_width: 1.0.into(),
        line_stipple: None,
    }
}

fn full_screen() -> Draw {
    Draw {
        source: VertexSource::Arena { first_word: 0, vertices: 4, first_index: 0 },
        layout: VertexLayout::default()
            .with(Slot::Position as usize, Format::F3)
            .with(Slot::Color as usize, Format::Unorm8x4)
            .with(Slot::Texture0 as usize, Format::F2),
        topology: Topology::Triangles,
        index_count: 6,
        fixed: 0,
        viewport: 0,
        bindings: 0,
        transform: 0,
        lights: 0,
        material: 0,
        environment: 0,
        texgen: 0,
        texture_matrices: 0,
        clip_planes: 0,
        current: 0,
        hint: 0,
    }
}
