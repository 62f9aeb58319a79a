//! NumPy's arrays in files: `.npy` (NEP 1), a short text header and the bare numbers, and `.npz`, a ZIP archive of them.
//!
//! Files may be damaged or hostile: nothing is allocated because a file claims that it is there, archives are read within
//! a bound that the caller gives, and whatever contradicts itself is an error.

mod archive;
mod array;
mod error;
mod header;

pub use archive::Archive;
pub use array::Array;
pub use error::NpyError;
pub use header::{Element, Header, MAGIC};
