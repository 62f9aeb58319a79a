//! Blocks: cells of all kinds that lie together at one place. Rays enter a block or pass it by, so blocks should be
//! compact; the device builds each of them once.

use std::collections::{BTreeMap, BTreeSet};

use afterglow_gl::frame::{Draw, Frame, Operation, VertexLayout};
use glam::Vec3;

use super::cells::{Cell, Pile};
use super::entries::{Entries, NO_CELL};
use super::look::Look;
use super::notice::Settled;
use super::{Memory, Unseen};
use crate::types::Scene;

/// Triangles of a block, at most, unless they were drawn out of a range of the program's.
const BLOCK_TRIANGLES: usize = 1024;
/// Blocks of fewer triangles are small; so many small ones at a place become larger ones.
const SMALL_BLOCK: usize = 256;
const MOST_SMALL: usize = 8;
/// Frames after which triangles that came to be remembered become blocks even if all are still drawn.
const HEAP_FRAMES: u32 = 60;
/// Triangles that become blocks even if all are still drawn.
const HEAP_TRIANGLES: usize = 4096;

/// Cells that lie together.
#[derive(Debug, Default)]
pub struct Block {
    place: u32,
    /// Numbers of its cells.
    pub cells: Vec<u32>,
    triangles: usize,
    is_whole: bool,
}

/// Triangles at a place that are in no block yet.
#[derive(Debug, Default)]
pub struct Heap {
    /// By kind.
    pub piles: BTreeMap<u32, Pile>,
    /// Frame in which the first one came.
    pub since: u32,
}

impl Heap {
    fn entries(&self) -> impl Iterator<Item = &u32> {
        self.piles.values().flat_map(|pile| &pile.entries)
    }
}

/// State of a draw as its frame's tables have it, the kind it was compared with, and whether both look alike.
/// Neighbours mostly share all of it.
type Compared = ([u32; 4], VertexLayout, u32, bool);

fn looks_as(frame: &Frame, draw: &Draw, kind: u32, look: &Look, last: &mut Option<Compared>) -> bool {
    let state = [draw.fixed, draw.bindings, draw.material, draw.current];
    match *last {
        Some((known, layout, of, is_alike)) if known == state && layout == draw.layout && of == kind => {
            is_alike
        }
        _ => {
            let is_alike = look.is_of(frame, draw);
            *last = Some((state, draw.layout, kind, is_alike));
            is_alike
        }
    }
}

/// The cells that entries are in, each run of them once; nothing where one is in none.
fn cells_of_entries(numbers: &[u32], entries: &Entries) -> Option<Box<[u32]>> {
    let mut cells: Vec<u32> = Vec::new();
    for &number in numbers.iter().filter(|number| **number != NO_CELL) {
        let cell = entries.get(number).cell;
        if cell == NO_CELL {
            return None;
        }
        if cells.last() != Some(&cell) {
            cells.push(cell);
        }
    }
    Some(cells.into())
}

impl Memory {
    /// Blocks that are handed over: all of a place if anything of any of them was not drawn. What is known whole goes
    /// by itself.
    fn emitted(&self) -> BTreeSet<u32> {
        let is_undrawn = |block: &Block| self.cells_of(block).any(|cell| !cell.is_drawn(self.now));
        let undrawn: Vec<_> = self.blocks.iter().filter(|(_, block)| is_undrawn(block)).collect();
        let places: BTreeSet<u32> =
            undrawn.iter().filter(|(_, block)| !block.is_whole).map(|(_, block)| block.place).collect();
        let of_place =
            self.blocks.iter().filter(|(_, block)| !block.is_whole && places.contains(&block.place));
        of_place.chain(undrawn).map(|(number, _)| *number).collect()
    }

