//! The class of each draw of a frame, by its state and by what the world of the frame is.

use afterglow_gl::frame::{CombineFunction, EnvMode, Format, Frame, Slot, StencilOp, Topology, UnitWords};
use glam::{DMat3, DMat4, DVec3, Mat4};

use crate::draws::{DepthUse, DrawFacts, TransformFacts};
use crate::geometry::{ContentCache, mean_color};
use crate::matrix;
use crate::objects::Motion;
use crate::opacity::Mixing;
use crate::shown::Shown;
use crate::surfaces::Surfaces;
use crate::tracking::Track;
use crate::types::{Class, Verdict};
use crate::views::{Views, share_of_drawable};
use crate::world::{Stage, World};

/// Share of the drawable below which a viewport is small.
const SMALL: f64 = 0.15;

/// Share of the ground's extent below which something blended over it is a stain on it.
const STAIN: f64 = 0.01;

/// Class and reason.
type Finding = (Class, &'static str);

/// Classifies the draws of one frame in order.
struct Classifier<'a> {
    frame: &'a Frame,
    transforms: &'a [TransformFacts],
    views: &'a Views,
    world: &'a World,
    surfaces: Surfaces<'a>,
    cache: &'a mut ContentCache,
    /// Diagonal of the ground that was drawn before everything else; 0 without.
    ground: f64,
    /// Something of the world is seen in a mirror.
    has_mirrors: bool,
    /// What each view shows.
    shown: Vec<Shown>,
    /// What is known of the object that the draw at hand is of.
    track: Option<&'a Track>,
    /// Operation of the surface that the draw at hand was found to be a layer of.
    base: Option<u32>,
    /// Operations of surfaces that layers multiply.
    multiplied: Vec<u32>,
}

/// The verdicts on all draws of a frame, in order.
#[expect(clippy::too_many_arguments, reason = "what each step before found, read once")]
pub fn classify<'a>(
    frame: &'a Frame,
    transforms: &'a [TransformFacts],
    views: &'a Views,
    world: &'a World,
    draws: &'a [DrawFacts<'a>],
    tracks: &'a [Option<Track>],
    shown: Vec<Shown>,
    cache: &'a mut ContentCache,
) -> Vec<Verdict> {
    let candidates = draws
        .iter()
        .filter(|d| d.place.view == world.place && d.operation > world.first && may_be_layer(d))
        .map(|d| (d, transforms[d.transform].modelview_hash));
    let surfaces = Surfaces::awaiting(candidates);
    let mut classifier = Classifier {
        frame,
        transforms,
        views,
        world,
        surfaces,
        cache,
        ground: 0.0,
        has_mirrors: draws.iter().any(|facts| world.mirrors(facts, transforms)),
        shown,
        track: None,
        base: None,
        multiplied: Vec::new(),
    };
    let mut verdicts: Vec<Verdict> =
        draws.iter().zip(tracks).map(|(facts, track)| classifier.verdict(facts, track.as_ref())).collect();
    bake_below_lightmaps(frame, draws, &classifier.multiplied, &mut verdicts);
    verdicts
}

fn may_be_layer(facts: &DrawFacts) -> bool {
    facts.triangles > 0 && matches!(facts.depth, DepthUse::Test | DepthUse::Equal)
}

/// An unlit surface that a layer multiplies shows baked light.
fn bake_below_lightmaps(frame: &Frame, draws: &[DrawFacts], multiplied: &[u32], verdicts: &mut [Verdict]) {
    for base in multiplied {
        if let Ok(below) = draws.binary_search_by_key(base, |facts| facts.operation) {
            let words = &frame.fixed[draws[below].draw.fixed as usize].words;
            verdicts[below].baked |= !words.is_lit();
        }
    }
}

