//! Whatever a frame holds, understanding it neither fails nor yields what is not a number.

use afterglow_gl::frame::{BlendFactor, Compare, Hint, HintClass, HintLight, HintLightShape};
use glam::{Mat4, Vec3};
use proptest::prelude::*;

use crate::Recovery;
use crate::testing::Sketch;
use crate::types::LightShape;

fn element() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => -3.0f32..3.0,
        2 => Just(0.0),
        1 => Just(1.0),
        1 => any::<f32>(),
    ]
}

fn matrix() -> impl Strategy<Value = Mat4> {
    prop::array::uniform16(element()).prop_map(|m| Mat4::from_cols_array(&m))
}

proptest! {
    #[test]
    fn whatever_is_said_is_survived(
        draws in prop::collection::vec((matrix(), any::<bool>(), 0usize..4), 1..6),
        view in matrix(),
        light in prop::array::uniform3(-1e38f32..1e38),
        color in prop::array::uniform3(0.0f32..f32::MAX),
    ) {
        let mut sketch = Sketch::new();
        for (modelview, ordinary, class) in draws {
            sketch.modelview = modelview;
            sketch.projection = if ordinary { crate::testing::perspective() } else { view };
            let class = [HintClass::Static, HintClass::ViewModel, HintClass::Layer, HintClass::Dynamic][class];
            sketch.frame.hints.push(Hint { class: Some(class), ..Hint::default() });
            sketch.hint = sketch.frame.hints.len() as u32;
            sketch.world();
        }
        sketch.frame.scene_hints.view = Some(view.to_cols_array_2d());
        let shape = HintLightShape::Point { position: light, radius: 0.0 };
        sketch.frame.scene_hints.lights = vec![HintLight { id: 1, shape, color }; 40];
        let scene = Recovery::new().understand(&mut sketch.frame);
        prop_assert!(scene.camera.is_none_or(|camera| camera.view.is_finite() && camera.projection.is_finite()));
        for verdict in &scene.verdicts {
            prop_assert!(!verdict.class.is_traced() || verdict.model.is_finite());
        }
        prop_assert!(scene.lights.iter().all(|light| light.color.is_finite()));
    }


    #[test]
    fn any_matrices_and_vertices_are_survived(
        draws in prop::collection::vec((matrix(), matrix(), 0usize..4, any::<bool>(), 0.0f32..2.0), 1..8),
        corners in prop::collection::vec(prop::array::uniform3(element()), 12),
    ) {
        let corners: Vec<Vec3> = corners.into_iter().map(Vec3::from_array).collect();
        let mut sketch = Sketch::new();
        for (modelview, projection, state, ordinary, w) in draws {
            sketch.modelview = modelview;
            sketch.projection = if ordinary { crate::testing::perspective() } else { projection };
            sketch.depth([None, Some((Compare::Less, true)), Some((Compare::Equal, false)), Some((Compare::Always, true))][state]);
            sketch.blend([None, Some((BlendFactor::SourceAlpha, BlendFactor::OneMinusSourceAlpha))][state & 1]);
            sketch.light([modelview.x_axis.x, 1.0, 0.0, w], [1.0; 4]);
            sketch.draw(&corners);
        }
        let scene = Recovery::new().understand(&mut sketch.frame);
        prop_assert_eq!(scene.verdicts.len(), sketch.frame.operations.len());
        prop_assert!(scene.sky.is_finite());
        if let Some(camera) = scene.camera {
            prop_assert!(camera.view.is_finite() && camera.projection.is_finite());
        }
        for verdict in &scene.verdicts {
            prop_assert!(!verdict.class.is_traced() || verdict.model.is_finite());
        }
        for light in &scene.lights {
            let is_sound = match light.shape {
                LightShape::Directional { to_light, .. } => to_light.is_normalized(),
                LightShape::Point { position, radius, .. } => position.is_finite() && radius > 0.0,
            };
            prop_assert!(is_sound, "{:?}", light);
        }
    }
}