    /// Adds what was not drawn to a scene, and says which draws lie within it.
    pub(super) fn hand_over(&mut self, frame: &Frame, scene: &mut Scene) {
        let emitted = self.emitted();
        let cells = emitted.iter().filter_map(|number| Some((*number, self.blocks.get(number)?)));
        let cells = cells.flat_map(|(number, block)| self.cells_of(block).map(move |cell| (number, cell)));
        scene.unseen = cells
            .map(|(block, cell)| {
                let kind = self.kinds.get(cell.kind);
                let (model, object, baked) = (kind.model, kind.object, kind.baked);
                Unseen { passes: cell.passes.clone(), block, model, object, baked }
            })
            .collect();
        let settled = std::mem::take(&mut self.settled);
        if !emitted.is_empty() {
            let mut last = None;
            let covered = settled.iter().filter(|draw| self.is_covered(frame, draw, &emitted, &mut last));
            scene.covered = covered.map(|draw| draw.operation).collect();
        }
    }

    /// Whether all triangles of a draw lie within what is handed over, and look there as it does.
    fn is_covered(
        &mut self,
        frame: &Frame,
        draw: &Settled,
        emitted: &BTreeSet<u32>,
        last: &mut Option<Compared>,
    ) -> bool {
        let Some(Operation::Draw(drawn)) = frame.operations.get(draw.operation as usize) else {
            return false;
        };
        let Some(memo) = self.memos.get_mut(&draw.content) else { return false };
        let (changes, known) = memo.cells.take().unwrap_or_default();
        let is_valid = changes == self.changes && changes != 0;
        let cells = if is_valid { known } else { cells_of_entries(&memo.entries, &self.entries) };
        let is_covered = cells.iter().flatten().all(|&number| {
            let Some(Some(cell)) = self.cells.get(number as usize) else { return false };
            let passes = &self.kinds.get(cell.kind).passes;
            passes.len() == 1 + draw.layers
                && emitted.contains(&cell.block)
                && looks_as(frame, drawn, cell.kind, &passes[0].0, last)
        });
        let is_covered = is_covered && cells.is_some();
        memo.cells = Some((self.changes, cells));
        is_covered
    }

    /// The cells of a block.
    pub(super) fn cells_of<'a>(&'a self, block: &'a Block) -> impl Iterator<Item = &'a Cell> {
        block.cells.iter().filter_map(|cell| self.cells.get(*cell as usize)?.as_ref())
    }

    /// Makes blocks of triangles that wait for it where some were not drawn, or where they have waited for long.
    pub(super) fn close_heaps(&mut self) {
        let now = self.now;
        let is_due = |heap: &Heap| {
            heap.since + HEAP_FRAMES <= now
                || heap.entries().count() >= HEAP_TRIANGLES
                || heap.entries().any(|&entry| self.entries.get(entry).drawn != now)
        };
        let due: Vec<u32> =
            self.heaps.iter().filter(|(_, heap)| is_due(heap)).map(|(place, _)| *place).collect();
        for place in due {
            let heap = self.heaps.remove(&place).unwrap_or_default();
            self.close(heap);
        }
    }

    /// Makes blocks of triangles: cut along a curve that fills space, so that what lies together stays
    /// together.
    pub(super) fn close(&mut self, heap: Heap) {
        let mut centres = Vec::new();
        for (&kind, pile) in &heap.piles {
            let numbered = (0..).zip(pile.centres(self.kinds.get(kind)));
            centres.extend(numbered.map(|(triangle, centre)| (centre, kind, triangle)));
        }
        let order = spatial_order(&centres);
        let count = order.len().div_ceil(BLOCK_TRIANGLES).max(1);
        for triangles in order.chunks(order.len().div_ceil(count).max(1)) {
            let mut by_kind: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
            for &(kind, triangle) in triangles {
                by_kind.entry(kind).or_default().push(triangle);
            }
            let block = self.new_block();
            for (kind, triangles) in by_kind {
                if let Some(pile) = heap.piles.get(&kind) {
                    let cell = pile.cell(kind, self.kinds.get(kind), &triangles, self.now);
                    self.add_cell(block, cell);
                }
            }
        }
    }

    fn new_block(&mut self) -> u32 {
        self.next_block += 1;
        self.next_block
    }

