//! The order in which calls are handed out: that in which they were entered.
//!
//! With several threads, a call may be left long after later ones of other threads were. Those wait for it, within
//! bounds; beyond these it is set aside and follows when it is left, or at the end of the trace.

use std::collections::VecDeque;
use std::mem;

use crate::call::Call;
use crate::error::{Damage, Stop};
use crate::format::limits;

/// Calls whose memory is kept for reuse.
const SPARE_CALLS: usize = 16;

/// Calls are boxed because moving a pointer costs less than moving a call.
#[derive(Default)]
pub(super) struct CallOrder {
    /// Calls with consecutive numbers, complete or not.
    queue: VecDeque<Box<Call>>,
    queue_weight: u64,
    /// Calls that the queue waited for too long, still open, by number.
    aside: VecDeque<Box<Call>>,
    aside_weight: u64,
    /// Calls that were set aside and are to be handed out now.
    late: VecDeque<Box<Call>>,
    spare: VecDeque<Box<Call>>,
    closed: bool,
}

impl CallOrder {
    /// Hands out the next call, if it is known, in exchange for a used one.
    #[inline]
    pub fn take(&mut self, call: &mut Call) -> bool {
        let next = match self.queue.front() {
            _ if !self.late.is_empty() => self.late.pop_front(),
            Some(front) if front.complete || self.closed => {
                self.queue_weight -= front.weight;
                self.queue.pop_front()
            }
            _ => None,
        };
        let Some(mut next) = next else {
            return false;
        };
        mem::swap(call, &mut next);
        if self.spare.len() < SPARE_CALLS {
            self.spare.push_back(next);
        }
        true
    }

    /// A call to be filled and [pushed](Self::push).
    pub fn spare(&mut self) -> Box<Call> {
        self.spare.pop_back().unwrap_or_default()
    }

    /// Appends a call that was entered.
    pub fn push(&mut self, call: Box<Call>) -> Result<(), Stop> {
        self.queue_weight += call.weight;
        self.queue.push_back(call);
        while self.queue.len() > limits::WINDOW_CALLS
            || self.queue_weight > limits::WINDOW_BYTES && self.queue.len() > 1
        {
            self.set_front_aside()?;
        }
        Ok(())
    }

    fn set_front_aside(&mut self) -> Result<(), Stop> {
        let Some(call) = self.queue.pop_front() else {
            return Ok(());
        };
        self.queue_weight -= call.weight;
        if call.complete {
            self.late.push_back(call);
            return Ok(());
        }
        self.aside_weight += call.weight;
        self.aside.push_back(call);
        let too_many = self.aside.len() > limits::CALLS_ASIDE;
        match too_many || self.aside_weight > limits::BYTES_ASIDE {
            true => Err(Damage::OpenCalls.into()),
            false => Ok(()),
        }
    }

    /// Lets `read` add the details of the leave event of call `number`.
    ///
    /// A call that was left before gets another chance: apitrace reads such traces, too. What it holds is then dropped.
    pub fn leave(
        &mut self,
        number: u32,
        read: impl FnOnce(&mut Call) -> Result<(), Stop>,
    ) -> Result<(), Stop> {
        if let Some(call) = self.open_call(number) {
            let before = call.weight;
            let result = read(call);
            call.complete = result.is_ok();
            self.queue_weight += call.weight - before;
            return result;
        }
        let Some(index) = self.aside.iter().position(|call| call.number == number) else {
            return read(&mut Call::default());
        };
        let before = self.aside[index].weight;
        read(&mut self.aside[index])?;
        self.aside_weight -= before;
        if let Some(mut call) = self.aside.remove(index) {
            call.complete = true;
            self.late.push_back(call);
        }
        Ok(())
    }

    #[inline]
    fn open_call(&mut self, number: u32) -> Option<&mut Call> {
        let first = self.queue.front()?.number;
        let index = number.checked_sub(first)?;
        let call = self.queue.get_mut(index as usize)?;
        (!call.complete).then_some(call)
    }

    /// Declares that no call will be completed any more: all are to be handed out as they are.
    ///
    /// Returns how many are incomplete.
    pub fn close(&mut self) -> u32 {
        self.closed = true;
        self.late.extend(self.aside.drain(..));
        let waiting = self.late.iter().chain(&self.queue);
        waiting.filter(|call| !call.complete).count() as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Enters a call of a given weight.
    fn enter(order: &mut CallOrder, number: u32, weight: u64) -> Result<(), Stop> {
        let mut call = order.spare();
        call.reset(number, 0, Default::default(), 0);
        call.weight = weight;
        order.push(call)
    }

    fn leave(order: &mut CallOrder, number: u32) {
        order.leave(number, |_| Ok(())).unwrap();
    }

    fn taken(order: &mut CallOrder) -> Vec<u32> {
        let mut call = Call::default();
        std::iter::from_fn(|| order.take(&mut call).then_some(call.number)).collect()
    }

    #[test]
    fn calls_wait_for_earlier_ones() {
        let mut order = CallOrder::default();
        for number in 0..3 {
            enter(&mut order, number, 1).unwrap();
        }
        leave(&mut order, 1);
        leave(&mut order, 2);
        assert_eq!(taken(&mut order), []);
        leave(&mut order, 0);
        assert_eq!(taken(&mut order), [0, 1, 2]);
        assert_eq!(order.queue_weight, 0);
    }

    #[test]
    fn a_call_that_is_not_left_in_time_is_set_aside() {
        let mut order = CallOrder::default();
        enter(&mut order, 0, 5).unwrap();
        for number in 1..=limits::WINDOW_CALLS as u32 {
            enter(&mut order, number, 0).unwrap();
            leave(&mut order, number);
        }
        assert_eq!(taken(&mut order).len(), limits::WINDOW_CALLS);
        leave(&mut order, 0);
        assert_eq!(taken(&mut order), [0]);
        assert_eq!((order.queue_weight, order.aside_weight), (0, 0));
    }

    #[test]
    fn waiting_calls_are_bounded_in_bytes() {
        let mut order = CallOrder::default();
        enter(&mut order, 0, 1).unwrap();
        enter(&mut order, 1, limits::WINDOW_BYTES).unwrap();
        leave(&mut order, 1);
        assert_eq!(taken(&mut order), [1]);
        assert_eq!(order.close(), 1);
        assert_eq!(taken(&mut order), [0]);
    }

    #[test]
    fn calls_that_are_never_left_are_bounded() {
        let mut order = CallOrder::default();
        let limit = (limits::WINDOW_CALLS + limits::CALLS_ASIDE) as u32;
        for number in 0..limit {
            enter(&mut order, number, 0).unwrap();
        }
        let result = enter(&mut order, limit, 0);
        assert!(matches!(result, Err(Stop::Damage(Damage::OpenCalls))));
        assert_eq!(order.close(), limit + 1);
        assert!(taken(&mut order).into_iter().eq(0..=limit));
    }
}
