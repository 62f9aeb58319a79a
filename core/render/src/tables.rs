//! A frame's tables where shaders can read them.

use afterglow_gl::frame::{Draw, Frame, Topology, VertexSource};
use afterglow_gpu::{GpuError, vk};
use afterglow_records::{DrawRecord, FrameRecord, PixelRecord};

use crate::retained::{RangeCopy, Resident, RetainedRanges};
use crate::uploads::{Upload, UploadArena};

/// The least difference of depth, for what Vulkan does not bias.
const DEPTH_UNIT: f32 = 1.0 / (1 << 24) as f32;

/// What the command of a draw says.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DrawCommand {
    pub(crate) index_buffer: vk::Buffer,
    pub(crate) first_index: u32,
    /// 0 if the draw is left out.
    pub(crate) index_count: u32,
    /// Address of the first index.
    pub(crate) indices: u64,
}

/// Memory of the last frame, used again.
#[derive(Default)]
pub(crate) struct Scratch {
    pub(crate) draws: Vec<DrawRecord>,
    pub(crate) commands: Vec<DrawCommand>,
    residents: Vec<Resident>,
}

/// Vertices and indices of a frame's arena.
struct Arena {
    words: Upload,
    word_count: u64,
    indices: Upload,
    index_count: u64,
}

/// What of a frame was written to where the device can read it.
pub(crate) struct Uploaded {
    pub(crate) record: FrameRecord,
    /// Of the record.
    pub(crate) address: u64,
    /// Vertices, indices and tables, each with its bytes.
    pub(crate) pieces: Vec<(Upload, u64)>,
}

/// Uploads the frame's tables, vertices and records of its draws; the draws' commands are left in `scratch`. Returns what was
/// uploaded, and the copies that bring retained ranges to the device.
pub(crate) fn upload(
    frame: &Frame,
    pixels: &[PixelRecord],
    window_size: [u32; 2],
    arena: &mut UploadArena,
    ranges: &mut RetainedRanges,
    scratch: &mut Scratch,
) -> Result<(Uploaded, Vec<RangeCopy>), GpuError> {
    let mut copies = Vec::new();
    scratch.residents.clear();
    for range in &frame.retained {
        let resident = ranges.resident(range, arena, &mut copies)?;
        scratch.residents.push(resident);
    }
    let mut uploads = Uploads { arena, pieces: Vec::new() };
    let vertices = Arena {
        words: uploads.push(bytemuck::cast_slice(&frame.words))?,
        word_count: frame.words.len() as u64,
        indices: uploads.push(bytemuck::cast_slice(&frame.indices))?,
        index_count: frame.indices.len() as u64,
    };
    scratch.records(frame, &vertices);
    let record = FrameRecord {
        draws: uploads.table(&scratch.draws)?,
        transforms: uploads.table(&frame.transforms)?,
        lights: uploads.table(&frame.lights)?,
        materials: uploads.table(&frame.materials)?,
        environments: uploads.table(&frame.environments)?,
        texgens: uploads.table(&frame.texgens)?,
        texture_matrices: uploads.table(&frame.texture_matrices)?,
        clip_planes: uploads.table(&frame.clip_planes)?,
        current: uploads.table(&frame.current)?,
        pixels: uploads.table(pixels)?,
        window_size: window_size.map(|side| side as f32),
    };
    let pieces = uploads.pieces;
    let address = arena.push(bytemuck::bytes_of(&record))?.address;
    Ok((Uploaded { record, address, pieces }, copies))
}

/// Uploads that are remembered.
struct Uploads<'a> {
    arena: &'a mut UploadArena,
    pieces: Vec<(Upload, u64)>,
}

impl Uploads<'_> {
    fn push(&mut self, bytes: &[u8]) -> Result<Upload, GpuError> {
        let upload = self.arena.push(bytes)?;
        self.pieces.push((upload, bytes.len() as u64));
        Ok(upload)
    }

    /// Returns the table's address.
    fn table<T: bytemuck::Pod>(&mut self, table: &[T]) -> Result<u64, GpuError> {
        let upload = self.arena.push_table(table)?;
        self.pieces.push((upload, size_of_val(table).max(size_of::<T>()) as u64));
        Ok(upload.address)
    }
}

impl Scratch {
    fn records(&mut self, frame: &Frame, vertices: &Arena) {
        self.draws.clear();
        self.commands.clear();
        for (_, draw) in frame.draws() {
            let (record, command) = match self.locate(frame, vertices, draw) {
                Some(place) => (draw_record(frame, draw, &place), place.command),
                None => (bytemuck::Zeroable::zeroed(), LEFT_OUT),
            };
            self.draws.push(record);
            self.commands.push(command);
        }
    }

