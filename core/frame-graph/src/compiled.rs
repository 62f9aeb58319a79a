//! A compiled frame, ready to be walked.

use crate::barriers::BarrierPlan;
use crate::check::CheckedResource;
use crate::cull::Fate;
use crate::pass::Declared;
use crate::uses::Uses;
use crate::{
    Barrier, CullReason, Lifetime, PassId, PassKind, Residence, ResourceDesc, ResourceId, ResourceState,
    ResourceUse,
};

/// What the compiler made of a frame. Ids are those of the builder; an id that the graph does not
/// have finds nothing.
#[derive(Clone, Debug)]
pub struct CompiledGraph {
    pub(crate) declared: Declared,
    pub(crate) checked: Vec<CheckedResource>,
    pub(crate) uses: Uses,
    pub(crate) fates: Vec<Fate>,
    pub(crate) order: Vec<PassId>,
    pub(crate) lifetimes: Vec<Option<Lifetime>>,
    pub(crate) plan: BarrierPlan,
}

/// One live pass, and what comes before it.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    pub pass: PassId,
    pub barriers: &'a [Barrier],
}

impl CompiledGraph {
    /// The live passes in order, each with the barriers that come before it.
    pub fn steps(&self) -> impl ExactSizeIterator<Item = Step<'_>> {
        let mut start = 0;
        self.order.iter().zip(&self.plan.ends).map(move |(pass, end)| {
            let end = *end as usize;
            let barriers = &self.plan.barriers[start..end];
            start = end;
            Step { pass: *pass, barriers }
        })
    }

    /// All barriers, in the order in which steps need them.
    pub fn barriers(&self) -> &[Barrier] {
        &self.plan.barriers
    }

    /// The passes that do not run, in order, and why.
    pub fn culled(&self) -> impl Iterator<Item = (PassId, CullReason)> {
        (0..self.fates.len()).filter_map(|index| {
            let pass = PassId(index as u32);
            self.cull_reason(pass).map(|reason| (pass, reason))
        })
    }

    /// Why a pass does not run; none if it does.
    pub fn cull_reason(&self, pass: PassId) -> Option<CullReason> {
        match self.fates.get(pass.index())? {
            Fate::Live => None,
            Fate::Unused => Some(CullReason::UnusedResult),
            Fate::NotRequired => {
                self.declared.passes[pass.index()].not_required.clone().map(CullReason::NotRequired)
            }
        }
    }

    pub fn is_live(&self, pass: PassId) -> bool {
        self.fates.get(pass.index()) == Some(&Fate::Live)
    }

    pub fn pass_name(&self, pass: PassId) -> Option<&str> {
        let pass = self.declared.passes.get(pass.index())?;
        Some(&pass.name)
    }

    pub fn pass_kind(&self, pass: PassId) -> Option<PassKind> {
        Some(self.declared.passes.get(pass.index())?.kind)
    }

    /// What a pass does to each resource, live or not; empty for an unknown pass.
    pub fn uses_of(&self, pass: PassId) -> &[ResourceUse] {
        if pass.index() < self.fates.len() { self.uses.of(pass) } else { &[] }
    }

    /// All resources, in the order of declaration.
    pub fn resources(&self) -> impl ExactSizeIterator<Item = ResourceId> + use<> {
        (0..self.checked.len() as u32).map(ResourceId)
    }

    /// The name of a resource, which is the key of a history resource.
    pub fn resource_name(&self, resource: ResourceId) -> Option<&str> {
        let resource = self.declared.resources.get(resource.index())?;
        Some(&resource.name)
    }

    pub fn desc(&self, resource: ResourceId) -> Option<ResourceDesc> {
        Some(self.declared.resources.get(resource.index())?.desc)
    }

    pub fn residence(&self, resource: ResourceId) -> Option<Residence> {
        Some(self.declared.resources.get(resource.index())?.residence)
    }

    /// Bytes of payload of a resource, without padding.
    pub fn bytes(&self, resource: ResourceId) -> Option<u64> {
        Some(self.checked.get(resource.index())?.bytes)
    }

    /// When a resource is in use; none if no live pass touches it, so that a transient need not
    /// exist.
    pub fn lifetime(&self, resource: ResourceId) -> Option<Lifetime> {
        *self.lifetimes.get(resource.index())?
    }

    /// How the frame leaves a resource: the state in which the next frame imports it.
    pub fn final_state(&self, resource: ResourceId) -> Option<ResourceState> {
        self.plan.final_states.get(resource.index()).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GraphBuilder;

    #[test]
    fn unknown_ids_find_nothing() {
        let graph = GraphBuilder::new().compile().unwrap();
        let (pass, resource) = (PassId(3), ResourceId(3));
        assert!(!graph.is_live(pass) && graph.uses_of(pass).is_empty());
        assert_eq!(graph.pass_name(pass), None);
        assert_eq!(graph.cull_reason(pass), None);
        assert_eq!(graph.lifetime(resource), None);
        assert_eq!(graph.final_state(resource), None);
    }
}
