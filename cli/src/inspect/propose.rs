//! A profile to start from: what a trace's draws are taken for now, texture by texture, as comments.
//!
//! The file that is written is a profile that changes nothing. Each rule in it says what recovery found, behind `#`, so
//! that one takes the `#` away and changes the word that is wrong.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use afterglow_gl::frame::{Frame, ImageShape};
use afterglow_scene::{Class, LightOrigin, LightShape, Recovery, Scene, SceneLight};
use afterglow_trace::TraceReader;

use crate::failure::Failure;

/// Textures that are listed, at most: those of most triangles.
const MOST_TEXTURES: usize = 500;

/// What is known of the textures of all frames asked for.
#[derive(Default)]
pub struct Proposal {
    frames: u32,
    triangles: u64,
    textures: BTreeMap<u64, Texture>,
    last: Scene,
}

struct Texture {
    shape: ImageShape,
    triangles: u64,
    draws: u32,
    /// Triangles and reason of the last draw, by class's place in [`Class::ALL`].
    classes: BTreeMap<usize, (u64, &'static str)>,
}

impl Proposal {
    /// Adds a frame.
    pub fn add(&mut self, frame: &Frame, scene: &Scene, recovery: &Recovery) {
        for ((_, draw), verdict) in frame.draws().zip(&scene.verdicts) {
            self.triangles += u64::from(verdict.triangles);
            let class = Class::ALL.iter().position(|&class| class == verdict.class).unwrap_or_default();
            let units = &frame.fixed[draw.fixed as usize].words.units;
            let bindings = frame.bindings.get(draw.bindings as usize).copied().unwrap_or_default();
            let used = units.iter().zip(bindings).filter(|(unit, _)| unit.target() != 0);
            let mut images: Vec<_> = used.filter_map(|(_, binding)| recovery.image(binding?.image)).collect();
            images.dedup_by_key(|image| image.content());
            for image in images {
                let texture = self.textures.entry(image.content()).or_insert_with(|| Texture {
                    shape: *image.shape(),
                    triangles: 0,
                    draws: 0,
                    classes: BTreeMap::new(),
                });
                texture.triangles += u64::from(verdict.triangles);
                texture.draws += 1;
                let (sum, reason) = texture.classes.entry(class).or_default();
                *sum += u64::from(verdict.triangles);
                *reason = verdict.reason;
            }
        }
        self.frames += 1;
        self.last = scene.clone();
    }

    /// Writes the profile of the program that `trace` is of.
    pub fn write(&self, trace: &Path, path: &Path) -> Result<(), Failure> {
        let program = program(trace);
        std::fs::write(path, self.text(&program)).map_err(|error| Failure::output(path, error))
    }

    fn text(&self, program: &str) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = self.head(&mut text, program);
        let _ = self.lights(&mut text);
        let _ = self.rules(&mut text);
        text
    }

    fn head(&self, text: &mut String, program: &str) -> std::fmt::Result {
        writeln!(text, "# What Afterglow takes this program's draws for: means of {} frames.", self.frames)?;
        writeln!(
            text,
            "# Nothing here is in force. Take the '# ' away from what you want to say, and change it;"
        )?;
        writeln!(text, "# docs/profiles.md tells of all keys.\n")?;
        writeln!(text, "name = \"{program}\"\nexecutables = [\"{program}\"]\n")?;
        writeln!(text, "# How many of its units are a metre:\n# units_per_metre = 1.0\n")
    }

    fn lights(&self, text: &mut String) -> std::fmt::Result {
        writeln!(
            text,
            "# Lights that were found in the last frame, in world space. To have others instead:"
        )?;
        writeln!(text, "# [lights]\n# found = \"off\"\n")?;
        for light in &self.last.lights {
            write_light(text, light)?;
        }
        writeln!(text, "# The sky's mean colour, linear:\n# [sky]\n# color = {}\n", list(self.last.sky))
    }

    fn rules(&self, text: &mut String) -> std::fmt::Result {
        writeln!(text, "# Textures by their share of all triangles, and what their draws are taken for.\n")?;
        let mut textures: Vec<_> = self.textures.iter().collect();
        textures.sort_by_key(|(hash, texture)| (std::cmp::Reverse(texture.triangles), **hash));
        for (hash, texture) in textures.into_iter().take(MOST_TEXTURES) {
            self.rule(text, *hash, texture)?;
        }
        Ok(())
    }

