//! The device at work: on lavapipe, under validation.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod bindless;
mod choice;
mod compute;
mod images;
mod lifetimes;
mod rays;
mod support;
mod validation;
