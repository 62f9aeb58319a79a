//! The accumulation buffer (glAccum): four floats a pixel, in memory only where a program uses it.

use afterglow_frame_graph::ResourceState;
use afterglow_gl::frame::{AccumulateOp, Frame, Operation};
use afterglow_gpu::{
    Buffer, BufferDesc, BufferKind, Commands, ComputeDesc, ComputePipeline, Gpu, GpuError, vk,
};
use afterglow_records::{AccumulatePush, Accumulation};

use crate::passes::copy::{read_image, window_region};
use crate::store::Store;
use crate::target::Target;
use crate::window;

/// Bytes of a pixel.
const PIXEL_BYTES: u64 = 16;
/// Pixels of a workgroup's side.
const WORKGROUP: u32 = 8;

/// The shader, and the buffer of one window size. Few windows need either.
pub(crate) struct Accumulator {
    gpu: Gpu,
    pipeline: Option<ComputePipeline>,
    buffer: Option<(Buffer, [u32; 2])>,
    pub(crate) state: ResourceState,
}

/// One operation on a part of the window.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Accumulated {
    pub(crate) operation: Accumulation,
    value: f32,
    clear: [f32; 4],
    pub(crate) rect: vk::Rect2D,
}

impl Accumulated {
    /// What a frame's operation does; none if it does nothing.
    pub(crate) fn of(frame: &Frame, operation: usize, size: [u32; 2]) -> Option<Self> {
        let (operation, value, clear, scissor) = match &frame.operations[operation] {
            Operation::ClearAccumulation(color) => (Accumulation::Clear, 0.0, *color, None),
            Operation::Accumulate(op, value, scissor) => (kind(*op), *value, [0.0; 4], scissor.as_ref()),
            _ => return None,
        };
        let rect = window::scissor(scissor, size);
        (rect.extent.width > 0 && rect.extent.height > 0).then_some(Self { operation, value, clear, rect })
    }

    /// Whether it needs the window's colours.
    pub(crate) fn reads_window(&self) -> bool {
        matches!(self.operation, Accumulation::Accumulate | Accumulation::Load)
    }

    /// Whether it replaces the window's colours.
    pub(crate) fn writes_window(&self) -> bool {
        self.operation == Accumulation::Return
    }

    /// Bytes of the rectangle's colours.
    pub(crate) fn store_bytes(&self) -> u64 {
        u64::from(self.rect.extent.width) * u64::from(self.rect.extent.height) * 4
    }

    /// Records the copy of the window's colours to the store.
    pub(crate) fn record_read(&self, commands: &Commands<'_>, target: &Target, store: &Store) {
        if let Some(buffer) = store.buffer() {
            let regions = [window_region(vk::ImageAspectFlags::COLOR, self.rect, 0)];
            read_image(commands, target.color.raw(), buffer.raw(), &regions);
        }
    }

    /// Records the copy of the store's colours to the window.
    pub(crate) fn record_write(&self, commands: &Commands<'_>, target: &Target, store: &Store) {
        let Some(buffer) = store.buffer() else { return };
        let regions = [window_region(vk::ImageAspectFlags::COLOR, self.rect, 0)];
        // SAFETY: the image is in this layout, and holds the rectangle.
        unsafe {
            commands.device().cmd_copy_buffer_to_image(
                commands.raw(),
                buffer.raw(),
                target.color.raw(),
                vk::ImageLayout::TRANSFER_DST_OPTIMAL,
                &regions,
            );
        }
    }
}

impl Accumulator {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self { gpu: gpu.clone(), pipeline: None, buffer: None, state: ResourceState::SETTLED }
    }

    /// Makes a buffer of zeros unless there is one for this window size.
    pub(crate) fn reserve(&mut self, size: [u32; 2]) -> Result<(), GpuError> {
        if self.pipeline.is_none() {
            let desc = ComputeDesc::new("accumulate.comp", afterglow_shaders::ACCUMULATE_COMP)
                .push_constants(size_of::<AccumulatePush>() as u32);
            self.pipeline = Some(self.gpu.create_compute_pipeline(&desc)?);
        }
        if self.buffer.as_ref().is_some_and(|(_, made_for)| *made_for == size) {
            return Ok(());
        }
        let bytes = u64::from(size[0]) * u64::from(size[1]) * PIXEL_BYTES;
        let desc = BufferDesc::new("accumulation", BufferKind::Device, bytes);
        let buffer = self.gpu.create_buffer(&desc)?;
        self.gpu.submit(|commands| commands.fill_buffer(&buffer, 0))?;
        self.buffer = Some((buffer, size));
        self.state = ResourceState::after(afterglow_frame_graph::Access::TransferDst);
        Ok(())
    }

    /// Bytes of the buffer.
    pub(crate) fn bytes(&self) -> u64 {
        self.buffer.as_ref().map_or(0, |(buffer, _)| buffer.size())
    }

    /// Records the arithmetic.
    pub(crate) fn record(&self, commands: &Commands<'_>, item: &Accumulated, store: &Store) {
        let (Some(pipeline), Some((buffer, [pitch, _]))) = (&self.pipeline, &self.buffer) else {
            return;
        };
        let vk::Rect2D { offset, extent } = item.rect;
        let push = AccumulatePush {
            accumulation: buffer.address(),
            colors: store.address(),
            rectangle: [offset.x as u32, offset.y as u32, extent.width, extent.height],
            pitch: *pitch,
            operation: item.operation as u32,
            value: item.value,
            padding: 0,
            clear: item.clear,
        };
        let groups = [extent.width, extent.height].map(|side| side.div_ceil(WORKGROUP));
        commands.compute(pipeline, &[], &push, [groups[0], groups[1], 1]);
    }
}

fn kind(op: AccumulateOp) -> Accumulation {
    match op {
        AccumulateOp::Accumulate => Accumulation::Accumulate,
        AccumulateOp::Load => Accumulation::Load,
        AccumulateOp::Return => Accumulation::Return,
        AccumulateOp::Multiply => Accumulation::Multiply,
        AccumulateOp::Add => Accumulation::Add,
    }
}
