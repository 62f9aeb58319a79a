//! OpenEXR by the `exr` crate.

use std::io::{BufRead, Seek, Write};

use ::exr::meta::MetaData;
use ::exr::prelude::traits::*;
use ::exr::prelude::{Image as ExrImage, SpecificChannels, Vec2};

use crate::error::FormatError;
use crate::image::{Encoding, Image, checked_pixel_count};

/// Reads R, G and B of the first flat layer that has them, as `f32`, at full resolution: its data window, wherever that lies in the
/// display window.
///
/// # Errors
/// If the bytes are no EXR, are damaged or cut off, no layer has the three channels, or a layer is too large.
pub fn read(reader: &mut (impl BufRead + Seek + Send)) -> Result<Image, FormatError> {
    let start = reader.stream_position()?;
    check_sizes(&MetaData::read_from_buffered(&mut *reader, false)?)?;
    reader.seek(std::io::SeekFrom::Start(start))?;

    let read = ::exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(Pixels::black, Pixels::set)
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(reader)?;
    let size = read.layer_data.size;
    let pixels = read.layer_data.channel_data.pixels.values;
    Image::new(size.width(), size.height(), Encoding::Linear, pixels)
}

/// Writes linear light as three `f32` channels, losslessly compressed.
///
/// # Errors
/// If the writer fails.
pub fn write(image: &Image, writer: &mut (impl Write + Seek)) -> Result<(), FormatError> {
    let linear = image.to_linear();
    let pixel = |at: Vec2<usize>| {
        let [r, g, b] = linear.pixel(at.x(), at.y());
        (r, g, b)
    };
    let channels = SpecificChannels::rgb(pixel);
    let file = ExrImage::from_channels((image.width(), image.height()), channels);
    Ok(file.write().non_parallel().to_buffered(writer)?)
}

fn check_sizes(meta: &MetaData) -> Result<(), FormatError> {
    for header in &meta.headers {
        checked_pixel_count(header.layer_size.width(), header.layer_size.height())?;
    }
    Ok(())
}

struct Pixels {
    width: usize,
    values: Vec<[f32; 3]>,
}

impl Pixels {
    fn black<Channels>(size: Vec2<usize>, _: &Channels) -> Self {
        Self { width: size.width(), values: vec![[0.0; 3]; size.area()] }
    }

    fn set(&mut self, at: Vec2<usize>, (r, g, b): (f32, f32, f32)) {
        self.values[at.y() * self.width + at.x()] = [r, g, b];
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;
    use crate::test_images as synthetic;

    fn file_of(image: &Image) -> Vec<u8> {
        let mut file = Cursor::new(Vec::new());
        write(image, &mut file).unwrap();
        file.into_inner()
    }

    #[test]
    fn keeps_every_bit() {
        let mut image = synthetic::wide_noisy();
        image.pixels_mut()[3] = [-1.5, f32::INFINITY, 1e-40];
        assert_eq!(read(&mut Cursor::new(file_of(&image))).unwrap(), image);
    }

    #[test]
    fn reads_half_floats_and_other_channels() {
        let channels = SpecificChannels::rgba(|at: Vec2<usize>| {
            let value = half::f16::from_f32(at.x() as f32 / 4.0);
            (value, value, half::f16::ONE, half::f16::ZERO)
        });
        let mut file = Cursor::new(Vec::new());
        ExrImage::from_channels((5, 2), channels).write().to_buffered(&mut file).unwrap();
        file.set_position(0);
        let image = read(&mut file).unwrap();
        assert_eq!((image.width(), image.height()), (5, 2));
        assert_eq!(image.pixel(3, 1), [0.75, 0.75, 1.0]);
    }

    #[test]
    fn a_layer_without_colours_is_an_error() {
        let channels = SpecificChannels::build().with_channel("Z").with_pixel_fn(|_: Vec2<usize>| (1.0f32,));
        let mut file = Cursor::new(Vec::new());
        ExrImage::from_channels((5, 2), channels).write().to_buffered(&mut file).unwrap();
        file.set_position(0);
        assert!(matches!(read(&mut file), Err(FormatError::Exr(_))));
    }

    #[test]
    fn damage_is_an_error_or_a_picture_but_never_a_panic() {
        let file = file_of(&synthetic::hdr());
        for length in (0..file.len()).step_by(97) {
            assert!(read(&mut Cursor::new(&file[..length])).is_err(), "{length}");
        }
        for position in (0..file.len().min(600)).step_by(3) {
            let mut damaged = file.clone();
            damaged[position] ^= 0xff;
            let _ = read(&mut Cursor::new(damaged));
        }
    }

    #[test]
    fn absurd_sizes_are_refused() {
        let mut file = file_of(&synthetic::hdr());
        let name = b"dataWindow\0box2i\0\x10\0\0\0";
        let at = file.windows(name.len()).position(|w| w == name).unwrap() + name.len();
        // The window's far corner: x, then y.
        file[at + 8..at + 12].copy_from_slice(&1_000_000i32.to_le_bytes());
        file[at + 12..at + 16].copy_from_slice(&1_000_000i32.to_le_bytes());
        assert!(read(&mut Cursor::new(file)).is_err());
    }
}
