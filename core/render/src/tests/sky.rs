//! The sky that a program draws about the eye, as surfaces reflect it.

use afterglow_api::constants::*;
use afterglow_gl::texture::ImageDefinition;
use afterglow_gl::{Context, Params};
use afterglow_records::{SKY_EDGE, SKY_LEVELS};

use super::pathtrace::{SIZE, Stage, slab};
use crate::pathtrace::sky::{SIDES, SkyMap};
use crate::testing::{assert_valid, gpu};
use crate::{Backend, Denoiser, Mode, SkyChoice, TraceCounts};

/// What a vertex of the sky is given, by where it is seen from the eye and whether that belongs to the left half.
type Paint<'a> = &'a dyn Fn(&mut Context, [f32; 3], bool);

const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];
const GREEN: [f32; 4] = [0.0, 1.0, 0.0, 1.0];

/// A floor under a sky, and how the sky is turned about the world's upward axis.
struct World<'a> {
    paint: Paint<'a>,
    turned: f32,
    /// How far the camera has turned to the left, degrees.
    camera: f32,
    /// Roughness and metallic of the floor.
    floor: [f32; 2],
}

impl Default for World<'_> {
    fn default() -> Self {
        Self { paint: &halves, turned: 0.0, camera: 0.0, floor: [0.0, 1.0] }
    }
}

/// Red to the left, green to the right.
fn halves(gl: &mut Context, _: [f32; 3], is_left: bool) {
    gl.color(if is_left { RED } else { GREEN });
}

/// Corners of the sides of a cube, each cut in two along an axis that is not the side's own.
fn cube(gl: &mut Context, paint: Paint) {
    gl.begin(GL_QUADS);
    for side in 0..6 {
        let (axis, sign) = (side / 2, if side % 2 == 0 { 1.0 } else { -1.0 });
        let [across, along] = if axis == 0 { [2, 1] } else { [0, 3 - axis] };
        for [from, to] in [[-1.0_f32, 0.0], [0.0, 1.0]] {
            let corner = |a: f32, b: f32| {
                let mut corner = [0.0_f32; 3];
                (corner[axis], corner[across], corner[along]) = (sign, a, b);
                corner
            };
            for [a, b] in [[from, -1.0], [to, -1.0], [to, 1.0], [from, 1.0]] {
                let is_left = if axis == 0 { sign < 0.0 } else { to <= 0.0 };
                paint(gl, corner(a, b), is_left);
                let [x, y, z] = corner(a, b);
                gl.vertex([x, y, z, 1.0]);
            }
        }
    }
    gl.end();
}

fn draw(stage: &mut Stage, world: &World) {
    let gl = &mut stage.gl;
    gl.clear_color(0.0, 0.0, 0.0, 1.0);
    gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.matrix_mode(GL_PROJECTION);
    gl.load_identity();
    gl.frustum(-0.8, 0.8, -0.6, 0.6, 1.0, 50.0);
    gl.matrix_mode(GL_MODELVIEW);
    gl.load_identity();
    gl.rotate(35.0, 1.0, 0.0, 0.0);
    gl.rotate(world.camera, 0.0, 1.0, 0.0);
    gl.push_matrix();
    gl.rotate(world.turned, 0.0, 1.0, 0.0);
    gl.scale(3.0, 3.0, 3.0);
    gl.scene_defaults();
    cube(gl, world.paint);
    gl.pop_matrix();
    gl.disable(GL_TEXTURE_2D);
    gl.translate(0.0, -3.0, 0.0);
    let [roughness, metallic] = world.floor;
    gl.scene_material(roughness, metallic);
    for capability in [GL_LIGHTING, GL_LIGHT0, GL_DEPTH_TEST] {
        gl.enable(capability);
    }
    gl.light(GL_LIGHT0, GL_POSITION, Params::Floats(&[0.0, 5.0, 20.0, 1.0]));
    gl.color([1.0; 4]);
    slab(gl, 40.0);
    // Things that say where the camera is.
    gl.scene_defaults();
    for [x, z] in [[0.0, -5.0], [0.5, -9.0], [-1.0, -14.0], [5.0, 0.0], [-6.0, 1.0]] {
        gl.push_matrix();
        gl.translate(x, 0.3, z);
        slab(gl, 0.3);
        gl.pop_matrix();
    }
    for capability in [GL_LIGHTING, GL_DEPTH_TEST] {
        gl.disable(capability);
    }
    gl.swap_buffers();
    assert_eq!(gl.get_error(), GL_NO_ERROR);
}

