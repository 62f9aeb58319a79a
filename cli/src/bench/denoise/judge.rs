//! Holds the pictures of one denoiser against a sequence's references.

use std::ops::Range;

use afterglow_metrics::{Image, MetricsError};
use serde::Serialize;

use super::figures::{Errors, PartErrors, flicker, lag, mean_known, mean_of};
use super::references::References;
use super::sequence::{self, Kind, Sequence};
use super::visibility::{Pixels, Visibility};
use crate::failure::Failure;

/// Shorter stretches have neither flicker nor lag.
const LEAST_STRETCH: usize = 4;

/// What is known of a sequence's frames before any picture is judged.
pub struct Judge<'a> {
    sequence: &'a Sequence,
    played: Range<usize>,
    references: &'a References,
    kinds: Vec<Kind>,
    /// Of each frame with a reference.
    pixels: Vec<Option<Pixels>>,
}

/// Figures of a denoiser.
#[derive(Debug, Serialize)]
pub struct Figures {
    /// `none`, `svgf`, ...; `oidn` for Open Image Denoise.
    pub denoiser: String,
    /// What it comes to.
    pub summary: Summary,
    /// Each frame with a reference.
    pub frames: Vec<FrameFigures>,
    /// Each stretch of frames that show the same.
    pub still: Vec<Stretch>,
    /// Each step of the light.
    pub light_steps: Vec<LightStep>,
}

/// Figures of a frame.
#[derive(Debug, Serialize)]
pub struct FrameFigures {
    /// Counted as in the scene.
    pub frame: usize,
    /// The frame whose reference it shares.
    pub reference: usize,
    /// What it is to a denoiser.
    pub kind: Kind,
    /// Of the whole picture.
    #[serde(flatten)]
    pub errors: Errors,
    /// Of what shows no light itself: the edges of lamps are so bright that nothing else would count beside them.
    pub lit: PartErrors,
    /// Of what was not in view in one of the last 8 frames.
    pub uncovered: PartErrors,
    /// Of what a moving object covered in one of the last 8 frames while the camera stood as now.
    pub left_by_objects: PartErrors,
    /// Pixels that are not judged: spherical lights, which pathtrace does not show.
    pub left_out: usize,
}

/// Frames that show the same.
#[derive(Debug, Serialize)]
pub struct Stretch {
    /// Its first frame.
    pub first: usize,
    /// Its last.
    pub last: usize,
    /// Mean relative change of luminance from frame to frame, in its second half.
    pub flicker: Option<f64>,
}

/// A step of the light.
#[derive(Debug, Serialize)]
pub struct LightStep {
    /// The frame in which it happens.
    pub frame: usize,
    /// The last frame that shows the same.
    pub last: usize,
    /// Frames until the mean luminance stays within a tenth of the reference's; none if it does not.
    pub lag: Option<usize>,
    /// Mean luminance of that last frame over the reference's.
    pub last_over_reference: f64,
}

/// What the figures of all frames come to; the first frame played is in none of them.
#[derive(Debug, Serialize)]
pub struct Summary {
    /// Mean SSIM of frames like the one before them, but not after a step of the light.
    pub still_ssim: Option<f64>,
    /// Their mean FLIP.
    pub still_flip: Option<f64>,
    /// Mean SSIM of frames in which something is not where it was.
    pub moving_ssim: Option<f64>,
    /// Their mean FLIP.
    pub moving_flip: Option<f64>,
    /// Mean FLIP from a step of the light on.
    pub lighting_flip: Option<f64>,
    /// Mean relMSE of all frames, without pixels that show lights.
    pub lit_relmse: Option<f64>,
    /// Mean of their RMSE over their mean.
    pub lit_rmse_over_mean: Option<f64>,
    /// Mean relMSE of uncovered pixels, where there are some.
    pub uncovered_relmse: Option<f64>,
    /// Mean of their RMSE over their mean.
    pub uncovered_rmse_over_mean: Option<f64>,
    /// The least SSIM.
    pub worst_ssim: Option<f64>,
    /// In which frame.
    pub worst_frame: Option<usize>,
    /// Mean flicker of still stretches.
    pub flicker: Option<f64>,
    /// The longest lag; none if there is none, or if the light does not get there at all.
    pub lag: Option<usize>,
}

