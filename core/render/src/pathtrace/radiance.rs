//! Linear pictures and their standard errors, read back.

use afterglow_records::{RadianceTexel, TraceCounters};

use super::tracer::Tracer;
use crate::error::RenderError;
use crate::renderer::Renderer;

/// A linear picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Radiance {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Radiance, linear RGB, the highest row first.
    pub mean: Vec<[f32; 3]>,
    /// Standard error of each mean; infinite for less than two samples, 0 where the picture is no mean of independent samples.
    pub standard_error: Vec<[f32; 3]>,
    /// Samples a pixel.
    pub samples: u32,
}

impl Radiance {
    fn of(size: [u32; 2], texels: &[RadianceTexel], samples: u32, is_mean: bool) -> Self {
        let error = |squares: f32| match samples {
            _ if !is_mean => 0.0,
            0 | 1 => f32::INFINITY,
            n => (f64::from(squares.max(0.0)) / (f64::from(n) * f64::from(n - 1))).sqrt() as f32,
        };
        Self {
            size,
            mean: texels.iter().map(|texel| texel.mean).collect(),
            standard_error: texels.iter().map(|texel| texel.squares.map(error)).collect(),
            samples,
        }
    }
}

impl Renderer {
    /// The linear picture of the last frame, if [`PathtraceOptions::keeps_radiance`](crate::PathtraceOptions) asked for
    /// one, or if it was one of a staged scene in [`Mode::Reference`](crate::Mode). Waits for it.
    ///
    /// # Errors
    /// If the device fails.
    pub fn read_radiance(&mut self) -> Result<Option<Radiance>, RenderError> {
        self.finish()?;
        let Some((tracer, buffers)) = self.tracer.as_ref().and_then(with_buffers) else { return Ok(None) };
        let Some(radiance) = buffers.radiance.as_ref().filter(|_| tracer.is_tracing) else { return Ok(None) };
        let bytes = self.gpu.download_buffer(&radiance.buffer)?;
        let texels: Vec<RadianceTexel> = bytemuck::pod_collect_to_vec(&bytes);
        let samples = tracer.history.first().map_or(0, super::change::History::samples);
        Ok(Some(Radiance::of(buffers.size, &texels, samples, tracer.has_camera_rays)))
    }

    /// What light has left out in the last traced frame, and its rays. Waits for it.
    ///
    /// # Errors
    /// If the device fails.
    pub fn read_counters(&mut self) -> Result<TraceCounters, RenderError> {
        self.finish()?;
        let Some((_, buffers)) = self.tracer.as_ref().and_then(with_buffers) else {
            return Ok(bytemuck::Zeroable::zeroed());
        };
        let bytes = self.gpu.download_buffer(&buffers.counters.buffer)?;
        Ok(bytemuck::pod_read_unaligned(&bytes))
    }
}

fn with_buffers(tracer: &Tracer) -> Option<(&Tracer, &super::buffers::ViewBuffers)> {
    Some((tracer, tracer.buffers.as_ref()?))
}
