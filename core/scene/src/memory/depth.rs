//! A coarse depth buffer of what a frame draws, by the processor: what hides what.
//!
//! Depth is clip space's w: the distance from the eye's plane in a perspective projection, whatever its handedness.
//! Where in doubt a pixel has the nearer depth, so that things count as hidden rather than as visible.

use afterglow_gl::frame::{Draw, Frame};
use glam::{Mat4, Vec2, Vec3, Vec4};

use super::keys::{Positions, position};
use crate::matrix;

/// Pixels.
const WIDTH: usize = 160;
const HEIGHT: usize = 90;
/// Triangles of a frame that are drawn, at most; with more there is no depth buffer.
const MOST_TRIANGLES: u64 = 400_000;
/// Triangles over fewer pixels than this in either direction cover all pixels that they touch.
const SMALL: f32 = 2.0;
/// Least w of what is drawn.
const NEAREST: f32 = 1e-4;

/// Nearest depth of each pixel.
#[derive(Debug)]
pub struct DepthBuffer {
    nearest: Vec<f32>,
    /// Greatest depth that anything was drawn at.
    pub farthest: f32,
    triangles: u64,
    /// Clip space of the last draw's vertices.
    clip: Vec<Vec4>,
}

impl Default for DepthBuffer {
    fn default() -> DepthBuffer {
        DepthBuffer { nearest: Vec::new(), farthest: 0.0, triangles: 0, clip: Vec::new() }
    }
}

impl DepthBuffer {
    /// Empties it.
    pub fn clear(&mut self) {
        self.nearest.clear();
        self.nearest.resize(WIDTH * HEIGHT, f32::INFINITY);
        self.farthest = 0.0;
        self.triangles = 0;
    }

    /// Whether there was no more to draw than it bears.
    pub fn is_complete(&self) -> bool {
        self.triangles <= MOST_TRIANGLES
    }

    /// Draws the triangles of a draw with its own matrices.
    pub fn draw(&mut self, frame: &Frame, draw: &Draw) {
        self.triangles += u64::from(draw.index_count / 3);
        let Some(transform) = frame.transforms.get(draw.transform as usize) else { return };
        if !self.is_complete() {
            return;
        }
        let [projection, modelview] = [&transform.projection, &transform.modelview].map(matrix::from_columns);
        let clip_from_object = (projection * modelview).as_mat4();
        let (words, indices) = frame.geometry(draw);
        let positions = Positions::new(words, draw.layout);
        let vertices = draw.layout.vertices_in(words.len()) as u32;
        let mut clip = std::mem::take(&mut self.clip);
        clip.clear();
        // A short part of a large range is not worth all of its vertices.
        let is_dense = vertices as usize <= 2 * indices.len();
        let corner = |vertex: u32| match positions.bits(vertex) {
            Some(bits) => clip_from_object * position(bits).extend(1.0),
            None => Vec4::NAN,
        };
        if is_dense {
            clip.extend((0..vertices).map(corner));
        }
        for triangle in indices.chunks_exact(3) {
            let of = |index: u32| match is_dense {
                true => clip.get(index as usize).copied().unwrap_or(Vec4::NAN),
                false => corner(index),
            };
            self.triangle([of(triangle[0]), of(triangle[1]), of(triangle[2])]);
        }
        self.clip = clip;
    }

    /// Draws a triangle of clip space.
    fn triangle(&mut self, corners: [Vec4; 3]) {
        let is_before = corners.map(|corner| corner.w > NEAREST);
        match is_before {
            [true, true, true] => self.fill(corners.map(to_pixels)),
            [false, false, false] => {}
            _ => self.clipped(corners),
        }
    }

