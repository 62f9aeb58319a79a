//! Texture images, filtering and borders, environments, generated coordinates, copies from the window.

use afterglow_gl::backend::{Reply, Request};
use afterglow_gl::frame::{
    BaseFormat, CombineFunction, CombineSource, Dimension, EnvMode, Frame, ImageCopy, ImageKey, ImageShape,
    ImageUpload, Matrix, Operation, Rect, Region, Sampler, TexGen, TexelFormat, TextureBinding,
    TextureMatrices, Topology, Wrap,
};
use bytemuck::Zeroable;

use crate::testing::*;

const CHECKS: [[u8; 4]; 4] = [RED, GREEN, BLUE, WHITE];

fn region(x: u32, y: u32, width: u32, height: u32) -> Region {
    Region { level: 0, layer: 0, offset: [x, y, 0], extent: [width, height, 1] }
}

#[test]
fn the_first_row_of_texels_is_the_lowest() {
    let mut frame = FrameBuilder::new(4, 4);
    frame.texture(0, [2, 2], BaseFormat::Rgba, &CHECKS);
    frame.textured_fill([1.0, 1.0]);
    let picture = frame.picture();
    let corners = [(0, 0), (3, 0), (0, 3), (3, 3)].map(|(x, y)| picture.at(x, y));
    assert_eq!(corners, CHECKS);
}

/// The colour at the left edge of a magnified texture, red left and green right, whose border is blue.
fn left_edge(wrap: Wrap) -> [u8; 4] {
    let mut frame = FrameBuilder::new(64, 2);
    let image = frame.texture(0, [2, 1], BaseFormat::Rgba, &[RED, GREEN]);
    let sampler = Sampler {
        mag_linear: true,
        min_linear: true,
        wrap: [wrap, Wrap::Repeat, Wrap::Repeat],
        border_color: [0.0, 0.0, 1.0, 1.0].map(Into::into),
        ..nearest()
    };
    frame.bind(0, image, BaseFormat::Rgba, sampler);
    frame.textured_fill([1.0, 1.0]);
    frame.picture().at(0, 0)
}

#[test]
fn wrap_modes_meet_their_neighbours() {
    let near = |found: [u8; 4], expected: [u8; 4]| {
        let close = |(a, b): (u8, u8)| a.abs_diff(b) <= 6;
        assert!(found.into_iter().zip(expected).all(close), "{found:?} is not {expected:?}");
    };
    near(left_edge(Wrap::Repeat), [130, 125, 0, 255]);
    near(left_edge(Wrap::ClampToEdge), RED);
    near(left_edge(Wrap::MirroredRepeat), RED);
    near(left_edge(Wrap::Clamp), [130, 0, 125, 255]);
    near(left_edge(Wrap::ClampToBorder), [130, 0, 125, 255]);
}

#[test]
fn clamp_shows_half_of_the_border_and_no_more() {
    let mut frame = FrameBuilder::new(4, 4);
    let image = frame.texture(0, [1, 1], BaseFormat::Rgba, &[RED]);
    let sampler = Sampler {
        mag_linear: true,
        min_linear: true,
        wrap: [Wrap::Clamp, Wrap::Repeat, Wrap::Repeat],
        border_color: [0.0, 0.0, 1.0, 1.0].map(Into::into),
        ..nearest()
    };
    frame.bind(0, image, BaseFormat::Rgba, sampler);
    frame.textured_fill([9.0, 1.0]);
    frame.picture().assert_near(3, 0, [0.5, 0.0, 0.5, 1.0]);
}

