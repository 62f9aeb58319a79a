//! What was measured, for people and as JSON.

use std::io::{self, Write};

use afterglow_gpu::DeviceInfo;
use serde::Serialize;

use super::Arguments;
use super::figures::PartErrors;
use super::judge::{Figures, FrameFigures, LightStep};

/// Everything that `bench denoise --json` writes.
#[derive(Debug, Serialize)]
pub struct Report {
    spp: u32,
    bounces: u32,
    seed: u32,
    /// Whether what stands still is the mean of all its frames' samples.
    accumulates: bool,
    /// Which FLIP it is.
    flip: &'static str,
    /// Each scene that was played.
    pub sequences: Vec<SequenceReport>,
    device: DeviceInfo,
}

/// A scene's.
#[derive(Debug, Serialize)]
pub struct SequenceReport {
    pub name: String,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// The first frame played, and the one after the last.
    pub frames: [usize; 2],
    /// Samples a pixel of our own references; none of those in a file.
    pub reference_spp: Option<u32>,
    pub denoisers: Vec<Figures>,
}

impl Report {
    /// Before anything was played.
    pub fn new(arguments: &Arguments, device: DeviceInfo) -> Report {
        Report {
            spp: arguments.spp,
            bounces: arguments.bounces,
            seed: arguments.seed,
            accumulates: !arguments.no_accumulate,
            flip: "hdr",
            sequences: Vec::new(),
            device,
        }
    }

    /// Writes what is above the tables.
    pub fn write_head(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(
            out,
            "{} samples a pixel, {} bounces, on {}; HDR-FLIP; errors are RMSE over mean, without pixels that show lights",
            self.spp, self.bounces, self.device.name
        )
    }
}

impl SequenceReport {
    /// Writes a row a denoiser.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let ([width, height], [first, end]) = (self.size, self.frames);
        writeln!(out, "\n{}, {width}x{height}, frames {first}..{end}", self.name)?;
        writeln!(
            out,
            "{:12} {:^15} {:^15} {:>7} {:^18} {:^18} {:^12}",
            "", "still", "moving", "light", "all", "uncovered", "worst"
        )?;
        writeln!(
            out,
            "{:12} {:>7} {:>7} {:>7} {:>7} {:>7} {:>8} {:>9} {:>8} {:>9} {:>7} {:>5} {:>8} {:>5}",
            "denoiser",
            "SSIM",
            "FLIP",
            "SSIM",
            "FLIP",
            "FLIP",
            "error",
            "relMSE",
            "error",
            "relMSE",
            "SSIM",
            "frame",
            "flicker",
            "lag"
        )?;
        for figures in &self.denoisers {
            figures.write(out)?;
        }
        Ok(())
    }
}

impl Figures {
    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let summary = &self.summary;
        writeln!(
            out,
            "{:<12} {} {} {} {} {} {} {} {} {} {} {:>5} {} {:>5}",
            self.denoiser,
            number(summary.still_ssim, 4),
            number(summary.still_flip, 4),
            number(summary.moving_ssim, 4),
            number(summary.moving_flip, 4),
            number(summary.lighting_flip, 4),
            share(summary.lit_rmse_over_mean),
            number(summary.lit_relmse, 6),
            share(summary.uncovered_rmse_over_mean),
            number(summary.uncovered_relmse, 6),
            number(summary.worst_ssim, 4),
            summary.worst_frame.map_or_else(|| "-".into(), |frame| frame.to_string()),
            share(summary.flicker),
            match (summary.lag, self.light_steps.len()) {
                (Some(lag), _) => lag.to_string(),
                (None, 0) => "-".into(),
                (None, _) => "never".into(),
            }
        )
    }

    /// Writes a row a frame, then stretches and steps.
    pub fn write_frames(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "\n{}", self.denoiser)?;
        writeln!(
            out,
            "{:>5} {:>5} {:>8} {:>9} {:>8} {:>9} {:>7} {:>7} {:>7} {:>6} {:>8} {:>9}",
            "frame",
            "like",
            "RMSE",
            "RMSE/mean",
            "lit",
            "relMSE",
            "SSIM",
            "FLIP",
            "light",
            "new",
            "error",
            "relMSE"
        )?;
        for frame in &self.frames {
            frame.write(out)?;
        }
        for stretch in &self.still {
            let flicker = share(stretch.flicker);
            writeln!(out, "still frames {}..={}: flicker{flicker}", stretch.first, stretch.last)?;
        }
        self.light_steps.iter().try_for_each(|step| step.write(out))
    }
}

impl FrameFigures {
    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let errors = &self.errors;
        write!(
            out,
            "{:>5} {:>5} {} {} {} {} {} {:>7.4} {}",
            self.frame,
            self.reference,
            number(errors.rmse, 5),
            share(errors.rmse_over_mean),
            share(self.lit.rmse_over_mean),
            number(errors.relmse, 6),
            number(errors.ssim, 4),
            errors.flip,
            number(errors.luminance_ratio, 4)
        )?;
        match self.uncovered {
            PartErrors { pixels: 0, .. } => writeln!(out),
            PartErrors { pixels, rmse_over_mean, relmse } => {
                writeln!(out, " {pixels:>6} {} {}", share(rmse_over_mean), number(relmse, 6))
            }
        }
    }
}

impl LightStep {
    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let lag = match self.lag {
            Some(lag) => format!("after {lag} frames"),
            None => format!("not within {} frames", self.last - self.frame),
        };
        let ratio = self.last_over_reference;
        let frame = self.frame;
        writeln!(
            out,
            "step of the light in frame {frame}: within 10 % {lag}; at last {ratio:.4} of the reference"
        )
    }
}

/// A number with so many digits, or that there is none.
fn number(value: Option<f64>, digits: usize) -> String {
    let width = digits + 3;
    value.map_or_else(|| format!("{:>width$}", "-"), |value| format!("{value:>width$.digits$}"))
}

/// In percent, 8 characters wide.
fn share(value: Option<f64>) -> String {
    value.map_or_else(|| format!("{:>8}", "-"), |value| format!("{:>6.2} %", 100.0 * value))
}
