//! Least squares within bounds, on the normal equations: coordinate by coordinate (Franc, Hlavac and Navara, Sequential
//! Coordinate-wise Algorithm for the Non-negative Least Squares Problem, CAIP 2005).

/// Most rounds over all coordinates.
const ROUNDS: usize = 2000;
/// Done when no step of a round gains more than this share of all that was gained.
const ENOUGH: f64 = 1e-12;

/// The normal equations of one least-squares problem: `gram` is A^T A, row by row, `right` A^T b.
pub(crate) struct Normal {
    pub gram: Vec<f64>,
    pub right: Vec<f64>,
}

impl Normal {
    /// Improves `x` until it minimises |A x - b| within 0 <= x <= `upper`.
    pub fn solve(&self, x: &mut [f64], upper: &[f64]) {
        let n = x.len();
        let mut slope: Vec<f64> = (0..n).map(|i| self.right[i] - dot(self.row(i), x)).collect();
        let mut gained = 0.0f64;
        for _ in 0..ROUNDS {
            let mut most = 0.0f64;
            for i in 0..n {
                let curvature = self.gram[i * n + i];
                if curvature <= 0.0 {
                    x[i] = 0.0;
                    continue;
                }
                let next = (x[i] + slope[i] / curvature).clamp(0.0, upper[i]);
                let step = next - x[i];
                if step == 0.0 {
                    continue;
                }
                let gain = step * (2.0 * slope[i] - step * curvature);
                most = most.max(gain);
                gained += gain;
                x[i] = next;
                for (slope, g) in slope.iter_mut().zip(self.row(i)) {
                    *slope -= step * g;
                }
            }
            if most <= ENOUGH * gained {
                break;
            }
        }
    }

    fn row(&self, i: usize) -> &[f64] {
        let n = self.right.len();
        &self.gram[i * n..(i + 1) * n]
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_hold_and_the_rest_is_exact() {
        // Columns (1, 0, 0), (1, 1, 0), (0, 0, 1); b = (1, 3, -1): unbounded (-2, 3, -1).
        let normal =
            Normal { gram: vec![1.0, 1.0, 0.0, 1.0, 2.0, 0.0, 0.0, 0.0, 1.0], right: vec![1.0, 4.0, -1.0] };
        let mut x = [0.0; 3];
        normal.solve(&mut x, &[f64::INFINITY; 3]);
        assert!((x[0], x[2]) == (0.0, 0.0) && (x[1] - 2.0).abs() < 1e-9, "{x:?}");
        normal.solve(&mut x, &[f64::INFINITY, 1.5, 1.0]);
        assert!((x[1] - 1.5).abs() < 1e-9, "{x:?}");
    }

    #[test]
    fn columns_without_content_get_nothing() {
        let normal = Normal { gram: vec![0.0], right: vec![0.0] };
        let mut x = [5.0];
        normal.solve(&mut x, &[f64::INFINITY]);
        assert_eq!(x, [0.0]);
    }
}
