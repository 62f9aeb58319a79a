//! Passes, resources, lifetimes and barriers as data.
//!
//! A frame is declared, in the order in which it runs, as passes that name what they read and
//! write. [`GraphBuilder::compile`] then finds which passes matter, how long each resource lives
//! and which barriers stand between two passes. Nothing here knows a graphics API: whoever
//! executes the graph walks [`CompiledGraph::steps`], translates each [`Barrier`], and runs what
//! it keeps for that [`PassId`].
//!
//! The compiler is a row of phases, a file each, in `compile.rs`:
//! check → uses → cull → order → lifetimes → barriers. All are linear in passes plus accesses.
//!
//! ```
//! use afterglow_frame_graph::{Access, Format, GraphBuilder, ImageDesc, PassKind, ResourceState};
//!
//! let mut graph = GraphBuilder::new();
//! let size = (640, 480);
//! let frame = graph.import("frame", ImageDesc::flat(size, Format::Rgba8Unorm), ResourceState::UNDEFINED);
//! let light = graph.transient("light", ImageDesc::flat(size, Format::Rgba16Float));
//! let unused = graph.transient("unused", ImageDesc::flat(size, Format::Rgba16Float));
//! graph.output(frame);
//!
//! graph.pass("direct-light", PassKind::Compute).write(light, Access::StorageWriteCompute);
//! graph.pass("specular", PassKind::Compute).write(unused, Access::StorageWriteCompute);
//! graph
//!     .pass("composite", PassKind::Graphics)
//!     .read(light, Access::SampledFragment)
//!     .write(frame, Access::ColorAttachment);
//!
//! let graph = graph.compile()?;
//! let names: Vec<_> = graph.steps().map(|step| graph.pass_name(step.pass)).collect();
//! assert_eq!(names, [Some("direct-light"), Some("composite")]);
//! # Ok::<(), afterglow_frame_graph::GraphError>(())
//! ```

mod access;
mod access_set;
mod barriers;
mod builder;
mod check;
mod compile;
mod compiled;
mod cull;
mod error;
mod format;
mod history;
mod layout;
mod lifetimes;
mod order;
mod pass;
mod report;
mod resource;
mod state;
mod uses;

pub use access::{Access, StageClass};
pub use access_set::AccessSet;
pub use barriers::Barrier;
pub use builder::{GraphBuilder, PassBuilder};
pub use compiled::{CompiledGraph, Step};
pub use cull::CullReason;
pub use error::GraphError;
pub use format::Format;
pub use history::HistoryStates;
pub use layout::Layout;
pub use lifetimes::Lifetime;
pub use pass::{PassId, PassKind};
pub use report::{BytesReport, CulledReport, PassReport, Report, ResourceReport};
pub use resource::{ImageDesc, Residence, ResourceDesc, ResourceId};
pub use state::ResourceState;
pub use uses::ResourceUse;
