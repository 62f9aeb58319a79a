//! What a context emits: an ordered list of operations, and the tables that they point into.

mod append;
mod blocks;
mod hints;
mod image;
mod range;
mod raster_state;
mod words;

use std::sync::Arc;

pub use blocks::*;
pub use hints::*;
pub use image::*;
pub use range::*;
pub use raster_state::*;
pub use words::*;

/// What a draw's indices connect. Strips, fans, quads and polygons have become triangles whose first
/// vertex is the provoking one; winding is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Topology {
    /// One index each.
    Points,
    /// Two indices each.
    Lines,
    /// Three indices each.
    Triangles,
}

/// Where a draw's vertices and indices are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VertexSource {
    /// In the frame's arena.
    Arena {
        /// First word of vertex 0 in [`Frame::words`].
        first_word: u32,
        /// Number of vertices.
        vertices: u32,
        /// First index in [`Frame::indices`]; indices count from vertex 0.
        first_index: u32,
    },
    /// In a range that outlives the frame.
    Retained {
        /// Index into [`Frame::retained`].
        range: u32,
        /// First index in the range's own indices.
        first_index: u32,
    },
}

/// What is the same for all draws with equal shaders and fixed functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct FixedState {
    /// What is computed.
    pub words: StateWords,
    /// Rasterization and per-fragment operations.
    pub raster: RasterState,
}

/// Viewport and scissor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewport {
    /// glViewport.
    pub rect: Rect,
    /// glDepthRange: near, far, each 0 to 1.
    pub depth_range: [f32; 2],
    /// glScissor, if enabled.
    pub scissor: Option<Rect>,
}

/// Textures of the units; `None` where a unit is off.
pub type Bindings = [Option<TextureBinding>; TEXTURE_UNITS];

/// A draw: vertices and the state that they meet. Every `u32` names an entry of the frame's table
/// of the same name, but for `hint`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Draw {
    pub source: VertexSource,
    pub layout: VertexLayout,
    pub topology: Topology,
    /// Number of indices.
    pub index_count: u32,
    pub fixed: u32,
    pub viewport: u32,
    pub bindings: u32,
    pub transform: u32,
    pub lights: u32,
    pub material: u32,
    pub environment: u32,
    pub texgen: u32,
    pub texture_matrices: u32,
    pub clip_planes: u32,
    pub current: u32,
    /// What the program says of it: 0 is nothing, n the entry n - 1 of [`Frame::hints`].
    pub hint: u32,
}

/// glClear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clear {
    /// Colour, if cleared.
    pub color: Option<[f32; 4]>,
    /// Components that are written, as in [`RasterState::color_mask`].
    pub color_mask: u8,
    /// Depth, if cleared.
    pub depth: Option<f32>,
    /// Stencil value and write mask, if cleared.
    pub stencil: Option<(u32, u32)>,
    /// Only this part of the window.
    pub scissor: Option<Rect>,
}

/// What a rectangle of pixels is written to.
#[derive(Debug, Clone)]
pub enum PixelContent {
    /// RGBA bytes; fragments have this colour and pass through texturing and fog.
    Color(Arc<[u8]>),
    /// One byte a pixel, not zero where the fragment exists (glBitmap); drawn in the current raster colour.
    Mask(Arc<[u8]>),
    /// One f32 a pixel, drawn with the current raster colour.
    Depth(Arc<[f32]>),
    /// One byte a pixel.
    Stencil(Arc<[u8]>),
}

/// glDrawPixels and glBitmap: rows from the lowest upward.
#[derive(Debug, Clone)]
pub struct PixelRectangle {
    /// The pixels.
    pub content: PixelContent,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Window position of the lower left corner.
    pub position: [f32; 2],
    /// Depth of the fragments, 0 to 1.
    pub depth: f32,
    /// glPixelZoom.
    pub zoom: [f32; 2],
    /// State, as in [`Draw`]; `current` holds the raster position's colour and texture coordinates.
    pub fixed: u32,
    /// As in [`Draw`].
    pub viewport: u32,
    /// As in [`Draw`].
    pub bindings: u32,
    /// As in [`Draw`].
    pub environment: u32,
    /// As in [`Draw`].
    pub current: u32,
}

/// Which buffer pixels are copied or read from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PixelBuffer {
    /// Colour.
    Color,
    /// Depth.
    Depth,
    /// Stencil.
    Stencil,
}

/// glCopyPixels.
#[derive(Debug, Clone, Copy)]
pub struct PixelCopy {
    /// Which buffer.
    pub buffer: PixelBuffer,
    /// From where in the window.
    pub source: Rect,
    /// Window position of the copy's lower left corner.
    pub position: [f32; 2],
    /// Depth of the fragments unless depth is copied, 0 to 1.
    pub depth: f32,
    /// glPixelZoom.
    pub zoom: [f32; 2],
    /// As in [`PixelRectangle`].
    pub fixed: u32,
    /// As in [`Draw`].
    pub viewport: u32,
    /// As in [`Draw`].
    pub bindings: u32,
    /// As in [`Draw`].
    pub environment: u32,
    /// As in [`PixelRectangle`].
    pub current: u32,
}

