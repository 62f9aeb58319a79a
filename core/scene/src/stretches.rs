//! Stretches of a draw's triangles that belong together, and draws cut into them.

use std::sync::Arc;

use afterglow_gl::frame::{Draw, Frame, Operation, VertexSource};
use glam::Vec3;

use crate::content::Content;

/// Pieces that a draw is cut into, at most.
pub const MOST_PIECES: usize = 64;

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

/// Triangles of a draw that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Stretch {
    /// The first.
    pub first: u32,
    /// How many.
    pub count: u32,
    /// What they belong to.
    pub known: Known,
    /// What they are, once it was needed.
    pub content: Option<Arc<Content>>,
}

/// Cuts a draw at the program's own seams and, unless what lies between is one thing, where triangles are new on one
/// side only.
pub fn segments(
    frame: &Frame,
    draw: &Draw,
    marks: &[Option<u32>],
    is_one: impl Fn(u32, u32) -> bool,
) -> Vec<(u32, u32)> {
    let mut ends: Vec<u32> = Vec::new();
    if let VertexSource::Arena { first_index, .. } = draw.source {
        let from = frame.seams.partition_point(|&seam| seam <= first_index);
        let within = frame.seams[from..].iter().take_while(|&&seam| seam < first_index + draw.index_count);
        ends.extend(within.map(|seam| (seam - first_index) / 3));
    }
    ends.push(marks.len() as u32);
    ends.dedup();
    let mut segments = Vec::with_capacity(ends.len());
    let mut start = 0;
    for end in ends.into_iter().filter(|&end| end > 0) {
        let first = std::mem::replace(&mut start, end);
        let part = &marks[first as usize..end as usize];
        let is_mixed = part.iter().any(Option::is_none) && part.iter().any(Option::is_some);
        if !is_mixed || is_one(first, end - first) {
            segments.push((first, end - first));
            continue;
        }
        let mut from = first;
        for part in part.chunk_by(|a, b| a.is_none() == b.is_none()) {
            segments.push((from, part.len() as u32));
            from += part.len() as u32;
        }
    }
    segments
}

/// Adds triangles all of which are known.
pub fn push_known(stretches: &mut Vec<Stretch>, first: u32, marks: &[Option<u32>]) {
    for (triangle, mark) in (first..).zip(marks) {
        push(stretches, triangle, 1, Known::Object(mark.unwrap_or(0)));
    }
}

/// Adds a stretch, to the one before where both belong to the same.
pub fn push(stretches: &mut Vec<Stretch>, first: u32, count: u32, known: Known) {
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
    stretches.push(Stretch { first, count, known, content: None });
}

/// Of too many stretches one, which belongs to what most triangles belong to.
pub fn merge(stretches: &mut Vec<Stretch>, triangles: u32) {
    if stretches.len() > MOST_PIECES {
        let largest = stretches.iter().enumerate().max_by_key(|(i, s)| (s.count, std::cmp::Reverse(*i)));
        if let Some((index, _)) = largest {
            let known = match stretches.swap_remove(index).known {
                Known::Animated(object, _) => Known::Animated(object, Vec::new()),
                other => other,
            };
            *stretches = vec![Stretch { first: 0, count: triangles, known, content: None }];
        }
    }
}

/// Part of a draw's triangles as a draw.
pub fn part_of(draw: &Draw, first: u32, count: u32) -> Draw {
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
pub fn apply(frame: &mut Frame, cuts: &[(usize, Vec<(u32, u32)>)]) {
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
