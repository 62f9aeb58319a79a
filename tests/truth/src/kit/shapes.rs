//! Common shapes.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use afterglow_api::constants::*;
use glam::{Affine3A, Vec2, Vec3};

use super::{Mesh, Vertex};

/// A box from one corner to the opposite one, as quads.
pub fn boxed(least: Vec3, most: Vec3) -> Mesh {
    let size = most - least;
    let [x, y, z] = [Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z];
    let mut mesh = Mesh::default();
    for (corner, along) in [
        (least + z, [x, y]),
        (least + x, [-x, y]),
        (least + x + z, [-z, y]),
        (least, [z, y]),
        (least + y + z, [x, -z]),
        (least, [x, z]),
    ] {
        mesh.parallelogram(corner, along, 1, Vec2::ONE);
    }
    mesh
}

/// A sphere as strips of quads, one a ring.
pub fn sphere(radius: f32, rings: u32, sectors: u32) -> Mesh {
    let at = |ring: u32, sector: u32| {
        let (up, around) = (ring as f32 / rings as f32, sector as f32 / sectors as f32);
        let (latitude, longitude) = ((up - 0.5) * PI, around * TAU);
        let normal =
            Vec3::new(latitude.cos() * longitude.cos(), latitude.sin(), -latitude.cos() * longitude.sin());
        Vertex::new(normal * radius, normal, Vec2::new(2.0 * around, up))
    };
    let mut mesh = Mesh::default();
    for ring in 0..rings {
        let vertices = (0..=sectors).flat_map(|sector| [at(ring + 1, sector), at(ring, sector)]);
        mesh.push(GL_QUAD_STRIP, &vertices.collect::<Vec<_>>());
    }
    mesh
}

/// The upper half of a sphere seen from within, bright at the horizon: strips, and a fan at the top.
pub fn dome(radius: f32, zenith: [u8; 3], horizon: [u8; 3]) -> Mesh {
    const SECTORS: u32 = 24;
    const RINGS: u32 = 6;
    let at = |ring: u32, sector: u32| {
        let (up, around) = (ring as f32 / RINGS as f32, sector as f32 / SECTORS as f32);
        // It goes on a little below the horizon.
        let (latitude, longitude) = (up * (FRAC_PI_2 + 0.2) - 0.2, around * TAU);
        let direction =
            Vec3::new(latitude.cos() * longitude.cos(), latitude.sin(), latitude.cos() * longitude.sin());
        let mix = |c: usize| (f32::from(horizon[c]) * (1.0 - up) + f32::from(zenith[c]) * up) as u8;
        Vertex {
            color: [mix(0), mix(1), mix(2), 255],
            ..Vertex::new(direction * radius, -direction, Vec2::new(4.0 * around, up))
        }
    };
    let mut mesh = Mesh::default();
    for ring in 0..RINGS - 1 {
        let vertices = (0..=SECTORS).flat_map(|sector| [at(ring + 1, sector), at(ring, sector)]);
        mesh.push(GL_TRIANGLE_STRIP, &vertices.collect::<Vec<_>>());
    }
    let top = std::iter::once(at(RINGS, 0)).chain((0..=SECTORS).map(|sector| at(RINGS - 1, sector)));
    mesh.push(GL_TRIANGLE_FAN, &top.collect::<Vec<_>>());
    mesh
}

/// A ring about the z axis, such as a coin to be collected.
pub fn ring(radius: f32, thickness: f32, sectors: u32) -> Mesh {
    const AROUND: u32 = 6;
    let at = |sector: u32, side: u32| {
        let (a, b) = (sector as f32 / sectors as f32 * TAU, side as f32 / AROUND as f32 * TAU);
        let outward = Vec3::new(a.cos(), a.sin(), 0.0);
        let normal = outward * b.cos() + Vec3::Z * b.sin();
        let uv = Vec2::new(4.0 * a / TAU, b / TAU);
        Vertex::new(outward * radius + normal * thickness, normal, uv)
    };
    let mut mesh = Mesh::default();
    for sector in 0..sectors {
        let vertices = (0..=AROUND).flat_map(|side| [at(sector, side), at(sector + 1, side)]);
        mesh.push(GL_TRIANGLE_STRIP, &vertices.collect::<Vec<_>>());
    }
    mesh
}

/// A two-legged creature whose limbs swing with `phase` (radians): its vertices move against each other.
pub fn creature(phase: f32) -> Mesh {
    let swing = 0.6 * phase.sin();
    let limb = |at: Vec3, angle: f32, length: f32| {
        let limb = boxed(Vec3::new(-0.12, -length, -0.12), Vec3::new(0.12, 0.0, 0.12));
        limb.transformed(Affine3A::from_translation(at) * Affine3A::from_rotation_x(angle))
    };
    let mut mesh = Mesh::default();
    mesh.append(&limb(Vec3::new(-0.18, 0.8, 0.0), swing, 0.8));
    mesh.append(&limb(Vec3::new(0.18, 0.8, 0.0), -swing, 0.8));
    mesh.append(&limb(Vec3::new(-0.42, 1.45, 0.0), -swing, 0.65));
    mesh.append(&limb(Vec3::new(0.42, 1.45, 0.0), swing, 0.65));
    let bob = Affine3A::from_translation(Vec3::Y * 0.04 * (2.0 * phase).sin());
    mesh.append(&boxed(Vec3::new(-0.3, 0.8, -0.16), Vec3::new(0.3, 1.5, 0.16)).transformed(bob));
    mesh.append(&sphere(0.22, 6, 10).transformed(bob * Affine3A::from_translation(Vec3::Y * 1.72)));
    mesh
}
