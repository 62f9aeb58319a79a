//! Blockwise multi-order feature regression (Koskela and others, ACM TOG 38(5), 2019): light as a function of where surfaces lie and which
//! way they face, of each block of texels another one. Histories are those of A-SVGF.

use super::{Plan, Stage, Step, Store, asvgf};

pub(super) fn plan() -> Plan {
    let mut plan = asvgf::plan();
    // All up to the history.
    plan.after_light.retain(|step| step.stage != Stage::Atrous);
    plan.after_light.push(Step {
        stage: Stage::Regress,
        reads: vec![Store::Guides, Store::Work],
        past: Vec::new(),
        writes: vec![Store::Fits],
        source: Some(Store::Work),
        target: None,
        stride: 1,
    });
    plan.after_light.push(Step {
        stage: Stage::Evaluate,
        reads: vec![Store::Guides, Store::Work, Store::Fits],
        past: Vec::new(),
        writes: vec![Store::Noisy, Store::History],
        source: Some(Store::Work),
        target: Some(Store::Noisy),
        stride: 1,
    });
    plan.output = Some(Store::Noisy);
    plan
}
