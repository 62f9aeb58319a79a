//! Recovery: what is kept from frame to frame, and the steps from a frame to its scene.

use std::sync::Arc;

use afterglow_gl::frame::{Frame, ImageKey, Rect};
use glam::{DMat3, DMat4, Vec3};

use crate::baked::BakedLight;
use crate::classify::classify;
use crate::draws::{self, DrawFacts, TransformFacts};
use crate::geometry::ContentCache;
use crate::hints;
use crate::images::{ImageFacts, Images};
use crate::lights::{self, Lighting};
use crate::memory::{Memory, MemoryCounts};
use crate::phase::Phase;
use crate::profile::{Evidence, Overrides, Profile};
use crate::program_cache::ProgramCache;
use crate::shapes::Shapes;
use crate::shown::shown;
use crate::sky;
use crate::tracking::{Track, Tracker};
use crate::types::{Camera, Class, Deformed, Relighting, Replacing, Scene, Verdict};
use crate::views::Views;
use crate::world::World;

/// Sky of worlds in which nothing shines, linear RGB.
const FALLBACK_SKY: Vec3 = Vec3::new(0.25, 0.3, 0.38);
/// Share of lit triangles from which a world has lights of its own.
const LEAST_LIT: f32 = 0.1;

/// Frames of a world with lights, or without, that it takes to change what it is lit by.
const DAYLIGHT_FRAMES: i32 = 90;

/// Whether a world has lights of its own: a shot in the dark is none, and one frame without is no dusk.
#[derive(Debug, Default)]
struct Daylight {
    epoch: Option<u64>,
    /// Positive where lights were seen more often of late, at most [`DAYLIGHT_FRAMES`] either way.
    balance: i32,
}

impl Daylight {
    /// Whether a light must be made up.
    fn is_needed(&mut self, has_lights: bool, epoch: u64) -> bool {
        let step = if has_lights { 1 } else { -1 };
        if self.epoch.replace(epoch) != Some(epoch) {
            self.balance = step * DAYLIGHT_FRAMES;
        }
        self.balance = (self.balance + step).clamp(-DAYLIGHT_FRAMES, DAYLIGHT_FRAMES);
        self.balance < 0
    }
}

/// Understands the frames of one context, in order.
#[derive(Debug, Default)]
pub struct Recovery {
    images: Images,
    cache: ContentCache,
    shapes: Shapes,
    tracker: Tracker,
    up: Option<Vec3>,
    daylight: Daylight,
    /// The viewport that the world was drawn to.
    viewport: Option<Rect>,
    said: hints::Places,
    overrides: Overrides,
    baked: BakedLight,
    memory: Memory,
}

impl Recovery {
    /// A recovery that has seen nothing.
    pub fn new() -> Recovery {
        Recovery::default()
    }

    /// A recovery whose findings a profile overrides.
    pub fn with_profile(profile: Option<Arc<Profile>>) -> Recovery {
        let mut recovery = Recovery::default();
        recovery.overrides = Overrides::new(profile);
        recovery
    }

    /// Remembers so many bytes of the world that is not drawn, from now on; nothing of it with 0.
    pub fn set_memory(&mut self, bytes: u64) {
        self.memory.set_limit(bytes);
    }

    /// Keeps what is remembered, and the sources of baked light, in files for the next run of the program; what they
    /// hold is used where the program draws the same world again. A file that cannot be read counts as empty.
    pub fn set_cache(&mut self, cache: &ProgramCache) {
        self.memory.set_cache(cache.worlds.clone());
        self.baked.set_cache(cache.lights.clone());
    }

    /// How much of the world is remembered.
    pub fn memory(&self) -> MemoryCounts {
        self.memory.counts()
    }

    /// The same, with light sources recovered from the world's baked light. A profile can decide otherwise whether they
    /// take its place.
    pub fn with_relighting(mut self, relighting: Relighting, replacing: Replacing) -> Recovery {
        self.baked = BakedLight::new(relighting, self.overrides.replacing().unwrap_or(replacing));
        self
    }

    /// Takes note of a frame's texture images. For frames that are not understood; cheap.
    pub fn observe(&mut self, frame: &Frame) {
        self.images.learn(frame);
        self.baked.learn_images(frame);
        self.memory.observe(frame);
        self.images.forget(frame);
        self.baked.forget_images(frame);
    }

    /// What is known of an image of the frames so far, unless it was dropped.
    pub fn image(&self, image: ImageKey) -> Option<&ImageFacts> {
        self.images.get(image)
    }

    /// The scene that a frame draws. Sees to the frame's images as well.
    pub fn understand(&mut self, frame: &mut Frame) -> Scene {
        self.understand_watched(frame, &mut |_| ())
    }

