//! What recovery said of a frame, triangle by triangle.

use afterglow_scene::{Class, LightOrigin, LightShape, Relight, Scene, SceneLight};
use glam::DMat4;

use crate::truth::{FrameTruth, Label, TrueCamera, TrueLight, TrueLightOrigin, TrueLightShape};

/// Consecutive triangles of which recovery said the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// What they are taken for.
    pub class: Class,
    /// The object that they are taken to belong to.
    pub object: Option<u64>,
    /// Why.
    pub reason: &'static str,
    /// How many.
    pub triangles: u64,
}

/// What recovery said of a frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Observed {
    /// The camera, if it found one.
    pub camera: Option<TrueCamera>,
    /// Lights that it took from glLight, by number.
    pub lights: Vec<(u8, LightShape)>,
    /// Lights that it recovered from baked light, and how well that went; where it was asked to.
    pub recovered: Vec<SceneLight>,
    pub relight: Option<Relight>,
    /// Of all triangles, in order.
    pub runs: Vec<Run>,
}

impl Observed {
    /// What a scene says.
    pub fn of(scene: &Scene) -> Observed {
        let runs = scene.verdicts.iter().map(|verdict| Run {
            class: verdict.class,
            reason: verdict.reason,
            object: (verdict.object != 0).then_some(verdict.object),
            triangles: verdict.triangles.into(),
        });
        let camera = scene.camera.map(|camera| TrueCamera {
            view: camera.view,
            projection: DMat4::from_cols_array(&camera.projection.to_cols_array().map(f64::from)),
        });
        let lights = scene.lights.iter().filter_map(|light| match light.origin {
            LightOrigin::Gl(index) => Some((index, light.shape)),
            LightOrigin::Program(_)
            | LightOrigin::Profile
            | LightOrigin::Recovered
            | LightOrigin::SceneFile
            | LightOrigin::Fallback => None,
        });
        let recovered = scene.lights.iter().filter(|light| light.origin == LightOrigin::Recovered);
        Observed {
            camera,
            lights: lights.collect(),
            recovered: recovered.copied().collect(),
            relight: scene.relight,
            runs: runs.filter(|run| run.triangles > 0).collect(),
        }
    }

    /// What a recovery that is always right says.
    pub fn ideal(truth: &FrameTruth) -> Observed {
        let runs = truth.labels.iter().map(|label| Run {
            class: label.class,
            reason: "so it is",
            object: Some(label.object),
            triangles: label.triangles,
        });
        let lights = truth.lights.iter().filter_map(ideal_light);
        Observed {
            camera: truth.camera,
            lights: lights.collect(),
            recovered: Vec::new(),
            relight: None,
            runs: runs.collect(),
        }
    }

    /// Triangles in all.
    pub fn triangles(&self) -> u64 {
        self.runs.iter().map(|run| run.triangles).sum()
    }

    /// Stretches of triangles of which both the truth and recovery say one thing: label, run, number of triangles.
    pub fn beside<'a>(&'a self, truth: &'a FrameTruth) -> impl Iterator<Item = (Label, Run, u64)> + 'a {
        let (mut labels, mut runs) = (truth.labels.iter().copied(), self.runs.iter().copied());
        let (mut label, mut run) = (labels.next(), runs.next());
        std::iter::from_fn(move || {
            let (mut l, mut r) = (label?, run?);
            let count = l.triangles.min(r.triangles);
            let pair = (l, r, count);
            l.triangles -= count;
            r.triangles -= count;
            label = if l.triangles == 0 { labels.next() } else { Some(l) };
            run = if r.triangles == 0 { runs.next() } else { Some(r) };
            Some(pair)
        })
    }
}

fn ideal_light(light: &TrueLight) -> Option<(u8, LightShape)> {
    let TrueLightOrigin::Gl(index) = light.origin else { return None };
    let shape = match light.shape {
        TrueLightShape::Directional { to_light } => {
            LightShape::Directional { to_light: to_light.as_vec3(), angular_radius: 0.0 }
        }
        TrueLightShape::Point { position, attenuation } => {
            LightShape::Point { position: position.as_vec3(), radius: 0.0, attenuation, spot: None }
        }
    };
    Some((index, shape))
}
