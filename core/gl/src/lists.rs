//! Display lists. Vertices are compiled to ranges that outlive frames; everything else is kept as
//! commands, which meet the state of the moment when the list is called (specification 5.4).

use std::sync::Arc;

use afterglow_api::constants::*;
use glam::Vec4;

use crate::assemble::{self, PolygonMode};
use crate::commands::Command;
use crate::context::Context;
use crate::emit::Kind;
use crate::frame::{RetainedRange, SLOTS, VertexLayout};
use crate::immediate::Immediate;
use crate::limits;
use crate::params::Values;

/// One step of a compiled list.
#[derive(Debug)]
pub enum ListItem {
    /// A command.
    Command(Command),
    /// Vertices and indices, complete in themselves.
    Draw(Arc<RetainedRange>, Kind),
    /// A primitive that depends on the state of the moment: attributes that it inherits halfway, or
    /// polygons whose edges matter if they are not filled.
    Primitive(Box<ListPrimitive>),
    /// A current attribute.
    Attribute(usize, [f32; 4]),
    /// glEdgeFlag.
    EdgeFlag(bool),
    /// glIndex.
    Index(f32),
    /// glVertex outside of the list's own Begin and End.
    LooseVertex([f32; 4]),
    /// glMaterial.
    Material(u32, u32, Values),
    /// glCallList.
    Call(u32),
    /// glCallLists: the base is that of the moment.
    Calls(Arc<[u32]>),
}

/// A primitive as it was sent.
#[derive(Debug)]
pub struct ListPrimitive {
    mode: u32,
    layout: VertexLayout,
    words: Vec<u32>,
    edges: Vec<bool>,
    /// Slot and number of first vertices that take the current value.
    late: Vec<(usize, usize)>,
}

/// A compiled list.
#[derive(Debug, Default)]
pub struct List {
    items: Vec<ListItem>,
}

/// A list while it is compiled.
#[derive(Debug)]
pub struct ListBuilder {
    name: u32,
    /// GL_COMPILE_AND_EXECUTE.
    pub executes: bool,
    items: Vec<ListItem>,
    run: Run,
    /// Attributes between Begin and End: their last values, current once the primitive is drawn.
    inside: [Vec4; SLOTS],
    /// Which of them were given.
    given: [bool; SLOTS],
    /// The edge flag, as far as the list knows it.
    edge: bool,
}

/// Primitives of one kind and layout in a row, which become one range.
#[derive(Debug, Default)]
struct Run {
    shape: Option<(VertexLayout, Kind)>,
    words: Vec<u32>,
    indices: Vec<u32>,
    /// Attributes that are current after the primitives.
    trailing: Vec<(usize, [f32; 4])>,
    /// The edge flag that is, if they have any.
    trailing_edge: Option<bool>,
}

impl ListBuilder {
    /// The name that glNewList was given.
    pub fn name(&self) -> u32 {
        self.name
    }

    /// GL_COMPILE or GL_COMPILE_AND_EXECUTE.
    pub fn mode(&self) -> u32 {
        if self.executes { GL_COMPILE_AND_EXECUTE } else { GL_COMPILE }
    }

    /// Records a command.
    pub fn push(&mut self, command: Command) {
        self.item(ListItem::Command(command));
    }

    fn item(&mut self, item: ListItem) {
        self.end_run();
        self.items.push(item);
    }

    /// Records glVertex outside of Begin and End.
    pub fn loose_vertex(&mut self, position: [f32; 4]) {
        self.item(ListItem::LooseVertex(position));
    }

    /// Records an attribute; between Begin and End it is part of the vertices.
    pub fn attribute(&mut self, slot: usize, value: [f32; 4], inside: bool) {
        if inside {
            (self.inside[slot], self.given[slot]) = (Vec4::from_array(value), true);
        } else {
            self.item(ListItem::Attribute(slot, value));
        }
    }

    /// The attributes that were given between Begin and End; others have no meaning.
    pub fn inside(&self) -> &[Vec4; SLOTS] {
        &self.inside
    }

    /// Records glEdgeFlag; between Begin and End it is part of the vertices, and current after them.
    pub fn edge_flag(&mut self, flag: bool, inside: bool) {
        self.edge = flag;
        if inside {
            self.run.trailing_edge = Some(flag);
        } else {
            self.item(ListItem::EdgeFlag(flag));
        }
    }

    /// The edge flag of vertices.
    pub fn edge(&self) -> bool {
        self.edge
    }

