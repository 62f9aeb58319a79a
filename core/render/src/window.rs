//! OpenGL's window coordinates, from the lower left corner, as rows counted from the top.

use afterglow_gl::frame::{ImageCopy, Rect, Region, Viewport};
use afterglow_gpu::vk;

/// The part of a rectangle that lies in a window of this size; none if that is empty.
pub(crate) fn clip(rect: &Rect, [width, height]: [u32; 2]) -> Option<Rect> {
    let span = |start: i32, length: i32, limit: u32| {
        let end = i64::from(start) + i64::from(length.max(0));
        let first = i64::from(start).max(0);
        let last = end.min(i64::from(limit));
        // Both lie within the window, whose sides fit an i32.
        (first < last).then_some((first as i32, (last - first) as i32))
    };
    let (x, width) = span(rect.x, rect.width, width)?;
    let (y, height) = span(rect.y, rect.height, height)?;
    Some(Rect { x, y, width, height })
}

/// A rectangle that was clipped to the window, with its upper left corner counted from the top.
pub(crate) fn from_top(clipped: &Rect, [_, height]: [u32; 2]) -> vk::Rect2D {
    vk::Rect2D {
        offset: vk::Offset2D { x: clipped.x, y: height as i32 - clipped.y - clipped.height },
        extent: vk::Extent2D { width: clipped.width as u32, height: clipped.height as u32 },
    }
}

/// All of a window.
pub(crate) fn whole([width, height]: [u32; 2]) -> vk::Rect2D {
    vk::Rect2D { offset: vk::Offset2D::default(), extent: vk::Extent2D { width, height } }
}

/// Whether a scissor leaves all of the window.
pub(crate) fn covers(scissor: Option<&Rect>, size: [u32; 2]) -> bool {
    scissor.is_none_or(|scissor| {
        clip(scissor, size).is_some_and(|clipped| [clipped.width as u32, clipped.height as u32] == size)
    })
}

/// The scissor, or the window where there is none. What lies outside has no pixels.
pub(crate) fn scissor(scissor: Option<&Rect>, size: [u32; 2]) -> vk::Rect2D {
    match scissor {
        None => whole(size),
        Some(rect) => clip(rect, size).map_or_else(vk::Rect2D::default, |rect| from_top(&rect, size)),
    }
}

/// A viewport of negative height, which turns OpenGL's upward y into rows from the top. None if it is empty or
/// larger than the device allows.
pub(crate) fn viewport(
    viewport: &Viewport,
    [_, height]: [u32; 2],
    limits: &vk::PhysicalDeviceLimits,
) -> Option<vk::Viewport> {
    let rect = &viewport.rect;
    let [most_width, most_height] = limits.max_viewport_dimensions;
    let [least, most] = limits.viewport_bounds_range;
    let fits = |start: f32, end: f32| start.min(end) >= least && start.max(end) <= most;
    let result = vk::Viewport {
        x: rect.x as f32,
        y: height as f32 - rect.y as f32,
        width: rect.width as f32,
        height: -(rect.height as f32),
        min_depth: viewport.depth_range[0].clamp(0.0, 1.0),
        max_depth: viewport.depth_range[1].clamp(0.0, 1.0),
    };
    let is_usable = (1..=i64::from(most_width)).contains(&i64::from(rect.width))
        && (1..=i64::from(most_height)).contains(&i64::from(rect.height))
        && fits(result.x, result.x + result.width)
        && fits(result.y, result.y + result.height);
    is_usable.then_some(result)
}

/// The viewport for lines and points: 1/256 pixel lower. Lines that run exactly between two rows of pixels are
/// common (interfaces drawn at whole coordinates), and OpenGL, whose y goes up, gives them to the lower row where
/// Vulkan would give them to the upper.
pub(crate) fn for_thin(viewport: vk::Viewport) -> vk::Viewport {
    vk::Viewport { y: viewport.y + 1.0 / 256.0, ..viewport }
}

