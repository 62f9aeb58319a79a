//! Times the ways of texels from the program's memory to an upload, beside a plain copy of as many bytes:
//! `cargo bench -p afterglow-gl --bench upload`.

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use afterglow_api::constants::*;
use afterglow_gl::frame::BaseFormat;
use afterglow_gl::pixel::{Extent, Packing, PixelLayout, PixelSource, PixelTransfer, unpack_texels};

/// The fastest run counts: it is the one that other programs disturbed least.
const RUNS: u32 = 60;

/// Megabytes of RGBA8 texels a second.
fn speed(texels: usize, mut run: impl FnMut()) -> f64 {
    let once = |_| {
        let start = Instant::now();
        run();
        start.elapsed().as_secs_f64()
    };
    let seconds = (0..RUNS).map(once).fold(f64::INFINITY, f64::min);
    (4 * texels) as f64 / 1e6 / seconds
}

fn convert(name: &str, format: u32, kind: u32, base: BaseFormat, side: usize, memcpy: f64) {
    let layout = PixelLayout::from_gl(format, kind).expect("a legal pair");
    let data: Vec<u8> = (0..side * side * layout.pixel_bytes()).map(|i| i as u8).collect();
    let (packing, transfer) = (Packing::tight(), PixelTransfer::default());
    let speed = speed(side * side, || {
        let source = PixelSource::new(&data, layout, &packing, Extent::plane(side, side));
        let source = source.expect("as many bytes as pixels take");
        black_box(unpack_texels(&source, &transfer, base).expect("within bounds"));
    });
    println!("{name:30} {speed:8.0} MB/s  {:5.2} of memcpy", speed / memcpy);
}

fn main() {
    for side in [64, 256, 1024] {
        let bytes: Vec<u8> = (0..4 * side * side).map(|i| i as u8).collect();
        let memcpy = speed(side * side, || drop(black_box(Arc::<[u8]>::from(black_box(&*bytes)))));
        println!("{side} x {side}: memcpy into new memory {memcpy:.0} MB/s");
        let convert = |name, format, kind, base| convert(name, format, kind, base, side, memcpy);
        convert("RGBA8 as RGBA", GL_RGBA, GL_UNSIGNED_BYTE, BaseFormat::Rgba);
        convert("RGBA8 as RGB", GL_RGBA, GL_UNSIGNED_BYTE, BaseFormat::Rgb);
        convert("BGRA8 as RGBA", GL_BGRA, GL_UNSIGNED_BYTE, BaseFormat::Rgba);
        convert("RGB8 as RGB", GL_RGB, GL_UNSIGNED_BYTE, BaseFormat::Rgb);
        convert("BGR8 as RGB", GL_BGR, GL_UNSIGNED_BYTE, BaseFormat::Rgb);
        convert("luminance as luminance", GL_LUMINANCE, GL_UNSIGNED_BYTE, BaseFormat::Luminance);
        convert("alpha as alpha", GL_ALPHA, GL_UNSIGNED_BYTE, BaseFormat::Alpha);
        convert("5_6_5 as RGB", GL_RGB, GL_UNSIGNED_SHORT_5_6_5, BaseFormat::Rgb);
        convert("float RGBA as RGBA", GL_RGBA, GL_FLOAT, BaseFormat::Rgba);
    }
}