    /// Records glIndex, which no vertex has.
    pub fn index(&mut self, index: f32) {
        self.item(ListItem::Index(index));
    }

    /// Records glMaterial.
    pub fn material(&mut self, face: u32, pname: u32, values: Values) {
        self.item(ListItem::Material(face, pname, values));
    }

    /// Adds assembled vertices.
    pub fn geometry(&mut self, layout: VertexLayout, kind: Kind, words: &[u32], indices: &[u32]) {
        if self.run.shape != Some((layout, kind)) {
            self.end_run();
            self.run.shape = Some((layout, kind));
        }
        let base = (self.run.words.len() / layout.stride().max(1)) as u32;
        self.run.words.extend_from_slice(words);
        self.run.indices.extend(indices.iter().map(|i| i + base));
    }

    fn end_run(&mut self) {
        let run = std::mem::take(&mut self.run);
        if let Some((layout, kind)) = run.shape
            && !run.indices.is_empty()
        {
            let range = RetainedRange::new(layout, run.words, run.indices);
            self.items.push(ListItem::Draw(Arc::new(range), kind));
        }
        self.items.extend(run.trailing_edge.map(ListItem::EdgeFlag));
        self.items.extend(run.trailing.into_iter().map(|(slot, value)| ListItem::Attribute(slot, value)));
    }

    fn primitive(&mut self, mode: u32, immediate: &mut Immediate) {
        let (layout, late) = (immediate.layout, std::mem::take(&mut immediate.late));
        let edges = immediate.edges.take().unwrap_or_default();
        let kind = Kind::of(mode, PolygonMode::Fill);
        if late.is_empty() && !edges.contains(&false) {
            let mut indices = Vec::new();
            assemble::assemble(mode, immediate.count(), |i| i as u32, &mut indices);
            self.geometry(layout, kind, immediate.words(), &indices);
        } else {
            let words = immediate.words().to_vec();
            self.item(ListItem::Primitive(Box::new(ListPrimitive { mode, layout, words, edges, late })));
        }
        for slot in 0..SLOTS {
            if std::mem::take(&mut self.given[slot]) {
                let value = self.inside[slot].to_array();
                self.run.trailing.retain(|(s, _)| *s != slot);
                self.run.trailing.push((slot, value));
            }
        }
    }
}

impl Context {
    /// glNewList.
    pub fn new_list(&mut self, name: u32, mode: u32) {
        if name == 0 {
            return self.record_error(GL_INVALID_VALUE);
        }
        if mode != GL_COMPILE && mode != GL_COMPILE_AND_EXECUTE {
            return self.record_error(GL_INVALID_ENUM);
        }
        if self.in_begin() || self.list.is_some() {
            return self.record_error(GL_INVALID_OPERATION);
        }
        self.list = Some(Box::new(ListBuilder {
            name,
            executes: mode == GL_COMPILE_AND_EXECUTE,
            items: Vec::new(),
            run: Run::default(),
            inside: [Vec4::ZERO; SLOTS],
            given: [false; SLOTS],
            edge: self.state.current.edge_flag,
        }));
        self.immediate.watch(true);
    }

    /// glEndList.
    pub fn end_list(&mut self) {
        if self.refuses_in_begin() {
            return;
        }
        let Some(mut builder) = self.list.take() else {
            return self.record_error(GL_INVALID_OPERATION);
        };
        self.immediate.watch(false);
        builder.end_run();
        let list = Arc::new(List { items: builder.items });
        self.shared.lock().lists.insert(builder.name, list);
    }

    /// glGenLists.
    pub fn gen_lists(&mut self, range: i32) -> u32 {
        if self.refuses_in_begin() {
            return 0;
        }
        if !(0..=limits::GENERATED_NAMES).contains(&range) {
            self.record_error(GL_INVALID_VALUE);
            return 0;
        }
        self.shared.lock().reserve_lists(range as u32)
    }

    /// glDeleteLists.
    pub fn delete_lists(&mut self, first: u32, range: i32) {
        if self.refuses_in_begin() {
            return;
        }
        if range < 0 {
            return self.record_error(GL_INVALID_VALUE);
        }
        let mut shared = self.shared.lock();
        let end = u64::from(first) + range as u64;
        if range as usize > shared.lists.len() {
            shared.lists.retain(|&name, _| u64::from(name) < first.into() || u64::from(name) >= end);
        } else {
            (u64::from(first)..end).for_each(|name| drop(shared.lists.remove(&(name as u32))));
        }
    }

