//! Stability: whether what stands still stays where it is on screen when it is seen by the recovered camera.
//!
//! A vertex of the static world is at e in eye space, by the program's own MODELVIEW. The true view V takes it to the
//! world, where it stays: V⁻¹ e is the same in all frames. Recovery's world is the true one moved by a rigid transform,
//! the same for all frames; its view W should take the vertex to where it was. How many pixels off that is, is measured.

use afterglow_gl::frame::{Draw, Format, Frame, Slot, Topology};
use glam::{DMat4, DVec2, DVec3, Vec3};
use serde::Serialize;

use super::camera::Alignments;
use super::{Observed, Played};
use crate::truth::{FrameTruth, Truth};

/// Pixels by which a vertex may be off.
const TOLERANCE: f64 = 0.5;

/// Vertices that are looked at of a draw: two, and one more for so many triangles.
const TRIANGLES_A_SAMPLE: u32 = 24;

/// A vertex of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sample {
    /// Which triangle of the frame it belongs to.
    triangle: u64,
    /// Eye space.
    eye: DVec3,
    /// Index of a projection.
    projection: usize,
}

/// Some vertices of a frame, in the order of their triangles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Samples {
    vertices: Vec<Sample>,
    /// Eye to clip space, and half of the viewport's size in pixels.
    projections: Vec<(DMat4, DVec2)>,
}

/// What was measured of stability.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct StabilityScore {
    /// Frames with vertices of the static world in sight.
    pub frames: usize,
    /// Share of them in which none is off by half a pixel.
    pub stable: f64,
    /// By how many pixels the worst vertex of a frame is off: the median of all frames.
    pub median: f64,
    /// Of all frames.
    pub worst: f64,
}

/// Takes samples of a frame, or of the next part of one of which `before` triangles are known.
pub fn sample(frame: &Frame, before: u64, samples: &mut Samples) {
    let matrix = |columns: &[[f32; 4]; 4]| DMat4::from_cols_array_2d(&columns.map(|c| c.map(f64::from)));
    let mut triangle = before;
    let draws = frame.draws().filter(|(_, draw)| draw.topology == Topology::Triangles);
    for (_, draw) in draws {
        let (transform, viewport) = (&frame.transforms[draw.transform as usize], draw.viewport as usize);
        let rect = frame.viewports[viewport].rect;
        let half = DVec2::new(rect.width.into(), rect.height.into()) / 2.0;
        let projection = (matrix(&transform.projection), half);
        if samples.projections.last() != Some(&projection) {
            samples.projections.push(projection);
        }
        let modelview = matrix(&transform.modelview);
        let count = draw.index_count / 3;
        let taken = (2 + count / TRIANGLES_A_SAMPLE).min(count);
        for i in 0..taken {
            let which = u64::from(i) * u64::from(count) / u64::from(taken);
            let Some(position) = position(frame, draw, 3 * which as usize + i as usize % 3) else { continue };
            samples.vertices.push(Sample {
                triangle: triangle + which,
                eye: modelview.transform_point3(position.as_dvec3()),
                projection: samples.projections.len() - 1,
            });
        }
        triangle += u64::from(count);
    }
}

/// Object space position at an index of a draw.
fn position(frame: &Frame, draw: &Draw, index: usize) -> Option<Vec3> {
    let (words, indices) = frame.geometry(draw);
    let slot = Slot::Position as usize;
    let start = *indices.get(index)? as usize * draw.layout.stride() + draw.layout.offset(slot);
    let component = |i: usize| words.get(start + i).map(|word| f32::from_bits(*word));
    match draw.layout.format(slot) {
        Format::F2 => Some(Vec3::new(component(0)?, component(1)?, 0.0)),
        Format::F3 | Format::F4 => Some(Vec3::new(component(0)?, component(1)?, component(2)?)),
        _ => None,
    }
}

/// Scores stability.
pub fn score(truth: &Truth, observed: &[Observed], played: &[Played]) -> StabilityScore {
    let alignments = Alignments::of(truth, observed);
    let mut errors = Vec::new();
    for ((frame, observed), played) in truth.frames.iter().zip(observed).zip(played) {
        let Some(told) = frame.camera else { continue };
        let moved = match (observed.camera, alignments.of_world(frame.world)) {
            (Some(seen), Some(alignment)) => seen.view * alignment.inverse() * told.view.inverse(),
            // Without a camera nothing is where it should be.
            _ => DMat4::from_translation(DVec3::splat(truth.extent)),
        };
        errors.extend(worst(frame, &played.samples, moved));
    }
    errors.sort_by(f64::total_cmp);
    let stable = errors.iter().filter(|error| **error < TOLERANCE).count();
    StabilityScore {
        frames: errors.len(),
        stable: stable as f64 / errors.len().max(1) as f64,
        median: errors.get(errors.len() / 2).copied().unwrap_or(0.0),
        worst: errors.last().copied().unwrap_or(0.0),
    }
}

/// By how many pixels the worst vertex of the static world is off, of those in sight; nothing if there are none.
fn worst(frame: &FrameTruth, samples: &Samples, moved: DMat4) -> Option<f64> {
    let mut labels = frame.labels.iter();
    let (mut class, mut end) = (None, 0);
    let mut worst: Option<f64> = None;
    for sample in &samples.vertices {
        while sample.triangle >= end {
            let label = labels.next()?;
            (class, end) = (Some(label.class), end + label.triangles);
        }
        let (projection, half) = samples.projections[sample.projection];
        let Some(at) = on_screen(projection, sample.eye) else { continue };
        if class != Some(afterglow_scene::Class::Static) || at.abs().max_element() > 1.0 {
            continue;
        }
        // What comes to lie behind the eye is as far off as can be.
        let seen = on_screen(projection, moved.transform_point3(sample.eye));
        let error = seen.map_or(2.0 * half.length(), |seen| ((seen - at) * half).length());
        worst = Some(worst.unwrap_or(0.0).max(error));
    }
    worst
}

/// Normalised device coordinates, x and y; nothing behind the near plane.
fn on_screen(projection: DMat4, eye: DVec3) -> Option<DVec2> {
    let clip = projection * eye.extend(1.0);
    (clip.w > 0.0 && clip.z >= -clip.w).then(|| clip.truncate().truncate() / clip.w)
}
