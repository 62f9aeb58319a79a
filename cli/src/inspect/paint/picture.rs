//! Flat colours made into a picture.

use afterglow_scene::{LightShape, Scene};
use glam::DVec4;

use super::colors::{BACKGROUND, Source};

/// Share of a colour that does not depend on what the program drew.
const LEAST: f32 = 0.5;
/// Share of pixels that are shown at full brightness.
const BRIGHTEST: f64 = 0.05;
/// Radius of a light's mark, pixels.
const MARK: i32 = 5;

/// Colours (RGBA bytes), shaded by the brightness of what the program drew.
pub fn shade(flat: &[u8], drawn: &[u8]) -> Vec<u8> {
    let white = white_point(drawn);
    let pixel = |(flat, drawn): (&[u8; 4], &[u8; 4])| {
        let [r, g, b, _] = *flat;
        if [r, g, b] == BACKGROUND {
            return [r, g, b, 255];
        }
        let level = LEAST + (1.0 - LEAST) * (luma(drawn) / white).min(1.0);
        let [r, g, b] = [r, g, b].map(|channel| (f32::from(channel) * level).round() as u8);
        [r, g, b, 255]
    };
    flat.as_chunks::<4>().0.iter().zip(drawn.as_chunks::<4>().0).flat_map(pixel).collect()
}

/// The brightness above which a picture's brightest pixels lie, at least that of a dark grey.
fn white_point(rgba: &[u8]) -> f32 {
    let mut counts = [0u64; 256];
    for pixel in rgba.as_chunks::<4>().0 {
        counts[luma(pixel) as usize] += 1;
    }
    let most = (BRIGHTEST * (rgba.len() / 4) as f64) as u64;
    let mut above = 0;
    let level = (0..256).rev().find(|&level| {
        above += counts[level];
        above > most
    });
    level.unwrap_or(255).max(48) as f32
}

/// Rec. 709, of sRGB bytes.
fn luma([r, g, b, _]: &[u8; 4]) -> f32 {
    0.2126 * f32::from(*r) + 0.7152 * f32::from(*g) + 0.0722 * f32::from(*b)
}

/// Marks where lights are that have a place.
pub fn mark_lights(rgba: &mut [u8], size: (u32, u32), scene: &Scene) {
    let Some(camera) = scene.camera else { return };
    let clip_from_world = camera.projection.as_dmat4() * camera.view;
    for light in &scene.lights {
        let LightShape::Point { position, .. } = light.shape else { continue };
        let clip: DVec4 = clip_from_world * position.as_dvec3().extend(1.0);
        let in_front = clip.w > 0.0 && (clip.z / clip.w).abs() <= 1.0;
        if in_front {
            let x = (0.5 + 0.5 * clip.x / clip.w) * f64::from(size.0);
            let y = (0.5 - 0.5 * clip.y / clip.w) * f64::from(size.1);
            mark(rgba, size, [x as i32, y as i32], Source::of(light.origin).color().1);
        }
    }
}

/// A disc with a dark rim.
fn mark(rgba: &mut [u8], (width, height): (u32, u32), [x, y]: [i32; 2], color: [u8; 3]) {
    for (dx, dy) in (-MARK..=MARK).flat_map(|dx| (-MARK..=MARK).map(move |dy| (dx, dy))) {
        let (px, py) = (x.saturating_add(dx), y.saturating_add(dy));
        let distance = dx * dx + dy * dy;
        let is_inside = px >= 0 && py >= 0 && (px as u32) < width && (py as u32) < height;
        if is_inside && distance <= MARK * MARK {
            let [r, g, b] = if distance > (MARK - 2) * (MARK - 2) { [0; 3] } else { color };
            let start = 4 * (py as usize * width as usize + px as usize);
            if let Some(pixel) = rgba.get_mut(start..start + 4) {
                pixel.copy_from_slice(&[r, g, b, 255]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_brightest_keep_their_colour_and_the_background_its_own() {
        let flat = [[200, 100, 50, 255], [200, 100, 50, 255], [24, 24, 24, 255]];
        let drawn = [[240, 240, 240, 255], [0, 0, 0, 255], [9, 9, 9, 255]];
        let shaded = shade(flat.as_flattened(), drawn.as_flattened());
        assert_eq!(shaded, [[200, 100, 50, 255], [100, 50, 25, 255], [24, 24, 24, 255]].as_flattened());
    }

    #[test]
    fn marks_are_cut_off_at_the_edge() {
        let mut rgba = vec![0; 4 * 64];
        for place in [[-3, -3], [7, 7], [i32::MAX, i32::MIN]] {
            mark(&mut rgba, (8, 8), place, [255; 3]);
        }
        assert_eq!(rgba[4 * (7 * 8 + 7)], 255);
    }
}