impl<'a> Judge<'a> {
    /// Of the frames `played` of a sequence.
    pub fn new(
        sequence: &'a Sequence,
        played: &Range<usize>,
        references: &'a References,
    ) -> Result<Self, Failure> {
        let refused = |error: afterglow_bvh::BuildError| Failure::Check(error.to_string());
        let mut visibility = Visibility::new(&sequence.scene).map_err(refused)?;
        let mut pixels = Vec::with_capacity(played.len());
        for frame in played.clone() {
            pixels.push(match references.of(frame) {
                Some(_) => Some(visibility.pixels(frame, played.start).map_err(refused)?),
                None => None,
            });
        }
        let kinds = sequence::kinds(&sequence.scene.frames, played);
        Ok(Self { sequence, played: played.clone(), references, kinds, pixels })
    }

    /// Where something was uncovered: the middle of those pixels in some frames, column and row.
    pub fn middle_of_uncovered(&self, frames: Range<usize>) -> Option<[usize; 2]> {
        let width = self.sequence.scene.size[0] as usize;
        let known = frames.filter_map(|frame| self.pixels.get(frame - self.played.start)?.as_ref());
        let chosen = known.flat_map(|pixels| pixels.uncovered.iter().enumerate().filter(|(_, is)| **is));
        let (mut sum, mut count) = ([0, 0], 0);
        for (pixel, _) in chosen {
            sum = [sum[0] + pixel % width, sum[1] + pixel / width];
            count += 1;
        }
        (count > 0).then(|| sum.map(|sum| sum / count))
    }

    /// Figures of one picture a frame played.
    pub fn judge(&self, denoiser: &str, pictures: &[Image]) -> Result<Figures, MetricsError> {
        let mut frames = Vec::new();
        let mut means = Vec::with_capacity(pictures.len());
        for (offset, picture) in pictures.iter().enumerate() {
            let shown = self.without_lights(offset, picture);
            means.push(mean_of(&shown.luminances()));
            frames.extend(self.frame(offset, &shown)?);
        }
        let still = self.still(pictures);
        let light_steps = self.light_steps(&means);
        let summary = Summary::of(&frames, &still, &light_steps);
        Ok(Figures { denoiser: denoiser.into(), summary, frames, still, light_steps })
    }

    /// A picture that is right where spherical lights are seen.
    fn without_lights(&self, offset: usize, picture: &Image) -> Image {
        let mut shown = picture.clone();
        let reference = self.references.of(self.played.start + offset);
        let (Some((_, reference)), Some(pixels)) = (reference, &self.pixels[offset]) else { return shown };
        let wanted = reference.mean.pixels().iter().zip(&pixels.of_lights);
        for (pixel, (wanted, _)) in shown.pixels_mut().iter_mut().zip(wanted).filter(|(_, (_, is))| **is) {
            *pixel = *wanted;
        }
        shown
    }

    fn frame(&self, offset: usize, shown: &Image) -> Result<Option<FrameFigures>, MetricsError> {
        let frame = self.played.start + offset;
        let (Some((number, reference)), Some(pixels)) = (self.references.of(frame), &self.pixels[offset])
        else {
            return Ok(None);
        };
        let lights = pixels.of_lights.iter().zip(&pixels.of_emitters);
        let lit: Vec<bool> = lights.map(|(light, emitter)| !light && !emitter).collect();
        let of_part = |chosen: &[bool]| PartErrors::of(shown, &reference.mean, chosen);
        Ok(Some(FrameFigures {
            frame,
            reference: number,
            kind: self.kinds[offset],
            errors: Errors::of(shown, reference)?,
            lit: of_part(&lit),
            uncovered: of_part(&pixels.uncovered),
            left_by_objects: of_part(&pixels.left_by_objects),
            left_out: pixels.of_lights.iter().filter(|is| **is).count(),
        }))
    }

