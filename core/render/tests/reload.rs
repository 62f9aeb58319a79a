//! Shaders that change while a program draws.

#![allow(clippy::unwrap_used, reason = "what cannot go on is to fail loudly")]

use std::path::Path;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use afterglow_api::constants::GL_COLOR_BUFFER_BIT;
use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::Frame;
use afterglow_gl::{Context, SharedNames};
use afterglow_gpu::{Gpu, GpuOptions};
use afterglow_render::{RenderOptions, Renderer};

/// A renderer that is looked at while a context draws with it.
struct Shared(Arc<Mutex<Renderer>>);

impl Backend for Shared {
    fn submit(&mut self, frame: Frame, end: End) {
        self.0.lock().unwrap().submit(frame, end);
    }

    fn answer(&mut self, so_far: Frame, request: Request) -> Reply {
        self.0.lock().unwrap().answer(so_far, request)
    }
}

fn copy_folder(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy_folder(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).unwrap();
        }
    }
}

#[test]
fn changed_shaders_are_drawn_with_and_broken_ones_are_not() {
    let folder = tempfile::tempdir().unwrap();
    let shaders = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shaders");
    for part in ["pass", "include"] {
        copy_folder(&shaders.join(part), &folder.path().join(part));
    }
    // SAFETY: this is the only test of its process, and no other thread runs yet that asks for variables.
    unsafe { std::env::set_var("AFTERGLOW_SHADERS", folder.path()) };
    let gpu = Gpu::new(&GpuOptions::for_tests()).unwrap();
    let renderer = Renderer::new(&gpu, &RenderOptions::default()).unwrap();
    let renderer = Arc::new(Mutex::new(renderer));
    let mut gl = Context::new(Box::new(Shared(renderer.clone())), SharedNames::default());
    gl.set_drawable(4, 4);
    let mut drawn = || {
        std::thread::sleep(Duration::from_millis(1100));
        gl.clear(GL_COLOR_BUFFER_BIT);
        gl.color([0.0, 0.0, 1.0, 1.0]);
        gl.rect([-1.0, -1.0], [1.0, 1.0]);
        gl.swap_buffers();
        <[u8; 4]>::try_from(&renderer.lock().unwrap().read_color().unwrap()[..4]).unwrap()
    };
    assert_eq!(drawn(), [0, 0, 255, 255]);
    let fragment = folder.path().join("pass/raster/fragment.glsl");
    let text = std::fs::read_to_string(&fragment).unwrap();
    let red = text.replacen("out_color = color;", "out_color = vec4(1.0, 0.0, 0.0, 1.0);", 1);
    assert_ne!(red, text);
    std::fs::write(&fragment, red).unwrap();
    assert_eq!(drawn(), [255, 0, 0, 255]);
    std::fs::write(&fragment, "no shader").unwrap();
    assert_eq!(drawn(), [255, 0, 0, 255]);
    std::fs::write(&fragment, text).unwrap();
    assert_eq!(drawn(), [0, 0, 255, 255]);
    assert_eq!(gpu.validation_count(), 0, "{:#?}", gpu.validation_messages());
}
