//! Queries of lights, materials, texture units, client arrays (specification 6.1.3).

use afterglow_api::constants::*;

use crate::arrays::{COLOR_INDEX, EDGE_FLAG, Source};
use crate::context::Context;
use crate::frame::{LIGHTS, Slot, TEXTURE_UNITS};
use crate::get::Value;
use crate::texturing::{COMBINE_FUNCTIONS, COMBINE_OPERANDS, COMBINE_SOURCES, ENV_MODES, Textures};

fn fractions(values: &[f32]) -> Value {
    Value::Fractions(values.iter().map(|&v| v.into()).collect())
}

fn floats(values: &[f32]) -> Value {
    Value::Floats(values.iter().map(|&v| v.into()).collect())
}

fn name(value: u32) -> Value {
    Value::Ints(vec![value.into()])
}

impl Context {
    fn found(&mut self, value: Option<Value>) -> Option<Value> {
        if value.is_none() {
            self.record_error(GL_INVALID_ENUM);
        }
        value
    }

    /// glGetLight.
    pub fn get_light(&mut self, light: u32, pname: u32) -> Option<Value> {
        if self.refuses_in_begin() {
            return None;
        }
        let index = light.wrapping_sub(GL_LIGHT0) as usize;
        let value = self.state.lighting.lights.get(index).and_then(|light| {
            Some(match pname {
                GL_AMBIENT => fractions(&light.ambient),
                GL_DIFFUSE => fractions(&light.diffuse),
                GL_SPECULAR => fractions(&light.specular),
                GL_POSITION => floats(&light.position),
                GL_SPOT_DIRECTION => floats(&light.spot_direction),
                GL_SPOT_EXPONENT => floats(&[light.spot_exponent]),
                GL_SPOT_CUTOFF => floats(&[self.state.lighting.cutoffs[index.min(LIGHTS - 1)]]),
                GL_CONSTANT_ATTENUATION => floats(&light.attenuation[..1]),
                GL_LINEAR_ATTENUATION => floats(&light.attenuation[1..2]),
                GL_QUADRATIC_ATTENUATION => floats(&light.attenuation[2..]),
                _ => return None,
            })
        });
        self.found(value)
    }

    /// glGetMaterial.
    pub fn get_material(&mut self, face: u32, pname: u32) -> Option<Value> {
        if self.refuses_in_begin() {
            return None;
        }
        self.sync_color_material();
        let index = match face {
            GL_FRONT => 0,
            GL_BACK => 1,
            _ => return self.found(None),
        };
        let material = &self.state.lighting.material.faces[index];
        let value = match pname {
            GL_AMBIENT => Some(fractions(&material.ambient)),
            GL_DIFFUSE => Some(fractions(&material.diffuse)),
            GL_SPECULAR => Some(fractions(&material.specular)),
            GL_EMISSION => Some(fractions(&material.emission)),
            GL_SHININESS => Some(floats(&[material.shininess])),
            GL_COLOR_INDEXES => Some(floats(&self.state.lighting.color_indexes[index])),
            _ => None,
        };
        self.found(value)
    }

