//! SVGF whose histories are believed only as far as light has not changed: one texel in nine is traced with the numbers of the frame
//! before, so that what differs there is the light. All three channels have such gradients.

use super::{Plan, Stage, Step, Store, svgf};

/// Steps of the filter over gradients.
const STEPS: usize = 4;
const BOTH: [Store; 2] = [Store::Gradients, Store::MoreGradients];

pub(super) fn plan() -> Plan {
    let select = Step {
        stage: Stage::Select,
        reads: vec![Store::Guides, Store::Motions],
        past: vec![Store::GuidesBefore, Store::Luminances],
        writes: vec![Store::Strata],
        source: None,
        target: None,
        stride: 1,
    };
    let gradient = Step {
        stage: Stage::Gradient,
        reads: vec![Store::Strata, Store::Luminances],
        past: Vec::new(),
        writes: vec![BOTH[0]],
        source: None,
        target: Some(BOTH[0]),
        stride: 1,
    };
    let spread = (0..STEPS).map(|step| Step {
        stage: Stage::Spread,
        reads: vec![Store::Guides, BOTH[step % 2]],
        past: Vec::new(),
        writes: vec![BOTH[1 - step % 2]],
        source: Some(BOTH[step % 2]),
        target: Some(BOTH[1 - step % 2]),
        stride: 1 << step,
    });
    let gradients = BOTH[STEPS % 2];
    let filter = svgf::filter(Some(gradients));
    Plan {
        before_light: vec![svgf::effort(), select],
        after_light: std::iter::once(gradient).chain(spread).chain(filter).collect(),
        gradients: Some(gradients),
        ..svgf::plan()
    }
}
