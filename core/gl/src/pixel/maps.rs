//! Tables of glPixelMap (specification, 3.6.3).

use afterglow_api::constants::*;

use super::GlResult;

/// GL_MAX_PIXEL_MAP_TABLE.
pub const MAX_PIXEL_MAP_TABLE: usize = 256;

const MAPS: usize = 10;

/// The ten tables. Their numbers count from GL_PIXEL_MAP_I_TO_I.
#[derive(Debug, Clone, PartialEq)]
pub struct PixelMaps {
    tables: [Vec<f32>; MAPS],
}

impl Default for PixelMaps {
    fn default() -> Self {
        PixelMaps { tables: std::array::from_fn(|_| vec![0.0]) }
    }
}

impl PixelMaps {
    /// glPixelMap. Colours are clamped to [0, 1]; the tables of indices are taken as they are.
    ///
    /// # Errors
    /// GL_INVALID_ENUM for an unknown table; GL_INVALID_VALUE for a bad size: none, more than
    /// [`MAX_PIXEL_MAP_TABLE`], or no power of two where an index selects.
    pub fn set(&mut self, map: u32, values: &[f32]) -> GlResult<()> {
        let which = number(map, GL_PIXEL_MAP_I_TO_I).ok_or(GL_INVALID_ENUM)?;
        let by_index = map <= GL_PIXEL_MAP_I_TO_A;
        let size = values.len();
        if !(1..=MAX_PIXEL_MAP_TABLE).contains(&size) || (by_index && !size.is_power_of_two()) {
            return Err(GL_INVALID_VALUE);
        }
        let to_index = map <= GL_PIXEL_MAP_S_TO_S;
        let stored = |value: &f32| if to_index { *value } else { value.clamp(0.0, 1.0) };
        self.tables[which] = values.iter().map(stored).collect();
        Ok(())
    }

    /// A table.
    ///
    /// # Errors
    /// GL_INVALID_ENUM for an unknown one.
    pub fn get(&self, map: u32) -> GlResult<&[f32]> {
        let which = number(map, GL_PIXEL_MAP_I_TO_I).ok_or(GL_INVALID_ENUM)?;
        Ok(&self.tables[which])
    }

    /// Size of a table by the name that glGet has for it (GL_PIXEL_MAP_I_TO_I_SIZE and so on).
    pub fn size(&self, pname: u32) -> Option<usize> {
        number(pname, GL_PIXEL_MAP_I_TO_I_SIZE).map(|which| self.tables[which].len())
    }

    /// What stands in the table for a component, which is clamped to [0, 1].
    pub(super) fn component(&self, map: u32, value: f32) -> f32 {
        let table = self.table(map);
        let last = (table.len() - 1) as f32;
        let index = (value.clamp(0.0, 1.0) * last).round() as usize;
        table.get(index).copied().unwrap_or(0.0)
    }

    /// What stands in the table for an index, which is taken modulo the table's size.
    pub(super) fn index(&self, map: u32, index: i64) -> f32 {
        let table = self.table(map);
        table[index.rem_euclid(table.len() as i64) as usize]
    }

    fn table(&self, map: u32) -> &[f32] {
        // Only called with the names of this file's tables, which are never empty.
        &self.tables[number(map, GL_PIXEL_MAP_I_TO_I).unwrap_or(0)]
    }
}

fn number(name: u32, first: u32) -> Option<usize> {
    name.checked_sub(first).map(|number| number as usize).filter(|number| *number < MAPS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        let mut maps = PixelMaps::default();
        assert_eq!(maps.set(GL_PIXEL_MAP_I_TO_R, &[0.0; 3]), Err(GL_INVALID_VALUE));
        assert_eq!(maps.set(GL_PIXEL_MAP_R_TO_R, &[0.0; 3]), Ok(()));
        assert_eq!(maps.set(GL_PIXEL_MAP_R_TO_R, &[]), Err(GL_INVALID_VALUE));
        assert_eq!(maps.set(GL_PIXEL_MAP_R_TO_R, &[0.0; 257]), Err(GL_INVALID_VALUE));
        assert_eq!(maps.set(GL_RGBA, &[0.0]), Err(GL_INVALID_ENUM));
        assert_eq!(maps.size(GL_PIXEL_MAP_R_TO_R_SIZE), Some(3));
        assert_eq!(maps.size(GL_PIXEL_MAP_A_TO_A_SIZE), Some(1));
        assert_eq!(maps.size(GL_PIXEL_MAP_A_TO_A_SIZE + 1), None);
    }

    #[test]
    fn looks_up() {
        let mut maps = PixelMaps::default();
        maps.set(GL_PIXEL_MAP_G_TO_G, &[1.0, 0.25, 7.0]).unwrap();
        maps.set(GL_PIXEL_MAP_S_TO_S, &[3.0, 9.0]).unwrap();
        assert_eq!(maps.component(GL_PIXEL_MAP_G_TO_G, 0.6), 0.25);
        assert_eq!(maps.component(GL_PIXEL_MAP_G_TO_G, 9.0), 1.0);
        assert_eq!(maps.component(GL_PIXEL_MAP_G_TO_G, f32::NAN), 1.0);
        assert_eq!(maps.index(GL_PIXEL_MAP_S_TO_S, 5), 9.0);
        assert_eq!(maps.index(GL_PIXEL_MAP_S_TO_S, -2), 3.0);
    }
}
