//! The file that brings worlds through to the next run of a program.
//!
//! A header (what it is, version, length and hash of the rest), then worlds, the latest last. A file that is damaged
//! in any way counts as absent. It is written beside its place and then renamed, in a thread of its own.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::JoinHandle;

use xxhash_rust::xxh3::xxh3_64;

use super::Memory;
use super::bytes::{Reader, Writer};
use super::encode::{read_world, write_world};
use super::store::{ImagesByContent, StoredCell, StoredWorld};
use crate::images::Images;

/// What the file begins with; its last word is the version of what follows.
const HEADER: [u32; 4] = [u32::from_le_bytes(*b"AGLO"), u32::from_le_bytes(*b"WMEM"), 0x0102_0304, 1];
/// Bytes of a file, at most.
const MOST_BYTES: u64 = 64 << 20;
/// Worlds of a file, at most.
const MOST_WORLDS: usize = 64;
/// Cells that are too few to be worth a world.
const LEAST_CELLS: usize = 4;

/// A world of the file.
#[derive(Debug)]
struct Kept {
    world: Arc<StoredWorld>,
    /// It is the one that is drawn now.
    is_met: bool,
    /// Of each cell, whether it was taken up.
    adopted: Vec<bool>,
}

/// The file, and what is in it.
#[derive(Debug)]
pub struct Disk {
    path: PathBuf,
    worlds: Vec<Kept>,
    /// The world that was looked for last.
    next: usize,
    writer: Option<JoinHandle<()>>,
}

impl Disk {
    /// Reads a file, if there is one.
    pub fn open(path: PathBuf) -> Disk {
        let worlds = match read_file(&path) {
            Ok(bytes) => decode(&bytes).unwrap_or_default(),
            Err(_) => Vec::new(),
        };
        let kept = |world| Kept { world: Arc::new(world), is_met: false, adopted: Vec::new() };
        Disk { path, worlds: worlds.into_iter().map(kept).collect(), next: 0, writer: None }
    }

    /// The program draws another world now.
    pub fn leave(&mut self) {
        for kept in &mut self.worlds {
            (kept.is_met, kept.adopted) = (false, Vec::new());
        }
    }

    /// Takes up what there is of the world that is drawn.
    pub fn adopt(&mut self, memory: &mut Memory, images: &Images) {
        // One at a time: looking for a world takes a while.
        self.next = (self.next + 1) % self.worlds.len().max(1);
        if let Some(kept) = self.worlds.get_mut(self.next) {
            kept.is_met = kept.is_met || memory.has_met(&kept.world);
        }
        if !self.worlds.iter().any(Kept::is_wanted) {
            return;
        }
        let by_content = images.by_content();
        for kept in self.worlds.iter_mut().filter(|kept| kept.is_wanted()) {
            kept.adopt(memory, &by_content);
        }
    }

    /// Writes what is remembered in place of the world that it came from, beside the others.
    pub fn save(&mut self, memory: &Memory, images: &Images) {
        let mut world = memory.stored(|image| images.get(image).map(|facts| facts.content()));
        if world.cells.len() < LEAST_CELLS {
            return;
        }
        let mut adopted = vec![true; world.cells.len()];
        for kept in self.worlds.extract_if(.., |kept| kept.is_met) {
            world.cells.extend(kept.left());
        }
        adopted.resize(world.cells.len(), false);
        self.worlds.push(Kept { world: Arc::new(world), is_met: true, adopted });
        let excess = self.worlds.len().saturating_sub(MOST_WORLDS);
        self.worlds.drain(..excess);
        let worlds: Vec<_> = self.worlds.iter().map(|kept| kept.world.clone()).collect();
        self.finish();
        let path = self.path.clone();
        // A file that cannot be written is not worth a word to the program's user with every try.
        self.writer = Some(std::thread::spawn(move || drop(write_file(&path, &encode(&worlds)))));
    }

    /// Waits until the file is written.
    pub fn finish(&mut self) {
        if let Some(writer) = self.writer.take() {
            drop(writer.join());
        }
    }
}

impl Kept {
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

    fn adopt(&mut self, memory: &mut Memory, images: &ImagesByContent) {
        self.adopted.resize(self.world.cells.len(), false);
        for (cell, adopted) in self.world.cells.iter().zip(&mut self.adopted) {
            *adopted = *adopted || memory.adopt(cell, images);
        }
    }
}

