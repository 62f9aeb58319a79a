//! The objects of a world: where each was last, and what its motion says of it.

use glam::{DMat4, Vec3};
use hashbrown::{HashMap, HashSet};

use crate::content::Content;

/// Objects from which on those that were unseen longest are forgotten, unless more are in sight.
const MOST: usize = 1 << 16;
/// Frames that an object which moved once counts as one that moves.
const MOVED: u32 = 240;
/// Frames that an object with a matrix of its own must stand still to be part of the world.
const SETTLED: u32 = 4;
/// Frames of the same evidence that a verdict on motion takes.
const EVIDENCE: u32 = 2;

/// What an object's motion says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// Nothing yet.
    Unknown,
    /// It stands still.
    Still,
    /// It moves, or has moved.
    Moves,
    /// It turns with the world and keeps its place about the eye.
    Carried,
    /// It keeps its place on screen.
    Attached,
}

/// What an object did in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// It stood still.
    Stood,
    /// It moved in some way.
    Moved,
    /// It moved as the eye did.
    Carried,
    /// It moved and turned as the eye did.
    Attached,
}

/// An object.
#[derive(Debug, Clone)]
pub struct Object {
    /// Its name, the same in all frames and all runs.
    pub id: u64,
    /// What its name was made of.
    seed: u64,
    /// Content, middle and extent of its mesh.
    content: u64,
    centre: Vec3,
    extent: f32,
    /// Object to world space when it was seen last; where it stands still, when it was seen first. Nothing before that.
    pub model: Option<DMat4>,
    /// Object to world space in the frame before that, if it was there.
    pub before: Option<DMat4>,
    /// Object to eye space when it was seen last.
    pub eye: DMat4,
    /// The frame in which it was seen last, 0 for none.
    pub seen: u32,
    /// Its vertices move.
    pub is_animated: bool,
    /// Frames in a row of the same step, and that step.
    steps: (Step, u32),
    /// The frame in which it was seen to move last.
    moved: Option<u32>,
    /// It has stood still for long enough, and not moved since.
    stands: bool,
    carried: bool,
    attached: bool,
}

/// Gives objects in a table their new numbers; what is left without any goes.
fn renumber<K>(table: &mut HashMap<K, Vec<u32>>, numbers: &[Option<u32>]) {
    table.retain(|_, objects| {
        let left = objects.iter().filter_map(|object| *numbers.get(*object as usize)?);
        *objects = left.collect();
        !objects.is_empty()
    });
}

/// The cube of the world, as large as a mesh, that its middle is in.
fn cube(centre: Vec3, extent: f32, model: DMat4) -> [i32; 3] {
    let place = model.transform_point3(centre.as_dvec3()) / f64::from(extent.max(1e-6));
    // Numbers that are too large end at the largest.
    place.floor().as_ivec3().to_array()
}

impl Object {
    fn cube(&self, model: DMat4) -> [i32; 3] {
        cube(self.centre, self.extent, model)
    }

    /// Takes note of what it did. Standing says less while the camera rests, one step more if it `has_jumped`.
    pub fn step(&mut self, step: Step, camera_moves: bool, has_jumped: bool, frame: u32) {
        let count = if self.steps.0 == step { self.steps.1.saturating_add(1) } else { 1 };
        self.steps = (step, count);
        match step {
            Step::Stood => {
                self.stands |= count >= SETTLED;
                if camera_moves && count > EVIDENCE {
                    (self.carried, self.attached) = (false, false);
                }
            }
            Step::Moved if has_jumped => {
                (self.moved, self.stands) = (Some(frame), false);
            }
            _ if count < EVIDENCE => {}
            Step::Moved => {
                (self.carried, self.attached) = (false, false);
                self.moved = Some(frame);
            }
            Step::Carried => self.carried = true,
            Step::Attached => self.attached = true,
        }
        // One frame is no evidence.
        self.stands &= step == Step::Stood || count < EVIDENCE;
    }

    /// What its motion says so far.
    pub fn motion(&self, frame: u32) -> Motion {
        let moves = self.moved.is_some_and(|moved| frame.wrapping_sub(moved) < MOVED);
        if self.carried {
            Motion::Carried
        } else if self.attached {
            Motion::Attached
        } else if moves {
            Motion::Moves
        } else if self.stands {
            Motion::Still
        } else {
            Motion::Unknown
        }
    }

    /// Whether it has stood still long enough to tell where the camera is.
    pub fn is_trusted(&self) -> bool {
        matches!(self.steps, (Step::Stood, count) if count >= SETTLED)
    }
}

/// All objects that are known.
#[derive(Debug, Default)]
pub struct Objects {
    objects: Vec<Object>,
    by_content: HashMap<(u64, u32), Vec<u32>>,
    /// Where objects are of which there are many: content, and a cube of the world of about their size.
    places: HashMap<(u64, [i32; 3]), Vec<u32>>,
    /// How many objects have begun with the same content and texture: part of their names.
    named: HashMap<u64, u64>,
    /// How many were left when some were forgotten last.
    kept: usize,
}

impl Objects {
    /// Whether there are so many that some must be forgotten.
    pub fn is_full(&self) -> bool {
        self.objects.len() > MOST.max(2 * self.kept)
    }

