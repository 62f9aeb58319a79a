//! The light tree from frame to frame. To build it for thousands of lights takes longer than a frame may; mostly they are what
//! they were but for their places, relative to a camera that moves: then the old tree gets new boxes.

use afterglow_records::{LIGHT_LEAF, LightNode, LightSource};
use glam::Vec3;
use xxhash_rust::xxh3::Xxh3;

use super::light_tree::{box_of, build};

/// For fewer lights the tree is built in each frame, so that it depends on nothing else.
const LEAST_KEPT: usize = 128;
/// The tree is built anew once its boxes have grown so much.
const MOST_GROWTH: f32 = 1.5;

/// The tree of the last frame.
#[derive(Debug, Default)]
pub(crate) struct KeptTree {
    /// A hash of all of the lights but their places.
    lights: u64,
    nodes: Vec<LightNode>,
    trails: Vec<u32>,
    /// The areas of its boxes, by power, when it was built.
    spread: f32,
}

impl KeptTree {
    /// The tree over `lights[first..]`, whose trails it writes, as [`build`] does.
    pub(crate) fn over(&mut self, lights: &mut [LightSource], first: usize) -> Vec<LightNode> {
        if lights.len() - first < LEAST_KEPT {
            *self = Self::default();
            return build(lights, first);
        }
        let hash = hash_but_places(&lights[first..]);
        let moved = (hash == self.lights).then(|| moved(&self.nodes, lights));
        self.nodes = match moved.filter(|nodes| spread(nodes) <= MOST_GROWTH * self.spread) {
            Some(nodes) => {
                for (light, trail) in lights[first..].iter_mut().zip(&self.trails) {
                    light.trail = *trail;
                }
                nodes
            }
            None => {
                let nodes = build(lights, first);
                self.lights = hash;
                self.trails = lights[first..].iter().map(|light| light.trail).collect();
                self.spread = spread(&nodes);
                nodes
            }
        };
        self.nodes.clone()
    }
}

fn hash_but_places(lights: &[LightSource]) -> u64 {
    let mut hasher = Xxh3::new();
    for light in lights {
        hasher.update(bytemuck::bytes_of(&LightSource { position: [0.0; 3], trail: 0, ..*light }));
    }
    hasher.digest()
}

/// The nodes with boxes around the lights as they are now.
fn moved(nodes: &[LightNode], lights: &[LightSource]) -> Vec<LightNode> {
    let mut nodes = nodes.to_vec();
    // Children follow their parents.
    for place in (0..nodes.len()).rev() {
        let next = nodes[place].next;
        let (least, greatest) = if next & LIGHT_LEAF != 0 {
            box_of(&lights[(next & !LIGHT_LEAF) as usize])
        } else {
            let [one, other] = [place + 1, next as usize].map(|child| {
                let LightNode { least, greatest, .. } = nodes[child];
                (Vec3::from(least), Vec3::from(greatest))
            });
            (one.0.min(other.0), one.1.max(other.1))
        };
        (nodes[place].least, nodes[place].greatest) = (least.to_array(), greatest.to_array());
    }
    nodes
}

fn spread(nodes: &[LightNode]) -> f32 {
    let of_node = |node: &LightNode| {
        let side = Vec3::from(node.greatest) - Vec3::from(node.least);
        node.power * (side.x * side.y + side.y * side.z + side.z * side.x)
    };
    nodes.iter().map(of_node).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use afterglow_records::LIGHT_SPHERE;
    use bytemuck::Zeroable;

    fn lights(offset: Vec3) -> Vec<LightSource> {
        let light = |i: usize| LightSource {
            // Whole numbers, so that sums are exact.
            position: (Vec3::new((i * 37 % 101) as f32, (i * 53 % 97) as f32, (i % 7) as f32) + offset)
                .to_array(),
            radius: 0.5,
            color: [1.0 + (i % 3) as f32; 3],
            kind: LIGHT_SPHERE,
            ..LightSource::zeroed()
        };
        (0..500).map(light).collect()
    }

    #[test]
    fn a_tree_that_moves_is_the_tree_of_what_has_moved() {
        let mut kept = KeptTree::default();
        kept.over(&mut lights(Vec3::ZERO), 3);
        let offset = Vec3::new(64.0, -8.0, 16.0);
        let (mut seen, mut anew) = (lights(offset), lights(offset));
        let nodes = kept.over(&mut seen, 3);
        assert_eq!(
            bytemuck::cast_slice::<_, u8>(&nodes),
            bytemuck::cast_slice::<_, u8>(&build(&mut anew, 3))
        );
        assert_eq!(bytemuck::cast_slice::<_, u8>(&seen), bytemuck::cast_slice::<_, u8>(&anew));
    }

    #[test]
    fn lights_that_are_others_or_scatter_have_a_tree_anew() {
        let mut kept = KeptTree::default();
        kept.over(&mut lights(Vec3::ZERO), 0);
        let mut brighter = lights(Vec3::ZERO);
        brighter[7].color = [9.0; 3];
        let mut scattered = lights(Vec3::ZERO);
        scattered.reverse();
        scattered.iter_mut().for_each(|light| light.color = [1.0; 3]);
        for mut now in [brighter, scattered] {
            let mut anew = now.clone();
            let nodes = kept.over(&mut now, 0);
            assert_eq!(
                bytemuck::cast_slice::<_, u8>(&nodes),
                bytemuck::cast_slice::<_, u8>(&build(&mut anew, 0))
            );
        }
    }
}