    /// glGetTexEnv.
    pub fn get_tex_env(&mut self, target: u32, pname: u32) -> Option<Value> {
        if self.refuses_in_begin() {
            return None;
        }
        let unit = &self.state.texture.units[self.state.texture.active];
        let words = unit.words;
        let source = |word: u32| match word {
            8.. => name(GL_TEXTURE0 + word - 8),
            4 => name(GL_ZERO),
            5 => name(GL_ONE),
            _ => name(
                COMBINE_SOURCES.iter().find(|(_, s)| *s as u32 == word).map_or(GL_PREVIOUS, |(gl, _)| *gl),
            ),
        };
        let function = |word: u32| {
            let found = COMBINE_FUNCTIONS.iter().find(|(_, f)| *f as u32 == word);
            name(found.map_or(GL_MODULATE, |(gl, _)| *gl))
        };
        let operand = |word: u32| name(COMBINE_OPERANDS[(word & 3) as usize]);
        let value = match (target, pname) {
            (GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR) => Some(fractions(&unit.env_color)),
            (GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE) => {
                let found = ENV_MODES.iter().find(|(_, mode)| *mode as u32 == words.env_mode());
                Some(name(found.map_or(GL_MODULATE, |(gl, _)| *gl)))
            }
            (GL_TEXTURE_ENV, GL_COMBINE_RGB) => Some(function(words.combine_rgb())),
            (GL_TEXTURE_ENV, GL_COMBINE_ALPHA) => Some(function(words.combine_alpha())),
            (GL_TEXTURE_ENV, GL_RGB_SCALE) => Some(floats(&[(1 << words.scale_rgb()) as f32])),
            (GL_TEXTURE_ENV, GL_ALPHA_SCALE) => Some(floats(&[(1 << words.scale_alpha()) as f32])),
            (GL_TEXTURE_ENV, GL_SOURCE0_RGB) => Some(source(words.source_rgb0())),
            (GL_TEXTURE_ENV, GL_SOURCE1_RGB) => Some(source(words.source_rgb1())),
            (GL_TEXTURE_ENV, GL_SOURCE2_RGB) => Some(source(words.source_rgb2())),
            (GL_TEXTURE_ENV, GL_SOURCE0_ALPHA) => Some(source(words.source_alpha0())),
            (GL_TEXTURE_ENV, GL_SOURCE1_ALPHA) => Some(source(words.source_alpha1())),
            (GL_TEXTURE_ENV, GL_SOURCE2_ALPHA) => Some(source(words.source_alpha2())),
            (GL_TEXTURE_ENV, GL_OPERAND0_RGB) => Some(operand(words.operand_rgb0())),
            (GL_TEXTURE_ENV, GL_OPERAND1_RGB) => Some(operand(words.operand_rgb1())),
            (GL_TEXTURE_ENV, GL_OPERAND2_RGB) => Some(operand(words.operand_rgb2())),
            (GL_TEXTURE_ENV, GL_OPERAND0_ALPHA) => Some(operand(words.operand_alpha0() + 2)),
            (GL_TEXTURE_ENV, GL_OPERAND1_ALPHA) => Some(operand(words.operand_alpha1() + 2)),
            (GL_TEXTURE_ENV, GL_OPERAND2_ALPHA) => Some(operand(words.operand_alpha2() + 2)),
            (GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS) => Some(floats(&[unit.lod_bias])),
            (GL_POINT_SPRITE_ARB, GL_COORD_REPLACE_ARB) => {
                Some(Value::Bools(vec![words.coord_replace() != 0]))
            }
            _ => None,
        };
        self.found(value)
    }

    /// glGetTexGen.
    pub fn get_tex_gen(&mut self, coord: u32, pname: u32) -> Option<Value> {
        if self.refuses_in_begin() {
            return None;
        }
        let unit = &self.state.texture.units[self.state.texture.active];
        let c = coord.wrapping_sub(GL_S) as usize;
        let value = match pname {
            _ if c > 3 => None,
            GL_TEXTURE_GEN_MODE => Some(name(unit.gen_mode[c])),
            GL_OBJECT_PLANE => Some(floats(&unit.gen_planes.object[c])),
            GL_EYE_PLANE => Some(floats(&unit.gen_planes.eye[c])),
            _ => None,
        };
        self.found(value)
    }

    /// glGetTexParameter.
    pub fn get_tex_parameter(&mut self, target: u32, pname: u32) -> Option<Value> {
        if self.refuses_in_begin() {
            return None;
        }
        let index = Textures::target_index(target);
        let bound = &self.textures.bound[self.state.texture.active];
        let value = index.and_then(|index| bound[index].1.lock().get_parameter(pname));
        self.found(value)
    }

