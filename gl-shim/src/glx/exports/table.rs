//! All functions of GLX 1.4 and of the extensions that are advertised: their parameters, by the names that tracers use,
//! what a recording says of each, and what serves them.

use std::ffi::{c_char, c_int, c_uint, c_ulong, c_void};

use super::{configs, contexts, drawables, fonts, server, swap};
use crate::glx::errors::{Fault, Request};
use crate::glx::xlib::{Display, VisualInfo, Xid};
use crate::record;
use crate::record::glx::Kind::{
    Attribute, Bool, Error, Handles, Id, Int, Pointer, StringName, Text, Visual, WrittenInt, WrittenMask,
    WrittenUint,
};
use crate::record::glx::{Kind, List, Signature};

const VISUAL_ATTRIBUTES: Kind = Kind::List(List::Visual);
const CONFIG_ATTRIBUTES: Kind = Kind::List(List::Config);
const CONTEXT_ATTRIBUTES: Kind = Kind::List(List::Context);
const DRAWABLE_ATTRIBUTES: Kind = Kind::List(List::Drawable);
const WINDOW_ATTRIBUTES: Kind = Kind::List(List::Window);

/// Entry points: `fn NAME(PARAMETER: TYPE as KIND, ...) -> TYPE as KIND => CALL, then WHAT IS RECORDED AFTER IT;`
macro_rules! entry_points {
    ($(
        fn $name:ident($($param:ident: $ty:ty as $kind:expr),* $(,)?) $(-> $result:ty as $result_kind:expr)?
            => $call:expr $(, then $then:expr)?;
    )*) => {
        $(
            #[allow(unused_variables, unused_unsafe, reason = "not every function needs all that it is given")]
            #[unsafe(no_mangle)]
            pub unsafe extern "C" fn $name($($param: $ty),*) $(-> $result)? {
                static SIGNATURE: Signature = Signature {
                    id: afterglow_api::id::$name,
                    names: &[$(stringify!($param)),*],
                    kinds: &[$($kind),*],
                    result: [$(Some($result_kind),)? None][0],
                };
                let arguments = [$(record::Bits::bits($param)),*];
                // SAFETY: the caller's pointers are what the specification of the function wants.
                let result = unsafe { record::glx::call(&SIGNATURE, &arguments, || $call) };
                $($then;)?
                result
            }
        )*

        /// The address of the entry point of that name.
        pub fn find(name: &str) -> Option<*const c_void> {
            match name {
                $(stringify!($name) => Some($name as *const c_void),)*
                _ => None,
            }
        }
    };
}