    /// Stretches that are played from their beginning to their end, as offsets.
    fn stretches(&self) -> Vec<Range<usize>> {
        let same = sequence::same_frames(&self.sequence.scene.frames);
        let whole = |stretch: &Range<usize>| {
            stretch.len() >= LEAST_STRETCH
                && stretch.start >= self.played.start
                && stretch.end <= self.played.end
        };
        let offset = |frame: usize| frame - self.played.start;
        let stretches = sequence::stretches(&same).into_iter().filter(whole);
        stretches.map(|stretch| offset(stretch.start)..offset(stretch.end)).collect()
    }

    fn still(&self, pictures: &[Image]) -> Vec<Stretch> {
        let measured = |stretch: Range<usize>| {
            let luminances: Vec<_> = pictures[stretch.clone()].iter().map(Image::luminances).collect();
            let frame = |offset: usize| self.played.start + offset;
            Stretch {
                first: frame(stretch.start),
                last: frame(stretch.end - 1),
                flicker: flicker(&luminances),
            }
        };
        self.stretches().into_iter().map(measured).collect()
    }

    fn light_steps(&self, means: &[f64]) -> Vec<LightStep> {
        let frames = &self.sequence.scene.frames;
        let measured = |stretch: Range<usize>| {
            let (frame, last) = (self.played.start + stretch.start, self.played.start + stretch.end - 1);
            let (_, reference) = self.references.of(frame)?;
            let wanted = mean_of(&reference.mean.luminances());
            let means = &means[stretch];
            sequence::is_light_step(frames, frame).then(|| LightStep {
                frame,
                last,
                lag: lag(means, wanted),
                last_over_reference: means[means.len() - 1] / wanted,
            })
        };
        self.stretches().into_iter().filter(|stretch| stretch.start > 0).filter_map(measured).collect()
    }
}

impl Summary {
    fn of(frames: &[FrameFigures], still: &[Stretch], light_steps: &[LightStep]) -> Summary {
        let judged = || frames.iter().filter(|frame| frame.kind != Kind::First);
        let mean_where = |kind: Kind, value: fn(&FrameFigures) -> Option<f64>| {
            mean_known(judged().filter(|frame| frame.kind == kind).map(value))
        };
        let ssim = |frame: &FrameFigures| frame.errors.ssim;
        let flip = |frame: &FrameFigures| Some(frame.errors.flip);
        let known = judged().filter_map(|frame| Some((frame.errors.ssim?, frame.frame)));
        let worst = known.min_by(|a, b| a.0.total_cmp(&b.0));
        let lags: Option<Vec<usize>> = light_steps.iter().map(|step| step.lag).collect();
        Summary {
            still_ssim: mean_where(Kind::Still, ssim),
            still_flip: mean_where(Kind::Still, flip),
            moving_ssim: mean_where(Kind::Moving, ssim),
            moving_flip: mean_where(Kind::Moving, flip),
            lighting_flip: mean_where(Kind::Lighting, flip),
            lit_relmse: mean_known(judged().map(|frame| frame.lit.relmse)),
            lit_rmse_over_mean: mean_known(judged().map(|frame| frame.lit.rmse_over_mean)),
            uncovered_relmse: mean_known(judged().map(|frame| frame.uncovered.relmse)),
            uncovered_rmse_over_mean: mean_known(judged().map(|frame| frame.uncovered.rmse_over_mean)),
            worst_ssim: worst.map(|(ssim, _)| ssim),
            worst_frame: worst.map(|(_, frame)| frame),
            flicker: mean_known(still.iter().map(|stretch| stretch.flicker)),
            lag: lags.and_then(|lags| lags.into_iter().max()),
        }
    }
}

#[cfg(test)]
mod tests {
    use afterglow_metrics::Encoding;

    use super::*;
    use crate::bench::denoise::sequence::tests::frame;
    use crate::bench::denoise::visibility::tests::{SIDE, scene};

