//! Which colour a draw is painted in.

use afterglow_gl::frame::{BlendFactor, Draw, FixedState, Frame};
use afterglow_scene::{Class, LightOrigin, Scene, Verdict};

use super::By;

/// Red, green, blue, 0 to 255.
pub type Rgb = [u8; 3];

/// Which pixels of a draw are painted. What lies over something leaves most of that to be seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Pattern {
    /// All.
    Solid,
    /// Every other one.
    Checkered,
    /// Stripes, one pixel in eight.
    Striped,
    /// None.
    Hidden,
}

/// How a draw is painted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Swatch {
    /// Colour.
    pub rgb: Rgb,
    /// Which pixels.
    pub pattern: Pattern,
}

/// Where nothing is drawn.
pub const BACKGROUND: Rgb = [24, 24, 24];
/// Draws that a picture tells nothing about.
pub const BESIDE: Rgb = [80, 80, 80];

/// What a draw adds to a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layer {
    /// A surface of its own.
    Base,
    /// A surface with its lightmap in a second texture unit, or with light baked into its vertices.
    BakedBase,
    /// Multiplies.
    Lightmap,
    /// Adds.
    Glow,
    /// Blends or replaces.
    Detail,
    /// No surface of the world.
    None,
}

impl Layer {
    /// All, in the legend's order.
    pub const ALL: [Layer; 6] =
        [Layer::Base, Layer::BakedBase, Layer::Lightmap, Layer::Detail, Layer::Glow, Layer::None];

    fn of(frame: &Frame, draw: &Draw, verdict: &Verdict) -> Layer {
        use BlendFactor as F;
        match verdict.class {
            class if class.is_traced() && verdict.baked => Layer::BakedBase,
            class if class.is_traced() => Layer::Base,
            Class::Layer => match frame.fixed[draw.fixed as usize].raster.blend.map(|blend| blend.rgb) {
                Some((F::DestinationColor, _) | (F::Zero, F::SourceColor)) => Layer::Lightmap,
                Some((_, F::One)) => Layer::Glow,
                _ => Layer::Detail,
            },
            _ => Layer::None,
        }
    }

    /// As the legend has it.
    pub fn color(self) -> (&'static str, Rgb) {
        match self {
            Layer::Base => ("base", [154, 154, 140]),
            Layer::BakedBase => ("base with light of its own (second unit, vertices)", [240, 150, 60]),
            Layer::Lightmap => ("lightmap: multiplies", [70, 130, 255]),
            Layer::Detail => ("detail: blends, replaces", [60, 200, 90]),
            Layer::Glow => ("glow: adds", [255, 240, 60]),
            Layer::None => ("no surface of the world", BESIDE),
        }
    }
}

/// Where the light on a surface comes from when it is traced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// The program's own lights.
    Gl,
    /// Colours or textures hold it already.
    Baked,
    /// The made-up sun.
    Fallback,
    /// The program's profile.
    Profile,
    /// Not traced.
    None,
}

impl Source {
    /// All, in the legend's order.
    pub const ALL: [Source; 5] = [Source::Gl, Source::Baked, Source::Fallback, Source::Profile, Source::None];

    /// Of a light.
    pub fn of(origin: LightOrigin) -> Source {
        match origin {
            LightOrigin::Gl(_) | LightOrigin::Program(_) | LightOrigin::SceneFile => Source::Gl,
            LightOrigin::Fallback => Source::Fallback,
            LightOrigin::Profile => Source::Profile,
            LightOrigin::Recovered => Source::Baked,
        }
    }

    /// On a draw's surface: as the renderer decides, an unlit surface keeps the program's colours where the program
    /// has lights, and a baked one wherever no light is the program's.
    fn on(frame: &Frame, draw: &Draw, verdict: &Verdict, scene: &Scene) -> Source {
        let FixedState { words, .. } = &frame.fixed[draw.fixed as usize];
        let origin = |light: &afterglow_scene::SceneLight| Source::of(light.origin);
        let has_own = scene.lights.iter().any(|light| origin(light) == Source::Gl);
        match scene.lights.first() {
            _ if !verdict.class.is_traced() => Source::None,
            None => Source::Baked,
            Some(_) if has_own => {
                if words.is_lit() {
                    Source::Gl
                } else {
                    Source::Baked
                }
            }
            Some(_) if verdict.baked => Source::Baked,
            Some(light) => origin(light),
        }
    }

