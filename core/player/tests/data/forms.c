/* Calls whose arguments a trace keeps in some form of its own: arrays, memory, results. */
#include "window.h"

static const GLfloat points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
static const GLubyte colors[] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 9};
static const GLubyte square[] = {0, 1, 2, 3};
static const struct { GLubyte color[4]; GLfloat point[3]; } interleaved[] = {
    {{1, 2, 3, 4}, {0, 0, 0}}, {{5, 6, 7, 8}, {1, 0, 0}}, {{9, 10, 11, 12}, {1, 1, 0}},
};

static void lists(void) {
    static const GLubyte bytes[] = {0, 1};
    static const GLbyte negative[] = {-1, 0};
    static const GLushort shorts[] = {0, 1};
    static const GLint ints[] = {0, 1};
    static const GLfloat floats[] = {0, 1};
    static const GLubyte two_bytes[] = {0, 0, 0, 1};
    GLuint base = glGenLists(2);
    glNewList(base, GL_COMPILE);
    glColor3ub(1, 2, 3);
    glEndList();
    glNewList(base + 1, GL_COMPILE_AND_EXECUTE);
    glNormal3b(127, 0, -128);
    glEndList();
    /* A name that nobody generated. */
    glNewList(1000, GL_COMPILE);
    glCallList(base);
    glEndList();
    glListBase(base);
    glCallLists(2, GL_UNSIGNED_BYTE, bytes);
    glCallLists(2, GL_UNSIGNED_SHORT, shorts);
    glCallLists(2, GL_INT, ints);
    glCallLists(2, GL_FLOAT, floats);
    glCallLists(2, GL_2_BYTES, two_bytes);
    glListBase(base + 1);
    glCallLists(2, GL_BYTE, negative);
    glListBase(0);
    glCallList(1000);
    glDeleteLists(base, 2);
}

static void arrays(void) {
    static const GLint firsts[] = {0, 1};
    static const GLsizei counts[] = {3, 3};
    static const GLvoid *indices[] = {square, square + 1};
    glVertexPointer(3, GL_FLOAT, 0, points);
    glColorPointer(4, GL_UNSIGNED_BYTE, 0, colors);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glDrawArrays(GL_QUADS, 0, 4);
    glDrawElements(GL_QUADS, 4, GL_UNSIGNED_BYTE, square);
    glDrawRangeElements(GL_QUADS, 0, 3, 4, GL_UNSIGNED_BYTE, square);
    glMultiDrawArrays(GL_TRIANGLES, firsts, counts, 2);
    glMultiDrawElements(GL_TRIANGLES, counts, GL_UNSIGNED_BYTE, indices, 2);
    glLockArraysEXT(0, 4);
    glDrawElements(GL_QUADS, 4, GL_UNSIGNED_BYTE, square);
    glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_BYTE, square);
    glUnlockArraysEXT();
    glBegin(GL_TRIANGLES);
    glArrayElement(0);
    glArrayElement(1);
    glArrayElement(2);
    glEnd();
    glDisableClientState(GL_COLOR_ARRAY);
    glInterleavedArrays(GL_C4UB_V3F, 0, interleaved);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisableClientState(GL_VERTEX_ARRAY);
    glDisableClientState(GL_COLOR_ARRAY);
}

static void numbers(void) {
    static const GLint ambient[] = {2147483647, 0, 0, 2147483647};
    static const GLdouble plane[] = {1, 2, 3, 4};
    static const GLushort map[] = {0, 65535};
    static const GLshort position[] = {3, 4};
    static const GLboolean no = GL_FALSE;
    glLightiv(GL_LIGHT0, GL_AMBIENT, ambient);
    glLighti(GL_LIGHT0, GL_SPOT_EXPONENT, 7);
    glTexGendv(GL_S, GL_OBJECT_PLANE, plane);
    glClipPlane(GL_CLIP_PLANE0, plane);
    glPixelMapusv(GL_PIXEL_MAP_R_TO_R, 2, map);
    glRasterPos2sv(position);
    glWindowPos2i(5, 6);
    glRects(1, 2, 3, 4);
    glRectsv(position, position);
    glEdgeFlagv(&no);
    glEdgeFlag(GL_TRUE);
    glSecondaryColor3ub(255, 0, 128);
    glMultiTexCoord2sv(GL_TEXTURE1, position);
    glIndexub(200);
    glFogCoordd(0.5);
    glLineStipple(3, 0xaaaa);
    glBlendEquation(GL_MAX);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(0x1234);
    glGetError();
}

static void images(void) {
    static const GLubyte texels[4 * 16] = {1, 2, 3, 4};
    static const GLubyte bits[8] = {0x80, 0, 0, 0, 0x40};
    GLubyte stipple[128], back[16];
    GLuint names[2];
    memset(stipple, 0x33, sizeof stipple);
    glGenTextures(2, names);
    glBindTexture(GL_TEXTURE_2D, names[1]);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glTexImage2D(GL_TEXTURE_2D, 1, 4, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 1, 1, 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glTexImage1D(GL_TEXTURE_1D, 0, GL_LUMINANCE, 4, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, texels);
    glCompressedTexImage2D(GL_TEXTURE_2D, 2, GL_COMPRESSED_RGB_S3TC_DXT1_EXT, 4, 4, 0, 8, texels);
    glPolygonStipple(stipple);
    glDrawPixels(2, 2, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glBitmap(8, 2, 0, 0, 8, 0, bits);
    glBitmap(0, 0, 0, 0, 1, 0, NULL);
    glReadPixels(0, 0, 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, back);
    glDeleteTextures(2, names);
}

int main(void) {
    open_window(64, 48);
    lists();
    glXSwapBuffers(display, window);
    arrays();
    glXSwapBuffers(display, window);
    numbers();
    glXSwapBuffers(display, window);
    images();
    glXSwapBuffers(display, window);
    return 0;
}
