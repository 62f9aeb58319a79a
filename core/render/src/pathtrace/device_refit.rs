//! Bottom levels of the software backend that change, moved by the device: it gets the triangles' new corners and writes the
//! records and nodes of a structure that stays where it is, as [`Blas::refit`] would.
//!
//! What rays through a moved structure cost comes back some frames later, always as many; from then on it is built anew
//! if that is too much.

use std::collections::VecDeque;

use afterglow_bvh::Blas;
use afterglow_bvh::layout::WIDTH;
use afterglow_gpu::{
    Access, Buffer, BufferDesc, BufferKind, Commands, ComputeDesc, ComputePipeline, Gpu, GpuError,
};
use afterglow_records::RefitPush;
use afterglow_shaders as shaders;

use super::compaction::FRAMES_IN_FLIGHT;
use super::refit::{MOST_COST, cost, triangle_of};
use super::slabs::Part;
use super::staging::Staging;
use super::structures::Member;
use crate::uploads::UploadArena;

/// Meshes of fewer triangles are moved by the processor.
pub(super) const LEAST_TRIANGLES: usize = 4096;
/// Threads of a workgroup.
const GROUP: u32 = 64;
/// Bytes of a node's cost.
const COST_BYTES: u64 = 4;
/// Refits of a frame; more meshes are moved by the processor.
const MOST_REFITS: usize = 256;

/// What the device needs beside a structure to move it.
pub(super) struct DeviceTree {
    /// Of each leaf record the number of its triangle.
    sources: Part,
    /// Nodes by their levels.
    order: Part,
    /// Nodes of each level, the deepest first.
    levels: Vec<u32>,
    nodes: u32,
    records: u32,
    built_cost: f32,
    /// Refits whose costs are not known yet: the frame, which of the frame's it was, and half the area of the box.
    asked: VecDeque<(u64, usize, f32)>,
}

impl DeviceTree {
    /// Of a structure that was built.
    pub(super) fn new(
        blas: &Blas,
        members: &[Member],
        staging: &mut Staging,
        arena: &mut UploadArena,
    ) -> Result<Self, GpuError> {
        let of = triangle_of(members);
        let sources: Vec<u32> = blas.triangles().iter().map(|record| of(record.primitive)).collect();
        let levels = blas.levels();
        Ok(Self {
            sources: staging.bring(bytemuck::cast_slice(&sources), arena)?,
            order: staging.bring(bytemuck::cast_slice(&levels.order), arena)?,
            levels: levels.counts,
            nodes: blas.node_count,
            records: sources.len() as u32,
            built_cost: cost(blas),
            asked: VecDeque::new(),
        })
    }

    /// Gives its memory back.
    pub(super) fn free(self, staging: &mut Staging) {
        staging.free(self.sources);
        staging.free(self.order);
    }
}

/// A structure that this frame moves.
struct Refit {
    push: RefitPush,
    levels: Vec<u32>,
    records: u32,
}

/// Moves structures.
pub(super) struct Refitter {
    records: ComputePipeline,
    nodes: ComputePipeline,
    /// Where the device writes costs, of some frames one after another.
    costs: [Buffer; FRAMES_IN_FLIGHT as usize + 1],
    frame: u64,
    refits: Vec<Refit>,
}

