//! Which part of a frame is the world, and the camera that it was drawn with.

use afterglow_gl::frame::{Draw, Frame, Rect};
use glam::{DMat3, DMat4, DVec3, Vec3};
use hashbrown::HashMap;

use crate::content::spread_of;
use crate::draws::{DrawFacts, TransformFacts};
use crate::geometry::sample_positions;
use crate::matrix::{self, Perspective};
use crate::views::{Views, share_of_drawable};

/// Least share of the drawable that the world's viewport covers.
const LEAST_SHARE: f64 = 0.1;

/// How much more another viewport must show than the one before to be the world's.
const KEPT: f64 = 4.0;

/// The world of a frame.
#[derive(Debug, Clone)]
pub struct World {
    /// Index of its view among the frame's.
    pub place: usize,
    /// What its draws have in common.
    pub stage: Stage,
    /// The projection, and what the program put in front of it.
    pub perspective: Perspective,
    /// The view if it is what most was drawn under: a first guess, rigid.
    pub base: DMat4,
    /// The matrix that it was, with what scale it has.
    pub base_eye: DMat4,
    /// World to eye space, once it is known.
    pub view: DMat4,
    /// How many pixels a unit at distance one takes.
    pub focal: f64,
    /// Positions of what was drawn under that matrix, object space.
    pub samples: Vec<Vec3>,
    /// First operation that draws a surface of it.
    pub first: u32,
    /// Last operation that draws a surface of it.
    pub last: u32,
    /// Diagonal of the box around what was drawn.
    pub extent: f64,
    /// Mean of what was drawn, in eye space.
    pub centre: DVec3,
}

/// Draws that share projection, depth range and depth layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Stage {
    projection: u64,
    depth_range: [u32; 2],
    layer: u32,
}

impl Stage {
    /// The stage of a draw.
    pub fn of(facts: &DrawFacts, transforms: &[TransformFacts]) -> Stage {
        Stage {
            projection: transforms[facts.transform].projection_hash,
            depth_range: facts.depth_range.map(f32::to_bits),
            layer: facts.place.layer,
        }
    }

    /// Depth clears within the view before it.
    pub fn layer(&self) -> u32 {
        self.layer
    }

    /// Whether both have the same PROJECTION matrix.
    pub fn shares_projection(&self, other: &Stage) -> bool {
        self.projection == other.projection
    }
}

impl World {
    /// Finds the world of a frame; `None` when nothing solid is drawn in perspective.
    pub fn find(
        frame: &Frame,
        views: &Views,
        draws: &[DrawFacts],
        transforms: &[TransformFacts],
        before: Option<Rect>,
    ) -> Option<World> {
        let solid = || draws.iter().filter(|d| d.is_solid(transforms));
        let view = choose_view(frame, views, solid(), before)?;
        // What a clip plane or the stencil cuts may be the world seen in a mirror.
        let triangles = |masked: bool| -> u64 {
            let counted = solid().filter(|d| d.place.view == view && d.masked == masked);
            counted.map(|d| u64::from(d.triangles)).sum()
        };
        let skip_masked = 4 * triangles(false) >= triangles(true);
        let in_view = || solid().filter(|d| d.place.view == view && !(skip_masked && d.masked));

        let reaches: Vec<Reach> = in_view().map(|facts| Reach::of(frame, facts, transforms)).collect();
        let mut stages: HashMap<Stage, Group> = HashMap::new();
        for (facts, reach) in in_view().zip(&reaches) {
            stages.entry(Stage::of(facts, transforms)).or_default().add(facts, reach);
        }
        let (stage, whole) = heaviest(&stages, Group::weight)?;

        let mut matrices: HashMap<u64, Group> = HashMap::new();
        let on_stage = in_view().zip(&reaches).filter(|(d, _)| Stage::of(d, transforms) == *stage);
        for (facts, reach) in on_stage {
            let hash = transforms[facts.transform].modelview_hash;
            matrices.entry(hash).or_default().add(facts, reach);
        }
        let (_, chosen) = heaviest(&matrices, |g| g.view_weight(whole, transforms))?;
        let facts = &transforms[chosen.transform];
        let base = matrix::similarity(facts.eye).map_or_else(|| matrix::orthonormal(facts.eye), |s| s.rigid);
        let perspective = facts.perspective?;
        let height = f64::from(views.views[view].rect.height);
        Some(World {
            place: view,
            stage: *stage,
            perspective,
            base,
            base_eye: facts.eye,
            view: base,
            focal: (perspective.projection.y_axis.y.abs() * height / 2.0).clamp(1.0, 1e6),
            samples: sample_positions(frame, &chosen.draw?, 8).collect(),
            first: whole.first,
            last: whole.last,
            extent: whole.extent(),
            centre: whole.mean(),
        })
    }

    /// Eye to world space.
    pub fn world_from_eye(&self) -> DMat4 {
        matrix::rigid_inverse(self.view)
    }

    /// The space after MODELVIEW to world space.
    pub fn world_from_modelview(&self) -> DMat4 {
        self.world_from_eye() * self.perspective.view
    }

    /// Whether a draw may be of an object of the world.
    pub fn may_hold(&self, facts: &DrawFacts, transforms: &[TransformFacts]) -> bool {
        facts.place.view == self.place && facts.is_solid(transforms) && !self.mirrors(facts, transforms)
    }

