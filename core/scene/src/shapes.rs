//! Draws cut into what belongs together, before anything is known of matrices.
//!
//! A program batches as it likes: what stands still and what it animates may be in one draw, and what is in a batch
//! changes with what the camera sees. Each triangle is known by its position key from the first frame in which it
//! was drawn, and belongs to the same object ever after. Draws are cut where the object changes.

use std::sync::Arc;

use afterglow_gl::frame::{Draw, Frame, Operation, Topology};
use glam::Vec3;
use hashbrown::{HashMap, HashSet};

use crate::content::{Content, Contents, Found, corners, part_hash};
use crate::foresight::{Foresight, Landmark};
use crate::former::{Former, SHAPE};
use crate::formers::{Formers, Query, SPRITE};
use crate::images::Images;
use crate::objects::{Motion, Objects};
pub use crate::stretches::Known;
use crate::stretches::{MOST_PIECES, Stretch, apply, merge, part_of, push, push_known, segments};

/// Parts of a draw, at most, that are things of their own.
const MOST_THINGS: usize = 16;
/// Triangles that are known, at most.
const MOST_TRIANGLES: usize = 1 << 21;
/// Frames after which a triangle that was drawn in one frame only is forgotten.
const FORGOTTEN: u32 = 300;

/// Frames for which the plan of a draw that is not drawn is kept.
const PLANNED: u32 = 16;

/// A draw, or what it was cut into.
#[derive(Debug, Clone)]
pub struct Piece {
    /// What its triangles are.
    pub content: Arc<Content>,
    /// Hash of all that its vertices and indices hold.
    pub bytes: u64,
    /// Content of the texture in its first unit, 0 without one.
    pub texture: u64,
    /// What it belongs to.
    pub known: Known,
}

/// A triangle's object, and the frames in which it was seen first and last.
#[derive(Debug, Clone, Copy)]
struct Seen {
    object: u32,
    first: u32,
    last: u32,
}

/// What is known of triangles.
#[derive(Debug, Default)]
pub struct Shapes {
    contents: Contents,
    triangles: HashMap<u64, Seen>,
    formers: Formers,
    /// Stretches of draws all of whose triangles are known, by the hash of their bytes.
    plans: HashMap<u64, (Arc<[Stretch]>, u32)>,
    /// What sprites of a texture belong to.
    sprites: HashMap<u64, u32>,
    /// Objects that are animated in this frame.
    animated: HashSet<u32>,
    frame: u32,
}

/// A draw that is looked at.
struct Surveyed {
    number: usize,
    operation: usize,
    found: Found,
    texture: u64,
    /// Index of its matrices.
    transform: usize,
    /// There is a plan for it.
    is_planned: bool,
    /// The object of each triangle; none of those that are animated. Empty where a plan is known.
    marks: Vec<Option<u32>>,
    /// The object that most triangles belonged to when they were seen.
    known: Option<u32>,
}

/// Triangles of a draw some of which nobody has seen before.
struct Fresh {
    first: u32,
    count: u32,
    content: Option<Arc<Content>>,
    /// Their corners, object space.
    corners: Vec<Vec3>,
    /// What they were in the frame before.
    former: Option<Former>,
}

/// How a draw is cut at first: parts, of which some are fresh.
type Parts = Vec<(u32, u32, Option<Fresh>)>;

