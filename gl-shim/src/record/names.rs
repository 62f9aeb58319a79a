//! Enumerations and bitmasks as apitrace divides them: one large enumeration, and small ones where small numbers mean
//! something of their own.

use std::sync::LazyLock;

use afterglow_api::constants::*;
use afterglow_api::enumerant_names;
use afterglow_trace::write::{Bitmask, Enumeration, Structure};

type Named = Vec<(&'static str, i64)>;

static ENUMERANTS: LazyLock<Named> = LazyLock::new(|| {
    let small = [("GL_ZERO", 0), ("GL_ONE", 1)];
    let others = enumerant_names().iter().map(|&(value, name)| (name, value.into()));
    small.into_iter().chain(others).collect()
});

/// GLenum.
pub fn enumerants() -> Enumeration<'static> {
    Enumeration { id: 0, values: &ENUMERANTS }
}

pub const BOOLEANS: Enumeration = Enumeration { id: 1, values: &[("GL_TRUE", 1), ("GL_FALSE", 0)] };

pub const PRIMITIVES: Enumeration = Enumeration {
    id: 2,
    values: &[
        ("GL_POINTS", 0),
        ("GL_LINES", 1),
        ("GL_LINE_LOOP", 2),
        ("GL_LINE_STRIP", 3),
        ("GL_TRIANGLES", 4),
        ("GL_TRIANGLE_STRIP", 5),
        ("GL_TRIANGLE_FAN", 6),
        ("GL_QUADS", 7),
        ("GL_QUAD_STRIP", 8),
        ("GL_POLYGON", 9),
    ],
};

/// What glGetError returns.
pub const ERRORS: Enumeration = Enumeration {
    id: 3,
    values: &[
        ("GL_NO_ERROR", 0),
        ("GL_INVALID_ENUM", GL_INVALID_ENUM as i64),
        ("GL_INVALID_VALUE", GL_INVALID_VALUE as i64),
        ("GL_INVALID_OPERATION", GL_INVALID_OPERATION as i64),
        ("GL_STACK_OVERFLOW", GL_STACK_OVERFLOW as i64),
        ("GL_STACK_UNDERFLOW", GL_STACK_UNDERFLOW as i64),
        ("GL_OUT_OF_MEMORY", GL_OUT_OF_MEMORY as i64),
    ],
};

/// Xlib's Bool.
pub const X_BOOLEANS: Enumeration = Enumeration { id: 4, values: &[("False", 0), ("True", 1)] };

/// Names of GLX: attributes, and values of some.
pub const GLX: Enumeration = Enumeration {
    id: 5,
    values: &[
        ("GLX_USE_GL", 1),
        ("GLX_BUFFER_SIZE", 2),
        ("GLX_LEVEL", 3),
        ("GLX_RGBA", 4),
        ("GLX_DOUBLEBUFFER", 5),
        ("GLX_STEREO", 6),
        ("GLX_AUX_BUFFERS", 7),
        ("GLX_RED_SIZE", 8),
        ("GLX_GREEN_SIZE", 9),
        ("GLX_BLUE_SIZE", 10),
        ("GLX_ALPHA_SIZE", 11),
        ("GLX_DEPTH_SIZE", 12),
        ("GLX_STENCIL_SIZE", 13),
        ("GLX_ACCUM_RED_SIZE", 14),
        ("GLX_ACCUM_GREEN_SIZE", 15),
        ("GLX_ACCUM_BLUE_SIZE", 16),
        ("GLX_ACCUM_ALPHA_SIZE", 17),
        ("GLX_CONFIG_CAVEAT", 0x20),
        ("GLX_X_VISUAL_TYPE", 0x22),
        ("GLX_TRANSPARENT_TYPE", 0x23),
        ("GLX_CONTEXT_MAJOR_VERSION_ARB", 0x2091),
        ("GLX_CONTEXT_MINOR_VERSION_ARB", 0x2092),
        ("GLX_CONTEXT_FLAGS_ARB", 0x2094),
        ("GLX_NONE", 0x8000),
        ("GLX_TRUE_COLOR", 0x8002),
        ("GLX_DIRECT_COLOR", 0x8003),
        ("GLX_VISUAL_ID", 0x800b),
        ("GLX_SCREEN", 0x800c),
        ("GLX_DRAWABLE_TYPE", 0x8010),
        ("GLX_RENDER_TYPE", 0x8011),
        ("GLX_X_RENDERABLE", 0x8012),
        ("GLX_FBCONFIG_ID", 0x8013),
        ("GLX_RGBA_TYPE", 0x8014),
        ("GLX_COLOR_INDEX_TYPE", 0x8015),
        ("GLX_PRESERVED_CONTENTS", 0x801b),
        ("GLX_LARGEST_PBUFFER", 0x801c),
        ("GLX_WIDTH", 0x801d),
        ("GLX_HEIGHT", 0x801e),
        ("GLX_PBUFFER_HEIGHT", 0x8040),
        ("GLX_PBUFFER_WIDTH", 0x8041),
        ("GLX_CONTEXT_PROFILE_MASK_ARB", 0x9126),
        ("GLX_SAMPLE_BUFFERS", 100_000),
        ("GLX_SAMPLES", 100_001),
        ("GLX_DONT_CARE", 0xffff_ffff),
    ],
};

