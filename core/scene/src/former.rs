//! A stretch of triangles as it was drawn last, and what it may have become.

use glam::{DMat4, Vec3};

use crate::content::{Content, SAMPLES};
use crate::deform::{Change, change};
use crate::objects::{Motion, Objects};

/// How far what was known goes when it begins to change, in its own extents.
pub const AS_KNOWN: f32 = 0.25;
/// Triangles from which on a stretch has a shape by which it is known.
pub const SHAPE: u32 = 8;
/// Frames after which what was animated and rests is a thing like any other.
const RESTED: u32 = 90;
/// Times that a stretch must have moved before it counts as animated.
pub const STREAK: u32 = 2;

/// A stretch as it was drawn last.
#[derive(Debug, Clone)]
pub struct Former {
    /// Middle of the box around it, object space.
    pub centre: Vec3,
    /// Diagonal of that box.
    pub extent: f32,
    /// Vertices, as [`Content`] has them.
    pub samples: [Vec3; SAMPLES],
    /// Object to eye space.
    pub eye: DMat4,
    /// A triangle of it: as long as that is drawn, the stretch has not moved.
    pub first_key: u64,
    /// The frame in which it was drawn.
    pub frame: u32,
    /// How often it has been seen to change.
    pub streak: u32,
    /// It has become something.
    pub is_taken: bool,
    /// It was known already: it may as well be out of sight now, and what is fresh be something like it.
    pub is_known: bool,
    /// Frames for which it has been where it is, and its positions.
    pub rests: (u32, u64),
    /// How far it went in a frame, where it goes as a whole.
    pub pace: Option<Vec3>,
    /// What happened to it until now, once it is found again.
    pub change: Change,
    /// What it belongs to.
    pub object: Option<u32>,
    /// Where its corners were; nothing of what is known to stand or to move.
    pub corners: Vec<Vec3>,
}

impl Former {
    /// As it is drawn in this frame, nothing known of what it was before.
    pub fn of(content: &Content, eye: DMat4, frame: u32) -> Former {
        Former {
            centre: content.centre,
            extent: content.extent,
            samples: content.samples,
            eye,
            first_key: content.keys.first().copied().unwrap_or(0),
            frame,
            streak: 0,
            is_taken: false,
            is_known: false,
            rests: (0, content.positions),
            pace: None,
            change: Change::Rests,
            object: None,
            corners: Vec::new(),
        }
    }

    /// Whether it has been where it is for long.
    pub fn has_settled(&self, content: &Content) -> bool {
        self.rests.0 > RESTED && self.rests_at(content)
    }

    /// Whether it is where it was.
    pub fn rests_at(&self, content: &Content) -> bool {
        self.rests.1 == content.positions
    }

    /// How far it is from where it was, in its own space.
    pub fn went(&self, content: &Content) -> f32 {
        self.centre.distance(content.centre)
    }

    /// Whether it is about where it was, in its own space.
    pub fn is_near(&self, content: &Content) -> bool {
        self.went(content) <= AS_KNOWN * self.extent
    }

    /// What has happened to it if it has become this.
    pub fn change(&self, content: &Content, corners: &[Vec3]) -> Change {
        match self.corners.is_empty() {
            _ if self.rests_at(content) => Change::Rests,
            false => change(&self.corners, corners),
            true if has_deformed(&self.samples, &content.samples) => Change::Bends,
            true => Change::Goes(content.centre - self.centre),
        }
    }

    /// How often it has been seen to change, now that it has become this: twice at once if its shape has changed, for then
    /// it has not come into view as something else.
    pub fn streak(&self, content: &Content, away: u32) -> u32 {
        let is_shape = content.triangles >= SHAPE && self.is_near(content);
        match self.change {
            Change::Rests if self.has_settled(content) => 0,
            Change::Rests | Change::Scatters => self.streak,
            Change::Bends if is_shape && !self.is_known => self.streak.saturating_add(STREAK),
            Change::Goes(way) if !self.is_near(content) && !self.keeps_pace(way / away.max(1) as f32) => {
                self.streak.max(1)
            }
            _ => self.streak.saturating_add(1),
        }
    }

    /// Whether it may be elsewhere at once: not what stands still, nor what was known before it was seen to move.
    pub fn may_leave(&self, objects: &Objects, frame: u32) -> bool {
        let object = self.object.and_then(|object| objects.get(object));
        let object = object.filter(|object| object.model.is_some());
        match object.map_or(Motion::Unknown, |object| object.motion(frame)) {
            Motion::Still => false,
            Motion::Unknown => !self.corners.is_empty(),
            Motion::Moves | Motion::Carried | Motion::Attached => true,
        }
    }

    /// Whether it goes on as it went.
    fn keeps_pace(&self, pace: Vec3) -> bool {
        self.pace
            .is_some_and(|before| before.distance(pace) <= 0.5 * before.length() + AS_KNOWN * self.extent)
    }
}

/// Whether a shape has changed by more than its place.
fn has_deformed(before: &[Vec3; SAMPLES], now: &[Vec3; SAMPLES]) -> bool {
    let edges = |samples: &[Vec3; SAMPLES]| std::array::from_fn::<_, 7, _>(|i| samples[i + 1] - samples[0]);
    let size = now.iter().map(|sample| sample.distance(now[0])).fold(0.0, f32::max);
    edges(before).iter().zip(edges(now)).any(|(a, b)| a.distance(b) > 1e-3 * size)
}
