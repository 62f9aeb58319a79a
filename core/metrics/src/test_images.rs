//! Pictures by formula, in whole numbers, so that other programs can make the very same ones. All are 64x48.

use crate::image::{Encoding, Image};

const WIDTH: usize = 64;
const HEIGHT: usize = 48;

fn build(encoding: Encoding, value: impl Fn(u64, u64, u64) -> f64) -> Image {
    let pixel = |x, y| std::array::from_fn(|c| value(x as u64, y as u64, c as u64) as f32);
    Image::from_fn(WIDTH, HEIGHT, encoding, pixel).unwrap()
}

fn ramp(x: u64, y: u64, c: u64) -> u64 {
    (x * (3 + c) + y * (5 - c)) % 256
}

/// Slanted ramps with jumps, another slant in each channel.
pub fn stripes() -> Image {
    build(Encoding::Srgb, |x, y, c| ramp(x, y, c) as f64 / 255.0)
}

/// [`stripes`], darker and with a pattern of noise.
pub fn disturbed() -> Image {
    build(Encoding::Srgb, |x, y, c| {
        let noise = (x * y * 7 + c * 31) % 64;
        (ramp(x, y, c) * 9 / 10 + noise).min(255) as f64 / 255.0
    })
}

/// A grid of yellow lines on blue; `column` (0 to 10) is where the upright ones start.
pub fn lines(column: u64) -> Image {
    build(Encoding::Srgb, |x, y, c| {
        let on_line = x % 11 == column || y % 13 == 5;
        let value = if on_line { [230, 200, 40] } else { [60, 60, 120] };
        f64::from(value[c as usize]) / 255.0
    })
}

pub fn constant(rgb: [f32; 3]) -> Image {
    Image::from_fn(WIDTH, HEIGHT, Encoding::Srgb, |_, _| rgb).unwrap()
}

fn rings(x: u64, y: u64, c: u64) -> u64 {
    (x * x + 3 * y * y * (c + 1)) % 1021 + 1
}

/// Fortieths of a noise factor: 32 to 48.
fn noise_of_40(x: u64, y: u64) -> u64 {
    40 + (x * 13 + y * 7) % 17 - 8
}

/// Rings of linear light up to 10.
pub fn hdr() -> Image {
    build(Encoding::Linear, |x, y, c| rings(x, y, c) as f64 / 100.0)
}

/// [`hdr`] with a noise of up to 20 %.
pub fn hdr_noisy() -> Image {
    build(Encoding::Linear, |x, y, c| (rings(x, y, c) * noise_of_40(x, y)) as f64 / 4000.0)
}

/// Rings of linear light over nine decades.
pub fn wide() -> Image {
    build(Encoding::Linear, |x, y, c| rings(x, y, c).pow(3) as f64 / 1e6)
}

/// [`wide`] with a noise of up to 20 %.
pub fn wide_noisy() -> Image {
    build(Encoding::Linear, |x, y, c| (rings(x, y, c).pow(3) * noise_of_40(x, y)) as f64 / 4e7)
}

/// Rings of light in the first `rows` rows, black below; `unit` divides the light.
pub fn mostly_dark(rows: u64, unit: f64) -> Image {
    build(Encoding::Linear, |x, y, c| if y < rows { rings(x, y, c) as f64 / unit } else { 0.0 })
}
