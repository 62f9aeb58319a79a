//! Pictures in windows.

use std::ffi::c_void;
use std::sync::Arc;
use std::time::Duration;

use ash::vk;

use crate::barriers::{Access, image_barrier_of};
use crate::commands::Submission;
use crate::error::{Doing, GpuError};
use crate::gpu::{Gpu, Shared};
use crate::image::Image;
use crate::overlay::Overlay;

/// Pictures of a swapchain that are asked for: one on the screen, one waiting, one being made.
const WANTED_IMAGES: u32 = 3;
/// How long one of them is waited for. Longer than a slow device takes for a frame.
const PATIENCE: Duration = Duration::from_secs(1);
/// How long once that was in vain: nobody looks at the window, and the program should not stand still.
const IMPATIENCE: Duration = Duration::from_millis(50);

/// A window that pictures can be shown in.
pub struct WindowSurface {
    shared: Arc<Shared>,
    raw: vk::SurfaceKHR,
}

/// A window's pictures, of one size.
pub struct Swapchain {
    surface: WindowSurface,
    functions: ash::khr::swapchain::Device,
    raw: vk::SwapchainKHR,
    images: Vec<vk::Image>,
    extent: vk::Extent2D,
    waits_for_blank: bool,
    /// Signalled when a picture may be written to; used in turn.
    acquired: Vec<vk::Semaphore>,
    /// Signalled when a picture was written, by picture.
    written: Vec<vk::Semaphore>,
    turn: usize,
    /// The last picture was waited for in vain.
    is_stuck: bool,
}

/// What became of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Presented {
    /// It is shown, or will be.
    Shown,
    /// The window has no area now (it is minimised), or the window system keeps all its pictures: there is nothing to
    /// show it in.
    Hidden,
}

/// The next picture to write to.
enum Acquired {
    /// The one of this number.
    Picture(u32),
    /// The window is no longer what it was.
    Outdated,
    /// None came in time.
    None,
}

impl Gpu {
    /// A surface of a window of an X server. An error if the device, or its driver, knows no windows.
    ///
    /// # Safety
    /// `connection` must be an `xcb_connection_t` that outlives the surface, and no other thread may use it.
    pub unsafe fn xcb_surface(
        &self,
        connection: *mut c_void,
        window: u32,
    ) -> Result<WindowSurface, GpuError> {
        let knows_windows = self.shared.instance.knows_xcb()
            && self.shared.candidate.extensions.has(ash::khr::swapchain::NAME)
            && !self.shared.health.faults.no_windows;
        if !knows_windows {
            let detail = "it cannot show pictures in windows".to_owned();
            return Err(GpuError::Invalid { what: "device", detail });
        }
        let functions = ash::khr::xcb_surface::Instance::new(self.entry(), self.instance());
        let info = vk::XcbSurfaceCreateInfoKHR::default().connection(connection.cast()).window(window);
        // SAFETY: the connection is alive, as the caller promises.
        let raw = unsafe { functions.create_xcb_surface(&info, None) }.doing("create a window's surface")?;
        self.surface(raw)
    }

    fn surface(&self, raw: vk::SurfaceKHR) -> Result<WindowSurface, GpuError> {
        let surface = WindowSurface { shared: self.shared.clone(), raw };
        // SAFETY: the surface is alive and of this instance.
        let serves = unsafe {
            self.surface_functions().get_physical_device_surface_support(
                self.physical_device(),
                self.queue_family(),
                raw,
            )
        }
        .doing("ask whether a window can be shown in")?;
        match serves {
            true => Ok(surface),
            false => Err(GpuError::Invalid {
                what: "window",
                detail: "the device cannot show pictures in it".to_owned(),
            }),
        }
    }

    fn surface_functions(&self) -> ash::khr::surface::Instance {
        ash::khr::surface::Instance::new(self.entry(), self.instance())
    }

