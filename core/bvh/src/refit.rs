//! A bottom level whose triangles moved: new boxes in the old tree, requantised node by node. The
//! model of a refit on the device.

use crate::blas::{Blas, bounds_of, corners_of};
use crate::bounds::Aabb;
use crate::encode::{set_child_bounds, start_node};
use crate::layout::{NODE_UNITS, Node, TRIANGLE_UNITS, Triangle, WIDTH};

impl Blas {
    /// Moves every triangle, but no sphere, to `corners(primitive)`, three of `positions`. Triangles are neither added
    /// nor taken away: those left out by the build stay out, and one that cannot be hit any more
    /// (index or coordinate out of range, no area) stays where it was. Rays get slower the more the
    /// shape changes; [`crate::build_blas`] anew then.
    pub fn refit(&mut self, positions: &[[f32; 3]], corners: impl Fn(u32) -> [u32; 3]) {
        let (nodes, triangles) = self.words.split_at_mut(self.node_count as usize * NODE_WORDS);
        let nodes: &mut [Node] = bytemuck::cast_slice_mut(nodes);
        let triangles: &mut [Triangle] = bytemuck::cast_slice_mut(triangles);
        for triangle in triangles.iter_mut().filter(|record| record.sphere().is_none()) {
            if let Some(moved) = corners_of(positions, &corners(triangle.primitive)) {
                triangle.vertices = moved;
            }
        }
        let mut bounds = vec![Aabb::EMPTY; nodes.len()];
        // Children follow their parents.
        for place in (0..nodes.len()).rev() {
            let children = children_bounds(&nodes[place], nodes.len() as u32, &bounds, triangles);
            bounds[place] = children.iter().flatten().fold(Aabb::EMPTY, |sum, &b| sum.union(b));
            refit_node(&mut nodes[place], &bounds[place], &children);
        }
        self.bounds = bounds[0];
    }
}

const NODE_WORDS: usize = size_of::<Node>() / 4;

/// The box of each slot that holds something.
fn children_bounds(
    node: &Node,
    node_count: u32,
    bounds: &[Aabb],
    triangles: &[Triangle],
) -> [Option<Aabb>; WIDTH] {
    let first_leaf = (node.leaf_base - node_count * NODE_UNITS) / TRIANGLE_UNITS;
    let mut inner = (node.child_base / NODE_UNITS) as usize..;
    let mut children = [None; WIDTH];
    for (slot, child) in children.iter_mut().enumerate() {
        let meta = u32::from(node.meta[slot]);
        if node.inner_mask & (1 << slot) != 0 {
            *child = inner.next().map(|place| bounds[place]);
        } else if meta != 0 {
            let first = (first_leaf + (meta & 31)) as usize;
            let members = &triangles[first..first + (meta >> 5).count_ones() as usize];
            let around = members.iter().map(bounds_of).fold(Aabb::EMPTY, Aabb::union);
            *child = Some(around);
        }
    }
    children
}

/// New grid and planes; what the slots hold stays.
fn refit_node(node: &mut Node, bounds: &Aabb, children: &[Option<Aabb>; WIDTH]) {
    if bounds.is_empty() {
        return;
    }
    let grid = start_node(bounds);
    node.origin = grid.origin;
    node.exponents = grid.exponents;
    for (slot, child) in children.iter().enumerate() {
        if let Some(child) = child {
            set_child_bounds(node, slot, child);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::Random;
    use crate::{Quality, build_blas};

    #[test]
    fn nothing_moved_changes_no_word() {
        let mut random = Random::new(4);
        let positions: Vec<[f32; 3]> = (0..900).map(|_| random.vec3().to_array()).collect();
        let indices: Vec<[u32; 3]> = (0..300).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let built = build_blas(&positions, &indices, Quality::Good).unwrap();
        let mut refitted = built.clone();
        refitted.refit(&positions, |primitive| indices[primitive as usize]);
        assert_eq!(refitted, built);
    }

    #[test]
    fn triangles_that_vanish_stay_where_they_were() {
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let built = build_blas(&positions, &[[0, 1, 2]], Quality::Fast).unwrap();
        let mut refitted = built.clone();
        refitted.refit(&[[f32::NAN; 3]; 3], |_| [0, 1, 2]);
        assert_eq!(refitted, built);
        let mut empty = build_blas(&[], &[], Quality::Fast).unwrap();
        empty.refit(&positions, |_| [0, 1, 2]);
        assert_eq!(empty.triangle_count, 0);
    }
}