#[test]
fn levels_are_chosen_by_size() {
    let mut frame = FrameBuilder::new(4, 4);
    let image = ImageKey::unique();
    let shape = ImageShape {
        dimension: Dimension::D2,
        width: 8,
        height: 8,
        depth: 1,
        levels: 2,
        format: TexelFormat::Rgba8,
        base_format: BaseFormat::Rgba,
    };
    frame.push(Operation::DefineImage { image, shape });
    for (level, color, side) in [(0, RED, 8_u32), (1, GREEN, 4)] {
        frame.push(Operation::Upload(ImageUpload {
            image,
            region: Region { level, ..region(0, 0, side, side) },
            texels: color.repeat((side * side) as usize).into(),
        }));
    }
    let mipmapped = Sampler { mip_linear: Some(false), ..nearest() };
    frame.bind(0, image, BaseFormat::Rgba, mipmapped);
    frame.textured_fill([1.0, 1.0]);
    assert_eq!(frame.picture().count(GREEN), 16);
    frame.environment.lod_bias[0] = -1.0;
    frame.textured_fill([1.0, 1.0]);
    assert_eq!(frame.picture().count(RED), 16);
    frame.environment.lod_bias[0] = 0.0;
    frame.bind(0, image, BaseFormat::Rgba, nearest());
    frame.textured_fill([1.0, 1.0]);
    assert_eq!(frame.picture().count(RED), 16);
}

/// A fragment's colour after one unit.
fn environment(mode: EnvMode, base_format: BaseFormat, texel: [u8; 4], color: [u8; 4]) -> Picture {
    let mut frame = FrameBuilder::new(2, 2);
    frame.texture(0, [1, 1], base_format, &[texel]);
    frame.fixed.words.units[0].set_env_mode(mode as u32);
    frame.environment.env_color[0] = [0.0, 0.0, 1.0, 0.5];
    frame.fill(0.0, color);
    frame.picture()
}

#[test]
fn environments_follow_the_tables() {
    use BaseFormat as Base;
    use EnvMode as Mode;
    const TEXEL: [u8; 4] = [51, 102, 204, 128];
    const COLOR: [u8; 4] = [255, 204, 51, 128];
    let check = |mode, base, expected: [f32; 4]| {
        environment(mode, base, TEXEL, COLOR).assert_near(0, 0, expected);
    };
    check(Mode::Replace, Base::Rgba, [0.2, 0.4, 0.8, 0.5]);
    check(Mode::Replace, Base::Alpha, [1.0, 0.8, 0.2, 0.5]);
    check(Mode::Replace, Base::Luminance, [0.2, 0.2, 0.2, 0.5]);
    check(Mode::Replace, Base::Intensity, [0.2, 0.2, 0.2, 0.2]);
    check(Mode::Modulate, Base::Rgb, [0.2, 0.32, 0.16, 0.5]);
    check(Mode::Modulate, Base::LuminanceAlpha, [0.2, 0.16, 0.04, 0.25]);
    check(Mode::Decal, Base::Rgba, [0.6, 0.6, 0.5, 0.5]);
    check(Mode::Decal, Base::Rgb, [0.2, 0.4, 0.8, 0.5]);
    check(Mode::Blend, Base::Rgb, [0.8, 0.48, 0.84, 0.5]);
    check(Mode::Blend, Base::Intensity, [0.8, 0.64, 0.36, 0.5]);
    check(Mode::Add, Base::Rgba, [1.0, 1.0, 1.0, 0.25]);
    check(Mode::Add, Base::Alpha, [1.0, 0.8, 0.2, 0.25]);
}

#[test]
fn combiners_reach_other_units_and_scale() {
    let mut frame = FrameBuilder::new(2, 2);
    frame.texture(0, [1, 1], BaseFormat::Rgba, &[[51, 102, 204, 255]]);
    frame.texture(1, [1, 1], BaseFormat::Rgba, &[[255, 255, 0, 51]]);
    let unit = &mut frame.fixed.words.units[0];
    unit.set_env_mode(EnvMode::Combine as u32);
    // Colour: unit 0 times unit 1's colour, doubled. Alpha: one minus unit 1's.
    unit.set_combine_rgb(CombineFunction::Modulate as u32);
    unit.set_source_rgb0(CombineSource::Texture as u32);
    unit.set_source_rgb1(CombineSource::Texture0 as u32 + 1);
    unit.set_scale_rgb(1);
    unit.set_combine_alpha(CombineFunction::Replace as u32);
    unit.set_source_alpha0(CombineSource::Texture0 as u32 + 1);
    unit.set_operand_alpha0(1);
    // Unit 1 passes the colour on.
    let unit = &mut frame.fixed.words.units[1];
    unit.set_env_mode(EnvMode::Combine as u32);
    frame.fill(0.0, WHITE);
    frame.picture().assert_near(0, 0, [0.4, 0.8, 0.0, 0.8]);
}

