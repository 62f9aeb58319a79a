//! How the render thread renders, and what of it may change while it does.

use std::path::PathBuf;

use afterglow_gpu::GpuOptions;
use afterglow_render::{Backend, Mode, PathtraceOptions};
use afterglow_settings::Quality;

use crate::keys::Keys;

/// How to render.
#[derive(Debug, Clone, Default)]
pub struct EngineOptions {
    /// Which device.
    pub gpu: GpuOptions,
    /// What frames become. Unless it is said, paths are traced where that is fast enough to play.
    pub mode: Option<Mode>,
    /// How worlds are traced, `quality` not yet applied.
    pub pathtrace: PathtraceOptions,
    /// How much work goes into a picture.
    pub quality: Quality,
    /// What traces rays. Unless it is said, the faster backend, which is found on the first world.
    pub backend: Option<Backend>,
    /// Show figures in windows.
    pub hud: bool,
    /// Keys that a player may press; none are listened to unless it is said.
    pub keys: Option<Keys>,
    /// Folder for screenshots; none are written without.
    pub screenshots: Option<PathBuf>,
}

/// Where options come from that may change while a program plays.
pub trait OptionsSource: Send {
    /// What is to hold from now on, if it has changed since this was asked last. The render thread asks about once a second,
    /// between two frames, and waits for the answer.
    fn changed(&mut self) -> Option<EngineOptions>;
}

impl EngineOptions {
    /// How worlds are traced now.
    pub(crate) fn traced(&self) -> PathtraceOptions {
        let mut pathtrace = self.pathtrace.clone();
        self.quality.apply(&mut pathtrace);
        pathtrace
    }

    /// Names of options that another value came for, and that hold as they are until the program ends.
    pub(crate) fn fixed_changes(&self, new: &EngineOptions) -> Vec<&'static str> {
        let (old, of_paths) = (&self.pathtrace, &new.pathtrace);
        let changes = [
            ("device", self.gpu.device != new.gpu.device),
            ("validation", self.gpu.validation != new.gpu.validation),
            ("profile", old.profile != of_paths.profile),
            ("baked", old.replacing != of_paths.replacing),
            ("keep", old.cache != of_paths.cache),
            ("replace_images", old.images != of_paths.images),
        ];
        changes.into_iter().filter(|(_, is_other)| *is_other).map(|(name, _)| name).collect()
    }

    /// Takes over what has changed between two answers of a source, and may. What keys have changed meanwhile stays, unless
    /// the source has changed the same.
    pub(crate) fn take_over(&mut self, former: &EngineOptions, new: &EngineOptions) {
        take(&mut self.mode, &former.mode, &new.mode);
        take(&mut self.quality, &former.quality, &new.quality);
        take(&mut self.hud, &former.hud, &new.hud);
        take(&mut self.keys, &former.keys, &new.keys);
        take(&mut self.screenshots, &former.screenshots, &new.screenshots);
        take(&mut self.backend, &former.backend, &new.backend);
        let (now, old, new) = (&mut self.pathtrace, &former.pathtrace, &new.pathtrace);
        take(&mut now.seed, &old.seed, &new.seed);
        take(&mut now.sky, &old.sky, &new.sky);
        take(&mut now.memory_bytes, &old.memory_bytes, &new.memory_bytes);
        take(&mut now.paint, &old.paint, &new.paint);
    }
}

fn take<T: PartialEq + Clone>(now: &mut T, former: &T, new: &T) {
    if former != new {
        now.clone_from(new);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afterglow_render::Paint;
    use afterglow_settings::Preset;

    #[test]
    fn only_what_a_source_has_changed_is_taken_over() {
        let former = EngineOptions::default();
        let mut now = former.clone();
        // What keys did.
        now.mode = Some(Mode::Raster);
        now.pathtrace.paint = Paint::Albedo;
        now.quality.preset = Some(Preset::High);
        let mut new = former.clone();
        new.pathtrace.seed = 5;
        new.quality.samples = Some(3);
        new.hud = true;
        new.gpu.device = Some("other".into());
        now.take_over(&former, &new);
        assert_eq!((now.mode, now.pathtrace.paint), (Some(Mode::Raster), Paint::Albedo));
        assert_eq!((now.quality.preset, now.traced().spp, now.traced().seed), (None, 3, 5));
        assert!(now.hud && now.gpu.device.is_none());
        assert_eq!(former.fixed_changes(&new), ["device"]);
        assert!(new.fixed_changes(&new).is_empty());
    }
}
