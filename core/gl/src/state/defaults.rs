//! Initial values (OpenGL 1.5, tables 6.5 to 6.37).

use afterglow_api::constants::*;
use glam::Vec4;

use super::*;
use crate::frame::{
    CLIP_PLANES, CombineFunction, CombineSource, EnvMode, LIGHTS, Light, Material, MaterialFace, Rect, SLOTS,
    Slot, TEXTURE_UNITS, TexGenUnit, UnitWords,
};

const BLACK: [f32; 4] = [0.0, 0.0, 0.0, 1.0];
const WHITE: [f32; 4] = [1.0; 4];

impl Default for State {
    fn default() -> State {
        State {
            caps: Caps::of(&[Cap::Dither, Cap::Multisample]),
            current: Current::default(),
            point: Point {
                size: 1.0,
                size_min: 0.0,
                size_max: crate::limits::POINT_SIZE_MAX,
                fade_threshold: 1.0,
                attenuation: [1.0, 0.0, 0.0],
            },
            line: Line { width: 1.0, stipple_factor: 1, stipple_pattern: 0xffff },
            polygon: Polygon {
                cull_face: GL_BACK,
                front_face: GL_CCW,
                mode: [GL_FILL; 2],
                offset: (0.0, 0.0),
            },
            polygon_stipple: [0xff; 128],
            pixel: PixelMode { zoom: (1.0, 1.0), read_buffer: GL_BACK },
            lighting: Lighting::default(),
            fog: Fog {
                mode: GL_EXP,
                color: [0.0; 4],
                density: 1.0,
                start: 0.0,
                end: 1.0,
                index: 0.0,
                coordinate_source: GL_FRAGMENT_DEPTH,
            },
            depth: DepthBuffer { func: GL_LESS, mask: true, clear: 1.0 },
            accum_clear: [0.0; 4],
            stencil: StencilBuffer {
                func: GL_ALWAYS,
                reference: 0,
                value_mask: u32::MAX,
                ops: [GL_KEEP; 3],
                write_mask: u32::MAX,
                clear: 0,
            },
            viewport: ViewportState { rect: Rect::default(), depth_range: [0.0, 1.0] },
            transform: TransformState {
                matrix_mode: GL_MODELVIEW,
                clip_planes: [[0.0; 4]; CLIP_PLANES],
                clip_enabled: 0,
            },
            color: ColorBuffer::default(),
            hints: [GL_DONT_CARE; HINTS.len()],
            list_base: 0,
            texture: TextureState { active: 0, units: std::array::from_fn(|_| TextureUnit::default()) },
            scissor: Rect::default(),
        }
    }
}

impl Default for Current {
    fn default() -> Current {
        let mut attributes = [Vec4::from_array(BLACK); SLOTS];
        attributes[Slot::Normal as usize] = Vec4::Z;
        attributes[Slot::Color as usize] = Vec4::from_array(WHITE);
        Current {
            attributes,
            edge_flag: true,
            index: 1.0,
            raster: RasterPosition {
                window: BLACK,
                valid: true,
                distance: 0.0,
                color: WHITE,
                secondary: BLACK,
                texture: [BLACK; TEXTURE_UNITS],
            },
        }
    }
}

impl Default for Lighting {
    fn default() -> Lighting {
        let light = |i: usize| Light {
            ambient: BLACK,
            diffuse: if i == 0 { WHITE } else { BLACK },
            specular: if i == 0 { WHITE } else { BLACK },
            position: [0.0, 0.0, 1.0, 0.0],
            spot_direction: [0.0, 0.0, -1.0],
            spot_exponent: 0.0,
            attenuation: [1.0, 0.0, 0.0],
            spot_cos_cutoff: -1.0,
        };
        let face = MaterialFace {
            ambient: [0.2, 0.2, 0.2, 1.0],
            diffuse: [0.8, 0.8, 0.8, 1.0],
            specular: BLACK,
            emission: BLACK,
            shininess: 0.0,
        };
        Lighting {
            lights: std::array::from_fn(light),
            cutoffs: [180.0; LIGHTS],
            enabled: 0,
            model_ambient: [0.2, 0.2, 0.2, 1.0],
            local_viewer: false,
            two_side: false,
            separate_specular: false,
            material: Material { faces: [face; 2] },
            color_material_face: GL_FRONT_AND_BACK,
            color_material_mode: GL_AMBIENT_AND_DIFFUSE,
            shade_model: GL_SMOOTH,
            color_indexes: [[0.0, 1.0, 1.0]; 2],
        }
    }
}

impl Default for ColorBuffer {
    fn default() -> ColorBuffer {
        ColorBuffer {
            clear: [0.0; 4],
            clear_index: 0.0,
            mask: [true; 4],
            index_mask: u32::MAX,
            alpha_func: GL_ALWAYS,
            alpha_reference: 0.0,
            blend: [[GL_ONE, GL_ZERO]; 2],
            equation: [GL_FUNC_ADD; 2],
            blend_color: [0.0; 4],
            logic_op: GL_COPY,
            draw_buffer: GL_BACK,
        }
    }
}

impl Default for TextureUnit {
    fn default() -> TextureUnit {
        let mut words = UnitWords::default();
        words.set_env_mode(EnvMode::Modulate as u32);
        words.set_combine_rgb(CombineFunction::Modulate as u32);
        words.set_combine_alpha(CombineFunction::Modulate as u32);
        words.set_source_rgb0(CombineSource::Texture as u32);
        words.set_source_rgb1(CombineSource::Previous as u32);
        words.set_source_rgb2(CombineSource::Constant as u32);
        words.set_source_alpha0(CombineSource::Texture as u32);
        words.set_source_alpha1(CombineSource::Previous as u32);
        words.set_source_alpha2(CombineSource::Constant as u32);
        words.set_operand_rgb2(2);
        let s_and_t = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0; 4], [0.0; 4]];
        TextureUnit {
            targets: 0,
            gen_enabled: 0,
            gen_mode: [GL_EYE_LINEAR; 4],
            gen_planes: TexGenUnit { object: s_and_t, eye: s_and_t },
            env_color: [0.0; 4],
            lod_bias: 0.0,
            words,
        }
    }
}
