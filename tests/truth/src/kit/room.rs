//! A room with pillars whose lightmap is baked as light goes: inverse squares, cosines, shadows.

use glam::{DVec3, Vec2, Vec3};

use super::{Mesh, Picture};
use crate::truth::{TrueLight, TrueLightOrigin, TrueLightShape};

/// A rectangle of the room, with a tile of the lightmap of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// World space, with coordinates of texture and lightmap.
    pub mesh: Mesh,
    /// It is floor or ceiling.
    pub is_level: bool,
    corner: Vec3,
    along: [Vec3; 2],
}

/// A room.
#[derive(Debug, Clone, PartialEq)]
pub struct Room {
    /// Floor, ceiling, walls, and the sides of pillars.
    pub faces: Vec<Face>,
    size: Vec3,
    pillars: Vec<[Vec3; 2]>,
    lamps: Vec<(Vec3, Vec3)>,
}

/// Texels along the lightmap, and along the tile of a face.
const TEXELS: usize = 256;
const TILE: usize = 32;
/// Light that is everywhere.
pub const AMBIENT: f32 = 0.04;

impl Room {
    /// Three lamps of different colours among four pillars.
    pub fn with_lamps() -> Room {
        let size = Vec3::new(14.0, 4.0, 10.0);
        let pillar = |x: f32, z: f32| [Vec3::new(x - 0.5, 0.0, z - 0.5), Vec3::new(x + 0.5, size.y, z + 0.5)];
        let pillars = vec![pillar(3.5, 3.0), pillar(10.0, 2.5), pillar(6.5, 6.5), pillar(11.0, 7.0)];
        let lamps = vec![
            (Vec3::new(1.8, 3.2, 7.6), Vec3::new(2.2, 1.5, 0.9)),
            (Vec3::new(7.0, 3.0, 2.2), Vec3::new(1.0, 1.6, 2.2)),
            (Vec3::new(12.6, 2.4, 4.6), Vec3::new(1.2, 1.9, 1.0)),
        ];
        let mut room = Room { faces: Vec::new(), size, pillars, lamps };
        let [x, y, z] = [Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z];
        room.add(true, Vec3::ZERO, [z, x]);
        room.add(true, y, [x, z]);
        room.add_sides(Vec3::ZERO, size, -1.0);
        for [least, most] in room.pillars.clone() {
            room.add_sides(least, most, 1.0);
        }
        room
    }

    /// Its middle, world space.
    pub fn centre(&self) -> DVec3 {
        self.size.as_dvec3() / 2.0
    }

    /// Its diagonal.
    pub fn extent(&self) -> f64 {
        f64::from(self.size.length())
    }

    /// The lamps.
    pub fn lights(&self) -> Vec<TrueLight> {
        let light = |&(position, color): &(Vec3, Vec3)| TrueLight {
            shape: TrueLightShape::Point { position: position.as_dvec3(), attenuation: Vec3::Z },
            color,
            origin: TrueLightOrigin::Baked,
        };
        self.lamps.iter().map(light).collect()
    }

    /// The light that falls on each place of each face, stored as it is.
    pub fn lightmap(&self) -> Picture {
        let black = [AMBIENT, AMBIENT, AMBIENT, 1.0];
        let across = TEXELS / TILE;
        Picture::of(TEXELS, |s, t| {
            let [x, y] = [s, t].map(|v| (v * TEXELS as f32) as usize);
            let Some(face) = self.faces.get(y / TILE * across + x / TILE) else { return black };
            let share = |texel: usize| (texel % TILE) as f32 / (TILE - 1) as f32;
            let place = face.corner + face.along[0] * share(x) + face.along[1] * share(y);
            let [r, g, b] = self.light(place, face.along[0].cross(face.along[1]).normalize()).to_array();
            [r, g, b, 1.0]
        })
    }

    fn light(&self, place: Vec3, normal: Vec3) -> Vec3 {
        let start = place + 1e-3 * normal;
        self.lamps.iter().fold(Vec3::splat(AMBIENT), |sum, &(lamp, color)| {
            let way = lamp - start;
            let cosine = way.normalize().dot(normal).max(0.0);
            let is_hidden = self.pillars.iter().any(|pillar| crosses(start, lamp, *pillar));
            sum + if is_hidden { Vec3::ZERO } else { color * cosine / way.length_squared() }
        })
    }

    /// The four sides of a box, seen from without (1) or from within (-1).
    fn add_sides(&mut self, least: Vec3, most: Vec3, seen: f32) {
        let size = most - least;
        let [x, y, z] = [Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z];
        let sides = [(z, x), (x, -x), (x + z, -z), (Vec3::ZERO, z)];
        for (corner, along) in sides {
            match seen > 0.0 {
                true => self.add(false, least + corner, [along, y]),
                false => self.add(false, least + corner + along, [-along, y]),
            }
        }
    }

    fn add(&mut self, is_level: bool, corner: Vec3, along: [Vec3; 2]) {
        let across = TEXELS / TILE;
        let number = self.faces.len();
        let tile = Vec2::new((number % across * TILE) as f32, (number / across * TILE) as f32);
        let mut mesh = Mesh::default();
        let repeats = Vec2::new(along[0].length(), along[1].length()) / 2.0;
        mesh.parallelogram(corner, along, 2, repeats);
        for vertex in mesh.vertices_mut() {
            let texel = tile + 0.5 + vertex.uv / repeats * (TILE - 1) as f32;
            vertex.light_uv = texel / TEXELS as f32;
        }
        self.faces.push(Face { mesh, is_level, corner, along });
    }
}

/// Whether the way from one point to another goes through a box.
fn crosses(from: Vec3, to: Vec3, [least, most]: [Vec3; 2]) -> bool {
    let way = to - from;
    let (a, b) = ((least - from) / way, (most - from) / way);
    let (enters, leaves) = (a.min(b).max_element(), a.max(b).min_element());
    enters < leaves && leaves > 0.0 && enters < 1.0
}
