//! Names the library as programs ask for it.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libGL.so.1");
        // Our own addresses are those of our own functions, also where a tool such as a tracer is preloaded and has
        // functions of the same names: it asks us for what it hides.
        println!("cargo:rustc-cdylib-link-arg=-Wl,-Bsymbolic-functions");
        // Programs close the library while its render thread runs, and open it again.
        println!("cargo:rustc-cdylib-link-arg=-Wl,-z,nodelete");
    }
}
