//! Client arrays: what glVertexPointer and its like say, and which buffers are bound.

use std::sync::Arc;

use afterglow_api::constants::*;

use crate::context::Context;
use crate::frame::{SLOTS, Slot, TEXTURE_UNITS};
use crate::shared::SharedBuffer;

/// Where the elements of an array are.
#[derive(Debug, Clone, Default)]
pub enum Pointer {
    /// Nowhere.
    #[default]
    Null,
    /// At an offset in the buffer that is bound when the pointer is set.
    Offset(u64),
    /// In the program's memory, at an address. Whoever makes one promises that it can be read as far as
    /// the draws that use it reach.
    Memory(usize),
    /// In bytes kept for the purpose.
    Blob(Arc<[u8]>),
}

/// The bytes that a [`Pointer`] was resolved to when it was set.
#[derive(Debug, Clone, Default)]
pub enum Source {
    /// Nothing.
    #[default]
    Null,
    /// A buffer object from an offset.
    Buffer(u32, SharedBuffer, u64),
    /// An address of the program's.
    Memory(usize),
    /// Bytes.
    Blob(Arc<[u8]>),
}

/// One array.
#[derive(Debug, Clone)]
pub struct Array {
    /// glEnableClientState.
    pub enabled: bool,
    /// Components, 1 to 4.
    pub size: u8,
    /// GL_FLOAT and so on.
    pub kind: u32,
    /// Bytes from one element to the next; 0 if they are packed.
    pub stride: u32,
    /// The elements.
    pub source: Source,
}

impl Array {
    /// Whether draws read it. A program that enables an array and never says where it is gets the current
    /// value, as other libraries have it.
    pub fn is_read(&self) -> bool {
        self.enabled && !matches!(self.source, Source::Null)
    }
}

/// The edge flags' slot among the arrays; it comes after the vertex attributes.
pub const EDGE_FLAG: usize = SLOTS;
/// The colour indices' slot.
pub const COLOR_INDEX: usize = SLOTS + 1;

/// State of the client (specification 6.2, table 6.6 to 6.9).
#[derive(Debug, Clone)]
pub struct ClientState {
    /// By [`Slot`], then edge flags and colour indices.
    pub arrays: [Array; SLOTS + 2],
    /// glClientActiveTexture, from 0.
    pub active_texture: usize,
    /// GL_ARRAY_BUFFER.
    pub array_buffer: Option<(u32, SharedBuffer)>,
    /// GL_ELEMENT_ARRAY_BUFFER.
    pub element_buffer: Option<(u32, SharedBuffer)>,
    /// glLockArrays: first and count.
    pub locked: Option<(i32, i32)>,
}

impl Default for ClientState {
    fn default() -> ClientState {
        let array = |slot: usize| Array {
            enabled: false,
            size: match slot {
                1 | 3 => 3,
                4 | EDGE_FLAG | COLOR_INDEX => 1,
                _ => 4,
            },
            kind: GL_FLOAT,
            stride: 0,
            source: Source::Null,
        };
        ClientState {
            arrays: std::array::from_fn(array),
            active_texture: 0,
            array_buffer: None,
            element_buffer: None,
            locked: None,
        }
    }
}

impl ClientState {
    /// The binding of a buffer target.
    pub fn binding_mut(&mut self, target: u32) -> Option<&mut Option<(u32, SharedBuffer)>> {
        match target {
            GL_ARRAY_BUFFER => Some(&mut self.array_buffer),
            GL_ELEMENT_ARRAY_BUFFER => Some(&mut self.element_buffer),
            _ => None,
        }
    }

    /// Where in the element buffer `pointer` is, if there is one.
    pub fn element_offset(&self, pointer: &Pointer) -> Option<usize> {
        self.element_buffer.as_ref()?;
        match pointer {
            Pointer::Offset(offset) => usize::try_from(*offset).ok(),
            Pointer::Null => Some(0),
            Pointer::Memory(offset) => Some(*offset),
            Pointer::Blob(_) => None,
        }
    }

    /// Forgets a deleted buffer.
    pub fn unbind(&mut self, name: u32) {
        for binding in [&mut self.array_buffer, &mut self.element_buffer] {
            if binding.as_ref().is_some_and(|(bound, _)| *bound == name) {
                *binding = None;
            }
        }
        for array in &mut self.arrays {
            if matches!(array.source, Source::Buffer(bound, ..) if bound == name) {
                array.source = Source::Null;
            }
        }
    }

    /// The array that a client state names.
    pub fn slot_of(&self, array: u32) -> Option<usize> {
        Some(match array {
            GL_VERTEX_ARRAY => Slot::Position as usize,
            GL_NORMAL_ARRAY => Slot::Normal as usize,
            GL_COLOR_ARRAY => Slot::Color as usize,
            GL_SECONDARY_COLOR_ARRAY => Slot::Secondary as usize,
            GL_FOG_COORDINATE_ARRAY => Slot::Fog as usize,
            GL_TEXTURE_COORD_ARRAY => Slot::Texture0 as usize + self.active_texture,
            GL_EDGE_FLAG_ARRAY => EDGE_FLAG,
            GL_INDEX_ARRAY => COLOR_INDEX,
            _ => return None,
        })
    }
}

