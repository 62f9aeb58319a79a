//! Phase 5: from which step to which does each resource hold something that matters?

use crate::PassId;
use crate::check::CheckedResource;
use crate::uses::Uses;

/// When a resource is in use. Outside this span, and where nothing is carried across it, its
/// memory is free: that goes for the idle half of a history resource too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Lifetime {
    /// The first step that touches it, counted from 0 in [`crate::CompiledGraph::steps`].
    pub first: u32,
    /// The last step that touches it.
    pub last: u32,
    /// What it held before the frame is read.
    pub carried_in: bool,
    /// What it holds after the frame matters.
    pub carried_out: bool,
}

/// The lifetime of each resource, in the order of declaration; none for those that no live pass
/// touches.
pub(crate) fn measure(checked: &[CheckedResource], uses: &Uses, order: &[PassId]) -> Vec<Option<Lifetime>> {
    let mut lifetimes = vec![None; checked.len()];
    for (step, pass) in order.iter().enumerate() {
        let step = step as u32;
        for used in uses.of(*pass) {
            let resource = used.resource.index();
            let lifetime = lifetimes[resource].get_or_insert(Lifetime {
                first: step,
                last: step,
                carried_in: used.reads,
                carried_out: checked[resource].is_output,
            });
            lifetime.last = step;
        }
    }
    lifetimes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Access::*, GraphBuilder, PassKind, ResourceDesc, ResourceState};

    #[test]
    fn lifetimes_count_live_steps_only() {
        let buffer = ResourceDesc::Buffer { bytes: 16 };
        let mut graph = GraphBuilder::new();
        let past = ResourceState::after(StorageWriteCompute);
        let previous = graph.history("a", buffer, past);
        let next = graph.history("b", buffer, past);
        let [noisy, dead] = ["noisy", "dead"].map(|name| graph.transient(name, buffer));
        graph.output(next);
        graph.pass("dead", PassKind::Compute).write(dead, StorageWriteCompute);
        graph.pass("light", PassKind::Compute).write(noisy, StorageWriteCompute);
        graph
            .pass("accumulate", PassKind::Compute)
            .read(noisy, StorageReadCompute)
            .read(previous, StorageReadCompute)
            .write(next, StorageWriteCompute);
        let graph = graph.compile().unwrap();
        let span =
            |first, last, carried_in, carried_out| Some(Lifetime { first, last, carried_in, carried_out });
        assert_eq!(graph.lifetime(noisy), span(0, 1, false, false));
        assert_eq!(graph.lifetime(dead), None);
        assert_eq!(graph.lifetime(previous), span(1, 1, true, false));
        assert_eq!(graph.lifetime(next), span(1, 1, false, true));
    }
}
