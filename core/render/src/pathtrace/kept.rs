//! Lights that pixels keep from frame to frame: where the frame before was seen from, and whether its choices still mean
//! anything.

use afterglow_records::ViewRecord;
use afterglow_scene::Camera;
use glam::{DMat4, DVec3};

use super::lights::LightList;

/// Samples that add up in a view, from which on each frame chooses its lights alone: what is kept repeats itself.
const MOST_ACCUMULATED: u32 = 16;

/// What the frame before has left.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Before {
    clip_from_world: DMat4,
    origin: DVec3,
    /// Kinds of lights and how many: numbers of lights mean the same only where these are.
    lights: (usize, usize, usize),
}

/// What is kept.
#[derive(Debug, Default)]
pub(crate) struct KeptLights {
    /// Traced frames before this one.
    frame_number: u32,
    before: Option<Before>,
}

impl KeptLights {
    /// Why the views of a frame keep no lights, if they do not.
    pub(crate) fn serves(
        &self,
        lights: &LightList,
        asked: u32,
        views: usize,
        accumulated: u32,
    ) -> Result<(), &'static str> {
        let placed = lights.sources.len() - lights.far_count;
        match () {
            () if placed <= asked as usize => Err("there are few lights, and each is asked"),
            () if views != 1 => Err("the frame has several views"),
            () if accumulated >= MOST_ACCUMULATED => Err("samples add up"),
            () => Ok(()),
        }
    }

    /// Whether buffers of odd or even frames are this one's.
    pub(crate) fn parity(&self) -> usize {
        self.frame_number as usize % 2
    }

    /// Whether the frame before has left anything.
    pub(crate) fn has_before(&self) -> bool {
        self.before.is_some()
    }

    /// Names in a record where the frame before was seen from.
    pub(crate) fn write(&self, record: &mut ViewRecord, origin: DVec3) {
        record.frame_number = self.frame_number;
        let Some(before) = &self.before else { return };
        let clip_from_here = before.clip_from_world * DMat4::from_translation(origin);
        record.clip_before = std::array::from_fn(|row| clip_from_here.row(row).as_vec4().to_array());
        record.origin_before = (before.origin - origin).as_vec3().to_array();
    }

    /// A frame is about to be seen: what was kept of other lights is forgotten.
    pub(crate) fn begin(&mut self, lights: &LightList) {
        if self.before.is_some_and(|before| before.lights != numbers(lights)) {
            self.before = None;
        }
    }

    /// A frame was prepared; `keeps`: its pixels keep lights.
    pub(crate) fn end(&mut self, camera: &Camera, origin: DVec3, lights: &LightList, keeps: bool) {
        self.frame_number = self.frame_number.wrapping_add(1);
        let clip_from_world = camera.projection.as_dmat4() * camera.view;
        let is_sound = clip_from_world.is_finite();
        self.before =
            (keeps && is_sound).then(|| Before { clip_from_world, origin, lights: numbers(lights) });
    }

    /// Nothing of the frames before is seen any more: what follows is the same as if there had been none.
    pub(crate) fn forget(&mut self) {
        *self = Self::default();
    }
}

fn numbers(lights: &LightList) -> (usize, usize, usize) {
    (lights.far_count, lights.first_triangle, lights.sources.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    fn camera(x: f64) -> Camera {
        Camera {
            view: DMat4::from_translation(DVec3::new(-x, 0.0, 0.0)),
            projection: glam::camera::rh::proj::opengl::perspective(1.0, 1.0, 0.1, 100.0),
        }
    }

    #[test]
    fn a_place_is_found_where_the_camera_saw_it_before() {
        let lights = LightList::default();
        let mut kept = KeptLights::default();
        kept.end(&camera(1e6), DVec3::X * 1e6, &lights, true);
        let mut record = ViewRecord::zeroed();
        kept.begin(&lights);
        kept.write(&mut record, DVec3::X * (1e6 + 2.0));
        assert_eq!((record.frame_number, record.origin_before), (1, [-2.0, 0.0, 0.0]));
        // Straight ahead of the camera before, relative to this one.
        let at = glam::Vec4::new(-2.0, 0.0, -5.0, 1.0);
        let clip = record.clip_before.map(|row| glam::Vec4::from(row).dot(at));
        assert!(clip[0].abs() < 1e-5 && (clip[3] - 5.0).abs() < 1e-5, "{clip:?}");
    }

    #[test]
    fn numbers_of_other_lights_mean_nothing() {
        let mut kept = KeptLights::default();
        kept.end(&camera(0.0), DVec3::ZERO, &LightList::default(), true);
        let other = LightList { far_count: 1, ..LightList::default() };
        kept.begin(&other);
        assert!(!kept.has_before());
        kept.end(&camera(0.0), DVec3::ZERO, &other, false);
        assert!(!kept.has_before());
    }
}
