//! The configuration file. It is looked at again while a program runs.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use toml::Table;

use crate::layers::Layer;

/// Bytes of a file, at most.
pub const MOST_BYTES: u64 = 1 << 16;
/// Characters of a message that say what is wrong with a file, at most.
const MOST_MESSAGE: usize = 300;

/// Why nothing is known from a file.
#[derive(Debug, thiserror::Error)]
pub enum ConfigError {
    /// It cannot be read.
    #[error("{path}: {source}")]
    Unreadable {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// It is larger than any configuration.
    #[error("{0}: more than {MOST_BYTES} bytes are no configuration")]
    TooLarge(PathBuf),
    /// It is not TOML; says where.
    #[error("{path}: {reason}")]
    Malformed {
        /// Which.
        path: PathBuf,
        /// What is wrong and where.
        reason: String,
    },
}

/// A file that need not be there.
#[derive(Debug, Clone)]
pub struct ConfigFile {
    path: PathBuf,
    /// What it was like when it was looked at last; none if there was none.
    stamp: Option<Stamp>,
}

/// What tells that a file is another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Stamp {
    modified: Option<SystemTime>,
    bytes: u64,
}

impl Stamp {
    fn of(path: &Path) -> Option<Stamp> {
        let known = fs::metadata(path).ok()?;
        Some(Stamp { modified: known.modified().ok(), bytes: known.len() })
    }
}

impl ConfigFile {
    /// The file that `AFTERGLOW_CONFIG` names (`none` for none), else `afterglow/config.toml` in the user's folder of
    /// configurations. `variable` asks the environment.
    pub fn find(variable: &dyn Fn(&str) -> Option<String>) -> Option<ConfigFile> {
        let set = |name: &str| variable(name).filter(|value| !value.is_empty());
        let path = match set("AFTERGLOW_CONFIG") {
            Some(none) if none == "none" => return None,
            Some(path) => PathBuf::from(path),
            None => {
                let named = set("XDG_CONFIG_HOME").map(PathBuf::from).filter(|folder| folder.is_absolute());
                named
                    .or_else(|| Some(PathBuf::from(set("HOME")?).join(".config")))?
                    .join("afterglow/config.toml")
            }
        };
        Some(ConfigFile::new(path))
    }

    /// A file by its path.
    pub fn new(path: PathBuf) -> ConfigFile {
        ConfigFile { path, stamp: None }
    }

    /// Where it is, or would be.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether it is another one than when it was read last. A look at the folder, no more.
    pub fn has_changed(&self) -> bool {
        Stamp::of(&self.path) != self.stamp
    }

    /// What it says. A file that is not there says nothing.
    ///
    /// # Errors
    /// If it cannot be read, is too large or no TOML.
    pub fn read(&mut self) -> Result<Layer, ConfigError> {
        // Taken before it is read: what is written meanwhile is seen at the next look.
        self.stamp = Stamp::of(&self.path);
        let unreadable = |source| ConfigError::Unreadable { path: self.path.clone(), source };
        // Before it is opened: to open a pipe could take for ever.
        match fs::metadata(&self.path) {
            Ok(known) if known.is_file() => {}
            Ok(_) => return Err(unreadable(io::Error::other("it is no file"))),
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Layer::default()),
            Err(error) => return Err(unreadable(error)),
        }
        let mut bytes = Vec::new();
        File::open(&self.path)
            .map_err(unreadable)?
            .take(MOST_BYTES + 1)
            .read_to_end(&mut bytes)
            .map_err(unreadable)?;
        if bytes.len() as u64 > MOST_BYTES {
            return Err(ConfigError::TooLarge(self.path.clone()));
        }
        self.parse(&bytes)
    }

    fn parse(&self, bytes: &[u8]) -> Result<Layer, ConfigError> {
        let malformed =
            |reason: String| ConfigError::Malformed { path: self.path.clone(), reason: one_line(&reason) };
        let text = std::str::from_utf8(bytes).map_err(|error| malformed(error.to_string()))?;
        let table: Table = toml::from_str(text).map_err(|error| malformed(error.to_string()))?;
        let folder = self.path.parent().map(Path::to_owned);
        Ok(Layer::new(&self.path.display().to_string(), folder, &table))
    }
}