#[test]
fn dot_products_fill_all_components() {
    let mut frame = FrameBuilder::new(2, 2);
    frame.texture(0, [1, 1], BaseFormat::Rgba, &[[255, 128, 128, 0]]);
    let unit = &mut frame.fixed.words.units[0];
    unit.set_env_mode(EnvMode::Combine as u32);
    unit.set_combine_rgb(CombineFunction::Dot3Rgba as u32);
    unit.set_source_rgb0(CombineSource::Texture as u32);
    unit.set_source_rgb1(CombineSource::Primary as u32);
    frame.fill(0.0, [204, 128, 128, 255]);
    frame.picture().assert_near(0, 0, [0.6; 4]);
}

#[test]
fn coordinates_are_generated_and_transformed() {
    let mut frame = FrameBuilder::new(4, 4);
    frame.texture(0, [2, 2], BaseFormat::Rgba, &CHECKS);
    let mut texgen = TexGen::zeroed();
    texgen.units[0].object[0] = [0.5, 0.0, 0.0, 0.5];
    texgen.units[0].eye[1] = [0.0, 0.5, 0.0, 0.5];
    frame.frame.texgens.push(texgen);
    frame.fixed.words.units[0].set_gen_s(1);
    frame.fixed.words.units[0].set_gen_t(2);
    frame.current.texture[0].coefficients = [0.0, 0.0, 0.0, 1.0];
    frame.fill(0.0, WHITE);
    let corners = |picture: &Picture| [(0, 0), (3, 0), (0, 3), (3, 3)].map(|(x, y)| picture.at(x, y));
    assert_eq!(corners(&frame.picture()), CHECKS);

    // Moves half the texture to the right, by a matrix that also doubles q.
    let mut matrices = TextureMatrices::zeroed();
    matrices.units[0] = Matrix { columns: IDENTITY };
    matrices.units[0].columns[3] = [1.0, 0.0, 0.0, 2.0];
    matrices.units[0].columns[0][0] = 2.0;
    matrices.units[0].columns[1][1] = 2.0;
    frame.frame.texture_matrices.push(matrices);
    frame.fixed.words.units[0].set_matrix(1);
    frame.fill(0.0, WHITE);
    assert_eq!(corners(&frame.picture()), [GREEN, RED, WHITE, BLUE]);
}

#[test]
fn sphere_maps_look_up_the_reflection() {
    let mut frame = FrameBuilder::new(4, 4);
    frame.texture(0, [2, 2], BaseFormat::Rgba, &CHECKS);
    frame.fixed.words.units[0].set_gen_s(3);
    frame.fixed.words.units[0].set_gen_t(3);
    frame.current.texture[0].coefficients = [0.0, 0.0, 0.0, 1.0];
    frame.transform.modelview[3] = [0.0, 0.0, -10.0, 1.0];
    // Seen along -z, a normal that leans to the right and down reflects to there.
    frame.current.normal = [0.28, -0.28, 0.918, 0.0];
    frame.fill(0.0, WHITE);
    assert_eq!(frame.picture().count(GREEN), 16);
}

