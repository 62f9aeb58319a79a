//! Barriers: who wrote, who is to read, and in which layout an image is for each.

use ash::vk;

use crate::commands::Commands;
use crate::image::Image;

/// A way of using a resource: stages, accesses and, for images, the layout.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Access {
    pub stages: vk::PipelineStageFlags2,
    pub accesses: vk::AccessFlags2,
    /// Ignored for buffers.
    pub layout: vk::ImageLayout,
}

macro_rules! accesses {
    ($($(#[$doc:meta])* $name:ident = [$($stage:ident)|*] [$($access:ident)|*] $layout:ident;)*) => {
        impl Access {
            $($(#[$doc])* pub const $name: Self = Self {
                stages: vk::PipelineStageFlags2::from_raw(
                    0 $(| vk::PipelineStageFlags2::$stage.as_raw())*),
                accesses: vk::AccessFlags2::from_raw(
                    0 $(| vk::AccessFlags2::$access.as_raw())*),
                layout: vk::ImageLayout::$layout,
            };)*
        }
    };
}

accesses! {
    /// Nothing before: the contents are not wanted.
    NONE = [NONE] [NONE] UNDEFINED;
    TRANSFER_READ = [ALL_TRANSFER] [TRANSFER_READ] TRANSFER_SRC_OPTIMAL;
    TRANSFER_WRITE = [ALL_TRANSFER] [TRANSFER_WRITE] TRANSFER_DST_OPTIMAL;
    HOST_READ = [HOST] [HOST_READ] GENERAL;
    HOST_WRITE = [HOST] [HOST_WRITE] GENERAL;
    /// Storage images, and buffers through descriptors or addresses.
    COMPUTE_READ = [COMPUTE_SHADER] [SHADER_STORAGE_READ] GENERAL;
    COMPUTE_WRITE = [COMPUTE_SHADER] [SHADER_STORAGE_WRITE] GENERAL;
    COMPUTE_READ_WRITE = [COMPUTE_SHADER] [SHADER_STORAGE_READ | SHADER_STORAGE_WRITE] GENERAL;
    COMPUTE_SAMPLE = [COMPUTE_SHADER] [SHADER_SAMPLED_READ] SHADER_READ_ONLY_OPTIMAL;
    FRAGMENT_SAMPLE = [FRAGMENT_SHADER] [SHADER_SAMPLED_READ] SHADER_READ_ONLY_OPTIMAL;
    /// Any shader's sampled images.
    SAMPLE = [VERTEX_SHADER | FRAGMENT_SHADER | COMPUTE_SHADER] [SHADER_SAMPLED_READ]
        SHADER_READ_ONLY_OPTIMAL;
    /// Buffers that vertex and fragment shaders read through addresses.
    GRAPHICS_READ = [VERTEX_SHADER | FRAGMENT_SHADER] [SHADER_STORAGE_READ] GENERAL;
    FRAGMENT_READ_WRITE = [FRAGMENT_SHADER] [SHADER_STORAGE_READ | SHADER_STORAGE_WRITE] GENERAL;
    INDEX_READ = [INDEX_INPUT] [INDEX_READ] UNDEFINED;
    INDIRECT_READ = [DRAW_INDIRECT] [INDIRECT_COMMAND_READ] UNDEFINED;
    COLOR_ATTACHMENT = [COLOR_ATTACHMENT_OUTPUT] [COLOR_ATTACHMENT_READ | COLOR_ATTACHMENT_WRITE]
        COLOR_ATTACHMENT_OPTIMAL;
    DEPTH_ATTACHMENT = [EARLY_FRAGMENT_TESTS | LATE_FRAGMENT_TESTS]
        [DEPTH_STENCIL_ATTACHMENT_READ | DEPTH_STENCIL_ATTACHMENT_WRITE]
        DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    DEPTH_READ_ONLY = [EARLY_FRAGMENT_TESTS | LATE_FRAGMENT_TESTS]
        [DEPTH_STENCIL_ATTACHMENT_READ] DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    /// Storage that shaders of ray-tracing pipelines read and write.
    TRACE_READ_WRITE = [RAY_TRACING_SHADER_KHR] [SHADER_STORAGE_READ | SHADER_STORAGE_WRITE] GENERAL;
    /// Acceleration structures that rays go through.
    TRACE_STRUCTURE = [RAY_TRACING_SHADER_KHR] [ACCELERATION_STRUCTURE_READ_KHR] UNDEFINED;
    /// What structures are built from.
    BUILD_INPUT = [ACCELERATION_STRUCTURE_BUILD_KHR] [SHADER_READ] UNDEFINED;
    /// Structures that are built, and their scratch memory; structures that are read meanwhile.
    BUILD_STRUCTURE = [ACCELERATION_STRUCTURE_BUILD_KHR]
        [ACCELERATION_STRUCTURE_READ_KHR | ACCELERATION_STRUCTURE_WRITE_KHR] UNDEFINED;
    PRESENT = [NONE] [NONE] PRESENT_SRC_KHR;
    /// Everything, when nothing finer is known.
    ALL = [ALL_COMMANDS] [MEMORY_READ | MEMORY_WRITE] GENERAL;
}

impl Access {
    /// Both ways of using a resource, in this one's layout.
    pub const fn or(self, other: Self) -> Self {
        Self {
            stages: vk::PipelineStageFlags2::from_raw(self.stages.as_raw() | other.stages.as_raw()),
            accesses: vk::AccessFlags2::from_raw(self.accesses.as_raw() | other.accesses.as_raw()),
            layout: self.layout,
        }
    }

    /// The same use in another layout.
    pub const fn in_layout(self, layout: vk::ImageLayout) -> Self {
        Self { layout, ..self }
    }
}

/// A barrier for all memory. The layouts of `from` and `to` are ignored.
pub fn memory_barrier(from: Access, to: Access) -> vk::MemoryBarrier2<'static> {
    vk::MemoryBarrier2::default()
        .src_stage_mask(from.stages)
        .src_access_mask(from.accesses)
        .dst_stage_mask(to.stages)
        .dst_access_mask(to.accesses)
}

/// A barrier for a whole image, which it takes from one layout to the other.
pub fn image_barrier(image: &Image, from: Access, to: Access) -> vk::ImageMemoryBarrier2<'static> {
    image_barrier_of(image.raw(), image.whole_range(), from, to)
}

