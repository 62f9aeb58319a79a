//! Values of options as words.

use afterglow_engine::Chord;
use afterglow_render::{Backend, LightChoice, Mode, Paint, SkyChoice};
use afterglow_scene::Replacing;

pub(super) fn mode(value: &str) -> Option<Mode> {
    match value {
        "raster" => Some(Mode::Raster),
        "pathtrace" => Some(Mode::Pathtrace),
        "reference" => Some(Mode::Reference),
        _ => None,
    }
}

/// None is the faster one.
pub(super) fn backend(value: &str) -> Option<Option<Backend>> {
    match value {
        "auto" => Some(None),
        "software" => Some(Some(Backend::Software)),
        "hardware" => Some(Some(Backend::Hardware)),
        _ => None,
    }
}

pub(super) fn sky(value: &str) -> Option<SkyChoice> {
    match value {
        "constant" => Some(SkyChoice::Constant),
        "cube" => Some(SkyChoice::Cube),
        _ => None,
    }
}

pub(super) fn replacing(value: &str) -> Option<Replacing> {
    match value {
        "auto" => Some(Replacing::WhereGood),
        "keep" => Some(Replacing::Never),
        "replace" => Some(Replacing::Always),
        _ => None,
    }
}

pub(super) fn number(value: &str) -> Option<u32> {
    value.parse().ok()
}

/// A whole number between two others, these included.
pub(super) fn within(least: u32, most: u32) -> impl Fn(&str) -> Option<u32> {
    move |value| number(value).filter(|number| (least..=most).contains(number))
}

/// More than 0; `inf` for no limit.
pub(super) fn radiance(value: &str) -> Option<f32> {
    value.parse().ok().filter(|limit| *limit > 0.0)
}

pub(super) fn lights(value: &str) -> Option<LightChoice> {
    match value {
        "resampled" => Some(LightChoice::Resampled),
        "uniform" => Some(LightChoice::Uniform),
        _ => None,
    }
}

/// A share from a half to all.
pub(super) fn light_scale(value: &str) -> Option<f32> {
    value.parse().ok().filter(|scale| (0.5..=1.0).contains(scale))
}

pub(super) fn view(value: &str) -> Option<Paint> {
    Paint::ALL.into_iter().find(|paint| paint.name() == value)
}

/// The keys of an action; it may have none.
pub(super) fn chord(value: &str) -> Option<Option<Chord>> {
    match value {
        "none" | "off" | "false" => Some(None),
        value => value.parse().ok().map(Some),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_bounds() {
        assert_eq!(within(1, 8)("8"), Some(8));
        assert_eq!([within(1, 8)("0"), within(1, 8)("9"), within(0, 8)("-1")], [None; 3]);
        assert_eq!([radiance("inf"), radiance("0.5")], [Some(f32::INFINITY), Some(0.5)]);
        assert_eq!([radiance("0"), radiance("nan"), radiance("-1")], [None; 3]);
        assert_eq!((view("picture"), view("Sky")), (Some(Paint::Picture), None));
        assert_eq!((chord("none"), chord("Ctrl")), (Some(None), None));
        assert!(chord("Ctrl+F1").flatten().is_some());
        assert_eq!([light_scale("0.5"), light_scale("0.4"), light_scale("nan")], [Some(0.5), None, None]);
        assert_eq!(lights("uniform"), Some(LightChoice::Uniform));
    }
}
