//! What the colours of the pictures mean.

use std::collections::BTreeMap;

use afterglow_scene::{Class, Scene};
use font8x8::legacy::BASIC_LEGACY;

use super::By;
use super::colors::{BACKGROUND, Layer, Rgb, Source, Swatch, class_color, hashed_color};

/// Width and height of a character, pixels; rows are written twice.
const GLYPH: usize = 8;
const LINE: usize = 2 * GLYPH + 6;
const MARGIN: usize = 8;
const SWATCH: usize = 28;
const INK: Rgb = [235; 3];

/// Collects what was painted.
#[derive(Debug, Default)]
pub struct Legend {
    by: Vec<By>,
    reasons: BTreeMap<(usize, &'static str), Rgb>,
}

/// A picture.
pub struct Picture {
    /// Width and height, pixels.
    pub size: (u32, u32),
    /// Top row first.
    pub rgba: Vec<u8>,
}

impl Legend {
    /// Notes a frame's colours.
    pub fn add(&mut self, by: By, scene: &Scene, swatches: &[Swatch]) {
        if !self.by.contains(&by) {
            self.by.push(by);
        }
        if by == By::Reason {
            for (verdict, swatch) in scene.verdicts.iter().zip(swatches) {
                let class = Class::ALL.iter().position(|&class| class == verdict.class).unwrap_or_default();
                self.reasons.insert((class, verdict.reason), swatch.rgb);
            }
        }
    }

    /// The legend of all pictures.
    pub fn picture(&self) -> Picture {
        let lines: Vec<_> = self.by.iter().flat_map(|&by| self.lines(by)).collect();
        let longest = lines.iter().map(|(text, _)| text.chars().count()).max().unwrap_or_default();
        let width = 2 * MARGIN + SWATCH + MARGIN + longest * GLYPH;
        let height = 2 * MARGIN + lines.len().max(1) * LINE;
        let mut canvas = Canvas { width, pixels: vec![BACKGROUND; width * height] };
        for (i, (text, color)) in lines.iter().enumerate() {
            let top = MARGIN + i * LINE;
            if let Some(color) = color {
                canvas.fill([MARGIN, top], [SWATCH, 2 * GLYPH], *color);
            }
            let left = if color.is_some() { 2 * MARGIN + SWATCH } else { MARGIN };
            canvas.write([left, top], text);
        }
        let rgba = canvas.pixels.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect();
        Picture { size: (width as u32, height as u32), rgba }
    }

    /// A title, and a line a colour.
    fn lines(&self, by: By) -> Vec<(String, Option<Rgb>)> {
        let entry = |(text, color): (&str, Rgb)| (text.to_owned(), Some(color));
        let mut lines = vec![(format!("by {}", by.name()), None)];
        match by {
            By::Class => lines.extend(Class::ALL.map(|class| entry((class.name(), class_color(class))))),
            By::Id => {
                lines.push(entry(("an object: its own hue", hashed_color(1))));
                lines.push(entry(("no identity", hashed_color(0))));
            }
            By::Layer => lines.extend(Layer::ALL.map(|layer| entry(layer.color()))),
            By::Light => lines.extend(Source::ALL.map(|source| entry(source.color()))),
            By::Reason => lines.extend(self.reasons.iter().map(|(&(class, reason), &color)| {
                (format!("{}: {reason}", Class::ALL[class].name()), Some(color))
            })),
        }
        lines
    }
}

struct Canvas {
    width: usize,
    pixels: Vec<Rgb>,
}

impl Canvas {
    fn fill(&mut self, [left, top]: [usize; 2], [width, height]: [usize; 2], color: Rgb) {
        for row in self.pixels.chunks_exact_mut(self.width).skip(top).take(height) {
            row.iter_mut().skip(left).take(width).for_each(|pixel| *pixel = color);
        }
    }

    /// What is not ASCII is left blank.
    fn write(&mut self, [left, top]: [usize; 2], text: &str) {
        for (column, character) in text.chars().enumerate() {
            let glyph = BASIC_LEGACY.get(character as usize).unwrap_or(&[0; GLYPH]);
            for (row, x) in (0..GLYPH).flat_map(|row| (0..GLYPH).map(move |x| (row, x))) {
                if glyph[row] & (1 << x) != 0 {
                    self.fill([left + column * GLYPH + x, top + 2 * row], [1, 2], INK);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_colour_is_in_the_legend() {
        let mut legend = Legend::default();
        for by in [By::Class, By::Layer] {
            legend.add(by, &Scene::default(), &[]);
        }
        let picture = legend.picture();
        assert_eq!(picture.rgba.len(), 4 * (picture.size.0 * picture.size.1) as usize);
        let has = |[r, g, b]: Rgb| picture.rgba.as_chunks::<4>().0.contains(&[r, g, b, 255]);
        assert!(Class::ALL.iter().all(|&class| has(class_color(class))));
        assert!(Layer::ALL.iter().all(|layer| has(layer.color().1)));
    }
}