fn stage(sky: SkyChoice) -> Stage {
    Stage::new(Mode::Pathtrace, |options| {
        options.keeps_radiance = true;
        options.denoiser = Denoiser::None;
        options.sky = sky;
    })
}

/// Linear radiance of a pixel; rows count from the top.
fn radiance(stage: &Stage, [x, y]: [u32; 2]) -> [f32; 3] {
    let picture = stage.renderer.lock().unwrap().read_radiance().unwrap().unwrap();
    picture.mean[(y * SIZE.0 + x) as usize]
}

fn counts(stage: &Stage) -> TraceCounts {
    stage.renderer.lock().unwrap().frame_report().unwrap().traced.unwrap()
}

/// Places on the floor to the left and to the right.
const LEFT: [u32; 2] = [12, 40];
const RIGHT: [u32; 2] = [84, 40];

#[track_caller]
fn assert_shows(stage: &Stage, place: [u32; 2], color: [f32; 4]) {
    let seen = radiance(stage, place);
    let (bright, dark) = if color == RED { (0, 1) } else { (1, 0) };
    assert!(seen[bright] > 0.3 && seen[dark] < 0.04, "{place:?} shows {seen:?}");
}

#[test]
fn a_mirror_shows_the_sky_that_is_there() {
    for backend in [Backend::Software, Backend::Hardware] {
        let mut stage = Stage::new(Mode::Pathtrace, |options| {
            (options.keeps_radiance, options.backend) = (true, backend);
            options.denoiser = Denoiser::None;
        });
        draw(&mut stage, &World::default());
        assert_shows(&stage, LEFT, RED);
        assert_shows(&stage, RIGHT, GREEN);
        draw(&mut stage, &World { turned: 180.0, ..World::default() });
        assert_shows(&stage, LEFT, GREEN);
        assert_shows(&stage, RIGHT, RED);
    }
    let mut constant = self::stage(SkyChoice::Constant);
    draw(&mut constant, &World::default());
    assert_eq!(counts(&constant).sky, SkyChoice::Constant);
    let [red, green, _] = radiance(&constant, LEFT);
    assert!((red - green).abs() < 0.02, "a constant sky is the same everywhere: {red} {green}");
    assert_valid();
}

#[test]
fn a_still_sky_is_drawn_once_while_the_camera_turns() {
    let mut stage = stage(SkyChoice::Cube);
    let drawings = [0.0, 20.0, 40.0, 60.0].map(|camera| {
        draw(&mut stage, &World { camera, ..World::default() });
        assert_eq!(counts(&stage).sky, SkyChoice::Cube);
        counts(&stage).sky_drawings
    });
    assert_eq!(drawings, [1; 4]);
    // It has turned so far that both places show what is to the left.
    assert_shows(&stage, LEFT, GREEN);
    draw(&mut stage, &World { camera: 60.0, turned: 5.0, ..World::default() });
    assert_eq!(counts(&stage).sky_drawings, 2);
    assert_valid();
}

#[test]
fn a_sky_of_one_colour_is_as_a_constant_one() {
    let grey: Paint = &|gl, _, _| gl.color([51.0 / 255.0, 102.0 / 255.0, 204.0 / 255.0, 1.0]);
    for floor in [[0.0, 1.0], [1.0, 0.0], [0.4, 0.5]] {
        let picture = |sky| {
            let mut stage = stage(sky);
            draw(&mut stage, &World { paint: grey, floor, ..World::default() });
            let radiance = stage.renderer.lock().unwrap().read_radiance().unwrap().unwrap();
            radiance.mean
        };
        let differs = |(cube, constant): (&[f32; 3], &[f32; 3])| {
            cube.iter().zip(constant).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
        };
        let (cube, constant) = (picture(SkyChoice::Cube), picture(SkyChoice::Constant));
        let most = cube.iter().zip(&constant).map(differs).fold(0.0, f32::max);
        assert!(most < 1e-4, "{most} with a floor of {floor:?}");
    }
    assert_valid();
}

