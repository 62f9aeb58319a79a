/* Four threads with two contexts each: some share textures, windows are resized and destroyed while they are drawn to,
 * contexts move between threads, single buffers are flushed, pixels are read.
 *
 *   storm SECONDS
 *
 * It is well if it ends: the run script looks for what validation layers say. */

#include "common.h"
#include <pthread.h>

#define THREADS 4
#define CONTEXTS 2

static double end;
static GLXContext shared;
static GLuint shared_textures[4];
/* A context that goes from thread to thread. */
static pthread_mutex_t wanderer_lock = PTHREAD_MUTEX_INITIALIZER;
static GLXContext wanderer;
static unsigned long frames;

static int ignore_error(Display *display, XErrorEvent *event) {
    (void)display, (void)event;
    return 0;
}

/* Draws frames until it is time for something else. */
static void some_frames(Display *display, struct window window, int is_double, unsigned *seed, GLuint lists) {
    for (int i = rand_r(seed) % 20; i >= 0; i--) {
        draw(shared_textures[rand_r(seed) % 4], lists, (float)i);
        switch (rand_r(seed) % 8) {
        case 0: {
            unsigned char pixels[16 * 16 * 4];
            glReadPixels(0, 0, 16, 16, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
            break;
        }
        case 1:
            XResizeWindow(display, window.id, 16 + rand_r(seed) % 200, 16 + rand_r(seed) % 200);
            XFlush(display);
            break;
        case 2:
            glBindTexture(GL_TEXTURE_2D, shared_textures[rand_r(seed) % 4]);
            glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, 16, 16);
            break;
        case 3:
            glFlush();
            break;
        }
        if (is_double)
            glXSwapBuffers(display, window.id);
        else
            glFinish();
        __atomic_add_fetch(&frames, 1, __ATOMIC_RELAXED);
    }
}

static void *thread(void *number) {
    unsigned seed = (unsigned)(size_t)number + 1;
    Display *display = XOpenDisplay(NULL);
    if (!display)
        return NULL;
    while (now() < end) {
        struct window windows[CONTEXTS];
        GLXContext contexts[CONTEXTS];
        GLuint lists[CONTEXTS];
        int is_double[CONTEXTS];
        for (int i = 0; i < CONTEXTS; i++) {
            is_double[i] = rand_r(&seed) % 3 != 0;
            XVisualInfo *info = visual(display, is_double[i]);
            windows[i] = open_window(display, info, 64, 64);
            contexts[i] = glXCreateContext(display, info, shared, True);
            glXMakeCurrent(display, windows[i].id, contexts[i]);
            lists[i] = list();
            XFree(info);
        }
        for (int i = 0; i < 8 && now() < end; i++) {
            int which = rand_r(&seed) % CONTEXTS;
            glXMakeCurrent(display, windows[which].id, contexts[which]);
            some_frames(display, windows[which], is_double[which], &seed, lists[which]);
            if (rand_r(&seed) % 4 == 0) {
                pthread_mutex_lock(&wanderer_lock);
                glXMakeCurrent(display, windows[which].id, wanderer);
                some_frames(display, windows[which], is_double[which], &seed, lists[which]);
                glXMakeCurrent(display, None, NULL);
                pthread_mutex_unlock(&wanderer_lock);
            }
        }
        for (int i = 0; i < CONTEXTS; i++) {
            glXMakeCurrent(display, windows[i].id, contexts[i]);
            draw(shared_textures[0], lists[i], 0);
            glDeleteLists(lists[i], 1);
            /* In any order, and what is current still. */
            if (rand_r(&seed) % 2)
                close_window(display, windows[i]);
            else
                glXDestroyContext(display, contexts[i]), contexts[i] = NULL;
            if (is_double[i])
                glXSwapBuffers(display, windows[i].id);
            glXMakeCurrent(display, None, NULL);
            if (contexts[i])
                glXDestroyContext(display, contexts[i]);
            else
                close_window(display, windows[i]);
        }
    }
    XCloseDisplay(display);
    return NULL;
}

int main(int count, char **arguments) {
    XInitThreads();
    XSetErrorHandler(ignore_error);
    end = now() + (count > 1 ? atof(arguments[1]) : 10);
    Display *display = XOpenDisplay(NULL);
    if (!display) {
        puts("no X server");
        return 1;
    }
    XVisualInfo *info = visual(display, 1);
    struct window window = open_window(display, info, 64, 64);
    shared = glXCreateContext(display, info, NULL, True);
    wanderer = glXCreateContext(display, info, shared, True);
    glXMakeCurrent(display, window.id, shared);
    for (unsigned i = 0; i < 4; i++)
        shared_textures[i] = texture(i);
    glFinish();
    glXMakeCurrent(display, None, NULL);
    pthread_t threads[THREADS];
    for (size_t i = 0; i < THREADS; i++)
        pthread_create(&threads[i], NULL, thread, (void *)i);
    for (size_t i = 0; i < THREADS; i++)
        pthread_join(threads[i], NULL);
    printf("%lu frames, %ld KiB\n", frames, status("VmRSS"));
    return frames == 0;
}
