//! Separable filters on single planes, rows in parallel, edges replicated.

use rayon::prelude::*;

/// One channel, row after row.
#[derive(Clone, Debug)]
pub(crate) struct Plane {
    pub width: usize,
    pub values: Vec<f32>,
}

impl Plane {
    /// Every row correlated with `taps` (odd in number, the middle one at the pixel itself).
    pub fn along_rows(&self, taps: &[f32]) -> Plane {
        let radius = taps.len() / 2;
        self.map_rows(|y, out| {
            let row = &self.values[y * self.width..][..self.width];
            let padded = replicate_ends(row, radius);
            for (offset, &tap) in taps.iter().enumerate() {
                accumulate(out, &padded[offset..], tap);
            }
        })
    }

    /// Every column correlated with `taps` (odd in number, the middle one at the pixel itself).
    pub fn along_columns(&self, taps: &[f32]) -> Plane {
        let radius = taps.len() / 2;
        let last = self.values.len() / self.width - 1;
        self.map_rows(|y, out| {
            for (offset, &tap) in taps.iter().enumerate() {
                let source = (y + offset).saturating_sub(radius).min(last);
                accumulate(out, &self.values[source * self.width..], tap);
            }
        })
    }

    /// `weight` times `other`, added.
    pub fn add_scaled(&mut self, other: &Plane, weight: f32) {
        accumulate(&mut self.values, &other.values, weight);
    }

    fn map_rows(&self, row: impl Fn(usize, &mut [f32]) + Sync) -> Plane {
        let mut values = vec![0.0; self.values.len()];
        values.par_chunks_exact_mut(self.width).enumerate().for_each(|(y, out)| row(y, out));
        Plane { width: self.width, values }
    }
}

fn replicate_ends(row: &[f32], radius: usize) -> Vec<f32> {
    let mut padded = Vec::with_capacity(row.len() + 2 * radius);
    padded.resize(radius, row[0]);
    padded.extend_from_slice(row);
    padded.resize(row.len() + 2 * radius, row[row.len() - 1]);
    padded
}

fn accumulate(out: &mut [f32], source: &[f32], weight: f32) {
    for (out, &value) in out.iter_mut().zip(source) {
        *out += weight * value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_and_columns_replicate_their_ends() {
        let plane = Plane { width: 3, values: vec![1.0, 2.0, 4.0, 10.0, 20.0, 40.0] };
        assert_eq!(plane.along_rows(&[1.0, 0.0, 0.0]).values, [1.0, 1.0, 2.0, 10.0, 10.0, 20.0]);
        assert_eq!(plane.along_columns(&[0.0, 0.0, 1.0]).values, [10.0, 20.0, 40.0, 10.0, 20.0, 40.0]);
    }

    #[test]
    fn filters_wider_than_the_picture_keep_a_constant() {
        let plane = Plane { width: 2, values: vec![3.0f32; 4] };
        let taps = [1.0 / 9.0; 9];
        for v in plane.along_rows(&taps).along_columns(&taps).values {
            assert!((v - 3.0).abs() < 1e-6);
        }
    }
}
