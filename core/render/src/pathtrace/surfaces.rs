//! A frame's traced draws, and the layers over them, as records that shaders read.

use afterglow_gl::frame::{Compare, Draw, FixedState, Frame, StateWords};
use afterglow_records::{
    BAKE_NONE, BlendWord, DrawPush, DrawRecord, MASK_MOVING, MASK_STATIC, MASK_VIEW_MODEL, NO_LIGHT, NO_MAP,
    SurfaceDraw, SurfaceKind,
};
use afterglow_scene::{Class, LightOrigin, Scene, Verdict};
use hashbrown::HashMap;

use super::geometry::Triangles;

/// How a scene's surfaces are lit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Lighting {
    /// By lights that the program has.
    Lights,
    /// By lights that the program says, in a world that it does not light itself: every surface is lit by them unless its
    /// colours are baked light.
    Said,
    /// By a light that was made up: every surface is lit by it unless its colours are baked light.
    MadeUp,
    /// Its colours are its light.
    Baked,
    /// Traced light takes the place of the light in its colours.
    Relit,
}

impl Lighting {
    pub(crate) fn of(scene: &Scene) -> Self {
        let is_programs = |origin| matches!(origin, LightOrigin::Gl(_));
        if scene.relit.is_some() {
            Self::Relit
        } else if scene.lights.iter().all(|light| light.origin == LightOrigin::Recovered) {
            Self::Baked
        } else if scene.lights.iter().any(|light| matches!(light.origin, LightOrigin::Program(_))) {
            Self::Said
        } else if scene.lights.iter().any(|light| light.origin == LightOrigin::Fallback) {
            Self::MadeUp
        } else if scene.lights.iter().any(|light| is_programs(light.origin)) {
            Self::Lights
        } else {
            Self::MadeUp
        }
    }

    /// How light is found for a draw; `has_material`: the program says what it is made of.
    pub(crate) fn kind(self, verdict: &Verdict, words: &StateWords, has_material: bool) -> SurfaceKind {
        match self {
            Self::Lights if words.is_lit() || has_material => SurfaceKind::Lit,
            Self::Lights => SurfaceKind::Catcher,
            Self::Said | Self::MadeUp if verdict.baked => SurfaceKind::Catcher,
            Self::Said | Self::MadeUp => SurfaceKind::Lit,
            Self::Relit if verdict.class == Class::Static && verdict.baked => SurfaceKind::Lit,
            Self::Baked | Self::Relit if verdict.class == Class::Static => SurfaceKind::Baked,
            Self::Baked | Self::Relit => SurfaceKind::BakedMover,
        }
    }
}

/// The instance mask of a traced class, and what rays from it meet.
pub(crate) fn masks(class: Class, kind: SurfaceKind) -> (u32, u32) {
    let own = match class {
        Class::Static => MASK_STATIC,
        Class::ViewModel => MASK_VIEW_MODEL,
        _ => MASK_MOVING,
    };
    let meets = match (kind, class) {
        (SurfaceKind::Baked, _) => MASK_MOVING,
        (_, Class::ViewModel) => MASK_STATIC | MASK_MOVING | MASK_VIEW_MODEL,
        _ => MASK_STATIC | MASK_MOVING,
    };
    (own, meets)
}

/// Where a draw's data are on the device.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Located<'a> {
    pub(crate) record: &'a DrawRecord,
    /// Address of vertex 0.
    pub(crate) vertices: u64,
    /// Address of the first index.
    pub(crate) indices: u64,
    pub(crate) push: &'a DrawPush,
}

