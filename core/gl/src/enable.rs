//! glEnable, glDisable, glIsEnabled.

use afterglow_api::constants::*;

use crate::context::Context;
use crate::frame::{CLIP_PLANES, LIGHTS};
use crate::state::{Cap, TARGETS};
use crate::tables::Dirty;

/// A capability, wherever its flag is kept.
enum Place {
    Flag(Cap),
    Light(usize),
    ClipPlane(usize),
    /// Texture target of the active unit.
    Texture(usize),
    /// Texture generation of a coordinate of the active unit.
    Generate(usize),
}

fn place(cap: u32) -> Option<Place> {
    const LIGHT_END: u32 = GL_LIGHT0 + LIGHTS as u32;
    const CLIP_END: u32 = GL_CLIP_PLANE0 + CLIP_PLANES as u32;
    Some(match cap {
        GL_LIGHT0..LIGHT_END => Place::Light((cap - GL_LIGHT0) as usize),
        GL_CLIP_PLANE0..CLIP_END => Place::ClipPlane((cap - GL_CLIP_PLANE0) as usize),
        GL_TEXTURE_GEN_S..=GL_TEXTURE_GEN_Q => Place::Generate((cap - GL_TEXTURE_GEN_S) as usize),
        _ => match TARGETS.iter().position(|&target| target == cap) {
            Some(target) => Place::Texture(target),
            None => Place::Flag(Cap::from_gl(cap)?),
        },
    })
}

fn set_bit(bits: &mut u8, bit: usize, on: bool) {
    *bits = *bits & !(1 << bit) | u8::from(on) << bit;
}

impl Context {
    pub(crate) fn exec_enable(&mut self, cap: u32) {
        self.switch(cap, true);
    }

    pub(crate) fn exec_disable(&mut self, cap: u32) {
        self.switch(cap, false);
    }

    fn switch(&mut self, cap: u32, on: bool) {
        let active = self.state.texture.active;
        match place(cap) {
            None => self.record_error(GL_INVALID_ENUM),
            Some(Place::Light(light)) => {
                set_bit(&mut self.state.lighting.enabled, light, on);
                self.dirty(Dirty::WORDS);
            }
            Some(Place::ClipPlane(plane)) => {
                set_bit(&mut self.state.transform.clip_enabled, plane, on);
                self.dirty(Dirty::WORDS);
            }
            Some(Place::Texture(target)) => {
                let before = self.state.texture.units[active].targets;
                set_bit(&mut self.state.texture.units[active].targets, target, on);
                if self.state.texture.units[active].targets != before {
                    self.dirty(Dirty::BINDINGS);
                }
            }
            Some(Place::Generate(coordinate)) => {
                set_bit(&mut self.state.texture.units[active].gen_enabled, coordinate, on);
                self.dirty(Dirty::WORDS);
            }
            Some(Place::Flag(cap)) => self.switch_flag(cap, on),
        }
    }

    fn switch_flag(&mut self, cap: Cap, on: bool) {
        if cap == Cap::ColorMaterial && !on {
            self.sync_color_material();
        }
        if !self.state.caps.set(cap, on) {
            return;
        }
        match cap {
            Cap::ScissorTest => self.dirty(Dirty::VIEWPORT),
            Cap::RescaleNormal | Cap::Normalize => self.dirty(Dirty::WORDS | Dirty::TRANSFORM),
            Cap::Blend
            | Cap::ColorLogicOp
            | Cap::CullFace
            | Cap::DepthTest
            | Cap::LineStipple
            | Cap::PolygonOffsetFill
            | Cap::PolygonOffsetLine
            | Cap::PolygonOffsetPoint
            | Cap::StencilTest => self.dirty(Dirty::RASTER),
            _ => self.dirty(Dirty::WORDS),
        }
    }

    /// glIsEnabled; `None` (and an error) for what is no capability.
    pub fn is_enabled(&mut self, cap: u32) -> bool {
        if self.refuses_in_begin() {
            return false;
        }
        let unit = &self.state.texture.units[self.state.texture.active];
        let bit = |bits: u8, bit: usize| bits & (1 << bit) != 0;
        match place(cap) {
            Some(Place::Flag(cap)) => self.state.caps.has(cap),
            Some(Place::Light(light)) => bit(self.state.lighting.enabled, light),
            Some(Place::ClipPlane(plane)) => bit(self.state.transform.clip_enabled, plane),
            Some(Place::Texture(target)) => bit(unit.targets, target),
            Some(Place::Generate(coordinate)) => bit(unit.gen_enabled, coordinate),
            None => match self.client.slot_of(cap) {
                Some(slot) => self.client.arrays[slot].enabled,
                None => {
                    self.record_error(GL_INVALID_ENUM);
                    false
                }
            },
        }
    }
}
