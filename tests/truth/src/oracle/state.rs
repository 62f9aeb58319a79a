//! State that draws meet, as far as oracles ask for it.

use std::collections::BTreeSet;

use afterglow_api::constants::*;

use super::step::Step;

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
    /// glCullFace.
    pub culled: u32,
    /// glFrontFace.
    pub front: u32,
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

impl Default for State {
    /// That of a new context.
    fn default() -> State {
        State {
            enabled: BTreeSet::new(),
            blend: (GL_ONE, GL_ZERO),
            depth_func: GL_LESS,
            depth_mask: true,
            depth_range: [0.0, 1.0],
            color_mask: true,
            culled: GL_BACK,
            front: GL_CCW,
            stencil_op: [GL_KEEP; 3],
            viewport: [0; 4],
            alpha_reference: 0.0,
            textures: [None; 4],
            bound: [0; 4],
            on: Default::default(),
            unit: 0,
        }
    }
}

impl State {
    /// Whether a capability is enabled.
    pub fn has(&self, capability: u32) -> bool {
        self.enabled.contains(&capability)
    }

    /// The factors, where blending is enabled.
    pub fn blending(&self) -> Option<(u32, u32)> {
        self.has(GL_BLEND).then_some(self.blend)
    }

    /// Changes what a step says.
    pub fn change(&mut self, step: &Step) {
        match step {
            Step::Capability(capability, enabled) => self.set(*capability, *enabled),
            Step::Blend(source, destination) => self.blend = (*source, *destination),
            Step::DepthFunc(compare) => self.depth_func = *compare,
            Step::DepthMask(writes) => self.depth_mask = *writes,
            Step::DepthRange(range) => self.depth_range = *range,
            Step::ColorMask(writes) => self.color_mask = *writes,
            Step::Faces(winding @ (GL_CW | GL_CCW)) => self.front = *winding,
            Step::Faces(face) => self.culled = *face,
            Step::StencilOp(operations) => self.stencil_op = *operations,
            Step::Viewport(rect) => self.viewport = *rect,
            Step::Unit(unit) => self.unit = (*unit).min(3),
            Step::Texture(target, name) if matches!(*target, GL_TEXTURE_2D | GL_TEXTURE_CUBE_MAP) => {
                self.bound[self.unit] = *name;
                if self.textures[self.unit].is_some() {
                    self.textures[self.unit] = Some(*name);
                }
            }
            Step::AlphaReference(reference) => self.alpha_reference = *reference,
            _ => {}
        }
    }

    /// The texture that is bound to the active unit.
    pub fn bound_texture(&self) -> u32 {
        self.bound[self.unit]
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

    /// Puts back what glPushAttrib saved (specification 6.1.14), as far as it is kept.
    pub fn restore(&mut self, mask: u32, saved: &State) {
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
            self.set(*capability, saved.has(*capability));
        }
        if mask & GL_ENABLE_BIT != 0 {
            self.enabled.clone_from(&saved.enabled);
        }
        if mask & GL_COLOR_BUFFER_BIT != 0 {
            (self.blend, self.color_mask) = (saved.blend, saved.color_mask);
            self.alpha_reference = saved.alpha_reference;
        }
        if mask & GL_DEPTH_BUFFER_BIT != 0 {
            (self.depth_func, self.depth_mask) = (saved.depth_func, saved.depth_mask);
        }
        if mask & GL_VIEWPORT_BIT != 0 {
            (self.viewport, self.depth_range) = (saved.viewport, saved.depth_range);
        }
        if mask & GL_TEXTURE_BIT != 0 {
            (self.bound, self.unit) = (saved.bound, saved.unit);
        }
        if mask & (GL_TEXTURE_BIT | GL_ENABLE_BIT) != 0 {
            self.on.clone_from(&saved.on);
            self.textures = saved.textures;
        }
    }
}
