//! Rust enumerations whose numbers shaders read, as GLSL constants.

use afterglow_gl::frame::{
    BaseFormat, BlendEquation, BlendFactor, CombineFunction, CombineSource, Dimension, EnvMode, Format, Slot,
};
use afterglow_records::{Accumulation, Paint, PixelKind, SurfaceKind};

/// `#define PREFIX_VARIANT NUMBERu` of each variant. The list must be complete to compile.
macro_rules! constants {
    ($type:ident, $prefix:literal: $($variant:ident),* $(,)?) => {{
        // Fails to compile when the enumeration has a variant that the list lacks.
        fn number(value: $type) -> u32 {
            match value { $($type::$variant => $type::$variant as u32,)* }
        }
        constants($prefix, &[$((stringify!($variant), number($type::$variant)),)*])
    }};
}

/// All enumerations that packed words and layouts hold.
pub fn enumerations() -> String {
    [
        constants!(BaseFormat, "BASE_FORMAT": Alpha, Luminance, LuminanceAlpha, Intensity, Rgb, Rgba, Depth),
        constants!(EnvMode, "ENV_MODE": Modulate, Decal, Blend, Replace, Add, Combine),
        constants!(CombineFunction, "COMBINE":
            Replace, Modulate, Add, AddSigned, Interpolate, Subtract, Dot3Rgb, Dot3Rgba),
        constants!(CombineSource, "COMBINE_SOURCE":
            Previous, Texture, Constant, Primary, Zero, One, Texture0),
        constants!(Dimension, "TARGET": D2, D3, Cube),
        constants!(Slot, "SLOT": Position, Normal, Color, Secondary, Fog, Texture0),
        constants!(Format, "FORMAT": Absent, F1, F2, F3, F4, Unorm8x4),
    ]
    .join("\n")
}

/// The enumerations that records hold.
pub fn record_enumerations() -> String {
    [
        constants!(PixelKind, "PIXELS": Color, Mask, Depth, Depth24, Stencil),
        constants!(Accumulation, "ACCUMULATE": Accumulate, Load, Return, Multiply, Add, Clear),
    ]
    .join("\n")
}

/// The enumerations of path tracing's records.
pub fn surface_enumerations() -> String {
    [
        constants!(SurfaceKind, "SURFACE": None, Lit, Catcher, Baked, BakedMover),
        constants!(
            Paint, "PAINT": Picture, Kind, Normal, Albedo, Direct, Indirect, Sky, Specular, Motion, Variance, Gradient, History,
            Edges
        ),
        constants!(BlendFactor, "BLEND_FACTOR":
            Zero, One, SourceColor, OneMinusSourceColor, DestinationColor, OneMinusDestinationColor, SourceAlpha,
            OneMinusSourceAlpha, DestinationAlpha, OneMinusDestinationAlpha, SourceAlphaSaturate, ConstantColor,
            OneMinusConstantColor, ConstantAlpha, OneMinusConstantAlpha),
        constants!(BlendEquation, "BLEND_EQUATION": Add, Subtract, ReverseSubtract, Min, Max),
    ]
    .join("\n")
}

fn constants(prefix: &str, variants: &[(&str, u32)]) -> String {
    variants
        .iter()
        .map(|(variant, number)| format!("#define {prefix}_{} {number}u\n", screaming(variant)))
        .collect()
}

/// `LuminanceAlpha` as `LUMINANCE_ALPHA`.
fn screaming(name: &str) -> String {
    let mut text = String::new();
    for (i, letter) in name.char_indices() {
        if i > 0 && letter.is_ascii_uppercase() {
            text.push('_');
        }
        text.push(letter.to_ascii_uppercase());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_split_at_capitals() {
        assert_eq!(screaming("LuminanceAlpha"), "LUMINANCE_ALPHA");
        assert_eq!(screaming("Texture0"), "TEXTURE0");
        assert_eq!(screaming("D2"), "D2");
    }
}
