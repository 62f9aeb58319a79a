//! Takes note of what a frame draws of the static world.
//!
//! A draw whose vertices, indices and place were all the same before costs a hash of their bytes and a stamp a
//! triangle. Otherwise its triangles are looked up one by one. A draw of a retained range is known as a whole.

use std::sync::Arc;

use afterglow_gl::frame::{Draw, Frame, Operation, RetainedRange, Topology, VertexLayout, VertexSource};
use glam::{Mat4, Vec3};
use hashbrown::HashMap;
use xxhash_rust::xxh3::xxh3_64;

use super::Memory;
use super::blocks::Heap;
use super::cells::{Cell, Pass};
use super::entries::NO_CELL;
use super::keys::{Positions, fold, position, triangle_key};
use super::look::{Kind, Look};
use crate::types::{Class, Scene, Verdict};

/// Frames in which a triangle is drawn before it is remembered: what the program computes anew never is.
pub const SIGHTINGS: u8 = 3;
/// Entries of what was seen but not remembered yet, and of what was, at most.
const MOST_ENTRIES: usize = 1 << 21;

/// A draw of the static world.
pub struct Noticed<'a> {
    draw: &'a Draw,
    verdict: &'a Verdict,
    /// Draws of exactly its triangles over it, in order.
    layers: Vec<&'a Draw>,
}

/// The triangles of a draw whose bytes are known.
#[derive(Debug)]
pub struct Memo {
    /// One a triangle that has an area.
    pub entries: Box<[u32]>,
    /// The cells that they are in, once that was needed: when that was, and nothing where one is in none.
    pub cells: Option<(u64, Option<Box<[u32]>>)>,
    /// All of them are remembered.
    is_settled: bool,
    /// The frame in which it was last drawn.
    pub drawn: u32,
}

/// A draw of which all triangles are remembered.
#[derive(Debug)]
pub struct Settled {
    /// Its operation.
    pub operation: u32,
    /// What its memo is found by.
    pub content: u64,
    /// How many layers lie over it.
    pub layers: usize,
}

/// The static draws of a frame with the layers over each.
pub fn static_draws<'a>(frame: &'a Frame, scene: &'a Scene) -> Vec<Noticed<'a>> {
    let draw = |verdict: &Verdict| match frame.operations.get(verdict.operation as usize) {
        Some(Operation::Draw(draw)) => Some(draw),
        _ => None,
    };
    let mut layers: HashMap<u32, Vec<&Draw>> = HashMap::new();
    for verdict in scene.verdicts.iter().filter(|verdict| verdict.class == Class::Layer) {
        if let (Some(base), Some(draw)) = (verdict.base, draw(verdict)) {
            layers.entry(base).or_default().push(draw);
        }
    }
    let is_memorable = |verdict: &&Verdict| {
        verdict.class == Class::Static && verdict.triangles > 0 && verdict.model.is_finite()
    };
    let noticed = scene.verdicts.iter().filter(is_memorable).filter_map(|verdict| {
        let draw = draw(verdict).filter(|draw| draw.topology == Topology::Triangles)?;
        let layers = layers.remove(&verdict.operation).unwrap_or_default();
        Some(Noticed { draw, verdict, layers })
    });
    noticed.collect()
}

/// What names the triangles of a pass that are known as a whole, wherever they are.
pub fn whole_content(pass: &Pass) -> u64 {
    content_of(&pass.range, pass.first_index, pass.index_count)
}

fn content_of(range: &RetainedRange, first_index: u32, index_count: u32) -> u64 {
    fold(range.content_hash(), u64::from(first_index) << 32 | u64::from(index_count))
}

/// What makes a triangle into a remembered one.
struct Promotion<'a> {
    passes: Vec<(&'a [u32], usize, &'a [u32])>,
    kind: u32,
    model: Mat4,
    eye: Vec3,
}

