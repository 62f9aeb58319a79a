//! Drawing from arrays. Arrays in buffer objects that did not change since they were drawn before
//! become retained ranges; all others are copied into the frame.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use afterglow_api::constants::*;

use crate::arrays::{EDGE_FLAG, Pointer, Source};
use crate::assemble::{self, PolygonMode};
use crate::context::Context;
use crate::emit::Kind;
use crate::frame::{RetainedRange, SLOTS, Slot, VertexLayout};
use crate::gather::{Elements, Shape, component_bytes, stored_format};
use crate::limits;

/// Vertices from which it is worth while to copy them once.
const MANY: usize = 64;

/// Which vertices a draw takes, in order.
enum Selection<'a> {
    Consecutive { first: usize, count: usize },
    Indexed { indices: &'a [u32], least: usize, count: usize },
}

impl Selection<'_> {
    /// First vertex and number of vertices that are read.
    fn span(&self) -> (usize, usize) {
        match *self {
            Selection::Consecutive { first, count } => (first, count),
            Selection::Indexed { least, count, .. } => (least, count),
        }
    }
}

impl Context {
    /// glDrawArrays.
    pub fn draw_arrays(&mut self, mode: u32, first: i32, count: i32) {
        if !self.may_draw(mode) {
            return;
        }
        let (Ok(first), Ok(count)) = (usize::try_from(first), usize::try_from(count)) else {
            return self.record_error(GL_INVALID_VALUE);
        };
        let key = self.retained_key(mode, (first, count));
        if !self.draw_known(mode, key) {
            self.draw_selection(mode, Selection::Consecutive { first, count }, key);
        }
    }

    /// glDrawElements.
    pub fn draw_elements(&mut self, mode: u32, count: i32, kind: u32, indices: Pointer) {
        if !self.may_draw(mode) {
            return;
        }
        if !matches!(kind, GL_UNSIGNED_BYTE | GL_UNSIGNED_SHORT | GL_UNSIGNED_INT) {
            return self.record_error(GL_INVALID_ENUM);
        }
        let Ok(count) = usize::try_from(count) else { return self.record_error(GL_INVALID_VALUE) };
        if count > limits::DRAW_VERTICES {
            return self.record_error(GL_OUT_OF_MEMORY);
        }
        let mut key = match (&self.client.element_buffer, self.client.element_offset(&indices)) {
            (Some((_, buffer)), Some(offset)) => {
                self.retained_key(mode, (buffer.version(), offset, kind, count))
            }
            _ => None,
        };
        if self.draw_known(mode, key) {
            return;
        }
        let mut values = std::mem::take(&mut self.scratch.indices);
        values.clear();
        if self.read_indices(count, kind, indices, &mut values) && !values.is_empty() {
            key = key.or_else(|| self.retained_key(mode, &values));
            if !self.draw_known(mode, key) {
                let (least, greatest) = values.iter().fold((u32::MAX, 0), |(l, g), &i| (l.min(i), g.max(i)));
                let span = (greatest - least) as usize + 1;
                let selection = Selection::Indexed { indices: &values, least: least as usize, count: span };
                self.draw_selection(mode, selection, key);
            }
        }
        self.scratch.indices = values;
    }

    /// glDrawRangeElements.
    pub fn draw_range_elements(
        &mut self,
        mode: u32,
        start: u32,
        end: u32,
        count: i32,
        kind: u32,
        indices: Pointer,
    ) {
        if end < start {
            return self.record_error(GL_INVALID_VALUE);
        }
        self.draw_elements(mode, count, kind, indices);
    }

    /// glMultiDrawArrays.
    pub fn multi_draw_arrays(&mut self, mode: u32, firsts: &[i32], counts: &[i32]) {
        if counts.iter().any(|count| *count < 0) {
            return self.record_error(GL_INVALID_VALUE);
        }
        for (&first, &count) in firsts.iter().zip(counts).filter(|(_, c)| **c > 0) {
            self.draw_arrays(mode, first, count);
        }
    }

    /// glMultiDrawElements.
    pub fn multi_draw_elements(&mut self, mode: u32, counts: &[i32], kind: u32, indices: Vec<Pointer>) {
        if counts.iter().any(|count| *count < 0) {
            return self.record_error(GL_INVALID_VALUE);
        }
        for (&count, pointer) in counts.iter().zip(indices).filter(|(c, _)| **c > 0) {
            self.draw_elements(mode, count, kind, pointer);
        }
    }

    /// glArrayElement.
    pub fn array_element(&mut self, i: i32) {
        let Ok(i) = usize::try_from(i) else { return self.record_error(GL_INVALID_VALUE) };
        // The position comes last, since it makes the vertex.
        for slot in (0..=EDGE_FLAG).rev() {
            if !self.client.arrays[slot].is_read() {
                continue;
            }
            let value = self.with_elements(slot, i, 1, |elements| elements.first()).flatten();
            match (value, slot) {
                (Some(value), 0) => self.vertex(value),
                (Some(value), EDGE_FLAG) => self.edge_flag(value[0] != 0.0),
                (Some(value), _) => self.attribute(slot, value),
                (None, _) => {}
            }
        }
    }

