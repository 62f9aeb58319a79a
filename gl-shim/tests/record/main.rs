//! What is recorded of a program's calls, on a context without a device.
//!
//! One test, since there is one recording a process.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

mod entry_points;
mod parts;

use std::path::Path;
use std::process::Command;
use std::ptr::null_mut;

use GL::{current, record};
use afterglow_api::constants::GL_LIGHTING;
use afterglow_gl::backend::NullBackend;
use afterglow_gl::{Context, SharedNames};
use afterglow_trace::dump::CallLine;
use afterglow_trace::{Call, TraceReader};

use parts::*;

/// The calls in a file, without their numbers and addresses of this process.
fn lines(path: &Path) -> Vec<String> {
    let mut reader = TraceReader::open(path).unwrap();
    let (mut call, mut lines) = (Call::default(), Vec::new());
    while reader.next_call(&mut call).unwrap() {
        assert!(call.complete);
        let line = CallLine::new(&call, reader.signatures()).to_string();
        let line = line.split_once(' ').unwrap().1;
        let words = line.split(' ').map(|word| match word.trim_end_matches(',') {
            address if address.starts_with("0x") && address.len() > 8 => word.replace(address, "ADDRESS"),
            _ => word.to_owned(),
        });
        lines.push(words.collect::<Vec<_>>().join(" "));
    }
    lines
}

#[test]
fn calls_are_recorded_with_what_they_read_and_give() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("calls.trace");
    record::start(&path).unwrap();
    // SAFETY: no pointers.
    unsafe { entry_points::glIsEnabled(GL_LIGHTING) };
    let mut context = Context::new(Box::new(NullBackend), SharedNames::default());
    context.set_drawable(64, 48);
    current::set(&mut context);
    for part in [immediate_mode, textures_and_lists, queries, arrays_in_memory, buffers, window_system] {
        part();
    }
    // The swap has brought the file up to date.
    let recorded = lines(&path);
    immediate_mode();
    record::stop();
    immediate_mode();
    current::set(null_mut());

    let parts = [IMMEDIATE_MODE, TEXTURES_AND_LISTS, QUERIES, ARRAYS_IN_MEMORY, BUFFERS, WINDOW_SYSTEM];
    let without_context = ["glIsEnabled(cap = GL_LIGHTING) = GL_FALSE"];
    let expected: Vec<&str> = without_context.into_iter().chain(parts.concat()).collect();
    for (recorded, expected) in recorded.iter().zip(&expected) {
        assert_eq!(recorded, expected);
    }
    assert_eq!(recorded.len(), expected.len());
    assert_eq!(lines(&path).len(), expected.len() + IMMEDIATE_MODE.len());
    check_blobs(&path);
    check_with_apitrace(&path);
}

fn check_blobs(path: &Path) {
    let mut reader = TraceReader::open(path).unwrap();
    let mut call = Call::default();
    let mut found = 0;
    while reader.next_call(&mut call).unwrap() {
        let name = &*reader.signature(call.signature).name;
        let expected: &[u8] = match name {
            "memcpy" => &[9, 2, 3, 4],
            "glBufferDataARB" => &[1, 2, 3, 4],
            "glCallLists" => &[1, 0, 2, 0],
            _ => continue,
        };
        let blob = call.args.iter().find_map(|value| value.as_blob()).unwrap();
        assert_eq!(**blob, *expected, "{name}");
        found += 1;
    }
    assert_eq!(found, 3);
}

/// apitrace's own reader takes the file, if there is one.
fn check_with_apitrace(path: &Path) {
    let Ok(output) = Command::new("apitrace").args(["dump", "--verbose", "--color=never"]).arg(path).output()
    else {
        return;
    };
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    for line in IMMEDIATE_MODE.iter().chain(TEXTURES_AND_LISTS).chain(WINDOW_SYSTEM) {
        assert!(text.contains(line), "{line}");
    }
}
