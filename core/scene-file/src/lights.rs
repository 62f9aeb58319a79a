//! A scene's lights in the units that the renderer takes: what a white surface that faces them would show.

use std::f64::consts::PI;

use afterglow_scene::{LightOrigin, LightShape, SceneLight};
use glam::{DVec3, Vec3};

use crate::scene::{SceneFile, SequenceFrame, SphereLight, Sun};

/// The lights of a frame, or of the still scene; their numbers are the same in all frames.
pub(crate) fn lights(scene: &SceneFile, frame: Option<&SequenceFrame>) -> Vec<SceneLight> {
    let sun_scale = frame.map_or(1.0, |frame| frame.sun_scale);
    let mut scales = vec![frame.map_or(1.0, |frame| frame.sphere_light_scale); scene.sphere_lights.len()];
    for (number, factor) in frame.into_iter().flat_map(|frame| &frame.light_scales) {
        scales[*number] *= factor;
    }
    let spheres = scene.sphere_lights.iter().zip(scales).map(|(light, scale)| sphere(light, scale));
    scene.sun.iter().map(|light| sun(light, sun_scale)).chain(spheres).collect()
}

/// Radiance from where there is nothing.
pub(crate) fn sky(scene: &SceneFile, frame: Option<&SequenceFrame>) -> Vec3 {
    let radiance = scene.sky.map_or(DVec3::ZERO, |sky| sky.radiance);
    finite(radiance * frame.map_or(1.0, |frame| frame.sky_scale))
}

fn sun(sun: &Sun, scale: f64) -> SceneLight {
    SceneLight {
        shape: LightShape::Directional {
            to_light: sun.direction.as_vec3(),
            angular_radius: sun.angular_radius as f32,
        },
        color: finite(sun.irradiance * (scale / PI)),
        origin: LightOrigin::SceneFile,
    }
}

/// The irradiance of a surface that faces a sphere of radiance L and radius r at distance d is pi L (r / d)^2: such a
/// white surface shows L r^2 where the falloff, 1 / d^2, is 1.
fn sphere(light: &SphereLight, scale: f64) -> SceneLight {
    SceneLight {
        shape: LightShape::Point {
            position: light.center.as_vec3(),
            radius: light.radius as f32,
            attenuation: Vec3::Z,
            spot: None,
        },
        color: finite(light.radiance * (scale * light.radius * light.radius)),
        origin: LightOrigin::SceneFile,
    }
}

/// In f32, where products of finite numbers may be too large.
pub(crate) fn finite(light: DVec3) -> Vec3 {
    light.as_vec3().min(Vec3::MAX)
}
