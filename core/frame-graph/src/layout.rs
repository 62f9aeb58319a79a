//! How an image lies in memory: what the device may have to convert between two kinds of access.

/// The arrangement of an image's texels that an access asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Layout {
    /// Nothing known: contents are lost. Buffers, which have no layout, always carry this one.
    #[default]
    Undefined,
    /// Serves every access: storage, and copies within one image.
    General,
    ColorAttachment,
    DepthAttachment,
    /// Depth that is tested against, and may be sampled at the same time, but not written.
    DepthRead,
    ShaderRead,
    TransferSrc,
    TransferDst,
    Present,
}

impl Layout {
    /// The layout that serves both, if one does.
    pub const fn join(self, other: Self) -> Option<Self> {
        match (self, other) {
            (Self::DepthRead, Self::ShaderRead) | (Self::ShaderRead, Self::DepthRead) => {
                Some(Self::DepthRead)
            }
            _ if self as u8 == other as u8 => Some(self),
            _ => None,
        }
    }
}
