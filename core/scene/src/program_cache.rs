//! Files that bring what was found of a program through to its next run.
//!
//! All of them can be lost without harm. They are written beside their place and renamed, so that whoever reads them
//! at the same time, another copy of the program among them, finds the whole of one or the other.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, SystemTime};

use xxhash_rust::xxh3::xxh3_64;

/// Characters of a program's name that its files are named by.
const NAME_LENGTH: usize = 48;
/// Ends the names of files that are being written.
const UNFINISHED: &str = "new";
/// Files that are being written for longer are left over from a process that died.
const LEFT_OVER: Duration = Duration::from_secs(3600);

/// Where a program's files are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProgramCache {
    /// The file of its worlds.
    pub(crate) worlds: PathBuf,
    /// The folder of recovered light sources; they are found by what is lit, whichever program it is of.
    pub(crate) lights: PathBuf,
}

impl ProgramCache {
    /// The files of a program, known by its path, in a folder. Nothing is made there yet.
    pub fn new(folder: &Path, program: &Path) -> ProgramCache {
        let name = program.file_name().unwrap_or_default().to_string_lossy();
        let is_plain = |c: &char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
        let plain: String = name.chars().filter(is_plain).take(NAME_LENGTH).collect();
        let hash = xxh3_64(program.as_os_str().as_encoded_bytes());
        ProgramCache {
            worlds: folder.join("worlds").join(format!("{plain}-{hash:016x}")),
            lights: folder.join("lights"),
        }
    }
}

/// A file's bytes; none if it is not there.
///
/// # Errors
/// If it cannot be read, is no plain file, or has more than `most` bytes.
pub(crate) fn read(path: &Path, most: u64) -> io::Result<Option<Vec<u8>>> {
    // Opening a pipe would wait for somebody to write to it.
    match fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
        Ok(metadata) if !metadata.is_file() => return Err(io::ErrorKind::InvalidInput.into()),
        Ok(metadata) if metadata.len() > most => return Err(io::ErrorKind::FileTooLarge.into()),
        Ok(_) => {}
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(most).read_to_end(&mut bytes)?;
    Ok(Some(bytes))
}

/// Writes a file in place of what was there, and makes its folder if need be. All files of the folder have at most
/// `most` bytes then: the oldest leave.
///
/// # Errors
/// If it cannot be written; what was there is still there then.
pub(crate) fn write(path: &Path, bytes: &[u8], most: u64) -> io::Result<()> {
    static WRITTEN: AtomicU32 = AtomicU32::new(0);
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let (process, number) = (std::process::id(), WRITTEN.fetch_add(1, Ordering::Relaxed));
    let beside = path.with_extension(format!("{process}-{number}.{UNFINISHED}"));
    let written = File::create_new(&beside).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    written.and_then(|()| fs::rename(&beside, path)).inspect_err(|_| drop(fs::remove_file(&beside)))?;
    prune(folder, path, most);
    Ok(())
}

/// Removes the oldest files of a folder but `kept`, until all have at most `most` bytes, and what is left over.
fn prune(folder: &Path, kept: &Path, most: u64) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let now = SystemTime::now();
    let mut bytes = 0;
    let mut files = Vec::new();
    for entry in entries.flatten() {
        let (path, Ok(metadata)) = (entry.path(), entry.metadata()) else { continue };
        if !metadata.is_file() {
            continue;
        }
        let written = metadata.modified().unwrap_or(SystemTime::UNIX_EPOCH);
        let age = now.duration_since(written).unwrap_or_default();
        if path.extension().is_some_and(|extension| extension == UNFINISHED) {
            if age > LEFT_OVER {
                drop(fs::remove_file(path));
            }
            continue;
        }
        bytes += metadata.len();
        files.push((written, path, metadata.len()));
    }
    files.sort();
    for (_, path, length) in files.into_iter().filter(|(_, path, _)| path != kept) {
        if bytes <= most {
            break;
        }
        // Another process may have done so.
        drop(fs::remove_file(path));
        bytes -= length;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("afterglow-cache-{name}-{}", std::process::id()));
        drop(fs::remove_dir_all(&folder));
        folder
    }

    #[test]
    fn programs_of_one_name_have_files_of_their_own() {
        let of = |program: &str| ProgramCache::new(Path::new("/c"), Path::new(program)).worlds;
        assert_ne!(of("/a/game"), of("/b/game"));
        assert_eq!(of("/a/game"), of("/a/game"));
        for odd in ["", "/", "..", "/a/../..", "/a/b c/\u{1f3ae}", "/\0", &"x".repeat(5000)] {
            let path = of(odd);
            assert_eq!(path.parent(), Some(Path::new("/c/worlds")), "{odd}");
            assert!(path.as_os_str().len() < 100);
        }
    }

    #[test]
    fn what_was_written_is_read_and_the_oldest_leave() {
        let folder = folder("oldest");
        assert!(read(&folder.join("a"), 10).unwrap().is_none());
        for name in ["a", "b", "c"] {
            write(&folder.join(name), &[7; 10], 25).unwrap();
            std::thread::sleep(Duration::from_millis(20));
        }
        assert!(read(&folder.join("a"), 10).unwrap().is_none());
        assert_eq!(read(&folder.join("b"), 10).unwrap(), Some(vec![7; 10]));
        assert_eq!(read(&folder.join("c"), 10).unwrap(), Some(vec![7; 10]));
        assert!(read(&folder.join("c"), 9).is_err() && read(&folder, 9).is_err());
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 2);
        drop(fs::remove_dir_all(folder));
    }

    #[test]
    fn writers_at_once_leave_one_whole_file() {
        let folder = folder("at-once");
        let path = folder.join("file");
        std::thread::scope(|scope| {
            for writer in 0..4_u8 {
                let path = &path;
                scope.spawn(move || {
                    for _ in 0..20 {
                        write(path, &[writer; 5000], 1 << 20).unwrap();
                        let read = read(path, 1 << 20).unwrap().unwrap();
                        assert!(read.len() == 5000 && read.iter().all(|byte| *byte == read[0]));
                    }
                });
            }
        });
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        drop(fs::remove_dir_all(folder));
    }

    #[test]
    fn a_place_that_cannot_be_written_is_an_error() {
        let folder = folder("file");
        fs::write(&folder, b"no folder").unwrap();
        assert!(write(&folder.join("a"), &[1], 10).is_err());
        assert!(read(&folder.join("a"), 10).is_err());
        drop(fs::remove_file(folder));
    }
}
