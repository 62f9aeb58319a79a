//! Images and their views.

use std::sync::Arc;

use ash::vk;
use gpu_allocator::MemoryLocation;
use parking_lot::Mutex;

use crate::buffer::Backing;
use crate::error::{Doing, GpuError};
use crate::gpu::{Gpu, Shared};
use crate::memory::{Heap, MemoryRequest};

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ImageKind {
    D1,
    D2,
    /// 2-D, whose full view is an array even with one layer.
    D2Array,
    D3,
    /// Six layers a cube.
    Cube,
}

/// An image to create.
#[derive(Debug, Clone, Copy)]
pub struct ImageDesc<'a> {
    pub name: &'a str,
    pub kind: ImageKind,
    pub format: vk::Format,
    /// Width, height, depth; depth is 1 but for 3-D images.
    pub extent: [u32; 3],
    pub mips: u32,
    /// Layers; 6 for a cube.
    pub layers: u32,
    pub samples: vk::SampleCountFlags,
    pub usage: vk::ImageUsageFlags,
    pub flags: vk::ImageCreateFlags,
}

impl<'a> ImageDesc<'a> {
    /// A plain 2-D image with one level.
    pub fn d2(
        name: &'a str,
        format: vk::Format,
        [width, height]: [u32; 2],
        usage: vk::ImageUsageFlags,
    ) -> Self {
        Self {
            name,
            kind: ImageKind::D2,
            format,
            extent: [width, height, 1],
            mips: 1,
            layers: 1,
            samples: vk::SampleCountFlags::TYPE_1,
            usage,
            flags: vk::ImageCreateFlags::empty(),
        }
    }

    pub fn d3(name: &'a str, format: vk::Format, extent: [u32; 3], usage: vk::ImageUsageFlags) -> Self {
        Self { kind: ImageKind::D3, extent, ..Self::d2(name, format, [1, 1], usage) }
    }

    /// A cube of `edge` by `edge` texels a side.
    pub fn cube(name: &'a str, format: vk::Format, edge: u32, usage: vk::ImageUsageFlags) -> Self {
        Self { kind: ImageKind::Cube, layers: 6, ..Self::d2(name, format, [edge, edge], usage) }
    }

    pub fn mips(self, mips: u32) -> Self {
        Self { mips, ..self }
    }

    /// Makes a 2-D image an array.
    pub fn layers(self, layers: u32) -> Self {
        Self { kind: ImageKind::D2Array, layers, ..self }
    }

    fn create_info(&self) -> vk::ImageCreateInfo<'static> {
        let [width, height, depth] = self.extent;
        let cube = match self.kind {
            ImageKind::Cube => vk::ImageCreateFlags::CUBE_COMPATIBLE,
            _ => vk::ImageCreateFlags::empty(),
        };
        vk::ImageCreateInfo::default()
            .flags(self.flags | cube)
            .image_type(match self.kind {
                ImageKind::D1 => vk::ImageType::TYPE_1D,
                ImageKind::D3 => vk::ImageType::TYPE_3D,
                ImageKind::D2 | ImageKind::D2Array | ImageKind::Cube => vk::ImageType::TYPE_2D,
            })
            .format(self.format)
            .extent(vk::Extent3D { width, height, depth })
            .mip_levels(self.mips)
            .array_layers(self.layers)
            .samples(self.samples)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(self.usage)
            .sharing_mode(vk::SharingMode::EXCLUSIVE)
            .initial_layout(vk::ImageLayout::UNDEFINED)
    }
}

/// A view to create of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ViewDesc {
    pub kind: vk::ImageViewType,
    pub format: vk::Format,
    pub aspects: vk::ImageAspectFlags,
    pub first_mip: u32,
    pub mips: u32,
    pub first_layer: u32,
    pub layers: u32,
    pub swizzle: [vk::ComponentSwizzle; 4],
}

impl ViewDesc {
    fn range(&self) -> vk::ImageSubresourceRange {
        vk::ImageSubresourceRange {
            aspect_mask: self.aspects,
            base_mip_level: self.first_mip,
            level_count: self.mips,
            base_array_layer: self.first_layer,
            layer_count: self.layers,
        }
    }
}

/// An image with its memory and views. It may be dropped while in use: the device finishes first.
pub struct Image {
    shared: Arc<Shared>,
    raw: vk::Image,
    kind: ImageKind,
    format: vk::Format,
    extent: [u32; 3],
    mips: u32,
    layers: u32,
    usage: vk::ImageUsageFlags,
    /// The view of everything first.
    views: Mutex<Vec<(ViewDesc, vk::ImageView)>>,
    /// `None` only while being dropped.
    backing: Option<Backing>,
}

/// Usages with which an image can have views at all.
const VIEW_USAGES: vk::ImageUsageFlags = vk::ImageUsageFlags::from_raw(
    vk::ImageUsageFlags::SAMPLED.as_raw()
        | vk::ImageUsageFlags::STORAGE.as_raw()
        | vk::ImageUsageFlags::COLOR_ATTACHMENT.as_raw()
        | vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT.as_raw()
        | vk::ImageUsageFlags::INPUT_ATTACHMENT.as_raw(),
);

