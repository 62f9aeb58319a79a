//! Recovered sources as lights of a scene.

use std::f32::consts::PI;

use afterglow_relight::{Emitter, Falloff, Found, Light, Patch, Source};
use glam::Vec3;

use crate::color::linear_from_srgb;
use crate::types::{LightOrigin, LightShape, SceneLight};

/// Lights, at most: shaders look at each.
const MOST_LIGHTS: usize = 32;
/// Of several triangles that face so differently that this is left of their area together, light goes everywhere.
const PLANE: f32 = 0.3;

/// The lights that explain most. In both units albedo times light is what a surface shows; `scale` is what [`scale`] says.
pub fn lights(found: &[Light], emitters: &[Emitter], scale: f32) -> Vec<SceneLight> {
    let light = |light: &Light| {
        let (shape, color) = shape(light, emitters)?;
        Some(SceneLight { shape, color: scale * color, origin: LightOrigin::Recovered })
    };
    found.iter().filter_map(light).take(MOST_LIGHTS).collect()
}

/// From the light of a bake, which is shown as it was stored, to the linear light that the picture shows, where the
/// world is as bright as it is on average.
pub fn scale(patches: &[Patch]) -> f32 {
    let area: f32 = patches.iter().map(|patch| patch.area).sum();
    let light: f32 = patches.iter().map(|patch| patch.area * patch.irradiance.element_sum() / 3.0).sum();
    let mean = light / area.max(f32::MIN_POSITIVE);
    if mean > 0.0 { linear_from_srgb(Vec3::splat(mean)).x / mean } else { 1.0 }
}

/// What shines from everywhere: the bake's constant part, what surfaces reflect at one another, and the sky.
pub fn ambient(found: &Found, patches: &[Patch]) -> Vec3 {
    let area: f32 = patches.iter().map(|patch| patch.area).sum();
    let shown: Vec3 = patches.iter().map(|patch| patch.area * patch.albedo * patch.irradiance).sum();
    // Half of the sky is hidden from most places.
    found.ambient + found.bounce * shown / area.max(f32::MIN_POSITIVE) + sky(found) * 0.5
}

/// What shines where a ray meets nothing.
pub fn sky(found: &Found) -> Vec3 {
    let powers = found.lights.iter().filter(|light| light.source == Source::Sky).map(|light| light.power);
    powers.sum::<Vec3>() * PI
}

fn shape(light: &Light, emitters: &[Emitter]) -> Option<(LightShape, Vec3)> {
    match light.source {
        Source::Point { position, radius, falloff: Falloff::InverseSquare } => {
            let attenuation = Vec3::new(0.0, 0.0, 1.0);
            Some((LightShape::Point { position, radius, attenuation, spot: None }, light.power))
        }
        // OpenGL's falloff has no end: the same at no distance, at half the reach, and nearly nothing far away.
        Source::Point { position, radius, falloff: Falloff::Linear { reach } } => {
            let attenuation = Vec3::new(1.0, 0.0, 4.0 / (reach * reach));
            Some((LightShape::Point { position, radius, attenuation, spot: None }, light.power))
        }
        Source::Sun { direction, angular_radius } => {
            Some((LightShape::Directional { to_light: direction, angular_radius }, light.power))
        }
        Source::Area { emitter } => Some(area_light(emitters.get(emitter)?, light.power)),
        Source::Sky => None,
    }
}

/// A disc of the same area and light: E = L A cos cos' / (r^2 + d^2) in front of it.
fn area_light(emitter: &Emitter, radiance: Vec3) -> (LightShape, Vec3) {
    let cross = |[a, b, c]: &[Vec3; 3]| 0.5 * (b - a).cross(c - a);
    let facing: Vec3 = emitter.triangles.iter().map(cross).sum();
    let area: f32 = emitter.triangles.iter().map(|triangle| cross(triangle).length()).sum();
    let middle = |triangle: &[Vec3; 3]| cross(triangle).length() * triangle.iter().sum::<Vec3>() / 3.0;
    let centre = emitter.triangles.iter().map(middle).sum::<Vec3>() / area.max(f32::MIN_POSITIVE);
    let normal = facing.normalize_or_zero();
    let is_plane = facing.length() > PLANE * area && !emitter.two_sided;
    let shining = if is_plane { facing.length() } else { 0.25 * area };
    let radius = (shining / PI).sqrt();
    let shape = LightShape::Point {
        position: centre + 0.05 * radius * normal,
        radius,
        attenuation: Vec3::new(radius * radius, 0.0, 1.0),
        spot: is_plane.then_some((normal, 0.0, 1.0)),
    };
    (shape, radiance * shining)
}
