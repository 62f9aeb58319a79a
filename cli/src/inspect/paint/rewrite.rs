//! A frame's draws in flat colours.
//!
//! A draw's texture units are made to pass on a constant colour, and their alpha as before: so the alpha test, and what
//! blending would have left out by alpha, cut the same shapes. All other state that decides which pixels are written
//! stays. Nothing blends: every pixel has the colour of exactly one draw.

use afterglow_gl::frame::{
    BaseFormat, BlendFactor, Clear, CombineFunction, CombineSource, Compare, Dimension, EnvMode, Environment,
    FixedState, Frame, ImageKey, ImageShape, ImageUpload, Operation, Region, Sampler, TexelFormat,
    TextureBinding, UnitWords, Wrap,
};

use super::colors::{BACKGROUND, BESIDE, Pattern, Rgb, Swatch};

/// Fragments that are blended in by less are left out.
const LEAST_ALPHA: f32 = 0.1;

/// A frame that makes an image of one white texel.
pub fn white_texel(image: ImageKey) -> Frame {
    let shape = ImageShape {
        dimension: Dimension::D2,
        width: 1,
        height: 1,
        depth: 1,
        levels: 1,
        format: TexelFormat::Rgba8,
        base_format: BaseFormat::Rgba,
    };
    let region = Region { level: 0, layer: 0, offset: [0; 3], extent: [1; 3] };
    let upload = ImageUpload { image, region, texels: [255; 4].into() };
    let operations = vec![Operation::DefineImage { image, shape }, Operation::Upload(upload)];
    Frame { size: (1, 1), operations, ..Frame::default() }
}

/// Takes the images' ends out of a frame that will be drawn again.
pub fn without_drops(frame: &mut Frame) -> Vec<ImageKey> {
    let mut dropped = Vec::new();
    frame.operations.retain(|operation| match operation {
        Operation::DropImage(image) => {
            dropped.push(*image);
            false
        }
        _ => true,
    });
    dropped
}

/// The draws of a frame with a swatch each, and whatever else decides which pixels they write. It is to be executed
/// after the frame itself, whose images it finds as they were left.
pub fn painted(frame: &Frame, swatches: &[Swatch], white: ImageKey) -> Frame {
    let mut brush = Brush { frame: tables(frame), white };
    brush.frame.operations.push(start());
    let mut swatches = swatches.iter();
    for operation in &frame.operations {
        let operation = match operation {
            Operation::Draw(draw) => {
                let swatch =
                    swatches.next().copied().unwrap_or(Swatch { rgb: BESIDE, pattern: Pattern::Solid });
                let mut draw = *draw;
                let state = [&mut draw.fixed, &mut draw.environment, &mut draw.bindings];
                brush.paint(state, swatch);
                Operation::Draw(draw)
            }
            Operation::Pixels(pixels) => {
                let mut pixels = pixels.clone();
                let state = [&mut pixels.fixed, &mut pixels.environment, &mut pixels.bindings];
                brush.paint(state, Swatch { rgb: BESIDE, pattern: Pattern::Solid });
                Operation::Pixels(pixels)
            }
            Operation::Clear(clear) => {
                Operation::Clear(Clear { color: clear.color.map(|_| opaque(BACKGROUND)), ..*clear })
            }
            Operation::CopyPixels(copy) => Operation::CopyPixels(copy.clone()),
            _ => continue,
        };
        brush.frame.operations.push(operation);
    }
    brush.frame
}

/// What a program may take for granted of the frame before.
fn start() -> Operation {
    Operation::Clear(Clear {
        color: Some(opaque(BACKGROUND)),
        color_mask: 15,
        depth: Some(1.0),
        stencil: Some((0, !0)),
        scissor: None,
    })
}

/// A frame's tables and vertices, without operations.
fn tables(frame: &Frame) -> Frame {
    Frame {
        size: frame.size,
        device: frame.device,
        operations: Vec::with_capacity(frame.operations.len() + 1),
        seams: frame.seams.clone(),
        words: frame.words.clone(),
        indices: frame.indices.clone(),
        retained: frame.retained.clone(),
        fixed: frame.fixed.clone(),
        viewports: frame.viewports.clone(),
        bindings: frame.bindings.clone(),
        transforms: frame.transforms.clone(),
        lights: frame.lights.clone(),
        materials: frame.materials.clone(),
        environments: frame.environments.clone(),
        texgens: frame.texgens.clone(),
        texture_matrices: frame.texture_matrices.clone(),
        clip_planes: frame.clip_planes.clone(),
        current: frame.current.clone(),
        hints: frame.hints.clone(),
        scene_hints: frame.scene_hints.clone(),
    }
}

struct Brush {
    frame: Frame,
    white: ImageKey,
}