    /// As [`understand`](Self::understand), and says when each phase has ended, so that who watches can time them.
    pub fn understand_watched(&mut self, frame: &mut Frame, ended: &mut dyn FnMut(Phase)) -> Scene {
        self.images.learn(frame);
        self.baked.learn_images(frame);
        ended(Phase::Images);
        let mut scene = self.scene(frame, ended);
        hints::apply(frame, &mut scene, &mut self.said);
        ended(Phase::Light);
        if self.overrides.takes_found_lights() {
            self.baked.apply(frame, &mut scene, &self.images, self.tracker.epoch);
            self.overrides.relit(&mut scene);
        }
        ended(Phase::Baked);
        self.carry_memory(&scene);
        self.memory.remember(frame, &self.images, &mut scene);
        ended(Phase::Memory);
        self.images.forget(frame);
        self.baked.forget_images(frame);
        ended(Phase::Images);
        scene
    }

    /// The same world in other coordinates: what is remembered has its place in them, unless the program or a profile
    /// has given the scene coordinates of its own.
    fn carry_memory(&mut self, scene: &Scene) {
        let Some(change) = self.tracker.change.take() else { return };
        let is_own = scene.camera.is_none_or(|camera| Some(camera.view) != self.tracker.view());
        self.memory.carry_over(if is_own { DMat4::IDENTITY } else { change }, self.tracker.epoch);
    }

    fn scene(&mut self, frame: &mut Frame, ended: &mut dyn FnMut(Phase)) -> Scene {
        if self.tracker.objects.is_full() {
            let numbers = self.tracker.forget_unseen();
            self.shapes.renumber(&numbers);
        }
        let transforms = draws::transforms(frame);
        let foresight = self.tracker.foresight(&transforms);
        let objects = &mut self.tracker.objects;
        let pieces = self.shapes.cut(frame, &self.images, objects, foresight, draws::may_be_solid);
        ended(Phase::Shapes);
        let frame = &*frame;
        let views = Views::split(frame);
        let draws = draws::draws(frame, &views, &pieces, &self.images, &mut self.cache);
        ended(Phase::Facts);
        let world = World::find(frame, &views, &draws, &transforms, self.viewport);
        ended(Phase::World);
        let Some(mut world) = world else {
            let mut scene = flat_scene(&draws);
            let evidence = Evidence { frame, draws: &draws, transforms: &transforms, view: None };
            self.overrides.classes(evidence, &self.images, &mut scene.verdicts);
            return scene;
        };
        self.viewport = Some(views.views[world.place].rect);
        let tracks = self.tracker.follow(&draws, &pieces, &transforms, &mut world);
        ended(Phase::Follow);
        let shown = shown(&views, &draws, &pieces, &transforms, &self.tracker);
        let mut verdicts =
            classify(frame, &transforms, &views, &world, &draws, &tracks, shown, &mut self.cache);
        let evidence = Evidence { frame, draws: &draws, transforms: &transforms, view: Some(world.view) };
        self.overrides.classes(evidence, &self.images, &mut verdicts);
        ended(Phase::Classify);
        let background = views.views[world.place].background;
        let deformed = deformed(&draws, &verdicts, tracks);
        let lit = self.light(frame, &world, &draws, &transforms, verdicts, background);
        let mut scene = Scene { deformed, ..lit };
        self.overrides.scene(evidence, &self.images, &mut scene);
        scene
    }

    fn light(
        &mut self,
        frame: &Frame,
        world: &World,
        draws: &[DrawFacts],
        transforms: &[TransformFacts],
        verdicts: Vec<Verdict>,
        background: Option<[f32; 4]>,
    ) -> Scene {
        let centre = world.world_from_eye().transform_point3(world.centre);
        let of_world = draws.iter().zip(&verdicts).filter(|(_, v)| is_world(v)).map(|(d, _)| d);
        let Lighting { mut lights, ambient, lit_share } =
            lights::gather(frame, of_world, world.world_from_modelview(), centre, world.extent);
        if lit_share < LEAST_LIT {
            lights.clear();
        }
        let baked = lights.is_empty() && baked_share(&verdicts) > 0.5;
        let mut sky =
            sky::color(frame, draws, transforms, &verdicts, &self.images, background).unwrap_or(Vec3::ZERO);
        let mut painted_sky = sky::painted(draws, transforms, &verdicts, background, sky);
        let up = self.up(world);
        if self.daylight.is_needed(!lights.is_empty(), self.tracker.epoch) && !baked {
            lights.push(lights::fallback_sun(up));
            let least = FALLBACK_SKY * 0.5;
            sky = sky.max(least);
            painted_sky.iter_mut().for_each(|painted| painted.least = least);
        }
        Scene {
            camera: Some(Camera { view: world.view, projection: world.perspective.projection.as_mat4() }),
            verdicts,
            deformed: Vec::new(),
            lights,
            sky,
            painted_sky,
            ambient,
            baked,
            relight: None,
            relit: None,
            cut: false,
            epoch: self.tracker.epoch,
            unseen: Vec::new(),
            covered: Vec::new(),
        }
    }