    /// Whether a draw is on the world's own stage.
    pub fn is_on_stage(&self, facts: &DrawFacts, transforms: &[TransformFacts]) -> bool {
        Stage::of(facts, transforms) == self.stage
    }

    /// Whether a draw shows the world in a mirror: reflected, where a plane or the stencil lets it be.
    pub fn mirrors(&self, facts: &DrawFacts, transforms: &[TransformFacts]) -> bool {
        let determinant = |m: DMat4| DMat3::from_mat4(m).determinant();
        facts.masked && determinant(transforms[facts.transform].eye) * determinant(self.base) < 0.0
    }
}

/// The view with the largest viewport and most solid triangles.
fn choose_view<'a>(
    frame: &Frame,
    views: &Views,
    solid: impl Iterator<Item = &'a DrawFacts<'a>>,
    before: Option<Rect>,
) -> Option<usize> {
    let mut triangles = vec![0u64; views.views.len()];
    for facts in solid {
        triangles[facts.place.view] += u64::from(facts.triangles);
    }
    let weight = |view: usize| {
        let share = share_of_drawable(views.views[view].rect, frame.size);
        let counts = share >= LEAST_SHARE && !views.views[view].erased;
        // Of two that are alike, the one stays that was the world before.
        let kept = if before == Some(views.views[view].rect) { KEPT } else { 1.0 };
        if counts { triangles[view] as f64 * share * share * kept } else { 0.0 }
    };
    (0..triangles.len())
        .filter(|&view| weight(view) > 0.0)
        .max_by(|&a, &b| weight(a).total_cmp(&weight(b)).then(b.cmp(&a)))
}

/// The entry of greatest weight; of equals, the one that was drawn first.
fn heaviest<K>(groups: &HashMap<K, Group>, weight: impl Fn(&Group) -> f64) -> Option<(&K, &Group)> {
    groups.iter().max_by(|(_, a), (_, b)| weight(a).total_cmp(&weight(b)).then(b.first.cmp(&a.first)))
}

/// How far draws reach in eye space, by samples of their positions.
#[derive(Debug, Clone)]
struct Reach {
    least: DVec3,
    most: DVec3,
    sum: DVec3,
    samples: f64,
}

impl Default for Reach {
    fn default() -> Reach {
        Reach { least: DVec3::INFINITY, most: DVec3::NEG_INFINITY, sum: DVec3::ZERO, samples: 0.0 }
    }
}

impl Reach {
    /// That of a draw.
    fn of(frame: &Frame, facts: &DrawFacts, transforms: &[TransformFacts]) -> Reach {
        let mut reach = Reach::default();
        match facts.piece {
            Some(piece) => {
                let eye = transforms[facts.transform].eye;
                let spread = piece.content.spread(frame, facts.draw);
                spread.iter().for_each(|at| reach.add_point(eye.project_point3(at.as_dvec3())));
            }
            None => {
                let samples = facts.eye_samples(frame, transforms, spread_of(facts.draw));
                samples.for_each(|at| reach.add_point(at));
            }
        }
        reach
    }

    fn add_point(&mut self, point: DVec3) {
        if point.is_finite() {
            self.least = self.least.min(point);
            self.most = self.most.max(point);
            self.sum += point;
            self.samples += 1.0;
        }
    }

    fn add(&mut self, other: &Reach) {
        self.least = self.least.min(other.least);
        self.most = self.most.max(other.most);
        self.sum += other.sum;
        self.samples += other.samples;
    }
}

/// Draws taken together.
#[derive(Debug, Clone)]
struct Group {
    transform: usize,
    draw: Option<Draw>,
    triangles: u64,
    first: u32,
    last: u32,
    reach: Reach,
}

impl Default for Group {
    fn default() -> Group {
        Group { transform: 0, draw: None, triangles: 0, first: u32::MAX, last: 0, reach: Reach::default() }
    }
}

impl Group {
    fn add(&mut self, facts: &DrawFacts, reach: &Reach) {
        if self.triangles == 0 {
            self.transform = facts.transform;
            self.draw = Some(*facts.draw);
        }
        self.triangles += u64::from(facts.triangles);
        self.first = self.first.min(facts.operation);
        self.last = self.last.max(facts.operation);
        self.reach.add(reach);
    }

    fn extent(&self) -> f64 {
        if self.reach.samples > 0.0 { (self.reach.most - self.reach.least).length() } else { 0.0 }
    }

    fn mean(&self) -> DVec3 {
        if self.reach.samples > 0.0 { self.reach.sum / self.reach.samples } else { DVec3::ZERO }
    }

    /// Much of the screen's triangles and much of space.
    fn weight(&self) -> f64 {
        (self.triangles as f64).sqrt() * self.extent().max(f64::MIN_POSITIVE)
    }

    /// As a candidate for the view: rigid matrices before scaled ones before all others, unless nearly
    /// everything is drawn under it.
    fn view_weight(&self, whole: &Group, transforms: &[TransformFacts]) -> f64 {
        let preference = match matrix::similarity(transforms[self.transform].eye) {
            Some(found) if found.scale == 1.0 => 1.0,
            Some(_) => 0.25,
            None => 0.05,
        };
        let majority = self.triangles * 2 > whole.triangles;
        self.weight() * preference * if majority { 2.0 } else { 1.0 }
    }
}
