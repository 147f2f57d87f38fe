/* Ticks in which nobody takes off, lands or falls, for _ticks.py; it says when they are used.
 *
 * Nothing of Chipmunk is linked: its functions are called through pointers that come with the job.
 * The numbers are those of the Python way to the last bit. So it has to be compiled without
 * contraction (no a * b + c in one step), and with the library's own cos and sin, as Python has.
 */

#include <math.h>
#include <stdint.h>

typedef struct {
    double x, y;
} Vect;

typedef struct {
    int64_t ticks, failed; /* Contacts.clock */
} Clock;

typedef struct {
    double x, y, width, depth; /* an upright box */
} Floor;

typedef struct {
    void *body;
    int64_t first, count; /* the floors that bear it */
} Mover;

typedef struct {
    double forward, left, turning;
    int64_t pushed;
} Drive;

typedef struct {
    void (*step)(void *space, double dt);
    Vect (*place)(void *body);
    double (*angle)(void *body);
    void (*set_velocity)(void *body, Vect velocity);
    void (*set_angular_velocity)(void *body, double omega);
    void (*push)(void *body, Vect force, Vect where);
    void *space;
    double dt;
    Clock *clock;
    int64_t movers;
    const Mover *mover;
    const Floor *floor;
} World;

static const double PI = 3.141592653589793, TAU = 2 * 3.141592653589793;

/* In [-pi, pi), as Python's % does it. */
static double heading(double angle) {
    double turned = fmod(angle + PI, TAU);
    if (turned < 0)
        turned += TAU;
    return turned - PI;
}

/* Tells a body to drive; but not if Python would refuse. */
static int tell(const World *world, void *body, const Drive *drive) {
    const double forward = drive->forward, left = drive->left;
    if (!isfinite(forward + left) || !isfinite(drive->turning))
        return 0;
    if (drive->pushed) {
        const Vect force = {forward, left}, centre = {0.0, 0.0};
        world->push(body, force, centre);
    } else {
        const double way = heading(world->angle(body)), c = cos(way), s = sin(way);
        const Vect velocity = {forward * c - left * s, forward * s + left * c};
        if (!isfinite(velocity.x + velocity.y))
            return 0;
        world->set_velocity(body, velocity);
    }
    world->set_angular_velocity(body, drive->turning);
    return 1;
}

static int stands(const World *world, const Mover *mover) {
    const Vect at = world->place(mover->body);
    for (int64_t i = mover->first; i < mover->first + mover->count; i++) {
        const Floor *floor = world->floor + i;
        if (2 * fabs(at.x - floor->x) <= floor->width && 2 * fabs(at.y - floor->y) <= floor->depth)
            return 1;
    }
    return 0;
}

/* Drives a body on the ground, tick by tick; ends early after a tick that leaves a mover where it may
 * not stand any more, or in which a handler has failed, or before one that Python would refuse. Tells
 * whether the movers have to be looked at after the last tick. */
int64_t run(const World *world, int64_t ticks, void *body, double forward, double left,
            double turning, int64_t pushed) {
    const Drive drive = {forward, left, turning, pushed};
    for (; ticks > 0; ticks--) {
        if (!tell(world, body, &drive))
            return 0;
        world->clock->ticks++;
        world->step(world->space, world->dt);
        for (int64_t i = 0; i < world->movers; i++)
            if (!stands(world, world->mover + i))
                return 1;
        if (world->clock->failed)
            return 0;
    }
    return 0;
}
