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
mod search;
mod sources;
mod surfaces;
#[cfg(test)]
mod tests;
mod texels;

use std::path::PathBuf;

use afterglow_gl::frame::Frame;

use crate::images::Images;
use crate::types::{Class, Relighting, Scene};
use learn::learn;
use search::{Search, Solution};
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
    texels: Texels,
    world: World,
    search: Search,
    solution: Option<Solution>,
    /// Which world it is of, as the tracker counts them.
    epoch: u64,
    frames: u32,
    looks: u32,
    /// Area of the world that was searched last.
    searched: f32,
}

impl BakedLight {
    /// Nothing is known yet.
    pub fn new(mode: Relighting) -> BakedLight {
        BakedLight { mode, ..BakedLight::default() }
    }

    /// Keeps sources in files of this folder.
    pub fn set_cache(&mut self, folder: PathBuf) {
        self.search.cache = Some(folder);
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
        if self.epoch != epoch {
            let (mode, texels) = (self.mode, std::mem::take(&mut self.texels));
            let search = std::mem::take(&mut self.search).anew();
            *self = BakedLight { mode, texels, search, epoch, ..BakedLight::default() };
        }
        let is_baked = scene.baked && scene.lights.is_empty() && scene.camera.is_some();
        if !is_baked {
            return;
        }
        if self.frames.is_multiple_of(EVERY) {
            learn(&mut self.world, frame, scene);
            self.looks += 1;
            self.consider(scene, images);
        }
        self.frames = self.frames.wrapping_add(1);
        if let Some(found) = self.search.take() {
            self.solution = Some(found);
        }
        if let Some(solution) = &self.solution {
            scene.relight = Some(solution.report);
            if solution.report.is_used {
                scene.lights.clone_from(&solution.lights);
                scene.ambient += solution.ambient;
            }
        }
    }

    /// Searches where enough has been seen that was not searched before.
    fn consider(&mut self, scene: &Scene, images: &Images) {
        let has_grown = self.world.area > GROWTH * self.searched;
        if self.looks < FIRST_LOOKS || !has_grown || self.search.is_running() {
            return;
        }
        let has_sky = scene.verdicts.iter().any(|verdict| verdict.class == Class::Sky);
        let Some(problem) = self.world.problem(&self.texels, images, has_sky) else { return };
        self.searched = self.world.area;
        self.search.begin(problem, self.mode == Relighting::Background);
    }
}
