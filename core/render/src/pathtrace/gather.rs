//! A frame's traced draws, and the layers over them, as records.

use std::ops::Range;

use afterglow_gl::frame::{Draw, Frame, HintMaterial, Operation, Topology};
use afterglow_gpu::{BindlessTable, Gpu, GpuError};
use afterglow_records::{
    BAKE_COLORS, BAKE_DOUBLED_LAYER, BAKE_LAYER, BAKE_NONE, BAKE_SHIFT, NO_LIGHT, NO_MAP, SurfaceDraw,
    SurfaceKind, WHITE_ALBEDO,
};
use afterglow_scene::{BakedInto, Class, Relit, SceneLight, Verdict};
use glam::{DVec3, Mat4, Vec3};
use hashbrown::HashMap;

use super::arrange::Mark;
use super::geometry::GeometryReader;
use super::kept_tree::KeptTree;
use super::lights::{LightList, MOST_TRIANGLES, ShiningTriangle};
use super::lists::FramePlace;
use super::options::{Displaced, PathtraceOptions};
use super::replaced::ReplacedMaps;
use super::said::SaidMaterial;
use super::surfaces::{LayerFinder, Lighting, Located, has_holes, masks, surface_draw};
use super::tracer::Tracing;
use super::world::{Traced, relative};
use crate::bindings::{Lookup, image_word};
use crate::passes::raster::{DrawMark, RasterState};
use crate::replacements::Replacements;
use crate::tables::{Scratch, Uploaded};
use crate::textures::Textures;
use crate::uploads::UploadArena;

/// What the rest of the renderer knows of a frame.
pub(crate) struct TraceInput<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) frame: &'a Frame,
    pub(crate) uploaded: &'a Uploaded,
    pub(crate) scratch: &'a Scratch,
    pub(crate) raster: &'a mut RasterState,
    pub(crate) textures: &'a Textures,
    pub(crate) replacements: Option<&'a Replacements>,
    pub(crate) table: &'a BindlessTable,
    pub(crate) arena: &'a mut UploadArena,
}

/// A frame's surfaces, in order.
#[derive(Default)]
pub(crate) struct Surfaces<'a> {
    pub(crate) records: Vec<SurfaceDraw>,
    pub(crate) traced: Vec<Traced<'a>>,
    /// How many of these the camera sees; they come first.
    pub(crate) seen: usize,
    /// What each draw of the frame leaves in the visibility buffer.
    pub(crate) marks: Vec<DrawMark>,
    /// Triangles that shine, draw by draw; their records name the first one by its number here.
    shining: Vec<ShiningTriangle>,
    pub(crate) lights: LightList,
    /// Of each traced draw: its operation, and how light is found for it.
    kinds: Vec<(usize, SurfaceKind)>,
}

impl Surfaces<'_> {
    /// Makes the list of lights, and names those that are triangles in their records.
    pub(crate) fn list_lights(
        &mut self,
        lights: &[SceneLight],
        origin: DVec3,
        options: &PathtraceOptions,
        tree: &mut KeptTree,
    ) {
        self.lights = LightList::new(lights, &self.shining, origin, options.move_light, tree);
        let first = self.lights.first_triangle;
        for record in &mut self.records {
            if record.first_light != NO_LIGHT {
                record.first_light += first as u32;
            }
        }
    }

    /// How light is found for the draws of a view.
    pub(crate) fn kinds_within(&self, operations: &Range<usize>) -> Vec<SurfaceKind> {
        let within = |(operation, _): &&(usize, SurfaceKind)| operations.contains(operation);
        self.kinds.iter().filter(within).map(|(_, kind)| *kind).collect()
    }
}

