//! Shadows in the stencil: the room, then the volumes that its things keep from the lamp, counted up where they are
//! entered and down where they are left, then a dark sheet over what is inside. Marks on the walls are drawn with an
//! offset of depth.

use afterglow_api::constants::*;
use afterglow_api::id;
use afterglow_scene::Class;
use glam::{Affine3A, DMat4, DVec3, Mat4, Vec2, Vec3};

use crate::client::{Attributes, Client, Texture, WINDOW, thing};
use crate::kit::{Hall, Mesh, Picture, Vertex, boxed, draw_hud, ortho, perspective, walk};
use crate::truth::{TrueCamera, TrueLightShape};

/// A room with blocks that turn and keep the light away.
pub struct ShadowVolumes {
    walls: Mesh,
    floor: Mesh,
    block: Mesh,
    marks: Vec<Mesh>,
    centre: DVec3,
    bricks: Texture,
    boards: Texture,
    scorch: Texture,
}

const BLOCKS: u32 = 5;
const LAMP: Vec3 = Vec3::new(8.0, 3.8, 8.0);

impl ShadowVolumes {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> ShadowVolumes {
        let hall = Hall::new([4, 4], 1);
        gl.set_extent(hall.extent());
        let (mut walls, mut floor) = (Mesh::default(), Mesh::default());
        for cell in &hall.cells {
            walls.append(&cell.walls);
            floor.append(&cell.floors);
        }
        let mark = |index: u32| {
            let mut mark = Mesh::default();
            let corner = Vec3::new(1.5 + 1.3 * index as f32, 1.0 + 0.15 * index as f32, 0.0);
            mark.parallelogram(corner, [Vec3::X * 0.5, Vec3::Y * 0.5], 1, Vec2::ONE);
            mark.colored([40, 35, 30, 255])
        };
        ShadowVolumes {
            walls,
            floor,
            block: boxed(Vec3::splat(-0.5), Vec3::splat(0.5)),
            marks: (0..8).map(mark).collect(),
            centre: hall.centre(),
            bricks: gl.texture(&Picture::bricks([0.6, 0.55, 0.5])),
            boards: gl.texture(&Picture::grain(33, [0.5, 0.4, 0.3], 0.1)),
            scorch: gl.texture(&Picture::glow([0.1, 0.08, 0.06])),
        }
    }

    fn draw_marks(&self, gl: &mut Client) {
        gl.enable(GL_POLYGON_OFFSET_FILL);
        gl.call(id::glPolygonOffset, &[(-1.0).into(), (-2.0).into()]);
        gl.depth_mask(false);
        gl.blend(Some((GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)));
        gl.bind(self.scorch);
        for mark in &self.marks {
            // A mark is a layer of the walls that it is on.
            gl.draw(thing(Class::Layer, 1), mark, Attributes::COLORED);
        }
        gl.color([1.0; 4]);
        gl.blend(None);
        gl.depth_mask(true);
        gl.disable(GL_POLYGON_OFFSET_FILL);
    }

    /// Volumes from all blocks, by two passes where what is seen lies behind their faces.
    fn draw_volumes(&self, gl: &mut Client, t: f64) {
        gl.color_mask(false);
        gl.depth_mask(false);
        gl.enable(GL_STENCIL_TEST);
        gl.enable(GL_CULL_FACE);
        for (culled, operation) in [(GL_BACK, GL_INCR), (GL_FRONT, GL_DECR)] {
            gl.call(id::glCullFace, &[culled.into()]);
            gl.call(id::glStencilFunc, &[GL_ALWAYS.into(), 0.into(), 255.into()]);
            gl.call(id::glStencilOp, &[GL_KEEP.into(), GL_KEEP.into(), operation.into()]);
            for index in 0..BLOCKS {
                let volume = volume(&self.block.transformed(pose(index, t)));
                gl.draw(thing(Class::Dropped, 100 + u64::from(index)), &volume, Attributes::NONE);
            }
        }
        gl.call(id::glCullFace, &[GL_BACK.into()]);
        gl.disable(GL_CULL_FACE);
        gl.color_mask(true);
        gl.depth_mask(true);
    }

