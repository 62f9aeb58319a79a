//! Textures as a whole: what is complete, what is emitted, in which order.

use std::sync::Arc;

use afterglow_api::constants::*;

use super::*;
use crate::backend::{Reply, Request};
use crate::context::Params;
use crate::frame::{BaseFormat, Dimension, ImageKey, Operation, Rect, TexelFormat};
use crate::params::Values;
use crate::pixel::{Extent, GlResult, Packing, PixelTransfer};

const AT_ORIGIN: CopySource = CopySource { x: 0, y: 0 };

fn set(texture: &mut TextureObject, pname: u32, value: u32) {
    texture.set_parameter(pname, &Values::new(Params::Ints(&[value as i32]))).unwrap();
}

fn linear(target: u32) -> TextureObject {
    let mut texture = TextureObject::new(target);
    set(&mut texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    texture
}

fn definition(level: i32, internal_format: u32, size: [i32; 3]) -> ImageDefinition {
    ImageDefinition { level, internal_format, size, border: 0 }
}

/// Calls `with` with RGBA bytes as the input.
fn input<T>(data: Option<&[u8]>, with: impl FnOnce(&PixelInput) -> T) -> T {
    let (packing, transfer) = (Packing::tight(), PixelTransfer::default());
    let (format, kind) = (GL_RGBA, GL_UNSIGNED_BYTE);
    with(&PixelInput { format, kind, data, packing: &packing, transfer: &transfer })
}

fn face_image(texture: &mut TextureObject, face: usize, level: i32, size: [i32; 3], value: u8) {
    let data = vec![value; 4 * size.iter().product::<i32>() as usize];
    input(Some(&data), |input| texture.tex_image(face, &definition(level, GL_RGBA, size), input)).unwrap();
}

fn image(texture: &mut TextureObject, level: i32, width: i32, height: i32, value: u8) {
    face_image(texture, 0, level, [width, height, 1], value);
}

fn sub_image(texture: &mut TextureObject, offset: [i32; 3], size: [i32; 3], value: u8) -> Vec<Operation> {
    let data = vec![value; 4 * size.iter().product::<i32>() as usize];
    let (sub, mut out) = (SubImage { level: 0, offset, size }, Vec::new());
    input(Some(&data), |input| texture.tex_sub_image(0, &sub, input, &mut out)).unwrap();
    out
}

fn realize(texture: &mut TextureObject) -> (Option<Realized>, Vec<Operation>) {
    let mut out = Vec::new();
    (texture.realize(&mut out), out)
}

/// Operations in short: define (levels), upload (level, layer, first byte), copy to (level), copy from
/// (level) to (level), drop.
fn short(operations: &[Operation]) -> Vec<String> {
    let line = |operation: &Operation| match operation {
        Operation::DefineImage { shape, .. } => format!("define {}", shape.levels),
        Operation::Upload(upload) => {
            let region = upload.region;
            format!("upload {} {} {}", region.level, region.layer, upload.texels[0])
        }
        Operation::CopyToImage(copy) => format!("copy to {} {}", copy.region.level, copy.region.layer),
        Operation::CopyImage { region, to_level, .. } => format!("copy {} to {to_level}", region.level),
        Operation::DropImage(_) => "drop".into(),
        other => panic!("{other:?}"),
    };
    operations.iter().map(line).collect()
}

fn is_complete(texture: &mut TextureObject) -> bool {
    realize(texture).0.is_some()
}

#[test]
fn nothing_is_incomplete() {
    assert!(!is_complete(&mut linear(GL_TEXTURE_2D)));
    let mut texture = linear(GL_TEXTURE_2D);
    image(&mut texture, 0, 0, 4, 0);
    assert!(!is_complete(&mut texture));
}

#[test]
fn mipmaps_need_all_levels() {
    let mut texture = TextureObject::new(GL_TEXTURE_2D);
    image(&mut texture, 0, 5, 3, 10);
    assert!(!is_complete(&mut texture));
    image(&mut texture, 1, 2, 1, 11);
    assert!(!is_complete(&mut texture));
    image(&mut texture, 2, 1, 1, 12);
    let (realized, operations) = realize(&mut texture);
    assert_eq!(short(&operations), ["define 3", "upload 0 0 10", "upload 1 0 11", "upload 2 0 12"]);
    let shape = realized.unwrap().shape;
    assert_eq!((shape.width, shape.height, shape.dimension), (5, 3, Dimension::D2));
    assert_eq!(texture.sampler().max_lod.get(), 2.0);
    // A level of a wrong size.
    image(&mut texture, 1, 3, 1, 0);
    assert!(!is_complete(&mut texture));
    // Which does not matter if it is beyond the last.
    set(&mut texture, GL_TEXTURE_MAX_LEVEL, 0);
    let (realized, operations) = realize(&mut texture);
    assert_eq!((realized.unwrap().levels, operations.len()), (1, 0));
    assert_eq!(texture.sampler().max_lod.get(), 0.0);
    set(&mut texture, GL_TEXTURE_BASE_LEVEL, 1);
    assert!(!is_complete(&mut texture));
}

#[test]
fn levels_of_another_format_do_not_fit() {
    let mut texture = TextureObject::new(GL_TEXTURE_1D);
    image(&mut texture, 0, 2, 1, 0);
    input(None, |input| texture.tex_image(0, &definition(1, GL_RGB, [1, 1, 1]), input)).unwrap();
    assert!(!is_complete(&mut texture));
    input(None, |input| texture.tex_image(0, &definition(1, GL_RGBA4, [1, 1, 1]), input)).unwrap();
    assert!(is_complete(&mut texture));
}

#[test]
fn cube_maps_need_six_faces() {
    let mut texture = linear(GL_TEXTURE_CUBE_MAP);
    for face in 0..6 {
        assert!(!is_complete(&mut texture));
        face_image(&mut texture, face, 0, [2, 2, 1], face as u8);
    }
    let (realized, operations) = realize(&mut texture);
    assert_eq!(realized.unwrap().shape.dimension, Dimension::Cube);
    assert_eq!(short(&operations)[1..3], ["upload 0 0 0", "upload 0 1 1"]);
    face_image(&mut texture, 3, 0, [4, 4, 1], 9);
    assert!(!is_complete(&mut texture));
}

#[test]
fn nothing_changed_emits_nothing() {
    let mut texture = linear(GL_TEXTURE_2D);
    image(&mut texture, 0, 2, 2, 1);
    let (first, _) = realize(&mut texture);
    let version = texture.version();
    let (second, operations) = realize(&mut texture);
    assert!(second == first && operations.is_empty());
    assert_eq!(texture.version(), version);
    set(&mut texture, GL_TEXTURE_WRAP_S, GL_CLAMP);
    assert!(realize(&mut texture).1.is_empty() && texture.version() != version);
}

#[test]
fn filters_do_not_redefine_what_suffices() {
    let mut texture = TextureObject::new(GL_TEXTURE_2D);
    image(&mut texture, 0, 2, 2, 1);
    image(&mut texture, 1, 1, 1, 2);
    let first = realize(&mut texture).0.unwrap();
    set(&mut texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    let (second, operations) = realize(&mut texture);
    assert!(operations.is_empty());
    assert_eq!((second.unwrap().image, second.unwrap().levels), (first.image, 1));
    assert_eq!(texture.sampler().mip_linear, None);
    // The other way there is need of a larger one.
    let mut texture = linear(GL_TEXTURE_2D);
    image(&mut texture, 0, 2, 2, 1);
    image(&mut texture, 1, 1, 1, 2);
    assert_eq!(short(&realize(&mut texture).1), ["define 1", "upload 0 0 1"]);
    set(&mut texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    assert_eq!(short(&realize(&mut texture).1), ["define 2", "upload 0 0 1", "upload 1 0 2", "drop"]);
}

#[test]
fn images_again_are_uploaded_or_defined() {
    let mut texture = linear(GL_TEXTURE_2D);
    image(&mut texture, 0, 2, 2, 1);
    realize(&mut texture);
    image(&mut texture, 0, 2, 2, 2);
    assert_eq!(short(&realize(&mut texture).1), ["upload 0 0 2"]);
    image(&mut texture, 0, 4, 2, 3);
    assert_eq!(short(&realize(&mut texture).1), ["define 1", "upload 0 0 3", "drop"]);
}

#[test]
fn parts_are_uploaded_in_order() {
    let mut texture = linear(GL_TEXTURE_2D);
    image(&mut texture, 0, 4, 4, 1);
    // Before the first draw, only memory changes.
    assert!(sub_image(&mut texture, [0, 0, 0], [1, 1, 1], 5).is_empty());
    assert_eq!(short(&realize(&mut texture).1), ["define 1", "upload 0 0 5"]);
    let operations = sub_image(&mut texture, [1, 2, 0], [3, 2, 1], 7);
    let Operation::Upload(upload) = &operations[0] else { panic!("{operations:?}") };
    assert_eq!((upload.region.offset, upload.region.extent), ([1, 2, 0], [3, 2, 1]));
    assert_eq!((operations.len(), upload.texels.len()), (1, 24));
    assert!(realize(&mut texture).1.is_empty());
    // What was recorded before keeps its texels.
    set(&mut texture, GL_TEXTURE_MAX_LEVEL, 0);
    let mut data = [0; 64];
    let level = texture.level_image(0, 0).unwrap();
    level.write(None, (GL_RGBA, GL_UNSIGNED_BYTE), &Packing::tight(), &mut data).unwrap();
    assert_eq!((data[0], data[4], data[4 * 9], data[63]), (5, 1, 7, 7));
}

#[test]
fn parts_must_be_inside() {
    let mut texture = linear(GL_TEXTURE_2D);
    let part = |level, offset, size| SubImage { level, offset, size };
    let try_part = |texture: &mut TextureObject, sub| -> GlResult<()> {
        input(Some(&[0; 64]), |input| texture.tex_sub_image(0, &sub, input, &mut Vec::new()))
    };
    assert_eq!(try_part(&mut texture, part(0, [0; 3], [1; 3])), Err(GL_INVALID_OPERATION));
    image(&mut texture, 0, 4, 4, 0);
    for (sub, result) in [
        (part(0, [1, 0, 0], [4, 1, 1]), Err(GL_INVALID_VALUE)),
        (part(0, [-1, 0, 0], [1, 1, 1]), Err(GL_INVALID_VALUE)),
        (part(0, [0, 0, 0], [-1, 1, 1]), Err(GL_INVALID_VALUE)),
        (part(0, [i32::MAX, 0, 0], [i32::MAX, 1, 1]), Err(GL_INVALID_VALUE)),
        (part(13, [0, 0, 0], [1, 1, 1]), Err(GL_INVALID_VALUE)),
        (part(1, [0, 0, 0], [1, 1, 1]), Err(GL_INVALID_OPERATION)),
        (part(0, [0, 0, 0], [4, 4, 1]), Ok(())),
        (part(0, [4, 4, 0], [0, 0, 1]), Ok(())),
    ] {
        assert_eq!(try_part(&mut texture, sub), result, "{sub:?}");
    }
}

#[test]
fn borders_are_stripped() {
    let mut texture = linear(GL_TEXTURE_2D);
    let data: Vec<u8> = (0..16).flat_map(|texel| [texel, 0, 0, 255]).collect();
    let bordered = ImageDefinition { border: 1, ..definition(0, GL_RGBA, [4, 4, 1]) };
    input(Some(&data), |input| texture.tex_image(0, &bordered, input)).unwrap();
    assert_eq!(texture.level_parameter(0, 0, GL_TEXTURE_WIDTH), Ok(4));
    let (realized, operations) = realize(&mut texture);
    assert_eq!(realized.unwrap().shape.width, 2);
    let Operation::Upload(upload) = &operations[1] else { panic!("{operations:?}") };
    let reds: Vec<u8> = upload.texels.chunks(4).map(|texel| texel[0]).collect();
    assert_eq!(reds, [5, 6, 9, 10]);
    // A row through the border: only its middle is inside.
    let operations = sub_image(&mut texture, [-1, 0, 0], [4, 1, 1], 77);
    let Operation::Upload(upload) = &operations[0] else { panic!("{operations:?}") };
    assert_eq!((upload.region.offset, upload.region.extent), ([0, 0, 0], [2, 1, 1]));
    let mut out = [0; 64];
    let level = texture.level_image(0, 0).unwrap();
    assert_eq!(level.extent(), Extent::plane(4, 4));
    level.write(None, (GL_RED, GL_UNSIGNED_BYTE), &Packing::tight(), &mut out[..16]).unwrap();
    assert_eq!(out[..16], [77, 77, 77, 77, 77, 77, 77, 77, 9, 9, 10, 10, 9, 9, 10, 10]);
}

#[test]
fn definitions_are_checked() {
    let mut texture = linear(GL_TEXTURE_2D);
    let good = definition(0, GL_RGBA, [4, 4, 1]);
    for (bad, error) in [
        (ImageDefinition { level: -1, ..good }, GL_INVALID_VALUE),
        (ImageDefinition { level: 13, ..good }, GL_INVALID_VALUE),
        (ImageDefinition { border: 2, ..good }, GL_INVALID_VALUE),
        (ImageDefinition { size: [4097, 1, 1], ..good }, GL_INVALID_VALUE),
        (ImageDefinition { size: [i32::MAX, i32::MAX, 1], ..good }, GL_INVALID_VALUE),
        (ImageDefinition { size: [-1, 1, 1], ..good }, GL_INVALID_VALUE),
        (ImageDefinition { level: 12, size: [2, 1, 1], ..good }, GL_INVALID_VALUE),
        (ImageDefinition { internal_format: 5, ..good }, GL_INVALID_VALUE),
        (ImageDefinition { internal_format: GL_DEPTH_COMPONENT, ..good }, GL_INVALID_OPERATION),
    ] {
        assert_eq!(input(None, |input| texture.tex_image(0, &bad, input)), Err(error), "{bad:?}");
    }
    let short = input(Some(&[0; 63]), |input| texture.tex_image(0, &good, input));
    assert_eq!(short, Err(GL_INVALID_OPERATION));
    let stencil =
        input(None, |input| texture.tex_image(0, &good, &PixelInput { format: GL_STENCIL_INDEX, ..*input }));
    assert_eq!(stencil, Err(GL_INVALID_ENUM));
    let mut cube = linear(GL_TEXTURE_CUBE_MAP);
    let oblong = definition(0, GL_RGBA, [4, 2, 1]);
    assert_eq!(input(None, |input| cube.tex_image(0, &oblong, input)), Err(GL_INVALID_VALUE));
}

#[test]
fn proxies_answer() {
    let mut proxy = TextureObject::new(GL_TEXTURE_3D);
    let fits = definition(0, GL_LUMINANCE8, [512, 512, 512]);
    proxy.proxy_image(&fits, GL_RGBA, GL_UNSIGNED_BYTE).unwrap();
    assert_eq!(proxy.level_parameter(0, 0, GL_TEXTURE_DEPTH), Ok(512));
    assert_eq!(proxy.level_parameter(0, 0, GL_TEXTURE_LUMINANCE_SIZE), Ok(8));
    let large = ImageDefinition { size: [513, 1, 1], ..fits };
    proxy.proxy_image(&large, GL_RGBA, GL_UNSIGNED_BYTE).unwrap();
    assert_eq!(proxy.level_parameter(0, 0, GL_TEXTURE_DEPTH), Ok(0));
    assert!(proxy_fits(TextureTarget::D3, &fits) && !proxy_fits(TextureTarget::D3, &large));
    assert_eq!(proxy.proxy_image(&fits, GL_RGBA, GL_RGBA), Err(GL_INVALID_ENUM));
}

#[test]
fn undefined_texels_are_zero_and_share_their_memory() {
    let mut texture = linear(GL_TEXTURE_2D);
    let large = definition(0, GL_RGBA, [1024, 600, 1]);
    input(None, |input| texture.tex_image(0, &large, input)).unwrap();
    let (_, operations) = realize(&mut texture);
    assert_eq!(short(&operations), ["define 1", "upload 0 0 0", "upload 0 0 0", "upload 0 0 0"]);
    let (Operation::Upload(a), Operation::Upload(b), Operation::Upload(c)) =
        (&operations[1], &operations[2], &operations[3])
    else {
        panic!("{operations:?}")
    };
    assert!(Arc::ptr_eq(&a.texels, &b.texels));
    assert_eq!((b.region.offset[1], c.region.offset[1], c.region.extent[1]), (256, 512, 88));
    assert_eq!(c.texels.len(), 1024 * 88 * 4);
}

fn copy(texture: &mut TextureObject, face: usize, size: [i32; 3]) -> Vec<Operation> {
    let mut out = Vec::new();
    texture.copy_image(face, &definition(0, GL_RGB, size), AT_ORIGIN, &mut out).unwrap();
    out
}

#[test]
fn copies_define_what_draws_take() {
    let mut texture = linear(GL_TEXTURE_2D);
    let operations = copy(&mut texture, 0, [8, 8, 1]);
    assert_eq!(short(&operations), ["define 1", "copy to 0 0"]);
    let Operation::CopyToImage(first) = &operations[1] else { panic!("{operations:?}") };
    assert_eq!(
        (first.source, first.base_format),
        (Rect { x: 0, y: 0, width: 8, height: 8 }, BaseFormat::Rgb)
    );
    let (realized, operations) = realize(&mut texture);
    assert_eq!((realized.unwrap().image, operations.len()), (first.image, 0));
    // The same again, and a part.
    assert_eq!(short(&copy(&mut texture, 0, [8, 8, 1])), ["copy to 0 0"]);
    assert!(realize(&mut texture).1.is_empty());
    assert_eq!(short(&sub_image(&mut texture, [0; 3], [1; 3], 9)), ["upload 0 0 9"]);
    assert_eq!(texture.content_hash(), None);
    let request = texture.level_image(0, 0).unwrap().request();
    let Some(Request::Texels { image, region }) = request else { panic!("{request:?}") };
    assert_eq!((image, region.extent), (first.image, [8, 8, 1]));
}

#[test]
fn copies_to_levels_of_an_incomplete_texture_are_kept() {
    let mut texture = TextureObject::new(GL_TEXTURE_2D);
    assert_eq!(short(&copy(&mut texture, 0, [2, 2, 1])), ["define 1", "copy to 0 0"]);
    assert!(!is_complete(&mut texture));
    image(&mut texture, 1, 1, 1, 4);
    let (realized, operations) = realize(&mut texture);
    assert!(realized.is_none(), "an RGBA level on an RGB base: {operations:?}");
    input(Some(&[4; 4]), |input| texture.tex_image(0, &definition(1, GL_RGB, [1, 1, 1]), input)).unwrap();
    let (_, operations) = realize(&mut texture);
    assert_eq!(short(&operations), ["define 2", "copy 0 to 0", "upload 1 0 4", "drop"]);
    // With another base level the image is another, and level 0 is kept for later.
    set(&mut texture, GL_TEXTURE_BASE_LEVEL, 1);
    assert_eq!(short(&realize(&mut texture).1), ["define 1", "upload 0 0 4"]);
    set(&mut texture, GL_TEXTURE_BASE_LEVEL, 0);
    assert_eq!(short(&realize(&mut texture).1), ["upload 1 0 4", "drop"]);
}

#[test]
fn a_copied_part_keeps_the_rest() {
    let mut texture = linear(GL_TEXTURE_2D);
    image(&mut texture, 0, 4, 4, 6);
    let mut out = Vec::new();
    let sub = SubImage { level: 0, offset: [2, 2, 0], size: [2, 2, 1] };
    texture.copy_sub_image(0, &sub, CopySource { x: 5, y: -3 }, &mut out).unwrap();
    assert_eq!(short(&out), ["define 1", "upload 0 0 6", "copy to 0 0"]);
    let Operation::CopyToImage(copy) = &out[2] else { panic!("{out:?}") };
    assert_eq!(copy.source, Rect { x: 5, y: -3, width: 2, height: 2 });
    assert!(realize(&mut texture).1.is_empty());
}

#[test]
fn faces_are_copied_into_one_image() {
    let mut texture = linear(GL_TEXTURE_CUBE_MAP);
    for face in 0..6 {
        let operations = short(&copy(&mut texture, face, [4, 4, 1]));
        assert_eq!(operations.len(), if face == 0 { 2 } else { 1 }, "{operations:?}");
        assert_eq!(operations.last(), Some(&format!("copy to 0 {face}")));
    }
    let (realized, operations) = realize(&mut texture);
    assert!(realized.is_some() && operations.is_empty());
}

#[test]
fn copies_refuse_numbers_of_components() {
    let mut texture = linear(GL_TEXTURE_2D);
    let result = texture.copy_image(0, &definition(0, 3, [4, 4, 1]), AT_ORIGIN, &mut Vec::new());
    assert_eq!(result, Err(GL_INVALID_ENUM));
}

#[test]
fn depths_are_copied_and_compared() {
    let mut texture = linear(GL_TEXTURE_2D);
    let mut out = Vec::new();
    let depths = definition(0, GL_DEPTH_COMPONENT24, [4, 4, 1]);
    texture.copy_image(0, &depths, AT_ORIGIN, &mut out).unwrap();
    let shape = realize(&mut texture).0.unwrap().shape;
    assert_eq!((shape.format, shape.base_format), (TexelFormat::Depth32, BaseFormat::Depth));
    assert_eq!(texture.depth_words(), Some((0, 0)));
    set(&mut texture, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE);
    set(&mut texture, GL_DEPTH_TEXTURE_MODE, GL_ALPHA);
    assert_eq!(texture.depth_words(), Some((1 + GL_LEQUAL - GL_NEVER, 2)));
    assert!(texture.sampler().compare.is_some());
    let level = texture.level_image(0, 0).unwrap();
    let mut data = [0; 32];
    let reply = Reply::Depth(vec![1.0; 16]);
    level.write(Some(&reply), (GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT), &Packing::tight(), &mut data).unwrap();
    assert_eq!(data, [0xff; 32]);
    let colors = level.write(None, (GL_RGBA, GL_UNSIGNED_BYTE), &Packing::tight(), &mut data);
    assert_eq!(colors, Err(GL_INVALID_OPERATION));
}

#[test]
fn mipmaps_are_generated_when_needed() {
    let mut texture = TextureObject::new(GL_TEXTURE_2D);
    set(&mut texture, GL_GENERATE_MIPMAP, 1);
    image(&mut texture, 0, 4, 2, 100);
    assert_eq!(texture.level_parameter(0, 2, GL_TEXTURE_WIDTH), Ok(1));
    let uploads = ["upload 0 0 100", "upload 1 0 100", "upload 2 0 100"];
    assert_eq!(short(&realize(&mut texture).1), ["define 3", uploads[0], uploads[1], uploads[2]]);
    // A part of the base is uploaded at once, the derived levels when they are sampled.
    assert_eq!(short(&sub_image(&mut texture, [0, 0, 0], [2, 2, 1], 200)), ["upload 0 0 200"]);
    assert_eq!(short(&realize(&mut texture).1), ["upload 1 0 200", "upload 2 0 150"]);
    // Levels that the program gives afterwards win.
    image(&mut texture, 0, 4, 2, 50);
    image(&mut texture, 2, 1, 1, 1);
    assert_eq!(short(&realize(&mut texture).1), ["upload 0 0 50", "upload 1 0 50", "upload 2 0 1"]);
}

#[test]
fn mipmaps_of_copies_are_done_without() {
    let mut texture = TextureObject::new(GL_TEXTURE_2D);
    set(&mut texture, GL_GENERATE_MIPMAP, 1);
    copy(&mut texture, 0, [4, 4, 1]);
    assert_eq!(realize(&mut texture).0.map(|realized| realized.levels), Some(1));
    assert_eq!(texture.sampler().mip_linear, None);
    image(&mut texture, 0, 4, 4, 9);
    assert_eq!(realize(&mut texture).0.map(|realized| realized.levels), Some(3));
    assert_eq!(texture.sampler().mip_linear, Some(true));
}

#[test]
fn compressed_images() {
    let mut texture = linear(GL_TEXTURE_2D);
    let dxt1 = definition(0, GL_COMPRESSED_RGB_S3TC_DXT1_EXT, [8, 8, 1]);
    let red = [0x00, 0xf8, 0, 0, 0, 0, 0, 0];
    assert_eq!(texture.compressed_image(0, &dxt1, &red), Err(GL_INVALID_VALUE));
    texture.compressed_image(0, &dxt1, &[red; 4].concat()).unwrap();
    assert_eq!(texture.level_parameter(0, 0, GL_TEXTURE_COMPRESSED_IMAGE_SIZE), Ok(32));
    let format = GL_COMPRESSED_RGB_S3TC_DXT1_EXT;
    assert_eq!(texture.level_parameter(0, 0, GL_TEXTURE_INTERNAL_FORMAT), Ok(format as i32));
    assert_eq!(short(&realize(&mut texture).1), ["define 1", "upload 0 0 255"]);
    let blue = [0x1f, 0x00, 0, 0, 0, 0, 0, 0];
    let mut out = Vec::new();
    let sub = |x, y| SubImage { level: 0, offset: [x, y, 0], size: [4, 4, 1] };
    texture.compressed_sub_image(0, &sub(4, 4), format, &blue, &mut out).unwrap();
    assert_eq!(short(&out), ["upload 0 0 0"]);
    assert_eq!(texture.compressed_data(0, 0), Ok(&[red, red, red, blue].concat()[..]));
    let odd = texture.compressed_sub_image(0, &sub(2, 0), format, &blue, &mut out);
    assert_eq!(odd, Err(GL_INVALID_OPERATION));
    // Plain texels make the level a plain one.
    sub_image(&mut texture, [0; 3], [1; 3], 0);
    assert_eq!(texture.compressed_data(0, 0), Err(GL_INVALID_OPERATION));
    assert_eq!(texture.level_parameter(0, 0, GL_TEXTURE_INTERNAL_FORMAT), Ok(GL_RGB as i32));
    let mut line = linear(GL_TEXTURE_1D);
    assert_eq!(line.compressed_image(0, &dxt1, &red), Err(GL_INVALID_ENUM));
}

#[test]
fn luminance_is_read_as_red() {
    let mut texture = linear(GL_TEXTURE_2D);
    let luminance = definition(0, GL_LUMINANCE_ALPHA, [1, 1, 1]);
    input(Some(&[10, 20, 30, 40]), |input| texture.tex_image(0, &luminance, input)).unwrap();
    let mut data = [0; 4];
    let level = texture.level_image(0, 0).unwrap();
    level.write(None, (GL_BGRA, GL_UNSIGNED_BYTE), &Packing::tight(), &mut data).unwrap();
    assert_eq!(data, [0, 0, 10, 40]);
    let undefined = texture.level_image(0, 1).unwrap();
    undefined.write(None, (GL_RGBA, GL_UNSIGNED_BYTE), &Packing::tight(), &mut []).unwrap();
    assert_eq!(texture.level_image(0, 13).err(), Some(GL_INVALID_VALUE));
}

#[test]
fn hashes_tell_contents_apart() {
    let mut a = linear(GL_TEXTURE_2D);
    assert_eq!(a.content_hash(), None);
    image(&mut a, 0, 4, 2, 1);
    let mut b = linear(GL_TEXTURE_2D);
    image(&mut b, 0, 4, 2, 1);
    assert_eq!(a.content_hash(), b.content_hash());
    image(&mut b, 0, 2, 4, 1);
    assert_ne!(a.content_hash(), b.content_hash());
    let before = a.content_hash();
    sub_image(&mut a, [0; 3], [1; 3], 9);
    assert_ne!(a.content_hash(), before);
}

#[test]
fn dropped_textures_drop_their_images() {
    let mut texture = linear(GL_TEXTURE_2D);
    image(&mut texture, 0, 2, 2, 1);
    let first: ImageKey = realize(&mut texture).0.unwrap().image;
    let mut out = Vec::new();
    texture.drop_image(&mut out);
    assert!(matches!(out[..], [Operation::DropImage(key)] if key == first));
    // Used again after all, it comes back.
    assert_eq!(short(&realize(&mut texture).1), ["define 1", "upload 0 0 1"]);
}