    /// The axis of the world that points most upward on screen, kept until another clearly does.
    fn up(&mut self, world: &World) -> Vec3 {
        let world_from_eye = DMat3::from_mat4(world.view).transpose();
        let upward = (world_from_eye * world.perspective.upward()).as_vec3();
        let axis = nearest_axis(upward);
        let kept = self.up.filter(|up| up.dot(upward) > 0.2);
        *self.up.insert(kept.unwrap_or(axis))
    }
}

/// What is remembered is written, if it is kept in a file.
impl Drop for Recovery {
    fn drop(&mut self) {
        self.memory.save(&self.images);
        self.memory.finish();
    }
}

/// Where the corners of animated draws were.
fn deformed(draws: &[DrawFacts], verdicts: &[Verdict], tracks: Vec<Option<Track>>) -> Vec<Deformed> {
    let traced = draws.iter().zip(verdicts).zip(tracks).filter(|((_, verdict), _)| verdict.class.is_traced());
    let moved = traced.filter_map(|((facts, verdict), track)| {
        let positions = track?.animated?;
        let is_whole = positions.len() == facts.draw.index_count as usize;
        is_whole.then_some(Deformed { operation: verdict.operation, positions })
    });
    moved.collect()
}

fn nearest_axis(direction: Vec3) -> Vec3 {
    let size = direction.abs();
    let along = Vec3::AXES.into_iter().find(|a| size.dot(*a) >= size.max_element());
    let axis = along.unwrap_or(Vec3::Y);
    axis * direction.dot(axis).signum()
}

fn is_world(verdict: &Verdict) -> bool {
    matches!(verdict.class, Class::Static | Class::Movable | Class::Dynamic)
}

/// Share of the world's triangles whose colours are baked light.
fn baked_share(verdicts: &[Verdict]) -> f64 {
    let count = |keep: &dyn Fn(&&Verdict) -> bool| -> u64 {
        verdicts.iter().filter(|v| is_world(v)).filter(keep).map(|v| u64::from(v.triangles)).sum()
    };
    count(&|v| v.baked) as f64 / count(&|_| true).max(1) as f64
}

/// A frame without a world: everything is drawn as it is.
fn flat_scene(draws: &[DrawFacts]) -> Scene {
    let verdict = |facts: &DrawFacts| Verdict {
        operation: facts.operation,
        class: Class::Interface,
        reason: "no world in this frame",
        model: glam::Mat4::IDENTITY,
        object: 0,
        previous: None,
        baked: false,
        triangles: facts.triangles,
        base: None,
    };
    Scene { verdicts: draws.iter().map(verdict).collect(), ..Scene::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a light was needed in each of so many frames.
    fn frames(daylight: &mut Daylight, has_lights: bool, count: i32) -> Vec<bool> {
        (0..count).map(|_| daylight.is_needed(has_lights, 1)).collect()
    }

    #[test]
    fn the_first_frame_of_a_world_says_whether_a_light_is_needed() {
        let mut daylight = Daylight::default();
        assert!(daylight.is_needed(false, 0));
        assert!(!daylight.is_needed(true, 1));
        assert!(daylight.is_needed(false, 2));
    }

    #[test]
    fn a_few_dark_frames_are_no_dusk_and_a_flash_is_no_dawn() {
        let mut daylight = Daylight::default();
        frames(&mut daylight, true, 5);
        assert!(!frames(&mut daylight, false, DAYLIGHT_FRAMES - 1).contains(&true));
        assert!(!frames(&mut daylight, true, 1).contains(&true));
        let mut dark = Daylight::default();
        frames(&mut dark, false, 5);
        assert!(!frames(&mut dark, true, DAYLIGHT_FRAMES - 1).contains(&false));
    }

    #[test]
    fn lights_that_stay_away_are_made_up_for_once() {
        let mut daylight = Daylight::default();
        frames(&mut daylight, true, 5);
        let needed = frames(&mut daylight, false, 3 * DAYLIGHT_FRAMES);
        let from = needed.iter().position(|needed| *needed).unwrap();
        assert_eq!(from as i32, DAYLIGHT_FRAMES);
        assert!(needed[from..].iter().all(|needed| *needed), "it changes once");
        // Nor does it flicker where lights come and go with every frame.
        let flicker: Vec<bool> = (0..400).map(|i| daylight.is_needed(i % 2 == 0, 1)).collect();
        assert!(flicker.iter().all(|needed| *needed));
    }
}
