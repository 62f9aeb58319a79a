//! The ways in which a pass can touch a resource.
//!
//! An access says where in the pipeline a resource is touched, whether it is written there, and
//! in which layout an image must be. Translating it to an API's stages and masks is the
//! executor's part, so the enum is plain and meant to be matched exhaustively.

use crate::{Format, Layout, ResourceDesc};

/// One way of touching a resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Access {
    /// Drawn into, blending included.
    ColorAttachment,
    /// Depth and stencil, tested and written.
    DepthAttachment,
    /// Depth and stencil, tested only.
    DepthRead,
    SampledFragment,
    SampledCompute,
    SampledTrace,
    /// Uniforms of vertex and fragment shaders.
    UniformGraphics,
    UniformCompute,
    UniformTrace,
    StorageReadVertex,
    StorageReadFragment,
    StorageReadCompute,
    StorageReadTrace,
    StorageWriteFragment,
    StorageWriteCompute,
    StorageWriteTrace,
    /// Vertex attributes fetched by the fixed function.
    VertexRead,
    IndexRead,
    /// Arguments of indirect draws, dispatches and traces.
    IndirectRead,
    /// Read by a build of acceleration structures: geometry, instances, lower levels.
    AccelerationInput,
    /// Written by a build of acceleration structures: the structure, and its scratch memory.
    AccelerationBuild,
    /// A structure traversed by rays of a ray-tracing pipeline.
    AccelerationTrace,
    TransferSrc,
    TransferDst,
    /// Copies from one part of a resource to another, such as a chain of mip levels. The pass
    /// itself orders the copies among each other.
    TransferWithin,
    HostRead,
    HostWrite,
    /// Shown in a window.
    Present,
}

/// Where in the pipeline an access happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StageClass {
    Indirect,
    VertexInput,
    Vertex,
    /// Vertex and fragment shaders together.
    Graphics,
    Fragment,
    /// Depth and stencil tests, before and after the fragment shader.
    Depth,
    /// Blending and writing of colour attachments.
    Color,
    Compute,
    /// Shaders of a ray-tracing pipeline.
    Trace,
    AccelerationBuild,
    Transfer,
    Host,
    Present,
}

impl Access {
    /// Every access, in the order of its declaration.
    pub const ALL: [Self; 28] = [
        Self::ColorAttachment,
        Self::DepthAttachment,
        Self::DepthRead,
        Self::SampledFragment,
        Self::SampledCompute,
        Self::SampledTrace,
        Self::UniformGraphics,
        Self::UniformCompute,
        Self::UniformTrace,
        Self::StorageReadVertex,
        Self::StorageReadFragment,
        Self::StorageReadCompute,
        Self::StorageReadTrace,
        Self::StorageWriteFragment,
        Self::StorageWriteCompute,
        Self::StorageWriteTrace,
        Self::VertexRead,
        Self::IndexRead,
        Self::IndirectRead,
        Self::AccelerationInput,
        Self::AccelerationBuild,
        Self::AccelerationTrace,
        Self::TransferSrc,
        Self::TransferDst,
        Self::TransferWithin,
        Self::HostRead,
        Self::HostWrite,
        Self::Present,
    ];

    /// Where in the pipeline the access happens.
    pub const fn stage(self) -> StageClass {
        match self {
            Self::ColorAttachment => StageClass::Color,
            Self::DepthAttachment | Self::DepthRead => StageClass::Depth,
            Self::SampledFragment | Self::StorageReadFragment | Self::StorageWriteFragment => {
                StageClass::Fragment
            }
            Self::SampledCompute
            | Self::UniformCompute
            | Self::StorageReadCompute
            | Self::StorageWriteCompute => StageClass::Compute,
            Self::SampledTrace
            | Self::UniformTrace
            | Self::StorageReadTrace
            | Self::StorageWriteTrace
            | Self::AccelerationTrace => StageClass::Trace,
            Self::UniformGraphics => StageClass::Graphics,
            Self::StorageReadVertex => StageClass::Vertex,
            Self::VertexRead | Self::IndexRead => StageClass::VertexInput,
            Self::IndirectRead => StageClass::Indirect,
            Self::AccelerationInput | Self::AccelerationBuild => StageClass::AccelerationBuild,
            Self::TransferSrc | Self::TransferDst | Self::TransferWithin => StageClass::Transfer,
            Self::HostRead | Self::HostWrite => StageClass::Host,
            Self::Present => StageClass::Present,
        }
    }

