//! Which texels rays read: of a wall of squares that a floor shows again.

use afterglow_api::constants::*;
use afterglow_gl::texture::ImageDefinition;
use afterglow_gl::{Context, Params};

use super::pathtrace::{SIZE, Stage};
use crate::testing::assert_valid;
use crate::{Denoiser, Mode, Radiance};

/// Texels along a side of the texture, which is two squares wide and high.
const TEXELS: u32 = 64;
/// Half of the wall's width, and how far away it is.
const HALF: f32 = 40.0;
const AWAY: f32 = 30.0;

/// What a test looks at.
struct Hall {
    mode: Mode,
    samples: u32,
    /// Squares along the wall.
    squares: u32,
    /// Bytes of the two kinds of squares.
    shades: [u8; 2],
    /// Roughness and metallic of the floor.
    floor: [f32; 2],
    /// Pixels that the camera has turned to the right.
    turned: f32,
    /// The wall's first texture coordinate.
    first: f32,
}

fn texture(gl: &mut Context, shades: [u8; 2]) {
    gl.bind_texture(GL_TEXTURE_2D, 1);
    gl.tex_parameter(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, Params::Ints(&[1]));
    gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, Params::Ints(&[GL_LINEAR_MIPMAP_LINEAR as i32]));
    let shade = |index: u32| {
        let [x, y] = [index % TEXELS, index / TEXELS].map(|at| at / (TEXELS / 2));
        [shades[((x + y) % 2) as usize]; 3]
    };
    let texels: Vec<u8> = (0..TEXELS * TEXELS).flat_map(shade).collect();
    let definition = ImageDefinition {
        level: 0,
        internal_format: GL_RGB,
        size: [TEXELS as i32, TEXELS as i32, 1],
        border: 0,
    };
    gl.tex_image((GL_TEXTURE_2D, 2), definition, (GL_RGB, GL_UNSIGNED_BYTE), Some(&texels));
}

