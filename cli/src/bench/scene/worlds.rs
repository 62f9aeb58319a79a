//! Worlds made up to be measured: a hilly ground of triangles, sent in various ways, and things that move.

use std::f32::consts::TAU;
use std::sync::Arc;

use afterglow_gl::frame::{
    Compare, Cull, CurrentAttributes, Depth, Draw, Environment, FixedState, Format, Frame, Material,
    Operation, RasterState, Rect, RetainedRange, Slot, StateWords, Topology, Transform, VertexLayout,
    VertexSource, Viewport,
};
use bytemuck::Zeroable;
use glam::{Mat4, Vec3};

const SIZE: (u32, u32) = (640, 480);
/// Triangles of a draw, where a world is sent in many.
const BATCH: u32 = 256;
/// Of ranges or batches, one in so many is new in each frame of a world that changes.
const RENEWED: u32 = 100;
/// Triangles of a thing that moves.
const THING: u32 = 12;

/// How a world is sent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sent {
    /// In one range that stays.
    OneRange,
    /// In a hundred ranges, one of which is new in each frame.
    NewRanges,
    /// In arrays, batch by batch.
    Arrays,
    /// The same, and one batch in a hundred is new in each frame.
    NewArrays,
    /// As things of twelve triangles each, each with a matrix of its own that moves; all in one range.
    AlikeThings,
    /// The same, but each thing has a shape of its own, and is sent in arrays.
    UnlikeThings,
}

impl Sent {
    /// All ways.
    pub const ALL: [Sent; 6] = [
        Sent::OneRange,
        Sent::NewRanges,
        Sent::Arrays,
        Sent::NewArrays,
        Sent::AlikeThings,
        Sent::UnlikeThings,
    ];

    /// As it is written in reports.
    pub fn name(self) -> &'static str {
        match self {
            Sent::OneRange => "one retained range",
            Sent::NewRanges => "100 ranges, 1 % new",
            Sent::Arrays => "arrays, the same",
            Sent::NewArrays => "arrays, 1 % new",
            Sent::AlikeThings => "things alike, moving",
            Sent::UnlikeThings => "things unlike, moving",
        }
    }
}

/// A world that is sent frame by frame.
pub struct World {
    sent: Sent,
    triangles: u32,
    /// Ranges that stay from frame to frame.
    ranges: Vec<Arc<RetainedRange>>,
}

impl World {
    /// A world of so many triangles.
    pub fn new(sent: Sent, triangles: u32) -> World {
        let range = |first, count| Arc::new(retained(ground(first, count)));
        let ranges = match sent {
            Sent::OneRange => vec![range(0, triangles)],
            Sent::NewRanges => {
                let each = triangles.div_ceil(RENEWED);
                (0..RENEWED).map(|number| range(number * each, each)).collect()
            }
            Sent::AlikeThings => vec![range(0, 2), Arc::new(retained(thing(0)))],
            Sent::Arrays | Sent::NewArrays | Sent::UnlikeThings => Vec::new(),
        };
        World { sent, triangles, ranges }
    }

    /// The frame of a number, which starts from 0: the camera walks and turns.
    pub fn frame(&mut self, number: u32) -> Frame {
        let mut frame = empty();
        let walked = 0.05 * number as f32;
        let eye = Vec3::new(walked, 6.0, -0.5 * walked);
        let view = Mat4::from_rotation_y(0.01 * number as f32) * Mat4::from_translation(-eye);
        match self.sent {
            Sent::OneRange => self.draw_ranges(&mut frame, view),
            Sent::NewRanges => {
                let (each, renewed) = (self.triangles.div_ceil(RENEWED), number % RENEWED);
                // A place where nothing was before.
                let first = self.triangles + number * each;
                self.ranges[renewed as usize] = Arc::new(retained(ground(first, each)));
                self.draw_ranges(&mut frame, view);
            }
            Sent::Arrays | Sent::NewArrays => self.draw_arrays(&mut frame, view, number),
            Sent::AlikeThings | Sent::UnlikeThings => self.draw_things(&mut frame, view, number),
        }
        frame
    }

    fn draw_ranges(&self, frame: &mut Frame, view: Mat4) {
        let transform = set_modelview(frame, view);
        for range in &self.ranges {
            draw_retained(frame, range, transform);
        }
    }

    fn draw_arrays(&self, frame: &mut Frame, view: Mat4, number: u32) {
        let transform = set_modelview(frame, view);
        let batches = self.triangles.div_ceil(BATCH);
        for batch in 0..batches {
            let age = match self.sent {
                Sent::NewArrays => (number + batch) / RENEWED,
                _ => 0,
            };
            let count = BATCH.min(self.triangles - batch * BATCH);
            draw_arena(frame, &ground((age * batches + batch) * BATCH, count), transform);
        }
    }

    fn draw_things(&self, frame: &mut Frame, view: Mat4, number: u32) {
        let transform = set_modelview(frame, view);
        draw_arena(frame, &ground(0, 4096), transform);
        for thing_number in 0..self.triangles.div_ceil(THING) {
            let model = Mat4::from_translation(place(thing_number, number))
                * Mat4::from_rotation_y(0.1 * number as f32 + thing_number as f32);
            let transform = set_modelview(frame, view * model);
            match self.sent {
                Sent::AlikeThings => draw_retained(frame, &self.ranges[1], transform),
                _ => draw_arena(frame, &thing(thing_number), transform),
            }
        }
    }
}

