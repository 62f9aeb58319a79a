//! Neverball: blending is always on, even for what is opaque. First a dome and billboards far away, both about the eye,
//! without depth writes; then coins, two matrices below the level's; then the level from buffers, in world coordinates,
//! with the ball's shadow on the second texture unit; decals with an offset of depth; the ball, twice: its far side, then
//! its near side. The level is tilted as the player steers: the view that counts is the one after the tilt.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::DMat4;

use super::things::{Motion, Numbers, Sight, Things};
use super::{Drawn, Judged};
use crate::truth::{TrueCamera, UNNAMED};

/// Metres. Coins spin in their places.
const MOTION: Motion = Motion { least: 2e-3, most: 0.6 };
/// Where the matrix of the level is in the stack.
const LEVEL: usize = 3;
/// The textures of the coins and the ball.
const COIN: u32 = 30;
const BALL: u32 = 23;

/// Objects that are no parts of the level.
const ITEMS: u64 = 1_000_000;
const SKY: u64 = 500_000;
const INTERFACE: u64 = 900_000;

/// Judges all frames.
pub fn judge(frames: &[Vec<Drawn>]) -> Vec<Judged> {
    let things = items(frames);
    let mut parts = Numbers::from(1);
    let judged = frames.iter().enumerate().map(|(frame, drawn)| {
        let camera = camera(drawn);
        let mut judge = |drawn: &Drawn| {
            let state = &drawn.state;
            let is_solid = state.has(GL_DEPTH_TEST) && state.depth_mask;
            match camera.filter(|_| drawn.is_perspective()) {
                None => (Class::Interface, INTERFACE),
                Some(_) if is_item(drawn) => things.class(frame, drawn.index).unwrap_or(UNKNOWN),
                // It is half seen through, and moves.
                Some(_) if has_texture(drawn, BALL) => UNKNOWN,
                Some(camera) if is_solid && drawn.modelview() == camera.view => {
                    (Class::Static, parts.of(drawn.content))
                }
                Some(_) if is_solid => UNKNOWN,
                Some(_) if state.has(GL_POLYGON_OFFSET_FILL) => (Class::Layer, UNNAMED),
                Some(_) if !state.has(GL_LIGHTING) => (Class::Sky, SKY),
                Some(_) => UNKNOWN,
            }
        };
        Judged { camera, things: drawn.iter().map(&mut judge).collect() }
    });
    judged.collect()
}

const UNKNOWN: (Class, u64) = (Class::Undecided, UNNAMED);

/// On whichever unit.
fn has_texture(drawn: &Drawn, name: u32) -> bool {
    drawn.state.textures.contains(&Some(name))
}

fn is_item(drawn: &Drawn) -> bool {
    has_texture(drawn, COIN) && drawn.is_perspective() && drawn.state.has(GL_LIGHTING)
}

/// The matrix of the level.
fn camera(drawn: &[Drawn]) -> Option<TrueCamera> {
    let is_level = |drawn: &&Drawn| {
        drawn.is_perspective() && drawn.state.has(GL_LIGHTING) && drawn.stack.len() == LEVEL + 1
    };
    let level = drawn.iter().find(is_level)?;
    Some(TrueCamera { view: level.stack[LEVEL], projection: level.projection })
}

fn items(frames: &[Vec<Drawn>]) -> Things {
    let mut sights = Vec::new();
    for (frame, drawn) in frames.iter().enumerate() {
        let Some(camera) = camera(drawn) else { continue };
        let world_from_eye = camera.view.inverse();
        for drawn in drawn.iter().filter(|drawn| is_item(drawn)) {
            let model: DMat4 = world_from_eye * drawn.modelview();
            let kinds = [drawn.content; 2];
            sights.push(Sight::new([frame, drawn.index], kinds, model, drawn.bounds));
        }
    }
    Things::follow(&sights, MOTION, ITEMS)
}
