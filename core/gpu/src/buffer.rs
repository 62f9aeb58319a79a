//! Buffers, reached by shaders through their device addresses.

use std::sync::Arc;

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::Allocation;

use crate::commands::Commands;
use crate::error::{Doing, GpuError};
use crate::gpu::{Gpu, Shared};
use crate::memory::{Heap, MemoryRequest};

/// Where a buffer lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BufferKind {
    /// In the device's own memory; the processor cannot see it.
    Device,
    /// Written by the processor, read by the device.
    Upload,
    /// Written by the device, read by the processor.
    Readback,
}

impl BufferKind {
    fn location(self) -> MemoryLocation {
        match self {
            Self::Device => MemoryLocation::GpuOnly,
            Self::Upload => MemoryLocation::CpuToGpu,
            Self::Readback => MemoryLocation::GpuToCpu,
        }
    }
}

/// A buffer to create. Every buffer may be copied from and to, and used by shaders.
#[derive(Debug, Clone, Copy)]
pub struct BufferDesc<'a> {
    pub name: &'a str,
    /// In bytes, more than 0.
    pub size: u64,
    pub kind: BufferKind,
    /// Uses besides copies and shader storage, such as `INDEX_BUFFER` or `INDIRECT_BUFFER`.
    pub usage: vk::BufferUsageFlags,
}

impl<'a> BufferDesc<'a> {
    pub fn new(name: &'a str, kind: BufferKind, size: u64) -> Self {
        Self { name, size, kind, usage: vk::BufferUsageFlags::empty() }
    }

    pub fn usage(self, usage: vk::BufferUsageFlags) -> Self {
        Self { usage, ..self }
    }

    fn create_info(&self) -> vk::BufferCreateInfo<'static> {
        vk::BufferCreateInfo::default().size(self.size).sharing_mode(vk::SharingMode::EXCLUSIVE).usage(
            self.usage
                | vk::BufferUsageFlags::TRANSFER_SRC
                | vk::BufferUsageFlags::TRANSFER_DST
                | vk::BufferUsageFlags::STORAGE_BUFFER
                | vk::BufferUsageFlags::SHADER_DEVICE_ADDRESS,
        )
    }
}

/// What a resource's memory is.
pub(crate) enum Backing {
    Own(Allocation),
    Heap(Heap),
}

impl Backing {
    pub(crate) fn split(backing: Option<Self>) -> (Option<Allocation>, Option<Heap>) {
        match backing {
            Some(Self::Own(allocation)) => (Some(allocation), None),
            Some(Self::Heap(heap)) => (None, Some(heap)),
            None => (None, None),
        }
    }
}

/// A buffer with its memory. It may be dropped while in use: the device finishes first.
pub struct Buffer {
    shared: Arc<Shared>,
    raw: vk::Buffer,
    size: u64,
    address: vk::DeviceAddress,
    /// `None` only while being dropped.
    backing: Option<Backing>,
}

impl Gpu {
    /// Creates a buffer whose contents are undefined.
    pub fn create_buffer(&self, desc: &BufferDesc<'_>) -> Result<Buffer, GpuError> {
        let raw = self.raw_buffer(desc)?;
        // SAFETY: the buffer was just made.
        let requirements = unsafe { self.shared.device.get_buffer_memory_requirements(raw) };
        let request =
            MemoryRequest { name: desc.name, requirements, location: desc.kind.location(), linear: true };
        let bound = self.shared.memory.allocate(&request).and_then(|allocation| {
            // SAFETY: the memory was allocated for this buffer's requirements.
            let bound = unsafe {
                self.shared.device.bind_buffer_memory(raw, allocation.memory(), allocation.offset())
            };
            match bound.doing("bind a buffer's memory") {
                Ok(()) => Ok(Backing::Own(allocation)),
                Err(error) => {
                    self.shared.memory.free(allocation);
                    Err(error)
                }
            }
        });
        self.finish_buffer(desc, raw, bound)
    }

