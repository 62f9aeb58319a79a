//! Worlds of earlier runs of a program: what the file holds of the world that is drawn now is taken up, and the file
//! is written anew. Reading, and writing but for the last time, take place on threads of their own.

use std::path::PathBuf;
use std::sync::Arc;
use std::thread::{Builder, JoinHandle};

use super::Memory;
use super::file::{self, Known};
use super::store::{ImagesByContent, StoredCell, StoredWorld};
use crate::images::Images;

/// Cells that are too few to be worth a world.
const LEAST_CELLS: usize = 4;
/// Bytes of what a world keeps, about, at most.
const MOST_WORLD_BYTES: u64 = 32 << 20;
/// Triangles that are taken up in a frame: the device builds what is new in that frame.
const MOST_ADOPTED: usize = 1 << 14;

/// A world of the file.
#[derive(Debug)]
struct Kept {
    world: Arc<StoredWorld>,
    /// It is the one that is drawn now.
    is_met: bool,
    /// Of each cell, whether it was taken up.
    adopted: Vec<bool>,
    /// The cell from which on cells are still to be tried.
    next: usize,
}

/// The file, and what is in it.
#[derive(Debug)]
pub struct Disk {
    path: PathBuf,
    worlds: Vec<Kept>,
    /// What is in the file that was read from it or written to it here.
    known: Known,
    /// The world that was looked for last.
    next: usize,
    reader: Option<JoinHandle<(Vec<StoredWorld>, Known)>>,
    writer: Option<JoinHandle<Known>>,
    /// There is something that was not written yet.
    is_new: bool,
}

impl Disk {
    /// Reads a file, if there is one.
    pub fn open(path: PathBuf) -> Disk {
        let from = path.clone();
        let reader = thread(move || file::read(&from));
        let (worlds, known) = (Vec::new(), Known::new());
        Disk { path, worlds, known, next: 0, reader, writer: None, is_new: false }
    }

    /// Waits until the file is read. That it is waited for makes runs alike.
    fn read(&mut self) {
        let Some((worlds, known)) = self.reader.take().and_then(|reader| reader.join().ok()) else { return };
        self.worlds.splice(0..0, worlds.into_iter().map(Kept::new));
        self.known.extend(known);
    }

    /// The program draws another world now.
    pub fn leave(&mut self) {
        for kept in &mut self.worlds {
            (kept.is_met, kept.adopted, kept.next) = (false, Vec::new(), 0);
        }
    }

    /// Takes up what there is of the world that is drawn, or a part of it.
    pub fn adopt(&mut self, memory: &mut Memory, images: &Images) {
        self.read();
        // One at a time, the latest first: looking for a world takes a while.
        self.next = self.next.checked_sub(1).unwrap_or(self.worlds.len().saturating_sub(1));
        if let Some(kept) = self.worlds.get_mut(self.next) {
            kept.is_met = kept.is_met || memory.has_met(&kept.world);
        }
        if !self.worlds.iter().any(Kept::is_wanted) {
            return;
        }
        let by_content = images.by_content();
        let mut budget = MOST_ADOPTED;
        for kept in self.worlds.iter_mut().filter(|kept| kept.is_wanted()) {
            kept.adopt(memory, &by_content, &mut budget);
        }
    }

    /// Writes what is remembered in place of the world that it came from, beside the others, once nothing else is
    /// being written.
    pub fn save(&mut self, memory: &Memory, images: &Images) {
        let mut world = memory.stored(|image| images.get(image).map(|facts| facts.content()));
        if world.cells.len() < LEAST_CELLS {
            return;
        }
        self.read();
        let mut adopted = vec![true; world.cells.len()];
        for kept in self.worlds.extract_if(.., |kept| kept.is_met) {
            world.cells.extend(kept.left());
        }
        world.bound(MOST_WORLD_BYTES);
        adopted.resize(world.cells.len(), false);
        self.worlds.push(Kept { is_met: true, adopted, ..Kept::new(world) });
        self.is_new = true;
        if self.writer.as_ref().is_none_or(JoinHandle::is_finished) {
            self.write();
        }
    }

