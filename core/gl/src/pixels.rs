//! Rectangles of pixels: written, copied, read (specification 3.6, 4.3), the raster position, the
//! accumulation buffer, and the render mode.

use std::sync::Arc;

use afterglow_api::constants::*;
use glam::{Vec3, Vec4};

use crate::backend::{Reply, Request};
use crate::context::Context;
use crate::frame::{
    AccumulateOp, BaseFormat, Operation, PixelBuffer, PixelContent, PixelCopy, PixelRectangle, Rect, SLOTS,
    Slot, TEXTURE_UNITS,
};
use crate::pixel::{
    Extent, Luminance, Packing, PixelLayout, PixelSource, PixelTarget, image_size, pack_color, pack_depth,
    pack_stencil, unpack_color, unpack_depth, unpack_mask, unpack_stencil,
};
use crate::read_elsewhere::{self, Fetched};
use crate::state::Cap;

/// glRenderMode.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RenderMode {
    /// Drawing.
    #[default]
    Render,
    /// Selection: nothing is drawn. Hits are not recorded yet.
    Select,
    /// Feedback: nothing is drawn. Vertices are not recorded yet.
    Feedback,
}

/// glDrawPixels, with its pixels.
#[derive(Debug)]
pub struct DrawPixelsCall {
    size: (i32, i32),
    format: u32,
    kind: u32,
    packing: Packing,
    data: Box<[u8]>,
}

/// glBitmap, with its pixels if it has any.
#[derive(Debug)]
pub struct BitmapCall {
    size: (i32, i32),
    origin: (f32, f32),
    step: (f32, f32),
    packing: Packing,
    data: Option<Box<[u8]>>,
}

impl Context {
    /// glPixelStore.
    pub fn pixel_store(&mut self, pname: u32, value: f32) {
        if self.refuses_in_begin() {
            return;
        }
        let result = self.stacks.pixel_store.set(pname, value);
        self.check(result);
    }

    pub(crate) fn exec_pixel_transfer(&mut self, pname: u32, value: f32) {
        let result = self.transfer.modes.set(pname, value);
        self.check(result);
    }

    /// glPixelMap.
    pub fn pixel_map(&mut self, map: u32, values: &[f32]) {
        self.pixel_map_values(map, values.into());
    }

    /// glPixelMap of integers, of which `greatest` is 1 in maps of colours (specification 3.6.3).
    pub fn pixel_map_integers(&mut self, map: u32, values: &[u32], greatest: u32) {
        let divisor = integer_scale(map, greatest);
        let values: Vec<f32> = values.iter().map(|&value| (f64::from(value) / divisor) as f32).collect();
        self.pixel_map(map, &values);
    }

    /// glGetPixelMap in integers, likewise.
    pub fn get_pixel_map_integers(&mut self, map: u32, greatest: u32) -> Vec<u32> {
        let scale = integer_scale(map, greatest);
        self.get_pixel_map(map).iter().map(|&value| (f64::from(value) * scale).round() as u32).collect()
    }

    pub(crate) fn exec_pixel_map(&mut self, map: u32, values: Arc<[f32]>) {
        let result = self.transfer.maps.set(map, &values);
        self.check(result);
    }

    pub(crate) fn exec_pixel_zoom(&mut self, x: f32, y: f32) {
        self.state.pixel.zoom = (x, y);
    }

    /// Bytes of the program's memory that an image takes; `None` (and no error) if format or type are none.
    pub fn pixel_image_size(&self, extent: Extent, format: u32, kind: u32, pack: bool) -> Option<usize> {
        let layout = PixelLayout::from_gl(format, kind).ok()?;
        let store = &self.stacks.pixel_store;
        image_size(if pack { &store.pack } else { &store.unpack }, extent, layout)
    }

    /// glDrawPixels.
    pub fn draw_pixels(&mut self, width: i32, height: i32, format: u32, kind: u32, data: &[u8]) {
        self.draw_pixels_owned(Arc::new(DrawPixelsCall {
            size: (width, height),
            format,
            kind,
            packing: self.stacks.pixel_store.unpack,
            data: data.into(),
        }));
    }

    pub(crate) fn exec_draw_pixels(&mut self, call: Arc<DrawPixelsCall>) {
        let content = self.pixel_content(&call);
        match content {
            Ok(content) if self.state.current.raster.valid && self.mode == RenderMode::Render => {
                self.push_pixels(content, call.size, [0.0; 2], self.state.pixel.zoom);
            }
            Ok(_) => {}
            Err(error) => self.record_error(error),
        }
    }

