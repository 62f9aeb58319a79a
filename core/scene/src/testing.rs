//! Frames built by hand, for tests.

use std::sync::Arc;

use afterglow_gl::frame::*;
use glam::{Mat4, Vec3};

use crate::types::{Class, Scene, Verdict};

/// Size of the drawable.
pub const SIZE: (u32, u32) = (640, 480);

/// A frame in the making; what is set holds for the draws that follow.
pub struct Sketch {
    /// The frame so far.
    pub frame: Frame,
    /// State of the next draw.
    pub fixed: FixedState,
    /// Viewport of the next draw.
    pub viewport: Viewport,
    /// MODELVIEW of the next draw.
    pub modelview: Mat4,
    /// PROJECTION of the next draw.
    pub projection: Mat4,
    /// What the units sample.
    pub bindings: Bindings,
    /// Current colour.
    pub color: [f32; 4],
    /// Lights of the next draw.
    pub lights: Lights,
    /// Reference of the alpha test.
    pub alpha_reference: f32,
    /// What is said of the next draw, as [`Draw::hint`] has it.
    pub hint: u32,
}

impl Sketch {
    /// Perspective, depth tested and written, no blending, no textures, unlit, white.
    pub fn new() -> Sketch {
        let raster = RasterState {
            blend: None,
            logic_op: None,
            color_mask: 15,
            depth: Some(Depth { compare: Compare::LessEqual, write: true }),
            stencil: None,
            cull: Cull::None,
            front_ccw: true,
            depth_bias: None,
            line_width: 1.0.into(),
            line_stipple: None,
        };
        let mut words = StateWords::default();
        words.global.set_alpha_func(Compare::Always as u32);
        let rect = Rect { x: 0, y: 0, width: SIZE.0 as i32, height: SIZE.1 as i32 };
        Sketch {
            frame: Frame { size: SIZE, ..Frame::default() },
            fixed: FixedState { words, raster },
            viewport: Viewport { rect, depth_range: [0.0, 1.0], scissor: None },
            modelview: Mat4::IDENTITY,
            projection: perspective(),
            bindings: [None; TEXTURE_UNITS],
            color: [1.0; 4],
            lights: bytemuck::Zeroable::zeroed(),
            alpha_reference: 0.0,
            hint: 0,
        }
    }

    /// Clears depth, and colour if one is given.
    pub fn clear(&mut self, color: Option<[f32; 4]>) {
        self.frame.operations.push(Operation::Clear(Clear {
            color,
            color_mask: 15,
            depth: Some(1.0),
            stencil: None,
            scissor: None,
        }));
    }

    /// Draws triangles, three corners each; their operation.
    pub fn draw(&mut self, corners: &[Vec3]) -> usize {
        self.draw_with(corners, None)
    }

    /// Draws triangles with a colour a vertex.
    pub fn draw_with(&mut self, corners: &[Vec3], colors: Option<&[[f32; 4]]>) -> usize {
        let mut layout = VertexLayout::default().with(Slot::Position as usize, Format::F3);
        if colors.is_some() {
            layout = layout.with(Slot::Color as usize, Format::F4);
        }
        for unit in (0..TEXTURE_UNITS).filter(|&unit| self.fixed.words.units[unit].target() != 0) {
            layout = layout.with(Slot::Texture0 as usize + unit, Format::F2);
        }
        let first_word = self.frame.words.len() as u32;
        let first_index = self.frame.indices.len() as u32;
        let tail = layout.stride() - layout.offset(Slot::Texture0 as usize);
        for (i, corner) in corners.iter().enumerate() {
            self.frame.words.extend(corner.to_array().map(f32::to_bits));
            self.frame.words.extend(colors.iter().flat_map(|colors| colors[i].map(f32::to_bits)));
            self.frame.words.extend(std::iter::repeat_n(0, tail));
            self.frame.indices.push(i as u32);
        }
        let source = VertexSource::Arena { first_word, vertices: corners.len() as u32, first_index };
        self.push(source, layout, corners.len() as u32)
    }

    /// Draws part of a retained range; its operation.
    pub fn draw_retained(&mut self, range: &Arc<RetainedRange>, first_index: u32, count: u32) -> usize {
        self.frame.retained.push(range.clone());
        let source = VertexSource::Retained { range: self.frame.retained.len() as u32 - 1, first_index };
        self.push(source, range.layout, count)
    }

