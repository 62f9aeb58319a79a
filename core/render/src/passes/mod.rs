//! The passes: each declares nothing but what it records.

pub(crate) mod accumulate;
pub(crate) mod clear;
pub(crate) mod copy;
pub(crate) mod pixels;
pub(crate) mod raster;
pub(crate) mod readback;
pub(crate) mod transfers;
