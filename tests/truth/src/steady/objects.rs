//! Whether objects stay what they are.

use std::collections::{BTreeMap, HashMap, HashSet};

use afterglow_scene::{Class, Verdict};
use glam::DVec3;

use super::motion::Seen;

/// Frames that an object may be out of sight and must be the same when it is back.
const AWAY: u32 = 240;
/// Frames within which a class that comes back has flipped.
const FLIP: u32 = 240;
/// Places that are known of one content.
const MOST_PLACES: usize = 64;

/// What was drawn with some content at a place.
#[derive(Debug, Clone)]
struct Spot {
    place: DVec3,
    object: u64,
    frame: u32,
}

/// An object that became another.
#[derive(Debug, Clone, Copy)]
pub struct Switch {
    pub frame: u32,
    pub from: u64,
    pub to: u64,
    /// The frame in which it was seen before.
    pub seen: u32,
    pub class: Class,
    pub reason: &'static str,
}

/// Surfaces with the same content at the same place that are other objects than before.
#[derive(Debug, Default)]
pub struct Switches {
    spots: HashMap<u64, Vec<Spot>>,
    epoch: u64,
    /// How often a surface was seen again.
    pub chances: u64,
    pub found: Vec<Switch>,
}

impl Switches {
    /// Takes note of a frame.
    pub fn add(&mut self, frame: u32, epoch: u64, seen: &[Seen]) {
        if self.epoch != epoch {
            (self.epoch, self.spots) = (epoch, HashMap::new());
        }
        let drawn: HashSet<u64> = seen.iter().map(|seen| seen.object).collect();
        for seen in seen.iter().filter(|seen| seen.object != 0 && seen.class.is_traced()) {
            let spots = self.spots.entry(seen.key).or_default();
            let is_near = |spot: &&mut Spot| spot.place.distance(seen.place) <= 0.02 * seen.extent;
            let has_room = spots.len() < MOST_PLACES;
            match spots.iter_mut().filter(is_near).max_by_key(|spot| (spot.object == seen.object, spot.frame))
            {
                Some(spot) => {
                    // Two alike at one place are told apart by nobody.
                    let is_switch = spot.object != seen.object && !drawn.contains(&spot.object);
                    self.chances += u64::from(spot.frame != frame);
                    // What moves may come to where one of its kind has been.
                    let away = if seen.class == Class::Static { AWAY } else { 1 };
                    if is_switch && spot.frame != frame && frame - spot.frame <= away {
                        self.found.push(Switch {
                            frame,
                            from: spot.object,
                            to: seen.object,
                            seen: spot.frame,
                            class: seen.class,
                            reason: seen.reason,
                        });
                    }
                    *spot = Spot { place: seen.place, object: seen.object, frame };
                }
                None if has_room => {
                    spots.push(Spot { place: seen.place, object: seen.object, frame });
                }
                None => {}
            }
        }
    }
}

/// Class and reason.
type Finding = (Class, &'static str);

/// What an object was taken for.
#[derive(Debug)]
struct History {
    now: Finding,
    before: Option<(Finding, u32)>,
    changes: u32,
}

/// How often something happened, and the frames of the first times.
pub type Times = (u32, Vec<u32>);

/// The classes of all objects over time.
#[derive(Debug, Default)]
pub struct Histories {
    objects: HashMap<u64, History>,
    /// Changes of class, by what to what.
    pub changes: BTreeMap<String, Times>,
    /// Of these, changes back to what the object had been not long ago.
    pub flips: BTreeMap<String, Times>,
    /// Objects that changed most: changes and identity.
    pub most: Vec<(u32, u64)>,
}

impl Histories {
    /// Takes note of a frame.
    pub fn add(&mut self, frame: u32, verdicts: &[Verdict]) {
        let mut done = HashSet::new();
        let things = verdicts.iter().filter(|v| v.object != 0 && v.class != Class::Layer);
        for verdict in things {
            if !done.insert(verdict.object) {
                continue;
            }
            let now = (verdict.class, verdict.reason);
            let history =
                self.objects.entry(verdict.object).or_insert(History { now, before: None, changes: 0 });
            if history.now.0 == now.0 {
                history.now = now;
                continue;
            }
            let named =
                format!("{} ({}) -> {} ({})", history.now.0.name(), history.now.1, now.0.name(), now.1);
            let is_back = history.before.is_some_and(|(f, at)| f.0 == now.0 && frame - at <= FLIP);
            let note = |times: &mut BTreeMap<String, Times>| {
                let entry = times.entry(named.clone()).or_default();
                entry.0 += 1;
                if entry.1.len() < 6 {
                    entry.1.push(frame);
                }
            };
            note(&mut self.changes);
            if is_back {
                note(&mut self.flips);
            }
            *history = History { now, before: Some((history.now, frame)), changes: history.changes + 1 };
        }
    }

    /// Objects, and those that changed most.
    pub fn finish(&mut self) -> usize {
        self.most = self.objects.iter().map(|(id, history)| (history.changes, *id)).collect();
        self.most.sort_unstable_by(|a, b| b.cmp(a));
        self.most.truncate(5);
        self.objects.len()
    }
}
