//! How light is estimated: what the modes mean for shaders.

use afterglow_records::{TRACE_INDEPENDENT, TRACE_ROULETTE, TRACE_UNIFORM_LIGHTS, TRACE_UNLIMITED};

use super::options::{LightChoice, Mode, PathtraceOptions};

/// Lights with a place that are asked at the seen surface, and candidates of each, at most: shaders have numbers for so many.
const MOST_ASKED: u32 = 4;
const MOST_CANDIDATES: u32 = 8;

/// What shaders need to know of the mode and its options.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Estimator {
    /// Surfaces of a path that scatter, at most.
    pub(crate) surfaces: u32,
    pub(crate) asked: u32,
    pub(crate) candidates: u32,
    /// `TRACE_` constants.
    pub(crate) traits: u32,
    pub(crate) most_radiance: f32,
    /// Frames of a scene that does not change add up.
    pub(crate) accumulates: bool,
}

impl Estimator {
    pub(crate) fn of(mode: Mode, options: &PathtraceOptions) -> Self {
        let is_reference = mode == Mode::Reference;
        let mut traits = match options.light_choice {
            LightChoice::Resampled => 0,
            LightChoice::Uniform => TRACE_UNIFORM_LIGHTS,
        };
        if is_reference {
            traits |= TRACE_INDEPENDENT | TRACE_UNLIMITED | TRACE_ROULETTE;
        }
        let candidates = match options.light_choice {
            LightChoice::Resampled => options.candidates.clamp(1, MOST_CANDIDATES),
            LightChoice::Uniform => 1,
        };
        Self {
            surfaces: if is_reference { options.target.surfaces() } else { options.surfaces.max(1) },
            asked: if is_reference { 1 } else { options.asked.clamp(1, MOST_ASKED) },
            candidates,
            traits,
            most_radiance: options.most_radiance,
            accumulates: is_reference || options.accumulate,
        }
    }
}
