//! What tests share: a device under validation, and frames built by hand.

use std::sync::{Mutex, OnceLock, PoisonError};

use afterglow_gl::frame::{
    BaseFormat, Bindings, Clear, Compare, Cull, CurrentAttributes, Dimension, Draw, Environment, FixedState,
    Format, Frame, ImageKey, ImageShape, ImageUpload, Operation, RasterState, Rect, Region, Sampler, Slot,
    StateWords, TexelFormat, TextureBinding, Topology, Transform, VertexLayout, VertexSource, Viewport, Wrap,
};
use afterglow_gpu::{Gpu, GpuOptions};
use bytemuck::Zeroable;

use crate::{RenderOptions, Renderer};

pub(crate) const IDENTITY: [[f32; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

pub(crate) const WHITE: [u8; 4] = [255; 4];
pub(crate) const RED: [u8; 4] = [255, 0, 0, 255];
pub(crate) const GREEN: [u8; 4] = [0, 255, 0, 255];
pub(crate) const BLUE: [u8; 4] = [0, 0, 255, 255];
pub(crate) const BLACK: [u8; 4] = [0, 0, 0, 255];

/// Positions of three floats and colours of four bytes.
pub(crate) const POSITION_COLOR: VertexLayout =
    VertexLayout(0).with(Slot::Position as usize, Format::F3).with(Slot::Color as usize, Format::Unorm8x4);

/// The device of all tests.
pub(crate) fn gpu() -> Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| Gpu::new(&GpuOptions::for_tests()).unwrap()).clone()
}

/// A renderer on the device of all tests.
pub(crate) fn renderer() -> Renderer {
    Renderer::new(&gpu(), &RenderOptions::default()).unwrap()
}

/// Fails if the validation layer has found anything, in whichever test.
pub(crate) fn assert_valid() {
    let gpu = gpu();
    assert_eq!(gpu.validation_count(), 0, "{:#?}", gpu.validation_messages());
}

/// OpenGL's initial state of fragments: everything off.
pub(crate) fn raster() -> RasterState {
    RasterState {
        blend: None,
        logic_op: None,
        color_mask: 0xf,
        depth: None,
        stencil: None,
        cull: Cull::None,
        front_ccw: true,
        depth_bias: None,
        line_width: 1.0.into(),
        line_stipple: None,
    }
}

/// Words of the initial state.
pub(crate) fn words() -> StateWords {
    let mut words = StateWords::default();
    words.global.set_alpha_func(Compare::Always as u32);
    words
}

/// Nearest texels of level 0, repeated.
pub(crate) fn nearest() -> Sampler {
    Sampler {
        mag_linear: false,
        min_linear: false,
        mip_linear: None,
        wrap: [Wrap::Repeat; 3],
        min_lod: (-1000.0).into(),
        max_lod: 1000.0.into(),
        border_color: [0.0.into(); 4],
        anisotropy: 1.0.into(),
        compare: None,
    }
}

/// A frame in the making. Draws take the state that is set when they are added.
pub(crate) struct FrameBuilder {
    pub(crate) frame: Frame,
    pub(crate) fixed: FixedState,
    pub(crate) viewport: Viewport,
    pub(crate) bindings: Bindings,
    pub(crate) transform: Transform,
    pub(crate) environment: Environment,
    pub(crate) current: CurrentAttributes,
}

impl FrameBuilder {
    pub(crate) fn new(width: u32, height: u32) -> Self {
        Self {
            frame: Frame { size: (width, height), ..Frame::default() },
            fixed: FixedState { words: words(), raster: raster() },
            viewport: Viewport {
                rect: Rect { x: 0, y: 0, width: width as i32, height: height as i32 },
                depth_range: [0.0, 1.0],
                scissor: None,
            },
            bindings: [None; 4],
            transform: Transform {
                modelview: IDENTITY,
                projection: IDENTITY,
                modelview_projection: IDENTITY,
                normal: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            },
            environment: Environment {
                point_size: 1.0,
                point_size_max: 64.0,
                point_attenuation: [1.0, 0.0, 0.0],
                line_width: 1.0,
                fog_density: 1.0,
                fog_end: 1.0,
                ..Environment::zeroed()
            },
            current: CurrentAttributes {
                normal: [0.0, 0.0, 1.0, 1.0],
                color: [1.0; 4],
                secondary: [0.0, 0.0, 0.0, 1.0],
                ..CurrentAttributes::zeroed()
            },
        }
    }

