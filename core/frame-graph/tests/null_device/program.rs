//! Random programs: resources, and frames of passes that use them in ways that make sense.

use afterglow_frame_graph::{
    Access, AccessSet, Format, GraphBuilder, ImageDesc, PassKind, Residence, ResourceDesc, ResourceState,
};
use proptest::collection::vec;
use proptest::prelude::*;

#[derive(Clone, Debug)]
pub struct ResourcePlan {
    pub desc: ResourceDesc,
    pub residence: Residence,
    pub initial: ResourceState,
    pub is_output: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    Read,
    Write,
    ReadWrite,
}

/// A wish for an access: which resource and access, modulo what there is, and how.
pub type AccessSeed = (u8, u8, Mode);

#[derive(Clone, Debug)]
pub struct PassSeed {
    kind: PassKind,
    accesses: Vec<AccessSeed>,
    side_effect: bool,
    required: bool,
}

#[derive(Clone, Debug)]
pub struct Program {
    pub resources: Vec<ResourcePlan>,
    pub frames: Vec<Vec<PassSeed>>,
}

#[derive(Clone, Debug)]
pub struct PassPlan {
    pub kind: PassKind,
    pub accesses: Vec<(usize, Access, Mode)>,
    pub side_effect: bool,
    pub required: bool,
}

#[derive(Clone, Debug)]
pub struct FramePlan {
    pub passes: Vec<PassPlan>,
}

impl PassPlan {
    fn resources(&self, modes: [Mode; 2]) -> impl Iterator<Item = usize> {
        let mut resources: Vec<usize> = self
            .accesses
            .iter()
            .filter(|(_, _, mode)| modes.contains(mode))
            .map(|(resource, _, _)| *resource)
            .collect();
        resources.sort_unstable();
        resources.dedup();
        resources.into_iter()
    }

    /// Resources whose contents it depends on, in order.
    pub fn reads(&self) -> impl Iterator<Item = usize> {
        self.resources([Mode::Read, Mode::ReadWrite])
    }

    /// Resources that it changes, in order.
    pub fn writes(&self) -> impl Iterator<Item = usize> {
        self.resources([Mode::Write, Mode::ReadWrite])
    }

    /// Adds the access that the seed wishes for, if that makes sense here.
    fn add(&mut self, seed: &AccessSeed, resources: &[ResourcePlan], defined: &[bool]) {
        let resource = usize::from(seed.0) % resources.len();
        let desc = &resources[resource].desc;
        let mode = match seed.2 {
            Mode::Read | Mode::ReadWrite if !defined[resource] => Mode::Write,
            mode => mode,
        };
        let possible: Vec<Access> = Access::ALL
            .into_iter()
            .filter(|access| access.writes() == (mode != Mode::Read))
            .filter(|access| access.fits(desc) && self.kind.has_stage(access.stage()))
            .collect();
        if possible.is_empty() {
            return;
        }
        let access = possible[usize::from(seed.1) % possible.len()];
        if self.tolerates(resource, access, desc) {
            self.accesses.push((resource, access, mode));
        }
    }

    fn tolerates(&self, resource: usize, access: Access, desc: &ResourceDesc) -> bool {
        let earlier = self.accesses.iter().filter(|(other, _, _)| *other == resource);
        let earlier: AccessSet = earlier.map(|(_, access, _)| *access).collect();
        let all = earlier | access.into();
        all.is_free_of_conflict() && (!desc.is_image() || all.layout().is_some())
    }
}

impl FramePlan {
    /// Turns wishes into passes that read only what has been written by then.
    pub fn new(resources: &[ResourcePlan], states: &[ResourceState], seeds: &[PassSeed]) -> Self {
        let mut defined: Vec<bool> = states.iter().map(|state| state.is_defined()).collect();
        let passes = seeds.iter().map(|seed| {
            let mut pass = PassPlan {
                kind: seed.kind,
                accesses: Vec::new(),
                side_effect: seed.side_effect,
                required: seed.required,
            };
            for access in &seed.accesses {
                pass.add(access, resources, &defined);
            }
            if pass.required {
                pass.writes().for_each(|resource| defined[resource] = true);
            }
            pass
        });
        Self { passes: passes.collect() }
    }

