//! Rectangles of pixels (glDrawPixels, glBitmap, glCopyPixels), drawn as fragments.

use afterglow_gl::frame::{
    Cull, FixedState, Frame, Operation, PixelBuffer, PixelCopy, PixelRectangle, RasterState, Topology,
    VertexLayout,
};
use afterglow_gpu::{Commands, GpuError, vk};
use afterglow_records::DrawPush;

use crate::passes::copy::{read_image, window_region};
use crate::passes::raster::RasterPass;
use crate::pipeline_state::PipelineRaster;
use crate::pipelines::{PipelineKey, Program};
use crate::rectangles::{STENCIL_BITS, copy_source, stencil_state};
use crate::store::Store;
use crate::target::Target;
use crate::window;

/// The state that a rectangle's fragments meet, as numbers of the frame's tables.
pub(crate) struct PixelState {
    fixed: u32,
    viewport: u32,
    bindings: u32,
    environment: u32,
}

impl From<&PixelRectangle> for PixelState {
    fn from(pixels: &PixelRectangle) -> Self {
        Self {
            fixed: pixels.fixed,
            viewport: pixels.viewport,
            bindings: pixels.bindings,
            environment: pixels.environment,
        }
    }
}

impl From<&PixelCopy> for PixelState {
    fn from(copy: &PixelCopy) -> Self {
        Self {
            fixed: copy.fixed,
            viewport: copy.viewport,
            bindings: copy.bindings,
            environment: copy.environment,
        }
    }
}

/// What a copy of pixels reads: which buffer, and which part of it.
fn read_rect(frame: &Frame, operation: usize, size: [u32; 2]) -> Option<(PixelBuffer, vk::Rect2D)> {
    match &frame.operations[operation] {
        Operation::CopyPixels(copy) => {
            let (_, rect) = copy_source(copy, size)?;
            Some((copy.buffer, rect))
        }
        _ => None,
    }
}

/// Bytes that a copy's pixels need in the store.
pub(crate) fn store_bytes(frame: &Frame, operation: usize, size: [u32; 2]) -> u64 {
    read_rect(frame, operation, size)
        .map_or(0, |(_, rect)| u64::from(rect.extent.width) * u64::from(rect.extent.height) * 4)
}

/// Records the copy of the window's pixels to the store, from where they are drawn.
pub(crate) fn record_read(
    commands: &Commands<'_>,
    frame: &Frame,
    operation: usize,
    target: &Target,
    store: &Store,
) {
    let source = read_rect(frame, operation, target.size);
    let (Some((pixels, rect)), Some(buffer)) = (source, store.buffer()) else {
        return;
    };
    let (image, aspect) = match pixels {
        PixelBuffer::Color => (&target.color, vk::ImageAspectFlags::COLOR),
        PixelBuffer::Depth => (&target.depth, vk::ImageAspectFlags::DEPTH),
        PixelBuffer::Stencil => (&target.depth, vk::ImageAspectFlags::STENCIL),
    };
    let regions = [window_region(aspect, rect, 0)];
    read_image(commands, image.raw(), buffer.raw(), &regions);
}

impl RasterPass<'_> {
    /// Draws the frame's rectangle of this number.
    pub(crate) fn pixels(&mut self, state: &PixelState, number: usize) -> Result<(), GpuError> {
        let frame = self.input.frame;
        let rectangle = self.input.rectangles.rectangles[number];
        let (Some(rectangle), Some(fixed), Some(viewport)) =
            (rectangle, frame.fixed.get(state.fixed as usize), frame.viewports.get(state.viewport as usize))
        else {
            return Ok(());
        };
        let size = self.input.target.size;
        self.set_viewport(window::window_viewport(size), viewport);
        let clamps = self.clamps(state.bindings)?;
        let push = self.push_of(state.bindings, state.environment)?;
        if rectangle.is_stencil {
            // All bits are set to zero first, then each one where the source has it.
            for record in 0..=STENCIL_BITS {
                let push = DrawPush { pixels: rectangle.first + record, ..push };
                let state = stencil_state(fixed, record.checked_sub(1));
                self.draw_pixels(&state, clamps, &push)?;
            }
        } else {
            let push = DrawPush { pixels: rectangle.first, ..push };
            self.draw_pixels(fixed, clamps, &push)?;
        }
        self.unbind();
        Ok(())
    }

    fn draw_pixels(&mut self, fixed: &FixedState, clamps: u32, push: &DrawPush) -> Result<(), GpuError> {
        let topology = Topology::Triangles;
        // What concerns polygons does not concern these fragments.
        let raster = RasterState { cull: Cull::None, front_ccw: true, depth_bias: None, ..fixed.raster };
        let features = self.input.gpu.features();
        let pipeline = self.state.pipelines.get(&PipelineKey {
            program: Program::Pixels,
            words: fixed.words,
            layout: VertexLayout::default(),
            topology,
            clamps,
            raster: PipelineRaster::new(&raster, topology, false, features),
            visibility: self.kept_visibility(),
        })?;
        self.set_pipeline(pipeline);
        self.set_numbers(&FixedState { raster, ..*fixed });
        self.commands.push_constants(&self.state.pipelines.draw_layout, push);
        // SAFETY: the pipeline's state is complete; its vertices need no memory.
        unsafe {
            self.commands.device().cmd_draw(self.commands.raw(), 6, 1, 0, 0);
        }
        Ok(())
    }
}
