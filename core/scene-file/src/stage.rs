//! Scenes as the renderer takes them: a frame as if a program had drawn it, and what is to be known of it.

use std::sync::Arc;

use afterglow_gl::frame::{
    Bindings, Clear, Compare, Cull, CurrentAttributes, Depth, Draw, Environment, FixedState, Frame, Hint,
    HintMaterial, Operation, RasterState, Rect, StateWords, Topology, Transform, VertexSource, Viewport,
};
use afterglow_scene::{Camera, Class, Scene, Verdict, srgb_from_linear};
use bytemuck::Zeroable;
use glam::{DMat3, DMat4, DVec3, Mat4};

use crate::draws::{LAYOUT, Part, parts};
use crate::error::Problem;
use crate::lights;
use crate::scene::{Model, SceneFile, SequenceFrame, Triangles, View};

/// What the triangles of no object are known as from frame to frame; objects come after it.
const REST: u64 = 1;

/// A scene ready to be drawn. Its vertices are the same memory in all frames, which the renderer uploads once.
#[derive(Debug)]
pub struct Stage {
    /// Without its triangles: `parts` has them.
    scene: SceneFile,
    size: [u32; 2],
    parts: Vec<Part>,
    /// Of each object, whether the sequence moves it.
    moves: Vec<bool>,
}

impl Stage {
    /// Makes draws of a scene's triangles.
    ///
    /// # Errors
    /// If there are too many pairs of objects and materials.
    pub fn new(mut scene: SceneFile) -> Result<Self, Problem> {
        let triangles: Triangles = std::mem::take(&mut scene.triangles);
        let mut moves = vec![false; scene.objects.len()];
        for (object, _) in scene.frames.iter().flat_map(|frame| &frame.transforms) {
            moves[*object] = true;
        }
        Ok(Self { parts: parts(&triangles, &scene.objects)?, size: scene.size, moves, scene })
    }

    /// The same scene in a picture of another size (pixels, at least 1). The vertical field of view stays.
    #[must_use]
    pub fn with_size(self, size: [u32; 2]) -> Self {
        Self { size: size.map(|side| side.max(1)), ..self }
    }

    /// Width and height of the picture, pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Frames of the sequence; 0 if the scene is a still.
    pub fn frame_count(&self) -> usize {
        self.scene.frames.len()
    }

    /// The still scene.
    pub fn still(&self) -> (Frame, Scene) {
        self.stage(None, None)
    }

    /// A frame of the sequence, counted from 0; the still scene where there is no such frame.
    pub fn staged(&self, index: usize) -> (Frame, Scene) {
        let before = index.checked_sub(1).and_then(|before| self.scene.frames.get(before));
        let frame = self.scene.frames.get(index);
        self.stage(frame, before.or(frame))
    }

    fn stage(&self, frame: Option<&SequenceFrame>, before: Option<&SequenceFrame>) -> (Frame, Scene) {
        let view = self.fitted(frame.map_or(self.scene.view, |frame| frame.view));
        let (models, former) = (self.models(frame), self.models(before));
        let sky = lights::sky(&self.scene, frame);
        let mut builder = Builder::new(self.size);
        builder.clear(srgb_from_linear(sky).to_array());
        let emission = self.emission(frame);
        for part in &self.parts {
            let model = part.object.map_or(DMat4::IDENTITY, |object| models[object]);
            builder.draw(part, &view, &model, self.hint(part, emission[part.material]));
        }
        let verdicts = self.parts.iter().zip(1..);
        let scene = Scene {
            camera: Some(Camera { view: view.modelview, projection: view.projection.as_mat4() }),
            verdicts: verdicts
                .map(|(part, operation)| self.verdict(part, operation, &models, &former))
                .collect(),
            lights: lights::lights(&self.scene, frame),
            sky,
            ..Scene::default()
        };
        (builder.frame, scene)
    }

    /// A view for the picture's own proportions.
    fn fitted(&self, view: View) -> View {
        let proportion = |[width, height]: [u32; 2]| f64::from(width) / f64::from(height);
        let stretch = proportion(self.scene.size) / proportion(self.size);
        let horizontally = DMat4::from_scale(DVec3::new(stretch, 1.0, 1.0));
        View { projection: horizontally * view.projection, ..view }
    }

    /// Where each object is.
    fn models(&self, frame: Option<&SequenceFrame>) -> Vec<DMat4> {
        let mut models = vec![DMat4::IDENTITY; self.scene.objects.len()];
        for (object, model) in frame.into_iter().flat_map(|frame| &frame.transforms) {
            models[*object] = *model;
        }
        models
    }

    /// Radiance that each material gives off.
    fn emission(&self, frame: Option<&SequenceFrame>) -> Vec<DVec3> {
        let mut emission: Vec<_> = self.scene.materials.iter().map(|material| material.emission).collect();
        for (material, factor) in frame.into_iter().flat_map(|frame| &frame.emission_scales) {
            emission[*material] *= *factor;
        }
        emission
    }

