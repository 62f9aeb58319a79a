//! Arrays in the program's memory. How far a draw reads is known only when it is called, so calls of glVertexPointer
//! and its like are recorded then, with the memory, as if the program had made them.

use afterglow_api::constants::*;
use afterglow_api::{CommandId, id};
use afterglow_gl::{Context, MemoryArray};

use super::number::Number;
use super::plan::Role;
use super::recorder::Recorder;
use super::sizes::natural;

/// Records the arrays that a draw is about to read.
///
/// # Safety
/// Pointers among the arguments, and arrays of the context, are what the specification of the draw wants.
pub unsafe fn before_draw(recorder: &mut Recorder, gl: &mut Context, role: Role, arguments: &[u64]) {
    if gl.memory_arrays().next().is_none() {
        return;
    }
    // SAFETY: the contract is the same.
    let vertices = unsafe { vertices(gl, role, arguments) };
    // A program may lock more than it draws, and change what is not locked before the next draw.
    let vertices = if vertices == 0 { 0 } else { vertices.max(gl.locked_vertices()) };
    if gl.reads_arrays(vertices) {
        // SAFETY: the program's arrays hold what it draws and locks.
        unsafe { arrays(recorder, gl, vertices) };
    }
}

/// How many vertices a draw reads, counted from the first of the arrays.
unsafe fn vertices(gl: &mut Context, role: Role, arguments: &[u64]) -> usize {
    match (role, arguments) {
        (Role::Arrays, &[_, first, count]) => consecutive(first, count),
        (Role::Elements(at), arguments) => indexed(gl, arguments[at], arguments[at + 1], arguments[at + 2]),
        (Role::MultiArrays, &[_, firsts, counts, draws]) if firsts != 0 && counts != 0 => {
            // SAFETY: there are as many firsts and counts as draws.
            let load = |array: u64, i| unsafe { Number::I32.load(array as usize, i) };
            (0..natural(draws)).map(|i| consecutive(load(firsts, i), load(counts, i))).max().unwrap_or(0)
        }
        (Role::MultiElements, &[_, counts, kind, lists, draws]) if counts != 0 && lists != 0 => {
            // SAFETY: there are as many counts and lists as draws.
            let load = |number: Number, array: u64, i| unsafe { number.load(array as usize, i) };
            let draws = 0..natural(draws);
            let vertices = draws
                .map(|i| indexed(gl, load(Number::I32, counts, i), kind, load(Number::Address, lists, i)));
            vertices.max().unwrap_or(0)
        }
        _ => 0,
    }
}

fn consecutive(first: u64, count: u64) -> usize {
    match natural(count) {
        0 => 0,
        count => natural(first).saturating_add(count),
    }
}

fn indexed(gl: &mut Context, count: u64, kind: u64, indices: u64) -> usize {
    gl.indexed_vertices(count as i32, kind as u32, crate::memory::pointer(indices as usize as *const _))
}

/// Records all enabled arrays in memory.
unsafe fn arrays(recorder: &mut Recorder, gl: &mut Context, vertices: usize) {
    let bound = gl.get_integer(GL_ARRAY_BUFFER_BINDING).first().copied().unwrap_or(0);
    if bound != 0 {
        bind(recorder, 0);
    }
    let own_unit = gl.client_texture_unit();
    let mut is_other = false;
    for array in in_order(gl) {
        if array.array != GL_TEXTURE_COORD_ARRAY {
            if std::mem::take(&mut is_other) {
                select_unit(recorder, own_unit);
            }
        } else if is_other || array.unit != own_unit {
            is_other = true;
            select_unit(recorder, array.unit);
        }
        let bytes = array.bytes(vertices);
        let (id, arguments) = pointer_call(&array);
        // SAFETY: the array holds so many vertices.
        unsafe { recorder.fake(id, &arguments, Some((array.address as u64, bytes))) };
    }
    if is_other {
        select_unit(recorder, own_unit);
    }
    if bound != 0 {
        bind(recorder, bound);
    }
}

/// Arrays in the order in which apitrace has them. The position comes last, since it makes the vertex.
const ORDER: [u32; 8] = [
    GL_SECONDARY_COLOR_ARRAY,
    GL_FOG_COORDINATE_ARRAY,
    GL_EDGE_FLAG_ARRAY,
    GL_TEXTURE_COORD_ARRAY,
    GL_INDEX_ARRAY,
    GL_COLOR_ARRAY,
    GL_NORMAL_ARRAY,
    GL_VERTEX_ARRAY,
];

/// All enabled arrays in memory.
fn in_order(gl: &Context) -> Vec<MemoryArray> {
    let mut arrays: Vec<MemoryArray> = gl.memory_arrays().collect();
    arrays.sort_by_key(|array| (ORDER.iter().position(|kind| *kind == array.array), array.unit));
    arrays
}

