//! Light sources recovered from baked light.
//!
//! Old games bake their lights into lightmaps or vertex colours and have none when they run. A bake is irradiance E
//! at many places, and light adds up: E = sum of power_j x form factor_j + bounce x F(albedo x E) + ambient. So the
//! sources are a sparse non-negative solution of a linear system, once it is known where they may be: emitting surfaces, the
//! sky, suns, and points in the air, which are moved to where they fit best.
//!
//! ```
//! use afterglow_relight::{Baked, Options, Sky, recover};
//! use std::sync::atomic::AtomicBool;
//!
//! let baked = Baked { triangles: &[], patches: &[], emitters: &[], sky: Sky::None };
//! let found = recover(&baked, &Options::default(), &AtomicBool::new(false));
//! assert!(found.is_some_and(|found| found.lights.is_empty()));
//! ```

pub mod cache;
mod candidates;
mod column;
mod descend;
mod fit;
mod gather;
mod lambert;
mod nnls;
mod random;
mod rays;
mod recover;
mod reduce;
mod refine;
mod report;
mod samples;
mod types;
mod world;

pub use recover::recover;
pub use types::{Baked, Emitter, Falloff, FalloffModel, Found, Light, Options, Patch, Sky, Source};
