//! Whether a sky looks as it did: if so, nothing of it is drawn again.

use std::hash::{Hash, Hasher};

use afterglow_gl::frame::{
    CurrentAttributes, Draw, FixedState, Format, Frame, ImageKey, Light, Lights, Operation, Slot, UnitWords,
    VertexSource,
};
use afterglow_records::SKY_EDGE;
use afterglow_scene::{PaintedSky, Recovery};
use glam::{DMat4, DVec3, Vec3, Vec4};
use xxhash_rust::xxh3::Xxh3;

use super::geometry::PositionReader;

/// Corners of a draw whose directions are watched, at most.
const WATCHED: usize = 256;
/// How far a direction may turn unseen: a quarter of the width of a texel (there are two units to a side).
const UNSEEN: f32 = 0.5 / SKY_EDGE as f32;
/// How much colours may differ unseen.
const UNSEEN_COLOR: f32 = 1.0 / 512.0;

/// A draw of the sky.
#[derive(Debug, Clone)]
struct DrawKey {
    state: FixedState,
    /// Of all else but where it is.
    content: u64,
    /// Where some of its corners are seen, in the world's axes; zero where nothing is known.
    directions: Vec<Vec3>,
}

/// What the look of a sky depends on.
#[derive(Debug, Clone)]
pub(crate) struct SkyKey {
    epoch: u64,
    colors: [Vec3; 2],
    draws: Vec<DrawKey>,
}

impl SkyKey {
    pub(crate) fn new(epoch: u64, painted: &PaintedSky) -> Self {
        Self { epoch, colors: [painted.cleared, painted.open], draws: Vec::new() }
    }

    /// Adds a draw, which lies within the frame. `model` leads from its coordinates to the world's axes about the eye, `axes` from
    /// eye space.
    pub(crate) fn add(
        &mut self,
        frame: &Frame,
        draw: &Draw,
        [model, axes]: [&DMat4; 2],
        recovery: &Recovery,
    ) {
        let state = frame.fixed[draw.fixed as usize];
        let mut hasher = Xxh3::new();
        (draw.layout, draw.topology, draw.index_count).hash(&mut hasher);
        match draw.source {
            VertexSource::Arena { .. } => {
                let (words, indices) = frame.geometry(draw);
                hasher.update(bytemuck::cast_slice(indices));
                // Positions come first. Where all of them are watched they may change as little as is unseen.
                let watched = if indices.len() > WATCHED { 0 } else { position_words(draw) };
                for vertex in words.chunks(draw.layout.stride().max(1)) {
                    hasher.update(bytemuck::cast_slice(&vertex[watched.min(vertex.len())..]));
                }
            }
            VertexSource::Retained { range, first_index } => {
                (frame.retained[range as usize].content_hash(), first_index).hash(&mut hasher);
            }
        }
        block(&mut hasher, &frame.environments, draw.environment);
        block(&mut hasher, &frame.texture_matrices, draw.texture_matrices);
        if let Some(current) = frame.current.get(draw.current as usize) {
            add_current(current, draw, &state, &mut hasher);
        }
        block(&mut hasher, &frame.texgens, draw.texgen);
        if follows_eye(&state) {
            block(&mut hasher, &frame.transforms, draw.transform);
        }
        let mut directions = directions(frame, draw, model);
        if state.words.global.lighting() != 0 {
            block(&mut hasher, &frame.materials, draw.material);
            if let Some(lights) = frame.lights.get(draw.lights as usize) {
                let enabled = state.words.global.lights();
                add_lights(lights, enabled, axes, &mut hasher, &mut directions);
            }
        }
        for binding in frame.bindings[draw.bindings as usize].iter().flatten() {
            binding.sampler.hash(&mut hasher);
            match recovery.image(binding.image) {
                Some(facts) => facts.content().hash(&mut hasher),
                None => binding.image.hash(&mut hasher),
            }
        }
        self.draws.push(DrawKey { state, content: hasher.finish(), directions });
    }

    /// Whether a sky looks as this one did.
    pub(crate) fn looks_like(&self, other: &Self) -> bool {
        let mut colors = self.colors.iter().zip(&other.colors);
        self.epoch == other.epoch
            && self.draws.len() == other.draws.len()
            && colors.all(|(a, b)| a.abs_diff_eq(*b, UNSEEN_COLOR))
            && self.draws.iter().zip(&other.draws).all(|(a, b)| a.looks_like(b))
    }

    /// Whether both belong to the same world.
    pub(crate) fn shares_world(&self, other: &Self) -> bool {
        self.epoch == other.epoch
    }
}

impl DrawKey {
    fn looks_like(&self, other: &Self) -> bool {
        let mut both = self.directions.iter().zip(&other.directions);
        self.content == other.content
            && self.state == other.state
            && both.all(|(a, b)| a.abs_diff_eq(*b, UNSEEN))
    }
}

/// Whether a frame draws new texels into a texture of these draws: recovery knows of what comes from memory.
pub(crate) fn draws_texels(frame: &Frame, draws: &[Draw]) -> bool {
    let is_used = |image: ImageKey| {
        let bindings = draws.iter().filter_map(|draw| frame.bindings.get(draw.bindings as usize));
        bindings.flatten().flatten().any(|binding| binding.image == image)
    };
    frame.operations.iter().any(|operation| match operation {
        Operation::Upload(upload) => is_used(upload.image),
        Operation::CopyToImage(copy) => is_used(copy.image),
        Operation::CopyImage { to, .. } => is_used(*to),
        _ => false,
    })
}

