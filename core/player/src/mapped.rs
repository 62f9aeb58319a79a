//! Buffers that the traced program has mapped. It wrote to them through addresses; the tracer noted what was
//! there before each glUnmapBuffer as a call `memcpy(dest, src, n)`.

use afterglow_gl::Context;

use crate::args::Args;

/// Where the program saw a buffer.
#[derive(Debug, Clone, Copy)]
struct Mapping {
    context: usize,
    target: u32,
    address: u64,
}

/// All buffers that are mapped.
#[derive(Debug, Default)]
pub(crate) struct Mappings {
    mapped: Vec<Mapping>,
}

impl Mappings {
    /// Notes where the buffer bound to `target` begins.
    pub fn insert(&mut self, context: usize, target: u32, address: u64) {
        self.remove(context, target);
        self.mapped.push(Mapping { context, target, address });
    }

    /// Forgets it.
    pub fn remove(&mut self, context: usize, target: u32) {
        self.mapped.retain(|mapping| (mapping.context, mapping.target) != (context, target));
    }

    /// Plays `memcpy(dest, src, n)` into one of a context's mapped buffers. `None` if it fits in none.
    pub fn write(&self, context: usize, gl: &mut Context, a: Args) -> Option<()> {
        let (destination, bytes) = (a.value(0)?.as_pointer()?, a.bytes(1)?);
        let own = self.mapped.iter().filter(|mapping| mapping.context == context);
        own.filter(|mapping| mapping.address <= destination).find_map(|mapping| {
            let start = usize::try_from(destination - mapping.address).ok()?;
            let buffer = gl.mapped_buffer(mapping.target)?;
            let mut buffer = buffer.lock();
            buffer.data.get_mut(start..start.checked_add(bytes.len())?)?.copy_from_slice(bytes);
            Some(())
        })
    }
}
