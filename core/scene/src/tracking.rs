//! Objects followed from frame to frame, and the camera with them.
//!
//! One rigid transform of the world is free: it is chosen with the first frame, and every object's place is relative to
//! it. An object that stands still keeps the place at which it was seen first, so nothing drifts.

use glam::{DMat3, DMat4, Vec3};

use crate::consensus::{self, Prior, TOLERANCE, Witness};
use crate::draws::{DrawFacts, TransformFacts};
use crate::foresight::Foresight;
use crate::formers::SPRITE;
use crate::matrix;
use crate::objects::{Motion, Object, Objects, Step};
use crate::pairing::{NEAR, Pairing, Sight};
use crate::shapes::{Known, Piece};
use crate::world::World;

/// Frames in which the matrix that most is drawn under must have been the view to be taken for it.
const BASE_TRUSTED: u32 = 3;
/// Frames for which a world is so young that it may get other coordinates.
const YOUNG: u32 = 12;
/// How much more than what is known what is new must reach for the world to be another.
const ANOTHER: f64 = 4.0;
/// Pixels within which something stands still where matrices are exact, and how many times the usual error that may be.
const STILL: f64 = 0.1;
const NOISE: f64 = 10.0;
/// Objects from which on it can be said how a program sends its world.
const PLACED: u32 = 16;
/// What is known of a draw that was followed.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// The object's name.
    pub object: u64,
    /// Object to world space.
    pub model: DMat4,
    /// The same in the frame before, if it was there.
    pub previous: Option<DMat4>,
    /// What its motion says.
    pub motion: Motion,
    /// It has a matrix of its own, which does not turn it, as most of the standing world has.
    pub is_placed: bool,
    /// Its vertices move; where its corners were.
    pub animated: Option<Vec<Vec3>>,
}

/// A draw that is followed.
pub struct Claim<'a> {
    /// Its number among the draws.
    pub draw: usize,
    /// What it draws.
    pub piece: &'a Piece,
    /// Object to eye space.
    pub eye: DMat4,
    /// It may tell where the camera is.
    pub is_witness: bool,
    /// The number of its object, once that is known.
    pub object: Option<u32>,
}

/// Follows objects and the camera.
#[derive(Debug, Default)]
pub struct Tracker {
    /// All objects.
    pub objects: Objects,
    view: Option<DMat4>,
    /// The camera's step of the frame before, in eye space.
    velocity: DMat4,
    /// Frames in which what most is drawn under was the view, and in which it was not.
    base: (u32, u32),
    /// From what most is drawn under to the view, where that has been something else, and for how many frames.
    offset: Option<(DMat4, u32)>,
    /// Objects of this frame and of the one before that have a matrix of their own which does not turn them: those that
    /// stand still, and those that do not. Sprites are counted apart, second.
    placed: [(u32, u32); 2],
    placed_before: [(u32, u32); 2],
    frame: u32,
    /// Counts worlds.
    pub epoch: u64,
    /// From the coordinates before to those of now, since the last one who took it, where only those have changed.
    pub change: Option<DMat4>,
}

impl Tracker {
    /// Follows the draws of a frame, `pieces` of which are known: finds the world's view, and what each object does.
    pub fn follow(
        &mut self,
        draws: &[DrawFacts],
        pieces: &[Option<Piece>],
        transforms: &[TransformFacts],
        world: &mut World,
    ) -> Vec<Option<Track>> {
        self.frame = self.frame.wrapping_add(1).max(1);
        let mut claims: Vec<Claim> = claims(draws, pieces, transforms, world);
        let expected = self.view.map_or(world.base, |view| self.velocity * view);
        let pairing =
            Pairing { objects: &self.objects, frame: self.frame, sight: Sight::new(expected, world, true) };
        pairing.pair(&mut claims);
        let before = self.view;
        let view = self.find_view(&claims, world);
        let pairing =
            Pairing { objects: &self.objects, frame: self.frame, sight: Sight::new(view, world, false) };
        pairing.pair(&mut claims);
        for claim in &mut claims {
            let piece = claim.piece;
            claim.object.get_or_insert_with(|| self.objects.add(&piece.content, piece.texture));
        }
        self.velocity = before.map_or(DMat4::IDENTITY, |before| view * matrix::rigid_inverse(before));
        self.view = Some(view);
        world.view = view;
        let still = self.stillness(&claims, view, world.focal);
        let step = CameraStep::new(before.unwrap_or(view), view, world.focal, still);
        self.placed_before = std::mem::take(&mut self.placed);
        let mut tracks: Vec<Option<Track>> = Vec::new();
        tracks.resize_with(draws.len(), || None);
        for claim in &claims {
            tracks[claim.draw] = self.step(claim, &step);
        }
        tracks
    }

