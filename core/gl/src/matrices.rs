//! Matrix stacks and the commands on them (specification 2.11.2).

use afterglow_api::constants::*;
use glam::{DVec3, Mat4, Vec3};

use crate::context::Context;
use crate::frame::TEXTURE_UNITS;
use crate::limits;
use crate::tables::Dirty;

/// A stack of matrices.
#[derive(Debug, Clone)]
pub struct Stack {
    top: Mat4,
    below: Vec<Mat4>,
    limit: usize,
}

impl Stack {
    fn new(limit: usize) -> Stack {
        Stack { top: Mat4::IDENTITY, below: Vec::new(), limit }
    }

    /// The current matrix.
    pub fn top(&self) -> Mat4 {
        self.top
    }

    /// How many matrices there are, the current one included.
    pub fn depth(&self) -> usize {
        self.below.len() + 1
    }

    fn push(&mut self) -> Result<(), u32> {
        if self.depth() >= self.limit {
            return Err(GL_STACK_OVERFLOW);
        }
        self.below.push(self.top);
        Ok(())
    }

    fn pop(&mut self) -> Result<(), u32> {
        self.top = self.below.pop().ok_or(GL_STACK_UNDERFLOW)?;
        Ok(())
    }
}

/// All stacks.
#[derive(Debug, Clone)]
pub struct Matrices {
    /// Object to eye space.
    pub modelview: Stack,
    /// Eye to clip space.
    pub projection: Stack,
    /// Texture coordinates of each unit.
    pub texture: [Stack; TEXTURE_UNITS],
    /// GL_COLOR: kept for programs that touch it, not applied to pixels.
    pub color: Stack,
}

impl Default for Matrices {
    fn default() -> Matrices {
        Matrices {
            modelview: Stack::new(limits::MODELVIEW_STACK),
            projection: Stack::new(limits::PROJECTION_STACK),
            texture: std::array::from_fn(|_| Stack::new(limits::TEXTURE_STACK)),
            color: Stack::new(2),
        }
    }
}

impl Context {
    fn stack(&mut self) -> &mut Stack {
        let (stack, dirty) = match self.state.transform.matrix_mode {
            GL_PROJECTION => (&mut self.matrices.projection, Dirty::TRANSFORM),
            GL_TEXTURE => (
                &mut self.matrices.texture[self.state.texture.active],
                Dirty::TEXTURE_MATRICES | Dirty::WORDS,
            ),
            GL_COLOR => (&mut self.matrices.color, Dirty::empty()),
            _ => (&mut self.matrices.modelview, Dirty::TRANSFORM),
        };
        self.tables.dirty |= dirty;
        stack
    }

    fn multiply(&mut self, right: Mat4) {
        let stack = self.stack();
        stack.top *= right;
    }

    pub(crate) fn exec_matrix_mode(&mut self, mode: u32) {
        match mode {
            GL_MODELVIEW | GL_PROJECTION | GL_TEXTURE | GL_COLOR => self.state.transform.matrix_mode = mode,
            _ => self.record_error(GL_INVALID_ENUM),
        }
    }

    pub(crate) fn exec_load_identity(&mut self) {
        self.stack().top = Mat4::IDENTITY;
    }

    pub(crate) fn exec_load_matrix(&mut self, matrix: [f32; 16]) {
        self.stack().top = Mat4::from_cols_array(&matrix);
    }

    pub(crate) fn exec_load_transpose_matrix(&mut self, matrix: [f32; 16]) {
        self.stack().top = Mat4::from_cols_array(&matrix).transpose();
    }

    pub(crate) fn exec_mult_matrix(&mut self, matrix: [f32; 16]) {
        self.multiply(Mat4::from_cols_array(&matrix));
    }

    pub(crate) fn exec_mult_transpose_matrix(&mut self, matrix: [f32; 16]) {
        self.multiply(Mat4::from_cols_array(&matrix).transpose());
    }

    pub(crate) fn exec_translate(&mut self, x: f32, y: f32, z: f32) {
        self.multiply(Mat4::from_translation(Vec3::new(x, y, z)));
    }

    pub(crate) fn exec_scale(&mut self, x: f32, y: f32, z: f32) {
        self.multiply(Mat4::from_scale(Vec3::new(x, y, z)));
    }

    pub(crate) fn exec_rotate(&mut self, angle: f32, x: f32, y: f32, z: f32) {
        // In f64: the sine and cosine of right angles come out exact enough to keep axes aligned.
        let axis = DVec3::new(x.into(), y.into(), z.into());
        if let Some(axis) = axis.try_normalize() {
            let (sin, cos) = match angle.rem_euclid(360.0) {
                0.0 => (0.0, 1.0),
                90.0 => (1.0, 0.0),
                180.0 => (0.0, -1.0),
                270.0 => (-1.0, 0.0),
                other => f64::from(other).to_radians().sin_cos(),
            };
            self.multiply(rotation(axis, sin, cos));
        }
    }

    pub(crate) fn exec_ortho(&mut self, l: f64, r: f64, b: f64, t: f64, n: f64, f: f64) {
        if l == r || b == t || n == f {
            return self.record_error(GL_INVALID_VALUE);
        }
        let m = [
            2.0 / (r - l),
            0.0,
            0.0,
            0.0,
            0.0,
            2.0 / (t - b),
            0.0,
            0.0,
            0.0,
            0.0,
            -2.0 / (f - n),
            0.0,
            -(r + l) / (r - l),
            -(t + b) / (t - b),
            -(f + n) / (f - n),
            1.0,
        ];
        self.multiply(Mat4::from_cols_array(&m.map(|v| v as f32)));
    }

    pub(crate) fn exec_frustum(&mut self, l: f64, r: f64, b: f64, t: f64, n: f64, f: f64) {
        if n <= 0.0 || f <= 0.0 || l == r || b == t || n == f {
            return self.record_error(GL_INVALID_VALUE);
        }
        let m = [
            2.0 * n / (r - l),
            0.0,
            0.0,
            0.0,
            0.0,
            2.0 * n / (t - b),
            0.0,
            0.0,
            (r + l) / (r - l),
            (t + b) / (t - b),
            -(f + n) / (f - n),
            -1.0,
            0.0,
            0.0,
            -2.0 * f * n / (f - n),
            0.0,
        ];
        self.multiply(Mat4::from_cols_array(&m.map(|v| v as f32)));
    }

    pub(crate) fn exec_push_matrix(&mut self) {
        let result = self.stack().push();
        self.check(result);
    }

    pub(crate) fn exec_pop_matrix(&mut self) {
        let result = self.stack().pop();
        self.check(result);
    }
}

/// Rotation about a unit axis (specification 2.11.2, glRotate).
fn rotation(axis: DVec3, sin: f64, cos: f64) -> Mat4 {
    let DVec3 { x, y, z } = axis;
    let k = 1.0 - cos;
    let m = [
        x * x * k + cos,
        y * x * k + z * sin,
        x * z * k - y * sin,
        0.0,
        x * y * k - z * sin,
        y * y * k + cos,
        y * z * k + x * sin,
        0.0,
        x * z * k + y * sin,
        y * z * k - x * sin,
        z * z * k + cos,
        0.0,
        0.0,
        0.0,
        0.0,
        1.0,
    ];
    Mat4::from_cols_array(&m.map(|v| v as f32))
}
