//! glGet, in all types, and the queries of lights, materials, environments (specification 6.1).

use afterglow_api::constants::*;

use crate::context::Context;
use crate::frame::{CLIP_PLANES, LIGHTS, SLOTS, SceneHints, Slot, TEXTURE_UNITS};
use crate::limits;
use crate::pixel::{Extent, PixelLayout, PixelTarget, PixelTransfer, pack_stencil};
use crate::state::HINTS;

/// A state value, before it is converted to what was asked for.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Flags.
    Bools(Vec<bool>),
    /// Integers and enumerants.
    Ints(Vec<i64>),
    /// Numbers that are rounded when integers are asked for.
    Floats(Vec<f64>),
    /// Colours, normals, depths: 1 becomes the greatest integer.
    Fractions(Vec<f64>),
}

impl Value {
    /// As glGetBooleanv gives it.
    pub fn booleans(&self) -> Vec<bool> {
        match self {
            Value::Bools(values) => values.clone(),
            Value::Ints(values) => values.iter().map(|&v| v != 0).collect(),
            Value::Floats(values) | Value::Fractions(values) => values.iter().map(|&v| v != 0.0).collect(),
        }
    }

    /// As glGetIntegerv gives it (specification 6.1.2).
    pub fn integers(&self) -> Vec<i32> {
        match self {
            Value::Bools(values) => values.iter().map(|&v| v.into()).collect(),
            Value::Ints(values) => values.iter().map(|&v| v as i32).collect(),
            Value::Floats(values) => values.iter().map(|&v| v.round() as i32).collect(),
            Value::Fractions(values) => {
                values.iter().map(|&v| ((f64::from(u32::MAX) * v - 1.0) / 2.0).round() as i32).collect()
            }
        }
    }

    /// As glGetDoublev gives it.
    pub fn doubles(&self) -> Vec<f64> {
        match self {
            Value::Bools(values) => values.iter().map(|&v| f64::from(u8::from(v))).collect(),
            Value::Ints(values) => values.iter().map(|&v| v as f64).collect(),
            Value::Floats(values) | Value::Fractions(values) => values.clone(),
        }
    }

    /// As glGetFloatv gives it.
    pub fn floats(&self) -> Vec<f32> {
        self.doubles().into_iter().map(|v| v as f32).collect()
    }
}

fn ints<const N: usize>(values: [i32; N]) -> Option<Value> {
    Some(Value::Ints(values.map(i64::from).to_vec()))
}

fn name(value: u32) -> Option<Value> {
    Some(Value::Ints(vec![value.into()]))
}

fn flag(value: bool) -> Option<Value> {
    Some(Value::Bools(vec![value]))
}

fn floats(values: &[f32]) -> Option<Value> {
    Some(Value::Floats(values.iter().map(|&v| v.into()).collect()))
}

fn fractions(values: &[f32]) -> Option<Value> {
    Some(Value::Fractions(values.iter().map(|&v| v.into()).collect()))
}

/// GL_MAX_TEXTURE_COORDS of OpenGL 2.0. Tracers ask for it to find all arrays of texture coordinates.
const MAX_TEXTURE_COORDS: u32 = 0x8871;

impl Context {
    /// glGet in the form before conversion; an error and nothing for unknown names.
    pub fn get(&mut self, pname: u32) -> Option<Value> {
        if self.refuses_in_begin() {
            return None;
        }
        let value = self
            .get_limit(pname)
            .or_else(|| self.get_transform(pname))
            .or_else(|| self.get_current(pname))
            .or_else(|| self.get_raster(pname))
            .or_else(|| self.get_fragment(pname))
            .or_else(|| self.get_texture_unit(pname))
            .or_else(|| self.get_arrays(pname))
            .or_else(|| self.get_pixel(pname));
        if value.is_some() {
            return value;
        }
        let error = std::mem::replace(&mut self.error, GL_NO_ERROR);
        let enabled = self.is_enabled(pname);
        let known = self.error == GL_NO_ERROR;
        self.error = error;
        if !known {
            self.record_error(GL_INVALID_ENUM);
        }
        known.then(|| Value::Bools(vec![enabled]))
    }

    /// glGetBooleanv.
    pub fn get_boolean(&mut self, pname: u32) -> Vec<bool> {
        self.get(pname).map_or_else(Vec::new, |value| value.booleans())
    }

