//! The OpenGL API as data, generated from the Khronos XML by `afterglow-gen`.
//!
//! [`constants`] has the enumerants of OpenGL 1.5 and the extensions of its time, [`Command`] what is
//! known of an entry point, [`id`] a [`CommandId`] for each that code may name.

mod command;
mod enumerant;
mod generated;

pub use command::{Api, Base, CType, Command, CommandId, Length, Param, Scope};
pub use enumerant::{enumerant_in_group, enumerant_name, enumerant_names};
pub use generated::constants;
/// Ids of the commands in scope and of those of the window systems, by their names in C.
pub use generated::ids as id;
