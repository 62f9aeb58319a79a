//! A scene in the making.

use afterglow_scene_file::{Material, Model, SceneFile, Sky, SphereLight, Sun, Triangles, View};
use glam::{DMat4, DVec3, Vec3};

use crate::shapes::Triangle;

/// A scene file in memory.
#[derive(Debug, Clone)]
pub struct World {
    pub file: SceneFile,
}

/// Lambert's material of an albedo.
pub fn lambert(albedo: f32) -> Material {
    Material {
        name: String::new(),
        model: Model::Lambert,
        base_color: Vec3::splat(albedo),
        roughness: 0.0,
        emission: DVec3::ZERO,
    }
}

/// White metal.
pub fn metal(roughness: f32) -> Material {
    Material { model: Model::GgxMetal, roughness, ..lambert(1.0) }
}

/// A material of this albedo whose front gives off radiance.
pub fn shining(radiance: f64, albedo: f32) -> Material {
    Material { emission: DVec3::splat(radiance), ..lambert(albedo) }
}

impl World {
    /// Nothing, seen from the origin along -z.
    pub fn new(size: u32) -> Self {
        let view = View { modelview: DMat4::IDENTITY, projection: projection(1.0, 0.01, 1e3) };
        Self {
            file: SceneFile {
                name: String::new(),
                size: [size; 2],
                view,
                sun: None,
                sky: None,
                sphere_lights: Vec::new(),
                materials: Vec::new(),
                triangles: Triangles::default(),
                objects: Vec::new(),
                frames: Vec::new(),
            },
        }
    }

    /// Looks from a place to another. The angle is the picture's, in radians.
    #[must_use]
    pub fn seen_from(mut self, eye: DVec3, target: DVec3, angle: f64) -> Self {
        let away = eye.distance(target);
        let direction = (target - eye) / away;
        let up = if direction.y.abs() > 0.99 { DVec3::Z } else { DVec3::Y };
        self.file.view.modelview = glam::dcamera::rh::view::look_at_mat4(eye, target, up);
        self.file.view.projection = projection(angle, away * 1e-3, away * 1e4);
        self
    }

    /// Light from where nothing is.
    #[must_use]
    pub fn sky(mut self, radiance: f64) -> Self {
        self.file.sky = Some(Sky { radiance: DVec3::splat(radiance) });
        self
    }

    /// A disc infinitely far: its direction, angular radius (radians) and irradiance.
    #[must_use]
    pub fn sun(mut self, direction: DVec3, angular_radius: f64, irradiance: f64) -> Self {
        let irradiance = DVec3::splat(irradiance);
        self.file.sun = Some(Sun { direction: direction.normalize(), angular_radius, irradiance });
        self
    }

    /// A sphere that shines.
    #[must_use]
    pub fn lamp(mut self, center: DVec3, radius: f64, radiance: f64) -> Self {
        let radiance = DVec3::splat(radiance);
        self.file.sphere_lights.push(SphereLight { name: None, center, radius, radiance });
        self
    }

    /// Triangles of one material.
    #[must_use]
    pub fn with(mut self, triangles: impl IntoIterator<Item = Triangle>, material: Material) -> Self {
        let number = self.file.materials.len() as u32;
        self.file.materials.push(Material { name: number.to_string(), ..material });
        let all = &mut self.file.triangles;
        for triangle in triangles {
            let first = all.positions.len() as u32;
            all.positions.extend(triangle);
            all.corners.push([first, first + 1, first + 2]);
            all.materials.push(number);
        }
        self
    }

    /// The same scene elsewhere, and `scale` times as large: about the world's origin first, then moved.
    #[must_use]
    pub fn moved(mut self, by: DVec3, scale: f64) -> Self {
        let place = |point: DVec3| point * scale + by;
        for position in &mut self.file.triangles.positions {
            *position = place(position.as_dvec3()).as_vec3();
        }
        for light in &mut self.file.sphere_lights {
            light.center = place(light.center);
            light.radius *= scale;
        }
        let view = &mut self.file.view;
        let turn = DMat4::from_mat3(glam::DMat3::from_mat4(view.modelview));
        let eye = place(view.modelview.inverse().w_axis.truncate());
        view.modelview = turn * DMat4::from_translation(-eye);
        view.projection = scaled_depth(view.projection, scale);
        self
    }
}

/// OpenGL's perspective of a square picture.
fn projection(angle: f64, near: f64, far: f64) -> DMat4 {
    glam::dcamera::rh::proj::opengl::perspective(angle, 1.0, near, far)
}

/// A projection whose planes are so many times as far.
fn scaled_depth(mut projection: DMat4, scale: f64) -> DMat4 {
    projection.w_axis.z *= scale;
    projection
}
