//! What denoisers read and write: some buffers of a texel of light each, and how the last frame left them.

use afterglow_frame_graph::{CompiledGraph, GraphBuilder, ResourceDesc, ResourceId};
use afterglow_gpu::{Gpu, GpuError};
use afterglow_records::{
    BLOCK_STEP, ChannelTexel, FitRecord, GradientTexel, GuideTexel, LuminanceTexel, MotionTexel,
    STRATUM_EDGE, SURFACE_CLASSES, StratumTexel,
};

use super::Plan;
use crate::pathtrace::buffers::Tracked;

/// One of the buffers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Store {
    /// What each texel shows.
    Guides,
    /// What it showed in the frame before.
    GuidesBefore,
    /// Where that was.
    Motions,
    /// The channels as they were traced; later room for a filter's steps.
    Noisy,
    /// Room for a filter's steps.
    Work,
    /// The channels as earlier frames left them.
    History,
    /// Which texels are traced with older numbers.
    Strata,
    /// How much light has changed, twice, to be filtered from one to the other.
    Gradients,
    MoreGradients,
    /// Luminance of the light that was traced last.
    Luminances,
    /// Light of blocks of texels as a function of surfaces.
    Fits,
}

impl Store {
    pub(crate) const ALL: [Store; 11] = [
        Store::Guides,
        Store::GuidesBefore,
        Store::Motions,
        Store::Noisy,
        Store::Work,
        Store::History,
        Store::Strata,
        Store::Gradients,
        Store::MoreGradients,
        Store::Luminances,
        Store::Fits,
    ];

    fn name(self) -> &'static str {
        match self {
            Store::Guides => "guides",
            Store::GuidesBefore => "guides before",
            Store::Motions => "motions",
            Store::Noisy => "noisy light",
            Store::Work => "filtered light",
            Store::History => "light history",
            Store::Strata => "strata",
            Store::Gradients => "gradients",
            Store::MoreGradients => "filtered gradients",
            Store::Luminances => "luminances",
            Store::Fits => "fits",
        }
    }

    /// Bytes for so many texels of light.
    fn bytes(self, [width, height]: [u32; 2]) -> u64 {
        let texels = |[width, height]: [u32; 2]| u64::from(width) * u64::from(height);
        let strata = texels([width.div_ceil(STRATUM_EDGE), height.div_ceil(STRATUM_EDGE)]);
        let (count, stride) = match self {
            Store::Guides | Store::GuidesBefore => (texels([width, height]), size_of::<GuideTexel>()),
            Store::Motions => (texels([width, height]), size_of::<MotionTexel>()),
            Store::Noisy | Store::Work | Store::History => {
                (texels([width, height]), size_of::<ChannelTexel>())
            }
            Store::Strata => (strata, size_of::<StratumTexel>()),
            Store::Gradients | Store::MoreGradients => (strata, size_of::<GradientTexel>()),
            Store::Luminances => (texels([width, height]), size_of::<LuminanceTexel>()),
            Store::Fits => {
                (u64::from(SURFACE_CLASSES) * texels(blocks([width, height])), size_of::<FitRecord>())
            }
        };
        count * stride as u64
    }
}

/// Blocks along each side of so many texels of light. Each texel lies between the middles of four, which are up to a step apart from
/// the picture's border.
pub(crate) fn blocks(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.div_ceil(BLOCK_STEP) + 2)
}

/// All buffers of a window that a plan uses.
pub(crate) struct Stores {
    /// Texels of light.
    pub(crate) size: [u32; 2],
    /// Both frames' guides are two of these, which is which by the frame's number.
    of: [Option<Tracked>; Store::ALL.len()],
}

impl Stores {
    pub(crate) fn new(gpu: &Gpu, plan: &Plan, size: [u32; 2]) -> Result<Self, GpuError> {
        let mut of: [Option<Tracked>; Store::ALL.len()] = Default::default();
        for (slot, store) in of.iter_mut().zip(Store::ALL) {
            if plan.uses(store) {
                *slot = Some(Tracked::new(gpu, store.name(), store.bytes(size))?);
            }
        }
        Ok(Self { size, of })
    }

    /// Whether these serve a plan at so many texels of light.
    pub(crate) fn serve(&self, plan: &Plan, size: [u32; 2]) -> bool {
        self.size == size
            && Store::ALL.iter().zip(&self.of).all(|(store, of)| of.is_some() == plan.uses(*store))
    }

    /// Bytes of them all.
    pub(crate) fn bytes(&self) -> u64 {
        self.of.iter().flatten().map(|tracked| tracked.buffer.size()).sum()
    }

    /// Bytes of a store; 0 if there is none.
    pub(crate) fn bytes_of(&self, store: Store) -> u64 {
        self.of[store as usize].as_ref().map_or(0, |tracked| tracked.buffer.size())
    }

    /// A store's address in frames of a parity; 0 if there is none.
    pub(crate) fn address(&self, store: Store, parity: usize) -> u64 {
        self.of[place(store, parity)].as_ref().map_or(0, |tracked| tracked.buffer.address())
    }

    /// Declares them, as the last frame left them, in a frame of a parity.
    pub(crate) fn declare(&self, graph: &mut GraphBuilder, parity: usize) -> StoreResources {
        let mut resources = StoreResources::default();
        for store in Store::ALL {
            resources.of[store as usize] = self.of[place(store, parity)].as_ref().map(|tracked| {
                let bytes = tracked.buffer.size();
                let resource = graph.import(store.name(), ResourceDesc::Buffer { bytes }, tracked.state);
                graph.output(resource);
                resource
            });
        }
        resources
    }

    /// Takes over how a frame leaves them.
    pub(crate) fn keep_states(&mut self, graph: &CompiledGraph, resources: &StoreResources, parity: usize) {
        for store in Store::ALL {
            let tracked = self.of[place(store, parity)].as_mut();
            if let (Some(tracked), Some(resource)) = (tracked, resources.get(store)) {
                tracked.state = graph.final_state(resource).unwrap_or(tracked.state);
            }
        }
    }
}

/// Where a store is in frames of a parity.
fn place(store: Store, parity: usize) -> usize {
    match (store, parity) {
        (Store::Guides, 1) => Store::GuidesBefore as usize,
        (Store::GuidesBefore, 1) => Store::Guides as usize,
        _ => store as usize,
    }
}

/// The graph's resources that they are.
#[derive(Debug, Clone, Default)]
pub(crate) struct StoreResources {
    of: [Option<ResourceId>; Store::ALL.len()],
}

impl StoreResources {
    pub(crate) fn get(&self, store: Store) -> Option<ResourceId> {
        self.of[store as usize]
    }
}

#[cfg(test)]
impl Stores {
    /// Puts bytes into a store, as a frame's passes would.
    pub(super) fn fill(&mut self, gpu: &Gpu, store: Store, parity: usize, bytes: &[u8]) {
        let Some(tracked) = &mut self.of[place(store, parity)] else { return };
        assert_eq!(tracked.buffer.size(), bytes.len() as u64);
        let usage = afterglow_gpu::vk::BufferUsageFlags::empty();
        tracked.buffer = gpu.upload_buffer(store.name(), usage, bytes).unwrap();
    }

    /// What a store holds.
    pub(super) fn read(&self, gpu: &Gpu, store: Store, parity: usize) -> Vec<u8> {
        let tracked = self.of[place(store, parity)].as_ref().unwrap();
        gpu.download_buffer(&tracked.buffer).unwrap()
    }
}
