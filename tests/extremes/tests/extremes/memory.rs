//! Worlds that are larger than the device's memory.

use afterglow_extremes::{Shot, World, icosphere, lambert, staged};
use afterglow_gpu::{Faults, Gpu, GpuOptions};
use afterglow_render::{Mode, RenderOptions, Renderer};
use glam::{DVec3, Vec3};

/// Where there is no room for a mesh, frames are rasterized, or an error says so; the device serves the next renderer.
#[test]
fn a_mesh_beyond_the_memory_that_there_is() {
    let mut faults = Faults::default();
    faults.memory = Some(48 << 20);
    let gpu = Gpu::new(&GpuOptions { faults, ..GpuOptions::for_tests() }).unwrap();
    let renderer = || {
        let mut renderer = Renderer::new(&gpu, &RenderOptions::default()).unwrap();
        renderer.set_mode(Mode::Reference, &Shot::of(2).options).unwrap();
        renderer
    };
    let world = |halvings| {
        let ball = icosphere(Vec3::ZERO, 1.0, halvings);
        World::new(8).sky(1.0).with(ball, lambert(1.0)).seen_from(DVec3::Z * 5.0, DVec3::ZERO, 0.5)
    };
    for _ in 0..2 {
        let (mut frame, scene) = staged(&world(7));
        let mut renderer = renderer();
        match renderer.execute_staged(&mut frame, scene) {
            Ok(()) => assert_eq!(renderer.mode(), Mode::Raster),
            Err(error) => assert!(error.is_out_of_memory(), "{error}"),
        }
    }
    gpu.wait_idle().unwrap();
    gpu.collect().unwrap();
    let (mut frame, scene) = staged(&world(2));
    let mut renderer = renderer();
    renderer.execute_staged(&mut frame, scene).unwrap();
    let radiance = renderer.read_radiance().unwrap().unwrap();
    assert!(radiance.mean.iter().flatten().all(|value| (value - 1.0).abs() < 1e-4));
    assert_eq!(gpu.validation_count(), 0, "{:#?}", gpu.validation_messages());
}
