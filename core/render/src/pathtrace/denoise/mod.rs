//! Denoisers: of a few samples a pixel, pictures.
//!
//! Light comes as three channels of noise (direct and indirect diffuse, specular), each before it meets the surface's albedo, and with a
//! *guide*: what each texel of light shows and where that was in the frame before. A denoiser is a list of [`Step`]s, each of which
//! runs one pass over some of the [`Store`]s; the last one leaves three clean channels. So another one is a file beside `svgf`.

mod asvgf;
mod bmfr;
mod stores;
mod svgf;
#[cfg(test)]
mod tests;

pub(crate) use stores::{Store, StoreResources, Stores};

use std::str::FromStr;

use afterglow_frame_graph::{Access, GraphBuilder, PassKind, ResourceId};
use afterglow_gpu::{BindlessTable, ComputeDesc, ComputePipeline, Gpu, GpuError};
use afterglow_records::{STRATUM_EDGE, ViewPush};
use afterglow_shaders as shaders;

use super::pipelines::pixel_groups;
use super::schedule::ViewNeeds;

/// Texels of light along a side of a workgroup of evaluate.comp.
const EVALUATED_EDGE: u32 = 16;

/// What makes pictures of few samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Denoiser {
    /// Nothing: noise stays, and frames that do not change add up.
    None,
    /// Spatiotemporal variance-guided filtering (Schied and others, HPG 2017).
    Svgf,
    /// The same with histories that are as long as light has not changed (Schied, Peters and Dachsbacher, HPG 2018).
    #[default]
    Asvgf,
    /// Blockwise multi-order feature regression (Koskela and others, ACM TOG 2019) of the same histories.
    Bmfr,
}

impl Denoiser {
    /// All of them.
    pub const ALL: [Denoiser; 4] = [Denoiser::None, Denoiser::Svgf, Denoiser::Asvgf, Denoiser::Bmfr];

    /// As it is written in options and reports.
    pub fn name(self) -> &'static str {
        match self {
            Denoiser::None => "none",
            Denoiser::Svgf => "svgf",
            Denoiser::Asvgf => "asvgf",
            Denoiser::Bmfr => "bmfr",
        }
    }

    /// Its steps: those before light is traced, and those after.
    pub(crate) fn plan(self) -> Plan {
        match self {
            Denoiser::None => Plan::default(),
            Denoiser::Svgf => svgf::plan(),
            Denoiser::Asvgf => asvgf::plan(),
            Denoiser::Bmfr => bmfr::plan(),
        }
    }
}

/// A word that is no denoiser.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("denoisers are none, svgf, asvgf and bmfr")]
pub struct UnknownDenoiser;

impl FromStr for Denoiser {
    type Err = UnknownDenoiser;

    fn from_str(text: &str) -> Result<Denoiser, UnknownDenoiser> {
        Denoiser::ALL.into_iter().find(|denoiser| denoiser.name() == text).ok_or(UnknownDenoiser)
    }
}

/// What a denoiser does in a frame.
#[derive(Debug, Clone, Default)]
pub(crate) struct Plan {
    pub(crate) before_light: Vec<Step>,
    pub(crate) after_light: Vec<Step>,
    /// Where the clean channels are at the end.
    pub(crate) output: Option<Store>,
    /// One that is free then, of 20 bytes a texel of light.
    pub(crate) spare: Option<Store>,
    /// Where changes of light are, once they are known.
    pub(crate) gradients: Option<Store>,
}

impl Plan {
    /// No texel has more samples than others.
    pub(crate) fn spare_nothing(&mut self) {
        self.before_light.retain(|step| step.stage != Stage::Effort);
    }

    /// Whether a store is used at all.
    pub(crate) fn uses(&self, store: Store) -> bool {
        let steps = self.before_light.iter().chain(&self.after_light);
        self.output == Some(store)
            || steps.into_iter().any(|step| {
                [&step.reads, &step.past, &step.writes].iter().any(|stores| stores.contains(&store))
            })
    }
}

/// A pass that denoisers are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stage {
    /// Which texels may have more samples.
    Effort,
    /// Which texels are traced with the numbers of the frame before.
    Select,
    /// What has changed there.
    Gradient,
    /// What the neighbours know of that.
    Spread,
    /// The history, and this frame's light with it.
    Temporal,
    /// A step of a filter between neighbours.
    Atrous,
    /// Light as a function of surfaces, block by block.
    Regress,
    /// What that is for each texel.
    Evaluate,
}

impl Stage {
    const ALL: [Stage; 8] = [
        Stage::Effort,
        Stage::Select,
        Stage::Gradient,
        Stage::Spread,
        Stage::Temporal,
        Stage::Atrous,
        Stage::Regress,
        Stage::Evaluate,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Stage::Effort => "effort",
            Stage::Select => "gradient samples",
            Stage::Gradient => "gradients",
            Stage::Spread => "gradient filter",
            Stage::Temporal => "temporal filter",
            Stage::Atrous => "spatial filter",
            Stage::Regress => "regression",
            Stage::Evaluate => "fitted light",
        }
    }

    fn spirv(self) -> &'static [u32] {
        match self {
            Stage::Effort => shaders::DENOISE_EFFORT_COMP,
            Stage::Select => shaders::DENOISE_SELECT_COMP,
            Stage::Gradient => shaders::DENOISE_GRADIENT_COMP,
            Stage::Spread => shaders::DENOISE_SPREAD_COMP,
            Stage::Temporal => shaders::DENOISE_TEMPORAL_COMP,
            Stage::Atrous => shaders::DENOISE_ATROUS_COMP,
            Stage::Regress => shaders::DENOISE_REGRESS_COMP,
            Stage::Evaluate => shaders::DENOISE_EVALUATE_COMP,
        }
    }

    /// Workgroups for so many texels of light.
    pub(crate) fn groups(self, size: [u32; 2]) -> [u32; 2] {
        match self {
            Stage::Select | Stage::Gradient | Stage::Spread => {
                pixel_groups(size.map(|side| side.div_ceil(STRATUM_EDGE)))
            }
            Stage::Effort | Stage::Temporal | Stage::Atrous => pixel_groups(size),
            Stage::Regress => stores::blocks(size),
            Stage::Evaluate => size.map(|side| side.div_ceil(EVALUATED_EDGE)),
        }
    }
}

