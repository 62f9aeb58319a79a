//! Draws cut into what belongs together, before anything is known of matrices.
//!
//! A program batches as it likes: what stands still and what it animates may be in one draw, and what is in a batch
//! changes with what the camera sees. Each triangle is known by its position key from the first frame in which it
//! was drawn, and belongs to the same object ever after. Draws are cut where the object changes.

use std::sync::Arc;

use afterglow_gl::frame::{Draw, Frame, Operation, Topology, VertexSource};
use glam::Vec3;
use hashbrown::HashMap;

use crate::content::{Content, Contents, Found};
use crate::formers::{Formers, SPRITE};
use crate::images::Images;
use crate::objects::Objects;

/// Pieces that a draw is cut into, at most.
const MOST_PIECES: usize = 64;
/// Triangles that are known, at most.
const MOST_TRIANGLES: usize = 1 << 21;
/// Frames after which a triangle that was drawn in one frame only is forgotten.
const FORGOTTEN: u32 = 8;

/// What a piece belongs to.
#[derive(Debug, Clone, PartialEq)]
pub enum Known {
    /// The object that its triangles belong to.
    Object(u32),
    /// A range that outlives the frame: its objects are found by its content.
    Mesh,
    /// Animated: its object, and where its corners were in the frame before (none if it was not there).
    Animated(u32, Vec<Vec3>),
}

/// A draw, or what it was cut into.
#[derive(Debug, Clone)]
pub struct Piece {
    /// What its triangles are.
    pub content: Arc<Content>,
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

/// Triangles of a draw that belong together.
#[derive(Debug, Clone, PartialEq)]
struct Stretch {
    first: u32,
    count: u32,
    known: Known,
}

/// What is known of triangles.
#[derive(Debug, Default)]
pub struct Shapes {
    contents: Contents,
    triangles: HashMap<u64, Seen>,
    formers: Formers,
    /// Stretches of draws all of whose triangles are known, by the hash of their bytes.
    plans: HashMap<u64, (Vec<Stretch>, u32)>,
    /// What sprites of a texture belong to.
    sprites: HashMap<u64, u32>,
    frame: u32,
}

/// A draw that is looked at.
struct Surveyed {
    number: usize,
    operation: usize,
    found: Found,
    texture: u64,
    /// The object of each triangle; empty where a plan is known.
    marks: Vec<Option<u32>>,
}

impl Shapes {
    /// Cuts the draws of a frame that `is_wanted`. Returns a piece for each draw that the frame has then, in order.
    pub fn cut(
        &mut self,
        frame: &mut Frame,
        images: &Images,
        objects: &mut Objects,
        is_wanted: impl Fn(&Frame, &Draw) -> bool,
    ) -> Vec<Option<Piece>> {
        self.next_frame();
        let surveyed = self.survey(frame, images, is_wanted);
        let mut pieces: Vec<Option<Piece>> = Vec::with_capacity(surveyed.len());
        let mut cuts: Vec<(usize, Vec<(u32, u32)>)> = Vec::new();
        let mut draws = 0;
        for surveyed in surveyed {
            pieces.resize_with(pieces.len() + surveyed.number - draws, || None);
            draws = surveyed.number + 1;
            let Some(Operation::Draw(draw)) = frame.operations.get(surveyed.operation) else { continue };
            let stretches = self.stretches(frame, draw, &surveyed, objects);
            if let [whole] = stretches.as_slice() {
                pieces.push(Some(Piece {
                    content: surveyed.found.content,
                    texture: surveyed.texture,
                    known: whole.known.clone(),
                }));
                continue;
            }
            cuts.push((surveyed.operation, stretches.iter().map(|s| (s.first, s.count)).collect()));
            for stretch in stretches {
                let content = Content::of(frame, draw, stretch.first, stretch.count).map(Arc::new);
                let piece = |content| Piece { content, texture: surveyed.texture, known: stretch.known };
                pieces.push(content.map(piece));
            }
        }
        let rest = frame.draws().count().saturating_sub(draws);
        pieces.resize_with(pieces.len() + rest, || None);
        apply(frame, &cuts);
        pieces
    }

    /// Forgets everything: the world is another.
    pub fn clear(&mut self) {
        self.triangles.clear();
        self.plans.clear();
        self.sprites.clear();
        self.formers.clear();
    }

