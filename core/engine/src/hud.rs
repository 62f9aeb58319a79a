//! Text over a window's picture: figures, and what became of a key that was pressed. It is laid over what is shown, and is not in
//! what programs read.

use std::fmt::Write;

use afterglow_render::{FrameReport, Mode, Paint, PassReport};
use afterglow_settings::Preset;
use font8x8::legacy::BASIC_LEGACY;

use crate::pace::Figures;

/// Width of a character, pixels.
const GLYPH: usize = 8;
/// Rows of pixels that a row of a character makes: the font is as high as it is wide, which is hard to read.
const STRETCH: usize = 2;
/// Rows of pixels of a line.
const LINE: usize = GLYPH * STRETCH;
/// Pixels around the text.
const MARGIN: usize = 4;
const INK: u8 = 255;
const PAPER: u8 = 24;
/// Lines at most, and characters of a line.
const MOST_LINES: usize = 12;
const MOST_CHARACTERS: usize = 160;

/// How pictures are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Manner {
    pub(crate) mode: Mode,
    pub(crate) view: Paint,
    pub(crate) preset: Option<Preset>,
}

/// A mode as options write it.
pub(crate) fn mode_name(mode: Mode) -> &'static str {
    match mode {
        Mode::Raster => "raster",
        Mode::Pathtrace => "pathtrace",
        Mode::Reference => "reference",
    }
}

/// What the figures say, line by line: the passes that took longest last of all, the longest of them first.
pub(crate) fn lines(figures: Figures, manner: Manner, size: (u32, u32), report: &FrameReport) -> Vec<String> {
    let Figures { rate, latency, .. } = figures;
    let mut first = format!("{rate:.1} fps  {:.1} ms  latency {latency:.1} ms", 1000.0 / rate.max(1e-3));
    let _ = write!(first, "  {}  {}x{}", mode_name(manner.mode), size.0, size.1);
    let device: f64 = report.passes.iter().map(|pass| pass.milliseconds).sum();
    if device > 0.0 {
        let _ = write!(first, "  device {device:.1} ms");
    }
    let mut lines = vec![first];
    lines.extend(manner_line(manner));
    lines.extend(pass_lines(report, MOST_LINES - lines.len()));
    lines
}

/// What of it is not as usual.
fn manner_line(manner: Manner) -> Option<String> {
    let view = (manner.view != Paint::Picture).then(|| format!("view {}", manner.view.name()));
    let preset = manner.preset.map(|preset| format!("preset {}", preset.name()));
    let parts: Vec<_> = view.into_iter().chain(preset).collect();
    (!parts.is_empty()).then(|| parts.join("  "))
}

fn pass_lines(report: &FrameReport, most: usize) -> Vec<String> {
    let mut passes: Vec<&PassReport> = report.passes.iter().filter(|pass| pass.milliseconds > 0.0).collect();
    passes.sort_by(|a, b| b.milliseconds.total_cmp(&a.milliseconds));
    let line = |pass: &&PassReport| {
        let times = if pass.count > 1 { format!(" x{}", pass.count) } else { String::new() };
        format!("{:8.2} ms  {}{times}", pass.milliseconds, pass.name)
    };
    passes.iter().take(most).map(line).collect()
}

/// Lines of text as pixels.
pub(crate) struct Panel {
    pub(crate) size: [u32; 2],
    /// One byte a pixel, the highest row first.
    pub(crate) greys: Vec<u8>,
}

impl Panel {
    /// Light letters on dark ground, the lines one below the other. What is not ASCII is left blank.
    pub(crate) fn new(lines: &[String]) -> Self {
        let characters = lines.iter().map(|line| line.chars().count()).max().unwrap_or(0);
        let width = characters.min(MOST_CHARACTERS) * GLYPH + 2 * MARGIN;
        let height = lines.len() * LINE + 2 * MARGIN;
        let mut greys = vec![PAPER; width * height];
        for (index, line) in lines.iter().enumerate() {
            let rows = &mut greys[(MARGIN + index * LINE) * width..];
            for (column, character) in line.chars().take(MOST_CHARACTERS).enumerate() {
                draw(character, &mut rows[MARGIN + column * GLYPH..], width);
            }
        }
        Self { size: [width as u32, height as u32], greys }
    }

