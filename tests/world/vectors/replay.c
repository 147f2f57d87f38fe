/* Replays recorded calls of the compiled part and compares all memory bit for bit.
 *
 * Usage: replay LIBRARY VECTORS. Prints the number of calls, or the first difference.
 */

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#define OPEN(path) ((void *)LoadLibraryA(path))
#define FIND(library, name) ((void *)GetProcAddress((HMODULE)(library), name))
#else
#include <dlfcn.h>
#define OPEN(path) dlopen(path, RTLD_NOW)
#define FIND(library, name) dlsym(library, name)
#endif

enum { MOST_PIECES = 64, QUERY = -1 };

typedef struct {
    double x, y;
} Vect;

typedef struct {
    uint64_t group;
    uint32_t categories, mask;
} Filter;

typedef struct {
    Vect end;
    unsigned char hit[48];
} Asked;

typedef void (*CastFan)(void *, void *, double, double, double);
typedef int64_t (*Look)(void *, double, double, double, double, double);

static FILE *vectors;
static Asked *asked;
static int64_t queries, done;
static double arguments[5];
static unsigned char *filter;

static void fail(const char *what, int64_t call) {
    printf("call %lld: %s\n", (long long)call, what);
    exit(1);
}

static void fill(void *memory, int64_t size) {
    if (fread(memory, 1, size, vectors) != (size_t)size)
        fail("the file of vectors ends too early", -1);
}

static int64_t number(void) {
    int64_t value;
    fill(&value, sizeof value);
    return value;
}

/* The stand-in for Chipmunk's query: checks what it is asked, and answers as was recorded. */
static void *query(void *space, Vect start, Vect end, double radius, Filter chosen, void *hit) {
    if (done >= queries || memcmp(&end, &asked[done].end, sizeof end) || radius != 0.0 ||
        start.x != arguments[0] || start.y != arguments[1] || space != &vectors ||
        memcmp(&chosen, filter, sizeof chosen))
        fail("Chipmunk is asked something else", done);
    memcpy(hit, asked[done++].hit, 48);
    return hit;
}

static void replay(int64_t call, CastFan cast_fan, Look look) {
    static unsigned char *memory[MOST_PIECES], *after[MOST_PIECES];
    static int64_t sizes[MOST_PIECES];
    const int64_t function = number(), pieces = number();
    if (pieces > MOST_PIECES)
        fail("too many pieces of memory", call);
    for (int64_t i = 0; i < pieces; i++) {
        sizes[i] = number();
        fill(memory[i] = malloc(sizes[i]), sizes[i]);
        fill(after[i] = malloc(sizes[i]), sizes[i]);
    }
    for (int64_t pointers = number(); pointers > 0; pointers--) {
        const int64_t piece = number(), offset = number(), target = number();
        const void *address = target == QUERY ? (void *)query : memory[target];
        memcpy(memory[piece] + offset, &address, sizeof address);
        memcpy(after[piece] + offset, &address, sizeof address);
    }
    fill(arguments, sizeof arguments);
    const int64_t expected = number();
    queries = number();
    asked = malloc(queries * sizeof *asked + 1);
    fill(asked, queries * sizeof *asked);
    done = 0;
    filter = memory[0] + 16;
    int64_t returned = 0;
    if (function == 0)
        cast_fan(memory[0], &vectors, arguments[0], arguments[1], arguments[2]);
    else
        returned = look(memory[0], arguments[0], arguments[1], arguments[2], arguments[3],
                        arguments[4]);
    if (returned != expected || done != queries)
        fail("it returned something else", call);
    for (int64_t i = 0; i < pieces; i++) {
        if (memcmp(memory[i], after[i], sizes[i]))
            fail(function ? "look wrote other bits" : "cast_fan wrote other bits", call);
        free(memory[i]);
        free(after[i]);
    }
    free(asked);
}

int main(int count, char **words) {
    void *library = count == 3 ? OPEN(words[1]) : 0;
    vectors = library ? fopen(words[2], "rb") : 0;
    if (!vectors)
        fail("expected a library and a file of vectors that can be opened", -1);
    CastFan cast_fan = (CastFan)FIND(library, "cast_fan");
    Look look = (Look)FIND(library, "look");
    if (!cast_fan || !look)
        fail("a function is missing", -1);
    const int64_t calls = number();
    for (int64_t i = 0; i < calls; i++)
        replay(i, cast_fan, look);
    printf("%lld calls, the same bits\n", (long long)calls);
    return 0;
}
