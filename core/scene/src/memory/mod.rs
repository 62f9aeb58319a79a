//! The world that was not drawn: static triangles stay in the world after the program stops drawing them, because
//! they are behind the camera or hidden. Shadows, reflections and bounces need them.
//!
//! `notice` takes note of what a frame draws, by key (`keys`, `entries`); what has rested a few frames is copied
//! into `cells`, ranges that never change, so that the device builds each once. A cell of which anything was not
//! drawn in a frame is handed over whole: its drawn triangles then lie twice at exactly the same place, which no ray
//! can tell, and the set of cells changes far less often than the set of triangles. `evidence` finds what is gone,
//! with the help of a coarse depth buffer (`depth`). `disk` brings a world through to the next run.

mod bound;
mod bytes;
mod cells;
mod depth;
mod disk;
mod encode;
mod entries;
mod evidence;
mod keys;
mod look;
mod notice;
mod store;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use afterglow_gl::frame::{Frame, ImageKey, Operation};
use glam::Mat4;
use hashbrown::{HashMap, HashSet};

use crate::images::Images;
use crate::types::{Class, Scene, Verdict};
use cells::{Cell, Pile};
use depth::DepthBuffer;
use disk::Disk;
use entries::{Entries, NO_CELL};
use look::{Kinds, Places};
use notice::{Memo, static_draws};

pub use cells::Pass;
pub use look::Look;

/// Bytes that are remembered unless said otherwise.
pub const MEMORY_BYTES: u64 = 256 << 20;
/// Frames for which a remembered triangle that should be visible is not drawn before it is forgotten.
pub const MISSING_FRAMES: u32 = 8;
/// Frames from one test of what should be visible to the next.
const TEST_INTERVAL: u32 = 4;
/// Frames after which triangles that came to be remembered become cells even if all are still drawn.
const PILE_FRAMES: u32 = 60;
/// Triangles that become cells even if all are still drawn.
const PILE_TRIANGLES: usize = 4096;
/// Cells of fewer triangles are small; so many small ones of a kind become larger ones.
const SMALL_CELL: usize = 64;
const MOST_SMALL: usize = 8;
/// Frames from one sweep of what is idle to the next, and frames after which it goes.
const SWEEP_INTERVAL: u32 = 64;
/// Frames from one writing of the file to the next.
const SAVE_INTERVAL: u32 = 7200;
/// Kinds and places after which all is forgotten: programs make them without end.
const MOST_KINDS: usize = 1 << 13;
const MOST_PLACES: usize = 1 << 14;

/// Triangles of the static world of which some were not drawn in the frame.
#[derive(Debug, Clone)]
pub struct Unseen {
    /// The surface and the layers over it, the same triangles in the same order; at least one.
    pub passes: Arc<[Pass]>,
    /// Object to world space.
    pub model: Mat4,
    /// The object that it is of, or 0.
    pub object: u64,
    /// Its colours are baked light.
    pub baked: bool,
}

/// How much is remembered.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct MemoryCounts {
    /// Triangles, or draws that are known as a whole.
    pub entries: usize,
    /// Cells.
    pub cells: usize,
    /// Bytes of their vertices and indices.
    pub bytes: u64,
}

/// What is remembered of the static world.
#[derive(Debug)]
pub(crate) struct Memory {
    limit: u64,
    /// Frames with a world so far.
    now: u32,
    epoch: u64,
    places: Places,
    kinds: Kinds,
    entries: Entries,
    /// Content of what is known as a whole, wherever it is.
    contents: HashSet<u64>,
    memos: HashMap<u64, Memo>,
    /// By kind.
    piles: BTreeMap<u32, Pile>,
    cells: Vec<Option<Cell>>,
    free_cells: Vec<u32>,
    /// Numbers of small cells by kind.
    small: BTreeMap<u32, Vec<u32>>,
    bytes: u64,
    depth: DepthBuffer,
    /// The cell that is tested first the next time.
    next_tested: usize,
    /// This frame's world has another origin than the ones before.
    is_displaced: bool,
    disk: Option<Disk>,
}

impl Default for Memory {
    fn default() -> Memory {
        Memory::new(MEMORY_BYTES)
    }
}

impl Memory {
    /// A memory of so many bytes; of none it remembers nothing.
    pub(crate) fn new(limit: u64) -> Memory {
        Memory {
            limit,
            now: 0,
            epoch: 0,
            places: Places::default(),
            kinds: Kinds::default(),
            entries: Entries::default(),
            contents: HashSet::new(),
            memos: HashMap::new(),
            piles: BTreeMap::new(),
            cells: Vec::new(),
            free_cells: Vec::new(),
            small: BTreeMap::new(),
            bytes: 0,
            depth: DepthBuffer::default(),
            next_tested: 0,
            is_displaced: false,
            disk: None,
        }
    }

