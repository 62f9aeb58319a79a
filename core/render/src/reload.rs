//! Pipelines made anew when their shaders change while the program runs: for development.

use std::sync::Arc;

use afterglow_gpu::GpuError;

use crate::passes::copy::Flip;
use crate::pathtrace::TracePipelines;
use crate::renderer::Renderer;

impl Renderer {
    /// Makes the pipelines of shaders that have changed since the last frame. Where one cannot be compiled, or a pipeline
    /// not be made of it, a log line says so and what there was stays.
    pub(crate) fn reload_shaders(&mut self) {
        let Some(reloader) = &mut self.reloader else { return };
        let changes = reloader.poll();
        for error in &changes.errors {
            tracing::error!("{error}");
        }
        if changes.has_new
            && let Err(error) = self.make_pipelines()
        {
            tracing::error!("shaders stay as they were: {error}");
        }
    }

    /// All that is recorded from now on uses the new pipelines; what is in flight keeps the old ones.
    fn make_pipelines(&mut self) -> Result<(), GpuError> {
        let flip = Flip::new(&self.gpu)?;
        self.raster.pipelines.reload()?;
        self.flip = flip;
        let tracers = self.seats.values_mut().filter_map(|seat| seat.tracer.as_mut());
        for tracer in tracers.chain(self.tracer.as_mut()) {
            let backend = tracer.options.backend;
            tracer.pipelines = Arc::new(TracePipelines::new(&self.gpu, &self.table, backend)?);
            tracer.forget();
        }
        Ok(())
    }
}
