//! ZIP archives as far as NumPy writes them: members stored or deflated, fewer than 65,535 of them, below 4 GiB.
//!
//! The directory at the archive's end says where members are and how large; nothing else is believed. Layout: PKWARE's
//! APPNOTE 6.3.10, sections 4.3.7, 4.3.12 and 4.3.16.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use flate2::Crc;
use flate2::read::DeflateDecoder;

use crate::error::NpyError;

const END_SIGNATURE: [u8; 4] = *b"PK\x05\x06";
const ENTRY_SIGNATURE: [u8; 4] = *b"PK\x01\x02";
const LOCAL_SIGNATURE: [u8; 4] = *b"PK\x03\x04";
const END_BYTES: usize = 22;
const ENTRY_BYTES: usize = 46;
const LOCAL_BYTES: usize = 30;
/// Longest comment after the end of an archive.
const MOST_COMMENT: usize = 65_535;

const STORED: u16 = 0;
const DEFLATED: u16 = 8;
const ENCRYPTED: u16 = 1;

/// An archive in memory.
#[derive(Debug)]
pub struct Archive {
    bytes: Vec<u8>,
    members: Vec<Member>,
    most_bytes: u64,
}

#[derive(Debug)]
struct Member {
    name: String,
    flags: u16,
    method: u16,
    crc: u32,
    compressed: usize,
    size: u64,
    local: usize,
}

impl Archive {
    /// Reads an archive of at most `most_bytes`; neither will a member be larger.
    ///
    /// # Errors
    /// If the file cannot be read, is too large, or no archive.
    pub fn open(path: &Path, most_bytes: u64) -> Result<Self, NpyError> {
        let mut bytes = Vec::new();
        File::open(path)?.take(most_bytes.saturating_add(1)).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > most_bytes {
            return Err(NpyError::TooLarge {
                name: "the archive".into(),
                bytes: bytes.len() as u64,
                most: most_bytes,
            });
        }
        Self::parse(bytes, most_bytes)
    }

    /// The archive that a file's bytes are.
    ///
    /// # Errors
    /// If they are none.
    pub fn parse(bytes: Vec<u8>, most_bytes: u64) -> Result<Self, NpyError> {
        let members = directory(&bytes)?;
        Ok(Self { bytes, members, most_bytes })
    }

    /// Names of the arrays.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.members.iter().filter_map(|member| member.name.strip_suffix(".npy"))
    }

    /// The `.npy` file of an array.
    ///
    /// # Errors
    /// If there is none of this name, it is damaged, or too large.
    pub fn file(&self, name: &str) -> Result<Vec<u8>, NpyError> {
        let of_name = |member: &&Member| member.name.strip_suffix(".npy") == Some(name);
        let member = self.members.iter().find(of_name).ok_or_else(|| NpyError::Absent(name.into()))?;
        let refused = |reason| NpyError::Member { name: member.name.clone(), reason };
        if member.size > self.most_bytes {
            return Err(NpyError::TooLarge {
                name: member.name.clone(),
                bytes: member.size,
                most: self.most_bytes,
            });
        }
        if member.flags & ENCRYPTED != 0 {
            return Err(refused("it is encrypted"));
        }
        let stored = self.stored(member).ok_or_else(|| refused("it reaches beyond the archive"))?;
        let mut file = Vec::new();
        match member.method {
            STORED => file.extend_from_slice(stored),
            // One byte more than it should be, to notice if there is more.
            DEFLATED => {
                let inflated = DeflateDecoder::new(stored).take(member.size + 1).read_to_end(&mut file);
                inflated.map_err(|_| refused("it cannot be inflated"))?;
            }
            _ => return Err(refused("its compression is unknown")),
        }
        let mut crc = Crc::new();
        crc.update(&file);
        match file.len() as u64 == member.size && crc.sum() == member.crc {
            true => Ok(file),
            false => Err(refused("it is not what the directory says")),
        }
    }

    /// A member's bytes as they are in the archive.
    fn stored(&self, member: &Member) -> Option<&[u8]> {
        let local = self.bytes.get(member.local..)?;
        if local.get(..4)? != LOCAL_SIGNATURE {
            return None;
        }
        let names = usize::from(u16_at(local, 26)?) + usize::from(u16_at(local, 28)?);
        local.get(LOCAL_BYTES + names..)?.get(..member.compressed)
    }
}

fn directory(bytes: &[u8]) -> Result<Vec<Member>, NpyError> {
    let earliest = bytes.len().saturating_sub(END_BYTES + MOST_COMMENT);
    let ends = bytes[earliest..].windows(END_BYTES);
    let end = ends.rev().find(|end| end.starts_with(&END_SIGNATURE));
    let end = end.ok_or(NpyError::Archive("it has no end"))?;
    let damaged = NpyError::Archive("its directory is not where it should be");
    let fields = || Some((u16_at(end, 10)?, u32_at(end, 12)? as usize, u32_at(end, 16)? as usize));
    let Some((count, size, first)) = fields() else { return Err(damaged) };
    let entries = bytes.get(first..).and_then(|rest| rest.get(..size));
    let Some(mut entries) = entries else { return Err(damaged) };
    let mut members = Vec::new();
    for _ in 0..count {
        let (member, length) = entry(entries).ok_or(NpyError::Archive("an entry of its directory"))?;
        members.push(member);
        entries = entries.get(length..).unwrap_or_default();
    }
    Ok(members)
}

