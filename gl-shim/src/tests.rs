//! Entry points as a program in C calls them, on a context without a device.

use std::ffi::{CStr, c_void};
use std::ptr::{null, null_mut};

use afterglow_api::constants::*;
use afterglow_gl::backend::NullBackend;
use afterglow_gl::{Context, SharedNames};

use crate::generated::exports::*;
use crate::{current, stub};

/// Runs `calls` with a current context.
fn with_current<T>(calls: impl FnOnce() -> T) -> T {
    let mut context = Context::new(Box::new(NullBackend), SharedNames::default());
    context.set_drawable(64, 48);
    current::set(&mut context);
    let result = calls();
    current::set(null_mut());
    result
}

/// glGetError.
fn error() -> u32 {
    // SAFETY: no pointers.
    unsafe { glGetError() }
}

#[test]
fn without_a_context_nothing_happens() {
    let mut name = 7;
    // SAFETY: the pointers are good or null.
    unsafe {
        glEnable(GL_LIGHTING);
        glHint(GL_FOG_HINT, GL_NICEST);
        glVertex3f(1.0, 2.0, 3.0);
        glColor4fv(null());
        glGenTextures(1, &mut name);
        glGetIntegerv(GL_MAX_TEXTURE_SIZE, null_mut());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glCallList(1);
        glMap1f(0, 0.0, 0.0, 0, 0, null());
        assert_eq!(glGenLists(1), 0);
        assert_eq!(glIsEnabled(GL_LIGHTING), 0);
        assert!(glGetString(GL_VENDOR).is_null());
        assert!(glMapBuffer(GL_ARRAY_BUFFER, GL_READ_WRITE).is_null());
    }
    assert_eq!(glUseProgram(), 0);
    assert_eq!((name, error()), (7, GL_NO_ERROR));
}

#[test]
fn getters_write_what_they_are_asked_for() {
    with_current(|| {
        let (mut ints, mut floats, mut doubles, mut bytes) = ([0; 4], [0.0f32; 16], [0.0f64; 4], [9u8; 4]);
        // SAFETY: there is room.
        unsafe {
            glGetIntegerv(GL_VIEWPORT, ints.as_mut_ptr());
            assert_eq!(ints, [0, 0, 64, 48]);
            glTranslatef(1.0, 2.0, 3.0);
            glGetFloatv(GL_MODELVIEW_MATRIX, floats.as_mut_ptr());
            assert_eq!(floats[11..], [0.0, 1.0, 2.0, 3.0, 1.0]);
            glGetBooleanv(GL_COLOR_WRITEMASK, bytes.as_mut_ptr());
            assert_eq!(bytes, [1; 4]);
            glClipPlane(GL_CLIP_PLANE0, [1.0, 0.0, 0.0, 4.0].as_ptr());
            glGetClipPlane(GL_CLIP_PLANE0, doubles.as_mut_ptr());
            assert_eq!(doubles, [1.0, 0.0, 0.0, 3.0]);
            glLightfv(GL_LIGHT0, GL_DIFFUSE, [0.5, 0.25, 0.0, 1.0].as_ptr());
            glGetLightfv(GL_LIGHT0, GL_DIFFUSE, floats.as_mut_ptr());
            assert_eq!(floats[..4], [0.5, 0.25, 0.0, 1.0]);
            glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, 0, ints.as_mut_ptr());
        }
        assert_eq!(ints[0], 0, "a call in error writes nothing");
        assert_eq!(error(), GL_INVALID_ENUM);
    });
}

#[test]
fn names_are_given_and_taken() {
    with_current(|| {
        let mut names = [0; 3];
        // SAFETY: there is room for three names.
        unsafe {
            glGenTextures(3, names.as_mut_ptr());
            assert_eq!(names, [1, 2, 3]);
            assert_eq!(glIsTexture(2), 0);
            glBindTexture(GL_TEXTURE_2D, 2);
            assert_eq!(glIsTexture(2), 1);
            assert_eq!(glAreTexturesResident(1, &2, null_mut()), 1);
            glDeleteTextures(3, names.as_ptr());
            assert_eq!(glIsTexture(2), 0);
            glDeleteTextures(-1, names.as_ptr());
        }
        assert_eq!((error(), error()), (GL_INVALID_VALUE, GL_NO_ERROR));
    });
}