    fn pixel_content(&self, call: &DrawPixelsCall) -> Result<PixelContent, u32> {
        let extent = extent(call.size)?;
        let layout = PixelLayout::from_gl(call.format, call.kind)?;
        let source = PixelSource::new(&call.data, layout, &call.packing, extent)?;
        Ok(match call.format {
            GL_DEPTH_COMPONENT => PixelContent::Depth(unpack_depth(&source, &self.transfer)?),
            GL_STENCIL_INDEX => PixelContent::Stencil(unpack_stencil(&source, &self.transfer)?),
            _ => PixelContent::Color(unpack_color(&source, &self.transfer, BaseFormat::Rgba)?),
        })
    }

    /// glBitmap. `None` only moves the raster position.
    pub fn bitmap(&mut self, size: (i32, i32), origin: (f32, f32), step: (f32, f32), data: Option<&[u8]>) {
        let packing = self.stacks.pixel_store.unpack;
        self.bitmap_owned(Arc::new(BitmapCall { size, origin, step, packing, data: data.map(Into::into) }));
    }

    pub(crate) fn exec_bitmap(&mut self, call: Arc<BitmapCall>) {
        let extent = match extent(call.size) {
            Ok(extent) => extent,
            Err(error) => return self.record_error(error),
        };
        if !self.state.current.raster.valid {
            return;
        }
        if let Some(data) =
            call.data.as_ref().filter(|_| !extent.is_empty() && self.mode == RenderMode::Render)
        {
            let mask = PixelLayout::from_gl(GL_COLOR_INDEX, GL_BITMAP)
                .and_then(|layout| PixelSource::new(data, layout, &call.packing, extent))
                .and_then(|source| unpack_mask(&source));
            match mask {
                Ok(mask) => {
                    let offset = [-call.origin.0, -call.origin.1];
                    self.push_pixels(PixelContent::Mask(mask), call.size, offset, (1.0, 1.0));
                }
                Err(error) => return self.record_error(error),
            }
        }
        let raster = &mut self.state.current.raster;
        raster.window[0] += call.step.0;
        raster.window[1] += call.step.1;
    }

    fn push_pixels(&mut self, content: PixelContent, size: (i32, i32), offset: [f32; 2], zoom: (f32, f32)) {
        if size.0 == 0 || size.1 == 0 {
            return;
        }
        let (fixed, viewport, bindings, environment, current) = self.validate_raster();
        let raster = &self.state.current.raster;
        self.frame.operations.push(Operation::Pixels(Box::new(PixelRectangle {
            content,
            width: size.0 as u32,
            height: size.1 as u32,
            position: [raster.window[0] + offset[0], raster.window[1] + offset[1]],
            depth: raster.window[2],
            zoom: [zoom.0, zoom.1],
            fixed,
            viewport,
            bindings,
            environment,
            current,
        })));
    }

    /// The state of fragments that have the raster position's colour and coordinates instead of the current ones.
    fn validate_raster(&mut self) -> (u32, u32, u32, u32, u32) {
        let (raster, attributes) = (self.state.current.raster.clone(), self.state.current.attributes);
        self.set_current(Slot::Color as usize, raster.color);
        self.set_current(Slot::Secondary as usize, raster.secondary);
        self.set_current(Slot::Fog as usize, [raster.distance, 0.0, 0.0, 1.0]);
        for unit in 0..TEXTURE_UNITS {
            self.set_current(Slot::Texture0 as usize + unit, raster.texture[unit]);
        }
        let ids = self.validate_pixels();
        self.state.current.attributes = attributes;
        self.tables.changed = [true; SLOTS];
        ids
    }

    pub(crate) fn exec_copy_pixels(&mut self, x: i32, y: i32, width: i32, height: i32, kind: u32) {
        let buffer = match kind {
            GL_COLOR => PixelBuffer::Color,
            GL_DEPTH => PixelBuffer::Depth,
            GL_STENCIL => PixelBuffer::Stencil,
            _ => return self.record_error(GL_INVALID_ENUM),
        };
        if width < 0 || height < 0 {
            return self.record_error(GL_INVALID_VALUE);
        }
        if !self.state.current.raster.valid || self.mode != RenderMode::Render {
            return;
        }
        if self.output.reads_elsewhere {
            return self.copy_fetched_pixels(buffer, Rect { x, y, width, height });
        }
        let (fixed, viewport, bindings, environment, current) = self.validate_raster();
        let (window, zoom) = (self.state.current.raster.window, self.state.pixel.zoom);
        self.frame.operations.push(Operation::CopyPixels(Box::new(PixelCopy {
            buffer,
            source: Rect { x, y, width, height },
            position: [window[0], window[1]],
            depth: window[2],
            zoom: [zoom.0, zoom.1],
            fixed,
            viewport,
            bindings,
            environment,
            current,
        })));
    }

