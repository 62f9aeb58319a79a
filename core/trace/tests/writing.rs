//! Traces that this crate writes, read by this crate.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::io::{self, Cursor, Write};
use std::process::Command;
use std::sync::{Arc, Mutex};

use afterglow_trace::dump::CallLine;
use afterglow_trace::write::{Bitmask, Enumeration, Function, Structure};
use afterglow_trace::{Call, Container, TraceReader, TraceWriter};

const LOTS: Function = Function { id: 9, name: "lots", arguments: &["a", "b", "c", "d", "e", "f", "g", "h"] };
const CLEAR: Function = Function { id: 300, name: "glClear", arguments: &["mask"] };
const ENUM: Enumeration =
    Enumeration { id: 1, values: &[("GL_ZERO", 0), ("GL_LIGHT0", 0x4000), ("GL_NEG", -2)] };
const BITS: Bitmask = Bitmask { id: 0, flags: &[("GL_DEPTH", 0x100), ("GL_COLOR", 0x4000)] };
const SIZE: Structure = Structure { id: 4, name: "Size", members: &["w", "h"] };

/// A file that stays readable while it is written.
#[derive(Clone, Default)]
struct Sink(Arc<Mutex<Vec<u8>>>);

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Sink {
    fn bytes(&self) -> Vec<u8> {
        self.0.lock().unwrap().clone()
    }
}

/// The lines of the calls in a file, however it ends.
fn lines(bytes: Vec<u8>) -> Vec<String> {
    let mut reader = TraceReader::from_reader(Cursor::new(bytes)).unwrap();
    assert_eq!(reader.container(), Container::Snappy);
    let (mut call, mut lines) = (Call::default(), Vec::new());
    while reader.next_call(&mut call).unwrap_or(false) {
        lines.push(CallLine::new(&call, reader.signatures()).to_string());
    }
    lines
}

fn writer(sink: &Sink) -> TraceWriter<Sink> {
    TraceWriter::new(sink.clone(), &[("process.name", "/usr/bin/game")]).unwrap()
}

fn clear(writer: &mut TraceWriter<Sink>, bits: u64) {
    let call = writer.enter(0, &CLEAR);
    writer.argument(0);
    writer.bits(&BITS, bits);
    writer.end();
    writer.leave(call);
    writer.end();
}

/// Writes one value.
type Value<'a> = &'a dyn Fn(&mut TraceWriter<Sink>);

fn lots(writer: &mut TraceWriter<Sink>) {
    let call = writer.enter(1, &LOTS);
    let values: [Value; 7] = [
        &|w| w.sint(-5),
        &|w| w.enumerant(&ENUM, -2),
        &|w| w.string(b"hi"),
        &|w| w.blob(&[1, 2, 3]),
        &|w| w.pointer(0x7fff_dead_beef),
        &|w| w.pointer(0),
        &|w| {
            w.array(3);
            w.float(0.5);
            w.double(1e-9);
            w.boolean(true);
        },
    ];
    for (index, value) in values.into_iter().enumerate() {
        writer.argument(index);
        value(writer);
    }
    writer.end();
    writer.leave(call);
    writer.argument(7);
    writer.array(1);
    writer.structure(&SIZE);
    writer.uint(640);
    writer.enumerant(&ENUM, 77);
    writer.result();
    writer.uint(u64::MAX);
    writer.end();
}

const LOTS_LINE: &str = concat!(
    r#"lots(a = -5, b = GL_NEG, c = "hi", d = blob(3), e = 0x7fffdeadbeef, f = NULL, g = {0.5, 1e-09, true}, "#,
    "h = &{w = 640, h = 77}) = 18446744073709551615"
);

#[test]
fn what_is_written_is_read() {
    let sink = Sink::default();
    let mut writer = writer(&sink);
    lots(&mut writer);
    let call = writer.enter(0, &CLEAR);
    writer.fake();
    writer.end();
    lots(&mut writer);
    writer.leave(call);
    writer.end();
    writer.flush().unwrap();

    let lines = lines(sink.bytes());
    assert_eq!(
        lines,
        [format!("0 {LOTS_LINE}"), "1 glClear(mask = ?) // fake".into(), format!("2 {LOTS_LINE}")]
    );
    let reader = TraceReader::from_reader(Cursor::new(sink.bytes())).unwrap();
    assert_eq!(reader.version(), 6);
    let named =
        reader.properties().iter().any(|(name, value)| name == "process.name" && value == "/usr/bin/game");
    assert!(named);
}

#[test]
fn a_file_is_a_trace_after_each_flush() {
    let sink = Sink::default();
    let mut writer = writer(&sink);
    for calls in 1..5 {
        clear(&mut writer, 0x100);
        writer.flush().unwrap();
        clear(&mut writer, 0x4000);
        let lines = lines(sink.bytes());
        assert_eq!(lines.len(), 2 * calls - 1);
    }
}

#[test]
fn a_cut_file_holds_what_comes_before_the_cut() {
    let sink = Sink::default();
    let mut writer = writer(&sink);
    let mut ends = Vec::new();
    for _ in 0..4 {
        lots(&mut writer);
        writer.flush().unwrap();
        ends.push(sink.bytes().len());
    }
    let whole = sink.bytes();
    for cut in ends[0]..whole.len() {
        let calls = ends.iter().filter(|end| **end <= cut).count();
        assert!(lines(whole[..cut].to_vec()).len() >= calls, "cut at {cut}");
    }
}

#[test]
fn blobs_larger_than_a_chunk_are_written() {
    let sink = Sink::default();
    let mut writer = writer(&sink);
    let blob: Vec<u8> = (0..5_000_000u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    let call = writer.enter(0, &CLEAR);
    writer.argument(0);
    writer.blob(&blob);
    writer.end();
    writer.leave(call);
    writer.end();
    writer.flush().unwrap();
    let mut reader = TraceReader::from_reader(Cursor::new(sink.bytes())).unwrap();
    let mut call = Call::default();
    assert!(reader.next_call(&mut call).unwrap());
    assert!(**call.arg(0).as_blob().unwrap() == *blob);
}

#[test]
fn an_error_of_the_sink_is_told() {
    struct Full(usize);
    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
            Ok(bytes.len())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let mut writer = TraceWriter::new(Full(100), &[]).unwrap();
    for _ in 0..200_000 {
        let call = writer.enter(0, &CLEAR);
        writer.end();
        writer.leave(call);
        writer.end();
    }
    assert_eq!(writer.flush().unwrap_err().kind(), io::ErrorKind::StorageFull);
}

#[test]
fn apitrace_reads_it() {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    let sink = Sink::default();
    let mut writer = writer(&sink);
    lots(&mut writer);
    clear(&mut writer, 0x4100);
    writer.flush().unwrap();
    file.write_all(&sink.bytes()).unwrap();
    let Ok(output) = Command::new("apitrace").args(["dump", "--color=never"]).arg(file.path()).output()
    else {
        return;
    };
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success());
    assert!(text.contains("b = GL_NEG, c = \"hi\", d = blob(3), e = 0x7fffdeadbeef, f = NULL"), "{text}");
    assert!(text.contains("glClear(mask = GL_DEPTH | GL_COLOR)"), "{text}");
}
