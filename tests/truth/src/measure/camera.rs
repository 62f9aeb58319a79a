//! The camera: how far the recovered one is from the true one.
//!
//! World space is free up to one rigid transform: if the recovered world is the true one moved by M, then a right
//! recovery says W = V M⁻¹ of each frame, so V⁻¹ W is the same in all. The frame whose V⁻¹ W is nearest to those of the
//! others gives the transform; a few wrong frames do not move it, as they would a mean.

use glam::{DMat3, DMat4, DQuat};
use serde::Serialize;

use super::Observed;
use crate::truth::{TrueCamera, Truth};

/// A camera is right within this, relative to the world's extent and in radians.
const TOLERANCE: f64 = 1e-4;

/// What was measured of the camera.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct CameraScore {
    /// Frames that show a world.
    pub shown: usize,
    /// Share of them in which a camera was found.
    pub found: f64,
    /// Share of them in which it is right, to a ten-thousandth.
    pub right: f64,
    /// Frames without a world in which a camera was found.
    pub invented: usize,
    /// Largest distance of the eye from where it is, relative to the world's extent.
    pub worst_position: f64,
    /// Largest angle between the recovered and the true camera, degrees.
    pub worst_angle: f64,
    /// Largest difference of an entry of the projection, relative to its largest one.
    pub worst_projection: f64,
}

/// Distance of eyes (relative) and angle (radians).
#[derive(Debug, Clone, Copy)]
struct Error {
    position: f64,
    angle: f64,
}

impl Error {
    fn size(self) -> f64 {
        self.position.max(self.angle)
    }
}

/// True and recovered camera of a frame.
type Pair = (TrueCamera, TrueCamera);

/// Of each world, the transform from recovery's space to the true one.
#[derive(Debug)]
pub struct Alignments(Vec<(u32, DMat4)>);

impl Alignments {
    /// Those of a run.
    pub fn of(truth: &Truth, observed: &[Observed]) -> Alignments {
        let worlds = worlds(truth, observed);
        let aligned = worlds.iter().map(|(world, pairs)| (*world, common_transform(pairs, truth.extent)));
        Alignments(aligned.collect())
    }

    /// That of a world; nothing if no camera was found in it.
    pub fn of_world(&self, world: u32) -> Option<DMat4> {
        self.0.iter().find(|(known, _)| *known == world).map(|(_, transform)| *transform)
    }
}

/// The cameras of each world.
fn worlds(truth: &Truth, observed: &[Observed]) -> Vec<(u32, Vec<Pair>)> {
    let mut worlds: Vec<(u32, Vec<Pair>)> = Vec::new();
    for (frame, observed) in truth.frames.iter().zip(observed) {
        let Some(pair) = frame.camera.zip(observed.camera) else { continue };
        match worlds.iter_mut().find(|(world, _)| *world == frame.world) {
            Some((_, pairs)) => pairs.push(pair),
            None => worlds.push((frame.world, vec![pair])),
        }
    }
    worlds
}

/// Scores the camera. Each world has a transform of its own.
pub fn score(truth: &Truth, observed: &[Observed]) -> CameraScore {
    let mut score = CameraScore::default();
    let (mut found, mut right) = (0, 0);
    for (frame, observed) in truth.frames.iter().zip(observed) {
        score.shown += usize::from(frame.camera.is_some());
        score.invented += usize::from(frame.camera.is_none() && observed.camera.is_some());
    }
    let alignments = Alignments::of(truth, observed);
    for (world, pairs) in worlds(truth, observed) {
        let transform = alignments.of_world(world).unwrap_or(DMat4::IDENTITY);
        for (told, seen) in &pairs {
            let error = error(told.view * transform, seen.view, truth.extent);
            found += 1;
            right += usize::from(error.size() < TOLERANCE);
            score.worst_position = score.worst_position.max(error.position);
            score.worst_angle = score.worst_angle.max(error.angle.to_degrees());
            score.worst_projection = score.worst_projection.max(difference(told.projection, seen.projection));
        }
    }
    let shown = score.shown.max(1) as f64;
    score.found = f64::from(found) / shown;
    score.right = right as f64 / shown;
    score
}

/// V⁻¹ W of the frame for which the errors of all others add up to least.
fn common_transform(pairs: &[Pair], extent: f64) -> DMat4 {
    let candidates = pairs.iter().map(|(told, seen)| told.view.inverse() * seen.view);
    let sum = |transform: &DMat4| -> f64 {
        let errors = pairs.iter().map(|(told, seen)| error(told.view * *transform, seen.view, extent));
        // One that is far off counts no more than one that is off.
        errors.map(|error| error.size().min(1.0)).sum()
    };
    candidates.min_by(|a, b| sum(a).total_cmp(&sum(b))).unwrap_or(DMat4::IDENTITY)
}

/// The difference of two views of the same world.
fn error(told: DMat4, seen: DMat4, extent: f64) -> Error {
    let eye = |view: DMat4| view.inverse().col(3).truncate();
    let turned = DMat3::from_mat4(told) * DMat3::from_mat4(seen).transpose();
    let angle = match turned.determinant() > 0.0 {
        true => 2.0 * DQuat::from_mat3(&turned).normalize().xyz().length().min(1.0).asin(),
        // A mirror image is no turn.
        false => std::f64::consts::PI,
    };
    Error { position: eye(told).distance(eye(seen)) / extent, angle }
}

fn difference(told: DMat4, seen: DMat4) -> f64 {
    let largest = |m: DMat4| m.to_cols_array().into_iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    largest(told - seen) / largest(told).max(f64::MIN_POSITIVE)
}
