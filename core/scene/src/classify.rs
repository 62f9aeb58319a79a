//! The class of each draw of a frame, by its state and by what the world of the frame is.

use afterglow_gl::frame::{Frame, StencilOp, Topology};
use glam::{DMat3, DMat4, DVec3};

use crate::draws::{DepthUse, DrawFacts, TransformFacts};
use crate::geometry::{ContentCache, Surfaces};
use crate::matrix;
use crate::opacity::Mixing;
use crate::types::{Class, Verdict};
use crate::world::{Stage, World};

/// Class and reason.
type Finding = (Class, &'static str);

/// Classifies the draws of one frame in order.
pub struct Classifier<'a> {
    frame: &'a Frame,
    transforms: &'a [TransformFacts],
    world: &'a World,
    world_from_eye: DMat4,
    cache: &'a mut ContentCache,
    surfaces: Surfaces,
}

impl<'a> Classifier<'a> {
    /// A classifier that has seen nothing yet.
    pub fn new(
        frame: &'a Frame,
        transforms: &'a [TransformFacts],
        world: &'a World,
        cache: &'a mut ContentCache,
    ) -> Classifier<'a> {
        let world_from_eye = matrix::rigid_inverse(world.view_rigid);
        Classifier { frame, transforms, world, world_from_eye, cache, surfaces: Surfaces::default() }
    }

    /// The verdict on the next draw.
    pub fn verdict(&mut self, facts: &DrawFacts) -> Verdict {
        let (class, reason) = self.find(facts);
        let model = match class.is_traced() {
            true => self.model(facts),
            false => DMat4::IDENTITY,
        };
        if class.is_traced() {
            let positions = self.cache.positions(self.frame, facts.draw);
            self.surfaces.add(facts.draw, positions, self.transform(facts).modelview_hash);
        }
        Verdict {
            operation: facts.operation,
            class,
            reason,
            model: model.as_mat4(),
            baked: class.is_traced() && self.is_baked(facts),
            triangles: facts.triangles,
        }
    }

    fn transform(&self, facts: &DrawFacts) -> &'a TransformFacts {
        &self.transforms[facts.transform]
    }

    /// Object to world space; the identity, exactly, when but for rounding it is.
    fn model(&self, facts: &DrawFacts) -> DMat4 {
        let model = self.world_from_eye * self.transform(facts).modelview;
        if self.is_view(facts) && matrix::similarity(model).is_some_and(|s| s.scale == 1.0) {
            DMat4::IDENTITY
        } else {
            model
        }
    }

    /// Whether a draw's MODELVIEW is the world's.
    fn is_view(&self, facts: &DrawFacts) -> bool {
        let modelview = self.transform(facts).modelview;
        let reach = self.world.modelview.col(3).truncate().length().max(1.0);
        let linear = DMat3::from_mat4(modelview);
        linear.abs_diff_eq(DMat3::from_mat4(self.world.modelview), 1e-6)
            && modelview.col(3).abs_diff_eq(self.world.modelview.col(3), 1e-6 * reach)
    }

    fn find(&mut self, facts: &DrawFacts) -> Finding {
        self.other_view(facts)
            .or_else(|| self.without_color(facts))
            .or_else(|| self.not_in_perspective(facts))
            .or_else(|| self.points_and_lines(facts))
            .or_else(|| self.flattened(facts))
            .or_else(|| self.mirrored(facts))
            .or_else(|| self.behind_all(facts))
            .or_else(|| self.without_depth_test(facts))
            .or_else(|| self.drawn_again(facts))
            .or_else(|| self.blended(facts))
            .unwrap_or_else(|| self.solid(facts))
    }

    fn is_early(&self, facts: &DrawFacts) -> bool {
        facts.operation < self.world.first
    }

    fn is_late(&self, facts: &DrawFacts) -> bool {
        facts.operation > self.world.last
    }

    fn other_view(&self, facts: &DrawFacts) -> Option<Finding> {
        if facts.place.view == self.world.view {
            return None;
        }
        let perspective = self.transform(facts).perspective.is_some();
        Some(match perspective && facts.depth != DepthUse::Off {
            true => (Class::OtherView, "another viewport"),
            false if self.is_early(facts) => (Class::OtherView, "another viewport, flat"),
            false => (Class::Interface, "another viewport, flat"),
        })
    }

    fn without_color(&self, facts: &DrawFacts) -> Option<Finding> {
        if facts.writes_color {
            return None;
        }
        let raster = &self.frame.fixed[facts.draw.fixed as usize].raster;
        let counts = |op| {
            use StencilOp as S;
            matches!(
                op,
                S::Increment | S::Decrement | S::IncrementWrap | S::DecrementWrap | S::Invert
            )
        };
        let is_volume = raster.stencil.is_some_and(|s| counts(s.depth_fail) || counts(s.pass))
            && matches!(facts.depth, DepthUse::Test)
            && !self.is_early(facts);
        Some(match is_volume {
            true => (Class::Dropped, "shadow volume"),
            false => (Class::Undecided, "writes no colour"),
        })
    }

    fn not_in_perspective(&self, facts: &DrawFacts) -> Option<Finding> {
        if self.transform(facts).perspective.is_some() {
            return None;
        }
        Some(match self.is_early(facts) {
            true => (Class::Sky, "orthographic, before the world"),
            false => (Class::Interface, "orthographic"),
        })
    }

    fn points_and_lines(&self, facts: &DrawFacts) -> Option<Finding> {
        if facts.draw.topology == Topology::Triangles {
            return None;
        }
        Some(match facts.depth {
            _ if self.is_early(facts) && !self.writes_depth(facts) => {
                (Class::Sky, "points or lines before the world")
            }
            DepthUse::Off if self.is_late(facts) => (Class::Interface, "points or lines after the world"),
            _ => (Class::Translucent, "points or lines"),
        })
    }

    fn writes_depth(&self, facts: &DrawFacts) -> bool {
        matches!(facts.depth, DepthUse::TestWrite | DepthUse::Fill)
    }

    fn flattened(&self, facts: &DrawFacts) -> Option<Finding> {
        let flat = self.transform(facts).flattening && facts.mixing != Mixing::Opaque;
        flat.then_some((Class::Dropped, "planar shadow"))
    }

    /// The world again under a reflection: seen where a plane or the stencil lets it be.
    fn mirrored(&self, facts: &DrawFacts) -> Option<Finding> {
        let determinant = |m: DMat4| DMat3::from_mat4(m).determinant();
        let fixed = &self.frame.fixed[facts.draw.fixed as usize];
        let is_masked = fixed.words.global.clip_planes() != 0 || fixed.raster.stencil.is_some();
        let modelview = self.transform(facts).modelview;
        let is_mirrored = determinant(modelview) * determinant(self.world.modelview) < 0.0;
        (is_masked && is_mirrored).then_some((Class::OtherView, "mirrored"))
    }

    fn behind_all(&self, facts: &DrawFacts) -> Option<Finding> {
        let [near, far] = facts.depth_range;
        if near >= 0.9 && far >= 0.9 && self.world.stage != Stage::of(facts, self.transforms) {
            return Some((Class::Sky, "far depth range"));
        }
        if self.is_early(facts) && !self.writes_depth(facts) {
            return Some((Class::Sky, "before the world, writes no depth"));
        }
        let layer = facts.place.layer;
        if layer < self.world.stage.layer() {
            return Some((Class::Sky, "depth cleared between it and the world"));
        }
        (!self.writes_depth(facts) && facts.mixing == Mixing::Opaque && self.is_carried_along(facts))
            .then_some((Class::Sky, "surrounds the eye, moves with it"))
    }

    /// Whether a draw turns with the world but keeps its place about the eye.
    fn is_carried_along(&self, facts: &DrawFacts) -> bool {
        let modelview = self.transform(facts).modelview;
        let turned = |m: DMat4| DMat3::from_mat4(matrix::orthonormal(m));
        if !turned(modelview).abs_diff_eq(turned(self.world.modelview), 1e-4) {
            return false;
        }
        let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for sample in facts.eye_samples(self.frame, self.transforms, 64) {
            least = least.min(sample);
            most = most.max(sample);
        }
        let extent = (most - least).length();
        let at_eye = modelview.col(3).truncate().length() < 1e-3 * extent;
        let world_moves = self.world.modelview.col(3).truncate().length() > 1e-3 * extent;
        at_eye && world_moves
    }

    fn without_depth_test(&self, facts: &DrawFacts) -> Option<Finding> {
        match facts.depth {
            DepthUse::Off if self.is_late(facts) => {
                Some((Class::Interface, "no depth test, after the world"))
            }
            DepthUse::Off => Some((Class::Translucent, "no depth test, amid the world")),
            DepthUse::Fill => Some((Class::Undecided, "fills depth")),
            _ => None,
        }
    }

    fn drawn_again(&mut self, facts: &DrawFacts) -> Option<Finding> {
        let is_plain = facts.mixing == Mixing::Opaque;
        if facts.depth == DepthUse::TestWrite || (is_plain && facts.depth != DepthUse::Equal) {
            return None;
        }
        let transform = self.transform(facts).modelview_hash;
        let positions = self.cache.positions(self.frame, facts.draw);
        let again = self.surfaces.has_draw(positions, transform)
            || ((facts.mixing == Mixing::Multiply || facts.depth == DepthUse::Equal)
                && self.surfaces.has_triangles(self.frame, facts.draw, transform));
        again.then_some(match facts.mixing {
            Mixing::Multiply => (Class::Layer, "multiplies a surface drawn before"),
            Mixing::Add => (Class::Layer, "adds to a surface drawn before"),
            _ => (Class::Layer, "blends over a surface drawn before"),
        })
    }

    fn blended(&self, facts: &DrawFacts) -> Option<Finding> {
        let is_biased = self.frame.fixed[facts.draw.fixed as usize].raster.depth_bias.is_some();
        Some(match facts.mixing {
            Mixing::Opaque | Mixing::CutOut if facts.depth == DepthUse::TestWrite => return None,
            _ if facts.depth == DepthUse::Equal => (Class::Undecided, "equal depth"),
            Mixing::Opaque => (Class::Undecided, "opaque, writes no depth"),
            Mixing::Multiply if is_biased => (Class::Translucent, "stain on a surface"),
            _ if is_biased => (Class::Translucent, "decal on a surface"),
            Mixing::Multiply => (Class::Translucent, "multiplies what is behind"),
            Mixing::Add => (Class::Translucent, "adds to what is behind"),
            Mixing::CutOut | Mixing::Blend => (Class::Translucent, "blended"),
        })
    }

    fn solid(&self, facts: &DrawFacts) -> Finding {
        let stage = Stage::of(facts, self.transforms);
        if stage == self.world.stage {
            return self.in_world(facts);
        }
        if self.is_near(facts) {
            return (Class::ViewModel, "near, with its own projection or depth");
        }
        match stage.shares_projection(&self.world.stage) && stage.layer() == self.world.stage.layer() {
            true => self.in_world(facts),
            false if self.is_early(facts) => (Class::Sky, "another projection, before the world"),
            false => (Class::Undecided, "another projection"),
        }
    }

    fn in_world(&self, facts: &DrawFacts) -> Finding {
        let cut_out = facts.mixing == Mixing::CutOut;
        match self.is_view(facts) {
            true if cut_out => (Class::Static, "drawn under the view, cut out"),
            true => (Class::Static, "drawn under the view"),
            false if cut_out => (Class::Movable, "has its own matrix, cut out"),
            false => (Class::Movable, "has its own matrix"),
        }
    }

    /// Whether all of a draw is close to the eye, as the world goes.
    fn is_near(&self, facts: &DrawFacts) -> bool {
        let reach = 0.2 * self.world.extent;
        let eye = self.transform(facts).perspective.map_or(DMat4::IDENTITY, |p| p.view);
        facts
            .eye_samples(self.frame, self.transforms, 16)
            .all(|p| eye.transform_point3(p).length() < reach)
    }

    /// Whether a draw's colours are light that the program computed beforehand.
    fn is_baked(&self, facts: &DrawFacts) -> bool {
        let words = &self.frame.fixed[facts.draw.fixed as usize].words;
        if words.global.lighting() != 0 {
            return false;
        }
        let units = words.units.iter().filter(|unit| unit.target() != 0 && unit.gen_s() == 0).count();
        units >= 2 || facts.colors.varying
    }
}
