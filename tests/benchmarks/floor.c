/* The loop over the yardstick's rays, for CompiledFloor in floors.py. */

typedef struct {
    double x, y;
} Vect;

typedef struct {
    unsigned long long group;
    unsigned int categories, mask;
} Filter;

typedef struct {
    void *shape;
    Vect point, normal;
    double alpha;
} Hit;

typedef void *(*Query)(void *space, Vect start, Vect end, double radius, Filter filter, Hit *hit);

void cast(Query query, void *space, double x, double y, const Vect *ends, Filter *filter, Hit *hits,
          int count) {
    for (int i = 0; i < count; i++)
        query(space, (Vect){x, y}, ends[i], 0.0, *filter, hits + i);
}
