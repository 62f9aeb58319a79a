/* What GLX promises beyond drawing and swapping, seen from a program: what X shows, what calls answer. Prints a line a
 * failure; the exit status is their number. Reads its windows back through X, so nothing may cover them. */

#define GL_GLEXT_PROTOTYPES
#define GLX_GLXEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define SIDE 64
#define RED 0xff0000u
#define GREEN 0x00ff00u
#define BLUE 0x0000ffu

static Display *display;
static int failures;
static int last_error;

static void check(int is_right, const char *what) {
    if (!is_right) {
        printf("FAIL: %s\n", what);
        failures++;
    }
}

static int note_error(Display *from, XErrorEvent *event) {
    (void)from;
    last_error = event->error_code;
    return 0;
}

static XVisualInfo *visual(int is_double) {
    int single_list[] = {GLX_RGBA, GLX_RED_SIZE, 8, GLX_DEPTH_SIZE, 16, None};
    int double_list[] = {GLX_RGBA, GLX_RED_SIZE, 8, GLX_DEPTH_SIZE, 16, GLX_DOUBLEBUFFER, None};
    return glXChooseVisual(display, DefaultScreen(display), is_double ? double_list : single_list);
}

static Window window(XVisualInfo *info, int x) {
    Window root = DefaultRootWindow(display);
    XSetWindowAttributes attributes = {0};
    attributes.colormap = XCreateColormap(display, root, info->visual, AllocNone);
    attributes.override_redirect = True;
    Window made = XCreateWindow(display, root, x, 0, SIDE, SIDE, 0, info->depth, InputOutput, info->visual,
                                CWColormap | CWOverrideRedirect, &attributes);
    XMapRaised(display, made);
    XSync(display, False);
    return made;
}

