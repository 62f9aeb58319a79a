//! Calls of commands that take their arguments as they are.

use super::arguments::{decoder, get};
use super::form::snake_case;
use super::unclear;
use crate::model::{Base, Command, Length, ModelError, Param};
use crate::rules::Rules;

/// The call of the method that has the command's name.
pub fn call(command: &Command, rules: &Rules) -> Result<String, ModelError> {
    let method = match rules.play.methods.get(&command.name) {
        Some(method) => method.clone(),
        None => snake_case(&command.name),
    };
    let mut arguments = Vec::new();
    for (index, param) in command.params.iter().enumerate() {
        let dropped = rules.play.dropped.get(&command.name).is_some_and(|name| *name == param.name);
        if dropped || is_count(command, index) || is_result(param) {
            continue;
        }
        let required = rules.play.required_memory.contains(&command.name);
        let argument = argument(index, param, required);
        let problem = || unclear(&command.name, &format!("has a parameter {} of no plain kind", param.name));
        arguments.push(argument.ok_or_else(problem)?);
    }
    let call = format!("gl.{method}({})", arguments.join(", "));
    let returns = command.result.pointers > 0
        || command.result.base != Base::Void
        || command.params.iter().any(is_result);
    Ok(if returns { format!("{{ let _ = {call}; }}") } else { call })
}

/// Whether the parameter only says how many elements another one points to.
fn is_count(command: &Command, index: usize) -> bool {
    let mut pointers = command.params.iter().filter(|param| !is_result(param));
    pointers.any(|param| param.length == Length::Param(index as u8))
}

/// Whether the command writes to it.
fn is_result(param: &Param) -> bool {
    param.ctype.pointers > 0 && !param.ctype.constant
}

fn argument(index: usize, param: &Param, required: bool) -> Option<String> {
    let ctype = param.ctype;
    if ctype.is_scalar() {
        return decoder(ctype.base).map(|decoder| get(index, decoder));
    }
    match (ctype.pointers, ctype.base, &param.length) {
        (2, Base::Void, Length::Param(count)) => {
            Some(format!("a.pointers({index}, {})?", get((*count).into(), "int")))
        }
        (1, Base::Void | Base::Boolean, _) if is_address(param) => Some(format!("a.pointer({index})?")),
        // Compressed images always have data; their size is the bytes' own.
        (1, Base::Void, Length::Param(_)) => Some(format!("a.bytes({index})?")),
        (1, Base::Void | Base::UByte, _) if required => Some(format!("a.bytes({index})?")),
        (1, Base::Void | Base::UByte, Length::Computed(_)) => Some(format!("a.memory({index})?")),
        (1, base, Length::Count(1)) => decoder(base).map(|decoder| format!("a.first({index}, {decoder})?")),
        (1, base, Length::Count(_)) => decoder(base).map(|decoder| format!("a.vector({index}, {decoder})?")),
        (1, base, Length::Param(count)) => {
            let count = get((*count).into(), "int");
            decoder(base).map(|decoder| format!("&a.list({index}, {count}, {decoder})?"))
        }
        _ => None,
    }
}

/// Whether it is kept as an address, to be read when something is drawn.
fn is_address(param: &Param) -> bool {
    matches!(param.name.as_str(), "pointer" | "indices")
}
