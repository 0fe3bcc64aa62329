/* A navigation stack of your own, as a shared library.
 *
 * This header is all that a stack needs: C99 (and C++), no other file of Alula. Build a shared library that exports
 * the one function at the end of this file, and fly it: `alula run hover --stack ./libmystack.so`.
 * docs/examples/own_stack/ is a whole stack to begin with; C++ authors who would rather implement
 * alula::stack::NavigationStack include plugin_export.h.
 *
 * Frames. W world: x east, y north, z up. O odometry frame of the stack: z up, never jumps. M map frame: the mission's
 * world, may jump against O. B body: x forward, y left, z up. C camera: x right, y down, z along the optical axis.
 * I IMU. G gate: x along the direction of passage, z up, origin mid-opening. X_AB is the pose of frame B in frame A
 * (p_A = q_AB p_B + p_AB), v_AB the velocity of B's origin in A's axes. Hamilton quaternions, unit length. SI units,
 * radians, and integer nanoseconds since the start of the run.
 *
 * The rules. Alula calls one function of a stack at a time, from one thread; a stack may have threads of its own, as
 * long as its answers do not depend on them. A stack is deterministic: it reads no clock, and takes what is random from
 * the seed. Several stacks of one library may live in one process, so keep no state in globals.
 *
 * Whose memory. Whoever made it keeps it. What the set-up points to lives until `destroy`. What a measurement points to
 * (pixels) lives until the call returns: copy what you keep. What your output points to is yours, and must live until
 * the next call for that stack. Nobody frees what the other one made.
 *
 * Errors. Return ALULA_FAILED with a sentence in `error`: the run ends as a fault (stack_exception) that quotes it. Do
 * not let C++ exceptions out of a function: Alula catches them, but C does not promise it.
 */
#ifndef ALULA_STACK_INTERFACE_PLUGIN_H_
#define ALULA_STACK_INTERFACE_PLUGIN_H_

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Grows with every change that an old library would not survive. Alula refuses libraries of another version. */
#define ALULA_STACK_ABI_VERSION 2u

/* ---------------------------------------------------------------------------------------------- small things */

typedef struct AlulaVec3 {
  double x, y, z;
} AlulaVec3;

typedef struct AlulaQuat {
  double w, x, y, z;
} AlulaQuat;

/* X_AB: q turns vectors of B into A's axes, p is B's origin in A, m. */
typedef struct AlulaTransform {
  AlulaQuat q;
  AlulaVec3 p;
} AlulaTransform;

/* UTF-8. Texts that Alula hands over also end in a zero byte (not counted), so that printf can have them. */
typedef struct AlulaText {
  const char* bytes;
  uint64_t size;
} AlulaText;

/* What a function answers. */
enum {
  ALULA_OK = 0,
  ALULA_FAILED = 1,   /* the run ends as a fault */
  ALULA_BAD_INPUT = 2 /* of create: this vehicle, mission or parameter text cannot be flown; exit code 2 */
};

/* One sentence that ends in a zero byte; snprintf(error->text, sizeof error->text, …) fills it. */
typedef struct AlulaError {
  char text[1024];
} AlulaError;

/* ---------------------------------------------------------------------------------------------- what is known */

enum { ALULA_RADIAL_TANGENTIAL = 0, ALULA_EQUIDISTANT = 1 }; /* distortion models */
enum { ALULA_CAMERA_GREY = 0, ALULA_CAMERA_COLOUR = 1, ALULA_CAMERA_INFRARED = 2, ALULA_CAMERA_DEPTH = 3 }; /* kinds */

