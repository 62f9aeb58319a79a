//! Draws, by each way that programs send vertices.

use afterglow_api::constants::*;
use afterglow_api::{CommandId, id};
use glam::{Vec2, Vec3};

use super::{Arg, Client, Thing};
use crate::kit::{Mesh, Vertex};

/// Which attributes of the vertices a draw sends.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Attributes {
    /// Unit normals.
    pub normal: bool,
    /// Texture coordinates of unit 0.
    pub uv: bool,
    /// The lightmap's coordinates, as those of unit 0.
    pub light_uv: bool,
    /// The lightmap's coordinates, as those of unit 1.
    pub light_uv_1: bool,
    /// Colours.
    pub color: bool,
}

impl Attributes {
    /// Positions alone.
    pub const NONE: Attributes =
        Attributes { normal: false, uv: false, light_uv: false, light_uv_1: false, color: false };
    /// Texture coordinates.
    pub const TEXTURED: Attributes = Attributes { uv: true, ..Attributes::NONE };
    /// Texture coordinates and colours.
    pub const COLORED: Attributes = Attributes { uv: true, color: true, ..Attributes::NONE };
    /// Texture coordinates and normals.
    pub const LIT: Attributes = Attributes { uv: true, normal: true, ..Attributes::NONE };
    /// The lightmap's coordinates in place of the texture's.
    pub const LIGHTMAP: Attributes = Attributes { light_uv: true, ..Attributes::NONE };
    /// Texture coordinates for unit 0, the lightmap's for unit 1.
    pub const TWO_UNITS: Attributes = Attributes { uv: true, light_uv_1: true, ..Attributes::NONE };

    /// Units whose texture coordinates are sent, and whether they are the lightmap's.
    fn coordinates(self) -> impl Iterator<Item = (u32, bool)> {
        let units = [
            (self.uv, GL_TEXTURE0, false),
            (self.light_uv, GL_TEXTURE0, true),
            (self.light_uv_1, GL_TEXTURE1, true),
        ];
        units.into_iter().filter(|(sent, ..)| *sent).map(|(_, unit, is_light)| (unit, is_light))
    }
}

/// A display list and how many triangles it draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct List {
    name: u32,
    triangles: u64,
}

impl Client {
    /// Draws a mesh between glBegin and glEnd.
    pub fn draw(&mut self, thing: Thing, mesh: &Mesh, attributes: Attributes) {
        self.emit(mesh, attributes);
        self.count(thing, mesh.triangles());
    }

    /// Draws a mesh out of arrays in the program's memory.
    pub fn draw_arrays(&mut self, thing: Thing, mesh: &Mesh, attributes: Attributes) {
        self.emit_arrays(mesh, attributes);
        self.count(thing, mesh.triangles());
    }

    /// Draws meshes of separate polygons as one batch.
    pub fn draw_batch(&mut self, parts: &[(Thing, &Mesh)], attributes: Attributes) {
        let mut batch = Mesh::default();
        for (_, mesh) in parts {
            batch.append(mesh);
        }
        self.emit_arrays(&batch, attributes);
        for (thing, mesh) in parts {
            self.count(*thing, mesh.triangles());
        }
    }

    /// Compiles a mesh into a display list.
    pub fn list(&mut self, mesh: &Mesh, attributes: Attributes) -> List {
        self.lists += 1;
        self.calls.call(id::glNewList, &[self.lists.into(), GL_COMPILE.into()]);
        self.emit(mesh, attributes);
        self.calls.call(id::glEndList, &[]);
        List { name: self.lists, triangles: mesh.triangles() }
    }

    /// Draws what a display list holds.
    pub fn call_list(&mut self, thing: Thing, list: List) {
        self.calls.call(id::glCallList, &[list.name.into()]);
        self.count(thing, list.triangles);
    }

    fn emit(&mut self, mesh: &Mesh, attributes: Attributes) {
        for primitive in &mesh.primitives {
            self.calls.call(id::glBegin, &[primitive.mode.into()]);
            for vertex in &primitive.vertices {
                self.vertex(vertex, attributes);
            }
            self.calls.call(id::glEnd, &[]);
        }
    }

