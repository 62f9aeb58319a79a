//! A look at a whole trace before it is played: how large its windows are, how many frames it has.

use std::collections::{BTreeMap, HashMap};

use afterglow_api::id;
use afterglow_trace::{Call, TraceEnd, TraceError, TraceReader};

use crate::DrawableSizes;
use crate::action::Action;
use crate::args::{Args, int};
use crate::window::WindowCall;

/// What a trace holds.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TraceSummary {
    /// Calls in all.
    pub calls: u64,
    /// Frames, which is buffer swaps.
    pub swaps: u32,
    /// Width and height of the largest viewport, from the window's corner; `None` if there is none.
    pub largest_viewport: Option<(u32, u32)>,
    /// The same for each drawable.
    pub drawables: BTreeMap<u64, (u32, u32)>,
    /// Calls by function.
    pub functions: BTreeMap<String, u64>,
    /// How the trace ends; `None` if it could not be read to its end.
    pub end: Option<TraceEnd>,
    /// Why it could not be read further, if it is damaged.
    pub failure: Option<String>,
}

/// A window's size where the trace has no viewport, as with a program that never shows anything.
const NO_VIEWPORT: (u32, u32) = (640, 480);

impl TraceSummary {
    /// Reads a trace to its end.
    ///
    /// # Errors
    /// Where it cannot be opened. Damage further on is part of the summary.
    pub fn open(path: impl AsRef<std::path::Path>) -> Result<TraceSummary, TraceError> {
        Ok(TraceSummary::read(&mut TraceReader::open(path)?, |_| {}))
    }

    /// Reads on to the end, and calls `progress` now and then.
    pub fn read(reader: &mut TraceReader, mut progress: impl FnMut(&TraceReader)) -> TraceSummary {
        let mut scan = Scan::default();
        let mut call = Call::default();
        loop {
            match reader.next_call(&mut call) {
                Ok(true) => scan.call(reader, &call),
                Ok(false) => break,
                Err(failure) => {
                    scan.summary.failure = Some(failure.to_string());
                    break;
                }
            }
            if scan.summary.calls.is_multiple_of(PROGRESS_CALLS) {
                progress(reader);
            }
        }
        scan.finish(reader)
    }

    /// Sizes of the windows.
    pub fn sizes(&self) -> DrawableSizes {
        let drawables = self.drawables.iter().map(|(&drawable, &size)| (drawable, size));
        DrawableSizes::new(drawables, self.largest_viewport.unwrap_or(NO_VIEWPORT))
    }
}

const PROGRESS_CALLS: u64 = 1 << 14;

#[derive(Default)]
struct Scan {
    summary: TraceSummary,
    /// Action and number of calls of each signature.
    functions: Vec<(Action, u64)>,
    /// The drawable that is current on each thread.
    current: HashMap<u32, u64>,
}

impl Scan {
    fn call(&mut self, reader: &TraceReader, call: &Call) {
        let signature = call.signature.index();
        for index in self.functions.len()..=signature {
            self.functions.push((Action::of(&reader.signature(index.into()).name), 0));
        }
        let (action, count) = &mut self.functions[signature];
        *count += 1;
        self.summary.calls += 1;
        match *action {
            Action::Gl(id::glViewport) => self.viewport(call),
            Action::Window(function) => match function.read(call) {
                WindowCall::MakeCurrent { drawable, .. } => {
                    self.current.insert(call.thread, drawable);
                }
                WindowCall::Swap { .. } => self.summary.swaps += 1,
                _ => {}
            },
            _ => {}
        }
    }

    fn viewport(&mut self, call: &Call) {
        let Some([x, y, width, height]) = rectangle(Args(&call.args)) else { return };
        let end = |start: i32, size: i32| u32::try_from(start.saturating_add(size)).ok();
        let Some(size) = end(x, width).zip(end(y, height)) else { return };
        let drawable = self.current.get(&call.thread).copied().unwrap_or(0);
        let known = self.summary.drawables.entry(drawable).or_default();
        *known = larger(*known, size);
        let largest = &mut self.summary.largest_viewport;
        *largest = Some(larger(largest.unwrap_or_default(), size));
    }

    fn finish(mut self, reader: &TraceReader) -> TraceSummary {
        for (index, (_, count)) in self.functions.into_iter().enumerate().filter(|(_, (_, n))| *n > 0) {
            let name = reader.signature(index.into()).name.to_string();
            *self.summary.functions.entry(name).or_default() += count;
        }
        self.summary.end = reader.end();
        self.summary
    }
}

fn rectangle(a: Args) -> Option<[i32; 4]> {
    Some([a.get(0, int)?, a.get(1, int)?, a.get(2, int)?, a.get(3, int)?])
}

fn larger(a: (u32, u32), b: (u32, u32)) -> (u32, u32) {
    (a.0.max(b.0), a.1.max(b.1))
}
