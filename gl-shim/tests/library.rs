//! The library as the dynamic linker sees it.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use GL::proc_address::names;
use libloading::Library;

/// The system's library, if there is one.
const SYSTEM: &str = "/usr/lib/x86_64-linux-gnu/libGL.so.1";

/// This library, beside the test's program or a folder above it.
fn library() -> PathBuf {
    let program = std::env::current_exe().unwrap();
    let mut places = program.ancestors().skip(1).take(2).map(|folder| folder.join("libGL.so"));
    places.find(|place| place.exists()).expect("the library is built with its tests")
}

#[test]
fn every_name_is_exported() {
    // SAFETY: loading it runs no code that needs anything.
    let library = unsafe { Library::new(library()) }.unwrap();
    for name in names() {
        // SAFETY: the symbol is not used.
        assert!(unsafe { library.get::<*const ()>(name.as_bytes()) }.is_ok(), "{name}");
    }
}

#[test]
fn our_addresses_are_those_of_our_functions() {
    let Ok(output) = Command::new("readelf").args(["-rW"]).arg(library()).output() else { return };
    let text = String::from_utf8(output.stdout).unwrap();
    let symbols = text.lines().filter_map(|line| line.split_whitespace().nth(4));
    let by_name: Vec<&str> = symbols.filter(|name| name.starts_with("gl")).collect();
    assert!(by_name.is_empty(), "a preloaded library would replace {by_name:?}");
}

#[test]
fn no_name_of_the_system_s_library_is_missing() {
    if !Path::new(SYSTEM).exists() {
        return;
    }
    let Ok(output) = Command::new("nm").args(["-D", "--defined-only", SYSTEM]).output() else { return };
    let known: BTreeSet<&str> = names().collect();
    let text = String::from_utf8(output.stdout).unwrap();
    let symbols = text.lines().filter_map(|line| line.split([' ', '@']).nth(2));
    let of_gl = symbols.filter(|name| name.starts_with("gl") && !name.starts_with("glX"));
    let missing: Vec<&str> = of_gl.filter(|name| !known.contains(name)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}
