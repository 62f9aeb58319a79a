//! Compiled pipelines, kept in a file from run to run.
//!
//! Drivers check that a cache was made by them, but not that it is whole: a file that was cut or damaged may crash
//! them. So the file carries its length and a hash, and anything that does not agree is ignored.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use ash::vk;
use xxhash_rust::xxh3::xxh3_64;

use crate::error::{Doing, GpuError};

const MAGIC: [u8; 8] = *b"AGPIPE01";
/// Magic, length, hash.
const HEADER: usize = 24;
/// Larger caches are neither read nor written.
const MOST_BYTES: u64 = 64 << 20;

pub(crate) struct PipelineCache {
    pub(crate) raw: vk::PipelineCache,
    file: Option<PathBuf>,
    /// The hash of what is in the file.
    saved: u64,
}

impl PipelineCache {
    pub(crate) fn open(
        device: &ash::Device,
        properties: &vk::PhysicalDeviceProperties,
        folder: Option<&Path>,
    ) -> Result<Self, GpuError> {
        let file = folder.map(|folder| folder.join("pipelines").join(file_name(properties)));
        let data = file.as_deref().and_then(read).unwrap_or_default();
        let info = vk::PipelineCacheCreateInfo::default().initial_data(&data);
        // SAFETY: the data is as the driver wrote it, or empty.
        let raw = unsafe { device.create_pipeline_cache(&info, None) }.doing("create a pipeline cache")?;
        Ok(Self { raw, file, saved: xxh3_64(&data) })
    }

    /// # Safety
    /// Nothing may use the cache any more, and this must be called once.
    pub(crate) unsafe fn save_and_destroy(&self, device: &ash::Device) {
        // SAFETY: upheld by the caller.
        let data = unsafe { device.get_pipeline_cache_data(self.raw) };
        if let (Ok(data), Some(file)) = (data, &self.file)
            && xxh3_64(&data) != self.saved
            && let Err(error) = write(file, &data)
        {
            tracing::debug!("could not keep compiled pipelines: {error}");
        }
        // SAFETY: upheld by the caller.
        unsafe { device.destroy_pipeline_cache(self.raw, None) };
    }
}

/// One file a device and driver build.
fn file_name(properties: &vk::PhysicalDeviceProperties) -> String {
    let uuid: String = properties.pipeline_cache_uuid.iter().map(|byte| format!("{byte:02x}")).collect();
    format!("{:04x}-{:04x}-{uuid}.bin", properties.vendor_id, properties.device_id)
}

/// The cache in a file, if it is there and whole.
fn read(file: &Path) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    fs::File::open(file).ok()?.take(MOST_BYTES + HEADER as u64).read_to_end(&mut bytes).ok()?;
    let data = bytes.get(HEADER..)?;
    (bytes[..HEADER] == header(data)).then(|| data.to_vec())
}

/// Writes beside the file and renames, so that another process never sees half of it.
fn write(file: &Path, data: &[u8]) -> std::io::Result<()> {
    if data.len() as u64 > MOST_BYTES {
        return Ok(());
    }
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder)?;
    }
    let beside = file.with_extension(format!("{}.tmp", std::process::id()));
    let mut bytes = header(data).to_vec();
    bytes.extend_from_slice(data);
    fs::write(&beside, bytes)?;
    fs::rename(&beside, file).inspect_err(|_| {
        // Nothing is lost if it stays.
        let _ = fs::remove_file(&beside);
    })
}

fn header(data: &[u8]) -> [u8; HEADER] {
    let mut header = [0; HEADER];
    header[..8].copy_from_slice(&MAGIC);
    header[8..16].copy_from_slice(&(data.len() as u64).to_le_bytes());
    header[16..].copy_from_slice(&xxh3_64(data).to_le_bytes());
    header
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_whole_file_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("deeper/cache.bin");
        assert_eq!(read(&file), None);
        write(&file, b"compiled").unwrap();
        assert_eq!(read(&file).as_deref(), Some(&b"compiled"[..]));

        let whole = fs::read(&file).unwrap();
        for length in 0..whole.len() {
            fs::write(&file, &whole[..length]).unwrap();
            assert_eq!(read(&file), None, "cut to {length}");
        }
        for index in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[index] ^= 1;
            fs::write(&file, damaged).unwrap();
            assert_eq!(read(&file), None, "damaged at {index}");
        }
    }
}
