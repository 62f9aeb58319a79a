//! `dispatch.rs` of the player: from a trace's call to a method of the GL context.

use std::fmt::Write;

use crate::calls::{self, Call, Reader, Route, canonical_commands, unclear};
use crate::model::{Command, Model, ModelError};
use crate::rules::Rules;
use crate::rust::NOTICE;

/// The file: one arm for each command that is no alias and that the context supports.
///
/// # Errors
/// Where a command is none or several of what the manifest can make of it.
pub fn dispatch(model: &Model, rules: &Rules) -> Result<String, ModelError> {
    if let Some(name) = rules.play.unknown_name(canonical_commands(model, rules)) {
        return Err(unclear(name, "is no command in scope, or an alias"));
    }
    // Forms that differ in their types alone are often decoded alike.
    let mut arms: Vec<(String, String)> = Vec::new();
    for command in canonical_commands(model, rules) {
        let Some(call) = arm(command, rules)? else { continue };
        match arms.iter_mut().find(|(_, known)| *known == call) {
            Some((patterns, _)) => *patterns += &format!(" | id::{}", command.name),
            None => arms.push((format!("id::{}", command.name), call)),
        }
    }
    let mut text = format!("{NOTICE}{HEAD}");
    for (patterns, call) in arms {
        let _ = writeln!(text, "        {patterns} => {call},");
    }
    Ok(text + TAIL)
}

const HEAD: &str = "
use afterglow_api::{CommandId, id};
use afterglow_gl::{Context, Params};

use crate::args::*;
use crate::special;

/// Calls the method of a command that is no alias. `Some(false)`: there is none. `None`: the arguments
/// are not what the command takes.
pub fn play(gl: &mut Context, command: CommandId, a: Args) -> Option<bool> {
    match command {
";

const TAIL: &str = "        _ => return Some(false),
    }
    Some(true)
}
";

/// The expression that an arm consists of; `None` if the command is unsupported.
fn arm(command: &Command, rules: &Rules) -> Result<Option<String>, ModelError> {
    if rules.play.without_effect.contains(&command.name) {
        return Ok(Some("{}".into()));
    }
    Ok(match calls::route(command, rules, &Recorded)? {
        Route::Special(function) => Some(format!("special::{function}(gl, a)?")),
        Route::Unsupported => None,
        Route::Method(Call { text, gives: true, .. }) => Some(format!("{{ let _ = {text}; }}")),
        Route::Method(Call { text, .. }) => Some(text),
    })
}

/// Arguments of a traced call, by the methods of `core/player/src/args.rs`.
struct Recorded;

impl Reader for Recorded {
    fn scalar(&self, index: usize, decoder: &str) -> String {
        format!("a.get({index}, {decoder})?")
    }

    fn vector(&self, index: usize, decoder: &str) -> String {
        format!("a.vector({index}, {decoder})?")
    }

    fn first(&self, index: usize, decoder: &str) -> String {
        format!("a.first({index}, {decoder})?")
    }

    fn few(&self, index: usize, decoder: &str) -> String {
        format!("a.few({index}, {decoder})?")
    }

    fn list(&self, index: usize, count: usize, decoder: &str) -> String {
        format!("a.list({index}, {}, {decoder})?", self.scalar(count, "int"))
    }

    fn pointer(&self, index: usize) -> String {
        format!("a.pointer({index})?")
    }

    fn pointers(&self, index: usize, count: usize) -> String {
        format!("a.pointers({index}, {})?", self.scalar(count, "int"))
    }

    fn bytes(&self, index: usize) -> Option<String> {
        Some(format!("a.bytes({index})?"))
    }

    fn memory(&self, index: usize) -> Option<String> {
        Some(format!("a.memory({index})?"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arm(text: &str, name: &str) -> String {
        let arms = text.lines().filter_map(|line| line.split_once(" => "));
        let named = format!("id::{name}");
        let mut matching = arms.filter(|(patterns, _)| patterns.split_whitespace().any(|p| p == named));
        let (_, call) = matching.next().unwrap_or_else(|| panic!("no arm {name}"));
        call.trim_end_matches(',').into()
    }

    #[test]
    fn forms_of_a_behaviour_become_one_method() {
        let (model, rules) = crate::tests::model();
        let text = dispatch(&model, &rules).unwrap();
        let arm = |name| arm(&text, name);
        assert_eq!(arm("glVertex2i"), "gl.vertex([a.get(0, float)?, a.get(1, float)?, 0.0, 1.0])");
        assert_eq!(arm("glColor3ubv"), "{ let [x, y, z] = a.vector(0, unorm8)?; gl.color([x, y, z, 1.0]) }");
        assert_eq!(
            arm("glLightiv"),
            "gl.light(a.get(0, uint)?, a.get(1, uint)?, Params::Ints(&a.few(2, int)?))"
        );
        assert_eq!(arm("glLoadMatrixd"), "gl.load_matrix(a.vector(0, float)?)");
        assert_eq!(arm("glPixelStorei"), "gl.pixel_store(a.get(0, uint)?, a.get(1, float)?)");
        assert_eq!(arm("glFogCoordfv"), "{ let [x] = a.vector(0, float)?; gl.fog_coord(x) }");
        assert!(!text.contains("id::glBindBufferARB"), "an alias has no arm");
    }

    #[test]
    fn a_misspelt_name_is_an_error() {
        let (model, mut rules) = crate::tests::model();
        rules.play.unsupported.insert("glBindBufferARB".into());
        assert!(dispatch(&model, &rules).unwrap_err().to_string().contains("glBindBufferARB"));
    }

    #[test]
    fn plain_commands_take_their_arguments_in_order() {
        let (model, rules) = crate::tests::model();
        let text = dispatch(&model, &rules).unwrap();
        let arm = |name| arm(&text, name);
        assert_eq!(arm("glBindTexture"), "gl.bind_texture(a.get(0, uint)?, a.get(1, uint)?)");
        assert_eq!(arm("glClipPlane"), "gl.clip_plane(a.get(0, uint)?, a.vector(1, double)?)");
        assert_eq!(arm("glDeleteTextures"), "gl.delete_textures(&a.list(1, a.get(0, int)?, uint)?)");
        assert_eq!(
            arm("glDrawElements"),
            "gl.draw_elements(a.get(0, uint)?, a.get(1, int)?, a.get(2, uint)?, a.pointer(3)?)"
        );
    }
}
