//! Numbers of a file that may be anything, and what they must be.

use std::collections::HashSet;

use glam::{DMat3, DMat4, DVec3, Vec3};

use crate::error::Problem;

/// How far a matrix that should be rigid may be from it, per entry of its columns' products.
const RIGID_ERROR: f64 = 1e-4;

/// What counts may be.
pub(crate) const MOST_BYTES: u64 = 1 << 29;
pub(crate) const MOST_VERTICES: usize = 1 << 25;
pub(crate) const MOST_TRIANGLES: usize = 1 << 25;
pub(crate) const MOST_MATERIALS: usize = 1 << 16;
pub(crate) const MOST_LIGHTS: usize = 1 << 16;
pub(crate) const MOST_OBJECTS: usize = 1 << 16;
pub(crate) const MOST_FRAMES: usize = 1 << 20;
/// Draws that a frame is made of: pairs of an object and a material.
pub(crate) const MOST_DRAWS: usize = 1 << 16;
const MOST_SIDE: u32 = 16384;
const MOST_PIXELS: u64 = 1 << 25;

/// Fails if there are more than `most`.
pub(crate) fn count(place: &str, count: usize, most: usize) -> Result<(), Problem> {
    match count <= most {
        true => Ok(()),
        false => Err(Problem::TooMany { place: place.into(), count: count as u64, most: most as u64 }),
    }
}

/// Width and height of a picture, pixels.
pub(crate) fn size(place: &str, [width, height]: [u32; 2]) -> Result<[u32; 2], Problem> {
    let is_side = |side| (1..=MOST_SIDE).contains(&side);
    match is_side(width) && is_side(height) && u64::from(width) * u64::from(height) <= MOST_PIXELS {
        true => Ok([width, height]),
        false => {
            Err(Problem::value(place, format!("a picture of {width}x{height} pixels is empty or too large")))
        }
    }
}

/// An index of something that there are `count` of.
pub(crate) fn index(place: impl Fn() -> String, index: u64, count: usize) -> Result<u32, Problem> {
    match u32::try_from(index) {
        Ok(known) if (known as usize) < count => Ok(known),
        _ => Err(Problem::Index { place: place(), index, count }),
    }
}

/// A point of the world.
pub(crate) fn point(place: &str, point: [f64; 3]) -> Result<DVec3, Problem> {
    let point = DVec3::from(point);
    match point.as_vec3().is_finite() {
        true => Ok(point),
        false => Err(Problem::value(place, "a coordinate is not finite")),
    }
}

/// Linear RGB that is light: not negative.
pub(crate) fn light(place: &str, light: [f64; 3]) -> Result<DVec3, Problem> {
    let light = DVec3::from(light);
    match light.as_vec3().is_finite() && light.min_element() >= 0.0 {
        true => Ok(light),
        false => Err(Problem::value(place, "light is not finite, or negative")),
    }
}

/// Linear RGB that is a reflectance.
pub(crate) fn reflectance(place: &str, color: [f64; 3]) -> Result<Vec3, Problem> {
    color.map(|channel| share(place, channel)).into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(DVec3::from(color).as_vec3())
}

/// A number from 0 to 1.
pub(crate) fn share(place: &str, value: f64) -> Result<f64, Problem> {
    within(place, value, 0.0, 1.0)
}

/// A number between bounds.
pub(crate) fn within(place: &str, value: f64, least: f64, most: f64) -> Result<f64, Problem> {
    match (least..=most).contains(&value) {
        true => Ok(value),
        false => Err(Problem::value(place, format!("{value} is not from {least} to {most}"))),
    }
}

/// A factor on light; 1 where none is given.
pub(crate) fn scale(place: &str, factor: Option<f64>) -> Result<f64, Problem> {
    within(place, factor.unwrap_or(1.0), 0.0, 1e30)
}

/// Direction of any length but 0, made a unit vector.
pub(crate) fn direction(place: &str, direction: [f64; 3]) -> Result<DVec3, Problem> {
    let unit = DVec3::from(direction).try_normalize();
    unit.ok_or_else(|| Problem::value(place, "no direction"))
}

/// A matrix that takes coordinates to coordinates and can be undone.
pub(crate) fn affine(place: &str, columns: [f64; 16]) -> Result<DMat4, Problem> {
    let matrix = invertible(place, columns)?;
    match matrix.row(3).to_array() {
        [0.0, 0.0, 0.0, 1.0] => Ok(matrix),
        _ => Err(Problem::value(place, "the last row is not 0, 0, 0, 1")),
    }
}

/// A matrix that turns and moves, and no more.
pub(crate) fn rigid(place: &str, columns: [f64; 16]) -> Result<DMat4, Problem> {
    let matrix = affine(place, columns)?;
    let linear = DMat3::from_mat4(matrix);
    let is_rigid = (linear.transpose() * linear).abs_diff_eq(DMat3::IDENTITY, RIGID_ERROR);
    match is_rigid && linear.determinant() > 0.0 {
        true => Ok(matrix),
        false => Err(Problem::value(place, "not a rotation and a translation")),
    }
}

/// A matrix of finite numbers that can be undone.
pub(crate) fn invertible(place: &str, columns: [f64; 16]) -> Result<DMat4, Problem> {
    let matrix = DMat4::from_cols_array(&columns);
    match matrix.as_mat4().is_finite() && matrix.determinant() != 0.0 && matrix.inverse().is_finite() {
        true => Ok(matrix),
        false => Err(Problem::value(place, "the matrix is not finite or has no inverse")),
    }
}

/// Names by which other parts of a file refer to something: each may be there once.
pub(crate) fn unique<'a>(place: &str, names: impl Iterator<Item = &'a str>) -> Result<(), Problem> {
    let mut known = HashSet::new();
    for name in names {
        if !known.insert(name) {
            return Err(Problem::value(place, format!("there are several named {name:?}")));
        }
    }
    Ok(())
}
