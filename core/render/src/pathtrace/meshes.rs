//! Structures of the software backend: bottom levels on the device, found by their content, and a top level a frame.
//! Where a mesh that does not last is gone and another has the same triangles in the same order, only moved, its structure
//! moves with them.

use afterglow_bvh::layout::FLAG_ALPHA_TESTED;
use afterglow_bvh::{
    Aabb, Blas, BlasInput, Instance, Quality, TriangleAttributes, build_blas_with, build_tlas,
};
use afterglow_gpu::{Commands, Gpu, GpuError, vk};
use afterglow_records::MEMBER_SHIFT;
use hashbrown::HashMap;

use super::driver_input::topology;
use super::formers::Formers;
use super::refit::Movable;
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
    /// Of meshes that do not last: a hash of all but the positions, and the structure.
    movable: Option<(u64, Movable)>,
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
    formers: Formers,
    frame: u64,
    copies: Vec<MeshCopy>,
    /// Triangles built in this frame.
    pub(crate) built: usize,
}

impl Meshes {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            slabs: Slabs::new(gpu),
            entries: HashMap::new(),
            formers: Formers::default(),
            frame: 0,
            copies: Vec::new(),
            built: 0,
        }
    }

    /// A new frame begins: what was not used for long goes.
    pub(crate) fn begin_frame(&mut self) {
        self.frame += 1;
        self.copies.clear();
        self.built = 0;
        self.slabs.begin_frame();
        self.formers.begin_frame();
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
        let Some(entry) = self.entries.get_mut(&content) else {
            return false;
        };
        if let (Some((topology, _)), true) = (&entry.movable, entry.used != self.frame) {
            self.formers.note(*topology, content);
        }
        entry.used = self.frame;
        entry.mesh.is_some()
    }

    /// Builds a mesh, or moves one that the last frame used and this one does not.
    pub(crate) fn build(
        &mut self,
        content: u64,
        input: &MeshInput<'_>,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        let mut movable = None;
        match input.shapes {
            Shapes::Spheres(spheres) => {
                self.built += spheres.len();
                let blas = built(&BlasInput { spheres, ..BlasInput::default() }, Quality::Fast);
                self.insert(content, blas.as_ref(), arena)?;
            }
            Shapes::Triangles { corners, members } if input.is_lasting => {
                self.built += corners.len() / 3;
                let is_small = corners.len() / 3 <= MOST_IMPROVED;
                let quality = if is_small { Quality::Good } else { Quality::Fast };
                self.insert(content, of_triangles(corners, members, quality).as_ref(), arena)?;
            }
            Shapes::Triangles { corners, members } => {
                self.built += corners.len() / 3;
                let topology = topology(&input.shapes);
                let moved = topology.and_then(|topology| self.former(topology)?.moved(corners, members));
                let anew = || of_triangles(corners, members, Quality::Fast).map(Movable::new);
                movable = topology.zip(moved.or_else(anew));
                self.insert(content, movable.as_ref().map(|(_, movable)| &movable.blas), arena)?;
            }
        }
        if let Some(entry) = self.entries.get_mut(&content) {
            entry.movable = movable;
        }
        Ok(())
    }

    /// The structure of a mesh that the last frame used and this one does not.
    fn former(&mut self, topology: u64) -> Option<Movable> {
        while let Some(content) = self.formers.next(topology) {
            if self.entries.get(&content).is_some_and(|entry| entry.used == self.frame) {
                continue;
            }
            if let Some(entry) = self.entries.remove(&content) {
                if let Some(part) = entry.part {
                    self.slabs.free(part);
                }
                return entry.movable.map(|(_, movable)| movable);
            }
        }
        None
    }

    fn insert(&mut self, content: u64, blas: Option<&Blas>, arena: &mut UploadArena) -> Result<(), GpuError> {
        let mut entry = Entry { mesh: None, part: None, movable: None, used: 0 };
        if let Some(blas) = blas {
            let part = self.upload(&blas.words, arena)?;
            entry.mesh = Some(Mesh { address: part.address, bounds: blas.bounds });
            entry.part = Some(part);
        }
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

    fn upload(&mut self, words: &[u32], arena: &mut UploadArena) -> Result<Part, GpuError> {
        let bytes: &[u8] = bytemuck::cast_slice(words);
        let part = self.slabs.allocate(bytes.len() as u64)?;
        if let Some((to, offset)) = self.slabs.place(&part) {
            self.copies.push(MeshCopy { from: arena.push(bytes)?, to, offset, bytes: bytes.len() as u64 });
        }
        Ok(part)
    }
}

/// A structure; none if there is nothing to meet.
fn built(input: &BlasInput<'_>, quality: Quality) -> Option<Blas> {
    build_blas_with(input, quality)
        .map_err(|error| tracing::warn!("a mesh is left out: {error}"))
        .ok()
        .filter(|blas| blas.triangle_count > 0)
}

fn of_triangles(corners: &[[f32; 3]], members: &[Member], quality: Quality) -> Option<Blas> {
    let attributes = attributes(members);
    let indices: Vec<[u32; 3]> = (0..attributes.len() as u32)
        .map(|triangle| [3 * triangle, 3 * triangle + 1, 3 * triangle + 2])
        .collect();
    let input =
        BlasInput { positions: corners, indices: &indices, attributes: &attributes, ..BlasInput::default() };
    built(&input, quality)
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
