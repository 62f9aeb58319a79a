//! Denoisers alone, on light that is made up.

use afterglow_gpu::{BindlessSizes, Buffer, Commands, vk};
use afterglow_records::{GuideTexel, LuminanceTexel, MotionTexel, StratumTexel, TraceCounters, ViewRecord};
use bytemuck::Zeroable;

use super::*;
use crate::pathtrace::pipelines::run;
use crate::testing::{assert_valid, gpu};

const SIZE: [u32; 2] = [37, 29];
const TEXELS: usize = (SIZE[0] * SIZE[1]) as usize;
/// Frames that are gathered over at most.
const LONGEST: f32 = 16.0;

/// Light of a texel, the same in all channels.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Light([f32; 3]);

impl Light {
    fn luminance(self) -> f32 {
        let [red, green, blue] = self.0;
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    }

    /// Whether it is another but for a thousandth.
    fn is_about(self, other: Self) -> bool {
        self.0.iter().zip(other.0).all(|(found, wanted)| (found - wanted).abs() <= 1e-3 * wanted)
    }

    /// In nine bits each and a shared exponent.
    fn word(self) -> u32 {
        let greatest = self.0.into_iter().fold(0.0, f32::max);
        let exponent = ((greatest.to_bits() >> 23) as i32 - 126).max(-15);
        let steps = self.0.map(|color| (color / 2f32.powi(exponent - 9)).round() as u32);
        steps[0] | steps[1] << 9 | steps[2] << 18 | ((exponent + 15) as u32) << 27
    }

    fn texel(self) -> [u32; 4] {
        [self.word(), self.word(), self.word(), 0]
    }

    fn of(word: u32) -> Self {
        let unit = 2f32.powi((word >> 27) as i32 - 24);
        Self([word, word >> 9, word >> 18].map(|bits| (bits & 511) as f32 * unit))
    }
}

/// Luminance as [`LuminanceTexel`] has it, the same three times.
fn luminance_word(luminance: f32, is_again: bool) -> u32 {
    let exponent = ((luminance.to_bits() >> 23) as i32 - 119).clamp(0, 15);
    let steps = (luminance * 2f32.powi(16 - exponent) + 0.5).min(511.0) as u32;
    steps | steps << 9 | steps << 18 | (exponent as u32) << 27 | u32::from(is_again) << 31
}

/// What a denoiser has made of a frame.
struct Clean {
    colors: Vec<[u32; 4]>,
    deviations: Vec<u32>,
}

impl Clean {
    fn light(&self, texel: usize, channel: usize) -> Light {
        Light::of(self.colors[texel][channel])
    }

    fn lights(&self, channel: usize) -> impl Iterator<Item = f32> {
        (0..TEXELS).map(move |texel| self.light(texel, channel).0[0])
    }
}

/// What a denoiser makes of frames of one window.
struct Subject {
    gpu: Gpu,
    table: BindlessTable,
    plan: Plan,
    stages: StagePipelines,
    stores: Stores,
    counters: Buffer,
    frame: u32,
}

impl Subject {
    fn new(denoiser: Denoiser) -> Self {
        let gpu = gpu();
        let table = gpu.create_bindless_table(BindlessSizes::default()).unwrap();
        let plan = denoiser.plan();
        let mut stages = StagePipelines::default();
        stages.make_ready(&gpu, &table, &plan).unwrap();
        let stores = Stores::new(&gpu, &plan, SIZE).unwrap();
        let zeros = bytemuck::bytes_of(&TraceCounters::zeroed()).to_vec();
        let counters = gpu.upload_buffer("counters", vk::BufferUsageFlags::empty(), &zeros).unwrap();
        Self { gpu, table, plan, stages, stores, counters, frame: 0 }
    }

    fn parity(&self) -> usize {
        self.frame as usize % 2
    }

