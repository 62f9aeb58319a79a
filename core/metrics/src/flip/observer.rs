//! One picture as it is perceived, and the difference of two.

use rayon::prelude::*;

use super::contrast;
use super::features::Features;
use crate::colour::{linear_to_lab, linear_to_ycxcz, ycxcz_to_linear};
use crate::convolve::Plane;
use crate::image::is_finite;

/// Exponent of the colour difference, before and after redistribution (section 4.1.3 of the FLIP paper).
const COLOUR_EXPONENT: f32 = 0.7;
/// Share of the largest colour difference below which differences are stretched, and where that share lands.
const STRETCHED_SHARE: f32 = 0.4;
const STRETCHED_TO: f32 = 0.95;
/// Exponent of the feature difference (section 4.2).
const FEATURE_EXPONENT: f32 = 0.5;

/// A picture after contrast sensitivity: Hunt-adjusted CIELAB, and the strength of its features.
pub(super) struct Perceived {
    lab: Vec<[f32; 3]>,
    features: Features,
}

impl Perceived {
    /// Of linear light, clamped to 0..1; pixels that are NaN or infinite are seen as black.
    pub fn new(linear: &[[f32; 3]], width: usize, pixels_per_degree: f64) -> Self {
        let opponent = opponent_planes(linear, width);
        let features = Features::of(&scaled_achromatic(&opponent[0]), pixels_per_degree);
        let [y, cx, cz] = contrast::filter(&opponent, pixels_per_degree);
        let lab = (0..linear.len()).into_par_iter().map(|i| {
            let seen = ycxcz_to_linear([y.values[i], cx.values[i], cz.values[i]]);
            hunt_adjusted(linear_to_lab(seen.map(|v| v.clamp(0.0, 1.0))))
        });
        Self { lab: lab.collect(), features }
    }
}

/// FLIP error of every pixel (sections 4.1.3 to 4.3).
pub(super) fn perceived_difference(a: &Perceived, b: &Perceived) -> Vec<f32> {
    let largest = largest_colour_difference();
    let at = |i: usize| {
        let colour = redistributed(hyab(a.lab[i], b.lab[i]).powf(COLOUR_EXPONENT), largest);
        let edge = (a.features.edges[i] - b.features.edges[i]).abs();
        let point = (a.features.points[i] - b.features.points[i]).abs();
        let feature = (edge.max(point) * std::f32::consts::FRAC_1_SQRT_2).powf(FEATURE_EXPONENT);
        colour.powf(1.0 - feature.min(1.0))
    };
    (0..a.lab.len()).into_par_iter().map(at).collect()
}

fn opponent_planes(linear: &[[f32; 3]], width: usize) -> [Plane; 3] {
    let opponent: Vec<_> = linear
        .par_iter()
        .map(|&pixel| {
            let visible = if is_finite(pixel) { pixel } else { [0.0; 3] };
            linear_to_ycxcz(visible.map(|v| v.clamp(0.0, 1.0)))
        })
        .collect();
    std::array::from_fn(|channel| Plane { width, values: opponent.iter().map(|p| p[channel]).collect() })
}

fn scaled_achromatic(y: &Plane) -> Plane {
    Plane { width: y.width, values: y.values.iter().map(|y| (y + 16.0) / 116.0).collect() }
}

/// Colours look less colourful in the dark (Hunt 1952).
fn hunt_adjusted([l, a, b]: [f32; 3]) -> [f32; 3] {
    [l, 0.01 * l * a, 0.01 * l * b]
}

/// The HyAB distance for large colour differences (Abasi et al. 2020).
fn hyab(p: [f32; 3], q: [f32; 3]) -> f32 {
    (p[0] - q[0]).abs() + ((p[1] - q[1]).powi(2) + (p[2] - q[2]).powi(2)).sqrt()
}

/// Green against blue, the farthest pair of display colours.
fn largest_colour_difference() -> f32 {
    let seen = |linear| hunt_adjusted(linear_to_lab(linear));
    hyab(seen([0.0, 1.0, 0.0]), seen([0.0, 0.0, 1.0])).powf(COLOUR_EXPONENT)
}

/// To 0..1: two straight pieces that meet at (share of the largest, [`STRETCHED_TO`]).
fn redistributed(difference: f32, largest: f32) -> f32 {
    let knee = STRETCHED_SHARE * largest;
    if difference < knee {
        difference * STRETCHED_TO / knee
    } else {
        let above = (difference - knee) / (largest - knee);
        (STRETCHED_TO + above * (1.0 - STRETCHED_TO)).min(1.0)
    }
}
