//! Questions of the program, and what holds from frame to frame.

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::{BaseFormat, Compare, Depth, Operation, PixelBuffer, Rect, Region};

use crate::testing::*;

#[test]
fn pixels_come_from_below_and_outside_is_zero() {
    let mut frame = FrameBuilder::new(4, 4);
    frame.clear([0.0, 0.0, 1.0, 1.0]);
    frame.quad([-1.0, -1.0], [1.0, -0.5], 0.0, RED);
    let request =
        Request::Pixels { buffer: PixelBuffer::Color, rect: Rect { x: 3, y: 0, width: 2, height: 2 } };
    let reply = renderer().execute_and_answer(&frame.frame, &request).unwrap();
    assert_eq!(reply, Reply::Color([RED, [0; 4], BLUE, [0; 4]].concat()));
    let outside =
        Request::Pixels { buffer: PixelBuffer::Depth, rect: Rect { x: 9, y: 9, width: 1, height: 2 } };
    let reply = renderer().execute_and_answer(&frame.frame, &outside).unwrap();
    assert_eq!(reply, Reply::Depth(vec![0.0; 2]));
    assert_valid();
}

#[test]
fn texels_come_back_expanded() {
    let mut frame = FrameBuilder::new(2, 2);
    let image = frame.texture(0, [2, 1], BaseFormat::Luminance, &[[9, 9, 9, 255], [7, 1, 2, 3]]);
    let region = Region { level: 0, layer: 0, offset: [0; 3], extent: [2, 1, 1] };
    let request = Request::Texels { image, region };
    let reply = renderer().execute_and_answer(&frame.frame, &request).unwrap();
    assert_eq!(reply, Reply::Color(vec![9, 9, 9, 255, 7, 7, 7, 255]));
    let too_large = Request::Texels { image, region: Region { extent: [3, 1, 1], ..region } };
    let reply = renderer().execute_and_answer(&frame.frame, &too_large).unwrap();
    assert_eq!(reply, Reply::Unavailable);
}

#[test]
fn samples_are_counted_across_passes_and_frames() {
    let mut renderer = renderer();
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    frame.fixed.raster.depth = Some(Depth { compare: Compare::Less, write: true });
    frame.push(Operation::BeginQuery(5));
    frame.quad([-1.0, -1.0], [0.0, 1.0], 0.0, WHITE);
    // Ends the pass, not the query.
    let image = frame.define([8, 8], BaseFormat::Rgba);
    frame.push(Operation::CopyToImage(afterglow_gl::frame::ImageCopy {
        image,
        region: Region { level: 0, layer: 0, offset: [0; 3], extent: [8, 8, 1] },
        source: Rect { x: 0, y: 0, width: 8, height: 8 },
        base_format: BaseFormat::Rgba,
    }));
    frame.fill(0.0, WHITE);
    renderer.execute(&frame.frame).unwrap();
    let mut rest = FrameBuilder::new(8, 8);
    rest.quad([-1.0, -1.0], [-0.75, 1.0], 0.0, WHITE);
    rest.push(Operation::EndQuery(5));
    rest.fill(0.0, WHITE);
    let reply = renderer.execute_and_answer(&rest.frame, &Request::Query(5)).unwrap();
    assert_eq!(reply, Reply::Samples(32 + 32 + 8));

    let mut again = FrameBuilder::new(8, 8);
    again.push(Operation::BeginQuery(5));
    again.quad([-1.0, -1.0], [-0.75, 1.0], 0.0, WHITE);
    again.push(Operation::EndQuery(5));
    let reply = renderer.execute_and_answer(&again.frame, &Request::Query(5)).unwrap();
    assert_eq!(reply, Reply::Samples(8));
    assert_valid();
}

#[test]
fn frames_handed_over_in_parts_are_one_frame() {
    let mut renderer = renderer();
    let mut first = FrameBuilder::new(4, 4);
    first.clear([1.0, 0.0, 0.0, 1.0]);
    first.quad([-1.0, -1.0], [0.0, 1.0], 0.0, GREEN);
    renderer.submit(first.frame, End::Continued);
    let mut second = FrameBuilder::new(4, 4);
    second.quad([-1.0, -1.0], [1.0, 0.0], 0.0, BLUE);
    assert_eq!(renderer.answer(second.frame, Request::Finish), Reply::Done);
    renderer.submit(FrameBuilder::new(4, 4).frame, End::Swap);
    assert!(renderer.recycle().operations.is_empty());
    assert_eq!(renderer.frame_report().unwrap().draws, 2);
    let picture = Picture::after(&mut renderer, &[]);
    assert_eq!([BLUE, GREEN, RED].map(|color| picture.count(color)), [8, 4, 4]);
    assert!(renderer.failure().is_none());
}

#[test]
fn a_drawable_goes_from_one_renderer_to_another() {
    let (mut from, mut to) = (renderer(), renderer());
    from.select(7).unwrap();
    let mut frame = FrameBuilder::new(4, 4);
    frame.clear([1.0, 0.0, 0.0, 1.0]);
    from.submit(frame.frame, End::Continued);
    assert!(from.give_up(8).is_none());
    let carried = from.give_up(7).unwrap();
    drop(from);
    to.select(3).unwrap();
    to.take_over(7, carried).unwrap();
    let mut frame = FrameBuilder::new(4, 4);
    frame.quad([-1.0, -1.0], [0.0, 1.0], 0.0, GREEN);
    to.submit(frame.frame, End::Over);
    let picture = Picture::after(&mut to, &[]);
    assert_eq!([RED, GREEN].map(|color| picture.count(color)), [8, 8]);
    assert_valid();
}

#[test]
fn the_same_frames_give_the_same_bits() {
    let run = || {
        let mut renderer = renderer();
        let mut last = None;
        for step in 0..6 {
            let mut frame = FrameBuilder::new(32, 32);
            frame.clear([0.1, 0.2, 0.3, 1.0]);
            for i in 0..40 {
                let x = ((i * 7 + step) % 13) as f32 / 13.0;
                frame.triangle([[-x, -1.0, x], [1.0, x, 0.0], [x, 1.0, 0.5]], [i as u8 * 6, 99, 200, 255]);
            }
            last = Some(Picture::after(&mut renderer, &[&frame.frame]));
        }
        last
    };
    assert_eq!(run(), run());
}

#[test]
fn times_are_taken_where_asked() {
    let options = crate::RenderOptions { timing: true };
    let mut renderer = crate::Renderer::new(&gpu(), &options).unwrap();
    let mut frame = FrameBuilder::new(64, 64);
    frame.clear([0.0; 4]);
    frame.fill(0.0, WHITE);
    renderer.execute(&frame.frame).unwrap();
    let report = renderer.frame_report().unwrap();
    assert_eq!((report.draws, report.indices), (1, 6));
    let raster = report.passes.iter().find(|pass| pass.name == "raster").unwrap();
    assert!(raster.milliseconds > 0.0);
    assert_valid();
}
