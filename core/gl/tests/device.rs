//! What contexts do when the device is lost with all images: they define what they need anew.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use afterglow_api::constants::*;
use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::{Frame, Operation};
use afterglow_gl::texture::ImageDefinition;
use afterglow_gl::{Context, Params, SharedNames};

/// Keeps the last frame, and says which device there is.
#[derive(Clone, Default)]
struct Device {
    last: Arc<Mutex<Frame>>,
    number: Arc<AtomicU64>,
}

impl Device {
    fn lose(&self) {
        self.number.fetch_add(1, Ordering::Relaxed);
    }

    /// The last frame's operations on images, in short, with the device that they are for.
    fn images(&self) -> (u64, Vec<&'static str>) {
        let mut frame = std::mem::take(&mut *self.last.lock().unwrap());
        frame.keep_images();
        let name = |operation: &Operation| match operation {
            Operation::DefineImage { .. } => "define",
            Operation::Upload(upload) if upload.texels.iter().all(|byte| *byte == 0) => "zeros",
            Operation::Upload(_) => "upload",
            Operation::DropImage(_) => "drop",
            other => panic!("{other:?}"),
        };
        (frame.device, frame.operations.iter().map(name).collect())
    }
}

impl Backend for Device {
    fn submit(&mut self, frame: Frame, _: End) {
        *self.last.lock().unwrap() = frame;
    }

    fn answer(&mut self, _: Frame, _: Request) -> Reply {
        Reply::Unavailable
    }

    fn device(&self) -> u64 {
        self.number.load(Ordering::Relaxed)
    }
}

fn context(device: &Device, names: &SharedNames) -> Context {
    let mut gl = Context::new(Box::new(device.clone()), names.clone());
    gl.set_drawable(8, 8);
    gl.enable(GL_TEXTURE_2D);
    gl
}

fn texture(gl: &mut Context, name: u32) {
    let definition = ImageDefinition { level: 0, internal_format: GL_RGBA, size: [1, 1, 1], border: 0 };
    gl.bind_texture(GL_TEXTURE_2D, name);
    gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, Params::Ints(&[GL_NEAREST as i32]));
    gl.tex_image((GL_TEXTURE_2D, 2), definition, (GL_RGBA, GL_UNSIGNED_BYTE), Some(&[1, 2, 3, 4]));
}

fn draw(gl: &mut Context) {
    gl.rect([0.0, 0.0], [1.0, 1.0]);
    gl.swap_buffers();
}

#[test]
fn images_are_defined_anew_once() {
    let (device, names) = (Device::default(), SharedNames::default());
    let mut gl = context(&device, &names);
    texture(&mut gl, 7);
    draw(&mut gl);
    assert_eq!(device.images(), (0, vec!["define", "upload"]));
    device.lose();
    draw(&mut gl);
    assert_eq!(device.images(), (0, vec![]), "begun before the loss");
    draw(&mut gl);
    assert_eq!(device.images(), (1, vec!["drop", "define", "upload"]));
    draw(&mut gl);
    assert_eq!(device.images(), (1, vec![]));
}

#[test]
fn textures_without_a_name_and_without_an_owner_come_back_too() {
    for name in [0, 7] {
        let (device, names) = (Device::default(), SharedNames::default());
        let mut gl = context(&device, &names);
        let mut other = context(&device, &names);
        texture(&mut gl, name);
        draw(&mut gl);
        // From here on texture 7 is only what this context has bound.
        other.delete_textures(&[7]);
        device.lose();
        draw(&mut gl);
        let _ = device.images();
        draw(&mut gl);
        assert_eq!(device.images().1, ["drop", "define", "upload"], "{name}");
    }
}

#[test]
fn contexts_that_share_textures_define_them_once() {
    let (device, names) = (Device::default(), SharedNames::default());
    let mut first = context(&device, &names);
    let mut second = context(&device, &names);
    texture(&mut first, 7);
    draw(&mut first);
    second.bind_texture(GL_TEXTURE_2D, 7);
    draw(&mut second);
    device.lose();
    draw(&mut first);
    draw(&mut first);
    assert_eq!(device.images(), (1, vec!["drop", "define", "upload"]));
    draw(&mut second);
    draw(&mut second);
    assert_eq!(device.images(), (1, vec![]));
    // One that is made only now finds them as they are.
    let mut third = context(&device, &names);
    third.bind_texture(GL_TEXTURE_2D, 7);
    draw(&mut third);
    assert_eq!(device.images(), (1, vec![]));
    // But not if it is the first one after a loss.
    device.lose();
    let mut fourth = context(&device, &names);
    fourth.bind_texture(GL_TEXTURE_2D, 7);
    draw(&mut fourth);
    assert_eq!(device.images(), (2, vec!["drop", "define", "upload"]));
}

#[test]
fn texels_that_were_only_on_the_device_are_zero() {
    let (device, names) = (Device::default(), SharedNames::default());
    let mut gl = context(&device, &names);
    texture(&mut gl, 7);
    gl.copy_tex_sub_image(GL_TEXTURE_2D, 0, [0; 3], 0, 0, 1, 1);
    draw(&mut gl);
    device.lose();
    draw(&mut gl);
    draw(&mut gl);
    assert_eq!(device.images(), (1, vec!["drop", "define", "zeros"]));
}
