//! Rasterization and per-fragment state (specification chapters 3 and 4), clears, hints.

use afterglow_api::constants::*;
use glam::{DMat4, DVec4};

use crate::context::Context;
use crate::frame::{self, CLIP_PLANES, Operation, Rect};
use crate::limits;
use crate::pixel::{Extent, PixelLayout, PixelSource, unpack_mask};
use crate::pixels::RenderMode;
use crate::state::{Cap, HINTS};
use crate::tables::Dirty;

fn unit(value: f32) -> f32 {
    value.clamp(0.0, 1.0)
}

fn is_compare(func: u32) -> bool {
    (GL_NEVER..=GL_ALWAYS).contains(&func)
}

fn is_factor(factor: u32, source: bool) -> bool {
    match factor {
        GL_ZERO | GL_ONE => true,
        GL_SRC_ALPHA_SATURATE => source,
        _ => {
            (GL_SRC_COLOR..=GL_ONE_MINUS_DST_COLOR).contains(&factor)
                || (GL_CONSTANT_COLOR..=GL_ONE_MINUS_CONSTANT_ALPHA).contains(&factor)
        }
    }
}

macro_rules! require {
    ($self:ident, $condition:expr, $error:expr) => {
        match $condition {
            true => {}
            false => return $self.record_error($error),
        }
    };
}

impl Context {
    pub(crate) fn exec_alpha_func(&mut self, func: u32, reference: f32) {
        require!(self, is_compare(func), GL_INVALID_ENUM);
        (self.state.color.alpha_func, self.state.color.alpha_reference) = (func, unit(reference));
        self.dirty(Dirty::WORDS | Dirty::ENVIRONMENT);
    }

    pub(crate) fn exec_blend_color(&mut self, red: f32, green: f32, blue: f32, alpha: f32) {
        self.state.color.blend_color = [red, green, blue, alpha].map(unit);
        self.dirty(Dirty::RASTER);
    }

    pub(crate) fn exec_blend_equation(&mut self, mode: u32) {
        let modes = [GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX];
        require!(self, modes.contains(&mode), GL_INVALID_ENUM);
        self.state.color.equation = [mode; 2];
        self.dirty(Dirty::RASTER);
    }

    pub(crate) fn exec_blend_func(&mut self, source: u32, destination: u32) {
        self.exec_blend_func_separate(source, destination, source, destination);
    }

    pub(crate) fn exec_blend_func_separate(&mut self, sc: u32, dc: u32, sa: u32, da: u32) {
        let legal =
            is_factor(sc, true) && is_factor(sa, true) && is_factor(dc, false) && is_factor(da, false);
        require!(self, legal, GL_INVALID_ENUM);
        let blend = [[sc, dc], [sa, da]];
        if self.state.color.blend != blend {
            self.state.color.blend = blend;
            self.dirty(Dirty::RASTER);
        }
    }

    pub(crate) fn exec_color_mask(&mut self, red: bool, green: bool, blue: bool, alpha: bool) {
        self.state.color.mask = [red, green, blue, alpha];
        self.dirty(Dirty::RASTER);
    }

    pub(crate) fn exec_index_mask(&mut self, mask: u32) {
        self.state.color.index_mask = mask;
    }

    pub(crate) fn exec_cull_face(&mut self, face: u32) {
        require!(self, matches!(face, GL_FRONT | GL_BACK | GL_FRONT_AND_BACK), GL_INVALID_ENUM);
        if self.state.polygon.cull_face != face {
            self.state.polygon.cull_face = face;
            self.dirty(Dirty::RASTER);
        }
    }

    pub(crate) fn exec_front_face(&mut self, mode: u32) {
        require!(self, matches!(mode, GL_CW | GL_CCW), GL_INVALID_ENUM);
        self.state.polygon.front_face = mode;
        self.dirty(Dirty::RASTER);
    }

    pub(crate) fn exec_polygon_mode(&mut self, face: u32, mode: u32) {
        let faces = crate::lighting::face_indices(face);
        require!(self, matches!(mode, GL_POINT | GL_LINE | GL_FILL), GL_INVALID_ENUM);
        let Some(faces) = faces else { return self.record_error(GL_INVALID_ENUM) };
        faces.iter().for_each(|&face| self.state.polygon.mode[face] = mode);
        self.dirty(Dirty::RASTER);
    }

    pub(crate) fn exec_polygon_offset(&mut self, factor: f32, units: f32) {
        self.state.polygon.offset = (factor, units);
        self.dirty(Dirty::RASTER);
    }

