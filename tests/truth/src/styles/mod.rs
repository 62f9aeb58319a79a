//! The styles: each a small program that draws as a kind of engine does.

mod batches;
mod cpu_animation;
mod lightmap_passes;
mod multitexture;
mod one_matrix;
mod own_matrices;
mod scrolling;

use std::io;

use crate::client::{Client, Recording};

/// A program.
pub trait Style {
    /// Draws a frame, up to but without the buffer swap.
    fn draw(&mut self, gl: &mut Client, frame: u32);
}

/// A style by its name.
#[derive(Clone, Copy)]
pub struct Entry {
    /// Its name on the command line and in files.
    pub name: &'static str,
    /// What it has that recovery must cope with.
    pub has: &'static str,
    /// How long it runs.
    pub frames: u32,
    begin: fn(&mut Client) -> Box<dyn Style>,
}

/// All styles.
pub const STYLES: &[Entry] = &[
    Entry {
        name: "one_matrix",
        has: "the world in world coordinates under one matrix, a HUD",
        frames: 48,
        begin: |gl| Box::new(one_matrix::OneMatrix::begin(gl)),
    },
    Entry {
        name: "lightmap_passes",
        has: "a base pass, then a lightmap multiplied where depth is equal; polygons cut by visibility",
        frames: 48,
        begin: |gl| Box::new(lightmap_passes::LightmapPasses::begin(gl)),
    },
    Entry {
        name: "batches",
        has: "the world in one batch a texture, gathered anew each frame",
        frames: 48,
        begin: |gl| Box::new(batches::Batches::begin(gl)),
    },
    Entry {
        name: "multitexture",
        has: "a lightmap on the second texture unit; display lists",
        frames: 48,
        begin: |gl| Box::new(multitexture::Multitexture::begin(gl)),
    },
    Entry {
        name: "own_matrices",
        has: "a matrix for each thing, whether it moves or not; a sun by glLight",
        frames: 48,
        begin: |gl| Box::new(own_matrices::OwnMatrices::begin(gl)),
    },
    Entry {
        name: "cpu_animation",
        has: "moving things transformed on the CPU, in world coordinates",
        frames: 48,
        begin: |gl| Box::new(cpu_animation::CpuAnimation::begin(gl)),
    },
    Entry {
        name: "scrolling",
        has: "texture coordinates that the program moves",
        frames: 48,
        begin: |gl| Box::new(scrolling::Scrolling::begin(gl)),
    },
];

/// The style of that name.
pub fn named(name: &str) -> Option<&'static Entry> {
    STYLES.iter().find(|entry| entry.name == name)
}

impl Entry {
    /// Runs the program.
    ///
    /// # Errors
    /// Never in fact: memory takes all that is written.
    pub fn record(&self) -> io::Result<Recording> {
        let mut gl = Client::new(self.name)?;
        let mut style = (self.begin)(&mut gl);
        for frame in 0..self.frames {
            style.draw(&mut gl, frame);
            gl.swap_buffers();
        }
        gl.finish()
    }
}
