/*
 * Plays a scene2hap session from C or C++, over the WebSocket of `scene2hap bridge`. Licence: MIT.
 *
 * Copy this one file into your project. It needs the C standard library and the system's sockets, and compiles as C99
 * and as C++17. In exactly one source file, before any other #include:
 *
 *   #define SCENE2HAP_CLIENT_IMPLEMENTATION
 *   #include "scene2hap_client.h"
 *
 * All other files include it without the #define. The protocol is described in docs/bridge-protocol.md of scene2hap.
 * Linux is tested. For Windows (Winsock; link ws2_32 and bcrypt) it was compiled by MinGW and tried under Wine, not on
 * Windows itself and not with Microsoft's compiler. macOS is untested.
 *
 * How a game uses it:
 *
 *   s2h_client *client = s2h_create(NULL);                 connects as soon as it is polled
 *   s2h_bake(client, &bake);                               once
 *   s2h_play(client, &play);                               the event S2H_PLAYING says that frames are taken now
 *   each frame of the game:
 *     while (s2h_poll(client, &event)) ...                 never waits
 *     s2h_set_pose, s2h_touch, s2h_lift, s2h_send_frame
 *     s2h_intensity, s2h_gain                              0 when the last gains are older than the watchdog
 *   s2h_leave(client); s2h_destroy(client);
 *
 * A lost connection is tried again, with waits that grow to 5 s. The session then goes on, or is baked and played anew
 * if the server has forgotten it. Errors arrive as events of the type S2H_ERROR, with text.
 *
 * Units are metres, seconds and hertz. Coordinates are right-handed, quaternions are (x, y, z, w). Text is UTF-8.
 * A client belongs to one thread. No function waits, except s2h_wait, and s2h_create for a host that is no IP address.
 */
#ifndef SCENE2HAP_CLIENT_H
#define SCENE2HAP_CLIENT_H

/* Sockets are hidden by -std=c99 otherwise. This has an effect only before the first system header. */
#if defined(SCENE2HAP_CLIENT_IMPLEMENTATION) && defined(__STRICT_ANSI__) && !defined(_POSIX_C_SOURCE) && \
    !defined(_GNU_SOURCE) && !defined(_DEFAULT_SOURCE) && !defined(__APPLE__) && !defined(_WIN32)
#define _POSIX_C_SOURCE 200809L
#endif

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct s2h_client s2h_client;

/* ------------------------------------------------------------------------------------------------------- client */

/* Settings of a client. Zeros and NULLs are defaults. */
typedef struct s2h_settings {
  const char *url;          /* "ws://127.0.0.1:7862/" */
  const char *token;        /* as the bridge was started with; sent in `hello` only */
  const char *name;         /* name and version of your game */
  size_t max_receive_bytes; /* of one message of the server: 8 MiB */
  size_t max_send_bytes;    /* of all requests that wait for the network: 40 MiB */
} s2h_settings;

/* Make a client. `settings` may be NULL. Returns NULL without memory. */
s2h_client *s2h_create(const s2h_settings *settings);

/* Close the connection and free the client. Send s2h_leave before, or the session waits `keep_s` for its player. */
void s2h_destroy(s2h_client *client);

/* Wait until the network has something for s2h_poll, at most so long. For tools and loading screens, not for games. */
void s2h_wait(s2h_client *client, double timeout_s);

/* ------------------------------------------------------------------------------------------------ reading of JSON */

/* A value of a JSON text. Functions below take a missing value (`at` is NULL) as well. */
typedef struct s2h_json {
  const char *at, *end;
} s2h_json;

/* The value of a text of n bytes. Missing if the text is no JSON (RFC 8259), or deeper than 64. */
s2h_json s2h_json_parse(const char *text, size_t n);

/* A field of an object. Missing if there is none, or `object` is none. */
s2h_json s2h_json_get(s2h_json object, const char *key);

/* Step through an array or object: begin with `cursor` missing. `key` may be NULL. Returns false at the end. */
bool s2h_json_next(s2h_json container, s2h_json *cursor, s2h_json *key, s2h_json *value);

/* Copy a string with a 0 behind it, cut between characters if it is too long. Returns false for no string. */
bool s2h_json_string(s2h_json value, char *out, size_t size);

/* A number, or `otherwise` for no number. */
double s2h_json_number(s2h_json value, double otherwise);

/* Whether a value is true. */
bool s2h_json_true(s2h_json value);

/* ------------------------------------------------------------------------------------------------ writing of JSON */

/* A JSON text that grows. Begin with S2H_WRITER. Commas are written where they belong. `key` is NULL in arrays. */
typedef struct s2h_writer {
  char *text;
  size_t n, capacity;
  bool has_failed; /* no memory, or a number that is not finite */
} s2h_writer;

#define S2H_WRITER \
  { NULL, 0, 0, false }

void s2h_write_begin(s2h_writer *writer, const char *key, char bracket); /* '{' or '[' */
void s2h_write_end(s2h_writer *writer, char bracket);                    /* '}' or ']' */
void s2h_write_string(s2h_writer *writer, const char *key, const char *text);
void s2h_write_number(s2h_writer *writer, const char *key, double number);
void s2h_write_numbers(s2h_writer *writer, const char *key, const double *numbers, size_t n);
void s2h_write_bool(s2h_writer *writer, const char *key, bool is_true);
void s2h_write_json(s2h_writer *writer, const char *key, const char *json); /* a value that is JSON already */

/* The text, NULL if something has failed. Free it by s2h_writer_free. */
const char *s2h_writer_text(s2h_writer *writer);
void s2h_writer_free(s2h_writer *writer);

/* Scene JSON: begin, one call for each object, end. `up_axis` is 'y' or 'z'. `rotation_xyzw` may be NULL for none. */
void s2h_scene_begin(s2h_writer *writer, const char *name, char up_axis);
void s2h_scene_end(s2h_writer *writer);
void s2h_scene_box(s2h_writer *writer, const char *id, const char *name, const double position_m[3],
                   const double rotation_xyzw[4], const double size_m[3]);
/* Vertices are in the frame of the pose, with all scale. Faces turn counter-clockwise seen from outside. */
void s2h_scene_mesh(s2h_writer *writer, const char *id, const char *name, const double position_m[3],
                    const double rotation_xyzw[4], const float *vertices_m, size_t n_vertices, const uint32_t *faces,
                    size_t n_faces);

/* ----------------------------------------------------------------------------------------------------- requests */

/* All requests return their number, which the answer carries as `request`, or 0 if they cannot be sent; then an event
 * S2H_ERROR says why. `more` are further fields of the protocol as a JSON object, NULL for none. */

/* A bake needs one of `scene` (scene JSON) and `path` (of a scene file below the server's root). */
typedef struct s2h_bake_settings {
  const char *scene;
  const char *path;
  const char *more; /* such as {"user_prompt": "a kitchen", "save": "kitchen.bundle"} */
} s2h_bake_settings;

/* Bake a scene. It is kept: the next connection follows the bake, or repeats it if the server has forgotten it. */
uint32_t s2h_bake(s2h_client *client, const s2h_bake_settings *bake);

/* One of `job` (of a bake) and `bundle` (path below the server's root); without both, the last bake once it ends. */
typedef struct s2h_play_settings {
  uint32_t job;
  const char *bundle;
  const char *const *moving; /* ids of the objects whose poses you send */
  size_t n_moving;
  bool moves_all;    /* send poses of all objects, in place of `moving` */
  bool every_frame;  /* every frame is answered; else newer frames may replace older ones */
  const char *more;  /* such as {"keep_s": 60, "session": {"propagation": "modal_plate"}} */
} s2h_play_settings;

/* Play a session. It is kept, and resumed or played again whenever the connection is lost. While one is played, call
 * s2h_leave first, as for another level. */
uint32_t s2h_play(s2h_client *client, const s2h_play_settings *play);

/* Get the gains of a session that another client plays, in place of one that was watched before. */
uint32_t s2h_watch(s2h_client *client, const char *session);

/* End the session; the event S2H_LEFT follows. */
uint32_t s2h_leave(s2h_client *client);

/* Send any request of the protocol, such as s2h_request(client, "explain", "{\"hand\": \"left\"}"). */
uint32_t s2h_request(s2h_client *client, const char *type, const char *more);

uint32_t s2h_set_source_on(s2h_client *client, const char *source, bool is_on);
uint32_t s2h_set_source_state(s2h_client *client, const char *source, const char *state);
uint32_t s2h_set_source_gain_db(s2h_client *client, const char *source, double gain_db);
uint32_t s2h_set_source_mute(s2h_client *client, const char *source, bool is_mute);
uint32_t s2h_set_user_gain_db(s2h_client *client, double gain_db);
uint32_t s2h_set_user_mute(s2h_client *client, bool is_mute);
/* `with_object` may be NULL. */
uint32_t s2h_strike(s2h_client *client, const char *object, const double point_m[3], double speed_m_s,
                    const char *with_object);
/* One entry of `objects` of scene JSON; s2h_scene_box and s2h_scene_mesh write it into an empty writer. */
uint32_t s2h_add(s2h_client *client, const char *object_json);
uint32_t s2h_remove(s2h_client *client, const char *object);
uint32_t s2h_set_moving(s2h_client *client, const char *const *moving, size_t n_moving);
uint32_t s2h_pause(s2h_client *client);
uint32_t s2h_unpause(s2h_client *client);
/* The event S2H_ANSWER has the explanation as `text`. */
uint32_t s2h_explain(s2h_client *client, const char *hand);

/* Send a PNG or JPEG for the next bake that has {"pictures": true}. `object` is NULL for kind "scene". */
bool s2h_send_picture(s2h_client *client, const char *object, const char *kind, const char *view, const void *file,
                      size_t n_bytes);

/* ------------------------------------------------------------------------------------------------------- frames */

/* An object, hand or source. Handles are found once and stay valid until s2h_destroy, whatever comes or goes. */
typedef int32_t s2h_handle;

/* The handle of an id, which need not exist on the server yet. Returns -1 without memory. */
s2h_handle s2h_handle_of(s2h_client *client, const char *id);

/* Whether frames are taken now. */
bool s2h_is_playing(const s2h_client *client);

/* Set where an object is from the next frame on. `rotation_xyzw` may be NULL for none. Returns false for a number that
 * is not finite; the pose stays. */
bool s2h_set_pose(s2h_client *client, s2h_handle object, const float position_m[3], const float rotation_xyzw[4]);

/* Lay a hand on an object from the next frame on, at a point in the world. Returns false as s2h_set_pose. */
bool s2h_touch(s2h_client *client, s2h_handle hand, s2h_handle object, const float point_m[3]);

/* Lift a hand. */
void s2h_lift(s2h_client *client, s2h_handle hand);

/* Send all poses and touches as they are now; call it once for each frame of the game. A `time_s` that goes back
 * begins a new clock, as when a level is loaded. Returns the frame's sequence, or 0 if it was not sent: there is no
 * session now, or the network is slower than the game. Nothing is lost then, since the next frame has the newest of
 * everything. */
uint32_t s2h_send_frame(s2h_client *client, double time_s);

/* Sequence of the last frame; after S2H_PLAYING, of the last frame that the server has taken. */
uint32_t s2h_sequence(const s2h_client *client);

/* -------------------------------------------------------------------------------------------------------- gains */

/* Gains as the server sent them. `gains` is [hand][source][band]. */
typedef struct s2h_gains {
  uint16_t layout;
  uint32_t sequence;  /* of the frame which they answer */
  uint32_t n_skipped; /* frames that the server has skipped */
  double time_s;
  uint16_t n_hands, n_sources, n_bands;
  bool is_paused, is_preparing; /* preparing: a newer propagation field is computed */
  const float *intensities;
  const float *gains;
} s2h_gains;

/* Whether gains came within the session's watchdog. Otherwise all gains and intensities are 0. */
bool s2h_is_felt(const s2h_client *client);

/* Amplitude for an actuator that knows no more than an amplitude, 0 to 1. */
float s2h_intensity(const s2h_client *client, s2h_handle hand);

/* Gain of a source at a hand, of its loudest band. */
float s2h_gain(const s2h_client *client, s2h_handle hand, s2h_handle source);

/* The last gains whatever their age, NULL before the first. */
const s2h_gains *s2h_last_gains(const s2h_client *client);

/* A source of the session. */
typedef struct s2h_source {
  const char *id, *state;
  bool is_on;
  double frequency_hz;
} s2h_source;

/* Objects, hands and sources of the session as the server orders them; NULL behind the last. Valid until s2h_poll. */
const char *s2h_object_id(const s2h_client *client, size_t index);
const char *s2h_hand_id(const s2h_client *client, size_t index);
const s2h_source *s2h_source_at(const s2h_client *client, size_t index);

/* ------------------------------------------------------------------------------------------------------- events */

typedef enum s2h_event_type {
  S2H_NOTHING,
  S2H_ONLINE,   /* `welcome` came */
  S2H_OFFLINE,  /* no connection: `text`, `code`, `wait_s` */
  S2H_ERROR,    /* `error`, `text`, `request`, `job` */
  S2H_WARNING,  /* `text` */
  S2H_BAKING,   /* `job` */
  S2H_PROGRESS, /* `job`, `text`; `message` has `done` and `of` */
  S2H_BAKED,    /* `job`; `message` has `objects` */
  S2H_PLAYING,  /* `is_resumed`; also for `watching` */
  S2H_ORDER,    /* objects or sources came or went */
  S2H_GAINS,    /* `gains` */
  S2H_IMPACT,   /* `message` has `object`, `felt`, ... */
  S2H_STATE,    /* to those who watch: `text` is "playing", "waiting" or "ended" */
  S2H_ANSWER,   /* to `request`; `message` has the fields */
  S2H_LEFT      /* the session has ended */
} s2h_event_type;

/* Texts are never NULL, and valid until the next s2h_poll. */
typedef struct s2h_event {
  s2h_event_type type;
  uint32_t request;       /* the number that the request returned, 0 for none */
  uint32_t job;           /* 0 for none */
  const char *error;      /* kind of an error, such as "UnknownObject" */
  const char *text;       /* for people to read */
  s2h_json message;       /* the whole message, missing for events of this side */
  const s2h_gains *gains; /* of S2H_GAINS, else NULL */
  bool is_resumed;        /* false: objects, states and levels are those of the bake again */
  int code;               /* of a close frame, 0 for none */
  double wait_s;          /* until the next attempt to connect; below 0 if there will be none */
} s2h_event;

/* Receive and send what the network takes now. Returns true with an event, false when there is no more for now.
 * Call it in a loop in each frame of the game. A server that sends without end cannot keep the loop from ending. */
bool s2h_poll(s2h_client *client, s2h_event *event);

/* ---------------------------------------------------------------------------------------------- binary messages */

/* The client uses these itself; they are here for tests, and for frames by UDP. */

typedef struct s2h_touch_row {
  uint32_t hand, object; /* indices */
  float point_m[3];
} s2h_touch_row;

/* Bytes of a frame. */
size_t s2h_frame_bytes(size_t n_poses, size_t n_touches);

/* Encode a frame into s2h_frame_bytes bytes. `poses` has 7 numbers for each. */
void s2h_encode_frame(uint8_t *out, uint16_t layout, const uint8_t key[8], uint32_t sequence, double time_s,
                      const float *poses, size_t n_poses, const s2h_touch_row *touches, size_t n_touches);

/* Decode gains. `values` takes the intensities and gains: n / 4 numbers suffice. Returns false for other bytes, a wrong
 * length, or a number that is not finite. */
bool s2h_decode_gains(const uint8_t *data, size_t n, s2h_gains *gains, float *values, size_t n_values);

#ifdef __cplusplus
}
#endif
#endif /* SCENE2HAP_CLIENT_H */

/* =============================================================================================================== */
/*                                                 Implementation                                                  */
/* =============================================================================================================== */

#if defined(SCENE2HAP_CLIENT_IMPLEMENTATION) && !defined(SCENE2HAP_CLIENT_IMPLEMENTED)
#define SCENE2HAP_CLIENT_IMPLEMENTED

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <winsock2.h>
#include <ws2tcpip.h>
#include <windows.h>
#include <bcrypt.h>
#ifdef _MSC_VER
#pragma comment(lib, "ws2_32.lib")
#pragma comment(lib, "bcrypt.lib")
#endif
#else
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>
#endif

/* An engine may put its own allocator here. */
#ifndef S2H_REALLOC
#define S2H_REALLOC realloc
#define S2H_FREE free
#endif

/* Bytes of each of the two buffers of the network, at least 16384. Long messages go in pieces of that size, so that
 * pings are answered between them. */
#ifndef S2H_BUFFER_BYTES
#define S2H_BUFFER_BYTES 65536
#endif

#ifdef __GNUC__
#define S2H__PRINTF(at, first) __attribute__((format(printf, at, first)))
#else
#define S2H__PRINTF(at, first)
#endif

