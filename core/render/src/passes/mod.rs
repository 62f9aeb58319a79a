//! The passes: each declares nothing but what it records.

pub(crate) mod accumulate;
pub(crate) mod build;
pub(crate) mod clear;
pub(crate) mod composite;
pub(crate) mod copy;
pub(crate) mod edges;
pub(crate) mod exposure;
pub(crate) mod light;
pub(crate) mod pixels;
pub(crate) mod raster;
pub(crate) mod readback;
pub(crate) mod reference;
pub(crate) mod reservoir;
pub(crate) mod sky;
pub(crate) mod surface;
pub(crate) mod transfers;
