//! Identity: whether an object stays the same object.

use std::collections::{BTreeMap, HashMap};

use serde::Serialize;

use super::Observed;
use crate::truth::{FrameTruth, Truth, UNNAMED};

/// What was measured of identities.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct IdentityScore {
    /// How often an object that was drawn before could have changed its identity: once a frame.
    pub chances: u64,
    /// How often most of its triangles had another identity than before.
    pub switches: u64,
}

/// Counts switches; nothing if recovery says of no triangle which object it belongs to.
pub fn score(truth: &Truth, observed: &[Observed]) -> Option<IdentityScore> {
    let has_objects = observed.iter().flat_map(|frame| &frame.runs).any(|run| run.object.is_some());
    if !has_objects {
        return None;
    }
    let mut score = IdentityScore::default();
    let mut last: HashMap<u64, u64> = HashMap::new();
    for (frame, observed) in truth.frames.iter().zip(observed) {
        for (object, identity) in identities(frame, observed) {
            if let Some(former) = last.insert(object, identity) {
                score.chances += 1;
                score.switches += u64::from(former != identity);
            }
        }
    }
    Some(score)
}

/// The identity that most triangles of each object have. Reflections, shadows and layers of an object have its number,
/// too, but are not it. Those without a name are left out.
fn identities(frame: &FrameTruth, observed: &Observed) -> HashMap<u64, u64> {
    let mut votes: HashMap<u64, BTreeMap<u64, u64>> = HashMap::new();
    let things =
        observed.beside(frame).filter(|(label, ..)| label.class.is_traced() && label.object < UNNAMED);
    for (label, run, count) in things {
        if let Some(identity) = run.object {
            *votes.entry(label.object).or_default().entry(identity).or_default() += count;
        }
    }
    let most = |votes: BTreeMap<u64, u64>| votes.into_iter().max_by_key(|(_, count)| *count);
    votes
        .into_iter()
        .filter_map(|(object, votes)| most(votes).map(|(identity, _)| (object, identity)))
        .collect()
}
