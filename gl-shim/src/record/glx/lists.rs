//! Lists of attributes. Which meaning a value has depends on the attribute and on the function that is given the list.

use std::ffi::c_int;

use afterglow_api::constants::glx::*;
use afterglow_trace::write::Bitmask;

use super::names;
use crate::record::number::Writer;

/// Words of a list that are recorded at most; a longer one is not terminated.
const MOST_WORDS: usize = 256;

/// Whose attributes a list has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum List {
    /// glXChooseVisual's, some of which have no value.
    Visual,
    /// Those of a configuration.
    Config,
    /// Those of a context.
    Context,
    /// Those of a pbuffer or of a pixmap.
    Drawable,
    /// glXCreateWindow's, of which there are none.
    Window,
}

/// What the value of an attribute is.
enum Meaning {
    /// There is none.
    Flag,
    Int,
    Uint,
    Bool,
    Name,
    Bits(&'static Bitmask<'static>),
}

impl List {
    fn meaning(self, attribute: u32) -> Meaning {
        match (self, attribute) {
            (List::Visual, GLX_USE_GL | GLX_RGBA | GLX_DOUBLEBUFFER | GLX_STEREO) => Meaning::Flag,
            (List::Visual, GLX_FRAMEBUFFER_SRGB_CAPABLE_ARB) => Meaning::Flag,
            (List::Visual | List::Config, _) => of_config(attribute),
            (List::Context, _) => of_context(attribute),
            (List::Drawable, _) => of_drawable(attribute),
            (List::Window, _) => Meaning::Int,
        }
    }
}

fn of_config(attribute: u32) -> Meaning {
    match attribute {
        GLX_BUFFER_SIZE | GLX_AUX_BUFFERS | GLX_FBCONFIG_ID | GLX_VISUAL_ID => Meaning::Uint,
        GLX_RED_SIZE..=GLX_ACCUM_ALPHA_SIZE => Meaning::Uint,
        GLX_CONFIG_CAVEAT | GLX_X_VISUAL_TYPE | GLX_TRANSPARENT_TYPE => Meaning::Name,
        GLX_DOUBLEBUFFER | GLX_STEREO | GLX_X_RENDERABLE | GLX_FRAMEBUFFER_SRGB_CAPABLE_ARB => Meaning::Bool,
        GLX_RENDER_TYPE => Meaning::Bits(&names::RENDER_BITS),
        GLX_DRAWABLE_TYPE => Meaning::Bits(&names::DRAWABLE_BITS),
        _ => Meaning::Int,
    }
}

fn of_context(attribute: u32) -> Meaning {
    match attribute {
        GLX_RENDER_TYPE | GLX_CONTEXT_RESET_NOTIFICATION_STRATEGY_ARB | GLX_CONTEXT_RELEASE_BEHAVIOR_ARB => {
            Meaning::Name
        }
        GLX_CONTEXT_FLAGS_ARB => Meaning::Bits(&names::CONTEXT_BITS),
        GLX_CONTEXT_PROFILE_MASK_ARB => Meaning::Bits(&names::PROFILE_BITS),
        GLX_CONTEXT_OPENGL_NO_ERROR_ARB => Meaning::Bool,
        _ => Meaning::Int,
    }
}

fn of_drawable(attribute: u32) -> Meaning {
    match attribute {
        GLX_LARGEST_PBUFFER | GLX_PRESERVED_CONTENTS | GLX_MIPMAP_TEXTURE_EXT => Meaning::Bool,
        GLX_TEXTURE_FORMAT_EXT | GLX_TEXTURE_TARGET_EXT => Meaning::Name,
        _ => Meaning::Int,
    }
}

/// Writes a list up to and including the zero; nothing is an empty list.
///
/// # Safety
/// `list` is null or can be read up to a zero in an attribute's place.
pub unsafe fn write(writer: &mut Writer, list: List, words: *const c_int) {
    // SAFETY: the contract is the same.
    let words = unsafe { read(list, words) };
    writer.array(words.len());
    let mut words = words.into_iter();
    while let Some(attribute) = words.next() {
        writer.enumerant(&names::ATTRIBUTES, attribute.into());
        let has_value = attribute != 0 && !matches!(list.meaning(attribute as u32), Meaning::Flag);
        if let Some(value) = has_value.then(|| words.next()).flatten() {
            write_value(writer, list.meaning(attribute as u32), value);
        }
    }
}

unsafe fn read(list: List, words: *const c_int) -> Vec<c_int> {
    let mut read = Vec::new();
    if words.is_null() {
        return read;
    }
    loop {
        // SAFETY: nothing behind the zero is read.
        let attribute = unsafe { words.add(read.len()).read_unaligned() };
        read.push(attribute);
        if attribute == 0 || read.len() >= MOST_WORDS {
            return read;
        }
        if !matches!(list.meaning(attribute as u32), Meaning::Flag) {
            // SAFETY: an attribute's value comes after it.
            read.push(unsafe { words.add(read.len()).read_unaligned() });
        }
    }
}

fn write_value(writer: &mut Writer, meaning: Meaning, value: c_int) {
    match meaning {
        Meaning::Flag | Meaning::Int => writer.sint(value.into()),
        Meaning::Uint => writer.uint((value as u32).into()),
        Meaning::Bool => writer.enumerant(&names::BOOLEANS, value.into()),
        Meaning::Name => writer.enumerant(&names::ATTRIBUTES, value.into()),
        Meaning::Bits(bits) => writer.bits(bits, (value as u32).into()),
    }
}
