//! Frames drawn at another size than the program's: the program must not see it.

use afterglow_gl::backend::{Reply, Request};
use afterglow_gl::frame::{
    BaseFormat, Clear, ImageCopy, Operation, PixelBuffer, PixelContent, PixelCopy, PixelRectangle, Rect,
    Region,
};

use crate::Scale;
use crate::testing::*;

/// What a program with a window of 8 by 8 pixels reads back when another size is drawn. Edges lie between every
/// second pixel, so that half the size still shows all.
fn read_back(to: (u32, u32), buffer: PixelBuffer, rect: Rect) -> Reply {
    let mut frame = FrameBuilder::new(8, 8);
    let image = frame.define([8, 8], BaseFormat::Rgba);
    frame.clear([0.0, 0.0, 1.0, 1.0]);
    frame.quad([-1.0, -1.0], [0.0, 0.0], 0.0, RED);
    let green = Clear {
        color: Some([0.0, 1.0, 0.0, 1.0]),
        color_mask: 0xf,
        depth: Some(0.25),
        stencil: Some((7, 0xff)),
        scissor: Some(Rect { x: 4, y: 4, width: 2, height: 99 }),
    };
    frame.push(Operation::Clear(green));
    let state = frame.state();
    frame.push(Operation::Pixels(Box::new(PixelRectangle {
        content: PixelContent::Color([WHITE, BLACK].concat().into()),
        width: 1,
        height: 2,
        position: [6.0, 2.0],
        depth: 0.0,
        zoom: [2.0, 2.0],
        fixed: state.fixed,
        viewport: state.viewport,
        bindings: state.bindings,
        environment: state.environment,
        current: state.current,
    })));
    frame.push(Operation::CopyPixels(Box::new(PixelCopy {
        buffer: PixelBuffer::Color,
        source: Rect { x: 6, y: 2, width: 2, height: 4 },
        position: [0.0, 4.0],
        depth: 0.0,
        zoom: [1.0, 1.0],
        fixed: state.fixed,
        viewport: state.viewport,
        bindings: state.bindings,
        environment: state.environment,
        current: state.current,
    })));
    frame.push(Operation::CopyToImage(ImageCopy {
        image,
        region: Region { level: 0, layer: 0, offset: [0; 3], extent: [8, 8, 1] },
        source: Rect { x: 0, y: 0, width: 8, height: 8 },
        base_format: BaseFormat::Rgba,
    }));
    frame.viewport.rect = Rect { x: 2, y: 0, width: 8, height: 8 };
    frame.bind(0, image, BaseFormat::Rgba, nearest());
    frame.textured_fill([1.0, 1.0]);

    let scale = Scale { from: frame.frame.size, to };
    scale.frame(&mut frame.frame);
    let request = Request::Pixels { buffer, rect };
    let mut renderer = renderer();
    let reply = renderer.execute_and_answer(&frame.frame, &scale.request(&request)).unwrap();
    assert_eq!(renderer.size(), [to.0, to.1]);
    scale.reply(&request, reply)
}

#[test]
fn a_program_reads_what_it_would_have_drawn() {
    let partly_outside = Rect { x: -2, y: 1, width: 9, height: 9 };
    for buffer in [PixelBuffer::Color, PixelBuffer::Depth, PixelBuffer::Stencil] {
        let expected = read_back((8, 8), buffer, partly_outside);
        for to in [(16, 16), (4, 4), (4, 24), (8, 4)] {
            assert_eq!(read_back(to, buffer, partly_outside), expected, "{buffer:?} at {to:?}");
        }
    }
    let Reply::Color(bytes) = read_back((4, 4), PixelBuffer::Color, Rect { x: 0, y: 0, width: 8, height: 8 })
    else {
        panic!("no colours");
    };
    let count = |color| bytes.as_chunks::<4>().0.iter().filter(|pixel| **pixel == color).count();
    // The texture, drawn two pixels to the right of where it was copied, shows the columns 0 to 5 again.
    let expected = [(RED, 24), (GREEN, 8), (WHITE, 8), (BLACK, 8), (BLUE, 16)];
    for (color, pixels) in expected {
        assert_eq!(count(color), pixels, "{color:?}");
    }
    assert_valid();
}
