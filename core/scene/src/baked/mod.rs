//! Baked light: what the world shows of it, and the light sources that are recovered from it.
//!
//! While a world with baked light is seen, its static triangles are collected (`learn`, `surfaces`) with all textures
//! over them; which of these is a lightmap is told by evidence (`lightmap`). When enough of the world has been seen it is cut
//! into patches of baked irradiance (`patches`) and surfaces that may shine (`emitters`), from which `afterglow-relight`
//! finds sources (`search`); `sources` makes lights of the scene of them.

mod emitters;
mod learn;
mod lightmap;
mod patches;
mod relit;
mod search;
mod sources;
mod surfaces;
#[cfg(test)]
mod tests;
mod texels;

use std::path::PathBuf;

use afterglow_gl::frame::Frame;

use crate::images::Images;
use crate::types::{Class, LightOrigin, Relight, Relighting, Replacing, Scene, SceneLight};
use learn::learn;
pub use relit::{BakedInto, Bakes, Relit};
use search::{Replacement, Search, Solution};
use surfaces::World;
use texels::Texels;

/// Every so many frames the world is looked at.
const EVERY: u32 = 4;
/// Looks after which sources are searched for the first time.
const FIRST_LOOKS: u32 = 4;
/// They are searched again when the world's area has grown by this factor.
const GROWTH: f32 = 1.5;

/// Collects a world's baked light, and finds its sources.
#[derive(Debug, Default)]
pub struct BakedLight {
    mode: Relighting,
    replacing: Replacing,
    texels: Texels,
    of_world: OfWorld,
}

/// What is known of one world.
#[derive(Debug, Default)]
struct OfWorld {
    /// Which, as the tracker counts them.
    epoch: u64,
    world: World,
    search: Search,
    solution: Option<Solution>,
    /// Of the bake, where lights are given.
    given: Option<Replacement>,
    frames: u32,
    looks: u32,
    /// Area of the world that was searched last.
    searched: f32,
}

impl BakedLight {
    /// Nothing is known yet.
    pub fn new(mode: Relighting, replacing: Replacing) -> BakedLight {
        BakedLight { mode, replacing, ..BakedLight::default() }
    }

    /// Keeps sources in files of this folder.
    pub fn set_cache(&mut self, folder: PathBuf) {
        self.of_world.search.cache = Some(folder);
    }

    /// Takes note of a frame's new texels.
    pub fn learn_images(&mut self, frame: &Frame) {
        if self.mode != Relighting::Off {
            self.texels.learn(frame);
        }
    }

    /// Forgets the images that a frame dropped.
    pub fn forget_images(&mut self, frame: &Frame) {
        if self.mode != Relighting::Off {
            self.texels.forget(frame);
        }
    }

    /// Looks at a frame, and gives its scene the lights that are known. `epoch` counts worlds.
    pub fn apply(&mut self, frame: &Frame, scene: &mut Scene, images: &Images, epoch: u64) {
        if self.mode == Relighting::Off {
            return;
        }
        if self.of_world.epoch != epoch {
            let search = std::mem::take(&mut self.of_world.search).anew();
            self.of_world = OfWorld { epoch, search, ..OfWorld::default() };
        }
        let is_given = are_given(&scene.lights) && self.replacing != Replacing::Never;
        let is_baked = scene.baked && scene.lights.is_empty();
        if !(is_given || is_baked) || scene.camera.is_none() {
            return;
        }
        if self.of_world.frames.is_multiple_of(EVERY) {
            learn(&mut self.of_world.world, frame, scene);
            self.of_world.looks += 1;
            self.consider(scene, images, is_given);
        }
        self.of_world.frames = self.of_world.frames.wrapping_add(1);
        if let Some(found) = self.of_world.search.take() {
            self.of_world.solution = Some(found);
        }
        if is_given {
            scene.relit = self.of_world.given.as_ref().map(|given| given.relit.clone());
        } else if let Some(solution) = &self.of_world.solution {
            light(scene, solution, self.replacing);
        }
    }

    /// Searches where enough has been seen that was not searched before.
    fn consider(&mut self, scene: &Scene, images: &Images, is_given: bool) {
        let known = &mut self.of_world;
        let has_grown = known.world.area > GROWTH * known.searched;
        if known.looks < FIRST_LOOKS || !has_grown || known.search.is_running() {
            return;
        }
        let has_sky = scene.verdicts.iter().any(|verdict| verdict.class == Class::Sky);
        let Some(problem) = known.world.problem(&self.texels, images, has_sky) else { return };
        known.searched = known.world.area;
        match is_given {
            true => known.given = Some(Replacement::by_known_lights(&problem)),
            false => known.search.begin(problem, self.mode == Relighting::Background),
        }
    }
}

/// Whether a profile has said what lights a world.
fn are_given(lights: &[SceneLight]) -> bool {
    !lights.is_empty() && lights.iter().all(|light| light.origin == LightOrigin::Profile)
}

/// Gives a scene the lights that were found, in place of the bake or beside it.
fn light(scene: &mut Scene, solution: &Solution, replacing: Replacing) {
    let report = Relight {
        replaces: match replacing {
            Replacing::Never => false,
            Replacing::WhereGood => solution.report.replaces,
            Replacing::Always => solution.report.lights > 0,
        },
        ..solution.report
    };
    scene.relight = Some(report);
    if report.replaces {
        scene.lights.clone_from(&solution.lights);
        scene.ambient += solution.replacement.ambient;
        scene.sky = solution.replacement.sky;
        scene.relit = Some(solution.replacement.relit.clone());
    } else if report.is_used {
        scene.lights.clone_from(&solution.lights);
        scene.ambient += solution.ambient;
    }
}
