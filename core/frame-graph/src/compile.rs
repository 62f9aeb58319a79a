//! The compiler: a row of phases, each a function from what was declared and what earlier phases
//! found.

use crate::compiled::CompiledGraph;
use crate::pass::Declared;
use crate::{GraphError, barriers, check, cull, lifetimes, order, uses};

pub(crate) fn compile(declared: Declared) -> Result<CompiledGraph, GraphError> {
    let checked = check::resources(&declared)?;
    let uses = uses::merge(&declared)?;
    let fates = cull::fates(&declared, &checked, &uses);
    let order = order::live_passes(&declared, &uses, &fates)?;
    let lifetimes = lifetimes::measure(&checked, &uses, &order);
    let plan = barriers::plan(&declared.resources, &checked, &uses, &order);
    Ok(CompiledGraph { declared, checked, uses, fates, order, lifetimes, plan })
}
