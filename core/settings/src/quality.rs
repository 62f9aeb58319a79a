//! Presets: how much work goes into a picture, by one word.

use std::str::FromStr;

use afterglow_render::{Denoiser, LightChoice, PathtraceOptions};

/// A set of options by one word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Preset {
    /// For devices that can hardly trace at all.
    Low,
    /// What there is without a preset in live programs.
    Medium,
    /// Less noise, and light in corners.
    High,
    /// For pictures rather than for play.
    Ultra,
}

/// What presets say. The one table of them: another option is a field here and a column there.
struct Row {
    preset: Preset,
    name: &'static str,
    samples: u32,
    bounces: u32,
    candidates: u32,
    asked: u32,
    limit: f32,
    light_scale: f32,
}

#[rustfmt::skip]
const TABLE: [Row; 4] = [
    Row { preset: Preset::Low,    name: "low",    samples: 1, bounces: 1, candidates: 2, asked: 1, limit: 8.0, light_scale: 0.5 },
    Row { preset: Preset::Medium, name: "medium", samples: 1, bounces: 1, candidates: 4, asked: 4, limit: 16.0, light_scale: 1.0 },
    Row { preset: Preset::High,   name: "high",   samples: 2, bounces: 2, candidates: 8, asked: 4, limit: 16.0, light_scale: 1.0 },
    Row { preset: Preset::Ultra,  name: "ultra",  samples: 8, bounces: 4, candidates: 8, asked: 4, limit: 64.0, light_scale: 1.0 },
];

/// A word that is no preset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("presets are low, medium, high and ultra")]
pub struct UnknownPreset;

impl Preset {
    /// All, the least work first.
    pub const ALL: [Preset; 4] = [Preset::Low, Preset::Medium, Preset::High, Preset::Ultra];
    /// Their names, in the same order.
    pub const NAMES: [&'static str; 4] = [TABLE[0].name, TABLE[1].name, TABLE[2].name, TABLE[3].name];

    /// As options write it.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The one that comes after it; the first after the last.
    pub fn next(self) -> Preset {
        Self::ALL[(self as usize + 1) % Self::ALL.len()]
    }

    fn row(self) -> &'static Row {
        // The table has them in their order; a test holds it to that.
        &TABLE[self as usize]
    }
}

impl FromStr for Preset {
    type Err = UnknownPreset;

    fn from_str(text: &str) -> Result<Preset, UnknownPreset> {
        TABLE.iter().find(|row| row.name == text).map(|row| row.preset).ok_or(UnknownPreset)
    }
}

/// How much work goes into a picture: a preset, and what is said besides, which counts more.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Quality {
    /// What holds where nothing else is said.
    pub preset: Option<Preset>,
    /// Samples a pixel and frame, at least 1.
    pub samples: Option<u32>,
    /// Bounces of light between surfaces.
    pub bounces: Option<u32>,
    /// Candidates of which one light is kept, 1 to 8.
    pub candidates: Option<u32>,
    /// Lights that a sample asks at the surface that is seen, 1 to 4.
    pub asked: Option<u32>,
    /// Radiance that a sample brings at most.
    pub limit: Option<f32>,
    /// How one of many lights is chosen.
    pub lights: Option<LightChoice>,
    /// Pixels keep a light from frame to frame.
    pub reuse: Option<bool>,
    /// What makes a picture of few samples.
    pub denoiser: Option<Denoiser>,
    /// Texels of light along a side for each pixel, 0.5 to 1.
    pub light_scale: Option<f32>,
    /// Edges of triangles are smoothed.
    pub antialiasing: Option<bool>,
}

impl Quality {
    /// Tells a renderer. What neither the preset nor anything else says stays as it is.
    pub fn apply(&self, options: &mut PathtraceOptions) {
        let row = self.preset.map(Preset::row);
        let set = |to: &mut u32, said: Option<u32>, of_preset: fn(&Row) -> u32| {
            *to = said.or(row.map(of_preset)).unwrap_or(*to);
        };
        set(&mut options.spp, self.samples, |row| row.samples);
        set(&mut options.surfaces, self.bounces.map(|bounces| bounces.saturating_add(1)), |row| {
            row.bounces + 1
        });
        set(&mut options.candidates, self.candidates, |row| row.candidates);
        set(&mut options.asked, self.asked, |row| row.asked);
        options.most_radiance = self.limit.or(row.map(|row| row.limit)).unwrap_or(options.most_radiance);
        options.light_choice = self.lights.unwrap_or(options.light_choice);
        let reuse = self.reuse.unwrap_or(options.keeps_lights);
        options.keeps_lights = reuse && options.light_choice == LightChoice::Resampled;
        options.denoiser = self.denoiser.unwrap_or(options.denoiser);
        options.light_scale =
            self.light_scale.or(row.map(|row| row.light_scale)).unwrap_or(options.light_scale);
        options.smooth_edges = self.antialiasing.unwrap_or(options.smooth_edges);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn applied(quality: &Quality) -> PathtraceOptions {
        let mut options = PathtraceOptions::default();
        quality.apply(&mut options);
        options
    }

    #[test]
    fn presets_are_words_in_an_order() {
        for (index, (preset, row)) in Preset::ALL.into_iter().zip(&TABLE).enumerate() {
            assert_eq!((preset as usize, preset), (index, row.preset));
            assert_eq!(preset.name().parse(), Ok(preset));
            assert_eq!(Preset::NAMES[index], preset.name());
        }
        assert_eq!("best".parse::<Preset>(), Err(UnknownPreset));
        assert_eq!((Preset::Low.next(), Preset::Ultra.next()), (Preset::Medium, Preset::Low));
    }

    #[test]
    fn each_preset_asks_for_no_less_work_than_the_one_before() {
        let work = |row: &Row| [row.samples, row.bounces, row.candidates, row.asked];
        for pair in TABLE.windows(2) {
            assert!(work(&pair[0]).iter().zip(work(&pair[1])).all(|(less, more)| *less <= more));
            assert_ne!(work(&pair[0]), work(&pair[1]));
        }
        assert!(TABLE.iter().all(|row| (1..=8).contains(&row.candidates) && (1..=4).contains(&row.asked)));
    }

    #[test]
    fn nothing_said_changes_nothing_and_medium_is_what_live_programs_have() {
        assert_eq!(applied(&Quality::default()), PathtraceOptions::default());
        let medium = applied(&Quality { preset: Some(Preset::Medium), ..Quality::default() });
        let mut live = PathtraceOptions::default();
        live.spp = 1;
        assert_eq!(medium, live);
    }

    #[test]
    fn what_is_said_counts_more_than_the_preset() {
        let said =
            Quality { preset: Some(Preset::Ultra), samples: Some(3), limit: Some(2.0), ..Quality::default() };
        let options = applied(&said);
        assert_eq!((options.spp, options.most_radiance, options.surfaces), (3, 2.0, 5));
        let said = Quality { reuse: Some(true), lights: Some(LightChoice::Uniform), ..Quality::default() };
        assert!(!applied(&said).keeps_lights);
    }
}
