//! A device without arithmetic: it keeps, for each resource, one value, its layout, and a log of
//! accesses with what each has been ordered before.
//!
//! The log follows the memory model of explicit APIs. A barrier orders an earlier access before
//! the barrier's `to` if the access is in `from`, or has already been ordered before something
//! in `from`. A change of layout is itself a write.

use afterglow_frame_graph::{
    Access, AccessSet, Barrier, CompiledGraph, Layout, Residence, ResourceState, ResourceUse,
};

use crate::mix;
use crate::program::{PassPlan, ResourcePlan};

/// An access that happened.
#[derive(Clone, Copy, Debug)]
struct Event {
    /// None for a change of layout.
    access: Option<Access>,
    writes: bool,
    /// Later accesses of these kinds come after it, and see it.
    ordered_before: AccessSet,
}

impl Event {
    fn of(access: Access) -> Self {
        Self { access: Some(access), writes: access.writes(), ordered_before: AccessSet::EMPTY }
    }

    /// A write that `seen_by` can see, but which no barrier can name any more.
    fn past_write(seen_by: AccessSet) -> Self {
        Self { access: None, writes: true, ordered_before: seen_by }
    }

    fn is_in_scope(&self, from: AccessSet) -> bool {
        self.ordered_before.intersects(from) || self.access.is_some_and(|access| from.contains(access))
    }
}

#[derive(Clone, Debug, Default)]
struct Memory {
    layout: Layout,
    log: Vec<Event>,
}

impl Memory {
    /// What must have happened for the resource to be in the state.
    fn in_state(plan: &ResourcePlan) -> Self {
        let state = plan.initial;
        let accesses = state.accesses();
        let mut log: Vec<Event> = accesses.iter().map(Event::of).collect();
        if state.is_defined() && !accesses.writes() {
            let everything = || Access::ALL.into_iter().collect();
            log.push(Event::past_write(if accesses.is_empty() { everything() } else { accesses }));
        }
        Self { layout: state.layout(&plan.desc).expect("a state that fits"), log }
    }
}

pub struct NullDevice {
    resources: Vec<Memory>,
    values: Vec<u64>,
    /// Makes each loss of contents a value of its own.
    losses: u64,
}

impl NullDevice {
    pub fn new(resources: &[ResourcePlan]) -> Self {
        Self {
            resources: resources.iter().map(Memory::in_state).collect(),
            values: (0..resources.len() as u64).map(|index| mix(77, index)).collect(),
            losses: 0,
        }
    }

    pub fn memory(&self) -> &[u64] {
        &self.values
    }

    /// Transients begin each frame in idle memory that holds anything.
    pub fn begin_frame(&mut self, resources: &[ResourcePlan]) {
        for (index, resource) in resources.iter().enumerate() {
            if resource.residence == Residence::Transient {
                self.resources[index] = Memory::default();
                self.lose(index);
            }
        }
    }

    /// Spoils whatever the lifetimes say is free before this step.
    pub fn lend_idle_memory(&mut self, graph: &CompiledGraph, step: u32) {
        for id in graph.resources() {
            let imported = graph.residence(id) == Some(Residence::Imported);
            let Some(lifetime) = graph.lifetime(id).filter(|_| !imported) else {
                continue;
            };
            let before = step == lifetime.first && !lifetime.carried_in;
            let after = step > lifetime.last && !lifetime.carried_out;
            if before || after {
                self.lose(id.index());
            }
        }
    }

    pub fn barrier(&mut self, barrier: &Barrier) -> Result<(), String> {
        let memory = &mut self.resources[barrier.resource.index()];
        let kept_layout = !barrier.discard && barrier.from_layout != Layout::Undefined;
        if kept_layout && barrier.from_layout != memory.layout {
            return Err(format!("{barrier:?} finds layout {:?}", memory.layout));
        }
        let is_image = barrier.to_layout != Layout::Undefined;
        let changes_layout = is_image && barrier.from_layout != barrier.to_layout;
        for event in &mut memory.log {
            if event.is_in_scope(barrier.from) {
                event.ordered_before |= barrier.to;
            } else if changes_layout {
                return Err(format!("{barrier:?} does not wait for {event:?}"));
            }
        }
        if changes_layout {
            memory.log.push(Event::past_write(barrier.to));
        }
        memory.layout = barrier.to_layout;
        if barrier.discard || (changes_layout && barrier.from_layout == Layout::Undefined) {
            self.lose(barrier.resource.index());
        }
        Ok(())
    }

    /// Executes a pass and returns what it has read, mixed into one value.
    pub fn execute(&mut self, index: usize, uses: &[ResourceUse], pass: &PassPlan) -> Result<u64, String> {
        for used in uses {
            self.access(used).map_err(|hazard| format!("pass {index}: {hazard}"))?;
        }
        let read = pass.reads().fold(index as u64, |seed, resource| mix(seed, self.values[resource]));
        for resource in pass.writes() {
            self.values[resource] = mix(read, resource as u64);
        }
        Ok(read)
    }

    /// After a frame, contents that no longer matter are made equal in both executions, and so
    /// are those of imports that the frame could not lose.
    pub fn synchronize_values(
        &mut self,
        resources: &[ResourcePlan],
        states: &[ResourceState],
        memory: &mut [u64],
    ) {
        for index in 0..resources.len() {
            if !states[index].is_defined() {
                memory[index] = self.values[index];
                self.resources[index].layout = Layout::Undefined;
            }
        }
    }

    fn access(&mut self, used: &ResourceUse) -> Result<(), String> {
        let memory = &mut self.resources[used.resource.index()];
        if memory.layout != used.layout {
            return Err(format!("{used:?} finds layout {:?}", memory.layout));
        }
        for access in used.accesses.iter() {
            let mut hazards = memory
                .log
                .iter()
                .filter(|event| (event.writes || access.writes()) && !event.ordered_before.contains(access));
            if let Some(event) = hazards.next() {
                return Err(format!("{access:?} of {used:?} is not ordered after {event:?}"));
            }
        }
        memory.log.extend(used.accesses.iter().map(Event::of));
        Ok(())
    }

    fn lose(&mut self, index: usize) {
        self.losses += 1;
        self.values[index] = mix(self.losses, 0xBAD);
    }
}
