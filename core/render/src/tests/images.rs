//! Images from a folder in place of a program's textures.

use std::fs;
use std::path::Path;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use afterglow_api::constants::*;
use afterglow_gl::texture::ImageDefinition;
use afterglow_gl::{Context, Params};
use image::ExtendedColorType::{La8, Rgb8, Rgba8};
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use tempfile::TempDir;

use super::pathtrace::{OPEN, SIZE, Stage, look_down, slab};
use crate::testing::assert_valid;
use crate::{Backend, ImageOptions, Mode};

const LEFT: [f32; 3] = [1.0, -1.0, 0.0];
const RIGHT: [f32; 3] = [-1.0, -1.0, 0.0];
/// A pixel of the slab, which has no texture.
const SLAB: [u32; 2] = [48, 28];

fn stage(mode: Mode, folder: &Path, waits: bool) -> Stage {
    Stage::new(mode, |options| options.images = Some(ImageOptions { folder: folder.into(), waits }))
}

/// A floor with a grey texture and a slab without over it, in a light along a direction.
fn draw(stage: &mut Stage, direction: [f32; 3]) {
    let gl = &mut stage.gl;
    gl.clear_color(0.0, 0.0, 0.0, 1.0);
    gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    look_down(gl);
    gl.scene_view();
    gl.scene_directional_light(1, direction, [3.0; 3], 0.5);
    gl.scene_sky(0.1, 0.1, 0.1);
    gl.enable(GL_DEPTH_TEST);
    gl.enable(GL_TEXTURE_2D);
    texture(gl);
    slab(gl, 4.0);
    gl.disable(GL_TEXTURE_2D);
    gl.translate(0.0, 1.5, 0.0);
    slab(gl, 0.8);
    gl.swap_buffers();
    assert_eq!(gl.get_error(), GL_NO_ERROR);
}

/// Binds the floor's texture, which is made the first time.
fn texture(gl: &mut Context) {
    gl.bind_texture(GL_TEXTURE_2D, 7);
    gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, Params::Ints(&[GL_NEAREST as i32]));
    let definition = ImageDefinition { level: 0, internal_format: GL_RGBA, size: [2, 2, 1], border: 0 };
    let texels = [[128, 128, 128, 255]; 4].concat();
    gl.tex_image((GL_TEXTURE_2D, 2), definition, (GL_RGBA, GL_UNSIGNED_BYTE), Some(&texels));
}

fn pixel(stage: &Stage, [x, y]: [u32; 2]) -> [i32; 3] {
    let first = ((y * SIZE.0 + x) * 4) as usize;
    <[u8; 3]>::try_from(&stage.picture()[first..first + 3]).unwrap().map(i32::from)
}

/// The hash of the floor's texture, as another run of the program has it.
fn floor_hash() -> u64 {
    static HASH: OnceLock<u64> = OnceLock::new();
    *HASH.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        let mut stage = stage(Mode::Pathtrace, folder.path(), true);
        draw(&mut stage, LEFT);
        let renderer = stage.renderer.lock().unwrap();
        let hashes: Vec<u64> = renderer.replacements.as_ref().unwrap().hashes().collect();
        assert_eq!(hashes.len(), 1);
        hashes[0]
    })
}

/// A folder with one file for the floor's texture: what its name has after the hash, and its content.
fn folder_with(end: &str, content: &[u8]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(format!("{:016x}{end}", floor_hash())), content).unwrap();
    folder
}

fn png(texel: &[u8], kind: ExtendedColorType) -> Vec<u8> {
    let mut file = Vec::new();
    PngEncoder::new(&mut file).write_image(&texel.repeat(4), 2, 2, kind).unwrap();
    file
}

/// A DDS file of blocks of BC1 in one colour (5, 6 and 5 bits), 8 texels a side, with all mipmaps.
fn dds(color: u16) -> Vec<u8> {
    let mut words = [0u32; 32];
    words[0] = u32::from_le_bytes(*b"DDS ");
    words[1..8].copy_from_slice(&[124, 0x2_1007, 8, 8, 0, 0, 4]);
    words[19..22].copy_from_slice(&[32, 4, u32::from_le_bytes(*b"DXT1")]);
    words[27] = 0x1000;
    let block = [color, color, 0, 0].map(u16::to_le_bytes);
    words.iter().flat_map(|word| word.to_le_bytes()).chain(block.concat().repeat(4 + 1 + 1 + 1)).collect()
}

/// The open floor in a light from the left, as files replace its texture.
fn seen(folder: &TempDir) -> [i32; 3] {
    let mut stage = stage(Mode::Pathtrace, folder.path(), true);
    draw(&mut stage, LEFT);
    assert_valid();
    pixel(&stage, OPEN)
}

#[test]
fn a_texture_is_replaced_where_frames_are_traced() {
    let folder = folder_with(".png", &png(&[0, 255, 0, 255], Rgba8));
    let [red, green, _] = seen(&folder);
    assert!(green > red + 30, "{red} {green}");
    let mut raster = stage(Mode::Raster, folder.path(), true);
    draw(&mut raster, LEFT);
    let [red, green, _] = pixel(&raster, OPEN);
    assert_eq!(red, green);
}

