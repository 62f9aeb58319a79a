//! `afterglow compare`: how far apart two pictures are.

use std::io::Write;
use std::path::{Path, PathBuf};

use afterglow_metrics::{Comparison, Image, Noise, combine_standard_errors, compare_noisy, io, side_by_side};
use clap::Args;

use crate::failure::Failure;
use crate::options::number;
use crate::output;

/// Arguments of `compare`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A picture: PNG, EXR, .npy, or an array of an .npz as in FILE.npz:ARRAY
    picture: PathBuf,
    /// What it is compared with
    reference: PathBuf,
    /// Standard error of each pixel (linear pictures only); several are combined as the root of the sum of their squares
    #[arg(long, value_name = "FILE")]
    standard_error: Vec<PathBuf>,
    /// Standard error of each pixel of the reference, to be combined with those
    #[arg(long, value_name = "FILE")]
    reference_error: Option<PathBuf>,
    /// Leave out pixels whose luminance has a standard error in the reference of more than this share of it, but for SSIM,
    /// PSNR and FLIP
    #[arg(long, value_name = "SHARE", value_parser = number, requires = "reference_error")]
    max_reference_error: Option<f64>,
    /// Write both pictures beside each other
    #[arg(long, value_name = "FILE")]
    side_by_side: Option<PathBuf>,
    /// Fail (exit code 1) if the mean FLIP error is greater
    #[arg(long, value_name = "ERROR", value_parser = number)]
    max_flip: Option<f64>,
    /// Fail (exit code 1) if SSIM is less
    #[arg(long, value_name = "SSIM", value_parser = number)]
    min_ssim: Option<f64>,
    /// Also write the figures as JSON (`-`: to standard output)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// Runs `compare`.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let (picture, reference) = (load(&arguments.picture)?, load(&arguments.reference)?);
    let of_picture = standard_error(&arguments.standard_error)?;
    let of_reference = arguments.reference_error.as_deref().map(load).transpose()?;
    let noise = Noise {
        of_picture: of_picture.as_ref(),
        of_reference: of_reference.as_ref(),
        most_of_reference: arguments.max_reference_error,
    };
    if let Some(path) = &arguments.side_by_side {
        let joined = side_by_side(&[&picture, &reference], 4).map_err(|error| Failure::input(path, error))?;
        io::save(&joined, path).map_err(|error| Failure::output(path, std::io::Error::other(error)))?;
    }
    let comparison = compare_noisy(&picture, &reference, &noise)
        .map_err(|error| Failure::input(&arguments.picture, error))?;
    match &arguments.json {
        Some(path) => output::write_json(path, &comparison)?,
        None => output::print(|out| write(&comparison, out))?,
    }
    judge(arguments, &comparison)
}

fn load(path: impl AsRef<Path>) -> Result<Image, Failure> {
    io::load(path.as_ref()).map_err(|error| Failure::input(path.as_ref(), error))
}

/// All of them combined, if there are any.
fn standard_error(paths: &[PathBuf]) -> Result<Option<Image>, Failure> {
    let Some((first, others)) = paths.split_first() else { return Ok(None) };
    let mut combined = load(first)?;
    for path in others {
        let error = load(path)?;
        combined = combine_standard_errors(&combined, &error).map_err(|error| Failure::input(path, error))?;
    }
    Ok(Some(combined))
}

fn write(comparison: &Comparison, out: &mut impl Write) -> std::io::Result<()> {
    let mut line = |name: &str, value: Option<f64>| match value {
        Some(value) => writeln!(out, "{name:<16} {value:.6}"),
        None => writeln!(out, "{name:<16} -"),
    };
    line("relMSE", comparison.relmse)?;
    line("RMSE", comparison.rmse)?;
    line("PSNR", comparison.psnr)?;
    line("SSIM", comparison.ssim)?;
    line("FLIP", Some(comparison.flip))?;
    line("luminance ratio", comparison.luminance_ratio)?;
    if comparison.blocks_beyond_4.is_some() {
        line("blocks beyond 4", comparison.blocks_beyond_4)?;
        line("blocks beyond 6", comparison.blocks_beyond_6)?;
    }
    if comparison.left_out > 0 {
        writeln!(out, "pixels left out  {}", comparison.left_out)?;
    }
    if !comparison.all_finite() {
        writeln!(
            out,
            "pixels that are no numbers: {} and {}",
            comparison.non_finite, comparison.non_finite_reference
        )?;
    }
    Ok(())
}

fn judge(arguments: &Arguments, comparison: &Comparison) -> Result<(), Failure> {
    if let Some(limit) =
        arguments.max_flip.filter(|limit| comparison.flip.is_nan() || comparison.flip > *limit)
    {
        return Err(Failure::Check(format!("FLIP is {:.4}, more than {limit}", comparison.flip)));
    }
    let ssim = comparison.ssim.unwrap_or(0.0);
    match arguments.min_ssim {
        Some(limit) if ssim < limit => Err(Failure::Check(format!("SSIM is {ssim:.4}, less than {limit}"))),
        _ => Ok(()),
    }
}
