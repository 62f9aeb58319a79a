//! Structures of the hardware backend, which the driver builds from triangles and spheres as they are uploaded.
//!
//! What lasts is built to be traced fast, and compacted some frames later. What changes is built fast; where a mesh of the
//! last frame is gone and another has the same triangles in the same order, only moved, its structure is updated: which of
//! the triangles can be met is part of what must be the same.

use std::sync::Arc;

use afterglow_bvh::Aabb;
use afterglow_bvh::layout::LARGEST_COORDINATE;
use afterglow_gpu::{
    AccelerationStructure, Access, BuildScratch, Commands, Gpu, GpuError, StructureBuild, StructureGeometry,
    StructureInput, StructureInstance, StructureUse,
};
use glam::Mat3;
use hashbrown::HashMap;

use super::compaction::Compaction;
use super::driver_input::{DriverInput, Kind};
use super::formers::Formers;
use super::structures::{IDLE_FRAMES, MeshInput, Placed, TopLevel, longest_side};
use crate::uploads::UploadArena;

/// Bytes of scratch memory that builds share, unless one alone takes more.
const SCRATCH_BYTES: u64 = 32 << 20;
/// Updates after which a mesh is built anew, and the growth of its box's area that has the same effect.
const MOST_UPDATES: u32 = 32;
const MOST_GROWTH: f32 = 1.5;

/// A bottom level.
struct Mesh {
    structure: Arc<AccelerationStructure>,
    bounds: Aabb,
    kind: Kind,
}

/// What updates of a mesh need to know.
#[derive(Debug, Clone, Copy)]
struct Changing {
    /// A hash of all but the positions.
    topology: u64,
    updates: u32,
    /// Half the area of its box when it was built.
    built_area: f32,
}

#[derive(Default)]
struct Entry {
    /// None if there is nothing to meet.
    mesh: Option<Mesh>,
    /// Of meshes that do not last.
    changing: Option<Changing>,
    used: u64,
}

/// A bottom level to be built or updated.
struct Build {
    target: Arc<AccelerationStructure>,
    geometries: Vec<StructureGeometry>,
    structure_use: StructureUse,
    is_update: bool,
    scratch_bytes: u64,
}

/// A top level to be built: where its instances are, how many, and bytes of scratch memory.
struct TopBuild {
    address: u64,
    count: u32,
    scratch_bytes: u64,
}

/// All structures, and what of them this frame builds.
pub(crate) struct HardwareStructures {
    gpu: Gpu,
    scratch: BuildScratch,
    entries: HashMap<u64, Entry>,
    frame: u64,
    formers: Formers,
    builds: Vec<Build>,
    compaction: Compaction,
    top: Option<AccelerationStructure>,
    /// What the top level was built from.
    instances: Vec<StructureInstance>,
    top_build: Option<TopBuild>,
    /// Triangles and spheres built in this frame.
    pub(crate) built: usize,
}

