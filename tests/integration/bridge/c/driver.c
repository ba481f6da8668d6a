/*
 * Does with the C client what lines of standard input say, and prints what comes of it as lines of JSON.
 *
 * Behind each command comes {"did": command}. Events come as {"event": type, ...} during `until` and `run`.
 * SCENE2HAP_DRIVER_LOCALE: a locale for numbers, which must change nothing.
 */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L /* for clock_gettime */
#endif
#include "scene2hap_client.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const char *const NAMES[] = {"nothing", "online", "offline", "error", "warning", "baking", "progress", "baked",
                                    "playing", "order", "gains", "impact", "state", "answer", "left"};

static char line[1 << 20];
static s2h_client *client;

static double now_s(void) {
  struct timespec now;
  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void print(s2h_writer *writer) {
  const char *text;
  s2h_write_end(writer, '}');
  text = s2h_writer_text(writer);
  (void)printf("%s\n", text != NULL ? text : "{\"failed\": true}");
  s2h_writer_free(writer);
}

static s2h_writer begin(void) {
  s2h_writer writer = S2H_WRITER;
  s2h_write_begin(&writer, NULL, '{');
  return writer;
}

static void print_number(const char *key, double number) {
  s2h_writer writer = begin();
  s2h_write_number(&writer, key, number);
  print(&writer);
}

static void print_event(const s2h_event *event) {
  s2h_writer writer = begin();
  s2h_write_string(&writer, "event", NAMES[event->type]);
  s2h_write_number(&writer, "request", event->request);
  s2h_write_number(&writer, "job", event->job);
  s2h_write_string(&writer, "error", event->error);
  s2h_write_string(&writer, "text", event->text);
  s2h_write_number(&writer, "code", event->code);
  s2h_write_number(&writer, "wait_s", event->wait_s);
  s2h_write_bool(&writer, "is_resumed", event->is_resumed);
  s2h_write_number(&writer, "sequence", s2h_sequence(client));
  if (event->gains != NULL) {
    s2h_write_number(&writer, "of", event->gains->sequence);
    s2h_write_number(&writer, "n_skipped", event->gains->n_skipped);
    s2h_write_number(&writer, "layout", event->gains->layout);
    s2h_write_bool(&writer, "is_paused", event->gains->is_paused);
    s2h_write_bool(&writer, "is_preparing", event->gains->is_preparing);
  }
  if (event->message.at != NULL) {
    char *copy = (char *)malloc((size_t)(event->message.end - event->message.at) + 1);
    if (copy == NULL) abort();
    memcpy(copy, event->message.at, (size_t)(event->message.end - event->message.at));
    copy[event->message.end - event->message.at] = '\0';
    s2h_write_json(&writer, "message", copy);
    free(copy);
  }
  print(&writer);
}

/* Poll until an event of a type comes, or the time is over. */
static void poll_until(const char *type, double timeout_s) {
  double end_s = now_s() + timeout_s;
  s2h_event event;
  while (now_s() < end_s) {
    bool is_wanted = false;
    while (!is_wanted && s2h_poll(client, &event)) {
      print_event(&event);
      is_wanted = type != NULL && strcmp(NAMES[event.type], type) == 0;
    }
    if (is_wanted) return;
    s2h_wait(client, 0.01);
  }
}

static void create(const char *url, const char *token, double max_receive, double max_send) {
  s2h_settings settings = {NULL, NULL, "driver", 0, 0};
  settings.url = url;
  settings.token = strcmp(token, "-") == 0 ? NULL : token;
  settings.max_receive_bytes = (size_t)max_receive;
  settings.max_send_bytes = (size_t)max_send;
  s2h_destroy(client);
  client = s2h_create(&settings);
  if (client == NULL) abort();
}

static void play(double job, const char *bundle, char *moving, const char *frames, const char *more) {
  s2h_play_settings settings = {0, NULL, NULL, 0, false, false, NULL};
  const char *ids[16];
  char *id = strtok(moving, ",");
  settings.job = (uint32_t)job;
  settings.bundle = strcmp(bundle, "-") == 0 ? NULL : bundle;
  settings.moves_all = id != NULL && strcmp(id, "*") == 0;
  for (; id != NULL && settings.n_moving < 16; id = strtok(NULL, ",")) ids[settings.n_moving++] = id;
  settings.moving = ids;
  settings.every_frame = strcmp(frames, "every") == 0;
  settings.more = *more != '\0' ? more : NULL;
  print_number("request", s2h_play(client, &settings));
}

/* Send frames for a time as fast as possible, each with its number as x of the phone; nothing is read. */
static void flood(double time_s) {
  s2h_handle phone = s2h_handle_of(client, "phone");
  double end_s = now_s() + time_s;
  unsigned long n = 0, n_sent = 0;
  s2h_writer writer = begin();
  while (now_s() < end_s) {
    float at_m[3] = {0.0f, 0.0f, 0.0f};
    at_m[0] = (float)++n;
    (void)s2h_set_pose(client, phone, at_m, NULL);
    n_sent += s2h_send_frame(client, 0.0) != 0;
  }
  s2h_write_number(&writer, "n", (double)n);
  s2h_write_number(&writer, "n_sent", (double)n_sent);
  print(&writer);
}

static void felt(const char *hand, const char *source) {
  s2h_writer writer = begin();
  s2h_handle of_hand = s2h_handle_of(client, hand), of_source = s2h_handle_of(client, source);
  s2h_write_bool(&writer, "is_felt", s2h_is_felt(client));
  s2h_write_number(&writer, "intensity", (double)s2h_intensity(client, of_hand));
  s2h_write_number(&writer, "gain", (double)s2h_gain(client, of_hand, of_source));
  print(&writer);
}

static void ids(void) {
  s2h_writer writer = begin();
  size_t i;
  s2h_write_begin(&writer, "objects", '[');
  for (i = 0; s2h_object_id(client, i) != NULL; ++i) s2h_write_string(&writer, NULL, s2h_object_id(client, i));
  s2h_write_end(&writer, ']');
  s2h_write_begin(&writer, "hands", '[');
  for (i = 0; s2h_hand_id(client, i) != NULL; ++i) s2h_write_string(&writer, NULL, s2h_hand_id(client, i));
  s2h_write_end(&writer, ']');
  s2h_write_begin(&writer, "sources", '[');
  for (i = 0; s2h_source_at(client, i) != NULL; ++i) {
    const s2h_source *source = s2h_source_at(client, i);
    s2h_write_begin(&writer, NULL, '{');
    s2h_write_string(&writer, "id", source->id);
    s2h_write_string(&writer, "state", source->state);
    s2h_write_bool(&writer, "is_on", source->is_on);
    s2h_write_number(&writer, "frequency_hz", source->frequency_hz);
    s2h_write_end(&writer, '}');
  }
  s2h_write_end(&writer, ']');
  print(&writer);
}

/* Read a JSON text given in hexadecimal, and print what the reader makes of it. */
static void parse(const char *hex) {
  size_t n = strlen(hex) / 2, i;
  char *text = (char *)malloc(n + 1), string[256];
  s2h_json value, cursor = {NULL, NULL}, key, item;
  s2h_writer writer = begin();
  if (text == NULL) abort();
  for (i = 0; i < n; ++i) {
    char digits[3] = {hex[2 * i], hex[2 * i + 1], '\0'};
    text[i] = (char)strtoul(digits, NULL, 16);
  }
  value = s2h_json_parse(text, n);
  s2h_write_bool(&writer, "is_json", value.at != NULL);
  s2h_write_number(&writer, "number", s2h_json_number(value, -4.5));
  if (s2h_json_string(value, string, sizeof string)) s2h_write_string(&writer, "string", string);
  s2h_write_begin(&writer, "items", '[');
  while (s2h_json_next(value, &cursor, &key, &item)) {
    if (s2h_json_string(key, string, sizeof string)) s2h_write_string(&writer, NULL, string);
    s2h_write_number(&writer, NULL, s2h_json_number(item, -4.5));
  }
  s2h_write_end(&writer, ']');
  print(&writer);
  free(text);
}

/* A scene of a box and of a tetrahedron. */
static void write_scene(void) {
  static const double at_m[3] = {0.1, -2e-7, 1e3}, turn[4] = {0.0, 0.6, 0.0, 0.8}, size_m[3] = {1.2, 0.04, 0.7};
  static const float vertices_m[12] = {0, 0, 0, 0.1f, 0, 0, 0, 0.1f, 0, 0, 0, 1.0f / 3.0f};
  static const uint32_t faces[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  s2h_writer scene = S2H_WRITER;
  s2h_scene_begin(&scene, "a \"study\"", 'z');
  s2h_scene_box(&scene, "table", "Oak table \xE2\x82\xAC\t\\", at_m, turn, size_m);
  s2h_scene_mesh(&scene, "spike", "Steel spike", at_m, NULL, vertices_m, 4, faces, 4);
  s2h_scene_end(&scene);
  (void)printf("%s\n", s2h_writer_text(&scene));
  s2h_writer_free(&scene);
}

static void bake_large(size_t n_bytes) {
  s2h_bake_settings bake = {NULL, NULL, NULL};
  s2h_writer scene = S2H_WRITER;
  char *name = (char *)malloc(n_bytes + 1);
  size_t i;
  if (name == NULL) abort();
  for (i = 0; i < n_bytes; ++i) name[i] = (char)('a' + i % 26);
  name[n_bytes] = '\0';
  s2h_scene_begin(&scene, name, 'y');
  s2h_scene_end(&scene);
  bake.scene = s2h_writer_text(&scene);
  print_number("request", s2h_bake(client, &bake));
  s2h_writer_free(&scene);
  free(name);
}

static void request(const char *type, const char *a, const char *b, double x, const char *rest) {
  static const double point_m[3] = {0.1, 0.72, -1e-5};
  const char *moving[2];
  uint32_t id = 0;
  moving[0] = a;
  moving[1] = b;
  if (strcmp(type, "on") == 0) id = s2h_set_source_on(client, a, x > 0.0);
  else if (strcmp(type, "state") == 0) id = s2h_set_source_state(client, a, b);
  else if (strcmp(type, "gain_db") == 0) id = s2h_set_source_gain_db(client, a, x);
  else if (strcmp(type, "mute") == 0) id = s2h_set_source_mute(client, a, x > 0.0);
  else if (strcmp(type, "user_gain_db") == 0) id = s2h_set_user_gain_db(client, x);
  else if (strcmp(type, "user_mute") == 0) id = s2h_set_user_mute(client, x > 0.0);
  else if (strcmp(type, "strike") == 0) id = s2h_strike(client, a, point_m, x, strcmp(b, "-") == 0 ? NULL : b);
  else if (strcmp(type, "add") == 0) id = s2h_add(client, rest);
  else if (strcmp(type, "remove") == 0) id = s2h_remove(client, a);
  else if (strcmp(type, "moving") == 0) id = s2h_set_moving(client, moving, strcmp(b, "-") == 0 ? 1 : 2);
  else if (strcmp(type, "pause") == 0) id = s2h_pause(client);
  else if (strcmp(type, "unpause") == 0) id = s2h_unpause(client);
  else if (strcmp(type, "explain") == 0) id = s2h_explain(client, a);
  else if (strcmp(type, "leave") == 0) id = s2h_leave(client);
  else if (strcmp(type, "watch") == 0) id = s2h_watch(client, a);
  else if (strcmp(type, "picture") == 0) id = s2h_send_picture(client, a, "isolated", b, "\x89PNG", 4);
  else id = s2h_request(client, type, *rest != '\0' ? rest : NULL);
  print_number("request", id);
}

static void act(const char *command) {
  static char words[4][65536]; /* the first words behind the command, and at `rest` all that follows them */
  const char *rest = line + strlen(command);
  const char *from[5];
  float numbers[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  int i;
  while (*rest == ' ') ++rest;
  from[0] = rest;
  for (i = 0; i < 4; ++i) {
    size_t n = strcspn(from[i], " ");
    if (n >= sizeof words[i]) n = 0;
    memcpy(words[i], from[i], n);
    words[i][n] = '\0';
    from[i + 1] = from[i] + n + strspn(from[i] + n, " ");
    numbers[i] = (float)s2h_json_number(s2h_json_parse(words[i], n), 0.0);
  }
  if (strcmp(command, "create") == 0) {
    create(words[0], words[1], (double)numbers[2], (double)numbers[3]);
  } else if (strcmp(command, "destroy") == 0) {
    s2h_destroy(client);
    client = NULL;
  } else if (strcmp(command, "until") == 0) {
    poll_until(words[0], (double)numbers[1]);
  } else if (strcmp(command, "run") == 0) {
    poll_until(NULL, (double)numbers[0]);
  } else if (strcmp(command, "bake") == 0) {
    s2h_bake_settings bake = {NULL, NULL, NULL};
    bake.scene = rest;
    print_number("request", s2h_bake(client, &bake));
  } else if (strcmp(command, "bake_large") == 0) {
    bake_large((size_t)numbers[0]);
  } else if (strcmp(command, "play") == 0) {
    play((double)numbers[0], words[1], words[2], words[3], from[4]);
  } else if (strcmp(command, "request") == 0) {
    request(words[0], words[1], words[2], (double)numbers[3], from[1]);
  } else if (strcmp(command, "pose") == 0) {
    print_number("is_set", s2h_set_pose(client, s2h_handle_of(client, words[0]), numbers + 1, NULL));
  } else if (strcmp(command, "wrong_pose") == 0) {
    uint32_t bits = 0x7FC00000u;
    memcpy(numbers, &bits, 4);
    print_number("is_set", s2h_set_pose(client, s2h_handle_of(client, words[0]), numbers, NULL));
  } else if (strcmp(command, "touch") == 0) {
    s2h_handle hand = s2h_handle_of(client, words[0]), object = s2h_handle_of(client, words[1]);
    float point_m[3] = {0.0f, 0.72f, 0.0f};
    point_m[0] = numbers[2];
    print_number("is_set", s2h_touch(client, hand, object, point_m));
  } else if (strcmp(command, "lift") == 0) {
    s2h_lift(client, s2h_handle_of(client, words[0]));
  } else if (strcmp(command, "frame") == 0) {
    print_number("sent", s2h_send_frame(client, (double)numbers[0]));
  } else if (strcmp(command, "flood") == 0) {
    flood((double)numbers[0]);
  } else if (strcmp(command, "felt") == 0) {
    felt(words[0], words[1]);
  } else if (strcmp(command, "ids") == 0) {
    ids();
  } else if (strcmp(command, "parse") == 0) {
    parse(rest);
  } else if (strcmp(command, "number") == 0) {
    print_number("number", strtod(words[0], NULL));
  } else if (strcmp(command, "bits") == 0) {
    uint64_t bits = strtoull(words[0], NULL, 16);
    double number;
    memcpy(&number, &bits, 8);
    print_number("number", number);
  } else if (strcmp(command, "scene") == 0) {
    write_scene();
  } else if (strcmp(command, "decimal_point") == 0) {
    s2h_writer writer = begin();
    s2h_write_string(&writer, "decimal_point", localeconv()->decimal_point);
    print(&writer);
  } else {
    (void)fprintf(stderr, "no command %s\n", command);
    exit(2);
  }
}

int main(void) {
  const char *locale = getenv("SCENE2HAP_DRIVER_LOCALE");
  if (locale != NULL && setlocale(LC_ALL, locale) == NULL) return 3;
  while (fgets(line, sizeof line, stdin) != NULL) {
    char command[32];
    size_t n = strcspn(line, " \n");
    line[strcspn(line, "\n")] = '\0';
    if (n >= sizeof command) return 2;
    memcpy(command, line, n);
    command[n] = '\0';
    act(command);
    (void)printf("{\"did\": \"%s\"}\n", command);
    (void)fflush(stdout);
  }
  s2h_destroy(client);
  return 0;
}
