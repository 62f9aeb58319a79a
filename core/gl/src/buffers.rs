//! Buffer objects (specification 2.9).

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use afterglow_api::constants::*;
use parking_lot::{Mutex, MutexGuard};

use crate::context::Context;
use crate::limits;
use crate::shared::SharedBuffer;

/// A buffer object. Every change gives it a new version, unique in the process.
#[derive(Debug, Default)]
pub struct Buffer {
    /// Draws ask for it without a lock: a program that changes a buffer on another thread meanwhile has to wait for
    /// that itself.
    version: AtomicU64,
    store: Mutex<BufferObject>,
}

impl Buffer {
    /// Changes with the content.
    pub fn version(&self) -> u64 {
        self.version.load(Ordering::Acquire)
    }

    /// The data store.
    pub fn lock(&self) -> MutexGuard<'_, BufferObject> {
        self.store.lock()
    }

    fn touch(&self) {
        self.version.store(VERSIONS.fetch_add(1, Ordering::Relaxed), Ordering::Release);
    }
}

/// A buffer object's data store.
#[derive(Debug)]
pub struct BufferObject {
    /// The bytes.
    pub data: Vec<u8>,
    usage: u32,
    access: u32,
    mapped: bool,
}

static VERSIONS: AtomicU64 = AtomicU64::new(1);

impl Default for BufferObject {
    fn default() -> BufferObject {
        BufferObject { data: Vec::new(), usage: GL_STATIC_DRAW, access: GL_READ_WRITE, mapped: false }
    }
}

impl Context {
    /// glGenBuffers.
    pub fn gen_buffers(&mut self, n: i32) -> Vec<u32> {
        if self.refuses_in_begin() {
            return Vec::new();
        }
        if !(0..=limits::GENERATED_NAMES).contains(&n) {
            self.record_error(GL_INVALID_VALUE);
            return Vec::new();
        }
        self.shared.lock().generate_buffers(n as usize)
    }

    /// glDeleteBuffers. What is bound here becomes unbound.
    pub fn delete_buffers(&mut self, names: &[u32]) {
        if self.refuses_in_begin() {
            return;
        }
        for name in names.iter().filter(|&&n| n != 0) {
            self.shared.lock().buffers.remove(name);
            self.client.unbind(*name);
        }
    }

    /// glIsBuffer.
    pub fn is_buffer(&mut self, name: u32) -> bool {
        !self.refuses_in_begin() && matches!(self.shared.lock().buffers.get(&name), Some(Some(_)))
    }

    /// glBindBuffer.
    pub fn bind_buffer(&mut self, target: u32, name: u32) {
        if self.refuses_in_begin() {
            return;
        }
        let Some(slot) = self.client.binding_mut(target) else {
            return self.record_error(GL_INVALID_ENUM);
        };
        *slot = (name != 0).then(|| {
            let mut names = self.shared.lock();
            let entry = names.buffers.entry(name).or_default();
            (name, entry.get_or_insert_with(Arc::<Buffer>::default).clone())
        });
    }

    fn bound_buffer(&mut self, target: u32) -> Option<SharedBuffer> {
        if self.refuses_in_begin() {
            return None;
        }
        let Some(slot) = self.client.binding_mut(target) else {
            self.record_error(GL_INVALID_ENUM);
            return None;
        };
        let buffer = slot.as_ref().map(|(_, buffer)| buffer.clone());
        if buffer.is_none() {
            self.record_error(GL_INVALID_OPERATION);
        }
        buffer
    }

    /// glBufferData; without data the bytes are zero.
    pub fn buffer_data(&mut self, target: u32, size: isize, data: Option<&[u8]>, usage: u32) {
        let Some(buffer) = self.bound_buffer(target) else { return };
        let Ok(size) = usize::try_from(size) else { return self.record_error(GL_INVALID_VALUE) };
        if !(GL_STREAM_DRAW..=GL_DYNAMIC_COPY).contains(&usage) {
            return self.record_error(GL_INVALID_ENUM);
        }
        if size > limits::BUFFER_BYTES {
            return self.record_error(GL_OUT_OF_MEMORY);
        }
        let mut store = buffer.lock();
        store.data.clear();
        store.data.extend_from_slice(data.map_or(&[][..], |d| &d[..d.len().min(size)]));
        store.data.resize(size, 0);
        (store.usage, store.mapped, store.access) = (usage, false, GL_READ_WRITE);
        buffer.touch();
    }

