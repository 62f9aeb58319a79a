//! Traces of every version, container and kind of value, whole and damaged, written by an encoder of the tests' own.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod containers;
mod damage;
mod encoder;
mod order;
mod sample;
mod values;

use std::io::Cursor;

use afterglow_trace::dump::{CallLine, Style};
use afterglow_trace::{Call, TraceEnd, TraceError, TraceReader};

/// What reading a trace gave.
struct Outcome {
    calls: Vec<Call>,
    /// The calls as text, with threads.
    lines: Vec<String>,
    /// How it ended, or the error.
    end: Result<TraceEnd, TraceError>,
}

fn open(bytes: &[u8]) -> Result<TraceReader, TraceError> {
    TraceReader::from_reader(Cursor::new(bytes.to_vec()))
}

/// Reads to the end, whatever that is, and checks that nothing follows it.
fn drain(reader: &mut TraceReader) -> Outcome {
    let (mut calls, mut lines) = (Vec::new(), Vec::new());
    let mut call = Call::default();
    let error = loop {
        match reader.next_call(&mut call) {
            Ok(true) => {}
            Ok(false) => break None,
            Err(error) => break Some(error),
        }
        let mut line = CallLine::new(&call, reader.signatures());
        line.style = Style { threads: true, ..Style::default() };
        lines.push(line.to_string());
        calls.push(call.clone());
    };
    assert!(!reader.next_call(&mut call).unwrap());
    let end = reader.end().unwrap();
    assert_eq!(error.is_some(), matches!(end, TraceEnd::Failed { .. }));
    Outcome { calls, lines, end: error.map_or(Ok(end), Err) }
}

fn read(bytes: &[u8]) -> Outcome {
    drain(&mut open(bytes).unwrap())
}
