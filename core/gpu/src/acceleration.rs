//! Acceleration structures: what hardware rays go through, built by the driver.
//!
//! A bottom level has geometries of one kind, triangles or boxes; a top level has instances of bottom levels. Both are
//! created with the size that [`Gpu::structure_sizes`] answers for what they are built from, and built by commands. Updates
//! move primitives; what was without area when its structure was built must stay so, and nothing else may become so.

use std::sync::Arc;

use ash::vk;

use crate::buffer::{Buffer, BufferDesc, BufferKind};
use crate::commands::Commands;
use crate::error::{Doing, GpuError};
use crate::gpu::{Gpu, Shared};

/// Bytes of a corner: three floats.
const CORNER_BYTES: u64 = 12;
/// Bytes of a box: six floats, the least corner first.
const BOX_BYTES: u64 = 24;

/// Triangles or boxes at a device address. Their buffer has the usage [`STRUCTURE_INPUT`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StructureGeometry {
    pub shape: StructureShape,
    /// Of the first triangle or box; a multiple of 4 for triangles, of 8 for boxes.
    pub address: vk::DeviceAddress,
    /// How many triangles or boxes.
    pub count: u32,
    /// No any-hit shader is asked about them.
    pub is_opaque: bool,
}

/// Usage of buffers that structures are built from.
pub const STRUCTURE_INPUT: vk::BufferUsageFlags =
    vk::BufferUsageFlags::ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_KHR;

/// What a geometry's primitives are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StructureShape {
    /// Three corners of three floats each, all finite. Triangles without area are not met. Vulkan knows inactive
    /// triangles too (x is not a number), but lavapipe loses others of a structure that has some.
    Triangles,
    /// Least and greatest corner, all finite; inactive boxes are as triangles are.
    Boxes,
}

/// An instance of a bottom level, as the device reads it (VkAccelerationStructureInstanceKHR).
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct StructureInstance {
    /// Where the object lies: row-major 3x4.
    pub object_to_world: [[f32; 4]; 3],
    /// 24 bits that a hit reports, and the mask above them.
    pub id_and_mask: u32,
    /// 24 bits of the offset into the hit groups, and flags above them.
    pub hit_group_and_flags: u32,
    /// Address of the bottom level.
    pub structure: vk::DeviceAddress,
}

impl StructureInstance {
    /// The greatest id.
    pub const MOST_ID: u32 = (1 << 24) - 1;

    /// An instance whose triangles face the origins of rays that see their corners run counter-clockwise, in right-handed
    /// coordinates: Vulkan's clockwise is meant in left-handed ones. Of `id` and `hit_group` 24 bits count.
    pub fn new(
        object_to_world: [[f32; 4]; 3],
        structure: vk::DeviceAddress,
        id: u32,
        mask: u8,
        hit_group: u32,
    ) -> Self {
        let flags = vk::GeometryInstanceFlagsKHR::TRIANGLE_FACING_CULL_DISABLE;
        Self {
            object_to_world,
            id_and_mask: id & Self::MOST_ID | u32::from(mask) << 24,
            hit_group_and_flags: hit_group & Self::MOST_ID | flags.as_raw() << 24,
            structure,
        }
    }
}

/// What a structure is built from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StructureInput<'a> {
    /// Geometries of one shape.
    BottomLevel(&'a [StructureGeometry]),
    /// So many [`StructureInstance`]s at an address that is a multiple of 16.
    TopLevel { address: vk::DeviceAddress, count: u32 },
}

/// What a structure is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StructureUse {
    /// Traced for long: traced fast, and compacted once it is built.
    Lasting,
    /// Changes soon: built fast, and can be updated.
    Changing,
}

/// Bytes that a structure and its builds take.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StructureSizes {
    pub structure: u64,
    /// Scratch memory of a build.
    pub build: u64,
    /// Scratch memory of an update.
    pub update: u64,
}

