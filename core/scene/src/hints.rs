//! What the program says of its scene (GL_AFTERGLOW_scene_hints) takes the place of what was found by evidence.

use std::f32::consts::PI;

use afterglow_gl::frame::{
    Draw, Frame, Hint, HintClass, HintLight, HintLightShape, HintMaterial, Operation, Topology,
};
use glam::{DMat4, Mat4, Vec3};
use hashbrown::HashMap;

use crate::matrix::{self, Perspective};
use crate::types::{Camera, Class, LightOrigin, LightShape, Scene, SceneLight, Verdict};

/// Lights that are taken of those that a program says: each costs a ray a sample.
const MOST_LIGHTS: usize = 32;
/// Light of one component beyond which numbers of 32 bits could overflow.
const MOST_LIGHT: f32 = 1e9;
const REASON: &str = "the program says so";

/// Where objects were in the frame before, by the names that the program gives them: a model matrix for each draw, in
/// the world of the view that it said.
#[derive(Debug, Default)]
pub struct Places(HashMap<u64, Vec<Mat4>>);

/// Lets what the program says of a frame and its draws count more than what was found.
pub fn apply(frame: &Frame, scene: &mut Scene, places: &mut Places) {
    let before = std::mem::take(places);
    if frame.hints.is_empty() && frame.scene_hints.is_empty() {
        return;
    }
    for verdict in &mut scene.verdicts {
        if let Some((draw, hint)) = hinted(frame, verdict) {
            say(frame, draw, hint, verdict);
        }
    }
    match said_camera(frame, scene) {
        Some(camera) => {
            move_world(frame, scene, camera);
            follow(frame, scene, if frame.scene_hints.cut { Places::default() } else { before }, places);
            shine(frame, scene, &camera);
        }
        None => place(frame, scene, |verdict| verdict.reason == REASON),
    }
    if let Some(sky) = frame.scene_hints.sky {
        scene.sky = bounded(sky);
        scene.painted_sky = None;
    }
    scene.cut = frame.scene_hints.cut;
}

/// The draw of a verdict, if something is said of it.
fn hinted<'a>(frame: &'a Frame, verdict: &Verdict) -> Option<(&'a Draw, &'a Hint)> {
    let draw = draw_of(frame, verdict)?;
    frame.hint(draw).map(|hint| (draw, hint))
}

fn draw_of<'a>(frame: &'a Frame, verdict: &Verdict) -> Option<&'a Draw> {
    match frame.operations.get(verdict.operation as usize) {
        Some(Operation::Draw(draw)) => Some(draw),
        _ => None,
    }
}

fn say(frame: &Frame, draw: &Draw, hint: &Hint, verdict: &mut Verdict) {
    if hint.object != 0 {
        verdict.object = hint.object;
    }
    let class = hint.class.map(class_of).filter(|class| !class.is_traced() || can_be_traced(frame, draw));
    if let Some(class) = class {
        (verdict.class, verdict.reason) = (class, REASON);
        if !class.is_traced() {
            // What was found out of its place means nothing.
            (verdict.model, verdict.previous, verdict.object) = (Mat4::IDENTITY, None, hint.object);
        }
    }
    // Whoever says what a surface is made of means its colours as those of that material.
    if hint.material != HintMaterial::default() {
        verdict.baked = false;
    }
}

fn class_of(class: HintClass) -> Class {
    match class {
        HintClass::Static => Class::Static,
        HintClass::Movable => Class::Movable,
        HintClass::Dynamic => Class::Dynamic,
        HintClass::ViewModel => Class::ViewModel,
        HintClass::Translucent => Class::Translucent,
        HintClass::Sky => Class::Sky,
        HintClass::Interface => Class::Interface,
        HintClass::Layer => Class::Layer,
        HintClass::OtherView => Class::OtherView,
        HintClass::Dropped => Class::Dropped,
    }
}

/// Whether rays can meet a draw at all: triangles in perspective, under a matrix that has an inverse.
fn can_be_traced(frame: &Frame, draw: &Draw) -> bool {
    let modelview = modelview(frame, draw);
    draw.topology == Topology::Triangles
        && modelview.is_some_and(|matrix| matrix::is_sound(matrix) && !matrix::is_flattening(matrix))
        && perspective(frame, draw).is_some()
}

fn modelview(frame: &Frame, draw: &Draw) -> Option<DMat4> {
    let transform = frame.transforms.get(draw.transform as usize)?;
    Some(matrix::from_columns(&transform.modelview))
}

fn perspective(frame: &Frame, draw: &Draw) -> Option<Perspective> {
    let transform = frame.transforms.get(draw.transform as usize)?;
    matrix::factor_perspective(matrix::from_columns(&transform.projection))
}

/// The camera by the view that the program says. Its projection is that of most triangles of the world.
fn said_camera(frame: &Frame, scene: &Scene) -> Option<Camera> {
    let view = matrix::from_columns(&frame.scene_hints.view?);
    let rigid = matrix::similarity(view).map_or_else(|| matrix::orthonormal(view), |found| found.rigid);
    let perspective = world_projection(frame, scene)?;
    let camera = Camera { view: perspective.view * rigid, projection: perspective.projection.as_mat4() };
    matrix::is_sound(camera.view).then_some(camera)
}

