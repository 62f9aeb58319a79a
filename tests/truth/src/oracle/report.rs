//! What an oracle said, for people who check it.

use std::collections::BTreeMap;
use std::io::{self, Write};

use afterglow_api::constants::*;

use super::{Drawn, Judged};
use crate::truth::{CLASSES, class_index};

/// Writes a line a frame: triangles by class.
///
/// # Errors
/// Those of `out`.
pub fn write_counts(out: &mut impl Write, frames: &[Vec<Drawn>], judged: &[Judged]) -> io::Result<()> {
    for (index, (drawn, judged)) in frames.iter().zip(judged).enumerate() {
        let mut counts: BTreeMap<usize, u64> = BTreeMap::new();
        for (drawn, (class, _)) in drawn.iter().zip(&judged.things) {
            *counts.entry(class_index(*class)).or_default() += drawn.triangles;
        }
        let camera = if judged.camera.is_some() { "camera" } else { "-" };
        write!(out, "{index:>4} {camera:<7}")?;
        for (class, count) in counts.into_iter().filter(|(_, count)| *count > 0) {
            write!(out, " {} {count}", CLASSES[class].1)?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Writes a line a draw of one frame: what it is, and what it was judged by.
///
/// # Errors
/// Those of `out`.
pub fn write_draws(out: &mut impl Write, drawn: &[Drawn], judged: &Judged) -> io::Result<()> {
    for (drawn, (class, object)) in drawn.iter().zip(&judged.things) {
        let state = &drawn.state;
        let place = drawn.modelview().col(3);
        let [least, most] = drawn.bounds;
        let blend = drawn.blending().map_or("-".into(), |(source, to)| format!("{source:x}/{to:x}"));
        let flag = |is_set: bool, letter: char| if is_set { letter } else { '-' };
        let flags: String = [
            flag(drawn.is_perspective(), 'p'),
            flag(state.has(GL_DEPTH_TEST), 't'),
            flag(state.depth_mask, 'w'),
            flag(state.has(GL_LIGHTING), 'l'),
            flag(state.has(GL_ALPHA_TEST), 'a'),
            flag(state.has(GL_POLYGON_OFFSET_FILL), 'o'),
            flag(state.has(GL_STENCIL_TEST), 's'),
            flag(state.color_mask, 'c'),
        ]
        .iter()
        .collect();
        writeln!(
            out,
            "{:>4} {:<11} {:>6} tri {:>5} mode {} {flags} func {:x} blend {blend} {:?}>{} tex {:?} lists {:?} buf {} \
             stack {} lock {} view {:?} range {:?} at {:.2} {:.2} {:.2} box {:.1} {:.1} {:.1} .. {:.1} {:.1} {:.1}",
            drawn.index,
            CLASSES[class_index(*class)].1,
            object,
            drawn.triangles,
            drawn.mode,
            state.depth_func,
            drawn.opacity,
            state.alpha_reference,
            state.textures.iter().flatten().collect::<Vec<_>>(),
            drawn.lists,
            drawn.buffer,
            drawn.stack.len(),
            drawn.lock,
            state.viewport,
            state.depth_range,
            place.x,
            place.y,
            place.z,
            least.x,
            least.y,
            least.z,
            most.x,
            most.y,
            most.z,
        )?;
    }
    Ok(())
}
