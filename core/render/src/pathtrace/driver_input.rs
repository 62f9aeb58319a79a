//! A mesh as drivers take it: triangles or boxes on the device, none of which can upset a build.

use std::borrow::Cow;

use afterglow_bvh::Aabb;
use afterglow_bvh::layout::LARGEST_COORDINATE;
use afterglow_gpu::{GpuError, StructureGeometry, StructureShape};
use glam::Vec3;
use xxhash_rust::xxh3::Xxh3;

use super::structures::Shapes;
use crate::uploads::UploadArena;

/// Bytes of a triangle's corners.
const TRIANGLE_BYTES: u64 = 36;

/// What a mesh is made of; the number is that of the hit group (see `program`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Triangles = 0,
    Spheres = 1,
}

/// A geometry of a mesh, which is a member: how many triangles or spheres, and whether they have no holes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Part {
    count: u32,
    is_opaque: bool,
}

/// A mesh with something to meet.
#[derive(Debug)]
pub(super) struct DriverInput<'a> {
    pub(super) kind: Kind,
    /// Corners of triangles, three each, or of boxes, two each.
    corners: Cow<'a, [[f32; 3]]>,
    parts: Vec<Part>,
    /// The box of all that can be met.
    pub(super) bounds: Aabb,
    /// A hash of all but the positions: members, and what of them can be met.
    pub(super) topology: u64,
}

impl<'a> DriverInput<'a> {
    /// None if there is nothing to meet.
    pub(super) fn new(shapes: &Shapes<'a>) -> Option<Self> {
        match shapes {
            Shapes::Triangles { corners, members } => {
                let parts = members
                    .iter()
                    .map(|member| Part { count: member.triangles, is_opaque: !member.is_alpha_tested });
                Self::of_triangles(corners, parts.collect())
            }
            Shapes::Spheres(spheres) => Self::of_spheres(spheres),
        }
    }

    fn of_triangles(corners: &'a [[f32; 3]], parts: Vec<Part>) -> Option<Self> {
        let (triangles, _) = corners.as_chunks::<3>();
        let is_met: Vec<bool> = triangles.iter().map(can_be_met).collect();
        let met = || triangles.iter().zip(&is_met).filter(|(_, is_met)| **is_met).map(|(corners, _)| corners);
        let bounds =
            met().flatten().fold(Aabb::EMPTY, |sum, corner| sum.union(Aabb::around(&[Vec3::from(*corner)])));
        let place = met().next()?[0];
        let corners = match is_met.iter().all(|is_met| *is_met) {
            true => Cow::Borrowed(corners),
            false => {
                let sound =
                    |(corners, is_met): (&[[f32; 3]; 3], &bool)| if *is_met { *corners } else { [place; 3] };
                triangles.iter().zip(&is_met).flat_map(sound).collect()
            }
        };
        Some(Self::with(Kind::Triangles, corners, parts, bounds, &is_met))
    }

    fn of_spheres(spheres: &[[f32; 4]]) -> Option<Self> {
        let boxes: Vec<Option<Aabb>> = spheres.iter().map(box_of).collect();
        let place = boxes.iter().flatten().next()?.min;
        let bounds = boxes.iter().flatten().fold(Aabb::EMPTY, |sum, bounds| sum.union(*bounds));
        // What the shader does not meet either has a box without room.
        let sound = |bounds: &Option<Aabb>| bounds.map_or([place; 2], |bounds| [bounds.min, bounds.max]);
        let corners: Vec<_> = boxes.iter().flat_map(sound).map(|corner| corner.to_array()).collect();
        let is_met: Vec<bool> = boxes.iter().map(Option::is_some).collect();
        let parts = vec![Part { count: spheres.len() as u32, is_opaque: true }];
        Some(Self::with(Kind::Spheres, Cow::Owned(corners), parts, bounds, &is_met))
    }

    fn with(
        kind: Kind,
        corners: Cow<'a, [[f32; 3]]>,
        parts: Vec<Part>,
        bounds: Aabb,
        is_met: &[bool],
    ) -> Self {
        let mut hasher = Xxh3::new();
        hasher.update(&[kind as u8]);
        for part in &parts {
            hasher.update(&part.count.to_le_bytes());
            hasher.update(&[u8::from(part.is_opaque)]);
        }
        hasher.update(bytemuck::cast_slice(&is_met.iter().copied().map(u8::from).collect::<Vec<_>>()));
        Self { kind, corners, parts, bounds, topology: hasher.digest() }
    }

