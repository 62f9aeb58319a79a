//! Written by `afterglow-gen`, all but this file.

#[rustfmt::skip]
pub mod exports;
#[rustfmt::skip]
pub mod proc_table;
