//! Lists of attributes, as programs give them: words up to a zero.

use std::ffi::c_int;

/// Attributes that one list may have; a longer one is not terminated.
const MOST_ATTRIBUTES: usize = 128;

/// An attribute and its value.
pub type Attribute = (u32, i32);

/// Reads a list. Attributes in `flags` have no value in it, and are 1.
///
/// # Safety
/// `list` is null or can be read up to a zero in an attribute's place.
pub unsafe fn read(list: *const c_int, flags: &[u32]) -> Vec<Attribute> {
    if list.is_null() {
        return Vec::new();
    }
    let mut next = list;
    parse(
        || {
            // SAFETY: `parse` asks for nothing behind the zero, and the caller vouches for what is before it.
            let word = unsafe { next.read_unaligned() };
            next = next.wrapping_add(1);
            word
        },
        flags,
    )
}

fn parse(mut word: impl FnMut() -> c_int, flags: &[u32]) -> Vec<Attribute> {
    let mut attributes = Vec::new();
    while attributes.len() < MOST_ATTRIBUTES {
        let attribute = word() as u32;
        if attribute == 0 {
            break;
        }
        let value = if flags.contains(&attribute) { 1 } else { word() };
        attributes.push((attribute, value));
    }
    attributes
}

/// The value of the last attribute of that kind.
pub fn value(attributes: &[Attribute], wanted: u32) -> Option<i32> {
    attributes.iter().rev().find(|(attribute, _)| *attribute == wanted).map(|(_, value)| *value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(words: &[c_int], flags: &[u32]) -> Vec<Attribute> {
        let mut words = words.iter();
        parse(|| *words.next().expect("read behind the end"), flags)
    }

    #[test]
    fn pairs_and_flags() {
        assert_eq!(parsed(&[0], &[]), []);
        assert_eq!(parsed(&[4, 5, 12, 24, 0], &[4, 5]), [(4, 1), (5, 1), (12, 24)]);
        assert_eq!(parsed(&[5, 0, 12, -1, 0], &[]), [(5, 0), (12, -1)]);
        // SAFETY: null is allowed.
        assert_eq!(unsafe { read(std::ptr::null(), &[]) }, []);
        // SAFETY: the list ends with a zero.
        assert_eq!(unsafe { read([8, 1, 8, 2, 0].as_ptr(), &[]) }, [(8, 1), (8, 2)]);
    }

    #[test]
    fn a_list_without_an_end_is_cut() {
        assert_eq!(parse(|| 7, &[]).len(), MOST_ATTRIBUTES);
        assert_eq!(parse(|| 7, &[7]).len(), MOST_ATTRIBUTES);
    }

    #[test]
    fn the_last_value_counts() {
        assert_eq!(value(&[(8, 1), (9, 3), (8, 2)], 8), Some(2));
        assert_eq!(value(&[], 8), None);
    }
}
