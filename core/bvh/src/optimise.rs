//! Better trees: built from below by nearest neighbours (Meister and Bittner, Parallel Locally-Ordered Clustering for Bounding
//! Volume Hierarchy Construction, 2018), then improved by reinsertion of subtrees (Meister and Bittner, Parallel Reinsertion for
//! Bounding Volume Hierarchy Optimization, 2018). The `obvhs` crate implements both.

use crate::binary::{BinaryNode, BinaryTree, Split, build};
use crate::bounds::Aabb;
use obvhs::aabb::Aabb as ObvhsAabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use std::collections::HashSet;

/// The mean area of nodes, relative to that of all, from which on they overlap too much.
const MOST_OVERLAP: f32 = 0.1;
/// Fewer primitives have the tree of the surface-area heuristic.
const LEAST_CLUSTERED: usize = 8;
/// Depth from which on clusters look at their next neighbours only.
const NEAR_SEARCH_FROM: usize = 2;

/// A good tree over `boxes`, none of which may be empty: the better one of two, improved. A round of reinsertion looks at a share
/// `ratio` of the nodes.
pub(crate) fn build_well(boxes: &[Aabb], ratio: f32) -> BinaryTree {
    let mut tree = build(boxes, Split::SurfaceArea);
    if boxes.len() < LEAST_CLUSTERED || overlaps_all_over(&tree) {
        return tree;
    }
    if !repeats(boxes) {
        let clustered = from_obvhs(&cluster(boxes), boxes);
        if area(&clustered) < area(&tree) {
            tree = clustered;
        }
    }
    let mut theirs = to_obvhs(&tree);
    ReinsertionOptimizer::default().run(&mut theirs, ratio, None);
    from_obvhs(&theirs, boxes)
}

fn cluster(boxes: &[Aabb]) -> Bvh2 {
    let theirs: Vec<ObvhsAabb> =
        boxes.iter().map(|b| ObvhsAabb::new(b.min.to_array().into(), b.max.to_array().into())).collect();
    PlocBuilder::with_capacity(theirs.len()).build(
        PlocSearchDistance::High,
        &theirs,
        (0..boxes.len() as u32).collect(),
        SortPrecision::U128,
        NEAR_SEARCH_FROM,
    )
}

/// What rays through a tree cost, by the surface-area heuristic, but for a factor.
fn area(tree: &BinaryTree) -> f32 {
    tree.nodes.iter().map(|node| node.bounds.half_area()).sum()
}

/// Whether many boxes are the same: among those nobody is nearest, and clusters would grow by one at a time.
fn repeats(boxes: &[Aabb]) -> bool {
    let bits = |b: &Aabb| [b.min, b.max].map(|corner| corner.to_array().map(f32::to_bits));
    let distinct = boxes.iter().map(bits).collect::<HashSet<_>>().len();
    distinct < boxes.len() - boxes.len() / 8
}

/// Whether nodes are about as large as all together, as of primitives that lie upon one another: reinsertion could gain nothing,
/// and would look at every node for every other.
fn overlaps_all_over(tree: &BinaryTree) -> bool {
    area(tree) >= MOST_OVERLAP * tree.nodes.len() as f32 * tree.nodes[0].bounds.half_area()
        && tree.nodes.len() > 1000
}

/// The tree in their form: siblings side by side, the root at 0.
fn to_obvhs(tree: &BinaryTree) -> Bvh2 {
    let mut nodes = vec![Bvh2Node::default(); tree.nodes.len()];
    let mut free = 1;
    let mut pending = vec![(0usize, 0usize)];
    while let Some((ours, theirs)) = pending.pop() {
        let node = &tree.nodes[ours];
        let bounds = ObvhsAabb::new(node.bounds.min.into(), node.bounds.max.into());
        if tree.is_leaf(ours) {
            nodes[theirs] = Bvh2Node::new(bounds, 1, node.first);
            continue;
        }
        nodes[theirs] = Bvh2Node::new(bounds, 0, free as u32);
        let [left, right] = tree.children(ours);
        pending.push((left, free));
        pending.push((right, free + 1));
        free += 2;
    }
    Bvh2 {
        nodes,
        primitive_indices: tree.order.clone(),
        children_are_ordered_after_parents: true,
        ..Bvh2::default()
    }
}

/// Back to preorder, boxes anew from the primitives.
fn from_obvhs(theirs: &Bvh2, boxes: &[Aabb]) -> BinaryTree {
    let mut tree =
        BinaryTree { nodes: Vec::with_capacity(theirs.nodes.len()), order: Vec::with_capacity(boxes.len()) };
    let mut pending = vec![0usize];
    while let Some(place) = pending.pop() {
        let node = &theirs.nodes[place];
        let first = tree.order.len() as u32;
        let mut bounds = Aabb::EMPTY;
        let mut count = 0;
        if node.is_leaf() {
            let primitive = theirs.primitive_indices[node.first_index as usize];
            tree.order.push(primitive);
            bounds = boxes[primitive as usize];
            count = 1;
        } else {
            pending.push(node.first_index as usize + 1);
            pending.push(node.first_index as usize);
        }
        tree.nodes.push(BinaryNode { bounds, first, count });
    }
    sum_up(&mut tree);
    tree
}

/// Fills the counts and boxes of inner nodes (count 0 so far) from their children.
fn sum_up(tree: &mut BinaryTree) {
    for node in (0..tree.nodes.len()).rev() {
        if tree.nodes[node].count != 0 {
            continue;
        }
        let [left, right] = tree.children(node).map(|child| tree.nodes[child]);
        tree.nodes[node].count = left.count + right.count;
        tree.nodes[node].bounds = left.bounds.union(right.bounds);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Random;

    #[test]
    fn all_primitives_are_in_a_tree_of_low_cost() {
        let mut random = Random::new(9);
        let boxes: Vec<Aabb> = (0..2000)
            .map(|_| {
                let at = random.vec3() * 10.0;
                Aabb::around(&[at, at + random.vec3()])
            })
            .collect();
        let before = build(&boxes, Split::SurfaceArea);
        let after = build_well(&boxes, 0.2);
        let mut seen = after.order.clone();
        seen.sort_unstable();
        assert!(seen.into_iter().eq(0..2000));
        assert_eq!(after.nodes[0].bounds, before.nodes[0].bounds);
        assert!(area(&after) < area(&before));
    }

    #[test]
    fn a_flat_grid_and_what_lies_upon_one_another_are_built_soon() {
        let square = |i: u32, width: u32| {
            let corner = glam::Vec3::new((i % width) as f32, 0.0, (i / width) as f32);
            Aabb::around(&[corner, corner + glam::Vec3::new(1.0, 0.0, 1.0)])
        };
        let grid: Vec<Aabb> = (0..40_000).map(|i| square(i, 200)).collect();
        let pile: Vec<Aabb> = (0..40_000).map(|i| square(i % 7, 200)).collect();
        let halves: Vec<Aabb> = (0..40_000).map(|i| square(i / 2, 200)).collect();
        for boxes in [grid, pile, halves] {
            let start = std::time::Instant::now();
            assert_eq!(build_well(&boxes, 1.0).order.len(), 40_000);
            assert!(start.elapsed().as_secs() < 30);
        }
    }
}
