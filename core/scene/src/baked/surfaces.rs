//! The static triangles of a world with baked light, and what is drawn over them.

use afterglow_gl::frame::ImageKey;
use glam::{Vec2, Vec3};
use hashbrown::HashMap;

/// Triangles that are kept, at most.
pub const MOST_TRIANGLES: usize = 1 << 17;
/// Textures over one triangle, at most.
pub const MOST_MAPS: usize = 4;

/// A texture that multiplies a triangle's colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Map {
    /// Which.
    pub image: ImageKey,
    /// Of the corners.
    pub coordinates: [Vec2; 3],
    /// The colour is multiplied by this as well.
    pub scale: f32,
}

/// A triangle of the world.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangle {
    /// World space.
    pub corners: [Vec3; 3],
    /// Unit, to the side that is seen.
    pub normal: Vec3,
    /// World units, squared.
    pub area: f32,
    /// Textures, in the order in which they multiply.
    pub maps: Vec<Map>,
    /// Colours of the corners as the program gave them; white where texturing replaces them.
    pub colors: [Vec3; 3],
    /// The vertices of its draw have colours of their own.
    pub has_colors: bool,
    /// Light is added to it.
    pub glows: bool,
    /// OpenGL lights it.
    pub is_lit: bool,
}

/// What is known of a texture by where it lies on the world.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Use {
    /// Triangles on which it lies, and those of them on which it does not repeat.
    pub triangles: u32,
    pub once: u32,
    /// Area in texture space and in the world.
    pub area: [f32; 2],
    /// Other textures that lie on the same triangles; not all where there are many.
    pub companions: Vec<ImageKey>,
}

/// Companions that are counted.
const MOST_COMPANIONS: usize = 16;

/// A world as far as it was seen.
#[derive(Debug, Default)]
pub struct World {
    /// In the order in which they were first seen.
    pub triangles: Vec<Triangle>,
    /// Of all textures.
    pub uses: HashMap<ImageKey, Use>,
    /// Of all triangles.
    pub area: f32,
    /// By key: the look in which a triangle was seen first, and whether it was added.
    known: HashMap<u64, (u32, bool)>,
    look: u32,
}

impl World {
    /// Another frame is looked at.
    pub fn next_look(&mut self) {
        self.look = self.look.wrapping_add(1);
        if self.known.len() > 4 * MOST_TRIANGLES {
            self.known.retain(|_, (_, is_added)| *is_added);
        }
    }

    /// Whether the triangle of a key is to be added: when it is seen in a second look. What is gone by then does not stand
    /// still, whatever it was taken for.
    pub fn wants(&mut self, key: u64) -> bool {
        let look = self.look;
        let (first, is_added) = self.known.entry(key).or_insert((look, false));
        !*is_added && *first != look
    }

    /// Whether no more triangles are taken.
    pub fn is_full(&self) -> bool {
        self.triangles.len() >= MOST_TRIANGLES
    }

    /// Adds a triangle, unless it is known, there are too many or it is no triangle.
    pub fn add(&mut self, key: u64, triangle: Triangle) {
        let is_sound = triangle.area > 0.0 && triangle.area.is_finite() && triangle.normal.is_finite();
        if self.is_full() || self.known.insert(key, (self.look, true)).is_some_and(|k| k.1) || !is_sound {
            return;
        }
        self.area += triangle.area;
        for (i, map) in triangle.maps.iter().enumerate() {
            let of_map = self.uses.entry(map.image).or_default();
            of_map.triangles += 1;
            of_map.once += u32::from(is_once(&map.coordinates));
            of_map.area[0] += texture_area(&map.coordinates);
            of_map.area[1] += triangle.area;
            for (_, other) in triangle.maps.iter().enumerate().filter(|(k, _)| *k != i) {
                let companions = &mut of_map.companions;
                if companions.len() < MOST_COMPANIONS && !companions.contains(&other.image) {
                    companions.push(other.image);
                }
            }
        }
        self.triangles.push(triangle);
    }
}

/// Whether coordinates stay where a texture does not repeat.
fn is_once(coordinates: &[Vec2; 3]) -> bool {
    const SLACK: f32 = 0.004;
    coordinates.iter().all(|at| at.min_element() >= -SLACK && at.max_element() <= 1.0 + SLACK)
}

fn texture_area([a, b, c]: &[Vec2; 3]) -> f32 {
    let area = 0.5 * (b - a).perp_dot(c - a).abs();
    if area.is_finite() { area } else { 0.0 }
}