#[test]
fn all_images_are_there_in_either_mode_by_either_backend() {
    let folder = folder_with(".png", &png(&[0, 255, 0, 255], Rgba8));
    for (end, texel) in [("_normal.png", [128, 128, 255, 0]), ("_emission.png", [0, 0, 160, 100])] {
        fs::write(folder.path().join(format!("{:016x}{end}", floor_hash())), png(&texel, Rgba8)).unwrap();
    }
    for mode in [Mode::Pathtrace, Mode::Reference] {
        let floors = [Backend::Software, Backend::Hardware].map(|backend| {
            let mut stage = Stage::new(mode, |options| {
                options.images = Some(ImageOptions { folder: folder.path().into(), waits: true });
                options.backend = backend;
                options.spp = 32;
            });
            draw(&mut stage, LEFT);
            pixel(&stage, OPEN)
        });
        for [red, green, blue] in floors {
            assert!(green > red + 30 && blue > red + 30, "{mode:?}: {floors:?}");
        }
        let [software, hardware] = floors;
        let far = software.iter().zip(hardware).filter(|(a, b)| (*a - b).abs() > 2);
        assert_eq!(far.count(), 0, "{mode:?}: {floors:?}");
    }
    assert_valid();
}

#[test]
fn blocks_are_uploaded_as_they_are() {
    let [red, green, _] = seen(&folder_with(".dds", &dds(0xf800)));
    assert!(red > green + 30, "{red} {green}");
}

#[test]
fn an_emission_image_shines() {
    let [red, green, blue] = seen(&folder_with("_emission.png", &png(&[0, 0, 255], Rgb8)));
    assert!(blue > red + 30 && blue > green + 30, "{red} {green} {blue}");
}

#[test]
fn a_normal_image_turns_the_surface_and_says_what_is_metal() {
    // The floor beside the slab, so that exposure does not matter.
    let ratio = |folder: &TempDir, direction| {
        let mut stage = stage(Mode::Pathtrace, folder.path(), true);
        draw(&mut stage, direction);
        assert_valid();
        f64::from(pixel(&stage, OPEN)[1]) / f64::from(pixel(&stage, SLAB)[1])
    };
    let none = tempfile::tempdir().unwrap();
    let flat = (ratio(&none, LEFT), ratio(&none, RIGHT));
    let lean = folder_with("_normal.png", &png(&[218, 128, 218], Rgb8));
    let leaning = (ratio(&lean, LEFT), ratio(&lean, RIGHT));
    assert!(leaning.1 > 1.05 * flat.1 && leaning.0 < 0.7 * flat.0, "{leaning:?} {flat:?}");
    // A metal has no colour of its own but what it mirrors: from the side that is the dim sky.
    let metal = folder_with("_normal.png", &png(&[128, 128, 255, 255], Rgba8));
    let metal = (ratio(&metal, LEFT), ratio(&metal, RIGHT));
    assert!((metal.0 - flat.0).abs() > 0.05 * flat.0, "{metal:?} {flat:?}");
}

#[test]
fn a_damaged_file_changes_nothing() {
    let folder = folder_with(".png", b"\x89PNG no picture");
    let [red, green, _] = seen(&folder);
    assert_eq!(red, green);
    let grey = seen(&folder_with(".png", &png(&[200, 255], La8)));
    assert_eq!(grey[0], grey[1]);
}

#[test]
fn changed_files_are_seen_while_the_program_runs() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("{:016x}.png", floor_hash()));
    let mut stage = stage(Mode::Pathtrace, folder.path(), false);
    let mut until = |is_seen: &dyn Fn([i32; 3]) -> bool| {
        let begun = Instant::now();
        loop {
            draw(&mut stage, LEFT);
            let floor = pixel(&stage, OPEN);
            if is_seen(floor) {
                return begun.elapsed();
            }
            assert!(begun.elapsed() < Duration::from_secs(30), "{floor:?}");
        }
    };
    until(&|[red, green, _]| red == green);
    fs::write(&path, png(&[0, 255, 0, 255], Rgba8)).unwrap();
    until(&|[red, green, _]| green > red + 30);
    fs::write(&path, png(&[255, 0, 0], Rgb8)).unwrap();
    until(&|[red, green, _]| red > green + 30);
    fs::remove_file(&path).unwrap();
    until(&|[red, green, _]| red == green);
    assert_valid();
}

#[test]
fn rasterizing_gives_images_back() {
    let folder = folder_with(".png", &png(&[0, 255, 0, 255], Rgba8));
    let mut stage = stage(Mode::Pathtrace, folder.path(), true);
    draw(&mut stage, LEFT);
    let count = |stage: &Stage| stage.renderer.lock().unwrap().textures.len();
    let with = count(&stage);
    let options = crate::PathtraceOptions::default();
    stage.renderer.lock().unwrap().set_mode(Mode::Raster, &options).unwrap();
    assert_eq!(count(&stage), with - 1);
    draw(&mut stage, LEFT);
    let [red, green, _] = pixel(&stage, OPEN);
    assert_eq!(red, green);
    assert_valid();
}
