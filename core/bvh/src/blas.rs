//! Bottom levels: triangles and spheres in object space.

use crate::binary::{Split, build};
use crate::bounds::Aabb;
use crate::encode::encode;
use crate::error::{BuildError, check_count};
use crate::layout::{
    FLAG_SPHERE, LARGEST_COORDINATE, MAX_LEAF, MOST_WAITING_BLAS, Node, Sphere, TRIANGLE_UNITS, Triangle,
};
use crate::optimise::build_well;
use crate::split::split;
use glam::Vec3;

/// How much time a build may take for faster rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// Surface-area heuristic over bins: for geometry that changes.
    Fast,
    /// The cheaper of a tree cut from above and one clustered from below, over large triangles' parts, improved by
    /// reinsertion: for what is built once.
    Good,
    /// Improved more, in several times the time, for a few percent.
    Best,
}

impl Quality {
    /// The share of nodes that a round of reinsertion looks at.
    fn reinserted(self) -> Option<f32> {
        match self {
            Self::Fast => None,
            Self::Good => Some(0.2),
            Self::Best => Some(1.0),
        }
    }
}

/// What a hit needs to know of a triangle or a sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TriangleAttributes {
    /// Reported by a hit.
    pub primitive: u32,
    /// `FLAG_ALPHA_TESTED`, `FLAG_TWO_SIDED`.
    pub flags: u32,
}

/// What to build from.
#[derive(Clone, Copy, Debug, Default)]
pub struct BlasInput<'a> {
    /// Corners in object space.
    pub positions: &'a [[f32; 3]],
    /// Three positions a triangle.
    pub indices: &'a [[u32; 3]],
    /// One a triangle; or none: primitives then are the triangles' numbers, flags 0.
    pub attributes: &'a [TriangleAttributes],
    /// Spheres in object space: centre and radius.
    pub spheres: &'a [[f32; 4]],
    /// One a sphere; or none: primitives then go on from the number of triangles, flags 0.
    pub sphere_attributes: &'a [TriangleAttributes],
}

/// A bottom level, ready to be copied to a 16-byte-aligned device address.
#[derive(Clone, Debug, PartialEq)]
pub struct Blas {
    /// Nodes, then triangles and spheres; see [`crate::layout`].
    pub words: Vec<u32>,
    /// How many nodes.
    pub node_count: u32,
    /// How many triangles and spheres. Those in parts have a record for each.
    pub triangle_count: u32,
    /// Levels of nodes.
    pub depth: u32,
    /// Primitives left out: an index or coordinate out of range, no area, a radius that is not positive.
    pub skipped: u32,
    /// The box of all that is inside, in object space.
    pub bounds: Aabb,
}

impl Blas {
    /// Bytes on the device.
    pub fn size_bytes(&self) -> usize {
        self.words.len() * 4
    }

    /// The nodes.
    pub fn nodes(&self) -> &[Node] {
        bytemuck::cast_slice(&self.words[..self.first_triangle()])
    }

    /// The records of triangles and spheres, in the order of leaves.
    pub fn triangles(&self) -> &[Triangle] {
        bytemuck::cast_slice(&self.words[self.first_triangle()..])
    }

    fn first_triangle(&self) -> usize {
        self.node_count as usize * size_of::<Node>() / 4
    }
}

/// Builds a bottom level whose hits report triangle numbers of `indices`.
///
/// # Errors
/// [`BuildError::TooMany`] for more than 2^25 triangles.
pub fn build_blas(
    positions: &[[f32; 3]],
    indices: &[[u32; 3]],
    quality: Quality,
) -> Result<Blas, BuildError> {
    let input = BlasInput { positions, indices, ..BlasInput::default() };
    build_blas_with(&input, quality)
}

