/*
 * Preloaded into a program: ends it at its SNAPSHOT_FRAMES-th buffer swap, and writes what it has drawn by then to
 * SNAPSHOT_FILE, a PNG without compression.
 */
#define _GNU_SOURCE
#include <GL/gl.h>
#include <GL/glx.h>
#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *next(const char *name)
{
	void *function = dlsym(RTLD_NEXT, name);
	if (function == NULL) {
		fprintf(stderr, "snapshot: no %s\n", name);
		exit(1);
	}
	return function;
}

static uint32_t crc(const unsigned char *bytes, size_t count)
{
	uint32_t crc = ~0u;
	while (count-- > 0) {
		crc ^= *bytes++;
		for (int bit = 0; bit < 8; bit++)
			crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
	}
	return ~crc;
}

static unsigned char *put(unsigned char *to, uint32_t value)
{
	for (int shift = 24; shift >= 0; shift -= 8)
		*to++ = value >> shift;
	return to;
}

/* Writes a chunk, whose data lies behind eight free bytes. */
static void chunk(FILE *file, const char *name, unsigned char *data, size_t count)
{
	put(data - 8, count);
	memcpy(data - 4, name, 4);
	fwrite(data - 8, 1, count + 8, file);
	unsigned char sum[4];
	put(sum, crc(data - 4, count + 4));
	fwrite(sum, 1, 4, file);
}

static void write_png(FILE *file, const unsigned char *rgb, uint32_t width, uint32_t height)
{
	/* Of each row: the header of a stored block, the filter (none), the colours; the last row comes first. */
	size_t row = 3 * (size_t)width + 1;
	unsigned char *data = malloc(8 + 2 + height * (5 + row) + 4), *to = data + 8;
	if (data == NULL)
		return;
	fwrite("\x89PNG\r\n\x1a\n", 1, 8, file);
	put(put(to, width), height);
	memcpy(to + 8, (const unsigned char[]){ 8, 2, 0, 0, 0 }, 5);
	chunk(file, "IHDR", to, 13);

	uint32_t a = 1, b = 0;
	*to++ = 0x78;
	*to++ = 0x01;
	for (uint32_t y = height; y-- > 0;) {
		memcpy(to, (const unsigned char[]){ y == 0, row, row >> 8, ~row, ~row >> 8, 0 }, 6);
		memcpy(to + 6, rgb + 3 * (size_t)width * y, row - 1);
		to += 5;
		for (size_t i = 0; i < row; i++) {
			a = (a + to[i]) % 65521;
			b = (b + a) % 65521;
		}
		to += row;
	}
	to = put(to, b << 16 | a);
	chunk(file, "IDAT", data + 8, to - data - 8);
	chunk(file, "IEND", data + 8, 0);
	free(data);
}

static void snapshot(Display *display, GLXDrawable drawable, const char *path)
{
	void (*query)(Display *, GLXDrawable, int, unsigned *) = next("glXQueryDrawable");
	void (*pixel_store)(GLenum, GLint) = next("glPixelStorei");
	void (*read)(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, GLvoid *) = next("glReadPixels");
	unsigned width, height;
	query(display, drawable, GLX_WIDTH, &width);
	query(display, drawable, GLX_HEIGHT, &height);
	unsigned char *rgb = malloc(3 * (size_t)width * height);
	FILE *file = fopen(path, "wb");
	if (rgb != NULL && file != NULL) {
		pixel_store(GL_PACK_ALIGNMENT, 1);
		read(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rgb);
		write_png(file, rgb, width, height);
	}
	if (file != NULL)
		fclose(file);
	free(rgb);
}

void glXSwapBuffers(Display *display, GLXDrawable drawable)
{
	static int frames;
	const char *wanted = getenv("SNAPSHOT_FRAMES"), *path = getenv("SNAPSHOT_FILE");
	int last = wanted != NULL && ++frames == atoi(wanted);
	if (last && path != NULL)
		snapshot(display, drawable, path);
	((void (*)(Display *, GLXDrawable))next("glXSwapBuffers"))(display, drawable);
	if (last)
		exit(0);
}
