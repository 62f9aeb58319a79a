//! Frames drawn at another size than the program's window has. What counts in pixels of the window is scaled before
//! the frame is executed, and what the program reads back is resampled, so that the program does not see it.
//!
//! Patterns (glPolygonStipple, glLineStipple) stay as large as they are, and textures keep their sizes: a copy from
//! the window to a texture is resampled, nearest, where it is executed.

use afterglow_gl::backend::{Reply, Request};
use afterglow_gl::frame::{
    Environment, FloatBits, Frame, Operation, PixelContent, PixelCopy, PixelRectangle, Rect,
};

use crate::passes::readback::MOST_PIXELS;
use crate::window;

/// From a program's window to the one that is drawn. Each side is scaled by itself; sides count as 1 to 2^28.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Scale {
    /// Width and height of the program's window, pixels.
    pub from: (u32, u32),
    /// Width and height of the window that is drawn, pixels.
    pub to: (u32, u32),
}

/// One side's scale, as a ratio of lengths: small enough for their products with twice an edge.
#[derive(Debug, Clone, Copy)]
struct Side {
    from: i64,
    to: i64,
}

impl Side {
    fn new(from: u32, to: u32) -> Self {
        let length = |length: u32| i64::from(length.clamp(1, 1 << 28));
        Self { from: length(from), to: length(to) }
    }

    fn ratio(self) -> f64 {
        self.to as f64 / self.from as f64
    }

    /// An edge between pixels, to the nearest one; what is beyond an i32 becomes its limit.
    fn edge(self, edge: i64) -> i64 {
        let scaled = (2 * edge * self.to + self.from).div_euclid(2 * self.from);
        scaled.clamp(i64::from(i32::MIN), i64::from(i32::MAX))
    }

    /// The pixel in which the centre of a pixel lies.
    fn pixel(self, pixel: i64) -> i64 {
        ((2 * pixel + 1) * self.to).div_euclid(2 * self.from)
    }

    /// Start and length. Both edges are rounded, so that what was adjacent stays so.
    fn span(self, start: i32, length: i32) -> (i32, i32) {
        let end = i64::from(start) + i64::from(length);
        let (first, last) = (self.edge(start.into()), self.edge(end));
        let length = (last - first).clamp(i64::from(i32::MIN), i64::from(i32::MAX));
        // Edges were limited to what an i32 holds.
        (first as i32, length as i32)
    }

    /// As [`span`](Self::span), of pixels that are read: at least one, unless there were none.
    fn read_span(self, start: i32, length: i32) -> (i32, i32) {
        match self.span(start, length) {
            (_, 0) if length > 0 => {
                let middle = self.pixel(i64::from(start) + i64::from(length / 2));
                (middle.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32, 1)
            }
            span => span,
        }
    }

    /// The pixels that hold the centres of pixels which lie in the window, at least one.
    fn centers(self, start: i32, length: i32) -> (i32, i32) {
        let first = self.pixel(start.into());
        let last = self.pixel(i64::from(start) + i64::from(length) - 1);
        // Both lie within the window, whose sides fit an i32.
        (first as i32, (last - first + 1) as i32)
    }
}

impl Scale {
    /// Whether there is nothing to do.
    pub fn is_identity(&self) -> bool {
        self.from == self.to
    }

    /// Scales what a frame draws, and the frame's size.
    pub fn frame(&self, frame: &mut Frame) {
        if self.is_identity() {
            return;
        }
        frame.size = self.to;
        for viewport in &mut frame.viewports {
            viewport.rect = self.rect(&viewport.rect);
            viewport.scissor = viewport.scissor.map(|scissor| self.rect(&scissor));
        }
        for fixed in &mut frame.fixed {
            let width = fixed.raster.line_width.get() * self.length();
            fixed.raster.line_width = FloatBits::from(width);
        }
        for environment in &mut frame.environments {
            self.environment(environment);
        }
        for operation in &mut frame.operations {
            self.operation(operation);
        }
    }

    /// What is to be asked of the frame that was drawn for the program to be answered.
    pub fn request(&self, request: &Request) -> Request {
        match request {
            Request::Pixels { buffer, rect } if !self.is_identity() => Request::Pixels {
                buffer: *buffer,
                rect: self.read(rect).map_or_else(Rect::default, |(_, read)| read),
            },
            request => *request,
        }
    }

