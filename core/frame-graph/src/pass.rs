//! Passes as declared: a name, a kind, and a range of accesses.

use std::borrow::Cow;

use serde::Serialize;

use crate::{Access, ResourceId, StageClass};

/// Names a pass of the builder that returned it, and of the graph compiled from that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct PassId(pub(crate) u32);

impl PassId {
    /// The position in the order of declaration, from 0: the place of the pass in a list that an
    /// executor keeps beside the graph.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// What a pass runs, and so in which stages it can touch resources.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PassKind {
    /// Draws.
    Graphics,
    /// Dispatches.
    Compute,
    /// Copies, clears and blits; also hands resources to the host or to a window.
    Transfer,
    /// Rays of a ray-tracing pipeline.
    Trace,
    /// Builds of acceleration structures by the driver.
    Build,
}

impl PassKind {
    /// Whether a pass of this kind has the stage.
    pub const fn has_stage(self, stage: StageClass) -> bool {
        match stage {
            StageClass::VertexInput
            | StageClass::Vertex
            | StageClass::Graphics
            | StageClass::Fragment
            | StageClass::Depth
            | StageClass::Color => matches!(self, Self::Graphics),
            StageClass::Compute => matches!(self, Self::Compute),
            StageClass::Trace => matches!(self, Self::Trace),
            StageClass::AccelerationBuild => matches!(self, Self::Build),
            StageClass::Indirect => !matches!(self, Self::Transfer),
            StageClass::Transfer | StageClass::Host | StageClass::Present => {
                matches!(self, Self::Transfer)
            }
        }
    }
}

/// A declared pass.
#[derive(Clone, Debug)]
pub(crate) struct Pass {
    pub name: Cow<'static, str>,
    pub kind: PassKind,
    /// Where its accesses begin in [`Declared::accesses`]; they end where the next pass's begin.
    pub first_access: u32,
    /// It does something that no resource shows, and is never culled for want of readers.
    pub has_side_effect: bool,
    /// Why this frame does without it, if it does.
    pub not_required: Option<Cow<'static, str>>,
}

/// What a declared access does to the contents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Reads them.
    Read,
    /// Replaces all of them.
    Write,
    /// Changes some of them, or depends on what they were.
    ReadWrite,
}

/// One call of `read`, `write` or `read_write`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DeclaredAccess {
    pub resource: ResourceId,
    pub access: Access,
    pub mode: Mode,
}

/// A frame as declared, before any phase of the compiler.
#[derive(Clone, Debug, Default)]
pub(crate) struct Declared {
    pub resources: Vec<crate::resource::Resource>,
    pub passes: Vec<Pass>,
    /// The accesses of all passes, one pass after the other.
    pub accesses: Vec<DeclaredAccess>,
    /// Resources whose contents matter after the frame.
    pub outputs: Vec<ResourceId>,
}

impl Declared {
    /// The accesses of one pass, as they were declared.
    pub fn accesses_of(&self, pass: usize) -> &[DeclaredAccess] {
        let start = self.passes[pass].first_access as usize;
        let end = self.passes.get(pass + 1).map_or(self.accesses.len(), |next| next.first_access as usize);
        &self.accesses[start..end]
    }
}
