//! Commands whose memory needs a rule of its own. Each function has its command's name and parameters, and is called
//! by the entry point; pointers are what the specification of the command wants of the program.

mod arrays;
mod compressed;
mod copies;
mod pixels;
mod queries;
mod textures;
mod window;

pub use arrays::*;
pub use compressed::*;
pub use copies::*;
pub use pixels::*;
pub use queries::*;
pub use textures::*;
pub use window::*;
