//! A scene's lights as shaders read them.

use afterglow_gl::frame::{Draw, Frame, LIGHTS};
use afterglow_records::LightSource;
use afterglow_scene::{LightOrigin, LightShape, SceneLight, linear_from_srgb};
use glam::{DVec3, Vec3};

/// A scene's lights relative to `origin`, one of them displaced where `moved` says so.
pub(crate) fn light_sources(
    lights: &[SceneLight],
    highlights: &Highlights,
    origin: DVec3,
    moved: Option<(usize, Vec3)>,
) -> Vec<LightSource> {
    let displacement = |index: usize| match moved {
        Some((light, displacement)) if light == index => displacement,
        _ => Vec3::ZERO,
    };
    let source = |(index, light): (usize, &SceneLight)| LightSource {
        specular: highlights.of(light),
        ..light_source(light, origin, displacement(index))
    };
    lights.iter().enumerate().map(source).collect()
}

/// Specular colours of the program's lights (sRGB), by their numbers.
#[derive(Debug, Default)]
pub(crate) struct Highlights {
    colors: [Option<[f32; 3]>; LIGHTS],
}

impl Highlights {
    /// Notes the lights of a draw. The first draw that a light shines on says what colour it has.
    pub(crate) fn note(&mut self, frame: &Frame, draw: &Draw) {
        let words = &frame.fixed[draw.fixed as usize].words;
        let global = &words.global;
        let Some(lights) = frame.lights.get(draw.lights as usize) else { return };
        if !words.is_lit() {
            return;
        }
        for (number, color) in self.colors.iter_mut().enumerate() {
            if global.lights() >> number & 1 != 0 && color.is_none() {
                let [r, g, b, _] = lights.lights[number].specular;
                *color = Some([r, g, b]);
            }
        }
    }

    fn of(&self, light: &SceneLight) -> [f32; 3] {
        let color = match light.origin {
            LightOrigin::Gl(number) => self.colors.get(usize::from(number)).copied().flatten(),
            LightOrigin::Program(_) => return light.color.to_array(),
            LightOrigin::Profile
            | LightOrigin::Recovered
            | LightOrigin::SceneFile
            | LightOrigin::Fallback => None,
        };
        linear_from_srgb(Vec3::from(color.unwrap_or_default()).clamp(Vec3::ZERO, Vec3::ONE)).to_array()
    }
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
        specular: [0.0; 3],
        padding: 0,
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
        let sources = light_sources(&[light, light], &Highlights::default(), origin, Some((1, Vec3::Y)));
        assert_eq!(sources[0].position, [0.0, 2.0, 3.0]);
        assert_eq!(sources[1].position, [0.0, 3.0, 3.0]);
    }
}
