//! `pathtrace` mode: the frame's world is judged, drawn to a visibility buffer, and lit by rays.
//!
//! `arrange` puts the operations in an order in which that can be done, `prepare` makes the records that shaders
//! read and the world that rays meet, `schedule` declares the passes, one file each in `passes`, and `record` records
//! them. All else of the frame is rasterized as in `raster` mode.

mod anchors;
pub(crate) mod arrange;
mod backend;
mod background;
pub(crate) mod buffers;
mod change;
mod compaction;
pub(crate) mod denoise;
mod device_refit;
mod driver_input;
mod estimator;
mod formers;
mod gather;
mod geometry;
mod hardware;
mod kept_tree;
mod light_cone;
mod light_tree;
mod lights;
mod lists;
mod meshes;
mod options;
mod past;
mod pipelines;
mod prepare;
mod program;
mod radiance;
mod rays;
mod record;
mod refit;
mod replaced;
mod said;
pub(crate) mod schedule;
pub(crate) mod sky;
mod sky_key;
mod slabs;
mod staging;
pub(crate) mod structures;
mod surfaces;
mod tracer;
mod unseen;
mod world;

pub use backend::Backend;
pub use denoise::{Denoiser, UnknownDenoiser};
pub(crate) use gather::TraceInput;
pub use options::{Displaced, ImageOptions, LightChoice, Mode, PathtraceOptions, SkyChoice, Target};
#[cfg(feature = "reload")]
pub(crate) use pipelines::TracePipelines;
pub use prepare::TraceCounts;
pub(crate) use prepare::{PreparedTrace, prepare};
pub use radiance::Radiance;
pub(crate) use record::TraceContext;
pub(crate) use tracer::{Tracer, Tracing, Understood};
