//! What the camera sees of each frame at pixels' centres, by rays on the processor, and what of it was not in view a short time
//! before: whatever keeps a history has none there.

use std::ops::Range;

use afterglow_bvh::{
    Blas, BlasInput, BuildError, Hit, IDENTITY, Instance, Quality, Query, Ray, Scene as Rays, Tlas,
    build_blas_with, build_tlas, trace,
};
use afterglow_scene_file::{SceneFile, SequenceFrame};
use glam::{DMat4, DVec3, DVec4, Vec3};
use rayon::prelude::*;

/// What was out of view in one of so many frames before counts as uncovered.
const UNCOVERED_FRAMES: usize = 8;
/// A ray to a point ends this share of the way before it, so that it does not meet the point's own surface.
const NEAR_SHARE: f32 = 1e-3;
/// The address of the only bottom level; any multiple of 16.
const ADDRESS: u64 = 16;

/// Which pixels of a frame need to be looked at by themselves, a pixel each.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Pixels {
    /// Shows a point that was hidden, or outside of the picture, in one of the last frames.
    pub uncovered: Vec<bool>,
    /// Shows what no moving object covers, and one did in one of the last frames with the same camera.
    pub left_by_objects: Vec<bool>,
    /// A spherical light is seen, or next to it. Pathtrace does not show those.
    pub of_lights: Vec<bool>,
    /// The same of surfaces that shine.
    pub of_emitters: Vec<bool>,
}

/// Looks at frames.
pub struct Visibility<'a> {
    scene: &'a SceneFile,
    size: [usize; 2],
    /// Of each triangle its object.
    owners: Vec<Option<usize>>,
    /// Of each object whether any frame moves it.
    moves: Vec<bool>,
    lights: Option<World>,
    /// Of each frame that was needed so far.
    frames: Vec<Option<Seen>>,
}

/// What rays meet.
struct World {
    blas: Blas,
    tlas: Tlas,
}

/// A frame's world, and what is seen of it.
struct Seen {
    world: World,
    clip_from_world: DMat4,
    world_from_clip: DMat4,
    models: Vec<DMat4>,
    /// Of each pixel.
    points: Vec<Option<Point>>,
}

/// What a pixel shows.
#[derive(Clone, Copy)]
struct Point {
    object: Option<usize>,
    /// In the still scene, before objects move.
    position: DVec3,
}

impl<'a> Visibility<'a> {
    /// Of a scene with a sequence.
    pub fn new(scene: &'a SceneFile) -> Result<Self, BuildError> {
        let mut owners = vec![None; scene.triangles.corners.len()];
        for (number, object) in scene.objects.iter().enumerate() {
            owners[object.first_triangle..][..object.triangle_count].fill(Some(number));
        }
        let mut moves = vec![false; scene.objects.len()];
        for (object, _) in scene.frames.iter().flat_map(|frame| &frame.transforms) {
            moves[*object] = true;
        }
        let sphere = |light: &afterglow_scene_file::SphereLight| {
            light.center.extend(light.radius).as_vec4().to_array()
        };
        let spheres: Vec<[f32; 4]> = scene.sphere_lights.iter().map(sphere).collect();
        let lights = match spheres.is_empty() {
            true => None,
            false => Some(World::new(&BlasInput { spheres: &spheres, ..BlasInput::default() })?),
        };
        let frames = scene.frames.iter().map(|_| None).collect();
        let size = scene.size.map(|side| side as usize);
        Ok(Self { scene, size, owners, moves, lights, frames })
    }

    /// What is to be known of a frame's pixels; of those before, frames from `first` on count.
    pub fn pixels(&mut self, index: usize, first: usize) -> Result<Pixels, BuildError> {
        let before = index.saturating_sub(UNCOVERED_FRAMES).max(first)..index;
        // Frames are asked for in order.
        self.frames[..before.start].fill_with(|| None);
        for frame in before.start..=index {
            if self.frames[frame].is_none() {
                self.frames[frame] = Some(self.look(frame)?);
            }
        }
        // It has just been looked at.
        let Some(seen) = &self.frames[index] else { return Ok(Pixels::default()) };
        let [of_lights, of_emitters] = self.shining(seen);
        Ok(Pixels {
            uncovered: self.uncovered(seen, index, before.clone()),
            left_by_objects: self.left_by_objects(seen, index, before),
            of_lights,
            of_emitters,
        })
    }

