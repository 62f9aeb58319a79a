//! Rays a second through closed rooms of 1k, 30k and 300k triangles, the two-level BVH against a plain
//! binary one; memory and build speed besides.
//!
//! `cargo run --release -p afterglow-bvh --example rays [WIDTH HEIGHT]`, on lavapipe unless
//! `AFTERGLOW_DEVICE` names another device.

mod binary;
#[path = "../../tests/support/gpu.rs"]
mod gpu;
#[path = "../../tests/support/room.rs"]
mod room;

use afterglow_bvh::{Blas, IDENTITY, Instance, Quality, build_blas, build_tlas};
use glam::Vec3;
use gpu::{Answer, RayRecord, Search, Tracer};
use std::time::Instant;

type Mesh = (Vec<[f32; 3]>, Vec<[u32; 3]>);

fn main() {
    let sizes: Vec<u32> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let (width, height) = match sizes[..] {
        [width, height] => (width, height),
        _ => (320, 184),
    };
    let gpu = gpu::open();
    println!("{}, {width}x{height} rays", gpu.info().name);
    let wide = Tracer::new(&gpu, "tests/shaders/trace_opaque.comp");
    let plain = Tracer::new(&gpu, "examples/rays/binary.comp");
    for cells in [6, 37, 119] {
        let mesh = room::room(cells);
        let blas = build_and_report(&mesh);
        let primary = camera_rays(width, height);
        let primary_answers = trace_wide(&wide, &blas, &primary, "primary", false);
        let bounce = bounce_rays(&mesh, &primary, &primary_answers);
        trace_wide(&wide, &blas, &bounce, "bounce", false);
        let shadow = shadow_rays(&mesh, &primary, &primary_answers);
        trace_wide(&wide, &blas, &shadow, "shadow", true);

        let words = binary::build(&mesh.0, &mesh.1);
        for (rays, name, any_hit) in
            [(&primary, "primary", false), (&bounce, "bounce", false), (&shadow, "shadow", true)]
        {
            let buffer = plain.upload(&words);
            measure(&plain, buffer.address(), rays, &format!("binary {name}"), any_hit);
        }
    }
}

/// Builds both qualities and says how fast and how large.
fn build_and_report((positions, indices): &Mesh) -> Blas {
    let count = indices.len() as f64;
    println!("{count} triangles");
    let mut built = None;
    for quality in [Quality::Fast, Quality::Good] {
        let start = Instant::now();
        let blas = build_blas(positions, indices, quality).expect("the room is small");
        let seconds = start.elapsed().as_secs_f64();
        println!(
            "  build {quality:?}: {:.2} Mtriangles/s, {:.1} bytes a triangle ({:.1} of nodes), {} levels",
            count / seconds * 1e-6,
            blas.size_bytes() as f64 / count,
            f64::from(blas.node_count) * 80.0 / count,
            blas.depth
        );
        built = Some(blas);
    }
    built.expect("two builds")
}

fn trace_wide(tracer: &Tracer, blas: &Blas, rays: &[RayRecord], name: &str, any_hit: bool) -> Vec<Answer> {
    let bottom = tracer.upload(&blas.words);
    let instance = Instance {
        object_to_world: IDENTITY,
        blas: bottom.address(),
        bounds: blas.bounds,
        id: 0,
        mask: 1,
        flags: 0,
    };
    let tlas = build_tlas(&[instance]).expect("one instance");
    let top = tracer.upload(&tlas.words);
    measure(tracer, top.address(), rays, &format!("wide {name}"), any_hit)
}

