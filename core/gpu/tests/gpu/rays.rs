//! Acceleration structures and ray-tracing pipelines: a row of rays that go down in -z, a unit apart in x.

use afterglow_gpu::{
    AccelerationStructure, Access, Buffer, BufferDesc, BufferKind, BuildScratch, Gpu, HitGroup, RayPipeline,
    RayPipelineDesc, STRUCTURE_INPUT, StructureBuild, StructureGeometry, StructureInput, StructureInstance,
    StructureShape, StructureUse,
};

use crate::support::{CheckedGpu, compile};

const RAYS: u32 = 4;
const IDENTITY: [[f32; 4]; 3] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

const HEAD: &str = r"
#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
";
const GENERATION: &str = r"
layout(buffer_reference, scalar) buffer Hits { vec4 entries[]; };
layout(push_constant, scalar) uniform Push { uint64_t world; uint64_t target; } push;
layout(location = 0) rayPayloadEXT vec4 met;
void main() {
    vec3 origin = vec3(float(gl_LaunchIDEXT.x) + 0.25, 0.25, 1.0);
    traceRayEXT(accelerationStructureEXT(push.world), 0u, 0xff, 0u, 0u, 0u, origin, 0.0, vec3(0.0, 0.0, -1.0), 100.0, 0);
    Hits(push.target).entries[gl_LaunchIDEXT.x] = met;
}";
const MISS: &str = r"
layout(location = 0) rayPayloadInEXT vec4 met;
void main() { met = vec4(-1.0); }";
const CLOSEST: &str = r"
layout(location = 0) rayPayloadInEXT vec4 met;
hitAttributeEXT vec2 barycentrics;
void main() {
    int place = gl_InstanceCustomIndexEXT * 100 + gl_GeometryIndexEXT * 10 + gl_PrimitiveID;
    met = vec4(gl_HitTEXT, float(place), gl_HitKindEXT == gl_HitKindFrontFacingTriangleEXT ? 1.0 : 0.0, barycentrics.x);
}";
/// Lets every ray through that meets the first triangle of a geometry.
const ANY: &str = r"
hitAttributeEXT vec2 barycentrics;
void main() { if (gl_PrimitiveID == 0) ignoreIntersectionEXT; }";
/// Meets every box at half its depth.
const MIDDLE: &str = r"
hitAttributeEXT vec2 barycentrics;
void main() { barycentrics = vec2(0.5); reportIntersectionEXT(1.5, 1u); }";

#[derive(Clone, Copy, bytemuck::NoUninit)]
#[repr(C)]
struct Push {
    world: u64,
    target: u64,
}

/// What a ray met: t, 100 instance + 10 geometry + primitive, whether it faced the ray, the first barycentric.
type Met = [f32; 4];

/// A device that traces, a pipeline, and what was built.
struct Stage {
    pipeline: RayPipeline,
    scratch: BuildScratch,
    target: Buffer,
    inputs: Vec<Buffer>,
    structures: Vec<AccelerationStructure>,
    gpu: CheckedGpu,
}

impl Stage {
    fn new() -> Self {
        let gpu = CheckedGpu::new();
        let shader = |stage, body: &str| compile(stage, &format!("{HEAD}{body}"));
        let (closest, any, middle) = (shader("rchit", CLOSEST), shader("rahit", ANY), shader("rint", MIDDLE));
        let triangles = HitGroup { closest_hit: Some(&closest), any_hit: Some(&any), intersection: None };
        let boxes = HitGroup { closest_hit: Some(&closest), any_hit: None, intersection: Some(&middle) };
        let pipeline = gpu
            .create_ray_pipeline(&RayPipelineDesc {
                name: "rays",
                ray_generation: &shader("rgen", GENERATION),
                miss: &shader("rmiss", MISS),
                hits: &[triangles, boxes],
                push_constant_bytes: size_of::<Push>() as u32,
                set_layouts: &[],
                specialization: &[],
            })
            .unwrap();
        let scratch = gpu.create_build_scratch(1 << 10).unwrap();
        let desc = BufferDesc::new("target", BufferKind::Device, u64::from(RAYS) * 16);
        let target = gpu.create_buffer(&desc).unwrap();
        Self { pipeline, scratch, target, inputs: Vec::new(), structures: Vec::new(), gpu }
    }

    fn upload<T: bytemuck::NoUninit>(&mut self, input: &[T]) -> u64 {
        let bytes: &[u8] = bytemuck::cast_slice(input);
        let bytes = if bytes.is_empty() { &[0; 4] } else { bytes };
        self.inputs.push(self.gpu.upload_buffer("input", STRUCTURE_INPUT, bytes).unwrap());
        self.inputs.last().unwrap().address()
    }

    fn triangles(&mut self, corners: &[[f32; 3]], is_opaque: bool) -> StructureGeometry {
        let (shape, count) = (StructureShape::Triangles, corners.len() as u32 / 3);
        StructureGeometry { shape, address: self.upload(corners), count, is_opaque }
    }

