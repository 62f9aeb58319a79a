/* Draws from buffer objects that are filled, replaced in part, and mapped to be written and read. */
#define GL_GLEXT_PROTOTYPES
#include "window.h"
#include <string.h>

struct vertex {
	GLfloat color[3], position[2];
};

static const struct vertex square[] = {
	{ { 1, 0, 0 }, { -0.5f, -0.5f } },
	{ { 0, 1, 0 }, { 0.5f, -0.5f } },
	{ { 0, 0, 1 }, { 0.5f, 0.5f } },
	{ { 1, 1, 1 }, { -0.5f, 0.5f } },
};
static const GLushort triangles[] = { 0, 1, 2, 0, 2, 3 };

static GLuint buffers[2], query;

static const GLvoid *offset(size_t bytes)
{
	return (const GLvoid *)bytes;
}

static void use_arrays(void)
{
	glEnableClientState(GL_COLOR_ARRAY);
	glEnableClientState(GL_VERTEX_ARRAY);
	glColorPointer(3, GL_FLOAT, sizeof square[0], offset(0));
	glVertexPointer(2, GL_FLOAT, sizeof square[0], offset(3 * sizeof(GLfloat)));
}

/* The third corner moves: by a part that is replaced, and by mapped memory that is read first. */
static void move(int frame)
{
	struct vertex changed = square[2], seen;
	changed.position[0] += 0.1f * frame;
	glBufferSubData(GL_ARRAY_BUFFER, 2 * sizeof changed, sizeof changed, &changed);
	struct vertex *mapped = glMapBuffer(GL_ARRAY_BUFFER, GL_READ_WRITE);
	require(mapped != NULL && memcmp(&mapped[2], &changed, sizeof changed) == 0, "mapped memory");
	mapped[3].position[1] = 0.5f + 0.1f * frame;
	require(glUnmapBuffer(GL_ARRAY_BUFFER), "content");
	glGetBufferSubData(GL_ARRAY_BUFFER, 3 * sizeof seen, sizeof seen, &seen);
	require(seen.position[1] == 0.5f + 0.1f * frame, "change");
}

static void map_indices(void)
{
	GLint value;
	GLvoid *address;
	GLushort *mapped = glMapBuffer(GL_ELEMENT_ARRAY_BUFFER, GL_WRITE_ONLY);
	require(mapped != NULL, "mapped indices");
	memcpy(mapped, triangles, sizeof triangles);
	glGetBufferParameteriv(GL_ELEMENT_ARRAY_BUFFER, GL_BUFFER_SIZE, &value);
	glGetBufferParameteriv(GL_ELEMENT_ARRAY_BUFFER, GL_BUFFER_ACCESS, &value);
	glGetBufferPointerv(GL_ELEMENT_ARRAY_BUFFER, GL_BUFFER_MAP_POINTER, &address);
	require(address == mapped && glUnmapBuffer(GL_ELEMENT_ARRAY_BUFFER), "indices");
	/* What is only read is not recorded. */
	require(glMapBuffer(GL_ELEMENT_ARRAY_BUFFER, GL_READ_ONLY) != NULL, "read-only memory");
	glUnmapBuffer(GL_ELEMENT_ARRAY_BUFFER);
}

int main(void)
{
	open_with_configuration();
	glGenBuffers(2, buffers);
	glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
	glBufferData(GL_ARRAY_BUFFER, sizeof square, square, GL_DYNAMIC_DRAW);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof triangles, NULL, GL_STATIC_DRAW);
	glGenQueries(1, &query);
	map_indices();
	for (int frame = 0;; frame++) {
		GLuint samples;
		begin_picture();
		move(frame);
		use_arrays();
		glBeginQuery(GL_SAMPLES_PASSED, query);
		glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, offset(0));
		glEndQuery(GL_SAMPLES_PASSED);
		glTranslatef(1.2f, 0, 0);
		glDrawArrays(GL_TRIANGLES, 1, 3);
		/* One array in the program's memory beside one in a buffer. */
		static const GLubyte colors[] = { 255, 255, 0, 0, 255, 255, 255, 0, 255, 255, 255, 255 };
		glBindBuffer(GL_ARRAY_BUFFER, 0);
		glColorPointer(3, GL_UNSIGNED_BYTE, 0, colors);
		glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
		glTranslatef(-2.4f, 0, 0);
		glDrawArrays(GL_QUADS, 0, 4);
		glGetQueryObjectuiv(query, GL_QUERY_RESULT, &samples);
		require(samples > 0, "samples");
		glXSwapBuffers(display, drawable);
	}
}