impl Refitter {
    /// # Errors
    /// If the device fails.
    pub(super) fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let pipeline = |name, spirv| {
            gpu.create_compute_pipeline(&ComputeDesc {
                name,
                spirv: shaders::current(spirv),
                entry: c"main",
                specialization: &[],
                set_layouts: &[],
                push_constant_bytes: size_of::<RefitPush>() as u32,
            })
        };
        let bytes = 4 * MOST_REFITS as u64;
        let costs = || gpu.create_buffer(&BufferDesc::new("refit costs", BufferKind::Readback, bytes));
        Ok(Self {
            records: pipeline("refit records", shaders::REFIT_RECORDS_COMP)?,
            nodes: pipeline("refit nodes", shaders::REFIT_NODES_COMP)?,
            costs: [costs()?, costs()?, costs()?, costs()?],
            frame: 0,
            refits: Vec::new(),
        })
    }

    /// A new frame begins.
    pub(super) fn begin_frame(&mut self) {
        self.frame += 1;
        self.refits.clear();
    }

    /// Moves the structure at an address to three corners a triangle, whose box has half that area. Says whether it will be: not
    /// if rays have got too slow.
    pub(super) fn moves(
        &mut self,
        tree: &mut DeviceTree,
        structure: u64,
        corners: &[[f32; 3]],
        half_area: f32,
        staging: &mut Staging,
        arena: &mut UploadArena,
    ) -> Result<bool, GpuError> {
        let number = self.refits.len();
        if number >= MOST_REFITS || self.is_slow(tree)? {
            return Ok(false);
        }
        tree.asked.push_back((self.frame, number, half_area));
        let push = RefitPush {
            structure,
            sources: tree.sources.address,
            corners: arena.push(bytemuck::cast_slice(corners))?.address,
            order: tree.order.address,
            costs: staging.scratch(u64::from(tree.nodes) * COST_BYTES)?,
            answer: self.costs[ring(self.frame)].address() + 4 * number as u64,
            nodes: tree.nodes,
            first: 0,
            count: 0,
            padding: 0,
        };
        self.refits.push(Refit { push, levels: tree.levels.clone(), records: tree.records });
        Ok(true)
    }

    /// Whether a refit, as many frames ago as it takes to know, has made rays slow.
    fn is_slow(&self, tree: &mut DeviceTree) -> Result<bool, GpuError> {
        while let Some((frame, number, half_area)) = tree.asked.front().copied() {
            if frame + FRAMES_IN_FLIGHT > self.frame {
                break;
            }
            tree.asked.pop_front();
            // Older answers are written over.
            if frame + FRAMES_IN_FLIGHT == self.frame {
                let mut bytes = [0; 4];
                self.costs[ring(frame)].read(4 * number as u64, &mut bytes)?;
                // What is not a number fails the comparison.
                let is_fast = f32::from_le_bytes(bytes) / half_area <= MOST_COST * tree.built_cost;
                return Ok(!is_fast);
            }
        }
        Ok(false)
    }

    /// Whether this frame moves anything.
    pub(super) fn has_work(&self) -> bool {
        !self.refits.is_empty()
    }

    /// Records this frame's refits: all records, then of all structures the deepest levels, and so on.
    pub(super) fn record(&self, commands: &Commands<'_>) {
        for refit in &self.refits {
            self.run(commands, &self.records, refit, 0, refit.records, 1);
        }
        let deepest = self.refits.iter().map(|refit| refit.levels.len()).max().unwrap_or(0);
        for level in 0..deepest {
            commands.memory_barrier(Access::COMPUTE_WRITE, Access::COMPUTE_READ_WRITE);
            for refit in &self.refits {
                if let Some(&count) = refit.levels.get(level) {
                    let first = refit.levels[..level].iter().sum();
                    self.run(commands, &self.nodes, refit, first, count, WIDTH as u32);
                }
            }
        }
        commands.memory_barrier(Access::COMPUTE_WRITE, Access::HOST_READ);
    }

    /// `threads`: of each of so many records or nodes.
    fn run(
        &self,
        commands: &Commands<'_>,
        pipeline: &ComputePipeline,
        refit: &Refit,
        first: u32,
        count: u32,
        threads: u32,
    ) {
        let push = RefitPush { first, count, ..refit.push };
        commands.compute(pipeline, &[], &push, [count.div_ceil(GROUP / threads), 1, 1]);
    }
}

/// Which of the buffers of costs is a frame's.
fn ring(frame: u64) -> usize {
    (frame % (FRAMES_IN_FLIGHT + 1)) as usize
}

#[cfg(test)]
mod tests {
    use super::super::meshes::of_triangles;
    use super::super::refit::Movable;
    use super::*;
    use crate::testing::{assert_valid, gpu};
    use afterglow_bvh::room::room;
    use afterglow_bvh::{Aabb, Quality};
    use glam::Vec3;
    use std::time::Instant;

    /// Corners of a room that waves, its coordinates as many times as large.
    fn corners(cells: u32, phase: f32, scale: f32) -> Vec<[f32; 3]> {
        let (positions, indices) = room(cells);
        let moved = |index: &u32| {
            let at = Vec3::from(positions[*index as usize]);
            // Both zeros and very small numbers come among them.
            let aside = Vec3::new((at.y + phase).sin(), 0.0, 1e-30 * at.x * phase);
            ((at * Vec3::new(1.0, -1.0, 1.0) + aside) * scale).to_array()
        };
        indices.iter().flatten().map(moved).collect()
    }

    fn members(corners: &[[f32; 3]]) -> Vec<Member> {
        let triangles = (corners.len() / 3) as u32;
        let first = triangles / 3;
        [first, triangles - first].map(|triangles| Member { triangles, is_alpha_tested: false }).to_vec()
    }

    fn half_area(corners: &[[f32; 3]]) -> f32 {
        let corners: Vec<_> = corners.iter().map(|corner| Vec3::from(*corner)).collect();
        Aabb::around(&corners).half_area()
    }

