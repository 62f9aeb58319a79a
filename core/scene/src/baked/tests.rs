//! Tests of baked light.
