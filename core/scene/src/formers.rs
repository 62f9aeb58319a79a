//! Stretches of triangles that were new in the frame before: what they became tells what a program animates.
//!
//! Triangles that nobody has seen before are either new to the view or old ones with other positions. They are the
//! latter if a stretch of the same topology and texture was near in the frame before, and is not drawn any more.

use afterglow_gl::frame::{Draw, Frame};
use glam::Vec3;
use hashbrown::HashMap;

use crate::content::{Content, corners};

/// Stretches that are noted in a frame, at most.
const MOST: usize = 1 << 14;
/// Triangles up to which a stretch is a sprite: too simple to be known by its topology from afar.
pub const SPRITE: u32 = 4;
/// Frames for which what was animated is waited for.
const AWAITED: u32 = 30;
/// Frames after which what was animated and rests is a thing like any other.
const RESTED: u32 = 90;
/// Times that a stretch must have moved before it counts as animated.
const STREAK: u32 = 2;

/// A stretch as it was drawn last.
#[derive(Debug, Clone)]
pub struct Former {
    centre: Vec3,
    extent: f32,
    /// A triangle of it: as long as that is drawn, the stretch has not moved.
    first_key: u64,
    frame: u32,
    streak: u32,
    /// Frames for which it has been where it is, and its positions.
    rests: (u32, u64),
    /// What it belongs to, once it counts as animated.
    pub object: Option<u32>,
    /// Where its corners were.
    pub corners: Vec<Vec3>,
}

/// Topology, texture, number of triangles.
type Kind = (u64, u64, u32);

/// The stretches of the frame before, and those of this one.
#[derive(Debug, Default)]
pub struct Formers {
    before: HashMap<Kind, Vec<Former>>,
    now: HashMap<Kind, Vec<Former>>,
    noted: usize,
}

impl Formers {
    /// A frame begins: what was noted becomes what was before.
    pub fn next_frame(&mut self, frame: u32) {
        let waiting = std::mem::replace(&mut self.before, std::mem::take(&mut self.now));
        self.noted = 0;
        for (kind, formers) in waiting {
            let awaited =
                |former: &Former| former.streak >= STREAK && frame.wrapping_sub(former.frame) < AWAITED;
            let mut awaited: Vec<Former> = formers.into_iter().filter(awaited).collect();
            if !awaited.is_empty() {
                self.before.entry(kind).or_default().append(&mut awaited);
            }
        }
    }

    /// Finds what new triangles were before, and takes it. `is_drawn` tells whether a triangle is in this frame.
    pub fn take(
        &mut self,
        content: &Content,
        texture: u64,
        is_drawn: impl Fn(u64) -> bool,
    ) -> Option<Former> {
        let formers = self.before.get_mut(&(content.topology, texture, content.triangles))?;
        let alone = formers.len() == 1;
        let reach = |former: &Former| match content.triangles {
            0..=SPRITE => 0.75 * former.extent.max(content.extent),
            _ if alone => 8.0 * former.extent,
            _ => 2.0 * former.extent,
        };
        let distance = |former: &Former| former.centre.distance(content.centre);
        let may_be = |former: &Former| {
            let rests = former.rests.0 > RESTED && former.rests.1 == content.positions;
            distance(former) <= reach(former) && !is_drawn(former.first_key) && !rests
        };
        let candidates = formers.iter().enumerate().filter(|(_, former)| may_be(former));
        let (nearest, _) = candidates.min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)))?;
        Some(formers.swap_remove(nearest))
    }

    /// Notes new triangles of a draw, and what they were before. Returns whether they count as animated.
    pub fn note(
        &mut self,
        (frame, draw): (&Frame, &Draw),
        content: &Content,
        texture: u64,
        before: Option<&Former>,
        now: u32,
    ) -> bool {
        let streak = before.map_or(0, |former| former.streak + 1);
        if self.noted < MOST {
            self.noted += 1;
            let kind = (content.topology, texture, content.triangles);
            self.now.entry(kind).or_default().push(Former {
                centre: content.centre,
                extent: content.extent,
                first_key: content.keys.first().copied().unwrap_or(0),
                frame: now,
                streak,
                rests: match before {
                    Some(former) if former.rests.1 == content.positions => {
                        (former.rests.0 + 1, content.positions)
                    }
                    _ => (0, content.positions),
                },
                object: before.and_then(|former| former.object),
                corners: corners(frame, draw),
            });
        }
        streak >= STREAK
    }

    /// Says what the stretch that was noted last belongs to.
    pub fn assign(&mut self, content: &Content, texture: u64, object: u32) {
        let kind = (content.topology, texture, content.triangles);
        if let Some(former) = self.now.get_mut(&kind).and_then(|formers| formers.last_mut()) {
            former.object = Some(object);
        }
    }

    /// Forgets everything: the world is another.
    pub fn clear(&mut self) {
        *self = Formers::default();
    }
}