    /// Pictures for a window. They are waited for by the screen's blanks if `waits_for_blank`.
    pub fn swapchain(&self, surface: WindowSurface, waits_for_blank: bool) -> Result<Swapchain, GpuError> {
        let functions = ash::khr::swapchain::Device::new(self.instance(), self.device());
        let mut swapchain = Swapchain {
            surface,
            functions,
            raw: vk::SwapchainKHR::null(),
            images: Vec::new(),
            extent: vk::Extent2D::default(),
            waits_for_blank,
            acquired: Vec::new(),
            written: Vec::new(),
            turn: 0,
            is_stuck: false,
        };
        swapchain.make(self)?;
        Ok(swapchain)
    }

    fn semaphores(&self, count: usize) -> Result<Vec<vk::Semaphore>, GpuError> {
        let info = vk::SemaphoreCreateInfo::default();
        // SAFETY: the device is alive.
        let make = |_| unsafe { self.device().create_semaphore(&info, None) };
        (0..count).map(make).collect::<Result<_, _>>().doing("create a semaphore")
    }
}

impl Drop for WindowSurface {
    fn drop(&mut self) {
        let functions =
            ash::khr::surface::Instance::new(&self.shared.instance.loader.entry, &self.shared.instance.raw);
        // SAFETY: its swapchain is gone.
        unsafe { functions.destroy_surface(self.raw, None) };
    }
}

impl Swapchain {
    /// Width and height in pixels; 0 while the window has no area.
    pub fn size(&self) -> [u32; 2] {
        [self.extent.width, self.extent.height]
    }

    /// Whether pictures wait for the screen's blanks.
    pub fn waits_for_blank(&self) -> bool {
        self.waits_for_blank
    }

    /// Shows an image in the window: its upper left corner in the window's, without scaling, and `overlay` over it.
    /// `state` says how the last commands left the image, and then how it is left: as it was, or to be read by
    /// transfers.
    pub fn present(
        &mut self,
        gpu: &Gpu,
        image: &Image,
        state: &mut Access,
        overlay: Option<&Overlay>,
    ) -> Result<Presented, GpuError> {
        // A window that changes while it is drawn to may fail a few times in a row.
        for _ in 0..4 {
            if self.raw == vk::SwapchainKHR::null() {
                self.make(gpu)?;
                if self.raw == vk::SwapchainKHR::null() {
                    return Ok(Presented::Hidden);
                }
            }
            let index = match gpu.shared.health.guard(|| self.acquire())? {
                Acquired::Picture(index) => index,
                Acquired::Outdated => {
                    self.unmake(gpu)?;
                    continue;
                }
                Acquired::None => return Ok(Presented::Hidden),
            };
            self.copy(gpu, index, image, *state, overlay)?;
            *state = Access::TRANSFER_READ;
            if !gpu.shared.health.guard(|| self.show(gpu, index))? {
                self.unmake(gpu)?;
            }
            return Ok(Presented::Shown);
        }
        Ok(Presented::Hidden)
    }

    fn acquire(&mut self) -> Result<Acquired, GpuError> {
        self.turn = (self.turn + 1) % self.acquired.len();
        let semaphore = self.acquired[self.turn];
        let patience = if self.is_stuck { IMPATIENCE } else { PATIENCE }.as_nanos() as u64;
        // SAFETY: the swapchain is alive, and its last use of the semaphore has been waited for by a submission.
        let result =
            unsafe { self.functions.acquire_next_image(self.raw, patience, semaphore, vk::Fence::null()) };
        self.is_stuck = matches!(result, Err(vk::Result::TIMEOUT | vk::Result::NOT_READY));
        match result {
            Ok((index, _)) => Ok(Acquired::Picture(index)),
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => Ok(Acquired::Outdated),
            Err(vk::Result::TIMEOUT | vk::Result::NOT_READY) => Ok(Acquired::None),
            Err(error) => Err(error).doing("get a picture of a window"),
        }
    }

