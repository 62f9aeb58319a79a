//! Addresses of entry points by name: glXGetProcAddress.

use std::ffi::{CStr, c_void};

use crate::generated::proc_table;

/// A name and the address of its function.
pub struct Entry {
    name: &'static str,
    address: *const c_void,
}

// SAFETY: the address is that of a function, which nobody writes to.
unsafe impl Sync for Entry {}

/// An entry of a table; tables are ordered by name.
pub const fn entry(name: &'static str, address: *const c_void) -> Entry {
    Entry { name, address }
}

/// All tables.
const TABLES: [&[Entry]; 1] = [&proc_table::TABLE];

/// The function of that name, if this library has it.
pub fn proc_address(name: &CStr) -> Option<*const c_void> {
    TABLES.iter().find_map(|table| find(table, name))
}

fn find(table: &[Entry], name: &CStr) -> Option<*const c_void> {
    let place = table.binary_search_by(|entry| entry.name.as_bytes().cmp(name.to_bytes()));
    place.ok().map(|place| table[place].address)
}

/// The names of OpenGL that there are, ordered.
pub fn names() -> impl Iterator<Item = &'static str> {
    proc_table::TABLE.iter().map(|entry| entry.name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generated::exports::{glBegin, glBindBufferARB};

    #[test]
    fn names_are_found() {
        assert!(names().is_sorted());
        for name in names() {
            let name = std::ffi::CString::new(name).unwrap();
            assert!(proc_address(&name).is_some_and(|address| !address.is_null()), "{name:?}");
        }
        assert_eq!(proc_address(c"glBegin"), Some(glBegin as *const c_void));
        assert_eq!(proc_address(c"glBindBufferARB"), Some(glBindBufferARB as *const c_void));
        assert!(proc_address(c"glUseProgramObjectARB").is_some());
        for unknown in [c"", c"gl", c"glBegi", c"glBeginx", c"glXSwapBuffers"] {
            assert_eq!(proc_address(unknown), None);
        }
    }
}
