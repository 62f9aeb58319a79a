//! Looks and cells as bytes.

use std::sync::Arc;

use afterglow_gl::frame::{
    Blend, BlendEquation, BlendFactor, Cull, Depth, FixedState, HintMaterial, ImageKey, RasterState,
    RetainedRange, Sampler, StateWords, TEXTURE_UNITS, TextureBinding, VertexLayout, Wrap,
};
use glam::Mat4;

use super::bytes::{COMPARES, Reader, Writer};
use super::cells::Pass;
use super::look::{Look, MAPS, maps};
use super::store::{StoredCell, StoredPass, StoredWorld};

use BlendFactor as F;
const FACTORS: [BlendFactor; 15] = [
    F::Zero,
    F::One,
    F::SourceColor,
    F::OneMinusSourceColor,
    F::DestinationColor,
    F::OneMinusDestinationColor,
    F::SourceAlpha,
    F::OneMinusSourceAlpha,
    F::DestinationAlpha,
    F::OneMinusDestinationAlpha,
    F::SourceAlphaSaturate,
    F::ConstantColor,
    F::OneMinusConstantColor,
    F::ConstantAlpha,
    F::OneMinusConstantAlpha,
];
const EQUATIONS: [BlendEquation; 5] = [
    BlendEquation::Add,
    BlendEquation::Subtract,
    BlendEquation::ReverseSubtract,
    BlendEquation::Min,
    BlendEquation::Max,
];
const CULLS: [Cull; 4] = [Cull::None, Cull::Front, Cull::Back, Cull::FrontAndBack];
const WRAPS: [Wrap; 5] =
    [Wrap::Repeat, Wrap::Clamp, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirroredRepeat];
/// Passes of a cell, at most.
const MOST_PASSES: usize = 16;
/// Bits of a layout: three a slot.
const LAYOUT_BITS: u32 = 27;

/// Writes a world: its ranges once each, then its cells.
pub fn write_world(writer: &mut Writer, world: &StoredWorld) {
    let mut ranges: Vec<&Arc<RetainedRange>> = Vec::new();
    let mut numbers = hashbrown::HashMap::new();
    for range in world.cells.iter().flat_map(|cell| &cell.passes).map(|pass| &pass.pass.range) {
        numbers.entry(range.id()).or_insert_with(|| {
            ranges.push(range);
            ranges.len() - 1
        });
    }
    writer.number(ranges.len());
    for range in ranges {
        writer.put(&range.layout.0);
        writer.words(&range.words);
        writer.words(&range.indices);
    }
    writer.number(world.cells.len());
    for cell in &world.cells {
        writer.put(&cell.model.to_cols_array());
        writer.put(&cell.object);
        writer.put(&[u8::from(cell.baked), u8::from(cell.is_whole)]);
        writer.number(cell.sides.len());
        cell.sides.iter().for_each(|side| writer.put(&u8::from(*side)));
        writer.number(cell.passes.len());
        for StoredPass { pass, contents, map_contents } in &cell.passes {
            writer.number(numbers[&pass.range.id()]);
            writer.put(&[pass.first_index, pass.index_count]);
            write_look(writer, &pass.look, contents);
            write_said(writer, &pass.look.said, map_contents);
        }
    }
}

/// Reads a world.
pub fn read_world(reader: &mut Reader<'_>) -> Option<StoredWorld> {
    let ranges: Option<Vec<_>> = (0..reader.count(12)?).map(|_| read_range(reader)).collect();
    let ranges = ranges?;
    let cells: Option<Vec<_>> = (0..reader.count(64)?).map(|_| read_cell(reader, &ranges)).collect();
    Some(StoredWorld { cells: cells? })
}

fn read_range(reader: &mut Reader<'_>) -> Option<Arc<RetainedRange>> {
    let layout = reader.get::<u32>()?;
    let (words, indices) = (reader.words()?, reader.words()?);
    let layout = VertexLayout(layout & ((1 << LAYOUT_BITS) - 1));
    let vertices = layout.vertices_in(words.len());
    let is_sound = vertices > 0 && indices.iter().all(|index| (*index as usize) < vertices);
    is_sound.then(|| Arc::new(RetainedRange::new(layout, words, indices)))
}

