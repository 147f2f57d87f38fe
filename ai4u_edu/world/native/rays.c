/* The loops over rays, for segments.py and grid.py, which say when they are used.
 *
 * Nothing of Chipmunk is linked: its query is called through a pointer that comes with the job. The
 * results have the same bits as the Python code's, so it has to be compiled without contraction
 * (no a * b + c in one step).
 */

#include <float.h>
#include <math.h>
#include <stdint.h>

#ifdef _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

_Static_assert(sizeof(void *) == 8 && FLT_EVAL_METHOD == 0,
               "numbers would be rounded in another way than Python's");

typedef struct {
    double x, y;
} Vect;

typedef struct {
    uint64_t group;
    uint32_t categories, mask;
} Filter;

typedef struct {
    void *shape;
    Vect point, normal;
    double alpha;
} Hit;

_Static_assert(sizeof(Filter) == 16 && sizeof(Hit) == 48, "not laid out as Chipmunk does");

typedef void *(*Query)(void *space, Vect start, Vect end, double radius, Filter filter, Hit *hit);
typedef void (*OnHit)(void *shape, Vect point, Vect normal, double alpha, void *data);
typedef void (*QueryAll)(void *space, Vect start, Vect end, double radius, Filter filter,
                         OnHit on_hit, void *data);
typedef unsigned char (*QueryShape)(void *shape, Vect start, Vect end, double radius, Hit *hit);

typedef struct {
    Query query;
    int64_t count;
    Filter filter;
    const Vect *directions;
    Hit *hits;
    double *distances;
} Fan;

EXPORT void cast_fan(Fan *fan, void *space, double x, double y, double reach) {
    const Vect start = {x, y};
    for (int64_t i = 0; i < fan->count; i++) {
        const Vect direction = fan->directions[i];
        const Vect end = {direction.x * reach + x, direction.y * reach + y};
        Hit *hit = fan->hits + i;
        fan->query(space, start, end, 0.0, fan->filter, hit);
        fan->distances[i] = hit->alpha < 1.0 ? hit->alpha * reach : 0.0;
    }
}

/* The perspective grid: the same as RayGrid in rays.py, cell by cell. */

enum { ENDLESS, CIRCLE, BOX, POLYGON, CAPSULE, RING };

typedef struct {
    int64_t kind, corners;
    double top, code, x, y, cos, sin, a, b;
    const Vect *corner;
} Floor;

typedef struct {
    double low, high, code;
} Thing;

typedef struct {
    int64_t rows, columns, floors, things;
    const double *slopes, *runs, *reaches, *cosines;
    const Vect *directions;
    const Hit *hits;
    const double *near;
    const Floor *floor;
    void *const *shapes;
    const Thing *thing;
    double miss;
    double *codes, *distances;
    uint8_t *undecided;
} Grid;

static double size(double number) { return number < 0.0 ? -number : number; }

/* Returns 1 if a point of a floor's own frame lies in it; see shapes.py. */
static int contains(const Floor *floor, double x, double y) {
    const double a = floor->a, b = floor->b, far = x * x + y * y;
    double past;
    switch (floor->kind) {
    case ENDLESS:
        return 1;
    case CIRCLE:
        return far <= a * a;
    case BOX:
        return 2 * size(x) <= a && 2 * size(y) <= b;
    case POLYGON:
        for (int64_t i = 0; i < floor->corners; i++) {
            const Vect to = floor->corner[i];
            const Vect from = floor->corner[i ? i - 1 : floor->corners - 1];
            if (!((to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x) >= 0))
                return 0;
        }
        return 1;
    case CAPSULE:
        past = size(x) - a / 2;
        past = past > 0 ? past : 0;
        return past * past + y * y <= b * b;
    default:
        return a * a <= far && far <= b * b;
    }
}

static const Thing *find(const Grid *grid, const void *shape) {
    for (int64_t i = 0; i < grid->things; i++)
        if (grid->shapes[i] == shape)
            return grid->thing + i;
    return 0;
}

/* Returns the distance in the plane to the first floor on a ray, and writes its code. */
static double ground(const Grid *grid, int64_t row, Vect way, Vect eye, double up, double *code) {
    double nearest = INFINITY;
    for (int64_t i = 0; i < grid->floors; i++) {
        const Floor *floor = grid->floor + i;
        const double at = (floor->top - up) * grid->runs[row];
        if (!(at > 0.0 && at <= grid->reaches[row] && at < nearest))
            continue;
        const double dx = eye.x + at * way.x - floor->x, dy = eye.y + at * way.y - floor->y;
        const double x = floor->cos * dx + floor->sin * dy, y = floor->cos * dy - floor->sin * dx;
        if (contains(floor, x, y)) {
            nearest = at;
            *code = floor->code;
        }
    }
    return nearest;
}

