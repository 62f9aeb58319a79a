//! Stormbaan Coureur: plib's scene graph loads the camera at the bottom of the matrix stack, then, a level deeper for each
//! branch, the product of the camera and the branch's transform. What is drawn in perspective is the world, lit and
//! solid, with signs drawn by hand; what is drawn without depth in an orthographic projection is text.

use afterglow_scene::Class;
use glam::DMat4;

use super::things::{Motion, Sight, Things};
use super::{Drawn, Judged};
use crate::truth::TrueCamera;

/// Metres. The parts of the car are set by its physics; what stands is left alone by it.
const MOTION: Motion = Motion { least: 2e-3, most: 1.5 };
const INTERFACE: u64 = 900_000;

/// Judges all frames.
pub fn judge(frames: &[Vec<Drawn>]) -> Vec<Judged> {
    let cameras: Vec<Option<TrueCamera>> = frames.iter().map(|drawn| camera(drawn)).collect();
    let mut sights = Vec::new();
    for (frame, (drawn, camera)) in frames.iter().zip(&cameras).enumerate() {
        let world_from_eye = camera.map_or(DMat4::IDENTITY, |camera| camera.view.inverse());
        for drawn in drawn.iter().filter(|drawn| is_world(drawn)) {
            let model = world_from_eye * drawn.modelview();
            // Signs have a texture, and are turned to the camera.
            let kind = if drawn.texture() == 0 { drawn.content } else { drawn.texture().into() };
            sights.push(Sight::new([frame, drawn.index], [kind, drawn.content], model, drawn.bounds));
        }
    }
    let things = Things::follow(&sights, MOTION, 1);
    let judged = frames.iter().zip(cameras).enumerate().map(|(frame, (drawn, camera))| {
        let thing = |drawn: &Drawn| match drawn.is_perspective() {
            true => things.class(frame, drawn.index).unwrap_or((Class::Undecided, 0)),
            false => (Class::Interface, INTERFACE),
        };
        Judged { camera, things: drawn.iter().map(thing).collect() }
    });
    judged.collect()
}

/// What the scene graph loaded first.
fn camera(drawn: &[Drawn]) -> Option<TrueCamera> {
    let world = drawn.iter().find(|drawn| is_world(drawn))?;
    Some(TrueCamera { view: *world.stack.first()?, projection: world.projection })
}

/// What comes before the first clear is left from frames that the trace leaves out.
fn is_world(drawn: &Drawn) -> bool {
    drawn.is_perspective() && drawn.triangles > 0 && drawn.clears > 0
}