#[test]
fn strings_stay_where_they_are() {
    with_current(|| {
        // SAFETY: no pointers are taken, and the strings end.
        unsafe {
            let version = glGetString(GL_VERSION);
            assert!(CStr::from_ptr(version.cast()).to_bytes().starts_with(b"1."));
            assert_eq!(glGetString(GL_VERSION), version);
            assert!(glGetString(GL_FOG).is_null());
        }
        assert_eq!(error(), GL_INVALID_ENUM);
    });
}

#[test]
fn mapped_buffers_are_the_programs_memory() {
    with_current(|| {
        let (mut bytes, mut address) = ([0u8; 4], null_mut());
        // SAFETY: four bytes are mapped, and there is room for what is read.
        unsafe {
            glBindBuffer(GL_ARRAY_BUFFER, 1);
            glBufferData(GL_ARRAY_BUFFER, 4, [1u8, 2, 3, 4].as_ptr().cast(), GL_STATIC_DRAW);
            let mapped = glMapBufferARB(GL_ARRAY_BUFFER, GL_READ_WRITE);
            glGetBufferPointerv(GL_ARRAY_BUFFER, GL_BUFFER_MAP_POINTER, &mut address);
            assert_eq!(mapped, address);
            let mapped = mapped.cast::<u8>();
            assert_eq!(mapped.add(2).read(), 3);
            mapped.write(9);
            assert_eq!(glUnmapBuffer(GL_ARRAY_BUFFER), 1);
            glGetBufferSubData(GL_ARRAY_BUFFER, 0, 4, bytes.as_mut_ptr().cast());
            assert_eq!(bytes, [9, 2, 3, 4]);
            assert_eq!(glUnmapBuffer(GL_ARRAY_BUFFER), 0);
        }
        assert_eq!(error(), GL_INVALID_OPERATION);
    });
}

#[test]
fn textures_are_read_as_pixel_store_says() {
    with_current(|| {
        // Two rows of one texel, three texels apart.
        let image = [1u8, 2, 3, 4, 0, 0, 0, 0, 0, 0, 0, 0, 5, 6, 7, 8];
        let (mut texels, mut width) = ([0u8; 8], 0);
        // SAFETY: the image ends with the last texel that is read, and there is room for what is written.
        unsafe {
            glPixelStorei(GL_UNPACK_ROW_LENGTH, 3);
            glTexImage2D(
                GL_TEXTURE_2D,
                0,
                GL_RGBA as i32,
                1,
                2,
                0,
                GL_RGBA,
                GL_UNSIGNED_BYTE,
                image.as_ptr().cast(),
            );
            glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &mut width);
            glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.as_mut_ptr().cast());
        }
        assert_eq!((width, texels, error()), (1, [1, 2, 3, 4, 5, 6, 7, 8], GL_NO_ERROR));
    });
}

#[test]
fn arrays_are_kept_as_addresses() {
    with_current(|| {
        let (vertices, mut address) = ([0.0f32; 9], null_mut());
        // SAFETY: there are three vertices, and indices below three.
        unsafe {
            glEnableClientState(GL_VERTEX_ARRAY);
            glVertexPointer(3, GL_FLOAT, 0, vertices.as_ptr().cast());
            glGetPointerv(GL_VERTEX_ARRAY_POINTER, &mut address);
            assert_eq!(address.cast_const(), vertices.as_ptr().cast::<c_void>());
            glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_BYTE, [0u8, 2, 1].as_ptr().cast());
            let indices = [2u16, 1, 0];
            let lists = [indices.as_ptr().cast::<c_void>()];
            glMultiDrawElements(GL_TRIANGLES, [3].as_ptr(), GL_UNSIGNED_SHORT, lists.as_ptr(), 1);
            glCallLists(2, GL_2_BYTES, [0u8, 1, 0, 2].as_ptr().cast());
            glVertexPointer(3, GL_FLOAT, 0, null());
            glDrawArrays(GL_TRIANGLES, 0, 3);
        }
        assert_eq!(error(), GL_NO_ERROR);
    });
}

