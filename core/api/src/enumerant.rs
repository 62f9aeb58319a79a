//! Names of enumerants, for people: a value may have several, so these are the oldest.

use crate::generated::enum_names::{GROUPS, NAMES};

/// The name of a value that is no bit of a mask and large enough to mean one thing.
pub fn enumerant_name(value: u32) -> Option<&'static str> {
    find(&NAMES, value)
}

/// The name of a value where one of `group` is expected; see [`Param::group`](crate::Param::group).
pub fn enumerant_in_group(group: &str, value: u32) -> Option<&'static str> {
    let index = GROUPS.binary_search_by(|(name, _)| (*name).cmp(group)).ok()?;
    find(GROUPS[index].1, value)
}

/// All names that [`enumerant_name`] knows, ordered by value.
pub fn enumerant_names() -> &'static [(u32, &'static str)] {
    &NAMES
}

fn find(names: &[(u32, &'static str)], value: u32) -> Option<&'static str> {
    let index = names.binary_search_by_key(&value, |&(value, _)| value).ok()?;
    Some(names[index].1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constants::*;

    #[test]
    fn values_have_names() {
        assert_eq!(enumerant_name(GL_LIGHTING), Some("GL_LIGHTING"));
        assert_eq!(enumerant_name(GL_TEXTURE0_ARB), Some("GL_TEXTURE0"));
        assert_eq!(enumerant_name(0xdead_beef), None);
    }

    #[test]
    fn small_values_have_names_in_groups() {
        assert_eq!(enumerant_in_group("PrimitiveType", GL_QUADS), Some("GL_QUADS"));
        assert_eq!(enumerant_in_group("AccumOp", GL_LOAD), Some("GL_LOAD"));
        assert_eq!(enumerant_in_group("PrimitiveType", GL_LIGHTING), None);
        assert_eq!(enumerant_in_group("Nonsense", 1), None);
    }
}
