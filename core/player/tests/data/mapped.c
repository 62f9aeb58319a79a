/* Writes buffers through glMapBuffer, whole and in part, two at a time, and draws from them. */
#include "window.h"

static void fill(unsigned char *bytes, int count, int seed) {
    for (int i = 0; i < count; i++) bytes[i] = (unsigned char)(seed + i);
}

int main(void) {
    GLuint names[2];
    unsigned char *vertices, *indices;
    open_window(64, 48);
    glGenBuffers(2, names);
    glBindBuffer(GL_ARRAY_BUFFER, names[0]);
    glBufferData(GL_ARRAY_BUFFER, 36, NULL, GL_STATIC_DRAW);
    glBindBufferARB(GL_ELEMENT_ARRAY_BUFFER_ARB, names[1]);
    glBufferDataARB(GL_ELEMENT_ARRAY_BUFFER_ARB, 3, "\2\1\0", GL_DYNAMIC_DRAW_ARB);

    /* Both at a time. */
    vertices = glMapBuffer(GL_ARRAY_BUFFER, GL_WRITE_ONLY);
    indices = glMapBufferARB(GL_ELEMENT_ARRAY_BUFFER_ARB, GL_READ_WRITE_ARB);
    fill(vertices, 36, 1);
    indices[1] = 7;
    glUnmapBuffer(GL_ARRAY_BUFFER);
    glUnmapBufferARB(GL_ELEMENT_ARRAY_BUFFER_ARB);
    glXSwapBuffers(display, window);

    /* Only read: what is there stays. */
    vertices = glMapBuffer(GL_ARRAY_BUFFER, GL_READ_ONLY);
    if (vertices[35] != 36) return 1;
    glUnmapBuffer(GL_ARRAY_BUFFER);
    glBufferSubData(GL_ARRAY_BUFFER, 8, 4, "abcd");
    glXSwapBuffers(display, window);

    /* A part of it anew. */
    vertices = glMapBuffer(GL_ARRAY_BUFFER, GL_READ_WRITE);
    fill(vertices + 16, 4, 200);
    glUnmapBuffer(GL_ARRAY_BUFFER);
    glVertexPointer(3, GL_FLOAT, 0, NULL);
    glNormalPointer(GL_BYTE, 12, (void *)4);
    glEnableClientState(GL_VERTEX_ARRAY);
    glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_BYTE, NULL);
    glXSwapBuffers(display, window);
    return 0;
}
