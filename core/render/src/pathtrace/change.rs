//! Whether anything has changed that light depends on: if not, samples go on adding up.

use afterglow_gl::frame::{Draw, Frame, Operation, VertexSource};
use afterglow_records::{LightSource, SurfaceDraw, ViewRecord};
use afterglow_scene::{Camera, Scene};
use bytemuck::Zeroable;
use xxhash_rust::xxh3::Xxh3;

use super::estimator::Estimator;
use super::options::PathtraceOptions;
use super::sky::SkyUse;

/// Samples of a pixel after which more change nothing that 8 bits show.
const MOST_SAMPLES: u32 = 1 << 16;

/// Hashes what light depends on.
pub(crate) struct ChangeHasher {
    hasher: Xxh3,
    last: Option<Draw>,
}

impl ChangeHasher {
    pub(crate) fn new(
        size: [u32; 2],
        camera: &Camera,
        scene: &Scene,
        lights: &[LightSource],
        estimator: &Estimator,
        options: &PathtraceOptions,
    ) -> Self {
        let mut hasher = Xxh3::new();
        hasher.update(bytemuck::bytes_of(&size));
        hasher.update(bytemuck::bytes_of(&camera.view.to_cols_array()));
        hasher.update(bytemuck::bytes_of(&camera.projection.to_cols_array()));
        hasher.update(bytemuck::bytes_of(&scene.sky.to_array()));
        hasher.update(bytemuck::bytes_of(&scene.ambient.to_array()));
        hasher.update(bytemuck::cast_slice(lights));
        hasher.update(format!("{estimator:?}").as_bytes());
        // Frames may differ in their number of samples, and still add up.
        let without_samples = PathtraceOptions { spp: 0, ..options.clone() };
        hasher.update(format!("{without_samples:?}").as_bytes());
        Self { hasher, last: None }
    }

    /// Adds the sky where it is not the same everywhere.
    pub(crate) fn add_sky(&mut self, sky: &SkyUse) {
        let mut record = ViewRecord::zeroed();
        sky.write(&mut record);
        let colors = [record.sky_least, record.sky_scale];
        self.hasher.update(&[u8::from(sky.is_mapped())]);
        self.hasher.update(bytemuck::bytes_of(&colors));
        self.hasher.update(&sky.drawing.to_le_bytes());
    }

    /// Adds a surface; what of its tables is the same as the last one's is not hashed again.
    pub(crate) fn add(&mut self, frame: &Frame, draw: &Draw, surface: &SurfaceDraw, content: u64) {
        // Where it was before is nothing that light depends on.
        let as_it_is = SurfaceDraw {
            vertices: 0,
            indices: 0,
            corners_before: 0,
            object_to_world_before: [[0.0; 4]; 3],
            ..*surface
        };
        self.hasher.update(bytemuck::bytes_of(&as_it_is));
        self.hasher.update(&content.to_le_bytes());
        if let VertexSource::Arena { .. } = draw.source {
            let (words, _) = frame.geometry(draw);
            self.hasher.update(bytemuck::cast_slice(words));
        }
        let last = self.last;
        let is_new = |of: fn(&Draw) -> u32| last.is_none_or(|last| of(&last) != of(draw));
        if is_new(|draw| draw.transform) {
            self.block(&frame.transforms, draw.transform);
        }
        if is_new(|draw| draw.material) {
            self.block(&frame.materials, draw.material);
        }
        if is_new(|draw| draw.environment) {
            self.block(&frame.environments, draw.environment);
        }
        if is_new(|draw| draw.texture_matrices) {
            self.block(&frame.texture_matrices, draw.texture_matrices);
        }
        if is_new(|draw| draw.texgen) {
            self.block(&frame.texgens, draw.texgen);
        }
        if is_new(|draw| draw.current) {
            self.block(&frame.current, draw.current);
        }
        self.last = Some(*draw);
    }

    /// Adds how many meshes rays miss: one that has come is another world.
    pub(crate) fn add_waiting(&mut self, meshes: usize) {
        self.hasher.update(&meshes.to_le_bytes());
    }

    pub(crate) fn finish(self) -> u64 {
        self.hasher.digest()
    }

    fn block<T: bytemuck::Pod>(&mut self, table: &[T], index: u32) {
        if let Some(block) = table.get(index as usize) {
            self.hasher.update(bytemuck::bytes_of(block));
        }
    }
}

/// Whether a frame changes textures.
pub(crate) fn changes_textures(frame: &Frame) -> bool {
    frame.operations.iter().any(|operation| {
        matches!(operation, Operation::Upload(_) | Operation::CopyToImage(_) | Operation::CopyImage { .. })
    })
}

/// What a view has gathered while nothing changed.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct History {
    hash: u64,
    /// Samples a pixel.
    samples: u32,
    /// The number of the frame in which it began.
    begun: u32,
}

impl History {
    /// Goes on from the last frame, or begins anew. Returns how many samples there are already.
    pub(crate) fn advance(&mut self, hash: u64, may_continue: bool, samples: u32, frame: u32) -> u32 {
        if !may_continue || self.hash != hash || self.samples >= MOST_SAMPLES {
            *self = Self { hash, samples: 0, begun: frame };
        }
        let before = self.samples;
        self.samples += samples;
        before
    }

    /// Samples a pixel, those of the frame that was advanced to included.
    pub(crate) fn samples(&self) -> u32 {
        self.samples
    }

    /// The number of the frame in which it began.
    pub(crate) fn begun(&self) -> u32 {
        self.begun
    }

    /// What was gathered is gone.
    pub(crate) fn forget(&mut self) {
        *self = Self::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_add_up_until_something_changes() {
        let mut history = History::default();
        assert_eq!(history.advance(5, true, 4, 0), 0);
        assert_eq!(history.advance(5, true, 4, 0), 4);
        assert_eq!(history.advance(6, true, 4, 0), 0);
        assert_eq!(history.advance(6, true, 4, 0), 4);
        assert_eq!(history.advance(6, false, 4, 0), 0);
        history.forget();
        assert_eq!(history.advance(6, true, 4, 0), 0);
    }
}
