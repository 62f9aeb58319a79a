//! Meshes of NumPy archives. Whatever a file claims, no more is read than `MOST_NUMBERS` of an array.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use afterglow_bvh::room::Mesh;
use npyz::{Deserialize, NpyFile, Order};
use zip::ZipArchive;

use crate::failure::Failure;

/// Most numbers of an array: as many as 2^26 triangles have corners.
const MOST_NUMBERS: u64 = 3 << 26;

/// Reads `positions` (V, 3) of f32 and `triangles` (T, 3) of u32, which must name positions.
pub fn read_mesh(path: &Path) -> Result<Mesh, Failure> {
    let failed = |reason: String| Failure::input(path, reason);
    let file = File::open(path).map_err(|error| failed(error.to_string()))?;
    let mut archive = ZipArchive::new(BufReader::new(file)).map_err(|error| failed(error.to_string()))?;
    let positions: Vec<[f32; 3]> = read_triples(&mut archive, "positions").map_err(failed)?;
    let triangles: Vec<[u32; 3]> = read_triples(&mut archive, "triangles").map_err(failed)?;
    let count = positions.len();
    if triangles.iter().flatten().any(|&corner| corner as usize >= count) {
        return Err(failed(format!("a triangle has a corner beyond the {count} positions")));
    }
    Ok((positions, triangles))
}

fn read_triples<T: Deserialize + Copy>(
    archive: &mut ZipArchive<BufReader<File>>,
    name: &str,
) -> Result<Vec<[T; 3]>, String> {
    let entry = archive.by_name(&format!("{name}.npy")).map_err(|error| format!("{name}: {error}"))?;
    triples(entry).map_err(|reason| format!("{name}: {reason}"))
}

/// The rows of an array of shape (n, 3).
fn triples<T: Deserialize + Copy>(bytes: impl Read) -> Result<Vec<[T; 3]>, String> {
    let array = NpyFile::new(bytes).map_err(|error| error.to_string())?;
    let shape = array.shape().to_vec();
    if shape.len() != 2 || shape[1] != 3 {
        return Err(format!("of shape {shape:?}, not (n, 3)"));
    }
    if shape[0] > MOST_NUMBERS / 3 {
        return Err(format!("{} rows are too many", shape[0]));
    }
    let by_columns = array.order() == Order::Fortran;
    let numbers = array.data::<T>().map_err(|error| error.to_string())?;
    // Grows as numbers come: a header can claim what does not follow.
    let mut all = Vec::new();
    for number in numbers {
        all.push(number.map_err(|error| error.to_string())?);
    }
    let count = all.len() / 3;
    let row = |row: usize| match by_columns {
        true => [all[row], all[count + row], all[2 * count + row]],
        false => [all[3 * row], all[3 * row + 1], all[3 * row + 2]],
    };
    Ok((0..count).map(row).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An array's bytes by the format's specification: magic, version 1.0, a header of 118 bytes, numbers.
    fn npy(header: &str, numbers: &[u8]) -> Vec<u8> {
        let mut bytes = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
        bytes.extend(format!("{header:<117}\n").into_bytes());
        bytes.extend(numbers);
        bytes
    }

    #[test]
    fn rows_are_read() {
        let header = "{'descr': '<u4', 'fortran_order': False, 'shape': (2, 3), }";
        let bytes = npy(header, bytemuck::cast_slice(&[1u32, 2, 3, 4, 5, 6]));
        assert_eq!(triples::<u32>(&bytes[..]), Ok(vec![[1, 2, 3], [4, 5, 6]]));
        assert!(triples::<f32>(&bytes[..]).is_err());
        assert!(triples::<u32>(&bytes[..bytes.len() - 1]).is_err());
    }

    #[test]
    fn other_shapes_and_lies_are_refused() {
        for shape in ["(6,)", "(3, 2)", "(2, 3, 1)", "(9000000000, 3)"] {
            let header = format!("{{'descr': '<u4', 'fortran_order': False, 'shape': {shape}, }}");
            assert!(triples::<u32>(&npy(&header, &[0; 24])[..]).is_err(), "{shape}");
        }
        let turned = "{'descr': '<u4', 'fortran_order': True, 'shape': (2, 3), }";
        let bytes = npy(turned, bytemuck::cast_slice(&[1u32, 4, 2, 5, 3, 6]));
        assert_eq!(triples::<u32>(&bytes[..]), Ok(vec![[1, 2, 3], [4, 5, 6]]));
        assert!(triples::<u32>(&b"no array"[..]).is_err());
        let claims = "{'descr': '<u4', 'fortran_order': False, 'shape': (60000000, 3), }";
        assert!(triples::<u32>(&npy(claims, &[0; 24])[..]).is_err());
    }
}
