//! Random commands on a texture, against a plain model of what each texel must be. The operations that come
//! out are executed by a device that is as plain, and which refuses what a real one could not do.

use std::collections::HashMap;

use afterglow_api::constants::*;
use proptest::prelude::*;

use super::*;
use crate::context::Params;
use crate::frame::{ImageKey, ImageShape, Operation, Region};
use crate::params::Values;
use crate::pixel::{Packing, PixelTransfer};

const LEVELS: usize = 4;

/// One value a texel; all components of a texel are alike.
type Plane = Vec<u8>;

#[derive(Debug, Clone)]
enum Step {
    Image { face: usize, level: usize, size: (i32, i32), value: Option<u8> },
    Part { face: usize, level: usize, offset: (i32, i32), size: (i32, i32), value: u8 },
    Copy { face: usize, level: usize, size: (i32, i32) },
    CopyPart { face: usize, level: usize, offset: (i32, i32), size: (i32, i32) },
    Parameter { pname: u32, value: u32 },
    Draw,
}

fn step() -> impl Strategy<Value = Step> {
    let face = prop::sample::select(vec![0usize, 0, 0, 1, 2, 3, 4, 5]);
    let level = prop::sample::select(vec![0usize, 0, 1, 2, 3]);
    let size = prop::sample::select(vec![(8, 8), (4, 4), (2, 2), (1, 1), (8, 2), (3, 3)]);
    let offset = (0i32..4, 0i32..4);
    let parameter = prop::sample::select(vec![
        (GL_TEXTURE_MIN_FILTER, GL_LINEAR),
        (GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR),
        (GL_TEXTURE_BASE_LEVEL, 0),
        (GL_TEXTURE_BASE_LEVEL, 1),
        (GL_TEXTURE_MAX_LEVEL, 0),
        (GL_TEXTURE_MAX_LEVEL, 1),
        (GL_TEXTURE_MAX_LEVEL, 1000),
    ]);
    let place = (face, level, offset, size);
    prop_oneof![
        (place.clone(), any::<Option<u8>>()).prop_map(|((face, level, _, size), value)| Step::Image {
            face,
            level,
            size,
            value
        }),
        (place.clone(), any::<u8>()).prop_map(|((face, level, offset, size), value)| Step::Part {
            face,
            level,
            offset,
            size,
            value
        }),
        place.clone().prop_map(|(face, level, _, size)| Step::Copy { face, level, size }),
        place.prop_map(|(face, level, offset, size)| Step::CopyPart { face, level, offset, size }),
        parameter.prop_map(|(pname, value)| Step::Parameter { pname, value }),
        Just(Step::Draw),
    ]
}

/// What the program has specified.
#[derive(Default)]
struct Model {
    levels: HashMap<(usize, usize), ((i32, i32), Plane)>,
}

impl Model {
    fn define(&mut self, at: (usize, usize), size: (i32, i32), value: u8) {
        self.levels.insert(at, (size, vec![value; (size.0 * size.1) as usize]));
    }

    /// `false` if there is no such part.
    fn fill(&mut self, at: (usize, usize), offset: (i32, i32), size: (i32, i32), value: u8) -> bool {
        let Some((whole, plane)) = self.levels.get_mut(&at) else { return false };
        if offset.0 + size.0 > whole.0 || offset.1 + size.1 > whole.1 {
            return false;
        }
        for y in offset.1..offset.1 + size.1 {
            let line = y * whole.0;
            plane[(line + offset.0) as usize..(line + offset.0 + size.0) as usize].fill(value);
        }
        true
    }
}

/// By layer and level; `None` where a texel was never written.
type Levels = HashMap<(u32, u32), Vec<Option<u8>>>;

/// Images by name.
#[derive(Default)]
struct Device {
    images: HashMap<ImageKey, (ImageShape, Levels)>,
}

impl Device {
    fn execute(&mut self, operations: &[Operation], copied: u8) {
        for operation in operations {
            match operation {
                Operation::DefineImage { image, shape } => {
                    assert!(self.images.insert(*image, (*shape, HashMap::new())).is_none());
                }
                Operation::DropImage(image) => assert!(self.images.remove(image).is_some()),
                Operation::Upload(upload) => {
                    let texels: Vec<_> = upload.texels.chunks_exact(4).map(|texel| Some(texel[0])).collect();
                    self.write(upload.image, upload.region, &texels);
                }
                Operation::CopyToImage(copy) => {
                    let texels = (copy.region.extent[0] * copy.region.extent[1]) as usize;
                    assert_eq!(copy.base_format, self.images[&copy.image].0.base_format);
                    self.write(copy.image, copy.region, &vec![Some(copied); texels]);
                }
                Operation::CopyImage { from, region, to, to_level } => {
                    let texels = self.level(*from, region.layer, region.level);
                    self.write(*to, Region { level: *to_level, ..*region }, &texels);
                }
                other => panic!("{other:?}"),
            }
        }
    }

    fn size(&self, image: ImageKey, level: u32) -> [u32; 2] {
        let shape = self.images[&image].0;
        assert!(level < shape.levels);
        [shape.width, shape.height].map(|side| (side >> level).max(1))
    }

    fn level(&self, image: ImageKey, layer: u32, level: u32) -> Vec<Option<u8>> {
        let [width, height] = self.size(image, level);
        let texels = self.images[&image].1.get(&(layer, level)).cloned();
        texels.unwrap_or_else(|| vec![None; (width * height) as usize])
    }

