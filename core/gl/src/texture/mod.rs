//! Texture objects: levels, parameters, completeness, and the images that they become on a device
//! (OpenGL 1.5 specification, 3.8). Nothing here knows a context; errors are OpenGL's numbers.
//!
//! Texels from the program are kept in memory, and an image is made of them when a draw first needs it.
//! Texels from the frame buffer exist only on the device.

mod complete;
mod compressed;
mod copy;
mod images;
mod internal_format;
mod level;
mod level_image;
mod mipmap;
#[cfg(test)]
mod model_tests;
mod object;
mod parameters;
mod query;
mod realize;
mod s3tc;
mod sampler;
mod specify;
mod sub_image;
mod target;
#[cfg(test)]
mod tests;

pub use copy::CopySource;
pub use internal_format::InternalFormat;
pub use level_image::LevelImage;
pub use object::TextureObject;
pub use parameters::{MAX_ANISOTROPY, MAX_LOD_BIAS, Parameters};
pub use realize::Realized;
pub use s3tc::FORMATS as COMPRESSED_FORMATS;
pub use specify::{ImageDefinition, PixelInput, proxy_fits};
pub use sub_image::SubImage;
pub use target::{ImageTarget, MAX_3D_SIZE, MAX_CUBE_SIZE, MAX_SIZE, TextureTarget};
