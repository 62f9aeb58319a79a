//! Points, lines and polygons: where they are, which side they show.

use afterglow_gl::frame::{
    ClipPlanes, Cull, Format, Operation, Plane, Rect, RetainedRange, Slot, Topology, VertexLayout,
    VertexSource,
};
use bytemuck::Zeroable;

use crate::testing::*;

#[test]
fn a_triangle_is_where_opengl_has_it() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0, 0.0, 1.0, 1.0]);
    // The lower left half of the window.
    frame.triangle([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, 1.0, 0.0]], RED);
    let picture = frame.picture();
    assert_eq!(picture.at(0, 0), RED);
    assert_eq!(picture.at(6, 0), RED);
    assert_eq!(picture.at(0, 6), RED);
    assert_eq!(picture.at(7, 7), BLUE);
    // The first row in memory is the highest.
    assert_eq!(&picture.bytes[4 * 7..4 * 8], &BLUE);
}

#[test]
fn viewports_and_scissors_count_from_below() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    frame.viewport.rect = Rect { x: 1, y: 0, width: 2, height: 3 };
    frame.fill(0.0, GREEN);
    frame.viewport.rect = Rect { x: 0, y: 0, width: 8, height: 8 };
    frame.viewport.scissor = Some(Rect { x: 4, y: 6, width: 100, height: 1 });
    frame.fill(0.0, RED);
    let picture = frame.picture();
    assert_eq!(picture.count(GREEN), 6);
    assert_eq!((picture.at(1, 0), picture.at(2, 2)), (GREEN, GREEN));
    assert_eq!(picture.count(RED), 4);
    assert_eq!(picture.at(7, 6), RED);
}

#[test]
fn culling_keeps_opengls_sense_of_rotation() {
    let visible = |cull, front_ccw| {
        let mut frame = FrameBuilder::new(4, 4);
        frame.clear([0.0; 4]);
        frame.fixed.raster.cull = cull;
        frame.fixed.raster.front_ccw = front_ccw;
        frame.fill(0.0, WHITE);
        frame.picture().count(WHITE) == 16
    };
    assert!(visible(Cull::Back, true));
    assert!(!visible(Cull::Front, true));
    assert!(visible(Cull::Front, false));
    assert!(!visible(Cull::Back, false));
    assert!(!visible(Cull::FrontAndBack, true));
}

#[test]
fn points_and_lines_ignore_culling() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    frame.fixed.raster.cull = Cull::FrontAndBack;
    frame.primitives(Topology::Lines, &[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]], RED);
    frame.environment.point_size = 3.2;
    frame.primitives(Topology::Points, &[[0.6, 0.6, 0.0]], GREEN);
    let picture = frame.picture();
    assert_eq!(picture.count(RED), 8);
    assert_eq!(picture.count(GREEN), 9);
    // The point's centre is at (6.4, 6.4).
    assert_eq!(picture.at(5, 5), GREEN);
    assert_eq!(picture.at(7, 7), GREEN);
}

#[test]
fn wide_and_stippled_lines() {
    let mut frame = FrameBuilder::new(16, 8);
    frame.clear([0.0; 4]);
    frame.fixed.raster.line_width = 3.0.into();
    frame.primitives(Topology::Lines, &[[-1.0, 0.375, 0.0], [1.0, 0.375, 0.0]], RED);
    frame.fixed.raster.line_width = 1.0.into();
    frame.fixed.raster.line_stipple = Some((2, 0x5555));
    frame.primitives(Topology::Lines, &[[-1.0, -0.875, 0.0], [1.0, -0.875, 0.0]], GREEN);
    let picture = frame.picture();
    assert_eq!(picture.count(RED), 48);
    assert_eq!(picture.count(GREEN), 8);
    assert_eq!([0, 1, 2].map(|x| picture.at(x, 0)), [GREEN, GREEN, [0; 4]]);
}