/// Binds the buffer that pointers of arrays are offsets in; 0 lets them be addresses.
fn bind(recorder: &mut Recorder, buffer: i32) {
    // SAFETY: no pointers.
    unsafe { recorder.fake(id::glBindBuffer, &[GL_ARRAY_BUFFER.into(), buffer as u64], None) };
}

fn select_unit(recorder: &mut Recorder, unit: usize) {
    let name = u64::from(GL_TEXTURE0) + unit as u64;
    // SAFETY: no pointers.
    unsafe { recorder.fake(id::glClientActiveTexture, &[name], None) };
}

/// The command that sets an array, and its arguments but the pointer.
fn pointer_call(array: &MemoryArray) -> (CommandId, Vec<u64>) {
    let (size, kind, stride) = (array.size.into(), array.kind.into(), array.stride.into());
    match array.array {
        GL_VERTEX_ARRAY => (id::glVertexPointer, vec![size, kind, stride]),
        GL_NORMAL_ARRAY => (id::glNormalPointer, vec![kind, stride]),
        GL_COLOR_ARRAY => (id::glColorPointer, vec![size, kind, stride]),
        GL_SECONDARY_COLOR_ARRAY => (id::glSecondaryColorPointer, vec![size, kind, stride]),
        GL_FOG_COORDINATE_ARRAY => (id::glFogCoordPointer, vec![kind, stride]),
        GL_INDEX_ARRAY => (id::glIndexPointer, vec![kind, stride]),
        GL_EDGE_FLAG_ARRAY => (id::glEdgeFlagPointer, vec![stride]),
        _ => (id::glTexCoordPointer, vec![size, kind, stride]),
    }
}

/// Whether glInterleavedArrays knows the format and the stride.
pub fn is_format(arguments: &[u64]) -> bool {
    (GL_V2F..=GL_T4F_C4F_N3F_V4F).contains(&(arguments[0] as u32)) && arguments[1] as i64 >= 0
}

/// Records which arrays glInterleavedArrays switched. Those that are on are in the program's memory.
pub fn after_interleaved_arrays(recorder: &mut Recorder, gl: &Context) {
    for array in ORDER {
        let is_this = |other: &MemoryArray| {
            other.array == array
                && (array != GL_TEXTURE_COORD_ARRAY || other.unit == gl.client_texture_unit())
        };
        let id = match gl.memory_arrays().any(|other| is_this(&other)) {
            true => id::glEnableClientState,
            false => id::glDisableClientState,
        };
        // SAFETY: no pointers.
        unsafe { recorder.fake(id, &[array.into()], None) };
    }
}

/// Records glArrayElement as calls that give the element's attributes; false if no array is in the program's memory.
///
/// # Safety
/// The arrays hold the element.
pub unsafe fn element(recorder: &mut Recorder, gl: &Context, arguments: &[u64]) -> bool {
    let Ok(element) = usize::try_from(arguments[0] as i64) else { return false };
    let arrays = in_order(gl);
    for array in &arrays {
        let Some(id) = attribute_call(array) else { continue };
        let address = (array.address + array.bytes(element + 1).unwrap_or(0) - array.element_bytes()) as u64;
        let unit = u64::from(GL_TEXTURE0) + array.unit as u64;
        let arguments = if array.unit > 0 { vec![unit, address] } else { vec![address] };
        // SAFETY: the contract is the same.
        unsafe { recorder.fake(id, &arguments, None) };
    }
    !arrays.is_empty()
}

/// The command that takes an element of the array.
fn attribute_call(array: &MemoryArray) -> Option<CommandId> {
    let kind = match array.kind {
        GL_BYTE => "b",
        GL_UNSIGNED_BYTE => "ub",
        GL_SHORT => "s",
        GL_UNSIGNED_SHORT => "us",
        GL_INT => "i",
        GL_UNSIGNED_INT => "ui",
        GL_FLOAT => "f",
        _ => "d",
    };
    let size = array.size;
    CommandId::named(&match array.array {
        GL_VERTEX_ARRAY => format!("glVertex{size}{kind}v"),
        GL_NORMAL_ARRAY => format!("glNormal3{kind}v"),
        GL_COLOR_ARRAY => format!("glColor{size}{kind}v"),
        GL_SECONDARY_COLOR_ARRAY => format!("glSecondaryColor3{kind}v"),
        GL_FOG_COORDINATE_ARRAY => format!("glFogCoord{kind}v"),
        GL_INDEX_ARRAY => format!("glIndex{kind}v"),
        GL_EDGE_FLAG_ARRAY => "glEdgeFlagv".into(),
        _ if array.unit > 0 => format!("glMultiTexCoord{size}{kind}v"),
        _ => format!("glTexCoord{size}{kind}v"),
    })
}