    /// The answer to the program's `request`, from the one to [`request`](Self::request). Pixels outside of the
    /// program's window are zero. Samples are counted by their share of the window.
    pub fn reply(&self, request: &Request, reply: Reply) -> Reply {
        if self.is_identity() {
            return reply;
        }
        match (request, reply) {
            (Request::Pixels { rect, .. }, _) if pixel_count(rect) > MOST_PIXELS => Reply::Unavailable,
            (Request::Pixels { rect, .. }, Reply::Color(bytes)) => {
                let pixels = bytes.as_chunks::<4>().0;
                Reply::Color(self.resampled(rect, pixels).into_flattened())
            }
            (Request::Pixels { rect, .. }, Reply::Depth(depths)) => {
                Reply::Depth(self.resampled(rect, &depths))
            }
            (Request::Pixels { rect, .. }, Reply::Stencil(values)) => {
                Reply::Stencil(self.resampled(rect, &values))
            }
            (_, Reply::Samples(samples)) => Reply::Samples(self.samples(samples)),
            (_, reply) => reply,
        }
    }

    fn sides(&self) -> [Side; 2] {
        [Side::new(self.from.0, self.to.0), Side::new(self.from.1, self.to.1)]
    }

    /// The scale of what has no direction: the geometric mean of both sides'.
    fn length(&self) -> f32 {
        let [x, y] = self.sides().map(Side::ratio);
        (x * y).sqrt() as f32
    }

    fn position(&self, position: [f32; 2]) -> [f32; 2] {
        let [x, y] = self.sides().map(Side::ratio);
        [(f64::from(position[0]) * x) as f32, (f64::from(position[1]) * y) as f32]
    }

    fn rect(&self, rect: &Rect) -> Rect {
        self.rect_by(rect, Side::span)
    }

    fn rect_by(&self, rect: &Rect, span: fn(Side, i32, i32) -> (i32, i32)) -> Rect {
        let [horizontal, vertical] = self.sides();
        let (x, width) = span(horizontal, rect.x, rect.width);
        let (y, height) = span(vertical, rect.y, rect.height);
        Rect { x, y, width, height }
    }

    fn environment(&self, environment: &mut Environment) {
        for length in [
            &mut environment.line_width,
            &mut environment.point_size,
            &mut environment.point_size_min,
            &mut environment.point_size_max,
            &mut environment.point_fade_threshold,
        ] {
            *length *= self.length();
        }
    }

    fn operation(&self, operation: &mut Operation) {
        match operation {
            Operation::Clear(clear) => {
                clear.scissor = clear.scissor.map(|scissor| self.rect(&scissor));
            }
            Operation::Accumulate(_, _, Some(scissor)) => *scissor = self.rect(scissor),
            Operation::Pixels(pixels) => self.pixels(pixels),
            Operation::CopyPixels(copy) => self.copy(copy),
            Operation::CopyToImage(copy) => {
                copy.source = self.rect_by(&copy.source, Side::read_span);
            }
            Operation::Accumulate(_, _, None)
            | Operation::ClearAccumulation(_)
            | Operation::Draw(_)
            | Operation::DefineImage { .. }
            | Operation::Upload(_)
            | Operation::CopyImage { .. }
            | Operation::DropImage(_)
            | Operation::BeginQuery(_)
            | Operation::EndQuery(_) => {}
        }
    }

    fn pixels(&self, pixels: &mut PixelRectangle) {
        // Bitmaps begin at a whole pixel of the program's window (section 3.7).
        if matches!(pixels.content, PixelContent::Mask(_)) {
            pixels.position = pixels.position.map(f32::floor);
        }
        pixels.position = self.position(pixels.position);
        pixels.zoom = self.position(pixels.zoom);
    }

    /// The zoom makes up for the rounding of the source, so that the copy has the size that it should.
    fn copy(&self, copy: &mut PixelCopy) {
        let source = copy.source;
        copy.source = self.rect_by(&source, Side::read_span);
        copy.position = self.position(copy.position);
        let scaled = self.position(copy.zoom);
        let zoom = |axis: usize, program: i32, drawn: i32| {
            if drawn > 0 { scaled[axis] * program as f32 / drawn as f32 } else { scaled[axis] }
        };
        copy.zoom = [zoom(0, source.width, copy.source.width), zoom(1, source.height, copy.source.height)];
    }

