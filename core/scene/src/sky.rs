//! What is behind everything: its mean colour, and the draws that show it.

use std::f32::consts::PI;

use afterglow_gl::frame::{BlendFactor, EnvMode, Frame, Slot};
use glam::{DMat4, DVec3, Vec3, Vec4};

use crate::color::linear_from_srgb;
use crate::draws::{DrawFacts, TransformFacts};
use crate::geometry::{Attribute, mean_color};
use crate::images::Images;
use crate::types::{Class, PaintedSky, SkyDraw, Verdict};

/// Triangles of a draw whose solid angle is measured, at most.
const MEASURED: usize = 256;

/// Linear RGB of the sky: what its draws make of the colour that the view was cleared to, on the mean over
/// the directions that they cover; `None` when it is neither drawn nor cleared.
pub fn color(
    frame: &Frame,
    draws: &[DrawFacts],
    transforms: &[TransformFacts],
    verdicts: &[Verdict],
    images: &Images,
    background: Option<[f32; 4]>,
) -> Option<Vec3> {
    let mut sky = Painted { mean: Vec3::ZERO, covered: 0.0 };
    for (facts, verdict) in draws.iter().zip(verdicts) {
        if verdict.class == Class::Sky && facts.writes_color && facts.triangles > 0 {
            let angle = solid_angle(frame, facts, &transforms[facts.transform]) as f32;
            let blend = frame.fixed[facts.draw.fixed as usize].raster.blend;
            sky.paint(shown(frame, facts, images), (angle / (4.0 * PI)).min(1.0), blend.map(|b| b.rgb));
        }
    }
    let cleared = background.map(|[r, g, b, _]| Vec3::new(r, g, b));
    sky.over(cleared).map(linear_from_srgb)
}

/// The brightest colour that counts as black, sRGB.
const BLACK: f32 = 0.05;

/// The sky as it is seen in each direction, if the program draws one about the eye: pictures that are drawn flat behind the
/// world have no directions, points and lines no size. `mean` is what [`color`] found.
pub fn painted(
    draws: &[DrawFacts],
    transforms: &[TransformFacts],
    verdicts: &[Verdict],
    background: Option<[f32; 4]>,
    mean: Vec3,
) -> Option<PaintedSky> {
    let sky = draws.iter().zip(verdicts).filter(|(facts, verdict)| {
        let transform = &transforms[facts.transform];
        let is_about_eye = transform.perspective.is_some() && transform.sound;
        verdict.class == Class::Sky && facts.writes_color && facts.triangles > 0 && is_about_eye
    });
    let draws: Vec<_> = sky
        .map(|(facts, _)| SkyDraw { operation: facts.operation, eye: transforms[facts.transform].eye })
        .collect();
    let cleared = background.map_or(Vec3::ZERO, |[r, g, b, _]| Vec3::new(r, g, b));
    // Black is what nobody has thought of, where a sky is drawn over it.
    let open = if cleared.max_element() > BLACK { linear_from_srgb(cleared) } else { mean };
    (!draws.is_empty()).then_some(PaintedSky { draws, cleared, mean, open, least: Vec3::ZERO })
}

/// Mean colour (sRGB) of the directions painted so far, and their share of all directions.
struct Painted {
    mean: Vec3,
    covered: f32,
}

