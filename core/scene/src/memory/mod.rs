//! The world that was not drawn: static triangles stay in the world after the program stops drawing them, because
//! they are behind the camera or hidden. Shadows, reflections and bounces need them.
//!
//! `notice` takes note of what a frame draws, by key (`keys`, `entries`); what has rested a few frames is copied
//! into `cells`, ranges that never change, and cells that lie together make `blocks`, which the device builds once.
//! Where anything at a place was not drawn in a frame, all blocks of the place are handed over, so that the set hardly
//! ever changes while the camera turns; draws whose triangles all lie in blocks, and look there as they are drawn, are
//! told from others: rays need not meet them twice. `evidence` finds what is gone,
//! with the help of a coarse depth buffer (`depth`). `disk` brings a world through to the next run, in a
//! `file`.

mod blocks;
mod bound;
mod bytes;
mod cells;
mod depth;
mod disk;
mod encode;
mod entries;
mod evidence;
mod file;
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
use glam::{DMat4, Mat4};
use hashbrown::{HashMap, HashSet};

use crate::images::Images;
use crate::types::{Class, Scene, Verdict};
use blocks::{Block, Heap};
use cells::{Cell, bounds};
use depth::DepthBuffer;
use disk::Disk;
use entries::{Entries, NO_CELL};
use look::{Kinds, Places};
use notice::{Memo, Settled, static_draws};

pub use cells::Pass;
pub use look::Look;

/// Bytes that are remembered unless said otherwise.
pub const MEMORY_BYTES: u64 = 256 << 20;
/// Frames for which a remembered triangle that should be visible is not drawn before it is forgotten.
pub const MISSING_FRAMES: u32 = 8;
/// Frames from one test of what should be visible to the next.
const TEST_INTERVAL: u32 = 4;
/// Frames from one sweep of what is idle to the next, and frames after which it goes.
const SWEEP_INTERVAL: u32 = 64;
/// Frames from one look at the worlds of earlier runs to the next.
const LOOK_INTERVAL: u32 = 16;
/// Frames from one writing of the file to the next.
const SAVE_INTERVAL: u32 = 3600;
/// Kinds and places after which all is forgotten: programs make them without end.
const MOST_KINDS: usize = 1 << 13;
const MOST_PLACES: usize = 1 << 14;

/// Remembered triangles of the static world, at a place where not all was drawn in the frame.
#[derive(Debug, Clone)]
pub struct Unseen {
    /// The surface and the layers over it, the same triangles in the same order; at least one.
    pub passes: Arc<[Pass]>,
    /// Parts with the same number lie together under one model matrix; they change seldom.
    pub block: u32,
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
    /// Of this frame.
    settled: Vec<Settled>,
    /// By place.
    heaps: BTreeMap<u32, Heap>,
    cells: Vec<Option<Cell>>,
    free_cells: Vec<u32>,
    /// Counts changes of which entries are in which cells.
    changes: u64,
    blocks: BTreeMap<u32, Block>,
    next_block: u32,
    /// The next block when small ones were last looked for.
    joined_blocks: u32,
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
            settled: Vec::new(),
            heaps: BTreeMap::new(),
            cells: Vec::new(),
            free_cells: Vec::new(),
            changes: 0,
            blocks: BTreeMap::new(),
            next_block: 0,
            joined_blocks: 0,
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
        self.close_heaps();
        if self.now.is_multiple_of(TEST_INTERVAL) {
            self.remove_missing(frame, scene, &camera);
        }
        if self.now.is_multiple_of(SWEEP_INTERVAL) {
            self.sweep();
        }
        if self.now.is_multiple_of(LOOK_INTERVAL) {
            self.take_up(images);
        }
        if self.now.is_multiple_of(SAVE_INTERVAL) {
            self.save(images);
        }
        self.join_small();
        self.bound(eye);
        self.hand_over(frame, scene);
    }

    /// The world has other coordinates from now on, `change` away from those before, and another number.
    pub(crate) fn carry_over(&mut self, change: DMat4, epoch: u64) {
        if change != DMat4::IDENTITY {
            self.places.transform(change);
            self.kinds.replace(&self.places);
            for cell in self.cells.iter_mut().flatten() {
                cell.bounds = bounds(&cell.passes, self.kinds.get(cell.kind).model);
            }
        }
        self.epoch = epoch;
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
        let mut waiting = Vec::new();
        for heap in self.heaps.values_mut() {
            let piles = gone.iter().filter_map(|kind| heap.piles.remove(kind));
            waiting.extend(piles.flat_map(|pile| pile.entries));
        }
        waiting.into_iter().for_each(|entry| self.forget_entry(entry));
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

    /// Forgets what was seen a few times and never again, and draws that have not come again.
    fn sweep(&mut self) {
        let since = self.now.saturating_sub(SWEEP_INTERVAL);
        if self
            .entries
            .remove_seldom(since, |entry| entry.cell == NO_CELL && entry.sightings < notice::SIGHTINGS)
        {
            self.memos.clear();
        }
        self.memos.retain(|_, memo| memo.drawn >= since);
    }
}
