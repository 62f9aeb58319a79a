//! What declaring and compiling a frame costs: prints nanoseconds a pass for frames of growing
//! size, which must stay level, since every phase is linear.
//!
//! The frame is that of a program that draws and then copies the picture to a texture, over and
//! over: every other pass is a run of draws, every other a copy.

use std::hint::black_box;
use std::time::{Duration, Instant};

use afterglow_frame_graph::{
    Access, Format, GraphBuilder, GraphError, ImageDesc, PassKind, ResourceDesc, ResourceId, ResourceState,
};

const TEXTURES: usize = 256;

fn declare(passes: usize) -> GraphBuilder {
    let mut graph = GraphBuilder::new();
    let size = (1280, 720);
    let drawn = ResourceState::after(Access::ColorAttachment);
    let color = graph.import("color", ImageDesc::flat(size, Format::Rgba8Unorm), drawn);
    let depth = graph.transient("depth", ImageDesc::flat(size, Format::D32Float));
    let vertices = ResourceDesc::Buffer { bytes: 1 << 20 };
    let vertices = graph.import("vertices", vertices, ResourceState::SETTLED);
    let sampled = ResourceState::after(Access::SampledFragment);
    let texture = ImageDesc::flat((256, 256), Format::Rgba8Unorm);
    let textures: Vec<ResourceId> =
        (0..TEXTURES).map(|_| graph.import("texture", texture, sampled)).collect();
    graph.output(color);
    textures.iter().for_each(|texture| graph.output(*texture));

    graph
        .pass("clear", PassKind::Graphics)
        .write(color, Access::ColorAttachment)
        .write(depth, Access::DepthAttachment);
    for index in 1..passes {
        if index % 2 == 0 {
            graph
                .pass("copy-texture", PassKind::Transfer)
                .read(color, Access::TransferSrc)
                .read_write(textures[index % TEXTURES], Access::TransferDst);
            continue;
        }
        let mut pass = graph.pass("draw", PassKind::Graphics);
        pass.read(vertices, Access::VertexRead)
            .read(vertices, Access::IndexRead)
            .read_write(color, Access::ColorAttachment)
            .read_write(depth, Access::DepthAttachment);
        for offset in 0..4 {
            pass.read(textures[(index * 7 + offset) % TEXTURES], Access::SampledFragment);
        }
    }
    graph
}

/// The shortest times of declaring and compiling, and the number of barriers.
fn measure(passes: usize) -> Result<(Duration, Duration, usize), GraphError> {
    let mut shortest = (Duration::MAX, Duration::MAX);
    let mut barriers = 0;
    for _ in 0..(2_000_000 / passes).clamp(5, 2_000) {
        let start = Instant::now();
        let graph = black_box(declare(passes));
        let declared = start.elapsed();
        let graph = black_box(graph.compile()?);
        let compiled = start.elapsed() - declared;
        shortest = (shortest.0.min(declared), shortest.1.min(compiled));
        barriers = graph.barriers().len();
    }
    Ok((shortest.0, shortest.1, barriers))
}

fn main() -> Result<(), GraphError> {
    println!("passes  barriers  declare ns/pass  compile ns/pass");
    for passes in [10, 100, 1_000, 10_000, 100_000] {
        let (declare, compile, barriers) = measure(passes)?;
        let each = |time: Duration| time.as_secs_f64() * 1e9 / passes as f64;
        println!("{passes:6} {barriers:9} {:16.1} {:16.1}", each(declare), each(compile));
    }
    Ok(())
}
