//! The sky as rays see it, where the program draws one about the eye: its draws, drawn again on the six sides of a cube in
//! the world's axes, and from that a map of linear light with coarser and coarser levels.
//!
//! It is drawn when it looks otherwise than before, so that still skies cost nothing. What no draw covers was drawn in an
//! earlier frame, or is what was cleared to, or the mean. Draws keep their order, blending and alpha test; their depth is left out.

use afterglow_frame_graph::ResourceState;
use afterglow_gl::frame::{
    Blend, BlendEquation, BlendFactor, Cull, Draw, FixedState, RasterState, Transform,
};
use afterglow_gpu::{BufferDesc, BufferKind, Gpu, GpuError, ImageDesc, vk};

use afterglow_records::{DrawRecord, FrameRecord, SKY_EDGE, SKY_LEVELS, ViewRecord};
use afterglow_scene::{Camera, PaintedSky, Recovery, Scene, SkyDraw};
use bytemuck::Zeroable;
use glam::{DMat3, DMat4, Vec3};

use super::buffers::{Tracked, TrackedImage};
use super::gather::TraceInput;
use super::options::SkyChoice;
use super::schedule::SkyNews;
use super::sky_key::{SkyKey, draws_texels};
use crate::target::COLOR_FORMAT;

/// Sides of a cube.
pub(crate) const SIDES: u32 = 6;
/// Bytes of a texel of the map: four f32.
const TEXEL_BYTES: u64 = 16;
/// Least mean of a colour that can be scaled to another one.
const LEAST_MEAN: f32 = 1.0 / 255.0;

/// A draw of the sky, to be drawn on the cube.
#[derive(Debug)]
pub(crate) struct CubeDraw {
    /// Its number among the frame's draws.
    pub(crate) number: usize,
    pub(crate) draw: Draw,
    pub(crate) state: FixedState,
}

/// What is recorded when the sky is drawn.
#[derive(Debug)]
pub(crate) struct PreparedSky {
    /// Address of a frame's record for these draws alone, numbered in their order.
    pub(crate) record: u64,
    pub(crate) draws: Vec<CubeDraw>,
    pub(crate) cleared: Vec3,
    pub(crate) open: Vec3,
    /// The map holds what earlier frames have drawn.
    pub(crate) remembers: bool,
}

/// A frame's sky.
#[derive(Debug, Default)]
pub(crate) struct SkyUse {
    /// Address of the map; 0 if the sky is the same everywhere.
    map: u64,
    least: Vec3,
    scale: Vec3,
    /// Which drawing of the sky it is.
    pub(crate) drawing: u32,
    pub(crate) prepared: Option<PreparedSky>,
}

impl SkyUse {
    pub(crate) fn is_mapped(&self) -> bool {
        self.map != 0
    }

    /// What must be done for it.
    pub(crate) fn news(&self) -> SkyNews {
        match &self.prepared {
            None => SkyNews::None,
            Some(sky) if sky.remembers => SkyNews::Changes,
            Some(_) => SkyNews::Begins,
        }
    }

    /// Tells a view's record.
    pub(crate) fn write(&self, record: &mut ViewRecord) {
        record.sky_map = self.map;
        record.sky_least = self.least.to_array();
        record.sky_scale = self.scale.to_array();
    }
}

/// The map, and what it is made from.
pub(crate) struct SkyMap {
    /// What was drawn, a layer a side.
    pub(crate) sides: TrackedImage,
    /// The same as bytes.
    pub(crate) drawn: Tracked,
    pub(crate) texels: Tracked,
    /// All sides are drawn at once.
    pub(crate) is_multiview: bool,
    /// What the map shows; none before it was drawn, and after a frame that was lost.
    held: Option<SkyKey>,
    /// Times that it was drawn.
    drawings: u32,
}

impl SkyMap {
    pub(crate) fn new(gpu: &Gpu, is_multiview: bool) -> Result<Self, GpuError> {
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC;
        let sides = ImageDesc::d2("sky", COLOR_FORMAT, [SKY_EDGE; 2], usage).layers(SIDES);
        let buffer = |name, bytes| {
            Ok::<_, GpuError>(Tracked {
                buffer: gpu.create_buffer(&BufferDesc::new(name, BufferKind::Device, bytes))?,
                state: ResourceState::UNDEFINED,
            })
        };
        Ok(Self {
            sides: TrackedImage { image: gpu.create_image(&sides)?, state: ResourceState::UNDEFINED },
            drawn: buffer("drawn sky", u64::from(SIDES * SKY_EDGE * SKY_EDGE) * 4)?,
            texels: buffer("sky map", map_bytes())?,
            is_multiview,
            held: None,
            drawings: 0,
        })
    }

