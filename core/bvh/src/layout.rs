//! The bytes that the shaders read. A structure is one array of 32-bit little-endian words: its
//! nodes first (the root at word 0), then its leaf records, triangles and spheres in a bottom level
//! (BLAS) or instances in a top level (TLAS). References inside are offsets from the structure's own start in
//! [`UNIT_BYTES`]-byte units, so a structure can be copied to any 16-byte-aligned address.
//! `shaders/include/bvh_node.glsl` is the reader; a test compares the constants of `bvh_layout.glsl` with these.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::bounds::Aabb;

/// Bytes of one unit of reference, and the alignment of structures.
pub const UNIT_BYTES: usize = 16;
/// Units of a [`Node`].
pub const NODE_UNITS: u32 = 8;
/// Units of a [`Triangle`].
pub const TRIANGLE_UNITS: u32 = 3;
/// Units of an [`InstanceRecord`].
pub const INSTANCE_UNITS: u32 = 7;

/// Number of the shaders' specialization constant that says whether units are loaded whole (1), which is for graphics
/// processors, or in halves (0), for processors.
pub const WHOLE_UNITS_CONSTANT: u32 = 20;

/// Most children of a node.
pub const WIDTH: usize = 4;
/// Most leaf records in one child; two bits of a reference count them.
pub const MAX_LEAF: u32 = 4;

/// Most children that wait while a ray is somewhere in a bottom level, whatever its order; the builder keeps it, the
/// shader's stack relies on it.
pub const MOST_WAITING_BLAS: u32 = 88;
/// The same of a top level.
pub const MOST_WAITING_TLAS: u32 = 40;
/// Entries of the traversal stack.
pub const STACK_ENTRIES: usize = 128;
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

/// A node of up to four children. 128 bytes, a line of most caches.
///
/// The planes of an axis lie together, so that a ray reads those that it meets first, and those that it meets last, of all
/// children at once. A slot that holds nothing has a box that no ray meets.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Node {
    /// Along x, y, z the least planes of the children's boxes, then the greatest (offset 0).
    pub planes: [[[f32; WIDTH]; 2]; 3],
    /// What each child is, as [`Child::reference`] has it (offset 96).
    pub children: [u32; WIDTH],
    /// 0 (offset 112).
    pub reserved: [u32; 4],
}

/// What a slot of a node holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Child {
    /// Nothing.
    Nothing,
    /// A node, by its place in units.
    Inner(u32),
    /// One to four leaf records that follow one another, by the place of the first in units.
    Leaf {
        /// Where the first lies.
        place: u32,
        /// How many.
        count: u32,
    },
}

/// The reference of a slot that holds nothing.
pub const NOTHING: u32 = u32::MAX;
/// A reference's bits of its place; above are the count of leaf records less one, and the bit that says that it is a leaf.
pub const PLACE_BITS: u32 = 29;

impl Child {
    /// As nodes have it.
    pub fn reference(self) -> u32 {
        match self {
            Self::Nothing => NOTHING,
            Self::Inner(place) => place,
            Self::Leaf { place, count } => 1 << 31 | (count - 1) << PLACE_BITS | place,
        }
    }

    /// Of a node's reference.
    pub fn of(reference: u32) -> Self {
        let place = reference & ((1 << PLACE_BITS) - 1);
        match reference {
            NOTHING => Self::Nothing,
            _ if reference >> 31 == 0 => Self::Inner(place),
            _ => Self::Leaf { place, count: (reference >> PLACE_BITS & 3) + 1 },
        }
    }
}

impl Node {
    /// A node without children.
    pub const EMPTY: Self = Self {
        planes: [[[f32::MAX; WIDTH], [f32::MIN; WIDTH]]; 3],
        children: [NOTHING; WIDTH],
        reserved: [0; 4],
    };

    /// The box of a slot, empty where it holds nothing.
    pub fn bounds(&self, slot: usize) -> Aabb {
        let corner = |side: usize| Vec3::from([0, 1, 2].map(|axis| self.planes[axis][side][slot]));
        Aabb { min: corner(0), max: corner(1) }
    }

    /// Sets the box of a slot.
    pub fn set_bounds(&mut self, slot: usize, bounds: &Aabb) {
        for axis in 0..3 {
            self.planes[axis][0][slot] = bounds.min[axis];
            self.planes[axis][1][slot] = bounds.max[axis];
        }
    }
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
        assert_eq!(size_of::<Node>(), 128);
        assert_eq!(units(size_of::<Node>()), NODE_UNITS);
        assert_eq!(size_of::<Triangle>(), 48);
        assert_eq!(units(size_of::<Triangle>()), TRIANGLE_UNITS);
        assert_eq!(size_of::<InstanceRecord>(), 112);
        assert_eq!(units(size_of::<InstanceRecord>()), INSTANCE_UNITS);
    }

    #[test]
    fn offsets_are_the_documented_ones() {
        assert_eq!(offset_of!(Node, children), 96);
        assert_eq!(offset_of!(Triangle, primitive), 36);
        assert_eq!(offset_of!(InstanceRecord, world_to_object), 16);
        assert_eq!(offset_of!(InstanceRecord, object_to_world), 64);
    }

    #[test]
    fn a_record_outside_the_words_is_none() {
        let words = [0u32; 36];
        assert!(record::<Node>(&words, 0).is_some());
        assert!(record::<Node>(&words, 2).is_none());
        assert!(record::<Node>(&words, u32::MAX).is_none());
    }

    #[test]
    fn the_shader_has_the_same_constants() {
        let shader = include_str!("../../../shaders/include/bvh_layout.glsl");
        for (name, value) in [
            ("NODE_UNITS", NODE_UNITS),
            ("TRIANGLE_UNITS", TRIANGLE_UNITS),
            ("INSTANCE_UNITS", INSTANCE_UNITS),
            ("STACK_ENTRIES", STACK_ENTRIES as u32),
            ("MAX_STEPS", MAX_STEPS),
            ("PLACE_BITS", PLACE_BITS),
            ("NOTHING", NOTHING),
            ("FLAG_ALPHA_TESTED", FLAG_ALPHA_TESTED),
            ("FLAG_TWO_SIDED", FLAG_TWO_SIDED),
            ("FLAG_IDENTITY", FLAG_IDENTITY),
            ("FLAG_SPHERE", FLAG_SPHERE),
        ] {
            let line = format!("const uint BVH_{name} = {value}u;");
            assert!(shader.contains(&line), "{line}");
        }
        let reader = include_str!("../../../shaders/include/bvh_node.glsl");
        let line = format!("layout(constant_id = {WHOLE_UNITS_CONSTANT}) const bool BVH_WHOLE_UNITS");
        assert!(reader.contains(&line), "{line}");
    }

    #[test]
    fn the_stack_holds_both_levels() {
        assert!((MOST_WAITING_BLAS + MOST_WAITING_TLAS) as usize <= STACK_ENTRIES);
        // Shaders keep to it by a mask.
        assert!(STACK_ENTRIES.is_power_of_two());
    }

    #[test]
    fn references_say_what_they_are_made_of() {
        let leaf = |place, count| Child::Leaf { place, count };
        for child in [
            Child::Nothing,
            Child::Inner(0),
            Child::Inner(8 << 20),
            leaf(0, 1),
            leaf((1 << 29) - 3, 3),
            leaf(24, 4),
        ] {
            assert_eq!(Child::of(child.reference()), child);
        }
    }
}
