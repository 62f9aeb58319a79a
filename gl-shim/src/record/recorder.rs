//! Writing events.

use std::fs::File;
use std::io;
use std::time::{Duration, Instant};

use afterglow_api::{Command, CommandId};
use afterglow_gl::{Context, index_bytes, list_offset_bytes};
use afterglow_trace::TraceWriter;
use afterglow_trace::write::Function;

use super::names;
use super::number::{Number, Writer};
use super::plan::{Kind, Plan, plan};
use super::sizes::{self, natural};
use super::thread;
use crate::memory;

/// How old what is not in the file yet may become while calls are made.
const FLUSH_AFTER: Duration = Duration::from_millis(250);

/// Elements of an array and bytes of a blob that are recorded at most; commands of more are in error and read nothing.
const MOST_ELEMENTS: usize = 1 << 20;
const MOST_BYTES: usize = 1 << 29;

/// Calls between looks at the clock.
const CALLS_PER_LOOK: u32 = 1024;

/// The file and what has to be known to write it.
pub struct Recorder {
    pub writer: Writer,
    flushed: Instant,
    calls: u32,
    /// Whether the file takes no more.
    pub failed: bool,
}

impl Recorder {
    /// Begins a recording.
    pub fn new(file: File) -> io::Result<Recorder> {
        let program = std::env::current_exe().unwrap_or_default();
        let properties = [("process.name", &*program.to_string_lossy())];
        let writer = TraceWriter::new(file, &properties)?;
        Ok(Recorder { writer, flushed: Instant::now(), calls: 0, failed: false })
    }

    /// Writes what a call is given, and returns its number.
    ///
    /// # Safety
    /// Pointers are what the specification of the command wants.
    pub unsafe fn enter(
        &mut self,
        thread: u32,
        id: CommandId,
        arguments: &[u64],
        gl: Option<&Context>,
    ) -> u32 {
        let plan = plan(id);
        let number = self.begin(thread, id, plan);
        // SAFETY: the contract is the same.
        unsafe { self.arguments(plan, &plan.kinds, arguments, gl) };
        self.writer.end();
        number
    }

    fn begin(&mut self, thread: u32, id: CommandId, plan: &Plan) -> u32 {
        let function = Function { id: id.index() as u32, name: id.name(), arguments: &plan.names };
        self.writer.enter(thread, &function)
    }

    /// Writes the first arguments, as many as there are kinds.
    ///
    /// # Safety
    /// As for [`enter`](Self::enter).
    unsafe fn arguments(&mut self, plan: &Plan, kinds: &[Kind], arguments: &[u64], gl: Option<&Context>) {
        for (index, kind) in kinds.iter().enumerate() {
            if !plan.is_written(index) {
                self.writer.argument(index);
                // SAFETY: the contract is the same.
                unsafe { self.value(*kind, arguments, index, gl) };
            }
        }
    }

    /// Writes a call that the program did not make. Memory, if there is any, follows the arguments: its address, and how
    /// much of it is read.
    ///
    /// # Safety
    /// As for [`enter`](Self::enter).
    pub unsafe fn fake(&mut self, id: CommandId, arguments: &[u64], memory: Option<(u64, Option<usize>)>) {
        let plan = plan(id);
        let number = self.begin(thread(), id, plan);
        self.writer.fake();
        // SAFETY: the contract is the same.
        unsafe {
            self.arguments(plan, &plan.kinds[..arguments.len()], arguments, None);
            if let Some((address, bytes)) = memory {
                self.writer.argument(arguments.len());
                self.bytes(address, bytes);
            }
        }
        self.writer.end();
        self.writer.leave(number);
        self.writer.end();
    }

    /// Writes what a call gives.
    ///
    /// # Safety
    /// As for [`enter`](Self::enter).
    pub unsafe fn leave(
        &mut self,
        number: u32,
        id: CommandId,
        arguments: &[u64],
        result: u64,
        gl: Option<&Context>,
    ) {
        let plan = plan(id);
        self.writer.leave(number);
        for (index, kind) in plan.kinds.iter().enumerate() {
            if plan.is_written(index) {
                self.writer.argument(index);
                // SAFETY: the contract is the same.
                unsafe { self.value(*kind, arguments, index, gl) };
            }
        }
        if let Some(kind) = plan.result {
            self.writer.result();
            // SAFETY: a string that is returned ends with zero.
            unsafe { self.value(kind, &[result], 0, None) };
        }
        self.writer.end();
        self.calls += 1;
        if self.calls >= CALLS_PER_LOOK {
            self.look_at_the_clock();
        }
    }

    #[cold]
    fn look_at_the_clock(&mut self) {
        self.calls = 0;
        if self.flushed.elapsed() >= FLUSH_AFTER {
            self.flush();
        }
    }

    /// Brings the file up to date.
    pub fn flush(&mut self) {
        self.flushed = Instant::now();
        if let Err(error) = self.writer.flush() {
            tracing::error!("recording ends: {error}");
            self.failed = true;
        }
    }

