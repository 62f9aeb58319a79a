//! What the passes of a view write, as large as the window, and how the last frame left it.

use afterglow_frame_graph::{Format, ImageDesc as GraphImage, ResourceState};
use afterglow_gpu::{
    BindlessKind, BindlessTable, Buffer, BufferDesc, BufferKind, Gpu, GpuError, Image, ImageDesc, vk,
};
use afterglow_layout::SharedStruct;
use afterglow_records::{
    Exposure, ExposureSum, LightTexel, MoverSum, RadianceTexel, ReservoirTexel, SurfaceTexel, TraceCounters,
};

use super::denoise::{Plan, Store, Stores};
use crate::target::{COLOR_FORMAT, Target};

/// Numbers of draw and triangle of each pixel.
pub(crate) const VISIBILITY_FORMAT: vk::Format = vk::Format::R32G32_UINT;
/// Of a pixel between composition and the smoothing of edges: four half floats.
const COMPOSED_BYTES: u64 = 8;
/// Visibility and albedo, as the frame graph has them.
pub(crate) const VIEW_FORMATS: [Format; 2] = [Format::Rg32Uint, Format::Rgba8Unorm];
/// Pixels along a side of a workgroup that sums for exposure.
const SUM_EDGE: u32 = 16;

/// A buffer and how the last frame left it.
pub(crate) struct Tracked {
    pub(crate) buffer: Buffer,
    pub(crate) state: ResourceState,
}

/// An image and how the last frame left it.
pub(crate) struct TrackedImage {
    pub(crate) image: Image,
    pub(crate) state: ResourceState,
}

/// Everything of one window size.
pub(crate) struct ViewBuffers {
    pub(crate) size: [u32; 2],
    /// Of visibility and albedo, and of the window's own images.
    image_bytes: u64,
    pub(crate) visibility: TrackedImage,
    /// Colours without light.
    pub(crate) albedo: TrackedImage,
    /// Bindless index of the albedo as a drawn image.
    pub(crate) albedo_index: u32,
    /// Bindless index of the visibility as a drawn image.
    pub(crate) visibility_index: u32,
    /// The colour image that [`ViewBuffers::color_index`] names.
    color: vk::Image,
    /// Bindless index of the window's colour as a storage image.
    pub(crate) color_index: u32,
    pub(crate) surfaces: Tracked,
    /// Those of the frame before, which swaps places with the one above; none before lights were first kept.
    pub(crate) surfaces_before: Option<Tracked>,
    /// Of this frame and of the one before, which one is which by the frame's number. Likewise.
    pub(crate) reservoirs: Option<[Tracked; 2]>,
    /// Of each view of a frame that no denoiser sees.
    pub(crate) light: Vec<Tracked>,
    /// Of each view of a frame that one does.
    pub(crate) stores: Vec<Stores>,
    /// What is shown before edges are smoothed, once they are.
    pub(crate) composed: Option<Tracked>,
    pub(crate) sums: Tracked,
    pub(crate) exposure: Tracked,
    /// Sums of moving draws among baked surfaces.
    pub(crate) movers: Tracked,
    pub(crate) counters: Tracked,
    /// Linear pictures, once one was asked for.
    pub(crate) radiance: Option<Tracked>,
}

impl ViewBuffers {
    pub(crate) fn new(gpu: &Gpu, table: &BindlessTable, target: &Target) -> Result<Self, GpuError> {
        let size = target.size;
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
        let image = |name, format| gpu.create_image(&ImageDesc::d2(name, format, size, usage));
        let visibility = image("visibility", VISIBILITY_FORMAT)?;
        let albedo = image("albedo", COLOR_FORMAT)?;
        let pixels = pixels(size);
        let buffer = |name, bytes| Tracked::new(gpu, name, bytes);
        Ok(Self {
            size,
            image_bytes: image_bytes(target),
            visibility_index: drawn_index(table, &visibility)?,
            albedo_index: drawn_index(table, &albedo)?,
            albedo: TrackedImage { image: albedo, state: ResourceState::UNDEFINED },
            visibility: TrackedImage { image: visibility, state: ResourceState::UNDEFINED },
            color: target.color.raw(),
            color_index: storage_index(table, &target.color)?,
            surfaces: buffer("surfaces", pixels * stride::<SurfaceTexel>())?,
            surfaces_before: None,
            reservoirs: None,
            light: Vec::new(),
            stores: Vec::new(),
            composed: None,
            sums: buffer("exposure sums", u64::from(sum_count(size)) * stride::<ExposureSum>())?,
            exposure: buffer("exposure", stride::<Exposure>())?,
            movers: buffer("mover sums", stride::<MoverSum>())?,
            counters: buffer("trace counters", stride::<TraceCounters>())?,
            radiance: None,
        })
    }

    /// Whether these are for the target as it is now.
    pub(crate) fn fits(&self, target: &Target) -> bool {
        self.size == target.size && self.color == target.color.raw()
    }

