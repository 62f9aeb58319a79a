/* GL_AFTERGLOW_scene_hints: a program says what its drawing means.
 *
 * Afterglow finds a scene behind OpenGL calls by evidence. A program that can be changed may say instead of what its
 * draws are: which object, which class, of what material; where the camera is; what shines. What is said counts more
 * than what would be found, and what is not said is found as ever, so a few calls are enough to begin with.
 *
 * This header is C99 (and C++), needs no other header of OpenGL, and needs nothing to link: load the functions with
 * afterglowLoadSceneHints below. On a libGL without the extension they do nothing, so the program calls them anyway.
 *
 *     AfterglowSceneHints scene;
 *     afterglowLoadSceneHints(&scene, (const char *)glGetString(GL_EXTENSIONS), glXGetProcAddressARB);
 *
 * When the library only rasterizes (AFTERGLOW_MODE=raster, or where rays are not possible or too slow), every call is
 * checked for errors and then changes nothing that is seen.
 *
 * WHAT HOLDS HOW LONG
 *   What is said of draws (object, class, material, emission, maps) is state: it holds for what is drawn by vertices
 *   (glBegin, arrays, lists; not glDrawPixels and the like) until it is changed, also in the frames that follow. It
 *   is compiled into display lists. glPushAttrib and glPopAttrib neither save nor restore it.
 *   What is said of the frame (view, lights, sky, cut) holds until the buffer swap: say it anew in every frame, at any
 *   time before the swap. It is not compiled into display lists; while one is compiled it is executed at once.
 *
 * ERRORS
 *   Every call is GL_INVALID_OPERATION between glBegin and glEnd. What else may be wrong is said with each call.
 *   A call in error does nothing.
 *
 * SPACES AND UNITS
 *   World space is the space that the view matrix (glSceneViewAFTERGLOW) takes to eye space. Lengths are in its
 *   units, whatever they are. Angles are in degrees. Colours of light are linear RGB, not sRGB, and have no upper
 *   bound. Radiance 1 is the white of a picture; radiant intensity is radiance times squared length: a white matt
 *   surface that faces a point light of intensity I at distance d shows I / (pi d d). All this is before exposure:
 *   the picture is made as bright on the whole as the one that the program drew, so that ratios count.
 *
 * The values of the enumerants are not registered with Khronos. They begin at 0x41470000, far above the ranges that
 * its registry gives out.
 */
#ifndef AFTERGLOW_H
#define AFTERGLOW_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32) && !defined(AFTERGLOW_APIENTRY)
#define AFTERGLOW_APIENTRY __stdcall
#elif !defined(AFTERGLOW_APIENTRY)
#define AFTERGLOW_APIENTRY
#endif

#ifndef GL_AFTERGLOW_scene_hints
#define GL_AFTERGLOW_scene_hints 1

/* Classes, besides GL_NONE (0). */
#define GL_SCENE_STATIC_AFTERGLOW                 0x41470001 /* part of the world that never moves */
#define GL_SCENE_MOVABLE_AFTERGLOW                0x41470002 /* rigid part of it that moves by its matrix */
#define GL_SCENE_DYNAMIC_AFTERGLOW                0x41470003 /* part of it whose vertices change */
#define GL_SCENE_VIEW_MODEL_AFTERGLOW             0x41470004 /* weapon or hands before the camera */
#define GL_SCENE_TRANSLUCENT_AFTERGLOW            0x41470005 /* blended over the world */
#define GL_SCENE_SKY_AFTERGLOW                    0x41470006 /* behind everything */
#define GL_SCENE_INTERFACE_AFTERGLOW              0x41470007 /* menus, status bar */
#define GL_SCENE_LAYER_AFTERGLOW                  0x41470008 /* same triangles again: detail, lightmap, glow */
#define GL_SCENE_OTHER_VIEW_AFTERGLOW             0x41470009 /* mirror, picture in picture */
#define GL_SCENE_DROPPED_AFTERGLOW                0x4147000A /* painted shadow, flare: rays make it themselves */

/* Maps. */
#define GL_SCENE_NORMAL_MAP_AFTERGLOW             0x41470010
#define GL_SCENE_METALLIC_ROUGHNESS_MAP_AFTERGLOW 0x41470011 /* roughness in green, metallic in blue */
#define GL_SCENE_EMISSION_MAP_AFTERGLOW           0x41470012

/* For glGetIntegerv. */
#define GL_MAX_SCENE_LIGHTS_AFTERGLOW             0x41470020
#endif

