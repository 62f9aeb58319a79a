//! Reading the registry's XML.

use std::fs;
use std::path::{Path, PathBuf};

use roxmltree::{Document, Node};

use super::{Api, CType, Command, Enumerant, Length, Model, Param};

/// Why the model could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    /// A file could not be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file is no XML.
    #[error("{file}: {source}")]
    Xml {
        /// Which.
        file: &'static str,
        /// Why.
        source: roxmltree::Error,
    },
    /// A file of rules is not what it must be.
    #[error("{file}: {reason}")]
    Rules {
        /// Which.
        file: &'static str,
        /// Why.
        reason: String,
    },
}

const FILES: [(&str, Api, &str); 4] = [
    ("manifests/khronos/gl.xml", Api::Gl, "gl"),
    ("manifests/khronos/glx.xml", Api::Glx, "glx"),
    ("manifests/khronos/wgl.xml", Api::Wgl, "wgl"),
    ("manifests/afterglow.xml", Api::Gl, "gl"),
];

/// Texts of the pinned files.
pub struct Sources {
    texts: Vec<String>,
}

impl Sources {
    /// Reads the files of the repository at `root`.
    ///
    /// # Errors
    /// Those of reading.
    pub fn load(root: impl AsRef<Path>) -> Result<Sources, ModelError> {
        let text = |(file, _, _): &(&'static str, Api, &str)| read(root.as_ref(), file);
        Ok(Sources { texts: FILES.iter().map(text).collect::<Result<_, _>>()? })
    }

    /// Parses them.
    ///
    /// # Errors
    /// Where a file is no XML.
    pub fn model(&self) -> Result<Model, ModelError> {
        let mut model = Model::default();
        for ((file, api, feature_api), text) in FILES.into_iter().zip(&self.texts) {
            let document = Document::parse(text).map_err(|source| ModelError::Xml { file, source })?;
            let registry = document.root_element();
            commands(registry, api, &mut model);
            enumerants(registry, &mut model);
            origins(registry, feature_api, &mut model);
        }
        Ok(model)
    }
}

/// The text of a file of the repository, without a byte order mark.
///
/// # Errors
/// Those of the file system.
pub fn read(root: &Path, file: &str) -> Result<String, ModelError> {
    let path = root.join(file);
    match fs::read_to_string(&path) {
        Ok(text) => Ok(text.trim_start_matches('\u{feff}').to_owned()),
        Err(source) => Err(ModelError::Read { path, source }),
    }
}

fn elements<'a>(node: Node<'a, 'a>, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |child| child.has_tag_name(name))
}

fn commands(registry: Node, api: Api, model: &mut Model) {
    for node in elements(registry, "commands").flat_map(|commands| elements(commands, "command")) {
        if let Some(command) = command(node, api) {
            model.commands.entry(command.name.clone()).or_insert(command);
        }
    }
}

fn command(node: Node, api: Api) -> Option<Command> {
    let (name, result) = declaration(elements(node, "proto").next()?)?;
    let declared: Vec<_> = elements(node, "param")
        .filter_map(|param| declaration(param).map(|(name, ctype)| (param, name, ctype)))
        .collect();
    let position = |wanted: &str| declared.iter().position(|(_, name, _)| name == wanted).map(|i| i as u8);
    let params = declared
        .iter()
        .map(|(param, name, ctype)| Param {
            name: name.clone(),
            ctype: *ctype,
            length: Length::parse(param.attribute("len").unwrap_or_default(), position),
            group: param.attribute("group").unwrap_or_default().into(),
        })
        .collect();
    let alias = elements(node, "alias").next().and_then(|alias| alias.attribute("name"));
    Some(Command { name, api, result, params, alias: alias.map(Into::into), origins: Vec::new() })
}

/// The declared name, and the type around it.
fn declaration(node: Node) -> Option<(String, CType)> {
    let name = elements(node, "name").next()?;
    let text = |node: Node| node.text().unwrap_or_default().to_owned();
    let ctype: String = node
        .children()
        .filter(|child| *child != name)
        .map(|child| if child.is_element() { text(child) + " " } else { text(child) })
        .collect();
    Some((text(name), CType::parse(&ctype)))
}

fn enumerants(registry: Node, model: &mut Model) {
    for block in elements(registry, "enums") {
        let bitmask = block.attribute("type") == Some("bitmask");
        for node in elements(block, "enum") {
            let (Some(name), Some(value)) = (node.attribute("name"), node.attribute("value")) else {
                continue;
            };
            // Another API's enumerant of the same name: the first one is OpenGL's.
            let wanted = node.attribute("api").is_none_or(|api| api == "gl");
            let Some(value) = number(value).filter(|_| wanted) else {
                continue;
            };
            let groups = node.attribute("group").or(block.attribute("group")).unwrap_or_default();
            model.enumerants.entry(name.into()).or_insert_with(|| Enumerant {
                name: name.into(),
                value,
                groups: groups.split(',').filter(|g| !g.is_empty()).map(Into::into).collect(),
                bitmask,
                origins: Vec::new(),
            });
        }
    }
}

/// A number of 32 bits, hexadecimal or decimal; a negative one wraps.
fn number(text: &str) -> Option<u32> {
    match text.strip_prefix("0x") {
        Some(digits) => u32::from_str_radix(digits, 16).ok(),
        None => text.parse::<i64>().ok().and_then(|value| {
            u32::try_from(value).ok().or_else(|| i32::try_from(value).ok().map(|v| v as u32))
        }),
    }
}

/// Notes for commands and enumerants which versions and extensions of desktop OpenGL have them.
fn origins(registry: Node, api: &str, model: &mut Model) {
    let features = elements(registry, "feature").filter(|node| node.attribute("api") == Some(api));
    let extensions = elements(registry, "extensions")
        .flat_map(|extensions| elements(extensions, "extension"))
        .filter(|node| {
            let supported = node.attribute("supported").unwrap_or_default();
            supported.split('|').any(|supporter| supporter == api)
        });
    for origin in features.chain(extensions) {
        let Some(name) = origin.attribute("name") else {
            continue;
        };
        let required = elements(origin, "require")
            .filter(|require| require.attribute("api").is_none_or(|only| only == api));
        for node in required.flat_map(|require| require.children()) {
            let Some(item) = node.attribute("name") else {
                continue;
            };
            let origins = match node.tag_name().name() {
                "command" => model.commands.get_mut(item).map(|command| &mut command.origins),
                "enum" => model.enumerants.get_mut(item).map(|item| &mut item.origins),
                _ => None,
            };
            if let Some(origins) = origins.filter(|origins| !origins.iter().any(|o| o == name)) {
                origins.push(name.into());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_the_registry_writes_them() {
        assert_eq!(number("0x0B50"), Some(0x0b50));
        assert_eq!(number("0xFFFFFFFF"), Some(u32::MAX));
        assert_eq!(number("-1"), Some(u32::MAX));
        assert_eq!(number("0xFFFFFFFFFFFFFFFF"), None);
        assert_eq!(number("\"GLX\""), None);
    }
}
