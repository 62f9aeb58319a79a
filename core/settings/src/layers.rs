//! Places that options come from, one over the other.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::PathBuf;

use toml::{Table, Value};

use crate::keys::{TABLE, is_key, variable};

/// Lines that are kept of what is wrong, at most.
const MOST_PROBLEMS: usize = 64;
/// Characters of a name or value that a line shows, at most.
const MOST_SHOWN: usize = 60;

/// What one place says: values by key, as they would stand in the environment.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Layer {
    name: String,
    /// What relative paths start from.
    folder: Option<PathBuf>,
    values: BTreeMap<String, String>,
    problems: Vec<String>,
}

impl Layer {
    /// What a table says; `name` is what lines of the log call it, and relative paths start from `folder`.
    pub fn new(name: &str, folder: Option<PathBuf>, table: &Table) -> Layer {
        let mut layer = Layer { name: name.to_owned(), folder, ..Layer::default() };
        for (key, value) in table {
            match value {
                Value::Table(inner) if key == TABLE => {
                    inner.iter().for_each(|(key, value)| layer.insert(&format!("{TABLE}_{key}"), value));
                }
                value => layer.insert(key, value),
            }
        }
        layer
    }

    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    fn insert(&mut self, key: &str, value: &Value) {
        let problem = match (is_key(key), text(value)) {
            (true, Some(text)) => {
                self.values.insert(key.to_owned(), text);
                return;
            }
            (true, None) => format!("{}: {key} cannot have such a value", self.name),
            (false, _) => format!("{}: there is no option {}", self.name, shown(key)),
        };
        if self.problems.len() < MOST_PROBLEMS {
            self.problems.push(problem);
        }
    }
}

/// A value as it would stand in the environment; a list's are parted by commas.
fn text(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Integer(number) => Some(number.to_string()),
        Value::Float(number) => Some(number.to_string()),
        Value::Boolean(flag) => Some(flag.to_string()),
        Value::Array(values) => {
            let is_plain = |value: &&Value| !matches!(value, Value::Array(_));
            let texts: Option<Vec<_>> =
                values.iter().map(|v| Some(v).filter(is_plain).and_then(text)).collect();
            texts.map(|texts| texts.join(","))
        }
        Value::Datetime(_) | Value::Table(_) => None,
    }
}

/// Quoted, without what a terminal would take for something else, and not too long.
fn shown(text: &str) -> String {
    format!("{:?}", text.chars().take(MOST_SHOWN).collect::<String>())
}

/// The environment, and what is below it.
pub struct Layers<'a> {
    environment: &'a dyn Fn(&str) -> Option<String>,
    /// The highest first.
    below: Vec<Layer>,
    problems: RefCell<Vec<String>>,
}

