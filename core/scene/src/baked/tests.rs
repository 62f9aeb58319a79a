//! Worlds made by hand: what is taken for a lightmap, what patches show, and that nothing is made of too little.

use afterglow_gl::frame::{
    BaseFormat, BlendFactor, Compare, Dimension, Frame, ImageKey, ImageShape, ImageUpload, Operation, Region,
    TexelFormat,
};
use glam::{Mat4, Vec2, Vec3};

use super::lightmap::Lightmaps;
use super::surfaces::{Map, Triangle, World};
use super::texels::{Image, Texels};
use crate::images::Images;
use crate::testing::Sketch;
use crate::types::{LightOrigin, Relighting, Replacing, Scene};
use crate::{Recovery, baked::search::Search};

/// Side of the squares of which worlds are made.
const SIDE: f32 = 8.0;

/// An image whose texels are a function of the place, 0 to 255.
fn upload(frame: &mut Frame, size: u32, texel: impl Fn(u32, u32) -> [u8; 3]) -> ImageKey {
    let image = ImageKey::unique();
    let shape = ImageShape {
        dimension: Dimension::D2,
        width: size,
        height: size,
        depth: 1,
        levels: 1,
        format: TexelFormat::Rgba8,
        base_format: BaseFormat::Rgb,
    };
    let texels: Vec<u8> = (0..size * size)
        .flat_map(|i| {
            let [r, g, b] = texel(i % size, i / size);
            [r, g, b, 255]
        })
        .collect();
    let region = Region { level: 0, layer: 0, offset: [0; 3], extent: [size, size, 1] };
    frame.operations.push(Operation::DefineImage { image, shape });
    frame.operations.push(Operation::Upload(ImageUpload { image, region, texels: texels.into() }));
    image
}

/// Grain, as materials have it.
fn grain(x: u32, y: u32) -> [u8; 3] {
    let value = (x * 7919 + y * 104_729 + x * y * 31) % 97;
    [100 + value as u8; 3]
}

/// From dark on the left to bright on the right.
fn ramp(x: u32, _: u32) -> [u8; 3] {
    [(4 * x).min(255) as u8; 3]
}

fn map(image: ImageKey, coordinates: [Vec2; 3]) -> Map {
    Map { image, coordinates, scale: 1.0 }
}

/// A square in the plane y = 0 as two triangles, with a texture that repeats and one that does not.
fn square(number: u32, material: ImageKey, light: ImageKey, is_light_first: bool) -> Vec<Triangle> {
    let at = |x: f32, z: f32| (Vec3::new(SIDE * (x + number as f32), 0.0, SIDE * z), Vec2::new(x, z));
    let corners = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
    [[0, 1, 2], [0, 2, 3]]
        .map(|triangle| {
            let corners = triangle.map(|i: usize| corners[i]);
            let coordinates = corners.map(|(_, at)| at);
            let mut maps = vec![map(material, coordinates.map(|at| 4.0 * at)), map(light, coordinates)];
            if is_light_first {
                maps.reverse();
            }
            Triangle {
                corners: corners.map(|(place, _)| place),
                normal: Vec3::Y,
                area: SIDE * SIDE / 2.0,
                maps,
                colors: [Vec3::ONE; 3],
                has_colors: false,
                glows: false,
                is_lit: false,
            }
        })
        .into()
}

/// Squares of two materials under one lightmap; the images, and the lightmap among them.
fn world(is_light_first: bool) -> (World, Texels, Images, ImageKey) {
    let mut frame = Frame::default();
    let materials = [upload(&mut frame, 64, grain), upload(&mut frame, 64, |x, y| grain(y, x + 5))];
    let light = upload(&mut frame, 64, ramp);
    let (mut world, mut texels, mut images) = (World::default(), Texels::default(), Images::default());
    texels.learn(&frame);
    images.learn(&frame);
    for number in 0..6 {
        let triangles = square(number, materials[number as usize % 2], light, is_light_first);
        for (key, triangle) in triangles.into_iter().enumerate() {
            world.add(u64::from(number * 2 + key as u32), triangle);
        }
    }
    (world, texels, images, light)
}

#[test]
fn a_lightmap_is_told_from_materials_in_either_order() {
    for is_light_first in [false, true] {
        let (world, texels, _, light) = world(is_light_first);
        let lightmaps = Lightmaps::of(&world, &texels);
        for triangle in &world.triangles {
            let found = lightmaps.find(triangle).unwrap();
            assert_eq!(triangle.maps[found].image, light);
        }
    }
}

#[test]
fn two_materials_are_no_lightmap() {
    let mut frame = Frame::default();
    let materials = [upload(&mut frame, 64, grain), upload(&mut frame, 64, |x, y| grain(y, x + 5))];
    let (mut world, mut texels) = (World::default(), Texels::default());
    texels.learn(&frame);
    for (key, mut triangle) in square(0, materials[0], materials[1], false).into_iter().enumerate() {
        // Neither repeats: what is left says nothing for one of them.
        let coordinates = triangle.maps[1].coordinates;
        triangle.maps.iter_mut().for_each(|map| map.coordinates = coordinates);
        world.add(key as u64, triangle);
    }
    let lightmaps = Lightmaps::of(&world, &texels);
    assert!(world.triangles.iter().all(|triangle| lightmaps.find(triangle).is_none()));
}

