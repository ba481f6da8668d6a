/*
 * The game of "Check a client" in docs/bridge-protocol.md of scene2hap, without anything to see.
 *
 *   cc -O2 -o example_game example_game.c
 *   scene2hap bridge --check ./example_game
 *
 * Settings are environment variables: SCENE2HAP_URL, SCENE2HAP_TOKEN, SCENE2HAP_FRAMES, SCENE2HAP_RATE_HZ and
 * SCENE2HAP_OUT, as the page says. With SCENE2HAP_SELF_TEST=1 it prints the page's binary examples instead.
 */
#define SCENE2HAP_CLIENT_IMPLEMENTATION
#include "scene2hap_client.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define N_OBJECTS 30

static const double TABLE_SIZE_M[3] = {2.4, 0.04, 0.8};
static const double PHONE_SIZE_M[3] = {0.07, 0.008, 0.15};
static const double SHAVER_SIZE_M[3] = {0.05, 0.04, 0.16};
static const double CUP_SIZE_M[3] = {0.08, 0.09, 0.08};

typedef struct game {
  char ids[N_OBJECTS][16];
  s2h_handle objects[N_OBJECTS], left, right;
  long n_frames, first, heard; /* first: of this session; heard: frames whose gains have come */
  double rate_hz, begun_s;
  FILE *out;
} game;

static void put(double out[3], double x, double y, double z) {
  out[0] = x;
  out[1] = y;
  out[2] = z;
}

/* Where an object is in a frame. Operations stand in the order in which the page has them. */
static void position_m(long frame, int object, double out[3]) {
  static const double rows_z_m[3] = {-0.35, 0.0, 0.35};
  if (object == 0) {
    put(out, 0.0, 0.7, 0.0);
  } else if (object == 1) {
    put(out, -1 + (double)frame / 1800, 0.724, 0.2);
  } else if (object == 2) {
    long i = frame % 3600;
    put(out, 0.5, i >= 1200 && i < 1800 ? 0.94 : 0.74, -0.2);
  } else {
    long place = (frame + 37 * object) % 240 - 120;
    double d = (double)(place < 0 ? -place : place) / 120;
    put(out, -0.9 + 0.2 * ((object - 3) % 9) + 0.05 * d, 0.765, rows_z_m[(object - 3) / 9]);
  }
}

static void single(const double in[3], double rise_m, float out[3]) {
  out[0] = (float)in[0];
  out[1] = (float)(in[1] + rise_m);
  out[2] = (float)in[2];
}

static void find_handles(s2h_client *client, game *it) {
  int k;
  for (k = 0; k < N_OBJECTS; ++k) {
    if (k < 3) (void)strcpy(it->ids[k], k == 0 ? "table" : k == 1 ? "phone" : "shaver");
    else (void)snprintf(it->ids[k], sizeof it->ids[k], "cup_%02d", k);
    it->objects[k] = s2h_handle_of(client, it->ids[k]);
  }
  it->left = s2h_handle_of(client, "left");
  it->right = s2h_handle_of(client, "right");
}

static void bake(s2h_client *client, const game *it) {
  s2h_writer scene = S2H_WRITER;
  s2h_bake_settings settings = {NULL, NULL, NULL};
  int k;
  s2h_scene_begin(&scene, "check", 'y');
  for (k = 0; k < N_OBJECTS; ++k) {
    const char *name = k == 0 ? "Wooden table" : k == 1 ? "Smartphone" : k == 2 ? "Electric shaver" : "Coffee mug";
    const double *size_m = k == 0 ? TABLE_SIZE_M : k == 1 ? PHONE_SIZE_M : k == 2 ? SHAVER_SIZE_M : CUP_SIZE_M;
    double at_m[3];
    position_m(0, k, at_m);
    s2h_scene_box(&scene, it->ids[k], name, at_m, NULL, size_m);
  }
  s2h_scene_end(&scene);
  settings.scene = s2h_writer_text(&scene);
  if (settings.scene != NULL) (void)s2h_bake(client, &settings);
  s2h_writer_free(&scene);
}

/* Play what is baked, once it is. */
static void play(s2h_client *client, const game *it) {
  s2h_play_settings settings = {0, NULL, NULL, 0, false, false, NULL};
  const char *moving[N_OBJECTS];
  int k;
  for (k = 0; k < N_OBJECTS; ++k) moving[k] = it->ids[k];
  settings.moving = moving;
  settings.n_moving = N_OBJECTS;
  settings.every_frame = true;
  (void)s2h_play(client, &settings);
}

/* Send a frame if it is time for one. */
static void send_next(s2h_client *client, const game *it) {
  /* The client's sequence is that of the last frame, or after a lost connection of the last that the server took. */
  long frame = it->first + (long)s2h_sequence(client);
  double at_m[3];
  float point_m[3];
  int k;
  if (!s2h_is_playing(client) || frame >= it->n_frames) return;
  if (it->rate_hz <= 0.0 ? frame > it->heard : s2h__now_s() < it->begun_s + (double)frame / it->rate_hz) return;
  for (k = 0; k < N_OBJECTS; ++k) {
    position_m(frame, k, at_m);
    single(at_m, 0.0, point_m);
    (void)s2h_set_pose(client, it->objects[k], point_m, NULL);
  }
  if (frame % 600 >= 540) {
    s2h_lift(client, it->left);
  } else {
    static const float on_table_m[3] = {-0.5f, 0.72f, 0.1f};
    (void)s2h_touch(client, it->left, it->objects[0], on_table_m);
  }
  k = frame % 1200 < 600 ? 1 : 12;
  position_m(frame, k, at_m);
  single(at_m, k == 1 ? 0.004 : 0.045, point_m);
  (void)s2h_touch(client, it->right, it->objects[k], point_m);
  (void)s2h_send_frame(client, (double)frame / 60);
}

