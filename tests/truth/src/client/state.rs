//! State: tests and masks, matrices, lights, textures.

use afterglow_api::constants::*;
use afterglow_api::id;
use glam::{DMat4, Vec3};

use super::{Arg, Client};
use crate::kit::Picture;
use crate::truth::{TrueLight, TrueLightOrigin, TrueLightShape};

/// The name of a texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Texture(u32);

impl Client {
    /// glEnable.
    pub fn enable(&mut self, capability: u32) {
        self.calls.call(id::glEnable, &[capability.into()]);
    }

    /// glDisable.
    pub fn disable(&mut self, capability: u32) {
        self.calls.call(id::glDisable, &[capability.into()]);
    }

    /// glDepthFunc.
    pub fn depth_func(&mut self, compare: u32) {
        self.calls.call(id::glDepthFunc, &[compare.into()]);
    }

    /// glDepthMask.
    pub fn depth_mask(&mut self, writes: bool) {
        self.calls.call(id::glDepthMask, &[u32::from(writes).into()]);
    }

    /// glDepthRange.
    pub fn depth_range(&mut self, near: f32, far: f32) {
        self.calls.call(id::glDepthRange, &[near.into(), far.into()]);
    }

    /// glColorMask, all components alike.
    pub fn color_mask(&mut self, writes: bool) {
        self.calls.call(id::glColorMask, &[u32::from(writes).into(); 4]);
    }

    /// Blends with these factors, or no longer.
    pub fn blend(&mut self, factors: Option<(u32, u32)>) {
        let Some((source, destination)) = factors else { return self.disable(GL_BLEND) };
        self.enable(GL_BLEND);
        self.calls.call(id::glBlendFunc, &[source.into(), destination.into()]);
    }

    /// Lets only alphas above a reference pass, or all.
    pub fn alpha_test(&mut self, above: Option<f32>) {
        let Some(above) = above else { return self.disable(GL_ALPHA_TEST) };
        self.enable(GL_ALPHA_TEST);
        self.calls.call(id::glAlphaFunc, &[GL_GREATER.into(), above.into()]);
    }

    /// Passes where the stencil compares with 1, and does so with it then.
    pub fn stencil(&mut self, compare: u32, operation: u32) {
        self.calls.call(id::glStencilFunc, &[compare.into(), 1.into(), 255.into()]);
        self.calls.call(id::glStencilOp, &[GL_KEEP.into(), GL_KEEP.into(), operation.into()]);
    }

    /// glViewport: left, lower edge, width, height.
    pub fn viewport(&mut self, rect: [i32; 4]) {
        self.calls.call(id::glViewport, &rect.map(Arg::from));
    }

    /// Sets the current colour.
    pub fn color(&mut self, [r, g, b, a]: [f32; 4]) {
        self.calls.call(id::glColor4f, &[r.into(), g.into(), b.into(), a.into()]);
    }

    /// Sets the PROJECTION matrix.
    pub fn projection(&mut self, projection: DMat4) {
        self.matrix(GL_PROJECTION, projection);
        self.calls.call(id::glMatrixMode, &[GL_MODELVIEW.into()]);
    }

    /// Sets the MODELVIEW matrix.
    pub fn modelview(&mut self, modelview: DMat4) {
        self.matrix(GL_MODELVIEW, modelview);
    }

    fn matrix(&mut self, mode: u32, matrix: DMat4) {
        self.calls.call(id::glMatrixMode, &[mode.into()]);
        self.calls.call(id::glLoadMatrixf, &[Arg::Floats(&matrix.as_mat4().to_cols_array())]);
    }

    /// Sets and enables glLight `index`, and says that it shines. `view` is MODELVIEW at the time, through which
    /// OpenGL sees the position.
    pub fn light(&mut self, index: u8, view: DMat4, shape: TrueLightShape, color: Vec3) {
        self.place_light(index, view, shape, color);
        self.shine(TrueLight { shape, color, origin: TrueLightOrigin::Gl(index) });
    }

    /// Sets and enables glLight `index`, which may be the reflection of one that shines.
    pub fn place_light(&mut self, index: u8, view: DMat4, shape: TrueLightShape, color: Vec3) {
        let light = GL_LIGHT0 + u32::from(index);
        self.modelview(view);
        let position = match shape {
            TrueLightShape::Directional { to_light } => to_light.as_vec3().extend(0.0),
            TrueLightShape::Point { position, .. } => position.as_vec3().extend(1.0),
        };
        if let TrueLightShape::Point { attenuation, .. } = shape {
            let names = [GL_CONSTANT_ATTENUATION, GL_LINEAR_ATTENUATION, GL_QUADRATIC_ATTENUATION];
            for (name, factor) in names.into_iter().zip(attenuation.to_array()) {
                self.calls.call(id::glLightf, &[light.into(), name.into(), factor.into()]);
            }
        }
        let values = [(GL_POSITION, position), (GL_DIFFUSE, color.extend(1.0))];
        for (name, value) in values {
            let floats = value.to_array();
            self.calls.call(id::glLightfv, &[light.into(), name.into(), Arg::Floats(&floats)]);
        }
        self.enable(light);
    }

    /// Makes a texture that repeats; without alpha where the picture has none.
    pub fn texture(&mut self, picture: &Picture) -> Texture {
        self.textures += 1;
        let texture = Texture(self.textures);
        self.bind(texture);
        let parameters = [
            (GL_TEXTURE_MIN_FILTER, GL_LINEAR),
            (GL_TEXTURE_MAG_FILTER, GL_LINEAR),
            (GL_TEXTURE_WRAP_S, GL_REPEAT),
            (GL_TEXTURE_WRAP_T, GL_REPEAT),
        ];
        for (name, value) in parameters {
            self.calls.call(id::glTexParameteri, &[GL_TEXTURE_2D.into(), name.into(), value.into()]);
        }
        let internal_format = if picture.is_opaque() { GL_RGB8 } else { GL_RGBA8 };
        let size = picture.size as i32;
        self.calls.call(
            id::glTexImage2D,
            &[
                GL_TEXTURE_2D.into(),
                0.into(),
                internal_format.into(),
                size.into(),
                size.into(),
                0.into(),
                GL_RGBA.into(),
                GL_UNSIGNED_BYTE.into(),
                Arg::Bytes(picture.texels.as_flattened()),
            ],
        );
        texture
    }

    /// Binds a texture to the active unit.
    pub fn bind(&mut self, texture: Texture) {
        self.calls.call(id::glBindTexture, &[GL_TEXTURE_2D.into(), texture.0.into()]);
    }

    /// Makes a unit active.
    pub fn unit(&mut self, unit: u32) {
        self.calls.call(id::glActiveTexture, &[(GL_TEXTURE0 + unit).into()]);
    }
}