    fn rule(&self, text: &mut String, hash: u64, texture: &Texture) -> std::fmt::Result {
        let Texture { shape, triangles, draws, classes } = texture;
        let percent = |part: u64, whole: u64| 100.0 * part as f64 / whole.max(1) as f64;
        writeln!(
            text,
            "# {:.1} % of the triangles, {:.1} draws a frame, {}x{} {:?}",
            percent(*triangles, self.triangles),
            f64::from(*draws) / f64::from(self.frames.max(1)),
            shape.width,
            shape.height,
            shape.base_format
        )?;
        for (class, (sum, reason)) in classes {
            writeln!(text, "#   {} {:.0} %: {reason}", Class::ALL[*class].name(), percent(*sum, *triangles))?;
        }
        let heaviest = classes.iter().max_by_key(|(_, (sum, _))| *sum).map_or(0, |(class, _)| *class);
        writeln!(text, "# [[class]]\n# is = \"{}\"", Class::ALL[heaviest].name())?;
        writeln!(text, "# when = {{ textures = [\"{hash:016x}\"] }}\n")
    }
}

/// The program that a trace is of: its file's name, as far as it can stand in any text.
fn program(trace: &Path) -> String {
    let reader = TraceReader::open(trace).ok();
    let properties = reader.as_ref().map(TraceReader::properties).unwrap_or_default();
    let known =
        properties.iter().find(|(name, _)| name == "process.name").map(|(_, program)| Path::new(program));
    let name = known.and_then(Path::file_name).or(trace.file_stem()).unwrap_or_default();
    let plain = |c: &char| c.is_ascii_alphanumeric() || "-_. +".contains(*c);
    name.to_string_lossy().chars().filter(plain).take(100).collect()
}

fn write_light(text: &mut String, light: &SceneLight) -> std::fmt::Result {
    match light.origin {
        LightOrigin::Fallback => writeln!(text, "# Nothing shines; a sun was made up:")?,
        origin => writeln!(text, "# {origin}:")?,
    }
    match light.shape {
        LightShape::Directional { to_light, angular_radius } => writeln!(
            text,
            "# [[light]]\n# kind = \"sun\"\n# to_light = {}\n# color = {}\n# diameter = {:.3}\n",
            list(to_light),
            list(light.color),
            2.0 * angular_radius.to_degrees()
        ),
        LightShape::Point { position, radius, .. } => writeln!(
            text,
            "# [[light]]\n# kind = \"point\"\n# position = {}\n# color = {}\n# radius = {radius:.4}\n# reach = 1.0\n",
            list(position),
            list(light.color)
        ),
    }
}

fn list(vector: impl Into<[f32; 3]>) -> String {
    let [x, y, z] = vector.into();
    format!("[{x:.4}, {y:.4}, {z:.4}]")
}

#[cfg(test)]
mod tests {
    use afterglow_scene::{Profile, Verdict};
    use glam::Vec3;

    use super::*;

    fn proposal() -> Proposal {
        let shape = ImageShape {
            dimension: afterglow_gl::frame::Dimension::D2,
            width: 64,
            height: 32,
            depth: 1,
            levels: 1,
            format: afterglow_gl::frame::TexelFormat::Rgba8,
            base_format: afterglow_gl::frame::BaseFormat::Rgb,
        };
        let classes = [(0, (90, "drawn under the view")), (7, (10, "multiplies"))].into();
        let texture = Texture { shape, triangles: 100, draws: 3, classes };
        let lights = [
            LightShape::Directional { to_light: Vec3::Y, angular_radius: 0.02 },
            LightShape::Point { position: Vec3::X, radius: 0.5, attenuation: Vec3::X, spot: None },
        ];
        let lights = lights.map(|shape| SceneLight { shape, color: Vec3::ONE, origin: LightOrigin::Gl(0) });
        let last = Scene { lights: lights.into(), verdicts: Vec::<Verdict>::new(), ..Scene::default() };
        Proposal { frames: 2, triangles: 200, textures: [(7, texture)].into(), last }
    }

    #[test]
    fn a_proposal_is_a_profile_without_rules() {
        let text = proposal().text("game");
        let profile = Profile::parse("proposal", &text).unwrap();
        let empty = "name = 'game'\nexecutables = ['game']";
        assert_eq!(profile, Profile::parse("empty", empty).unwrap());
        assert!(text.contains("static 90 %: drawn under the view") && text.contains("50.0 %"), "{text}");
    }

    #[test]
    fn what_stands_behind_the_signs_can_be_put_in_force() {
        let keys =
            ["[", "is =", "when =", "kind =", "to_light =", "position =", "color =", "diameter =", "reach ="];
        let keys = || keys.iter().chain(&["radius =", "found =", "units_per_metre ="]);
        let text = proposal().text("game");
        let line = |line: &str| match line.strip_prefix("# ") {
            Some(rest) if keys().any(|key| rest.starts_with(key)) => format!("{rest}\n"),
            _ => format!("{line}\n"),
        };
        let in_force: String = text.lines().map(line).collect();
        let profile = Profile::parse("proposal", &in_force).unwrap();
        assert_ne!(profile, Profile::parse("proposal", &text).unwrap());
    }
}
