//! A scene's lights as shaders read them.

use afterglow_records::LightSource;
use afterglow_scene::{LightShape, SceneLight};
use glam::{DVec3, Vec3};

/// A scene's lights relative to `origin`, one of them displaced where `moved` says so.
pub(crate) fn light_sources(
    lights: &[SceneLight],
    origin: DVec3,
    moved: Option<(usize, Vec3)>,
) -> Vec<LightSource> {
    let displacement = |index: usize| match moved {
        Some((light, displacement)) if light == index => displacement,
        _ => Vec3::ZERO,
    };
    let source = |(index, light)| light_source(light, origin, displacement(index));
    lights.iter().enumerate().map(source).collect()
}

fn light_source(light: &SceneLight, origin: DVec3, displacement: Vec3) -> LightSource {
    let common = LightSource {
        position: [0.0; 3],
        radius: 0.0,
        color: light.color.to_array(),
        has_place: 0,
        attenuation: [1.0, 0.0, 0.0],
        spot_cos_cutoff: -1.0,
        spot_axis: [0.0; 3],
        spot_exponent: 0.0,
    };
    match light.shape {
        LightShape::Directional { to_light, angular_radius } => LightSource {
            position: (to_light + displacement).normalize_or(to_light).to_array(),
            radius: angular_radius.tan(),
            ..common
        },
        LightShape::Point { position, radius, attenuation, spot } => {
            let place = (position + displacement).as_dvec3() - origin;
            let (axis, cos_cutoff, exponent) = spot.unwrap_or((Vec3::ZERO, -1.0, 0.0));
            LightSource {
                position: place.as_vec3().to_array(),
                radius,
                has_place: 1,
                attenuation: attenuation.to_array(),
                spot_cos_cutoff: cos_cutoff,
                spot_axis: axis.to_array(),
                spot_exponent: exponent,
                ..common
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afterglow_scene::LightOrigin;

    #[test]
    fn places_are_relative_to_the_origin_and_can_be_moved() {
        let light = SceneLight {
            shape: LightShape::Point {
                position: Vec3::new(1.0, 2.0, 3.0),
                radius: 0.5,
                attenuation: Vec3::X,
                spot: None,
            },
            color: Vec3::ONE,
            origin: LightOrigin::Gl(0),
        };
        let origin = DVec3::new(1.0, 0.0, 0.0);
        let sources = light_sources(&[light, light], origin, Some((1, Vec3::Y)));
        assert_eq!(sources[0].position, [0.0, 2.0, 3.0]);
        assert_eq!(sources[1].position, [0.0, 3.0, 3.0]);
    }
}
