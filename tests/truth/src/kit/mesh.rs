//! Meshes as programs send them: primitives of vertices.

use afterglow_api::constants::*;
use glam::{Affine3A, Vec2, Vec3};

/// A vertex with all that a style may send of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// Object space.
    pub position: Vec3,
    /// Unit vector.
    pub normal: Vec3,
    /// Of the texture.
    pub uv: Vec2,
    /// Of the lightmap.
    pub light_uv: Vec2,
    /// RGBA.
    pub color: [u8; 4],
}

impl Vertex {
    /// A white vertex.
    pub fn new(position: Vec3, normal: Vec3, uv: Vec2) -> Vertex {
        Vertex { position, normal, uv, light_uv: Vec2::ZERO, color: [255; 4] }
    }
}

/// What goes between glBegin and glEnd.
#[derive(Debug, Clone, PartialEq)]
pub struct Primitive {
    /// GL_TRIANGLES, GL_QUAD_STRIP, ...
    pub mode: u32,
    /// In order.
    pub vertices: Vec<Vertex>,
}

/// Triangles that OpenGL makes of so many vertices (specification 2.6.1).
pub fn triangles_of(mode: u32, vertices: usize) -> u64 {
    let count = match mode {
        GL_TRIANGLES => vertices / 3,
        GL_QUADS => vertices / 4 * 2,
        GL_QUAD_STRIP => (vertices / 2).saturating_sub(1) * 2,
        GL_TRIANGLE_STRIP | GL_TRIANGLE_FAN | GL_POLYGON => vertices.saturating_sub(2),
        _ => 0,
    };
    count as u64
}

/// Primitives that are drawn together.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// In order.
    pub primitives: Vec<Primitive>,
}

impl Mesh {
    /// A mesh of one primitive.
    pub fn of(mode: u32, vertices: Vec<Vertex>) -> Mesh {
        Mesh { primitives: vec![Primitive { mode, vertices }] }
    }

    /// Triangles in all.
    pub fn triangles(&self) -> u64 {
        self.primitives.iter().map(|p| triangles_of(p.mode, p.vertices.len())).sum()
    }

    /// All vertices.
    pub fn vertices_mut(&mut self) -> impl Iterator<Item = &mut Vertex> {
        self.primitives.iter_mut().flat_map(|primitive| &mut primitive.vertices)
    }

    /// Adds vertices, to the last primitive if it is of that kind, which is of separate polygons.
    pub fn push(&mut self, mode: u32, vertices: &[Vertex]) {
        let is_separate = matches!(mode, GL_TRIANGLES | GL_QUADS);
        match self.primitives.last_mut() {
            Some(last) if is_separate && last.mode == mode => last.vertices.extend_from_slice(vertices),
            _ => self.primitives.push(Primitive { mode, vertices: vertices.to_vec() }),
        }
    }

    /// Adds another mesh.
    pub fn append(&mut self, other: &Mesh) {
        for primitive in &other.primitives {
            self.push(primitive.mode, &primitive.vertices);
        }
    }

    /// The mesh moved, as programs do that transform on the CPU.
    pub fn transformed(&self, by: Affine3A) -> Mesh {
        let mut mesh = self.clone();
        for vertex in mesh.vertices_mut() {
            vertex.position = by.transform_point3(vertex.position);
            vertex.normal = by.transform_vector3(vertex.normal).normalize_or_zero();
        }
        mesh
    }

    /// The mesh in one colour.
    pub fn colored(mut self, color: [u8; 4]) -> Mesh {
        self.vertices_mut().for_each(|vertex| vertex.color = color);
        self
    }

    /// Adds a parallelogram in `steps` by `steps` quads. Texture coordinates go from 0 to `repeats`.
    pub fn parallelogram(&mut self, corner: Vec3, along: [Vec3; 2], steps: u32, repeats: Vec2) {
        let normal = along[0].cross(along[1]).normalize_or_zero();
        let at = |i: u32, j: u32| {
            let share = Vec2::new(i as f32, j as f32) / steps as f32;
            Vertex::new(corner + along[0] * share.x + along[1] * share.y, normal, share * repeats)
        };
        for j in 0..steps {
            for i in 0..steps {
                self.push(GL_QUADS, &[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
    }
}
