//! Top levels: instances of bottom levels in the world.

use crate::binary::{Split, build};
use crate::bounds::{Aabb, affine_parts};
use crate::encode::encode;
use crate::error::{BuildError, check_count};
use crate::layout::{
    FLAG_IDENTITY, INSTANCE_UNITS, InstanceRecord, LARGEST_COORDINATE, MOST_WAITING_TLAS, Node,
};

/// The 3x4 matrix that changes nothing.
pub const IDENTITY: [[f32; 4]; 3] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

/// An instance to build from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Where the object lies: row-major 3x4.
    pub object_to_world: [[f32; 4]; 3],
    /// Device address of its bottom level, a multiple of 16.
    pub blas: u64,
    /// The bottom level's box, in object space.
    pub bounds: Aabb,
    /// Reported by a hit.
    pub id: u32,
    /// A ray meets the instance when their masks share a bit.
    pub mask: u8,
    /// `FLAG_ALPHA_TESTED`, `FLAG_TWO_SIDED`.
    pub flags: u32,
}

/// A top level, ready to be copied to a 16-byte-aligned device address.
#[derive(Clone, Debug, PartialEq)]
pub struct Tlas {
    /// Nodes, then instances; see [`crate::layout`].
    pub words: Vec<u32>,
    /// How many nodes.
    pub node_count: u32,
    /// How many instances.
    pub instance_count: u32,
    /// Levels of nodes.
    pub depth: u32,
    /// Instances left out: nothing inside, no mask, or a matrix without an inverse.
    pub skipped: u32,
    /// The box of all instances, in the world.
    pub bounds: Aabb,
}

impl Tlas {
    /// Bytes on the device.
    pub fn size_bytes(&self) -> usize {
        self.words.len() * 4
    }

    /// The instances, in the order of leaves.
    pub fn instances(&self) -> &[InstanceRecord] {
        let first = self.node_count as usize * size_of::<Node>() / 4;
        bytemuck::cast_slice(&self.words[first..])
    }
}

/// Builds a top level; the same input gives the same words.
///
/// # Errors
/// [`BuildError::TooMany`] for more than 2^25 instances.
pub fn build_tlas(instances: &[Instance]) -> Result<Tlas, BuildError> {
    check_count(instances.len())?;
    let (records, boxes): (Vec<InstanceRecord>, Vec<Aabb>) = instances.iter().filter_map(place).unzip();
    let tree = build(&boxes, Split::SurfaceArea);
    let mut wide = encode(&tree, &boxes, 1, MOST_WAITING_TLAS);
    wide.place_leaves(INSTANCE_UNITS);

    let mut words: Vec<u32> = Vec::new();
    words.extend_from_slice(bytemuck::cast_slice(&wide.nodes));
    for &index in &wide.order {
        words.extend_from_slice(bytemuck::cast_slice(&[records[index as usize]]));
    }
    Ok(Tlas {
        words,
        node_count: wide.nodes.len() as u32,
        instance_count: records.len() as u32,
        depth: wide.depth,
        skipped: (instances.len() - records.len()) as u32,
        bounds: boxes.iter().fold(Aabb::EMPTY, |sum, &b| sum.union(b)),
    })
}

/// The record and the world's box of an instance, None where no ray can meet it.
fn place(instance: &Instance) -> Option<(InstanceRecord, Aabb)> {
    if instance.mask == 0 {
        return None;
    }
    let world_to_object = inverse(&instance.object_to_world)?;
    let identity = instance.object_to_world == IDENTITY;
    let bounds =
        if identity { instance.bounds } else { instance.bounds.transformed(&instance.object_to_world) };
    let reachable = bounds.min.abs().max(bounds.max.abs()).max_element() <= LARGEST_COORDINATE;
    if bounds.is_empty() || !reachable {
        return None;
    }
    let flags = instance.flags & !FLAG_IDENTITY | if identity { FLAG_IDENTITY } else { 0 };
    let record = InstanceRecord {
        blas: [instance.blas as u32, (instance.blas >> 32) as u32],
        id: instance.id,
        mask_and_flags: u32::from(instance.mask) | flags << 8,
        world_to_object,
        object_to_world: instance.object_to_world,
    };
    Some((record, bounds))
}

/// The inverse of an affine map, None where it has none in f32.
fn inverse(rows: &[[f32; 4]; 3]) -> Option<[[f32; 4]; 3]> {
    let (linear, offset) = affine_parts(rows);
    let determinant = linear.determinant();
    if determinant == 0.0 || !determinant.is_finite() {
        return None;
    }
    let back = linear.inverse();
    let offset = -(back * offset);
    let mut inverse = [[0.0; 4]; 3];
    for (i, row) in inverse.iter_mut().enumerate() {
        let linear = back.row(i);
        *row = [linear.x, linear.y, linear.z, offset[i]].map(|entry| entry as f32);
    }
    let finite = inverse.iter().flatten().all(|entry| entry.is_finite());
    finite.then_some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::FLAG_ALPHA_TESTED;
    use glam::Vec3;

    fn instance(object_to_world: [[f32; 4]; 3]) -> Instance {
        Instance {
            object_to_world,
            blas: 0x1_2345_6780,
            bounds: Aabb::around(&[Vec3::NEG_ONE, Vec3::ONE]),
            id: 7,
            mask: 0xff,
            flags: FLAG_ALPHA_TESTED | FLAG_IDENTITY,
        }
    }

    #[test]
    fn records_carry_what_was_given() {
        let moved = [[2.0, 0.0, 0.0, 5.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0]];
        let tlas = build_tlas(&[instance(moved)]).unwrap();
        let record = tlas.instances()[0];
        assert_eq!(record.blas_address(), 0x1_2345_6780);
        assert_eq!((record.id, record.mask()), (7, 0xff));
        assert_eq!(record.flags(), FLAG_ALPHA_TESTED);
        assert_eq!(record.world_to_object[0], [0.5, 0.0, 0.0, -2.5]);
        let identity = build_tlas(&[instance(IDENTITY)]).unwrap();
        assert_ne!(identity.instances()[0].flags() & FLAG_IDENTITY, 0);
    }

    #[test]
    fn instances_that_no_ray_meets_are_left_out() {
        let flat = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]];
        let mut broken = IDENTITY;
        broken[0][3] = f32::NAN;
        let mut far = IDENTITY;
        far[1][3] = 1e20;
        let unseen = Instance { mask: 0, ..instance(IDENTITY) };
        let empty = Instance { bounds: Aabb::EMPTY, ..instance(IDENTITY) };
        let given = [instance(flat), instance(broken), instance(far), unseen, empty];
        let tlas = build_tlas(&given).unwrap();
        assert_eq!((tlas.instance_count, tlas.skipped), (0, 5));
        assert!(tlas.bounds.is_empty());
    }
}
