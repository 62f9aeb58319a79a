/* Two contexts that share names and one that does not, on two windows and two threads. */
#include "window.h"
#include <pthread.h>

static GLXContext second;
static Window small;

static void *draw(void *unused) {
    (void)unused;
    glXMakeCurrent(display, small, second);
    glCallList(7);
    glBegin(GL_POINTS);
    glVertex2f(1, 2);
    glEnd();
    glXSwapBuffers(display, small);
    glXMakeCurrent(display, None, NULL);
    return NULL;
}

int main(void) {
    GLXContext first, alone;
    pthread_t thread;
    XInitThreads();
    first = open_window(64, 48);
    small = make_window(32, 16);
    second = glXCreateContext(display, visual, first, True);
    alone = glXCreateContext(display, visual, NULL, True);
    glNewList(7, GL_COMPILE);
    glColor3f(0, 1, 0);
    glEndList();
    pthread_create(&thread, NULL, draw, NULL);
    pthread_join(thread, NULL);
    glXSwapBuffers(display, window);

    glXMakeCurrent(display, window, alone);
    glCallList(7);
    glXSwapBuffers(display, window);
    glXDestroyContext(display, first);
    glXMakeCurrent(display, None, NULL);
    /* Nothing is current. */
    glEnable(GL_BLEND);
    glXDestroyContext(display, alone);
    glXDestroyContext(display, second);
    return 0;
}
