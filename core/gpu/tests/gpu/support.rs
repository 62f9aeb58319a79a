//! A device under validation, and a compiler for the shaders of these tests.

use std::io::Write;
use std::ops::Deref;
use std::process::{Command, Stdio};

use afterglow_gpu::{Gpu, GpuOptions};

/// A device of which every test asserts, at its end, that validation had nothing to say.
pub struct CheckedGpu(pub Gpu);

impl CheckedGpu {
    pub fn new() -> Self {
        Self(Gpu::new(&GpuOptions::for_tests()).expect("`./x setup` installs lavapipe and the layer"))
    }
}

impl Deref for CheckedGpu {
    type Target = Gpu;

    fn deref(&self) -> &Gpu {
        &self.0
    }
}

impl Drop for CheckedGpu {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            assert_eq!(self.0.validation_messages(), Vec::<String>::new());
        }
    }
}

/// Compiles GLSL with `glslc`.
pub fn compile(stage: &str, source: &str) -> Vec<u32> {
    let mut compiler = Command::new("glslc")
        .arg(format!("-fshader-stage={stage}"))
        .args(["--target-env=vulkan1.2", "-o", "-", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("`./x setup` installs glslc");
    compiler.stdin.take().unwrap().write_all(source.as_bytes()).unwrap();
    let output = compiler.wait_with_output().unwrap();
    assert!(output.status.success(), "glslc refused the shader");
    output.stdout.chunks_exact(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect()
}

pub fn words(bytes: &[u8]) -> Vec<u32> {
    bytes.chunks_exact(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect()
}