/// Traces often enough to take a while, and prints the speed.
fn measure(tracer: &Tracer, address: u64, rays: &[RayRecord], name: &str, any_hit: bool) -> Vec<Answer> {
    let search = Search { mask: 1, any_hit };
    let (answers, once) = tracer.trace(address, rays, search, 1);
    let rounds = (0.5 / once).clamp(3.0, 1000.0) as u32;
    let before = processor_seconds();
    let (_, seconds) = tracer.trace(address, rays, search, rounds);
    let processor = processor_seconds() - before;
    let total = rays.len() as f64 * f64::from(rounds) * 1e-6;
    let hits = answers.iter().filter(|answer| answer.found()).count();
    let share = 100.0 * hits as f64 / rays.len() as f64;
    println!(
        "  {name:15} {:9.2} Mrays/s, {:6.2} a processor-second, {share:.2} % hit",
        total / seconds,
        total / processor * (f64::from(rounds) + 1.0) / f64::from(rounds),
    );
    answers
}

/// Time of all threads of this process, in ticks of 10 ms.
fn processor_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = text.rsplit(')').next().unwrap_or_default();
    let ticks = |field: usize| -> f64 {
        fields.split_whitespace().nth(field).and_then(|f| f.parse().ok()).unwrap_or(f64::NAN)
    };
    (ticks(11) + ticks(12)) / 100.0
}

fn ray(origin: Vec3, direction: Vec3, t_max: f32) -> RayRecord {
    RayRecord { origin: origin.to_array(), t_min: 1e-4, direction: direction.to_array(), t_max }
}

/// Pixel of ray `index`: tiles of 8x8.
fn pixel(index: u32, width: u32) -> (u32, u32) {
    let (tile, inside) = (index / 64, index % 64);
    let across = width / 8;
    (tile % across * 8 + inside % 8, tile / across * 8 + inside / 8)
}

fn camera_rays(width: u32, height: u32) -> Vec<RayRecord> {
    (0..(width / 8) * (height / 8) * 64)
        .map(|index| {
            let (x, y) = pixel(index, width);
            let u = (x as f32 + 0.5) / width as f32 * 2.0 - 1.0;
            let v = (y as f32 + 0.5) / height as f32 * 2.0 - 1.0;
            let aspect = height as f32 / width as f32;
            let direction = Vec3::new(u, -v * aspect - 0.15, -1.0).normalize();
            ray(Vec3::new(0.5, 0.0, 9.0), direction, f32::INFINITY)
        })
        .collect()
}

/// Point of a hit, just off the surface, and the normal towards the ray.
fn surface((positions, indices): &Mesh, ray: &RayRecord, answer: &Answer) -> (Vec3, Vec3) {
    let [a, b, c] = indices[answer.primitive as usize].map(|corner| Vec3::from(positions[corner as usize]));
    let direction = Vec3::from(ray.direction);
    let normal = (b - a).cross(c - a).normalize();
    let normal = if normal.dot(direction) < 0.0 { normal } else { -normal };
    let [u, v] = answer.barycentrics;
    (a + (b - a) * u + (c - a) * v + normal * 1e-4, normal)
}

/// Cosine-distributed, one a pixel.
fn bounce_rays(mesh: &Mesh, rays: &[RayRecord], answers: &[Answer]) -> Vec<RayRecord> {
    let mut state = 1u32;
    let mut unit = || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = (state >> ((state >> 28) + 4) ^ state).wrapping_mul(277_803_737);
        ((word >> 22 ^ word) >> 8) as f32 / (1 << 24) as f32
    };
    rays.iter()
        .zip(answers)
        .map(|(from, answer)| {
            let (point, normal) = surface(mesh, from, answer);
            let z = unit() * 2.0 - 1.0;
            let angle = unit() * std::f32::consts::TAU;
            let across = (1.0 - z * z).sqrt();
            let sphere = Vec3::new(across * angle.cos(), across * angle.sin(), z);
            ray(point, (normal + sphere * 0.999).normalize(), f32::INFINITY)
        })
        .collect()
}

/// Towards a lamp under the ceiling.
fn shadow_rays(mesh: &Mesh, rays: &[RayRecord], answers: &[Answer]) -> Vec<RayRecord> {
    let lamp = Vec3::new(-2.0, 8.5, 1.0);
    rays.iter()
        .zip(answers)
        .map(|(from, answer)| {
            let (point, _) = surface(mesh, from, answer);
            ray(point, lamp - point, 1.0)
        })
        .collect()
}