/* ---- What is said of the draws that follow ---- */

/* void glSceneObjectAFTERGLOW(GLuint64 object)
 *   The draws that follow are of this object: a name of the program's own that is the same in every frame, or 0 for
 *   none. Draws of different objects are kept apart.
 *   By it, in frames that have a view, the object is found again where it was in the frame before, however far it
 *   has gone since; its draws are paired in their order. */
typedef void (AFTERGLOW_APIENTRY *PFNGLSCENEOBJECTAFTERGLOWPROC)(uint64_t object);

/* void glSceneClassAFTERGLOW(GLenum sceneClass)
 *   What they are: GL_SCENE_..._AFTERGLOW, or GL_NONE to have it found by evidence. STATIC, MOVABLE, DYNAMIC and
 *   VIEW_MODEL are lit by rays; VIEW_MODEL casts no shadow on the others. They must be triangles (or what consists
 *   of them) under a perspective projection and a MODELVIEW matrix that has an inverse; of other draws these four
 *   classes are not taken. TRANSLUCENT, SKY, INTERFACE and OTHER_VIEW are shown as they are drawn. A LAYER belongs to
 *   the draw before it that has the same triangles. What is DROPPED is not drawn at all, unless frames are rasterized.
 *   GL_INVALID_ENUM: none of these. */
typedef void (AFTERGLOW_APIENTRY *PFNGLSCENECLASSAFTERGLOWPROC)(unsigned int sceneClass);

/* void glSceneMaterialAFTERGLOW(GLfloat roughness, GLfloat metallic)
 *   What their surfaces are like, each from 0 to 1. Their colour is that of the draw: texture times glColor or
 *   glMaterial. It then counts as the colour of a material and not as light that was painted onto it.
 *   What it does today: lights make highlights that are as wide and bright as the roughness has them, in the
 *   surface's own colour as far as it is metallic. Surroundings are not reflected, however smooth the surface.
 *   GL_INVALID_VALUE: outside of 0 to 1. */
typedef void (AFTERGLOW_APIENTRY *PFNGLSCENEMATERIALAFTERGLOWPROC)(float roughness, float metallic);

/* void glSceneEmissionAFTERGLOW(GLfloat red, GLfloat green, GLfloat blue)
 *   The radiance that they give off, whatever their texture; an emission map varies it. It is seen (no brighter than
 *   white) and lights what is near, as far as rays that are scattered by surfaces happen to meet it: say a light
 *   besides for a small bright lamp.
 *   It has no effect in a world whose only light is baked into its textures.
 *   GL_INVALID_VALUE: negative or not finite. */
typedef void (AFTERGLOW_APIENTRY *PFNGLSCENEEMISSIONAFTERGLOWPROC)(float red, float green, float blue);

/* void glSceneMapAFTERGLOW(GLenum map, GLuint texture)
 *   A two-dimensional texture, by its name, that varies the material over the surface, with the coordinates of texture
 *   unit 0 as they are given (no texture matrix, no generation); 0 is none. It is looked up when something is drawn: a
 *   name that is no complete two-dimensional texture then is as 0. Metallic-roughness (linear) and emission (sRGB) are
 *   multiplied with what is said of the draw, or with 1 if nothing is. Normals are in the space of the triangle, x
 *   along growing s, y along growing t, 0.5 being 0; rays that other surfaces scatter meet it without them.
 *   GL_INVALID_ENUM: no such map. */
typedef void (AFTERGLOW_APIENTRY *PFNGLSCENEMAPAFTERGLOWPROC)(unsigned int map, unsigned int texture);

/* void glSceneDefaultsAFTERGLOW(void)
 *   Nothing is said of the draws that follow: all of the above is as in the beginning. */
typedef void (AFTERGLOW_APIENTRY *PFNGLSCENEDEFAULTSAFTERGLOWPROC)(void);

/* ---- What is said of the frame ---- */

/* void glSceneViewAFTERGLOW(void)
 *   The matrix that is now on top of the MODELVIEW stack is the frame's view: what it does is the camera's, and what
 *   else there is in the MODELVIEW of a draw is the draw's own place in the world. Call it where the program has
 *   just loaded its camera. If it is called again, the last one counts. The projection is that of the world's draws.
 *   GL_INVALID_OPERATION: the matrix has no inverse. */
typedef void (AFTERGLOW_APIENTRY *PFNGLSCENEVIEWAFTERGLOWPROC)(void);

