//! Phase 6: what must be waited for, made visible or rearranged before each pass.
//!
//! Each resource goes through *runs*: a write by itself, or all reads up to the next write that
//! share a layout. A barrier stands where one run ends and the next begins, and covers all of
//! the new run at once, so that later reads of it need no barrier of their own. Everything runs
//! on one queue.

use crate::check::CheckedResource;
use crate::resource::Resource;
use crate::uses::{ResourceUse, Uses};
use crate::{AccessSet, Layout, PassId, ResourceId, ResourceState};

/// What has to happen to one resource before a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Barrier {
    pub resource: ResourceId,
    /// The earlier accesses to wait for. Empty where memory is fresh: the executor sees to it
    /// that the memory of transients is idle when a frame begins.
    pub from: AccessSet,
    /// The later accesses that wait; those of this pass, and of further ones that read the same.
    pub to: AccessSet,
    /// [`Layout::Undefined`] for buffers, and where the contents are discarded.
    pub from_layout: Layout,
    pub to_layout: Layout,
    /// The contents may be lost: the pass replaces them all.
    pub discard: bool,
}

/// The barriers of a frame.
#[derive(Clone, Debug)]
pub(crate) struct BarrierPlan {
    /// One step after the other.
    pub barriers: Vec<Barrier>,
    /// Where each step's barriers end.
    pub ends: Vec<u32>,
    /// How the frame leaves each resource.
    pub final_states: Vec<ResourceState>,
}

/// Plans the barriers before each pass of `order`.
pub(crate) fn plan(
    resources: &[Resource],
    checked: &[CheckedResource],
    uses: &Uses,
    order: &[PassId],
) -> BarrierPlan {
    let mut runs: Vec<Run> = resources
        .iter()
        .zip(checked)
        .map(|(resource, checked)| Run::before_frame(resource.initial, checked.initial_layout))
        .collect();
    let mut barriers = Vec::with_capacity(order.len());
    let mut ends = Vec::with_capacity(order.len());
    for pass in order {
        for used in uses.of(*pass) {
            runs[used.resource.index()].advance(used, &mut barriers);
        }
        ends.push(barriers.len() as u32);
    }
    BarrierPlan { barriers, ends, final_states: runs.iter().map(Run::state).collect() }
}

/// The current run of a resource.
#[derive(Clone, Copy, Debug)]
struct Run {
    accesses: AccessSet,
    layout: Layout,
    defined: bool,
    opening: Opening,
}

/// How further reads can join the run.
#[derive(Clone, Copy, Debug)]
enum Opening {
    /// Every access sees the contents already.
    Settled,
    /// By joining the barrier that opened the run, given by its index.
    Barrier(usize),
    /// By a barrier of their own: the run began before the frame.
    Earlier,
}

impl Run {
    fn before_frame(state: ResourceState, layout: Layout) -> Self {
        let accesses = state.accesses();
        Self {
            accesses,
            layout,
            defined: state.is_defined(),
            opening: if accesses.is_empty() { Opening::Settled } else { Opening::Earlier },
        }
    }

    fn state(&self) -> ResourceState {
        if self.defined {
            ResourceState::after(self.accesses)
        } else {
            ResourceState::undefined_after(self.accesses)
        }
    }

    /// Moves on to the next use, with a barrier where one is needed.
    fn advance(&mut self, used: &ResourceUse, barriers: &mut Vec<Barrier>) {
        if !used.writes && !self.accesses.writes() && self.layout == used.layout {
            self.join(used, barriers);
        } else {
            self.replace(used, barriers);
        }
    }

    /// A further read.
    fn join(&mut self, used: &ResourceUse, barriers: &mut Vec<Barrier>) {
        let new = used.accesses.without(self.accesses);
        if new.is_empty() {
            return;
        }
        match self.opening {
            Opening::Settled => {}
            Opening::Barrier(index) => barriers[index].to |= new,
            Opening::Earlier => {
                self.opening = Opening::Barrier(barriers.len());
                barriers.push(self.barrier_to(used, new));
            }
        }
        // The earlier readers stay: a later write has to wait for them as well.
        self.accesses |= new;
    }

    /// A new run. Only a write can find nothing to wait for and its layout already there, and
    /// nothing joins a write: so a read run always has the barrier that it is said to have.
    fn replace(&mut self, used: &ResourceUse, barriers: &mut Vec<Barrier>) {
        let opening = Opening::Barrier(barriers.len());
        if !self.accesses.is_empty() || self.layout != used.layout {
            barriers.push(self.barrier_to(used, used.accesses));
        }
        *self = Self { accesses: used.accesses, layout: used.layout, defined: true, opening };
    }

