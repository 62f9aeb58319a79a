//! Classes: what share of the triangles was taken for what it is.

use std::collections::{BTreeMap, HashMap};

use afterglow_scene::Class;
use serde::Serialize;

use super::Observed;
use crate::truth::{CLASSES, FrameTruth, Truth, class_index};

/// Frames for which recovery may hesitate: triangles of objects that were drawn in fewer are counted apart.
pub const HYSTERESIS: u32 = 8;

/// Counts of triangles over a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// That are of the class.
    pub told: u64,
    /// That were taken to be.
    pub found: u64,
    /// Both.
    pub right: u64,
}

impl Counts {
    /// Share of those that were taken for the class that are of it; nothing where none were.
    pub fn precision(&self) -> Option<f64> {
        share(self.right, self.found)
    }

    /// Share of those of the class that were taken for it; nothing where there are none.
    pub fn recall(&self) -> Option<f64> {
        share(self.right, self.told)
    }
}

fn share(part: u64, whole: u64) -> Option<f64> {
    (whole > 0).then(|| part as f64 / whole as f64)
}

/// What was measured of a class.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClassScore {
    /// Its name, as in [`CLASSES`].
    pub class: &'static str,
    /// Of objects that were drawn for [`HYSTERESIS`] frames before.
    pub settled: Counts,
    /// Of younger ones.
    pub young: Counts,
    /// Of the settled ones.
    pub precision: Option<f64>,
    /// Of the settled ones.
    pub recall: Option<f64>,
    /// For what settled triangles of the class were taken, where for another: class and number of triangles.
    pub taken_for: BTreeMap<&'static str, u64>,
    /// The same with the reasons that were given.
    pub because: BTreeMap<String, u64>,
}

/// Triangles that are traced though they should be rasterized, and those of which nobody can say.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct TracedScore {
    /// Of the interface.
    pub interface: u64,
    /// That are translucent.
    pub translucent: u64,
    /// Of skies, layers, other views, and what is to be dropped.
    pub others: u64,
    /// That the truth leaves undecided; they count nowhere else.
    pub undecided: u64,
}

/// Counts what is traced and should not be.
pub fn traced(truth: &Truth, observed: &[Observed]) -> TracedScore {
    let mut score = TracedScore::default();
    for (frame, observed) in truth.frames.iter().zip(observed) {
        for (label, run, count) in observed.beside(frame) {
            match label.class {
                Class::Undecided => score.undecided += count,
                _ if label.class.is_traced() || !run.class.is_traced() => {}
                Class::Interface => score.interface += count,
                Class::Translucent => score.translucent += count,
                _ => score.others += count,
            }
        }
    }
    score
}

/// Scores all classes that occur.
pub fn score(truth: &Truth, observed: &[Observed]) -> Vec<ClassScore> {
    let (mut settled, mut young) = ([Counts::default(); CLASSES.len()], [Counts::default(); CLASSES.len()]);
    let mut taken_for = vec![BTreeMap::new(); CLASSES.len()];
    let mut because = vec![BTreeMap::new(); CLASSES.len()];
    let mut ages = Ages::default();
    for (frame, observed) in truth.frames.iter().zip(observed) {
        let decided = observed.beside(frame).filter(|(label, ..)| label.class != Class::Undecided);
        for (label, run, count) in decided {
            let is_young = ages.of(label.object) < HYSTERESIS;
            let counts = if is_young { &mut young } else { &mut settled };
            let (told, found) = (class_index(label.class), class_index(run.class));
            if told != found && !is_young {
                *taken_for[told].entry(CLASSES[found].1).or_default() += count;
                *because[told].entry(format!("{}: {}", CLASSES[found].1, run.reason)).or_default() += count;
            }
            counts[told].told += count;
            counts[found].found += count;
            counts[told].right += if told == found { count } else { 0 };
        }
        ages.pass(frame);
    }
    let score = |(index, taken_for): (usize, BTreeMap<_, _>)| {
        let (settled, young) = (settled[index], young[index]);
        ClassScore {
            class: CLASSES[index].1,
            settled,
            young,
            precision: settled.precision(),
            recall: settled.recall(),
            taken_for,
            because: std::mem::take(&mut because[index]),
        }
    };
    let occurs = |c: &Counts| c.told + c.found > 0;
    let scores = taken_for.into_iter().enumerate().map(score);
    scores.filter(|score| occurs(&score.settled) || occurs(&score.young)).collect()
}

/// In how many frames each object was drawn.
#[derive(Debug, Default)]
struct Ages(HashMap<u64, u32>);

impl Ages {
    fn of(&self, object: u64) -> u32 {
        self.0.get(&object).copied().unwrap_or(0)
    }

    /// Takes note that a frame was drawn.
    fn pass(&mut self, frame: &FrameTruth) {
        let mut objects: Vec<u64> = frame.labels.iter().map(|label| label.object).collect();
        objects.sort_unstable();
        objects.dedup();
        for object in objects {
            *self.0.entry(object).or_default() += 1;
        }
    }
}
