//! The context that is current on the calling thread.
//!
//! Rust's `thread_local!` in a shared library costs a call to `__tls_get_addr`, more than a whole glColor4f. On x86-64
//! Linux the pointer is in a variable of the initial-exec model instead: two instructions.

use afterglow_gl::Context;

/// The context that is current on this thread; null if there is none. Whoever sets it keeps it alive while it is set,
/// and lets no other thread use it.
#[inline(always)]
pub fn get() -> *mut Context {
    slot::get()
}

/// Sets the context that is current on this thread.
pub fn set(context: *mut Context) {
    slot::set(context);
}

#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod slot {
    use afterglow_gl::Context;

    std::arch::global_asm!(
        ".pushsection .tbss.afterglow_current,\"awT\",@nobits",
        ".p2align 3",
        ".globl afterglow_current",
        ".hidden afterglow_current",
        ".type afterglow_current, @object",
        ".size afterglow_current, 8",
        "afterglow_current:",
        ".zero 8",
        ".popsection",
    );

    #[inline(always)]
    pub fn get() -> *mut Context {
        let context;
        // SAFETY: reads this thread's own variable.
        unsafe {
            std::arch::asm!(
                "mov {context}, qword ptr [rip + afterglow_current@GOTTPOFF]",
                "mov {context}, qword ptr fs:[{context}]",
                context = out(reg) context,
                options(nostack, readonly, preserves_flags),
            );
        }
        context
    }

    pub fn set(context: *mut Context) {
        // SAFETY: writes this thread's own variable.
        unsafe {
            std::arch::asm!(
                "mov {offset}, qword ptr [rip + afterglow_current@GOTTPOFF]",
                "mov qword ptr fs:[{offset}], {context}",
                offset = out(reg) _,
                context = in(reg) context,
                options(nostack, preserves_flags),
            );
        }
    }
}

#[cfg(not(all(target_os = "linux", target_arch = "x86_64")))]
mod slot {
    use std::cell::Cell;

    use afterglow_gl::Context;

    thread_local! {
        static CURRENT: Cell<*mut Context> = const { Cell::new(std::ptr::null_mut()) };
    }

    #[inline(always)]
    pub fn get() -> *mut Context {
        CURRENT.with(Cell::get)
    }

    pub fn set(context: *mut Context) {
        CURRENT.with(|current| current.set(context));
    }
}

#[cfg(test)]
mod tests {
    use std::ptr::{dangling_mut, null_mut};

    #[test]
    fn each_thread_has_its_own() {
        assert!(super::get().is_null());
        super::set(dangling_mut());
        assert!(!super::get().is_null());
        std::thread::spawn(|| assert!(super::get().is_null())).join().unwrap();
        super::set(null_mut());
        assert!(super::get().is_null());
    }
}
