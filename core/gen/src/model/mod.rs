//! The one model of the API, read from the Khronos XML: commands, enumerants, and what defines them.

mod ctype;
mod length;
mod xml;

use std::collections::BTreeMap;

pub use ctype::{Base, CType};
pub use length::Length;
pub use xml::{ModelError, Sources, read};

/// Which library's entry points a name belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Api {
    /// OpenGL itself.
    Gl,
    /// GLX.
    Glx,
    /// WGL.
    Wgl,
}

/// A parameter of a command.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Param {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ctype: CType,
    /// How many elements a pointer points to.
    pub length: Length,
    /// The group of enumerants that it takes; empty if none is named.
    pub group: String,
}

/// A command.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Command {
    /// Its name, prefix included.
    pub name: String,
    /// Where it belongs.
    pub api: Api,
    /// What it returns.
    pub result: CType,
    /// Its parameters.
    pub params: Vec<Param>,
    /// The command that this one is another name of.
    pub alias: Option<String>,
    /// Versions (`GL_VERSION_1_3`) and extensions that have it, in the order of the XML.
    pub origins: Vec<String>,
}

/// An enumerant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Enumerant {
    /// Its name, prefix included.
    pub name: String,
    /// Its value.
    pub value: u32,
    /// The groups that it belongs to.
    pub groups: Vec<String>,
    /// Whether it is a bit of a mask.
    pub bitmask: bool,
    /// Versions and extensions that have it, in the order of the XML.
    pub origins: Vec<String>,
}

/// Commands and enumerants by name.
#[derive(Debug, Default)]
pub struct Model {
    /// Commands of all APIs.
    pub commands: BTreeMap<String, Command>,
    /// Enumerants of all APIs, those whose value is a number of 32 bits.
    pub enumerants: BTreeMap<String, Enumerant>,
}

impl Model {
    /// The command of that name, and then the one that it is an alias of, if any, and so on: the last.
    pub fn canonical(&self, name: &str) -> Option<&Command> {
        let mut command = self.commands.get(name)?;
        // An alias of an alias does occur; more than a few would be a circle.
        for _ in 0..4 {
            match command.alias.as_ref().and_then(|alias| self.commands.get(alias)) {
                Some(next) => command = next,
                None => return Some(command),
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pinned_registry_is_understood() {
        let model = Sources::load(crate::tests::ROOT).unwrap().model().unwrap();
        let vertex = &model.commands["glVertex3fv"];
        assert_eq!(vertex.origins, ["GL_VERSION_1_0"]);
        assert_eq!(vertex.params.len(), 1);
        assert_eq!(vertex.params[0].length, Length::Count(3));
        assert_eq!(vertex.params[0].group, "CoordF");
        assert_eq!(vertex.params[0].ctype, CType { base: Base::Float, pointers: 1, constant: true });
        assert_eq!(model.canonical("glBindBufferARB").unwrap().name, "glBindBuffer");
        assert_eq!(model.commands["glXCreateContext"].api, Api::Glx);
        assert_eq!(model.enumerants["GL_LIGHTING"].value, 0x0b50);
        assert!(model.enumerants["GL_DEPTH_BUFFER_BIT"].bitmask);
        // Its value is a string.
        assert!(!model.enumerants.contains_key("GLX_EXTENSION_NAME"));
    }

    #[test]
    fn every_alias_leads_somewhere() {
        let model = Sources::load(crate::tests::ROOT).unwrap().model().unwrap();
        assert!(model.commands.len() > 3300);
        for name in model.commands.keys() {
            let canonical = model.canonical(name).unwrap();
            assert_eq!(canonical.alias, None, "{name}");
            assert_eq!(canonical.params.len(), model.commands[name].params.len(), "{name}");
        }
    }
}