    /// The record of a view that looks along -z at a wall 5 away.
    fn record(&self) -> Buffer {
        let address = |store| self.stores.address(store, self.parity());
        let has_history = self.frame > 0;
        let mut clip = [[0.0; 4]; 4];
        // Half of the picture is as wide as the wall is far.
        clip[0][0] = 1.0;
        clip[1][1] = 1.0;
        clip[3][2] = -1.0;
        let step = 2.0 / SIZE[0] as f32;
        let record = ViewRecord {
            counters: self.counters.address(),
            guides: address(Store::Guides),
            guides_before: if has_history { address(Store::GuidesBefore) } else { 0 },
            motions: address(Store::Motions),
            noisy: address(Store::Noisy),
            history: address(Store::History),
            strata: address(Store::Strata),
            gradients: self.plan.gradients.map_or(0, address),
            luminances: address(Store::Luminances),
            fits: address(Store::Fits),
            width: SIZE[0],
            height: SIZE[1],
            light_width: SIZE[0],
            light_height: SIZE[1],
            light_step: [1.0; 2],
            pixel_spread: step,
            forward: [0.0, 0.0, -1.0],
            pixel_origin: [-1.0 + step / 2.0, 1.0 - step / 2.0, -1.0],
            pixel_right: [step, 0.0, 0.0],
            pixel_down: [0.0, -step, 0.0],
            clip_before: clip,
            depth_before: [0.0, 0.0, -1.0, 0.0],
            longest: [LONGEST; 3],
            frame_number: self.frame,
            ..ViewRecord::zeroed()
        };
        self.gpu.upload_buffer("view", vk::BufferUsageFlags::empty(), bytemuck::bytes_of(&record)).unwrap()
    }

