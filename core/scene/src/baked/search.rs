//! The search for sources: at once, or on a thread beside the frames.

use std::f32::consts::PI;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use afterglow_relight::{Baked, Emitter, Falloff, Found, Light, Options, Patch, Sky, Source, cache, recover};
use glam::Vec3;

use super::relit::{Bakes, Relit};
use super::sources;
use crate::program_cache;
use crate::types::{Relight, SceneLight};

/// What a search may cost; see [`Options::rays`].
const RAYS: u64 = 3_000_000;
/// Bytes of a file of what was found, and of all such files, at most.
const MOST_FILE_BYTES: u64 = 8 << 20;
const MOST_FOLDER_BYTES: u64 = 64 << 20;
/// Lights are used from this share of explained area on, up to this residual.
const LEAST_EXPLAINED: f32 = 0.4;
const MOST_RESIDUAL: f32 = 0.4;
/// They take the place of the bake from these shares on: of explained area, and of the variance.
const LEAST_TO_REPLACE: f32 = 0.8;
const LEAST_VARIANCE: f32 = 0.95;

/// What sources are searched in.
#[derive(Debug)]
pub struct Problem {
    /// All of the static world.
    pub triangles: Vec<[Vec3; 3]>,
    /// Its lit surfaces.
    pub patches: Vec<Patch>,
    /// Surfaces that may shine.
    pub emitters: Vec<Emitter>,
    /// The brightest that the bake can be.
    pub saturation: f32,
    /// The program draws a sky.
    pub has_sky: bool,
    /// What is baked light in it.
    pub bakes: Bakes,
}

/// What was found.
#[derive(Debug, Clone)]
pub struct Solution {
    /// The strongest first.
    pub lights: Vec<SceneLight>,
    /// What comes from everywhere, as [`Scene::ambient`](crate::Scene::ambient) has it.
    pub ambient: Vec3,
    /// What lights the world where traced light takes the place of the baked.
    pub replacement: Replacement,
    /// How good it is.
    pub report: Relight,
}

/// What takes the place of baked light, beside the lights.
#[derive(Debug, Clone)]
pub struct Replacement {
    /// What is replaced.
    pub relit: Relit,
    /// What every surface gets alike, as [`Scene::ambient`](crate::Scene::ambient) has it.
    pub ambient: Vec3,
    /// As [`Scene::sky`](crate::Scene::sky) has it.
    pub sky: Vec3,
}

impl Replacement {
    /// For lights that are known, whatever a search would find.
    pub fn by_known_lights(problem: &Problem) -> Replacement {
        let scale = sources::scale(&problem.patches);
        let relit = Relit { bakes: problem.bakes.clone(), scale, bounce: Vec3::ONE };
        Replacement { relit, ambient: Vec3::ZERO, sky: Vec3::ZERO }
    }
}

/// Light sources are searched in one problem at a time.
#[derive(Debug, Default)]
pub struct Search {
    /// Found, and nobody has asked for it yet.
    found: Option<Solution>,
    running: Option<Running>,
    /// The folder of what was found before.
    pub cache: Option<PathBuf>,
}

#[derive(Debug)]
struct Running {
    cancel: Arc<AtomicBool>,
    result: Receiver<Solution>,
}

impl Drop for Running {
    fn drop(&mut self) {
        self.cancel.store(true, Ordering::Relaxed);
    }
}

impl Search {
    /// Nothing is searched any more, nor known but for the folder.
    pub fn anew(self) -> Search {
        Search { cache: self.cache, ..Search::default() }
    }

    /// Whether a thread searches.
    pub fn is_running(&self) -> bool {
        self.running.is_some()
    }

    /// Searches, on a thread where `in_background`.
    pub fn begin(&mut self, problem: Problem, in_background: bool) {
        if !in_background {
            self.found = solve(&problem, self.cache.as_deref(), &AtomicBool::new(false));
            return;
        }
        let (sender, result) = channel();
        let cancel = Arc::new(AtomicBool::new(false));
        let running = Running { cancel: cancel.clone(), result };
        let thread = std::thread::Builder::new().name("relight".into());
        let cache = self.cache.clone();
        let work = move || {
            if let Some(solution) = solve(&problem, cache.as_deref(), &cancel) {
                // Nobody waits any more: so be it.
                let _ = sender.send(solution);
            }
        };
        // Without a thread the world stays as it is baked.
        self.running = thread.spawn(work).ok().map(|_| running);
    }

    /// What was found since the last call.
    pub fn take(&mut self) -> Option<Solution> {
        if let Some(running) = &self.running {
            match running.result.try_recv() {
                Ok(solution) => self.found = Some(solution),
                Err(TryRecvError::Empty) => return self.found.take(),
                Err(TryRecvError::Disconnected) => {}
            }
            self.running = None;
        }
        self.found.take()
    }
}

