//! What styles draw with: OpenGL's calls, and the truth that is kept beside them.

mod calls;
mod draws;
mod state;

use std::io;

use afterglow_api::constants::*;
use afterglow_api::id;
use afterglow_scene::Class;

use crate::truth::{FrameTruth, Label, TrueCamera, TrueLight, Truth};
pub use calls::{Arg, Calls};
pub use draws::{Attributes, List};
pub use state::Texture;

/// Width and height of the window, pixels.
pub const WINDOW: (i32, i32) = (320, 240);

/// What is drawn: its class and the number of the object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Thing {
    /// What it is.
    pub class: Class,
    /// Which it is, the same in all frames.
    pub object: u64,
}

/// A thing of that class.
pub fn thing(class: Class, object: u64) -> Thing {
    Thing { class, object }
}

/// A trace and what is true of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// A file that `afterglow replay` plays.
    pub trace: Vec<u8>,
    /// The truth of each of its frames.
    pub truth: Truth,
}

/// A program's OpenGL.
pub struct Client {
    calls: Calls,
    truth: Truth,
    frame: FrameTruth,
    textures: u32,
    lists: u32,
}

impl Client {
    /// The client of a style of that name.
    ///
    /// # Errors
    /// Never in fact: memory takes all that is written.
    pub fn new(style: &str) -> io::Result<Client> {
        let calls = Calls::new(style)?;
        let truth = Truth { style: style.into(), extent: 1.0, ..Truth::default() };
        let mut client = Client { calls, truth, frame: FrameTruth::default(), textures: 0, lists: 0 };
        client.viewport([0, 0, WINDOW.0, WINDOW.1]);
        client.enable(GL_DEPTH_TEST);
        client.depth_func(GL_LEQUAL);
        // The default material takes a fifth of it: sides in shadow are dark, not black.
        client.call(id::glLightModelfv, &[GL_LIGHT_MODEL_AMBIENT.into(), Arg::Floats(&[1.0; 4])]);
        Ok(client)
    }

    /// What was drawn.
    ///
    /// # Errors
    /// Never in fact: memory takes all that is written.
    pub fn finish(self) -> io::Result<Recording> {
        Ok(Recording { trace: self.calls.finish()?, truth: self.truth })
    }

    /// Writes any other call.
    pub fn call(&mut self, command: afterglow_api::CommandId, args: &[Arg]) {
        self.calls.call(command, args);
    }

    /// Says about how large the world is, in its units.
    pub fn set_extent(&mut self, extent: f64) {
        self.truth.extent = extent;
    }

    /// Says what light baked surfaces get alike.
    pub fn set_baked_ambient(&mut self, ambient: f32) {
        self.truth.baked_ambient = ambient;
    }

    /// Says that the frame shows a world from a camera.
    pub fn look(&mut self, world: u32, camera: TrueCamera) {
        self.frame.world = world;
        self.frame.camera = Some(camera);
    }

    /// Begins a frame that shows a world: says so, clears, sets the matrices, and switches textures on.
    pub fn begin_world(&mut self, world: u32, camera: TrueCamera) {
        self.look(world, camera);
        self.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        self.projection(camera.projection);
        self.modelview(camera.view);
        self.enable(GL_TEXTURE_2D);
    }

    /// Says that a light shines.
    pub fn shine(&mut self, light: TrueLight) {
        self.frame.lights.push(light);
    }

    /// Says that a draw that was written by [`call`](Self::call) has so many triangles.
    pub fn drawn(&mut self, thing: Thing, triangles: u64) {
        self.count(thing, triangles);
    }

    fn count(&mut self, Thing { class, object }: Thing, triangles: u64) {
        match self.frame.labels.last_mut() {
            Some(last) if (last.class, last.object) == (class, object) => last.triangles += triangles,
            _ if triangles == 0 => {}
            _ => self.frame.labels.push(Label { class, object, triangles }),
        }
    }

    /// Clears the buffers of a mask.
    pub fn clear(&mut self, mask: u32) {
        self.calls.call(id::glClear, &[mask.into()]);
    }

    /// Sets the colour that clears.
    pub fn clear_color(&mut self, [r, g, b]: [f32; 3]) {
        self.calls.call(id::glClearColor, &[r.into(), g.into(), b.into(), 1.0.into()]);
    }

    /// Shows the frame.
    pub fn swap_buffers(&mut self) {
        self.calls.swap_buffers();
        let world = self.frame.world;
        let next = FrameTruth { world, ..FrameTruth::default() };
        self.truth.frames.push(std::mem::replace(&mut self.frame, next));
    }
}