#[test]
fn patches_show_the_lightmap_and_cover_the_world() {
    let (world, texels, images, _) = world(false);
    let problem = world.problem(&texels, &images, false).unwrap();
    let area: f32 = problem.patches.iter().map(|patch| patch.area).sum();
    assert!((area - 6.0 * SIDE * SIDE).abs() < 0.02 * area, "{area}");
    for patch in &problem.patches {
        let along = (patch.position.x / SIDE).fract();
        if !(0.1..0.9).contains(&along) {
            // It reaches over an edge, to where the lightmap begins anew.
            continue;
        }
        // Texel i is 4 i / 255, its middle at (i + 1/2) / 64; edges are clamped.
        let told = (4.0 * (64.0 * along - 0.5)).clamp(0.0, 252.0) / 255.0;
        assert!((patch.irradiance.x - told).abs() < 0.03, "{along}: {} for {told}", patch.irradiance.x);
        assert!((patch.normal.normalize() - Vec3::Y).length() < 1e-5);
        assert!(patch.albedo.min_element() > 0.2 && patch.albedo.max_element() < 0.6);
    }
}

#[test]
fn parts_of_an_image_are_learnt_and_bounds_are_kept() {
    let mut frame = Frame::default();
    let image = upload(&mut frame, 4, |_, _| [0; 3]);
    let region = Region { level: 0, layer: 0, offset: [2, 1, 0], extent: [2, 2, 1] };
    frame.operations.push(Operation::Upload(ImageUpload { image, region, texels: [255; 16].into() }));
    // What does not fit is damage.
    let region = Region { offset: [3, 3, 0], ..region };
    frame.operations.push(Operation::Upload(ImageUpload { image, region, texels: [9; 16].into() }));
    let mut texels = Texels::default();
    texels.learn(&frame);
    let known = texels.get(image).unwrap();
    assert_eq!(known.sample(Vec2::new(0.7, 0.4)).x, 1.0);
    assert_eq!(known.sample(Vec2::ZERO).x, 0.0);
    texels.forget(&Frame { operations: vec![Operation::DropImage(image)], ..Frame::default() });
    assert!(texels.get(image).is_none());
}

#[test]
fn samples_are_bilinear() {
    let image = Image::new(2, 1, &[0, 0, 0, 255, 255, 255, 255, 255]);
    assert_eq!(image.sample(Vec2::new(0.5, 0.5)).x, 0.5);
    assert_eq!(image.sample(Vec2::new(-3.0, 0.5)).x, 0.0);
    // Whatever that is, it is no panic.
    for at in [f32::NAN, f32::INFINITY, f32::MIN] {
        image.sample(Vec2::new(at, 0.5));
    }
}

#[test]
fn a_search_in_the_background_finds_what_one_at_once_finds() {
    let (world, texels, images, _) = world(false);
    let problem = || world.problem(&texels, &images, false).unwrap();
    let mut at_once = Search::default();
    at_once.begin(problem(), false);
    let told = at_once.take().unwrap();
    let mut beside = Search::default();
    beside.begin(problem(), true);
    let found = std::iter::from_fn(|| beside.is_running().then(|| beside.take())).flatten().next();
    assert_eq!(found.unwrap().lights, told.lights);
    assert!(!beside.is_running() && beside.take().is_none());
}

/// A floor with a lightmap pass, in so many frames.
fn scenes(frames: u32, relighting: Relighting) -> Vec<Scene> {
    let mut recovery = Recovery::new().with_relighting(relighting, Replacing::WhereGood);
    let scene = |number: u32| {
        let mut sketch = Sketch::new();
        sketch.modelview = Mat4::from_translation(Vec3::new(0.02 * number as f32, -2.0, -5.0));
        sketch.texture(0, BaseFormat::Rgb, &[[128, 128, 128, 255]; 2]);
        sketch.world();
        sketch.depth(Some((Compare::LessEqual, false)));
        sketch.blend(Some((BlendFactor::DestinationColor, BlendFactor::Zero)));
        sketch.world();
        recovery.understand(&mut sketch.frame)
    };
    (0..frames).map(scene).collect()
}

#[test]
fn a_world_that_tells_too_little_stays_baked() {
    for relighting in [Relighting::Off, Relighting::AtOnce, Relighting::Background] {
        let scenes = scenes(40, relighting);
        assert!(scenes.iter().all(|scene| scene.baked && scene.lights.is_empty() && scene.relight.is_none()));
    }
}

#[test]
fn recovered_lights_are_of_their_own_origin() {
    assert_eq!(LightOrigin::Recovered.to_string(), "recovered");
}
