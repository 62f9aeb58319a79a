//! `commands.rs` and `ids.rs`: the table of commands, and constants that name its entries.

use std::fmt::Write;

use crate::model::{Api, CType, Command, Length, Model, Param};
use crate::rules::Rules;
use crate::rust::{NOTICE, slice};

/// The table, ordered by name. Parameters are left out beyond the scope: nothing reads them.
pub fn commands(model: &Model, rules: &Rules) -> String {
    let names: Vec<&String> = model.commands.keys().collect();
    let classic = rules.commands(model);
    let place = |name: &str| names.binary_search_by(|n| n.as_str().cmp(name)).ok();
    // A row a command, in short: c is a command, p a parameter, s a parameter without length and group.
    let mut text = format!(
        "{NOTICE}\nuse crate::command::{{Api::*, Base::*, Command, Length::*, Scope::*, command as c, param as p, plain as s}};\n\n\
         pub static COMMANDS: [Command; {}] = [\n",
        names.len()
    );
    for command in model.commands.values() {
        let scope = match command.api {
            Api::Glx | Api::Wgl => "WindowSystem",
            Api::Gl if classic.contains(command.name.as_str()) => "Classic",
            Api::Gl => "Beyond",
        };
        let params = if scope == "Beyond" { &[] } else { command.params.as_slice() };
        let alias = command.alias.as_deref().and_then(place);
        let _ = writeln!(
            text,
            "    c({:?}, {:?}, {scope}, {alias:?}, {}, {}, {}),",
            command.name,
            command.api,
            ctype(command.result),
            slice(params.iter().map(param)),
            slice(command.origins.iter().map(|origin| format!("{origin:?}"))),
        );
    }
    text + "];\n"
}

fn ctype(ctype: CType) -> String {
    let constant = if ctype.constant { "true" } else { "false" };
    format!("({:?}, {}, {constant})", ctype.base, ctype.pointers)
}

fn param(param: &Param) -> String {
    let length = match &param.length {
        Length::Computed(params) => {
            format!("Computed({})", slice(params.iter().map(u8::to_string)))
        }
        other => format!("{other:?}"),
    };
    if length == "Unknown" && param.group.is_empty() {
        return format!("s({:?}, {})", param.name, ctype(param.ctype));
    }
    format!("p({:?}, {}, {length}, {:?})", param.name, ctype(param.ctype), param.group)
}

/// A constant for each command that code may name: those in scope, and those of the window systems.
pub fn ids(model: &Model, rules: &Rules) -> String {
    let classic = rules.commands(model);
    let wanted = |command: &Command| command.api != Api::Gl || classic.contains(command.name.as_str());
    let mut text = format!("{NOTICE}\nuse crate::command::CommandId;\n\n");
    for (index, command) in model.commands.values().enumerate().filter(|(_, c)| wanted(c)) {
        let _ = writeln!(text, "pub const {}: CommandId = CommandId({index});", command.name);
    }
    text
}
