//! The software driver that `./x setup` unpacks for this program alone.
//!
//! It lies in the user's cache folder, with the libraries that the system lacks beside it; its RPATH finds them. So it
//! serves without environment variables, and the system's own drivers stay as they are.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// A lavapipe of our own: the driver's library and its ICD file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PrivateLavapipe {
    pub library: PathBuf,
    pub icd_file: PathBuf,
}

impl PrivateLavapipe {
    /// The private lavapipe of this user, if it was set up.
    pub fn find() -> Option<Self> {
        Self::find_in(&cache_folder()?)
    }

    /// The private lavapipe under a cache folder, if it was set up.
    pub fn find_in(cache_folder: &Path) -> Option<Self> {
        let folder = cache_folder.join("lavapipe");
        let found =
            Self { library: folder.join("lib/libvulkan_lvp.so"), icd_file: folder.join("lvp_icd.json") };
        (found.library.is_file() && found.icd_file.is_file()).then_some(found)
    }
}

/// Where this program keeps what it can make again: `$XDG_CACHE_HOME/afterglow` or `$HOME/.cache/afterglow`.
pub fn cache_folder() -> Option<PathBuf> {
    cache_folder_of(std::env::var_os("XDG_CACHE_HOME"), std::env::var_os("HOME"))
}

/// The XDG base directory specification says that relative paths in its variables are to be ignored.
fn cache_folder_of(xdg_cache_home: Option<OsString>, home: Option<OsString>) -> Option<PathBuf> {
    let absolute = |value: OsString| Some(PathBuf::from(value)).filter(|path| path.is_absolute());
    xdg_cache_home
        .and_then(absolute)
        .or_else(|| home.and_then(absolute).map(|home| home.join(".cache")))
        .map(|base| base.join("afterglow"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cache_folder_follows_the_xdg_rules() {
        let of = |xdg: Option<&str>, home: Option<&str>| {
            cache_folder_of(xdg.map(OsString::from), home.map(OsString::from))
        };
        assert_eq!(of(Some("/c"), Some("/h")), Some("/c/afterglow".into()));
        assert_eq!(of(Some("relative"), Some("/h")), Some("/h/.cache/afterglow".into()));
        assert_eq!(of(Some(""), None), None);
        assert_eq!(of(None, None), None);
    }

    #[test]
    fn half_a_set_up_is_not_found() {
        let folder = tempfile::tempdir().unwrap();
        let lib = folder.path().join("lavapipe/lib");
        std::fs::create_dir_all(&lib).unwrap();
        std::fs::write(lib.join("libvulkan_lvp.so"), b"").unwrap();
        assert_eq!(PrivateLavapipe::find_in(folder.path()), None);
        std::fs::write(folder.path().join("lavapipe/lvp_icd.json"), b"{}").unwrap();
        assert!(PrivateLavapipe::find_in(folder.path()).is_some());
    }
}