impl<'a> Layers<'a> {
    /// An environment, given by how its variables are asked for, and nothing below it.
    pub fn new(environment: &'a dyn Fn(&str) -> Option<String>) -> Layers<'a> {
        Layers { environment, below: Vec::new(), problems: RefCell::default() }
    }

    /// Puts another place below all others.
    pub fn push(&mut self, mut layer: Layer) {
        self.problems.get_mut().append(&mut layer.problems);
        self.below.push(layer);
    }

    /// What the highest place says that says something which `parse` understands. What it does not understand counts
    /// as absent.
    pub fn get<T>(&self, key: &str, parse: impl Fn(&str) -> Option<T>) -> Option<T> {
        debug_assert!(is_key(key), "{key} is not among the keys");
        let name = variable(key);
        if let Some(value) = (self.environment)(&name).filter(|value| !value.is_empty()) {
            match parse(&value) {
                None => self.note(format!("{name}: {} is not understood", shown(&value))),
                understood => return understood,
            }
        }
        for layer in &self.below {
            if let Some(value) = layer.values.get(key).filter(|value| !value.is_empty()) {
                match parse(value) {
                    None => self.note(format!("{}: {key}: {} is not understood", layer.name, shown(value))),
                    understood => return understood,
                }
            }
        }
        None
    }

    /// The text that the highest place has.
    pub fn text(&self, key: &str) -> Option<String> {
        self.get(key, |value| Some(value.to_owned()))
    }

    /// A file or folder: a relative one of a file starts from the file's folder.
    pub fn path(&self, key: &str) -> Option<PathBuf> {
        if let Some(value) = (self.environment)(&variable(key)).filter(|value| !value.is_empty()) {
            return Some(value.into());
        }
        let says = |layer: &Layer| {
            let value = layer.values.get(key).filter(|value| !value.is_empty())?;
            Some(layer.folder.as_ref().map_or_else(|| value.into(), |folder| folder.join(value)))
        };
        self.below.iter().find_map(says)
    }

    /// Lines to be logged of what was not understood since it was asked last.
    pub fn take_problems(&self) -> Vec<String> {
        std::mem::take(&mut *self.problems.borrow_mut())
    }

    fn note(&self, problem: String) {
        let mut problems = self.problems.borrow_mut();
        if problems.len() < 2 * MOST_PROBLEMS && !problems.contains(&problem) {
            problems.push(problem);
        }
    }
}

/// Yes or no, as options have it.
pub fn flag(value: &str) -> Option<bool> {
    match value.to_ascii_lowercase().as_str() {
        "1" | "true" | "yes" | "on" => Some(true),
        "0" | "false" | "no" | "off" => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layer(name: &str, text: &str) -> Layer {
        Layer::new(name, Some("/etc/games".into()), &text.parse().unwrap())
    }

    fn number(value: &str) -> Option<u32> {
        value.parse().ok()
    }

    #[test]
    fn the_higher_place_decides_and_what_is_wrong_counts_as_absent() {
        let environment = |name: &str| match name {
            "AFTERGLOW_SPP" => Some("many".to_owned()),
            "AFTERGLOW_SEED" => Some("7".to_owned()),
            "AFTERGLOW_HUD" => Some(String::new()),
            _ => None,
        };
        let mut layers = Layers::new(&environment);
        layers.push(layer("config", "spp = -1\nseed = 3\nhud = true\nlimit = inf\nscreenshots = 'shots'"));
        layers.push(layer("profile", "spp = 5\nhud = false\ndebug_lose_device = [3, 9]\nscreenshots = '/x'"));
        assert_eq!(layers.get("spp", number), Some(5));
        assert_eq!(layers.get("seed", number), Some(7));
        assert_eq!(layers.get("hud", flag), Some(true));
        assert_eq!(layers.get("limit", |value| value.parse().ok()), Some(f32::INFINITY));
        assert_eq!(layers.text("debug_lose_device").as_deref(), Some("3,9"));
        assert_eq!(layers.path("screenshots"), Some("/etc/games/shots".into()));
        assert_eq!(layers.text("mode"), None);
        let problems = layers.take_problems();
        assert_eq!(
            problems,
            ["AFTERGLOW_SPP: \"many\" is not understood", "config: spp: \"-1\" is not understood"]
        );
        assert!(layers.take_problems().is_empty());
    }

    #[test]
    fn what_is_no_option_is_told_and_left_out() {
        let none = |_: &str| None;
        let mut layers = Layers::new(&none);
        layers.push(layer(
            "config",
            "smp = 4\nmode = {}\nspp = [[1]]\nseed = 1979-05-27\n[keys]\nmode = 'F9'\nx = 1\n[hud]",
        ));
        assert_eq!(layers.text("keys_mode").as_deref(), Some("F9"));
        let problems = layers.take_problems();
        assert_eq!(problems.len(), 6, "{problems:?}");
        assert!(problems.contains(&"config: there is no option \"smp\"".to_owned()));
        assert!(problems.contains(&"config: there is no option \"keys_x\"".to_owned()));
        assert!(problems.contains(&"config: hud cannot have such a value".to_owned()));
    }

    #[test]
    fn keys_may_be_a_flag() {
        let none = |_: &str| None;
        let mut layers = Layers::new(&none);
        layers.push(layer("config", "keys = false"));
        assert_eq!(layers.get("keys", flag), Some(false));
    }
}
