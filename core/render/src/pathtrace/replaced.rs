//! Maps that replace what a surface is made of, as records that shaders read.

use afterglow_gl::frame::{Draw, Frame};
use afterglow_gpu::GpuError;
use afterglow_images::{Channels, Role};
use afterglow_records::{MapWord, NO_MAP, SurfaceDraw};

use crate::bindings::{Lookup, replacement_word};
use crate::replacements::Replacements;

/// Roughness of what has a metal map and no roughness from anywhere.
const MATTE: f32 = 1.0;

/// A draw's maps: those of the first unit whose texture has any.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ReplacedMaps {
    normal: Option<u32>,
    emission: Option<u32>,
    word: MapWord,
}

impl ReplacedMaps {
    /// Whether a draw has any.
    pub(crate) fn are_there(replacements: Option<&Replacements>, frame: &Frame, draw: &Draw) -> bool {
        let bindings = frame.bindings.get(draw.bindings as usize).into_iter().flatten().flatten();
        let has = |image| {
            let get = |role| replacements.and_then(|replacements| replacements.get(image, role));
            get(Role::Normal).or(get(Role::Emission)).is_some()
        };
        bindings.into_iter().any(|binding| has(binding.image))
    }

    /// Those of a draw.
    pub(crate) fn of(lookup: &mut Lookup<'_>, draw: &Draw) -> Result<Self, GpuError> {
        let bindings = lookup.frame.bindings.get(draw.bindings as usize).into_iter().flatten();
        for (unit, binding) in (0..).zip(bindings) {
            let Some(binding) = binding else { continue };
            let normal = replacement_word(lookup, binding, Role::Normal)?;
            let emission = replacement_word(lookup, binding, Role::Emission)?;
            if normal.or(emission).is_none() {
                continue;
            }
            let channels = |role| {
                let found =
                    lookup.replacements.and_then(|replacements| replacements.get(binding.image, role));
                found.map(|found| found.channels)
            };
            let mut word = MapWord::default();
            word.set_unit(unit);
            word.set_metal_in_normal((channels(Role::Normal) == Some(Channels::Rgba)).into());
            word.set_roughness_in_emission((channels(Role::Emission) == Some(Channels::Rgba)).into());
            word.set_normal_of_two((channels(Role::Normal) == Some(Channels::Two)).into());
            return Ok(Self { normal, emission, word });
        }
        Ok(Self { normal: None, emission: None, word: MapWord::default() })
    }

    /// The record with these maps in place of those that it has.
    pub(crate) fn write(&self, record: SurfaceDraw) -> SurfaceDraw {
        if self.normal.or(self.emission).is_none() {
            return record;
        }
        let says_roughness = self.word.roughness_in_emission() != 0;
        let says_metal = self.word.metal_in_normal() != 0;
        let is_said = record.roughness >= 0.0;
        SurfaceDraw {
            emission: if self.emission.is_some() { [1.0; 3] } else { record.emission },
            emission_map: self.emission.unwrap_or(record.emission_map),
            normal_map: self.normal.unwrap_or(record.normal_map),
            roughness: match (says_roughness, says_metal && !is_said) {
                (true, _) => 1.0,
                (false, true) => MATTE,
                (false, false) => record.roughness,
            },
            metallic: match (says_metal, says_roughness && !is_said) {
                (true, _) => 1.0,
                (false, true) => 0.0,
                (false, false) => record.metallic,
            },
            metallic_roughness_map: match says_roughness && says_metal {
                true => NO_MAP,
                false => record.metallic_roughness_map,
            },
            maps: self.word.0[0],
            ..record
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    fn unsaid() -> SurfaceDraw {
        SurfaceDraw {
            roughness: -1.0,
            normal_map: NO_MAP,
            metallic_roughness_map: NO_MAP,
            emission_map: NO_MAP,
            ..SurfaceDraw::zeroed()
        }
    }

    fn maps(normal: Option<u32>, emission: Option<u32>, with_alpha: bool) -> ReplacedMaps {
        let mut word = MapWord::default();
        word.set_metal_in_normal((normal.is_some() && with_alpha).into());
        word.set_roughness_in_emission((emission.is_some() && with_alpha).into());
        ReplacedMaps { normal, emission, word }
    }

    #[test]
    fn nothing_changes_without_maps() {
        let said = SurfaceDraw { roughness: 0.3, emission_map: 5, ..unsaid() };
        assert_eq!(bytemuck::bytes_of(&maps(None, None, true).write(said)), bytemuck::bytes_of(&said));
    }

    #[test]
    fn a_normal_map_alone_says_nothing_of_the_material_unless_it_has_metal() {
        let plain = maps(Some(7), None, false).write(unsaid());
        assert_eq!((plain.normal_map, plain.roughness), (7, -1.0));
        let metal = maps(Some(7), None, true).write(unsaid());
        assert_eq!((metal.roughness, metal.metallic), (MATTE, 1.0));
    }

    #[test]
    fn an_emission_map_shines_as_it_is() {
        let shining = maps(None, Some(3), true).write(unsaid());
        assert_eq!((shining.emission, shining.emission_map), ([1.0; 3], 3));
        assert_eq!((shining.roughness, shining.metallic), (1.0, 0.0));
        let plain = maps(None, Some(3), false).write(unsaid());
        assert_eq!(plain.roughness, -1.0);
    }

    #[test]
    fn what_the_program_says_stays_where_files_say_nothing() {
        let said = SurfaceDraw { roughness: 0.3, metallic: 0.8, metallic_roughness_map: 9, ..unsaid() };
        let with_normal = maps(Some(7), None, true).write(said);
        assert_eq!((with_normal.roughness, with_normal.metallic), (0.3, 1.0));
        assert_eq!(with_normal.metallic_roughness_map, 9);
        let with_both = maps(Some(7), Some(3), true).write(said);
        assert_eq!((with_both.roughness, with_both.metallic_roughness_map), (1.0, NO_MAP));
    }
}
