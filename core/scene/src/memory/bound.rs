//! The bound on what is remembered: the farthest and the oldest leaves first.

use glam::Vec3;

use super::Memory;
use super::cells::Cell;

/// Share of the bound that is left when something had to leave.
const KEPT_SHARE: f64 = 7.0 / 8.0;
/// Frames without being drawn that weigh as much as the distance to the farthest cell.
const LONG_AGO: f32 = 3600.0;

impl Memory {
    /// Forgets cells until the rest is within the bound. What this frame drew stays longest.
    pub(super) fn bound(&mut self, eye: Vec3) {
        if self.bytes <= self.limit {
            return;
        }
        let distance = |cell: &Cell| {
            let nearest = eye.clamp(cell.bounds[0].min(cell.bounds[1]), cell.bounds[1].max(cell.bounds[0]));
            nearest.distance(eye)
        };
        let farthest = self.cells.iter().flatten().map(distance).fold(f32::MIN_POSITIVE, f32::max);
        let age = |cell: &Cell| (self.now - cell.drawn.0) as f32 / LONG_AGO;
        let mut order: Vec<(f32, usize)> = (0..)
            .zip(&self.cells)
            .filter_map(|(number, cell)| {
                let cell = cell.as_ref()?;
                Some((distance(cell) / farthest + age(cell), number))
            })
            .collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let kept = (self.limit as f64 * KEPT_SHARE) as u64;
        for (_, number) in order {
            if self.bytes <= kept {
                break;
            }
            self.forget_cell(number);
        }
    }
}