    /// Writes the argument at `index`, or a result.
    unsafe fn value(&mut self, kind: Kind, arguments: &[u64], index: usize, gl: Option<&Context>) {
        let bits = arguments[index];
        // SAFETY: the program's memory is as large as the command wants it to be.
        unsafe {
            match kind {
                Kind::Number(number) => number.write(&mut self.writer, bits),
                Kind::Parameter(number, pname) => {
                    self.symbolic(number, arguments[pname] as u32, bits);
                }
                Kind::Array(number, length) => {
                    self.array(number, bits, sizes::elements(length, arguments), None);
                }
                Kind::Parameters(number, pname) => {
                    let pname = arguments[pname] as u32;
                    self.array(number, bits, sizes::values_of(pname), Some(pname));
                }
                Kind::Answers(number, pname) => {
                    self.array(number, bits, sizes::values_of(arguments[pname] as u32), None);
                }
                Kind::PixelMap(number) => {
                    let values = gl.map_or(0, |gl| gl.pixel_map_len(arguments[0] as u32));
                    self.array(number, bits, values, None);
                }
                Kind::Bytes(count) => self.bytes(bits, Some(natural(arguments[count]))),
                Kind::Image(of) => self.bytes(bits, gl.and_then(|gl| sizes::image(gl, of, arguments))),
                Kind::Bitmap(of) => self.bytes(bits, gl.and_then(|gl| sizes::bitmap(gl, of, arguments))),
                Kind::Stipple => {
                    let size = gl.and_then(|gl| sizes::bitmap(gl, &[0, 1], &[32, 32]));
                    self.array(Number::U8, bits, size.unwrap_or(0), None);
                }
                Kind::Points(number, dimensions) => {
                    self.array(number, bits, sizes::points(dimensions, arguments), None);
                }
                Kind::Lists(count, kind) => {
                    let size = list_offset_bytes(arguments[kind] as u32);
                    self.bytes(bits, size.map(|size| natural(arguments[count]).saturating_mul(size)));
                }
                Kind::Indices(count, kind) => self.indices(bits, arguments[count], arguments[kind], gl),
                Kind::IndexLists => self.index_lists(arguments, gl),
                Kind::Text => self.text(bits),
            }
        }
    }

    fn symbolic(&mut self, number: Number, pname: u32, bits: u64) {
        match names::is_symbolic(pname) {
            true => number.write_symbolic(&mut self.writer, bits),
            false => number.write(&mut self.writer, bits),
        }
    }

    unsafe fn array(&mut self, number: Number, address: u64, elements: usize, pname: Option<u32>) {
        if address == 0 || elements > MOST_ELEMENTS {
            return self.writer.pointer(address);
        }
        self.writer.array(elements);
        for index in 0..elements {
            // SAFETY: there are so many elements.
            let bits = unsafe { number.load(address as usize, index) };
            match pname {
                Some(pname) => self.symbolic(number, pname, bits),
                None => number.write(&mut self.writer, bits),
            }
        }
    }

    /// Bytes that are read; none of a command in error.
    unsafe fn bytes(&mut self, address: u64, count: Option<usize>) {
        match count {
            Some(count) if address != 0 && count <= MOST_BYTES => {
                // SAFETY: there are so many bytes.
                self.writer.blob(unsafe { memory::bytes(address as _, count) });
            }
            _ => self.writer.null(),
        }
    }

    unsafe fn indices(&mut self, address: u64, count: u64, kind: u64, gl: Option<&Context>) {
        if gl.is_none_or(Context::has_element_buffer) {
            return self.writer.pointer(address);
        }
        let size = index_bytes(kind as u32);
        // SAFETY: there are so many indices.
        unsafe { self.bytes(address, size.map(|size| natural(count).saturating_mul(size))) };
    }

    /// glMultiDrawElements: mode, counts, type, indices, number.
    unsafe fn index_lists(&mut self, arguments: &[u64], gl: Option<&Context>) {
        let &[_, counts, kind, lists, draws] = arguments else { return self.writer.null() };
        if counts == 0 || lists == 0 || natural(draws) > MOST_ELEMENTS {
            return self.writer.null();
        }
        self.writer.array(natural(draws));
        for draw in 0..natural(draws) {
            // SAFETY: there are as many counts and lists as draws.
            unsafe {
                let count = Number::I32.load(counts as usize, draw);
                self.indices(Number::Address.load(lists as usize, draw), count, kind, gl);
            }
        }
    }

    unsafe fn text(&mut self, address: u64) {
        if address == 0 {
            return self.writer.null();
        }
        // SAFETY: it ends with zero.
        let text = unsafe { std::ffi::CStr::from_ptr(address as *const _) };
        self.writer.string(text.to_bytes());
    }
}

/// Ids of functions that are no commands.
pub fn id_beyond_commands(index: usize) -> u32 {
    (Command::all().len() + index) as u32
}