    fn copy_fetched_pixels(&mut self, buffer: PixelBuffer, rect: Rect) {
        let Some(Fetched { format, kind, data }) = self.fetch(buffer, rect) else { return };
        let size = (rect.width, rect.height);
        let call = DrawPixelsCall { size, format, kind, packing: read_elsewhere::packing(), data };
        match self.pixel_content(&call) {
            Ok(content) => self.push_pixels(content, size, [0.0; 2], self.state.pixel.zoom),
            Err(error) => self.record_error(error),
        }
    }

    /// glReadPixels into the program's memory.
    #[expect(clippy::too_many_arguments, reason = "the command has them")]
    pub fn read_pixels(
        &mut self,
        x: i32,
        y: i32,
        width: i32,
        height: i32,
        format: u32,
        kind: u32,
        data: &mut [u8],
    ) {
        if self.refuses_in_begin() {
            return;
        }
        let packing = self.stacks.pixel_store.pack;
        let checked = extent((width, height)).and_then(|extent| {
            let layout = PixelLayout::from_gl(format, kind)?;
            Ok((PixelTarget::new(data, layout, &packing, extent)?, extent))
        });
        let (target, extent) = match checked {
            Ok(checked) => checked,
            Err(error) => return self.record_error(error),
        };
        if extent.is_empty() {
            return;
        }
        let buffer = match format {
            GL_DEPTH_COMPONENT => PixelBuffer::Depth,
            GL_STENCIL_INDEX => PixelBuffer::Stencil,
            _ => PixelBuffer::Color,
        };
        let result = match self.ask(Request::Pixels { buffer, rect: Rect { x, y, width, height } }) {
            Reply::Color(rgba) => pack_color(&rgba, Some(&self.transfer), Luminance::Sum, target),
            Reply::Depth(depths) => pack_depth(&depths, &self.transfer, target),
            Reply::Stencil(values) => pack_stencil(&values, &self.transfer, target),
            _ => Ok(()),
        };
        self.check(result);
    }

    pub(crate) fn exec_read_buffer(&mut self, buffer: u32) {
        match buffer {
            GL_FRONT_LEFT
            | GL_BACK_LEFT
            | GL_FRONT
            | GL_BACK
            | GL_LEFT
            | GL_FRONT_RIGHT
            | GL_BACK_RIGHT
            | GL_RIGHT
            | GL_AUX0..=GL_AUX3 => {
                if self.has_buffer(buffer) {
                    self.state.pixel.read_buffer = buffer;
                }
            }
            _ => self.record_error(GL_INVALID_ENUM),
        }
    }

    pub(crate) fn exec_accum(&mut self, op: u32, value: f32) {
        let op = match op {
            GL_ACCUM => AccumulateOp::Accumulate,
            GL_LOAD => AccumulateOp::Load,
            GL_RETURN => AccumulateOp::Return,
            GL_MULT => AccumulateOp::Multiply,
            GL_ADD => AccumulateOp::Add,
            _ => return self.record_error(GL_INVALID_ENUM),
        };
        let scissor = self.state.caps.has(Cap::ScissorTest).then_some(self.state.scissor);
        self.frame.operations.push(Operation::Accumulate(op, value, scissor));
    }

    pub(crate) fn exec_raster_pos(&mut self, position: [f32; 4]) {
        let eye = self.matrices.modelview.top() * Vec4::from_array(position);
        let clip = self.matrices.projection.top() * eye;
        let inside = clip.w > 0.0 && clip.truncate().abs().max_element() <= clip.w;
        let (viewport, range) = (&self.state.viewport.rect, self.state.viewport.depth_range);
        let ndc = if inside { clip.truncate() / clip.w } else { Vec3::ZERO };
        let z = range[0] as f32 + (ndc.z + 1.0) / 2.0 * (range[1] - range[0]) as f32;
        let window = [
            viewport.x as f32 + (ndc.x + 1.0) / 2.0 * viewport.width as f32,
            viewport.y as f32 + (ndc.y + 1.0) / 2.0 * viewport.height as f32,
            z,
            clip.w,
        ];
        self.set_raster(window, inside, eye.truncate().length());
        if self.state.caps.has(Cap::Lighting) {
            self.state.current.raster.color = self.lit_color(eye.truncate());
        }
    }

