//! Every shader of the project as SPIR-V words, compiled from GLSL while this crate is built.
//!
//! A constant is named after its file: `pass/raster/raster.vert` is [`RASTER_VERT`], `pass/raster/clip.vert`
//! would be `RASTER_CLIP_VERT`.

#[cfg(all(feature = "reload", not(feature = "shaderc")))]
#[path = "../build/options.rs"]
mod options;
#[cfg(feature = "reload")]
pub mod reload;

/// A shader as it is now: without the feature `reload` as it was built.
#[cfg(not(feature = "reload"))]
pub fn current(built: &'static [u32]) -> &'static [u32] {
    built
}
#[cfg(feature = "reload")]
pub use reload::current;

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

/// SPIR-V bytes as the words that Vulkan takes. Little-endian, as `glslc` writes them on every host we build on.
const fn words<const N: usize>(bytes: &[u8]) -> [u32; N] {
    let mut words = [0; N];
    let mut i = 0;
    while i < N {
        words[i] = u32::from_le_bytes([bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]]);
        i += 1;
    }
    words
}

#[cfg(test)]
mod tests {
    #[test]
    fn modules_begin_with_the_magic_number() {
        assert_eq!(super::RASTER_VERT[0], 0x0723_0203);
        assert_eq!(super::RASTER_FRAG[0], 0x0723_0203);
    }
}
