//! Copies from a drawable that is not the one drawn to (glXMakeContextCurrent with two): pixels are read back, and go
//! on as if they were the program's. Slow, and rare.

use afterglow_api::constants::*;

use crate::backend::{Reply, Request};
use crate::context::Context;
use crate::frame::{BaseFormat, ImageCopy, ImageUpload, Operation, PixelBuffer, Rect};
use crate::pixel::{
    Extent, GlResult, Packing, PixelLayout, PixelSource, PixelTransfer, unpack_color, unpack_depth,
};

/// Pixels in memory as a program would give them.
pub(crate) struct Fetched {
    pub(crate) format: u32,
    pub(crate) kind: u32,
    pub(crate) data: Box<[u8]>,
}

/// How they lie there: without gaps.
pub(crate) fn packing() -> Packing {
    Packing { alignment: 1, ..Packing::default() }
}

impl Context {
    /// Says whether pixels are read from another drawable than is drawn to.
    pub fn set_reads_elsewhere(&mut self, reads_elsewhere: bool) {
        self.output.reads_elsewhere = reads_elsewhere;
    }

    /// Pixels of what is read from; nothing without a device.
    pub(crate) fn fetch(&mut self, buffer: PixelBuffer, rect: Rect) -> Option<Fetched> {
        let bytes = GL_UNSIGNED_BYTE;
        let (format, kind, data) = match self.ask(Request::Pixels { buffer, rect }) {
            Reply::Color(colors) => (GL_RGBA, bytes, colors),
            Reply::Depth(depths) => {
                (GL_DEPTH_COMPONENT, GL_FLOAT, depths.into_iter().flat_map(f32::to_ne_bytes).collect())
            }
            Reply::Stencil(values) => (GL_STENCIL_INDEX, bytes, values),
            _ => return None,
        };
        Some(Fetched { format, kind, data: data.into() })
    }

    /// Makes uploads of the copies to textures that were recorded as the operations from `first` on.
    pub(crate) fn fetch_copies(&mut self, first: usize) {
        let recorded: Vec<_> = self.frame.operations.drain(first..).collect();
        for operation in recorded {
            match operation {
                Operation::CopyToImage(copy) => {
                    let upload = self.upload_of(&copy).map(Operation::Upload);
                    self.frame.operations.extend(upload);
                }
                other => self.frame.operations.push(other),
            }
        }
    }

    fn upload_of(&mut self, copy: &ImageCopy) -> Option<ImageUpload> {
        let is_depth = copy.base_format == BaseFormat::Depth;
        let buffer = if is_depth { PixelBuffer::Depth } else { PixelBuffer::Color };
        let fetched = self.fetch(buffer, copy.source)?;
        let texels = match is_depth {
            true => fetched.texels(copy, |source, transfer| {
                let depths = unpack_depth(source, transfer)?;
                Ok(depths.iter().flat_map(|depth| depth.to_ne_bytes()).collect())
            }),
            false => {
                fetched.texels(copy, |source, transfer| unpack_color(source, transfer, copy.base_format))
            }
        };
        Some(ImageUpload { image: copy.image, region: copy.region, texels: texels.ok()? })
    }
}

impl Fetched {
    /// Texels of it; pixel transfer is not applied to copies.
    fn texels<T>(
        &self,
        copy: &ImageCopy,
        unpack: impl FnOnce(&PixelSource<'_>, &PixelTransfer) -> GlResult<T>,
    ) -> GlResult<T> {
        let [width, height, _] = copy.region.extent.map(|side| side as usize);
        let layout = PixelLayout::from_gl(self.format, self.kind)?;
        let source = PixelSource::new(&self.data, layout, &packing(), Extent::plane(width, height))?;
        unpack(&source, &PixelTransfer::default())
    }
}
