//! What views show: parts of the world, or things of their own (icons of a status bar).

use glam::Vec3;

use crate::draws::{DrawFacts, TransformFacts};
use crate::shapes::Piece;
use crate::tracking::Tracker;
use crate::views::Views;

/// One in so many triangles of a view that stand still in the world make it a view of the world.
const OF_WORLD: u64 = 8;

/// Triangles of a view, and those of them that are known to stand still in the world.
#[derive(Debug, Clone, Copy, Default)]
pub struct Shown {
    all: u64,
    of_world: u64,
    /// Something reaches beyond the viewport.
    overflows: bool,
}

/// What each view of a frame shows.
pub fn shown(
    views: &Views,
    draws: &[DrawFacts],
    pieces: &[Option<Piece>],
    transforms: &[TransformFacts],
    tracker: &Tracker,
) -> Vec<Shown> {
    let mut shown = vec![Shown::default(); views.views.len()];
    let overflows = |facts: &DrawFacts, piece: &Piece| {
        let transform = &transforms[facts.transform];
        let Some(perspective) = transform.perspective else { return false };
        let clip = perspective.projection * transform.eye;
        let is_outside = |sample: &Vec3| {
            let at = clip * sample.as_dvec3().extend(1.0);
            at.x.abs() > 1.2 * at.w || at.y.abs() > 1.2 * at.w
        };
        piece.content.samples.iter().any(is_outside)
    };
    if views.views.len() > 1 {
        for (facts, piece) in draws.iter().zip(pieces) {
            let Some(piece) = piece else { continue };
            let view = &mut shown[facts.place.view];
            view.all += u64::from(facts.triangles);
            view.overflows |= overflows(facts, piece);
            view.of_world += if tracker.stands_still(piece) { u64::from(facts.triangles) } else { 0 };
        }
    }
    shown
}

impl Shown {
    /// Whether it is a view of the world: a thing of its own fits into its viewport, and is nowhere else.
    pub fn is_of_world(&self) -> bool {
        OF_WORLD * self.of_world > self.all || self.overflows
    }
}
