//! Lights that the program set by glLight: whether they were found where they are.
//!
//! Both are compared in eye space, where the choice of world space does not matter. A wrong camera does not count here
//! once more, since it moves its lights with it.

use std::io::{self, Write};

use afterglow_scene::{LightShape, Relight};
use glam::{DMat4, DVec3, DVec4, Vec3};
use serde::Serialize;

use super::Observed;
use crate::truth::{FrameTruth, TrueLight, TrueLightOrigin, TrueLightShape, Truth};

/// A light is found within this, relative to the world's extent, or for directions in radians.
const TOLERANCE: f64 = 1e-2;

/// What was measured of the lights, over all frames that show a world.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct LightScore {
    /// That shine by glLight.
    pub told: u64,
    /// Of these, found at their places.
    pub right: u64,
    /// That recovery took from glLight.
    pub found: u64,
}

/// Scores the lights. Lights that are baked, or that recovery made up, do not count.
pub fn score(truth: &Truth, observed: &[Observed]) -> LightScore {
    let mut score = LightScore::default();
    for (frame, observed) in truth.frames.iter().zip(observed) {
        let told = told(frame);
        let found: Vec<(u8, DVec4)> = match observed.camera {
            Some(camera) => observed.lights.iter().map(|&(i, shape)| (i, seen(camera.view, shape))).collect(),
            None => Vec::new(),
        };
        let is_right = |(index, place): &&(u8, DVec4)| {
            found.iter().any(|(found, at)| found == index && is_near(*place, *at, truth.extent))
        };
        score.told += told.len() as u64;
        score.found += found.len() as u64;
        score.right += told.iter().filter(is_right).count() as u64;
    }
    score
}

/// Numbers and homogeneous positions in eye space.
fn told(frame: &FrameTruth) -> Vec<(u8, DVec4)> {
    let Some(camera) = frame.camera else { return Vec::new() };
    let place = |shape| match shape {
        TrueLightShape::Directional { to_light } => to_light.extend(0.0),
        TrueLightShape::Point { position, .. } => position.extend(1.0),
    };
    let lights = frame.lights.iter().filter_map(|light| match light.origin {
        TrueLightOrigin::Gl(index) => Some((index, camera.view * place(light.shape))),
        TrueLightOrigin::Baked => None,
    });
    lights.collect()
}

fn seen(view: DMat4, shape: LightShape) -> DVec4 {
    match shape {
        LightShape::Directional { to_light, .. } => view * to_light.as_dvec3().extend(0.0),
        LightShape::Point { position, .. } => view * position.as_dvec3().extend(1.0),
    }
}

fn is_near(a: DVec4, b: DVec4, extent: f64) -> bool {
    let scale = if a.w == 0.0 { 1.0 } else { extent };
    a.w == b.w && a.distance(b) < TOLERANCE * scale
}

/// A lamp that was baked, and the recovered light that is nearest to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BakedLight {
    /// How far apart they are, relative to the world's extent.
    pub distance: f64,
    /// What the bake multiplied by.
    pub told: Vec3,
    /// The recovered light's power in the bake's unit.
    pub found: Vec3,
}

/// What was recovered of the lights that a program's bake was computed from.
#[derive(Debug, Clone, PartialEq)]
pub struct BakedScore {
    /// As recovery says.
    pub relight: Relight,
    /// A lamp each.
    pub lights: Vec<BakedLight>,
}

/// Compares the lamps that a program's bake was computed from with what was recovered in the last frame that has any;
/// nothing where nothing was recovered or no lamp was baked.
pub fn baked(truth: &Truth, observed: &[Observed]) -> Option<BakedScore> {
    let mut frames = truth.frames.iter().zip(observed).rev();
    let (frame, observed) = frames.find(|(_, observed)| observed.relight.is_some())?;
    let (true_view, view, relight) = (frame.camera?.view, observed.camera?.view, observed.relight?);
    let points = observed.recovered.iter().filter_map(|light| match light.shape {
        LightShape::Point { position, .. } => {
            Some((view.transform_point3(position.as_dvec3()), light.color / relight.scale))
        }
        LightShape::Directional { .. } => None,
    });
    let points: Vec<(DVec3, Vec3)> = points.collect();
    let lights = frame.lights.iter().filter(|light| light.origin == TrueLightOrigin::Baked);
    let nearest = |light: &TrueLight| {
        let TrueLightShape::Point { position, .. } = light.shape else { return None };
        let at = true_view.transform_point3(position);
        let (place, found) = points.iter().min_by(|a, b| a.0.distance(at).total_cmp(&b.0.distance(at)))?;
        let distance = place.distance(at) / truth.extent;
        Some(BakedLight { distance, told: light.color, found: *found })
    };
    Some(BakedScore { relight, lights: lights.filter_map(nearest).collect() })
}

/// A profile with the lamps that a program's bake was computed from, in the world that recovery has, in the units of what
/// it found; nothing where [`baked`] finds nothing.
pub fn lights_profile(truth: &Truth, observed: &[Observed]) -> Option<String> {
    let mut frames = truth.frames.iter().zip(observed).rev();
    let (frame, observed) = frames.find(|(_, observed)| observed.relight.is_some())?;
    let scale = observed.relight?.scale;
    let world = observed.camera?.view.inverse() * frame.camera?.view;
    let ambient = scale * truth.baked_ambient;
    let mut text = format!("[lights]\nambient = [{ambient}, {ambient}, {ambient}]\nbounce = [0, 0, 0]\n");
    for light in frame.lights.iter().filter(|light| light.origin == TrueLightOrigin::Baked) {
        let TrueLightShape::Point { position, .. } = light.shape else { continue };
        let [x, y, z] = world.transform_point3(position).to_array();
        let [r, g, b] = (scale * light.color).to_array();
        text += &format!(
            "[[light]]\nkind = \"point\"\nposition = [{x}, {y}, {z}]\ncolor = [{r}, {g}, {b}]\nreach = 1\n"
        );
    }
    Some(text)
}

/// Writes what [`baked`] found of a style.
///
/// # Errors
/// Those of `out`.
pub fn write_baked(out: &mut impl Write, style: &str, score: Option<&BakedScore>) -> io::Result<()> {
    let Some(BakedScore { relight, lights }) = score else {
        return writeln!(out, "{style:<18} nothing recovered");
    };
    writeln!(
        out,
        "{style:<18} residual {:.3}, explained {:.3}, variance {:.3}, {} lights of {} patches, used {}, replaces {}",
        relight.residual,
        relight.explained,
        relight.variance,
        relight.lights,
        relight.patches,
        relight.is_used,
        relight.replaces
    )?;
    for light in lights {
        let error = light.found.distance(light.told) / light.told.length().max(f32::MIN_POSITIVE);
        writeln!(
            out,
            "{:<18}   {:.2} % of the extent away, power {:.3} for {:.3}: {:.1} % wrong",
            "",
            100.0 * light.distance,
            light.found,
            light.told,
            100.0 * error
        )?;
    }
    Ok(())
}
