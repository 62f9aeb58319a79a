//! The file of a program's worlds, as bytes.
//!
//! A header (what it is, version, length and hash of the rest), then worlds, each with its length, the latest last. A
//! file that is damaged in any way counts as absent.

use std::path::Path;
use std::sync::Arc;

use hashbrown::HashSet;
use xxhash_rust::xxh3::xxh3_64;

use super::bytes::{Reader, Writer};
use super::encode::{read_world, write_world};
use super::store::StoredWorld;
use crate::program_cache;

/// What the file begins with; its last word is the version of what follows.
const HEADER: [u32; 4] = [u32::from_le_bytes(*b"AGLO"), u32::from_le_bytes(*b"WMEM"), 0x0102_0304, 2];
/// Bytes of a file, and of the files of all programs, at most.
const MOST_BYTES: u64 = 64 << 20;
const MOST_BYTES_OF_ALL: u64 = 512 << 20;
/// Worlds of a file, at most.
const MOST_WORLDS: usize = 64;

/// Worlds by the hash of their bytes: those that a process has read or written.
pub type Known = HashSet<u64>;

/// The worlds of a file that is there and sound, and what they are known by. Says in one line why there are none.
pub fn read(path: &Path) -> (Vec<StoredWorld>, Known) {
    let bytes = match program_cache::read(path, MOST_BYTES) {
        Ok(None) => return Default::default(),
        Ok(Some(bytes)) => bytes,
        Err(error) => {
            tracing::warn!("{}: worlds of earlier runs cannot be read: {error}", path.display());
            return Default::default();
        }
    };
    let Some(worlds) = decode(&bytes) else {
        tracing::warn!("{}: worlds of earlier runs are damaged or of another version", path.display());
        return Default::default();
    };
    let known = parts(&bytes).unwrap_or_default().into_iter().map(xxh3_64).collect();
    (worlds, known)
}

/// Writes worlds in place of those that are known, and keeps what another process has written meanwhile. Returns what
/// they are known by; none if they could not be written.
pub fn write(path: &Path, worlds: &[Arc<StoredWorld>], known: &Known) -> Known {
    let there = program_cache::read(path, MOST_BYTES).ok().flatten().unwrap_or_default();
    let others = parts(&there).unwrap_or_default().into_iter();
    let others = others.filter(|part| !known.contains(&xxh3_64(part))).map(<[u8]>::to_vec);
    let own: Vec<Vec<u8>> = worlds.iter().map(|world| encode_world(world)).collect();
    let written = own.iter().map(|part| xxh3_64(part)).collect();
    let all: Vec<Vec<u8>> = others.chain(own).collect();
    match program_cache::write(path, &encode(&all), MOST_BYTES_OF_ALL) {
        Ok(()) => written,
        Err(error) => {
            // Not worth a word to the program's user with every try.
            tracing::debug!("{}: worlds cannot be kept: {error}", path.display());
            Known::default()
        }
    }
}

fn encode_world(world: &StoredWorld) -> Vec<u8> {
    let mut writer = Writer::default();
    write_world(&mut writer, world);
    writer.bytes
}

/// A file's bytes; the oldest worlds are left out if there are too many.
fn encode(worlds: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = 64;
    let fits = |world: &&Vec<u8>| {
        bytes += world.len() as u64 + 8;
        bytes <= MOST_BYTES
    };
    let parts: Vec<&Vec<u8>> = worlds.iter().rev().take(MOST_WORLDS).take_while(fits).collect();
    let mut payload = Writer::default();
    payload.number(parts.len());
    for part in parts.iter().rev() {
        payload.put(&(part.len() as u64));
        payload.bytes.extend_from_slice(part);
    }
    let mut file = Writer::default();
    file.put(&HEADER);
    file.put(&[payload.bytes.len() as u64, xxh3_64(&payload.bytes)]);
    file.bytes.append(&mut payload.bytes);
    file.bytes
}

/// The bytes of each world of a file; none if it is damaged or of another version.
fn parts(bytes: &[u8]) -> Option<Vec<&[u8]>> {
    let mut reader = Reader::new(bytes);
    let (header, [length, hash]) = (reader.get::<[u32; 4]>()?, reader.get::<[u64; 2]>()?);
    let payload = reader.take(usize::try_from(length).ok()?)?;
    let is_sound = header == HEADER && reader.is_done() && xxh3_64(payload) == hash;
    if is_sound { parts_of(payload) } else { None }
}