impl HardwareStructures {
    pub(crate) fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        Ok(Self {
            gpu: gpu.clone(),
            scratch: gpu.create_build_scratch(SCRATCH_BYTES)?,
            entries: HashMap::new(),
            frame: 0,
            formers: Formers::default(),
            builds: Vec::new(),
            compaction: Compaction::default(),
            top: None,
            instances: Vec::new(),
            top_build: None,
            built: 0,
        })
    }

    /// A new frame begins: what was not used for long goes, and what can be made smaller will be.
    pub(crate) fn begin_frame(&mut self) -> Result<(), GpuError> {
        self.frame += 1;
        self.built = 0;
        self.builds.clear();
        self.top_build = None;
        let frame = self.frame;
        self.entries.retain(|_, entry| entry.used + IDLE_FRAMES > frame);
        self.formers.begin_frame();
        self.compaction.begin_frame(&self.gpu, frame)?;
        for copy in &self.compaction.copies {
            if let Some(Entry { mesh: Some(mesh), .. }) = self.entries.get_mut(&copy.content) {
                mesh.structure = copy.to.clone();
            }
        }
        Ok(())
    }

    pub(crate) fn has(&self, content: u64) -> bool {
        self.entries.contains_key(&content)
    }

    /// Says that this frame uses a mesh, and whether rays can meet anything of it.
    pub(crate) fn take(&mut self, content: u64) -> bool {
        let Some(entry) = self.entries.get_mut(&content) else {
            return false;
        };
        if let Some(changing) = entry.changing.filter(|_| entry.used != self.frame) {
            self.formers.note(changing.topology, content);
        }
        entry.used = self.frame;
        entry.mesh.is_some()
    }

    pub(crate) fn build(
        &mut self,
        content: u64,
        input: &MeshInput<'_>,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        let entry = match DriverInput::new(&input.shapes) {
            Some(driver_input) => self.place(content, &driver_input, input.is_lasting, arena)?,
            None => Entry::default(),
        };
        self.entries.insert(content, entry);
        Ok(())
    }

    /// Plans the build of a mesh. One that is more than the device takes is left out.
    fn place(
        &mut self,
        content: u64,
        input: &DriverInput<'_>,
        is_lasting: bool,
        arena: &mut UploadArena,
    ) -> Result<Entry, GpuError> {
        let geometries = input.upload(arena)?;
        let structure_use = if is_lasting { StructureUse::Lasting } else { StructureUse::Changing };
        let sizes = match self.gpu.structure_sizes(StructureInput::BottomLevel(&geometries), structure_use) {
            Err(error @ GpuError::Invalid { .. }) => {
                tracing::warn!("a mesh is left out: {error}");
                return Ok(Entry::default());
            }
            other => other?,
        };
        let former = if is_lasting { None } else { self.former(input.topology) };
        let (structure, changing) = match former {
            Some((structure, former)) => (structure, former.next(input)),
            None => {
                let structure = self.gpu.create_structure("mesh", false, sizes.structure)?;
                (Arc::new(structure), Changing::new(input))
            }
        };
        if is_lasting {
            self.compaction.note(content, &structure);
        }
        let is_update = changing.updates > 0;
        self.built += input.count as usize;
        self.builds.push(Build {
            target: structure.clone(),
            geometries,
            structure_use,
            is_update,
            scratch_bytes: if is_update { sizes.update } else { sizes.build },
        });
        let mesh = Mesh { structure, bounds: input.bounds, kind: input.kind };
        Ok(Entry { mesh: Some(mesh), changing: (!is_lasting).then_some(changing), used: 0 })
    }

    /// The structure of a mesh that the last frame used and this one does not.
    fn former(&mut self, topology: u64) -> Option<(Arc<AccelerationStructure>, Changing)> {
        while let Some(content) = self.formers.next(topology) {
            if self.entries.get(&content).is_some_and(|entry| entry.used == self.frame) {
                continue;
            }
            if let Some(Entry { mesh: Some(mesh), changing: Some(changing), .. }) =
                self.entries.remove(&content)
            {
                return Some((mesh.structure, changing));
            }
        }
        None
    }

    /// Plans the top level of a frame, unless it is that of the last one.
    pub(crate) fn top_level(
        &mut self,
        placed: &[Placed],
        arena: &mut UploadArena,
    ) -> Result<TopLevel, GpuError> {
        let most = self.gpu.ray_tracing().map_or(0, |limits| limits.instances);
        let mut bounds = Aabb::EMPTY;
        let mut instances = Vec::with_capacity(placed.len());
        for placed in placed {
            if let Some((instance, reach)) = self.instance(placed) {
                instances.push(instance);
                bounds = bounds.union(reach);
            }
        }
        if instances.len() as u64 > most {
            tracing::warn!("rays meet nothing: {} instances, the device takes {most}", instances.len());
            instances.clear();
        }
        self.compaction.ask(&self.gpu, self.frame)?;
        let is_same = self.builds.is_empty() && self.instances == instances;
        if !is_same || self.top.is_none() {
            self.plan_top(&instances, arena)?;
        }
        let scratch = self.builds.iter().map(|build| build.scratch_bytes);
        let top_scratch = self.top_build.as_ref().map(|build| build.scratch_bytes);
        self.scratch.reserve(scratch)?;
        self.scratch.reserve(top_scratch.into_iter())?;
        let count = instances.len() as u32;
        self.instances = instances;
        Ok(TopLevel {
            address: self.top.as_ref().map_or(0, AccelerationStructure::address),
            instances: count,
            extent: longest_side(&bounds),
        })
    }

    /// An instance as the device reads it, and its box; none where no ray can meet it.
    fn instance(&self, placed: &Placed) -> Option<(StructureInstance, Aabb)> {
        let mesh = self.entries.get(&placed.content)?.mesh.as_ref()?;
        if placed.mask == 0 || !has_inverse(&placed.object_to_world) {
            return None;
        }
        if placed.id > StructureInstance::MOST_ID {
            tracing::warn!(
                "an instance is left out: the device takes ids up to {}",
                StructureInstance::MOST_ID
            );
            return None;
        }
        let bounds = mesh.bounds.transformed(&placed.object_to_world);
        let reach = bounds.min.abs().max(bounds.max.abs()).max_element();
        let instance = StructureInstance::new(
            placed.object_to_world,
            mesh.structure.address(),
            placed.id,
            placed.mask,
            mesh.kind as u32,
        );
        (reach <= LARGEST_COORDINATE).then_some((instance, bounds))
    }

    fn plan_top(&mut self, instances: &[StructureInstance], arena: &mut UploadArena) -> Result<(), GpuError> {
        let address = arena.push_table(instances)?.address;
        let count = instances.len() as u32;
        let sizes =
            self.gpu.structure_sizes(StructureInput::TopLevel { address, count }, StructureUse::Changing)?;
        if self.top.as_ref().is_none_or(|top| top.size() < sizes.structure) {
            let bytes = sizes.structure.next_power_of_two();
            self.top = Some(self.gpu.create_structure("world", true, bytes)?);
        }
        self.top_build = Some(TopBuild { address, count, scratch_bytes: sizes.build });
        Ok(())
    }

    /// Whether this frame has anything to record.
    pub(crate) fn has_work(&self) -> bool {
        self.top_build.is_some()
    }

    /// Records builds and copies of bottom levels, then the top level.
    pub(crate) fn record(&self, commands: &Commands<'_>) {
        let (Some(top), Some(top_build)) = (&self.top, &self.top_build) else {
            return;
        };
        self.compaction.record_copies(commands);
        let builds: Vec<_> = self.builds.iter().map(Build::as_structure_build).collect();
        commands.build_structures(&builds, &self.scratch);
        commands.memory_barrier(Access::BUILD_STRUCTURE, Access::BUILD_STRUCTURE);
        self.compaction.record_questions(commands, self.frame);
        let build = StructureBuild {
            target: top,
            input: StructureInput::TopLevel { address: top_build.address, count: top_build.count },
            structure_use: StructureUse::Changing,
            is_update: false,
            scratch_bytes: top_build.scratch_bytes,
        };
        commands.build_structures(&[build], &self.scratch);
    }
}

impl Build {
    fn as_structure_build(&self) -> StructureBuild<'_> {
        StructureBuild {
            target: &self.target,
            input: StructureInput::BottomLevel(&self.geometries),
            structure_use: self.structure_use,
            is_update: self.is_update,
            scratch_bytes: self.scratch_bytes,
        }
    }
}

impl Changing {
    /// Of a mesh that is built.
    fn new(input: &DriverInput<'_>) -> Self {
        Self { topology: input.topology, updates: 0, built_area: input.bounds.half_area() }
    }

    /// Of the mesh with other positions, which is updated or built anew.
    fn next(self, input: &DriverInput<'_>) -> Self {
        let has_grown = input.bounds.half_area() > MOST_GROWTH * self.built_area;
        match has_grown || self.updates >= MOST_UPDATES {
            true => Self::new(input),
            false => Self { updates: self.updates + 1, ..self },
        }
    }
}

fn has_inverse(rows: &[[f32; 4]; 3]) -> bool {
    let determinant = Mat3::from_cols_array_2d(&rows.map(|[x, y, z, _]| [x, y, z])).determinant();
    rows.as_flattened().iter().all(|value| value.is_finite()) && determinant != 0.0 && determinant.is_finite()
}
