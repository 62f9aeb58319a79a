//! `repr(C)` structures with a GLSL twin in scalar layout.

/// A field of a shared structure as GLSL declares it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StructField {
    /// The field's name, the same in both languages.
    pub name: &'static str,
    /// The GLSL type without array brackets, `vec4` for example.
    pub glsl: String,
    /// The array length, if the field is an array in GLSL.
    pub array: Option<usize>,
    /// Bytes from the start of the structure.
    pub offset: usize,
}

/// A shared structure as data, from which the GLSL text is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StructDescription {
    /// The type's name, the same in both languages.
    pub name: &'static str,
    /// The fields in order.
    pub fields: Vec<StructField>,
    /// Bytes of the structure, which is the stride of an array of it.
    pub size: usize,
}

impl StructDescription {
    /// The GLSL declaration of this structure.
    pub fn glsl(&self) -> String {
        let mut text = format!("struct {} {{ // {} bytes\n", self.name, self.size);
        for field in &self.fields {
            let brackets = field.array.map(|n| format!("[{n}]")).unwrap_or_default();
            text += &format!("    {} {}{};\n", field.glsl, field.name, brackets);
        }
        text + "};\n"
    }
}

/// A type that can be a field of a shared structure.
pub trait GlslField {
    /// The GLSL type without array brackets.
    fn glsl() -> String;
    /// The array length, if it is an array in GLSL.
    const ARRAY: Option<usize> = None;
}

/// A structure declared by [`shared_struct!`](crate::shared_struct).
pub trait SharedStruct: bytemuck::Pod {
    /// The type's name.
    const NAME: &'static str;
    /// The structure as data.
    fn description() -> StructDescription;
}

macro_rules! plain_fields {
    ($($rust:ty => $glsl:literal),* $(,)?) => {
        $(impl GlslField for $rust { fn glsl() -> String { $glsl.into() } })*
    };
}

plain_fields! {
    f32 => "float", u32 => "uint", i32 => "int", u64 => "uint64_t",
    [f32; 2] => "vec2", [f32; 3] => "vec3", [f32; 4] => "vec4",
    [[f32; 3]; 3] => "mat3", [[f32; 4]; 3] => "mat3x4", [[f32; 4]; 4] => "mat4",
}

impl<const N: usize> GlslField for [u32; N] {
    fn glsl() -> String {
        "uint".into()
    }
    const ARRAY: Option<usize> = Some(N);
}

impl<T: SharedStruct, const N: usize> GlslField for [T; N] {
    fn glsl() -> String {
        T::NAME.into()
    }
    const ARRAY: Option<usize> = Some(N);
}

/// Declares a structure shared with shaders. Fields are made of the types that implement
/// [`GlslField`]; there may be no padding (checked by `bytemuck::Pod`).
#[macro_export]
macro_rules! shared_struct {
    ($(#[$meta:meta])* pub struct $name:ident { $($(#[$field_meta:meta])* pub $field:ident: $ty:ty,)* }) => {
        $(#[$meta])*
        #[repr(C)]
        #[derive(Debug, Clone, Copy, PartialEq, $crate::bytemuck::Pod, $crate::bytemuck::Zeroable)]
        #[bytemuck(crate = "afterglow_layout::bytemuck")]
        pub struct $name { $($(#[$field_meta])* pub $field: $ty,)* }

        impl $crate::SharedStruct for $name {
            const NAME: &'static str = stringify!($name);
            fn description() -> $crate::StructDescription {
                $crate::StructDescription {
                    name: stringify!($name),
                    fields: vec![$($crate::StructField {
                        name: stringify!($field),
                        glsl: <$ty as $crate::GlslField>::glsl(),
                        array: <$ty as $crate::GlslField>::ARRAY,
                        offset: std::mem::offset_of!($name, $field),
                    },)*],
                    size: std::mem::size_of::<$name>(),
                }
            }
        }

        impl $crate::GlslField for $name {
            fn glsl() -> String { stringify!($name).into() }
        }
    };
}
