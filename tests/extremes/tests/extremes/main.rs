//! The whole renderer on lavapipe, under validation: one program, so that the device is opened once.
#![allow(clippy::unwrap_used, reason = "tests")]

mod closed_forms;
mod lights;
mod materials;
mod memory;
mod places;
mod triangles;
mod views;
