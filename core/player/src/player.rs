//! Plays calls.

use afterglow_trace::{Call, TraceError, TraceReader};

use crate::DrawableSizes;
use crate::action::Action;
use crate::args::{Args, uint};
use crate::contexts::{BackendFactory, Contexts};
use crate::generated::dispatch;
use crate::mapped::Mappings;
use crate::report::{PlayReport, Tallies, Tally};
use crate::window::WindowCall;

/// What playing one call came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// A call was played, or skipped and counted.
    Call,
    /// A call was played, and a frame is complete.
    Frame(FrameEnd),
    /// There are no more calls.
    End,
}

/// The end of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameEnd {
    /// Counted from 0.
    pub frame: u32,
    /// Number of the call that showed it.
    pub call: u32,
    /// Where it was shown, as a handle of the traced program.
    pub drawable: u64,
    /// The context that drew it, counted from 0 as the contexts were created; `None` if none was current there.
    pub context: Option<usize>,
}

/// Plays a trace into contexts that it makes as the traced program did.
///
/// Textures, lists, buffers and queries have the names that they had in the traced program. OpenGL 1.x
/// lets a program choose names, and the traced library gave out no name twice.
pub struct Player {
    reader: TraceReader,
    call: Call,
    /// By signature.
    actions: Vec<Action>,
    tallies: Tallies,
    contexts: Contexts,
    mappings: Mappings,
    frames: u32,
    failure: Option<TraceError>,
}

impl Player {
    /// A player at the start of a trace. `factory` makes the backend of each context that comes into use.
    pub fn new(reader: TraceReader, sizes: DrawableSizes, factory: BackendFactory) -> Player {
        Player {
            reader,
            call: Call::default(),
            actions: Vec::new(),
            tallies: Tallies::default(),
            contexts: Contexts::new(sizes, factory),
            mappings: Mappings::default(),
            frames: 0,
            failure: None,
        }
    }

    /// Plays calls up to the end of the next frame; `None` if the trace ends before.
    pub fn next_frame(&mut self) -> Option<FrameEnd> {
        loop {
            match self.step() {
                Step::Call => {}
                Step::Frame(end) => return Some(end),
                Step::End => return None,
            }
        }
    }

    /// Plays one call, which [`call`](Player::call) then is.
    pub fn step(&mut self) -> Step {
        match self.reader.next_call(&mut self.call) {
            Ok(true) => self.play(),
            Ok(false) => Step::End,
            Err(failure) => {
                self.failure = Some(failure);
                Step::End
            }
        }
    }

    /// The call that was played last.
    pub fn call(&self) -> &Call {
        &self.call
    }

    /// The trace, for names and progress.
    pub fn reader(&self) -> &TraceReader {
        &self.reader
    }

    /// What became of the calls so far.
    pub fn report(&self) -> PlayReport {
        PlayReport {
            frames: self.frames,
            failure: self.failure.as_ref().map(ToString::to_string),
            ..self.tallies.report(&self.reader)
        }
    }

    /// The context that is current on the thread of the last call.
    pub fn context(&mut self) -> Option<&mut afterglow_gl::Context> {
        self.contexts.current(self.call.thread)
    }

    fn play(&mut self) -> Step {
        let signature = self.call.signature.index();
        if signature >= self.actions.len() {
            self.learn(signature);
        }
        self.tallies.functions[signature].calls += 1;
        match self.actions[signature] {
            Action::Window(function) => return self.play_window(function.read(&self.call)),
            Action::Unsupported => self.tallies.functions[signature].unsupported += 1,
            Action::Nothing => {}
            action => self.play_gl(action),
        }
        Step::Call
    }

    /// Finds the actions of functions that are new.
    #[cold]
    fn learn(&mut self, signature: usize) {
        for index in self.actions.len()..=signature {
            self.actions.push(Action::of(&self.reader.signature(index.into()).name));
        }
        self.tallies.functions.resize(self.actions.len(), Tally::default());
    }

    fn play_window(&mut self, call: WindowCall) -> Step {
        let context = self.contexts.play(self.call.thread, call);
        let WindowCall::Swap { drawable } = call else { return Step::Call };
        let end = FrameEnd { frame: self.frames, call: self.call.number, drawable, context };
        self.frames += 1;
        Step::Frame(end)
    }

    fn play_gl(&mut self, action: Action) {
        let Player { call, tallies, contexts, mappings, .. } = self;
        let tally = &mut tallies.functions[call.signature.index()];
        let slot = contexts.current_slot(call.thread);
        let Some((slot, gl)) = slot.zip(contexts.current(call.thread)) else {
            tally.without_context += 1;
            return;
        };
        let a = Args(&call.args);
        let played = match action {
            Action::Gl(command) => dispatch::play(gl, command, a),
            Action::Map => a.get(0, uint).zip(a.get(1, uint)).map(|(target, access)| {
                let address = call.ret.as_ref().and_then(|value| value.as_pointer());
                if let (true, Some(address)) = (gl.map_buffer(target, access), address) {
                    mappings.insert(slot, target, address);
                }
                true
            }),
            Action::Unmap => a.get(0, uint).map(|target| {
                mappings.remove(slot, target);
                gl.unmap_buffer(target);
                true
            }),
            Action::Memcpy => mappings.write(slot, gl, a).map(|()| true),
            Action::Window(_) | Action::Nothing | Action::Unsupported => Some(true),
        };
        match played {
            Some(true) => {}
            Some(false) => tally.unsupported += 1,
            None => tally.malformed += 1,
        }
        let error = gl.take_error();
        if error != 0 {
            tallies.error(call.signature, error, call.number);
        }
    }
}
