//! Records the passes of views.

use afterglow_gpu::{BindlessTable, Commands};
use afterglow_records::ViewPush;
use bytemuck::Zeroable;

use super::buffers::{ViewBuffers, sum_groups};
use super::lists::Lists;
use super::pipelines::{TracePipelines, pixel_groups, run};
use super::prepare::PreparedTrace;
use super::schedule::TraceWork;
use super::structures::Structures;

/// What recording needs.
pub(crate) struct TraceContext<'a> {
    pub(crate) commands: &'a Commands<'a>,
    pub(crate) table: &'a BindlessTable,
    pub(crate) pipelines: &'a TracePipelines,
    pub(crate) structures: &'a Structures,
    pub(crate) lists: &'a Lists,
    pub(crate) buffers: &'a ViewBuffers,
    pub(crate) prepared: &'a PreparedTrace,
}

impl TraceContext<'_> {
    pub(crate) fn record(&self, work: TraceWork) {
        let pipelines = self.pipelines;
        let groups = pixel_groups(self.buffers.size);
        let has_spheres = self.prepared.has_spheres;
        let push = |view: usize| ViewPush { view: self.prepared.views[view].record, ..ViewPush::zeroed() };
        let indirect = |index: usize| self.buffers.indirect[index].buffer.address();
        let (pipeline, push, groups) = match work {
            TraceWork::Lists => {
                self.lists.record(self.commands);
                return;
            }
            TraceWork::Build => {
                self.structures.record(self.commands);
                return;
            }
            TraceWork::ClearSums => {
                self.commands.fill_buffer(&self.buffers.movers.buffer, 0);
                return;
            }
            TraceWork::ClearCounters => {
                self.commands.fill_buffer(&self.buffers.counters.buffer, 0);
                return;
            }
            TraceWork::Reference(view) => {
                pipelines.reference.run(
                    self.commands,
                    self.table,
                    &push(view),
                    self.buffers.size,
                    has_spheres,
                );
                return;
            }
            TraceWork::Surface(view) => (&pipelines.surface, push(view), groups),
            TraceWork::Reservoir(view) => (&pipelines.reservoir, push(view), groups),
            TraceWork::Light(view) => {
                let push = ViewPush { target: indirect(0), ..push(view) };
                pipelines.light.run(self.commands, self.table, &push, self.buffers.size, has_spheres);
                return;
            }
            TraceWork::Filter(view, step) => {
                let from = step as usize % 2;
                let push = ViewPush {
                    source: indirect(from),
                    target: indirect(1 - from),
                    step: 1 << step,
                    ..push(view)
                };
                (&pipelines.filter, push, groups)
            }
            TraceWork::Sum(view) => (&pipelines.sum, push(view), sum_groups(self.buffers.size)),
            TraceWork::Exposure(view) => (&pipelines.exposure, push(view), [1, 1]),
            TraceWork::Composite(view) => (&pipelines.composite, push(view), groups),
        };
        run(self.commands, self.table, pipeline, &push, groups);
    }
}
