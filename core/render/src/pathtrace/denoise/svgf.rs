//! Spatiotemporal variance-guided filtering: histories of a fixed length, then a filter between neighbours as wide as the light is known
//! to be noisy.

use super::{Plan, Stage, Step, Store};

/// Steps of the filter between neighbours; each has taps twice as far apart as the one before.
const STEPS: usize = 5;
/// Where the steps read and write: none reads where it writes.
const WAY: [Store; 2] = [Store::Work, Store::Noisy];

pub(super) fn plan() -> Plan {
    Plan {
        before_light: vec![effort()],
        after_light: filter(None),
        output: Some(WAY[STEPS % 2]),
        spare: Some(WAY[(STEPS + 1) % 2]),
        gradients: None,
    }
}

/// Which texels may have more samples.
pub(super) fn effort() -> Step {
    Step {
        stage: Stage::Effort,
        reads: vec![Store::Guides, Store::Motions],
        past: vec![Store::GuidesBefore],
        writes: vec![Store::Guides],
        source: None,
        target: None,
        stride: 1,
    }
}

/// The steps after light, histories being judged by `gradients`.
pub(super) fn filter(gradients: Option<Store>) -> Vec<Step> {
    let mut reads = vec![Store::Guides, Store::Motions, Store::Noisy];
    if let Some(gradients) = gradients {
        reads.extend([gradients, Store::Luminances]);
    }
    let temporal = Step {
        stage: Stage::Temporal,
        reads,
        past: vec![Store::GuidesBefore, Store::History],
        writes: vec![Store::Guides, WAY[0]],
        source: None,
        target: Some(WAY[0]),
        stride: 1,
    };
    let steps = (0..STEPS).map(|number| {
        let [source, target] = [WAY[number % 2], WAY[(number + 1) % 2]];
        // The first step makes the history, too.
        let writes = if number == 0 { vec![target, Store::History] } else { vec![target] };
        Step {
            stage: Stage::Atrous,
            reads: vec![Store::Guides, source],
            past: Vec::new(),
            writes,
            source: Some(source),
            target: Some(target),
            stride: 1 << number,
        }
    });
    std::iter::once(temporal).chain(steps).collect()
}
