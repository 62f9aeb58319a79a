//! Mipmaps of pictures that have none: each texel is the mean of those below it.

use std::sync::LazyLock;

use half::f16;

use crate::picture::{Format, all_levels, level_side};

/// What a mean is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Averaging {
    /// Light that sRGB encodes, weighted by alpha: what is clear has no colour.
    Color,
    /// Light that sRGB encodes; alpha is something else.
    Emission,
    /// Values as they are.
    Plain,
}

/// Adds all levels below the first one, whose size this is.
pub(crate) fn add(
    levels: &mut Vec<Vec<u8>>,
    [width, height]: [u32; 2],
    format: Format,
    averaging: Averaging,
) {
    for level in 1..all_levels(width, height) {
        let above = [level_side(width, level - 1), level_side(height, level - 1)];
        let Some(texels) = levels.last() else { return };
        let next = match format {
            Format::Rgba16F => halved::<8>(texels, above, averaging, from_halves, to_halves),
            _ => halved::<4>(texels, above, averaging, from_bytes, to_bytes),
        };
        levels.push(next);
    }
}

/// A level from the one above it, of this size. `N` is the bytes of a texel; `read` and `write` know whether colours are
/// encoded.
fn halved<const N: usize>(
    texels: &[u8],
    [width, height]: [u32; 2],
    averaging: Averaging,
    read: fn([u8; N], bool) -> [f32; 4],
    write: fn([f32; 4], bool) -> [u8; N],
) -> Vec<u8> {
    let (texels, _) = texels.as_chunks::<N>();
    let is_encoded = averaging != Averaging::Plain;
    let (across, down) = (level_side(width, 1), level_side(height, 1));
    let mut below = Vec::with_capacity(across as usize * down as usize * N);
    for y in 0..down {
        for x in 0..across {
            let at = |dx: u32, dy: u32| {
                let (x, y) = ((2 * x + dx).min(width - 1), (2 * y + dy).min(height - 1));
                read(texels[y as usize * width as usize + x as usize], is_encoded)
            };
            let four = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
            below.extend(write(mean(&four, averaging == Averaging::Color), is_encoded));
        }
    }
    below
}

fn mean(texels: &[[f32; 4]; 4], by_alpha: bool) -> [f32; 4] {
    let alpha: f32 = texels.iter().map(|texel| texel[3]).sum();
    let is_weighted = by_alpha && alpha > 0.0;
    let total = if is_weighted { alpha } else { 4.0 };
    let mut mean = [0.0, 0.0, 0.0, alpha / 4.0];
    for texel in texels {
        let weight = if is_weighted { texel[3] } else { 1.0 } / total;
        for channel in 0..3 {
            mean[channel] += weight * texel[channel];
        }
    }
    mean
}

fn from_bytes([r, g, b, a]: [u8; 4], is_encoded: bool) -> [f32; 4] {
    static LINEAR: LazyLock<[f32; 256]> =
        LazyLock::new(|| std::array::from_fn(|byte| linear_from_srgb(byte as f32 / 255.0)));
    let unit = |byte: u8| f32::from(byte) / 255.0;
    let color = |byte: u8| if is_encoded { LINEAR[usize::from(byte)] } else { unit(byte) };
    [color(r), color(g), color(b), unit(a)]
}

fn to_bytes([r, g, b, a]: [f32; 4], is_encoded: bool) -> [u8; 4] {
    /// Encoded bytes by linear light in 16 bits.
    static ENCODED: LazyLock<Vec<u8>> = LazyLock::new(|| {
        (0..=u16::MAX).map(|step| byte(srgb_from_linear(f32::from(step) / f32::from(u16::MAX)))).collect()
    });
    let color = |value: f32| match is_encoded {
        true => ENCODED[(value.clamp(0.0, 1.0) * f32::from(u16::MAX) + 0.5) as usize],
        false => byte(value),
    };
    [color(r), color(g), color(b), byte(a)]
}

fn byte(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

fn from_halves(texel: [u8; 8], is_encoded: bool) -> [f32; 4] {
    let [r, g, b, a]: [f32; 4] = bytemuck::cast::<_, [f16; 4]>(texel).map(f16::to_f32);
    let color = |value: f32| if is_encoded { linear_from_srgb(value) } else { value };
    [color(r), color(g), color(b), a]
}

fn to_halves([r, g, b, a]: [f32; 4], is_encoded: bool) -> [u8; 8] {
    let color = |value: f32| f16::from_f32(if is_encoded { srgb_from_linear(value) } else { value });
    bytemuck::cast([color(r), color(g), color(b), f16::from_f32(a)])
}

/// The sRGB curve (IEC 61966-2-1), beyond 1 as well.
fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// Its inverse.
pub(crate) fn srgb_from_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mipmaps(texels: &[[u8; 4]], size: [u32; 2], averaging: Averaging) -> Vec<Vec<u8>> {
        let mut levels = vec![texels.concat()];
        add(&mut levels, size, Format::Rgba8, averaging);
        levels
    }

    #[test]
    fn light_is_averaged_and_what_is_clear_has_no_colour() {
        let white_and_black = [[255; 4], [0, 0, 0, 255]];
        assert_eq!(mipmaps(&white_and_black, [2, 1], Averaging::Color)[1], [188, 188, 188, 255]);
        assert_eq!(mipmaps(&white_and_black, [2, 1], Averaging::Plain)[1], [128, 128, 128, 255]);
        let half_clear = [[255, 255, 255, 255], [0; 4]];
        assert_eq!(mipmaps(&half_clear, [2, 1], Averaging::Color)[1], [255, 255, 255, 128]);
        assert_eq!(mipmaps(&half_clear, [2, 1], Averaging::Emission)[1], [188, 188, 188, 128]);
    }

    #[test]
    fn sides_are_halved_down_to_one() {
        let levels = mipmaps(&[[9; 4]; 15], [5, 3], Averaging::Color);
        assert_eq!(levels.iter().map(Vec::len).collect::<Vec<_>>(), [60, 8, 4]);
        assert!(levels.iter().flatten().all(|byte| *byte == 9));
    }

    #[test]
    fn bytes_survive_the_curve() {
        for value in 0..=255 {
            let texel = [value, value, value, value];
            assert_eq!(to_bytes(from_bytes(texel, true), true), texel);
            assert_eq!(to_bytes(from_bytes(texel, false), false), texel);
        }
    }

    #[test]
    fn halves_are_averaged_as_light() {
        let texel = |value: f32| to_halves([value, value, value, 1.0], true);
        let mut levels = vec![[texel(8.0), texel(0.0)].concat()];
        add(&mut levels, [2, 1], Format::Rgba16F, Averaging::Emission);
        let [r, ..] = from_halves(levels[1][..].try_into().unwrap(), true);
        assert!((r - 4.0).abs() < 0.02, "{r}");
    }
}