    /// Forgets what was unseen longest, half of what may be known, but nothing that was in sight in `frame` or the one
    /// before. Returns the new number of each object that is left.
    pub fn forget_unseen(&mut self, frame: u32) -> Vec<Option<u32>> {
        let is_in_sight = |object: &&Object| object.seen != 0 && frame.wrapping_sub(object.seen) < 2;
        let in_sight = self.objects.iter().filter(is_in_sight).count();
        self.kept = in_sight.max(MOST / 2).min(self.objects.len());
        let mut order: Vec<usize> = (0..self.objects.len()).collect();
        // Of those that were never followed, the last ones are the youngest.
        order.sort_unstable_by_key(|&number| std::cmp::Reverse((self.objects[number].seen, number)));
        let mut numbers = vec![None; self.objects.len()];
        order[..self.kept].sort_unstable();
        for (new, old) in (0..).zip(&order[..self.kept]) {
            numbers[*old] = Some(new);
        }
        let is_left = numbers.clone();
        let mut is_left = is_left.iter().map(Option::is_some);
        self.objects.retain(|_| is_left.next().unwrap_or(false));
        renumber(&mut self.by_content, &numbers);
        renumber(&mut self.places, &numbers);
        let seeds: HashSet<u64> = self.objects.iter().map(|object| object.seed).collect();
        self.named.retain(|seed, _| seeds.contains(seed));
        numbers
    }

    /// A new object of this content; its number.
    pub fn add(&mut self, content: &Content, texture: u64) -> u32 {
        let seed = content.positions ^ texture.rotate_left(17) ^ u64::from(content.triangles);
        let before = self.named.entry(seed).or_default();
        *before += 1;
        let name = xxhash_rust::xxh3::xxh3_64(bytemuck::bytes_of(&[seed, *before]));
        let number = self.objects.len() as u32;
        self.objects.push(Object {
            id: name.max(1),
            seed,
            content: content.positions,
            centre: content.centre,
            extent: content.extent,
            model: None,
            before: None,
            eye: DMat4::IDENTITY,
            seen: 0,
            is_animated: false,
            steps: (Step::Stood, 0),
            moved: None,
            stands: false,
            carried: false,
            attached: false,
        });
        self.by_content.entry((content.positions, content.triangles)).or_default().push(number);
        number
    }

    /// How many there are: their numbers are below.
    pub fn len(&self) -> usize {
        self.objects.len()
    }

    /// The objects that were first seen with this content.
    pub fn of_content(&self, content: &Content) -> &[u32] {
        self.by_content.get(&(content.positions, content.triangles)).map_or(&[], |objects| objects)
    }

    /// An object.
    pub fn get(&self, number: u32) -> Option<&Object> {
        self.objects.get(number as usize)
    }

    /// An object, to be changed.
    pub fn get_mut(&mut self, number: u32) -> Option<&mut Object> {
        self.objects.get_mut(number as usize)
    }

    /// Puts an object at a place.
    pub fn put(&mut self, number: u32, model: DMat4) {
        let Some(object) = self.objects.get_mut(number as usize) else { return };
        let content = object.content;
        let former = object.model.replace(model).map(|model| object.cube(model));
        let now = object.cube(model);
        if former == Some(now) {
            return;
        }
        if let Some(others) = former.and_then(|cube| self.places.get_mut(&(content, cube))) {
            others.retain(|other| *other != number);
        }
        self.places.entry((content, now)).or_default().push(number);
    }

    /// Objects with the same content as one that would be at `model`, that are near.
    pub fn near(&self, content: &Content, model: DMat4) -> impl Iterator<Item = u32> {
        let [x, y, z] = cube(content.centre, content.extent, model);
        let around = (0..27).map(move |i: i32| {
            [x.wrapping_add(i % 3 - 1), y.wrapping_add(i / 3 % 3 - 1), z.wrapping_add(i / 9 - 1)]
        });
        around.flat_map(|cube| self.places.get(&(content.positions, cube)).into_iter().flatten().copied())
    }

    /// Says whether the vertices of an object move.
    pub fn set_animated(&mut self, number: u32, is_animated: bool) {
        if let Some(object) = self.objects.get_mut(number as usize) {
            object.is_animated = is_animated;
        }
    }

    /// All objects.
    pub fn all(&self) -> impl Iterator<Item = &Object> {
        self.objects.iter()
    }

    /// Gives the world other coordinates: every place goes through a transform. What motion was seen by the guess before
    /// is no evidence.
    pub fn transform(&mut self, by: DMat4, snap: impl Fn(DMat4) -> DMat4) {
        self.places.clear();
        for number in 0..self.objects.len() as u32 {
            let object = &mut self.objects[number as usize];
            object.before = object.before.map(|before| snap(by * before));
            object.moved = None;
            if let Some(model) = object.model.take() {
                self.put(number, snap(by * model));
            }
        }
    }

    /// Forgets where all objects are: the world is another. Names stay.
    pub fn forget_places(&mut self) {
        self.places.clear();
        for object in &mut self.objects {
            (object.model, object.before, object.seen) = (None, None, 0);
            (object.steps, object.moved) = ((Step::Stood, 0), None);
            (object.stands, object.carried, object.attached) = (false, false, false);
        }
    }
}
