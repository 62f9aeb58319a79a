//! Scenes written by hand, staged, and damaged.

mod damaged;
mod sample;
mod staged;
