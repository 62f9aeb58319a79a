//! Where things must be in a frame before it is understood.
//!
//! What a stretch was in the frame before can be told only if it is known how far it went, in the world. The camera should go
//! on as it did, and what is known to stand still says exactly where it is.

use glam::{DMat4, DVec3, Vec3};

use crate::consensus;
use crate::content::Content;
use crate::draws::TransformFacts;
use crate::matrix;
use crate::objects::{Motion, Object};

/// Things that are asked where the camera is, at most.
const ASKED: usize = 8;
/// Where their places on screen agree, pixels on a screen of [`FOCAL`] pixels at distance one.
const AGREED: f64 = 2.0;
const FOCAL: f64 = 500.0;

/// A thing that may stand still.
#[derive(Debug, Clone, Copy)]
pub struct Landmark<'a> {
    /// Vertices, object space.
    pub samples: &'a [Vec3],
    /// How large it is, world space.
    pub extent: f64,
    /// Object to eye space, now.
    pub eye: DMat4,
    /// Object to world space.
    pub model: DMat4,
    /// It has stood still for some frames.
    pub is_trusted: bool,
}

/// What is expected of a frame.
#[derive(Debug, Clone)]
pub struct Foresight<'a> {
    /// The frame's matrices.
    pub transforms: &'a [TransformFacts],
    /// World to eye space in the frame before, once there is a world.
    pub before: Option<DMat4>,
    /// The same in this frame, if the camera goes on as it did.
    pub view: Option<DMat4>,
    /// Things that stand still have said so.
    pub is_sharp: bool,
    /// The number of this frame, as objects count them.
    pub frame: u32,
}

impl Foresight<'_> {
    /// Takes the view on which most landmarks agree; the expected one stays where no two do.
    pub fn sharpen(&mut self, mut asked: Vec<Landmark>) {
        asked.sort_by(|a, b| b.is_trusted.cmp(&a.is_trusted).then(b.extent.total_cmp(&a.extent)));
        asked.truncate(ASKED);
        let supporters = |view: DMat4| {
            let agrees = |mark: &&Landmark| {
                consensus::agrees(mark.samples, view * mark.model, mark.eye, FOCAL, AGREED)
            };
            asked.iter().filter(agrees).count()
        };
        let mut best: Option<(usize, DMat4)> = None;
        for mark in &asked {
            let found = matrix::similarity(mark.eye * mark.model.inverse());
            let Some(found) = found.filter(|found| found.scale == 1.0) else { continue };
            let count = supporters(found.rigid);
            // Of equals the largest thing's.
            if best.is_none_or(|(most, _)| count > most) {
                best = Some((count, found.rigid));
            }
            if count == asked.len() {
                break;
            }
        }
        if let Some((_, view)) = best.filter(|(supporters, _)| *supporters >= 2.min(asked.len())) {
            (self.view, self.is_sharp) = (Some(view), true);
        }
    }

    /// Object to eye space under a transform of the frame.
    pub fn eye(&self, transform: usize) -> DMat4 {
        self.transforms.get(transform).map_or(DMat4::IDENTITY, |facts| facts.eye)
    }

    /// Object to world space under a transform of the frame; to eye space before there is a world.
    pub fn place(&self, transform: usize) -> DMat4 {
        self.view.map_or(DMat4::IDENTITY, matrix::rigid_inverse) * self.eye(transform)
    }

    /// Whether what is drawn under a transform may be of an object: what stands still is not so far away.
    pub fn may_hold(&self, object: &Object, content: &Content, transform: usize) -> bool {
        let Some((model, _)) = object.model.zip(self.view) else { return true };
        let now = self.place(transform);
        let centre = content.centre.as_dvec3();
        let away = model.transform_point3(centre).distance(now.transform_point3(centre));
        let is_near = away <= f64::from(content.extent) * model.x_axis.truncate().length();
        is_near || !matches!(object.motion(self.frame), Motion::Still | Motion::Unknown)
    }

    /// Whether a point of the world is in sight, as a draw under that transform sees it. Nothing is known to be out of sight
    /// before there is a world.
    pub fn shows(&self, point: DVec3, transform: usize) -> bool {
        let perspective = self.transforms.get(transform).and_then(|facts| facts.perspective);
        let Some((perspective, view)) = perspective.zip(self.view) else { return true };
        let clip = perspective.projection * view * point.extend(1.0);
        clip.w > 0.0 && clip.x.abs() < clip.w && clip.y.abs() < clip.w
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAMPLES: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    fn sharpened(places: &[(DVec3, DVec3)]) -> Foresight<'static> {
        let view = DMat4::from_translation(DVec3::new(0.0, 0.0, -20.0));
        let landmarks = places.iter().map(|&(was, is)| Landmark {
            samples: &SAMPLES,
            extent: 1.0,
            eye: view * DMat4::from_translation(is),
            model: DMat4::from_translation(was),
            is_trusted: true,
        });
        let expected = DMat4::from_rotation_y(0.1) * view;
        let mut foresight = Foresight {
            transforms: &[],
            before: Some(view),
            view: Some(expected),
            is_sharp: false,
            frame: 1,
        };
        foresight.sharpen(landmarks.collect());
        foresight
    }

    #[test]
    fn what_stands_still_says_where_the_camera_is() {
        let [a, b, c] = [DVec3::X * 3.0, DVec3::X * -5.0, DVec3::Y * 2.0];
        let found = sharpened(&[(a, a + DVec3::Z), (b, b), (c, c)]);
        let view = DMat4::from_translation(DVec3::new(0.0, 0.0, -20.0));
        assert!(found.is_sharp && found.view.unwrap().abs_diff_eq(view, 1e-9));
    }

    #[test]
    fn where_nothing_agrees_the_expected_view_stays() {
        let [a, b] = [DVec3::X * 3.0, DVec3::X * -5.0];
        let found = sharpened(&[(a, a + DVec3::Z), (b, b - DVec3::Y)]);
        assert!(!found.is_sharp && found.view != found.before);
        assert!(!sharpened(&[(a, DVec3::NAN)]).is_sharp);
    }
}
