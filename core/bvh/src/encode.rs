//! From a binary tree to the nodes that shaders read: children in octant slots, boxes on 8-bit grids.

use crate::binary::{BinaryTree, Split, build};
use crate::bounds::Aabb;
use crate::collapse::{Plan, Shape};
use crate::layout::{NODE_UNITS, Node, WIDTH};
use bytemuck::Zeroable;
use glam::Vec3;

/// A wide tree, references not yet in units of a buffer.
#[derive(Debug)]
pub(crate) struct WideTree {
    /// The nodes, root first; `leaf_base` counts leaf records, `child_base` is final.
    pub nodes: Vec<Node>,
    /// The primitives in the order of the leaf records.
    pub order: Vec<u32>,
    /// Levels of nodes.
    pub depth: u32,
}

impl WideTree {
    /// Turns `leaf_base` into units: records of `leaf_units` follow the nodes.
    pub fn place_leaves(&mut self, leaf_units: u32) {
        let start = self.nodes.len() as u32 * NODE_UNITS;
        for node in &mut self.nodes {
            node.leaf_base = start + node.leaf_base * leaf_units;
        }
    }
}

impl WideTree {
    /// Makes `slot` of `node` a leaf of `members`.
    fn append_leaf(&mut self, node: &mut Node, slot: usize, members: &[u32]) {
        let offset = self.order.len() as u32 - node.leaf_base;
        let ones = (1u32 << members.len()) - 1;
        node.meta[slot] = (ones << 5 | offset) as u8;
        self.order.extend_from_slice(members);
    }

    /// Makes `slot` of `node` an inner node, yet to be written; returns its place.
    fn append_inner(&mut self, node: &mut Node, slot: usize) -> usize {
        node.inner_mask |= 1 << slot;
        node.meta[slot] = 0x20 | (24 + slot as u8);
        self.nodes.push(Node::zeroed());
        self.nodes.len() - 1
    }
}

