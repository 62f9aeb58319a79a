//! The bytes that the shaders read. A structure is one array of 32-bit little-endian words: its
//! nodes first (the root at word 0), then its leaf records, triangles and spheres in a bottom level
//! (BLAS) or instances in a top level (TLAS). References inside are offsets from the structure's own start in
//! [`UNIT_BYTES`]-byte units, so a structure can be copied to any 16-byte-aligned address.
//! `shaders/include/bvh_node.glsl` is the reader; a test compares its constants with these.

use bytemuck::{Pod, Zeroable};

/// Bytes of one unit of reference, and the alignment of structures.
pub const UNIT_BYTES: usize = 16;
/// Units of a [`Node`].
pub const NODE_UNITS: u32 = 5;
/// Units of a [`Triangle`].
pub const TRIANGLE_UNITS: u32 = 3;
/// Units of an [`InstanceRecord`].
pub const INSTANCE_UNITS: u32 = 7;

/// Most children of a node.
pub const WIDTH: usize = 8;
/// Most leaf records in one child slot.
pub const MAX_LEAF: u32 = 3;

/// Most levels of nodes in a bottom level; the builder keeps it, the shader's stack relies on it.
pub const MAX_DEPTH_BLAS: u32 = 20;
/// Most levels of nodes in a top level.
pub const MAX_DEPTH_TLAS: u32 = 10;
/// Entries of the traversal stack: one a level, and two where a ray enters an instance.
pub const STACK_ENTRIES: usize = 32;
/// Most steps of one ray, a node or a leaf record each: malformed data cannot hang a device.
pub const MAX_STEPS: u32 = 1 << 18;

/// Triangles and instances with a coordinate beyond this are left out, so that no product of the
/// intersection test overflows.
pub const LARGEST_COORDINATE: f32 = 1e11;

/// Triangle or instance flag: ask `accept_hit` before a hit counts.
pub const FLAG_ALPHA_TESTED: u32 = 1;
/// Triangle or instance flag, carried for shading: traversal never culls back faces.
pub const FLAG_TWO_SIDED: u32 = 2;
/// Instance flag, set by the builder: both matrices are the identity.
pub const FLAG_IDENTITY: u32 = 4;
/// Triangle flag, set by the builder: the record is of a sphere.
pub const FLAG_SPHERE: u32 = 8;

/// A node of up to eight children, their boxes quantised to 8 bits on a grid of the node's own
/// (Ylitie, Karras and Laine, Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
/// BVHs, HPG 2017). 80 bytes.
///
/// Plane `q` of axis `a` lies at `origin[a] + q * 2^(exponents[a] - 127)`. A node's inner children
/// lie one after the other from `child_base`, in the order of their slots; so do its leaf records
/// from `leaf_base`. Slots are assigned by octant: bit 2, 1, 0 of a slot says whether the child lies
/// towards positive x, y, z, so that `slot ^ sign bits` sorts the children along any ray.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Node {
    /// Least corner of the node's box, f32 bits (offset 0).
    pub origin: [u32; 3],
    /// Biased exponent of the grid's spacing along x, y, z (offset 12).
    pub exponents: [u8; 3],
    /// Bit `s`: slot `s` holds an inner node (offset 15).
    pub inner_mask: u8,
    /// Where the first inner child lies, in units (offset 16).
    pub child_base: u32,
    /// Where the first leaf record lies, in units (offset 20).
    pub leaf_base: u32,
    /// What each slot holds (offset 24): 0 nothing; an inner node `0x20 | 24 + slot`; a leaf of n
    /// records from number k of the node's: n ones from bit 5, `k` below.
    pub meta: [u8; WIDTH],
    /// Least planes of the slots along x, y, z (offset 32).
    pub low: [[u8; WIDTH]; 3],
    /// Greatest planes of the slots along x, y, z (offset 56).
    pub high: [[u8; WIDTH]; 3],
}

/// A leaf record of a bottom level: a triangle, or where its flags say so a sphere. 48 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Triangle {
    /// Corners in object space, bit for bit the input's, so that shared edges stay shared (offset 0). Of a
    /// sphere its centre, then its radius and zeros.
    pub vertices: [[f32; 3]; 3],
    /// What a hit reports as its primitive (offset 36).
    pub primitive: u32,
    /// `FLAG_*` (offset 40).
    pub flags: u32,
    /// 0 (offset 44).
    pub reserved: u32,
}

impl Triangle {
    /// The record of a sphere.
    pub fn from_sphere(sphere: Sphere, primitive: u32, flags: u32) -> Self {
        let vertices = [sphere.centre, [sphere.radius, 0.0, 0.0], [0.0; 3]];
        Self { vertices, primitive, flags: flags | FLAG_SPHERE, reserved: 0 }
    }

