//! What the frame's tables hold, computed from the state.

use afterglow_api::constants::*;
use glam::{Mat3, Mat4};

use crate::assemble::PolygonMode;
use crate::context::Context;
use crate::emit::Kind;
use crate::frame::*;
use crate::state::Cap;

impl Context {
    pub(crate) fn viewport_block(&self) -> Viewport {
        Viewport {
            rect: self.state.viewport.rect,
            depth_range: self.state.viewport.depth_range.map(|v| v as f32),
            scissor: self.state.caps.has(Cap::ScissorTest).then_some(self.state.scissor),
        }
    }

    pub(crate) fn transform_block(&self) -> Transform {
        let modelview = self.matrices.modelview.top();
        let projection = self.matrices.projection.top();
        let rescale = self.state.caps.has(Cap::RescaleNormal) && !self.state.caps.has(Cap::Normalize);
        Transform {
            modelview: modelview.to_cols_array_2d(),
            projection: projection.to_cols_array_2d(),
            modelview_projection: (projection * modelview).to_cols_array_2d(),
            normal: normal_matrix(modelview, rescale).to_cols_array_2d(),
        }
    }

    pub(crate) fn lights_block(&self) -> Lights {
        Lights { lights: self.state.lighting.lights, scene_ambient: self.state.lighting.model_ambient }
    }

    pub(crate) fn environment_block(&self) -> Environment {
        let (fog, point) = (&self.state.fog, &self.state.point);
        let units = &self.state.texture.units;
        Environment {
            env_color: std::array::from_fn(|i| units[i].env_color),
            lod_bias: std::array::from_fn(|i| {
                units[i].lod_bias + self.sampled(i).map_or(0.0, |sampled| sampled.lod_bias)
            }),
            fog_color: fog.color,
            fog_density: fog.density,
            fog_start: fog.start,
            fog_end: fog.end,
            alpha_reference: self.state.color.alpha_reference,
            point_size: point.size,
            point_size_min: point.size_min,
            point_size_max: point.size_max,
            point_fade_threshold: point.fade_threshold,
            point_attenuation: point.attenuation,
            line_width: self.state.line.width,
            polygon_stipple: std::array::from_fn(|row| {
                let bytes = self.state.polygon_stipple.as_chunks::<4>().0;
                u32::from_be_bytes(bytes[row])
            }),
        }
    }

    pub(crate) fn current_attributes(&self) -> CurrentAttributes {
        let a = self.state.current.attributes.map(|value| value.to_array());
        CurrentAttributes {
            normal: a[Slot::Normal as usize],
            color: a[Slot::Color as usize],
            secondary: a[Slot::Secondary as usize],
            fog: a[Slot::Fog as usize],
            texture: std::array::from_fn(|i| Plane { coefficients: a[Slot::Texture0 as usize + i] }),
        }
    }

    pub(crate) fn state_words(&self, kind: Kind) -> StateWords {
        StateWords { global: self.global_words(kind), units: std::array::from_fn(|i| self.unit_words(i)) }
    }

    fn global_words(&self, kind: Kind) -> GlobalWords {
        let (caps, lighting) = (self.state.caps, &self.state.lighting);
        let mut words = GlobalWords::default();
        if caps.has(Cap::Lighting) {
            words.set_lighting(1);
            words.set_lights(lighting.enabled.into());
            for (i, light) in lighting.lights.iter().enumerate() {
                if lighting.enabled & (1 << i) != 0 {
                    words.set_positional(words.positional() | u32::from(light.position[3] != 0.0) << i);
                    words.set_spots(words.spots() | u32::from(light.spot_cos_cutoff != -1.0) << i);
                }
            }
            words.set_two_side(lighting.two_side.into());
            words.set_local_viewer(lighting.local_viewer.into());
            words.set_separate_specular(lighting.separate_specular.into());
            if caps.has(Cap::ColorMaterial) {
                words.set_color_material(1);
                words.set_color_material_faces(faces(lighting.color_material_face));
                words.set_color_material_mode(color_material_mode(lighting.color_material_mode));
            }
        }
        words.set_color_sum(caps.has(Cap::ColorSum).into());
        words.set_normalize(match (caps.has(Cap::Normalize), caps.has(Cap::RescaleNormal)) {
            (true, _) => 2,
            (false, rescale) => rescale.into(),
        });
        words.set_flat_shade((lighting.shade_model == GL_FLAT).into());
        if caps.has(Cap::Fog) {
            words.set_fog_mode(match self.state.fog.mode {
                GL_LINEAR => 1,
                GL_EXP => 2,
                _ => 3,
            });
            words.set_fog_coordinate((self.state.fog.coordinate_source == GL_FOG_COORDINATE).into());
        }
        let alpha = if caps.has(Cap::AlphaTest) { self.state.color.alpha_func } else { GL_ALWAYS };
        words.set_alpha_func(alpha - GL_NEVER);
        let points = kind.topology() == Topology::Points;
        words.set_point_sprite((points && caps.has(Cap::PointSprite)).into());
        words.set_point_attenuation((points && self.state.point.attenuation != [1.0, 0.0, 0.0]).into());
        words.set_smooth(
            match kind.topology() {
                Topology::Points => caps.has(Cap::PointSmooth),
                Topology::Lines => caps.has(Cap::LineSmooth),
                Topology::Triangles => false,
            }
            .into(),
        );
        let stippled = kind == Kind::Polygons(PolygonMode::Fill) && caps.has(Cap::PolygonStipple);
        words.set_polygon_stipple(stippled.into());
        words.set_clip_planes(self.state.transform.clip_enabled.into());
        words
    }

