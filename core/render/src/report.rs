//! What a frame cost.

use afterglow_frame_graph::{BytesReport, CulledReport};
use afterglow_scene::{Camera, Relight, Scene, SceneLight, TriangleCounts};

use crate::pathtrace::TraceCounts;

/// How a frame was understood.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneReport {
    /// The world's camera; none if there is no world.
    pub camera: Option<Camera>,
    /// Triangles by class.
    pub triangles: TriangleCounts,
    /// The lights of the world.
    pub lights: Vec<SceneLight>,
    /// How well the sources of its baked light were found, once they were searched.
    pub relight: Option<Relight>,
}

impl SceneReport {
    pub(crate) fn of(scene: &Scene) -> Self {
        Self {
            camera: scene.camera,
            triangles: scene.triangles(),
            lights: scene.lights.clone(),
            relight: scene.relight,
        }
    }
}

/// Time of one kind of pass.
#[derive(Debug, Clone, PartialEq)]
pub struct PassReport {
    /// The pass's name in the frame graph.
    pub name: String,
    /// How many such passes there were.
    pub count: usize,
    /// By the device's clock; 0 if times are not taken.
    pub milliseconds: f64,
}

/// What executing a frame took. A frame that was handed over in parts is one.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FrameReport {
    /// Buffer swaps before this frame.
    pub index: u64,
    /// The kinds of passes, in the order of their first one.
    pub passes: Vec<PassReport>,
    /// Draws, clears and rectangles of pixels are not counted.
    pub draws: usize,
    /// Indices of all draws.
    pub indices: u64,
    /// Bytes that the processor wrote for the device.
    pub uploaded_bytes: u64,
    /// Pipelines made, so far.
    pub pipelines: usize,
    /// Texture images at the frame's end.
    pub textures: usize,
    /// Retained ranges on the device at the frame's end.
    pub retained_ranges: usize,
    /// Passes that were not needed, and why.
    pub culled: Vec<CulledReport>,
    /// Memory of the frame graph's resources.
    pub bytes: BytesReport,
    /// How the frame was understood; none in `raster` mode, and of a frame that was handed over in parts.
    pub scene: Option<SceneReport>,
    /// What of the world was traced; none if the frame was rasterized.
    pub traced: Option<TraceCounts>,
}

impl FrameReport {
    /// Adds a pass.
    pub(crate) fn add_pass(&mut self, name: &str) {
        match self.passes.iter_mut().find(|pass| pass.name == name) {
            Some(pass) => pass.count += 1,
            None => self.passes.push(PassReport { name: name.to_owned(), count: 1, milliseconds: 0.0 }),
        }
    }

    /// Adds the time of a pass that was added before.
    pub(crate) fn add_time(&mut self, name: &str, nanoseconds: u64) {
        if let Some(pass) = self.passes.iter_mut().find(|pass| pass.name == name) {
            pass.milliseconds += nanoseconds as f64 * 1e-6;
        }
    }

    /// Adds a later part of the same frame, or takes its place if it is of another frame.
    pub(crate) fn merge(&mut self, later: Self) {
        if later.index != self.index {
            *self = later;
            return;
        }
        for pass in &later.passes {
            match self.passes.iter_mut().find(|known| known.name == pass.name) {
                Some(known) => {
                    known.count += pass.count;
                    known.milliseconds += pass.milliseconds;
                }
                None => self.passes.push(pass.clone()),
            }
        }
        self.draws += later.draws;
        self.indices += later.indices;
        self.uploaded_bytes += later.uploaded_bytes;
        self.pipelines = later.pipelines;
        self.textures = later.textures;
        self.retained_ranges = later.retained_ranges;
        self.culled.extend(later.culled);
        self.bytes = later.bytes;
        self.scene = later.scene.or(self.scene.take());
        self.traced = later.traced.or(self.traced);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_frame_add_up_and_another_frame_begins_anew() {
        let part = |index, draws| {
            let mut report = FrameReport { index, draws, ..FrameReport::default() };
            report.add_pass("raster");
            report.add_pass("raster");
            report.add_time("raster", 1_500_000);
            report
        };
        let mut whole = part(3, 5);
        whole.merge(part(3, 2));
        assert_eq!((whole.draws, whole.passes[0].count), (7, 4));
        assert_eq!(whole.passes[0].milliseconds, 3.0);
        whole.merge(part(4, 1));
        assert_eq!(whole, part(4, 1));
    }
}
