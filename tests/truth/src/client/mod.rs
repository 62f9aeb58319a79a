//! What styles draw with: OpenGL's calls, and the truth that is kept beside them.

mod calls;

use std::io;

use afterglow_api::constants::*;
use afterglow_api::id;
use afterglow_scene::Class;
use glam::{DMat4, Vec2, Vec3};

use crate::kit::{Mesh, Picture, Vertex};
use crate::truth::{FrameTruth, Label, TrueCamera, TrueLight, TrueLightOrigin, TrueLightShape, Truth};
pub use calls::{Arg, Calls};

/// Width and height of the window, pixels.
pub const WINDOW: (i32, i32) = (320, 240);

/// What is drawn: its class and the number of the object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Thing {
    /// What it is.
    pub class: Class,
    /// Which it is, the same in all frames.
    pub object: u64,
}

/// A thing of that class.
pub fn thing(class: Class, object: u64) -> Thing {
    Thing { class, object }
}

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
}

/// The name of a texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Texture(u32);

/// A display list and how many triangles it draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct List {
    name: u32,
    triangles: u64,
}

/// A trace and what is true of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// A file that `afterglow replay` plays.
    pub trace: Vec<u8>,
    /// The truth of each of its frames.
    pub truth: Truth,
}

/// A program's OpenGL.
pub struct Client {
    calls: Calls,
    truth: Truth,
    frame: FrameTruth,
    textures: u32,
    lists: u32,
}

impl Client {
    /// The client of a style of that name.
    ///
    /// # Errors
    /// Never in fact: memory takes all that is written.
    pub fn new(style: &str) -> io::Result<Client> {
        let calls = Calls::new(style)?;
        let truth = Truth { style: style.into(), extent: 1.0, frames: Vec::new() };
        let mut client = Client { calls, truth, frame: FrameTruth::default(), textures: 0, lists: 0 };
        client.viewport([0, 0, WINDOW.0, WINDOW.1]);
        client.enable(GL_DEPTH_TEST);
        client.depth_func(GL_LEQUAL);
        // The default material takes a fifth of it: sides in shadow are dark, not black.
        client.call(id::glLightModelfv, &[GL_LIGHT_MODEL_AMBIENT.into(), Arg::Floats(&[1.0; 4])]);
        Ok(client)
    }

    /// What was drawn.
    ///
    /// # Errors
    /// Never in fact: memory takes all that is written.
    pub fn finish(self) -> io::Result<Recording> {
        Ok(Recording { trace: self.calls.finish()?, truth: self.truth })
    }

    /// Writes any other call.
    pub fn call(&mut self, command: afterglow_api::CommandId, args: &[Arg]) {
        self.calls.call(command, args);
    }

    // ---- truth ----------------------------------------------------------------

    /// Says about how large the world is, in its units.
    pub fn set_extent(&mut self, extent: f64) {
        self.truth.extent = extent;
    }

    /// Says that the frame shows a world from a camera.
    pub fn look(&mut self, world: u32, camera: TrueCamera) {
        self.frame.world = world;
        self.frame.camera = Some(camera);
    }

    /// Begins a frame that shows a world: says so, clears, sets the matrices, and switches textures on.
    pub fn begin_world(&mut self, world: u32, camera: TrueCamera) {
        self.look(world, camera);
        self.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        self.projection(camera.projection);
        self.modelview(camera.view);
        self.enable(GL_TEXTURE_2D);
    }

    /// Says that a light shines.
    pub fn shine(&mut self, light: TrueLight) {
        self.frame.lights.push(light);
    }

    fn count(&mut self, Thing { class, object }: Thing, triangles: u64) {
        match self.frame.labels.last_mut() {
            Some(last) if (last.class, last.object) == (class, object) => last.triangles += triangles,
            _ if triangles == 0 => {}
            _ => self.frame.labels.push(Label { class, object, triangles }),
        }
    }

    // ---- frames ---------------------------------------------------------------

    /// Clears the buffers of a mask.
    pub fn clear(&mut self, mask: u32) {
        self.calls.call(id::glClear, &[mask.into()]);
    }

    /// Sets the colour that clears.
    pub fn clear_color(&mut self, [r, g, b]: [f32; 3]) {
        self.calls.call(id::glClearColor, &[r.into(), g.into(), b.into(), 1.0.into()]);
    }

    /// Shows the frame.
    pub fn swap_buffers(&mut self) {
        self.calls.swap_buffers();
        let world = self.frame.world;
        let next = FrameTruth { world, ..FrameTruth::default() };
        self.truth.frames.push(std::mem::replace(&mut self.frame, next));
    }