    /// Draws the part of a triangle that is before the eye.
    fn clipped(&mut self, corners: [Vec4; 3]) {
        let (mut polygon, mut count) = ([Vec4::ZERO; 4], 0);
        for (i, &from) in corners.iter().enumerate() {
            let to = corners[(i + 1) % 3];
            let mut push = |corner| {
                polygon[count.min(3)] = corner;
                count += 1;
            };
            if from.w > NEAREST {
                push(from);
            }
            if (from.w > NEAREST) != (to.w > NEAREST) {
                let share = (NEAREST - from.w) / (to.w - from.w);
                push(from.lerp(to, share).with_w(NEAREST));
            }
        }
        let pixels = polygon.map(to_pixels);
        for last in 2..count.min(4) {
            self.fill([pixels[0], pixels[last - 1], pixels[last]]);
        }
    }

    /// Draws a triangle of pixels and depths.
    fn fill(&mut self, [a, b, c]: [Vec3; 3]) {
        let least = a.min(b).min(c);
        let most = a.max(b).max(c);
        let size = Vec2::new(WIDTH as f32, HEIGHT as f32);
        let is_seen = most.x >= 0.0 && most.y >= 0.0 && least.x < size.x && least.y < size.y;
        // Written so that what is not a number fails.
        if !(is_seen && most.z < f32::INFINITY) {
            return;
        }
        self.farthest = self.farthest.max(most.z);
        let [left, lower] = [least.x, least.y].map(|side| side.max(0.0) as usize);
        let right = (most.x.min(size.x - 1.0) as usize).max(left);
        let upper = (most.y.min(size.y - 1.0) as usize).max(lower);
        let extent = most - least;
        let area = (b - a).truncate().perp_dot((c - a).truncate());
        if extent.x < SMALL && extent.y < SMALL || area == 0.0 {
            for y in lower..=upper {
                for pixel in &mut self.nearest[y * WIDTH + left..=y * WIDTH + right] {
                    *pixel = pixel.min(least.z);
                }
            }
            return;
        }
        // 1/w is linear on the screen. Barycentric weights at the centre of the first pixel, and their steps.
        let inverse = Vec3::new(1.0 / a.z, 1.0 / b.z, 1.0 / c.z);
        let start = Vec2::new(left as f32 + 0.5, lower as f32 + 0.5);
        let edge = |from: Vec3, to: Vec3| {
            let along = (to - from).truncate() / area;
            (along.perp_dot(start - from.truncate()), -along.y, along.x)
        };
        let [(wa, xa, ya), (wb, xb, yb), (wc, xc, yc)] = [edge(b, c), edge(c, a), edge(a, b)];
        let (step_x, step_y) = (Vec3::new(xa, xb, xc), Vec3::new(ya, yb, yc));
        let mut row = Vec3::new(wa, wb, wc);
        for y in lower..=upper {
            let mut weights = row;
            for pixel in &mut self.nearest[y * WIDTH + left..=y * WIDTH + right] {
                if weights.min_element() >= 0.0 {
                    *pixel = pixel.min(1.0 / weights.dot(inverse));
                }
                weights += step_x;
            }
            row += step_y;
        }
    }

    /// The nearest depth about a point of clip space: of nine pixels. None if they are not all in the picture.
    pub fn about(&self, clip: Vec4) -> Option<f32> {
        let pixel = to_pixels(clip);
        let is_inside = clip.w > NEAREST
            && (1.0..WIDTH as f32 - 1.0).contains(&pixel.x)
            && (1.0..HEIGHT as f32 - 1.0).contains(&pixel.y);
        if !is_inside || self.nearest.len() < WIDTH * HEIGHT {
            return None;
        }
        let (x, y) = (pixel.x as usize, pixel.y as usize);
        let rows = self.nearest[(y - 1) * WIDTH..(y + 2) * WIDTH].chunks_exact(WIDTH);
        Some(rows.flat_map(|row| &row[x - 1..=x + 1]).copied().fold(f32::INFINITY, f32::min))
    }
}

/// Pixels from the lower left corner, and depth.
fn to_pixels(clip: Vec4) -> Vec3 {
    let [x, y] = [clip.x, clip.y].map(|side| 0.5 + 0.5 * side / clip.w);
    Vec3::new(x * WIDTH as f32, y * HEIGHT as f32, clip.w)
}

