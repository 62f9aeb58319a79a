//! Recorded calls as steps of the machine that an oracle watches: only what decides where and how triangles are drawn.

use std::sync::Arc;

use afterglow_api::constants::*;
use afterglow_api::{CommandId, id};
use afterglow_trace::{Call, Value};
use glam::{DMat4, DVec3, Vec3};

/// What a call does.
#[derive(Debug, Clone)]
pub enum Step {
    /// glMatrixMode.
    MatrixMode(u32),
    /// Replaces the current matrix.
    Load(DMat4),
    /// Multiplies the current matrix.
    Multiply(DMat4),
    /// glPushMatrix.
    Push,
    /// glPopMatrix.
    Pop,
    /// glBegin.
    Begin(u32),
    /// glVertex.
    Vertex(Vec3),
    /// glEnd.
    End,
    /// glRect: two corners.
    Rect([f32; 4]),
    /// glDrawArrays: mode, first, count.
    Arrays(u32, usize, usize),
    /// glDrawElements: mode, count, bytes of an index, where the indices are.
    Elements(u32, usize, usize, Memory),
    /// What arrays held when a list was compiled: mode, positions.
    Gathered(u32, Arc<[Vec3]>),
    /// glVertexPointer: components, type, stride, where the vertices are.
    Positions(usize, u32, usize, Memory),
    /// glEnable, glDisable.
    Capability(u32, bool),
    /// glEnableClientState, glDisableClientState.
    ClientState(u32, bool),
    /// glBlendFunc.
    Blend(u32, u32),
    /// glDepthFunc.
    DepthFunc(u32),
    /// glDepthMask.
    DepthMask(bool),
    /// glDepthRange.
    DepthRange([f64; 2]),
    /// glColorMask: whether any colour is written.
    ColorMask(bool),
    /// glCullFace, glFrontFace.
    Faces(u32),
    /// glStencilOp.
    StencilOp([u32; 3]),
    /// glViewport.
    Viewport([i32; 4]),
    /// glClear.
    Clear(u32),
    /// glBindTexture: target, name.
    Texture(u32, u32),
    /// glTexImage2D of level 0: target, and how opaque the texels are.
    Image(u32, Opacity),
    /// glAlphaFunc: the reference.
    AlphaReference(f32),
    /// glActiveTexture, counted from 0.
    Unit(usize),
    /// glClientActiveTexture and the like, and whatever else separates draws without changing what is kept.
    Lock(bool),
    /// glPushAttrib.
    PushAttrib(u32),
    /// glPopAttrib.
    PopAttrib,
    /// glPushClientAttrib.
    PushClient,
    /// glPopClientAttrib.
    PopClient,
    /// glBindBuffer.
    Buffer(u32, u32),
    /// glBufferData: target, size, content.
    BufferData(u32, usize, Option<Arc<[u8]>>),
    /// glBufferSubData.
    BufferPart(u32, usize, Arc<[u8]>),
    /// glNewList: name, and whether it is executed as well.
    NewList(u32, bool),
    /// glEndList.
    EndList,
    /// glCallList.
    CallList(u32),
    /// A buffer swap.
    Swap,
}

/// Memory of the program, or an offset in a buffer.
#[derive(Debug, Clone)]
pub enum Memory {
    /// Its content.
    Bytes(Arc<[u8]>),
    /// In the buffer that is bound.
    Offset(usize),
}

/// How opaque a texture is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Opacity {
    /// Nothing is seen through it.
    Opaque,
    /// Texels are solid or empty, but for the edges between.
    CutOut,
    /// Much of it is half seen through.
    Mixed,
    /// It has content that was not read.
    Unknown,
}

/// Share of texels that may be neither solid nor empty: edges.
const EDGES: f64 = 0.2;

impl Opacity {
    /// That of texels of so many bytes, the last of which is alpha if there are two or four.
    fn of(texels: &[u8], bytes: usize) -> Opacity {
        if bytes != 2 && bytes != 4 {
            return Opacity::Opaque;
        }
        let (mut solid, mut empty, mut all) = (0u32, 0u32, 0u32);
        for alpha in texels.chunks_exact(bytes).map(|texel| texel[bytes - 1]) {
            solid += u32::from(alpha >= 240);
            empty += u32::from(alpha < 16);
            all += 1;
        }
        match f64::from(all - solid - empty) {
            _ if all == solid => Opacity::Opaque,
            between if between <= EDGES * f64::from(all) => Opacity::CutOut,
            _ => Opacity::Mixed,
        }
    }
}

/// The arguments of a call.
struct Args<'a>(&'a Call);

