//! Lights that the program set by glLight: whether they were found where they are.
//!
//! Both are compared in eye space, where the choice of world space does not matter. A wrong camera does not count here
//! once more, since it moves its lights with it.

use afterglow_scene::LightShape;
use glam::{DMat4, DVec4};
use serde::Serialize;

use super::Observed;
use crate::truth::{FrameTruth, TrueLightOrigin, TrueLightShape, Truth};

/// A light is found within this, relative to the world's extent, or for directions in radians.
const TOLERANCE: f64 = 1e-2;

/// What was measured of the lights, over all frames that show a world.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct LightScore {
    /// That shine by glLight.
    pub told: u64,
    /// Of these, found at their places.
    pub right: u64,
    /// That recovery took from glLight.
    pub found: u64,
}

/// Scores the lights. Lights that are baked, or that recovery made up, do not count.
pub fn score(truth: &Truth, observed: &[Observed]) -> LightScore {
    let mut score = LightScore::default();
    for (frame, observed) in truth.frames.iter().zip(observed) {
        let told = told(frame);
        let found: Vec<(u8, DVec4)> = match observed.camera {
            Some(camera) => observed.lights.iter().map(|&(i, shape)| (i, seen(camera.view, shape))).collect(),
            None => Vec::new(),
        };
        let is_right = |(index, place): &&(u8, DVec4)| {
            found.iter().any(|(found, at)| found == index && is_near(*place, *at, truth.extent))
        };
        score.told += told.len() as u64;
        score.found += found.len() as u64;
        score.right += told.iter().filter(is_right).count() as u64;
    }
    score
}

/// Numbers and homogeneous positions in eye space.
fn told(frame: &FrameTruth) -> Vec<(u8, DVec4)> {
    let Some(camera) = frame.camera else { return Vec::new() };
    let place = |shape| match shape {
        TrueLightShape::Directional { to_light } => to_light.extend(0.0),
        TrueLightShape::Point { position, .. } => position.extend(1.0),
    };
    let lights = frame.lights.iter().filter_map(|light| match light.origin {
        TrueLightOrigin::Gl(index) => Some((index, camera.view * place(light.shape))),
        TrueLightOrigin::Baked => None,
    });
    lights.collect()
}

fn seen(view: DMat4, shape: LightShape) -> DVec4 {
    match shape {
        LightShape::Directional { to_light, .. } => view * to_light.as_dvec3().extend(0.0),
        LightShape::Point { position, .. } => view * position.as_dvec3().extend(1.0),
    }
}

fn is_near(a: DVec4, b: DVec4, extent: f64) -> bool {
    let scale = if a.w == 0.0 { 1.0 } else { extent };
    a.w == b.w && a.distance(b) < TOLERANCE * scale
}
