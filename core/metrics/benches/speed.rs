//! Times the metrics at 640x480: `cargo bench -p afterglow-metrics`.

use std::hint::black_box;
use std::time::Instant;

use afterglow_metrics::{Encoding, Image, compare, flip, ssim};

/// The fastest run counts: it is the one that other programs disturbed least.
const RUNS: u32 = 20;

fn picture(encoding: Encoding, noise: usize) -> Image {
    Image::from_fn(640, 480, encoding, |x, y| {
        let value = |c: usize| (x * (3 + c) + y * (5 - c) + noise * (x * y * 7 % 31)) % 256;
        [0, 1, 2].map(|c| value(c) as f32 / 255.0)
    })
    .expect("640x480 is an accepted size")
}

fn time(name: &str, mut run: impl FnMut()) {
    let once = |_| {
        let start = Instant::now();
        run();
        start.elapsed().as_secs_f64() * 1e3
    };
    let milliseconds = (0..RUNS).map(once).fold(f64::INFINITY, f64::min);
    println!("{name:12} {milliseconds:7.1} ms");
}

fn main() {
    for encoding in [Encoding::Srgb, Encoding::Linear] {
        let (a, b) = (picture(encoding, 1), picture(encoding, 0));
        println!("{encoding:?}, 640x480");
        time("FLIP", || drop(black_box(flip(&a, &b))));
        time("SSIM", || drop(black_box(ssim(&a, &b))));
        time("compare", || drop(black_box(compare(&a, &b, None))));
    }
}
