//! glClear: as a pass begins, within it, or drawn where only some bits are cleared.

use std::ops::Range;

use afterglow_gl::frame::{
    Clear, Compare, Cull, Depth, FixedState, Frame, Operation, RasterState, StateWords, Stencil, StencilOp,
    Topology, VertexLayout, Viewport,
};
use afterglow_gpu::{GpuError, vk};
use afterglow_records::ClearPush;

use crate::passes::raster::RasterPass;
use crate::pipeline_state::PipelineRaster;
use crate::pipelines::{PipelineKey, Program};
use crate::window;

/// All bits of a stencil value.
const STENCIL_MASK: u32 = 0xff;
/// All components of a colour.
const COLOR_MASK: u8 = 0xf;

/// What a pass begins with; none where the contents stay.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub(crate) struct LoadOps {
    color: Option<[f32; 4]>,
    depth: Option<f32>,
    stencil: Option<u32>,
}

impl LoadOps {
    pub(crate) fn color(&self) -> Option<vk::ClearValue> {
        self.color.map(color_value)
    }

    pub(crate) fn depth(&self) -> Option<vk::ClearValue> {
        self.depth.map(|depth| depth_value(depth, 0))
    }

    pub(crate) fn stencil(&self) -> Option<vk::ClearValue> {
        self.stencil.map(|stencil| depth_value(0.0, stencil))
    }
}

/// The clears of the whole window that a run of operations begins with, and the first operation after them.
pub(crate) fn leading(frame: &Frame, range: Range<usize>, size: [u32; 2]) -> (LoadOps, usize) {
    let mut load = LoadOps::default();
    for index in range.clone() {
        match &frame.operations[index] {
            Operation::Clear(clear) => {
                let clear = effective(clear);
                if !is_complete(&clear) || !window::covers(clear.scissor.as_ref(), size) {
                    return (load, index);
                }
                load.color = clear.color.or(load.color);
                load.depth = clear.depth.or(load.depth);
                load.stencil = clear.stencil.map(|(value, _)| value).or(load.stencil);
            }
            Operation::DefineImage { .. } | Operation::Upload(_) | Operation::DropImage(_) => {}
            _ => return (load, index),
        }
    }
    (load, range.end)
}

/// A clear without the parts of which no bit is written.
fn effective(clear: &Clear) -> Clear {
    Clear {
        color: clear.color.filter(|_| clear.color_mask & COLOR_MASK != 0),
        stencil: clear.stencil.filter(|(_, mask)| mask & STENCIL_MASK != 0),
        ..*clear
    }
}

/// Whether all bits are written of what is cleared.
fn is_complete(clear: &Clear) -> bool {
    let all_colors = clear.color.is_none() || clear.color_mask & COLOR_MASK == COLOR_MASK;
    all_colors && clear.stencil.is_none_or(|(_, mask)| mask & STENCIL_MASK == STENCIL_MASK)
}

fn color_value(color: [f32; 4]) -> vk::ClearValue {
    vk::ClearValue {
        color: vk::ClearColorValue { float32: color.map(|component| component.clamp(0.0, 1.0)) },
    }
}

fn depth_value(depth: f32, stencil: u32) -> vk::ClearValue {
    vk::ClearValue {
        depth_stencil: vk::ClearDepthStencilValue {
            depth: depth.clamp(0.0, 1.0),
            stencil: stencil & STENCIL_MASK,
        },
    }
}

