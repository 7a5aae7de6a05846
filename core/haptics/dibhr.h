/* The haptic core for programs in C and in languages that call C: depth images in, forces out.
 *
 * Space: x = column, y = row (down), z = elevation towards the viewer, all in pixels of the depth
 * image; (0, 0) is the centre of its first pixel. The goal is the haptic interaction point, the
 * proxy the god-object. Forces are newtons along the same axes, on the hand.
 *
 * A handle belongs to one thread at a time; different handles share nothing. `dibhr_update` and all
 * that only reads allocate nothing, lock nothing and wait for nothing. `dibhr_set_depth`,
 * `dibhr_push_depth` and `dibhr_set_bump` copy an image, and may allocate and free. Once there are
 * both, the bump map is stretched over the depth image: 8 bytes and some nanoseconds a level, again
 * only when the size changes.
 *
 * A function that can fail gives a status, and changes nothing then; `dibhr_last_error` says what
 * was wrong. No exception leaves it, and a handle of NULL is a bad argument like others. */
#ifndef DIBHR_H
#define DIBHR_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* NOLINTBEGIN(readability-identifier-naming): types as C names them */

typedef struct dibhr_handle dibhr_handle;

typedef enum dibhr_status {
    DIBHR_OK = 0,
    DIBHR_BAD_ARGUMENT, /* NULL, not finite, or a size that cannot be */
    DIBHR_UNKNOWN_NAME, /* no parameter or algorithm is called that */
    DIBHR_OUT_OF_RANGE, /* a number outside its parameter's range */
    DIBHR_NO_SURFACE,   /* no depth image was given yet */
    DIBHR_NO_MEMORY
} dibhr_status;

/* "0.1.0" */
const char* dibhr_version(void);

/* A handle with every parameter at its default and no surface; NULL without memory. */
dibhr_handle* dibhr_create(void);
void dibhr_destroy(dibhr_handle* handle); /* NULL: nothing */

/* Of the last call with this handle that failed, in plain words; "" before the first. It stands
 * until the next one fails. */
const char* dibhr_last_error(const dibhr_handle* handle);

/* ---- The surface ---- */

typedef enum dibhr_level_type {
    DIBHR_LEVELS_8_BIT = 0, /* unsigned char */
    DIBHR_LEVELS_16_BIT,    /* unsigned short, in the machine's byte order */
    DIBHR_LEVELS_FLOAT
} dibhr_level_type;

/* rows x columns levels, row by row from the top, at least 2 x 2. Brighter is nearer to the viewer
 * and higher: elevation = relief * level / highest_level. Levels lie in [0, highest_level]. */
typedef struct dibhr_image {
    const void* levels;
    int type; /* a dibhr_level_type */
    int columns;
    int rows;
    size_t row_bytes;     /* from one row to the next; 0: the rows follow each other */
    double highest_level; /* 0: 255, 65535 or 1, by type */
} dibhr_image;

/* The surface is `from`, or what `dibhr_set_blend` makes of `from` and `to`: the same size and
 * highest level. `to` may be NULL. The blend becomes 0 and the force begins anew from zero. Where
 * the size is the one before, the proxy stays at its (x, y); else it starts above the goal. */
dibhr_status dibhr_set_depth(dibhr_handle* handle, const dibhr_image* from, const dibhr_image* to);

/* The next frame of a video: what was `to` becomes `from` (what was `from` stays it if there was no
 * `to`), `next` becomes `to` and the blend 0. The proxy follows the surface; the force goes on. */
dibhr_status dibhr_push_depth(dibhr_handle* handle, const dibhr_image* next);

/* Between the two images, in [0, 1]: 0 is `from`, 1 is `to`. */
dibhr_status dibhr_set_blend(dibhr_handle* handle, double blend);

/* Relief laid over the image, at any resolution: level / highest_level times the parameter
 * "roughness"; once over the whole, or again and again where the parameter "bump-size" (set before:
 * then updates are quicker) says how wide. NULL: none. (`dibhr touch --bump` and the Python module stretch a picture's lowest
 * to highest level over 0 to 1 before.) */
dibhr_status dibhr_set_bump(dibhr_handle* handle, const dibhr_image* bump);

/* Of the surface under (x, y) [px]; outside the image that of its border. */
dibhr_status dibhr_elevation(const dibhr_handle* handle, double x, double y, double* z);