    /// What darkens where the count is not zero. It makes shadows, as the volumes do.
    fn darken(gl: &mut Client) {
        gl.call(id::glStencilFunc, &[GL_NOTEQUAL.into(), 0.into(), 255.into()]);
        gl.call(id::glStencilOp, &[GL_KEEP.into(); 3]);
        gl.projection(ortho());
        gl.modelview(DMat4::IDENTITY);
        gl.disable(GL_DEPTH_TEST);
        gl.disable(GL_TEXTURE_2D);
        gl.blend(Some((GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)));
        let mut sheet = Mesh::default();
        let size = [Vec3::X * WINDOW.0 as f32, Vec3::Y * WINDOW.1 as f32];
        sheet.parallelogram(Vec3::ZERO, size, 1, Vec2::ONE);
        gl.color([0.0, 0.0, 0.0, 0.5]);
        gl.draw(thing(Class::Dropped, 300), &sheet, Attributes::NONE);
        gl.color([1.0; 4]);
        gl.blend(None);
        gl.disable(GL_STENCIL_TEST);
        gl.enable(GL_DEPTH_TEST);
    }
}

/// Where a block is, world space.
fn pose(index: u32, t: f64) -> Affine3A {
    let angle = 1.25 * index as f32 + 0.3 * t as f32;
    let place = Vec3::new(8.0 + 3.6 * angle.cos(), 1.2 + 0.3 * index as f32, 8.0 + 3.6 * angle.sin());
    Affine3A::from_translation(place) * Affine3A::from_rotation_y(1.5 * t as f32 + index as f32)
}

/// What a closed mesh of quads hides from the lamp: faces that look to it, the others far behind, and sides between.
fn volume(mesh: &Mesh) -> Mesh {
    let away = |v: Vec3| v + (v - LAMP).normalize() * 12.0;
    let mut volume = Mesh::default();
    for corners in mesh.primitives.iter().flat_map(|p| p.vertices.chunks_exact(4)) {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| corners[i].position);
        let mut quad = |corners: [Vec3; 4]| {
            volume.push(GL_QUADS, &corners.map(|corner| Vertex::new(corner, Vec3::Y, Vec2::ZERO)));
        };
        let is_lit = (b - a).cross(c - a).dot(LAMP - a) > 0.0;
        if !is_lit {
            quad([away(a), away(b), away(c), away(d)]);
            continue;
        }
        quad([a, b, c, d]);
        // Sides between two lit faces cancel out: they are drawn once each way.
        for (from, to) in [(a, b), (b, c), (c, d), (d, a)] {
            quad([to, from, away(from), away(to)]);
        }
    }
    volume
}

impl super::Style for ShadowVolumes {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let view = walk(self.centre, self.centre * 0.75, f64::from(frame) / 120.0 + 0.1);
        let camera = TrueCamera { view, projection: perspective(70.0, 0.1, 60.0) };
        gl.begin_world(0, camera);
        gl.clear(GL_STENCIL_BUFFER_BIT);
        let shape = TrueLightShape::Point { position: LAMP.as_dvec3(), attenuation: Vec3::X };
        gl.light(0, view, shape, Vec3::new(1.0, 0.95, 0.85));
        gl.enable(GL_LIGHTING);
        gl.bind(self.bricks);
        gl.draw_arrays(thing(Class::Static, 1), &self.walls, Attributes::LIT);
        gl.bind(self.boards);
        gl.draw_arrays(thing(Class::Static, 2), &self.floor, Attributes::LIT);
        for index in 0..BLOCKS {
            gl.modelview(view * Mat4::from(pose(index, t)).as_dmat4());
            gl.draw_arrays(thing(Class::Movable, 100 + u64::from(index)), &self.block, Attributes::LIT);
        }
        gl.disable(GL_LIGHTING);
        gl.modelview(view);
        self.draw_marks(gl);
        self.draw_volumes(gl, t);
        Self::darken(gl);
        draw_hud(gl, frame);
    }
}
