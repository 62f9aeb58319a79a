//! A machine that executes steps and says of each draw what an oracle asks of it. Unlike the product, it keeps what the
//! program multiplied apart: the stack of matrices, the lists that were called, the names that were bound.

use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;

use afterglow_api::constants::*;
use glam::{DMat4, Vec3};

use super::step::{Memory, Opacity, Step};
use super::triangles;

/// State that draws meet.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Capabilities that are enabled; those of texture units are in `units`.
    pub enabled: BTreeSet<u32>,
    /// Source and destination factor, wherever blending is enabled.
    pub blend: (u32, u32),
    /// glDepthFunc.
    pub depth_func: u32,
    /// glDepthMask.
    pub depth_mask: bool,
    /// glDepthRange.
    pub depth_range: [f64; 2],
    /// Whether colours are written.
    pub color_mask: bool,
    /// glStencilOp.
    pub stencil_op: [u32; 3],
    /// glViewport.
    pub viewport: [i32; 4],
    /// What alpha is compared with, wherever it is tested.
    pub alpha_reference: f32,
    /// Names of the textures of the first units, where they are enabled.
    pub textures: [Option<u32>; 4],
    bound: [u32; 4],
    on: [BTreeSet<u32>; 4],
    unit: usize,
}

impl State {
    fn new() -> State {
        State {
            enabled: BTreeSet::new(),
            blend: (GL_ONE, GL_ZERO),
            depth_func: GL_LESS,
            depth_mask: true,
            depth_range: [0.0, 1.0],
            color_mask: true,
            stencil_op: [GL_KEEP; 3],
            viewport: [0; 4],
            alpha_reference: 0.0,
            textures: [None; 4],
            bound: [0; 4],
            on: Default::default(),
            unit: 0,
        }
    }

    /// Whether a capability is enabled.
    pub fn has(&self, capability: u32) -> bool {
        self.enabled.contains(&capability)
    }

    /// The factors, where blending is enabled.
    pub fn blending(&self) -> Option<(u32, u32)> {
        self.has(GL_BLEND).then_some(self.blend)
    }

    fn set(&mut self, capability: u32, enabled: bool) {
        let of_unit = matches!(
            capability,
            GL_TEXTURE_1D
                | GL_TEXTURE_2D
                | GL_TEXTURE_3D
                | GL_TEXTURE_CUBE_MAP
                | GL_TEXTURE_GEN_S
                | GL_TEXTURE_GEN_T
                | GL_TEXTURE_GEN_R
        );
        let set = match of_unit {
            true => &mut self.on[self.unit],
            false => &mut self.enabled,
        };
        if enabled {
            set.insert(capability)
        } else {
            set.remove(&capability)
        };
        let is_on = |unit: usize| {
            [GL_TEXTURE_2D, GL_TEXTURE_CUBE_MAP].iter().any(|target| self.on[unit].contains(target))
        };
        self.textures = [0, 1, 2, 3].map(|unit| is_on(unit).then_some(self.bound[unit]));
    }
}

/// A draw.
#[derive(Debug, Clone)]
pub struct Drawn {
    /// Draws of a frame count from 0.
    pub index: usize,
    /// What glBegin and the like take.
    pub mode: u32,
    /// Triangles that OpenGL makes of it.
    pub triangles: u64,
    /// MODELVIEW matrices, the current one last.
    pub stack: Rc<[DMat4]>,
    /// The matrix that MODELVIEW was last set to as a whole, before what was multiplied to it.
    pub loaded: DMat4,
    /// The current PROJECTION matrix.
    pub projection: DMat4,
    /// State that it meets.
    pub state: Rc<State>,
    /// How opaque the texture of unit 0 is.
    pub opacity: Opacity,
    /// Display lists that it is in, outermost first.
    pub lists: Rc<[u32]>,
    /// Buffer that holds its vertices, or 0.
    pub buffer: u32,
    /// Which pair of glLockArrays and glUnlockArrays of the frame it is in, or the one after which it is.
    pub lock: u32,
    /// How often depth was cleared in the frame before it.
    pub clears: u32,
    /// Hash of its positions in order.
    pub content: u64,
    /// Hash of the positions of each triangle, in any order of corners.
    pub keys: Rc<[u64]>,
    /// Least and most of the positions, object space.
    pub bounds: [Vec3; 2],
}