/* ---- Parameters ---- */

/* One number people tune, or one switch: 0 is off, 1 is on, and what lies between counts as on. The
 * texts stay valid for as long as the program runs. */
typedef struct dibhr_parameter {
    const char* name; /* "stiffness" */
    const char* unit; /* "N/mm"; "" for a ratio */
    const char* help;
    double lowest;
    double highest;
    double initial; /* what a new handle has */
} dibhr_parameter;

/* How many there are: relief, friction, stiffness and so on; `dibhr_parameter_at` tells each. */
size_t dibhr_parameter_count(void);

/* The one of this index, 0 to count - 1; DIBHR_BAD_ARGUMENT past the end. */
dibhr_status dibhr_parameter_at(size_t index, dibhr_parameter* parameter);

/* By name; acts on the next update. A dynamic friction above the static one counts as that. */
dibhr_status dibhr_set(dibhr_handle* handle, const char* name, double value);
dibhr_status dibhr_get(const dibhr_handle* handle, const char* name, double* value);

/* The algorithms' names: "dibhr" (a new handle's), "pga", "neighborhood", "god-object"; NULL past
 * the end. */
const char* dibhr_algorithm_at(size_t index);

/* Another one goes on from where the proxy is; the force begins anew from zero. */
dibhr_status dibhr_set_algorithm(dibhr_handle* handle, const char* name);
const char* dibhr_algorithm(const dibhr_handle* handle);

/* ---- Safety: the last stage of every update ---- */

typedef struct dibhr_safety {
    double max_force_newton;         /* the smaller of the device's limit and the user's */
    double max_change_newton_per_ms; /* of the force */
    double ramp_s;                   /* from zero to the full force, whenever it begins anew */
    double max_tick_s;               /* a longer dt is late: no force */
    double max_goal_speed_mm_per_ms; /* a faster goal has jumped: no force */
} dibhr_safety;

dibhr_status dibhr_get_safety(const dibhr_handle* handle, dibhr_safety* safety);
dibhr_status dibhr_set_safety(dibhr_handle* handle, const dibhr_safety* safety);

/* 0: zero force is sent, and the spring force is computed all the same. A new handle's is on. */
dibhr_status dibhr_enable_force(dibhr_handle* handle, int enabled);

/* ---- Touching ---- */

typedef enum dibhr_primitive {
    DIBHR_NO_PRIMITIVE = 0, /* in the air */
    DIBHR_TRIANGLE,
    DIBHR_EDGE,
    DIBHR_VERTEX
} dibhr_primitive;

typedef struct dibhr_touch {
    double goal[3];
    double proxy[3];
    double spring_force[3]; /* spring and damper [N]: before the safety stage */
    double sent_force[3];   /* what a device may be given [N]: after it */
    int contact;            /* 1: the proxy is on the surface, held back from the goal */
    int slipping;           /* 1: dynamic friction holds */
    dibhr_primitive primitive;
    int i, j;            /* its cell, first end or vertex: a column and a row; -1, -1 in the air */
    int moves;           /* primitives visited in this update */
    const char* cut; /* why the sent force is zero, in a few words; "" if it need not be */
    int bound_met;   /* 1: that was all an update may do: the proxy is still catching up */
} dibhr_touch;

/* One update, dt_s seconds after the last: the proxy follows the goal. Its work is bounded: after a
 * jump far along the surface the proxy takes some updates to arrive, and `touch.bound_met` says so.
 * A goal more than 100,000 pixels off the scene counts as there, and `touch.goal` says so. `touch`
 * may be NULL. The first one starts the proxy above the goal, in the air. Where x, y or z is not
 * finite the proxy stays, both forces are zero and the status is DIBHR_BAD_ARGUMENT. */
dibhr_status dibhr_update(dibhr_handle* handle, double x, double y, double z, double dt_s,
                          dibhr_touch* touch);

/* What the last update gave; before the first: in the air, no forces. */
dibhr_status dibhr_read(const dibhr_handle* handle, dibhr_touch* touch);

/* The next update is a first one. Surface, parameters and limits stay. */
dibhr_status dibhr_reset(dibhr_handle* handle);

/* "none", "triangle", "edge" or "vertex" */
const char* dibhr_primitive_name(dibhr_primitive primitive);

/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
