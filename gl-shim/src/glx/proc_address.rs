//! glXGetProcAddress.

use std::ffi::{CStr, c_void};

use super::exports;

/// The address of an entry point; nothing if there is none, or if it is one of GLX that only exists to be linked with.
pub fn find(name: &CStr) -> Option<*const c_void> {
    exports::find(name.to_str().ok()?).or_else(|| crate::proc_address::proc_address(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found() {
        assert_eq!(find(c"glXSwapBuffers"), Some(exports::glXSwapBuffers as *const c_void));
        for unknown in [c"glXBindVideoDeviceNV", c"glXNothing", c"", c"\xff"] {
            assert_eq!(find(unknown), None);
        }
    }
}
