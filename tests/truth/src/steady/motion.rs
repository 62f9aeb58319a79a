//! Whether the camera goes as a camera does, and as most of what is drawn says.

use std::collections::{HashMap, HashSet};
use std::hash::{DefaultHasher, Hash, Hasher};

use afterglow_gl::frame::{Draw, Format, Frame, Slot, Topology, VertexSource};
use afterglow_scene::{Class, Recovery, Scene};
use glam::{DMat4, DVec2, DVec3, Vec3};

/// Vertices that stand for a draw.
const SAMPLES: usize = 6;
/// Pixels that a vertex may be off.
const TOLERANCE: f64 = 0.5;
/// Frames after which a camera that went away and comes back was wrong.
const RETURN: usize = 3;
/// How much longer than nearly all steps a jump is, and the share that nearly all are.
const JUMP: f64 = 5.0;
const NEARLY_ALL: f64 = 0.9;
/// Draws that are compared with each other.
const RIVALS: usize = 24;

/// A draw as it is seen in a frame.
#[derive(Debug, Clone)]
pub struct Seen {
    /// Names its content and texture.
    pub key: u64,
    pub class: Class,
    pub object: u64,
    pub reason: &'static str,
    /// In perspective, and it tests and writes depth.
    pub is_solid: bool,
    pub samples: Vec<Vec3>,
    /// Object to clip space.
    clip: DMat4,
    /// Middle of the samples and their extent, world space.
    pub place: DVec3,
    pub extent: f64,
    /// Half of the viewport, pixels.
    half: DVec2,
}

