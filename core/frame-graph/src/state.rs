//! What was last done to a resource: where one frame ends and the next begins.

use crate::{AccessSet, Layout, ResourceDesc};

/// The accesses that a later one must wait for, and whether there is anything to read.
///
/// [`crate::CompiledGraph::final_state`] returns the state in which a frame leaves a resource;
/// importing the resource with that state into the next frame orders the two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResourceState {
    accesses: AccessSet,
    defined: bool,
}

impl ResourceState {
    /// Fresh memory: nothing to wait for and nothing to read.
    pub const UNDEFINED: Self = Self { accesses: AccessSet::EMPTY, defined: false };

    /// A buffer whose contents every access can see already, such as one filled by the host
    /// before the frame was submitted. Not for images, which are always in some layout.
    pub const SETTLED: Self = Self { accesses: AccessSet::EMPTY, defined: true };

    /// Written, or read since it was written, by `accesses`.
    pub fn after(accesses: impl Into<AccessSet>) -> Self {
        Self { accesses: accesses.into(), defined: true }
    }

    /// Without contents, yet still in use by `accesses`, such as an image just acquired from a
    /// window.
    pub fn undefined_after(accesses: impl Into<AccessSet>) -> Self {
        Self { accesses: accesses.into(), defined: false }
    }

    /// The accesses to wait for.
    pub const fn accesses(self) -> AccessSet {
        self.accesses
    }

    /// Whether the resource holds anything worth reading.
    pub const fn is_defined(self) -> bool {
        self.defined
    }

    /// The layout in which a resource of this description is; none if no such state can be.
    pub fn layout(self, desc: &ResourceDesc) -> Option<Layout> {
        let fits = self.accesses.iter().all(|access| access.fits(desc));
        let layout = match desc {
            ResourceDesc::Image(_) if self.defined => {
                self.accesses.layout().filter(|layout| *layout != Layout::Undefined)
            }
            ResourceDesc::Image(_) | ResourceDesc::Buffer { .. } => Some(Layout::Undefined),
        };
        layout.filter(|_| fits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Access, Format, ImageDesc};

    #[test]
    fn images_need_one_layout_to_be_defined() {
        let image = ImageDesc::flat((2, 2), Format::Rgba8Unorm).into();
        let layout = |state: ResourceState| state.layout(&image);
        assert_eq!(layout(ResourceState::UNDEFINED), Some(Layout::Undefined));
        assert_eq!(layout(ResourceState::SETTLED), None);
        assert_eq!(layout(ResourceState::after(Access::Present)), Some(Layout::Present));
        assert_eq!(layout(ResourceState::after(Access::VertexRead)), None);
    }

    #[test]
    fn buffers_have_no_layout() {
        let buffer = ResourceDesc::Buffer { bytes: 4 };
        let both = [Access::TransferDst, Access::VertexRead].into_iter();
        let state = ResourceState::after(both.collect::<AccessSet>());
        assert_eq!(state.layout(&buffer), Some(Layout::Undefined));
        assert_eq!(ResourceState::after(Access::Present).layout(&buffer), None);
    }
}
