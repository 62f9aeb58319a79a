//! Calls of GLX, which its functions record when they have their results: [`call`].

use afterglow_api::{CommandId, id};

use super::number::Writer;
use super::plan::plan;
use super::recorder::Recorder;
use super::{is_on, names, recorder, thread};
use crate::boundary::guarded;

/// An argument or a result.
#[derive(Debug, Clone, Copy)]
pub enum Value<'a> {
    /// A display, a context, a configuration: an address, or null.
    Pointer(usize),
    /// A window and the like.
    Id(u64),
    /// A number.
    Int(i64),
    /// A name of GLX.
    Enum(u32),
    /// Xlib's Bool.
    Bool(bool),
    /// A C string without its zero; null if there is none.
    Text(Option<&'a [u8]>),
    /// Pairs of names and values of glXChooseFBConfig and later functions, up to and including the zero.
    Attributes(Option<&'a [i32]>),
    /// Attributes of glXChooseVisual, some of which have no value, up to and including the zero.
    VisualAttributes(Option<&'a [i32]>),
    /// Several addresses.
    Pointers(&'a [usize]),
    /// Several numbers, or one that a pointer points to.
    Ints(&'a [i64]),
    /// What points to an XVisualInfo; null if there is none.
    Visual(Option<&'a Visual>),
}

/// XVisualInfo.
#[derive(Debug, Clone, Copy, Default)]
#[expect(missing_docs, reason = "the names are Xlib's")]
pub struct Visual {
    pub visual: usize,
    pub visual_id: u64,
    pub screen: i32,
    pub depth: i32,
    pub class: i32,
    pub red_mask: u64,
    pub green_mask: u64,
    pub blue_mask: u64,
    pub colormap_size: i32,
    pub bits_per_rgb: i32,
}

/// Records a call that has been made: its arguments by position, `Value`s of those that it wrote, with their positions,
/// and what it returned. The names come from the registry. A buffer swap brings the file up to date.
///
/// ```ignore
/// record::glx::call(
///     id::glXMakeCurrent,
///     &[(0, Value::Pointer(dpy)), (1, Value::Id(drawable)), (2, Value::Pointer(ctx))],
///     &[],
///     Some(Value::Bool(true)),
/// );
/// ```
pub fn call(id: CommandId, arguments: &[(usize, Value)], written: &[(usize, Value)], result: Option<Value>) {
    if is_on() {
        guarded(|| record(id, arguments, written, result));
    }
}

/// Records the size of the drawable that became current with a context for the first time: as apitrace does, by calls
/// that set what OpenGL sets by itself.
pub fn drawable_size(width: u32, height: u32) {
    if !is_on() {
        return;
    }
    guarded(|| {
        let Some(mut recorder) = recorder() else { return };
        for id in [id::glViewport, id::glScissor] {
            let arguments = [0, 0, width, height].map(|value| Value::Int(value.into()));
            let arguments: Vec<_> = arguments.into_iter().enumerate().collect();
            let number = enter(&mut recorder, id, &arguments, true);
            recorder.writer.leave(number);
            recorder.writer.end();
        }
    });
}

#[cold]
fn record(id: CommandId, arguments: &[(usize, Value)], written: &[(usize, Value)], result: Option<Value>) {
    let Some(mut recorder) = recorder() else { return };
    let number = enter(&mut recorder, id, arguments, false);
    recorder.writer.leave(number);
    values(&mut recorder.writer, written);
    if let Some(result) = result {
        recorder.writer.result();
        write(&mut recorder.writer, result);
    }
    recorder.writer.end();
    if id == id::glXSwapBuffers {
        recorder.flush();
    }
}

fn enter(recorder: &mut Recorder, id: CommandId, arguments: &[(usize, Value)], fake: bool) -> u32 {
    let number = recorder.begin(thread(), id, plan(id));
    if fake {
        recorder.writer.fake();
    }
    values(&mut recorder.writer, arguments);
    recorder.writer.end();
    number
}

fn values(writer: &mut Writer, values: &[(usize, Value)]) {
    for &(index, value) in values {
        writer.argument(index);
        write(writer, value);
    }
}

fn write(writer: &mut Writer, value: Value) {
    match value {
        Value::Pointer(address) => writer.pointer(address as u64),
        Value::Id(id) => writer.uint(id),
        Value::Int(value) => writer.sint(value),
        Value::Enum(value) => writer.enumerant(&names::GLX, value.into()),
        Value::Bool(value) => writer.enumerant(&names::X_BOOLEANS, value.into()),
        Value::Text(Some(text)) => writer.string(text),
        Value::Attributes(Some(list)) => attributes(writer, list, |_| true),
        Value::VisualAttributes(Some(list)) => {
            attributes(writer, list, |name| !matches!(name, 1 | 4 | 5 | 6))
        }
        Value::Pointers(addresses) => {
            writer.array(addresses.len());
            addresses.iter().for_each(|address| writer.pointer(*address as u64));
        }
        Value::Ints(values) => {
            writer.array(values.len());
            values.iter().for_each(|value| writer.sint(*value));
        }
        Value::Visual(Some(visual)) => write_visual(writer, visual),
        Value::Text(None) | Value::Attributes(None) | Value::VisualAttributes(None) | Value::Visual(None) => {
            writer.null();
        }
    }
}

/// Names, each followed by a value if it has one.
fn attributes(writer: &mut Writer, list: &[i32], has_value: impl Fn(i32) -> bool) {
    writer.array(list.len());
    let mut is_value = false;
    for &item in list {
        let is_name = !is_value && item != 0;
        match is_name {
            true => writer.enumerant(&names::GLX, item.into()),
            false => writer.sint(item.into()),
        }
        is_value = is_name && has_value(item);
    }
}

fn write_visual(writer: &mut Writer, visual: &Visual) {
    writer.array(1);
    writer.structure(&names::VISUAL);
    writer.pointer(visual.visual as u64);
    writer.uint(visual.visual_id);
    [visual.screen, visual.depth, visual.class].into_iter().for_each(|value| writer.sint(value.into()));
    [visual.red_mask, visual.green_mask, visual.blue_mask].into_iter().for_each(|mask| writer.uint(mask));
    [visual.colormap_size, visual.bits_per_rgb].into_iter().for_each(|value| writer.sint(value.into()));
}
