//! Recording and submitting commands, one recording at a time.

use std::ops::Deref;
use std::thread::ThreadId;

use ash::vk;
use parking_lot::{Mutex, MutexGuard};

use crate::error::{Doing, GpuError};
use crate::gpu::{Gpu, Shared};

/// Recordings that may be in flight; the next one waits for the oldest.
const IN_FLIGHT: usize = 4;

/// A submission, to be waited for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Submission(u64);

struct Slot {
    pool: vk::CommandPool,
    buffer: vk::CommandBuffer,
    /// The submission that used the slot last.
    submission: u64,
}

struct Ring {
    slots: Vec<Slot>,
    next: usize,
}

/// The command pools of a device, used in turn.
pub(crate) struct Recorder {
    ring: Mutex<Ring>,
    /// The thread that is recording.
    owner: Mutex<Option<ThreadId>>,
}

impl Recorder {
    pub(crate) fn new(device: &ash::Device, queue_family: u32) -> Result<Self, GpuError> {
        let slots = (0..IN_FLIGHT).map(|_| Slot::new(device, queue_family)).collect::<Result<_, _>>()?;
        Ok(Self { ring: Mutex::new(Ring { slots, next: 0 }), owner: Mutex::new(None) })
    }

    /// # Safety
    /// The device must be idle, and this must be called once.
    pub(crate) unsafe fn destroy(&self, device: &ash::Device) {
        for slot in self.ring.lock().slots.drain(..) {
            // SAFETY: upheld by the caller.
            unsafe { device.destroy_command_pool(slot.pool, None) };
        }
    }
}

impl Slot {
    fn new(device: &ash::Device, queue_family: u32) -> Result<Self, GpuError> {
        let info = vk::CommandPoolCreateInfo::default()
            .queue_family_index(queue_family)
            .flags(vk::CommandPoolCreateFlags::TRANSIENT);
        // SAFETY: the queue family is one of the device's.
        let pool = unsafe { device.create_command_pool(&info, None) }.doing("create a command pool")?;
        let info = vk::CommandBufferAllocateInfo::default()
            .command_pool(pool)
            .level(vk::CommandBufferLevel::PRIMARY)
            .command_buffer_count(1);
        // SAFETY: the pool was just made.
        let buffers = unsafe { device.allocate_command_buffers(&info) }.doing("allocate a command buffer")?;
        Ok(Self { pool, buffer: buffers[0], submission: 0 })
    }
}

impl Gpu {
    /// Begins a recording. It waits while another thread records; a thread that is recording already gets
    /// [`GpuError::NestedRecording`].
    pub fn record(&self) -> Result<Recording<'_>, GpuError> {
        let recorder = &self.shared.recorder;
        let this_thread = std::thread::current().id();
        if *recorder.owner.lock() == Some(this_thread) {
            return Err(GpuError::NestedRecording);
        }
        let ring = recorder.ring.lock();
        let (buffer, pool, last) = {
            let slot = &ring.slots[ring.next];
            (slot.buffer, slot.pool, slot.submission)
        };
        let device = &self.shared.device;
        self.shared.health.guard(|| self.shared.timeline.wait(device, last))?;
        self.collect()?;
        let info = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the pool's only buffer is not in use: the device has finished its last submission.
        unsafe {
            device
                .reset_command_pool(pool, vk::CommandPoolResetFlags::empty())
                .doing("reset a command pool")?;
            device.begin_command_buffer(buffer, &info).doing("begin a command buffer")?;
        }
        *recorder.owner.lock() = Some(this_thread);
        Ok(Recording {
            commands: Commands { shared: &self.shared, raw: buffer },
            value: self.shared.timeline.claim(),
            ring,
            submitted: false,
        })
    }

    /// Records with `record` and submits.
    pub fn submit(&self, record: impl FnOnce(&Commands<'_>)) -> Result<Submission, GpuError> {
        let recording = self.record()?;
        record(&recording);
        recording.submit()
    }

    /// Records, submits and waits.
    pub fn run(&self, record: impl FnOnce(&Commands<'_>)) -> Result<(), GpuError> {
        let submission = self.submit(record)?;
        self.wait(submission)
    }

    /// Waits until the device has finished `submission`.
    pub fn wait(&self, submission: Submission) -> Result<(), GpuError> {
        let shared = &self.shared;
        shared.health.guard(|| shared.timeline.wait(&shared.device, submission.0))?;
        self.collect()
    }

    /// Whether the device has finished `submission`.
    pub fn is_finished(&self, submission: Submission) -> Result<bool, GpuError> {
        Ok(self.shared.completed()? >= submission.0)
    }

    /// Waits for everything that was submitted.
    pub fn wait_idle(&self) -> Result<(), GpuError> {
        self.wait(Submission(self.shared.timeline.submitted()))
    }

    /// Destroys what was dropped and is no longer in use. Recording and waiting do this by themselves.
    pub fn collect(&self) -> Result<(), GpuError> {
        let completed = self.shared.completed()?;
        self.shared.garbage.collect(&self.shared, completed);
        Ok(())
    }

    /// How many dropped things still wait for the device.
    pub fn garbage_count(&self) -> usize {
        self.shared.garbage.len()
    }
}

/// Commands on their way to the device. Dropped without being submitted, they are thrown away.
pub struct Recording<'g> {
    commands: Commands<'g>,
    ring: MutexGuard<'g, Ring>,
    value: u64,
    submitted: bool,
}

