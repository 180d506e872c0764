/* The contract between palpate and the driver of a haptic device. C99 and C++20; docs/device.md explains it.
 *
 * A driver is a shared object palpate_driver_NAME.so that exports one function, hdev_plugin_query(). The host
 * loads it, asks for the table of functions, opens a device, and from then on reads a sample and writes a force in
 * every tick.
 *
 * Units are SI: m, rad, s, N, N m, kg. The frame is the device's own: right-handed and fixed to its base. What the
 * world looks like, how it is scaled, and which forces are allowed is the host's business; a driver never knows.
 * A rotation is a 3x3 matrix, row after row, that turns handle coordinates into device coordinates.
 *
 * Versions. Every struct begins with its size in bytes as its owner knows it: whoever fills a struct writes no more
 * than `size` bytes of it. A minor version only appends, a major version may change anything.
 */
#ifndef PALPATE_HAPTIC_DEVICE_H
#define PALPATE_HAPTIC_DEVICE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define HDEV_ABI_MAJOR 1u
#define HDEV_ABI_MINOR 2u
#define HDEV_ENTRY_SYMBOL "hdev_plugin_query"

/* What a call answers. Zero is good. */
typedef enum hdev_status {
  HDEV_OK = 0,
  HDEV_E_AGAIN = -1,       /* read: no newer sample in time; the last one stands, nothing is wrong      */
  HDEV_E_ARG = -2,         /* an option or argument makes no sense; last_error says which               */
  HDEV_E_NODEV = -3,       /* no such device                                                            */
  HDEV_E_BUSY = -4,        /* somebody else has it                                                      */
  HDEV_E_UNSUPPORTED = -5, /* this device cannot do that                                                */
  HDEV_E_SDK = -6,         /* the vendor's library, or a function in it, is missing                     */
  HDEV_E_COMM = -7,        /* a transfer failed; the device may be back in the next tick                */
  HDEV_E_LOST = -8,        /* unplugged: nothing but last_error() and close() may be called any more    */
  HDEV_E_FAULT = -9,       /* the device took its forces away: hdev_state.fault says why                */
  HDEV_E_NOTCAL = -10      /* it must be calibrated first                                               */
} hdev_status;

/* What a device can do (hdev_info.caps), and what a sample really measured (hdev_state.valid). */
enum {
  HDEV_CAP_POS = 1u << 0,
  HDEV_CAP_ROT = 1u << 1,
  HDEV_CAP_VEL = 1u << 2,
  HDEV_CAP_ANGVEL = 1u << 3,
  HDEV_CAP_FORCE = 1u << 4,
  HDEV_CAP_TORQUE = 1u << 5,
  HDEV_CAP_GRIP = 1u << 6,
  HDEV_CAP_GRIP_FORCE = 1u << 7,
  HDEV_CAP_HW_WATCHDOG = 1u << 8, /* drops its force by itself when commands stop (hdev_info.hw_watchdog_s) */
  HDEV_CAP_BRAKE = 1u << 9,
  HDEV_CAP_GRAVITY_COMP = 1u << 10,
  HDEV_CAP_TEMPERATURE = 1u << 11,
  HDEV_CAP_DEADMAN = 1u << 12,       /* notices whether a hand holds it                                     */
  HDEV_CAP_BLOCKING_READ = 1u << 13, /* read() waits for the device's own clock, which may pace the loop    */
  HDEV_CAP_SIMULATED = 1u << 14,     /* there is no hardware                                                */
  HDEV_CAP_REL_ENCODERS = 1u << 15,  /* must be brought to a reference before positions mean anything       */
  HDEV_CAP_SHARED = 1u << 16         /* another process may rescue() it while this one has it open          */
};