    pub(crate) fn exec_depth_func(&mut self, func: u32) {
        require!(self, is_compare(func), GL_INVALID_ENUM);
        if self.state.depth.func != func {
            self.state.depth.func = func;
            self.dirty(Dirty::RASTER);
        }
    }

    pub(crate) fn exec_depth_mask(&mut self, write: bool) {
        if self.state.depth.mask != write {
            self.state.depth.mask = write;
            self.dirty(Dirty::RASTER);
        }
    }

    pub(crate) fn exec_depth_range(&mut self, near: f64, far: f64) {
        self.state.viewport.depth_range = [near.clamp(0.0, 1.0), far.clamp(0.0, 1.0)];
        self.dirty(Dirty::VIEWPORT);
    }

    pub(crate) fn exec_viewport(&mut self, x: i32, y: i32, width: i32, height: i32) {
        require!(self, width >= 0 && height >= 0, GL_INVALID_VALUE);
        let (width, height) = (width.min(limits::VIEWPORT), height.min(limits::VIEWPORT));
        self.state.viewport.rect = Rect { x, y, width, height };
        self.dirty(Dirty::VIEWPORT);
    }

    pub(crate) fn exec_scissor(&mut self, x: i32, y: i32, width: i32, height: i32) {
        require!(self, width >= 0 && height >= 0, GL_INVALID_VALUE);
        self.state.scissor = Rect { x, y, width, height };
        self.dirty(Dirty::VIEWPORT);
    }

    pub(crate) fn exec_stencil_func(&mut self, func: u32, reference: i32, mask: u32) {
        require!(self, is_compare(func), GL_INVALID_ENUM);
        let stencil = &mut self.state.stencil;
        (stencil.func, stencil.reference, stencil.value_mask) = (func, reference, mask);
        self.dirty(Dirty::RASTER);
    }

    pub(crate) fn exec_stencil_op(&mut self, fail: u32, depth_fail: u32, pass: u32) {
        let ops = [fail, depth_fail, pass];
        let known = [GL_KEEP, GL_ZERO, GL_REPLACE, GL_INCR, GL_DECR, GL_INVERT, GL_INCR_WRAP, GL_DECR_WRAP];
        require!(self, ops.iter().all(|op| known.contains(op)), GL_INVALID_ENUM);
        self.state.stencil.ops = ops;
        self.dirty(Dirty::RASTER);
    }

    pub(crate) fn exec_stencil_mask(&mut self, mask: u32) {
        self.state.stencil.write_mask = mask;
        self.dirty(Dirty::RASTER);
    }

    pub(crate) fn exec_logic_op(&mut self, op: u32) {
        require!(self, (GL_CLEAR..=GL_SET).contains(&op), GL_INVALID_ENUM);
        self.state.color.logic_op = op;
        self.dirty(Dirty::RASTER);
    }

    pub(crate) fn exec_line_width(&mut self, width: f32) {
        require!(self, width > 0.0, GL_INVALID_VALUE);
        self.state.line.width = width;
        self.dirty(Dirty::RASTER | Dirty::ENVIRONMENT);
    }

    pub(crate) fn exec_line_stipple(&mut self, factor: i32, pattern: u16) {
        let line = &mut self.state.line;
        (line.stipple_factor, line.stipple_pattern) = (factor.clamp(1, 256) as u16, pattern);
        self.dirty(Dirty::RASTER);
    }

    pub(crate) fn exec_draw_buffer(&mut self, buffer: u32) {
        match buffer {
            GL_NONE
            | GL_FRONT_LEFT
            | GL_BACK_LEFT
            | GL_FRONT
            | GL_BACK
            | GL_LEFT
            | GL_FRONT_AND_BACK
            | GL_FRONT_RIGHT
            | GL_BACK_RIGHT
            | GL_RIGHT
            | GL_AUX0..=GL_AUX3 => {
                if self.has_buffer(buffer) {
                    self.note_draw_buffer();
                    self.state.color.draw_buffer = buffer;
                    self.dirty(Dirty::RASTER);
                }
            }
            _ => self.record_error(GL_INVALID_ENUM),
        }
    }

    pub(crate) fn exec_hint(&mut self, target: u32, mode: u32) {
        require!(self, matches!(mode, GL_FASTEST | GL_NICEST | GL_DONT_CARE), GL_INVALID_ENUM);
        match HINTS.iter().position(|&hint| hint == target) {
            Some(hint) => self.state.hints[hint] = mode,
            None => self.record_error(GL_INVALID_ENUM),
        }
    }