impl<'g> Deref for Recording<'g> {
    type Target = Commands<'g>;

    fn deref(&self) -> &Self::Target {
        &self.commands
    }
}

impl Recording<'_> {
    /// Gives the commands to the device.
    pub fn submit(self) -> Result<Submission, GpuError> {
        self.submit_with(&[], &[])
    }

    /// Gives the commands to the device; it waits for and signals these semaphores too, as windows need it.
    pub fn submit_with(
        mut self,
        wait: &[vk::SemaphoreSubmitInfo<'_>],
        signal: &[vk::SemaphoreSubmitInfo<'_>],
    ) -> Result<Submission, GpuError> {
        let shared = self.commands.shared;
        // SAFETY: the buffer is being recorded, by this recording alone.
        unsafe { shared.device.end_command_buffer(self.commands.raw) }.doing("end a command buffer")?;
        let mut signals = signal.to_vec();
        signals.push(
            vk::SemaphoreSubmitInfo::default()
                .semaphore(shared.timeline.semaphore)
                .value(self.value)
                .stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS),
        );
        let buffers = [vk::CommandBufferSubmitInfo::default().command_buffer(self.commands.raw)];
        let submits = [vk::SubmitInfo2::default()
            .wait_semaphore_infos(wait)
            .command_buffer_infos(&buffers)
            .signal_semaphore_infos(&signals)];
        shared.queue_submit(&submits)?;
        shared.timeline.commit(self.value);
        let next = self.ring.next;
        self.ring.slots[next].submission = self.value;
        self.ring.next = (next + 1) % IN_FLIGHT;
        self.submitted = true;
        Ok(Submission(self.value))
    }
}

impl Drop for Recording<'_> {
    fn drop(&mut self) {
        if !self.submitted {
            self.commands.shared.timeline.abandon();
        }
        *self.commands.shared.recorder.owner.lock() = None;
    }
}

impl Shared {
    fn queue_submit(&self, submits: &[vk::SubmitInfo2<'_>]) -> Result<(), GpuError> {
        let queue = self.queue.lock();
        // SAFETY: the queue is locked, and what is submitted was recorded to the end.
        self.health.guard_submission(|| unsafe {
            match &self.synchronization2 {
                Some(functions) => functions.queue_submit2(*queue, submits, vk::Fence::null()),
                None => self.device.queue_submit2(*queue, submits, vk::Fence::null()),
            }
            .doing("submit commands")
        })
    }

    /// The value of the last submission that the device has finished.
    fn completed(&self) -> Result<u64, GpuError> {
        self.health.guard(|| self.timeline.completed(&self.device))
    }
}

/// A command buffer that is being recorded. What it has no words for goes through [`Commands::raw`].
///
/// Resources may be dropped while their use is being recorded: they live until the device has finished.
#[derive(Clone, Copy)]
pub struct Commands<'g> {
    pub(crate) shared: &'g Shared,
    raw: vk::CommandBuffer,
}

impl Commands<'_> {
    pub fn raw(&self) -> vk::CommandBuffer {
        self.raw
    }

    pub fn device(&self) -> &ash::Device {
        &self.shared.device
    }

    /// Names a run of commands in debuggers and in the validation layer's messages.
    pub fn labelled<T>(&self, name: &std::ffi::CStr, record: impl FnOnce() -> T) -> T {
        let Some(functions) = &self.shared.debug_utils else {
            return record();
        };
        let label = vk::DebugUtilsLabelEXT::default().label_name(name);
        // SAFETY: the buffer is being recorded; begin and end come in pairs.
        unsafe { functions.cmd_begin_debug_utils_label(self.raw, &label) };
        let result = record();
        // SAFETY: as above.
        unsafe { functions.cmd_end_debug_utils_label(self.raw) };
        result
    }
}
