//! Pixel transfer: scale, bias, shift, offset and tables (specification, 3.6.5).

use afterglow_api::constants::*;

use super::GlResult;
use super::maps::PixelMaps;
use super::rows::Color;

/// glPixelTransfer's state, which glPushAttrib saves; the tables it does not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransferModes {
    /// Factors of red, green, blue, alpha.
    pub scale: Color,
    /// Summands of red, green, blue, alpha.
    pub bias: Color,
    /// Factor of depth.
    pub depth_scale: f32,
    /// Summand of depth.
    pub depth_bias: f32,
    /// Bits that indices are shifted left, or right if negative.
    pub index_shift: i32,
    /// What is added to shifted indices.
    pub index_offset: i32,
    /// GL_MAP_COLOR.
    pub map_color: bool,
    /// GL_MAP_STENCIL.
    pub map_stencil: bool,
}

impl Default for TransferModes {
    fn default() -> Self {
        TransferModes {
            scale: [1.0; 4],
            bias: [0.0; 4],
            depth_scale: 1.0,
            depth_bias: 0.0,
            index_shift: 0,
            index_offset: 0,
            map_color: false,
            map_stencil: false,
        }
    }
}

impl TransferModes {
    /// glPixelTransfer.
    ///
    /// # Errors
    /// GL_INVALID_ENUM for an unknown name.
    pub fn set(&mut self, pname: u32, value: f32) -> GlResult<()> {
        match pname {
            GL_MAP_COLOR => self.map_color = value != 0.0,
            GL_MAP_STENCIL => self.map_stencil = value != 0.0,
            GL_INDEX_SHIFT => self.index_shift = value.round() as i32,
            GL_INDEX_OFFSET => self.index_offset = value.round() as i32,
            GL_RED_SCALE => self.scale[0] = value,
            GL_GREEN_SCALE => self.scale[1] = value,
            GL_BLUE_SCALE => self.scale[2] = value,
            GL_ALPHA_SCALE => self.scale[3] = value,
            GL_RED_BIAS => self.bias[0] = value,
            GL_GREEN_BIAS => self.bias[1] = value,
            GL_BLUE_BIAS => self.bias[2] = value,
            GL_ALPHA_BIAS => self.bias[3] = value,
            GL_DEPTH_SCALE => self.depth_scale = value,
            GL_DEPTH_BIAS => self.depth_bias = value,
            _ => return Err(GL_INVALID_ENUM),
        }
        Ok(())
    }

    /// The parameter as glGet tells it, if it is one of glPixelTransfer's.
    pub fn get(&self, pname: u32) -> Option<f32> {
        Some(match pname {
            GL_MAP_COLOR => f32::from(u8::from(self.map_color)),
            GL_MAP_STENCIL => f32::from(u8::from(self.map_stencil)),
            GL_INDEX_SHIFT => self.index_shift as f32,
            GL_INDEX_OFFSET => self.index_offset as f32,
            GL_RED_SCALE => self.scale[0],
            GL_GREEN_SCALE => self.scale[1],
            GL_BLUE_SCALE => self.scale[2],
            GL_ALPHA_SCALE => self.scale[3],
            GL_RED_BIAS => self.bias[0],
            GL_GREEN_BIAS => self.bias[1],
            GL_BLUE_BIAS => self.bias[2],
            GL_ALPHA_BIAS => self.bias[3],
            GL_DEPTH_SCALE => self.depth_scale,
            GL_DEPTH_BIAS => self.depth_bias,
            _ => return None,
        })
    }

    /// Colours pass unchanged.
    pub fn keeps_colors(&self) -> bool {
        self.scale == [1.0; 4] && self.bias == [0.0; 4] && !self.map_color
    }
}

/// All that happens to pixels between memory and the buffers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PixelTransfer {
    /// glPixelTransfer.
    pub modes: TransferModes,
    /// glPixelMap.
    pub maps: PixelMaps,
}

