//! What a program says of its scene, traced: its lights shine, and its materials show. Rasterized, it is as if nothing
//! had been said.

use afterglow_api::constants::*;
use afterglow_gl::texture::ImageDefinition;
use afterglow_gl::{Context, Params};
use afterglow_scene::{LightOrigin, TriangleCounts};

use super::pathtrace::{OPEN, SHADOW, SIZE, Stage, look_down, slab};
use crate::testing::assert_valid;
use crate::{Denoiser, Mode, Paint};

/// A floor and a slab over it, unlit, as the program's calls between say of what.
#[derive(Default)]
struct Said<'a> {
    frame: Option<&'a dyn Fn(&mut Context)>,
    floor: Option<&'a dyn Fn(&mut Context)>,
    slab: Option<&'a dyn Fn(&mut Context)>,
}

fn say(gl: &mut Context, what: Option<&dyn Fn(&mut Context)>) {
    gl.scene_defaults();
    if let Some(what) = what {
        what(gl);
    }
}

fn draw(stage: &mut Stage, said: &Said) {
    let gl = &mut stage.gl;
    gl.clear_color(0.0, 0.0, 0.0, 1.0);
    gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    look_down(gl);
    gl.enable(GL_DEPTH_TEST);
    gl.color([0.5, 0.5, 0.5, 1.0]);
    say(gl, said.frame);
    say(gl, said.floor);
    slab(gl, 4.0);
    gl.translate(0.0, 1.5, 0.0);
    say(gl, said.slab);
    slab(gl, 0.8);
    gl.swap_buffers();
    assert_eq!(gl.get_error(), GL_NO_ERROR);
}

fn traced(said: &Said) -> Stage {
    let mut stage = Stage::new(Mode::Pathtrace, |options| options.spp = 8);
    draw(&mut stage, said);
    assert_valid();
    stage
}

/// A light over the slab, and one so weak that it only shows that lights are said.
fn lamp_at(gl: &mut Context, position: [f32; 3]) {
    gl.scene_view();
    gl.scene_point_light(1, position, [60.0; 3], 0.05);
    gl.scene_sky(0.02, 0.02, 0.02);
}

fn triangles(stage: &Stage) -> TriangleCounts {
    stage.renderer.lock().unwrap().frame_report().unwrap().scene.clone().unwrap().triangles
}

#[test]
fn lights_that_are_said_shine() {
    let ratio = |stage: &Stage| f64::from(stage.brightness(SHADOW)) / f64::from(stage.brightness(OPEN));
    let over = traced(&Said { frame: Some(&|gl| lamp_at(gl, [0.0, 5.0, 0.0])), ..Said::default() });
    let lights = over.renderer.lock().unwrap().frame_report().unwrap().scene.clone().unwrap().lights;
    assert_eq!(lights.iter().map(|light| light.origin).collect::<Vec<_>>(), [LightOrigin::Program(1)]);
    assert!(ratio(&over) < 0.7, "the slab shadows the floor: {}", ratio(&over));
    let aside = traced(&Said { frame: Some(&|gl| lamp_at(gl, [8.0, 5.0, 0.0])), ..Said::default() });
    assert!(aside.brightness(SHADOW) > over.brightness(SHADOW) + 30);
}

#[test]
fn what_gives_off_light_is_bright_and_lights_the_floor() {
    let frame = |gl: &mut Context| lamp_at(gl, [0.0, 5.0, 0.0]);
    let dark = traced(&Said { frame: Some(&frame), ..Said::default() });
    let glow = |gl: &mut Context| gl.scene_emission(0.0, 8.0, 0.0);
    let glowing = traced(&Said { frame: Some(&frame), slab: Some(&glow), ..Said::default() });
    // Green over red: how bright is left to exposure.
    let tint = |stage: &Stage, [x, y]: [u32; 2]| {
        let picture = stage.picture();
        let pixel = ((y * SIZE.0 + x) * 4) as usize;
        f64::from(picture[pixel + 1]) / f64::from(picture[pixel].max(1))
    };
    assert!(tint(&dark, SHADOW) < 1.05, "{}", tint(&dark, SHADOW));
    assert!(tint(&glowing, SHADOW) > 1.3, "{}", tint(&glowing, SHADOW));
    let slab_pixel = [48, 28];
    assert!(tint(&glowing, slab_pixel) > 1.5, "{}", tint(&glowing, slab_pixel));
}