    fn uncovered(&self, seen: &Seen, index: usize, before: Range<usize>) -> Vec<bool> {
        let frames = &self.scene.frames;
        let places = |frame: &SequenceFrame, other: &SequenceFrame| {
            frame.view == other.view && frame.transforms == other.transforms
        };
        let others: Vec<&Seen> = before
            .filter(|&other| !places(&frames[other], &frames[index]))
            .filter_map(|other| self.frames[other].as_ref())
            .collect();
        let is_new = |point: &Option<Point>| {
            point.is_some_and(|point| others.iter().any(|other| !other.shows(&point)))
        };
        seen.points.par_iter().map(is_new).collect()
    }

    fn left_by_objects(&self, seen: &Seen, index: usize, before: Range<usize>) -> Vec<bool> {
        let view = &self.scene.frames[index].view;
        let is_mover = |point: &Option<Point>| {
            point.and_then(|point| point.object).is_some_and(|object| self.moves[object])
        };
        let others: Vec<&Seen> = before
            .filter(|&other| self.scene.frames[other].view == *view)
            .filter_map(|other| self.frames[other].as_ref())
            .collect();
        let was_left =
            |(pixel, point)| !is_mover(point) && others.iter().any(|other| is_mover(&other.points[pixel]));
        seen.points.iter().enumerate().map(was_left).collect()
    }

    fn look(&self, index: usize) -> Result<Seen, BuildError> {
        let frame = &self.scene.frames[index];
        let mut models = vec![DMat4::IDENTITY; self.scene.objects.len()];
        for (object, model) in &frame.transforms {
            models[*object] = *model;
        }
        let world = self.world(&models)?;
        let clip_from_world = frame.view.projection * frame.view.modelview;
        let world_from_clip = clip_from_world.inverse();
        let [width, height] = self.size;
        let look = |pixel: usize| {
            let (x, y) = ((pixel % width) as f64 + 0.5, (pixel / width) as f64 + 0.5);
            let [near, far] = self.ray(&world_from_clip, x, y);
            world.first(near, far).and_then(|hit| self.point(&hit))
        };
        let points = (0..width * height).into_par_iter().map(look).collect();
        Ok(Seen { world, clip_from_world, world_from_clip, models, points })
    }

    /// Where a ray through a place of the picture begins and ends; pixels from its upper left corner.
    fn ray(&self, world_from_clip: &DMat4, x: f64, y: f64) -> [DVec3; 2] {
        let [width, height] = self.size.map(|side| side as f64);
        [-1.0, 1.0].map(|z| {
            world_from_clip.project_point3(DVec3::new(2.0 * x / width - 1.0, 1.0 - 2.0 * y / height, z))
        })
    }

    /// Pixels where a corner, or one of a neighbour, shows a spherical light; and those where it shows a surface that shines.
    /// Corners, since at the picture's edge a light may be seen in a part of a pixel only.
    fn shining(&self, seen: &Seen) -> [Vec<bool>; 2] {
        let [width, height] = self.size;
        let corner = |number: usize| {
            let (x, y) = (number % (width + 1), number / (width + 1));
            let [near, far] = self.ray(&seen.world_from_clip, x as f64, y as f64);
            let hit = seen.world.first(near, far);
            let light = self.lights.as_ref().and_then(|lights| lights.first(near, far));
            let is_light = light.is_some_and(|light| light.t < hit.map_or(f32::INFINITY, |hit| hit.t));
            (is_light, !is_light && hit.is_some_and(|hit| self.shines(&hit)))
        };
        let corners = (0..(width + 1) * (height + 1)).into_par_iter().map(corner);
        let (lights, emitters): (Vec<bool>, Vec<bool>) = corners.unzip();
        [self.about(&lights), self.about(&emitters)]
    }

    fn shines(&self, hit: &Hit) -> bool {
        let material = self.scene.triangles.materials.get(hit.primitive as usize);
        material.is_some_and(|material| self.scene.materials[*material as usize].emission != DVec3::ZERO)
    }

    /// Pixels less than two pixels away from chosen corners: pictures show the mean over a pixel's square, and not what is at
    /// a point.
    fn about(&self, corners: &[bool]) -> Vec<bool> {
        let [width, height] = self.size;
        let mut chosen = vec![false; width * height];
        for (corner, _) in corners.iter().enumerate().filter(|(_, chosen)| **chosen) {
            let (x, y) = (corner % (width + 1), corner / (width + 1));
            for row in y.saturating_sub(2)..(y + 2).min(height) {
                chosen[row * width + x.saturating_sub(2)..row * width + (x + 2).min(width)].fill(true);
            }
        }
        chosen
    }

