//! A picture of a frame in the colours of its classes, to be compared with what the program showed.

use std::io::{self, Write};

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, DVec4};

use super::{Drawn, Judged, triangles};

/// Pixels, rows from the top, with their depths.
struct Canvas {
    size: [usize; 2],
    pixels: Vec<[f64; 3]>,
    depths: Vec<f64>,
}

/// The colour of a class.
fn color(class: Class) -> [f64; 3] {
    match class {
        Class::Static => [0.75, 0.75, 0.75],
        Class::Movable => [0.2, 0.8, 0.2],
        Class::Dynamic => [0.9, 0.6, 0.1],
        Class::ViewModel => [0.9, 0.2, 0.9],
        Class::Translucent => [0.2, 0.8, 0.9],
        Class::Sky => [0.3, 0.4, 0.95],
        Class::Interface => [0.95, 0.95, 0.2],
        Class::Layer => [0.55, 0.45, 0.35],
        Class::OtherView => [0.5, 0.2, 0.6],
        Class::Dropped => [0.1, 0.1, 0.1],
        Class::Undecided => [0.95, 0.1, 0.1],
    }
}

/// Paints a frame as a PPM file (magic number P6).
///
/// # Errors
/// Those of `out`.
pub fn paint(out: &mut impl Write, drawn: &[Drawn], judged: &Judged) -> io::Result<()> {
    let extent = |i: usize| drawn.iter().map(|d| d.state.viewport[i] + d.state.viewport[i + 2]).max();
    let size = [0, 1].map(|i| extent(i).unwrap_or(1).clamp(1, 4096) as usize);
    let count = size[0] * size[1];
    let mut canvas = Canvas { size, pixels: vec![[0.0; 3]; count], depths: vec![1.0; count] };
    let mut clears = 0;
    for (drawn, (class, _)) in drawn.iter().zip(&judged.things) {
        if drawn.clears != clears {
            clears = drawn.clears;
            canvas.depths.fill(1.0);
        }
        canvas.draw(drawn, color(*class));
    }
    write!(out, "P6\n{} {}\n255\n", size[0], size[1])?;
    let bytes = canvas.pixels.iter().flatten().map(|c| (c.clamp(0.0, 1.0) * 255.0) as u8);
    out.write_all(&bytes.collect::<Vec<u8>>())
}

impl Canvas {
    fn draw(&mut self, drawn: &Drawn, color: [f64; 3]) {
        if !drawn.state.color_mask {
            return;
        }
        let (modelview, positions) = (drawn.modelview(), &drawn.positions);
        for corners in triangles::corners(drawn.mode, positions.len()) {
            let eye = corners.map(|corner| modelview.transform_point3(positions[corner].as_dvec3()));
            let normal = (eye[1] - eye[0]).cross(eye[2] - eye[0]).normalize_or_zero();
            let shade = 0.5 + 0.5 * normal.dot(DVec3::new(0.4, 0.5, 0.77)).abs();
            let polygon = clipped(eye, drawn.projection);
            for i in 2..polygon.len() {
                self.fill([polygon[0], polygon[i - 1], polygon[i]], drawn, color.map(|c| c * shade));
            }
        }
    }

    /// Fills a triangle in clip space whose corners are before the near plane.
    fn fill(&mut self, corners: [DVec4; 3], drawn: &Drawn, color: [f64; 3]) {
        let state = &drawn.state;
        let [x, y, width, height] = state.viewport.map(f64::from);
        let [near, far] = state.depth_range;
        let [a, b, c] = corners.map(|corner| {
            let ndc = corner.truncate() / corner.w;
            let at = (ndc.truncate() + 1.0) / 2.0;
            let row = self.size[1] as f64 - (y + at.y * height);
            DVec3::new(x + at.x * width, row, near + (far - near) * (ndc.z + 1.0) / 2.0)
        });
        let area = (b - a).truncate().perp_dot((c - a).truncate());
        // Rows count downward, so what turns left has a negative area.
        let is_front = (area < 0.0) == (state.front == GL_CCW);
        let is_culled = state.has(GL_CULL_FACE)
            && match state.culled {
                GL_FRONT => is_front,
                GL_BACK => !is_front,
                _ => true,
            };
        if area == 0.0 || is_culled {
            return;
        }
        let bounds = |i: usize| {
            let least = a[i].min(b[i]).min(c[i]).max(0.0) as usize;
            least..(a[i].max(b[i]).max(c[i]).max(0.0) as usize + 1).min(self.size[i])
        };
        let opacity = if state.blending().is_some() && !state.depth_mask { 0.4 } else { 1.0 };
        for (row, column) in bounds(1).flat_map(|row| bounds(0).map(move |column| (row, column))) {
            let at = glam::DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
            let side = |p: DVec3, q: DVec3| (q - p).truncate().perp_dot(at - p.truncate()) / area;
            let weights = [side(b, c), side(c, a), side(a, b)];
            if weights.iter().any(|weight| *weight < 0.0) {
                continue;
            }
            let depth = a.z * weights[0] + b.z * weights[1] + c.z * weights[2];
            let pixel = row * self.size[0] + column;
            // Nearly equal depths pass, as layers of a surface do.
            if state.has(GL_DEPTH_TEST) && depth > self.depths[pixel] + 1e-6 {
                continue;
            }
            if state.has(GL_DEPTH_TEST) && state.depth_mask {
                self.depths[pixel] = depth;
            }
            for (pixel, color) in self.pixels[pixel].iter_mut().zip(color) {
                *pixel += (color - *pixel) * opacity;
            }
        }
    }
}

/// What of a triangle is before the near plane, in clip space (Sutherland and Hodgman, *Reentrant Polygon Clipping*, 1974).
fn clipped(eye: [DVec3; 3], projection: DMat4) -> Vec<DVec4> {
    let corners = eye.map(|corner| projection * corner.extend(1.0));
    let inside = |corner: DVec4| corner.z + corner.w - 1e-6;
    let mut polygon = Vec::with_capacity(4);
    for (i, &from) in corners.iter().enumerate() {
        let to = corners[(i + 1) % 3];
        if inside(from) >= 0.0 {
            polygon.push(from);
        }
        if (inside(from) >= 0.0) != (inside(to) >= 0.0) {
            polygon.push(from.lerp(to, inside(from) / (inside(from) - inside(to))));
        }
    }
    polygon
}