impl Shapes {
    /// Cuts the draws of a frame that `is_wanted`, of which is known what can be foreseen. Returns a piece for each draw that
    /// the frame has then, in order.
    pub fn cut(
        &mut self,
        frame: &mut Frame,
        images: &Images,
        objects: &mut Objects,
        mut foresight: Foresight,
        is_wanted: impl Fn(&Frame, &Draw) -> bool,
    ) -> Vec<Option<Piece>> {
        self.next_frame(&foresight);
        let surveyed = self.survey(frame, images, objects, is_wanted);
        let parts = self.parts(frame, &surveyed, objects, &mut foresight);
        let mut pieces: Vec<Option<Piece>> = Vec::with_capacity(surveyed.len());
        let mut cuts: Vec<(usize, Vec<(u32, u32)>)> = Vec::new();
        let mut draws = 0;
        for (surveyed, parts) in surveyed.into_iter().zip(parts) {
            pieces.resize_with(pieces.len() + surveyed.number - draws, || None);
            draws = surveyed.number + 1;
            let Some(Operation::Draw(draw)) = frame.operations.get(surveyed.operation) else { continue };
            let is_known = parts.is_empty();
            let stretches = self.stretches(frame, draw, &surveyed, parts, objects, &foresight);
            if let [whole] = &*stretches {
                if let (Known::Object(object), true) = (&whole.known, is_known) {
                    self.note_known(frame, draw, &surveyed, *object, objects, &foresight);
                }
                pieces.push(Some(Piece {
                    content: surveyed.found.content,
                    bytes: surveyed.found.bytes,
                    texture: surveyed.texture,
                    known: whole.known.clone(),
                }));
                continue;
            }
            cuts.push((surveyed.operation, stretches.iter().map(|s| (s.first, s.count)).collect()));
            for stretch in stretches.iter().cloned() {
                let content =
                    stretch.content.or_else(|| content_of(frame, draw, stretch.first, stretch.count));
                let bytes = part_hash(surveyed.found.bytes, stretch.first, stretch.count);
                let piece =
                    |content| Piece { content, bytes, texture: surveyed.texture, known: stretch.known };
                pieces.push(content.map(piece));
            }
        }
        let rest = frame.draws().count().saturating_sub(draws);
        pieces.resize_with(pieces.len() + rest, || None);
        apply(frame, &cuts);
        pieces
    }

    /// Notes a draw that is one known thing.
    fn note_known(
        &mut self,
        frame: &Frame,
        draw: &Draw,
        surveyed: &Surveyed,
        object: u32,
        objects: &Objects,
        foresight: &Foresight,
    ) {
        let content = &surveyed.found.content;
        if content.triangles < SHAPE {
            return;
        }
        let motion = objects.get(object).map(|object| object.motion(foresight.frame));
        let corners = if motion == Some(Motion::Unknown) { corners(frame, draw) } else { Vec::new() };
        let eye = foresight.eye(surveyed.transform);
        self.formers.note_known(content, surveyed.texture, (corners, eye), object, self.frame);
    }

    /// Objects have other numbers, or are forgotten: so are their triangles then.
    pub fn renumber(&mut self, numbers: &[Option<u32>]) {
        let renumber = |object: &mut u32| {
            let number = numbers.get(*object as usize).copied().flatten();
            *object = number.unwrap_or(0);
            number.is_some()
        };
        self.triangles.retain(|_, seen| renumber(&mut seen.object));
        self.sprites.retain(|_, object| renumber(object));
        self.formers.renumber(numbers);
        self.plans.clear();
    }

    fn next_frame(&mut self, foresight: &Foresight) {
        self.frame = self.frame.wrapping_add(1);
        self.contents.next_frame();
        self.animated.clear();
        self.formers.next_frame(self.frame, foresight.before);
        let now = self.frame;
        if now.is_multiple_of(PLANNED) {
            self.plans.retain(|_, (_, used)| now.wrapping_sub(*used) < PLANNED);
        }
        if now.is_multiple_of(FORGOTTEN) {
            self.triangles
                .retain(|_, seen| seen.first != seen.last || now.wrapping_sub(seen.last) < FORGOTTEN);
        }
        if self.triangles.len() > MOST_TRIANGLES {
            let mut ages: Vec<u32> =
                self.triangles.values().map(|seen| now.wrapping_sub(seen.last)).collect();
            let middle = ages.len() / 2;
            let (_, &mut median, _) = ages.select_nth_unstable(middle);
            self.triangles.retain(|_, seen| now.wrapping_sub(seen.last) < median.max(1));
            self.plans.clear();
        }
    }

