//! Device memory: suballocated for single resources, or in heaps that resources are placed in by hand.

use std::sync::Arc;

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{
    Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc,
};
use parking_lot::Mutex;

use crate::device::DeviceKind;
use crate::error::GpuError;
use crate::gpu::{Gpu, Shared};

/// The allocator of one device.
pub(crate) struct Memory {
    /// `None` only once the device is being destroyed.
    allocator: Mutex<Option<Allocator>>,
    /// Bytes that resources may have together, where a shortage is made up.
    most: Option<u64>,
}

/// A piece of memory to ask for.
pub(crate) struct MemoryRequest<'a> {
    pub(crate) name: &'a str,
    pub(crate) requirements: vk::MemoryRequirements,
    pub(crate) location: MemoryLocation,
    /// Buffers are linear, optimal images are not: the two may not share a page everywhere.
    pub(crate) linear: bool,
}

impl Memory {
    pub(crate) fn new(
        instance: &ash::Instance,
        device: &ash::Device,
        physical: vk::PhysicalDevice,
        most: Option<u64>,
    ) -> Result<Self, GpuError> {
        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: instance.clone(),
            device: device.clone(),
            physical_device: physical,
            debug_settings: Default::default(),
            buffer_device_address: true,
            allocation_sizes: Default::default(),
        })
        .map_err(|source| GpuError::Memory {
            name: "the allocator".to_owned(),
            bytes: 0,
            source,
        })?;
        Ok(Self { allocator: Mutex::new(Some(allocator)), most })
    }

    pub(crate) fn allocate(&self, request: &MemoryRequest<'_>) -> Result<Allocation, GpuError> {
        let description = AllocationCreateDesc {
            name: request.name,
            requirements: request.requirements,
            location: request.location,
            linear: request.linear,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        };
        self.allocator
            .lock()
            .as_mut()
            .filter(|allocator| self.has_room(allocator, request.requirements.size))
            .map_or(Err(gpu_allocator::AllocationError::OutOfMemory), |allocator| {
                allocator.allocate(&description)
            })
            .map_err(|source| GpuError::Memory {
                name: request.name.to_owned(),
                bytes: request.requirements.size,
                source,
            })
    }

    /// Whether so many more bytes are allowed.
    fn has_room(&self, allocator: &Allocator, bytes: u64) -> bool {
        self.most.is_none_or(|most| allocator.generate_report().total_allocated_bytes + bytes <= most)
    }

    pub(crate) fn free(&self, allocation: Allocation) {
        if let Some(allocator) = self.allocator.lock().as_mut()
            && let Err(error) = allocator.free(allocation)
        {
            tracing::error!("could not free device memory: {error}");
        }
    }

    /// Bytes in use by resources, and bytes taken from the driver.
    fn totals(&self) -> MemoryUse {
        self.allocator.lock().as_ref().map(Allocator::generate_report).map_or_else(
            MemoryUse::default,
            |report| MemoryUse { used: report.total_allocated_bytes, reserved: report.total_capacity_bytes },
        )
    }

    /// # Safety
    /// No resource may use the memory any more.
    pub(crate) unsafe fn destroy(&self) {
        // The allocator gives its blocks back to the driver when it is dropped.
        drop(self.allocator.lock().take());
    }
}

/// Bytes of device memory, including what is visible to the processor.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct MemoryUse {
    /// In resources.
    pub used: u64,
    /// Taken from the driver.
    pub reserved: u64,
}

impl Gpu {
    pub fn memory_use(&self) -> MemoryUse {
        self.shared.memory.totals()
    }

    /// Whether the device has the same memory as the processor, so that what the processor writes for it is as near as any
    /// other. A graphics card is told apart even where the processor sees all of its memory: such a window may be
    /// full, and then writes end up in the processor's memory.
    pub fn has_unified_memory(&self) -> bool {
        let is_shared = matches!(self.info().kind, DeviceKind::Integrated | DeviceKind::Cpu);
        let both = vk::MemoryPropertyFlags::DEVICE_LOCAL | vk::MemoryPropertyFlags::HOST_VISIBLE;
        // SAFETY: a plain query on a device that is alive.
        let memory = unsafe { self.instance().get_physical_device_memory_properties(self.physical_device()) };
        is_shared && memory.memory_types_as_slice().iter().any(|kind| kind.property_flags.contains(both))
    }

    /// Device-local memory to place resources in. `memory_type_bits` is the intersection of what they allow.
    pub fn allocate_heap(
        &self,
        name: &str,
        bytes: u64,
        alignment: u64,
        memory_type_bits: u32,
    ) -> Result<Heap, GpuError> {
        let allocation = self.shared.memory.allocate(&MemoryRequest {
            name,
            requirements: vk::MemoryRequirements { size: bytes, alignment, memory_type_bits },
            location: MemoryLocation::GpuOnly,
            // Buffers and images may both be placed in it, at offsets that the caller keeps far enough apart.
            linear: false,
        })?;
        Ok(Heap {
            inner: Arc::new(HeapInner { shared: self.shared.clone(), bytes, allocation: Some(allocation) }),
        })
    }
}

/// Device memory that several resources share. It lives as long as the last of them.
#[derive(Clone)]
pub struct Heap {
    inner: Arc<HeapInner>,
}

struct HeapInner {
    shared: Arc<Shared>,
    bytes: u64,
    /// `None` only while being dropped.
    allocation: Option<Allocation>,
}

impl Heap {
    pub fn bytes(&self) -> u64 {
        self.inner.bytes
    }

    /// The memory and offset at which a resource at `offset` bytes of the heap is to be bound.
    pub(crate) fn place(
        &self,
        offset: u64,
        requirements: &vk::MemoryRequirements,
    ) -> Result<(vk::DeviceMemory, u64), GpuError> {
        let end = offset.checked_add(requirements.size);
        if end.is_none_or(|end| end > self.inner.bytes)
            || !offset.is_multiple_of(requirements.alignment.max(1))
        {
            return Err(GpuError::Invalid {
                what: "a resource does not fit its heap",
                detail: format!(
                    "{} bytes, aligned to {}, at {offset} of {}",
                    requirements.size, requirements.alignment, self.inner.bytes
                ),
            });
        }
        let allocation = self
            .inner
            .allocation
            .as_ref()
            .ok_or(GpuError::Invalid { what: "a heap is gone", detail: String::new() })?;
        // SAFETY: the memory is only bound, and the resource keeps the heap alive.
        Ok(unsafe { (allocation.memory(), allocation.offset() + offset) })
    }
}

impl Drop for HeapInner {
    fn drop(&mut self) {
        if let Some(allocation) = self.allocation.take() {
            self.shared.retire(move |shared: &Shared| shared.memory.free(allocation));
        }
    }
}
