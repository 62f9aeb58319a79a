//! OpenArena on ioquake3's opengl1 renderer. A view loads the camera's matrix, draws the sky with the depth range at the
//! far end, then batches of surfaces by shader, each between glLockArrays and glUnlockArrays: the first stage of a
//! shader is the surface, the others are layers of it. Surfaces of the map, sprites and marks are in world coordinates
//! under the camera's matrix; entities have matrices of their own and are animated by the CPU. The weapon is drawn at
//! the near end of the depth range. At last comes the status bar, orthographic, with heads in small viewports.

use std::collections::{HashMap, HashSet};

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::DMat4;

use super::things::{Motion, Sight, Things};
use super::{Drawn, Judged};
use crate::truth::{TrueCamera, UNNAMED};

/// Units of the map, of which a player is 56 tall and runs 320 a second. A demo that is played faster than it is drawn
/// leaves a third of a second between frames.
const MOTION: Motion = Motion { least: 0.1, most: 250.0 };
/// Width from which on a viewport is the window's: heads in the status bar have small ones.
const WINDOW_WIDTH: i32 = 320;

/// Objects that are no entities.
const WORLD: u64 = UNNAMED;
const WEAPON: u64 = 700_000;
const SKY: u64 = 500_000;
const EFFECTS: u64 = 600_000;
const INTERFACE: u64 = 900_000;

/// Where a draw belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Interface,
    Sky,
    Weapon,
    Map,
    Entity,
}

/// Judges all frames.
pub fn judge(frames: &[Vec<Drawn>]) -> Vec<Judged> {
    let map = Map::of(frames);
    let things = entities(frames);
    let judged = frames.iter().enumerate().map(|(frame, drawn)| {
        let camera = camera(drawn);
        let mut batch = Batch::default();
        let judge = |drawn: &Drawn| batch.judge(drawn, camera, &map, |draw| things.class(frame, draw));
        Judged { camera, things: drawn.iter().map(judge).collect() }
    });
    judged.collect()
}

/// The matrix that a view loads first.
fn camera(drawn: &[Drawn]) -> Option<TrueCamera> {
    let first =
        drawn.iter().find(|drawn| drawn.is_perspective() && drawn.state.viewport[2] >= WINDOW_WIDTH)?;
    Some(TrueCamera { view: *first.stack.first()?, projection: first.projection })
}

fn part(drawn: &Drawn, camera: Option<TrueCamera>) -> Part {
    let state = &drawn.state;
    let Some(camera) = camera else { return Part::Interface };
    if !drawn.is_perspective() || state.viewport[2] < WINDOW_WIDTH {
        return Part::Interface;
    }
    match state.depth_range {
        [1.0, 1.0] => Part::Sky,
        [0.0, far] if far < 1.0 => Part::Weapon,
        _ if drawn.modelview() == camera.view => Part::Map,
        _ => Part::Entity,
    }
}

/// Whether a stage covers what was there.
fn is_solid(drawn: &Drawn) -> bool {
    drawn.blending().is_none() && drawn.state.depth_mask
}

/// What all frames together tell of the map.
#[derive(Debug, Default)]
struct Map {
    /// Triangles that were drawn in more than one frame.
    still: HashSet<u64>,
    /// Textures of surfaces whose triangles are elsewhere in each frame: shaders move them.
    waving: HashSet<u32>,
}

/// Frames that show how a texture's surfaces are.
const FRAMES: usize = 8;

impl Map {
    fn of(frames: &[Vec<Drawn>]) -> Map {
        let (mut once, mut map) = (HashSet::new(), Map::default());
        // Of each texture: frames, triangles, different triangles.
        let mut textures: HashMap<u32, (usize, usize, HashSet<u64>)> = HashMap::new();
        for drawn in frames {
            let camera = camera(drawn);
            let mut keys = HashSet::new();
            for drawn in drawn.iter().filter(|d| part(d, camera) == Part::Map && is_solid(d)) {
                keys.extend(drawn.keys.iter().copied());
                let (frames, count, different) = textures.entry(drawn.texture()).or_default();
                *frames += 1;
                *count += drawn.keys.len();
                different.extend(drawn.keys.iter().copied());
            }
            map.still.extend(keys.iter().filter(|key| once.contains(*key)));
            once.extend(keys);
        }
        let waving = textures
            .into_iter()
            .filter(|(_, (frames, count, different))| *frames >= FRAMES && 10 * different.len() > 9 * count);
        map.waving.extend(waving.map(|(texture, _)| texture));
        map
    }

