//! Calls of GLX, WGL and EGL that make contexts, make them current and show frames, as one vocabulary.

use afterglow_trace::{Call, Value};

/// A function of a window system that matters here, with the positions of its arguments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WindowFunction {
    /// Returns a context.
    Create {
        /// The context to share names with.
        share: Option<usize>,
    },
    /// Ends a context.
    Destroy {
        /// Which.
        context: usize,
    },
    /// Makes a context current, or none.
    MakeCurrent {
        /// What it draws to.
        drawable: usize,
        /// Which.
        context: usize,
    },
    /// Shows what was drawn: the end of a frame.
    Swap {
        /// Where.
        drawable: usize,
    },
    /// Lets a context share the names of another (wglShareLists).
    Share {
        /// Whose names.
        from: usize,
        /// Who shares them.
        to: usize,
    },
}

use WindowFunction::{Create, Destroy, MakeCurrent, Share, Swap};

/// Whether a call of the function of that name ends a frame.
pub fn ends_frame(name: &str) -> bool {
    matches!(WindowFunction::named(name), Some(Swap { .. }))
}

impl WindowFunction {
    /// The function of that name, if it matters.
    pub fn named(name: &str) -> Option<WindowFunction> {
        Some(match name {
            "glXCreateContext" | "glXCreateContextAttribsARB" | "eglCreateContext" => {
                Create { share: Some(2) }
            }
            "glXCreateNewContext" | "glXCreateContextWithConfigSGIX" => Create { share: Some(3) },
            "wglCreateContextAttribsARB" => Create { share: Some(1) },
            "wglCreateContext" | "wglCreateLayerContext" => Create { share: None },
            "glXDestroyContext" | "eglDestroyContext" => Destroy { context: 1 },
            "wglDeleteContext" => Destroy { context: 0 },
            "glXMakeCurrent" => MakeCurrent { drawable: 1, context: 2 },
            "glXMakeContextCurrent" | "glXMakeCurrentReadSGI" | "eglMakeCurrent" => {
                MakeCurrent { drawable: 1, context: 3 }
            }
            "wglMakeCurrent" => MakeCurrent { drawable: 0, context: 1 },
            "wglMakeContextCurrentARB" | "wglMakeContextCurrentEXT" => {
                MakeCurrent { drawable: 0, context: 2 }
            }
            "glXSwapBuffers" | "glXSwapBuffersMscOML" | "eglSwapBuffers" => Swap { drawable: 1 },
            "eglSwapBuffersWithDamageEXT" | "eglSwapBuffersWithDamageKHR" => Swap { drawable: 1 },
            "wglSwapBuffers" | "wglSwapLayerBuffers" => Swap { drawable: 0 },
            "wglShareLists" => Share { from: 0, to: 1 },
            _ => return None,
        })
    }

    /// What a call of it does.
    pub fn read(self, call: &Call) -> WindowCall {
        let handle = |index: usize| call.arg(index).as_pointer().unwrap_or(0);
        let result = call.ret.as_ref();
        // A call that was never left may have succeeded.
        let failed = result.is_some_and(|value| value.as_bool() == Some(false));
        match self {
            _ if failed => WindowCall::Nothing,
            Create { share } => match result.and_then(Value::as_pointer) {
                Some(context) => WindowCall::Create { context, share: share.map_or(0, handle) },
                None => WindowCall::Nothing,
            },
            Destroy { context } => WindowCall::Destroy { context: handle(context) },
            MakeCurrent { drawable, context } => {
                WindowCall::MakeCurrent { drawable: handle(drawable), context: handle(context) }
            }
            Swap { drawable } => WindowCall::Swap { drawable: handle(drawable) },
            Share { from, to } => WindowCall::Share { from: handle(from), to: handle(to) },
        }
    }
}

/// What a call does, in the traced program's handles; 0 is none. The fields are those of [`WindowFunction`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WindowCall {
    Create {
        context: u64,
        share: u64,
    },
    Destroy {
        context: u64,
    },
    MakeCurrent {
        drawable: u64,
        context: u64,
    },
    Swap {
        drawable: u64,
    },
    Share {
        from: u64,
        to: u64,
    },
    /// It failed in the traced program.
    Nothing,
}

/// Functions of window systems that do something which is not played; all others of them ask, or
/// change what has no effect on pictures.
pub fn is_lost(name: &str) -> bool {
    matches!(
        name,
        "glXUseXFont"
            | "glXCopyContext"
            | "glXCopySubBufferMESA"
            | "glXBindTexImageEXT"
            | "wglCopyContext"
            | "wglUseFontBitmapsA"
            | "wglUseFontBitmapsW"
            | "wglUseFontOutlinesA"
            | "wglUseFontOutlinesW"
            | "wglBindTexImageARB"
            | "eglBindTexImage"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn call(args: &[u64], ret: Option<Value>) -> Call {
        let mut call = Call::default();
        call.args = args.iter().map(|&value| Value::Pointer(value)).collect();
        call.ret = ret;
        call
    }

    #[test]
    fn calls_of_all_systems_mean_the_same() {
        let read = |name, args: &[u64], ret| WindowFunction::named(name).unwrap().read(&call(args, ret));
        let current = WindowCall::MakeCurrent { drawable: 5, context: 7 };
        let yes = Some(Value::Bool(true));
        assert_eq!(read("glXMakeCurrent", &[1, 5, 7], yes.clone()), current);
        assert_eq!(read("eglMakeCurrent", &[1, 5, 5, 7], yes.clone()), current);
        assert_eq!(read("wglMakeCurrent", &[5, 7], yes), current);
        assert_eq!(read("glXMakeCurrent", &[1, 5, 7], Some(Value::Bool(false))), WindowCall::Nothing);
        let made = Some(Value::Pointer(9));
        let shared = WindowCall::Create { context: 9, share: 4 };
        assert_eq!(read("glXCreateContext", &[1, 2, 4, 1], made.clone()), shared);
        assert_eq!(read("glXCreateNewContext", &[1, 2, 3, 4, 1], made), shared);
        assert_eq!(read("glXCreateContext", &[1, 2, 4, 1], Some(Value::Null)), WindowCall::Nothing);
        assert_eq!(read("glXSwapBuffers", &[1, 5], None), WindowCall::Swap { drawable: 5 });
        // Too few arguments are no reason to panic.
        assert_eq!(read("glXSwapBuffers", &[], None), WindowCall::Swap { drawable: 0 });
    }

    #[test]
    fn other_functions_do_not_matter() {
        assert_eq!(WindowFunction::named("glXChooseVisual"), None);
        assert!(!is_lost("glXChooseVisual") && is_lost("glXUseXFont"));
    }
}
