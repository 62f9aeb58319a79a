//! Random frames, compiled and executed on a device that computes nothing but notices everything.
//!
//! Each frame runs twice: plainly, every required pass in order in a perfect memory, and as
//! compiled, on [`device::NullDevice`], which loses contents where it may and refuses accesses
//! that no barrier orders. What the outside can see must be the same.

mod device;
mod program;

use afterglow_frame_graph::{CompiledGraph, Residence, ResourceState};
use device::NullDevice;
use program::{FramePlan, PassSeed, Program, ResourcePlan};
use proptest::prelude::*;

/// What a frame shows: the values of outputs, and what passes with side effects read.
#[derive(Debug, PartialEq, Eq)]
struct Shown {
    outputs: Vec<(usize, u64)>,
    observations: Vec<u64>,
}

/// The values that a pass writes are made of this and of what it reads.
fn mix(seed: u64, value: u64) -> u64 {
    (seed ^ value).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29).wrapping_add(value)
}

fn shown_outputs(resources: &[ResourcePlan], memory: &[u64]) -> Vec<(usize, u64)> {
    let outputs = (0..resources.len()).filter(|index| resources[*index].is_output);
    outputs.map(|index| (index, memory[index])).collect()
}

/// Executes all required passes, culling nothing, in a memory without hazards.
fn run_plainly(frame: &FramePlan, resources: &[ResourcePlan], memory: &mut [u64]) -> Shown {
    let mut observations = Vec::new();
    for (index, pass) in frame.passes.iter().enumerate() {
        if !pass.required {
            continue;
        }
        let read = pass.reads().fold(index as u64, |seed, resource| mix(seed, memory[resource]));
        for resource in pass.writes() {
            memory[resource] = mix(read, resource as u64);
        }
        if pass.side_effect {
            observations.push(read);
        }
    }
    Shown { outputs: shown_outputs(resources, memory), observations }
}

/// Executes the compiled frame on the device; `omitted` leaves out one barrier.
fn run_compiled(
    graph: &CompiledGraph,
    frame: &FramePlan,
    resources: &[ResourcePlan],
    device: &mut NullDevice,
    omitted: Option<usize>,
) -> Result<Shown, String> {
    let mut observations = Vec::new();
    let mut barrier_index = 0;
    device.begin_frame(resources);
    for (step, compiled) in graph.steps().enumerate() {
        device.lend_idle_memory(graph, step as u32);
        for barrier in compiled.barriers {
            if omitted != Some(barrier_index) {
                device.barrier(barrier)?;
            }
            barrier_index += 1;
        }
        let index = compiled.pass.index();
        let pass = &frame.passes[index];
        let read = device.execute(index, graph.uses_of(compiled.pass), pass)?;
        if pass.side_effect {
            observations.push(read);
        }
    }
    device.lend_idle_memory(graph, graph.steps().len() as u32);
    Ok(Shown { outputs: shown_outputs(resources, device.memory()), observations })
}

/// The states in which the next frame finds the resources. Contents that were no output are void
/// if the frame wrote them, or might have lent their memory out.
fn next_states(graph: &CompiledGraph, frame: &FramePlan, resources: &[ResourcePlan]) -> Vec<ResourceState> {
    let written: Vec<bool> = (0..resources.len())
        .map(|index| frame.passes.iter().any(|pass| pass.writes().any(|w| w == index)))
        .collect();
    let ids = graph.resources();
    ids.map(|id| {
        let resource = &resources[id.index()];
        let last = graph.final_state(id).expect("an id of this graph");
        let lent = resource.residence == Residence::History;
        match resource.residence {
            Residence::Transient => ResourceState::UNDEFINED,
            _ if !resource.is_output && (written[id.index()] || lent) => {
                ResourceState::undefined_after(last.accesses())
            }
            _ => last,
        }
    })
    .collect()
}

/// Runs all frames both ways.
fn check_program(program: &Program) -> Result<(), TestCaseError> {
    let resources = &program.resources;
    let mut states: Vec<_> = resources.iter().map(|resource| resource.initial).collect();
    let mut device = NullDevice::new(resources);
    let mut memory = device.memory().to_vec();
    for seeds in &program.frames {
        let frame = FramePlan::new(resources, &states, seeds);
        let graph = frame
            .declare(resources, &states)
            .compile()
            .map_err(|error| TestCaseError::fail(error.to_string()))?;
        let expected = run_plainly(&frame, resources, &mut memory);
        let shown =
            run_compiled(&graph, &frame, resources, &mut device, None).map_err(TestCaseError::fail)?;
        prop_assert_eq!(expected, shown);
        states = next_states(&graph, &frame, resources);
        device.synchronize_values(resources, &states, &mut memory);
    }
    Ok(())
}

/// Runs the first frame once for each barrier, without it.
fn check_each_barrier_is_needed(program: &Program) -> Result<(), TestCaseError> {
    let resources = &program.resources;
    let states: Vec<_> = resources.iter().map(|resource| resource.initial).collect();
    let seeds: &[PassSeed] = program.frames.first().map_or(&[], Vec::as_slice);
    let frame = FramePlan::new(resources, &states, seeds);
    let graph = frame
        .declare(resources, &states)
        .compile()
        .map_err(|error| TestCaseError::fail(error.to_string()))?;
    for (index, barrier) in graph.barriers().iter().enumerate() {
        let mut device = NullDevice::new(resources);
        let result = run_compiled(&graph, &frame, resources, &mut device, Some(index));
        prop_assert!(result.is_err(), "nothing needs {:?}", barrier);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 1500,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn compiled_frames_show_what_plain_ones_do(program in program::programs()) {
        check_program(&program)?;
    }

    #[test]
    fn every_barrier_is_needed(program in program::programs()) {
        check_each_barrier_is_needed(&program)?;
    }
}
