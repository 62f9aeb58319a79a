//! Parts of a program, each with what it is recorded as.

use std::ffi::c_void;
use std::ptr::{null, null_mut};

use GL::record;
use afterglow_api::constants::*;

use crate::entry_points::*;

/// Numbers as memory.
fn memory<T>(values: &[T]) -> *const c_void {
    values.as_ptr().cast()
}

pub fn immediate_mode() {
    // SAFETY: the pointers are good.
    unsafe {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glLoadMatrixd([0.5; 16].as_ptr());
        glBegin(GL_POINTS);
        glColor4ub(255, 0, 7, 255);
        glTexCoord2fv([0.25, -1.0].as_ptr());
        glVertex3f(1.0, 0.0, -0.5);
        glEnd();
    }
}

pub const IMMEDIATE_MODE: &[&str] = &[
    "glClear(mask = GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT)",
    "glLoadMatrixd(m = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5})",
    "glBegin(mode = GL_POINTS)",
    "glColor4ub(red = 255, green = 0, blue = 7, alpha = 255)",
    "glTexCoord2fv(v = {0.25, -1})",
    "glVertex3f(x = 1, y = 0, z = -0.5)",
    "glEnd()",
];

pub fn textures_and_lists() {
    let image = [1u8, 2, 3, 4, 0, 0, 0, 0, 0, 0, 0, 0, 5, 6, 7, 8];
    let mut name = 0;
    // SAFETY: the image ends with the last texel that is read.
    unsafe {
        glGenTextures(1, &mut name);
        glBindTexture(GL_TEXTURE_2D, name);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR as i32);
        glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, [GL_MODULATE as f32].as_ptr());
        glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, [0.0, 0.5, 1.0, 1.0].as_ptr());
        glPixelStorei(GL_UNPACK_ROW_LENGTH, 3);
        let (format, kind) = (GL_RGBA, GL_UNSIGNED_BYTE);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA as i32, 1, 2, 0, format, kind, memory(&image));
        glTexImage2D(GL_TEXTURE_2D, 1, 4, 1, 1, 0, format, kind, null());
        glNewList(glGenLists(2), GL_COMPILE);
        glEndList();
        glCallLists(2, GL_UNSIGNED_SHORT, memory(&[1u16, 2]));
    }
}

pub const TEXTURES_AND_LISTS: &[&str] = &[
    "glGenTextures(n = 1, textures = &1)",
    "glBindTexture(target = GL_TEXTURE_2D, texture = 1)",
    "glTexParameteri(target = GL_TEXTURE_2D, pname = GL_TEXTURE_MIN_FILTER, param = GL_LINEAR)",
    "glTexEnvfv(target = GL_TEXTURE_ENV, pname = GL_TEXTURE_ENV_MODE, params = &GL_MODULATE)",
    "glTexEnvfv(target = GL_TEXTURE_ENV, pname = GL_TEXTURE_ENV_COLOR, params = {0, 0.5, 1, 1})",
    "glPixelStorei(pname = GL_UNPACK_ROW_LENGTH, param = 3)",
    "glTexImage2D(target = GL_TEXTURE_2D, level = 0, internalformat = GL_RGBA, width = 1, height = 2, border = 0, \
     format = GL_RGBA, type = GL_UNSIGNED_BYTE, pixels = blob(16))",
    "glTexImage2D(target = GL_TEXTURE_2D, level = 1, internalformat = 4, width = 1, height = 1, border = 0, \
     format = GL_RGBA, type = GL_UNSIGNED_BYTE, pixels = NULL)",
    "glGenLists(range = 2) = 1",
    "glNewList(list = 1, mode = GL_COMPILE)",
    "glEndList()",
    "glCallLists(n = 2, type = GL_UNSIGNED_SHORT, lists = blob(4))",
];

pub fn queries() {
    let mut viewport = [0; 4];
    // SAFETY: there is room.
    unsafe {
        glGetIntegerv(GL_VIEWPORT, viewport.as_mut_ptr());
        glGetString(GL_SHADING_LANGUAGE_VERSION_ARB);
        glIsEnabled(GL_LIGHTING);
        glMap1f(GL_MAP1_VERTEX_3, 0.0, 1.0, 3, 2, [0.5; 6].as_ptr());
        glGetError();
    }
}

/// Not in the scope of this library, and so an error.
const GL_SHADING_LANGUAGE_VERSION_ARB: u32 = 0x8b8c;

pub const QUERIES: &[&str] = &[
    "glGetIntegerv(pname = GL_VIEWPORT, params = {0, 0, 64, 48})",
    "glGetString(name = GL_SHADING_LANGUAGE_VERSION) = NULL",
    "glIsEnabled(cap = GL_LIGHTING) = GL_FALSE",
    "glMap1f(target = GL_MAP1_VERTEX_3, u1 = 0, u2 = 1, stride = 3, order = 2, points = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5})",
    "glGetError() = GL_INVALID_ENUM",
];