impl Args<'_> {
    fn uint(&self, index: usize) -> Option<u32> {
        self.0.arg(index).as_u32()
    }

    fn int(&self, index: usize) -> Option<i32> {
        self.0.arg(index).as_i64().map(|value| value as i32)
    }

    fn size(&self, index: usize) -> Option<usize> {
        self.0.arg(index).as_i64()?.try_into().ok()
    }

    fn float(&self, index: usize) -> Option<f64> {
        self.0.arg(index).as_f64()
    }

    fn vector<const N: usize>(&self, first: usize) -> Option<[f64; N]> {
        let mut vector = [0.0; N];
        for (i, element) in vector.iter_mut().enumerate() {
            *element = self.float(first + i)?;
        }
        Some(vector)
    }

    /// The elements of an array, at least `N`.
    fn array<const N: usize>(&self, index: usize) -> Option<[f64; N]> {
        let values = self.0.arg(index).as_array()?.first_chunk::<N>()?;
        let mut array = [0.0; N];
        for (element, value) in array.iter_mut().zip(values) {
            *element = value.as_f64()?;
        }
        Some(array)
    }

    fn matrix(&self) -> Option<DMat4> {
        self.array::<16>(0).map(|entries| DMat4::from_cols_array(&entries))
    }

    fn memory(&self, index: usize) -> Option<Memory> {
        let value: &Value = self.0.arg(index);
        match value.as_blob() {
            Some(bytes) => Some(Memory::Bytes(bytes.clone())),
            None => Some(Memory::Offset(value.as_pointer()?.try_into().ok()?)),
        }
    }

    /// A vertex of so many components, as arguments or as an array.
    fn vertex(&self, count: usize, is_array: bool) -> Option<Step> {
        let [x, y] = if is_array { self.array::<2>(0)? } else { self.vector::<2>(0)? };
        let z = match (count, is_array) {
            (2, _) => 0.0,
            (_, true) => self.array::<3>(0)?[2],
            (_, false) => self.float(2)?,
        };
        Some(Step::Vertex(DVec3::new(x, y, z).as_vec3()))
    }
}

/// What a call does to the machine; nothing where that does not matter.
pub fn step(command: CommandId, call: &Call) -> Option<Step> {
    let a = Args(call);
    matrices(command, &a)
        .or_else(|| vertices(command, &a))
        .or_else(|| state(command, &a))
        .or_else(|| memory(command, &a))
}

fn matrices(command: CommandId, a: &Args) -> Option<Step> {
    Some(match command {
        id::glMatrixMode => Step::MatrixMode(a.uint(0)?),
        id::glLoadIdentity => Step::Load(DMat4::IDENTITY),
        id::glLoadMatrixf | id::glLoadMatrixd => Step::Load(a.matrix()?),
        id::glMultMatrixf | id::glMultMatrixd => Step::Multiply(a.matrix()?),
        id::glPushMatrix => Step::Push,
        id::glPopMatrix => Step::Pop,
        id::glTranslatef | id::glTranslated => {
            Step::Multiply(DMat4::from_translation(a.vector::<3>(0)?.into()))
        }
        id::glScalef | id::glScaled => Step::Multiply(DMat4::from_scale(a.vector::<3>(0)?.into())),
        id::glRotatef | id::glRotated => {
            let [angle, x, y, z] = a.vector::<4>(0)?;
            let axis = DVec3::new(x, y, z).normalize_or_zero();
            let is_rotation = axis != DVec3::ZERO;
            let rotation = || DMat4::from_axis_angle(axis, angle.to_radians());
            Step::Multiply(if is_rotation { rotation() } else { DMat4::IDENTITY })
        }
        id::glOrtho => {
            let [left, right, bottom, top, near, far] = a.vector::<6>(0)?;
            let ortho = glam::dcamera::rh::proj::opengl::orthographic(left, right, bottom, top, near, far);
            Step::Multiply(ortho)
        }
        id::glFrustum => {
            let [left, right, bottom, top, near, far] = a.vector::<6>(0)?;
            Step::Multiply(frustum([left, right], [bottom, top], [near, far]))
        }
        _ => return None,
    })
}

/// OpenGL's own matrix (specification 2.11.2).
fn frustum(x: [f64; 2], y: [f64; 2], z: [f64; 2]) -> DMat4 {
    let size = |range: [f64; 2]| range[1] - range[0];
    let middle = |range: [f64; 2]| (range[0] + range[1]) / size(range);
    DMat4::from_cols_array_2d(&[
        [2.0 * z[0] / size(x), 0.0, 0.0, 0.0],
        [0.0, 2.0 * z[0] / size(y), 0.0, 0.0],
        [middle(x), middle(y), -middle(z), -1.0],
        [0.0, 0.0, -2.0 * z[0] * z[1] / size(z), 0.0],
    ])
}

