//! Images that take the place of a program's textures: files in a folder, named after what they replace.
//!
//! A texture is known by the hash of its content, 16 hexadecimal digits ([`FileName`]). Three files may replace it, each
//! a PNG, KTX2 or DDS: `HASH` its colour and alpha, `HASH_normal` which way its surface faces and how much of it is metal,
//! `HASH_emission` what it gives off and how rough it is. [`decode`] makes a [`Picture`] of a file, as a device takes it;
//! [`Folder`] does so on a thread of its own, and looks after changes.
//!
//! Files are not trusted: sizes are bounded, and whatever is wrong with one is an [`ImageError`].

mod error;
mod folder;
mod index;
mod mipmaps;
mod name;
mod picture;
mod read;
mod unpack;
mod worker;
mod write;

pub use error::ImageError;
pub use folder::{Arrival, Folder};
pub use name::{FileName, Role};
pub use picture::{Channels, Format, MOST_SIDE, MOST_TEXELS, Picture};
pub use read::{Abilities, MOST_FILE_BYTES, decode};
pub use write::write_png;
