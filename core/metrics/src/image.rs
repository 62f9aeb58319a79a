//! The picture type: three `f32` a pixel, and whether they are light or display values.

use std::borrow::Cow;

use rayon::prelude::*;
use serde::Serialize;

use crate::colour::{linear_to_srgb, luminance, srgb_to_linear};
use crate::error::{FormatError, MetricsError};

/// Longest side that is accepted, in pixels.
pub const MAX_SIDE: usize = 1 << 15;
/// Most pixels that are accepted: 8192 x 4096, 384 MiB as [`Image`].
pub const MAX_PIXELS: usize = 1 << 25;

/// What the numbers of a picture mean. The primaries are those of sRGB / Rec. 709 in both cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Encoding {
    /// Radiance in arbitrary units: no exposure, no curve, no upper bound.
    Linear,
    /// Display values, sRGB-encoded, 0 to 1.
    Srgb,
}

/// A picture of RGB `f32` pixels, row after row, row 0 on top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: usize,
    height: usize,
    encoding: Encoding,
    pixels: Vec<[f32; 3]>,
}

impl Image {
    /// # Errors
    /// If the size is empty or beyond [`MAX_SIDE`] or [`MAX_PIXELS`], or `pixels` does not hold `width * height` pixels.
    pub fn new(
        width: usize,
        height: usize,
        encoding: Encoding,
        pixels: Vec<[f32; 3]>,
    ) -> Result<Self, FormatError> {
        let count = checked_pixel_count(width, height)?;
        if pixels.len() != count {
            return Err(FormatError::PixelCount { width, height, got: pixels.len() });
        }
        Ok(Self { width, height, encoding, pixels })
    }

    /// Asks `pixel(x, y)` for every pixel, row after row.
    ///
    /// # Errors
    /// As [`Image::new`].
    pub fn from_fn(
        width: usize,
        height: usize,
        encoding: Encoding,
        mut pixel: impl FnMut(usize, usize) -> [f32; 3],
    ) -> Result<Self, FormatError> {
        let mut pixels = Vec::with_capacity(checked_pixel_count(width, height)?);
        for y in 0..height {
            pixels.extend((0..width).map(|x| pixel(x, y)));
        }
        Self::new(width, height, encoding, pixels)
    }

    /// An sRGB picture from 8-bit RGBA as a window shows it; alpha is dropped.
    ///
    /// # Errors
    /// As [`Image::new`]; `rgba` must hold `4 * width * height` bytes.
    pub fn from_rgba8(width: usize, height: usize, rgba: &[u8]) -> Result<Self, FormatError> {
        let (texels, rest) = rgba.as_chunks::<4>();
        if !rest.is_empty() {
            return Err(FormatError::PixelCount { width, height, got: texels.len() });
        }
        let pixels = texels.iter().map(|t| [unit_from_u8(t[0]), unit_from_u8(t[1]), unit_from_u8(t[2])]);
        Self::new(width, height, Encoding::Srgb, pixels.collect())
    }

    pub fn width(&self) -> usize {
        self.width
    }

    pub fn height(&self) -> usize {
        self.height
    }

    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }

    pub fn pixels_mut(&mut self) -> &mut [[f32; 3]] {
        &mut self.pixels
    }

    /// Pixel at column `x` and row `y`, row 0 on top.
    ///
    /// # Panics
    /// If the pixel is outside of the picture.
    pub fn pixel(&self, x: usize, y: usize) -> [f32; 3] {
        assert!(x < self.width, "column {x} of {}", self.width);
        self.pixels[y * self.width + x]
    }

    /// Some of the pixels, as one row of any length: for what does not ask where pixels are.
    pub(crate) fn only(&self, kept: &[bool]) -> Self {
        let pixels = self.pixels.iter().zip(kept).filter(|(_, kept)| **kept).map(|(pixel, _)| *pixel);
        let pixels: Vec<_> = pixels.collect();
        Self { width: pixels.len(), height: 1, encoding: self.encoding, pixels }
    }

    /// The picture as linear light; borrowed if it is already.
    pub fn to_linear(&self) -> Cow<'_, Image> {
        match self.encoding {
            Encoding::Linear => Cow::Borrowed(self),
            Encoding::Srgb => Cow::Owned(self.mapped(Encoding::Linear, srgb_to_linear)),
        }
    }

    /// The picture as display values, clamped to 0..1 (NaN stays NaN); borrowed if it is already.
    pub fn to_srgb(&self) -> Cow<'_, Image> {
        match self.encoding {
            Encoding::Srgb => Cow::Borrowed(self),
            Encoding::Linear => {
                Cow::Owned(self.mapped(Encoding::Srgb, |v| linear_to_srgb(v.clamp(0.0, 1.0))))
            }
        }
    }

    /// Three bytes a pixel, sRGB-encoded, rounded to nearest; NaN becomes 0.
    pub fn to_rgb8(&self) -> Vec<u8> {
        let srgb = self.to_srgb();
        let bytes = srgb.pixels.iter().flatten();
        bytes.map(|v| (v * 255.0).round() as u8).collect()
    }

    /// The picture as a PNG of 8 bits a channel would give it back.
    pub fn rounded_to_8_bits(&self) -> Image {
        let bytes = self.to_rgb8();
        let (texels, _) = bytes.as_chunks::<3>();
        Image {
            width: self.width,
            height: self.height,
            encoding: Encoding::Srgb,
            pixels: texels.iter().map(|t| t.map(unit_from_u8)).collect(),
        }
    }

    /// Relative luminance (Rec. 709) of every pixel of the linear picture.
    pub fn luminances(&self) -> Vec<f64> {
        let linear = self.to_linear();
        linear.pixels.iter().map(|&p| luminance(p)).collect()
    }

    /// How many pixels have a channel that is NaN or infinite.
    pub fn non_finite_count(&self) -> u64 {
        self.pixels.iter().filter(|p| !is_finite(**p)).count() as u64
    }

    /// # Errors
    /// If `other` has another size; `what` names it in the message.
    pub(crate) fn expect_same_size(&self, other: &Image, what: &'static str) -> Result<(), MetricsError> {
        if (self.width, self.height) == (other.width, other.height) {
            return Ok(());
        }
        Err(MetricsError::SizeMismatch {
            what,
            width: self.width,
            height: self.height,
            got_width: other.width,
            got_height: other.height,
        })
    }

    fn mapped(&self, encoding: Encoding, f: impl Fn(f32) -> f32 + Sync) -> Image {
        Image {
            width: self.width,
            height: self.height,
            encoding,
            pixels: self.pixels.par_iter().map(|p| p.map(&f)).collect(),
        }
    }
}

