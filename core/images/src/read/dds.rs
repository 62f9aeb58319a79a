//! DDS by the `ddsfile` crate (Microsoft, Programming Guide for DDS).

use ddsfile::{Caps2, D3DFormat, Dds, DxgiFormat, MiscFlag};

use super::stored::{Layout, Stored};
use crate::error::ImageError;
use crate::picture::check_size;

/// Reads a two-dimensional picture. Which of UNORM and SRGB a format is makes no difference: texels stay as they are.
pub(super) fn read(bytes: &[u8]) -> Result<Stored, ImageError> {
    let dds = Dds::read(bytes).map_err(ImageError::damaged)?;
    let size = [dds.get_width(), dds.get_height()];
    check_size(size[0], size[1])?;
    let extended = dds.header10.as_ref();
    let is_cube = dds.header.caps2.contains(Caps2::CUBEMAP)
        || extended.is_some_and(|header| header.misc_flag.contains(MiscFlag::TEXTURECUBE));
    match () {
        () if is_cube => return Err(ImageError::Kind("cube maps")),
        () if dds.get_depth() > 1 => return Err(ImageError::Kind("three-dimensional pictures")),
        () if extended.is_some_and(|header| header.array_size > 1) => {
            return Err(ImageError::Kind("arrays of pictures"));
        }
        () => {}
    }
    let layout = match (dds.get_dxgi_format(), dds.get_d3d_format()) {
        (Some(format), _) => of_dxgi(format).ok_or_else(|| ImageError::Format(format!("{format:?}")))?,
        (None, Some(format)) => of_d3d(format).ok_or_else(|| ImageError::Format(format!("{format:?}")))?,
        (None, None) => return Err(ImageError::Format("that nothing names".into())),
    };
    Stored::cut(layout, size, dds.get_num_mipmap_levels(), &dds.data)
}

fn of_dxgi(format: DxgiFormat) -> Option<Layout> {
    use DxgiFormat as F;
    Some(match format {
        F::R8_UNorm => Layout::R8,
        F::R8G8_UNorm => Layout::Rg8,
        F::R8G8B8A8_UNorm | F::R8G8B8A8_UNorm_sRGB | F::R8G8B8A8_Typeless => Layout::Rgba8,
        F::B8G8R8A8_UNorm | F::B8G8R8A8_UNorm_sRGB | F::B8G8R8A8_Typeless => Layout::Bgra8,
        F::B8G8R8X8_UNorm | F::B8G8R8X8_UNorm_sRGB | F::B8G8R8X8_Typeless => Layout::Bgrx8,
        // Nothing in a DDS file says whether the bit of alpha is used.
        F::BC1_UNorm | F::BC1_UNorm_sRGB | F::BC1_Typeless => Layout::Bc1Alpha,
        F::BC2_UNorm | F::BC2_UNorm_sRGB | F::BC2_Typeless => Layout::Bc2,
        F::BC3_UNorm | F::BC3_UNorm_sRGB | F::BC3_Typeless => Layout::Bc3,
        F::BC4_UNorm | F::BC4_Typeless => Layout::Bc4,
        F::BC5_UNorm | F::BC5_Typeless => Layout::Bc5,
        F::BC6H_UF16 | F::BC6H_Typeless => Layout::Bc6h { is_signed: false },
        F::BC6H_SF16 => Layout::Bc6h { is_signed: true },
        F::BC7_UNorm | F::BC7_UNorm_sRGB | F::BC7_Typeless => Layout::Bc7,
        _ => return None,
    })
}

/// Names of Direct3D's older formats begin with the highest byte.
fn of_d3d(format: D3DFormat) -> Option<Layout> {
    Some(match format {
        D3DFormat::A8R8G8B8 => Layout::Bgra8,
        D3DFormat::X8R8G8B8 => Layout::Bgrx8,
        D3DFormat::A8B8G8R8 => Layout::Rgba8,
        D3DFormat::X8B8G8R8 => Layout::Rgbx8,
        D3DFormat::R8G8B8 => Layout::Bgr8,
        D3DFormat::L8 => Layout::R8,
        _ => return None,
    })
}
