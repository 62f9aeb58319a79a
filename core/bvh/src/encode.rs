//! From a binary tree to the nodes that shaders read.

use crate::binary::{BinaryTree, Split, build};
use crate::bounds::Aabb;
use crate::collapse::{Plan, Shape};
use crate::layout::{Child, NODE_UNITS, Node, WIDTH};

/// A wide tree whose leaf records have no place in a buffer yet.
#[derive(Debug)]
pub(crate) struct WideTree {
    /// The nodes, root first, children after their parents and beside their siblings. The places of leaves count records.
    pub nodes: Vec<Node>,
    /// The primitives in the order of the leaf records.
    pub order: Vec<u32>,
    /// Levels of nodes.
    pub depth: u32,
}

impl WideTree {
    /// Turns leaves' places into units: records of `leaf_units` follow the nodes.
    pub fn place_leaves(&mut self, leaf_units: u32) {
        let start = self.nodes.len() as u32 * NODE_UNITS;
        for reference in self.nodes.iter_mut().flat_map(|node| &mut node.children) {
            if let Child::Leaf { place, count } = Child::of(*reference) {
                *reference = Child::Leaf { place: start + place * leaf_units, count }.reference();
            }
        }
    }

    /// The most children that wait while a ray is somewhere in the tree, in the worst order.
    fn most_waiting(&self) -> u32 {
        let mut waiting = vec![0; self.nodes.len()];
        for (place, node) in self.nodes.iter().enumerate().rev() {
            let children = node.children.map(Child::of);
            let others = children.iter().filter(|&&child| child != Child::Nothing).count() as u32;
            let below = children.iter().map(|child| match child {
                Child::Inner(unit) => waiting[(unit / NODE_UNITS) as usize],
                _ => 0,
            });
            waiting[place] = others.saturating_sub(1) + below.max().unwrap_or(0);
        }
        waiting[0]
    }
}

/// Encodes `tree`; if more than `most_waiting` children could have to wait in it, a balanced tree over the same `boxes`.
pub(crate) fn encode(tree: &BinaryTree, boxes: &[Aabb], max_leaf: u32, most_waiting: u32) -> WideTree {
    let wide = encode_plan(tree, &Plan::new(tree, max_leaf, Shape::SurfaceArea));
    if wide.most_waiting() <= most_waiting {
        return wide;
    }
    let tree = build(boxes, Split::Median);
    encode_plan(&tree, &Plan::new(&tree, max_leaf, Shape::Balanced))
}

/// A wide node still to be written.
struct Pending {
    binary: usize,
    place: usize,
    depth: u32,
}

fn encode_plan(tree: &BinaryTree, plan: &Plan) -> WideTree {
    let mut wide =
        WideTree { nodes: vec![Node::EMPTY], order: Vec::with_capacity(tree.order.len()), depth: 1 };
    if tree.nodes.is_empty() {
        return wide;
    }
    let mut children = Vec::with_capacity(WIDTH);
    let mut pending = vec![Pending { binary: 0, place: 0, depth: 1 }];
    while let Some(Pending { binary, place, depth }) = pending.pop() {
        wide.depth = wide.depth.max(depth);
        plan.children(binary, &mut children);
        let mut node = Node::EMPTY;
        for (slot, &child) in children.iter().enumerate() {
            let below = &tree.nodes[child];
            node.set_bounds(slot, &below.bounds);
            let holds = if plan.is_leaf(child) {
                let first = wide.order.len() as u32;
                let members = below.first as usize..(below.first + below.count) as usize;
                wide.order.extend_from_slice(&tree.order[members]);
                Child::Leaf { place: first, count: below.count }
            } else {
                let place = wide.nodes.len();
                wide.nodes.push(Node::EMPTY);
                pending.push(Pending { binary: child, place, depth: depth + 1 });
                Child::Inner(place as u32 * NODE_UNITS)
            };
            node.children[slot] = holds.reference();
        }
        wide.nodes[place] = node;
    }
    wide
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::{MAX_LEAF, MOST_WAITING_BLAS};
    use crate::testing::Random;

    fn soup(count: usize, scale: f32) -> Vec<Aabb> {
        let mut random = Random::new(11);
        (0..count)
            .map(|_| {
                let at = random.vec3() * scale;
                Aabb::around(&[at, at + random.vec3() * scale * 0.01])
            })
            .collect()
    }

    /// Visits every leaf record below `place` with the boxes that lead to it.
    fn walk(wide: &WideTree, place: usize, boxes: &[Aabb], seen: &mut Vec<u32>) {
        let node = &wide.nodes[place];
        for slot in 0..WIDTH {
            let bounds = node.bounds(slot);
            let holds = |inner: Aabb| bounds.union(inner) == bounds;
            match Child::of(node.children[slot]) {
                Child::Nothing => assert!(bounds.is_empty()),
                Child::Inner(unit) => {
                    let child = (unit / NODE_UNITS) as usize;
                    let inner = &wide.nodes[child];
                    let children =
                        (0..WIDTH).filter(|&slot| Child::of(inner.children[slot]) != Child::Nothing);
                    assert!(children.into_iter().all(|slot| holds(inner.bounds(slot))));
                    assert!(child > place);
                    walk(wide, child, boxes, seen);
                }
                Child::Leaf { place, count } => {
                    for &primitive in &wide.order[place as usize..(place + count) as usize] {
                        assert!(holds(boxes[primitive as usize]));
                        seen.push(primitive);
                    }
                }
            }
        }
    }

    #[test]
    fn boxes_hold_their_primitives() {
        for (count, scale) in [(1, 1.0), (5, 1e-12), (300, 1e10), (4000, 30.0)] {
            let boxes = soup(count, scale);
            let tree = build(&boxes, Split::SurfaceArea);
            let wide = encode(&tree, &boxes, MAX_LEAF, MOST_WAITING_BLAS);
            let mut seen = Vec::new();
            walk(&wide, 0, &boxes, &mut seen);
            seen.sort_unstable();
            assert!(seen.into_iter().eq(0..count as u32));
        }
    }

    #[test]
    fn a_tree_too_deep_is_rebuilt_balanced() {
        let boxes = soup(4096, 1.0);
        let tree = build(&boxes, Split::SurfaceArea);
        let wide = encode(&tree, &boxes, 1, 18);
        assert_eq!((wide.depth, wide.most_waiting()), (6, 18));
        assert_eq!(wide.order.len(), 4096);
    }
}