pub(crate) fn is_finite(pixel: [f32; 3]) -> bool {
    pixel.iter().all(|v| v.is_finite())
}

pub(crate) fn unit_from_u8(byte: u8) -> f32 {
    f32::from(byte) / 255.0
}

/// # Errors
/// If a picture of this size is empty or refused as too large.
pub(crate) fn checked_pixel_count(width: usize, height: usize) -> Result<usize, FormatError> {
    if width == 0 || height == 0 {
        return Err(FormatError::Empty { width, height });
    }
    // Sides are bounded first, so the product cannot overflow.
    if width > MAX_SIDE || height > MAX_SIDE || width * height > MAX_PIXELS {
        return Err(FormatError::TooLarge { width, height });
    }
    Ok(width * height)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_checked() {
        let new = |w, h, n| Image::new(w, h, Encoding::Linear, vec![[0.0; 3]; n]);
        assert!(new(2, 3, 6).is_ok());
        assert!(matches!(new(2, 3, 5), Err(FormatError::PixelCount { got: 5, .. })));
        assert!(matches!(new(0, 3, 0), Err(FormatError::Empty { .. })));
        assert!(matches!(new(usize::MAX, 2, 0), Err(FormatError::TooLarge { .. })));
        assert!(matches!(new(MAX_SIDE, MAX_SIDE, 0), Err(FormatError::TooLarge { .. })));
    }

    #[test]
    fn encodings_convert_both_ways() {
        let linear = Image::from_fn(2, 1, Encoding::Linear, |x, _| [0.5, 7.0, x as f32 - 0.5]).unwrap();
        let srgb = linear.to_srgb();
        assert_eq!(srgb.encoding(), Encoding::Srgb);
        // 1.055 * 0.5^(1/2.4) - 0.055
        assert!((srgb.pixel(0, 0)[0] - 0.735_357).abs() < 1e-5);
        assert!((srgb.pixel(0, 0)[1] - 1.0).abs() < 1e-6);
        assert_eq!(srgb.pixel(0, 0)[2], 0.0);
        assert!((srgb.to_linear().pixel(1, 0)[2] - 0.5).abs() < 1e-6);
    }

    #[test]
    fn eight_bits_round_to_nearest() {
        let image = Image::new(1, 1, Encoding::Srgb, vec![[0.5, 254.6 / 255.0, f32::NAN]]).unwrap();
        assert_eq!(image.to_rgb8(), [128, 255, 0]);
        assert_eq!(image.rounded_to_8_bits().pixel(0, 0), [128.0 / 255.0, 1.0, 0.0]);
    }

    #[test]
    fn rgba8_drops_alpha_and_checks_length() {
        let image = Image::from_rgba8(1, 2, &[255, 0, 51, 9, 1, 2, 3, 4]).unwrap();
        assert_eq!(image.pixel(0, 0), [1.0, 0.0, 0.2]);
        assert!(Image::from_rgba8(1, 2, &[0; 7]).is_err());
        assert!(Image::from_rgba8(1, 2, &[0; 12]).is_err());
    }

    #[test]
    fn non_finite_pixels_are_counted_once_each() {
        let pixels = vec![[f32::NAN, f32::INFINITY, 0.0], [1.0; 3], [0.0, 0.0, f32::NEG_INFINITY]];
        let image = Image::new(3, 1, Encoding::Linear, pixels).unwrap();
        assert_eq!(image.non_finite_count(), 2);
    }
}
