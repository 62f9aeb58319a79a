//! The styles: each a small program that draws as a kind of engine does.

mod batches;
mod billboards;
mod chase;
mod cpu_animation;
mod gl_lights;
mod hud_icons;
mod level_change;
mod lightmap_passes;
mod mirror;
mod multitexture;
mod one_matrix;
mod own_matrices;
mod planar_shadows;
mod resting_camera;
mod scrolling;
mod sky_box;
mod sky_dome;
mod view_in_projection;
mod weapon;

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
    Entry {
        name: "billboards",
        has: "trees, smoke and sparks that are turned to the camera",
        frames: 48,
        begin: |gl| Box::new(billboards::Billboards::begin(gl)),
    },
    Entry {
        name: "sky_dome",
        has: "a dome under the rotation of the view alone, before the world",
        frames: 48,
        begin: |gl| Box::new(sky_dome::SkyDome::begin(gl, false)),
    },
    Entry {
        name: "sky_dome_solid",
        has: "the same, drawn with depth as anything else",
        frames: 48,
        begin: |gl| Box::new(sky_dome::SkyDome::begin(gl, true)),
    },
    Entry {
        name: "sky_box",
        has: "a box about the eye in world coordinates, after the world at the far depth",
        frames: 48,
        begin: |gl| Box::new(sky_box::SkyBox::begin(gl)),
    },
    Entry {
        name: "hud_icons",
        has: "things in perspective in small viewports of the status bar",
        frames: 48,
        begin: |gl| Box::new(hud_icons::HudIcons::begin(gl)),
    },
    Entry {
        name: "weapon",
        has: "a weapon with its own field of view and depth range; a lightmap in arrays",
        frames: 48,
        begin: |gl| Box::new(weapon::Weapon::begin(gl)),
    },
    Entry {
        name: "chase",
        has: "a camera that follows a heavy car; wheels; a dome",
        frames: 48,
        begin: |gl| Box::new(chase::Chase::begin(gl, false)),
    },
    Entry {
        name: "chase_in_pieces",
        has: "the same, and a matrix for each piece of the ground",
        frames: 48,
        begin: |gl| Box::new(chase::Chase::begin(gl, true)),
    },
    Entry {
        name: "mirror",
        has: "a mirror: stencil, the room reflected, the floor blended",
        frames: 48,
        begin: |gl| Box::new(mirror::Mirror::begin(gl)),
    },
    Entry {
        name: "level_change",
        has: "a screen without a world, then another world",
        frames: 48,
        begin: |gl| Box::new(level_change::LevelChange::begin(gl)),
    },
    Entry {
        name: "gl_lights",
        has: "lamps by glLight that move",
        frames: 48,
        begin: |gl| Box::new(gl_lights::GlLights::begin(gl)),
    },
    Entry {
        name: "planar_shadows",
        has: "shadows flattened onto the floor",
        frames: 48,
        begin: |gl| Box::new(planar_shadows::PlanarShadows::begin(gl)),
    },
    Entry {
        name: "view_in_projection",
        has: "the view in the PROJECTION matrix",
        frames: 48,
        begin: |gl| Box::new(view_in_projection::ViewInProjection::begin(gl)),
    },
    Entry {
        name: "resting_camera",
        has: "a camera that rests, moves and rests again; a world that is scaled",
        frames: 60,
        begin: |gl| Box::new(resting_camera::RestingCamera::begin(gl)),
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
