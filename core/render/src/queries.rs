//! Occlusion queries: samples that pass between two operations, which may lie in different passes and frames.

use afterglow_gpu::{Commands, Gpu, GpuError, vk};
use hashbrown::HashMap;

/// Queries a pool.
const POOL_SIZE: u32 = 256;

/// A part of a query that lies within one pass.
#[derive(Debug, Clone, Copy)]
struct Segment {
    /// The program's name of the query.
    id: u32,
    /// It is the first part: counting begins anew.
    is_first: bool,
}

/// The device's queries of one frame in flight.
pub(crate) struct SegmentPool {
    gpu: Gpu,
    pools: Vec<vk::QueryPool>,
    segments: Vec<Segment>,
}

/// The query that is being counted, and the results so far.
#[derive(Default)]
pub(crate) struct Queries {
    active: Option<Segment>,
    /// The open segment's number.
    open: Option<u32>,
    samples: HashMap<u32, u64>,
}

impl SegmentPool {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self { gpu: gpu.clone(), pools: Vec::new(), segments: Vec::new() }
    }

    fn add(&mut self, segment: Segment) -> Result<(vk::QueryPool, u32), GpuError> {
        let number = self.segments.len() as u32;
        if number / POOL_SIZE >= self.pools.len() as u32 {
            self.add_pool()?;
        }
        self.segments.push(segment);
        Ok(self.query(number))
    }

    fn add_pool(&mut self) -> Result<(), GpuError> {
        let info =
            vk::QueryPoolCreateInfo::default().query_type(vk::QueryType::OCCLUSION).query_count(POOL_SIZE);
        // SAFETY: the device is alive; queries may be reset by the host, which is a required feature.
        let pool = unsafe {
            let pool = self.gpu.device().create_query_pool(&info, None);
            pool.inspect(|pool| self.gpu.device().reset_query_pool(*pool, 0, POOL_SIZE))
        };
        self.pools.push(pool.map_err(|result| GpuError::Vulkan { what: "create a query pool", result })?);
        Ok(())
    }

    fn query(&self, number: u32) -> (vk::QueryPool, u32) {
        (self.pools[(number / POOL_SIZE) as usize], number % POOL_SIZE)
    }
}

impl Drop for SegmentPool {
    fn drop(&mut self) {
        let pools = std::mem::take(&mut self.pools);
        self.gpu.retire(move |device| {
            for pool in pools {
                // SAFETY: the device has finished with it, and its handle goes with it.
                unsafe { device.destroy_query_pool(pool, None) };
            }
        });
    }
}

impl Queries {
    /// The program begins to count. Recorded within a pass.
    pub(crate) fn begin(
        &mut self,
        commands: &Commands<'_>,
        pool: &mut SegmentPool,
        id: u32,
    ) -> Result<(), GpuError> {
        self.suspend(commands, pool);
        self.active = Some(Segment { id, is_first: true });
        self.resume(commands, pool)
    }

    /// The program has counted. Recorded within a pass.
    pub(crate) fn end(&mut self, commands: &Commands<'_>, pool: &SegmentPool) {
        self.suspend(commands, pool);
        self.active = None;
    }

    /// A pass begins: goes on counting.
    pub(crate) fn resume(&mut self, commands: &Commands<'_>, pool: &mut SegmentPool) -> Result<(), GpuError> {
        let Some(segment) = &mut self.active else {
            return Ok(());
        };
        let number = pool.segments.len() as u32;
        let (raw, query) = pool.add(*segment)?;
        segment.is_first = false;
        let flags = match pool.gpu.features().occlusion_query_precise {
            true => vk::QueryControlFlags::PRECISE,
            false => vk::QueryControlFlags::empty(),
        };
        // SAFETY: the query was reset and is not active.
        unsafe {
            commands.device().cmd_begin_query(commands.raw(), raw, query, flags);
        }
        self.open = Some(number);
        Ok(())
    }

    /// A pass ends: what goes on is counted in the next.
    pub(crate) fn suspend(&mut self, commands: &Commands<'_>, pool: &SegmentPool) {
        if let Some(number) = self.open.take() {
            let (raw, query) = pool.query(number);
            // SAFETY: the query is active in this pass.
            unsafe { commands.device().cmd_end_query(commands.raw(), raw, query) };
        }
    }

    /// Adds up a frame's segments, which the device must have finished, and makes its pool ready for another.
    pub(crate) fn collect(&mut self, pool: &mut SegmentPool) -> Result<(), GpuError> {
        let segments = std::mem::take(&mut pool.segments);
        for (chunk, raw) in segments.chunks(POOL_SIZE as usize).zip(&pool.pools) {
            let mut counts = vec![0_u64; chunk.len()];
            let flags = vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WAIT;
            let device = pool.gpu.device();
            // SAFETY: the pool has these queries, all of them ended, and none is in use any more.
            unsafe {
                let read = device.get_query_pool_results(*raw, 0, &mut counts, flags);
                read.map_err(|result| GpuError::Vulkan { what: "read queries", result })?;
                device.reset_query_pool(*raw, 0, POOL_SIZE);
            }
            for (segment, count) in chunk.iter().zip(counts) {
                let samples = self.samples.entry(segment.id).or_default();
                *samples = count + if segment.is_first { 0 } else { *samples };
            }
        }
        Ok(())
    }

    /// The samples that a query has counted in frames that were collected.
    pub(crate) fn samples(&self, id: u32) -> u32 {
        let samples = self.samples.get(&id).copied().unwrap_or(0);
        u32::try_from(samples).unwrap_or(u32::MAX)
    }

    /// A recording was thrown away: nothing is open in it.
    pub(crate) fn abandon(&mut self, pool: &mut SegmentPool) {
        self.open = None;
        pool.segments.clear();
    }
}
