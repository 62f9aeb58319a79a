//! How long the device takes for what.

use std::sync::Arc;

use ash::vk;
use serde::Serialize;

use crate::commands::Commands;
use crate::error::{Doing, GpuError};
use crate::gpu::{Gpu, Shared};

/// Queries more than are used: after a multiview pass a timestamp takes one query a view, and Mesa's lavapipe
/// writes that many even where the pool ends.
const PADDING: u32 = 6;

/// Time between two points of the device's work.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Timing {
    pub name: String,
    pub nanoseconds: u64,
}

/// A scope whose end has not been recorded yet.
#[derive(Debug)]
#[must_use = "a scope must be ended"]
pub struct Scope(Option<u32>);

/// Measures named scopes of one recording at a time. It may be dropped while in use.
pub struct GpuTimer {
    shared: Arc<Shared>,
    pool: vk::QueryPool,
    most_scopes: u32,
    names: Vec<String>,
    /// Bits of a timestamp that count.
    mask: u64,
    nanoseconds_per_tick: f64,
}

impl Gpu {
    /// A timer for up to `most_scopes` scopes a recording; more are left out. On a device that has no timestamps
    /// it measures nothing.
    pub fn create_timer(&self, most_scopes: u32) -> Result<GpuTimer, GpuError> {
        let bits = self.shared.candidate.timestamp_valid_bits;
        let most_scopes = if bits == 0 { 0 } else { most_scopes };
        let info = vk::QueryPoolCreateInfo::default()
            .query_type(vk::QueryType::TIMESTAMP)
            .query_count(most_scopes * 2 + PADDING);
        // SAFETY: the device is alive.
        let pool = unsafe { self.device().create_query_pool(&info, None) }.doing("create a query pool")?;
        Ok(GpuTimer {
            shared: self.shared.clone(),
            pool,
            most_scopes,
            names: Vec::new(),
            mask: u64::MAX.checked_shr(64 - bits).unwrap_or(0),
            nanoseconds_per_tick: f64::from(self.limits().timestamp_period),
        })
    }
}

impl GpuTimer {
    /// Forgets earlier scopes. To be recorded first, outside of any pass, when the earlier recording has finished.
    pub fn restart(&mut self, commands: &Commands<'_>) {
        self.names.clear();
        // SAFETY: the pool is this device's and has this many queries.
        unsafe {
            commands.device().cmd_reset_query_pool(
                commands.raw(),
                self.pool,
                0,
                self.most_scopes * 2 + PADDING,
            );
        }
    }

    /// Starts a scope when all before it has finished.
    pub fn begin(&mut self, commands: &Commands<'_>, name: &str) -> Scope {
        let index = self.names.len() as u32;
        if index >= self.most_scopes {
            return Scope(None);
        }
        self.names.push(name.to_owned());
        self.write(commands, index * 2);
        Scope(Some(index))
    }

    /// Ends a scope when all in it has finished.
    pub fn end(&mut self, commands: &Commands<'_>, scope: Scope) {
        if let Scope(Some(index)) = scope {
            self.write(commands, index * 2 + 1);
        }
    }

    /// The scopes of the last recording, in the order of their beginnings. The recording must have been waited for,
    /// and every scope must have been ended.
    pub fn results(&self) -> Result<Vec<Timing>, GpuError> {
        let mut ticks = vec![0_u64; self.names.len() * 2];
        if ticks.is_empty() {
            return Ok(Vec::new());
        }
        // SAFETY: the pool has these queries, and the array has room for them.
        unsafe {
            self.shared.device.get_query_pool_results(self.pool, 0, &mut ticks, vk::QueryResultFlags::TYPE_64)
        }
        .doing("read timestamps")?;
        let timing = |(name, ticks): (&String, &[u64])| Timing {
            name: name.clone(),
            nanoseconds: self.nanoseconds(ticks[0], ticks[1]),
        };
        Ok(self.names.iter().zip(ticks.chunks_exact(2)).map(timing).collect())
    }

    /// Counters wrap around at the number of bits that count.
    fn nanoseconds(&self, begin: u64, end: u64) -> u64 {
        let ticks = end.wrapping_sub(begin) & self.mask;
        (ticks as f64 * self.nanoseconds_per_tick) as u64
    }

    fn write(&self, commands: &Commands<'_>, query: u32) {
        let stage = vk::PipelineStageFlags::BOTTOM_OF_PIPE;
        // SAFETY: the pool has this query, and `restart` has reset it.
        unsafe {
            commands.device().cmd_write_timestamp(commands.raw(), stage, self.pool, query);
        }
    }
}

impl Drop for GpuTimer {
    fn drop(&mut self) {
        let pool = self.pool;
        self.shared.retire(move |shared: &Shared| {
            // SAFETY: the device has finished with it, and its handle goes with it.
            unsafe { shared.device.destroy_query_pool(pool, None) };
        });
    }
}
