//! Primitive assembly: every mode becomes independent points, lines or triangles by index. A
//! triangle begins with the vertex whose colour holds for all of it when shading is flat
//! (specification 2.14.7); winding is kept.

use afterglow_api::constants::*;

/// How polygons are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PolygonMode {
    /// GL_FILL.
    Fill,
    /// GL_LINE: boundary edges whose flag is set.
    Line,
    /// GL_POINT: vertices whose flag is set.
    Point,
}

/// Whether glBegin takes `mode`.
pub fn is_mode(mode: u32) -> bool {
    mode <= GL_POLYGON
}

/// How many indices `count` vertices sent as `mode` become, if those of fewer vertices are the first of them.
pub fn index_count(mode: u32, count: usize) -> Option<usize> {
    Some(match mode {
        GL_POINTS => count,
        GL_LINES => count & !1,
        GL_LINE_STRIP => 2 * count.saturating_sub(1),
        GL_TRIANGLES => count / 3 * 3,
        GL_TRIANGLE_STRIP | GL_TRIANGLE_FAN | GL_POLYGON => 3 * count.saturating_sub(2),
        GL_QUADS => count / 4 * 6,
        GL_QUAD_STRIP => count.saturating_sub(2) / 2 * 6,
        _ => return None,
    })
}

/// Appends the indices of `count` vertices sent as `mode`; `vertex(i)` is the index of the i-th.
pub fn assemble(mode: u32, count: usize, vertex: impl Fn(usize) -> u32, out: &mut Vec<u32>) {
    let v = vertex;
    match mode {
        GL_POINTS => out.extend((0..count).map(v)),
        GL_LINES => out.extend((0..count & !1).map(v)),
        GL_LINE_STRIP | GL_LINE_LOOP => {
            for i in 1..count {
                out.extend([v(i - 1), v(i)]);
            }
            if mode == GL_LINE_LOOP && count > 1 {
                out.extend([v(count - 1), v(0)]);
            }
        }
        GL_TRIANGLES => {
            for i in (0..count.saturating_sub(2)).step_by(3) {
                out.extend([v(i + 2), v(i), v(i + 1)]);
            }
        }
        GL_TRIANGLE_STRIP => {
            for i in 0..count.saturating_sub(2) {
                let (a, b) = if i % 2 == 0 { (i, i + 1) } else { (i + 1, i) };
                out.extend([v(i + 2), v(a), v(b)]);
            }
        }
        GL_TRIANGLE_FAN => {
            for i in 1..count.saturating_sub(1) {
                out.extend([v(i + 1), v(0), v(i)]);
            }
        }
        GL_QUADS => {
            for i in (0..count.saturating_sub(3)).step_by(4) {
                out.extend([v(i + 3), v(i), v(i + 1), v(i + 3), v(i + 1), v(i + 2)]);
            }
        }
        GL_QUAD_STRIP => {
            for i in (0..count.saturating_sub(3)).step_by(2) {
                let provoking = v(i + 3);
                out.extend([provoking, v(i + 2), v(i), provoking, v(i), v(i + 1)]);
            }
        }
        _ => {
            for i in 1..count.saturating_sub(1) {
                out.extend([v(0), v(i), v(i + 1)]);
            }
        }
    }
}

/// Appends the boundary of polygons as lines, or their vertices as points, where `edge(i)` says that
/// the edge that starts at vertex i is a boundary. Only separate polygons heed the flags.
pub fn assemble_unfilled(
    mode: u32,
    count: usize,
    polygon_mode: PolygonMode,
    vertex: impl Fn(usize) -> u32,
    edge: impl Fn(usize) -> bool,
    out: &mut Vec<u32>,
) {
    let mut ring = |corners: &[usize], flags: bool| {
        for (i, &corner) in corners.iter().enumerate() {
            if flags && !edge(corner) {
                continue;
            }
            out.push(vertex(corner));
            if polygon_mode == PolygonMode::Line {
                out.push(vertex(corners[(i + 1) % corners.len()]));
            }
        }
    };
    match mode {
        GL_TRIANGLES => (0..count / 3).for_each(|i| ring(&[3 * i, 3 * i + 1, 3 * i + 2], true)),
        GL_QUADS => (0..count / 4).for_each(|i| ring(&[4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3], true)),
        GL_TRIANGLE_STRIP => (2..count).for_each(|i| ring(&[i - 2, i - 1, i], false)),
        GL_TRIANGLE_FAN => (2..count).for_each(|i| ring(&[0, i - 1, i], false)),
        GL_QUAD_STRIP => (0..count.saturating_sub(2) / 2)
            .for_each(|i| ring(&[2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2], false)),
        _ => ring(&(0..count).collect::<Vec<_>>(), true),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_indices_of_fewer_vertices_come_first() {
        for mode in (GL_POINTS..=GL_POLYGON).filter(|mode| *mode != GL_LINE_LOOP) {
            let indices = |count| {
                let mut out = Vec::new();
                assemble(mode, count, |i| i as u32, &mut out);
                out
            };
            for count in 0..13 {
                let own = indices(count);
                assert_eq!(index_count(mode, count), Some(own.len()), "mode {mode}, {count} vertices");
                assert_eq!(indices(14)[..own.len()], own, "mode {mode}, {count} vertices");
            }
        }
        assert_eq!(index_count(GL_LINE_LOOP, 3), None);
    }

    fn indices(mode: u32, count: usize) -> Vec<u32> {
        let mut out = Vec::new();
        assemble(mode, count, |i| i as u32, &mut out);
        out
    }

    #[test]
    fn strips_keep_winding_and_begin_with_the_provoking_vertex() {
        assert_eq!(indices(GL_TRIANGLE_STRIP, 4), [2, 0, 1, 3, 2, 1]);
        assert_eq!(indices(GL_TRIANGLE_FAN, 4), [2, 0, 1, 3, 0, 2]);
        assert_eq!(indices(GL_QUADS, 4), [3, 0, 1, 3, 1, 2]);
        assert_eq!(indices(GL_QUAD_STRIP, 4), [3, 2, 0, 3, 0, 1]);
        assert_eq!(indices(GL_POLYGON, 4), [0, 1, 2, 0, 2, 3]);
    }

    #[test]
    fn incomplete_primitives_are_dropped() {
        for mode in GL_POINTS..=GL_POLYGON {
            for count in 0..4 {
                assert!(indices(mode, count).iter().all(|&i| (i as usize) < count), "{mode} {count}");
            }
        }
        assert_eq!(indices(GL_LINES, 3), [0, 1]);
        assert_eq!(indices(GL_TRIANGLES, 5), [2, 0, 1]);
        assert_eq!(indices(GL_QUADS, 7).len(), 6);
        assert_eq!(indices(GL_QUAD_STRIP, 5).len(), 6);
    }

    #[test]
    fn edge_flags_open_the_boundary() {
        let mut out = Vec::new();
        assemble_unfilled(GL_QUADS, 4, PolygonMode::Line, |i| i as u32, |i| i != 1, &mut out);
        assert_eq!(out, [0, 1, 2, 3, 3, 0]);
    }
}