    pub(crate) fn get_arrays(&self, pname: u32) -> Option<Value> {
        let client = &self.client;
        let texture = Slot::Texture0 as usize + client.active_texture;
        let bound = |slot: usize| match client.arrays[slot].source {
            Source::Buffer(buffer, ..) => name(buffer),
            _ => name(0),
        };
        let size = |slot: usize| Value::Ints(vec![client.arrays[slot].size.into()]);
        let kind = |slot: usize| name(client.arrays[slot].kind);
        let stride = |slot: usize| name(client.arrays[slot].stride);
        const POSITION: usize = Slot::Position as usize;
        const NORMAL: usize = Slot::Normal as usize;
        const COLOR: usize = Slot::Color as usize;
        const SECONDARY: usize = Slot::Secondary as usize;
        const FOG: usize = Slot::Fog as usize;
        Some(match pname {
            GL_VERTEX_ARRAY_SIZE => size(POSITION),
            GL_VERTEX_ARRAY_TYPE => kind(POSITION),
            GL_VERTEX_ARRAY_STRIDE => stride(POSITION),
            GL_NORMAL_ARRAY_TYPE => kind(NORMAL),
            GL_NORMAL_ARRAY_STRIDE => stride(NORMAL),
            GL_COLOR_ARRAY_SIZE => size(COLOR),
            GL_COLOR_ARRAY_TYPE => kind(COLOR),
            GL_COLOR_ARRAY_STRIDE => stride(COLOR),
            GL_SECONDARY_COLOR_ARRAY_SIZE => size(SECONDARY),
            GL_SECONDARY_COLOR_ARRAY_TYPE => kind(SECONDARY),
            GL_SECONDARY_COLOR_ARRAY_STRIDE => stride(SECONDARY),
            GL_FOG_COORDINATE_ARRAY_TYPE => kind(FOG),
            GL_FOG_COORDINATE_ARRAY_STRIDE => stride(FOG),
            GL_TEXTURE_COORD_ARRAY_SIZE => size(texture),
            GL_TEXTURE_COORD_ARRAY_TYPE => kind(texture),
            GL_TEXTURE_COORD_ARRAY_STRIDE => stride(texture),
            GL_EDGE_FLAG_ARRAY_STRIDE => stride(EDGE_FLAG),
            GL_INDEX_ARRAY_TYPE => kind(COLOR_INDEX),
            GL_INDEX_ARRAY_STRIDE => stride(COLOR_INDEX),
            GL_ARRAY_BUFFER_BINDING => name(client.array_buffer.as_ref().map_or(0, |(n, _)| *n)),
            GL_ELEMENT_ARRAY_BUFFER_BINDING => name(client.element_buffer.as_ref().map_or(0, |(n, _)| *n)),
            GL_VERTEX_ARRAY_BUFFER_BINDING => bound(POSITION),
            GL_NORMAL_ARRAY_BUFFER_BINDING => bound(NORMAL),
            GL_COLOR_ARRAY_BUFFER_BINDING => bound(COLOR),
            GL_SECONDARY_COLOR_ARRAY_BUFFER_BINDING => bound(SECONDARY),
            GL_FOG_COORDINATE_ARRAY_BUFFER_BINDING => bound(FOG),
            GL_TEXTURE_COORD_ARRAY_BUFFER_BINDING => bound(texture),
            GL_EDGE_FLAG_ARRAY_BUFFER_BINDING => bound(EDGE_FLAG),
            GL_INDEX_ARRAY_BUFFER_BINDING => bound(COLOR_INDEX),
            GL_ARRAY_ELEMENT_LOCK_FIRST_EXT => Value::Ints(vec![client.locked.map_or(0, |(f, _)| f.into())]),
            GL_ARRAY_ELEMENT_LOCK_COUNT_EXT => Value::Ints(vec![client.locked.map_or(0, |(_, c)| c.into())]),
            _ => return None,
        })
    }

    /// glGetPointer: the address that was given, or the offset in a buffer. `None` after an error.
    pub fn get_pointer(&mut self, pname: u32) -> Option<usize> {
        if self.refuses_in_begin() {
            return None;
        }
        let texture = Slot::Texture0 as usize + self.client.active_texture.min(TEXTURE_UNITS - 1);
        let slot = match pname {
            GL_VERTEX_ARRAY_POINTER => Slot::Position as usize,
            GL_NORMAL_ARRAY_POINTER => Slot::Normal as usize,
            GL_COLOR_ARRAY_POINTER => Slot::Color as usize,
            GL_SECONDARY_COLOR_ARRAY_POINTER => Slot::Secondary as usize,
            GL_FOG_COORDINATE_ARRAY_POINTER => Slot::Fog as usize,
            GL_TEXTURE_COORD_ARRAY_POINTER => texture,
            GL_EDGE_FLAG_ARRAY_POINTER => EDGE_FLAG,
            GL_INDEX_ARRAY_POINTER => COLOR_INDEX,
            GL_SELECTION_BUFFER_POINTER | GL_FEEDBACK_BUFFER_POINTER => return Some(0),
            _ => {
                self.record_error(GL_INVALID_ENUM);
                return None;
            }
        };
        Some(match &self.client.arrays[slot].source {
            Source::Null => 0,
            Source::Buffer(_, _, offset) => *offset as usize,
            Source::Memory(address) => *address,
            Source::Blob(bytes) => bytes.as_ptr() as usize,
        })
    }
}
