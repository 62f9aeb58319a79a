//! Records the passes of views.

use afterglow_gpu::{BindlessTable, Commands};
use afterglow_records::ViewPush;
use bytemuck::Zeroable;

use super::buffers::{ViewBuffers, sum_groups};
use super::denoise::{Plan, StagePipelines, Step};
use super::lists::Lists;
use super::pipelines::{TracePipelines, pixel_groups, run};
use super::prepare::PreparedTrace;
use super::schedule::TraceWork;
use super::sky::SkyMap;
use super::structures::Structures;
use crate::passes::sky;

/// What recording needs.
pub(crate) struct TraceContext<'a> {
    pub(crate) commands: &'a Commands<'a>,
    pub(crate) table: &'a BindlessTable,
    pub(crate) pipelines: &'a TracePipelines,
    pub(crate) plan: &'a Plan,
    pub(crate) stages: &'a StagePipelines,
    pub(crate) structures: &'a Structures,
    pub(crate) lists: &'a Lists,
    pub(crate) buffers: &'a ViewBuffers,
    pub(crate) prepared: &'a PreparedTrace,
    pub(crate) sky: Option<&'a SkyMap>,
}

impl TraceContext<'_> {
    pub(crate) fn record(&self, work: TraceWork) {
        let pipelines = self.pipelines;
        let groups = pixel_groups(self.buffers.size);
        let has_spheres = self.prepared.has_spheres;
        let push = |view: usize| ViewPush { view: self.prepared.views[view].record, ..ViewPush::zeroed() };
        let (pipeline, push, groups) = match work {
            TraceWork::Lists => {
                self.lists.record(self.commands);
                return;
            }
            TraceWork::Build => {
                self.structures.record(self.commands);
                return;
            }
            TraceWork::Refit => {
                self.structures.record_moves(self.commands);
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
            // Draws are recorded by the raster pass.
            TraceWork::DrawSky => return,
            TraceWork::CopySky => {
                if let Some(map) = self.sky {
                    sky::record_copy(self.commands, map);
                }
                return;
            }
            TraceWork::SkyLevel(level) => {
                if let (Some(map), Some(sky)) = (self.sky, &self.prepared.sky.prepared) {
                    let (push, groups) = sky::level(map, sky, level);
                    self.commands.compute(&pipelines.sky, &[self.table.set()], &push, groups);
                }
                return;
            }
            TraceWork::Surface(view) => (&pipelines.surface, push(view), groups),
            TraceWork::Reservoir(view) => (&pipelines.reservoir, push(view), groups),
            TraceWork::Light(view) => {
                let size = self.prepared.light_size;
                pipelines.light.run(self.commands, self.table, &push(view), size, has_spheres);
                return;
            }
            TraceWork::BeforeLight(view, number) => {
                self.record_step(view, self.plan.before_light.get(number));
                return;
            }
            TraceWork::AfterLight(view, number) => {
                self.record_step(view, self.plan.after_light.get(number));
                return;
            }
            TraceWork::Sum(view) => (&pipelines.sum, push(view), sum_groups(self.buffers.size)),
            TraceWork::Exposure(view) => (&pipelines.exposure, push(view), [1, 1]),
            TraceWork::Composite(view) => (&pipelines.composite, push(view), groups),
            TraceWork::Edges(view) => (&pipelines.edges, push(view), groups),
        };
        run(self.commands, self.table, pipeline, &push, groups);
    }

    /// Records a step of the denoiser's.
    fn record_step(&self, view: usize, step: Option<&Step>) {
        let (Some(step), Some(stores)) = (step, self.buffers.stores.get(view)) else { return };
        let Some(pipeline) = self.stages.get(step.stage) else { return };
        let push = step.push(self.prepared.views[view].record, stores, self.prepared.parity);
        run(self.commands, self.table, pipeline, &push, step.stage.groups(stores.size));
    }
}