/// A structure with its memory. It may be dropped while in use: the device finishes first.
pub struct AccelerationStructure {
    shared: Arc<Shared>,
    raw: vk::AccelerationStructureKHR,
    address: vk::DeviceAddress,
    /// Given up after the structure: fields are dropped in order, after [`Drop::drop`].
    buffer: Buffer,
}

/// A structure to build, from input that has the sizes it was created for.
#[derive(Clone, Copy)]
pub struct StructureBuild<'a> {
    pub target: &'a AccelerationStructure,
    pub input: StructureInput<'a>,
    pub structure_use: StructureUse,
    /// Only positions differ from those of the last build of this [`StructureUse::Changing`] structure.
    pub is_update: bool,
    /// Bytes of scratch memory that the build, or the update, takes.
    pub scratch_bytes: u64,
}

impl Gpu {
    /// Bytes that a structure of this input takes.
    pub fn structure_sizes(
        &self,
        input: StructureInput<'_>,
        structure_use: StructureUse,
    ) -> Result<StructureSizes, GpuError> {
        let ray_tracing = self.shared.ray_tracing()?;
        let limits = &ray_tracing.limits;
        check_count("geometries", input.geometry_count(), limits.geometries)?;
        let most = if input.is_top_level() { limits.instances } else { limits.primitives };
        check_count("primitives", input.primitive_count(), most)?;
        let description = Description::new(input, structure_use);
        let counts: Vec<u32> = description.ranges.iter().map(|range| range.primitive_count).collect();
        let mut sizes = vk::AccelerationStructureBuildSizesInfoKHR::default();
        // SAFETY: one count a geometry, of this device.
        unsafe {
            ray_tracing.structures.get_acceleration_structure_build_sizes(
                vk::AccelerationStructureBuildTypeKHR::DEVICE,
                &description.info(),
                &counts,
                &mut sizes,
            );
        }
        Ok(StructureSizes {
            structure: sizes.acceleration_structure_size,
            build: sizes.build_scratch_size,
            update: sizes.update_scratch_size,
        })
    }

    /// Creates a structure of so many bytes, which is to be built before anything is traced.
    pub fn create_structure(
        &self,
        name: &str,
        is_top_level: bool,
        bytes: u64,
    ) -> Result<AccelerationStructure, GpuError> {
        let ray_tracing = self.shared.ray_tracing()?;
        let desc = BufferDesc::new(name, BufferKind::Device, bytes)
            .usage(vk::BufferUsageFlags::ACCELERATION_STRUCTURE_STORAGE_KHR);
        let buffer = self.create_buffer(&desc)?;
        let info = vk::AccelerationStructureCreateInfoKHR::default()
            .ty(level(is_top_level))
            .buffer(buffer.raw())
            .size(bytes);
        // SAFETY: the buffer has these bytes, and a structure's usage.
        let raw = unsafe { ray_tracing.structures.create_acceleration_structure(&info, None) }
            .doing("create an acceleration structure")?;
        self.shared.set_name(raw, name);
        let info = vk::AccelerationStructureDeviceAddressInfoKHR::default().acceleration_structure(raw);
        // SAFETY: the structure was just made.
        let address = unsafe { ray_tracing.structures.get_acceleration_structure_device_address(&info) };
        Ok(AccelerationStructure { shared: self.shared.clone(), raw, address, buffer })
    }
}

impl AccelerationStructure {
    /// What instances, and the top level's rays, name it by.
    pub fn address(&self) -> vk::DeviceAddress {
        self.address
    }

    /// Bytes of memory.
    pub fn size(&self) -> u64 {
        self.buffer.size()
    }

    pub(crate) fn raw(&self) -> vk::AccelerationStructureKHR {
        self.raw
    }
}

impl Drop for AccelerationStructure {
    fn drop(&mut self) {
        let raw = self.raw;
        self.shared.retire(move |shared: &Shared| {
            if let Some(ray_tracing) = &shared.ray_tracing {
                // SAFETY: the device has finished with it, and its handle goes with it.
                unsafe { ray_tracing.structures.destroy_acceleration_structure(raw, None) };
            }
        });
    }
}

