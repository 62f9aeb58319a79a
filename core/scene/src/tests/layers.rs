//! Surfaces drawn in several passes, and baked light.

use afterglow_gl::frame::{BaseFormat, BlendFactor, Compare};
use glam::{Mat4, Vec3};

use crate::Recovery;
use crate::testing::{Sketch, class, floor, thing, verdict};
use crate::types::Class;

const MULTIPLY: Option<(BlendFactor, BlendFactor)> = Some((BlendFactor::DestinationColor, BlendFactor::Zero));
const ADD: Option<(BlendFactor, BlendFactor)> = Some((BlendFactor::One, BlendFactor::One));

fn room() -> (Sketch, usize) {
    let mut sketch = Sketch::new();
    sketch.modelview = Mat4::from_translation(Vec3::new(0.0, -2.0, -5.0));
    sketch.texture(0, BaseFormat::Rgb, &[[128, 128, 128, 255]; 2]);
    let base = sketch.world();
    sketch.depth(Some((Compare::LessEqual, false)));
    (sketch, base)
}

#[test]
fn a_lightmap_pass_is_a_layer_of_its_surface() {
    let (mut sketch, base) = room();
    sketch.blend(MULTIPLY);
    let lightmap = sketch.world();
    sketch.blend(ADD);
    let glow = sketch.world();
    let flare = sketch.draw(&thing(1.0));
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!((class(&scene, lightmap), class(&scene, glow)), (Class::Layer, Class::Layer));
    assert_eq!(verdict(&scene, lightmap).base, Some(base as u32));
    assert_eq!(class(&scene, flare), Class::Translucent);
    assert!(verdict(&scene, base).baked && scene.baked && scene.lights.is_empty());
}

#[test]
fn a_layer_is_found_in_other_batches_but_not_under_another_matrix() {
    let (mut sketch, _) = room();
    sketch.blend(MULTIPLY);
    let mut half: Vec<Vec3> = floor()[15..45].to_vec();
    half[..3].rotate_left(1);
    let lightmap = sketch.draw(&half);
    sketch.modelview *= Mat4::from_translation(Vec3::Y);
    let elsewhere = sketch.draw(&half);
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!((class(&scene, lightmap), class(&scene, elsewhere)), (Class::Layer, Class::Translucent));
}

#[test]
fn stains_are_layers() {
    let (mut sketch, base) = room();
    sketch.blend(MULTIPLY);
    sketch.fixed.raster.depth_bias = Some(((-1.0).into(), (-2.0).into()));
    let stain = sketch.draw(&thing(1.0));
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!(class(&scene, stain), Class::Layer);
    assert!(!verdict(&scene, base).baked && !scene.baked);
}

#[test]
fn a_second_texture_or_varying_colours_are_baked_light_unless_lit() {
    let mut sketch = Sketch::new();
    sketch.modelview = Mat4::from_translation(Vec3::new(0.0, -2.0, -5.0));
    sketch.texture(0, BaseFormat::Rgb, &[[200; 4]; 2]);
    let plain = sketch.world();
    let colors: Vec<_> = (0..60).map(|i| [i as f32 / 60.0, 0.5, 0.5, 1.0]).collect();
    let colored = sketch.draw_with(&floor(), Some(&colors));
    sketch.texture(1, BaseFormat::Rgb, &[[100; 4]; 2]);
    let lightmapped = sketch.world();
    sketch.light([0.0, 1.0, 0.0, 0.0], [1.0; 4]);
    let lit = sketch.draw_with(&floor(), Some(&colors));
    let scene = Recovery::new().understand(&mut sketch.frame);
    let baked = [plain, colored, lightmapped, lit].map(|operation| verdict(&scene, operation).baked);
    assert_eq!(baked, [false, true, true, false]);
    assert!(!scene.baked, "a quarter of the world is lit by a light of its own");
}
