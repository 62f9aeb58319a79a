//! From a judged frame to the static triangles that were not known before.

use afterglow_gl::frame::{BlendFactor, Cull, Draw, EnvMode, Format, Frame, Operation, Slot};
use glam::{DVec3, Mat3, Mat4, Vec2, Vec3, Vec4};
use hashbrown::HashMap;
use xxhash_rust::xxh3::xxh3_64;

use super::relit::{factor, first_factor, multiplier};
use super::surfaces::{MOST_MAPS, Map, Triangle, World};
use crate::content::triangle_key;
use crate::geometry::Attribute;
use crate::types::{Class, Scene, Verdict};

/// What a layer does to the surface below.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Over {
    /// Multiplies it by its texture, and by this.
    Multiplies(f32),
    /// Adds light.
    Glows,
}

/// Layers by the keys of their triangles: draw, first corner, what it does.
type Layers<'a> = HashMap<u64, Vec<(&'a Draw, usize, Over)>>;

/// Adds what a frame shows of the static world.
pub fn learn(world: &mut World, frame: &Frame, scene: &Scene) {
    let Some(camera) = scene.camera else { return };
    let eye = camera.view.inverse().w_axis.truncate();
    world.next_look();
    let mut fresh: Vec<(&Verdict, &Draw, usize, u64)> = Vec::new();
    for (verdict, draw) in draws(frame, scene, Class::Static) {
        if world.is_full() {
            return;
        }
        let (salt, keys) = (salt(verdict), keys(frame, draw));
        fresh.extend(
            keys.filter(|(_, key)| world.wants(key ^ salt)).map(|(first, key)| (verdict, draw, first, key)),
        );
    }
    if fresh.is_empty() {
        return;
    }
    let layers = layers(frame, scene);
    for (verdict, draw, first, key) in fresh {
        let over = layers.get(&(key ^ modelview_hash(frame, draw))).map_or(&[][..], Vec::as_slice);
        if let Some(triangle) = triangle(frame, verdict, draw, first, over, eye) {
            world.add(key ^ salt(verdict), triangle);
        }
    }
}

fn draws<'a>(
    frame: &'a Frame,
    scene: &'a Scene,
    class: Class,
) -> impl Iterator<Item = (&'a Verdict, &'a Draw)> {
    let of_class =
        scene.verdicts.iter().filter(move |verdict| verdict.class == class && verdict.triangles > 0);
    of_class.filter_map(|verdict| match frame.operations.get(verdict.operation as usize) {
        Some(Operation::Draw(draw)) => Some((verdict, draw)),
        _ => None,
    })
}

/// First corner and key of each triangle.
fn keys<'a>(frame: &'a Frame, draw: &Draw) -> impl Iterator<Item = (usize, u64)> + use<'a> {
    let triangles = draw.index_count as usize / 3;
    let positions = Attribute::of(frame, draw, Slot::Position as usize);
    positions.into_iter().flat_map(move |p| (0..triangles).map(move |i| (p, 3 * i))).filter_map(
        |(p, first)| Some((first, triangle_key([p.get(first)?, p.get(first + 1)?, p.get(first + 2)?]))),
    )
}

/// Tells apart equal triangles of different objects.
fn salt(verdict: &Verdict) -> u64 {
    match verdict.object {
        0 => xxh3_64(bytemuck::bytes_of(&verdict.model.to_cols_array())),
        object => object,
    }
}

fn modelview_hash(frame: &Frame, draw: &Draw) -> u64 {
    let transform = frame.transforms.get(draw.transform as usize);
    transform.map_or(0, |transform| xxh3_64(bytemuck::bytes_of(&transform.modelview)))
}

fn layers<'a>(frame: &'a Frame, scene: &'a Scene) -> Layers<'a> {
    let mut layers: Layers = HashMap::new();
    for (_, draw) in draws(frame, scene, Class::Layer) {
        let Some(over) = over(frame, draw) else { continue };
        let modelview = modelview_hash(frame, draw);
        for (first, key) in keys(frame, draw) {
            layers.entry(key ^ modelview).or_default().push((draw, first, over));
        }
    }
    layers
}

fn over(frame: &Frame, draw: &Draw) -> Option<Over> {
    use BlendFactor as F;
    let glows =
        matches!(frame.fixed.get(draw.fixed as usize)?.raster.blend?.rgb, (F::One | F::SourceAlpha, F::One));
    multiplier(frame, draw).map(Over::Multiplies).or(glows.then_some(Over::Glows))
}