    fn hint(&self, part: &Part, emission: DVec3) -> Hint {
        let material = &self.scene.materials[part.material];
        Hint {
            object: id(part),
            class: None,
            material: HintMaterial {
                base_color: Some(material.base_color.to_array()),
                roughness_metallic: match material.model {
                    Model::Lambert => None,
                    Model::GgxMetal => Some([material.roughness, 1.0]),
                },
                emission: (emission != DVec3::ZERO).then(|| lights::finite(emission).to_array()),
                ..HintMaterial::default()
            },
        }
    }

    fn verdict(&self, part: &Part, operation: u32, models: &[DMat4], former: &[DMat4]) -> Verdict {
        let place = |models: &[DMat4]| part.object.map_or(Mat4::IDENTITY, |object| models[object].as_mat4());
        let moves = part.object.is_some_and(|object| self.moves[object]);
        Verdict {
            operation,
            class: if moves { Class::Movable } else { Class::Static },
            reason: "scene file",
            model: place(models),
            object: id(part),
            previous: Some(place(former)),
            baked: false,
            triangles: (part.range.indices.len() / 3) as u32,
            base: None,
        }
    }
}

/// The object that a part is of, the same in all frames.
fn id(part: &Part) -> u64 {
    part.object.map_or(REST, |object| REST + 1 + object as u64)
}

/// A frame in the making: unlit triangles in one colour each, with a depth test.
struct Builder {
    frame: Frame,
}

impl Builder {
    fn new([width, height]: [u32; 2]) -> Self {
        let mut frame = Frame { size: (width, height), ..Frame::default() };
        frame.fixed.push(fixed());
        frame.viewports.push(Viewport {
            rect: Rect { x: 0, y: 0, width: width as i32, height: height as i32 },
            depth_range: [0.0, 1.0],
            scissor: None,
        });
        frame.bindings.push(Bindings::default());
        frame.environments.push(Environment {
            point_size: 1.0,
            point_size_max: 1.0,
            point_attenuation: [1.0, 0.0, 0.0],
            line_width: 1.0,
            fog_density: 1.0,
            fog_end: 1.0,
            ..Environment::zeroed()
        });
        Self { frame }
    }

    fn clear(&mut self, [red, green, blue]: [f32; 3]) {
        self.frame.operations.push(Operation::Clear(Clear {
            color: Some([red, green, blue, 1.0].map(|channel| channel.clamp(0.0, 1.0))),
            color_mask: 0xf,
            depth: Some(1.0),
            stencil: None,
            scissor: None,
        }));
    }

    fn draw(&mut self, part: &Part, view: &View, model: &DMat4, hint: Hint) {
        let frame = &mut self.frame;
        let [red, green, blue] =
            srgb_from_linear(hint.material.base_color.unwrap_or_default().into()).to_array();
        frame.transforms.push(transform(view, model));
        frame.current.push(CurrentAttributes {
            normal: [0.0, 0.0, 1.0, 1.0],
            color: [red, green, blue, 1.0],
            secondary: [0.0, 0.0, 0.0, 1.0],
            ..CurrentAttributes::zeroed()
        });
        frame.hints.push(hint);
        let number = frame.retained.len() as u32;
        frame.retained.push(Arc::clone(&part.range));
        frame.operations.push(Operation::Draw(Draw {
            source: VertexSource::Retained { range: number, first_index: 0 },
            layout: LAYOUT,
            topology: Topology::Triangles,
            index_count: part.range.indices.len() as u32,
            fixed: 0,
            viewport: 0,
            bindings: 0,
            transform: number,
            lights: 0,
            material: 0,
            environment: 0,
            texgen: 0,
            texture_matrices: 0,
            clip_planes: 0,
            current: number,
            hint: number + 1,
        }));
    }
}

fn fixed() -> FixedState {
    let mut words = StateWords::default();
    words.global.set_alpha_func(Compare::Always as u32);
    FixedState {
        words,
        raster: RasterState {
            blend: None,
            logic_op: None,
            color_mask: 0xf,
            depth: Some(Depth { compare: Compare::Less, write: true }),
            stencil: None,
            cull: Cull::None,
            front_ccw: true,
            depth_bias: None,
            line_width: 1.0.into(),
            line_stipple: None,
        },
    }
}

/// Products in f64, rounded once.
fn transform(view: &View, model: &DMat4) -> Transform {
    let modelview = view.modelview * *model;
    Transform {
        modelview: modelview.as_mat4().to_cols_array_2d(),
        projection: view.projection.as_mat4().to_cols_array_2d(),
        modelview_projection: (view.projection * modelview).as_mat4().to_cols_array_2d(),
        normal: DMat3::from_mat4(modelview).inverse().transpose().as_mat3().to_cols_array_2d(),
    }
}