pub fn arrays_in_memory() {
    let vertices = [0.0f32; 40];
    // SAFETY: there are ten vertices.
    unsafe {
        glEnableClientState(GL_VERTEX_ARRAY);
        glVertexPointer(3, GL_FLOAT, 16, memory(&vertices));
        glDrawArrays(GL_TRIANGLES, 1, 3);
        glClientActiveTexture(GL_TEXTURE1);
        glEnableClientState(GL_TEXTURE_COORD_ARRAY);
        glTexCoordPointer(2, GL_FLOAT, 0, memory(&vertices));
        glClientActiveTexture(GL_TEXTURE0);
        glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_BYTE, memory(&[0u8, 7, 1]));
        glLockArraysEXT(0, 10);
        glMultiDrawElements(GL_LINES, [2].as_ptr(), GL_UNSIGNED_SHORT, [memory(&[1u16, 2])].as_ptr(), 1);
        glUnlockArraysEXT();
        glBegin(GL_POINTS);
        glArrayElement(2);
        glEnd();
        glClientActiveTexture(GL_TEXTURE1);
        glDisableClientState(GL_TEXTURE_COORD_ARRAY);
        glInterleavedArrays(GL_N3F_V3F, 0, memory(&vertices));
        glDrawArrays(GL_POINTS, 0, 2);
    }
}

pub const ARRAYS_IN_MEMORY: &[&str] = &[
    "glEnableClientState(array = GL_VERTEX_ARRAY)",
    "glVertexPointer(size = 3, type = GL_FLOAT, stride = 16, pointer = blob(60)) // fake",
    "glDrawArrays(mode = GL_TRIANGLES, first = 1, count = 3)",
    "glClientActiveTexture(texture = GL_TEXTURE1)",
    "glEnableClientState(array = GL_TEXTURE_COORD_ARRAY)",
    "glClientActiveTexture(texture = GL_TEXTURE0)",
    "glClientActiveTexture(texture = GL_TEXTURE1) // fake",
    "glTexCoordPointer(size = 2, type = GL_FLOAT, stride = 0, pointer = blob(64)) // fake",
    "glClientActiveTexture(texture = GL_TEXTURE0) // fake",
    "glVertexPointer(size = 3, type = GL_FLOAT, stride = 16, pointer = blob(124)) // fake",
    "glDrawElements(mode = GL_TRIANGLES, count = 3, type = GL_UNSIGNED_BYTE, indices = blob(3))",
    "glLockArraysEXT(first = 0, count = 10)",
    "glClientActiveTexture(texture = GL_TEXTURE1) // fake",
    "glTexCoordPointer(size = 2, type = GL_FLOAT, stride = 0, pointer = blob(80)) // fake",
    "glClientActiveTexture(texture = GL_TEXTURE0) // fake",
    "glVertexPointer(size = 3, type = GL_FLOAT, stride = 16, pointer = blob(156)) // fake",
    "glMultiDrawElements(mode = GL_LINES, count = &2, type = GL_UNSIGNED_SHORT, indices = &blob(4), drawcount = 1)",
    "glUnlockArraysEXT()",
    "glBegin(mode = GL_POINTS)",
    "glMultiTexCoord2fv(target = GL_TEXTURE1, v = {0, 0}) // fake",
    "glVertex3fv(v = {0, 0, 0}) // fake",
    "glEnd()",
    "glClientActiveTexture(texture = GL_TEXTURE1)",
    "glDisableClientState(array = GL_TEXTURE_COORD_ARRAY)",
    "glDisableClientState(array = GL_SECONDARY_COLOR_ARRAY) // fake",
    "glDisableClientState(array = GL_FOG_COORD_ARRAY) // fake",
    "glDisableClientState(array = GL_EDGE_FLAG_ARRAY) // fake",
    "glDisableClientState(array = GL_TEXTURE_COORD_ARRAY) // fake",
    "glDisableClientState(array = GL_INDEX_ARRAY) // fake",
    "glDisableClientState(array = GL_COLOR_ARRAY) // fake",
    "glEnableClientState(array = GL_NORMAL_ARRAY) // fake",
    "glEnableClientState(array = GL_VERTEX_ARRAY) // fake",
    "glNormalPointer(type = GL_FLOAT, stride = 24, pointer = blob(36)) // fake",
    "glVertexPointer(size = 3, type = GL_FLOAT, stride = 24, pointer = blob(36)) // fake",
    "glDrawArrays(mode = GL_POINTS, first = 0, count = 2)",
];

