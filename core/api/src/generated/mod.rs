//! Written by `afterglow-gen`, all but this file.

#[rustfmt::skip]
pub mod commands;
#[rustfmt::skip]
#[expect(non_upper_case_globals, reason = "the names are those of the C headers")]
pub mod constants;
#[rustfmt::skip]
pub mod enum_names;
#[rustfmt::skip]
#[expect(non_upper_case_globals, reason = "the names are those of the commands in C")]
pub mod ids;
