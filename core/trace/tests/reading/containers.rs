//! The same trace in every container.

use std::io::Write;

use afterglow_trace::{Container, TraceEnd, TraceError, TraceReader};
use flate2::Compression;
use flate2::write::{GzEncoder, ZlibEncoder};

use crate::{drain, open, read, sample};

/// apitrace's own framing, in chunks of so many bytes.
pub fn snappy(bytes: &[u8], chunk: usize) -> Vec<u8> {
    let mut file = b"at".to_vec();
    for chunk in bytes.chunks(chunk) {
        let data = snap::raw::Encoder::new().compress_vec(chunk).unwrap();
        file.extend((data.len() as u32).to_le_bytes());
        file.extend(data);
    }
    file
}

pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

pub fn zlib(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

pub fn brotli(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = brotli::CompressorWriter::new(Vec::new(), 4096, 5, 24);
    encoder.write_all(bytes).unwrap();
    encoder.into_inner()
}

/// The trace in each container.
pub fn all(bytes: &[u8]) -> Vec<(Container, Vec<u8>)> {
    vec![
        (Container::Snappy, snappy(bytes, 1 << 20)),
        (Container::Snappy, snappy(bytes, 3)),
        (Container::Gzip, gzip(bytes)),
        (Container::Zlib, zlib(bytes)),
        (Container::Brotli, brotli(bytes)),
        (Container::Raw, bytes.to_vec()),
    ]
}

#[test]
fn every_container_holds_the_same_trace() {
    for version in [1, 6] {
        for (container, file) in all(&sample::encode(version)) {
            let mut reader = open(&file).unwrap();
            assert_eq!(reader.container(), container);
            let outcome = drain(&mut reader);
            assert_eq!(outcome.lines, sample::lines(), "{container}");
            assert!(outcome.end.unwrap().is_clean());
            assert_eq!(reader.file_position(), file.len() as u64);
        }
    }
}

#[test]
fn gzip_members_are_concatenated() {
    let bytes = sample::encode(6);
    let (start, end) = bytes.split_at(100);
    let outcome = read(&[gzip(start), gzip(end)].concat());
    assert_eq!(outcome.lines, sample::lines());
}

#[test]
fn blobs_larger_than_a_block_are_read() {
    use crate::encoder::{Encoder, V};
    let blob: Vec<u8> = (0..5_000_000u32).map(|i| (i / 3) as u8).collect();
    let mut encoder = Encoder::new(6);
    encoder.call(0, &sample::CLEAR, vec![V::Blob(blob.clone())], None);
    for (_, file) in all(&encoder.bytes).split_off(2) {
        let outcome = read(&file);
        assert!(**outcome.calls[0].arg(0).as_blob().unwrap() == *blob);
    }
}

#[test]
fn a_file_is_opened_by_path() {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(&snappy(&sample::encode(6), 64)).unwrap();
    let mut reader = TraceReader::open(file.path()).unwrap();
    assert_eq!(drain(&mut reader).lines, sample::lines());

    let missing = TraceReader::open(file.path().with_extension("missing"));
    let error = missing.err().unwrap();
    assert!(matches!(error, TraceError::Open { .. }));
    assert!(error.to_string().contains("cannot be opened"));
}

#[test]
fn what_is_no_trace_is_refused() {
    let nothing: &[&[u8]] = &[
        b"",
        b"\n",
        b"glBegin(GL_QUADS)\n",
        b"\x7fELF\x02\x01\x01\0\0\0\0\0",
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
        &[0; 600],
        &[0xff; 600],
    ];
    for bytes in nothing {
        let error = open(bytes).err();
        assert!(matches!(error, Some(TraceError::NotATrace)), "{bytes:?}: {error:?}");
    }
}

#[test]
fn a_tail_of_zeros_is_a_cut() {
    let bytes = sample::encode(6);
    let outcome = read(&[snappy(&bytes, 50), vec![0; 4096]].concat());
    assert_eq!(outcome.lines, sample::lines());
    let end = TraceEnd::Truncated { incomplete: 0, offset: bytes.len() as u64 };
    assert_eq!(outcome.end.unwrap(), end);
}

/// Reads a damaged file that holds the sample, and checks that all of it comes before the error.
fn damaged_behind_the_sample(file: &[u8]) {
    let outcome = read(file);
    assert_eq!(outcome.lines, sample::lines());
    match outcome.end {
        Err(TraceError::Container { offset, .. }) => {
            assert_eq!(offset, sample::encode(6).len() as u64);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_wrong_check_sum_is_damage_behind_the_calls() {
    for mut file in [gzip(&sample::encode(6)), zlib(&sample::encode(6))] {
        let last = file.len() - 1;
        file[last] ^= 1;
        damaged_behind_the_sample(&file);
    }
}

#[test]
fn an_overlong_chunk_is_damage_behind_the_calls() {
    let mut file = snappy(&sample::encode(6), 60);
    file.extend([0xff; 9]);
    damaged_behind_the_sample(&file);
}

#[test]
fn a_damaged_chunk_yields_its_start() {
    let bytes = sample::encode(6);
    let data = snap::raw::Encoder::new().compress_vec(&bytes).unwrap();
    // The same elements, a longer promise, and a copy from before the start of the data.
    let mut chunk = vec![(bytes.len() + 10) as u8 | 0x80, ((bytes.len() + 10) >> 7) as u8];
    chunk.extend(&data[2..]);
    chunk.extend([9 << 2 | 2, 0xff, 0xff]);
    let length = (chunk.len() as u32).to_le_bytes();
    damaged_behind_the_sample(&[b"at", &length[..], &chunk].concat());
}

#[test]
fn damaged_deflate_data_yield_their_start() {
    let bytes = sample::encode(6);
    // A stored block, not the last one, and then a block of the type that does not exist.
    let mut file = vec![0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 3, 0];
    file.extend((bytes.len() as u16).to_le_bytes());
    file.extend((!bytes.len() as u16).to_le_bytes());
    file.extend(&bytes);
    file.extend([0xff; 20]);
    damaged_behind_the_sample(&file);
}

#[test]
fn gzip_headers_may_say_more() {
    let file = gzip(&sample::encode(6));
    let mut full = vec![0x1f, 0x8b, 8, 2 | 4 | 8 | 16, 1, 2, 3, 4, 2, 3];
    full.extend([3, 0, b'e', b'x', b't']);
    full.extend(b"name\0comment\0");
    full.extend([0, 0]);
    full.extend(&file[10..]);
    full.extend(b"what follows is ignored");
    let outcome = read(&full);
    assert_eq!(outcome.lines, sample::lines());
    assert!(outcome.end.unwrap().is_clean());
}

#[test]
fn a_reader_may_be_dropped_before_the_end() {
    let mut bytes = sample::encode(6);
    let event_start = bytes.len();
    bytes.resize(event_start + 20_000_000, 0);
    let mut reader = open(&snappy(&bytes, 1 << 20)).unwrap();
    assert!(reader.next_call(&mut Default::default()).unwrap());
    drop(reader);
}
