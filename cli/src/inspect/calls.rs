//! The calls of a trace, printed and counted.

use std::collections::BTreeMap;
use std::io::{BufWriter, Write};

use afterglow_trace::dump::CallLine;
use afterglow_trace::{Call, TraceReader};
use serde::Serialize;

use super::Arguments;
use crate::failure::Failure;
use crate::output;

#[derive(Debug, Default, Serialize)]
struct Summary {
    container: String,
    version: u32,
    frames: u64,
    calls: u64,
    bytes: u64,
    functions: BTreeMap<String, u64>,
}

/// Counts or prints a trace's calls.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let path = &arguments.trace;
    let mut reader = TraceReader::open(path).map_err(|error| Failure::input(path, error))?;
    let mut out = BufWriter::new(std::io::stdout().lock());
    let mut summary = Summary {
        container: format!("{:?}", reader.container()),
        version: reader.version(),
        ..Summary::default()
    };
    let frames = arguments.frames();
    let (mut call, mut counts) = (Call::default(), Vec::<u64>::new());
    let end = loop {
        match reader.next_call(&mut call) {
            Ok(true) => {}
            Ok(false) => break Ok(()),
            Err(error) => break Err(Failure::input(path, error)),
        }
        let index = call.signature.index();
        if frames.contains(&summary.frames) {
            counts.resize(counts.len().max(index + 1), 0);
            counts[index] += 1;
            summary.calls += 1;
            if arguments.calls && writeln!(out, "{}", CallLine::new(&call, reader.signatures())).is_err() {
                // Whoever reads has gone away (`| head`): nothing is left to do.
                return Ok(());
            }
        }
        summary.frames += u64::from(afterglow_player::ends_frame(&reader.signature(call.signature).name));
        if summary.frames >= frames.end {
            break Ok(());
        }
    };
    summary.bytes = reader.position();
    for (index, count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
        let name = reader.signatures().functions()[index].name.to_string();
        *summary.functions.entry(name).or_default() += count;
    }
    if !arguments.calls && arguments.json.is_none() {
        drop(out);
        output::print(|out| print(out, &summary))?;
    } else {
        drop(out);
    }
    if let Some(path) = &arguments.json {
        output::write_json(path, &summary)?;
    }
    end?;
    if summary.calls == 0 && arguments.frames.is_some() {
        return Err(Failure::Usage(format!(
            "the trace has {} frames, none of those asked for",
            summary.frames
        )));
    }
    crate::failure::trace_end(path, reader.end())
}

fn print(out: &mut impl Write, summary: &Summary) -> std::io::Result<()> {
    writeln!(
        out,
        "{} frames, {} calls, {} bytes unpacked ({}, version {})",
        summary.frames, summary.calls, summary.bytes, summary.container, summary.version
    )?;
    let mut functions: Vec<_> = summary.functions.iter().collect();
    functions.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    for (name, count) in functions {
        writeln!(out, "{count:>10}  {name}")?;
    }
    Ok(())
}
