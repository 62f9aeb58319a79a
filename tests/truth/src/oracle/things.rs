//! Things of a program followed from frame to frame, with all frames at hand: which draws are the same thing, and whether
//! it ever moves or changes its shape.

use std::collections::HashMap;

use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec3};

use crate::truth::UNNAMED;

/// A thing as it was drawn once.
#[derive(Debug, Clone, Copy)]
pub struct Sight {
    /// In which frame.
    pub frame: usize,
    /// By which draw of it.
    pub draw: usize,
    /// What only sights of like things share.
    pub kind: u64,
    /// Hash of its shape.
    pub content: u64,
    /// Three points of it, world space.
    points: [DVec3; 3],
}

impl Sight {
    /// The sight of a thing whose bounds in object space are these, under a model matrix.
    pub fn new(at: [usize; 2], [kind, content]: [u64; 2], model: DMat4, [least, most]: [Vec3; 2]) -> Sight {
        let points = [least, most, Vec3::new(least.x, most.y, (least.z + most.z) / 2.0)];
        let points = points.map(|point| model.transform_point3(point.as_dvec3()));
        Sight { frame: at[0], draw: at[1], kind, content, points }
    }

    fn distance(&self, other: &Sight) -> f64 {
        let pairs = self.points.iter().zip(&other.points);
        pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
    }
}

/// How far things move, in the program's units.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    /// Less is rounding.
    pub least: f64,
    /// From frame to frame, at most.
    pub most: f64,
}

/// What was found of a thing.
#[derive(Debug, Clone)]
struct Thing {
    object: u64,
    first: Sight,
    last: Sight,
    /// How often it was seen.
    sights: usize,
    /// Frame in which it was first seen elsewhere or turned, or from which on that could be known.
    moved: Option<usize>,
    /// The same of another shape.
    changed: Option<usize>,
    /// Whether it was once mistaken, perhaps, for another thing of its kind nearby.
    is_ambiguous: bool,
}

/// Things by their sights.
#[derive(Debug, Default)]
pub struct Things {
    things: Vec<Thing>,
    /// By frame and draw, the index of the thing.
    of: HashMap<[usize; 2], usize>,
}

/// Sights from which on a thing that rests is taken to stand.
const SETTLED: usize = 8;

/// Frames for which a thing that was lost from sight may turn up elsewhere.
const MEMORY: usize = 10;

impl Things {
    /// Follows things. `sights` are in the order of frames; objects are numbered from `first`.
    pub fn follow(sights: &[Sight], motion: Motion, first: u64) -> Things {
        let mut things = Things::default();
        let mut by_kind: HashMap<u64, Vec<usize>> = HashMap::new();
        for frame in sights.chunk_by(|a, b| a.frame == b.frame) {
            let mut sorted: Vec<&Sight> = frame.iter().collect();
            sorted.sort_by_key(|sight| (sight.kind, sight.draw));
            for alike in sorted.chunk_by(|a, b| a.kind == b.kind) {
                things.assign(alike, by_kind.entry(alike[0].kind).or_default(), motion, first);
            }
        }
        things
    }