    pub(crate) fn push(&mut self, operation: Operation) -> &mut Self {
        self.frame.operations.push(operation);
        self
    }

    /// Clears colour and depth.
    pub(crate) fn clear(&mut self, color: [f32; 4]) -> &mut Self {
        self.push(Operation::Clear(Clear {
            color: Some(color),
            color_mask: 0xf,
            depth: Some(1.0),
            stencil: None,
            scissor: None,
        }))
    }

    /// Adds the state that is set to the frame's tables, and a draw of such vertices without indices yet.
    fn draw_of(&mut self, layout: VertexLayout, topology: Topology, source: VertexSource) -> Draw {
        let frame = &mut self.frame;
        let draw = Draw {
            source,
            layout,
            topology,
            index_count: 0,
            fixed: frame.fixed.len() as u32,
            viewport: frame.viewports.len() as u32,
            bindings: frame.bindings.len() as u32,
            transform: frame.transforms.len() as u32,
            lights: (frame.lights.len() as u32).saturating_sub(1),
            material: (frame.materials.len() as u32).saturating_sub(1),
            environment: frame.environments.len() as u32,
            texgen: (frame.texgens.len() as u32).saturating_sub(1),
            texture_matrices: (frame.texture_matrices.len() as u32).saturating_sub(1),
            clip_planes: (frame.clip_planes.len() as u32).saturating_sub(1),
            current: frame.current.len() as u32,
            hint: frame.hints.len() as u32,
        };
        frame.fixed.push(self.fixed);
        frame.viewports.push(self.viewport);
        frame.bindings.push(self.bindings);
        frame.transforms.push(self.transform);
        frame.environments.push(self.environment);
        frame.current.push(self.current);
        draw
    }

    /// The state that is set, as numbers of the frame's tables.
    pub(crate) fn state(&mut self) -> Draw {
        let source = VertexSource::Retained { range: 0, first_index: 0 };
        self.draw_of(VertexLayout::default(), Topology::Triangles, source)
    }

    /// Draws vertices as they come, `words` being tightly packed.
    pub(crate) fn draw(
        &mut self,
        layout: VertexLayout,
        topology: Topology,
        words: &[u32],
        indices: &[u32],
    ) -> &mut Self {
        let source = VertexSource::Arena {
            first_word: self.frame.words.len() as u32,
            vertices: (words.len() / layout.stride()) as u32,
            first_index: self.frame.indices.len() as u32,
        };
        self.frame.words.extend(words);
        self.frame.indices.extend(indices);
        let draw = Draw { index_count: indices.len() as u32, ..self.draw_of(layout, topology, source) };
        self.push(Operation::Draw(draw))
    }

    /// Draws points, lines or triangles of one colour.
    pub(crate) fn primitives(
        &mut self,
        topology: Topology,
        positions: &[[f32; 3]],
        color: [u8; 4],
    ) -> &mut Self {
        let indices: Vec<_> = (0..positions.len() as u32).collect();
        let vertex = |position: &[f32; 3]| {
            let [x, y, z] = position.map(f32::to_bits);
            [x, y, z, u32::from_le_bytes(color)]
        };
        let words: Vec<_> = positions.iter().flat_map(vertex).collect();
        self.draw(POSITION_COLOR, topology, &words, &indices)
    }

    pub(crate) fn triangle(&mut self, positions: [[f32; 3]; 3], color: [u8; 4]) -> &mut Self {
        self.primitives(Topology::Triangles, &positions, color)
    }

    /// Covers a rectangle of normalised coordinates, counter-clockwise, at depth `z`.
    pub(crate) fn quad(
        &mut self,
        [left, lower]: [f32; 2],
        [right, upper]: [f32; 2],
        z: f32,
        color: [u8; 4],
    ) -> &mut Self {
        let corners = [
            [left, lower, z],
            [right, lower, z],
            [right, upper, z],
            [left, lower, z],
            [right, upper, z],
            [left, upper, z],
        ];
        self.primitives(Topology::Triangles, &corners, color)
    }

    /// Covers the viewport.
    pub(crate) fn fill(&mut self, z: f32, color: [u8; 4]) -> &mut Self {
        self.quad([-1.0, -1.0], [1.0, 1.0], z, color)
    }

