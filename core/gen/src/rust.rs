//! Bits of Rust text.

/// What opens each generated file of Rust.
pub const NOTICE: &str = "// Written by afterglow-gen (./x gen) from the Khronos XML and manifests/gl-behaviours.toml; not to be edited.\n";

/// A list as text: `&[1, 2]`.
pub fn slice(items: impl IntoIterator<Item = String>) -> String {
    format!("&[{}]", items.into_iter().collect::<Vec<_>>().join(", "))
}
