//! Meshes that changed from the last frame to this one: the same triangles, moved.

use std::collections::VecDeque;

use hashbrown::HashMap;

/// Contents of the meshes that the last frame used and that may change, by their topologies
/// (`DriverInput::topology`), in order; and those that this frame uses.
#[derive(Default)]
pub(super) struct Formers {
    of_last: HashMap<u64, VecDeque<u64>>,
    of_this: Vec<(u64, u64)>,
}

impl Formers {
    pub(super) fn begin_frame(&mut self) {
        self.of_last.clear();
        for (topology, content) in self.of_this.drain(..) {
            self.of_last.entry(topology).or_default().push_back(content);
        }
    }

    /// Notes a mesh that this frame uses.
    pub(super) fn note(&mut self, topology: u64, content: u64) {
        self.of_this.push((topology, content));
    }

    /// The next mesh of a topology that the last frame used; this one may use it, too.
    pub(super) fn next(&mut self, topology: u64) -> Option<u64> {
        self.of_last.get_mut(&topology)?.pop_front()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_of_the_last_frame_come_once_and_in_order() {
        let mut formers = Formers::default();
        formers.note(7, 1);
        formers.note(8, 2);
        formers.note(7, 3);
        assert_eq!(formers.next(7), None);
        formers.begin_frame();
        assert_eq!([7, 7, 7, 8].map(|topology| formers.next(topology)), [Some(1), Some(3), None, Some(2)]);
        formers.begin_frame();
        assert_eq!(formers.next(8), None);
    }
}
