//! The words that `shaders/pass/bench/binary.comp` reads: a plain binary hierarchy.

use afterglow_bvh::layout::Triangle;
use glam::Vec3;
use obvhs::BvhBuildParams;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::triangle::Triangle as ObvhsTriangle;
use std::time::Duration;

const LEAF: u32 = 1 << 31;
const NODE_UNITS: u32 = 4;

/// Builds over the triangles of `indices`.
pub fn build(positions: &[[f32; 3]], indices: &[[u32; 3]]) -> Vec<u32> {
    // The mesh's reader has checked that corners are there.
    let corners = |triangle: &[u32; 3]| triangle.map(|corner| positions[corner as usize]);
    let triangles: Vec<ObvhsTriangle> = indices
        .iter()
        .map(|triangle| {
            let [v0, v1, v2] = corners(triangle).map(|v| Vec3::from(v).into());
            ObvhsTriangle { v0, v1, v2 }
        })
        .collect();
    let params = BvhBuildParams { pre_split: false, max_prims_per_leaf: 4, ..BvhBuildParams::medium_build() };
    let tree = build_bvh2_from_tris(&triangles, params, &mut Duration::default());

    // Unit 0 says where triangles begin; their node's place by the count of inner nodes before it.
    let mut place = 0;
    let places: Vec<u32> = tree
        .nodes
        .iter()
        .map(|node| {
            let own = 1 + place * NODE_UNITS;
            place += u32::from(!node.is_leaf());
            own
        })
        .collect();
    let mut words = vec![0, 0, 0, 1 + place * NODE_UNITS];
    for node in tree.nodes.iter().filter(|node| !node.is_leaf()) {
        for child in [node.first_index, node.first_index + 1] {
            let below = &tree.nodes[child as usize];
            let reference = if below.is_leaf() {
                LEAF | below.prim_count << 27 | below.first_index
            } else {
                places[child as usize]
            };
            let bounds = below.aabb();
            words.extend(bounds.min.to_array().map(f32::to_bits));
            words.push(reference);
            words.extend(bounds.max.to_array().map(f32::to_bits));
            words.push(0);
        }
    }
    for &primitive in &tree.primitive_indices {
        let record =
            Triangle { vertices: corners(&indices[primitive as usize]), primitive, flags: 0, reserved: 0 };
        words.extend_from_slice(bytemuck::cast_slice(&[record]));
    }
    words
}
