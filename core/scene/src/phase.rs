//! The phases of understanding a frame, by which its cost is told.

/// A phase of understanding a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Phase {
    /// Texels are looked at, and what is dropped is forgotten.
    Images,
    /// Content is hashed, and draws are cut into pieces.
    Shapes,
    /// The state of each draw and its transforms are read.
    Facts,
    /// The stage of the world is found.
    World,
    /// Objects and the camera are followed.
    Follow,
    /// Classes are found.
    Classify,
    /// Lights and sky are gathered, and what is said of the scene is applied.
    Light,
    /// Sources of baked light are looked for.
    Baked,
    /// What is not drawn is remembered.
    Memory,
}

impl Phase {
    /// All phases, in the order in which they first end in a frame.
    pub const ALL: [Phase; 9] = [
        Phase::Images,
        Phase::Shapes,
        Phase::Facts,
        Phase::World,
        Phase::Follow,
        Phase::Classify,
        Phase::Light,
        Phase::Baked,
        Phase::Memory,
    ];

    /// As it is written in reports.
    pub fn name(self) -> &'static str {
        match self {
            Phase::Images => "images",
            Phase::Shapes => "shapes",
            Phase::Facts => "facts",
            Phase::World => "world",
            Phase::Follow => "follow",
            Phase::Classify => "classify",
            Phase::Light => "light",
            Phase::Baked => "baked",
            Phase::Memory => "memory",
        }
    }
}