    fn unit_words(&self, i: usize) -> UnitWords {
        let unit = &self.state.texture.units[i];
        let Some(sampled) = self.sampled(i) else { return UnitWords::default() };
        let mut words = unit.words;
        words.set_target(sampled.dimension as u32);
        words.set_base_format(sampled.base_format as u32);
        let mode = |c: usize| if unit.gen_enabled & (1 << c) == 0 { 0 } else { gen_mode(unit.gen_mode[c]) };
        words.set_gen_s(mode(0));
        words.set_gen_t(mode(1));
        words.set_gen_r(mode(2));
        words.set_gen_q(mode(3));
        words.set_matrix((self.matrices.texture[i].top() != Mat4::IDENTITY).into());
        if let Some((compare, depth_mode)) = sampled.depth_words {
            words.set_compare(compare);
            words.set_depth_mode(depth_mode);
        }
        // Combiner fields mean nothing in the other modes: equal states shall have equal words.
        if words.env_mode() != EnvMode::Combine as u32 {
            words.0[1] = 0;
            words.0[2] = 0;
        }
        words
    }

    pub(crate) fn raster_state(&self, kind: Kind) -> RasterState {
        let (caps, polygon, line) = (self.state.caps, &self.state.polygon, &self.state.line);
        let offset_cap = match kind {
            Kind::Polygons(PolygonMode::Fill) => Some(Cap::PolygonOffsetFill),
            Kind::Polygons(PolygonMode::Line) => Some(Cap::PolygonOffsetLine),
            Kind::Polygons(PolygonMode::Point) => Some(Cap::PolygonOffsetPoint),
            Kind::Points | Kind::Lines => None,
        };
        let offset = offset_cap.is_some_and(|cap| caps.has(cap));
        let lines = kind.topology() == Topology::Lines;
        RasterState {
            blend: self.blend(),
            logic_op: caps
                .has(Cap::ColorLogicOp)
                .then_some((self.state.color.logic_op.wrapping_sub(GL_CLEAR) & 15) as u8),
            color_mask: self.color_mask_bits(),
            depth: caps
                .has(Cap::DepthTest)
                .then(|| Depth { compare: compare(self.state.depth.func), write: self.state.depth.mask }),
            stencil: self.stencil(),
            cull: match polygon.cull_face {
                _ if !matches!(kind, Kind::Polygons(PolygonMode::Fill)) || !caps.has(Cap::CullFace) => {
                    Cull::None
                }
                GL_FRONT => Cull::Front,
                GL_BACK => Cull::Back,
                _ => Cull::FrontAndBack,
            },
            front_ccw: polygon.front_face == GL_CCW,
            depth_bias: offset.then(|| (polygon.offset.0.into(), polygon.offset.1.into())),
            line_width: if lines { line.width } else { 1.0 }.into(),
            line_stipple: (lines && caps.has(Cap::LineStipple))
                .then_some((line.stipple_factor, line.stipple_pattern)),
        }
    }

    /// Components written: none if there is no buffer to draw to.
    pub(crate) fn color_mask_bits(&self) -> u8 {
        if self.state.color.draw_buffer == GL_NONE {
            return 0;
        }
        let bit = |i: usize| u8::from(self.state.color.mask[i]) << i;
        bit(0) | bit(1) | bit(2) | bit(3)
    }