    /// The triangles, with objects where they are in a frame.
    fn world(&self, models: &[DMat4]) -> Result<World, BuildError> {
        let triangles = &self.scene.triangles;
        let placed = |(corners, owner): (&[u32; 3], &Option<usize>)| {
            let model = owner.map_or(DMat4::IDENTITY, |object| models[object]);
            corners.map(|corner| model.transform_point3(self.corner(corner)).as_vec3().to_array())
        };
        let positions: Vec<[f32; 3]> = triangles.corners.iter().zip(&self.owners).flat_map(placed).collect();
        let numbers = 0..triangles.corners.len() as u32;
        let indices: Vec<[u32; 3]> = numbers.map(|triangle| [0, 1, 2].map(|c| 3 * triangle + c)).collect();
        World::new(&BlasInput { positions: &positions, indices: &indices, ..BlasInput::default() })
    }

    /// What was hit.
    fn point(&self, hit: &Hit) -> Option<Point> {
        let triangle = hit.primitive as usize;
        let triangles = &self.scene.triangles;
        let corners = triangles.corners.get(triangle)?.map(|corner| self.corner(corner));
        let [v, w] = hit.barycentrics.map(f64::from);
        Some(Point {
            object: self.owners[triangle],
            position: corners[0] * (1.0 - v - w) + corners[1] * v + corners[2] * w,
        })
    }

    fn corner(&self, position: u32) -> DVec3 {
        self.scene.triangles.positions[position as usize].as_dvec3()
    }
}

impl Seen {
    /// Whether a point is in the picture, and nothing before it.
    fn shows(&self, point: &Point) -> bool {
        let model = point.object.map_or(DMat4::IDENTITY, |object| self.models[object]);
        let position = model.transform_point3(point.position);
        let clip: DVec4 = self.clip_from_world * position.extend(1.0);
        let is_inside = clip.truncate().abs().cmple(DVec3::splat(clip.w)).all();
        // From where the near plane is before the point, which is right for any projection.
        let near = || self.world_from_clip.project_point3((clip.truncate() / clip.w).with_z(-1.0));
        is_inside && !self.world.is_blocked(near(), position)
    }
}

impl World {
    fn new(input: &BlasInput) -> Result<World, BuildError> {
        let blas = build_blas_with(input, Quality::Good)?;
        let tlas = build_tlas(&[Instance {
            object_to_world: IDENTITY,
            blas: ADDRESS,
            bounds: blas.bounds,
            id: 0,
            mask: 1,
            flags: 0,
        }])?;
        Ok(World { blas, tlas })
    }

    /// What is met first from one point to another; t from 0 to 1.
    fn first(&self, from: DVec3, to: DVec3) -> Option<Hit> {
        self.trace(from.as_vec3(), (to - from).as_vec3(), 1.0, false)
    }

    /// Whether something lies before a point as seen from another.
    fn is_blocked(&self, from: DVec3, point: DVec3) -> bool {
        self.trace(from.as_vec3(), (point - from).as_vec3(), 1.0 - NEAR_SHARE, true).is_some()
    }

    fn trace(&self, origin: Vec3, direction: Vec3, t_max: f32, any_hit: bool) -> Option<Hit> {
        let blas = |address| (address == ADDRESS).then_some(self.blas.words.as_slice());
        let ray = Ray { origin, t_min: 0.0, direction, t_max };
        trace(&Rays { tlas: &self.tlas.words, blas: &blas }, &ray, Query { mask: 1, any_hit }, &|_, _, _| {
            true
        })
    }
}

#[cfg(test)]
pub mod tests {
    use afterglow_scene_file::{Material, Model, Object, SphereLight, Triangles};

    use super::*;
    use crate::bench::denoise::sequence::tests::frame;

    pub const SIDE: usize = 32;