    /// glGetIntegerv.
    pub fn get_integer(&mut self, pname: u32) -> Vec<i32> {
        self.get(pname).map_or_else(Vec::new, |value| value.integers())
    }

    /// glGetFloatv.
    pub fn get_float(&mut self, pname: u32) -> Vec<f32> {
        self.get(pname).map_or_else(Vec::new, |value| value.floats())
    }

    /// glGetDoublev.
    pub fn get_double(&mut self, pname: u32) -> Vec<f64> {
        self.get(pname).map_or_else(Vec::new, |value| value.doubles())
    }

    fn get_limit(&self, pname: u32) -> Option<Value> {
        let limit = |value: usize| ints([value as i32]);
        let buffers = &self.output.buffers;
        match pname {
            GL_MAX_LIGHTS => limit(LIGHTS),
            GL_MAX_SCENE_LIGHTS_AFTERGLOW => limit(SceneHints::MOST_LIGHTS),
            GL_MAX_CLIP_PLANES => limit(CLIP_PLANES),
            GL_MAX_TEXTURE_UNITS | MAX_TEXTURE_COORDS => limit(TEXTURE_UNITS),
            GL_MAX_TEXTURE_SIZE => limit(crate::texture::MAX_SIZE),
            GL_MAX_3D_TEXTURE_SIZE => limit(crate::texture::MAX_3D_SIZE),
            GL_MAX_CUBE_MAP_TEXTURE_SIZE => limit(crate::texture::MAX_CUBE_SIZE),
            GL_MAX_TEXTURE_LOD_BIAS => ints([16]),
            GL_MAX_MODELVIEW_STACK_DEPTH => limit(limits::MODELVIEW_STACK),
            GL_MAX_PROJECTION_STACK_DEPTH => limit(limits::PROJECTION_STACK),
            GL_MAX_TEXTURE_STACK_DEPTH => limit(limits::TEXTURE_STACK),
            GL_MAX_ATTRIB_STACK_DEPTH | GL_MAX_CLIENT_ATTRIB_STACK_DEPTH => limit(limits::ATTRIB_STACK),
            GL_MAX_LIST_NESTING => limit(limits::LIST_NESTING as usize),
            GL_MAX_NAME_STACK_DEPTH => limit(limits::NAME_STACK),
            GL_MAX_PIXEL_MAP_TABLE => limit(crate::pixel::MAX_PIXEL_MAP_TABLE),
            GL_MAX_EVAL_ORDER => ints([30]),
            GL_MAX_VIEWPORT_DIMS => ints([limits::VIEWPORT; 2]),
            GL_MAX_ELEMENTS_VERTICES | GL_MAX_ELEMENTS_INDICES => ints([limits::ELEMENTS]),
            GL_NUM_COMPRESSED_TEXTURE_FORMATS => ints([0]),
            GL_COMPRESSED_TEXTURE_FORMATS => Some(Value::Ints(Vec::new())),
            GL_SUBPIXEL_BITS => ints([8]),
            GL_RED_BITS | GL_GREEN_BITS | GL_BLUE_BITS | GL_ALPHA_BITS => ints([8]),
            GL_STENCIL_BITS => limit(buffers.stencil.into()),
            GL_DEPTH_BITS => limit(buffers.depth.into()),
            GL_ACCUM_RED_BITS | GL_ACCUM_GREEN_BITS | GL_ACCUM_BLUE_BITS | GL_ACCUM_ALPHA_BITS => {
                limit(buffers.accumulation.into())
            }
            GL_INDEX_BITS | GL_AUX_BUFFERS | GL_SAMPLE_BUFFERS | GL_SAMPLES => ints([0]),
            GL_DOUBLEBUFFER => flag(buffers.is_double),
            GL_RGBA_MODE => flag(true),
            GL_STEREO | GL_INDEX_MODE => flag(false),
            GL_ALIASED_POINT_SIZE_RANGE | GL_POINT_SIZE_RANGE => floats(&[1.0, limits::POINT_SIZE_MAX]),
            GL_ALIASED_LINE_WIDTH_RANGE | GL_LINE_WIDTH_RANGE => floats(&[1.0, limits::LINE_WIDTH_MAX]),
            GL_POINT_SIZE_GRANULARITY | GL_LINE_WIDTH_GRANULARITY => floats(&[0.125]),
            _ => None,
        }
    }