    /// Creates a device-local buffer in a heap, `offset` bytes from its start. `desc.kind` must be `Device`.
    pub fn place_buffer(&self, desc: &BufferDesc<'_>, heap: &Heap, offset: u64) -> Result<Buffer, GpuError> {
        let raw = self.raw_buffer(desc)?;
        // SAFETY: the buffer was just made.
        let requirements = unsafe { self.shared.device.get_buffer_memory_requirements(raw) };
        let bound = heap
            .place(offset, &requirements)
            .and_then(|(memory, offset)| {
                // SAFETY: the heap has checked that the buffer fits.
                unsafe { self.shared.device.bind_buffer_memory(raw, memory, offset) }
                    .doing("bind a buffer to a heap")
            })
            .map(|()| Backing::Heap(heap.clone()));
        self.finish_buffer(desc, raw, bound)
    }

    /// Bytes, alignment and memory types that a buffer needs in a heap.
    pub fn buffer_requirements(&self, desc: &BufferDesc<'_>) -> Result<vk::MemoryRequirements, GpuError> {
        let raw = self.raw_buffer(desc)?;
        // SAFETY: the buffer was just made, and is not used after.
        unsafe {
            let requirements = self.shared.device.get_buffer_memory_requirements(raw);
            self.shared.device.destroy_buffer(raw, None);
            Ok(requirements)
        }
    }

    /// Creates a device-local buffer and copies `bytes` to it. Waits for the copy.
    pub fn upload_buffer(
        &self,
        name: &str,
        usage: vk::BufferUsageFlags,
        bytes: &[u8],
    ) -> Result<Buffer, GpuError> {
        let size = bytes.len() as u64;
        let mut staging = self.create_buffer(&BufferDesc::new(name, BufferKind::Upload, size))?;
        staging.write(0, bytes)?;
        let desc = BufferDesc::new(name, BufferKind::Device, size).usage(usage);
        let buffer = self.create_buffer(&desc)?;
        self.run(|commands| commands.copy_buffer(&staging, 0, &buffer, 0, size))?;
        Ok(buffer)
    }

    /// Copies a buffer's bytes back. Waits for all that was submitted before.
    pub fn download_buffer(&self, buffer: &Buffer) -> Result<Vec<u8>, GpuError> {
        let size = buffer.size();
        let staging = self.create_buffer(&BufferDesc::new("download", BufferKind::Readback, size))?;
        self.run(|commands| {
            commands.memory_barrier(crate::Access::ALL, crate::Access::TRANSFER_READ);
            commands.copy_buffer(buffer, 0, &staging, 0, size);
            commands.memory_barrier(crate::Access::TRANSFER_WRITE, crate::Access::HOST_READ);
        })?;
        let mut bytes = vec![0; size as usize];
        staging.read(0, &mut bytes)?;
        Ok(bytes)
    }

    fn raw_buffer(&self, desc: &BufferDesc<'_>) -> Result<vk::Buffer, GpuError> {
        if desc.size == 0 {
            return Err(GpuError::Invalid { what: "a buffer has no bytes", detail: desc.name.to_owned() });
        }
        // SAFETY: the description is complete, and the device is alive.
        unsafe { self.shared.device.create_buffer(&desc.create_info(), None) }.doing("create a buffer")
    }

    fn finish_buffer(
        &self,
        desc: &BufferDesc<'_>,
        raw: vk::Buffer,
        bound: Result<Backing, GpuError>,
    ) -> Result<Buffer, GpuError> {
        let device = &self.shared.device;
        let backing = match bound {
            Ok(backing) => backing,
            Err(error) => {
                // SAFETY: nothing uses the buffer yet.
                unsafe { device.destroy_buffer(raw, None) };
                return Err(error);
            }
        };
        self.shared.set_name(raw, desc.name);
        let info = vk::BufferDeviceAddressInfo::default().buffer(raw);
        Ok(Buffer {
            shared: self.shared.clone(),
            raw,
            size: desc.size,
            // SAFETY: the buffer has memory, and was made with the usage for addresses.
            address: unsafe { device.get_buffer_device_address(&info) },
            backing: Some(backing),
        })
    }
}