#define S2H__MAX_HELLO_BYTES 4096
#define S2H__MAX_HEAD_BYTES 8192  /* of the answer to the WebSocket handshake */
#define S2H__FLUSH_BYTES 1048576  /* at most so much is sent, or received, in one frame of the game */
#define S2H__MAX_EVENTS 1000      /* in one frame of the game */
#define S2H__MAX_DEPTH 64
#define S2H__MAX_PENDING 64
#define S2H__MAX_TOUCHES 64
#define S2H__MAX_HANDLES (1 << 20)
#define S2H__N_LAYOUTS 8 /* as many as the server reads */
#define S2H__FIRST_WAIT_S 0.25
#define S2H__LONGEST_WAIT_S 5.0
#define S2H__STEADY_S 5.0 /* a connection that lasted so long starts the waits anew */
#define S2H__CONNECT_S 5.0
#define S2H__GREETING_S 10.0
#define S2H__SILENT_HEARTBEATS 5.0
#define S2H__LONG_AGO_S (-1e300)

/* ------------------------------------------------------------------------------------------------------- system */

#ifdef _WIN32
typedef SOCKET s2h__socket;
#define S2H__NO_SOCKET INVALID_SOCKET
#else
typedef int s2h__socket;
#define S2H__NO_SOCKET (-1)
#endif

/* Tests put their own clock and network here. */
#ifndef S2H_NOW_S
#define S2H_NOW_S s2h__now_s
static double s2h__now_s(void) {
#ifdef _WIN32
  LARGE_INTEGER ticks, per_s;
  QueryPerformanceCounter(&ticks);
  QueryPerformanceFrequency(&per_s);
  return (double)ticks.QuadPart / (double)per_s.QuadPart;
#else
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
#endif
}
#endif

#ifndef S2H_RECV
#ifdef _WIN32
#define S2H_RECV(socket, data, n) ((long)recv(socket, (char *)(data), (int)(n), 0))
#define S2H_SEND(socket, data, n) ((long)send(socket, (const char *)(data), (int)(n), 0))
#else
#ifndef MSG_NOSIGNAL
#define MSG_NOSIGNAL 0 /* macOS has SO_NOSIGPIPE instead */
#endif
#define S2H_RECV(socket, data, n) ((long)recv(socket, data, n, 0))
#define S2H_SEND(socket, data, n) ((long)send(socket, data, n, MSG_NOSIGNAL))
#endif
#endif

static int s2h__socket_error(void) {
#ifdef _WIN32
  return WSAGetLastError();
#else
  return errno;
#endif
}

/* Whether an operation is to be tried again later. */
static bool s2h__would_block(int error) {
#ifdef _WIN32
  return error == WSAEWOULDBLOCK || error == WSAEINPROGRESS;
#else
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR || error == EINPROGRESS;
#endif
}

static void s2h__close_socket(s2h__socket socket_) {
#ifdef _WIN32
  closesocket(socket_);
#else
  close(socket_);
#endif
}

static bool s2h__set_options(s2h__socket socket_) {
  int one = 1;
#ifdef _WIN32
  u_long is_on = 1;
  if (ioctlsocket(socket_, (long)FIONBIO, &is_on) != 0) return false;
#else
  int flags = fcntl(socket_, F_GETFL, 0);
  if (flags < 0 || fcntl(socket_, F_SETFL, flags | O_NONBLOCK) < 0) return false;
  (void)fcntl(socket_, F_SETFD, FD_CLOEXEC);
#ifdef SO_NOSIGPIPE
  (void)setsockopt(socket_, SOL_SOCKET, SO_NOSIGPIPE, (const char *)&one, sizeof one);
#endif
#endif
  /* A frame must not wait for the acknowledgement of the one before. */
  (void)setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, (const char *)&one, sizeof one);
  return true;
}

/* Wait until a socket can be read, or written. Returns whether it can. */
static bool s2h__wait_socket(s2h__socket socket_, bool reads, bool writes, double timeout_s) {
#ifdef _WIN32
  fd_set read_set, write_set, error_set;
  struct timeval timeout;
  FD_ZERO(&read_set);
  FD_ZERO(&write_set);
  FD_ZERO(&error_set);
  if (reads) FD_SET(socket_, &read_set);
  if (writes) FD_SET(socket_, &write_set);
  FD_SET(socket_, &error_set);
  timeout.tv_sec = (long)timeout_s;
  timeout.tv_usec = (long)((timeout_s - (double)timeout.tv_sec) * 1e6);
  return select(0, &read_set, &write_set, &error_set, &timeout) != 0;
#else
  struct pollfd one;
  one.fd = socket_;
  one.events = (short)((reads ? POLLIN : 0) | (writes ? POLLOUT : 0));
  one.revents = 0;
  return poll(&one, 1, (int)(timeout_s * 1000.0 + 0.999)) != 0;
#endif
}

static void s2h__sleep(double time_s) {
#ifdef _WIN32
  Sleep((DWORD)(time_s * 1000.0));
#else
  (void)poll(NULL, 0, (int)(time_s * 1000.0));
#endif
}

/* Bytes that nobody can foresee, as RFC 6455 demands for masks. */
static bool s2h__random(uint8_t *out, size_t n) {
#ifdef _WIN32
  return BCryptGenRandom(NULL, out, (ULONG)n, BCRYPT_USE_SYSTEM_PREFERRED_RNG) == 0;
#else
  int file = open("/dev/urandom", O_RDONLY | O_CLOEXEC);
  size_t n_read = 0;
  if (file < 0) return false;
  while (n_read < n) {
    ssize_t got = read(file, out + n_read, n - n_read);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    n_read += (size_t)got;
  }
  close(file);
  return n_read == n;
#endif
}

/* A block of at least `needed` items, in place of `block`, which stays valid if the result is NULL: no memory. */
static void *s2h__grown(void *block, size_t *capacity, size_t needed, size_t item_bytes) {
  size_t n = *capacity ? *capacity : 16;
  void *found;
  if (block != NULL && needed <= *capacity) return block;
  while (n < needed) {
    if (n > SIZE_MAX / 2) return NULL;
    n *= 2;
  }
  if (n > SIZE_MAX / item_bytes) return NULL;
  found = S2H_REALLOC(block, n * item_bytes);
  if (found != NULL) *capacity = n;
  return found;
}

static char *s2h__copy_of(const char *text) {
  size_t n = strlen(text) + 1;
  char *found = (char *)S2H_REALLOC(NULL, n);
  if (found != NULL) memcpy(found, text, n);
  return found;
}

/* -------------------------------------------------------------------------------------------------------- bytes */

static void s2h__put_u16(uint8_t *out, uint16_t value) {
  out[0] = (uint8_t)(value & 0xFF);
  out[1] = (uint8_t)(value >> 8);
}

static void s2h__put_u32(uint8_t *out, uint32_t value) {
  int i;
  for (i = 0; i < 4; ++i) out[i] = (uint8_t)(value >> (8 * i) & 0xFF);
}

static void s2h__put_f32(uint8_t *out, float value) {
  uint32_t bits;
  memcpy(&bits, &value, 4);
  s2h__put_u32(out, bits);
}

static void s2h__put_f64(uint8_t *out, double value) {
  uint64_t bits;
  memcpy(&bits, &value, 8);
  s2h__put_u32(out, (uint32_t)(bits & 0xFFFFFFFFu));
  s2h__put_u32(out + 4, (uint32_t)(bits >> 32));
}

static uint16_t s2h__get_u16(const uint8_t *in) { return (uint16_t)(in[0] | in[1] << 8); }

static uint32_t s2h__get_u32(const uint8_t *in) {
  return (uint32_t)in[0] | (uint32_t)in[1] << 8 | (uint32_t)in[2] << 16 | (uint32_t)in[3] << 24;
}

static float s2h__get_f32(const uint8_t *in) {
  uint32_t bits = s2h__get_u32(in);
  float value;
  memcpy(&value, &bits, 4);
  return value;
}

static double s2h__get_f64(const uint8_t *in) {
  uint64_t bits = (uint64_t)s2h__get_u32(in) | (uint64_t)s2h__get_u32(in + 4) << 32;
  double value;
  memcpy(&value, &bits, 8);
  return value;
}

/* By their bits, since compilers with -ffast-math drop comparisons with NaN. */
static bool s2h__is_finite(double value) {
  uint64_t bits;
  memcpy(&bits, &value, 8);
  return (bits >> 52 & 0x7FF) != 0x7FF;
}

static bool s2h__is_finite_f32(float value) {
  uint32_t bits;
  memcpy(&bits, &value, 4);
  return (bits >> 23 & 0xFF) != 0xFF;
}

static bool s2h__are_finite(const float *values, size_t n) {
  size_t i;
  for (i = 0; i < n; ++i) {
    if (!s2h__is_finite_f32(values[i])) return false;
  }
  return true;
}

/* Bytes of the UTF-8 character at `text` (RFC 3629), 0 if it is none. */
static size_t s2h__utf8(const char *text, size_t n) {
  const unsigned char *p = (const unsigned char *)text;
  size_t length, i;
  if (n == 0) return 0;
  if (p[0] < 0x80) return 1;
  length = p[0] >= 0xC2 && p[0] < 0xE0 ? 2 : p[0] >= 0xE0 && p[0] < 0xF0 ? 3 : p[0] >= 0xF0 && p[0] < 0xF5 ? 4 : 0;
  if (length == 0 || length > n) return 0;
  for (i = 1; i < length; ++i) {
    if ((p[i] & 0xC0) != 0x80) return 0;
  }
  /* Overlong, surrogates, above U+10FFFF. */
  if ((p[0] == 0xE0 && p[1] < 0xA0) || (p[0] == 0xED && p[1] > 0x9F)) return 0;
  if ((p[0] == 0xF0 && p[1] < 0x90) || (p[0] == 0xF4 && p[1] > 0x8F)) return 0;
  return length;
}

static bool s2h__is_utf8(const char *text, size_t n) {
  size_t at = 0;
  while (at < n) {
    size_t length = s2h__utf8(text + at, n - at);
    if (length == 0) return false;
    at += length;
  }
  return true;
}

static size_t s2h__write_utf8(uint32_t code, char out[4]) {
  if (code < 0x80) {
    out[0] = (char)code;
    return 1;
  }
  if (code < 0x800) {
    out[0] = (char)(0xC0 | code >> 6);
    out[1] = (char)(0x80 | (code & 0x3F));
    return 2;
  }
  if (code < 0x10000) {
    out[0] = (char)(0xE0 | code >> 12);
    out[1] = (char)(0x80 | (code >> 6 & 0x3F));
    out[2] = (char)(0x80 | (code & 0x3F));
    return 3;
  }
  out[0] = (char)(0xF0 | code >> 18);
  out[1] = (char)(0x80 | (code >> 12 & 0x3F));
  out[2] = (char)(0x80 | (code >> 6 & 0x3F));
  out[3] = (char)(0x80 | (code & 0x3F));
  return 4;
}

/* ------------------------------------------------------------------------------------------------ reading of JSON */

static const char *s2h__skip_space(const char *p, const char *end) {
  while (p < end && (*p == ' ' || *p == '\t' || *p == '\n' || *p == '\r')) ++p;
  return p;
}

static int s2h__hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/* The code of four hexadecimal digits, -1 if they are none. */
static int32_t s2h__hex4(const char *p, const char *end) {
  int32_t code = 0;
  int i;
  if (end - p < 4) return -1;
  for (i = 0; i < 4; ++i) {
    int digit = s2h__hex_digit(p[i]);
    if (digit < 0) return -1;
    code = code * 16 + digit;
  }
  return code;
}

/* Behind the string at p, NULL if it is none. */
static const char *s2h__skip_string(const char *p, const char *end) {
  if (p == end || *p != '"') return NULL;
  ++p;
  while (p < end) {
    if (*p == '"') return p + 1;
    if (*p == '\\') {
      ++p;
      if (p == end) return NULL;
      if (*p == 'u') {
        if (s2h__hex4(p + 1, end) < 0) return NULL;
        p += 5;
      } else {
        if (*p == '\0' || strchr("\"\\/bfnrt", *p) == NULL) return NULL;
        ++p;
      }
    } else {
      size_t length = s2h__utf8(p, (size_t)(end - p));
      if (length == 0 || (unsigned char)*p < 0x20) return NULL;
      p += length;
    }
  }
  return NULL;
}

static const char *s2h__skip_digits(const char *p, const char *end) {
  while (p < end && *p >= '0' && *p <= '9') ++p;
  return p;
}

static const char *s2h__skip_number(const char *p, const char *end) {
  const char *begin;
  if (p < end && *p == '-') ++p;
  begin = p;
  p = s2h__skip_digits(p, end);
  if (p == begin || (*begin == '0' && p - begin > 1)) return NULL;
  if (p < end && *p == '.') {
    begin = ++p;
    p = s2h__skip_digits(p, end);
    if (p == begin) return NULL;
  }
  if (p < end && (*p == 'e' || *p == 'E')) {
    ++p;
    if (p < end && (*p == '+' || *p == '-')) ++p;
    begin = p;
    p = s2h__skip_digits(p, end);
    if (p == begin) return NULL;
  }
  return p;
}

static const char *s2h__skip_word(const char *p, const char *end, const char *word) {
  size_t n = strlen(word);
  return (size_t)(end - p) >= n && memcmp(p, word, n) == 0 ? p + n : NULL;
}

/* Behind the key at p and its colon, NULL if there are none. */
static const char *s2h__skip_key(const char *p, const char *end) {
  p = s2h__skip_string(s2h__skip_space(p, end), end);
  if (p == NULL) return NULL;
  p = s2h__skip_space(p, end);
  return p < end && *p == ':' ? p + 1 : NULL;
}

/* Behind the value at p, NULL if it is no JSON. Checks everything, without recursion. */
static const char *s2h__skip_value(const char *p, const char *end) {
  char open[S2H__MAX_DEPTH]; /* '{' and '['; the closing brackets are two above them in ASCII */
  int depth = 0;
  for (;;) {
    p = s2h__skip_space(p, end);
    if (p == end) return NULL;
    if (*p == '{' || *p == '[') {
      if (depth == S2H__MAX_DEPTH) return NULL;
      open[depth++] = *p;
      p = s2h__skip_space(p + 1, end);
      if (p == end || *p != open[depth - 1] + 2) {
        if (open[depth - 1] == '{') p = s2h__skip_key(p, end);
        if (p == NULL) return NULL;
        continue;
      }
      ++p;
      --depth;
    } else {
      if (*p == '"') p = s2h__skip_string(p, end);
      else if (*p == 't') p = s2h__skip_word(p, end, "true");
      else if (*p == 'f') p = s2h__skip_word(p, end, "false");
      else if (*p == 'n') p = s2h__skip_word(p, end, "null");
      else p = s2h__skip_number(p, end);
      if (p == NULL) return NULL;
    }
    for (;;) {
      if (depth == 0) return p;
      p = s2h__skip_space(p, end);
      if (p == end) return NULL;
      if (*p == ',') {
        ++p;
        if (open[depth - 1] == '{') p = s2h__skip_key(p, end);
        if (p == NULL) return NULL;
        break;
      }
      if (*p != open[depth - 1] + 2) return NULL;
      ++p;
      --depth;
    }
  }
}

static s2h_json s2h__no_json(void) {
  s2h_json none;
  none.at = none.end = NULL;
  return none;
}

s2h_json s2h_json_parse(const char *text, size_t n) {
  s2h_json found;
  const char *behind;
  found.end = text + n;
  found.at = s2h__skip_space(text, found.end);
  behind = s2h__skip_value(found.at, found.end);
  return behind != NULL && s2h__skip_space(behind, found.end) == found.end ? found : s2h__no_json();
}

static char s2h__kind(s2h_json value) { return value.at != NULL && value.at < value.end ? *value.at : '\0'; }

bool s2h_json_next(s2h_json container, s2h_json *cursor, s2h_json *key, s2h_json *value) {
  char kind = s2h__kind(container);
  const char *p, *end = container.end;
  if (kind != '{' && kind != '[') return false;
  if (cursor->at == NULL) {
    p = s2h__skip_space(container.at + 1, end);
    if (p == end || *p == kind + 2) return false;
  } else {
    p = s2h__skip_space(cursor->at, end);
    if (p == end || *p != ',') return false;
    p = s2h__skip_space(p + 1, end);
  }
  value->end = end;
  if (kind == '{') {
    const char *behind = s2h__skip_key(p, end);
    if (behind == NULL) return false;
    if (key != NULL) {
      key->at = p;
      key->end = end;
    }
    p = s2h__skip_space(behind, end);
  } else if (key != NULL) {
    *key = s2h__no_json();
  }
  value->at = p;
  cursor->at = s2h__skip_value(p, end);
  cursor->end = end;
  return cursor->at != NULL;
}