impl Painted {
    /// Paints a colour over a share of the directions, wherever they are.
    fn paint(&mut self, color: Vec4, share: f32, blend: Option<(BlendFactor, BlendFactor)>) {
        use BlendFactor as F;
        let (rgb, below) = (color.truncate(), self.mean);
        let over = share / self.covered.max(share).max(f32::MIN_POSITIVE);
        match blend {
            None | Some((F::One, F::Zero)) => self.cover(rgb, share),
            Some((F::SourceAlpha | F::One, F::OneMinusSourceAlpha)) => self.cover(rgb, share * color.w),
            Some((F::DestinationColor, F::Zero) | (F::Zero, F::SourceColor)) => {
                self.mean = below.lerp(below * rgb, over);
            }
            Some((F::DestinationColor, F::SourceColor)) => {
                self.mean = below.lerp(2.0 * below * rgb, over).min(Vec3::ONE);
            }
            Some((F::Zero, F::OneMinusSourceColor)) => {
                self.mean = below.lerp(below * (1.0 - rgb), over);
            }
            Some((F::One, F::One)) => self.mean = (below + over * rgb).min(Vec3::ONE),
            Some((F::SourceAlpha, F::One)) => self.mean = (below + over * color.w * rgb).min(Vec3::ONE),
            Some(_) => {}
        }
    }

    fn cover(&mut self, rgb: Vec3, share: f32) {
        let kept = self.covered * (1.0 - share);
        let covered = kept + share;
        if covered > 0.0 {
            self.mean = (self.mean * kept + rgb * share) / covered;
            self.covered = covered;
        }
    }

    /// The colour with what it was painted on. A quarter of all directions counts as a whole sky: there
    /// is mostly ground below.
    fn over(&self, cleared: Option<Vec3>) -> Option<Vec3> {
        match cleared {
            Some(cleared) => Some(cleared.lerp(self.mean, (4.0 * self.covered).min(1.0))),
            None => (self.covered > 0.0).then_some(self.mean),
        }
    }
}

/// Mean colour that an unlit draw shows (sRGB): that of its vertices, times the textures'.
fn shown(frame: &Frame, facts: &DrawFacts, images: &Images) -> Vec4 {
    let fixed = &frame.fixed[facts.draw.fixed as usize];
    let bindings = frame.bindings.get(facts.draw.bindings as usize);
    let mut color = mean_color(frame, facts.draw).clamp(Vec4::ZERO, Vec4::ONE);
    for (unit, words) in fixed.words.units.iter().enumerate().filter(|(_, u)| u.target() != 0) {
        let image = bindings.and_then(|b| b[unit]).and_then(|b| images.get(b.image));
        let Some(texel) = image.and_then(|i| i.mean()) else { continue };
        let replaces = [EnvMode::Replace, EnvMode::Decal].iter().any(|&m| m as u32 == words.env_mode());
        color = if replaces { texel } else { color * texel };
    }
    color
}

/// Solid angle that a draw's triangles fill about the eye, steradians. A draw in orthographic projection
/// counts as if it filled all directions.
fn solid_angle(frame: &Frame, facts: &DrawFacts, transform: &TransformFacts) -> f64 {
    if transform.perspective.is_none() {
        return 4.0 * std::f64::consts::PI;
    }
    let eye = transform.eye;
    let triangles = facts.triangles as usize;
    let measured = triangles.min(MEASURED);
    let Some(positions) = Attribute::of(frame, facts.draw, Slot::Position as usize) else { return 0.0 };
    let corner = |i: usize| Some(eye_position(eye, positions.get(i)?.truncate()));
    let angles = (0..measured).filter_map(|k| {
        let first = 3 * (k * triangles / measured);
        Some(triangle_solid_angle([corner(first)?, corner(first + 1)?, corner(first + 2)?]))
    });
    angles.filter(|angle| angle.is_finite()).sum::<f64>() * triangles as f64 / measured.max(1) as f64
}

fn eye_position(eye: DMat4, position: Vec3) -> DVec3 {
    eye.transform_point3(position.as_dvec3())
}

/// Van Oosterom and Strackee, *The Solid Angle of a Plane Triangle* (1983).
fn triangle_solid_angle(corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| corner.normalize_or_zero());
    let volume = a.dot(b.cross(c)).abs();
    2.0 * volume.atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_octant_is_an_eighth_of_the_sphere() {
        let angle = triangle_solid_angle([DVec3::X * 3.0, DVec3::Y, DVec3::Z * 9.0]);
        assert!((angle - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    }
}
