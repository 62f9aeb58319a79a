//! Clears with and without masks, in and between passes, and the window's size.

use afterglow_gl::frame::{Clear, Compare, Depth, Operation, Rect, Stencil, StencilOp};

use crate::testing::*;

const COLOR: Clear =
    Clear { color: Some([1.0, 0.0, 0.0, 1.0]), color_mask: 0xf, depth: None, stencil: None, scissor: None };

#[test]
fn a_clear_in_the_middle_keeps_its_place() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0, 0.0, 1.0, 1.0]);
    frame.fill(0.0, GREEN);
    let scissor = Some(Rect { x: 0, y: 0, width: 8, height: 2 });
    frame.push(Operation::Clear(Clear { scissor, ..COLOR }));
    frame.quad([0.0, -1.0], [1.0, 1.0], 0.0, WHITE);
    let picture = frame.picture();
    assert_eq!(picture.count(RED), 8);
    assert_eq!(picture.at(0, 1), RED);
    assert_eq!(picture.count(GREEN), 24);
    assert_eq!(picture.count(WHITE), 32);
}

#[test]
fn a_whole_clear_hides_what_was_drawn() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.fill(0.0, GREEN);
    frame.push(Operation::Clear(COLOR));
    frame.quad([-1.0, -1.0], [0.0, 1.0], 0.0, WHITE);
    let picture = frame.picture();
    assert_eq!((picture.count(WHITE), picture.count(RED)), (32, 32));
}

#[test]
fn masked_components_stay() {
    let mut frame = FrameBuilder::new(4, 4);
    frame.clear([0.0, 1.0, 0.0, 1.0]);
    frame.push(Operation::Clear(Clear { color: Some([1.0, 0.0, 1.0, 0.0]), color_mask: 0b0101, ..COLOR }));
    assert_eq!(frame.picture().count(WHITE), 16);
}

#[test]
fn depth_clears_reach_their_scissor() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    frame.fixed.raster.depth = Some(Depth { compare: Compare::Less, write: true });
    frame.fill(0.0, GREEN);
    frame.push(Operation::Clear(Clear {
        color: None,
        depth: Some(1.0),
        scissor: Some(Rect { x: 0, y: 0, width: 4, height: 8 }),
        ..COLOR
    }));
    frame.fill(0.5, RED);
    let picture = frame.picture();
    assert_eq!((picture.count(RED), picture.count(GREEN)), (32, 32));
    assert_eq!(picture.at(0, 0), RED);
}

#[test]
fn stencil_clears_write_the_masks_bits() {
    let stencil = |value, mask| Clear { color: None, stencil: Some((value, mask)), ..COLOR };
    let mut frame = FrameBuilder::new(4, 4);
    frame.clear([0.0; 4]);
    frame.push(Operation::Clear(stencil(0xff, u32::MAX)));
    frame.push(Operation::Clear(stencil(0, 0x0f)));
    frame.fixed.raster.stencil = Some(Stencil {
        compare: Compare::Equal,
        reference: 0xf0,
        compare_mask: 0xff,
        write_mask: 0,
        fail: StencilOp::Keep,
        depth_fail: StencilOp::Keep,
        pass: StencilOp::Keep,
    });
    frame.fill(0.0, GREEN);
    assert_eq!(frame.picture().count(GREEN), 16);
}

#[test]
fn a_larger_window_keeps_its_contents() {
    let mut renderer = renderer();
    let mut small = FrameBuilder::new(4, 4);
    small.clear([1.0, 0.0, 0.0, 1.0]);
    let empty = FrameBuilder::new(8, 6);
    let picture = Picture::after(&mut renderer, &[&small.frame, &empty.frame]);
    assert_eq!((picture.size, picture.count(RED)), ([8, 6], 16));
    assert_eq!(picture.at(0, 5), RED);
    assert_eq!(picture.at(0, 1), [0; 4]);
    let smaller = FrameBuilder::new(2, 3);
    let picture = Picture::after(&mut renderer, &[&smaller.frame]);
    assert_eq!((picture.size, picture.count(RED)), ([2, 3], 6));
}

#[test]
fn a_window_without_pixels_has_one() {
    let mut frame = FrameBuilder::new(0, 0);
    frame.clear([1.0; 4]);
    assert_eq!(frame.picture().size, [1, 1]);
}
