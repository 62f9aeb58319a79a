//! Looks at the keyboard while a program plays.
//!
//! Nothing is taken from the program: no key is grabbed, and its connection to the X server is left alone. A thread asks the
//! server, on a connection of its own, which keys are down, many times a second: a frame may take so long that a look
//! a frame would miss a key. Where keys went down that mean something, it asks who has the keyboard's focus, and the
//! render thread finds the action before its next frame.

use std::collections::HashMap;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use parking_lot::{Condvar, Mutex};
use x11rb::connection::Connection;
use x11rb::errors::ReplyError;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{ConnectionExt, InputFocus, Window};
use x11rb::xcb_ffi::XCBConnection;

use crate::drawable::Surface;
use crate::keys::{Action, KeyStates, Keymap, Keys};
use crate::xcb::Servers;

/// How often the keyboard is looked at.
const PERIOD: Duration = Duration::from_millis(8);
/// How often where no picture was shown for [`REST`].
const SLOW_PERIOD: Duration = Duration::from_millis(200);
const REST: Duration = Duration::from_secs(10);
/// Actions that wait, at most: a render thread that comes to none does not need more.
const MOST_WAITING: usize = 16;
/// Windows within windows that are looked through for the one with the focus, at most.
const MOST_DEPTH: usize = 32;

/// The thread, as the render thread sees it. It ends when this is dropped.
pub(crate) struct Keyboard {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

struct Shared {
    state: Mutex<State>,
    /// It is to end.
    ended: Condvar,
}

struct State {
    is_wanted: bool,
    keys: Keys,
    /// The one that was shown last comes first.
    windows: Vec<Watched>,
    last_shown: Instant,
    /// With the drawable that had the focus.
    actions: Vec<(u64, Action)>,
}

/// A window that pictures are shown in.
#[derive(Clone)]
struct Watched {
    drawable: u64,
    display: String,
    window: Window,
}

impl Keyboard {
    /// Starts looking. None where there cannot be another thread.
    pub(crate) fn new(keys: Keys) -> Option<Self> {
        let state = State {
            is_wanted: true,
            keys,
            windows: Vec::new(),
            last_shown: Instant::now(),
            actions: Vec::new(),
        };
        let shared = Arc::new(Shared { state: Mutex::new(state), ended: Condvar::new() });
        let theirs = shared.clone();
        let thread = std::thread::Builder::new().name("afterglow-keys".into()).spawn(move || watch(&theirs));
        match thread {
            Ok(thread) => Some(Self { shared, thread: Some(thread) }),
            Err(error) => {
                tracing::warn!("keys are not listened to: {error}");
                None
            }
        }
    }

    /// Other keys mean something from now on.
    pub(crate) fn set_keys(&self, keys: Keys) {
        self.shared.state.lock().keys = keys;
    }

    /// A picture was shown in a drawable's window.
    pub(crate) fn note_shown(&self, drawable: u64, surface: &Surface) {
        let Surface::X11 { display, window } = surface else { return };
        let mut state = self.shared.state.lock();
        state.last_shown = Instant::now();
        match state.windows.iter().position(|known| known.drawable == drawable) {
            Some(index) => state.windows[..=index].rotate_right(1),
            None => {
                let known = Watched { drawable, display: display.clone(), window: *window };
                state.windows.insert(0, known);
            }
        }
    }

    /// A drawable is gone.
    pub(crate) fn forget(&self, drawable: u64) {
        self.shared.state.lock().windows.retain(|known| known.drawable != drawable);
    }

