/* Draws with display lists: of lists, by names of several types, with lights and state in them. */
#include "window.h"

static GLuint first;

static void make_lists(void)
{
	static const GLfloat red[] = { 0.9f, 0.1f, 0.1f, 1 }, blue[] = { 0.1f, 0.1f, 0.9f, 1 };
	static const GLfloat triangle[] = { 0, 0, 0, 0.6f, 0, 0, 0.3f, 0.6f, 0 };
	static const GLdouble plane[] = { 0, 1, 0, 0.5 };
	static const GLubyte picture[] = { 255, 128, 0, 0, 128, 255, 0, 0, 255, 255, 255, 0, 0, 0, 0, 0 };
	first = glGenLists(5);
	glNewList(first, GL_COMPILE);
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, red);
	glNormal3f(0, 0, 1);
	glRectf(-0.5f, -0.5f, 0.5f, 0.5f);
	glEndList();
	glNewList(first + 1, GL_COMPILE_AND_EXECUTE);
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, blue);
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(3, GL_FLOAT, 0, triangle);
	glDrawArrays(GL_TRIANGLES, 0, 3);
	glDisableClientState(GL_VERTEX_ARRAY);
	glEndList();
	glNewList(first + 2, GL_COMPILE);
	glTranslatef(0.7f, 0.2f, 0);
	glCallList(first + 1);
	glEndList();
	glNewList(first + 3, GL_COMPILE);
	glClipPlane(GL_CLIP_PLANE0, plane);
	glEnable(GL_CLIP_PLANE0);
	glPushAttrib(GL_ENABLE_BIT | GL_CURRENT_BIT);
	glDisable(GL_LIGHTING);
	glColor4ub(255, 200, 0, 255);
	glRasterPos3f(-1.5f, -1, 0);
	glDrawPixels(2, 2, GL_RGB, GL_UNSIGNED_BYTE, picture);
	glPopAttrib();
	glDisable(GL_CLIP_PLANE0);
	glEndList();
	glNewList(first + 4, GL_COMPILE);
	glEndList();
	glDeleteLists(first + 4, 1);
}

static void names_of_all_types(void)
{
	static const GLubyte bytes[] = { 0, 2 }, pairs[] = { 0, 2, 0, 3 };
	static const GLint ints[] = { 2, 0 };
	static const GLfloat floats[] = { 2 };
	glListBase(first);
	glCallLists(2, GL_UNSIGNED_BYTE, bytes);
	glTranslatef(-2, 0.2f, 0);
	glCallLists(2, GL_INT, ints);
	glCallLists(1, GL_FLOAT, floats);
	glCallLists(2, GL_2_BYTES, pairs);
	glListBase(0);
}

int main(void)
{
	static const GLfloat position[] = { 0.3f, 0.5f, 1, 0 };
	open_with_visual();
	make_lists();
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	for (int frame = 0;; frame++) {
		begin_picture();
		glLightfv(GL_LIGHT0, GL_POSITION, position);
		glRotatef(10.0f * frame, 0, 1, 0);
		glCallList(first);
		names_of_all_types();
		/* A list that is made anew in each frame. */
		glDeleteLists(first + 4, 1);
		glNewList(first + 4, GL_COMPILE);
		glBegin(GL_TRIANGLES);
		for (int i = 0; i < 3; i++)
			glVertex3f(i - 1.0f, i == 1, 0.1f * frame);
		glEnd();
		glEndList();
		glCallList(first + 4);
		glXSwapBuffers(display, drawable);
	}
}
