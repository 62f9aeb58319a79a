//! How small built structures can be made.

use std::sync::Arc;

use ash::vk;

use crate::acceleration::AccelerationStructure;
use crate::commands::Commands;
use crate::error::{Doing, GpuError};
use crate::gpu::{Gpu, Shared};

/// Asks for the compacted sizes of some structures, once. It may be dropped while in use.
pub struct CompactedSizes {
    shared: Arc<Shared>,
    pool: vk::QueryPool,
    count: u32,
}

impl Gpu {
    /// Room for the sizes of so many structures, more than 0.
    pub fn create_compacted_sizes(&self, count: u32) -> Result<CompactedSizes, GpuError> {
        self.shared.ray_tracing()?;
        let info = vk::QueryPoolCreateInfo::default()
            .query_type(vk::QueryType::ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR)
            .query_count(count.max(1));
        // SAFETY: the device has acceleration structures.
        let pool = unsafe { self.device().create_query_pool(&info, None) }.doing("create a query pool")?;
        // SAFETY: the pool was just made; the device has hostQueryReset.
        unsafe { self.device().reset_query_pool(pool, 0, count.max(1)) };
        Ok(CompactedSizes { shared: self.shared.clone(), pool, count })
    }
}

impl CompactedSizes {
    /// Bytes of each structure, in order. The recording that asked must have been waited for; none if the device has not
    /// answered.
    pub fn get(&self) -> Result<Option<Vec<u64>>, GpuError> {
        let mut sizes = vec![0_u64; self.count as usize];
        if sizes.is_empty() {
            return Ok(Some(sizes));
        }
        // SAFETY: the pool has these queries, and the array has room for them.
        let result = unsafe {
            self.shared.device.get_query_pool_results(self.pool, 0, &mut sizes, vk::QueryResultFlags::TYPE_64)
        };
        match result {
            Err(vk::Result::NOT_READY) => Ok(None),
            other => other.doing("read sizes of acceleration structures").map(|()| Some(sizes)),
        }
    }
}

impl Drop for CompactedSizes {
    fn drop(&mut self) {
        let pool = self.pool;
        self.shared.retire(move |shared: &Shared| {
            // SAFETY: the device has finished with it, and its handle goes with it.
            unsafe { shared.device.destroy_query_pool(pool, None) };
        });
    }
}

impl Commands<'_> {
    /// Asks for the sizes of as many structures as `sizes` has room for. They were built as
    /// [`StructureUse::Lasting`](crate::StructureUse::Lasting), and a barrier has made that visible.
    pub fn write_compacted_sizes(&self, sizes: &CompactedSizes, structures: &[&AccelerationStructure]) {
        let Some(ray_tracing) = &self.shared.ray_tracing else {
            return;
        };
        let raw: Vec<_> =
            structures.iter().take(sizes.count as usize).map(|structure| structure.raw()).collect();
        if raw.is_empty() {
            return;
        }
        // SAFETY: the buffer is being recorded; the pool has a query of this type for each structure.
        unsafe {
            ray_tracing.structures.cmd_write_acceleration_structures_properties(
                self.raw(),
                &raw,
                vk::QueryType::ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR,
                sizes.pool,
                0,
            );
        }
    }
}
