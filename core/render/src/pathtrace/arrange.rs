//! A frame's operations in an order in which its world can be traced.
//!
//! What is traced, and what is drawn solid between, keeps its place; what is blended between waits until light is
//! there. Where that cannot be (depth or colour is cleared, pixels are copied), the world so far is lit first: a frame
//! has one *view*, or several.

use std::ops::Range;

use afterglow_gl::frame::{Draw, Frame, ImageKey, Operation, Topology};
use afterglow_scene::{Class, Scene};
use hashbrown::HashSet;

/// Views that are traced in one frame; what comes after is rasterized.
const MOST_VIEWS: usize = 4;

/// What a draw of a view leaves in the visibility buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    /// Its triangles, to be lit.
    Traced,
    /// Likewise; rays meet what it covers as part of the world that was drawn before.
    Covered,
    /// Nothing: it is part of the surface below it.
    Layer,
    /// Nothing: it writes no colour.
    Colorless,
    /// That nothing is traced there.
    Solid,
    /// Nothing: it is not rasterized at all, for rays alone. The block that it is part of.
    Unseen(u32),
}

/// How an operation behaves when the frame is put in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Role {
    Mark(Mark),
    /// Blended: comes after light where it stands between what is traced.
    Waits,
    /// Not drawn at all.
    Dropped,
    /// Keeps its place, and touches no pixel.
    Neutral,
    /// What was drawn before must be complete.
    Barrier,
}

/// The frame in its new order.
#[derive(Debug, Default)]
pub(crate) struct Arrangement {
    /// Numbers of operations; dropped ones are missing.
    pub(crate) order: Vec<usize>,
    /// Of each place in `order`, what it leaves if it is a draw of a view.
    pub(crate) marks: Vec<Option<Mark>>,
    /// Ranges of places in `order` that are views, in order.
    pub(crate) views: Vec<Range<usize>>,
}

/// Orders a frame's operations. `scene` has a verdict on each of its draws.
pub(crate) fn arrange(frame: &Frame, scene: &Scene) -> Arrangement {
    let classes = classes(frame, scene);
    let mut arranger = Arranger {
        frame,
        result: Arrangement::default(),
        segment: Vec::new(),
        has_traced: false,
        waiting_images: HashSet::new(),
        is_counting: false,
    };
    for (index, operation) in frame.operations.iter().enumerate() {
        arranger.add(index, operation, classes[index]);
    }
    arranger.close();
    arranger.result
}

/// The class of each operation that is a draw.
fn classes(frame: &Frame, scene: &Scene) -> Vec<Option<Class>> {
    let mut classes = vec![None; frame.operations.len()];
    for verdict in &scene.verdicts {
        if let Some(class) = classes.get_mut(verdict.operation as usize) {
            *class = Some(verdict.class);
        }
    }
    classes
}

struct Arranger<'a> {
    frame: &'a Frame,
    result: Arrangement,
    /// Operations since the last barrier.
    segment: Vec<(usize, Role)>,
    has_traced: bool,
    /// Textures of draws that wait: they must not change meanwhile.
    waiting_images: HashSet<ImageKey>,
    /// Samples are being counted: nothing may leave its place.
    is_counting: bool,
}