/// A barrier for a part of an image.
pub fn image_barrier_of(
    image: vk::Image,
    range: vk::ImageSubresourceRange,
    from: Access,
    to: Access,
) -> vk::ImageMemoryBarrier2<'static> {
    vk::ImageMemoryBarrier2::default()
        .image(image)
        .subresource_range(range)
        .src_stage_mask(from.stages)
        .src_access_mask(from.accesses)
        .old_layout(from.layout)
        .dst_stage_mask(to.stages)
        .dst_access_mask(to.accesses)
        .new_layout(to.layout)
        .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
}

impl Commands<'_> {
    /// Records barriers in one command; none if there are none.
    pub fn barriers(&self, memory: &[vk::MemoryBarrier2<'_>], images: &[vk::ImageMemoryBarrier2<'_>]) {
        if memory.is_empty() && images.is_empty() {
            return;
        }
        let info = vk::DependencyInfo::default().memory_barriers(memory).image_memory_barriers(images);
        // SAFETY: the buffer is being recorded; the barriers name images of this device.
        unsafe {
            match &self.shared.synchronization2 {
                Some(functions) => functions.cmd_pipeline_barrier2(self.raw(), &info),
                None => self.device().cmd_pipeline_barrier2(self.raw(), &info),
            }
        }
    }

    pub fn memory_barrier(&self, from: Access, to: Access) {
        self.barriers(&[memory_barrier(from, to)], &[]);
    }

    pub fn image_barrier(&self, image: &Image, from: Access, to: Access) {
        self.barriers(&[], &[image_barrier(image, from, to)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_access_is_the_union_of_its_parts() {
        assert_eq!(
            Access::DEPTH_READ_ONLY.stages,
            vk::PipelineStageFlags2::EARLY_FRAGMENT_TESTS | vk::PipelineStageFlags2::LATE_FRAGMENT_TESTS
        );
        let both = Access::COMPUTE_READ.or(Access::INDEX_READ);
        assert!(both.accesses.contains(vk::AccessFlags2::INDEX_READ));
        assert_eq!(both.layout, vk::ImageLayout::GENERAL);
    }
}