    /// A wall at z = 0, and a square before it, an object, whose middle is at x = -0.5; the eye is at z = 5.
    pub fn scene(frames: Vec<SequenceFrame>) -> SceneFile {
        let square = |x: f32, half: f32, z: f32| {
            [[x - half, -half, z], [x + half, -half, z], [x + half, half, z], [x - half, half, z]]
                .map(Vec3::from)
        };
        SceneFile {
            name: "test".into(),
            size: [SIDE as u32; 2],
            view: frames[0].view,
            sun: None,
            sky: None,
            sphere_lights: Vec::new(),
            materials: vec![Material {
                name: "grey".into(),
                model: Model::Lambert,
                base_color: Vec3::splat(0.5),
                roughness: 1.0,
                emission: DVec3::ZERO,
            }],
            triangles: Triangles {
                positions: [square(0.0, 20.0, 0.0), square(-0.5, 0.5, 1.0)].concat(),
                corners: vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]],
                materials: vec![0; 4],
            },
            objects: vec![Object { name: "square".into(), first_triangle: 2, triangle_count: 2 }],
            frames,
        }
    }

    /// Columns of the middle row that are chosen.
    fn columns(chosen: &[bool]) -> Vec<usize> {
        (0..SIDE).filter(|x| chosen[SIDE / 2 * SIDE + x]).collect()
    }

    /// The column that shows what is at x, so far before the eye.
    fn column(x: f64, distance: f64) -> usize {
        ((x / distance / 0.5f64.tan() + 1.0) * 0.5 * SIDE as f64).round() as usize
    }

    #[test]
    fn an_object_leaves_what_it_hid() {
        let scene = scene(vec![frame(0.0, 0.0, 1.0), frame(0.0, 0.0, 1.0), frame(0.0, 0.5, 1.0)]);
        let mut visibility = Visibility::new(&scene).unwrap();
        let still = visibility.pixels(1, 0).unwrap();
        assert!(still.uncovered.iter().chain(&still.left_by_objects).all(|pixel| !pixel));
        // From x = -1 to -0.5, 4 before the eye.
        let left: Vec<usize> = (column(-1.0, 4.0)..column(-0.5, 4.0)).collect();
        let moved = visibility.pixels(2, 0).unwrap();
        assert_eq!((columns(&moved.uncovered), columns(&moved.left_by_objects)), (left.clone(), left));
        // Frames that were not played do not count.
        assert!(visibility.pixels(2, 2).unwrap().uncovered.iter().all(|pixel| !pixel));
    }

    #[test]
    fn what_was_uncovered_is_old_after_some_frames() {
        let mut frames = vec![frame(0.0, 0.0, 1.0)];
        frames.resize(12, frame(0.0, 0.5, 1.0));
        let scene = scene(frames);
        let mut visibility = Visibility::new(&scene).unwrap();
        let mut count = |index| visibility.pixels(index, 0).unwrap().uncovered.iter().filter(|p| **p).count();
        assert_eq!(count(1), count(UNCOVERED_FRAMES));
        assert_eq!((count(1) > 0, count(UNCOVERED_FRAMES + 1)), (true, 0));
    }

    #[test]
    fn a_camera_uncovers_the_picture_s_edge_and_what_was_behind_something() {
        let scene = scene(vec![frame(0.0, 0.0, 1.0), frame(-1.0, 0.0, 1.0)]);
        let pixels = Visibility::new(&scene).unwrap().pixels(1, 0).unwrap();
        let found = columns(&pixels.uncovered);
        // The camera went to the left: what is at the left edge was outside, and beside the square there is what it hid.
        let outside = column(-5.0 * 0.5f64.tan() + 1.0, 5.0);
        // The wall behind the square: from x = -1.25 to 0 as seen from before, the square itself being now 1 further right.
        let hidden = column(-1.25 + 1.0, 5.0)..column(1.0, 5.0);
        let now = column(0.0, 4.0)..column(1.0, 4.0);
        let expected: Vec<usize> =
            (0..SIDE).filter(|x| *x < outside || hidden.contains(x) && !now.contains(x)).collect();
        assert_eq!(found, expected);
        assert!(pixels.left_by_objects.iter().all(|pixel| !pixel));
    }

    #[test]
    fn lights_are_told_with_their_neighbours_unless_they_are_behind_something() {
        let mut scene = scene(vec![frame(0.0, 0.0, 1.0)]);
        let light = |z| SphereLight {
            name: None,
            center: DVec3::new(0.0, 0.0, z),
            radius: 0.3,
            radiance: DVec3::ONE,
        };
        scene.sphere_lights = vec![light(2.0)];
        let of_lights = |scene: &SceneFile| Visibility::new(scene).unwrap().pixels(0, 0).unwrap().of_lights;
        let half = (0.3 / 3.0 / 0.5f64.tan() * 0.5 * SIDE as f64).round() as usize;
        let expected: Vec<usize> = (SIDE / 2 - half - 1..SIDE / 2 + half + 1).collect();
        assert_eq!(columns(&of_lights(&scene)), expected);
        scene.sphere_lights = vec![light(-2.0)];
        assert!(of_lights(&scene).iter().all(|pixel| !pixel));
    }
}
