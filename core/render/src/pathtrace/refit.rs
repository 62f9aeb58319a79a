//! Bottom levels of the software backend that change: moved with their triangles while that costs rays little.

use afterglow_bvh::Blas;
use afterglow_bvh::layout::{Child, Node, WIDTH};
use afterglow_records::MEMBER_SHIFT;

use super::structures::Member;

/// The cost of a moved structure, as a multiple of what it was when it was built, from which on it is built anew.
pub(super) const MOST_COST: f32 = 1.5;

/// A bottom level as the processor has it.
pub(super) struct Movable {
    pub(super) blas: Blas,
    built_cost: f32,
}

impl Movable {
    /// A structure that was built.
    pub(super) fn new(blas: Blas) -> Self {
        Self { built_cost: cost(&blas), blas }
    }

    /// Moves the triangles of members to three corners each. None if rays would get too slow.
    pub(super) fn moved(mut self, corners: &[[f32; 3]], members: &[Member]) -> Option<Self> {
        let of = triangle_of(members);
        self.blas.refit(corners, |primitive| {
            let triangle = of(primitive);
            [3 * triangle, 3 * triangle + 1, 3 * triangle + 2]
        });
        // What is not a number fails the comparison.
        (cost(&self.blas) <= MOST_COST * self.built_cost).then_some(self)
    }
}

/// Finds the number of a triangle among the members', by what a hit reports of it.
pub(super) fn triangle_of(members: &[Member]) -> impl Fn(u32) -> u32 + use<> {
    let firsts: Vec<u32> = members
        .iter()
        .scan(0, |before, member| {
            let first = *before;
            *before += member.triangles;
            Some(first)
        })
        .collect();
    move |primitive| {
        let member = (primitive >> MEMBER_SHIFT) as usize;
        // One that is not there has no corners.
        let first = firsts.get(member).copied().unwrap_or(u32::MAX / 8);
        first + (primitive & ((1 << MEMBER_SHIFT) - 1))
    }
}

/// What a ray through the structure's box costs, by the surface-area heuristic: a unit for each child and triangle that it is
/// expected to be tested against.
pub(super) fn cost(blas: &Blas) -> f32 {
    let area: f32 = blas.nodes().iter().map(children_area).sum();
    area / blas.bounds.half_area()
}

/// Half the areas of a node's children, those of leaves once a triangle.
fn children_area(node: &Node) -> f32 {
    let slot_area = |slot: usize| match Child::of(node.children[slot]) {
        Child::Nothing => 0.0,
        Child::Inner(_) => node.bounds(slot).half_area(),
        Child::Leaf { count, .. } => node.bounds(slot).half_area() * count as f32,
    };
    (0..WIDTH).map(slot_area).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use afterglow_bvh::{BlasInput, Quality, TriangleAttributes, build_blas_with};

    const MEMBERS: [Member; 2] = [Member { triangles: 60, is_alpha_tested: false }; 2];

    /// A row of triangles a unit apart, each moved aside by its own length.
    fn corners(aside: impl Fn(usize) -> f32) -> Vec<[f32; 3]> {
        (0..120)
            .flat_map(|number| {
                let (x, y) = (number as f32, aside(number));
                [[x, y, 0.0], [x + 0.5, y, 0.0], [x, y + 0.5, 0.1]]
            })
            .collect()
    }

    fn built(corners: &[[f32; 3]]) -> Movable {
        let indices: Vec<_> =
            (0..120).map(|triangle| [0, 1, 2].map(|corner| 3 * triangle + corner)).collect();
        let attributes: Vec<_> = (0..120_u32)
            .map(|triangle| TriangleAttributes {
                primitive: ((triangle / 60) << MEMBER_SHIFT) | (triangle % 60),
                flags: 0,
            })
            .collect();
        let input = BlasInput {
            positions: corners,
            indices: &indices,
            attributes: &attributes,
            ..BlasInput::default()
        };
        Movable::new(build_blas_with(&input, Quality::Fast).unwrap())
    }

    #[test]
    fn what_moves_a_little_keeps_its_structure() {
        let moved = corners(|number| (number as f32 * 0.1).sin());
        let movable = built(&corners(|_| 0.0)).moved(&moved, &MEMBERS).unwrap();
        for record in movable.blas.triangles() {
            let triangle = (record.primitive >> MEMBER_SHIFT) * 60 + (record.primitive & 0xffff);
            assert_eq!(record.vertices, moved[3 * triangle as usize..][..3]);
        }
    }

    #[test]
    fn what_is_shuffled_is_built_anew() {
        let shuffled: Vec<_> =
            (0..120).flat_map(|number| corners(|_| 0.0)[3 * (number * 77 % 120)..][..3].to_vec()).collect();
        assert!(built(&corners(|_| 0.0)).moved(&shuffled, &MEMBERS).is_none());
    }
}
