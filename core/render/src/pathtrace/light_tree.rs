//! The tree over lights with a place, by which shaders choose one of many (Conty Estevez and Kulla, Importance Sampling of
//! Many Lights with Adaptive Tree Splitting, HPG 2018). `light_tree.glsl` walks it.

use afterglow_records::{
    LIGHT_LEAF, LIGHT_POINT, LIGHT_SPHERE, LIGHT_TRIANGLE, LightNode, LightSource, NO_TRAIL,
};
use bytemuck::Zeroable;
use glam::Vec3;

use super::light_cone::Cone;

/// Turns from which on lights are halved by number, so that a trail has bits enough.
const MEDIAN_FROM: u32 = 12;
/// Bins along an axis in which lights are counted for a cut.
const BINS: usize = 12;

/// What a part of the tree holds.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    least: Vec3,
    greatest: Vec3,
    cone: Cone,
    power: f32,
    /// Times the power.
    attenuation: Vec3,
}

impl Bounds {
    const EMPTY: Self = Self {
        least: Vec3::INFINITY,
        greatest: Vec3::NEG_INFINITY,
        cone: Cone::EMPTY,
        power: 0.0,
        attenuation: Vec3::ZERO,
    };

    fn of(light: &LightSource) -> Self {
        let position = Vec3::from(light.position);
        let [edge_1, edge_2] = [light.edge_1, light.edge_2].map(Vec3::from);
        let luminance = luminance(light.color);
        let around = |power: f32, attenuation: Vec3| Self {
            least: position - light.radius,
            greatest: position + light.radius,
            cone: Cone::EVERYWHERE,
            power,
            attenuation: attenuation * power,
        };
        match light.kind {
            LIGHT_POINT => around(std::f32::consts::PI * luminance, light.attenuation.into()),
            LIGHT_SPHERE => around(std::f32::consts::PI * light.radius * light.radius * luminance, Vec3::Z),
            kind => {
                let normal = edge_1.cross(edge_2);
                let power = 0.5 * normal.length() * luminance;
                let corners = [position, position + edge_1, position + edge_2];
                Self {
                    least: corners.into_iter().fold(Vec3::INFINITY, Vec3::min),
                    greatest: corners.into_iter().fold(Vec3::NEG_INFINITY, Vec3::max),
                    cone: match kind == LIGHT_TRIANGLE {
                        true => Cone::along(normal.normalize_or_zero()),
                        false => Cone::EVERYWHERE,
                    },
                    power,
                    attenuation: Vec3::Z * power,
                }
            }
        }
    }

    fn union(self, other: Self) -> Self {
        Self {
            least: self.least.min(other.least),
            greatest: self.greatest.max(other.greatest),
            cone: self.cone.union(other.cone),
            power: self.power + other.power,
            attenuation: self.attenuation + other.attenuation,
        }
    }

    fn middle(&self) -> Vec3 {
        0.5 * (self.least + self.greatest)
    }

    /// How bad it is to have all of this in one node.
    fn cost(&self) -> f32 {
        if self.power == 0.0 {
            return 0.0;
        }
        let side = self.greatest - self.least;
        let area = side.x * side.y + side.y * side.z + side.z * side.x;
        self.power * self.cone.measure() * area
    }

    fn node(&self, next: u32) -> LightNode {
        LightNode {
            least: self.least.to_array(),
            power: self.power,
            greatest: self.greatest.to_array(),
            next,
            axis: self.cone.axis.to_array(),
            cos_spread: self.cone.cos_spread,
            attenuation: (self.attenuation / self.power.max(f32::MIN_POSITIVE)).to_array(),
            ..LightNode::zeroed()
        }
    }
}

/// The box around a light.
pub(super) fn box_of(light: &LightSource) -> (Vec3, Vec3) {
    let Bounds { least, greatest, .. } = Bounds::of(light);
    (least, greatest)
}

/// A light on its way into the tree.
#[derive(Clone, Copy)]
struct Leaf {
    light: u32,
    bounds: Bounds,
}

