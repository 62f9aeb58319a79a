//! Projections that are unusual, or none.

use afterglow_extremes::{Picture, Shot, World, pathtrace, quad, reference, shining, staged};
use afterglow_render::{Mode, Target};
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

/// Without anything to be drawn there are the sky and its lights.
#[test]
fn nothing_but_the_sky() {
    let world = World::new(8).sky(0.7);
    let picture = reference(&world, &Shot::of(2));
    picture.assert_sound("the sky");
    picture.whole().assert(0.7, 1e-6, "the sky");
    let sun = world.sun(DVec3::new(0.3, 0.2, -1.0), 1.5, 2.0);
    reference(&sun, &Shot::of(16)).assert_sound("a huge sun");
    pathtrace(&sun, &Shot::of(1)).assert_sound("a huge sun");
    reference(&room(16), &Shot::of(2)).assert_sound("afterwards");
}

/// What is no projection is rasterized, and the next frame is traced again.
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

/// Pixels of an orthographic projection look side by side, as far apart as they are in the picture, from near or behind.
#[test]
fn orthographic_projections() {
    let ahead =
        |near: f64, far: f64| glam::dcamera::rh::proj::opengl::orthographic(-1.0, 1.0, -1.0, 1.0, near, far);
    // A square that is half of the picture wide and high, and one that is hidden behind it.
    let square =
        |z: f32, half: f32| quad(Vec3::new(-half, -half, z), Vec3::X * 2.0 * half, Vec3::Y * 2.0 * half);
    for (near, far, z) in [(0.1, 100.0, -5.0), (0.1, 1e9, -1e4), (-10.0, 10.0, 3.0), (1e-3, 1.0, -0.5)] {
        let mut world = World::new(16)
            .sky(0.25)
            .with(square(z, 0.5), shining(2.0, 0.0))
            .with(square(z * 1.1 - 1.0, 0.5), shining(9.0, 0.0));
        world.file.view.projection = ahead(near, far);
        let what = format!("near {near}, far {far}, square at {z}");
        let picture = reference(&world, &Shot::of(4));
        picture.assert_sound(&what);
        picture.middle().assert(2.0, 1e-5, &what);
        for outside in [[0, 0], [12, 0], [0, 12], [12, 12]] {
            picture.block(outside, [4, 4]).assert(0.25, 1e-5, &what);
        }
        pathtrace(&world, &Shot::of(4)).assert_sound(&what);
    }
}

/// What an orthographic camera sees is lit as anything else, in both modes.
#[test]
fn orthographic_rooms() {
    let parallel = |eye: DVec3, size: f64| {
        let mut world = room(16).seen_from(eye, DVec3::new(-0.2, -0.3, -0.6), 1.0);
        world.file.view.projection =
            glam::dcamera::rh::proj::opengl::orthographic(-size, size, -size, size, 0.01, 10.0);
        world
    };
    let world = parallel(DVec3::new(0.2, 0.1, 0.5), 0.4);
    let pictures = [
        reference(&world, &Shot::of(96).with(|options| options.target = Target::Bounce1)),
        pathtrace(&world, &Shot::of(96)),
    ];
    // A camera so far away that its rays are all but parallel, and that sees what is behind the same near plane.
    let middle = DVec3::new(-0.2, -0.3, -0.6);
    let towards = DVec3::new(0.2, 0.1, 0.5) - middle;
    let mut far = room(16).seen_from(middle + towards * 1e3, middle, 1.0);
    let distance = towards.length() * 1e3;
    let angle = 2.0 * (0.4 / distance).atan();
    far.file.view.projection =
        glam::dcamera::rh::proj::opengl::perspective(angle, 1.0, distance - towards.length(), 1e9);
    let seen = pathtrace(&far, &Shot::of(96));
    pictures[0].assert_sound("an orthographic room");
    pictures[1].assert_sound("an orthographic room");
    pictures[1].assert_same(&pictures[0], 8, 0.1, "an orthographic room");
    pictures[1].assert_same(&seen, 8, 0.05, "from afar");
}
