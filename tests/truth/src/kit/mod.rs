//! What styles are made of.

mod hall;
mod hud;
mod land;
mod mesh;
mod paths;
mod picture;
mod random;
mod room;
mod shapes;

pub use hall::{Cell, Hall};
pub use hud::{draw_hud, ortho};
pub use land::Land;
pub use mesh::{Mesh, Primitive, Vertex, triangles_of};
pub use paths::{in_sight, look_at, perspective, walk};
pub use picture::Picture;
pub use random::Random;
pub use room::{AMBIENT, Face, Room};
pub use shapes::{boxed, creature, dome, ring, sphere};