/// Makes the records of a frame; positions are relative to `origin`, in world space.
pub(crate) fn gather<'a>(
    geometry: &mut GeometryReader,
    options: &PathtraceOptions,
    input: &mut TraceInput<'a>,
    frame_place: &FramePlace,
    tracing: &Tracing,
    origin: DVec3,
) -> Result<Surfaces<'a>, GpuError> {
    let frame = input.frame;
    let mut corners_before = HashMap::new();
    for deformed in &tracing.scene.deformed {
        let corners: &[[f32; 3]] = bytemuck::cast_slice(&deformed.positions);
        let draw = frame.operations.get(deformed.operation as usize);
        // Shaders read as many as there are indices.
        let is_whole =
            matches!(draw, Some(Operation::Draw(draw)) if draw.index_count as usize == corners.len());
        if is_whole && !corners.is_empty() {
            corners_before.insert(deformed.operation, input.arena.push_table(corners)?.address);
        }
    }
    let mut gatherer = Gatherer {
        geometry,
        options,
        input,
        frame_place,
        lighting: Lighting::of(&tracing.scene),
        relit: tracing.scene.relit.as_ref(),
        origin,
        layers: LayerFinder::default(),
        corners_before,
        surfaces: Surfaces::default(),
    };
    let mut verdicts = tracing.scene.verdicts.iter().peekable();
    for (number, (operation, draw)) in frame.draws().enumerate() {
        while verdicts.next_if(|verdict| (verdict.operation as usize) < operation).is_some() {}
        let verdict = verdicts.peek().filter(|verdict| verdict.operation as usize == operation);
        let mark = tracing.arrangement.marks.get(operation).copied().flatten();
        let mark = match (verdict, mark) {
            (Some(verdict), Some(mark)) => {
                let bake = gatherer.bake(draw, verdict.class).unwrap_or(BAKE_NONE);
                let place = Place { number, operation, draw, bake };
                gatherer.mark(&place, verdict, mark)?
            }
            _ => DrawMark::Kept(0),
        };
        gatherer.surfaces.marks.push(mark);
    }
    Ok(gatherer.surfaces)
}

struct Gatherer<'a, 'i> {
    geometry: &'i mut GeometryReader,
    options: &'i PathtraceOptions,
    input: &'i mut TraceInput<'a>,
    frame_place: &'i FramePlace,
    lighting: Lighting,
    /// Where traced light takes the place of baked light.
    relit: Option<&'i Relit>,
    origin: DVec3,
    layers: LayerFinder,
    /// Where the former corners of operations are.
    corners_before: HashMap<u32, u64>,
    surfaces: Surfaces<'a>,
}

/// A draw: its number among the draws, its operation, and what of its colour is baked light that traced light takes the
/// place of (a `BAKE_` constant).
struct Place<'a> {
    number: usize,
    operation: usize,
    draw: &'a Draw,
    bake: u32,
}

