//! glXGetProcAddress.

use std::ffi::{CStr, c_void};

use super::exports::*;

/// The address of an entry point; nothing if there is none, or if it is one of GLX that only exists to be linked with.
pub fn find(name: &CStr) -> Option<*const c_void> {
    own(name.to_str().ok()?).or_else(|| crate::proc_address::proc_address(name))
}

macro_rules! names {
    ($($name:ident)*) => {
        fn own(name: &str) -> Option<*const c_void> {
            match name {
                $(stringify!($name) => Some($name as *const c_void),)*
                _ => None,
            }
        }
    };
}

names! {
    glXChooseFBConfig glXChooseFBConfigSGIX glXChooseVisual glXCopyContext glXCreateContext
    glXCreateContextAttribsARB glXCreateContextWithConfigSGIX glXCreateGLXPbufferSGIX glXCreateGLXPixmap
    glXCreateGLXPixmapWithConfigSGIX glXCreateNewContext glXCreatePbuffer glXCreatePixmap glXCreateWindow
    glXDestroyContext glXDestroyGLXPbufferSGIX glXDestroyGLXPixmap glXDestroyPbuffer glXDestroyPixmap
    glXDestroyWindow glXFreeContextEXT glXGetClientString glXGetConfig glXGetContextIDEXT glXGetCurrentContext
    glXGetCurrentDisplay glXGetCurrentDisplayEXT glXGetCurrentDrawable glXGetCurrentReadDrawable
    glXGetCurrentReadDrawableSGI glXGetFBConfigAttrib glXGetFBConfigAttribSGIX glXGetFBConfigFromVisualSGIX
    glXGetFBConfigs glXGetProcAddress glXGetProcAddressARB glXGetSelectedEvent glXGetSelectedEventSGIX
    glXGetSwapIntervalMESA glXGetVisualFromFBConfig glXGetVisualFromFBConfigSGIX glXIsDirect glXMakeContextCurrent
    glXMakeCurrent glXMakeCurrentReadSGI glXQueryContext glXQueryContextInfoEXT glXQueryDrawable glXQueryExtension
    glXQueryExtensionsString glXQueryGLXPbufferSGIX glXQueryServerString glXQueryVersion glXSelectEvent
    glXSelectEventSGIX glXSwapBuffers glXSwapIntervalEXT glXSwapIntervalMESA glXSwapIntervalSGI glXUseXFont
    glXWaitGL glXWaitX
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found() {
        assert_eq!(find(c"glXSwapBuffers"), Some(glXSwapBuffers as *const c_void));
        for unknown in [c"glXBindVideoDeviceNV", c"glXNothing", c"", c"\xff"] {
            assert_eq!(find(unknown), None);
        }
    }
}