/// A file's bytes; the oldest worlds are left out if there are too many.
fn encode(worlds: &[Arc<StoredWorld>]) -> Vec<u8> {
    let mut parts: Vec<Vec<u8>> = Vec::new();
    let mut bytes = 0;
    for world in worlds.iter().rev() {
        let mut writer = Writer::default();
        write_world(&mut writer, world);
        bytes += writer.bytes.len() as u64;
        if bytes > MOST_BYTES - 64 {
            break;
        }
        parts.push(writer.bytes);
    }
    let mut payload = Writer::default();
    payload.number(parts.len());
    parts.iter().rev().for_each(|part| payload.bytes.extend_from_slice(part));
    let mut file = Writer::default();
    file.put(&HEADER);
    file.put(&[payload.bytes.len() as u64, xxh3_64(&payload.bytes)]);
    file.bytes.append(&mut payload.bytes);
    file.bytes
}

/// The worlds of a file; none if it is damaged or of another version.
fn decode(bytes: &[u8]) -> Option<Vec<StoredWorld>> {
    let mut reader = Reader::new(bytes);
    let (header, [length, hash]) = (reader.get::<[u32; 4]>()?, reader.get::<[u64; 2]>()?);
    let payload = reader.take(usize::try_from(length).ok()?)?;
    if header != HEADER || !reader.is_done() || xxh3_64(payload) != hash {
        return None;
    }
    decode_payload(payload)
}

fn decode_payload(payload: &[u8]) -> Option<Vec<StoredWorld>> {
    let mut reader = Reader::new(payload);
    let count = reader.count(8).filter(|count| *count <= MOST_WORLDS)?;
    let worlds: Option<Vec<_>> = (0..count).map(|_| read_world(&mut reader)).collect();
    worlds.filter(|_| reader.is_done())
}

fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    if fs::metadata(path)?.len() > MOST_BYTES {
        return Err(io::ErrorKind::FileTooLarge.into());
    }
    fs::read(path)
}

fn write_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    let mut beside = path.as_os_str().to_owned();
    beside.push(format!(".{}.new", std::process::id()));
    let written = fs::File::create(&beside).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    written.and_then(|()| fs::rename(&beside, path)).inspect_err(|_| drop(fs::remove_file(&beside)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory::tests::remembered;
    use proptest::prelude::*;

    fn file() -> Vec<u8> {
        let (memory, images) = remembered();
        let world = memory.stored(|image| images.get(image).map(|facts| facts.content()));
        assert!(world.cells.len() > 2);
        encode(&[Arc::new(StoredWorld::default()), Arc::new(world)])
    }

    #[test]
    fn what_is_written_is_read() {
        let bytes = file();
        let worlds = decode(&bytes).unwrap();
        assert_eq!(worlds.len(), 2);
        let again: Vec<_> = worlds.into_iter().map(Arc::new).collect();
        assert_eq!(encode(&again), bytes);
    }

    #[test]
    fn a_file_that_is_cut_or_of_another_version_counts_as_absent() {
        let mut bytes = file();
        for length in (0..bytes.len()).step_by(7) {
            assert!(decode(&bytes[..length]).is_none());
        }
        bytes[12] += 1;
        assert!(decode(&bytes).is_none());
    }

    proptest! {
        #[test]
        fn a_flipped_bit_is_found(at in 0.0..1.0_f64, bit in 0..8) {
            let mut bytes = file();
            let at = (at * bytes.len() as f64) as usize;
            bytes[at] ^= 1_u8 << bit;
            prop_assert!(decode(&bytes).is_none());
        }

        /// As if the hash were right: anything may come out, as long as it is sound.
        #[test]
        fn damage_that_no_hash_tells_of_is_borne(damage in prop::collection::vec((0.0..1.0_f64, any::<u8>()), 1..9)) {
            let mut payload = file().split_off(32);
            for (at, value) in damage {
                let at = (at * payload.len() as f64) as usize;
                payload[at] = value;
            }
            let mut memory = Memory::default();
            for world in decode_payload(&payload).unwrap_or_default() {
                memory.has_met(&world);
                for cell in &world.cells {
                    memory.adopt(cell, &ImagesByContent::new());
                }
            }
        }
    }

    #[test]
    fn a_world_comes_back_once_it_is_met_again() {
        let folder = std::env::temp_dir().join(format!("afterglow-memory-{}", std::process::id()));
        let path = folder.join("worlds");
        let (memory, images) = remembered();
        let mut disk = Disk::open(path.clone());
        disk.save(&memory, &images);
        disk.finish();
        let mut disk = Disk::open(path);
        assert_eq!(disk.worlds.len(), 1);
        let mut empty = Memory::default();
        disk.adopt(&mut empty, &images);
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
        drop(fs::remove_dir_all(folder));
    }
}
