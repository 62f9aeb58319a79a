//! What is recorded of a program's calls, on a context without a device.
//!
//! One test, since there is one recording a process.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

use std::ffi::c_void;
use std::path::Path;
use std::process::Command;
use std::ptr::{null, null_mut};

use GL::{current, record};
use afterglow_api::constants::*;
use afterglow_api::id;
use afterglow_gl::backend::NullBackend;
use afterglow_gl::{Context, SharedNames};
use afterglow_trace::dump::CallLine;
use afterglow_trace::{Call, TraceReader};
use record::glx::{Value, Visual};

unsafe extern "system" {
    fn glBegin(mode: u32);
    fn glEnd();
    fn glColor4ub(red: u8, green: u8, blue: u8, alpha: u8);
    fn glVertex3f(x: f32, y: f32, z: f32);
    fn glTexCoord2fv(v: *const f32);
    fn glLoadMatrixd(m: *const f64);
    fn glGenTextures(n: i32, textures: *mut u32);
    fn glBindTexture(target: u32, texture: u32);
    fn glTexParameteri(target: u32, pname: u32, param: i32);
    fn glTexEnvfv(target: u32, pname: u32, params: *const f32);
    fn glPixelStorei(pname: u32, param: i32);
    fn glTexImage2D(
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
    fn glGenLists(range: i32) -> u32;
    fn glNewList(list: u32, mode: u32);
    fn glEndList();
    fn glCallLists(n: i32, kind: u32, lists: *const c_void);
    fn glClear(mask: u32);
    fn glGetIntegerv(pname: u32, params: *mut i32);
    fn glGetString(name: u32) -> *const u8;
    fn glGetError() -> u32;
    fn glIsEnabled(cap: u32) -> u8;
    fn glMap1f(target: u32, u1: f32, u2: f32, stride: i32, order: i32, points: *const f32);
    fn glEnableClientState(array: u32);
    fn glDisableClientState(array: u32);
    fn glVertexPointer(size: i32, kind: u32, stride: i32, pointer: *const c_void);
    fn glTexCoordPointer(size: i32, kind: u32, stride: i32, pointer: *const c_void);
    fn glClientActiveTexture(texture: u32);
    fn glInterleavedArrays(format: u32, stride: i32, pointer: *const c_void);
    fn glArrayElement(i: i32);
    fn glDrawArrays(mode: u32, first: i32, count: i32);
    fn glDrawElements(mode: u32, count: i32, kind: u32, indices: *const c_void);
    fn glMultiDrawElements(
        mode: u32,
        count: *const i32,
        kind: u32,
        indices: *const *const c_void,
        draws: i32,
    );
    fn glLockArraysEXT(first: i32, count: i32);
    fn glUnlockArraysEXT();
    fn glBindBufferARB(target: u32, buffer: u32);
    fn glBufferDataARB(target: u32, size: isize, data: *const c_void, usage: u32);
    fn glMapBufferARB(target: u32, access: u32) -> *mut c_void;
    fn glUnmapBufferARB(target: u32) -> u8;
}

/// Numbers as memory.
fn memory<T>(values: &[T]) -> *const c_void {
    values.as_ptr().cast()
}

fn immediate_mode() {
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

const IMMEDIATE_MODE: &[&str] = &[
    "glClear(mask = GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT)",
    "glLoadMatrixd(m = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5})",
    "glBegin(mode = GL_POINTS)",
    "glColor4ub(red = 255, green = 0, blue = 7, alpha = 255)",
    "glTexCoord2fv(v = {0.25, -1})",
    "glVertex3f(x = 1, y = 0, z = -0.5)",
    "glEnd()",
];

fn textures_and_lists() {
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

const TEXTURES_AND_LISTS: &[&str] = &[
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

fn queries() {
    let mut viewport = [0; 4];
    // SAFETY: there is room.
    unsafe {
        glGetIntegerv(GL_VIEWPORT, viewport.as_mut_ptr());
        glGetString(GL_SHADING_LANGUAGE_VERSION_ARB);
        glIsEnabled(GL_LIGHTING);
        glMap1f(GL_MAP1_VERTEX_3, 0.0, 1.0, 3, 2, null());
        glGetError();
    }
}

/// Not in the scope of this library, and so an error.
const GL_SHADING_LANGUAGE_VERSION_ARB: u32 = 0x8b8c;

const QUERIES: &[&str] = &[
    "glGetIntegerv(pname = GL_VIEWPORT, params = {0, 0, 64, 48})",
    "glGetString(name = GL_SHADING_LANGUAGE_VERSION) = NULL",
    "glIsEnabled(cap = GL_LIGHTING) = GL_FALSE",
    "glMap1f(target = GL_MAP1_VERTEX_3, u1 = 0, u2 = 1, stride = 3, order = 2, points = NULL)",
    "glGetError() = GL_INVALID_ENUM",
];

fn arrays_in_memory() {
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

const ARRAYS_IN_MEMORY: &[&str] = &[
    "glEnableClientState(array = GL_VERTEX_ARRAY)",
    "glVertexPointer(size = 3, type = GL_FLOAT, stride = 16, pointer = blob(60)) // fake",
    "glDrawArrays(mode = GL_TRIANGLES, first = 1, count = 3)",
    "glClientActiveTexture(texture = GL_TEXTURE1)",
    "glEnableClientState(array = GL_TEXTURE_COORD_ARRAY)",
    "glClientActiveTexture(texture = GL_TEXTURE0)",
    "glClientActiveTexture(texture = GL_TEXTURE1) // fake",
    "glTexCoordPointer(size = 2, type = GL_FLOAT, stride = 0, pointer = blob(64)) // fake",
    "glVertexPointer(size = 3, type = GL_FLOAT, stride = 16, pointer = blob(124)) // fake",
    "glClientActiveTexture(texture = GL_TEXTURE0) // fake",
    "glDrawElements(mode = GL_TRIANGLES, count = 3, type = GL_UNSIGNED_BYTE, indices = blob(3))",
    "glLockArraysEXT(first = 0, count = 10)",
    "glClientActiveTexture(texture = GL_TEXTURE1) // fake",
    "glTexCoordPointer(size = 2, type = GL_FLOAT, stride = 0, pointer = blob(80)) // fake",
    "glVertexPointer(size = 3, type = GL_FLOAT, stride = 16, pointer = blob(156)) // fake",
    "glClientActiveTexture(texture = GL_TEXTURE0) // fake",
    "glMultiDrawElements(mode = GL_LINES, count = &2, type = GL_UNSIGNED_SHORT, indices = &blob(4), drawcount = 1)",
    "glUnlockArraysEXT()",
    "glBegin(mode = GL_POINTS)",
    "glMultiTexCoord2fv(target = GL_TEXTURE1, v = {0, 0}) // fake",
    "glVertex3fv(v = {0, 0, 0}) // fake",
    "glEnd()",
    "glClientActiveTexture(texture = GL_TEXTURE1)",
    "glDisableClientState(array = GL_TEXTURE_COORD_ARRAY)",
    "glDisableClientState(array = GL_EDGE_FLAG_ARRAY) // fake",
    "glDisableClientState(array = GL_INDEX_ARRAY) // fake",
    "glDisableClientState(array = GL_SECONDARY_COLOR_ARRAY) // fake",
    "glDisableClientState(array = GL_FOG_COORDINATE_ARRAY) // fake",
    "glDisableClientState(array = GL_TEXTURE_COORD_ARRAY) // fake",
    "glDisableClientState(array = GL_COLOR_ARRAY) // fake",
    "glEnableClientState(array = GL_NORMAL_ARRAY) // fake",
    "glEnableClientState(array = GL_VERTEX_ARRAY) // fake",
    "glVertexPointer(size = 3, type = GL_FLOAT, stride = 24, pointer = blob(36)) // fake",
    "glNormalPointer(type = GL_FLOAT, stride = 24, pointer = blob(36)) // fake",
    "glDrawArrays(mode = GL_POINTS, first = 0, count = 2)",
];

fn buffers() {
    // SAFETY: four bytes are mapped.
    unsafe {
        glDisableClientState(GL_NORMAL_ARRAY);
        glBindBufferARB(GL_ARRAY_BUFFER, 1);
        glBufferDataARB(GL_ARRAY_BUFFER, 4, memory(&[1u8, 2, 3, 4]), GL_STATIC_DRAW);
        let mapped = glMapBufferARB(GL_ARRAY_BUFFER, GL_WRITE_ONLY);
        mapped.cast::<u8>().write(9);
        glUnmapBufferARB(GL_ARRAY_BUFFER);
        glVertexPointer(4, GL_FLOAT, 0, null::<u8>().wrapping_add(12).cast());
        glDrawArrays(GL_POINTS, 0, 0);
        glUnmapBufferARB(GL_ARRAY_BUFFER);
    }
}

const BUFFERS: &[&str] = &[
    "glDisableClientState(array = GL_NORMAL_ARRAY)",
    "glBindBufferARB(target = GL_ARRAY_BUFFER, buffer = 1)",
    "glBufferDataARB(target = GL_ARRAY_BUFFER, size = 4, data = blob(4), usage = GL_STATIC_DRAW)",
    "glMapBufferARB(target = GL_ARRAY_BUFFER, access = GL_WRITE_ONLY) = ADDRESS",
    "memcpy(dest = ADDRESS, src = blob(4), n = 4) // fake",
    "glUnmapBufferARB(target = GL_ARRAY_BUFFER) = GL_TRUE",
    "glVertexPointer(size = 4, type = GL_FLOAT, stride = 0, pointer = 0xc)",
    "glDrawArrays(mode = GL_POINTS, first = 0, count = 0)",
    "glUnmapBufferARB(target = GL_ARRAY_BUFFER) = GL_FALSE",
];

fn window_system() {
    let visual = Visual { visual: 0x10, visual_id: 33, depth: 24, class: 4, ..Visual::default() };
    let (display, arguments) = (Value::Pointer(0x20), [4, 5, 8, 1, 0]);
    let attributes = Value::VisualAttributes(Some(&arguments));
    record::glx::call(
        id::glXChooseVisual,
        &[(0, display), (1, Value::Int(0)), (2, attributes)],
        &[],
        Some(Value::Visual(Some(&visual))),
    );
    let made = [(0, display), (1, Value::Id(7)), (2, Value::Pointer(0x30))];
    record::glx::call(id::glXMakeCurrent, &made, &[], Some(Value::Bool(true)));
    record::glx::drawable_size(64, 48);
    record::glx::call(id::glXSwapBuffers, &[(0, display), (1, Value::Id(7))], &[], None);
}

const WINDOW_SYSTEM: &[&str] = &[
    "glXChooseVisual(dpy = 0x20, screen = 0, attribList = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 1, 0}) = \
     &{visual = 0x10, visualid = 33, screen = 0, depth = 24, c_class = 4, red_mask = 0, green_mask = 0, \
     blue_mask = 0, colormap_size = 0, bits_per_rgb = 0}",
    "glXMakeCurrent(dpy = 0x20, drawable = 7, ctx = 0x30) = True",
    "glViewport(x = 0, y = 0, width = 64, height = 48) // fake",
    "glScissor(x = 0, y = 0, width = 64, height = 48) // fake",
    "glXSwapBuffers(dpy = 0x20, drawable = 7)",
];

/// The calls in a file, without their numbers and addresses of this process.
fn lines(path: &Path) -> Vec<String> {
    let mut reader = TraceReader::open(path).unwrap();
    let (mut call, mut lines) = (Call::default(), Vec::new());
    while reader.next_call(&mut call).unwrap() {
        assert!(call.complete);
        let line = CallLine::new(&call, reader.signatures()).to_string();
        let line = line.split_once(' ').unwrap().1;
        let words = line.split(' ').map(|word| match word.trim_end_matches(',') {
            address if address.starts_with("0x") && address.len() > 8 => word.replace(address, "ADDRESS"),
            _ => word.to_owned(),
        });
        lines.push(words.collect::<Vec<_>>().join(" "));
    }
    lines
}

#[test]
fn calls_are_recorded_with_what_they_read_and_give() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("calls.trace");
    record::start(&path).unwrap();
    // SAFETY: no pointers.
    unsafe { glIsEnabled(GL_LIGHTING) };
    let mut context = Context::new(Box::new(NullBackend), SharedNames::default());
    context.set_drawable(64, 48);
    current::set(&mut context);
    for part in [immediate_mode, textures_and_lists, queries, arrays_in_memory, buffers, window_system] {
        part();
    }
    // The swap has brought the file up to date.
    let recorded = lines(&path);
    immediate_mode();
    record::stop();
    immediate_mode();
    current::set(null_mut());

    let parts = [IMMEDIATE_MODE, TEXTURES_AND_LISTS, QUERIES, ARRAYS_IN_MEMORY, BUFFERS, WINDOW_SYSTEM];
    let without_context = ["glIsEnabled(cap = GL_LIGHTING) = GL_FALSE"];
    let expected: Vec<&str> = without_context.into_iter().chain(parts.concat()).collect();
    for (recorded, expected) in recorded.iter().zip(&expected) {
        assert_eq!(recorded, expected);
    }
    assert_eq!(recorded.len(), expected.len());
    assert_eq!(lines(&path).len(), expected.len() + IMMEDIATE_MODE.len());
    check_blobs(&path);
    check_with_apitrace(&path);
}

fn check_blobs(path: &Path) {
    let mut reader = TraceReader::open(path).unwrap();
    let mut call = Call::default();
    let mut found = 0;
    while reader.next_call(&mut call).unwrap() {
        let name = &*reader.signature(call.signature).name;
        let expected: &[u8] = match name {
            "memcpy" => &[9, 2, 3, 4],
            "glBufferDataARB" => &[1, 2, 3, 4],
            "glCallLists" => &[1, 0, 2, 0],
            _ => continue,
        };
        let blob = call.args.iter().find_map(|value| value.as_blob()).unwrap();
        assert_eq!(**blob, *expected, "{name}");
        found += 1;
    }
    assert_eq!(found, 3);
}

/// apitrace's own reader takes the file, if there is one.
fn check_with_apitrace(path: &Path) {
    let Ok(output) = Command::new("apitrace").args(["dump", "--color=never"]).arg(path).output() else {
        return;
    };
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    for line in IMMEDIATE_MODE.iter().chain(TEXTURES_AND_LISTS).chain(WINDOW_SYSTEM) {
        assert!(text.contains(line), "{line}");
    }
}
