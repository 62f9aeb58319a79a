//! What all entry points of OpenGL are made of.

/// Entry points that call the context: `fn NAME(PARAMETERS) -> RESULT = BOUNDARY(CONTEXT) => CALL;`
macro_rules! exports {
    ($(
        fn $name:ident($($param:ident: $ty:ty),*) $(-> $result:ty)? = $boundary:ident($gl:ident) => $call:expr;
    )*) => {$(
        #[unsafe(no_mangle)]
        pub unsafe extern "system" fn $name($($param: $ty),*) $(-> $result)? {
            #[cold]
            unsafe extern "system" fn recorded($($param: $ty),*) $(-> $result)? {
                let arguments = [$($crate::record::Bits::bits($param)),*];
                let run = || {
                    // SAFETY: the caller's pointers are what the specification of the command wants.
                    $boundary(|$gl| unsafe { $call }) $(as $result)?
                };
                // SAFETY: as above.
                unsafe { $crate::record::call(afterglow_api::id::$name, &arguments, run) }
            }
            if $crate::record::is_on() {
                // SAFETY: the contract is the same.
                return unsafe { recorded($($param),*) };
            }
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
            let run = || $crate::stub::call(stringify!($name), &CALLED);
            if !$crate::record::is_on() {
                return run();
            }
            let arguments = [$($crate::record::Bits::bits($param)),*];
            // SAFETY: the caller's pointers are what the specification of the command wants.
            unsafe { $crate::record::call(afterglow_api::id::$name, &arguments, run) }
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
