//! Bottom levels on the device, found by their content.

use afterglow_bvh::{Aabb, Blas, BlasInput, Quality, TriangleAttributes, build_blas_with};
use afterglow_gpu::{Commands, Gpu, GpuError, vk};
use hashbrown::HashMap;

use super::slabs::{Part, Slabs};
use crate::uploads::{Upload, UploadArena};

/// Frames after which a mesh that no frame has used is given up.
const IDLE_FRAMES: u64 = 60;
/// Meshes of more triangles are built fast, whatever they are.
const MOST_IMPROVED: usize = 20_000;

/// A bottom level on the device.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mesh {
    pub(crate) address: u64,
    pub(crate) bounds: Aabb,
}

struct Entry {
    /// None if the mesh has no triangles that can be hit.
    mesh: Option<Mesh>,
    part: Option<Part>,
    used: u64,
}

/// A copy that brings a structure to its place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeshCopy {
    from: Upload,
    to: vk::Buffer,
    offset: u64,
    bytes: u64,
}

/// All meshes, and the copies that this frame's new structures need.
pub(crate) struct Meshes {
    slabs: Slabs,
    entries: HashMap<u64, Entry>,
    frame: u64,
    pub(crate) copies: Vec<MeshCopy>,
    /// Triangles built in this frame.
    pub(crate) built: usize,
}

impl Meshes {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self { slabs: Slabs::new(gpu), entries: HashMap::new(), frame: 0, copies: Vec::new(), built: 0 }
    }

    /// A new frame begins: what was not used for long goes.
    pub(crate) fn begin_frame(&mut self) {
        self.frame += 1;
        self.copies.clear();
        self.built = 0;
        self.slabs.begin_frame();
        let (frame, slabs) = (self.frame, &mut self.slabs);
        self.entries.retain(|_, entry| {
            let is_kept = entry.used + IDLE_FRAMES > frame;
            if let (false, Some(part)) = (is_kept, entry.part.take()) {
                slabs.free(part);
            }
            is_kept
        });
    }

    /// Whether a mesh is there, so that it need not be built.
    pub(crate) fn has(&self, content: u64) -> bool {
        self.entries.contains_key(&content)
    }

    /// The mesh of a content; none if it has no triangles to hit.
    pub(crate) fn get(&mut self, content: u64) -> Option<Mesh> {
        let entry = self.entries.get_mut(&content)?;
        entry.used = self.frame;
        entry.mesh
    }

    /// Builds a mesh from three corners a triangle. `is_lasting` says whether it will be used for long.
    pub(crate) fn build(
        &mut self,
        content: u64,
        corners: &[[f32; 3]],
        attributes: &[TriangleAttributes],
        is_lasting: bool,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        let indices: Vec<[u32; 3]> = (0..attributes.len() as u32)
            .map(|triangle| [3 * triangle, 3 * triangle + 1, 3 * triangle + 2])
            .collect();
        let quality = match is_lasting && attributes.len() <= MOST_IMPROVED {
            true => Quality::Good,
            false => Quality::Fast,
        };
        let input = BlasInput { positions: corners, indices: &indices, attributes, ..BlasInput::default() };
        self.insert(content, &input, quality, arena)
    }

    /// Builds a mesh of spheres: middles and radii. A hit's primitive is the sphere's number.
    pub(crate) fn build_spheres(
        &mut self,
        content: u64,
        spheres: &[[f32; 4]],
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        let input = BlasInput { spheres, ..BlasInput::default() };
        self.insert(content, &input, Quality::Fast, arena)
    }

    fn insert(
        &mut self,
        content: u64,
        input: &BlasInput<'_>,
        quality: Quality,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        self.built += input.indices.len();
        let blas = build_blas_with(input, quality)
            .map_err(|error| tracing::warn!("a mesh is left out: {error}"))
            .ok()
            .filter(|blas| blas.triangle_count > 0);
        let entry = match blas {
            Some(blas) => self.place(&blas, arena)?,
            None => Entry { mesh: None, part: None, used: self.frame },
        };
        self.entries.insert(content, entry);
        Ok(())
    }

    /// Brings words that only this frame reads to the device. Returns their address.
    pub(crate) fn upload_once(&mut self, words: &[u32], arena: &mut UploadArena) -> Result<u64, GpuError> {
        let part = self.upload(words, arena)?;
        let address = part.address;
        self.slabs.free(part);
        Ok(address)
    }

    fn place(&mut self, blas: &Blas, arena: &mut UploadArena) -> Result<Entry, GpuError> {
        let part = self.upload(&blas.words, arena)?;
        let mesh = Mesh { address: part.address, bounds: blas.bounds };
        Ok(Entry { mesh: Some(mesh), part: Some(part), used: self.frame })
    }

    fn upload(&mut self, words: &[u32], arena: &mut UploadArena) -> Result<Part, GpuError> {
        let bytes: &[u8] = bytemuck::cast_slice(words);
        let part = self.slabs.allocate(bytes.len() as u64)?;
        if let Some((to, offset)) = self.slabs.place(&part) {
            self.copies.push(MeshCopy { from: arena.push(bytes)?, to, offset, bytes: bytes.len() as u64 });
        }
        Ok(part)
    }
}

/// Records copies of structures to their places.
pub(crate) fn record_copies(commands: &Commands<'_>, copies: &[MeshCopy]) {
    for copy in copies.iter().filter(|copy| copy.bytes > 0) {
        let regions =
            [vk::BufferCopy { src_offset: copy.from.offset, dst_offset: copy.offset, size: copy.bytes }];
        // SAFETY: both buffers are this device's and hold these bytes; the target's are allocated for this copy.
        unsafe {
            commands.device().cmd_copy_buffer(commands.raw(), copy.from.buffer, copy.to, &regions);
        }
    }
}