/// Builds the tree over the lights with a place, `lights[first..]`, and writes each one's trail. Lights without power, or
/// with more than there are numbers for, are not in it: they are found by rays alone.
pub(crate) fn build(lights: &mut [LightSource], first: usize) -> Vec<LightNode> {
    lights.iter_mut().skip(first).for_each(|light| light.trail = NO_TRAIL);
    let numbered = lights.iter().enumerate().skip(first);
    let leaf =
        |(light, source): (usize, &LightSource)| Leaf { light: light as u32, bounds: Bounds::of(source) };
    let is_sound = |leaf: &Leaf| {
        let bounds = &leaf.bounds;
        bounds.power > 0.0
            && bounds.power.is_finite()
            && bounds.least.is_finite()
            && bounds.greatest.is_finite()
    };
    let mut leaves: Vec<Leaf> = numbered.map(leaf).filter(is_sound).collect();
    if leaves.is_empty() && first < lights.len() {
        let nothing = Bounds { least: Vec3::ZERO, greatest: Vec3::ZERO, ..Bounds::EMPTY };
        return vec![nothing.node(first as u32 | LIGHT_LEAF)];
    }
    let mut nodes = Vec::with_capacity(2 * leaves.len());
    grow(&mut leaves, lights, &mut nodes, 0, 0);
    nodes
}

fn grow(leaves: &mut [Leaf], lights: &mut [LightSource], nodes: &mut Vec<LightNode>, trail: u32, turns: u32) {
    let bounds = leaves.iter().fold(Bounds::EMPTY, |sum, leaf| sum.union(leaf.bounds));
    let place = nodes.len();
    if let [leaf] = leaves {
        nodes.push(bounds.node(leaf.light | LIGHT_LEAF));
        lights[leaf.light as usize].trail = trail;
        return;
    }
    if leaves.is_empty() {
        return;
    }
    nodes.push(LightNode::zeroed());
    let middle = cut(leaves, turns);
    let (left, right) = leaves.split_at_mut(middle);
    grow(left, lights, nodes, trail, turns + 1);
    let second = nodes.len() as u32;
    grow(right, lights, nodes, trail | 1 << turns, turns + 1);
    nodes[place] = bounds.node(second);
}

/// Orders two or more leaves so that those of the first child come first; returns how many these are.
fn cut(leaves: &mut [Leaf], turns: u32) -> usize {
    let middles = leaves.iter().map(|leaf| leaf.bounds.middle());
    let (least, greatest) = middles.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(least, most), middle| {
        (least.min(middle), most.max(middle))
    });
    let extent = greatest - least;
    let best = (0..3)
        .filter(|&axis| turns < MEDIAN_FROM && extent[axis] > 0.0)
        .flat_map(|axis| costs(leaves, axis, least[axis], extent))
        .min_by(|a, b| a.cost.total_cmp(&b.cost));
    if let Some(best) = best {
        let bin = |leaf: &Leaf| bin_of(leaf, best.axis, least[best.axis], extent[best.axis]);
        leaves.sort_by_key(|leaf| (bin(leaf) > best.bin, leaf.light));
        let middle = leaves.partition_point(|leaf| bin(leaf) <= best.bin);
        if middle > 0 && middle < leaves.len() {
            return middle;
        }
    }
    let axis = extent.max_position();
    leaves.sort_by(|a, b| {
        let [a_at, b_at] = [a, b].map(|leaf| leaf.bounds.middle()[axis]);
        a_at.total_cmp(&b_at).then(a.light.cmp(&b.light))
    });
    leaves.len() / 2
}

/// A cut after a bin of an axis.
struct Cut {
    axis: usize,
    bin: usize,
    cost: f32,
}

fn bin_of(leaf: &Leaf, axis: usize, least: f32, extent: f32) -> usize {
    let share = (leaf.bounds.middle()[axis] - least) / extent;
    ((share * BINS as f32) as usize).min(BINS - 1)
}

