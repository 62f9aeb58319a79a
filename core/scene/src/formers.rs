//! Stretches of triangles that were new in the frame before: what they became tells what a program animates.
//!
//! Triangles that nobody has seen before are either new to the view or old ones with other positions. They are the
//! latter if a stretch of the same topology and texture was near in the frame before, and is not drawn any more.

use afterglow_gl::frame::{Draw, Frame};
use glam::Vec3;
use hashbrown::{HashMap, HashSet};

use crate::content::{Content, SAMPLES, corners};

/// Stretches that are noted in a frame, at most.
const MOST: usize = 1 << 14;
/// Kinds that are kept, at most.
const MOST_KINDS: usize = 1 << 14;
/// Stretches of one kind that a fresh one is compared with, at most.
const MOST_COMPARED: usize = 64;
/// Triangles up to which a stretch is a sprite: too simple to be known by its topology from afar.
pub const SPRITE: u32 = 4;
/// How far what was known goes when it begins to change, in its own extents.
const AS_KNOWN: f32 = 0.25;
/// Triangles from which on a stretch has a shape by which it is known.
const SHAPE: u32 = 8;
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
    samples: [Vec3; SAMPLES],
    /// A triangle of it: as long as that is drawn, the stretch has not moved.
    first_key: u64,
    frame: u32,
    streak: u32,
    is_taken: bool,
    /// Frames for which it has been where it is, and its positions.
    rests: (u32, u64),
    /// What it belongs to.
    pub object: Option<u32>,
    /// Where its corners were.
    pub corners: Vec<Vec3>,
}

impl Former {
    /// As it is drawn in this frame, nothing known of what it was before.
    fn of(content: &Content, frame: u32) -> Former {
        Former {
            centre: content.centre,
            extent: content.extent,
            samples: content.samples,
            first_key: content.keys.first().copied().unwrap_or(0),
            frame,
            streak: 0,
            is_taken: false,
            rests: (0, content.positions),
            object: None,
            corners: Vec::new(),
        }
    }

    /// Whether it has been where it is for long.
    pub fn has_settled(&self, content: &Content) -> bool {
        self.rests.0 > RESTED && self.rests_at(content)
    }

    /// Whether it is where it was.
    pub fn rests_at(&self, content: &Content) -> bool {
        self.rests.1 == content.positions
    }
}

/// Topology, texture, number of triangles.
type Kind = (u64, u64, u32);

fn kind_of(content: &Content, texture: u64) -> Kind {
    (content.topology, texture, content.triangles)
}

/// Whether a shape has changed by more than its place.
fn has_deformed(before: &[Vec3; SAMPLES], now: &[Vec3; SAMPLES]) -> bool {
    let edges = |samples: &[Vec3; SAMPLES]| std::array::from_fn::<_, 7, _>(|i| samples[i + 1] - samples[0]);
    let size = now.iter().map(|sample| sample.distance(now[0])).fold(0.0, f32::max);
    edges(before).iter().zip(edges(now)).any(|(a, b)| a.distance(b) > 1e-3 * size)
}

/// The stretches of the frame before, and those of this one.
#[derive(Debug, Default)]
pub struct Formers {
    before: HashMap<Kind, Vec<Former>>,
    now: HashMap<Kind, Vec<Former>>,
    /// What was animated.
    kinds: HashSet<Kind>,
    noted: usize,
    frame: u32,
}

impl Formers {
    /// A frame begins: what was noted becomes what was before.
    pub fn next_frame(&mut self, frame: u32) {
        std::mem::swap(&mut self.before, &mut self.now);
        (self.noted, self.frame) = (0, frame);
        for (kind, waiting) in &mut self.now {
            let is_awaited =
                |former: &Former| former.streak > 0 && frame.wrapping_sub(former.frame) < AWAITED;
            waiting.retain(is_awaited);
            if !waiting.is_empty() {
                self.before.entry(*kind).or_default().append(waiting);
            }
        }
        // What is of the same kinds as ever finds its places again; others' are given back now and then.
        if frame.is_multiple_of(AWAITED) {
            self.now.clear();
        }
    }

    /// Whether what is of the same kind was animated: a model of which there are several, in other poses.
    pub fn expect(&self, content: &Content, texture: u64) -> bool {
        content.triangles > SPRITE && self.kinds.contains(&kind_of(content, texture))
    }

    /// Whether something of the same kind was there.
    pub fn have(&self, content: &Content, texture: u64) -> bool {
        self.before.get(&kind_of(content, texture)).is_some_and(|formers| !formers.is_empty())
    }

