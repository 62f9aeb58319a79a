//! A small trace that holds everything the format knows, and what it should read as.

use crate::encoder::{Encoder, Function, V};

pub const VIEWPORT: Function = Function(7, "glViewport", &["x", "y", "width", "height"]);
pub const CLEAR: Function = Function(0, "glClear", &["mask"]);
pub const GEN_TEXTURES: Function = Function(70_000, "glGenTextures", &["n", "textures"]);
pub const SWAP: Function = Function(3, "glXSwapBuffers", &["dpy", "drawable"]);
const LOTS: Function = Function(1, "lots", &["a", "b", "c", "d", "e", "f", "g", "h"]);

pub const ENUM: &[(&str, i64)] = &[("GL_ZERO", 0), ("GL_LIGHT0", 0x4000), ("GL_NEG", -2)];
pub const BITS: &[(&str, u64)] = &[("GL_DEPTH", 0x100), ("GL_COLOR", 0x4000)];
pub const VISUAL: &[&str] = &["id", "", "depth"];
const SIZE: &[&str] = &["w", "h"];

/// All versions.
pub const VERSIONS: std::ops::RangeInclusive<u64> = 0..=6;

fn strings() -> Vec<V> {
    vec![
        V::Str(b"say \"hi\" \\\n\x01\xe9"),
        V::Str(b""),
        V::WStr(&[0x57, 0x20ac]),
        V::Blob((0..200).collect()),
        V::Blob(Vec::new()),
        V::Opaque(0x7fff_dead_beef),
        V::Null,
        V::Repr(Box::new([V::Str(b"five"), V::UInt(5)])),
    ]
}

fn aggregates() -> Vec<V> {
    let size = V::Struct(9, "Size", SIZE, vec![V::UInt(640), V::UInt(480)]);
    let visual = V::Struct(2, "Visual", VISUAL, vec![V::UInt(1), size, V::SInt(-24)]);
    vec![
        V::Array(vec![V::Float(0.5), V::Double(1e-9), V::Float(3.65)]),
        V::Array(vec![visual]),
        V::Array(Vec::new()),
        V::Bool(true),
        V::Bool(false),
        V::Enum(4, ENUM, 0x4000),
        V::Enum(4, ENUM, -2),
        V::Bitmask(0, BITS, 0x4103),
    ]
}

/// Writes the sample in a version of the format.
pub fn encode(version: u64) -> Vec<u8> {
    let mut encoder = Encoder::new(version);
    let size = [0, 0, 640, 480];
    encoder.call(0, &VIEWPORT, size.map(V::UInt).into(), None);
    encoder.call(0, &LOTS, strings(), Some(V::UInt(u64::MAX)));
    encoder.call(1, &LOTS, aggregates(), Some(V::Enum(4, ENUM, 0)));

    let clear = encoder.begin_enter(1, &CLEAR);
    encoder.fake();
    encoder.arg(0, V::Bitmask(0, BITS, 0x4100));
    encoder.end();
    let textures = encoder.begin_enter(0, &GEN_TEXTURES);
    if version >= 5 {
        encoder.backtrace(&[1, 0]);
    }
    encoder.arg(0, V::UInt(1));
    encoder.end();
    encoder.begin_leave(textures);
    encoder.arg(1, V::Array(vec![V::UInt(12)]));
    encoder.end();
    encoder.leave(clear);
    encoder.call(0, &SWAP, vec![V::Opaque(16)], None);
    encoder.bytes
}

/// The sample's calls.
pub fn lines() -> Vec<String> {
    [
        "0 @0 glViewport(x = 0, y = 0, width = 640, height = 480)",
        concat!(
            r#"1 @0 lots(a = "say \"hi\" \\\n\001\351", b = "", c = L"W\u{20ac}", d = blob(200), e = blob(0), "#,
            r#"f = 0x7fffdeadbeef, g = NULL, h = "five") = 18446744073709551615"#
        ),
        concat!(
            "2 @1 lots(a = {0.5, 1e-09, 3.65}, b = &{id = 1, w = 640, h = 480, depth = -24}, c = {}, d = true, ",
            "e = false, f = GL_LIGHT0, g = GL_NEG, h = GL_DEPTH | GL_COLOR | 0x3) = GL_ZERO"
        ),
        "3 @1 glClear(mask = GL_DEPTH | GL_COLOR) // fake",
        "4 @0 glGenTextures(n = 1, textures = &12)",
        "5 @0 glXSwapBuffers(dpy = 0x10, drawable = ?)",
    ]
    .map(String::from)
    .into()
}