/* Makes the distances those along the rays, once all rays are decided. */
static void finish(Grid *grid) {
    for (int64_t row = 0; row < grid->rows; row++)
        for (int64_t column = 0; column < grid->columns; column++) {
            const int64_t cell = row * grid->columns + column;
            if (grid->distances[cell] > grid->reaches[row]) {
                grid->codes[cell] = grid->miss;
                grid->distances[cell] = 0.0;
            }
            grid->distances[cell] /= grid->cosines[row];
        }
}

/* Fills codes and distances. Rays that may meet a body behind the first one of their column, between
 * bottom and ceiling, are left undecided; returns their number. If there are any, the distances are
 * those in the plane. */
EXPORT int64_t look(Grid *grid, double x, double y, double up, double bottom, double ceiling) {
    const Vect eye = {x, y};
    int64_t open = 0;
    for (int64_t column = 0; column < grid->columns; column++) {
        const Hit *hit = grid->hits + column;
        const Thing *first = hit->alpha < 1.0 ? find(grid, hit->shape) : 0;
        const double near = grid->near[column];
        for (int64_t row = 0; row < grid->rows; row++) {
            const int64_t cell = row * grid->columns + column;
            double code = grid->miss;
            double far = ground(grid, row, grid->directions[column], eye, up, &code);
            grid->undecided[cell] = 0;
            if (first && near < far) {
                const double at = up + grid->slopes[row] * near;
                if (first->low <= at && at <= first->high) {
                    far = near;
                    code = first->code;
                } else if (at > bottom && at <= ceiling) {
                    grid->undecided[cell] = 1;
                    open++;
                }
            }
            grid->codes[cell] = code;
            grid->distances[cell] = far;
        }
    }
    if (!open)
        finish(grid);
    return open;
}

/* A body in the vertical plane through the eye and a column of rays. */
typedef struct {
    double near, far, low, high, code;
} Obstacle;

typedef struct {
    QueryAll query_all;
    QueryShape query_shape;
    const Fan *fan;
    double reach;
    Obstacle *obstacles;
} Behind;

typedef struct {
    const Behind *behind;
    const Grid *grid;
    Vect start, end;
    int64_t count;
} Plane;

/* Returns 1 if one obstacle comes before another one: they are sorted as Python sorts tuples. */
static int is_before(const Obstacle *one, const Obstacle *other) {
    if (one->near != other->near)
        return one->near < other->near;
    if (one->far != other->far)
        return one->far < other->far;
    if (one->low != other->low)
        return one->low < other->low;
    if (one->high != other->high)
        return one->high < other->high;
    return one->code < other->code;
}

/* Chipmunk calls it with each shape between the ends of a plane. */
static void add_obstacle(void *shape, Vect point, Vect normal, double alpha, void *data) {
    (void)point, (void)normal;
    Plane *plane = data;
    const Behind *behind = plane->behind;
    const Thing *thing = find(plane->grid, shape);
    if (!thing || plane->count == plane->grid->things)
        return;
    Hit back;
    const int leaves = behind->query_shape(shape, plane->end, plane->start, 0.0, &back);
    const double share = leaves ? 1.0 - back.alpha : alpha;
    const Obstacle met = {alpha * behind->reach, share * behind->reach, thing->low, thing->high,
                          thing->code};
    int64_t i = plane->count++;
    for (; i && is_before(&met, behind->obstacles + i - 1); i--)
        behind->obstacles[i] = behind->obstacles[i - 1];
    behind->obstacles[i] = met;
}

/* Returns the distance in the plane at which a ray enters an obstacle, or infinity. */
static double meet(const Obstacle *obstacle, double up, double slope) {
    if (slope == 0.0)
        return obstacle->low <= up && up <= obstacle->high ? obstacle->near : INFINITY;
    const double a = (obstacle->low - up) / slope, b = (obstacle->high - up) / slope;
    const double first = b < a ? b : a, last = b > a ? b : a;
    const double enter = first > obstacle->near ? first : obstacle->near;
    const double leave = last < obstacle->far ? last : obstacle->far;
    return enter <= leave ? enter : INFINITY;
}

/* Decides the rays that look() left undecided, by all bodies in the planes of their columns. */
EXPORT void look_behind(const Behind *behind, Grid *grid, void *space, double x, double y,
                        double up) {
    const Vect eye = {x, y};
    for (int64_t column = 0; column < grid->columns; column++) {
        Plane plane = {behind, grid, eye, eye, -1};
        for (int64_t row = 0; row < grid->rows; row++) {
            const int64_t cell = row * grid->columns + column;
            if (!grid->undecided[cell])
                continue;
            if (plane.count < 0) {
                const Vect way = grid->directions[column];
                plane.end = (Vect){way.x * behind->reach + x, way.y * behind->reach + y};
                plane.count = 0;
                behind->query_all(space, eye, plane.end, 0.0, behind->fan->filter, add_obstacle,
                                  &plane);
            }
            for (int64_t i = 0; i < plane.count; i++) {
                const double at = meet(behind->obstacles + i, up, grid->slopes[row]);
                if (at < grid->distances[cell]) {
                    grid->codes[cell] = behind->obstacles[i].code;
                    grid->distances[cell] = at;
                }
            }
        }
    }
    finish(grid);
}
