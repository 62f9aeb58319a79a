//! The program that is measured: typical calls of old games, with whatever libGL is found.

use std::collections::BTreeMap;
use std::ffi::c_void;
use std::hint::black_box;
use std::time::Instant;

use clap::Args;
use serde::{Deserialize, Serialize};

use super::xlib::Stage;
use crate::failure::Failure;
use crate::output;

const TRIANGLES: u32 = 4;
const COMPILE: u32 = 0x1300;
const FLOAT: u32 = 0x1406;
const UNSIGNED_BYTE: u32 = 0x1401;
const RGBA: u32 = 0x1908;
const TEXTURE_2D: u32 = 0x0de1;
const ARRAY_BUFFER: u32 = 0x8892;
const STATIC_DRAW: u32 = 0x88e4;
const VERTEX_ARRAY: u32 = 0x8074;
const BLEND: u32 = 0x0be2;
const LINEAR: i32 = 0x2601;

/// Vertices of arrays and buffers, three floats each.
const VERTICES: usize = 24_000;
/// Texels along a side.
const SIDE: usize = 256;

/// What a case is compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Yardstick {
    /// Mesa's front end.
    Mesa,
    /// Copying the same bytes.
    Copy,
}

/// What is measured.
pub struct Case {
    pub name: &'static str,
    pub yardstick: Yardstick,
    /// The case that copies as many bytes.
    pub copy: &'static str,
    /// Least ratio that would satisfy.
    pub goal: f64,
}

const fn case(name: &'static str, goal: f64) -> Case {
    Case { name, yardstick: Yardstick::Mesa, copy: "", goal }
}

const fn copying(name: &'static str, copy: &'static str, goal: f64) -> Case {
    Case { name, yardstick: Yardstick::Copy, copy, goal }
}

/// All cases, in order.
pub const CASES: [Case; 7] = [
    case("glColor4f", 0.5),
    case("glColor4f + glVertex3f", 0.5),
    case("state changes", 0.5),
    case("list of 3000 vertices", 1.0),
    case("buffer of 24000 vertices", 1.0),
    copying("array of 24000 vertices", "memcpy of the array", 1.2),
    copying("glTexSubImage2D 256x256", "memcpy of the texels", 1.2),
];

/// The case that calls a function that does nothing: the part of each call that no library can save.
pub const EMPTY_CALL: &str = "an empty call";

/// Nanoseconds a call, by case.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Figures(BTreeMap<String, f64>);

impl Figures {
    /// The figure of a case; NaN if it was not measured.
    pub fn of(&self, name: &str) -> f64 {
        self.0.get(name).copied().unwrap_or(f64::NAN)
    }

    /// Takes over what is less in another run.
    pub fn keep_least(&mut self, other: &Figures) {
        for (name, ns) in &other.0 {
            let least = self.0.entry(name.clone()).or_insert(*ns);
            *least = least.min(*ns);
        }
    }
}

/// Arguments of `bench gl-client`.
#[derive(Debug, Args)]
pub struct Arguments {}

/// Runs `bench gl-client`.
pub fn run(_: &Arguments) -> Result<(), Failure> {
    let stage = Stage::open()?;
    // SAFETY: the functions have OpenGL's types.
    let client = unsafe { Client::new(&stage)? };
    let figures = client.measure();
    output::write_json("-".as_ref(), &figures)
}

macro_rules! functions {
    ($($field:ident = $name:literal ($($type:ty),*);)*) => {
        /// The functions that are called.
        struct Client<'a> {
            stage: &'a Stage,
            $($field: unsafe extern "C" fn($($type),*),)*
        }

        impl<'a> Client<'a> {
            /// # Safety
            /// The stage's library must be a libGL.
            unsafe fn new(stage: &'a Stage) -> Result<Self, Failure> {
                // SAFETY: these are the types of the functions of these names.
                unsafe { Ok(Self { stage, $($field: stage.function($name)?,)* }) }
            }
        }
    };
}

functions! {
    color = c"glColor4f" (f32, f32, f32, f32);
    vertex = c"glVertex3f" (f32, f32, f32);
    begin = c"glBegin" (u32);
    end = c"glEnd" ();
    enable = c"glEnable" (u32);
    disable = c"glDisable" (u32);
    blend_func = c"glBlendFunc" (u32, u32);
    bind_texture = c"glBindTexture" (u32, u32);
    new_list = c"glNewList" (u32, u32);
    end_list = c"glEndList" ();
    call_list = c"glCallList" (u32);
    bind_buffer = c"glBindBufferARB" (u32, u32);
    buffer_data = c"glBufferDataARB" (u32, isize, *const c_void, u32);
    vertex_pointer = c"glVertexPointer" (i32, u32, i32, *const c_void);
    enable_array = c"glEnableClientState" (u32);
    draw_arrays = c"glDrawArrays" (u32, i32, i32);
    tex_image = c"glTexImage2D" (u32, i32, i32, i32, i32, i32, u32, u32, *const c_void);
    tex_sub_image = c"glTexSubImage2D" (u32, i32, i32, i32, i32, i32, u32, u32, *const c_void);
    tex_parameter = c"glTexParameteri" (u32, u32, i32);
}