/// Whether a box may reach into the picture.
pub fn may_be_seen(clip_from_world: Mat4, [least, most]: [Vec3; 2]) -> bool {
    let corners: [Vec4; 8] = std::array::from_fn(|i| {
        let pick = |axis: usize| if i >> axis & 1 == 0 { least[axis] } else { most[axis] };
        clip_from_world * Vec4::new(pick(0), pick(1), pick(2), 1.0)
    });
    let all = |is_outside: fn(&Vec4) -> bool| corners.iter().all(is_outside);
    let is_outside = all(|c| c.w <= 0.0)
        || all(|c| c.x > c.w)
        || all(|c| c.x < -c.w)
        || all(|c| c.y > c.w)
        || all(|c| c.y < -c.w);
    !is_outside
}

#[cfg(test)]
mod tests {
    use super::*;

    fn buffer(triangles: &[[Vec4; 3]]) -> DepthBuffer {
        let mut buffer = DepthBuffer::default();
        buffer.clear();
        triangles.iter().for_each(|triangle| buffer.triangle(*triangle));
        buffer
    }

    /// Clip space of a point at a depth, by where it is on the screen.
    fn at(x: f32, y: f32, depth: f32) -> Vec4 {
        Vec4::new(x * depth, y * depth, 0.0, depth)
    }

    #[test]
    fn the_nearest_of_what_is_about_a_point_counts() {
        let wall = |depth| [at(-3.0, -3.0, depth), at(3.0, -3.0, depth), at(0.0, 6.0, depth)];
        let buffer = buffer(&[wall(5.0), wall(9.0)]);
        let found = buffer.about(at(0.1, 0.2, 7.0)).unwrap();
        assert!((found - 5.0).abs() < 1e-4, "{found}");
        assert_eq!(buffer.about(at(1.0, 0.0, 7.0)), None);
        assert_eq!(buffer.about(-at(0.0, 0.0, 7.0)), None);
        assert_eq!(buffer.farthest, 9.0);
    }

    #[test]
    fn depth_is_right_across_perspective_and_behind_the_eye() {
        // A floor one below the eye: depth at height y on the screen is -1 / y.
        let floor = [
            Vec4::new(-50.0, -1.0, 0.0, -5.0),
            Vec4::new(50.0, -1.0, 0.0, -5.0),
            Vec4::new(0.0, -1.0, 0.0, 100.0),
        ];
        let found = buffer(&[floor]).about(at(0.0, -0.5, 1.0)).unwrap();
        // One pixel lower, which is nearer.
        let nearest = 1.0 / (0.5 + 1.5 / 45.0);
        assert!((nearest - 0.01..2.0).contains(&found), "{found}");
    }

    #[test]
    fn small_triangles_are_not_lost_between_pixels_and_numbers_that_are_none_are() {
        let tiny = [at(0.0101, 0.0201, 3.0), at(0.0102, 0.0201, 3.0), at(0.0101, 0.0202, 3.0)];
        assert_eq!(buffer(&[tiny]).about(at(0.01, 0.02, 9.0)), Some(3.0));
        let nan = [Vec4::NAN, at(0.0, 0.0, 1.0), at(1.0, 1.0, f32::INFINITY)];
        assert_eq!(buffer(&[nan, [Vec4::INFINITY; 3]]).about(at(0.0, 0.0, 9.0)), Some(f32::INFINITY));
    }

    #[test]
    fn boxes_beside_and_behind_are_not_seen() {
        let clip_from_world = glam::camera::rh::proj::opengl::perspective(1.0, 1.0, 0.1, 100.0);
        let about = |x: f32, z: f32| [Vec3::new(x - 1.0, -1.0, z - 1.0), Vec3::new(x + 1.0, 1.0, z + 1.0)];
        assert!(may_be_seen(clip_from_world, about(0.0, -10.0)));
        assert!(may_be_seen(clip_from_world, about(0.0, 0.0)));
        assert!(!may_be_seen(clip_from_world, about(0.0, 10.0)));
        assert!(!may_be_seen(clip_from_world, about(30.0, -10.0)));
    }
}
