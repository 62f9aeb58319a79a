//! Keys that a player may press while a program plays, and when one was pressed.

use std::str::FromStr;

/// What a key does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// Goes on to the next [`Mode`](afterglow_render::Mode).
    Mode,
    /// To the next [`Paint`](afterglow_render::Paint).
    View,
    /// To the next [`Preset`](afterglow_settings::Preset).
    Preset,
    /// Writes what is shown into a file.
    Screenshot,
    /// Shows figures, or hides them.
    Hud,
}

impl Action {
    /// All of them.
    pub const ALL: [Action; 5] = [Self::Mode, Self::View, Self::Preset, Self::Screenshot, Self::Hud];

    /// As options write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mode => "mode",
            Self::View => "view",
            Self::Preset => "preset",
            Self::Screenshot => "screenshot",
            Self::Hud => "hud",
        }
    }
}

/// Which keys do what. Unless it is said: keys that games leave alone, with Ctrl and Shift.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Keys {
    /// In the order of [`Action::ALL`].
    chords: [Option<Chord>; Action::ALL.len()],
}

impl Default for Keys {
    fn default() -> Self {
        let modifiers = [true, true, false, false];
        let chord = |keysym| Some(Chord { keysym, modifiers });
        Self { chords: [HOME, PAGE_DOWN, PAGE_UP, INSERT, END].map(chord) }
    }
}

impl Keys {
    /// The keys of an action.
    pub fn chord(&self, action: Action) -> Option<Chord> {
        self.chords[action as usize]
    }

    /// Sets the keys of an action, or takes them away.
    pub fn set(&mut self, action: Action, chord: Option<Chord>) {
        self.chords[action as usize] = chord;
    }

    /// Whether no action has any.
    pub fn is_empty(&self) -> bool {
        self.chords.iter().all(Option::is_none)
    }
}

/// A key together with modifiers that must be held, and no others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Chord {
    /// X's name of the key, as without any modifier.
    keysym: u32,
    /// In the order of [`MODIFIERS`].
    modifiers: [bool; MODIFIERS.len()],
}

/// Names of modifiers, and the keysyms of their keys.
const MODIFIERS: [(&str, &[u32]); 4] = [
    ("ctrl", &[0xffe3, 0xffe4]),
    ("shift", &[0xffe1, 0xffe2]),
    // Alt and Meta are one key on most keyboards.
    ("alt", &[0xffe9, 0xffea, 0xffe7, 0xffe8]),
    ("super", &[0xffeb, 0xffec]),
];

const HOME: u32 = 0xff50;
const PAGE_UP: u32 = 0xff55;
const PAGE_DOWN: u32 = 0xff56;
const END: u32 = 0xff57;
const INSERT: u32 = 0xff63;

/// Keys that are not named by one character.
const NAMED: [(&str, u32); 20] = [
    ("home", HOME),
    ("end", END),
    ("pageup", PAGE_UP),
    ("pagedown", PAGE_DOWN),
    ("insert", INSERT),
    ("delete", 0xffff),
    ("left", 0xff51),
    ("up", 0xff52),
    ("right", 0xff53),
    ("down", 0xff54),
    ("pause", 0xff13),
    ("scrolllock", 0xff14),
    ("print", 0xff61),
    ("menu", 0xff67),
    ("tab", 0xff09),
    ("return", 0xff0d),
    ("backspace", 0xff08),
    ("escape", 0xff1b),
    ("space", 0x20),
    ("plus", 0x2b),
];

/// The keysym of F1; those of the others follow.
const F1: u32 = 0xffbe;
const MOST_F: u32 = 24;

/// A text that names no keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("keys are named like Ctrl+Shift+F9 or Alt+Home")]
pub struct UnknownKeys;

impl FromStr for Chord {
    type Err = UnknownKeys;