#[test]
fn a_smooth_floor_has_a_highlight_and_a_metallic_one_a_brighter_one() {
    let frame = |gl: &mut Context| {
        gl.scene_view();
        gl.scene_directional_light(1, [-0.5, -1.0, 1.0], [3.0; 3], 0.5);
        gl.scene_sky(0.1, 0.1, 0.1);
    };
    // How much brighter the floor is where it mirrors the light than as far on the other side.
    let peak = |roughness: f32, metallic: f32| {
        let floor = |gl: &mut Context| gl.scene_material(roughness, metallic);
        let stage = traced(&Said { frame: Some(&frame), floor: Some(&floor), ..Said::default() });
        stage.brightness([69, 46]) - stage.brightness([26, 46])
    };
    let (rough, smooth, metal) = (peak(1.0, 0.0), peak(0.5, 0.0), peak(0.5, 1.0));
    assert!(smooth > rough + 5 && metal > smooth + 5, "{rough} {smooth} {metal}");
}

/// A texture of one texel, bound to nothing.
fn texture(gl: &mut Context, name: u32, texel: [u8; 4]) {
    gl.bind_texture(GL_TEXTURE_2D, name);
    gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, Params::Ints(&[GL_NEAREST as i32]));
    let definition = ImageDefinition { level: 0, internal_format: GL_RGBA, size: [1; 3], border: 0 };
    gl.tex_image((GL_TEXTURE_2D, 2), definition, (GL_RGBA, GL_UNSIGNED_BYTE), Some(&texel));
    gl.bind_texture(GL_TEXTURE_2D, 0);
}

#[test]
fn maps_vary_emission_roughness_and_normals() {
    let frame = |gl: &mut Context| {
        gl.scene_view();
        gl.scene_directional_light(1, [-0.5, -1.0, 1.0], [3.0; 3], 0.5);
        gl.scene_sky(0.1, 0.1, 0.1);
        texture(gl, 1, [0, 128, 255, 255]);
        texture(gl, 2, [0, 255, 0, 255]);
    };
    let seen = |floor: &dyn Fn(&mut Context), [x, y]: [u32; 2]| {
        let stage = traced(&Said { frame: Some(&frame), floor: Some(floor), ..Said::default() });
        let pixel = ((y * SIZE.0 + x) * 4) as usize;
        <[u8; 3]>::try_from(&stage.picture()[pixel..pixel + 3]).unwrap().map(i32::from)
    };
    const MIRRORS: [u32; 2] = [69, 46];
    let plain = seen(&|gl| gl.scene_material(1.0, 0.0), MIRRORS);
    // Half as rough, and all metal.
    let varied = seen(&|gl| gl.scene_map(GL_SCENE_METALLIC_ROUGHNESS_MAP_AFTERGLOW, 1), MIRRORS);
    assert!(varied[1] > plain[1] + 5, "{varied:?} {plain:?}");
    let glowing = seen(&|gl| gl.scene_map(GL_SCENE_EMISSION_MAP_AFTERGLOW, 2), OPEN);
    assert!(glowing[1] > glowing[0] + 30, "{glowing:?}");
    let white = seen(&|gl| gl.scene_emission(0.0, 0.0, 2.0), OPEN);
    assert!(white[2] > white[1] + 30, "{white:?}");
    let both = |gl: &mut Context| {
        gl.scene_emission(0.0, 0.0, 2.0);
        gl.scene_map(GL_SCENE_EMISSION_MAP_AFTERGLOW, 2);
    };
    let none = seen(&both, OPEN);
    assert!(none[2] < none[1] + 10, "the map lets no blue through: {none:?}");
}

#[test]
fn a_normal_map_turns_the_surface() {
    // The floor's s grows with x, and so does the map's lean; a light from the left and one from the right.
    let seen = |direction: [f32; 3], is_mapped: bool| {
        let frame = |gl: &mut Context| {
            gl.scene_view();
            gl.scene_directional_light(1, direction, [3.0; 3], 0.5);
            gl.scene_sky(0.05, 0.05, 0.05);
            texture(gl, 3, [218, 128, 218, 255]);
        };
        let floor = |gl: &mut Context| {
            if is_mapped {
                gl.scene_map(GL_SCENE_NORMAL_MAP_AFTERGLOW, 3);
            }
        };
        let stage = traced(&Said { frame: Some(&frame), floor: Some(&floor), ..Said::default() });
        // The slab has no map: beside it, exposure does not matter.
        f64::from(stage.brightness(OPEN)) / f64::from(stage.brightness([48, 28]))
    };
    let (left, right) = ([1.0, -1.0, 0.0], [-1.0, -1.0, 0.0]);
    let flat = (seen(left, false), seen(right, false));
    assert!((flat.0 / flat.1 - 1.0).abs() < 0.1, "{flat:?}");
    let mapped = (seen(left, true), seen(right, true));
    assert!(mapped.1 > 1.1 * flat.1 && mapped.0 < 0.5 * flat.0, "{mapped:?} {flat:?}");
}