    /// Makes sure that there is room for the light of so many views, as a denoiser's plan needs it. Says whether what earlier frames
    /// have left is still there.
    pub(crate) fn reserve_views(
        &mut self,
        gpu: &Gpu,
        views: usize,
        plan: &Plan,
        light_size: [u32; 2],
    ) -> Result<bool, GpuError> {
        let mut is_left = true;
        if plan.output.is_none() {
            self.stores.clear();
            let bytes = pixels(light_size) * stride::<LightTexel>();
            if self.light.first().is_some_and(|light| light.buffer.size() != bytes) {
                self.light.clear();
                is_left = false;
            }
            while self.light.len() < views {
                self.light.push(Tracked::new(gpu, "light", bytes)?);
            }
            return Ok(is_left);
        }
        self.light.clear();
        if !self.stores.iter().all(|stores| stores.serve(plan, light_size)) {
            self.stores.clear();
            is_left = false;
        }
        while self.stores.len() < views {
            self.stores.push(Stores::new(gpu, plan, light_size)?);
        }
        Ok(is_left)
    }

    /// Makes sure that edges can be smoothed, in a store that is `spare` by then if it has room for that.
    pub(crate) fn reserve_composed(&mut self, gpu: &Gpu, spare: Option<Store>) -> Result<(), GpuError> {
        let has_room = |stores: &Stores| {
            spare.is_some_and(|store| stores.bytes_of(store) >= pixels(self.size) * COMPOSED_BYTES)
        };
        if self.stores.first().is_some_and(has_room) {
            self.composed = None;
        } else if self.composed.is_none() {
            self.composed = Some(Tracked::new(gpu, "composed", pixels(self.size) * COMPOSED_BYTES)?);
        }
        Ok(())
    }

    /// Makes sure that there is a linear picture.
    pub(crate) fn reserve_radiance(&mut self, gpu: &Gpu) -> Result<(), GpuError> {
        if self.radiance.is_none() {
            let bytes = pixels(self.size) * stride::<RadianceTexel>();
            self.radiance = Some(Tracked::new(gpu, "radiance", bytes)?);
        }
        Ok(())
    }

    /// Makes sure that lights can be kept.
    pub(crate) fn reserve_reservoirs(&mut self, gpu: &Gpu) -> Result<(), GpuError> {
        if self.reservoirs.is_none() {
            let bytes = pixels(self.size) * stride::<ReservoirTexel>();
            let buffer = || Tracked::new(gpu, "reservoirs", bytes);
            let surfaces = pixels(self.size) * stride::<SurfaceTexel>();
            self.surfaces_before = Some(Tracked::new(gpu, "surfaces before", surfaces)?);
            self.reservoirs = Some([buffer()?, buffer()?]);
        }
        Ok(())
    }

    /// What this frame has shown is the frame's before from now on, where lights are kept.
    pub(crate) fn swap_surfaces(&mut self) {
        if let Some(before) = &mut self.surfaces_before {
            std::mem::swap(before, &mut self.surfaces);
        }
    }

    /// Bytes of everything that is as large as the window, the window's own images included.
    pub(crate) fn bytes(&self) -> u64 {
        let of = |tracked: &Tracked| tracked.buffer.size();
        let optional = [&self.surfaces_before, &self.composed, &self.radiance];
        let reservoirs = self.reservoirs.iter().flatten();
        of(&self.surfaces)
            + optional.into_iter().flatten().chain(reservoirs).chain(&self.light).map(of).sum::<u64>()
            + self.stores.iter().map(Stores::bytes).sum::<u64>()
            + self.image_bytes
    }

    /// Makes sure that there are sums of so many draws.
    pub(crate) fn reserve_movers(&mut self, gpu: &Gpu, draws: usize) -> Result<(), GpuError> {
        let bytes = (draws as u64 * stride::<MoverSum>()).next_power_of_two();
        if bytes > self.movers.buffer.size() {
            self.movers = Tracked::new(gpu, "mover sums", bytes)?;
        }
        Ok(())
    }

    /// Gives the places in the table back.
    pub(crate) fn release(self, table: &BindlessTable) {
        table.remove(BindlessKind::DrawnImage, self.visibility_index);
        table.remove(BindlessKind::DrawnImage, self.albedo_index);
        table.remove(BindlessKind::StorageImage, self.color_index);
    }
}

impl Tracked {
    pub(crate) fn new(gpu: &Gpu, name: &str, bytes: u64) -> Result<Self, GpuError> {
        Ok(Self {
            buffer: gpu.create_buffer(&BufferDesc::new(name, BufferKind::Device, bytes))?,
            state: ResourceState::UNDEFINED,
        })
    }
}

/// Workgroups that sum for exposure, along both sides.
pub(crate) fn sum_groups(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.div_ceil(SUM_EDGE))
}

/// Workgroups that sum for exposure.
pub(crate) fn sum_count(size: [u32; 2]) -> u32 {
    let [across, down] = sum_groups(size);
    across * down
}

/// Bytes of all images of a window.
fn image_bytes(target: &Target) -> u64 {
    let own = VIEW_FORMATS.map(|format| GraphImage::flat(target.size.into(), format));
    let images = own.into_iter().chain([target.color_desc(), target.depth_desc()]);
    images.filter_map(|image| image.bytes()).sum()
}

fn pixels([width, height]: [u32; 2]) -> u64 {
    u64::from(width) * u64::from(height)
}

fn stride<T: SharedStruct>() -> u64 {
    size_of::<T>() as u64
}

fn drawn_index(table: &BindlessTable, image: &Image) -> Result<u32, GpuError> {
    table.add_image(BindlessKind::DrawnImage, image.view(), vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)
}

fn storage_index(table: &BindlessTable, image: &Image) -> Result<u32, GpuError> {
    table.add_image(BindlessKind::StorageImage, image.view(), vk::ImageLayout::GENERAL)
}
