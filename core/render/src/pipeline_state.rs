//! Rasterization and per-fragment state as Vulkan's pipeline state.

use afterglow_gl::frame::{
    Blend, BlendEquation, BlendFactor, Compare, Cull, RasterState, Stencil, StencilOp, Topology,
};
use afterglow_gpu::{Features, vk};

/// The part of a draw's raster state that a pipeline is made with; the numbers are set while recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct PipelineRaster {
    blend: Option<Blend>,
    logic_op: Option<u8>,
    color_mask: u8,
    depth: Option<(Compare, bool)>,
    stencil: Option<StencilTest>,
    cull: Cull,
    front_ccw: bool,
    depth_bias: bool,
    line: LineKind,
    /// Flat colours come from the last vertex, as lines have them, and not from the first.
    is_last_provoking: bool,
}

/// A stencil test without its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct StencilTest {
    compare: Compare,
    fail: StencilOp,
    depth_fail: StencilOp,
    pass: StencilOp,
}

/// How lines are rasterized.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum LineKind {
    /// As the device does it where nothing is asked for.
    Default,
    Aliased {
        stippled: bool,
    },
    Smooth {
        stippled: bool,
    },
}

impl PipelineRaster {
    /// What of `raster` matters to a pipeline of this topology on a device with these features.
    pub(crate) fn new(
        raster: &RasterState,
        topology: Topology,
        antialiased: bool,
        features: &Features,
    ) -> Self {
        let polygons = topology == Topology::Triangles;
        let logic_op = raster.logic_op.filter(|_| features.logic_op);
        Self {
            // The constant is set while recording; the logic operation replaces blending.
            blend: raster
                .blend
                .filter(|_| logic_op.is_none())
                .map(|blend| Blend { constant: Default::default(), ..blend }),
            logic_op,
            color_mask: raster.color_mask,
            depth: raster.depth.map(|depth| (depth.compare, depth.write)),
            stencil: raster.stencil.as_ref().map(StencilTest::new),
            cull: if polygons { raster.cull } else { Cull::None },
            front_ccw: raster.front_ccw || !polygons,
            depth_bias: polygons && raster.depth_bias.is_some(),
            line: match topology {
                Topology::Lines => LineKind::new(raster.line_stipple.is_some(), antialiased, features),
                _ => LineKind::Default,
            },
            is_last_provoking: topology == Topology::Lines && features.provoking_vertex_last,
        }
    }

    pub(crate) fn rasterization(&self) -> vk::PipelineRasterizationStateCreateInfo<'static> {
        vk::PipelineRasterizationStateCreateInfo::default()
            .polygon_mode(vk::PolygonMode::FILL)
            .cull_mode(match self.cull {
                Cull::None => vk::CullModeFlags::NONE,
                Cull::Front => vk::CullModeFlags::FRONT,
                Cull::Back => vk::CullModeFlags::BACK,
                Cull::FrontAndBack => vk::CullModeFlags::FRONT_AND_BACK,
            })
            // Viewports of negative height keep the sense of rotation that OpenGL sees.
            .front_face(match self.front_ccw {
                true => vk::FrontFace::COUNTER_CLOCKWISE,
                false => vk::FrontFace::CLOCKWISE,
            })
            .depth_bias_enable(self.depth_bias)
            .line_width(1.0)
    }

    /// Which vertex flat colours come from, where that is not the first.
    pub(crate) fn provoking_vertex(
        &self,
    ) -> Option<vk::PipelineRasterizationProvokingVertexStateCreateInfoEXT<'static>> {
        let last = vk::ProvokingVertexModeEXT::LAST_VERTEX;
        self.is_last_provoking.then(|| {
            vk::PipelineRasterizationProvokingVertexStateCreateInfoEXT::default().provoking_vertex_mode(last)
        })
    }

    /// How lines are drawn, where the device has a choice.
    pub(crate) fn lines(&self) -> Option<vk::PipelineRasterizationLineStateCreateInfoKHR<'static>> {
        let (mode, stippled) = match self.line {
            LineKind::Default => return None,
            LineKind::Aliased { stippled } => (vk::LineRasterizationModeKHR::BRESENHAM, stippled),
            LineKind::Smooth { stippled } => (vk::LineRasterizationModeKHR::RECTANGULAR_SMOOTH, stippled),
        };
        let lines = vk::PipelineRasterizationLineStateCreateInfoKHR::default()
            .line_rasterization_mode(mode)
            .stippled_line_enable(stippled)
            .line_stipple_factor(1)
            .line_stipple_pattern(u16::MAX);
        Some(lines)
    }

    pub(crate) fn depth_stencil(&self) -> vk::PipelineDepthStencilStateCreateInfo<'static> {
        let mut info = vk::PipelineDepthStencilStateCreateInfo::default();
        if let Some((compare, write)) = self.depth {
            info =
                info.depth_test_enable(true).depth_write_enable(write).depth_compare_op(compare_op(compare));
        }
        if let Some(test) = &self.stencil {
            let state = vk::StencilOpState {
                fail_op: stencil_op(test.fail),
                pass_op: stencil_op(test.pass),
                depth_fail_op: stencil_op(test.depth_fail),
                compare_op: compare_op(test.compare),
                ..Default::default()
            };
            info = info.stencil_test_enable(true).front(state).back(state);
        }
        info
    }

    pub(crate) fn blend_attachment(&self) -> vk::PipelineColorBlendAttachmentState {
        let state = vk::PipelineColorBlendAttachmentState::default().color_write_mask(
            // The bits of the mask are in Vulkan's order.
            vk::ColorComponentFlags::from_raw(u32::from(self.color_mask & 0xf)),
        );
        let Some(blend) = &self.blend else {
            return state;
        };
        state
            .blend_enable(true)
            .src_color_blend_factor(blend_factor(blend.rgb.0))
            .dst_color_blend_factor(blend_factor(blend.rgb.1))
            .color_blend_op(blend_op(blend.equation_rgb))
            .src_alpha_blend_factor(blend_factor(blend.alpha.0))
            .dst_alpha_blend_factor(blend_factor(blend.alpha.1))
            .alpha_blend_op(blend_op(blend.equation_alpha))
    }

    /// The logic operation; both count from GL_CLEAR upward.
    pub(crate) fn logic_op(&self) -> Option<vk::LogicOp> {
        self.logic_op.map(|op| vk::LogicOp::from_raw(i32::from(op & 0xf)))
    }
}