/// glClear and glPushAttrib.
pub const ATTRIBUTE_BITS: Bitmask = Bitmask {
    id: 0,
    flags: &[
        ("GL_ALL_ATTRIB_BITS", 0xf_ffff),
        ("GL_CURRENT_BIT", 0x1),
        ("GL_POINT_BIT", 0x2),
        ("GL_LINE_BIT", 0x4),
        ("GL_POLYGON_BIT", 0x8),
        ("GL_POLYGON_STIPPLE_BIT", 0x10),
        ("GL_PIXEL_MODE_BIT", 0x20),
        ("GL_LIGHTING_BIT", 0x40),
        ("GL_FOG_BIT", 0x80),
        ("GL_DEPTH_BUFFER_BIT", 0x100),
        ("GL_ACCUM_BUFFER_BIT", 0x200),
        ("GL_STENCIL_BUFFER_BIT", 0x400),
        ("GL_VIEWPORT_BIT", 0x800),
        ("GL_TRANSFORM_BIT", 0x1000),
        ("GL_ENABLE_BIT", 0x2000),
        ("GL_COLOR_BUFFER_BIT", 0x4000),
        ("GL_HINT_BIT", 0x8000),
        ("GL_EVAL_BIT", 0x1_0000),
        ("GL_LIST_BIT", 0x2_0000),
        ("GL_TEXTURE_BIT", 0x4_0000),
        ("GL_SCISSOR_BIT", 0x8_0000),
        ("GL_MULTISAMPLE_BIT", 0x2000_0000),
    ],
};

/// glPushClientAttrib.
pub const CLIENT_ATTRIBUTE_BITS: Bitmask = Bitmask {
    id: 1,
    flags: &[
        ("GL_CLIENT_ALL_ATTRIB_BITS", 0xffff_ffff),
        ("GL_CLIENT_PIXEL_STORE_BIT", 1),
        ("GL_CLIENT_VERTEX_ARRAY_BIT", 2),
    ],
};

pub const VISUAL: Structure = Structure {
    id: 0,
    name: "XVisualInfo",
    members: &[
        "visual",
        "visualid",
        "screen",
        "depth",
        "c_class",
        "red_mask",
        "green_mask",
        "blue_mask",
        "colormap_size",
        "bits_per_rgb",
    ],
};

/// Whether the value of a parameter is an enumerant.
pub fn is_symbolic(pname: u32) -> bool {
    matches!(
        pname,
        GL_TEXTURE_MIN_FILTER
            | GL_TEXTURE_MAG_FILTER
            | GL_TEXTURE_WRAP_S
            | GL_TEXTURE_WRAP_T
            | GL_TEXTURE_WRAP_R
            | GL_TEXTURE_COMPARE_MODE
            | GL_TEXTURE_COMPARE_FUNC
            | GL_DEPTH_TEXTURE_MODE
            | GL_TEXTURE_ENV_MODE
            | GL_COMBINE_RGB
            | GL_COMBINE_ALPHA
            | GL_SRC0_RGB..=GL_SRC2_RGB
            | GL_SRC0_ALPHA..=GL_SRC2_ALPHA
            | GL_OPERAND0_RGB..=GL_OPERAND2_RGB
            | GL_OPERAND0_ALPHA..=GL_OPERAND2_ALPHA
            | GL_TEXTURE_GEN_MODE
            | GL_FOG_MODE
            | GL_FOG_COORD_SRC
            | GL_LIGHT_MODEL_COLOR_CONTROL
            | GL_POINT_SPRITE_R_MODE_NV
    )
}
