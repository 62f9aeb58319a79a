//! The binary tree that wide trees are made of: built top-down by the surface-area heuristic over
//! bins (Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007). The tree is the
//! same whatever the number of threads.

use crate::bounds::Aabb;
use glam::{UVec3, Vec3};

/// Bins along an axis.
const BINS: usize = 16;
/// Subtrees of fewer primitives are not given to another thread.
const PARALLEL_FROM: usize = 4096;
/// Splits below this many levels are at the median, so that depth stays bounded.
const LEVELS: u32 = 40;

/// How nodes are split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Split {
    /// Where the surface-area heuristic is least.
    SurfaceArea,
    /// Half the primitives on either side: balanced, for input that defeats the heuristic.
    Median,
}

/// A node of a [`BinaryTree`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct BinaryNode {
    /// The box of all its primitives.
    pub bounds: Aabb,
    /// Its first primitive's place in [`BinaryTree::order`].
    pub first: u32,
    /// How many primitives follow there; a leaf has one.
    pub count: u32,
}

/// A binary tree with one primitive a leaf, nodes in preorder.
#[derive(Clone, Debug)]
pub(crate) struct BinaryTree {
    /// 2n - 1 nodes; none for n = 0.
    pub nodes: Vec<BinaryNode>,
    /// The primitives, leaf by leaf.
    pub order: Vec<u32>,
}

impl BinaryTree {
    /// The children of inner node `node`: in preorder a subtree of n leaves fills 2n - 1 places.
    pub fn children(&self, node: usize) -> [usize; 2] {
        let left = node + 1;
        [left, left + 2 * self.nodes[left].count as usize - 1]
    }

    /// Whether `node` holds one primitive.
    pub fn is_leaf(&self, node: usize) -> bool {
        self.nodes[node].count == 1
    }
}

/// A primitive on its way through the build.
#[derive(Clone, Copy)]
struct Item {
    bounds: Aabb,
    primitive: u32,
}

/// Builds the tree over `boxes`, none of which may be empty.
pub(crate) fn build(boxes: &[Aabb], split: Split) -> BinaryTree {
    if boxes.is_empty() {
        return BinaryTree { nodes: Vec::new(), order: Vec::new() };
    }
    let mut items: Vec<Item> =
        (0u32..).zip(boxes).map(|(primitive, &bounds)| Item { bounds, primitive }).collect();
    let blank = BinaryNode { bounds: Aabb::EMPTY, first: 0, count: 1 };
    let mut nodes = vec![blank; 2 * items.len() - 1];
    subdivide(&mut items, &mut nodes, 0, LEVELS, split);
    BinaryTree { nodes, order: items.iter().map(|item| item.primitive).collect() }
}

/// Writes the subtree over `items` into `nodes` (2n - 1 of them); `first` is the place of `items[0]`.
fn subdivide(items: &mut [Item], nodes: &mut [BinaryNode], first: u32, levels: u32, split: Split) {
    let bounds = bounds_of(items);
    let count = items.len() as u32;
    nodes[0] = BinaryNode { bounds, first, count };
    if count == 1 {
        return;
    }
    let middle = partition(items, levels, split);
    let (left, right) = items.split_at_mut(middle);
    let (nodes_left, nodes_right) = nodes[1..].split_at_mut(2 * middle - 1);
    let first_right = first + middle as u32;
    let levels = levels.saturating_sub(1);
    if count as usize >= PARALLEL_FROM {
        rayon::join(
            || subdivide(left, nodes_left, first, levels, split),
            || subdivide(right, nodes_right, first_right, levels, split),
        );
    } else {
        subdivide(left, nodes_left, first, levels, split);
        subdivide(right, nodes_right, first_right, levels, split);
    }
}

fn bounds_of(items: &[Item]) -> Aabb {
    items.iter().fold(Aabb::EMPTY, |bounds, item| bounds.union(item.bounds))
}

/// Parts two or more items in two sides, neither empty; returns where the second begins.
fn partition(items: &mut [Item], levels: u32, split: Split) -> usize {
    let centroids = items.iter().fold(Aabb::EMPTY, |bounds, item| {
        let centroid = item.bounds.centroid_doubled();
        bounds.union(Aabb { min: centroid, max: centroid })
    });
    let spare = u32::BITS - (items.len() as u32).leading_zeros() < levels;
    if split == Split::SurfaceArea && spare && items.len() > 2 {
        let binning = Binning::new(&centroids);
        if let Some(plane) = best_plane(items, &binning) {
            return partition_at(items, &binning, plane);
        }
    }
    partition_at_median(items, &centroids)
}

/// Maps centroids to bins along each axis.
struct Binning {
    origin: Vec3,
    scale: Vec3,
}

impl Binning {
    fn new(centroids: &Aabb) -> Self {
        let extent = centroids.max - centroids.min;
        // An axis without extent gets scale 0: all its items fall in bin 0, and no plane is found.
        let scale = Vec3::select(
            extent.cmpgt(Vec3::splat(f32::MIN_POSITIVE)),
            Vec3::splat(BINS as f32 * 0.999_99) / extent,
            Vec3::ZERO,
        );
        Self { origin: centroids.min, scale }
    }

    fn bins(&self, item: &Item) -> UVec3 {
        let place = (item.bounds.centroid_doubled() - self.origin) * self.scale;
        place.as_uvec3().min(UVec3::splat(BINS as u32 - 1))
    }
}

/// A plane between bins `bin` and `bin + 1` of `axis`.
#[derive(Clone, Copy)]
struct Plane {
    axis: usize,
    bin: usize,
}