/* Take the next character of a string as UTF-8. Returns its bytes, 0 at the end. `*p` is behind the opening quote. */
static size_t s2h__next_character(const char **p, const char *end, char out[4]) {
  static const char escapes[] = "\"\\/bfnrt", meant[] = "\"\\/\b\f\n\r\t";
  const char *at = *p, *found;
  size_t length;
  int32_t code, low;
  if (at >= end || *at == '"') return 0;
  if (*at != '\\') {
    length = s2h__utf8(at, (size_t)(end - at));
    if (length == 0) return 0;
    memcpy(out, at, length);
    *p = at + length;
    return length;
  }
  if (end - at < 2) return 0;
  if (at[1] != 'u') {
    found = at[1] == '\0' ? NULL : strchr(escapes, at[1]);
    if (found == NULL) return 0;
    out[0] = meant[found - escapes];
    *p = at + 2;
    return 1;
  }
  code = s2h__hex4(at + 2, end);
  if (code < 0) return 0;
  at += 6;
  if (code >= 0xD800 && code < 0xDC00 && end - at >= 6 && at[0] == '\\' && at[1] == 'u') {
    low = s2h__hex4(at + 2, end);
    if (low >= 0xDC00 && low < 0xE000) {
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
      at += 6;
    }
  }
  /* A 0 would cut the text, and half a surrogate pair is no character. */
  if (code == 0 || (code >= 0xD800 && code < 0xE000)) code = 0xFFFD;
  *p = at;
  return s2h__write_utf8((uint32_t)code, out);
}

bool s2h_json_string(s2h_json value, char *out, size_t size) {
  size_t n = 0, length;
  char character[4];
  const char *p;
  if (size == 0) return false;
  out[0] = '\0';
  if (s2h__kind(value) != '"') return false;
  p = value.at + 1;
  while ((length = s2h__next_character(&p, value.end, character)) != 0 && n + length < size) {
    memcpy(out + n, character, length);
    n += length;
  }
  out[n] = '\0';
  return true;
}

static bool s2h__is_text(s2h_json value, const char *text) {
  size_t length;
  char character[4];
  const char *p;
  if (s2h__kind(value) != '"') return false;
  p = value.at + 1;
  while ((length = s2h__next_character(&p, value.end, character)) != 0) {
    if (strncmp(text, character, length) != 0) return false;
    text += length;
  }
  return *text == '\0';
}

s2h_json s2h_json_get(s2h_json object, const char *key) {
  s2h_json cursor = s2h__no_json(), name, value;
  if (s2h__kind(object) != '{') return s2h__no_json();
  while (s2h_json_next(object, &cursor, &name, &value)) {
    if (s2h__is_text(name, key)) return value;
  }
  return s2h__no_json();
}

/* Without strtod, which reads "0,5" in some locales. Exact up to 15 digits, else to some units of the last place. */
double s2h_json_number(s2h_json value, double otherwise) {
  const char *p = value.at, *end;
  uint64_t digits = 0;
  int exponent = 0, given = 0;
  bool is_negative, is_fraction = false, falls = false;
  double result;
  if (p == NULL || p >= value.end || (*p != '-' && (*p < '0' || *p > '9'))) return otherwise;
  end = s2h__skip_number(p, value.end);
  if (end == NULL) return otherwise;
  is_negative = *p == '-';
  if (is_negative) ++p;
  for (; p < end && *p != 'e' && *p != 'E'; ++p) {
    if (*p == '.') {
      is_fraction = true;
      continue;
    }
    if (digits < UINT64_MAX / 10 - 1) {
      digits = digits * 10 + (uint64_t)(*p - '0');
      if (is_fraction) --exponent;
    } else if (!is_fraction && exponent < 10000) {
      ++exponent;
    }
    if (exponent < -10000) exponent = -10000;
  }
  if (p < end) {
    ++p;
    if (*p == '-' || *p == '+') falls = *p++ == '-';
    for (; p < end; ++p) {
      if (given < 10000) given = given * 10 + (*p - '0');
    }
    exponent += falls ? -given : given;
  }
  result = (double)digits;
  if (exponent > 400) exponent = 400;
  if (exponent < -400) exponent = -400;
  for (; exponent > 22 && result > 0.0; exponent -= 22) result *= 1e22;
  for (; exponent < -22 && result > 0.0; exponent += 22) result /= 1e22;
  {
    double power = 1.0;
    int n = exponent < 0 ? -exponent : exponent;
    for (; n > 0 && n <= 22; --n) power *= 10.0; /* exact up to 1e22 */
    result = exponent < 0 ? result / power : result * power;
  }
  if (!s2h__is_finite(result)) return otherwise;
  return is_negative ? -result : result;
}

bool s2h_json_true(s2h_json value) { return s2h__kind(value) == 't'; }

/* A whole number from 0 to `most`, or `otherwise`. */
static uint32_t s2h__json_uint(s2h_json value, uint32_t most, uint32_t otherwise) {
  double number = s2h_json_number(value, -1.0);
  uint32_t whole;
  if (!(number >= 0.0 && number <= (double)most)) return otherwise;
  whole = (uint32_t)number;
  return (double)whole == number ? whole : otherwise;
}

/* ------------------------------------------------------------------------------------------------ writing of JSON */

static void s2h__write(s2h_writer *writer, const char *text, size_t n) {
  char *grown;
  if (writer->has_failed) return;
  if (n > SIZE_MAX - writer->n - 1) {
    writer->has_failed = true;
    return;
  }
  grown = (char *)s2h__grown(writer->text, &writer->capacity, writer->n + n + 1, 1);
  if (grown == NULL) {
    writer->has_failed = true;
    return;
  }
  writer->text = grown;
  memcpy(grown + writer->n, text, n);
  writer->n += n;
  grown[writer->n] = '\0';
}

static void s2h__write_text(s2h_writer *writer, const char *text) { s2h__write(writer, text, strlen(text)); }

static void s2h__write_quoted(s2h_writer *writer, const char *text) {
  size_t left = strlen(text);
  const char *begin = text;
  s2h__write(writer, "\"", 1);
  while (left > 0) {
    unsigned char c = (unsigned char)*text;
    size_t length = s2h__utf8(text, left);
    if (length == 0 || c < 0x20 || c == '"' || c == '\\') {
      char escape[8];
      if (length == 0) (void)snprintf(escape, sizeof escape, "\\ufffd");
      else if (c < 0x20) (void)snprintf(escape, sizeof escape, "\\u%04x", (unsigned)c);
      else (void)snprintf(escape, sizeof escape, "\\%c", *text);
      s2h__write(writer, begin, (size_t)(text - begin));
      s2h__write_text(writer, escape);
      length = 1;
      begin = text + 1;
    }
    text += length;
    left -= length;
  }
  s2h__write(writer, begin, (size_t)(text - begin));
  s2h__write(writer, "\"", 1);
}

/* A comma where one belongs, and the key. */
static void s2h__write_key(s2h_writer *writer, const char *key) {
  if (!writer->has_failed && writer->n > 0 && strchr("{[:", writer->text[writer->n - 1]) == NULL) {
    s2h__write(writer, ",", 1);
  }
  if (key == NULL) return;
  s2h__write_quoted(writer, key);
  s2h__write(writer, ":", 1);
}

void s2h_write_begin(s2h_writer *writer, const char *key, char bracket) {
  s2h__write_key(writer, key);
  s2h__write(writer, &bracket, 1);
}

void s2h_write_end(s2h_writer *writer, char bracket) { s2h__write(writer, &bracket, 1); }

void s2h_write_string(s2h_writer *writer, const char *key, const char *text) {
  s2h__write_key(writer, key);
  s2h__write_quoted(writer, text);
}

static void s2h__write_decimal(s2h_writer *writer, double number, int n_digits) {
  char text[48];
  char *p = text;
  if (!s2h__is_finite(number)) {
    writer->has_failed = true;
    return;
  }
  (void)snprintf(text, sizeof text, "%.*g", n_digits, number);
  /* Some locales write a comma, which may have several bytes. */
  for (; *p != '\0'; ++p) {
    if (strchr("+-.0123456789e", *p) == NULL) {
      char *rest = p + 1;
      while (*rest != '\0' && strchr("0123456789e", *rest) == NULL) ++rest;
      *p = '.';
      memmove(p + 1, rest, strlen(rest) + 1);
    }
  }
  s2h__write_text(writer, text);
}

/* As few digits as give the same number again. */
static void s2h__write_shortest(s2h_writer *writer, double number) {
  char text[48];
  int n_digits = 15;
  for (; n_digits < 17; ++n_digits) {
    (void)snprintf(text, sizeof text, "%.*g", n_digits, number);
    if (strtod(text, NULL) == number) break; /* both by the same locale */
  }
  s2h__write_decimal(writer, number, n_digits);
}

void s2h_write_number(s2h_writer *writer, const char *key, double number) {
  s2h__write_key(writer, key);
  s2h__write_shortest(writer, number);
}

void s2h_write_numbers(s2h_writer *writer, const char *key, const double *numbers, size_t n) {
  size_t i;
  s2h_write_begin(writer, key, '[');
  for (i = 0; i < n; ++i) s2h_write_number(writer, NULL, numbers[i]);
  s2h_write_end(writer, ']');
}

void s2h_write_bool(s2h_writer *writer, const char *key, bool is_true) {
  s2h__write_key(writer, key);
  s2h__write_text(writer, is_true ? "true" : "false");
}

void s2h_write_json(s2h_writer *writer, const char *key, const char *json) {
  /* Else text of the game could add fields of its own. */
  if (s2h_json_parse(json, strlen(json)).at == NULL) writer->has_failed = true;
  s2h__write_key(writer, key);
  s2h__write_text(writer, json);
}

/* The fields of an object, into an object that is open. NULL is none. */
static void s2h__write_fields(s2h_writer *writer, const char *object) {
  s2h_json all, cursor = s2h__no_json(), key, value;
  if (object == NULL) return;
  all = s2h_json_parse(object, strlen(object));
  if (s2h__kind(all) != '{') {
    writer->has_failed = true;
    return;
  }
  while (s2h_json_next(all, &cursor, &key, &value)) {
    s2h__write_key(writer, NULL);
    s2h__write(writer, key.at, (size_t)(s2h__skip_string(key.at, key.end) - key.at));
    s2h__write(writer, ":", 1);
    s2h__write(writer, value.at, (size_t)(cursor.at - value.at));
  }
}

const char *s2h_writer_text(s2h_writer *writer) { return writer->has_failed ? NULL : writer->text; }

void s2h_writer_free(s2h_writer *writer) {
  S2H_FREE(writer->text);
  writer->text = NULL;
  writer->n = writer->capacity = 0;
  writer->has_failed = false;
}

void s2h_scene_begin(s2h_writer *writer, const char *name, char up_axis) {
  char axis[2];
  axis[0] = up_axis;
  axis[1] = '\0';
  s2h_write_begin(writer, NULL, '{');
  s2h_write_string(writer, "format", "scene2hap/scene");
  s2h_write_number(writer, "version", 1.0);
  s2h_write_string(writer, "name", name);
  s2h_write_string(writer, "up_axis", axis);
  s2h_write_begin(writer, "objects", '[');
}

void s2h_scene_end(s2h_writer *writer) {
  s2h_write_end(writer, ']');
  s2h_write_end(writer, '}');
}

static void s2h__begin_object(s2h_writer *writer, const char *id, const char *name, const double position_m[3],
                              const double rotation_xyzw[4], const char *geometry) {
  s2h_write_begin(writer, NULL, '{');
  s2h_write_string(writer, "id", id);
  s2h_write_string(writer, "name", name);
  s2h_write_begin(writer, "pose", '{');
  s2h_write_numbers(writer, "position_m", position_m, 3);
  if (rotation_xyzw != NULL) s2h_write_numbers(writer, "rotation_xyzw", rotation_xyzw, 4);
  s2h_write_end(writer, '}');
  s2h_write_begin(writer, "geometry", '{');
  s2h_write_string(writer, "kind", geometry);
}

static void s2h__end_object(s2h_writer *writer) {
  s2h_write_end(writer, '}');
  s2h_write_end(writer, '}');
}

void s2h_scene_box(s2h_writer *writer, const char *id, const char *name, const double position_m[3],
                   const double rotation_xyzw[4], const double size_m[3]) {
  s2h__begin_object(writer, id, name, position_m, rotation_xyzw, "box");
  s2h_write_numbers(writer, "size_m", size_m, 3);
  s2h__end_object(writer);
}

void s2h_scene_mesh(s2h_writer *writer, const char *id, const char *name, const double position_m[3],
                    const double rotation_xyzw[4], const float *vertices_m, size_t n_vertices, const uint32_t *faces,
                    size_t n_faces) {
  size_t i, k;
  s2h__begin_object(writer, id, name, position_m, rotation_xyzw, "mesh");
  s2h_write_begin(writer, "vertices_m", '[');
  for (i = 0; i < n_vertices; ++i) {
    s2h_write_begin(writer, NULL, '[');
    for (k = 0; k < 3; ++k) {
      s2h__write_key(writer, NULL);
      s2h__write_decimal(writer, (double)vertices_m[3 * i + k], 9);
    }
    s2h_write_end(writer, ']');
  }
  s2h_write_end(writer, ']');
  s2h_write_begin(writer, "faces", '[');
  for (i = 0; i < n_faces; ++i) {
    s2h_write_begin(writer, NULL, '[');
    for (k = 0; k < 3; ++k) {
      s2h__write_key(writer, NULL);
      s2h__write_decimal(writer, (double)faces[3 * i + k], 10);
    }
    s2h_write_end(writer, ']');
  }
  s2h_write_end(writer, ']');
  s2h__end_object(writer);
}

/* ---------------------------------------------------------------------------------------------- binary messages */

#define S2H__BEGIN_BYTES 40
#define S2H__POSE_BYTES 28
#define S2H__TOUCH_BYTES 20

size_t s2h_frame_bytes(size_t n_poses, size_t n_touches) {
  return S2H__BEGIN_BYTES + S2H__POSE_BYTES * n_poses + S2H__TOUCH_BYTES * n_touches;
}

void s2h_encode_frame(uint8_t *out, uint16_t layout, const uint8_t key[8], uint32_t sequence, double time_s,
                      const float *poses, size_t n_poses, const s2h_touch_row *touches, size_t n_touches) {
  size_t i, k;
  memcpy(out, "S2HB\x01\x01", 6);
  s2h__put_u16(out + 6, layout);
  memcpy(out + 8, key, 8);
  s2h__put_u32(out + 16, sequence);
  s2h__put_u32(out + 20, 0);
  s2h__put_f64(out + 24, time_s);
  s2h__put_u32(out + 32, (uint32_t)n_poses);
  s2h__put_u32(out + 36, (uint32_t)n_touches);
  out += S2H__BEGIN_BYTES;
  for (i = 0; i < 7 * n_poses; ++i, out += 4) s2h__put_f32(out, poses[i]);
  for (i = 0; i < n_touches; ++i, out += S2H__TOUCH_BYTES) {
    s2h__put_u32(out, touches[i].hand);
    s2h__put_u32(out + 4, touches[i].object);
    for (k = 0; k < 3; ++k) s2h__put_f32(out + 8 + 4 * k, touches[i].point_m[k]);
  }
}

bool s2h_decode_gains(const uint8_t *data, size_t n, s2h_gains *gains, float *values, size_t n_values) {
  uint64_t n_numbers;
  uint16_t flags;
  size_t i;
  if (n < S2H__BEGIN_BYTES || memcmp(data, "S2HB\x02\x01", 6) != 0) return false;
  gains->layout = s2h__get_u16(data + 6);
  gains->sequence = s2h__get_u32(data + 16);
  gains->n_skipped = s2h__get_u32(data + 20);
  gains->time_s = s2h__get_f64(data + 24);
  gains->n_hands = s2h__get_u16(data + 32);
  gains->n_sources = s2h__get_u16(data + 34);
  gains->n_bands = s2h__get_u16(data + 36);
  flags = s2h__get_u16(data + 38);
  gains->is_paused = (flags & 1) != 0;
  gains->is_preparing = (flags & 2) != 0;
  /* At most 2^48 + 2^16, so that nothing overflows. */
  n_numbers = gains->n_hands + (uint64_t)gains->n_hands * gains->n_sources * gains->n_bands;
  if ((uint64_t)n != S2H__BEGIN_BYTES + 4 * n_numbers || n_numbers > n_values) return false;
  gains->intensities = values;
  gains->gains = values + gains->n_hands;
  for (i = 0; i < n_numbers; ++i) values[i] = s2h__get_f32(data + S2H__BEGIN_BYTES + 4 * i);
  return s2h__is_finite(gains->time_s) && s2h__are_finite(values, (size_t)n_numbers);
}

/* ----------------------------------------------------------------------------------------------- client's memory */

