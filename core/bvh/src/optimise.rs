//! Better trees by reinsertion of subtrees (Meister and Bittner, Parallel Reinsertion for Bounding
//! Volume Hierarchy Optimization, 2018), which the `obvhs` crate implements.

use crate::binary::{BinaryNode, BinaryTree};
use crate::bounds::Aabb;
use obvhs::aabb::Aabb as ObvhsAabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;

/// The mean area of nodes, relative to that of all, from which on they overlap too much.
const MOST_OVERLAP: f32 = 0.1;

/// The same primitives in a tree of no greater cost; a round looks at a share `ratio` of the nodes.
pub(crate) fn optimise(tree: BinaryTree, boxes: &[Aabb], ratio: f32) -> BinaryTree {
    if tree.nodes.len() < 7 || overlaps_all_over(&tree) {
        return tree;
    }
    let mut theirs = to_obvhs(&tree);
    ReinsertionOptimizer::default().run(&mut theirs, ratio, None);
    from_obvhs(&theirs, boxes)
}

/// Whether nodes are about as large as all together, as of primitives that lie upon one another: reinsertion could gain nothing,
/// and would look at every node for every other.
fn overlaps_all_over(tree: &BinaryTree) -> bool {
    let total: f32 = tree.nodes.iter().map(|node| node.bounds.half_area()).sum();
    total >= MOST_OVERLAP * tree.nodes.len() as f32 * tree.nodes[0].bounds.half_area()
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
    use crate::binary::{Split, build};
    use crate::testing::Random;

    fn cost(tree: &BinaryTree) -> f32 {
        tree.nodes.iter().map(|n| n.bounds.half_area()).sum()
    }

    #[test]
    fn reinsertion_keeps_the_primitives_and_lowers_the_cost() {
        let mut random = Random::new(9);
        let boxes: Vec<Aabb> = (0..2000)
            .map(|_| {
                let at = random.vec3() * 10.0;
                Aabb::around(&[at, at + random.vec3()])
            })
            .collect();
        let before = build(&boxes, Split::SurfaceArea);
        let after = optimise(before.clone(), &boxes, 0.2);
        let mut seen = after.order.clone();
        seen.sort_unstable();
        assert!(seen.into_iter().eq(0..2000));
        assert_eq!(after.nodes[0].bounds, before.nodes[0].bounds);
        assert!(cost(&after) < cost(&before));
    }
}
