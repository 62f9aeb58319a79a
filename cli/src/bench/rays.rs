//! `afterglow bench rays`: rays a second through the structures that light is traced in.
//!
//! Closed rooms of a thousand triangles to four million, and meshes from files. Rays are made on the device (`caster`):
//! a camera's, shadow rays and cosine-distributed bounces from what the camera sees. Each structure (`structure`)
//! traces the same rays; a plain binary hierarchy is the yardstick. Building, refitting and memory are measured besides: of
//! our own on the processor, of the driver's by the device's clock.

mod binary;
mod build;
mod caster;
mod hardware;
mod npz;
mod rows;
mod structure;
mod subject;

use std::path::{Path, PathBuf};

use afterglow_bvh::Quality;
use afterglow_gpu::{DeviceKind, Gpu, GpuError};
use clap::{Args, ValueEnum};
use serde::Serialize;

use crate::failure::Failure;
use crate::options::DeviceArguments;
use crate::output;
use caster::Caster;
use structure::Structure;
use subject::Subject;

/// Arguments of `bench rays`.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    device: DeviceArguments,
    /// Rays across and down, multiples of 8 and 4 [default: 320x180, on a GPU 1920x1080]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    size: Option<[u32; 2]>,
    /// Whose structures
    #[arg(long, value_enum, default_value = "both")]
    backend: Backend,
    /// Also a mesh: arrays `positions` (V, 3) and `triangles` (T, 3) of a NumPy archive; may be given more than once
    #[arg(long, value_name = "FILE.npz")]
    mesh: Vec<PathBuf>,
    /// Rooms of about so many triangles
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(0..=50_000_000),
          default_value = "1000,30000,300000,1000000,4000000")]
    triangles: Vec<u32>,
    /// Trees of our own that rays go through
    #[arg(long, value_enum, default_value = "good")]
    quality: Trees,
    /// Time for each figure, in milliseconds; each is of at least three runs
    #[arg(long, value_name = "MS", default_value_t = 300, value_parser = clap::value_parser!(u32).range(1..=60_000))]
    time: u32,
    /// Also write the figures as JSON (`-`: to standard output)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// Whose structures are measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Backend {
    /// The project's own, in compute shaders
    Software,
    /// The driver's
    Hardware,
    /// Both
    Both,
}

/// Which trees are built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Trees {
    /// Those that are built fast, and no others
    Fast,
    /// Both kinds, of which rays go through the better one
    Good,
}

/// All figures.
#[derive(Debug, Serialize)]
struct Report {
    device: String,
    size: [u32; 2],
    subjects: Vec<rows::SubjectRow>,
}

/// Runs `bench rays`.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let gpu = Gpu::new(&arguments.device.gpu_options())?;
    let info = gpu.info();
    let size = arguments.size.unwrap_or(match info.kind {
        DeviceKind::Cpu => [320, 180],
        _ => [1920, 1080],
    });
    let prints = arguments.json.as_deref() != Some(Path::new("-"));
    let mut report = Report { device: info.name.clone(), size, subjects: Vec::new() };
    if prints {
        output::print(|out| rows::write_head(out, &report.device, size))?;
    }
    let caster = Caster::new(&gpu, size, arguments.time)?;
    // Files first: a wrong name is said before anything is measured.
    let meshes: Vec<Subject> =
        arguments.mesh.iter().map(|path| Subject::file(path)).collect::<Result<_, _>>()?;
    let rooms = arguments.triangles.iter().map(|&triangles| Subject::room(triangles));
    for subject in rooms.chain(meshes) {
        let row = measure(&gpu, &caster, &subject, arguments)?;
        if prints {
            output::print(|out| row.write(out))?;
        }
        report.subjects.push(row);
    }
    arguments.json.as_deref().map_or(Ok(()), |path| output::write_json(path, &report))
}

fn measure(
    gpu: &Gpu,
    caster: &Caster,
    subject: &Subject,
    arguments: &Arguments,
) -> Result<rows::SubjectRow, Failure> {
    let quality = match arguments.quality {
        Trees::Fast => Quality::Fast,
        Trees::Good => Quality::Good,
    };
    let (blas, build) = build::measure(subject, quality)?;
    let wide = structure::Wide::new(gpu, &blas)?;
    let rays = caster.make_rays(gpu, subject, &wide)?;
    let plain = structure::Plain::new(gpu, subject)?;
    let mut row = rows::SubjectRow::new(subject, build);
    let mut structures: Vec<&dyn Structure> = vec![&plain];
    if arguments.backend != Backend::Hardware {
        structures.push(&wide);
    }
    let hardware;
    if arguments.backend != Backend::Software {
        match hardware::measure(gpu, subject) {
            Ok((built, driver)) => {
                row.driver = Some(driver);
                hardware = built;
                structures.push(&hardware);
            }
            // What the device lacks, or has not enough room for, is no failure of the others.
            Err(Failure::Device(error @ (GpuError::Unsupported { .. } | GpuError::Invalid { .. }))) => {
                row.not_there.push(("hardware", error.to_string()));
            }
            Err(error) => return Err(error),
        }
    }
    row.structures = caster.measure(gpu, &structures, &rays)?;
    Ok(row)
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let (width, height) = text.split_once('x').ok_or("not WIDTHxHEIGHT")?;
    let side = |text: &str, step: u32| match text.parse::<u32>() {
        Ok(side @ 8..=8192) if side.is_multiple_of(step) => Ok(side),
        _ => Err(format!("not a multiple of {step} from 8 to 8192")),
    };
    Ok([side(width, 8)?, side(height, 4)?])
}

#[cfg(test)]
mod tests {
    use afterglow_gpu::GpuOptions;
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        arguments: Arguments,
    }

    #[test]
    fn all_structures_give_the_same_answers() {
        let gpu = Gpu::new(&GpuOptions::for_tests()).unwrap();
        let caster = Caster::new(&gpu, [64, 32], 1).unwrap();
        let line = Line::parse_from(["rays", "--quality", "fast"]);
        let row = measure(&gpu, &caster, &Subject::room(1000), &line.arguments).unwrap();
        assert!(row.build.good_mtriangles.is_none());
        assert_eq!((row.structures.len(), row.not_there.len(), row.driver.is_some()), (3, 0, true));
        let rays = row.structures.iter().flat_map(|structure| &structure.rays);
        assert!(rays.clone().all(|rays| rays.differing == 0));
        assert!(rays.filter(|rays| rays.kind != "shadow").all(|rays| rays.hit_share == 1.0));
    }
}