    /// Builds structures in one go. Returns the number of the first.
    fn build(&mut self, inputs: &[(StructureInput<'_>, StructureUse)]) -> usize {
        let first = self.structures.len();
        let mut scratch = Vec::new();
        for (input, structure_use) in inputs {
            let sizes = self.gpu.structure_sizes(*input, *structure_use).unwrap();
            let is_top_level = matches!(input, StructureInput::TopLevel { .. });
            self.structures.push(self.gpu.create_structure("test", is_top_level, sizes.structure).unwrap());
            scratch.push(sizes.build);
        }
        self.scratch.reserve(scratch.iter().copied()).unwrap();
        let builds: Vec<_> = inputs
            .iter()
            .zip(&self.structures[first..])
            .zip(scratch)
            .map(|(((input, structure_use), target), scratch_bytes)| StructureBuild {
                target,
                input: *input,
                structure_use: *structure_use,
                is_update: false,
                scratch_bytes,
            })
            .collect();
        self.gpu.run(|commands| commands.build_structures(&builds, &self.scratch)).unwrap();
        first
    }

    fn bottom(&mut self, geometries: &[StructureGeometry], structure_use: StructureUse) -> usize {
        self.build(&[(StructureInput::BottomLevel(geometries), structure_use)])
    }

    fn address(&self, structure: usize) -> u64 {
        self.structures[structure].address()
    }

    /// Traces instances.
    fn trace(&mut self, instances: &[StructureInstance]) -> Vec<Met> {
        let (address, count) = (self.upload(instances), instances.len() as u32);
        let top = self.build(&[(StructureInput::TopLevel { address, count }, StructureUse::Changing)]);
        let push = Push { world: self.address(top), target: self.target.address() };
        self.gpu
            .run(|commands| {
                commands.memory_barrier(Access::BUILD_STRUCTURE, Access::TRACE_STRUCTURE);
                commands.memory_barrier(Access::TRANSFER_READ, Access::TRACE_READ_WRITE);
                commands.trace_rays(&self.pipeline, &[], &push, [RAYS, 1]);
                commands.memory_barrier(Access::TRACE_READ_WRITE, Access::TRANSFER_READ);
            })
            .unwrap();
        bytemuck::cast_slice(&self.gpu.download_buffer(&self.target).unwrap()).to_vec()
    }
}

/// A triangle in the plane of a z that the ray of this number meets; its corners run counter-clockwise as seen from above.
fn triangle(ray: f32, z: f32) -> [[f32; 3]; 3] {
    [[ray, 0.0, z], [ray + 1.0, 0.0, z], [ray, 1.0, z]]
}

fn at(address: u64, id: u32) -> StructureInstance {
    StructureInstance::new(IDENTITY, address, id, 0xff, 0)
}

#[test]
fn a_hit_says_where_it_is() {
    let mut stage = Stage::new();
    let mut reversed = triangle(1.0, 0.0);
    reversed.swap(1, 2);
    let first = stage.triangles(&[triangle(0.0, 0.0), reversed].concat(), true);
    // Its first triangle is a hole; behind it is another.
    let second =
        stage.triangles(&[triangle(2.0, 0.5), triangle(2.0, 0.0), triangle(3.0, 0.0)].concat(), false);
    let bottom = stage.bottom(&[first, second], StructureUse::Lasting);
    let address = stage.address(bottom);
    let met = stage.trace(&[at(address, 7)]);
    assert_eq!(
        met,
        [[1.0, 700.0, 1.0, 0.25], [1.0, 701.0, 0.0, 0.25], [1.0, 711.0, 1.0, 0.25], [1.0, 712.0, 1.0, 0.25]]
    );
    // Moved by a unit: the first ray meets nothing.
    let rows = [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, -1.0]];
    let met = stage.trace(&[StructureInstance::new(rows, address, 1, 0xff, 0)]);
    assert_eq!(met[0], [-1.0; 4]);
    assert_eq!(met[1], [2.0, 100.0, 1.0, 0.25]);
}

#[test]
fn shaders_of_their_own_meet_boxes() {
    let mut stage = Stage::new();
    let boxes = [0.0_f32, 2.0].map(|x| [[x, 0.0, -1.0], [x + 1.0, 1.0, 0.0]]);
    let address = stage.upload(&boxes);
    let geometry = StructureGeometry { shape: StructureShape::Boxes, address, count: 2, is_opaque: true };
    let bottom = stage.bottom(&[geometry], StructureUse::Lasting);
    let met = stage.trace(&[StructureInstance::new(IDENTITY, stage.address(bottom), 2, 0xff, 1)]);
    assert_eq!(met, [[1.5, 200.0, 0.0, 0.5], [-1.0; 4], [1.5, 201.0, 0.0, 0.5], [-1.0; 4]]);
}

#[test]
fn what_is_empty_inactive_or_without_area_is_not_met() {
    let mut stage = Stage::new();
    assert_eq!(stage.trace(&[]), [[-1.0; 4]; RAYS as usize]);
    let mut inactive = triangle(0.0, 0.0);
    inactive[0][0] = f32::NAN;
    let point = [[0.25, 0.25, 0.0]; 3];
    let line = [[0.0, 0.25, 0.0], [1.0, 0.25, 0.0], [0.5, 0.25, 0.0]];
    let there = [1.0, 2.0, 3.0].map(|ray| triangle(ray, 0.0));
    let none = stage.triangles(&[], true);
    let all = stage.triangles(&inactive, true);
    let some = stage.triangles(&[point, there[0], point, line, there[1], there[2], line].concat(), true);
    let geometries: [&[StructureGeometry]; 4] = [&[none], &[some], &[all], &[]];
    let inputs =
        geometries.map(|geometries| (StructureInput::BottomLevel(geometries), StructureUse::Lasting));
    let first = stage.build(&inputs);
    let instances: Vec<_> = (0..4).map(|index| at(stage.address(first + index), index as u32)).collect();
    let numbers: Vec<_> = stage.trace(&instances).iter().map(|met| met[1]).collect();
    assert_eq!(numbers, [-1.0, 101.0, 104.0, 105.0]);
}

#[test]
fn an_update_moves_triangles() {
    let mut stage = Stage::new();
    let corners = |z| [triangle(0.0, z), triangle(1.0, 0.0)].concat();
    let geometry = stage.triangles(&corners(0.0), true);
    let bottom = stage.bottom(&[geometry], StructureUse::Changing);
    let address = stage.address(bottom);
    assert_eq!(stage.trace(&[at(address, 0)])[0][0], 1.0);
    let moved = [stage.triangles(&corners(-3.0), true)];
    let input = StructureInput::BottomLevel(&moved);
    let sizes = stage.gpu.structure_sizes(input, StructureUse::Changing).unwrap();
    stage.scratch.reserve([sizes.update].into_iter()).unwrap();
    let update = StructureBuild {
        target: &stage.structures[bottom],
        input,
        structure_use: StructureUse::Changing,
        is_update: true,
        scratch_bytes: sizes.update,
    };
    stage.gpu.run(|commands| commands.build_structures(&[update], &stage.scratch)).unwrap();
    let met = stage.trace(&[at(address, 0)]);
    assert_eq!((met[0][0], met[1][0]), (4.0, 1.0));
}

#[test]
fn what_lasts_is_compacted() {
    let mut stage = Stage::new();
    let corners: Vec<_> = (0..500).flat_map(|i| triangle(i as f32, 0.0)).collect();
    let geometry = stage.triangles(&corners, true);
    let bottom = stage.bottom(&[geometry], StructureUse::Lasting);
    let sizes = stage.gpu.create_compacted_sizes(1).unwrap();
    stage.gpu.run(|commands| commands.write_compacted_sizes(&sizes, &[&stage.structures[bottom]])).unwrap();
    let bytes = sizes.get().unwrap().unwrap()[0];
    assert!((1..=stage.structures[bottom].size()).contains(&bytes));
    let small = stage.gpu.create_structure("compacted", false, bytes).unwrap();
    stage.gpu.run(|commands| commands.compact_structure(&stage.structures[bottom], &small)).unwrap();
    let address = small.address();
    stage.structures.push(small);
    let met = stage.trace(&[at(address, 0)]);
    assert_eq!(met.iter().map(|met| met[1]).collect::<Vec<_>>(), [0.0, 1.0, 2.0, 3.0]);
}

#[test]
fn many_builds_go_in_chunks() {
    let mut stage = Stage::new();
    let geometries: Vec<_> =
        (0..40).map(|i| [stage.triangles(&triangle((i % 4) as f32, -(i as f32)), true)]).collect();
    let inputs: Vec<_> = geometries
        .iter()
        .map(|geometry| (StructureInput::BottomLevel(geometry), StructureUse::Lasting))
        .collect();
    let first = stage.build(&inputs);
    let instances: Vec<_> = (0..40).map(|i| at(stage.address(first + i), i as u32)).collect();
    let met = stage.trace(&instances);
    assert_eq!(met.iter().map(|met| met[1]).collect::<Vec<_>>(), [0.0, 100.0, 200.0, 300.0]);
}

#[test]
fn more_than_the_device_takes_is_refused() {
    let gpu: &Gpu = &CheckedGpu::new();
    let most = gpu.ray_tracing().unwrap().instances;
    let input = StructureInput::TopLevel { address: 0, count: u32::MAX };
    assert_eq!(gpu.structure_sizes(input, StructureUse::Lasting).is_err(), most < u64::from(u32::MAX));
}
