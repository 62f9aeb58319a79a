//! Rectangles of pixels, copies of them, and the accumulation buffer.

use afterglow_gl::backend::{Reply, Request};
use afterglow_gl::frame::{
    AccumulateOp, Compare, Depth, Operation, PixelBuffer, PixelContent, PixelCopy, PixelRectangle, Rect,
};

use crate::testing::*;

const ALL: Rect = Rect { x: 0, y: 0, width: 8, height: 8 };

fn pixels(
    frame: &mut FrameBuilder,
    content: PixelContent,
    size: [u32; 2],
    position: [f32; 2],
    zoom: [f32; 2],
) {
    let state = frame.state();
    frame.push(Operation::Pixels(Box::new(PixelRectangle {
        content,
        width: size[0],
        height: size[1],
        position,
        depth: 0.25,
        zoom,
        fixed: state.fixed,
        viewport: state.viewport,
        bindings: state.bindings,
        environment: state.environment,
        current: state.current,
    })));
}

fn copy(frame: &mut FrameBuilder, buffer: PixelBuffer, source: Rect, position: [f32; 2], zoom: [f32; 2]) {
    let state = frame.state();
    frame.push(Operation::CopyPixels(Box::new(PixelCopy {
        buffer,
        source,
        position,
        depth: 0.0,
        zoom,
        fixed: state.fixed,
        viewport: state.viewport,
        bindings: state.bindings,
        environment: state.environment,
        current: state.current,
    })));
}

fn color(texels: &[[u8; 4]]) -> PixelContent {
    PixelContent::Color(texels.concat().into())
}

#[test]
fn pixels_are_drawn_upward_and_zoomed() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    let texels = [RED, GREEN, BLUE, WHITE];
    pixels(&mut frame, color(&texels), [2, 2], [1.0, 1.0], [1.0, 1.0]);
    pixels(&mut frame, color(&texels), [2, 2], [8.0, 4.0], [-2.0, 1.5]);
    let picture = frame.picture();
    let small = [(1, 1), (2, 1), (1, 2), (2, 2)].map(|(x, y)| picture.at(x, y));
    assert_eq!(small, texels);
    assert_eq!((picture.at(7, 4), picture.at(6, 4), picture.at(5, 4)), (RED, RED, GREEN));
    assert_eq!((picture.at(4, 5), picture.at(4, 6), picture.at(4, 7)), (WHITE, WHITE, [0; 4]));
}

#[test]
fn bitmaps_have_the_raster_colour() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    frame.current.color = [0.0, 1.0, 0.0, 1.0];
    let mask = PixelContent::Mask([1, 0, 0, 0, 7, 0].into());
    pixels(&mut frame, mask, [3, 2], [2.7, 3.9], [1.0, 1.0]);
    let picture = frame.picture();
    assert_eq!(picture.count(GREEN), 2);
    assert_eq!((picture.at(2, 3), picture.at(3, 4)), (GREEN, GREEN));
}

#[test]
fn pixels_meet_the_fragment_operations() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    frame.fixed.raster.depth = Some(Depth { compare: Compare::Less, write: true });
    // Depth 0.2 in window coordinates: before the pixels' 0.25.
    frame.quad([-1.0, -1.0], [0.0, 1.0], -0.6, GREEN);
    pixels(&mut frame, color(&[RED; 64]), [8, 8], [0.0, 0.0], [1.0, 1.0]);
    let picture = frame.picture();
    assert_eq!((picture.count(GREEN), picture.count(RED)), (32, 32));
}