/// A frame in which most of what is drawn disagrees with the camera.
#[derive(Debug, Clone)]
pub struct Doubt {
    pub frame: u32,
    /// Pixels across that draws reach which have the same content as in the frame before.
    pub matched: f64,
    /// Of these, those of draws that stand still by the camera.
    pub agree: f64,
    /// The most that stand still by another camera.
    pub rival: f64,
    /// The other says that the camera rests.
    pub rests: bool,
    /// What most of those are that agree with the other.
    pub of: (Class, &'static str),
}

/// The way of the camera.
#[derive(Debug, Default)]
pub struct Journey {
    /// Frame, epoch, view.
    views: Vec<(u32, u64, DMat4)>,
    last: HashMap<u64, Seen>,
    last_camera: Option<DMat4>,
    pub doubts: Vec<Doubt>,
    /// Share of what is matched that agrees: sum and frames.
    pub agreement: (f64, u32),
}

/// What the steps of the eye say.
#[derive(Debug, Default)]
pub struct Steps {
    /// Of the frames in which it moves: the median, and what nearly all are shorter than.
    pub median: f64,
    pub long: f64,
    pub worst: (f64, u32),
    /// Jumps that did not return: frames.
    pub jumps: Vec<u32>,
    /// Frames from which the eye jumped away, and those in which it was back.
    pub returned: Vec<(u32, u32)>,
}

/// The draws of a frame.
pub fn seen(frame: &Frame, scene: &Scene, recovery: &Recovery) -> Vec<Seen> {
    let matrix = |columns: &[[f32; 4]; 4]| DMat4::from_cols_array_2d(&columns.map(|c| c.map(f64::from)));
    let draws = frame.draws().zip(&scene.verdicts).filter(|((_, d), _)| d.topology == Topology::Triangles);
    let seen = draws.filter_map(|((_, draw), verdict)| {
        let (key, samples) = content(frame, draw, recovery)?;
        let transform = &frame.transforms[draw.transform as usize];
        let raster = &frame.fixed[draw.fixed as usize].raster;
        let rect = frame.viewports[draw.viewport as usize].rect;
        let is_perspective = transform.projection.iter().take(3).any(|column| column[3] != 0.0);
        let world = verdict.model.as_dmat4();
        let at: Vec<DVec3> = samples.iter().map(|p| world.transform_point3(p.as_dvec3())).collect();
        let (least, most) = (at.iter().copied().reduce(DVec3::min)?, at.iter().copied().reduce(DVec3::max)?);
        Some(Seen {
            key,
            class: verdict.class,
            object: verdict.object,
            reason: verdict.reason,
            // Programs leave blending on.
            is_solid: is_perspective
                && raster.depth.is_some_and(|depth| depth.write)
                && !matches!(
                    verdict.class,
                    Class::Translucent | Class::OtherView | Class::Interface | Class::ViewModel
                ),
            samples,
            clip: matrix(&transform.projection) * matrix(&transform.modelview),
            place: (least + most) / 2.0,
            extent: (most - least).length(),
            half: DVec2::new(rect.width.into(), rect.height.into()) / 2.0,
        })
    });
    seen.collect()
}

/// Name of a draw's content, and some of its vertices.
fn content(frame: &Frame, draw: &Draw, recovery: &Recovery) -> Option<(u64, Vec<Vec3>)> {
    let mut hasher = DefaultHasher::new();
    let count = draw.index_count as usize;
    let last = count.checked_sub(1)?;
    let step = |i: usize, of: usize| i * last / (of - 1).max(1);
    let samples = (0..SAMPLES.min(count)).filter_map(|i| position(frame, draw, step(i, SAMPLES)));
    match draw.source {
        VertexSource::Retained { range, first_index } => {
            (frame.retained.get(range as usize)?.content_hash(), first_index).hash(&mut hasher);
        }
        VertexSource::Arena { .. } => {
            let hashed = count.min(256);
            for i in 0..hashed {
                position(frame, draw, step(i, hashed))
                    .map(|p| p.to_array().map(f32::to_bits))
                    .hash(&mut hasher);
            }
        }
    }
    let binding = frame.bindings.get(draw.bindings as usize).and_then(|units| units[0]);
    (count, binding.and_then(|b| recovery.image(b.image)).map(|image| image.content())).hash(&mut hasher);
    let samples: Vec<Vec3> = samples.filter(|p| p.is_finite()).collect();
    (!samples.is_empty()).then(|| (hasher.finish(), samples))
}

/// Object space position at an index of a draw.
fn position(frame: &Frame, draw: &Draw, index: usize) -> Option<Vec3> {
    let (words, indices) = frame.geometry(draw);
    let slot = Slot::Position as usize;
    let start = *indices.get(index)? as usize * draw.layout.stride() + draw.layout.offset(slot);
    let component = |i: usize| words.get(start + i).map(|word| f32::from_bits(*word));
    match draw.layout.format(slot) {
        Format::F2 => Some(Vec3::new(component(0)?, component(1)?, 0.0)),
        Format::F3 | Format::F4 => Some(Vec3::new(component(0)?, component(1)?, component(2)?)),
        _ => None,
    }
}

impl Seen {
    /// Pixels across that it reaches on screen, at most as many as the viewport has.
    fn reach(&self) -> f64 {
        let on_screen = self.samples.iter().filter_map(|sample| {
            let clip = self.clip * sample.as_dvec3().extend(1.0);
            let at = clip.truncate().truncate() / clip.w;
            (clip.w > 0.0).then(|| at.clamp(DVec2::NEG_ONE, DVec2::ONE) * self.half)
        });
        let (least, most) = on_screen
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(least, most), at| (least.min(at), most.max(at)));
        if least.x <= most.x { least.distance(most) } else { 0.0 }
    }
}

impl Journey {
    /// Takes note of a frame.
    pub fn add(&mut self, frame: u32, scene: &Scene, seen: &[Seen]) {
        let camera = scene.camera.map(|camera| camera.projection.as_dmat4() * camera.view);
        self.views.extend(scene.camera.map(|camera| (frame, scene.epoch, camera.view)));
        let mut now: HashMap<u64, Seen> = HashMap::new();
        let mut twice = HashSet::new();
        for seen in seen.iter().filter(|seen| seen.is_solid) {
            if now.insert(seen.key, seen.clone()).is_some() {
                twice.insert(seen.key);
            }
        }
        now.retain(|key, _| !twice.contains(key));
        if let Some((before, camera)) = self.last_camera.zip(camera) {
            self.compare(frame, camera * before.inverse(), &now);
        }
        (self.last, self.last_camera) = (now, camera);
    }

