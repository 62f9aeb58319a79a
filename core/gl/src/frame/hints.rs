//! What the program says of its draws and of the frame, by GL_AFTERGLOW_scene_hints, as plain data.

use super::TextureBinding;

/// What a draw is, as a program says it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum HintClass {
    /// Part of the world that never moves.
    Static,
    /// A rigid part of the world that moves.
    Movable,
    /// A part of the world whose vertices change.
    Dynamic,
    /// First-person weapon or hands.
    ViewModel,
    /// Blended over the world.
    Translucent,
    /// Behind everything.
    Sky,
    /// Menus, status bar.
    Interface,
    /// Drawn again over a surface of the world, to be part of it.
    Layer,
    /// Part of another view (mirror, picture in picture).
    OtherView,
    /// Not needed where rays make light: shadows, light flares.
    Dropped,
}

/// What is said of draws. Values that are `None` are not said.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Hint {
    /// The object that the draw is of; 0 is none.
    pub object: u64,
    pub class: Option<HintClass>,
    pub material: HintMaterial,
}

/// What is said of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HintMaterial {
    /// Perceptual roughness and metallic, each 0 to 1.
    pub roughness_metallic: Option<[f32; 2]>,
    /// Radiance, linear RGB; 1 is the white of a picture.
    pub emission: Option<[f32; 3]>,
    /// Albedo in place of the program's colours, linear RGB: of a scene file's surface. Such a surface is flat, and gives
    /// its emission off from its front side only.
    pub base_color: Option<[f32; 3]>,
    pub normal_map: Option<TextureBinding>,
    /// Roughness in green, metallic in blue.
    pub metallic_roughness_map: Option<TextureBinding>,
    pub emission_map: Option<TextureBinding>,
}

/// Where a light is and how it shines, in world space: the space that [`SceneHints::view`] takes to eye space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HintLightShape {
    /// A sphere.
    Point {
        position: [f32; 3],
        /// World units.
        radius: f32,
    },
    /// A sphere that shines into a cone.
    Spot {
        position: [f32; 3],
        /// World units.
        radius: f32,
        /// Unit vector along which it shines.
        direction: [f32; 3],
        /// Half the cone's angle, degrees, up to 90.
        cutoff: f32,
        /// As GL_SPOT_EXPONENT: the intensity's fall from the axis.
        exponent: f32,
    },
    /// Infinitely far.
    Directional {
        /// Unit vector along which it shines.
        direction: [f32; 3],
        /// Diameter as it is seen, degrees.
        angle: f32,
    },
}

/// A light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HintLight {
    /// The same from frame to frame; 0 if that is not said.
    pub id: u64,
    pub shape: HintLightShape,
    /// Linear RGB. Of a light with a place its radiant intensity: a white surface that faces it at distance d shows
    /// this over (pi d^2). Of a directional one its irradiance: such a surface shows this over pi.
    pub color: [f32; 3],
}

/// What is said of a frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SceneHints {
    /// The MODELVIEW matrix under which world space is drawn, by columns.
    pub view: Option<[[f32; 4]; 4]>,
    /// In the order in which they were first said; at most [`SceneHints::MOST_LIGHTS`].
    pub lights: Vec<HintLight>,
    /// Radiance of the sky, linear RGB.
    pub sky: Option<[f32; 3]>,
    /// Nothing of the frames before is seen any more: the camera has jumped.
    pub cut: bool,
}

impl SceneHints {
    /// Lights that a frame may have.
    pub const MOST_LIGHTS: usize = 256;

    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        self.view.is_none() && self.lights.is_empty() && self.sky.is_none() && !self.cut
    }

    /// Adds a light, in place of the one that had its id. `false`: there are too many.
    pub fn shine(&mut self, light: HintLight) -> bool {
        let known = self.lights.iter().position(|known| known.id == light.id && light.id != 0);
        match known {
            Some(index) => self.lights[index] = light,
            None if self.lights.len() < Self::MOST_LIGHTS => self.lights.push(light),
            None => return false,
        }
        true
    }

    /// Empties it and keeps its memory.
    pub fn clear(&mut self) {
        self.lights.clear();
        *self = SceneHints { lights: std::mem::take(&mut self.lights), ..SceneHints::default() };
    }

    /// Joins what a later part of the same frame says, which counts more. Lights beyond the most are left out.
    pub fn append(&mut self, later: &mut SceneHints) {
        self.view = later.view.or(self.view);
        self.sky = later.sky.or(self.sky);
        self.cut |= later.cut;
        for light in later.lights.drain(..) {
            self.shine(light);
        }
        later.clear();
    }
}
