//! Formats and types of pixels in memory (specification, tables 3.5 to 3.8).

use afterglow_api::constants::*;

use super::GlResult;

/// Which components a pixel has, in which order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names are OpenGL's")]
pub enum PixelFormat {
    ColorIndex,
    StencilIndex,
    Depth,
    Red,
    Green,
    Blue,
    Alpha,
    Rgb,
    Rgba,
    Bgr,
    Bgra,
    Luminance,
    LuminanceAlpha,
}

impl PixelFormat {
    /// The format of that number.
    ///
    /// # Errors
    /// GL_INVALID_ENUM if there is none.
    pub fn from_gl(format: u32) -> GlResult<PixelFormat> {
        Ok(match format {
            GL_COLOR_INDEX => PixelFormat::ColorIndex,
            GL_STENCIL_INDEX => PixelFormat::StencilIndex,
            GL_DEPTH_COMPONENT => PixelFormat::Depth,
            GL_RED => PixelFormat::Red,
            GL_GREEN => PixelFormat::Green,
            GL_BLUE => PixelFormat::Blue,
            GL_ALPHA => PixelFormat::Alpha,
            GL_RGB => PixelFormat::Rgb,
            GL_RGBA => PixelFormat::Rgba,
            GL_BGR => PixelFormat::Bgr,
            GL_BGRA => PixelFormat::Bgra,
            GL_LUMINANCE => PixelFormat::Luminance,
            GL_LUMINANCE_ALPHA => PixelFormat::LuminanceAlpha,
            _ => return Err(GL_INVALID_ENUM),
        })
    }

    /// Components of a pixel.
    pub const fn components(self) -> usize {
        match self {
            PixelFormat::Rgb | PixelFormat::Bgr => 3,
            PixelFormat::Rgba | PixelFormat::Bgra => 4,
            PixelFormat::LuminanceAlpha => 2,
            _ => 1,
        }
    }

    /// Pixels are indices.
    pub const fn is_index(self) -> bool {
        matches!(self, PixelFormat::ColorIndex | PixelFormat::StencilIndex)
    }

    /// Pixels are colours, or indices that stand for colours.
    pub const fn is_color(self) -> bool {
        !matches!(self, PixelFormat::StencilIndex | PixelFormat::Depth)
    }
}

/// A whole pixel in one unsigned integer. Components go from the most significant bit down, or, reversed, from
/// the least significant up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct PackedType {
    /// Bytes of the integer.
    pub bytes: u8,
    /// Bits of each component, first to last; 0 where there is none.
    pub bits: [u8; 4],
    /// Whether the first component is in the least significant bits.
    pub reversed: bool,
}

impl PackedType {
    const fn new(bytes: u8, bits: [u8; 4], reversed: bool) -> PackedType {
        PackedType { bytes, bits, reversed }
    }

    /// Components of a pixel.
    pub const fn components(self) -> usize {
        if self.bits[3] == 0 { 3 } else { 4 }
    }

    /// Of each component, how far it is above bit 0 and its greatest value.
    pub fn fields(self) -> [(u32, u32); 4] {
        let mut low = if self.reversed { 0 } else { 8 * u32::from(self.bytes) };
        self.bits.map(|bits| {
            let bits = u32::from(bits);
            if !self.reversed {
                low -= bits;
            }
            let field = (low, (1 << bits) - 1);
            if self.reversed {
                low += bits;
            }
            field
        })
    }
}

/// How components are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "named for the element")]
pub enum PixelType {
    Bitmap,
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    F32,
    Packed(PackedType),
}

impl PixelType {
    /// The type of that number.
    ///
    /// # Errors
    /// GL_INVALID_ENUM if there is none.
    pub fn from_gl(kind: u32) -> GlResult<PixelType> {
        let packed = |bytes, bits, reversed| PixelType::Packed(PackedType::new(bytes, bits, reversed));
        Ok(match kind {
            GL_BITMAP => PixelType::Bitmap,
            GL_UNSIGNED_BYTE => PixelType::U8,
            GL_BYTE => PixelType::I8,
            GL_UNSIGNED_SHORT => PixelType::U16,
            GL_SHORT => PixelType::I16,
            GL_UNSIGNED_INT => PixelType::U32,
            GL_INT => PixelType::I32,
            GL_FLOAT => PixelType::F32,
            GL_UNSIGNED_BYTE_3_3_2 => packed(1, [3, 3, 2, 0], false),
            GL_UNSIGNED_BYTE_2_3_3_REV => packed(1, [3, 3, 2, 0], true),
            GL_UNSIGNED_SHORT_5_6_5 => packed(2, [5, 6, 5, 0], false),
            GL_UNSIGNED_SHORT_5_6_5_REV => packed(2, [5, 6, 5, 0], true),
            GL_UNSIGNED_SHORT_4_4_4_4 => packed(2, [4, 4, 4, 4], false),
            GL_UNSIGNED_SHORT_4_4_4_4_REV => packed(2, [4, 4, 4, 4], true),
            GL_UNSIGNED_SHORT_5_5_5_1 => packed(2, [5, 5, 5, 1], false),
            GL_UNSIGNED_SHORT_1_5_5_5_REV => packed(2, [5, 5, 5, 1], true),
            GL_UNSIGNED_INT_8_8_8_8 => packed(4, [8, 8, 8, 8], false),
            GL_UNSIGNED_INT_8_8_8_8_REV => packed(4, [8, 8, 8, 8], true),
            GL_UNSIGNED_INT_10_10_10_2 => packed(4, [10, 10, 10, 2], false),
            GL_UNSIGNED_INT_2_10_10_10_REV => packed(4, [10, 10, 10, 2], true),
            _ => return Err(GL_INVALID_ENUM),
        })
    }