impl RasterPass<'_> {
    /// Clears within a pass.
    pub(crate) fn clear(&mut self, clear: &Clear) -> Result<(), GpuError> {
        let clear = effective(clear);
        if is_complete(&clear) {
            self.clear_attachments(&clear);
            return Ok(());
        }
        self.draw_clear(&clear)
    }

    fn clear_attachments(&self, clear: &Clear) {
        let rect = window::scissor(clear.scissor.as_ref(), self.input.target.size);
        let mut attachments = Vec::with_capacity(2);
        let attachment =
            |aspect, value| vk::ClearAttachment::default().aspect_mask(aspect).clear_value(value);
        if let Some(color) = clear.color {
            attachments.push(attachment(vk::ImageAspectFlags::COLOR, color_value(color)));
        }
        let mut aspects = vk::ImageAspectFlags::empty();
        if clear.depth.is_some() {
            aspects |= vk::ImageAspectFlags::DEPTH;
        }
        if clear.stencil.is_some() {
            aspects |= vk::ImageAspectFlags::STENCIL;
        }
        if !aspects.is_empty() {
            let stencil = clear.stencil.map_or(0, |(value, _)| value);
            attachments.push(attachment(aspects, depth_value(clear.depth.unwrap_or(0.0), stencil)));
        }
        if attachments.is_empty() || rect.extent.width == 0 || rect.extent.height == 0 {
            return;
        }
        let rects = [vk::ClearRect { rect, base_array_layer: 0, layer_count: 1 }];
        // SAFETY: the pass has these attachments, and the rectangle lies within them.
        unsafe {
            self.commands.device().cmd_clear_attachments(self.commands.raw(), &attachments, &rects);
        }
    }

    /// Draws a triangle over the window, since the masks leave some bits.
    fn draw_clear(&mut self, clear: &Clear) -> Result<(), GpuError> {
        let fixed = clear_state(clear);
        let topology = Topology::Triangles;
        let features = self.input.gpu.features();
        let pipeline = self.state.pipelines.get(&PipelineKey {
            program: Program::Clear,
            words: fixed.words,
            layout: VertexLayout::default(),
            topology,
            clamps: 0,
            raster: PipelineRaster::new(&fixed.raster, topology, false, features),
            visibility: self.kept_visibility(),
        })?;
        self.set_pipeline(pipeline);
        self.set_numbers(&fixed);
        let size = self.input.target.size;
        self.set_viewport(
            window::window_viewport(size),
            &Viewport { rect: Default::default(), depth_range: [0.0, 1.0], scissor: clear.scissor },
        );
        let push = ClearPush {
            color: clear.color.unwrap_or_default(),
            depth: clear.depth.unwrap_or(0.0).clamp(0.0, 1.0),
        };
        self.commands.push_constants(&self.state.pipelines.clear_layout, &push);
        // SAFETY: the pipeline's state is complete; its vertices need no memory.
        unsafe {
            self.commands.device().cmd_draw(self.commands.raw(), 3, 1, 0, 0);
        }
        self.unbind();
        Ok(())
    }
}

/// The state in which a triangle over the window is a clear.
fn clear_state(clear: &Clear) -> FixedState {
    let (value, write_mask) = clear.stencil.unwrap_or_default();
    FixedState {
        words: StateWords::default(),
        raster: RasterState {
            blend: None,
            logic_op: None,
            color_mask: if clear.color.is_some() { clear.color_mask } else { 0 },
            depth: clear.depth.map(|_| Depth { compare: Compare::Always, write: true }),
            stencil: clear.stencil.map(|_| Stencil {
                compare: Compare::Always,
                reference: value,
                compare_mask: STENCIL_MASK,
                write_mask,
                fail: StencilOp::Keep,
                depth_fail: StencilOp::Keep,
                pass: StencilOp::Replace,
            }),
            cull: Cull::None,
            front_ccw: true,
            depth_bias: None,
            line_width: 1.0.into(),
            line_stipple: None,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afterglow_gl::frame::Rect;

    const WHOLE: Clear =
        Clear { color: Some([1.0; 4]), color_mask: 0xf, depth: Some(0.5), stencil: None, scissor: None };

    fn load_of(clears: &[Clear]) -> (LoadOps, usize) {
        let operations: Vec<_> = clears.iter().copied().map(Operation::Clear).collect();
        let frame = Frame { operations, ..Frame::default() };
        leading(&frame, 0..clears.len(), [4, 4])
    }

    #[test]
    fn whole_clears_begin_a_pass() {
        let stencil = Clear { color: None, depth: None, stencil: Some((3, 0xffff_ffff)), ..WHOLE };
        let (load, rest) = load_of(&[WHOLE, stencil]);
        assert_eq!((load.depth, load.stencil, rest), (Some(0.5), Some(3), 2));

        let masked = Clear { color_mask: 0b0111, ..WHOLE };
        assert_eq!(load_of(&[masked]), (LoadOps::default(), 0));
        let unwritten = Clear { color_mask: 0, ..WHOLE };
        assert_eq!(load_of(&[unwritten]).0.color, None);
        let part = Rect { width: 4, height: 3, ..Rect::default() };
        let part = Clear { scissor: Some(part), ..WHOLE };
        assert_eq!(load_of(&[part, WHOLE]), (LoadOps::default(), 0));
    }
}