/// glAccum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AccumulateOp {
    Accumulate,
    Load,
    Return,
    Multiply,
    Add,
}

/// One step of a frame.
#[derive(Debug, Clone)]
pub enum Operation {
    /// glClear.
    Clear(Clear),
    /// glClear of the accumulation buffer.
    ClearAccumulation([f32; 4]),
    /// Anything made of vertices.
    Draw(Draw),
    /// glDrawPixels, glBitmap.
    Pixels(Box<PixelRectangle>),
    /// glCopyPixels.
    CopyPixels(Box<PixelCopy>),
    /// An image comes into being, its texels undefined.
    DefineImage {
        /// Its name.
        image: ImageKey,
        /// Its shape.
        shape: ImageShape,
    },
    /// Texels from the program.
    Upload(ImageUpload),
    /// Texels from the frame buffer.
    CopyToImage(ImageCopy),
    /// Texels from another image, same region of both (a texture was reshaped).
    CopyImage {
        /// From.
        from: ImageKey,
        /// Region of `from`.
        region: Region,
        /// To.
        to: ImageKey,
        /// Level of `to`.
        to_level: u32,
    },
    /// The image will not be named again.
    DropImage(ImageKey),
    /// glAccum, on `Rect` of the window (the scissor) if any.
    Accumulate(AccumulateOp, f32, Option<Rect>),
    /// Samples that pass are counted from here.
    BeginQuery(u32),
    /// To here.
    EndQuery(u32),
}

/// Ordered operations and the tables that they name.
#[derive(Debug, Default)]
pub struct Frame {
    /// Size of the drawable, pixels.
    pub size: (u32, u32),
    /// The device that its images are on, as [`Backend::device`](crate::backend::Backend::device) said when it was begun.
    pub device: u64,
    /// What happens, in order.
    pub operations: Vec<Operation>,
    /// Vertices of this frame.
    pub words: Vec<u32>,
    /// Indices of this frame.
    pub indices: Vec<u32>,
    /// Where in `indices` a primitive of the program continues a draw, in order: programs' own seams within draws.
    pub seams: Vec<u32>,
    /// Ranges that outlive the frame.
    pub retained: Vec<Arc<RetainedRange>>,
    pub fixed: Vec<FixedState>,
    pub viewports: Vec<Viewport>,
    pub bindings: Vec<Bindings>,
    pub transforms: Vec<Transform>,
    pub lights: Vec<Lights>,
    pub materials: Vec<Material>,
    pub environments: Vec<Environment>,
    pub texgens: Vec<TexGen>,
    pub texture_matrices: Vec<TextureMatrices>,
    pub clip_planes: Vec<ClipPlanes>,
    pub current: Vec<CurrentAttributes>,
    /// What is said of draws; empty in frames of programs that say nothing.
    pub hints: Vec<Hint>,
    /// What is said of the frame.
    pub scene_hints: SceneHints,
}

impl Frame {
    /// Empties the frame and keeps its memory, to be filled again.
    pub fn clear(&mut self) {
        self.operations.clear();
        self.words.clear();
        self.indices.clear();
        self.seams.clear();
        self.retained.clear();
        self.fixed.clear();
        self.viewports.clear();
        self.bindings.clear();
        self.transforms.clear();
        self.lights.clear();
        self.materials.clear();
        self.environments.clear();
        self.texgens.clear();
        self.texture_matrices.clear();
        self.clip_planes.clear();
        self.current.clear();
        self.hints.clear();
        self.scene_hints.clear();
    }

    /// Leaves out all but what images are made of from the program's memory: draws name images that are lost.
    pub fn keep_images(&mut self) {
        self.operations.retain(|operation| {
            matches!(
                operation,
                Operation::DefineImage { .. }
                    | Operation::Upload(_)
                    | Operation::CopyImage { .. }
                    | Operation::DropImage(_)
            )
        });
    }

    /// Leaves out what only draws: nobody will see it. A frame whose pixels become texels is drawn all the same.
    pub fn keep_state(&mut self) {
        let reads = |operation: &Operation| matches!(operation, Operation::CopyToImage(_));
        if !self.operations.iter().any(reads) {
            self.keep_images();
        }
    }

    /// The draws with their places among the operations.
    pub fn draws(&self) -> impl Iterator<Item = (usize, &Draw)> {
        self.operations.iter().enumerate().filter_map(|(i, op)| match op {
            Operation::Draw(draw) => Some((i, draw)),
            _ => None,
        })
    }

    /// What the program says of a draw, if anything.
    pub fn hint(&self, draw: &Draw) -> Option<&Hint> {
        self.hints.get((draw.hint as usize).checked_sub(1)?)
    }

    /// Words of the draw's vertices and its indices.
    pub fn geometry(&self, draw: &Draw) -> (&[u32], &[u32]) {
        let count = draw.index_count as usize;
        match draw.source {
            VertexSource::Arena { first_word, vertices, first_index } => {
                let words = vertices as usize * draw.layout.stride();
                (&self.words[first_word as usize..][..words], &self.indices[first_index as usize..][..count])
            }
            VertexSource::Retained { range, first_index } => {
                let range = &self.retained[range as usize];
                (&range.words, &range.indices[first_index as usize..][..count])
            }
        }
    }
}
