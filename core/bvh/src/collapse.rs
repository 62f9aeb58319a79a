//! Which nodes of a binary tree become nodes of the four-wide tree, and which become leaves: the
//! choice of least surface-area cost, by dynamic programming (Ylitie, Karras and Laine 2017,
//! section 3.1).

use crate::binary::BinaryTree;
use crate::layout::WIDTH;

/// Cost of visiting a wide node.
const COST_NODE: f32 = 1.0;
/// Cost of one leaf record, relative to a node.
const COST_LEAF: f32 = 0.8;

/// How children are gathered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Least expected cost.
    SurfaceArea,
    /// Two levels of the binary tree a node: depth log4 of the count over a balanced tree.
    Balanced,
}

/// The plan of a wide tree over a binary one.
pub(crate) struct Plan<'a> {
    tree: &'a BinaryTree,
    max_leaf: u32,
    /// Empty when balanced.
    choices: Vec<Choice>,
}

/// The best ways to show one binary node as at most i + 1 children of a wide node.
#[derive(Clone, Copy)]
struct Choice {
    /// Least costs, i = 0..3.
    cost: [f32; WIDTH - 1],
    /// Slots that go to the left child; 0: no better than with one slot fewer. `share[0]` is unused.
    share: [u8; WIDTH],
    /// As one child: a leaf rather than a wide node.
    leaf: bool,
}

impl<'a> Plan<'a> {
    /// Plans with at most `max_leaf` primitives a leaf.
    pub fn new(tree: &'a BinaryTree, max_leaf: u32, shape: Shape) -> Self {
        let choices = match shape {
            Shape::SurfaceArea => choose(tree, max_leaf),
            Shape::Balanced => Vec::new(),
        };
        Self { tree, max_leaf, choices }
    }

    /// Whether binary node `node`, as a child, is a leaf.
    pub fn is_leaf(&self, node: usize) -> bool {
        match self.choices.get(node) {
            Some(choice) => choice.leaf,
            None => self.tree.nodes[node].count <= self.max_leaf,
        }
    }

    /// The children of the wide node that stands for binary node `node`: one to four.
    pub fn children(&self, node: usize, children: &mut Vec<usize>) {
        children.clear();
        if self.tree.is_leaf(node) {
            children.push(node);
            return;
        }
        self.distribute(node, WIDTH, children);
    }

    /// Shares `slots` (two or more) among the children of an inner binary node.
    fn distribute(&self, node: usize, slots: usize, children: &mut Vec<usize>) {
        let [left, right] = self.tree.children(node);
        let share = match self.choices.get(node) {
            Some(choice) => choice.share[slots - 1] as usize,
            None => slots / 2,
        };
        self.show(left, share, children);
        self.show(right, slots - share, children);
    }

    /// Appends what stands for binary node `node` in at most `slots` slots.
    fn show(&self, node: usize, mut slots: usize, children: &mut Vec<usize>) {
        match self.choices.get(node) {
            Some(choice) => {
                while slots > 1 && choice.share[slots - 1] == 0 {
                    slots -= 1;
                }
            }
            None if self.is_leaf(node) => slots = 1,
            None => {}
        }
        if slots == 1 {
            children.push(node);
        } else {
            self.distribute(node, slots, children);
        }
    }
}

/// Costs bottom-up: in preorder children follow their parents.
fn choose(tree: &BinaryTree, max_leaf: u32) -> Vec<Choice> {
    let unset = Choice { cost: [0.0; WIDTH - 1], share: [0; WIDTH], leaf: true };
    let mut choices = vec![unset; tree.nodes.len()];
    for node in (0..tree.nodes.len()).rev() {
        choices[node] = choose_node(tree, node, max_leaf, &choices);
    }
    choices
}

fn choose_node(tree: &BinaryTree, node: usize, max_leaf: u32, choices: &[Choice]) -> Choice {
    let count = tree.nodes[node].count;
    let area = tree.nodes[node].bounds.half_area();
    let cost_leaf = area * count as f32 * COST_LEAF;
    if tree.is_leaf(node) {
        return Choice { cost: [cost_leaf; WIDTH - 1], share: [0; WIDTH], leaf: true };
    }
    let [left, right] = tree.children(node);
    let (left, right) = (&choices[left].cost, &choices[right].cost);
    let (share_all, cost_all) = best_share(left, right, WIDTH);
    let cost_node = area * COST_NODE + cost_all;
    let leaf = count <= max_leaf && cost_leaf <= cost_node;

    let mut choice =
        Choice { cost: [if leaf { cost_leaf } else { cost_node }; WIDTH - 1], share: [0; WIDTH], leaf };
    choice.share[WIDTH - 1] = share_all;
    for slots in 2..WIDTH {
        let (share, cost) = best_share(left, right, slots);
        let fewer = choice.cost[slots - 2];
        // Of equal costs (boxes without area have none) the wider.
        if cost <= fewer {
            choice.share[slots - 1] = share;
            choice.cost[slots - 1] = cost;
        } else {
            choice.cost[slots - 1] = fewer;
        }
    }
    choice
}

/// The best number of `slots` to give the left child, and the cost.
fn best_share(left: &[f32; WIDTH - 1], right: &[f32; WIDTH - 1], slots: usize) -> (u8, f32) {
    let mut best = (1, f32::INFINITY);
    for share in 1..slots {
        let cost = left[share - 1] + right[slots - share - 1];
        if cost < best.1 {
            best = (share as u8, cost);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::binary::{Split, build};
    use crate::bounds::Aabb;
    use crate::testing::Random;

    /// Counts leaves' primitives below wide node `node`, checking the limits.
    fn walk(plan: &Plan, node: usize, max_leaf: u32, depth: u32) -> (u32, u32) {
        let mut children = Vec::new();
        plan.children(node, &mut children);
        assert!((1..=WIDTH).contains(&children.len()));
        let mut total = (0, depth);
        for child in children {
            if plan.is_leaf(child) {
                let count = plan.tree.nodes[child].count;
                assert!(count <= max_leaf);
                total.0 += count;
            } else {
                let (count, below) = walk(plan, child, max_leaf, depth + 1);
                total = (total.0 + count, total.1.max(below));
            }
        }
        total
    }

    #[test]
    fn every_primitive_is_in_one_leaf() {
        let mut random = Random::new(3);
        for count in [1usize, 2, 3, 4, 9, 500] {
            let boxes: Vec<Aabb> = (0..count)
                .map(|_| {
                    let at = random.vec3() * 10.0;
                    Aabb::around(&[at, at + random.vec3()])
                })
                .collect();
            let tree = build(&boxes, Split::SurfaceArea);
            for max_leaf in [1, 3] {
                let plan = Plan::new(&tree, max_leaf, Shape::SurfaceArea);
                assert_eq!(walk(&plan, 0, max_leaf, 1).0, count as u32);
            }
        }
    }

    #[test]
    fn balanced_depth_is_log4() {
        let boxes = vec![Aabb::around(&[glam::Vec3::ZERO]); 4096];
        let tree = build(&boxes, Split::Median);
        let plan = Plan::new(&tree, 1, Shape::Balanced);
        assert_eq!(walk(&plan, 0, 1, 1), (4096, 6));
    }
}
