/* Draws from arrays in its own memory, in all the ways that OpenGL 1.5 has. */
#define GL_GLEXT_PROTOTYPES
#include "window.h"

enum { LAST = 2 };

struct vertex {
	GLubyte color[4];
	GLfloat position[3];
};

static const struct vertex fan[] = {
	{ { 255, 255, 255, 255 }, { 0, 0, 0 } },   { { 255, 0, 0, 255 }, { 0.8f, 0, 0 } },
	{ { 0, 255, 0, 255 }, { 0, 0.8f, 0 } },	   { { 0, 0, 255, 255 }, { -0.8f, 0, 0 } },
	{ { 255, 255, 0, 255 }, { 0, -0.8f, 0 } }, { { 255, 0, 0, 255 }, { 0.8f, 0, 0 } },
};
static const GLushort shorts[] = { 0, 1, 2, 0, 3, 4 };
static const GLubyte bytes[] = { 0, 2, 3 };
static const GLuint ints[] = { 0, 4, 5 };

static void separate_arrays(void)
{
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	glColorPointer(4, GL_UNSIGNED_BYTE, sizeof fan[0], fan[0].color);
	glVertexPointer(3, GL_FLOAT, sizeof fan[0], fan[0].position);
	glDrawArrays(GL_TRIANGLE_FAN, 0, 6);
	glTranslatef(1.2f, 0, 0);
	glDrawArrays(GL_TRIANGLES, 2, 3);
	glTranslatef(-2.4f, 0, 0);
	glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, shorts);
	glTranslatef(0, 1.2f, 0);
	glDrawRangeElements(GL_TRIANGLES, 0, 3, 3, GL_UNSIGNED_BYTE, bytes);
	glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, ints);
	glDisableClientState(GL_COLOR_ARRAY);
}

static void several_draws(void)
{
	static const GLint firsts[] = { 0, 3 };
	static const GLsizei counts[] = { 3, 3 };
	const GLvoid *lists[] = { shorts, shorts + 3 };
	glColor3f(1, 0.5f, 0);
	glTranslatef(1.2f, 0, 0);
	glMultiDrawArrays(GL_TRIANGLES, firsts, counts, 2);
	glTranslatef(1.2f, 0, 0);
	glMultiDrawElements(GL_TRIANGLES, counts, GL_UNSIGNED_SHORT, lists, 2);
}

/* apitrace 11.1 does not notice that arrays are unlocked: nothing that comes later is recorded as it is. */
static void locked_arrays(void)
{
	void (*lock)(GLint, GLsizei) = extension("glLockArraysEXT");
	void (*unlock)(void) = extension("glUnlockArraysEXT");
	glColorPointer(4, GL_UNSIGNED_BYTE, sizeof fan[0], fan[0].color);
	glVertexPointer(3, GL_FLOAT, sizeof fan[0], fan[0].position);
	glEnableClientState(GL_COLOR_ARRAY);
	glTranslatef(0, 1.2f, 0);
	lock(0, 6);
	glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, shorts);
	glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, shorts + 3);
	unlock();
}

static void interleaved_arrays(void)
{
	static const GLfloat triangle[] = {
		0, 1, 0, -0.5f, -0.5f, 0, 0, 0, 1, 0.5f, -0.5f, 0, 1, 0, 0, 0, 0.5f, 0,
	};
	glTranslatef(-1.2f, -2.4f, 0);
	glInterleavedArrays(GL_C3F_V3F, 0, triangle);
	glDrawArrays(GL_TRIANGLES, 0, 3);
	glDisableClientState(GL_COLOR_ARRAY);
}

/* Normals, edge flags, fog and secondary colours; two units' texture coordinates; a buffer bound for nothing. */
static void all_arrays(int frame)
{
	static const GLfloat positions[] = { -1.2f, -0.4f, -0.4f, -0.4f, -0.4f, 0.4f, -1.2f, 0.4f };
	static const GLbyte normals[] = { 0, 0, 127, 0, 90, 90, 0, 0, 90, 0, 90, 0, 0, 0, 127, 0 };
	static const GLdouble fog[] = { 0, 0.25, 0.5, 0.75 };
	static const GLfloat second[] = { 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0 };
	static const GLshort coordinates[] = { 0, 0, 1, 0, 1, 1, 0, 1 };
	GLboolean edges[] = { GL_TRUE, GL_FALSE, GL_TRUE, GL_TRUE };
	GLuint buffer;

	edges[1] = frame % 2;
	glVertexPointer(2, GL_FLOAT, 0, positions);
	glNormalPointer(GL_BYTE, 4, normals);
	glEdgeFlagPointer(0, edges);
	glFogCoordPointer(GL_DOUBLE, 0, fog);
	glSecondaryColorPointer(3, GL_FLOAT, 0, second);
	glTexCoordPointer(2, GL_SHORT, 0, coordinates);
	glClientActiveTexture(GL_TEXTURE1);
	glTexCoordPointer(2, GL_FLOAT, 0, positions);
	glEnableClientState(GL_TEXTURE_COORD_ARRAY);
	glClientActiveTexture(GL_TEXTURE0);
	glEnableClientState(GL_TEXTURE_COORD_ARRAY);
	static const GLenum arrays[] = { GL_NORMAL_ARRAY, GL_EDGE_FLAG_ARRAY, GL_FOG_COORDINATE_ARRAY,
					 GL_SECONDARY_COLOR_ARRAY };
	for (int i = 0; i < 4; i++)
		glEnableClientState(arrays[i]);
	glGenBuffers(1, &buffer);
	glBindBuffer(GL_ARRAY_BUFFER, buffer);
	glEnable(GL_COLOR_SUM);
	glDrawArrays(GL_QUADS, 0, 4);
	glDisable(GL_COLOR_SUM);
	glDeleteBuffers(1, &buffer);
	for (int i = 0; i < 4; i++)
		glDisableClientState(arrays[i]);
	glDisableClientState(GL_TEXTURE_COORD_ARRAY);
	glClientActiveTexture(GL_TEXTURE1);
	glDisableClientState(GL_TEXTURE_COORD_ARRAY);
	glClientActiveTexture(GL_TEXTURE0);
}

int main(void)
{
	open_with_visual();
	for (int frame = 0;; frame++) {
		begin_picture();
		glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
		glRotatef(5.0f * frame, 0, 0, 1);
		separate_arrays();
		several_draws();
		interleaved_arrays();
		all_arrays(frame);
		if (frame == LAST)
			locked_arrays();
		glPopClientAttrib();
		glXSwapBuffers(display, drawable);
	}
}