/* Pixel (u, v) covers [u - 1/2, u + 1/2] x [v - 1/2, v + 1/2]: integer coordinates are pixel centres. With the point
 * (x, y) = (p_x, p_y) / p_z in the camera frame: u = fx x_d + cx, v = fy y_d + cy, where
 *   radial-tangential k1 k2 p1 p2 k3 (OpenCV's order), r2 = x x + y y:
 *     x_d = x (1 + k1 r2 + k2 r2^2 + k3 r2^3) + 2 p1 x y + p2 (r2 + 2 x x), y_d likewise with p1 and p2 changed over;
 *   equidistant k1 k2 k3 k4 (OpenCV's fisheye), a = angle between ray and optical axis:
 *     |(x_d, y_d)| = a (1 + k1 a^2 + k2 a^4 + k3 a^6 + k4 a^8), in the direction of (p_x, p_y). */
typedef struct AlulaCameraCalibration {
  AlulaText name;        /* "vehicle0/camera.left" */
  AlulaTransform X_BC;   /* on a gimbal: with all its angles zero */
  double fx, fy, cx, cy; /* px */
  double distortion[5];  /* in the model's order; what it does not use is 0 */
  int64_t rate_cycles;   /* rate = rate_cycles / rate_seconds, Hz */
  int64_t rate_seconds;
  int64_t time_offset_ns; /* must be added to a `captured` stamp to get IMU time */
  int64_t row_delay_ns;   /* from one row's exposure to the next one's; 0: global shutter */
  int32_t width, height;  /* px */
  int32_t gimbal;         /* index into gimbals; -1: fixed to the body */
  uint32_t model;         /* ALULA_RADIAL_TANGENTIAL, … */
  uint32_t kind;          /* ALULA_CAMERA_GREY, … */
  uint16_t sensor;        /* stands in its measurements */
  uint16_t reserved;
} AlulaCameraCalibration;

/* A mount that turns cameras about one point: first yaw about the body's z, then pitch (positive: down), then roll. */
typedef struct AlulaGimbalCalibration {
  AlulaText name; /* "vehicle0/gimbal.0" */
  AlulaVec3 p_BG; /* the point that does not move, m */
  uint16_t sensor;
  uint16_t reserved[3];
} AlulaGimbalCalibration;

/* Noise as in Kalibr: continuous-time densities. */
typedef struct AlulaImuCalibration {
  AlulaText name;
  AlulaTransform X_BI;
  int64_t rate_cycles, rate_seconds;
  double gyro_noise;                 /* rad/s/sqrt(Hz) */
  double accelerometer_noise;        /* m/s^2/sqrt(Hz) */
  double gyro_bias_walk;             /* rad/s^2/sqrt(Hz) */
  double accelerometer_bias_walk;    /* m/s^3/sqrt(Hz) */
  double gyro_turn_on_bias;          /* 1 sigma, rad/s */
  double accelerometer_turn_on_bias; /* 1 sigma, m/s^2 */
  double gyro_range;                 /* saturation, rad/s */
  double accelerometer_range;        /* saturation, m/s^2 */
  uint16_t sensor;
  uint16_t reserved[3];
} AlulaImuCalibration;

typedef struct AlulaBarometerCalibration {
  AlulaText name;
  double noise; /* 1 sigma, Pa */
  uint16_t sensor;
  uint16_t reserved[3];
} AlulaBarometerCalibration;

/* Motion capture, satellites or the like: gives ALULA_POSITION_FIX. */
typedef struct AlulaPositionReferenceCalibration {
  AlulaText name;
  uint16_t sensor;
  uint16_t reserved[3];
} AlulaPositionReferenceCalibration;

/* Axes M: gives ALULA_MAG. */
typedef struct AlulaMagnetometerCalibration {
  AlulaText name;
  AlulaQuat q_BM; /* turns vectors of M into B's axes */
  int64_t rate_cycles, rate_seconds;
  double noise;  /* 1 sigma per axis, T */
  AlulaVec3 B_W; /* Earth's field here as a model of it says (WMM), T */
  uint16_t sensor;
  uint16_t reserved[3];
} AlulaMagnetometerCalibration;

