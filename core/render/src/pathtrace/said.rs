//! What a program says of its surfaces' material, as records that shaders read.

use afterglow_gl::frame::{Draw, Frame, HintMaterial, TextureBinding};
use afterglow_records::{NO_MAP, SurfaceDraw};

/// A material that the program says, its maps as shaders name them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SaidMaterial {
    said: HintMaterial,
    normal_map: u32,
    metallic_roughness_map: u32,
    emission_map: u32,
}

impl SaidMaterial {
    /// What is said of a draw. `word` names an image as shaders do.
    pub(crate) fn of<E>(
        frame: &Frame,
        draw: &Draw,
        mut word: impl FnMut(&TextureBinding) -> Result<u32, E>,
    ) -> Result<Self, E> {
        let said = frame.hint(draw).map(|hint| hint.material).unwrap_or_default();
        let mut map = |map: Option<TextureBinding>| map.map_or(Ok(NO_MAP), |map| word(&map));
        Ok(Self {
            said,
            normal_map: map(said.normal_map)?,
            metallic_roughness_map: map(said.metallic_roughness_map)?,
            emission_map: map(said.emission_map)?,
        })
    }

    /// The record with what is said. A map without a value that it varies varies 1.
    pub(crate) fn write(&self, record: SurfaceDraw) -> SurfaceDraw {
        let without = |map: u32, absent: f32| if map == NO_MAP { absent } else { 1.0 };
        let roughness = without(self.metallic_roughness_map, record.roughness);
        let metallic = without(self.metallic_roughness_map, record.metallic);
        let said = self.said.roughness_metallic.map(|said| said.map(|value| sound(value, 1.0)));
        let [roughness, metallic] = said.unwrap_or([roughness, metallic]);
        let base_color = self.said.base_color.map(|color| color.map(|channel| sound(channel, f32::MAX)));
        let emission = self.said.emission.map(|emission| emission.map(|channel| sound(channel, f32::MAX)));
        SurfaceDraw {
            base_color: base_color.unwrap_or([-1.0; 3]),
            emission: emission.unwrap_or([without(self.emission_map, 0.0); 3]),
            roughness,
            metallic,
            normal_map: self.normal_map,
            metallic_roughness_map: self.metallic_roughness_map,
            emission_map: self.emission_map,
            ..record
        }
    }
}

/// From 0 to `most`; what is no number is 0.
fn sound(value: f32, most: f32) -> f32 {
    if value > 0.0 { value.min(most) } else { 0.0 }
}
