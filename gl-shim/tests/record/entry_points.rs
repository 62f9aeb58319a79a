//! Entry points as a program in C declares them.

use std::ffi::{c_char, c_int, c_ulong, c_void};

unsafe extern "system" {
    pub fn glBegin(mode: u32);
    pub fn glEnd();
    pub fn glColor4ub(red: u8, green: u8, blue: u8, alpha: u8);
    pub fn glVertex3f(x: f32, y: f32, z: f32);
    pub fn glTexCoord2fv(v: *const f32);
    pub fn glLoadMatrixd(m: *const f64);
    pub fn glGenTextures(n: i32, textures: *mut u32);
    pub fn glBindTexture(target: u32, texture: u32);
    pub fn glTexParameteri(target: u32, pname: u32, param: i32);
    pub fn glTexEnvfv(target: u32, pname: u32, params: *const f32);
    pub fn glPixelStorei(pname: u32, param: i32);
    pub fn glTexImage2D(
        target: u32,
        level: i32,
        internal_format: i32,
        width: i32,
        height: i32,
        border: i32,
        format: u32,
        kind: u32,
        pixels: *const c_void,
    );
    pub fn glGenLists(range: i32) -> u32;
    pub fn glNewList(list: u32, mode: u32);
    pub fn glEndList();
    pub fn glCallLists(n: i32, kind: u32, lists: *const c_void);
    pub fn glClear(mask: u32);
    pub fn glGetIntegerv(pname: u32, params: *mut i32);
    pub fn glGetString(name: u32) -> *const u8;
    pub fn glGetError() -> u32;
    pub fn glIsEnabled(cap: u32) -> u8;
    pub fn glMap1f(target: u32, u1: f32, u2: f32, stride: i32, order: i32, points: *const f32);
    pub fn glEnableClientState(array: u32);
    pub fn glDisableClientState(array: u32);
    pub fn glVertexPointer(size: i32, kind: u32, stride: i32, pointer: *const c_void);
    pub fn glTexCoordPointer(size: i32, kind: u32, stride: i32, pointer: *const c_void);
    pub fn glClientActiveTexture(texture: u32);
    pub fn glInterleavedArrays(format: u32, stride: i32, pointer: *const c_void);
    pub fn glArrayElement(i: i32);
    pub fn glDrawArrays(mode: u32, first: i32, count: i32);
    pub fn glDrawElements(mode: u32, count: i32, kind: u32, indices: *const c_void);
    pub fn glMultiDrawElements(
        mode: u32,
        count: *const i32,
        kind: u32,
        indices: *const *const c_void,
        draws: i32,
    );
    pub fn glLockArraysEXT(first: i32, count: i32);
    pub fn glUnlockArraysEXT();
    pub fn glBindBufferARB(target: u32, buffer: u32);
    pub fn glBufferDataARB(target: u32, size: isize, data: *const c_void, usage: u32);
    pub fn glMapBufferARB(target: u32, access: u32) -> *mut c_void;
    pub fn glUnmapBufferARB(target: u32) -> u8;
    pub fn glXQueryVersion(display: *mut c_void, major: *mut c_int, minor: *mut c_int) -> c_int;
    pub fn glXGetClientString(display: *mut c_void, name: c_int) -> *const c_char;
    pub fn glXChooseVisual(display: *mut c_void, screen: c_int, list: *const c_int) -> *mut XVisualInfo;
    pub fn glXChooseFBConfig(
        display: *mut c_void,
        screen: c_int,
        list: *const c_int,
        count: *mut c_int,
    ) -> *mut *mut c_void;
    pub fn glXGetFBConfigAttrib(
        display: *mut c_void,
        config: *const c_void,
        attribute: c_int,
        value: *mut c_int,
    ) -> c_int;
    pub fn glXCreateContext(
        display: *mut c_void,
        visual: *const XVisualInfo,
        share: *mut c_void,
        direct: c_int,
    ) -> *mut c_void;
    pub fn glXCreateWindow(
        display: *mut c_void,
        config: *const c_void,
        window: c_ulong,
        list: *const c_int,
    ) -> c_ulong;
    pub fn glXSwapBuffers(display: *mut c_void, drawable: c_ulong);
}

/// As in Xutil.h.
#[repr(C)]
#[derive(Default)]
pub struct XVisualInfo {
    pub visual: usize,
    pub visual_id: c_ulong,
    pub screen: c_int,
    pub depth: c_int,
    pub class: c_int,
    pub red_mask: c_ulong,
    pub green_mask: c_ulong,
    pub blue_mask: c_ulong,
    pub colormap_size: c_int,
    pub bits_per_rgb: c_int,
}