    /// Sets the bound. What is there is forgotten if it is another.
    pub(crate) fn set_limit(&mut self, limit: u64) {
        if self.limit != limit {
            self.limit = limit;
            self.forget();
        }
    }

    /// Goes on where the last run of the program was, as far as a file tells of it, and writes it anew.
    pub(crate) fn set_cache(&mut self, path: PathBuf) {
        self.disk = Some(Disk::open(path));
    }

    /// Writes the file, if there is one.
    pub(crate) fn save(&mut self, images: &Images) {
        if let Some(mut disk) = self.disk.take() {
            disk.save(self, images);
            self.disk = Some(disk);
        }
    }

    /// Waits until the file is written.
    pub(crate) fn finish(&mut self) {
        self.disk.iter_mut().for_each(Disk::finish);
    }

    /// Takes note of what a frame drew, and adds what it did not draw to its scene.
    pub(crate) fn remember(&mut self, frame: &Frame, images: &Images, scene: &mut Scene) {
        if self.limit > 0 {
            self.unless_off(frame, images, scene);
        }
        self.observe(frame);
    }

    /// Takes note of a frame's images, of whatever else there is in it.
    pub(crate) fn observe(&mut self, frame: &Frame) {
        let changed = frame.operations.iter().filter_map(|operation| match operation {
            Operation::DropImage(image) | Operation::DefineImage { image, .. } => Some(*image),
            _ => None,
        });
        let changed: HashSet<ImageKey> = changed.collect();
        if !changed.is_empty() {
            self.drop_images(&changed);
        }
    }

    /// How much there is.
    pub(crate) fn counts(&self) -> MemoryCounts {
        let cells = self.cells.iter().flatten().count();
        MemoryCounts { entries: self.entries.len(), cells, bytes: self.bytes }
    }

    fn unless_off(&mut self, frame: &Frame, images: &Images, scene: &mut Scene) {
        if scene.epoch != self.epoch || self.kinds.len() > MOST_KINDS || self.places.len() > MOST_PLACES {
            self.save(images);
            self.forget();
            self.epoch = scene.epoch;
        }
        let Some(camera) = scene.camera else { return };
        let eye = camera.view.inverse().w_axis.truncate().as_vec3();
        self.now += 1;
        self.forget_moved(&scene.verdicts);
        self.notice(frame, &static_draws(frame, scene), eye);
        if self.is_displaced {
            self.forget();
            return;
        }
        self.close_piles();
        if self.now.is_multiple_of(TEST_INTERVAL) {
            self.remove_missing(frame, scene, &camera);
        }
        if self.now.is_multiple_of(SWEEP_INTERVAL) {
            self.sweep();
            self.take_up(images);
        }
        if self.now.is_multiple_of(SAVE_INTERVAL) {
            self.save(images);
        }
        self.join_small();
        self.bound(eye);
        scene.unseen = self.unseen();
    }

    /// Forgets everything.
    fn forget(&mut self) {
        let mut disk = self.disk.take();
        disk.iter_mut().for_each(Disk::leave);
        *self = Memory { epoch: self.epoch, disk, ..Memory::new(self.limit) };
    }

    /// Takes up what the file tells of the world that is drawn.
    fn take_up(&mut self, images: &Images) {
        if let Some(mut disk) = self.disk.take() {
            disk.adopt(self, images);
            self.disk = Some(disk);
        }
    }

    /// What is remembered and was not drawn in this frame.
    fn unseen(&self) -> Vec<Unseen> {
        let undrawn = self.cells.iter().flatten().filter(|cell| !cell.is_drawn(self.now));
        let unseen = undrawn.map(|cell| {
            let kind = self.kinds.get(cell.kind);
            Unseen { passes: cell.passes.clone(), model: kind.model, object: kind.object, baked: kind.baked }
        });
        unseen.collect()
    }

    /// What moves is not where it stood.
    fn forget_moved(&mut self, verdicts: &[Verdict]) {
        let moves = |verdict: &&Verdict| {
            verdict.object != 0 && matches!(verdict.class, Class::Movable | Class::Dynamic | Class::ViewModel)
        };
        let moved: HashSet<u64> = verdicts.iter().filter(moves).map(|verdict| verdict.object).collect();
        if moved.is_empty() || !self.kinds.iter().any(|kind| moved.contains(&kind.object)) {
            return;
        }
        self.forget_kinds(|kind| moved.contains(&kind.object));
    }

