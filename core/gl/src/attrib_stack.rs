//! glPushAttrib, glPushClientAttrib and their pops (specification 6.1.12).

use afterglow_api::constants::*;

use crate::arrays::ClientState;
use crate::context::Context;
use crate::frame::{SLOTS, TEXTURE_UNITS};
use crate::limits;
use crate::pixel::{PixelStore, TransferModes};
use crate::shared::SharedTexture;
use crate::state::{Cap, Caps, State};
use crate::tables::Dirty;
use crate::texture::Parameters;

/// Name, texture and its parameters, by unit and target.
type SavedTextures = [[(u32, SharedTexture, Parameters); 4]; TEXTURE_UNITS];

/// Saved server state.
struct Saved {
    mask: u32,
    state: State,
    transfer: TransferModes,
    /// With GL_TEXTURE_BIT.
    textures: Option<Box<SavedTextures>>,
}

/// Saved client state.
struct SavedClient {
    mask: u32,
    client: Option<Box<ClientState>>,
    pixel_store: Option<PixelStore>,
}

/// Both stacks, and the pixel store that the client's stack saves.
#[derive(Default)]
pub struct AttribStacks {
    saved: Vec<Saved>,
    saved_client: Vec<SavedClient>,
    /// glPixelStore.
    pub pixel_store: PixelStore,
}

impl AttribStacks {
    /// Depth of the server's and the client's stack.
    pub fn depths(&self) -> (usize, usize) {
        (self.saved.len(), self.saved_client.len())
    }
}

/// Flags that belong to a group besides GL_ENABLE_BIT.
fn group_caps(mask: u32) -> Caps {
    use Cap::*;
    let groups: [(u32, &[Cap]); 11] = [
        (
            GL_ENABLE_BIT,
            &[
                AlphaTest,
                AutoNormal,
                Blend,
                ColorLogicOp,
                IndexLogicOp,
                ColorMaterial,
                ColorSum,
                CullFace,
                DepthTest,
                Dither,
                Fog,
                Lighting,
                LineSmooth,
                LineStipple,
                Multisample,
                Normalize,
                PointSmooth,
                PointSprite,
                PolygonOffsetFill,
                PolygonOffsetLine,
                PolygonOffsetPoint,
                PolygonSmooth,
                PolygonStipple,
                RescaleNormal,
                SampleAlphaToCoverage,
                SampleAlphaToOne,
                SampleCoverage,
                ScissorTest,
                StencilTest,
                Map1Color4,
                Map1Index,
                Map1Normal,
                Map1TextureCoord1,
                Map1TextureCoord2,
                Map1TextureCoord3,
                Map1TextureCoord4,
                Map1Vertex3,
                Map1Vertex4,
                Map2Color4,
                Map2Index,
                Map2Normal,
                Map2TextureCoord1,
                Map2TextureCoord2,
                Map2TextureCoord3,
                Map2TextureCoord4,
                Map2Vertex3,
                Map2Vertex4,
            ],
        ),
        (GL_COLOR_BUFFER_BIT, &[AlphaTest, Blend, Dither, ColorLogicOp, IndexLogicOp]),
        (GL_DEPTH_BUFFER_BIT, &[DepthTest]),
        (GL_FOG_BIT, &[Fog, ColorSum]),
        (GL_LIGHTING_BIT, &[Lighting, ColorMaterial]),
        (GL_LINE_BIT, &[LineSmooth, LineStipple]),
        (GL_POINT_BIT, &[PointSmooth, PointSprite]),
        (
            GL_POLYGON_BIT,
            &[
                CullFace,
                PolygonSmooth,
                PolygonStipple,
                PolygonOffsetFill,
                PolygonOffsetLine,
                PolygonOffsetPoint,
            ],
        ),
        (GL_SCISSOR_BIT, &[ScissorTest]),
        (GL_STENCIL_BUFFER_BIT, &[StencilTest]),
        (GL_TRANSFORM_BIT, &[Normalize, RescaleNormal]),
    ];
    let caps: Vec<Cap> =
        groups.iter().filter(|(bit, _)| mask & bit != 0).flat_map(|(_, caps)| caps.iter().copied()).collect();
    Caps::of(&caps)
}

impl Context {
    pub(crate) fn exec_push_attrib(&mut self, mask: u32) {
        if self.stacks.saved.len() >= limits::ATTRIB_STACK {
            return self.record_error(GL_STACK_OVERFLOW);
        }
        let saved = self.save(mask);
        self.stacks.saved.push(saved);
    }

    fn save(&mut self, mask: u32) -> Saved {
        self.sync_color_material();
        let textures = (mask & GL_TEXTURE_BIT != 0).then(|| {
            let save = |u: usize, t: usize| {
                let (name, texture) = &self.textures.bound[u][t];
                (*name, texture.clone(), texture.lock().parameters().clone())
            };
            Box::new(std::array::from_fn(|u| std::array::from_fn(|t| save(u, t))))
        });
        Saved { mask, state: self.state.clone(), transfer: self.transfer.modes, textures }
    }

