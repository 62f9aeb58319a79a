//! What changes while a program plays: by its player's keys, and by what options' source says. All of it happens between
//! two frames.

use std::time::{Duration, Instant};

use afterglow_render::{Mode, Paint, RenderError};
use afterglow_settings::Preset;

use super::{State, first_backend};
use crate::contest::Contest;
use crate::drawable::Drawable;
use crate::hud::{Manner, mode_name};
use crate::keyboard::Keyboard;
use crate::keys::{Action, Keys};
use crate::options::{EngineOptions, OptionsSource};
use crate::screenshots::{Picture, Screenshots};

/// How often the source is asked.
const LOOK: Duration = Duration::from_secs(1);

/// What it takes to notice changes.
pub(super) struct Live {
    source: Option<Box<dyn OptionsSource>>,
    /// When it was asked last.
    asked_at: Instant,
    /// What it said last, whatever keys have changed since.
    said: EngineOptions,
    /// Options that cannot change, of which that has been said.
    told: Vec<&'static str>,
    keyboard: Option<Keyboard>,
    shots: Screenshots,
    /// Counted up with each change of how worlds are traced: drawables that know of an older one are told.
    pub(super) version: u64,
}

impl Live {
    pub(super) fn new(options: &EngineOptions, source: Option<Box<dyn OptionsSource>>) -> Self {
        Self {
            source,
            asked_at: Instant::now(),
            said: options.clone(),
            told: Vec::new(),
            keyboard: None,
            shots: Screenshots::default(),
            version: 0,
        }
    }

    pub(super) fn forget(&self, drawable: u64) {
        self.keyboard.iter().for_each(|keyboard| keyboard.forget(drawable));
    }
}

impl State {
    /// Does what was asked for since the last frame, after one of `drawable` was shown.
    pub(super) fn live(&mut self, drawable: &Drawable) {
        self.listen(drawable.shared.id);
        let actions = self.live.keyboard.as_ref().map(Keyboard::take_actions).unwrap_or_default();
        for (drawable, action) in actions {
            self.act(drawable, action);
        }
        if let Some(said) = self.live.shots.said() {
            self.say(drawable.shared.id, said);
        }
        if self.live.asked_at.elapsed() >= LOOK {
            self.live.asked_at = Instant::now();
            if let Some(new) = self.live.source.as_mut().and_then(|source| source.changed()) {
                self.adopt(new);
            }
        }
    }

    /// How pictures are made now.
    pub(super) fn manner(&self) -> Manner {
        Manner { mode: self.mode, view: self.options.pathtrace.paint, preset: self.options.quality.preset }
    }

    /// Says something in a drawable's window.
    pub(super) fn say(&mut self, drawable: u64, text: String) {
        if let Some(window) = self.windows.get_mut(&drawable) {
            window.say(text);
        }
    }

    /// Tells the selected drawable of a share group how worlds are traced, if that has changed since it was told.
    pub(super) fn tell(&mut self, group: u64, drawable: u64) {
        let (Some(window), Some(renderer)) =
            (self.windows.get_mut(&drawable), self.renderers.get_mut(&group))
        else {
            return;
        };
        if std::mem::replace(&mut window.version, self.live.version) != self.live.version
            && let Err(error) = renderer.set_mode(self.mode, &self.options.traced())
        {
            report(&error);
        }
    }

    /// Listens to keys, if they mean anything.
    fn listen(&mut self, drawable: u64) {
        let Some(keys) = self.options.keys.as_ref().filter(|keys| !Keys::is_empty(keys)) else {
            self.live.keyboard = None;
            return;
        };
        let Some(window) = self.windows.get(&drawable) else { return };
        if self.live.keyboard.is_none() {
            self.live.keyboard = Keyboard::new(keys.clone());
            if self.live.keyboard.is_none() {
                self.options.keys = None;
            }
        }
        if let Some(keyboard) = &self.live.keyboard {
            keyboard.note_shown(drawable, window.surface());
        }
    }