#[test]
fn cube_and_volume_textures() {
    let shape = |dimension, depth| ImageShape {
        dimension,
        width: 1,
        height: 1,
        depth,
        levels: 1,
        format: TexelFormat::Rgba8,
        base_format: BaseFormat::Rgba,
    };
    let mut frame = FrameBuilder::new(2, 2);
    let (cube, volume) = (ImageKey::unique(), ImageKey::unique());
    frame.push(Operation::DefineImage { image: cube, shape: shape(Dimension::Cube, 1) });
    frame.push(Operation::DefineImage { image: volume, shape: shape(Dimension::D3, 4) });
    let faces = [RED, GREEN, BLUE, WHITE, BLACK, [1, 2, 3, 4]];
    for (layer, color) in faces.into_iter().enumerate() {
        let region = Region { layer: layer as u32, ..region(0, 0, 1, 1) };
        frame.push(Operation::Upload(ImageUpload { image: cube, region, texels: color.to_vec().into() }));
    }
    let slices = Region { extent: [1, 1, 4], ..region(0, 0, 1, 1) };
    let texels = [BLUE, WHITE, RED, GREEN].concat().into();
    frame.push(Operation::Upload(ImageUpload { image: volume, region: slices, texels }));

    let mut shown = |image, dimension: Dimension, coordinates| {
        frame.bindings[0] = Some(TextureBinding { image, sampler: nearest() });
        let unit = &mut frame.fixed.words.units[0];
        unit.set_target(dimension as u32);
        unit.set_base_format(BaseFormat::Rgba as u32);
        unit.set_env_mode(EnvMode::Replace as u32);
        frame.current.texture[0].coefficients = coordinates;
        frame.fill(0.0, WHITE);
        frame.picture().at(0, 0)
    };
    assert_eq!(shown(cube, Dimension::Cube, [0.1, -1.0, 0.2, 1.0]), WHITE);
    assert_eq!(shown(cube, Dimension::Cube, [0.1, 0.2, -1.0, 1.0]), [1, 2, 3, 4]);
    assert_eq!(shown(volume, Dimension::D3, [0.5, 0.5, 0.6, 1.0]), RED);
    assert_eq!(shown(volume, Dimension::D3, [0.5, 0.5, 1.8, 2.0]), GREEN);
}

#[test]
fn an_upload_between_draws_changes_only_later_ones() {
    let mut frame = FrameBuilder::new(4, 4);
    let image = frame.texture(0, [2, 2], BaseFormat::Rgba, &[RED; 4]);
    frame.textured_fill([1.0, 1.0]);
    frame.push(Operation::Upload(ImageUpload {
        image,
        region: region(0, 0, 2, 1),
        texels: GREEN.repeat(2).into(),
    }));
    frame.viewport.rect.width = 2;
    frame.textured_fill([1.0, 1.0]);
    let picture = frame.picture();
    assert_eq!((picture.count(RED), picture.count(GREEN)), (12, 4));
    assert_eq!(picture.at(0, 0), GREEN);
}

#[test]
fn a_sprite_has_its_own_coordinates_from_the_top() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    frame.texture(0, [2, 2], BaseFormat::Rgba, &CHECKS);
    frame.fixed.words.global.set_point_sprite(1);
    frame.fixed.words.units[0].set_coord_replace(1);
    frame.environment.point_size = 4.0;
    frame.primitives(Topology::Points, &[[0.0, 0.0, 0.0]], WHITE);
    let picture = frame.picture();
    let corners = [(2, 5), (5, 5), (2, 2), (5, 2)].map(|(x, y)| picture.at(x, y));
    assert_eq!(corners, CHECKS);
}

/// Copies a part of a window that has these four colours in its quarters to a texture, and shows it.
fn copied(source: Rect, target: Region, base_format: BaseFormat) -> Picture {
    let mut frame = FrameBuilder::new(4, 4);
    let image = frame.define([4, 4], base_format);
    frame.clear([0.0; 4]);
    frame.quad([-1.0, -1.0], [0.0, 0.0], 0.0, [255, 0, 0, 51]);
    frame.quad([0.0, -1.0], [1.0, 0.0], 0.0, GREEN);
    frame.quad([-1.0, 0.0], [0.0, 1.0], 0.0, BLUE);
    frame.quad([0.0, 0.0], [1.0, 1.0], 0.0, WHITE);
    frame.push(Operation::CopyToImage(ImageCopy { image, region: target, source, base_format }));
    frame.clear([0.0; 4]);
    frame.bind(0, image, base_format, nearest());
    frame.textured_fill([1.0, 1.0]);
    frame.picture()
}

