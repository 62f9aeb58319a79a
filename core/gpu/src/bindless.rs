//! One descriptor set for all images and samplers; shaders name them by index.
//!
//! ```glsl
//! layout(set = 0, binding = 0) uniform texture2D textures_2d[];
//! layout(set = 0, binding = 1) uniform textureCube textures_cube[];
//! layout(set = 0, binding = 2) uniform texture3D textures_3d[];
//! layout(set = 0, binding = 3) uniform sampler samplers[];
//! layout(set = 0, binding = 4, rgba16f) uniform image2D storage_images[];
//! layout(set = 0, binding = 5) uniform texture2D drawn_images[];
//! ```
//! What is drawn into and then read has an array of its own: validation takes a shader that reads one image of an
//! array for a reader of them all.
//! Slots may be filled while the set is bound and in use, as long as what is in flight does not read them.

use std::sync::Arc;

use ash::vk;
use parking_lot::Mutex;

use crate::error::{Doing, GpuError};
use crate::gpu::{Gpu, Shared};

/// The arrays of the table; the discriminants are the bindings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum BindlessKind {
    Texture2d = 0,
    TextureCube = 1,
    Texture3d = 2,
    Sampler = 3,
    StorageImage = 4,
    DrawnImage = 5,
}

impl BindlessKind {
    const ALL: [Self; 6] = [
        Self::Texture2d,
        Self::TextureCube,
        Self::Texture3d,
        Self::Sampler,
        Self::StorageImage,
        Self::DrawnImage,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Texture2d => "2-D textures",
            Self::TextureCube => "cube textures",
            Self::Texture3d => "3-D textures",
            Self::Sampler => "samplers",
            Self::StorageImage => "storage images",
            Self::DrawnImage => "drawn images",
        }
    }

    fn descriptor(self) -> vk::DescriptorType {
        match self {
            Self::Texture2d | Self::TextureCube | Self::Texture3d | Self::DrawnImage => {
                vk::DescriptorType::SAMPLED_IMAGE
            }
            Self::Sampler => vk::DescriptorType::SAMPLER,
            Self::StorageImage => vk::DescriptorType::STORAGE_IMAGE,
        }
    }
}

/// Slots of each kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BindlessSizes {
    pub textures_2d: u32,
    pub textures_cube: u32,
    pub textures_3d: u32,
    pub samplers: u32,
    pub storage_images: u32,
    pub drawn_images: u32,
}

impl Default for BindlessSizes {
    fn default() -> Self {
        Self {
            textures_2d: 16_384,
            textures_cube: 256,
            textures_3d: 256,
            samplers: 1024,
            storage_images: 1024,
            drawn_images: 64,
        }
    }
}

/// What a device allows in one set that is updated after binding.
#[derive(Debug, Clone, Copy)]
struct BindlessLimits {
    sampled_images: u32,
    samplers: u32,
    storage_images: u32,
    /// Of all kinds together, a stage.
    resources: u32,
}

impl BindlessSizes {
    /// Shrinks the arrays to what the device allows: 2-D textures give way first.
    fn limited(self, limits: &BindlessLimits) -> Self {
        let samplers = self.samplers.min(limits.samplers);
        let storage_images = self.storage_images.min(limits.storage_images);
        let left = limits
            .resources
            .saturating_sub(samplers)
            .saturating_sub(storage_images)
            .min(limits.sampled_images);
        let textures_cube = self.textures_cube.min(left / 4);
        let textures_3d = self.textures_3d.min(left / 4);
        let drawn_images = self.drawn_images.min(left / 8);
        Self {
            textures_2d: self.textures_2d.min(left - textures_cube - textures_3d - drawn_images),
            textures_cube,
            textures_3d,
            samplers,
            storage_images,
            drawn_images,
        }
    }

    fn of(&self, kind: BindlessKind) -> u32 {
        match kind {
            BindlessKind::Texture2d => self.textures_2d,
            BindlessKind::TextureCube => self.textures_cube,
            BindlessKind::Texture3d => self.textures_3d,
            BindlessKind::Sampler => self.samplers,
            BindlessKind::StorageImage => self.storage_images,
            BindlessKind::DrawnImage => self.drawn_images,
        }
    }
}

/// Which slots of one array are taken.
#[derive(Debug, Default)]
struct Slots {
    capacity: u32,
    /// Slots at and above this were never taken.
    fresh: u32,
    free: Vec<u32>,
}

