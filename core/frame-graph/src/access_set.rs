//! A set of accesses in one word.

use std::fmt;
use std::ops::{BitOr, BitOrAssign};

use crate::{Access, Layout};

/// A set of [`Access`]es.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct AccessSet(u32);

const _: () = assert!(Access::ALL.len() <= u32::BITS as usize);

impl AccessSet {
    pub const EMPTY: Self = Self(0);

    /// All accesses that write.
    pub const WRITES: Self = {
        let mut bits = 0;
        let mut index = 0;
        while index < Access::ALL.len() {
            if Access::ALL[index].writes() {
                bits |= Self::of(Access::ALL[index]).0;
            }
            index += 1;
        }
        Self(bits)
    };

    /// The set of one access.
    pub const fn of(access: Access) -> Self {
        Self(1 << access as u32)
    }

    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    pub const fn contains(self, access: Access) -> bool {
        self.0 & Self::of(access).0 != 0
    }

    pub const fn intersects(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// The accesses of `self` that are not in `other`.
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether any access of the set changes the resource.
    pub const fn writes(self) -> bool {
        self.intersects(Self::WRITES)
    }

    /// The accesses, in the order of their declaration.
    pub fn iter(self) -> impl Iterator<Item = Access> {
        let mut rest = self.0;
        std::iter::from_fn(move || {
            let index = rest.trailing_zeros() as usize;
            rest &= rest.wrapping_sub(1);
            Access::ALL.get(index).copied()
        })
    }

    /// The one layout in which an image serves all these accesses: none if they disagree,
    /// [`Layout::Undefined`] for the empty set.
    pub fn layout(self) -> Option<Layout> {
        let mut accesses = self.iter();
        let Some(first) = accesses.next() else {
            return Some(Layout::Undefined);
        };
        accesses.try_fold(first.layout(), |layout, access| layout.join(access.layout()))
    }

    /// Whether one pass may touch one resource in all these ways at once. A write tolerates
    /// beside it only the read that belongs to it: anything else would be a race.
    pub fn is_free_of_conflict(self) -> bool {
        let Some(write) = self.iter().find(|access| access.writes()) else {
            return true;
        };
        let tolerated = Self::of(write) | write.read_counterpart().map(Self::of).unwrap_or_default();
        self.without(tolerated).is_empty()
    }
}

impl From<Access> for AccessSet {
    fn from(access: Access) -> Self {
        Self::of(access)
    }
}

impl FromIterator<Access> for AccessSet {
    fn from_iter<I: IntoIterator<Item = Access>>(accesses: I) -> Self {
        accesses.into_iter().fold(Self::EMPTY, |set, access| set | Self::of(access))
    }
}

impl BitOr for AccessSet {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitOrAssign for AccessSet {
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

impl fmt::Debug for AccessSet {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_set().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set<const N: usize>(accesses: [Access; N]) -> AccessSet {
        accesses.into_iter().collect()
    }

    #[test]
    fn iterates_what_was_collected() {
        let all: AccessSet = Access::ALL.into_iter().collect();
        assert!(all.iter().eq(Access::ALL));
        assert_eq!(AccessSet::EMPTY.iter().count(), 0);
    }

    #[test]
    fn layouts_join_only_where_one_serves_all() {
        use Access::*;
        assert_eq!(set([SampledFragment, SampledCompute]).layout(), Some(Layout::ShaderRead));
        assert_eq!(set([DepthRead, SampledFragment]).layout(), Some(Layout::DepthRead));
        assert_eq!(set([SampledFragment, TransferSrc]).layout(), None);
    }

    #[test]
    fn a_write_tolerates_only_its_own_read() {
        use Access::*;
        assert!(set([StorageReadCompute, StorageWriteCompute]).is_free_of_conflict());
        assert!(set([VertexRead, IndexRead, TransferSrc]).is_free_of_conflict());
        assert!(!set([StorageReadFragment, StorageWriteCompute]).is_free_of_conflict());
        assert!(!set([ColorAttachment, StorageWriteFragment]).is_free_of_conflict());
        assert!(!set([TransferSrc, TransferDst]).is_free_of_conflict());
    }
}