#[test]
fn the_window_becomes_a_texture() {
    let all = Rect { x: 0, y: 0, width: 4, height: 4 };
    let picture = copied(all, region(0, 0, 4, 4), BaseFormat::Rgba);
    let corners = [(0, 0), (3, 0), (0, 3), (3, 3)].map(|(x, y)| picture.at(x, y));
    assert_eq!(corners, [[255, 0, 0, 51], GREEN, BLUE, WHITE]);
    let opaque = copied(all, region(0, 0, 4, 4), BaseFormat::Rgb);
    assert_eq!(opaque.at(0, 0), RED);
    let grey = copied(all, region(0, 0, 4, 4), BaseFormat::Intensity);
    assert_eq!(grey.at(0, 0), WHITE);
    assert_eq!(grey.at(3, 0), [0; 4]);
}

#[test]
fn parts_outside_of_the_window_are_not_copied() {
    let source = Rect { x: 1, y: -1, width: 2, height: 3 };
    let picture = copied(source, region(2, 1, 2, 3), BaseFormat::Rgba);
    assert_eq!(picture.count([0; 4]), 12);
    assert_eq!(picture.at(2, 2), [255, 0, 0, 51]);
    assert_eq!(picture.at(3, 3), GREEN);
}

#[test]
fn a_copy_of_another_size_is_resampled() {
    // Two by two pixels of four colours become four by four texels.
    let middle = Rect { x: 1, y: 1, width: 2, height: 2 };
    let all = Rect { x: 0, y: 0, width: 4, height: 4 };
    let picture = copied(middle, region(0, 0, 4, 4), BaseFormat::Rgba);
    assert_eq!(picture, copied(all, region(0, 0, 4, 4), BaseFormat::Rgba));

    // Four by four pixels become three rows of two texels: the middle row is the third one.
    let picture = copied(all, region(1, 0, 2, 3), BaseFormat::Rgba);
    let rows = [0, 1, 2].map(|y| [picture.at(1, y), picture.at(2, y)]);
    assert_eq!(rows, [[[255, 0, 0, 51], GREEN], [BLUE, WHITE], [BLUE, WHITE]]);

    // The right half lies outside of the window, and keeps its texels.
    let half_outside = Rect { x: 2, y: 0, width: 4, height: 2 };
    let picture = copied(half_outside, region(0, 0, 4, 4), BaseFormat::Rgba);
    assert_eq!((picture.at(0, 0), picture.at(1, 3)), (GREEN, GREEN));
    assert_eq!((picture.count(GREEN), picture.at(2, 0)), (8, [0; 4]));
}

#[test]
fn long_copies_are_resampled_in_parts() {
    let mut frame = FrameBuilder::new(4, 128);
    let image = frame.define([256, 64], BaseFormat::Rgba);
    frame.clear([0.0, 0.0, 1.0, 1.0]);
    frame.quad([-1.0, -1.0], [0.0, -0.5], 0.0, RED);
    frame.push(Operation::CopyToImage(ImageCopy {
        image,
        region: region(0, 0, 256, 64),
        source: Rect { x: 0, y: 0, width: 4, height: 128 },
        base_format: BaseFormat::Rgba,
    }));
    let request = Request::Texels { image, region: region(0, 0, 256, 64) };
    let reply = renderer().execute_and_answer(&frame.frame, &request).unwrap();
    let expected = (0..64).flat_map(|y| (0..256).map(move |x| if x < 128 && y < 16 { RED } else { BLUE }));
    assert_eq!(reply, Reply::Color(expected.flatten().collect()));
}

#[test]
fn many_copies_in_one_frame() {
    let mut frame = FrameBuilder::new(8, 8);
    let images: Vec<_> = (0..64).map(|_| frame.define([8, 8], BaseFormat::Rgba)).collect();
    frame.clear([1.0, 0.0, 0.0, 1.0]);
    let source = Rect { x: 0, y: 0, width: 8, height: 8 };
    for image in images.iter().copied().cycle().take(200) {
        let (region, base_format) = (region(0, 0, 8, 8), BaseFormat::Rgba);
        frame.push(Operation::CopyToImage(ImageCopy { image, region, source, base_format }));
    }
    frame.clear([0.0; 4]);
    for (number, image) in images.into_iter().enumerate() {
        let [x, y] = [number % 8, number / 8].map(|i| i as i32);
        frame.viewport.rect = Rect { x, y, width: 1, height: 1 };
        frame.bind(0, image, BaseFormat::Rgba, nearest());
        frame.textured_fill([1.0, 1.0]);
    }
    assert_eq!(frame.picture().count(RED), 64);
}

