//! GLSL declarations of what Rust and shaders share. To share one more structure, add it to a list in
//! `lists.rs`.

mod constants;
#[cfg(test)]
mod layout_tests;
mod lists;

use afterglow_gl::frame::{CLIP_PLANES, GlobalWords, LIGHTS, SLOTS, STATE_WORDS, TEXTURE_UNITS, UnitWords};
use afterglow_layout::StructDescription;
use afterglow_records::{
    BAKE_COLORS, BAKE_DOUBLED_LAYER, BAKE_LAYER, BAKE_MASK, BAKE_NONE, BAKE_SHIFT, BLOCK_STEP, BlendWord,
    FEATURES, LIGHT_FAR, LIGHT_LEAF, LIGHT_POINT, LIGHT_SPHERE, LIGHT_TRIANGLE, LIGHT_TRIANGLE_BOTH,
    MASK_MOVING, MASK_STATIC, MASK_VIEW_MODEL, MEMBER_OF_LIGHTS, MEMBER_SHIFT, MapWord, NO_LIGHT, NO_MAP,
    NO_TRAIL, SKY_EDGE, SKY_LEVELS, STRATUM_EDGE, SURFACE_CLASSES, TRACE_INDEPENDENT, TRACE_PARALLEL,
    TRACE_ROULETTE, TRACE_SMOOTH_EDGES, TRACE_UNIFORM_LIGHTS, TRACE_UNLIMITED, WHITE_ALBEDO,
};

use self::constants::{enumerations, record_enumerations, surface_enumerations};

const NOTICE: &str =
    "// Written by afterglow-gen (./x gen) from the declarations in Rust; not to be edited.\n";

/// The packed state words, and the numbers that their fields hold.
pub fn state_words() -> String {
    let mut text = String::new();
    text += &defines(&[
        ("TEXTURE_UNITS", TEXTURE_UNITS),
        ("LIGHTS", LIGHTS),
        ("CLIP_PLANES", CLIP_PLANES),
        ("SLOTS", SLOTS),
    ]);
    text += "\n// State outside the texture units: words 0 and up of all state words.\n";
    text += &GlobalWords::description().glsl();
    text += "\n// State of one texture unit, from word UNIT_FIRST_WORD(unit) of all state words.\n";
    text += &UnitWords::description().glsl();
    text += "#define UNIT_FIRST_WORD(unit) (STATE_WORDS + UNIT_WORDS * (unit))\n";
    text += &defines(&[("ALL_STATE_WORDS", STATE_WORDS)]);
    text += "\n// Layout of a vertex: 3 bits of FORMAT a slot.\n";
    text += "#define layout_format(w, slot) (((w) >> (3u * (slot))) & 7u)\n\n";
    text += &enumerations();
    guarded("GENERATED_STATE_WORDS", &text)
}

/// The blocks of numbers that a draw names by index. Arrays of them need the scalar block layout.
pub fn gl_blocks() -> String {
    guarded("GENERATED_BLOCKS", &structures(&lists::gl_blocks()))
}

/// What the renderer writes for its shaders, beside the frame's own blocks.
pub fn records() -> String {
    let mut text = structures(&lists::records()) + "\n" + &record_enumerations();
    text.push('\n');
    for (name, value) in [
        ("WHITE_ALBEDO", WHITE_ALBEDO),
        ("BAKE_SHIFT", BAKE_SHIFT),
        ("BAKE_MASK", BAKE_MASK),
        ("BAKE_NONE", BAKE_NONE),
        ("BAKE_LAYER", BAKE_LAYER),
        ("BAKE_DOUBLED_LAYER", BAKE_DOUBLED_LAYER),
        ("BAKE_COLORS", BAKE_COLORS),
    ] {
        text += &format!("#define {name} {value}u\n");
    }
    guarded("GENERATED_RECORDS", &text)
}

/// What path tracing's passes share.
pub fn pathtrace() -> String {
    let masks = [
        ("BLOCK_STEP", BLOCK_STEP),
        ("FEATURES", FEATURES),
        ("STRATUM_EDGE", STRATUM_EDGE),
        ("SURFACE_CLASSES", SURFACE_CLASSES),
        ("MASK_STATIC", MASK_STATIC),
        ("MASK_MOVING", MASK_MOVING),
        ("MASK_VIEW_MODEL", MASK_VIEW_MODEL),
        ("MEMBER_SHIFT", MEMBER_SHIFT),
        ("NO_MAP", NO_MAP),
        ("LIGHT_FAR", LIGHT_FAR),
        ("LIGHT_LEAF", LIGHT_LEAF),
        ("LIGHT_POINT", LIGHT_POINT),
        ("LIGHT_SPHERE", LIGHT_SPHERE),
        ("LIGHT_TRIANGLE", LIGHT_TRIANGLE),
        ("LIGHT_TRIANGLE_BOTH", LIGHT_TRIANGLE_BOTH),
        ("MEMBER_OF_LIGHTS", MEMBER_OF_LIGHTS),
        ("NO_LIGHT", NO_LIGHT),
        ("NO_TRAIL", NO_TRAIL),
        ("SKY_EDGE", SKY_EDGE),
        ("SKY_LEVELS", SKY_LEVELS),
        ("TRACE_INDEPENDENT", TRACE_INDEPENDENT),
        ("TRACE_ROULETTE", TRACE_ROULETTE),
        ("TRACE_PARALLEL", TRACE_PARALLEL),
        ("TRACE_SMOOTH_EDGES", TRACE_SMOOTH_EDGES),
        ("TRACE_UNIFORM_LIGHTS", TRACE_UNIFORM_LIGHTS),
        ("TRACE_UNLIMITED", TRACE_UNLIMITED),
    ];
    let mut text = structures(&lists::pathtrace())
        + "\n"
        + &BlendWord::description().glsl()
        + &MapWord::description().glsl();
    for (name, value) in masks {
        text += &format!("#define {name} {value}u\n");
    }
    text += "\n";
    text += &surface_enumerations();
    guarded("GENERATED_PATHTRACE", &text)
}

/// Declarations, each guarded by itself: several files may declare a structure.
fn structures(descriptions: &[StructDescription]) -> String {
    let guarded = |structure: &StructDescription| {
        let guard = format!("STRUCT_{}", structure.name);
        format!("#ifndef {guard}\n#define {guard}\n{}#endif\n", structure.glsl())
    };
    descriptions.iter().map(guarded).collect::<Vec<_>>().join("\n")
}

fn defines(values: &[(&str, usize)]) -> String {
    values.iter().map(|(name, value)| format!("#define {name} {value}\n")).collect()
}

fn guarded(guard: &str, text: &str) -> String {
    format!("{NOTICE}#ifndef {guard}\n#define {guard}\n\n{text}\n#endif\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_structure_is_declared_once_and_before_its_use() {
        let text = gl_blocks();
        for line in text.lines().filter(|line| line.starts_with("struct ")) {
            assert_eq!(text.matches(line).count(), 1, "{line}");
        }
        let place = |name: &str| text.find(&format!("struct {name} ")).unwrap();
        assert!(place("Light") < place("Lights"));
        assert!(place("Matrix") < place("TextureMatrices"));
    }

    #[test]
    fn fields_have_words_and_accessors() {
        let text = state_words();
        assert!(text.contains("#define UNIT_ENV_MODE_WORD 0\n"), "{text}");
        assert!(text.contains("#define unit_target(w) (((w) >> 0) & 0x3u)\n"));
        assert!(text.contains("#define ENV_MODE_COMBINE 5u\n"));
        assert!(text.contains("#define COMBINE_SOURCE_ONE 5u\n"));
    }
}