impl Slots {
    fn take(&mut self) -> Option<u32> {
        self.free.pop().or_else(|| {
            (self.fresh < self.capacity).then(|| {
                self.fresh += 1;
                self.fresh - 1
            })
        })
    }

    fn give_back(&mut self, index: u32) {
        debug_assert!(index < self.fresh && !self.free.contains(&index));
        self.free.push(index);
    }
}

/// The table. It may be dropped while in use.
pub struct BindlessTable {
    shared: Arc<Shared>,
    sizes: BindlessSizes,
    layout: vk::DescriptorSetLayout,
    pool: vk::DescriptorPool,
    /// Locked while it is written.
    set: Mutex<vk::DescriptorSet>,
    slots: Arc<Mutex<[Slots; BindlessKind::ALL.len()]>>,
}

impl Gpu {
    /// Makes a table with slots as asked for, or as many as the device allows.
    pub fn create_bindless_table(&self, sizes: BindlessSizes) -> Result<BindlessTable, GpuError> {
        let sizes = sizes.limited(&self.bindless_limits());
        let layout = self.bindless_layout(&sizes)?;
        let (pool, set) = match self.bindless_set(&sizes, layout) {
            Ok(made) => made,
            Err(error) => {
                // SAFETY: nothing uses the layout yet.
                unsafe { self.device().destroy_descriptor_set_layout(layout, None) };
                return Err(error);
            }
        };
        self.shared.set_name(set, "bindless table");
        let slots = BindlessKind::ALL.map(|kind| Slots { capacity: sizes.of(kind), ..Slots::default() });
        Ok(BindlessTable {
            shared: self.shared.clone(),
            sizes,
            layout,
            pool,
            set: Mutex::new(set),
            slots: Arc::new(Mutex::new(slots)),
        })
    }

    fn bindless_limits(&self) -> BindlessLimits {
        let mut of = vk::PhysicalDeviceVulkan12Properties::default();
        let mut root = vk::PhysicalDeviceProperties2::default().push_next(&mut of);
        // SAFETY: the device knows Vulkan 1.2.
        unsafe {
            self.instance().get_physical_device_properties2(self.physical_device(), &mut root);
        }
        BindlessLimits {
            sampled_images: of
                .max_descriptor_set_update_after_bind_sampled_images
                .min(of.max_per_stage_descriptor_update_after_bind_sampled_images),
            samplers: of
                .max_descriptor_set_update_after_bind_samplers
                .min(of.max_per_stage_descriptor_update_after_bind_samplers),
            storage_images: of
                .max_descriptor_set_update_after_bind_storage_images
                .min(of.max_per_stage_descriptor_update_after_bind_storage_images),
            resources: of
                .max_per_stage_update_after_bind_resources
                .min(of.max_update_after_bind_descriptors_in_all_pools),
        }
    }

    fn bindless_layout(&self, sizes: &BindlessSizes) -> Result<vk::DescriptorSetLayout, GpuError> {
        let bindings = BindlessKind::ALL.map(|kind| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(kind as u32)
                .descriptor_type(kind.descriptor())
                .descriptor_count(sizes.of(kind))
                .stage_flags(vk::ShaderStageFlags::ALL)
        });
        let flags = [vk::DescriptorBindingFlags::PARTIALLY_BOUND
            | vk::DescriptorBindingFlags::UPDATE_AFTER_BIND
            | vk::DescriptorBindingFlags::UPDATE_UNUSED_WHILE_PENDING;
            BindlessKind::ALL.len()];
        let mut flags = vk::DescriptorSetLayoutBindingFlagsCreateInfo::default().binding_flags(&flags);
        let info = vk::DescriptorSetLayoutCreateInfo::default()
            .flags(vk::DescriptorSetLayoutCreateFlags::UPDATE_AFTER_BIND_POOL)
            .bindings(&bindings)
            .push_next(&mut flags);
        // SAFETY: the features for these flags are required of every device.
        unsafe { self.device().create_descriptor_set_layout(&info, None) }.doing("create the bindless layout")
    }

    fn bindless_set(
        &self,
        sizes: &BindlessSizes,
        layout: vk::DescriptorSetLayout,
    ) -> Result<(vk::DescriptorPool, vk::DescriptorSet), GpuError> {
        let counts = BindlessKind::ALL
            .map(|kind| vk::DescriptorPoolSize { ty: kind.descriptor(), descriptor_count: sizes.of(kind) });
        let info = vk::DescriptorPoolCreateInfo::default()
            .flags(vk::DescriptorPoolCreateFlags::UPDATE_AFTER_BIND)
            .max_sets(1)
            .pool_sizes(&counts);
        let device = self.device();
        // SAFETY: the device is alive, and the layout was just made.
        unsafe {
            let pool = device.create_descriptor_pool(&info, None).doing("create the bindless pool")?;
            let layouts = [layout];
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
            match device.allocate_descriptor_sets(&info) {
                Ok(sets) => Ok((pool, sets[0])),
                Err(result) => {
                    device.destroy_descriptor_pool(pool, None);
                    Err(result).doing("allocate the bindless set")
                }
            }
        }
    }
}

