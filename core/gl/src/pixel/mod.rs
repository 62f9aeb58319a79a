//! Pixels in the program's memory: how they lie there, what their formats mean, what happens to them
//! on the way in and out. Plain functions; errors are OpenGL's own numbers.
//!
//! Sections are those of the OpenGL 1.5 specification: 3.6 (drawing), 4.3 (reading).

mod bytes;
mod element;
mod geometry;
mod layout;
mod maps;
mod memory;
mod pack;
mod packed;
mod rows;
mod source;
mod store;
mod transfer;
mod unpack;

pub use bytes::restrict;
pub use geometry::{Extent, Geometry, image_size};
pub use layout::{PackedType, PixelFormat, PixelLayout, PixelType};
pub use maps::{MAX_PIXEL_MAP_TABLE, PixelMaps};
pub use memory::{MAX_IMAGE_BYTES, allocate};
pub use pack::{Luminance, PixelTarget, pack_color, pack_depth, pack_stencil};
pub use source::PixelSource;
pub use store::{Packing, PixelStore};
pub use transfer::{PixelTransfer, TransferModes};
pub use unpack::{unpack_color, unpack_depth, unpack_mask, unpack_stencil, unpack_texels};

/// What a command gives, or the OpenGL error that it raises.
pub type GlResult<T> = Result<T, u32>;