impl Drawn {
    /// The current MODELVIEW matrix.
    pub fn modelview(&self) -> DMat4 {
        self.stack.last().copied().unwrap_or(DMat4::IDENTITY)
    }

    /// Whether the projection makes far things small.
    pub fn is_perspective(&self) -> bool {
        self.projection.row(3).truncate().length() > 1e-9
    }

    /// The texture of unit 0.
    pub fn texture(&self) -> u32 {
        self.state.textures[0].unwrap_or(0)
    }

    /// Factors of blending, if it is on.
    pub fn blending(&self) -> Option<(u32, u32)> {
        self.state.blending()
    }
}

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
            state: State::new(),
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
        let state = &mut self.state;
        match step {
            Step::Capability(capability, enabled) => state.set(*capability, *enabled),
            Step::Blend(source, destination) => state.blend = (*source, *destination),
            Step::DepthFunc(compare) => state.depth_func = *compare,
            Step::DepthMask(writes) => state.depth_mask = *writes,
            Step::DepthRange(range) => state.depth_range = *range,
            Step::ColorMask(writes) => state.color_mask = *writes,
            Step::StencilOp(operations) => state.stencil_op = *operations,
            Step::Viewport(rect) => state.viewport = *rect,
            Step::Unit(unit) => state.unit = (*unit).min(3),
            Step::Texture(target, name) if matches!(*target, GL_TEXTURE_2D | GL_TEXTURE_CUBE_MAP) => {
                state.bound[state.unit] = *name;
                if state.textures[state.unit].is_some() {
                    state.textures[state.unit] = Some(*name);
                }
            }
            Step::AlphaReference(reference) => state.alpha_reference = *reference,
            Step::Image(GL_TEXTURE_2D, opacity) => {
                self.opacities.insert(state.bound[state.unit], *opacity);
            }
            Step::PushAttrib(mask) => self.saved.push((*mask, state.clone())),
            Step::PopAttrib => {
                if let Some((mask, saved)) = self.saved.pop() {
                    restore(state, mask, &saved);
                }
            }
            _ => {}
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
            content: triangles::content(positions),
            keys,
            bounds: triangles::bounds(positions),
        });
    }
}

/// Puts back what glPushAttrib saved (specification 6.1.14), as far as it is kept.
fn restore(state: &mut State, mask: u32, saved: &State) {
    let groups: [(u32, &[u32]); 7] = [
        (GL_COLOR_BUFFER_BIT, &[GL_BLEND, GL_ALPHA_TEST]),
        (GL_DEPTH_BUFFER_BIT, &[GL_DEPTH_TEST]),
        (GL_LIGHTING_BIT, &[GL_LIGHTING, GL_COLOR_MATERIAL]),
        (GL_POLYGON_BIT, &[GL_CULL_FACE, GL_POLYGON_OFFSET_FILL]),
        (GL_SCISSOR_BIT, &[GL_SCISSOR_TEST]),
        (GL_STENCIL_BUFFER_BIT, &[GL_STENCIL_TEST]),
        (GL_FOG_BIT, &[GL_FOG]),
    ];
    for capability in groups.iter().filter(|(bit, _)| mask & bit != 0).flat_map(|(_, of)| *of) {
        state.set(*capability, saved.has(*capability));
    }
    if mask & GL_ENABLE_BIT != 0 {
        state.enabled.clone_from(&saved.enabled);
    }
    if mask & GL_COLOR_BUFFER_BIT != 0 {
        (state.blend, state.color_mask) = (saved.blend, saved.color_mask);
        state.alpha_reference = saved.alpha_reference;
    }
    if mask & GL_DEPTH_BUFFER_BIT != 0 {
        (state.depth_func, state.depth_mask) = (saved.depth_func, saved.depth_mask);
    }
    if mask & GL_VIEWPORT_BIT != 0 {
        (state.viewport, state.depth_range) = (saved.viewport, saved.depth_range);
    }
    if mask & GL_TEXTURE_BIT != 0 {
        (state.bound, state.unit) = (saved.bound, saved.unit);
    }
    if mask & (GL_TEXTURE_BIT | GL_ENABLE_BIT) != 0 {
        state.on.clone_from(&saved.on);
        state.textures = saved.textures;
    }
}
