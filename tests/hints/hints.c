/*
 * Says all that GL_AFTERGLOW_scene_hints can say, of a small room, for FRAMES frames (default 4); on a libGL without
 * the extension it draws the same room. What is wrong is written a line each; the exit status is their number.
 */
#include "afterglow.h"
#include "../programs/window.h"
#include <string.h>

enum { FLOOR = 101, CRATE, FLAG, WEAPON };
static const uint64_t LAMP = 0x123456789abcdef;
enum { BULB = 7, TORCH, SUN };

static AfterglowSceneHints scene;
static int failures;

static void check(int holds, const char *what)
{
	if (holds)
		return;
	printf("FAIL: %s\n", what);
	failures++;
}

/* A call that must end in an error; without the extension, in none. */
#define FAILS(ERROR, CALL)                                                       \
	do {                                                                     \
		CALL;                                                            \
		check(glGetError() == (scene.isPresent ? (ERROR) : GL_NO_ERROR), #CALL); \
	} while (0)

/* A square in the plane of two axes. */
static void square(float half, int along, int across)
{
	static const float corners[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		float position[3] = { 0, 0, 0 };
		position[along] = half * corners[i][0];
		position[across] = half * corners[i][1];
		glTexCoord2fv(corners[i]);
		glVertex3fv(position);
	}
	glEnd();
}

static unsigned texture(unsigned char red, unsigned char green, unsigned char blue)
{
	const unsigned char texel[4] = { red, green, blue, 255 };
	unsigned name;
	glGenTextures(1, &name);
	glBindTexture(GL_TEXTURE_2D, name);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
	glBindTexture(GL_TEXTURE_2D, 0);
	return name;
}

static void check_errors(void)
{
	const float null[3] = { 0, 0, 0 }, one[3] = { 1, 1, 1 }, dark[3] = { -1, 0, 0 };
	FAILS(GL_INVALID_ENUM, scene.Class(GL_FOG));
	FAILS(GL_INVALID_ENUM, scene.Map(GL_TEXTURE_2D, 1));
	FAILS(GL_INVALID_VALUE, scene.Material(2, 0));
	FAILS(GL_INVALID_VALUE, scene.Emission(-1, 0, 0));
	FAILS(GL_INVALID_VALUE, scene.Sky(-1, 0, 0));
	FAILS(GL_INVALID_VALUE, scene.PointLight(1, one, dark, 0));
	FAILS(GL_INVALID_VALUE, scene.SpotLight(1, one, one, one, 0, 91, 0));
	FAILS(GL_INVALID_VALUE, scene.DirectionalLight(1, null, one, 0));
	glBegin(GL_POINTS);
	scene.Object(1);
	scene.Cut();
	glEnd();
	check(glGetError() == (scene.isPresent ? GL_INVALID_OPERATION : GL_NO_ERROR), "call between Begin and End");
	if (scene.isPresent) {
		int most = 0;
		glGetIntegerv(GL_MAX_SCENE_LIGHTS_AFTERGLOW, &most);
		check(most >= 32, "GL_MAX_SCENE_LIGHTS_AFTERGLOW");
	}
	check(afterglowHasWord("GL_A GL_AFTERGLOW_scene_hints", "GL_AFTERGLOW_scene_hints"), "last word");
	check(!afterglowHasWord("GL_AFTERGLOW_scene_hints2 X", "GL_AFTERGLOW_scene_hints"), "longer word");
	check(!afterglowHasWord(NULL, "GL_AFTERGLOW_scene_hints"), "no words");
}

/* The world: lists hold what is said of draws. */
static unsigned floor_list(void)
{
	unsigned list = glGenLists(1);
	glNewList(list, GL_COMPILE);
	scene.Object(FLOOR);
	scene.Class(GL_SCENE_STATIC_AFTERGLOW);
	scene.Material(0.4f, 0);
	glColor3f(0.6f, 0.6f, 0.6f);
	square(5, 0, 2);
	scene.Defaults();
	glEndList();
	return list;
}

static void light_frame(int frame)
{
	const float at[3] = { 1, 3, 0 }, there[3] = { -3, 3, 1 }, down[3] = { 0, -1, 0 }, aslant[3] = { 1, -2, -1 };
	const float bright[3] = { 40, 36, 30 }, red[3] = { 30, 4, 4 }, pale[3] = { 0.4f, 0.4f, 0.5f };
	scene.View();
	scene.PointLight(BULB, at, bright, 0.1f);
	scene.SpotLight(TORCH, there, down, red, 0.1f, 40, 2);
	scene.DirectionalLight(SUN, aslant, pale, 0.5f);
	scene.Sky(0.05f, 0.06f, 0.08f);
	if (frame == 0)
		scene.Cut();
}

static void draw_solid(unsigned floor, int frame, const unsigned maps[3])
{
	glCallList(floor);

	scene.Object(CRATE);
	scene.Class(GL_SCENE_MOVABLE_AFTERGLOW);
	glColor3f(0.7f, 0.5f, 0.3f);
	glPushMatrix();
	glTranslatef(0.2f * frame, 1, 0);
	square(0.7f, 0, 1);
	glPopMatrix();

	scene.Object(FLAG);
	scene.Class(GL_SCENE_DYNAMIC_AFTERGLOW);
	glColor3f(0.3f, 0.3f, 0.8f);
	square(0.5f + 0.05f * frame, 1, 2);

	scene.Object(LAMP);
	scene.Class(GL_SCENE_STATIC_AFTERGLOW);
	scene.Material(1, 1);
	scene.Emission(4, 3, 1);
	scene.Map(GL_SCENE_NORMAL_MAP_AFTERGLOW, maps[0]);
	scene.Map(GL_SCENE_METALLIC_ROUGHNESS_MAP_AFTERGLOW, maps[1]);
	scene.Map(GL_SCENE_EMISSION_MAP_AFTERGLOW, maps[2]);
	glPushMatrix();
	glTranslatef(-2, 1, -2);
	square(0.3f, 0, 1);
	glPopMatrix();
	scene.Defaults();
}

static void draw_others(void)
{
	glDepthMask(GL_FALSE);
	glEnable(GL_BLEND);
	glDepthFunc(GL_LEQUAL);
	glBlendFunc(GL_DST_COLOR, GL_ZERO);
	scene.Class(GL_SCENE_LAYER_AFTERGLOW);
	glColor3f(0.9f, 0.9f, 0.9f);
	square(5, 0, 2);
	scene.Class(GL_SCENE_DROPPED_AFTERGLOW);
	glColor3f(0.5f, 0.5f, 0.5f);
	glPushMatrix();
	glTranslatef(0, 0.01f, 0);
	square(0.7f, 0, 2);
	glPopMatrix();
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	scene.Class(GL_SCENE_TRANSLUCENT_AFTERGLOW);
	glColor4f(0.5f, 0.8f, 0.9f, 0.3f);
	glPushMatrix();
	glTranslatef(2, 1, 1);
	square(0.5f, 0, 1);
	glPopMatrix();
	glDisable(GL_BLEND);
	glDepthMask(GL_TRUE);

	scene.Class(GL_SCENE_OTHER_VIEW_AFTERGLOW);
	glColor3f(0.2f, 0.2f, 0.2f);
	glPushMatrix();
	glTranslatef(3, 1, -3);
	square(0.6f, 0, 1);
	glPopMatrix();

	scene.Class(GL_SCENE_VIEW_MODEL_AFTERGLOW);
	scene.Object(WEAPON);
	glColor3f(0.8f, 0.8f, 0.3f);
	glLoadIdentity();
	glTranslatef(0.5f, -0.5f, -1.5f);
	square(0.2f, 0, 1);
	scene.Object(0);

	scene.Class(GL_SCENE_INTERFACE_AFTERGLOW);
	glDisable(GL_DEPTH_TEST);
	glTranslatef(-1.5f, 1.2f, 0);
	glColor3f(1, 0, 0);
	square(0.1f, 0, 1);
	glEnable(GL_DEPTH_TEST);
	scene.Class(GL_NONE);
}

static void draw_frame(unsigned floor, int frame, const unsigned maps[3])
{
	glClearColor(0, 0, 0, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-1, 1, -0.75, 0.75, 1, 50);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	scene.Class(GL_SCENE_SKY_AFTERGLOW);
	glDepthMask(GL_FALSE);
	glColor3f(0.1f, 0.1f, 0.2f);
	glTranslatef(0, 0, -10);
	square(10, 0, 1);
	glDepthMask(GL_TRUE);
	glLoadIdentity();
	glRotatef(25, 1, 0, 0);
	glTranslatef(0, -3, -7);
	light_frame(frame);
	draw_solid(floor, frame, maps);
	draw_others();
	check(glGetError() == GL_NO_ERROR, "frame without error");
	glXSwapBuffers(display, drawable);
}

int main(void)
{
	const char *frames = getenv("FRAMES");
	int count = frames ? atoi(frames) : 4;
	open_with_visual();
	afterglowLoadSceneHints(&scene, (const char *)glGetString(GL_EXTENSIONS), glXGetProcAddressARB);
	printf("the extension is %s\n", scene.isPresent ? "present" : "absent");
	const unsigned maps[3] = { texture(128, 128, 255), texture(0, 255, 0), texture(255, 255, 255) };
	glEnable(GL_DEPTH_TEST);
	check_errors();
	unsigned floor = floor_list();
	for (int frame = 0; frame < count; frame++)
		draw_frame(floor, frame, maps);
	glFinish();
	printf("%d frames, %d failures\n", count, failures);
	return failures;
}