    /// Names parted by `+`, in any case: modifiers (Ctrl, Shift, Alt, Super) and one key at the end.
    fn from_str(text: &str) -> Result<Chord, UnknownKeys> {
        let lower = text.to_ascii_lowercase();
        let mut names: Vec<&str> = lower.split('+').map(str::trim).collect();
        let key = names.pop().and_then(keysym).ok_or(UnknownKeys)?;
        let mut modifiers = [false; MODIFIERS.len()];
        for name in names {
            let index = MODIFIERS.iter().position(|(known, _)| *known == name).ok_or(UnknownKeys)?;
            modifiers[index] = true;
        }
        Ok(Chord { keysym: key, modifiers })
    }
}

/// The keysym of a key's name in lower case.
fn keysym(name: &str) -> Option<u32> {
    if let Some((_, keysym)) = NAMED.iter().find(|(known, _)| *known == name) {
        return Some(*keysym);
    }
    if let Some(number) = name.strip_prefix('f').and_then(|number| number.parse::<u32>().ok()) {
        return (1..=MOST_F).contains(&number).then(|| F1 + number - 1);
    }
    match name.as_bytes() {
        // Latin letters, digits and signs are their own keysyms.
        [sign @ 0x21..=0x7e] => Some(u32::from(*sign)),
        _ => None,
    }
}

/// Which keys of a keyboard are down: a bit a keycode, as QueryKeymap answers.
pub(crate) type Pressed = [u8; 32];

/// Keysyms by keycode.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Keymap {
    /// With the keycode.
    keysyms: Vec<(u8, u32)>,
}

/// Keysyms of a keycode that count: two levels of two groups. More are those of keys together with others.
const LEVELS: usize = 4;

impl Keymap {
    /// From GetKeyboardMapping's answer: as many keysyms for each keycode, from the first one on.
    pub(crate) fn new(first_keycode: u8, keysyms_per_keycode: u8, keysyms: &[u32]) -> Self {
        let width = usize::from(keysyms_per_keycode).max(1);
        let of_code = |(code, row): (u8, &[u32])| {
            row.iter().take(LEVELS).map(|keysym| (code, *keysym)).collect::<Vec<_>>()
        };
        Self { keysyms: (first_keycode..=u8::MAX).zip(keysyms.chunks(width)).flat_map(of_code).collect() }
    }

    /// Whether the keyboard has a key.
    pub(crate) fn has(&self, chord: Chord) -> bool {
        self.keysyms.iter().any(|(_, keysym)| *keysym == chord.keysym)
    }

    fn is_down(&self, pressed: &Pressed, keysym: u32) -> bool {
        let is_pressed = |code: u8| pressed[usize::from(code / 8)] & (1 << (code % 8)) != 0;
        self.keysyms.iter().any(|(code, known)| *known == keysym && is_pressed(*code))
    }
}

/// Which keys were down at the last look.
#[derive(Debug, Clone, Default)]
pub(crate) struct KeyStates {
    /// In the order of [`Action::ALL`]: the key alone, whatever its modifiers.
    down: [bool; Action::ALL.len()],
}