    /// Whether the access changes the resource.
    pub const fn writes(self) -> bool {
        matches!(
            self,
            Self::ColorAttachment
                | Self::DepthAttachment
                | Self::StorageWriteFragment
                | Self::StorageWriteCompute
                | Self::StorageWriteTrace
                | Self::AccelerationBuild
                | Self::TransferDst
                | Self::TransferWithin
                | Self::HostWrite
        )
    }

    /// The reading access that a pass performs as well when it modifies by this one, if that is
    /// another access: storage has a name for each, attachments one for both.
    pub const fn read_counterpart(self) -> Option<Self> {
        match self {
            Self::StorageWriteFragment => Some(Self::StorageReadFragment),
            Self::StorageWriteCompute => Some(Self::StorageReadCompute),
            Self::StorageWriteTrace => Some(Self::StorageReadTrace),
            _ => None,
        }
    }

    /// The layout in which an image must be; [`Layout::Undefined`] for accesses to buffers only.
    pub const fn layout(self) -> Layout {
        match self {
            Self::ColorAttachment => Layout::ColorAttachment,
            Self::DepthAttachment => Layout::DepthAttachment,
            Self::DepthRead => Layout::DepthRead,
            Self::SampledFragment | Self::SampledCompute | Self::SampledTrace => Layout::ShaderRead,
            Self::StorageReadVertex
            | Self::StorageReadFragment
            | Self::StorageReadCompute
            | Self::StorageReadTrace
            | Self::StorageWriteFragment
            | Self::StorageWriteCompute
            | Self::StorageWriteTrace
            | Self::TransferWithin => Layout::General,
            Self::TransferSrc => Layout::TransferSrc,
            Self::TransferDst => Layout::TransferDst,
            Self::Present => Layout::Present,
            Self::UniformGraphics
            | Self::UniformCompute
            | Self::UniformTrace
            | Self::VertexRead
            | Self::IndexRead
            | Self::IndirectRead
            | Self::AccelerationInput
            | Self::AccelerationBuild
            | Self::AccelerationTrace
            | Self::HostRead
            | Self::HostWrite => Layout::Undefined,
        }
    }

    /// Whether a resource of this description can be accessed so.
    pub const fn fits(self, desc: &ResourceDesc) -> bool {
        match desc {
            ResourceDesc::Image(image) => self.fits_image(image.format),
            ResourceDesc::Buffer { .. } => self.fits_buffer(),
        }
    }

    const fn fits_image(self, format: Format) -> bool {
        match self.layout() {
            Layout::Undefined => false,
            Layout::ColorAttachment | Layout::Present => !format.is_depth_stencil(),
            Layout::DepthAttachment | Layout::DepthRead => format.is_depth_stencil(),
            Layout::General | Layout::ShaderRead | Layout::TransferSrc | Layout::TransferDst => true,
        }
    }

    const fn fits_buffer(self) -> bool {
        matches!(
            self.layout(),
            Layout::Undefined | Layout::General | Layout::TransferSrc | Layout::TransferDst
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ImageDesc;

    #[test]
    fn all_lists_each_access_once_in_order() {
        for (index, access) in Access::ALL.iter().enumerate() {
            assert_eq!(*access as usize, index);
        }
        assert_eq!(Access::Present as usize + 1, Access::ALL.len());
    }

    #[test]
    fn read_counterparts_read_in_the_same_stage_and_layout() {
        for access in Access::ALL {
            if let Some(read) = access.read_counterpart() {
                assert!(access.writes() && !read.writes());
                assert_eq!(access.stage(), read.stage());
                assert_eq!(access.layout(), read.layout());
            }
        }
    }

    #[test]
    fn attachments_fit_images_of_their_aspect_only() {
        let color = ResourceDesc::from(ImageDesc::flat((4, 4), Format::Rgba8Unorm));
        let depth = ResourceDesc::from(ImageDesc::flat((4, 4), Format::D32Float));
        let buffer = ResourceDesc::Buffer { bytes: 64 };
        let fits = |access: Access| [color, depth, buffer].map(|desc| access.fits(&desc));
        assert_eq!(fits(Access::ColorAttachment), [true, false, false]);
        assert_eq!(fits(Access::DepthRead), [false, true, false]);
        assert_eq!(fits(Access::SampledFragment), [true, true, false]);
        assert_eq!(fits(Access::VertexRead), [false, false, true]);
        assert_eq!(fits(Access::TransferDst), [true, true, true]);
    }
}
