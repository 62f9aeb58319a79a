//! Prints the calls of a trace, or with `--speed` reads them as fast as it can and prints how fast that was.

use std::io::{BufWriter, Write};
use std::time::Instant;

use afterglow_trace::dump::CallLine;
use afterglow_trace::{Call, TraceError, TraceReader};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("usage: dump TRACE [--speed]")?;
    let reader = TraceReader::open(&path)?;
    match arguments.next().as_deref() {
        Some("--speed") => speed(reader)?,
        _ => print(reader)?,
    }
    Ok(())
}

fn print(mut reader: TraceReader) -> Result<(), Box<dyn std::error::Error>> {
    let mut out = BufWriter::with_capacity(1 << 16, std::io::stdout().lock());
    let mut call = Call::default();
    while reader.next_call(&mut call)? {
        writeln!(out, "{}", CallLine::new(&call, reader.signatures()))?;
    }
    out.flush()?;
    eprintln!("{:?}", reader.end());
    Ok(())
}

fn speed(mut reader: TraceReader) -> Result<(), TraceError> {
    let start = Instant::now();
    let mut call = Call::default();
    let mut calls = 0u64;
    while reader.next_call(&mut call)? {
        calls += 1;
    }
    let seconds = start.elapsed().as_secs_f64();
    println!(
        "{calls} calls, {} bytes ({} from {}), {:.2} s: {:.2} M calls/s, {:.0} MB/s",
        reader.position(),
        reader.file_position(),
        reader.container(),
        seconds,
        calls as f64 / seconds / 1e6,
        reader.position() as f64 / seconds / 1e6,
    );
    Ok(())
}
