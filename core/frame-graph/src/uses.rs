//! Phase 2: what each pass does to each resource, all its accesses taken together.

use crate::pass::{Declared, DeclaredAccess, Mode, Pass};
use crate::resource::Resource;
use crate::{AccessSet, GraphError, Layout, PassId, ResourceId};

/// All that one pass does to one resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResourceUse {
    pub resource: ResourceId,
    pub accesses: AccessSet,
    /// The layout in which the pass finds an image; [`Layout::Undefined`] for a buffer.
    pub layout: Layout,
    /// What the resource held before matters: an attachment is loaded, not cleared.
    pub reads: bool,
    pub writes: bool,
}

impl ResourceUse {
    /// The contents are replaced whatever they were.
    pub const fn discards(&self) -> bool {
        self.writes && !self.reads
    }
}

/// The uses of all passes, one pass after the other; each resource occurs once a pass.
#[derive(Clone, Debug)]
pub(crate) struct Uses {
    uses: Vec<ResourceUse>,
    /// Where each pass's uses end.
    ends: Vec<u32>,
}

impl Uses {
    pub fn of(&self, pass: PassId) -> &[ResourceUse] {
        let start = match pass.index() {
            0 => 0,
            index => self.ends[index - 1] as usize,
        };
        &self.uses[start..self.ends[pass.index()] as usize]
    }
}

/// Merges the declared accesses a pass and resource, and checks them.
pub(crate) fn merge(declared: &Declared) -> Result<Uses, GraphError> {
    let mut uses: Vec<ResourceUse> = Vec::with_capacity(declared.accesses.len());
    let mut ends = Vec::with_capacity(declared.passes.len());
    // Where the latest use of each resource is, so that finding it takes constant time.
    let mut latest = vec![usize::MAX; declared.resources.len()];
    for (index, pass) in declared.passes.iter().enumerate() {
        let start = uses.len();
        for access in declared.accesses_of(index) {
            let resource = check_access(declared, pass, access)?;
            let added = use_of(access, resource);
            let place = &mut latest[access.resource.index()];
            match uses.get_mut(*place).filter(|_| *place >= start) {
                Some(earlier) => extend(earlier, &added, pass, resource)?,
                None => {
                    *place = uses.len();
                    uses.push(added);
                }
            }
        }
        ends.push(uses.len() as u32);
    }
    Ok(Uses { uses, ends })
}

/// Checks one declared access by itself and returns the resource it names.
fn check_access<'a>(
    declared: &'a Declared,
    pass: &Pass,
    declaration: &DeclaredAccess,
) -> Result<&'a Resource, GraphError> {
    let access = declaration.access;
    let Some(resource) = declared.resources.get(declaration.resource.index()) else {
        return Err(GraphError::UnknownResource {
            pass: pass.name.to_string(),
            resource: declaration.resource.0,
        });
    };
    if access.writes() == (declaration.mode == Mode::Read) {
        return Err(wrong_mode(pass, resource, declaration));
    }
    if !pass.kind.has_stage(access.stage()) {
        return Err(GraphError::WrongKind { pass: pass.name.to_string(), kind: pass.kind, access });
    }
    if !access.fits(&resource.desc) {
        return Err(GraphError::WrongResource {
            pass: pass.name.to_string(),
            resource: resource.name.to_string(),
            access,
        });
    }
    Ok(resource)
}

fn wrong_mode(pass: &Pass, resource: &Resource, declaration: &DeclaredAccess) -> GraphError {
    let access = declaration.access;
    let (pass, resource) = (pass.name.to_string(), resource.name.to_string());
    if declaration.mode == Mode::Read {
        GraphError::ReadByWritingAccess { pass, resource, access }
    } else {
        GraphError::WriteByReadingAccess { pass, resource, access }
    }
}

/// The use that one declared access makes alone.
fn use_of(declaration: &DeclaredAccess, resource: &Resource) -> ResourceUse {
    let access = declaration.access;
    let mut accesses = AccessSet::of(access);
    if declaration.mode == Mode::ReadWrite
        && let Some(read) = access.read_counterpart()
    {
        accesses |= read.into();
    }
    let layout = if resource.desc.is_image() { access.layout() } else { Layout::Undefined };
    ResourceUse {
        resource: declaration.resource,
        accesses,
        layout,
        reads: declaration.mode != Mode::Write,
        writes: declaration.mode != Mode::Read,
    }
}

