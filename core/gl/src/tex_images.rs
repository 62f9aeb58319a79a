//! Texture images: specified, changed in part, copied from the frame buffer, read back
//! (specification 3.8.1 to 3.8.3). One method serves all dimensions of a command.

use std::sync::Arc;

use afterglow_api::constants::*;

use crate::context::Context;
use crate::frame::Operation;
use crate::pixel::{GlResult, Packing, PixelTransfer};
use crate::shared::SharedTexture;
use crate::state::TARGETS;
use crate::tables::Dirty;
use crate::texture::{CopySource, ImageDefinition, ImageTarget, PixelInput, SubImage, TextureObject};

/// What a texture image command with texels from the program does.
#[derive(Debug, Clone, Copy)]
enum Image {
    /// glTexImage: definition, format, type.
    Whole(ImageDefinition, u32, u32),
    /// glTexSubImage: part, format, type.
    Part(SubImage, u32, u32),
    /// glCompressedTexImage.
    CompressedWhole(ImageDefinition),
    /// glCompressedTexSubImage: part, format.
    CompressedPart(SubImage, u32),
}

/// A texture image command with its texels, as a display list keeps it.
#[derive(Debug)]
pub struct TexImageCall {
    target: ImageTarget,
    image: Image,
    packing: Packing,
    data: Option<Box<[u8]>>,
}

impl Context {
    /// glTexImage1D, 2D, 3D; `data` is `None` for a null pointer.
    pub fn tex_image(
        &mut self,
        (target, dimensions): (u32, usize),
        definition: ImageDefinition,
        (format, kind): (u32, u32),
        data: Option<&[u8]>,
    ) {
        self.image_command(target, dimensions, Image::Whole(definition, format, kind), data);
    }

    /// glTexSubImage1D, 2D, 3D.
    pub fn tex_sub_image(
        &mut self,
        (target, dimensions): (u32, usize),
        part: SubImage,
        (format, kind): (u32, u32),
        data: &[u8],
    ) {
        self.image_command(target, dimensions, Image::Part(part, format, kind), Some(data));
    }

    /// glCompressedTexImage1D, 2D, 3D.
    pub fn compressed_tex_image(
        &mut self,
        (target, dimensions): (u32, usize),
        definition: ImageDefinition,
        data: &[u8],
    ) {
        self.image_command(target, dimensions, Image::CompressedWhole(definition), Some(data));
    }

    /// glCompressedTexSubImage1D, 2D, 3D.
    pub fn compressed_tex_sub_image(
        &mut self,
        (target, dimensions): (u32, usize),
        part: SubImage,
        format: u32,
        data: &[u8],
    ) {
        self.image_command(target, dimensions, Image::CompressedPart(part, format), Some(data));
    }

    fn image_command(&mut self, target: u32, dimensions: usize, image: Image, data: Option<&[u8]>) {
        if self.refuses_in_begin() {
            return;
        }
        let target = match ImageTarget::of_dimensions(target, dimensions) {
            Ok(target) => target,
            Err(error) => return self.record_error(error),
        };
        let packing = self.stacks.pixel_store.unpack;
        // Proxies answer at once, also while a list is compiled (specification 5.4).
        if self.list.is_some() && !target.proxy {
            let data = data.map(Into::into);
            return self.tex_image_owned(Arc::new(TexImageCall { target, image, packing, data }));
        }
        self.apply_image(target, image, &packing, data);
    }

    pub(crate) fn exec_tex_image(&mut self, call: Arc<TexImageCall>) {
        self.apply_image(call.target, call.image, &call.packing, call.data.as_deref());
    }

    fn apply_image(&mut self, target: ImageTarget, image: Image, packing: &Packing, data: Option<&[u8]>) {
        let texture = self.image_texture(target);
        let out = &mut self.frame.operations;
        let result = apply(&mut texture.lock(), target, image, (packing, &self.transfer), data, out);
        if self.check(result) && !target.proxy {
            self.dirty(Dirty::BINDINGS);
        }
    }

    /// The texture that an image belongs to: bound to the active unit, or a proxy.
    fn image_texture(&self, target: ImageTarget) -> SharedTexture {
        let index = TARGETS.iter().position(|&t| t == target.texture.gl()).unwrap_or(1);
        match target.proxy {
            true => self.textures.proxies[index].clone(),
            false => self.textures.bound[self.state.texture.active][index].1.clone(),
        }
    }

    /// The texture, if the target is one whose images can be copied to.
    fn copy_target(&mut self, target: u32) -> Option<(SharedTexture, usize)> {
        match ImageTarget::from_gl(target) {
            Ok(target) if !target.proxy => Some((self.image_texture(target), target.face)),
            _ => {
                self.record_error(GL_INVALID_ENUM);
                None
            }
        }
    }

