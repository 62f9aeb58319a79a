//! Worlds with baked light, relit by the sources that it comes from: they look as they were baked, and their light is
//! traced.

use afterglow_api::constants::*;
use afterglow_gl::texture::ImageDefinition;
use afterglow_gl::{Context, Params};
use afterglow_records::Paint;
use afterglow_scene::{Relighting, Replacing};
use glam::Vec3;

use super::pathtrace::{SIZE, Stage, look_down};
use crate::testing::assert_valid;
use crate::{Mode, PathtraceOptions};

/// Half of the floor's side, and texels along its lightmap.
const HALF: f32 = 4.0;
const TEXELS: usize = 32;
/// Where the lamp was over the floor when it was baked, and its power.
const LAMP: Vec3 = Vec3::new(-1.0, 1.6, 0.0);
const POWER: f32 = 2.0;
/// Frames until a world was seen often enough.
const FRAMES: u32 = 18;

/// Where a program bakes its light into.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Into {
    Unit,
    Pass,
    Colors,
}

/// The light that a place of the floor gets.
fn light(x: f32, z: f32) -> f32 {
    let to_lamp = LAMP - Vec3::new(x, 0.0, z);
    POWER * to_lamp.normalize().y / to_lamp.length_squared()
}

fn place(texel: usize) -> f32 {
    ((texel as f32 + 0.5) / TEXELS as f32 * 2.0 - 1.0) * HALF
}

fn texture(gl: &mut Context, name: u32, side: usize, color: impl Fn(usize, usize) -> [u8; 3]) {
    gl.bind_texture(GL_TEXTURE_2D, name);
    gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, Params::Ints(&[GL_LINEAR as i32]));
    let texels: Vec<u8> = (0..side * side).flat_map(|i| color(i % side, i / side)).collect();
    let definition =
        ImageDefinition { level: 0, internal_format: GL_RGB, size: [side as i32, side as i32, 1], border: 0 };
    gl.tex_image((GL_TEXTURE_2D, 2), definition, (GL_RGB, GL_UNSIGNED_BYTE), Some(&texels));
}

fn load(gl: &mut Context) {
    gl.pixel_store(GL_UNPACK_ALIGNMENT, 1.0);
    // Rough paint, and the light on it.
    texture(gl, 1, 8, |x, y| [[200, 120, 60], [120, 200, 160]][(x * 5 + y * 3) / 4 % 2]);
    texture(gl, 2, TEXELS, |x, y| [(light(place(x), place(y)).min(1.0) * 255.0 + 0.5) as u8; 3]);
}

/// The floor in squares, as many as there are texels where its colours are its light.
fn floor(gl: &mut Context, has_colors: bool, repeats: f32) {
    let squares = if has_colors { TEXELS } else { 4 };
    let side = 2.0 * HALF / squares as f32;
    gl.begin(GL_QUADS);
    for square in 0..squares * squares {
        let corner = [square % squares, square / squares].map(|n| n as f32 * side - HALF);
        for [s, t] in [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]] {
            let [x, z] = [corner[0] + s * side, corner[1] + t * side];
            if has_colors {
                gl.color([light(x, z), light(x, z), light(x, z), 1.0]);
            }
            let [s, t] = [x, z].map(|v| (v / HALF + 1.0) / 2.0);
            gl.multi_tex_coord(GL_TEXTURE0, [s * repeats, t * repeats, 0.0, 1.0]);
            gl.multi_tex_coord(GL_TEXTURE1, [s, t, 0.0, 1.0]);
            gl.vertex([x, 0.0, z, 1.0]);
        }
    }
    gl.end();
}

fn frame(gl: &mut Context, into: Into) {
    gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    look_down(gl);
    gl.enable(GL_DEPTH_TEST);
    gl.color([1.0; 4]);
    gl.enable(GL_TEXTURE_2D);
    gl.bind_texture(GL_TEXTURE_2D, 1);
    if into == Into::Unit {
        gl.active_texture(GL_TEXTURE1);
        gl.enable(GL_TEXTURE_2D);
        gl.bind_texture(GL_TEXTURE_2D, 2);
        gl.active_texture(GL_TEXTURE0);
    }
    floor(gl, into == Into::Colors, 8.0);
    if into == Into::Pass {
        gl.bind_texture(GL_TEXTURE_2D, 2);
        gl.enable(GL_BLEND);
        gl.blend_func(GL_DST_COLOR, GL_ZERO);
        gl.depth_func(GL_EQUAL);
        floor(gl, false, 1.0);
        gl.depth_func(GL_LESS);
        gl.disable(GL_BLEND);
    }
    gl.swap_buffers();
    assert_eq!(gl.get_error(), GL_NO_ERROR);
}

/// The last of some frames, as it is with these options.
fn picture(into: Into, mode: Mode, change: impl FnOnce(&mut PathtraceOptions)) -> Vec<u8> {
    let mut stage = Stage::new(mode, |options| {
        options.relighting = Relighting::AtOnce;
        change(options);
    });
    load(&mut stage.gl);
    for _ in 0..FRAMES {
        frame(&mut stage.gl, into);
    }
    assert_valid();
    stage.picture()
}

/// The mean difference of colours.
fn difference(a: &[u8], b: &[u8]) -> f32 {
    let sum: u32 = a.iter().zip(b).map(|(a, b)| u32::from(a.abs_diff(*b))).sum();
    sum as f32 / (SIZE.0 * SIZE.1 * 3) as f32
}

#[test]
fn relit_worlds_look_as_they_were_baked() {
    for into in [Into::Unit, Into::Pass, Into::Colors] {
        let baked = picture(into, Mode::Raster, |_| {});
        let relit = picture(into, Mode::Pathtrace, |options| options.replacing = Replacing::Always);
        let moved = picture(into, Mode::Pathtrace, |options| {
            options.replacing = Replacing::Always;
            options.move_light = Some((0, Vec3::new(2.0, 0.0, 0.0)));
        });
        let kept = picture(into, Mode::Pathtrace, |options| options.replacing = Replacing::Never);
        assert_eq!(difference(&kept, &baked), 0.0, "{into:?}");
        assert!(difference(&relit, &baked) < 3.0, "{into:?}: {}", difference(&relit, &baked));
        assert!(difference(&moved, &baked) > 10.0, "{into:?}: {}", difference(&moved, &baked));
    }
}

#[test]
fn paint_has_no_baked_light_in_it() {
    for into in [Into::Unit, Into::Pass, Into::Colors] {
        let paint = picture(into, Mode::Pathtrace, |options| {
            options.replacing = Replacing::Always;
            options.paint = Paint::Albedo;
        });
        let floor = paint.chunks(4).map(|pixel| pixel[0].max(pixel[1])).filter(|&most| most > 0);
        let darkest = floor.min();
        assert!(darkest > Some(100), "{into:?}: {darkest:?}");
    }
}