    /// What was drawn last may not be there.
    pub(crate) fn forget(&mut self) {
        self.held = None;
    }

    /// Times that the sky was drawn.
    pub(crate) fn drawings(&self) -> u32 {
        self.drawings
    }
}

/// Finds what a frame's sky is to rays, and what must be drawn for it.
pub(crate) fn prepare(
    map: &mut Option<SkyMap>,
    recovery: &Recovery,
    input: &mut TraceInput<'_>,
    scene: &Scene,
    camera: &Camera,
    choice: SkyChoice,
) -> Result<SkyUse, GpuError> {
    let painted = scene.painted_sky.as_ref().filter(|_| choice == SkyChoice::Cube);
    let found = painted.and_then(|painted| Some((painted, scale_of(painted, scene.sky)?)));
    let Some((painted, scale)) = found else { return Ok(SkyUse::default()) };
    let axes = DMat4::from_mat3(DMat3::from_mat4(camera.view).transpose());
    let placed = placed(input, painted, &axes);
    if placed.is_empty() {
        return Ok(SkyUse::default());
    }
    let map = match map {
        Some(map) => map,
        None => map.insert(SkyMap::new(input.gpu, input.gpu.features().multiview)?),
    };
    let mut key = SkyKey::new(scene.epoch, painted);
    for (number, model, draw) in &placed {
        debug_assert!(input.scratch.commands[*number].index_count > 0, "left out draws are not placed");
        key.add(input.frame, draw, [model, &axes], recovery);
    }
    let draws: Vec<_> = placed.iter().map(|(_, _, draw)| *draw).collect();
    let is_held = map.held.as_ref().is_some_and(|held| held.looks_like(&key));
    let mut prepared = None;
    if !is_held || draws_texels(input.frame, &draws) {
        let remembers = map.held.as_ref().is_some_and(|held| held.shares_world(&key));
        prepared = Some(prepared_sky(input, painted, &placed, remembers)?);
        map.held = Some(key);
        map.drawings = map.drawings.wrapping_add(1);
    }
    let (least, drawing) = (painted.least, map.drawings);
    Ok(SkyUse { map: map.texels.buffer.address(), least, scale, drawing, prepared })
}

/// What makes a painted sky's light that of the scene; none if it is of no such colour.
fn scale_of(painted: &PaintedSky, sky: Vec3) -> Option<Vec3> {
    let shown = painted.mean.max(painted.least);
    if shown == sky {
        return Some(Vec3::ONE);
    }
    (shown.min_element() >= LEAST_MEAN).then(|| sky / shown)
}

/// The sky's draws that are there, with their numbers among the frame's draws, and the way from their coordinates to the
/// world's axes about the eye.
fn placed(input: &TraceInput<'_>, painted: &PaintedSky, axes: &DMat4) -> Vec<(usize, DMat4, Draw)> {
    let mut sky = painted.draws.iter().peekable();
    let mut placed = Vec::new();
    for (number, (operation, draw)) in input.frame.draws().enumerate() {
        let here = |of: &&SkyDraw| of.operation as usize == operation;
        let Some(of) = sky.next_if(here) else { continue };
        let state = input.frame.fixed.get(draw.fixed as usize);
        let is_seen =
            state.is_some_and(|s| s.raster.cull != Cull::FrontAndBack && s.raster.logic_op.is_none());
        if is_seen && input.scratch.commands[number].index_count > 0 {
            placed.push((number, *axes * of.eye, *draw));
        }
    }
    placed
}

/// Uploads what draws on the cube read in place of the frame's own records.
fn prepared_sky(
    input: &mut TraceInput<'_>,
    painted: &PaintedSky,
    placed: &[(usize, DMat4, Draw)],
    remembers: bool,
) -> Result<PreparedSky, GpuError> {
    let frame = input.frame;
    let mut transforms = Vec::with_capacity(placed.len());
    let mut records = Vec::with_capacity(placed.len());
    let mut draws = Vec::with_capacity(placed.len());
    for (index, (number, model, draw)) in placed.iter().enumerate() {
        let record = input.scratch.draws[*number];
        let own = frame.transforms.get(record.transform as usize).copied().unwrap_or(Transform::zeroed());
        transforms.push(Transform { modelview_projection: model.as_mat4().to_cols_array_2d(), ..own });
        records.push(DrawRecord { transform: index as u32, ..record });
        let state = cube_state(&frame.fixed[draw.fixed as usize], is_mirrored(&own));
        draws.push(CubeDraw { number: *number, draw: *draw, state });
    }
    let arena = &mut *input.arena;
    let record = FrameRecord {
        draws: arena.push_table(&records)?.address,
        transforms: arena.push_table(&transforms)?.address,
        ..input.uploaded.record
    };
    let record = arena.push(bytemuck::bytes_of(&record))?.address;
    Ok(PreparedSky { record, draws, cleared: painted.cleared, open: painted.open, remembers })
}