/* Why a device took its forces away (hdev_state.fault). */
enum {
  HDEV_FAULT_OVERSPEED = 1u << 0,
  HDEV_FAULT_OVERFORCE = 1u << 1,
  HDEV_FAULT_OVERTEMP = 1u << 2,
  HDEV_FAULT_WATCHDOG = 1u << 3,
  HDEV_FAULT_ESTOP = 1u << 4,
  HDEV_FAULT_DEADMAN = 1u << 5,
  HDEV_FAULT_POWER = 1u << 6,
  HDEV_FAULT_INTERNAL = 1u << 7,
  HDEV_FAULT_FORCE_OFF = 1u << 8, /* switched off by the device itself, which does not say why */
  HDEV_FAULT_SILENT = 1u << 9     /* the vendor's library or service has stopped calling back  */
};

/* Whether positions can be trusted (hdev_state.cal). */
enum { HDEV_CAL_OK = 0, HDEV_CAL_NEEDED = 1, HDEV_CAL_RUNNING = 2, HDEV_CAL_NEEDS_USER = 3 };

/* The device itself; does not change while it is open. Zero means "unknown" or "none" unless said otherwise. */
typedef struct hdev_info {
  uint32_t size;
  uint32_t caps; /* HDEV_CAP_* */
  char vendor[32];
  char model[48];
  char serial[32];
  char sdk_version[32];
  uint32_t dof_in, dof_out; /* measured and driven degrees of freedom */
  uint32_t n_buttons;
  uint32_t reserved0;
  double ws_min[3], ws_max[3];               /* usable workspace [m]                                 */
  double max_force, cont_force;              /* peak, continuous [N]                                 */
  double max_torque, cont_torque;            /* [N m]                                                */
  double max_stiffness, max_damping;         /* that stay stable at nominal_rate_hz [N/m], [N s/m]   */
  double max_rot_stiffness, max_rot_damping; /* [N m/rad], [N m s/rad]                               */
  double pos_resolution, rot_resolution;     /* [m], [rad]                                           */
  double apparent_mass, friction;            /* at the handle [kg], [N]                              */
  double nominal_rate_hz, min_rate_hz;       /* commands a second: wanted; below which it gives up   */
  double io_latency_s;                       /* from measuring to forcing                            */
  double hw_watchdog_s;                      /* silence after which it drops its force               */
} hdev_info;

/* One sample. Fields that `valid` does not name keep these defaults: R the identity, the rest 0. */
typedef struct hdev_state {
  uint32_t size;
  uint32_t valid;                             /* HDEV_CAP_* that this sample measured                 */
  uint64_t seq;                               /* grows with every new sample of the hardware          */
  int64_t t_ns;                               /* when it was measured, by hdev_host.now_ns            */
  double pos[3];                              /* of the handle's tip [m]                              */
  double R[9];                                /* attitude of the handle                               */
  double vel[3], angvel[3];                   /* [m/s], [rad/s]                                       */
  double grip, grip_vel;                      /* opening [m or rad, as the model has it]              */
  double applied_force[3], applied_torque[3]; /* what the motors do now [N], [N m]                    */
  double temperature;                         /* hottest motor, 1 = its limit; below 0: unknown       */
  uint32_t buttons;                           /* bit i: button i pressed                              */
  uint32_t deadman;                           /* 1: a hand holds it                                   */
  uint32_t fault;                             /* HDEV_FAULT_*                                         */
  uint32_t force_enabled;                     /* 1: motors are powered                                */
  uint32_t cal;                               /* HDEV_CAL_*                                           */
  uint32_t reserved0;
} hdev_state;

/* What the motors shall do until the next command. */
typedef struct hdev_command {
  uint32_t size;
  uint32_t flags;    /* none yet: 0 */
  double force[3];   /* on the hand [N]   */
  double torque[3];  /* on the hand [N m] */
  double grip_force; /* [N]               */
} hdev_command;

/* What the host lends to a driver, from open() until close(). */
typedef struct hdev_host {
  uint32_t size;
  uint32_t reserved0;
  void* user; /* first argument of the functions below                */
  void (*log)(void* user, int level,
              const char* line); /* 0 info, 1 warn, 2 error; never from read() or write() */
  int64_t (*now_ns)(void* user); /* the time, which may be simulated; any thread          */
} hdev_host;

