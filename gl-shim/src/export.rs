//! What all entry points of OpenGL are made of.

/// Entry points that call the context: `fn NAME(PARAMETERS) -> RESULT = BOUNDARY(CONTEXT) => CALL;`
macro_rules! exports {
    ($(
        fn $name:ident($($param:ident: $ty:ty),*) $(-> $result:ty)? = $boundary:ident($gl:ident) => $call:expr;
    )*) => {$(
        #[unsafe(no_mangle)]
        pub unsafe extern "system" fn $name($($param: $ty),*) $(-> $result)? {
            // SAFETY: the caller's pointers are what the specification of the command wants.
            $boundary(|$gl| unsafe { $call }) $(as $result)?
        }
    )*};
}

/// Entry points that count as errors, of known parameters.
macro_rules! refusals {
    ($(fn $name:ident($($param:ident: $ty:ty),*);)*) => {$(
        #[unsafe(no_mangle)]
        pub unsafe extern "system" fn $name($($param: $ty),*) {
            static CALLED: std::sync::atomic::AtomicBool = std::sync::atomic::AtomicBool::new(false);
            $crate::stub::call(stringify!($name), &CALLED);
        }
    )*};
}

/// Entry points that count as errors, whatever their parameters are. They give 0 or a null pointer.
macro_rules! stubs {
    ($($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        pub extern "C" fn $name() -> usize {
            static CALLED: std::sync::atomic::AtomicBool = std::sync::atomic::AtomicBool::new(false);
            $crate::stub::call(stringify!($name), &CALLED);
            0
        }
    )*};
}

pub(crate) use {exports, refusals, stubs};
