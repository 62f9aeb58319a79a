//! What rasterization reads: a frame's tables, draws, rectangles of pixels.

use afterglow_layout::shared_struct;

shared_struct! {
    /// Where a frame's tables are: device addresses of arrays.
    pub struct FrameRecord {
        /// [`DrawRecord`]s.
        pub draws: u64,
        /// `Transform`s.
        pub transforms: u64,
        /// `Lights`.
        pub lights: u64,
        /// `Material`s.
        pub materials: u64,
        /// `Environment`s.
        pub environments: u64,
        /// `TexGen`s.
        pub texgens: u64,
        /// `TextureMatrices`.
        pub texture_matrices: u64,
        /// `ClipPlanes`.
        pub clip_planes: u64,
        /// `CurrentAttributes`.
        pub current: u64,
        /// [`PixelRecord`]s.
        pub pixels: u64,
        /// Size of the window, pixels.
        pub window_size: [f32; 2],
    }
}

shared_struct! {
    /// What one draw's vertices read: an address and indices into the frame's tables.
    pub struct DrawRecord {
        /// Address of vertex 0.
        pub vertices: u64,
        /// The greatest index that is a vertex; greater ones are taken for it.
        pub last_vertex: u32,
        pub transform: u32,
        pub lights: u32,
        pub material: u32,
        pub environment: u32,
        pub texgen: u32,
        pub texture_matrices: u32,
        pub clip_planes: u32,
        pub current: u32,
        /// Added to the clip coordinate z as a multiple of w, for lines and points, which Vulkan
        /// does not bias.
        pub depth_offset: f32,
    }
}

shared_struct! {
    /// What fragments read most, as push constants: at most 128 bytes.
    pub struct DrawPush {
        /// Address of the [`FrameRecord`].
        pub frame: u64,
        /// Index of the `Environment`, for what follows is not in here.
        pub environment: u32,
        /// Index of the [`PixelRecord`], for rectangles of pixels.
        pub pixels: u32,
        /// A unit's bindless image in the lower 20 bits and its sampler in the upper 12.
        pub textures: [u32; 4],
        pub fog_color: [f32; 4],
        pub fog_density: f32,
        pub fog_end: f32,
        /// 1 / (end - start) of linear fog.
        pub fog_scale: f32,
        pub alpha_reference: f32,
    }
}

shared_struct! {
    /// A rectangle of pixels that becomes fragments (glDrawPixels, glBitmap, glCopyPixels).
    pub struct PixelRecord {
        /// Address of the pixels, a multiple of 4.
        pub source: u64,
        /// Window position of the lower left corner.
        pub position: [f32; 2],
        /// Window pixels for each source pixel.
        pub zoom: [f32; 2],
        /// Source pixels in a row, and rows.
        pub size: [f32; 2],
        /// Pixels from one source row to the next higher one; may be negative.
        pub row_step: i32,
        /// What a source pixel is: a `PIXELS_` constant.
        pub kind: u32,
        /// Depth of the fragments.
        pub depth: f32,
        /// Index of the `CurrentAttributes`.
        pub current: u32,
        /// The bit that a stencil value must have for its fragment to exist; 0 if all exist.
        pub stencil_bit: u32,
        /// Pixels before the lowest row's first one.
        pub first_pixel: u32,
    }
}

shared_struct! {
    /// What a clear that is drawn reads as push constants.
    pub struct ClearPush {
        pub color: [f32; 4],
        /// Depth, 0 to 1.
        pub depth: f32,
    }
}

shared_struct! {
    /// Rows of a rectangle of four-byte texels, to be written in reverse order and resampled, nearest, where the
    /// sizes differ. Sides are at most 32768.
    pub struct FlipRecord {
        /// Address of the rectangle that is read, the highest row first.
        pub source: u64,
        /// Address of the rectangle that is written, the lowest row first.
        pub target: u64,
        /// Texels in a row of the source.
        pub source_width: u32,
        /// Rows of the source.
        pub source_height: u32,
        /// Texels in a row of the target.
        pub width: u32,
        /// Rows of the target.
        pub height: u32,
        /// The first row of the target that is written.
        pub first_row: u32,
        /// How many of them are.
        pub rows: u32,
    }
}

shared_struct! {
    /// Push constants of the pass that reverses rows.
    pub struct FlipPush {
        /// Address of the [`FlipRecord`]s.
        pub records: u64,
        /// 0 for texels copied as they are, else the greatest value of a 24-bit depth that is to become an f32.
        pub depth_maximum: u32,
        /// The index of the first record of this dispatch.
        pub first: u32,
    }
}

shared_struct! {
    /// Push constants of the accumulation buffer's operations.
    pub struct AccumulatePush {
        /// Address of the accumulation buffer: four f32 a pixel, rows of the window from the top.
        pub accumulation: u64,
        /// Address of colours, one word a pixel, tight rows of the rectangle.
        pub colors: u64,
        /// The rectangle's left edge, upper edge, width and height.
        pub rectangle: [u32; 4],
        /// Pixels in a row of the accumulation buffer.
        pub pitch: u32,
        /// An `ACCUMULATE_` constant.
        pub operation: u32,
        /// The operand.
        pub value: f32,
        /// Unused.
        pub padding: u32,
        /// What a clear stores.
        pub clear: [f32; 4],
    }
}

/// What a rectangle's source pixels are, as `PixelRecord::kind` holds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum PixelKind {
    /// Four bytes: red, green, blue, alpha.
    Color = 0,
    /// One byte, zero where there is no fragment.
    Mask = 1,
    /// An f32, drawn with the current colour.
    Depth = 2,
    /// Depth in the lower 24 bits of a word, drawn with the current colour.
    Depth24 = 3,
    /// One byte; one bit of it decides whether there is a fragment.
    Stencil = 4,
}

/// What is done to the accumulation buffer, as `AccumulatePush::operation` holds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum Accumulation {
    /// Adds value * colour.
    Accumulate = 0,
    /// Stores value * colour.
    Load = 1,
    /// Writes value * accumulated to the colours.
    Return = 2,
    /// Multiplies by the value.
    Multiply = 3,
    /// Adds the value.
    Add = 4,
    /// Stores the clear value.
    Clear = 5,
}