    fn blend(&self) -> Option<Blend> {
        let color = &self.state.color;
        if !self.state.caps.has(Cap::Blend) || self.state.caps.has(Cap::ColorLogicOp) {
            return None;
        }
        Some(Blend {
            rgb: (factor(color.blend[0][0]), factor(color.blend[0][1])),
            alpha: (factor(color.blend[1][0]), factor(color.blend[1][1])),
            equation_rgb: equation(color.equation[0]),
            equation_alpha: equation(color.equation[1]),
            constant: color.blend_color.map(Into::into),
        })
    }

    fn stencil(&self) -> Option<Stencil> {
        let stencil = &self.state.stencil;
        self.state.caps.has(Cap::StencilTest).then(|| Stencil {
            compare: compare(stencil.func),
            reference: stencil.reference.clamp(0, 255) as u32,
            compare_mask: stencil.value_mask & 255,
            write_mask: stencil.write_mask & 255,
            fail: stencil_op(stencil.ops[0]),
            depth_fail: stencil_op(stencil.ops[1]),
            pass: stencil_op(stencil.ops[2]),
        })
    }
}

/// Inverse transpose of the upper left 3x3, scaled as GL_RESCALE_NORMAL asks (specification 2.11.3).
/// A singular matrix is used as it is: the result is undefined then, but finite.
fn normal_matrix(modelview: Mat4, rescale: bool) -> Mat3 {
    let upper = Mat3::from_mat4(modelview);
    let inverse = upper.inverse_or_zero();
    if inverse == Mat3::ZERO || !inverse.is_finite() {
        return upper;
    }
    let factor = if rescale { inverse.row(2).length_recip() } else { 1.0 };
    inverse.transpose() * factor
}

fn faces(face: u32) -> u32 {
    match face {
        GL_FRONT => 1,
        GL_BACK => 2,
        _ => 3,
    }
}

fn color_material_mode(mode: u32) -> u32 {
    match mode {
        GL_AMBIENT => 1,
        GL_DIFFUSE => 2,
        GL_SPECULAR => 3,
        GL_EMISSION => 4,
        _ => 0,
    }
}

fn gen_mode(mode: u32) -> u32 {
    match mode {
        GL_OBJECT_LINEAR => 1,
        GL_EYE_LINEAR => 2,
        GL_SPHERE_MAP => 3,
        GL_REFLECTION_MAP => 4,
        _ => 5,
    }
}

/// The comparison that GL_NEVER to GL_ALWAYS names.
pub fn compare(func: u32) -> Compare {
    use Compare::*;
    [Never, Less, Equal, LessEqual, Greater, NotEqual, GreaterEqual, Always][(func & 7) as usize]
}

fn factor(factor: u32) -> BlendFactor {
    use BlendFactor::*;
    match factor {
        GL_ZERO => Zero,
        GL_SRC_COLOR => SourceColor,
        GL_ONE_MINUS_SRC_COLOR => OneMinusSourceColor,
        GL_DST_COLOR => DestinationColor,
        GL_ONE_MINUS_DST_COLOR => OneMinusDestinationColor,
        GL_SRC_ALPHA => SourceAlpha,
        GL_ONE_MINUS_SRC_ALPHA => OneMinusSourceAlpha,
        GL_DST_ALPHA => DestinationAlpha,
        GL_ONE_MINUS_DST_ALPHA => OneMinusDestinationAlpha,
        GL_SRC_ALPHA_SATURATE => SourceAlphaSaturate,
        GL_CONSTANT_COLOR => ConstantColor,
        GL_ONE_MINUS_CONSTANT_COLOR => OneMinusConstantColor,
        GL_CONSTANT_ALPHA => ConstantAlpha,
        GL_ONE_MINUS_CONSTANT_ALPHA => OneMinusConstantAlpha,
        _ => One,
    }
}

fn equation(mode: u32) -> BlendEquation {
    match mode {
        GL_FUNC_SUBTRACT => BlendEquation::Subtract,
        GL_FUNC_REVERSE_SUBTRACT => BlendEquation::ReverseSubtract,
        GL_MIN => BlendEquation::Min,
        GL_MAX => BlendEquation::Max,
        _ => BlendEquation::Add,
    }
}

fn stencil_op(op: u32) -> StencilOp {
    match op {
        GL_ZERO => StencilOp::Zero,
        GL_REPLACE => StencilOp::Replace,
        GL_INCR => StencilOp::Increment,
        GL_DECR => StencilOp::Decrement,
        GL_INVERT => StencilOp::Invert,
        GL_INCR_WRAP => StencilOp::IncrementWrap,
        GL_DECR_WRAP => StencilOp::DecrementWrap,
        _ => StencilOp::Keep,
    }
}