    /// As the legend has it.
    pub fn color(self) -> (&'static str, Rgb) {
        match self {
            Source::Gl => ("the program's lights (glLight)", [255, 225, 70]),
            Source::Baked => ("the program's colours as they are", [240, 130, 50]),
            Source::Fallback => ("a made-up sun: nothing else was found", [90, 160, 255]),
            Source::Profile => ("lights of the profile", [80, 210, 100]),
            Source::None => ("not traced", BESIDE),
        }
    }
}

/// A class's colour.
pub fn class_color(class: Class) -> Rgb {
    match class {
        Class::Static => [160, 160, 146],
        Class::Movable => [245, 150, 40],
        Class::Dynamic => [235, 70, 170],
        Class::ViewModel => [250, 235, 70],
        Class::Translucent => [70, 220, 210],
        Class::Sky => [60, 100, 240],
        Class::Interface => [60, 190, 80],
        Class::Layer => [150, 90, 250],
        Class::OtherView => [150, 95, 50],
        Class::Dropped => [120, 20, 40],
        Class::Undecided => [255, 40, 40],
    }
}

/// A hue for each number; dark grey for 0, which names nothing.
pub fn hashed_color(number: u64) -> Rgb {
    if number == 0 {
        return BESIDE;
    }
    let hash = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let hue = (hash >> 48) as f32 / 65536.0;
    let saturation = 0.45 + 0.5 * ((hash >> 40 & 255) as f32 / 255.0);
    let value = 0.7 + 0.3 * ((hash >> 32 & 255) as f32 / 255.0);
    // Smith, *Color Gamut Transform Pairs* (1978): HSV to RGB.
    let channel = |offset: f32| {
        let k = (offset + hue * 6.0) % 6.0;
        let level = value - value * saturation * k.min(4.0 - k).clamp(0.0, 1.0);
        (level * 255.0).round() as u8
    };
    [channel(5.0), channel(3.0), channel(1.0)]
}

/// Colour of a reason.
pub fn reason_color(reason: &str) -> Rgb {
    hashed_color(xxhash_rust::xxh3::xxh3_64(reason.as_bytes()) | 1)
}

/// The swatches of a frame's draws, in order.
pub fn swatches(by: By, frame: &Frame, scene: &Scene) -> Vec<Swatch> {
    let swatch = |((_, draw), verdict): ((usize, &Draw), &Verdict)| {
        let rgb = match by {
            By::Class => class_color(verdict.class),
            By::Id => hashed_color(verdict.object),
            By::Layer => Layer::of(frame, draw, verdict).color().1,
            By::Light => Source::on(frame, draw, verdict, scene).color().1,
            By::Reason => reason_color(verdict.reason),
        };
        Swatch { rgb, pattern: pattern(by, frame, draw, verdict) }
    };
    frame.draws().zip(&scene.verdicts).map(swatch).collect()
}

fn pattern(by: By, frame: &Frame, draw: &Draw, verdict: &Verdict) -> Pattern {
    match verdict.class {
        // The surface below tells how it is lit, and whose it is.
        Class::Layer if by == By::Light => Pattern::Hidden,
        Class::Layer if by == By::Id && verdict.object == 0 => Pattern::Hidden,
        Class::Layer => Pattern::Striped,
        // The sky hides only what was cleared.
        class if class.is_traced() || class == Class::Sky => Pattern::Solid,
        _ if frame.fixed[draw.fixed as usize].raster.blend.is_some() => Pattern::Checkered,
        _ => Pattern::Solid,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_of_classes_are_far_from_each_other() {
        let distance =
            |a: Rgb, b: Rgb| (0..3).map(|i| (i32::from(a[i]) - i32::from(b[i])).pow(2)).sum::<i32>();
        for (i, a) in Class::ALL.iter().enumerate() {
            for b in &Class::ALL[..i] {
                assert!(distance(class_color(*a), class_color(*b)) > 60 * 60, "{a:?} {b:?}");
            }
            assert!(distance(class_color(*a), BACKGROUND) > 60 * 60);
        }
    }

    #[test]
    fn numbers_have_hues_and_none_is_grey() {
        assert_eq!(hashed_color(0), BESIDE);
        assert_eq!(hashed_color(7), hashed_color(7));
        assert_ne!(hashed_color(7), hashed_color(8));
    }
}
