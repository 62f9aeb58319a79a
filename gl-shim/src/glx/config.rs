//! Framebuffer configurations (GLX 1.4 specification, 3.3.3).

use std::ffi::c_void;

use afterglow_api::constants::glx::*;
use afterglow_gl::Buffers;
use parking_lot::Mutex;

/// Greatest width and height of a pbuffer.
pub const PBUFFER_EXTENT: i32 = 8192;
/// Bits of red, green, blue and alpha each. Where a window has no alpha, the buffer has it all the same.
const COMPONENT_BITS: i32 = 8;
/// Id of a screen's first configuration.
const FIRST_ID: i32 = 0x101;

/// A visual that can be drawn to: true colour, 8 bits a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Visual {
    /// The visual's id.
    pub id: u32,
    /// Bits of a window's pixel that X knows: 24 or 32.
    pub depth: i32,
}

/// A configuration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Config {
    /// GLX_FBCONFIG_ID.
    pub id: i32,
    /// The screen.
    pub screen: i32,
    /// The visual of its windows.
    pub visual: Visual,
    /// Two buffers.
    pub is_double: bool,
    /// Bits of depth.
    pub depth: i32,
    /// Bits of stencil.
    pub stencil: i32,
    /// Bits of each component of the accumulation buffer.
    pub accum: i32,
}

impl Config {
    /// The value of an attribute.
    pub fn get(&self, attribute: u32) -> Option<i32> {
        let value = match attribute {
            GLX_FBCONFIG_ID => self.id,
            GLX_SCREEN => self.screen,
            GLX_VISUAL_ID => self.visual.id as i32,
            GLX_BUFFER_SIZE => 4 * COMPONENT_BITS,
            GLX_RED_SIZE | GLX_GREEN_SIZE | GLX_BLUE_SIZE | GLX_ALPHA_SIZE => COMPONENT_BITS,
            GLX_DOUBLEBUFFER => self.is_double.into(),
            GLX_DEPTH_SIZE => self.depth,
            GLX_STENCIL_SIZE => self.stencil,
            GLX_ACCUM_RED_SIZE | GLX_ACCUM_GREEN_SIZE | GLX_ACCUM_BLUE_SIZE | GLX_ACCUM_ALPHA_SIZE => {
                self.accum
            }
            GLX_RENDER_TYPE => GLX_RGBA_BIT as i32,
            GLX_DRAWABLE_TYPE => (GLX_WINDOW_BIT | GLX_PIXMAP_BIT | GLX_PBUFFER_BIT) as i32,
            GLX_X_RENDERABLE | GLX_USE_GL | GLX_RGBA => 1,
            GLX_X_VISUAL_TYPE => GLX_TRUE_COLOR as i32,
            GLX_CONFIG_CAVEAT | GLX_TRANSPARENT_TYPE => GLX_NONE as i32,
            GLX_MAX_PBUFFER_WIDTH | GLX_MAX_PBUFFER_HEIGHT => PBUFFER_EXTENT,
            GLX_MAX_PBUFFER_PIXELS => PBUFFER_EXTENT * PBUFFER_EXTENT,
            GLX_LEVEL | GLX_STEREO | GLX_AUX_BUFFERS | GLX_SAMPLE_BUFFERS | GLX_SAMPLES => 0,
            GLX_TRANSPARENT_INDEX_VALUE
            | GLX_TRANSPARENT_RED_VALUE
            | GLX_TRANSPARENT_GREEN_VALUE
            | GLX_TRANSPARENT_BLUE_VALUE
            | GLX_TRANSPARENT_ALPHA_VALUE => 0,
            GLX_OPTIMAL_PBUFFER_WIDTH_SGIX | GLX_OPTIMAL_PBUFFER_HEIGHT_SGIX => 0,
            GLX_FRAMEBUFFER_SRGB_CAPABLE_ARB | GLX_VISUAL_SELECT_GROUP_SGIX => 0,
            GLX_SWAP_METHOD_OML => GLX_SWAP_UNDEFINED_OML as i32,
            _ => return None,
        };
        Some(value)
    }

    /// What a context knows of it.
    pub fn buffers(&self) -> Buffers {
        Buffers {
            is_double: self.is_double,
            depth: self.depth as u8,
            stencil: self.stencil as u8,
            accumulation: self.accum as u8,
        }
    }

    /// The handle that programs know it by.
    pub fn handle(&'static self) -> *mut c_void {
        std::ptr::from_ref(self).cast_mut().cast()
    }
}

/// All configurations of a screen's visuals, unsorted.
pub fn all(screen: i32, visuals: &[Visual]) -> Vec<Config> {
    let mut configs = Vec::new();
    for &visual in visuals {
        for is_double in [true, false] {
            for (depth, stencil) in [(24, 8), (24, 0), (0, 0)] {
                for accum in [0, 16] {
                    let id = FIRST_ID + configs.len() as i32;
                    configs.push(Config { id, screen, visual, is_double, depth, stencil, accum });
                }
            }
        }
    }
    configs
}

/// Tables that handles point into. They live for ever, since programs keep handles; equal ones are one.
static TABLES: Mutex<Vec<&'static [Config]>> = Mutex::new(Vec::new());

/// Makes a table permanent.
pub fn keep(configs: Vec<Config>) -> &'static [Config] {
    let mut tables = TABLES.lock();
    if let Some(table) = tables.iter().find(|table| **table == configs) {
        return table;
    }
    let table: &'static [Config] = configs.leak();
    tables.push(table);
    table
}

/// The configuration of a handle, which may be garbage.
pub fn from_handle(handle: *const c_void) -> Option<&'static Config> {
    let size = size_of::<Config>();
    TABLES.lock().iter().find_map(|table| {
        let offset = (handle as usize).checked_sub(table.as_ptr() as usize)?;
        table.get(offset / size).filter(|_| offset % size == 0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn handles_are_checked() {
        let visuals = [Visual { id: 0x21, depth: 24 }, Visual { id: 0x22, depth: 32 }];
        let table = keep(all(0, &visuals));
        assert_eq!(table.len(), 24);
        assert!(std::ptr::eq(table, keep(all(0, &visuals))));
        for config in table {
            assert_eq!(from_handle(config.handle()), Some(config));
        }
        let start = table.as_ptr() as usize;
        for garbage in [0, 1, start - 4, start + 4, start + size_of_val(table), usize::MAX] {
            assert_eq!(from_handle(garbage as *const c_void), None);
        }
    }

    #[test]
    fn ids_differ() {
        let configs = all(1, &[Visual { id: 1, depth: 24 }, Visual { id: 2, depth: 24 }]);
        let ids: std::collections::HashSet<_> = configs.iter().map(|config| config.id).collect();
        assert_eq!(ids.len(), configs.len());
    }

    #[test]
    fn unknown_attributes_have_no_value() {
        let config = all(0, &[Visual { id: 1, depth: 24 }])[0];
        assert_eq!(config.get(GLX_SAMPLES), Some(0));
        assert_eq!(config.get(0x7777), None);
    }
}
