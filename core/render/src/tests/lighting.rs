//! Vertex lighting against the specification's equation, computed here.

use afterglow_gl::frame::{Format, Light, Lights, Material, MaterialFace, Slot, Topology, VertexLayout};
use bytemuck::Zeroable;

use crate::testing::*;

type Vector = [f32; 3];

fn dot(a: Vector, b: Vector) -> f32 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn unit(v: Vector) -> Vector {
    v.map(|component| component / dot(v, v).sqrt())
}

fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Equation 2.4 of OpenGL 1.5 for one light, with a viewer at infinity or at the origin.
fn expected(light: &Light, face: &MaterialFace, at: Vector, normal: Vector, local: bool) -> [f32; 4] {
    let towards = if light.position[3] == 0.0 {
        [0, 1, 2].map(|i| light.position[i])
    } else {
        [0, 1, 2].map(|i| light.position[i] / light.position[3] - at[i])
    };
    let distance = dot(towards, towards).sqrt();
    let direction = unit(towards);
    let [k0, k1, k2] = light.attenuation;
    let mut strength = match light.position[3] {
        0.0 => 1.0,
        _ => 1.0 / (k0 + k1 * distance + k2 * distance * distance),
    };
    if light.spot_cos_cutoff > -1.0 {
        let along = -dot(direction, unit(light.spot_direction));
        strength *= match along >= light.spot_cos_cutoff {
            true => along.powf(light.spot_exponent),
            false => 0.0,
        };
    }
    let facing = dot(normal, direction).max(0.0);
    let viewer = if local { unit(at.map(|c| -c)) } else { [0.0, 0.0, 1.0] };
    let glint = dot(normal, unit(add(direction, viewer))).max(0.0);
    let shine = if facing > 0.0 { glint.powf(face.shininess) } else { 0.0 };
    let component = |i: usize| {
        let reflected = face.ambient[i] * light.ambient[i]
            + facing * face.diffuse[i] * light.diffuse[i]
            + shine * face.specular[i] * light.specular[i];
        (face.emission[i] + strength * reflected).clamp(0.0, 1.0)
    };
    [component(0), component(1), component(2), face.diffuse[3]]
}

fn light() -> Light {
    Light {
        ambient: [0.2, 0.1, 0.0, 1.0],
        diffuse: [0.8, 0.7, 0.6, 1.0],
        specular: [0.3, 0.9, 0.5, 1.0],
        position: [0.4, 0.3, 1.5, 1.0],
        spot_direction: [0.0, 0.0, -1.0],
        spot_exponent: 0.0,
        attenuation: [1.0, 0.1, 0.05],
        spot_cos_cutoff: -1.0,
    }
}

fn face() -> MaterialFace {
    MaterialFace {
        ambient: [0.3, 0.4, 0.5, 1.0],
        diffuse: [0.6, 0.5, 0.4, 0.75],
        specular: [0.9, 0.3, 0.7, 1.0],
        emission: [0.05, 0.0, 0.1, 1.0],
        shininess: 12.0,
    }
}

/// A frame with one light and that material on both sides.
fn lit(light: &Light) -> FrameBuilder {
    let mut frame = FrameBuilder::new(16, 16);
    frame.clear([0.0; 4]);
    let mut lights = Lights::zeroed();
    lights.lights[3] = *light;
    frame.frame.lights.push(lights);
    frame
        .frame
        .materials
        .push(Material { faces: [face(), MaterialFace { diffuse: [0.0, 1.0, 0.0, 1.0], ..face() }] });
    let words = &mut frame.fixed.words.global;
    words.set_lighting(1);
    words.set_lights(1 << 3);
    words.set_positional(u32::from(light.position[3] != 0.0) << 3);
    words.set_spots(u32::from(light.spot_cos_cutoff > -1.0) << 3);
    frame
}