#[derive(Clone, Copy)]
struct Bin {
    bounds: Aabb,
    count: u32,
}

const EMPTY_BIN: Bin = Bin { bounds: Aabb::EMPTY, count: 0 };

impl Bin {
    fn add(&mut self, other: Bin) {
        self.bounds = self.bounds.union(other.bounds);
        self.count += other.count;
    }

    fn cost(&self) -> f32 {
        self.bounds.half_area() * self.count as f32
    }
}

/// The plane of least cost over all axes, None when all centroids share a bin.
fn best_plane(items: &[Item], binning: &Binning) -> Option<Plane> {
    let mut bins = [[EMPTY_BIN; BINS]; 3];
    for item in items {
        let place = binning.bins(item);
        for (axis, bins) in bins.iter_mut().enumerate() {
            bins[place[axis] as usize].add(Bin { bounds: item.bounds, count: 1 });
        }
    }
    let mut best = None;
    let mut least = f32::INFINITY;
    for (axis, bins) in bins.iter().enumerate() {
        let (bin, cost) = best_plane_of_axis(bins);
        if cost < least {
            least = cost;
            best = Some(Plane { axis, bin });
        }
    }
    best
}

/// The best plane of one axis and its cost, infinite when one side would be empty.
fn best_plane_of_axis(bins: &[Bin; BINS]) -> (usize, f32) {
    let mut cost_right = [0.0; BINS];
    let mut right = EMPTY_BIN;
    for plane in (0..BINS - 1).rev() {
        right.add(bins[plane + 1]);
        cost_right[plane] = if right.count == 0 { f32::INFINITY } else { right.cost() };
    }
    let mut left = EMPTY_BIN;
    let mut best = (0, f32::INFINITY);
    for plane in 0..BINS - 1 {
        left.add(bins[plane]);
        let cost = left.cost() + cost_right[plane];
        if left.count > 0 && cost < best.1 {
            best = (plane, cost);
        }
    }
    best
}

fn partition_at(items: &mut [Item], binning: &Binning, plane: Plane) -> usize {
    let mut middle = 0;
    for i in 0..items.len() {
        if binning.bins(&items[i])[plane.axis] as usize <= plane.bin {
            items.swap(i, middle);
            middle += 1;
        }
    }
    middle
}

/// Halves the items by centroid along the longest axis, equal centroids by their number.
fn partition_at_median(items: &mut [Item], centroids: &Aabb) -> usize {
    let axis = (centroids.max - centroids.min).max_position();
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |a, b| {
        let (left, right) = (a.bounds.centroid_doubled(), b.bounds.centroid_doubled());
        left[axis].total_cmp(&right[axis]).then(a.primitive.cmp(&b.primitive))
    });
    middle
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Random;

    fn soup(count: usize) -> Vec<Aabb> {
        let mut random = Random::new(7);
        (0..count)
            .map(|_| {
                let at = random.vec3() * 100.0;
                Aabb::around(&[at, at + random.vec3()])
            })
            .collect()
    }

    fn check(tree: &BinaryTree, boxes: &[Aabb]) {
        let mut seen = tree.order.clone();
        seen.sort_unstable();
        assert!(seen.into_iter().eq(0..boxes.len() as u32));
        for node in 0..tree.nodes.len() {
            let BinaryNode { bounds, first, count } = tree.nodes[node];
            let members = &tree.order[first as usize..(first + count) as usize];
            let around = members.iter().fold(Aabb::EMPTY, |sum, &i| sum.union(boxes[i as usize]));
            assert_eq!(around, bounds);
            if !tree.is_leaf(node) {
                let [left, right] = tree.children(node);
                assert_eq!(tree.nodes[left].count + tree.nodes[right].count, count);
                assert_eq!(tree.nodes[right].first, first + tree.nodes[left].count);
            }
        }
    }

    fn depth(tree: &BinaryTree, node: usize) -> u32 {
        if tree.is_leaf(node) {
            return 1;
        }
        let [left, right] = tree.children(node);
        1 + depth(tree, left).max(depth(tree, right))
    }

    #[test]
    fn every_node_bounds_its_primitives() {
        for count in [1, 2, 3, 17, 1000] {
            let boxes = soup(count);
            check(&build(&boxes, Split::SurfaceArea), &boxes);
            check(&build(&boxes, Split::Median), &boxes);
        }
    }

    #[test]
    fn coincident_boxes_are_halved() {
        let boxes = vec![Aabb::around(&[Vec3::ZERO, Vec3::ONE]); 5000];
        let tree = build(&boxes, Split::SurfaceArea);
        check(&tree, &boxes);
        assert_eq!(depth(&tree, 0), 14);
    }

    #[test]
    fn depth_is_bounded_where_the_heuristic_peels_one_by_one() {
        let boxes: Vec<Aabb> = (0..120)
            .map(|i| {
                let at = Vec3::splat(2f32.powi(i / 2 - 30));
                Aabb::around(&[at, at * 1.01])
            })
            .collect();
        let tree = build(&boxes, Split::SurfaceArea);
        check(&tree, &boxes);
        assert!(depth(&tree, 0) <= LEVELS + 8);
    }

    #[test]
    fn threads_do_not_change_the_tree() {
        let boxes = soup(20_000);
        let on_threads = |threads: usize| {
            rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap()
                .install(|| build(&boxes, Split::SurfaceArea).order)
        };
        assert_eq!(on_threads(1), on_threads(3));
    }
}
