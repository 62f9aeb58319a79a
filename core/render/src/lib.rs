//! The renderer: executes the frames that a context emits.
//!
//! A frame's operations are sorted into steps (`plan`), the steps declared as passes of the frame graph (`schedule`),
//! and the passes recorded (`execute`), one file a pass in `passes`. In `raster` mode the result is what OpenGL 1.5
//! defines; in `pathtrace` mode the world in it is lit by rays (`pathtrace`).

mod bindings;
mod drawables;
mod error;
mod execute;
mod graph;
mod numbers;
mod overlaps;
mod parts;
mod passes;
mod pathtrace;
mod pipeline_state;
mod pipelines;
mod plan;
mod queries;
mod rectangles;
#[cfg(feature = "reload")]
mod reload;
mod renderer;
mod replacements;
mod report;
mod retained;
mod samplers;
mod scale;
mod schedule;
mod slot;
mod sorter;
mod store;
mod tables;
mod target;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod textures;
mod uploads;
mod window;

pub use afterglow_frame_graph::CulledReport;
pub use afterglow_records::Paint;
pub use drawables::Carried;
pub use error::RenderError;
pub use pathtrace::{
    Backend, Denoiser, Displaced, ImageOptions, LightChoice, Mode, PathtraceOptions, Radiance, SkyChoice,
    Target, TraceCounts, UnknownDenoiser,
};
pub use renderer::{RenderOptions, Renderer};
pub use report::{FrameReport, PassReport, SceneReport};
pub use scale::Scale;
