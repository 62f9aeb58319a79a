//! Commands whose methods take their arguments in another shape than C does. Each function is named by
//! `manifests/gl-behaviours.toml`; `None` means that the arguments are not what the command takes.

mod arrays;
mod pixels;
mod textures;

pub use arrays::*;
pub use pixels::*;
pub use textures::*;