/// None where it was cancelled. Where a sky is drawn it is let in where nothing was seen; if that explains too little, the holes
/// in what is known of the world may not be sky.
fn solve(problem: &Problem, cache: Option<&Path>, cancel: &AtomicBool) -> Option<Solution> {
    let found = |sky| {
        let baked = Baked {
            triangles: &problem.triangles,
            patches: &problem.patches,
            emitters: &problem.emitters,
            sky,
        };
        let options = Options { saturation: Some(problem.saturation), rays: RAYS, ..Options::default() };
        match cache {
            Some(folder) => recover_once(&baked, &options, folder, cancel),
            None => recover(&baked, &options, cancel),
        }
    };
    let mut best = found(if problem.has_sky { Sky::Open } else { Sky::None })?;
    if problem.has_sky && !is_good(best.residual, best.explained) {
        let closed = found(Sky::None)?;
        let rays = best.rays + closed.rays;
        best = Found { rays, ..if closed.residual < best.residual { closed } else { best } };
    }
    Some(solution(problem, &best))
}

/// As [`recover`], unless its result is in a file of this folder; then it is.
fn recover_once(baked: &Baked, options: &Options, folder: &Path, cancel: &AtomicBool) -> Option<Found> {
    let key = cache::key(baked, options);
    let path = folder.join(format!("{key:016x}"));
    match program_cache::read(&path, MOST_FILE_BYTES) {
        Ok(None) => {}
        Ok(Some(bytes)) => match cache::from_bytes(key, &bytes).filter(|found| is_sound(found, baked)) {
            Some(found) => return Some(found),
            None => tracing::warn!("{}: light sources are damaged or of another version", path.display()),
        },
        Err(error) => tracing::warn!("{}: light sources cannot be read: {error}", path.display()),
    }
    let found = recover(baked, options, cancel)?;
    if let Err(error) = program_cache::write(&path, &cache::to_bytes(key, &found), MOST_FOLDER_BYTES) {
        tracing::debug!("{}: light sources cannot be kept: {error}", path.display());
    }
    Some(found)
}

/// Whether something can have been found so: a file's bytes may be anybody's.
fn is_sound(found: &Found, baked: &Baked) -> bool {
    let is_light = |light: &Light| {
        let is_finite = light.power.is_finite() && light.power.min_element() >= 0.0;
        is_finite
            && match light.source {
                Source::Point { position, radius, falloff } => {
                    let reach = if let Falloff::Linear { reach } = falloff { reach } else { 1.0 };
                    position.is_finite() && radius.is_finite() && radius >= 0.0 && reach > 0.0
                }
                Source::Sun { direction, angular_radius } => {
                    direction.is_normalized() && (0.0..PI).contains(&angular_radius)
                }
                Source::Area { emitter } => emitter < baked.emitters.len(),
                Source::Sky => true,
            }
    };
    found.lights.iter().all(is_light) && found.ambient.is_finite() && found.bounce.is_finite()
}

fn is_good(residual: f32, explained: f32) -> bool {
    explained >= LEAST_EXPLAINED && residual <= MOST_RESIDUAL
}

/// Share of the bake's variance over its patches that sources explain (R^2). Light that is nearly even has a small residual
/// whatever is found, and what is seen of it is how it varies.
fn explained_variance(residual: f32, patches: &[Patch]) -> f32 {
    let area: f32 = patches.iter().map(|patch| patch.area).sum();
    let mean = patches.iter().map(|patch| patch.area * patch.irradiance).sum::<Vec3>() / area;
    let sum = |of: Vec3| {
        patches.iter().map(|patch| patch.area * (patch.irradiance - of).length_squared()).sum::<f32>()
    };
    let variance = 1.0 - residual * residual * sum(Vec3::ZERO) / sum(mean);
    if variance.is_finite() { variance.max(0.0) } else { 0.0 }
}

fn solution(problem: &Problem, found: &Found) -> Solution {
    let scale = sources::scale(&problem.patches);
    let lights = sources::lights(&found.lights, &problem.emitters, scale);
    let variance = explained_variance(found.residual, &problem.patches);
    let report = Relight {
        residual: found.residual,
        explained: found.explained,
        variance,
        triangles: problem.triangles.len(),
        patches: problem.patches.len(),
        emitters: problem.emitters.len(),
        sources: found.lights.len(),
        lights: lights.len(),
        rays: found.rays,
        scale,
        is_used: is_good(found.residual, found.explained),
        replaces: found.explained >= LEAST_TO_REPLACE && variance >= LEAST_VARIANCE,
    };
    let replacement = Replacement {
        relit: Relit { bakes: problem.bakes.clone(), scale, bounce: found.bounce },
        ambient: scale * found.ambient,
        sky: scale * sources::sky(found),
    };
    Solution { lights, ambient: scale * sources::ambient(found, &problem.patches), replacement, report }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_that_is_even_has_no_variance_to_explain() {
        let patch = |x: f32, light: f32| Patch {
            position: Vec3::X * x,
            normal: Vec3::Y,
            area: 1.0,
            irradiance: Vec3::splat(light),
            albedo: Vec3::ONE,
        };
        let patches = |lights: [f32; 3]| [0, 1, 2].map(|i| patch(i as f32, lights[i]));
        // The same error says much of light that varies, and little of light that is nearly even.
        assert!(explained_variance(0.1, &patches([0.0, 1.0, 5.0])) > 0.98);
        assert!(explained_variance(0.1, &patches([0.9, 1.0, 1.1])) < 0.01);
        assert_eq!(explained_variance(0.1, &patches([1.0; 3])), 0.0);
        assert_eq!(explained_variance(0.1, &[]), 0.0);
    }
}
