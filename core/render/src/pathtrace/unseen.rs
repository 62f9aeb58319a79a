//! The world that was not drawn: what the scene remembers becomes draws at the frame's end, which rays meet and
//! nothing rasterizes.

use std::sync::Arc;

use afterglow_gl::frame::{
    Draw, Frame, Hint, HintMaterial, Operation, RetainedRange, Topology, VertexSource,
};
use afterglow_scene::{Class, Look, Pass, Scene, Unseen, Verdict};
use hashbrown::HashMap;

use super::arrange::{Arrangement, Mark};

/// Adds what a scene remembers to a frame that was put in order: draws, their state, their verdicts and marks.
pub(crate) fn append(frame: &mut Frame, scene: &mut Scene, arrangement: &mut Arrangement) {
    arrangement.marks.resize(frame.operations.len(), None);
    for (mark, operation) in arrangement.marks.iter_mut().zip(&arrangement.order) {
        if *mark == Some(Mark::Traced) && scene.covered.binary_search(&(*operation as u32)).is_ok() {
            *mark = Some(Mark::Covered);
        }
    }
    let mut appender = Appender { frame, ranges: HashMap::new(), looks: HashMap::new() };
    for unseen in std::mem::take(&mut scene.unseen) {
        let base = appender.frame.operations.len() as u32;
        for (number, pass) in unseen.passes.iter().enumerate() {
            let is_layer = number > 0;
            scene.verdicts.push(verdict(
                &unseen,
                pass,
                base,
                appender.frame.operations.len() as u32,
                is_layer,
            ));
            arrangement.marks.push(Some(if is_layer { Mark::Layer } else { Mark::Unseen(unseen.block) }));
            appender.add(pass);
        }
    }
}

fn verdict(unseen: &Unseen, pass: &Pass, base: u32, operation: u32, is_layer: bool) -> Verdict {
    Verdict {
        operation,
        class: if is_layer { Class::Layer } else { Class::Static },
        reason: "drawn before",
        model: unseen.model,
        object: unseen.object,
        previous: Some(unseen.model),
        baked: unseen.baked,
        triangles: pass.index_count / 3,
        base: is_layer.then_some(base),
    }
}

/// Adds draws to a frame's end; what several of them share is added once.
struct Appender<'a> {
    frame: &'a mut Frame,
    ranges: HashMap<u64, u32>,
    /// A draw of each look, by address.
    looks: HashMap<*const Look, Draw>,
}

impl Appender<'_> {
    fn add(&mut self, pass: &Pass) {
        let source = VertexSource::Retained { range: self.range(&pass.range), first_index: pass.first_index };
        let state = match self.looks.get(&Arc::as_ptr(&pass.look)) {
            Some(state) => *state,
            None => self.state(&pass.look),
        };
        let (layout, index_count) = (pass.range.layout, pass.index_count);
        self.frame.operations.push(Operation::Draw(Draw { source, layout, index_count, ..state }));
    }

    fn range(&mut self, range: &Arc<RetainedRange>) -> u32 {
        *self.ranges.entry(range.id()).or_insert_with(|| {
            self.frame.retained.push(range.clone());
            self.frame.retained.len() as u32 - 1
        })
    }

    /// What a program has said of a look's material, as draws name it.
    fn hint(&mut self, look: &Look) -> u32 {
        if look.said == HintMaterial::default() {
            return 0;
        }
        self.frame.hints.push(Hint { material: look.said, ..Hint::default() });
        self.frame.hints.len() as u32
    }

    /// A draw with the state of a look. Rays read neither matrices nor viewports nor lights of draws: those are any.
    fn state(&mut self, look: &Arc<Look>) -> Draw {
        fn push<T>(table: &mut Vec<T>, entry: T) -> u32 {
            table.push(entry);
            table.len() as u32 - 1
        }
        let hint = self.hint(look);
        let state = Draw {
            source: VertexSource::Retained { range: 0, first_index: 0 },
            layout: Default::default(),
            topology: Topology::Triangles,
            index_count: 0,
            fixed: push(&mut self.frame.fixed, look.fixed),
            viewport: 0,
            bindings: push(&mut self.frame.bindings, look.bindings),
            transform: 0,
            lights: 0,
            material: push(&mut self.frame.materials, look.material),
            environment: push(&mut self.frame.environments, look.environment),
            texgen: push(&mut self.frame.texgens, look.texgen),
            texture_matrices: push(&mut self.frame.texture_matrices, look.texture_matrices),
            clip_planes: 0,
            current: push(&mut self.frame.current, look.current),
            hint,
        };
        self.looks.insert(Arc::as_ptr(look), state);
        state
    }
}
