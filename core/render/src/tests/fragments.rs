//! Operations on fragments: blending, depth, stencil, alpha test, logic, fog.

use afterglow_gl::frame::{
    Blend, BlendEquation, BlendFactor, Clear, Compare, Depth, Operation, Stencil, StencilOp,
};

use crate::testing::*;

fn blend(source: BlendFactor, destination: BlendFactor) -> Option<Blend> {
    Some(Blend {
        rgb: (source, destination),
        alpha: (source, destination),
        equation_rgb: BlendEquation::Add,
        equation_alpha: BlendEquation::Add,
        constant: [0.0.into(); 4],
    })
}

#[test]
fn colours_blend() {
    let mut frame = FrameBuilder::new(4, 4);
    frame.clear([0.0, 1.0, 0.0, 1.0]);
    frame.fixed.raster.blend = blend(BlendFactor::SourceAlpha, BlendFactor::OneMinusSourceAlpha);
    frame.fill(0.0, [255, 0, 0, 64]);
    let alpha = 64.0 / 255.0;
    let picture = frame.picture();
    picture.assert_near(1, 1, [alpha, 1.0 - alpha, 0.0, alpha * alpha + 1.0 - alpha]);
}

#[test]
fn the_constant_colour_and_other_equations() {
    let mut frame = FrameBuilder::new(4, 4);
    frame.clear([0.5, 0.5, 0.0, 1.0]);
    let mut equation = blend(BlendFactor::ConstantColor, BlendFactor::One).unwrap();
    equation.constant = [0.25.into(), 1.0.into(), 1.0.into(), 1.0.into()];
    equation.equation_rgb = BlendEquation::ReverseSubtract;
    frame.fixed.raster.blend = Some(equation);
    frame.fill(0.0, [255, 102, 255, 0]);
    frame.picture().assert_near(1, 1, [0.25, 0.1, 0.0, 1.0]);
}

#[test]
fn logic_operations_replace_blending() {
    let mut frame = FrameBuilder::new(4, 4);
    frame.clear([1.0, 1.0, 0.0, 0.0]);
    frame.fixed.raster.blend = blend(BlendFactor::Zero, BlendFactor::Zero);
    // GL_XOR.
    frame.fixed.raster.logic_op = Some(6);
    frame.fill(0.0, [255, 0, 255, 255]);
    assert_eq!(frame.picture().count([0, 255, 255, 255]), 16);
}

#[test]
fn depth_is_tested_and_written() {
    let mut frame = FrameBuilder::new(4, 4);
    frame.clear([0.0; 4]);
    frame.fixed.raster.depth = Some(Depth { compare: Compare::LessEqual, write: true });
    frame.fill(0.0, GREEN);
    frame.fill(0.5, RED);
    frame.fixed.raster.depth = Some(Depth { compare: Compare::Equal, write: false });
    frame.quad([-1.0, -1.0], [0.0, 1.0], 0.0, BLUE);
    let picture = frame.picture();
    assert_eq!((picture.count(GREEN), picture.count(BLUE)), (8, 8));
}

#[test]
fn polygon_offset_lets_decals_win() {
    let mut frame = FrameBuilder::new(4, 4);
    frame.clear([0.0; 4]);
    frame.fixed.raster.depth = Some(Depth { compare: Compare::Less, write: true });
    frame.fill(0.25, GREEN);
    frame.fixed.raster.depth_bias = Some((0.0.into(), (-2.0).into()));
    frame.quad([-1.0, -1.0], [0.0, 1.0], 0.25, BLUE);
    frame.fixed.raster.depth_bias = Some((0.0.into(), 2.0.into()));
    frame.quad([0.0, -1.0], [1.0, 1.0], 0.25, RED);
    let picture = frame.picture();
    assert_eq!((picture.count(GREEN), picture.count(BLUE)), (8, 8));
}

