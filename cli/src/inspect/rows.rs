//! A frame's draws as rows of a table.

use std::collections::BTreeMap;
use std::io::{self, Write};

use afterglow_gl::frame::{Bindings, Compare, Draw, FixedState, Frame, TextureBinding, Viewport};
use afterglow_scene::{Recovery, Scene, Verdict};
use serde::Serialize;

use crate::figures::{Camera, Light, Relight};

/// What a frame's draws are taken for.
#[derive(Debug, Serialize)]
pub struct FrameRows {
    index: u64,
    camera: Camera,
    triangles: BTreeMap<&'static str, u64>,
    lights: Vec<Light>,
    /// Once the sources of baked light were searched.
    relight: Option<Relight>,
    /// Linear.
    sky: [f32; 3],
    /// Draws that show it about the eye, each direction in its own colour.
    sky_draws: usize,
    /// Its colours are baked light.
    baked: bool,
    draws: Vec<Row>,
}

/// What a draw is taken for.
#[derive(Debug, Serialize)]
struct Row {
    /// Among the frame's draws.
    index: usize,
    class: &'static str,
    /// 16 hexadecimal digits.
    id: String,
    reason: &'static str,
    triangles: u32,
    /// Content of each unit's texture, 16 hexadecimal digits; `?` of one that is no longer known.
    textures: Vec<String>,
    /// Of a layer: the draw below.
    base: Option<usize>,
    /// Where its model matrix puts the origin, world space.
    translation: [f32; 3],
    /// Its colours are baked light.
    baked: bool,
    /// What the program's state says, in words.
    state: String,
}

impl FrameRows {
    /// The rows of a frame.
    pub fn of(index: u64, frame: &Frame, scene: &Scene, recovery: &Recovery) -> FrameRows {
        let operations: Vec<u32> = scene.verdicts.iter().map(|verdict| verdict.operation).collect();
        let place = |operation| operations.binary_search(&operation).ok();
        let row = |(index, ((_, draw), verdict)): (usize, ((usize, &Draw), &Verdict))| Row {
            index,
            class: verdict.class.name(),
            id: format!("{:016x}", verdict.object),
            reason: verdict.reason,
            triangles: verdict.triangles,
            textures: textures(frame, draw, recovery),
            base: verdict.base.and_then(place),
            translation: verdict.model.w_axis.truncate().into(),
            baked: verdict.baked,
            state: state(frame, draw),
        };
        FrameRows {
            index,
            camera: scene.camera.as_ref().map(Camera::from).unwrap_or_default(),
            triangles: scene.triangles().named().into(),
            lights: scene.lights.iter().map(Light::from).collect(),
            relight: scene.relight.as_ref().map(Relight::from),
            sky: scene.sky.into(),
            sky_draws: scene.painted_sky.as_ref().map_or(0, |sky| sky.draws.len()),
            baked: scene.baked,
            draws: frame.draws().zip(&scene.verdicts).enumerate().map(row).collect(),
        }
    }

    /// Writes a table.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let counts = self.triangles.iter().filter(|(_, n)| **n > 0).map(|(name, n)| format!("{name} {n}"));
        writeln!(out, "frame {}: {}", self.index, counts.collect::<Vec<_>>().join(", "))?;
        match &self.camera.view {
            Some(view) => writeln!(out, "  view {}", rows_of(view))?,
            None => writeln!(out, "  no camera")?,
        }
        if let Some(relight) = &self.relight {
            writeln!(out, "  {relight}")?;
        }
        for light in &self.lights {
            writeln!(out, "  {light}")?;
        }
        let [red, green, blue] = self.sky;
        let drawn = if self.sky_draws > 0 { format!(", {} draws", self.sky_draws) } else { String::new() };
        writeln!(out, "  sky {red:.3} {green:.3} {blue:.3}{drawn}")?;
        writeln!(
            out,
            "{:>5} {:<11} {:<16} {:>9} {:>5}  {:<29} {:<16}  reason; state",
            "draw", "class", "id", "triangles", "base", "model at", "textures"
        )?;
        self.draws.iter().try_for_each(|row| row.write(out))
    }
}

impl Row {
    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let [x, y, z] = self.translation;
        let base = self.base.map_or(String::new(), |base| base.to_string());
        let translation =
            if self.translation == [0.0; 3] { "-".into() } else { format!("{x:.2} {y:.2} {z:.2}") };
        writeln!(
            out,
            "{:>5} {:<11} {} {:>9} {:>5}  {:<29} {:<16}  {}; {}{}",
            self.index,
            self.class,
            self.id,
            self.triangles,
            base,
            translation,
            if self.textures.is_empty() { "-".into() } else { self.textures.join("+") },
            self.reason,
            if self.baked { "baked, " } else { "" },
            self.state
        )
    }
}

/// A matrix (column-major) by rows.
fn rows_of(matrix: &[f64; 16]) -> String {
    let row = |r: usize| (0..4).map(|c| format!("{:.4}", matrix[4 * c + r])).collect::<Vec<_>>().join(" ");
    [0, 1, 2].map(row).join(" | ")
}

fn textures(frame: &Frame, draw: &Draw, recovery: &Recovery) -> Vec<String> {
    let units = &frame.fixed[draw.fixed as usize].words.units;
    let bindings: Bindings = frame.bindings.get(draw.bindings as usize).copied().unwrap_or_default();
    let name = |binding: &Option<TextureBinding>| {
        let image = binding.and_then(|binding| recovery.image(binding.image));
        image.map_or_else(|| "?".into(), |image| format!("{:016x}", image.content()))
    };
    let used = units.iter().zip(&bindings).filter(|(unit, _)| unit.target() != 0);
    used.map(|(_, binding)| name(binding)).collect()
}

/// What of a draw's state is not as usual.
fn state(frame: &Frame, draw: &Draw) -> String {
    let FixedState { words, raster } = &frame.fixed[draw.fixed as usize];
    let Viewport { rect, depth_range, .. } = frame.viewports[draw.viewport as usize];
    let mut parts = vec![format!("{:?}", draw.topology).to_lowercase()];
    let mut note = |holds: bool, text: &dyn Fn() -> String| parts.extend(holds.then(text));
    note(words.global.lighting() != 0, &|| format!("lights {:b}", words.global.lights()));
    note(true, &|| match raster.depth {
        None => "no depth test".into(),
        Some(depth) => format!("depth {:?}{}", depth.compare, if depth.write { "" } else { " unwritten" }),
    });
    note(raster.blend.is_some(), &|| {
        let factors = raster.blend.map(|blend| blend.rgb);
        factors.map_or(String::new(), |(source, below)| format!("blend {source:?} {below:?}"))
    });
    let alpha = words.global.alpha_func();
    note(alpha != Compare::Always as u32, &|| format!("alpha test {alpha}"));
    note(raster.stencil.is_some(), &|| "stencil".into());
    note(raster.color_mask & 7 != 7, &|| format!("colour mask {:04b}", raster.color_mask));
    note(words.global.clip_planes() != 0, &|| "clip planes".into());
    note(raster.depth_bias.is_some(), &|| "polygon offset".into());
    note(depth_range != [0.0, 1.0], &|| format!("depth range {depth_range:?}"));
    let whole = (rect.x, rect.y) == (0, 0) && (rect.width as u32, rect.height as u32) == frame.size;
    note(!whole, &|| format!("viewport {},{} {}x{}", rect.x, rect.y, rect.width, rect.height));
    parts.join(", ")
}