    fn copy(
        &self,
        gpu: &Gpu,
        index: u32,
        image: &Image,
        before: Access,
        overlay: Option<&Overlay>,
    ) -> Result<Submission, GpuError> {
        let target = self.images[index as usize];
        let range = image.whole_range();
        let [width, height, _] = image.extent();
        let size = [width.min(self.extent.width) as i32, height.min(self.extent.height) as i32];
        let corners = [vk::Offset3D::default(), vk::Offset3D { x: size[0], y: size[1], z: 1 }];
        let layers = vk::ImageSubresourceLayers {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            mip_level: 0,
            base_array_layer: 0,
            layer_count: 1,
        };
        let region = vk::ImageBlit::default()
            .src_subresource(layers)
            .dst_subresource(layers)
            .src_offsets(corners)
            .dst_offsets(corners);
        let (read, write) = (Access::TRANSFER_READ, Access::TRANSFER_WRITE);
        // What comes before in the chain is the semaphore's wait, at the same stage.
        let fresh = Access { layout: vk::ImageLayout::UNDEFINED, accesses: vk::AccessFlags2::NONE, ..write };
        let recording = gpu.record()?;
        let barriers = [
            image_barrier_of(image.raw(), range, before, read),
            image_barrier_of(target, range, fresh, write),
        ];
        recording.barriers(&[], &barriers);
        // SAFETY: both images are in these layouts, and as large as the regions.
        unsafe {
            recording.device().cmd_blit_image(
                recording.raw(),
                image.raw(),
                read.layout,
                target,
                write.layout,
                &[region],
                vk::Filter::NEAREST,
            );
        }
        if let Some(overlay) = overlay {
            recording.barriers(&[], &[image_barrier_of(target, range, write, write)]);
            overlay.record(&recording, target, self.size());
        }
        recording.barriers(&[], &[image_barrier_of(target, range, write, Access::PRESENT)]);
        let semaphore = |semaphore| {
            vk::SemaphoreSubmitInfo::default()
                .semaphore(semaphore)
                .stage_mask(vk::PipelineStageFlags2::ALL_TRANSFER)
        };
        let written = vk::SemaphoreSubmitInfo::default()
            .semaphore(self.written[index as usize])
            .stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS);
        recording.submit_with(&[semaphore(self.acquired[self.turn])], &[written])
    }

    /// Whether the window still is what it was.
    fn show(&self, gpu: &Gpu, index: u32) -> Result<bool, GpuError> {
        let (semaphores, swapchains, indices) = ([self.written[index as usize]], [self.raw], [index]);
        let info = vk::PresentInfoKHR::default()
            .wait_semaphores(&semaphores)
            .swapchains(&swapchains)
            .image_indices(&indices);
        // SAFETY: the picture was acquired and written; nobody else uses the queue.
        match gpu.with_queue(|queue| unsafe { self.functions.queue_present(queue, &info) }) {
            Ok(is_suboptimal) => Ok(!is_suboptimal),
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => Ok(false),
            Err(error) => Err(error).doing("show a picture in a window"),
        }
    }

    /// Makes pictures of the window's size; none if it has no area.
    fn make(&mut self, gpu: &Gpu) -> Result<(), GpuError> {
        let surfaces = gpu.surface_functions();
        let (physical, surface) = (gpu.physical_device(), self.surface.raw);
        // SAFETY: the surface is alive, here and below.
        let (capabilities, formats, modes) = unsafe {
            (
                surfaces.get_physical_device_surface_capabilities(physical, surface),
                surfaces.get_physical_device_surface_formats(physical, surface),
                surfaces.get_physical_device_surface_present_modes(physical, surface),
            )
        };
        let capabilities = capabilities.doing("ask a window's size")?;
        let formats = formats.doing("ask a window's formats")?;
        let modes = modes.doing("ask how a window is shown")?;
        self.extent = capabilities.current_extent;
        if self.extent.width == 0 || self.extent.height == 0 || self.extent.width == u32::MAX {
            self.extent = vk::Extent2D::default();
            return Ok(());
        }
        let format = chosen_format(&formats).ok_or_else(|| GpuError::Invalid {
            what: "window",
            detail: "it has no format with 8 bits a component".to_owned(),
        })?;
        let most = if capabilities.max_image_count == 0 { u32::MAX } else { capabilities.max_image_count };
        let info = vk::SwapchainCreateInfoKHR::default()
            .surface(surface)
            .min_image_count(WANTED_IMAGES.max(capabilities.min_image_count).min(most))
            .image_format(format.format)
            .image_color_space(format.color_space)
            .image_extent(self.extent)
            .image_array_layers(1)
            .image_usage(vk::ImageUsageFlags::TRANSFER_DST)
            .image_sharing_mode(vk::SharingMode::EXCLUSIVE)
            .pre_transform(capabilities.current_transform)
            .composite_alpha(chosen_alpha(capabilities.supported_composite_alpha))
            .present_mode(chosen_mode(&modes, self.waits_for_blank))
            .clipped(true);
        // SAFETY: everything in it is what the surface allows; the old swapchain is gone.
        self.raw =
            unsafe { self.functions.create_swapchain(&info, None) }.doing("create pictures for a window")?;
        // SAFETY: the swapchain is alive.
        self.images =
            unsafe { self.functions.get_swapchain_images(self.raw) }.doing("get a window's pictures")?;
        self.written = gpu.semaphores(self.images.len())?;
        self.acquired = gpu.semaphores(self.images.len() + 1)?;
        Ok(())
    }

    /// Destroys the pictures, once the device has finished with them.
    fn unmake(&mut self, gpu: &Gpu) -> Result<(), GpuError> {
        gpu.wait_idle()?;
        self.destroy();
        Ok(())
    }

    fn destroy(&mut self) {
        let device = &self.surface.shared.device;
        let _queue = self.surface.shared.queue.lock();
        // SAFETY: the device has finished with them; what the queue still shows, it has waited for.
        unsafe {
            let _ = device.device_wait_idle();
            for semaphore in self.acquired.drain(..).chain(self.written.drain(..)) {
                device.destroy_semaphore(semaphore, None);
            }
            if self.raw != vk::SwapchainKHR::null() {
                self.functions.destroy_swapchain(self.raw, None);
            }
        }
        self.raw = vk::SwapchainKHR::null();
        self.images.clear();
    }
}