impl Buffer {
    pub fn raw(&self) -> vk::Buffer {
        self.raw
    }

    /// In bytes, as asked for.
    pub fn size(&self) -> u64 {
        self.size
    }

    /// Where shaders find the first byte.
    pub fn address(&self) -> vk::DeviceAddress {
        self.address
    }

    /// Writes bytes to an [`BufferKind::Upload`] buffer. The device sees them in what is submitted afterwards;
    /// what it still reads must not be written.
    pub fn write(&mut self, offset: u64, bytes: &[u8]) -> Result<(), GpuError> {
        let target = self.mapped(offset, bytes.len())?;
        // SAFETY: `mapped` checked the range, and the buffer is borrowed exclusively.
        unsafe { std::ptr::copy_nonoverlapping(bytes.as_ptr(), target, bytes.len()) };
        Ok(())
    }

    /// Reads bytes from a [`BufferKind::Readback`] (or `Upload`) buffer, after the device has finished writing.
    pub fn read(&self, offset: u64, bytes: &mut [u8]) -> Result<(), GpuError> {
        let source = self.mapped(offset, bytes.len())?;
        // SAFETY: `mapped` checked the range; the caller's bytes cannot overlap device memory.
        unsafe { std::ptr::copy_nonoverlapping(source, bytes.as_mut_ptr(), bytes.len()) };
        Ok(())
    }

    /// A pointer to `length` bytes of mapped memory at `offset`.
    fn mapped(&self, offset: u64, length: usize) -> Result<*mut u8, GpuError> {
        let end = offset.checked_add(length as u64);
        if end.is_none_or(|end| end > self.size) {
            return Err(GpuError::Invalid {
                what: "a range lies outside its buffer",
                detail: format!("{length} bytes at {offset} of {}", self.size),
            });
        }
        match &self.backing {
            Some(Backing::Own(allocation)) => allocation.mapped_ptr(),
            _ => None,
        }
        // SAFETY: the offset lies inside the allocation.
        .map(|start| unsafe { start.as_ptr().cast::<u8>().add(offset as usize) })
        .ok_or(GpuError::Invalid {
            what: "a buffer is not visible to the processor",
            detail: format!("{} bytes", self.size),
        })
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        let raw = self.raw;
        let (allocation, _heap) = Backing::split(self.backing.take());
        self.shared.retire(move |shared: &Shared| {
            // SAFETY: the device has finished with it, and its handle goes with it.
            unsafe { shared.device.destroy_buffer(raw, None) };
            if let Some(allocation) = allocation {
                shared.memory.free(allocation);
            }
        });
        // A heap is given up only now: its memory is to be freed after the buffer is destroyed.
    }
}

impl Commands<'_> {
    /// Copies `size` bytes between buffers.
    pub fn copy_buffer(&self, from: &Buffer, from_offset: u64, to: &Buffer, to_offset: u64, size: u64) {
        let regions = [vk::BufferCopy { src_offset: from_offset, dst_offset: to_offset, size }];
        // SAFETY: the buffers are this device's; the validation layer checks ranges.
        unsafe {
            self.device().cmd_copy_buffer(self.raw(), from.raw, to.raw, &regions);
        }
    }

    /// Fills a whole buffer, whose size is a multiple of 4, with a repeated word.
    pub fn fill_buffer(&self, buffer: &Buffer, word: u32) {
        // SAFETY: the buffer is this device's.
        unsafe {
            self.device().cmd_fill_buffer(self.raw(), buffer.raw, 0, vk::WHOLE_SIZE, word);
        }
    }
}