    /// What was pressed since it was asked last, and in which drawable's window.
    pub(crate) fn take_actions(&self) -> Vec<(u64, Action)> {
        std::mem::take(&mut self.shared.state.lock().actions)
    }
}

impl Drop for Keyboard {
    fn drop(&mut self) {
        self.shared.state.lock().is_wanted = false;
        self.shared.ended.notify_all();
        if let Some(thread) = self.thread.take() {
            // It ends after the answer that it waits for. If it has failed, it has said so.
            let _ = thread.join();
        }
    }
}

/// What is known of a server's keyboard.
struct Watch {
    keymap: Keymap,
    states: KeyStates,
}

/// What the thread does until it is not wanted.
fn watch(shared: &Shared) {
    let (mut servers, mut watches) = (Servers::default(), HashMap::new());
    let mut state = shared.state.lock();
    while state.is_wanted {
        let (keys, windows) = (state.keys.clone(), state.windows.clone());
        let period = if state.last_shown.elapsed() < REST { PERIOD } else { SLOW_PERIOD };
        parking_lot::MutexGuard::unlocked(&mut state, || look(&mut servers, &mut watches, &keys, &windows))
            .into_iter()
            .for_each(|action| {
                if state.actions.len() < MOST_WAITING {
                    state.actions.push(action);
                }
            });
        if state.is_wanted {
            shared.ended.wait_for(&mut state, period);
        }
    }
}

/// Looks at the keyboards of all servers once.
fn look(
    servers: &mut Servers,
    watches: &mut HashMap<String, Option<Watch>>,
    keys: &Keys,
    windows: &[Watched],
) -> Vec<(u64, Action)> {
    let mut found = Vec::new();
    let mut seen: Vec<&str> = Vec::new();
    for Watched { display, .. } in windows {
        if seen.contains(&display.as_str()) {
            continue;
        }
        seen.push(display);
        let of_server = || windows.iter().filter(|known| known.display == *display);
        let watch = watches.entry(display.clone()).or_insert_with(|| begin(servers, display, keys));
        let Some(known) = watch else { continue };
        let acted = servers.connection(display).map_err(Into::into).and_then(|connection| {
            let actions = known.look(connection, keys)?;
            let focused = if actions.is_empty() { None } else { focused(connection, of_server())? };
            Ok::<_, Box<dyn std::error::Error>>((actions, focused))
        });
        match acted {
            Ok((actions, Some(drawable))) => {
                found.extend(actions.into_iter().map(|action| (drawable, action)))
            }
            Ok((_, None)) => {}
            Err(error) => {
                tracing::warn!("keys are not listened to any more: {error}");
                *watch = None;
            }
        }
    }
    found
}

/// The keyboard of a server; none if it has none.
fn begin(servers: &mut Servers, display: &str, keys: &Keys) -> Option<Watch> {
    let known = servers.connection(display).map_err(Into::into).and_then(keymap);
    let keymap = known.map_err(|error| tracing::warn!("keys are not listened to: {error}")).ok()?;
    let is_absent = |action: &Action| keys.chord(*action).is_some_and(|chord| !keymap.has(chord));
    let absent: Vec<_> = Action::ALL.into_iter().filter(is_absent).map(Action::name).collect();
    if !absent.is_empty() {
        tracing::warn!("the keyboard has no keys for: {}", absent.join(", "));
    }
    Some(Watch { keymap, states: KeyStates::default() })
}

impl Watch {
    /// The actions whose keys went down since the last look.
    fn look(
        &mut self,
        connection: &XCBConnection,
        keys: &Keys,
    ) -> Result<Vec<Action>, Box<dyn std::error::Error>> {
        let pressed = connection.query_keymap()?.reply()?.keys;
        let mut is_other = false;
        while let Some(event) = connection.poll_for_event()? {
            is_other |= matches!(event, Event::MappingNotify(_));
        }
        if is_other {
            self.keymap = keymap(connection)?;
        }
        Ok(self.states.note(keys, &self.keymap, &pressed))
    }
}

fn keymap(connection: &XCBConnection) -> Result<Keymap, Box<dyn std::error::Error>> {
    let (first, last) = (connection.setup().min_keycode, connection.setup().max_keycode);
    let count = last.saturating_sub(first).saturating_add(1);
    let answer = connection.get_keyboard_mapping(first, count)?.reply()?;
    Ok(Keymap::new(first, answer.keysyms_per_keycode, &answer.keysyms))
}

/// The drawable among these whose window keys go to now.
fn focused<'a>(
    connection: &XCBConnection,
    windows: impl Iterator<Item = &'a Watched>,
) -> Result<Option<u64>, ReplyError> {
    let focus = connection.get_input_focus()?.reply()?.focus;
    for Watched { drawable, window, .. } in windows {
        match has_keys(connection, focus, *window) {
            Ok(true) => return Ok(Some(*drawable)),
            // Programs destroy windows at any time.
            Ok(false) | Err(ReplyError::X11Error(_)) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(None)
}

/// Whether keys go to a window, or to one around it or within it, where this one has the focus.
fn has_keys(connection: &XCBConnection, focus: Window, window: Window) -> Result<bool, ReplyError> {
    if focus == u32::from(InputFocus::NONE) {
        return Ok(false);
    }
    let (around, root) = ancestors(connection, window)?;
    if focus != u32::from(InputFocus::POINTER_ROOT) && focus != root {
        let is_around = focus == window || around.contains(&focus);
        return Ok(is_around || ancestors(connection, focus)?.0.contains(&window));
    }
    // Keys go to the window under the pointer then.
    let under = connection.query_pointer(root)?.reply()?.child;
    Ok(under == around.last().copied().unwrap_or(window))
}

/// The windows around a window, without the root, and the root.
fn ancestors(connection: &XCBConnection, window: Window) -> Result<(Vec<Window>, Window), ReplyError> {
    let mut around = Vec::new();
    let mut tree = connection.query_tree(window)?.reply()?;
    while tree.parent != tree.root && tree.parent != x11rb::NONE && around.len() < MOST_DEPTH {
        around.push(tree.parent);
        tree = connection.query_tree(tree.parent)?.reply()?;
    }
    Ok((around, tree.root))
}