impl Memory {
    /// Takes note of the static draws of a frame, seen from `eye` in world space.
    pub(super) fn notice(&mut self, frame: &Frame, draws: &[Noticed<'_>], eye: Vec3) {
        let (mut known, mut elsewhere, mut all) = (0, 0, 0);
        self.settled.clear();
        for noticed in draws {
            let place = self.places.number(&noticed.verdict.model);
            let triangles = u64::from(noticed.verdict.triangles);
            all += triangles;
            match noticed.draw.source {
                VertexSource::Retained { range, first_index } => {
                    let Some(range) = frame.retained.get(range as usize) else { continue };
                    let content = content_of(range, first_index, noticed.draw.index_count);
                    let key = fold(content, u64::from(place));
                    let is_known = self.entries.has(key);
                    known += if is_known { triangles } else { 0 };
                    elsewhere += if !is_known && self.contents.contains(&content) { triangles } else { 0 };
                    self.notice_whole(frame, noticed, key, content, place);
                }
                VertexSource::Arena { .. } if self.entries.len() < MOST_ENTRIES => {
                    self.notice_triangles(frame, noticed, place, eye);
                }
                VertexSource::Arena { .. } => {}
            }
        }
        // The same things at other places, and hardly anything where it was: the world has another origin now.
        self.is_displaced = 2 * elsewhere > all && 8 * known < all;
    }

    fn notice_whole(&mut self, frame: &Frame, noticed: &Noticed<'_>, key: u64, content: u64, place: u32) {
        let number = self.entries.number(key);
        let (now, entry) = (self.now, self.entries.get_mut(number));
        if entry.drawn == now {
            return;
        }
        entry.drawn = now;
        entry.missing = 0;
        if entry.cell != NO_CELL {
            self.cells[entry.cell as usize].iter_mut().for_each(|cell| cell.note(now));
            return;
        }
        entry.sightings = entry.sightings.saturating_add(1);
        if entry.sightings < SIGHTINGS {
            return;
        }
        let same = |layer: &&&Draw| layer.index_count == noticed.draw.index_count;
        let draws = std::iter::once(noticed.draw).chain(noticed.layers.iter().filter(same).copied());
        let passes: Vec<Pass> = draws.filter_map(|draw| whole_pass(frame, draw)).collect();
        if passes.is_empty() {
            return;
        }
        let looks = passes.iter().map(|pass| (pass.look.clone(), pass.range.layout)).collect();
        let kind = self.kind(noticed.verdict, place, looks);
        let cell = Cell::new(kind, noticed.verdict.model, passes, vec![number], now);
        self.contents.insert(content);
        self.add_whole(cell);
    }

    fn notice_triangles(&mut self, frame: &Frame, noticed: &Noticed<'_>, place: u32, eye: Vec3) {
        let draw = noticed.draw;
        let (words, indices) = frame.geometry(draw);
        let bytes = fold(xxh3_64(bytemuck::cast_slice(words)), xxh3_64(bytemuck::cast_slice(indices)));
        let content = fold(bytes, u64::from(place) << 32 | u64::from(draw.layout.0));
        let mut memo = self.memos.remove(&content).unwrap_or_else(|| {
            let positions = Positions::new(words, draw.layout);
            let keys = indices
                .chunks_exact(3)
                .map(|triangle| positions.corners(triangle).map(|corners| triangle_key(corners, place)));
            let entries = keys.map(|key| key.map_or(NO_CELL, |key| self.entries.number(key)));
            Memo { entries: entries.collect(), cells: None, is_settled: false, drawn: 0 }
        });
        memo.drawn = self.now;
        match memo.is_settled {
            true => memo.entries.iter().for_each(|&number| self.stamp(number)),
            false => memo.is_settled = self.stamp_new(frame, noticed, place, eye, &memo.entries),
        }
        if memo.is_settled {
            let (operation, layers) = (noticed.verdict.operation, noticed.layers.len());
            self.settled.push(Settled { operation, content, layers });
        }
        self.memos.insert(content, memo);
    }

    #[inline]
    fn stamp(&mut self, number: u32) {
        if number == NO_CELL {
            return;
        }
        let (now, entry) = (self.now, self.entries.get_mut(number));
        if entry.drawn != now {
            entry.drawn = now;
            entry.missing = 0;
            if let Some(Some(cell)) = self.cells.get_mut(entry.cell as usize) {
                cell.note(now);
            }
        }
    }

    /// As [`stamp`](Self::stamp), of triangles of which some are not remembered yet. Says whether all are now.
    fn stamp_new(
        &mut self,
        frame: &Frame,
        noticed: &Noticed<'_>,
        place: u32,
        eye: Vec3,
        entries: &[u32],
    ) -> bool {
        let mut promotion = None;
        let mut is_settled = true;
        for (triangle, &number) in entries.iter().enumerate().filter(|(_, number)| **number != NO_CELL) {
            let entry = self.entries.get_mut(number);
            if entry.sightings >= SIGHTINGS || entry.drawn == self.now {
                is_settled &= entry.sightings >= SIGHTINGS;
                self.stamp(number);
                continue;
            }
            entry.drawn = self.now;
            entry.sightings += 1;
            is_settled &= entry.sightings >= SIGHTINGS;
            if entry.sightings == SIGHTINGS {
                if promotion.is_none() {
                    promotion = self.promotion(frame, noticed, place, eye);
                }
                if let Some(promotion) = &promotion {
                    self.promote(promotion, triangle, number);
                }
            }
        }
        is_settled
    }

    fn promotion<'a>(
        &mut self,
        frame: &'a Frame,
        noticed: &Noticed<'_>,
        place: u32,
        eye: Vec3,
    ) -> Option<Promotion<'a>> {
        let layers = noticed.layers.iter().filter(|layer| are_alike(frame, noticed.draw, layer));
        let draws = || std::iter::once(noticed.draw).chain(layers.clone().copied());
        let looks = draws().map(|draw| Some((Arc::new(Look::of(frame, draw)?), draw.layout)));
        let looks = looks.collect::<Option<Vec<_>>>()?;
        let kind = self.kind(noticed.verdict, place, looks);
        let pass = |draw: &Draw| {
            let (words, indices) = frame.geometry(draw);
            (words, draw.layout.stride(), indices)
        };
        Some(Promotion { passes: draws().map(pass).collect(), kind, model: noticed.verdict.model, eye })
    }

    /// The number of a kind; all of a place have the same matrix.
    fn kind(&mut self, verdict: &Verdict, place: u32, passes: Vec<(Arc<Look>, VertexLayout)>) -> u32 {
        let (model, object, baked) = (self.places.model(place), verdict.object, verdict.baked);
        self.kinds.number(Kind { passes, model, place, object, baked })
    }

    fn promote(&mut self, promotion: &Promotion<'_>, triangle: usize, number: u32) {
        let of =
            move |indices: &'_ [u32]| indices.get(3 * triangle..3 * triangle + 3).map(<[u32; 3]>::try_from);
        let corners: Vec<[u32; 3]> =
            promotion.passes.iter().filter_map(|(_, _, indices)| of(indices)?.ok()).collect();
        let (words, _, _) = promotion.passes[0];
        let layout = self.kinds.get(promotion.kind).passes[0].1;
        if let Some(corners) = Positions::new(words, layout).corners(&corners[0]) {
            let [a, b, c] = corners.map(|corner| promotion.model.transform_point3(position(corner)));
            let entry = self.entries.get_mut(number);
            entry.from_front = (b - a).cross(c - a).dot(promotion.eye - a) >= 0.0;
        }
        let place = self.kinds.get(promotion.kind).place;
        let heap = self.heaps.entry(place).or_insert_with(|| Heap { since: self.now, ..Heap::default() });
        let pile = heap.piles.entry(promotion.kind).or_default();
        let parts = promotion.passes.iter().zip(&corners);
        pile.add(number, parts.map(|((words, stride, _), indices)| (*words, *stride, indices.as_slice())));
    }
}

/// A draw of a retained range as a pass.
fn whole_pass(frame: &Frame, draw: &Draw) -> Option<Pass> {
    let VertexSource::Retained { range, first_index } = draw.source else { return None };
    let range = frame.retained.get(range as usize)?.clone();
    let look = Look::of(frame, draw)?.into();
    Some(Pass { range, first_index, index_count: draw.index_count, look })
}

/// Whether two draws have the same triangles in the same order, as far as the first and the last tell.
fn are_alike(frame: &Frame, base: &Draw, layer: &Draw) -> bool {
    let ends = |draw: &Draw| {
        let (words, indices) = frame.geometry(draw);
        let positions = Positions::new(words, draw.layout);
        let corners = |range: std::ops::Range<usize>| positions.corners(indices.get(range)?);
        let count = indices.len() / 3 * 3;
        (corners(0..3.min(count)), corners(count.saturating_sub(3)..count))
    };
    base.index_count == layer.index_count && ends(base) == ends(layer)
}
