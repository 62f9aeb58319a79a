//! `afterglow doctor`: whether this machine can run Afterglow, and on what.

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
        None => print(&report),
    }
    if report.chosen.is_some() {
        return Ok(());
    }
    // The same search again, for its error: it is the one that every other command would meet.
    afterglow_gpu::Gpu::new(&options).map(drop).map_err(Failure::Device)
}

fn print(report: &DoctorReport) {
    let yes = |there: bool| if there { "yes" } else { "no" };
    println!("Vulkan loader      {}", report.loader_version.as_deref().unwrap_or("none"));
    println!("validation layer   {}", yes(report.validation_layer));
    match (&report.private_lavapipe.library, report.private_lavapipe.advice) {
        (Some(library), _) => println!("private lavapipe   {}", library.display()),
        (None, advice) => println!("private lavapipe   none; {}", advice.unwrap_or("run ./x setup")),
    }
    for device in &report.devices {
        let info = &device.info;
        println!("\n{} ({:?}, {}, Vulkan {})", info.name, info.kind, info.driver, info.api_version);
        if info.refused.is_empty() {
            println!("  usable");
        }
        for reason in &info.refused {
            println!("  not usable: {reason}");
        }
        if !device.ray_tracing.is_empty() {
            println!("  ray tracing: {}", device.ray_tracing.join(", "));
        }
    }
    match &report.chosen {
        Some(choice) => println!("\nAfterglow uses {}: {}", choice.device, choice.why),
        None => println!("\nno usable device"),
    }
}