    /// What can be foreseen of a frame that has these matrices.
    pub fn foresight<'a>(&self, transforms: &'a [TransformFacts]) -> Foresight<'a> {
        let view = self.view.map(|view| self.velocity * view);
        Foresight { transforms, before: self.view, view, is_sharp: false, frame: self.frame }
    }

    /// World to eye space in the last frame that was followed.
    pub fn view(&self) -> Option<DMat4> {
        self.view
    }

    /// Whether a piece is known to stand still in the world, wherever it is drawn.
    pub fn stands_still(&self, piece: &Piece) -> bool {
        let stands = |object: &u32| {
            let object = self.objects.get(*object);
            object.is_some_and(|object| object.model.is_some() && object.motion(self.frame) == Motion::Still)
        };
        match &piece.known {
            Known::Object(object) => stands(object),
            Known::Mesh => self.objects.of_content(&piece.content).iter().any(stands),
            Known::Animated(..) => false,
        }
    }

    /// The view of this frame.
    fn find_view(&mut self, claims: &[Claim], world: &World) -> DMat4 {
        let Some(before) = self.view else { return world.base };
        let base_is_view = self.base.0 >= BASE_TRUSTED && self.base.0 > 4 * self.base.1;
        let witnesses = self.witnesses(claims, base_is_view);
        let prior = Prior { view: before, base: base_is_view.then_some(world.base), focal: world.focal };
        let found = consensus::find(&witnesses, &prior);
        if self.is_another_world(claims, found) {
            self.begin_world();
            return found.filter(|_| base_is_view).unwrap_or(world.base);
        }
        let view = found.unwrap_or(before);
        let agrees = consensus::agrees(&world.samples, view, world.base, world.focal, TOLERANCE);
        if agrees {
            self.base.0 += 1;
            return view;
        }
        self.base.1 += 1;
        let under_base =
            claims.iter().filter(|claim| claim.is_witness && claim.eye == world.base_eye).count();
        let witnesses = claims.iter().filter(|claim| claim.is_witness).count();
        if 2 * under_base > witnesses { self.settle(view, world) } else { view }
    }

    /// In a world's first frames: where what most is drawn under is the view but for one transform, the world was begun
    /// with another guess, and gets the program's own coordinates now. Returns the view in the world's coordinates.
    fn settle(&mut self, view: DMat4, world: &World) -> DMat4 {
        let offset = matrix::rigid_inverse(view) * world.base;
        let (known, times) = self.offset.unwrap_or((offset, 0));
        let (place, known_place) = (offset.w_axis.truncate(), known.w_axis.truncate());
        let is_same = consensus::turned_alike(offset, known)
            && place.distance(known_place) <= 1e-4 * place.length().max(1.0);
        self.offset = Some(if is_same { (offset, times + 1) } else { (offset, 0) });
        let is_young = self.base.0 + self.base.1 <= YOUNG;
        if !is_young || !is_same || times + 1 < BASE_TRUSTED {
            return view;
        }
        let change = matrix::rigid_inverse(offset);
        self.objects.transform(change, snapped);
        self.change = Some(change);
        (self.base, self.offset, self.velocity) = ((BASE_TRUSTED, 0), None, DMat4::IDENTITY);
        self.epoch += 1;
        world.base
    }

    /// Pixels within which what stands still is where it should be, by how exactly that is so in this frame: a program may
    /// reckon in large numbers.
    fn stillness(&self, claims: &[Claim], view: DMat4, focal: f64) -> f64 {
        let witnesses = self.witnesses(claims, false);
        let trusted = witnesses.iter().filter(|witness| witness.is_trusted);
        let mut errors: Vec<f64> = trusted.map(|witness| witness.error(view, focal)).collect();
        if errors.is_empty() {
            return TOLERANCE;
        }
        let middle = errors.len() / 2;
        let (_, median, _) = errors.select_nth_unstable_by(middle, f64::total_cmp);
        (NOISE * *median).clamp(STILL, TOLERANCE)
    }

    fn witnesses<'a>(&'a self, claims: &'a [Claim<'a>], base_is_view: bool) -> Vec<Witness<'a>> {
        let witness = |claim: &'a Claim<'a>| {
            let object = claim.object.and_then(|object| self.objects.get(object));
            // Where the world has been sent in world coordinates, new things are as well.
            let known = object.and_then(|object| object.model.as_ref());
            let model = known.or(base_is_view.then_some(&DMat4::IDENTITY))?;
            Some(Witness {
                samples: &claim.piece.content.samples,
                eye: &claim.eye,
                model,
                mesh: claim.piece.content.positions,
                is_trusted: object.is_some_and(Object::is_trusted),
            })
        };
        let told = claims.iter().filter(|claim| claim.is_witness && !is_animated(claim));
        told.filter_map(witness).collect()
    }

    /// Whether nothing that is known of the world is in sight, and much that is new.
    fn is_another_world(&self, claims: &[Claim], found: Option<DMat4>) -> bool {
        let (mut known, mut new, mut trusted) = (0.0, 0.0, false);
        for claim in claims.iter().filter(|claim| claim.is_witness && !is_animated(claim)) {
            let extent = f64::from(claim.piece.content.extent) * scale_of(claim.eye);
            let object = claim.object.and_then(|object| self.objects.get(object));
            match object.filter(|object| object.model.is_some()) {
                Some(object) => {
                    known += extent;
                    trusted |= object.is_trusted();
                }
                None => new += extent,
            }
        }
        !trusted && new > ANOTHER * known && (found.is_none() || known == 0.0 || self.has_trusted())
    }

    fn has_trusted(&self) -> bool {
        self.objects.all().any(Object::is_trusted)
    }

    /// Forgets objects that were unseen longest. Returns the new number of each that is left.
    pub fn forget_unseen(&mut self) -> Vec<Option<u32>> {
        self.objects.forget_unseen(self.frame)
    }

    fn begin_world(&mut self) {
        self.objects.forget_places();
        (self.base, self.offset) = ((0, 0), None);
        self.epoch += 1;
    }

    /// Takes note of what an object did.
    fn step(&mut self, claim: &Claim, camera: &CameraStep) -> Option<Track> {
        let frame = self.frame;
        let number = claim.object?;
        let object = self.objects.get_mut(number)?;
        let now = snapped(camera.world_from_eye * claim.eye);
        let former = object.model.filter(|_| object.seen != 0);
        let was_there = object.seen == frame.wrapping_sub(1);
        let again = object.seen == frame;
        if let (Some(model), false) = (former, again) {
            let step = camera.step_of(&claim.piece.content.samples, claim.eye, model, object.eye, was_there);
            let far = f64::from(claim.piece.content.extent) * scale_of(now);
            let centre = claim.piece.content.centre.as_dvec3();
            let went = model.transform_point3(centre).distance(now.transform_point3(centre));
            object.step(step, camera.moves, was_there && went > NEAR * far, frame);
            if step != Step::Stood {
                self.objects.put(number, now);
            }
        } else if former.is_none() {
            self.objects.put(number, now);
        }
        let object = self.objects.get_mut(number)?;
        let model = object.model?;
        if !again {
            object.before = former.filter(|_| was_there);
        }
        (object.eye, object.seen) = (claim.eye, frame);
        let animated = match &claim.piece.known {
            Known::Animated(_, corners) => Some(corners.clone()),
            _ => None,
        };
        let (previous, motion) = (object.before, object.motion(frame));
        let is_turned = !DMat3::from_mat4(model).abs_diff_eq(DMat3::IDENTITY, 1e-5);
        // How sparks fly says nothing of how the world is sent.
        let is_sprite = usize::from(claim.piece.content.triangles <= SPRITE);
        match motion {
            _ if is_turned || again => {}
            Motion::Still => self.placed[is_sprite].0 += 1,
            Motion::Unknown => {}
            _ => self.placed[is_sprite].1 += 1,
        }
        let (still, moving) = self.placed_before[is_sprite];
        let is_placed = !is_turned && still >= PLACED && still >= PLACED * moving / 2;
        Some(Track { object: object.id, model, previous, motion, is_placed, animated })
    }
}