/// Adds a further access of the same pass to what it already does to the resource.
fn extend(
    earlier: &mut ResourceUse,
    added: &ResourceUse,
    pass: &Pass,
    resource: &Resource,
) -> Result<(), GraphError> {
    let accesses = earlier.accesses | added.accesses;
    let layout = earlier.layout.join(added.layout).filter(|_| accesses.is_free_of_conflict());
    let Some(layout) = layout else {
        return Err(GraphError::Conflict {
            pass: pass.name.to_string(),
            resource: resource.name.to_string(),
            accesses,
        });
    };
    *earlier = ResourceUse {
        resource: earlier.resource,
        accesses,
        layout,
        reads: earlier.reads || added.reads,
        writes: earlier.writes || added.writes,
    };
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Access, Format, GraphBuilder, ImageDesc, PassKind, ResourceDesc, ResourceState};

    /// One pass on an imported image and an imported buffer.
    fn compile_pass(
        kind: PassKind,
        declare: impl FnOnce(&mut crate::PassBuilder<'_>, ResourceId, ResourceId),
    ) -> Result<Vec<ResourceUse>, GraphError> {
        let mut graph = GraphBuilder::new();
        let desc = ImageDesc::flat((4, 4), Format::Rgba8Unorm);
        let image = graph.import("image", desc, ResourceState::after(Access::TransferDst));
        let desc = ResourceDesc::Buffer { bytes: 64 };
        let buffer = graph.import("buffer", desc, ResourceState::SETTLED);
        let mut pass = graph.pass("pass", kind);
        declare(pass.side_effect(), image, buffer);
        let id = pass.id();
        graph.compile().map(|compiled| compiled.uses_of(id).to_vec())
    }

    #[test]
    fn accesses_of_one_resource_become_one_use() {
        let uses = compile_pass(PassKind::Graphics, |pass, image, buffer| {
            pass.read(buffer, Access::VertexRead)
                .write(image, Access::ColorAttachment)
                .read(buffer, Access::IndexRead);
        })
        .unwrap();
        assert_eq!(uses.len(), 2);
        let both = [Access::VertexRead, Access::IndexRead].into_iter().collect();
        assert_eq!(uses[0].accesses, both);
        assert!(uses[0].reads && !uses[0].writes && uses[1].discards());
    }

    #[test]
    fn storage_in_place_reads_and_writes() {
        let uses = compile_pass(PassKind::Compute, |pass, image, buffer| {
            pass.read(image, Access::StorageReadCompute)
                .write(image, Access::StorageWriteCompute)
                .read_write(buffer, Access::StorageWriteCompute);
        })
        .unwrap();
        for used in uses {
            assert!(used.reads && used.writes);
            assert!(used.accesses.contains(Access::StorageReadCompute));
        }
    }

    #[test]
    fn feedback_is_a_conflict() {
        let found = compile_pass(PassKind::Graphics, |pass, image, _| {
            pass.read(image, Access::SampledFragment).write(image, Access::ColorAttachment);
        });
        assert!(matches!(found, Err(GraphError::Conflict { .. })));
    }

    #[test]
    fn a_buffer_is_not_copied_onto_itself_by_halves() {
        let found = compile_pass(PassKind::Transfer, |pass, _, buffer| {
            pass.read(buffer, Access::TransferSrc).read_write(buffer, Access::TransferDst);
        });
        assert!(matches!(found, Err(GraphError::Conflict { .. })));
        let within = compile_pass(PassKind::Transfer, |pass, _, buffer| {
            pass.read_write(buffer, Access::TransferWithin);
        });
        assert!(within.is_ok());
    }

    #[test]
    fn modes_match_accesses() {
        let found = compile_pass(PassKind::Graphics, |pass, image, _| {
            pass.read(image, Access::ColorAttachment);
        });
        assert!(matches!(found, Err(GraphError::ReadByWritingAccess { .. })));
        let found = compile_pass(PassKind::Graphics, |pass, image, _| {
            pass.read_write(image, Access::SampledFragment);
        });
        assert!(matches!(found, Err(GraphError::WriteByReadingAccess { .. })));
    }

    #[test]
    fn stages_match_kinds_and_accesses_match_resources() {
        let found = compile_pass(PassKind::Compute, |pass, image, _| {
            pass.read(image, Access::SampledFragment);
        });
        assert!(matches!(found, Err(GraphError::WrongKind { .. })));
        let found = compile_pass(PassKind::Graphics, |pass, image, _| {
            pass.read(image, Access::VertexRead);
        });
        assert!(matches!(found, Err(GraphError::WrongResource { .. })));
    }

    #[test]
    fn resources_are_known() {
        let found = compile_pass(PassKind::Graphics, |pass, _, _| {
            pass.read(ResourceId(7), Access::SampledFragment);
        });
        let pass = "pass".into();
        let resource = 7;
        assert_eq!(found, Err(GraphError::UnknownResource { pass, resource }));
    }
}
