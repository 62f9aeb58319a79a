//! The numbers of a draw's state that are set while recording.

use afterglow_gl::frame::FixedState;
use afterglow_gpu::{Commands, Gpu, ash, vk};

/// Functions that set how lines are stippled.
pub(crate) type LineFunctions = ash::ext::line_rasterization::Device;

/// A stencil test's reference, comparison mask and write mask.
type StencilNumbers = [u32; 3];

/// What is set; none where nothing has been set yet.
#[derive(Debug, Default)]
pub(crate) struct Numbers {
    line_width: Option<u32>,
    /// Units and factor.
    depth_bias: Option<[f32; 2]>,
    blend_constants: Option<[f32; 4]>,
    stencil: Option<StencilNumbers>,
    line_stipple: Option<(u16, u16)>,
}

impl Numbers {
    /// Sets what differs from what is set. Everything is set at the first call, whether the state uses it or not.
    pub(crate) fn set(
        &mut self,
        commands: &Commands<'_>,
        gpu: &Gpu,
        state: &FixedState,
        stipple_functions: Option<&LineFunctions>,
    ) {
        let raster = &state.raster;
        let (device, buffer) = (commands.device(), commands.raw());
        let antialiased = state.words.global.smooth() != 0;
        let line_width = line_width(raster.line_width.get(), antialiased, gpu);
        let bias = raster.depth_bias.map_or([0.0; 2], |(factor, units)| [units.get(), factor.get()]);
        let constants =
            raster.blend.map_or([0.0; 4], |blend| blend.constant.map(|component| component.get()));
        let stencil = raster
            .stencil
            .map_or([0; 3], |stencil| [stencil.reference, stencil.compare_mask, stencil.write_mask]);
        // SAFETY: the buffer is being recorded, and every value is one that the device allows.
        unsafe {
            if is_new(&mut self.line_width, line_width.to_bits()) {
                device.cmd_set_line_width(buffer, line_width);
            }
            if is_new(&mut self.depth_bias, bias) {
                let [units, factor] = bias;
                device.cmd_set_depth_bias(buffer, units, 0.0, factor);
            }
            if is_new(&mut self.blend_constants, constants) {
                device.cmd_set_blend_constants(buffer, &constants);
            }
            if is_new(&mut self.stencil, stencil) {
                let [reference, compare_mask, write_mask] = stencil;
                let faces = vk::StencilFaceFlags::FRONT_AND_BACK;
                device.cmd_set_stencil_reference(buffer, faces, reference);
                device.cmd_set_stencil_compare_mask(buffer, faces, compare_mask);
                device.cmd_set_stencil_write_mask(buffer, faces, write_mask);
            }
        }
        let stipple = raster.line_stipple.unwrap_or((1, u16::MAX));
        if let Some(functions) = stipple_functions
            && is_new(&mut self.line_stipple, stipple)
        {
            let (factor, pattern) = stipple;
            let factor = u32::from(factor).clamp(1, 256);
            // SAFETY: the extension is enabled where its functions are there.
            unsafe { (functions.fp().cmd_set_line_stipple_ext)(buffer, factor, pattern) };
        }
    }
}

/// Remembers a value. Says whether it is another one.
fn is_new<T: PartialEq>(set: &mut Option<T>, value: T) -> bool {
    let is_new = set.as_ref() != Some(&value);
    *set = Some(value);
    is_new
}

/// The width that is drawn (OpenGL 1.5, section 3.4.2): whole pixels unless it is antialiased.
fn line_width(width: f32, antialiased: bool, gpu: &Gpu) -> f32 {
    if !gpu.features().wide_lines {
        return 1.0;
    }
    let width = if antialiased { width } else { width.round().max(1.0) };
    let [least, most] = gpu.limits().line_width_range;
    if width.is_nan() { 1.0 } else { width.clamp(least, most) }
}
