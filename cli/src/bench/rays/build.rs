//! What building and refitting cost, and what is built.

use std::time::{Duration, Instant};

use afterglow_bvh::{Blas, Quality, build_blas};
use serde::Serialize;

use super::subject::Subject;
use crate::failure::Failure;

/// A structure is built again while this has not passed, so that small ones are measured too.
pub const LEAST: Duration = Duration::from_millis(200);

/// Figures of a bottom level.
#[derive(Debug, Serialize)]
pub struct BuildRow {
    /// Millions of triangles a second.
    pub fast_mtriangles: f64,
    /// The same of the better tree; none if that was not asked for.
    pub good_mtriangles: Option<f64>,
    /// The same of new boxes in the old tree.
    pub refit_mtriangles: f64,
    /// Bytes on the device.
    pub bytes_a_triangle: f64,
    /// Those of them that are nodes.
    pub node_bytes_a_triangle: f64,
    /// Levels of nodes.
    pub levels: u32,
}

/// Builds in all qualities up to `quality` and refits; returns the best tree.
pub fn measure(subject: &Subject, quality: Quality) -> Result<(Blas, BuildRow), Failure> {
    let (positions, indices) = &subject.mesh;
    let count = subject.triangle_count().max(1) as f64;
    let build = |quality| {
        build_blas(positions, indices, quality)
            .map_err(|error| Failure::Check(format!("{}: {error}", subject.name)))
    };
    let (fast, mut blas) = least_time(|| build(Quality::Fast))?;
    let mut good = None;
    if quality == Quality::Good {
        let (seconds, better) = least_time(|| build(Quality::Good))?;
        (good, blas) = (Some(seconds), better);
    }
    let (refit, ()) = least_time(|| {
        blas.refit(positions, |primitive| indices[primitive as usize]);
        Ok(())
    })?;
    let mtriangles = |seconds: f64| count / seconds * 1e-6;
    let row = BuildRow {
        fast_mtriangles: mtriangles(fast),
        good_mtriangles: good.map(mtriangles),
        refit_mtriangles: mtriangles(refit),
        bytes_a_triangle: blas.size_bytes() as f64 / count,
        node_bytes_a_triangle: size_of_val(blas.nodes()) as f64 / count,
        levels: blas.depth,
    };
    Ok((blas, row))
}

/// The least seconds that `make` takes, and what it made.
fn least_time<T>(mut make: impl FnMut() -> Result<T, Failure>) -> Result<(f64, T), Failure> {
    let began = Instant::now();
    let mut least = f64::INFINITY;
    loop {
        let start = Instant::now();
        let made = make()?;
        least = least.min(start.elapsed().as_secs_f64());
        if began.elapsed() >= LEAST {
            return Ok((least, made));
        }
    }
}