/* A line of the sequence, and the loudest band of each source at each hand. */
static void write_line(game *it, const s2h_gains *gains) {
  long frame = it->first + (long)gains->sequence;
  size_t i, band;
  if (frame <= it->heard) return; /* the server repeats the last gains after a lost connection */
  it->heard = frame;
  (void)fprintf(it->out, "%ld", frame);
  for (i = 0; i < (size_t)gains->n_hands * gains->n_sources; ++i) {
    const float *bands = gains->gains + i * gains->n_bands;
    float loudest = bands[0];
    for (band = 1; band < gains->n_bands; ++band) loudest = bands[band] > loudest ? bands[band] : loudest;
    (void)fprintf(it->out, ",%.9g", (double)loudest);
  }
  (void)fprintf(it->out, "\n");
}

/* Returns the program's status once the game is over, else -1. */
static int take(s2h_client *client, game *it, const s2h_event *event) {
  switch (event->type) {
    case S2H_PLAYING:
      /* The server may have forgotten the session: then another one goes on where the last one ended. */
      if (!event->is_resumed) it->first = it->heard;
      it->begun_s = s2h__now_s();
      if (it->rate_hz > 0.0) it->begun_s -= (double)(it->first + (long)s2h_sequence(client)) / it->rate_hz;
      (void)fprintf(stderr, "%s from frame %ld\n", event->is_resumed ? "resumed" : "playing", it->heard + 1);
      break;
    case S2H_GAINS:
      write_line(it, event->gains);
      if (it->heard >= it->n_frames && s2h_leave(client) == 0) return 1;
      break;
    case S2H_OFFLINE:
      (void)fprintf(stderr, "offline: %s\n", event->text);
      if (event->wait_s < 0.0) return 1;
      break;
    case S2H_ERROR:
      (void)fprintf(stderr, "%s: %s\n", event->error, event->text);
      return 1;
    case S2H_LEFT:
      return 0;
    default:
      break;
  }
  return -1;
}

/* Print the page's frame as the client encodes it, and the page's gains as it decodes them. */
static int self_test(void) {
  static const uint8_t key[8] = {0x00, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0xff};
  static const float pose[7] = {0.25f, 0.724f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f};
  static const s2h_touch_row touch = {0, 1, {0.5f, 0.72f, 0.0f}};
  static const char *const gains_hex =
      "5332484202010100000000000000000007000000000000000000""00000000e03f"
      "02000100010000000000003e000000000000003f00000000";
  uint8_t bytes[128];
  float values[32];
  s2h_gains gains;
  size_t n = s2h_frame_bytes(1, 1), i;
  s2h_encode_frame(bytes, 1, key, 7, 0.5, pose, 1, &touch, 1);
  (void)printf("frame ");
  for (i = 0; i < n; ++i) (void)printf("%02x", bytes[i]);
  n = strlen(gains_hex) / 2;
  for (i = 0; i < n; ++i) {
    char digits[3] = {gains_hex[2 * i], gains_hex[2 * i + 1], '\0'};
    bytes[i] = (uint8_t)strtoul(digits, NULL, 16);
  }
  if (!s2h_decode_gains(bytes, n, &gains, values, 32)) return 1;
  (void)printf("\nof %s\nlayout %u sequence %lu skipped %lu time %g\n", gains_hex, gains.layout,
               (unsigned long)gains.sequence, (unsigned long)gains.n_skipped, gains.time_s);
  (void)printf("intensities %g %g\ngains %g %g\n", (double)gains.intensities[0], (double)gains.intensities[1],
               (double)gains.gains[0], (double)gains.gains[1]);
  return 0;
}

int main(void) {
  s2h_settings settings = {NULL, NULL, "scene2hap-c-example 0.1.0", 0, 0};
  const char *frames = getenv("SCENE2HAP_FRAMES"), *rate_hz = getenv("SCENE2HAP_RATE_HZ");
  const char *out = getenv("SCENE2HAP_OUT");
  s2h_client *client;
  s2h_event event;
  int status = -1;
  game it;
  if (getenv("SCENE2HAP_SELF_TEST") != NULL) return self_test();
  memset(&it, 0, sizeof it);
  settings.url = getenv("SCENE2HAP_URL");
  settings.token = getenv("SCENE2HAP_TOKEN");
  it.n_frames = frames != NULL ? strtol(frames, NULL, 10) : 600;
  it.rate_hz = rate_hz != NULL ? strtod(rate_hz, NULL) : 60.0;
  it.out = out != NULL ? fopen(out, "w") : stdout;
  client = s2h_create(&settings);
  if (it.out == NULL || client == NULL) return 1;
  find_handles(client, &it);
  bake(client, &it);
  play(client, &it);
  while (status < 0) {
    send_next(client, &it);
    if (s2h_poll(client, &event)) status = take(client, &it, &event);
    else s2h_wait(client, it.rate_hz > 0.0 ? 0.001 : 0.1);
  }
  s2h_destroy(client);
  if (it.out != stdout && fclose(it.out) != 0) return 1;
  return status;
}
