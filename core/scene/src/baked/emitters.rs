//! Surfaces that may shine: full-bright among lightmapped ones, or with light added to them.

use std::collections::BTreeMap;

use afterglow_relight::Emitter;
use glam::Vec3;

use super::patches::Bake;
use super::surfaces::Triangle;
use crate::images::Images;

/// Emitters, at most.
const MOST_EMITTERS: usize = 256;
/// Triangles of one emitter, at most: rays are sent to each.
const MOST_TRIANGLES: usize = 256;
/// Emitters reach over so many patches.
const CELL: f32 = 6.0;
/// Mean brightness (sRGB) of what may shine without a glow.
const LEAST_BRIGHTNESS: f32 = 0.25;

/// Triangles near each other that face the same way.
#[derive(Default)]
struct Group {
    /// Brightness times area.
    light: f32,
    glows: bool,
    triangles: Vec<[Vec3; 3]>,
}

/// The surfaces of a world that may shine, those of most light first. `side` is that of a patch.
pub fn emitters(triangles: &[Triangle], bakes: &[Option<Bake>], images: &Images, side: f32) -> Vec<Emitter> {
    let has_maps = bakes.iter().any(|bake| matches!(bake, Some(Bake::Map(..))));
    let mut groups: BTreeMap<[i32; 6], Group> = BTreeMap::new();
    for (triangle, bake) in triangles.iter().zip(bakes).filter(|_| has_maps) {
        let bright = brightness(triangle, images);
        let may_shine = triangle.glows || (bake.is_none() && !triangle.is_lit && bright > LEAST_BRIGHTNESS);
        if !may_shine {
            continue;
        }
        let place = (triangle.corners.iter().sum::<Vec3>() / 3.0 / (CELL * side)).floor();
        let facing = (triangle.normal * 2.0).round();
        let key = [place, facing].map(|v| v.to_array().map(|c| c as i32)).concat();
        let key: [i32; 6] = std::array::from_fn(|i| key[i]);
        let group = groups.entry(key).or_default();
        if group.triangles.len() < MOST_TRIANGLES {
            group.light += bright * triangle.area;
            group.glows |= triangle.glows;
            group.triangles.push(towards(triangle));
        }
    }
    let mut groups: Vec<_> = groups.into_values().collect();
    groups.sort_by(|a, b| b.light.total_cmp(&a.light));
    groups.truncate(MOST_EMITTERS);
    let emitter = |group: Group| Emitter {
        triangles: group.triangles,
        two_sided: false,
        preference: if group.glows { 1.5 } else { 1.2 },
    };
    groups.into_iter().map(emitter).collect()
}

/// A triangle's corners, counter-clockwise as seen from its lit side.
fn towards(triangle: &Triangle) -> [Vec3; 3] {
    let [a, b, c] = triangle.corners;
    if (b - a).cross(c - a).dot(triangle.normal) < 0.0 { [a, c, b] } else { [a, b, c] }
}

/// Mean of a triangle's colour, 0 to 1.
fn brightness(triangle: &Triangle, images: &Images) -> f32 {
    let mean = |key| images.get(key).and_then(|image| image.mean()).map_or(Vec3::ONE, |m| m.truncate());
    let textures: Vec3 = triangle.maps.iter().map(|map| mean(map.image) * map.scale).product();
    (textures * triangle.colors.iter().sum::<Vec3>() / 3.0).element_sum() / 3.0
}
