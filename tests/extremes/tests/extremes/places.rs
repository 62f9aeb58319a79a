//! The same scene far away, very large or very small; rays that must not meet what they start from.

use afterglow_extremes::{Shot, World, cube, lambert, pathtrace, quad, reference, shining};
use afterglow_render::Target;
use glam::{DVec3, Vec3};

use crate::closed_forms::room;

/// Scenes far from the world's origin are as good as their vertices.
#[test]
fn far_from_the_origin() {
    // Corners are whole numbers at this scale, so that nothing of them is lost.
    let near = room(24).moved(DVec3::ZERO, 160.0);
    let expected = reference(&near, &Shot::of(64));
    for away in [1e5, 1e6] {
        let far = room(24).moved(DVec3::new(away, -away, away), 160.0);
        let picture = reference(&far, &Shot::of(64).with(|options| options.seed = 1));
        picture.assert_sound(&format!("{away} away"));
        picture.assert_same(&expected, 8, 2e-3, &format!("{away} away"));
        pathtrace(&far, &Shot::of(1)).assert_sound(&format!("{away} away"));
    }
}

/// There is no length that means anything by itself.
#[test]
fn any_scale_is_the_same() {
    let expected = reference(&room(24), &Shot::of(64));
    for scale in [1e-4, 1e-2, 1e2, 1e4] {
        let scaled = room(24).moved(DVec3::ZERO, scale);
        let picture = reference(&scaled, &Shot::of(64).with(|options| options.seed = 1));
        picture.assert_sound(&format!("scale {scale}"));
        picture.assert_same(&expected, 8, 1e-3, &format!("scale {scale}"));
        pathtrace(&scaled, &Shot::of(1)).assert_sound(&format!("scale {scale}"));
    }
}

/// A white plane under a white sky is as bright as the sky, unless rays meet the plane that they start from. They see it from
/// near and far, and its corners are near and far.
#[test]
fn planes_do_not_hide_themselves() {
    for size in [1.0, 1e3, 1e6] {
        for away in [1e-2, 1.0, 1e5] {
            for corner in [Vec3::new(-0.37, 0.11, -0.61), Vec3::ZERO, Vec3::new(1e3, 1e3, 1e3)] {
                let (across, along) = (Vec3::new(0.8, 0.1, 0.2) * size, Vec3::new(-0.1, 0.3, 0.9) * size);
                let plane = quad(corner * size, along, across);
                let [a, b, c] = plane[0].map(|corner| corner.as_dvec3());
                let normal = (b - a).cross(c - a).normalize();
                let middle = a + 0.5 * (c - a) + 0.1 * (b - a);
                let eye = middle + away * (normal + 0.7 * (b - a).normalize());
                let world = World::new(16).sky(1.0).with(plane, lambert(1.0)).seen_from(eye, middle, 0.2);
                let what = format!("size {size}, {away} away, corner {corner}");
                let picture = reference(&world, &Shot::of(8).with(|options| options.target = Target::Direct));
                picture.assert_sound(&what);
                picture.whole().assert(1.0, 1e-4, &what);
                pathtrace(&world, &Shot::of(1)).assert_sound(&what);
            }
        }
    }
}

/// A dark room within a bright one: no ray gets through its walls, and none through its edges.
#[test]
fn closed_rooms_do_not_leak() {
    for (scale, away) in [(1.0, 0.0), (1e-3, 0.0), (1e4, 0.0), (100.0, 1e4)] {
        for gap in [1e-1, 1e-3] {
            let world = World::new(32)
                .with(cube(Vec3::ZERO, -1.0), lambert(0.8))
                .with(cube(Vec3::ZERO, -1.0 - gap), shining(1.0, 0.5))
                .seen_from(DVec3::new(0.3, 0.2, 0.1), DVec3::new(-1.0, -0.8, -0.9), 1.2)
                .moved(DVec3::splat(away), scale);
            let picture = reference(&world, &Shot::of(16));
            assert_eq!(picture.whole().mean, 0.0, "scale {scale}, {away} away, gap {gap}");
        }
    }
}