impl Arranger<'_> {
    fn add(&mut self, index: usize, operation: &Operation, class: Option<Class>) {
        let mut role = self.role(operation, class);
        if role == Role::Mark(Mark::Traced) && self.result.views.len() >= MOST_VIEWS {
            role = Role::Mark(Mark::Solid);
        }
        if role == Role::Barrier && self.has_traced {
            self.close();
        }
        if role == Role::Waits {
            self.note_textures(operation);
        }
        self.has_traced |= role == Role::Mark(Mark::Traced);
        self.segment.push((index, role));
    }

    fn role(&mut self, operation: &Operation, class: Option<Class>) -> Role {
        match operation {
            Operation::Draw(draw) => self.draw_role(draw, class.unwrap_or(Class::Undecided)),
            Operation::Clear(clear) if clear.color.is_none() && clear.depth.is_none() => Role::Neutral,
            Operation::Clear(_)
            | Operation::CopyPixels(_)
            | Operation::CopyToImage(_)
            | Operation::Accumulate(..)
            | Operation::ClearAccumulation(_) => Role::Barrier,
            Operation::Pixels(_) => Role::Waits,
            Operation::BeginQuery(_) => {
                self.is_counting = true;
                Role::Neutral
            }
            Operation::EndQuery(_) => {
                self.is_counting = false;
                Role::Neutral
            }
            Operation::Upload(upload) => self.change_role(upload.image),
            Operation::CopyImage { to, .. } => self.change_role(*to),
            Operation::DefineImage { .. } | Operation::DropImage(_) => Role::Neutral,
        }
    }

    fn change_role(&self, image: ImageKey) -> Role {
        match self.waiting_images.contains(&image) {
            true => Role::Barrier,
            false => Role::Neutral,
        }
    }

    fn draw_role(&self, draw: &Draw, class: Class) -> Role {
        let Some(fixed) = self.frame.fixed.get(draw.fixed as usize) else {
            return Role::Neutral;
        };
        let raster = &fixed.raster;
        let writes_color = raster.color_mask & 7 != 0;
        match class {
            Class::Dropped => Role::Dropped,
            _ if !writes_color => Role::Mark(Mark::Colorless),
            Class::Layer => Role::Mark(Mark::Layer),
            _ if class.is_traced() && draw.topology == Topology::Triangles && raster.logic_op.is_none() => {
                Role::Mark(Mark::Traced)
            }
            // Blended or not, it is behind what comes after it, and before the ground that it rises from.
            Class::Sky => Role::Mark(Mark::Solid),
            _ if self.is_counting => Role::Mark(Mark::Solid),
            _ if raster.blend.is_some() || raster.logic_op.is_some() => Role::Waits,
            _ => Role::Mark(Mark::Solid),
        }
    }

    fn note_textures(&mut self, operation: &Operation) {
        let bindings = match operation {
            Operation::Draw(draw) => draw.bindings,
            Operation::Pixels(pixels) => pixels.bindings,
            _ => return,
        };
        let bound = self.frame.bindings.get(bindings as usize).into_iter().flatten().flatten();
        self.waiting_images.extend(bound.map(|binding| binding.image));
    }

    /// Orders the operations since the last barrier.
    fn close(&mut self) {
        let segment = std::mem::take(&mut self.segment);
        let is_surface = |(_, role): &(usize, Role)| matches!(role, Role::Mark(Mark::Traced | Mark::Layer));
        let is_traced = |(_, role): &(usize, Role)| *role == Role::Mark(Mark::Traced);
        let first = segment.iter().position(is_traced);
        let last = segment.iter().rposition(is_surface);
        match (first, last) {
            (Some(first), Some(last)) => {
                self.push_all(&segment[..first]);
                self.view(&segment[first..=last]);
                self.push_all(&segment[last + 1..]);
            }
            _ => self.push_all(&segment),
        }
        self.has_traced = false;
        self.waiting_images.clear();
    }

    /// Operations outside of views, in their own order.
    fn push_all(&mut self, operations: &[(usize, Role)]) {
        for &(index, role) in operations {
            if role != Role::Dropped {
                self.push(index, None);
            }
        }
    }

    fn view(&mut self, operations: &[(usize, Role)]) {
        let start = self.result.order.len();
        for &(index, role) in operations {
            match role {
                Role::Mark(mark) => self.push(index, Some(mark)),
                Role::Neutral | Role::Barrier => self.push(index, None),
                Role::Waits | Role::Dropped => {}
            }
        }
        self.result.views.push(start..self.result.order.len());
        for &(index, role) in operations {
            if role == Role::Waits {
                self.push(index, None);
            }
        }
    }

    fn push(&mut self, index: usize, mark: Option<Mark>) {
        self.result.order.push(index);
        self.result.marks.push(mark);
    }
}

impl Arrangement {
    /// Where nothing is to be traced, a clear of the window is a view all the same: rays of the camera's own see the sky and
    /// its lights.
    pub(crate) fn see_anything(&mut self, frame: &Frame) {
        let is_clear = |index: &usize| matches!(frame.operations[*index], Operation::Clear(_));
        if let (true, Some(place)) = (self.views.is_empty(), self.order.iter().rposition(is_clear)) {
            self.views.push(place..place + 1);
        }
    }

