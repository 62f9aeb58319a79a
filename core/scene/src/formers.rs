//! Stretches of triangles that were new in the frame before: what they became tells what a program animates.
//!
//! Triangles that nobody has seen before are either new to the view or old ones with other positions. They are the
//! latter if a stretch of the same topology and texture was near in the frame before, both in its own space and in the
//! world, is not drawn any more, and may have become this: it has bent, or it has gone as a whole under the matrix that it
//! had, from where it would be seen if it still were there.

use std::collections::VecDeque;

use glam::{DMat4, Vec3};
use hashbrown::{HashMap, HashSet};

use crate::content::Content;
use crate::deform::Change;
use crate::foresight::Foresight;
use crate::former::{AS_KNOWN, Former, STREAK};
use crate::matrix;
use crate::objects::Objects;

/// Stretches that are noted in a frame, at most.
const MOST: usize = 1 << 14;
/// Kinds that are kept, at most.
const MOST_KINDS: usize = 1 << 14;
/// Stretches of one kind that a fresh one is compared with, at most.
const MOST_COMPARED: usize = 64;
/// Triangles up to which a stretch is a sprite: too simple to be known by its topology from afar.
pub const SPRITE: u32 = 4;
/// How far a stretch goes in the world while its matrix moves, as anything may and as what changes its shape, in its own
/// extents.
const NEAR: f64 = 2.0;
const FAR: f64 = 8.0;
/// How far a stretch seems to go in the world, in its own extents, whose matrix stands still.
const AT: f64 = 0.05;
/// Frames for which what was animated is waited for.
const AWAITED: u32 = 30;

/// Topology, texture, number of triangles.
type Kind = (u64, u64, u32);

fn kind_of(content: &Content, texture: u64) -> Kind {
    (content.topology, texture, content.triangles)
}

/// Fresh triangles of which is asked what they were.
pub struct Query<'a> {
    /// What they are.
    pub content: &'a Content,
    /// What is on them.
    pub texture: u64,
    /// Their corners, object space.
    pub corners: &'a [Vec3],
    /// Index of their matrices among the frame's.
    pub transform: usize,
    /// Where the answer goes.
    pub former: &'a mut Option<Former>,
}

/// The stretches of the frame before, and those of this one.
#[derive(Debug, Default)]
pub struct Formers {
    before: HashMap<Kind, Vec<Former>>,
    now: HashMap<Kind, Vec<Former>>,
    /// What was animated.
    kinds: HashSet<Kind>,
    /// Eye to world space in the last frames, the latest first.
    past: VecDeque<DMat4>,
    noted: usize,
    frame: u32,
}

impl Formers {
    /// A frame begins: what was noted becomes what was before, seen under that view.
    pub fn next_frame(&mut self, frame: u32, view: Option<DMat4>) {
        std::mem::swap(&mut self.before, &mut self.now);
        (self.noted, self.frame) = (0, frame);
        self.past.truncate(AWAITED as usize - 1);
        self.past.push_front(view.map_or(DMat4::IDENTITY, matrix::rigid_inverse));
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
    pub fn take(
        &mut self,
        mut fresh: Vec<Query>,
        foresight: &Foresight,
        objects: &Objects,
        is_drawn: impl Fn(u64) -> bool,
    ) {
        let mut pairs: Vec<(f32, usize, Kind, usize, Change)> = Vec::new();
        for (index, query) in fresh.iter().enumerate() {
            let (content, kind) = (query.content, kind_of(query.content, query.texture));
            let Some(formers) = self.before.get(&kind) else { continue };
            let now = foresight.place(query.transform);
            let may_be = |former: &Former| {
                let is_same = content.keys.first() == Some(&former.first_key);
                let is_gone = is_same || !is_drawn(former.first_key);
                let reach = self.reach(former, content, formers.len());
                (is_gone && former.went(content) <= reach)
                    .then(|| self.becomes(former, query, now, foresight, objects))
                    .flatten()
            };
            let candidates =
                formers.iter().enumerate().filter_map(|(at, former)| Some((at, former, may_be(former)?)));
            pairs.extend(
                candidates
                    .take(MOST_COMPARED)
                    .map(|(at, former, change)| (former.went(content), index, kind, at, change)),
            );
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.3.cmp(&b.3)));
        let mut taken = HashSet::new();
        for (_, index, kind, at, change) in pairs {
            let Some(former) = self.before.get_mut(&kind).and_then(|formers| formers.get_mut(at)) else {
                continue;
            };
            let slot = &mut *fresh[index].former;
            if slot.is_none() && !former.is_taken {
                former.is_taken = true;
                taken.insert(kind);
                let corners = std::mem::take(&mut former.corners);
                *slot = Some(Former { corners, change, ..former.clone() });
            }
        }
        for kind in taken {
            self.before.entry(kind).and_modify(|formers| formers.retain(|former| !former.is_taken));
        }
    }

