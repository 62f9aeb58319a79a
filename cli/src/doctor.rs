//! `afterglow doctor`: whether this machine can run Afterglow, and on what.

use std::io::{self, Write};
use std::path::PathBuf;

use afterglow_gpu::doctor::{DoctorReport, examine};
use clap::Args;

use crate::failure::Failure;
use crate::options::DeviceArguments;
use crate::output;

/// Arguments of `doctor`.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    device: DeviceArguments,
    /// Also write the findings as JSON (`-`: to standard output)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// Runs `doctor`.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let options = arguments.device.gpu_options();
    let report = examine(&options);
    match &arguments.json {
        Some(path) => output::write_json(path, &report)?,
        None => output::print(|out| write(&report, out))?,
    }
    if report.chosen.is_some() {
        return Ok(());
    }
    // The same search again, for its error: it is the one that every other command would meet.
    afterglow_gpu::Gpu::new(&options).map(drop).map_err(Failure::Device)
}

fn write(report: &DoctorReport, out: &mut impl Write) -> io::Result<()> {
    let yes = |there: bool| if there { "yes" } else { "no" };
    writeln!(out, "Vulkan loader      {}", report.loader_version.as_deref().unwrap_or("none"))?;
    writeln!(out, "validation layer   {}", yes(report.validation_layer))?;
    match (&report.private_lavapipe.library, report.private_lavapipe.advice) {
        (Some(library), _) => writeln!(out, "private lavapipe   {}", library.display())?,
        (None, advice) => writeln!(out, "private lavapipe   none; {}", advice.unwrap_or("run ./x setup"))?,
    }
    for device in &report.devices {
        let info = &device.info;
        writeln!(out, "\n{} ({:?}, {}, Vulkan {})", info.name, info.kind, info.driver, info.api_version)?;
        if info.refused.is_empty() {
            writeln!(out, "  usable")?;
        }
        for reason in &info.refused {
            writeln!(out, "  not usable: {reason}")?;
        }
        if !device.ray_tracing.is_empty() {
            writeln!(out, "  ray tracing: {}", device.ray_tracing.join(", "))?;
        }
    }
    match &report.chosen {
        Some(choice) => writeln!(out, "\nAfterglow uses {}: {}", choice.device, choice.why)?,
        None => writeln!(out, "\nno usable device")?,
    }
    Ok(())
}
