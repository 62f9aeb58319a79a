//! Written by `afterglow-gen`, all but this file.

#[rustfmt::skip]
pub mod dispatch;
