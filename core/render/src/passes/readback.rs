//! Answers to the program's questions: pixels of the window, texels of images.

use afterglow_gl::backend::{Reply, Request};
use afterglow_gl::frame::{Frame, ImageKey, ImageShape, Operation, PixelBuffer, Rect, Region, TexelFormat};
use afterglow_gpu::{Access, Buffer, BufferDesc, BufferKind, Commands, Gpu, GpuError, memory_barrier, vk};

use crate::passes::copy::{read_image, window_region};
use crate::target::{DepthFormat, Target};
use crate::textures::{TEXEL_BYTES, Textures, expand, holds, texel_count};
use crate::window;

/// Pixels that may be asked for at once.
pub(crate) const MOST_PIXELS: u64 = 1 << 26;

/// What is read back.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Question {
    Window {
        buffer: PixelBuffer,
        /// As asked for.
        rect: Rect,
        /// What of it lies in the window.
        clipped: Rect,
    },
    Texels {
        image: ImageKey,
        region: Region,
    },
}

/// A question with the memory that its answer goes to.
pub(crate) struct Readback {
    pub(crate) question: Question,
    memory: Buffer,
    /// Of the texels or pixels in memory.
    bytes: usize,
}

/// What a request that needs nothing of the device, or cannot be answered, is answered at once.
pub(crate) enum Asked {
    Read(Question),
    Answered(Reply),
}

impl Question {
    /// What must be read for a request after `frame`.
    pub(crate) fn of(request: &Request, frame: &Frame, size: [u32; 2], textures: &Textures) -> Asked {
        match *request {
            Request::Pixels { buffer, rect } => {
                let pixels = |length: i32| u64::from(length.max(0).unsigned_abs());
                if pixels(rect.width) * pixels(rect.height) > MOST_PIXELS {
                    return Asked::Answered(Reply::Unavailable);
                }
                match window::clip(&rect, size) {
                    Some(clipped) => Asked::Read(Self::Window { buffer, rect, clipped }),
                    None => Asked::Answered(nothing(buffer, &rect)),
                }
            }
            Request::Texels { image, region } => {
                let known = textures.get(image).map(|texture| texture.shape);
                match known.or_else(|| defined_shape(frame, image)) {
                    Some(shape) if holds(&shape, &region) => Asked::Read(Self::Texels { image, region }),
                    _ => Asked::Answered(Reply::Unavailable),
                }
            }
            Request::Query(_) | Request::Finish => Asked::Answered(Reply::Done),
        }
    }
}

/// The shape of an image that a frame defines.
fn defined_shape(frame: &Frame, key: ImageKey) -> Option<ImageShape> {
    frame.operations.iter().find_map(|operation| match operation {
        Operation::DefineImage { image, shape } if *image == key => Some(*shape),
        _ => None,
    })
}

impl Readback {
    pub(crate) fn new(gpu: &Gpu, question: Question) -> Result<Self, GpuError> {
        let bytes = match &question {
            Question::Window { buffer, clipped, .. } => {
                let each = if *buffer == PixelBuffer::Stencil { 1 } else { 4 };
                clipped.width as usize * clipped.height as usize * each
            }
            Question::Texels { region, .. } => texel_count(region) * TEXEL_BYTES,
        };
        let desc = BufferDesc::new("readback", BufferKind::Readback, bytes as u64);
        Ok(Self { question, memory: gpu.create_buffer(&desc)?, bytes })
    }

    pub(crate) fn record(&self, commands: &Commands<'_>, target: &Target, textures: &Textures) {
        match &self.question {
            Question::Window { buffer, clipped, .. } => {
                let (image, aspect) = match buffer {
                    PixelBuffer::Color => (&target.color, vk::ImageAspectFlags::COLOR),
                    PixelBuffer::Depth => (&target.depth, vk::ImageAspectFlags::DEPTH),
                    PixelBuffer::Stencil => (&target.depth, vk::ImageAspectFlags::STENCIL),
                };
                let rect = window::from_top(clipped, target.size);
                let regions = [window_region(aspect, rect, 0)];
                read_image(commands, image.raw(), self.memory.raw(), &regions);
            }
            Question::Texels { image, region } => {
                if let Some(texture) = textures.get(*image) {
                    let regions = [texture.buffer_copy(region, 0)];
                    // SAFETY: the image is in this layout and holds the region, and the buffer has room for it.
                    unsafe {
                        commands.device().cmd_copy_image_to_buffer(
                            commands.raw(),
                            texture.image.raw(),
                            vk::ImageLayout::GENERAL,
                            self.memory.raw(),
                            &regions,
                        );
                    }
                }
            }
        }
        commands.barriers(&[memory_barrier(Access::TRANSFER_WRITE, Access::HOST_READ)], &[]);
    }