impl Commands<'_> {
    /// Builds structures, in any order, each with scratch memory of its own. Nothing is recorded on a device without
    /// acceleration structures.
    pub(crate) fn build_chunk(&self, builds: &[StructureBuild<'_>], scratch: &[vk::DeviceAddress]) {
        let (Some(ray_tracing), false) = (&self.shared.ray_tracing, builds.is_empty()) else {
            return;
        };
        let descriptions: Vec<_> =
            builds.iter().map(|build| Description::new(build.input, build.structure_use)).collect();
        let infos: Vec<_> = builds
            .iter()
            .zip(&descriptions)
            .zip(scratch)
            .map(|((build, description), &device_address)| {
                let scratch = vk::DeviceOrHostAddressKHR { device_address };
                let info =
                    description.info().dst_acceleration_structure(build.target.raw).scratch_data(scratch);
                match build.is_update {
                    true => info
                        .mode(vk::BuildAccelerationStructureModeKHR::UPDATE)
                        .src_acceleration_structure(build.target.raw),
                    false => info.mode(vk::BuildAccelerationStructureModeKHR::BUILD),
                }
            })
            .collect();
        let ranges: Vec<&[_]> =
            descriptions.iter().map(|description| description.ranges.as_slice()).collect();
        // SAFETY: the buffer is being recorded; the structures are this device's, and the validation layer checks the rest.
        unsafe { ray_tracing.structures.cmd_build_acceleration_structures(self.raw(), &infos, &ranges) };
    }

    /// Copies a structure that was built as [`StructureUse::Lasting`] into a smaller one, of the size that was
    /// answered for it.
    pub fn compact_structure(&self, from: &AccelerationStructure, to: &AccelerationStructure) {
        let Some(ray_tracing) = &self.shared.ray_tracing else {
            return;
        };
        let info = vk::CopyAccelerationStructureInfoKHR::default()
            .src(from.raw)
            .dst(to.raw)
            .mode(vk::CopyAccelerationStructureModeKHR::COMPACT);
        // SAFETY: both are this device's.
        unsafe { ray_tracing.structures.cmd_copy_acceleration_structure(self.raw(), &info) };
    }
}

impl StructureInput<'_> {
    fn is_top_level(self) -> bool {
        matches!(self, Self::TopLevel { .. })
    }

    fn geometry_count(self) -> u64 {
        match self {
            Self::BottomLevel(geometries) => geometries.len() as u64,
            Self::TopLevel { .. } => 1,
        }
    }

    fn primitive_count(self) -> u64 {
        match self {
            Self::BottomLevel(geometries) => {
                geometries.iter().map(|geometry| u64::from(geometry.count)).sum()
            }
            Self::TopLevel { count, .. } => u64::from(count),
        }
    }
}

/// An input in the form that Vulkan takes.
struct Description {
    is_top_level: bool,
    structure_use: StructureUse,
    geometries: Vec<vk::AccelerationStructureGeometryKHR<'static>>,
    ranges: Vec<vk::AccelerationStructureBuildRangeInfoKHR>,
}

impl Description {
    fn new(input: StructureInput<'_>, structure_use: StructureUse) -> Self {
        let range = |count| {
            vk::AccelerationStructureBuildRangeInfoKHR::default()
                .primitive_count(count)
                .primitive_offset(0)
                .first_vertex(0)
                .transform_offset(0)
        };
        let (geometries, ranges) = match input {
            StructureInput::BottomLevel(geometries) => (
                geometries.iter().map(geometry_data).collect(),
                geometries.iter().map(|geometry| range(geometry.count)).collect(),
            ),
            StructureInput::TopLevel { address, count } => (vec![instance_data(address)], vec![range(count)]),
        };
        Self { is_top_level: input.is_top_level(), structure_use, geometries, ranges }
    }