    fn may_draw(&mut self, mode: u32) -> bool {
        if !assemble::is_mode(mode) {
            self.record_error(GL_INVALID_ENUM);
            return false;
        }
        if self.in_begin() {
            self.refuse();
            return false;
        }
        true
    }

    /// Draws what was kept under the key, if there is such a range.
    fn draw_known(&mut self, mode: u32, key: Option<u64>) -> bool {
        let Some(range) = key.and_then(|key| self.ranges.get(key).cloned()) else { return false };
        self.emit_retained(range, Kind::of(mode, PolygonMode::Fill));
        true
    }

    /// Draws from arrays; `key` names what is read, if it may be kept.
    fn draw_selection(&mut self, mode: u32, selection: Selection, key: Option<u64>) {
        let (first, count) = selection.span();
        if count == 0 || !self.client.arrays[Slot::Position as usize].is_read() {
            return;
        }
        if count > limits::DRAW_VERTICES {
            return self.record_error(GL_OUT_OF_MEMORY);
        }
        let polygon_mode =
            if self.list.is_some() { PolygonMode::Fill } else { self.effective_polygon_mode() };
        let kind = Kind::of(mode, polygon_mode);
        if key.is_none() && self.draw_in_order(mode, &selection) {
            return;
        }
        let mut words = std::mem::take(&mut self.scratch.words);
        let mut indices = std::mem::take(&mut self.scratch.assembled);
        if let Some(layout) = self.gather(first, count, &mut words) {
            self.assemble_selection(mode, polygon_mode, &selection, &mut indices);
            if let Some(list) = &mut self.list {
                list.geometry(layout, kind, &words, &indices);
            }
            if let Some(key) = key.filter(|key| self.ranges.is_drawn_again(*key)) {
                let range = Arc::new(RetainedRange::new(layout, words.clone(), indices.clone()));
                self.ranges.keep(key, range.clone());
                self.emit_retained(range, kind);
            } else if self.list.as_ref().is_none_or(|list| list.executes) {
                self.emit_indexed(layout, kind, &words, &indices);
            }
        }
        (self.scratch.words, self.scratch.assembled) = (words, indices);
    }

    /// Draws many consecutive vertices of the program's memory: they are copied once, and their indices are shared.
    /// `false` if they must go another way.
    fn draw_in_order(&mut self, mode: u32, selection: &Selection) -> bool {
        let Selection::Consecutive { first, count } = *selection else { return false };
        if count < MANY || self.list.is_some() || !self.reaches(first, count) {
            return false;
        }
        let layout = self.array_layout();
        self.emit_in_order(mode, layout, count, |gl, words| gl.append_elements(layout, first, count, words))
    }

    fn assemble_selection(
        &self,
        mode: u32,
        polygon_mode: PolygonMode,
        selection: &Selection,
        out: &mut Vec<u32>,
    ) {
        out.clear();
        let (indices, least, count) = match *selection {
            Selection::Consecutive { count, .. } => (None, 0, count),
            Selection::Indexed { indices, least, .. } => (Some(indices), least as u32, indices.len()),
        };
        let vertex = |i: usize| indices.map_or(i as u32, |indices| indices[i] - least);
        let polygons = matches!(Kind::of(mode, polygon_mode), Kind::Polygons(_));
        if polygons && polygon_mode != PolygonMode::Fill {
            assemble::assemble_unfilled(mode, count, polygon_mode, vertex, |_| true, out);
        } else {
            assemble::assemble(mode, count, vertex, out);
        }
    }

    /// Copies `count` vertices from vertex `first` on; `None` if the positions do not reach that far. Other
    /// arrays that end early give zeros: what they would give is undefined, and the rest of the draw is good.
    fn gather(&mut self, first: usize, count: usize, out: &mut Vec<u32>) -> Option<VertexLayout> {
        // Checked before memory is taken for what the arrays claim to hold.
        if !self.reaches(first, count) {
            return None;
        }
        let layout = self.array_layout();
        out.clear();
        self.append_elements(layout, first, count, out);
        Some(layout)
    }

    /// Whether the positions reach that far.
    fn reaches(&self, first: usize, count: usize) -> bool {
        self.with_elements(Slot::Position as usize, first, count, |e| e.count == count) == Some(true)
    }

    /// The layout of vertices from the arrays that are read.
    fn array_layout(&self) -> VertexLayout {
        let arrays = self.client.arrays[..SLOTS].iter().enumerate().filter(|(_, array)| array.is_read());
        arrays.fold(VertexLayout::default(), |layout, (slot, array)| {
            layout.with(slot, stored_format(array.size, array.kind, is_normalized(slot)))
        })
    }

