//! A machine that executes steps and says of each draw what an oracle asks of it. Unlike the product, it keeps what the
//! program multiplied apart: the stack of matrices, the lists that were called, the names that were bound.

use std::collections::HashMap;
use std::rc::Rc;

use afterglow_api::constants::*;
use glam::{DMat4, Vec3};

use super::step::{Memory, Opacity, Step};
use super::{Drawn, State, triangles};

/// Everything that client state may point to.
#[derive(Debug, Clone)]
struct Client {
    components: usize,
    kind: u32,
    stride: usize,
    memory: Memory,
    buffer: u32,
    has_positions: bool,
}

/// Executes steps.
pub struct Machine {
    state: State,
    shared: Option<Rc<State>>,
    saved: Vec<(u32, State)>,
    client: Client,
    saved_clients: Vec<Client>,
    mode: u32,
    modelview: Vec<DMat4>,
    shared_stack: Option<Rc<[DMat4]>>,
    loaded: DMat4,
    projection: Vec<DMat4>,
    begun: Option<(u32, Vec<Vec3>)>,
    /// By texture.
    opacities: HashMap<u32, Opacity>,
    buffers: HashMap<u32, Vec<u8>>,
    array_buffer: u32,
    index_buffer: u32,
    lists: HashMap<u32, Rc<Vec<Step>>>,
    compiling: Option<(u32, bool, Vec<Step>)>,
    called: Vec<u32>,
    lock: u32,
    clears: u32,
    drawn: Vec<Drawn>,
}

impl Default for Machine {
    fn default() -> Machine {
        Machine {
            state: State::default(),
            shared: None,
            saved: Vec::new(),
            client: Client {
                components: 3,
                kind: GL_FLOAT,
                stride: 0,
                memory: Memory::Offset(0),
                buffer: 0,
                has_positions: false,
            },
            saved_clients: Vec::new(),
            mode: GL_MODELVIEW,
            modelview: vec![DMat4::IDENTITY],
            shared_stack: None,
            loaded: DMat4::IDENTITY,
            projection: vec![DMat4::IDENTITY],
            begun: None,
            opacities: HashMap::new(),
            buffers: HashMap::new(),
            array_buffer: 0,
            index_buffer: 0,
            lists: HashMap::new(),
            compiling: None,
            called: Vec::new(),
            lock: 0,
            clears: 0,
            drawn: Vec::new(),
        }
    }
}

/// How deep lists may call lists (GL_MAX_LIST_NESTING).
const DEEPEST: usize = 64;

impl Machine {
    /// Executes a step. At a buffer swap, the draws of the frame.
    pub fn execute(&mut self, step: Step) -> Option<Vec<Drawn>> {
        let Some((name, executes)) = self.compiling.as_ref().map(|(name, executes, _)| (*name, *executes))
        else {
            return self.perform(&step);
        };
        match &step {
            Step::EndList => {
                let steps = self.compiling.take().map(|(_, _, steps)| steps).unwrap_or_default();
                self.lists.insert(name, Rc::new(steps));
                return None;
            }
            // These are never compiled.
            Step::Positions(..)
            | Step::ClientState(..)
            | Step::PushClient
            | Step::PopClient
            | Step::Buffer(..)
            | Step::BufferData(..)
            | Step::BufferPart(..)
            | Step::Lock(_)
            | Step::Swap => return self.perform(&step),
            _ => {}
        }
        let compiled = match &step {
            Step::Arrays(mode, first, count) => {
                Step::Gathered(*mode, self.gather((*first..first + count).map(Some)).into())
            }
            Step::Elements(mode, count, width, memory) => {
                let indices = self.indices(*count, *width, memory);
                Step::Gathered(*mode, self.gather(indices.into_iter()).into())
            }
            other => other.clone(),
        };
        if executes {
            self.perform(&compiled);
        }
        if let Some((_, _, steps)) = &mut self.compiling {
            steps.push(compiled);
        }
        None
    }