    /// Compares what the camera says with what the draws say.
    fn compare(&mut self, frame: u32, step: DMat4, now: &HashMap<u64, Seen>) {
        let mut pairs: Vec<(&Seen, &Seen)> =
            now.iter().filter_map(|(key, seen)| Some((seen, self.last.get(key)?))).collect();
        pairs.sort_by_key(|(seen, _)| seen.key);
        if pairs.is_empty() {
            return;
        }
        let reach = |step: DMat4| -> f64 {
            pairs.iter().filter(|(now, before)| agrees(step, now, before)).map(|(now, _)| now.reach()).sum()
        };
        let matched: f64 = pairs.iter().map(|(now, _)| now.reach()).sum();
        let agree = reach(step);
        self.agreement.0 += if matched > 0.0 { agree / matched } else { 1.0 };
        self.agreement.1 += 1;
        let (mut rival, mut rests, mut of) = (0.0, false, (Class::Undecided, ""));
        if 2.0 * agree < matched {
            let spread = pairs.len().div_ceil(RIVALS);
            for (now, before) in pairs.iter().step_by(spread) {
                let other = now.clip * before.clip.inverse();
                let support = reach(other);
                if support > rival {
                    (rival, rests) = (support, other.abs_diff_eq(DMat4::IDENTITY, 1e-6));
                    of = commonest(pairs.iter().filter(|(now, before)| agrees(other, now, before)));
                }
            }
        }
        if rival > agree {
            self.doubts.push(Doubt { frame, matched, agree, rival, rests, of });
        }
    }

    /// The steps of the eye from frame to frame of the same world.
    pub fn steps(&self) -> Steps {
        let eye = |view: &DMat4| view.inverse().w_axis.truncate();
        let eyes: Vec<(u32, u64, DVec3)> = self.views.iter().map(|(f, e, v)| (*f, *e, eye(v))).collect();
        let step = |a: usize, b: usize| eyes[a].2.distance(eyes[b].2);
        let same = |a: usize, b: usize| eyes[a].1 == eyes[b].1 && eyes[b].0 - eyes[a].0 <= RETURN as u32 + 1;
        let pairs = || (1..eyes.len()).filter(|&i| same(i - 1, i));
        let mut lengths: Vec<f64> = pairs().map(|i| step(i - 1, i)).filter(|l| *l > 1e-6).collect();
        lengths.sort_by(f64::total_cmp);
        let at = |share: f64| lengths.get((share * lengths.len() as f64) as usize).copied().unwrap_or(0.0);
        let (median, long) = (at(0.5), at(NEARLY_ALL));
        let mut steps = Steps { median, long, ..Steps::default() };
        let mut skip_to = 0;
        for i in pairs() {
            let length = step(i - 1, i);
            if length > steps.worst.0 {
                steps.worst = (length, eyes[i].0);
            }
            if length <= JUMP * long || i < skip_to {
                continue;
            }
            let back = (i + 1..eyes.len().min(i + 1 + RETURN))
                .find(|&j| same(i - 1, j) && step(i - 1, j) < 0.25 * length);
            match back {
                Some(j) => {
                    steps.returned.push((eyes[i].0, eyes[j].0));
                    skip_to = j + 1;
                }
                None => steps.jumps.push(eyes[i].0),
            }
        }
        steps
    }
}

/// What most draws are taken for, and why.
fn commonest<'a>(pairs: impl Iterator<Item = &'a (&'a Seen, &'a Seen)>) -> (Class, &'static str) {
    let mut counts: HashMap<(Class, &'static str), u32> = HashMap::new();
    for (now, _) in pairs {
        *counts.entry((now.class, now.reason)).or_default() += 1;
    }
    let most = counts.into_iter().max_by_key(|((_, reason), count)| (*count, *reason));
    most.map_or((Class::Undecided, ""), |(what, _)| what)
}

/// Whether a draw stands still if the camera goes by `step`, which takes clip space from a frame to the next.
fn agrees(step: DMat4, now: &Seen, before: &Seen) -> bool {
    let expected = step * before.clip;
    now.samples.iter().all(|sample| {
        let (a, b) = (expected * sample.as_dvec3().extend(1.0), now.clip * sample.as_dvec3().extend(1.0));
        if a.w <= 0.0 || b.w <= 0.0 {
            return (a - b).length() < 1e-3 * b.length().max(1.0);
        }
        let off = (a.truncate().truncate() / a.w - b.truncate().truncate() / b.w) * now.half;
        off.length() <= TOLERANCE || (a - b).length() < 1e-4 * b.length()
    })
}
