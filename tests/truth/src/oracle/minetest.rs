//! Minetest on Irrlicht's fixed pipeline, which loads the view and multiplies the model before each draw. The sky comes
//! first, without a depth test. Nodes are 10 units large and 16 of them along each axis make a block; a block is a mesh
//! for each texture, moved to its place, without light. Its liquids come later, blended, then the clouds. What is
//! lit is an object. After a clear of depth the player's arm is drawn with a field of view of its own, then the bars.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat3, DMat4, DVec3};

use super::things::{Motion, Numbers, Sight, Things};
use super::{Drawn, Judged, Opacity};
use crate::truth::{TrueCamera, UNNAMED};

/// Tenths of a node.
const MOTION: Motion = Motion { least: 0.05, most: 40.0 };
/// Blocks lie on a grid of 160, less multiples of the step: on one of 80.
const GRID: f64 = 80.0;
/// Coordinates are about a place that follows the player by such steps, lest they become large.
const STEP: f64 = 2000.0;

/// Objects that are no parts of blocks.
const OBJECTS: u64 = 1_000_000;
const SKY: u64 = 500_000;
const LIQUIDS: u64 = 600_000;
const ARM: u64 = 700_000;
const INTERFACE: u64 = 900_000;

/// Where a draw belongs.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Part {
    Interface,
    Sky,
    /// At that place.
    Block(DVec3),
    Liquid,
    Object,
    Arm,
    Unknown,
}

/// Judges all frames.
pub fn judge(frames: &[Vec<Drawn>]) -> Vec<Judged> {
    let cameras = cameras(frames);
    let things = objects(frames, &cameras);
    let mut blocks = Numbers::from(1);
    let judged = frames.iter().zip(cameras).enumerate().map(|(frame, (drawn, camera))| {
        let mut judge = |drawn: &Drawn| match part(drawn, camera) {
            Part::Interface => (Class::Interface, INTERFACE),
            Part::Sky => (Class::Sky, SKY),
            Part::Block(place) => (Class::Static, blocks.of(block_key(place, drawn.texture()))),
            Part::Liquid => (Class::Translucent, LIQUIDS),
            Part::Object => things.class(frame, drawn.index).unwrap_or((Class::Undecided, UNNAMED)),
            Part::Arm => (Class::ViewModel, ARM),
            Part::Unknown => (Class::Undecided, UNNAMED),
        };
        Judged { camera, things: drawn.iter().map(&mut judge).collect() }
    });
    judged.collect()
}

/// What is the same for a block's mesh of one texture, which is made anew when nodes about it come in.
fn block_key(place: DVec3, texture: u32) -> u64 {
    let along = (place / GRID).round().as_ivec3().to_array();
    along.into_iter().fold(texture.into(), |key: u64, i| (key << 16) ^ (key >> 48) ^ (i as u64 & 0xffff))
}

/// The cameras of all frames, in a world that does not jump when its coordinates do.
fn cameras(frames: &[Vec<Drawn>]) -> Vec<Option<TrueCamera>> {
    let (mut moved, mut last): (DVec3, Option<DVec3>) = (DVec3::ZERO, None);
    let camera = |drawn: &Vec<Drawn>| {
        let camera = camera(drawn)?;
        let eye = camera.view.inverse().w_axis.truncate();
        let jumped = last.map_or(DVec3::ZERO, |last| ((last - moved - eye) / STEP).round() * STEP);
        moved += jumped;
        last = Some(eye + moved);
        Some(TrueCamera { view: camera.view * DMat4::from_translation(-moved), ..camera })
    };
    frames.iter().map(camera).collect()
}

/// The matrix that is loaded before a model is multiplied to it.
fn camera(drawn: &[Drawn]) -> Option<TrueCamera> {
    let first = drawn.iter().find(|drawn| drawn.is_perspective() && drawn.state.has(GL_DEPTH_TEST))?;
    Some(TrueCamera { view: first.loaded, projection: first.projection })
}

fn model(drawn: &Drawn, camera: &TrueCamera) -> DMat4 {
    camera.view.inverse() * drawn.modelview()
}

fn part(drawn: &Drawn, camera: Option<TrueCamera>) -> Part {
    let state = &drawn.state;
    let Some(camera) = camera.filter(|_| drawn.is_perspective()) else { return Part::Interface };
    if !state.has(GL_DEPTH_TEST) {
        return Part::Sky;
    }
    if drawn.projection != camera.projection {
        return Part::Arm;
    }
    if drawn.blending().is_some() {
        return if drawn.opacity == Opacity::CutOut { Part::Unknown } else { Part::Liquid };
    }
    let model = model(drawn, &camera);
    let place = model.w_axis.truncate();
    let is_upright = DMat3::from_mat4(model).abs_diff_eq(DMat3::IDENTITY, 1e-5);
    let is_on_grid = (place / GRID - (place / GRID).round()).abs().max_element() < 1e-3;
    match is_upright && is_on_grid && !state.has(GL_LIGHTING) {
        true => Part::Block(place),
        false => Part::Object,
    }
}

fn objects(frames: &[Vec<Drawn>], cameras: &[Option<TrueCamera>]) -> Things {
    let mut sights = Vec::new();
    for (frame, (drawn, camera)) in frames.iter().zip(cameras).enumerate() {
        let Some(camera) = *camera else { continue };
        for drawn in drawn.iter().filter(|drawn| part(drawn, Some(camera)) == Part::Object) {
            let kind = u64::from(drawn.texture()) << 32 | drawn.triangles;
            let model = model(drawn, &camera);
            sights.push(Sight::new([frame, drawn.index], [kind, drawn.content], model, drawn.bounds));
        }
    }
    Things::follow(&sights, MOTION, OBJECTS)
}
