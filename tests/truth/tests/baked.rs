//! Light sources are recovered from a bake that was computed as light goes.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use afterglow_scene::Relighting;
use afterglow_truth::measure::{Observed, baked, play_as};
use afterglow_truth::styles;

fn observed(relighting: Relighting) -> (afterglow_truth::Truth, Vec<Observed>) {
    let recording = styles::named("baked_room").unwrap().record().unwrap();
    let played = play_as(&recording.trace, relighting).unwrap();
    (recording.truth, played.into_iter().map(|frame| frame.observed).collect())
}

#[test]
fn lamps_are_found_where_they_were_and_twice_the_same() {
    let (truth, seen) = observed(Relighting::AtOnce);
    let score = baked(&truth, &seen).unwrap();
    assert!(score.relight.is_used && score.relight.residual < 0.15 && score.relight.explained > 0.9);
    assert_eq!(score.lights.len(), 3);
    for light in score.lights {
        assert!(light.distance < 0.01, "{light:?}");
        assert!(light.found.distance(light.told) < 0.06 * light.told.length(), "{light:?}");
    }
    assert!(seen == observed(Relighting::AtOnce).1);
}

#[test]
fn nothing_is_searched_unless_it_is_asked_for() {
    let (truth, seen) = observed(Relighting::Off);
    assert!(baked(&truth, &seen).is_none() && seen.iter().all(|frame| frame.recovered.is_empty()));
}
