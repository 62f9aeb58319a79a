//! Projections that are unusual, or none.

use afterglow_extremes::{Picture, Shot, World, pathtrace, reference, staged};
use afterglow_render::Mode;
use glam::{DMat4, DVec3, Mat4, Vec3};

use crate::closed_forms::room;

fn both(world: &World, samples: u32) -> [Picture; 2] {
    [reference(world, &Shot::of(samples)), pathtrace(world, &Shot::of(samples))]
}

/// Fails unless pictures of both modes agree. That of `pathtrace` does not know its error.
#[track_caller]
pub(crate) fn assert_alike(pictures: &[Picture; 2], expected: &[Picture; 2], what: &str) {
    for ((picture, expected), rounding) in pictures.iter().zip(expected).zip([2e-3, 0.1]) {
        picture.assert_sound(what);
        picture.assert_same(expected, 8, rounding, what);
    }
}

fn with_projection(projection: DMat4) -> World {
    let mut world = room(16);
    world.file.view.projection = projection;
    world
}

/// Planes of the projection are no part of what rays see.
#[test]
fn near_and_far_planes() {
    let expected = both(&room(16), 64);
    let far = glam::dcamera::rh::proj::opengl::perspective(1.3, 1.0, 1e-3, 1e9);
    let mut infinite = far;
    (infinite.z_axis.z, infinite.w_axis.z) = (-1.0, -2e-3);
    for (name, projection) in [("far", far), ("infinite", infinite)] {
        assert_alike(&both(&with_projection(projection), 64), &expected, name);
    }
}

/// A frustum to one side sees what is there in the whole picture.
#[test]
fn frustum_to_one_side() {
    let whole = reference(&room(16), &Shot::of(128));
    let right =
        DMat4::from_translation(DVec3::new(-1.0, 0.0, 0.0)) * DMat4::from_scale(DVec3::new(2.0, 1.0, 1.0));
    let mut world = with_projection(right * room(16).file.view.projection);
    world.file.size = [8, 16];
    let picture = reference(&world, &Shot::of(128).with(|options| options.seed = 1));
    picture.assert_sound("a frustum to one side");
    for y in 0..2 {
        let (own, theirs) = (picture.block([0, y * 8], [8, 8]), whole.block([8, y * 8], [8, 8]));
        assert!(own.agrees_with(theirs, 0.0), "{own:?}, {theirs:?}");
    }
}

/// The picture with left and right exchanged.
pub(crate) fn mirrored(picture: &Picture) -> Picture {
    let mut result = picture.clone();
    let width = picture.radiance.size[0] as usize;
    result.radiance.mean.chunks_mut(width).for_each(<[_]>::reverse);
    result.radiance.standard_error.chunks_mut(width).for_each(<[_]>::reverse);
    result
}

#[test]
fn mirrored_projection() {
    let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    let world = with_projection(mirror * room(16).file.view.projection);
    let pictures = both(&world, 96).map(|picture| mirrored(&picture));
    assert_alike(&pictures, &both(&room(16), 96), "a mirrored projection");
}

/// What is no perspective is rasterized, and the next frame is traced again.
#[test]
fn projections_that_are_none() {
    let world = room(16);
    let [zero, flat, lost] = [
        Mat4::ZERO,
        Mat4::from_scale(Vec3::new(1.0, 0.0, 1.0)) * world.file.view.projection.as_mat4(),
        Mat4::from_cols_array(&[f32::NAN; 16]),
    ];
    for projection in [zero, flat, lost] {
        for mode in [Mode::Reference, Mode::Pathtrace] {
            let (mut frame, mut scene) = staged(&world);
            if let Some(camera) = &mut scene.camera {
                camera.projection = projection;
            }
            for transform in &mut frame.transforms {
                let modelview = Mat4::from_cols_array_2d(&transform.modelview);
                transform.projection = projection.to_cols_array_2d();
                transform.modelview_projection = (projection * modelview).to_cols_array_2d();
            }
            let picture = Shot::of(4).render(mode, (frame, scene));
            assert!(picture.is_sound() && picture.non_finite == 0, "{projection}, {mode:?}");
            assert!(picture.radiance.mean.is_empty(), "{projection}, {mode:?}");
        }
    }
    reference(&world, &Shot::of(2)).assert_sound("afterwards");
}
