//! Boxes of parts of triangles: a long one across empty space, such as a column or a floor's, gets several small boxes in place
//! of a large one, each with a leaf record of its own.
//!
//! Which triangles are worth it is decided by the `obvhs` crate, before the tree is built (early split clipping; Ernst and
//! Greiner 2007).

use crate::bounds::Aabb;
use crate::error::MAX_PRIMITIVES;
use crate::layout::Triangle;
use glam::Vec3;
use obvhs::aabb::Aabb as ObvhsAabb;
use obvhs::splits::split_aabbs_preset;
use obvhs::triangle::Triangle as ObvhsTriangle;

/// More records than this, for each that was given, are not made.
const MOST_PARTS: usize = 2;
/// More records than this stay whole, so that those of all parts are no more than a structure may have.
const MOST_SPLIT: usize = MAX_PRIMITIVES / MOST_PARTS;
/// Rounding of a part's corners, relative to its coordinates (2^-21).
const ROUNDING: f32 = 4.768_371_6e-7;

/// The records with those split that are worth it, and the box of each; spheres are never split.
pub(crate) fn split(records: Vec<Triangle>, boxes: Vec<Aabb>) -> (Vec<Triangle>, Vec<Aabb>) {
    let has_sphere = records.iter().any(|record| record.sphere().is_some());
    if has_sphere || records.is_empty() || records.len() > MOST_SPLIT {
        return (records, boxes);
    }
    let triangles: Vec<ObvhsTriangle> = records.iter().map(to_obvhs).collect();
    let mut parts: Vec<ObvhsAabb> =
        boxes.iter().map(|b| ObvhsAabb::new(b.min.to_array().into(), b.max.to_array().into())).collect();
    let mut wholes: Vec<u32> = (0..records.len() as u32).collect();
    let areas = boxes.iter().map(|b| f64::from(b.half_area()));
    let mean = (areas.clone().sum::<f64>() / boxes.len() as f64) as f32;
    let greatest = areas.fold(0.0, f64::max) as f32;
    if !(mean > 0.0 && greatest.is_finite()) {
        return (records, boxes);
    }
    split_aabbs_preset(&mut parts, &mut wholes, &triangles, mean, greatest);
    if parts.len() > MOST_PARTS * records.len() {
        return (records, boxes);
    }
    let of_part = |(part, &whole): (&ObvhsAabb, &u32)| {
        let least = Vec3::from(part.min.to_array());
        let most = Vec3::from(part.max.to_array());
        let rounding = ROUNDING * least.abs().max(most.abs());
        let whole_box = boxes[whole as usize];
        Aabb { min: (least - rounding).max(whole_box.min), max: (most + rounding).min(whole_box.max) }
    };
    let part_boxes = parts.iter().zip(&wholes).map(of_part).collect();
    (wholes.iter().map(|&whole| records[whole as usize]).collect(), part_boxes)
}

fn to_obvhs(record: &Triangle) -> ObvhsTriangle {
    let [v0, v1, v2] = record.vertices.map(Into::into);
    ObvhsTriangle { v0, v1, v2 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blas::bounds_of;

    fn triangle(vertices: [[f32; 3]; 3], primitive: u32) -> Triangle {
        Triangle { vertices, primitive, flags: 0, reserved: 0 }
    }

    /// Many small triangles, and a slanted one across all of them.
    fn field() -> (Vec<Triangle>, Vec<Aabb>) {
        let small = |i: u32| {
            let at = i as f32 * 0.1;
            triangle([[at, 0.0, 0.0], [at + 0.1, 0.0, 0.0], [at, 0.1, 0.0]], i)
        };
        let long = triangle([[0.0, 0.0, 0.0], [100.0, 100.0, 100.0], [100.0, 100.0, 99.0]], 1000);
        let records: Vec<Triangle> = (0..1000).map(small).chain([long]).collect();
        let boxes = records.iter().map(bounds_of).collect();
        (records, boxes)
    }

    #[test]
    fn parts_cover_the_triangle_and_are_smaller() {
        let (records, boxes) = field();
        let whole = boxes[1000];
        let (records, boxes) = split(records, boxes);
        assert_eq!(records.len(), boxes.len());
        let parts: Vec<&Aabb> = records
            .iter()
            .zip(&boxes)
            .filter(|(record, _)| record.primitive == 1000)
            .map(|(_, b)| b)
            .collect();
        assert!(parts.len() > 4, "{}", parts.len());
        let area: f32 = parts.iter().map(|part| part.half_area()).sum();
        assert!(area < whole.half_area() * 0.5, "{area} of {}", whole.half_area());
        let [a, b, c] = records.iter().find(|r| r.primitive == 1000).unwrap().vertices.map(Vec3::from);
        for i in 0..=1000u32 {
            for j in 0..=10u32 {
                let (u, v) = (i as f32 / 1000.0, j as f32 / 10.0);
                let point = a + (b - a) * u * (1.0 - v) + (c - a) * u * v;
                let inside =
                    |part: &&Aabb| point.cmpge(part.min - 1e-5).all() && point.cmple(part.max + 1e-5).all();
                assert!(parts.iter().any(inside), "{point}");
            }
        }
    }

    #[test]
    fn alike_triangles_stay_whole() {
        let (mut records, mut boxes) = field();
        records.pop();
        boxes.pop();
        let (after, after_boxes) = split(records.clone(), boxes.clone());
        assert_eq!((after, after_boxes), (records, boxes));
    }
}
