//! What the frame before has left: where it was seen from, and whether that still means anything.

use afterglow_records::ViewRecord;
use afterglow_scene::Camera;
use glam::{DMat4, DVec3, DVec4};

use super::lights::LightList;
use super::rays::PixelRays;

/// Samples that add up in a view, from which on each frame chooses its lights alone: what is kept repeats itself.
const MOST_ACCUMULATED: u32 = 16;

/// What pixels of a frame leave to the next one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Left {
    /// A light that each has chosen.
    pub(crate) lights: bool,
    /// What each of so many views shows, and its light; 0 if nothing is left.
    pub(crate) histories: usize,
}

/// A frame that was traced.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Before {
    clip_from_world: DMat4,
    /// Depth along the view of a place in the world.
    depth: DVec4,
    origin: DVec3,
    /// Kinds of lights and how many: numbers of lights mean the same only where these are.
    lights: (usize, usize, usize),
    left: Left,
}

/// The frames before.
#[derive(Debug, Default)]
pub(crate) struct Past {
    /// Traced frames before this one.
    frame_number: u32,
    /// Where this frame's samples begin in the sequence of each pixel, and the last one's.
    first_samples: [u32; 2],
    before: Option<Before>,
}

impl Past {
    /// Why the views of a frame keep no lights, if they do not.
    pub(crate) fn serves_lights(
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

    /// Whether the frame before has left choices among these lights.
    pub(crate) fn has_lights(&self, lights: &LightList) -> bool {
        self.before.is_some_and(|before| before.left.lights && before.lights == numbers(lights))
    }

    /// Whether it has left a history of each of so many views.
    pub(crate) fn has_histories(&self, views: usize) -> bool {
        self.before.is_some_and(|before| before.left.histories == views)
    }

    /// Names in a record where the frame before was seen from.
    pub(crate) fn write(&self, record: &mut ViewRecord, origin: DVec3) {
        record.frame_number = self.frame_number;
        [record.first_sample, record.first_sample_before] = self.first_samples;
        let Some(before) = &self.before else { return };
        let from_here = DMat4::from_translation(origin);
        let clip_from_here = before.clip_from_world * from_here;
        record.clip_before = std::array::from_fn(|row| clip_from_here.row(row).as_vec4().to_array());
        record.depth_before = (from_here.transpose() * before.depth).as_vec4().to_array();
        record.origin_before = (before.origin - origin).as_vec3().to_array();
    }

    /// A frame of so many samples a pixel was prepared, which leaves something to the next one.
    pub(crate) fn end(
        &mut self,
        camera: &Camera,
        origin: DVec3,
        lights: &LightList,
        samples: u32,
        left: Left,
    ) {
        self.frame_number = self.frame_number.wrapping_add(1);
        self.first_samples = [self.first_samples[0].wrapping_add(samples), self.first_samples[0]];
        let clip_from_world = camera.projection.as_dmat4() * camera.view;
        let depth = depth_row(camera, origin);
        let is_sound = clip_from_world.is_finite() && depth.is_finite();
        self.before = (left != Left::default() && is_sound).then(|| Before {
            clip_from_world,
            depth,
            origin,
            lights: numbers(lights),
            left,
        });
    }

    /// Nothing of the frames before is seen any more. Noise goes on.
    pub(crate) fn forget(&mut self) {
        self.before = None;
    }
}

/// What a place in the world is multiplied with for its depth along the view, as shaders count it.
fn depth_row(camera: &Camera, origin: DVec3) -> DVec4 {
    let rays = PixelRays::new(camera, [1, 1]);
    let [forward, first] = [rays.forward, rays.origin].map(|vector| glam::Vec3::from(vector).as_dvec3());
    // Where pixels look side by side, depth begins at the near plane.
    let begins = if rays.is_parallel { forward.dot(first) } else { 0.0 };
    forward.extend(-forward.dot(origin) - begins)
}

fn numbers(lights: &LightList) -> (usize, usize, usize) {
    (lights.far_count, lights.first_triangle, lights.sources.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    const BOTH: Left = Left { lights: true, histories: 1 };

    fn camera(x: f64) -> Camera {
        Camera {
            view: DMat4::from_translation(DVec3::new(-x, 0.0, 0.0)),
            projection: glam::camera::rh::proj::opengl::perspective(1.0, 1.0, 0.1, 100.0),
        }
    }

    #[test]
    fn a_place_is_found_where_the_camera_saw_it_before() {
        let lights = LightList::default();
        let mut past = Past::default();
        past.end(&camera(1e6), DVec3::X * 1e6, &lights, 3, BOTH);
        let mut record = ViewRecord::zeroed();
        past.write(&mut record, DVec3::X * (1e6 + 2.0));
        assert_eq!((record.frame_number, record.origin_before), (1, [-2.0, 0.0, 0.0]));
        assert_eq!((record.first_sample, record.first_sample_before), (3, 0));
        // Straight ahead of the camera before, relative to this one.
        let at = glam::Vec4::new(-2.0, 0.0, -5.0, 1.0);
        let clip = record.clip_before.map(|row| glam::Vec4::from(row).dot(at));
        assert!(clip[0].abs() < 1e-5 && (clip[3] - 5.0).abs() < 1e-5, "{clip:?}");
        let depth = glam::Vec4::from(record.depth_before).dot(at);
        assert!((depth - 5.0).abs() < 1e-5, "{depth}");
    }

    #[test]
    fn depth_of_what_is_seen_side_by_side_begins_at_the_near_plane() {
        let projection = glam::camera::rh::proj::opengl::orthographic(-3.0, 3.0, -2.0, 2.0, 1.0, 10.0);
        let mut past = Past::default();
        past.end(&Camera { projection, ..camera(0.0) }, DVec3::ZERO, &LightList::default(), 1, BOTH);
        let mut record = ViewRecord::zeroed();
        past.write(&mut record, DVec3::ZERO);
        let depth = glam::Vec4::from(record.depth_before).dot(glam::Vec4::new(2.0, 1.0, -5.0, 1.0));
        assert!((depth - 4.0).abs() < 1e-4, "{depth}");
    }

    #[test]
    fn numbers_of_other_lights_mean_nothing() {
        let mut past = Past::default();
        past.end(&camera(0.0), DVec3::ZERO, &LightList::default(), 1, BOTH);
        let other = LightList { far_count: 1, ..LightList::default() };
        assert!(past.has_lights(&LightList::default()) && !past.has_lights(&other));
        past.end(&camera(0.0), DVec3::ZERO, &other, 1, Left { lights: false, ..BOTH });
        assert!(!past.has_lights(&other));
    }

    #[test]
    fn histories_are_of_the_same_views() {
        let mut past = Past::default();
        assert!(!past.has_histories(1));
        past.end(&camera(0.0), DVec3::ZERO, &LightList::default(), 1, BOTH);
        assert!(past.has_histories(1) && !past.has_histories(2));
        past.forget();
        assert!(!past.has_histories(1));
    }
}