    /// glXCopyContext: takes another context's groups of state, as glPopAttrib would. Textures are only taken from a
    /// context that shares names.
    pub fn copy_state(&mut self, from: &mut Context, mask: u32) {
        let is_shared = std::sync::Arc::ptr_eq(&self.shared, &from.shared);
        let saved = from.save(if is_shared { mask } else { mask & !GL_TEXTURE_BIT });
        self.restore_saved(saved);
    }

    pub(crate) fn exec_pop_attrib(&mut self) {
        let Some(saved) = self.stacks.saved.pop() else {
            return self.record_error(GL_STACK_UNDERFLOW);
        };
        self.restore_saved(saved);
    }

    fn restore_saved(&mut self, saved: Saved) {
        self.note_draw_buffer();
        self.restore(saved.mask, saved.state);
        if saved.mask & GL_PIXEL_MODE_BIT != 0 {
            self.transfer.modes = saved.transfer;
        }
        if let Some(textures) = saved.textures {
            for (unit, saved) in textures.into_iter().enumerate() {
                for (target, (name, texture, parameters)) in saved.into_iter().enumerate() {
                    texture.lock().set_parameters(parameters);
                    self.textures.bound[unit][target] = (name, texture);
                }
            }
        }
        self.dirty(Dirty::all());
        self.tables.changed = [true; SLOTS];
    }

    fn restore(&mut self, mask: u32, from: State) {
        let has = |bit: u32| mask & bit != 0;
        let state = &mut self.state;
        let enables = has(GL_ENABLE_BIT);
        state.caps = state.caps.merged(from.caps, group_caps(mask));
        if has(GL_CURRENT_BIT) {
            state.current = from.current;
        }
        if has(GL_POINT_BIT) {
            state.point = from.point;
        }
        if has(GL_LINE_BIT) {
            state.line = from.line;
        }
        if has(GL_POLYGON_BIT) {
            state.polygon = from.polygon;
        }
        if has(GL_POLYGON_STIPPLE_BIT) {
            state.polygon_stipple = from.polygon_stipple;
        }
        if has(GL_PIXEL_MODE_BIT) {
            state.pixel = from.pixel;
        }
        if has(GL_LIGHTING_BIT) {
            state.lighting = from.lighting;
        } else if enables {
            state.lighting.enabled = from.lighting.enabled;
        }
        if has(GL_FOG_BIT) {
            state.fog = from.fog;
        }
        if has(GL_DEPTH_BUFFER_BIT) {
            state.depth = from.depth;
        }
        if has(GL_ACCUM_BUFFER_BIT) {
            state.accum_clear = from.accum_clear;
        }
        if has(GL_STENCIL_BUFFER_BIT) {
            state.stencil = from.stencil;
        }
        if has(GL_VIEWPORT_BIT) {
            state.viewport = from.viewport;
        }
        if has(GL_TRANSFORM_BIT) {
            state.transform = from.transform;
        } else if enables {
            state.transform.clip_enabled = from.transform.clip_enabled;
        }
        if has(GL_COLOR_BUFFER_BIT) {
            state.color = from.color;
        }
        if has(GL_HINT_BIT) {
            state.hints = from.hints;
        }
        if has(GL_LIST_BIT) {
            state.list_base = from.list_base;
        }
        if has(GL_SCISSOR_BIT) {
            state.scissor = from.scissor;
        }
        if has(GL_TEXTURE_BIT) {
            state.texture = from.texture;
        } else if enables {
            for (unit, saved) in state.texture.units.iter_mut().zip(&from.texture.units) {
                (unit.targets, unit.gen_enabled) = (saved.targets, saved.gen_enabled);
            }
        }
    }

    /// glPushClientAttrib.
    pub fn push_client_attrib(&mut self, mask: u32) {
        if self.refuses_in_begin() {
            return;
        }
        if self.stacks.saved_client.len() >= limits::ATTRIB_STACK {
            return self.record_error(GL_STACK_OVERFLOW);
        }
        let client = (mask & GL_CLIENT_VERTEX_ARRAY_BIT != 0).then(|| Box::new(self.client.clone()));
        let pixel_store = (mask & GL_CLIENT_PIXEL_STORE_BIT != 0).then_some(self.stacks.pixel_store);
        self.stacks.saved_client.push(SavedClient { mask, client, pixel_store });
    }

    /// glPopClientAttrib.
    pub fn pop_client_attrib(&mut self) {
        if self.refuses_in_begin() {
            return;
        }
        let Some(saved) = self.stacks.saved_client.pop() else {
            return self.record_error(GL_STACK_UNDERFLOW);
        };
        tracing::trace!(mask = saved.mask, "client state restored");
        if let Some(client) = saved.client {
            self.client = *client;
        }
        if let Some(pixel_store) = saved.pixel_store {
            self.stacks.pixel_store = pixel_store;
        }
    }
}
