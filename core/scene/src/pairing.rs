//! Which object each draw is: of several alike, the one that is where it must be.

use glam::{DMat4, DVec3};
use hashbrown::HashMap;

use crate::content::Content;
use crate::matrix;
use crate::objects::{Motion, Object, Objects};
use crate::shapes::Known;
use crate::tracking::{Claim, scale_of};
use crate::world::World;

/// How far an object goes in a frame, in its own extents: hardly, as anything may, and as what moves may.
const AT: f64 = 0.05;
pub const NEAR: f64 = 1.0;
const FAR: f64 = 8.0;
/// Objects of the same content that a draw is compared with.
const COMPARED: usize = 32;

/// Pairs the draws of a frame with objects.
pub struct Pairing<'a> {
    /// All objects.
    pub objects: &'a Objects,
    /// The frame's number.
    pub frame: u32,
    /// What is in sight.
    pub sight: Sight,
}

impl<'a> Pairing<'a> {
    /// Pairs draws with objects, as seen under a view: first those that are where they must be, then the others.
    pub fn pair(&self, claims: &mut [Claim]) {
        let mut taken = Taken::new(self.objects.len());
        let mut kinds = Kinds::default();
        for is_last in [false, true] {
            for claim in claims.iter_mut().filter(|claim| !is_last || claim.object.is_none()) {
                claim.object = match claim.piece.known {
                    Known::Animated(object, _) => Some(object),
                    Known::Object(object) => self.nearest(claim, Some(object), &taken, &mut kinds, is_last),
                    Known::Mesh => self.nearest(claim, None, &taken, &mut kinds, is_last),
                };
                taken.add(claim.object, claim.eye);
            }
        }
    }

    /// Of the objects that a piece may be, the nearest to a place that is free. Programs draw what is alike in the same
    /// order each time: the search begins after the one that was found last.
    fn nearest(
        &self,
        claim: &Claim,
        own: Option<u32>,
        taken: &Taken,
        kinds: &mut Kinds<'a>,
        is_last: bool,
    ) -> Option<u32> {
        let content = &claim.piece.content;
        let place = self.sight.world_from_eye * claim.eye;
        let (centre, extent) = (content.centre.as_dvec3(), f64::from(content.extent) * scale_of(place));
        let centre_now = place.transform_point3(centre);
        let away = |known: &Object| {
            self.expected(known, centre).map_or(f64::MAX, |expected| expected.distance(centre_now))
        };
        // Mostly it is where it must be.
        let own_known = own.filter(|object| !taken.has(*object, claim.eye));
        if own_known
            .and_then(|object| self.objects.get(object))
            .is_some_and(|known| away(known) <= AT * extent)
        {
            return own;
        }
        let (alike, cursor) = kinds.of(self.objects, content);
        let (start, count) = (*cursor, alike.len());
        let in_order = (0..count.min(COMPARED)).map(|step| (start + step) % count);
        let in_order = in_order.map(|at| (at + 1, alike[at]));
        let near = (count > COMPARED).then(|| self.objects.near(content, place)).into_iter().flatten();
        let first = own.into_iter().chain(near).map(|object| (start, object));
        let mut best: Option<(f64, u32)> = None;
        for (next, object) in first.chain(in_order) {
            if taken.has(object, claim.eye) {
                continue;
            }
            let Some(known) = self.objects.get(object) else { continue };
            let away = away(known);
            if away <= AT * extent {
                *cursor = next;
                return Some(object);
            }
            if best.is_none_or(|(least, _)| away < least) {
                best = Some((away, object));
            }
        }
        let (away, object) = best.filter(|_| is_last)?;
        (self.sight.is_rough || self.may_be(object, away, extent, centre)).then_some(object)
    }

    /// Where a point of an object is if it goes on as before, world space.
    fn expected(&self, object: &Object, point: DVec3) -> Option<DVec3> {
        let now = object.model?.transform_point3(point);
        let before = object.before.filter(|_| object.seen == self.frame.wrapping_sub(1));
        Some(before.map_or(now, |before| 2.0 * now - before.transform_point3(point)))
    }

    /// Whether an object may have gone so far. What stands still does not go, unless it is missed where it was.
    fn may_be(&self, object: u32, away: f64, extent: f64, centre: DVec3) -> bool {
        let Some(object) = self.objects.get(object) else { return false };
        let Some(model) = object.model else { return true };
        let was_there = object.seen == self.frame.wrapping_sub(1);
        let moves = object.motion(self.frame) != Motion::Still;
        (away <= NEAR * extent && (was_there || moves))
            || (moves && was_there && away <= FAR * extent)
            || (was_there && self.sight.shows(model.transform_point3(centre)))
    }
}

/// Objects that are alike, by their content: which, and where the next search begins.
#[derive(Default)]
struct Kinds<'a>(HashMap<(u64, u32), (&'a [u32], usize)>);

impl<'a> Kinds<'a> {
    fn of(&mut self, objects: &'a Objects, content: &Content) -> (&'a [u32], &mut usize) {
        let kind = (content.positions, content.triangles);
        let (alike, cursor) = self.0.entry(kind).or_insert_with(|| (objects.of_content(content), 0));
        (alike, cursor)
    }
}

/// Objects that are taken, and the matrix under which each is seen.
struct Taken {
    /// By object: the number of its matrix, counted from 1; 0 if it is free.
    by_object: Vec<u32>,
    eyes: Vec<DMat4>,
}

impl Taken {
    /// So many objects, all of them free.
    fn new(objects: usize) -> Taken {
        Taken { by_object: vec![0; objects], eyes: Vec::new() }
    }

    fn add(&mut self, object: Option<u32>, eye: DMat4) {
        let Some(number) = object.and_then(|object| self.by_object.get_mut(object as usize)) else { return };
        if *number == 0 {
            // Programs draw many things under one matrix, one after the other.
            if self.eyes.last() != Some(&eye) {
                self.eyes.push(eye);
            }
            *number = self.eyes.len() as u32;
        }
    }

    /// Whether an object is somewhere else. Parts of one may be drawn apart, under the same matrix.
    fn has(&self, object: u32, eye: DMat4) -> bool {
        let number = self.by_object.get(object as usize).copied().unwrap_or(0);
        number != 0 && self.eyes[number as usize - 1] != eye
    }
}

/// What is in sight.
pub struct Sight {
    clip_from_world: DMat4,
    world_from_eye: DMat4,
    /// The view is only expected.
    is_rough: bool,
}

impl Sight {
    /// What a view of the world shows; `is_rough` where it is only expected.
    pub fn new(view: DMat4, world: &World, is_rough: bool) -> Sight {
        let clip_from_world = world.perspective.projection * view;
        Sight { clip_from_world, world_from_eye: matrix::rigid_inverse(view), is_rough }
    }

    fn shows(&self, point: DVec3) -> bool {
        let clip = self.clip_from_world * point.extend(1.0);
        clip.w > 0.0 && clip.x.abs() < clip.w && clip.y.abs() < clip.w
    }
}