    fn drop_images(&mut self, images: &HashSet<ImageKey>) {
        self.forget_kinds(|kind| {
            kind.passes.iter().flat_map(|(look, _)| look.images()).any(|image| images.contains(&image))
        });
    }

    /// Forgets all triangles of some kinds.
    fn forget_kinds(&mut self, is_gone: impl Fn(&look::Kind) -> bool) {
        let gone: HashSet<u32> =
            (0..).zip(self.kinds.iter()).filter(|(_, kind)| is_gone(kind)).map(|k| k.0).collect();
        if gone.is_empty() {
            return;
        }
        for number in 0..self.cells.len() {
            if self.cells[number].as_ref().is_some_and(|cell| gone.contains(&cell.kind)) {
                self.forget_cell(number);
            }
        }
        for kind in gone {
            for entry in self.piles.remove(&kind).unwrap_or_default().entries {
                self.forget_entry(entry);
            }
        }
    }

    /// Makes cells of triangles that wait for it where some were not drawn, or where they have waited for long.
    fn close_piles(&mut self) {
        let now = self.now;
        let is_due = |pile: &Pile| {
            pile.since + PILE_FRAMES <= now
                || pile.entries.len() >= PILE_TRIANGLES
                || pile.entries.iter().any(|&entry| self.entries.get(entry).drawn != now)
        };
        let due: Vec<u32> =
            self.piles.iter().filter(|(_, pile)| is_due(pile)).map(|(kind, _)| *kind).collect();
        for kind in due {
            let pile = self.piles.remove(&kind).unwrap_or_default();
            self.close(kind, pile);
        }
    }

    /// Makes cells of triangles of a kind.
    fn close(&mut self, number: u32, pile: Pile) {
        let cells = pile.into_cells(number, self.kinds.get(number), self.now);
        for mut cell in cells {
            let drawn =
                cell.entries.iter().filter(|entry| self.entries.get(**entry).drawn == self.now).count();
            cell.drawn = (self.now, drawn as u32);
            self.add_cell(cell);
        }
    }

    fn add_cell(&mut self, cell: Cell) {
        let number = self.free_cells.pop().unwrap_or_else(|| {
            self.cells.push(None);
            self.cells.len() as u32 - 1
        });
        for &entry in &cell.entries {
            self.entries.get_mut(entry).cell = number;
        }
        if !cell.is_whole && cell.entries.len() < SMALL_CELL {
            self.small.entry(cell.kind).or_default().push(number);
        }
        self.bytes += cell.bytes;
        self.cells[number as usize] = Some(cell);
    }

    /// Takes a cell out; its entries are in none then.
    fn take_cell(&mut self, number: usize) -> Option<Cell> {
        let cell = self.cells.get_mut(number)?.take()?;
        self.free_cells.push(number as u32);
        self.bytes -= cell.bytes;
        if let Some(small) = self.small.get_mut(&cell.kind) {
            small.retain(|&small| small as usize != number);
        }
        for &entry in &cell.entries {
            self.entries.get_mut(entry).cell = NO_CELL;
        }
        Some(cell)
    }

    fn forget_cell(&mut self, number: usize) {
        for entry in self.take_cell(number).map(|cell| cell.entries).unwrap_or_default() {
            self.forget_entry(entry);
        }
    }

    /// Forgets an entry that is in no cell. What is known of draws may name it.
    fn forget_entry(&mut self, entry: u32) {
        self.entries.remove(entry);
        self.memos.clear();
    }

    /// Makes larger cells of small ones.
    fn join_small(&mut self) {
        let many = self.small.iter().filter(|(_, small)| small.len() > MOST_SMALL);
        let many: Vec<(u32, Vec<u32>)> = many.map(|(kind, small)| (*kind, small.clone())).collect();
        for (kind, small) in many {
            let mut pile = Pile::default();
            for number in small {
                if let Some(cell) = self.take_cell(number as usize) {
                    pile.add_cell(&cell, |_| true);
                }
            }
            self.close(kind, pile);
        }
    }

    /// Forgets what was seen a few times and never again, and draws that have not come again.
    fn sweep(&mut self) {
        let since = self.now.saturating_sub(SWEEP_INTERVAL);
        if self.entries.remove_seldom(since, |entry| entry.cell == NO_CELL && entry.sightings < 3) {
            self.memos.clear();
        }
        self.memos.retain(|_, memo| memo.drawn >= since);
    }
}
