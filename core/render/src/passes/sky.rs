//! The program's sky on the sides of a cube, and its map for rays.

use afterglow_frame_graph::{Access, GraphBuilder, PassKind};
use afterglow_gl::frame::Topology;
use afterglow_gpu::{Commands, GpuError, ImageRegion, vk};
use afterglow_records::{SKY_EDGE, SKY_LEVELS, SkyPush};

use crate::passes::raster::RasterPass;
use crate::pathtrace::schedule::SkyResources;
use crate::pathtrace::sky::{CubeDraw, PreparedSky, SIDES, SkyMap};
use crate::pipeline_state::PipelineRaster;
use crate::pipelines::{ALL_SIDES, PipelineKey, Program, Visibility};
use crate::schedule::Resources;
use crate::window;

/// Why the sky is not drawn.
const STILL_REASON: &str = "the sky looks as it did";
/// Texels along a side of a workgroup.
const GROUP_EDGE: u32 = 8;

/// Draws the sky, unless it is as it was.
pub(crate) fn declare_draw(graph: &mut GraphBuilder, frame: &Resources, sky: &SkyResources, is_new: bool) {
    graph
        .pass("sky", PassKind::Graphics)
        .write(sky.sides, Access::ColorAttachment)
        .read(frame.textures, Access::StorageReadFragment)
        .read(frame.geometry, Access::StorageReadVertex)
        .read(frame.geometry, Access::IndexRead)
        .when(is_new, STILL_REASON);
}

/// Copies what was drawn to where the map is made from it.
pub(crate) fn declare_copy(graph: &mut GraphBuilder, sky: &SkyResources, is_new: bool) {
    graph
        .pass("sky copy", PassKind::Transfer)
        .read(sky.sides, Access::TransferSrc)
        .write(sky.drawn, Access::TransferDst)
        .when(is_new, STILL_REASON);
}

/// Makes a level of the map, which `holds` something before.
pub(crate) fn declare_level(graph: &mut GraphBuilder, sky: &SkyResources, holds: bool, is_new: bool) {
    let mut pass = graph.pass("sky map", PassKind::Compute);
    pass.read(sky.drawn, Access::StorageReadCompute).when(is_new, STILL_REASON);
    match holds {
        true => pass.read_write(sky.texels, Access::StorageWriteCompute),
        false => pass.write(sky.texels, Access::StorageWriteCompute),
    };
}

pub(crate) fn record_copy(commands: &Commands<'_>, map: &SkyMap) {
    let image = &map.sides.image;
    let all = ImageRegion { layers: SIDES, ..ImageRegion::mip(image, 0, 0) };
    commands.copy_image_to_buffer(image, &map.drawn.buffer, &[all]);
}

/// What a level is made with, and in how many workgroups.
pub(crate) fn level(map: &SkyMap, sky: &PreparedSky, level: u32) -> (SkyPush, [u32; 3]) {
    let groups = ((SKY_EDGE >> level) + 2).div_ceil(GROUP_EDGE);
    let push = SkyPush {
        drawn: map.drawn.buffer.address(),
        map: map.texels.buffer.address(),
        open: sky.open.to_array(),
        level,
        remembers: sky.remembers.into(),
        padding: 0,
    };
    (push, [groups, groups, SIDES])
}

/// All levels, the finest first.
pub(crate) fn levels() -> std::ops::Range<u32> {
    0..SKY_LEVELS
}

impl RasterPass<'_> {
    /// Draws the sky on all sides: at once, or one after another where the device cannot.
    pub(crate) fn record_sky(&mut self, sky: &PreparedSky, map: &SkyMap) -> Result<(), GpuError> {
        let sets = [self.input.table.set()];
        self.commands.bind_sets(vk::PipelineBindPoint::GRAPHICS, &self.state.pipelines.draw_layout, &sets);
        if map.is_multiview {
            return self.draw_sides(sky, map.sides.image.view(), None);
        }
        (0..SIDES).try_for_each(|side| {
            let view = map.sides.image.view_of_mip(0, side)?;
            self.draw_sides(sky, view, Some(side))
        })
    }

    fn draw_sides(
        &mut self,
        sky: &PreparedSky,
        view: vk::ImageView,
        side: Option<u32>,
    ) -> Result<(), GpuError> {
        let [red, green, blue] = sky.cleared.to_array();
        // Alpha 1 says that nothing is drawn there.
        let cleared = vk::ClearColorValue { float32: [red, green, blue, 1.0] };
        let colors = [vk::RenderingAttachmentInfo::default()
            .image_view(view)
            .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::STORE)
            .clear_value(vk::ClearValue { color: cleared })];
        let info = vk::RenderingInfo::default()
            .render_area(window::whole([SKY_EDGE; 2]))
            .layer_count(1)
            .view_mask(if side.is_none() { ALL_SIDES } else { 0 })
            .color_attachments(&colors);
        let commands = *self.commands;
        commands.rendering(&info, || {
            let (device, raw) = (commands.device(), commands.raw());
            // SAFETY: both are as large as the image that is drawn to.
            unsafe {
                device.cmd_set_viewport(raw, 0, &[window::window_viewport([SKY_EDGE; 2])]);
                device.cmd_set_scissor(raw, 0, &[window::whole([SKY_EDGE; 2])]);
            }
            let mut draws = sky.draws.iter().enumerate();
            draws.try_for_each(|(index, draw)| self.draw_on_cube(index as u32, draw, side))
        })
    }

    fn draw_on_cube(&mut self, index: u32, of: &CubeDraw, side: Option<u32>) -> Result<(), GpuError> {
        let draw = &of.draw;
        let key = PipelineKey {
            program: if side.is_none() { Program::Sky } else { Program::SkySide },
            words: of.state.words,
            layout: draw.layout,
            topology: Topology::Triangles,
            clamps: self.clamps(draw.bindings)?,
            raster: PipelineRaster::new(
                &of.state.raster,
                Topology::Triangles,
                false,
                self.input.gpu.features(),
            ),
            visibility: Visibility::Absent,
        };
        let pipeline = self.state.pipelines.get(&key)?;
        self.set_pipeline(pipeline);
        self.set_numbers(&of.state);
        let mut push = self.push_of(draw.bindings, draw.environment)?;
        push.pixels = side.unwrap_or(0);
        self.commands.push_constants(&self.state.pipelines.draw_layout, &push);
        let command = self.input.draws[of.number];
        let (device, raw) = (self.commands.device(), self.commands.raw());
        // SAFETY: the pipeline's state is complete; `tables` has checked that the indices lie in their buffer.
        unsafe {
            device.cmd_bind_index_buffer(raw, command.index_buffer, 0, vk::IndexType::UINT32);
            device.cmd_draw_indexed(raw, command.index_count, 1, command.first_index, 0, index);
        }
        Ok(())
    }
}
