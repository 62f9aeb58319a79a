//! What rays are shot at: a mesh, and from where it is seen.

use std::path::Path;

use afterglow_bvh::room::{Mesh, room};
use glam::Vec3;

use super::npz;
use crate::failure::Failure;

/// A mesh with a camera and a lamp.
pub struct Subject {
    /// How it is called.
    pub name: String,
    /// Positions, and three of them a triangle.
    pub mesh: Mesh,
    /// Where the camera is.
    pub eye: Vec3,
    /// Where it looks, of length 1; up is y.
    pub forward: Vec3,
    /// Where shadow rays go.
    pub lamp: Vec3,
}

impl Subject {
    /// A closed room of about so many triangles.
    pub fn room(triangles: u32) -> Self {
        // 12 n^2 in the walls, 36 (n/2 + 1)^2 in the boxes.
        let cells = (f64::from(triangles) / 21.0).sqrt().round().max(1.0) as u32;
        let mesh = room(cells);
        Self {
            name: format!("room of {}", mesh.1.len()),
            mesh,
            eye: Vec3::new(0.5, 0.0, 9.0),
            forward: Vec3::new(0.0, -0.15, -1.0).normalize(),
            lamp: Vec3::new(-2.0, 8.5, 1.0),
        }
    }

    /// A mesh of a file, seen from the middle along its longer side.
    pub fn file(path: &Path) -> Result<Self, Failure> {
        let mesh = npz::read_mesh(path)?;
        let (least, greatest) = mesh
            .0
            .iter()
            .filter(|p| p.iter().all(|c| c.is_finite()))
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(least, greatest), &p| {
                (least.min(p.into()), greatest.max(p.into()))
            });
        if !least.cmplt(greatest).any() {
            return Err(Failure::input(path, "a mesh without extent"));
        }
        let (eye, extent) = ((least + greatest) * 0.5, greatest - least);
        let forward = if extent.x >= extent.z { Vec3::X } else { Vec3::Z };
        let name = path.file_stem().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        Ok(Self { name, mesh, eye, forward, lamp: eye + extent * Vec3::new(0.1, 0.4, 0.05) })
    }

    /// How many triangles.
    pub fn triangle_count(&self) -> usize {
        self.mesh.1.len()
    }
}
