//! What remembered triangles look like: the state that they were drawn with, and where they are.

use std::hash::Hash;
use std::sync::Arc;

use crate::tracking::snapped;
use afterglow_gl::frame::{
    Bindings, CurrentAttributes, Draw, Environment, FixedState, Format, Frame, HintMaterial, ImageKey,
    Material, Slot, TexGen, TextureBinding, TextureMatrices, VertexLayout,
};
use glam::{DMat4, Mat4};
use hashbrown::HashMap;
use xxhash_rust::xxh3::Xxh3;

/// The state of a draw that outlives its frame: copies of the entries of the frame's tables.
#[derive(Debug, Clone, Copy)]
pub struct Look {
    /// What is computed.
    pub fixed: FixedState,
    /// Textures.
    pub bindings: Bindings,
    /// Material.
    pub material: Material,
    /// Constants of texturing, fog, alpha test.
    pub environment: Environment,
    /// Texture generation, planes of eye space as the program gave them then.
    pub texgen: TexGen,
    /// Texture matrices.
    pub texture_matrices: TextureMatrices,
    /// Attributes that vertices lack.
    pub current: CurrentAttributes,
    /// What the program says of the material.
    pub said: HintMaterial,
}

impl Look {
    /// The state of a draw. What its frame's tables lack is zero.
    pub fn of(frame: &Frame, draw: &Draw) -> Option<Look> {
        fn entry<T: bytemuck::Zeroable + Copy>(table: &[T], index: u32) -> T {
            table.get(index as usize).copied().unwrap_or_else(T::zeroed)
        }
        Some(Look {
            fixed: *frame.fixed.get(draw.fixed as usize)?,
            bindings: *frame.bindings.get(draw.bindings as usize)?,
            material: entry(&frame.materials, draw.material),
            environment: entry(&frame.environments, draw.environment),
            texgen: entry(&frame.texgens, draw.texgen),
            texture_matrices: entry(&frame.texture_matrices, draw.texture_matrices),
            current: entry(&frame.current, draw.current),
            said: said(frame, draw),
        })
    }

    /// Whether a draw looks like this now, as far as programs change it to show that something has changed.
    pub fn is_of(&self, frame: &Frame, draw: &Draw) -> bool {
        let is_lit = self.fixed.words.global.lighting() != 0;
        let has_colors = draw.layout.format(Slot::Color as usize) != Format::Absent;
        let material = frame.materials.get(draw.material as usize);
        let current = frame.current.get(draw.current as usize);
        said(frame, draw) == self.said
            && frame.fixed.get(draw.fixed as usize) == Some(&self.fixed)
            && frame.bindings.get(draw.bindings as usize) == Some(&self.bindings)
            && (!is_lit
                || material.is_some_and(|m| bytemuck::bytes_of(m) == bytemuck::bytes_of(&self.material)))
            && (has_colors || current.is_some_and(|current| current.color == self.current.color))
    }

    /// The images that it samples.
    pub fn images(&self) -> impl Iterator<Item = ImageKey> {
        let maps = maps(&self.said).into_iter();
        self.bindings.iter().copied().chain(maps).flatten().map(|binding| binding.image)
    }

    fn hash(&self, hasher: &mut Xxh3) {
        // Written out by `Debug`, for its own hash leaves out what seldom differs.
        hasher.update(format!("{:?}{:?}", self.fixed.raster, self.said).as_bytes());
        self.bindings.hash(hasher);
        hasher.update(bytemuck::bytes_of(&self.fixed.words));
        hasher.update(bytemuck::bytes_of(&self.material));
        hasher.update(bytemuck::bytes_of(&self.environment));
        hasher.update(bytemuck::bytes_of(&self.texgen));
        hasher.update(bytemuck::bytes_of(&self.texture_matrices));
        hasher.update(bytemuck::bytes_of(&self.current));
    }
}

fn said(frame: &Frame, draw: &Draw) -> HintMaterial {
    frame.hint(draw).map(|hint| hint.material).unwrap_or_default()
}

/// Maps of a material.
pub const MAPS: usize = 3;

/// The maps of a material.
pub fn maps(material: &HintMaterial) -> [Option<TextureBinding>; MAPS] {
    [material.normal_map, material.metallic_roughness_map, material.emission_map]
}

/// The same, to be changed.
pub fn maps_mut(material: &mut HintMaterial) -> [&mut Option<TextureBinding>; MAPS] {
    [&mut material.normal_map, &mut material.metallic_roughness_map, &mut material.emission_map]
}

