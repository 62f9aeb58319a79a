//! Edges and points, which an observer notices beyond their contrast (section 4.2 of the FLIP paper).

use crate::convolve::Plane;

/// Width of a feature in degrees of visual angle (section 4.2).
const FEATURE_WIDTH: f64 = 0.082;

/// Strength of edges and points at every pixel.
pub(super) struct Features {
    pub edges: Vec<f32>,
    pub points: Vec<f32>,
}

impl Features {
    /// Of the achromatic plane, scaled so that black is 0 and white 1.
    pub fn of(achromatic: &Plane, pixels_per_degree: f64) -> Self {
        let Taps { gauss, slope, curvature } = Taps::new(pixels_per_degree);
        let smooth = achromatic.along_rows(&gauss);
        let strength = |along_x: Plane, along_y: Plane| {
            let pairs = along_x.values.iter().zip(&along_y.values);
            pairs.map(|(x, y)| (x * x + y * y).sqrt()).collect()
        };
        Self {
            edges: strength(
                achromatic.along_rows(&slope).along_columns(&gauss),
                smooth.along_columns(&slope),
            ),
            points: strength(
                achromatic.along_rows(&curvature).along_columns(&gauss),
                smooth.along_columns(&curvature),
            ),
        }
    }
}

/// A Gaussian, and its first and second derivative.
struct Taps {
    gauss: Vec<f32>,
    slope: Vec<f32>,
    curvature: Vec<f32>,
}

impl Taps {
    fn new(pixels_per_degree: f64) -> Self {
        let sigma = 0.5 * FEATURE_WIDTH * pixels_per_degree;
        let radius = (3.0 * sigma).ceil() as i32;
        let sampled = |weight: &dyn Fn(f64) -> f64| -> Vec<f64> {
            let positions = (-radius..=radius).map(f64::from);
            positions.map(|x| weight(x) * (-x * x / (2.0 * sigma * sigma)).exp()).collect()
        };
        Self {
            gauss: unit_parts(&sampled(&|_| 1.0)),
            slope: unit_parts(&sampled(&|x| -x)),
            curvature: unit_parts(&sampled(&|x| x * x / (sigma * sigma) - 1.0)),
        }
    }
}

/// Scales the positive taps so that they sum to 1, and the negative ones to -1.
fn unit_parts(taps: &[f64]) -> Vec<f32> {
    let positive: f64 = taps.iter().filter(|t| **t > 0.0).sum();
    let negative: f64 = -taps.iter().filter(|t| **t < 0.0).sum::<f64>();
    let scale = |t: f64| if t > 0.0 { t / positive } else { t / negative };
    taps.iter().map(|&t| if t == 0.0 { 0.0 } else { scale(t) as f32 }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_has_no_features() {
        let plane = Plane { width: 20, values: vec![0.7; 400] };
        let features = Features::of(&plane, 67.0);
        assert!(features.edges.iter().chain(&features.points).all(|f| f.abs() < 1e-5));
    }

    #[test]
    fn a_step_is_an_edge_of_its_height() {
        let values = (0..40 * 40).map(|i| if i % 40 < 20 { 0.0 } else { 0.5 });
        let plane = Plane { width: 40, values: values.collect() };
        let strongest = Features::of(&plane, 67.0).edges.into_iter().fold(0.0, f32::max);
        assert!((strongest - 0.5).abs() < 1e-4, "{strongest}");
    }
}
