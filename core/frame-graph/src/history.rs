//! The states of history resources between frames.

use std::borrow::Cow;
use std::collections::HashMap;

use crate::{CompiledGraph, Residence, ResourceDesc, ResourceState};

/// Remembers under each key how the last frame left the resource.
#[derive(Clone, Debug, Default)]
pub struct HistoryStates {
    states: HashMap<Cow<'static, str>, (ResourceDesc, ResourceState)>,
}

impl HistoryStates {
    pub fn new() -> Self {
        Self::default()
    }

    /// The state with which to declare a history resource: undefined if it is new, or was
    /// of another size, since then its owner makes a new one.
    pub fn state(&self, key: &str, desc: impl Into<ResourceDesc>) -> ResourceState {
        let desc = desc.into();
        match self.states.get(key) {
            Some((known, state)) if *known == desc => *state,
            _ => ResourceState::UNDEFINED,
        }
    }

    /// Takes over the states in which a frame leaves its history. Keys that the frame did not
    /// declare keep theirs.
    pub fn advance(&mut self, graph: &CompiledGraph) {
        let resources = graph.declared.resources.iter();
        for (resource, state) in resources.zip(&graph.plan.final_states) {
            if resource.residence == Residence::History {
                self.states.insert(resource.name.clone(), (resource.desc, *state));
            }
        }
    }

    /// Forgets a resource that its owner has dropped.
    pub fn forget(&mut self, key: &str) {
        self.states.remove(key);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Access, GraphBuilder, PassKind};

    const BUFFER: ResourceDesc = ResourceDesc::Buffer { bytes: 16 };

    /// One frame that writes the history; the number of its barriers.
    fn frame(states: &mut HistoryStates) -> usize {
        let mut graph = GraphBuilder::new();
        let key = "accumulated";
        let history = graph.history(key, BUFFER, states.state(key, BUFFER));
        graph.output(history);
        graph.pass("accumulate", PassKind::Compute).write(history, Access::StorageWriteCompute);
        let graph = graph.compile().unwrap();
        states.advance(&graph);
        graph.barriers().len()
    }

    #[test]
    fn frames_continue_where_the_last_ended() {
        let mut states = HistoryStates::new();
        assert_eq!(frame(&mut states), 0);
        assert_eq!(frame(&mut states), 1);
        let written = ResourceState::after(Access::StorageWriteCompute);
        assert_eq!(states.state("accumulated", BUFFER), written);
    }

    #[test]
    fn new_sizes_begin_anew() {
        let mut states = HistoryStates::new();
        frame(&mut states);
        let larger = ResourceDesc::Buffer { bytes: 32 };
        let undefined = ResourceState::UNDEFINED;
        assert_eq!(states.state("accumulated", larger), undefined);
        states.forget("accumulated");
        assert_eq!(states.state("accumulated", BUFFER), undefined);
    }
}