enum { S2H__STOPPED, S2H__WAITING, S2H__CONNECTING, S2H__HANDSHAKE, S2H__GREETING, S2H__ONLINE };

/* Of a bake or a session that is kept for every connection. */
enum { S2H__NONE, S2H__WANTED, S2H__SENT };
enum { S2H__BAKING = S2H__SENT + 1, S2H__TO_FOLLOW, S2H__FOLLOWING, S2H__BAKED };
enum { S2H__ACTIVE = S2H__SENT + 1, S2H__TO_RESUME, S2H__RESUMING };

enum { S2H__TEXT = 1, S2H__BINARY = 2, S2H__CLOSE = 8, S2H__PING = 9, S2H__PONG = 10 };

/* What is reported once for each order, though it is wrong in each frame. */
enum { S2H__NO_POSE = 1, S2H__NO_HAND = 2, S2H__NO_OBJECT = 4, S2H__NOT_FINITE = 8, S2H__WRONG_GAINS = 16 };
enum { S2H__NOT_MOVING = 32 };

typedef struct s2h__order {
  uint16_t layout, n_bands;
  size_t n_objects, n_moving, n_hands, n_sources;
  const char **objects; /* of all objects, then all hands */
  s2h_source *sources;
  s2h_handle *handles; /* of all objects, hands and sources; -1 where the game has none */
  char *text;          /* of all ids */
  double watchdog_s;
} s2h__order;

typedef struct s2h__name {
  char *text;
  uint32_t hash;
  int64_t object; /* index in the order, -1 if it is not there */
  bool has_pose;
  float pose[7];
} s2h__name;

typedef struct s2h__lying {
  s2h_handle hand, object;
  float point_m[3];
} s2h__lying;

typedef struct s2h__pending {
  uint32_t id;
  char type[16];
} s2h__pending;

/* An error of this side, until s2h_poll hands it over. */
typedef struct s2h__note {
  const char *error;
  uint32_t request;
  char text[256];
} s2h__note;

#define S2H__MAX_NOTES 16
#define S2H__MAX_ADDRESSES 8

struct s2h_client {
  /* Settings. */
  char *url, *token, *name;
  const char *path; /* in `url` */
  char host[300];   /* with port, for the header Host */
  size_t max_receive, max_send;
  struct sockaddr_storage addresses[S2H__MAX_ADDRESSES];
  socklen_t address_bytes[S2H__MAX_ADDRESSES];
  int n_addresses, address;

  /* Connection. */
  s2h__socket socket;
  int state;
  double deadline_s; /* of the next attempt, of connecting, of the greeting */
  double wait_s;     /* before the attempt after the next loss */
  double online_s, heard_s, heartbeat_s;
  double max_server_bytes;
  uint32_t epoch; /* number of the connection */
  char nonce[25];
  bool cannot_send;
  bool has_offline; /* S2H_OFFLINE is to be handed over */
  char why[512];
  int close_code;

  /* Received bytes, and the frame of the WebSocket that they are in. */
  uint8_t in[S2H_BUFFER_BYTES];
  size_t in_begin, in_end;
  uint8_t header[10];
  size_t n_header;
  bool is_in_payload, is_in_message;
  uint64_t payload_left;
  uint8_t control[125];
  size_t n_control;
  char *message;
  size_t n_message, message_capacity;
  int message_opcode;

  /* Bytes to send, and messages behind them: opcode, length in 4 bytes, payload. */
  uint8_t out[S2H_BUFFER_BYTES + 14];
  size_t out_begin, out_end;
  uint8_t *queue;
  size_t queue_begin, queue_end, queue_capacity;
  size_t n_sent_of_first;
  uint8_t pong[125];
  size_t n_pong;
  bool has_pong;
  uint8_t random[256];
  size_t n_random;

  /* Requests. */
  uint32_t last_id;
  s2h__pending pending[S2H__MAX_PENDING];
  size_t n_pending;
  s2h__note notes[S2H__MAX_NOTES];
  size_t n_notes;
  int bake_phase;
  uint32_t bake_id, bake_job, bake_epoch;
  char *bake_fields;
  int play_phase;
  uint32_t play_id, play_job;
  char *play_fields;
  bool is_watching;
  bool needs_bake;  /* the session waits for the end of the bake */
  bool bakes_again; /* the game knows the bake already */
  char session[128], key_text[17];
  uint8_t key[8];

  /* Frames. */
  s2h__name *names;
  size_t n_names, names_capacity;
  s2h_handle *buckets;
  size_t n_buckets;
  s2h__order *orders[S2H__N_LAYOUTS]; /* the newest first */
  s2h__lying lying[S2H__MAX_TOUCHES];
  size_t n_lying;
  s2h_touch_row rows[S2H__MAX_TOUCHES];
  float *poses;
  size_t poses_capacity;
  uint32_t sequence, heard_sequence, poses_sequence;
  bool has_moved;
  int reported;

  /* Gains. */
  s2h_gains gains;
  const s2h__order *gains_order;
  float *values;
  size_t values_capacity;
  double gains_s;

  /* The event that was handed over. */
  char type[32], error[64];
  char *text;
  size_t text_capacity;
  size_t n_bytes, n_events; /* since s2h_poll returned false */
};

/* Keep an error for s2h_poll. The first ones are kept, since later ones often follow from them. */
static void S2H__PRINTF(4, 5)
    s2h__note_error(s2h_client *c, const char *error, uint32_t request, const char *format, ...) {
  va_list arguments;
  s2h__note *note;
  if (c->n_notes == S2H__MAX_NOTES) return;
  note = &c->notes[c->n_notes++];
  note->error = error;
  note->request = request;
  va_start(arguments, format);
  (void)vsnprintf(note->text, sizeof note->text, format, arguments);
  va_end(arguments);
}

static void s2h__no_memory(s2h_client *c) {
  s2h__note_error(c, "OutOfMemory", 0, "There is not enough memory; something was left out.");
}

/* ---------------------------------------------------------------------------------------- WebSocket: the handshake */

static uint32_t s2h__rotated(uint32_t x, int n) { return x << n | x >> (32 - n); }

/* SHA-1 of at most 119 bytes, which is enough for Sec-WebSocket-Accept. */
static void s2h__sha1(const uint8_t *data, size_t n, uint8_t out[20]) {
  uint8_t blocks[128];
  uint32_t h[5] = {0x67452301u, 0xEFCDAB89u, 0x98BADCFEu, 0x10325476u, 0xC3D2E1F0u};
  size_t n_blocks = n < 56 ? 1 : 2, block, i;
  memset(blocks, 0, sizeof blocks);
  memcpy(blocks, data, n);
  blocks[n] = 0x80;
  blocks[64 * n_blocks - 2] = (uint8_t)(n >> 5);
  blocks[64 * n_blocks - 1] = (uint8_t)(n << 3 & 0xFF);
  for (block = 0; block < n_blocks; ++block) {
    uint32_t w[80], a = h[0], b = h[1], c = h[2], d = h[3], e = h[4];
    for (i = 0; i < 16; ++i) {
      const uint8_t *p = blocks + 64 * block + 4 * i;
      w[i] = (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
    }
    for (; i < 80; ++i) w[i] = s2h__rotated(w[i - 3] ^ w[i - 8] ^ w[i - 14] ^ w[i - 16], 1);
    for (i = 0; i < 80; ++i) {
      uint32_t f = i < 20 ? (b & c) | (~b & d) : i < 40 ? b ^ c ^ d : i < 60 ? (b & c) | (b & d) | (c & d) : b ^ c ^ d;
      uint32_t k = i < 20 ? 0x5A827999u : i < 40 ? 0x6ED9EBA1u : i < 60 ? 0x8F1BBCDCu : 0xCA62C1D6u;
      uint32_t next = s2h__rotated(a, 5) + f + e + k + w[i];
      e = d;
      d = c;
      c = s2h__rotated(b, 30);
      b = a;
      a = next;
    }
    h[0] += a;
    h[1] += b;
    h[2] += c;
    h[3] += d;
    h[4] += e;
  }
  for (i = 0; i < 20; ++i) out[i] = (uint8_t)(h[i / 4] >> (24 - 8 * (i % 4)) & 0xFF);
}

/* Base64 with a 0 behind it: 4 characters for each 3 bytes, rounded up. */
static void s2h__base64(const uint8_t *data, size_t n, char *out) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  size_t i, k;
  for (i = 0; i < n; i += 3) {
    uint32_t bits = 0;
    for (k = 0; k < 3; ++k) bits = bits << 8 | (i + k < n ? data[i + k] : 0u);
    for (k = 0; k < 4; ++k) *out++ = i + k <= n ? digits[bits >> (18 - 6 * k) & 63] : '=';
  }
  *out = '\0';
}

static void s2h__accept_of(const char *nonce, char out[29]) {
  uint8_t digest[20];
  char text[64];
  (void)snprintf(text, sizeof text, "%.24s258EAFA5-E914-47DA-95CA-C5AB0DC85B11", nonce);
  s2h__sha1((const uint8_t *)text, strlen(text), digest);
  s2h__base64(digest, sizeof digest, out);
}

static char s2h__lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c + 32) : c; }

/* Whether n characters are a word, whatever the case. */
static bool s2h__is_word(const char *text, size_t n, const char *word) {
  size_t i;
  if (strlen(word) != n) return false;
  for (i = 0; i < n; ++i) {
    if (s2h__lower(text[i]) != s2h__lower(word[i])) return false;
  }
  return true;
}

/* Whether a list with commas has a word. */
static bool s2h__has_word(const char *text, size_t n, const char *word) {
  size_t begin = 0, end;
  while (begin < n) {
    size_t first = begin, last;
    for (end = begin; end < n && text[end] != ','; ++end) continue;
    last = end;
    while (first < last && (text[first] == ' ' || text[first] == '\t')) ++first;
    while (last > first && (text[last - 1] == ' ' || text[last - 1] == '\t')) --last;
    if (s2h__is_word(text + first, last - first, word)) return true;
    begin = end + 1;
  }
  return false;
}

/* What is wrong with the head of a server's answer, whose n bytes end with an empty line; NULL if it is right. */
static const char *s2h__head_problem(const char *head, size_t n, const char *nonce) {
  const char *end = head + n, *line = head, *line_end;
  bool is_upgrade = false, is_connection = false, is_accept = false;
  char accept[29];
  s2h__accept_of(nonce, accept);
  if (memchr(head, '\0', n) != NULL) return "its head has a zero byte";
  if (n < 13 || memcmp(head, "HTTP/1.1 101", 12) != 0 || (head[12] != ' ' && head[12] != '\r')) {
    return "it is no WebSocket server, or refuses this client";
  }
  for (;;) {
    const char *colon, *value;
    size_t n_name, n_value;
    line = (const char *)memchr(line, '\n', (size_t)(end - line)) + 1; /* the empty line ends the loop before `end` */
    line_end = (const char *)memchr(line, '\n', (size_t)(end - line));
    if (line_end == NULL || line_end == line || line_end[-1] != '\r') return "a line of its head ends wrongly";
    --line_end;
    if (line_end == line) break;
    colon = (const char *)memchr(line, ':', (size_t)(line_end - line));
    if (colon == NULL || colon == line || *line == ' ' || *line == '\t') return "a line of its head is no header";
    n_name = (size_t)(colon - line);
    value = colon + 1;
    while (value < line_end && (*value == ' ' || *value == '\t')) ++value;
    n_value = (size_t)(line_end - value);
    while (n_value > 0 && (value[n_value - 1] == ' ' || value[n_value - 1] == '\t')) --n_value;
    if (s2h__is_word(line, n_name, "Upgrade")) {
      if (!s2h__has_word(value, n_value, "websocket")) return "it upgrades to something else than a WebSocket";
      is_upgrade = true;
    } else if (s2h__is_word(line, n_name, "Connection")) {
      if (s2h__has_word(value, n_value, "upgrade")) is_connection = true;
    } else if (s2h__is_word(line, n_name, "Sec-WebSocket-Accept")) {
      if (is_accept || n_value != 28 || memcmp(value, accept, 28) != 0) return "its Sec-WebSocket-Accept is wrong";
      is_accept = true;
    } else if (s2h__is_word(line, n_name, "Sec-WebSocket-Extensions") ||
               s2h__is_word(line, n_name, "Sec-WebSocket-Protocol")) {
      return "it uses an extension that was not offered";
    }
  }
  return is_upgrade && is_connection && is_accept ? NULL : "its head lacks a header of a WebSocket";
}

/* --------------------------------------------------------------------------------------------- WebSocket: sending */

static bool s2h__take_random(s2h_client *c, uint8_t *out, size_t n) {
  if (c->n_random < n) {
    if (!s2h__random(c->random, sizeof c->random)) return false;
    c->n_random = sizeof c->random;
  }
  c->n_random -= n;
  memcpy(out, c->random + c->n_random, n);
  return true;
}

/* Put one frame of the WebSocket into the empty `out`, masked. */
static void s2h__stage(s2h_client *c, int first, const uint8_t *data, size_t n) {
  uint8_t mask[4];
  uint8_t *out = c->out;
  size_t i;
  if (!s2h__take_random(c, mask, 4)) {
    c->cannot_send = true;
    s2h__note_error(c, "NoRandomNumbers", 0, "The system gives no random numbers, so that nothing can be sent.");
    return;
  }
  *out++ = (uint8_t)first;
  if (n < 126) {
    *out++ = (uint8_t)(0x80 | n);
  } else if (n < 65536) {
    *out++ = 0x80 | 126;
    *out++ = (uint8_t)(n >> 8);
    *out++ = (uint8_t)(n & 0xFF);
  } else {
    *out++ = 0x80 | 127;
    for (i = 0; i < 8; ++i) *out++ = (uint8_t)((uint64_t)n >> (56 - 8 * i) & 0xFF);
  }
  memcpy(out, mask, 4);
  out += 4;
  for (i = 0; i < n; ++i) out[i] = data[i] ^ mask[i & 3];
  c->out_begin = 0;
  c->out_end = (size_t)(out - c->out) + n;
}

/* Stage what comes next. Returns false if there is nothing. */
static bool s2h__stage_next(s2h_client *c) {
  const uint8_t *first;
  size_t n_payload, n;
  int opcode;
  if (c->has_pong) {
    c->has_pong = false;
    s2h__stage(c, 0x80 | S2H__PONG, c->pong, c->n_pong);
    return true;
  }
  if (c->queue_begin == c->queue_end) return false;
  first = c->queue + c->queue_begin;
  opcode = first[0];
  n_payload = s2h__get_u32(first + 1);
  n = n_payload - c->n_sent_of_first;
  if (n > S2H_BUFFER_BYTES) n = S2H_BUFFER_BYTES;
  if (c->n_sent_of_first > 0) opcode = 0;
  if (c->n_sent_of_first + n == n_payload) opcode |= 0x80;
  s2h__stage(c, opcode, first + 5 + c->n_sent_of_first, n);
  c->n_sent_of_first += n;
  if (c->n_sent_of_first == n_payload) {
    c->n_sent_of_first = 0;
    c->queue_begin += 5 + n_payload;
    if (c->queue_begin == c->queue_end) {
      c->queue_begin = c->queue_end = 0;
      if (c->queue_capacity > S2H__FLUSH_BYTES) { /* a scene was sent, once */
        S2H_FREE(c->queue);
        c->queue = NULL;
        c->queue_capacity = 0;
      }
    }
  }
  return true;
}

/* Send what the network takes now. Returns whether all is sent. */
static bool s2h__flush(s2h_client *c) {
  size_t budget = S2H__FLUSH_BYTES;
  while (!c->cannot_send) {
    while (c->out_begin < c->out_end) {
      long n;
      if (budget == 0) return false;
      n = S2H_SEND(c->socket, c->out + c->out_begin, c->out_end - c->out_begin);
      if (n < 0) {
        /* What the server said before it closed is still to be read, so that the reader finds the end. */
        if (!s2h__would_block(s2h__socket_error())) c->cannot_send = true;
        return false;
      }
      c->out_begin += (size_t)n;
      budget -= (size_t)n < budget ? (size_t)n : budget;
    }
    c->out_begin = c->out_end = 0;
    if (c->state < S2H__GREETING || !s2h__stage_next(c)) return true;
  }
  return false;
}

/* Room for a message of n bytes behind those that wait. Returns NULL if there is none; an error is noted. */
static uint8_t *s2h__queued(s2h_client *c, int opcode, size_t n, uint32_t request) {
  size_t n_waiting = c->queue_end - c->queue_begin;
  uint8_t *grown;
  if (n > c->max_send || n_waiting > c->max_send - n) {
    s2h__note_error(c, "TooMuchToSend", request,
                    "%.0f bytes do not fit behind the %.0f that wait for the network; at most %.0f may. Send fewer, or "
                    "raise max_send_bytes.",
                    (double)n, (double)n_waiting, (double)c->max_send);
    return NULL;
  }
  if (c->queue_begin > 0) {
    memmove(c->queue, c->queue + c->queue_begin, n_waiting);
    c->queue_begin = 0;
    c->queue_end = n_waiting;
  }
  grown = (uint8_t *)s2h__grown(c->queue, &c->queue_capacity, n_waiting + 5 + n, 1);
  if (grown == NULL) {
    s2h__no_memory(c);
    return NULL;
  }
  c->queue = grown;
  grown += c->queue_end;
  grown[0] = (uint8_t)opcode;
  s2h__put_u32(grown + 1, (uint32_t)n);
  c->queue_end += 5 + n;
  return grown + 5;
}

