//! What a trace's draws are understood as: tables, JSON and pictures.

use std::io::Write;

use afterglow_gl::frame::Frame;
use afterglow_scene::{Recovery, Relighting, Replacing};
use serde::Serialize;

use super::Arguments;
use super::paint::Painter;
use super::play::{self, Event, Judged, Visitor};
use super::propose::Proposal;
use super::rows::FrameRows;
use super::summary::Summary;
use super::textures::{TextureRow, TextureWriter};
use crate::failure::Failure;
use crate::output;

/// Everything that `inspect --draws --json` writes.
#[derive(Debug, Default, Serialize)]
struct Report {
    frames: Vec<FrameRows>,
    summary: Summary,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    textures: Vec<TextureRow>,
}

struct Inspection<'a> {
    arguments: &'a Arguments,
    painter: Option<Painter<'a>>,
    proposal: Option<Proposal>,
    textures: Option<TextureWriter<'a>>,
    report: Report,
}

/// Plays a trace and tells of its draws.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let frames = arguments.frames();
    let painter = arguments.paint.as_deref().map(|folder| Painter::new(arguments, folder)).transpose()?;
    let proposal = arguments.propose.as_ref().map(|_| Proposal::default());
    let textures = arguments.textures.as_deref().map(TextureWriter::new).transpose()?;
    let mut inspection = Inspection { arguments, painter, proposal, textures, report: Report::default() };
    let profile = arguments.profile.load_for_trace(&arguments.trace)?;
    let recovery = Recovery::with_profile(profile).with_relighting(Relighting::AtOnce, Replacing::WhereGood);
    let played = play::play(&arguments.trace, frames.end, recovery, &mut inspection);
    let Inspection { painter, proposal, textures, mut report, .. } = inspection;
    if let Some(painter) = painter {
        painter.finish()?;
    }
    if let Some((proposal, path)) = proposal.zip(arguments.propose.as_ref()) {
        proposal.write(&arguments.trace, path)?;
    }
    report.textures = textures.map(TextureWriter::finish).unwrap_or_default();
    if !arguments.prints_json() && arguments.textures.is_some() {
        output::print(|out| report.textures.iter().try_for_each(|row| row.write(out)))?;
    }
    report.summary.finish();
    if !arguments.prints_json() && (arguments.draws || arguments.classes) {
        output::print(|out| report.summary.write(out))?;
    }
    if let Some(path) = &arguments.json {
        output::write_json(path, &report)?;
    }
    let count = played?;
    if frames.start >= count {
        return Err(Failure::Usage(format!("the trace has {count} frames, none of those asked for")));
    }
    Ok(())
}

impl Visitor for Inspection<'_> {
    fn frame(&mut self, index: u64, events: Vec<Event>, recovery: &Recovery) -> Result<(), Failure> {
        let frames = self.arguments.frames();
        let wanted = frames.contains(&index) && (index - frames.start).is_multiple_of(self.arguments.every);
        for event in events {
            match event {
                Event::Shown(judged) if wanted => self.shown(index, *judged, recovery)?,
                Event::Shown(judged) => self.unseen(judged.frame),
                Event::Part(frame) => self.unseen(*frame),
            }
        }
        Ok(())
    }
}

impl Inspection<'_> {
    fn shown(&mut self, index: u64, judged: Judged, recovery: &Recovery) -> Result<(), Failure> {
        let Judged { frame, scene, time, .. } = judged;
        self.report.summary.add(&scene, time);
        if let Some(textures) = &mut self.textures {
            textures.learn(&frame);
            textures.write(index, &frame, recovery)?;
            textures.forget(&frame);
        }
        if let Some(proposal) = &mut self.proposal {
            proposal.add(&frame, &scene, recovery);
        }
        if self.arguments.draws {
            let rows = FrameRows::of(index, &frame, &scene, recovery);
            if !self.arguments.prints_json() {
                output::print(|out| rows.write(out).and_then(|()| writeln!(out)))?;
            }
            if self.arguments.json.is_some() {
                self.report.frames.push(rows);
            }
        }
        match &mut self.painter {
            Some(painter) => painter.paint(index, frame, &scene),
            None => Ok(()),
        }
    }

    fn unseen(&mut self, frame: Frame) {
        if let Some(textures) = &mut self.textures {
            textures.learn(&frame);
            textures.forget(&frame);
        }
        if let Some(painter) = &mut self.painter {
            painter.skip(frame);
        }
    }
}
