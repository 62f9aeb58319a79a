//! What the eye resolves: contrast sensitivity functions of the three opponent channels, as Gaussians over visual angle
//! (section 4.1.1 of the FLIP paper).

use std::f64::consts::PI;

use crate::convolve::Plane;

/// a exp(-pi^2 d^2 / b) sqrt(pi / b) at d degrees: one term of a sensitivity's point spread.
#[derive(Clone, Copy)]
struct Term {
    a: f64,
    b: f64,
}

/// Sensitivities of the achromatic, red-green and blue-yellow channels (table 1 of the FLIP paper).
const ACHROMATIC: [Term; 1] = [Term { a: 1.0, b: 0.0047 }];
const RED_GREEN: [Term; 1] = [Term { a: 1.0, b: 0.0053 }];
const BLUE_YELLOW: [Term; 2] = [Term { a: 34.1, b: 0.04 }, Term { a: 13.5, b: 0.025 }];
/// The widest term: its reach sets the window of all channels.
const WIDEST_B: f64 = 0.04;

/// A separable Gaussian and its part of the channel's whole kernel.
struct Kernel {
    taps: Vec<f32>,
    share: f32,
}

/// Filters the planes Y, Cx and Cz in place of the eye.
pub(super) fn filter(planes: &[Plane; 3], pixels_per_degree: f64) -> [Plane; 3] {
    let [y, cx, cz] = planes;
    [
        apply(y, &kernels(&ACHROMATIC, pixels_per_degree)),
        apply(cx, &kernels(&RED_GREEN, pixels_per_degree)),
        apply(cz, &kernels(&BLUE_YELLOW, pixels_per_degree)),
    ]
}

fn apply(plane: &Plane, kernels: &[Kernel]) -> Plane {
    let mut sum = Plane { width: plane.width, values: vec![0.0; plane.values.len()] };
    for kernel in kernels {
        let filtered = plane.along_rows(&kernel.taps).along_columns(&kernel.taps);
        sum.add_scaled(&filtered, kernel.share);
    }
    sum
}

fn kernels(terms: &[Term], pixels_per_degree: f64) -> Vec<Kernel> {
    let radius = (3.0 * (WIDEST_B / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as i32;
    let sampled = terms.iter().map(|term| {
        let at = |pixel: i32| {
            let degrees = f64::from(pixel) / pixels_per_degree;
            (-PI * PI * degrees * degrees / term.b).exp()
        };
        let taps: Vec<f64> = (-radius..=radius).map(at).collect();
        let sum: f64 = taps.iter().sum();
        (taps, sum, term.a * (PI / term.b).sqrt() * sum * sum)
    });
    let sampled: Vec<_> = sampled.collect();
    let whole: f64 = sampled.iter().map(|(.., mass)| mass).sum();
    let kernel = |(taps, sum, mass): &(Vec<f64>, f64, f64)| Kernel {
        taps: without_faint_ends(taps.iter().map(|t| (t / sum) as f32).collect()),
        share: (mass / whole) as f32,
    };
    sampled.iter().map(kernel).collect()
}

/// Narrow Gaussians have nothing in the outer part of the common window: less than `f32` resolves.
fn without_faint_ends(mut taps: Vec<f32>) -> Vec<f32> {
    let faint = taps.iter().take_while(|t| **t < 1e-8).count();
    taps.truncate(taps.len() - faint);
    taps.split_off(faint)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_are_odd_in_length_and_sum_to_one() {
        for ppd in [10.0, 30.0, 67.02, 200.0] {
            for terms in [&ACHROMATIC[..], &RED_GREEN, &BLUE_YELLOW] {
                let kernels = kernels(terms, ppd);
                let share: f32 = kernels.iter().map(|k| k.share).sum();
                assert!((share - 1.0).abs() < 1e-6);
                for kernel in kernels {
                    assert_eq!(kernel.taps.len() % 2, 1);
                    assert!((kernel.taps.iter().sum::<f32>() - 1.0).abs() < 1e-5);
                }
            }
        }
    }

    #[test]
    fn the_default_window_reaches_ten_pixels() {
        let blue_yellow = kernels(&BLUE_YELLOW, super::super::DEFAULT_PIXELS_PER_DEGREE);
        assert_eq!(blue_yellow[0].taps.len(), 21);
    }
}
