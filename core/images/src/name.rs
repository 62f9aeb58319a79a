//! Names of files.

use std::fmt;

/// What of a texture a file replaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// Colour (sRGB) and alpha.
    Color,
    /// The normal in the surface's own space, x along growing s and y along growing t, each from -1 to 1 as 0 to 1; how much
    /// of the surface is metal in alpha.
    Normal,
    /// Radiance that is given off (sRGB), perceptual roughness in alpha.
    Emission,
}

impl Role {
    /// All of them; a role's place here is its number.
    pub const ALL: [Role; 3] = [Role::Color, Role::Normal, Role::Emission];

    /// What names of files have after the hash.
    fn suffix(self) -> &'static str {
        match self {
            Role::Color => "",
            Role::Normal => "_normal",
            Role::Emission => "_emission",
        }
    }
}

/// Which texture a file is for, and what of it: `HASH`, `HASH_normal` or `HASH_emission`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct FileName {
    /// Of the texture's content.
    pub hash: u64,
    /// What is replaced.
    pub role: Role,
}

impl FileName {
    /// A file's name without its ending; none if it is for no texture.
    pub fn parse(stem: &str) -> Option<FileName> {
        let digits = stem.get(..16).filter(|digits| digits.bytes().all(|digit| digit.is_ascii_hexdigit()))?;
        let role = Role::ALL.into_iter().find(|role| stem[16..].eq_ignore_ascii_case(role.suffix()))?;
        Some(FileName { hash: u64::from_str_radix(digits, 16).ok()?, role })
    }
}

impl fmt::Display for FileName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:016x}{}", self.hash, self.role.suffix())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_a_hash_and_a_role() {
        for role in Role::ALL {
            let name = FileName { hash: 0x00ab_cdef_0123_4567, role };
            assert_eq!(FileName::parse(&name.to_string()), Some(name));
            assert_eq!(FileName::parse(&name.to_string().to_uppercase()), Some(name));
        }
        for other in
            ["", "readme", "00abcdef0123456", "00abcdef01234567_x", "+0abcdef01234567", "00abcdef012345é7"]
        {
            assert_eq!(FileName::parse(other), None, "{other}");
        }
    }
}
