//! A profile's text taken apart. Whatever is not understood is an error that says where; nothing is guessed.

use std::collections::HashSet;
use std::fmt::Display;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex, PoisonError};

use glam::Vec3;
use serde::{Deserialize, Deserializer, de};

use super::rules::{Hash, MOST_LIGHTS, MOST_RULES, MOST_TEXTURES, Profile, Reason, Rule};

/// Bytes of a profile, at most.
pub const MOST_BYTES: u64 = 1 << 20;
/// Bytes of a name or a reason, at most.
const MOST_TEXT: usize = 120;
/// Numbers are no greater than this, either way.
const GREATEST: f64 = 1e9;

/// Why there is no profile.
#[derive(Debug, thiserror::Error)]
pub enum ProfileError {
    /// The file cannot be read.
    #[error("{path}: {source}")]
    Unreadable {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file is larger than any profile.
    #[error("{0}: more than {MOST_BYTES} bytes are no profile")]
    TooLarge(PathBuf),
    /// The text is no profile; says in which line, and shows it.
    #[error("{name}: {reason}")]
    Malformed {
        /// Of the file.
        name: String,
        /// What is wrong and where.
        reason: String,
    },
}

impl Profile {
    /// Reads a file.
    ///
    /// # Errors
    /// If it cannot be read, is too large or no profile.
    pub fn read(path: &Path) -> Result<Profile, ProfileError> {
        let unreadable = |source| ProfileError::Unreadable { path: path.into(), source };
        let file = File::open(path).map_err(unreadable)?;
        let mut bytes = Vec::new();
        file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
        if bytes.len() as u64 > MOST_BYTES {
            return Err(ProfileError::TooLarge(path.into()));
        }
        let text = std::str::from_utf8(&bytes).map_err(|error| malformed(path.display(), error))?;
        let mut profile = Profile::parse(&path.display().to_string(), text)?;
        if let (Some(images), Some(folder)) = (&mut profile.images, path.parent()) {
            *images = folder.join(&*images);
        }
        Ok(profile)
    }

    /// Reads a text; `name` is for messages.
    ///
    /// # Errors
    /// If it is too large or no profile.
    pub fn parse(name: &str, text: &str) -> Result<Profile, ProfileError> {
        if text.len() as u64 > MOST_BYTES {
            return Err(ProfileError::TooLarge(name.into()));
        }
        let profile: Profile = toml::from_str(text).map_err(|error| malformed(name, error))?;
        profile.check().map_err(|reason| malformed(name, reason))?;
        Ok(profile)
    }

    /// What no single value tells.
    fn check(&self) -> Result<(), String> {
        let conditions =
            self.class.iter().map(Rule::condition).chain(self.camera.iter().map(Rule::condition));
        let rules = self.class.len() + self.camera.len();
        let textures: usize = conditions.clone().map(|c| c.textures.as_ref().map_or(0, Vec::len)).sum();
        match () {
            () if rules > MOST_RULES => Err(format!("{rules} rules, {MOST_RULES} at most")),
            () if self.light.len() > MOST_LIGHTS => {
                Err(format!("{} lights, {MOST_LIGHTS} at most", self.light.len()))
            }
            () if textures + self.sky.textures.len() > MOST_TEXTURES => {
                Err(format!("{textures} textures, {MOST_TEXTURES} at most"))
            }
            () => match conditions.clone().position(|condition| condition.is_empty()) {
                Some(rule) => {
                    Err(format!("rule {} has nothing in `when`: it would hold for all draws", rule + 1))
                }
                None => Ok(()),
            },
        }
    }
}

fn malformed(name: impl Display, reason: impl Display) -> ProfileError {
    ProfileError::Malformed { name: name.to_string(), reason: reason.to_string().trim_end().to_owned() }
}

/// Sixteen hexadecimal digits.
impl<'de> Deserialize<'de> for Hash {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Hash, D::Error> {
        let text = String::deserialize(deserializer)?;
        let is_hash = text.len() == 16 && text.bytes().all(|digit| digit.is_ascii_hexdigit());
        let number = u64::from_str_radix(&text, 16).ok().filter(|_| is_hash);
        number.map(Hash).ok_or_else(|| de::Error::custom("a hash has 16 hexadecimal digits"))
    }
}

/// Equal texts are kept once, and a profile's are bounded as its rules are.
impl<'de> Deserialize<'de> for Reason {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Reason, D::Error> {
        static KNOWN: LazyLock<Mutex<HashSet<&'static str>>> = LazyLock::new(Mutex::default);
        let text = text(deserializer)?;
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = known.get(text.as_str()) {
            return Ok(Reason(found));
        }
        let kept: &'static str = text.leak();
        known.insert(kept);
        Ok(Reason(kept))
    }
}

/// A number that one can reckon with.
pub(super) fn number<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f32, D::Error> {
    sound(f64::deserialize(deserializer)?)
}

/// As [`number`], greater than zero.
pub(super) fn positive<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f32>, D::Error> {
    match number(deserializer)? {
        value if value > 0.0 => Ok(Some(value)),
        _ => Err(de::Error::custom("must be greater than zero")),
    }
}

/// As [`number`], for a bound.
pub(super) fn bound<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    number(deserializer).map(|value| Some(value.into()))
}

/// Three numbers.
pub(super) fn vector<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec3, D::Error> {
    let [x, y, z] = <[f64; 3]>::deserialize(deserializer)?;
    Ok(Vec3::new(sound(x)?, sound(y)?, sound(z)?))
}

/// Three numbers that are not all zero, made one long.
pub(super) fn direction<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec3, D::Error> {
    vector(deserializer)?.try_normalize().ok_or_else(|| de::Error::custom("no direction"))
}

/// Linear red, green, blue, none below zero.
pub(super) fn color<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec3, D::Error> {
    match vector(deserializer)? {
        color if color.min_element() >= 0.0 => Ok(color),
        _ => Err(de::Error::custom("no colour is below zero")),
    }
}

/// As [`color`].
pub(super) fn some_color<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Vec3>, D::Error> {
    color(deserializer).map(Some)
}

/// A name.
pub(super) fn text<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    short(String::deserialize(deserializer)?)
}

/// Names.
pub(super) fn texts<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<String>, D::Error> {
    Vec::deserialize(deserializer)?.into_iter().map(short).collect()
}

fn sound<E: de::Error>(value: f64) -> Result<f32, E> {
    // Written so that what is not a number fails.
    match value.abs() <= GREATEST {
        true => Ok(value as f32),
        false => Err(E::custom(format!("{value} is no number between -{GREATEST:e} and {GREATEST:e}"))),
    }
}

fn short<E: de::Error>(text: String) -> Result<String, E> {
    match text.len() <= MOST_TEXT && !text.contains(char::is_control) {
        true => Ok(text),
        false => Err(E::custom(format!("a text of more than {MOST_TEXT} bytes, or with control characters"))),
    }
}
