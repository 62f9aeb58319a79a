//! The styles: each a small program that draws as a kind of engine does.

mod alike_plants;
mod baked_room;
mod batches;
mod billboards;
mod buffers;
mod chase;
mod cpu_animation;
mod cuts;
mod doors;
mod gl_lights;
mod glow_layers;
mod hud_icons;
mod left_handed;
mod level_change;
mod lightmap_passes;
mod looking_back;
mod many_objects;
mod mirror;
mod multitexture;
mod one_matrix;
mod other_views;
mod own_matrices;
mod planar_shadows;
mod resting_camera;
mod scrolling;
mod shadow_volumes;
mod sky_box;
mod sky_dome;
mod split_screen;
mod view_in_projection;
mod weapon;
mod zoom;

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
    Entry {
        name: "cuts",
        has: "a camera that cuts about one world; crates that are elsewhere at once",
        frames: 48,
        begin: |gl| Box::new(cuts::Cuts::begin(gl)),
    },
    Entry {
        name: "shadow_volumes",
        has: "shadow volumes in the stencil; marks with an offset of depth",
        frames: 48,
        begin: |gl| Box::new(shadow_volumes::ShadowVolumes::begin(gl)),
    },
    Entry {
        name: "glow_layers",
        has: "detail on the second unit, an added glow, a sheen by sphere mapping",
        frames: 48,
        begin: |gl| Box::new(glow_layers::GlowLayers::begin(gl)),
    },
    Entry {
        name: "other_views",
        has: "the faces of a cube map before the main view, a rear view after it",
        frames: 48,
        begin: |gl| Box::new(other_views::OtherViews::begin(gl)),
    },
    Entry {
        name: "buffers",
        has: "interleaved vertices in one buffer of which a part is filled anew; indices",
        frames: 48,
        begin: |gl| Box::new(buffers::Buffers::begin(gl)),
    },
    Entry {
        name: "left_handed",
        has: "w = +z, an infinite far plane, a frustum that is off centre",
        frames: 48,
        begin: |gl| Box::new(left_handed::LeftHanded::begin(gl, false)),
    },
    Entry {
        name: "mirrored_view",
        has: "the same, and a reflection in the view",
        frames: 48,
        begin: |gl| Box::new(left_handed::LeftHanded::begin(gl, true)),
    },
    Entry {
        name: "zoom",
        has: "a field of view that changes with each frame",
        frames: 48,
        begin: |gl| Box::new(zoom::Zoom::begin(gl)),
    },
    Entry {
        name: "doors",
        has: "doors, a lift that rests often, a bridge that is destroyed",
        frames: 48,
        begin: |gl| Box::new(doors::Doors::begin(gl)),
    },
    Entry {
        name: "many_objects",
        has: "two thousand matrices, one in ten moves",
        frames: 48,
        begin: |gl| Box::new(many_objects::ManyObjects::begin(gl)),
    },
    Entry {
        name: "looking_back",
        has: "a camera that turns round on the spot and back",
        frames: 48,
        begin: |gl| Box::new(looking_back::LookingBack::begin(gl)),
    },
    Entry {
        name: "baked_room",
        has: "a lightmap that is baked as light goes: inverse squares, cosines, shadows",
        frames: 48,
        begin: |gl| Box::new(baked_room::BakedRoom::begin(gl)),
    },
    Entry {
        name: "blocks_with_alike_plants",
        has: "blocks with matrices of their own and alike plants at other places in each; alike posts in one batch",
        frames: 60,
        begin: |gl| Box::new(alike_plants::AlikePlants::begin(gl)),
    },
    Entry {
        name: "split_screen",
        has: "two players, each with half of the window",
        frames: 48,
        begin: |gl| Box::new(split_screen::SplitScreen::begin(gl)),
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