const COORDINATES: [u32; 4] = [GL_SHORT, GL_INT, GL_FLOAT, GL_DOUBLE];
const NORMALS: [u32; 5] = [GL_BYTE, GL_SHORT, GL_INT, GL_FLOAT, GL_DOUBLE];
const COLORS: [u32; 8] =
    [GL_BYTE, GL_UNSIGNED_BYTE, GL_SHORT, GL_UNSIGNED_SHORT, GL_INT, GL_UNSIGNED_INT, GL_FLOAT, GL_DOUBLE];

impl Context {
    fn set_array(
        &mut self,
        slot: usize,
        shape: (i32, u32, i32),
        sizes: &[i32],
        kinds: &[u32],
        pointer: Pointer,
    ) {
        if self.refuses_in_begin() {
            return;
        }
        let (size, kind, stride) = shape;
        if !sizes.contains(&size) || stride < 0 {
            return self.record_error(GL_INVALID_VALUE);
        }
        if !kinds.contains(&kind) {
            return self.record_error(GL_INVALID_ENUM);
        }
        let source = match (pointer, &self.client.array_buffer) {
            (Pointer::Offset(offset), Some((name, buffer))) => Source::Buffer(*name, buffer.clone(), offset),
            (Pointer::Null, Some((name, buffer))) => Source::Buffer(*name, buffer.clone(), 0),
            (Pointer::Memory(address), None) => Source::Memory(address),
            (Pointer::Memory(offset), Some((name, buffer))) => {
                Source::Buffer(*name, buffer.clone(), offset as u64)
            }
            (Pointer::Blob(bytes), _) => Source::Blob(bytes),
            (Pointer::Null | Pointer::Offset(_), None) => Source::Null,
        };
        let array = &mut self.client.arrays[slot];
        (array.size, array.kind, array.stride, array.source) = (size as u8, kind, stride as u32, source);
    }

    /// glVertexPointer.
    pub fn vertex_pointer(&mut self, size: i32, kind: u32, stride: i32, pointer: Pointer) {
        self.set_array(Slot::Position as usize, (size, kind, stride), &[2, 3, 4], &COORDINATES, pointer);
    }

    /// glNormalPointer.
    pub fn normal_pointer(&mut self, kind: u32, stride: i32, pointer: Pointer) {
        self.set_array(Slot::Normal as usize, (3, kind, stride), &[3], &NORMALS, pointer);
    }

    /// glColorPointer.
    pub fn color_pointer(&mut self, size: i32, kind: u32, stride: i32, pointer: Pointer) {
        self.set_array(Slot::Color as usize, (size, kind, stride), &[3, 4], &COLORS, pointer);
    }

    /// glSecondaryColorPointer.
    pub fn secondary_color_pointer(&mut self, size: i32, kind: u32, stride: i32, pointer: Pointer) {
        self.set_array(Slot::Secondary as usize, (size, kind, stride), &[3], &COLORS, pointer);
    }

    /// glFogCoordPointer.
    pub fn fog_coord_pointer(&mut self, kind: u32, stride: i32, pointer: Pointer) {
        self.set_array(Slot::Fog as usize, (1, kind, stride), &[1], &[GL_FLOAT, GL_DOUBLE], pointer);
    }

    /// glTexCoordPointer.
    pub fn tex_coord_pointer(&mut self, size: i32, kind: u32, stride: i32, pointer: Pointer) {
        let slot = Slot::Texture0 as usize + self.client.active_texture;
        self.set_array(slot, (size, kind, stride), &[1, 2, 3, 4], &COORDINATES, pointer);
    }

    /// glEdgeFlagPointer.
    pub fn edge_flag_pointer(&mut self, stride: i32, pointer: Pointer) {
        self.set_array(EDGE_FLAG, (1, GL_UNSIGNED_BYTE, stride), &[1], &[GL_UNSIGNED_BYTE], pointer);
    }

    /// glIndexPointer: kept, and not used without colour index mode.
    pub fn index_pointer(&mut self, kind: u32, stride: i32, pointer: Pointer) {
        let kinds = [GL_UNSIGNED_BYTE, GL_SHORT, GL_INT, GL_FLOAT, GL_DOUBLE];
        self.set_array(COLOR_INDEX, (1, kind, stride), &[1], &kinds, pointer);
    }

    /// glEnableClientState.
    pub fn enable_client_state(&mut self, array: u32) {
        self.switch_array(array, true);
    }

    /// glDisableClientState.
    pub fn disable_client_state(&mut self, array: u32) {
        self.switch_array(array, false);
    }

