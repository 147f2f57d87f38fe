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

/* The perspective grid: the same as RayGrid in ray_grid.py, cell by cell. */

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
    if (open)
        return open;
    for (int64_t row = 0; row < grid->rows; row++)
        for (int64_t column = 0; column < grid->columns; column++) {
            const int64_t cell = row * grid->columns + column;
            if (grid->distances[cell] > grid->reaches[row]) {
                grid->codes[cell] = grid->miss;
                grid->distances[cell] = 0.0;
            }
            grid->distances[cell] /= grid->cosines[row];
        }
    return 0;
}