    /// A structure on the device, and what moves it.
    struct Subject {
        gpu: Gpu,
        staging: Staging,
        arena: UploadArena,
        refitter: Refitter,
        structure: Part,
        tree: DeviceTree,
    }

    impl Subject {
        fn new(blas: &Blas, members: &[Member]) -> Self {
            let gpu = gpu();
            let mut staging = Staging::new(&gpu, "meshes", 1 << 20);
            let mut arena = UploadArena::new(&gpu);
            let structure = staging.bring(bytemuck::cast_slice(&blas.words), &mut arena).unwrap();
            let tree = DeviceTree::new(blas, members, &mut staging, &mut arena).unwrap();
            gpu.run(|commands| staging.record(commands)).unwrap();
            let refitter = Refitter::new(&gpu).unwrap();
            Self { gpu, staging, arena, refitter, structure, tree }
        }

        /// A frame that moves it. Returns whether it was, and the seconds that the processor and then the device took.
        fn move_to(&mut self, corners: &[[f32; 3]]) -> (bool, [f64; 2]) {
            self.arena.reset();
            self.staging.begin_frame();
            self.refitter.begin_frame();
            let Self { gpu, staging, arena, refitter, structure, tree } = self;
            let (area, asked) = (half_area(corners), Instant::now());
            let is_moved = refitter.moves(tree, structure.address, corners, area, staging, arena).unwrap();
            let begun = Instant::now();
            gpu.run(|commands| refitter.record(commands)).unwrap();
            (is_moved, [(begun - asked).as_secs_f64(), begun.elapsed().as_secs_f64()])
        }
    }

    #[test]
    fn the_device_moves_structures_as_the_processor_does() {
        for (cells, scale) in [(1, 1.0), (9, 1e-3), (30, 1.0), (30, 1e9)] {
            let still = corners(cells, 0.0, scale);
            let members = members(&still);
            let blas = of_triangles(&still, &members, Quality::Fast).unwrap();
            let mut subject = Subject::new(&blas, &members);
            let mut twin = Movable::new(blas);
            for phase in [0.2, 0.5, 0.3] {
                let moved = corners(cells, phase, scale);
                assert!(subject.move_to(&moved).0);
                twin = twin.moved(&moved, &members).unwrap();
                let words = subject.staging.read(&subject.gpu, &subject.structure);
                let same = twin.blas.words.iter().zip(&words).take_while(|(one, other)| one == other);
                assert_eq!(same.count(), twin.blas.words.len(), "{cells} cells, {scale} times, {phase}");
                assert_eq!(twin.blas.bounds.half_area(), half_area(&moved));
            }
        }
        assert_valid();
    }

    #[test]
    fn what_rays_get_slow_through_is_said_some_frames_later() {
        let still = corners(12, 0.0, 1.0);
        let members = members(&still);
        let blas = of_triangles(&still, &members, Quality::Fast).unwrap();
        let mut subject = Subject::new(&blas, &members);
        let triangles = still.len() / 3;
        let shuffled: Vec<_> = (0..triangles)
            .flat_map(|number| still[3 * (number * 7919 % triangles)..][..3].to_vec())
            .collect();
        let frames = [&still, &still, &shuffled, &still, &still, &still, &still];
        let moved: Vec<_> = frames.map(|corners| subject.move_to(corners).0).to_vec();
        assert_eq!(moved, [true, true, true, true, true, false, true]);
    }

    #[test]
    fn what_the_device_takes_is_measured() {
        let still = corners(100, 0.0, 1.0);
        let members = members(&still);
        let blas = of_triangles(&still, &members, Quality::Fast).unwrap();
        let mut subject = Subject::new(&blas, &members);
        let mut twin = Movable::new(blas);
        let [mut asking, mut device, mut processor] = [f64::INFINITY; 3];
        for frame in 0..5 {
            let moved = corners(100, 0.02 * frame as f32, 1.0);
            let (is_moved, [asked, took]) = subject.move_to(&moved);
            assert!(is_moved);
            (asking, device) = (asking.min(asked), device.min(took));
            let begun = Instant::now();
            twin = twin.moved(&moved, &members).unwrap();
            subject.staging.bring(bytemuck::cast_slice(&twin.blas.words), &mut subject.arena).unwrap();
            processor = processor.min(begun.elapsed().as_secs_f64());
        }
        let rate = |seconds: f64| still.len() as f64 / 3e6 / seconds;
        println!(
            "{} triangles: {:.1} Mtriangles/s by the device, for which the processor writes {:.1}; {:.1} by the processor",
            still.len() / 3,
            rate(device),
            rate(asking),
            rate(processor)
        );
        // What frames are spared: to the processor a moved mesh is so many corners.
        assert!(asking < 0.8 * processor);
    }
}
