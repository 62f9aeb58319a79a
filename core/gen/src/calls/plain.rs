//! Calls of commands that take their arguments as they are.

use super::arguments::decoder;
use super::form::snake_case;
use super::{Call, Reader, unclear};
use crate::model::{Base, Command, Length, ModelError, Param};
use crate::rules::Rules;

/// The call of the method that has the command's name.
pub fn call(command: &Command, rules: &Rules, reader: &dyn Reader) -> Result<Call, ModelError> {
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
        let argument = argument(index, param, required, reader);
        let problem = || unclear(&command.name, &format!("has a parameter {} of no plain kind", param.name));
        arguments.push(argument.ok_or_else(problem)?);
    }
    let gives = command.result.pointers > 0
        || command.result.base != Base::Void
        || command.params.iter().any(is_result);
    Ok(Call { text: super::method_call(&method, &arguments), method, gives })
}

/// Whether the parameter only says how many elements another one points to.
pub fn is_count(command: &Command, index: usize) -> bool {
    let mut pointers = command.params.iter().filter(|param| !is_result(param));
    pointers.any(|param| param.length == Length::Param(index as u8))
}

/// Whether the command writes to it.
pub fn is_result(param: &Param) -> bool {
    param.ctype.pointers > 0 && !param.ctype.constant
}

fn argument(index: usize, param: &Param, required: bool, reader: &dyn Reader) -> Option<String> {
    let ctype = param.ctype;
    if ctype.is_scalar() {
        return decoder(ctype.base).map(|decoder| reader.scalar(index, decoder));
    }
    match (ctype.pointers, ctype.base, &param.length) {
        (2, Base::Void, Length::Param(count)) => Some(reader.pointers(index, (*count).into())),
        (1, Base::Void | Base::Boolean, _) if is_address(param) => Some(reader.pointer(index)),
        // Compressed images always have data; their size is the bytes' own.
        (1, Base::Void, Length::Param(_)) => reader.bytes(index),
        (1, Base::Void | Base::UByte, _) if required => reader.bytes(index),
        (1, Base::Void | Base::UByte, Length::Computed(_)) => reader.memory(index),
        (1, base, Length::Count(1)) => decoder(base).map(|decoder| reader.first(index, decoder)),
        (1, base, Length::Count(_)) => decoder(base).map(|decoder| reader.vector(index, decoder)),
        (1, base, Length::Param(count)) => {
            decoder(base).map(|decoder| format!("&{}", reader.list(index, (*count).into(), decoder)))
        }
        _ => None,
    }
}

/// Whether it is kept as an address, to be read when something is drawn.
fn is_address(param: &Param) -> bool {
    matches!(param.name.as_str(), "pointer" | "indices")
}
