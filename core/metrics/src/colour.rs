//! Colour spaces: the sRGB curve, CIE XYZ, CIELAB and its linear relative YCxCz.

/// Rows of the matrix from linear sRGB to CIE XYZ (IEC 61966-2-1 primaries, D65 at x = 0.3127, y = 0.3290).
const XYZ_FROM_RGB: [[f32; 3]; 3] = [
    [0.412_390_8, 0.357_584_33, 0.180_480_8],
    [0.212_639, 0.715_168_65, 0.072_192_32],
    [0.019_330_818, 0.119_194_78, 0.950_532_14],
];

/// Inverse of [`XYZ_FROM_RGB`].
const RGB_FROM_XYZ: [[f32; 3]; 3] = [
    [3.240_97, -1.537_383_2, -0.498_610_76],
    [-0.969_243_65, 1.875_967_5, 0.041_555_06],
    [0.055_630_08, -0.203_976_96, 1.056_971_5],
];

/// XYZ of linear RGB (1, 1, 1): the rows' sums.
const WHITE: [f32; 3] = [0.950_455_9, 1.0, 1.089_057_8];

/// Display value 0..1 to linear light (IEC 61966-2-1); below 0 the straight part goes on.
pub fn srgb_to_linear(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// Linear light to display value (IEC 61966-2-1), unclamped.
pub fn linear_to_srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Relative luminance (Rec. 709) of linear RGB.
pub fn luminance(linear: [f32; 3]) -> f64 {
    0.2126 * f64::from(linear[0]) + 0.7152 * f64::from(linear[1]) + 0.0722 * f64::from(linear[2])
}

fn transform(matrix: &[[f32; 3]; 3], v: [f32; 3]) -> [f32; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

fn xyz_over_white(linear: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = transform(&XYZ_FROM_RGB, linear);
    [x / WHITE[0], y / WHITE[1], z / WHITE[2]]
}

/// Linear RGB to YCxCz, CIELAB without its cube root (Flohr et al. 1993): linear, so that it may be filtered.
pub(crate) fn linear_to_ycxcz(linear: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = xyz_over_white(linear);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

pub(crate) fn ycxcz_to_linear([y, cx, cz]: [f32; 3]) -> [f32; 3] {
    let y = (y + 16.0) / 116.0;
    let x = y + cx / 500.0;
    let z = y - cz / 200.0;
    transform(&RGB_FROM_XYZ, [x * WHITE[0], y * WHITE[1], z * WHITE[2]])
}

/// Linear RGB to CIELAB (CIE 15) under D65.
pub(crate) fn linear_to_lab(linear: [f32; 3]) -> [f32; 3] {
    const DELTA: f32 = 6.0 / 29.0;
    let [x, y, z] = xyz_over_white(linear)
        .map(|t| if t > DELTA * DELTA * DELTA { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: [f32; 3], b: [f32; 3], tolerance: f32) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < tolerance)
    }

    #[test]
    fn srgb_curve_inverts_itself_over_all_bytes() {
        for byte in 0..=255u8 {
            let encoded = f32::from(byte) / 255.0;
            assert!((linear_to_srgb(srgb_to_linear(encoded)) - encoded).abs() < 1e-6);
        }
        assert!((srgb_to_linear(0.5) - 0.214_041_14).abs() < 1e-6);
    }

    #[test]
    fn lab_of_known_colours() {
        assert!(close(linear_to_lab([1.0; 3]), [100.0, 0.0, 0.0], 1e-3));
        // The sRGB primaries in CIELAB, D65, as commonly tabulated.
        assert!(close(linear_to_lab([1.0, 0.0, 0.0]), [53.24, 80.09, 67.20], 0.02));
        assert!(close(linear_to_lab([0.0, 0.0, 1.0]), [32.30, 79.19, -107.86], 0.02));
    }

    #[test]
    fn ycxcz_inverts_and_has_white_at_hundred() {
        assert!(close(linear_to_ycxcz([1.0; 3]), [100.0, 0.0, 0.0], 1e-4));
        let colour = [0.2, 0.9, 0.05];
        assert!(close(ycxcz_to_linear(linear_to_ycxcz(colour)), colour, 1e-5));
    }

    #[test]
    fn luminance_weighs_to_one() {
        assert!((luminance([1.0; 3]) - 1.0).abs() < 1e-12);
    }
}