/// An entry of the directory, and how long it is.
fn entry(bytes: &[u8]) -> Option<(Member, usize)> {
    if bytes.get(..4)? != ENTRY_SIGNATURE {
        return None;
    }
    let length = |offset| u16_at(bytes, offset).map(usize::from);
    let name = bytes.get(ENTRY_BYTES..)?.get(..length(28)?)?;
    let member = Member {
        name: String::from_utf8_lossy(name).into_owned(),
        flags: u16_at(bytes, 8)?,
        method: u16_at(bytes, 10)?,
        crc: u32_at(bytes, 16)?,
        compressed: u32_at(bytes, 20)? as usize,
        size: u32_at(bytes, 24)?.into(),
        local: u32_at(bytes, 42)? as usize,
    };
    Some((member, ENTRY_BYTES + length(28)? + length(30)? + length(32)?))
}

fn u16_at(bytes: &[u8], offset: usize) -> Option<u16> {
    Some(u16::from_le_bytes(*bytes.get(offset..)?.first_chunk()?))
}

fn u32_at(bytes: &[u8], offset: usize) -> Option<u32> {
    Some(u32::from_le_bytes(*bytes.get(offset..)?.first_chunk()?))
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use flate2::Compression;
    use flate2::write::DeflateEncoder;
    use proptest::prelude::*;

    use super::*;

    /// An archive as NumPy writes it; every second member is only stored.
    fn archive(members: &[(&str, &[u8])]) -> Vec<u8> {
        let (mut bytes, mut directory) = (Vec::new(), Vec::new());
        for (index, (name, file)) in members.iter().enumerate() {
            let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
            encoder.write_all(file).unwrap();
            let (method, data) = match index % 2 {
                0 => (DEFLATED, encoder.finish().unwrap()),
                _ => (STORED, file.to_vec()),
            };
            let mut crc = Crc::new();
            crc.update(file);
            let mut common = Vec::new();
            common.extend([0u16, method, 0, 0].iter().flat_map(|word| word.to_le_bytes()));
            let numbers = [crc.sum(), data.len() as u32, file.len() as u32];
            common.extend(numbers.iter().flat_map(|word| word.to_le_bytes()));
            common.extend((name.len() as u16).to_le_bytes());
            let local = bytes.len() as u32;
            bytes.extend(LOCAL_SIGNATURE);
            bytes.extend([20, 0]);
            bytes.extend(&common);
            bytes.extend(4u16.to_le_bytes());
            bytes.extend(name.bytes().chain(*b"more"));
            bytes.extend(&data);
            directory.extend(ENTRY_SIGNATURE);
            directory.extend([20, 3, 20, 0]);
            directory.extend(&common);
            directory.extend([0; 12]);
            directory.extend(local.to_le_bytes());
            directory.extend(name.bytes());
        }
        let (first, count) = (bytes.len() as u32, members.len() as u16);
        bytes.extend(&directory);
        bytes.extend(END_SIGNATURE);
        bytes.extend([0; 4]);
        bytes.extend([count, count].iter().flat_map(|count| count.to_le_bytes()));
        bytes.extend([directory.len() as u32, first].iter().flat_map(|word| word.to_le_bytes()));
        bytes.extend([0; 2]);
        bytes
    }

    fn sample() -> Vec<u8> {
        archive(&[("a.npy", &[7; 1000]), ("b.npy", b"bytes"), ("note.txt", b"")])
    }

    #[test]
    fn members_are_found_by_name() {
        let archive = Archive::parse(sample(), 1 << 20).unwrap();
        assert_eq!(archive.names().collect::<Vec<_>>(), ["a", "b"]);
        assert_eq!(archive.file("a").unwrap(), [7; 1000]);
        assert_eq!(archive.file("b").unwrap(), b"bytes");
        assert!(matches!(archive.file("c"), Err(NpyError::Absent(_))));
    }

    #[test]
    fn a_member_larger_than_allowed_or_than_it_says_is_refused() {
        let archive = Archive::parse(sample(), 999).unwrap();
        assert!(matches!(archive.file("a"), Err(NpyError::TooLarge { bytes: 1000, .. })));
        let mut bytes = sample();
        // The size in the directory's first entry.
        let entry = bytes.windows(4).position(|start| start == ENTRY_SIGNATURE).unwrap();
        bytes[entry + 24..entry + 28].copy_from_slice(&10u32.to_le_bytes());
        let archive = Archive::parse(bytes, 1 << 20).unwrap();
        assert!(archive.file("a").unwrap_err().to_string().contains("directory"));
    }

    proptest! {
        #[test]
        fn damage_is_an_error_or_the_same_file(place in 0usize..400, flip in 1u8.., end in 0usize..400) {
            let mut bytes = sample();
            let place = place % bytes.len();
            bytes[place] ^= flip;
            bytes.truncate(bytes.len() - end.saturating_sub(350).min(bytes.len()));
            if let Ok(archive) = Archive::parse(bytes, 1 << 20)
                && let Ok(file) = archive.file("a")
            {
                prop_assert_eq!(file, vec![7; 1000]);
            }
        }

        #[test]
        fn noise_is_never_a_panic(noise: Vec<u8>) {
            let mut bytes = noise;
            bytes.extend(&sample()[sample().len() - END_BYTES..]);
            let _ = Archive::parse(bytes, 1 << 20).map(|archive| archive.file("a"));
        }
    }
}
