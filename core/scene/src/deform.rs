//! What happened to the corners of a stretch from one frame to the next.
//!
//! What is animated bends: its triangles change their shapes, or stir, each its own way by less than its size. What is moved
//! as a whole keeps its shape. Where parts have gone far, each its own way, and none has changed its shape, these are other
//! things of the same kind: plants that grow elsewhere, columns that come into view as others go.

use glam::Vec3;

/// Triangles that are compared, at most.
const COMPARED: usize = 64;
/// How much an edge must change to have changed at all, in lengths of the longest.
const LEAST: f32 = 1e-4;
/// How far a triangle goes that stirs, in lengths of its longest edge.
const STIRS: f32 = 0.25;
/// Rounding of a coordinate.
const ROUNDING: f32 = 4.0 * f32::EPSILON;

/// What happened to corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Change {
    /// They are where they were.
    Rests,
    /// Shapes have changed, or parts have stirred.
    Bends,
    /// All went the same way.
    Goes(Vec3),
    /// They are those of other things.
    Scatters,
}

/// What happened to the corners of triangles, three each, in the same order.
pub fn change(before: &[Vec3], now: &[Vec3]) -> Change {
    if before.len() != now.len() {
        return Change::Scatters;
    }
    let every = (now.len() / 3).div_ceil(COMPARED).max(1);
    let (mut still, mut bent, mut moved, mut stirred, mut scattered) = (0, 0, 0, 0, 0);
    let mut way: Option<Vec3> = None;
    let mut is_one_way = true;
    let triangles = before.as_chunks::<3>().0.iter().zip(now.as_chunks::<3>().0);
    for (before, now) in triangles.step_by(every) {
        match of_triangle(before, now) {
            Change::Rests => still += 1,
            Change::Bends => bent += 1,
            Change::Goes(step) => {
                moved += 1;
                stirred += usize::from(step.length() <= STIRS * longest(now));
                let first = *way.get_or_insert(step);
                is_one_way &= first.distance(step) <= 0.01 * first.length() + rounding(now);
            }
            Change::Scatters => scattered += 1,
        }
    }
    let changed = bent + moved + scattered;
    match way {
        _ if changed == 0 => Change::Rests,
        Some(way) if moved == changed && still == 0 && is_one_way => Change::Goes(way),
        _ if 2 * (bent + stirred) >= changed => Change::Bends,
        _ => Change::Scatters,
    }
}

fn of_triangle(before: &[Vec3; 3], now: &[Vec3; 3]) -> Change {
    let steps = [0, 1, 2].map(|i| now[i] - before[i]);
    let (size, changed) = (longest(now).max(longest(before)), longest(&steps));
    if steps == [Vec3::ZERO; 3] {
        Change::Rests
    } else if changed <= LEAST * size + rounding(now) {
        Change::Goes(steps[0])
    } else if steps.iter().all(|step| step.is_finite()) {
        Change::Bends
    } else {
        Change::Scatters
    }
}

/// The longest edge.
fn longest(corners: &[Vec3; 3]) -> f32 {
    let edges = [(0, 1), (1, 2), (2, 0)].map(|(a, b)| corners[a].distance(corners[b]));
    edges.into_iter().fold(0.0, f32::max)
}

/// How exactly the differences of corners are known.
fn rounding(corners: &[Vec3; 3]) -> f32 {
    ROUNDING * corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f32::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::thing;

    /// Things along a line, each moved.
    fn row(moved: impl Fn(usize, Vec3) -> Vec3) -> Vec<Vec3> {
        let thing =
            |i: usize| thing(1.0).into_iter().map(move |corner| (i, corner + Vec3::X * 5.0 * i as f32));
        (0..4).flat_map(thing).map(|(i, corner)| moved(i, corner)).collect()
    }

    #[test]
    fn what_is_the_same_rests_and_what_goes_as_one_goes() {
        let before = row(|_, corner| corner);
        assert_eq!(change(&before, &before), Change::Rests);
        let step = Vec3::new(0.25, 3.0, -1.0);
        assert_eq!(change(&before, &row(|_, corner| corner + step)), Change::Goes(step));
    }

    #[test]
    fn what_turns_or_changes_its_shape_bends_though_some_of_it_rests() {
        let before = row(|_, corner| corner);
        let turn = glam::Quat::from_rotation_y(0.3);
        assert_eq!(change(&before, &row(|_, corner| turn * corner)), Change::Bends);
        let swung = |i: usize, corner: Vec3| if i > 1 { corner * Vec3::new(1.0, 1.1, 1.0) } else { corner };
        assert_eq!(change(&before, &row(swung)), Change::Bends);
        let bobbing = |i: usize, corner: Vec3| corner + Vec3::Y * [0.1, -0.2, 0.15, 0.0][i];
        assert_eq!(change(&before, &row(bobbing)), Change::Bends);
    }

    #[test]
    fn things_elsewhere_are_others() {
        let before = row(|_, corner| corner);
        let apart = |i: usize, corner: Vec3| corner + Vec3::Z * [0.0, 3.0, -2.0, 7.0][i];
        assert_eq!(change(&before, &row(apart)), Change::Scatters);
        assert_eq!(
            change(&before, &row(|i, corner| if i == 2 { corner + Vec3::Y } else { corner })),
            Change::Scatters
        );
        assert_eq!(change(&before, &before[3..]), Change::Scatters);
    }

    #[test]
    fn what_is_not_a_number_is_something_else() {
        let odd = row(|_, corner| corner * f32::NAN);
        assert_eq!(change(&odd, &odd), Change::Scatters);
    }
}