fn vertices(command: CommandId, a: &Args) -> Option<Step> {
    Some(match command {
        id::glBegin => Step::Begin(a.uint(0)?),
        id::glEnd => Step::End,
        id::glVertex2f | id::glVertex2i | id::glVertex2d | id::glVertex2s => a.vertex(2, false)?,
        id::glVertex3f | id::glVertex3i | id::glVertex3d => a.vertex(3, false)?,
        id::glVertex2fv | id::glVertex2dv => a.vertex(2, true)?,
        id::glVertex3fv | id::glVertex3dv => a.vertex(3, true)?,
        id::glRectf | id::glRecti | id::glRectd => Step::Rect(a.vector::<4>(0)?.map(|x| x as f32)),
        id::glDrawArrays => Step::Arrays(a.uint(0)?, a.size(1)?, a.size(2)?),
        id::glDrawElements => Step::Elements(a.uint(0)?, a.size(1)?, width(a.uint(2)?), a.memory(3)?),
        id::glVertexPointer => Step::Positions(a.size(0)?, a.uint(1)?, a.size(2)?, a.memory(3)?),
        id::glNewList => Step::NewList(a.uint(0)?, a.uint(1)? == GL_COMPILE_AND_EXECUTE),
        id::glEndList => Step::EndList,
        id::glCallList => Step::CallList(a.uint(0)?),
        _ => return None,
    })
}

/// Bytes of a number of that type.
fn width(kind: u32) -> usize {
    match kind {
        GL_UNSIGNED_BYTE | GL_BYTE => 1,
        GL_UNSIGNED_SHORT | GL_SHORT => 2,
        GL_DOUBLE => 8,
        _ => 4,
    }
}

fn state(command: CommandId, a: &Args) -> Option<Step> {
    Some(match command {
        id::glEnable => Step::Capability(a.uint(0)?, true),
        id::glDisable => Step::Capability(a.uint(0)?, false),
        id::glEnableClientState => Step::ClientState(a.uint(0)?, true),
        id::glDisableClientState => Step::ClientState(a.uint(0)?, false),
        id::glBlendFunc => Step::Blend(a.uint(0)?, a.uint(1)?),
        id::glDepthFunc => Step::DepthFunc(a.uint(0)?),
        id::glDepthMask => Step::DepthMask(a.int(0)? != 0),
        id::glDepthRange => Step::DepthRange(a.vector(0)?),
        id::glColorMask => Step::ColorMask((0..3).any(|i| a.int(i).is_some_and(|on| on != 0))),
        id::glCullFace | id::glFrontFace => Step::Faces(a.uint(0)?),
        id::glStencilOp => Step::StencilOp([a.uint(0)?, a.uint(1)?, a.uint(2)?]),
        id::glViewport => Step::Viewport([a.int(0)?, a.int(1)?, a.int(2)?, a.int(3)?]),
        id::glClear => Step::Clear(a.uint(0)?),
        id::glBindTexture => Step::Texture(a.uint(0)?, a.uint(1)?),
        id::glTexImage2D if a.int(1)? == 0 => {
            let bytes = match (a.uint(6)?, a.uint(7)?) {
                (GL_RGBA | GL_BGRA, GL_UNSIGNED_BYTE | GL_UNSIGNED_INT_8_8_8_8_REV) => 4,
                (GL_LUMINANCE_ALPHA, GL_UNSIGNED_BYTE) => 2,
                (GL_ALPHA, GL_UNSIGNED_BYTE) => 0,
                _ => 3,
            };
            let opacity = match a.0.arg(8).as_blob() {
                Some(texels) if bytes > 0 => Opacity::of(texels, bytes),
                _ => Opacity::Unknown,
            };
            Step::Image(a.uint(0)?, opacity)
        }
        id::glAlphaFunc => Step::AlphaReference(a.float(1)? as f32),
        id::glActiveTexture => Step::Unit(a.uint(0)?.wrapping_sub(GL_TEXTURE0) as usize),
        id::glLockArraysEXT => Step::Lock(true),
        id::glUnlockArraysEXT => Step::Lock(false),
        id::glPushAttrib => Step::PushAttrib(a.uint(0)?),
        id::glPopAttrib => Step::PopAttrib,
        id::glPushClientAttrib => Step::PushClient,
        id::glPopClientAttrib => Step::PopClient,
        id::glXSwapBuffers => Step::Swap,
        _ => return None,
    })
}

fn memory(command: CommandId, a: &Args) -> Option<Step> {
    Some(match command {
        id::glBindBuffer => Step::Buffer(a.uint(0)?, a.uint(1)?),
        id::glBufferData => Step::BufferData(a.uint(0)?, a.size(1)?, a.0.arg(2).as_blob().cloned()),
        id::glBufferSubData => Step::BufferPart(a.uint(0)?, a.size(1)?, a.0.arg(3).as_blob()?.clone()),
        _ => return None,
    })
}