#[test]
fn depth_becomes_a_texture_and_is_compared() {
    let mut frame = FrameBuilder::new(4, 4);
    let image = frame.define([4, 4], BaseFormat::Depth);
    frame.clear([0.0; 4]);
    frame.fixed.raster.depth =
        Some(afterglow_gl::frame::Depth { compare: afterglow_gl::frame::Compare::Always, write: true });
    frame.quad([-1.0, -1.0], [0.0, 1.0], 0.0, WHITE);
    frame.fixed.raster.depth = None;
    frame.push(Operation::CopyToImage(ImageCopy {
        image,
        region: region(0, 0, 4, 4),
        source: Rect { x: 0, y: 0, width: 4, height: 4 },
        base_format: BaseFormat::Depth,
    }));
    frame.bind(0, image, BaseFormat::Depth, nearest());
    frame.textured_fill([1.0, 1.0]);
    let picture = frame.picture();
    picture.assert_near(0, 2, [0.5, 0.5, 0.5, 1.0]);
    assert_eq!(picture.at(3, 2), WHITE);

    // GL_LEQUAL with r = 0.75, as alpha.
    frame.fixed.words.units[0].set_compare(1 + 3);
    frame.fixed.words.units[0].set_depth_mode(2);
    let mut texgen = TexGen::zeroed();
    texgen.units[0].object[2] = [0.0, 0.0, 0.0, 0.75];
    frame.frame.texgens.push(texgen);
    frame.fixed.words.units[0].set_gen_r(1);
    frame.textured_fill([1.0, 1.0]);
    let picture = frame.picture();
    assert_eq!(picture.at(0, 2)[3], 0);
    assert_eq!(picture.at(3, 2)[3], 255);
}

#[test]
fn images_are_copied_and_dropped() {
    let mut renderer = renderer();
    let mut frame = FrameBuilder::new(2, 2);
    let first = frame.texture(0, [2, 2], BaseFormat::Rgba, &CHECKS);
    let second = frame.define([2, 2], BaseFormat::Rgba);
    frame.push(Operation::CopyImage { from: first, region: region(1, 0, 1, 2), to: second, to_level: 0 });
    frame.bind(0, second, BaseFormat::Rgba, nearest());
    frame.textured_fill([1.0, 1.0]);
    frame.push(Operation::DropImage(first));
    let picture = Picture::after(&mut renderer, &[&frame.frame]);
    let texels = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| picture.at(x, y));
    assert_eq!(texels, [[0; 4], GREEN, [0; 4], WHITE]);
    let last = Frame { size: (2, 2), operations: vec![Operation::DropImage(second)], ..Frame::default() };
    Picture::after(&mut renderer, &[&last]);
    assert_eq!(renderer.frame_report().unwrap().textures, 0);
}

#[test]
fn operations_on_missing_images_do_nothing() {
    let mut frame = FrameBuilder::new(2, 2);
    let missing = ImageKey::unique();
    let texels = WHITE.to_vec().into();
    frame.push(Operation::Upload(ImageUpload { image: missing, region: region(0, 0, 1, 1), texels }));
    let known = frame.define([2, 2], BaseFormat::Rgba);
    let short = vec![1, 2, 3].into();
    frame.push(Operation::Upload(ImageUpload { image: known, region: region(0, 0, 2, 2), texels: short }));
    frame.push(Operation::CopyImage { from: missing, region: region(0, 0, 1, 1), to: known, to_level: 7 });
    frame.push(Operation::DropImage(missing));
    frame.bind(0, missing, BaseFormat::Rgba, nearest());
    frame.textured_fill([1.0, 1.0]);
    assert_eq!(frame.picture().count(WHITE), 4);
}