/* ------------------------------------------------------------------------------------------- WebSocket: receiving */

static void s2h__forget_connection(s2h_client *c) {
  if (c->socket != S2H__NO_SOCKET) s2h__close_socket(c->socket);
  c->socket = S2H__NO_SOCKET;
  c->in_begin = c->in_end = c->out_begin = c->out_end = 0;
  c->queue_begin = c->queue_end = c->n_sent_of_first = 0;
  c->n_header = c->n_message = c->n_control = 0;
  c->is_in_payload = c->is_in_message = c->has_pong = c->cannot_send = false;
  c->gains_s = S2H__LONG_AGO_S;
  if (c->bake_phase == S2H__SENT) c->bake_phase = S2H__WANTED;
  if (c->bake_phase == S2H__BAKING || c->bake_phase == S2H__FOLLOWING) c->bake_phase = S2H__TO_FOLLOW;
  if (c->play_phase == S2H__SENT) c->play_phase = S2H__WANTED;
  if (c->play_phase == S2H__ACTIVE || c->play_phase == S2H__RESUMING) c->play_phase = S2H__TO_RESUME;
}

/* Give up the connection, and try again later unless it `is_final`. */
static void S2H__PRINTF(4, 5)
    s2h__lose(s2h_client *c, int code, bool is_final, const char *format, ...) {
  va_list arguments;
  double now_s = S2H_NOW_S();
  va_start(arguments, format);
  (void)vsnprintf(c->why, sizeof c->why, format, arguments);
  va_end(arguments);
  if (c->state == S2H__ONLINE && now_s - c->online_s >= S2H__STEADY_S) c->wait_s = S2H__FIRST_WAIT_S;
  s2h__forget_connection(c);
  c->close_code = code;
  c->has_offline = true;
  c->state = is_final ? S2H__STOPPED : S2H__WAITING;
  c->deadline_s = now_s + c->wait_s;
}

/* Say why with a close frame, if it can be sent at once, and give up the connection. */
static void s2h__fail(s2h_client *c, int code, const char *text) {
  uint8_t payload[2];
  payload[0] = (uint8_t)(code >> 8);
  payload[1] = (uint8_t)(code & 0xFF);
  if (c->out_begin == c->out_end && !c->cannot_send) {
    s2h__stage(c, 0x80 | S2H__CLOSE, payload, 2);
    if (!c->cannot_send) (void)S2H_SEND(c->socket, c->out, c->out_end);
  }
  s2h__lose(c, 0, false, "%s broke the rules of WebSockets: %s.", c->host, text);
}

/* Receive more bytes. Returns 1 if there are some, 0 if none have come, -1 if the connection is lost. */
static int s2h__receive(s2h_client *c) {
  long n;
  if (c->in_begin == c->in_end) c->in_begin = c->in_end = 0;
  if (c->n_bytes >= S2H__FLUSH_BYTES) return 0;
  n = S2H_RECV(c->socket, c->in + c->in_end, sizeof c->in - c->in_end);
  if (n > 0) {
    c->in_end += (size_t)n;
    c->n_bytes += (size_t)n;
    c->heard_s = S2H_NOW_S();
    return 1;
  }
  if (n < 0 && s2h__would_block(s2h__socket_error())) return 0;
  s2h__lose(c, 0, false, "The connection to %s was lost.", c->host);
  return -1;
}

/* Take the header of a frame at `c->header`. Returns what is wrong, NULL if nothing is. */
static const char *s2h__take_header(s2h_client *c) {
  const uint8_t *header = c->header;
  int opcode = header[0] & 0x0F;
  bool is_last = (header[0] & 0x80) != 0;
  uint64_t n = header[1] & 0x7F;
  size_t i;
  if (header[0] & 0x70) return "a frame has reserved bits";
  if (header[1] & 0x80) return "a frame is masked";
  if (n == 126) {
    n = (uint64_t)header[2] << 8 | header[3];
    if (n < 126) return "a length is longer than needed";
  } else if (n == 127) {
    n = 0;
    for (i = 0; i < 8; ++i) n = n << 8 | header[2 + i];
    if (n < 65536 || n >> 63) return "a length is longer than needed";
  }
  c->payload_left = n;
  if (opcode >= 8) {
    if (opcode > S2H__PONG) return "an opcode is unknown";
    if (!is_last || n > sizeof c->control) return "a control frame is long or in pieces";
    c->n_control = 0;
    return NULL;
  }
  if (opcode > S2H__BINARY) return "an opcode is unknown";
  if ((opcode == 0) != c->is_in_message) return "the pieces of a message are mixed up";
  if (opcode != 0) {
    c->message_opcode = opcode;
    c->n_message = 0;
    c->is_in_message = true;
  }
  return NULL;
}

/* Take the close frame at `c->control`. */
static void s2h__take_close(s2h_client *c) {
  int code = c->n_control >= 2 ? c->control[0] << 8 | c->control[1] : 1005;
  const char *reason = (const char *)c->control + 2;
  size_t n_reason = c->n_control >= 2 ? c->n_control - 2 : 0;
  bool is_code = (code >= 1000 && code <= 1014 && code != 1004 && code != 1006) || (code >= 3000 && code <= 4999);
  if (c->n_control == 1 || !is_code || (c->n_control >= 2 && code == 1005) || !s2h__is_utf8(reason, n_reason)) {
    s2h__fail(c, 1002, "a close frame is wrong");
    return;
  }
  if (c->out_begin == c->out_end && !c->cannot_send) { /* the answer that RFC 6455 demands, if it can be sent now */
    s2h__stage(c, 0x80 | S2H__CLOSE, c->control, c->n_control < 2 ? 0 : 2);
    if (!c->cannot_send) (void)S2H_SEND(c->socket, c->out, c->out_end);
  }
  /* After another version or a wrong token, each attempt would end in the same way. */
  s2h__lose(c, code, code == 4001 || code == 4003, "%s closed the connection (%d%s%.*s).", c->host, code,
            n_reason > 0 ? ": " : "", (int)n_reason, reason);
}

/* Take bytes until a message is complete. Returns 1 with `c->message`, 0 if bytes lack, -1 if it is lost. */
static int s2h__next_message(s2h_client *c) {
  for (;;) {
    size_t n;
    if (c->in_begin == c->in_end && !(c->is_in_payload && c->payload_left == 0)) {
      int received = s2h__receive(c);
      if (received <= 0) return received;
    }
    if (!c->is_in_payload) {
      size_t needed = 2;
      const char *problem;
      while (c->n_header < 2 && c->in_begin < c->in_end) c->header[c->n_header++] = c->in[c->in_begin++];
      if (c->n_header >= 2) {
        size_t n_short = c->header[1] & 0x7F;
        needed = n_short == 127 ? 10 : n_short == 126 ? 4 : 2;
      }
      while (c->n_header < needed && c->in_begin < c->in_end) c->header[c->n_header++] = c->in[c->in_begin++];
      if (c->n_header < needed) continue;
      problem = s2h__take_header(c);
      if (problem != NULL) {
        s2h__fail(c, 1002, problem);
        return -1;
      }
      c->is_in_payload = true;
      c->n_header = 0;
    }
    n = c->in_end - c->in_begin;
    if (n > c->payload_left) n = (size_t)c->payload_left;
    if (c->header[0] & 0x08) {
      memcpy(c->control + c->n_control, c->in + c->in_begin, n);
      c->n_control += n;
    } else {
      char *grown;
      /* Before a byte of it is kept, since the server may announce any length. */
      if (c->payload_left > c->max_receive - c->n_message) {
        s2h__fail(c, 1009, "a message is longer than max_receive_bytes");
        return -1;
      }
      grown = (char *)s2h__grown(c->message, &c->message_capacity, c->n_message + n + 1, 1);
      if (grown == NULL) {
        s2h__fail(c, 1009, "there is not enough memory for a message");
        return -1;
      }
      c->message = grown;
      memcpy(grown + c->n_message, c->in + c->in_begin, n);
      c->n_message += n;
    }
    c->in_begin += n;
    c->payload_left -= n;
    if (c->payload_left > 0) continue;
    c->is_in_payload = false;
    if ((c->header[0] & 0x0F) == S2H__CLOSE) {
      s2h__take_close(c);
      return -1;
    }
    if ((c->header[0] & 0x0F) == S2H__PING) { /* the newest is answered; RFC 6455 allows that */
      memcpy(c->pong, c->control, c->n_control);
      c->n_pong = c->n_control;
      c->has_pong = true;
    } else if ((c->header[0] & 0x88) == 0x80) {
      c->is_in_message = false;
      if (c->message_opcode == S2H__TEXT && !s2h__is_utf8(c->message, c->n_message)) {
        s2h__fail(c, 1007, "a text is not UTF-8");
        return -1;
      }
      return 1;
    }
  }
}

/* ------------------------------------------------------------------------------------------------------ handles */

static uint32_t s2h__hash(const char *text) {
  uint32_t hash = 2166136261u; /* FNV-1a */
  for (; *text != '\0'; ++text) hash = (hash ^ (unsigned char)*text) * 16777619u;
  return hash;
}

static s2h_handle s2h__known(const s2h_client *c, const char *id) {
  uint32_t hash = s2h__hash(id);
  size_t at;
  if (c->n_buckets == 0) return -1;
  for (at = hash & (c->n_buckets - 1); c->buckets[at] >= 0; at = (at + 1) & (c->n_buckets - 1)) {
    const s2h__name *name = &c->names[c->buckets[at]];
    if (name->hash == hash && strcmp(name->text, id) == 0) return c->buckets[at];
  }
  return -1;
}

static void s2h__put_in_bucket(s2h_client *c, s2h_handle handle) {
  size_t at = c->names[handle].hash & (c->n_buckets - 1);
  while (c->buckets[at] >= 0) at = (at + 1) & (c->n_buckets - 1);
  c->buckets[at] = handle;
}

static bool s2h__has_buckets(s2h_client *c) {
  size_t n = c->n_buckets ? 2 * c->n_buckets : 64, i;
  s2h_handle *found;
  if (2 * (c->n_names + 1) <= c->n_buckets) return true;
  found = (s2h_handle *)S2H_REALLOC(c->buckets, n * sizeof *found);
  if (found == NULL) return false;
  c->buckets = found;
  c->n_buckets = n;
  for (i = 0; i < n; ++i) found[i] = -1;
  for (i = 0; i < c->n_names; ++i) s2h__put_in_bucket(c, (s2h_handle)i);
  return true;
}

/* The id with an index among all objects, hands and sources of an order. */
static const char *s2h__order_id(const s2h__order *order, size_t i) {
  size_t n = order->n_objects + order->n_hands;
  return i < n ? order->objects[i] : order->sources[i - n].id;
}

s2h_handle s2h_handle_of(s2h_client *c, const char *id) {
  s2h_handle found = s2h__known(c, id);
  s2h__name *names;
  size_t i, k;
  if (found >= 0) return found;
  names = (s2h__name *)s2h__grown(c->names, &c->names_capacity, c->n_names + 1, sizeof *names);
  if (names != NULL) c->names = names;
  if (names == NULL || c->n_names >= S2H__MAX_HANDLES || !s2h__has_buckets(c)) {
    s2h__no_memory(c);
    return -1;
  }
  memset(&names[c->n_names], 0, sizeof *names);
  names += c->n_names;
  names->text = s2h__copy_of(id);
  if (names->text == NULL) {
    s2h__no_memory(c);
    return -1;
  }
  names->hash = s2h__hash(id);
  names->object = -1;
  found = (s2h_handle)c->n_names++;
  s2h__put_in_bucket(c, found);
  for (i = 0; i < S2H__N_LAYOUTS && c->orders[i] != NULL; ++i) {
    s2h__order *order = c->orders[i];
    for (k = 0; k < order->n_objects + order->n_hands + order->n_sources; ++k) {
      if (strcmp(s2h__order_id(order, k), id) != 0) continue;
      order->handles[k] = found;
      if (i == 0 && k < order->n_objects) names->object = (int64_t)k;
    }
  }
  return found;
}

/* ------------------------------------------------------------------------------------------------------- orders */

static void s2h__free_order(s2h__order *order) {
  if (order == NULL) return;
  S2H_FREE((void *)order->objects);
  S2H_FREE(order->sources);
  S2H_FREE(order->handles);
  S2H_FREE(order->text);
  S2H_FREE(order);
}

static void s2h__forget_orders(s2h_client *c) {
  size_t i;
  for (i = 0; i < S2H__N_LAYOUTS; ++i) {
    s2h__free_order(c->orders[i]);
    c->orders[i] = NULL;
  }
  c->gains_order = NULL;
  for (i = 0; i < c->n_names; ++i) c->names[i].object = -1;
}

static size_t s2h__count(s2h_json array) {
  s2h_json cursor = s2h__no_json(), value;
  size_t n = 0;
  while (s2h_json_next(array, &cursor, NULL, &value)) ++n;
  return n;
}

/* Copy an id into the text of an order. */
static const char *s2h__kept(s2h_json value, char **text) {
  const char *behind = s2h__kind(value) == '"' ? s2h__skip_string(value.at, value.end) : NULL;
  char *found = *text;
  if (behind == NULL) return "";
  /* Decoded, a string and its 0 are never longer than with quotes and escapes. */
  (void)s2h_json_string(value, found, (size_t)(behind - value.at));
  *text += strlen(found) + 1;
  return found;
}

/* Take the order of a message into use. Returns false if it makes no sense. */
static bool s2h__take_order(s2h_client *c, s2h_json message) {
  s2h_json objects = s2h_json_get(message, "objects"), hands = s2h_json_get(message, "hands");
  s2h_json sources = s2h_json_get(message, "sources"), cursor, value;
  s2h__order *order = (s2h__order *)S2H_REALLOC(NULL, sizeof *order);
  char *text;
  size_t n, i;
  if (order == NULL) {
    s2h__no_memory(c);
    return false;
  }
  memset(order, 0, sizeof *order);
  order->layout = (uint16_t)s2h__json_uint(s2h_json_get(message, "layout"), 0xFFFF, 0);
  order->n_bands = (uint16_t)s2h__json_uint(s2h_json_get(message, "n_bands"), 0xFFFF, 0);
  order->n_objects = s2h__count(objects);
  order->n_hands = s2h__count(hands);
  order->n_sources = s2h__count(sources);
  order->n_moving = s2h__json_uint(s2h_json_get(message, "n_moving"), UINT32_MAX, 0);
  order->watchdog_s = s2h_json_number(s2h_json_get(message, "watchdog_s"), 0.1);
  if (!(order->watchdog_s >= 0.0)) order->watchdog_s = 0.0;
  if (order->watchdog_s > 1.0) order->watchdog_s = 1.0; /* the longest of a session; gains must not last for ever */
  if (order->layout == 0 || order->n_bands == 0 || order->n_moving > order->n_objects || order->n_hands > 0xFFFF ||
      order->n_sources > 0xFFFF) {
    s2h__free_order(order);
    return false;
  }
  n = order->n_objects + order->n_hands + order->n_sources;
  order->objects = (const char **)S2H_REALLOC(NULL, (order->n_objects + order->n_hands + 1) * sizeof(char *));
  order->sources = (s2h_source *)S2H_REALLOC(NULL, (order->n_sources + 1) * sizeof *order->sources);
  order->handles = (s2h_handle *)S2H_REALLOC(NULL, (n + 1) * sizeof *order->handles);
  text = order->text = (char *)S2H_REALLOC(NULL, (size_t)(message.end - message.at) + 1);
  if (order->objects == NULL || order->sources == NULL || order->handles == NULL || text == NULL) {
    s2h__free_order(order);
    s2h__no_memory(c);
    return false;
  }
  cursor = s2h__no_json();
  for (i = 0; s2h_json_next(objects, &cursor, NULL, &value); ++i) order->objects[i] = s2h__kept(value, &text);
  cursor = s2h__no_json();
  for (; s2h_json_next(hands, &cursor, NULL, &value); ++i) order->objects[i] = s2h__kept(value, &text);
  cursor = s2h__no_json();
  for (i = 0; s2h_json_next(sources, &cursor, NULL, &value); ++i) {
    order->sources[i].id = s2h__kept(s2h_json_get(value, "id"), &text);
    order->sources[i].state = s2h__kept(s2h_json_get(value, "state"), &text);
    order->sources[i].is_on = s2h_json_true(s2h_json_get(value, "is_on"));
    order->sources[i].frequency_hz = s2h_json_number(s2h_json_get(value, "frequency_hz"), 0.0);
  }
  for (i = 0; i < c->n_names; ++i) c->names[i].object = -1;
  for (i = 0; i < n; ++i) {
    order->handles[i] = s2h__known(c, s2h__order_id(order, i));
    if (order->handles[i] >= 0 && i < order->n_objects) c->names[order->handles[i]].object = (int64_t)i;
  }
  i = S2H__N_LAYOUTS - 1;
  if (c->gains_order == c->orders[i]) c->gains_order = NULL;
  s2h__free_order(c->orders[i]);
  for (; i > 0; --i) c->orders[i] = c->orders[i - 1];
  c->orders[0] = order;
  c->has_moved = true; /* the next frame must have poses, in the new order */
  c->reported = 0;
  return true;
}