    /// A surface of the map is as still as most of its triangles.
    fn surface(&self, drawn: &Drawn) -> Class {
        let still = drawn.keys.iter().filter(|key| self.still.contains(*key)).count();
        match 2 * still > drawn.keys.len() {
            _ if self.waving.contains(&drawn.texture()) => Class::Dynamic,
            true => Class::Static,
            false => Class::Undecided,
        }
    }
}

/// Entities, by the texture and the number of triangles of a surface: models keep both while they are animated.
fn entities(frames: &[Vec<Drawn>]) -> Things {
    let mut sights = Vec::new();
    for (frame, drawn) in frames.iter().enumerate() {
        let camera = camera(drawn);
        let world_from_eye = camera.map_or(DMat4::IDENTITY, |camera| camera.view.inverse());
        for drawn in drawn.iter().filter(|d| part(d, camera) == Part::Entity && is_solid(d)) {
            let kind = u64::from(drawn.texture()) << 32 | drawn.triangles;
            let model = world_from_eye * drawn.modelview();
            sights.push(Sight::new([frame, drawn.index], [kind, drawn.content], model, drawn.bounds));
        }
    }
    Things::follow(&sights, MOTION, 1000)
}

/// What is known of the batch at hand.
#[derive(Debug, Default)]
struct Batch {
    lock: u32,
    /// What its first stage was.
    base: Option<(Class, u64)>,
    /// Solid surfaces so far: what they are, by their positions.
    drawn: HashMap<u64, (Class, u64)>,
}

impl Batch {
    fn judge(
        &mut self,
        drawn: &Drawn,
        camera: Option<TrueCamera>,
        map: &Map,
        entity: impl Fn(usize) -> Option<(Class, u64)>,
    ) -> (Class, u64) {
        if drawn.lock != self.lock {
            (self.lock, self.base) = (drawn.lock, None);
        }
        let part = part(drawn, camera);
        match part {
            Part::Interface => return (Class::Interface, INTERFACE),
            Part::Sky => return (Class::Sky, SKY),
            _ => {}
        }
        // Later stages belong to the first one.
        if let Some((class, object)) = self.base {
            return (if class == Class::Translucent { class } else { Class::Layer }, object);
        }
        let first = match (is_solid(drawn), part) {
            (true, Part::Weapon) => (Class::ViewModel, WEAPON),
            (true, Part::Map) => (map.surface(drawn), WORLD),
            (true, _) => entity(drawn.index).unwrap_or((Class::Undecided, WORLD)),
            (false, _) => self.blended(drawn),
        };
        self.base = Some(first);
        if is_solid(drawn) {
            self.drawn.insert(drawn.content, first);
        }
        first
    }

    /// A shader whose first stage is blended: a layer if it is over the very triangles of a solid surface (a protection's
    /// shine over its bearer), an effect otherwise.
    fn blended(&self, drawn: &Drawn) -> (Class, u64) {
        match self.drawn.get(&drawn.content) {
            Some((_, object)) => (Class::Layer, *object),
            None if drawn.state.has(GL_POLYGON_OFFSET_FILL) => mark(drawn),
            None => (Class::Translucent, EFFECTS + u64::from(drawn.texture())),
        }
    }
}

/// Marks lie on walls: those that darken by the texture's inverse are soot and shadows, which it depends on whom one asks.
fn mark(drawn: &Drawn) -> (Class, u64) {
    match drawn.blending() {
        Some((GL_ZERO, GL_ONE_MINUS_SRC_COLOR)) => (Class::Undecided, WORLD),
        _ => (Class::Layer, WORLD),
    }
}