    /// Does what a key is for that was pressed in a drawable's window.
    fn act(&mut self, drawable: u64, action: Action) {
        let text = match action {
            Action::Mode => {
                let mode = next_mode(self.mode);
                self.set_mode(mode);
                mode_name(mode).to_owned()
            }
            Action::View => {
                let paint = &mut self.options.pathtrace.paint;
                *paint = Paint::ALL[(*paint as usize + 1) % Paint::ALL.len()];
                self.live.version += 1;
                let unseen = if self.mode == Mode::Raster { " (not in raster)" } else { "" };
                format!("view: {}{unseen}", self.options.pathtrace.paint.name())
            }
            Action::Preset => {
                let preset = self.options.quality.preset.map_or(Preset::High, Preset::next);
                self.options.quality.preset = Some(preset);
                self.live.version += 1;
                format!("preset: {}", preset.name())
            }
            Action::Hud => {
                self.options.hud = !self.options.hud;
                format!("figures: {}", if self.options.hud { "on" } else { "off" })
            }
            Action::Screenshot => match self.shoot(drawable) {
                Some(said) => said,
                // It is said when it is written.
                None => return,
            },
        };
        tracing::info!("{text}");
        self.say(drawable, text);
    }

    /// Frames become something else from now on, however long that takes.
    fn set_mode(&mut self, mode: Mode) {
        self.options.mode = Some(mode);
        self.mode = mode;
        self.live.version += 1;
    }

    /// Has what a drawable shows written. What becomes of it, if that is known.
    fn shoot(&mut self, drawable: u64) -> Option<String> {
        let Some(folder) = self.options.screenshots.clone() else {
            return Some("no screenshot: there is no folder for them".into());
        };
        let window = self.windows.get(&drawable)?;
        let (frame, group) = (window.pictures(), window.group?);
        let renderer = self.renderer(group, drawable)?;
        let size = renderer.size();
        match renderer.read_color() {
            Ok(rgba) => self.live.shots.write(&folder, Picture { size, rgba, frame }),
            Err(error) => Some(format!("no screenshot: {error}")),
        }
    }

    /// Takes over what has changed of the options.
    fn adopt(&mut self, new: EngineOptions) {
        let former = std::mem::replace(&mut self.live.said, new);
        let new = &self.live.said;
        for name in former.fixed_changes(new) {
            if !self.live.told.contains(&name) {
                self.live.told.push(name);
                tracing::warn!("{name}: another value holds when the program is started again");
            }
        }
        let before = (self.options.mode, self.options.backend, self.options.traced());
        self.options.take_over(&former, new);
        if let (Some(keyboard), Some(keys)) = (&self.live.keyboard, &self.options.keys) {
            keyboard.set_keys(keys.clone());
        }
        if before.0 != self.options.mode {
            self.mode = self.options.mode.unwrap_or(Mode::Pathtrace);
        }
        if before.1 != self.options.backend {
            self.choose_backend();
        }
        if before != (self.options.mode, self.options.backend, self.options.traced()) {
            tracing::info!("options have changed: {}", mode_name(self.mode));
            self.live.version += 1;
        }
    }

    /// Goes on with another backend, or looks again which is the faster one.
    fn choose_backend(&mut self) {
        let Some(gpu) = &self.gpu else { return };
        self.contest = if self.options.backend.is_none() { Contest::on(gpu) } else { None };
        self.options.pathtrace.backend = first_backend(gpu, self.options.backend);
    }
}

fn next_mode(mode: Mode) -> Mode {
    match mode {
        Mode::Raster => Mode::Pathtrace,
        Mode::Pathtrace => Mode::Reference,
        Mode::Reference => Mode::Raster,
    }
}

/// What the next frame does not show will be asked for again, or the renderer fails, and is replaced.
fn report(error: &RenderError) {
    if !error.is_device_lost() {
        tracing::error!("options could not be changed: {error}");
    }
}
