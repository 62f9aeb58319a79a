//! Surfaces that a frame has drawn, to find what is drawn over them again: layers.

use afterglow_gl::frame::{Draw, Frame, Slot};
use hashbrown::{HashMap, HashSet};

use crate::content::triangle_key;
use crate::draws::DrawFacts;
use crate::geometry::{Attribute, hash_positions};

/// Triangles of a draw that are looked up.
const TRIED: usize = 16;

/// Surfaces drawn so far. Only those that a later draw may be a layer of are hashed at all.
#[derive(Debug, Default)]
pub struct Surfaces {
    /// Number of indices and hash of MODELVIEW of every draw that may be a layer.
    awaited: HashSet<(u32, u64)>,
    /// Operation by hash of positions and hash of MODELVIEW.
    drawn: HashMap<(u64, u64), u32>,
    /// By hash of MODELVIEW: surfaces whose triangles are not in `triangles` yet.
    waiting: HashMap<u64, Vec<(u32, Draw)>>,
    /// Operations by hash of MODELVIEW and key.
    triangles: HashMap<u64, HashMap<u64, u32>>,
}

impl Surfaces {
    /// Nothing is drawn yet; `candidates` are the draws that may be layers, with the hash of MODELVIEW.
    pub fn awaiting<'a>(candidates: impl Iterator<Item = (&'a DrawFacts<'a>, u64)>) -> Surfaces {
        let awaited = candidates.map(|(facts, modelview)| (facts.draw.index_count, modelview)).collect();
        Surfaces { awaited, ..Surfaces::default() }
    }

    /// Takes note of a surface.
    pub fn add(&mut self, frame: &Frame, facts: &DrawFacts, modelview: u64) {
        if self.awaited.is_empty() {
            return;
        }
        if self.awaited.contains(&(facts.draw.index_count, modelview)) {
            let positions = hash_positions(frame, facts.draw);
            self.drawn.insert((positions, modelview), facts.operation);
        }
        self.waiting.entry(modelview).or_default().push((facts.operation, *facts.draw));
    }

    /// The surface with exactly the positions of a draw.
    pub fn same(&self, frame: &Frame, draw: &Draw, modelview: u64) -> Option<u32> {
        if self.drawn.is_empty() {
            return None;
        }
        self.drawn.get(&(hash_positions(frame, draw), modelview)).copied()
    }

    /// The surfaces that most triangles of a draw belong to, in whatever batches they were drawn: those of the triangles that
    /// were looked up.
    pub fn below(&mut self, frame: &Frame, draw: &Draw, modelview: u64) -> Option<Vec<u32>> {
        let known = self.triangles.entry(modelview).or_default();
        for (operation, surface) in self.waiting.remove(&modelview).unwrap_or_default() {
            let keys = triangle_keys(frame, &surface, surface.index_count as usize / 3);
            known.extend(keys.map(|key| (key, operation)));
        }
        let (mut found, mut tried) = (Vec::new(), 0);
        for key in triangle_keys(frame, draw, TRIED) {
            found.extend(known.get(&key));
            tried += 1;
        }
        (found.len() * 2 > tried).then_some(found)
    }
}

/// Keys of up to `count` triangles, spread over a draw: their positions, turned so that the smallest is first.
fn triangle_keys<'a>(frame: &'a Frame, draw: &Draw, count: usize) -> impl Iterator<Item = u64> + use<'a> {
    let triangles = draw.index_count as usize / 3;
    let count = count.min(triangles);
    Attribute::of(frame, draw, Slot::Position as usize)
        .into_iter()
        .flat_map(move |p| (0..count).map(move |i| (p, 3 * (i * triangles / count))))
        .filter_map(|(p, i)| Some(triangle_key([p.get(i)?, p.get(i + 1)?, p.get(i + 2)?])))
}
