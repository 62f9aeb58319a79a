//! What is known of the noise of two pictures that are compared.

use crate::blocks::combine_standard_errors;
use crate::colour::luminance;
use crate::error::MetricsError;
use crate::image::Image;

/// Standard errors of each pixel and channel, where they are known.
#[derive(Clone, Copy, Debug, Default)]
pub struct Noise<'a> {
    /// Of the picture; or of the difference, if the reference has none of its own.
    pub of_picture: Option<&'a Image>,
    pub of_reference: Option<&'a Image>,
    /// Pixels are left out whose luminance in the reference is known worse than this, as a share of it: the few paths that
    /// make them may be missing there, and then its standard error says too little.
    pub most_of_reference: Option<f64>,
}

impl Noise<'_> {
    /// The standard error of the difference, if any is known.
    ///
    /// # Errors
    /// If the sizes differ.
    pub(crate) fn combined(&self) -> Result<Option<Image>, MetricsError> {
        Ok(match (self.of_picture, self.of_reference) {
            (Some(a), Some(b)) => Some(combine_standard_errors(a, b)?),
            (one, other) => one.or(other).cloned(),
        })
    }

    /// Which of the reference's pixels count; none if all do.
    ///
    /// # Errors
    /// If the sizes differ.
    pub(crate) fn kept(&self, reference: &Image) -> Result<Option<Vec<bool>>, MetricsError> {
        let (Some(error), Some(most)) = (self.of_reference, self.most_of_reference) else { return Ok(None) };
        reference.expect_same_size(error, "the reference's standard error")?;
        let pairs = error.pixels().iter().zip(reference.pixels());
        Ok(Some(pairs.map(|(error, pixel)| luminance(*error) <= most * luminance(*pixel)).collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Encoding;

    fn image(pixels: &[[f32; 3]]) -> Image {
        Image::new(pixels.len(), 1, Encoding::Linear, pixels.to_vec()).unwrap()
    }

    #[test]
    fn what_is_known_badly_is_left_out() {
        let (reference, error) =
            (image(&[[1.0; 3], [1.0; 3], [0.0; 3]]), image(&[[0.01; 3], [0.1; 3], [0.0; 3]]));
        let noise = Noise { of_reference: Some(&error), most_of_reference: Some(0.02), ..Noise::default() };
        assert_eq!(noise.kept(&reference).unwrap(), Some(vec![true, false, true]));
        assert_eq!(Noise { most_of_reference: None, ..noise }.kept(&reference).unwrap(), None);
        let both = Noise { of_picture: Some(&error), ..noise }.combined().unwrap().unwrap();
        assert!((both.pixel(1, 0)[0] - 0.02f32.sqrt()).abs() < 1e-6);
    }
}
