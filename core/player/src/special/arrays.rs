//! Arrays whose elements another argument describes: lists' names, buffers' bytes.

use afterglow_gl::{Context, list_offsets};

use crate::args::*;

/// glCallLists: memory that holds `n` offsets.
pub fn call_lists(gl: &mut Context, a: Args) -> Option<()> {
    let (count, kind) = (usize::try_from(a.get(0, int)?).ok()?, a.get(1, uint)?);
    if count > 0 {
        gl.call_lists(&list_offsets(kind, a.bytes(2)?, count)?);
    }
    Some(())
}

/// glBufferData; without data the bytes are undefined.
pub fn buffer_data(gl: &mut Context, a: Args) -> Option<()> {
    gl.buffer_data(a.get(0, uint)?, a.get(1, size)?, a.memory(2)?, a.get(3, uint)?);
    Some(())
}

/// glBufferSubData.
pub fn buffer_sub_data(gl: &mut Context, a: Args) -> Option<()> {
    let count = usize::try_from(a.get(2, size)?).ok()?;
    let bytes = if count == 0 { &[] } else { a.bytes(3)?.get(..count)? };
    gl.buffer_sub_data(a.get(0, uint)?, a.get(1, size)?, bytes);
    Some(())
}
