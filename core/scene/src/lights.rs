//! Lights of a frame in world space: what the program's own lights say, else a soft sun.

use afterglow_gl::frame::{Frame, LIGHTS, Light};
use glam::{DMat4, DVec3, Vec3};

use crate::color::linear_from_srgb;
use crate::draws::DrawFacts;
use crate::types::{LightOrigin, LightShape, SceneLight};

/// Angular radius of directional lights, radians.
const ANGULAR_RADIUS: f32 = 0.02;
/// Radius of a point light, as a share of its distance to the scene's centre.
const RADIUS_SHARE: f64 = 0.02;
/// Distinct lights of a frame, at most.
const MOST_LIGHTS: usize = 16;

/// Lights that surfaces of the world were lit by.
#[derive(Debug, Default)]
pub struct Lighting {
    /// Heaviest first.
    pub lights: Vec<SceneLight>,
    /// Light model's and lights' ambient, linear RGB.
    pub ambient: Vec3,
    /// Share of the world's triangles that are lit by an enabled light, 0 to 1.
    pub lit_share: f32,
}

struct Found {
    light: SceneLight,
    index: u8,
    triangles: u64,
}

/// Gathers the lights of draws of the world. `scene_centre` and `extent` are in world space.
pub fn gather<'a>(
    frame: &Frame,
    world_draws: impl Iterator<Item = &'a DrawFacts<'a>>,
    world_from_eye: DMat4,
    scene_centre: DVec3,
    extent: f64,
) -> Lighting {
    let mut found: Vec<Found> = Vec::new();
    let (mut all, mut lit, mut ambient, mut ambient_weight) = (0u64, 0u64, Vec3::ZERO, 0.0);
    // Neighbouring draws nearly always share lights: each distinct combination is read once.
    let mut last: Option<((u32, u32), Vec<usize>)> = None;
    for facts in world_draws {
        let triangles = u64::from(facts.triangles);
        all += triangles;
        let words = &frame.fixed[facts.draw.fixed as usize].words;
        let global = words.global;
        let Some(lights) = frame.lights.get(facts.draw.lights as usize) else { continue };
        if !words.is_lit() {
            continue;
        }
        let enabled = (0..LIGHTS).filter(|i| global.lights() >> i & 1 != 0);
        let sum =
            enabled.clone().fold(rgb(lights.scene_ambient), |sum, i| sum + rgb(lights.lights[i].ambient));
        ambient += sum.clamp(Vec3::ZERO, Vec3::ONE) * triangles as f32;
        ambient_weight += triangles as f32;
        lit += if global.lights() != 0 { triangles } else { 0 };
        let key = (facts.draw.lights, global.lights());
        if last.as_ref().is_none_or(|(known, _)| *known != key) {
            let indices = enabled
                .filter_map(|i| {
                    let light = scene_light(&lights.lights[i], i as u8, world_from_eye, scene_centre)?;
                    Some(place(&mut found, light, i as u8, extent))
                })
                .collect();
            last = Some((key, indices));
        }
        for &index in last.iter().flat_map(|(_, indices)| indices) {
            found[index].triangles += triangles;
        }
    }
    found.sort_by_key(|f| std::cmp::Reverse(f.triangles));
    found.truncate(MOST_LIGHTS);
    Lighting {
        lights: found.into_iter().map(|f| f.light).collect(),
        ambient: linear_from_srgb(ambient / f32::max(ambient_weight, 1.0)),
        lit_share: if all == 0 { 0.0 } else { lit as f32 / all as f32 },
    }
}

/// Index of a light among those found; a light of the same number in about the same place is the same.
fn place(found: &mut Vec<Found>, light: SceneLight, index: u8, extent: f64) -> usize {
    let same = |f: &Found| f.index == index && is_same(&f.light, &light, extent as f32);
    found.iter().position(same).unwrap_or_else(|| {
        found.push(Found { light, index, triangles: 0 });
        found.len() - 1
    })
}

fn is_same(a: &SceneLight, b: &SceneLight, extent: f32) -> bool {
    let places = match (a.shape, b.shape) {
        (LightShape::Directional { to_light: a, .. }, LightShape::Directional { to_light: b, .. }) => {
            a.dot(b) > 0.9998
        }
        (LightShape::Point { position: a, .. }, LightShape::Point { position: b, .. }) => {
            a.distance(b) < 0.005 * extent
        }
        _ => false,
    };
    places && a.color.abs_diff_eq(b.color, 0.01)
}

fn scene_light(light: &Light, index: u8, world_from_eye: DMat4, scene_centre: DVec3) -> Option<SceneLight> {
    let color = linear_from_srgb(rgb(light.diffuse).max(Vec3::ZERO));
    let [x, y, z, w] = light.position.map(f64::from);
    let shape = if w == 0.0 {
        let to_light = world_from_eye.transform_vector3(DVec3::new(x, y, z)).try_normalize()?;
        LightShape::Directional { to_light: to_light.as_vec3(), angular_radius: ANGULAR_RADIUS }
    } else {
        let position = world_from_eye.transform_point3(DVec3::new(x, y, z) / w);
        let radius = (RADIUS_SHARE * position.distance(scene_centre)).max(1e-4) as f32;
        LightShape::Point {
            position: position.as_vec3(),
            radius,
            attenuation: Vec3::from_array(light.attenuation),
            spot: spot(light, world_from_eye),
        }
    };
    let is_sound = match shape {
        LightShape::Directional { to_light, .. } => to_light.is_finite(),
        LightShape::Point { position, .. } => position.is_finite(),
    };
    (is_sound && color.max_element() > 0.0).then_some(SceneLight {
        shape,
        color,
        origin: LightOrigin::Gl(index),
    })
}

fn spot(light: &Light, world_from_eye: DMat4) -> Option<(Vec3, f32, f32)> {
    if light.spot_cos_cutoff <= -1.0 {
        return None;
    }
    let axis = Vec3::from_array(light.spot_direction).as_dvec3();
    let axis = world_from_eye.transform_vector3(axis).try_normalize()?;
    Some((axis.as_vec3(), light.spot_cos_cutoff, light.spot_exponent))
}

/// A soft sun, for worlds in which nothing shines. `up` is a unit vector.
pub fn fallback_sun(up: Vec3) -> SceneLight {
    let aside = up.any_orthonormal_vector();
    let to_light = (up + 0.45 * aside + 0.3 * up.cross(aside)).normalize();
    SceneLight {
        shape: LightShape::Directional { to_light, angular_radius: 2.5 * ANGULAR_RADIUS },
        color: Vec3::new(0.8, 0.76, 0.7),
        origin: LightOrigin::Fallback,
    }
}

fn rgb(color: [f32; 4]) -> Vec3 {
    Vec3::new(color[0], color[1], color[2])
}
