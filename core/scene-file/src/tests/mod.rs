//! Scenes written by hand, staged, and damaged.