#[test]
fn stencil_counts_overlaps() {
    let test = |compare, reference, pass| Stencil {
        compare,
        reference,
        compare_mask: 0xff,
        write_mask: 0xff,
        fail: StencilOp::Keep,
        depth_fail: StencilOp::Keep,
        pass,
    };
    let mut frame = FrameBuilder::new(8, 4);
    frame.clear([0.0; 4]);
    frame.push(Operation::Clear(Clear {
        color: None,
        color_mask: 0xf,
        depth: None,
        stencil: Some((0, 0xff)),
        scissor: None,
    }));
    frame.fixed.raster.color_mask = 0;
    frame.fixed.raster.stencil = Some(test(Compare::Always, 0, StencilOp::Increment));
    frame.quad([-1.0, -1.0], [0.5, 1.0], 0.0, WHITE);
    frame.quad([-0.5, -1.0], [1.0, 1.0], 0.0, WHITE);
    frame.fixed.raster.color_mask = 0xf;
    frame.fixed.raster.stencil = Some(test(Compare::Equal, 2, StencilOp::Keep));
    frame.fill(0.0, GREEN);
    let picture = frame.picture();
    assert_eq!(picture.count(GREEN), 16);
    assert_eq!(picture.at(2, 0), GREEN);
}

#[test]
fn the_alpha_test_drops_fragments() {
    let passes = |function: Compare, alpha: u8| {
        let mut frame = FrameBuilder::new(2, 2);
        frame.clear([0.0; 4]);
        frame.fixed.words.global.set_alpha_func(function as u32);
        frame.environment.alpha_reference = 0.5;
        frame.fill(0.0, [255, 255, 255, alpha]);
        frame.picture().at(0, 0) != [0; 4]
    };
    assert!(passes(Compare::Greater, 200) && !passes(Compare::Greater, 100));
    assert!(passes(Compare::Less, 100) && !passes(Compare::Less, 200));
    assert!(!passes(Compare::Never, 200));
}

/// Colours of a white surface at eye distances 1 and 3 in green fog.
fn fogged(mode: u32) -> [[u8; 4]; 2] {
    let mut frame = FrameBuilder::new(8, 2);
    frame.clear([0.0; 4]);
    frame.fixed.words.global.set_fog_mode(mode);
    frame.environment.fog_color = [0.0, 1.0, 0.0, 1.0];
    (frame.environment.fog_start, frame.environment.fog_end) = (0.0, 4.0);
    frame.environment.fog_density = 0.5;
    for (eye_z, left) in [(-1.0, -1.0), (-3.0, 0.0)] {
        // Only the eye's z moves: the projection keeps everything in view.
        frame.transform.modelview[3] = [0.0, 0.0, eye_z, 1.0];
        frame.quad([left, -1.0], [left + 1.0, 1.0], 0.0, WHITE);
    }
    let picture = frame.picture();
    [picture.at(1, 1), picture.at(6, 1)]
}

#[test]
fn fog_follows_the_eye_distance() {
    type Factor = fn(f32) -> f32;
    let factors: [Factor; 3] = [
        |distance| (4.0 - distance) / 4.0,
        |distance| (-0.5 * distance).exp(),
        |distance| (-(0.5 * distance).powi(2)).exp(),
    ];
    for (mode, factor) in (1..).zip(factors) {
        for (found, distance) in fogged(mode).into_iter().zip([1.0, 3.0]) {
            let expected = factor(distance) * 255.0;
            assert!((f32::from(found[0]) - expected).abs() <= 1.5, "mode {mode}: {found:?}");
            assert_eq!((found[1], found[3]), (255, 255));
        }
    }
}

#[test]
fn the_colour_mask_keeps_components() {
    let mut frame = FrameBuilder::new(2, 2);
    frame.clear([0.0, 1.0, 0.0, 1.0]);
    frame.fixed.raster.color_mask = 0b0001;
    frame.fill(0.0, [255, 0, 255, 0]);
    assert_eq!(frame.picture().at(0, 0), [255, 255, 0, 255]);
}
