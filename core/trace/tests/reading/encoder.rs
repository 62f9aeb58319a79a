//! Writes traces of any version, correct or not.

use std::collections::HashSet;

/// A value to write; signatures are given by id and written out where first used.
pub enum V {
    Null,
    Bool(bool),
    SInt(i64),
    UInt(u64),
    Float(f32),
    Double(f64),
    Str(&'static [u8]),
    Blob(Vec<u8>),
    Enum(u64, &'static [(&'static str, i64)], i64),
    Bitmask(u64, &'static [(&'static str, u64)], u64),
    Array(Vec<V>),
    Struct(u64, &'static str, &'static [&'static str], Vec<V>),
    Opaque(u64),
    Repr(Box<[V; 2]>),
    WStr(&'static [u64]),
}

/// What a function's signature says.
pub struct Function(pub u64, pub &'static str, pub &'static [&'static str]);

#[derive(Clone)]
pub struct Encoder {
    pub bytes: Vec<u8>,
    version: u64,
    defined: HashSet<(&'static str, u64)>,
    entered: u64,
}

impl Encoder {
    pub fn new(version: u64) -> Self {
        let mut encoder = Self { bytes: Vec::new(), version, defined: HashSet::new(), entered: 0 };
        encoder.uint(version);
        if version >= 6 {
            encoder.uint(5);
            for text in ["process.name", "/usr/bin/game", "os", "Linux", ""] {
                encoder.string(text.as_bytes());
            }
        }
        encoder
    }

    pub fn uint(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.bytes.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.bytes.push(value as u8);
    }

    pub fn string(&mut self, text: &[u8]) {
        self.uint(text.len() as u64);
        self.bytes.extend(text);
    }

    fn strings(&mut self, texts: &[&str]) {
        self.uint(texts.len() as u64);
        for text in texts {
            self.string(text.as_bytes());
        }
    }

    /// Writes an id, and returns whether its signature must follow.
    fn id(&mut self, kind: &'static str, id: u64) -> bool {
        self.uint(id);
        self.defined.insert((kind, id))
    }

    /// Begins an enter event and returns the call's number.
    pub fn begin_enter(&mut self, thread: u64, function: &Function) -> u64 {
        self.bytes.push(0);
        if self.version >= 4 {
            self.uint(thread);
        }
        if self.id("function", function.0) {
            self.string(function.1.as_bytes());
            self.strings(function.2);
        }
        if self.version < 4 {
            self.bytes.push(3);
            self.uint(thread);
        }
        self.entered += 1;
        self.entered - 1
    }

    pub fn begin_leave(&mut self, number: u64) {
        self.bytes.push(1);
        self.uint(number);
    }

    pub fn end(&mut self) {
        self.bytes.push(0);
    }

    pub fn arg(&mut self, index: u64, value: V) {
        self.bytes.push(1);
        self.uint(index);
        self.value(value);
    }

    pub fn ret(&mut self, value: V) {
        self.bytes.push(2);
        self.value(value);
    }

    pub fn fake(&mut self) {
        self.bytes.extend([5, 1]);
    }

    /// Writes a backtrace of frames that all have the same details.
    pub fn backtrace(&mut self, frames: &[u64]) {
        self.bytes.push(4);
        self.uint(frames.len() as u64);
        for &frame in frames {
            if self.id("frame", frame) {
                for (tag, text) in [(1, "game"), (2, "draw"), (3, "game.c")] {
                    self.bytes.push(tag);
                    self.string(text.as_bytes());
                }
                self.bytes.push(4);
                self.uint(300 + frame);
                self.bytes.extend([5, 0x10, 0]);
            }
        }
    }

    /// Writes a whole call that returns at once.
    pub fn call(&mut self, thread: u64, function: &Function, args: Vec<V>, ret: Option<V>) {
        let number = self.enter(thread, function, args);
        self.begin_leave(number);
        if let Some(ret) = ret {
            self.ret(ret);
        }
        self.end();
    }

    /// Writes a whole enter event.
    pub fn enter(&mut self, thread: u64, function: &Function, args: Vec<V>) -> u64 {
        let number = self.begin_enter(thread, function);
        for (index, arg) in args.into_iter().enumerate() {
            self.arg(index as u64, arg);
        }
        self.end();
        number
    }

    /// Writes a leave event without results.
    pub fn leave(&mut self, number: u64) {
        self.begin_leave(number);
        self.end();
    }

    pub fn tagged(&mut self, tag: u8, value: u64) {
        self.bytes.push(tag);
        self.uint(value);
    }

    fn sint(&mut self, value: i64) {
        self.tagged(if value < 0 { 3 } else { 4 }, value.unsigned_abs());
    }

    pub fn value(&mut self, value: V) {
        match value {
            V::Null => self.bytes.push(0),
            V::Bool(value) => self.bytes.push(1 + u8::from(value)),
            V::SInt(value) => self.sint(value),
            V::UInt(value) => self.tagged(4, value),
            V::Float(value) => {
                self.bytes.push(5);
                self.bytes.extend(value.to_le_bytes());
            }
            V::Double(value) => {
                self.bytes.push(6);
                self.bytes.extend(value.to_le_bytes());
            }
            V::Str(text) => {
                self.bytes.push(7);
                self.string(text);
            }
            V::Blob(bytes) => {
                self.bytes.push(8);
                self.string(&bytes);
            }
            V::Enum(id, values, value) => self.enumerant(id, values, value),
            V::Bitmask(id, flags, value) => {
                self.bytes.push(10);
                if self.id("bitmask", id) {
                    self.uint(flags.len() as u64);
                    for (name, flag) in flags {
                        self.string(name.as_bytes());
                        self.uint(*flag);
                    }
                }
                self.uint(value);
            }
            V::Array(values) => {
                self.tagged(11, values.len() as u64);
                values.into_iter().for_each(|value| self.value(value));
            }
            V::Struct(id, name, member_names, members) => {
                self.bytes.push(12);
                if self.id("struct", id) {
                    self.string(name.as_bytes());
                    self.strings(member_names);
                }
                members.into_iter().for_each(|value| self.value(value));
            }
            V::Opaque(value) => self.tagged(13, value),
            V::Repr(pair) => {
                self.bytes.push(14);
                pair.into_iter().for_each(|value| self.value(value));
            }
            V::WStr(characters) => {
                self.tagged(15, characters.len() as u64);
                characters.iter().for_each(|&code| self.uint(code));
            }
        }
    }

    fn enumerant(&mut self, id: u64, values: &[(&str, i64)], value: i64) {
        self.bytes.push(9);
        if self.version < 3 {
            let position = values.iter().position(|known| known.1 == value).unwrap();
            if self.id("enum", id * 100 + position as u64) {
                self.string(values[position].0.as_bytes());
                self.sint(value);
            }
            return;
        }
        if self.id("enum", id) {
            self.uint(values.len() as u64);
            for (name, value) in values {
                self.string(name.as_bytes());
                self.sint(*value);
            }
        }
        self.sint(value);
    }
}