#[test]
fn flat_shading_takes_the_first_vertex() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    frame.fixed.words.global.set_flat_shade(1);
    let corners = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]];
    let colors = [GREEN, RED, BLUE];
    let vertex =
        |([x, y], color): ([f32; 2], [u8; 4])| [x.to_bits(), y.to_bits(), 0, u32::from_le_bytes(color)];
    let words: Vec<u32> = corners.into_iter().zip(colors).flat_map(vertex).collect();
    frame.draw(POSITION_COLOR, Topology::Triangles, &words, &[0, 1, 2]);
    assert_eq!(frame.picture().count(GREEN), 64);
}

#[test]
fn flat_lines_take_the_last_vertex() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    frame.fixed.words.global.set_flat_shade(1);
    let vertex = |(x, color): (f32, [u8; 4])| [x.to_bits(), 0, 0, u32::from_le_bytes(color)];
    let words: Vec<u32> = [(-1.0, RED), (1.0, GREEN)].into_iter().flat_map(vertex).collect();
    frame.draw(POSITION_COLOR, Topology::Lines, &words, &[0, 1]);
    assert_eq!(frame.picture().count(GREEN), 8);
}

#[test]
fn clip_planes_cut_in_eye_space() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    let mut planes = ClipPlanes::zeroed();
    planes.planes[2] = Plane { coefficients: [1.0, 0.0, 0.0, 0.5] };
    frame.frame.clip_planes.push(planes);
    frame.fixed.words.global.set_clip_planes(1 << 2);
    frame.fill(0.0, WHITE);
    let picture = frame.picture();
    assert_eq!(picture.count(WHITE), 6 * 8);
    assert_eq!(picture.at(1, 0), [0; 4]);
    assert_eq!(picture.at(2, 0), WHITE);
}

#[test]
fn retained_ranges_and_absent_attributes() {
    let layout = VertexLayout::default().with(Slot::Position as usize, Format::F2);
    let corners: [f32; 8] = [-1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0, 1.0];
    let words = corners.map(f32::to_bits).to_vec();
    let range = RetainedRange::new(layout, words, vec![9, 9, 9, 0, 1, 2, 0, 2, 3]);
    let range = std::sync::Arc::new(range);
    let mut renderer = renderer();
    for color in [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]] {
        let mut frame = FrameBuilder::new(4, 4);
        frame.clear([0.0; 4]);
        frame.current.color = color;
        let mut draw = frame.state();
        draw.layout = layout;
        draw.source = VertexSource::Retained { range: 0, first_index: 3 };
        draw.index_count = 6;
        frame.frame.retained.push(range.clone());
        frame.push(Operation::Draw(draw));
        let picture = Picture::after(&mut renderer, &[&frame.frame]);
        assert_eq!(picture.count(color.map(|c| (c * 255.0) as u8)), 16);
    }
    assert_eq!(renderer.frame_report().unwrap().retained_ranges, 1);
}

#[test]
fn an_index_beyond_the_vertices_reads_none_of_another_draw() {
    let mut frame = FrameBuilder::new(4, 4);
    frame.clear([0.0; 4]);
    let words = [0; 4];
    frame.draw(POSITION_COLOR, Topology::Triangles, &words, &[0, u32::MAX, 1 << 30]);
    assert_eq!(frame.picture().count([0; 4]), 16);
}

#[test]
fn polygon_stipple_counts_from_the_lower_left() {
    let mut frame = FrameBuilder::new(8, 8);
    frame.clear([0.0; 4]);
    frame.fixed.words.global.set_polygon_stipple(1);
    frame.environment.polygon_stipple[1] = 1 << 31 | 1 << 28;
    frame.fill(0.0, WHITE);
    let picture = frame.picture();
    assert_eq!(picture.count(WHITE), 2);
    assert_eq!((picture.at(0, 1), picture.at(3, 1)), (WHITE, WHITE));
}
