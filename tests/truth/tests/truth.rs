//! The truth is aligned with the traces, and the measure tells right from wrong.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use afterglow_scene::{Class, LightShape};
use afterglow_truth::measure::{ClassScore, Observed, Report, compare, measure, measure_played, play};
use afterglow_truth::styles::{self, STYLES};
use afterglow_truth::{Recording, Truth};
use glam::{DMat3, DMat4, DVec3};

fn recordings() -> impl Iterator<Item = Recording> {
    STYLES.iter().map(|entry| entry.record().unwrap())
}

fn ideal(truth: &Truth) -> Vec<Observed> {
    truth.frames.iter().map(Observed::ideal).collect()
}

fn class<'a>(report: &'a Report, name: &str) -> &'a ClassScore {
    report.classes.iter().find(|score| score.class == name).unwrap()
}

fn move_light(light: &mut LightShape, by: DMat4) {
    match light {
        LightShape::Directional { to_light, .. } => {
            *to_light = by.transform_vector3(to_light.as_dvec3()).as_vec3();
        }
        LightShape::Point { position, .. } => *position = by.transform_point3(position.as_dvec3()).as_vec3(),
    }
}

#[test]
fn labels_are_of_the_triangles_that_are_drawn() {
    for Recording { trace, truth } in recordings() {
        let played = play(&trace).unwrap();
        let drawn: Vec<u64> = played.iter().map(|frame| frame.triangles).collect();
        let told: Vec<u64> = truth.frames.iter().map(|frame| frame.triangles()).collect();
        assert_eq!(drawn, told, "{}", truth.style);
        assert!(told.iter().all(|&triangles| triangles < 10_000), "{}", truth.style);
        assert!((40..=60).contains(&truth.frames.len()), "{}", truth.style);
    }
}

#[test]
fn styles_are_the_same_each_time() {
    for (entry, recording) in STYLES.iter().zip(recordings()) {
        assert!(entry.record().unwrap() == recording, "{}", entry.name);
    }
}

#[test]
fn cameras_are_rigid_and_move() {
    for Recording { truth, .. } in recordings() {
        let views: Vec<DMat4> = truth.frames.iter().filter_map(|f| f.camera.map(|c| c.view)).collect();
        for view in &views {
            let rotation = DMat3::from_mat4(*view);
            assert!((rotation * rotation.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-9), "{}", truth.style);
            let handedness = if truth.style == "mirrored_view" { -1.0 } else { 1.0 };
            assert!((rotation.determinant() - handedness).abs() < 1e-9, "{}", truth.style);
        }
        assert!(views.windows(2).any(|pair| !pair[0].abs_diff_eq(pair[1], 1e-3)), "{}", truth.style);
    }
}

#[test]
fn truths_come_back_from_their_files() {
    for Recording { truth, .. } in recordings() {
        let text = serde_json::to_string(&truth).unwrap();
        let read: Truth = serde_json::from_str(&text).unwrap();
        assert_eq!(read.frames.len(), truth.frames.len());
        for (read, told) in read.frames.iter().zip(&truth.frames) {
            assert!(read.labels == told.labels, "{}", truth.style);
            // A file's numbers may differ in the last bit.
            let is_near = match (read.camera, told.camera) {
                (Some(read), Some(told)) => read.view.abs_diff_eq(told.view, 1e-12),
                (read, told) => read.is_none() && told.is_none(),
            };
            assert!(is_near, "{}", truth.style);
        }
    }
}

#[test]
fn a_recovery_that_is_right_has_full_marks() {
    // In another world space, which is its right.
    let moved = DMat4::from_rotation_y(0.7) * DMat4::from_translation(DVec3::new(3.0, -8.0, 1.0));
    for Recording { truth, .. } in recordings() {
        let mut observed = ideal(&truth);
        for frame in &mut observed {
            frame.lights.iter_mut().for_each(|(_, light)| move_light(light, moved));
            frame.camera.iter_mut().for_each(|camera| camera.view *= moved.inverse());
        }
        let report = compare(&truth, &observed).unwrap();
        for score in &report.classes {
            let has_settled = score.settled.told > 0;
            assert_eq!(score.recall, has_settled.then_some(1.0), "{} {}", truth.style, score.class);
            assert_eq!(score.precision, has_settled.then_some(1.0), "{} {}", truth.style, score.class);
            assert_eq!(score.young.right, score.young.told);
        }
        assert_eq!((report.camera.found, report.camera.right, report.camera.invented), (1.0, 1.0, 0));
        assert!(report.camera.worst_position < 1e-9 && report.camera.worst_angle < 1e-6);
        assert_eq!(report.camera.worst_projection, 0.0);
        assert_eq!((report.lights.right, report.lights.found), (report.lights.told, report.lights.told));
        let identity = report.identity.unwrap();
        assert!(identity.chances > 0 && identity.switches == 0);
    }
}

