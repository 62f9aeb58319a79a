//! Declaring a frame. Nothing is checked here, so that declaring is cheap and cannot fail; all
//! errors come from [`GraphBuilder::compile`].

use std::borrow::Cow;

use crate::compile::compile;
use crate::pass::{Declared, DeclaredAccess, Mode, Pass};
use crate::resource::Resource;
use crate::{
    Access, CompiledGraph, GraphError, PassId, PassKind, Residence, ResourceDesc, ResourceId, ResourceState,
};

/// Collects the resources and passes of one frame.
#[derive(Debug, Default)]
pub struct GraphBuilder {
    declared: Declared,
}

impl GraphBuilder {
    pub fn new() -> Self {
        Self::default()
    }

    /// A resource that lives outside, in the state in which it was left. One thing must be
    /// imported once only: the graph cannot see that two ids share memory.
    pub fn import(
        &mut self,
        name: impl Into<Cow<'static, str>>,
        desc: impl Into<ResourceDesc>,
        state: ResourceState,
    ) -> ResourceId {
        self.resource(name.into(), desc.into(), Residence::Imported, state)
    }

    /// A resource of this frame only, empty at first.
    pub fn transient(
        &mut self,
        name: impl Into<Cow<'static, str>>,
        desc: impl Into<ResourceDesc>,
    ) -> ResourceId {
        let state = ResourceState::UNDEFINED;
        self.resource(name.into(), desc.into(), Residence::Transient, state)
    }

    /// A resource that is kept from frame to frame under a key, in the state in which the last
    /// frame left it (see [`crate::HistoryStates`]). Where a frame reads the last one's result and
    /// writes a new one, these are two resources that change places each frame, and only the
    /// written one is an [`output`](Self::output).
    pub fn history(
        &mut self,
        key: impl Into<Cow<'static, str>>,
        desc: impl Into<ResourceDesc>,
        state: ResourceState,
    ) -> ResourceId {
        self.resource(key.into(), desc.into(), Residence::History, state)
    }

    /// The contents of this imported or history resource matter after the frame, so whoever
    /// writes them is not culled.
    pub fn output(&mut self, resource: ResourceId) {
        self.declared.outputs.push(resource);
    }

    /// A pass that runs after all passes declared before it.
    pub fn pass(&mut self, name: impl Into<Cow<'static, str>>, kind: PassKind) -> PassBuilder<'_> {
        self.declared.passes.push(Pass {
            name: name.into(),
            kind,
            // 2^32 accesses would take 32 GiB: memory ends before the count does.
            first_access: self.declared.accesses.len() as u32,
            has_side_effect: false,
            not_required: None,
        });
        PassBuilder { declared: &mut self.declared }
    }

    /// Runs the phases of the compiler.
    ///
    /// # Errors
    /// Whatever makes the declared frame meaningless; see [`GraphError`].
    pub fn compile(self) -> Result<CompiledGraph, GraphError> {
        compile(self.declared)
    }

    fn resource(
        &mut self,
        name: Cow<'static, str>,
        desc: ResourceDesc,
        residence: Residence,
        initial: ResourceState,
    ) -> ResourceId {
        let id = ResourceId(self.declared.resources.len() as u32);
        self.declared.resources.push(Resource { name, desc, residence, initial });
        id
    }
}

/// Declares what one pass does. The pass exists from the call of [`GraphBuilder::pass`] on.
#[derive(Debug)]
pub struct PassBuilder<'a> {
    declared: &'a mut Declared,
}

impl PassBuilder<'_> {
    /// Reads `resource`.
    pub fn read(&mut self, resource: ResourceId, access: Access) -> &mut Self {
        self.declare(resource, access, Mode::Read)
    }

    /// Replaces **all** contents of `resource`, whatever they were: earlier contents are lost,
    /// and passes that only made those are culled. Drawing over a picture is
    /// [`read_write`](Self::read_write).
    pub fn write(&mut self, resource: ResourceId, access: Access) -> &mut Self {
        self.declare(resource, access, Mode::Write)
    }

    /// Changes `resource` in part, or depending on what it held. `access` is the writing one.
    pub fn read_write(&mut self, resource: ResourceId, access: Access) -> &mut Self {
        self.declare(resource, access, Mode::ReadWrite)
    }

    /// Does something that no resource shows (presents, answers the program): never culled
    /// for want of readers.
    pub fn side_effect(&mut self) -> &mut Self {
        self.this().has_side_effect = true;
        self
    }

    /// Needed only if `required`; otherwise culled, and reported with `reason` ("no sun"). Of
    /// several conditions that fail the first is reported.
    pub fn when(&mut self, required: bool, reason: impl Into<Cow<'static, str>>) -> &mut Self {
        let pass = self.this();
        if !required && pass.not_required.is_none() {
            pass.not_required = Some(reason.into());
        }
        self
    }

    pub fn id(&self) -> PassId {
        PassId(self.declared.passes.len() as u32 - 1)
    }

    fn declare(&mut self, resource: ResourceId, access: Access, mode: Mode) -> &mut Self {
        self.declared.accesses.push(DeclaredAccess { resource, access, mode });
        self
    }

    fn this(&mut self) -> &mut Pass {
        let last = self.declared.passes.len() - 1;
        &mut self.declared.passes[last]
    }
}
