//! Enumerations and bitmasks as apitrace divides them: one large enumeration, and small ones where small numbers mean
//! something of their own. Ids of those of GLX follow these (`glx::names`).

use std::sync::LazyLock;

use afterglow_api::constants::*;
use afterglow_api::enumerant_names;
use afterglow_trace::write::{Bitmask, Enumeration};

type Named = Vec<(&'static str, i64)>;

/// Names with their values.
macro_rules! named {
    ($($name:ident)*) => {
        &[$((stringify!($name), $name as _)),*]
    };
}
pub(super) use named;

static ENUMERANTS: LazyLock<Named> = LazyLock::new(|| {
    let small = [("GL_ZERO", 0), ("GL_ONE", 1)];
    let others = enumerant_names().iter().map(|&(value, name)| (name, value.into()));
    small.into_iter().chain(PREFERRED.iter().copied()).chain(others).collect()
});

/// Names that tracers prefer to the oldest ones of the same values; the first name is what a reader shows.
const PREFERRED: &[(&str, i64)] = &[
    ("GL_MAX_CLIP_DISTANCES", GL_MAX_CLIP_PLANES as i64),
    ("GL_CLIP_DISTANCE0", GL_CLIP_PLANE0 as i64),
    ("GL_CLIP_DISTANCE1", GL_CLIP_PLANE1 as i64),
    ("GL_CLIP_DISTANCE2", GL_CLIP_PLANE2 as i64),
    ("GL_CLIP_DISTANCE3", GL_CLIP_PLANE3 as i64),
    ("GL_CLIP_DISTANCE4", GL_CLIP_PLANE4 as i64),
    ("GL_CLIP_DISTANCE5", GL_CLIP_PLANE5 as i64),
    ("GL_COMPARE_REF_TO_TEXTURE", GL_COMPARE_R_TO_TEXTURE as i64),
    ("GL_INDEX_LOGIC_OP", GL_INDEX_LOGIC_OP as i64),
    ("GL_TEXTURE_INTERNAL_FORMAT", GL_TEXTURE_INTERNAL_FORMAT as i64),
    ("GL_TEXTURE_COMPARE_FAIL_VALUE_ARB", GL_TEXTURE_COMPARE_FAIL_VALUE_ARB as i64),
    ("GL_TEXTURE_MAX_ANISOTROPY_EXT", GL_TEXTURE_MAX_ANISOTROPY_EXT as i64),
    ("GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT", GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT as i64),
    ("GL_FOG_COORD_SRC", GL_FOG_COORD_SRC as i64),
    ("GL_FOG_COORD", GL_FOG_COORD as i64),
    ("GL_CURRENT_FOG_COORD", GL_CURRENT_FOG_COORD as i64),
    ("GL_FOG_COORD_ARRAY_TYPE", GL_FOG_COORD_ARRAY_TYPE as i64),
    ("GL_FOG_COORD_ARRAY_STRIDE", GL_FOG_COORD_ARRAY_STRIDE as i64),
    ("GL_FOG_COORD_ARRAY_POINTER", GL_FOG_COORD_ARRAY_POINTER as i64),
    ("GL_FOG_COORD_ARRAY", GL_FOG_COORD_ARRAY as i64),
    ("GL_SRC0_RGB", GL_SRC0_RGB as i64),
    ("GL_SRC1_RGB", GL_SRC1_RGB as i64),
    ("GL_SRC2_RGB", GL_SRC2_RGB as i64),
    ("GL_SRC0_ALPHA", GL_SRC0_ALPHA as i64),
    ("GL_SRC1_ALPHA", GL_SRC1_ALPHA as i64),
    ("GL_SRC2_ALPHA", GL_SRC2_ALPHA as i64),
];

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