    /// Brings triangles or boxes to where this frame's builds read them.
    pub(super) fn upload(&self, arena: &mut UploadArena) -> Result<Vec<StructureGeometry>, GpuError> {
        let address = arena.push(bytemuck::cast_slice(&self.corners))?.address;
        let shape = match self.kind {
            Kind::Triangles => StructureShape::Triangles,
            Kind::Spheres => StructureShape::Boxes,
        };
        let mut before = 0;
        let geometry = |part: &Part| {
            let address = address + before * TRIANGLE_BYTES;
            before += u64::from(part.count);
            StructureGeometry { shape, address, count: part.count, is_opaque: part.is_opaque }
        };
        Ok(self.parts.iter().map(geometry).collect())
    }
}

/// As for the software backend: all corners near enough, and some area.
fn can_be_met(corners: &[[f32; 3]; 3]) -> bool {
    // What is not a number fails the comparison.
    let is_near = corners.as_flattened().iter().all(|along| along.abs() <= LARGEST_COORDINATE);
    let [a, b, c] = corners.map(|corner| Vec3::from(corner).as_dvec3());
    is_near && (b - a).cross(c - a).length() > 0.0
}

/// The box of a sphere that rays can meet.
fn box_of(&[x, y, z, radius]: &[f32; 4]) -> Option<Aabb> {
    let center = Vec3::new(x, y, z);
    let reach = center.abs().max_element() + radius;
    let is_sound = center.is_finite() && radius > 0.0 && reach <= LARGEST_COORDINATE;
    // Rounding must not cut anything off.
    let outwards = Vec3::splat(radius) + f32::EPSILON * (center.abs() + radius);
    is_sound.then_some(Aabb { min: center - outwards, max: center + outwards })
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f32; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    fn triangles(corners: &[[f32; 3]]) -> Option<DriverInput<'_>> {
        let part = Part { count: corners.len() as u32 / 3, is_opaque: true };
        DriverInput::of_triangles(corners, vec![part])
    }

    #[test]
    fn what_cannot_be_met_becomes_a_point() {
        let lost = [[f32::NAN; 3], [9.0; 3], [8.0, 9.0, 9.0]];
        let flat = [[5.0; 3]; 3];
        let corners = [lost, CORNERS, flat].concat();
        let input = triangles(&corners).unwrap();
        assert_eq!((input.corners.len(), input.bounds.max), (9, Vec3::new(1.0, 1.0, 0.0)));
        assert_eq!(input.corners[..3], [[0.0; 3]; 3]);
        assert_eq!(input.corners[3..6], CORNERS);
        assert!(triangles(&lost).is_none());
        assert!(triangles(&[]).is_none());
    }

    #[test]
    fn topology_is_all_but_the_positions() {
        let moved = CORNERS.map(|[x, y, z]| [x + 1.0, y, z]);
        let topology = |corners: &[[f32; 3]]| triangles(corners).unwrap().topology;
        assert_eq!(topology(&CORNERS), topology(&moved));
        let with_lost = |corners: [[f32; 3]; 3]| topology(&[CORNERS, corners].concat());
        assert_ne!(with_lost(moved), with_lost([[f32::NAN; 3]; 3]));
        assert_ne!(with_lost(moved), topology(&CORNERS));
    }

    #[test]
    fn spheres_have_boxes_of_their_own() {
        let spheres = [[0.0, 0.0, 0.0, -1.0], [1.0, 2.0, 3.0, 0.5], [f32::NAN, 0.0, 0.0, 1.0]];
        let input = DriverInput::new(&Shapes::Spheres(&spheres)).unwrap();
        assert_eq!((input.kind, input.corners.len()), (Kind::Spheres, 6));
        assert!(input.corners.iter().flatten().all(|along| along.is_finite()));
        assert!(input.bounds.max.cmpgt(Vec3::new(1.5, 2.5, 3.5)).all());
        assert!(DriverInput::new(&Shapes::Spheres(&spheres[..1])).is_none());
    }
}
