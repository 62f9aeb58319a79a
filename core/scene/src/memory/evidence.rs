//! Evidence that something remembered is there no more.
//!
//! A triangle should be visible if it lies within the picture, faces the eye as it did when it was seen, and nothing
//! drawn is before it. If the program does not draw it then, time and again, it is gone: a door has opened, a bridge
//! has fallen, another level of detail has taken its place. Where nothing at all is drawn it must also be well
//! within the distance that the program draws to.

use afterglow_gl::frame::{Cull, Frame, Operation, Topology};
use glam::{Mat4, Vec3, Vec4};
use hashbrown::HashSet;

use super::cells::{Cell, Pile};
use super::depth::may_be_seen;
use super::entries::Entry;
use super::{MISSING_FRAMES, Memory, TEST_INTERVAL};
use crate::types::{Camera, Class, Scene, Verdict};

/// How much nearer a surface must be to hide what is behind it, as a share of the distance.
const TOLERANCE: f32 = 0.004;
/// Share of the distance that the program draws to within which things are drawn that nothing else is drawn behind.
const DRAWN_SHARE: f32 = 0.5;
/// Triangles that stand for a draw that is known as a whole.
const SAMPLES: usize = 16;
/// Triangles tested in a frame, at most; what is left is tested the next time.
const MOST_TESTED: usize = 1 << 15;

/// From where things should be seen.
struct Viewpoint {
    clip_from_world: Mat4,
    eye: Vec3,
}

impl Memory {
    /// Forgets what should be visible and was not drawn for long enough.
    pub(super) fn remove_missing(&mut self, frame: &Frame, scene: &Scene, camera: &Camera) {
        self.draw_depth(frame, scene);
        if !self.depth.is_complete() {
            return;
        }
        let view = Viewpoint {
            clip_from_world: (camera.projection.as_dmat4() * camera.view).as_mat4(),
            eye: camera.view.inverse().w_axis.truncate().as_vec3(),
        };
        let mut tested = 0;
        let count = self.cells.len();
        for step in 0..count {
            let number = (self.next_tested + step) % count;
            if tested >= MOST_TESTED {
                self.next_tested = number;
                return;
            }
            let Some(cell) = self.cells[number].take() else { continue };
            if cell.is_drawn(self.now) || !may_be_seen(view.clip_from_world, cell.bounds) {
                self.cells[number] = Some(cell);
                continue;
            }
            tested += cell.entries.len();
            let gone = self.test(&cell, &view);
            self.cells[number] = Some(cell);
            self.remove_from_cell(number, &gone);
        }
    }

    /// Draws what may hide things: what is traced, and what else writes depth among it.
    fn draw_depth(&mut self, frame: &Frame, scene: &Scene) {
        self.depth.clear();
        let hides = |verdict: &&Verdict| verdict.class.is_traced() || verdict.class == Class::Undecided;
        for verdict in scene.verdicts.iter().filter(hides) {
            let Some(Operation::Draw(draw)) = frame.operations.get(verdict.operation as usize) else {
                continue;
            };
            let raster = frame.fixed.get(draw.fixed as usize).map(|fixed| fixed.raster);
            let writes = raster.and_then(|raster| raster.depth).is_some_and(|depth| depth.write);
            if draw.topology == Topology::Triangles && (writes || verdict.class.is_traced()) {
                self.depth.draw(frame, draw);
            }
        }
    }

    /// Tests the triangles of a cell. Returns the entries of those that are gone.
    fn test(&mut self, cell: &Cell, view: &Viewpoint) -> HashSet<u32> {
        let kind = self.kinds.get(cell.kind);
        let mut gone = HashSet::new();
        let Some(pass) = cell.passes.first() else { return gone };
        let raster = pass.look.fixed.raster;
        let is_culled = |is_ccw: bool| match raster.cull {
            Cull::None => false,
            Cull::FrontAndBack => true,
            Cull::Back => is_ccw != raster.front_ccw,
            Cull::Front => is_ccw == raster.front_ccw,
        };
        let is_divisible = !cell.is_whole;
        let step = if is_divisible { 1 } else { (pass.index_count as usize / 3).div_ceil(SAMPLES).max(1) };
        let mut is_any_visible = false;
        for (number, corners) in pass.triangles(kind.model).enumerate().step_by(step) {
            let entry = cell.entries[if is_divisible { number } else { 0 }];
            if self.entries.get(entry).drawn == self.now {
                continue;
            }
            let from_front = is_divisible.then(|| self.entries.get(entry).from_front);
            let is_visible =
                corners.is_some_and(|corners| self.should_be_seen(corners, view, from_front, is_culled));
            is_any_visible |= is_visible;
            if is_divisible && failed(self.entries.get_mut(entry), is_visible, self.now) {
                gone.insert(entry);
            }
        }
        if let (false, Some(&entry)) = (is_divisible, cell.entries.first())
            && failed(self.entries.get_mut(entry), is_any_visible, self.now)
        {
            gone.insert(entry);
        }
        gone
    }

    /// Whether a triangle should be visible. `from_front` says from which side it was seen, where that is known.
    fn should_be_seen(
        &self,
        corners: [Vec3; 3],
        view: &Viewpoint,
        from_front: Option<bool>,
        is_culled: impl Fn(bool) -> bool,
    ) -> bool {
        let [a, b, c] = corners;
        let is_front = (b - a).cross(c - a).dot(view.eye - a) >= 0.0;
        if from_front.is_some_and(|from_front| from_front != is_front) {
            return false;
        }
        let centre = (a + b + c) / 3.0;
        let clip = corners.map(|corner| {
            // Corners themselves are others' as well.
            view.clip_from_world * corner.lerp(centre, 0.2).extend(1.0)
        });
        if is_culled(winds_left(clip)) {
            return false;
        }
        let centre = view.clip_from_world * centre.extend(1.0);
        clip.into_iter().chain([centre]).all(|sample| {
            let Some(nearest) = self.depth.about(sample) else { return false };
            match nearest < f32::INFINITY {
                true => nearest >= sample.w * (1.0 - TOLERANCE),
                false => sample.w < DRAWN_SHARE * self.depth.farthest,
            }
        })
    }

    /// Forgets some of a cell's entries; what is left becomes cells anew.
    fn remove_from_cell(&mut self, number: usize, gone: &HashSet<u32>) {
        if gone.is_empty() {
            return;
        }
        let Some(cell) = self.take_cell(number) else { return };
        let mut pile = Pile::default();
        if !cell.is_whole {
            pile.add_cell(&cell, |entry| !gone.contains(&entry));
        }
        if !pile.entries.is_empty() {
            let all: Vec<u32> = (0..pile.entries.len() as u32).collect();
            let rest = pile.cell(cell.kind, self.kinds.get(cell.kind), &all, cell.drawn.0);
            self.add_cell(cell.block, rest);
        }
        gone.iter().for_each(|&entry| self.forget_entry(entry));
    }
}

/// Whether a triangle of clip space, before the eye, is counter-clockwise on the screen.
fn winds_left(clip: [Vec4; 3]) -> bool {
    let [a, b, c] = clip.map(|corner| corner.truncate().truncate() / corner.w);
    (b - a).perp_dot(c - a) > 0.0
}

/// Counts a test. Says whether an entry has failed often and long enough.
fn failed(entry: &mut Entry, is_visible: bool, now: u32) -> bool {
    entry.missing = if is_visible { entry.missing.saturating_add(1) } else { 0 };
    u32::from(entry.missing) * TEST_INTERVAL >= MISSING_FRAMES && entry.drawn + MISSING_FRAMES <= now
}
