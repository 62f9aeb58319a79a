//! What recovery found, as reports write it.

use std::fmt;

use afterglow_scene::{Camera as SceneCamera, LightShape, Relight as SceneRelight, SceneLight};
use serde::Serialize;

/// The world's camera; matrices by columns.
#[derive(Debug, Default, Serialize)]
pub struct Camera {
    found: bool,
    pub view: Option<[f64; 16]>,
    projection: Option<[f32; 16]>,
}

/// A light of the world, in world space.
#[derive(Debug, Serialize)]
pub struct Light {
    origin: String,
    /// Unit vector to a light that is infinitely far.
    to_light: Option<[f32; 3]>,
    position: Option<[f32; 3]>,
    /// World units; of a light that is infinitely far, radians.
    radius: f32,
    /// Linear.
    color: [f32; 3],
}

/// How well the sources of baked light were found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Relight {
    /// Relative error of the light that they make.
    residual: f32,
    /// Share of the lit surfaces' area with an error below a quarter.
    explained: f32,
    /// Share of the bake's variance over its surfaces that they explain.
    variance: f32,
    triangles: usize,
    patches: usize,
    emitters: usize,
    sources: usize,
    lights: usize,
    rays: u64,
    /// From the bake's light to that of the lights.
    scale: f32,
    /// The scene has these lights.
    used: bool,
    /// Their light takes the place of the bake.
    replaces: bool,
}

impl From<&SceneRelight> for Relight {
    fn from(found: &SceneRelight) -> Relight {
        Relight {
            residual: found.residual,
            explained: found.explained,
            variance: found.variance,
            triangles: found.triangles,
            patches: found.patches,
            emitters: found.emitters,
            sources: found.sources,
            lights: found.lights,
            rays: found.rays,
            scale: found.scale,
            used: found.is_used,
            replaces: found.replaces,
        }
    }
}

impl fmt::Display for Relight {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "baked light: {} lights recovered from {} patches, residual {:.3}, {:.0} % of the area and {:.0} % of the variance explained, {}",
            self.lights,
            self.patches,
            self.residual,
            100.0 * self.explained,
            100.0 * self.variance,
            match (self.replaces, self.used) {
                (true, _) => "in the place of the bake",
                (false, true) => "beside the bake",
                (false, false) => "not used",
            }
        )
    }
}

impl From<&SceneCamera> for Camera {
    fn from(camera: &SceneCamera) -> Camera {
        Camera {
            found: true,
            view: Some(camera.view.to_cols_array()),
            projection: Some(camera.projection.to_cols_array()),
        }
    }
}

impl From<&SceneLight> for Light {
    fn from(light: &SceneLight) -> Light {
        let (to_light, position, radius) = match light.shape {
            LightShape::Directional { to_light, angular_radius } => (Some(to_light), None, angular_radius),
            LightShape::Point { position, radius, .. } => (None, Some(position), radius),
        };
        Light {
            origin: light.origin.to_string(),
            to_light: to_light.map(Into::into),
            position: position.map(Into::into),
            radius,
            color: light.color.into(),
        }
    }
}

impl fmt::Display for Light {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let list = |v: [f32; 3]| format!("{:.3} {:.3} {:.3}", v[0], v[1], v[2]);
        write!(f, "light {}: ", self.origin)?;
        match (self.position, self.to_light) {
            (Some(position), _) => write!(f, "at {}", list(position))?,
            (None, to_light) => write!(f, "from {}", list(to_light.unwrap_or_default()))?,
        }
        write!(f, ", radius {:.4}, colour {}", self.radius, list(self.color))
    }
}