    fn get_transform(&self, pname: u32) -> Option<Value> {
        let (matrices, active) = (&self.matrices, self.state.texture.active);
        let stack = |stack: &crate::matrices::Stack| ints([stack.depth() as i32]);
        let viewport = &self.state.viewport;
        match pname {
            GL_MODELVIEW_MATRIX => floats(&matrices.modelview.top().to_cols_array()),
            GL_PROJECTION_MATRIX => floats(&matrices.projection.top().to_cols_array()),
            GL_TEXTURE_MATRIX => floats(&matrices.texture[active].top().to_cols_array()),
            GL_TRANSPOSE_MODELVIEW_MATRIX => floats(&matrices.modelview.top().transpose().to_cols_array()),
            GL_TRANSPOSE_PROJECTION_MATRIX => floats(&matrices.projection.top().transpose().to_cols_array()),
            GL_TRANSPOSE_TEXTURE_MATRIX => {
                floats(&matrices.texture[active].top().transpose().to_cols_array())
            }
            GL_MODELVIEW_STACK_DEPTH => stack(&matrices.modelview),
            GL_PROJECTION_STACK_DEPTH => stack(&matrices.projection),
            GL_TEXTURE_STACK_DEPTH => stack(&matrices.texture[active]),
            GL_MATRIX_MODE => name(self.state.transform.matrix_mode),
            GL_VIEWPORT => {
                ints([viewport.rect.x, viewport.rect.y, viewport.rect.width, viewport.rect.height])
            }
            GL_DEPTH_RANGE => Some(Value::Fractions(viewport.depth_range.to_vec())),
            GL_ATTRIB_STACK_DEPTH => ints([self.stacks.depths().0 as i32]),
            GL_CLIENT_ATTRIB_STACK_DEPTH => ints([self.stacks.depths().1 as i32]),
            _ => None,
        }
    }

    fn get_current(&self, pname: u32) -> Option<Value> {
        let (current, active) = (&self.state.current, self.state.texture.active);
        let raster = &current.raster;
        let attribute = |slot: usize| current.attributes[slot].to_array();
        match pname {
            GL_CURRENT_COLOR => fractions(&attribute(Slot::Color as usize)),
            GL_CURRENT_SECONDARY_COLOR => fractions(&attribute(Slot::Secondary as usize)),
            GL_CURRENT_NORMAL => fractions(&attribute(Slot::Normal as usize)[..3]),
            GL_CURRENT_TEXTURE_COORDS => {
                floats(&attribute((Slot::Texture0 as usize + active).min(SLOTS - 1)))
            }
            GL_CURRENT_FOG_COORDINATE => floats(&attribute(Slot::Fog as usize)[..1]),
            GL_CURRENT_INDEX => floats(&[current.index]),
            GL_EDGE_FLAG => flag(current.edge_flag),
            GL_CURRENT_RASTER_POSITION => floats(&raster.window),
            GL_CURRENT_RASTER_POSITION_VALID => flag(raster.valid),
            GL_CURRENT_RASTER_DISTANCE => floats(&[raster.distance]),
            GL_CURRENT_RASTER_COLOR => fractions(&raster.color),
            GL_CURRENT_RASTER_TEXTURE_COORDS => floats(&raster.texture[active]),
            GL_CURRENT_RASTER_INDEX => floats(&[current.index]),
            GL_LIST_BASE => name(self.state.list_base),
            GL_LIST_INDEX => name(self.list.as_ref().map_or(0, |list| list.name())),
            GL_LIST_MODE => name(self.list.as_ref().map_or(0, |list| list.mode())),
            GL_RENDER_MODE => name(match self.mode {
                crate::pixels::RenderMode::Render => GL_RENDER,
                crate::pixels::RenderMode::Select => GL_SELECT,
                crate::pixels::RenderMode::Feedback => GL_FEEDBACK,
            }),
            GL_NAME_STACK_DEPTH | GL_SELECTION_BUFFER_SIZE | GL_FEEDBACK_BUFFER_SIZE => ints([0]),
            _ => None,
        }
    }

