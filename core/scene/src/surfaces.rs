//! Surfaces that a frame has drawn, to find what is drawn over them again: layers.

use std::sync::Arc;

use afterglow_gl::frame::{Draw, Frame, Slot};
use glam::Vec3;
use hashbrown::{HashMap, HashSet};

use crate::content::{affine, triangle_key};
use crate::draws::DrawFacts;
use crate::geometry::{Attribute, ContentCache, hash_positions};

/// Triangles of a draw that are looked up.
const TRIED: usize = 16;

/// Surfaces drawn so far. Only those that a later draw may be a layer of are hashed at all.
#[derive(Debug, Default)]
pub struct Surfaces<'a> {
    /// Number of indices and hash of MODELVIEW of every draw that may be a layer.
    awaited: HashSet<(u32, u64)>,
    /// Operation by hash of positions and hash of MODELVIEW.
    drawn: HashMap<(u64, u64), u32>,
    /// By hash of MODELVIEW, in order.
    surfaces: HashMap<u64, Vec<Surface<'a>>>,
}

#[derive(Debug)]
struct Surface<'a> {
    facts: &'a DrawFacts<'a>,
    /// Middle of the ball about it in object space, and its radius squared; everywhere where that is not known.
    ball: (Vec3, f32),
    /// Of all its triangles, sorted, once they were needed.
    keys: Option<Arc<[u64]>>,
}

impl Surface<'_> {
    /// Whether a point of its object space may lie on it. What is not a number may be anywhere.
    fn may_hold(&self, point: Vec3) -> bool {
        let (centre, reach) = self.ball;
        let away = centre.distance_squared(point);
        away <= reach || away.is_nan()
    }

    fn has(&mut self, frame: &Frame, key: u64, cache: &mut ContentCache) -> bool {
        let facts = self.facts;
        if let Some(piece) = facts.piece.filter(|piece| !piece.content.keys.is_empty()) {
            return piece.content.keys.contains(&key);
        }
        let find = || triangles(frame, facts.draw, usize::MAX).map(|(key, _)| key).collect();
        let keys = self.keys.get_or_insert_with(|| cache.triangle_keys(facts.content, find));
        keys.binary_search(&key).is_ok()
    }
}

impl<'a> Surfaces<'a> {
    /// Nothing is drawn yet; `candidates` are the draws that may be layers, with the hash of MODELVIEW.
    pub fn awaiting<'b>(candidates: impl Iterator<Item = (&'b DrawFacts<'b>, u64)>) -> Surfaces<'a> {
        let awaited = candidates.map(|(facts, modelview)| (facts.draw.index_count, modelview)).collect();
        Surfaces { awaited, ..Surfaces::default() }
    }

    /// Takes note of a surface.
    pub fn add(&mut self, frame: &Frame, facts: &'a DrawFacts<'a>, modelview: u64) {
        if self.awaited.is_empty() {
            return;
        }
        if self.awaited.contains(&(facts.draw.index_count, modelview)) {
            let positions = hash_positions(frame, facts.draw);
            self.drawn.insert((positions, modelview), facts.operation);
        }
        let ball = facts.piece.map_or((Vec3::ZERO, f32::INFINITY), |piece| piece.content.ball());
        self.surfaces.entry(modelview).or_default().push(Surface { facts, ball, keys: None });
    }

    /// The surface with exactly the positions of a draw.
    pub fn same(&self, frame: &Frame, draw: &Draw, modelview: u64) -> Option<u32> {
        if self.drawn.is_empty() {
            return None;
        }
        self.drawn.get(&(hash_positions(frame, draw), modelview)).copied()
    }

    /// The surfaces that most triangles of a draw belong to, in whatever batches they were drawn: those of the triangles that
    /// were looked up. Where a triangle was drawn more than once, the last counts.
    pub fn below(
        &mut self,
        frame: &Frame,
        facts: &DrawFacts,
        modelview: u64,
        cache: &mut ContentCache,
    ) -> Option<Vec<u32>> {
        let surfaces = self.surfaces.get_mut(&modelview).map_or(&mut [][..], Vec::as_mut_slice);
        let (mut found, mut tried) = (Vec::new(), 0);
        for (key, corner) in triangles(frame, facts.draw, TRIED) {
            let mut near = surfaces.iter_mut().rev().filter(|surface| surface.may_hold(corner));
            found.extend(
                near.find_map(|surface| surface.has(frame, key, cache).then_some(surface.facts.operation)),
            );
            tried += 1;
        }
        (found.len() * 2 > tried).then_some(found)
    }
}

/// Up to `count` triangles, spread over a draw: the key of their positions, turned so that the smallest is first, and a
/// corner.
fn triangles<'a>(frame: &'a Frame, draw: &Draw, count: usize) -> impl Iterator<Item = (u64, Vec3)> + use<'a> {
    let triangles = draw.index_count as usize / 3;
    let count = count.min(triangles);
    Attribute::of(frame, draw, Slot::Position as usize)
        .into_iter()
        .flat_map(move |p| (0..count).map(move |i| (p, 3 * (i * triangles / count))))
        .filter_map(|(p, i)| {
            let corners = [p.get(i)?, p.get(i + 1)?, p.get(i + 2)?];
            Some((triangle_key(corners), affine(corners[0])))
        })
}