    fn info(&self) -> vk::AccelerationStructureBuildGeometryInfoKHR<'_> {
        use vk::BuildAccelerationStructureFlagsKHR as Flags;
        let flags = match (self.structure_use, self.is_top_level) {
            (StructureUse::Lasting, _) => Flags::PREFER_FAST_TRACE | Flags::ALLOW_COMPACTION,
            (StructureUse::Changing, false) => Flags::PREFER_FAST_BUILD | Flags::ALLOW_UPDATE,
            // A top level is built anew: its instances come and go.
            (StructureUse::Changing, true) => Flags::PREFER_FAST_BUILD,
        };
        vk::AccelerationStructureBuildGeometryInfoKHR::default()
            .ty(level(self.is_top_level))
            .flags(flags)
            .geometries(&self.geometries)
    }
}

fn level(is_top_level: bool) -> vk::AccelerationStructureTypeKHR {
    match is_top_level {
        true => vk::AccelerationStructureTypeKHR::TOP_LEVEL,
        false => vk::AccelerationStructureTypeKHR::BOTTOM_LEVEL,
    }
}

fn geometry_data(geometry: &StructureGeometry) -> vk::AccelerationStructureGeometryKHR<'static> {
    let data = vk::DeviceOrHostAddressConstKHR { device_address: geometry.address };
    let described = vk::AccelerationStructureGeometryKHR::default().flags(match geometry.is_opaque {
        true => vk::GeometryFlagsKHR::OPAQUE,
        false => vk::GeometryFlagsKHR::empty(),
    });
    match geometry.shape {
        StructureShape::Triangles => {
            let triangles = vk::AccelerationStructureGeometryTrianglesDataKHR::default()
                .vertex_format(vk::Format::R32G32B32_SFLOAT)
                .vertex_data(data)
                .vertex_stride(CORNER_BYTES)
                .max_vertex(geometry.count.saturating_mul(3).saturating_sub(1))
                .index_type(vk::IndexType::NONE_KHR);
            described
                .geometry_type(vk::GeometryTypeKHR::TRIANGLES)
                .geometry(vk::AccelerationStructureGeometryDataKHR { triangles })
        }
        StructureShape::Boxes => {
            let aabbs = vk::AccelerationStructureGeometryAabbsDataKHR::default().data(data).stride(BOX_BYTES);
            described
                .geometry_type(vk::GeometryTypeKHR::AABBS)
                .geometry(vk::AccelerationStructureGeometryDataKHR { aabbs })
        }
    }
}

fn instance_data(address: vk::DeviceAddress) -> vk::AccelerationStructureGeometryKHR<'static> {
    let instances = vk::AccelerationStructureGeometryInstancesDataKHR::default()
        .array_of_pointers(false)
        .data(vk::DeviceOrHostAddressConstKHR { device_address: address });
    vk::AccelerationStructureGeometryKHR::default()
        .geometry_type(vk::GeometryTypeKHR::INSTANCES)
        .geometry(vk::AccelerationStructureGeometryDataKHR { instances })
}

fn check_count(what: &'static str, count: u64, most: u64) -> Result<(), GpuError> {
    if count > most {
        let detail = format!("{count} {what}, the device takes {most}");
        return Err(GpuError::Invalid { what: "an acceleration structure is too large", detail });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_instance_is_what_the_device_reads() {
        let rows = [[1.0, 0.0, 0.0, 4.0], [0.0, 1.0, 0.0, 5.0], [0.0, 0.0, 1.0, 6.0]];
        let instance = StructureInstance::new(rows, 0x1_0000_0040, 7, 0xa5, 1);
        assert_eq!(size_of::<StructureInstance>(), size_of::<vk::AccelerationStructureInstanceKHR>());
        let words: [u32; 16] = bytemuck::cast(instance);
        assert_eq!(words[3], 4.0_f32.to_bits());
        // Neither facing is culled (1).
        assert_eq!(words[12..], [0xa500_0007, 0x0100_0001, 0x40, 1]);
    }
}