    /// Bytes of an element, which is a pixel for packed types; 1 for bitmaps.
    pub const fn element_bytes(self) -> usize {
        match self {
            PixelType::Bitmap | PixelType::U8 | PixelType::I8 => 1,
            PixelType::U16 | PixelType::I16 => 2,
            PixelType::U32 | PixelType::I32 | PixelType::F32 => 4,
            PixelType::Packed(packed) => packed.bytes as usize,
        }
    }
}

/// A format and a type that go together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct PixelLayout {
    /// Which components.
    pub format: PixelFormat,
    /// How they are stored.
    pub kind: PixelType,
}

impl PixelLayout {
    /// The layout that a command's `format` and `type` name.
    ///
    /// # Errors
    /// GL_INVALID_ENUM for an unknown format or type, or a bitmap that is not of indices;
    /// GL_INVALID_OPERATION for a packed type of another number of components.
    pub fn from_gl(format: u32, kind: u32) -> GlResult<PixelLayout> {
        let layout = PixelLayout { format: PixelFormat::from_gl(format)?, kind: PixelType::from_gl(kind)? };
        match layout.kind {
            PixelType::Bitmap if !layout.format.is_index() => Err(GL_INVALID_ENUM),
            PixelType::Packed(packed) if !layout.takes(packed) => Err(GL_INVALID_OPERATION),
            _ => Ok(layout),
        }
    }

    /// Table 3.8: three components are red, green, blue; four may begin with red or blue.
    fn takes(self, packed: PackedType) -> bool {
        match self.format {
            PixelFormat::Rgb => packed.components() == 3,
            PixelFormat::Rgba | PixelFormat::Bgra => packed.components() == 4,
            _ => false,
        }
    }

    /// Elements of a pixel.
    pub const fn elements(self) -> usize {
        match self.kind {
            PixelType::Packed(_) => 1,
            _ => self.format.components(),
        }
    }

    /// Bytes of a pixel; bitmaps have eight pixels a byte.
    pub const fn pixel_bytes(self) -> usize {
        self.elements() * self.kind.element_bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn illegal_pairs() {
        for (format, kind, error) in [
            (GL_RGBA, GL_BITMAP, GL_INVALID_ENUM),
            (GL_RGBA, GL_RGBA, GL_INVALID_ENUM),
            (GL_FLOAT, GL_FLOAT, GL_INVALID_ENUM),
            (GL_RGBA, GL_UNSIGNED_SHORT_5_6_5, GL_INVALID_OPERATION),
            (GL_BGR, GL_UNSIGNED_SHORT_5_6_5, GL_INVALID_OPERATION),
            (GL_RGB, GL_UNSIGNED_SHORT_5_5_5_1, GL_INVALID_OPERATION),
            (GL_LUMINANCE, GL_UNSIGNED_BYTE_3_3_2, GL_INVALID_OPERATION),
        ] {
            assert_eq!(PixelLayout::from_gl(format, kind), Err(error), "{format:#x} {kind:#x}");
        }
        assert!(PixelLayout::from_gl(GL_COLOR_INDEX, GL_BITMAP).is_ok());
        assert!(PixelLayout::from_gl(GL_BGRA, GL_UNSIGNED_SHORT_1_5_5_5_REV).is_ok());
    }

    #[test]
    fn fields_of_packed_types() {
        let fields = |kind| match PixelType::from_gl(kind) {
            Ok(PixelType::Packed(packed)) => packed.fields(),
            other => panic!("{other:?}"),
        };
        assert_eq!(fields(GL_UNSIGNED_BYTE_3_3_2)[..3], [(5, 7), (2, 7), (0, 3)]);
        assert_eq!(fields(GL_UNSIGNED_BYTE_2_3_3_REV)[..3], [(0, 7), (3, 7), (6, 3)]);
        assert_eq!(fields(GL_UNSIGNED_SHORT_5_5_5_1), [(11, 31), (6, 31), (1, 31), (0, 1)]);
        assert_eq!(fields(GL_UNSIGNED_INT_2_10_10_10_REV), [(0, 1023), (10, 1023), (20, 1023), (30, 3)]);
    }
}
