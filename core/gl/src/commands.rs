//! Commands that a display list may hold. Each is declared once: the macro makes the public method
//! (which checks Begin/End, and records instead of executing while a list is compiled), the recorded
//! form and its execution.

use afterglow_api::constants::*;

use crate::context::Context;

macro_rules! commands {
    ($($(#[$meta:meta])* $variant:ident = $method:ident($($arg:ident: $ty:ty),*) => $exec:ident;)*) => {
        /// A recorded command.
        #[derive(Debug, Clone)]
        pub enum Command {
            $($variant { $($arg: $ty,)* },)*
            /// What was not allowed between Begin and End: an error when the list is executed (specification 5.4).
            Refused,
        }

        #[allow(clippy::too_many_arguments, reason = "some commands have so many")]
        impl Context {
            $(
                $(#[$meta])*
                pub fn $method(&mut self, $($arg: $ty),*) {
                    if self.in_begin() {
                        return self.refuse();
                    }
                    if let Some(list) = &mut self.list {
                        list.push(Command::$variant { $($arg: $arg.clone(),)* });
                        if !list.executes {
                            return;
                        }
                    }
                    self.$exec($($arg),*);
                }
            )*

            /// The error of a command between Begin and End, or its record.
            #[cold]
            pub(crate) fn refuse(&mut self) {
                if let Some(list) = &mut self.list {
                    list.push(Command::Refused);
                    if !list.executes {
                        return;
                    }
                }
                self.record_error(GL_INVALID_OPERATION);
            }

            /// Executes a recorded command.
            pub(crate) fn execute(&mut self, command: &Command) {
                match command {
                    $(Command::$variant { $($arg,)* } => self.$exec($($arg.clone()),*),)*
                    Command::Refused => self.record_error(GL_INVALID_OPERATION),
                }
            }
        }
    };
}

commands! {
    /// glAccum.
    Accum = accum(op: u32, value: f32) => exec_accum;
    /// glActiveTexture.
    ActiveTexture = active_texture(unit: u32) => exec_active_texture;
    /// glAlphaFunc.
    AlphaFunc = alpha_func(func: u32, reference: f32) => exec_alpha_func;
    /// glBeginQuery.
    BeginQuery = begin_query(target: u32, id: u32) => exec_begin_query;
    /// glBindTexture.
    BindTexture = bind_texture(target: u32, name: u32) => exec_bind_texture;
    /// glBlendColor.
    BlendColor = blend_color(red: f32, green: f32, blue: f32, alpha: f32) => exec_blend_color;
    /// glBlendEquation.
    BlendEquation = blend_equation(mode: u32) => exec_blend_equation;
    /// glBlendFunc.
    BlendFunc = blend_func(source: u32, destination: u32) => exec_blend_func;
    /// glBlendFuncSeparate.
    BlendFuncSeparate = blend_func_separate(source_rgb: u32, destination_rgb: u32, source_alpha: u32, destination_alpha: u32) => exec_blend_func_separate;
    /// glClear.
    Clear = clear(mask: u32) => exec_clear;
    /// glClearAccum.
    ClearAccum = clear_accum(red: f32, green: f32, blue: f32, alpha: f32) => exec_clear_accum;
    /// glClearColor.
    ClearColor = clear_color(red: f32, green: f32, blue: f32, alpha: f32) => exec_clear_color;
    /// glClearDepth.
    ClearDepth = clear_depth(depth: f64) => exec_clear_depth;
    /// glClearIndex.
    ClearIndex = clear_index(index: f32) => exec_clear_index;
    /// glClearStencil.
    ClearStencil = clear_stencil(value: i32) => exec_clear_stencil;
    /// glClipPlane.
    ClipPlane = clip_plane(plane: u32, equation: [f64; 4]) => exec_clip_plane;
    /// glColorMask.
    ColorMask = color_mask(red: bool, green: bool, blue: bool, alpha: bool) => exec_color_mask;
    /// glColorMaterial.
    ColorMaterial = color_material(face: u32, mode: u32) => exec_color_material;
    /// glCullFace.
    CullFace = cull_face(face: u32) => exec_cull_face;
    /// glDepthFunc.
    DepthFunc = depth_func(func: u32) => exec_depth_func;
    /// glDepthMask.
    DepthMask = depth_mask(write: bool) => exec_depth_mask;
    /// glDepthRange.
    DepthRange = depth_range(near: f64, far: f64) => exec_depth_range;
    /// glDisable.
    Disable = disable(cap: u32) => exec_disable;
    /// glDrawBuffer.
    DrawBuffer = draw_buffer(buffer: u32) => exec_draw_buffer;
    /// glEnable.
    Enable = enable(cap: u32) => exec_enable;
    /// glEndQuery.
    EndQuery = end_query(target: u32) => exec_end_query;
    /// glFrontFace.
    FrontFace = front_face(mode: u32) => exec_front_face;
    /// glFrustum.
    Frustum = frustum(left: f64, right: f64, bottom: f64, top: f64, near: f64, far: f64) => exec_frustum;
    /// glHint.
    Hint = hint(target: u32, mode: u32) => exec_hint;
    /// glIndexMask.
    IndexMask = index_mask(mask: u32) => exec_index_mask;
    /// glInitNames.
    InitNames = init_names() => exec_init_names;
    /// glLineStipple.
    LineStipple = line_stipple(factor: i32, pattern: u16) => exec_line_stipple;
    /// glLineWidth.
    LineWidth = line_width(width: f32) => exec_line_width;
    /// glListBase.
    ListBase = list_base(base: u32) => exec_list_base;
    /// glLoadIdentity.
    LoadIdentity = load_identity() => exec_load_identity;
    /// glLoadMatrix.
    LoadMatrix = load_matrix(matrix: [f32; 16]) => exec_load_matrix;
    /// glLoadTransposeMatrix.
    LoadTransposeMatrix = load_transpose_matrix(matrix: [f32; 16]) => exec_load_transpose_matrix;
    /// glLoadName.
    LoadName = load_name(name: u32) => exec_load_name;
    /// glLogicOp.
    LogicOp = logic_op(op: u32) => exec_logic_op;
    /// glMatrixMode.
    MatrixMode = matrix_mode(mode: u32) => exec_matrix_mode;
    /// glMultMatrix.
    MultMatrix = mult_matrix(matrix: [f32; 16]) => exec_mult_matrix;
    /// glMultTransposeMatrix.
    MultTransposeMatrix = mult_transpose_matrix(matrix: [f32; 16]) => exec_mult_transpose_matrix;
    /// glOrtho.
    Ortho = ortho(left: f64, right: f64, bottom: f64, top: f64, near: f64, far: f64) => exec_ortho;
    /// glPassThrough.
    PassThrough = pass_through(token: f32) => exec_pass_through;
    /// glPixelTransfer.
    PixelTransfer = pixel_transfer(pname: u32, value: f32) => exec_pixel_transfer;
    /// glPixelZoom.
    PixelZoom = pixel_zoom(x: f32, y: f32) => exec_pixel_zoom;
    /// glPointSize.
    PointSize = point_size(size: f32) => exec_point_size;
    /// glPolygonMode.
    PolygonMode = polygon_mode(face: u32, mode: u32) => exec_polygon_mode;
    /// glPolygonOffset.
    PolygonOffset = polygon_offset(factor: f32, units: f32) => exec_polygon_offset;
    /// glPopAttrib.
    PopAttrib = pop_attrib() => exec_pop_attrib;
    /// glPopMatrix.
    PopMatrix = pop_matrix() => exec_pop_matrix;
    /// glPopName.
    PopName = pop_name() => exec_pop_name;
    /// glPushAttrib.
    PushAttrib = push_attrib(mask: u32) => exec_push_attrib;
    /// glPushMatrix.
    PushMatrix = push_matrix() => exec_push_matrix;
    /// glPushName.
    PushName = push_name(name: u32) => exec_push_name;
    /// glRasterPos.
    RasterPos = raster_pos(position: [f32; 4]) => exec_raster_pos;
    /// glReadBuffer.
    ReadBuffer = read_buffer(buffer: u32) => exec_read_buffer;
    /// glRotate.
    Rotate = rotate(angle: f32, x: f32, y: f32, z: f32) => exec_rotate;
    /// glSampleCoverage.
    SampleCoverage = sample_coverage(value: f32, invert: bool) => exec_sample_coverage;
    /// glScale.
    Scale = scale(x: f32, y: f32, z: f32) => exec_scale;
    /// glSceneClassAFTERGLOW.
    SceneClass = scene_class(class: u32) => exec_scene_class;
    /// glSceneDefaultsAFTERGLOW.
    SceneDefaults = scene_defaults() => exec_scene_defaults;
    /// glSceneEmissionAFTERGLOW.
    SceneEmission = scene_emission(red: f32, green: f32, blue: f32) => exec_scene_emission;
    /// glSceneMapAFTERGLOW.
    SceneMap = scene_map(map: u32, texture: u32) => exec_scene_map;
    /// glSceneMaterialAFTERGLOW.
    SceneMaterial = scene_material(roughness: f32, metallic: f32) => exec_scene_material;
    /// glSceneObjectAFTERGLOW.
    SceneObject = scene_object(object: u64) => exec_scene_object;
    /// glScissor.
    Scissor = scissor(x: i32, y: i32, width: i32, height: i32) => exec_scissor;
    /// glShadeModel.
    ShadeModel = shade_model(mode: u32) => exec_shade_model;
    /// glStencilFunc.
    StencilFunc = stencil_func(func: u32, reference: i32, mask: u32) => exec_stencil_func;
    /// glStencilMask.
    StencilMask = stencil_mask(mask: u32) => exec_stencil_mask;
    /// glStencilOp.
    StencilOp = stencil_op(fail: u32, depth_fail: u32, pass: u32) => exec_stencil_op;
    /// glTranslate.
    Translate = translate(x: f32, y: f32, z: f32) => exec_translate;
    /// glViewport.
    Viewport = viewport(x: i32, y: i32, width: i32, height: i32) => exec_viewport;
    /// glWindowPos.
    WindowPos = window_pos(position: [f32; 3]) => exec_window_pos;
    /// glCopyPixels.
    CopyPixels = copy_pixels(x: i32, y: i32, width: i32, height: i32, kind: u32) => exec_copy_pixels;
    /// glCopyTexImage1D and 2D (`height` is `None` for 1D).
    CopyTexImage = copy_tex_image(target: u32, level: i32, internal: u32, x: i32, y: i32, width: i32, height: Option<i32>, border: i32) => exec_copy_tex_image;
    /// glCopyTexSubImage1D, 2D and 3D.
    CopyTexSubImage = copy_tex_sub_image(target: u32, level: i32, offset: [i32; 3], x: i32, y: i32, width: i32, height: i32) => exec_copy_tex_sub_image;

    /// The vector form behind [`Context::light`].
    LightV = light_values(light: u32, pname: u32, values: crate::params::Values) => exec_light;
    /// The vector form behind [`Context::light_model`].
    LightModelV = light_model_values(pname: u32, values: crate::params::Values) => exec_light_model;
    /// The vector form behind [`Context::fog`].
    FogV = fog_values(pname: u32, values: crate::params::Values) => exec_fog;
    /// The vector form behind [`Context::tex_env`].
    TexEnvV = tex_env_values(target: u32, pname: u32, values: crate::params::Values) => exec_tex_env;
    /// The vector form behind [`Context::tex_gen`].
    TexGenV = tex_gen_values(coord: u32, pname: u32, values: crate::params::Values) => exec_tex_gen;
    /// The vector form behind [`Context::tex_parameter`].
    TexParameterV = tex_parameter_values(target: u32, pname: u32, values: crate::params::Values) => exec_tex_parameter;
    /// The vector form behind [`Context::point_parameter`].
    PointParameterV = point_parameter_values(pname: u32, values: crate::params::Values) => exec_point_parameter;
    /// The owned form behind [`Context::pixel_map`].
    PixelMapV = pixel_map_values(map: u32, values: std::sync::Arc<[f32]>) => exec_pixel_map;
    /// The owned form behind [`Context::polygon_stipple`].
    PolygonStippleV = polygon_stipple_pattern(pattern: std::sync::Arc<[u8]>) => exec_polygon_stipple;
    /// The owned form behind [`Context::prioritize_textures`].
    PrioritizeTexturesV = prioritize_textures_owned(names: std::sync::Arc<[u32]>, priorities: std::sync::Arc<[f32]>) => exec_prioritize_textures;
    /// The owned form behind the texture image commands.
    TexImageV = tex_image_owned(call: std::sync::Arc<crate::tex_images::TexImageCall>) => exec_tex_image;
    /// The owned form behind glDrawPixels.
    DrawPixelsV = draw_pixels_owned(call: std::sync::Arc<crate::pixels::DrawPixelsCall>) => exec_draw_pixels;
    /// The owned form behind glBitmap.
    BitmapV = bitmap_owned(call: std::sync::Arc<crate::pixels::BitmapCall>) => exec_bitmap;
}
