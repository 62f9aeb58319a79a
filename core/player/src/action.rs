//! What to do with the calls of a function: found once for each function that a trace names.

use afterglow_api::{Api, CommandId, id};

use crate::window::{self, WindowFunction};

/// How a function's calls are played.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// By the context's method; the command is no alias.
    Gl(CommandId),
    /// glMapBuffer: where the program saw the buffer is noted, too.
    Map,
    /// glUnmapBuffer.
    Unmap,
    /// The tracer's own record of what the program wrote to a mapped buffer.
    Memcpy,
    /// A window system's function.
    Window(WindowFunction),
    /// Not at all, and nothing is lost.
    Nothing,
    /// Not at all: there is no way.
    Unsupported,
}

impl Action {
    /// What calls of the function of that name need.
    pub fn of(name: &str) -> Action {
        if let Some(function) = WindowFunction::named(name) {
            return Action::Window(function);
        }
        let command = CommandId::named(name).map(CommandId::canonical);
        match command {
            _ if name == "memcpy" => Action::Memcpy,
            Some(id::glMapBuffer) => Action::Map,
            Some(id::glUnmapBuffer) => Action::Unmap,
            Some(command) if command.command().api == Api::Gl => Action::Gl(command),
            _ if window::is_lost(name) => Action::Unsupported,
            _ if ["glX", "wgl", "egl"].iter().any(|prefix| name.starts_with(prefix)) => Action::Nothing,
            Some(_) => Action::Nothing,
            None => Action::Unsupported,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_are_told_apart_by_name() {
        assert_eq!(Action::of("glBindBufferARB"), Action::Gl(id::glBindBuffer));
        assert_eq!(Action::of("glMapBufferARB"), Action::Map);
        assert_eq!(Action::of("glXChooseVisual"), Action::Nothing);
        assert_eq!(Action::of("ChoosePixelFormat"), Action::Nothing);
        assert_eq!(Action::of("eglInitialize"), Action::Nothing);
        assert_eq!(Action::of("glXUseXFont"), Action::Unsupported);
        assert_eq!(Action::of("vkCreateInstance"), Action::Unsupported);
        assert!(matches!(Action::of("glXSwapBuffers"), Action::Window(_)));
    }
}