impl StencilTest {
    fn new(stencil: &Stencil) -> Self {
        Self {
            compare: stencil.compare,
            fail: stencil.fail,
            depth_fail: stencil.depth_fail,
            pass: stencil.pass,
        }
    }
}

impl LineKind {
    fn new(stippled: bool, antialiased: bool, features: &Features) -> Self {
        if antialiased && features.smooth_lines {
            Self::Smooth { stippled: stippled && features.stippled_smooth_lines }
        } else if features.bresenham_lines {
            Self::Aliased { stippled: stippled && features.stippled_bresenham_lines }
        } else {
            Self::Default
        }
    }
}

pub(crate) fn compare_op(compare: Compare) -> vk::CompareOp {
    // Both are numbered from NEVER to ALWAYS in the same order.
    vk::CompareOp::from_raw(compare as i32)
}

fn stencil_op(op: StencilOp) -> vk::StencilOp {
    match op {
        StencilOp::Keep => vk::StencilOp::KEEP,
        StencilOp::Zero => vk::StencilOp::ZERO,
        StencilOp::Replace => vk::StencilOp::REPLACE,
        StencilOp::Increment => vk::StencilOp::INCREMENT_AND_CLAMP,
        StencilOp::Decrement => vk::StencilOp::DECREMENT_AND_CLAMP,
        StencilOp::Invert => vk::StencilOp::INVERT,
        StencilOp::IncrementWrap => vk::StencilOp::INCREMENT_AND_WRAP,
        StencilOp::DecrementWrap => vk::StencilOp::DECREMENT_AND_WRAP,
    }
}

fn blend_factor(factor: BlendFactor) -> vk::BlendFactor {
    match factor {
        BlendFactor::Zero => vk::BlendFactor::ZERO,
        BlendFactor::One => vk::BlendFactor::ONE,
        BlendFactor::SourceColor => vk::BlendFactor::SRC_COLOR,
        BlendFactor::OneMinusSourceColor => vk::BlendFactor::ONE_MINUS_SRC_COLOR,
        BlendFactor::DestinationColor => vk::BlendFactor::DST_COLOR,
        BlendFactor::OneMinusDestinationColor => vk::BlendFactor::ONE_MINUS_DST_COLOR,
        BlendFactor::SourceAlpha => vk::BlendFactor::SRC_ALPHA,
        BlendFactor::OneMinusSourceAlpha => vk::BlendFactor::ONE_MINUS_SRC_ALPHA,
        BlendFactor::DestinationAlpha => vk::BlendFactor::DST_ALPHA,
        BlendFactor::OneMinusDestinationAlpha => vk::BlendFactor::ONE_MINUS_DST_ALPHA,
        BlendFactor::SourceAlphaSaturate => vk::BlendFactor::SRC_ALPHA_SATURATE,
        BlendFactor::ConstantColor => vk::BlendFactor::CONSTANT_COLOR,
        BlendFactor::OneMinusConstantColor => vk::BlendFactor::ONE_MINUS_CONSTANT_COLOR,
        BlendFactor::ConstantAlpha => vk::BlendFactor::CONSTANT_ALPHA,
        BlendFactor::OneMinusConstantAlpha => vk::BlendFactor::ONE_MINUS_CONSTANT_ALPHA,
    }
}

fn blend_op(equation: BlendEquation) -> vk::BlendOp {
    match equation {
        BlendEquation::Add => vk::BlendOp::ADD,
        BlendEquation::Subtract => vk::BlendOp::SUBTRACT,
        BlendEquation::ReverseSubtract => vk::BlendOp::REVERSE_SUBTRACT,
        BlendEquation::Min => vk::BlendOp::MIN,
        BlendEquation::Max => vk::BlendOp::MAX,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing;

    #[test]
    fn numbers_and_what_does_not_matter_make_no_new_pipelines() {
        let features = Features::default();
        let key = |raster: &RasterState, topology| PipelineRaster::new(raster, topology, false, &features);
        let plain = testing::raster();
        let wide = RasterState {
            line_width: 3.0.into(),
            depth_bias: Some((1.0.into(), 2.0.into())),
            cull: Cull::Back,
            ..plain
        };
        assert_eq!(key(&plain, Topology::Points), key(&wide, Topology::Points));
        assert_ne!(key(&plain, Topology::Triangles), key(&wide, Topology::Triangles));
        let steeper = RasterState { depth_bias: Some((7.0.into(), 2.0.into())), ..wide };
        assert_eq!(key(&wide, Topology::Triangles), key(&steeper, Topology::Triangles));
    }

    #[test]
    fn comparisons_keep_their_order() {
        assert_eq!(compare_op(Compare::Never), vk::CompareOp::NEVER);
        assert_eq!(compare_op(Compare::NotEqual), vk::CompareOp::NOT_EQUAL);
        assert_eq!(compare_op(Compare::Always), vk::CompareOp::ALWAYS);
    }
}
