//! The numbers of the fixed-function state, as shaders read them. A draw names blocks by index;
//! a block is pushed to the frame when its state has changed since the last draw.

use super::words::{CLIP_PLANES, LIGHTS, TEXTURE_UNITS};
use afterglow_layout::shared_struct;

shared_struct! {
    /// Modelview and projection. Matrices are column-major, as glLoadMatrix takes them.
    pub struct Transform {
        /// Object to eye space.
        pub modelview: [[f32; 4]; 4],
        /// Eye to clip space (OpenGL's, z from -w to w).
        pub projection: [[f32; 4]; 4],
        /// Object to clip space; the one matrix that positions go through.
        pub modelview_projection: [[f32; 4]; 4],
        /// Object to eye space for normals: inverse transpose, with GL_RESCALE_NORMAL's factor.
        pub normal: [[f32; 3]; 3],
    }
}

shared_struct! {
    /// One light source, in eye space.
    pub struct Light {
        pub ambient: [f32; 4],
        pub diffuse: [f32; 4],
        pub specular: [f32; 4],
        /// Homogeneous; w = 0 is a direction towards the light.
        pub position: [f32; 4],
        pub spot_direction: [f32; 3],
        pub spot_exponent: f32,
        /// Constant, linear, quadratic.
        pub attenuation: [f32; 3],
        /// Cosine of the cut-off angle; -1 when it is no spot.
        pub spot_cos_cutoff: f32,
    }
}

shared_struct! {
    /// All light sources and the scene's ambient light.
    pub struct Lights {
        pub lights: [Light; LIGHTS],
        pub scene_ambient: [f32; 4],
    }
}

shared_struct! {
    /// Material of one side.
    pub struct MaterialFace {
        pub ambient: [f32; 4],
        pub diffuse: [f32; 4],
        pub specular: [f32; 4],
        pub emission: [f32; 4],
        /// Exponent, 0 to 128.
        pub shininess: f32,
    }
}

shared_struct! {
    /// Material of both sides: front, back.
    pub struct Material {
        pub faces: [MaterialFace; 2],
    }
}

shared_struct! {
    /// Constants of texture environment, fog, alpha test and points.
    pub struct Environment {
        pub env_color: [[f32; 4]; TEXTURE_UNITS],
        /// Level bias of each unit (texture's and unit's together).
        pub lod_bias: [f32; 4],
        pub fog_color: [f32; 4],
        pub fog_density: f32,
        pub fog_start: f32,
        pub fog_end: f32,
        pub alpha_reference: f32,
        /// Point size before attenuation, pixels.
        pub point_size: f32,
        pub point_size_min: f32,
        pub point_size_max: f32,
        pub point_fade_threshold: f32,
        /// Constant, linear, quadratic.
        pub point_attenuation: [f32; 3],
        /// Line width, pixels.
        pub line_width: f32,
        /// glPolygonStipple: row y modulo 32 of the window (from below), pixel x modulo 32 in bit 31 - x.
        pub polygon_stipple: [u32; 32],
    }
}

shared_struct! {
    /// Texture generation planes of one unit, for s, t, r, q (a mat4's columns).
    pub struct TexGenUnit {
        pub object: [[f32; 4]; 4],
        pub eye: [[f32; 4]; 4],
    }
}

shared_struct! {
    /// Texture generation planes of all units.
    pub struct TexGen {
        pub units: [TexGenUnit; TEXTURE_UNITS],
    }
}

shared_struct! {
    /// A matrix as a structure, to be an array element.
    pub struct Matrix {
        pub columns: [[f32; 4]; 4],
    }
}

shared_struct! {
    /// Texture matrices of all units.
    pub struct TextureMatrices {
        pub units: [Matrix; TEXTURE_UNITS],
    }
}

shared_struct! {
    /// A plane as a structure, to be an array element.
    pub struct Plane {
        pub coefficients: [f32; 4],
    }
}

shared_struct! {
    /// Clip planes in eye space.
    pub struct ClipPlanes {
        pub planes: [Plane; CLIP_PLANES],
    }
}

shared_struct! {
    /// Current values of the attributes that a draw's vertices lack, by [`Slot`](super::Slot).
    pub struct CurrentAttributes {
        pub normal: [f32; 4],
        pub color: [f32; 4],
        pub secondary: [f32; 4],
        pub fog: [f32; 4],
        pub texture: [Plane; TEXTURE_UNITS],
    }
}