fn triangle(
    frame: &Frame,
    verdict: &Verdict,
    draw: &Draw,
    first: usize,
    over: &[(&Draw, usize, Over)],
    eye: DVec3,
) -> Option<Triangle> {
    let positions = corners(frame, draw, first, Slot::Position as usize)?;
    let corners_world = positions.map(|p| (verdict.model * p).truncate() / p.w);
    let [a, b, c] = corners_world;
    let cross = (b - a).cross(c - a);
    let area = 0.5 * cross.length();
    let to_eye = (eye - a.as_dvec3()).as_vec3();
    let towards = if cross.dot(to_eye) < 0.0 { -cross } else { cross };
    let normal =
        towards.normalize_or_zero() * if shows_far_side(frame, draw, positions) { -1.0 } else { 1.0 };
    let mut maps = Vec::new();
    add_units(frame, draw, first, 1.0, &mut maps);
    for (layer, first, over) in over {
        if let Over::Multiplies(scale) = over {
            add_units(frame, layer, *first, *scale, &mut maps);
        }
    }
    let given = corners(frame, draw, first, Slot::Color as usize);
    let words = &frame.fixed.get(draw.fixed as usize)?.words;
    let current = frame.current.get(draw.current as usize).map_or([1.0; 4], |current| current.color);
    let colors = match words.units[0].target() != 0 && words.units[0].env_mode() == EnvMode::Replace as u32 {
        true => [Vec3::ONE; 3],
        false => given.unwrap_or([Vec4::from_array(current); 3]).map(Vec4::truncate),
    };
    Some(Triangle {
        corners: corners_world,
        normal,
        area,
        maps,
        colors: colors.map(|color| color.clamp(Vec3::ZERO, Vec3::ONE)),
        has_colors: given.is_some(),
        glows: over.iter().any(|(.., over)| *over == Over::Glows),
        is_lit: words.is_lit(),
    })
}

fn corners(frame: &Frame, draw: &Draw, first: usize, slot: usize) -> Option<[Vec4; 3]> {
    let attribute = Attribute::of(frame, draw, slot)?;
    Some([attribute.get(first)?, attribute.get(first + 1)?, attribute.get(first + 2)?])
}

/// Whether what is culled of a triangle is the side that the eye is on.
fn shows_far_side(frame: &Frame, draw: &Draw, positions: [Vec4; 3]) -> bool {
    let (Some(fixed), Some(transform)) =
        (frame.fixed.get(draw.fixed as usize), frame.transforms.get(draw.transform as usize))
    else {
        return false;
    };
    let clip = Mat4::from_cols_array_2d(&transform.modelview_projection);
    // The sign of an area in the window, by homogeneous coordinates.
    let homogeneous = |p: Vec4| {
        let at = clip * p;
        Vec3::new(at.x, at.y, at.w)
    };
    let columns = positions.map(homogeneous);
    let is_ccw = Mat3::from_cols(columns[0], columns[1], columns[2]).determinant() > 0.0;
    let is_front = is_ccw == fixed.raster.front_ccw;
    match fixed.raster.cull {
        Cull::Back => !is_front,
        Cull::Front => is_front,
        Cull::None | Cull::FrontAndBack => false,
    }
}

/// Adds the textures of a draw's units that multiply.
fn add_units(frame: &Frame, draw: &Draw, first: usize, scale: f32, maps: &mut Vec<Map>) {
    let (Some(fixed), Some(bindings)) =
        (frame.fixed.get(draw.fixed as usize), frame.bindings.get(draw.bindings as usize))
    else {
        return;
    };
    let mut is_first = true;
    for (unit, words) in fixed.words.units.iter().enumerate().filter(|(_, words)| words.target() != 0) {
        let scale = std::mem::replace(&mut is_first, false).then_some(scale);
        let is_own = words.gen_s() == 0 && words.matrix() == 0;
        let factor = if scale.is_some() { first_factor(words) } else { factor(words) };
        let slot = Slot::Texture0 as usize + unit;
        let has_coordinates = draw.layout.format(slot) != Format::Absent;
        let (Some(factor), Some(binding)) = (factor, bindings[unit]) else { continue };
        if maps.len() < MOST_MAPS
            && is_own
            && has_coordinates
            && let Some(given) = corners(frame, draw, first, slot)
        {
            let coordinates = given.map(|at| Vec2::new(at.x, at.y) / at.w);
            maps.push(Map { image: binding.image, coordinates, scale: factor * scale.unwrap_or(1.0) });
        }
    }
}
