//! Closed and flat shapes as lists of triangles, their fronts outside.

use glam::Vec3;

/// Three corners, counter-clockwise as seen from the front.
pub type Triangle = [Vec3; 3];

/// A parallelogram from one corner and its two edges; the front is where `edge_1` x `edge_2` points.
pub fn quad(corner: Vec3, edge_1: Vec3, edge_2: Vec3) -> Vec<Triangle> {
    let [b, c, d] = [corner + edge_1, corner + edge_1 + edge_2, corner + edge_2];
    vec![[corner, b, c], [corner, c, d]]
}

/// A cube about a middle; `half` is half its side. Turned inside out where `half` is negative.
pub fn cube(middle: Vec3, half: f32) -> Vec<Triangle> {
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    let side = |axis: usize, sign: f32| {
        let (across, along) = (axes[(axis + 1) % 3] * half.abs(), axes[(axis + 2) % 3] * half);
        let across = across * sign;
        quad(middle + axes[axis] * (sign * half.abs()) - across - along, 2.0 * across, 2.0 * along)
    };
    (0..3).flat_map(|axis| [side(axis, 1.0), side(axis, -1.0)]).flatten().collect()
}

/// An icosahedron whose triangles are halved along each side so many times, on a sphere.
pub fn icosphere(middle: Vec3, radius: f32, halvings: u32) -> Vec<Triangle> {
    let golden = (1.0 + 5.0_f32.sqrt()) / 2.0;
    let rectangle = |turned: fn(f32, f32) -> Vec3| {
        [turned(1.0, golden), turned(-1.0, golden), turned(1.0, -golden), turned(-1.0, -golden)]
    };
    let corners = [
        rectangle(|a, b| Vec3::new(0.0, a, b)),
        rectangle(|a, b| Vec3::new(a, b, 0.0)),
        rectangle(|a, b| Vec3::new(b, 0.0, a)),
    ]
    .concat();
    let mut triangles = Vec::new();
    let is_edge = |a: Vec3, b: Vec3| (a.distance(b) - 2.0).abs() < 1e-3;
    for (i, &a) in corners.iter().enumerate() {
        for (j, &b) in corners.iter().enumerate().skip(i + 1) {
            for &c in corners.iter().skip(j + 1).filter(|&&c| is_edge(a, b) && is_edge(b, c) && is_edge(a, c))
            {
                let is_outward = (b - a).cross(c - a).dot(a) > 0.0;
                triangles.push(if is_outward { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    for _ in 0..halvings {
        triangles = triangles.into_iter().flat_map(quarters).collect();
    }
    let placed = |corner: Vec3| middle + corner.normalize() * radius;
    triangles.into_iter().map(|triangle| triangle.map(placed)).collect()
}

fn quarters([a, b, c]: Triangle) -> [Triangle; 4] {
    let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(a, b)| a.normalize().midpoint(b.normalize()));
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The volume that the fronts surround.
    fn volume(triangles: &[Triangle]) -> f32 {
        triangles.iter().map(|[a, b, c]| a.dot(b.cross(*c)) / 6.0).sum()
    }

    #[test]
    fn shapes_are_closed_and_their_fronts_outside() {
        assert!((volume(&cube(Vec3::ZERO, 0.5)) - 1.0).abs() < 1e-5);
        assert!((volume(&cube(Vec3::ZERO, -0.5)) + 1.0).abs() < 1e-5);
        let sphere = icosphere(Vec3::ZERO, 1.0, 3);
        assert_eq!(sphere.len(), 20 * 64);
        assert!((volume(&sphere) - 4.19).abs() < 0.05);
    }
}
