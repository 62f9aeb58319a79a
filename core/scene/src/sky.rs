//! The colour of what is behind everything.

use afterglow_gl::frame::{EnvMode, Frame};
use glam::Vec3;

use crate::color::linear_from_srgb;
use crate::draws::DrawFacts;
use crate::images::Images;
use crate::opacity::Mixing;
use crate::types::{Class, Verdict};

/// Linear RGB of the sky: the mean of opaque sky draws, else the colour the view was cleared to, if any.
pub fn color(
    frame: &Frame,
    draws: &[DrawFacts],
    verdicts: &[Verdict],
    images: &Images,
    background: Option<[f32; 4]>,
) -> Option<Vec3> {
    let (mut sum, mut weight) = (Vec3::ZERO, 0.0);
    for (facts, verdict) in draws.iter().zip(verdicts) {
        if verdict.class == Class::Sky && facts.mixing == Mixing::Opaque && facts.triangles > 0 {
            let share = facts.triangles as f32;
            sum += share * linear_from_srgb(shown(frame, facts, images));
            weight += share;
        }
    }
    let cleared = || background.map(|c| linear_from_srgb(Vec3::new(c[0], c[1], c[2])));
    if weight > 0.0 { Some(sum / weight) } else { cleared() }
}

/// Mean colour that an unlit draw shows (sRGB): that of its vertices, times the textures'.
fn shown(frame: &Frame, facts: &DrawFacts, images: &Images) -> Vec3 {
    let fixed = &frame.fixed[facts.draw.fixed as usize];
    let bindings = frame.bindings.get(facts.draw.bindings as usize);
    let mut color = facts.colors.mean.clamp(Vec3::ZERO, Vec3::ONE);
    for (unit, words) in fixed.words.units.iter().enumerate().filter(|(_, u)| u.target() != 0) {
        let image = bindings.and_then(|b| b[unit]).and_then(|b| images.get(b.image));
        let Some(texel) = image.and_then(|i| i.mean()) else { continue };
        let replaces = [EnvMode::Replace, EnvMode::Decal].iter().any(|&m| m as u32 == words.env_mode());
        color = if replaces { texel } else { color * texel };
    }
    color
}
