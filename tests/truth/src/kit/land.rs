//! Hills, in square cells.

use afterglow_api::constants::GL_TRIANGLE_STRIP;
use glam::{DVec3, Vec2, Vec3};

use super::{Cell, Mesh, Vertex};

/// A landscape about the origin.
#[derive(Debug, Clone, PartialEq)]
pub struct Land {
    /// By rows; all of a cell is in its floors.
    pub cells: Vec<Cell>,
    count: u32,
}

/// Side of a cell, and quads along it.
const SIDE: f32 = 16.0;
const QUADS: u32 = 5;

impl Land {
    /// A landscape of `count` by `count` cells, numbered from `first_object`.
    pub fn new(count: u32, first_object: u64) -> Land {
        let half = count as f32 * SIDE / 2.0;
        let cell = |index: u32| {
            let corner = Vec2::new((index % count) as f32, (index / count) as f32) * SIDE - half;
            let middle = corner + SIDE / 2.0;
            Cell {
                object: first_object + u64::from(index),
                centre: DVec3::new(middle.x.into(), 0.0, middle.y.into()),
                radius: f64::from(SIDE) * 0.75,
                walls: Mesh::default(),
                floors: Land::strips(corner),
            }
        };
        Land { cells: (0..count * count).map(cell).collect(), count }
    }

    /// Height of the ground.
    pub fn height(x: f32, z: f32) -> f32 {
        1.6 * (0.11 * x).sin() * (0.13 * z).cos() + 0.5 * (0.31 * x + 0.23 * z).sin()
    }

    /// Its diagonal.
    pub fn extent(&self) -> f64 {
        f64::from(self.count as f32 * SIDE) * std::f64::consts::SQRT_2
    }

    fn strips(corner: Vec2) -> Mesh {
        let at = |i: u32, j: u32| {
            let place = corner + Vec2::new(i as f32, j as f32) * (SIDE / QUADS as f32);
            let height = Land::height(place.x, place.y);
            let slope = Vec2::new(
                Land::height(place.x + 0.1, place.y) - height,
                Land::height(place.x, place.y + 0.1) - height,
            ) * 10.0;
            let normal = Vec3::new(-slope.x, 1.0, -slope.y).normalize();
            let shade = (255.0 * (0.55 + 0.45 * normal.dot(Vec3::new(0.5, 0.7, 0.5).normalize()))) as u8;
            Vertex {
                color: [shade, shade, shade, 255],
                ..Vertex::new(Vec3::new(place.x, height, place.y), normal, place / 4.0)
            }
        };
        let mut mesh = Mesh::default();
        for j in 0..QUADS {
            let vertices = (0..=QUADS).flat_map(|i| [at(i, j), at(i, j + 1)]);
            mesh.push(GL_TRIANGLE_STRIP, &vertices.collect::<Vec<_>>());
        }
        mesh
    }
}