/// A draw's state on the cube: as it is, but for depth, stencil and clip planes; and alpha becomes 0 where it draws.
fn cube_state(state: &FixedState, is_mirrored: bool) -> FixedState {
    let mut words = state.words;
    words.global.set_clip_planes(0);
    let raster = &state.raster;
    let replace = Blend {
        rgb: (BlendFactor::One, BlendFactor::Zero),
        alpha: (BlendFactor::Zero, BlendFactor::Zero),
        equation_rgb: BlendEquation::Add,
        equation_alpha: BlendEquation::Add,
        constant: Default::default(),
    };
    let blend = raster.blend.unwrap_or(replace);
    let raster = RasterState {
        blend: Some(Blend { alpha: replace.alpha, equation_alpha: BlendEquation::Add, ..blend }),
        color_mask: raster.color_mask | 8,
        depth: None,
        stencil: None,
        depth_bias: None,
        front_ccw: raster.front_ccw != is_mirrored,
        ..*raster
    };
    FixedState { words, raster }
}

/// Whether a projection turns front faces over, as that of a cube's side does not.
fn is_mirrored(transform: &Transform) -> bool {
    let rows =
        DMat4::from_cols_array_2d(&transform.projection.map(|column| column.map(f64::from))).transpose();
    let [right, up, away] = [rows.x_axis, rows.y_axis, rows.w_axis].map(|row| row.truncate());
    right.cross(up).dot(away) > 0.0
}

/// Bytes of all levels, borders counted. Its twin is `sky_texel` in sky.glsl.
fn map_bytes() -> u64 {
    let texels = |level: u32| u64::from((SKY_EDGE >> level) + 2).pow(2);
    u64::from(SIDES) * (0..SKY_LEVELS).map(texels).sum::<u64>() * TEXEL_BYTES
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_lie_where_shaders_look_for_them() {
        // As `sky_texel` reckons.
        let before = |level: u32| {
            let edge = SKY_EDGE >> level;
            (SKY_EDGE * SKY_EDGE - edge * edge) / 3 * 4 + 8 * (SKY_EDGE - edge) + 4 * level
        };
        let mut sum = 0;
        for level in 0..SKY_LEVELS {
            assert_eq!(before(level), sum);
            sum += ((SKY_EDGE >> level) + 2).pow(2);
        }
        assert_eq!(map_bytes(), u64::from(SIDES * sum) * TEXEL_BYTES);
    }

    #[test]
    fn a_sky_is_scaled_to_what_was_found_if_it_has_a_colour() {
        let painted = |mean: Vec3| PaintedSky {
            draws: Vec::new(),
            cleared: Vec3::ZERO,
            mean,
            open: mean,
            least: Vec3::new(0.0, 0.0, 0.1),
        };
        let dusk = painted(Vec3::new(0.4, 0.2, 0.05));
        assert_eq!(scale_of(&dusk, Vec3::new(0.4, 0.2, 0.1)), Some(Vec3::ONE));
        assert_eq!(scale_of(&dusk, Vec3::new(0.2, 0.2, 0.2)), Some(Vec3::new(0.5, 1.0, 2.0)));
        assert_eq!(scale_of(&dusk, Vec3::ZERO), Some(Vec3::ZERO));
        assert_eq!(scale_of(&painted(Vec3::ZERO), Vec3::ZERO), None);
        assert_eq!(scale_of(&painted(Vec3::ZERO), Vec3::ONE), None);
    }

    #[test]
    fn a_usual_projection_is_not_mirrored() {
        let with = |x: f32, w: f32| {
            let mut transform = Transform::zeroed();
            transform.projection = [[x, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, -1.0, w], [0.0; 4]];
            transform
        };
        assert!(!is_mirrored(&with(1.0, -1.0)));
        assert!(is_mirrored(&with(-1.0, -1.0)));
        assert!(is_mirrored(&with(1.0, 1.0)));
    }
}
