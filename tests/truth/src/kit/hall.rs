//! A building of square cells: floor, ceiling, outer walls and pillars, with a lightmap.

use glam::{DVec3, Vec2, Vec3};

use super::{Mesh, Picture, boxed};
use crate::truth::{TrueLight, TrueLightOrigin, TrueLightShape};

/// A square part of a building, as programs cut their worlds.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// The number of its object.
    pub object: u64,
    /// Its middle, world space.
    pub centre: DVec3,
    /// From the middle to the farthest vertex.
    pub radius: f64,
    /// Walls and pillars, world space.
    pub walls: Mesh,
    /// Floor and ceiling, world space.
    pub floors: Mesh,
}

/// A building.
#[derive(Debug, Clone, PartialEq)]
pub struct Hall {
    /// By rows.
    pub cells: Vec<Cell>,
    /// Cells along x and along z.
    pub counts: [u32; 2],
    lamps: Vec<(Vec3, Vec3)>,
}

/// Side of a cell, and height of the building.
const SIDE: f32 = 4.0;

impl Hall {
    /// A building whose cells are numbered from `first_object`. Lamps hang in some of them.
    pub fn new(counts: [u32; 2], first_object: u64) -> Hall {
        let mut hall = Hall { cells: Vec::new(), counts, lamps: Vec::new() };
        for z in 0..counts[1] {
            for x in 0..counts[0] {
                hall.add_cell(x, z, first_object);
            }
        }
        hall
    }

    /// Its middle, world space.
    pub fn centre(&self) -> DVec3 {
        DVec3::new(f64::from(self.counts[0]), 1.0, f64::from(self.counts[1])) * f64::from(SIDE) / 2.0
    }

    /// Its diagonal.
    pub fn extent(&self) -> f64 {
        2.0 * self.centre().length()
    }

    /// The lamps that its lightmap is computed from.
    pub fn lights(&self) -> Vec<TrueLight> {
        let light = |&(position, color): &(Vec3, Vec3)| TrueLight {
            shape: TrueLightShape::Point {
                position: position.as_dvec3(),
                attenuation: Vec3::new(1.0, 0.0, 0.12),
            },
            color,
            origin: TrueLightOrigin::Baked,
        };
        self.lamps.iter().map(light).collect()
    }

    /// The light that the lamps throw on each place of the plan.
    pub fn lightmap(&self) -> Picture {
        let size = Vec2::new(self.counts[0] as f32, self.counts[1] as f32) * SIDE;
        Picture::of(64, |x, y| {
            let place = Vec3::new(x * size.x, 1.0, y * size.y);
            let light = self.lamps.iter().fold(Vec3::splat(0.12), |sum, (position, color)| {
                sum + *color / (1.0 + 0.12 * position.distance_squared(place))
            });
            let [r, g, b] = light.to_array();
            [r, g, b, 1.0]
        })
    }

    /// Colours the vertices by the light that falls there.
    pub fn bake(&mut self) {
        let lightmap = self.lightmap();
        for cell in &mut self.cells {
            for vertex in cell.walls.vertices_mut().chain(cell.floors.vertices_mut()) {
                vertex.color = lightmap.at(vertex.light_uv);
            }
        }
    }

    fn add_cell(&mut self, x: u32, z: u32, first_object: u64) {
        let corner = Vec3::new(x as f32, 0.0, z as f32) * SIDE;
        let [along_x, along_z, up] = [Vec3::X * SIDE, Vec3::Z * SIDE, Vec3::Y * SIDE];
        let (mut floors, mut walls) = (Mesh::default(), Mesh::default());
        floors.parallelogram(corner, [along_z, along_x], 2, Vec2::splat(2.0));
        floors.parallelogram(corner + up, [along_x, along_z], 2, Vec2::splat(2.0));
        let sides = [
            (x == 0, corner + along_z, -along_z),
            (x + 1 == self.counts[0], corner + along_x, along_z),
            (z == 0, corner, along_x),
            (z + 1 == self.counts[1], corner + along_x + along_z, -along_x),
        ];
        for (_, corner, along) in sides.into_iter().filter(|(is_border, ..)| *is_border) {
            walls.parallelogram(corner, [along, up], 2, Vec2::splat(2.0));
        }
        let middle = corner + Vec3::new(SIDE / 2.0, 0.0, SIDE / 2.0);
        if x % 2 == 1 && z % 2 == 1 {
            let half = Vec3::new(0.4, 0.0, 0.4);
            walls.append(&boxed(middle - half, middle + half + up));
        }
        if (x + 2 * z) % 5 == 2 {
            let color = if z.is_multiple_of(2) { Vec3::new(1.1, 0.9, 0.6) } else { Vec3::new(0.6, 0.8, 1.2) };
            self.lamps.push((middle + Vec3::Y * 3.0, color));
        }
        let plan = Vec2::new(self.counts[0] as f32, self.counts[1] as f32) * SIDE;
        for vertex in walls.vertices_mut().chain(floors.vertices_mut()) {
            vertex.light_uv = Vec2::new(vertex.position.x, vertex.position.z) / plan * 0.96 + 0.02;
        }
        self.cells.push(Cell {
            object: first_object + u64::from(z * self.counts[0] + x),
            centre: (middle + up / 2.0).as_dvec3(),
            radius: f64::from(SIDE) * 0.87,
            walls,
            floors,
        });
    }
}