/* What a stack is told about its vehicle. It is as wrong as a real calibration is. */
typedef struct AlulaCalibration {
  AlulaText vehicle; /* "vehicle0" */
  const AlulaCameraCalibration* cameras;
  uint64_t camera_count;
  const AlulaGimbalCalibration* gimbals;
  uint64_t gimbal_count;
  const AlulaImuCalibration* imu;                              /* NULL: it has none */
  const AlulaBarometerCalibration* barometer;                  /* NULL: it has none */
  const AlulaPositionReferenceCalibration* position_reference; /* NULL: it has none */
  const AlulaPositionReferenceCalibration* gnss;    /* a receiver of satellites: position alone; NULL: it has none */
  const AlulaMagnetometerCalibration* magnetometer; /* NULL: it has none */
  double hull_radius;          /* smallest sphere about the body origin that holds hull and propeller discs, m */
  AlulaVec3 hull_half_extents; /* of the hull's bounding box in the body frame, m */
  double standing_height;      /* of the body origin above the ground when standing, m */
  int32_t stereo_left;         /* indices into cameras; -1 where there is no stereo pair */
  int32_t stereo_right;
  uint16_t status_sensor;  /* ALULA_VEHICLE_STATUS */
  uint16_t battery_sensor; /* ALULA_BATTERY */
  uint32_t reserved;
} AlulaCalibration;

/* A gate where the mission thinks that it is. */
typedef struct AlulaGateHint {
  AlulaText name;
  AlulaTransform X_WG;
  double opening; /* side of the square opening, m */
} AlulaGateHint;

/* The task. Poses are in the world as surveyed, and wrong as surveys are. */
typedef struct AlulaMission {
  AlulaTransform X_WB_start;
  double start_position_sigma;  /* m */
  double start_yaw_sigma;       /* rad */
  double takeoff_column_radius; /* of the column above the pad that is declared free, m */
  const AlulaGateHint* gates;   /* in order of passage */
  uint64_t gate_count;
  double gate_position_error; /* bound on the error of a hint in the opening's plane, m */
  double gate_angle_error;    /* bound, rad */
  const AlulaVec3* waypoints; /* of the body origin, in order, m */
  uint64_t waypoint_count;
  AlulaVec3 target;      /* m */
  AlulaVec3 bounds_low;  /* the vehicle may not leave this box (world frame), m */
  AlulaVec3 bounds_high; /* m */
} AlulaMission;

/* What `create` is given. */
typedef struct AlulaSetup {
  const AlulaCalibration* calibration;
  const AlulaMission* mission;
  AlulaText parameters; /* the scenario's text `stack.parameters`, yours to read; empty where it gives none */
  uint64_t seed;        /* of the run */
  int32_t workers;      /* threads that you may use, at least 1; they must not change a result */
  uint32_t reserved;
} AlulaSetup;

/* ---------------------------------------------------------------------------------------------- measurements */

/* AlulaMeasurement::kind, and the member of `data` that holds it. */
enum {
  ALULA_IMU = 0,            /* imu */
  ALULA_IMAGE = 1,          /* image */
  ALULA_BARO = 2,           /* baro */
  ALULA_POSITION_FIX = 3,   /* position_fix */
  ALULA_BATTERY = 4,        /* battery */
  ALULA_VEHICLE_STATUS = 5, /* status */
  ALULA_DEPTH_IMAGE = 6,    /* depth_image */
  ALULA_GIMBAL_ANGLES = 7,  /* gimbal */
  ALULA_MAG = 8             /* mag */
};

/* In the IMU frame: angular velocity (rad/s) and specific force R_IW (a_WI - g_W) (m/s^2: at rest on level ground +9.81
 * along the upward axis). */
typedef struct AlulaImuSample {
  AlulaVec3 angular_velocity;
  AlulaVec3 specific_force;
} AlulaImuSample;

enum { ALULA_GREY8 = 0, ALULA_RGB8 = 1 }; /* pixel formats */

/* Rows from the top, `stride` bytes apart. */
typedef struct AlulaImage {
  const uint8_t* bytes; /* valid until `step` returns */
  uint64_t size;        /* stride * height */
  int64_t exposure_start_ns;
  int64_t exposure_ns;
  double gain;
  int32_t width, height; /* px */
  int32_t stride;        /* bytes */
  uint32_t format;       /* ALULA_GREY8, … */
} AlulaImage;

