//! Rectangles of pixels (glDrawPixels, glBitmap, glCopyPixels) as records for the shader that draws them.

use afterglow_gl::frame::{
    Compare, FixedState, Frame, Operation, PixelBuffer, PixelContent, PixelCopy, PixelRectangle, RasterState,
    Rect, StateWords, Stencil, StencilOp,
};
use afterglow_gpu::{GpuError, vk};
use afterglow_records::{PixelKind, PixelRecord};

use crate::uploads::UploadArena;
use crate::window;

/// Bits of a stencil value; each is drawn by itself.
pub(crate) const STENCIL_BITS: u32 = 8;

/// Pixels in a row or column that the shader's floats can count.
const LONGEST_SIDE: u32 = 1 << 23;

/// The records of one rectangle, in [`Rectangles::records`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rectangle {
    pub(crate) first: u32,
    /// Of stencil values: one record that draws all pixels, then one for each bit.
    pub(crate) is_stencil: bool,
}

/// A frame's rectangles.
#[derive(Default)]
pub(crate) struct Rectangles {
    pub(crate) records: Vec<PixelRecord>,
    /// In the order of their operations; none where nothing is drawn.
    pub(crate) rectangles: Vec<Option<Rectangle>>,
}

/// Where pixels that are copied lie between being read and being drawn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PixelStore {
    pub(crate) address: u64,
    /// Whether depth is stored as 24-bit integers.
    pub(crate) has_depth24: bool,
}

impl Rectangles {
    /// Uploads the pixels of a frame's rectangles.
    pub(crate) fn prepare(
        &mut self,
        frame: &Frame,
        size: [u32; 2],
        store: PixelStore,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        self.records.clear();
        self.rectangles.clear();
        for operation in &frame.operations {
            let record = match operation {
                Operation::Pixels(pixels) => drawn(pixels, frame, arena)?,
                Operation::CopyPixels(copy) => copied(copy, frame, size, store),
                _ => continue,
            };
            self.push(record);
        }
        Ok(())
    }

    fn push(&mut self, record: Option<PixelRecord>) {
        let first = self.records.len() as u32;
        self.rectangles.push(record.map(|record| {
            let is_stencil = record.kind == PixelKind::Stencil as u32;
            self.records.push(record);
            if is_stencil {
                self.records
                    .extend((0..STENCIL_BITS).map(|bit| PixelRecord { stencil_bit: 1 << bit, ..record }));
            }
            Rectangle { first, is_stencil }
        }));
    }
}

/// The record of pixels from the program; none if they are fewer than they should be.
fn drawn(
    pixels: &PixelRectangle,
    frame: &Frame,
    arena: &mut UploadArena,
) -> Result<Option<PixelRecord>, GpuError> {
    let count = u64::from(pixels.width) * u64::from(pixels.height);
    let (kind, bytes, bytes_each): (_, &[u8], _) = match &pixels.content {
        PixelContent::Color(bytes) => (PixelKind::Color, bytes, 4),
        PixelContent::Mask(bytes) => (PixelKind::Mask, bytes, 1),
        PixelContent::Depth(floats) => (PixelKind::Depth, bytemuck::cast_slice(floats), 4),
        PixelContent::Stencil(bytes) => (PixelKind::Stencil, bytes, 1),
    };
    let is_drawable = count > 0
        && pixels.width.max(pixels.height) <= LONGEST_SIDE
        && count <= u64::from(u32::MAX)
        && bytes.len() as u64 >= count * bytes_each
        && is_placed(pixels.position, pixels.zoom);
    if !is_drawable {
        return Ok(None);
    }
    // Only bitmaps are moved to whole pixels (section 3.7).
    let position = match kind {
        PixelKind::Mask => pixels.position.map(f32::floor),
        _ => pixels.position,
    };
    Ok(Some(PixelRecord {
        source: arena.push(bytes)?.address,
        position,
        zoom: pixels.zoom,
        size: [pixels.width as f32, pixels.height as f32],
        row_step: pixels.width as i32,
        kind: kind as u32,
        depth: pixels.depth,
        current: pixels.current.min((frame.current.len() as u32).saturating_sub(1)),
        stencil_bit: 0,
        first_pixel: 0,
    }))
}

/// Whether the shader can tell which pixel a fragment shows.
fn is_placed(position: [f32; 2], zoom: [f32; 2]) -> bool {
    let all_finite = [position, zoom].as_flattened().iter().all(|value| value.is_finite());
    all_finite && zoom.iter().all(|zoom| *zoom != 0.0)
}

/// The part of the window that a copy of pixels reads.
pub(crate) fn copy_source(copy: &PixelCopy, size: [u32; 2]) -> Option<(Rect, vk::Rect2D)> {
    let clipped = window::clip(&copy.source, size)?;
    Some((clipped, window::from_top(&clipped, size)))
}

/// The record of pixels that were read from the window, the highest row first.
fn copied(copy: &PixelCopy, frame: &Frame, size: [u32; 2], store: PixelStore) -> Option<PixelRecord> {
    let (clipped, _) = copy_source(copy, size)?;
    let moved = |axis: usize, from: i32, to: i32| {
        copy.position[axis] + (i64::from(to) - i64::from(from)) as f32 * copy.zoom[axis]
    };
    let kind = match copy.buffer {
        PixelBuffer::Color => PixelKind::Color,
        PixelBuffer::Depth if store.has_depth24 => PixelKind::Depth24,
        PixelBuffer::Depth => PixelKind::Depth,
        PixelBuffer::Stencil => PixelKind::Stencil,
    };
    is_placed(copy.position, copy.zoom).then(|| PixelRecord {
        source: store.address,
        position: [moved(0, copy.source.x, clipped.x), moved(1, copy.source.y, clipped.y)],
        zoom: copy.zoom,
        size: [clipped.width as f32, clipped.height as f32],
        row_step: -clipped.width,
        kind: kind as u32,
        depth: copy.depth,
        current: copy.current.min((frame.current.len() as u32).saturating_sub(1)),
        stencil_bit: 0,
        first_pixel: ((clipped.height - 1) * clipped.width) as u32,
    })
}

/// The state in which one bit of stencil values is written, or all bits are set to zero: nothing but the stencil
/// buffer changes, and every fragment passes (OpenGL 1.5, section 3.6.4).
pub(crate) fn stencil_state(state: &FixedState, bit: Option<u32>) -> FixedState {
    let written = state.raster.stencil.map_or(u32::MAX, |stencil| stencil.write_mask);
    let mut words = StateWords::default();
    words.global.set_alpha_func(Compare::Always as u32);
    FixedState {
        words,
        raster: RasterState {
            blend: None,
            logic_op: None,
            color_mask: 0,
            depth: None,
            stencil: Some(Stencil {
                compare: Compare::Always,
                reference: if bit.is_some() { u32::MAX } else { 0 },
                compare_mask: u32::MAX,
                write_mask: written & bit.map_or(u32::MAX, |bit| 1 << bit),
                fail: StencilOp::Keep,
                depth_fail: StencilOp::Keep,
                pass: StencilOp::Replace,
            }),
            ..state.raster
        },
    }
}
