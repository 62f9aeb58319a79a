//! Lights, materials, light model, fog, point parameters (specification 2.14, 3.10, 3.3).

use afterglow_api::constants::*;
use glam::{Mat3, Vec3, Vec4};

use crate::context::Context;
use crate::frame::{LIGHTS, MaterialFace, Slot};
use crate::params::Values;
use crate::state::Cap;
use crate::tables::Dirty;

/// Indices of the faces that an enumerant names.
pub fn face_indices(face: u32) -> Option<&'static [usize]> {
    match face {
        GL_FRONT => Some(&[0]),
        GL_BACK => Some(&[1]),
        GL_FRONT_AND_BACK => Some(&[0, 1]),
        _ => None,
    }
}

fn first3([x, y, z, _]: [f32; 4]) -> [f32; 3] {
    [x, y, z]
}

impl Context {
    pub(crate) fn exec_light(&mut self, light: u32, pname: u32, values: Values) {
        let index = light.wrapping_sub(GL_LIGHT0) as usize;
        if index >= LIGHTS {
            return self.record_error(GL_INVALID_ENUM);
        }
        let result = self.set_light(index, pname, values);
        if self.check(result) {
            // Where a light is and whether it is a spot is part of what is computed.
            self.dirty(Dirty::LIGHTS | Dirty::WORDS);
        }
    }

    fn set_light(&mut self, index: usize, pname: u32, values: Values) -> Result<(), u32> {
        let modelview = self.matrices.modelview.top();
        let light = &mut self.state.lighting.lights[index];
        let value = values.float();
        let positive = if value >= 0.0 { Ok(value) } else { Err(GL_INVALID_VALUE) };
        match pname {
            GL_AMBIENT => light.ambient = values.color(),
            GL_DIFFUSE => light.diffuse = values.color(),
            GL_SPECULAR => light.specular = values.color(),
            GL_POSITION => light.position = (modelview * Vec4::from_array(values.floats())).to_array(),
            GL_SPOT_DIRECTION => {
                let direction = Vec3::from_array(first3(values.floats()));
                light.spot_direction = (Mat3::from_mat4(modelview) * direction).to_array();
            }
            GL_SPOT_EXPONENT if (0.0..=128.0).contains(&value) => light.spot_exponent = value,
            GL_SPOT_CUTOFF if (0.0..=90.0).contains(&value) || value == 180.0 => {
                light.spot_cos_cutoff = if value == 180.0 { -1.0 } else { value.to_radians().cos() };
                self.state.lighting.cutoffs[index] = value;
            }
            GL_SPOT_EXPONENT | GL_SPOT_CUTOFF => return Err(GL_INVALID_VALUE),
            GL_CONSTANT_ATTENUATION => light.attenuation[0] = positive?,
            GL_LINEAR_ATTENUATION => light.attenuation[1] = positive?,
            GL_QUADRATIC_ATTENUATION => light.attenuation[2] = positive?,
            _ => return Err(GL_INVALID_ENUM),
        }
        Ok(())
    }

    pub(crate) fn exec_light_model(&mut self, pname: u32, values: Values) {
        let lighting = &mut self.state.lighting;
        match pname {
            GL_LIGHT_MODEL_AMBIENT => lighting.model_ambient = values.color(),
            GL_LIGHT_MODEL_LOCAL_VIEWER => lighting.local_viewer = values.float() != 0.0,
            GL_LIGHT_MODEL_TWO_SIDE => lighting.two_side = values.float() != 0.0,
            GL_LIGHT_MODEL_COLOR_CONTROL => match values.enumerant() {
                GL_SINGLE_COLOR => lighting.separate_specular = false,
                GL_SEPARATE_SPECULAR_COLOR => lighting.separate_specular = true,
                _ => return self.record_error(GL_INVALID_ENUM),
            },
            _ => return self.record_error(GL_INVALID_ENUM),
        }
        self.dirty(Dirty::LIGHTS | Dirty::WORDS);
    }

    pub(crate) fn exec_material(&mut self, face: u32, pname: u32, values: Values) {
        let Some(faces) = face_indices(face) else { return self.record_error(GL_INVALID_ENUM) };
        if pname == GL_SHININESS && !(0.0..=128.0).contains(&values.float()) {
            return self.record_error(GL_INVALID_VALUE);
        }
        self.split_primitive();
        for &face in faces {
            if !set_material(&mut self.state.lighting.material.faces[face], pname, &values) {
                if pname == GL_COLOR_INDEXES {
                    self.state.lighting.color_indexes[face] = first3(values.floats());
                    continue;
                }
                return self.record_error(GL_INVALID_ENUM);
            }
        }
        self.sync_color_material();
        self.dirty(Dirty::MATERIAL);
    }

    /// A material that changes between Begin and End holds from the next vertex on: separate primitives
    /// that are complete are drawn first.
    fn split_primitive(&mut self) {
        let Some(mode) = self.immediate.mode else { return };
        let whole = match mode {
            GL_POINTS => 1,
            GL_LINES => 2,
            GL_TRIANGLES => 3,
            GL_QUADS => 4,
            _ => return,
        };
        if self.list.is_none() && self.immediate.count() > 0 && self.immediate.count().is_multiple_of(whole) {
            self.draw_immediate(mode);
            self.immediate.restart();
        }
    }