    /// Covers the viewport, with texture coordinates of unit 0 from (0, 0) to `most`.
    pub(crate) fn textured_fill(&mut self, most: [f32; 2]) -> &mut Self {
        let layout = VertexLayout::default()
            .with(Slot::Position as usize, Format::F2)
            .with(Slot::Texture0 as usize, Format::F2);
        let [s, t] = most;
        let corners: [[f32; 4]; 4] =
            [[-1.0, -1.0, 0.0, 0.0], [1.0, -1.0, s, 0.0], [1.0, 1.0, s, t], [-1.0, 1.0, 0.0, t]];
        let words = corners.concat();
        let words: Vec<_> = words.iter().map(|value| value.to_bits()).collect();
        self.draw(layout, Topology::Triangles, &words, &[0, 1, 2, 0, 2, 3])
    }

    /// Defines a texture of one level, its rows from the lowest upward, and binds it to a unit.
    pub(crate) fn texture(
        &mut self,
        unit: usize,
        [width, height]: [u32; 2],
        base_format: BaseFormat,
        texels: &[[u8; 4]],
    ) -> ImageKey {
        let image = self.define([width, height], base_format);
        let region = Region { level: 0, layer: 0, offset: [0; 3], extent: [width, height, 1] };
        self.push(Operation::Upload(ImageUpload { image, region, texels: texels.concat().into() }));
        self.bind(unit, image, base_format, nearest());
        image
    }

    /// Defines an image without texels.
    pub(crate) fn define(&mut self, [width, height]: [u32; 2], base_format: BaseFormat) -> ImageKey {
        let image = ImageKey::unique();
        let shape = ImageShape {
            dimension: Dimension::D2,
            width,
            height,
            depth: 1,
            levels: 1,
            format: if base_format == BaseFormat::Depth { TexelFormat::Depth32 } else { TexelFormat::Rgba8 },
            base_format,
        };
        self.push(Operation::DefineImage { image, shape });
        image
    }

    /// Binds an image to a unit, which replaces the colour by the texel.
    pub(crate) fn bind(
        &mut self,
        unit: usize,
        image: ImageKey,
        base_format: BaseFormat,
        sampler: Sampler,
    ) -> &mut Self {
        let words = &mut self.fixed.words.units[unit];
        words.set_target(Dimension::D2 as u32);
        words.set_base_format(base_format as u32);
        words.set_env_mode(afterglow_gl::frame::EnvMode::Replace as u32);
        self.bindings[unit] = Some(TextureBinding { image, sampler });
        self
    }

    /// What the frame looks like. All tests share a renderer, which spares the making of pipelines: frames must not
    /// depend on what the window held before.
    pub(crate) fn picture(&self) -> Picture {
        static RENDERER: Mutex<Option<Renderer>> = Mutex::new(None);
        // A test that failed has left a renderer that still works.
        let mut shared = RENDERER.lock().unwrap_or_else(PoisonError::into_inner);
        Picture::after(shared.get_or_insert_with(renderer), &[&self.frame])
    }
}

/// The window's colours.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Picture {
    pub(crate) size: [u32; 2],
    /// The highest row first.
    pub(crate) bytes: Vec<u8>,
}

impl Picture {
    /// After some frames.
    pub(crate) fn after(renderer: &mut Renderer, frames: &[&Frame]) -> Self {
        for frame in frames {
            renderer.execute(frame).unwrap();
        }
        let bytes = renderer.read_color().unwrap();
        assert_valid();
        Self { size: renderer.size(), bytes }
    }

    /// The colour of a pixel, counted from the lower left corner.
    #[track_caller]
    pub(crate) fn at(&self, x: u32, y: u32) -> [u8; 4] {
        let [width, height] = self.size;
        assert!(x < width && y < height);
        let first = (((height - 1 - y) * width + x) * 4) as usize;
        self.bytes[first..first + 4].try_into().unwrap()
    }

    /// Asserts that a pixel has a colour but for rounding.
    #[track_caller]
    pub(crate) fn assert_near(&self, x: u32, y: u32, expected: [f32; 4]) {
        let found = self.at(x, y);
        for (found, expected) in found.into_iter().zip(expected) {
            let expected = expected * 255.0;
            assert!(
                (f32::from(found) - expected).abs() <= 1.01,
                "({x}, {y}) has {:?}, not {expected}",
                self.at(x, y)
            );
        }
    }

    /// How many pixels have a colour.
    pub(crate) fn count(&self, color: [u8; 4]) -> usize {
        let pixels = self.bytes.as_chunks::<4>().0;
        pixels.iter().filter(|pixel| **pixel == color).count()
    }
}
