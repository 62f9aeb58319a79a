//! Which files are in the folder, and when they changed.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use hashbrown::HashMap;

use crate::name::FileName;

/// Files that are looked at, at most; of others nothing is known.
const MOST_FILES: usize = 1 << 17;
/// Endings of names, the one first that is taken if there are several files for the same.
const ENDINGS: [&str; 3] = ["ktx2", "dds", "png"];

/// Files for textures, by name.
#[derive(Debug, Default)]
pub(crate) struct Index {
    files: HashMap<FileName, (usize, PathBuf)>,
}

impl Index {
    /// Lists a folder, but not folders in it.
    pub(crate) fn of(folder: &Path) -> io::Result<Self> {
        let mut index = Self::default();
        for entry in fs::read_dir(folder)?.take(MOST_FILES) {
            index.add(entry?.path());
        }
        Ok(index)
    }

    /// The file of this name.
    pub(crate) fn get(&self, name: FileName) -> Option<&Path> {
        self.files.get(&name).map(|(_, path)| path.as_path())
    }

    fn add(&mut self, path: PathBuf) {
        let text = |part: Option<&std::ffi::OsStr>| part.and_then(|part| part.to_str()).map(str::to_owned);
        let (stem, ending) = (text(path.file_stem()), text(path.extension()));
        let name = stem.and_then(|stem| FileName::parse(&stem));
        let rank =
            ending.and_then(|ending| ENDINGS.iter().position(|known| ending.eq_ignore_ascii_case(known)));
        let Some((name, rank)) = name.zip(rank) else { return };
        let found = (rank, path);
        match self.files.get_mut(&name) {
            // The order in which a folder is listed is no one's choice: paths decide between names of different case.
            Some(known) if *known > found => *known = found,
            Some(_) => {}
            None => drop(self.files.insert(name, found)),
        }
    }
}

/// By what a changed file is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Stamp {
    modified: Option<SystemTime>,
    bytes: u64,
}

impl Stamp {
    /// None if the file cannot be asked.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let metadata = fs::metadata(path).ok()?;
        Some(Self { modified: metadata.modified().ok(), bytes: metadata.len() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::name::Role;

    #[test]
    fn files_are_found_by_name_and_the_best_is_taken() {
        let folder = tempfile::tempdir().unwrap();
        for file in [
            "0123456789abcdef.png",
            "0123456789ABCDEF.dds",
            "0123456789abcdef_normal.PNG",
            "0123456789abcdef_emission.txt",
            "notes.png",
        ] {
            fs::write(folder.path().join(file), "").unwrap();
        }
        let index = Index::of(folder.path()).unwrap();
        let ending = |role| {
            let path = index.get(FileName { hash: 0x0123_4567_89ab_cdef, role })?;
            Some(path.extension()?.to_str()?.to_owned())
        };
        assert_eq!(Role::ALL.map(ending), [Some("dds".into()), Some("PNG".into()), None]);
        assert!(Index::of(&folder.path().join("nowhere")).is_err());
    }
}