    fn perform(&mut self, step: &Step) -> Option<Vec<Drawn>> {
        match step {
            Step::MatrixMode(mode) => self.mode = *mode,
            Step::Load(matrix) => {
                if self.mode == GL_MODELVIEW {
                    self.loaded = *matrix;
                }
                self.change_matrix(|current| *current = *matrix);
            }
            Step::Multiply(matrix) => self.change_matrix(|current| *current *= *matrix),
            Step::Push => self.change_stack(|stack| stack.extend(stack.last().copied())),
            Step::Pop => self.change_stack(|stack| {
                if stack.len() > 1 {
                    stack.pop();
                }
            }),
            Step::Begin(mode) => self.begun = Some((*mode, Vec::new())),
            Step::Vertex(position) => {
                if let Some((_, positions)) = &mut self.begun {
                    positions.push(*position);
                }
            }
            Step::End => {
                if let Some((mode, positions)) = self.begun.take() {
                    self.draw(mode, &positions, 0);
                }
            }
            Step::Rect([x1, y1, x2, y2]) => {
                let corners = [[x1, y1], [x2, y1], [x2, y2], [x1, y2]];
                self.draw(GL_QUADS, &corners.map(|[x, y]| Vec3::new(*x, *y, 0.0)), 0);
            }
            Step::Arrays(mode, first, count) => {
                let positions = self.gather((*first..first + count).map(Some));
                self.draw(*mode, &positions, self.client.buffer);
            }
            Step::Elements(mode, count, width, memory) => {
                let indices = self.indices(*count, *width, memory);
                let positions = self.gather(indices.into_iter());
                self.draw(*mode, &positions, self.client.buffer);
            }
            Step::Gathered(mode, positions) => self.draw(*mode, positions, 0),
            Step::CallList(name) => self.call(*name),
            Step::NewList(name, executes) => self.compiling = Some((*name, *executes, Vec::new())),
            Step::Clear(mask) => self.clears += u32::from(mask & GL_DEPTH_BUFFER_BIT != 0),
            Step::Lock(is_locked) => self.lock += u32::from(*is_locked),
            Step::Swap => return Some(self.end_frame()),
            Step::Positions(..) | Step::ClientState(..) | Step::PushClient | Step::PopClient => {
                self.change_client(step);
            }
            Step::Buffer(..) | Step::BufferData(..) | Step::BufferPart(..) => self.change_buffer(step),
            Step::EndList => {}
            _ => self.change_state(step),
        }
        None
    }

    fn end_frame(&mut self) -> Vec<Drawn> {
        (self.lock, self.clears) = (0, 0);
        std::mem::take(&mut self.drawn)
    }

    fn call(&mut self, name: u32) {
        if self.called.len() >= DEEPEST {
            return;
        }
        let Some(steps) = self.lists.get(&name).cloned() else { return };
        self.called.push(name);
        for step in steps.iter() {
            self.perform(step);
        }
        self.called.pop();
    }

    fn change_stack(&mut self, change: impl FnOnce(&mut Vec<DMat4>)) {
        match self.mode {
            GL_MODELVIEW => {
                self.shared_stack = None;
                change(&mut self.modelview);
            }
            GL_PROJECTION => change(&mut self.projection),
            _ => {}
        }
    }

    fn change_matrix(&mut self, change: impl FnOnce(&mut DMat4)) {
        self.change_stack(|stack| {
            if let Some(current) = stack.last_mut() {
                change(current);
            }
        });
    }

    fn change_state(&mut self, step: &Step) {
        self.shared = None;
        match step {
            Step::Image(GL_TEXTURE_2D, opacity) => {
                self.opacities.insert(self.state.bound_texture(), *opacity);
            }
            Step::PushAttrib(mask) => self.saved.push((*mask, self.state.clone())),
            Step::PopAttrib => {
                if let Some((mask, saved)) = self.saved.pop() {
                    self.state.restore(mask, &saved);
                }
            }
            _ => self.state.change(step),
        }
    }

    fn change_client(&mut self, step: &Step) {
        match step {
            Step::Positions(components, kind, stride, memory) => {
                let has_positions = self.client.has_positions;
                self.client = Client {
                    components: *components,
                    kind: *kind,
                    stride: *stride,
                    memory: memory.clone(),
                    buffer: self.array_buffer,
                    has_positions,
                };
            }
            Step::ClientState(GL_VERTEX_ARRAY, enabled) => self.client.has_positions = *enabled,
            Step::PushClient => self.saved_clients.push(self.client.clone()),
            Step::PopClient => self.client = self.saved_clients.pop().unwrap_or_else(|| self.client.clone()),
            _ => {}
        }
    }