impl Gpu {
    /// Creates an image whose contents and layout are undefined.
    pub fn create_image(&self, desc: &ImageDesc<'_>) -> Result<Image, GpuError> {
        let raw = self.raw_image(desc)?;
        // SAFETY: the image was just made.
        let requirements = unsafe { self.shared.device.get_image_memory_requirements(raw) };
        let request =
            MemoryRequest { name: desc.name, requirements, location: MemoryLocation::GpuOnly, linear: false };
        let bound = self.shared.memory.allocate(&request).and_then(|allocation| {
            // SAFETY: the memory was allocated for this image's requirements.
            let bound = unsafe {
                self.shared.device.bind_image_memory(raw, allocation.memory(), allocation.offset())
            };
            match bound.doing("bind an image's memory") {
                Ok(()) => Ok(Backing::Own(allocation)),
                Err(error) => {
                    self.shared.memory.free(allocation);
                    Err(error)
                }
            }
        });
        self.finish_image(desc, raw, bound)
    }

    /// Creates an image in a heap, `offset` bytes from its start.
    pub fn place_image(&self, desc: &ImageDesc<'_>, heap: &Heap, offset: u64) -> Result<Image, GpuError> {
        let raw = self.raw_image(desc)?;
        // SAFETY: the image was just made.
        let requirements = unsafe { self.shared.device.get_image_memory_requirements(raw) };
        let bound = heap
            .place(offset, &requirements)
            .and_then(|(memory, offset)| {
                // SAFETY: the heap has checked that the image fits.
                unsafe { self.shared.device.bind_image_memory(raw, memory, offset) }
                    .doing("bind an image to a heap")
            })
            .map(|()| Backing::Heap(heap.clone()));
        self.finish_image(desc, raw, bound)
    }

    /// Bytes, alignment and memory types that an image needs in a heap.
    pub fn image_requirements(&self, desc: &ImageDesc<'_>) -> Result<vk::MemoryRequirements, GpuError> {
        let raw = self.raw_image(desc)?;
        // SAFETY: the image was just made, and is not used after.
        unsafe {
            let requirements = self.shared.device.get_image_memory_requirements(raw);
            self.shared.device.destroy_image(raw, None);
            Ok(requirements)
        }
    }

    fn raw_image(&self, desc: &ImageDesc<'_>) -> Result<vk::Image, GpuError> {
        self.check_image(desc)?;
        // SAFETY: the description was checked, and the device is alive.
        unsafe { self.shared.device.create_image(&desc.create_info(), None) }.doing("create an image")
    }

    /// Asks the device whether it makes such an image.
    fn check_image(&self, desc: &ImageDesc<'_>) -> Result<(), GpuError> {
        let info = desc.create_info();
        let invalid = |detail: String| GpuError::Invalid {
            what: "the device cannot make this image",
            detail: format!("{}: {:?} {:?}: {detail}", desc.name, desc.extent, desc.format),
        };
        // SAFETY: a plain query on a device that is alive.
        let limits = unsafe {
            self.instance().get_physical_device_image_format_properties(
                self.physical_device(),
                desc.format,
                info.image_type,
                info.tiling,
                info.usage,
                info.flags,
            )
        }
        .map_err(|error| invalid(error.to_string()))?;
        let most = limits.max_extent;
        let fits = desc.extent.iter().all(|&side| side > 0)
            && desc.extent[0] <= most.width
            && desc.extent[1] <= most.height
            && desc.extent[2] <= most.depth
            && (1..=limits.max_mip_levels).contains(&desc.mips)
            && (1..=limits.max_array_layers).contains(&desc.layers)
            && limits.sample_counts.contains(desc.samples);
        fits.then_some(()).ok_or_else(|| invalid(format!("the limits are {limits:?}")))
    }

    fn finish_image(
        &self,
        desc: &ImageDesc<'_>,
        raw: vk::Image,
        bound: Result<Backing, GpuError>,
    ) -> Result<Image, GpuError> {
        let backing = match bound {
            Ok(backing) => backing,
            Err(error) => {
                // SAFETY: nothing uses the image yet.
                unsafe { self.shared.device.destroy_image(raw, None) };
                return Err(error);
            }
        };
        self.shared.set_name(raw, desc.name);
        let image = Image {
            shared: self.shared.clone(),
            raw,
            kind: desc.kind,
            format: desc.format,
            extent: desc.extent,
            mips: desc.mips,
            layers: desc.layers,
            usage: desc.usage,
            views: Mutex::default(),
            backing: Some(backing),
        };
        if desc.usage.intersects(VIEW_USAGES) {
            image.view_of(&image.whole_view())?;
        }
        Ok(image)
    }
}

impl Image {
    pub fn raw(&self) -> vk::Image {
        self.raw
    }

    pub fn format(&self) -> vk::Format {
        self.format
    }