entry_points! {
    // Displays, and what they have.
    fn glXQueryExtension(dpy: *mut Display as Pointer, errorb: *mut c_int as WrittenInt, event: *mut c_int as WrittenInt)
        -> c_int as Bool => server::query_extension(dpy, errorb, event);
    fn glXQueryVersion(dpy: *mut Display as Pointer, maj: *mut c_int as WrittenInt, min: *mut c_int as WrittenInt)
        -> c_int as Bool => server::query_version(maj, min);
    fn glXQueryExtensionsString(dpy: *mut Display as Pointer, screen: c_int as Int)
        -> *const c_char as Text => server::query_extensions_string();
    fn glXQueryServerString(dpy: *mut Display as Pointer, screen: c_int as Int, name: c_int as StringName)
        -> *const c_char as Text => server::query_string(name);
    fn glXGetClientString(dpy: *mut Display as Pointer, name: c_int as StringName)
        -> *const c_char as Text => server::query_string(name);
    fn glXGetProcAddress(procName: *const u8 as Text)
        -> *const c_void as Pointer => server::get_proc_address(procName);
    fn glXGetProcAddressARB(procName: *const u8 as Text)
        -> *const c_void as Pointer => server::get_proc_address(procName);

    // Visuals and configurations.
    fn glXChooseVisual(dpy: *mut Display as Pointer, screen: c_int as Int, attribList: *const c_int as VISUAL_ATTRIBUTES)
        -> *mut VisualInfo as Visual => configs::choose_visual(dpy, screen, attribList);
    fn glXGetConfig(
        dpy: *mut Display as Pointer, visual: *const VisualInfo as Visual, attrib: c_int as Attribute,
        value: *mut c_int as WrittenInt,
    ) -> c_int as Error => configs::get_config(dpy, visual, attrib, value);
    fn glXGetFBConfigs(dpy: *mut Display as Pointer, screen: c_int as Int, nelements: *mut c_int as WrittenInt)
        -> *mut *mut c_void as Handles(2) => configs::get_fb_configs(dpy, screen, nelements);
    fn glXChooseFBConfig(
        dpy: *mut Display as Pointer, screen: c_int as Int, attribList: *const c_int as CONFIG_ATTRIBUTES,
        nitems: *mut c_int as WrittenInt,
    ) -> *mut *mut c_void as Handles(3) => configs::choose_fb_config(dpy, screen, attribList, nitems);
    fn glXChooseFBConfigSGIX(
        dpy: *mut Display as Pointer, screen: c_int as Int, attrib_list: *const c_int as CONFIG_ATTRIBUTES,
        nelements: *mut c_int as WrittenInt,
    ) -> *mut *mut c_void as Handles(3) => configs::choose_fb_config(dpy, screen, attrib_list, nelements);
    fn glXGetFBConfigAttrib(
        dpy: *mut Display as Pointer, config: *const c_void as Pointer, attribute: c_int as Attribute,
        value: *mut c_int as WrittenInt,
    ) -> c_int as Int => configs::get_fb_config_attrib(config, attribute, value);
    fn glXGetFBConfigAttribSGIX(
        dpy: *mut Display as Pointer, config: *const c_void as Pointer, attribute: c_int as Attribute,
        value: *mut c_int as WrittenInt,
    ) -> c_int as Int => configs::get_fb_config_attrib(config, attribute, value);
    fn glXGetVisualFromFBConfig(dpy: *mut Display as Pointer, config: *const c_void as Pointer)
        -> *mut VisualInfo as Visual => configs::get_visual_from_fb_config(dpy, config);
    fn glXGetVisualFromFBConfigSGIX(dpy: *mut Display as Pointer, config: *const c_void as Pointer)
        -> *mut VisualInfo as Visual => configs::get_visual_from_fb_config(dpy, config);
    fn glXGetFBConfigFromVisualSGIX(dpy: *mut Display as Pointer, vis: *const VisualInfo as Visual)
        -> *mut c_void as Pointer => configs::get_fb_config_from_visual(dpy, vis);

    // Contexts.
    fn glXCreateContext(
        dpy: *mut Display as Pointer, vis: *const VisualInfo as Visual, shareList: *mut c_void as Pointer,
        direct: c_int as Bool,
    ) -> *mut c_void as Pointer => contexts::create_context(dpy, vis, shareList);
    fn glXCreateNewContext(
        dpy: *mut Display as Pointer, config: *const c_void as Pointer, renderType: c_int as Attribute,
        shareList: *mut c_void as Pointer, direct: c_int as Bool,
    ) -> *mut c_void as Pointer => contexts::create_new_context(dpy, config, renderType, shareList);
    fn glXCreateContextWithConfigSGIX(
        dpy: *mut Display as Pointer, config: *const c_void as Pointer, render_type: c_int as Attribute,
        share_list: *mut c_void as Pointer, direct: c_int as Bool,
    ) -> *mut c_void as Pointer => contexts::create_new_context(dpy, config, render_type, share_list);
    fn glXCreateContextAttribsARB(
        dpy: *mut Display as Pointer, config: *const c_void as Pointer, share_context: *mut c_void as Pointer,
        direct: c_int as Bool, attrib_list: *const c_int as CONTEXT_ATTRIBUTES,
    ) -> *mut c_void as Pointer => contexts::create_context_attribs(dpy, config, share_context, attrib_list);
    fn glXDestroyContext(dpy: *mut Display as Pointer, ctx: *mut c_void as Pointer) => contexts::destroy_context(ctx);
    fn glXFreeContextEXT(dpy: *mut Display as Pointer, context: *mut c_void as Pointer)
        => contexts::destroy_context(context);
    fn glXCopyContext(
        dpy: *mut Display as Pointer, src: *mut c_void as Pointer, dst: *mut c_void as Pointer, mask: c_ulong as Id,
    ) => contexts::copy_context(dpy, src, dst, mask);
    fn glXIsDirect(dpy: *mut Display as Pointer, ctx: *mut c_void as Pointer)
        -> c_int as Bool => contexts::is_direct(ctx);
    fn glXQueryContext(
        dpy: *mut Display as Pointer, ctx: *mut c_void as Pointer, attribute: c_int as Attribute,
        value: *mut c_int as WrittenInt,
    ) -> c_int as Int => contexts::query_context(ctx, attribute, value);
    fn glXQueryContextInfoEXT(
        dpy: *mut Display as Pointer, context: *mut c_void as Pointer, attribute: c_int as Int,
        value: *mut c_int as Pointer,
    ) -> c_int as Int => contexts::query_context(context, attribute, value);
    fn glXGetContextIDEXT(context: *const c_void as Pointer) -> Xid as Id => contexts::context_id(context);

    // What is current.
    fn glXMakeCurrent(dpy: *mut Display as Pointer, drawable: Xid as Id, ctx: *mut c_void as Pointer)
        -> c_int as Bool => contexts::make_current(dpy, (drawable, drawable), ctx, Request::MakeCurrent), then contexts::record_drawable_size();
    fn glXMakeContextCurrent(
        dpy: *mut Display as Pointer, draw: Xid as Id, read: Xid as Id, ctx: *mut c_void as Pointer,
    ) -> c_int as Bool => contexts::make_current(dpy, (draw, read), ctx, Request::MakeContextCurrent), then contexts::record_drawable_size();
    fn glXMakeCurrentReadSGI(
        dpy: *mut Display as Pointer, draw: Xid as Id, read: Xid as Id, ctx: *mut c_void as Pointer,
    ) -> c_int as Bool => contexts::make_current(dpy, (draw, read), ctx, Request::MakeContextCurrent), then contexts::record_drawable_size();
    fn glXGetCurrentContext() -> *mut c_void as Pointer => contexts::get_current_context();
    fn glXGetCurrentDrawable() -> Xid as Id => contexts::get_current_drawable();
    fn glXGetCurrentReadDrawable() -> Xid as Id => contexts::get_current_read_drawable();
    fn glXGetCurrentReadDrawableSGI() -> Xid as Id => contexts::get_current_read_drawable();
    fn glXGetCurrentDisplay() -> *mut Display as Pointer => contexts::get_current_display();
    fn glXGetCurrentDisplayEXT() -> *mut Display as Pointer => contexts::get_current_display();
    fn glXWaitGL() => contexts::wait_gl();
    fn glXWaitX() => contexts::wait_x();
    fn glXUseXFont(font: Xid as Id, first: c_int as Int, count: c_int as Int, list: c_int as Int)
        => fonts::use_x_font(font, first, count, list);

    // Windows, pixmaps and pbuffers.
    fn glXCreateWindow(
        dpy: *mut Display as Pointer, config: *const c_void as Pointer, win: Xid as Id,
        attribList: *const c_int as WINDOW_ATTRIBUTES,
    ) -> Xid as Id => drawables::create_window(dpy, config, win);
    fn glXCreatePixmap(
        dpy: *mut Display as Pointer, config: *const c_void as Pointer, pixmap: Xid as Id,
        attribList: *const c_int as DRAWABLE_ATTRIBUTES,
    ) -> Xid as Id => drawables::create_pixmap(dpy, config, pixmap);
    fn glXCreateGLXPixmap(dpy: *mut Display as Pointer, visual: *const VisualInfo as Visual, pixmap: Xid as Id)
        -> Xid as Id => drawables::create_glx_pixmap(dpy, visual, pixmap);
    fn glXCreateGLXPixmapWithConfigSGIX(dpy: *mut Display as Pointer, config: *const c_void as Pointer, pixmap: Xid as Id)
        -> Xid as Id => drawables::create_pixmap(dpy, config, pixmap);
    fn glXCreatePbuffer(
        dpy: *mut Display as Pointer, config: *const c_void as Pointer, attribList: *const c_int as DRAWABLE_ATTRIBUTES,
    ) -> Xid as Id => drawables::create_pbuffer(dpy, config, attribList);
    fn glXCreateGLXPbufferSGIX(
        dpy: *mut Display as Pointer, config: *const c_void as Pointer, width: c_uint as Id, height: c_uint as Id,
        attrib_list: *const c_int as DRAWABLE_ATTRIBUTES,
    ) -> Xid as Id => drawables::create_glx_pbuffer(dpy, config, width, height, attrib_list);
    fn glXDestroyWindow(dpy: *mut Display as Pointer, window: Xid as Id) => drawables::destroy_drawable(dpy, window, Fault::BadWindow, Request::DestroyWindow);
    fn glXDestroyPixmap(dpy: *mut Display as Pointer, pixmap: Xid as Id) => drawables::destroy_drawable(dpy, pixmap, Fault::BadPixmap, Request::DestroyPixmap);
    fn glXDestroyGLXPixmap(dpy: *mut Display as Pointer, pixmap: Xid as Id)
        => drawables::destroy_drawable(dpy, pixmap, Fault::BadPixmap, Request::DestroyGlxPixmap);
    fn glXDestroyPbuffer(dpy: *mut Display as Pointer, pbuf: Xid as Id) => drawables::destroy_drawable(dpy, pbuf, Fault::BadPbuffer, Request::DestroyPbuffer);
    fn glXDestroyGLXPbufferSGIX(dpy: *mut Display as Pointer, pbuf: Xid as Id)
        => drawables::destroy_drawable(dpy, pbuf, Fault::BadPbuffer, Request::DestroyPbuffer);
    fn glXQueryDrawable(
        dpy: *mut Display as Pointer, draw: Xid as Id, attribute: c_int as Attribute,
        value: *mut c_uint as WrittenUint,
    ) => drawables::query_drawable(dpy, draw, attribute, value);
    fn glXQueryGLXPbufferSGIX(
        dpy: *mut Display as Pointer, pbuf: Xid as Id, attribute: c_int as Int, value: *mut c_uint as WrittenUint,
    ) => drawables::query_drawable(dpy, pbuf, attribute, value);
    fn glXSelectEvent(dpy: *mut Display as Pointer, drawable: Xid as Id, mask: c_ulong as Id)
        => drawables::select_event(dpy, drawable, mask);
    fn glXSelectEventSGIX(dpy: *mut Display as Pointer, drawable: Xid as Id, mask: c_ulong as Id)
        => drawables::select_event(dpy, drawable, mask);
    fn glXGetSelectedEvent(dpy: *mut Display as Pointer, drawable: Xid as Id, mask: *mut c_ulong as WrittenMask)
        => drawables::get_selected_event(dpy, drawable, mask);
    fn glXGetSelectedEventSGIX(dpy: *mut Display as Pointer, drawable: Xid as Id, mask: *mut c_ulong as WrittenMask)
        => drawables::get_selected_event(dpy, drawable, mask);

    // Buffer swaps. After one, the recording is up to date.
    fn glXSwapBuffers(dpy: *mut Display as Pointer, drawable: Xid as Id)
        => swap::swap_buffers(dpy, drawable), then record::glx::flush();
    fn glXSwapIntervalEXT(dpy: *mut Display as Pointer, drawable: Xid as Id, interval: c_int as Int)
        => swap::swap_interval(dpy, drawable, interval);
    fn glXSwapIntervalMESA(interval: c_uint as Id) -> c_int as Int => swap::swap_interval_mesa(interval);
    fn glXSwapIntervalSGI(interval: c_int as Int) -> c_int as Int => swap::swap_interval_sgi(interval);
    fn glXGetSwapIntervalMESA() -> c_int as Int => swap::get_swap_interval();
}
