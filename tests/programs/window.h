/* A window with an OpenGL context, made the old way or with a configuration. */
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/glx.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 320, HEIGHT = 240 };

static Display *display;
static GLXDrawable drawable;

static void require(int holds, const char *what)
{
	if (holds)
		return;
	fprintf(stderr, "no %s\n", what);
	exit(1);
}

static Window new_window(const XVisualInfo *visual)
{
	Window root = RootWindow(display, visual->screen);
	XSetWindowAttributes attributes = {
		.colormap = XCreateColormap(display, root, visual->visual, AllocNone),
		.event_mask = StructureNotifyMask,
	};
	Window window = XCreateWindow(display, root, 0, 0, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual,
				      CWColormap | CWEventMask, &attributes);
	XEvent event;
	XMapWindow(display, window);
	do
		XNextEvent(display, &event);
	while (event.type != MapNotify);
	return window;
}

/* glXChooseVisual, glXCreateContext, glXMakeCurrent. */
static inline void open_with_visual(void)
{
	int wanted[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_DEPTH_SIZE, 16, None };
	display = XOpenDisplay(NULL);
	require(display != NULL, "display");
	XVisualInfo *visual = glXChooseVisual(display, DefaultScreen(display), wanted);
	require(visual != NULL, "visual");
	int depth;
	require(glXGetConfig(display, visual, GLX_DEPTH_SIZE, &depth) == 0 && depth >= 16, "depth buffer");
	GLXContext context = glXCreateContext(display, visual, NULL, True);
	drawable = new_window(visual);
	require(glXMakeCurrent(display, drawable, context), "context");
	XFree(visual);
}

/* The functions of GLX 1.3. */
static inline void open_with_configuration(void)
{
	static const int wanted[] = { GLX_RENDER_TYPE, GLX_RGBA_BIT, GLX_DRAWABLE_TYPE, GLX_WINDOW_BIT,
				      GLX_DOUBLEBUFFER, True, GLX_X_VISUAL_TYPE, GLX_TRUE_COLOR,
				      GLX_DEPTH_SIZE, 16, None };
	display = XOpenDisplay(NULL);
	require(display != NULL, "display");
	int screen = DefaultScreen(display), major, minor, count, value;
	unsigned width;
	require(glXQueryExtension(display, NULL, NULL), "GLX");
	require(glXQueryVersion(display, &major, &minor) && minor >= 3, "GLX 1.3");
	glXQueryExtensionsString(display, screen);
	glXQueryServerString(display, screen, GLX_VENDOR);
	glXGetClientString(display, GLX_VERSION);
	XFree(glXGetFBConfigs(display, screen, &count));
	GLXFBConfig *found = glXChooseFBConfig(display, screen, wanted, &count);
	require(found != NULL, "configuration");
	glXGetFBConfigAttrib(display, found[0], GLX_FBCONFIG_ID, &value);
	require(glXGetFBConfigAttrib(display, found[0], 0x7777, &value) == GLX_BAD_ATTRIBUTE, "error");
	XVisualInfo *visual = glXGetVisualFromFBConfig(display, found[0]);
	require(visual != NULL, "visual");
	GLXContext context = glXCreateNewContext(display, found[0], GLX_RGBA_TYPE, NULL, True);
	drawable = glXCreateWindow(display, found[0], new_window(visual), NULL);
	require(glXMakeContextCurrent(display, drawable, drawable, context), "context");
	glXQueryContext(display, context, GLX_RENDER_TYPE, &value);
	glXQueryDrawable(display, drawable, GLX_WIDTH, &width);
	require(width == WIDTH && glXIsDirect(display, context), "window");
	require(glXGetCurrentContext() == context && glXGetCurrentDrawable() == drawable, "current context");
	require(glXGetCurrentReadDrawable() == drawable && glXGetCurrentDisplay() == display, "current display");
	XFree(visual);
	XFree(found);
}

/* An entry point of an extension. */
static inline void *extension(const char *name)
{
	void *address = (void *)glXGetProcAddressARB((const GLubyte *)name);
	require(address != NULL, name);
	return address;
}

/* What most pictures begin with. */
static inline void begin_picture(void)
{
	glClearColor(0.1f, 0.2f, 0.3f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-1, 1, -0.75, 0.75, 1, 20);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glTranslatef(0, 0, -3);
}
