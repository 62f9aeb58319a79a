//! Structures of the software backend: bottom levels on the device, found by their content, and a top level a frame.

use afterglow_bvh::layout::FLAG_ALPHA_TESTED;
use afterglow_bvh::{
    Aabb, Blas, BlasInput, Instance, Quality, TriangleAttributes, build_blas_with, build_tlas,
};
use afterglow_gpu::{Commands, Gpu, GpuError, vk};
use afterglow_records::MEMBER_SHIFT;
use hashbrown::HashMap;

use super::slabs::{Part, Slabs};
use super::structures::{IDLE_FRAMES, Member, MeshInput, Placed, Shapes, TopLevel, longest_side};
use crate::uploads::{Upload, UploadArena};

/// Meshes of more triangles are built fast, whatever they are.
const MOST_IMPROVED: usize = 20_000;

/// A bottom level on the device.
#[derive(Debug, Clone, Copy)]
struct Mesh {
    address: u64,
    bounds: Aabb,
}

struct Entry {
    /// None if the mesh has no triangles that can be hit.
    mesh: Option<Mesh>,
    part: Option<Part>,
    used: u64,
}

/// A copy that brings a structure to its place.
#[derive(Debug, Clone, Copy)]
struct MeshCopy {
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
    copies: Vec<MeshCopy>,
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

    /// Says that this frame uses a mesh, and whether rays can meet anything of it.
    pub(crate) fn take(&mut self, content: u64) -> bool {
        self.entries.get_mut(&content).is_some_and(|entry| {
            entry.used = self.frame;
            entry.mesh.is_some()
        })
    }

    /// Builds a mesh.
    pub(crate) fn build(
        &mut self,
        content: u64,
        input: &MeshInput<'_>,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        match input.shapes {
            Shapes::Triangles { corners, members } => {
                let attributes = attributes(members);
                let indices: Vec<[u32; 3]> = (0..attributes.len() as u32)
                    .map(|triangle| [3 * triangle, 3 * triangle + 1, 3 * triangle + 2])
                    .collect();
                let quality = match input.is_lasting && attributes.len() <= MOST_IMPROVED {
                    true => Quality::Good,
                    false => Quality::Fast,
                };
                let input = BlasInput {
                    positions: corners,
                    indices: &indices,
                    attributes: &attributes,
                    ..BlasInput::default()
                };
                self.insert(content, &input, quality, arena)
            }
            Shapes::Spheres(spheres) => {
                let input = BlasInput { spheres, ..BlasInput::default() };
                self.insert(content, &input, Quality::Fast, arena)
            }
        }
    }

    fn insert(
        &mut self,
        content: u64,
        input: &BlasInput<'_>,
        quality: Quality,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        self.built += input.indices.len() + input.spheres.len();
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

    /// Makes the top level of a frame.
    pub(crate) fn top_level(
        &mut self,
        placed: &[Placed],
        arena: &mut UploadArena,
    ) -> Result<TopLevel, GpuError> {
        let instance = |placed: &Placed| {
            let mesh = self.entries.get(&placed.content)?.mesh?;
            Some(Instance {
                object_to_world: placed.object_to_world,
                blas: mesh.address,
                bounds: mesh.bounds,
                id: placed.id,
                mask: placed.mask,
                flags: 0,
            })
        };
        let instances: Vec<_> = placed.iter().filter_map(instance).collect();
        let tlas = build_tlas(&instances).unwrap_or_else(|error| {
            tracing::warn!("rays meet nothing: {error}");
            build_tlas(&[]).unwrap_or_else(|_| unreachable!("no instances are not too many"))
        });
        Ok(TopLevel {
            address: self.upload_once(&tlas.words, arena)?,
            instances: tlas.instance_count,
            extent: longest_side(&tlas.bounds),
        })
    }

    /// Whether this frame has anything to record.
    pub(crate) fn has_work(&self) -> bool {
        self.copies.iter().any(|copy| copy.bytes > 0)
    }

    /// Records copies of structures to their places.
    pub(crate) fn record(&self, commands: &Commands<'_>) {
        for copy in self.copies.iter().filter(|copy| copy.bytes > 0) {
            let regions =
                [vk::BufferCopy { src_offset: copy.from.offset, dst_offset: copy.offset, size: copy.bytes }];
            // SAFETY: both buffers are this device's and hold these bytes; the target's are allocated for this copy.
            unsafe {
                commands.device().cmd_copy_buffer(commands.raw(), copy.from.buffer, copy.to, &regions);
            }
        }
    }

    /// Brings words that only this frame reads to the device. Returns their address.
    fn upload_once(&mut self, words: &[u32], arena: &mut UploadArena) -> Result<u64, GpuError> {
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

/// What hits report of the members' triangles, in order.
fn attributes(members: &[Member]) -> Vec<TriangleAttributes> {
    let of_member = |(number, member): (usize, &Member)| {
        let first = (number as u32) << MEMBER_SHIFT;
        let flags = if member.is_alpha_tested { FLAG_ALPHA_TESTED } else { 0 };
        (0..member.triangles).map(move |triangle| TriangleAttributes { primitive: first | triangle, flags })
    };
    members.iter().enumerate().flat_map(of_member).collect()
}
