//! A profile's rules applied to a frame, over what recovery found.
//!
//! Classes are overridden before light is gathered, so that lights and sky follow from them; camera, lights and the
//! sky's colour after it.

use std::sync::Arc;

use afterglow_gl::frame::Frame;
use glam::{DMat3, DMat4, DVec3, Mat4, Vec3};

use super::rules::{Baked, CameraKind, Found, MatrixKind, Order, Profile, Rule, Subject};
use crate::draws::{DrawFacts, TransformFacts};
use crate::images::Images;
use crate::matrix;
use crate::types::{Class, LightOrigin, LightShape, Replacing, Scene, SceneLight, Verdict};

/// Rotations that differ by less in every entry are the same.
const SAME_TURN: f64 = 1e-4;
/// Places that differ by less, as distances to the eye go, are the same.
const SAME_PLACE: f64 = 1e-4;

/// What rules look at beside images: a frame, and what recovery knows of it.
#[derive(Clone, Copy)]
pub(crate) struct Evidence<'a> {
    pub(crate) frame: &'a Frame,
    pub(crate) draws: &'a [DrawFacts<'a>],
    pub(crate) transforms: &'a [TransformFacts],
    /// World to eye space; none in a frame without a world.
    pub(crate) view: Option<DMat4>,
}

/// A profile, and what it did to the frame before.
#[derive(Debug, Default)]
pub(crate) struct Overrides {
    profile: Option<Arc<Profile>>,
    /// From the world that recovery found to the profile's, of the frame before.
    world_before: Option<DMat4>,
}

impl Overrides {
    pub(crate) fn new(profile: Option<Arc<Profile>>) -> Overrides {
        Overrides { profile, world_before: None }
    }

    /// Overrides classes.
    pub(crate) fn classes(&self, evidence: Evidence, images: &Images, verdicts: &mut [Verdict]) {
        let Some(profile) = &self.profile else { return };
        if profile.class.is_empty() && profile.sky.textures.is_empty() {
            return;
        }
        let world = world_of(verdicts);
        for (facts, verdict) in evidence.draws.iter().zip(verdicts) {
            let found = profile.class_of(&evidence.subject(facts, images, verdict.class, world));
            // Without a camera nothing can be traced.
            let found = found.filter(|(class, _)| evidence.view.is_some() || !class.is_traced());
            if let Some((class, reason)) = found {
                *verdict = Verdict { reason, ..evidence.as_class(facts, *verdict, class) };
            }
        }
    }

    /// Whether lights that are found may be added to a scene.
    pub(crate) fn takes_found_lights(&self) -> bool {
        self.profile.as_ref().is_none_or(|profile| profile.lights.found != Found::Off)
    }

    /// Whether traced light takes the place of baked light, where a profile says so.
    pub(crate) fn replacing(&self) -> Option<Replacing> {
        self.profile.as_ref()?.lights.baked.map(|baked| match baked {
            Baked::Auto => Replacing::WhereGood,
            Baked::Keep => Replacing::Never,
            Baked::Replace => Replacing::Always,
        })
    }

    /// Overrides how much relit surfaces reflect at one another.
    pub(crate) fn relit(&self, scene: &mut Scene) {
        let bounce = self.profile.as_ref().and_then(|profile| profile.lights.bounce);
        if let (Some(relit), Some(bounce)) = (&mut scene.relit, bounce) {
            relit.bounce = bounce;
        }
    }

    /// Overrides camera, lights and sky.
    pub(crate) fn scene(&mut self, evidence: Evidence, images: &Images, scene: &mut Scene) {
        let Some(profile) = self.profile.clone() else { return };
        let world_before = self.world_before.take();
        if scene.camera.is_none() {
            return;
        }
        match profile.camera_of(evidence, images, &scene.verdicts) {
            Some((CameraKind::None, _)) => return rasterize(scene),
            Some((CameraKind::View, eye)) => {
                let change = evidence.view.map(|view| matrix::rigid_inverse(rigid(eye)) * view);
                if let Some(change) = change.filter(|change| matrix::is_sound(*change)) {
                    move_world(scene, change, world_before);
                    self.world_before = Some(change);
                }
            }
            None => {}
        }
        profile.light(scene);
    }
}

impl Profile {
    /// Class and reason of a draw, by the first rule that is for it.
    fn class_of(&self, subject: &Subject) -> Option<(Class, &'static str)> {
        let rule = self.class.iter().find(|rule| rule.condition().holds(subject));
        let sky = || subject.has_texture(&self.sky.textures).then_some((Class::Sky, "the profile's sky"));
        rule.map(|rule| (rule.is.class(), rule.why.0)).or_else(sky)
    }

    /// What the first camera rule says that is for any draw, and that draw's way from object to eye space.
    fn camera_of(
        &self,
        evidence: Evidence,
        images: &Images,
        verdicts: &[Verdict],
    ) -> Option<(CameraKind, DMat4)> {
        let world = world_of(verdicts);
        self.camera.iter().find_map(|rule| {
            let mut draws = evidence.draws.iter().zip(verdicts);
            let (facts, _) = draws.find(|(facts, verdict)| {
                rule.condition().holds(&evidence.subject(facts, images, verdict.class, world))
            })?;
            Some((rule.is, evidence.transforms[facts.transform].eye))
        })
    }

