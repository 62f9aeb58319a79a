//! Damaged traces: a typed error after the calls before the damage, and never a panic.

use afterglow_trace::format::limits;
use afterglow_trace::{Damage, TraceEnd, TraceError};
use proptest::prelude::*;

use crate::encoder::{Encoder, Function, V};
use crate::{containers, drain, open, read, sample};

const ONE: Function = Function(0, "f", &["x"]);

/// The damage that is found where `write` writes after a good call, and where the call after it is left open.
fn damage_of(write: impl Fn(&mut Encoder)) -> Damage {
    let mut encoder = Encoder::new(6);
    encoder.call(0, &ONE, vec![V::UInt(1)], None);
    encoder.enter(1, &ONE, vec![V::UInt(2)]);
    write(&mut encoder);
    let outcome = read(&encoder.bytes);
    let expected = ["0 @0 f(x = 1)", "1 @1 f(x = 2) // incomplete"];
    assert_eq!(outcome.lines, expected);
    match outcome.end {
        Err(TraceError::Damaged { damage, offset, .. }) => {
            assert!(offset <= encoder.bytes.len() as u64);
            damage
        }
        other => panic!("{other:?}"),
    }
}

/// The damage of a value.
fn damage_of_value(write: impl Fn(&mut Encoder)) -> Damage {
    damage_of(|encoder| {
        encoder.begin_enter(0, &ONE);
        encoder.bytes.extend([1, 0]);
        write(encoder);
    })
}

#[test]
fn unknown_tags_are_damage() {
    assert_eq!(damage_of(|e| e.bytes.push(9)), Damage::Event(9));
    assert_eq!(damage_of(|e| e.bytes.extend([1, 1, 6])), Damage::Detail(6));
    // A detail of old versions only.
    assert_eq!(damage_of(|e| e.bytes.extend([1, 1, 3])), Damage::Detail(3));
    assert_eq!(damage_of_value(|e| e.bytes.push(16)), Damage::ValueType(16));
    // A new enumeration without names, and a float of it.
    let float_enum = |e: &mut Encoder| e.bytes.extend([9, 0, 0, 5]);
    assert_eq!(damage_of_value(float_enum), Damage::EnumerantType(5));
    let frame = |e: &mut Encoder| e.bytes.extend([1, 1, 4, 1, 0, 6]);
    assert_eq!(damage_of(frame), Damage::FrameDetail(6));
}

#[test]
fn overlong_integers_are_damage() {
    let eleven = [0x80; 11];
    assert_eq!(
        damage_of(|e| {
            e.bytes.push(1);
            e.bytes.extend(eleven);
        }),
        Damage::Integer
    );
    let too_large = |e: &mut Encoder| {
        e.bytes.push(4);
        e.bytes.extend([0xff; 9]);
        e.bytes.push(2);
    };
    assert_eq!(damage_of_value(too_large), Damage::Integer);
}

#[test]
fn calls_that_were_never_entered_are_damage() {
    assert_eq!(damage_of(|e| e.begin_leave(2)), Damage::UnknownCall(2));
    let far = u64::from(u32::MAX) + 1;
    assert_eq!(damage_of(|e| e.begin_leave(far)), Damage::UnknownCall(far));
}

#[test]
fn lengths_beyond_the_limits_are_damage() {
    let length = 1 << 40;
    let cases = [
        (7, Damage::StringLength(length)),
        (8, Damage::BlobLength(length)),
        (11, Damage::EventSize),
        (15, Damage::StringLength(length)),
    ];
    for (tag, damage) in cases {
        assert_eq!(damage_of_value(|e| e.tagged(tag, length)), damage);
    }
    let argument = |e: &mut Encoder| {
        e.begin_enter(0, &ONE);
        e.arg(limits::ARGUMENTS, V::Null);
    };
    let expected = Damage::ArgumentNumber(limits::ARGUMENTS);
    assert_eq!(damage_of(argument), expected);
    let backtrace = |e: &mut Encoder| {
        e.begin_leave(1);
        e.tagged(4, length);
    };
    assert_eq!(damage_of(backtrace), Damage::BacktraceLength(length));
    let function = |e: &mut Encoder| {
        e.bytes.extend([0, 0, 50, 1, b'g']);
        e.uint(length);
    };
    assert_eq!(damage_of(function), Damage::SignatureSize);
}

#[test]
fn deep_nesting_is_damage() {
    for opening in [&[11, 1][..], &[14]] {
        let nested = |e: &mut Encoder| {
            for _ in 0..100_000 {
                e.bytes.extend(opening);
            }
        };
        assert_eq!(damage_of_value(nested), Damage::Depth);
    }
}

#[test]
fn many_values_in_small_arrays_are_damage_too() {
    let row = 1 << 12;
    let arrays = |e: &mut Encoder| {
        e.tagged(11, limits::EVENT_VALUES / row + 1);
        for _ in 0..limits::EVENT_VALUES / row + 1 {
            e.tagged(11, row);
            let end = e.bytes.len() + row as usize;
            e.bytes.resize(end, 0);
        }
    };
    assert_eq!(damage_of_value(arrays), Damage::EventSize);
}

#[test]
fn a_length_alone_takes_no_memory() {
    // Within the limits, but there are no such data.
    let lengths = [(7, limits::STRING_BYTES), (8, limits::BLOB_BYTES), (11, 1 << 21), (15, 1 << 25)];
    for (tag, length) in lengths {
        let mut encoder = Encoder::new(6);
        encoder.enter(0, &ONE, vec![V::UInt(1)]);
        for _ in 0..2000 {
            encoder.begin_enter(0, &ONE);
            encoder.bytes.extend([1, 0]);
            encoder.tagged(tag, length);
        }
        let outcome = read(&encoder.bytes);
        assert_eq!(outcome.lines.len(), 1);
        assert!(outcome.end.is_err() || !outcome.end.unwrap().is_clean());
    }
}

/// Reads whatever it is, to its end.
fn survive(bytes: &[u8]) {
    if let Ok(mut reader) = open(bytes) {
        let outcome = drain(&mut reader);
        assert!(outcome.calls.len() <= 100_000);
        if let Ok(TraceEnd::Failed { .. }) = outcome.end {
            panic!("failed without an error");
        }
    }
}

proptest! {
    #[test]
    fn damaged_bytes_never_panic(
        version in sample::VERSIONS,
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut bytes = sample::encode(version);
        for (index, byte) in &damage {
            let at = index.index(bytes.len());
            bytes[at] = *byte;
        }
        survive(&containers::snappy(&bytes, 100));
    }

    #[test]
    fn damaged_containers_never_panic(
        which in 0usize..6,
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut file = containers::all(&sample::encode(6)).swap_remove(which).1;
        for (index, byte) in &damage {
            let at = index.index(file.len());
            file[at] = *byte;
        }
        survive(&file);
    }

    #[test]
    fn anything_at_all_never_panics(
        start in prop::sample::select(vec![&b""[..], b"at", b"\x06\x06\0\0", b"\x04\0", b"\x1f\x8b\x08\0", b"\x78\x9c"]),
        bytes in prop::collection::vec(any::<u8>(), 0..2000),
    ) {
        survive(&[start, &bytes].concat());
        survive(&containers::snappy(&[&b"\x06\x06\0"[..], &bytes].concat(), 1 << 20));
    }

    #[test]
    fn small_tags_never_panic(
        version in 0u8..6,
        bytes in prop::collection::vec(0u8..17, 0..400),
    ) {
        survive(&containers::snappy(&[&[version], &bytes[..]].concat(), 1 << 20));
    }
}
