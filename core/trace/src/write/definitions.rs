//! Signatures, which are written where their ids first occur.

use std::io::Write;

use super::TraceWriter;

/// A function by its id, name and names of arguments.
#[derive(Clone, Copy, Debug)]
pub struct Function<'a> {
    pub id: u32,
    pub name: &'a str,
    pub arguments: &'a [&'a str],
}

/// An enumeration by its id, and its names.
#[derive(Clone, Copy, Debug)]
pub struct Enumeration<'a> {
    pub id: u32,
    pub values: &'a [(&'a str, i64)],
}

/// A bitmask by its id, and the names of its bits; names of several bits come before those of each.
#[derive(Clone, Copy, Debug)]
pub struct Bitmask<'a> {
    pub id: u32,
    pub flags: &'a [(&'a str, u64)],
}

/// A structure by its id, its name, and names of its members.
#[derive(Clone, Copy, Debug)]
pub struct Structure<'a> {
    pub id: u32,
    pub name: &'a str,
    pub members: &'a [&'a str],
}

/// Which signatures have been written.
#[derive(Default)]
pub(super) struct Defined {
    functions: Ids,
    enums: Ids,
    bitmasks: Ids,
    structs: Ids,
}

#[derive(Default)]
struct Ids(Vec<bool>);

impl Ids {
    /// Notes an id; whether it is new.
    #[inline]
    fn insert(&mut self, id: u32) -> bool {
        match self.0.get_mut(id as usize) {
            Some(known) => !std::mem::replace(known, true),
            None => self.insert_beyond(id as usize),
        }
    }

    #[cold]
    fn insert_beyond(&mut self, id: usize) -> bool {
        self.0.resize(id + 1, false);
        self.0[id] = true;
        true
    }
}

impl<W: Write> TraceWriter<W> {
    #[inline]
    pub(super) fn function(&mut self, function: &Function) {
        self.out.uint(function.id.into());
        if self.defined.functions.insert(function.id) {
            self.out.string(function.name.as_bytes());
            self.names(function.arguments);
        }
    }

    #[inline]
    pub(super) fn enumeration(&mut self, enumeration: &Enumeration) {
        self.out.uint(enumeration.id.into());
        if self.defined.enums.insert(enumeration.id) {
            self.out.uint(enumeration.values.len() as u64);
            for (name, value) in enumeration.values {
                self.out.string(name.as_bytes());
                self.sint(*value);
            }
        }
    }

    pub(super) fn bitmask(&mut self, bitmask: &Bitmask) {
        self.out.uint(bitmask.id.into());
        if self.defined.bitmasks.insert(bitmask.id) {
            self.out.uint(bitmask.flags.len() as u64);
            for (name, flag) in bitmask.flags {
                self.out.string(name.as_bytes());
                self.out.uint(*flag);
            }
        }
    }

    pub(super) fn structure_id(&mut self, structure: &Structure) {
        self.out.uint(structure.id.into());
        if self.defined.structs.insert(structure.id) {
            self.out.string(structure.name.as_bytes());
            self.names(structure.members);
        }
    }

    fn names(&mut self, names: &[&str]) {
        self.out.uint(names.len() as u64);
        for name in names {
            self.out.string(name.as_bytes());
        }
    }
}