/// Adds lights, of which a bit each says that they are enabled, by their colours and by where they are seen. Highlights that
/// follow the eye are as they were drawn first.
fn add_lights(lights: &Lights, enabled: u32, axes: &DMat4, hasher: &mut Xxh3, directions: &mut Vec<Vec3>) {
    hasher.update(bytemuck::bytes_of(&lights.scene_ambient));
    for (_, light) in lights.lights.iter().enumerate().filter(|(index, _)| enabled >> index & 1 != 0) {
        for eye in [Vec4::from(light.position).truncate(), light.spot_direction.into()] {
            directions.push(axes.transform_vector3(eye.as_dvec3()).normalize_or_zero().as_vec3());
        }
        let position = [0.0, 0.0, 0.0, light.position[3]];
        let without_place = Light { position, spot_direction: [0.0; 3], ..*light };
        hasher.update(bytemuck::bytes_of(&without_place));
    }
}

/// Adds the current values that are those of all vertices: others are what the program happened to draw before.
fn add_current(current: &CurrentAttributes, draw: &Draw, state: &FixedState, hasher: &mut Xxh3) {
    let is_absent = |slot: usize| draw.layout.format(slot) == Format::Absent;
    let mut add = |slot: usize, value: &dyn Fn() -> [f32; 4]| {
        if is_absent(slot) {
            hasher.update(bytemuck::bytes_of(&value()));
        }
    };
    add(Slot::Color as usize, &|| current.color);
    add(Slot::Secondary as usize, &|| current.secondary);
    add(Slot::Fog as usize, &|| current.fog);
    if state.words.global.lighting() != 0 || follows_eye(state) {
        add(Slot::Normal as usize, &|| current.normal);
    }
    for (unit, words) in state.words.units.iter().enumerate().filter(|(_, unit)| unit.target() != 0) {
        if words.gen_s() == 0 || words.gen_t() == 0 {
            add(Slot::Texture0 as usize + unit, &|| current.texture[unit].coefficients);
        }
    }
}

/// Words of a vertex's position.
fn position_words(draw: &Draw) -> usize {
    draw.layout.format(Slot::Position as usize).words()
}

/// Whether colours of a draw, but for lighting, follow from its place in eye space.
fn follows_eye(state: &FixedState) -> bool {
    /// Modes of texture generation up to this one know object space alone.
    const OBJECT_LINEAR: u32 = 1;
    let words = &state.words;
    let follows = |unit: &UnitWords| {
        let modes = [unit.gen_s(), unit.gen_t(), unit.gen_r(), unit.gen_q()];
        unit.target() != 0 && modes.iter().any(|mode| *mode > OBJECT_LINEAR)
    };
    words.global.fog_mode() != 0 || words.units.iter().any(follows)
}

fn directions(frame: &Frame, draw: &Draw, model: &DMat4) -> Vec<Vec3> {
    let (words, indices) = frame.geometry(draw);
    let reader = PositionReader::new(words, draw);
    let step = indices.len().div_ceil(WATCHED).max(1);
    let seen = |index: &u32| {
        let position = Vec3::from(reader.position(*index)).as_dvec3();
        let direction = model.transform_point3(position).normalize_or_zero();
        if direction.is_finite() { direction } else { DVec3::ZERO }.as_vec3()
    };
    indices.iter().step_by(step).map(seen).collect()
}

fn block<T: bytemuck::Pod>(hasher: &mut Xxh3, table: &[T], index: u32) {
    if let Some(block) = table.get(index as usize) {
        hasher.update(bytemuck::bytes_of(block));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{FrameBuilder, RED};

    fn key(change: impl FnOnce(&mut FrameBuilder), turned: f64, open: f32) -> SkyKey {
        let mut builder = FrameBuilder::new(8, 8);
        change(&mut builder);
        builder.triangle([[1.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, -3.0]], RED);
        let painted = PaintedSky {
            draws: Vec::new(),
            cleared: Vec3::ZERO,
            mean: Vec3::ZERO,
            open: Vec3::splat(open),
            least: Vec3::ZERO,
        };
        let mut key = SkyKey::new(0, &painted);
        let (_, draw) = builder.frame.draws().next().unwrap();
        key.add(&builder.frame, draw, [&DMat4::from_rotation_y(turned), &DMat4::IDENTITY], &Recovery::new());
        key
    }

    #[test]
    fn rounding_changes_nothing_and_what_is_seen_does() {
        let still = key(|_| {}, 0.0, 0.5);
        let looks_same = |other: SkyKey| still.looks_like(&other);
        assert!(looks_same(key(|_| {}, 1e-5, 0.5001)));
        assert!(!looks_same(key(|_| {}, 0.01, 0.5)));
        assert!(!looks_same(key(|_| {}, 0.0, 0.6)));
        assert!(!looks_same(key(|builder| builder.fixed.raster.color_mask = 7, 0.0, 0.5)));
        assert!(!looks_same(key(|builder| builder.environment.fog_density = 2.0, 0.0, 0.5)));
    }

    #[test]
    fn where_the_camera_looks_matters_only_to_what_depends_on_it() {
        let moved = |builder: &mut FrameBuilder| builder.transform.modelview[3] = [1.0, 2.0, 3.0, 1.0];
        assert!(key(|_| {}, 0.0, 0.5).looks_like(&key(moved, 0.0, 0.5)));
        let fog = |builder: &mut FrameBuilder| builder.fixed.words.global.set_fog_mode(1);
        let moved_fog = |builder: &mut FrameBuilder| {
            moved(builder);
            fog(builder);
        };
        assert!(!key(fog, 0.0, 0.5).looks_like(&key(moved_fog, 0.0, 0.5)));
    }
}
