//! `afterglow bench`: what things cost, beside something real.

mod denoise;
mod gl;
mod gl_client;
mod lights;
mod rays;
mod scene;
mod xlib;

use clap::{Args, Subcommand};

use crate::failure::Failure;

/// Arguments of `bench`.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// What OpenGL calls cost a program's thread, beside Mesa's front end with nothing behind it. Needs an X server.
    Gl(gl::Arguments),
    /// Rays a second through the structures that light is traced in, and what building them costs.
    Rays(rays::Arguments),
    /// What understanding frames costs, beside playing and copying them: of traces, and of worlds that grow.
    Scene(scene::Arguments),
    /// What many lights cost, and what choosing among them well is worth.
    Lights(lights::Arguments),
    /// How good pictures of few samples are while things move, for each denoiser.
    Denoise(denoise::Arguments),
    /// One side of `gl`: measures the libGL that is found first, and prints the figures as JSON.
    #[command(hide = true)]
    GlClient(gl_client::Arguments),
}

/// Runs `bench`.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.what {
        What::Gl(arguments) => gl::run(arguments),
        What::Rays(arguments) => rays::run(arguments),
        What::Scene(arguments) => scene::run(arguments),
        What::Lights(arguments) => lights::run(arguments),
        What::Denoise(arguments) => denoise::run(arguments),
        What::GlClient(arguments) => gl_client::run(arguments),
    }
}