#[test]
fn pixels_and_lists_read_the_programs_memory() {
    with_current(|| {
        let (mut pixels, mut stipple, mut listed) = ([7u8; 8], [0u8; 128], 0);
        // SAFETY: images are as large as is said.
        unsafe {
            glReadPixels(0, 0, 2, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixels.as_mut_ptr().cast());
            glReadPixels(0, 0, -2, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixels.as_mut_ptr().cast());
            assert_eq!(error(), GL_INVALID_VALUE);
            glPolygonStipple([0xa5u8; 128].as_ptr());
            glGetPolygonStipple(stipple.as_mut_ptr());
            assert_eq!(stipple, [0xa5; 128]);
            let list = glGenLists(2);
            glNewList(list + 1, GL_COMPILE);
            glBitmap(8, 1, 0.0, 0.0, 5.0, 0.0, [0xffu8].as_ptr());
            glDrawPixels(1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixels.as_ptr().cast());
            glFogf(GL_FOG_DENSITY, 3.0);
            glEndList();
            glListBase(list);
            glCallLists(1, GL_UNSIGNED_BYTE, [1u8].as_ptr().cast());
            glGetIntegerv(GL_FOG_DENSITY, &mut listed);
        }
        assert_eq!((listed, error()), (3, GL_NO_ERROR));
    });
}

#[test]
fn attributes_reach_the_context_in_all_types() {
    with_current(|| {
        let mut color = [0.0; 4];
        // SAFETY: there is room for four values.
        unsafe {
            glColor4ub(255, 0, 51, 255);
            glGetFloatv(GL_CURRENT_COLOR, color.as_mut_ptr());
            assert_eq!(color, [1.0, 0.0, 0.2, 1.0]);
            glColor3dv([0.5, 0.25, 1.0].as_ptr());
            glGetFloatv(GL_CURRENT_COLOR, color.as_mut_ptr());
            assert_eq!(color, [0.5, 0.25, 1.0, 1.0]);
            glMultiTexCoord2sARB(GL_TEXTURE1, 3, 4);
            glActiveTexture(GL_TEXTURE1);
            glGetFloatv(GL_CURRENT_TEXTURE_COORDS, color.as_mut_ptr());
            assert_eq!(color, [3.0, 4.0, 0.0, 1.0]);
        }
    });
}

#[test]
fn stubs_are_errors() {
    with_current(|| {
        let before = stub::calls();
        assert_eq!(glCreateProgram(), 0);
        assert_eq!(error(), GL_INVALID_OPERATION);
        // SAFETY: the pointer is not followed.
        unsafe { glMap1d(GL_MAP1_VERTEX_3, 0.0, 1.0, 3, 2, null()) };
        assert_eq!(error(), GL_INVALID_OPERATION);
        assert!(stub::calls() >= before + 2);
    });
}

#[test]
fn what_is_said_of_a_scene_reaches_the_context() {
    with_current(|| {
        let (place, light, mut most) = ([1.0f32, 2.0, 3.0], [1.0f32, 0.5, 0.25], 0);
        // SAFETY: three numbers each, and room for one.
        unsafe {
            glSceneObjectAFTERGLOW(u64::MAX);
            glSceneClassAFTERGLOW(GL_SCENE_STATIC_AFTERGLOW);
            glSceneMaterialAFTERGLOW(0.5, 1.0);
            glSceneEmissionAFTERGLOW(1.0, 2.0, 3.0);
            glSceneMapAFTERGLOW(GL_SCENE_NORMAL_MAP_AFTERGLOW, 4);
            glSceneViewAFTERGLOW();
            glScenePointLightAFTERGLOW(1, place.as_ptr(), light.as_ptr(), 0.5);
            glSceneSpotLightAFTERGLOW(2, place.as_ptr(), place.as_ptr(), light.as_ptr(), 0.5, 30.0, 1.0);
            glSceneDirectionalLightAFTERGLOW(3, place.as_ptr(), light.as_ptr(), 0.5);
            glSceneSkyAFTERGLOW(0.1, 0.2, 0.3);
            glSceneCutAFTERGLOW();
            glSceneDefaultsAFTERGLOW();
            assert_eq!(error(), GL_NO_ERROR);
            glGetIntegerv(GL_MAX_SCENE_LIGHTS_AFTERGLOW, &mut most);
            assert_eq!(most, 256);
            // A null pointer reads as zeros: no direction.
            glSceneDirectionalLightAFTERGLOW(3, null(), light.as_ptr(), 0.5);
            assert_eq!(error(), GL_INVALID_VALUE);
            let extensions = CStr::from_ptr(glGetString(GL_EXTENSIONS).cast()).to_str();
            assert!(
                extensions.is_ok_and(|list| list.split(' ').any(|name| name == "GL_AFTERGLOW_scene_hints"))
            );
        }
    });
}
