//! A scene's lights as shaders read them: those infinitely far, then those with a place, and the tree over these.

use afterglow_gl::frame::Lights;
use afterglow_records::{
    LIGHT_FAR, LIGHT_POINT, LIGHT_SPHERE, LIGHT_TRIANGLE, LIGHT_TRIANGLE_BOTH, LightNode, LightSource,
};
use afterglow_scene::{LightOrigin, LightShape, SceneLight, linear_from_srgb};
use bytemuck::Zeroable;
use glam::{DVec3, Vec3};

use super::kept_tree::KeptTree;

/// Far lights that are looked at; each costs time wherever one of them is asked.
const MOST_FAR: usize = 16;
/// Triangles that are lights; more of them shine too, but are found by chance only.
pub(crate) const MOST_TRIANGLES: usize = 1 << 16;

/// A triangle that shines, relative to the origin.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ShiningTriangle {
    pub(crate) corners: [Vec3; 3],
    /// Radiance, linear RGB.
    pub(crate) radiance: [f32; 3],
    pub(crate) is_one_sided: bool,
}

/// Lights that are spheres and that rays meet.
#[derive(Debug, Default, Clone, PartialEq)]
pub(crate) struct Lamps {
    /// Number of the first one among the lights; the others follow.
    pub(crate) first_light: usize,
    /// A place near them, world space.
    pub(crate) anchor: DVec3,
    /// Their middles relative to the anchor, and their radii.
    pub(crate) spheres: Vec<[f32; 4]>,
}

impl Lamps {
    /// Of the scene's lights, in the order of the list.
    fn of(lights: &[SceneLight], first_light: usize, displaced: impl Fn(usize) -> Vec3) -> Self {
        let place = |(index, light): (usize, &SceneLight)| match light.shape {
            LightShape::Point { position, radius, .. } => {
                Some(((position + displaced(index)).as_dvec3(), radius))
            }
            LightShape::Directional { .. } => None,
        };
        let is_lamp = |(_, light): &(usize, &SceneLight)| {
            is_lamp(light) && is_sound(&light_source(light, DVec3::ZERO, Vec3::ZERO))
        };
        let places: Vec<_> = lights.iter().enumerate().filter(is_lamp).filter_map(place).collect();
        let anchor = places.first().map_or(DVec3::ZERO, |(position, _)| *position);
        let relative = |(position, radius): &(DVec3, f32)| {
            let [x, y, z] = (*position - anchor).as_vec3().to_array();
            [x, y, z, *radius]
        };
        Self { first_light, anchor, spheres: places.iter().map(relative).collect() }
    }
}

/// Whether a light is a sphere that rays meet.
fn is_lamp(light: &SceneLight) -> bool {
    let has_radius = matches!(light.shape, LightShape::Point { radius, .. } if radius > 0.0);
    light.origin == LightOrigin::SceneFile && has_radius
}

/// All lights of a frame.
#[derive(Debug, Default)]
pub(crate) struct LightList {
    pub(crate) sources: Vec<LightSource>,
    pub(crate) nodes: Vec<LightNode>,
    pub(crate) far_count: usize,
    /// The spheres that rays meet.
    pub(crate) lamps: Lamps,
    /// Number of the first triangle.
    pub(crate) first_triangle: usize,
}

impl LightList {
    /// A scene's lights and shining triangles, relative to `origin`; the light of the scene that `moved` names is displaced. `tree` is
    /// the last frame's.
    pub(crate) fn new(
        lights: &[SceneLight],
        triangles: &[ShiningTriangle],
        origin: DVec3,
        moved: Option<(usize, Vec3)>,
        tree: &mut KeptTree,
    ) -> Self {
        let displacement = |index: usize| match moved {
            Some((light, displacement)) if light == index => displacement,
            _ => Vec3::ZERO,
        };
        let numbered = lights.iter().enumerate();
        let mut sources: Vec<_> =
            numbered.map(|(index, light)| light_source(light, origin, displacement(index))).collect();
        sources.retain(is_sound);
        // The sort keeps the scene's order among equals.
        sources.sort_by_key(|source| source.kind);
        let far = count_of(&sources, LIGHT_FAR);
        let far_count = far.min(MOST_FAR);
        sources.drain(far_count..far);
        let first_triangle = sources.len();
        let lamps = Lamps::of(lights, first_triangle - count_of(&sources, LIGHT_SPHERE), displacement);
        sources.extend(triangles.iter().take(MOST_TRIANGLES).map(triangle_source));
        let nodes = tree.over(&mut sources, far_count);
        Self { sources, nodes, far_count, lamps, first_triangle }
    }
}

/// How bright the highlights of OpenGL's lights are beside the light that surfaces scatter, at most 1: the greatest ratio
/// of a light's specular to its diffuse luminance. 1 where light comes from elsewhere.
pub(crate) fn highlight(tables: &[Lights], lights: &[SceneLight]) -> f32 {
    let luminance = |color: Vec3| color.dot(Vec3::new(0.2126, 0.7152, 0.0722));
    let ratio = |light: &SceneLight| {
        let LightOrigin::Gl(number) = light.origin else { return None };
        let own = tables.iter().filter_map(|table| table.lights.get(usize::from(number)));
        let specular = own.map(|light| Vec3::from_slice(&light.specular[..3]).clamp(Vec3::ZERO, Vec3::ONE));
        let brightest = specular.map(|color| luminance(linear_from_srgb(color))).fold(0.0, f32::max);
        Some(brightest / luminance(light.color).max(1e-3))
    };
    let greatest = lights.iter().filter_map(ratio).reduce(f32::max);
    greatest.unwrap_or(1.0).clamp(0.0, 1.0)
}