#[test]
fn an_unlit_surface_of_a_material_is_lit_by_the_programs_own_lights() {
    // The floor is lit by glLight, the slab is not.
    let seen = |slab: &dyn Fn(&mut Context)| {
        let floor = |gl: &mut Context| {
            gl.light(GL_LIGHT0, GL_POSITION, Params::Floats(&[0.0, 5.0, 0.0, 1.0]));
            gl.enable(GL_LIGHTING);
            gl.enable(GL_LIGHT0);
        };
        let slab = |gl: &mut Context| {
            gl.disable(GL_LIGHTING);
            slab(gl);
        };
        let stage = traced(&Said { floor: Some(&floor), slab: Some(&slab), ..Said::default() });
        let pixel = ((28 * SIZE.0 + 48) * 4) as usize;
        <[u8; 3]>::try_from(&stage.picture()[pixel..pixel + 3]).unwrap().map(i32::from)
    };
    let [red, green, _] = seen(&|_| {});
    assert_eq!(red, green);
    let [red, green, _] = seen(&|gl| gl.scene_emission(0.0, 2.0, 0.0));
    assert!(green > red + 30, "{red} {green}");
}

#[test]
fn classes_that_are_said_are_those_that_are_reported() {
    let class = |gl: &mut Context| gl.scene_class(GL_SCENE_DYNAMIC_AFTERGLOW);
    let stage = traced(&Said { slab: Some(&class), ..Said::default() });
    assert_eq!(triangles(&stage), TriangleCounts { r#static: 2, dynamic: 2, ..TriangleCounts::default() });
}

#[test]
fn a_cut_forgets_what_was_gathered() {
    let mut stage = Stage::new(Mode::Pathtrace, |options| {
        (options.accumulate, options.denoiser) = (true, Denoiser::None);
    });
    let samples =
        |stage: &Stage| stage.renderer.lock().unwrap().frame_report().unwrap().traced.unwrap().samples;
    draw(&mut stage, &Said::default());
    draw(&mut stage, &Said::default());
    assert_eq!(samples(&stage), 8);
    draw(&mut stage, &Said { frame: Some(&|gl| gl.scene_cut()), ..Said::default() });
    assert_eq!(samples(&stage), 4);
}

#[test]
fn a_cut_leaves_denoisers_no_history() {
    let mut stage = Stage::new(Mode::Pathtrace, |options| options.paint = Paint::History);
    let mut mean = |said: &Said| {
        draw(&mut stage, said);
        let picture = stage.picture();
        picture.iter().map(|byte| f64::from(*byte)).sum::<f64>() / picture.len() as f64
    };
    let first = mean(&Said::default());
    assert!(mean(&Said::default()) > first);
    assert_eq!(mean(&Said { frame: Some(&|gl| gl.scene_cut()), ..Said::default() }), first);
}

#[test]
fn rasterized_it_is_as_if_nothing_were_said() {
    let picture = |said: &Said| {
        let mut stage = Stage::new(Mode::Raster, |_| {});
        draw(&mut stage, said);
        stage.picture()
    };
    let floor = |gl: &mut Context| {
        gl.scene_class(GL_SCENE_DROPPED_AFTERGLOW);
        gl.scene_emission(9.0, 9.0, 9.0);
    };
    let said = Said { frame: Some(&|gl| lamp_at(gl, [0.0; 3])), floor: Some(&floor), slab: None };
    assert!(picture(&said) == picture(&Said::default()));
}

#[test]
fn what_gives_off_light_lights_the_floor_when_it_is_not_drawn() {
    let green_over_red = |memory: u64| {
        let mut stage = Stage::new(Mode::Pathtrace, |options| options.memory_bytes = memory);
        let glow = |gl: &mut Context| gl.scene_emission(0.0, 8.0, 0.0);
        let frame = |gl: &mut Context| lamp_at(gl, [0.0, 5.0, 0.0]);
        for _ in 0..10 {
            draw(&mut stage, &Said { frame: Some(&frame), slab: Some(&glow), ..Said::default() });
        }
        floor_alone(&mut stage);
        let picture = stage.picture();
        let sum = |channel: usize| picture.chunks(4).map(|pixel| f64::from(pixel[channel])).sum::<f64>();
        sum(1) / sum(0)
    };
    let (with, without) = (green_over_red(1 << 20), green_over_red(0));
    assert!(with > 1.05 * without, "{with} {without}");
    assert_valid();
}

/// One frame in which the slab is not drawn.
fn floor_alone(stage: &mut Stage) {
    let gl = &mut stage.gl;
    gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.load_identity();
    gl.translate(0.0, -0.5, -6.0);
    gl.rotate(35.0, 1.0, 0.0, 0.0);
    gl.scene_defaults();
    lamp_at(gl, [0.0, 5.0, 0.0]);
    slab(gl, 4.0);
    gl.swap_buffers();
}