    #[expect(clippy::too_many_arguments, reason = "the command has them")]
    pub(crate) fn exec_copy_tex_image(
        &mut self,
        target: u32,
        level: i32,
        internal_format: u32,
        x: i32,
        y: i32,
        width: i32,
        height: Option<i32>,
        border: i32,
    ) {
        let Some((texture, face)) = self.copy_target(target) else { return };
        let size = [width, height.unwrap_or(1), 1];
        let definition = ImageDefinition { level, internal_format, size, border };
        let source = CopySource { x, y };
        let first = self.frame.operations.len();
        let result = texture.lock().copy_image(face, &definition, source, &mut self.frame.operations);
        if self.output.reads_elsewhere {
            self.fetch_copies(first);
        }
        if self.check(result) {
            self.dirty(Dirty::BINDINGS);
        }
    }

    #[expect(clippy::too_many_arguments, reason = "the command has them")]
    pub(crate) fn exec_copy_tex_sub_image(
        &mut self,
        target: u32,
        level: i32,
        offset: [i32; 3],
        x: i32,
        y: i32,
        width: i32,
        height: i32,
    ) {
        let Some((texture, face)) = self.copy_target(target) else { return };
        let part = SubImage { level, offset, size: [width, height, 1] };
        let source = CopySource { x, y };
        let first = self.frame.operations.len();
        let result = texture.lock().copy_sub_image(face, &part, source, &mut self.frame.operations);
        if self.output.reads_elsewhere {
            self.fetch_copies(first);
        }
        if self.check(result) {
            self.dirty(Dirty::BINDINGS);
        }
    }

    /// glGetTexLevelParameter; `None` after an error.
    pub fn get_tex_level_parameter(&mut self, target: u32, level: i32, pname: u32) -> Option<i32> {
        if self.refuses_in_begin() {
            return None;
        }
        let value = ImageTarget::from_gl(target)
            .and_then(|target| self.image_texture(target).lock().level_parameter(target.face, level, pname));
        value.map_err(|error| self.record_error(error)).ok()
    }

    /// glGetTexImage.
    pub fn get_tex_image(&mut self, target: u32, level: i32, format: u32, kind: u32, data: &mut [u8]) {
        if self.refuses_in_begin() {
            return;
        }
        let Some((texture, face)) = self.copy_target(target) else { return };
        let image = texture.lock().level_image(face, level);
        let result = image.and_then(|image| {
            let reply = image.request().map(|request| self.ask(request));
            image.write(reply.as_ref(), (format, kind), &self.stacks.pixel_store.pack, data)
        });
        self.check(result);
    }

    /// Bytes that glGetTexImage writes; `None` if the call is in error.
    pub fn tex_image_bytes(&mut self, target: u32, level: i32, format: u32, kind: u32) -> Option<usize> {
        let target = ImageTarget::from_gl(target).ok()?;
        let extent = self.image_texture(target).lock().level_image(target.face, level).ok()?.extent();
        self.pixel_image_size(extent, format, kind, true)
    }

    /// glGetCompressedTexImage; `None` after an error.
    pub fn get_compressed_tex_image(&mut self, target: u32, level: i32) -> Option<Vec<u8>> {
        let (texture, face) = self.copy_target(target)?;
        let bytes = texture.lock().compressed_data(face, level).map(<[u8]>::to_vec);
        bytes.map_err(|error| self.record_error(error)).ok()
    }
}

fn apply(
    texture: &mut TextureObject,
    target: ImageTarget,
    image: Image,
    (packing, transfer): (&Packing, &PixelTransfer),
    data: Option<&[u8]>,
    out: &mut Vec<Operation>,
) -> GlResult<()> {
    let input = |format, kind| PixelInput { format, kind, data, packing, transfer };
    match image {
        Image::Whole(definition, format, kind) if target.proxy => {
            texture.proxy_image(&definition, format, kind)
        }
        Image::Whole(definition, format, kind) => {
            texture.tex_image(target.face, &definition, &input(format, kind))
        }
        Image::Part(part, format, kind) => {
            texture.tex_sub_image(target.face, &part, &input(format, kind), out)
        }
        Image::CompressedWhole(definition) => {
            texture.compressed_image(target.face, &definition, data.unwrap_or(&[]))
        }
        Image::CompressedPart(part, format) => {
            texture.compressed_sub_image(target.face, &part, format, data.unwrap_or(&[]), out)
        }
    }
}
