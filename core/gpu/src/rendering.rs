//! Drawing to attachments, without render-pass objects.

use ash::vk;

use crate::commands::Commands;

impl Commands<'_> {
    /// Records draws to the attachments of `info`; `record` must not copy or dispatch.
    pub fn rendering<T>(&self, info: &vk::RenderingInfo<'_>, record: impl FnOnce() -> T) -> T {
        let functions = &self.shared.dynamic_rendering;
        // SAFETY: the buffer is being recorded; the validation layer checks the attachments.
        unsafe {
            match functions {
                Some(functions) => functions.cmd_begin_rendering(self.raw(), info),
                None => self.device().cmd_begin_rendering(self.raw(), info),
            }
        }
        let result = record();
        // SAFETY: as above; begin and end come in pairs.
        unsafe {
            match functions {
                Some(functions) => functions.cmd_end_rendering(self.raw()),
                None => self.device().cmd_end_rendering(self.raw()),
            }
        }
        result
    }
}