/* Lights. Those that are said take the place of all that would be found (glLight's too); they count only in frames
 * that have a view. `light` is a name of the program's own that is the same in every frame; in one frame a later light
 * takes the place of an earlier one of that name, unless it is 0. For darkness, say one light without intensity. Of
 * more than 32 in a frame those are used that are brightest as the camera is lit by them.
 * Surfaces that the program lights beforehand (lightmaps, differing vertex colours) keep their colours and are darkened
 * where light does not reach; to have them lit anew, draw them without, or say their material.
 * GL_INVALID_VALUE: a number is not finite, light is negative, a direction is null, an angle or exponent is out of its
 * range. GL_OUT_OF_MEMORY: more than GL_MAX_SCENE_LIGHTS_AFTERGLOW (256) in one frame. */

/* void glScenePointLightAFTERGLOW(GLuint64 light, const GLfloat *position, const GLfloat *intensity, GLfloat radius)
 *   A sphere at a position in world space that shines with a radiant intensity to all sides. The radius makes shadows
 *   soft, and what lies within 1.5 radii casts none. */
typedef void (AFTERGLOW_APIENTRY *PFNGLSCENEPOINTLIGHTAFTERGLOWPROC)(uint64_t light, const float *position,
								     const float *intensity, float radius);

/* void glSceneSpotLightAFTERGLOW(GLuint64 light, const GLfloat *position, const GLfloat *direction,
 *                                const GLfloat *intensity, GLfloat radius, GLfloat cutoff, GLfloat exponent)
 *   The same into a cone about a direction: cutoff (0 to 90) is the angle between its axis and its side, and exponent
 *   (0 to 128) the fall towards the side, both as of glLight. */
typedef void (AFTERGLOW_APIENTRY *PFNGLSCENESPOTLIGHTAFTERGLOWPROC)(uint64_t light, const float *position,
								    const float *direction, const float *intensity,
								    float radius, float cutoff, float exponent);

/* void glSceneDirectionalLightAFTERGLOW(GLuint64 light, const GLfloat *direction, const GLfloat *irradiance,
 *                                       GLfloat angle)
 *   A light that is infinitely far and shines along a direction. A white matt surface that faces it shows irradiance /
 *   pi. The angle (0 to 90) is its diameter as it is seen: the sun's is 0.53. */
typedef void (AFTERGLOW_APIENTRY *PFNGLSCENEDIRECTIONALLIGHTAFTERGLOWPROC)(uint64_t light, const float *direction,
									   const float *irradiance, float angle);

/* void glSceneSkyAFTERGLOW(GLfloat red, GLfloat green, GLfloat blue)
 *   The radiance of all directions in which there is nothing. It lights the world; it is not drawn.
 *   GL_INVALID_VALUE: negative or not finite. */
typedef void (AFTERGLOW_APIENTRY *PFNGLSCENESKYAFTERGLOWPROC)(float red, float green, float blue);

/* void glSceneCutAFTERGLOW(void)
 *   Nothing in this frame continues the frame before: another level, another camera, a jump. What was gathered over
 *   frames is dropped, and exposure is found anew. */
typedef void (AFTERGLOW_APIENTRY *PFNGLSCENECUTAFTERGLOWPROC)(void);

/* ---- Loading ---- */

/* The functions, for one context. */
typedef struct AfterglowSceneHints {
	int isPresent; /* 0: the functions do nothing */
	PFNGLSCENEOBJECTAFTERGLOWPROC Object;
	PFNGLSCENECLASSAFTERGLOWPROC Class;
	PFNGLSCENEMATERIALAFTERGLOWPROC Material;
	PFNGLSCENEEMISSIONAFTERGLOWPROC Emission;
	PFNGLSCENEMAPAFTERGLOWPROC Map;
	PFNGLSCENEDEFAULTSAFTERGLOWPROC Defaults;
	PFNGLSCENEVIEWAFTERGLOWPROC View;
	PFNGLSCENEPOINTLIGHTAFTERGLOWPROC PointLight;
	PFNGLSCENESPOTLIGHTAFTERGLOWPROC SpotLight;
	PFNGLSCENEDIRECTIONALLIGHTAFTERGLOWPROC DirectionalLight;
	PFNGLSCENESKYAFTERGLOWPROC Sky;
	PFNGLSCENECUTAFTERGLOWPROC Cut;
} AfterglowSceneHints;

/* glXGetProcAddressARB, or another function that finds entry points by name, as
 * (AfterglowGetProc)SDL_GL_GetProcAddress. */