fn count_of(sources: &[LightSource], kind: u32) -> usize {
    sources.iter().filter(|source| source.kind == kind).count()
}

/// Lights that are no numbers shine nowhere.
fn is_sound(source: &LightSource) -> bool {
    let numbers = [source.position, source.color, source.attenuation, source.spot_axis].concat();
    numbers.iter().all(|number| number.is_finite()) && source.radius.is_finite() && source.radius >= 0.0
}

fn light_source(light: &SceneLight, origin: DVec3, displacement: Vec3) -> LightSource {
    let common = LightSource {
        color: light.color.to_array(),
        attenuation: [1.0, 0.0, 0.0],
        spot_cos_cutoff: -1.0,
        ..LightSource::zeroed()
    };
    match light.shape {
        LightShape::Directional { to_light, angular_radius } => LightSource {
            position: (to_light + displacement).normalize_or(to_light).to_array(),
            radius: match angular_radius.is_finite() {
                true => angular_radius.clamp(0.0, std::f32::consts::FRAC_PI_2).sin(),
                false => f32::NAN,
            },
            kind: LIGHT_FAR,
            ..common
        },
        LightShape::Point { position, radius, attenuation, spot } => {
            let place = (position + displacement).as_dvec3() - origin;
            let (axis, cos_cutoff, exponent) = spot.unwrap_or((Vec3::ZERO, -1.0, 0.0));
            let is_sphere = is_lamp(light);
            LightSource {
                position: place.as_vec3().to_array(),
                radius,
                color: if is_sphere { light.color / (radius * radius) } else { light.color }.to_array(),
                kind: if is_sphere { LIGHT_SPHERE } else { LIGHT_POINT },
                attenuation: attenuation.to_array(),
                spot_cos_cutoff: cos_cutoff,
                spot_axis: axis.to_array(),
                spot_exponent: exponent,
                ..common
            }
        }
    }
}

fn triangle_source(triangle: &ShiningTriangle) -> LightSource {
    let [a, b, c] = triangle.corners;
    let is_sound = triangle.corners.iter().all(|corner| corner.is_finite());
    let or_nothing = |edge: Vec3| if is_sound { edge.to_array() } else { [0.0; 3] };
    LightSource {
        position: or_nothing(a),
        color: triangle.radiance,
        kind: if triangle.is_one_sided { LIGHT_TRIANGLE } else { LIGHT_TRIANGLE_BOTH },
        edge_1: or_nothing(b - a),
        edge_2: or_nothing(c - a),
        ..LightSource::zeroed()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(position: Vec3, origin: LightOrigin) -> SceneLight {
        SceneLight {
            shape: LightShape::Point { position, radius: 0.5, attenuation: Vec3::Z, spot: None },
            color: Vec3::ONE,
            origin,
        }
    }

    #[test]
    fn places_are_relative_to_the_origin_and_can_be_moved() {
        let light = point(Vec3::new(1.0, 2.0, 3.0), LightOrigin::Gl(0));
        let origin = DVec3::new(1.0, 0.0, 0.0);
        let list = LightList::new(&[light, light], &[], origin, Some((1, Vec3::Y)), &mut KeptTree::default());
        assert_eq!(list.sources[0].position, [0.0, 2.0, 3.0]);
        assert_eq!(list.sources[1].position, [0.0, 3.0, 3.0]);
    }

    #[test]
    fn highlights_are_as_bright_as_their_lights_say() {
        let mut table = Lights::zeroed();
        table.lights[1].specular = [0.1, 0.1, 0.1, 1.0];
        let light = point(Vec3::X, LightOrigin::Gl(1));
        assert!((highlight(&[table], &[light]) - 0.01).abs() < 1e-3);
        assert_eq!(highlight(&[table], &[point(Vec3::X, LightOrigin::Profile)]), 1.0);
        table.lights[1].specular = [f32::NAN; 4];
        assert!((0.0..=1.0).contains(&highlight(&[table], &[light])));
    }

    #[test]
    fn far_lights_come_first_and_triangles_last() {
        let sun = SceneLight {
            shape: LightShape::Directional { to_light: Vec3::Y, angular_radius: 0.1 },
            color: Vec3::ONE,
            origin: LightOrigin::SceneFile,
        };
        let lost = point(Vec3::NAN, LightOrigin::SceneFile);
        let scene = [point(Vec3::X, LightOrigin::SceneFile), lost, sun, point(Vec3::X, LightOrigin::Gl(1))];
        let triangle = ShiningTriangle {
            corners: [Vec3::ZERO, Vec3::X, Vec3::Y],
            radiance: [1.0; 3],
            is_one_sided: true,
        };
        let list = LightList::new(&scene, &[triangle; 2], DVec3::ZERO, None, &mut KeptTree::default());
        let kinds: Vec<_> = list.sources.iter().map(|source| source.kind).collect();
        assert_eq!(kinds, [LIGHT_FAR, LIGHT_POINT, LIGHT_SPHERE, LIGHT_TRIANGLE, LIGHT_TRIANGLE]);
        assert_eq!((list.far_count, list.lamps.first_light, list.first_triangle), (1, 2, 3));
        assert_eq!((list.lamps.anchor, &list.lamps.spheres[..]), (DVec3::X, &[[0.0, 0.0, 0.0, 0.5]][..]));
        // Radiance of what brings 1 to a facing surface one unit away.
        assert_eq!(list.sources[2].color, [4.0; 3]);
        assert_eq!(list.nodes.len(), 7);
    }
}