    /// Lays the text over the upper left corner of a picture of `width` pixels a row and four bytes a pixel.
    pub(crate) fn lay_over(&self, picture: &mut [u8], width: usize) {
        let lines = self.greys.chunks_exact(self.size[0] as usize);
        for (greys, row) in lines.zip(picture.chunks_exact_mut(width.max(1) * 4)) {
            for (grey, pixel) in greys.iter().zip(row.as_chunks_mut::<4>().0) {
                *pixel = [*grey, *grey, *grey, 255];
            }
        }
    }
}

/// Draws a character at the first of these pixels, of which `width` make a row.
fn draw(character: char, greys: &mut [u8], width: usize) {
    let glyph = BASIC_LEGACY.get(character as usize).unwrap_or(&[0; GLYPH]);
    for (row, bits) in glyph.iter().flat_map(|bits| [bits; STRETCH]).enumerate() {
        let pixels = &mut greys[row * width..][..GLYPH];
        pixels
            .iter_mut()
            .enumerate()
            .filter(|(x, _)| bits & (1 << x) != 0)
            .for_each(|(_, pixel)| *pixel = INK);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIGURES: Figures = Figures { frame: 7, rate: 50.0, latency: 12.34 };
    const PLAIN: Manner = Manner { mode: Mode::Raster, view: Paint::Picture, preset: None };

    fn pass(name: &str, count: usize, milliseconds: f64) -> PassReport {
        PassReport { name: name.to_owned(), count, milliseconds }
    }

    #[test]
    fn the_lines_say_what_is_known() {
        let mut report = FrameReport { passes: vec![pass("unmeasured", 1, 0.0)], ..FrameReport::default() };
        let text = lines(FIGURES, PLAIN, (640, 480), &report);
        assert_eq!(text, ["50.0 fps  20.0 ms  latency 12.3 ms  raster  640x480"]);
        report.passes = vec![pass("raster", 3, 1.5), pass("light", 1, 2.0)];
        let manner = Manner { mode: Mode::Pathtrace, view: Paint::Normal, preset: Some(Preset::High) };
        let text = lines(FIGURES, manner, (1, 1), &report);
        assert!(text[0].ends_with("pathtrace  1x1  device 3.5 ms"));
        assert_eq!(text[1..], ["view normal  preset high", "    2.00 ms  light", "    1.50 ms  raster x3"]);
    }

    #[test]
    fn there_are_no_more_lines_than_can_be_read() {
        let passes = (1..100).map(|n| pass("p", 1, f64::from(n))).collect();
        let report = FrameReport { passes, ..FrameReport::default() };
        let text = lines(FIGURES, PLAIN, (1, 1), &report);
        assert_eq!((text.len(), text[1].as_str()), (MOST_LINES, "   99.00 ms  p"));
    }

    #[test]
    fn letters_are_light_on_dark() {
        let panel = Panel::new(&["I é".into(), String::new()]);
        assert_eq!(panel.size, [3 * 8 + 8, 40]);
        let at = |x: usize, y: usize| panel.greys[y * panel.size[0] as usize + x];
        // The letter's stem, its left, a place after it, and one below.
        assert_eq!(
            [at(4 + 2, 4 + 7), at(4, 4 + 7), at(12, 4 + 7), at(6, 4 + 16)],
            [INK, PAPER, PAPER, PAPER]
        );
        assert!(panel.greys.chunks(32).all(|row| row[12..].iter().all(|grey| *grey == PAPER)));
    }

    #[test]
    fn long_lines_are_cut() {
        let panel = Panel::new(&["x".repeat(10_000), "y".into()]);
        assert_eq!(panel.size, [(MOST_CHARACTERS * 8 + 8) as u32, 40]);
    }

    #[test]
    fn a_text_is_cut_at_the_edges_of_the_picture() {
        let (mut picture, panel) = (vec![7; 10 * 30 * 4], Panel::new(&["M".into()]));
        panel.lay_over(&mut picture, 10);
        assert_eq!(picture[..4], [PAPER, PAPER, PAPER, 255]);
        assert_eq!(picture[24 * 40..], [7; 6 * 40]);
    }
}