    /// Finds the content of draws, and takes note of which triangles are drawn.
    fn survey(
        &mut self,
        frame: &Frame,
        images: &Images,
        objects: &Objects,
        is_wanted: impl Fn(&Frame, &Draw) -> bool,
    ) -> Vec<Surveyed> {
        let mut surveyed = Vec::new();
        for (number, (operation, draw)) in frame.draws().enumerate() {
            if draw.topology != Topology::Triangles || !is_wanted(frame, draw) {
                continue;
            }
            let Some(found) = self.contents.of(frame, draw) else { continue };
            let texture = texture_of(frame, draw, images);
            let is_expected = self.formers.expect(&found.content, texture);
            let is_planned = !is_expected && self.plan(found.bytes, objects);
            // What is new may be what something animated has become: only then it matters whether it is still drawn.
            let seen = if is_planned && found.age > 2 { Vec::new() } else { self.see(&found.content) };
            let known = majority(&seen);
            // Those of something animated may come again as they were, but are never known for that.
            let is_known =
                |object: &u32| !is_expected && objects.get(*object).is_some_and(|object| !object.is_animated);
            let marks = seen.into_iter().map(|mark| mark.filter(is_known)).collect();
            let transform = draw.transform as usize;
            surveyed.push(Surveyed {
                number,
                operation,
                found,
                texture,
                transform,
                is_planned,
                marks,
                known,
            });
        }
        surveyed
    }

    /// Whether there is a plan for a draw of these bytes, and nothing in it is animated now.
    fn plan(&mut self, bytes: u64, objects: &Objects) -> bool {
        let now = self.frame;
        let is_animated = |stretch: &Stretch| match stretch.known {
            Known::Object(object) => objects.get(object).is_none_or(|object| object.is_animated),
            _ => true,
        };
        let Some((plan, used)) = self.plans.get_mut(&bytes) else { return false };
        *used = now;
        !plan.iter().any(is_animated)
    }

    /// The object that each triangle belonged to so far. They are drawn now.
    fn see(&mut self, content: &Content) -> Vec<Option<u32>> {
        let now = self.frame;
        let see = |key: &u64| {
            let seen = self.triangles.get_mut(key)?;
            seen.last = now;
            Some(seen.object)
        };
        content.keys.iter().map(see).collect()
    }

    /// Cuts all draws that have fresh triangles, and finds what these were before.
    fn parts(
        &mut self,
        frame: &Frame,
        surveyed: &[Surveyed],
        objects: &Objects,
        foresight: &mut Foresight,
    ) -> Vec<Parts> {
        let is_planned = |s: &Surveyed| s.is_planned || s.marks.iter().all(Option::is_some);
        let mut parts: Vec<Parts> = Vec::with_capacity(surveyed.len());
        for surveyed in surveyed {
            let draw = match frame.operations.get(surveyed.operation) {
                Some(Operation::Draw(draw)) if !is_planned(surveyed) => draw,
                _ => {
                    parts.push(Parts::new());
                    continue;
                }
            };
            let whole = &surveyed.found.content;
            let content = |first: u32, count: u32| match count == whole.triangles {
                true => Some(whole.clone()),
                false => content_of(frame, draw, first, count),
            };
            let fresh = |&(first, count): &(u32, u32)| {
                let marks = &surveyed.marks[first as usize..(first + count) as usize];
                marks.iter().any(Option::is_none).then(|| Fresh {
                    first,
                    count,
                    content: content(first, count),
                    corners: corners(frame, &part_of(draw, first, count)),
                    former: None,
                })
            };
            let segments = segments(frame, draw, &surveyed.marks, |first, count| {
                let is_fresh = |mark: &&Option<u32>| mark.is_none();
                let marks = &surveyed.marks[first as usize..(first + count) as usize];
                // What has mostly changed and is of a kind that was there is one thing, though some of it stayed.
                2 * marks.iter().filter(is_fresh).count() > count as usize
                    && content(first, count)
                        .is_some_and(|content| self.formers.have(&content, surveyed.texture))
            });
            parts.push(segments.iter().map(|segment| (segment.0, segment.1, fresh(segment))).collect());
        }
        let mut queries: Vec<Query> = Vec::new();
        for (parts, surveyed) in parts.iter_mut().zip(surveyed) {
            for fresh in parts.iter_mut().filter_map(|(_, _, fresh)| fresh.as_mut()) {
                let Some(content) = fresh.content.as_deref() else { continue };
                let (texture, transform) = (surveyed.texture, surveyed.transform);
                if self.formers.have(content, texture) {
                    let (corners, former) = (fresh.corners.as_slice(), &mut fresh.former);
                    queries.push(Query { content, texture, corners, transform, former });
                }
            }
        }
        if queries.is_empty() {
            return parts;
        }
        foresight.sharpen(self.landmarks(surveyed, objects, foresight));
        let (triangles, now) = (&self.triangles, self.frame);
        self.formers.take(queries, foresight, objects, |key| {
            let drawn = triangles.get(&key).filter(|seen| seen.last == now);
            drawn.is_some_and(|seen| objects.get(seen.object).is_none_or(|object| !object.is_animated))
        });
        parts
    }