impl Drop for Swapchain {
    fn drop(&mut self) {
        self.destroy();
    }
}

/// 8 bits a component, as they are: OpenGL's colours are shown without conversion.
fn chosen_format(formats: &[vk::SurfaceFormatKHR]) -> Option<vk::SurfaceFormatKHR> {
    let wanted = [vk::Format::B8G8R8A8_UNORM, vk::Format::R8G8B8A8_UNORM];
    wanted.into_iter().find_map(|format| formats.iter().find(|found| found.format == format)).copied()
}

fn chosen_alpha(supported: vk::CompositeAlphaFlagsKHR) -> vk::CompositeAlphaFlagsKHR {
    use vk::CompositeAlphaFlagsKHR as Alpha;
    let wanted = [Alpha::OPAQUE, Alpha::INHERIT, Alpha::POST_MULTIPLIED, Alpha::PRE_MULTIPLIED];
    wanted.into_iter().find(|alpha| supported.contains(*alpha)).unwrap_or(Alpha::OPAQUE)
}

fn chosen_mode(modes: &[vk::PresentModeKHR], waits_for_blank: bool) -> vk::PresentModeKHR {
    use vk::PresentModeKHR as Mode;
    let wanted: &[Mode] = if waits_for_blank { &[] } else { &[Mode::IMMEDIATE, Mode::MAILBOX] };
    wanted.iter().copied().find(|mode| modes.contains(mode)).unwrap_or(Mode::FIFO)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_not_converted() {
        let format = |format| vk::SurfaceFormatKHR { format, ..Default::default() };
        let formats = [format(vk::Format::B8G8R8A8_SRGB), format(vk::Format::R8G8B8A8_UNORM)];
        assert_eq!(chosen_format(&formats).unwrap().format, vk::Format::R8G8B8A8_UNORM);
        assert_eq!(chosen_format(&formats[..1]), None);
    }

    #[test]
    fn only_without_blanks_pictures_may_tear() {
        use vk::PresentModeKHR as Mode;
        let all = [Mode::FIFO, Mode::MAILBOX, Mode::IMMEDIATE];
        assert_eq!(chosen_mode(&all, true), Mode::FIFO);
        assert_eq!(chosen_mode(&all, false), Mode::IMMEDIATE);
        assert_eq!(chosen_mode(&all[..1], false), Mode::FIFO);
    }
}