    /// Adds a cell that is a block by itself.
    pub(super) fn add_whole(&mut self, cell: Cell) {
        let block = self.new_block();
        self.add_cell(block, Cell { is_whole: true, ..cell });
    }

    /// Adds a cell to a block.
    pub(super) fn add_cell(&mut self, block: u32, mut cell: Cell) {
        self.changes += 1;
        let number = self.free_cells.pop().unwrap_or_else(|| {
            self.cells.push(None);
            self.cells.len() as u32 - 1
        });
        let mut drawn = 0;
        for &entry in &cell.entries {
            let entry = self.entries.get_mut(entry);
            entry.cell = number;
            drawn += u32::from(entry.drawn == self.now);
        }
        cell.drawn = (cell.drawn.0, drawn);
        cell.block = block;
        self.bytes += cell.bytes;
        let place = self.kinds.get(cell.kind).place;
        let new = || Block { place, is_whole: cell.is_whole, ..Block::default() };
        let to = self.blocks.entry(block).or_insert_with(new);
        to.cells.push(number);
        to.triangles += cell.entries.len();
        self.cells[number as usize] = Some(cell);
    }

    /// Takes a cell out; its entries are in none then.
    pub(super) fn take_cell(&mut self, number: usize) -> Option<Cell> {
        let cell = self.cells.get_mut(number)?.take()?;
        self.free_cells.push(number as u32);
        self.changes += 1;
        self.bytes -= cell.bytes;
        if let Some(block) = self.blocks.get_mut(&cell.block) {
            block.cells.retain(|&cell| cell as usize != number);
            block.triangles -= cell.entries.len();
            if block.cells.is_empty() {
                self.blocks.remove(&cell.block);
            }
        }
        for &entry in &cell.entries {
            self.entries.get_mut(entry).cell = NO_CELL;
        }
        Some(cell)
    }

    /// Makes larger blocks of small ones, if any were added.
    pub(super) fn join_small(&mut self) {
        if self.joined_blocks == self.next_block {
            return;
        }
        let mut small: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        let is_small = |block: &Block| !block.is_whole && block.triangles < SMALL_BLOCK;
        for block in self.blocks.values().filter(|block| is_small(block)) {
            let cells = small.entry(block.place).or_default();
            cells.extend(&block.cells);
        }
        let count =
            |place: u32| self.blocks.values().filter(|block| is_small(block) && block.place == place).count();
        small.retain(|&place, _| count(place) > MOST_SMALL);
        for cells in small.into_values() {
            let mut heap = Heap::default();
            for number in cells {
                if let Some(cell) = self.take_cell(number as usize) {
                    heap.piles.entry(cell.kind).or_default().add_cell(&cell, |_| true);
                }
            }
            self.close(heap);
        }
        self.joined_blocks = self.next_block;
    }
}

/// Triangles by kind and number, in the order of their centres along a Z-curve (Morton 1966).
fn spatial_order(centres: &[(Vec3, u32, u32)]) -> Vec<(u32, u32)> {
    let least = centres.iter().fold(Vec3::INFINITY, |least, (centre, ..)| least.min(*centre));
    let most = centres.iter().fold(Vec3::NEG_INFINITY, |most, (centre, ..)| most.max(*centre));
    let scale = 1023.0 / (most - least).max_element().max(f32::MIN_POSITIVE);
    let keyed = centres.iter().map(|(centre, kind, triangle)| {
        let [x, y, z] = ((*centre - least) * scale).to_array().map(|c| spread(c as u32));
        (x | y << 1 | z << 2, *kind, *triangle)
    });
    let mut keyed: Vec<_> = keyed.collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|(_, kind, triangle)| (kind, triangle)).collect()
}

/// Ten bits with two zeros after each.
fn spread(mut bits: u32) -> u32 {
    bits &= 0x3ff;
    bits = (bits | bits << 16) & 0x0300_00ff;
    bits = (bits | bits << 8) & 0x0300_f00f;
    bits = (bits | bits << 4) & 0x030c_30c3;
    (bits | bits << 2) & 0x0924_9249
}