const char *s2h_object_id(const s2h_client *c, size_t index) {
  const s2h__order *order = c->orders[0];
  return order != NULL && index < order->n_objects ? order->objects[index] : NULL;
}

const char *s2h_hand_id(const s2h_client *c, size_t index) {
  const s2h__order *order = c->orders[0];
  return order != NULL && index < order->n_hands ? order->objects[order->n_objects + index] : NULL;
}

const s2h_source *s2h_source_at(const s2h_client *c, size_t index) {
  const s2h__order *order = c->orders[0];
  return order != NULL && index < order->n_sources ? &order->sources[index] : NULL;
}

/* ------------------------------------------------------------------------------------------------------- frames */

/* Note an error that may be in each frame once for each order. */
static void s2h__report_once(s2h_client *c, int what, const char *format, const char *id) {
  char text[200];
  if (c->reported & what) return;
  c->reported |= what;
  (void)snprintf(text, sizeof text, "%.100s", id);
  s2h__note_error(c, "FrameError", 0, "%s: %s", text, format);
}

/* Whether a request waits whose answer may make an id right that is wrong now. */
static bool s2h__is_changing(const s2h_client *c) {
  size_t i;
  for (i = 0; i < c->n_pending; ++i) {
    const char *type = c->pending[i].type;
    if (strcmp(type, "add") == 0 || strcmp(type, "spawn") == 0 || strcmp(type, "moving") == 0) return true;
  }
  return false;
}

bool s2h_is_playing(const s2h_client *c) {
  return c->state == S2H__ONLINE && c->play_phase == S2H__ACTIVE && !c->is_watching;
}

uint32_t s2h_sequence(const s2h_client *c) { return c->sequence; }

bool s2h_set_pose(s2h_client *c, s2h_handle object, const float position_m[3], const float rotation_xyzw[4]) {
  static const float none[4] = {0.0f, 0.0f, 0.0f, 1.0f};
  float pose[7];
  s2h__name *name;
  if (object < 0 || (size_t)object >= c->n_names) return false;
  name = &c->names[object];
  memcpy(pose, position_m, 3 * sizeof *pose);
  memcpy(pose + 3, rotation_xyzw != NULL ? rotation_xyzw : none, 4 * sizeof *pose);
  if (!s2h__are_finite(pose, 7)) {
    s2h__report_once(c, S2H__NOT_FINITE, "its pose is not finite, so that it stays where it was.", name->text);
    return false;
  }
  if (s2h_is_playing(c) && c->orders[0] != NULL && name->object >= (int64_t)c->orders[0]->n_moving &&
      !s2h__is_changing(c)) {
    s2h__report_once(c, S2H__NOT_MOVING,
                     "it is not among the moving objects, so that its pose is not sent. Name it in s2h_play or "
                     "s2h_set_moving.",
                     name->text);
  }
  if (name->has_pose && memcmp(name->pose, pose, sizeof pose) == 0) return true;
  memcpy(name->pose, pose, sizeof pose);
  name->has_pose = c->has_moved = true;
  return true;
}

void s2h_lift(s2h_client *c, s2h_handle hand) {
  size_t i;
  for (i = 0; i < c->n_lying; ++i) {
    if (c->lying[i].hand == hand) {
      memmove(&c->lying[i], &c->lying[i + 1], (c->n_lying - i - 1) * sizeof *c->lying);
      --c->n_lying;
      return;
    }
  }
}

bool s2h_touch(s2h_client *c, s2h_handle hand, s2h_handle object, const float point_m[3]) {
  size_t i = 0;
  if (hand < 0 || (size_t)hand >= c->n_names || object < 0 || (size_t)object >= c->n_names) return false;
  if (!s2h__are_finite(point_m, 3)) {
    s2h__report_once(c, S2H__NOT_FINITE, "its point is not finite, so that its touch stays.", c->names[hand].text);
    return false;
  }
  while (i < c->n_lying && c->lying[i].hand != hand) ++i;
  if (i == S2H__MAX_TOUCHES) return false;
  if (i == c->n_lying) ++c->n_lying;
  c->lying[i].hand = hand;
  c->lying[i].object = object;
  memcpy(c->lying[i].point_m, point_m, 3 * sizeof *point_m);
  return true;
}

/* Gather the poses of all that moves. Returns their number: 0 if the server knows them, or if one is unknown. */
static size_t s2h__gather_poses(s2h_client *c, const s2h__order *order) {
  float *grown;
  size_t i;
  /* The server may replace a waiting frame by a newer one, so that the newer one must repeat its poses. */
  if (order->n_moving == 0 || (!c->has_moved && c->heard_sequence >= c->poses_sequence)) return 0;
  grown = (float *)s2h__grown(c->poses, &c->poses_capacity, 7 * order->n_moving, sizeof *grown);
  if (grown == NULL) {
    s2h__no_memory(c);
    return 0;
  }
  c->poses = grown;
  for (i = 0; i < order->n_moving; ++i) {
    s2h_handle handle = order->handles[i];
    if (handle < 0 || !c->names[handle].has_pose) {
      s2h__report_once(c, S2H__NO_POSE, "it moves, but has no pose, so that no poses are sent. Call s2h_set_pose.",
                       order->objects[i]);
      return 0;
    }
    memcpy(c->poses + 7 * i, c->names[handle].pose, sizeof c->names[handle].pose);
  }
  return order->n_moving;
}

static size_t s2h__gather_touches(s2h_client *c, const s2h__order *order) {
  size_t i, hand, n = 0;
  for (i = 0; i < c->n_lying; ++i) {
    const s2h__lying *one = &c->lying[i];
    const s2h_handle *hands = order->handles + order->n_objects;
    for (hand = 0; hand < order->n_hands && hands[hand] != one->hand; ++hand) continue;
    if (hand == order->n_hands) {
      s2h__report_once(c, S2H__NO_HAND, "the session has no such hand.", c->names[one->hand].text);
    } else if (c->names[one->object].object < 0) {
      if (!s2h__is_changing(c)) {
        s2h__report_once(c, S2H__NO_OBJECT, "the session has no such object, so that no hand touches it.",
                         c->names[one->object].text);
      }
    } else {
      c->rows[n].hand = (uint32_t)hand;
      c->rows[n].object = (uint32_t)c->names[one->object].object;
      memcpy(c->rows[n].point_m, one->point_m, sizeof one->point_m);
      ++n;
    }
  }
  return n;
}

uint32_t s2h_send_frame(s2h_client *c, double time_s) {
  const s2h__order *order = c->orders[0];
  size_t n_poses, n_touches;
  uint8_t *out;
  if (!s2h_is_playing(c) || order == NULL) return 0;
  if (!s2h__is_finite(time_s)) {
    s2h__report_once(c, S2H__NOT_FINITE, "must be finite; the frame is left out.", "time_s");
    return 0;
  }
  /* A queue of frames would make all of them late: while the network takes nothing, the newest waits in the poses. */
  if (!s2h__flush(c)) return 0;
  n_poses = s2h__gather_poses(c, order);
  n_touches = s2h__gather_touches(c, order);
  out = s2h__queued(c, S2H__BINARY, s2h_frame_bytes(n_poses, n_touches), 0);
  if (out == NULL) return 0;
  s2h_encode_frame(out, order->layout, c->key, ++c->sequence, time_s, c->poses, n_poses, c->rows, n_touches);
  if (c->has_moved && n_poses > 0) {
    c->has_moved = false;
    c->poses_sequence = c->sequence;
  }
  (void)s2h__flush(c);
  return c->sequence;
}

/* -------------------------------------------------------------------------------------------------------- gains */

/* Take gains. Returns whether they fit an order of the session. */
static bool s2h__take_gains(s2h_client *c, const uint8_t *data, size_t n) {
  const s2h__order *order = NULL;
  s2h_gains gains;
  float *grown = (float *)s2h__grown(c->values, &c->values_capacity, n / 4 + 1, sizeof *grown);
  size_t i;
  if (grown == NULL) {
    s2h__no_memory(c);
    return false;
  }
  c->values = grown;
  if (n >= 8) {
    for (i = 0; i < S2H__N_LAYOUTS && order == NULL; ++i) {
      if (c->orders[i] != NULL && c->orders[i]->layout == s2h__get_u16(data + 6)) order = c->orders[i];
    }
  }
  /* The last gains have moved, and are overwritten from here on. */
  c->gains_order = NULL;
  c->gains_s = S2H__LONG_AGO_S;
  if (!s2h_decode_gains(data, n, &gains, c->values, c->values_capacity) || order == NULL ||
      gains.n_hands != order->n_hands || gains.n_sources != order->n_sources || gains.n_bands != order->n_bands) {
    return false;
  }
  for (i = 0; i < gains.n_hands; ++i) {
    if (!(c->values[i] > 0.0f)) c->values[i] = 0.0f;
    if (c->values[i] > 1.0f) c->values[i] = 1.0f;
  }
  c->gains = gains;
  c->gains_order = order;
  c->gains_s = S2H_NOW_S();
  c->heard_sequence = gains.sequence;
  return true;
}

bool s2h_is_felt(const s2h_client *c) {
  return c->state == S2H__ONLINE && c->gains_order != NULL && S2H_NOW_S() - c->gains_s <= c->gains_order->watchdog_s;
}

float s2h_intensity(const s2h_client *c, s2h_handle hand) {
  size_t i;
  if (hand < 0 || !s2h_is_felt(c)) return 0.0f;
  for (i = 0; i < c->gains_order->n_hands; ++i) {
    if (c->gains_order->handles[c->gains_order->n_objects + i] == hand) return c->gains.intensities[i];
  }
  return 0.0f;
}

float s2h_gain(const s2h_client *c, s2h_handle hand, s2h_handle source) {
  const s2h__order *order = c->gains_order;
  const s2h_handle *hands, *sources;
  const float *gains;
  size_t i, k, band;
  float loudest = 0.0f;
  if (hand < 0 || source < 0 || !s2h_is_felt(c)) return 0.0f;
  hands = order->handles + order->n_objects;
  sources = hands + order->n_hands;
  for (i = 0; i < order->n_hands && hands[i] != hand; ++i) continue;
  for (k = 0; k < order->n_sources && sources[k] != source; ++k) continue;
  if (i == order->n_hands || k == order->n_sources) return 0.0f;
  gains = c->gains.gains + (i * order->n_sources + k) * order->n_bands;
  for (band = 0; band < order->n_bands; ++band) {
    if (gains[band] > loudest) loudest = gains[band];
  }
  return loudest;
}

const s2h_gains *s2h_last_gains(const s2h_client *c) { return c->gains_order != NULL ? &c->gains : NULL; }

/* ----------------------------------------------------------------------------------------------------- requests */

/* Send a request; `fields` is a JSON object or NULL. Returns whether it was sent. */
static bool s2h__send_request(s2h_client *c, const char *type, uint32_t id, const char *fields) {
  s2h_writer writer = S2H_WRITER;
  uint8_t *out = NULL;
  if (c->n_pending == S2H__MAX_PENDING) {
    s2h__note_error(c, "TooManyRequests", id, "%s was not sent: %d requests wait for their answers. Send fewer.", type,
                    S2H__MAX_PENDING);
    return false;
  }
  s2h_write_begin(&writer, NULL, '{');
  s2h_write_string(&writer, "type", type);
  s2h_write_number(&writer, "id", (double)id);
  s2h__write_fields(&writer, fields);
  s2h_write_end(&writer, '}');
  if (writer.has_failed) {
    s2h__note_error(c, "WrongRequest", id,
                    "%s was not sent: a number is not finite, a field is no JSON, or memory lacks. Correct its fields.",
                    type);
  } else if ((double)writer.n > c->max_server_bytes) {
    s2h__note_error(c, "MessageTooLarge", id,
                    "%s has %.0f bytes; the server takes %.0f. Use boxes or coarser meshes.", type, (double)writer.n,
                    c->max_server_bytes);
  } else {
    out = s2h__queued(c, S2H__TEXT, writer.n, id);
  }
  if (out != NULL) {
    s2h__pending *pending = &c->pending[c->n_pending++];
    memcpy(out, writer.text, writer.n);
    pending->id = id;
    (void)snprintf(pending->type, sizeof pending->type, "%.15s", type);
    (void)s2h__flush(c);
  }
  s2h_writer_free(&writer);
  return out != NULL;
}

static uint32_t s2h__next_id(s2h_client *c) {
  if (++c->last_id == 0) c->last_id = 1;
  return c->last_id;
}

uint32_t s2h_request(s2h_client *c, const char *type, const char *more) {
  uint32_t id = s2h__next_id(c);
  if (c->state != S2H__ONLINE) {
    s2h__note_error(c, "ConnectionLost", id, "%s was not sent: there is no connection now.", type);
    return 0;
  }
  return s2h__send_request(c, type, id, more) ? id : 0;
}

/* Send a request of which the writer has an object, and free that. */
static uint32_t s2h__request_written(s2h_client *c, const char *type, s2h_writer *writer) {
  const char *fields;
  uint32_t id;
  s2h_write_end(writer, '}');
  fields = s2h_writer_text(writer);
  id = s2h_request(c, type, fields != NULL ? fields : "a number that is not finite");
  s2h_writer_free(writer);
  return id;
}

/* Send what is kept for every connection, once there is one. */
static void s2h__send_wanted(s2h_client *c) {
  if (c->play_phase == S2H__TO_RESUME) {
    s2h_writer writer = S2H_WRITER;
    s2h_write_begin(&writer, NULL, '{');
    s2h_write_string(&writer, "session", c->session);
    if (!c->is_watching) s2h_write_string(&writer, "key", c->key_text);
    s2h_write_end(&writer, '}');
    c->play_phase = S2H__RESUMING;
    if (!s2h__send_request(c, c->is_watching ? "watch" : "resume", s2h__next_id(c), s2h_writer_text(&writer))) {
      c->play_phase = S2H__NONE;
    }
    s2h_writer_free(&writer);
  }
  if (c->play_phase == S2H__WANTED && !c->needs_bake) {
    s2h_writer writer = S2H_WRITER;
    s2h_write_begin(&writer, NULL, '{');
    if (c->play_job != 0) s2h_write_number(&writer, "job", (double)c->play_job);
    s2h__write_fields(&writer, c->play_fields);
    s2h_write_end(&writer, '}');
    c->play_phase = S2H__SENT;
    if (!s2h__send_request(c, c->is_watching ? "watch" : "play", c->play_id, s2h_writer_text(&writer))) {
      c->play_phase = S2H__NONE;
    }
    s2h_writer_free(&writer);
  }
  if (c->bake_phase == S2H__TO_FOLLOW) {
    char fields[32];
    (void)snprintf(fields, sizeof fields, "{\"job\":%lu}", (unsigned long)c->bake_job);
    c->bake_phase = S2H__FOLLOWING;
    if (!s2h__send_request(c, "follow", s2h__next_id(c), fields)) c->bake_phase = S2H__WANTED;
  }
  if (c->bake_phase == S2H__WANTED) {
    c->bake_phase = S2H__SENT;
    if (!s2h__send_request(c, "bake", c->bake_id, c->bake_fields)) {
      c->bake_phase = S2H__NONE;
      if (c->needs_bake) c->play_phase = S2H__NONE;
      c->needs_bake = false;
    }
  }
}

/* Keep the object of a writer as `*fields`. Returns the request's number, 0 if something has failed. */
static uint32_t s2h__keep(s2h_client *c, const char *type, s2h_writer *writer, char **fields) {
  uint32_t id = s2h__next_id(c);
  s2h_write_end(writer, '}');
  if (writer->has_failed) {
    s2h__note_error(c, "WrongRequest", id, "%s was not sent: a field is no JSON, or memory lacks. Correct its fields.",
                    type);
    s2h_writer_free(writer);
    return 0;
  }
  S2H_FREE(*fields);
  *fields = writer->text;
  return id;
}