    fn push(&mut self, source: VertexSource, layout: VertexLayout, index_count: u32) -> usize {
        let frame = &mut self.frame;
        let mut transform: Transform = bytemuck::Zeroable::zeroed();
        transform.modelview = self.modelview.to_cols_array_2d();
        transform.projection = self.projection.to_cols_array_2d();
        let mut current: CurrentAttributes = bytemuck::Zeroable::zeroed();
        current.color = self.color;
        let mut material: Material = bytemuck::Zeroable::zeroed();
        material.faces[0].diffuse = [0.8, 0.8, 0.8, 1.0];
        frame.fixed.push(self.fixed);
        frame.viewports.push(self.viewport);
        frame.bindings.push(self.bindings);
        frame.transforms.push(transform);
        frame.lights.push(self.lights);
        frame.materials.push(material);
        frame.current.push(current);
        let mut environment: Environment = bytemuck::Zeroable::zeroed();
        environment.alpha_reference = self.alpha_reference;
        frame.environments.push(environment);
        frame.operations.push(Operation::Draw(Draw {
            source,
            layout,
            topology: Topology::Triangles,
            index_count,
            fixed: frame.fixed.len() as u32 - 1,
            viewport: frame.viewports.len() as u32 - 1,
            bindings: frame.bindings.len() as u32 - 1,
            transform: frame.transforms.len() as u32 - 1,
            lights: frame.lights.len() as u32 - 1,
            material: frame.materials.len() as u32 - 1,
            environment: frame.environments.len() as u32 - 1,
            texgen: 0,
            texture_matrices: 0,
            clip_planes: 0,
            current: frame.current.len() as u32 - 1,
            hint: self.hint,
        }));
        frame.operations.len() - 1
    }

    /// Makes a texture of these texels (one row) and binds it to a unit, modulating.
    pub fn texture(&mut self, unit: usize, base_format: BaseFormat, texels: &[[u8; 4]]) -> ImageKey {
        let image = ImageKey::unique();
        let extent = [texels.len() as u32, 1, 1];
        let shape = ImageShape {
            dimension: Dimension::D2,
            width: extent[0],
            height: 1,
            depth: 1,
            levels: 1,
            format: TexelFormat::Rgba8,
            base_format,
        };
        self.frame.operations.push(Operation::DefineImage { image, shape });
        let region = Region { level: 0, layer: 0, offset: [0; 3], extent };
        let texels = texels.as_flattened().into();
        self.frame.operations.push(Operation::Upload(ImageUpload { image, region, texels }));
        self.sample(unit, image, base_format);
        image
    }

    /// Binds a texture to a unit, modulating.
    pub fn sample(&mut self, unit: usize, image: ImageKey, base_format: BaseFormat) {
        let sampler = Sampler {
            mag_linear: true,
            min_linear: true,
            mip_linear: None,
            wrap: [Wrap::Repeat; 3],
            min_lod: 0.0.into(),
            max_lod: 0.0.into(),
            border_color: [0.0.into(); 4],
            anisotropy: 1.0.into(),
            compare: None,
        };
        self.bindings[unit] = Some(TextureBinding { image, sampler });
        self.fixed.words.units[unit].set_target(1);
        self.fixed.words.units[unit].set_base_format(base_format as u32);
    }

    /// Switches a unit off.
    pub fn unbind(&mut self, unit: usize) {
        self.bindings[unit] = None;
        self.fixed.words.units[unit] = UnitWords::default();
    }

    /// Blends, or stops to.
    pub fn blend(&mut self, rgb: Option<(BlendFactor, BlendFactor)>) {
        self.fixed.raster.blend = rgb.map(|rgb| Blend {
            rgb,
            alpha: rgb,
            equation_rgb: BlendEquation::Add,
            equation_alpha: BlendEquation::Add,
            constant: [0.0.into(); 4],
        });
    }

    /// Sets the depth test; `None` switches it off.
    pub fn depth(&mut self, test: Option<(Compare, bool)>) {
        self.fixed.raster.depth = test.map(|(compare, write)| Depth { compare, write });
    }

    /// Lights the draws that follow by light 0 at a homogeneous position in the space after MODELVIEW.
    pub fn light(&mut self, position: [f32; 4], diffuse: [f32; 4]) {
        self.fixed.words.global.set_lighting(1);
        self.fixed.words.global.set_lights(1);
        let light = &mut self.lights.lights[0];
        (light.position, light.diffuse, light.spot_cos_cutoff) = (position, diffuse, -1.0);
        light.attenuation = [1.0, 0.0, 0.0];
    }

    /// A room's worth of world: a floor of many triangles in world coordinates; the operation.
    pub fn world(&mut self) -> usize {
        self.draw(&floor())
    }
}

/// An ordinary projection.
pub fn perspective() -> Mat4 {
    glam::camera::rh::proj::opengl::perspective(1.2, 4.0 / 3.0, 0.1, 1000.0)
}

/// Triangles of a floor, 100 by 100.
pub fn floor() -> Vec<Vec3> {
    let mut corners = Vec::new();
    for i in 0..10 {
        let x = i as f32 * 10.0 - 50.0;
        corners.extend([[x, -50.0], [x + 10.0, -50.0], [x, 50.0]].map(|[x, z]| Vec3::new(x, 0.0, z)));
        corners.extend([[x + 10.0, -50.0], [x + 10.0, 50.0], [x, 50.0]].map(|[x, z]| Vec3::new(x, 0.0, z)));
    }
    corners
}

/// Triangles of a small thing about the origin.
pub fn thing(size: f32) -> Vec<Vec3> {
    let [x, y, z] = Vec3::AXES.map(|axis| axis * size);
    vec![x, y, z, x, z, -y, -x, y, z]
}

/// The verdict on an operation.
pub fn verdict(scene: &Scene, operation: usize) -> Verdict {
    *scene.verdicts.iter().find(|v| v.operation as usize == operation).unwrap()
}

/// The class of an operation.
pub fn class(scene: &Scene, operation: usize) -> Class {
    verdict(scene, operation).class
}