static void clear(unsigned color) {
    glClearColor((color >> 16 & 255) / 255.f, (color >> 8 & 255) / 255.f, (color & 255) / 255.f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/* A rectangle of the whole drawable. */
static void fill(unsigned color) {
    glColor3ub(color >> 16, color >> 8 & 255, color & 255);
    glRectf(-1, -1, 1, 1);
}

static unsigned x_pixel(Drawable from) {
    XImage *image = XGetImage(display, from, SIDE / 2, SIDE / 2, 1, 1, AllPlanes, ZPixmap);
    unsigned color = image ? XGetPixel(image, 0, 0) & 0xffffff : 1;
    if (image)
        XDestroyImage(image);
    return color;
}

/* Pictures reach X a little later than the program goes on. */
static int shows(Drawable drawable, unsigned color) {
    for (int i = 0; i < 100; i++) {
        if (x_pixel(drawable) == color)
            return 1;
        usleep(20000);
    }
    return 0;
}

static unsigned gl_pixel(void) {
    unsigned char rgb[4];
    glReadPixels(SIDE / 2, SIDE / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgb);
    return (unsigned)rgb[0] << 16 | (unsigned)rgb[1] << 8 | rgb[2];
}

static int integer(GLenum name) {
    GLint value = -1;
    glGetIntegerv(name, &value);
    return value;
}

static void single_buffer(void) {
    XVisualInfo *info = visual(0);
    Window at = window(info, 0);
    GLXContext context = glXCreateContext(display, info, NULL, True);
    glXMakeCurrent(display, at, context);
    check(integer(GL_DOUBLEBUFFER) == 0, "GL_DOUBLEBUFFER of a single buffer");
    check(integer(GL_DRAW_BUFFER) == GL_FRONT && integer(GL_READ_BUFFER) == GL_FRONT, "a single buffer is the front one");
    glDrawBuffer(GL_BACK);
    check(glGetError() == GL_INVALID_OPERATION, "a single buffer has no back");
    clear(BLUE);
    glFlush();
    check(shows(at, BLUE), "a cleared single buffer shows after glFlush");
    fill(GREEN);
    glFinish();
    check(shows(at, GREEN), "a single buffer shows after glFinish");
    fill(RED);
    glXMakeCurrent(display, None, NULL);
    check(shows(at, RED), "a single buffer shows when it is no longer current");
    glXDestroyContext(display, context);
    XDestroyWindow(display, at);
}

static void front_buffer(void) {
    XVisualInfo *info = visual(1);
    Window at = window(info, 0);
    GLXContext context = glXCreateContext(display, info, NULL, True);
    glXMakeCurrent(display, at, context);
    check(integer(GL_DOUBLEBUFFER) == 1 && integer(GL_DRAW_BUFFER) == GL_BACK, "two buffers, drawn to the back");
    clear(BLUE);
    glXSwapBuffers(display, at);
    check(shows(at, BLUE), "a swap shows");
    glDrawBuffer(GL_FRONT);
    fill(GREEN);
    glFlush();
    check(shows(at, GREEN), "the front buffer shows after glFlush");
    fill(RED);
    glDrawBuffer(GL_BACK);
    glFinish();
    check(shows(at, RED), "what was drawn to the front buffer before shows after glFinish");
    glXMakeCurrent(display, None, NULL);
    glXDestroyContext(display, context);
    XDestroyWindow(display, at);
}

static void pixmap(void) {
    XVisualInfo *info = visual(0);
    Pixmap of_x = XCreatePixmap(display, DefaultRootWindow(display), SIDE, SIDE, info->depth);
    GLXPixmap made = glXCreateGLXPixmap(display, info, of_x);
    GLXContext context = glXCreateContext(display, info, NULL, True);
    check(glXMakeCurrent(display, made, context), "a pixmap is current");
    clear(GREEN);
    glXWaitGL();
    check(x_pixel(of_x) == GREEN, "a pixmap reaches X with glXWaitGL");
    glScissor(0, 0, SIDE, SIDE / 4);
    glEnable(GL_SCISSOR_TEST);
    clear(RED);
    glFlush();
    XImage *image = XGetImage(display, of_x, 0, 0, 1, SIDE, AllPlanes, ZPixmap);
    check(image && (XGetPixel(image, 0, SIDE - 1) & 0xffffff) == RED, "a pixmap's lowest row is X's last");
    check(image && (XGetPixel(image, 0, 0) & 0xffffff) == GREEN, "a pixmap's highest row is X's first");
    glXMakeCurrent(display, None, NULL);
    glXDestroyGLXPixmap(display, made);
    glXDestroyContext(display, context);
    XFreePixmap(display, of_x);
}

static void separate_read(void) {
    XVisualInfo *info = visual(1);
    Window draw = window(info, 0), read = window(info, 2 * SIDE);
    GLXContext context = glXCreateContext(display, info, NULL, True);
    glXMakeCurrent(display, read, context);
    clear(RED);
    check(glXMakeContextCurrent(display, draw, read, context), "two drawables are current");
    clear(BLUE);
    check(gl_pixel() == RED, "glReadPixels reads from the read drawable");
    glRasterPos2f(-1, -1);
    glCopyPixels(0, 0, SIDE, SIDE, GL_COLOR);
    glXMakeCurrent(display, draw, context);
    check(gl_pixel() == RED, "glCopyPixels copies from the read drawable");
    glXMakeContextCurrent(display, draw, read, context);
    clear(BLUE);
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, SIDE, SIDE, 0);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glEnable(GL_TEXTURE_2D);
    fill(0xffffff);
    glXMakeCurrent(display, draw, context);
    check(gl_pixel() == RED, "glCopyTexImage2D copies from the read drawable");
    glXMakeCurrent(display, None, NULL);
    glXDestroyContext(display, context);
    XDestroyWindow(display, draw);
    XDestroyWindow(display, read);
}

static void copied_context(void) {
    XVisualInfo *info = visual(1);
    Window at = window(info, 0);
    GLXContext from = glXCreateContext(display, info, NULL, True);
    GLXContext to = glXCreateContext(display, info, NULL, True);
    glXMakeCurrent(display, at, from);
    glLineWidth(3);
    glEnable(GL_FOG);
    glXCopyContext(display, from, to, GL_LINE_BIT);
    glXMakeCurrent(display, at, to);
    check(integer(GL_LINE_WIDTH) == 3, "glXCopyContext copies the groups that are named");
    check(!glIsEnabled(GL_FOG), "glXCopyContext leaves the others");
    glXMakeCurrent(display, None, NULL);
    glXDestroyContext(display, from);
    glXDestroyContext(display, to);
    XDestroyWindow(display, at);
}

/* Contexts that share nothing draw to one window, one after the other. */
static void two_contexts(void) {
    XVisualInfo *info = visual(1);
    Window at = window(info, 0);
    GLXContext first = glXCreateContext(display, info, NULL, True);
    GLXContext second = glXCreateContext(display, info, NULL, True);
    glXMakeCurrent(display, at, first);
    clear(GREEN);
    glXMakeCurrent(display, at, second);
    check(gl_pixel() == GREEN, "a context sees what another one drew to the window");
    glXDestroyContext(display, first);
    glXSwapBuffers(display, at);
    check(shows(at, GREEN), "it shows when the other context is gone");
    glXMakeCurrent(display, None, NULL);
    glXDestroyContext(display, second);
    XDestroyWindow(display, at);
}

static void mistakes(void) {
    int base, events;
    glXQueryExtension(display, &base, &events);
    XVisualInfo *info = visual(1);
    Window at = window(info, 0);
    GLXContext context = glXCreateContext(display, info, NULL, True);
    check(!glXMakeCurrent(display, at, NULL) && last_error == BadMatch, "a window without a context is BadMatch");
    check(!glXMakeCurrent(display, None, context) && last_error == BadMatch, "a context without a window is BadMatch");
    check(glXMakeCurrent(display, at, context), "a window is current");
    glXSwapBuffers(display, at);
    glXMakeCurrent(display, None, NULL);
    XDestroyWindow(display, at);
    check(!glXMakeCurrent(display, at, context) && last_error == base + 2, "a window that is gone is GLXBadDrawable");
    glXDestroyContext(display, context);
}

static void buffers_and_lists(void) {
    XVisualInfo *info = visual(1);
    Window at = window(info, 0);
    GLXContext context = glXCreateContext(display, info, NULL, True);
    GLuint buffer;
    char byte = 0;
    glXMakeCurrent(display, at, context);
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, 16, NULL, GL_STATIC_DRAW);
    glBufferSubData(GL_ARRAY_BUFFER, 8, 16, NULL);
    check(glGetError() == GL_INVALID_VALUE, "glBufferSubData past the end, without data");
    glNewList(1, GL_COMPILE);
    glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA, 2048, 2048, 2048, 0, GL_RGBA, GL_UNSIGNED_BYTE, &byte);
    glEndList();
    glCallList(1);
    check(glGetError() != GL_NO_ERROR, "a texture that cannot be so large, in a display list");
    glXMakeCurrent(display, None, NULL);
    glXDestroyContext(display, context);
    XDestroyWindow(display, at);
}

int main(void) {
    display = XOpenDisplay(NULL);
    if (!display) {
        puts("no X server");
        return 1;
    }
    XSetErrorHandler(note_error);
    single_buffer();
    front_buffer();
    pixmap();
    separate_read();
    copied_context();
    two_contexts();
    mistakes();
    buffers_and_lists();
    XCloseDisplay(display);
    printf("%s\n", failures ? "failed" : "all is as GLX says");
    return failures;
}
