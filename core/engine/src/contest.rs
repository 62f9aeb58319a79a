//! Which backend of ray tracing is faster on a device, found while the program plays: each traces some pictures of its first
//! world, and the one whose fastest took less time goes on.

use afterglow_gpu::{DeviceKind, Gpu};
use afterglow_render::{Backend, FrameReport};

/// Pictures that are left out after a change: their structures are new, their shaders too, and reports come late.
const WARM_UP: usize = 6;
/// Pictures that are timed.
const PICTURES: usize = 8;
/// The pass that shoots rays.
const PASS: &str = "light";

/// What to do after a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Turn {
    /// Nothing new.
    Wait,
    /// The next pictures are this one's.
    Try(Backend),
    /// It is over.
    Keep(Backend),
}

/// Times of both backends so far.
#[derive(Debug, Default)]
pub(crate) struct Contest {
    /// The picture that was noted last.
    last: Option<u64>,
    /// Milliseconds of the software backend's pictures, then of the hardware one's.
    software: Vec<f64>,
    hardware: Vec<f64>,
}

impl Contest {
    /// None where there is nothing to choose: a processor that plays the device is slower at its driver's structures, which
    /// are our own kind of work done once more.
    pub(crate) fn on(gpu: &Gpu) -> Option<Self> {
        let is_open = Backend::Hardware.is_on(gpu) && gpu.info().kind != DeviceKind::Cpu;
        is_open.then(Self::default)
    }

    /// Takes note of the last picture that the device has finished, its passes timed.
    pub(crate) fn note(&mut self, report: &FrameReport) -> Turn {
        let has_world = report.traced.is_some_and(|traced| traced.instances > 0 && traced.waiting == 0);
        let light = report.passes.iter().find(|pass| pass.name == PASS && pass.milliseconds > 0.0);
        let Some(light) =
            light.filter(|_| has_world && self.last.replace(report.index) != Some(report.index))
        else {
            return Turn::Wait;
        };
        if self.software.len() < WARM_UP + PICTURES {
            self.software.push(light.milliseconds);
            return match self.software.len() == WARM_UP + PICTURES {
                true => Turn::Try(Backend::Hardware),
                false => Turn::Wait,
            };
        }
        self.hardware.push(light.milliseconds);
        match self.hardware.len() == WARM_UP + PICTURES {
            true => Turn::Keep(self.winner()),
            false => Turn::Wait,
        }
    }

    fn winner(&self) -> Backend {
        let least = |times: &[f64]| times[WARM_UP..].iter().copied().fold(f64::INFINITY, f64::min);
        let (software, hardware) = (least(&self.software), least(&self.hardware));
        let winner = if hardware < software { Backend::Hardware } else { Backend::Software };
        tracing::info!("rays: {software:.2} ms by software, {hardware:.2} ms by hardware: {winner} it is");
        winner
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afterglow_render::{PassReport, TraceCounts};

    fn report(index: u64, milliseconds: f64) -> FrameReport {
        let traced = TraceCounts { instances: 1, ..TraceCounts::default() };
        let light = PassReport { name: PASS.to_owned(), count: 1, milliseconds };
        FrameReport { index, passes: vec![light], traced: Some(traced), ..FrameReport::default() }
    }

    /// What becomes of pictures that take so long by either backend.
    fn turns(software: f64, hardware: f64) -> Vec<Turn> {
        let mut contest = Contest::default();
        let mut backend = Backend::Software;
        let mut turns = Vec::new();
        for index in 0.. {
            let milliseconds = if backend == Backend::Software { software } else { hardware };
            // Pictures that are asked about again count once.
            assert_eq!(contest.note(&FrameReport::default()), Turn::Wait);
            // Those of a world that is not all there do not count.
            let mut early = report(index, 0.01);
            early.traced.as_mut().unwrap().waiting = 1;
            assert_eq!(contest.note(&early), Turn::Wait);
            let turn = contest.note(&report(index, milliseconds));
            assert!(turn != Turn::Wait || contest.note(&report(index, 0.01)) == Turn::Wait);
            match turn {
                Turn::Wait => continue,
                Turn::Try(other) => backend = other,
                Turn::Keep(_) => {}
            }
            turns.push(turn);
            if matches!(turn, Turn::Keep(_)) {
                break;
            }
        }
        turns
    }

    #[test]
    fn the_faster_one_goes_on() {
        let tried = Turn::Try(Backend::Hardware);
        assert_eq!(turns(2.0, 1.0), [tried, Turn::Keep(Backend::Hardware)]);
        assert_eq!(turns(1.0, 2.0), [tried, Turn::Keep(Backend::Software)]);
    }
}