/// Where a thing is: about a point of a grid.
fn place(thing: u32, frame: u32) -> Vec3 {
    let angle = 0.05 * frame as f32 + 0.7 * thing as f32;
    let at = Vec3::new((thing % 128) as f32, 2.0 + (thing / 16384) as f32, (thing / 128 % 128) as f32);
    3.0 * at + 0.8 * Vec3::new(angle.cos(), 0.0, angle.sin())
}

/// Corners of `count` triangles of a hilly ground, from triangle `first` on. No two are alike.
fn ground(first: u32, count: u32) -> Vec<Vec3> {
    let height = |x: f32, z: f32| (0.31 * x).sin() + (0.17 * z).cos();
    let corner = |x: u32, z: u32| {
        let (x, z) = (x as f32 - 256.0, z as f32 - 256.0);
        Vec3::new(x, height(x, z), z)
    };
    let triangle = |number: u32| {
        let (cell, half) = (number / 2, number % 2);
        let (x, z) = (cell % 512, cell / 512);
        match half {
            0 => [corner(x, z), corner(x, z + 1), corner(x + 1, z)],
            _ => [corner(x + 1, z), corner(x, z + 1), corner(x + 1, z + 1)],
        }
    };
    (first..first + count).flat_map(triangle).collect()
}

/// Corners of a thing about the origin; each number has another shape.
fn thing(number: u32) -> Vec<Vec3> {
    let point = |i: u32| {
        let angle = TAU * i as f32 / THING as f32;
        Vec3::new(angle.cos(), 0.3 * ((number + i) as f32).sin(), angle.sin())
    };
    (0..THING).flat_map(|i| [point(i), Vec3::Y, point(i + 1)]).collect()
}

fn layout() -> VertexLayout {
    VertexLayout::default()
        .with(Slot::Position as usize, Format::F3)
        .with(Slot::Texture0 as usize, Format::F2)
}

fn words_of(corners: &[Vec3]) -> impl Iterator<Item = u32> {
    corners.iter().flat_map(|at| [at.x, at.y, at.z, 0.25 * at.x, 0.25 * at.z].map(f32::to_bits))
}

fn retained(corners: Vec<Vec3>) -> RetainedRange {
    RetainedRange::new(layout(), words_of(&corners).collect(), (0..corners.len() as u32).collect())
}

fn draw_arena(frame: &mut Frame, corners: &[Vec3], transform: u32) {
    let count = corners.len() as u32;
    let source = VertexSource::Arena {
        first_word: frame.words.len() as u32,
        vertices: count,
        first_index: frame.indices.len() as u32,
    };
    frame.words.extend(words_of(corners));
    frame.indices.extend(0..count);
    frame.operations.push(Operation::Draw(draw(source, count, transform)));
}

fn draw_retained(frame: &mut Frame, range: &Arc<RetainedRange>, transform: u32) {
    let is_last = frame.retained.last().is_some_and(|last| Arc::ptr_eq(last, range));
    if !is_last {
        frame.retained.push(range.clone());
    }
    let source = VertexSource::Retained { range: frame.retained.len() as u32 - 1, first_index: 0 };
    frame.operations.push(Operation::Draw(draw(source, range.indices.len() as u32, transform)));
}

fn draw(source: VertexSource, index_count: u32, transform: u32) -> Draw {
    Draw {
        source,
        layout: layout(),
        topology: Topology::Triangles,
        index_count,
        fixed: 0,
        viewport: 0,
        bindings: 0,
        transform,
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

fn set_modelview(frame: &mut Frame, modelview: Mat4) -> u32 {
    let projection = glam::camera::rh::proj::opengl::perspective(1.2, 4.0 / 3.0, 0.1, 1000.0);
    let mut transform = Transform::zeroed();
    transform.modelview = modelview.to_cols_array_2d();
    transform.projection = projection.to_cols_array_2d();
    transform.modelview_projection = (projection * modelview).to_cols_array_2d();
    frame.transforms.push(transform);
    frame.transforms.len() as u32 - 1
}

/// A frame without draws: opaque, unlit, depth tested and written.
fn empty() -> Frame {
    let mut words = StateWords::default();
    words.global.set_alpha_func(Compare::Always as u32);
    let raster = RasterState {
        blend: None,
        logic_op: None,
        color_mask: 0xf,
        depth: Some(Depth { compare: Compare::LessEqual, write: true }),
        stencil: None,
        cull: Cull::None,
        front_ccw: true,
        depth_bias: None,
        line_width: 1.0.into(),
        line_stipple: None,
    };
    let rect = Rect { x: 0, y: 0, width: SIZE.0 as i32, height: SIZE.1 as i32 };
    let mut frame = Frame { size: SIZE, ..Frame::default() };
    frame.fixed.push(FixedState { words, raster });
    frame.viewports.push(Viewport { rect, depth_range: [0.0, 1.0], scissor: None });
    frame.bindings.push([None; 4]);
    frame.lights.push(Zeroable::zeroed());
    frame.materials.push(Material::zeroed());
    frame.environments.push(Environment::zeroed());
    frame.current.push(CurrentAttributes { color: [1.0; 4], ..CurrentAttributes::zeroed() });
    frame
}
