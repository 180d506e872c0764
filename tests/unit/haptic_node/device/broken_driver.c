/* Drivers that are wrong in one way each, chosen by the macro BROKEN. Also shows that the contract is C99. */
#include "haptic_node/device/haptic_device.h"

#define NO_SYMBOL 1
#define NO_SDK 2
#define ABI_2 3
#define SHORT_TABLE 4
#define HOLE 5
#define NULL_TABLE 6
#define FIRST_TABLE 7 /* not wrong: of minor version 0, behind whose end lies what is no function */

#if BROKEN == NO_SYMBOL
int palpate_test_something_else(void);
int palpate_test_something_else(void) { return 1; }
#else

#if BROKEN == NO_SDK
extern int vendor_function_that_nobody_has(void);
#endif

static hdev_status t_enumerate(const hdev_host* h, char (*ids)[64], uint32_t cap, uint32_t* n) {
  (void)h, (void)ids, (void)cap;
  *n = 0;
  return HDEV_OK;
}
static hdev_status t_open(const hdev_host* h, const char* id, const char* const* kv, uint32_t n, hdev** out) {
  (void)h, (void)id, (void)kv, (void)n;
  *out = NULL;
  return HDEV_E_NODEV;
}
static hdev_status t_info(hdev* d, hdev_info* i) { return (void)d, (void)i, HDEV_E_UNSUPPORTED; }
static hdev_status t_number(hdev* d, uint32_t n) { return (void)d, (void)n, HDEV_E_UNSUPPORTED; }
static void t_close(hdev* d) { (void)d; }
static const char* t_error(hdev* d) { return (void)d, ""; }
static hdev_status t_plain(hdev* d) { return (void)d, HDEV_OK; }
static hdev_status t_read(hdev* d, hdev_state* s, uint32_t us) {
  return (void)d, (void)s, (void)us, HDEV_E_AGAIN;
}
static hdev_status t_write(hdev* d, const hdev_command* c) { return (void)d, (void)c, HDEV_OK; }

static const hdev_api table = {
#if BROKEN == SHORT_TABLE
    16,
#elif BROKEN == FIRST_TABLE
    offsetof(hdev_api, emergency_stop),
#else
    sizeof(hdev_api),
#endif
#if BROKEN == ABI_2
    2,
#else
    HDEV_ABI_MAJOR,
#endif
    HDEV_ABI_MINOR,
    0,
    "broken",
    "0",
    t_enumerate,
    t_open,
    t_info,
    t_number,
    t_number,
    t_close,
    t_error,
    t_plain,
    t_read,
    t_write,
#if BROKEN == HOLE
    NULL,
#else
    t_plain,
#endif
#if BROKEN == FIRST_TABLE
    (hdev_status(*)(hdev*, uint32_t))1,
    (hdev_status(*)(const hdev_host*, const char*, const char* const*, uint32_t))1,
#else
    NULL,
    NULL,
#endif
    NULL
};

const hdev_api* hdev_plugin_query(uint32_t major, uint32_t minor) {
  (void)major, (void)minor;
#if BROKEN == NULL_TABLE
  (void)table;
  return NULL;
#elif BROKEN == NO_SDK
  return vendor_function_that_nobody_has() != 0 ? &table : NULL;
#else
  return &table;
#endif
}
#endif