/// Builds a bottom level; the same input gives the same words, whatever the number of threads.
///
/// # Errors
/// [`BuildError`] where the input is too large or its attributes are not one a primitive.
pub fn build_blas_with(input: &BlasInput, quality: Quality) -> Result<Blas, BuildError> {
    let given = input.indices.len() + input.spheres.len();
    check_count(given)?;
    check_attributes(input.attributes, input.indices.len())?;
    check_attributes(input.sphere_attributes, input.spheres.len())?;
    let triangles = gather(input);
    let triangle_count = triangles.len();
    let mut boxes: Vec<Aabb> = triangles.iter().map(bounds_of).collect();
    let bounds = boxes.iter().fold(Aabb::EMPTY, |sum, &b| sum.union(b));
    let mut records = triangles;
    if quality != Quality::Fast {
        (records, boxes) = split(records, boxes);
    }
    let tree = match quality.reinserted() {
        None => build(&boxes, Split::SurfaceArea),
        Some(ratio) => build_well(&boxes, ratio),
    };
    let mut wide = encode(&tree, &boxes, MAX_LEAF, MOST_WAITING_BLAS);
    wide.place_leaves(TRIANGLE_UNITS);

    let mut words: Vec<u32> = Vec::new();
    words.extend_from_slice(bytemuck::cast_slice(&wide.nodes));
    for &place in &wide.order {
        words.extend_from_slice(bytemuck::cast_slice(&[records[place as usize]]));
    }
    Ok(Blas {
        words,
        node_count: wide.nodes.len() as u32,
        triangle_count: triangle_count as u32,
        depth: wide.depth,
        skipped: (given - triangle_count) as u32,
        bounds,
    })
}

fn check_attributes(attributes: &[TriangleAttributes], primitives: usize) -> Result<(), BuildError> {
    let attributes = attributes.len();
    if attributes != 0 && attributes != primitives {
        return Err(BuildError::AttributeCount { attributes, primitives });
    }
    Ok(())
}

/// The triangles and spheres that can be hit.
fn gather(input: &BlasInput) -> Vec<Triangle> {
    let attributes = |given: &[TriangleAttributes], number: usize, primitive: usize| {
        let numbered = TriangleAttributes { primitive: primitive as u32, flags: 0 };
        let TriangleAttributes { primitive, flags } = given.get(number).copied().unwrap_or(numbered);
        (primitive, flags & !FLAG_SPHERE)
    };
    let triangle = |(number, corners): (usize, &[u32; 3])| {
        let vertices = corners_of(input.positions, corners)?;
        let (primitive, flags) = attributes(input.attributes, number, number);
        Some(Triangle { vertices, primitive, flags, reserved: 0 })
    };
    let sphere = |(number, &given): (usize, &[f32; 4])| {
        let sphere = sphere_of(given)?;
        let (primitive, flags) = attributes(input.sphere_attributes, number, input.indices.len() + number);
        Some(Triangle::from_sphere(sphere, primitive, flags))
    };
    let triangles = input.indices.iter().enumerate().filter_map(triangle);
    triangles.chain(input.spheres.iter().enumerate().filter_map(sphere)).collect()
}

/// The sphere, None where it cannot be hit or would upset the tree.
fn sphere_of([x, y, z, radius]: [f32; 4]) -> Option<Sphere> {
    let reach = x.abs().max(y.abs()).max(z.abs()) + radius;
    // `max` passes over NaN, so each coordinate is asked.
    let placed = [x, y, z].iter().all(|c| c.is_finite()) && reach <= LARGEST_COORDINATE;
    (placed && radius > 0.0).then_some(Sphere { centre: [x, y, z], radius })
}

/// The corners, None where the triangle cannot be hit or would upset the tree.
pub(crate) fn corners_of(positions: &[[f32; 3]], corners: &[u32; 3]) -> Option<[[f32; 3]; 3]> {
    let mut vertices = [[0.0; 3]; 3];
    for (vertex, &corner) in vertices.iter_mut().zip(corners) {
        *vertex = *positions.get(corner as usize)?;
        // NaN fails the comparison too.
        if !vertex.iter().all(|c| c.abs() <= LARGEST_COORDINATE) {
            return None;
        }
    }
    let [a, b, c] = vertices.map(|v| Vec3::from(v).as_dvec3());
    let area_doubled = (b - a).cross(c - a).length();
    (area_doubled > 0.0).then_some(vertices)
}

/// Both zeros are one, so that boxes do not depend on the order in which they are summed.
pub(crate) fn bounds_of(triangle: &Triangle) -> Aabb {
    match triangle.sphere() {
        Some(sphere) => bounds_of_sphere(&sphere),
        None => Aabb::around(&triangle.vertices.map(|corner| Vec3::from(corner) + 0.0)),
    }
}