    fn barrier_to(&self, used: &ResourceUse, to: AccessSet) -> Barrier {
        Barrier {
            resource: used.resource,
            from: self.accesses,
            to,
            from_layout: if used.discards() { Layout::Undefined } else { self.layout },
            to_layout: used.layout,
            discard: used.discards(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Access::{self, *},
        CompiledGraph, Format, GraphBuilder, ImageDesc, PassKind, ResourceDesc,
    };

    #[derive(Clone, Copy)]
    enum How {
        Read,
        Write,
        Modify,
    }
    use How::*;

    /// Compiles passes that each touch the one resource, which is in `state` before.
    fn compile(
        desc: impl Into<ResourceDesc>,
        state: ResourceState,
        passes: &[(PassKind, How, Access)],
    ) -> CompiledGraph {
        let mut graph = GraphBuilder::new();
        let resource = graph.import("it", desc, state);
        for (kind, how, access) in passes {
            let mut pass = graph.pass("pass", *kind);
            match how {
                Read => pass.read(resource, *access),
                Write => pass.write(resource, *access),
                Modify => pass.read_write(resource, *access),
            };
            pass.side_effect();
        }
        graph.compile().unwrap()
    }

    fn image() -> ImageDesc {
        ImageDesc::flat((8, 8), Format::Rgba8Unorm)
    }

    const BUFFER: ResourceDesc = ResourceDesc::Buffer { bytes: 64 };
    const DRAW: PassKind = PassKind::Graphics;
    const DISPATCH: PassKind = PassKind::Compute;
    const COPY: PassKind = PassKind::Transfer;

    fn set<const N: usize>(accesses: [Access; N]) -> AccessSet {
        accesses.into_iter().collect()
    }

    #[test]
    fn one_barrier_serves_all_reads_up_to_the_next_write() {
        let graph = compile(
            image(),
            ResourceState::UNDEFINED,
            &[
                (COPY, Write, TransferDst),
                (DRAW, Read, SampledFragment),
                (DISPATCH, Read, SampledCompute),
                (DRAW, Read, SampledFragment),
                (COPY, Write, TransferDst),
            ],
        );
        let counts: Vec<_> = graph.steps().map(|step| step.barriers.len()).collect();
        assert_eq!(counts, [1, 1, 0, 0, 1]);
        let [first, read, last] = graph.barriers() else {
            panic!("three barriers");
        };
        assert!(first.discard && first.from.is_empty());
        assert_eq!(read.from, set([TransferDst]));
        assert_eq!(read.to, set([SampledFragment, SampledCompute]));
        assert_eq!((read.from_layout, read.to_layout), (Layout::TransferDst, Layout::ShaderRead));
        assert_eq!(last.from, read.to);
        assert_eq!((last.from_layout, last.discard), (Layout::Undefined, true));
    }

    #[test]
    fn images_change_layout_between_reads_and_buffers_do_not() {
        let passes = [(DRAW, Read, StorageReadFragment), (COPY, Read, TransferSrc)];
        let state = ResourceState::after(TransferDst);
        let graph = compile(BUFFER, state, &passes);
        assert_eq!(graph.barriers().len(), 1);
        assert_eq!(graph.barriers()[0].to, set([StorageReadFragment, TransferSrc]));
        let graph = compile(image(), state, &passes);
        assert_eq!(graph.barriers().len(), 2);
        assert_eq!(graph.barriers()[1].from, set([StorageReadFragment]));
        assert!(!graph.barriers()[1].discard);
    }

    #[test]
    fn writes_wait_for_writes_and_keep_what_they_modify() {
        let twice = [(DRAW, Modify, ColorAttachment), (DRAW, Modify, ColorAttachment)];
        let graph = compile(image(), ResourceState::after(ColorAttachment), &twice);
        for barrier in graph.barriers() {
            assert_eq!(barrier.from, set([ColorAttachment]));
            assert_eq!(barrier.from_layout, barrier.to_layout);
            assert!(!barrier.discard);
        }
        assert_eq!(graph.barriers().len(), 2);
    }

    #[test]
    fn readers_of_the_last_frame_need_nothing_and_new_ones_one_barrier() {
        let state = ResourceState::after(SampledFragment);
        let graph = compile(image(), state, &[(DRAW, Read, SampledFragment)]);
        assert!(graph.barriers().is_empty());
        let twice = [(DISPATCH, Read, SampledCompute), (DISPATCH, Read, SampledCompute)];
        let graph = compile(image(), state, &twice);
        assert_eq!(graph.barriers().len(), 1);
        assert_eq!(graph.barriers()[0].from, set([SampledFragment]));
        let resource = graph.barriers()[0].resource;
        let both = ResourceState::after(set([SampledFragment, SampledCompute]));
        assert_eq!(graph.final_state(resource), Some(both));
    }

    #[test]
    fn settled_buffers_are_read_freely_but_not_overwritten_under_readers() {
        let graph = compile(
            BUFFER,
            ResourceState::SETTLED,
            &[
                (DRAW, Read, VertexRead),
                (DISPATCH, Read, StorageReadCompute),
                (DISPATCH, Write, StorageWriteCompute),
            ],
        );
        assert_eq!(graph.barriers().len(), 1);
        assert_eq!(graph.barriers()[0].from, set([VertexRead, StorageReadCompute]));
    }

    #[test]
    fn acquired_images_wait_without_keeping_contents() {
        let graph = compile(
            image(),
            ResourceState::undefined_after(ColorAttachment),
            &[(DRAW, Write, ColorAttachment), (COPY, Read, Present)],
        );
        let [acquire, present] = graph.barriers() else {
            panic!("two barriers");
        };
        assert_eq!(acquire.from, set([ColorAttachment]));
        assert_eq!(acquire.from_layout, Layout::Undefined);
        assert_eq!(present.to_layout, Layout::Present);
    }

    #[test]
    fn ten_thousand_copies_take_two_barriers_each() {
        let mut graph = GraphBuilder::new();
        let drawn = ResourceState::after(ColorAttachment);
        let color = graph.import("color", image(), drawn);
        let sampled = ResourceState::after(SampledFragment);
        let texture = graph.import("texture", image(), sampled);
        graph.output(color);
        for _ in 0..10_000 {
            graph.pass("copy", COPY).read(color, TransferSrc).write(texture, TransferDst);
            graph.pass("draw", DRAW).read(texture, SampledFragment).read_write(color, ColorAttachment);
        }
        let graph = graph.compile().unwrap();
        assert_eq!(graph.steps().len(), 20_000);
        assert!(graph.steps().all(|step| step.barriers.len() == 2));
    }
}