/// The record of a draw. Its list of layers ends with itself.
pub(crate) fn surface_draw(
    frame: &Frame,
    draw: &Draw,
    located: Located<'_>,
    object_to_world: [[f32; 4]; 3],
    kind: SurfaceKind,
    ray_mask: u32,
    number: u32,
) -> SurfaceDraw {
    let fixed = &frame.fixed[draw.fixed as usize];
    let viewport = frame.viewports[draw.viewport as usize].rect;
    let mut words = fixed.words;
    // Where no light shows, shaders need not look for any.
    words.global.set_lighting(words.is_lit().into());
    let words: &[u32] = bytemuck::cast_slice(std::slice::from_ref(&words));
    let record = located.record;
    SurfaceDraw {
        vertices: located.vertices,
        indices: located.indices,
        corners_before: 0,
        object_to_world,
        object_to_world_before: [[0.0; 4]; 3],
        viewport: [viewport.x, viewport.y, viewport.width, viewport.height].map(|side| side as f32),
        state: std::array::from_fn(|i| words[i]),
        textures: located.push.textures,
        vertex_layout: draw.layout.0,
        last_vertex: record.last_vertex,
        transform: record.transform,
        material: record.material,
        environment: record.environment,
        current: record.current,
        kind: kind as u32,
        next_layer: number,
        blend: blend_word(fixed).0[0],
        ray_mask,
        emission: [0.0; 3],
        roughness: -1.0,
        metallic: 0.0,
        normal_map: NO_MAP,
        metallic_roughness_map: NO_MAP,
        emission_map: NO_MAP,
        bake: BAKE_NONE,
        first_light: NO_LIGHT,
        base_color: [-1.0; 3],
        maps: 0,
        reach: f32::INFINITY,
        object: 0,
    }
}

/// Whether a surface may have holes, by alpha test or by blending.
pub(crate) fn has_holes(fixed: &FixedState) -> bool {
    fixed.words.global.alpha_func() != Compare::Always as u32 || fixed.raster.blend.is_some()
}

fn blend_word(fixed: &FixedState) -> BlendWord {
    let mut word = BlendWord::default();
    if let Some(blend) = &fixed.raster.blend {
        word.set_enabled(1);
        word.set_source(blend.rgb.0 as u32);
        word.set_destination(blend.rgb.1 as u32);
        word.set_equation(blend.equation_rgb as u32);
    }
    word
}

/// Finds the surface that a layer lies on: the last draw of the same triangles.
#[derive(Default)]
pub(crate) struct LayerFinder {
    /// The end of each list of layers, by the triangles' hash and number.
    ends: HashMap<(u64, u32), u32>,
}

impl LayerFinder {
    /// Notes a surface that layers may lie on.
    pub(crate) fn add(&mut self, surface: u32, triangles: &Triangles) {
        self.ends.insert((triangles.hash, triangles.count), surface);
    }

    /// Whether there is a surface of these triangles.
    pub(crate) fn has(&self, triangles: &Triangles) -> bool {
        self.ends.contains_key(&(triangles.hash, triangles.count))
    }

    /// Hangs a layer onto the surface below it. Says whether there is one.
    pub(crate) fn link(&mut self, surfaces: &mut [SurfaceDraw], layer: u32, triangles: &Triangles) -> bool {
        let Some(end) = self.ends.get_mut(&(triangles.hash, triangles.count)) else {
            return false;
        };
        if let Some(below) = surfaces.get_mut(*end as usize) {
            below.next_layer = layer;
        }
        *end = layer;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::super::anchors::Reach;
    use super::*;
    use bytemuck::Zeroable;

    #[test]
    fn layers_hang_onto_the_last_draw_of_the_same_triangles() {
        let triangles = |hash| Triangles { hash, count: 2, corners: 0..0, reach: Reach::NOTHING };
        let mut surfaces = vec![SurfaceDraw::zeroed(); 4];
        for (number, surface) in surfaces.iter_mut().enumerate() {
            surface.next_layer = number as u32;
        }
        let mut finder = LayerFinder::default();
        finder.add(0, &triangles(5));
        finder.add(1, &triangles(6));
        assert!(finder.link(&mut surfaces, 2, &triangles(5)));
        assert!(finder.link(&mut surfaces, 3, &triangles(5)));
        assert!(!finder.link(&mut surfaces, 3, &triangles(7)));
        let next: Vec<_> = surfaces.iter().map(|surface| surface.next_layer).collect();
        assert_eq!(next, [2, 1, 3, 3]);
    }

    #[test]
    fn rays_of_the_world_do_not_meet_the_weapon() {
        let (own, _) = masks(Class::ViewModel, SurfaceKind::Lit);
        for (class, kind) in [
            (Class::Static, SurfaceKind::Lit),
            (Class::Static, SurfaceKind::Baked),
            (Class::Movable, SurfaceKind::BakedMover),
        ] {
            assert_eq!(masks(class, kind).1 & own, 0);
        }
        assert_ne!(masks(Class::ViewModel, SurfaceKind::Lit).1 & own, 0);
    }
}
