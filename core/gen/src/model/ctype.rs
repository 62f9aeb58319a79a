//! C types of parameters and results, normalised.

/// What is left of a C type without pointers and `const`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the names are OpenGL's")]
pub enum Base {
    Void,
    Boolean,
    Byte,
    UByte,
    Short,
    UShort,
    Int,
    UInt,
    Enum,
    Bitfield,
    Sizei,
    Float,
    Clampf,
    Double,
    Clampd,
    Half,
    Fixed,
    Int64,
    UInt64,
    Intptr,
    Sizeiptr,
    Char,
    /// An XID or a Windows handle, a sync object, a function: as wide as a pointer at most, to be passed on.
    Handle,
    /// A structure, of which there are only pointers.
    Struct,
}

/// A C type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CType {
    /// What is pointed to in the end.
    pub base: Base,
    /// How many `*` there are.
    pub pointers: u8,
    /// Whether what is pointed to is constant.
    pub constant: bool,
}

impl CType {
    /// Reads the text of a declaration without the declared name, `const GLfloat *` for example.
    pub fn parse(text: &str) -> CType {
        let mut pointers = text.matches('*').count() as u8;
        let constant = text.trim_start().starts_with("const ") && pointers > 0;
        let words = text.replace(['*'], " ");
        let mut words = words.split_whitespace().filter(|&word| word != "const");
        let name = words.by_ref().collect::<Vec<_>>().join(" ");
        if name.starts_with("LP") || name == "PGPU_DEVICE" {
            pointers += 1;
        }
        CType { base: base(&name), pointers, constant }
    }

    /// Whether it is neither pointer nor `void`.
    pub fn is_scalar(self) -> bool {
        self.pointers == 0 && self.base != Base::Void
    }
}

fn base(name: &str) -> Base {
    match name {
        "void" | "GLvoid" | "VOID" | "LPVOID" => Base::Void,
        "GLboolean" => Base::Boolean,
        "GLbyte" => Base::Byte,
        "GLubyte" => Base::UByte,
        "GLshort" => Base::Short,
        "GLushort" | "USHORT" => Base::UShort,
        "GLint" | "int" | "Bool" | "Status" | "BOOL" | "INT" | "INT32" | "int32_t" | "GLclampx" => Base::Int,
        "GLuint" | "unsigned int" | "UINT" | "DWORD" | "COLORREF" => Base::UInt,
        "GLenum" => Base::Enum,
        "GLbitfield" => Base::Bitfield,
        "GLsizei" => Base::Sizei,
        "GLfloat" | "float" | "FLOAT" => Base::Float,
        "GLclampf" => Base::Clampf,
        "GLdouble" => Base::Double,
        "GLclampd" => Base::Clampd,
        "GLhalfNV" => Base::Half,
        "GLfixed" => Base::Fixed,
        "GLint64" | "GLint64EXT" | "INT64" | "int64_t" => Base::Int64,
        "GLuint64" | "GLuint64EXT" => Base::UInt64,
        "GLintptr" | "GLintptrARB" | "GLvdpauSurfaceNV" => Base::Intptr,
        "GLsizeiptr" | "GLsizeiptrARB" => Base::Sizeiptr,
        "GLchar" | "GLcharARB" | "char" | "LPCSTR" => Base::Char,
        "Display" | "XVisualInfo" | "PIXELFORMATDESCRIPTOR" | "LAYERPLANEDESCRIPTOR" => Base::Struct,
        "LPGLYPHMETRICSFLOAT" | "PGPU_DEVICE" | "DMparams" => Base::Struct,
        "GLXHyperpipeNetworkSGIX" | "GLXHyperpipeConfigSGIX" => Base::Struct,
        _ if name.starts_with("struct ") => Base::Struct,
        _ => Base::Handle,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declarations_are_read() {
        let parsed = |text| {
            let CType { base, pointers, constant } = CType::parse(text);
            (base, pointers, constant)
        };
        assert_eq!(parsed("void "), (Base::Void, 0, false));
        assert_eq!(parsed("const void *const*"), (Base::Void, 2, true));
        assert_eq!(parsed("GLuint *"), (Base::UInt, 1, false));
        assert_eq!(parsed("const GLXContext "), (Base::Handle, 0, false));
        assert_eq!(parsed("const unsigned long *"), (Base::Handle, 1, true));
        assert_eq!(parsed("LPVOID "), (Base::Void, 1, false));
    }
}