    // ---- state ----------------------------------------------------------------

    /// glEnable.
    pub fn enable(&mut self, capability: u32) {
        self.calls.call(id::glEnable, &[capability.into()]);
    }

    /// glDisable.
    pub fn disable(&mut self, capability: u32) {
        self.calls.call(id::glDisable, &[capability.into()]);
    }

    /// glDepthFunc.
    pub fn depth_func(&mut self, compare: u32) {
        self.calls.call(id::glDepthFunc, &[compare.into()]);
    }

    /// glDepthMask.
    pub fn depth_mask(&mut self, writes: bool) {
        self.calls.call(id::glDepthMask, &[u32::from(writes).into()]);
    }

    /// glDepthRange.
    pub fn depth_range(&mut self, near: f32, far: f32) {
        self.calls.call(id::glDepthRange, &[near.into(), far.into()]);
    }

    /// glColorMask, all components alike.
    pub fn color_mask(&mut self, writes: bool) {
        self.calls.call(id::glColorMask, &[u32::from(writes).into(); 4]);
    }

    /// Blends with these factors, or no longer.
    pub fn blend(&mut self, factors: Option<(u32, u32)>) {
        let Some((source, destination)) = factors else { return self.disable(GL_BLEND) };
        self.enable(GL_BLEND);
        self.calls.call(id::glBlendFunc, &[source.into(), destination.into()]);
    }

    /// Lets only alphas above a reference pass, or all.
    pub fn alpha_test(&mut self, above: Option<f32>) {
        let Some(above) = above else { return self.disable(GL_ALPHA_TEST) };
        self.enable(GL_ALPHA_TEST);
        self.calls.call(id::glAlphaFunc, &[GL_GREATER.into(), above.into()]);
    }

    /// Passes where the stencil compares with 1, and does so with it then.
    pub fn stencil(&mut self, compare: u32, operation: u32) {
        self.calls.call(id::glStencilFunc, &[compare.into(), 1.into(), 255.into()]);
        self.calls.call(id::glStencilOp, &[GL_KEEP.into(), GL_KEEP.into(), operation.into()]);
    }

    /// glViewport: left, lower edge, width, height.
    pub fn viewport(&mut self, rect: [i32; 4]) {
        self.calls.call(id::glViewport, &rect.map(Arg::from));
    }

    /// Sets the current colour.
    pub fn color(&mut self, [r, g, b, a]: [f32; 4]) {
        self.calls.call(id::glColor4f, &[r.into(), g.into(), b.into(), a.into()]);
    }

    /// Sets the PROJECTION matrix.
    pub fn projection(&mut self, projection: DMat4) {
        self.matrix(GL_PROJECTION, projection);
        self.calls.call(id::glMatrixMode, &[GL_MODELVIEW.into()]);
    }

    /// Sets the MODELVIEW matrix.
    pub fn modelview(&mut self, modelview: DMat4) {
        self.matrix(GL_MODELVIEW, modelview);
    }

    fn matrix(&mut self, mode: u32, matrix: DMat4) {
        self.calls.call(id::glMatrixMode, &[mode.into()]);
        self.calls.call(id::glLoadMatrixf, &[Arg::Floats(&matrix.as_mat4().to_cols_array())]);
    }

    // ---- lights ---------------------------------------------------------------

    /// Sets and enables glLight `index`, and says that it shines. `view` is MODELVIEW at the time, through which
    /// OpenGL sees the position.
    pub fn light(&mut self, index: u8, view: DMat4, shape: TrueLightShape, color: Vec3) {
        self.place_light(index, view, shape, color);
        self.shine(TrueLight { shape, color, origin: TrueLightOrigin::Gl(index) });
    }

    /// Sets and enables glLight `index`, which may be the reflection of one that shines.
    pub fn place_light(&mut self, index: u8, view: DMat4, shape: TrueLightShape, color: Vec3) {
        let light = GL_LIGHT0 + u32::from(index);
        self.modelview(view);
        let position = match shape {
            TrueLightShape::Directional { to_light } => to_light.as_vec3().extend(0.0),
            TrueLightShape::Point { position, .. } => position.as_vec3().extend(1.0),
        };
        if let TrueLightShape::Point { attenuation, .. } = shape {
            let names = [GL_CONSTANT_ATTENUATION, GL_LINEAR_ATTENUATION, GL_QUADRATIC_ATTENUATION];
            for (name, factor) in names.into_iter().zip(attenuation.to_array()) {
                self.calls.call(id::glLightf, &[light.into(), name.into(), factor.into()]);
            }
        }
        let values = [(GL_POSITION, position), (GL_DIFFUSE, color.extend(1.0))];
        for (name, value) in values {
            let floats = value.to_array();
            self.calls.call(id::glLightfv, &[light.into(), name.into(), Arg::Floats(&floats)]);
        }
        self.enable(light);
    }

