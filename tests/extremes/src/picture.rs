//! What was rendered, and how sure it is.

use afterglow_render::Radiance;

/// A mean and its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    pub mean: f64,
    pub error: f64,
}

impl Estimate {
    /// Whether a value is within four standard errors, and this share of it for rounding.
    pub fn agrees(self, value: f64, rounding: f64) -> bool {
        self.error.is_finite() && (self.mean - value).abs() <= 4.0 * self.error + rounding * value.abs()
    }

    /// Whether two estimates are within four standard errors of their difference.
    pub fn agrees_with(self, other: Self, rounding: f64) -> bool {
        Self { error: self.error.hypot(other.error), ..self }.agrees(other.mean, rounding)
    }

    /// Fails unless [`Estimate::agrees`].
    #[track_caller]
    pub fn assert(self, value: f64, rounding: f64, what: &str) {
        let off = (self.mean - value) / self.error;
        let share = self.mean / value - 1.0;
        assert!(
            self.agrees(value, rounding),
            "{what}: {} +- {:.1e}, not {value}: {off:.1} standard errors, a share of {share:.1e}",
            self.mean,
            self.error
        );
    }
}

/// A linear picture and what was counted.
#[derive(Debug, Clone)]
pub struct Picture {
    pub radiance: Radiance,
    /// Samples that were no number.
    pub non_finite: u64,
    /// Samples that were limited.
    pub limited: u64,
    /// Luminance that limiting has removed, of all samples together.
    pub removed: f64,
    pub rays: u64,
    /// What a window shows: four bytes a pixel.
    pub shown: Vec<u8>,
}

impl Picture {
    /// Whether all pixels are numbers, and not negative.
    pub fn is_sound(&self) -> bool {
        let is_sound = |value: &f32| value.is_finite() && *value >= 0.0;
        self.radiance.mean.iter().flatten().all(is_sound)
    }

    /// Fails where a pixel or sample is no number.
    #[track_caller]
    pub fn assert_sound(&self, what: &str) {
        let bad =
            self.radiance.mean.iter().flatten().filter(|value| !value.is_finite() || **value < 0.0).count();
        assert_eq!((bad, self.non_finite), (0, 0), "{what}: channels and samples that are no numbers");
    }

    /// The mean over the whole picture and all channels.
    pub fn whole(&self) -> Estimate {
        let [width, height] = self.radiance.size;
        self.block([0, 0], [width, height])
    }

    /// The mean over the middle half of the picture, both ways.
    pub fn middle(&self) -> Estimate {
        let [width, height] = self.radiance.size;
        self.block([width / 4, height / 4], [width / 2, height / 2])
    }

    /// The mean over a block of pixels, of its upper left corner and size, and all channels. Its error takes channels to be
    /// as dependent as can be.
    pub fn block(&self, [left, top]: [u32; 2], [width, height]: [u32; 2]) -> Estimate {
        let indices = (top..top + height)
            .flat_map(|y| (left..left + width).map(move |x| (y * self.radiance.size[0] + x) as usize));
        let (mut sum, mut variance, mut count) = (0.0, 0.0, 0.0);
        for index in indices {
            let mean = |values: [f32; 3]| values.iter().copied().map(f64::from).sum::<f64>() / 3.0;
            sum += mean(self.radiance.mean[index]);
            variance += mean(self.radiance.standard_error[index]).powi(2);
            count += 1.0;
        }
        Estimate { mean: sum / count, error: variance.sqrt() / count }
    }

    /// Blocks of so many pixels a side, row by row.
    pub fn blocks(&self, side: u32) -> Vec<Estimate> {
        let [width, height] = self.radiance.size;
        let places = (0..height / side).flat_map(|y| (0..width / side).map(move |x| [x * side, y * side]));
        places.map(|place| self.block(place, [side; 2])).collect()
    }

    /// Fails unless all blocks of two pictures agree; `rounding` is the share that the lesser errors may be.
    #[track_caller]
    pub fn assert_same(&self, other: &Self, side: u32, rounding: f64, what: &str) {
        for (number, (own, theirs)) in self.blocks(side).iter().zip(other.blocks(side)).enumerate() {
            assert!(own.agrees_with(theirs, rounding), "{what}: block {number}: {own:?}, not {theirs:?}");
        }
    }

    /// The root of the mean squared difference of two pictures.
    pub fn distance(&self, other: &Self) -> f64 {
        let pairs = self.radiance.mean.iter().flatten().zip(other.radiance.mean.iter().flatten());
        let squares: f64 = pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum();
        (squares / (3.0 * self.radiance.mean.len() as f64)).sqrt()
    }
}