uint32_t s2h_bake(s2h_client *c, const s2h_bake_settings *bake) {
  s2h_writer writer = S2H_WRITER;
  uint32_t id;
  s2h_write_begin(&writer, NULL, '{');
  if (bake->scene != NULL) s2h_write_json(&writer, "scene", bake->scene);
  if (bake->path != NULL) s2h_write_string(&writer, "path", bake->path);
  s2h__write_fields(&writer, bake->more);
  id = s2h__keep(c, "bake", &writer, &c->bake_fields);
  if (id == 0) return 0;
  c->bake_id = id;
  c->bake_job = 0;
  c->bakes_again = false;
  c->bake_phase = S2H__WANTED;
  if (c->state == S2H__ONLINE) s2h__send_wanted(c);
  return c->bake_phase == S2H__NONE ? 0 : id;
}

static void s2h__write_ids(s2h_writer *writer, const char *key, const char *const *ids, size_t n) {
  size_t i;
  s2h_write_begin(writer, key, '[');
  for (i = 0; i < n; ++i) s2h_write_string(writer, NULL, ids[i]);
  s2h_write_end(writer, ']');
}

/* Want a session, in place of one that is watched, or wanted but not active. */
static uint32_t s2h__want_session(s2h_client *c, const char *type, s2h_writer *writer, uint32_t job,
                                  bool needs_bake) {
  uint32_t id;
  if (s2h_is_playing(c)) { /* the server would refuse it */
    s2h__note_error(c, "BridgeError", 0, "%s was not sent: this connection plays; call s2h_leave first.", type);
    s2h_writer_free(writer);
    return 0;
  }
  id = s2h__keep(c, type, writer, &c->play_fields);
  if (id == 0) return 0;
  c->play_id = id;
  c->play_job = job;
  c->is_watching = strcmp(type, "watch") == 0;
  c->needs_bake = needs_bake;
  c->gains_s = S2H__LONG_AGO_S;
  c->play_phase = S2H__WANTED;
  if (c->state == S2H__ONLINE) s2h__send_wanted(c);
  return c->play_phase == S2H__NONE ? 0 : id;
}

uint32_t s2h_play(s2h_client *c, const s2h_play_settings *play) {
  s2h_writer writer = S2H_WRITER;
  s2h_write_begin(&writer, NULL, '{');
  if (play->bundle != NULL) s2h_write_string(&writer, "bundle", play->bundle);
  if (!play->moves_all) s2h__write_ids(&writer, "moving", play->moving, play->n_moving);
  if (play->every_frame) s2h_write_string(&writer, "frames", "every");
  s2h__write_fields(&writer, play->more);
  if (play->job == 0 && play->bundle == NULL && c->bake_phase != S2H__NONE) {
    return s2h__want_session(c, "play", &writer, c->bake_job, c->bake_phase != S2H__BAKED);
  }
  return s2h__want_session(c, "play", &writer, play->job, false);
}

uint32_t s2h_watch(s2h_client *c, const char *session) {
  s2h_writer writer = S2H_WRITER;
  s2h_write_begin(&writer, NULL, '{');
  s2h_write_string(&writer, "session", session);
  return s2h__want_session(c, "watch", &writer, 0, false);
}

uint32_t s2h_leave(s2h_client *c) {
  c->play_phase = S2H__NONE;
  c->needs_bake = false;
  c->gains_s = S2H__LONG_AGO_S;
  return s2h_request(c, "leave", NULL);
}

/* A writer with an object that has one string already. */
static s2h_writer s2h__object_with(const char *key, const char *text) {
  s2h_writer writer = S2H_WRITER;
  s2h_write_begin(&writer, NULL, '{');
  if (key != NULL) s2h_write_string(&writer, key, text);
  return writer;
}

uint32_t s2h_set_source_on(s2h_client *c, const char *source, bool is_on) {
  s2h_writer writer = s2h__object_with("source", source);
  s2h_write_bool(&writer, "on", is_on);
  return s2h__request_written(c, "set_source", &writer);
}

uint32_t s2h_set_source_state(s2h_client *c, const char *source, const char *state) {
  s2h_writer writer = s2h__object_with("source", source);
  s2h_write_string(&writer, "state", state);
  return s2h__request_written(c, "set_source", &writer);
}

uint32_t s2h_set_source_gain_db(s2h_client *c, const char *source, double gain_db) {
  s2h_writer writer = s2h__object_with("source", source);
  s2h_write_number(&writer, "gain_db", gain_db);
  return s2h__request_written(c, "set_source", &writer);
}

uint32_t s2h_set_source_mute(s2h_client *c, const char *source, bool is_mute) {
  s2h_writer writer = s2h__object_with("source", source);
  s2h_write_bool(&writer, "mute", is_mute);
  return s2h__request_written(c, "set_source", &writer);
}

uint32_t s2h_set_user_gain_db(s2h_client *c, double gain_db) {
  s2h_writer writer = s2h__object_with(NULL, NULL);
  s2h_write_number(&writer, "gain_db", gain_db);
  return s2h__request_written(c, "set_user", &writer);
}

uint32_t s2h_set_user_mute(s2h_client *c, bool is_mute) {
  s2h_writer writer = s2h__object_with(NULL, NULL);
  s2h_write_bool(&writer, "mute", is_mute);
  return s2h__request_written(c, "set_user", &writer);
}

uint32_t s2h_strike(s2h_client *c, const char *object, const double point_m[3], double speed_m_s,
                    const char *with_object) {
  s2h_writer writer = s2h__object_with("object", object);
  s2h_write_numbers(&writer, "point_m", point_m, 3);
  s2h_write_number(&writer, "speed_m_s", speed_m_s);
  if (with_object != NULL) s2h_write_string(&writer, "with_object", with_object);
  return s2h__request_written(c, "strike", &writer);
}

uint32_t s2h_add(s2h_client *c, const char *object_json) {
  s2h_writer writer = s2h__object_with(NULL, NULL);
  s2h_write_json(&writer, "object", object_json != NULL ? object_json : "");
  return s2h__request_written(c, "add", &writer);
}

uint32_t s2h_remove(s2h_client *c, const char *object) {
  s2h_writer writer = s2h__object_with("object", object);
  return s2h__request_written(c, "remove", &writer);
}

uint32_t s2h_set_moving(s2h_client *c, const char *const *moving, size_t n_moving) {
  s2h_writer writer = s2h__object_with(NULL, NULL);
  s2h__write_ids(&writer, "moving", moving, n_moving);
  return s2h__request_written(c, "moving", &writer);
}

uint32_t s2h_pause(s2h_client *c) { return s2h_request(c, "pause", NULL); }

uint32_t s2h_unpause(s2h_client *c) { return s2h_request(c, "unpause", NULL); }

uint32_t s2h_explain(s2h_client *c, const char *hand) {
  s2h_writer writer = s2h__object_with("hand", hand);
  return s2h__request_written(c, "explain", &writer);
}

bool s2h_send_picture(s2h_client *c, const char *object, const char *kind, const char *view, const void *file,
                      size_t n_bytes) {
  s2h_writer writer = s2h__object_with(object != NULL ? "object" : NULL, object);
  uint8_t *out = NULL;
  s2h_write_string(&writer, "kind", kind);
  s2h_write_string(&writer, "view", view);
  s2h_write_end(&writer, '}');
  if (c->state != S2H__ONLINE) {
    s2h__note_error(c, "ConnectionLost", 0, "A picture was not sent: there is no connection now.");
  } else if (writer.has_failed || writer.n > 0xFFFF || n_bytes > SIZE_MAX / 2 ||
             (double)n_bytes + (double)writer.n + 8.0 > c->max_server_bytes) {
    s2h__note_error(c, "MessageTooLarge", 0, "A picture has %.0f bytes; the server takes %.0f. Send a smaller one.",
                    (double)n_bytes, c->max_server_bytes);
  } else {
    out = s2h__queued(c, S2H__BINARY, 8 + writer.n + n_bytes, 0);
  }
  if (out != NULL) {
    memcpy(out, "S2HB\x03\x01", 6);
    s2h__put_u16(out + 6, (uint16_t)writer.n);
    memcpy(out + 8, writer.text, writer.n);
    memcpy(out + 8 + writer.n, file, n_bytes);
    (void)s2h__flush(c);
  }
  s2h_writer_free(&writer);
  return out != NULL;
}

/* ------------------------------------------------------------------------------------------------- the connection */

/* Read the URL and find the addresses of its host. Returns what is wrong, NULL if nothing is. */
static const char *s2h__read_url(s2h_client *c) {
  static const char scheme[] = "ws://";
  const char *host = c->url + sizeof scheme - 1, *host_end, *p;
  char name[256], port[8] = "80";
  size_t n, n_port;
  bool is_local, is_numeric = true;
  int family;
  if (strncmp(c->url, scheme, sizeof scheme - 1) != 0) return "it must begin with ws://";
  for (p = c->url; *p != '\0'; ++p) {
    /* Else text of the URL could add headers to the request. */
    if ((unsigned char)*p <= 0x20 || (unsigned char)*p >= 0x7F || *p == '#' || *p == '@') {
      return "it has a character that an address cannot have";
    }
  }
  c->path = strchr(host, '/');
  if (c->path == NULL) c->path = host + strlen(host);
  n = (size_t)(c->path - host);
  if (*c->path == '\0') c->path = "/";
  if (n == 0 || n >= sizeof c->host || strlen(c->path) > 1000) return "its host is missing, or its path is too long";
  memcpy(c->host, host, n);
  c->host[n] = '\0';
  host = c->host;
  if (*host == '[') {
    host_end = strchr(host, ']');
    if (host_end == NULL) return "its host has [ without ]";
    ++host;
    p = host_end + 1;
  } else {
    host_end = host + strcspn(host, ":");
    p = host_end;
  }
  n = (size_t)(host_end - host);
  if (n == 0 || n >= sizeof name) return "its host is missing or too long";
  memcpy(name, host, n);
  name[n] = '\0';
  if (*p == ':') {
    n_port = strlen(p + 1);
    if (n_port == 0 || n_port > 5 || strspn(p + 1, "0123456789") != n_port || atol(p + 1) > 65535 || atol(p + 1) == 0) {
      return "its port is no number from 1 to 65535";
    }
    memcpy(port, p + 1, n_port + 1);
  } else if (*p != '\0') {
    return "its port is no number from 1 to 65535";
  }
  is_local = s2h__is_word(name, strlen(name), "localhost");
  /* Only a name of another host waits for the network: once, here. */
  for (family = 0; family < 2 && (family == 0 || is_local || (is_numeric && c->n_addresses == 0)); ++family) {
    struct addrinfo wanted, *found = NULL, *one;
    memset(&wanted, 0, sizeof wanted);
    wanted.ai_socktype = SOCK_STREAM;
    is_numeric = family == 0 || is_local;
    wanted.ai_flags = is_numeric ? AI_NUMERICHOST : 0;
    if (getaddrinfo(is_local ? (family == 0 ? "127.0.0.1" : "::1") : name, port, &wanted, &found) != 0) continue;
    for (one = found; one != NULL && c->n_addresses < S2H__MAX_ADDRESSES; one = one->ai_next) {
      if ((size_t)one->ai_addrlen > sizeof c->addresses[0]) continue;
      memcpy(&c->addresses[c->n_addresses], one->ai_addr, (size_t)one->ai_addrlen);
      c->address_bytes[c->n_addresses++] = (socklen_t)one->ai_addrlen;
    }
    freeaddrinfo(found);
  }
  return c->n_addresses > 0 ? NULL : "its host has no address";
}

/* Write `hello` as the first message. */
static bool s2h__write_hello(s2h_client *c, s2h_writer *writer) {
  s2h_write_begin(writer, NULL, '{');
  s2h_write_number(writer, "version", 1.0);
  s2h_write_string(writer, "client", c->name);
  if (c->token != NULL) s2h_write_string(writer, "token", c->token);
  s2h_write_end(writer, '}');
  return !writer->has_failed && writer->n + 64 <= S2H__MAX_HELLO_BYTES;
}

s2h_client *s2h_create(const s2h_settings *settings) {
  static const s2h_settings none = {NULL, NULL, NULL, 0, 0};
  s2h_client *c = (s2h_client *)S2H_REALLOC(NULL, sizeof *c);
  const char *problem;
  if (c == NULL) return NULL;
  memset(c, 0, sizeof *c);
  if (settings == NULL) settings = &none;
  c->socket = S2H__NO_SOCKET;
  c->gains_s = S2H__LONG_AGO_S;
  c->wait_s = S2H__FIRST_WAIT_S;
  c->max_receive = settings->max_receive_bytes ? settings->max_receive_bytes : (size_t)8 << 20;
  c->max_send = settings->max_send_bytes ? settings->max_send_bytes : (size_t)40 << 20;
  if (c->max_receive > INT32_MAX) c->max_receive = INT32_MAX;
  if (c->max_send > INT32_MAX) c->max_send = INT32_MAX;
  c->url = s2h__copy_of(settings->url != NULL ? settings->url : "ws://127.0.0.1:7862/");
  c->name = s2h__copy_of(settings->name != NULL ? settings->name : "scene2hap-c 0.1.0");
  c->token = settings->token != NULL ? s2h__copy_of(settings->token) : NULL;
#ifdef _WIN32
  {
    WSADATA data;
    (void)WSAStartup(MAKEWORD(2, 2), &data);
  }
#endif
  if (c->url == NULL || c->name == NULL || (settings->token != NULL && c->token == NULL)) {
    s2h_destroy(c);
    return NULL;
  }
  problem = s2h__read_url(c);
  c->state = S2H__WAITING;
  if (problem != NULL) s2h__lose(c, 0, true, "The URL %.200s cannot be used: %s.", c->url, problem);
  return c;
}

void s2h_destroy(s2h_client *c) {
  size_t i;
  if (c == NULL) return;
  if (c->state >= S2H__GREETING && s2h__flush(c)) {
    static const uint8_t normal[2] = {1000 >> 8, 1000 & 0xFF};
    s2h__stage(c, 0x80 | S2H__CLOSE, normal, 2);
    if (!c->cannot_send) (void)S2H_SEND(c->socket, c->out, c->out_end);
  }
  s2h__forget_connection(c);
  s2h__forget_orders(c);
  for (i = 0; i < c->n_names; ++i) S2H_FREE(c->names[i].text);
  S2H_FREE(c->names);
  S2H_FREE(c->buckets);
  S2H_FREE(c->url);
  S2H_FREE(c->name);
  S2H_FREE(c->token);
  S2H_FREE(c->message);
  S2H_FREE(c->queue);
  S2H_FREE(c->bake_fields);
  S2H_FREE(c->play_fields);
  S2H_FREE(c->poses);
  S2H_FREE(c->values);
  S2H_FREE(c->text);
  S2H_FREE(c);
#ifdef _WIN32
  (void)WSACleanup();
#endif
}

/* Begin to connect to the address in turn, or lose. */
static void s2h__open(s2h_client *c) {
  const struct sockaddr *to = (const struct sockaddr *)&c->addresses[c->address];
  c->socket = socket(to->sa_family, SOCK_STREAM, 0);
  c->state = S2H__CONNECTING;
  c->deadline_s = S2H_NOW_S() + S2H__CONNECT_S;
  if (c->socket != S2H__NO_SOCKET && s2h__set_options(c->socket)) {
    if (connect(c->socket, to, c->address_bytes[c->address]) == 0 || s2h__would_block(s2h__socket_error())) return;
  }
  c->deadline_s = S2H__LONG_AGO_S; /* s2h__connect takes the next address */
}

/* Go on with connecting. Returns whether something has changed. */
static bool s2h__connect(s2h_client *c) {
  bool is_over = S2H_NOW_S() > c->deadline_s;
  uint8_t nonce[16];
  int n;
  if (!is_over && s2h__wait_socket(c->socket, false, true, 0.0)) {
    int error = 0;
    socklen_t n_bytes = sizeof error;
    if (getsockopt(c->socket, SOL_SOCKET, SO_ERROR, (char *)&error, &n_bytes) == 0 && error == 0) {
      if (!s2h__take_random(c, nonce, sizeof nonce)) {
        s2h__lose(c, 0, false, "The system gives no random numbers, which a WebSocket needs.");
        return true;
      }
      s2h__base64(nonce, sizeof nonce, c->nonce);
      n = snprintf((char *)c->out, sizeof c->out,
                   "GET %s HTTP/1.1\r\nHost: %s\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                   "Sec-WebSocket-Key: %s\r\nSec-WebSocket-Version: 13\r\n\r\n",
                   c->path, c->host, c->nonce);
      c->out_begin = 0;
      c->out_end = (size_t)n;
      c->state = S2H__HANDSHAKE;
      c->deadline_s = S2H_NOW_S() + S2H__GREETING_S;
      return true;
    }
    is_over = true;
  }
  if (!is_over) return false;
  if (c->socket != S2H__NO_SOCKET) s2h__close_socket(c->socket);
  c->socket = S2H__NO_SOCKET;
  c->address = (c->address + 1) % c->n_addresses;
  if (c->address != 0) s2h__open(c);
  else s2h__lose(c, 0, false, "No connection to %s. Is `scene2hap bridge` running there?", c->host);
  return true;
}

