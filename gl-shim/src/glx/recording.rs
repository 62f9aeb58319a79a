//! Calls of GLX as a recording has them: those that a player needs to make contexts and windows.

use std::ffi::c_void;
use std::sync::atomic::Ordering;

use afterglow_api::CommandId;

use super::binding;
use super::xlib::VisualInfo;
use crate::record;
use crate::record::glx::{Value, Visual};

/// Records a call with these arguments, in order.
pub fn call(id: CommandId, arguments: &[Value], result: Option<Value>) {
    if record::is_on() {
        let arguments: Vec<_> = arguments.iter().copied().enumerate().collect();
        record::glx::call(id, &arguments, &[], result);
    }
}

/// An address.
pub fn pointer<T>(address: *const T) -> Value<'static> {
    Value::Pointer(address as usize)
}

/// Xlib's Bool.
pub fn boolean(value: i32) -> Value<'static> {
    Value::Bool(value != 0)
}

/// Records a call with an argument or result that points to a visual.
///
/// # Safety
/// `info` must be null or readable.
pub unsafe fn with_visual(info: *const VisualInfo, record: impl FnOnce(Value)) {
    if !record::is_on() {
        return;
    }
    // SAFETY: the caller vouches for it.
    let visual = unsafe { info.as_ref() }.map(|info| Visual {
        visual: info.visual as usize,
        visual_id: info.visualid,
        screen: info.screen,
        depth: info.depth,
        class: info.class,
        red_mask: info.red_mask,
        green_mask: info.green_mask,
        blue_mask: info.blue_mask,
        colormap_size: info.colormap_size,
        bits_per_rgb: info.bits_per_rgb,
    });
    record(Value::Visual(visual.as_ref()));
}

/// A context that was made with a configuration.
pub fn new_context(
    id: CommandId,
    [display, config, share]: [*const c_void; 3],
    render_type: Option<i32>,
    direct: i32,
    context: *const c_void,
) {
    let share = [pointer(share), boolean(direct)];
    let leading = [pointer(display), pointer(config)];
    let kind = render_type.map(|kind| Value::Enum(kind as u32));
    let arguments: Vec<_> = leading.into_iter().chain(kind).chain(share).collect();
    call(id, &arguments, Some(pointer(context)));
}

/// What follows the call that made a context current for the first time: the size of what it draws to.
pub fn made_current() {
    if !record::is_on() {
        return;
    }
    binding::with(|binding| {
        if !binding.context.has_recorded_size.swap(true, Ordering::Relaxed) {
            let (width, height) = binding.draw.size();
            record::glx::drawable_size(width, height);
        }
    });
}