    fn steps(&self, steps: &[Step], record: &Buffer) {
        for step in steps {
            let push = step.push(record.address(), &self.stores, self.parity());
            let groups = step.stage.groups(SIZE);
            let pipeline = self.stages.get(step.stage).unwrap();
            self.gpu
                .run(|commands: &Commands<'_>| run(commands, &self.table, pipeline, &push, groups))
                .unwrap();
        }
    }

    /// Of each texel, the one of the frame before whose numbers it is traced with.
    fn again(&self) -> Vec<Option<usize>> {
        let mut again = vec![None; TEXELS];
        if self.plan.uses(Store::Strata) {
            let bytes = self.stores.read(&self.gpu, Store::Strata, self.parity());
            let strata: Vec<StratumTexel> = bytemuck::pod_collect_to_vec(&bytes);
            let across = SIZE[0].div_ceil(3);
            for (number, stratum) in strata.iter().enumerate().filter(|(_, stratum)| stratum.chosen < 9) {
                let (x, y) = (
                    number as u32 % across * 3 + stratum.chosen % 3,
                    number as u32 / across * 3 + stratum.chosen / 3,
                );
                again[(y * SIZE[0] + x) as usize] = Some(stratum.before as usize);
            }
        }
        again
    }

    /// A frame of the light that texels have in a frame, which shows these guides, nothing having moved. Where older numbers are used
    /// again, the light is of the frame before if `repeats`. Returns what the denoiser makes of it.
    fn frame(&mut self, guides: &[GuideTexel], repeats: bool, light: impl Fn(usize, u32) -> Light) -> Clean {
        let parity = self.parity();
        let depth = |guide: &GuideTexel| if self.frame > 0 { guide.depth } else { 0.0 };
        let motions: Vec<_> =
            guides.iter().map(|guide| MotionTexel { offset: 0, depth: depth(guide) }).collect();
        self.stores.fill(&self.gpu, Store::Guides, parity, bytemuck::cast_slice(guides));
        self.stores.fill(&self.gpu, Store::Motions, parity, bytemuck::cast_slice(&motions));
        if self.frame == 0 {
            self.stores.fill(&self.gpu, Store::Luminances, parity, &[0; 4 * TEXELS]);
        }
        let record = self.record();
        self.steps(&self.plan.before_light, &record);
        let again = self.again();
        let traced = |texel: usize| match again[texel] {
            Some(before) if repeats => light(before, self.frame - 1),
            _ => light(texel, self.frame),
        };
        let mut noisy: Vec<_> = (0..TEXELS).flat_map(|texel| traced(texel).texel()).collect();
        noisy.resize(5 * TEXELS, 0);
        let luminances: Vec<_> = (0..TEXELS)
            .map(|texel| luminance_word(traced(texel).luminance(), again[texel].is_some()))
            .map(|word| LuminanceTexel { word })
            .collect();
        self.stores.fill(&self.gpu, Store::Noisy, parity, bytemuck::cast_slice(&noisy));
        self.stores.fill(&self.gpu, Store::Luminances, parity, bytemuck::cast_slice(&luminances));
        let record = self.record();
        self.steps(&self.plan.after_light, &record);
        let output = self.stores.read(&self.gpu, self.plan.output.unwrap(), parity);
        self.frame += 1;
        assert_valid();
        let (colors, deviations) = output.split_at(16 * TEXELS);
        Clean {
            colors: bytemuck::pod_collect_to_vec(colors),
            deviations: bytemuck::pod_collect_to_vec(deviations),
        }
    }
}

/// A wall that faces the eye.
fn wall() -> Vec<GuideTexel> {
    vec![GuideTexel { depth: 5.0, normal: 0, bits: 1 << 18 | 15 << 20 }; TEXELS]
}

/// A number of [0, 1) for a texel of a frame.
fn noise(texel: usize, frame: u32) -> f32 {
    let bits = xxhash_rust::xxh3::xxh3_64(&[texel as u64, u64::from(frame)].map(u64::to_le_bytes).concat());
    (bits >> 40) as f32 / (1 << 24) as f32
}

const DENOISERS: [Denoiser; 3] = [Denoiser::Svgf, Denoiser::Asvgf, Denoiser::Bmfr];

#[test]
fn constant_light_stays_as_it_is() {
    // Every third texel lies elsewhere and faces another way, every fifth shows nothing.
    let guides: Vec<_> = (0..TEXELS)
        .map(|texel| GuideTexel {
            depth: if texel % 5 == 4 { 0.0 } else { 5.0 + (texel % 3) as f32 },
            normal: (texel % 3) as u32 * 0x2000,
            bits: (((1 + texel % 2) << 18) | ((texel % 16) << 20)) as u32,
        })
        .collect();
    for denoiser in DENOISERS {
        for constant in [[0.75, 0.5, 0.125], [4096.0, 2048.0, 0.0], [6.103_515_6e-5; 3]] {
            let mut subject = Subject::new(denoiser);
            for frame in 0..6 {
                let clean = subject.frame(&guides, true, |_, _| Light(constant));
                for (texel, guide) in guides.iter().enumerate().filter(|(_, guide)| guide.depth > 0.0) {
                    for channel in 0..3 {
                        let found = clean.light(texel, channel);
                        let about = format!("{denoiser:?}, frame {frame}, {guide:?}");
                        // Fits are sums of what rounding leaves a little off.
                        match denoiser {
                            Denoiser::Bmfr => assert!(found.is_about(Light(constant)), "{about}: {found:?}"),
                            _ => assert_eq!(found, Light(constant), "{about}"),
                        }
                    }
                    // No sample differs from another.
                    assert_eq!(clean.deviations[texel], 0, "{denoiser:?}, frame {frame}");
                }
            }
        }
    }
}

#[test]
fn noise_goes_and_its_mean_stays() {
    for denoiser in DENOISERS {
        let mut subject = Subject::new(denoiser);
        let (mut errors, mut means) = (Vec::new(), Vec::new());
        for frame in 0..24 {
            // Few bright samples, as paths have them; the mean is 1.
            let light = |texel, frame| Light([if noise(texel, frame) < 0.25 { 4.0 } else { 0.0 }; 3]);
            let clean = subject.frame(&wall(), true, light);
            let direct: Vec<_> = clean.lights(0).map(f64::from).collect();
            let mean = direct.iter().sum::<f64>() / TEXELS as f64;
            let error =
                (direct.iter().map(|value| (value - 1.0).powi(2)).sum::<f64>() / TEXELS as f64).sqrt();
            errors.push(error);
            // What is rarely bright is taken for noise where one frame alone says what it is.
            assert!((mean - 1.0).abs() < 0.25, "{denoiser:?}, frame {frame}: {mean}");
            // These samples are 1.5 % too bright by chance, A-SVGF is 2.9 % so, and fits of its histories 3.4 %.
            let most = if denoiser == Denoiser::Bmfr { 0.05 } else { 0.03 };
            assert!(frame < 23 || (mean - 1.0).abs() < most, "{denoiser:?}: {mean}");
            means.push(mean);
        }
        println!("{denoiser:?}: {errors:.3?}, {means:.3?}");
        // Samples themselves are 1.73 off.
        assert!(errors[0] < 0.5 && errors[23] < 0.1, "{denoiser:?}: {errors:?}");
    }
}

#[test]
fn light_that_changes_is_believed_at_once_by_gradients_alone() {
    let after_change = |denoiser| {
        let mut subject = Subject::new(denoiser);
        let mut mean = 0.0;
        for frame in 0..20 {
            let bright = if frame < 18 { 1.0 } else { 0.125 };
            let clean = subject.frame(&wall(), false, |_, _| Light([bright; 3]));
            mean = clean.lights(2).map(f64::from).sum::<f64>() / TEXELS as f64;
        }
        mean
    };
    let [svgf, asvgf, bmfr] = DENOISERS.map(after_change);
    assert!(svgf > 0.7, "{svgf}");
    assert!((asvgf - 0.125).abs() < 0.01, "{asvgf}");
    assert!((bmfr - 0.125).abs() < 0.01, "{bmfr}");
}

#[test]
fn edges_between_surfaces_stay() {
    for denoiser in DENOISERS {
        let mut subject = Subject::new(denoiser);
        let is_left = |texel: usize| texel as u32 % SIZE[0] < 18;
        // Two walls, one behind the other.
        let guides: Vec<_> = wall()
            .into_iter()
            .enumerate()
            .map(|(texel, guide)| GuideTexel { depth: if is_left(texel) { 5.0 } else { 8.0 }, ..guide })
            .collect();
        for frame in 0..4 {
            let light = |texel, frame| {
                let mean = if is_left(texel) { 1.0 } else { 0.1 };
                Light([mean * 2.0 * noise(texel, frame); 3])
            };
            let clean = subject.frame(&guides, true, light);
            for (texel, found) in clean.lights(1).enumerate() {
                assert!(is_left(texel) == (found > 0.3), "{denoiser:?}, frame {frame}: {found}");
            }
        }
    }
}

#[test]
fn where_nothing_is_there_is_no_light() {
    let nothing = vec![GuideTexel { depth: 0.0, ..wall()[0] }; TEXELS];
    for denoiser in DENOISERS {
        let mut subject = Subject::new(denoiser);
        for _ in 0..2 {
            let clean = subject.frame(&nothing, true, |_, _| Light([0.0; 3]));
            assert!(clean.lights(0).all(|light| light == 0.0), "{denoiser:?}");
        }
    }
}

#[test]
fn surfaces_of_a_texel_each_stay_finite() {
    // No texel is like its neighbour, and most are alone in their class; light is as bright as it can be, or nothing.
    let guides: Vec<_> = (0..TEXELS)
        .map(|texel| GuideTexel {
            depth: if noise(texel, 2) < 0.9 { 0.0 } else { 0.01 + 1e4 * noise(texel, 0).powi(8) },
            normal: (noise(texel, 1) * 65536.0) as u32 * 0x1_0001,
            bits: (1 + texel as u32 % 3) << 18 | 15 << 20,
        })
        .collect();
    for denoiser in DENOISERS {
        let mut subject = Subject::new(denoiser);
        for frame in 0..3 {
            let light = |texel, frame| Light([if noise(texel, frame) < 0.5 { 0.0 } else { 65408.0 }; 3]);
            let clean = subject.frame(&guides, true, light);
            for (texel, channel) in (0..TEXELS).flat_map(|texel| [0, 1, 2].map(|channel| (texel, channel))) {
                let found = clean.light(texel, channel).0;
                let is_light = found.iter().all(|value| value.is_finite() && *value >= 0.0);
                assert!(is_light, "{denoiser:?}, frame {frame}: {found:?}");
            }
        }
    }
}

#[test]
fn fits_follow_light_that_grows_across_a_wall() {
    let mut subject = Subject::new(Denoiser::Bmfr);
    // To the second order in what a fit knows.
    let mean = |texel: usize| {
        let [x, y] = [texel as u32 % SIZE[0], texel as u32 / SIZE[0]].map(|place| place as f32 / 37.0);
        0.25 + x * x + 0.5 * y
    };
    let light = |texel, frame| Light([2.0 * noise(texel, frame) * mean(texel); 3]);
    let clean = subject.frame(&wall(), true, light);
    let squares = clean.lights(1).enumerate().map(|(texel, found)| (found / mean(texel) - 1.0).powi(2));
    let error = (squares.sum::<f32>() / TEXELS as f32).sqrt();
    // A frame alone is 0.58 off.
    assert!(error < 0.15, "{error}");
}