fn read_cell(reader: &mut Reader<'_>, ranges: &[Arc<RetainedRange>]) -> Option<StoredCell> {
    let model = Mat4::from_cols_array(&reader.get()?);
    let (object, baked, is_whole) = (reader.get()?, reader.flag()?, reader.flag()?);
    let sides: Option<Vec<_>> = (0..reader.count(1)?).map(|_| reader.flag()).collect();
    let count = reader.count(64)?;
    let passes: Option<Vec<_>> = (0..count).map(|_| read_pass(reader, ranges)).collect();
    let cell = StoredCell { model, object, baked, is_whole, sides: sides?, passes: passes? };
    let triangles = cell.passes.first()?.pass.index_count / 3;
    let is_sound = count <= MOST_PASSES
        && model.is_finite()
        && cell.passes.iter().all(|pass| pass.pass.index_count == 3 * triangles)
        && cell.sides.len() == if is_whole { 1 } else { triangles as usize };
    is_sound.then_some(cell)
}

fn read_pass(reader: &mut Reader<'_>, ranges: &[Arc<RetainedRange>]) -> Option<StoredPass> {
    let range = ranges.get(reader.get::<u32>()? as usize)?.clone();
    let [first_index, index_count] = reader.get()?;
    let end = (first_index as usize).checked_add(index_count as usize)?;
    let (look, contents) = read_look(reader)?;
    let (said, map_contents) = read_said(reader)?;
    let look = Arc::new(Look { said, ..look });
    let pass = Pass { range, first_index, index_count, look };
    let is_sound = end <= pass.range.indices.len() && index_count > 0;
    is_sound.then_some(StoredPass { pass, contents, map_contents })
}

/// Writes what rays read of a look. `contents` name its images.
fn write_look(writer: &mut Writer, look: &Look, contents: &[u64; TEXTURE_UNITS]) {
    writer.put(&look.fixed.words);
    write_raster(writer, &look.fixed.raster);
    write_bindings(writer, &look.bindings, contents);
    writer.put(&look.material);
    writer.put(&look.environment);
    writer.put(&look.texgen);
    writer.put(&look.texture_matrices);
    writer.put(&look.current);
}

/// A look whose images are not known yet, and what names them.
fn read_look(reader: &mut Reader<'_>) -> Option<(Look, [u64; TEXTURE_UNITS])> {
    let words: StateWords = reader.get()?;
    let raster = read_raster(reader)?;
    let (bindings, contents) = read_bindings(reader)?;
    let look = Look {
        fixed: FixedState { words, raster },
        bindings,
        material: reader.get()?,
        environment: reader.get()?,
        texgen: reader.get()?,
        texture_matrices: reader.get()?,
        current: reader.get()?,
        said: HintMaterial::default(),
    };
    Some((look, contents))
}

fn write_bindings(writer: &mut Writer, bindings: &[Option<TextureBinding>], contents: &[u64]) {
    for (binding, content) in bindings.iter().zip(contents) {
        writer.put(&u8::from(binding.is_some()));
        if let Some(binding) = binding {
            writer.put(content);
            write_sampler(writer, &binding.sampler);
        }
    }
}

/// Bindings of images that are not known yet, and what names them.
fn read_bindings<const N: usize>(reader: &mut Reader<'_>) -> Option<([Option<TextureBinding>; N], [u64; N])> {
    let (mut bindings, mut contents) = ([None; N], [0; N]);
    for (binding, content) in bindings.iter_mut().zip(&mut contents) {
        if reader.flag()? {
            *content = reader.get()?;
            *binding = Some(TextureBinding { image: ImageKey(0), sampler: read_sampler(reader)? });
        }
    }
    Some((bindings, contents))
}

/// Writes what the program says of a material.
fn write_said(writer: &mut Writer, said: &HintMaterial, contents: &[u64; MAPS]) {
    writer.put(&[u8::from(said.roughness_metallic.is_some()), u8::from(said.emission.is_some())]);
    writer.put(&said.roughness_metallic.unwrap_or_default());
    writer.put(&said.emission.unwrap_or_default());
    write_bindings(writer, &maps(said), contents);
}