    fn next_frame(&mut self) {
        self.frame = self.frame.wrapping_add(1);
        self.contents.next_frame();
        self.formers.next_frame(self.frame);
        let now = self.frame;
        if now.is_multiple_of(4 * FORGOTTEN) {
            self.plans.retain(|_, (_, used)| now.wrapping_sub(*used) < FORGOTTEN);
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
        is_wanted: impl Fn(&Frame, &Draw) -> bool,
    ) -> Vec<Surveyed> {
        let mut surveyed = Vec::new();
        for (number, (operation, draw)) in frame.draws().enumerate() {
            if draw.topology != Topology::Triangles || !is_wanted(frame, draw) {
                continue;
            }
            let Some(found) = self.contents.of(frame, draw) else { continue };
            let is_planned = self.plans.contains_key(&found.bytes);
            // What is new may be what something animated has become: only then it matters whether it is still drawn.
            let marks = if is_planned && found.age > 2 { Vec::new() } else { self.mark(&found.content) };
            surveyed.push(Surveyed {
                number,
                operation,
                found,
                texture: texture_of(frame, draw, images),
                marks,
            });
        }
        surveyed
    }

    fn mark(&mut self, content: &Content) -> Vec<Option<u32>> {
        let now = self.frame;
        let mark = |key: &u64| {
            let seen = self.triangles.get_mut(key)?;
            seen.last = now;
            Some(seen.object)
        };
        content.keys.iter().map(mark).collect()
    }

    fn stretches(
        &mut self,
        frame: &Frame,
        draw: &Draw,
        surveyed: &Surveyed,
        objects: &mut Objects,
    ) -> Vec<Stretch> {
        let (content, marks) = (&surveyed.found.content, &surveyed.marks);
        let whole = |known| vec![Stretch { first: 0, count: content.triangles, known }];
        if content.keys.is_empty() {
            return whole(Known::Mesh);
        }
        let now = self.frame;
        if let Some((plan, used)) = self.plans.get_mut(&surveyed.found.bytes) {
            *used = now;
            return plan.clone();
        }
        let is_new = |mark: &Option<u32>| mark.is_none();
        let mut stretches = Vec::new();
        if !marks.iter().any(is_new) {
            for (triangle, mark) in marks.iter().enumerate() {
                push(&mut stretches, triangle as u32, 1, Known::Object(mark.unwrap_or(0)));
            }
            merge(&mut stretches, content.triangles);
            self.plans.insert(surveyed.found.bytes, (stretches.clone(), now));
            return stretches;
        }
        let mut home = majority(marks);
        for (first, count) in segments(frame, draw, marks) {
            let part = &marks[first as usize..(first + count) as usize];
            if !part.iter().any(is_new) {
                for (k, mark) in part.iter().enumerate() {
                    push(&mut stretches, first + k as u32, 1, Known::Object(mark.unwrap_or(0)));
                }
                continue;
            }
            let known = self.new_triangles(frame, draw, surveyed, (first, count), objects, &mut home);
            push(&mut stretches, first, count, known);
        }
        merge(&mut stretches, content.triangles);
        stretches
    }

    /// What new triangles belong to: what they were before if they moved, else the object of those around them.
    fn new_triangles(
        &mut self,
        frame: &Frame,
        draw: &Draw,
        surveyed: &Surveyed,
        (first, count): (u32, u32),
        objects: &mut Objects,
        home: &mut Option<u32>,
    ) -> Known {
        let texture = surveyed.texture;
        let whole = &surveyed.found.content;
        let part = match count == whole.triangles {
            true => Some(whole.clone()),
            false => Content::of(frame, draw, first, count).map(Arc::new),
        };
        if let Some(part) = part {
            let (triangles, now) = (&self.triangles, self.frame);
            let is_drawn = |key: u64| triangles.get(&key).is_some_and(|seen| seen.last == now);
            let former = self.formers.take(&part, texture, is_drawn);
            let cut = part_of(draw, first, count);
            if self.formers.note((frame, &cut), &part, texture, former.as_ref(), now) {
                let known = former.as_ref().and_then(|former| former.object);
                let object = match count {
                    0..=SPRITE => *self.sprites.entry(texture).or_insert_with(|| objects.add(&part, texture)),
                    _ => known.unwrap_or_else(|| objects.add(&part, texture)),
                };
                self.formers.assign(&part, texture, object);
                return Known::Animated(object, former.map(|former| former.corners).unwrap_or_default());
            }
        }
        let object = *home.get_or_insert_with(|| objects.add(whole, texture));
        let seen = Seen { object, first: self.frame, last: self.frame };
        for &key in &whole.keys[first as usize..(first + count) as usize] {
            self.triangles.entry(key).or_insert(seen);
        }
        Known::Object(object)
    }
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

/// Cuts a draw at the program's own seams and where triangles are new on one side only.
fn segments(frame: &Frame, draw: &Draw, marks: &[Option<u32>]) -> Vec<(u32, u32)> {
    let mut ends: Vec<u32> = Vec::new();
    if let VertexSource::Arena { first_index, .. } = draw.source {
        let from = frame.seams.partition_point(|&seam| seam <= first_index);
        let within = frame.seams[from..].iter().take_while(|&&seam| seam < first_index + draw.index_count);
        ends.extend(within.map(|seam| (seam - first_index) / 3));
    }
    let changes = marks.windows(2).enumerate().filter(|(_, pair)| pair[0].is_none() != pair[1].is_none());
    ends.extend(changes.map(|(i, _)| i as u32 + 1));
    ends.push(marks.len() as u32);
    ends.sort_unstable();
    ends.dedup();
    let mut start = 0;
    ends.into_iter()
        .filter(|&end| end > 0)
        .map(|end| (std::mem::replace(&mut start, end), end))
        .map(|(s, e)| (s, e - s))
        .collect()
}

/// Adds a stretch, to the one before where both belong to the same.
fn push(stretches: &mut Vec<Stretch>, first: u32, count: u32, known: Known) {
    if let Some(last) = stretches.last_mut() {
        match (&mut last.known, &known) {
            (Known::Object(a), Known::Object(b)) if a == b => {
                last.count += count;
                return;
            }
            (Known::Animated(a, before), Known::Animated(b, corners)) if a == b => {
                let complete = before.len() as u32 == 3 * last.count && corners.len() as u32 == 3 * count;
                if complete {
                    before.extend_from_slice(corners)
                } else {
                    before.clear()
                }
                last.count += count;
                return;
            }
            _ => {}
        }
    }
    stretches.push(Stretch { first, count, known });
}

/// Of too many stretches one, which belongs to what most triangles belong to.
fn merge(stretches: &mut Vec<Stretch>, triangles: u32) {
    if stretches.len() > MOST_PIECES {
        let largest = stretches.iter().enumerate().max_by_key(|(i, s)| (s.count, std::cmp::Reverse(*i)));
        if let Some((index, _)) = largest {
            let known = match stretches.swap_remove(index).known {
                Known::Animated(object, _) => Known::Animated(object, Vec::new()),
                other => other,
            };
            *stretches = vec![Stretch { first: 0, count: triangles, known }];
        }
    }
}

/// Part of a draw's triangles as a draw.
fn part_of(draw: &Draw, first: u32, count: u32) -> Draw {
    let source = match draw.source {
        VertexSource::Arena { first_word, vertices, first_index } => {
            VertexSource::Arena { first_word, vertices, first_index: first_index + 3 * first }
        }
        VertexSource::Retained { range, first_index } => {
            VertexSource::Retained { range, first_index: first_index + 3 * first }
        }
    };
    Draw { source, index_count: 3 * count, ..*draw }
}

/// Puts parts in the place of draws.
fn apply(frame: &mut Frame, cuts: &[(usize, Vec<(u32, u32)>)]) {
    if cuts.is_empty() {
        return;
    }
    let mut cuts = cuts.iter().peekable();
    let whole = std::mem::take(&mut frame.operations);
    frame.operations.reserve(whole.len() + 16);
    for (index, operation) in whole.into_iter().enumerate() {
        match (cuts.next_if(|(cut, _)| *cut == index), &operation) {
            (Some((_, parts)), Operation::Draw(draw)) => {
                let parts = parts.iter().map(|&(first, count)| Operation::Draw(part_of(draw, first, count)));
                frame.operations.extend(parts);
            }
            _ => frame.operations.push(operation),
        }
    }
}