    /// How far a stretch may have gone in its own space: the longer it was away, the farther.
    fn reach(&self, former: &Former, content: &Content, alike: usize) -> f32 {
        self.away(former) as f32
            * match content.triangles {
                _ if former.is_known => AS_KNOWN * former.extent,
                0..=SPRITE => 0.75 * former.extent.max(content.extent),
                _ if alike == 1 => 8.0 * former.extent,
                _ => 2.0 * former.extent,
            }
    }

    /// Frames since it was drawn.
    fn away(&self, former: &Former) -> u32 {
        self.frame.wrapping_sub(former.frame)
    }

    /// What has happened to a stretch if it may have become fresh triangles, which are at a place in the world now.
    fn becomes(
        &self,
        former: &Former,
        query: &Query,
        now: DMat4,
        foresight: &Foresight,
        objects: &Objects,
    ) -> Option<Change> {
        let content = query.content;
        let change = former.change(content, query.corners);
        if change == Change::Scatters {
            return None;
        }
        let away = self.away(former);
        let past = self.past.get(away.wrapping_sub(1) as usize).copied().unwrap_or(DMat4::IDENTITY);
        let before = past * former.eye;
        let extent = f64::from(former.extent) * before.x_axis.truncate().length();
        if content.samples.iter().all(|&sample| apart([before, now], [sample; 2]) <= AT * extent) {
            let place = before.transform_point3(former.centre.as_dvec3());
            let may_go = former.is_near(content) || foresight.shows(place, query.transform);
            return may_go.then_some(change);
        }
        let centres = [former.centre, content.centre];
        let eye = foresight.eye(query.transform);
        let went = apart([before, now], centres).min(apart([former.eye, eye], centres));
        let was_animated = former.streak >= STREAK;
        let reach = match change {
            Change::Bends => FAR,
            _ if was_animated => FAR,
            // What goes as a whole does so by its matrix.
            Change::Goes(_) => return None,
            _ => NEAR,
        };
        let is_near = went <= f64::from(away) * reach * extent || !foresight.is_sharp;
        let may_leave = was_animated || former.may_leave(objects, foresight.frame);
        (is_near && may_leave).then_some(change)
    }

    /// Notes new triangles of a draw under a matrix to eye space, and what they were before. Returns whether they count as
    /// animated.
    pub fn note(
        &mut self,
        content: &Content,
        texture: u64,
        (corners, eye): (Vec<Vec3>, DMat4),
        before: Option<&Former>,
        now: u32,
    ) -> bool {
        let away = before.map_or(1, |former| self.away(former));
        let streak = before.map_or(0, |former| former.streak(content, away));
        let kind = kind_of(content, texture);
        if self.noted < MOST {
            self.noted += 1;
            let rests =
                before.filter(|former| former.rests_at(content)).map_or(0, |former| former.rests.0 + 1);
            let pace = match before.map(|former| former.change) {
                Some(Change::Goes(way)) => Some(way / away.max(1) as f32),
                _ => None,
            };
            self.now.entry(kind).or_default().push(Former {
                streak,
                rests: (rests, content.positions),
                pace,
                object: before.and_then(|former| former.object),
                corners,
                ..Former::of(content, eye, now)
            });
        }
        let counts = streak >= STREAK;
        let has_settled = before.is_some_and(|former| former.streak > 0 && former.has_settled(content));
        if has_settled {
            self.kinds.remove(&kind);
        } else if counts && self.kinds.len() < MOST_KINDS {
            self.kinds.insert(kind);
        }
        counts
    }

    /// Notes a draw that is known: it may change in a later frame. Its corners are needed while nobody knows whether it moves.
    pub fn note_known(
        &mut self,
        content: &Content,
        texture: u64,
        (corners, eye): (Vec<Vec3>, DMat4),
        object: u32,
        now: u32,
    ) {
        if self.noted < MOST {
            self.noted += 1;
            let (object, is_known) = (Some(object), true);
            let former = Former { object, corners, is_known, ..Former::of(content, eye, now) };
            self.now.entry(kind_of(content, texture)).or_default().push(former);
        }
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

/// How far a point is under one matrix from another point under another.
fn apart([a, b]: [DMat4; 2], [p, q]: [Vec3; 2]) -> f64 {
    a.transform_point3(p.as_dvec3()).distance(b.transform_point3(q.as_dvec3()))
}
