//! A device that is lost, and one without memory enough: what a program sees of it.

use afterglow_gpu::Faults;
use afterglow_render::Mode;

use crate::program::Program;

/// Frames that are lost with a device, at most: the one that fails, two that wait, and the one that is begun.
const LOST_FRAMES: usize = 4;

pub(crate) fn lost_at(losses: &[u64]) -> Faults {
    let mut faults = Faults::default();
    faults.losses = losses.to_vec();
    faults
}

/// What is shown after so many frames where nothing fails.
pub(crate) fn undisturbed(mode: Mode, frames: usize) -> Vec<u8> {
    let mut program = Program::new(mode, &Faults::default());
    program.frames(frames);
    let picture = program.picture();
    let distinct: std::collections::HashSet<_> = picture.chunks(4).collect();
    assert!(distinct.len() > 100, "there is little to see: {} colours", distinct.len());
    picture
}

#[test]
fn the_picture_comes_back_after_a_loss() {
    let expected = undisturbed(Mode::Raster, 3);
    // The first submissions make the renderer.
    for submission in [1, 2, 3, 4, 5, 6, 7, 9] {
        let faults = lost_at(&[submission]);
        let mut program = Program::new(Mode::Raster, &faults);
        program.frames(8 + LOST_FRAMES);
        assert!(program.picture() == expected, "lost at submission {submission}");
        program.frame();
        assert!(program.picture() == expected, "lost at submission {submission}, a frame later");
        assert!(faults.all_struck());
    }
}

#[test]
fn a_question_to_a_lost_device_is_answered() {
    let faults = lost_at(&[9]);
    let mut program = Program::new(Mode::Raster, &faults);
    let pictures: Vec<_> = (0..12)
        .map(|_| {
            program.frame();
            program.picture()
        })
        .collect();
    let last = pictures.last().unwrap();
    assert!(*last == undisturbed(Mode::Raster, 3));
    assert!(pictures.iter().filter(|picture| *picture != last).count() <= LOST_FRAMES);
    assert!(faults.all_struck());
}

#[test]
fn a_traced_picture_comes_back_too() {
    let faults = lost_at(&[8]);
    let mut program = Program::new(Mode::Pathtrace, &faults);
    program.frames(8 + LOST_FRAMES);
    // Light is gathered anew, so that noise is another.
    let (picture, expected) = (program.picture(), undisturbed(Mode::Pathtrace, 8));
    assert_eq!(picture.len(), expected.len());
    let away: u64 = picture.iter().zip(&expected).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    assert!((away as f64) < 4.0 * picture.len() as f64, "{away} of {} bytes", picture.len());
    assert!(faults.all_struck());
}

#[test]
fn a_device_that_is_lost_again_and_again_is_given_up() {
    let losses: Vec<u64> = (0..100).map(|index| 10 + index * 10).collect();
    let mut program = Program::new(Mode::Raster, &lost_at(&losses));
    program.frames(100);
    assert!(program.picture().iter().all(|byte| *byte == 0));
    program.frames(10);
}

#[test]
fn frames_are_rasterized_where_memory_does_not_do_for_rays() {
    // Enough for the first buffers of frames and ranges, not for meshes that rays meet.
    let mut faults = Faults::default();
    faults.memory = Some(24 << 20);
    let mut program = Program::new(Mode::Pathtrace, &faults);
    let expected = undisturbed(Mode::Raster, 3);
    assert!(expected != undisturbed(Mode::Pathtrace, 3));
    for _ in 0..5 {
        // The very frame that finds it out included.
        program.frame();
        assert!(program.picture() == expected);
    }
}