    /// Puts a frame's operations, and the operations that a scene's verdicts name, in this order.
    pub(crate) fn apply(&self, frame: &mut Frame, scene: &mut Scene) {
        let mut places = vec![None; frame.operations.len()];
        let mut operations: Vec<_> = std::mem::take(&mut frame.operations).into_iter().map(Some).collect();
        for (place, &index) in self.order.iter().enumerate() {
            places[index] = Some(place as u32);
            frame.operations.extend(operations[index].take());
        }
        scene.verdicts.retain_mut(|verdict| {
            let place = places.get(verdict.operation as usize).copied().flatten();
            verdict.operation = place.unwrap_or_default();
            place.is_some()
        });
        scene.verdicts.sort_by_key(|verdict| verdict.operation);
        scene.deformed.retain_mut(|deformed| {
            let place = places.get(deformed.operation as usize).copied().flatten();
            deformed.operation = place.unwrap_or_default();
            place.is_some()
        });
        if let Some(sky) = &mut scene.painted_sky {
            sky.draws.retain_mut(|draw| {
                let place = places.get(draw.operation as usize).copied().flatten();
                draw.operation = place.unwrap_or_default();
                place.is_some()
            });
            sky.draws.sort_by_key(|draw| draw.operation);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{FrameBuilder, RED};
    use afterglow_gl::frame::{Blend, BlendEquation, BlendFactor};
    use afterglow_scene::Verdict;
    use glam::Mat4;

    fn add() -> Blend {
        Blend {
            rgb: (BlendFactor::One, BlendFactor::One),
            alpha: (BlendFactor::One, BlendFactor::One),
            equation_rgb: BlendEquation::Add,
            equation_alpha: BlendEquation::Add,
            constant: Default::default(),
        }
    }

    /// A frame of clears (`None`) and draws of these classes, blended where the class is translucent.
    fn frame(classes: &[Option<Class>]) -> (Frame, Scene) {
        let mut builder = FrameBuilder::new(8, 8);
        let mut scene = Scene::default();
        for (index, class) in classes.iter().enumerate() {
            let Some(class) = class else {
                builder.clear([0.0; 4]);
                continue;
            };
            builder.fixed.raster.blend = (*class == Class::Translucent).then(add);
            builder.fill(0.0, RED);
            scene.verdicts.push(Verdict {
                operation: index as u32,
                class: *class,
                reason: "test",
                model: Mat4::IDENTITY,
                object: 0,
                previous: None,
                baked: false,
                triangles: 2,
                base: None,
            });
        }
        (builder.frame, scene)
    }

    #[test]
    fn what_is_blended_amid_the_world_waits() {
        let classes = [
            None,
            Some(Class::Sky),
            Some(Class::Static),
            Some(Class::Translucent),
            Some(Class::Movable),
            Some(Class::Layer),
            Some(Class::Interface),
        ];
        let (frame, scene) = frame(&classes);
        let arrangement = arrange(&frame, &scene);
        assert_eq!(arrangement.order, [0, 1, 2, 4, 5, 3, 6]);
        assert_eq!(arrangement.views, std::slice::from_ref(&(2..5)));
        let marks = [Mark::Traced, Mark::Traced, Mark::Layer].map(Some);
        assert_eq!(arrangement.marks[2..5], marks);
        assert_eq!(arrangement.marks[5], None);
    }

    #[test]
    fn a_clear_amid_the_world_makes_two_views() {
        let classes = [
            None,
            Some(Class::Static),
            Some(Class::Translucent),
            None,
            Some(Class::ViewModel),
            None,
            Some(Class::Interface),
        ];
        let (frame, scene) = frame(&classes);
        let arrangement = arrange(&frame, &scene);
        assert_eq!(arrangement.order, [0, 1, 2, 3, 4, 5, 6]);
        assert_eq!(arrangement.views, [1..2, 4..5]);
    }

    #[test]
    fn dropped_draws_are_left_out_and_verdicts_follow_their_draws() {
        let classes = [Some(Class::Static), Some(Class::Dropped), Some(Class::Movable)];
        let (mut frame, mut scene) = frame(&classes);
        arrange(&frame, &scene).apply(&mut frame, &mut scene);
        assert_eq!(frame.operations.len(), 2);
        let operations: Vec<_> = scene.verdicts.iter().map(|v| (v.operation, v.class)).collect();
        assert_eq!(operations, [(0, Class::Static), (1, Class::Movable)]);
    }

    #[test]
    fn a_frame_without_a_world_stays_as_it_is() {
        let classes = [None, Some(Class::Interface), Some(Class::Translucent), None];
        let (frame, scene) = frame(&classes);
        let arrangement = arrange(&frame, &scene);
        assert_eq!(arrangement.order, [0, 1, 2, 3]);
        assert!(arrangement.views.is_empty());
    }
}