typedef void (*AfterglowProc)(void);
typedef AfterglowProc (*AfterglowGetProc)(const unsigned char *name);

static inline void AFTERGLOW_APIENTRY afterglowNothing(void) {}
static inline void AFTERGLOW_APIENTRY afterglowNoObject(uint64_t object) { (void)object; }
static inline void AFTERGLOW_APIENTRY afterglowNoClass(unsigned int sceneClass) { (void)sceneClass; }
static inline void AFTERGLOW_APIENTRY afterglowNoMaterial(float roughness, float metallic)
{
	(void)roughness, (void)metallic;
}
static inline void AFTERGLOW_APIENTRY afterglowNoColor(float red, float green, float blue)
{
	(void)red, (void)green, (void)blue;
}
static inline void AFTERGLOW_APIENTRY afterglowNoMap(unsigned int map, unsigned int texture)
{
	(void)map, (void)texture;
}
static inline void AFTERGLOW_APIENTRY afterglowNoLight(uint64_t light, const float *place, const float *color,
						       float size)
{
	(void)light, (void)place, (void)color, (void)size;
}
static inline void AFTERGLOW_APIENTRY afterglowNoSpotLight(uint64_t light, const float *position,
							   const float *direction, const float *intensity,
							   float radius, float cutoff, float exponent)
{
	(void)light, (void)position, (void)direction, (void)intensity, (void)radius, (void)cutoff, (void)exponent;
}

/* Whether a list of words has a word. */
static inline int afterglowHasWord(const char *words, const char *word)
{
	size_t length = strlen(word);
	while (words && (words = strstr(words, word)) != NULL) {
		if (words[length] == ' ' || words[length] == '\0')
			return 1;
		words += length;
	}
	return 0;
}

/* Finds the functions for the context that is current, with its glGetString(GL_EXTENSIONS). Returns whether it has the
 * extension; if not, the functions do nothing. The list of extensions decides: libraries give addresses for names
 * that they do not know. */
static inline int afterglowLoadSceneHints(AfterglowSceneHints *hints, const char *extensions, AfterglowGetProc get)
{
	const AfterglowSceneHints none = {
		0, afterglowNoObject, afterglowNoClass, afterglowNoMaterial, afterglowNoColor, afterglowNoMap,
		afterglowNothing, afterglowNothing, afterglowNoLight, afterglowNoSpotLight, afterglowNoLight,
		afterglowNoColor, afterglowNothing,
	};
	*hints = none;
	if (!get || !afterglowHasWord(extensions, "GL_AFTERGLOW_scene_hints"))
		return 0;
#define AFTERGLOW_FIND(FIELD, TYPE)                                                                      \
	do {                                                                                             \
		AfterglowProc found = get((const unsigned char *)"glScene" #FIELD "AFTERGLOW");          \
		if (!found) {                                                                            \
			*hints = none;                                                                   \
			return 0;                                                                        \
		}                                                                                        \
		hints->FIELD = (TYPE)found;                                                              \
	} while (0)
	AFTERGLOW_FIND(Object, PFNGLSCENEOBJECTAFTERGLOWPROC);
	AFTERGLOW_FIND(Class, PFNGLSCENECLASSAFTERGLOWPROC);
	AFTERGLOW_FIND(Material, PFNGLSCENEMATERIALAFTERGLOWPROC);
	AFTERGLOW_FIND(Emission, PFNGLSCENEEMISSIONAFTERGLOWPROC);
	AFTERGLOW_FIND(Map, PFNGLSCENEMAPAFTERGLOWPROC);
	AFTERGLOW_FIND(Defaults, PFNGLSCENEDEFAULTSAFTERGLOWPROC);
	AFTERGLOW_FIND(View, PFNGLSCENEVIEWAFTERGLOWPROC);
	AFTERGLOW_FIND(PointLight, PFNGLSCENEPOINTLIGHTAFTERGLOWPROC);
	AFTERGLOW_FIND(SpotLight, PFNGLSCENESPOTLIGHTAFTERGLOWPROC);
	AFTERGLOW_FIND(DirectionalLight, PFNGLSCENEDIRECTIONALLIGHTAFTERGLOWPROC);
	AFTERGLOW_FIND(Sky, PFNGLSCENESKYAFTERGLOWPROC);
	AFTERGLOW_FIND(Cut, PFNGLSCENECUTAFTERGLOWPROC);
#undef AFTERGLOW_FIND
	hints->isPresent = 1;
	return 1;
}

#ifdef __cplusplus
}
#endif

#endif