impl Client<'_> {
    /// Nanoseconds a call of `work`, called `batch` times a frame: the least of several frames.
    fn time(&self, batch: u32, mut work: impl FnMut()) -> f64 {
        let mut least = f64::INFINITY;
        for frame in 0..24 {
            let begun = Instant::now();
            (0..batch).for_each(|_| work());
            let ns = begun.elapsed().as_nanos() as f64 / f64::from(batch);
            self.stage.swap_buffers();
            // The first frames make memory that later ones use again.
            if frame >= 4 {
                least = least.min(ns);
            }
        }
        least
    }

    fn measure(&self) -> Figures {
        let mut figures = Figures::default();
        let mut add = |name: &str, ns: f64| {
            figures.0.insert(name.to_owned(), ns);
        };
        let empty = black_box(nothing as extern "C" fn(f32, f32, f32, f32));
        add(EMPTY_CALL, self.time(100_000, || empty(black_box(0.5), 0.25, 1.0, 1.0)));
        // SAFETY: a context is current; pointers point to as much as the calls read.
        unsafe {
            add("glColor4f", self.time(100_000, || (self.color)(black_box(0.5), 0.25, 1.0, 1.0)));
            (self.begin)(TRIANGLES);
            (self.end)();
            let immediate = self.time(1000, || {
                (self.begin)(TRIANGLES);
                for i in 0..30 {
                    (self.color)(0.5, black_box(i as f32), 1.0, 1.0);
                    (self.vertex)(black_box(i as f32), 1.0, 2.0);
                }
                (self.end)();
            });
            add("glColor4f + glVertex3f", immediate / 30.0);
            add("state changes", self.states());
            self.list();
            add("list of 3000 vertices", self.time(1000, || (self.call_list)(1)));
            let positions = vec![0.25_f32; VERTICES * 3];
            let bytes = std::mem::size_of_val(&positions[..]);
            (self.enable_array)(VERTEX_ARRAY);
            (self.bind_buffer)(ARRAY_BUFFER, 1);
            (self.buffer_data)(ARRAY_BUFFER, bytes as isize, positions.as_ptr().cast(), STATIC_DRAW);
            (self.vertex_pointer)(3, FLOAT, 0, std::ptr::null());
            let draw = || (self.draw_arrays)(TRIANGLES, 0, VERTICES as i32);
            add("buffer of 24000 vertices", self.time(1000, draw));
            (self.bind_buffer)(ARRAY_BUFFER, 0);
            (self.vertex_pointer)(3, FLOAT, 0, positions.as_ptr().cast());
            add("array of 24000 vertices", self.time(100, draw));
            let texels = vec![0x55_u8; SIDE * SIDE * 4];
            self.texture(&texels);
            let update = || {
                let side = SIDE as i32;
                (self.tex_sub_image)(
                    TEXTURE_2D,
                    0,
                    0,
                    0,
                    side,
                    side,
                    RGBA,
                    UNSIGNED_BYTE,
                    texels.as_ptr().cast(),
                );
            };
            add("glTexSubImage2D 256x256", self.time(100, update));
            add("memcpy of the array", copy_time(bytes, 100));
            add("memcpy of the texels", copy_time(texels.len(), 100));
        }
        figures
    }

    /// Four changes that mean something between draws of one triangle; a change's share.
    unsafe fn states(&self) -> f64 {
        // SAFETY: as in `measure`.
        let ns = self.time(2000, || unsafe {
            (self.enable)(BLEND);
            (self.blend_func)(1, 1);
            (self.begin)(TRIANGLES);
            (0..3).for_each(|_| (self.vertex)(0.0, 0.0, 0.0));
            (self.end)();
            (self.disable)(BLEND);
            (self.bind_texture)(TEXTURE_2D, 0);
            (self.begin)(TRIANGLES);
            (0..3).for_each(|_| (self.vertex)(0.0, 0.0, 0.0));
            (self.end)();
        });
        ns / 4.0
    }

    unsafe fn list(&self) {
        // SAFETY: as in `measure`.
        unsafe {
            (self.new_list)(1, COMPILE);
            (self.begin)(TRIANGLES);
            for i in 0..3000 {
                (self.color)(0.5, i as f32, 1.0, 1.0);
                (self.vertex)(i as f32, 1.0, 2.0);
            }
            (self.end)();
            (self.end_list)();
        }
    }

    unsafe fn texture(&self, texels: &[u8]) {
        let side = SIDE as i32;
        // SAFETY: as in `measure`.
        unsafe {
            (self.bind_texture)(TEXTURE_2D, 7);
            (self.tex_parameter)(TEXTURE_2D, 0x2801, LINEAR);
            let pixels = texels.as_ptr().cast();
            (self.tex_image)(TEXTURE_2D, 0, RGBA as i32, side, side, 0, RGBA, UNSIGNED_BYTE, pixels);
        }
    }
}

extern "C" fn nothing(_: f32, _: f32, _: f32, _: f32) {}

/// Nanoseconds to copy so many bytes to memory that is not in a cache: each copy of a batch has its own place.
fn copy_time(bytes: usize, batch: usize) -> f64 {
    let source = vec![1_u8; bytes];
    // Places that are apart by a power of two would share the same few lines of the cache.
    let pitch = bytes + 4096 + 64;
    let mut target = vec![0_u8; pitch * batch];
    let mut least = f64::INFINITY;
    for _ in 0..10 {
        let begun = Instant::now();
        for place in target.chunks_exact_mut(pitch) {
            place[..bytes].copy_from_slice(black_box(&source));
        }
        least = least.min(begun.elapsed().as_nanos() as f64 / batch as f64);
        black_box(&mut target);
    }
    least
}
