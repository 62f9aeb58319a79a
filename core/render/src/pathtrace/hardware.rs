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
use super::structures::{Builder, Changing, MeshInput, Placed, TopLevel, longest_side};
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
    /// None if it lasts.
    updates: Option<Updates>,
}

/// How a mesh that does not last has changed since it was built.
#[derive(Debug, Clone, Copy)]
struct Updates {
    count: u32,
    /// Half the area of its box when it was built.
    built_area: f32,
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
    /// Those that rays can meet.
    meshes: HashMap<u64, Mesh>,
    frame: u64,
    builds: Vec<Build>,
    compaction: Compaction,
    top: Option<AccelerationStructure>,
    /// What the top level was built from.
    instances: Vec<StructureInstance>,
    top_build: Option<TopBuild>,
}

impl HardwareStructures {
    pub(crate) fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        Ok(Self {
            gpu: gpu.clone(),
            scratch: gpu.create_build_scratch(SCRATCH_BYTES)?,
            meshes: HashMap::new(),
            frame: 0,
            builds: Vec::new(),
            compaction: Compaction::default(),
            top: None,
            instances: Vec::new(),
            top_build: None,
        })
    }

    /// Plans the build of a mesh. None if it is more than the device takes.
    fn place(
        &mut self,
        content: u64,
        input: &DriverInput<'_>,
        changing: Option<&Changing<'_>>,
        arena: &mut UploadArena,
    ) -> Result<Option<Mesh>, GpuError> {
        let geometries = input.upload(arena)?;
        let is_lasting = changing.is_none();
        let structure_use = if is_lasting { StructureUse::Lasting } else { StructureUse::Changing };
        let sizes = match self.gpu.structure_sizes(StructureInput::BottomLevel(&geometries), structure_use) {
            Err(error @ GpuError::Invalid { .. }) => {
                tracing::warn!("a mesh is left out: {error}");
                return Ok(None);
            }
            other => other?,
        };
        let former = changing.and_then(|changing| self.meshes.remove(&changing.former?));
        let (structure, updates) = match former {
            Some(Mesh { structure, updates: Some(updates), .. }) => (structure, updates.next(input)),
            _ => {
                let structure = self.gpu.create_structure("mesh", false, sizes.structure)?;
                (Arc::new(structure), Updates::new(input))
            }
        };
        if is_lasting {
            self.compaction.note(content, &structure);
        }
        let is_update = updates.count > 0;
        self.builds.push(Build {
            target: structure.clone(),
            geometries,
            structure_use,
            is_update,
            scratch_bytes: if is_update { sizes.update } else { sizes.build },
        });
        let updates = (!is_lasting).then_some(updates);
        Ok(Some(Mesh { structure, bounds: input.bounds, kind: input.kind, updates }))
    }

    /// An instance as the device reads it, and its box; none where no ray can meet it.
    fn instance(&self, placed: &Placed) -> Option<(StructureInstance, Aabb)> {
        let mesh = self.meshes.get(&placed.content)?;
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
}

impl Builder for HardwareStructures {
    /// What can be made smaller will be.
    fn begin_frame(&mut self, _: &mut UploadArena) -> Result<(), GpuError> {
        self.frame += 1;
        self.builds.clear();
        self.top_build = None;
        self.compaction.begin_frame(&self.gpu, self.frame)?;
        for copy in &self.compaction.copies {
            if let Some(mesh) = self.meshes.get_mut(&copy.content) {
                mesh.structure = copy.to.clone();
            }
        }
        Ok(())
    }

    fn build(
        &mut self,
        content: u64,
        input: &MeshInput<'_>,
        changing: Option<&Changing<'_>>,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        let mesh = match (changing, DriverInput::new(&input.shapes).filter(|_| changing.is_none())) {
            (Some(changing), _) => self.place(content, &changing.input, Some(changing), arena)?,
            (None, Some(input)) => self.place(content, &input, None, arena)?,
            (None, None) => None,
        };
        self.meshes.extend(mesh.map(|mesh| (content, mesh)));
        Ok(())
    }

    fn is_met(&self, content: u64) -> bool {
        self.meshes.contains_key(&content)
    }

    fn free(&mut self, content: u64) {
        self.meshes.remove(&content);
    }

    /// Plans the top level of a frame, unless it is that of the last one.
    fn top_level(&mut self, placed: &[Placed], arena: &mut UploadArena) -> Result<TopLevel, GpuError> {
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

    fn has_work(&self) -> bool {
        self.top_build.is_some()
    }

    /// Records builds and copies of bottom levels, then the top level.
    fn record(&self, commands: &Commands<'_>) {
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

impl Updates {
    /// Of a mesh that is built.
    fn new(input: &DriverInput<'_>) -> Self {
        Self { count: 0, built_area: input.bounds.half_area() }
    }

    /// Of the mesh with other positions, which is updated or built anew.
    fn next(self, input: &DriverInput<'_>) -> Self {
        let has_grown = input.bounds.half_area() > MOST_GROWTH * self.built_area;
        match has_grown || self.count >= MOST_UPDATES {
            true => Self::new(input),
            false => Self { count: self.count + 1, ..self },
        }
    }
}

fn has_inverse(rows: &[[f32; 4]; 3]) -> bool {
    let determinant = Mat3::from_cols_array_2d(&rows.map(|[x, y, z, _]| [x, y, z])).determinant();
    rows.as_flattened().iter().all(|value| value.is_finite()) && determinant != 0.0 && determinant.is_finite()
}
