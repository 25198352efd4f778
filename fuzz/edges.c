/* Counts how often every edge of instrumented code is taken, in a file that the fuzzer reads after each input.

   Code compiled with `-C passes=sancov-module` calls these functions (counting-rustc); without it nothing does. The file is
   that of ROTORDYN_FUZZ_EDGES: the number of edges as 32 bits, then one saturating byte for each edge. */

#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#define MAX_EDGES (1u << 20)

static uint8_t unread[MAX_EDGES + 4];
static uint8_t *counts = unread;
static uint32_t edges;

static void map_counts(void) {
    const char *path = getenv("ROTORDYN_FUZZ_EDGES");
    int file = path ? open(path, O_RDWR) : -1;
    if (file < 0) {
        return;
    }
    void *mapped = ftruncate(file, sizeof unread) == 0
                       ? mmap(NULL, sizeof unread, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0)
                       : MAP_FAILED;
    close(file);
    if (mapped != MAP_FAILED) {
        counts = mapped;
    }
}

void __sanitizer_cov_trace_pc_guard_init(uint32_t *start, uint32_t *stop) {
    if (start == stop || *start) {
        return;
    }
    if (counts == unread) {
        map_counts();
    }
    for (uint32_t *guard = start; guard < stop; guard++) {
        *guard = edges + 1 < MAX_EDGES ? ++edges : edges;
    }
    *(uint32_t *)counts = edges;
}

void __sanitizer_cov_trace_pc_guard(uint32_t *guard) {
    uint8_t *count = counts + 3 + *guard;
    if (*count != UINT8_MAX) {
        ++*count;
    }
}
