//! How the cost of a frame grows with the world.

use std::io::Write;
use std::time::Duration;

use afterglow_scene::{Phase, Recovery};
use serde::Serialize;

use super::traces::copying;
use super::worlds::{Sent, World};
use super::{add, quantile};
use crate::failure::Failure;
use crate::inspect::play::{self, Phases};

/// Triangles of the smallest world.
const LEAST: u32 = 1000;
/// Frames until a world is known.
const KNOWN: u32 = 16;
/// Frames that are measured then; the median counts.
const MEASURED: u32 = 9;

/// A world's figures.
#[derive(Debug, Serialize)]
pub struct Row {
    sent: &'static str,
    triangles: u32,
    /// Microseconds of the first frame, and of one when the world is known.
    first_us: f64,
    frame_us: f64,
    ns_a_triangle: f64,
    /// In units of copying what the frame itself holds of vertices and indices; none where it is nothing.
    copies: Option<f64>,
    /// Nanoseconds a triangle, of those of the world a tenth of the size.
    growth: Option<f64>,
    /// The phase that takes longest, and its share, 0 to 1.
    longest: &'static str,
    longest_share: f64,
}

/// Measures worlds of up to `most` triangles, and prints a table unless standard output is for JSON.
pub fn measure(most: u32, prints: bool) -> Result<Vec<Row>, Failure> {
    let mut rows: Vec<Row> = Vec::new();
    for sent in Sent::ALL {
        let sizes = std::iter::successors(Some(LEAST), |size| size.checked_mul(10));
        for triangles in sizes.take_while(|size| *size <= most) {
            let before = rows.last().filter(|row| row.sent == sent.name()).map(|row| row.ns_a_triangle);
            let row = row(sent, triangles, before);
            add(&mut rows, row, prints, write_head, Row::write)?;
        }
    }
    Ok(rows)
}

fn row(sent: Sent, triangles: u32, before: Option<f64>) -> Row {
    let (mut world, mut recovery) = (World::new(sent, triangles), Recovery::new());
    let (mut first, mut known) = (Duration::ZERO, Vec::new());
    let mut copies: Vec<f64> = Vec::new();
    for number in 0..KNOWN + MEASURED {
        let mut frame = world.frame(number);
        let (_, phases) = play::understand(&mut recovery, &mut frame);
        if number == 0 {
            first = phases.iter().sum();
        }
        if number >= KNOWN {
            known.push(phases);
            copies.push(copying(&frame).as_secs_f64());
        }
    }
    let seconds = |phases: &Phases| phases.iter().sum::<Duration>().as_secs_f64();
    known.sort_by(|a, b| seconds(a).total_cmp(&seconds(b)));
    copies.sort_by(f64::total_cmp);
    let (middle, copy) = (&known[known.len() / 2], quantile(&copies, 0.5));
    let frame_us = 1e6 * seconds(middle);
    let ns_a_triangle = 1e3 * frame_us / f64::from(triangles);
    let longest = Phase::ALL.into_iter().max_by_key(|phase| middle[*phase as usize]).unwrap_or(Phase::Shapes);
    Row {
        sent: sent.name(),
        triangles,
        first_us: 1e6 * first.as_secs_f64(),
        frame_us,
        ns_a_triangle,
        // A copy of nothing takes as long as reading the clock.
        copies: (copy > 1e-6).then(|| 1e-6 * frame_us / copy),
        growth: before.map(|before| ns_a_triangle / before),
        longest: longest.name(),
        longest_share: middle[longest as usize].as_secs_f64() / seconds(middle).max(f64::MIN_POSITIVE),
    }
}

fn write_head(out: &mut dyn Write) -> std::io::Result<()> {
    writeln!(
        out,
        "growth: ns a triangle, of those of a world a tenth of the size; copies: in units of copying the vertices\n\
         {:<22} {:>9} {:>11} {:>11} {:>11} {:>7} {:>7}  longest phase",
        "world", "triangles", "first us", "frame us", "ns/triangle", "growth", "copies"
    )
}

impl Row {
    fn write(&self, out: &mut dyn Write) -> std::io::Result<()> {
        let factor = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.2}"));
        writeln!(
            out,
            "{:<22} {:>9} {:>11.0} {:>11.0} {:>11.2} {:>7} {:>7}  {} {:.0} %",
            self.sent,
            self.triangles,
            self.first_us,
            self.frame_us,
            self.ns_a_triangle,
            factor(self.growth),
            factor(self.copies),
            self.longest,
            100.0 * self.longest_share,
        )
    }
}