    /// The sphere that this record is of, if it is of one.
    pub fn sphere(&self) -> Option<Sphere> {
        let [centre, [radius, ..], _] = self.vertices;
        (self.flags & FLAG_SPHERE != 0).then_some(Sphere { centre, radius })
    }
}

/// A sphere in object space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Its centre.
    pub centre: [f32; 3],
    /// Its radius.
    pub radius: f32,
}

/// An instance of a top level. 112 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct InstanceRecord {
    /// Device address of the bottom level, low and high word (offset 0).
    pub blas: [u32; 2],
    /// What a hit reports as its instance (offset 8).
    pub id: u32,
    /// Bits 0..8 the mask, which rays meet with their own; the rest `FLAG_*` shifted left by 8
    /// (offset 12).
    pub mask_and_flags: u32,
    /// Row-major 3x4 (offset 16).
    pub world_to_object: [[f32; 4]; 3],
    /// Row-major 3x4 (offset 64).
    pub object_to_world: [[f32; 4]; 3],
}

impl InstanceRecord {
    /// The address of the bottom level.
    pub fn blas_address(&self) -> u64 {
        u64::from(self.blas[0]) | u64::from(self.blas[1]) << 32
    }

    /// The visibility mask.
    pub fn mask(&self) -> u32 {
        self.mask_and_flags & 0xff
    }

    /// `FLAG_*`.
    pub fn flags(&self) -> u32 {
        self.mask_and_flags >> 8
    }
}

/// Reads the record at `unit` of a structure, None when it lies outside.
pub fn record<T: Pod>(words: &[u32], unit: u32) -> Option<T> {
    let start = (unit as usize).checked_mul(UNIT_BYTES / 4)?;
    let end = start.checked_add(size_of::<T>() / 4)?;
    words.get(start..end).map(|found| bytemuck::pod_read_unaligned(bytemuck::cast_slice(found)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::mem::offset_of;

    #[test]
    fn sizes_are_the_documented_units() {
        let units = |bytes: usize| (bytes / UNIT_BYTES) as u32;
        assert_eq!(size_of::<Node>(), 80);
        assert_eq!(units(size_of::<Node>()), NODE_UNITS);
        assert_eq!(size_of::<Triangle>(), 48);
        assert_eq!(units(size_of::<Triangle>()), TRIANGLE_UNITS);
        assert_eq!(size_of::<InstanceRecord>(), 112);
        assert_eq!(units(size_of::<InstanceRecord>()), INSTANCE_UNITS);
    }

    #[test]
    fn offsets_are_the_documented_ones() {
        assert_eq!(offset_of!(Node, exponents), 12);
        assert_eq!(offset_of!(Node, child_base), 16);
        assert_eq!(offset_of!(Node, meta), 24);
        assert_eq!(offset_of!(Node, low), 32);
        assert_eq!(offset_of!(Node, high), 56);
        assert_eq!(offset_of!(Triangle, primitive), 36);
        assert_eq!(offset_of!(InstanceRecord, world_to_object), 16);
        assert_eq!(offset_of!(InstanceRecord, object_to_world), 64);
    }

    #[test]
    fn a_record_outside_the_words_is_none() {
        let words = [0u32; 24];
        assert!(record::<Node>(&words, 0).is_some());
        assert!(record::<Node>(&words, 2).is_none());
        assert!(record::<Node>(&words, u32::MAX).is_none());
    }

    #[test]
    fn the_shader_has_the_same_constants() {
        let shader = include_str!("../../../shaders/include/bvh_node.glsl");
        for (name, value) in [
            ("NODE_UNITS", NODE_UNITS),
            ("TRIANGLE_UNITS", TRIANGLE_UNITS),
            ("INSTANCE_UNITS", INSTANCE_UNITS),
            ("STACK_ENTRIES", STACK_ENTRIES as u32),
            ("MAX_STEPS", MAX_STEPS),
            ("FLAG_ALPHA_TESTED", FLAG_ALPHA_TESTED),
            ("FLAG_TWO_SIDED", FLAG_TWO_SIDED),
            ("FLAG_IDENTITY", FLAG_IDENTITY),
            ("FLAG_SPHERE", FLAG_SPHERE),
        ] {
            let line = format!("const uint BVH_{name} = {value}u;");
            assert!(shader.contains(&line), "{line}");
        }
    }

    #[test]
    fn the_stack_holds_both_levels() {
        assert!(MAX_DEPTH_BLAS as usize + MAX_DEPTH_TLAS as usize + 2 <= STACK_ENTRIES);
    }
}
