//! Oracles: what real programs draw, by what is known of those programs.
//!
//! An oracle reads the calls of a recorded trace and says of each triangle what it is, by means that the product must
//! never have: which program it is, in what order its source draws, how its textures are numbered, and what it
//! multiplied its matrices from ([`Machine`] keeps view and model apart, where a frame has only their product). Where an
//! oracle cannot know, it says [`Class::Undecided`], and those triangles are left out of the figures.

mod bzflag;
mod drawn;
mod machine;
mod minetest;
mod neverball;
mod openarena;
mod picture;
mod report;
mod state;
mod step;
mod stormbaan;
mod things;
mod torcs;
mod triangles;

use std::path::Path;

use afterglow_api::CommandId;
use afterglow_scene::Class;
use afterglow_trace::{Call, TraceReader};
use anyhow::Context;

use crate::truth::{FrameTruth, Label, TrueCamera, Truth, UNNAMED};
pub use drawn::Drawn;
pub use machine::Machine;
pub use picture::paint;
pub use report::{write_counts, write_draws};
pub use state::State;
pub use step::Opacity;

/// What an oracle says of a frame.
#[derive(Debug, Clone, Default)]
pub struct Judged {
    /// The camera, where the program's is known.
    pub camera: Option<TrueCamera>,
    /// Class and object of each draw.
    pub things: Vec<(Class, u64)>,
}

/// An oracle by its name.
pub struct Oracle {
    /// As on the command line.
    pub name: &'static str,
    /// The program that it knows.
    pub program: &'static str,
    /// About how large the world is, in the program's units.
    pub extent: f64,
    judge: fn(&[Vec<Drawn>]) -> Vec<Judged>,
}

/// All oracles.
pub const ORACLES: &[Oracle] = &[
    Oracle {
        name: "openarena",
        program: "ioquake3's opengl1 renderer: world in world coordinates, passes, entities animated by the CPU",
        extent: 4000.0,
        judge: openarena::judge,
    },
    Oracle {
        name: "stormbaancoureur",
        program: "Stormbaan Coureur: a matrix for each part, view and model multiplied by the program",
        extent: 50.0,
        judge: stormbaan::judge,
    },
    Oracle {
        name: "torcs",
        program: "TORCS: plib's scene graph, a background, a track in leaves, cars in parts",
        extent: 3000.0,
        judge: torcs::judge,
    },
    Oracle {
        name: "minetest",
        program: "Minetest on Irrlicht: blocks of nodes, each with a matrix, streaming in",
        extent: 1200.0,
        judge: minetest::judge,
    },
    Oracle {
        name: "neverball",
        program: "Neverball: a level in buffers that is tilted, coins, a background about the eye",
        extent: 25.0,
        judge: neverball::judge,
    },
    Oracle {
        name: "bzflag",
        program: "BZFlag: a ground and mountains without depth, buildings, tanks in display lists, panels",
        extent: 800.0,
        judge: bzflag::judge,
    },
];

/// The oracle of that name.
pub fn named(name: &str) -> Option<&'static Oracle> {
    ORACLES.iter().find(|oracle| oracle.name == name)
}

/// What is drawn in each frame of a trace.
///
/// # Errors
/// Where the file is no trace or is damaged.
pub fn read(path: &Path) -> anyhow::Result<Vec<Vec<Drawn>>> {
    frames(TraceReader::open(path).with_context(|| path.display().to_string())?)
}

/// What is drawn in each frame of a trace that is open.
///
/// # Errors
/// Where it is damaged.
pub fn frames(mut reader: TraceReader) -> anyhow::Result<Vec<Vec<Drawn>>> {
    let (mut machine, mut frames) = (Machine::default(), Vec::new());
    // By signature.
    let mut commands: Vec<Option<CommandId>> = Vec::new();
    let mut call = Call::default();
    while reader.next_call(&mut call)? {
        let signature = call.signature.index();
        for index in commands.len()..=signature {
            let command = CommandId::named(&reader.signature(index.into()).name);
            commands.push(command.map(CommandId::canonical));
        }
        let Some(command) = commands[signature] else { continue };
        frames.extend(step::step(command, &call).and_then(|step| machine.execute(step)));
    }
    Ok(frames)
}

impl Oracle {
    /// Judges all draws of a trace.
    pub fn judge(&self, frames: &[Vec<Drawn>]) -> Vec<Judged> {
        let mut judged = (self.judge)(frames);
        // What the first frame has before its first clear is left from frames that were cut out of the trace.
        for (first, drawn) in judged.iter_mut().zip(frames).take(1) {
            let things = first.things.iter_mut().zip(drawn);
            for (thing, _) in things.filter(|(_, drawn)| drawn.clears == 0) {
                *thing = (Class::Undecided, UNNAMED);
            }
        }
        judged
    }

    /// What is true of a trace.
    pub fn truth(&self, frames: &[Vec<Drawn>], judged: &[Judged]) -> Truth {
        let frames = frames.iter().zip(judged).map(|(drawn, judged)| frame_truth(drawn, judged));
        Truth { style: self.name.into(), extent: self.extent, frames: frames.collect(), ..Truth::default() }
    }
}

fn frame_truth(drawn: &[Drawn], judged: &Judged) -> FrameTruth {
    let mut labels: Vec<Label> = Vec::new();
    for (drawn, &(class, object)) in drawn.iter().zip(&judged.things) {
        match labels.last_mut() {
            Some(last) if (last.class, last.object) == (class, object) => last.triangles += drawn.triangles,
            _ if drawn.triangles == 0 => {}
            _ => labels.push(Label { class, object, triangles: drawn.triangles }),
        }
    }
    FrameTruth { camera: judged.camera, labels, ..FrameTruth::default() }
}
