/* A window with an OpenGL context, for the programs whose traces are kept here. */
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static Display *display;
static XVisualInfo *visual;
static Window window;

static Window make_window(int width, int height) {
    XSetWindowAttributes attributes = {0};
    Window root = DefaultRootWindow(display), made;
    attributes.colormap = XCreateColormap(display, root, visual->visual, AllocNone);
    made = XCreateWindow(display, root, 0, 0, width, height, 0, visual->depth, InputOutput,
                         visual->visual, CWColormap | CWBorderPixel, &attributes);
    XMapWindow(display, made);
    return made;
}

static void open_display(void) {
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 16, None};
    display = XOpenDisplay(NULL);
    if (!display || !(visual = glXChooseVisual(display, DefaultScreen(display), wanted))) {
        fprintf(stderr, "no display with OpenGL\n");
        exit(1);
    }
}

static GLXContext open_window(int width, int height) {
    GLXContext context;
    open_display();
    window = make_window(width, height);
    context = glXCreateContext(display, visual, NULL, True);
    glXMakeCurrent(display, window, context);
    return context;
}