    fn switch_array(&mut self, array: u32, on: bool) {
        if self.refuses_in_begin() {
            return;
        }
        match self.client.slot_of(array) {
            Some(slot) => self.client.arrays[slot].enabled = on,
            None => self.record_error(GL_INVALID_ENUM),
        }
    }

    /// glClientActiveTexture.
    pub fn client_active_texture(&mut self, unit: u32) {
        match unit.wrapping_sub(GL_TEXTURE0) as usize {
            unit if unit < TEXTURE_UNITS => self.client.active_texture = unit,
            _ => self.record_error(GL_INVALID_ENUM),
        }
    }

    /// glLockArraysEXT. The arrays are read at each draw all the same.
    pub fn lock_arrays(&mut self, first: i32, count: i32) {
        if first < 0 || count <= 0 {
            return self.record_error(GL_INVALID_VALUE);
        }
        if self.client.locked.is_some() || self.in_begin() {
            return self.record_error(GL_INVALID_OPERATION);
        }
        self.client.locked = Some((first, count));
    }

    /// glUnlockArraysEXT.
    pub fn unlock_arrays(&mut self) {
        if self.client.locked.take().is_none() || self.in_begin() {
            self.record_error(GL_INVALID_OPERATION);
        }
    }

    /// glInterleavedArrays (specification 2.8, table 2.5).
    pub fn interleaved_arrays(&mut self, format: u32, stride: i32, pointer: Pointer) {
        if self.refuses_in_begin() {
            return;
        }
        // Components of texture coordinates, colour, vertex; colour type; normals.
        let (texture, color, color_kind, normal, vertex) = match format {
            GL_V2F => (0, 0, 0, false, 2),
            GL_V3F => (0, 0, 0, false, 3),
            GL_C4UB_V2F => (0, 4, GL_UNSIGNED_BYTE, false, 2),
            GL_C4UB_V3F => (0, 4, GL_UNSIGNED_BYTE, false, 3),
            GL_C3F_V3F => (0, 3, GL_FLOAT, false, 3),
            GL_N3F_V3F => (0, 0, 0, true, 3),
            GL_C4F_N3F_V3F => (0, 4, GL_FLOAT, true, 3),
            GL_T2F_V3F => (2, 0, 0, false, 3),
            GL_T4F_V4F => (4, 0, 0, false, 4),
            GL_T2F_C4UB_V3F => (2, 4, GL_UNSIGNED_BYTE, false, 3),
            GL_T2F_C3F_V3F => (2, 3, GL_FLOAT, false, 3),
            GL_T2F_N3F_V3F => (2, 0, 0, true, 3),
            GL_T2F_C4F_N3F_V3F => (2, 4, GL_FLOAT, true, 3),
            GL_T4F_C4F_N3F_V4F => (4, 4, GL_FLOAT, true, 4),
            _ => return self.record_error(GL_INVALID_ENUM),
        };
        if stride < 0 {
            return self.record_error(GL_INVALID_VALUE);
        }
        let color_bytes = if color_kind == GL_UNSIGNED_BYTE { 4 } else { 4 * color };
        let color_at = 4 * texture;
        let normal_at = color_at + color_bytes;
        let vertex_at = normal_at + if normal { 12 } else { 0 };
        let stride = if stride == 0 { vertex_at + 4 * vertex } else { stride };
        for array in [GL_EDGE_FLAG_ARRAY, GL_INDEX_ARRAY, GL_SECONDARY_COLOR_ARRAY, GL_FOG_COORDINATE_ARRAY] {
            self.switch_array(array, false);
        }
        self.switch_array(GL_TEXTURE_COORD_ARRAY, texture > 0);
        self.switch_array(GL_COLOR_ARRAY, color > 0);
        self.switch_array(GL_NORMAL_ARRAY, normal);
        self.switch_array(GL_VERTEX_ARRAY, true);
        if texture > 0 {
            self.tex_coord_pointer(texture, GL_FLOAT, stride, pointer.clone());
        }
        if color > 0 {
            self.color_pointer(color, color_kind, stride, pointer.advanced(color_at as usize));
        }
        if normal {
            self.normal_pointer(GL_FLOAT, stride, pointer.advanced(normal_at as usize));
        }
        self.vertex_pointer(vertex, GL_FLOAT, stride, pointer.advanced(vertex_at as usize));
    }
}

impl Pointer {
    /// The pointer `bytes` further on.
    #[must_use]
    pub fn advanced(&self, bytes: usize) -> Pointer {
        match self {
            Pointer::Null if bytes == 0 => Pointer::Null,
            Pointer::Null => Pointer::Offset(bytes as u64),
            Pointer::Offset(offset) => Pointer::Offset(offset + bytes as u64),
            Pointer::Memory(address) => Pointer::Memory(address + bytes),
            Pointer::Blob(blob) => Pointer::Blob(blob.get(bytes..).unwrap_or(&[]).into()),
        }
    }
}
