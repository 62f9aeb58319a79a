//! The line of figures over a window's picture. It is laid over what is shown, and is not in what programs read.

use std::fmt::Write;

use afterglow_render::{FrameReport, Mode};
use font8x8::legacy::BASIC_LEGACY;

use crate::pace::Figures;

/// Width of a character, pixels.
const GLYPH: usize = 8;
/// Rows of pixels that a row of a character makes: the font is as high as it is wide, which is hard to read.
const STRETCH: usize = 2;
/// Pixels around the text.
const MARGIN: usize = 4;
const INK: u8 = 255;
const PAPER: u8 = 24;

/// What the line says.
pub(crate) fn line(figures: Figures, mode: Mode, size: (u32, u32), report: &FrameReport) -> String {
    let mode = match mode {
        Mode::Raster => "raster",
        Mode::Pathtrace => "pathtrace",
        Mode::Reference => "reference",
    };
    let Figures { rate, latency, .. } = figures;
    let mut line = format!("{rate:.1} fps  {:.1} ms  latency {latency:.1} ms", 1000.0 / rate.max(1e-3));
    let _ = write!(line, "  {mode}  {}x{}", size.0, size.1);
    let device: f64 = report.passes.iter().map(|pass| pass.milliseconds).sum();
    if device > 0.0 {
        let _ = write!(line, "  device {device:.1} ms");
    }
    line
}

/// A line of text as pixels.
pub(crate) struct Line {
    pub(crate) size: [u32; 2],
    /// One byte a pixel, the highest row first.
    pub(crate) greys: Vec<u8>,
}

impl Line {
    /// Light letters on dark ground. What is not ASCII is left blank.
    pub(crate) fn new(text: &str) -> Self {
        let width = text.chars().count() * GLYPH + 2 * MARGIN;
        let height = GLYPH * STRETCH + 2 * MARGIN;
        let mut greys = vec![PAPER; width * height];
        for (column, character) in text.chars().enumerate() {
            let glyph = BASIC_LEGACY.get(character as usize).unwrap_or(&[0; GLYPH]);
            for (row, bits) in glyph.iter().flat_map(|bits| [bits; STRETCH]).enumerate() {
                let start = (MARGIN + row) * width + MARGIN + column * GLYPH;
                let pixels = &mut greys[start..start + GLYPH];
                pixels
                    .iter_mut()
                    .enumerate()
                    .filter(|(x, _)| bits & (1 << x) != 0)
                    .for_each(|(_, p)| *p = INK);
            }
        }
        Self { size: [width as u32, height as u32], greys }
    }

    /// Lays the line over the upper left corner of a picture of `width` pixels a row and four bytes a pixel.
    pub(crate) fn lay_over(&self, picture: &mut [u8], width: usize) {
        let lines = self.greys.chunks_exact(self.size[0] as usize);
        for (greys, row) in lines.zip(picture.chunks_exact_mut(width.max(1) * 4)) {
            for (grey, pixel) in greys.iter().zip(row.as_chunks_mut::<4>().0) {
                *pixel = [*grey, *grey, *grey, 255];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_says_what_is_known() {
        let figures = Figures { frame: 7, rate: 50.0, latency: 12.34 };
        let mut report = FrameReport::default();
        let text = line(figures, Mode::Raster, (640, 480), &report);
        assert_eq!(text, "50.0 fps  20.0 ms  latency 12.3 ms  raster  640x480");
        let pass =
            |milliseconds| afterglow_render::PassReport { name: String::new(), count: 1, milliseconds };
        report.passes = vec![pass(1.5), pass(2.0)];
        assert!(line(figures, Mode::Pathtrace, (1, 1), &report).ends_with("pathtrace  1x1  device 3.5 ms"));
    }

    #[test]
    fn letters_are_light_on_dark() {
        let line = Line::new("I é");
        assert_eq!(line.size, [3 * 8 + 8, 24]);
        let at = |x: usize, y: usize| line.greys[y * line.size[0] as usize + x];
        // The letter's stem, its left, and a place after it.
        assert_eq!([at(4 + 2, 4 + 7), at(4, 4 + 7), at(12, 4 + 7)], [INK, PAPER, PAPER]);
        assert!(line.greys.chunks(32).all(|row| row[12..].iter().all(|grey| *grey == PAPER)));
    }

    #[test]
    fn a_line_is_cut_at_the_edges_of_the_picture() {
        let (mut picture, line) = (vec![7; 10 * 30 * 4], Line::new("M"));
        line.lay_over(&mut picture, 10);
        assert_eq!(picture[..4], [PAPER, PAPER, PAPER, 255]);
        assert_eq!(picture[24 * 40..], [7; 6 * 40]);
    }
}
