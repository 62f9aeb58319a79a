//! What denoisers read and write: of each texel of light, of each stratum of them, of each block.

use afterglow_layout::shared_struct;

/// Texels of light along a side of a stratum, of which one is traced with older numbers.
pub const STRATUM_EDGE: u32 = 3;
/// Texels of light between the middles of blocks in which light is fitted; each reaches as far to every side.
pub const BLOCK_STEP: u32 = 16;
/// Classes of surfaces whose light is not mixed (see guide.glsl): 1 and so on.
pub const SURFACE_CLASSES: u32 = 3;
/// What light is fitted to: a constant, normal, position, and the squares of positions.
pub const FEATURES: u32 = 10;

shared_struct! {
    /// Light of a texel on its way through a denoiser, before it meets albedo; the deviations of all texels lie behind all else of them (see channels.glsl).
    pub struct ChannelTexel {
        /// Direct, specular and indirect light, nine bits a colour and a shared exponent of five.
        pub colors: [u32; 3],
        /// The second band, three snorm8 of four times the luminance of the first, and how far the specular lobe's ray went, a
        /// logarithm in a byte.
        pub towards: u32,
        /// Standard deviations of the luminance of direct, indirect and specular light, such logarithms.
        pub deviations: u32,
    }
}

shared_struct! {
    /// What denoisers know of what a texel of light shows.
    pub struct GuideTexel {
        /// Distance along the view; 0 where nothing is seen.
        pub depth: f32,
        /// Shading normal, octahedral, two snorm16.
        pub normal: u32,
        /// From the lowest bit: three times six bits of frames that direct, indirect and specular light were gathered over, two
        /// bits for kinds of surfaces that must not be mixed, four of roughness, seven of what moves, one of texels that may have more
        /// samples (see guide.glsl).
        pub bits: u32,
    }
}

shared_struct! {
    /// Where in the frame before was what a texel of light shows.
    pub struct MotionTexel {
        /// How far from its place now, texels to the right and down, two half floats.
        pub offset: u32,
        /// Its distance along the view then; 0 if it was not there.
        pub depth: f32,
    }
}

shared_struct! {
    /// Of three by three texels of light the one that is traced with the numbers that it was traced with in the frame before.
    pub struct StratumTexel {
        /// Which one, row by row; 9 if none.
        pub chosen: u32,
        /// The texel where it was.
        pub before: u32,
        /// Luminance of direct, indirect and specular light there, as [`LuminanceTexel`] has it.
        pub luminance: u32,
    }
}

shared_struct! {
    /// How much light has changed since the frame before.
    pub struct GradientTexel {
        /// Six half floats: the change of luminance of direct, indirect and specular light, and the greater of both luminances.
        pub halves: [u32; 3],
    }
}

shared_struct! {
    /// What a feature of surfaces brings to light, linear RGB, and to the second band of indirect light.
    pub struct FeatureFit {
        pub direct: [f32; 3],
        pub indirect: [f32; 3],
        pub specular: [f32; 3],
        pub towards: [f32; 3],
    }
}

shared_struct! {
    /// Light of a block of texels as a function of what surfaces are (see fits.glsl).
    pub struct FitRecord {
        /// The middle of the block's normals, the middle of its positions, and by what these are multiplied then.
        pub normal: [f32; 3],
        pub position: [f32; 3],
        pub scale: [f32; 3],
        /// A constant, normal, position, and its square.
        pub features: [FeatureFit; FEATURES as usize],
    }
}

shared_struct! {
    /// Luminance of a texel's light as it was traced.
    pub struct LuminanceTexel {
        /// Direct, indirect, specular, nine bits each, an exponent of four, and a bit that says that older numbers were used.
        pub word: u32,
    }
}
