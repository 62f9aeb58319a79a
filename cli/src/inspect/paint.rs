//! Pictures of frames, coloured by what their draws are taken for.
//!
//! Each frame is rasterized as the program drew it, and once more for each thing to colour by: the same draws in flat
//! colours (`rewrite`), with depth, stencil, culling, clipping and cut-outs as they are. The picture is the colour,
//! shaded by the brightness of what the program drew, so that one sees what is what (`picture`).

mod colors;
mod legend;
mod picture;
mod rewrite;

use std::path::Path;

use afterglow_gl::backend::{Backend, End};
use afterglow_gl::frame::{Frame, ImageKey, Operation};
use afterglow_gpu::Gpu;
use afterglow_render::{RenderOptions, Renderer, Scale};
use afterglow_scene::Scene;
use clap::ValueEnum;

use super::Arguments;
use crate::failure::Failure;
use crate::options::Size;
use crate::output;
use legend::Legend;

/// What a picture is coloured by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum By {
    /// The class.
    Class,
    /// The object's identity: a hue each.
    Id,
    /// Base, lightmap, detail or glow.
    Layer,
    /// Where the light on it comes from.
    Light,
    /// The reason of the verdict: a hue each.
    Reason,
}

impl By {
    fn name(self) -> &'static str {
        match self {
            By::Class => "class",
            By::Id => "id",
            By::Layer => "layer",
            By::Light => "light",
            By::Reason => "reason",
        }
    }
}

/// Paints frames.
pub struct Painter<'a> {
    gpu: Gpu,
    renderer: Renderer,
    folder: &'a Path,
    by: Vec<By>,
    size: Option<Size>,
    /// A white texel, for what has no texture.
    white: ImageKey,
    legend: Legend,
}

impl<'a> Painter<'a> {
    /// Opens the device, and makes the folder.
    pub fn new(arguments: &Arguments, folder: &'a Path) -> Result<Painter<'a>, Failure> {
        std::fs::create_dir_all(folder).map_err(|error| Failure::output(folder, error))?;
        let gpu = Gpu::new(&arguments.device.gpu_options())?;
        let mut renderer = Renderer::new(&gpu, &RenderOptions::default()).map_err(failed)?;
        let white = ImageKey::unique();
        renderer.submit(rewrite::white_texel(white), End::Continued);
        let mut by = arguments.by.clone();
        by.sort();
        by.dedup();
        if by.is_empty() {
            by = By::value_variants().to_vec();
        }
        let size = arguments.size;
        Ok(Painter { gpu, renderer, folder, by, size, white, legend: Legend::default() })
    }

    /// Executes what of a frame later ones need.
    pub fn skip(&mut self, mut frame: Frame) {
        frame.keep_state();
        self.scale(&frame).frame(&mut frame);
        self.renderer.submit(frame, End::Continued);
    }

    /// Writes a frame's pictures: as the program drew it, and by everything that was asked for.
    pub fn paint(&mut self, index: u64, mut frame: Frame, scene: &Scene) -> Result<(), Failure> {
        self.scale(&frame).frame(&mut frame);
        let dropped = rewrite::without_drops(&mut frame);
        let pictures = self.by.iter().map(|&by| {
            let swatches = colors::swatches(by, &frame, scene);
            (by, rewrite::painted(&frame, &swatches, self.white), swatches)
        });
        let pictures: Vec<_> = pictures.collect();
        let (size, drawn) = self.execute(frame)?;
        self.write(index, "drawn", size, &drawn)?;
        for (by, painted, swatches) in pictures {
            let (size, flat) = self.execute(painted)?;
            let mut shaded = picture::shade(&flat, &drawn);
            if by == By::Light {
                picture::mark_lights(&mut shaded, size, scene);
            }
            self.write(index, by.name(), size, &shaded)?;
            self.legend.add(by, scene, &swatches);
        }
        let drops =
            Frame { operations: dropped.into_iter().map(Operation::DropImage).collect(), ..Frame::default() };
        self.renderer.submit(Frame { size, ..drops }, End::Continued);
        Ok(())
    }

    /// Writes the legend, and fails if the validation layer had anything to say.
    pub fn finish(self) -> Result<(), Failure> {
        let legend = self.legend.picture();
        output::write_picture(&self.folder.join("legend.png"), legend.size, &legend.rgba)?;
        match self.gpu.validation_messages() {
            messages if messages.is_empty() => Ok(()),
            messages => Err(Failure::Check(format!("validation: {}", messages.join("\n")))),
        }
    }

    fn scale(&self, frame: &Frame) -> Scale {
        Scale { from: frame.size, to: self.size.map_or(frame.size, |Size(width, height)| (width, height)) }
    }

    fn execute(&mut self, frame: Frame) -> Result<((u32, u32), Vec<u8>), Failure> {
        self.renderer.submit(frame, End::Swap);
        if let Some(error) = self.renderer.failure() {
            return Err(failed(error));
        }
        let pixels = self.renderer.read_color().map_err(failed)?;
        let [width, height] = self.renderer.size();
        Ok(((width, height), pixels))
    }

    fn write(&self, index: u64, what: &str, size: (u32, u32), rgba: &[u8]) -> Result<(), Failure> {
        let path = self.folder.join(format!("frame-{index:06}-{what}.png"));
        output::write_picture(&path, size, rgba)
    }
}

fn failed(error: impl ToString) -> Failure {
    Failure::Check(error.to_string())
}
