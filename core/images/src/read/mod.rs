//! From a file's bytes to a picture.

mod dds;
mod ktx2;
mod png;
mod stored;

#[cfg(test)]
pub(crate) mod testing;

use crate::error::ImageError;
use crate::mipmaps::Averaging;
use crate::name::Role;
use crate::picture::Picture;
pub(crate) use stored::Layout;

/// Bytes of a file, at most.
pub const MOST_FILE_BYTES: u64 = 1 << 28;

/// What a device takes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Abilities {
    /// BC1 to BC7 as they are. Otherwise they are unpacked.
    pub compressed: bool,
}

/// Makes a picture of a file: what it is follows from its first bytes. Compressed texels stay so if the device takes them
/// and the file has mipmaps; mipmaps are made where there are none. BC6H is always unpacked, and encoded as sRGB is.
///
/// # Errors
/// If the file is none of the three formats, damaged, too large, or of a form that is not read.
pub fn decode(bytes: &[u8], role: Role, abilities: Abilities) -> Result<Picture, ImageError> {
    if bytes.len() as u64 > MOST_FILE_BYTES {
        return Err(ImageError::LargeFile);
    }
    let stored = match bytes {
        [0x89, b'P', b'N', b'G', ..] => png::read(bytes)?,
        [0xab, b'K', b'T', b'X', b' ', b'2', ..] => ktx2::read(bytes)?,
        [b'D', b'D', b'S', b' ', ..] => dds::read(bytes)?,
        _ => return Err(ImageError::Unknown),
    };
    let averaging = match role {
        Role::Color => Averaging::Color,
        Role::Normal => Averaging::Plain,
        Role::Emission => Averaging::Emission,
    };
    stored.picture(averaging, abilities)
}

#[cfg(test)]
mod tests {
    use super::testing::{self, Level};
    use super::*;
    use crate::picture::{Channels, Format};

    const PLAIN: Abilities = Abilities { compressed: false };
    const BLOCKS: Abilities = Abilities { compressed: true };
    const RED: [u8; 4] = [255, 0, 0, 255];

    fn color(bytes: &[u8], abilities: Abilities) -> Picture {
        decode(bytes, Role::Color, abilities).unwrap()
    }

    #[test]
    fn the_three_formats_hold_the_same_picture() {
        let texels = [[10, 20, 30, 40], [50, 60, 70, 80]];
        let png = color(&testing::png(2, 1, &texels), PLAIN);
        let level = Level { width: 2, height: 1, bytes: texels.concat() };
        let ktx2 = color(&testing::ktx2(37, 0, std::slice::from_ref(&level)), PLAIN);
        let zstd = color(&testing::ktx2(37, 2, std::slice::from_ref(&level)), PLAIN);
        let dds = color(&testing::dds(28, std::slice::from_ref(&level)), PLAIN);
        assert_eq!((png.width, png.height, png.format), (2, 1, Format::Rgba8));
        assert_eq!(png.channels, Channels::Rgba);
        assert_eq!(png.levels.len(), 2);
        assert_eq!(png.levels[0], texels.concat());
        assert_eq!((&ktx2, &zstd, &dds), (&png, &png, &png));
    }

    #[test]
    fn blocks_stay_blocks_where_the_device_takes_them() {
        let levels: Vec<_> = [(8, 8, 4), (4, 4, 1), (2, 2, 1), (1, 1, 1)]
            .map(|(width, height, blocks)| Level { width, height, bytes: testing::RED_BC1.repeat(blocks) })
            .into();
        for file in [testing::ktx2(133, 2, &levels), testing::dds(71, &levels)] {
            let kept = color(&file, BLOCKS);
            assert_eq!((kept.format, kept.levels.len()), (Format::Bc1Alpha, 4));
            assert_eq!(kept.levels[0], testing::RED_BC1.repeat(4));
            let unpacked = color(&file, PLAIN);
            assert_eq!((unpacked.format, unpacked.levels.len()), (Format::Rgba8, 4));
            assert!(unpacked.levels.iter().all(|level| level.as_chunks::<4>().0.iter().all(|t| *t == RED)));
            assert_eq!(unpacked.levels[0].len(), 8 * 8 * 4);
        }
        // Without mipmaps they are unpacked, so that some can be made.
        let alone = color(&testing::dds(71, &levels[..1]), BLOCKS);
        assert_eq!((alone.format, alone.levels.len()), (Format::Rgba8, 4));
    }

    #[test]
    fn light_beyond_white_is_kept() {
        // BC6H of mode 11 with both endpoints at 0x1ff of 10 bits: 0.5 * 31/64 of the greatest half's bits.
        let level = Level { width: 4, height: 4, bytes: testing::bright_bc6h().to_vec() };
        let picture = decode(&testing::dds(95, &[level]), Role::Emission, BLOCKS).unwrap();
        assert_eq!((picture.format, picture.channels), (Format::Rgba16F, Channels::Rgb));
        let first: &[half::f16] = bytemuck::cast_slice(&picture.levels[0][..8]);
        assert!(first[0].to_f32() > 1.0, "{first:?}");
    }

    #[test]
    fn damage_is_an_error() {
        let level = Level { width: 2, height: 1, bytes: vec![7; 8] };
        let files = [
            testing::png(2, 1, &[RED; 2]),
            testing::ktx2(37, 0, std::slice::from_ref(&level)),
            testing::ktx2(37, 2, std::slice::from_ref(&level)),
            testing::dds(28, std::slice::from_ref(&level)),
        ];
        for file in &files {
            for length in 0..file.len() - 1 {
                let cut = decode(&file[..length], Role::Color, PLAIN);
                // Of a PNG, what comes after the texels may be missing.
                assert!(cut.is_err() || file[0] == 0x89 && length > 50, "{length} of {}", file.len());
            }
            // Whatever a byte becomes, nothing panics.
            for place in 0..file.len() {
                for value in [0, 1, 0x7f, 0xff] {
                    let mut other = file.clone();
                    other[place] = value;
                    let _ = decode(&other, Role::Normal, BLOCKS);
                }
            }
        }
        assert!(matches!(decode(b"GIF89a", Role::Color, PLAIN), Err(ImageError::Unknown)));
    }

    #[test]
    fn absurd_sizes_are_refused() {
        let level = Level { width: 1 << 20, height: 1 << 20, bytes: vec![0; 64] };
        for file in [testing::ktx2(37, 2, std::slice::from_ref(&level)), testing::dds(28, &[level])] {
            assert!(matches!(decode(&file, Role::Color, PLAIN), Err(ImageError::Size { .. })));
        }
        // A level that unpacks to more than it should.
        let level = Level { width: 1, height: 1, bytes: vec![0; 1 << 20] };
        assert!(decode(&testing::ktx2(37, 2, &[level]), Role::Color, PLAIN).is_err());
    }
}
