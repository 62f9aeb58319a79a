//! Pictures in a row, to be looked at together.

use crate::error::MetricsError;
use crate::image::{Encoding, Image};

/// Display value of the gap and of what lies below lower pictures.
const BACKGROUND: [f32; 3] = [1.0; 3];

/// Joins pictures from left to right, `gap` pixels apart, tops aligned, as display values.
///
/// # Errors
/// If there are no pictures or the result would be too large.
pub fn side_by_side(images: &[&Image], gap: usize) -> Result<Image, MetricsError> {
    let (Some(height), Some(gaps)) = (images.iter().map(|i| i.height()).max(), images.len().checked_sub(1))
    else {
        return Err(MetricsError::NothingToJoin);
    };
    let width = images.iter().fold(gaps.saturating_mul(gap), |sum, image| sum.saturating_add(image.width()));
    let mut joined = Image::from_fn(width, height, Encoding::Srgb, |_, _| BACKGROUND)?;
    let mut left = 0;
    for image in images {
        let shown = image.to_srgb();
        for (y, row) in shown.pixels().chunks_exact(image.width()).enumerate() {
            let start = y * width + left;
            joined.pixels_mut()[start..start + row.len()].copy_from_slice(row);
        }
        left += image.width() + gap;
    }
    Ok(joined)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::FormatError;

    fn constant(width: usize, height: usize, value: f32) -> Image {
        Image::from_fn(width, height, Encoding::Srgb, |_, _| [value; 3]).unwrap()
    }

    #[test]
    fn pictures_stand_apart_with_tops_aligned() {
        let joined = side_by_side(&[&constant(2, 2, 0.25), &constant(1, 1, 0.5)], 1).unwrap();
        assert_eq!((joined.width(), joined.height()), (4, 2));
        let reds: Vec<_> = joined.pixels().iter().map(|p| p[0]).collect();
        assert_eq!(reds, [0.25, 0.25, 1.0, 0.5, 0.25, 0.25, 1.0, 1.0]);
    }

    #[test]
    fn none_and_too_many_are_refused() {
        assert!(matches!(side_by_side(&[], 4), Err(MetricsError::NothingToJoin)));
        let image = constant(1, 1, 0.0);
        assert!(matches!(
            side_by_side(&[&image, &image], usize::MAX),
            Err(MetricsError::Format(FormatError::TooLarge { .. }))
        ));
    }
}
