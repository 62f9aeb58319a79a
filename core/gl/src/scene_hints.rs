//! GL_AFTERGLOW_scene_hints: what a program says of its scene. `gl-shim/include/afterglow.h` is its specification.
//!
//! What is said of draws is state that holds until it is changed, and that display lists may hold. What is said of the
//! frame holds until the buffer swap, and is executed at once while a list is compiled. No attribute group covers
//! either: glPushAttrib and glPopAttrib leave them as they are.

use afterglow_api::constants::*;
use glam::Vec3;

use crate::context::Context;
use crate::frame::{Hint, HintClass, HintLight, HintLightShape, HintMaterial, TextureBinding};
use crate::tables::Dirty;

/// What is said of the draws that follow; maps by the names of their textures.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Said {
    object: u64,
    class: Option<HintClass>,
    roughness_metallic: Option<[f32; 2]>,
    emission: Option<[f32; 3]>,
    normal_map: u32,
    metallic_roughness_map: u32,
    emission_map: u32,
}

impl Said {
    /// Whether textures are named.
    pub fn has_maps(&self) -> bool {
        self.normal_map | self.metallic_roughness_map | self.emission_map != 0
    }
}

/// The class of an enumerant; `Some(None)` for GL_NONE.
fn class_of(value: u32) -> Option<Option<HintClass>> {
    Some(Some(match value {
        GL_NONE => return Some(None),
        GL_SCENE_STATIC_AFTERGLOW => HintClass::Static,
        GL_SCENE_MOVABLE_AFTERGLOW => HintClass::Movable,
        GL_SCENE_DYNAMIC_AFTERGLOW => HintClass::Dynamic,
        GL_SCENE_VIEW_MODEL_AFTERGLOW => HintClass::ViewModel,
        GL_SCENE_TRANSLUCENT_AFTERGLOW => HintClass::Translucent,
        GL_SCENE_SKY_AFTERGLOW => HintClass::Sky,
        GL_SCENE_INTERFACE_AFTERGLOW => HintClass::Interface,
        GL_SCENE_LAYER_AFTERGLOW => HintClass::Layer,
        GL_SCENE_OTHER_VIEW_AFTERGLOW => HintClass::OtherView,
        GL_SCENE_DROPPED_AFTERGLOW => HintClass::Dropped,
        _ => return None,
    }))
}

/// Whether these are amounts of light.
fn are_amounts(values: &[f32]) -> bool {
    values.iter().all(|value| value.is_finite() && *value >= 0.0)
}

fn are_finite(values: &[f32]) -> bool {
    values.iter().all(|value| value.is_finite())
}

fn unit_vector(vector: [f32; 3]) -> Option<[f32; 3]> {
    Vec3::from_array(vector).try_normalize().map(|unit| unit.to_array())
}

impl Context {
    /// Changes what is said of draws.
    fn say(&mut self, change: impl FnOnce(&mut Said)) {
        let before = self.said;
        change(&mut self.said);
        if self.said != before {
            self.dirty(Dirty::HINT);
        }
    }

    pub(crate) fn exec_scene_object(&mut self, object: u64) {
        self.say(|said| said.object = object);
    }

    pub(crate) fn exec_scene_class(&mut self, class: u32) {
        match class_of(class) {
            Some(class) => self.say(|said| said.class = class),
            None => self.record_error(GL_INVALID_ENUM),
        }
    }

    pub(crate) fn exec_scene_material(&mut self, roughness: f32, metallic: f32) {
        let values = [roughness, metallic];
        if !values.iter().all(|value| (0.0..=1.0).contains(value)) {
            return self.record_error(GL_INVALID_VALUE);
        }
        self.say(|said| said.roughness_metallic = Some(values));
    }

    pub(crate) fn exec_scene_emission(&mut self, red: f32, green: f32, blue: f32) {
        let radiance = [red, green, blue];
        if !are_amounts(&radiance) {
            return self.record_error(GL_INVALID_VALUE);
        }
        self.say(|said| said.emission = Some(radiance));
    }

    pub(crate) fn exec_scene_map(&mut self, map: u32, texture: u32) {
        match map {
            GL_SCENE_NORMAL_MAP_AFTERGLOW => self.say(|said| said.normal_map = texture),
            GL_SCENE_METALLIC_ROUGHNESS_MAP_AFTERGLOW => {
                self.say(|said| said.metallic_roughness_map = texture);
            }
            GL_SCENE_EMISSION_MAP_AFTERGLOW => self.say(|said| said.emission_map = texture),
            _ => self.record_error(GL_INVALID_ENUM),
        }
    }