/// What each cut along an axis costs; long thin parts are to be cut across.
fn costs(leaves: &[Leaf], axis: usize, least: f32, extent: Vec3) -> Vec<Cut> {
    let mut bins = [Bounds::EMPTY; BINS];
    for leaf in leaves {
        let bin = &mut bins[bin_of(leaf, axis, least, extent[axis])];
        *bin = bin.union(leaf.bounds);
    }
    let side = |bins: &[Bounds]| bins.iter().fold(Bounds::EMPTY, |sum, bin| sum.union(*bin));
    let regular = extent.max_element() / extent[axis];
    (0..BINS - 1)
        .filter_map(|bin| {
            let (left, right) = (side(&bins[..=bin]), side(&bins[bin + 1..]));
            let is_cut = left.power > 0.0 && right.power > 0.0;
            is_cut.then(|| Cut { axis, bin, cost: regular * (left.cost() + right.cost()) })
        })
        .collect()
}

fn luminance(color: [f32; 3]) -> f32 {
    Vec3::from(color).dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sphere(position: Vec3, power: f32) -> LightSource {
        LightSource {
            position: position.to_array(),
            radius: 0.1,
            color: [power; 3],
            kind: LIGHT_SPHERE,
            ..LightSource::zeroed()
        }
    }

    /// The light at the end of a trail.
    fn follow(nodes: &[LightNode], trail: u32) -> u32 {
        let mut node = 0;
        for turn in 0..32 {
            let next = nodes[node].next;
            if next & LIGHT_LEAF != 0 {
                return next & !LIGHT_LEAF;
            }
            node = if trail >> turn & 1 == 0 { node + 1 } else { next as usize };
        }
        unreachable!("no trail is longer")
    }

    #[test]
    fn trails_end_at_their_lights() {
        let place =
            |i: usize| Vec3::new((i * 7919 % 1000) as f32, (i * 104_729 % 1000) as f32, (i % 13) as f32);
        let mut lights: Vec<_> = (0..10_000).map(|i| sphere(place(i), 1.0 + (i % 5) as f32)).collect();
        lights[17].color = [0.0; 3];
        (lights[18].color, lights[18].radius) = ([f32::MAX; 3], 1e3);
        let nodes = build(&mut lights, 0);
        assert_eq!(nodes.len(), 2 * 9_998 - 1);
        for (number, light) in lights.iter().enumerate().filter(|(number, _)| !(17..=18).contains(number)) {
            assert_eq!(follow(&nodes, light.trail), number as u32);
        }
        // No walk finds them.
        assert_eq!([17, 18].map(|light: usize| lights[light].trail), [NO_TRAIL; 2]);
    }

    #[test]
    fn lights_at_one_place_are_halved() {
        let mut lights = vec![sphere(Vec3::ONE, 1.0); 70_000];
        let nodes = build(&mut lights, 0);
        assert_eq!(follow(&nodes, lights[69_999].trail), 69_999);
    }

    #[test]
    fn a_node_holds_what_its_lights_do() {
        let mut lights = vec![sphere(Vec3::ZERO, 1.0), sphere(Vec3::X * 4.0, 3.0)];
        let nodes = build(&mut lights, 0);
        assert_eq!(nodes.len(), 3);
        let near = |a: f32, b: f32| (a - b).abs() < 1e-5;
        assert!(near(nodes[0].power, nodes[1].power + nodes[2].power));
        assert!(near(nodes[0].greatest[0], 4.1) && near(nodes[0].least[0], -0.1));
        assert_eq!(nodes[0].attenuation, [0.0, 0.0, 1.0]);
    }

    #[test]
    fn no_light_with_power_makes_a_tree_that_brings_nothing() {
        let mut lights = vec![sphere(Vec3::ZERO, 0.0), sphere(Vec3::NAN, 1.0)];
        let nodes = build(&mut lights, 0);
        assert_eq!((nodes.len(), nodes[0].power), (1, 0.0));
        assert!(build(&mut [], 0).is_empty());
    }
}