    fn get_raster(&self, pname: u32) -> Option<Value> {
        let (point, line, polygon) = (&self.state.point, &self.state.line, &self.state.polygon);
        let (lighting, fog) = (&self.state.lighting, &self.state.fog);
        match pname {
            GL_POINT_SIZE => floats(&[point.size]),
            GL_POINT_SIZE_MIN => floats(&[point.size_min]),
            GL_POINT_SIZE_MAX => floats(&[point.size_max]),
            GL_POINT_FADE_THRESHOLD_SIZE => floats(&[point.fade_threshold]),
            GL_POINT_DISTANCE_ATTENUATION => floats(&point.attenuation),
            GL_LINE_WIDTH => floats(&[line.width]),
            GL_LINE_STIPPLE_PATTERN => ints([line.stipple_pattern.into()]),
            GL_LINE_STIPPLE_REPEAT => ints([line.stipple_factor.into()]),
            GL_CULL_FACE_MODE => name(polygon.cull_face),
            GL_FRONT_FACE => name(polygon.front_face),
            GL_POLYGON_MODE => ints(polygon.mode.map(|m| m as i32)),
            GL_POLYGON_OFFSET_FACTOR => floats(&[polygon.offset.0]),
            GL_POLYGON_OFFSET_UNITS => floats(&[polygon.offset.1]),
            GL_SHADE_MODEL => name(lighting.shade_model),
            GL_COLOR_MATERIAL_FACE => name(lighting.color_material_face),
            GL_COLOR_MATERIAL_PARAMETER => name(lighting.color_material_mode),
            GL_LIGHT_MODEL_AMBIENT => fractions(&lighting.model_ambient),
            GL_LIGHT_MODEL_LOCAL_VIEWER => flag(lighting.local_viewer),
            GL_LIGHT_MODEL_TWO_SIDE => flag(lighting.two_side),
            GL_LIGHT_MODEL_COLOR_CONTROL => name(match lighting.separate_specular {
                true => GL_SEPARATE_SPECULAR_COLOR,
                false => GL_SINGLE_COLOR,
            }),
            GL_FOG_MODE => name(fog.mode),
            GL_FOG_COLOR => fractions(&fog.color),
            GL_FOG_DENSITY => floats(&[fog.density]),
            GL_FOG_START => floats(&[fog.start]),
            GL_FOG_END => floats(&[fog.end]),
            GL_FOG_INDEX => floats(&[fog.index]),
            GL_FOG_COORDINATE_SOURCE => name(fog.coordinate_source),
            _ => HINTS.iter().position(|&hint| hint == pname).and_then(|i| name(self.state.hints[i])),
        }
    }

    fn get_fragment(&self, pname: u32) -> Option<Value> {
        let (color, depth, stencil) = (&self.state.color, &self.state.depth, &self.state.stencil);
        let scissor = self.state.scissor;
        match pname {
            GL_SCISSOR_BOX => ints([scissor.x, scissor.y, scissor.width, scissor.height]),
            GL_ALPHA_TEST_FUNC => name(color.alpha_func),
            GL_ALPHA_TEST_REF => fractions(&[color.alpha_reference]),
            GL_BLEND_SRC | GL_BLEND_SRC_RGB => name(color.blend[0][0]),
            GL_BLEND_DST | GL_BLEND_DST_RGB => name(color.blend[0][1]),
            GL_BLEND_SRC_ALPHA => name(color.blend[1][0]),
            GL_BLEND_DST_ALPHA => name(color.blend[1][1]),
            GL_BLEND_EQUATION => name(color.equation[0]),
            GL_BLEND_COLOR => fractions(&color.blend_color),
            GL_LOGIC_OP_MODE => name(color.logic_op),
            GL_DRAW_BUFFER => name(color.draw_buffer),
            GL_READ_BUFFER => name(self.state.pixel.read_buffer),
            GL_COLOR_WRITEMASK => Some(Value::Bools(color.mask.to_vec())),
            GL_INDEX_WRITEMASK => name(color.index_mask),
            GL_COLOR_CLEAR_VALUE => fractions(&color.clear),
            GL_INDEX_CLEAR_VALUE => floats(&[color.clear_index]),
            GL_ACCUM_CLEAR_VALUE => fractions(&self.state.accum_clear),
            GL_DEPTH_FUNC => name(depth.func),
            GL_DEPTH_WRITEMASK => flag(depth.mask),
            GL_DEPTH_CLEAR_VALUE => Some(Value::Fractions(vec![depth.clear])),
            GL_STENCIL_FUNC => name(stencil.func),
            GL_STENCIL_REF => ints([stencil.reference.clamp(0, 255)]),
            GL_STENCIL_VALUE_MASK => name(stencil.value_mask),
            GL_STENCIL_WRITEMASK => name(stencil.write_mask),
            GL_STENCIL_FAIL => name(stencil.ops[0]),
            GL_STENCIL_PASS_DEPTH_FAIL => name(stencil.ops[1]),
            GL_STENCIL_PASS_DEPTH_PASS => name(stencil.ops[2]),
            GL_STENCIL_CLEAR_VALUE => ints([stencil.clear]),
            _ => None,
        }
    }