impl Brush {
    /// Replaces state, environment and bindings of a draw by such that paint it.
    fn paint(&mut self, [fixed, environment, bindings]: [&mut u32; 3], swatch: Swatch) {
        let FixedState { mut words, mut raster } = self.frame.fixed[*fixed as usize];
        let mut constants = self.frame.environments[*environment as usize];
        if words.units.iter().all(|unit| unit.target() == 0) {
            words.units[0].set_target(1);
            words.units[0].set_base_format(BaseFormat::Rgba as u32);
            let mut textures = self.frame.bindings.get(*bindings as usize).copied().unwrap_or_default();
            textures[0] = Some(TextureBinding { image: self.white, sampler: sampler() });
            *bindings = push(&mut self.frame.bindings, textures);
        }
        words.units.iter_mut().filter(|unit| unit.target() != 0).for_each(pass_constant);
        let global = &mut words.global;
        global.set_fog_mode(0);
        global.set_separate_specular(0);
        global.set_color_sum(0);
        let by_alpha = raster.blend.is_some_and(|blend| blend.rgb.0 == BlendFactor::SourceAlpha);
        if by_alpha && global.alpha_func() == Compare::Always as u32 {
            global.set_alpha_func(Compare::Greater as u32);
            constants.alpha_reference = LEAST_ALPHA;
        }
        if swatch.pattern != Pattern::Solid && global.polygon_stipple() == 0 {
            global.set_polygon_stipple(1);
            constants.polygon_stipple = stipple(swatch.pattern);
        }
        (raster.blend, raster.logic_op) = (None, None);
        color(&mut constants, swatch.rgb);
        *fixed = push(&mut self.frame.fixed, FixedState { words, raster });
        *environment = push(&mut self.frame.environments, constants);
    }
}

fn push<T>(table: &mut Vec<T>, entry: T) -> u32 {
    table.push(entry);
    table.len() as u32 - 1
}

fn opaque(rgb: Rgb) -> [f32; 4] {
    let [r, g, b] = rgb.map(|byte| f32::from(byte) / 255.0);
    [r, g, b, 1.0]
}

/// Sets the colour that units pass on, and keeps the alpha that they may reckon with.
fn color(constants: &mut Environment, rgb: Rgb) {
    let [r, g, b, _] = opaque(rgb);
    for constant in &mut constants.env_color {
        *constant = [r, g, b, constant[3]];
    }
}

/// Bit 31 is the pixel on the left.
fn stipple(pattern: Pattern) -> [u32; 32] {
    std::array::from_fn(|row| match pattern {
        Pattern::Solid => !0,
        Pattern::Hidden => 0,
        Pattern::Checkered => 0x5555_5555 << (row % 2),
        Pattern::Striped => 0x0101_0101 << (row % 8),
    })
}

/// Makes a unit's colour its constant, and its alpha what it was (OpenGL 1.5, tables 3.22 to 3.24).
fn pass_constant(unit: &mut UnitWords) {
    let mode = unit.env_mode();
    unit.set_combine_rgb(CombineFunction::Replace as u32);
    unit.set_source_rgb0(CombineSource::Constant as u32);
    unit.set_operand_rgb0(0);
    unit.set_scale_rgb(0);
    if mode == EnvMode::Combine as u32 {
        return;
    }
    unit.set_env_mode(EnvMode::Combine as u32);
    let keeps_previous = mode == EnvMode::Decal as u32 || !has_alpha(unit);
    let (function, first) = match keeps_previous {
        true => (CombineFunction::Replace, CombineSource::Previous),
        false if mode == EnvMode::Replace as u32 => (CombineFunction::Replace, CombineSource::Texture),
        false => (CombineFunction::Modulate, CombineSource::Previous),
    };
    unit.set_combine_alpha(function as u32);
    unit.set_source_alpha0(first as u32);
    unit.set_source_alpha1(CombineSource::Texture as u32);
    unit.set_operand_alpha0(0);
    unit.set_operand_alpha1(0);
    unit.set_scale_alpha(0);
}

fn has_alpha(unit: &UnitWords) -> bool {
    use BaseFormat as B;
    [B::Alpha, B::LuminanceAlpha, B::Intensity, B::Rgba].iter().any(|&base| base as u32 == unit.base_format())
}

fn sampler() -> Sampler {
    Sampler {
        mag_linear: false,
        min_linear: false,
        mip_linear: None,
        wrap: [Wrap::Repeat; 3],
        min_lod: 0.0.into(),
        max_lod: 0.0.into(),
        border_color: [0.0.into(); 4],
        anisotropy: 1.0.into(),
        compare: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_pass_a_constant_and_keep_their_alpha() {
        let mut unit = UnitWords::default();
        unit.set_target(1);
        unit.set_base_format(BaseFormat::Rgb as u32);
        unit.set_env_mode(EnvMode::Replace as u32);
        pass_constant(&mut unit);
        assert_eq!(unit.source_rgb0(), CombineSource::Constant as u32);
        assert_eq!(unit.source_alpha0(), CombineSource::Previous as u32);
        unit.set_base_format(BaseFormat::Rgba as u32);
        unit.set_env_mode(EnvMode::Modulate as u32);
        pass_constant(&mut unit);
        assert_eq!(unit.combine_alpha(), CombineFunction::Modulate as u32);
        assert_eq!(unit.source_alpha1(), CombineSource::Texture as u32);
    }

    #[test]
    fn patterns_leave_what_they_say() {
        let ones = |pattern| stipple(pattern).iter().map(|row| row.count_ones()).sum::<u32>();
        let patterns = [Pattern::Solid, Pattern::Checkered, Pattern::Striped, Pattern::Hidden];
        assert_eq!(patterns.map(ones), [1024, 512, 128, 0]);
    }
}
