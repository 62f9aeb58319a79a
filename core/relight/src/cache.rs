//! What was found, as bytes: a world that comes again is not searched again.
//!
//! Little-endian: magic, version, key, the fields of [`Found`] in order, and the XXH3 of all before. Whatever was damaged
//! reads as nothing.

use crate::types::{Baked, Falloff, FalloffModel, Found, Light, Options, Sky, Source};
use glam::Vec3;
use xxhash_rust::xxh3::{Xxh3, xxh3_64};

const MAGIC: &[u8; 8] = b"AGRELIT\0";
/// Changes with the format and whenever the search finds better.
const VERSION: u32 = 1;
/// Most bytes that are read.
const MOST_BYTES: usize = 1 << 26;
/// Bytes of the checksum.
const CHECKSUM: usize = 8;

/// A key of all that [`crate::recover`] depends on, but the order of nothing: other order, other key.
pub fn key(baked: &Baked, options: &Options) -> u64 {
    let mut hasher = Xxh3::new();
    let mut number = |n: u64| hasher.update(&n.to_le_bytes());
    number(u64::from(VERSION));
    number(options.seed);
    number(options.max_sources as u64);
    number(options.rays);
    number(options.saturation.map_or(u64::MAX, |level| u64::from(level.to_bits())));
    number(match options.falloff {
        FalloffModel::InverseSquare => 0,
        FalloffModel::Linear => 1,
        FalloffModel::Either => 2,
    });
    number(u64::from(options.least_evidence.to_bits()));
    hash_triangles(&mut hasher, baked.triangles);
    hasher.update(&(baked.patches.len() as u64).to_le_bytes());
    for patch in baked.patches {
        for vector in [patch.position, patch.normal, patch.irradiance, patch.albedo] {
            hash_vector(&mut hasher, vector);
        }
        hasher.update(&patch.area.to_le_bytes());
    }
    hasher.update(&(baked.emitters.len() as u64).to_le_bytes());
    for emitter in baked.emitters {
        hash_triangles(&mut hasher, &emitter.triangles);
        hasher.update(&[u8::from(emitter.two_sided)]);
        hasher.update(&emitter.preference.to_le_bytes());
    }
    match baked.sky {
        Sky::None => hasher.update(&[0]),
        Sky::Open => hasher.update(&[1]),
        Sky::Surfaces(triangles) => {
            hasher.update(&[2]);
            hash_triangles(&mut hasher, triangles);
        }
    }
    hasher.digest()
}

fn hash_triangles(hasher: &mut Xxh3, triangles: &[[Vec3; 3]]) {
    hasher.update(&(triangles.len() as u64).to_le_bytes());
    triangles.iter().flatten().for_each(|&corner| hash_vector(hasher, corner));
}

fn hash_vector(hasher: &mut Xxh3, vector: Vec3) {
    vector.to_array().iter().for_each(|c| hasher.update(&c.to_le_bytes()));
}

/// The bytes of what was found for a key.
pub fn to_bytes(key: u64, found: &Found) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend(key.to_le_bytes());
    bytes.extend((found.lights.len() as u32).to_le_bytes());
    for light in &found.lights {
        let (kind, numbers) = source_to_numbers(&light.source);
        bytes.push(kind);
        numbers.iter().for_each(|n| bytes.extend(n.to_le_bytes()));
        put_vector(&mut bytes, light.power);
        bytes.extend(light.evidence.to_le_bytes());
    }
    put_vector(&mut bytes, found.ambient);
    put_vector(&mut bytes, found.bounce);
    bytes.push(u8::from(found.one_bounce));
    bytes.extend(found.residual.to_le_bytes());
    bytes.extend((found.per_patch.len() as u32).to_le_bytes());
    found.per_patch.iter().for_each(|error| bytes.extend(error.to_le_bytes()));
    bytes.extend(found.explained.to_le_bytes());
    bytes.extend(found.rays.to_le_bytes());
    bytes.extend(xxh3_64(&bytes).to_le_bytes());
    bytes
}

fn put_vector(bytes: &mut Vec<u8>, vector: Vec3) {
    vector.to_array().iter().for_each(|c| bytes.extend(c.to_le_bytes()));
}

/// Every source is a kind and five numbers.
fn source_to_numbers(source: &Source) -> (u8, [f32; 5]) {
    match *source {
        Source::Point { position: p, radius, falloff: Falloff::InverseSquare } => {
            (0, [p.x, p.y, p.z, radius, 0.0])
        }
        Source::Point { position: p, radius, falloff: Falloff::Linear { reach } } => {
            (1, [p.x, p.y, p.z, radius, reach])
        }
        Source::Sun { direction: d, angular_radius } => (2, [d.x, d.y, d.z, angular_radius, 0.0]),
        Source::Area { emitter } => (3, [f32::from_bits(emitter as u32), 0.0, 0.0, 0.0, 0.0]),
        Source::Sky => (4, [0.0; 5]),
    }
}

fn source_from_numbers(kind: u8, [a, b, c, d, e]: [f32; 5]) -> Option<Source> {
    let position = Vec3::new(a, b, c);
    Some(match kind {
        0 => Source::Point { position, radius: d, falloff: Falloff::InverseSquare },
        1 => Source::Point { position, radius: d, falloff: Falloff::Linear { reach: e } },
        2 => Source::Sun { direction: position, angular_radius: d },
        3 => Source::Area { emitter: a.to_bits() as usize },
        4 => Source::Sky,
        _ => return None,
    })
}