impl PixelTransfer {
    /// Scale, bias and, if enabled, tables.
    pub(super) fn color(&self, color: Color) -> Color {
        let modes = &self.modes;
        let scaled: Color = std::array::from_fn(|i| color[i] * modes.scale[i] + modes.bias[i]);
        if !modes.map_color {
            return scaled;
        }
        let map = |i: usize| self.maps.component(GL_PIXEL_MAP_R_TO_R + i as u32, scaled[i]);
        std::array::from_fn(map)
    }

    /// Scale and bias, clamped to [0, 1].
    pub(super) fn depth(&self, depth: f32) -> f32 {
        (depth * self.modes.depth_scale + self.modes.depth_bias).clamp(0.0, 1.0)
    }

    /// Shift and offset.
    pub(super) fn index(&self, index: i64) -> i64 {
        let shift = self.modes.index_shift.unsigned_abs();
        let shifted = match self.modes.index_shift {
            0.. => index.checked_shl(shift).unwrap_or(0),
            _ => index.checked_shr(shift).unwrap_or(0),
        };
        shifted.wrapping_add(self.modes.index_offset.into())
    }

    /// The colour that an index stands for, after shift and offset.
    pub(super) fn index_to_color(&self, index: i64) -> Color {
        let index = self.index(index);
        std::array::from_fn(|i| self.maps.index(GL_PIXEL_MAP_I_TO_R + i as u32, index))
    }

    /// A stencil index after shift, offset and, if enabled, the table.
    pub(super) fn stencil(&self, index: i64) -> i64 {
        let index = self.index(index);
        if !self.modes.map_stencil {
            return index;
        }
        self.maps.index(GL_PIXEL_MAP_S_TO_S, index) as i64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names() {
        let mut modes = TransferModes::default();
        assert!(modes.keeps_colors());
        for (i, pname) in
            [GL_RED_SCALE, GL_ALPHA_BIAS, GL_DEPTH_BIAS, GL_INDEX_SHIFT, GL_MAP_COLOR].into_iter().enumerate()
        {
            let value = if pname == GL_MAP_COLOR { 1.0 } else { 2.0 + i as f32 };
            modes.set(pname, value).unwrap();
            assert_eq!(modes.get(pname), Some(value));
        }
        assert_eq!((modes.scale[0], modes.bias[3], modes.index_shift), (2.0, 3.0, 5));
        assert_eq!(modes.set(GL_RGBA, 0.0), Err(GL_INVALID_ENUM));
        assert!(!modes.keeps_colors());
    }

    #[test]
    fn indices() {
        let mut transfer = PixelTransfer::default();
        (transfer.modes.index_shift, transfer.modes.index_offset) = (2, 1);
        assert_eq!(transfer.stencil(3), 13);
        transfer.modes.index_shift = -1;
        assert_eq!(transfer.stencil(3), 2);
        transfer.modes.index_shift = i32::MIN;
        assert_eq!(transfer.stencil(3), 1);
        transfer.modes.map_stencil = true;
        transfer.maps.set(GL_PIXEL_MAP_S_TO_S, &[5.0, 6.0]).unwrap();
        assert_eq!(transfer.stencil(3), 6);
    }

    #[test]
    fn colors() {
        let mut transfer = PixelTransfer::default();
        transfer.modes.scale = [2.0, 1.0, 1.0, 0.5];
        transfer.modes.bias[1] = -0.25;
        assert_eq!(transfer.color([0.25, 0.5, 1.0, 1.0]), [0.5, 0.25, 1.0, 0.5]);
        transfer.modes.map_color = true;
        transfer.maps.set(GL_PIXEL_MAP_R_TO_R, &[1.0, 0.0]).unwrap();
        assert_eq!(transfer.color([0.0, 0.5, 1.0, 1.0]), [1.0, 0.0, 0.0, 0.0]);
    }
}
