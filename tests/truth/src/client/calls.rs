//! Calls of OpenGL and GLX, written into a trace.

use std::cell::RefCell;
use std::io::{self, Write};
use std::rc::Rc;

use afterglow_api::{Base, CommandId, id};
use afterglow_trace::TraceWriter;
use afterglow_trace::write::Function;

/// An argument of a call.
#[derive(Debug, Clone, Copy)]
pub enum Arg<'a> {
    /// GLenum, GLint, GLboolean and the like.
    Int(i64),
    /// GLfloat.
    Float(f32),
    /// What a pointer to floats points to.
    Floats(&'a [f32]),
    /// Memory.
    Bytes(&'a [u8]),
    /// An address or handle; 0 is null.
    Handle(u64),
}

impl From<u32> for Arg<'_> {
    fn from(value: u32) -> Self {
        Arg::Int(value.into())
    }
}

impl From<i32> for Arg<'_> {
    fn from(value: i32) -> Self {
        Arg::Int(value.into())
    }
}

impl From<f32> for Arg<'_> {
    fn from(value: f32) -> Self {
        Arg::Float(value)
    }
}

impl<'a> From<&'a [f32]> for Arg<'a> {
    fn from(values: &'a [f32]) -> Self {
        Arg::Floats(values)
    }
}

/// Writes calls by command: names of functions and arguments come from the registry.
pub struct Calls {
    writer: TraceWriter<Sink>,
    sink: Sink,
}

/// A file in memory that stays reachable while a writer has it.
#[derive(Debug, Clone, Default)]
struct Sink(Rc<RefCell<Vec<u8>>>);

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Handles of the one display, window and context.
const DISPLAY: Arg = Arg::Handle(0x1000);
const WINDOW: Arg = Arg::Handle(0x2000);
const CONTEXT: u64 = 0x3000;

impl Calls {
    /// Begins a trace of a program of that name, with a context that is current.
    ///
    /// # Errors
    /// Never in fact: memory takes all that is written.
    pub fn new(program: &str) -> io::Result<Calls> {
        let sink = Sink::default();
        let writer = TraceWriter::new(sink.clone(), &[("process.name", program)])?;
        let mut calls = Calls { writer, sink };
        let none = Arg::Handle(0);
        calls.write(id::glXCreateContext, &[DISPLAY, none, none, Arg::Int(1)], Some(Arg::Handle(CONTEXT)));
        calls.write(id::glXMakeCurrent, &[DISPLAY, WINDOW, Arg::Handle(CONTEXT)], Some(Arg::Int(1)));
        Ok(calls)
    }

    /// Writes a call that returns nothing.
    pub fn call(&mut self, command: CommandId, args: &[Arg]) {
        self.write(command, args, None);
    }

    /// Shows what was drawn.
    pub fn swap_buffers(&mut self) {
        self.call(id::glXSwapBuffers, &[DISPLAY, WINDOW]);
    }

    /// The trace.
    ///
    /// # Errors
    /// Never in fact: memory takes all that is written.
    pub fn finish(mut self) -> io::Result<Vec<u8>> {
        self.writer.flush()?;
        Ok(self.sink.0.take())
    }

    fn write(&mut self, command: CommandId, args: &[Arg], result: Option<Arg>) {
        let known = command.command();
        debug_assert_eq!(known.params.len(), args.len(), "{}", known.name);
        // No command has more parameters than this.
        let mut names = [""; 16];
        for (name, param) in names.iter_mut().zip(known.params) {
            *name = param.name;
        }
        let arguments = &names[..known.params.len()];
        let function = Function { id: command.index() as u32, name: known.name, arguments };
        let number = self.writer.enter(0, &function);
        for (index, (arg, param)) in args.iter().zip(known.params).enumerate() {
            self.writer.argument(index);
            self.value(*arg, param.ctype.base == Base::Boolean);
        }
        self.writer.end();
        self.writer.leave(number);
        if let Some(result) = result {
            self.writer.result();
            self.value(result, false);
        }
        self.writer.end();
    }

    fn value(&mut self, arg: Arg, is_boolean: bool) {
        match arg {
            Arg::Int(value) if is_boolean => self.writer.boolean(value != 0),
            Arg::Int(value) => self.writer.sint(value),
            Arg::Float(value) => self.writer.float(value),
            Arg::Floats(values) => {
                self.writer.array(values.len());
                for value in values {
                    self.writer.float(*value);
                }
            }
            Arg::Bytes(bytes) => self.writer.blob(bytes),
            Arg::Handle(handle) => self.writer.pointer(handle),
        }
    }
}