/* Planar depth (along the optical axis), rows from the top without gaps; 0 where it could not be measured. */
typedef struct AlulaDepthImage {
  const uint16_t* millimetres; /* [height x width], valid until `step` returns */
  uint64_t count;              /* width * height */
  int64_t exposure_start_ns;
  int64_t exposure_ns;
  int32_t width, height; /* px */
} AlulaDepthImage;

/* Where a gimbal's encoders say that it stands, rad. */
typedef struct AlulaGimbalAngles {
  double roll, pitch, yaw;
} AlulaGimbalAngles;

typedef struct AlulaBaroSample {
  double pressure; /* static, Pa */
} AlulaBaroSample;

/* Magnetic flux density, T, in the magnetometer's axes M. */
typedef struct AlulaMagSample {
  AlulaVec3 magnetic_field;
} AlulaMagSample;

/* Pose of the body in the world from an external reference. */
typedef struct AlulaPositionFix {
  AlulaTransform X_WB;
  double position_sigma; /* m, per axis */
  double attitude_sigma; /* rad, per axis */
} AlulaPositionFix;

typedef struct AlulaBatterySample {
  double voltage; /* V */
  double current; /* A */
} AlulaBatterySample;

enum { /* modes of the autopilot */
       ALULA_MODE_DISARMED = 0,
       ALULA_MODE_READY = 1,
       ALULA_MODE_FOLLOWING = 2,
       ALULA_MODE_HOLDING = 3,
       ALULA_MODE_LANDING = 4
};

/* What the autopilot reports of itself. */
typedef struct AlulaVehicleStatus {
  double thrust;         /* commanded collective thrust, share of the maximum in [0, 1] */
  uint32_t mode;         /* ALULA_MODE_DISARMED, … */
  uint32_t armed;        /* 0 or 1 */
  uint32_t ready_to_arm; /* 0 or 1: it has an estimate that it trusts */
  uint32_t landed;       /* 0 or 1: its own judgement, from its own sensors */
} AlulaVehicleStatus;

/* One measurement of one sensor. A stereo pair is two images with the same `seq`. */
typedef struct AlulaMeasurement {
  int64_t captured_ns;  /* the instant it describes, on the sensor's clock; of an image the middle of the exposure */
  int64_t available_ns; /* when it reaches the stack */
  uint32_t seq;
  uint32_t kind;   /* ALULA_IMU, … */
  uint16_t sensor; /* of the calibration */
  uint16_t reserved[3];
  union {
    AlulaImuSample imu;
    AlulaImage image;
    AlulaBaroSample baro;
    AlulaPositionFix position_fix;
    AlulaBatterySample battery;
    AlulaVehicleStatus status;
    AlulaDepthImage depth_image;
    AlulaGimbalAngles gimbal;
    AlulaMagSample mag;
  } data;
} AlulaMeasurement;

/* ---------------------------------------------------------------------------------------------- answers */

/* AlulaCommand::kind, and the member of `data` where it has one. */
enum {
  ALULA_ARM = 0,
  ALULA_DISARM = 1,
  ALULA_POSITION_SETPOINT = 2, /* position */
  ALULA_VELOCITY_SETPOINT = 3, /* velocity */
  ALULA_HOLD = 4,              /* stay where you are */
  ALULA_LAND = 5,              /* come down here, and disarm on the ground */
  ALULA_GIMBAL_SETPOINT = 6    /* gimbal */
};

/* A point of a trajectory in the odometry frame O, to be followed. */
typedef struct AlulaPositionSetpoint {
  AlulaVec3 p_OB;  /* m */
  AlulaVec3 v_OB;  /* m/s */
  AlulaVec3 a_OB;  /* m/s^2 */
  double yaw;      /* of the body's x axis, rad, 0 along O's x */
  double yaw_rate; /* rad/s */
} AlulaPositionSetpoint;

