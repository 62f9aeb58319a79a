//! A bottom level whose triangles moved: new boxes in the old tree. The twin of a refit on the
//! device (`shaders/pass/refit`).

use crate::blas::{Blas, bounds_of, corners_of};
use crate::bounds::Aabb;
use crate::layout::{Child, NODE_UNITS, Node, TRIANGLE_UNITS, Triangle, WIDTH};

impl Blas {
    /// Moves every triangle, but no sphere, to `corners(primitive)`, three of `positions`. Triangles are neither added
    /// nor taken away: those left out by the build stay out, and one that cannot be hit any more
    /// (index or coordinate out of range, no area) stays where it was. Rays get slower the more the
    /// shape changes; [`crate::build_blas`] anew then. Boxes become those of whole triangles, of split ones too.
    pub fn refit(&mut self, positions: &[[f32; 3]], corners: impl Fn(u32) -> [u32; 3]) {
        let (nodes, triangles) = self.words.split_at_mut(self.node_count as usize * NODE_WORDS);
        let nodes: &mut [Node] = bytemuck::cast_slice_mut(nodes);
        let triangles: &mut [Triangle] = bytemuck::cast_slice_mut(triangles);
        for triangle in triangles.iter_mut().filter(|record| record.sphere().is_none()) {
            if let Some(moved) = corners_of(positions, &corners(triangle.primitive)) {
                triangle.vertices = moved;
            }
        }
        let first_leaf = nodes.len() as u32 * NODE_UNITS;
        // Children follow their parents.
        for place in (0..nodes.len()).rev() {
            let mut node = nodes[place];
            for slot in 0..WIDTH {
                let bounds = match Child::of(node.children[slot]) {
                    Child::Nothing => continue,
                    Child::Inner(unit) => around_children(&nodes[(unit / NODE_UNITS) as usize]),
                    Child::Leaf { place, count } => {
                        let first = ((place - first_leaf) / TRIANGLE_UNITS) as usize;
                        let members = &triangles[first..first + count as usize];
                        members.iter().map(bounds_of).fold(Aabb::EMPTY, Aabb::union)
                    }
                };
                node.set_bounds(slot, &bounds);
            }
            nodes[place] = node;
        }
        self.bounds = around_children(&nodes[0]);
    }
}

/// A tree's nodes by their levels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Levels {
    /// The numbers of all nodes, those of the deepest level first, the root last.
    pub order: Vec<u32>,
    /// How many nodes each level has, the deepest first.
    pub counts: Vec<u32>,
}

impl Blas {
    /// The nodes by their levels, which is the order in which a device can refit them: all of a level at once.
    pub fn levels(&self) -> Levels {
        let nodes = self.nodes();
        let mut depths = vec![0u32; nodes.len()];
        // Children follow their parents.
        for (place, node) in nodes.iter().enumerate() {
            for child in node.children {
                if let Child::Inner(unit) = Child::of(child) {
                    depths[(unit / NODE_UNITS) as usize] = depths[place] + 1;
                }
            }
        }
        let mut order: Vec<u32> = (0..nodes.len() as u32).collect();
        order.sort_by_key(|&place| std::cmp::Reverse(depths[place as usize]));
        let counts = order.chunk_by(|&one, &other| depths[one as usize] == depths[other as usize]);
        Levels { counts: counts.map(|level| level.len() as u32).collect(), order }
    }
}

const NODE_WORDS: usize = size_of::<Node>() / 4;

/// The box of all of a node's children.
fn around_children(node: &Node) -> Aabb {
    let holds_something = |slot: &usize| Child::of(node.children[*slot]) != Child::Nothing;
    (0..WIDTH).filter(holds_something).fold(Aabb::EMPTY, |sum, slot| sum.union(node.bounds(slot)))
}

#[cfg(test)]
mod tests {
    use crate::layout::{Child, NODE_UNITS};
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
    fn levels_have_children_before_their_parents() {
        let (positions, indices) = crate::room::room(9);
        let blas = build_blas(&positions, &indices, Quality::Fast).unwrap();
        let levels = blas.levels();
        assert_eq!(levels.counts.len() as u32, blas.depth);
        assert_eq!(levels.counts.iter().sum::<u32>(), blas.node_count);
        let mut is_done = vec![false; blas.node_count as usize];
        for &place in &levels.order {
            for child in blas.nodes()[place as usize].children {
                if let Child::Inner(unit) = Child::of(child) {
                    assert!(is_done[(unit / NODE_UNITS) as usize]);
                }
            }
            is_done[place as usize] = true;
        }
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