    fn get_texture_unit(&self, pname: u32) -> Option<Value> {
        let bound = &self.textures.bound[self.state.texture.active];
        match pname {
            GL_ACTIVE_TEXTURE => name(GL_TEXTURE0 + self.state.texture.active as u32),
            GL_CLIENT_ACTIVE_TEXTURE => name(GL_TEXTURE0 + self.client.active_texture as u32),
            GL_TEXTURE_BINDING_1D => name(bound[0].0),
            GL_TEXTURE_BINDING_2D => name(bound[1].0),
            GL_TEXTURE_BINDING_3D => name(bound[2].0),
            GL_TEXTURE_BINDING_CUBE_MAP => name(bound[3].0),
            _ => None,
        }
    }

    fn get_pixel(&self, pname: u32) -> Option<Value> {
        let zoom = self.state.pixel.zoom;
        match pname {
            GL_ZOOM_X => floats(&[zoom.0]),
            GL_ZOOM_Y => floats(&[zoom.1]),
            _ => self
                .stacks
                .pixel_store
                .get(pname)
                .and_then(|value| ints([value]))
                .or_else(|| floats(&[self.transfer.modes.get(pname)?]))
                .or_else(|| ints([self.transfer.maps.size(pname)? as i32])),
        }
    }

    /// How many values glGetPixelMap gives; none of a map that there is not.
    pub fn pixel_map_len(&self, map: u32) -> usize {
        self.transfer.maps.get(map).map_or(0, <[f32]>::len)
    }

    /// glGetPixelMap.
    pub fn get_pixel_map(&mut self, map: u32) -> Vec<f32> {
        if self.refuses_in_begin() {
            return Vec::new();
        }
        match self.transfer.maps.get(map) {
            Ok(values) => values.to_vec(),
            Err(error) => {
                self.record_error(error);
                Vec::new()
            }
        }
    }

    /// glGetPolygonStipple.
    pub fn get_polygon_stipple(&mut self) -> [u8; 128] {
        self.state.polygon_stipple
    }

    /// glGetPolygonStipple into the program's memory, to lie there as glPixelStore says.
    pub fn get_polygon_stipple_image(&mut self, data: &mut [u8]) {
        if self.refuses_in_begin() {
            return;
        }
        let bits: Vec<u8> = (0..1024).map(|i| self.state.polygon_stipple[i / 8] >> (7 - i % 8) & 1).collect();
        let packing = self.stacks.pixel_store.pack;
        let result = PixelLayout::from_gl(GL_STENCIL_INDEX, GL_BITMAP)
            .and_then(|layout| PixelTarget::new(data, layout, &packing, Extent::plane(32, 32)))
            .and_then(|target| pack_stencil(&bits, &PixelTransfer::default(), target));
        self.check(result);
    }

    /// glGetClipPlane, in eye coordinates; `None` after an error.
    pub fn get_clip_plane(&mut self, plane: u32) -> Option<[f64; 4]> {
        if self.refuses_in_begin() {
            return None;
        }
        let planes = &self.state.transform.clip_planes;
        let equation = planes.get(plane.wrapping_sub(GL_CLIP_PLANE0) as usize).copied();
        if equation.is_none() {
            self.record_error(GL_INVALID_ENUM);
        }
        equation
    }

    /// glGetString.
    pub fn get_string(&mut self, name: u32) -> Option<&'static str> {
        if self.refuses_in_begin() {
            return None;
        }
        match name {
            GL_VENDOR => Some("Afterglow"),
            GL_RENDERER => Some("Afterglow"),
            GL_VERSION => Some("1.5 Afterglow"),
            GL_EXTENSIONS => Some(crate::extensions::STRING),
            _ => {
                self.record_error(GL_INVALID_ENUM);
                None
            }
        }
    }
}