    pub(crate) fn exec_window_pos(&mut self, [x, y, z]: [f32; 3]) {
        let range = self.state.viewport.depth_range;
        let depth = range[0] as f32 + z.clamp(0.0, 1.0) * (range[1] - range[0]) as f32;
        self.set_raster([x, y, depth, 1.0], true, 0.0);
    }

    fn set_raster(&mut self, window: [f32; 4], valid: bool, distance: f32) {
        let attributes = self.state.current.attributes.map(|value| value.to_array());
        let raster = &mut self.state.current.raster;
        (raster.valid, raster.distance) = (valid, distance);
        if valid {
            raster.window = window;
            raster.color = attributes[Slot::Color as usize];
            raster.secondary = attributes[Slot::Secondary as usize];
            raster.texture = std::array::from_fn(|unit| attributes[Slot::Texture0 as usize + unit]);
        }
    }

    /// Colour of a lit vertex at an eye position: ambient, diffuse and emission, without spots
    /// (specification 2.14.1; bitmaps in lit scenes are rare and small).
    fn lit_color(&mut self, eye: Vec3) -> [f32; 4] {
        self.sync_color_material();
        let lighting = &self.state.lighting;
        let face = &lighting.material.faces[0];
        let rgb = |c: [f32; 4]| Vec3::new(c[0], c[1], c[2]);
        let mut color = rgb(face.emission) + rgb(face.ambient) * rgb(lighting.model_ambient);
        let n = self.state.current.attributes[Slot::Normal as usize].truncate();
        let normal = glam::Mat3::from_cols_array_2d(&self.transform_block().normal) * n;
        for (i, light) in lighting.lights.iter().enumerate() {
            if lighting.enabled & (1 << i) == 0 {
                continue;
            }
            let position = Vec4::from_array(light.position);
            let to_light =
                if position.w == 0.0 { position.truncate() } else { position.truncate() / position.w - eye };
            let [c, l, q] = light.attenuation;
            let d = to_light.length();
            let falloff = if position.w == 0.0 { 1.0 } else { 1.0 / (c + l * d + q * d * d) };
            let cosine = normal.normalize_or_zero().dot(to_light.normalize_or_zero()).max(0.0);
            color += falloff
                * (rgb(light.ambient) * rgb(face.ambient) + cosine * rgb(light.diffuse) * rgb(face.diffuse));
        }
        let color = color.clamp(Vec3::ZERO, Vec3::ONE);
        [color.x, color.y, color.z, face.diffuse[3]]
    }

    /// glRenderMode. Selection and feedback draw nothing; their buffers stay empty.
    pub fn render_mode(&mut self, mode: u32) -> i32 {
        if self.refuses_in_begin() {
            return 0;
        }
        self.mode = match mode {
            GL_RENDER => RenderMode::Render,
            GL_SELECT => RenderMode::Select,
            GL_FEEDBACK => RenderMode::Feedback,
            _ => {
                self.record_error(GL_INVALID_ENUM);
                return 0;
            }
        };
        if self.mode != RenderMode::Render {
            tracing::warn!("selection and feedback record nothing yet");
        }
        0
    }

    pub(crate) fn exec_init_names(&mut self) {}

    pub(crate) fn exec_load_name(&mut self, _name: u32) {}

    pub(crate) fn exec_push_name(&mut self, _name: u32) {}

    pub(crate) fn exec_pop_name(&mut self) {}

    pub(crate) fn exec_pass_through(&mut self, _token: f32) {}
}

fn extent((width, height): (i32, i32)) -> Result<Extent, u32> {
    match (usize::try_from(width), usize::try_from(height)) {
        (Ok(width), Ok(height)) => Ok(Extent::plane(width, height)),
        _ => Err(GL_INVALID_VALUE),
    }
}

/// What integers of a pixel map are multiples of: indices stay what they are, colours are fractions.
fn integer_scale(map: u32, greatest: u32) -> f64 {
    match map {
        GL_PIXEL_MAP_I_TO_I | GL_PIXEL_MAP_S_TO_S => 1.0,
        _ => f64::from(greatest),
    }
}