    /// Width, height, depth in texels.
    pub fn extent(&self) -> [u32; 3] {
        self.extent
    }

    /// Width, height, depth of a level.
    pub fn mip_extent(&self, mip: u32) -> [u32; 3] {
        self.extent.map(|side| (side >> mip).max(1))
    }

    pub fn mips(&self) -> u32 {
        self.mips
    }

    pub fn layers(&self) -> u32 {
        self.layers
    }

    pub fn usage(&self) -> vk::ImageUsageFlags {
        self.usage
    }

    /// Every level and layer, and every aspect that the format has.
    pub fn whole_range(&self) -> vk::ImageSubresourceRange {
        self.whole_view().range()
    }

    /// The view of the whole image; null if its usage allows no views.
    pub fn view(&self) -> vk::ImageView {
        self.views.lock().first().map_or(vk::ImageView::null(), |(_, view)| *view)
    }

    /// How the view of the whole image is described, to make others from.
    pub fn whole_view(&self) -> ViewDesc {
        ViewDesc {
            kind: match self.kind {
                ImageKind::D1 => vk::ImageViewType::TYPE_1D,
                ImageKind::D2 if self.layers == 1 => vk::ImageViewType::TYPE_2D,
                ImageKind::D2 | ImageKind::D2Array => vk::ImageViewType::TYPE_2D_ARRAY,
                ImageKind::D3 => vk::ImageViewType::TYPE_3D,
                ImageKind::Cube if self.layers == 6 => vk::ImageViewType::CUBE,
                ImageKind::Cube => vk::ImageViewType::CUBE_ARRAY,
            },
            format: self.format,
            aspects: aspects(self.format),
            first_mip: 0,
            mips: self.mips,
            first_layer: 0,
            layers: self.layers,
            swizzle: [vk::ComponentSwizzle::IDENTITY; 4],
        }
    }

    /// A 2-D view of one level of one layer (or of a whole level of a 3-D image), to draw or write to.
    pub fn view_of_mip(&self, mip: u32, layer: u32) -> Result<vk::ImageView, GpuError> {
        let mut desc = self.whole_view();
        desc.first_mip = mip;
        desc.mips = 1;
        if self.kind != ImageKind::D3 {
            desc.kind = vk::ImageViewType::TYPE_2D;
            desc.first_layer = layer;
            desc.layers = 1;
        }
        self.view_of(&desc)
    }

    /// A view of one aspect, as sampling from depth and stencil needs it.
    pub fn view_of_aspect(&self, aspect: vk::ImageAspectFlags) -> Result<vk::ImageView, GpuError> {
        let mut desc = self.whole_view();
        desc.aspects = aspect;
        self.view_of(&desc)
    }

    /// A view, which lives as long as the image. The same description gives the same view.
    pub fn view_of(&self, desc: &ViewDesc) -> Result<vk::ImageView, GpuError> {
        let mut views = self.views.lock();
        if let Some((_, view)) = views.iter().find(|(known, _)| known == desc) {
            return Ok(*view);
        }
        let [r, g, b, a] = desc.swizzle;
        let info = vk::ImageViewCreateInfo::default()
            .image(self.raw)
            .view_type(desc.kind)
            .format(desc.format)
            .components(vk::ComponentMapping { r, g, b, a })
            .subresource_range(desc.range());
        // SAFETY: the image is alive; the validation layer checks that the description suits it.
        let view =
            unsafe { self.shared.device.create_image_view(&info, None) }.doing("create an image view")?;
        views.push((*desc, view));
        Ok(view)
    }
}

impl Drop for Image {
    fn drop(&mut self) {
        let raw = self.raw;
        let views = std::mem::take(self.views.get_mut());
        let (allocation, _heap) = Backing::split(self.backing.take());
        self.shared.retire(move |shared: &Shared| {
            // SAFETY: the device has finished with them, and their handles go with them.
            unsafe {
                for (_, view) in views {
                    shared.device.destroy_image_view(view, None);
                }
                shared.device.destroy_image(raw, None);
            }
            if let Some(allocation) = allocation {
                shared.memory.free(allocation);
            }
        });
        // A heap is given up only now: its memory is to be freed after the image is destroyed.
    }
}

/// Depth, stencil, both, or colour.
pub fn aspects(format: vk::Format) -> vk::ImageAspectFlags {
    match format {
        vk::Format::D16_UNORM | vk::Format::X8_D24_UNORM_PACK32 | vk::Format::D32_SFLOAT => {
            vk::ImageAspectFlags::DEPTH
        }
        vk::Format::S8_UINT => vk::ImageAspectFlags::STENCIL,
        vk::Format::D16_UNORM_S8_UINT | vk::Format::D24_UNORM_S8_UINT | vk::Format::D32_SFLOAT_S8_UINT => {
            vk::ImageAspectFlags::DEPTH | vk::ImageAspectFlags::STENCIL
        }
        _ => vk::ImageAspectFlags::COLOR,
    }
}