typedef struct AlulaVelocitySetpoint {
  AlulaVec3 v_OB;  /* m/s */
  double yaw;      /* rad */
  double yaw_rate; /* rad/s */
} AlulaVelocitySetpoint;

/* Angles against the body, or against horizon and heading where the gimbal is stabilised; it keeps the last ones. */
typedef struct AlulaGimbalSetpoint {
  double roll, pitch, yaw; /* rad */
  int32_t gimbal;          /* index into AlulaCalibration::gimbals */
  uint32_t reserved;
} AlulaGimbalSetpoint;

/* After `expires` the autopilot behaves as if the stack were silent: it holds, then lands. */
typedef struct AlulaCommand {
  int64_t issued_ns;
  int64_t expires_ns;
  uint32_t kind; /* ALULA_ARM, … */
  uint32_t reserved;
  union {
    AlulaPositionSetpoint position;
    AlulaVelocitySetpoint velocity;
    AlulaGimbalSetpoint gimbal;
  } data;
} AlulaCommand;

/* What the stack knows of the vehicle's motion. The autopilot flies on it, and the verdict's ate compares
 * X_MO X_OB at `stamp` with the truth. */
typedef struct AlulaEstimate {
  int64_t stamp_ns; /* the instant that it describes, in IMU time */
  AlulaTransform X_OB;
  AlulaVec3 v_OB;                /* m/s */
  AlulaVec3 w_B;                 /* angular velocity in the body frame, free of bias, rad/s */
  double pose_covariance[36];    /* [6x6] by rows, of (dp in O, dtheta in B): m^2, m rad, rad^2 */
  double velocity_covariance[9]; /* [3x3] by rows, in O, (m/s)^2 */
  AlulaTransform X_MO;           /* identity where O is the mission's frame */
  uint32_t reset_counter;        /* grows when X_OB was initialised again */
  uint32_t reserved;
} AlulaEstimate;

/* A discrete happening, for events.jsonl. */
typedef struct AlulaEvent {
  int64_t time_ns;
  AlulaText kind; /* a short snake_case word */
  AlulaText text; /* a sentence */
} AlulaEvent;

enum { /* states of a stack; a run ends some seconds after ALULA_DONE (once disarmed) or ALULA_STACK_FAILED */
       ALULA_INITIALISING = 0,
       ALULA_READY = 1,
       ALULA_FLYING = 2,
       ALULA_DONE = 3,
       ALULA_STACK_FAILED = 4
};

/* What one step answers. It comes filled with zeros: no commands, no estimate, no events, initialising. */
typedef struct AlulaOutput {
  const AlulaCommand* commands; /* at most ALULA_MOST_ITEMS */
  uint64_t command_count;
  const AlulaEvent* events; /* at most ALULA_MOST_ITEMS */
  uint64_t event_count;
  const AlulaEstimate* estimate; /* NULL: no new one */
  uint32_t state;                /* ALULA_INITIALISING, …; state it in every step */
  int32_t next_gate;             /* index into the mission's gates; for pictures and records */
} AlulaOutput;

/* A file that the stack leaves in the run folder: a map, a log. */
typedef struct AlulaFile {
  AlulaText name; /* plain, without slashes, not beginning with a dot */
  const uint8_t* bytes;
  uint64_t size;
} AlulaFile;

typedef struct AlulaFiles {
  const AlulaFile* files; /* at most ALULA_MOST_ITEMS */
  uint64_t count;
} AlulaFiles;

/* Wall time spent in one stage of the work, for timing.json; it never enters a digest. */
typedef struct AlulaStageTime {
  AlulaText name;
  double wall_ms; /* in total */
  uint64_t calls;
  double p99_ms; /* of a call, 99th percentile; 0 where calls are not told apart */
} AlulaStageTime;

typedef struct AlulaTiming {
  const AlulaStageTime* stages; /* at most ALULA_MOST_ITEMS */
  uint64_t count;
} AlulaTiming;