    /// Adds lights and the sky's colour.
    fn light(&self, scene: &mut Scene) {
        if self.lights.found == Found::Off {
            scene.lights.clear();
        }
        if !self.light.is_empty() {
            scene.lights.retain(|light| light.origin != LightOrigin::Fallback);
            let metre = self.units_per_metre.unwrap_or(1.0);
            // The heaviest come first.
            scene.lights.splice(0..0, self.light.iter().map(|light| light.light(metre)));
        }
        if self.lights.found == Found::Off || !self.light.is_empty() {
            scene.baked = scene.lights.is_empty();
        }
        scene.ambient += self.lights.ambient.unwrap_or(Vec3::ZERO);
        if let Some(color) = self.sky.color {
            scene.sky = color;
            scene.painted_sky = None;
        }
    }
}

impl<'a> Evidence<'a> {
    fn subject(
        &self,
        facts: &'a DrawFacts<'a>,
        images: &'a Images,
        class: Class,
        world: Option<(u32, u32)>,
    ) -> Subject<'a> {
        let transform = &self.transforms[facts.transform];
        Subject {
            frame: self.frame,
            images,
            facts,
            is_perspective: transform.perspective.is_some(),
            order: match world {
                Some((_, last)) if facts.operation > last => Order::Late,
                Some((first, _)) if facts.operation >= first => Order::Amid,
                _ => Order::Early,
            },
            matrix: matrix_kind(transform, self.view),
            class,
        }
    }

    /// A verdict as it is when a draw has another class.
    fn as_class(&self, facts: &DrawFacts, verdict: Verdict, class: Class) -> Verdict {
        let model = || {
            let eye = self.transforms[facts.transform].eye;
            let model = self.view.map(|view| matrix::rigid_inverse(view) * eye);
            model.filter(|model| matrix::is_sound(*model)).map_or(Mat4::IDENTITY, |model| model.as_mat4())
        };
        match (verdict.class.is_traced(), class.is_traced()) {
            (true, true) => Verdict { class, ..verdict },
            (false, true) => Verdict { class, model: model(), base: None, ..verdict },
            (_, false) => {
                let base = verdict.base.filter(|_| class == Class::Layer);
                Verdict { class, model: Mat4::IDENTITY, previous: None, baked: false, base, ..verdict }
            }
        }
    }
}

/// First and last operation of what is traced.
fn world_of(verdicts: &[Verdict]) -> Option<(u32, u32)> {
    let mut traced = verdicts.iter().filter(|v| v.class.is_traced() && v.class != Class::ViewModel);
    let first = traced.next()?.operation;
    Some((first, traced.next_back().map_or(first, |last| last.operation)))
}

fn matrix_kind(transform: &TransformFacts, view: Option<DMat4>) -> MatrixKind {
    let turn = |m: DMat4| DMat3::from_mat4(matrix::orthonormal(m));
    let place = |m: DMat4| m.col(3).truncate();
    let near = |a: DVec3, b: DVec3| a.distance(b) <= SAME_PLACE * a.length().max(b.length()).max(1e-3);
    let eye = transform.eye;
    if let Some(view) = view.filter(|_| matrix::similarity(eye).is_some())
        && turn(eye).abs_diff_eq(turn(view), SAME_TURN)
    {
        if near(place(eye), place(view)) {
            return MatrixKind::View;
        }
        if place(eye).length() <= SAME_PLACE * place(view).length() {
            return MatrixKind::Turned;
        }
    }
    if transform.modelview == DMat4::IDENTITY { MatrixKind::Identity } else { MatrixKind::Own }
}

fn rigid(eye: DMat4) -> DMat4 {
    matrix::similarity(eye).map_or_else(|| matrix::orthonormal(eye), |found| found.rigid)
}

/// Leaves a scene without a world.
fn rasterize(scene: &mut Scene) {
    let verdicts = std::mem::take(&mut scene.verdicts);
    *scene = Scene { verdicts, ..Scene::default() };
}

/// Moves a scene to another world. Where the frame before had none of its own, where things were is not known.
fn move_world(scene: &mut Scene, change: DMat4, before: Option<DMat4>) {
    if let Some(camera) = &mut scene.camera {
        camera.view *= matrix::rigid_inverse(change);
    }
    let moved = |by: DMat4, model: Mat4| (by * model.as_dmat4()).as_mat4();
    for verdict in scene.verdicts.iter_mut().filter(|verdict| verdict.class.is_traced()) {
        verdict.model = moved(change, verdict.model);
        verdict.previous = before.and_then(|before| Some(moved(before, verdict.previous?)));
    }
    for light in &mut scene.lights {
        move_light(light, change);
    }
}

fn move_light(light: &mut SceneLight, change: DMat4) {
    let turned = |direction: Vec3| change.transform_vector3(direction.as_dvec3()).as_vec3();
    match &mut light.shape {
        LightShape::Directional { to_light, .. } => *to_light = turned(*to_light),
        LightShape::Point { position, spot, .. } => {
            *position = change.transform_point3(position.as_dvec3()).as_vec3();
            *spot = spot.map(|(axis, cutoff, exponent)| (turned(axis), cutoff, exponent));
        }
    }
}
