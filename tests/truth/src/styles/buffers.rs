//! An engine of the time of buffer objects: all vertices lie interleaved in one big buffer, drawn by indices that lie in
//! another. Its first part never changes; its last part is filled anew each frame with creatures that the CPU animates.

use afterglow_api::constants::*;
use afterglow_api::id;
use afterglow_scene::Class;
use glam::{Affine3A, DMat4, DVec3, Vec3};

use crate::client::{Arg, Client, Texture, Thing, thing};
use crate::kit::{Cell, Hall, Mesh, Picture, Primitive, Vertex, boxed, creature, draw_hud, in_sight};
use crate::kit::{perspective, walk};
use crate::truth::TrueCamera;

/// A building in buffers, crates that turn, and creatures.
pub struct Buffers {
    hall: Hall,
    /// Of each cell, walls and floors.
    parts: Vec<[Part; 2]>,
    shape: Part,
    creatures: Vec<Part>,
    walls: Texture,
    floors: Texture,
    skin: Texture,
}

/// A stretch of the indices.
#[derive(Clone, Copy)]
struct Part {
    first: usize,
    count: usize,
    /// Of the vertices that they name.
    first_vertex: usize,
}

/// Vertices and indices as they lie in the buffers.
#[derive(Default)]
struct Store {
    vertices: Vec<u8>,
    indices: Vec<u8>,
}

/// Position, colour, texture coordinates: bytes of a vertex.
const STRIDE: usize = 24;
const CREATURES: u32 = 5;
const VERTICES: u32 = 1;
const INDICES: u32 = 2;

impl Store {
    fn add(&mut self, mesh: &Mesh) -> Part {
        let first_vertex = self.vertices.len() / STRIDE;
        let first = self.indices.len() / 4;
        for primitive in &mesh.primitives {
            let base = self.vertices.len() / STRIDE;
            self.vertices.extend(primitive.vertices.iter().flat_map(bytes));
            let indices = triangles(primitive).map(|index| (base + index) as u32);
            self.indices.extend(indices.flat_map(u32::to_le_bytes));
        }
        Part { first, count: self.indices.len() / 4 - first, first_vertex }
    }
}

fn bytes(vertex: &Vertex) -> [u8; STRIDE] {
    let mut bytes = [0; STRIDE];
    let floats = vertex.position.to_array().into_iter().chain(vertex.uv.to_array());
    for (place, value) in [0, 4, 8, 16, 20].into_iter().zip(floats) {
        bytes[place..place + 4].copy_from_slice(&value.to_le_bytes());
    }
    bytes[12..16].copy_from_slice(&vertex.color);
    bytes
}

/// Indices of the triangles of quads and strips of quads, which is all that this program's meshes are of.
fn triangles(primitive: &Primitive) -> impl Iterator<Item = usize> {
    let step = if primitive.mode == GL_QUADS { 4 } else { 2 };
    let order = if primitive.mode == GL_QUADS { [0, 1, 2, 0, 2, 3] } else { [0, 1, 3, 0, 3, 2] };
    let quads = (primitive.vertices.len() - 4) / step + 1;
    (0..quads).flat_map(move |quad| order.map(|corner| quad * step + corner))
}

impl Buffers {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> Buffers {
        let mut hall = Hall::new([6, 7], 1);
        hall.bake();
        gl.set_extent(hall.extent());
        let mut store = Store::default();
        let mut add = |cell: &Cell| [store.add(&cell.walls), store.add(&cell.floors)];
        let parts = hall.cells.iter().map(&mut add).collect();
        let shape = store.add(&boxed(Vec3::new(-0.5, 0.0, -0.5), Vec3::new(0.5, 1.0, 0.5)));
        let creatures = (0..CREATURES).map(|_| store.add(&creature(0.0))).collect();
        gl.call(id::glBindBuffer, &[GL_ARRAY_BUFFER.into(), VERTICES.into()]);
        gl.call(id::glBindBuffer, &[GL_ELEMENT_ARRAY_BUFFER.into(), INDICES.into()]);
        for (target, bytes) in [(GL_ARRAY_BUFFER, &store.vertices), (GL_ELEMENT_ARRAY_BUFFER, &store.indices)]
        {
            let size = Arg::Int(bytes.len() as i64);
            gl.call(id::glBufferData, &[target.into(), size, Arg::Bytes(bytes), GL_DYNAMIC_DRAW.into()]);
        }
        set_arrays(gl);
        Buffers {
            hall,
            parts,
            shape,
            creatures,
            walls: gl.texture(&Picture::bricks([0.5, 0.55, 0.5])),
            floors: gl.texture(&Picture::grain(51, [0.45, 0.4, 0.35], 0.1)),
            skin: gl.texture(&Picture::checker(3.0, [0.55, 0.4, 0.3], [0.35, 0.3, 0.45])),
        }
    }