/// The projection of most triangles of the world; of equals, the first.
fn world_projection(frame: &Frame, scene: &Scene) -> Option<Perspective> {
    let mut counts: Vec<(u64, &Draw)> = Vec::new();
    let is_world = |verdict: &&Verdict| verdict.class.is_traced() && verdict.class != Class::ViewModel;
    for verdict in scene.verdicts.iter().filter(is_world) {
        let Some(draw) = draw_of(frame, verdict) else { continue };
        let projection = |draw: &Draw| frame.transforms.get(draw.transform as usize).map(|t| t.projection);
        let triangles = u64::from(verdict.triangles);
        match counts.iter_mut().find(|(_, known)| projection(known) == projection(draw)) {
            Some((count, _)) => *count += triangles,
            None => counts.push((triangles, draw)),
        }
    }
    let most = counts.iter().rev().max_by_key(|(count, _)| *count)?;
    perspective(frame, most.1)
}

/// Gives a scene another camera, and all that is in the world its place under it.
fn move_world(frame: &Frame, scene: &mut Scene, camera: Camera) {
    if let Some(found) = scene.camera {
        let new_from_old = (matrix::rigid_inverse(camera.view) * found.view).as_mat4();
        for light in &mut scene.lights {
            moved(new_from_old, &mut light.shape);
        }
        for verdict in &mut scene.verdicts {
            verdict.previous = verdict.previous.map(|model| new_from_old * model);
        }
    }
    scene.camera = Some(camera);
    place(frame, scene, |_| true);
}

/// Tells of each draw of a named object where it was: the draws of an object come in the same order in each frame.
fn follow(frame: &Frame, scene: &mut Scene, before: Places, now: &mut Places) {
    for verdict in scene.verdicts.iter_mut().filter(|verdict| verdict.class.is_traced()) {
        let object = hinted(frame, verdict).map_or(0, |(_, hint)| hint.object);
        if object != 0 {
            let places = now.0.entry(object).or_default();
            verdict.previous = before.0.get(&object).and_then(|before| before.get(places.len())).copied();
            places.push(verdict.model);
        }
    }
}

/// Gives traced draws that `are_meant` their place under the scene's camera.
fn place(frame: &Frame, scene: &mut Scene, are_meant: impl Fn(&Verdict) -> bool) {
    let Some(camera) = scene.camera else { return };
    let world_from_eye = matrix::rigid_inverse(camera.view);
    for verdict in scene.verdicts.iter_mut().filter(|verdict| verdict.class.is_traced() && are_meant(verdict))
    {
        if let Some(model) = draw_of(frame, verdict).and_then(|draw| model(frame, draw, world_from_eye)) {
            verdict.model = model;
        }
    }
}

/// Object to world space; the identity, exactly, of what is drawn under the very view that the program says.
fn model(frame: &Frame, draw: &Draw, world_from_eye: DMat4) -> Option<Mat4> {
    let modelview = modelview(frame, draw)?;
    let is_view = frame.scene_hints.view.is_some_and(|view| matrix::from_columns(&view) == modelview);
    if is_view && matrix::similarity(modelview).is_some_and(|found| found.scale == 1.0) {
        return Some(Mat4::IDENTITY);
    }
    // What the program has put before its projection belongs to the view.
    let before = perspective(frame, draw).map_or(DMat4::IDENTITY, |perspective| perspective.view);
    Some((world_from_eye * before * modelview).as_mat4())
}

fn moved(transform: Mat4, shape: &mut LightShape) {
    match shape {
        LightShape::Directional { to_light, .. } => {
            *to_light = transform.transform_vector3(*to_light).normalize_or(*to_light);
        }
        LightShape::Point { position, spot, .. } => {
            *position = transform.transform_point3(*position);
            if let Some((axis, ..)) = spot {
                *axis = transform.transform_vector3(*axis).normalize_or(*axis);
            }
        }
    }
}

/// Takes the program's lights in place of those that were found: those that would be brightest at the camera.
fn shine(frame: &Frame, scene: &mut Scene, camera: &Camera) {
    let said = &frame.scene_hints.lights;
    if said.is_empty() {
        return;
    }
    let eye = camera.view.inverse().w_axis.truncate().as_vec3();
    let mut lights: Vec<SceneLight> = said.iter().map(light).collect();
    let brightness = |light: &SceneLight| match light.shape {
        LightShape::Directional { .. } => f32::INFINITY,
        LightShape::Point { position, radius, .. } => {
            light.color.element_sum() / position.distance_squared(eye).max(radius * radius).max(1e-6)
        }
    };
    if lights.len() > MOST_LIGHTS {
        lights.sort_by(|a, b| brightness(b).total_cmp(&brightness(a)));
        lights.truncate(MOST_LIGHTS);
    }
    scene.lights = lights;
    scene.baked = false;
}

fn light(said: &HintLight) -> SceneLight {
    let place = |position, radius, spot| LightShape::Point {
        position: Vec3::from_array(position),
        radius,
        attenuation: Vec3::Z,
        spot,
    };
    let shape = match said.shape {
        HintLightShape::Point { position, radius } => place(position, radius, None),
        HintLightShape::Spot { position, radius, direction, cutoff, exponent } => {
            let cone = (Vec3::from_array(direction), cutoff.to_radians().cos(), exponent);
            place(position, radius, Some(cone))
        }
        HintLightShape::Directional { direction, angle } => LightShape::Directional {
            to_light: -Vec3::from_array(direction),
            angular_radius: angle.to_radians() / 2.0,
        },
    };
    // What a facing white surface shows is irradiance over pi.
    SceneLight { shape, color: bounded(said.color) / PI, origin: LightOrigin::Program(said.id) }
}

fn bounded(light: [f32; 3]) -> Vec3 {
    Vec3::from_array(light).clamp(Vec3::ZERO, Vec3::splat(MOST_LIGHT))
}