    pub(crate) fn exec_color_material(&mut self, face: u32, mode: u32) {
        let modes = [GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION, GL_AMBIENT_AND_DIFFUSE];
        if face_indices(face).is_none() || !modes.contains(&mode) {
            return self.record_error(GL_INVALID_ENUM);
        }
        self.sync_color_material();
        self.state.lighting.color_material_face = face;
        self.state.lighting.color_material_mode = mode;
        self.dirty(Dirty::WORDS);
    }

    /// Gives the material the current colour if it follows it. While it follows, shaders use the colour
    /// itself; the material needs it only when somebody looks or the following ends.
    pub(crate) fn sync_color_material(&mut self) {
        if !self.state.caps.has(Cap::ColorMaterial) {
            return;
        }
        let color = self.state.current.attributes[Slot::Color as usize].to_array();
        let lighting = &mut self.state.lighting;
        for &face in face_indices(lighting.color_material_face).unwrap_or_default() {
            let face = &mut lighting.material.faces[face];
            match lighting.color_material_mode {
                GL_AMBIENT => face.ambient = color,
                GL_DIFFUSE => face.diffuse = color,
                GL_SPECULAR => face.specular = color,
                GL_EMISSION => face.emission = color,
                _ => (face.ambient, face.diffuse) = (color, color),
            }
        }
        self.dirty(Dirty::MATERIAL);
    }

    pub(crate) fn exec_shade_model(&mut self, mode: u32) {
        if !matches!(mode, GL_FLAT | GL_SMOOTH) {
            return self.record_error(GL_INVALID_ENUM);
        }
        if self.state.lighting.shade_model != mode {
            self.state.lighting.shade_model = mode;
            self.dirty(Dirty::WORDS);
        }
    }

    pub(crate) fn exec_fog(&mut self, pname: u32, values: Values) {
        let fog = &mut self.state.fog;
        match pname {
            GL_FOG_MODE => match values.enumerant() {
                mode @ (GL_LINEAR | GL_EXP | GL_EXP2) => fog.mode = mode,
                _ => return self.record_error(GL_INVALID_ENUM),
            },
            GL_FOG_DENSITY if values.float() < 0.0 => return self.record_error(GL_INVALID_VALUE),
            GL_FOG_DENSITY => fog.density = values.float(),
            GL_FOG_START => fog.start = values.float(),
            GL_FOG_END => fog.end = values.float(),
            GL_FOG_INDEX => fog.index = values.float(),
            GL_FOG_COLOR => fog.color = values.color().map(|v| v.clamp(0.0, 1.0)),
            GL_FOG_COORDINATE_SOURCE => match values.enumerant() {
                source @ (GL_FOG_COORDINATE | GL_FRAGMENT_DEPTH) => fog.coordinate_source = source,
                _ => return self.record_error(GL_INVALID_ENUM),
            },
            // NV_fog_distance is not there: the distance is always the eye's z.
            _ => return self.record_error(GL_INVALID_ENUM),
        }
        self.dirty(Dirty::ENVIRONMENT | Dirty::WORDS);
    }

    pub(crate) fn exec_point_size(&mut self, size: f32) {
        if size <= 0.0 {
            return self.record_error(GL_INVALID_VALUE);
        }
        self.state.point.size = size;
        self.dirty(Dirty::ENVIRONMENT);
    }

    pub(crate) fn exec_point_parameter(&mut self, pname: u32, values: Values) {
        let (point, value) = (&mut self.state.point, values.float());
        match pname {
            GL_POINT_DISTANCE_ATTENUATION => point.attenuation = first3(values.floats()),
            GL_POINT_SIZE_MIN | GL_POINT_SIZE_MAX | GL_POINT_FADE_THRESHOLD_SIZE if value < 0.0 => {
                return self.record_error(GL_INVALID_VALUE);
            }
            GL_POINT_SIZE_MIN => point.size_min = value,
            GL_POINT_SIZE_MAX => point.size_max = value,
            GL_POINT_FADE_THRESHOLD_SIZE => point.fade_threshold = value,
            _ => return self.record_error(GL_INVALID_ENUM),
        }
        self.dirty(Dirty::ENVIRONMENT | Dirty::WORDS);
    }
}

fn set_material(face: &mut MaterialFace, pname: u32, values: &Values) -> bool {
    match pname {
        GL_AMBIENT => face.ambient = values.color(),
        GL_DIFFUSE => face.diffuse = values.color(),
        GL_SPECULAR => face.specular = values.color(),
        GL_EMISSION => face.emission = values.color(),
        GL_SHININESS => face.shininess = values.float(),
        GL_AMBIENT_AND_DIFFUSE => (face.ambient, face.diffuse) = (values.color(), values.color()),
        _ => return false,
    }
    true
}
