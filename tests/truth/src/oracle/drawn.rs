//! Draws, as oracles see them.

use std::rc::Rc;

use glam::{DMat4, Vec3};

use super::State;
use super::step::Opacity;

/// A draw.
#[derive(Debug, Clone)]
pub struct Drawn {
    /// Draws of a frame count from 0.
    pub index: usize,
    /// What glBegin and the like take.
    pub mode: u32,
    /// Triangles that OpenGL makes of it.
    pub triangles: u64,
    /// MODELVIEW matrices, the current one last.
    pub stack: Rc<[DMat4]>,
    /// The matrix that MODELVIEW was last set to as a whole, before what was multiplied to it.
    pub loaded: DMat4,
    /// The current PROJECTION matrix.
    pub projection: DMat4,
    /// State that it meets.
    pub state: Rc<State>,
    /// How opaque the texture of unit 0 is.
    pub opacity: Opacity,
    /// Display lists that it is in, outermost first.
    pub lists: Rc<[u32]>,
    /// Buffer that holds its vertices, or 0.
    pub buffer: u32,
    /// Which pair of glLockArrays and glUnlockArrays of the frame it is in, or the one after which it is.
    pub lock: u32,
    /// How often depth was cleared in the frame before it.
    pub clears: u32,
    /// Its positions in order, object space.
    pub positions: Rc<[Vec3]>,
    /// Hash of its positions in order.
    pub content: u64,
    /// Hash of the positions of each triangle, in any order of corners.
    pub keys: Rc<[u64]>,
    /// Least and most of the positions, object space.
    pub bounds: [Vec3; 2],
}

impl Drawn {
    /// The current MODELVIEW matrix.
    pub fn modelview(&self) -> DMat4 {
        self.stack.last().copied().unwrap_or(DMat4::IDENTITY)
    }

    /// Whether the projection makes far things small.
    pub fn is_perspective(&self) -> bool {
        self.projection.row(3).truncate().length() > 1e-9
    }

    /// The texture of unit 0.
    pub fn texture(&self) -> u32 {
        self.state.textures[0].unwrap_or(0)
    }

    /// Factors of blending, if it is on.
    pub fn blending(&self) -> Option<(u32, u32)> {
        self.state.blending()
    }
}