impl KeyStates {
    /// Takes note of what is down now. The actions whose keys went down since the last look, while just their
    /// modifiers were: a key that is held acts once, and so does not when modifiers come to it, nor when its program
    /// gets the focus meanwhile.
    pub(crate) fn note(&mut self, keys: &Keys, keymap: &Keymap, pressed: &Pressed) -> Vec<Action> {
        let held = MODIFIERS.map(|(_, keysyms)| keysyms.iter().any(|key| keymap.is_down(pressed, *key)));
        let acts = |action: &Action| {
            let Some(chord) = keys.chord(*action) else { return false };
            let is_down = keymap.is_down(pressed, chord.keysym);
            let was_down = std::mem::replace(&mut self.down[*action as usize], is_down);
            is_down && !was_down && chord.modifiers == held
        };
        Action::ALL.into_iter().filter(acts).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CTRL: u8 = 37;
    const SHIFT: u8 = 50;
    const ALT: u8 = 64;
    const KEY: u8 = 110;

    fn keymap() -> Keymap {
        let mut keysyms = vec![0; (256 - 8) * 2];
        for (code, keysym) in [(CTRL, 0xffe3), (SHIFT, 0xffe1), (ALT, 0xffe9), (KEY, HOME)] {
            keysyms[usize::from(code - 8) * 2] = keysym;
        }
        Keymap::new(8, 2, &keysyms)
    }

    fn pressed(codes: &[u8]) -> Pressed {
        let mut pressed = Pressed::default();
        codes.iter().for_each(|code| pressed[usize::from(code / 8)] |= 1 << (code % 8));
        pressed
    }

    /// How many times looks at which these keys are down find that the mode's keys were pressed.
    fn presses(looks: &[&[u8]]) -> usize {
        let (keys, keymap, mut states) = (Keys::default(), keymap(), KeyStates::default());
        let actions: Vec<_> =
            looks.iter().flat_map(|codes| states.note(&keys, &keymap, &pressed(codes))).collect();
        assert!(actions.iter().all(|action| *action == Action::Mode));
        actions.len()
    }

    #[test]
    fn keys_are_named() {
        let modifiers = [true, true, false, false];
        assert_eq!("Ctrl+Shift+Home".parse(), Ok(Chord { keysym: HOME, modifiers }));
        assert_eq!(" shift + CTRL + home".parse(), Ok(Chord { keysym: HOME, modifiers }));
        assert_eq!("F12".parse(), Ok(Chord { keysym: 0xffc9, modifiers: [false; 4] }));
        assert_eq!("Alt+M".parse(), Ok(Chord { keysym: 0x6d, modifiers: [false, false, true, false] }));
        assert_eq!("super+plus".parse(), Ok(Chord { keysym: 0x2b, modifiers: [false, false, false, true] }));
        for wrong in
            ["", "+", "Ctrl", "Ctrl+", "F0", "F25", "Hyper+a", "Home+Ctrl", "F-1", "é", "F99999999999"]
        {
            assert_eq!(wrong.parse::<Chord>(), Err(UnknownKeys), "{wrong}");
        }
    }

    #[test]
    fn a_key_that_goes_down_with_its_modifiers_acts_once() {
        assert_eq!(
            presses(&[&[], &[CTRL], &[CTRL, SHIFT], &[CTRL, SHIFT, KEY], &[CTRL, SHIFT, KEY], &[]]),
            1
        );
        // All within one look, and twice.
        assert_eq!(presses(&[&[CTRL, SHIFT, KEY], &[CTRL, SHIFT], &[CTRL, SHIFT, KEY]]), 2);
    }

    #[test]
    fn other_modifiers_or_modifiers_that_come_later_do_not_act() {
        assert_eq!(presses(&[&[CTRL, KEY], &[KEY], &[]]), 0);
        assert_eq!(presses(&[&[CTRL, SHIFT, ALT, KEY]]), 0);
        assert_eq!(presses(&[&[KEY], &[CTRL, SHIFT, KEY]]), 0);
    }

    #[test]
    fn a_keyboard_without_keys_never_acts() {
        let empty = Keymap::new(8, 0, &[]);
        let keys = Keys::default();
        assert!(KeyStates::default().note(&keys, &empty, &[0xff; 32]).is_empty());
        assert!(
            !empty.has(keys.chord(Action::Mode).unwrap()) && keymap().has(keys.chord(Action::Mode).unwrap())
        );
        // More keysyms than there are keycodes.
        assert_eq!(Keymap::new(250, 1, &[HOME; 100]).keysyms.len(), 6);
    }

    #[test]
    fn actions_can_be_without_keys() {
        let mut keys = Keys::default();
        assert!(!keys.is_empty());
        Action::ALL.into_iter().for_each(|action| keys.set(action, None));
        assert!(keys.is_empty());
        let acted = KeyStates::default().note(&keys, &keymap(), &pressed(&[CTRL, SHIFT, KEY]));
        assert!(acted.is_empty());
    }
}
