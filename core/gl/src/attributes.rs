//! Current attributes, Begin and End.

use std::panic::{AssertUnwindSafe, catch_unwind};

use afterglow_api::constants::*;
use glam::Vec4;

use crate::assemble::{self, PolygonMode};
use crate::context::{Context, Params};
use crate::frame::{Slot, TEXTURE_UNITS};
use crate::params::Values;

impl Context {
    /// glBegin.
    pub fn begin(&mut self, mode: u32) {
        if !assemble::is_mode(mode) {
            return self.record_error(GL_INVALID_ENUM);
        }
        if self.refuses_in_begin() {
            return;
        }
        let edges = self.list.is_some() || self.effective_polygon_mode() != PolygonMode::Fill;
        self.immediate.begin(mode, edges);
    }

    /// glEnd.
    pub fn end(&mut self) {
        let Some(mode) = self.immediate.end() else {
            return self.record_error(GL_INVALID_OPERATION);
        };
        if self.list.is_some() {
            return self.end_in_list(mode);
        }
        self.draw_immediate(mode);
    }

    /// Draws what Begin and End have gathered.
    pub(crate) fn draw_immediate(&mut self, mode: u32) {
        let (buffer, used) = self.immediate.take();
        let edges = self.immediate.edges.take();
        self.emit_primitive(mode, self.immediate.layout, &buffer[..used], edges.as_deref());
        self.immediate.give_back(buffer);
    }

    /// glVertex.
    // Components are moved one by one: an array that some path needs in memory would go through it on all of them.
    #[inline(always)]
    pub fn vertex(&mut self, [x, y, z, w]: [f32; 4]) {
        if !self.immediate.push_quickly([x, y, z, w], &self.state.current.attributes) {
            self.long_vertex(x, y, z, w);
        }
    }

    /// A vertex the long way. Outside of Begin and End it counts only in a list that may be called inside.
    #[cold]
    extern "C" fn long_vertex(&mut self, x: f32, y: f32, z: f32, w: f32) {
        self.contained(|gl| {
            let (position, edge) = ([x, y, z, w], gl.state.current.edge_flag);
            match &mut gl.list {
                Some(list) if gl.immediate.mode.is_none() => list.loose_vertex(position),
                Some(list) => gl.immediate.push(position, list.edge(), list.inside()),
                None if gl.immediate.mode.is_none() => {}
                None => gl.immediate.push(position, edge, &gl.state.current.attributes),
            }
        });
    }

    /// Lets no panic out: then those that call the long way need no landing pad, and can go there by a jump.
    fn contained(&mut self, work: impl FnOnce(&mut Self)) {
        if catch_unwind(AssertUnwindSafe(|| work(self))).is_err() {
            tracing::error!("a bug in Afterglow: a vertex was dropped");
            self.record_error(GL_INVALID_OPERATION);
        }
    }

    /// All other attributes of vertices, by [`Slot`].
    #[inline(always)]
    pub fn attribute(&mut self, slot: usize, [x, y, z, w]: [f32; 4]) {
        if !self.immediate.is_quick(slot, [x, y, z, w]) {
            return self.long_attribute(slot, x, y, z, w);
        }
        self.set_current(slot, [x, y, z, w]);
    }

    /// An attribute the long way: the first of a primitive, a wider one, or one that a list takes note of.
    #[cold]
    extern "C" fn long_attribute(&mut self, slot: usize, x: f32, y: f32, z: f32, w: f32) {
        self.contained(|gl| {
            let value = [x, y, z, w];
            gl.immediate.admit(slot, value, gl.state.current.attributes[slot].to_array());
            if let Some(list) = &mut gl.list {
                list.attribute(slot, value, gl.immediate.mode.is_some());
                if !list.executes {
                    return;
                }
            }
            gl.set_current(slot, value);
        });
    }

    #[inline(always)]
    pub(crate) fn set_current(&mut self, slot: usize, [x, y, z, w]: [f32; 4]) {
        self.state.current.attributes[slot] = Vec4::new(x, y, z, w);
        self.tables.changed[slot] = true;
    }

