//! All keys.

/// Keys of a live program's options. A key of a table stands behind the table's name: `keys.mode` is `keys_mode`.
pub const KEYS: &[&str] = &[
    "antialiasing",
    "asked",
    "backend",
    "baked",
    "bounces",
    "candidates",
    "debug_lose_device",
    "debug_memory",
    "debug_no_windows",
    "denoiser",
    "device",
    "hud",
    "keep",
    "keys",
    "keys_hud",
    "keys_mode",
    "keys_preset",
    "keys_screenshot",
    "keys_view",
    "light_scale",
    "lights",
    "limit",
    "log",
    "memory",
    "mode",
    "preset",
    "profile",
    "replace_images",
    "reuse",
    "screenshots",
    "seed",
    "sky",
    "spp",
    "validation",
    "view",
];

/// The only table.
pub(crate) const TABLE: &str = "keys";

/// Whether there is such an option.
pub fn is_key(name: &str) -> bool {
    KEYS.binary_search(&name).is_ok()
}

/// The environment's variable of a key.
pub fn variable(key: &str) -> String {
    format!("AFTERGLOW_{}", key.to_ascii_uppercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_found() {
        assert!(KEYS.is_sorted() && KEYS.iter().all(|key| is_key(key)));
        assert!(!is_key("Mode") && !is_key(""));
        assert_eq!(variable("keys_mode"), "AFTERGLOW_KEYS_MODE");
    }
}