/// A message of several lines as one.
fn one_line(message: &str) -> String {
    let words = message.split_whitespace().collect::<Vec<_>>().join(" ");
    words.chars().filter(|character| !character.is_control()).take(MOST_MESSAGE).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::{KEYS, Layers};

    /// The value of a key, from a file with this text.
    fn said(text: &str, key: &str) -> Result<Option<String>, ConfigError> {
        let none = |_: &str| None;
        let mut layers = Layers::new(&none);
        layers.push(ConfigFile::new("c.toml".into()).parse(text.as_bytes())?);
        Ok(layers.text(key))
    }

    #[test]
    fn the_file_is_where_it_is_said_or_in_the_usual_folder() {
        let find = |set: &[(&str, &str)]| {
            let variable =
                |name: &str| set.iter().find(|(key, _)| *key == name).map(|(_, value)| (*value).to_owned());
            ConfigFile::find(&variable).map(|file| file.path().to_owned())
        };
        assert_eq!(find(&[("AFTERGLOW_CONFIG", "a.toml"), ("HOME", "/h")]), Some("a.toml".into()));
        assert_eq!(find(&[("AFTERGLOW_CONFIG", "none"), ("HOME", "/h")]), None);
        let usual = find(&[("XDG_CONFIG_HOME", "/c"), ("HOME", "/h")]);
        assert_eq!(usual, Some("/c/afterglow/config.toml".into()));
        let home = find(&[("XDG_CONFIG_HOME", "c"), ("HOME", "/h")]);
        assert_eq!(home, Some("/h/.config/afterglow/config.toml".into()));
        assert_eq!(find(&[]), None);
    }

    #[test]
    fn changes_are_seen() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("config.toml");
        let mut file = ConfigFile::new(path.clone());
        assert!(file.read().unwrap().is_empty() && !file.has_changed());
        fs::write(&path, "spp = 4").unwrap();
        assert!(file.has_changed());
        assert!(!file.read().unwrap().is_empty() && !file.has_changed());
        fs::write(&path, "spp = 16").unwrap();
        assert!(file.has_changed() && file.read().is_ok());
        fs::write(&path, "spp = = 16").unwrap();
        let error = file.read().unwrap_err().to_string();
        assert!(error.contains("line 1") && !error.contains('\n'), "{error}");
        assert!(!file.has_changed());
        fs::remove_file(&path).unwrap();
        assert!(file.has_changed() && file.read().unwrap().is_empty());
    }

    #[test]
    fn what_is_no_small_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let unreadable = ConfigFile::new(folder.path().to_owned()).read();
        assert!(matches!(unreadable, Err(ConfigError::Unreadable { .. })), "{unreadable:?}");
        let path = folder.path().join("large.toml");
        fs::write(&path, vec![b'#'; MOST_BYTES as usize + 1]).unwrap();
        assert!(matches!(ConfigFile::new(path).read(), Err(ConfigError::TooLarge(_))));
        assert!(said("[".repeat(60_000).as_str(), "spp").is_err());
        assert!(said(&format!("spp = {}", "[".repeat(60_000)), "spp").is_err());
    }

    proptest! {
        #[test]
        fn nothing_panics(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
            let _ = ConfigFile::new("c.toml".into()).parse(&bytes);
        }

        #[test]
        fn nothing_that_looks_like_a_file_panics(
            text in r#"((mode|spp|keys|limit|x|\[keys\]|\[\[y\]\])( ?= ?(-?[0-9]{1,30}(\.[0-9]{0,3}e[0-9]{1,4})?|inf|nan|true|"[^"]{0,9}"|\{mode ?= ?"."\}|\[1, ?"a"\]|'''))?[\n ]){0,12}"#
        ) {
            let none = |_: &str| None;
            let mut layers = Layers::new(&none);
            if let Ok(layer) = ConfigFile::new("c.toml".into()).parse(text.as_bytes()) {
                layers.push(layer);
            }
            for key in KEYS {
                let _ = layers.get(key, |value| value.parse::<u32>().ok());
            }
            prop_assert!(layers.take_problems().len() <= 128);
        }

        #[test]
        fn numbers_come_through(number in any::<u32>()) {
            prop_assert_eq!(said(&format!("seed = {number}"), "seed").unwrap(), Some(number.to_string()));
        }
    }
}