#[test]
fn clouds_that_move_do_so_in_the_mirror() {
    let mut stage = stage(SkyChoice::Cube);
    let gl = &mut stage.gl;
    gl.bind_texture(GL_TEXTURE_2D, 1);
    for filter in [GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER] {
        gl.tex_parameter(GL_TEXTURE_2D, filter, Params::Ints(&[GL_NEAREST as i32]));
    }
    let definition = ImageDefinition { level: 0, internal_format: GL_RGBA, size: [2, 1, 1], border: 0 };
    let texels = [255, 0, 0, 255, 0, 255, 0, 255];
    gl.tex_image((GL_TEXTURE_2D, 2), definition, (GL_RGBA, GL_UNSIGNED_BYTE), Some(&texels));
    let textured: Paint = &|gl, [x, _, _], _| {
        gl.color([1.0; 4]);
        gl.tex_coord([0.5 + 0.5 * x, 0.0, 0.0, 1.0]);
    };
    let mut frame = |moved: f32| {
        let gl = &mut stage.gl;
        gl.enable(GL_TEXTURE_2D);
        gl.matrix_mode(GL_TEXTURE);
        gl.load_identity();
        gl.translate(moved, 0.0, 0.0);
        draw(&mut stage, &World { paint: textured, ..World::default() });
        (radiance(&stage, LEFT), counts(&stage).sky_drawings)
    };
    let (first, drawn) = frame(0.0);
    assert!(first[0] > 0.3 && first[1] < 0.04 && drawn == 1, "{first:?} {drawn}");
    assert_eq!(frame(0.0).1, 1);
    let (second, drawn) = frame(0.5);
    assert!(second[1] > 0.3 && second[0] < 0.04 && drawn == 2, "{second:?} {drawn}");
    assert_valid();
}

/// The map's texels after a frame, drawn with or without multiview.
fn texels(is_multiview: bool, paint: Paint) -> Vec<[f32; 4]> {
    let mut stage = stage(SkyChoice::Cube);
    let map = SkyMap::new(&gpu(), is_multiview).unwrap();
    stage.renderer.lock().unwrap().tracer.as_mut().unwrap().sky = Some(map);
    draw(&mut stage, &World { paint, turned: 25.0, ..World::default() });
    let mut renderer = stage.renderer.lock().unwrap();
    renderer.finish().unwrap();
    let buffer = &renderer.tracer.as_ref().unwrap().sky.as_ref().unwrap().texels.buffer;
    bytemuck::pod_collect_to_vec(&gpu().download_buffer(buffer).unwrap())
}

/// A colour that is the same on both sides of each edge.
fn gradient(gl: &mut Context, [x, y, z]: [f32; 3], _: bool) {
    gl.color([0.5 + 0.4 * x, 0.5 + 0.4 * y, 0.5 + 0.4 * z, 1.0]);
}

#[test]
fn sides_meet_without_a_seam_at_every_level() {
    let texels = texels(true, &gradient);
    let mut first = 0;
    for level in 0..SKY_LEVELS {
        let edge = (SKY_EDGE >> level) as usize;
        let width = edge + 2;
        // As much as the light of neighbouring texels differs elsewhere.
        let most = 2.5 / edge as f32;
        for side in 0..SIDES as usize {
            let at = |x: usize, y: usize| texels[first + (side * width + y) * width + x];
            let mut apart = 0.0_f32;
            for i in 1..=edge {
                for (beyond, within) in [
                    ([0, i], [1, i]),
                    ([edge + 1, i], [edge, i]),
                    ([i, 0], [i, 1]),
                    ([i, edge + 1], [i, edge]),
                ] {
                    let (beyond, within) = (at(beyond[0], beyond[1]), at(within[0], within[1]));
                    apart = beyond.iter().zip(within).map(|(a, b)| (a - b).abs()).fold(apart, f32::max);
                }
            }
            assert!(apart < most, "side {side} of level {level}: {apart}");
        }
        first += SIDES as usize * width * width;
    }
    assert_eq!(first, texels.len());
    assert!(texels[..SIDES as usize * (SKY_EDGE as usize + 2).pow(2)].iter().all(|texel| texel[3] == 1.0));
}

#[test]
fn sides_are_the_same_at_once_and_one_after_another() {
    let (at_once, one_by_one) = (texels(true, &halves), texels(false, &halves));
    assert!(at_once == one_by_one);
    assert_valid();
}