    /// Finds what fresh triangles were before, the nearest first. `is_drawn` tells whether a triangle is in this frame.
    pub fn take(&mut self, fresh: Vec<(&Content, u64, &mut Option<Former>)>, is_drawn: impl Fn(u64) -> bool) {
        let mut pairs: Vec<(f32, usize, Kind, usize)> = Vec::new();
        for (index, (content, texture, _)) in fresh.iter().enumerate() {
            let kind = kind_of(content, *texture);
            let Some(formers) = self.before.get(&kind) else { continue };
            let may_be = |former: &Former| {
                let is_same = content.keys.first() == Some(&former.first_key);
                self.may_go(former, content, formers.len()) && (is_same || !is_drawn(former.first_key))
            };
            let candidates =
                formers.iter().enumerate().filter(|(_, former)| may_be(former)).take(MOST_COMPARED);
            pairs.extend(
                candidates.map(|(at, former)| (former.centre.distance(content.centre), index, kind, at)),
            );
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.3.cmp(&b.3)));
        let (mut fresh, mut taken) = (fresh, HashSet::new());
        for (_, index, kind, at) in pairs {
            let Some(former) = self.before.get_mut(&kind).and_then(|formers| formers.get_mut(at)) else {
                continue;
            };
            let (_, _, slot) = &mut fresh[index];
            if slot.is_none() && !former.is_taken {
                former.is_taken = true;
                taken.insert(kind);
                let corners = std::mem::take(&mut former.corners);
                **slot = Some(Former { corners, ..former.clone() });
            }
        }
        for kind in taken {
            self.before.entry(kind).and_modify(|formers| formers.retain(|former| !former.is_taken));
        }
    }

    /// Whether a stretch may have gone so far: the longer it was away, the farther.
    fn may_go(&self, former: &Former, content: &Content, alike: usize) -> bool {
        let away = self.frame.wrapping_sub(former.frame) as f32;
        let reach = match content.triangles {
            // What was known may as well be out of sight now, and this something like it.
            _ if former.corners.is_empty() => AS_KNOWN * former.extent,
            0..=SPRITE => 0.75 * former.extent.max(content.extent),
            _ if alike == 1 => 8.0 * former.extent,
            _ => 2.0 * former.extent,
        };
        former.centre.distance(content.centre) <= away * reach
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
        let corners = corners(frame, draw);
        let deforms = before.is_some_and(|former| {
            let is_near = former.centre.distance(content.centre) <= AS_KNOWN * former.extent;
            content.triangles >= SHAPE && is_near && has_deformed(&former.samples, &content.samples)
        });
        // What changed its shape has not come into view as something else.
        let streak = before.map_or(0, |former| former.streak + if deforms { STREAK } else { 1 });
        if self.noted < MOST {
            self.noted += 1;
            let kind = kind_of(content, texture);
            let rests =
                before.filter(|former| former.rests_at(content)).map_or(0, |former| former.rests.0 + 1);
            self.now.entry(kind).or_default().push(Former {
                streak,
                rests: (rests, content.positions),
                object: before.and_then(|former| former.object),
                corners,
                ..Former::of(content, now)
            });
        }
        let counts = streak >= STREAK;
        if counts && self.kinds.len() < MOST_KINDS {
            self.kinds.insert(kind_of(content, texture));
        }
        counts
    }

    /// Notes a draw that is known: it may change in a later frame.
    pub fn note_known(&mut self, content: &Content, texture: u64, object: u32, now: u32) {
        let is_shape = content.triangles >= SHAPE;
        let kind = kind_of(content, texture);
        if !is_shape || self.noted >= MOST {
            return;
        }
        self.noted += 1;
        self.now.entry(kind).or_default().push(Former { object: Some(object), ..Former::of(content, now) });
    }

    /// Says what the stretch that was noted last belongs to.
    pub fn assign(&mut self, content: &Content, texture: u64, object: u32) {
        let kind = kind_of(content, texture);
        if let Some(former) = self.now.get_mut(&kind).and_then(|formers| formers.last_mut()) {
            former.object = Some(object);
        }
    }

    /// Objects have other numbers, or are forgotten.
    pub fn renumber(&mut self, numbers: &[Option<u32>]) {
        for former in self.before.values_mut().chain(self.now.values_mut()).flatten() {
            former.object = former.object.and_then(|object| *numbers.get(object as usize)?);
        }
    }
}
