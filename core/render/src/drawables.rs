//! Several drawables of one renderer: one is selected, the others wait.

use afterglow_gpu::{GpuError, Overlay, Presented, Swapchain};

use crate::error::RenderError;
use crate::graph::last_use;
use crate::passes::accumulate::Accumulator;
use crate::pathtrace::Tracer;
use crate::renderer::Renderer;
use crate::target::Target;

/// What belongs to one drawable, while another one is selected.
pub(crate) struct Seat {
    target: Target,
    accumulator: Accumulator,
    pub(crate) tracer: Option<Tracer>,
    swaps: u64,
}

/// What a drawable shows, on its way from one renderer to another of the same device.
pub struct Carried {
    target: Target,
    accumulator: Accumulator,
    swaps: u64,
}

impl Renderer {
    /// Chooses what is drawn to, by a number that the caller gives out (not 0). The first choice is the window that the
    /// renderer was made with; a new number is a window of one pixel that the next frame resizes.
    ///
    /// # Errors
    /// If the device fails; then nothing has changed.
    pub fn select(&mut self, drawable: u64) -> Result<(), RenderError> {
        if self.drawable == drawable {
            return Ok(());
        }
        if self.drawable == 0 {
            self.drawable = drawable;
            return Ok(());
        }
        let seat = match self.seats.remove(&drawable) {
            Some(seat) => seat,
            None => self.new_seat()?,
        };
        let former = std::mem::replace(&mut self.drawable, drawable);
        let seat = Seat {
            target: std::mem::replace(&mut self.target, seat.target),
            accumulator: std::mem::replace(&mut self.accumulator, seat.accumulator),
            tracer: std::mem::replace(&mut self.tracer, seat.tracer),
            swaps: std::mem::replace(&mut self.swaps, seat.swaps),
        };
        self.seats.insert(former, seat);
        Ok(())
    }

    /// Gives back what a drawable has on the device. Its number may come again, as another one.
    pub fn forget(&mut self, drawable: u64) {
        if let Some(buffers) =
            self.seats.remove(&drawable).and_then(|seat| seat.tracer).and_then(|tracer| tracer.buffers)
        {
            buffers.release(&self.table);
        }
        if self.drawable == drawable {
            // The next one that is selected takes its images over.
            self.drawable = 0;
        }
    }

    /// Gives away what a drawable shows. Nothing if it is not known here, or the device fails.
    pub fn give_up(&mut self, drawable: u64) -> Option<Carried> {
        if self.drawable != drawable && !self.seats.contains_key(&drawable) {
            return None;
        }
        let emptied = self.select(drawable).and_then(|()| {
            self.settle()?;
            Ok(Carried {
                target: std::mem::replace(&mut self.target, Target::new(&self.gpu, [1, 1])?),
                accumulator: std::mem::replace(&mut self.accumulator, Accumulator::new(&self.gpu)),
                swaps: self.swaps,
            })
        });
        emptied.map_err(|error| tracing::error!("a drawable is lost: {error}")).ok()
    }

    /// Goes on with what a drawable shows.
    ///
    /// # Errors
    /// If the device fails.
    pub fn take_over(&mut self, drawable: u64, carried: Carried) -> Result<(), RenderError> {
        self.select(drawable)?;
        (self.target, self.accumulator, self.swaps) = (carried.target, carried.accumulator, carried.swaps);
        Ok(())
    }

    /// Shows the selected drawable in a window, with `overlay` over it.
    ///
    /// # Errors
    /// If the device fails, or the window is gone.
    pub fn present(
        &mut self,
        swapchain: &mut Swapchain,
        overlay: Option<&Overlay>,
    ) -> Result<Presented, GpuError> {
        use afterglow_frame_graph::{Access, ResourceState};
        let before = last_use(self.target.color_state);
        let mut state = before;
        let presented = swapchain.present(&self.gpu, &self.target.color, &mut state, overlay);
        if state != before {
            self.target.color_state = ResourceState::after(Access::TransferSrc);
        }
        presented
    }

    fn new_seat(&self) -> Result<Seat, RenderError> {
        Ok(Seat {
            target: Target::new(&self.gpu, [1, 1])?,
            accumulator: Accumulator::new(&self.gpu),
            tracer: self.tracer.as_ref().map(|tracer| tracer.beside(&self.gpu)).transpose()?,
            swaps: 0,
        })
    }
}