/// Points of a unit sphere's near half, one pixel each, with the normals there.
fn sphere(frame: &mut FrameBuilder) -> Vec<(u32, u32, Vector)> {
    let layout = VertexLayout::default()
        .with(Slot::Position as usize, Format::F3)
        .with(Slot::Normal as usize, Format::F3);
    let mut words = Vec::new();
    let mut points = Vec::new();
    for (x, y) in (0..16).flat_map(|x| (0..16).map(move |y| (x, y))) {
        let [u, v] = [x, y].map(|i| (i as f32 + 0.5) / 8.0 - 1.0);
        let square = u * u + v * v;
        if square < 0.9 {
            let normal = [u, v, (1.0 - square).sqrt()];
            words.extend(normal.map(f32::to_bits));
            words.extend(normal.map(f32::to_bits));
            points.push((x, y, normal));
        }
    }
    let indices: Vec<_> = (0..points.len() as u32).collect();
    frame.draw(layout, Topology::Points, &words, &indices);
    points
}

fn assert_sphere(frame: &mut FrameBuilder, light: &Light, local: bool) {
    frame.fixed.words.global.set_local_viewer(local.into());
    let points = sphere(frame);
    let picture = frame.picture();
    for (x, y, normal) in points {
        picture.assert_near(x, y, expected(light, &face(), normal, normal, local));
    }
}

#[test]
fn a_sphere_in_a_light_with_a_place() {
    assert_sphere(&mut lit(&light()), &light(), false);
}

#[test]
fn a_sphere_in_a_directional_light_seen_from_nearby() {
    let light = Light { position: [0.5, 0.5, 1.0, 0.0], ..light() };
    assert_sphere(&mut lit(&light), &light, true);
}

#[test]
fn a_sphere_in_a_spot() {
    let light = Light {
        position: [0.0, 0.0, 3.0, 1.0],
        spot_direction: [0.0, 0.0, -2.0],
        spot_exponent: 5.0,
        spot_cos_cutoff: 0.97,
        ..light()
    };
    assert_sphere(&mut lit(&light), &light, false);
}

#[test]
fn normals_are_made_unit_length_where_asked() {
    let mut frame = lit(&light());
    frame.fixed.words.global.set_normalize(2);
    frame.transform.normal = [[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]];
    assert_sphere(&mut frame, &light(), false);
}

#[test]
fn the_back_has_its_own_material() {
    let overhead = Light {
        position: [0.0, 0.0, 1.0, 0.0],
        ambient: [0.0; 4],
        specular: [0.0; 4],
        diffuse: [1.0; 4],
        ..light()
    };
    let color = |two_side: u32, normal_z: f32, front_ccw: bool| {
        let mut frame = lit(&overhead);
        frame.fixed.words.global.set_two_side(two_side);
        frame.fixed.raster.front_ccw = front_ccw;
        frame.current.normal = [0.0, 0.0, normal_z, 0.0];
        frame.fill(0.0, WHITE);
        frame.picture()
    };
    color(1, 1.0, true).assert_near(3, 3, [0.65, 0.5, 0.5, 0.75]);
    color(1, -1.0, false).assert_near(3, 3, [0.05, 1.0, 0.1, 1.0]);
    color(1, 1.0, false).assert_near(3, 3, [0.05, 0.0, 0.1, 1.0]);
    color(0, 1.0, false).assert_near(3, 3, [0.65, 0.5, 0.5, 0.75]);
}

#[test]
fn the_colour_takes_the_place_of_the_material() {
    let ambient_only = Light {
        diffuse: [0.0; 4],
        specular: [0.0; 4],
        ambient: [1.0; 4],
        position: [0.0, 0.0, 1.0, 0.0],
        ..light()
    };
    let mut frame = lit(&ambient_only);
    let words = &mut frame.fixed.words.global;
    words.set_color_material(1);
    words.set_color_material_faces(0b11);
    words.set_color_material_mode(0);
    frame.fill(0.0, [102, 51, 204, 128]);
    frame.picture().assert_near(3, 3, [0.45, 0.2, 0.9, 0.5]);
}

#[test]
fn specular_light_survives_a_black_texture_if_it_is_separate() {
    let mut frame = lit(&light());
    frame.texture(0, [1, 1], afterglow_gl::frame::BaseFormat::Rgb, &[BLACK]);
    frame.fixed.words.global.set_separate_specular(1);
    frame.current.normal = [0.0, 0.0, 1.0, 0.0];
    frame.fill(0.0, WHITE);
    let picture = frame.picture();
    assert!(picture.at(9, 9)[1] > 20, "{:?}", picture.at(9, 9));
    assert_eq!(picture.at(9, 9)[3], 191);
}