typedef struct hdev hdev; /* one open device; its content is the driver's secret */

/* The functions of a driver. None may be null; what a device lacks answers HDEV_E_UNSUPPORTED. */
typedef struct hdev_api {
  uint32_t size;
  uint32_t abi_major, abi_minor; /* that the driver was compiled with */
  uint32_t reserved0;
  const char* plugin_name;
  const char* plugin_version;

  /* From any thread but the real-time one. These may block and allocate. */

  /* Writes up to `cap` ids that open() understands; *n becomes how many there are. */
  hdev_status (*enumerate)(const hdev_host* host, char (*ids)[64], uint32_t cap, uint32_t* n);
  /* Opens a device, forces off. `id` "" is the first one. `kv` holds n_kv pairs: key, value, key, value, ...
     A key that the driver does not know is HDEV_E_ARG. On failure *out is null and last_error(NULL) says why. */
  hdev_status (*open)(const hdev_host* host, const char* id, const char* const* kv, uint32_t n_kv,
                      hdev** out);
  hdev_status (*get_info)(hdev* device, hdev_info* info);
  hdev_status (*calibrate)(hdev* device, uint32_t timeout_ms);
  /* Powers the motors on or off. Begins with no force. May run while the real-time thread reads and writes. */
  hdev_status (*enable_force)(hdev* device, uint32_t on);
  /* No force, motors off, everything released. `device` is gone afterwards; null is allowed. */
  void (*close)(hdev* device);
  /* The last trouble in words, "" if none: also why read() said HDEV_E_LOST or HDEV_E_FAULT. Null asks about the
     last open() that failed. */
  const char* (*last_error)(hdev* device);

  /* From the real-time thread only. No allocation, no lock, no system call but the device's own. */

  hdev_status (*rt_attach)(hdev* device); /* once, before the first read on that thread */
  /* Newest sample. timeout_us 0 never waits. */
  hdev_status (*read)(hdev* device, hdev_state* state, uint32_t timeout_us);
  /* The host has limited the force already; the driver limits it once more. */
  hdev_status (*write)(hdev* device, const hdev_command* command);
  /* Motors off, now. From any thread and from signal handlers. enable_force() powers them again. */
  hdev_status (*stop)(hdev* device);

  /* Since minor version 1; a table of version 0 ends before them, and both may be null. */

  /* The process is about to die: motors off, whatever state it is in. Called from a signal handler on any thread, which
     may be one of the driver's own or have crashed inside the vendor's library; perhaps on a stack of 64 KiB. Allocates
     nothing, takes no lock of its own; may sleep, for `within_us` at most. It may crash or hang in the vendor's library:
     the host goes on with the next device, and ends the process in time. Nothing but this is called afterwards.
     HDEV_OK: the motors are known to be off. Null: stop() does it. */
  hdev_status (*emergency_stop)(hdev* device, uint32_t within_us);
  /* In another process, after the one that had a device open has died with its motors on: opens it by the words that
     open() got, no force, motors off, releases it. May block. Called again after a failure, since it may take the system
     a while to take a device from the dead; last_error(NULL) says why. With HDEV_CAP_SHARED also while that process lives,
     but is stopped. Null: nothing can be done from outside. */
  hdev_status (*rescue)(const hdev_host* host, const char* id, const char* const* kv, uint32_t n_kv);

  /* Since minor version 2; may be null. */

  /* HDEV_OK: the motors are known to be off; HDEV_E_AGAIN: they are on, or nobody knows. From any thread, at once. Asked
     after stop(), until it is so; a person is told if it does not come. Null: stop() cannot fail. */
  hdev_status (*motors_off)(hdev* device);
} hdev_api;

/* The one exported symbol. Null if the driver cannot serve that host. */
#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
const hdev_api*
hdev_plugin_query(uint32_t host_major, uint32_t host_minor);
typedef const hdev_api* (*hdev_plugin_query_fn)(uint32_t host_major, uint32_t host_minor);

#ifdef __cplusplus
}
#endif
#endif