    fn change_buffer(&mut self, step: &Step) {
        let bound = |target: u32| match target {
            GL_ELEMENT_ARRAY_BUFFER => self.index_buffer,
            _ => self.array_buffer,
        };
        match step {
            Step::Buffer(GL_ELEMENT_ARRAY_BUFFER, name) => self.index_buffer = *name,
            Step::Buffer(_, name) => self.array_buffer = *name,
            Step::BufferData(target, size, content) => {
                let name = bound(*target);
                let bytes = content.as_ref().map_or_else(|| vec![0; *size], |bytes| bytes.to_vec());
                self.buffers.insert(name, bytes);
            }
            Step::BufferPart(target, start, content) => {
                let name = bound(*target);
                let place =
                    self.buffers.get_mut(&name).and_then(|b| b.get_mut(*start..start + content.len()));
                place.into_iter().for_each(|place| place.copy_from_slice(content));
            }
            _ => {}
        }
    }

    fn bytes<'a>(&'a self, memory: &'a Memory, buffer: u32) -> &'a [u8] {
        match memory {
            Memory::Bytes(bytes) => bytes,
            Memory::Offset(offset) => {
                self.buffers.get(&buffer).and_then(|bytes| bytes.get(*offset..)).unwrap_or(&[])
            }
        }
    }

    /// Indices, nothing in place of those that are not there.
    fn indices(&self, count: usize, width: usize, memory: &Memory) -> Vec<Option<usize>> {
        let bytes = self.bytes(memory, self.index_buffer);
        let index = |i: usize| {
            let bytes = bytes.get(i * width..(i + 1) * width)?;
            Some(bytes.iter().rev().fold(0, |sum, byte| sum << 8 | usize::from(*byte)))
        };
        (0..count).map(index).collect()
    }

    /// Positions by index; the origin where there is none.
    fn gather(&self, indices: impl Iterator<Item = Option<usize>>) -> Vec<Vec3> {
        let client = &self.client;
        if !client.has_positions {
            return Vec::new();
        }
        let bytes = self.bytes(&client.memory, client.buffer);
        let width = if client.kind == GL_DOUBLE {
            8
        } else if client.kind == GL_SHORT {
            2
        } else {
            4
        };
        let stride = if client.stride == 0 { client.components * width } else { client.stride };
        let component = |index: usize, i: usize| {
            let start = index * stride + i * width;
            let bytes = bytes.get(start..start + width)?;
            Some(match client.kind {
                GL_DOUBLE => f64::from_le_bytes(bytes.try_into().ok()?) as f32,
                GL_SHORT => f32::from(i16::from_le_bytes(bytes.try_into().ok()?)),
                GL_INT => i32::from_le_bytes(bytes.try_into().ok()?) as f32,
                _ => f32::from_le_bytes(bytes.try_into().ok()?),
            })
        };
        let position = |index: Option<usize>| {
            let at = |i: usize| index.filter(|_| i < client.components).and_then(|index| component(index, i));
            Vec3::from_array([0, 1, 2].map(|i| at(i).unwrap_or(0.0)))
        };
        indices.map(position).collect()
    }

    fn draw(&mut self, mode: u32, positions: &[Vec3], buffer: u32) {
        let keys: Rc<[u64]> = triangles::keys(mode, positions).into();
        let state = self.shared.get_or_insert_with(|| Rc::new(self.state.clone())).clone();
        let stack = self.shared_stack.get_or_insert_with(|| self.modelview.as_slice().into()).clone();
        self.drawn.push(Drawn {
            index: self.drawn.len(),
            mode,
            triangles: keys.len() as u64,
            stack,
            loaded: self.loaded,
            projection: self.projection.last().copied().unwrap_or(DMat4::IDENTITY),
            opacity: match state.textures[0] {
                Some(name) => self.opacities.get(&name).copied().unwrap_or(Opacity::Unknown),
                None => Opacity::Opaque,
            },
            state,
            lists: self.called.as_slice().into(),
            buffer,
            lock: self.lock,
            clears: self.clears,
            positions: positions.into(),
            content: triangles::content(positions),
            keys,
            bounds: triangles::bounds(positions),
        });
    }
}
