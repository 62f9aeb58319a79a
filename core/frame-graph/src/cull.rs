//! Phase 3: which passes matter?
//!
//! Walking backwards, a resource is *needed* from where it is read to where all of it is
//! replaced; a pass matters if it has a side effect or writes what is needed then. What it reads
//! is needed in turn.

use std::borrow::Cow;

use crate::PassId;
use crate::check::CheckedResource;
use crate::pass::{Declared, Pass};
use crate::uses::{ResourceUse, Uses};

/// Why a pass does not run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CullReason {
    /// Nothing that matters reads what it writes.
    UnusedResult,
    /// It was declared as not required, for this reason.
    NotRequired(Cow<'static, str>),
}

impl std::fmt::Display for CullReason {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::UnusedResult => formatter.write_str("unused result"),
            Self::NotRequired(reason) => formatter.write_str(reason),
        }
    }
}

/// What becomes of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fate {
    Live,
    Unused,
    NotRequired,
}

/// The fate of each pass, in the order of declaration.
pub(crate) fn fates(declared: &Declared, checked: &[CheckedResource], uses: &Uses) -> Vec<Fate> {
    let mut needed: Vec<bool> = checked.iter().map(|resource| resource.is_output).collect();
    let mut fates = vec![Fate::Unused; declared.passes.len()];
    for (index, pass) in declared.passes.iter().enumerate().rev() {
        let uses = uses.of(PassId(index as u32));
        fates[index] = fate(pass, uses, &needed);
        if fates[index] == Fate::Live {
            for used in uses {
                needed[used.resource.index()] = used.reads || (needed[used.resource.index()] && !used.writes);
            }
        }
    }
    fates
}

fn fate(pass: &Pass, uses: &[ResourceUse], needed: &[bool]) -> Fate {
    let writes_needed = || uses.iter().any(|used| used.writes && needed[used.resource.index()]);
    if pass.not_required.is_some() {
        Fate::NotRequired
    } else if pass.has_side_effect || writes_needed() {
        Fate::Live
    } else {
        Fate::Unused
    }
}

#[cfg(test)]
mod tests {
    use crate::{Access::*, CompiledGraph, GraphBuilder, PassKind, ResourceDesc, ResourceState};

    const BUFFER: ResourceDesc = ResourceDesc::Buffer { bytes: 16 };

    fn live(graph: &CompiledGraph) -> Vec<&str> {
        graph.steps().filter_map(|step| graph.pass_name(step.pass)).collect()
    }

    #[test]
    fn what_feeds_an_output_lives_and_the_rest_does_not() {
        let mut graph = GraphBuilder::new();
        let out = graph.import("out", BUFFER, ResourceState::UNDEFINED);
        let [used, unused] = ["used", "unused"].map(|name| graph.transient(name, BUFFER));
        graph.output(out);
        graph.pass("a", PassKind::Compute).write(used, StorageWriteCompute);
        graph.pass("b", PassKind::Compute).write(unused, StorageWriteCompute);
        graph.pass("c", PassKind::Compute).read(used, StorageReadCompute).write(out, StorageWriteCompute);
        graph.pass("d", PassKind::Compute).read(out, StorageReadCompute);
        let graph = graph.compile().unwrap();
        assert_eq!(live(&graph), ["a", "c"]);
        let culled: Vec<_> = graph
            .culled()
            .map(|(pass, reason)| (graph.pass_name(pass).unwrap(), reason.to_string()))
            .collect();
        let unused = "unused result".to_string();
        assert_eq!(culled, [("b", unused.clone()), ("d", unused)]);
    }

    #[test]
    fn overwritten_results_are_unused_but_modified_ones_are_not() {
        for modifies in [false, true] {
            let mut graph = GraphBuilder::new();
            let out = graph.import("out", BUFFER, ResourceState::UNDEFINED);
            graph.output(out);
            graph.pass("first", PassKind::Compute).write(out, StorageWriteCompute);
            let mut second = graph.pass("second", PassKind::Compute);
            if modifies {
                second.read_write(out, StorageWriteCompute);
            } else {
                second.write(out, StorageWriteCompute);
            }
            let graph = graph.compile().unwrap();
            assert_eq!(live(&graph).contains(&"first"), modifies);
        }
    }

    #[test]
    fn imports_that_are_no_outputs_keep_nobody_alive() {
        let mut graph = GraphBuilder::new();
        let scratch = graph.import("scratch", BUFFER, ResourceState::UNDEFINED);
        graph.pass("fill", PassKind::Transfer).write(scratch, TransferDst);
        assert!(live(&graph.compile().unwrap()).is_empty());
    }

    #[test]
    fn side_effects_live_unless_not_required() {
        let mut graph = GraphBuilder::new();
        let buffer = graph.transient("buffer", BUFFER);
        graph.pass("fill", PassKind::Transfer).write(buffer, TransferDst);
        graph.pass("answer", PassKind::Transfer).read(buffer, HostRead).side_effect();
        graph
            .pass("sun", PassKind::Compute)
            .side_effect()
            .when(true, "never said")
            .when(false, "no sun")
            .when(false, "second reason");
        let graph = graph.compile().unwrap();
        assert_eq!(live(&graph), ["fill", "answer"]);
        let reasons: Vec<_> = graph.culled().map(|(_, reason)| reason.to_string()).collect();
        assert_eq!(reasons, ["no sun"]);
    }
}