    /// Appends `count` vertices from vertex `first` on.
    fn append_elements(&self, layout: VertexLayout, first: usize, count: usize, out: &mut Vec<u32>) {
        let stride = layout.stride();
        let read = |slot: &usize| self.client.arrays[*slot].is_read();
        if (0..SLOTS).filter(read).count() == 1
            && self.with_elements(Slot::Position as usize, first, count, |e| e.append_packed(stride, out))
                == Some(true)
        {
            return;
        }
        let start = out.len();
        out.resize(start + count * stride, 0);
        for slot in (0..SLOTS).filter(read) {
            let (format, offset) = (layout.format(slot), layout.offset(slot));
            self.with_elements(slot, first, count, |e| e.store(format, &mut out[start..], offset, stride));
        }
    }

    /// Calls `f` with those of the elements `first` to `first + count` that an array has.
    fn with_elements<R>(
        &self,
        slot: usize,
        first: usize,
        count: usize,
        f: impl FnOnce(Elements) -> R,
    ) -> Option<R> {
        let array = &self.client.arrays[slot];
        let (size, kind) = (array.size as usize, array.kind);
        let stride = match array.stride as usize {
            0 => size * component_bytes(kind),
            stride => stride,
        };
        let start = first.checked_mul(stride)?;
        let shape = Shape { stride, size, kind, normalized: is_normalized(slot) };
        match &array.source {
            Source::Null => None,
            Source::Blob(bytes) => Some(f(shape.elements(bytes.get(start..)?, count))),
            Source::Buffer(_, buffer, offset) => {
                let buffer = buffer.lock();
                let bytes = buffer.data.get(usize::try_from(*offset).ok()?..)?.get(start..)?;
                Some(f(shape.elements(bytes, count)))
            }
            Source::Memory(address) => {
                let (address, needed) = (address.checked_add(start)?, shape.bytes(count)?);
                // SAFETY: whoever made the pointer promised that the program's memory can be read as far
                // as its draws reach (the contract of glVertexPointer).
                let bytes = unsafe { std::slice::from_raw_parts(address as *const u8, needed) };
                Some(f(shape.elements(bytes, count)))
            }
        }
    }

    /// Reads indices; false if they are not there.
    pub(crate) fn read_indices(
        &mut self,
        count: usize,
        kind: u32,
        pointer: Pointer,
        out: &mut Vec<u32>,
    ) -> bool {
        let needed = count * component_bytes(kind);
        let offset = self.client.element_offset(&pointer);
        match (offset, &self.client.element_buffer, &pointer) {
            (Some(offset), Some((_, buffer)), _) => {
                let buffer = buffer.lock();
                let bytes = buffer.data.get(offset..).and_then(|b| b.get(..needed));
                bytes.map(|bytes| widen(kind, bytes, out)).is_some()
            }
            (_, _, Pointer::Blob(bytes)) => {
                bytes.get(..needed).map(|bytes| widen(kind, bytes, out)).is_some()
            }
            (_, _, Pointer::Memory(address)) if *address != 0 => {
                // SAFETY: the contract of glDrawElements: the program's memory holds `count` indices.
                widen(kind, unsafe { std::slice::from_raw_parts(*address as *const u8, needed) }, out);
                true
            }
            _ => false,
        }
    }

    /// Names what the draw would read, if all of it is in buffer objects; `selection` says which vertices. Only what
    /// is drawn as it is has a name: no list is compiled, polygons are filled.
    fn retained_key(&self, mode: u32, selection: impl Hash) -> Option<u64> {
        let polygons = matches!(Kind::of(mode, PolygonMode::Fill), Kind::Polygons(_));
        if self.list.is_some() || polygons && self.effective_polygon_mode() != PolygonMode::Fill {
            return None;
        }
        let mut hasher = self.ranges.hasher();
        (mode, selection).hash(&mut hasher);
        for (slot, array) in self.client.arrays[..SLOTS].iter().enumerate().filter(|(_, a)| a.is_read()) {
            let Source::Buffer(_, buffer, offset) = &array.source else { return None };
            let shape = (slot as u64) << 56 | u64::from(array.size) << 48 | u64::from(array.kind);
            (shape, buffer.version(), *offset, array.stride).hash(&mut hasher);
        }
        Some(hasher.finish())
    }
}

/// Whether integers of an array mean fractions (specification 2.8).
fn is_normalized(slot: usize) -> bool {
    (Slot::Normal as usize..=Slot::Secondary as usize).contains(&slot)
}

fn widen(kind: u32, bytes: &[u8], out: &mut Vec<u32>) {
    match kind {
        GL_UNSIGNED_BYTE => out.extend(bytes.iter().map(|&b| u32::from(b))),
        GL_UNSIGNED_SHORT => {
            out.extend(bytes.as_chunks::<2>().0.iter().map(|&b| u32::from(u16::from_le_bytes(b))))
        }
        _ => out.extend(bytes.as_chunks::<4>().0.iter().map(|&b| u32::from_le_bytes(b))),
    }
}
