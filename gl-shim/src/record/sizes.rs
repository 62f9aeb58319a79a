//! How much of the program's memory a command reads or writes.

use afterglow_api::Length;
use afterglow_api::constants::*;
use afterglow_gl::texture::MAX_SIZE;
use afterglow_gl::{Context, Extent, parameter_values};

/// Values that glGet and the like give for a parameter; at most as many as they write.
pub fn values_of(pname: u32) -> usize {
    match pname {
        GL_MODELVIEW_MATRIX
        | GL_PROJECTION_MATRIX
        | GL_TEXTURE_MATRIX
        | GL_TRANSPOSE_MODELVIEW_MATRIX
        | GL_TRANSPOSE_PROJECTION_MATRIX
        | GL_TRANSPOSE_TEXTURE_MATRIX => 16,
        GL_VIEWPORT
        | GL_SCISSOR_BOX
        | GL_COLOR_CLEAR_VALUE
        | GL_ACCUM_CLEAR_VALUE
        | GL_COLOR_WRITEMASK
        | GL_BLEND_COLOR
        | GL_CURRENT_COLOR
        | GL_CURRENT_SECONDARY_COLOR
        | GL_CURRENT_TEXTURE_COORDS
        | GL_CURRENT_RASTER_COLOR
        | GL_CURRENT_RASTER_POSITION
        | GL_CURRENT_RASTER_TEXTURE_COORDS => 4,
        GL_CURRENT_NORMAL => 3,
        GL_DEPTH_RANGE
        | GL_MAX_VIEWPORT_DIMS
        | GL_POLYGON_MODE
        | GL_POINT_SIZE_RANGE
        | GL_LINE_WIDTH_RANGE
        | GL_ALIASED_POINT_SIZE_RANGE
        | GL_ALIASED_LINE_WIDTH_RANGE => 2,
        _ => parameter_values(pname),
    }
}

/// Elements of an array.
pub fn elements(length: Length, arguments: &[u64]) -> usize {
    match length {
        Length::Count(count) => count.into(),
        Length::Param(count) => natural(arguments[usize::from(count)]),
        Length::Product(count, factor) => {
            natural(arguments[usize::from(count)]).saturating_mul(factor.into())
        }
        Length::Unknown | Length::Computed(_) => 0,
    }
}

/// A count; none if it is negative.
pub fn natural(bits: u64) -> usize {
    usize::try_from(bits as i64).unwrap_or(0)
}

/// Numbers of an evaluator's control points: of target, and for each dimension two bounds, stride and order.
pub fn points(dimensions: usize, arguments: &[u64]) -> usize {
    let components = match arguments[0] as u32 {
        GL_MAP1_INDEX | GL_MAP2_INDEX | GL_MAP1_TEXTURE_COORD_1 | GL_MAP2_TEXTURE_COORD_1 => 1,
        GL_MAP1_TEXTURE_COORD_2 | GL_MAP2_TEXTURE_COORD_2 => 2,
        GL_MAP1_COLOR_4 | GL_MAP2_COLOR_4 | GL_MAP1_VERTEX_4 | GL_MAP2_VERTEX_4 => 4,
        GL_MAP1_TEXTURE_COORD_4 | GL_MAP2_TEXTURE_COORD_4 => 4,
        GL_MAP1_VERTEX_3 | GL_MAP2_VERTEX_3 | GL_MAP1_NORMAL | GL_MAP2_NORMAL => 3,
        GL_MAP1_TEXTURE_COORD_3 | GL_MAP2_TEXTURE_COORD_3 => 3,
        _ => return 0,
    };
    let gaps = |dimension: usize| {
        let stride = natural(arguments[3 + 4 * dimension]);
        natural(arguments[4 + 4 * dimension]).saturating_sub(1).saturating_mul(stride)
    };
    (0..dimensions).map(gaps).fold(components, usize::saturating_add)
}

/// Bytes of an image, whose format, type and sizes are the arguments at these positions; `None` if it is in error, or
/// if the command reads nothing.
pub fn image(gl: &Context, of: &[u8], arguments: &[u64]) -> Option<usize> {
    let [format, kind, sizes @ ..] = of else { return None };
    let argument = |position: &u8| arguments[usize::from(*position)];
    let is_proxy = matches!(
        arguments[0] as u32,
        GL_PROXY_TEXTURE_1D
            | GL_PROXY_TEXTURE_2D
            | GL_PROXY_TEXTURE_3D
            | GL_PROXY_TEXTURE_CUBE_MAP
            | GL_PROXY_TEXTURE_RECTANGLE_ARB
    );
    if is_proxy {
        return None;
    }
    let extent = extent(sizes.iter().map(argument))?;
    gl.pixel_image_size(extent, argument(format) as u32, argument(kind) as u32, false)
}

/// Bytes of a bitmap whose sizes are the arguments at these positions.
pub fn bitmap(gl: &Context, of: &[u8], arguments: &[u64]) -> Option<usize> {
    let extent = extent(of.iter().map(|position| arguments[usize::from(*position)]))?;
    gl.pixel_image_size(extent, GL_COLOR_INDEX, GL_BITMAP, false)
}

fn extent(sizes: impl Iterator<Item = u64>) -> Option<Extent> {
    // A border adds two; glDrawPixels knows no bound, but no image that is drawn is larger.
    let side = |bits: u64| usize::try_from(bits as i64).ok().filter(|side| *side <= 4 * MAX_SIZE);
    let sides: Option<Vec<usize>> = sizes.map(side).collect();
    match *sides? {
        [width] => Some(Extent::plane(width, 1)),
        [width, height] => Some(Extent::plane(width, height)),
        [width, height, depth] => Some(Extent::volume(width, height, depth)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_points_end_with_the_last_component() {
        let [from, to] = [0.0f64.to_bits(), 1.0f64.to_bits()];
        assert_eq!(points(1, &[GL_MAP1_VERTEX_3.into(), from, to, 5, 4]), 18);
        let surface = [GL_MAP2_COLOR_4.into(), from, to, 4, 2, from, to, 8, 3];
        assert_eq!(points(2, &surface), 4 + 16 + 4);
        assert_eq!(points(1, &[GL_LIGHTING.into(), from, to, 5, 4]), 0);
        assert_eq!(points(1, &[GL_MAP1_INDEX.into(), from, to, 5, -4i64 as u64]), 1);
    }

    #[test]
    fn negative_counts_are_none() {
        assert_eq!(elements(Length::Param(0), &[-1i64 as u64]), 0);
        assert_eq!(elements(Length::Product(0, 2), &[3]), 6);
    }
}