/// One pass of a denoiser.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Step {
    pub(crate) stage: Stage,
    /// What this frame has made.
    pub(crate) reads: Vec<Store>,
    /// What the frame before has left, where it has left anything.
    pub(crate) past: Vec<Store>,
    pub(crate) writes: Vec<Store>,
    /// Those that the pass gets by name, of all that it reads and writes.
    pub(crate) source: Option<Store>,
    pub(crate) target: Option<Store>,
    /// Texels between taps.
    pub(crate) stride: u32,
}

impl Step {
    /// Declares the pass in a frame's graph.
    pub(crate) fn declare(
        &self,
        graph: &mut GraphBuilder,
        stores: &StoreResources,
        counters: ResourceId,
        needs: &ViewNeeds,
    ) {
        let mut pass = graph.pass(self.stage.name(), PassKind::Compute);
        for store in Store::ALL {
            let Some(resource) = stores.get(store) else { continue };
            let is_left = needs.has_history && self.past.contains(&store);
            match (self.reads.contains(&store) || is_left, self.writes.contains(&store)) {
                (true, true) => pass.read_write(resource, Access::StorageWriteCompute),
                (true, false) => pass.read(resource, Access::StorageReadCompute),
                (false, true) => pass.write(resource, Access::StorageWriteCompute),
                (false, false) => continue,
            };
        }
        if self.stage == Stage::Effort {
            pass.read_write(counters, Access::StorageWriteCompute);
        }
        pass.when(!needs.is_idle, super::schedule::IDLE_REASON);
    }

    /// What the pass is told, of a view whose record is at an address.
    pub(crate) fn push(&self, view: u64, stores: &Stores, parity: usize) -> ViewPush {
        let address = |store: Option<Store>| store.map_or(0, |store| stores.address(store, parity));
        ViewPush {
            view,
            source: address(self.source),
            target: address(self.target),
            step: self.stride,
            padding: 0,
        }
    }
}

/// The pipelines of a denoiser's stages; of those that none has used yet there are none.
#[derive(Default)]
pub(crate) struct StagePipelines {
    of: [Option<ComputePipeline>; Stage::ALL.len()],
}

impl StagePipelines {
    /// Makes sure that a plan's pipelines are there.
    pub(crate) fn make_ready(
        &mut self,
        gpu: &Gpu,
        table: &BindlessTable,
        plan: &Plan,
    ) -> Result<(), GpuError> {
        for step in plan.before_light.iter().chain(&plan.after_light) {
            let slot = &mut self.of[step.stage as usize];
            if slot.is_none() {
                *slot = Some(gpu.create_compute_pipeline(&ComputeDesc {
                    name: step.stage.name(),
                    spirv: shaders::current(step.stage.spirv()),
                    entry: c"main",
                    specialization: &[],
                    set_layouts: &[table.layout()],
                    push_constant_bytes: size_of::<ViewPush>() as u32,
                })?);
            }
        }
        Ok(())
    }

    pub(crate) fn get(&self, stage: Stage) -> Option<&ComputePipeline> {
        self.of[stage as usize].as_ref()
    }
}

#[cfg(test)]
mod plans {
    use super::*;

    #[test]
    fn names_are_read_back() {
        for denoiser in Denoiser::ALL {
            assert_eq!(denoiser.name().parse(), Ok(denoiser));
            assert!(UnknownDenoiser.to_string().contains(denoiser.name()));
        }
        assert_eq!("blur".parse::<Denoiser>(), Err(UnknownDenoiser));
    }

    #[test]
    fn every_denoiser_writes_before_it_reads() {
        for denoiser in Denoiser::ALL {
            let plan = denoiser.plan();
            let mut there: Vec<Store> = vec![Store::Guides, Store::Motions];
            for step in &plan.before_light {
                assert!(step.reads.iter().all(|store| there.contains(store)), "{denoiser:?}: {step:?}");
                there.extend(&step.writes);
            }
            there.extend([Store::Noisy, Store::Luminances]);
            for step in &plan.after_light {
                assert!(step.reads.iter().all(|store| there.contains(store)), "{denoiser:?}: {step:?}");
                assert!(step.source.is_none_or(|store| step.reads.contains(&store)));
                assert!(step.target.is_none_or(|store| step.writes.contains(&store)));
                // A filter that reads neighbours cannot write where it reads.
                assert_ne!(step.source, step.target);
                there.extend(&step.writes);
            }
            assert!(plan.output.is_none_or(|output| there.contains(&output)));
        }
    }
}