impl BindlessTable {
    pub fn layout(&self) -> vk::DescriptorSetLayout {
        self.layout
    }

    pub fn set(&self) -> vk::DescriptorSet {
        *self.set.lock()
    }

    /// The slots there are, after the device's limits.
    pub fn sizes(&self) -> &BindlessSizes {
        &self.sizes
    }

    /// Puts a view into a free slot of a texture array (or of the storage images, in layout `GENERAL`).
    /// The view must live until the slot is given back.
    pub fn add_image(
        &self,
        kind: BindlessKind,
        view: vk::ImageView,
        layout: vk::ImageLayout,
    ) -> Result<u32, GpuError> {
        self.add(kind, vk::DescriptorImageInfo::default().image_view(view).image_layout(layout))
    }

    /// Puts a sampler into a free slot. It must live until the slot is given back.
    pub fn add_sampler(&self, sampler: vk::Sampler) -> Result<u32, GpuError> {
        self.add(BindlessKind::Sampler, vk::DescriptorImageInfo::default().sampler(sampler))
    }

    /// Gives a slot back. It is filled anew only when the device has finished what may still read it.
    pub fn remove(&self, kind: BindlessKind, index: u32) {
        let slots = self.slots.clone();
        self.shared.retire(move |_: &Shared| {
            slots.lock()[kind as usize].give_back(index);
        });
    }

    fn add(&self, kind: BindlessKind, info: vk::DescriptorImageInfo) -> Result<u32, GpuError> {
        let index = self.slots.lock()[kind as usize].take();
        let index = index
            .ok_or_else(|| GpuError::BindlessFull { kind: kind.name(), capacity: self.sizes.of(kind) })?;
        let infos = [info];
        let set = self.set.lock();
        let write = vk::WriteDescriptorSet::default()
            .dst_set(*set)
            .dst_binding(kind as u32)
            .dst_array_element(index)
            .descriptor_type(kind.descriptor())
            .image_info(&infos);
        // SAFETY: the set is locked, the slot is inside its array, and nothing in flight reads it.
        unsafe { self.shared.device.update_descriptor_sets(&[write], &[]) };
        Ok(index)
    }
}

impl Drop for BindlessTable {
    fn drop(&mut self) {
        let (layout, pool) = (self.layout, self.pool);
        self.shared.retire(move |shared: &Shared| {
            // SAFETY: the device has finished with them, and their handles go with the table.
            unsafe {
                shared.device.destroy_descriptor_pool(pool, None);
                shared.device.destroy_descriptor_set_layout(layout, None);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slots_run_out_and_come_back() {
        let mut slots = Slots { capacity: 2, ..Slots::default() };
        assert_eq!([slots.take(), slots.take(), slots.take()], [Some(0), Some(1), None]);
        slots.give_back(0);
        assert_eq!([slots.take(), slots.take()], [Some(0), None]);
    }

    #[test]
    fn a_small_device_gets_a_small_table() {
        let limits = BindlessLimits { sampled_images: 1000, samplers: 16, storage_images: 8, resources: 524 };
        let sizes = BindlessSizes::default().limited(&limits);
        assert_eq!(sizes.samplers, 16);
        assert_eq!(sizes.storage_images, 8);
        assert_eq!(sizes.textures_cube, 125);
        let all: u32 = BindlessKind::ALL.map(|kind| sizes.of(kind)).iter().sum();
        assert_eq!(all, 524);

        let plenty = BindlessLimits {
            sampled_images: 1 << 20,
            samplers: 1 << 20,
            storage_images: 1 << 20,
            resources: 1 << 22,
        };
        let sizes = BindlessSizes::default();
        assert_eq!(sizes.limited(&plenty), sizes);
    }
}