    /// The bytes as they were read, rows of the window from the top. The device must have finished.
    pub(crate) fn bytes(&self) -> Result<Vec<u8>, GpuError> {
        let mut bytes = vec![0; self.bytes];
        self.memory.read(0, &mut bytes)?;
        Ok(bytes)
    }

    /// The answer. The device must have finished.
    pub(crate) fn reply(&self, depth_format: DepthFormat, textures: &Textures) -> Result<Reply, GpuError> {
        let mut bytes = self.bytes()?;
        Ok(match &self.question {
            Question::Window { buffer, rect, clipped } => match buffer {
                PixelBuffer::Color => Reply::Color(placed(&bytes, rect, clipped, 4)),
                PixelBuffer::Stencil => Reply::Stencil(placed(&bytes, rect, clipped, 1)),
                PixelBuffer::Depth => {
                    let words = placed(&bytes, rect, clipped, 4);
                    Reply::Depth(depths(&words, depth_format.maximum()))
                }
            },
            Question::Texels { image, .. } => match textures.get(*image) {
                Some(texture) if texture.shape.format == TexelFormat::Depth32 => {
                    Reply::Depth(depths(&bytes, 0))
                }
                texture => {
                    if let Some(texture) = texture {
                        expand(texture.shape.base_format, &mut bytes);
                    }
                    Reply::Color(bytes)
                }
            },
        })
    }
}

/// The answer about a rectangle outside of the window.
fn nothing(buffer: PixelBuffer, rect: &Rect) -> Reply {
    let pixels = rect.width.max(0) as usize * rect.height.max(0) as usize;
    match buffer {
        PixelBuffer::Color => Reply::Color(vec![0; pixels * 4]),
        PixelBuffer::Depth => Reply::Depth(vec![0.0; pixels]),
        PixelBuffer::Stencil => Reply::Stencil(vec![0; pixels]),
    }
}

/// Pixels that were read, the highest row first, in their place in the rectangle, the lowest row first.
fn placed(bytes: &[u8], rect: &Rect, clipped: &Rect, pixel_bytes: usize) -> Vec<u8> {
    let pitch = rect.width as usize * pixel_bytes;
    let mut result = vec![0; pitch * rect.height as usize];
    let row_bytes = clipped.width as usize * pixel_bytes;
    let left = clipped.x.abs_diff(rect.x) as usize * pixel_bytes;
    let first_row = clipped.y.abs_diff(rect.y) as usize;
    let rows = result.chunks_exact_mut(pitch).skip(first_row);
    for (target, source) in rows.zip(bytes.chunks_exact(row_bytes).rev()) {
        target[left..left + row_bytes].copy_from_slice(source);
    }
    result
}

/// Depths from words: integers up to `maximum`, or floats if that is 0.
fn depths(bytes: &[u8], maximum: u32) -> Vec<f32> {
    let words = bytes.as_chunks::<4>().0.iter().copied();
    if maximum == 0 {
        return words.map(f32::from_le_bytes).collect();
    }
    let greatest = f64::from(maximum);
    words.map(|word| (f64::from(u32::from_le_bytes(word) & maximum) / greatest) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_turned_and_what_lies_outside_is_zero() {
        let rect = Rect { x: -1, y: 0, width: 3, height: 3 };
        let clipped = Rect { x: 0, y: 0, width: 2, height: 2 };
        let placed = placed(&[3, 4, 1, 2], &rect, &clipped, 1);
        assert_eq!(placed, [0, 1, 2, 0, 3, 4, 0, 0, 0]);
    }

    #[test]
    fn depth_has_24_bits_or_is_a_float() {
        let words = [0x00ff_ffff_u32, 0xab00_0000].map(u32::to_le_bytes).concat();
        assert_eq!(depths(&words, 0xff_ffff), [1.0, 0.0]);
        assert_eq!(depths(&0.25_f32.to_le_bytes(), 0), [0.25]);
    }
}