fn read_said(reader: &mut Reader<'_>) -> Option<(HintMaterial, [u64; MAPS])> {
    let (has_roughness, has_emission) = (reader.flag()?, reader.flag()?);
    let (roughness_metallic, emission): ([f32; 2], [f32; 3]) = (reader.get()?, reader.get()?);
    let ([normal_map, metallic_roughness_map, emission_map], contents) = read_bindings(reader)?;
    let said = HintMaterial {
        roughness_metallic: has_roughness.then_some(roughness_metallic),
        emission: has_emission.then_some(emission),
        base_color: None,
        normal_map,
        metallic_roughness_map,
        emission_map,
    };
    let is_sound = roughness_metallic.iter().all(|value| (0.0..=1.0).contains(value))
        && emission.iter().all(|value| value.is_finite() && *value >= 0.0);
    is_sound.then_some((said, contents))
}

/// Writes what matters to rays, and to what is visible, of the state of rasterization.
fn write_raster(writer: &mut Writer, raster: &RasterState) {
    writer.put(&[raster.color_mask, raster.cull as u8, u8::from(raster.front_ccw)]);
    writer.put(&u8::from(raster.depth.is_some()));
    if let Some(depth) = raster.depth {
        writer.put(&[depth.compare as u8, u8::from(depth.write)]);
    }
    writer.put(&u8::from(raster.blend.is_some()));
    if let Some(Blend { rgb, alpha, equation_rgb, equation_alpha, constant }) = raster.blend {
        writer.put(&[rgb.0, rgb.1, alpha.0, alpha.1].map(|factor| factor as u8));
        writer.put(&[equation_rgb as u8, equation_alpha as u8]);
        constant.into_iter().for_each(|component| writer.float(component));
    }
}

fn read_raster(reader: &mut Reader<'_>) -> Option<RasterState> {
    let mut raster = RasterState {
        color_mask: reader.get()?,
        cull: reader.one_of(&CULLS)?,
        front_ccw: reader.flag()?,
        line_width: 1.0.into(),
        ..RasterState::default()
    };
    if reader.flag()? {
        raster.depth = Some(Depth { compare: reader.one_of(&COMPARES)?, write: reader.flag()? });
    }
    if reader.flag()? {
        let mut pair = || Some((reader.one_of(&FACTORS)?, reader.one_of(&FACTORS)?));
        raster.blend = Some(Blend {
            rgb: pair()?,
            alpha: pair()?,
            equation_rgb: reader.one_of(&EQUATIONS)?,
            equation_alpha: reader.one_of(&EQUATIONS)?,
            constant: [reader.float()?, reader.float()?, reader.float()?, reader.float()?],
        });
    }
    Some(raster)
}

fn write_sampler(writer: &mut Writer, sampler: &Sampler) {
    let mip = sampler.mip_linear.map_or(0, |linear| 1 + u8::from(linear));
    writer.put(&[u8::from(sampler.mag_linear), u8::from(sampler.min_linear), mip]);
    writer.put(&sampler.wrap.map(|wrap| wrap as u8));
    let floats = [sampler.min_lod, sampler.max_lod, sampler.anisotropy];
    floats.into_iter().chain(sampler.border_color).for_each(|float| writer.float(float));
    writer.put(&sampler.compare.map_or(0, |compare| 1 + compare as u8));
}

fn read_sampler(reader: &mut Reader<'_>) -> Option<Sampler> {
    let mag_linear = reader.flag()?;
    let min_linear = reader.flag()?;
    let mip_linear = reader.one_of(&[None, Some(false), Some(true)])?;
    let wrap = [reader.one_of(&WRAPS)?, reader.one_of(&WRAPS)?, reader.one_of(&WRAPS)?];
    let [min_lod, max_lod, anisotropy] = [reader.float()?, reader.float()?, reader.float()?];
    let border_color = [reader.float()?, reader.float()?, reader.float()?, reader.float()?];
    let compare = match reader.get::<u8>()? {
        0 => None,
        number => Some(*COMPARES.get(usize::from(number) - 1)?),
    };
    Some(Sampler {
        mag_linear,
        min_linear,
        mip_linear,
        wrap,
        min_lod,
        max_lod,
        border_color,
        anisotropy,
        compare,
    })
}