    pub(crate) fn exec_scene_defaults(&mut self) {
        self.say(|said| *said = Said::default());
    }

    /// glSceneViewAFTERGLOW: the MODELVIEW matrix is the frame's view. GL_INVALID_OPERATION if it is singular.
    pub fn scene_view(&mut self) {
        if self.refuses_in_begin() {
            return;
        }
        let view = self.matrices.modelview.top();
        let is_sound = view.is_finite() && view.determinant().abs() > f32::MIN_POSITIVE;
        if !is_sound {
            return self.record_error(GL_INVALID_OPERATION);
        }
        self.frame.scene_hints.view = Some(view.to_cols_array_2d());
    }

    /// glScenePointLightAFTERGLOW.
    pub fn scene_point_light(&mut self, id: u64, position: [f32; 3], intensity: [f32; 3], radius: f32) {
        let is_sound = are_finite(&position) && are_amounts(&[radius]);
        let shape = is_sound.then_some(HintLightShape::Point { position, radius });
        self.shine(id, shape, intensity);
    }

    /// glSceneSpotLightAFTERGLOW.
    #[expect(clippy::too_many_arguments, reason = "the command has so many")]
    pub fn scene_spot_light(
        &mut self,
        id: u64,
        position: [f32; 3],
        direction: [f32; 3],
        intensity: [f32; 3],
        radius: f32,
        cutoff: f32,
        exponent: f32,
    ) {
        let is_sound = are_finite(&position)
            && are_amounts(&[radius])
            && (0.0..=90.0).contains(&cutoff)
            && (0.0..=128.0).contains(&exponent);
        let direction = unit_vector(direction).filter(|_| is_sound);
        let shape =
            direction.map(|direction| HintLightShape::Spot { position, radius, direction, cutoff, exponent });
        self.shine(id, shape, intensity);
    }

    /// glSceneDirectionalLightAFTERGLOW.
    pub fn scene_directional_light(
        &mut self,
        id: u64,
        direction: [f32; 3],
        irradiance: [f32; 3],
        angle: f32,
    ) {
        let direction = unit_vector(direction).filter(|_| (0.0..=90.0).contains(&angle));
        let shape = direction.map(|direction| HintLightShape::Directional { direction, angle });
        self.shine(id, shape, irradiance);
    }

    /// Adds a light to the frame; without a shape its parameters were wrong.
    fn shine(&mut self, id: u64, shape: Option<HintLightShape>, color: [f32; 3]) {
        if self.refuses_in_begin() {
            return;
        }
        let Some(shape) = shape.filter(|_| are_amounts(&color)) else {
            return self.record_error(GL_INVALID_VALUE);
        };
        if !self.frame.scene_hints.shine(HintLight { id, shape, color }) {
            self.record_error(GL_OUT_OF_MEMORY);
        }
    }

    /// glSceneSkyAFTERGLOW.
    pub fn scene_sky(&mut self, red: f32, green: f32, blue: f32) {
        if self.refuses_in_begin() {
            return;
        }
        let radiance = [red, green, blue];
        match are_amounts(&radiance) {
            true => self.frame.scene_hints.sky = Some(radiance),
            false => self.record_error(GL_INVALID_VALUE),
        }
    }

    /// glSceneCutAFTERGLOW.
    pub fn scene_cut(&mut self) {
        if !self.refuses_in_begin() {
            self.frame.scene_hints.cut = true;
        }
    }

    /// Writes what is said to the frame's table; what draws name it by: 0 if nothing is said.
    pub(crate) fn write_hint(&mut self) -> u32 {
        let said = self.said;
        if said == Said::default() {
            return 0;
        }
        let hint = Hint {
            object: said.object,
            class: said.class,
            material: HintMaterial {
                roughness_metallic: said.roughness_metallic,
                emission: said.emission,
                base_color: None,
                normal_map: self.map(said.normal_map),
                metallic_roughness_map: self.map(said.metallic_roughness_map),
                emission_map: self.map(said.emission_map),
            },
        };
        if self.frame.hints.last() != Some(&hint) {
            self.frame.hints.push(hint);
        }
        self.frame.hints.len() as u32
    }

    /// The image of a two-dimensional texture; none if the name is not that of one, or it is incomplete.
    fn map(&mut self, name: u32) -> Option<TextureBinding> {
        let texture = self.shared.lock().textures.get(&name).cloned().flatten()?;
        let mut texture = texture.lock();
        if texture.target() != GL_TEXTURE_2D {
            return None;
        }
        let image = texture.realize(&mut self.frame.operations)?;
        Some(TextureBinding { image: image.image, sampler: texture.sampler() })
    }
}