    fn emit_arrays(&mut self, mesh: &Mesh, attributes: Attributes) {
        for primitive in &mesh.primitives {
            self.set_arrays(&primitive.vertices, attributes);
            let count = primitive.vertices.len() as i32;
            self.calls.call(id::glDrawArrays, &[primitive.mode.into(), 0.into(), count.into()]);
            self.disable_arrays(attributes);
        }
    }

    fn vertex(&mut self, vertex: &Vertex, attributes: Attributes) {
        let calls = &mut self.calls;
        let of_3 = |v: Vec3| v.to_array().map(Arg::from);
        let of_2 = |v: Vec2| v.to_array().map(Arg::from);
        if attributes.normal {
            calls.call(id::glNormal3f, &of_3(vertex.normal));
        }
        if attributes.color {
            calls.call(id::glColor4ub, &vertex.color.map(|c| Arg::Int(c.into())));
        }
        if attributes.uv {
            calls.call(id::glTexCoord2f, &of_2(vertex.uv));
        }
        if attributes.light_uv {
            calls.call(id::glTexCoord2f, &of_2(vertex.light_uv));
        }
        if attributes.light_uv_1 {
            let [s, t] = of_2(vertex.light_uv);
            calls.call(id::glMultiTexCoord2f, &[GL_TEXTURE1.into(), s, t]);
        }
        calls.call(id::glVertex3f, &of_3(vertex.position));
    }

    /// Points the arrays to vertices and enables them.
    fn set_arrays(&mut self, vertices: &[Vertex], attributes: Attributes) {
        self.array(GL_VERTEX_ARRAY, id::glVertexPointer, Some(3), &floats(vertices, |v| v.position.into()));
        if attributes.normal {
            self.array(GL_NORMAL_ARRAY, id::glNormalPointer, None, &floats(vertices, |v| v.normal.into()));
        }
        if attributes.color {
            let bytes: Vec<u8> = vertices.iter().flat_map(|v| v.color).collect();
            self.calls.call(id::glEnableClientState, &[GL_COLOR_ARRAY.into()]);
            let args = [4.into(), GL_UNSIGNED_BYTE.into(), 0.into(), Arg::Bytes(&bytes)];
            self.calls.call(id::glColorPointer, &args);
        }
        for (unit, is_light) in attributes.coordinates() {
            let bytes = floats(vertices, |v| if is_light { v.light_uv.into() } else { v.uv.into() });
            self.calls.call(id::glClientActiveTexture, &[unit.into()]);
            self.array(GL_TEXTURE_COORD_ARRAY, id::glTexCoordPointer, Some(2), &bytes);
        }
    }

    /// Enables an array of floats. glNormalPointer alone takes no number of components.
    fn array(&mut self, array: u32, pointer: CommandId, components: Option<i32>, bytes: &[u8]) {
        self.calls.call(id::glEnableClientState, &[array.into()]);
        let rest = [GL_FLOAT.into(), 0.into(), Arg::Bytes(bytes)];
        let args: Vec<Arg> = components.map(Arg::from).into_iter().chain(rest).collect();
        self.calls.call(pointer, &args);
    }

    /// Disables what [`set_arrays`](Self::set_arrays) enabled.
    fn disable_arrays(&mut self, attributes: Attributes) {
        let arrays = [
            (true, GL_VERTEX_ARRAY),
            (attributes.normal, GL_NORMAL_ARRAY),
            (attributes.color, GL_COLOR_ARRAY),
        ];
        for (_, array) in arrays.into_iter().filter(|(sent, _)| *sent) {
            self.calls.call(id::glDisableClientState, &[array.into()]);
        }
        for (unit, _) in attributes.coordinates() {
            self.calls.call(id::glClientActiveTexture, &[unit.into()]);
            self.calls.call(id::glDisableClientState, &[GL_TEXTURE_COORD_ARRAY.into()]);
        }
    }
}

/// An attribute of all vertices, as it lies in memory.
fn floats<const N: usize>(vertices: &[Vertex], of: impl Fn(&Vertex) -> [f32; N]) -> Vec<u8> {
    vertices.iter().flat_map(of).flat_map(f32::to_le_bytes).collect()
}
