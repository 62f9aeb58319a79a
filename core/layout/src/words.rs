//! Bit fields packed in `u32` words, with accessors in Rust and GLSL.

/// One bit field of a packed word.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BitField {
    /// The field's name.
    pub name: &'static str,
    /// Which word of the array holds it.
    pub word: usize,
    /// The lowest bit.
    pub shift: u32,
    /// How many bits.
    pub bits: u32,
}

/// Packed words as data.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WordsDescription {
    /// Prefix of the GLSL accessors.
    pub prefix: &'static str,
    /// Number of words.
    pub count: usize,
    /// The fields.
    pub fields: Vec<BitField>,
}

impl WordsDescription {
    /// GLSL: for each field the index of its word as `PREFIX_FIELD_WORD` and an accessor macro
    /// `prefix_field(word)`, which stays a constant expression for specialisation constants.
    pub fn glsl(&self) -> String {
        let mut text = format!("#define {}_WORDS {}\n", self.prefix.to_uppercase(), self.count);
        for field in &self.fields {
            let mask = if field.bits == 32 { u32::MAX } else { (1 << field.bits) - 1 };
            text += &format!(
                "#define {}_{}_WORD {}\n#define {}_{}(w) (((w) >> {}) & 0x{:x}u)\n",
                self.prefix.to_uppercase(),
                field.name.to_uppercase(),
                field.word,
                self.prefix,
                field.name,
                field.shift,
                mask
            );
        }
        text
    }
}

/// Declares packed words: `pub struct Name: "prefix", COUNT { word 0 { field: bits, ... } ... }`.
/// Fields of a word are placed from bit 0 upward. Setters keep only the field's bits.
#[macro_export]
macro_rules! packed_words {
    ($(#[$meta:meta])* pub struct $name:ident: $prefix:literal, $count:literal {
        $(word $word:literal { $($(#[$field_meta:meta])* $field:ident: $bits:literal,)* })*
    }) => {
        $(#[$meta])*
        #[repr(transparent)]
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
        pub struct $name(pub [u32; $count]);

        $crate::bytemuck_transparent!($name, $count);

        impl $name {
            $($crate::packed_words!(@fields $word, 0u32; $($(#[$field_meta])* $field: $bits,)*);)*

            /// The words as data.
            pub fn description() -> $crate::WordsDescription {
                let mut fields = Vec::new();
                $({
                    let mut shift = 0;
                    $(
                        fields.push($crate::BitField { name: stringify!($field), word: $word, shift, bits: $bits });
                        shift += $bits;
                    )*
                    assert!(shift <= 32, "word {} has {} bits", $word, shift);
                })*
                $crate::WordsDescription { prefix: $prefix, count: $count, fields }
            }
        }
    };
    (@fields $word:literal, $shift:expr;) => {};
    (@fields $word:literal, $shift:expr; $(#[$field_meta:meta])* $field:ident: $bits:literal, $($rest:tt)*) => {
        $(#[$field_meta])*
        #[inline]
        pub const fn $field(&self) -> u32 {
            (self.0[$word] >> ($shift)) & (u32::MAX >> (32 - $bits))
        }
        $crate::packed_words!(@setter $word, $shift, $field, $bits);
        $crate::packed_words!(@fields $word, $shift + $bits; $($rest)*);
    };
    (@setter $word:literal, $shift:expr, $field:ident, $bits:literal) => {
        $crate::paste! {
            /// Sets the field of the same name.
            #[inline]
            pub const fn [<set_ $field>](&mut self, value: u32) {
                let mask = (u32::MAX >> (32 - $bits)) << ($shift);
                self.0[$word] = (self.0[$word] & !mask) | ((value << ($shift)) & mask);
            }
        }
    };
}

/// Marks a transparent array of words as plain data.
#[doc(hidden)]
#[macro_export]
macro_rules! bytemuck_transparent {
    ($name:ident, $count:literal) => {
        // SAFETY: a transparent wrapper of an array of u32 has no padding and accepts all bits.
        unsafe impl $crate::bytemuck::Zeroable for $name {}
        // SAFETY: as above.
        unsafe impl $crate::bytemuck::Pod for $name {}
    };
}
