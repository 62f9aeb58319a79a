//! The order of calls of several threads, and of those that are never left.

use afterglow_trace::TraceEnd;

use crate::encoder::{Encoder, V};
use crate::{containers, read, sample};

#[test]
fn calls_come_in_the_order_in_which_they_were_entered() {
    let mut encoder = Encoder::new(6);
    let outer = encoder.enter(0, &sample::SWAP, vec![]);
    let other = encoder.enter(1, &sample::CLEAR, vec![V::UInt(1)]);
    encoder.call(2, &sample::CLEAR, vec![V::UInt(2)], None);
    encoder.leave(other);
    encoder.begin_leave(outer);
    encoder.ret(V::Bool(true));
    encoder.end();
    let outcome = read(&encoder.bytes);
    let expected = [
        "0 @0 glXSwapBuffers(dpy = ?, drawable = ?) = true",
        "1 @1 glClear(mask = 1)",
        "2 @2 glClear(mask = 2)",
    ];
    assert_eq!(outcome.lines, expected);
}

#[test]
fn calls_that_are_never_left_come_incomplete() {
    let mut encoder = Encoder::new(6);
    encoder.enter(0, &sample::CLEAR, vec![V::UInt(1)]);
    encoder.call(1, &sample::CLEAR, vec![V::UInt(2)], None);
    encoder.enter(1, &sample::GEN_TEXTURES, vec![V::UInt(3)]);
    let outcome = read(&encoder.bytes);
    let expected = [
        "0 @0 glClear(mask = 1) // incomplete",
        "1 @1 glClear(mask = 2)",
        "2 @1 glGenTextures(n = 3, textures = ?) // incomplete",
    ];
    assert_eq!(outcome.lines, expected);
    assert_eq!(outcome.end.unwrap(), TraceEnd::Clean { incomplete: 2 });
}

#[test]
fn a_second_leave_is_ignored() {
    let mut encoder = Encoder::new(6);
    encoder.call(0, &sample::CLEAR, vec![V::UInt(1)], None);
    encoder.begin_leave(0);
    encoder.ret(V::Array(vec![V::UInt(1)]));
    encoder.end();
    encoder.call(0, &sample::CLEAR, vec![V::UInt(2)], None);
    let outcome = read(&encoder.bytes);
    assert_eq!(outcome.lines, ["0 @0 glClear(mask = 1)", "1 @0 glClear(mask = 2)"]);
}

/// Reads `file[..length]` for every length, and checks that only what is missing is missing.
fn cut_everywhere(file: &[u8], least_at_half: usize) {
    let lines = sample::lines();
    let mut before = 0;
    for length in 0..file.len() {
        let Ok(mut reader) = crate::open(&file[..length]) else {
            assert_eq!(before, 0);
            continue;
        };
        let outcome = crate::drain(&mut reader);
        let numbers = outcome.calls.iter().map(|call| call.number as usize);
        assert!(numbers.eq(0..outcome.calls.len()));
        for call in outcome.calls.iter().filter(|call| call.complete) {
            let number = call.number as usize;
            assert_eq!(outcome.lines[number], lines[number]);
        }
        let incomplete = outcome.calls.iter().filter(|call| !call.complete).count() as u32;
        match outcome.end.unwrap() {
            TraceEnd::Clean { incomplete: open } => assert_eq!(open, incomplete),
            TraceEnd::Truncated { incomplete: open, offset } => {
                assert_eq!(open, incomplete);
                assert_eq!(offset, reader.position());
            }
            TraceEnd::Failed { .. } => unreachable!("`drain` gives the error instead"),
        }
        let complete = outcome.calls.len() - incomplete as usize;
        assert!(complete >= before);
        before = complete;
        assert!(length < file.len() / 2 || complete >= least_at_half);
    }
    assert!(before + 1 >= lines.len());
}

#[test]
fn a_trace_cut_anywhere_gives_what_is_there() {
    for version in sample::VERSIONS {
        cut_everywhere(&sample::encode(version), 1);
    }
}

#[test]
fn a_container_cut_anywhere_gives_what_is_there() {
    let bytes = sample::encode(6);
    cut_everywhere(&containers::snappy(&bytes, 40), 1);
    // In one chunk: only what Snappy decoded of it before the cut.
    cut_everywhere(&containers::snappy(&bytes, 1 << 20), 1);
    for (_, file) in containers::all(&bytes).split_off(2) {
        cut_everywhere(&file, 0);
    }
}
