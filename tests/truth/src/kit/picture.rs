//! Pictures for textures, made in code.

use glam::Vec2;

use super::Random;

/// A square picture, rows from the lowest upward.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width and height, a power of two.
    pub size: usize,
    /// RGBA.
    pub texels: Vec<[u8; 4]>,
}

impl Picture {
    /// A picture by its colour (0 to 1) at each place (0 to 1).
    pub fn of(size: usize, color: impl Fn(f32, f32) -> [f32; 4]) -> Picture {
        let texel = |i: usize| {
            let place = |i: usize| (i as f32 + 0.5) / size as f32;
            color(place(i % size), place(i / size)).map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
        };
        Picture { size, texels: (0..size * size).map(texel).collect() }
    }

    /// The texel at a place (0 to 1).
    pub fn at(&self, place: Vec2) -> [u8; 4] {
        let along = |v: f32| ((v * self.size as f32) as usize).min(self.size - 1);
        self.texels[along(place.y) * self.size + along(place.x)]
    }

    /// Whether no texel has an alpha below one.
    pub fn is_opaque(&self) -> bool {
        self.texels.iter().all(|texel| texel[3] == 255)
    }

    /// One colour with grain.
    pub fn grain(seed: u64, color: [f32; 3], amount: f32) -> Picture {
        let mut random = Random::new(seed);
        let grain: Vec<f32> = (0..64 * 64).map(|_| random.between(-amount, amount)).collect();
        Picture::of(64, |x, y| {
            let at = |dx: f32, dy: f32| {
                let wrap = |v: f32| (v * 64.0) as usize % 64;
                grain[wrap(y + dy) * 64 + wrap(x + dx)]
            };
            // Neighbours together look like a surface, not like noise.
            let sum = at(0.0, 0.0) + at(0.02, 0.0) + at(0.0, 0.02) + at(0.02, 0.02);
            let [r, g, b] = color.map(|c| c + sum / 2.0);
            [r, g, b, 1.0]
        })
    }

    /// Bricks in mortar.
    pub fn bricks(color: [f32; 3]) -> Picture {
        Picture::of(64, |x, y| {
            let row = (y * 8.0).floor();
            let along = x * 4.0 + if row % 2.0 == 0.0 { 0.0 } else { 0.5 };
            let is_mortar = (y * 8.0).fract() < 0.15 || along.fract() < 0.08;
            let shade = 0.8 + 0.2 * ((along.floor() * 7.3 + row * 3.7).sin());
            let [r, g, b] = if is_mortar { [0.45; 3] } else { color.map(|c| c * shade) };
            [r, g, b, 1.0]
        })
    }

    /// Two colours in squares.
    pub fn checker(squares: f32, a: [f32; 3], b: [f32; 3]) -> Picture {
        Picture::of(64, |x, y| {
            let odd = ((x * squares).floor() + (y * squares).floor()) % 2.0 != 0.0;
            let [r, g, b] = if odd { a } else { b };
            [r, g, b, 1.0]
        })
    }

    /// A soft spot whose alpha fades from the middle.
    pub fn glow(color: [f32; 3]) -> Picture {
        Picture::of(32, |x, y| {
            let [r, g, b] = color;
            let distance = (x - 0.5).hypot(y - 0.5) * 2.0;
            [r, g, b, (1.0 - distance).max(0.0).powi(2)]
        })
    }

    /// A tree: trunk and crown, nothing about them.
    pub fn tree() -> Picture {
        Picture::of(64, |x, y| {
            let crown = (x - 0.5).abs() < 0.45 * (1.0 - (y - 0.25) / 0.75) && y > 0.25;
            let trunk = (x - 0.5).abs() < 0.06 && y <= 0.25;
            let shade = 0.8 + 0.2 * (x * 40.0).sin() * (y * 37.0).cos();
            match (crown, trunk) {
                (true, _) => [0.12 * shade, 0.42 * shade, 0.14 * shade, 1.0],
                (_, true) => [0.35, 0.22, 0.1, 1.0],
                _ => [0.1, 0.3, 0.1, 0.0],
            }
        })
    }

    /// Clouds in a blue sky.
    pub fn clouds() -> Picture {
        Picture::of(64, |x, y| {
            let wave = |fx: f32, fy: f32, p: f32| ((x * fx + p).sin() * (y * fy - p).cos() + 1.0) / 2.0;
            let turn = std::f32::consts::TAU;
            let cover = wave(turn, turn, 0.3) * 0.6 + wave(3.0 * turn, 2.0 * turn, 1.1) * 0.4;
            let white = ((cover - 0.45) * 3.0).clamp(0.0, 1.0);
            [0.35 + 0.6 * white, 0.55 + 0.42 * white, 0.9 + 0.1 * white, 1.0]
        })
    }

    /// Water with ripples.
    pub fn water() -> Picture {
        let turn = std::f32::consts::TAU;
        Picture::of(64, |x, y| {
            let ripple = ((x * 3.0 * turn + (y * turn).sin()).sin() + (y * 4.0 * turn).sin()) * 0.1;
            [0.1 + ripple, 0.3 + ripple, 0.5 + ripple, 1.0]
        })
    }
}