impl Hall {
    /// A floor that is met at less than 20 degrees, and behind it a wall that a light shines at straight on.
    fn draw(&self, gl: &mut Context) {
        gl.clear_color(0.0, 0.0, 0.0, 1.0);
        gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl.matrix_mode(GL_PROJECTION);
        gl.load_identity();
        gl.frustum(-0.4, 0.4, -0.3, 0.3, 1.0, 100.0);
        gl.matrix_mode(GL_MODELVIEW);
        gl.load_identity();
        gl.rotate((self.turned * 0.8 / SIZE.0 as f32).to_degrees(), 0.0, 1.0, 0.0);
        gl.translate(0.0, -1.0, 0.0);
        gl.enable(GL_DEPTH_TEST);
        gl.color([1.0; 4]);
        texture(gl, self.shades);
        gl.scene_view();
        gl.scene_directional_light(1, [0.0, 0.0, -1.0], [1.0; 3], 0.0);
        gl.scene_sky(0.0, 0.0, 0.0);
        let quad = |gl: &mut Context, corners: [[f32; 3]; 4], first: f32, repeats: f32| {
            gl.begin(GL_QUADS);
            for ([x, y, z], [u, v]) in
                corners.into_iter().zip([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
            {
                gl.tex_coord([first + u * repeats, first + v * repeats, 0.0, 1.0]);
                gl.vertex([x, y, z, 1.0]);
            }
            gl.end();
        };
        let [roughness, metallic] = self.floor;
        gl.scene_material(roughness, metallic);
        gl.normal([0.0, 1.0, 0.0]);
        let (left, right) = (-HALF, HALF);
        quad(gl, [[left, 0.0, 1.0], [right, 0.0, 1.0], [right, 0.0, -AWAY], [left, 0.0, -AWAY]], 0.0, 0.0);
        gl.scene_defaults();
        gl.enable(GL_TEXTURE_2D);
        let repeats = self.squares as f32 / 2.0;
        let [low, high] = [0.0, 2.0 * HALF];
        let wall = [[left, low, -AWAY], [right, low, -AWAY], [right, high, -AWAY], [left, high, -AWAY]];
        quad(gl, wall, self.first, repeats);
        gl.disable(GL_TEXTURE_2D);
        gl.swap_buffers();
        assert_eq!(gl.get_error(), GL_NO_ERROR);
    }

    fn radiance(&self) -> Radiance {
        let mut stage = Stage::new(self.mode, |options| {
            options.spp = self.samples;
            options.denoiser = Denoiser::None;
            options.keeps_radiance = true;
        });
        self.draw(&mut stage.gl);
        assert_valid();
        stage.renderer.lock().unwrap().read_radiance().unwrap().unwrap()
    }

    /// Red of a block of the floor, row by row.
    fn floor(&self) -> Vec<f64> {
        let radiance = self.radiance();
        let pixels = (48..68).flat_map(|y| (16..80).map(move |x| y * SIZE.0 + x));
        pixels.map(|index| f64::from(radiance.mean[index as usize][0])).collect()
    }
}

/// Mean, and standard deviation as a share of it.
fn spread(values: impl ExactSizeIterator<Item = f64> + Clone) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.clone().sum::<f64>() / count;
    (mean, (values.map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt() / mean)
}

/// How much pixels change, as a share, while the camera turns by parts of a pixel.
fn flicker(hall: &Hall) -> f64 {
    let turned = |step: u8| Hall { turned: f32::from(step) / 4.0, ..*hall }.floor();
    let pictures: Vec<Vec<f64>> = (0..4).map(turned).collect();
    let pixels = pictures[0].len();
    (0..pixels).map(|pixel| spread(pictures.iter().map(|picture| picture[pixel])).1).sum::<f64>()
        / pixels as f64
}

const MIRROR: [f32; 2] = [0.0, 1.0];

#[test]
fn what_a_mirror_shows_of_small_squares_stands_still() {
    // A pixel is 0.25 wide on the wall, and a square 0.1.
    let fine = Hall {
        mode: Mode::Pathtrace,
        samples: 1,
        squares: 800,
        shades: [0, 255],
        floor: MIRROR,
        turned: 0.0,
        first: 0.0,
    };
    assert!(flicker(&fine) < 0.02, "{}", flicker(&fine));
    let reference = Hall { mode: Mode::Reference, ..fine };
    assert!(flicker(&reference) < 0.02, "{}", flicker(&reference));
}

#[test]
fn what_a_mirror_shows_of_large_squares_is_sharp() {
    for (mode, samples) in [(Mode::Pathtrace, 1), (Mode::Reference, 8)] {
        let squares =
            Hall { mode, samples, squares: 40, shades: [0, 255], floor: MIRROR, turned: 0.0, first: 0.0 };
        // A square is eight pixels wide: most are all black or all white.
        let mut floor = squares.floor();
        floor.sort_by(f64::total_cmp);
        let (dark, bright) = (floor[floor.len() / 4], floor[3 * floor.len() / 4]);
        assert!(dark < 0.02 * bright, "{mode:?}: {dark} {bright}");
    }
}

#[test]
fn light_of_small_squares_is_that_of_their_mean() {
    let matte = |squares: u32, shades: [u8; 2]| Hall {
        mode: Mode::Pathtrace,
        samples: 1,
        squares,
        shades,
        floor: [1.0, 0.0],
        turned: 0.0,
        first: 0.0,
    };
    let noise = |hall: &Hall| spread(hall.floor().into_iter().collect::<Vec<_>>().into_iter());
    let (plain, plain_noise) = noise(&matte(800, [128; 2]));
    let (fine, fine_noise) = noise(&matte(800, [90, 166]));
    assert!((fine / plain - 1.0).abs() < 0.05, "{fine} {plain}");
    assert!(fine_noise < 1.02 * plain_noise, "{fine_noise} {plain_noise}");
}

#[test]
fn coordinates_that_are_far_away_or_no_numbers() {
    let hall = |first: f32, mode: Mode| Hall {
        mode,
        samples: 4,
        squares: 800,
        shades: [90, 166],
        floor: MIRROR,
        turned: 0.0,
        first,
    };
    for mode in [Mode::Pathtrace, Mode::Reference] {
        let (expected, _) = spread(hall(0.0, mode).floor().into_iter());
        for first in [1e5, -1e5] {
            let (mean, _) = spread(hall(first, mode).floor().into_iter());
            assert!((mean / expected - 1.0).abs() < 0.05, "{mode:?}, {first}: {mean}, not {expected}");
        }
        for first in [1e6, 1e9, f32::MAX, f32::INFINITY, f32::NAN] {
            let floor = hall(first, mode).floor();
            // Whichever texels are shown, they are the texture's.
            let is_sound = |value: &f64| (0.2 * expected..5.0 * expected).contains(value);
            assert!(floor.iter().all(is_sound), "{mode:?}, {first}");
        }
    }
}