    fn write(&mut self) {
        self.join();
        let worlds: Vec<_> = self.worlds.iter().map(|kept| kept.world.clone()).collect();
        let (path, known) = (self.path.clone(), self.known.clone());
        self.writer = thread(move || file::write(&path, &worlds, &known));
        self.is_new = false;
    }

    fn join(&mut self) {
        if let Some(written) = self.writer.take().and_then(|writer| writer.join().ok()) {
            self.known.extend(written);
        }
    }

    /// Waits until everything is written.
    pub fn finish(&mut self) {
        if self.is_new {
            self.write();
        }
        self.join();
    }
}

/// A thread; none where the system has no more.
fn thread<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Option<JoinHandle<T>> {
    Builder::new().name("worlds".into()).spawn(work).ok()
}

impl Kept {
    fn new(world: StoredWorld) -> Kept {
        Kept { world: Arc::new(world), is_met: false, adopted: Vec::new(), next: 0 }
    }

    /// Whether there is anything left of it to take up.
    fn is_wanted(&self) -> bool {
        self.is_met && (self.adopted.len() < self.world.cells.len() || self.adopted.contains(&false))
    }

    /// Cells that were not taken up, because their images were not there.
    fn left(&self) -> impl Iterator<Item = StoredCell> {
        let is_left = |number: usize| !self.adopted.get(number).copied().unwrap_or(false);
        self.world
            .cells
            .iter()
            .enumerate()
            .filter(move |(number, _)| is_left(*number))
            .map(|(_, cell)| cell.clone())
    }

    /// Takes cells up from where the last call ended, until the budget of triangles is spent.
    fn adopt(&mut self, memory: &mut Memory, images: &ImagesByContent, budget: &mut usize) {
        self.adopted.resize(self.world.cells.len(), false);
        for (number, cell) in self.world.cells.iter().enumerate().skip(self.next) {
            if *budget == 0 {
                self.next = number;
                return;
            }
            if !self.adopted[number] && memory.adopt(cell, images) {
                self.adopted[number] = true;
                *budget = budget.saturating_sub(cell.triangles());
            }
        }
        self.next = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory::tests::remembered;

    fn folder(name: &str) -> PathBuf {
        std::env::temp_dir().join(format!("afterglow-memory-{name}-{}", std::process::id()))
    }

    #[test]
    fn a_world_comes_back_once_it_is_met_again() {
        let folder = folder("met");
        let path = folder.join("worlds");
        let (memory, images) = remembered();
        let mut disk = Disk::open(path.clone());
        disk.save(&memory, &images);
        disk.finish();
        let mut disk = Disk::open(path);
        let mut empty = Memory::default();
        disk.adopt(&mut empty, &images);
        assert_eq!(disk.worlds.len(), 1);
        assert_eq!(empty.counts().cells, 0, "nothing of it was drawn yet");
        // A memory of a part of it: all cells but the last two.
        let (mut partial, images) = remembered();
        for cell in 2..memory.cells.len() {
            partial.forget_cell(cell);
        }
        let before = partial.counts();
        disk.adopt(&mut partial, &images);
        let after = partial.counts();
        assert!(after.entries > before.entries, "{before:?} {after:?}");
        assert_eq!(after.entries, memory.counts().entries);
        disk.adopt(&mut partial, &images);
        assert_eq!(partial.counts(), after);
        drop(std::fs::remove_dir_all(folder));
    }

    #[test]
    fn what_is_met_again_is_one_world_still() {
        let folder = folder("again");
        let path = folder.join("worlds");
        let mut lengths = Vec::new();
        for _ in 0..3 {
            let (mut memory, images) = remembered();
            let mut disk = Disk::open(path.clone());
            disk.adopt(&mut memory, &images);
            disk.save(&memory, &images);
            disk.save(&memory, &images);
            disk.finish();
            lengths.push(std::fs::metadata(&path).unwrap().len());
        }
        assert_eq!(file::read(&path).0.len(), 1);
        assert_eq!(lengths[1], lengths[2]);
        drop(std::fs::remove_dir_all(folder));
    }
}