    /// The part of a rectangle that lies in the program's window, and the pixels that are read for it. None if
    /// there is none.
    fn read(&self, rect: &Rect) -> Option<(Rect, Rect)> {
        let clipped = window::clip(rect, [self.from.0, self.from.1])?;
        Some((clipped, self.rect_by(&clipped, Side::centers)))
    }

    /// The program's rectangle from the pixels that were read for it, rows upward: of each pixel its centre.
    fn resampled<T: Copy + Default>(&self, rect: &Rect, pixels: &[T]) -> Vec<T> {
        let pitch = rect.width.max(0) as usize;
        let mut result = vec![T::default(); pitch * rect.height.max(0) as usize];
        let Some((clipped, read)) = self.read(rect) else {
            return result;
        };
        let [horizontal, vertical] = self.sides();
        // Where the centre of a pixel lies in what was read: never before it.
        let place =
            |side: Side, pixel: i32, first: i32| (side.pixel(pixel.into()) - i64::from(first)) as usize;
        let columns = clipped.x..clipped.x + clipped.width;
        let columns: Vec<_> = columns.map(|x| place(horizontal, x, read.x)).collect();
        let left = clipped.x.abs_diff(rect.x) as usize;
        let lowest = clipped.y.abs_diff(rect.y) as usize;
        let rows = clipped.y..clipped.y + clipped.height;
        for (y, target) in rows.zip(result.chunks_exact_mut(pitch).skip(lowest)) {
            let source = pixels.chunks_exact(read.width as usize).nth(place(vertical, y, read.y));
            let Some(source) = source else { break };
            for (target, &column) in target[left..].iter_mut().zip(&columns) {
                *target = source[column];
            }
        }
        result
    }

    /// None only if there were none: that is what programs ask.
    fn samples(&self, samples: u32) -> u32 {
        let [x, y] = self.sides().map(Side::ratio);
        let scaled = (f64::from(samples) / (x * y)).round() as u32;
        scaled.max(samples.min(1))
    }
}

fn pixel_count(rect: &Rect) -> u64 {
    let length = |length: i32| u64::from(length.max(0).unsigned_abs());
    length(rect.width) * length(rect.height)
}

#[cfg(test)]
mod tests {
    use afterglow_gl::frame::{ImageCopy, ImageKey, PixelBuffer, Region, Viewport};
    use bytemuck::Zeroable;

    use super::*;

    const HALF: Scale = Scale { from: (640, 480), to: (320, 240) };
    const DOUBLE: Scale = Scale { from: (4, 4), to: (8, 8) };

    fn rect(x: i32, y: i32, width: i32, height: i32) -> Rect {
        Rect { x, y, width, height }
    }

    fn pixels(rect: Rect) -> Request {
        Request::Pixels { buffer: PixelBuffer::Stencil, rect }
    }

    #[test]
    fn adjacent_rectangles_stay_adjacent() {
        let scale = Scale { from: (641, 479), to: (300, 1000) };
        assert_eq!(scale.rect(&rect(0, 0, 641, 479)), rect(0, 0, 300, 1000));
        let mut end = (scale.rect(&rect(-40, -40, 0, 0)).x, scale.rect(&rect(-40, -40, 0, 0)).y);
        for start in (-40..700).step_by(7) {
            let scaled = scale.rect(&rect(start, start, 7, 7));
            assert_eq!((scaled.x, scaled.y), end);
            assert!((f64::from(scaled.width) - 7.0 * 300.0 / 641.0).abs() <= 1.0);
            end = (scaled.x + scaled.width, scaled.y + scaled.height);
        }
        let huge = scale.rect(&rect(i32::MAX, i32::MIN, i32::MAX, i32::MAX));
        assert_eq!((huge.y, huge.height), (i32::MIN, i32::MAX - 1));
        let extreme = Scale { from: (1, 1), to: (u32::MAX, 0) };
        assert_eq!(extreme.rect(&rect(-9, 0, i32::MAX, 1)).width, i32::MAX);
        assert_eq!(Scale { from: (0, 0), to: (2, 2) }.rect(&rect(1, 1, 1, 1)), rect(2, 2, 2, 2));
    }