    /// glIsList.
    pub fn is_list(&mut self, name: u32) -> bool {
        if self.refuses_in_begin() {
            return false;
        }
        self.shared.lock().lists.contains_key(&name)
    }

    /// glCallList.
    pub fn call_list(&mut self, name: u32) {
        if let Some(list) = &mut self.list {
            list.item(ListItem::Call(name));
            if !list.executes {
                return;
            }
        }
        self.lists_left = limits::LIST_EXECUTIONS;
        self.run_list(name);
    }

    /// glCallLists, the offsets without the list base.
    pub fn call_lists(&mut self, offsets: &[u32]) {
        if let Some(list) = &mut self.list {
            list.item(ListItem::Calls(offsets.into()));
            if !list.executes {
                return;
            }
        }
        self.lists_left = limits::LIST_EXECUTIONS.max(offsets.len() as u32);
        self.run_lists(offsets);
    }

    fn run_lists(&mut self, offsets: &[u32]) {
        for offset in offsets {
            self.run_list(self.state.list_base.wrapping_add(*offset));
        }
    }

    fn run_list(&mut self, name: u32) {
        if self.list_depth >= limits::LIST_NESTING {
            return;
        }
        // Lists that call others several times can grow beyond all bounds without being deep.
        let Some(left) = self.lists_left.checked_sub(1) else {
            return self.record_error(GL_OUT_OF_MEMORY);
        };
        self.lists_left = left;
        let Some(list) = self.shared.lock().lists.get(&name).cloned() else { return };
        // What is executed is not compiled again into a list that is open.
        let open = self.list.take();
        self.list_depth += 1;
        list.items.iter().for_each(|item| self.run_item(item));
        self.list_depth -= 1;
        self.list = open;
    }

    fn run_item(&mut self, item: &ListItem) {
        match item {
            ListItem::Command(_) if self.in_begin() => self.record_error(GL_INVALID_OPERATION),
            ListItem::Command(command) => self.execute(command),
            ListItem::Draw(range, kind) => self.run_draw(range, *kind),
            ListItem::Primitive(primitive) => self.run_primitive(primitive),
            ListItem::Attribute(slot, value) => self.attribute(*slot, *value),
            ListItem::EdgeFlag(flag) => self.edge_flag(*flag),
            ListItem::Index(index) => self.index(*index),
            ListItem::LooseVertex(position) => self.vertex(*position),
            ListItem::Material(face, pname, values) => self.exec_material(*face, *pname, *values),
            ListItem::Call(name) => self.run_list(*name),
            ListItem::Calls(offsets) => self.run_lists(offsets),
        }
    }

    fn run_draw(&mut self, range: &Arc<RetainedRange>, kind: Kind) {
        match kind {
            _ if self.in_begin() => self.record_error(GL_INVALID_OPERATION),
            // Triangles remember no polygon: drawn unfilled, they show their own edges.
            Kind::Polygons(_) if self.effective_polygon_mode() != PolygonMode::Fill => {
                let mode = self.effective_polygon_mode();
                let mut indices = Vec::new();
                let corner = |i: usize| range.indices[i];
                let count = range.indices.len();
                assemble::assemble_unfilled(GL_TRIANGLES, count, mode, corner, |_| true, &mut indices);
                self.emit_indexed(range.layout, Kind::Polygons(mode), &range.words, &indices);
            }
            _ => self.emit_retained(range.clone(), kind),
        }
    }

    fn run_primitive(&mut self, primitive: &ListPrimitive) {
        if self.refuses_in_begin() {
            return;
        }
        let mut words = primitive.words.clone();
        let stride = primitive.layout.stride();
        for &(slot, count) in &primitive.late {
            let (offset, width) = (primitive.layout.offset(slot), primitive.layout.format(slot).words());
            let value = self.state.current.attributes[slot].to_array().map(f32::to_bits);
            for vertex in words.chunks_exact_mut(stride).take(count) {
                vertex[offset..offset + width].copy_from_slice(&value[..width]);
            }
        }
        self.emit_primitive(primitive.mode, primitive.layout, &words, Some(&primitive.edges));
    }

    /// glEnd while a list is compiled.
    pub(crate) fn end_in_list(&mut self, mode: u32) {
        let Some(mut list) = self.list.take() else { return };
        let edges = self.immediate.edges.clone();
        list.primitive(mode, &mut self.immediate);
        if list.executes {
            self.immediate.edges = edges;
            self.draw_immediate(mode);
        }
        self.list = Some(list);
    }
}
