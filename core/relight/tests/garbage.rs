//! Input that makes no sense: always an answer, always the same.

#![allow(clippy::unwrap_used, reason = "what cannot go on is to fail loudly")]

mod support;

use afterglow_relight::{Baked, Emitter, FalloffModel, Found, Options, Patch, Sky, recover};
use glam::Vec3;
use proptest::prelude::*;
use std::sync::atomic::AtomicBool;
use support::{Built, Lamp};

fn options() -> Options {
    Options { rays: 100_000, falloff: FalloffModel::Either, saturation: Some(1.0), ..Options::default() }
}

fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => -4.0f32..4.0,
        2 => (-2i32..=2).prop_map(|n| n as f32),
        1 => any::<f32>(),
        1 => prop::sample::select(vec![f32::NAN, f32::INFINITY, -0.0, 1e-30, 1e30, f32::MAX, f32::MIN]),
    ]
}

fn vector() -> impl Strategy<Value = Vec3> {
    [number(), number(), number()].prop_map(Vec3::from)
}

fn triangles(most: usize) -> impl Strategy<Value = Vec<[Vec3; 3]>> {
    prop::collection::vec([vector(), vector(), vector()], 0..most)
}

fn patch() -> impl Strategy<Value = Patch> {
    (vector(), vector(), number(), vector(), vector()).prop_map(
        |(position, normal, area, irradiance, albedo)| Patch {
            position,
            normal,
            area: area.abs(),
            irradiance: irradiance.abs(),
            albedo,
        },
    )
}

fn emitter() -> impl Strategy<Value = Emitter> {
    (triangles(4), any::<bool>(), number()).prop_map(|(triangles, two_sided, preference)| Emitter {
        triangles,
        two_sided,
        preference,
    })
}

fn check(found: &Found, patches: &[Patch]) {
    assert_eq!(found.per_patch.len(), patches.len());
    assert!(found.residual.is_finite() && (0.0..=1.0).contains(&found.explained), "{found:?}");
    for light in &found.lights {
        assert!(light.power.is_finite() && light.power.min_element() >= 0.0, "{light:?}");
        assert!((0.0..=1.0).contains(&light.evidence));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(96) })]

    #[test]
    fn anything_has_an_answer_and_only_one(
        world in triangles(12),
        sky in prop::option::of(triangles(3)),
        patches in prop::collection::vec(patch(), 0..40),
        emitters in prop::collection::vec(emitter(), 0..3),
        open in any::<bool>(),
    ) {
        let sky = match &sky {
            Some(sky) => Sky::Surfaces(sky),
            None if open => Sky::Open,
            None => Sky::None,
        };
        let baked = Baked { triangles: &world, patches: &patches, emitters: &emitters, sky };
        let found = recover(&baked, &options(), &AtomicBool::new(false)).unwrap();
        check(&found, &patches);
        let again = recover(&baked, &options(), &AtomicBool::new(false)).unwrap();
        prop_assert_eq!(format!("{found:?}"), format!("{again:?}"));
    }

    #[test]
    fn options_may_be_anything(
        seed in any::<u64>(), max_sources in 0usize..4, rays in 0u64..20_000,
        saturation in prop::option::of(number()), least_evidence in number(),
    ) {
        let mut built = Built::new();
        built.cuboid(Vec3::ZERO, Vec3::new(4.0, 3.0, 2.0), true, Vec3::splat(0.5), 1.0, &[]);
        built.bake(&[Lamp::Point(Vec3::new(1.0, 1.0, 1.5), Vec3::ONE)], 0, 0);
        let triangles = built.triangles();
        let falloff = FalloffModel::InverseSquare;
        let options = Options { seed, max_sources, rays, saturation, falloff, least_evidence };
        let found = recover(&built.baked(&triangles, Sky::Open), &options, &AtomicBool::new(false)).unwrap();
        check(&found, &built.patches);
        prop_assert!(found.lights.len() <= max_sources);
    }
}

#[test]
fn patches_all_in_one_place_are_borne() {
    let patch = Patch {
        position: Vec3::splat(1e8),
        normal: Vec3::X,
        area: 1.0,
        irradiance: Vec3::ONE,
        albedo: Vec3::ONE,
    };
    let patches = vec![patch; 3000];
    let baked = Baked { triangles: &[], patches: &patches, emitters: &[], sky: Sky::Open };
    let found = recover(&baked, &options(), &AtomicBool::new(false)).unwrap();
    check(&found, &patches);
}

#[test]
fn cancelling_ends_it() {
    let mut built = Built::new();
    built.cuboid(Vec3::ZERO, Vec3::ONE, true, Vec3::splat(0.5), 0.1, &[]);
    built.bake(&[Lamp::Point(Vec3::splat(0.5), Vec3::ONE)], 0, 0);
    let triangles = built.triangles();
    assert!(recover(&built.baked(&triangles, Sky::None), &options(), &AtomicBool::new(true)).is_none());
}