    /// What is known and may stand still.
    fn landmarks<'a>(
        &self,
        surveyed: &'a [Surveyed],
        objects: &Objects,
        foresight: &Foresight,
    ) -> Vec<Landmark<'a>> {
        let landmark = |surveyed: &'a Surveyed| {
            let content = &surveyed.found.content;
            let planned = || match self.plans.get(&surveyed.found.bytes)?.0.first()?.known {
                Known::Object(object) => Some(object),
                _ => None,
            };
            let object = surveyed.marks.first().copied().flatten().or_else(planned)?;
            let object = objects.get(object).filter(|object| !object.is_animated)?;
            let (model, eye) = (object.model?, foresight.eye(surveyed.transform));
            let extent = f64::from(content.extent) * model.x_axis.truncate().length();
            let is_trusted = object.is_trusted();
            Some(Landmark { samples: &content.samples, extent, eye, model, is_trusted })
        };
        surveyed.iter().filter_map(landmark).collect()
    }

    fn stretches(
        &mut self,
        frame: &Frame,
        draw: &Draw,
        surveyed: &Surveyed,
        parts: Parts,
        objects: &mut Objects,
        foresight: &Foresight,
    ) -> Arc<[Stretch]> {
        let (content, marks) = (&surveyed.found.content, &surveyed.marks);
        if content.keys.is_empty() {
            return [Stretch { first: 0, count: content.triangles, known: Known::Mesh, content: None }]
                .into();
        }
        if let Some((plan, _)) = self.plans.get(&surveyed.found.bytes).filter(|_| surveyed.is_planned) {
            return plan.clone();
        }
        let mut stretches = Vec::new();
        if parts.is_empty() {
            push_known(&mut stretches, 0, marks);
            merge(&mut stretches, content.triangles);
            if stretches.len() > 1 {
                for stretch in &mut stretches {
                    stretch.content = content_of(frame, draw, stretch.first, stretch.count);
                }
            }
            let stretches: Arc<[Stretch]> = stretches.into();
            self.plans.insert(surveyed.found.bytes, (stretches.clone(), self.frame));
            return stretches;
        }
        let mut home = majority(marks);
        // A few large parts are things; many are how a program sends its world.
        let are_things = parts.len() <= MOST_THINGS;
        for (first, count, fresh) in parts {
            match fresh {
                Some(fresh) => {
                    let own = are_things && count > SPRITE;
                    let known = self.fresh(surveyed, fresh, foresight, objects, &mut home, own);
                    push(&mut stretches, first, count, known);
                }
                None => push_known(&mut stretches, first, &marks[first as usize..(first + count) as usize]),
            }
        }
        merge(&mut stretches, content.triangles);
        stretches.into()
    }

    /// What fresh triangles belong to: what they were before if they moved; else they are a thing of their own, or belong to
    /// the object of those around them.
    fn fresh(
        &mut self,
        surveyed: &Surveyed,
        fresh: Fresh,
        foresight: &Foresight,
        objects: &mut Objects,
        home: &mut Option<u32>,
        is_own: bool,
    ) -> Known {
        let Fresh { first, count, content, corners, former } = fresh;
        let (texture, transform, now) = (surveyed.texture, surveyed.transform, self.frame);
        let before = former.as_ref().and_then(|former| former.object);
        let whole = &surveyed.found.content;
        let is_home = |object: &u32| {
            count == whole.triangles
                && objects.get(*object).is_none_or(|object| foresight.may_hold(object, whole, transform))
        };
        let before = before.or(surveyed.known.filter(is_home));
        if let Some(part) = &content {
            let eye = foresight.eye(transform);
            let counts = self.formers.note(part, texture, (corners, eye), former.as_ref(), now);
            let has_settled = former.as_ref().is_some_and(|former| former.has_settled(part));
            let is_sprite = count <= SPRITE && self.sprites.contains_key(&texture);
            let may_move = former.as_ref().is_none_or(|former| !former.rests_at(part));
            // What is of an animated kind and rests as it came is not animated itself.
            let is_expected = may_move && self.formers.expect(part, texture);
            let is_animated = (counts || is_expected) && !has_settled;
            if is_animated || (is_sprite && may_move) {
                // Several may be in a pose that one of them was in.
                let before = before.filter(|object| !self.animated.contains(object));
                let mut known = || before.unwrap_or_else(|| objects.add(part, texture));
                let object = match count {
                    0..=SPRITE => *self.sprites.entry(texture).or_insert_with(known),
                    _ => known(),
                };
                self.formers.assign(part, texture, object);
                objects.set_animated(object, true);
                self.animated.insert(object);
                return Known::Animated(object, former.map(|former| former.corners).unwrap_or_default());
            }
        }
        if let Some(object) = before {
            objects.set_animated(object, false);
        }
        let object = match content.as_ref().filter(|_| is_own) {
            _ if before.is_some() => before.unwrap_or(0),
            Some(part) => objects.add(part, texture),
            None => *home.get_or_insert_with(|| objects.add(whole, texture)),
        };
        if let Some(part) = &content {
            self.formers.assign(part, texture, object);
        }
        let seen = Seen { object, first: now, last: now };
        for &key in &whole.keys[first as usize..(first + count) as usize] {
            self.triangles.entry(key).or_insert(seen);
        }
        Known::Object(object)
    }
}

fn content_of(frame: &Frame, draw: &Draw, first: u32, count: u32) -> Option<Arc<Content>> {
    Content::of(frame, draw, first, count).map(Arc::new)
}

/// The first unit's texture.
fn texture_of(frame: &Frame, draw: &Draw, images: &Images) -> u64 {
    let bindings = frame.bindings.get(draw.bindings as usize);
    let bound = bindings.into_iter().flatten().flatten().next();
    bound.and_then(|binding| images.get(binding.image)).map_or(0, |image| image.content())
}

/// The object that most known triangles belong to; of equals the first.
fn majority(marks: &[Option<u32>]) -> Option<u32> {
    let mut votes: Vec<(u32, usize)> = Vec::new();
    for object in marks.iter().flatten() {
        match votes.iter().position(|(known, _)| known == object) {
            Some(at) => votes[at].1 += 1,
            None if votes.len() < MOST_PIECES => votes.push((*object, 1)),
            None => {}
        }
    }
    let most = votes.iter().map(|(_, count)| *count).max()?;
    votes.into_iter().find(|(_, count)| *count == most).map(|(object, _)| object)
}