    pub fn declare(&self, resources: &[ResourcePlan], states: &[ResourceState]) -> GraphBuilder {
        let mut graph = GraphBuilder::new();
        let mut ids = Vec::new();
        for (index, (resource, state)) in resources.iter().zip(states).enumerate() {
            let name = format!("resource {index}");
            let id = match resource.residence {
                Residence::Transient => graph.transient(name, resource.desc),
                Residence::History => graph.history(name, resource.desc, *state),
                Residence::Imported => graph.import(name, resource.desc, *state),
            };
            if resource.is_output {
                graph.output(id);
            }
            ids.push(id);
        }
        for (index, plan) in self.passes.iter().enumerate() {
            let mut pass = graph.pass(format!("pass {index}"), plan.kind);
            pass.when(plan.required, "left out");
            if plan.side_effect {
                pass.side_effect();
            }
            for (resource, access, mode) in &plan.accesses {
                match mode {
                    Mode::Read => pass.read(ids[*resource], *access),
                    Mode::Write => pass.write(ids[*resource], *access),
                    Mode::ReadWrite => pass.read_write(ids[*resource], *access),
                };
            }
        }
        graph
    }
}

fn descs() -> impl Strategy<Value = ResourceDesc> {
    prop_oneof![
        2 => Just(ImageDesc::flat((4, 4), Format::Rgba8Unorm).into()),
        1 => Just(ImageDesc::flat((4, 4), Format::D32Float).into()),
        2 => Just(ResourceDesc::Buffer { bytes: 64 }),
    ]
}

/// States that a resource can be in before the first frame.
fn initial_states(desc: ResourceDesc) -> impl Strategy<Value = ResourceState> {
    let fitting: Vec<Access> = Access::ALL.into_iter().filter(|access| access.fits(&desc)).collect();
    let settled = if desc.is_image() { ResourceState::UNDEFINED } else { ResourceState::SETTLED };
    let access = proptest::sample::select(fitting);
    prop_oneof![
        Just(ResourceState::UNDEFINED),
        Just(settled),
        access.clone().prop_map(ResourceState::undefined_after),
        access.prop_map(ResourceState::after),
    ]
}

fn resources() -> impl Strategy<Value = ResourcePlan> {
    let residences =
        prop_oneof![Just(Residence::Transient), Just(Residence::History), Just(Residence::Imported),];
    (descs(), residences, any::<bool>()).prop_flat_map(|(desc, residence, is_output)| {
        initial_states(desc).prop_map(move |initial| {
            let transient = residence == Residence::Transient;
            ResourcePlan {
                desc,
                residence,
                initial: if transient { ResourceState::UNDEFINED } else { initial },
                is_output: is_output && !transient,
            }
        })
    })
}

fn passes() -> impl Strategy<Value = PassSeed> {
    let kinds = prop_oneof![
        3 => Just(PassKind::Graphics),
        3 => Just(PassKind::Compute),
        2 => Just(PassKind::Transfer),
        1 => Just(PassKind::Trace),
        1 => Just(PassKind::Build),
    ];
    let modes = prop_oneof![
        3 => Just(Mode::Read),
        1 => Just(Mode::Write),
        1 => Just(Mode::ReadWrite),
    ];
    let accesses = vec((any::<u8>(), any::<u8>(), modes), 0..6);
    (kinds, accesses, prop::bool::weighted(0.1), prop::bool::weighted(0.85)).prop_map(
        |(kind, accesses, side_effect, required)| PassSeed { kind, accesses, side_effect, required },
    )
}

/// Up to six resources and three frames of up to twelve passes.
pub fn programs() -> impl Strategy<Value = Program> {
    let frames = vec(vec(passes(), 0..12), 1..4);
    (vec(resources(), 1..7), frames).prop_map(|(resources, frames)| Program { resources, frames })
}