    // ---- textures -------------------------------------------------------------

    /// Makes a texture that repeats; without alpha where the picture has none.
    pub fn texture(&mut self, picture: &Picture) -> Texture {
        self.textures += 1;
        let texture = Texture(self.textures);
        self.bind(texture);
        let parameters = [
            (GL_TEXTURE_MIN_FILTER, GL_LINEAR),
            (GL_TEXTURE_MAG_FILTER, GL_LINEAR),
            (GL_TEXTURE_WRAP_S, GL_REPEAT),
            (GL_TEXTURE_WRAP_T, GL_REPEAT),
        ];
        for (name, value) in parameters {
            self.calls.call(id::glTexParameteri, &[GL_TEXTURE_2D.into(), name.into(), value.into()]);
        }
        let internal_format = if picture.is_opaque() { GL_RGB8 } else { GL_RGBA8 };
        let size = picture.size as i32;
        self.calls.call(
            id::glTexImage2D,
            &[
                GL_TEXTURE_2D.into(),
                0.into(),
                internal_format.into(),
                size.into(),
                size.into(),
                0.into(),
                GL_RGBA.into(),
                GL_UNSIGNED_BYTE.into(),
                Arg::Bytes(picture.texels.as_flattened()),
            ],
        );
        texture
    }

    /// Binds a texture to the active unit.
    pub fn bind(&mut self, texture: Texture) {
        self.calls.call(id::glBindTexture, &[GL_TEXTURE_2D.into(), texture.0.into()]);
    }

    /// Makes a unit active.
    pub fn unit(&mut self, unit: u32) {
        self.calls.call(id::glActiveTexture, &[(GL_TEXTURE0 + unit).into()]);
    }

    // ---- draws ----------------------------------------------------------------

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
            self.arrays(&primitive.vertices, attributes, true);
            let count = primitive.vertices.len() as i32;
            self.calls.call(id::glDrawArrays, &[primitive.mode.into(), 0.into(), count.into()]);
            self.arrays(&[], attributes, false);
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

    /// Points the arrays to vertices and enables them, or disables them.
    fn arrays(&mut self, vertices: &[Vertex], attributes: Attributes, on: bool) {
        let switch = if on { id::glEnableClientState } else { id::glDisableClientState };
        let floats = |of: &dyn Fn(&Vertex) -> Vec<f32>| -> Vec<u8> {
            vertices.iter().flat_map(of).flat_map(f32::to_le_bytes).collect()
        };
        let tight = |data: &[u8], size: i32, kind: u32, calls: &mut Calls, command| {
            calls.call(command, &[size.into(), kind.into(), 0.into(), Arg::Bytes(data)]);
        };
        let calls = &mut self.calls;
        calls.call(switch, &[GL_VERTEX_ARRAY.into()]);
        if on {
            let data = floats(&|v| v.position.to_array().to_vec());
            tight(&data, 3, GL_FLOAT, calls, id::glVertexPointer);
        }
        if attributes.normal {
            calls.call(switch, &[GL_NORMAL_ARRAY.into()]);
            let data = floats(&|v| v.normal.to_array().to_vec());
            if on {
                calls.call(id::glNormalPointer, &[GL_FLOAT.into(), 0.into(), Arg::Bytes(&data)]);
            }
        }
        if attributes.color {
            calls.call(switch, &[GL_COLOR_ARRAY.into()]);
            let data: Vec<u8> = vertices.iter().flat_map(|v| v.color).collect();
            if on {
                tight(&data, 4, GL_UNSIGNED_BYTE, calls, id::glColorPointer);
            }
        }
        let uv: &dyn Fn(&Vertex) -> Vec<f32> = &|v| v.uv.to_array().to_vec();
        let light_uv: &dyn Fn(&Vertex) -> Vec<f32> = &|v| v.light_uv.to_array().to_vec();
        let units = [
            (attributes.uv, GL_TEXTURE0, uv),
            (attributes.light_uv, GL_TEXTURE0, light_uv),
            (attributes.light_uv_1, GL_TEXTURE1, light_uv),
        ];
        for (_, unit, of) in units.into_iter().filter(|(sent, ..)| *sent) {
            calls.call(id::glClientActiveTexture, &[unit.into()]);
            calls.call(switch, &[GL_TEXTURE_COORD_ARRAY.into()]);
            if on {
                tight(&floats(of), 2, GL_FLOAT, calls, id::glTexCoordPointer);
            }
        }
    }
}
