//! Versions, values and signatures.

use std::sync::Arc;

use afterglow_trace::{Call, TraceEnd, TraceError, Value};

use crate::encoder::{Encoder, Function, V};
use crate::{containers, open, read, sample};

#[test]
fn every_version_reads_the_same() {
    for version in sample::VERSIONS {
        let outcome = read(&sample::encode(version));
        assert_eq!(outcome.lines, sample::lines(), "version {version}");
        let end = outcome.end.unwrap();
        assert_eq!(end, TraceEnd::Clean { incomplete: 0 });
    }
}

#[test]
fn the_header_is_read() {
    let reader = open(&sample::encode(6)).unwrap();
    assert_eq!((reader.version(), reader.semantic_version()), (6, 5));
    let properties: Vec<_> = reader.properties().iter().collect();
    let expected = [("process.name", "/usr/bin/game"), ("os", "Linux")];
    assert!(properties.iter().map(|(k, v)| (&**k, &**v)).eq(expected));

    let reader = open(&sample::encode(2)).unwrap();
    assert_eq!((reader.version(), reader.semantic_version()), (2, 2));
    assert!(reader.properties().is_empty());
}

#[test]
fn newer_versions_are_refused() {
    for header in [&[7][..], &[6, 7]] {
        let error = open(&containers::snappy(header, 100)).err().unwrap();
        assert!(matches!(error, TraceError::UnsupportedVersion { version: 7 }));
    }
}

#[test]
fn values_convert_and_know_their_names() {
    let mut reader = open(&sample::encode(6)).unwrap();
    let mut call = Call::default();
    let mut next = || {
        assert!(reader.next_call(&mut call).unwrap());
        call.clone()
    };
    let viewport = next();
    assert_eq!(viewport.arg(3).as_i32(), Some(480));
    assert_eq!(*viewport.arg(4), Value::Absent);

    let strings = next();
    let blob: Arc<[u8]> = strings.arg(3).as_blob().unwrap().clone();
    assert!(blob.iter().copied().eq(0..200));
    assert_eq!(strings.arg(5).as_pointer(), Some(0x7fff_dead_beef));
    assert_eq!(strings.arg(7).as_u32(), Some(5));
    assert_eq!(strings.arg(1).as_str(), Some(""));
    assert_eq!(strings.arg(0).as_str(), None);
    assert_eq!(strings.ret.unwrap().as_u64(), Some(u64::MAX));

    let aggregates = next();
    let floats = aggregates.arg(0).as_array().unwrap();
    assert_eq!(floats[2].as_f32(), Some(3.65));
    assert_eq!(aggregates.arg(5).as_f32(), Some(16384.0));
    assert_eq!(aggregates.arg(7).as_u32(), Some(0x4103));
    let signatures = reader.signatures();
    assert_eq!(aggregates.arg(5).enum_name(signatures), Some("GL_LIGHT0"));
    let visual = aggregates.arg(1).as_array().unwrap()[0].as_struct().unwrap();
    let depth = visual.member(signatures, "depth").unwrap();
    assert_eq!(depth.as_i32(), Some(-24));
    assert!(visual.member(signatures, "w").is_none());
}

#[test]
fn signatures_are_numbered_in_order_of_appearance() {
    let outcome = read(&sample::encode(6));
    let indices = outcome.calls.iter().map(|call| call.signature.index());
    assert!(indices.eq([0, 1, 1, 2, 3, 4]));
    let mut reader = open(&sample::encode(6)).unwrap();
    crate::drain(&mut reader);
    let functions = reader.signatures().functions();
    let names = functions.iter().map(|function| &*function.name);
    assert!(names.eq(["glViewport", "lots", "glClear", "glGenTextures", "glXSwapBuffers"]));
    assert_eq!(&*functions[3].arg_names[1], "textures");
}

#[test]
fn backtraces_name_their_frames() {
    let mut reader = open(&sample::encode(5)).unwrap();
    let outcome = crate::drain(&mut reader);
    let frames = outcome.calls[4].backtrace.iter();
    let texts = frames.map(|&frame| reader.signatures().frame(frame).to_string());
    assert!(texts.eq(["game: draw+0x10: game.c:301", "game: draw+0x10: game.c:300"]));
    assert!(outcome.calls[5].backtrace.is_empty());
}

#[test]
fn extreme_integers_survive() {
    const ONE: Function = Function(0, "f", &["x"]);
    let mut encoder = Encoder::new(6);
    for value in [0, 1, 127, 128, 1 << 32, u64::MAX >> 1, u64::MAX] {
        encoder.call(0, &ONE, vec![V::UInt(value)], None);
    }
    for value in [-1, i64::MIN] {
        encoder.call(0, &ONE, vec![V::SInt(value)], None);
    }
    let calls = read(&encoder.bytes).calls;
    let values: Vec<_> = calls.iter().map(|call| call.arg(0).clone()).collect();
    assert_eq!(values[5], Value::UInt(u64::MAX >> 1));
    assert_eq!(values[6], Value::UInt(u64::MAX));
    assert_eq!(values[7..], [Value::SInt(-1), Value::SInt(i64::MIN)]);
}

#[test]
fn arguments_may_come_in_any_order_and_number() {
    let mut encoder = Encoder::new(6);
    let number = encoder.begin_enter(0, &sample::VIEWPORT);
    for index in [5, 2] {
        encoder.arg(index, V::UInt(index));
    }
    encoder.end();
    encoder.leave(number);
    let outcome = read(&encoder.bytes);
    let line = "0 @0 glViewport(x = ?, y = ?, width = 2, height = ?, arg4 = ?, arg5 = 5)";
    assert_eq!(outcome.lines, [line]);
}
