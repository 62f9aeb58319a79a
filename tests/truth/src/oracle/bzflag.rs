//! BZFlag: the view is multiplied at the second place of the stack. First the background without depth test: a sky, the
//! ground in world coordinates, cut anew about the eye, mountains far outside of the world, clouds, tracks on the ground.
//! Then the world: walls and buildings in world coordinates, tanks and flags below matrices of their own, shots and
//! explosions blended. Panels, radar and lines of text are orthographic.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::DMat4;

use super::things::{Motion, Numbers, Sight, Things};
use super::{Drawn, Judged};
use crate::truth::{TrueCamera, UNNAMED};

/// Units of the map, in which a tank is 6 long.
const MOTION: Motion = Motion { least: 0.01, most: 30.0 };
/// Where the view is in the stack.
const VIEW: usize = 1;
/// The textures of the ground, of the clouds, and those of the mountains.
const GROUND: u32 = 5;
const CLOUDS: u32 = 7;
const MOUNTAINS: std::ops::RangeInclusive<u32> = 9..=13;

/// Objects that are no parts of the world.
const MOVING: u64 = 1_000_000;
const FIELD: u64 = 400_000;
const SKY: u64 = 500_000;
const EFFECTS: u64 = 600_000;
const INTERFACE: u64 = 900_000;

const UNKNOWN: (Class, u64) = (Class::Undecided, UNNAMED);

/// Judges all frames.
pub fn judge(frames: &[Vec<Drawn>]) -> Vec<Judged> {
    let things = moving(frames);
    let mut parts = Numbers::from(1);
    let judged = frames.iter().enumerate().map(|(frame, drawn)| {
        let camera = camera(drawn);
        let mut judge = |drawn: &Drawn| match part(drawn, camera) {
            Part::Interface => (Class::Interface, INTERFACE),
            Part::Ground => (Class::Static, FIELD),
            Part::Sky => (Class::Sky, SKY),
            Part::Track => (Class::Layer, FIELD),
            Part::Building => (Class::Static, parts.of(drawn.content)),
            Part::Moving => things.class(frame, drawn.index).unwrap_or(UNKNOWN),
            Part::Effect => (Class::Translucent, EFFECTS),
            Part::Unknown => UNKNOWN,
        };
        Judged { camera, things: drawn.iter().map(&mut judge).collect() }
    });
    judged.collect()
}

/// Where a draw belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Interface,
    Ground,
    Sky,
    Track,
    Building,
    Moving,
    Effect,
    Unknown,
}

fn part(drawn: &Drawn, camera: Option<TrueCamera>) -> Part {
    let state = &drawn.state;
    let Some(camera) = camera.filter(|_| drawn.is_perspective()) else { return Part::Interface };
    let is_placed = drawn.modelview() != camera.view;
    match (state.has(GL_DEPTH_TEST), state.depth_mask) {
        // The light of shots and of what bursts is added over the ground, in discs.
        (false, true) if drawn.texture() == GROUND && drawn.blending().is_some() => Part::Track,
        (false, true) if drawn.texture() == GROUND => Part::Ground,
        // As far as the sky, and yet at a place: nobody can say.
        (false, true) if MOUNTAINS.contains(&drawn.texture()) => Part::Unknown,
        (false, true) if drawn.texture() == CLOUDS || state.textures[0].is_none() => Part::Sky,
        (false, false) if drawn.blending().is_some() => Part::Track,
        (true, true) if drawn.blending().is_none() && is_placed => Part::Moving,
        (true, true) if drawn.blending().is_none() => Part::Building,
        (true, false) if drawn.blending().is_some() => Part::Effect,
        _ => Part::Unknown,
    }
}

/// The view, and the projection of what is drawn with depth.
fn camera(drawn: &[Drawn]) -> Option<TrueCamera> {
    let is_world =
        |drawn: &&Drawn| drawn.is_perspective() && drawn.state.has(GL_DEPTH_TEST) && drawn.clears > 0;
    let world = drawn.iter().find(is_world)?;
    Some(TrueCamera { view: *world.stack.get(VIEW)?, projection: world.projection })
}

/// What has a matrix of its own: the same display list, or as many triangles of one texture.
fn moving(frames: &[Vec<Drawn>]) -> Things {
    let mut sights = Vec::new();
    for (frame, drawn) in frames.iter().enumerate() {
        let Some(camera) = camera(drawn) else { continue };
        let world_from_eye = camera.view.inverse();
        for drawn in drawn.iter().filter(|drawn| part(drawn, Some(camera)) == Part::Moving) {
            let kind = match drawn.lists.is_empty() {
                true => u64::from(drawn.texture()) << 32 | drawn.triangles,
                false => drawn.content,
            };
            let model: DMat4 = world_from_eye * drawn.modelview();
            sights.push(Sight::new([frame, drawn.index], [kind, drawn.content], model, drawn.bounds));
        }
    }
    Things::follow(&sights, MOTION, MOVING)
}
