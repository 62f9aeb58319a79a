// Written by afterglow-gen (./x gen) from the Khronos XML and manifests/gl-behaviours.toml; not to be edited.

#![allow(
    unused_unsafe,
    unused_variables,
    clippy::too_many_arguments,
    reason = "parameters are OpenGL's, and not every command needs all that an entry point offers"
)]

use std::ffi::c_void;

use afterglow_api::constants::GL_INVALID_VALUE;
use afterglow_gl::Params;

use crate::boundary::{with_context, with_context_plainly};
use crate::export::{exports, refusals, stubs};
use crate::{memory, number, special};

exports! {
    fn glAccum(op: u32, value: f32) = with_context(gl) => gl.accum(op, value);
    fn glActiveTexture(texture: u32) = with_context(gl) => gl.active_texture(texture);
    fn glActiveTextureARB(texture: u32) = with_context(gl) => gl.active_texture(texture);
    fn glAlphaFunc(func: u32, r#ref: f32) = with_context(gl) => gl.alpha_func(func, r#ref);
    fn glAreTexturesResident(n: i32, textures: *const u32, residences: *mut u8) -> u8 = with_context(gl) => u8::from(special::are_textures_resident(gl, n, textures, residences));
    fn glAreTexturesResidentEXT(n: i32, textures: *const u32, residences: *mut u8) -> u8 = with_context(gl) => u8::from(special::are_textures_resident(gl, n, textures, residences));
    fn glArrayElement(i: i32) = with_context(gl) => gl.array_element(i);
    fn glArrayElementEXT(i: i32) = with_context(gl) => gl.array_element(i);
    fn glBegin(mode: u32) = with_context(gl) => gl.begin(mode);
    fn glBeginQuery(target: u32, id: u32) = with_context(gl) => gl.begin_query(target, id);
    fn glBeginQueryARB(target: u32, id: u32) = with_context(gl) => gl.begin_query(target, id);
    fn glBindBuffer(target: u32, buffer: u32) = with_context(gl) => gl.bind_buffer(target, buffer);
    fn glBindBufferARB(target: u32, buffer: u32) = with_context(gl) => gl.bind_buffer(target, buffer);
    fn glBindTexture(target: u32, texture: u32) = with_context(gl) => gl.bind_texture(target, texture);
    fn glBindTextureEXT(target: u32, texture: u32) = with_context(gl) => gl.bind_texture(target, texture);
    fn glBitmap(width: i32, height: i32, xorig: f32, yorig: f32, xmove: f32, ymove: f32, bitmap: *const u8) = with_context(gl) => special::bitmap(gl, width, height, xorig, yorig, xmove, ymove, bitmap);
    fn glBlendColor(red: f32, green: f32, blue: f32, alpha: f32) = with_context(gl) => gl.blend_color(red, green, blue, alpha);
    fn glBlendColorEXT(red: f32, green: f32, blue: f32, alpha: f32) = with_context(gl) => gl.blend_color(red, green, blue, alpha);
    fn glBlendEquation(mode: u32) = with_context(gl) => gl.blend_equation(mode);
    fn glBlendEquationEXT(mode: u32) = with_context(gl) => gl.blend_equation(mode);
    fn glBlendFunc(sfactor: u32, dfactor: u32) = with_context(gl) => gl.blend_func(sfactor, dfactor);
    fn glBlendFuncSeparate(sfactorRGB: u32, dfactorRGB: u32, sfactorAlpha: u32, dfactorAlpha: u32) = with_context(gl) => gl.blend_func_separate(sfactorRGB, dfactorRGB, sfactorAlpha, dfactorAlpha);
    fn glBlendFuncSeparateEXT(sfactorRGB: u32, dfactorRGB: u32, sfactorAlpha: u32, dfactorAlpha: u32) = with_context(gl) => gl.blend_func_separate(sfactorRGB, dfactorRGB, sfactorAlpha, dfactorAlpha);
    fn glBlendFuncSeparateINGR(sfactorRGB: u32, dfactorRGB: u32, sfactorAlpha: u32, dfactorAlpha: u32) = with_context(gl) => gl.blend_func_separate(sfactorRGB, dfactorRGB, sfactorAlpha, dfactorAlpha);
    fn glBufferData(target: u32, size: isize, data: *const c_void, usage: u32) = with_context(gl) => special::buffer_data(gl, target, size, data, usage);
    fn glBufferDataARB(target: u32, size: isize, data: *const c_void, usage: u32) = with_context(gl) => special::buffer_data(gl, target, size, data, usage);
    fn glBufferSubData(target: u32, offset: isize, size: isize, data: *const c_void) = with_context(gl) => special::buffer_sub_data(gl, target, offset, size, data);
    fn glBufferSubDataARB(target: u32, offset: isize, size: isize, data: *const c_void) = with_context(gl) => special::buffer_sub_data(gl, target, offset, size, data);
    fn glCallList(list: u32) = with_context(gl) => gl.call_list(list);
    fn glCallLists(n: i32, r#type: u32, lists: *const c_void) = with_context(gl) => special::call_lists(gl, n, r#type, lists);
    fn glClear(mask: u32) = with_context(gl) => gl.clear(mask);
    fn glClearAccum(red: f32, green: f32, blue: f32, alpha: f32) = with_context(gl) => gl.clear_accum(red, green, blue, alpha);
    fn glClearColor(red: f32, green: f32, blue: f32, alpha: f32) = with_context(gl) => gl.clear_color(red, green, blue, alpha);
    fn glClearDepth(depth: f64) = with_context(gl) => gl.clear_depth(depth);
    fn glClearIndex(c: f32) = with_context(gl) => gl.clear_index(c);
    fn glClearStencil(s: i32) = with_context(gl) => gl.clear_stencil(s);
    fn glClientActiveTexture(texture: u32) = with_context(gl) => gl.client_active_texture(texture);
    fn glClientActiveTextureARB(texture: u32) = with_context(gl) => gl.client_active_texture(texture);
    fn glClipPlane(plane: u32, equation: *const f64) = with_context(gl) => gl.clip_plane(plane, memory::vector(equation, number::double));
    fn glColor3b(red: i8, green: i8, blue: i8) = with_context_plainly(gl) => gl.color([number::snorm8(red), number::snorm8(green), number::snorm8(blue), 1.0]);
    fn glColor3bv(v: *const i8) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::snorm8); gl.color([x, y, z, 1.0]) };
    fn glColor3d(red: f64, green: f64, blue: f64) = with_context_plainly(gl) => gl.color([number::float(red), number::float(green), number::float(blue), 1.0]);
    fn glColor3dv(v: *const f64) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.color([x, y, z, 1.0]) };
    fn glColor3f(red: f32, green: f32, blue: f32) = with_context_plainly(gl) => gl.color([red, green, blue, 1.0]);
    fn glColor3fv(v: *const f32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.color([x, y, z, 1.0]) };
    fn glColor3i(red: i32, green: i32, blue: i32) = with_context_plainly(gl) => gl.color([number::snorm32(red), number::snorm32(green), number::snorm32(blue), 1.0]);
    fn glColor3iv(v: *const i32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::snorm32); gl.color([x, y, z, 1.0]) };
    fn glColor3s(red: i16, green: i16, blue: i16) = with_context_plainly(gl) => gl.color([number::snorm16(red), number::snorm16(green), number::snorm16(blue), 1.0]);
    fn glColor3sv(v: *const i16) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::snorm16); gl.color([x, y, z, 1.0]) };
    fn glColor3ub(red: u8, green: u8, blue: u8) = with_context_plainly(gl) => gl.color([number::unorm8(red), number::unorm8(green), number::unorm8(blue), 1.0]);
    fn glColor3ubv(v: *const u8) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::unorm8); gl.color([x, y, z, 1.0]) };
    fn glColor3ui(red: u32, green: u32, blue: u32) = with_context_plainly(gl) => gl.color([number::unorm32(red), number::unorm32(green), number::unorm32(blue), 1.0]);
    fn glColor3uiv(v: *const u32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::unorm32); gl.color([x, y, z, 1.0]) };
    fn glColor3us(red: u16, green: u16, blue: u16) = with_context_plainly(gl) => gl.color([number::unorm16(red), number::unorm16(green), number::unorm16(blue), 1.0]);
    fn glColor3usv(v: *const u16) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::unorm16); gl.color([x, y, z, 1.0]) };
    fn glColor4b(red: i8, green: i8, blue: i8, alpha: i8) = with_context_plainly(gl) => gl.color([number::snorm8(red), number::snorm8(green), number::snorm8(blue), number::snorm8(alpha)]);
    fn glColor4bv(v: *const i8) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::snorm8); gl.color([x, y, z, w]) };
    fn glColor4d(red: f64, green: f64, blue: f64, alpha: f64) = with_context_plainly(gl) => gl.color([number::float(red), number::float(green), number::float(blue), number::float(alpha)]);
    fn glColor4dv(v: *const f64) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.color([x, y, z, w]) };
    fn glColor4f(red: f32, green: f32, blue: f32, alpha: f32) = with_context_plainly(gl) => gl.color([red, green, blue, alpha]);
    fn glColor4fv(v: *const f32) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.color([x, y, z, w]) };
    fn glColor4i(red: i32, green: i32, blue: i32, alpha: i32) = with_context_plainly(gl) => gl.color([number::snorm32(red), number::snorm32(green), number::snorm32(blue), number::snorm32(alpha)]);
    fn glColor4iv(v: *const i32) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::snorm32); gl.color([x, y, z, w]) };
    fn glColor4s(red: i16, green: i16, blue: i16, alpha: i16) = with_context_plainly(gl) => gl.color([number::snorm16(red), number::snorm16(green), number::snorm16(blue), number::snorm16(alpha)]);
    fn glColor4sv(v: *const i16) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::snorm16); gl.color([x, y, z, w]) };
    fn glColor4ub(red: u8, green: u8, blue: u8, alpha: u8) = with_context_plainly(gl) => gl.color([number::unorm8(red), number::unorm8(green), number::unorm8(blue), number::unorm8(alpha)]);
    fn glColor4ubv(v: *const u8) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::unorm8); gl.color([x, y, z, w]) };
    fn glColor4ui(red: u32, green: u32, blue: u32, alpha: u32) = with_context_plainly(gl) => gl.color([number::unorm32(red), number::unorm32(green), number::unorm32(blue), number::unorm32(alpha)]);
    fn glColor4uiv(v: *const u32) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::unorm32); gl.color([x, y, z, w]) };
    fn glColor4us(red: u16, green: u16, blue: u16, alpha: u16) = with_context_plainly(gl) => gl.color([number::unorm16(red), number::unorm16(green), number::unorm16(blue), number::unorm16(alpha)]);
    fn glColor4usv(v: *const u16) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::unorm16); gl.color([x, y, z, w]) };
    fn glColorMask(red: u8, green: u8, blue: u8, alpha: u8) = with_context(gl) => gl.color_mask(number::boolean(red), number::boolean(green), number::boolean(blue), number::boolean(alpha));
    fn glColorMaterial(face: u32, mode: u32) = with_context(gl) => gl.color_material(face, mode);
    fn glColorPointer(size: i32, r#type: u32, stride: i32, pointer: *const c_void) = with_context(gl) => gl.color_pointer(size, r#type, stride, memory::pointer(pointer.cast()));
    fn glColorPointerEXT(size: i32, r#type: u32, stride: i32, count: i32, pointer: *const c_void) = with_context(gl) => gl.color_pointer(size, r#type, stride, memory::pointer(pointer.cast()));
    fn glCompressedTexImage1D(target: u32, level: i32, internalformat: u32, width: i32, border: i32, imageSize: i32, data: *const c_void) = with_context(gl) => special::compressed_tex_image_1d(gl, target, level, internalformat, width, border, imageSize, data);
    fn glCompressedTexImage1DARB(target: u32, level: i32, internalformat: u32, width: i32, border: i32, imageSize: i32, data: *const c_void) = with_context(gl) => special::compressed_tex_image_1d(gl, target, level, internalformat, width, border, imageSize, data);
    fn glCompressedTexImage2D(target: u32, level: i32, internalformat: u32, width: i32, height: i32, border: i32, imageSize: i32, data: *const c_void) = with_context(gl) => special::compressed_tex_image_2d(gl, target, level, internalformat, width, height, border, imageSize, data);
    fn glCompressedTexImage2DARB(target: u32, level: i32, internalformat: u32, width: i32, height: i32, border: i32, imageSize: i32, data: *const c_void) = with_context(gl) => special::compressed_tex_image_2d(gl, target, level, internalformat, width, height, border, imageSize, data);
    fn glCompressedTexImage3D(target: u32, level: i32, internalformat: u32, width: i32, height: i32, depth: i32, border: i32, imageSize: i32, data: *const c_void) = with_context(gl) => special::compressed_tex_image_3d(gl, target, level, internalformat, width, height, depth, border, imageSize, data);
    fn glCompressedTexImage3DARB(target: u32, level: i32, internalformat: u32, width: i32, height: i32, depth: i32, border: i32, imageSize: i32, data: *const c_void) = with_context(gl) => special::compressed_tex_image_3d(gl, target, level, internalformat, width, height, depth, border, imageSize, data);
    fn glCompressedTexSubImage1D(target: u32, level: i32, xoffset: i32, width: i32, format: u32, imageSize: i32, data: *const c_void) = with_context(gl) => special::compressed_tex_sub_image_1d(gl, target, level, xoffset, width, format, imageSize, data);
    fn glCompressedTexSubImage1DARB(target: u32, level: i32, xoffset: i32, width: i32, format: u32, imageSize: i32, data: *const c_void) = with_context(gl) => special::compressed_tex_sub_image_1d(gl, target, level, xoffset, width, format, imageSize, data);
    fn glCompressedTexSubImage2D(target: u32, level: i32, xoffset: i32, yoffset: i32, width: i32, height: i32, format: u32, imageSize: i32, data: *const c_void) = with_context(gl) => special::compressed_tex_sub_image_2d(gl, target, level, xoffset, yoffset, width, height, format, imageSize, data);
    fn glCompressedTexSubImage2DARB(target: u32, level: i32, xoffset: i32, yoffset: i32, width: i32, height: i32, format: u32, imageSize: i32, data: *const c_void) = with_context(gl) => special::compressed_tex_sub_image_2d(gl, target, level, xoffset, yoffset, width, height, format, imageSize, data);
    fn glCompressedTexSubImage3D(target: u32, level: i32, xoffset: i32, yoffset: i32, zoffset: i32, width: i32, height: i32, depth: i32, format: u32, imageSize: i32, data: *const c_void) = with_context(gl) => special::compressed_tex_sub_image_3d(gl, target, level, xoffset, yoffset, zoffset, width, height, depth, format, imageSize, data);
    fn glCompressedTexSubImage3DARB(target: u32, level: i32, xoffset: i32, yoffset: i32, zoffset: i32, width: i32, height: i32, depth: i32, format: u32, imageSize: i32, data: *const c_void) = with_context(gl) => special::compressed_tex_sub_image_3d(gl, target, level, xoffset, yoffset, zoffset, width, height, depth, format, imageSize, data);
    fn glCopyPixels(x: i32, y: i32, width: i32, height: i32, r#type: u32) = with_context(gl) => gl.copy_pixels(x, y, width, height, r#type);
    fn glCopyTexImage1D(target: u32, level: i32, internalformat: u32, x: i32, y: i32, width: i32, border: i32) = with_context(gl) => special::copy_tex_image_1d(gl, target, level, internalformat, x, y, width, border);
    fn glCopyTexImage1DEXT(target: u32, level: i32, internalformat: u32, x: i32, y: i32, width: i32, border: i32) = with_context(gl) => special::copy_tex_image_1d(gl, target, level, internalformat, x, y, width, border);
    fn glCopyTexImage2D(target: u32, level: i32, internalformat: u32, x: i32, y: i32, width: i32, height: i32, border: i32) = with_context(gl) => special::copy_tex_image_2d(gl, target, level, internalformat, x, y, width, height, border);
    fn glCopyTexImage2DEXT(target: u32, level: i32, internalformat: u32, x: i32, y: i32, width: i32, height: i32, border: i32) = with_context(gl) => special::copy_tex_image_2d(gl, target, level, internalformat, x, y, width, height, border);
    fn glCopyTexSubImage1D(target: u32, level: i32, xoffset: i32, x: i32, y: i32, width: i32) = with_context(gl) => special::copy_tex_sub_image_1d(gl, target, level, xoffset, x, y, width);
    fn glCopyTexSubImage1DEXT(target: u32, level: i32, xoffset: i32, x: i32, y: i32, width: i32) = with_context(gl) => special::copy_tex_sub_image_1d(gl, target, level, xoffset, x, y, width);
    fn glCopyTexSubImage2D(target: u32, level: i32, xoffset: i32, yoffset: i32, x: i32, y: i32, width: i32, height: i32) = with_context(gl) => special::copy_tex_sub_image_2d(gl, target, level, xoffset, yoffset, x, y, width, height);
    fn glCopyTexSubImage2DEXT(target: u32, level: i32, xoffset: i32, yoffset: i32, x: i32, y: i32, width: i32, height: i32) = with_context(gl) => special::copy_tex_sub_image_2d(gl, target, level, xoffset, yoffset, x, y, width, height);
    fn glCopyTexSubImage3D(target: u32, level: i32, xoffset: i32, yoffset: i32, zoffset: i32, x: i32, y: i32, width: i32, height: i32) = with_context(gl) => special::copy_tex_sub_image_3d(gl, target, level, xoffset, yoffset, zoffset, x, y, width, height);
    fn glCopyTexSubImage3DEXT(target: u32, level: i32, xoffset: i32, yoffset: i32, zoffset: i32, x: i32, y: i32, width: i32, height: i32) = with_context(gl) => special::copy_tex_sub_image_3d(gl, target, level, xoffset, yoffset, zoffset, x, y, width, height);
    fn glCullFace(mode: u32) = with_context(gl) => gl.cull_face(mode);
    fn glDeleteBuffers(n: i32, buffers: *const u32) = with_context(gl) => if n < 0 { gl.record_error(GL_INVALID_VALUE) } else { gl.delete_buffers(&memory::list(buffers, n, number::uint)) };
    fn glDeleteBuffersARB(n: i32, buffers: *const u32) = with_context(gl) => if n < 0 { gl.record_error(GL_INVALID_VALUE) } else { gl.delete_buffers(&memory::list(buffers, n, number::uint)) };
    fn glDeleteLists(list: u32, range: i32) = with_context(gl) => gl.delete_lists(list, range);
    fn glDeleteQueries(n: i32, ids: *const u32) = with_context(gl) => if n < 0 { gl.record_error(GL_INVALID_VALUE) } else { gl.delete_queries(&memory::list(ids, n, number::uint)) };
    fn glDeleteQueriesARB(n: i32, ids: *const u32) = with_context(gl) => if n < 0 { gl.record_error(GL_INVALID_VALUE) } else { gl.delete_queries(&memory::list(ids, n, number::uint)) };
    fn glDeleteTextures(n: i32, textures: *const u32) = with_context(gl) => if n < 0 { gl.record_error(GL_INVALID_VALUE) } else { gl.delete_textures(&memory::list(textures, n, number::uint)) };
    fn glDeleteTexturesEXT(n: i32, textures: *const u32) = with_context(gl) => if n < 0 { gl.record_error(GL_INVALID_VALUE) } else { gl.delete_textures(&memory::list(textures, n, number::uint)) };
    fn glDepthFunc(func: u32) = with_context(gl) => gl.depth_func(func);
    fn glDepthMask(flag: u8) = with_context(gl) => gl.depth_mask(number::boolean(flag));
    fn glDepthRange(n: f64, f: f64) = with_context(gl) => gl.depth_range(n, f);
    fn glDisable(cap: u32) = with_context(gl) => gl.disable(cap);
    fn glDisableClientState(array: u32) = with_context(gl) => gl.disable_client_state(array);
    fn glDrawArrays(mode: u32, first: i32, count: i32) = with_context(gl) => gl.draw_arrays(mode, first, count);
    fn glDrawArraysEXT(mode: u32, first: i32, count: i32) = with_context(gl) => gl.draw_arrays(mode, first, count);
    fn glDrawBuffer(buf: u32) = with_context(gl) => gl.draw_buffer(buf);
    fn glDrawElements(mode: u32, count: i32, r#type: u32, indices: *const c_void) = with_context(gl) => gl.draw_elements(mode, count, r#type, memory::pointer(indices.cast()));
    fn glDrawPixels(width: i32, height: i32, format: u32, r#type: u32, pixels: *const c_void) = with_context(gl) => special::draw_pixels(gl, width, height, format, r#type, pixels);
    fn glDrawRangeElements(mode: u32, start: u32, end: u32, count: i32, r#type: u32, indices: *const c_void) = with_context(gl) => gl.draw_range_elements(mode, start, end, count, r#type, memory::pointer(indices.cast()));
    fn glDrawRangeElementsEXT(mode: u32, start: u32, end: u32, count: i32, r#type: u32, indices: *const c_void) = with_context(gl) => gl.draw_range_elements(mode, start, end, count, r#type, memory::pointer(indices.cast()));
    fn glEdgeFlag(flag: u8) = with_context_plainly(gl) => gl.edge_flag(number::boolean(flag));
    fn glEdgeFlagPointer(stride: i32, pointer: *const c_void) = with_context(gl) => gl.edge_flag_pointer(stride, memory::pointer(pointer.cast()));
    fn glEdgeFlagPointerEXT(stride: i32, count: i32, pointer: *const u8) = with_context(gl) => gl.edge_flag_pointer(stride, memory::pointer(pointer.cast()));
    fn glEdgeFlagv(flag: *const u8) = with_context_plainly(gl) => gl.edge_flag(memory::first(flag, number::boolean));
    fn glEnable(cap: u32) = with_context(gl) => gl.enable(cap);
    fn glEnableClientState(array: u32) = with_context(gl) => gl.enable_client_state(array);
    fn glEnd() = with_context(gl) => gl.end();
    fn glEndList() = with_context(gl) => gl.end_list();
    fn glEndQuery(target: u32) = with_context(gl) => gl.end_query(target);
    fn glEndQueryARB(target: u32) = with_context(gl) => gl.end_query(target);
    fn glFinish() = with_context(gl) => special::finish(gl);
    fn glFlush() = with_context(gl) => special::flush(gl);
    fn glFogCoordPointer(r#type: u32, stride: i32, pointer: *const c_void) = with_context(gl) => gl.fog_coord_pointer(r#type, stride, memory::pointer(pointer.cast()));
    fn glFogCoordPointerEXT(r#type: u32, stride: i32, pointer: *const c_void) = with_context(gl) => gl.fog_coord_pointer(r#type, stride, memory::pointer(pointer.cast()));
    fn glFogCoordd(coord: f64) = with_context_plainly(gl) => gl.fog_coord(number::float(coord));
    fn glFogCoorddEXT(coord: f64) = with_context_plainly(gl) => gl.fog_coord(number::float(coord));
    fn glFogCoorddv(coord: *const f64) = with_context_plainly(gl) => { let [x] = memory::vector(coord, number::float); gl.fog_coord(x) };
    fn glFogCoorddvEXT(coord: *const f64) = with_context_plainly(gl) => { let [x] = memory::vector(coord, number::float); gl.fog_coord(x) };
    fn glFogCoordf(coord: f32) = with_context_plainly(gl) => gl.fog_coord(coord);
    fn glFogCoordfEXT(coord: f32) = with_context_plainly(gl) => gl.fog_coord(coord);
    fn glFogCoordfv(coord: *const f32) = with_context_plainly(gl) => { let [x] = memory::vector(coord, number::float); gl.fog_coord(x) };
    fn glFogCoordfvEXT(coord: *const f32) = with_context_plainly(gl) => { let [x] = memory::vector(coord, number::float); gl.fog_coord(x) };
    fn glFogf(pname: u32, param: f32) = with_context(gl) => gl.fog(pname, Params::Floats(&[param]));
    fn glFogfv(pname: u32, params: *const f32) = with_context(gl) => gl.fog(pname, Params::Floats(&memory::few(params, pname, number::float)));
    fn glFogi(pname: u32, param: i32) = with_context(gl) => gl.fog(pname, Params::Ints(&[param]));
    fn glFogiv(pname: u32, params: *const i32) = with_context(gl) => gl.fog(pname, Params::Ints(&memory::few(params, pname, number::int)));
    fn glFrontFace(mode: u32) = with_context(gl) => gl.front_face(mode);
    fn glFrustum(left: f64, right: f64, bottom: f64, top: f64, zNear: f64, zFar: f64) = with_context(gl) => gl.frustum(left, right, bottom, top, zNear, zFar);
    fn glGenBuffers(n: i32, buffers: *mut u32) = with_context(gl) => memory::store(gl.gen_buffers(n), buffers);
    fn glGenBuffersARB(n: i32, buffers: *mut u32) = with_context(gl) => memory::store(gl.gen_buffers(n), buffers);
    fn glGenLists(range: i32) -> u32 = with_context(gl) => gl.gen_lists(range);
    fn glGenQueries(n: i32, ids: *mut u32) = with_context(gl) => memory::store(gl.gen_queries(n), ids);
    fn glGenQueriesARB(n: i32, ids: *mut u32) = with_context(gl) => memory::store(gl.gen_queries(n), ids);
    fn glGenTextures(n: i32, textures: *mut u32) = with_context(gl) => memory::store(gl.gen_textures(n), textures);
    fn glGenTexturesEXT(n: i32, textures: *mut u32) = with_context(gl) => memory::store(gl.gen_textures(n), textures);
    fn glGetBooleanv(pname: u32, data: *mut u8) = with_context(gl) => memory::store(gl.get_boolean(pname), data);
    fn glGetBufferParameteriv(target: u32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_buffer_parameter(target, pname), params);
    fn glGetBufferParameterivARB(target: u32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_buffer_parameter(target, pname), params);
    fn glGetBufferPointerv(target: u32, pname: u32, params: *mut *mut c_void) = with_context(gl) => special::get_buffer_pointerv(gl, target, pname, params);
    fn glGetBufferPointervARB(target: u32, pname: u32, params: *mut *mut c_void) = with_context(gl) => special::get_buffer_pointerv(gl, target, pname, params);
    fn glGetBufferPointervOES(target: u32, pname: u32, params: *mut *mut c_void) = with_context(gl) => special::get_buffer_pointerv(gl, target, pname, params);
    fn glGetBufferSubData(target: u32, offset: isize, size: isize, data: *mut c_void) = with_context(gl) => memory::store(gl.get_buffer_sub_data(target, offset, size), data.cast::<u8>());
    fn glGetBufferSubDataARB(target: u32, offset: isize, size: isize, data: *mut c_void) = with_context(gl) => memory::store(gl.get_buffer_sub_data(target, offset, size), data.cast::<u8>());
    fn glGetClipPlane(plane: u32, equation: *mut f64) = with_context(gl) => memory::store(gl.get_clip_plane(plane), equation);
    fn glGetCompressedTexImage(target: u32, level: i32, img: *mut c_void) = with_context(gl) => memory::store(gl.get_compressed_tex_image(target, level), img.cast::<u8>());
    fn glGetCompressedTexImageARB(target: u32, level: i32, img: *mut c_void) = with_context(gl) => memory::store(gl.get_compressed_tex_image(target, level), img.cast::<u8>());
    fn glGetDoublev(pname: u32, data: *mut f64) = with_context(gl) => memory::store(gl.get_double(pname), data);
    fn glGetError() -> u32 = with_context(gl) => gl.get_error();
    fn glGetFloatv(pname: u32, data: *mut f32) = with_context(gl) => memory::store(gl.get_float(pname), data);
    fn glGetIntegerv(pname: u32, data: *mut i32) = with_context(gl) => memory::store(gl.get_integer(pname), data);
    fn glGetLightfv(light: u32, pname: u32, params: *mut f32) = with_context(gl) => memory::store(gl.get_light(light, pname), params);
    fn glGetLightiv(light: u32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_light(light, pname), params);
    fn glGetMaterialfv(face: u32, pname: u32, params: *mut f32) = with_context(gl) => memory::store(gl.get_material(face, pname), params);
    fn glGetMaterialiv(face: u32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_material(face, pname), params);
    fn glGetPixelMapfv(map: u32, values: *mut f32) = with_context(gl) => memory::store(gl.get_pixel_map(map), values);
    fn glGetPixelMapuiv(map: u32, values: *mut u32) = with_context(gl) => special::get_pixel_mapuiv(gl, map, values);
    fn glGetPixelMapusv(map: u32, values: *mut u16) = with_context(gl) => special::get_pixel_mapusv(gl, map, values);
    fn glGetPointerv(pname: u32, params: *mut *mut c_void) = with_context(gl) => memory::store(gl.get_pointer(pname), params);
    fn glGetPointervEXT(pname: u32, params: *mut *mut c_void) = with_context(gl) => memory::store(gl.get_pointer(pname), params);
    fn glGetPointervKHR(pname: u32, params: *mut *mut c_void) = with_context(gl) => memory::store(gl.get_pointer(pname), params);
    fn glGetPolygonStipple(mask: *mut u8) = with_context(gl) => special::get_polygon_stipple(gl, mask);
    fn glGetQueryObjectiv(id: u32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_query_object(id, pname), params);
    fn glGetQueryObjectivARB(id: u32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_query_object(id, pname), params);
    fn glGetQueryObjectivEXT(id: u32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_query_object(id, pname), params);
    fn glGetQueryObjectuiv(id: u32, pname: u32, params: *mut u32) = with_context(gl) => memory::store(gl.get_query_object(id, pname), params);
    fn glGetQueryObjectuivARB(id: u32, pname: u32, params: *mut u32) = with_context(gl) => memory::store(gl.get_query_object(id, pname), params);
    fn glGetQueryiv(target: u32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_query(target, pname), params);
    fn glGetQueryivARB(target: u32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_query(target, pname), params);
    fn glGetString(name: u32) -> *const u8 = with_context(gl) => special::get_string(gl, name);
    fn glGetTexEnvfv(target: u32, pname: u32, params: *mut f32) = with_context(gl) => memory::store(gl.get_tex_env(target, pname), params);
    fn glGetTexEnviv(target: u32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_tex_env(target, pname), params);
    fn glGetTexGendv(coord: u32, pname: u32, params: *mut f64) = with_context(gl) => memory::store(gl.get_tex_gen(coord, pname), params);
    fn glGetTexGenfv(coord: u32, pname: u32, params: *mut f32) = with_context(gl) => memory::store(gl.get_tex_gen(coord, pname), params);
    fn glGetTexGeniv(coord: u32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_tex_gen(coord, pname), params);
    fn glGetTexImage(target: u32, level: i32, format: u32, r#type: u32, pixels: *mut c_void) = with_context(gl) => special::get_tex_image(gl, target, level, format, r#type, pixels);
    fn glGetTexLevelParameterfv(target: u32, level: i32, pname: u32, params: *mut f32) = with_context(gl) => memory::store(gl.get_tex_level_parameter(target, level, pname), params);
    fn glGetTexLevelParameteriv(target: u32, level: i32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_tex_level_parameter(target, level, pname), params);
    fn glGetTexParameterfv(target: u32, pname: u32, params: *mut f32) = with_context(gl) => memory::store(gl.get_tex_parameter(target, pname), params);
    fn glGetTexParameteriv(target: u32, pname: u32, params: *mut i32) = with_context(gl) => memory::store(gl.get_tex_parameter(target, pname), params);
    fn glHint(target: u32, mode: u32) = with_context(gl) => gl.hint(target, mode);
    fn glIndexMask(mask: u32) = with_context(gl) => gl.index_mask(mask);
    fn glIndexPointer(r#type: u32, stride: i32, pointer: *const c_void) = with_context(gl) => gl.index_pointer(r#type, stride, memory::pointer(pointer.cast()));
    fn glIndexPointerEXT(r#type: u32, stride: i32, count: i32, pointer: *const c_void) = with_context(gl) => gl.index_pointer(r#type, stride, memory::pointer(pointer.cast()));
    fn glIndexd(c: f64) = with_context_plainly(gl) => gl.index(number::float(c));
    fn glIndexdv(c: *const f64) = with_context_plainly(gl) => { let [x] = memory::vector(c, number::float); gl.index(x) };
    fn glIndexf(c: f32) = with_context_plainly(gl) => gl.index(c);
    fn glIndexfv(c: *const f32) = with_context_plainly(gl) => { let [x] = memory::vector(c, number::float); gl.index(x) };
    fn glIndexi(c: i32) = with_context_plainly(gl) => gl.index(number::float(c));
    fn glIndexiv(c: *const i32) = with_context_plainly(gl) => { let [x] = memory::vector(c, number::float); gl.index(x) };
    fn glIndexs(c: i16) = with_context_plainly(gl) => gl.index(number::float(c));
    fn glIndexsv(c: *const i16) = with_context_plainly(gl) => { let [x] = memory::vector(c, number::float); gl.index(x) };
    fn glIndexub(c: u8) = with_context_plainly(gl) => gl.index(number::float(c));
    fn glIndexubv(c: *const u8) = with_context_plainly(gl) => { let [x] = memory::vector(c, number::float); gl.index(x) };
    fn glInitNames() = with_context(gl) => gl.init_names();
    fn glInterleavedArrays(format: u32, stride: i32, pointer: *const c_void) = with_context(gl) => gl.interleaved_arrays(format, stride, memory::pointer(pointer.cast()));
    fn glIsBuffer(buffer: u32) -> u8 = with_context(gl) => u8::from(gl.is_buffer(buffer));
    fn glIsBufferARB(buffer: u32) -> u8 = with_context(gl) => u8::from(gl.is_buffer(buffer));
    fn glIsEnabled(cap: u32) -> u8 = with_context(gl) => u8::from(gl.is_enabled(cap));
    fn glIsList(list: u32) -> u8 = with_context(gl) => u8::from(gl.is_list(list));
    fn glIsQuery(id: u32) -> u8 = with_context(gl) => u8::from(gl.is_query(id));
    fn glIsQueryARB(id: u32) -> u8 = with_context(gl) => u8::from(gl.is_query(id));
    fn glIsTexture(texture: u32) -> u8 = with_context(gl) => u8::from(gl.is_texture(texture));
    fn glIsTextureEXT(texture: u32) -> u8 = with_context(gl) => u8::from(gl.is_texture(texture));
    fn glLightModelf(pname: u32, param: f32) = with_context(gl) => gl.light_model(pname, Params::Floats(&[param]));
    fn glLightModelfv(pname: u32, params: *const f32) = with_context(gl) => gl.light_model(pname, Params::Floats(&memory::few(params, pname, number::float)));
    fn glLightModeli(pname: u32, param: i32) = with_context(gl) => gl.light_model(pname, Params::Ints(&[param]));
    fn glLightModeliv(pname: u32, params: *const i32) = with_context(gl) => gl.light_model(pname, Params::Ints(&memory::few(params, pname, number::int)));
    fn glLightf(light: u32, pname: u32, param: f32) = with_context(gl) => gl.light(light, pname, Params::Floats(&[param]));
    fn glLightfv(light: u32, pname: u32, params: *const f32) = with_context(gl) => gl.light(light, pname, Params::Floats(&memory::few(params, pname, number::float)));
    fn glLighti(light: u32, pname: u32, param: i32) = with_context(gl) => gl.light(light, pname, Params::Ints(&[param]));
    fn glLightiv(light: u32, pname: u32, params: *const i32) = with_context(gl) => gl.light(light, pname, Params::Ints(&memory::few(params, pname, number::int)));
    fn glLineStipple(factor: i32, pattern: u16) = with_context(gl) => gl.line_stipple(factor, pattern);
    fn glLineWidth(width: f32) = with_context(gl) => gl.line_width(width);
    fn glListBase(base: u32) = with_context(gl) => gl.list_base(base);
    fn glLoadIdentity() = with_context(gl) => gl.load_identity();
    fn glLoadMatrixd(m: *const f64) = with_context(gl) => gl.load_matrix(memory::vector(m, number::float));
    fn glLoadMatrixf(m: *const f32) = with_context(gl) => gl.load_matrix(memory::vector(m, number::float));
    fn glLoadName(name: u32) = with_context(gl) => gl.load_name(name);
    fn glLoadTransposeMatrixd(m: *const f64) = with_context(gl) => gl.load_transpose_matrix(memory::vector(m, number::float));
    fn glLoadTransposeMatrixdARB(m: *const f64) = with_context(gl) => gl.load_transpose_matrix(memory::vector(m, number::float));
    fn glLoadTransposeMatrixf(m: *const f32) = with_context(gl) => gl.load_transpose_matrix(memory::vector(m, number::float));
    fn glLoadTransposeMatrixfARB(m: *const f32) = with_context(gl) => gl.load_transpose_matrix(memory::vector(m, number::float));
    fn glLockArraysEXT(first: i32, count: i32) = with_context(gl) => gl.lock_arrays(first, count);
    fn glLogicOp(opcode: u32) = with_context(gl) => gl.logic_op(opcode);
    fn glMapBuffer(target: u32, access: u32) -> *mut c_void = with_context(gl) => special::map_buffer(gl, target, access);
    fn glMapBufferARB(target: u32, access: u32) -> *mut c_void = with_context(gl) => special::map_buffer(gl, target, access);
    fn glMapBufferOES(target: u32, access: u32) -> *mut c_void = with_context(gl) => special::map_buffer(gl, target, access);
    fn glMaterialf(face: u32, pname: u32, param: f32) = with_context(gl) => gl.material(face, pname, Params::Floats(&[param]));
    fn glMaterialfv(face: u32, pname: u32, params: *const f32) = with_context(gl) => gl.material(face, pname, Params::Floats(&memory::few(params, pname, number::float)));
    fn glMateriali(face: u32, pname: u32, param: i32) = with_context(gl) => gl.material(face, pname, Params::Ints(&[param]));
    fn glMaterialiv(face: u32, pname: u32, params: *const i32) = with_context(gl) => gl.material(face, pname, Params::Ints(&memory::few(params, pname, number::int)));
    fn glMatrixMode(mode: u32) = with_context(gl) => gl.matrix_mode(mode);
    fn glMultMatrixd(m: *const f64) = with_context(gl) => gl.mult_matrix(memory::vector(m, number::float));
    fn glMultMatrixf(m: *const f32) = with_context(gl) => gl.mult_matrix(memory::vector(m, number::float));
    fn glMultTransposeMatrixd(m: *const f64) = with_context(gl) => gl.mult_transpose_matrix(memory::vector(m, number::float));
    fn glMultTransposeMatrixdARB(m: *const f64) = with_context(gl) => gl.mult_transpose_matrix(memory::vector(m, number::float));
    fn glMultTransposeMatrixf(m: *const f32) = with_context(gl) => gl.mult_transpose_matrix(memory::vector(m, number::float));
    fn glMultTransposeMatrixfARB(m: *const f32) = with_context(gl) => gl.mult_transpose_matrix(memory::vector(m, number::float));
    fn glMultiDrawArrays(mode: u32, first: *const i32, count: *const i32, drawcount: i32) = with_context(gl) => if drawcount < 0 { gl.record_error(GL_INVALID_VALUE) } else { gl.multi_draw_arrays(mode, &memory::list(first, drawcount, number::int), &memory::list(count, drawcount, number::int)) };
    fn glMultiDrawArraysEXT(mode: u32, first: *const i32, count: *const i32, drawcount: i32) = with_context(gl) => if drawcount < 0 { gl.record_error(GL_INVALID_VALUE) } else { gl.multi_draw_arrays(mode, &memory::list(first, drawcount, number::int), &memory::list(count, drawcount, number::int)) };
    fn glMultiDrawElements(mode: u32, count: *const i32, r#type: u32, indices: *const *const c_void, drawcount: i32) = with_context(gl) => if drawcount < 0 { gl.record_error(GL_INVALID_VALUE) } else { gl.multi_draw_elements(mode, &memory::list(count, drawcount, number::int), r#type, memory::list(indices, drawcount, memory::pointer)) };
    fn glMultiDrawElementsEXT(mode: u32, count: *const i32, r#type: u32, indices: *const *const c_void, drawcount: i32) = with_context(gl) => if drawcount < 0 { gl.record_error(GL_INVALID_VALUE) } else { gl.multi_draw_elements(mode, &memory::list(count, drawcount, number::int), r#type, memory::list(indices, drawcount, memory::pointer)) };
    fn glMultiTexCoord1d(target: u32, s: f64) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), 0.0, 0.0, 1.0]);
    fn glMultiTexCoord1dARB(target: u32, s: f64) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), 0.0, 0.0, 1.0]);
    fn glMultiTexCoord1dv(target: u32, v: *const f64) = with_context_plainly(gl) => { let [x] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, 0.0, 0.0, 1.0]) };
    fn glMultiTexCoord1dvARB(target: u32, v: *const f64) = with_context_plainly(gl) => { let [x] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, 0.0, 0.0, 1.0]) };
    fn glMultiTexCoord1f(target: u32, s: f32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [s, 0.0, 0.0, 1.0]);
    fn glMultiTexCoord1fARB(target: u32, s: f32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [s, 0.0, 0.0, 1.0]);
    fn glMultiTexCoord1fv(target: u32, v: *const f32) = with_context_plainly(gl) => { let [x] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, 0.0, 0.0, 1.0]) };
    fn glMultiTexCoord1fvARB(target: u32, v: *const f32) = with_context_plainly(gl) => { let [x] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, 0.0, 0.0, 1.0]) };
    fn glMultiTexCoord1i(target: u32, s: i32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), 0.0, 0.0, 1.0]);
    fn glMultiTexCoord1iARB(target: u32, s: i32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), 0.0, 0.0, 1.0]);
    fn glMultiTexCoord1iv(target: u32, v: *const i32) = with_context_plainly(gl) => { let [x] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, 0.0, 0.0, 1.0]) };
    fn glMultiTexCoord1ivARB(target: u32, v: *const i32) = with_context_plainly(gl) => { let [x] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, 0.0, 0.0, 1.0]) };
    fn glMultiTexCoord1s(target: u32, s: i16) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), 0.0, 0.0, 1.0]);
    fn glMultiTexCoord1sARB(target: u32, s: i16) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), 0.0, 0.0, 1.0]);
    fn glMultiTexCoord1sv(target: u32, v: *const i16) = with_context_plainly(gl) => { let [x] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, 0.0, 0.0, 1.0]) };
    fn glMultiTexCoord1svARB(target: u32, v: *const i16) = with_context_plainly(gl) => { let [x] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, 0.0, 0.0, 1.0]) };
    fn glMultiTexCoord2d(target: u32, s: f64, t: f64) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), 0.0, 1.0]);
    fn glMultiTexCoord2dARB(target: u32, s: f64, t: f64) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), 0.0, 1.0]);
    fn glMultiTexCoord2dv(target: u32, v: *const f64) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, 0.0, 1.0]) };
    fn glMultiTexCoord2dvARB(target: u32, v: *const f64) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, 0.0, 1.0]) };
    fn glMultiTexCoord2f(target: u32, s: f32, t: f32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [s, t, 0.0, 1.0]);
    fn glMultiTexCoord2fARB(target: u32, s: f32, t: f32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [s, t, 0.0, 1.0]);
    fn glMultiTexCoord2fv(target: u32, v: *const f32) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, 0.0, 1.0]) };
    fn glMultiTexCoord2fvARB(target: u32, v: *const f32) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, 0.0, 1.0]) };
    fn glMultiTexCoord2i(target: u32, s: i32, t: i32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), 0.0, 1.0]);
    fn glMultiTexCoord2iARB(target: u32, s: i32, t: i32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), 0.0, 1.0]);
    fn glMultiTexCoord2iv(target: u32, v: *const i32) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, 0.0, 1.0]) };
    fn glMultiTexCoord2ivARB(target: u32, v: *const i32) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, 0.0, 1.0]) };
    fn glMultiTexCoord2s(target: u32, s: i16, t: i16) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), 0.0, 1.0]);
    fn glMultiTexCoord2sARB(target: u32, s: i16, t: i16) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), 0.0, 1.0]);
    fn glMultiTexCoord2sv(target: u32, v: *const i16) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, 0.0, 1.0]) };
    fn glMultiTexCoord2svARB(target: u32, v: *const i16) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, 0.0, 1.0]) };
    fn glMultiTexCoord3d(target: u32, s: f64, t: f64, r: f64) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), number::float(r), 1.0]);
    fn glMultiTexCoord3dARB(target: u32, s: f64, t: f64, r: f64) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), number::float(r), 1.0]);
    fn glMultiTexCoord3dv(target: u32, v: *const f64) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, 1.0]) };
    fn glMultiTexCoord3dvARB(target: u32, v: *const f64) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, 1.0]) };
    fn glMultiTexCoord3f(target: u32, s: f32, t: f32, r: f32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [s, t, r, 1.0]);
    fn glMultiTexCoord3fARB(target: u32, s: f32, t: f32, r: f32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [s, t, r, 1.0]);
    fn glMultiTexCoord3fv(target: u32, v: *const f32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, 1.0]) };
    fn glMultiTexCoord3fvARB(target: u32, v: *const f32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, 1.0]) };
    fn glMultiTexCoord3i(target: u32, s: i32, t: i32, r: i32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), number::float(r), 1.0]);
    fn glMultiTexCoord3iARB(target: u32, s: i32, t: i32, r: i32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), number::float(r), 1.0]);
    fn glMultiTexCoord3iv(target: u32, v: *const i32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, 1.0]) };
    fn glMultiTexCoord3ivARB(target: u32, v: *const i32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, 1.0]) };
    fn glMultiTexCoord3s(target: u32, s: i16, t: i16, r: i16) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), number::float(r), 1.0]);
    fn glMultiTexCoord3sARB(target: u32, s: i16, t: i16, r: i16) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), number::float(r), 1.0]);
    fn glMultiTexCoord3sv(target: u32, v: *const i16) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, 1.0]) };
    fn glMultiTexCoord3svARB(target: u32, v: *const i16) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, 1.0]) };
    fn glMultiTexCoord4d(target: u32, s: f64, t: f64, r: f64, q: f64) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), number::float(r), number::float(q)]);
    fn glMultiTexCoord4dARB(target: u32, s: f64, t: f64, r: f64, q: f64) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), number::float(r), number::float(q)]);
    fn glMultiTexCoord4dv(target: u32, v: *const f64) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, w]) };
    fn glMultiTexCoord4dvARB(target: u32, v: *const f64) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, w]) };
    fn glMultiTexCoord4f(target: u32, s: f32, t: f32, r: f32, q: f32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [s, t, r, q]);
    fn glMultiTexCoord4fARB(target: u32, s: f32, t: f32, r: f32, q: f32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [s, t, r, q]);
    fn glMultiTexCoord4fv(target: u32, v: *const f32) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, w]) };
    fn glMultiTexCoord4fvARB(target: u32, v: *const f32) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, w]) };
    fn glMultiTexCoord4i(target: u32, s: i32, t: i32, r: i32, q: i32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), number::float(r), number::float(q)]);
    fn glMultiTexCoord4iARB(target: u32, s: i32, t: i32, r: i32, q: i32) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), number::float(r), number::float(q)]);
    fn glMultiTexCoord4iv(target: u32, v: *const i32) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, w]) };
    fn glMultiTexCoord4ivARB(target: u32, v: *const i32) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, w]) };
    fn glMultiTexCoord4s(target: u32, s: i16, t: i16, r: i16, q: i16) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), number::float(r), number::float(q)]);
    fn glMultiTexCoord4sARB(target: u32, s: i16, t: i16, r: i16, q: i16) = with_context_plainly(gl) => gl.multi_tex_coord(target, [number::float(s), number::float(t), number::float(r), number::float(q)]);
    fn glMultiTexCoord4sv(target: u32, v: *const i16) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, w]) };
    fn glMultiTexCoord4svARB(target: u32, v: *const i16) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.multi_tex_coord(target, [x, y, z, w]) };
    fn glNewList(list: u32, mode: u32) = with_context(gl) => gl.new_list(list, mode);
    fn glNormal3b(nx: i8, ny: i8, nz: i8) = with_context_plainly(gl) => gl.normal([number::snorm8(nx), number::snorm8(ny), number::snorm8(nz)]);
    fn glNormal3bv(v: *const i8) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::snorm8); gl.normal([x, y, z]) };
    fn glNormal3d(nx: f64, ny: f64, nz: f64) = with_context_plainly(gl) => gl.normal([number::float(nx), number::float(ny), number::float(nz)]);
    fn glNormal3dv(v: *const f64) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.normal([x, y, z]) };
    fn glNormal3f(nx: f32, ny: f32, nz: f32) = with_context_plainly(gl) => gl.normal([nx, ny, nz]);
    fn glNormal3fv(v: *const f32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.normal([x, y, z]) };
    fn glNormal3i(nx: i32, ny: i32, nz: i32) = with_context_plainly(gl) => gl.normal([number::snorm32(nx), number::snorm32(ny), number::snorm32(nz)]);
    fn glNormal3iv(v: *const i32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::snorm32); gl.normal([x, y, z]) };
    fn glNormal3s(nx: i16, ny: i16, nz: i16) = with_context_plainly(gl) => gl.normal([number::snorm16(nx), number::snorm16(ny), number::snorm16(nz)]);
    fn glNormal3sv(v: *const i16) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::snorm16); gl.normal([x, y, z]) };
    fn glNormalPointer(r#type: u32, stride: i32, pointer: *const c_void) = with_context(gl) => gl.normal_pointer(r#type, stride, memory::pointer(pointer.cast()));
    fn glNormalPointerEXT(r#type: u32, stride: i32, count: i32, pointer: *const c_void) = with_context(gl) => gl.normal_pointer(r#type, stride, memory::pointer(pointer.cast()));
    fn glOrtho(left: f64, right: f64, bottom: f64, top: f64, zNear: f64, zFar: f64) = with_context(gl) => gl.ortho(left, right, bottom, top, zNear, zFar);
    fn glPassThrough(token: f32) = with_context(gl) => gl.pass_through(token);
    fn glPixelMapfv(map: u32, mapsize: i32, values: *const f32) = with_context(gl) => special::pixel_mapfv(gl, map, mapsize, values);
    fn glPixelMapuiv(map: u32, mapsize: i32, values: *const u32) = with_context(gl) => special::pixel_mapuiv(gl, map, mapsize, values);
    fn glPixelMapusv(map: u32, mapsize: i32, values: *const u16) = with_context(gl) => special::pixel_mapusv(gl, map, mapsize, values);
    fn glPixelStoref(pname: u32, param: f32) = with_context(gl) => gl.pixel_store(pname, param);
    fn glPixelStorei(pname: u32, param: i32) = with_context(gl) => gl.pixel_store(pname, number::float(param));
    fn glPixelTransferf(pname: u32, param: f32) = with_context(gl) => gl.pixel_transfer(pname, param);
    fn glPixelTransferi(pname: u32, param: i32) = with_context(gl) => gl.pixel_transfer(pname, number::float(param));
    fn glPixelZoom(xfactor: f32, yfactor: f32) = with_context(gl) => gl.pixel_zoom(xfactor, yfactor);
    fn glPointParameterf(pname: u32, param: f32) = with_context(gl) => gl.point_parameter(pname, Params::Floats(&[param]));
    fn glPointParameterfARB(pname: u32, param: f32) = with_context(gl) => gl.point_parameter(pname, Params::Floats(&[param]));
    fn glPointParameterfEXT(pname: u32, param: f32) = with_context(gl) => gl.point_parameter(pname, Params::Floats(&[param]));
    fn glPointParameterfSGIS(pname: u32, param: f32) = with_context(gl) => gl.point_parameter(pname, Params::Floats(&[param]));
    fn glPointParameterfv(pname: u32, params: *const f32) = with_context(gl) => gl.point_parameter(pname, Params::Floats(&memory::few(params, pname, number::float)));
    fn glPointParameterfvARB(pname: u32, params: *const f32) = with_context(gl) => gl.point_parameter(pname, Params::Floats(&memory::few(params, pname, number::float)));
    fn glPointParameterfvEXT(pname: u32, params: *const f32) = with_context(gl) => gl.point_parameter(pname, Params::Floats(&memory::few(params, pname, number::float)));
    fn glPointParameterfvSGIS(pname: u32, params: *const f32) = with_context(gl) => gl.point_parameter(pname, Params::Floats(&memory::few(params, pname, number::float)));
    fn glPointParameteri(pname: u32, param: i32) = with_context(gl) => gl.point_parameter(pname, Params::Ints(&[param]));
    fn glPointParameteriNV(pname: u32, param: i32) = with_context(gl) => gl.point_parameter(pname, Params::Ints(&[param]));
    fn glPointParameteriv(pname: u32, params: *const i32) = with_context(gl) => gl.point_parameter(pname, Params::Ints(&memory::few(params, pname, number::int)));
    fn glPointParameterivNV(pname: u32, params: *const i32) = with_context(gl) => gl.point_parameter(pname, Params::Ints(&memory::few(params, pname, number::int)));
    fn glPointSize(size: f32) = with_context(gl) => gl.point_size(size);
    fn glPolygonMode(face: u32, mode: u32) = with_context(gl) => gl.polygon_mode(face, mode);
    fn glPolygonModeNV(face: u32, mode: u32) = with_context(gl) => gl.polygon_mode(face, mode);
    fn glPolygonOffset(factor: f32, units: f32) = with_context(gl) => gl.polygon_offset(factor, units);
    fn glPolygonStipple(mask: *const u8) = with_context(gl) => special::polygon_stipple(gl, mask);
    fn glPopAttrib() = with_context(gl) => gl.pop_attrib();
    fn glPopClientAttrib() = with_context(gl) => gl.pop_client_attrib();
    fn glPopMatrix() = with_context(gl) => gl.pop_matrix();
    fn glPopName() = with_context(gl) => gl.pop_name();
    fn glPrioritizeTextures(n: i32, textures: *const u32, priorities: *const f32) = with_context(gl) => if n < 0 { gl.record_error(GL_INVALID_VALUE) } else { gl.prioritize_textures(&memory::list(textures, n, number::uint), &memory::list(priorities, n, number::float)) };
    fn glPrioritizeTexturesEXT(n: i32, textures: *const u32, priorities: *const f32) = with_context(gl) => if n < 0 { gl.record_error(GL_INVALID_VALUE) } else { gl.prioritize_textures(&memory::list(textures, n, number::uint), &memory::list(priorities, n, number::float)) };
    fn glPushAttrib(mask: u32) = with_context(gl) => gl.push_attrib(mask);
    fn glPushClientAttrib(mask: u32) = with_context(gl) => gl.push_client_attrib(mask);
    fn glPushMatrix() = with_context(gl) => gl.push_matrix();
    fn glPushName(name: u32) = with_context(gl) => gl.push_name(name);
    fn glRasterPos2d(x: f64, y: f64) = with_context(gl) => gl.raster_pos([number::float(x), number::float(y), 0.0, 1.0]);
    fn glRasterPos2dv(v: *const f64) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.raster_pos([x, y, 0.0, 1.0]) };
    fn glRasterPos2f(x: f32, y: f32) = with_context(gl) => gl.raster_pos([x, y, 0.0, 1.0]);
    fn glRasterPos2fv(v: *const f32) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.raster_pos([x, y, 0.0, 1.0]) };
    fn glRasterPos2i(x: i32, y: i32) = with_context(gl) => gl.raster_pos([number::float(x), number::float(y), 0.0, 1.0]);
    fn glRasterPos2iv(v: *const i32) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.raster_pos([x, y, 0.0, 1.0]) };
    fn glRasterPos2s(x: i16, y: i16) = with_context(gl) => gl.raster_pos([number::float(x), number::float(y), 0.0, 1.0]);
    fn glRasterPos2sv(v: *const i16) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.raster_pos([x, y, 0.0, 1.0]) };
    fn glRasterPos3d(x: f64, y: f64, z: f64) = with_context(gl) => gl.raster_pos([number::float(x), number::float(y), number::float(z), 1.0]);
    fn glRasterPos3dv(v: *const f64) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.raster_pos([x, y, z, 1.0]) };
    fn glRasterPos3f(x: f32, y: f32, z: f32) = with_context(gl) => gl.raster_pos([x, y, z, 1.0]);
    fn glRasterPos3fv(v: *const f32) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.raster_pos([x, y, z, 1.0]) };
    fn glRasterPos3i(x: i32, y: i32, z: i32) = with_context(gl) => gl.raster_pos([number::float(x), number::float(y), number::float(z), 1.0]);
    fn glRasterPos3iv(v: *const i32) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.raster_pos([x, y, z, 1.0]) };
    fn glRasterPos3s(x: i16, y: i16, z: i16) = with_context(gl) => gl.raster_pos([number::float(x), number::float(y), number::float(z), 1.0]);
    fn glRasterPos3sv(v: *const i16) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.raster_pos([x, y, z, 1.0]) };
    fn glRasterPos4d(x: f64, y: f64, z: f64, w: f64) = with_context(gl) => gl.raster_pos([number::float(x), number::float(y), number::float(z), number::float(w)]);
    fn glRasterPos4dv(v: *const f64) = with_context(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.raster_pos([x, y, z, w]) };
    fn glRasterPos4f(x: f32, y: f32, z: f32, w: f32) = with_context(gl) => gl.raster_pos([x, y, z, w]);
    fn glRasterPos4fv(v: *const f32) = with_context(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.raster_pos([x, y, z, w]) };
    fn glRasterPos4i(x: i32, y: i32, z: i32, w: i32) = with_context(gl) => gl.raster_pos([number::float(x), number::float(y), number::float(z), number::float(w)]);
    fn glRasterPos4iv(v: *const i32) = with_context(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.raster_pos([x, y, z, w]) };
    fn glRasterPos4s(x: i16, y: i16, z: i16, w: i16) = with_context(gl) => gl.raster_pos([number::float(x), number::float(y), number::float(z), number::float(w)]);
    fn glRasterPos4sv(v: *const i16) = with_context(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.raster_pos([x, y, z, w]) };
    fn glReadBuffer(src: u32) = with_context(gl) => gl.read_buffer(src);
    fn glReadPixels(x: i32, y: i32, width: i32, height: i32, format: u32, r#type: u32, pixels: *mut c_void) = with_context(gl) => special::read_pixels(gl, x, y, width, height, format, r#type, pixels);
    fn glRectd(x1: f64, y1: f64, x2: f64, y2: f64) = with_context(gl) => gl.rect([number::float(x1), number::float(y1)], [number::float(x2), number::float(y2)]);
    fn glRectdv(v1: *const f64, v2: *const f64) = with_context(gl) => gl.rect(memory::vector(v1, number::float), memory::vector(v2, number::float));
    fn glRectf(x1: f32, y1: f32, x2: f32, y2: f32) = with_context(gl) => gl.rect([x1, y1], [x2, y2]);
    fn glRectfv(v1: *const f32, v2: *const f32) = with_context(gl) => gl.rect(memory::vector(v1, number::float), memory::vector(v2, number::float));
    fn glRecti(x1: i32, y1: i32, x2: i32, y2: i32) = with_context(gl) => gl.rect([number::float(x1), number::float(y1)], [number::float(x2), number::float(y2)]);
    fn glRectiv(v1: *const i32, v2: *const i32) = with_context(gl) => gl.rect(memory::vector(v1, number::float), memory::vector(v2, number::float));
    fn glRects(x1: i16, y1: i16, x2: i16, y2: i16) = with_context(gl) => gl.rect([number::float(x1), number::float(y1)], [number::float(x2), number::float(y2)]);
    fn glRectsv(v1: *const i16, v2: *const i16) = with_context(gl) => gl.rect(memory::vector(v1, number::float), memory::vector(v2, number::float));
    fn glRenderMode(mode: u32) -> i32 = with_context(gl) => gl.render_mode(mode);
    fn glRotated(angle: f64, x: f64, y: f64, z: f64) = with_context(gl) => gl.rotate(number::float(angle), number::float(x), number::float(y), number::float(z));
    fn glRotatef(angle: f32, x: f32, y: f32, z: f32) = with_context(gl) => gl.rotate(angle, x, y, z);
    fn glSampleCoverage(value: f32, invert: u8) = with_context(gl) => gl.sample_coverage(value, number::boolean(invert));
    fn glSampleCoverageARB(value: f32, invert: u8) = with_context(gl) => gl.sample_coverage(value, number::boolean(invert));
    fn glScaled(x: f64, y: f64, z: f64) = with_context(gl) => gl.scale(number::float(x), number::float(y), number::float(z));
    fn glScalef(x: f32, y: f32, z: f32) = with_context(gl) => gl.scale(x, y, z);
    fn glSceneClassAFTERGLOW(sceneClass: u32) = with_context(gl) => gl.scene_class(sceneClass);
    fn glSceneCutAFTERGLOW() = with_context(gl) => gl.scene_cut();
    fn glSceneDefaultsAFTERGLOW() = with_context(gl) => gl.scene_defaults();
    fn glSceneDirectionalLightAFTERGLOW(light: u64, direction: *const f32, irradiance: *const f32, angle: f32) = with_context(gl) => gl.scene_directional_light(light, memory::vector(direction, number::float), memory::vector(irradiance, number::float), angle);
    fn glSceneEmissionAFTERGLOW(red: f32, green: f32, blue: f32) = with_context(gl) => gl.scene_emission(red, green, blue);
    fn glSceneMapAFTERGLOW(map: u32, texture: u32) = with_context(gl) => gl.scene_map(map, texture);
    fn glSceneMaterialAFTERGLOW(roughness: f32, metallic: f32) = with_context(gl) => gl.scene_material(roughness, metallic);
    fn glSceneObjectAFTERGLOW(object: u64) = with_context(gl) => gl.scene_object(object);
    fn glScenePointLightAFTERGLOW(light: u64, position: *const f32, intensity: *const f32, radius: f32) = with_context(gl) => gl.scene_point_light(light, memory::vector(position, number::float), memory::vector(intensity, number::float), radius);
    fn glSceneSkyAFTERGLOW(red: f32, green: f32, blue: f32) = with_context(gl) => gl.scene_sky(red, green, blue);
    fn glSceneSpotLightAFTERGLOW(light: u64, position: *const f32, direction: *const f32, intensity: *const f32, radius: f32, cutoff: f32, exponent: f32) = with_context(gl) => gl.scene_spot_light(light, memory::vector(position, number::float), memory::vector(direction, number::float), memory::vector(intensity, number::float), radius, cutoff, exponent);
    fn glSceneViewAFTERGLOW() = with_context(gl) => gl.scene_view();
    fn glScissor(x: i32, y: i32, width: i32, height: i32) = with_context(gl) => gl.scissor(x, y, width, height);
    fn glSecondaryColor3b(red: i8, green: i8, blue: i8) = with_context_plainly(gl) => gl.secondary_color([number::snorm8(red), number::snorm8(green), number::snorm8(blue), 1.0]);
    fn glSecondaryColor3bEXT(red: i8, green: i8, blue: i8) = with_context_plainly(gl) => gl.secondary_color([number::snorm8(red), number::snorm8(green), number::snorm8(blue), 1.0]);
    fn glSecondaryColor3bv(v: *const i8) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::snorm8); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3bvEXT(v: *const i8) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::snorm8); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3d(red: f64, green: f64, blue: f64) = with_context_plainly(gl) => gl.secondary_color([number::float(red), number::float(green), number::float(blue), 1.0]);
    fn glSecondaryColor3dEXT(red: f64, green: f64, blue: f64) = with_context_plainly(gl) => gl.secondary_color([number::float(red), number::float(green), number::float(blue), 1.0]);
    fn glSecondaryColor3dv(v: *const f64) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3dvEXT(v: *const f64) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3f(red: f32, green: f32, blue: f32) = with_context_plainly(gl) => gl.secondary_color([red, green, blue, 1.0]);
    fn glSecondaryColor3fEXT(red: f32, green: f32, blue: f32) = with_context_plainly(gl) => gl.secondary_color([red, green, blue, 1.0]);
    fn glSecondaryColor3fv(v: *const f32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3fvEXT(v: *const f32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3i(red: i32, green: i32, blue: i32) = with_context_plainly(gl) => gl.secondary_color([number::snorm32(red), number::snorm32(green), number::snorm32(blue), 1.0]);
    fn glSecondaryColor3iEXT(red: i32, green: i32, blue: i32) = with_context_plainly(gl) => gl.secondary_color([number::snorm32(red), number::snorm32(green), number::snorm32(blue), 1.0]);
    fn glSecondaryColor3iv(v: *const i32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::snorm32); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3ivEXT(v: *const i32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::snorm32); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3s(red: i16, green: i16, blue: i16) = with_context_plainly(gl) => gl.secondary_color([number::snorm16(red), number::snorm16(green), number::snorm16(blue), 1.0]);
    fn glSecondaryColor3sEXT(red: i16, green: i16, blue: i16) = with_context_plainly(gl) => gl.secondary_color([number::snorm16(red), number::snorm16(green), number::snorm16(blue), 1.0]);
    fn glSecondaryColor3sv(v: *const i16) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::snorm16); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3svEXT(v: *const i16) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::snorm16); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3ub(red: u8, green: u8, blue: u8) = with_context_plainly(gl) => gl.secondary_color([number::unorm8(red), number::unorm8(green), number::unorm8(blue), 1.0]);
    fn glSecondaryColor3ubEXT(red: u8, green: u8, blue: u8) = with_context_plainly(gl) => gl.secondary_color([number::unorm8(red), number::unorm8(green), number::unorm8(blue), 1.0]);
    fn glSecondaryColor3ubv(v: *const u8) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::unorm8); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3ubvEXT(v: *const u8) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::unorm8); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3ui(red: u32, green: u32, blue: u32) = with_context_plainly(gl) => gl.secondary_color([number::unorm32(red), number::unorm32(green), number::unorm32(blue), 1.0]);
    fn glSecondaryColor3uiEXT(red: u32, green: u32, blue: u32) = with_context_plainly(gl) => gl.secondary_color([number::unorm32(red), number::unorm32(green), number::unorm32(blue), 1.0]);
    fn glSecondaryColor3uiv(v: *const u32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::unorm32); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3uivEXT(v: *const u32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::unorm32); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3us(red: u16, green: u16, blue: u16) = with_context_plainly(gl) => gl.secondary_color([number::unorm16(red), number::unorm16(green), number::unorm16(blue), 1.0]);
    fn glSecondaryColor3usEXT(red: u16, green: u16, blue: u16) = with_context_plainly(gl) => gl.secondary_color([number::unorm16(red), number::unorm16(green), number::unorm16(blue), 1.0]);
    fn glSecondaryColor3usv(v: *const u16) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::unorm16); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColor3usvEXT(v: *const u16) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::unorm16); gl.secondary_color([x, y, z, 1.0]) };
    fn glSecondaryColorPointer(size: i32, r#type: u32, stride: i32, pointer: *const c_void) = with_context(gl) => gl.secondary_color_pointer(size, r#type, stride, memory::pointer(pointer.cast()));
    fn glSecondaryColorPointerEXT(size: i32, r#type: u32, stride: i32, pointer: *const c_void) = with_context(gl) => gl.secondary_color_pointer(size, r#type, stride, memory::pointer(pointer.cast()));
    fn glShadeModel(mode: u32) = with_context(gl) => gl.shade_model(mode);
    fn glStencilFunc(func: u32, r#ref: i32, mask: u32) = with_context(gl) => gl.stencil_func(func, r#ref, mask);
    fn glStencilMask(mask: u32) = with_context(gl) => gl.stencil_mask(mask);
    fn glStencilOp(fail: u32, zfail: u32, zpass: u32) = with_context(gl) => gl.stencil_op(fail, zfail, zpass);
    fn glTexCoord1d(s: f64) = with_context_plainly(gl) => gl.tex_coord([number::float(s), 0.0, 0.0, 1.0]);
    fn glTexCoord1dv(v: *const f64) = with_context_plainly(gl) => { let [x] = memory::vector(v, number::float); gl.tex_coord([x, 0.0, 0.0, 1.0]) };
    fn glTexCoord1f(s: f32) = with_context_plainly(gl) => gl.tex_coord([s, 0.0, 0.0, 1.0]);
    fn glTexCoord1fv(v: *const f32) = with_context_plainly(gl) => { let [x] = memory::vector(v, number::float); gl.tex_coord([x, 0.0, 0.0, 1.0]) };
    fn glTexCoord1i(s: i32) = with_context_plainly(gl) => gl.tex_coord([number::float(s), 0.0, 0.0, 1.0]);
    fn glTexCoord1iv(v: *const i32) = with_context_plainly(gl) => { let [x] = memory::vector(v, number::float); gl.tex_coord([x, 0.0, 0.0, 1.0]) };
    fn glTexCoord1s(s: i16) = with_context_plainly(gl) => gl.tex_coord([number::float(s), 0.0, 0.0, 1.0]);
    fn glTexCoord1sv(v: *const i16) = with_context_plainly(gl) => { let [x] = memory::vector(v, number::float); gl.tex_coord([x, 0.0, 0.0, 1.0]) };
    fn glTexCoord2d(s: f64, t: f64) = with_context_plainly(gl) => gl.tex_coord([number::float(s), number::float(t), 0.0, 1.0]);
    fn glTexCoord2dv(v: *const f64) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.tex_coord([x, y, 0.0, 1.0]) };
    fn glTexCoord2f(s: f32, t: f32) = with_context_plainly(gl) => gl.tex_coord([s, t, 0.0, 1.0]);
    fn glTexCoord2fv(v: *const f32) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.tex_coord([x, y, 0.0, 1.0]) };
    fn glTexCoord2i(s: i32, t: i32) = with_context_plainly(gl) => gl.tex_coord([number::float(s), number::float(t), 0.0, 1.0]);
    fn glTexCoord2iv(v: *const i32) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.tex_coord([x, y, 0.0, 1.0]) };
    fn glTexCoord2s(s: i16, t: i16) = with_context_plainly(gl) => gl.tex_coord([number::float(s), number::float(t), 0.0, 1.0]);
    fn glTexCoord2sv(v: *const i16) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.tex_coord([x, y, 0.0, 1.0]) };
    fn glTexCoord3d(s: f64, t: f64, r: f64) = with_context_plainly(gl) => gl.tex_coord([number::float(s), number::float(t), number::float(r), 1.0]);
    fn glTexCoord3dv(v: *const f64) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.tex_coord([x, y, z, 1.0]) };
    fn glTexCoord3f(s: f32, t: f32, r: f32) = with_context_plainly(gl) => gl.tex_coord([s, t, r, 1.0]);
    fn glTexCoord3fv(v: *const f32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.tex_coord([x, y, z, 1.0]) };
    fn glTexCoord3i(s: i32, t: i32, r: i32) = with_context_plainly(gl) => gl.tex_coord([number::float(s), number::float(t), number::float(r), 1.0]);
    fn glTexCoord3iv(v: *const i32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.tex_coord([x, y, z, 1.0]) };
    fn glTexCoord3s(s: i16, t: i16, r: i16) = with_context_plainly(gl) => gl.tex_coord([number::float(s), number::float(t), number::float(r), 1.0]);
    fn glTexCoord3sv(v: *const i16) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.tex_coord([x, y, z, 1.0]) };
    fn glTexCoord4d(s: f64, t: f64, r: f64, q: f64) = with_context_plainly(gl) => gl.tex_coord([number::float(s), number::float(t), number::float(r), number::float(q)]);
    fn glTexCoord4dv(v: *const f64) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.tex_coord([x, y, z, w]) };
    fn glTexCoord4f(s: f32, t: f32, r: f32, q: f32) = with_context_plainly(gl) => gl.tex_coord([s, t, r, q]);
    fn glTexCoord4fv(v: *const f32) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.tex_coord([x, y, z, w]) };
    fn glTexCoord4i(s: i32, t: i32, r: i32, q: i32) = with_context_plainly(gl) => gl.tex_coord([number::float(s), number::float(t), number::float(r), number::float(q)]);
    fn glTexCoord4iv(v: *const i32) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.tex_coord([x, y, z, w]) };
    fn glTexCoord4s(s: i16, t: i16, r: i16, q: i16) = with_context_plainly(gl) => gl.tex_coord([number::float(s), number::float(t), number::float(r), number::float(q)]);
    fn glTexCoord4sv(v: *const i16) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.tex_coord([x, y, z, w]) };
    fn glTexCoordPointer(size: i32, r#type: u32, stride: i32, pointer: *const c_void) = with_context(gl) => gl.tex_coord_pointer(size, r#type, stride, memory::pointer(pointer.cast()));
    fn glTexCoordPointerEXT(size: i32, r#type: u32, stride: i32, count: i32, pointer: *const c_void) = with_context(gl) => gl.tex_coord_pointer(size, r#type, stride, memory::pointer(pointer.cast()));
    fn glTexEnvf(target: u32, pname: u32, param: f32) = with_context(gl) => gl.tex_env(target, pname, Params::Floats(&[param]));
    fn glTexEnvfv(target: u32, pname: u32, params: *const f32) = with_context(gl) => gl.tex_env(target, pname, Params::Floats(&memory::few(params, pname, number::float)));
    fn glTexEnvi(target: u32, pname: u32, param: i32) = with_context(gl) => gl.tex_env(target, pname, Params::Ints(&[param]));
    fn glTexEnviv(target: u32, pname: u32, params: *const i32) = with_context(gl) => gl.tex_env(target, pname, Params::Ints(&memory::few(params, pname, number::int)));
    fn glTexGend(coord: u32, pname: u32, param: f64) = with_context(gl) => gl.tex_gen(coord, pname, Params::Floats(&[number::float(param)]));
    fn glTexGendv(coord: u32, pname: u32, params: *const f64) = with_context(gl) => gl.tex_gen(coord, pname, Params::Floats(&memory::few(params, pname, number::float)));
    fn glTexGenf(coord: u32, pname: u32, param: f32) = with_context(gl) => gl.tex_gen(coord, pname, Params::Floats(&[param]));
    fn glTexGenfv(coord: u32, pname: u32, params: *const f32) = with_context(gl) => gl.tex_gen(coord, pname, Params::Floats(&memory::few(params, pname, number::float)));
    fn glTexGeni(coord: u32, pname: u32, param: i32) = with_context(gl) => gl.tex_gen(coord, pname, Params::Ints(&[param]));
    fn glTexGeniv(coord: u32, pname: u32, params: *const i32) = with_context(gl) => gl.tex_gen(coord, pname, Params::Ints(&memory::few(params, pname, number::int)));
    fn glTexImage1D(target: u32, level: i32, internalformat: i32, width: i32, border: i32, format: u32, r#type: u32, pixels: *const c_void) = with_context(gl) => special::tex_image_1d(gl, target, level, internalformat, width, border, format, r#type, pixels);
    fn glTexImage2D(target: u32, level: i32, internalformat: i32, width: i32, height: i32, border: i32, format: u32, r#type: u32, pixels: *const c_void) = with_context(gl) => special::tex_image_2d(gl, target, level, internalformat, width, height, border, format, r#type, pixels);
    fn glTexImage3D(target: u32, level: i32, internalformat: i32, width: i32, height: i32, depth: i32, border: i32, format: u32, r#type: u32, pixels: *const c_void) = with_context(gl) => special::tex_image_3d(gl, target, level, internalformat, width, height, depth, border, format, r#type, pixels);
    fn glTexImage3DEXT(target: u32, level: i32, internalformat: i32, width: i32, height: i32, depth: i32, border: i32, format: u32, r#type: u32, pixels: *const c_void) = with_context(gl) => special::tex_image_3d(gl, target, level, internalformat, width, height, depth, border, format, r#type, pixels);
    fn glTexParameterf(target: u32, pname: u32, param: f32) = with_context(gl) => gl.tex_parameter(target, pname, Params::Floats(&[param]));
    fn glTexParameterfv(target: u32, pname: u32, params: *const f32) = with_context(gl) => gl.tex_parameter(target, pname, Params::Floats(&memory::few(params, pname, number::float)));
    fn glTexParameteri(target: u32, pname: u32, param: i32) = with_context(gl) => gl.tex_parameter(target, pname, Params::Ints(&[param]));
    fn glTexParameteriv(target: u32, pname: u32, params: *const i32) = with_context(gl) => gl.tex_parameter(target, pname, Params::Ints(&memory::few(params, pname, number::int)));
    fn glTexSubImage1D(target: u32, level: i32, xoffset: i32, width: i32, format: u32, r#type: u32, pixels: *const c_void) = with_context(gl) => special::tex_sub_image_1d(gl, target, level, xoffset, width, format, r#type, pixels);
    fn glTexSubImage1DEXT(target: u32, level: i32, xoffset: i32, width: i32, format: u32, r#type: u32, pixels: *const c_void) = with_context(gl) => special::tex_sub_image_1d(gl, target, level, xoffset, width, format, r#type, pixels);
    fn glTexSubImage2D(target: u32, level: i32, xoffset: i32, yoffset: i32, width: i32, height: i32, format: u32, r#type: u32, pixels: *const c_void) = with_context(gl) => special::tex_sub_image_2d(gl, target, level, xoffset, yoffset, width, height, format, r#type, pixels);
    fn glTexSubImage2DEXT(target: u32, level: i32, xoffset: i32, yoffset: i32, width: i32, height: i32, format: u32, r#type: u32, pixels: *const c_void) = with_context(gl) => special::tex_sub_image_2d(gl, target, level, xoffset, yoffset, width, height, format, r#type, pixels);
    fn glTexSubImage3D(target: u32, level: i32, xoffset: i32, yoffset: i32, zoffset: i32, width: i32, height: i32, depth: i32, format: u32, r#type: u32, pixels: *const c_void) = with_context(gl) => special::tex_sub_image_3d(gl, target, level, xoffset, yoffset, zoffset, width, height, depth, format, r#type, pixels);
    fn glTexSubImage3DEXT(target: u32, level: i32, xoffset: i32, yoffset: i32, zoffset: i32, width: i32, height: i32, depth: i32, format: u32, r#type: u32, pixels: *const c_void) = with_context(gl) => special::tex_sub_image_3d(gl, target, level, xoffset, yoffset, zoffset, width, height, depth, format, r#type, pixels);
    fn glTranslated(x: f64, y: f64, z: f64) = with_context(gl) => gl.translate(number::float(x), number::float(y), number::float(z));
    fn glTranslatef(x: f32, y: f32, z: f32) = with_context(gl) => gl.translate(x, y, z);
    fn glUnlockArraysEXT() = with_context(gl) => gl.unlock_arrays();
    fn glUnmapBuffer(target: u32) -> u8 = with_context(gl) => u8::from(gl.unmap_buffer(target));
    fn glUnmapBufferARB(target: u32) -> u8 = with_context(gl) => u8::from(gl.unmap_buffer(target));
    fn glUnmapBufferOES(target: u32) -> u8 = with_context(gl) => u8::from(gl.unmap_buffer(target));
    fn glVertex2d(x: f64, y: f64) = with_context_plainly(gl) => gl.vertex([number::float(x), number::float(y), 0.0, 1.0]);
    fn glVertex2dv(v: *const f64) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.vertex([x, y, 0.0, 1.0]) };
    fn glVertex2f(x: f32, y: f32) = with_context_plainly(gl) => gl.vertex([x, y, 0.0, 1.0]);
    fn glVertex2fv(v: *const f32) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.vertex([x, y, 0.0, 1.0]) };
    fn glVertex2i(x: i32, y: i32) = with_context_plainly(gl) => gl.vertex([number::float(x), number::float(y), 0.0, 1.0]);
    fn glVertex2iv(v: *const i32) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.vertex([x, y, 0.0, 1.0]) };
    fn glVertex2s(x: i16, y: i16) = with_context_plainly(gl) => gl.vertex([number::float(x), number::float(y), 0.0, 1.0]);
    fn glVertex2sv(v: *const i16) = with_context_plainly(gl) => { let [x, y] = memory::vector(v, number::float); gl.vertex([x, y, 0.0, 1.0]) };
    fn glVertex3d(x: f64, y: f64, z: f64) = with_context_plainly(gl) => gl.vertex([number::float(x), number::float(y), number::float(z), 1.0]);
    fn glVertex3dv(v: *const f64) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.vertex([x, y, z, 1.0]) };
    fn glVertex3f(x: f32, y: f32, z: f32) = with_context_plainly(gl) => gl.vertex([x, y, z, 1.0]);
    fn glVertex3fv(v: *const f32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.vertex([x, y, z, 1.0]) };
    fn glVertex3i(x: i32, y: i32, z: i32) = with_context_plainly(gl) => gl.vertex([number::float(x), number::float(y), number::float(z), 1.0]);
    fn glVertex3iv(v: *const i32) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.vertex([x, y, z, 1.0]) };
    fn glVertex3s(x: i16, y: i16, z: i16) = with_context_plainly(gl) => gl.vertex([number::float(x), number::float(y), number::float(z), 1.0]);
    fn glVertex3sv(v: *const i16) = with_context_plainly(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.vertex([x, y, z, 1.0]) };
    fn glVertex4d(x: f64, y: f64, z: f64, w: f64) = with_context_plainly(gl) => gl.vertex([number::float(x), number::float(y), number::float(z), number::float(w)]);
    fn glVertex4dv(v: *const f64) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.vertex([x, y, z, w]) };
    fn glVertex4f(x: f32, y: f32, z: f32, w: f32) = with_context_plainly(gl) => gl.vertex([x, y, z, w]);
    fn glVertex4fv(v: *const f32) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.vertex([x, y, z, w]) };
    fn glVertex4i(x: i32, y: i32, z: i32, w: i32) = with_context_plainly(gl) => gl.vertex([number::float(x), number::float(y), number::float(z), number::float(w)]);
    fn glVertex4iv(v: *const i32) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.vertex([x, y, z, w]) };
    fn glVertex4s(x: i16, y: i16, z: i16, w: i16) = with_context_plainly(gl) => gl.vertex([number::float(x), number::float(y), number::float(z), number::float(w)]);
    fn glVertex4sv(v: *const i16) = with_context_plainly(gl) => { let [x, y, z, w] = memory::vector(v, number::float); gl.vertex([x, y, z, w]) };
    fn glVertexPointer(size: i32, r#type: u32, stride: i32, pointer: *const c_void) = with_context(gl) => gl.vertex_pointer(size, r#type, stride, memory::pointer(pointer.cast()));
    fn glVertexPointerEXT(size: i32, r#type: u32, stride: i32, count: i32, pointer: *const c_void) = with_context(gl) => gl.vertex_pointer(size, r#type, stride, memory::pointer(pointer.cast()));
    fn glViewport(x: i32, y: i32, width: i32, height: i32) = with_context(gl) => special::viewport(gl, x, y, width, height);
    fn glWindowPos2d(x: f64, y: f64) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), 0.0]);
    fn glWindowPos2dARB(x: f64, y: f64) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), 0.0]);
    fn glWindowPos2dMESA(x: f64, y: f64) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), 0.0]);
    fn glWindowPos2dv(v: *const f64) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.window_pos([x, y, 0.0]) };
    fn glWindowPos2dvARB(v: *const f64) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.window_pos([x, y, 0.0]) };
    fn glWindowPos2dvMESA(v: *const f64) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.window_pos([x, y, 0.0]) };
    fn glWindowPos2f(x: f32, y: f32) = with_context(gl) => gl.window_pos([x, y, 0.0]);
    fn glWindowPos2fARB(x: f32, y: f32) = with_context(gl) => gl.window_pos([x, y, 0.0]);
    fn glWindowPos2fMESA(x: f32, y: f32) = with_context(gl) => gl.window_pos([x, y, 0.0]);
    fn glWindowPos2fv(v: *const f32) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.window_pos([x, y, 0.0]) };
    fn glWindowPos2fvARB(v: *const f32) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.window_pos([x, y, 0.0]) };
    fn glWindowPos2fvMESA(v: *const f32) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.window_pos([x, y, 0.0]) };
    fn glWindowPos2i(x: i32, y: i32) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), 0.0]);
    fn glWindowPos2iARB(x: i32, y: i32) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), 0.0]);
    fn glWindowPos2iMESA(x: i32, y: i32) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), 0.0]);
    fn glWindowPos2iv(v: *const i32) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.window_pos([x, y, 0.0]) };
    fn glWindowPos2ivARB(v: *const i32) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.window_pos([x, y, 0.0]) };
    fn glWindowPos2ivMESA(v: *const i32) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.window_pos([x, y, 0.0]) };
    fn glWindowPos2s(x: i16, y: i16) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), 0.0]);
    fn glWindowPos2sARB(x: i16, y: i16) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), 0.0]);
    fn glWindowPos2sMESA(x: i16, y: i16) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), 0.0]);
    fn glWindowPos2sv(v: *const i16) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.window_pos([x, y, 0.0]) };
    fn glWindowPos2svARB(v: *const i16) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.window_pos([x, y, 0.0]) };
    fn glWindowPos2svMESA(v: *const i16) = with_context(gl) => { let [x, y] = memory::vector(v, number::float); gl.window_pos([x, y, 0.0]) };
    fn glWindowPos3d(x: f64, y: f64, z: f64) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), number::float(z)]);
    fn glWindowPos3dARB(x: f64, y: f64, z: f64) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), number::float(z)]);
    fn glWindowPos3dMESA(x: f64, y: f64, z: f64) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), number::float(z)]);
    fn glWindowPos3dv(v: *const f64) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.window_pos([x, y, z]) };
    fn glWindowPos3dvARB(v: *const f64) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.window_pos([x, y, z]) };
    fn glWindowPos3dvMESA(v: *const f64) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.window_pos([x, y, z]) };
    fn glWindowPos3f(x: f32, y: f32, z: f32) = with_context(gl) => gl.window_pos([x, y, z]);
    fn glWindowPos3fARB(x: f32, y: f32, z: f32) = with_context(gl) => gl.window_pos([x, y, z]);
    fn glWindowPos3fMESA(x: f32, y: f32, z: f32) = with_context(gl) => gl.window_pos([x, y, z]);
    fn glWindowPos3fv(v: *const f32) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.window_pos([x, y, z]) };
    fn glWindowPos3fvARB(v: *const f32) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.window_pos([x, y, z]) };
    fn glWindowPos3fvMESA(v: *const f32) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.window_pos([x, y, z]) };
    fn glWindowPos3i(x: i32, y: i32, z: i32) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), number::float(z)]);
    fn glWindowPos3iARB(x: i32, y: i32, z: i32) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), number::float(z)]);
    fn glWindowPos3iMESA(x: i32, y: i32, z: i32) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), number::float(z)]);
    fn glWindowPos3iv(v: *const i32) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.window_pos([x, y, z]) };
    fn glWindowPos3ivARB(v: *const i32) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.window_pos([x, y, z]) };
    fn glWindowPos3ivMESA(v: *const i32) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.window_pos([x, y, z]) };
    fn glWindowPos3s(x: i16, y: i16, z: i16) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), number::float(z)]);
    fn glWindowPos3sARB(x: i16, y: i16, z: i16) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), number::float(z)]);
    fn glWindowPos3sMESA(x: i16, y: i16, z: i16) = with_context(gl) => gl.window_pos([number::float(x), number::float(y), number::float(z)]);
    fn glWindowPos3sv(v: *const i16) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.window_pos([x, y, z]) };
    fn glWindowPos3svARB(v: *const i16) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.window_pos([x, y, z]) };
    fn glWindowPos3svMESA(v: *const i16) = with_context(gl) => { let [x, y, z] = memory::vector(v, number::float); gl.window_pos([x, y, z]) };
}

