//! Names of commands taken apart.

use crate::model::Base;

/// What a member of a family adds to its stem: `3ubv`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Form<'a> {
    /// The stem.
    pub stem: &'a str,
    /// Number of components, if the name has it.
    pub count: Option<usize>,
    /// Type of the components.
    pub base: Base,
    /// Whether components are behind a pointer.
    pub vector: bool,
}

impl<'a> Form<'a> {
    /// The form of `name` if it is one of the stem's.
    pub fn of(name: &str, stem: &'a str) -> Option<Form<'a>> {
        let rest = without_vendor(name).strip_prefix("gl")?.strip_prefix(stem)?;
        let (count, rest) = match rest.chars().next()? {
            digit @ '1'..='4' => (digit.to_digit(10).map(|d| d as usize), &rest[1..]),
            _ => (None, rest),
        };
        let (letters, vector) = match rest.strip_suffix('v') {
            Some(letters) => (letters, true),
            None => (rest, false),
        };
        let base = match letters {
            "b" => Base::Byte,
            "s" => Base::Short,
            "i" => Base::Int,
            "f" => Base::Float,
            "d" => Base::Double,
            "ub" => Base::UByte,
            "us" => Base::UShort,
            "ui" => Base::UInt,
            // glGetBooleanv, glGetPointerv.
            "" if vector => Base::Void,
            _ => return None,
        };
        Some(Form { stem, count, base, vector })
    }
}

/// `glLockArraysEXT` without `EXT`.
fn without_vendor(name: &str) -> &str {
    let base = name.trim_end_matches(|letter: char| letter.is_ascii_uppercase());
    // "glTexImage2D" has no vendor, and no vendor has one letter.
    if name.len() - base.len() > 1 { base } else { name }
}

/// `glTexImage2D` as `tex_image_2d`; the vendor's suffix is dropped.
pub fn snake_case(name: &str) -> String {
    let name = without_vendor(name).trim_start_matches("gl");
    let mut text = String::new();
    for letter in name.chars() {
        let starts_word = letter.is_ascii_uppercase() || letter.is_ascii_digit();
        if starts_word && text.ends_with(|last: char| last.is_ascii_lowercase()) {
            text.push('_');
        }
        text.push(letter.to_ascii_lowercase());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_are_told_from_other_commands() {
        let form = |name, stem| Form::of(name, stem).map(|form| (form.count, form.base, form.vector));
        assert_eq!(form("glColor3ubv", "Color"), Some((Some(3), Base::UByte, true)));
        assert_eq!(form("glIndexub", "Index"), Some((None, Base::UByte, false)));
        assert_eq!(form("glFogfv", "Fog"), Some((None, Base::Float, true)));
        assert_eq!(form("glWindowPos4sMESA", "WindowPos"), Some((Some(4), Base::Short, false)));
        assert_eq!(form("glColorMask", "Color"), None);
        assert_eq!(form("glFogCoordf", "Fog"), None);
        assert_eq!(form("glEvalCoord1f", "EvalCoord"), Some((Some(1), Base::Float, false)));
    }

    #[test]
    fn names_become_names_of_methods() {
        assert_eq!(snake_case("glTexImage2D"), "tex_image_2d");
        assert_eq!(snake_case("glLockArraysEXT"), "lock_arrays");
        assert_eq!(snake_case("glPixelMapusv"), "pixel_mapusv");
        assert_eq!(snake_case("glBegin"), "begin");
    }
}
