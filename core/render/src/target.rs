//! What is drawn into: the window's colour, depth and stencil, the highest row first.

use afterglow_frame_graph::{Access, Format, ImageDesc as GraphImage, ResourceState};
use afterglow_gpu::{self as base, Gpu, GpuError, Image, ImageDesc, image_barrier, vk};

/// Colour, the same on every device.
pub(crate) const COLOR_FORMAT: vk::Format = vk::Format::R8G8B8A8_UNORM;

/// Depth and stencil formats, the preferred one first: 24 bits are what OpenGL implementations have.
const DEPTH_FORMATS: [(vk::Format, Format); 2] = [
    (vk::Format::D24_UNORM_S8_UINT, Format::D24UnormS8Uint),
    (vk::Format::D32_SFLOAT_S8_UINT, Format::D32FloatS8Uint),
];

/// How depth and stencil are stored on a device.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DepthFormat {
    pub(crate) vulkan: vk::Format,
    pub(crate) graph: Format,
}

impl DepthFormat {
    /// The first format that the device can draw to; Vulkan promises that it has one of the two.
    pub(crate) fn of(gpu: &Gpu) -> Self {
        let serves =
            |format| gpu.format_features(format).contains(vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT);
        let found = DEPTH_FORMATS.iter().find(|(format, _)| serves(*format));
        let (vulkan, graph) = *found.unwrap_or(&DEPTH_FORMATS[1]);
        Self { vulkan, graph }
    }

    /// The greatest value of depth that is an integer; 0 if it is a float.
    pub(crate) fn maximum(self) -> u32 {
        match self.vulkan {
            vk::Format::D24_UNORM_S8_UINT => 0xff_ffff,
            _ => 0,
        }
    }
}

/// The images of one size, and how the last commands left them.
pub(crate) struct Target {
    pub(crate) size: [u32; 2],
    pub(crate) color: Image,
    pub(crate) depth: Image,
    pub(crate) depth_format: DepthFormat,
    pub(crate) color_state: ResourceState,
    pub(crate) depth_state: ResourceState,
}

impl Target {
    /// Images filled with zeros, and with depth 1.
    pub(crate) fn new(gpu: &Gpu, size: [u32; 2]) -> Result<Self, GpuError> {
        let depth_format = DepthFormat::of(gpu);
        let common = vk::ImageUsageFlags::SAMPLED
            | vk::ImageUsageFlags::TRANSFER_SRC
            | vk::ImageUsageFlags::TRANSFER_DST;
        let color_usage = common | vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::STORAGE;
        let depth_usage = common | vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT;
        let target = Self {
            size,
            color: gpu.create_image(&ImageDesc::d2("color", COLOR_FORMAT, size, color_usage))?,
            depth: gpu.create_image(&ImageDesc::d2("depth", depth_format.vulkan, size, depth_usage))?,
            depth_format,
            color_state: ResourceState::after(Access::TransferDst),
            depth_state: ResourceState::after(Access::TransferDst),
        };
        gpu.submit(|commands| target.fill(commands))?;
        Ok(target)
    }

    /// What the frame graph knows of the colour image.
    pub(crate) fn color_desc(&self) -> GraphImage {
        GraphImage::flat(self.size.into(), Format::Rgba8Unorm)
    }

    /// What the frame graph knows of the depth image.
    pub(crate) fn depth_desc(&self) -> GraphImage {
        GraphImage::flat(self.size.into(), self.depth_format.graph)
    }

    fn fill(&self, commands: &base::Commands<'_>) {
        let (none, write) = (base::Access::NONE, base::Access::TRANSFER_WRITE);
        commands.barriers(
            &[],
            &[image_barrier(&self.color, none, write), image_barrier(&self.depth, none, write)],
        );
        commands.clear_color(&self.color, [0.0; 4]);
        let far = vk::ClearDepthStencilValue { depth: 1.0, stencil: 0 };
        // SAFETY: the image is this device's, in this layout, and may be copied to.
        unsafe {
            commands.device().cmd_clear_depth_stencil_image(
                commands.raw(),
                self.depth.raw(),
                vk::ImageLayout::TRANSFER_DST_OPTIMAL,
                &far,
                &[self.depth.whole_range()],
            );
        }
    }

    /// A target of another size with the same contents, their upper left corner in place; what is new is as in
    /// [`Target::new`].
    pub(crate) fn resized(&mut self, gpu: &Gpu, size: [u32; 2]) -> Result<Self, GpuError> {
        let mut new = Self::new(gpu, size)?;
        new.copy_from(gpu, self)?;
        Ok(new)
    }

    /// Takes over the contents of another target, their upper left corner in place.
    pub(crate) fn copy_from(&mut self, gpu: &Gpu, other: &mut Self) -> Result<(), GpuError> {
        let extent = [0, 1].map(|axis: usize| self.size[axis].min(other.size[axis]));
        let (read, write) = (base::Access::TRANSFER_READ, base::Access::TRANSFER_WRITE);
        let last = |image, state, next| image_barrier(image, crate::graph::last_use(state), next);
        gpu.submit(|commands| {
            commands.barriers(
                &[],
                &[
                    last(&other.color, other.color_state, read),
                    last(&other.depth, other.depth_state, read),
                    last(&self.color, self.color_state, write),
                    last(&self.depth, self.depth_state, write),
                ],
            );
            copy_corner(commands, &other.color, &self.color, extent);
            copy_corner(commands, &other.depth, &self.depth, extent);
        })?;
        for target in [(&mut *other, Access::TransferSrc), (self, Access::TransferDst)] {
            let (target, access) = target;
            target.color_state = ResourceState::after(access);
            target.depth_state = ResourceState::after(access);
        }
        Ok(())
    }
}

fn copy_corner(commands: &base::Commands<'_>, from: &Image, to: &Image, [width, height]: [u32; 2]) {
    let layers = vk::ImageSubresourceLayers {
        aspect_mask: base::aspects(from.format()),
        mip_level: 0,
        base_array_layer: 0,
        layer_count: 1,
    };
    let region = vk::ImageCopy::default()
        .src_subresource(layers)
        .dst_subresource(layers)
        .extent(vk::Extent3D { width, height, depth: 1 });
    // SAFETY: both images are this device's, in these layouts, and as large as the region.
    unsafe {
        commands.device().cmd_copy_image(
            commands.raw(),
            from.raw(),
            vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
            to.raw(),
            vk::ImageLayout::TRANSFER_DST_OPTIMAL,
            &[region],
        );
    }
}