/// The viewport in which window coordinates are drawn, with depth as it is.
pub(crate) fn window_viewport(size: [u32; 2]) -> vk::Viewport {
    let [width, height] = size.map(|side| side as f32);
    vk::Viewport { x: 0.0, y: height, width, height: -height, min_depth: 0.0, max_depth: 1.0 }
}

/// The part of a copy to a texture whose source lies in the window: where it goes, and from where. If the region has
/// another size than the source, its edges are rounded to whole texels.
pub(crate) fn clip_copy(copy: &ImageCopy, size: [u32; 2]) -> Option<(Region, vk::Rect2D)> {
    let source = &copy.source;
    let clipped = clip(source, size)?;
    let [width, height, _] = copy.region.extent;
    let (x, width) = clipped_texels(width, (source.x, source.width), (clipped.x, clipped.width))?;
    let (y, height) = clipped_texels(height, (source.y, source.height), (clipped.y, clipped.height))?;
    let [left, lowest, z] = copy.region.offset;
    let region = Region {
        offset: [left.checked_add(x)?, lowest.checked_add(y)?, z],
        extent: [width, height, 1],
        ..copy.region
    };
    Some((region, from_top(&clipped, size)))
}

/// First texel and number of texels that the clipped part of a source becomes, of `texels` that the source becomes.
/// None if there are none. Start and length are given of both; the clipped part is not empty.
fn clipped_texels(texels: u32, source: (i32, i32), clipped: (i32, i32)) -> Option<(u32, u32)> {
    let length = i128::from(source.1);
    let texel = |pixel: i64| {
        let before = i128::from(pixel) - i128::from(source.0);
        // At most `texels`, since the pixel lies in the source.
        ((before * i128::from(texels) * 2 + length) / (length * 2)) as u32
    };
    let first = texel(clipped.0.into());
    let last = texel(i64::from(clipped.0) + i64::from(clipped.1));
    (first < last).then_some((first, last - first))
}

#[cfg(test)]
mod tests {
    use super::*;
    use afterglow_gl::frame::{BaseFormat, ImageKey};

    fn rect(x: i32, y: i32, width: i32, height: i32) -> Rect {
        Rect { x, y, width, height }
    }

    #[test]
    fn rectangles_are_clipped_and_counted_from_the_top() {
        let size = [10, 8];
        assert_eq!(clip(&rect(-2, 6, 5, 5), size), Some(rect(0, 6, 3, 2)));
        assert_eq!(clip(&rect(10, 0, 5, 5), size), None);
        assert_eq!(clip(&rect(0, 0, -1, 5), size), None);
        assert_eq!(clip(&rect(i32::MAX, i32::MIN, i32::MAX, i32::MAX), size), None);
        let top = from_top(&rect(0, 6, 3, 2), size);
        assert_eq!((top.offset.y, top.extent.height), (0, 2));
        assert!(covers(Some(&rect(-1, -1, 100, 100)), size));
        assert!(!covers(Some(&rect(1, 0, 100, 100)), size));
        assert_eq!(scissor(Some(&rect(20, 20, 1, 1)), size).extent.width, 0);
    }

    #[test]
    fn a_copy_loses_what_lies_outside_the_window() {
        let copy = ImageCopy {
            image: ImageKey::unique(),
            region: Region { level: 0, layer: 0, offset: [1, 1, 0], extent: [4, 4, 1] },
            source: rect(-1, 6, 4, 4),
            base_format: BaseFormat::Rgb,
        };
        let (region, source) = clip_copy(&copy, [10, 8]).unwrap();
        assert_eq!((region.offset, region.extent), ([2, 1, 0], [3, 2, 1]));
        assert_eq!((source.offset.x, source.offset.y), (0, 0));
        assert!(clip_copy(&copy, [10, 6]).is_none());
        let scaled = ImageCopy { source: rect(-2, 6, 8, 2), ..copy };
        let (region, source) = clip_copy(&scaled, [10, 7]).unwrap();
        assert_eq!((region.offset, region.extent), ([2, 1, 0], [3, 2, 1]));
        assert_eq!((source.extent.width, source.extent.height), (6, 1));
    }
}
