//! A closed room of any number of triangles, for tests and measurements: no ray leaves it.

use glam::Vec3;

/// Positions, and three of them a triangle.
pub type Mesh = (Vec<[f32; 3]>, Vec<[u32; 3]>);

/// A box seen from inside, walls of `cells` x `cells` x 2 triangles with relief, and boxes within:
/// about 21 `cells`^2 triangles, 9 of them the boxes'. 20 across, around the origin.
pub fn room(cells: u32) -> Mesh {
    let mut mesh = (Vec::new(), Vec::new());
    for axis in 0..3 {
        for side in [-1.0f32, 1.0] {
            wall(&mut mesh, cells, axis, side, Vec3::ZERO, 10.0, 0.3);
            for (x, z) in [(-4.0, -3.0), (3.5, 2.0), (0.5, 6.0)] {
                let centre = Vec3::new(x, -6.0, z);
                wall(&mut mesh, cells / 2 + 1, axis, side, centre, 2.0, 0.1);
            }
        }
    }
    mesh
}

/// A square of 2 `half` around `centre` + `side` * `half` along `axis`, bumps of height `relief`.
fn wall(mesh: &mut Mesh, cells: u32, axis: usize, side: f32, centre: Vec3, half: f32, relief: f32) {
    let first = mesh.0.len() as u32;
    for j in 0..=cells {
        for i in 0..=cells {
            let (u, v) = (i as f32 / cells as f32, j as f32 / cells as f32);
            let rim = i == 0 || j == 0 || i == cells || j == cells;
            let bump = (u * 23.0).sin() * (v * 19.0).cos() * relief;
            let height = if rim { 0.0 } else { bump };
            let mut at = Vec3::ZERO;
            at[axis] = side * (half + height);
            at[(axis + 1) % 3] = (u * 2.0 - 1.0) * half;
            at[(axis + 2) % 3] = (v * 2.0 - 1.0) * half;
            mesh.0.push((at + centre).to_array());
        }
    }
    for j in 0..cells {
        for i in 0..cells {
            let corner = first + j * (cells + 1) + i;
            let above = corner + cells + 1;
            mesh.1.push([corner, corner + 1, above + 1]);
            mesh.1.push([corner, above + 1, above]);
        }
    }
}
