//! The machine of the oracles sees what was drawn, and with what it was drawn.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::io::Cursor;

use afterglow_trace::TraceReader;
use afterglow_truth::Recording;
use afterglow_truth::oracle::{Drawn, ORACLES, frames};
use afterglow_truth::styles::{self, STYLES};

fn drawn(recording: &Recording) -> Vec<Vec<Drawn>> {
    frames(TraceReader::from_reader(Cursor::new(recording.trace.clone())).unwrap()).unwrap()
}

#[test]
fn the_machine_counts_the_triangles_that_are_drawn() {
    for entry in STYLES {
        let recording = entry.record().unwrap();
        let counts: Vec<u64> =
            drawn(&recording).iter().map(|frame| frame.iter().map(|drawn| drawn.triangles).sum()).collect();
        let told: Vec<u64> = recording.truth.frames.iter().map(|frame| frame.triangles()).collect();
        assert_eq!(counts, told, "{}", entry.name);
    }
}

#[test]
fn the_machine_knows_matrices_lists_and_buffers() {
    let recording = styles::named("own_matrices").unwrap().record().unwrap();
    for (frame, truth) in drawn(&recording).iter().zip(&recording.truth.frames) {
        let camera = truth.camera.unwrap();
        let world: Vec<&Drawn> = frame.iter().filter(|drawn| drawn.is_perspective()).collect();
        assert!(!world.is_empty());
        for drawn in world {
            assert!(drawn.projection.abs_diff_eq(camera.projection, 1e-6));
            let model = camera.view.inverse() * drawn.modelview();
            assert!((model.determinant() - 1.0).abs() < 1e-4);
            assert_eq!(drawn.lists.len(), 1);
        }
    }
    let recording = styles::named("buffers").unwrap().record().unwrap();
    let first = &drawn(&recording)[0];
    assert!(first.iter().filter(|drawn| drawn.is_perspective()).all(|drawn| drawn.buffer != 0));
}

#[test]
fn what_an_oracle_says_adds_up() {
    let recording = styles::named("chase").unwrap().record().unwrap();
    let frames = drawn(&recording);
    for oracle in ORACLES {
        // Of a program that it does not know, an oracle may say anything, but of all triangles.
        let judged = oracle.judge(&frames);
        let truth = oracle.truth(&frames, &judged);
        for (frame, told) in truth.frames.iter().zip(&recording.truth.frames) {
            assert_eq!(frame.triangles(), told.triangles(), "{}", oracle.name);
        }
    }
}