    /// Where a draw's vertices and indices are; none if it has none, or names some that are not there.
    fn locate(&self, frame: &Frame, vertices: &Arena, draw: &Draw) -> Option<Place> {
        let stride = draw.layout.stride() as u64;
        let count = u64::from(draw.index_count);
        let (address, vertex_count, command) = match draw.source {
            VertexSource::Arena { first_word, vertices: vertex_count, first_index } => {
                let words = u64::from(first_word) + u64::from(vertex_count) * stride;
                let indices = u64::from(first_index) + count;
                if words > vertices.word_count || indices > vertices.index_count {
                    return None;
                }
                let first = vertices.indices.offset / 4 + u64::from(first_index);
                let command = DrawCommand {
                    index_buffer: vertices.indices.buffer,
                    first_index: u32::try_from(first).ok()?,
                    index_count: draw.index_count,
                    indices: vertices.indices.address + u64::from(first_index) * 4,
                };
                let address = vertices.words.address + u64::from(first_word) * 4;
                (address, u64::from(vertex_count), command)
            }
            VertexSource::Retained { range, first_index } => {
                let resident = self.residents.get(range as usize)?;
                if u64::from(first_index) + count > u64::from(resident.indices) {
                    return None;
                }
                let vertex_count = u64::from(resident.words).checked_div(stride)?;
                let command = DrawCommand {
                    index_buffer: resident.index_buffer,
                    first_index: resident.first_index.checked_add(first_index)?,
                    index_count: draw.index_count,
                    indices: resident.vertices + (u64::from(resident.words) + u64::from(first_index)) * 4,
                };
                (resident.vertices, vertex_count, command)
            }
        };
        let is_known = frame.fixed.len() > draw.fixed as usize
            && frame.viewports.len() > draw.viewport as usize
            && frame.bindings.len() > draw.bindings as usize;
        (is_known && vertex_count > 0 && count > 0).then(|| Place {
            address,
            last_vertex: (vertex_count - 1) as u32,
            command,
        })
    }
}

struct Place {
    address: u64,
    last_vertex: u32,
    command: DrawCommand,
}

const LEFT_OUT: DrawCommand =
    DrawCommand { index_buffer: vk::Buffer::null(), first_index: 0, index_count: 0, indices: 0 };

/// An index that is surely one of a table of which an empty one has an element of zeros.
fn within<T>(index: u32, table: &[T]) -> u32 {
    index.min((table.len() as u32).saturating_sub(1))
}

fn draw_record(frame: &Frame, draw: &Draw, place: &Place) -> DrawRecord {
    let raster = &frame.fixed[draw.fixed as usize].raster;
    let depth_offset = match (draw.topology, raster.depth_bias) {
        (Topology::Triangles, _) | (_, None) => 0.0,
        // The slope of the polygon whose outline this is is not known any more; 1 unit stands for it.
        (_, Some((factor, units))) => (factor.get() + units.get()) * DEPTH_UNIT,
    };
    DrawRecord {
        vertices: place.address,
        last_vertex: place.last_vertex,
        transform: within(draw.transform, &frame.transforms),
        lights: within(draw.lights, &frame.lights),
        material: within(draw.material, &frame.materials),
        environment: within(draw.environment, &frame.environments),
        texgen: within(draw.texgen, &frame.texgens),
        texture_matrices: within(draw.texture_matrices, &frame.texture_matrices),
        clip_planes: within(draw.clip_planes, &frame.clip_planes),
        current: within(draw.current, &frame.current),
        depth_offset,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{FrameBuilder, gpu};
    use afterglow_gl::frame::Operation;

    #[test]
    fn draws_that_name_what_is_not_there_are_left_out() {
        let gpu = gpu();
        let (mut ranges, mut arena) = (RetainedRanges::new(&gpu), UploadArena::new(&gpu));
        let mut builder = FrameBuilder::new(8, 8);
        for _ in 0..5 {
            builder.triangle([[0.0, 0.0, 0.0]; 3], [255; 4]);
        }
        let mut frame = builder.frame;
        let mut change = |index: usize, change: fn(&mut Draw)| match &mut frame.operations[index] {
            Operation::Draw(draw) => change(draw),
            other => panic!("{other:?}"),
        };
        change(1, |draw| draw.index_count = u32::MAX);
        change(2, |draw| {
            draw.source = VertexSource::Arena { first_word: u32::MAX, vertices: u32::MAX, first_index: 0 };
        });
        change(3, |draw| draw.fixed = 77);
        change(4, |draw| draw.source = VertexSource::Retained { range: 3, first_index: 0 });
        let mut scratch = Scratch::default();
        upload(&frame, &[], [8, 8], &mut arena, &mut ranges, &mut scratch).unwrap();
        let counts: Vec<_> = scratch.commands.iter().map(|command| command.index_count).collect();
        assert_eq!(counts, [3, 0, 0, 0, 0]);
    }

    #[test]
    fn an_index_beyond_a_table_is_its_last() {
        assert_eq!(within(7, &[1, 2]), 1);
        assert_eq!(within(7, &[0; 0]), 0);
    }
}
