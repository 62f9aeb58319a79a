//! What draws read from the program's memory: for whoever has to keep it.

use afterglow_api::constants::*;

use crate::arrays::{Array, COLOR_INDEX, EDGE_FLAG, Pointer, Source};
use crate::context::Context;
use crate::frame::{SLOTS, Slot};
use crate::gather::component_bytes;
use crate::limits;

/// An array that is enabled and in the program's memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryArray {
    /// GL_VERTEX_ARRAY and so on.
    pub array: u32,
    /// The texture unit of coordinates, from 0.
    pub unit: usize,
    /// Components.
    pub size: u8,
    /// GL_FLOAT and so on.
    pub kind: u32,
    /// Bytes from one element to the next as the program said: 0 if they are packed.
    pub stride: u32,
    /// The first element.
    pub address: usize,
}

impl MemoryArray {
    /// Bytes of one element.
    pub fn element_bytes(&self) -> usize {
        usize::from(self.size) * component_bytes(self.kind)
    }

    /// Bytes from the first element to the end of the last of `count`.
    pub fn bytes(&self, count: usize) -> Option<usize> {
        let element = self.element_bytes();
        let stride = if self.stride == 0 { element } else { self.stride as usize };
        count.checked_sub(1).map_or(Some(0), |gaps| gaps.checked_mul(stride)?.checked_add(element))
    }

    fn of(slot: usize, array: &Array) -> Option<MemoryArray> {
        let Source::Memory(address) = array.source else { return None };
        let &Array { enabled: true, size, kind, stride, .. } = array else { return None };
        let (name, unit) = name_of(slot);
        Some(MemoryArray { array: name, unit, size, kind, stride, address })
    }
}

fn name_of(slot: usize) -> (u32, usize) {
    const TEXTURE: usize = Slot::Texture0 as usize;
    let name = match slot {
        EDGE_FLAG => GL_EDGE_FLAG_ARRAY,
        COLOR_INDEX => GL_INDEX_ARRAY,
        TEXTURE..SLOTS => return (GL_TEXTURE_COORD_ARRAY, slot - TEXTURE),
        slot if slot == Slot::Position as usize => GL_VERTEX_ARRAY,
        slot if slot == Slot::Normal as usize => GL_NORMAL_ARRAY,
        slot if slot == Slot::Color as usize => GL_COLOR_ARRAY,
        slot if slot == Slot::Secondary as usize => GL_SECONDARY_COLOR_ARRAY,
        _ => GL_FOG_COORDINATE_ARRAY,
    };
    (name, 0)
}

impl Context {
    /// Enabled arrays in the program's memory; the vertices come first.
    pub fn memory_arrays(&self) -> impl Iterator<Item = MemoryArray> {
        let arrays = self.client.arrays.iter().enumerate();
        arrays.filter_map(|(slot, array)| MemoryArray::of(slot, array))
    }

    /// Whether a draw of so many vertices reads arrays at all; one in error may not.
    pub fn reads_arrays(&self, vertices: usize) -> bool {
        let has_positions = self.client.arrays[Slot::Position as usize].is_read();
        has_positions && !self.in_begin() && (1..=limits::DRAW_VERTICES).contains(&vertices)
    }

    /// Whether a buffer is bound to GL_ARRAY_BUFFER, so that pointers are offsets.
    pub fn has_array_buffer(&self) -> bool {
        self.client.array_buffer.is_some()
    }

    /// Whether a buffer is bound to GL_ELEMENT_ARRAY_BUFFER, so that indices are at an offset.
    pub fn has_element_buffer(&self) -> bool {
        self.client.element_buffer.is_some()
    }

    /// glClientActiveTexture, from 0.
    pub fn client_texture_unit(&self) -> usize {
        self.client.active_texture
    }

    /// How many vertices glLockArrays names, counted from the first of the arrays; 0 if they are not locked.
    pub fn locked_vertices(&self) -> usize {
        let (first, count) = self.client.locked.unwrap_or((0, 0));
        (i64::from(first) + i64::from(count)).try_into().unwrap_or(0)
    }

    /// How many vertices a draw by index reads, counted from the first of the arrays; 0 where it is in error.
    pub fn indexed_vertices(&mut self, count: i32, kind: u32, indices: Pointer) -> usize {
        let count = usize::try_from(count).unwrap_or(0);
        if count > limits::DRAW_VERTICES || index_bytes(kind).is_none() {
            return 0;
        }
        let mut values = Vec::new();
        self.read_indices(count, kind, indices, &mut values);
        values.iter().max().map_or(0, |greatest| *greatest as usize + 1)
    }
}

/// Bytes of an index; `None` if indices have no such type.
pub fn index_bytes(kind: u32) -> Option<usize> {
    matches!(kind, GL_UNSIGNED_BYTE | GL_UNSIGNED_SHORT | GL_UNSIGNED_INT).then(|| component_bytes(kind))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::NullBackend;
    use crate::shared::SharedNames;

    #[test]
    fn enabled_arrays_in_memory_are_found() {
        let mut gl = Context::new(Box::new(NullBackend), SharedNames::default());
        gl.enable_client_state(GL_VERTEX_ARRAY);
        gl.client_active_texture(GL_TEXTURE1);
        gl.enable_client_state(GL_TEXTURE_COORD_ARRAY);
        gl.vertex_pointer(3, GL_FLOAT, 16, Pointer::Memory(64));
        gl.tex_coord_pointer(2, GL_SHORT, 0, Pointer::Memory(128));
        gl.color_pointer(4, GL_FLOAT, 0, Pointer::Memory(256));
        let [vertices, coordinates] = gl.memory_arrays().collect::<Vec<_>>().try_into().unwrap();
        assert_eq!((vertices.array, vertices.address), (GL_VERTEX_ARRAY, 64));
        assert_eq!(vertices.bytes(3), Some(44));
        assert_eq!((coordinates.array, coordinates.unit), (GL_TEXTURE_COORD_ARRAY, 1));
        assert_eq!((coordinates.bytes(3), coordinates.bytes(0)), (Some(12), Some(0)));
        assert!(gl.reads_arrays(1) && !gl.reads_arrays(0) && !gl.reads_arrays(limits::DRAW_VERTICES + 1));
        gl.disable_client_state(GL_VERTEX_ARRAY);
        assert!(!gl.reads_arrays(1));
    }

    #[test]
    fn the_greatest_index_tells_how_many_vertices_are_read() {
        let mut gl = Context::new(Box::new(NullBackend), SharedNames::default());
        let indices = || Pointer::Blob([3u8, 9, 4].as_slice().into());
        assert_eq!(gl.indexed_vertices(3, GL_UNSIGNED_BYTE, indices()), 10);
        assert_eq!(gl.indexed_vertices(1, GL_UNSIGNED_BYTE, indices()), 4);
        assert_eq!(gl.indexed_vertices(3, GL_FLOAT, indices()), 0);
        assert_eq!(gl.indexed_vertices(-1, GL_UNSIGNED_BYTE, indices()), 0);
    }
}
