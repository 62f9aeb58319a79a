//! The frame graph's accesses and layouts as Vulkan's, and its barriers as commands.

use afterglow_frame_graph::{Access, Barrier, Layout, ResourceState, StageClass};
use afterglow_gpu::{self as base, Commands, Image, vk};

/// What a resource of the graph is to the device.
#[derive(Clone, Copy)]
pub(crate) enum Bound<'a> {
    Image(&'a Image),
    /// Buffers, and images that stay in one layout: barriers of all memory order them.
    Memory,
}

/// Records the barriers that come before a pass. `bound` holds the graph's resources in the order of declaration.
pub(crate) fn record_barriers(commands: &Commands<'_>, barriers: &[Barrier], bound: &[Bound<'_>]) {
    let mut memory = Vec::new();
    let mut images = Vec::new();
    for barrier in barriers {
        let from = use_of(barrier.from.iter(), barrier.from_layout);
        let to = use_of(barrier.to.iter(), barrier.to_layout);
        match bound[barrier.resource.index()] {
            Bound::Image(image) => images.push(base::image_barrier(image, from, to)),
            Bound::Memory => memory.push(base::memory_barrier(from, to)),
        }
    }
    commands.barriers(&memory, &images);
}

/// How the last frame used an image, as the first half of a barrier.
pub(crate) fn last_use(state: ResourceState) -> base::Access {
    let layout = state.accesses().layout().unwrap_or(Layout::General);
    use_of(state.accesses().iter(), layout)
}

fn use_of(accesses: impl Iterator<Item = Access>, layout: Layout) -> base::Access {
    let none = base::Access::NONE.in_layout(vulkan_layout(layout));
    accesses.fold(none, |all, access| {
        all.or(base::Access {
            stages: stages(access.stage()),
            accesses: access_flags(access),
            layout: vk::ImageLayout::UNDEFINED,
        })
    })
}

fn vulkan_layout(layout: Layout) -> vk::ImageLayout {
    match layout {
        Layout::Undefined => vk::ImageLayout::UNDEFINED,
        Layout::General => vk::ImageLayout::GENERAL,
        Layout::ColorAttachment => vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
        Layout::DepthAttachment => vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        Layout::DepthRead => vk::ImageLayout::DEPTH_STENCIL_READ_ONLY_OPTIMAL,
        Layout::ShaderRead => vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL,
        Layout::TransferSrc => vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
        Layout::TransferDst => vk::ImageLayout::TRANSFER_DST_OPTIMAL,
        Layout::Present => vk::ImageLayout::PRESENT_SRC_KHR,
    }
}

fn stages(class: StageClass) -> vk::PipelineStageFlags2 {
    use vk::PipelineStageFlags2 as Stage;
    match class {
        StageClass::Indirect => Stage::DRAW_INDIRECT,
        StageClass::VertexInput => Stage::INDEX_INPUT | Stage::VERTEX_ATTRIBUTE_INPUT,
        StageClass::Vertex => Stage::VERTEX_SHADER,
        StageClass::Graphics => Stage::VERTEX_SHADER | Stage::FRAGMENT_SHADER,
        StageClass::Fragment => Stage::FRAGMENT_SHADER,
        StageClass::Depth => Stage::EARLY_FRAGMENT_TESTS | Stage::LATE_FRAGMENT_TESTS,
        StageClass::Color => Stage::COLOR_ATTACHMENT_OUTPUT,
        StageClass::Compute => Stage::COMPUTE_SHADER,
        StageClass::Trace => Stage::RAY_TRACING_SHADER_KHR,
        StageClass::AccelerationBuild => Stage::ACCELERATION_STRUCTURE_BUILD_KHR,
        StageClass::Transfer => Stage::ALL_TRANSFER,
        StageClass::Host => Stage::HOST,
        StageClass::Present => Stage::NONE,
    }
}

fn access_flags(access: Access) -> vk::AccessFlags2 {
    use vk::AccessFlags2 as Flags;
    // Reads through addresses, of storage and of textures alike.
    const READ: Flags =
        Flags::from_raw(Flags::SHADER_STORAGE_READ.as_raw() | Flags::SHADER_SAMPLED_READ.as_raw());
    match access {
        Access::ColorAttachment => Flags::COLOR_ATTACHMENT_READ | Flags::COLOR_ATTACHMENT_WRITE,
        Access::DepthAttachment => {
            Flags::DEPTH_STENCIL_ATTACHMENT_READ | Flags::DEPTH_STENCIL_ATTACHMENT_WRITE
        }
        Access::DepthRead => Flags::DEPTH_STENCIL_ATTACHMENT_READ,
        Access::SampledFragment | Access::SampledCompute | Access::SampledTrace => Flags::SHADER_SAMPLED_READ,
        Access::UniformGraphics | Access::UniformCompute | Access::UniformTrace => Flags::UNIFORM_READ,
        Access::StorageReadVertex
        | Access::StorageReadFragment
        | Access::StorageReadCompute
        | Access::StorageReadTrace => READ,
        Access::StorageWriteFragment | Access::StorageWriteCompute | Access::StorageWriteTrace => {
            READ | Flags::SHADER_STORAGE_WRITE
        }
        Access::VertexRead => Flags::VERTEX_ATTRIBUTE_READ,
        Access::IndexRead => Flags::INDEX_READ,
        Access::IndirectRead => Flags::INDIRECT_COMMAND_READ,
        Access::AccelerationInput => Flags::ACCELERATION_STRUCTURE_READ_KHR | Flags::SHADER_READ,
        Access::AccelerationBuild => {
            Flags::ACCELERATION_STRUCTURE_READ_KHR | Flags::ACCELERATION_STRUCTURE_WRITE_KHR
        }
        Access::AccelerationTrace => Flags::ACCELERATION_STRUCTURE_READ_KHR,
        Access::TransferSrc => Flags::TRANSFER_READ,
        // A pass that copies to images may copy from others of them, too.
        Access::TransferDst | Access::TransferWithin => Flags::TRANSFER_READ | Flags::TRANSFER_WRITE,
        Access::HostRead => Flags::HOST_READ,
        Access::HostWrite => Flags::HOST_WRITE,
        Access::Present => Flags::NONE,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afterglow_frame_graph::AccessSet;

    #[test]
    fn uses_are_joined_in_one_layout() {
        let both: AccessSet = [Access::IndexRead, Access::StorageReadVertex].into_iter().collect();
        let joined = use_of(both.iter(), Layout::Undefined);
        assert!(joined.stages.contains(vk::PipelineStageFlags2::VERTEX_SHADER));
        assert!(joined.stages.contains(vk::PipelineStageFlags2::INDEX_INPUT));
        assert!(joined.accesses.contains(vk::AccessFlags2::INDEX_READ));
        let last = last_use(ResourceState::after(Access::TransferDst));
        assert_eq!(last.layout, vk::ImageLayout::TRANSFER_DST_OPTIMAL);
    }

    #[test]
    fn every_access_that_writes_has_a_flag_that_writes() {
        let writes = vk::AccessFlags2::COLOR_ATTACHMENT_WRITE
            | vk::AccessFlags2::DEPTH_STENCIL_ATTACHMENT_WRITE
            | vk::AccessFlags2::SHADER_STORAGE_WRITE
            | vk::AccessFlags2::ACCELERATION_STRUCTURE_WRITE_KHR
            | vk::AccessFlags2::TRANSFER_WRITE
            | vk::AccessFlags2::HOST_WRITE;
        for access in Access::ALL {
            assert_eq!(access.writes(), access_flags(access).intersects(writes), "{access:?}");
        }
    }
}
