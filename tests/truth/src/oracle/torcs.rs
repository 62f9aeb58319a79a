//! TORCS on plib's scene graph. First the background, a strip about the eye under the rotation of the view alone, then
//! depth is cleared. The scene loads the camera at the bottom of the matrix stack; its first branch is the track, whose
//! leaves are in world coordinates six matrices deep, trees cut out by an alpha test at 0.65. Skid marks and shadows of
//! cars follow with an offset of depth, then the cars, five matrices deep and more, whose textures have holes, at last
//! smoke and lights. The board over it is orthographic.

use std::collections::{HashMap, HashSet};

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::DMat4;

use super::things::{Motion, Numbers, Sight, Things};
use super::{Drawn, Judged, Opacity};
use crate::truth::{TrueCamera, UNNAMED};

/// Metres. A car that stands rocks by less than a centimetre.
const MOTION: Motion = Motion { least: 0.002, most: 60.0 };

/// Objects that are no parts of track and cars.
const CARS: u64 = 1_000_000;
const SKY: u64 = 500_000;
const EFFECTS: u64 = 600_000;
const INTERFACE: u64 = 900_000;

/// Judges all frames.
pub fn judge(frames: &[Vec<Drawn>]) -> Vec<Judged> {
    let things = cars(frames);
    let mut leaves = Numbers::from(1);
    let judged = frames.iter().enumerate().map(|(frame, drawn)| {
        let camera = camera(drawn);
        // Positions of solid leaves with the place of their matrix.
        let mut solid: HashSet<(u64, [u64; 4])> = HashSet::new();
        let mut judge = |drawn: &Drawn| {
            let key = (drawn.content, drawn.modelview().w_axis.to_array().map(f64::to_bits));
            let is_again = drawn.triangles > 0 && !solid.insert(key);
            let of_car = || things.class(frame, drawn.index).unwrap_or((Class::Undecided, UNNAMED));
            match part(drawn, camera) {
                Part::Interface => (Class::Interface, INTERFACE),
                Part::Sky => (Class::Sky, SKY),
                // The track has leaves twice. Whether the second is a thing or a layer does not matter.
                Part::Track if is_again => (Class::Undecided, leaves.of(drawn.content)),
                Part::Track => (Class::Static, leaves.of(drawn.content)),
                Part::Car if is_again => (Class::Layer, of_car().1),
                Part::Car => of_car(),
                // Skid marks lie on the road as layers. A shadow may as well be dropped: nobody can say.
                Part::OnRoad if drawn.state.has(GL_LIGHTING) => (Class::Undecided, UNNAMED),
                Part::OnRoad => (Class::Layer, UNNAMED),
                Part::Effect => (Class::Translucent, EFFECTS),
                Part::Unknown => (Class::Undecided, UNNAMED),
            }
        };
        Judged { camera, things: drawn.iter().map(&mut judge).collect() }
    });
    judged.collect()
}

/// Where a draw belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Interface,
    Sky,
    Track,
    OnRoad,
    Car,
    Effect,
    Unknown,
}

fn part(drawn: &Drawn, camera: Option<TrueCamera>) -> Part {
    let state = &drawn.state;
    let Some(camera) = camera.filter(|_| drawn.is_perspective()) else { return Part::Interface };
    let is_placed = drawn.modelview() != camera.view;
    match (state.has(GL_DEPTH_TEST), state.depth_mask) {
        (false, _) => Part::Sky,
        (true, true) if is_placed => Part::Car,
        (true, true) if drawn.opacity != Opacity::Mixed => Part::Track,
        (true, false) if state.has(GL_POLYGON_OFFSET_FILL) && !is_placed => Part::OnRoad,
        (true, false) if drawn.blending().is_some() => Part::Effect,
        _ => Part::Unknown,
    }
}

/// The matrix at the bottom of the scene's stack.
fn camera(drawn: &[Drawn]) -> Option<TrueCamera> {
    let first = drawn.iter().find(|drawn| drawn.is_perspective() && drawn.state.has(GL_DEPTH_TEST))?;
    Some(TrueCamera { view: *first.stack.first()?, projection: first.projection })
}

/// Parts of cars: the same shape comes up in the same order each time.
fn cars(frames: &[Vec<Drawn>]) -> Things {
    let mut sights = Vec::new();
    for (frame, drawn) in frames.iter().enumerate() {
        let camera = camera(drawn);
        let world_from_eye = camera.map_or(DMat4::IDENTITY, |camera| camera.view.inverse());
        let mut counts: HashMap<u64, u64> = HashMap::new();
        for drawn in drawn.iter().filter(|drawn| part(drawn, camera) == Part::Car) {
            let count = counts.entry(drawn.content).or_default();
            let kind = drawn.content ^ count.wrapping_mul(0x9e37_79b9_7f4a_7c15);
            *count += 1;
            let model = world_from_eye * drawn.modelview();
            sights.push(Sight::new([frame, drawn.index], [kind, drawn.content], model, drawn.bounds));
        }
    }
    Things::follow(&sights, MOTION, CARS)
}
