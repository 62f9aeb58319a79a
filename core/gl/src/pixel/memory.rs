//! Memory for images, within a bound.

use std::sync::Arc;

use afterglow_api::constants::GL_OUT_OF_MEMORY;

use super::GlResult;

/// The most bytes that one image may have: a 512 x 512 x 512 volume of four bytes.
pub const MAX_IMAGE_BYTES: usize = 1 << 29;

/// From this many bytes on it is asked first whether they can be had.
const PROBED_BYTES: usize = 1 << 24;

/// So many zeros.
///
/// # Errors
/// GL_OUT_OF_MEMORY if there is no such memory, or it would be more than [`MAX_IMAGE_BYTES`].
pub fn allocate(bytes: usize) -> GlResult<Arc<[u8]>> {
    check(bytes)?;
    Ok(std::iter::repeat_n(0, bytes).collect())
}

/// As [`allocate`] does, with `fill` to write the bytes.
pub(super) fn filled(bytes: usize, fill: impl FnOnce(&mut [u8])) -> GlResult<Arc<[u8]>> {
    let mut memory = allocate(bytes)?;
    if let Some(bytes) = Arc::get_mut(&mut memory) {
        fill(bytes);
    }
    Ok(memory)
}

/// A copy of `bytes`.
pub(super) fn copied(bytes: &[u8]) -> GlResult<Arc<[u8]>> {
    check(bytes.len())?;
    Ok(Arc::from(bytes))
}

/// `Arc` aborts where memory lacks, so large requests are tried with a vector before.
fn check(bytes: usize) -> GlResult<()> {
    if bytes > MAX_IMAGE_BYTES {
        return Err(GL_OUT_OF_MEMORY);
    }
    if bytes >= PROBED_BYTES {
        Vec::<u8>::new().try_reserve_exact(bytes).map_err(|_| GL_OUT_OF_MEMORY)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounded() {
        assert_eq!(allocate(MAX_IMAGE_BYTES + 1), Err(GL_OUT_OF_MEMORY));
        assert_eq!(*allocate(3).unwrap(), [0; 3]);
    }
}