// In scope, but the context has no method for them.
refusals! {
    fn glActiveStencilFaceEXT(face: u32);
    fn glBlendEquationSeparate(modeRGB: u32, modeAlpha: u32);
    fn glBlendEquationSeparateEXT(modeRGB: u32, modeAlpha: u32);
    fn glColorTable(target: u32, internalformat: u32, width: i32, format: u32, r#type: u32, table: *const c_void);
    fn glColorTableEXT(target: u32, internalformat: u32, width: i32, format: u32, r#type: u32, table: *const c_void);
    fn glColorTableSGI(target: u32, internalformat: u32, width: i32, format: u32, r#type: u32, table: *const c_void);
    fn glEvalCoord1d(u: f64);
    fn glEvalCoord1dv(u: *const f64);
    fn glEvalCoord1f(u: f32);
    fn glEvalCoord1fv(u: *const f32);
    fn glEvalCoord2d(u: f64, v: f64);
    fn glEvalCoord2dv(u: *const f64);
    fn glEvalCoord2f(u: f32, v: f32);
    fn glEvalCoord2fv(u: *const f32);
    fn glEvalMesh1(mode: u32, i1: i32, i2: i32);
    fn glEvalMesh2(mode: u32, i1: i32, i2: i32, j1: i32, j2: i32);
    fn glEvalPoint1(i: i32);
    fn glEvalPoint2(i: i32, j: i32);
    fn glFeedbackBuffer(size: i32, r#type: u32, buffer: *mut f32);
    fn glGetColorTable(target: u32, format: u32, r#type: u32, table: *mut c_void);
    fn glGetColorTableEXT(target: u32, format: u32, r#type: u32, table: *mut c_void);
    fn glGetColorTableParameterfv(target: u32, pname: u32, params: *mut f32);
    fn glGetColorTableParameterfvEXT(target: u32, pname: u32, params: *mut f32);
    fn glGetColorTableParameteriv(target: u32, pname: u32, params: *mut i32);
    fn glGetColorTableParameterivEXT(target: u32, pname: u32, params: *mut i32);
    fn glGetMapdv(target: u32, query: u32, v: *mut f64);
    fn glGetMapfv(target: u32, query: u32, v: *mut f32);
    fn glGetMapiv(target: u32, query: u32, v: *mut i32);
    fn glMap1d(target: u32, u1: f64, u2: f64, stride: i32, order: i32, points: *const f64);
    fn glMap1f(target: u32, u1: f32, u2: f32, stride: i32, order: i32, points: *const f32);
    fn glMap2d(target: u32, u1: f64, u2: f64, ustride: i32, uorder: i32, v1: f64, v2: f64, vstride: i32, vorder: i32, points: *const f64);
    fn glMap2f(target: u32, u1: f32, u2: f32, ustride: i32, uorder: i32, v1: f32, v2: f32, vstride: i32, vorder: i32, points: *const f32);
    fn glMapGrid1d(un: i32, u1: f64, u2: f64);
    fn glMapGrid1f(un: i32, u1: f32, u2: f32);
    fn glMapGrid2d(un: i32, u1: f64, u2: f64, vn: i32, v1: f64, v2: f64);
    fn glMapGrid2f(un: i32, u1: f32, u2: f32, vn: i32, v1: f32, v2: f32);
    fn glPolygonOffsetEXT(factor: f32, bias: f32);
    fn glSelectBuffer(size: i32, buffer: *mut u32);
    fn glStencilFuncSeparateATI(frontfunc: u32, backfunc: u32, r#ref: i32, mask: u32);
    fn glStencilOpSeparate(face: u32, sfail: u32, dpfail: u32, dppass: u32);
    fn glStencilOpSeparateATI(face: u32, sfail: u32, dpfail: u32, dppass: u32);
    fn glWindowPos4dMESA(x: f64, y: f64, z: f64, w: f64);
    fn glWindowPos4dvMESA(v: *const f64);
    fn glWindowPos4fMESA(x: f32, y: f32, z: f32, w: f32);
    fn glWindowPos4fvMESA(v: *const f32);
    fn glWindowPos4iMESA(x: i32, y: i32, z: i32, w: i32);
    fn glWindowPos4ivMESA(v: *const i32);
    fn glWindowPos4sMESA(x: i16, y: i16, z: i16, w: i16);
    fn glWindowPos4svMESA(v: *const i16);
}

// Out of scope.
stubs! {
    glAccumxOES
    glAcquireKeyedMutexWin32EXT
    glActiveProgramEXT
    glActiveShaderProgram
    glActiveShaderProgramEXT
    glActiveVaryingNV
    glAlphaFragmentOp1ATI
    glAlphaFragmentOp2ATI
    glAlphaFragmentOp3ATI
    glAlphaFuncQCOM
    glAlphaFuncx
    glAlphaFuncxOES
    glAlphaToCoverageDitherControlNV
    glApplyFramebufferAttachmentCMAAINTEL
    glApplyTextureEXT
    glAreProgramsResidentNV
    glArrayObjectATI
    glAsyncCopyBufferSubDataNVX
    glAsyncCopyImageSubDataNVX
    glAsyncMarkerSGIX
    glAttachObjectARB
    glAttachShader
    glBeginConditionalRender
    glBeginConditionalRenderNV
    glBeginConditionalRenderNVX
    glBeginFragmentShaderATI
    glBeginOcclusionQueryNV
    glBeginPerfMonitorAMD
    glBeginPerfQueryINTEL
    glBeginQueryEXT
    glBeginQueryIndexed
    glBeginTransformFeedback
    glBeginTransformFeedbackEXT
    glBeginTransformFeedbackNV
    glBeginVertexShaderEXT
    glBeginVideoCaptureNV
    glBindANCCaptureStreamBufferNVX
    glBindAttribLocation
    glBindAttribLocationARB
    glBindBufferBase
    glBindBufferBaseEXT
    glBindBufferBaseNV
    glBindBufferOffsetEXT
    glBindBufferOffsetNV
    glBindBufferRange
    glBindBufferRangeEXT
    glBindBufferRangeNV
    glBindBuffersBase
    glBindBuffersRange
    glBindFragDataLocation
    glBindFragDataLocationEXT
    glBindFragDataLocationIndexed
    glBindFragDataLocationIndexedEXT
    glBindFragmentShaderATI
    glBindFramebuffer
    glBindFramebufferEXT
    glBindFramebufferOES
    glBindImageTexture
    glBindImageTextureEXT
    glBindImageTextures
    glBindLightParameterEXT
    glBindMaterialParameterEXT
    glBindMultiTextureEXT
    glBindParameterEXT
    glBindProgramARB
    glBindProgramNV
    glBindProgramPipeline
    glBindProgramPipelineEXT
    glBindRenderbuffer
    glBindRenderbufferEXT
    glBindRenderbufferOES
    glBindSampler
    glBindSamplers
    glBindShadingRateImageNV
    glBindTexGenParameterEXT
    glBindTextureUnit
    glBindTextureUnitParameterEXT
    glBindTextures
    glBindTransformFeedback
    glBindTransformFeedbackEXT
    glBindTransformFeedbackNV
    glBindVertexArray
    glBindVertexArrayAPPLE
    glBindVertexArrayOES
    glBindVertexBuffer
    glBindVertexBuffers
    glBindVertexShaderEXT
    glBindVideoCaptureStreamBufferNV
    glBindVideoCaptureStreamTextureNV
    glBinormal3bEXT
    glBinormal3bvEXT
    glBinormal3dEXT
    glBinormal3dvEXT
    glBinormal3fEXT
    glBinormal3fvEXT
    glBinormal3iEXT
    glBinormal3ivEXT
    glBinormal3sEXT
    glBinormal3svEXT
    glBinormalPointerEXT
    glBitmapxOES
    glBlendBarrier
    glBlendBarrierKHR
    glBlendBarrierNV
    glBlendColorxOES
    glBlendEquationIndexedAMD
    glBlendEquationOES
    glBlendEquationSeparateIndexedAMD
    glBlendEquationSeparateOES
    glBlendEquationSeparatei
    glBlendEquationSeparateiARB
    glBlendEquationSeparateiEXT
    glBlendEquationSeparateiOES
    glBlendEquationi
    glBlendEquationiARB
    glBlendEquationiEXT
    glBlendEquationiOES
    glBlendFuncIndexedAMD
    glBlendFuncSeparateIndexedAMD
    glBlendFuncSeparateOES
    glBlendFuncSeparatei
    glBlendFuncSeparateiARB
    glBlendFuncSeparateiEXT
    glBlendFuncSeparateiOES
    glBlendFunci
    glBlendFunciARB
    glBlendFunciEXT
    glBlendFunciOES
    glBlendParameteriNV
    glBlitFramebuffer
    glBlitFramebufferANGLE
    glBlitFramebufferEXT
    glBlitFramebufferNV
    glBlitNamedFramebuffer
    glBufferAddressRangeNV
    glBufferAttachMemoryNV
    glBufferDataSysmem
    glBufferPageCommitmentARB
    glBufferPageCommitmentMemNV
    glBufferParameteriAPPLE
    glBufferStorage
    glBufferStorageEXT
    glBufferStorageExternalEXT
    glBufferStorageMemEXT
    glCallCommandListNV
    glCheckFramebufferStatus
    glCheckFramebufferStatusEXT
    glCheckFramebufferStatusOES
    glCheckNamedFramebufferStatus
    glCheckNamedFramebufferStatusEXT
    glClampColor
    glClampColorARB
    glClearAccumxOES
    glClearBufferData
    glClearBufferSubData
    glClearBufferfi
    glClearBufferfv
    glClearBufferiv
    glClearBufferuiv
    glClearColorIiEXT
    glClearColorIuiEXT
    glClearColorx
    glClearColorxOES
    glClearDepthdNV
    glClearDepthf
    glClearDepthfOES
    glClearDepthx
    glClearDepthxOES
    glClearNamedBufferData
    glClearNamedBufferDataEXT
    glClearNamedBufferSubData
    glClearNamedBufferSubDataEXT
    glClearNamedFramebufferfi
    glClearNamedFramebufferfv
    glClearNamedFramebufferiv
    glClearNamedFramebufferuiv
    glClearPixelLocalStorageuiEXT
    glClearTexImage
    glClearTexImageEXT
    glClearTexSubImage
    glClearTexSubImageEXT
    glClientActiveVertexStreamATI
    glClientAttribDefaultEXT
    glClientWaitSemaphoreui64NVX
    glClientWaitSync
    glClientWaitSyncAPPLE
    glClientWaitSyncValueuiNVX
    glClipControl
    glClipControlEXT
    glClipPlanef
    glClipPlanefIMG
    glClipPlanefOES
    glClipPlanex
    glClipPlanexIMG
    glClipPlanexOES
    glColor3fVertex3fSUN
    glColor3fVertex3fvSUN
    glColor3hNV
    glColor3hvNV
    glColor3x
    glColor3xOES
    glColor3xvOES
    glColor4fNormal3fVertex3fSUN
    glColor4fNormal3fVertex3fvSUN
    glColor4hNV
    glColor4hvNV
    glColor4ubVertex2fSUN
    glColor4ubVertex2fvSUN
    glColor4ubVertex3fSUN
    glColor4ubVertex3fvSUN
    glColor4x
    glColor4xOES
    glColor4xvOES
    glColorFormatNV
    glColorFragmentOp1ATI
    glColorFragmentOp2ATI
    glColorFragmentOp3ATI
    glColorMaskIndexedEXT
    glColorMaski
    glColorMaskiEXT
    glColorMaskiOES
    glColorP3ui
    glColorP3uiv
    glColorP4ui
    glColorP4uiv
    glColorPointerListIBM
    glColorPointervINTEL
    glColorSubTable
    glColorSubTableEXT
    glColorTableParameterfv
    glColorTableParameterfvSGI
    glColorTableParameteriv
    glColorTableParameterivSGI
    glCombinerInputNV
    glCombinerOutputNV
    glCombinerParameterfNV
    glCombinerParameterfvNV
    glCombinerParameteriNV
    glCombinerParameterivNV
    glCombinerStageParameterfvNV
    glCommandListSegmentsNV
    glCompileCommandListNV
    glCompileShader
    glCompileShaderARB
    glCompileShaderIncludeARB
    glCompressedMultiTexImage1DEXT
    glCompressedMultiTexImage2DEXT
    glCompressedMultiTexImage3DEXT
    glCompressedMultiTexSubImage1DEXT
    glCompressedMultiTexSubImage2DEXT
    glCompressedMultiTexSubImage3DEXT
    glCompressedTexImage3DNV
    glCompressedTexImage3DOES
    glCompressedTexSubImage3DNV
    glCompressedTexSubImage3DOES
    glCompressedTextureImage1DEXT
    glCompressedTextureImage2DEXT
    glCompressedTextureImage3DEXT
    glCompressedTextureSubImage1D
    glCompressedTextureSubImage1DEXT
    glCompressedTextureSubImage2D
    glCompressedTextureSubImage2DEXT
    glCompressedTextureSubImage3D
    glCompressedTextureSubImage3DEXT
    glConservativeRasterParameterfNV
    glConservativeRasterParameteriNV
    glConvolutionFilter1D
    glConvolutionFilter1DEXT
    glConvolutionFilter2D
    glConvolutionFilter2DEXT
    glConvolutionParameterf
    glConvolutionParameterfEXT
    glConvolutionParameterfv
    glConvolutionParameterfvEXT
    glConvolutionParameteri
    glConvolutionParameteriEXT
    glConvolutionParameteriv
    glConvolutionParameterivEXT
    glConvolutionParameterxOES
    glConvolutionParameterxvOES
    glCopyBufferSubData
    glCopyBufferSubDataNV
    glCopyColorSubTable
    glCopyColorSubTableEXT
    glCopyColorTable
    glCopyColorTableSGI
    glCopyConvolutionFilter1D
    glCopyConvolutionFilter1DEXT
    glCopyConvolutionFilter2D
    glCopyConvolutionFilter2DEXT
    glCopyImageSubData
    glCopyImageSubDataEXT
    glCopyImageSubDataNV
    glCopyImageSubDataOES
    glCopyMultiTexImage1DEXT
    glCopyMultiTexImage2DEXT
    glCopyMultiTexSubImage1DEXT
    glCopyMultiTexSubImage2DEXT
    glCopyMultiTexSubImage3DEXT
    glCopyNamedBufferSubData
    glCopyPathNV
    glCopyTexSubImage3DNV
    glCopyTexSubImage3DOES
    glCopyTextureImage1DEXT
    glCopyTextureImage2DEXT
    glCopyTextureLevelsAPPLE
    glCopyTextureSubImage1D
    glCopyTextureSubImage1DEXT
    glCopyTextureSubImage2D
    glCopyTextureSubImage2DEXT
    glCopyTextureSubImage3D
    glCopyTextureSubImage3DEXT
    glCoverFillPathInstancedNV
    glCoverFillPathNV
    glCoverStrokePathInstancedNV
    glCoverStrokePathNV
    glCoverageMaskNV
    glCoverageModulationNV
    glCoverageModulationTableNV
    glCoverageOperationNV
    glCreateBuffers
    glCreateCommandListsNV
    glCreateFramebuffers
    glCreateMemoryObjectsEXT
    glCreatePerfQueryINTEL
    glCreateProgram
    glCreateProgramObjectARB
    glCreateProgramPipelines
    glCreateProgressFenceNVX
    glCreateQueries
    glCreateRenderbuffers
    glCreateSamplers
    glCreateSemaphoresNV
    glCreateShader
    glCreateShaderObjectARB
    glCreateShaderProgramEXT
    glCreateShaderProgramv
    glCreateShaderProgramvEXT
    glCreateStatesNV
    glCreateSyncFromCLeventARB
    glCreateTextures
    glCreateTransformFeedbacks
    glCreateVertexArrays
    glCullParameterdvEXT
    glCullParameterfvEXT
    glCurrentPaletteMatrixARB
    glCurrentPaletteMatrixOES
    glDebugMessageCallback
    glDebugMessageCallbackAMD
    glDebugMessageCallbackARB
    glDebugMessageCallbackKHR
    glDebugMessageCallbackOES
    glDebugMessageControl
    glDebugMessageControlARB
    glDebugMessageControlKHR
    glDebugMessageControlOES
    glDebugMessageEnableAMD
    glDebugMessageInsert
    glDebugMessageInsertAMD
    glDebugMessageInsertARB
    glDebugMessageInsertKHR
    glDebugMessageInsertOES
    glDeformSGIX
    glDeformationMap3dSGIX
    glDeformationMap3fSGIX
    glDeleteAsyncMarkersSGIX
    glDeleteCommandListsNV
    glDeleteFencesAPPLE
    glDeleteFencesNV
    glDeleteFragmentShaderATI
    glDeleteFramebuffers
    glDeleteFramebuffersEXT
    glDeleteFramebuffersOES
    glDeleteMemoryObjectsEXT
    glDeleteNamedStringARB
    glDeleteNamesAMD
    glDeleteObjectARB
    glDeleteOcclusionQueriesNV
    glDeletePathsNV
    glDeletePerfMonitorsAMD
    glDeletePerfQueryINTEL
    glDeleteProgram
    glDeleteProgramPipelines
    glDeleteProgramPipelinesEXT
    glDeleteProgramsARB
    glDeleteProgramsNV
    glDeleteQueriesEXT
    glDeleteQueryResourceTagNV
    glDeleteRenderbuffers
    glDeleteRenderbuffersEXT
    glDeleteRenderbuffersOES
    glDeleteSamplers
    glDeleteSemaphoresEXT
    glDeleteShader
    glDeleteStatesNV
    glDeleteSync
    glDeleteSyncAPPLE
    glDeleteTransformFeedbacks
    glDeleteTransformFeedbacksEXT
    glDeleteTransformFeedbacksNV
    glDeleteVertexArrays
    glDeleteVertexArraysAPPLE
    glDeleteVertexArraysOES
    glDeleteVertexShaderEXT
    glDepthBoundsEXT
    glDepthBoundsdNV
    glDepthRangeArraydvNV
    glDepthRangeArrayfvNV
    glDepthRangeArrayfvOES
    glDepthRangeArrayv
    glDepthRangeIndexed
    glDepthRangeIndexeddNV
    glDepthRangeIndexedfNV
    glDepthRangeIndexedfOES
    glDepthRangedNV
    glDepthRangef
    glDepthRangefOES
    glDepthRangex
    glDepthRangexOES
    glDetachObjectARB
    glDetachShader
    glDetailTexFuncSGIS
    glDevtoolsCorrelationIdNVX
    glDevtoolsInvokeStreamedCallbackNVX
    glDisableClientStateIndexedEXT
    glDisableClientStateiEXT
    glDisableDriverControlQCOM
    glDisableIndexedEXT
    glDisableVariantClientStateEXT
    glDisableVertexArrayAttrib
    glDisableVertexArrayAttribEXT
    glDisableVertexArrayEXT
    glDisableVertexAttribAPPLE
    glDisableVertexAttribArray
    glDisableVertexAttribArrayARB
    glDisablei
    glDisableiEXT
    glDisableiNV
    glDisableiOES
    glDiscardFramebufferEXT
    glDispatchCompute
    glDispatchComputeGroupSizeARB
    glDispatchComputeIndirect
    glDrawArraysIndirect
    glDrawArraysInstanced
    glDrawArraysInstancedANGLE
    glDrawArraysInstancedARB
    glDrawArraysInstancedBaseInstance
    glDrawArraysInstancedBaseInstanceEXT
    glDrawArraysInstancedEXT
    glDrawArraysInstancedNV
    glDrawBuffers
    glDrawBuffersARB
    glDrawBuffersATI
    glDrawBuffersEXT
    glDrawBuffersIndexedEXT
    glDrawBuffersNV
    glDrawCommandsAddressNV
    glDrawCommandsNV
    glDrawCommandsStatesAddressNV
    glDrawCommandsStatesNV
    glDrawElementArrayAPPLE
    glDrawElementArrayATI
    glDrawElementsBaseVertex
    glDrawElementsBaseVertexEXT
    glDrawElementsBaseVertexOES
    glDrawElementsIndirect
    glDrawElementsInstanced
    glDrawElementsInstancedANGLE
    glDrawElementsInstancedARB
    glDrawElementsInstancedBaseInstance
    glDrawElementsInstancedBaseInstanceEXT
    glDrawElementsInstancedBaseVertex
    glDrawElementsInstancedBaseVertexBaseInstance
    glDrawElementsInstancedBaseVertexBaseInstanceEXT
    glDrawElementsInstancedBaseVertexEXT
    glDrawElementsInstancedBaseVertexOES
    glDrawElementsInstancedEXT
    glDrawElementsInstancedNV
    glDrawMeshArraysSUN
    glDrawMeshNV
    glDrawMeshTasksIndirectNV
    glDrawMeshTasksNV
    glDrawRangeElementArrayAPPLE
    glDrawRangeElementArrayATI
    glDrawRangeElementsBaseVertex
    glDrawRangeElementsBaseVertexEXT
    glDrawRangeElementsBaseVertexOES
    glDrawTexfOES
    glDrawTexfvOES
    glDrawTexiOES
    glDrawTexivOES
    glDrawTexsOES
    glDrawTexsvOES
    glDrawTextureNV
    glDrawTexxOES
    glDrawTexxvOES
    glDrawTransformFeedback
    glDrawTransformFeedbackEXT
    glDrawTransformFeedbackInstanced
    glDrawTransformFeedbackInstancedEXT
    glDrawTransformFeedbackNV
    glDrawTransformFeedbackStream
    glDrawTransformFeedbackStreamInstanced
    glDrawVkImageNV
    glEGLImageTargetRenderbufferStorageOES
    glEGLImageTargetTexStorageEXT
    glEGLImageTargetTexture2DOES
    glEGLImageTargetTextureStorageEXT
    glEdgeFlagFormatNV
    glEdgeFlagPointerListIBM
    glElementPointerAPPLE
    glElementPointerATI
    glEnableClientStateIndexedEXT
    glEnableClientStateiEXT
    glEnableDriverControlQCOM
    glEnableIndexedEXT
    glEnableVariantClientStateEXT
    glEnableVertexArrayAttrib
    glEnableVertexArrayAttribEXT
    glEnableVertexArrayEXT
    glEnableVertexAttribAPPLE
    glEnableVertexAttribArray
    glEnableVertexAttribArrayARB
    glEnablei
    glEnableiEXT
    glEnableiNV
    glEnableiOES
    glEndConditionalRender
    glEndConditionalRenderNV
    glEndConditionalRenderNVX
    glEndFragmentShaderATI
    glEndOcclusionQueryNV
    glEndPerfMonitorAMD
    glEndPerfQueryINTEL
    glEndQueryEXT
    glEndQueryIndexed
    glEndTilingQCOM
    glEndTransformFeedback
    glEndTransformFeedbackEXT
    glEndTransformFeedbackNV
    glEndVertexShaderEXT
    glEndVideoCaptureNV
    glEvalCoord1xOES
    glEvalCoord1xvOES
    glEvalCoord2xOES
    glEvalCoord2xvOES
    glEvalMapsNV
    glEvaluateDepthValuesARB
    glExecuteProgramNV
    glExtGetBufferPointervQCOM
    glExtGetBuffersQCOM
    glExtGetFramebuffersQCOM
    glExtGetProgramBinarySourceQCOM
    glExtGetProgramsQCOM
    glExtGetRenderbuffersQCOM
    glExtGetShadersQCOM
    glExtGetTexLevelParameterivQCOM
    glExtGetTexSubImageQCOM
    glExtGetTexturesQCOM
    glExtIsProgramBinaryQCOM
    glExtTexObjectStateOverrideiQCOM
    glExtractComponentEXT
    glExtrapolateTex2DQCOM
    glFeedbackBufferxOES
    glFenceSync
    glFenceSyncAPPLE
    glFenceValueuiNVX
    glFinalCombinerInputNV
    glFinishAsyncSGIX
    glFinishFenceAPPLE
    glFinishFenceNV
    glFinishObjectAPPLE
    glFinishTextureSUNX
    glFlushMappedBufferRange
    glFlushMappedBufferRangeAPPLE
    glFlushMappedBufferRangeEXT
    glFlushMappedNamedBufferRange
    glFlushMappedNamedBufferRangeEXT
    glFlushPixelDataRangeNV
    glFlushRasterSGIX
    glFlushStaticDataIBM
    glFlushVertexArrayRangeAPPLE
    glFlushVertexArrayRangeNV
    glFogCoordFormatNV
    glFogCoordPointerListIBM
    glFogCoordhNV
    glFogCoordhvNV
    glFogFuncSGIS
    glFogx
    glFogxOES
    glFogxv
    glFogxvOES
    glFragmentColorMaterialSGIX
    glFragmentCoverageColorNV
    glFragmentLightModelfSGIX
    glFragmentLightModelfvSGIX
    glFragmentLightModeliSGIX
    glFragmentLightModelivSGIX
    glFragmentLightfSGIX
    glFragmentLightfvSGIX
    glFragmentLightiSGIX
    glFragmentLightivSGIX
    glFragmentMaterialfSGIX
    glFragmentMaterialfvSGIX
    glFragmentMaterialiSGIX
    glFragmentMaterialivSGIX
    glFrameTerminatorGREMEDY
    glFrameZoomSGIX
    glFramebufferDrawBufferEXT
    glFramebufferDrawBuffersEXT
    glFramebufferFetchBarrierEXT
    glFramebufferFetchBarrierQCOM
    glFramebufferFoveationConfigQCOM
    glFramebufferFoveationParametersQCOM
    glFramebufferParameteri
    glFramebufferParameteriMESA
    glFramebufferPixelLocalStorageSizeEXT
    glFramebufferReadBufferEXT
    glFramebufferRenderbuffer
    glFramebufferRenderbufferEXT
    glFramebufferRenderbufferOES
    glFramebufferSampleLocationsfvARB
    glFramebufferSampleLocationsfvNV
    glFramebufferSamplePositionsfvAMD
    glFramebufferTexture
    glFramebufferTexture1D
    glFramebufferTexture1DEXT
    glFramebufferTexture2D
    glFramebufferTexture2DDownsampleIMG
    glFramebufferTexture2DEXT
    glFramebufferTexture2DMultisampleEXT
    glFramebufferTexture2DMultisampleIMG
    glFramebufferTexture2DOES
    glFramebufferTexture3D
    glFramebufferTexture3DEXT
    glFramebufferTexture3DOES
    glFramebufferTextureARB
    glFramebufferTextureEXT
    glFramebufferTextureFaceARB
    glFramebufferTextureFaceEXT
    glFramebufferTextureLayer
    glFramebufferTextureLayerARB
    glFramebufferTextureLayerDownsampleIMG
    glFramebufferTextureLayerEXT
    glFramebufferTextureLayerNV
    glFramebufferTextureMultisampleMultiviewOVR
    glFramebufferTextureMultiviewOVR
    glFramebufferTextureOES
    glFreeObjectBufferATI
    glFrustumf
    glFrustumfOES
    glFrustumx
    glFrustumxOES
    glGenAsyncMarkersSGIX
    glGenFencesAPPLE
    glGenFencesNV
    glGenFragmentShadersATI
    glGenFramebuffers
    glGenFramebuffersEXT
    glGenFramebuffersOES
    glGenNamesAMD
    glGenOcclusionQueriesNV
    glGenPathsNV
    glGenPerfMonitorsAMD
    glGenProgramPipelines
    glGenProgramPipelinesEXT
    glGenProgramsARB
    glGenProgramsNV
    glGenQueriesEXT
    glGenQueryResourceTagNV
    glGenRenderbuffers
    glGenRenderbuffersEXT
    glGenRenderbuffersOES
    glGenSamplers
    glGenSemaphoresEXT
    glGenSymbolsEXT
    glGenTransformFeedbacks
    glGenTransformFeedbacksEXT
    glGenTransformFeedbacksNV
    glGenVertexArrays
    glGenVertexArraysAPPLE
    glGenVertexArraysOES
    glGenVertexShadersEXT
    glGenerateMipmap
    glGenerateMipmapEXT
    glGenerateMipmapOES
    glGenerateMultiTexMipmapEXT
    glGenerateTextureMipmap
    glGenerateTextureMipmapEXT
    glGetActiveAtomicCounterBufferiv
    glGetActiveAttrib
    glGetActiveAttribARB
    glGetActiveSubroutineName
    glGetActiveSubroutineUniformName
    glGetActiveSubroutineUniformiv
    glGetActiveUniform
    glGetActiveUniformARB
    glGetActiveUniformBlockName
    glGetActiveUniformBlockiv
    glGetActiveUniformName
    glGetActiveUniformsiv
    glGetActiveVaryingNV
    glGetArrayObjectfvATI
    glGetArrayObjectivATI
    glGetAttachedObjectsARB
    glGetAttachedShaders
    glGetAttribLocation
    glGetAttribLocationARB
    glGetBooleanIndexedvEXT
    glGetBooleani_v
    glGetBufferParameteri64v
    glGetBufferParameterui64vNV
    glGetClipPlanef
    glGetClipPlanefOES
    glGetClipPlanex
    glGetClipPlanexOES
    glGetColorTableParameterfvSGI
    glGetColorTableParameterivSGI
    glGetColorTableSGI
    glGetCombinerInputParameterfvNV
    glGetCombinerInputParameterivNV
    glGetCombinerOutputParameterfvNV
    glGetCombinerOutputParameterivNV
    glGetCombinerStageParameterfvNV
    glGetCommandHeaderNV
    glGetCompressedMultiTexImageEXT
    glGetCompressedTexImageNV
    glGetCompressedTextureImage
    glGetCompressedTextureImageEXT
    glGetCompressedTextureSubImage
    glGetConvolutionFilter
    glGetConvolutionFilterEXT
    glGetConvolutionParameterfv
    glGetConvolutionParameterfvEXT
    glGetConvolutionParameteriv
    glGetConvolutionParameterivEXT
    glGetConvolutionParameterxvOES
    glGetCoverageModulationTableNV
    glGetDebugMessageLog
    glGetDebugMessageLogAMD
    glGetDebugMessageLogARB
    glGetDebugMessageLogKHR
    glGetDebugMessageLogOES
    glGetDetailTexFuncSGIS
    glGetDoubleIndexedvEXT
    glGetDoublei_v
    glGetDoublei_vEXT
    glGetDriverControlStringQCOM
    glGetDriverControlsQCOM
    glGetFenceivNV
    glGetFinalCombinerInputParameterfvNV
    glGetFinalCombinerInputParameterivNV
    glGetFirstPerfQueryIdINTEL
    glGetFixedv
    glGetFixedvOES
    glGetFloatIndexedvEXT
    glGetFloati_v
    glGetFloati_vEXT
    glGetFloati_vNV
    glGetFloati_vOES
    glGetFogFuncSGIS
    glGetFragDataIndex
    glGetFragDataIndexEXT
    glGetFragDataLocation
    glGetFragDataLocationEXT
    glGetFragmentLightfvSGIX
    glGetFragmentLightivSGIX
    glGetFragmentMaterialfvSGIX
    glGetFragmentMaterialivSGIX
    glGetFramebufferAttachmentParameteriv
    glGetFramebufferAttachmentParameterivEXT
    glGetFramebufferAttachmentParameterivOES
    glGetFramebufferParameterfvAMD
    glGetFramebufferParameteriv
    glGetFramebufferParameterivEXT
    glGetFramebufferParameterivMESA
    glGetFramebufferPixelLocalStorageSizeEXT
    glGetGraphicsResetStatus
    glGetGraphicsResetStatusARB
    glGetGraphicsResetStatusEXT
    glGetGraphicsResetStatusKHR
    glGetHandleARB
    glGetHistogram
    glGetHistogramEXT
    glGetHistogramParameterfv
    glGetHistogramParameterfvEXT
    glGetHistogramParameteriv
    glGetHistogramParameterivEXT
    glGetHistogramParameterxvOES
    glGetImageHandleARB
    glGetImageHandleNV
    glGetImageTransformParameterfvHP
    glGetImageTransformParameterivHP
    glGetInfoLogARB
    glGetInstrumentsSGIX
    glGetInteger64i_v
    glGetInteger64v
    glGetInteger64vAPPLE
    glGetInteger64vEXT
    glGetIntegerIndexedvEXT
    glGetIntegeri_v
    glGetIntegeri_vEXT
    glGetIntegerui64i_vNV
    glGetIntegerui64vNV
    glGetInternalformatSampleivNV
    glGetInternalformati64v
    glGetInternalformativ
    glGetInvariantBooleanvEXT
    glGetInvariantFloatvEXT
    glGetInvariantIntegervEXT
    glGetLightxOES
    glGetLightxv
    glGetLightxvOES
    glGetListParameterfvSGIX
    glGetListParameterivSGIX
    glGetLocalConstantBooleanvEXT
    glGetLocalConstantFloatvEXT
    glGetLocalConstantIntegervEXT
    glGetMapAttribParameterfvNV
    glGetMapAttribParameterivNV
    glGetMapControlPointsNV
    glGetMapParameterfvNV
    glGetMapParameterivNV
    glGetMapxvOES
    glGetMaterialxOES
    glGetMaterialxv
    glGetMaterialxvOES
    glGetMemoryObjectDetachedResourcesuivNV
    glGetMemoryObjectParameterivEXT
    glGetMinmax
    glGetMinmaxEXT
    glGetMinmaxParameterfv
    glGetMinmaxParameterfvEXT
    glGetMinmaxParameteriv
    glGetMinmaxParameterivEXT
    glGetMultiTexEnvfvEXT
    glGetMultiTexEnvivEXT
    glGetMultiTexGendvEXT
    glGetMultiTexGenfvEXT
    glGetMultiTexGenivEXT
    glGetMultiTexImageEXT
    glGetMultiTexLevelParameterfvEXT
    glGetMultiTexLevelParameterivEXT
    glGetMultiTexParameterIivEXT
    glGetMultiTexParameterIuivEXT
    glGetMultiTexParameterfvEXT
    glGetMultiTexParameterivEXT
    glGetMultisamplefv
    glGetMultisamplefvNV
    glGetNamedBufferParameteri64v
    glGetNamedBufferParameteri64vEXT
    glGetNamedBufferParameteriv
    glGetNamedBufferParameterivEXT
    glGetNamedBufferParameterui64vNV
    glGetNamedBufferPointerv
    glGetNamedBufferPointervEXT
    glGetNamedBufferSubData
    glGetNamedBufferSubDataEXT
    glGetNamedFramebufferAttachmentParameteriv
    glGetNamedFramebufferAttachmentParameterivEXT
    glGetNamedFramebufferParameterfvAMD
    glGetNamedFramebufferParameteriv
    glGetNamedFramebufferParameterivEXT
    glGetNamedProgramLocalParameterIivEXT
    glGetNamedProgramLocalParameterIuivEXT
    glGetNamedProgramLocalParameterdvEXT
    glGetNamedProgramLocalParameterfvEXT
    glGetNamedProgramStringEXT
    glGetNamedProgramivEXT
    glGetNamedRenderbufferParameteriv
    glGetNamedRenderbufferParameterivEXT
    glGetNamedStringARB
    glGetNamedStringivARB
    glGetNextPerfQueryIdINTEL
    glGetObjectBufferfvATI
    glGetObjectBufferivATI
    glGetObjectLabel
    glGetObjectLabelEXT
    glGetObjectLabelKHR
    glGetObjectLabelOES
    glGetObjectParameterfvARB
    glGetObjectParameterivAPPLE
    glGetObjectParameterivARB
    glGetObjectPtrLabel
    glGetObjectPtrLabelKHR
    glGetObjectPtrLabelOES
    glGetOcclusionQueryivNV
    glGetOcclusionQueryuivNV
    glGetPathColorGenfvNV
    glGetPathColorGenivNV
    glGetPathCommandsNV
    glGetPathCoordsNV
    glGetPathDashArrayNV
    glGetPathLengthNV
    glGetPathMetricRangeNV
    glGetPathMetricsNV
    glGetPathParameterfvNV
    glGetPathParameterivNV
    glGetPathSpacingNV
    glGetPathTexGenfvNV
    glGetPathTexGenivNV
    glGetPerfCounterInfoINTEL
    glGetPerfMonitorCounterDataAMD
    glGetPerfMonitorCounterInfoAMD
    glGetPerfMonitorCounterStringAMD
    glGetPerfMonitorCountersAMD
    glGetPerfMonitorGroupStringAMD
    glGetPerfMonitorGroupsAMD
    glGetPerfQueryDataINTEL
    glGetPerfQueryIdByNameINTEL
    glGetPerfQueryInfoINTEL
    glGetPixelMapxv
    glGetPixelTexGenParameterfvSGIS
    glGetPixelTexGenParameterivSGIS
    glGetPixelTransformParameterfvEXT
    glGetPixelTransformParameterivEXT
    glGetPointerIndexedvEXT
    glGetPointeri_vEXT
    glGetPointervOES
    glGetProgramBinary
    glGetProgramBinaryOES
    glGetProgramEnvParameterIivNV
    glGetProgramEnvParameterIuivNV
    glGetProgramEnvParameterdvARB
    glGetProgramEnvParameterfvARB
    glGetProgramInfoLog
    glGetProgramInterfaceiv
    glGetProgramLocalParameterIivNV
    glGetProgramLocalParameterIuivNV
    glGetProgramLocalParameterdvARB
    glGetProgramLocalParameterfvARB
    glGetProgramNamedParameterdvNV
    glGetProgramNamedParameterfvNV
    glGetProgramParameterdvNV
    glGetProgramParameterfvNV
    glGetProgramPipelineInfoLog
    glGetProgramPipelineInfoLogEXT
    glGetProgramPipelineiv
    glGetProgramPipelineivEXT
    glGetProgramResourceIndex
    glGetProgramResourceLocation
    glGetProgramResourceLocationIndex
    glGetProgramResourceLocationIndexEXT
    glGetProgramResourceName
    glGetProgramResourcefvNV
    glGetProgramResourceiv
    glGetProgramStageiv
    glGetProgramStringARB
    glGetProgramStringNV
    glGetProgramSubroutineParameteruivNV
    glGetProgramiv
    glGetProgramivARB
    glGetProgramivNV
    glGetQueryBufferObjecti64v
    glGetQueryBufferObjectiv
    glGetQueryBufferObjectui64v
    glGetQueryBufferObjectuiv
    glGetQueryIndexediv
    glGetQueryObjecti64v
    glGetQueryObjecti64vEXT
    glGetQueryObjectui64v
    glGetQueryObjectui64vEXT
    glGetQueryObjectui64vNV
    glGetQueryObjectuivEXT
    glGetQueryivEXT
    glGetRenderbufferParameteriv
    glGetRenderbufferParameterivEXT
    glGetRenderbufferParameterivOES
    glGetSamplerParameterIiv
    glGetSamplerParameterIivEXT
    glGetSamplerParameterIivOES
    glGetSamplerParameterIuiv
    glGetSamplerParameterIuivEXT
    glGetSamplerParameterIuivOES
    glGetSamplerParameterfv
    glGetSamplerParameteriv
    glGetSemaphoreParameterivNV
    glGetSemaphoreParameterui64vEXT
    glGetSeparableFilter
    glGetSeparableFilterEXT
    glGetShaderInfoLog
    glGetShaderPrecisionFormat
    glGetShaderSource
    glGetShaderSourceARB
    glGetShaderiv
    glGetShadingRateImagePaletteNV
    glGetShadingRateSampleLocationivNV
    glGetSharpenTexFuncSGIS
    glGetStageIndexNV
    glGetStringi
    glGetSubroutineIndex
    glGetSubroutineUniformLocation
    glGetSynciv
    glGetSyncivAPPLE
    glGetSyncv64NVX
    glGetTexBumpParameterfvATI
    glGetTexBumpParameterivATI
    glGetTexEnvxv
    glGetTexEnvxvOES
    glGetTexFilterFuncSGIS
    glGetTexGenfvOES
    glGetTexGenivOES
    glGetTexGenxvOES
    glGetTexImageNV
    glGetTexLevelParameterfvNV
    glGetTexLevelParameterivNV
    glGetTexLevelParameterxvOES
    glGetTexParameterIiv
    glGetTexParameterIivEXT
    glGetTexParameterIivOES
    glGetTexParameterIuiv
    glGetTexParameterIuivEXT
    glGetTexParameterIuivOES
    glGetTexParameterPointervAPPLE
    glGetTexParameterxv
    glGetTexParameterxvOES
    glGetTextureHandleARB
    glGetTextureHandleIMG
    glGetTextureHandleNV
    glGetTextureImage
    glGetTextureImageEXT
    glGetTextureLevelParameterfv
    glGetTextureLevelParameterfvEXT
    glGetTextureLevelParameteriv
    glGetTextureLevelParameterivEXT
    glGetTextureParameterIiv
    glGetTextureParameterIivEXT
    glGetTextureParameterIuiv
    glGetTextureParameterIuivEXT
    glGetTextureParameterfv
    glGetTextureParameterfvEXT
    glGetTextureParameteriv
    glGetTextureParameterivEXT
    glGetTextureSamplerHandleARB
    glGetTextureSamplerHandleIMG
    glGetTextureSamplerHandleNV
    glGetTextureSubImage
    glGetTrackMatrixivNV
    glGetTransformFeedbackVarying
    glGetTransformFeedbackVaryingEXT
    glGetTransformFeedbackVaryingNV
    glGetTransformFeedbacki64_v
    glGetTransformFeedbacki_v
    glGetTransformFeedbackiv
    glGetTranslatedShaderSourceANGLE
    glGetUniformBlockIndex
    glGetUniformBufferSizeEXT
    glGetUniformIndices
    glGetUniformLocation
    glGetUniformLocationARB
    glGetUniformOffsetEXT
    glGetUniformSubroutineuiv
    glGetUniformdv
    glGetUniformfv
    glGetUniformfvARB
    glGetUniformi64vARB
    glGetUniformi64vNV
    glGetUniformiv
    glGetUniformivARB
    glGetUniformui64vARB
    glGetUniformui64vNV
    glGetUniformuiv
    glGetUniformuivEXT
    glGetUnsignedBytei_vEXT
    glGetUnsignedBytevEXT
    glGetVariantArrayObjectfvATI
    glGetVariantArrayObjectivATI
    glGetVariantBooleanvEXT
    glGetVariantFloatvEXT
    glGetVariantIntegervEXT
    glGetVariantPointervEXT
    glGetVaryingLocationNV
    glGetVertexArrayIndexed64iv
    glGetVertexArrayIndexediv
    glGetVertexArrayIntegeri_vEXT
    glGetVertexArrayIntegervEXT
    glGetVertexArrayPointeri_vEXT
    glGetVertexArrayPointervEXT
    glGetVertexArrayiv
    glGetVertexAttribArrayObjectfvATI
    glGetVertexAttribArrayObjectivATI
    glGetVertexAttribIiv
    glGetVertexAttribIivEXT
    glGetVertexAttribIuiv
    glGetVertexAttribIuivEXT
    glGetVertexAttribLdv
    glGetVertexAttribLdvEXT
    glGetVertexAttribLi64vNV
    glGetVertexAttribLui64vARB
    glGetVertexAttribLui64vNV
    glGetVertexAttribPointerv
    glGetVertexAttribPointervARB
    glGetVertexAttribPointervNV
    glGetVertexAttribdv
    glGetVertexAttribdvARB
    glGetVertexAttribdvNV
    glGetVertexAttribfv
    glGetVertexAttribfvARB
    glGetVertexAttribfvNV
    glGetVertexAttribiv
    glGetVertexAttribivARB
    glGetVertexAttribivNV
    glGetVideoCaptureANCStreamivNVX
    glGetVideoCaptureStreamdvNV
    glGetVideoCaptureStreamfvNV
    glGetVideoCaptureStreamivNV
    glGetVideoCaptureivNV
    glGetVideoi64vNV
    glGetVideoivNV
    glGetVideoui64vNV
    glGetVideouivNV
    glGetVkProcAddrNV
    glGetnColorTable
    glGetnColorTableARB
    glGetnCompressedTexImage
    glGetnCompressedTexImageARB
    glGetnConvolutionFilter
    glGetnConvolutionFilterARB
    glGetnHistogram
    glGetnHistogramARB
    glGetnMapdv
    glGetnMapdvARB
    glGetnMapfv
    glGetnMapfvARB
    glGetnMapiv
    glGetnMapivARB
    glGetnMinmax
    glGetnMinmaxARB
    glGetnPixelMapfv
    glGetnPixelMapfvARB
    glGetnPixelMapuiv
    glGetnPixelMapuivARB
    glGetnPixelMapusv
    glGetnPixelMapusvARB
    glGetnPolygonStipple
    glGetnPolygonStippleARB
    glGetnSeparableFilter
    glGetnSeparableFilterARB
    glGetnTexImage
    glGetnTexImageARB
    glGetnUniformdv
    glGetnUniformdvARB
    glGetnUniformfv
    glGetnUniformfvARB
    glGetnUniformfvEXT
    glGetnUniformfvKHR
    glGetnUniformi64vARB
    glGetnUniformiv
    glGetnUniformivARB
    glGetnUniformivEXT
    glGetnUniformivKHR
    glGetnUniformui64vARB
    glGetnUniformuiv
    glGetnUniformuivARB
    glGetnUniformuivKHR
    glGlobalAlphaFactorbSUN
    glGlobalAlphaFactordSUN
    glGlobalAlphaFactorfSUN
    glGlobalAlphaFactoriSUN
    glGlobalAlphaFactorsSUN
    glGlobalAlphaFactorubSUN
    glGlobalAlphaFactoruiSUN
    glGlobalAlphaFactorusSUN
    glGpuSyncAcquireNVX
    glGpuSyncCreateNVX
    glGpuSyncDestroyNVX
    glGpuSyncReleaseNVX
    glHintPGI
    glHistogram
    glHistogramEXT
    glIglooInterfaceSGIX
    glImageTransformParameterfHP
    glImageTransformParameterfvHP
    glImageTransformParameteriHP
    glImageTransformParameterivHP
    glImportMemoryFdEXT
    glImportMemoryWin32HandleEXT
    glImportMemoryWin32NameEXT
    glImportSemaphoreFdEXT
    glImportSemaphoreWin32HandleEXT
    glImportSemaphoreWin32NameEXT
    glImportSyncEXT
    glIndexFormatNV
    glIndexFuncEXT
    glIndexMaterialEXT
    glIndexPointerListIBM
    glIndexxOES
    glIndexxvOES
    glInsertComponentEXT
    glInsertEventMarkerEXT
    glInstrumentsBufferSGIX
    glInterpolatePathsNV
    glInvalidateBufferData
    glInvalidateBufferSubData
    glInvalidateFramebuffer
    glInvalidateNamedFramebufferData
    glInvalidateNamedFramebufferSubData
    glInvalidateSubFramebuffer
    glInvalidateTexImage
    glInvalidateTexSubImage
    glIsAsyncMarkerSGIX
    glIsBufferResidentNV
    glIsCommandListNV
    glIsEnabledIndexedEXT
    glIsEnabledi
    glIsEnablediEXT
    glIsEnablediNV
    glIsEnablediOES
    glIsFenceAPPLE
    glIsFenceNV
    glIsFramebuffer
    glIsFramebufferEXT
    glIsFramebufferOES
    glIsImageHandleResidentARB
    glIsImageHandleResidentNV
    glIsMemoryObjectEXT
    glIsNameAMD
    glIsNamedBufferResidentNV
    glIsNamedStringARB
    glIsObjectBufferATI
    glIsOcclusionQueryNV
    glIsPathNV
    glIsPointInFillPathNV
    glIsPointInStrokePathNV
    glIsProgram
    glIsProgramARB
    glIsProgramNV
    glIsProgramPipeline
    glIsProgramPipelineEXT
    glIsQueryEXT
    glIsRenderbuffer
    glIsRenderbufferEXT
    glIsRenderbufferOES
    glIsSampler
    glIsSemaphoreEXT
    glIsShader
    glIsStateNV
    glIsSync
    glIsSyncAPPLE
    glIsTextureHandleResidentARB
    glIsTextureHandleResidentNV
    glIsTransformFeedback
    glIsTransformFeedbackEXT
    glIsTransformFeedbackNV
    glIsVariantEnabledEXT
    glIsVertexArray
    glIsVertexArrayAPPLE
    glIsVertexArrayOES
    glIsVertexAttribEnabledAPPLE
    glLGPUCopyImageSubDataNVX
    glLGPUInterlockNVX
    glLGPUNamedBufferSubDataNVX
    glLabelObjectEXT
    glLightEnviSGIX
    glLightModelx
    glLightModelxOES
    glLightModelxv
    glLightModelxvOES
    glLightx
    glLightxOES
    glLightxv
    glLightxvOES
    glLineWidthx
    glLineWidthxOES
    glLinkProgram
    glLinkProgramARB
    glListDrawCommandsStatesClientNV
    glListParameterfSGIX
    glListParameterfvSGIX
    glListParameteriSGIX
    glListParameterivSGIX
    glLoadIdentityDeformationMapSGIX
    glLoadMatrixx
    glLoadMatrixxOES
    glLoadPaletteFromModelViewMatrixOES
    glLoadProgramNV
    glLoadTransformEXT
    glLoadTransposeMatrixxOES
    glMakeBufferNonResidentNV
    glMakeBufferResidentNV
    glMakeImageHandleNonResidentARB
    glMakeImageHandleNonResidentNV
    glMakeImageHandleResidentARB
    glMakeImageHandleResidentNV
    glMakeNamedBufferNonResidentNV
    glMakeNamedBufferResidentNV
    glMakeTextureHandleNonResidentARB
    glMakeTextureHandleNonResidentNV
    glMakeTextureHandleResidentARB
    glMakeTextureHandleResidentNV
    glMap1xOES
    glMap2xOES
    glMapBufferRange
    glMapBufferRangeEXT
    glMapControlPointsNV
    glMapGrid1xOES
    glMapGrid2xOES
    glMapNamedBuffer
    glMapNamedBufferEXT
    glMapNamedBufferRange
    glMapNamedBufferRangeEXT
    glMapObjectBufferATI
    glMapParameterfvNV
    glMapParameterivNV
    glMapTexture2DINTEL
    glMapVertexAttrib1dAPPLE
    glMapVertexAttrib1fAPPLE
    glMapVertexAttrib2dAPPLE
    glMapVertexAttrib2fAPPLE
    glMaterialx
    glMaterialxOES
    glMaterialxv
    glMaterialxvOES
    glMatrixFrustumEXT
    glMatrixIndexPointerARB
    glMatrixIndexPointerOES
    glMatrixIndexubvARB
    glMatrixIndexuivARB
    glMatrixIndexusvARB
    glMatrixLoad3x2fNV
    glMatrixLoad3x3fNV
    glMatrixLoadIdentityEXT
    glMatrixLoadTranspose3x3fNV
    glMatrixLoadTransposedEXT
    glMatrixLoadTransposefEXT
    glMatrixLoaddEXT
    glMatrixLoadfEXT
    glMatrixMult3x2fNV
    glMatrixMult3x3fNV
    glMatrixMultTranspose3x3fNV
    glMatrixMultTransposedEXT
    glMatrixMultTransposefEXT
    glMatrixMultdEXT
    glMatrixMultfEXT
    glMatrixOrthoEXT
    glMatrixPopEXT
    glMatrixPushEXT
    glMatrixRotatedEXT
    glMatrixRotatefEXT
    glMatrixScaledEXT
    glMatrixScalefEXT
    glMatrixTranslatedEXT
    glMatrixTranslatefEXT
    glMaxShaderCompilerThreadsARB
    glMaxShaderCompilerThreadsKHR
    glMemoryBarrier
    glMemoryBarrierByRegion
    glMemoryBarrierEXT
    glMemoryObjectParameterivEXT
    glMinSampleShading
    glMinSampleShadingARB
    glMinSampleShadingOES
    glMinmax
    glMinmaxEXT
    glMultMatrixx
    glMultMatrixxOES
    glMultTransformEXT
    glMultTransposeMatrixxOES
    glMultiDrawArraysIndirect
    glMultiDrawArraysIndirectAMD
    glMultiDrawArraysIndirectBindlessCountNV
    glMultiDrawArraysIndirectBindlessNV
    glMultiDrawArraysIndirectCount
    glMultiDrawArraysIndirectCountARB
    glMultiDrawArraysIndirectEXT
    glMultiDrawElementArrayAPPLE
    glMultiDrawElementsBaseVertex
    glMultiDrawElementsBaseVertexEXT
    glMultiDrawElementsIndirect
    glMultiDrawElementsIndirectAMD
    glMultiDrawElementsIndirectBindlessCountNV
    glMultiDrawElementsIndirectBindlessNV
    glMultiDrawElementsIndirectCount
    glMultiDrawElementsIndirectCountARB
    glMultiDrawElementsIndirectEXT
    glMultiDrawMeshTasksIndirectCountNV
    glMultiDrawMeshTasksIndirectNV
    glMultiDrawRangeElementArrayAPPLE
    glMultiModeDrawArraysIBM
    glMultiModeDrawElementsIBM
    glMultiTexBufferEXT
    glMultiTexCoord1bOES
    glMultiTexCoord1bvOES
    glMultiTexCoord1hNV
    glMultiTexCoord1hvNV
    glMultiTexCoord1x
    glMultiTexCoord1xOES
    glMultiTexCoord1xv
    glMultiTexCoord1xvOES
    glMultiTexCoord2bOES
    glMultiTexCoord2bvOES
    glMultiTexCoord2hNV
    glMultiTexCoord2hvNV
    glMultiTexCoord2x
    glMultiTexCoord2xOES
    glMultiTexCoord2xv
    glMultiTexCoord2xvOES
    glMultiTexCoord3bOES
    glMultiTexCoord3bvOES
    glMultiTexCoord3hNV
    glMultiTexCoord3hvNV
    glMultiTexCoord3x
    glMultiTexCoord3xOES
    glMultiTexCoord3xv
    glMultiTexCoord3xvOES
    glMultiTexCoord4bOES
    glMultiTexCoord4bvOES
    glMultiTexCoord4hNV
    glMultiTexCoord4hvNV
    glMultiTexCoord4x
    glMultiTexCoord4xOES
    glMultiTexCoord4xv
    glMultiTexCoord4xvOES
    glMultiTexCoordP1ui
    glMultiTexCoordP1uiv
    glMultiTexCoordP2ui
    glMultiTexCoordP2uiv
    glMultiTexCoordP3ui
    glMultiTexCoordP3uiv
    glMultiTexCoordP4ui
    glMultiTexCoordP4uiv
    glMultiTexCoordPointerEXT
    glMultiTexEnvfEXT
    glMultiTexEnvfvEXT
    glMultiTexEnviEXT
    glMultiTexEnvivEXT
    glMultiTexGendEXT
    glMultiTexGendvEXT
    glMultiTexGenfEXT
    glMultiTexGenfvEXT
    glMultiTexGeniEXT
    glMultiTexGenivEXT
    glMultiTexImage1DEXT
    glMultiTexImage2DEXT
    glMultiTexImage3DEXT
    glMultiTexParameterIivEXT
    glMultiTexParameterIuivEXT
    glMultiTexParameterfEXT
    glMultiTexParameterfvEXT
    glMultiTexParameteriEXT
    glMultiTexParameterivEXT
    glMultiTexRenderbufferEXT
    glMultiTexSubImage1DEXT
    glMultiTexSubImage2DEXT
    glMultiTexSubImage3DEXT
    glMulticastBarrierNV
    glMulticastBlitFramebufferNV
    glMulticastBufferSubDataNV
    glMulticastCopyBufferSubDataNV
    glMulticastCopyImageSubDataNV
    glMulticastFramebufferSampleLocationsfvNV
    glMulticastGetQueryObjecti64vNV
    glMulticastGetQueryObjectivNV
    glMulticastGetQueryObjectui64vNV
    glMulticastGetQueryObjectuivNV
    glMulticastScissorArrayvNVX
    glMulticastViewportArrayvNVX
    glMulticastViewportPositionWScaleNVX
    glMulticastWaitSyncNV
    glNVENCInterOpFunctionNVX
    glNamedBufferAttachMemoryNV
    glNamedBufferData
    glNamedBufferDataEXT
    glNamedBufferPageCommitmentARB
    glNamedBufferPageCommitmentEXT
    glNamedBufferPageCommitmentMemNV
    glNamedBufferStorage
    glNamedBufferStorageEXT
    glNamedBufferStorageExternalEXT
    glNamedBufferStorageMemEXT
    glNamedBufferSubData
    glNamedBufferSubDataEXT
    glNamedCopyBufferSubDataEXT
    glNamedFramebufferDrawBuffer
    glNamedFramebufferDrawBuffers
    glNamedFramebufferParameteri
    glNamedFramebufferParameteriEXT
    glNamedFramebufferReadBuffer
    glNamedFramebufferRenderbuffer
    glNamedFramebufferRenderbufferEXT
    glNamedFramebufferSampleLocationsfvARB
    glNamedFramebufferSampleLocationsfvNV
    glNamedFramebufferSamplePositionsfvAMD
    glNamedFramebufferTexture
    glNamedFramebufferTexture1DEXT
    glNamedFramebufferTexture2DEXT
    glNamedFramebufferTexture3DEXT
    glNamedFramebufferTextureEXT
    glNamedFramebufferTextureFaceEXT
    glNamedFramebufferTextureLayer
    glNamedFramebufferTextureLayerEXT
    glNamedProgramLocalParameter4dEXT
    glNamedProgramLocalParameter4dvEXT
    glNamedProgramLocalParameter4fEXT
    glNamedProgramLocalParameter4fvEXT
    glNamedProgramLocalParameterI4iEXT
    glNamedProgramLocalParameterI4ivEXT
    glNamedProgramLocalParameterI4uiEXT
    glNamedProgramLocalParameterI4uivEXT
    glNamedProgramLocalParameters4fvEXT
    glNamedProgramLocalParametersI4ivEXT
    glNamedProgramLocalParametersI4uivEXT
    glNamedProgramStringEXT
    glNamedRenderbufferStorage
    glNamedRenderbufferStorageEXT
    glNamedRenderbufferStorageMultisample
    glNamedRenderbufferStorageMultisampleAdvancedAMD
    glNamedRenderbufferStorageMultisampleCoverageEXT
    glNamedRenderbufferStorageMultisampleEXT
    glNamedStringARB
    glNewObjectBufferATI
    glNormal3fVertex3fSUN
    glNormal3fVertex3fvSUN
    glNormal3hNV
    glNormal3hvNV
    glNormal3x
    glNormal3xOES
    glNormal3xvOES
    glNormalFormatNV
    glNormalP3ui
    glNormalP3uiv
    glNormalPointerListIBM
    glNormalPointervINTEL
    glNormalStream3bATI
    glNormalStream3bvATI
    glNormalStream3dATI
    glNormalStream3dvATI
    glNormalStream3fATI
    glNormalStream3fvATI
    glNormalStream3iATI
    glNormalStream3ivATI
    glNormalStream3sATI
    glNormalStream3svATI
    glObjectLabel
    glObjectLabelKHR
    glObjectLabelOES
    glObjectPtrLabel
    glObjectPtrLabelKHR
    glObjectPtrLabelOES
    glObjectPurgeableAPPLE
    glObjectUnpurgeableAPPLE
    glOrthof
    glOrthofOES
    glOrthox
    glOrthoxOES
    glPNTrianglesfATI
    glPNTrianglesiATI
    glPassTexCoordATI
    glPassThroughxOES
    glPatchParameterfv
    glPatchParameterfvEXT
    glPatchParameterfvNV
    glPatchParameteri
    glPatchParameteriEXT
    glPatchParameteriNV
    glPatchParameteriOES
    glPathColorGenNV
    glPathCommandsNV
    glPathCoordsNV
    glPathCoverDepthFuncNV
    glPathDashArrayNV
    glPathFogGenNV
    glPathGlyphIndexArrayNV
    glPathGlyphIndexRangeNV
    glPathGlyphRangeNV
    glPathGlyphsNV
    glPathMemoryGlyphIndexArrayNV
    glPathParameterfNV
    glPathParameterfvNV
    glPathParameteriNV
    glPathParameterivNV
    glPathStencilDepthOffsetNV
    glPathStencilFuncNV
    glPathStringNV
    glPathSubCommandsNV
    glPathSubCoordsNV
    glPathTexGenNV
    glPauseTransformFeedback
    glPauseTransformFeedbackEXT
    glPauseTransformFeedbackNV
    glPixelDataRangeNV
    glPixelMapx
    glPixelStorex
    glPixelTexGenParameterfSGIS
    glPixelTexGenParameterfvSGIS
    glPixelTexGenParameteriSGIS
    glPixelTexGenParameterivSGIS
    glPixelTexGenSGIX
    glPixelTransferxOES
    glPixelTransformParameterfEXT
    glPixelTransformParameterfvEXT
    glPixelTransformParameteriEXT
    glPixelTransformParameterivEXT
    glPixelZoomxOES
    glPointAlongPathNV
    glPointParameterx
    glPointParameterxOES
    glPointParameterxv
    glPointParameterxvOES
    glPointSizePointerOES
    glPointSizex
    glPointSizexOES
    glPollAsyncSGIX
    glPollInstrumentsSGIX
    glPolygonOffsetClamp
    glPolygonOffsetClampEXT
    glPolygonOffsetx
    glPolygonOffsetxOES
    glPopDebugGroup
    glPopDebugGroupKHR
    glPopDebugGroupOES
    glPopGroupMarkerEXT
    glPresentFrameDualFillNV
    glPresentFrameKeyedNV
    glPrimitiveBoundingBox
    glPrimitiveBoundingBoxARB
    glPrimitiveBoundingBoxEXT
    glPrimitiveBoundingBoxOES
    glPrimitiveRestart
    glPrimitiveRestartIndex
    glPrimitiveRestartIndexNV
    glPrimitiveRestartNV
    glPrioritizeTexturesxOES
    glProgramBinary
    glProgramBinaryOES
    glProgramBufferParametersIivNV
    glProgramBufferParametersIuivNV
    glProgramBufferParametersfvNV
    glProgramEnvParameter4dARB
    glProgramEnvParameter4dvARB
    glProgramEnvParameter4fARB
    glProgramEnvParameter4fvARB
    glProgramEnvParameterI4iNV
    glProgramEnvParameterI4ivNV
    glProgramEnvParameterI4uiNV
    glProgramEnvParameterI4uivNV
    glProgramEnvParameters4fvEXT
    glProgramEnvParametersI4ivNV
    glProgramEnvParametersI4uivNV
    glProgramLocalParameter4dARB
    glProgramLocalParameter4dvARB
    glProgramLocalParameter4fARB
    glProgramLocalParameter4fvARB
    glProgramLocalParameterI4iNV
    glProgramLocalParameterI4ivNV
    glProgramLocalParameterI4uiNV
    glProgramLocalParameterI4uivNV
    glProgramLocalParameters4fvEXT
    glProgramLocalParametersI4ivNV
    glProgramLocalParametersI4uivNV
    glProgramNamedParameter4dNV
    glProgramNamedParameter4dvNV
    glProgramNamedParameter4fNV
    glProgramNamedParameter4fvNV
    glProgramParameter4dNV
    glProgramParameter4dvNV
    glProgramParameter4fNV
    glProgramParameter4fvNV
    glProgramParameteri
    glProgramParameteriARB
    glProgramParameteriEXT
    glProgramParameters4dvNV
    glProgramParameters4fvNV
    glProgramPathFragmentInputGenNV
    glProgramStringARB
    glProgramSubroutineParametersuivNV
    glProgramUniform1d
    glProgramUniform1dEXT
    glProgramUniform1dv
    glProgramUniform1dvEXT
    glProgramUniform1f
    glProgramUniform1fEXT
    glProgramUniform1fv
    glProgramUniform1fvEXT
    glProgramUniform1i
    glProgramUniform1i64ARB
    glProgramUniform1i64NV
    glProgramUniform1i64vARB
    glProgramUniform1i64vNV
    glProgramUniform1iEXT
    glProgramUniform1iv
    glProgramUniform1ivEXT
    glProgramUniform1ui
    glProgramUniform1ui64ARB
    glProgramUniform1ui64NV
    glProgramUniform1ui64vARB
    glProgramUniform1ui64vNV
    glProgramUniform1uiEXT
    glProgramUniform1uiv
    glProgramUniform1uivEXT
    glProgramUniform2d
    glProgramUniform2dEXT
    glProgramUniform2dv
    glProgramUniform2dvEXT
    glProgramUniform2f
    glProgramUniform2fEXT
    glProgramUniform2fv
    glProgramUniform2fvEXT
    glProgramUniform2i
    glProgramUniform2i64ARB
    glProgramUniform2i64NV
    glProgramUniform2i64vARB
    glProgramUniform2i64vNV
    glProgramUniform2iEXT
    glProgramUniform2iv
    glProgramUniform2ivEXT
    glProgramUniform2ui
    glProgramUniform2ui64ARB
    glProgramUniform2ui64NV
    glProgramUniform2ui64vARB
    glProgramUniform2ui64vNV
    glProgramUniform2uiEXT
    glProgramUniform2uiv
    glProgramUniform2uivEXT
    glProgramUniform3d
    glProgramUniform3dEXT
    glProgramUniform3dv
    glProgramUniform3dvEXT
    glProgramUniform3f
    glProgramUniform3fEXT
    glProgramUniform3fv
    glProgramUniform3fvEXT
    glProgramUniform3i
    glProgramUniform3i64ARB
    glProgramUniform3i64NV
    glProgramUniform3i64vARB
    glProgramUniform3i64vNV
    glProgramUniform3iEXT
    glProgramUniform3iv
    glProgramUniform3ivEXT
    glProgramUniform3ui
    glProgramUniform3ui64ARB
    glProgramUniform3ui64NV
    glProgramUniform3ui64vARB
    glProgramUniform3ui64vNV
    glProgramUniform3uiEXT
    glProgramUniform3uiv
    glProgramUniform3uivEXT
    glProgramUniform4d
    glProgramUniform4dEXT
    glProgramUniform4dv
    glProgramUniform4dvEXT
    glProgramUniform4f
    glProgramUniform4fEXT
    glProgramUniform4fv
    glProgramUniform4fvEXT
    glProgramUniform4i
    glProgramUniform4i64ARB
    glProgramUniform4i64NV
    glProgramUniform4i64vARB
    glProgramUniform4i64vNV
    glProgramUniform4iEXT
    glProgramUniform4iv
    glProgramUniform4ivEXT
    glProgramUniform4ui
    glProgramUniform4ui64ARB
    glProgramUniform4ui64NV
    glProgramUniform4ui64vARB
    glProgramUniform4ui64vNV
    glProgramUniform4uiEXT
    glProgramUniform4uiv
    glProgramUniform4uivEXT
    glProgramUniformHandleui64ARB
    glProgramUniformHandleui64IMG
    glProgramUniformHandleui64NV
    glProgramUniformHandleui64vARB
    glProgramUniformHandleui64vIMG
    glProgramUniformHandleui64vNV
    glProgramUniformMatrix2dv
    glProgramUniformMatrix2dvEXT
    glProgramUniformMatrix2fv
    glProgramUniformMatrix2fvEXT
    glProgramUniformMatrix2x3dv
    glProgramUniformMatrix2x3dvEXT
    glProgramUniformMatrix2x3fv
    glProgramUniformMatrix2x3fvEXT
    glProgramUniformMatrix2x4dv
    glProgramUniformMatrix2x4dvEXT
    glProgramUniformMatrix2x4fv
    glProgramUniformMatrix2x4fvEXT
    glProgramUniformMatrix3dv
    glProgramUniformMatrix3dvEXT
    glProgramUniformMatrix3fv
    glProgramUniformMatrix3fvEXT
    glProgramUniformMatrix3x2dv
    glProgramUniformMatrix3x2dvEXT
    glProgramUniformMatrix3x2fv
    glProgramUniformMatrix3x2fvEXT
    glProgramUniformMatrix3x4dv
    glProgramUniformMatrix3x4dvEXT
    glProgramUniformMatrix3x4fv
    glProgramUniformMatrix3x4fvEXT
    glProgramUniformMatrix4dv
    glProgramUniformMatrix4dvEXT
    glProgramUniformMatrix4fv
    glProgramUniformMatrix4fvEXT
    glProgramUniformMatrix4x2dv
    glProgramUniformMatrix4x2dvEXT
    glProgramUniformMatrix4x2fv
    glProgramUniformMatrix4x2fvEXT
    glProgramUniformMatrix4x3dv
    glProgramUniformMatrix4x3dvEXT
    glProgramUniformMatrix4x3fv
    glProgramUniformMatrix4x3fvEXT
    glProgramUniformui64NV
    glProgramUniformui64vNV
    glProgramVertexLimitNV
    glProvokingVertex
    glProvokingVertexEXT
    glPushClientAttribDefaultEXT
    glPushDebugGroup
    glPushDebugGroupKHR
    glPushDebugGroupOES
    glPushGroupMarkerEXT
    glQueryCounter
    glQueryCounterEXT
    glQueryCounterNV
    glQueryMatrixxOES
    glQueryObjectParameteruiAMD
    glQueryResourceNV
    glQueryResourceTagNV
    glRasterPos2xOES
    glRasterPos2xvOES
    glRasterPos3xOES
    glRasterPos3xvOES
    glRasterPos4xOES
    glRasterPos4xvOES
    glRasterSamplesEXT
    glReadBufferIndexedEXT
    glReadBufferNV
    glReadInstrumentsSGIX
    glReadnPixels
    glReadnPixelsARB
    glReadnPixelsEXT
    glReadnPixelsKHR
    glRectxOES
    glRectxvOES
    glReferencePlaneSGIX
    glReleaseKeyedMutexWin32EXT
    glReleaseShaderCompiler
    glRenderGpuMaskNV
    glRenderbufferStorage
    glRenderbufferStorageEXT
    glRenderbufferStorageMultisample
    glRenderbufferStorageMultisampleANGLE
    glRenderbufferStorageMultisampleAPPLE
    glRenderbufferStorageMultisampleAdvancedAMD
    glRenderbufferStorageMultisampleCoverageNV
    glRenderbufferStorageMultisampleEXT
    glRenderbufferStorageMultisampleIMG
    glRenderbufferStorageMultisampleNV
    glRenderbufferStorageOES
    glReplacementCodePointerSUN
    glReplacementCodeubSUN
    glReplacementCodeubvSUN
    glReplacementCodeuiColor3fVertex3fSUN
    glReplacementCodeuiColor3fVertex3fvSUN
    glReplacementCodeuiColor4fNormal3fVertex3fSUN
    glReplacementCodeuiColor4fNormal3fVertex3fvSUN
    glReplacementCodeuiColor4ubVertex3fSUN
    glReplacementCodeuiColor4ubVertex3fvSUN
    glReplacementCodeuiNormal3fVertex3fSUN
    glReplacementCodeuiNormal3fVertex3fvSUN
    glReplacementCodeuiSUN
    glReplacementCodeuiTexCoord2fColor4fNormal3fVertex3fSUN
    glReplacementCodeuiTexCoord2fColor4fNormal3fVertex3fvSUN
    glReplacementCodeuiTexCoord2fNormal3fVertex3fSUN
    glReplacementCodeuiTexCoord2fNormal3fVertex3fvSUN
    glReplacementCodeuiTexCoord2fVertex3fSUN
    glReplacementCodeuiTexCoord2fVertex3fvSUN
    glReplacementCodeuiVertex3fSUN
    glReplacementCodeuiVertex3fvSUN
    glReplacementCodeuivSUN
    glReplacementCodeusSUN
    glReplacementCodeusvSUN
    glRequestResidentProgramsNV
    glResetHistogram
    glResetHistogramEXT
    glResetMemoryObjectParameterNV
    glResetMinmax
    glResetMinmaxEXT
    glResizeBuffersMESA
    glResolveDepthValuesNV
    glResolveMultisampleFramebufferAPPLE
    glResumeTransformFeedback
    glResumeTransformFeedbackEXT
    glResumeTransformFeedbackNV
    glRotatex
    glRotatexOES
    glSampleCoveragex
    glSampleCoveragexOES
    glSampleMapATI
    glSampleMaskEXT
    glSampleMaskIndexedNV
    glSampleMaskSGIS
    glSampleMaski
    glSamplePatternEXT
    glSamplePatternSGIS
    glSamplerParameterIiv
    glSamplerParameterIivEXT
    glSamplerParameterIivOES
    glSamplerParameterIuiv
    glSamplerParameterIuivEXT
    glSamplerParameterIuivOES
    glSamplerParameterf
    glSamplerParameterfv
    glSamplerParameteri
    glSamplerParameteriv
    glScalex
    glScalexOES
    glScissorArrayv
    glScissorArrayvNV
    glScissorArrayvOES
    glScissorExclusiveArrayvNV
    glScissorExclusiveNV
    glScissorIndexed
    glScissorIndexedNV
    glScissorIndexedOES
    glScissorIndexedv
    glScissorIndexedvNV
    glScissorIndexedvOES
    glSecondaryColor3hNV
    glSecondaryColor3hvNV
    glSecondaryColorFormatNV
    glSecondaryColorP3ui
    glSecondaryColorP3uiv
    glSecondaryColorPointerListIBM
    glSelectPerfMonitorCountersAMD
    glSemaphoreParameterivNV
    glSemaphoreParameterui64vEXT
    glSeparableFilter2D
    glSeparableFilter2DEXT
    glSetFenceAPPLE
    glSetFenceNV
    glSetFragmentShaderConstantATI
    glSetInvariantEXT
    glSetLocalConstantEXT
    glSetMultisamplefvAMD
    glShaderBinary
    glShaderOp1EXT
    glShaderOp2EXT
    glShaderOp3EXT
    glShaderSource
    glShaderSourceARB
    glShaderStorageBlockBinding
    glShadingRateImageBarrierNV
    glShadingRateImagePaletteNV
    glShadingRateQCOM
    glShadingRateSampleOrderCustomNV
    glShadingRateSampleOrderNV
    glSharpenTexFuncSGIS
    glSignalSemaphoreEXT
    glSignalSemaphoreui64NVX
    glSignalVkFenceNV
    glSignalVkSemaphoreNV
    glSpecializeShader
    glSpecializeShaderARB
    glSpriteParameterfSGIX
    glSpriteParameterfvSGIX
    glSpriteParameteriSGIX
    glSpriteParameterivSGIX
    glStartInstrumentsSGIX
    glStartTilingQCOM
    glStateCaptureNV
    glStencilClearTagEXT
    glStencilFillPathInstancedNV
    glStencilFillPathNV
    glStencilFuncSeparate
    glStencilMaskSeparate
    glStencilOpValueAMD
    glStencilStrokePathInstancedNV
    glStencilStrokePathNV
    glStencilThenCoverFillPathInstancedNV
    glStencilThenCoverFillPathNV
    glStencilThenCoverStrokePathInstancedNV
    glStencilThenCoverStrokePathNV
    glStopInstrumentsSGIX
    glStringMarkerGREMEDY
    glSubpixelPrecisionBiasNV
    glSwizzleEXT
    glSyncTextureINTEL
    glTagSampleBufferSGIX
    glTangent3bEXT
    glTangent3bvEXT
    glTangent3dEXT
    glTangent3dvEXT
    glTangent3fEXT
    glTangent3fvEXT
    glTangent3iEXT
    glTangent3ivEXT
    glTangent3sEXT
    glTangent3svEXT
    glTangentPointerEXT
    glTbufferMask3DFX
    glTessellationFactorAMD
    glTessellationModeAMD
    glTestFenceAPPLE
    glTestFenceNV
    glTestObjectAPPLE
    glTexAttachMemoryNV
    glTexBuffer
    glTexBufferARB
    glTexBufferEXT
    glTexBufferOES
    glTexBufferRange
    glTexBufferRangeEXT
    glTexBufferRangeOES
    glTexBumpParameterfvATI
    glTexBumpParameterivATI
    glTexCoord1bOES
    glTexCoord1bvOES
    glTexCoord1hNV
    glTexCoord1hvNV
    glTexCoord1xOES
    glTexCoord1xvOES
    glTexCoord2bOES
    glTexCoord2bvOES
    glTexCoord2fColor3fVertex3fSUN
    glTexCoord2fColor3fVertex3fvSUN
    glTexCoord2fColor4fNormal3fVertex3fSUN
    glTexCoord2fColor4fNormal3fVertex3fvSUN
    glTexCoord2fColor4ubVertex3fSUN
    glTexCoord2fColor4ubVertex3fvSUN
    glTexCoord2fNormal3fVertex3fSUN
    glTexCoord2fNormal3fVertex3fvSUN
    glTexCoord2fVertex3fSUN
    glTexCoord2fVertex3fvSUN
    glTexCoord2hNV
    glTexCoord2hvNV
    glTexCoord2xOES
    glTexCoord2xvOES
    glTexCoord3bOES
    glTexCoord3bvOES
    glTexCoord3hNV
    glTexCoord3hvNV
    glTexCoord3xOES
    glTexCoord3xvOES
    glTexCoord4bOES
    glTexCoord4bvOES
    glTexCoord4fColor4fNormal3fVertex4fSUN
    glTexCoord4fColor4fNormal3fVertex4fvSUN
    glTexCoord4fVertex4fSUN
    glTexCoord4fVertex4fvSUN
    glTexCoord4hNV
    glTexCoord4hvNV
    glTexCoord4xOES
    glTexCoord4xvOES
    glTexCoordFormatNV
    glTexCoordP1ui
    glTexCoordP1uiv
    glTexCoordP2ui
    glTexCoordP2uiv
    glTexCoordP3ui
    glTexCoordP3uiv
    glTexCoordP4ui
    glTexCoordP4uiv
    glTexCoordPointerListIBM
    glTexCoordPointervINTEL
    glTexEnvx
    glTexEnvxOES
    glTexEnvxv
    glTexEnvxvOES
    glTexEstimateMotionQCOM
    glTexEstimateMotionRegionsQCOM
    glTexFilterFuncSGIS
    glTexGenfOES
    glTexGenfvOES
    glTexGeniOES
    glTexGenivOES
    glTexGenxOES
    glTexGenxvOES
    glTexImage2DMultisample
    glTexImage2DMultisampleCoverageNV
    glTexImage3DMultisample
    glTexImage3DMultisampleCoverageNV
    glTexImage3DNV
    glTexImage3DOES
    glTexImage4DSGIS
    glTexPageCommitmentARB
    glTexPageCommitmentEXT
    glTexPageCommitmentMemNV
    glTexParameterIiv
    glTexParameterIivEXT
    glTexParameterIivOES
    glTexParameterIuiv
    glTexParameterIuivEXT
    glTexParameterIuivOES
    glTexParameterx
    glTexParameterxOES
    glTexParameterxv
    glTexParameterxvOES
    glTexRenderbufferNV
    glTexStorage1D
    glTexStorage1DEXT
    glTexStorage2D
    glTexStorage2DEXT
    glTexStorage2DMultisample
    glTexStorage3D
    glTexStorage3DEXT
    glTexStorage3DMultisample
    glTexStorage3DMultisampleOES
    glTexStorageAttribs2DEXT
    glTexStorageAttribs3DEXT
    glTexStorageMem1DEXT
    glTexStorageMem2DEXT
    glTexStorageMem2DMultisampleEXT
    glTexStorageMem3DEXT
    glTexStorageMem3DMultisampleEXT
    glTexStorageSparseAMD
    glTexSubImage3DNV
    glTexSubImage3DOES
    glTexSubImage4DSGIS
    glTextureAttachMemoryNV
    glTextureBarrier
    glTextureBarrierNV
    glTextureBuffer
    glTextureBufferEXT
    glTextureBufferRange
    glTextureBufferRangeEXT
    glTextureColorMaskSGIS
    glTextureFoveationParametersQCOM
    glTextureImage1DEXT
    glTextureImage2DEXT
    glTextureImage2DMultisampleCoverageNV
    glTextureImage2DMultisampleNV
    glTextureImage3DEXT
    glTextureImage3DMultisampleCoverageNV
    glTextureImage3DMultisampleNV
    glTextureLightEXT
    glTextureMaterialEXT
    glTextureNormalEXT
    glTexturePageCommitmentEXT
    glTexturePageCommitmentMemNV
    glTextureParameterIiv
    glTextureParameterIivEXT
    glTextureParameterIuiv
    glTextureParameterIuivEXT
    glTextureParameterf
    glTextureParameterfEXT
    glTextureParameterfv
    glTextureParameterfvEXT
    glTextureParameteri
    glTextureParameteriEXT
    glTextureParameteriv
    glTextureParameterivEXT
    glTextureRangeAPPLE
    glTextureRenderbufferEXT
    glTextureStorage1D
    glTextureStorage1DEXT
    glTextureStorage2D
    glTextureStorage2DEXT
    glTextureStorage2DMultisample
    glTextureStorage2DMultisampleEXT
    glTextureStorage3D
    glTextureStorage3DEXT
    glTextureStorage3DMultisample
    glTextureStorage3DMultisampleEXT
    glTextureStorageMem1DEXT
    glTextureStorageMem2DEXT
    glTextureStorageMem2DMultisampleEXT
    glTextureStorageMem3DEXT
    glTextureStorageMem3DMultisampleEXT
    glTextureStorageSparseAMD
    glTextureSubImage1D
    glTextureSubImage1DEXT
    glTextureSubImage2D
    glTextureSubImage2DEXT
    glTextureSubImage3D
    glTextureSubImage3DEXT
    glTextureView
    glTextureViewEXT
    glTextureViewOES
    glTrackMatrixNV
    glTransformFeedbackAttribsNV
    glTransformFeedbackBufferBase
    glTransformFeedbackBufferRange
    glTransformFeedbackStreamAttribsNV
    glTransformFeedbackVaryings
    glTransformFeedbackVaryingsEXT
    glTransformFeedbackVaryingsNV
    glTransformPathNV
    glTranslatex
    glTranslatexOES
    glUniform1d
    glUniform1dv
    glUniform1f
    glUniform1fARB
    glUniform1fv
    glUniform1fvARB
    glUniform1i
    glUniform1i64ARB
    glUniform1i64NV
    glUniform1i64vARB
    glUniform1i64vNV
    glUniform1iARB
    glUniform1iv
    glUniform1ivARB
    glUniform1ui
    glUniform1ui64ARB
    glUniform1ui64NV
    glUniform1ui64vARB
    glUniform1ui64vNV
    glUniform1uiEXT
    glUniform1uiv
    glUniform1uivEXT
    glUniform2d
    glUniform2dv
    glUniform2f
    glUniform2fARB
    glUniform2fv
    glUniform2fvARB
    glUniform2i
    glUniform2i64ARB
    glUniform2i64NV
    glUniform2i64vARB
    glUniform2i64vNV
    glUniform2iARB
    glUniform2iv
    glUniform2ivARB
    glUniform2ui
    glUniform2ui64ARB
    glUniform2ui64NV
    glUniform2ui64vARB
    glUniform2ui64vNV
    glUniform2uiEXT
    glUniform2uiv
    glUniform2uivEXT
    glUniform3d
    glUniform3dv
    glUniform3f
    glUniform3fARB
    glUniform3fv
    glUniform3fvARB
    glUniform3i
    glUniform3i64ARB
    glUniform3i64NV
    glUniform3i64vARB
    glUniform3i64vNV
    glUniform3iARB
    glUniform3iv
    glUniform3ivARB
    glUniform3ui
    glUniform3ui64ARB
    glUniform3ui64NV
    glUniform3ui64vARB
    glUniform3ui64vNV
    glUniform3uiEXT
    glUniform3uiv
    glUniform3uivEXT
    glUniform4d
    glUniform4dv
    glUniform4f
    glUniform4fARB
    glUniform4fv
    glUniform4fvARB
    glUniform4i
    glUniform4i64ARB
    glUniform4i64NV
    glUniform4i64vARB
    glUniform4i64vNV
    glUniform4iARB
    glUniform4iv
    glUniform4ivARB
    glUniform4ui
    glUniform4ui64ARB
    glUniform4ui64NV
    glUniform4ui64vARB
    glUniform4ui64vNV
    glUniform4uiEXT
    glUniform4uiv
    glUniform4uivEXT
    glUniformBlockBinding
    glUniformBufferEXT
    glUniformHandleui64ARB
    glUniformHandleui64IMG
    glUniformHandleui64NV
    glUniformHandleui64vARB
    glUniformHandleui64vIMG
    glUniformHandleui64vNV
    glUniformMatrix2dv
    glUniformMatrix2fv
    glUniformMatrix2fvARB
    glUniformMatrix2x3dv
    glUniformMatrix2x3fv
    glUniformMatrix2x3fvNV
    glUniformMatrix2x4dv
    glUniformMatrix2x4fv
    glUniformMatrix2x4fvNV
    glUniformMatrix3dv
    glUniformMatrix3fv
    glUniformMatrix3fvARB
    glUniformMatrix3x2dv
    glUniformMatrix3x2fv
    glUniformMatrix3x2fvNV
    glUniformMatrix3x4dv
    glUniformMatrix3x4fv
    glUniformMatrix3x4fvNV
    glUniformMatrix4dv
    glUniformMatrix4fv
    glUniformMatrix4fvARB
    glUniformMatrix4x2dv
    glUniformMatrix4x2fv
    glUniformMatrix4x2fvNV
    glUniformMatrix4x3dv
    glUniformMatrix4x3fv
    glUniformMatrix4x3fvNV
    glUniformSubroutinesuiv
    glUniformui64NV
    glUniformui64vNV
    glUnmapNamedBuffer
    glUnmapNamedBufferEXT
    glUnmapObjectBufferATI
    glUnmapTexture2DINTEL
    glUpdateObjectBufferATI
    glUploadGpuMaskNVX
    glUseProgram
    glUseProgramObjectARB
    glUseProgramStages
    glUseProgramStagesEXT
    glUseShaderProgramEXT
    glVDPAUFiniNV
    glVDPAUGetSurfaceivNV
    glVDPAUInitNV
    glVDPAUIsSurfaceNV
    glVDPAUMapSurfacesNV
    glVDPAURegisterOutputSurfaceNV
    glVDPAURegisterVideoSurfaceNV
    glVDPAURegisterVideoSurfaceWithPictureStructureNV
    glVDPAUSurfaceAccessNV
    glVDPAUUnmapSurfacesNV
    glVDPAUUnregisterSurfaceNV
    glValidBackBufferHintAutodesk
    glValidateProgram
    glValidateProgramARB
    glValidateProgramPipeline
    glValidateProgramPipelineEXT
    glVariantArrayObjectATI
    glVariantPointerEXT
    glVariantbvEXT
    glVariantdvEXT
    glVariantfvEXT
    glVariantivEXT
    glVariantsvEXT
    glVariantubvEXT
    glVariantuivEXT
    glVariantusvEXT
    glVertex2bOES
    glVertex2bvOES
    glVertex2hNV
    glVertex2hvNV
    glVertex2xOES
    glVertex2xvOES
    glVertex3bOES
    glVertex3bvOES
    glVertex3hNV
    glVertex3hvNV
    glVertex3xOES
    glVertex3xvOES
    glVertex4bOES
    glVertex4bvOES
    glVertex4hNV
    glVertex4hvNV
    glVertex4xOES
    glVertex4xvOES
    glVertexArrayAttribBinding
    glVertexArrayAttribFormat
    glVertexArrayAttribIFormat
    glVertexArrayAttribLFormat
    glVertexArrayBindVertexBufferEXT
    glVertexArrayBindingDivisor
    glVertexArrayColorOffsetEXT
    glVertexArrayEdgeFlagOffsetEXT
    glVertexArrayElementBuffer
    glVertexArrayFogCoordOffsetEXT
    glVertexArrayIndexOffsetEXT
    glVertexArrayMultiTexCoordOffsetEXT
    glVertexArrayNormalOffsetEXT
    glVertexArrayParameteriAPPLE
    glVertexArrayRangeAPPLE
    glVertexArrayRangeNV
    glVertexArraySecondaryColorOffsetEXT
    glVertexArrayTexCoordOffsetEXT
    glVertexArrayVertexAttribBindingEXT
    glVertexArrayVertexAttribDivisorEXT
    glVertexArrayVertexAttribFormatEXT
    glVertexArrayVertexAttribIFormatEXT
    glVertexArrayVertexAttribIOffsetEXT
    glVertexArrayVertexAttribLFormatEXT
    glVertexArrayVertexAttribLOffsetEXT
    glVertexArrayVertexAttribOffsetEXT
    glVertexArrayVertexBindingDivisorEXT
    glVertexArrayVertexBuffer
    glVertexArrayVertexBuffers
    glVertexArrayVertexOffsetEXT
    glVertexAttrib1d
    glVertexAttrib1dARB
    glVertexAttrib1dNV
    glVertexAttrib1dv
    glVertexAttrib1dvARB
    glVertexAttrib1dvNV
    glVertexAttrib1f
    glVertexAttrib1fARB
    glVertexAttrib1fNV
    glVertexAttrib1fv
    glVertexAttrib1fvARB
    glVertexAttrib1fvNV
    glVertexAttrib1hNV
    glVertexAttrib1hvNV
    glVertexAttrib1s
    glVertexAttrib1sARB
    glVertexAttrib1sNV
    glVertexAttrib1sv
    glVertexAttrib1svARB
    glVertexAttrib1svNV
    glVertexAttrib2d
    glVertexAttrib2dARB
    glVertexAttrib2dNV
    glVertexAttrib2dv
    glVertexAttrib2dvARB
    glVertexAttrib2dvNV
    glVertexAttrib2f
    glVertexAttrib2fARB
    glVertexAttrib2fNV
    glVertexAttrib2fv
    glVertexAttrib2fvARB
    glVertexAttrib2fvNV
    glVertexAttrib2hNV
    glVertexAttrib2hvNV
    glVertexAttrib2s
    glVertexAttrib2sARB
    glVertexAttrib2sNV
    glVertexAttrib2sv
    glVertexAttrib2svARB
    glVertexAttrib2svNV
    glVertexAttrib3d
    glVertexAttrib3dARB
    glVertexAttrib3dNV
    glVertexAttrib3dv
    glVertexAttrib3dvARB
    glVertexAttrib3dvNV
    glVertexAttrib3f
    glVertexAttrib3fARB
    glVertexAttrib3fNV
    glVertexAttrib3fv
    glVertexAttrib3fvARB
    glVertexAttrib3fvNV
    glVertexAttrib3hNV
    glVertexAttrib3hvNV
    glVertexAttrib3s
    glVertexAttrib3sARB
    glVertexAttrib3sNV
    glVertexAttrib3sv
    glVertexAttrib3svARB
    glVertexAttrib3svNV
    glVertexAttrib4Nbv
    glVertexAttrib4NbvARB
    glVertexAttrib4Niv
    glVertexAttrib4NivARB
    glVertexAttrib4Nsv
    glVertexAttrib4NsvARB
    glVertexAttrib4Nub
    glVertexAttrib4NubARB
    glVertexAttrib4Nubv
    glVertexAttrib4NubvARB
    glVertexAttrib4Nuiv
    glVertexAttrib4NuivARB
    glVertexAttrib4Nusv
    glVertexAttrib4NusvARB
    glVertexAttrib4bv
    glVertexAttrib4bvARB
    glVertexAttrib4d
    glVertexAttrib4dARB
    glVertexAttrib4dNV
    glVertexAttrib4dv
    glVertexAttrib4dvARB
    glVertexAttrib4dvNV
    glVertexAttrib4f
    glVertexAttrib4fARB
    glVertexAttrib4fNV
    glVertexAttrib4fv
    glVertexAttrib4fvARB
    glVertexAttrib4fvNV
    glVertexAttrib4hNV
    glVertexAttrib4hvNV
    glVertexAttrib4iv
    glVertexAttrib4ivARB
    glVertexAttrib4s
    glVertexAttrib4sARB
    glVertexAttrib4sNV
    glVertexAttrib4sv
    glVertexAttrib4svARB
    glVertexAttrib4svNV
    glVertexAttrib4ubNV
    glVertexAttrib4ubv
    glVertexAttrib4ubvARB
    glVertexAttrib4ubvNV
    glVertexAttrib4uiv
    glVertexAttrib4uivARB
    glVertexAttrib4usv
    glVertexAttrib4usvARB
    glVertexAttribArrayObjectATI
    glVertexAttribBinding
    glVertexAttribDivisor
    glVertexAttribDivisorANGLE
    glVertexAttribDivisorARB
    glVertexAttribDivisorEXT
    glVertexAttribDivisorNV
    glVertexAttribFormat
    glVertexAttribFormatNV
    glVertexAttribI1i
    glVertexAttribI1iEXT
    glVertexAttribI1iv
    glVertexAttribI1ivEXT
    glVertexAttribI1ui
    glVertexAttribI1uiEXT
    glVertexAttribI1uiv
    glVertexAttribI1uivEXT
    glVertexAttribI2i
    glVertexAttribI2iEXT
    glVertexAttribI2iv
    glVertexAttribI2ivEXT
    glVertexAttribI2ui
    glVertexAttribI2uiEXT
    glVertexAttribI2uiv
    glVertexAttribI2uivEXT
    glVertexAttribI3i
    glVertexAttribI3iEXT
    glVertexAttribI3iv
    glVertexAttribI3ivEXT
    glVertexAttribI3ui
    glVertexAttribI3uiEXT
    glVertexAttribI3uiv
    glVertexAttribI3uivEXT
    glVertexAttribI4bv
    glVertexAttribI4bvEXT
    glVertexAttribI4i
    glVertexAttribI4iEXT
    glVertexAttribI4iv
    glVertexAttribI4ivEXT
    glVertexAttribI4sv
    glVertexAttribI4svEXT
    glVertexAttribI4ubv
    glVertexAttribI4ubvEXT
    glVertexAttribI4ui
    glVertexAttribI4uiEXT
    glVertexAttribI4uiv
    glVertexAttribI4uivEXT
    glVertexAttribI4usv
    glVertexAttribI4usvEXT
    glVertexAttribIFormat
    glVertexAttribIFormatNV
    glVertexAttribIPointer
    glVertexAttribIPointerEXT
    glVertexAttribL1d
    glVertexAttribL1dEXT
    glVertexAttribL1dv
    glVertexAttribL1dvEXT
    glVertexAttribL1i64NV
    glVertexAttribL1i64vNV
    glVertexAttribL1ui64ARB
    glVertexAttribL1ui64NV
    glVertexAttribL1ui64vARB
    glVertexAttribL1ui64vNV
    glVertexAttribL2d
    glVertexAttribL2dEXT
    glVertexAttribL2dv
    glVertexAttribL2dvEXT
    glVertexAttribL2i64NV
    glVertexAttribL2i64vNV
    glVertexAttribL2ui64NV
    glVertexAttribL2ui64vNV
    glVertexAttribL3d
    glVertexAttribL3dEXT
    glVertexAttribL3dv
    glVertexAttribL3dvEXT
    glVertexAttribL3i64NV
    glVertexAttribL3i64vNV
    glVertexAttribL3ui64NV
    glVertexAttribL3ui64vNV
    glVertexAttribL4d
    glVertexAttribL4dEXT
    glVertexAttribL4dv
    glVertexAttribL4dvEXT
    glVertexAttribL4i64NV
    glVertexAttribL4i64vNV
    glVertexAttribL4ui64NV
    glVertexAttribL4ui64vNV
    glVertexAttribLFormat
    glVertexAttribLFormatNV
    glVertexAttribLPointer
    glVertexAttribLPointerEXT
    glVertexAttribP1ui
    glVertexAttribP1uiv
    glVertexAttribP2ui
    glVertexAttribP2uiv
    glVertexAttribP3ui
    glVertexAttribP3uiv
    glVertexAttribP4ui
    glVertexAttribP4uiv
    glVertexAttribParameteriAMD
    glVertexAttribPointer
    glVertexAttribPointerARB
    glVertexAttribPointerNV
    glVertexAttribs1dvNV
    glVertexAttribs1fvNV
    glVertexAttribs1hvNV
    glVertexAttribs1svNV
    glVertexAttribs2dvNV
    glVertexAttribs2fvNV
    glVertexAttribs2hvNV
    glVertexAttribs2svNV
    glVertexAttribs3dvNV
    glVertexAttribs3fvNV
    glVertexAttribs3hvNV
    glVertexAttribs3svNV
    glVertexAttribs4dvNV
    glVertexAttribs4fvNV
    glVertexAttribs4hvNV
    glVertexAttribs4svNV
    glVertexAttribs4ubvNV
    glVertexBindingDivisor
    glVertexBlendARB
    glVertexBlendEnvfATI
    glVertexBlendEnviATI
    glVertexFormatNV
    glVertexP2ui
    glVertexP2uiv
    glVertexP3ui
    glVertexP3uiv
    glVertexP4ui
    glVertexP4uiv
    glVertexPointerListIBM
    glVertexPointervINTEL
    glVertexStream1dATI
    glVertexStream1dvATI
    glVertexStream1fATI
    glVertexStream1fvATI
    glVertexStream1iATI
    glVertexStream1ivATI
    glVertexStream1sATI
    glVertexStream1svATI
    glVertexStream2dATI
    glVertexStream2dvATI
    glVertexStream2fATI
    glVertexStream2fvATI
    glVertexStream2iATI
    glVertexStream2ivATI
    glVertexStream2sATI
    glVertexStream2svATI
    glVertexStream3dATI
    glVertexStream3dvATI
    glVertexStream3fATI
    glVertexStream3fvATI
    glVertexStream3iATI
    glVertexStream3ivATI
    glVertexStream3sATI
    glVertexStream3svATI
    glVertexStream4dATI
    glVertexStream4dvATI
    glVertexStream4fATI
    glVertexStream4fvATI
    glVertexStream4iATI
    glVertexStream4ivATI
    glVertexStream4sATI
    glVertexStream4svATI
    glVertexWeightPointerEXT
    glVertexWeightfEXT
    glVertexWeightfvEXT
    glVertexWeighthNV
    glVertexWeighthvNV
    glVideoCaptureNV
    glVideoCaptureStreamParameterdvNV
    glVideoCaptureStreamParameterfvNV
    glVideoCaptureStreamParameterivNV
    glViewportArrayv
    glViewportArrayvNV
    glViewportArrayvOES
    glViewportIndexedf
    glViewportIndexedfNV
    glViewportIndexedfOES
    glViewportIndexedfv
    glViewportIndexedfvNV
    glViewportIndexedfvOES
    glViewportPositionWScaleNV
    glViewportSwizzleNV
    glWaitSemaphoreEXT
    glWaitSemaphoreui64NVX
    glWaitSync
    glWaitSyncAPPLE
    glWaitSyncValueuiNVX
    glWaitVkSemaphoreNV
    glWeightPathsNV
    glWeightPointerARB
    glWeightPointerOES
    glWeightbvARB
    glWeightdvARB
    glWeightfvARB
    glWeightivARB
    glWeightsvARB
    glWeightubvARB
    glWeightuivARB
    glWeightusvARB
    glWindowBackBufferHintAutodesk
    glWindowRectanglesEXT
    glWriteMaskEXT
}