    /// Dark where a moving square is seen, else as bright as the light.
    fn truth(frame: usize, light: f32) -> Image {
        let moved = if frame >= 4 { 0.5 } else { 0.0 };
        Image::from_fn(SIDE, SIDE, Encoding::Linear, |x, y| {
            let at = |column: usize| ((column as f64 + 0.5) / SIDE as f64 * 2.0 - 1.0) * 0.5f64.tan() * 4.0;
            let inside = (at(x) + 0.5 - moved).abs() < 0.5 && at(y).abs() < 0.5;
            [if inside { 0.1 * light } else { light }; 3]
        })
        .unwrap()
    }

    /// A square moves in frame 4, the light goes to a tenth in frame 10.
    fn sequence() -> (Sequence, References, Vec<Image>) {
        let light = |index| if index < 10 { 1.0 } else { 0.1 };
        let frames = (0..24).map(|index| frame(0.0, if index >= 4 { 0.5 } else { 0.0 }, light(index)));
        let pictures: Vec<Image> = (0..24).map(|index| truth(index, light(index) as f32)).collect();
        let of_frame = (0..24).map(|index| {
            Some(if index < 4 {
                0
            } else if index < 10 {
                4
            } else {
                10
            })
        });
        let known = [0, 4, 10].map(|index| (index, pictures[index].clone())).to_vec();
        (Sequence::of(scene(frames.collect())), References::known(of_frame.collect(), known), pictures)
    }

    /// What a history makes of pictures that gives each new one such a weight.
    fn blended(pictures: &[Image], weight: f32) -> Vec<Image> {
        let mut history = pictures[0].clone();
        let blend = |picture: &Image| {
            for (kept, new) in history.pixels_mut().iter_mut().zip(picture.pixels()) {
                *kept = [0, 1, 2].map(|channel| kept[channel] + (new[channel] - kept[channel]) * weight);
            }
            history.clone()
        };
        pictures.iter().map(blend).collect()
    }

    #[test]
    fn what_is_right_has_no_error() {
        let (sequence, references, pictures) = sequence();
        let judge = Judge::new(&sequence, &(0..24), &references).unwrap();
        let figures = judge.judge("right", &pictures).unwrap();
        let summary = &figures.summary;
        assert_eq!((summary.lag, summary.flicker, summary.worst_ssim), (Some(0), Some(0.0), Some(1.0)));
        assert_eq!((summary.lit_relmse, summary.uncovered_relmse), (Some(0.0), Some(0.0)));
        let is_new = |frame: &FrameFigures| frame.uncovered.pixels > 0;
        let new: Vec<usize> = figures.frames.iter().filter(|it| is_new(it)).map(|it| it.frame).collect();
        assert_eq!(new, (4..12).collect::<Vec<_>>());
    }

    #[test]
    fn a_history_ghosts_where_it_was_uncovered_and_lags_behind_the_light() {
        let (sequence, references, pictures) = sequence();
        let judge = Judge::new(&sequence, &(0..24), &references).unwrap();
        let figures = judge.judge("half", &blended(&pictures, 0.5)).unwrap();
        let moved = &figures.frames[4];
        assert_eq!(moved.kind, Kind::Moving);
        // Half of the square's dark 0.1 is still there.
        assert!((moved.uncovered.rmse_over_mean.unwrap() - 0.45).abs() < 1e-3);
        assert_eq!(moved.uncovered.pixels, moved.left_by_objects.pixels);
        assert!(moved.errors.ssim.unwrap() < 0.99);
        assert_eq!((figures.summary.lag, figures.light_steps[0].frame), (Some(6), 10));
        let slow = judge.judge("tenth", &blended(&pictures, 0.1)).unwrap();
        assert_eq!((slow.summary.lag, slow.light_steps.len()), (None, 1));
        assert!(slow.summary.flicker > figures.summary.flicker);
    }

    #[test]
    fn parts_of_a_sequence_begin_without_a_history() {
        let (sequence, references, pictures) = sequence();
        let judge = Judge::new(&sequence, &(5..9), &references).unwrap();
        let figures = judge.judge("part", &pictures[5..9]).unwrap();
        assert_eq!((figures.frames.len(), figures.frames[0].kind, figures.still.len()), (4, Kind::First, 0));
        assert!(figures.frames.iter().all(|frame| frame.uncovered.pixels == 0));
        assert_eq!(judge.middle_of_uncovered(5..9), None);
    }
}
