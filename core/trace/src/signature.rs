//! Signatures: what a trace says once about functions, enumerations, bitmasks, structures and stack frames.
//!
//! The trace numbers each kind as the tracer pleases. Here each kind is numbered densely, in order of appearance, so
//! that a player can keep a table beside it.

use std::collections::HashMap;
use std::fmt;

macro_rules! dense_id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub(crate) u32);

        impl $name {
            /// Counted from 0 in order of first appearance.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl From<usize> for $name {
            // Limits on signatures keep every index far below 32 bits.
            fn from(index: usize) -> Self {
                Self(index as u32)
            }
        }
    };
}

dense_id!(
    /// A [`FunctionSignature`].
    SignatureId
);
dense_id!(
    /// An [`EnumSignature`].
    EnumId
);
dense_id!(
    /// A [`BitmaskSignature`].
    BitmaskId
);
dense_id!(
    /// A [`StructSignature`].
    StructId
);
dense_id!(
    /// A [`StackFrame`].
    FrameId
);

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FunctionSignature {
    pub id: SignatureId,
    pub name: Box<str>,
    pub arg_names: Vec<Box<str>>,
}

/// Names of an enumeration's values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnumSignature {
    pub id: EnumId,
    /// In the tracer's order; several names may share a value.
    pub values: Vec<(Box<str>, i64)>,
    /// Positions in `values`, by value, then by position.
    by_value: Vec<u32>,
}

impl EnumSignature {
    pub(crate) fn new(id: EnumId, values: Vec<(Box<str>, i64)>) -> Self {
        let mut by_value: Vec<u32> = (0..values.len() as u32).collect();
        by_value.sort_by_key(|&position| values[position as usize].1);
        Self { id, values, by_value }
    }

    /// The first name of a value.
    pub fn name(&self, value: i64) -> Option<&str> {
        let at = |&position: &u32| &self.values[position as usize];
        let first = self.by_value.partition_point(|position| at(position).1 < value);
        let (name, found) = self.by_value.get(first).map(at)?;
        (*found == value).then_some(&**name)
    }
}

/// Names of a bitmask's bits, or of groups of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BitmaskSignature {
    pub id: BitmaskId,
    pub flags: Vec<(Box<str>, u64)>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StructSignature {
    pub id: StructId,
    pub name: Box<str>,
    /// An anonymous member (a structure) has an empty name.
    pub member_names: Vec<Box<str>>,
}

/// A place in the program; displayed as `module: function+0xoffset: file:line`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StackFrame {
    pub module: Option<Box<str>>,
    pub function: Option<Box<str>>,
    pub file: Option<Box<str>>,
    pub line: Option<u64>,
    /// Bytes from the start of the module.
    pub offset: Option<u64>,
}

impl fmt::Display for StackFrame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.module.as_deref().unwrap_or("?"))?;
        if let Some(function) = &self.function {
            write!(f, ": {function}")?;
        }
        if let Some(offset) = self.offset {
            write!(f, "+{offset:#x}")?;
        }
        if let Some(file) = &self.file {
            write!(f, ": {file}")?;
            if let Some(line) = self.line {
                write!(f, ":{line}")?;
            }
        }
        Ok(())
    }
}

/// All signatures that have appeared so far.
///
/// Ids come from the calls and values of the same trace; those of another one may panic, as an index out of range does.
#[derive(Debug, Default)]
pub struct Signatures {
    pub(crate) functions: Table<FunctionSignature>,
    pub(crate) enums: Table<EnumSignature>,
    pub(crate) bitmasks: Table<BitmaskSignature>,
    pub(crate) structs: Table<StructSignature>,
    pub(crate) frames: Table<StackFrame>,
}

impl Signatures {
    /// All functions, by [`SignatureId::index`].
    pub fn functions(&self) -> &[FunctionSignature] {
        &self.functions.items
    }

    pub fn function(&self, id: SignatureId) -> &FunctionSignature {
        &self.functions.items[id.index()]
    }

    pub fn enumeration(&self, id: EnumId) -> &EnumSignature {
        &self.enums.items[id.index()]
    }

    pub fn bitmask(&self, id: BitmaskId) -> &BitmaskSignature {
        &self.bitmasks.items[id.index()]
    }

    pub fn structure(&self, id: StructId) -> &StructSignature {
        &self.structs.items[id.index()]
    }

    pub fn frame(&self, id: FrameId) -> &StackFrame {
        &self.frames.items[id.index()]
    }
}

/// Ids of the trace below this are looked up in an array; a trace numbers its functions from 0, so nearly all are.
const DIRECT_IDS: u64 = 1 << 13;

/// One kind of signature: the items in order of appearance, and the way to them from the trace's ids.
#[derive(Debug)]
pub(crate) struct Table<T> {
    pub items: Vec<T>,
    /// Index + 1 by id, 0 for an id not seen.
    direct: Vec<u32>,
    others: HashMap<u64, u32>,
}

impl<T> Default for Table<T> {
    fn default() -> Self {
        Self { items: Vec::new(), direct: Vec::new(), others: HashMap::new() }
    }
}

impl<T> Table<T> {
    /// Index of what the trace calls `id`, if it has appeared.
    #[inline]
    pub fn find(&self, id: u64) -> Option<usize> {
        if id < DIRECT_IDS {
            let entry = self.direct.get(id as usize).copied().unwrap_or(0);
            entry.checked_sub(1).map(|index| index as usize)
        } else {
            self.others.get(&id).map(|&index| index as usize)
        }
    }

    /// Adds what the trace calls `id` and returns its index.
    pub fn insert(&mut self, id: u64, item: T) -> usize {
        let index = self.items.len();
        self.items.push(item);
        if id < DIRECT_IDS {
            let slot = id as usize;
            if slot >= self.direct.len() {
                self.direct.resize(slot + 1, 0);
            }
            self.direct[slot] = index as u32 + 1;
        } else {
            self.others.insert(id, index as u32);
        }
        index
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_enumeration_gives_the_first_name_of_a_value() {
        let names = [("LINES", 1), ("ZERO", 0), ("ONE", 1), ("MINUS", -3)];
        let values = names.iter().map(|&(name, value)| (name.into(), value)).collect();
        let signature = EnumSignature::new(EnumId(0), values);
        assert_eq!(signature.name(1), Some("LINES"));
        assert_eq!(signature.name(0), Some("ZERO"));
        assert_eq!(signature.name(-3), Some("MINUS"));
        assert_eq!(signature.name(2), None);
        assert_eq!(signature.name(i64::MAX), None);
    }

    #[test]
    fn ids_of_any_size_are_found_without_memory_for_the_gaps() {
        let mut table = Table::default();
        for (index, id) in [7, 0, DIRECT_IDS - 1, DIRECT_IDS, u64::MAX].into_iter().enumerate() {
            assert_eq!(table.find(id), None);
            assert_eq!(table.insert(id, ()), index);
            assert_eq!(table.find(id), Some(index));
        }
        assert_eq!(table.find(8), None);
        assert!(table.direct.len() as u64 <= DIRECT_IDS);
    }

    #[test]
    fn a_stack_frame_prints_what_it_knows() {
        let mut frame = StackFrame { offset: Some(16), ..StackFrame::default() };
        assert_eq!(frame.to_string(), "?+0x10");
        frame = StackFrame {
            module: Some("a.so".into()),
            function: Some("draw".into()),
            file: Some("a.c".into()),
            line: Some(3),
            offset: None,
        };
        assert_eq!(frame.to_string(), "a.so: draw: a.c:3");
    }
}
