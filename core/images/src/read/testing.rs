//! Tiny files, made by hand.

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

/// A level of a file.
#[derive(Clone)]
pub(crate) struct Level {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) bytes: Vec<u8>,
}

/// A block of BC1 that is red.
pub(crate) const RED_BC1: [u8; 8] = [0x00, 0xf8, 0x00, 0xf8, 0, 0, 0, 0];

/// A block of BC6H in mode 11 (one region, endpoints of 10 bits as they are): both endpoints bright and white.
pub(crate) fn bright_bc6h() -> [u8; 16] {
    let mut bits = 0b00011u128;
    for endpoint in 0..6 {
        bits |= 0x2f0 << (5 + 10 * endpoint);
    }
    bits.to_le_bytes()
}

pub(crate) fn png(width: u32, height: u32, texels: &[[u8; 4]]) -> Vec<u8> {
    let mut file = Vec::new();
    PngEncoder::new(&mut file)
        .write_image(&texels.concat(), width, height, ExtendedColorType::Rgba8)
        .unwrap();
    file
}

/// A KTX2 file of a `VkFormat`, its levels as they are (scheme 0) or by zstd (2).
pub(crate) fn ktx2(format: u32, scheme: u32, levels: &[Level]) -> Vec<u8> {
    let mut file = ktx2::MAGIC.to_vec();
    let header = [format, 1, levels[0].width, levels[0].height, 0, 0, 1, levels.len() as u32, scheme];
    let descriptor = 80 + 24 * levels.len() as u32;
    for word in header.into_iter().chain([descriptor, 4, 0, 0, 0, 0, 0, 0]) {
        file.extend(word.to_le_bytes());
    }
    let mut data = 4u32.to_le_bytes().to_vec();
    for level in levels {
        let stored = match scheme {
            2 => ruzstd::encoding::compress_to_vec(
                &level.bytes[..],
                ruzstd::encoding::CompressionLevel::Fastest,
            ),
            _ => level.bytes.clone(),
        };
        let place = u64::from(descriptor) + data.len() as u64;
        for number in [place, stored.len() as u64, level.bytes.len() as u64] {
            file.extend(number.to_le_bytes());
        }
        data.extend(stored);
    }
    file.extend(data);
    file
}

/// A DDS file of a `DXGI_FORMAT`.
pub(crate) fn dds(format: u32, levels: &[Level]) -> Vec<u8> {
    let (width, height) = (levels[0].width, levels[0].height);
    let mut words = [0u32; 37];
    words[0] = u32::from_le_bytes(*b"DDS ");
    // Caps, height, width, pixel format, number of mipmaps.
    words[1..8].copy_from_slice(&[124, 0x2_1007, height, width, 0, 0, levels.len() as u32]);
    // A pixel format that refers to the extended header.
    words[19..22].copy_from_slice(&[32, 4, u32::from_le_bytes(*b"DX10")]);
    words[27] = 0x1000;
    // Format, two dimensions, no flags, one picture.
    words[32..37].copy_from_slice(&[format, 3, 0, 1, 0]);
    let mut file: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    file.extend(levels.iter().flat_map(|level| level.bytes.iter().copied()));
    file
}