/// What the triangles of a cell have in common.
#[derive(Debug, Clone)]
pub struct Kind {
    /// The surface's own look and those of the layers over it, in order, with the layout of their vertices.
    pub passes: Vec<(Arc<Look>, VertexLayout)>,
    /// Object to world space.
    pub model: Mat4,
    /// Number of the model matrix among the places.
    pub place: u32,
    /// The object that they are of, or 0.
    pub object: u64,
    /// Their colours are baked light.
    pub baked: bool,
}

/// Kinds by number; two that are equal have the same.
#[derive(Debug, Default)]
pub struct Kinds {
    all: Vec<Kind>,
    numbers: HashMap<u64, u32>,
}

impl Kinds {
    /// The number of a kind.
    pub fn number(&mut self, kind: Kind) -> u32 {
        let mut hasher = Xxh3::new();
        for (look, layout) in &kind.passes {
            look.hash(&mut hasher);
            hasher.update(&layout.0.to_le_bytes());
        }
        hasher.update(&kind.place.to_le_bytes());
        hasher.update(&kind.object.to_le_bytes());
        hasher.update(&[u8::from(kind.baked)]);
        *self.numbers.entry(hasher.digest()).or_insert_with(|| {
            self.all.push(kind);
            self.all.len() as u32 - 1
        })
    }

    /// The kind of a number that was given.
    pub fn get(&self, number: u32) -> &Kind {
        &self.all[number as usize]
    }

    /// Takes over where places are now.
    pub fn replace(&mut self, places: &Places) {
        for kind in &mut self.all {
            kind.model = places.model(kind.place);
        }
    }

    /// All kinds, by number.
    pub fn iter(&self) -> impl Iterator<Item = &Kind> {
        self.all.iter()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.all.len()
    }
}

/// How far matrices of one place may lie apart: a share of their entries' size.
const TOLERANCE: f32 = 1e-5;

/// Model matrices by number: those that are the same but for rounding have one.
#[derive(Debug, Default)]
pub struct Places {
    models: Vec<Mat4>,
    by_bits: HashMap<[u32; 16], u32>,
}

impl Places {
    /// The number of a matrix.
    pub fn number(&mut self, model: &Mat4) -> u32 {
        let bits = bits(model);
        if let Some(number) = self.by_bits.get(&bits) {
            return *number;
        }
        let near = self.models.iter().position(|known| is_near(known, model));
        let number = near.unwrap_or_else(|| {
            self.models.push(*model);
            self.models.len() - 1
        }) as u32;
        self.by_bits.insert(bits, number);
        number
    }

    /// The number of a matrix that was looked up before, or of one that is the same but for rounding.
    pub fn find(&self, model: &Mat4) -> Option<u32> {
        let near = || self.models.iter().position(|known| is_near(known, model)).map(|number| number as u32);
        self.by_bits.get(&bits(model)).copied().or_else(near)
    }

    /// Moves all places, which keep their numbers.
    pub fn transform(&mut self, by: DMat4) {
        for model in &mut self.models {
            *model = snapped(by * model.as_dmat4()).as_mat4();
        }
        self.by_bits = (0..).zip(&self.models).map(|(number, model)| (bits(model), number)).collect();
    }

    /// The matrix of a number that was given.
    pub fn model(&self, number: u32) -> Mat4 {
        self.models.get(number as usize).copied().unwrap_or_default()
    }

    /// How many matrices were looked up.
    pub fn len(&self) -> usize {
        self.by_bits.len()
    }
}

/// The bits of a matrix; -0 is +0.
fn bits(model: &Mat4) -> [u32; 16] {
    model.to_cols_array().map(|entry| (entry + 0.0).to_bits())
}

fn is_near(a: &Mat4, b: &Mat4) -> bool {
    let reach = b.w_axis.truncate().abs().max_element().max(1.0);
    let size = [b.x_axis, b.y_axis, b.z_axis].map(|axis| axis.abs().max_element());
    let size = size.into_iter().fold(f32::MIN_POSITIVE, f32::max);
    let linear = [(a.x_axis, b.x_axis), (a.y_axis, b.y_axis), (a.z_axis, b.z_axis)];
    linear.iter().all(|(a, b)| a.abs_diff_eq(*b, TOLERANCE * size))
        && a.w_axis.abs_diff_eq(b.w_axis, TOLERANCE * reach)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn a_place_is_the_same_but_for_rounding() {
        let mut places = Places::default();
        let model = Mat4::from_rotation_y(0.3) * Mat4::from_translation(Vec3::new(1000.0, 2.0, 3.0));
        let first = places.number(&model);
        let rounded = Mat4::from_translation(Vec3::splat(0.004)) * model;
        assert_eq!(places.number(&rounded), first);
        assert_ne!(places.number(&(Mat4::from_translation(Vec3::splat(1.0)) * model)), first);
        assert_ne!(places.number(&(model * Mat4::from_scale(Vec3::splat(1.01)))), first);
    }
}