/// What [`to_bytes`] wrote for this key; None for another key, another version and anything damaged.
pub fn from_bytes(key: u64, bytes: &[u8]) -> Option<Found> {
    let (content, checksum) = bytes.split_at_checked(bytes.len().checked_sub(CHECKSUM)?)?;
    if bytes.len() > MOST_BYTES || xxh3_64(content).to_le_bytes() != checksum {
        return None;
    }
    let mut reader = Reader(content.strip_prefix(MAGIC)?);
    if reader.u32()? != VERSION || reader.u64()? != key {
        return None;
    }
    let mut found = Found::default();
    for _ in 0..reader.u32()? {
        let kind = reader.u8()?;
        let mut numbers = [0.0; 5];
        for number in &mut numbers {
            *number = reader.f32()?;
        }
        let source = source_from_numbers(kind, numbers)?;
        found.lights.push(Light { source, power: reader.vector()?, evidence: reader.f32()? });
    }
    (found.ambient, found.bounce) = (reader.vector()?, reader.vector()?);
    found.one_bounce = reader.u8()? != 0;
    found.residual = reader.f32()?;
    for _ in 0..reader.u32()? {
        found.per_patch.push(reader.f32()?);
    }
    (found.explained, found.rays) = (reader.f32()?, reader.u64()?);
    reader.0.is_empty().then_some(found)
}

/// Takes from the front for as long as there is enough.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk::<N>()?;
        self.0 = rest;
        Some(*first)
    }

    fn u8(&mut self) -> Option<u8> {
        self.take::<1>().map(|[byte]| byte)
    }

    fn u32(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Option<u64> {
        self.take().map(u64::from_le_bytes)
    }

    fn f32(&mut self) -> Option<f32> {
        self.take().map(f32::from_le_bytes)
    }

    fn vector(&mut self) -> Option<Vec3> {
        Some(Vec3::new(self.f32()?, self.f32()?, self.f32()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::types::{Emitter, Patch};

    fn found() -> Found {
        let falloff = Falloff::Linear { reach: 7.0 };
        let sources = [
            Source::Point {
                position: Vec3::new(1.0, 2.0, 3.0),
                radius: 0.1,
                falloff: Falloff::InverseSquare,
            },
            Source::Point { position: Vec3::new(-1.0, 2.5, 3.0), radius: 0.2, falloff },
            Source::Sun { direction: Vec3::Z, angular_radius: 0.0 },
            Source::Area { emitter: 4_000_000 },
            Source::Sky,
        ];
        let light = |source| Light { source, power: Vec3::new(0.5, 0.25, 8.0), evidence: 0.125 };
        Found {
            lights: sources.map(light).to_vec(),
            ambient: Vec3::X,
            bounce: Vec3::Y,
            one_bounce: true,
            residual: 0.03,
            per_patch: vec![0.1, f32::INFINITY, 0.0],
            explained: 0.9,
            rays: 1 << 40,
        }
    }

    #[test]
    fn what_was_written_is_read() {
        let bytes = to_bytes(7, &found());
        assert_eq!(from_bytes(7, &bytes), Some(found()));
        assert_eq!(from_bytes(8, &bytes), None);
        assert_eq!(from_bytes(7, &to_bytes(7, &Found::default())), Some(Found::default()));
    }

    #[test]
    fn damage_reads_as_nothing() {
        let bytes = to_bytes(7, &found());
        for end in 0..bytes.len() {
            assert_eq!(from_bytes(7, &bytes[..end]), None);
        }
        for bit in 0..bytes.len() * 8 {
            let mut flipped = bytes.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert_eq!(from_bytes(7, &flipped), None, "bit {bit}");
        }
        assert_eq!(from_bytes(7, &[&bytes[..], &[0]].concat()), None);
    }

    #[test]
    fn forged_counts_are_not_believed() {
        let mut bytes = to_bytes(7, &Found::default());
        bytes.truncate(bytes.len() - CHECKSUM);
        bytes[20..24].fill(0xff);
        bytes.extend(xxh3_64(&bytes).to_le_bytes());
        assert_eq!(from_bytes(7, &bytes), None);
    }

    #[test]
    fn all_that_counts_is_in_the_key() {
        let triangles = [[Vec3::ZERO, Vec3::X, Vec3::Y]];
        let patch = Patch {
            position: Vec3::ZERO,
            normal: Vec3::Z,
            area: 1.0,
            irradiance: Vec3::ONE,
            albedo: Vec3::ONE,
        };
        let emitters = [Emitter { triangles: triangles.to_vec(), two_sided: false, preference: 1.0 }];
        let base = Baked { triangles: &triangles, patches: &[patch], emitters: &emitters, sky: Sky::None };
        let options = Options::default();
        let brighter = [Patch { irradiance: Vec3::splat(1.5), ..patch }];
        let two_sided = [Emitter { two_sided: true, ..emitters[0].clone() }];
        let keys = [
            key(&base, &options),
            key(&Baked { triangles: &[], ..base }, &options),
            key(&Baked { patches: &brighter, ..base }, &options),
            key(&Baked { emitters: &two_sided, ..base }, &options),
            key(&Baked { sky: Sky::Open, ..base }, &options),
            key(&Baked { sky: Sky::Surfaces(&triangles), ..base }, &options),
            key(&base, &Options { seed: 2, ..options }),
            key(&base, &Options { saturation: Some(1.0), ..options }),
        ];
        let distinct: std::collections::BTreeSet<u64> = keys.into_iter().collect();
        assert_eq!(distinct.len(), keys.len());
        assert_eq!(key(&base, &options), keys[0]);
    }
}