fn is_animated(claim: &Claim) -> bool {
    matches!(claim.piece.known, Known::Animated(..))
}

/// The draws that may be objects of the world.
fn claims<'a>(
    draws: &[DrawFacts],
    pieces: &'a [Option<Piece>],
    transforms: &[TransformFacts],
    world: &World,
) -> Vec<Claim<'a>> {
    let claim = |(draw, (facts, piece)): (usize, (&DrawFacts, &'a Option<Piece>))| {
        let piece = piece.as_ref().filter(|_| world.may_hold(facts, transforms))?;
        let eye = transforms[facts.transform].eye;
        Some(Claim { draw, piece, eye, is_witness: world.is_on_stage(facts, transforms), object: None })
    };
    draws.iter().zip(pieces).enumerate().filter_map(claim).collect()
}

/// About how much a matrix scales.
pub fn scale_of(matrix: DMat4) -> f64 {
    matrix.x_axis.truncate().length()
}

/// The identity, exactly, for what is the identity but for rounding.
pub fn snapped(model: DMat4) -> DMat4 {
    let reach = model.w_axis.truncate().length();
    if reach < 1e-4 && model.abs_diff_eq(DMat4::IDENTITY, 2e-6) { DMat4::IDENTITY } else { model }
}

/// The camera's step from the frame before.
struct CameraStep {
    before: DMat4,
    world_from_eye: DMat4,
    view: DMat4,
    /// How far the eye went, in world space.
    went: DMat4,
    focal: f64,
    /// Pixels within which something stands still.
    still: f64,
    moves: bool,
}

impl CameraStep {
    fn new(before: DMat4, view: DMat4, focal: f64, still: f64) -> CameraStep {
        let world_from_eye = matrix::rigid_inverse(view);
        let went = world_from_eye.w_axis.truncate() - matrix::rigid_inverse(before).w_axis.truncate();
        let moves = !consensus::turned_alike(before, view) || went.length() > 1e-7;
        CameraStep { before, world_from_eye, view, went: DMat4::from_translation(went), focal, still, moves }
    }

    /// What an object did that is now at `eye`, and was at `model` in the world and at `former` as seen from the eye.
    fn step_of(&self, samples: &[Vec3], eye: DMat4, model: DMat4, former: DMat4, was_there: bool) -> Step {
        let is_at = |expected: DMat4| consensus::agrees(samples, expected, eye, self.focal, TOLERANCE);
        if consensus::agrees(samples, self.view * model, eye, self.focal, self.still) {
            Step::Stood
        } else if was_there && is_at(former) {
            Step::Attached
        } else if was_there
            && is_at(self.view * self.went * model)
            && !is_at(self.view * matrix::rigid_inverse(self.before) * former)
        {
            Step::Carried
        } else {
            Step::Moved
        }
    }
}