impl<'a> Classifier<'a> {
    fn verdict(&mut self, facts: &'a DrawFacts<'a>, track: Option<&'a Track>) -> Verdict {
        let modelview = self.transform(facts).modelview_hash;
        (self.track, self.base) = (track, None);
        let (class, reason) = self.find(facts);
        if class.is_traced() {
            self.surfaces.add(self.frame, facts, modelview);
        }
        Verdict {
            operation: facts.operation,
            class,
            reason,
            model: if class.is_traced() { self.model(facts).as_mat4() } else { Mat4::IDENTITY },
            object: track.map_or(0, |track| track.object),
            previous: track.and_then(|track| track.previous).map(|model| model.as_mat4()),
            baked: class.is_traced() && self.is_baked(facts),
            triangles: facts.triangles,
            base: self.base,
        }
    }

    fn transform(&self, facts: &DrawFacts) -> &'a TransformFacts {
        &self.transforms[facts.transform]
    }

    /// Object to world space; the identity, exactly, when but for rounding it is.
    fn model(&self, facts: &DrawFacts) -> DMat4 {
        match self.track {
            Some(track) => track.model,
            None => self.world.world_from_eye() * self.transform(facts).eye,
        }
    }

    /// Whether a draw's matrix is that which most of the world is drawn under.
    fn is_view(&self, facts: &DrawFacts) -> bool {
        let (eye, base) = (self.transform(facts).eye, self.world.base_eye);
        let reach = base.col(3).truncate().length().max(1.0);
        DMat3::from_mat4(eye).abs_diff_eq(DMat3::from_mat4(base), 1e-6)
            && eye.col(3).abs_diff_eq(base.col(3), 1e-6 * reach)
    }

    fn find(&mut self, facts: &DrawFacts) -> Finding {
        self.other_view(facts)
            .or_else(|| self.without_color(facts))
            .or_else(|| self.not_in_perspective(facts))
            .or_else(|| self.points_and_lines(facts))
            .or_else(|| self.unsound(facts))
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
        if facts.place.view == self.world.place {
            return None;
        }
        let perspective = self.transform(facts).perspective.is_some();
        Some(match perspective && facts.depth != DepthUse::Off {
            _ if self.views.views[facts.place.view].erased => (Class::OtherView, "erased later"),
            true if self.is_icon(facts) => (Class::Interface, "a thing of its own in a small viewport"),
            true => (Class::OtherView, "another viewport"),
            false if self.is_early(facts) => (Class::OtherView, "another viewport, flat"),
            false => (Class::Interface, "another viewport, flat"),
        })
    }

    /// Whether a draw in a small viewport over the world shows nothing of the world.
    fn is_icon(&self, facts: &DrawFacts) -> bool {
        let rect = self.views.views[facts.place.view].rect;
        let is_small = share_of_drawable(rect, self.frame.size) < SMALL;
        let of_world = self.shown.get(facts.place.view).is_some_and(Shown::is_of_world);
        is_small && self.is_late(facts) && !of_world
    }

    fn without_color(&self, facts: &DrawFacts) -> Option<Finding> {
        if facts.writes_color {
            return None;
        }
        let raster = &self.frame.fixed[facts.draw.fixed as usize].raster;
        let counts = |op| {
            use StencilOp as S;
            matches!(op, S::Increment | S::Decrement | S::IncrementWrap | S::DecrementWrap | S::Invert)
        };
        let is_volume = raster.stencil.is_some_and(|s| counts(s.depth_fail) || counts(s.pass))
            && matches!(facts.depth, DepthUse::Test)
            && !self.is_early(facts);
        let marks = raster.stencil.is_some_and(|s| s.pass == StencilOp::Replace);
        Some(match is_volume {
            true => (Class::Dropped, "shadow volume"),
            false if marks && self.has_mirrors => (Class::OtherView, "says where a mirror is"),
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

    fn unsound(&self, facts: &DrawFacts) -> Option<Finding> {
        let is_unsound = !self.transform(facts).sound;
        is_unsound.then_some((Class::Undecided, "matrix out of range"))
    }

    /// Things drawn dark and flat onto a plane.
    fn flattened(&self, facts: &DrawFacts) -> Option<Finding> {
        let words = &self.frame.fixed[facts.draw.fixed as usize].words;
        let darkens = matches!(facts.mixing, Mixing::Blend | Mixing::Multiply | Mixing::Opaque)
            && words.units.iter().all(|unit| unit.target() == 0)
            && words.global.lighting() == 0
            && mean_color(self.frame, facts.draw).truncate().max_element() < 0.3;
        let is_shadow = self.transform(facts).flattening && darkens;
        is_shadow.then_some((Class::Dropped, "planar shadow"))
    }

    /// The world again under a reflection: seen where a plane or the stencil lets it be.
    fn mirrored(&self, facts: &DrawFacts) -> Option<Finding> {
        self.world.mirrors(facts, self.transforms).then_some((Class::OtherView, "mirrored"))
    }

    fn behind_all(&mut self, facts: &DrawFacts) -> Option<Finding> {
        let [near, far] = facts.depth_range;
        if near >= 0.9 && far >= 0.9 && self.world.stage != Stage::of(facts, self.transforms) {
            return Some((Class::Sky, "far depth range"));
        }
        if self.is_early(facts) && !self.writes_depth(facts) {
            let is_ground = self.is_ground(facts);
            if is_ground {
                self.ground = self.ground.max(self.extent(facts));
            }
            return Some(match is_ground {
                true => (Class::Static, "lit, under the view, before the world"),
                false if self.is_stain_on_ground(facts) => (Class::Layer, "stain on the ground"),
                false => (Class::Sky, "before the world, writes no depth"),
            });
        }
        let layer = facts.place.layer;
        if layer < self.world.stage.layer() {
            return Some((Class::Sky, "depth cleared between it and the world"));
        }
        (!self.writes_depth(facts) && facts.mixing == Mixing::Opaque && self.is_carried_along(facts))
            .then_some((Class::Sky, "surrounds the eye, moves with it"))
    }

    /// Whether a draw that everything else covers is a surface at a place nevertheless: it moves with the world
    /// and is drawn with lighting, be it ambient alone, which no sky is. Programs that cannot see below their ground draw it so.
    fn is_ground(&self, facts: &DrawFacts) -> bool {
        let words = &self.frame.fixed[facts.draw.fixed as usize].words;
        words.is_lit()
            && facts.mixing == Mixing::Opaque
            && self.is_view(facts)
            && !self.is_carried_along(facts)
    }

    /// Whether a draw is blended over ground that was drawn before, and small.
    fn is_stain_on_ground(&self, facts: &DrawFacts) -> bool {
        let is_blended = !matches!(facts.mixing, Mixing::Opaque | Mixing::CutOut);
        is_blended && self.extent(facts) < STAIN * self.ground
    }

    /// Whether a draw turns with the world but keeps its place about the eye.
    fn is_carried_along(&self, facts: &DrawFacts) -> bool {
        let eye = self.transform(facts).eye;
        let turned = |m: DMat4| DMat3::from_mat4(matrix::orthonormal(m));
        if !turned(eye).abs_diff_eq(turned(self.world.view), 1e-4) {
            return false;
        }
        let extent = self.extent(facts);
        let at_eye = eye.col(3).truncate().length() < 1e-3 * extent;
        let world_moves = self.world.view.col(3).truncate().length() > 1e-3 * extent;
        at_eye && world_moves
    }

    /// Diagonal of the box about a draw, eye space.
    fn extent(&self, facts: &DrawFacts) -> f64 {
        let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for sample in facts.eye_samples(self.frame, self.transforms, 64) {
            least = least.min(sample);
            most = most.max(sample);
        }
        (most - least).length()
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
        if !may_be_layer(facts) {
            return None;
        }
        let (modelview, mixing) = (self.transform(facts).modelview_hash, facts.mixing);
        self.base = self.surfaces.same(self.frame, facts.draw, modelview);
        let below = match self.base {
            Some(base) => vec![base],
            None => self.surfaces.below(self.frame, facts, modelview, self.cache)?,
        };
        if mixing == Mixing::Multiply {
            self.multiplied.extend(below);
        }
        Some(match mixing {
            Mixing::Multiply => (Class::Layer, "multiplies a surface drawn before"),
            Mixing::Add => (Class::Layer, "adds to a surface drawn before"),
            Mixing::Opaque => (Class::Layer, "replaces a surface drawn before"),
            Mixing::CutOut | Mixing::Blend => (Class::Layer, "blends over a surface drawn before"),
        })
    }

    fn is_biased(&self, facts: &DrawFacts) -> bool {
        self.frame.fixed[facts.draw.fixed as usize].raster.depth_bias.is_some()
    }

    fn blended(&self, facts: &DrawFacts) -> Option<Finding> {
        let is_biased = self.is_biased(facts);
        Some(match facts.mixing {
            Mixing::Opaque | Mixing::CutOut if facts.depth == DepthUse::TestWrite => return None,
            _ if facts.depth == DepthUse::Equal => (Class::Undecided, "equal depth"),
            Mixing::Opaque => (Class::Undecided, "opaque, writes no depth"),
            Mixing::Multiply if is_biased => (Class::Layer, "stain on a surface"),
            _ if is_biased => (Class::Layer, "decal on a surface"),
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
        let Some(track) = self.track else { return self.by_matrix(facts) };
        if track.animated.is_some() {
            return (Class::Dynamic, "its vertices move");
        }
        match track.motion {
            Motion::Carried | Motion::Attached if self.surrounds(facts) => {
                (Class::Sky, "all about the eye, wherever that is")
            }
            Motion::Carried | Motion::Attached => (Class::Movable, "goes with the camera"),
            Motion::Moves => (Class::Movable, "moves"),
            Motion::Still => (Class::Static, "stands still"),
            Motion::Unknown if track.is_placed => (Class::Static, "placed as most of the world is"),
            Motion::Unknown => self.by_matrix(facts),
        }
    }

    /// What is known before anything has moved.
    fn by_matrix(&self, facts: &DrawFacts) -> Finding {
        match self.is_view(facts) {
            true => (Class::Static, "drawn under the view"),
            false => (Class::Movable, "has its own matrix"),
        }
    }

    /// Whether a draw reaches around the eye and as far as the world does.
    fn surrounds(&self, facts: &DrawFacts) -> bool {
        let extent = self.extent(facts);
        let centre =
            facts.eye_samples(self.frame, self.transforms, 64).fold(DVec3::ZERO, |sum, p| sum + p) / 64.0;
        extent >= 0.5 * self.world.extent && centre.length() < 0.3 * extent
    }

    /// Whether all of a draw is close to the eye, as the world goes.
    fn is_near(&self, facts: &DrawFacts) -> bool {
        let reach = 0.2 * self.world.extent;
        facts.eye_samples(self.frame, self.transforms, 16).all(|p| p.length() < reach)
    }

    /// Whether a draw's colours are light that the program computed beforehand: unlit, and either a
    /// texture with coordinates of its own multiplies another one, or the vertices differ in colour.
    fn is_baked(&mut self, facts: &DrawFacts) -> bool {
        let words = &self.frame.fixed[facts.draw.fixed as usize].words;
        if words.is_lit() {
            return false;
        }
        let has_coordinates =
            |unit: usize| facts.draw.layout.format(Slot::Texture0 as usize + unit) != Format::Absent;
        let modulates = |words: &UnitWords| {
            words.env_mode() == EnvMode::Modulate as u32
                || (words.env_mode() == EnvMode::Combine as u32
                    && words.combine_rgb() == CombineFunction::Modulate as u32)
        };
        let mut textures = words.units.iter().enumerate().filter(|(_, unit)| unit.target() != 0);
        let has_lightmap = textures.next().is_some()
            && textures.any(|(i, unit)| unit.gen_s() == 0 && has_coordinates(i) && modulates(unit));
        has_lightmap || self.cache.has_varying_colors(self.frame, facts.draw, facts.content)
    }
}