    /// glBufferSubData.
    pub fn buffer_sub_data(&mut self, target: u32, offset: isize, data: &[u8]) {
        let Some(buffer) = self.bound_buffer(target) else { return };
        let mut store = buffer.lock();
        if store.mapped {
            drop(store);
            return self.record_error(GL_INVALID_OPERATION);
        }
        let range = usize::try_from(offset).ok().and_then(|o| Some(o..o.checked_add(data.len())?));
        match range.and_then(|range| store.data.get_mut(range)) {
            Some(target) => target.copy_from_slice(data),
            None => {
                drop(store);
                return self.record_error(GL_INVALID_VALUE);
            }
        }
        buffer.touch();
    }

    /// glGetBufferSubData; empty after an error.
    pub fn get_buffer_sub_data(&mut self, target: u32, offset: isize, size: isize) -> Vec<u8> {
        let Some(buffer) = self.bound_buffer(target) else { return Vec::new() };
        let buffer = buffer.lock();
        let range =
            usize::try_from(offset).ok().and_then(|o| Some(o..o.checked_add(usize::try_from(size).ok()?)?));
        let bytes = range.and_then(|range| buffer.data.get(range)).map(<[u8]>::to_vec);
        let mapped = buffer.mapped;
        drop(buffer);
        match bytes {
            Some(bytes) if !mapped => return bytes,
            Some(_) => self.record_error(GL_INVALID_OPERATION),
            None => self.record_error(GL_INVALID_VALUE),
        }
        Vec::new()
    }

    /// glMapBuffer; the bytes are in [`Context::mapped_buffer`].
    pub fn map_buffer(&mut self, target: u32, access: u32) -> bool {
        if !(GL_READ_ONLY..=GL_READ_WRITE).contains(&access) {
            self.record_error(GL_INVALID_ENUM);
            return false;
        }
        let Some(buffer) = self.bound_buffer(target) else { return false };
        let mut buffer = buffer.lock();
        if buffer.mapped {
            drop(buffer);
            self.record_error(GL_INVALID_OPERATION);
            return false;
        }
        (buffer.mapped, buffer.access) = (true, access);
        true
    }

    /// The buffer bound to `target`, if it is mapped.
    pub fn mapped_buffer(&mut self, target: u32) -> Option<SharedBuffer> {
        let (_, buffer) = self.client.binding_mut(target)?.clone()?;
        buffer.lock().mapped.then(|| buffer.clone())
    }

    /// glUnmapBuffer.
    pub fn unmap_buffer(&mut self, target: u32) -> bool {
        let Some(buffer) = self.bound_buffer(target) else { return false };
        let mut store = buffer.lock();
        if !store.mapped {
            drop(store);
            self.record_error(GL_INVALID_OPERATION);
            return false;
        }
        store.mapped = false;
        buffer.touch();
        true
    }

    /// glGetBufferParameter; `None` after an error.
    pub fn get_buffer_parameter(&mut self, target: u32, pname: u32) -> Option<i32> {
        let buffer = self.bound_buffer(target)?;
        let buffer = buffer.lock();
        Some(match pname {
            GL_BUFFER_SIZE => buffer.data.len() as i32,
            GL_BUFFER_USAGE => buffer.usage as i32,
            GL_BUFFER_ACCESS => buffer.access as i32,
            GL_BUFFER_MAPPED => buffer.mapped.into(),
            _ => {
                drop(buffer);
                self.record_error(GL_INVALID_ENUM);
                return None;
            }
        })
    }

    /// glGetBufferPointer: the address of a mapped buffer's bytes, 0 if it is not mapped; `None` after an error. The
    /// bytes stay there until the buffer is unmapped, deleted or given other data.
    pub fn get_buffer_pointer(&mut self, target: u32, pname: u32) -> Option<usize> {
        if pname != GL_BUFFER_MAP_POINTER {
            self.record_error(GL_INVALID_ENUM);
            return None;
        }
        let buffer = self.bound_buffer(target)?;
        let mut buffer = buffer.lock();
        Some(if buffer.mapped { buffer.data.as_mut_ptr() as usize } else { 0 })
    }
}