/// Encodes `tree`; if that would be deeper than `max_depth`, a balanced tree over the same `boxes`.
pub(crate) fn encode(tree: &BinaryTree, boxes: &[Aabb], max_leaf: u32, max_depth: u32) -> WideTree {
    let wide = encode_plan(tree, &Plan::new(tree, max_leaf, Shape::SurfaceArea));
    if wide.depth <= max_depth {
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
        WideTree { nodes: vec![Node::zeroed()], order: Vec::with_capacity(tree.order.len()), depth: 1 };
    if tree.nodes.is_empty() {
        return wide;
    }
    let mut children = Vec::with_capacity(WIDTH);
    let mut pending = vec![Pending { binary: 0, place: 0, depth: 1 }];
    while let Some(Pending { binary, place, depth }) = pending.pop() {
        wide.depth = wide.depth.max(depth);
        plan.children(binary, &mut children);
        let slots = assign_slots(tree, binary, &children);
        let mut node = start_node(&tree.nodes[binary].bounds);
        node.child_base = wide.nodes.len() as u32 * NODE_UNITS;
        node.leaf_base = wide.order.len() as u32;
        for (slot, child) in slots.into_iter().enumerate() {
            let Some(child) = child else { continue };
            let below = &tree.nodes[child];
            set_child_bounds(&mut node, slot, &below.bounds);
            if plan.is_leaf(child) {
                let members = below.first as usize..(below.first + below.count) as usize;
                wide.append_leaf(&mut node, slot, &tree.order[members]);
            } else {
                let place = wide.append_inner(&mut node, slot);
                pending.push(Pending { binary: child, place, depth: depth + 1 });
            }
        }
        wide.nodes[place] = node;
    }
    wide
}

/// Gives each child a slot, so that slots sort the children along rays of any octant: greedily the
/// pair of child and free slot whose direction fits best.
fn assign_slots(tree: &BinaryTree, parent: usize, children: &[usize]) -> [Option<usize>; WIDTH] {
    let centre = tree.nodes[parent].bounds.centroid_doubled();
    let mut fit = [[f32::NEG_INFINITY; WIDTH]; WIDTH];
    for (fit, &child) in fit.iter_mut().zip(children) {
        let towards = tree.nodes[child].bounds.centroid_doubled() - centre;
        for (slot, fit) in fit.iter_mut().enumerate() {
            *fit = towards.dot(slot_direction(slot));
        }
    }
    let mut slots = [None; WIDTH];
    let mut placed = [false; WIDTH];
    for _ in 0..children.len() {
        let mut best = None;
        for child in (0..children.len()).filter(|&child| !placed[child]) {
            for slot in (0..WIDTH).filter(|&slot| slots[slot].is_none()) {
                let better = best.is_none_or(|(c, s): (usize, usize)| fit[child][slot] > fit[c][s]);
                if better {
                    best = Some((child, slot));
                }
            }
        }
        if let Some((child, slot)) = best {
            placed[child] = true;
            slots[slot] = Some(children[child]);
        }
    }
    slots
}

/// Slot bits 2, 1, 0 are the signs of x, y, z: set is positive.
fn slot_direction(slot: usize) -> Vec3 {
    let sign = |bit: usize| if slot & bit != 0 { 1.0 } else { -1.0 };
    Vec3::new(sign(4), sign(2), sign(1))
}

/// A node without children whose grid spans `bounds`.
pub(crate) fn start_node(bounds: &Aabb) -> Node {
    let extent = bounds.max.as_dvec3() - bounds.min.as_dvec3();
    Node {
        origin: bounds.min.to_array().map(f32::to_bits),
        exponents: extent.to_array().map(spacing_exponent),
        ..Node::zeroed()
    }
}

/// The biased exponent of the least power of two that spans `extent` in 255 steps, at least 2^-100.
fn spacing_exponent(extent: f64) -> u8 {
    let exponent = ((extent / 255.0).to_bits() >> 52) as i32 - 1023 + 127;
    let exponent = exponent.clamp(27, 253) as u8;
    // The division's own exponent rounds down: at most one step is missing.
    exponent + u8::from(spacing(exponent) * 255.0 < extent)
}

/// 2 to the biased `exponent`.
fn spacing(exponent: u8) -> f64 {
    f64::from(f32::from_bits(u32::from(exponent) << 23))
}

/// Sets the box of `slot`, rounded outwards to the grid.
pub(crate) fn set_child_bounds(node: &mut Node, slot: usize, bounds: &Aabb) {
    for axis in 0..3 {
        let origin = f64::from(f32::from_bits(node.origin[axis]));
        let scale = 1.0 / spacing(node.exponents[axis]);
        let plane = |coordinate: f32| (f64::from(coordinate) - origin) * scale;
        node.low[axis][slot] = plane(bounds.min[axis]).floor().clamp(0.0, 255.0) as u8;
        node.high[axis][slot] = plane(bounds.max[axis]).ceil().clamp(0.0, 255.0) as u8;
    }
}

/// The box of `slot` as the grid has it, in f64.
#[cfg(test)]
pub(crate) fn child_bounds(node: &Node, slot: usize) -> (glam::DVec3, glam::DVec3) {
    let plane = |axis: usize, q: u8| {
        let origin = f64::from(f32::from_bits(node.origin[axis]));
        origin + f64::from(q) * spacing(node.exponents[axis])
    };
    (
        [0, 1, 2].map(|axis| plane(axis, node.low[axis][slot])).into(),
        [0, 1, 2].map(|axis| plane(axis, node.high[axis][slot])).into(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::MAX_LEAF;
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
            let (low, high) = child_bounds(node, slot);
            if node.inner_mask & (1 << slot) != 0 {
                let before = (node.inner_mask & ((1 << slot) - 1)).count_ones();
                let child = (node.child_base / NODE_UNITS + before) as usize;
                let inner = &wide.nodes[child];
                let origin = Vec3::from(inner.origin.map(f32::from_bits)).as_dvec3();
                assert!(origin.cmpge(low).all() && origin.cmple(high).all());
                walk(wide, child, boxes, seen);
                continue;
            }
            let count = (node.meta[slot] >> 5).count_ones();
            let first = node.leaf_base + u32::from(node.meta[slot] & 31);
            for &primitive in &wide.order[first as usize..(first + count) as usize] {
                let bounds = &boxes[primitive as usize];
                assert!(low.cmple(bounds.min.as_dvec3()).all());
                assert!(high.cmpge(bounds.max.as_dvec3()).all());
                seen.push(primitive);
            }
        }
    }

    #[test]
    fn quantised_boxes_hold_their_primitives() {
        for (count, scale) in [(1, 1.0), (5, 1e-12), (300, 1e10), (4000, 30.0)] {
            let boxes = soup(count, scale);
            let tree = build(&boxes, Split::SurfaceArea);
            let wide = encode(&tree, &boxes, MAX_LEAF, 20);
            let mut seen = Vec::new();
            walk(&wide, 0, &boxes, &mut seen);
            seen.sort_unstable();
            assert!(seen.into_iter().eq(0..count as u32));
        }
    }

    #[test]
    fn a_tree_too_deep_is_rebuilt_balanced() {
        let boxes = soup(4000, 1.0);
        let tree = build(&boxes, Split::SurfaceArea);
        let wide = encode(&tree, &boxes, MAX_LEAF, 4);
        assert_eq!(wide.depth, 4);
        assert_eq!(wide.order.len(), 4000);
    }

    #[test]
    fn slots_follow_octants() {
        let corners: Vec<Aabb> = (0..8)
            .map(|slot| slot_direction(7 - slot))
            .map(|corner| Aabb::around(&[corner * 5.0, corner * 6.0]))
            .collect();
        let tree = build(&corners, Split::SurfaceArea);
        let wide = encode(&tree, &corners, 1, 4);
        let node = &wide.nodes[0];
        for slot in 0..WIDTH {
            let primitive = wide.order[usize::from(node.meta[slot] & 31)];
            assert_eq!(primitive as usize, 7 - slot);
        }
    }

    #[test]
    fn the_grid_spans_the_extent() {
        for extent in [0.0, 1e-30, 0.999, 255.0, 255.001, 2e11] {
            let exponent = spacing_exponent(extent);
            assert!(spacing(exponent) * 255.0 >= extent);
            assert!(exponent == 27 || spacing(exponent - 1) * 255.0 < extent);
        }
    }
}