/* Go on with the handshake. Returns whether something has changed. */
static bool s2h__shake_hands(s2h_client *c) {
  s2h_writer writer = S2H_WRITER;
  const char *head = (const char *)c->in, *problem;
  size_t n = 0;
  int received;
  (void)s2h__flush(c);
  received = s2h__receive(c);
  if (received < 0) return true;
  while (n + 4 <= c->in_end && n < S2H__MAX_HEAD_BYTES && memcmp(head + n, "\r\n\r\n", 4) != 0) ++n;
  if (n + 4 > c->in_end || n == S2H__MAX_HEAD_BYTES) {
    if (n == S2H__MAX_HEAD_BYTES) s2h__lose(c, 0, false, "%s answers with too long a head; it is no bridge.", c->host);
    else if (received == 0 && S2H_NOW_S() > c->deadline_s) s2h__lose(c, 0, false, "%s does not answer.", c->host);
    else return received > 0;
    return true;
  }
  problem = s2h__head_problem(head, n + 4, c->nonce);
  if (problem != NULL) {
    char line[64];
    size_t i;
    for (i = 0; i < sizeof line - 1 && head[i] >= 0x20 && head[i] < 0x7F; ++i) line[i] = head[i];
    line[i] = '\0';
    s2h__lose(c, 0, false, "%s answers \"%s\": %s.", c->host, line, problem);
    return true;
  }
  c->in_begin = n + 4;
  c->state = S2H__GREETING;
  c->max_server_bytes = S2H__MAX_HELLO_BYTES;
  if (!s2h__write_hello(c, &writer)) {
    s2h__lose(c, 0, true, "Name and token are longer than the %d bytes of a hello.", S2H__MAX_HELLO_BYTES);
  } else if (!s2h__send_request(c, "hello", s2h__next_id(c), s2h_writer_text(&writer))) {
    s2h__lose(c, 0, false, "Not enough memory to say hello.");
  }
  s2h_writer_free(&writer);
  return true;
}

void s2h_wait(s2h_client *c, double timeout_s) {
  double left_s = c->deadline_s - S2H_NOW_S();
  if (c->has_offline || c->n_notes > 0 || !(timeout_s > 0.0)) return;
  if (c->state >= S2H__GREETING && c->in_begin < c->in_end) return;
  if (timeout_s > 1.0) timeout_s = 1.0; /* so that silence is noticed */
  if (c->state < S2H__ONLINE && c->state != S2H__STOPPED && left_s < timeout_s) timeout_s = left_s > 0.0 ? left_s : 0.0;
  if (c->socket == S2H__NO_SOCKET) {
    s2h__sleep(timeout_s);
  } else if (c->state == S2H__CONNECTING) {
    (void)s2h__wait_socket(c->socket, false, true, timeout_s);
  } else {
    (void)s2h__wait_socket(c->socket, true, c->out_begin < c->out_end && !c->cannot_send, timeout_s);
  }
}

/* -------------------------------------------------------------------------------------------------------- events */

/* The type of the request that a message answers, "" for none; it no longer waits. */
static void s2h__take_pending(s2h_client *c, uint32_t id, char type[16]) {
  size_t i;
  type[0] = '\0';
  for (i = 0; i < c->n_pending; ++i) {
    if (c->pending[i].id == id) {
      memcpy(type, c->pending[i].type, 16);
      memmove(&c->pending[i], &c->pending[i + 1], (c->n_pending - i - 1) * sizeof *c->pending);
      --c->n_pending;
      return;
    }
  }
}

/* Decode a text of a message into memory that lasts until the next event. */
static const char *s2h__event_text(s2h_client *c, s2h_json value) {
  const char *behind = s2h__kind(value) == '"' ? s2h__skip_string(value.at, value.end) : NULL;
  char *grown;
  if (behind == NULL) return "";
  grown = (char *)s2h__grown(c->text, &c->text_capacity, (size_t)(behind - value.at), 1);
  if (grown == NULL) return "(not enough memory for the text)";
  c->text = grown;
  (void)s2h_json_string(value, grown, (size_t)(behind - value.at));
  return grown;
}

/* Take the names of a session that begins. Returns false if they make no sense. */
static bool s2h__take_session(s2h_client *c, s2h_json message) {
  char session[sizeof c->session], key[sizeof c->key_text];
  int i;
  if (!s2h_json_string(s2h_json_get(message, "session"), session, sizeof session)) return false;
  memset(key, 0, sizeof key);
  if (!c->is_watching) {
    if (!s2h_json_string(s2h_json_get(message, "key"), key, sizeof key) || strlen(key) != 16) return false;
    for (i = 0; i < 8; ++i) {
      int high = s2h__hex_digit(key[2 * i]), low = s2h__hex_digit(key[2 * i + 1]);
      if (high < 0 || low < 0) return false;
      c->key[i] = (uint8_t)(high << 4 | low);
    }
  }
  s2h__forget_orders(c);
  if (!s2h__take_order(c, message)) return false;
  memcpy(c->session, session, sizeof session);
  memcpy(c->key_text, key, sizeof key);
  c->sequence = s2h__json_uint(s2h_json_get(message, "sequence"), UINT32_MAX, 0);
  c->heard_sequence = c->poses_sequence = c->sequence;
  return true;
}

static bool s2h__wrong_message(s2h_event *event, const char *text) {
  event->type = S2H_ERROR;
  event->error = "WrongMessage";
  event->text = text;
  event->message = s2h__no_json();
  return true;
}

/* Take an `error`. Returns false if the game need not know. */
static bool s2h__take_error(s2h_client *c, s2h_event *event, const char *request) {
  (void)s2h_json_string(s2h_json_get(event->message, "error"), c->error, sizeof c->error);
  event->type = S2H_ERROR;
  event->error = c->error;
  event->text = s2h__event_text(c, s2h_json_get(event->message, "message"));
  if (c->play_phase == S2H__RESUMING && (strcmp(request, "resume") == 0 || strcmp(request, "watch") == 0)) {
    event->request = c->play_id;
    c->play_phase = S2H__NONE;
    if (!c->is_watching && strcmp(c->error, "UnknownSession") == 0) {
      c->play_phase = S2H__WANTED; /* it ended, or the server was restarted */
      return false;
    }
  } else if (c->play_phase == S2H__SENT && event->request != 0 && event->request == c->play_id) {
    c->play_phase = S2H__NONE;
    if (c->play_job != 0 && c->play_job == c->bake_job && c->bake_phase == S2H__BAKED && c->bake_epoch != c->epoch) {
      /* The job was of an earlier connection: the server was restarted, or keeps too many since. */
      c->bake_phase = c->play_phase = S2H__WANTED;
      c->needs_bake = c->bakes_again = true;
      return false;
    }
  } else if (c->bake_phase == S2H__FOLLOWING && strcmp(request, "follow") == 0) {
    c->bake_phase = S2H__WANTED;
    return false;
  } else if ((c->bake_phase == S2H__SENT && event->request != 0 && event->request == c->bake_id) ||
             (c->bake_phase == S2H__BAKING && event->job != 0 && event->job == c->bake_job)) {
    event->request = c->bake_id;
    c->bake_phase = S2H__NONE;
    if (c->needs_bake) c->play_phase = S2H__NONE;
    c->needs_bake = false;
  }
  return true;
}

/* Take a text message. Returns whether the game gets an event. */
static bool s2h__take_text(s2h_client *c, s2h_event *event, const char *text, size_t n) {
  s2h_json message = s2h_json_parse(text, n);
  char request[16];
  const char *type = c->type;
  if (s2h__kind(message) != '{' || !s2h_json_string(s2h_json_get(message, "type"), c->type, sizeof c->type)) {
    return s2h__wrong_message(event, "A message of the server is no JSON object with a type.");
  }
  event->message = message;
  event->request = s2h__json_uint(s2h_json_get(message, "re"), UINT32_MAX, 0);
  event->job = s2h__json_uint(s2h_json_get(message, "job"), UINT32_MAX, 0);
  s2h__take_pending(c, event->request, request);
  if (strcmp(type, "error") == 0) return s2h__take_error(c, event, request);
  if (c->state == S2H__GREETING) {
    if (strcmp(type, "welcome") != 0 || strcmp(request, "hello") != 0) return false;
    c->state = S2H__ONLINE;
    ++c->epoch;
    c->online_s = S2H_NOW_S();
    c->max_server_bytes = s2h_json_number(s2h_json_get(message, "max_message_bytes"), 1e9);
    c->heartbeat_s = s2h_json_number(s2h_json_get(message, "heartbeat_s"), 2.0);
    if (!(c->heartbeat_s >= 0.4)) c->heartbeat_s = 0.4;
    if (c->heartbeat_s > 60.0) c->heartbeat_s = 60.0;
    event->type = S2H_ONLINE;
  } else if (strcmp(type, "baking") == 0 &&
             (c->bake_phase == S2H__FOLLOWING ? strcmp(request, "follow") == 0
                                              : c->bake_phase == S2H__SENT && event->request == c->bake_id)) {
    c->bake_phase = S2H__BAKING;
    c->bake_job = event->job;
    event->request = c->bake_id;
    event->type = S2H_BAKING;
  } else if (strcmp(type, "progress") == 0) {
    event->type = S2H_PROGRESS;
    event->text = s2h__event_text(c, s2h_json_get(message, "item"));
    if (event->text[0] == '\0') event->text = s2h__event_text(c, s2h_json_get(message, "stage"));
  } else if (strcmp(type, "baked") == 0) {
    event->type = S2H_BAKED;
    if ((c->bake_phase == S2H__BAKING || c->bake_phase == S2H__FOLLOWING) && event->job == c->bake_job) {
      event->request = c->bake_id;
      c->bake_phase = S2H__BAKED;
      c->bake_epoch = c->epoch;
      if (c->needs_bake) c->play_job = c->bake_job;
      c->needs_bake = false;
      if (c->bakes_again) event->type = S2H_NOTHING;
      c->bakes_again = false;
      return event->type != S2H_NOTHING;
    }
  } else if ((strcmp(type, "playing") == 0 || strcmp(type, "watching") == 0) &&
             (c->play_phase == S2H__RESUMING ? strcmp(request, c->is_watching ? "watch" : "resume") == 0
                                             : c->play_phase == S2H__SENT && event->request == c->play_id)) {
    event->type = S2H_PLAYING;
    event->request = c->play_id;
    event->is_resumed = c->play_phase == S2H__RESUMING;
    c->play_phase = S2H__NONE;
    if (!s2h__take_session(c, message)) return s2h__wrong_message(event, "The session of the server makes no sense.");
    c->play_phase = S2H__ACTIVE;
  } else if (strcmp(type, "order") == 0) {
    if (c->play_phase != S2H__ACTIVE) return false;
    if (!s2h__take_order(c, message)) return s2h__wrong_message(event, "An order of the server makes no sense.");
    event->type = S2H_ORDER;
  } else if (strcmp(type, "impact") == 0) {
    event->type = S2H_IMPACT;
  } else if (strcmp(type, "warning") == 0) {
    event->type = S2H_WARNING;
    event->text = s2h__event_text(c, s2h_json_get(message, "message"));
  } else if (strcmp(type, "state") == 0) {
    event->type = S2H_STATE;
    event->text = s2h__event_text(c, s2h_json_get(message, "is"));
    /* While it is not active, another one is wanted. */
    if (c->is_watching && c->play_phase == S2H__ACTIVE && strcmp(event->text, "ended") == 0) c->play_phase = S2H__NONE;
  } else if (strcmp(type, "left") == 0 && strcmp(request, "leave") == 0) {
    event->type = S2H_LEFT;
  } else if (request[0] != '\0') {
    event->type = S2H_ANSWER;
    event->text = s2h__event_text(c, s2h_json_get(message, "text")); /* of an explanation */
  } else {
    return false; /* of a later server */
  }
  return true;
}

/* Take a binary message. Returns whether the game gets an event. */
static bool s2h__take_binary(s2h_client *c, s2h_event *event, const uint8_t *data, size_t n) {
  /* Later servers may have other kinds. After s2h_leave, gains may still be on their way. */
  if (c->play_phase != S2H__ACTIVE || (n >= 6 && memcmp(data, "S2HB", 4) == 0 && data[4] != 2)) return false;
  if (!s2h__take_gains(c, data, n)) {
    s2h__report_once(c, S2H__WRONG_GAINS, "they do not fit the session, so that they are left out.", "gains");
    return false;
  }
  event->type = S2H_GAINS;
  event->gains = &c->gains;
  return true;
}

/* Hand over an error of this side, if there is one. */
static bool s2h__take_note(s2h_client *c, s2h_event *event) {
  size_t n;
  char *grown;
  if (c->n_notes == 0) return false;
  n = strlen(c->notes[0].text) + 1;
  grown = (char *)s2h__grown(c->text, &c->text_capacity, n, 1);
  if (grown != NULL) {
    c->text = grown;
    memcpy(grown, c->notes[0].text, n);
  }
  event->type = S2H_ERROR;
  event->error = c->notes[0].error;
  event->text = grown != NULL ? grown : "There is not enough memory.";
  event->request = c->notes[0].request;
  memmove(&c->notes[0], &c->notes[1], --c->n_notes * sizeof *c->notes);
  return true;
}

/* Hand over that a request was lost with its connection, if one was. */
static bool s2h__take_lost(s2h_client *c, s2h_event *event) {
  static const char *const kept[] = {"hello", "bake", "follow", "play", "watch", "resume"};
  while (c->n_pending > 0) {
    char type[16];
    uint32_t id = c->pending[0].id;
    size_t i;
    s2h__take_pending(c, id, type);
    for (i = 0; i < sizeof kept / sizeof *kept && strcmp(type, kept[i]) != 0; ++i) continue;
    if (i < sizeof kept / sizeof *kept) continue;
    event->type = S2H_ERROR;
    event->error = "ConnectionLost";
    event->text = "The connection was lost before an answer came. Send the request again.";
    event->request = id;
    return true;
  }
  return false;
}

static bool s2h__poll(s2h_client *c, s2h_event *event) {
  for (;;) {
    int received;
    if (s2h__take_note(c, event)) return true;
    if (c->state <= S2H__WAITING && s2h__take_lost(c, event)) return true;
    if (c->has_offline) {
      c->has_offline = false;
      event->type = S2H_OFFLINE;
      event->text = c->why;
      event->code = c->close_code;
      event->wait_s = c->state == S2H__STOPPED ? -1.0 : c->wait_s;
      c->wait_s = 2.0 * c->wait_s < S2H__LONGEST_WAIT_S ? 2.0 * c->wait_s : S2H__LONGEST_WAIT_S;
      return true;
    }
    switch (c->state) {
      case S2H__STOPPED:
        return false;
      case S2H__WAITING:
        if (S2H_NOW_S() < c->deadline_s) return false;
        s2h__open(c);
        continue;
      case S2H__CONNECTING:
        if (!s2h__connect(c)) return false;
        continue;
      case S2H__HANDSHAKE:
        if (!s2h__shake_hands(c)) return false;
        continue;
      case S2H__ONLINE:
        s2h__send_wanted(c);
        break;
      default:
        break;
    }
    (void)s2h__flush(c);
    received = s2h__next_message(c);
    if (received == 0) {
      double now_s = S2H_NOW_S();
      (void)s2h__flush(c); /* of pongs */
      if (c->cannot_send) {
        s2h__lose(c, 0, false, "The connection to %s was lost.", c->host);
      } else if (c->state == S2H__GREETING ? now_s > c->deadline_s
                                           : now_s - c->heard_s > S2H__SILENT_HEARTBEATS * c->heartbeat_s) {
        s2h__lose(c, 0, false, "%s is silent.", c->host);
      } else if (c->n_notes == 0) {
        return false;
      }
    } else if (received > 0) {
      bool is_event = c->message_opcode == S2H__TEXT
                          ? s2h__take_text(c, event, c->message, c->n_message)
                          : s2h__take_binary(c, event, (const uint8_t *)c->message, c->n_message);
      if (is_event) return true;
      memset(event, 0, sizeof *event);
      event->error = event->text = "";
    }
  }
}

bool s2h_poll(s2h_client *c, s2h_event *event) {
  memset(event, 0, sizeof *event);
  event->error = event->text = "";
  if (c->n_events < S2H__MAX_EVENTS && s2h__poll(c, event)) {
    ++c->n_events;
    return true;
  }
  c->n_events = c->n_bytes = 0;
  return false;
}

#endif /* SCENE2HAP_CLIENT_IMPLEMENTATION */