    #[test]
    fn what_counts_in_pixels_is_scaled() {
        let mut frame = Frame { size: (640, 480), ..Frame::default() };
        frame.viewports.push(Viewport {
            rect: rect(0, 0, 640, 480),
            depth_range: [0.0, 1.0],
            scissor: Some(rect(11, 20, 100, 50)),
        });
        frame.environments.push(Environment {
            line_width: 3.0,
            point_size: 5.0,
            point_size_max: 64.0,
            fog_end: 7.0,
            ..Environment::zeroed()
        });
        let region = Region { level: 0, layer: 0, offset: [0; 3], extent: [1, 9, 1] };
        frame.operations.push(Operation::CopyToImage(ImageCopy {
            image: ImageKey(1),
            region,
            source: rect(639, 1, 1, 9),
            base_format: afterglow_gl::frame::BaseFormat::Rgb,
        }));
        HALF.frame(&mut frame);
        assert_eq!(frame.size, (320, 240));
        assert_eq!(frame.viewports[0].rect, rect(0, 0, 320, 240));
        assert_eq!(frame.viewports[0].scissor, Some(rect(6, 10, 50, 25)));
        let environment = &frame.environments[0];
        let sizes = [environment.line_width, environment.point_size, environment.point_size_max];
        assert_eq!((sizes, environment.fog_end), ([1.5, 2.5, 32.0], 7.0));
        let Operation::CopyToImage(copy) = &frame.operations[0] else { panic!() };
        assert_eq!((copy.source, copy.region), (rect(319, 1, 1, 4), region));
    }

    #[test]
    fn copies_of_pixels_have_the_size_that_they_should() {
        let mut copy = PixelCopy {
            buffer: PixelBuffer::Color,
            source: rect(1, 0, 4, 3),
            position: [3.0, 7.0],
            depth: 0.0,
            zoom: [1.0, -2.0],
            fixed: 0,
            viewport: 0,
            bindings: 0,
            environment: 0,
            current: 0,
        };
        HALF.copy(&mut copy);
        assert_eq!((copy.source, copy.position), (rect(1, 0, 2, 2), [1.5, 3.5]));
        let drawn = [copy.zoom[0] * 2.0, copy.zoom[1] * 2.0];
        assert_eq!(drawn, [2.0, -3.0]);
    }

    #[test]
    fn replies_have_the_size_of_the_request() {
        let request = pixels(rect(3, -1, 2, 3));
        assert_eq!(DOUBLE.request(&request), pixels(rect(7, 1, 1, 3)));
        let reply = DOUBLE.reply(&request, Reply::Stencil(vec![1, 2, 3]));
        assert_eq!(reply, Reply::Stencil(vec![0, 0, 1, 0, 3, 0]));
        let request = pixels(rect(638, 0, 4, 1));
        assert_eq!(HALF.request(&request), pixels(rect(319, 0, 1, 1)));
        let color = HALF.reply(&request, Reply::Color(vec![1, 2, 3, 4]));
        assert_eq!(color, Reply::Color(vec![1, 2, 3, 4, 1, 2, 3, 4, 0, 0, 0, 0, 0, 0, 0, 0]));
        let outside = pixels(rect(9, 9, 2, 1));
        assert_eq!(DOUBLE.request(&outside), pixels(Rect::default()));
        assert_eq!(DOUBLE.reply(&outside, Reply::Depth(Vec::new())), Reply::Depth(vec![0.0; 2]));
    }

    #[test]
    fn replies_are_bounded_and_may_be_short() {
        let huge = pixels(rect(0, 0, i32::MAX, i32::MAX));
        assert_eq!(DOUBLE.reply(&huge, Reply::Stencil(vec![1])), Reply::Unavailable);
        let negative = pixels(rect(0, 0, -1, 4));
        assert_eq!(DOUBLE.reply(&negative, Reply::Stencil(Vec::new())), Reply::Stencil(Vec::new()));
        let short = DOUBLE.reply(&pixels(rect(0, 0, 1, 2)), Reply::Stencil(vec![7, 8]));
        assert_eq!(short, Reply::Stencil(vec![7, 0]));
        let unavailable = DOUBLE.reply(&pixels(rect(0, 0, 1, 1)), Reply::Unavailable);
        assert_eq!(unavailable, Reply::Unavailable);
    }

    #[test]
    fn samples_count_by_their_share() {
        let samples = |scale: Scale, samples| scale.reply(&Request::Query(1), Reply::Samples(samples));
        assert_eq!(samples(HALF, 100), Reply::Samples(400));
        assert_eq!(samples(DOUBLE, 400), Reply::Samples(100));
        assert_eq!(samples(DOUBLE, 1), Reply::Samples(1));
        assert_eq!(samples(DOUBLE, 0), Reply::Samples(0));
    }
}