    /// glColor.
    #[inline]
    pub fn color(&mut self, color: [f32; 4]) {
        self.attribute(Slot::Color as usize, color);
    }

    /// glSecondaryColor.
    pub fn secondary_color(&mut self, color: [f32; 4]) {
        self.attribute(Slot::Secondary as usize, [color[0], color[1], color[2], 1.0]);
    }

    /// glNormal.
    #[inline]
    pub fn normal(&mut self, [x, y, z]: [f32; 3]) {
        self.attribute(Slot::Normal as usize, [x, y, z, 0.0]);
    }

    /// glFogCoord.
    pub fn fog_coord(&mut self, coordinate: f32) {
        self.attribute(Slot::Fog as usize, [coordinate, 0.0, 0.0, 1.0]);
    }

    /// glTexCoord.
    #[inline]
    pub fn tex_coord(&mut self, coordinates: [f32; 4]) {
        self.attribute(Slot::Texture0 as usize, coordinates);
    }

    /// glMultiTexCoord.
    #[inline]
    pub fn multi_tex_coord(&mut self, target: u32, coordinates: [f32; 4]) {
        match target.wrapping_sub(GL_TEXTURE0) as usize {
            unit if unit < TEXTURE_UNITS => self.attribute(Slot::Texture0 as usize + unit, coordinates),
            _ => self.record_error(GL_INVALID_ENUM),
        }
    }

    /// glEdgeFlag.
    pub fn edge_flag(&mut self, flag: bool) {
        if let Some(list) = &mut self.list {
            list.edge_flag(flag, self.immediate.mode.is_some());
            if !list.executes {
                return;
            }
        }
        self.state.current.edge_flag = flag;
    }

    /// glIndex.
    pub fn index(&mut self, index: f32) {
        if let Some(list) = &mut self.list {
            list.index(index);
            if !list.executes {
                return;
            }
        }
        self.state.current.index = index;
    }

    /// glRect (specification 2.10).
    pub fn rect(&mut self, [x1, y1]: [f32; 2], [x2, y2]: [f32; 2]) {
        if self.in_begin() {
            return self.refuse();
        }
        self.begin(GL_POLYGON);
        for [x, y] in [[x1, y1], [x2, y1], [x2, y2], [x1, y2]] {
            self.vertex([x, y, 0.0, 1.0]);
        }
        self.end();
    }

    /// glMaterial. Inside Begin and End it holds from the vertices to come.
    pub fn material(&mut self, face: u32, pname: u32, params: Params) {
        let values = Values::new(params);
        if let Some(list) = &mut self.list {
            list.material(face, pname, values);
            if !list.executes {
                return;
            }
        }
        self.exec_material(face, pname, values);
    }

    /// glLight.
    pub fn light(&mut self, light: u32, pname: u32, params: Params) {
        self.light_values(light, pname, Values::new(params));
    }

    /// glLightModel.
    pub fn light_model(&mut self, pname: u32, params: Params) {
        self.light_model_values(pname, Values::new(params));
    }

    /// glFog.
    pub fn fog(&mut self, pname: u32, params: Params) {
        self.fog_values(pname, Values::new(params));
    }

    /// glTexEnv.
    pub fn tex_env(&mut self, target: u32, pname: u32, params: Params) {
        self.tex_env_values(target, pname, Values::new(params));
    }

    /// glTexGen.
    pub fn tex_gen(&mut self, coord: u32, pname: u32, params: Params) {
        self.tex_gen_values(coord, pname, Values::new(params));
    }

    /// glTexParameter.
    pub fn tex_parameter(&mut self, target: u32, pname: u32, params: Params) {
        self.tex_parameter_values(target, pname, Values::new(params));
    }

    /// glPointParameter.
    pub fn point_parameter(&mut self, pname: u32, params: Params) {
        self.point_parameter_values(pname, Values::new(params));
    }
}