#[test]
fn depths_and_stencil_values_are_drawn_and_read() {
    let mut frame = FrameBuilder::new(4, 4);
    frame.clear([0.0; 4]);
    frame.fixed.raster.depth = Some(Depth { compare: Compare::Always, write: true });
    pixels(&mut frame, PixelContent::Depth([0.125, 0.5].into()), [2, 1], [1.0, 2.0], [1.0, 1.0]);
    let values = PixelContent::Stencil([0x00, 0x5a, 0xff].into());
    pixels(&mut frame, values, [3, 1], [0.0, 3.0], [1.0, 1.0]);
    let mut renderer = renderer();
    let rect = Rect { x: 0, y: 2, width: 4, height: 1 };
    let request = Request::Pixels { buffer: PixelBuffer::Depth, rect };
    let Reply::Depth(depths) = renderer.execute_and_answer(&frame.frame, &request).unwrap() else {
        panic!("no depths");
    };
    for (found, expected) in depths.into_iter().zip([1.0, 0.125, 0.5, 1.0]) {
        assert!((found - expected).abs() < 1e-6, "{found} is not {expected}");
    }
    let rect = Rect { x: 0, y: 3, width: 5, height: 1 };
    let request = Request::Pixels { buffer: PixelBuffer::Stencil, rect };
    let empty = FrameBuilder::new(4, 4);
    let reply = renderer.execute_and_answer(&empty.frame, &request).unwrap();
    assert_eq!(reply, Reply::Stencil(vec![0x00, 0x5a, 0xff, 0, 0]));
    assert_valid();
}

#[test]
fn pixels_are_copied_within_the_window() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    frame.quad([-1.0, -1.0], [-0.75, -0.75], 0.0, RED);
    frame.quad([-0.75, -0.75], [-0.5, -0.5], 0.0, GREEN);
    let source = Rect { x: -1, y: 0, width: 3, height: 2 };
    copy(&mut frame, PixelBuffer::Color, source, [3.0, 4.0], [2.0, 1.0]);
    frame.quad([0.75, 0.75], [1.0, 1.0], 0.0, BLUE);
    let picture = frame.picture();
    assert_eq!([5, 6, 7].map(|x| picture.at(x, 4)), [RED, RED, [0; 4]]);
    assert_eq!([6, 7].map(|x| picture.at(x, 5)), [[0; 4], GREEN]);
    assert_eq!(picture.at(7, 7), BLUE);
    assert_eq!((picture.count(RED), picture.count(GREEN)), (3, 2));
}

#[test]
fn depth_is_copied_within_the_window() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    frame.fixed.raster.depth = Some(Depth { compare: Compare::Always, write: true });
    frame.quad([-1.0, -1.0], [0.0, 1.0], 0.0, WHITE);
    let source = Rect { width: 4, ..ALL };
    copy(&mut frame, PixelBuffer::Depth, source, [4.0, 0.0], [1.0, 1.0]);
    frame.fixed.raster.depth = Some(Depth { compare: Compare::Equal, write: false });
    frame.fill(0.0, GREEN);
    assert_eq!(frame.picture().count(GREEN), 64);
}

#[test]
fn frames_are_accumulated() {
    let mut frame = FrameBuilder::new(8, 8);
    let accumulate = |op, value, scissor| Operation::Accumulate(op, value, scissor);
    frame.push(Operation::ClearAccumulation([0.0; 4]));
    frame.clear([1.0, 0.0, 0.0, 1.0]);
    frame.push(accumulate(AccumulateOp::Accumulate, 0.5, None));
    frame.clear([0.0, 1.0, 0.0, 1.0]);
    frame.push(accumulate(AccumulateOp::Accumulate, 0.25, None));
    frame.push(accumulate(AccumulateOp::Add, 0.125, None));
    let scissor = Rect { x: 0, y: 6, width: 8, height: 2 };
    frame.push(accumulate(AccumulateOp::Multiply, 0.0, Some(scissor)));
    let scissor = Rect { x: 0, y: 0, width: 8, height: 7 };
    frame.push(accumulate(AccumulateOp::Return, 1.0, Some(scissor)));
    let picture = frame.picture();
    picture.assert_near(3, 3, [0.625, 0.375, 0.125, 0.875]);
    assert_eq!(picture.at(3, 6), [0; 4]);
    assert_eq!(picture.at(3, 7), GREEN);
    frame.clear([0.0, 0.0, 1.0, 1.0]);
    frame.push(accumulate(AccumulateOp::Load, 0.5, None));
    frame.push(accumulate(AccumulateOp::Return, 2.0, None));
    assert_eq!(frame.picture().count(BLUE), 64);
}
