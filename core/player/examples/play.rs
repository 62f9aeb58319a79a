//! Plays a trace into contexts without a device and prints what that costs on the playing thread, besides reading
//! the trace, and what could not be played: `cargo run --release -p afterglow-player --example play FILE.trace`.

use std::error::Error;

use afterglow_gl::backend::NullBackend;
use afterglow_player::{Player, TraceSummary};
use afterglow_trace::TraceReader;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("which trace?")?;
    let start = thread_seconds()?;
    let summary = TraceSummary::open(&path)?;
    let read = thread_seconds()? - start;
    let reader = TraceReader::open(&path)?;
    let start = thread_seconds()?;
    let mut player = Player::new(reader, summary.sizes(), Box::new(|_| Box::new(NullBackend)));
    while player.next_frame().is_some() {}
    let play = thread_seconds()? - start;

    let per_call = |seconds: f64| seconds * 1e9 / summary.calls as f64;
    println!("{} calls, {} frames, windows {:?}", summary.calls, summary.swaps, summary.drawables);
    println!("read:           {read:7.3} s, {:6.1} ns a call", per_call(read));
    println!("read and play:  {play:7.3} s, {:6.1} ns a call", per_call(play));
    println!("{:#?}", player.report());
    Ok(())
}

/// Time that this thread has run, which other programs do not lengthen as much as the time on the wall.
fn thread_seconds() -> Result<f64, Box<dyn Error>> {
    let statistics = std::fs::read_to_string("/proc/thread-self/schedstat")?;
    Ok(statistics.split(' ').next().ok_or("no time")?.parse::<f64>()? * 1e-9)
}