    pub(crate) fn exec_sample_coverage(&mut self, _value: f32, _invert: bool) {
        // Without multisample buffers the coverage value has no effect.
    }

    pub(crate) fn exec_clip_plane(&mut self, plane: u32, equation: [f64; 4]) {
        let index = plane.wrapping_sub(GL_CLIP_PLANE0) as usize;
        require!(self, index < CLIP_PLANES, GL_INVALID_ENUM);
        // Specification 2.12: multiplied from the right by the inverse of the modelview matrix.
        let modelview: DMat4 = self.matrices.modelview.top().as_dmat4();
        let plane = DVec4::from_array(equation);
        let inverse = modelview.inverse();
        let eye = if inverse.is_finite() { inverse.transpose() * plane } else { plane };
        self.state.transform.clip_planes[index] = eye.to_array();
        self.dirty(Dirty::CLIP_PLANES);
    }

    pub(crate) fn exec_clear_color(&mut self, red: f32, green: f32, blue: f32, alpha: f32) {
        self.state.color.clear = [red, green, blue, alpha].map(unit);
    }

    pub(crate) fn exec_clear_depth(&mut self, depth: f64) {
        self.state.depth.clear = depth.clamp(0.0, 1.0);
    }

    pub(crate) fn exec_clear_stencil(&mut self, value: i32) {
        self.state.stencil.clear = value;
    }

    pub(crate) fn exec_clear_index(&mut self, index: f32) {
        self.state.color.clear_index = index;
    }

    pub(crate) fn exec_clear_accum(&mut self, red: f32, green: f32, blue: f32, alpha: f32) {
        self.state.accum_clear = [red, green, blue, alpha].map(|v| v.clamp(-1.0, 1.0));
    }

    pub(crate) fn exec_clear(&mut self, mask: u32) {
        const ALL: u32 =
            GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_ACCUM_BUFFER_BIT;
        require!(self, mask & !ALL == 0, GL_INVALID_VALUE);
        if self.mode != RenderMode::Render {
            return;
        }
        let state = &self.state;
        let color_mask = self.color_mask_bits();
        let color = mask & GL_COLOR_BUFFER_BIT != 0 && color_mask != 0;
        let depth = mask & GL_DEPTH_BUFFER_BIT != 0 && state.depth.mask;
        let stencil = mask & GL_STENCIL_BUFFER_BIT != 0;
        if color || depth || stencil {
            self.frame.operations.push(Operation::Clear(frame::Clear {
                color: color.then_some(state.color.clear),
                color_mask,
                depth: depth.then_some(state.depth.clear as f32),
                stencil: stencil
                    .then_some((state.stencil.clear as u32 & 255, state.stencil.write_mask & 255)),
                scissor: state.caps.has(Cap::ScissorTest).then_some(state.scissor),
            }));
        }
        if mask & GL_ACCUM_BUFFER_BIT != 0 {
            self.frame.operations.push(Operation::ClearAccumulation(self.state.accum_clear));
        }
    }

    /// glPolygonStipple, the pattern as it is in memory under the default pixel store.
    pub fn polygon_stipple(&mut self, pattern: &[u8]) {
        self.polygon_stipple_pattern(pattern.into());
    }

    /// glPolygonStipple of a bitmap in the program's memory, which lies there as glPixelStore says.
    pub fn polygon_stipple_image(&mut self, data: &[u8]) {
        let packing = self.stacks.pixel_store.unpack;
        let bits = PixelLayout::from_gl(GL_COLOR_INDEX, GL_BITMAP)
            .and_then(|layout| PixelSource::new(data, layout, &packing, Extent::plane(32, 32)))
            .and_then(|source| unpack_mask(&source));
        match bits {
            Ok(bits) => {
                let bytes = bits.as_chunks::<8>().0.iter();
                let pattern: Vec<u8> =
                    bytes.map(|bits| bits.iter().fold(0, |byte, bit| byte << 1 | bit)).collect();
                self.polygon_stipple(&pattern);
            }
            Err(error) => self.record_error(error),
        }
    }

    pub(crate) fn exec_polygon_stipple(&mut self, pattern: std::sync::Arc<[u8]>) {
        if let Some(pattern) = pattern.first_chunk::<128>() {
            self.state.polygon_stipple = *pattern;
            self.dirty(Dirty::ENVIRONMENT);
        }
    }

    pub(crate) fn exec_list_base(&mut self, base: u32) {
        self.state.list_base = base;
    }
}
