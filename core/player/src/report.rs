//! What became of the calls.

use std::collections::BTreeMap;

use afterglow_trace::{SignatureId, TraceEnd, TraceReader};

/// Counts of one function's calls.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    pub calls: u64,
    pub unsupported: u64,
    pub malformed: u64,
    pub without_context: u64,
}

/// A GL error that calls of one function recorded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GlError {
    /// The function.
    pub function: String,
    /// GL_INVALID_ENUM and so on.
    pub error: u32,
    /// How many calls.
    pub count: u64,
    /// Number of the first.
    pub first_call: u32,
}

/// What became of the calls so far; functions by name.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PlayReport {
    /// Calls in all.
    pub calls: u64,
    /// Frames that have ended.
    pub frames: u32,
    /// Calls that were skipped because there is no way to play them.
    pub unsupported: BTreeMap<String, u64>,
    /// Calls that were skipped because their arguments are not what the function takes.
    pub malformed: BTreeMap<String, u64>,
    /// Calls that were skipped because no context was current.
    pub without_context: BTreeMap<String, u64>,
    /// Errors that the context recorded.
    pub errors: Vec<GlError>,
    /// How the trace ended, once it has.
    pub end: Option<TraceEnd>,
    /// Why it could not be read further, if it is damaged.
    pub failure: Option<String>,
}

/// Counts while playing, by function.
#[derive(Debug, Default)]
pub(crate) struct Tallies {
    pub functions: Vec<Tally>,
    errors: Vec<(SignatureId, u32, u64, u32)>,
}

impl Tallies {
    /// Counts an error.
    pub fn error(&mut self, signature: SignatureId, error: u32, call: u32) {
        let known = self.errors.iter_mut().find(|(s, e, ..)| (*s, *e) == (signature, error));
        match known {
            Some((_, _, count, _)) => *count += 1,
            None => self.errors.push((signature, error, 1, call)),
        }
    }

    /// The counts with the functions' names.
    pub fn report(&self, reader: &TraceReader) -> PlayReport {
        let name = |index: usize| reader.signature(SignatureId::from(index)).name.to_string();
        let by_name = |count: fn(&Tally) -> u64| {
            let functions = self.functions.iter().enumerate();
            let mut counts = BTreeMap::new();
            for (index, tally) in functions.filter(|(_, tally)| count(tally) > 0) {
                // Two signatures may have one name.
                *counts.entry(name(index)).or_default() += count(tally);
            }
            counts
        };
        let errors = self.errors.iter().map(|&(signature, error, count, first_call)| GlError {
            function: name(signature.index()),
            error,
            count,
            first_call,
        });
        PlayReport {
            calls: self.functions.iter().map(|tally| tally.calls).sum(),
            unsupported: by_name(|tally| tally.unsupported),
            malformed: by_name(|tally| tally.malformed),
            without_context: by_name(|tally| tally.without_context),
            errors: errors.collect(),
            end: reader.end(),
            ..PlayReport::default()
        }
    }
}
