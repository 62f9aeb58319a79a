//! Commands: every entry point that the registry, or a libGL in use, has a name for.

use crate::generated::commands::COMMANDS;

/// Which library's entry points a command belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Api {
    /// OpenGL itself.
    Gl,
    /// GLX.
    Glx,
    /// WGL, and what it needs of GDI.
    Wgl,
}

/// Whether a command is one that this project is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Scope {
    /// Of OpenGL 1.5 or an extension of its time.
    Classic,
    /// Of GLX or WGL.
    WindowSystem,
    /// Later, or never in use: only its name is known.
    Beyond,
}

/// A C type without pointers and `const`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names are OpenGL's")]
pub enum Base {
    Void,
    Boolean,
    Byte,
    UByte,
    Short,
    UShort,
    Int,
    UInt,
    Enum,
    Bitfield,
    Sizei,
    Float,
    Clampf,
    Double,
    Clampd,
    Half,
    Fixed,
    Int64,
    UInt64,
    Intptr,
    Sizeiptr,
    Char,
    /// An XID, a handle of Windows, a function: as wide as a pointer at most, to be passed on.
    Handle,
    /// A structure, of which there are only pointers.
    Struct,
}

/// A C type.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct CType {
    /// What is pointed to in the end.
    pub base: Base,
    /// How many `*` there are.
    pub pointers: u8,
    /// Whether what is pointed to is constant.
    pub constant: bool,
}

/// How many elements a pointer points to, in terms of the command's parameters (by position).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Length {
    /// No pointer, or nothing is said.
    Unknown,
    /// So many.
    Count(u16),
    /// As many as the value of a parameter.
    Param(u8),
    /// As many as a parameter's value times a number.
    Product(u8, u16),
    /// A function of these parameters (and of state) that the XML does not spell out.
    Computed(&'static [u8]),
}

/// A parameter of a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Param {
    /// Its name.
    pub name: &'static str,
    /// Its type.
    pub ctype: CType,
    /// How many elements it points to.
    pub length: Length,
    /// The group of enumerants that it takes (see [`enumerant_in_group`](crate::enumerant_in_group)), or "".
    pub group: &'static str,
}

/// What is known of an entry point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Command {
    /// Its name in C.
    pub name: &'static str,
    /// Where it belongs.
    pub api: Api,
    /// Whether it is in scope.
    pub scope: Scope,
    alias: Option<u16>,
    /// What it returns.
    pub result: CType,
    /// Its parameters; none [beyond the scope](Scope::Beyond).
    pub params: &'static [Param],
    /// Versions (as `GL_VERSION_1_3`) and extensions that have it.
    pub origins: &'static [&'static str],
}

impl Command {
    /// All commands, ordered by name: [`CommandId::index`] counts in this order.
    pub fn all() -> &'static [Command] {
        &COMMANDS
    }
}

/// Names a command; what an index into [`Command::all`] is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CommandId(pub(crate) u16);

impl CommandId {
    /// The command of that name.
    pub fn named(name: &str) -> Option<CommandId> {
        let index = COMMANDS.binary_search_by(|command| command.name.cmp(name)).ok()?;
        // The table's length fits (tested).
        Some(CommandId(index as u16))
    }

    /// Place in [`Command::all`].
    pub fn index(self) -> usize {
        self.0.into()
    }

    /// What is known of it.
    pub fn command(self) -> &'static Command {
        &COMMANDS[self.index()]
    }

    /// Its name in C.
    pub fn name(self) -> &'static str {
        self.command().name
    }

    /// The command that this one is only another name of: itself, if it is none such.
    #[must_use]
    pub fn canonical(self) -> CommandId {
        self.command().alias.map_or(self, CommandId)
    }
}

type Type = (Base, u8, bool);

const fn ctype((base, pointers, constant): Type) -> CType {
    CType { base, pointers, constant }
}

/// A row of the table.
pub(crate) const fn command(
    name: &'static str,
    api: Api,
    scope: Scope,
    alias: Option<u16>,
    result: Type,
    params: &'static [Param],
    origins: &'static [&'static str],
) -> Command {
    Command { name, api, scope, alias, result: ctype(result), params, origins }
}

pub(crate) const fn param(name: &'static str, of: Type, length: Length, group: &'static str) -> Param {
    Param { name, ctype: ctype(of), length, group }
}

pub(crate) const fn plain(name: &'static str, of: Type) -> Param {
    param(name, of, Length::Unknown, "")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::id;

    #[test]
    fn commands_are_found_by_name() {
        assert!(COMMANDS.is_sorted_by(|a, b| a.name < b.name));
        assert!(COMMANDS.len() < usize::from(u16::MAX));
        for command in Command::all() {
            assert_eq!(CommandId::named(command.name).unwrap().command(), command);
        }
        assert_eq!(CommandId::named("glVertex5f"), None);
        assert_eq!(CommandId::named("glVertex3fv"), Some(id::glVertex3fv));
    }

    #[test]
    fn aliases_lead_to_commands_with_the_same_parameters() {
        let types = |id: CommandId| {
            let params = id.command().params.iter();
            params.map(|param| param.ctype.pointers).collect::<Vec<_>>()
        };
        for command in Command::all().iter().filter(|command| command.scope == Scope::Classic) {
            let id = CommandId::named(command.name).unwrap();
            assert_eq!(id.canonical().canonical(), id.canonical());
            assert_eq!(types(id), types(id.canonical()), "{}", command.name);
        }
        assert_eq!(id::glBufferDataARB.canonical(), id::glBufferData);
        assert_eq!(id::glGenTexturesEXT.canonical(), id::glGenTextures);
    }

    #[test]
    fn the_scope_ends_at_1_5() {
        let scope = |name| CommandId::named(name).unwrap().command().scope;
        assert_eq!(scope("glEndQuery"), Scope::Classic);
        assert_eq!(scope("glUseProgram"), Scope::Beyond);
        assert_eq!(scope("wglMakeCurrent"), Scope::WindowSystem);
        let classic = |command: &&Command| {
            command.origins.iter().any(|o| o.strip_prefix("GL_VERSION_1_").is_some_and(|minor| minor <= "5"))
        };
        // The number of commands of OpenGL 1.5, from its specification.
        assert_eq!(COMMANDS.iter().filter(classic).count(), 452);
    }
}
