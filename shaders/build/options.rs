//! How shaders are compiled, when the crate is built and when they are compiled anew.

/// Vulkan 1.2 is the least that the renderer asks for; the optimizer shortens what drivers must read.
pub const OPTIONS: [&str; 4] = ["--target-env=vulkan1.2", "-O", "-Werror", "-Iinclude"];