fn parts_of(payload: &[u8]) -> Option<Vec<&[u8]>> {
    let mut reader = Reader::new(payload);
    let count = reader.count(8).filter(|count| *count <= MOST_WORLDS)?;
    let mut part = || {
        let length = reader.get::<u64>()?;
        reader.take(usize::try_from(length).ok()?)
    };
    let parts: Option<Vec<_>> = (0..count).map(|_| part()).collect();
    parts.filter(|_| reader.is_done())
}

fn decode(bytes: &[u8]) -> Option<Vec<StoredWorld>> {
    worlds_of(&parts(bytes)?)
}

fn worlds_of(parts: &[&[u8]]) -> Option<Vec<StoredWorld>> {
    let world = |part: &&[u8]| {
        let mut reader = Reader::new(part);
        read_world(&mut reader).filter(|_| reader.is_done())
    };
    parts.iter().map(world).collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::memory::Memory;
    use crate::memory::store::ImagesByContent;
    use crate::memory::tests::remembered;
    use proptest::prelude::*;

    fn file() -> Vec<u8> {
        let (memory, images) = remembered();
        let world = memory.stored(|image| images.get(image).map(|facts| facts.content()));
        assert!(world.cells.len() > 2);
        encode(&[StoredWorld::default(), world].map(|world| encode_world(&world)))
    }

    #[test]
    fn what_is_written_is_read() {
        let bytes = file();
        let worlds = decode(&bytes).unwrap();
        assert_eq!(worlds.len(), 2);
        let again: Vec<_> = worlds.iter().map(encode_world).collect();
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

    #[test]
    fn the_latest_worlds_are_kept_where_there_are_too_many() {
        let world = |number: u8| vec![number; 8];
        let all: Vec<Vec<u8>> = (0..100).map(world).collect();
        let bytes = encode(&all);
        let kept = parts(&bytes).unwrap();
        assert_eq!((kept.len(), kept[0], kept[63]), (64, &world(36)[..], &world(99)[..]));
    }

    #[test]
    fn what_another_copy_of_the_program_wrote_is_kept() {
        let folder = std::env::temp_dir().join(format!("afterglow-copies-{}", std::process::id()));
        let path = folder.join("worlds");
        let (memory, images) = remembered();
        let world = memory.stored(|image| images.get(image).map(|facts| facts.content()));
        let (mut first, mut second) = (world.clone(), world);
        first.cells.truncate(2);
        second.cells.truncate(3);
        let (first, second) = ([Arc::new(first)], [Arc::new(second)]);
        let known = write(&path, &first, &Known::new());
        write(&path, &second, &Known::new());
        assert_eq!(read(&path).0.len(), 2);
        // The first goes on: its own world is replaced, the other's stays.
        write(&path, &first, &known);
        let cells: Vec<usize> = read(&path).0.iter().map(|world| world.cells.len()).collect();
        assert_eq!(cells, [3, 2]);
        drop(std::fs::remove_dir_all(folder));
    }

    /// As if the hash were right: anything may come out, as long as it is sound.
    fn borne(payload: &[u8]) {
        let parts = parts_of(payload).unwrap_or_default();
        let mut memory = Memory::default();
        for world in worlds_of(&parts).unwrap_or_default() {
            memory.has_met(&world);
            for cell in &world.cells {
                memory.adopt(cell, &ImagesByContent::new());
            }
        }
    }

    proptest! {
        #[test]
        fn a_flipped_bit_is_found(at in 0.0..1.0_f64, bit in 0..8) {
            let mut bytes = file();
            let at = (at * bytes.len() as f64) as usize;
            bytes[at] ^= 1_u8 << bit;
            prop_assert!(decode(&bytes).is_none());
        }

        #[test]
        fn damage_that_no_hash_tells_of_is_borne(damage in prop::collection::vec((0.0..1.0_f64, any::<u8>()), 1..9)) {
            let mut payload = file().split_off(32);
            for (at, value) in damage {
                let at = (at * payload.len() as f64) as usize;
                payload[at] = value;
            }
            borne(&payload);
        }
    }
}