impl<'a> Gatherer<'a, '_> {
    /// Makes a draw's record if it needs one. Returns what it leaves in the visibility buffer.
    fn mark(&mut self, place: &Place<'a>, verdict: &Verdict, mark: Mark) -> Result<DrawMark, GpuError> {
        let is_there = self.input.scratch.commands[place.number].index_count > 0;
        Ok(match mark {
            Mark::Traced if is_there => self.traced(place, verdict, true)?,
            Mark::Covered if is_there => self.traced(place, verdict, false)?,
            Mark::Layer if is_there && place.draw.topology == Topology::Triangles => {
                self.layer(place, verdict)?
            }
            Mark::Unseen(block) if is_there => {
                self.unseen(place, verdict, block)?;
                DrawMark::Kept(0)
            }
            Mark::Solid => DrawMark::Written(0),
            Mark::Traced | Mark::Covered | Mark::Layer | Mark::Colorless | Mark::Unseen(_) => {
                DrawMark::Kept(0)
            }
        })
    }

    /// A draw that the camera sees. `is_met` says whether rays meet it, too.
    fn traced(&mut self, place: &Place<'a>, verdict: &Verdict, is_met: bool) -> Result<DrawMark, GpuError> {
        let (surface, kind) = self.surface(place, verdict, None)?;
        if let (false, Some(traced)) = (is_met, self.surfaces.traced.last_mut()) {
            traced.mask = 0;
        }
        self.surfaces.seen = self.surfaces.traced.len();
        self.surfaces.kinds.push((place.operation, kind));
        // Among baked surfaces the colours of what moves are a guess at its light.
        let is_white = kind == SurfaceKind::BakedMover;
        let bake = place.bake << BAKE_SHIFT;
        Ok(DrawMark::Written((surface + 1) | bake | if is_white { WHITE_ALBEDO } else { 0 }))
    }

    /// What was drawn in an earlier frame: rays meet it, the camera does not see it.
    fn unseen(&mut self, place: &Place<'a>, verdict: &Verdict, block: u32) -> Result<(), GpuError> {
        self.surface(place, verdict, Some(block)).map(|_| ())
    }

    /// Adds a surface that rays meet. Returns its number, and how light is found for it.
    fn surface(
        &mut self,
        place: &Place<'a>,
        verdict: &Verdict,
        block: Option<u32>,
    ) -> Result<(u32, SurfaceKind), GpuError> {
        let words = &self.input.frame.fixed[place.draw.fixed as usize].words;
        let hint = self.input.frame.hint(place.draw);
        let is_said = hint.is_some_and(|hint| hint.material != HintMaterial::default());
        let has_material =
            is_said || ReplacedMaps::are_there(self.input.replacements, self.input.frame, place.draw);
        let is_baked = verdict.baked || place.bake != BAKE_NONE;
        let kind = match hint.and_then(|hint| hint.material.base_color) {
            Some(_) => SurfaceKind::Lit,
            None => self.lighting.kind(&Verdict { baked: is_baked, ..*verdict }, words, has_material),
        };
        let (mask, meets) = masks(verdict.class, kind);
        let surface = self.record(place, verdict, kind, meets)?;
        let triangles = self.geometry.read(self.input.frame, place.draw);
        self.shine(place, verdict, surface);
        self.layers.add(surface, &triangles);
        self.surfaces.traced.push(Traced {
            surface,
            draw: place.draw,
            triangles,
            model: displaced(verdict, self.surfaces.traced.len(), self.options),
            mask: mask as u8,
            is_alpha_tested: has_holes(&self.input.frame.fixed[place.draw.fixed as usize]),
            block,
        });
        Ok((surface, kind))
    }

    /// Makes lights of a draw's triangles if all of them shine alike.
    fn shine(&mut self, place: &Place<'a>, verdict: &Verdict, surface: u32) {
        let record = &mut self.surfaces.records[surface as usize];
        let is_alike = record.emission != [0.0; 3] && record.emission_map == NO_MAP;
        let count = place.draw.index_count as usize / 3;
        let shining = &mut self.surfaces.shining;
        if !is_alike || shining.len() + count > MOST_TRIANGLES {
            return;
        }
        record.first_light = shining.len() as u32;
        let (radiance, is_one_sided) = (record.emission, record.base_color[0] >= 0.0);
        let corners = self.geometry.corners(self.input.frame, place.draw);
        let (model, origin) = (verdict.model.as_dmat4(), self.origin);
        let place =
            |corner: [f32; 3]| (model.transform_point3(Vec3::from(corner).as_dvec3()) - origin).as_vec3();
        let is_mirrored = model.determinant() < 0.0;
        shining.extend(self.geometry.corners[corners].as_chunks::<3>().0.iter().map(|&[a, b, c]| {
            // The front stays the front.
            let corners = if is_mirrored { [a, c, b] } else { [a, b, c] };
            ShiningTriangle { corners: corners.map(place), radiance, is_one_sided }
        }));
    }

    /// A layer matters to rays only where it lies on a surface that they meet.
    fn layer(&mut self, place: &Place<'a>, verdict: &Verdict) -> Result<DrawMark, GpuError> {
        let triangles = self.geometry.read(self.input.frame, place.draw);
        if self.layers.has(&triangles) {
            let layer = self.record(place, verdict, SurfaceKind::None, 0)?;
            self.layers.link(&mut self.surfaces.records, layer, &triangles);
        }
        Ok(DrawMark::Kept(place.bake << BAKE_SHIFT))
    }

    /// Where a draw's baked light is, if traced light takes its place.
    fn bake(&self, draw: &Draw, class: Class) -> Option<u32> {
        let is_layer = class == Class::Layer;
        let of_world = is_layer || class == Class::Static;
        let bakes = &self.relit.filter(|_| of_world)?.bakes;
        bakes.of(self.input.frame, draw, is_layer).map(|baked| match baked {
            BakedInto::Unit(unit) => u32::from(unit) + 1,
            BakedInto::Colors => BAKE_COLORS,
            BakedInto::Layer { is_doubled: false } => BAKE_LAYER,
            BakedInto::Layer { is_doubled: true } => BAKE_DOUBLED_LAYER,
        })
    }

    /// A record with where its surface was in the frame before.
    fn former(&self, record: SurfaceDraw, place: &Place<'_>, verdict: &Verdict) -> SurfaceDraw {
        // What stands still needs no evidence of it; all else that was not there before has no place.
        let is_still = verdict.class == Class::Static;
        let former = verdict.previous.or(is_still.then_some(verdict.model));
        SurfaceDraw {
            corners_before: self.corners_before.get(&(place.operation as u32)).copied().unwrap_or(0),
            object_to_world_before: former.map_or([[0.0; 4]; 3], |model| relative(&model, self.origin)),
            object: if is_still { 0 } else { object_number(verdict.object) },
            ..record
        }
    }

    /// Adds a record. Returns its number.
    fn record(
        &mut self,
        place: &Place<'a>,
        verdict: &Verdict,
        kind: SurfaceKind,
        ray_mask: u32,
    ) -> Result<u32, GpuError> {
        let (input, draw) = (&mut *self.input, place.draw);
        let mut lookup = Lookup {
            frame: input.frame,
            textures: input.textures,
            replacements: input.replacements,
            samplers: &mut input.raster.samplers,
            table: input.table,
        };
        let bindings = &mut input.raster.bindings;
        let push = bindings.push(&mut lookup, input.uploaded.address, draw.bindings, draw.environment)?;
        let record = &input.scratch.draws[place.number];
        let located = Located {
            vertices: self.frame_place.of(record.vertices),
            record,
            indices: self.frame_place.of(input.scratch.commands[place.number].indices),
            push: &push,
        };
        let material = SaidMaterial::of(input.frame, draw, |map| image_word(&mut lookup, map))?;
        let number = self.surfaces.records.len() as u32;
        let rows = relative(&verdict.model, self.origin);
        let record = surface_draw(input.frame, draw, located, rows, kind, ray_mask, number);
        let record = material.write(SurfaceDraw { bake: place.bake, ..record });
        let record = ReplacedMaps::of(&mut lookup, draw)?.write(record);
        let record = self.former(record, place, verdict);
        self.surfaces.records.push(record);
        Ok(number)
    }
}

/// A number of an object, the same in all frames; not 0.
fn object_number(object: u64) -> u32 {
    (object ^ object >> 32) as u32 | 1
}

/// The model matrix of what rays meet. `number` is the draw's among the traced ones.
fn displaced(verdict: &Verdict, number: usize, options: &PathtraceOptions) -> Mat4 {
    let moved = options.move_draw.filter(|(which, _)| match which {
        Displaced::Draw(draw) => *draw as usize == number,
        Displaced::Class(class) => *class == verdict.class,
    });
    match moved {
        Some((_, by)) => Mat4::from_translation(by) * verdict.model,
        None => verdict.model,
    }
}
