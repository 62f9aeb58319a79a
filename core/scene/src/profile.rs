//! Profiles: what somebody knows of one program, as data, where evidence alone leaves recovery wrong.
//!
//! A profile is a TOML file (`parse`) of rules (`rules`) that override what recovery found in a frame (`apply`). It
//! holds data only, and recovery depends on none: a program without a profile is the usual case, and a profile without
//! rules changes nothing. Those in `manifests/apps` are part of the library and are found by the program's name
//! (`choose`). `docs/profiles.md` tells of all keys.

mod apply;
mod choose;
mod parse;
mod rules;

pub use choose::{ProfileChoice, shipped};
pub use parse::ProfileError;
pub use rules::Profile;

pub(crate) use apply::{Evidence, Overrides};
