//! The bound on what is remembered: the farthest and the oldest leaves first.

use glam::Vec3;

use super::Memory;
use super::blocks::Block;
use super::cells::Cell;

/// Share of the bound that is left when something had to leave.
const KEPT_SHARE: f64 = 7.0 / 8.0;
/// Frames without being drawn that weigh as much as the distance to the farthest block.
const LONG_AGO: f32 = 3600.0;

impl Memory {
    /// Forgets blocks until the rest is within the bound. What this frame drew stays longest.
    pub(super) fn bound(&mut self, eye: Vec3) {
        if self.bytes <= self.limit {
            return;
        }
        let distance = |cell: &Cell| {
            let [least, most] = cell.bounds;
            eye.clamp(least.min(most), most.max(least)).distance(eye)
        };
        let nearest = |block: &Block| self.cells_of(block).map(distance).fold(f32::INFINITY, f32::min);
        let age = |block: &Block| {
            let drawn = self.cells_of(block).map(|cell| cell.drawn.0).max().unwrap_or(0);
            (self.now - drawn) as f32 / LONG_AGO
        };
        let farthest = self.blocks.values().map(nearest).fold(f32::MIN_POSITIVE, f32::max);
        let score = |block: &Block| nearest(block) / farthest + age(block);
        let mut order: Vec<(f32, u32)> =
            self.blocks.iter().map(|(number, block)| (score(block), *number)).collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let kept = (self.limit as f64 * KEPT_SHARE) as u64;
        for (_, number) in order {
            if self.bytes <= kept {
                break;
            }
            for cell in self.blocks.get(&number).map(|block| block.cells.clone()).unwrap_or_default() {
                self.forget_cell(cell as usize);
            }
        }
    }
}