    fn write(&mut self, image: ImageKey, region: Region, texels: &[Option<u8>]) {
        let [width, height] = self.size(image, region.level);
        let ([x, y, _], [columns, rows, _]) = (region.offset, region.extent);
        assert!(x + columns <= width && y + rows <= height, "{region:?}");
        let mut level = self.level(image, region.layer, region.level);
        for (row, texels) in texels.chunks_exact(columns as usize).enumerate() {
            let start = ((y + row as u32) * width + x) as usize;
            level[start..start + columns as usize].copy_from_slice(texels);
        }
        assert_eq!(texels.len() as u32, columns * rows);
        let levels = self.images.get_mut(&image).map(|(_, levels)| levels);
        levels.unwrap().insert((region.layer, region.level), level);
    }
}

struct Run {
    texture: TextureObject,
    model: Model,
    device: Device,
    copies: u8,
}

impl Run {
    fn new(target: u32) -> Run {
        let texture = TextureObject::new(target);
        Run { texture, model: Model::default(), device: Device::default(), copies: 0 }
    }

    /// All steps, a last draw, and the end.
    fn all(&mut self, steps: &[Step], faces: usize) {
        steps.iter().chain([&Step::Draw]).for_each(|step| self.step(step, faces));
        let mut out = Vec::new();
        self.texture.drop_image(&mut out);
        self.device.execute(&out, 0);
        assert!(self.device.images.is_empty());
    }

    fn step(&mut self, step: &Step, faces: usize) {
        let (packing, transfer) = (Packing::tight(), PixelTransfer::default());
        let data = vec![0; 4 * 64];
        let input = PixelInput {
            format: GL_RGBA,
            kind: GL_UNSIGNED_BYTE,
            data: None,
            packing: &packing,
            transfer: &transfer,
        };
        let definition = |level: usize, size: (i32, i32)| ImageDefinition {
            level: level as i32,
            internal_format: GL_RGBA,
            size: [size.0, size.1, 1],
            border: 0,
        };
        let part = |level: usize, offset: (i32, i32), size: (i32, i32)| SubImage {
            level: level as i32,
            offset: [offset.0, offset.1, 0],
            size: [size.0, size.1, 1],
        };
        let filled = |value: u8| data.iter().map(|_| value).collect::<Vec<u8>>();
        let mut out = Vec::new();
        self.copies = self.copies.wrapping_add(1);
        let corner = CopySource { x: 0, y: 0 };
        match *step {
            Step::Image { face, level, size, value } => {
                let texels = value.map(filled);
                let input = PixelInput { data: texels.as_deref(), ..input };
                if self.texture.tex_image(face % faces, &definition(level, size), &input).is_ok() {
                    self.model.define((face % faces, level), size, value.unwrap_or(0));
                }
            }
            Step::Part { face, level, offset, size, value } => {
                let texels = filled(value);
                let input = PixelInput { data: Some(&texels), ..input };
                let result =
                    self.texture.tex_sub_image(face % faces, &part(level, offset, size), &input, &mut out);
                let expected = self.model.fill((face % faces, level), offset, size, value);
                assert_eq!(result.is_ok(), expected);
            }
            Step::Copy { face, level, size } => {
                if self.texture.copy_image(face % faces, &definition(level, size), corner, &mut out).is_ok() {
                    self.model.define((face % faces, level), size, self.copies);
                }
            }
            Step::CopyPart { face, level, offset, size } => {
                let result =
                    self.texture.copy_sub_image(face % faces, &part(level, offset, size), corner, &mut out);
                let expected = self.model.fill((face % faces, level), offset, size, self.copies);
                assert_eq!(result.is_ok(), expected);
            }
            Step::Parameter { pname, value } => {
                self.texture.set_parameter(pname, &Values::new(Params::Ints(&[value as i32]))).unwrap();
            }
            Step::Draw => self.draw(faces),
        }
        self.device.execute(&out, self.copies);
    }

    /// Every level that is sampled is on the device as the model has it.
    fn draw(&mut self, faces: usize) {
        let mut out = Vec::new();
        let realized = self.texture.realize(&mut out);
        self.device.execute(&out, 0);
        let Some(realized) = realized else { return };
        assert_eq!(self.device.images[&realized.image].0, realized.shape);
        let base = self.texture.parameters().base_level;
        for (face, step) in (0..faces).flat_map(|face| (0..realized.levels).map(move |step| (face, step))) {
            let (size, plane) = &self.model.levels[&(face, base + step)];
            let expected: Vec<Option<u8>> = plane.iter().map(|texel| Some(*texel)).collect();
            let found = self.device.level(realized.image, face as u32, step as u32);
            assert_eq!(
                (found, [size.0, size.1]),
                (expected, self.device.size(realized.image, step as u32).map(|n| n as i32))
            );
        }
        assert!(self.device.images.len() <= 1 + LEVELS * faces);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, ..ProptestConfig::default() })]

    #[test]
    fn planes_are_as_specified(steps in prop::collection::vec(step(), 1..40)) {
        let mut run = Run::new(GL_TEXTURE_2D);
        run.all(&steps, 1);
    }

    #[test]
    fn cube_maps_are_as_specified(steps in prop::collection::vec(step(), 1..40)) {
        let mut run = Run::new(GL_TEXTURE_CUBE_MAP);
        for face in 0..6 {
            run.step(&Step::Image { face, level: 0, size: (2, 2), value: Some(face as u8) }, 6);
        }
        run.all(&steps, 6);
    }
}
