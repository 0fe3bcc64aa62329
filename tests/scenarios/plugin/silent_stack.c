/* The least that a stack can be, in C. FLAW_… makes a library that must be refused. */
#include "plugin.h"

static int32_t Create(const AlulaSetup* setup, void** self, AlulaError* error) {
  (void)setup;
  (void)error;
  *self = NULL;
  return ALULA_OK;
}

#ifndef FLAW_STEP
static int32_t Step(void* self, int64_t now_ns, const AlulaMeasurement* measurements, uint64_t count,
                    AlulaOutput* output, AlulaError* error) {
  (void)self;
  (void)now_ns;
  (void)measurements;
  (void)count;
  (void)error;
  output->state = ALULA_READY;
  return ALULA_OK;
}
#else
#define Step NULL
#endif

static void Destroy(void* self) { (void)self; }

#ifdef FLAW_VERSION
#define VERSION (ALULA_STACK_ABI_VERSION + 1u)
#else
#define VERSION ALULA_STACK_ABI_VERSION
#endif

#ifdef FLAW_LAYOUT
#define LAYOUT {0}
#else
#define LAYOUT ALULA_LAYOUT
#endif

#ifdef FLAW_SYMBOL
#define alula_stack_plugin another_name
ALULA_STACK_EXPORT const AlulaStackPlugin* another_name(void);
#endif

ALULA_STACK_EXPORT const AlulaStackPlugin* alula_stack_plugin(void) {
  static const AlulaStackPlugin plugin = {VERSION, 0, LAYOUT, "silent", Create, Step, NULL, NULL, Destroy};
  return &plugin;
}