#define ALULA_MOST_ITEMS 65536u   /* of a list in one answer */
#define ALULA_LONGEST_TEXT 65536u /* bytes of one text */

/* ---------------------------------------------------------------------------------------------- the stack itself */

/* Sizes of the structs as the library was compiled: a second look behind the version. Fill it with ALULA_LAYOUT. */
typedef struct AlulaLayout {
  uint32_t plugin, setup, calibration, camera, gimbal, imu, barometer, position_reference, magnetometer, mission, gate;
  uint32_t measurement, output, command, estimate, event, file, stage_time, error, reserved;
} AlulaLayout;

/* What a library offers. `alula_stack_plugin` returns one that lives as long as the library. */
typedef struct AlulaStackPlugin {
  uint32_t abi_version; /* ALULA_STACK_ABI_VERSION; stays the first field for ever */
  uint32_t reserved;
  AlulaLayout layout; /* ALULA_LAYOUT */
  const char* name;   /* of the stack, for messages */

  /* Makes a stack and puts it into *self. */
  int32_t (*create)(const AlulaSetup* setup, void** self, AlulaError* error);

  /* Once per physics step (1 ms): all that has become available since the last one, by (available, sensor, seq). */
  int32_t (*step)(void* self, int64_t now_ns, const AlulaMeasurement* measurements, uint64_t count, AlulaOutput* output,
                  AlulaError* error);

  /* Once after the last step: what the stack leaves behind. NULL: it leaves nothing. */
  int32_t (*files)(void* self, AlulaFiles* files, AlulaError* error);

  /* Once after the last step. NULL: it measures nothing. */
  int32_t (*timing)(void* self, AlulaTiming* timing, AlulaError* error);

  /* The end of a stack that `create` made; it cannot fail. */
  void (*destroy)(void* self);
} AlulaStackPlugin;

#define ALULA_LAYOUT                                                                                                \
  {                                                                                                                 \
    sizeof(AlulaStackPlugin), sizeof(AlulaSetup), sizeof(AlulaCalibration), sizeof(AlulaCameraCalibration),         \
        sizeof(AlulaGimbalCalibration), sizeof(AlulaImuCalibration), sizeof(AlulaBarometerCalibration),             \
        sizeof(AlulaPositionReferenceCalibration), sizeof(AlulaMagnetometerCalibration), sizeof(AlulaMission),      \
        sizeof(AlulaGateHint), sizeof(AlulaMeasurement), sizeof(AlulaOutput), sizeof(AlulaCommand),                 \
        sizeof(AlulaEstimate), sizeof(AlulaEvent), sizeof(AlulaFile), sizeof(AlulaStageTime), sizeof(AlulaError), 0 \
  }

/* A text of yours that ends in a zero byte, as Alula wants it. */
static inline AlulaText alula_text(const char* text) {
  AlulaText t;
  t.bytes = text;
  t.size = strlen(text);
  return t;
}

static inline AlulaTransform alula_identity(void) {
  AlulaTransform X = {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  return X;
}

/* The one symbol that a library must export: ALULA_STACK_EXPORT const AlulaStackPlugin* alula_stack_plugin(void) { … }
 */
#if defined(__GNUC__)
#define ALULA_STACK_EXPORT __attribute__((visibility("default")))
#else
#define ALULA_STACK_EXPORT
#endif
ALULA_STACK_EXPORT const AlulaStackPlugin* alula_stack_plugin(void);

/* A second one that a library may export, or not: from now on the computer under this stack takes `factor` times as
 * long as the stack declares (1: as declared), because a scenario slows it. Stretch the latencies of what you begin
 * from here on and decide nothing by it; answer 1, or 0 where this stack declares none. A library without this symbol
 * is never slowed. events.jsonl says so either way. */
ALULA_STACK_EXPORT int32_t alula_stack_compute_factor(void* self, double factor);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* ALULA_STACK_INTERFACE_PLUGIN_H_ */
