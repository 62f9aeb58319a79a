//! A frame split into views (what is drawn to one viewport between clears) and their depth layers.

use afterglow_gl::frame::{Clear, Frame, Operation, Rect};

/// Where a draw belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Place {
    /// Index into [`Views::views`].
    pub view: usize,
    /// Number of depth clears within the view before it.
    pub layer: u32,
}

/// What is drawn to one viewport.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// The viewport.
    pub rect: Rect,
    /// Its pixels were erased later in the frame.
    pub erased: bool,
    /// Colour that it was cleared to.
    pub background: Option<[f32; 4]>,
    /// Its pixels were copied to an image since they were last cleared.
    copied: bool,
    layer: u32,
    drawn_in_layer: bool,
    ended: bool,
}

/// The views of a frame.
#[derive(Debug, Default)]
pub struct Views {
    /// In order of their first draws.
    pub views: Vec<View>,
    /// Place of each draw, in the order of [`Frame::draws`].
    pub places: Vec<Place>,
}

impl Views {
    /// Splits a frame. A colour clear or, after a copy to an image, a depth clear begins views anew; a depth
    /// clear alone begins a layer.
    pub fn split(frame: &Frame) -> Views {
        let mut views = Views::default();
        let mut background = Vec::new();
        for operation in &frame.operations {
            match operation {
                Operation::Draw(draw) => {
                    let rect = frame.viewports[draw.viewport as usize].rect;
                    views.place(rect, &background);
                }
                Operation::Clear(clear) => {
                    views.clear(clear);
                    background.extend(clear.color.map(|color| (clear.scissor, color)));
                }
                Operation::CopyToImage(copy) => {
                    for view in views.open_inside(Some(copy.source)) {
                        view.copied = true;
                    }
                }
                _ => {}
            }
        }
        views
    }

    fn place(&mut self, rect: Rect, backgrounds: &[(Option<Rect>, [f32; 4])]) {
        let found = self.views.iter().rposition(|view| !view.ended && view.rect == rect);
        let index = found.unwrap_or_else(|| {
            let background =
                backgrounds.iter().rev().find(|(scissor, _)| overlaps(*scissor, rect)).map(|b| b.1);
            self.views.push(View {
                rect,
                erased: false,
                background,
                copied: false,
                layer: 0,
                drawn_in_layer: false,
                ended: false,
            });
            self.views.len() - 1
        });
        let view = &mut self.views[index];
        view.drawn_in_layer = true;
        self.places.push(Place { view: index, layer: view.layer });
    }

    fn clear(&mut self, clear: &Clear) {
        let clears_color = clear.color.is_some() && clear.color_mask & 7 == 7;
        for view in self.open_inside(clear.scissor) {
            if clears_color {
                view.ended = true;
                view.erased = true;
            } else if clear.depth.is_some() && view.copied {
                view.ended = true;
            } else if clear.depth.is_some() && view.drawn_in_layer {
                view.layer += 1;
                view.drawn_in_layer = false;
            }
        }
    }

    /// Views still drawn to, whose viewport lies in `region` (everywhere without one).
    fn open_inside(&mut self, region: Option<Rect>) -> impl Iterator<Item = &mut View> {
        self.views.iter_mut().filter(move |view| !view.ended && contains(region, view.rect))
    }
}

fn contains(region: Option<Rect>, inner: Rect) -> bool {
    region.is_none_or(|outer| {
        // A pixel more or less is a program's rounding.
        outer.x <= inner.x + 1
            && outer.y <= inner.y + 1
            && right(outer) + 1 >= right(inner)
            && top(outer) + 1 >= top(inner)
    })
}

fn overlaps(region: Option<Rect>, rect: Rect) -> bool {
    region.is_none_or(|r| {
        i64::from(r.x) < right(rect)
            && i64::from(rect.x) < right(r)
            && i64::from(r.y) < top(rect)
            && i64::from(rect.y) < top(r)
    })
}

fn right(rect: Rect) -> i64 {
    i64::from(rect.x) + i64::from(rect.width)
}

fn top(rect: Rect) -> i64 {
    i64::from(rect.y) + i64::from(rect.height)
}

/// Share of the drawable that a viewport covers, 0 to 1.
pub fn share_of_drawable(rect: Rect, size: (u32, u32)) -> f64 {
    let (width, height) = (i64::from(size.0), i64::from(size.1));
    let covered_x = right(rect).min(width) - i64::from(rect.x).max(0);
    let covered_y = top(rect).min(height) - i64::from(rect.y).max(0);
    let covered = covered_x.max(0) as f64 * covered_y.max(0) as f64;
    covered / (width * height).max(1) as f64
}
