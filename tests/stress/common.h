/* What the stress programs have in common. */

#define GL_GLEXT_PROTOTYPES
#define GLX_GLXEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static inline double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec + time.tv_nsec * 1e-9;
}

/* A line of /proc/self/status, as a number: VmRSS (KiB), Threads. */
static inline long status(const char *name) {
    char line[256];
    long value = 0;
    FILE *file = fopen("/proc/self/status", "r");
    while (file && fgets(line, sizeof line, file))
        if (!strncmp(line, name, strlen(name)) && line[strlen(name)] == ':')
            value = atol(line + strlen(name) + 1);
    if (file)
        fclose(file);
    return value;
}

/* Open files: each connection to the X server is one. */
static inline int files(void) {
    char path[64];
    int count = 0;
    for (int i = 0; i < 1024; i++) {
        snprintf(path, sizeof path, "/proc/self/fd/%d", i);
        char target[256];
        count += readlink(path, target, sizeof target) >= 0;
    }
    return count;
}

static inline XVisualInfo *visual(Display *display, int is_double) {
    int single_list[] = {GLX_RGBA, GLX_RED_SIZE, 8, GLX_DEPTH_SIZE, 16, None};
    int double_list[] = {GLX_RGBA, GLX_RED_SIZE, 8, GLX_DEPTH_SIZE, 16, GLX_DOUBLEBUFFER, None};
    return glXChooseVisual(display, DefaultScreen(display), is_double ? double_list : single_list);
}

/* A mapped window with a colour map of its own, which goes with it (`close_window`). */
struct window {
    Window id;
    Colormap colors;
};

static inline struct window open_window(Display *display, XVisualInfo *info, int width, int height) {
    Window root = DefaultRootWindow(display);
    XSetWindowAttributes attributes = {0};
    struct window made;
    made.colors = attributes.colormap = XCreateColormap(display, root, info->visual, AllocNone);
    attributes.override_redirect = True;
    made.id = XCreateWindow(display, root, 0, 0, width, height, 0, info->depth, InputOutput, info->visual,
                            CWColormap | CWOverrideRedirect, &attributes);
    XMapWindow(display, made.id);
    XSync(display, False);
    return made;
}

static inline void close_window(Display *display, struct window window) {
    XDestroyWindow(display, window.id);
    XFreeColormap(display, window.colors);
    XSync(display, False);
}

static inline GLuint texture(unsigned seed) {
    unsigned char texels[16 * 16 * 4];
    GLuint name;
    for (unsigned i = 0; i < sizeof texels; i++)
        texels[i] = (unsigned char)(seed * 31 + i * 7);
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 16, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    return name;
}

static inline GLuint list(void) {
    GLuint name = glGenLists(1);
    glNewList(name, GL_COMPILE);
    glBegin(GL_QUADS);
    for (int i = 0; i < 8; i++) {
        float left = -0.9f + 0.2f * i;
        glTexCoord2f(0, 0), glVertex3f(left, -0.5f, 0);
        glTexCoord2f(1, 0), glVertex3f(left + 0.15f, -0.5f, 0);
        glTexCoord2f(1, 1), glVertex3f(left + 0.15f, 0.5f, 0.5f);
        glTexCoord2f(0, 1), glVertex3f(left, 0.5f, 0.5f);
    }
    glEnd();
    glEndList();
    return name;
}

static inline void draw(GLuint with_texture, GLuint with_list, float angle) {
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, with_texture);
    glLoadIdentity();
    glRotatef(angle, 0, 0, 1);
    glCallList(with_list);
}
