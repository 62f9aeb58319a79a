//! What parameters and results of GLX are, and how each is written.

use std::ffi::{CStr, c_int, c_uint, c_ulong};

use super::lists::{self, List};
use super::names;
use crate::glx::VisualInfo;
use crate::record::Bits;
use crate::record::number::Writer;

/// A parameter or a result.
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    /// A display, a context, a configuration, a function: an address, or null.
    Pointer,
    /// A window and the like, an unsigned number, a mask.
    Id,
    /// A signed number.
    Int,
    /// Xlib's Bool.
    Bool,
    /// The name of an attribute or a value of one.
    Attribute,
    /// Which string is asked for.
    StringName,
    /// An error code.
    Error,
    /// A C string.
    Text,
    /// Attributes, mostly with values.
    List(List),
    /// What points to an XVisualInfo.
    Visual,
    /// What points to an int that the function writes.
    WrittenInt,
    /// What points to an unsigned int that the function writes.
    WrittenUint,
    /// What points to an unsigned long that the function writes.
    WrittenMask,
    /// Returned addresses, as many as the int says that the function has written to the parameter at that position.
    Handles(usize),
}

impl Kind {
    /// Whether it is a parameter that the function writes to.
    pub fn is_written(self) -> bool {
        matches!(self, Kind::WrittenInt | Kind::WrittenUint | Kind::WrittenMask)
    }

    /// Writes a value.
    ///
    /// # Safety
    /// What it points to is of this kind; so are the arguments of the kinds that they have in the function.
    pub unsafe fn write(self, writer: &mut Writer, bits: u64, arguments: &[u64]) {
        let address = bits as usize;
        match self {
            Kind::Pointer => writer.pointer(bits),
            Kind::Id => writer.uint(bits),
            Kind::Int => writer.sint(bits as i64),
            Kind::Bool => writer.enumerant(&names::BOOLEANS, bits as i64),
            Kind::Attribute => writer.enumerant(&names::ATTRIBUTES, bits as i64),
            Kind::StringName => writer.enumerant(&names::STRINGS, bits as i64),
            Kind::Error => writer.enumerant(&names::ERRORS, bits as i64),
            // SAFETY: the caller vouches for what a pointer points to.
            Kind::List(list) => unsafe { lists::write(writer, list, address as *const c_int) },
            _ if address == 0 => writer.null(),
            // SAFETY: the caller vouches for what a pointer points to, and it is not null.
            _ => unsafe { self.write_pointed(writer, address, arguments) },
        }
    }

    unsafe fn write_pointed(self, writer: &mut Writer, address: usize, arguments: &[u64]) {
        // SAFETY: the caller vouches for it.
        unsafe {
            match self {
                Kind::Text => writer.string(CStr::from_ptr(address as *const _).to_bytes()),
                Kind::Visual => write_visual(writer, &(address as *const VisualInfo).read_unaligned()),
                Kind::WrittenInt => one(writer).sint((address as *const c_int).read_unaligned().into()),
                Kind::WrittenUint => one(writer).uint((address as *const c_uint).read_unaligned().into()),
                Kind::WrittenMask => one(writer).uint((address as *const c_ulong).read_unaligned().bits()),
                Kind::Handles(count) => {
                    let count = (arguments[count] as *const c_int).read_unaligned();
                    let handles = std::slice::from_raw_parts(address as *const usize, count.max(0) as usize);
                    writer.array(handles.len());
                    handles.iter().for_each(|handle| writer.pointer(*handle as u64));
                }
                _ => writer.pointer(address as u64),
            }
        }
    }
}

/// What a pointer points to is written as an array of one.
fn one(writer: &mut Writer) -> &mut Writer {
    writer.array(1);
    writer
}

fn write_visual(writer: &mut Writer, info: &VisualInfo) {
    one(writer).structure(&names::VISUAL);
    writer.pointer(info.visual as u64);
    writer.uint(info.visualid.bits());
    [info.screen, info.depth, info.class].into_iter().for_each(|value| writer.sint(value.into()));
    [info.red_mask, info.green_mask, info.blue_mask].into_iter().for_each(|mask| writer.uint(mask.bits()));
    [info.colormap_size, info.bits_per_rgb].into_iter().for_each(|value| writer.sint(value.into()));
}
