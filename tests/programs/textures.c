/* Draws with textures and images, and reads them back. */
#define GL_GLEXT_PROTOTYPES
#include "window.h"
#include <string.h>

enum { SIZE = 32 };

static GLuint textures[3];

static void make_checks(void)
{
	static GLubyte texels[SIZE][SIZE + 3][3];
	for (int y = 0; y < SIZE; y++)
		for (int x = 0; x < SIZE + 3; x++) {
			GLubyte light = (x / 4 + y / 4) % 2 ? 255 : 40;
			texels[y][x][0] = light;
			texels[y][x][1] = x * 7;
			texels[y][x][2] = y * 7;
		}
	glBindTexture(GL_TEXTURE_2D, textures[0]);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
	glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
	glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
	static const GLfloat border[] = { 1, 0, 0, 0.5f };
	glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
	/* Rows that are longer than the picture, of an odd number of bytes. */
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, SIZE + 3);
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, 2);
	glPixelStorei(GL_UNPACK_SKIP_ROWS, 1);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, SIZE, SIZE / 2, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, SIZE, SIZE, 0, GL_RGB, GL_UNSIGNED_BYTE, NULL);
	glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, SIZE, SIZE / 2, GL_RGB, GL_UNSIGNED_BYTE, texels);
	glPixelStorei(GL_UNPACK_SKIP_ROWS, SIZE / 2);
	glTexSubImage2D(GL_TEXTURE_2D, 0, 0, SIZE / 2, SIZE, SIZE / 2, GL_RGB, GL_UNSIGNED_BYTE, texels);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, 0);
	glPixelStorei(GL_UNPACK_SKIP_ROWS, 0);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

static void make_others(void)
{
	static const GLushort stripes[] = { 0xf00f, 0x0f0f, 0x00ff, 0xffff };
	static const GLfloat volume[2][2][2] = { { { 0, 1 }, { 1, 0 } }, { { 1, 0 }, { 0, 1 } } };
	static const GLubyte blocks[8] = { 0xff, 0xff, 0x1f, 0x00, 0xe4, 0xe4, 0xe4, 0xe4 };
	glBindTexture(GL_TEXTURE_1D, textures[1]);
	glTexParameteri(GL_TEXTURE_1D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexImage1D(GL_TEXTURE_1D, 0, GL_RGBA, 4, 0, GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4, stripes);
	glBindTexture(GL_TEXTURE_3D, textures[2]);
	glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexImage3D(GL_TEXTURE_3D, 0, GL_LUMINANCE, 2, 2, 2, 0, GL_LUMINANCE, GL_FLOAT, volume);
	/* A target that this has not is in error, but its arguments are recorded. */
	glCompressedTexImage2D(GL_TEXTURE_3D, 0, GL_COMPRESSED_RGB_S3TC_DXT1_EXT, 4, 4, 0, sizeof blocks, blocks);
	glTexImage2D(GL_PROXY_TEXTURE_2D, 0, GL_RGBA, 64, 64, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
}

static void quad(void)
{
	glBegin(GL_QUADS);
	for (int corner = 0; corner < 4; corner++) {
		float x = corner == 1 || corner == 2, y = corner >= 2;
		glTexCoord3f(x, y, 0.25f);
		glVertex2f(1.4f * x - 0.7f, 1.4f * y - 0.7f);
	}
	glEnd();
}

static void textured(GLenum target, float x, float y)
{
	glPushMatrix();
	glTranslatef(x, y, 0);
	glEnable(target);
	quad();
	glDisable(target);
	glPopMatrix();
}

static void images(int frame)
{
	static const GLubyte letter[] = { 0xff, 0, 0x81, 0, 0xbd, 0, 0xa5, 0, 0xbd, 0, 0x81, 0, 0xff, 0 };
	static GLubyte stipple[128];
	static const GLfloat ramp[] = { 0, 0.25f, 1 };
	static GLuint gray[8][8];
	for (int i = 0; i < 64; i++)
		gray[i / 8][i % 8] = 0xff000000u | (unsigned)(i * 4 + frame) * 0x10101u;
	memset(stipple, 0xaa, sizeof stipple);
	glPolygonStipple(stipple);
	glPixelMapfv(GL_PIXEL_MAP_R_TO_R, 3, ramp);
	glPixelTransferf(GL_RED_SCALE, 0.5f);
	glRasterPos2f(-1.8f, -1.6f);
	glPixelZoom(3, 3);
	glDrawPixels(8, 8, GL_RGBA, GL_UNSIGNED_INT_8_8_8_8_REV, gray);
	glPixelZoom(1, 1);
	glPixelTransferf(GL_RED_SCALE, 1);
	glColor3f(1, 1, 0);
	glRasterPos2f(0, -1.6f);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
	glBitmap(8, 7, 0, 0, 10, 0, letter);
	glBitmap(0, 0, 0, 0, 5, 0, NULL);
	glBitmap(8, 7, 0, 0, 10, 0, letter);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

static void read_back(void)
{
	static GLubyte pixels[HEIGHT][WIDTH][4], texels[SIZE][SIZE][4], stipple[128];
	GLint size, numbers[16], names[3];
	GLfloat depth, floats[16], parameter;
	GLdouble plane[4];
	GLboolean mask[4], residence[3];
	glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
	glReadPixels(5, 5, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
	glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glGetPolygonStipple(stipple);
	glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &size);
	glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_INTERNAL_FORMAT, &size);
	glGetTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, floats);
	glGetTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, names);
	glGetTexEnviv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, names);
	glGetIntegerv(GL_VIEWPORT, numbers);
	glGetIntegerv(GL_MATRIX_MODE, numbers);
	glGetIntegerv(GL_MAX_TEXTURE_SIZE, numbers);
	glGetIntegerv(GL_BLEND_SRC, numbers);
	glGetFloatv(GL_MODELVIEW_MATRIX, floats);
	glGetFloatv(GL_DEPTH_RANGE, floats);
	glGetFloatv(GL_LINE_WIDTH, &parameter);
	glGetDoublev(GL_CURRENT_COLOR, plane);
	glGetClipPlane(GL_CLIP_PLANE0, plane);
	glGetBooleanv(GL_COLOR_WRITEMASK, mask);
	glGetLightfv(GL_LIGHT0, GL_DIFFUSE, floats);
	glGetMaterialfv(GL_FRONT, GL_SHININESS, floats);
	glGetTexGeniv(GL_S, GL_TEXTURE_GEN_MODE, names);
	glAreTexturesResident(3, textures, residence);
	glIsEnabled(GL_LIGHTING);
	glIsTexture(textures[0]);
	glGetString(GL_RENDERER);
	glGetError();
}

int main(void)
{
	open_with_configuration();
	glGenTextures(3, textures);
	make_checks();
	make_others();
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	for (int frame = 0;; frame++) {
		begin_picture();
		textured(GL_TEXTURE_2D, -1, 0.6f);
		textured(GL_TEXTURE_1D, 1, 0.6f);
		textured(GL_TEXTURE_3D, 1.1f, -0.9f);
		glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
		glEnable(GL_TEXTURE_GEN_S);
		glBindTexture(GL_TEXTURE_2D, textures[0]);
		textured(GL_TEXTURE_2D, -1, -0.9f);
		glDisable(GL_TEXTURE_GEN_S);
		images(frame);
		glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 4, 4, 0, 0, 8, 8);
		read_back();
		glXSwapBuffers(display, drawable);
	}
}
