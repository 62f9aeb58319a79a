/* Makes contexts and windows, draws, and takes them down again, over and over: nothing may pile up.
 *
 *   growth contexts N    N contexts, one after the other, each with a window; every other one shares with one that stays
 *   growth displays N    N connections to the X server, each with a window and a context, closed without tidying up
 *
 * The first tenth warms up. Memory may grow by a fixed amount after that, files and threads not at all. */

#include "common.h"

#define MOST_GROWTH 16384 /* KiB */

static void one_context(Display *display, GLXContext shared, unsigned i) {
    XVisualInfo *info = visual(display, i % 4 != 0);
    struct window window = open_window(display, info, 32 + i % 64, 32);
    GLXContext context = glXCreateContext(display, info, i % 2 ? shared : NULL, True);
    if (!context || !glXMakeCurrent(display, window.id, context)) {
        printf("no context %u\n", i);
        exit(1);
    }
    GLuint textures[2] = {texture(i), texture(i + 1)}, lists = list();
    for (int frame = 0; frame < 2; frame++) {
        draw(textures[frame], lists, 10.f * frame);
        glXSwapBuffers(display, window.id);
    }
    if (i % 3) {
        /* The others leave it to the context's end, where nothing is shared. */
        glDeleteTextures(2, textures);
        glDeleteLists(lists, 1);
    } else if (i % 2) {
        glDeleteTextures(2, textures);
        glDeleteLists(lists, 1);
    }
    glXMakeCurrent(display, None, NULL);
    glXDestroyContext(display, context);
    close_window(display, window);
    XFree(info);
}

static void one_display(unsigned i) {
    Display *display = XOpenDisplay(NULL);
    if (!display) {
        printf("no display %u\n", i);
        exit(1);
    }
    XVisualInfo *info = visual(display, 1);
    struct window window = open_window(display, info, 64, 64);
    GLXContext context = glXCreateContext(display, info, NULL, True);
    glXMakeCurrent(display, window.id, context);
    draw(texture(i), list(), i);
    glXSwapBuffers(display, window.id);
    glFinish();
    glXMakeCurrent(display, None, NULL);
    glXDestroyContext(display, context);
    XFree(info);
    XCloseDisplay(display);
}

/* Waits until everything is drawn. */
static void all_drawn(Display *display, struct window window, GLXContext context) {
    glXMakeCurrent(display, window.id, context);
    glFinish();
    glXMakeCurrent(display, None, NULL);
}

int main(int count, char **arguments) {
    int is_displays = count > 1 && !strcmp(arguments[1], "displays");
    unsigned rounds = count > 2 ? (unsigned)atoi(arguments[2]) : 1000;
    Display *display = XOpenDisplay(NULL);
    if (!display) {
        puts("no X server");
        return 1;
    }
    XVisualInfo *info = visual(display, 1);
    struct window window = open_window(display, info, 32, 32);
    GLXContext shared = glXCreateContext(display, info, NULL, True);
    glXMakeCurrent(display, window.id, shared);
    glXSwapBuffers(display, window.id);
    glXMakeCurrent(display, None, NULL);

    long memory = 0, threads = 0;
    int open_files = 0;
    double begun = now();
    for (unsigned i = 0; i < rounds; i++) {
        /* A program that is far ahead of the device has more in memory, of which this is no test. */
        if (i % 50 == 0)
            all_drawn(display, window, shared);
        if (i == rounds / 10) {
            memory = status("VmRSS"), threads = status("Threads"), open_files = files();
        }
        if (is_displays)
            one_display(i);
        else
            one_context(display, shared, i);
    }
    all_drawn(display, window, shared);
    long grown = status("VmRSS") - memory, more_threads = status("Threads") - threads;
    int more_files = files() - open_files;
    printf("%u %s in %.1f s: %+ld KiB, %+ld threads, %+d files\n", rounds, is_displays ? "displays" : "contexts",
           now() - begun, grown, more_threads, more_files);
    return grown > MOST_GROWTH || more_threads > 0 || more_files > 0;
}