#[test]
fn a_recovery_that_is_wrong_has_not() {
    let truth = STYLES[0].record().unwrap().truth;
    let mut observed = ideal(&truth);
    for (index, frame) in observed.iter_mut().enumerate() {
        for run in frame.runs.iter_mut().filter(|run| run.class == Class::Interface) {
            run.class = Class::Static;
        }
        for run in &mut frame.runs {
            run.object = run.object.map(|object| object + 1000 * index as u64);
        }
    }
    // The camera jumps in one frame and is lost in another.
    observed[30].camera.as_mut().unwrap().view *= DMat4::from_translation(DVec3::X * truth.extent * 0.1);
    observed[31].camera = None;
    let report = compare(&truth, &observed).unwrap();
    assert_eq!(class(&report, "interface").recall, Some(0.0));
    assert_eq!(class(&report, "interface").precision, None);
    let missed = class(&report, "interface").settled.told;
    assert_eq!(class(&report, "interface").taken_for.get("static"), Some(&missed));
    assert_eq!(class(&report, "static").recall, Some(1.0));
    assert!(class(&report, "static").precision.unwrap() < 1.0);
    let frames = truth.frames.len() as f64;
    assert_eq!(report.camera.found, (frames - 1.0) / frames);
    assert_eq!(report.camera.right, (frames - 2.0) / frames);
    assert!((report.camera.worst_position - 0.1).abs() < 1e-9);
    let identity = report.identity.unwrap();
    assert_eq!(identity.switches, identity.chances);
}

#[test]
fn what_stands_stays_where_it_is_by_the_right_camera_alone() {
    let moved = DMat4::from_rotation_x(0.4) * DMat4::from_translation(DVec3::new(2.0, 1.0, -5.0));
    let Recording { trace, truth } = styles::named("own_matrices").unwrap().record().unwrap();
    let mut played = play(&trace).unwrap();
    for (frame, told) in played.iter_mut().zip(&truth.frames) {
        frame.observed = Observed::ideal(told);
        frame.observed.camera.as_mut().unwrap().view *= moved.inverse();
    }
    let stability = measure_played(&truth, &played).unwrap().stability.unwrap();
    assert_eq!((stability.frames, stability.stable), (truth.frames.len(), 1.0));
    assert!(stability.worst < 0.01, "{}", stability.worst);
    // A hundredth of a radian is about two pixels.
    played[20].observed.camera.as_mut().unwrap().view *= DMat4::from_rotation_y(0.01);
    played[21].observed.camera = None;
    let stability = measure_played(&truth, &played).unwrap().stability.unwrap();
    let frames = truth.frames.len() as f64;
    assert_eq!(stability.stable, (frames - 2.0) / frames);
    assert!(stability.worst > 2.0 && stability.median < 0.01);
}

#[test]
fn what_is_undecided_counts_nowhere_and_what_is_traced_wrongly_counts() {
    let truth = STYLES[0].record().unwrap().truth;
    let mut told = truth.clone();
    for label in told.frames.iter_mut().flat_map(|frame| &mut frame.labels) {
        label.class = if label.class == Class::Interface { label.class } else { Class::Undecided };
    }
    let mut observed = ideal(&truth);
    for run in observed.iter_mut().flat_map(|frame| &mut frame.runs) {
        run.class = Class::Static;
    }
    let report = compare(&told, &observed).unwrap();
    let count = |class: Class| -> u64 {
        let labels = told.frames.iter().flat_map(|frame| &frame.labels);
        labels.filter(|label| label.class == class).map(|label| label.triangles).sum()
    };
    assert_eq!(report.traced.undecided, count(Class::Undecided));
    assert_eq!(report.traced.interface, count(Class::Interface));
    assert_eq!((report.traced.translucent, report.traced.others), (0, 0));
    assert_eq!(class(&report, "static").settled.told, 0);
}

#[test]
fn lights_at_other_places_are_not_found() {
    let truth = styles::named("gl_lights").unwrap().record().unwrap().truth;
    let mut observed = ideal(&truth);
    let aside = DMat4::from_translation(DVec3::X * truth.extent * 0.1);
    move_light(&mut observed[3].lights[0].1, aside);
    observed[4].lights.clear();
    let report = compare(&truth, &observed).unwrap();
    assert_eq!(report.lights.told - report.lights.right, 4);
    assert_eq!(report.lights.told - report.lights.found, 3);
}

#[test]
fn triangles_that_do_not_match_are_an_error() {
    let truth = STYLES[0].record().unwrap().truth;
    let mut observed = ideal(&truth);
    observed[5].runs.pop();
    assert!(compare(&truth, &observed).is_err());
    observed.pop();
    assert!(compare(&truth, &observed).is_err());
}

#[test]
fn all_styles_are_measured() {
    for recording in recordings() {
        let report = measure(&recording).unwrap();
        // How well is not asked here.
        assert!(!report.classes.is_empty());
        assert!(report.camera.shown > 0);
    }
}
