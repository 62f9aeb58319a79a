//! A recorded program that says all that GL_AFTERGLOW_scene_hints can say (`tests/hints`) is understood as it says.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

use std::path::Path;
use std::sync::{Arc, Mutex};

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::{Frame, HintMaterial};
use afterglow_player::{Player, TraceSummary};
use afterglow_scene::{Class, LightOrigin, LightShape, Recovery, Scene};
use afterglow_trace::TraceReader;
use glam::{DMat4, DVec3, Mat4, Vec3};

/// A scene, and what is said of the material of each draw.
type Understood = (Scene, Vec<HintMaterial>);

struct Understanding {
    recovery: Recovery,
    scenes: Arc<Mutex<Vec<Understood>>>,
}

impl Backend for Understanding {
    fn submit(&mut self, mut frame: Frame, end: End) {
        if end == End::Continued {
            return self.recovery.observe(&frame);
        }
        let scene = self.recovery.understand(&mut frame);
        let material = |(_, draw)| frame.hint(draw).map(|hint| hint.material).unwrap_or_default();
        self.scenes.lock().unwrap().push((scene, frame.draws().map(material).collect()));
    }

    fn answer(&mut self, so_far: Frame, _: Request) -> Reply {
        self.recovery.observe(&so_far);
        Reply::Unavailable
    }
}

fn scenes() -> Vec<Understood> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/hints.trace");
    let scenes = Arc::new(Mutex::new(Vec::new()));
    let shared = scenes.clone();
    let factory = move |_| -> Box<dyn Backend> {
        Box::new(Understanding { recovery: Recovery::new(), scenes: shared.clone() })
    };
    let sizes = TraceSummary::open(&path).unwrap().sizes();
    let mut player = Player::new(TraceReader::open(&path).unwrap(), sizes, Box::new(factory));
    while player.next_frame().is_some() {}
    std::mem::take(&mut *scenes.lock().unwrap())
}

#[test]
fn everything_is_as_the_program_says() {
    let scenes = scenes();
    assert_eq!(scenes.len(), 4);
    for (number, (scene, materials)) in scenes.iter().enumerate() {
        let said: Vec<_> = scene.verdicts.iter().map(|verdict| (verdict.class, verdict.object)).collect();
        assert_eq!(
            said,
            [
                (Class::Sky, 0),
                (Class::Static, 101),
                (Class::Movable, 102),
                (Class::Dynamic, 103),
                (Class::Static, 0x0123_4567_89ab_cdef),
                (Class::Layer, 0),
                (Class::Dropped, 0),
                (Class::Translucent, 0),
                (Class::OtherView, 0),
                (Class::ViewModel, 104),
                (Class::Interface, 0),
            ]
        );
        assert!(scene.verdicts.iter().all(|verdict| verdict.reason == "the program says so"));
        let crate_at = Mat4::from_translation(Vec3::new(0.2 * number as f32, 1.0, 0.0));
        assert!(scene.verdicts[2].model.abs_diff_eq(crate_at, 1e-5), "{}", scene.verdicts[2].model);
        assert_eq!(materials[1].roughness_metallic, Some([0.4, 0.0]));
        let lamp = &materials[4];
        assert_eq!((lamp.roughness_metallic, lamp.emission), (Some([1.0, 1.0]), Some([4.0, 3.0, 1.0])));
        assert!(
            lamp.normal_map.is_some() && lamp.metallic_roughness_map.is_some() && lamp.emission_map.is_some()
        );
        assert_eq!(scene.cut, number == 0);
    }
}

#[test]
fn camera_lights_and_sky_are_as_the_program_says() {
    for (scene, _) in scenes() {
        let view =
            DMat4::from_rotation_x(25f64.to_radians()) * DMat4::from_translation(DVec3::new(0.0, -3.0, -7.0));
        assert!(scene.camera.unwrap().view.abs_diff_eq(view, 1e-5));
        let origins: Vec<_> = scene.lights.iter().map(|light| light.origin).collect();
        assert_eq!(origins, [7, 8, 9].map(LightOrigin::Program));
        let place = |light: usize| match scene.lights[light].shape {
            LightShape::Point { position, radius, spot, .. } => (position, radius, spot.is_some()),
            LightShape::Directional { .. } => panic!("light {light} has no place"),
        };
        assert_eq!(place(0), (Vec3::new(1.0, 3.0, 0.0), 0.1, false));
        assert_eq!(place(1), (Vec3::new(-3.0, 3.0, 1.0), 0.1, true));
        let pi = std::f32::consts::PI;
        assert!((scene.lights[0].color * pi).abs_diff_eq(Vec3::new(40.0, 36.0, 30.0), 1e-4));
        let LightShape::Directional { to_light, .. } = scene.lights[2].shape else { panic!() };
        assert!(to_light.abs_diff_eq(Vec3::new(-1.0, 2.0, 1.0).normalize(), 1e-6));
        assert_eq!(scene.sky, Vec3::new(0.05, 0.06, 0.08));
    }
}