/// Rounded outwards.
fn bounds_of_sphere(sphere: &Sphere) -> Aabb {
    let Sphere { centre, radius } = *sphere;
    Aabb {
        min: centre.map(|c| (c - radius).next_down()).into(),
        max: centre.map(|c| (c + radius).next_up()).into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Random;

    #[test]
    fn what_cannot_be_hit_is_left_out_and_numbers_stay() {
        let positions = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [f32::NAN, 0.0, 0.0],
            [f32::INFINITY, 0.0, 0.0],
            [1e30, 0.0, 0.0],
            [2.0, 0.0, 0.0],
        ];
        let indices =
            [[0, 1, 3], [0, 1, 1], [0, 1, 2], [0, 1, 6], [4, 1, 2], [5, 1, 2], [0, 1, 99], [6, 1, 2]];
        let blas = build_blas(&positions, &indices, Quality::Good).unwrap();
        assert_eq!((blas.triangle_count, blas.skipped), (2, 6));
        let mut primitives: Vec<u32> = blas.triangles().iter().map(|t| t.primitive).collect();
        primitives.sort_unstable();
        assert_eq!(primitives, [2, 7]);
        assert_eq!(blas.bounds.max, Vec3::new(2.0, 1.0, 0.0));
    }

    #[test]
    fn spheres_are_records_beside_triangles() {
        let spheres = [
            [1.0, 2.0, 3.0, 0.5],
            [0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, -1.0],
            [0.0, 0.0, 0.0, f32::NAN],
            [0.0, f32::NAN, 0.0, 1.0],
            [0.0, 0.0, f32::INFINITY, 1.0],
            [0.0, 0.0, 1.0, f32::INFINITY],
            [9e10, 0.0, 0.0, 9e10],
        ];
        let input = BlasInput {
            positions: &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            indices: &[[0, 1, 2]],
            spheres: &spheres,
            ..BlasInput::default()
        };
        let blas = build_blas_with(&input, Quality::Good).unwrap();
        assert_eq!((blas.triangle_count, blas.skipped), (2, 7));
        let mut records = blas.triangles().to_vec();
        records.sort_by_key(|record| record.primitive);
        assert_eq!(records[0].sphere(), None);
        assert_eq!(records[1].sphere(), Some(Sphere { centre: [1.0, 2.0, 3.0], radius: 0.5 }));
        assert_eq!(records[1].primitive, 1);
        assert!(blas.bounds.max.cmpgt(Vec3::new(1.5, 2.5, 3.5)).all());
    }

    #[test]
    fn coincident_triangles_stay_shallow() {
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let indices = vec![[0, 1, 2]; 30_000];
        for quality in [Quality::Fast, Quality::Good] {
            let blas = build_blas(&positions, &indices, quality).unwrap();
            assert_eq!(blas.triangle_count, 30_000);
            assert!(blas.depth <= 10, "{}", blas.depth);
        }
    }

    #[test]
    fn nothing_is_an_empty_structure() {
        let blas = build_blas(&[], &[], Quality::Good).unwrap();
        assert_eq!((blas.node_count, blas.triangle_count), (1, 0));
        assert!(blas.bounds.is_empty());
        assert_eq!(blas.nodes()[0], Node::EMPTY);
    }

    #[test]
    fn attributes_must_match() {
        let input = BlasInput {
            positions: &[[0.0; 3]],
            indices: &[[0; 3], [0; 3]],
            attributes: &[TriangleAttributes { primitive: 0, flags: 0 }],
            ..BlasInput::default()
        };
        assert_eq!(
            build_blas_with(&input, Quality::Fast),
            Err(BuildError::AttributeCount { attributes: 1, primitives: 2 })
        );
    }

    #[test]
    fn the_same_input_gives_the_same_words_on_any_number_of_threads() {
        let mut random = Random::new(5);
        let mut positions = Vec::new();
        let mut indices = Vec::new();
        for i in 0..10_000u32 {
            let at = random.vec3() * 50.0;
            for _ in 0..3 {
                positions.push((at + random.vec3()).to_array());
            }
            indices.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        for quality in [Quality::Fast, Quality::Good] {
            let on_threads = |threads: usize| {
                rayon::ThreadPoolBuilder::new()
                    .num_threads(threads)
                    .build()
                    .unwrap()
                    .install(|| build_blas(&positions, &indices, quality).unwrap())
            };
            assert_eq!(on_threads(1), on_threads(4));
        }
    }
}