    /// Finds the things that sights of one kind in one frame are of: those that are nearest to each other first.
    fn assign(&mut self, sights: &[&Sight], known: &mut Vec<usize>, motion: Motion, first: u64) {
        let mut pairs = Vec::new();
        for (s, sight) in sights.iter().enumerate() {
            for &thing in known.iter() {
                let last = &self.things[thing].last;
                let distance = sight.distance(last);
                let rests = distance <= motion.least;
                let frames = sight.frame - last.frame;
                if rests || (frames <= MEMORY && distance <= motion.most * frames.min(2) as f64) {
                    pairs.push((distance, s, thing));
                }
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut taken = vec![None; sights.len()];
        for &(distance, s, thing) in &pairs {
            if taken[s].is_none() && !taken.contains(&Some(thing)) {
                taken[s] = Some(thing);
                // Where two things may be the one that a sight is of, either may have been taken.
                let is_rival = |&(other, s_2, thing_2): &(f64, usize, usize)| {
                    (s == s_2) != (thing == thing_2) && other < 3.0 * distance
                };
                let moves = distance > motion.least;
                self.things[thing].is_ambiguous |= moves && pairs.iter().any(is_rival);
            }
        }
        for (sight, taken) in sights.iter().zip(taken) {
            let thing = taken.unwrap_or_else(|| {
                let object = first + self.things.len() as u64;
                let (first, last) = (**sight, **sight);
                let (moved, changed) = (None, None);
                let thing = Thing { object, first, last, sights: 0, moved, changed, is_ambiguous: false };
                self.things.push(thing);
                known.push(self.things.len() - 1);
                self.things.len() - 1
            });
            self.see(thing, sight, motion);
            self.of.insert([sight.frame, sight.draw], thing);
        }
    }

    fn see(&mut self, thing: usize, sight: &Sight, motion: Motion) {
        let thing = &mut self.things[thing];
        // What begins at once is known from the beginning.
        let since = if thing.sights < SETTLED { thing.first.frame } else { sight.frame };
        if sight.content != thing.first.content {
            thing.changed.get_or_insert(since);
        } else if sight.distance(&thing.first) > motion.least {
            thing.moved.get_or_insert(since);
        }
        thing.sights += 1;
        thing.last = *sight;
    }

    /// Class and object of what a draw shows. Before a thing that rested moves or changes for the first time, nothing tells
    /// that it will, and what rests but was seen for a few frames only may be anything: then it is undecided.
    pub fn class(&self, frame: usize, draw: usize) -> Option<(Class, u64)> {
        let thing = &self.things[*self.of.get(&[frame, draw])?];
        let class = match (thing.changed, thing.moved) {
            (Some(since), _) if frame >= since => Class::Dynamic,
            (None, Some(since)) if frame >= since => Class::Movable,
            (None, None) if thing.sights >= SETTLED => Class::Static,
            _ => Class::Undecided,
        };
        let is_nameless = thing.is_ambiguous && class != Class::Static;
        Some((class, if is_nameless { UNNAMED + thing.object } else { thing.object }))
    }
}

/// Numbers what is told apart by its content alone.
#[derive(Debug)]
pub struct Numbers {
    known: HashMap<u64, u64>,
    first: u64,
}

impl Numbers {
    /// Numbers from `first` on.
    pub fn from(first: u64) -> Numbers {
        Numbers { known: HashMap::new(), first }
    }

    /// The number of what has that content.
    pub fn of(&mut self, content: u64) -> u64 {
        let next = self.first + self.known.len() as u64;
        *self.known.entry(content).or_insert(next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MOTION: Motion = Motion { least: 0.01, most: 2.0 };

    /// Frames by the places and shapes of things of one kind.
    fn follow(frames: &[&[(f64, u64)]]) -> Things {
        let mut sights = Vec::new();
        for (frame, places) in frames.iter().enumerate() {
            for (draw, (x, content)) in places.iter().enumerate() {
                let model = DMat4::from_translation(DVec3::X * *x);
                sights.push(Sight::new([frame, draw], [1, *content], model, [Vec3::NEG_ONE, Vec3::ONE]));
            }
        }
        Things::follow(&sights, MOTION, 1)
    }

    #[test]
    fn things_keep_their_numbers_in_any_order() {
        let things = follow(&[&[(0.0, 5), (50.0, 5)], &[(50.5, 5), (0.0, 5)], &[(51.0, 5)]]);
        let object = |frame, draw| things.class(frame, draw).map(|(_, object)| object);
        assert_eq!(object(0, 1), object(1, 0));
        assert_eq!(object(0, 1), object(2, 0));
        assert_eq!(object(0, 0), object(1, 1));
        assert_ne!(object(0, 0), object(0, 1));
        assert_eq!(things.class(1, 2), None);
    }

    #[test]
    fn what_rests_stands_and_what_moves_later_is_undecided_before() {
        let mut frames: Vec<Vec<(f64, u64)>> = vec![vec![(0.0, 5), (50.0, 5), (90.0, 5)]; 20];
        for (frame, places) in frames.iter_mut().enumerate() {
            places[1].0 += 0.3 * frame as f64;
            places[2].0 += if frame < 12 { 0.0 } else { 1.0 };
        }
        let frames: Vec<&[(f64, u64)]> = frames.iter().map(Vec::as_slice).collect();
        let things = follow(&frames);
        let class = |frame, draw| things.class(frame, draw).map(|(class, _)| class);
        assert_eq!(class(3, 0), Some(Class::Static));
        assert_eq!(class(0, 1), Some(Class::Movable));
        assert_eq!((class(11, 2), class(12, 2)), (Some(Class::Undecided), Some(Class::Movable)));
    }

    #[test]
    fn shapes_that_change_are_dynamic_and_a_glimpse_is_nothing() {
        let things = follow(&[&[(0.0, 5)], &[(0.0, 6)], &[(0.0, 6), (50.0, 7)]]);
        assert_eq!(things.class(0, 0), Some((Class::Dynamic, 1)));
        assert_eq!(things.class(2, 1), Some((Class::Undecided, 2)));
    }

    #[test]
    fn things_that_may_be_exchanged_have_no_name() {
        let things = follow(&[&[(0.0, 5), (1.0, 5)], &[(0.5, 5), (1.5, 5)]]);
        assert!(things.class(1, 0).is_some_and(|(_, object)| object >= UNNAMED));
    }
}