    fn draw_part(gl: &mut Client, thing: Thing, part: Part) {
        let offset = Arg::Handle(4 * part.first as u64);
        let count = Arg::Int(part.count as i64);
        gl.call(id::glDrawElements, &[GL_TRIANGLES.into(), count, GL_UNSIGNED_INT.into(), offset]);
        gl.drawn(thing, part.count as u64 / 3);
    }

    /// The animated end of the buffer, creature by creature.
    fn animate(&self, gl: &mut Client, t: f32) {
        for (part, index) in self.creatures.iter().zip(0..) {
            let mesh = creature(5.0 * t + index as f32).transformed(pose(index, t));
            let mut store = Store::default();
            store.add(&mesh);
            let (start, size) = (part.first_vertex * STRIDE, store.vertices.len());
            let range = [Arg::Int(start as i64), Arg::Int(size as i64), Arg::Bytes(&store.vertices)];
            gl.call(id::glBufferSubData, &[&[GL_ARRAY_BUFFER.into()], range.as_slice()].concat());
        }
    }
}

/// Arrays point into the buffer once and for all.
fn set_arrays(gl: &mut Client) {
    let stride = Arg::Int(STRIDE as i64);
    let arrays = [
        (GL_VERTEX_ARRAY, id::glVertexPointer, 3, GL_FLOAT, 0),
        (GL_COLOR_ARRAY, id::glColorPointer, 4, GL_UNSIGNED_BYTE, 12),
        (GL_TEXTURE_COORD_ARRAY, id::glTexCoordPointer, 2, GL_FLOAT, 16),
    ];
    for (array, pointer, components, kind, offset) in arrays {
        gl.call(id::glEnableClientState, &[array.into()]);
        gl.call(pointer, &[components.into(), kind.into(), stride, Arg::Handle(offset)]);
    }
}

/// Where a creature is, world space.
fn pose(index: u32, t: f32) -> Affine3A {
    let angle = 1.2 * index as f32 + 0.3 * t;
    let place = Vec3::new(12.0 + 5.0 * angle.cos(), 0.0, 14.0 + 6.0 * angle.sin());
    Affine3A::from_translation(place) * Affine3A::from_rotation_y(-angle)
}

impl super::Style for Buffers {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let view = walk(self.hall.centre(), self.hall.centre() * 0.6, f64::from(frame) / 100.0 + 0.7);
        let camera = TrueCamera { view, projection: perspective(70.0, 0.1, 80.0) };
        self.animate(gl, t as f32);
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        for (cell, parts) in self.hall.cells.iter().zip(&self.parts) {
            if in_sight(&camera, cell.centre, cell.radius) {
                for (texture, part) in [self.walls, self.floors].into_iter().zip(parts) {
                    gl.bind(texture);
                    Self::draw_part(gl, thing(Class::Static, cell.object), *part);
                }
            }
        }
        gl.bind(self.skin);
        for (part, index) in self.creatures.iter().zip(0..) {
            if in_sight(&camera, pose(index, t as f32).translation.as_dvec3(), 2.0) {
                Self::draw_part(gl, thing(Class::Dynamic, 100 + u64::from(index)), *part);
            }
        }
        for index in 0..4u32 {
            let place = DVec3::new(6.0 + 4.0 * f64::from(index), 0.3, 10.0);
            if in_sight(&camera, place, 1.0) {
                let turn = DMat4::from_rotation_y(f64::from(index) + 2.0 * t);
                gl.modelview(view * DMat4::from_translation(place) * turn);
                Self::draw_part(gl, thing(Class::Movable, 200 + u64::from(index)), self.shape);
            }
        }
        draw_hud(gl, frame);
    }
}