pub fn buffers() {
    let vertex = [0.0f32; 3];
    // SAFETY: there is one vertex, and four bytes are mapped.
    unsafe {
        glDisableClientState(GL_NORMAL_ARRAY);
        glVertexPointer(3, GL_FLOAT, 0, memory(&vertex));
        glBindBufferARB(GL_ARRAY_BUFFER, 1);
        glDrawArrays(GL_POINTS, 0, 1);
        glBufferDataARB(GL_ARRAY_BUFFER, 4, memory(&[1u8, 2, 3, 4]), GL_STATIC_DRAW);
        let mapped = glMapBufferARB(GL_ARRAY_BUFFER, GL_WRITE_ONLY);
        mapped.cast::<u8>().write(9);
        glUnmapBufferARB(GL_ARRAY_BUFFER);
        glVertexPointer(4, GL_FLOAT, 0, null::<u8>().wrapping_add(12).cast());
        glDrawArrays(GL_POINTS, 0, 0);
        glUnmapBufferARB(GL_ARRAY_BUFFER);
    }
}

pub const BUFFERS: &[&str] = &[
    "glDisableClientState(array = GL_NORMAL_ARRAY)",
    "glBindBufferARB(target = GL_ARRAY_BUFFER, buffer = 1)",
    "glBindBuffer(target = GL_ARRAY_BUFFER, buffer = 0) // fake",
    "glVertexPointer(size = 3, type = GL_FLOAT, stride = 0, pointer = blob(12)) // fake",
    "glBindBuffer(target = GL_ARRAY_BUFFER, buffer = 1) // fake",
    "glDrawArrays(mode = GL_POINTS, first = 0, count = 1)",
    "glBufferDataARB(target = GL_ARRAY_BUFFER, size = 4, data = blob(4), usage = GL_STATIC_DRAW)",
    "glMapBufferARB(target = GL_ARRAY_BUFFER, access = GL_WRITE_ONLY) = ADDRESS",
    "memcpy(dest = ADDRESS, src = blob(4), n = 4) // fake",
    "glUnmapBufferARB(target = GL_ARRAY_BUFFER) = GL_TRUE",
    "glVertexPointer(size = 4, type = GL_FLOAT, stride = 0, pointer = 0xc)",
    "glDrawArrays(mode = GL_POINTS, first = 0, count = 0)",
    "glUnmapBufferARB(target = GL_ARRAY_BUFFER) = GL_FALSE",
];

/// Without a display there is nothing to be had, but all is recorded.
pub fn window_system() {
    let visual = XVisualInfo { visual: 0x10, visual_id: 33, depth: 24, class: 4, ..XVisualInfo::default() };
    let configuration = 0x20 as *const c_void;
    let (mut major, mut minor, mut count, mut value) = (0, 0, 5, 7);
    // SAFETY: lists end with zero, results have their places, and the display may be null.
    unsafe {
        glXQueryVersion(null_mut(), &mut major, &mut minor);
        glXGetClientString(null_mut(), GLX_VERSION);
        glXChooseVisual(null_mut(), 0, [4, 5, 8, 1, 0].as_ptr());
        glXChooseFBConfig(null_mut(), 0, [0x8011, 1, 5, 1, 3, -1, 0].as_ptr(), &mut count);
        glXGetFBConfigAttrib(null_mut(), configuration, 12, &mut value);
        glXCreateContext(null_mut(), &visual, null_mut(), 1);
        glXCreateWindow(null_mut(), configuration, 7, null());
        record::glx::drawable_size(64, 48);
        glXSwapBuffers(null_mut(), 7);
    }
}

const GLX_VERSION: i32 = 2;

pub const WINDOW_SYSTEM: &[&str] = &[
    "glXQueryVersion(dpy = NULL, maj = &1, min = &4) = True",
    "glXGetClientString(dpy = NULL, name = GLX_VERSION) = \"1.4\"",
    "glXChooseVisual(dpy = NULL, screen = 0, attribList = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 1, 0}) = NULL",
    "glXChooseFBConfig(dpy = NULL, screen = 0, attribList = {GLX_RENDER_TYPE, GLX_RGBA_BIT, GLX_DOUBLEBUFFER, True, \
     GLX_LEVEL, -1, 0}, nitems = &0) = NULL",
    "glXGetFBConfigAttrib(dpy = NULL, config = 0x20, attribute = GLX_DEPTH_SIZE, value = &7) = 2",
    "glXCreateContext(dpy = NULL, vis = &{visual = 0x10, visualid = 33, screen = 0, depth = 24, c_class = 4, \
     red_mask = 0, green_mask = 0, blue_mask = 0, colormap_size = 0, bits_per_rgb = 0}, shareList = NULL, direct = True) \
     = NULL",
    "glXCreateWindow(dpy = NULL, config = 0x20, win = 7, attribList = {}) = 0",
    "glViewport(x = 0, y = 0, width = 64, height = 48) // fake",
    "glScissor(x = 0, y = 0, width = 64, height = 48) // fake",
    "glXSwapBuffers(dpy = NULL, drawable = 7)",
];
