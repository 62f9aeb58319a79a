//! What rays read besides structures: surfaces, members, lights and the tree over them, and the frame's own tables.
//!
//! A device that has memory of its own gets copies there, made by a pass of the frame, and what is the same as in the last
//! frame stays. Where the processor's memory is the device's, rays read what was written.

use std::ops::Range;

use afterglow_gpu::{Commands, Gpu, GpuError};
use afterglow_records::FrameRecord;
use bytemuck::Pod;
use xxhash_rust::xxh3::xxh3_64;

use super::slabs::Part;
use super::staging::Staging;
use crate::tables::Uploaded;
use crate::uploads::UploadArena;

/// Bytes of a slab: some frames' lists of an ordinary scene.
const SLAB_BYTES: u64 = 4 << 20;

/// One of the lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum List {
    /// `SurfaceDraw`s.
    Surfaces,
    /// `MeshMember`s.
    Members,
    /// `LightSource`s.
    Lights,
    /// `LightNode`s.
    LightNodes,
}

impl List {
    const COUNT: usize = 4;
}

/// A list on the device, by its content.
struct Resident {
    hash: u64,
    bytes: usize,
    part: Part,
}

/// All lists.
pub(crate) struct Lists {
    /// None where the device reads what was written.
    staging: Option<Staging>,
    residents: [Option<Resident>; List::COUNT],
}

impl Lists {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self::with(gpu, !gpu.has_unified_memory())
    }

    fn with(gpu: &Gpu, copies: bool) -> Self {
        Self {
            staging: copies.then(|| Staging::new(gpu, "lists", SLAB_BYTES)),
            residents: Default::default(),
        }
    }

    /// Copies lists from now on, whatever memory the device has.
    #[cfg(test)]
    pub(crate) fn always_copy(&mut self, gpu: &Gpu) {
        *self = Self::with(gpu, true);
    }

    /// A new frame begins.
    pub(crate) fn begin_frame(&mut self) {
        if let Some(staging) = &mut self.staging {
            staging.begin_frame();
        }
    }

    /// After a frame that was not recorded: what it would have copied is not there.
    pub(crate) fn forget(&mut self) {
        let Some(staging) = &mut self.staging else { return };
        for resident in self.residents.iter_mut().filter_map(Option::take) {
            staging.free(resident.part);
        }
    }

    /// Brings a list to where rays read it. Returns its address; an empty one has one element of zeros.
    pub(crate) fn bring<T: Pod>(
        &mut self,
        list: List,
        table: &[T],
        arena: &mut UploadArena,
    ) -> Result<u64, GpuError> {
        let Some(staging) = &mut self.staging else {
            return Ok(arena.push_table(table)?.address);
        };
        let zeros = [T::zeroed()];
        let bytes: &[u8] = bytemuck::cast_slice(if table.is_empty() { &zeros } else { table });
        let hash = xxh3_64(bytes);
        let resident = &mut self.residents[list as usize];
        if let Some(same) = resident.as_ref().filter(|old| old.hash == hash && old.bytes == bytes.len()) {
            return Ok(same.part.address);
        }
        if let Some(old) = resident.take() {
            staging.free(old.part);
        }
        let part = staging.bring(bytes, arena)?;
        let address = part.address;
        *resident = Some(Resident { hash, bytes: bytes.len(), part });
        Ok(address)
    }

    /// Brings a frame's tables, vertices and indices to where rays read them.
    pub(crate) fn bring_frame(
        &mut self,
        uploaded: &Uploaded,
        arena: &mut UploadArena,
    ) -> Result<FramePlace, GpuError> {
        let Some(staging) = &mut self.staging else {
            return Ok(FramePlace { record: uploaded.address, moves: Vec::new() });
        };
        let mut place = FramePlace::default();
        for (upload, bytes) in uploaded.pieces.iter().filter(|(_, bytes)| *bytes > 0) {
            let part = staging.bring_uploaded(*upload, *bytes)?;
            place.moves.push((upload.address..upload.address + bytes, part.address));
            staging.free(part);
        }
        let record = place.record_of(&uploaded.record);
        place.record = staging.bring_once(bytemuck::bytes_of(&record), arena)?;
        Ok(place)
    }

    /// Whether this frame copies anything.
    pub(crate) fn has_work(&self) -> bool {
        self.staging.as_ref().is_some_and(Staging::has_work)
    }

    /// Records this frame's copies.
    pub(crate) fn record(&self, commands: &Commands<'_>) {
        if let Some(staging) = &self.staging {
            staging.record(commands);
        }
    }
}

/// Where rays read a frame's tables.
#[derive(Debug, Default)]
pub(crate) struct FramePlace {
    /// Address of the frame's record.
    pub(crate) record: u64,
    /// Addresses where something was written, and the first one where it is now.
    moves: Vec<(Range<u64>, u64)>,
}

impl FramePlace {
    /// Where rays read what was written at an address.
    pub(crate) fn of(&self, address: u64) -> u64 {
        let moved = self.moves.iter().find(|(from, _)| from.contains(&address));
        moved.map_or(address, |(from, to)| to + (address - from.start))
    }

    fn record_of(&self, written: &FrameRecord) -> FrameRecord {
        FrameRecord {
            draws: self.of(written.draws),
            transforms: self.of(written.transforms),
            lights: self.of(written.lights),
            materials: self.of(written.materials),
            environments: self.of(written.environments),
            texgens: self.of(written.texgens),
            texture_matrices: self.of(written.texture_matrices),
            clip_planes: self.of(written.clip_planes),
            current: self.of(written.current),
            pixels: self.of(written.pixels),
            window_size: written.window_size,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::gpu;

    #[test]
    fn what_is_the_same_is_not_copied_again() {
        let (mut lists, mut arena) = (Lists::with(&gpu(), true), UploadArena::new(&gpu()));
        let mut bring = |table: &[u32]| {
            lists.begin_frame();
            let address = lists.bring(List::Lights, table, &mut arena).unwrap();
            (address, lists.has_work())
        };
        let first = bring(&[1, 2, 3]);
        assert!(first.1);
        assert_eq!(bring(&[1, 2, 3]), (first.0, false));
        let other = bring(&[1, 2, 4]);
        // The last frame may still be read.
        assert!(other.1 && other.0 != first.0);
        assert!(bring(&[]).1);
        lists.forget();
        assert!(lists.residents.iter().all(Option::is_none));
    }

    #[test]
    fn copies_arrive() {
        let gpu = gpu();
        let (mut lists, mut arena) = (Lists::with(&gpu, true), UploadArena::new(&gpu));
        lists.bring(List::Surfaces, &[5_u32; 7], &mut arena).unwrap();
        lists.bring(List::Members, &[6_u32; 9], &mut arena).unwrap();
        gpu.run(|commands| lists.record(commands)).unwrap();
        let (staging, part) = (lists.staging.as_ref().unwrap(), lists.residents[1].as_ref().unwrap());
        assert_eq!(staging.read(&gpu, &part.part)[..9], [6; 9]);
    }

    #[test]
    fn memory_that_both_share_needs_no_copies() {
        let (mut lists, mut arena) = (Lists::with(&gpu(), false), UploadArena::new(&gpu()));
        lists.begin_frame();
        lists.bring(List::Lights, &[1_u32], &mut arena).unwrap();
        assert!(!lists.has_work());
        // Lavapipe's is the processor's.
        let is_software = gpu().info().kind.is_software();
        assert!(!is_software || Lists::new(&gpu()).staging.is_none());
    }
}
