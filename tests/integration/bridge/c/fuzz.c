/*
 * Gives the C client random and mutated bytes in the place of a server.
 *
 *   fuzz [inputs] [seed]
 *
 * Compile it with -fsanitize=address,undefined. Network, clock and memory are replaced by those below. Each input is a
 * connection from its handshake on. At its end the state of the client is checked, and all memory must be freed.
 * Prints how many events of each type came, so that a test sees how deep the inputs got.
 */
#if defined(__STRICT_ANSI__) && !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200809L
#endif

#include <stddef.h>

static long fuzz_recv(void *out, size_t n);
static long fuzz_send(const void *data, size_t n);
static double fuzz_now_s(void);
static void *fuzz_realloc(void *block, size_t n);
static void fuzz_free(void *block);

#define S2H_RECV(socket, data, n) fuzz_recv(data, n)
#define S2H_SEND(socket, data, n) fuzz_send(data, n)
#define S2H_NOW_S fuzz_now_s
#define S2H_REALLOC fuzz_realloc
#define S2H_FREE fuzz_free
#define S2H_BUFFER_BYTES 16384
#define SCENE2HAP_CLIENT_IMPLEMENTATION
#include "scene2hap_client.h"

#define CHECK(condition)                                                             \
  do {                                                                               \
    if (!(condition)) {                                                              \
      (void)fprintf(stderr, "input %lu: line %d: %s\n", input, __LINE__, #condition); \
      abort();                                                                       \
    }                                                                                \
  } while (0)

#define MAX_STREAM (1 << 17)
#define MAX_RECEIVE 70000
#define MAX_SEND 65536
#define N_ORDERS 10 /* more than the client keeps */
#define N_LONG 66000 /* bytes of a message, so that its length takes 8 bytes */
#define N_SCENE 40000 /* bytes of a request that goes in pieces */
#define N_EVENT_TYPES (S2H_LEFT + 1)

static unsigned long input;
static uint64_t state;
static uint8_t stream[MAX_STREAM], sent[1 << 20];
static size_t n_stream, at, n_sent;
static bool is_slow, is_cut, is_large, poses_table, fails_memory;
static long n_blocks;
static double now_s;
static unsigned long n_events[N_EVENT_TYPES], n_wrong;

static uint64_t random_bits(void) { /* xorshift64* */
  state ^= state >> 12;
  state ^= state << 25;
  state ^= state >> 27;
  return (state * 2685821657736338717u) >> 8;
}

static size_t below(size_t n) { return (size_t)(random_bits() % n); }

static double fuzz_now_s(void) { return now_s; }

static void *fuzz_realloc(void *block, size_t n) {
  void *found;
  if (fails_memory && below(16) == 0) return NULL;
  found = realloc(block, n);
  if (found != NULL && block == NULL) ++n_blocks;
  return found;
}

static void fuzz_free(void *block) {
  if (block != NULL) --n_blocks;
  free(block);
}

static long fuzz_recv(void *out, size_t n) {
  if (n > n_stream - at) n = n_stream - at;
  if (n == 0) {
    errno = EAGAIN; /* which means nothing at the end of a connection */
    return is_cut ? 0 : -1;
  }
  if (is_slow) n = 1 + below(n < 40 ? n : 40);
  memcpy(out, stream + at, n);
  at += n;
  return (long)n;
}

static long fuzz_send(const void *data, size_t n) {
  if (is_slow && below(4) == 0) {
    errno = below(50) == 0 ? EPIPE : EAGAIN;
    return -1;
  }
  if (is_slow) n = 1 + below(n);
  if (n > sizeof sent - n_sent) n = sizeof sent - n_sent;
  memcpy(sent + n_sent, data, n);
  n_sent += n;
  return (long)n;
}

/* Whether all that was sent is frames of a WebSocket client: masked, with control frames short and whole. */
static void check_sent(void) {
  size_t from = 0;
  bool is_in_message = false;
  while (n_sent - from >= 2) {
    const uint8_t *p = sent + from;
    size_t n = p[1] & 0x7F, header = 6, i;
    int opcode = p[0] & 0x0F;
    CHECK((p[0] & 0x70) == 0 && (p[1] & 0x80) != 0);
    if (n == 126) {
      if (n_sent - from < 4) return;
      n = (size_t)p[2] << 8 | p[3];
      header = 8;
      CHECK(n >= 126);
    } else if (n == 127) {
      if (n_sent - from < 10) return;
      for (n = 0, i = 2; i < 10; ++i) n = n << 8 | p[i];
      header = 14;
      CHECK(n >= 65536);
    }
    if (opcode >= 8) {
      CHECK((p[0] & 0x80) != 0 && n <= 125 && (opcode == 8 || opcode == 10));
    } else {
      const char *begin = opcode == 1 ? "{\"type\":" : "S2HB\1\1";
      CHECK((opcode == 0) == is_in_message && opcode <= 2);
      is_in_message = (p[0] & 0x80) == 0;
      for (i = 0; opcode > 0 && begin[i] != '\0' && n_sent - from >= header + n; ++i) {
        CHECK((p[header + i] ^ p[header - 4 + i % 4]) == begin[i]);
      }
    }
    if (n_sent - from < header + n) return;
    from += header + n;
    CHECK(opcode != 8 || from == n_sent); /* nothing after a close frame */
  }
}

/* ------------------------------------------------------------------------------------------- what a server says */

#define KEY_OF_RFC "dGhlIHNhbXBsZSBub25jZQ=="

static const char head[] =
    "HTTP/1.1 101 Switching Protocols\r\nDate: Tue, 24 Nov 2026 09:00:00 GMT\r\nUpgrade: websocket\r\n"
    "Connection: Upgrade\r\nSec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n\r\n";

/* Short ids, of which more fit into a message than anything else. */
#define TEN ",\"a\",\"\",\"b\",\"\",\"\",\"\",\"\",\"c\",\"\",\"\""
#define MANY TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN

/* The client's ids: 1 bake, 2 hello, 3 play, 4 and 5 after `playing`. */
static const char *const texts[] = {
    "{\"type\": \"welcome\", \"re\": 2, \"version\": 1, \"server\": \"scene2hap\", \"max_message_bytes\": 33554432, "
    "\"heartbeat_s\": 2.0, \"sink\": null, \"udp_port\": null, \"models\": [\"exponential_plate\"]}",
    "{\"type\": \"of a later server\", \"with\": [\"a\", {\"list\": null}]}",
    "{\"type\": \"baking\", \"re\": 1, \"job\": 7}",
    "{\"type\": \"progress\", \"job\": 7, \"stage\": \"infer\", \"item\": \"T\\u00e4ble \\ud83d\\ude00\", \"done\": 1, "
    "\"of\": 3}",
    "{\"type\": \"baked\", \"job\": 7, \"objects\": [{\"id\": \"phone\", \"category\": \"smartphone\", \"material\": "
    "\"glass\", \"vibrates\": true, \"states\": [\"ringing\"]}]}",
    "{\"type\": \"playing\", \"re\": 3, \"session\": \"c2f1a09b\", \"key\": \"00112233445566ff\", \"layout\": 1, "
    "\"objects\": [\"phone\", \"table\", \"lamp\"], \"n_moving\": 1, \"hands\": [\"left\", \"right\"], \"sources\": "
    "[{\"id\": \"phone\", \"state\": \"ringing\", \"states\": [\"ringing\"], \"is_on\": true, \"frequency_hz\": 175}], "
    "\"n_bands\": 1, \"sequence\": 0, \"watchdog_s\": 0.1, \"sink\": null, \"udp_port\": null}",
    NULL, /* gains */
    "{\"type\": \"impact\", \"object\": \"phone\", \"with_object\": null, \"point_m\": [0.5, -1e-3, 2E+2], "
    "\"frequency_hz\": 1.5e2, \"felt\": {\"left\": 0.25, \"right\": 0}}",
    "{\"type\": \"order\", \"re\": 4, \"layout\": 2, \"objects\": [\"table\", \"phone\"" MANY "], \"n_moving\": 2, "
    "\"hands\": [\"left\", \"right\"], \"sources\": [{\"id\": \"phone\", \"state\": \"off\", \"states\": [], "
    "\"is_on\": false, \"frequency_hz\": 175}], \"n_bands\": 1, \"sequence\": 1, \"watchdog_s\": 0.1}",
    NULL,
    "{\"type\": \"explanation\", \"re\": 5, \"text\": \"left: \\\"phone\\\"\\n\\ttable\", \"felt\": [[[]]], \"x\": -0}",
    "{\"type\": \"warning\", \"message\": \"slow \\u0000 \\ud800 \\/\"}",
    "{\"type\": \"error\", \"error\": \"UnknownObject\", \"message\": \"no object \\u2019x\\u2019.\", \"re\": 99}",
    "{\"type\": \"error\", \"error\": \"BridgeError\", \"message\": \"a frame has 3 bytes\"}",
    "{\"type\": \"state\", \"session\": \"c2f1a09b\", \"is\": \"waiting\"}",
};
#define N_TEXTS (sizeof texts / sizeof *texts)

/* Gains as the session has them, or of other sizes and any numbers. */
static size_t gains_message(uint16_t layout, bool is_odd, uint8_t *out) {
  static const float values[] = {0.125f, 0.0f, 0.5f, 0.0f};
  static const float odd[] = {1.5f, -1.0f, 1e30f, -0.0f, 0.5f};
  size_t counts[3] = {2, 1, 1}, n, i;
  if (is_odd) counts[below(3)] = below(5);
  n = counts[0] + counts[0] * counts[1] * counts[2];
  memset(out, 0, 40);
  memcpy(out, "S2HB\x02\x01", 6);
  s2h__put_u16(out + 6, layout);
  s2h__put_u32(out + 16, layout);
  s2h__put_f64(out + 24, 0.5);
  for (i = 0; i < 3; ++i) s2h__put_u16(out + 32 + 2 * i, (uint16_t)counts[i]);
  for (i = 0; i < n; ++i) s2h__put_f32(out + 40 + 4 * i, is_odd ? odd[below(5)] : values[i]);
  if (is_odd && n > 0 && below(2)) s2h__put_u32(out + 40 + 4 * below(n), below(2) ? 0x7FC00000u : 0xFF800000u);
  return 40 + 4 * n;
}

static size_t message_at(size_t i, bool is_odd, uint8_t *out, int *opcode) {
  *opcode = texts[i] != NULL ? 1 : 2;
  if (texts[i] == NULL) return gains_message(i < 8 ? 1 : 2, is_odd, out);
  memcpy(out, texts[i], strlen(texts[i]));
  return strlen(texts[i]);
}

static void say(const void *data, size_t n) {
  if (n > MAX_STREAM - n_stream) n = MAX_STREAM - n_stream;
  memcpy(stream + n_stream, data, n);
  n_stream += n;
}

static void say_frame(int first, const void *data, size_t n) {
  uint8_t header[10] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  size_t n_header = n < 126 ? 2 : n < 65536 ? 4 : 10;
  header[0] = (uint8_t)first;
  header[1] = (uint8_t)(n < 126 ? n : n < 65536 ? 126 : 127);
  if (n_header > 2) {
    header[n_header - 2] = (uint8_t)(n >> 8 & 0xFF);
    header[n_header - 1] = (uint8_t)(n & 0xFF);
  }
  if (n_header > 4) header[7] = (uint8_t)(n >> 16);
  say(header, n_header);
  say(data, n);
}

/* Say a message, in pieces with pings between them if `cuts`. */
static void say_message(int opcode, const uint8_t *data, size_t n, bool cuts) {
  while (cuts && n > 0 && below(3) > 0) {
    size_t piece = below(n + 1);
    say_frame(opcode, data, piece);
    if (below(2)) say_frame(0x89, "ping", below(5));
    data += piece;
    n -= piece;
    opcode = 0;
  }
  say_frame(0x80 | opcode, data, n);
}

/* Put another number in the place of one. */
static size_t mutate_number(uint8_t *data, size_t n) {
  static const char *const numbers[] = {"0", "1", "2", "3", "4", "7", "255", "65535", "65536", "4294967295",
                                        "4294967296", "-1", "0.5", "1e999", "1e-999", "300"};
  const char *word = numbers[below(sizeof numbers / sizeof *numbers)];
  size_t begin = n > 0 ? below(n) : 0, end, length = strlen(word);
  while (begin < n && (data[begin] < '0' || data[begin] > '9')) ++begin;
  for (end = begin; end < n && data[end] >= '0' && data[end] <= '9'; ++end) continue;
  memmove(data + begin + length, data + end, n - end);
  memcpy(data + begin, word, length);
  return n - (end - begin) + length;
}

/* Change some bytes of a text or message, which may grow by 64. */
static size_t mutate(uint8_t *data, size_t n) {
  static const char *const wanted[] = {"\"", "{", "}", "[", "]", ",", ":", "\\u", "\\", "1e999", "-", "null",
                                       "65536", "4294967296", "0.5", "\xff", "\xed\xa0\x80", "\n", "\"type\":",
                                       "\"re\": 3", "-1", "\"\"", "99999999999999999999999"};
  size_t rounds = 1 + below(4), limit = n + 64;
  while (rounds-- > 0) {
    size_t place = n > 0 ? below(n) : 0, length = 1 + below(8), room = limit - n;
    const char *word = wanted[below(sizeof wanted / sizeof *wanted)];
    switch (below(10)) {
      case 8:
      case 9:
        if (room > 10) n = mutate_number(data, n);
        break;
      case 0:
        if (n > 0) data[place] = (uint8_t)(data[place] ^ 1u << below(8));
        break;
      case 1:
        if (n > 0) data[place] = (uint8_t)below(256);
        break;
      case 2: /* leave some out */
        if (length > n - place) length = n - place;
        memmove(data + place, data + place + length, n - place - length);
        n -= length;
        break;
      case 3: /* repeat some */
        if (length > n - place) length = n - place;
        if (length > room) break;
        memmove(data + place + length, data + place, n - place);
        n += length;
        break;
      case 4: /* end early */
        if (below(4) == 0) n = place;
        break;
      default: /* a word that matters */
        length = strlen(word);
        if (length > room) break;
        memmove(data + place + length, data + place, n - place);
        memcpy(data + place, word, length);
        n += length;
        break;
    }
  }
  return n;
}

/* ------------------------------------------------------------------------------------------------ what a game does */

static void walk(s2h_json value, int depth) {
  s2h_json cursor = {NULL, NULL}, key, item;
  char text[32];
  CHECK(depth <= 65);
  (void)s2h_json_string(value, text, 1 + below(sizeof text));
  CHECK(s2h__is_utf8(text, strlen(text)));
  CHECK(s2h__is_finite(s2h_json_number(value, 0.0)));
  (void)s2h_json_get(value, "id");
  while (s2h_json_next(value, &cursor, &key, &item)) {
    (void)s2h_json_string(key, text, sizeof text);
    walk(item, depth + 1);
  }
}

static void check_gains(const s2h_client *c, const s2h_gains *gains) {
  size_t i, n_sources = 0, n_hands = 0;
  CHECK(gains == s2h_last_gains(c));
  if (gains->layout == c->orders[0]->layout) {
    while (s2h_hand_id(c, n_hands) != NULL) ++n_hands;
    while (s2h_source_at(c, n_sources) != NULL) ++n_sources;
    CHECK(gains->n_hands == n_hands && gains->n_sources == n_sources && gains->n_bands == c->orders[0]->n_bands);
  }
  for (i = 0; i < gains->n_hands; ++i) CHECK(gains->intensities[i] >= 0.0f && gains->intensities[i] <= 1.0f);
  for (i = 0; i < (size_t)gains->n_hands * gains->n_sources * gains->n_bands; ++i) {
    CHECK(s2h__is_finite_f32(gains->gains[i]));
  }
}

static void check_event(const s2h_client *c, const s2h_event *event) {
  CHECK(event->type > S2H_NOTHING && event->type < N_EVENT_TYPES);
  CHECK(event->text != NULL && event->error != NULL);
  CHECK(s2h__is_utf8(event->text, strlen(event->text)) && s2h__is_utf8(event->error, strlen(event->error)));
  CHECK((event->gains != NULL) == (event->type == S2H_GAINS));
  CHECK(event->type != S2H_ERROR || event->text[0] != '\0' || event->message.at != NULL);
  if (event->gains != NULL) check_gains(c, event->gains);
  walk(event->message, 0);
  ++n_events[event->type];
  if (strcmp(event->error, "WrongMessage") == 0) ++n_wrong;
}

static void check_client(const s2h_client *c, const s2h_handle handles[4]) {
  size_t i, k;
  for (i = 0; i < 4; ++i) {
    float intensity = s2h_intensity(c, handles[i]);
    CHECK(intensity >= 0.0f && intensity <= 1.0f);
    for (k = 0; k < 4; ++k) CHECK(s2h__is_finite_f32(s2h_gain(c, handles[i], handles[k])));
  }
  CHECK(c->message_capacity <= 2 * (MAX_RECEIVE + 1));
  CHECK(c->queue_end - c->queue_begin <= MAX_SEND + 5);
  CHECK(c->n_names == 4 || fails_memory);
  CHECK(c->orders[0] == NULL || c->orders[0]->n_moving <= c->orders[0]->n_objects);
  for (i = 0; s2h_object_id(c, i) != NULL; ++i) CHECK(strlen(s2h_object_id(c, i)) < MAX_RECEIVE);
  for (i = 0; s2h_hand_id(c, i) != NULL; ++i) CHECK(strlen(s2h_hand_id(c, i)) < MAX_RECEIVE);
  for (i = 0; s2h_source_at(c, i) != NULL; ++i) CHECK(strlen(s2h_source_at(c, i)->state) < MAX_RECEIVE);
}

/* A scene of many bytes, or of few. */
static const char *scene(void) {
  static char text[N_SCENE];
  if (!is_large) return "{\"objects\": []}";
  memset(text, ' ', sizeof text - 1);
  text[0] = '[';
  text[N_SCENE - 2] = ']';
  return text;
}

/* Play against `stream` until it is used up. */
static void play_game(void) {
  static const char *const ids[4] = {"phone", "table", "left", "right"};
  static const float point_m[3] = {0.5f, 0.72f, 0.0f};
  s2h_settings settings = {"ws://127.0.0.1:1/", "secret", NULL, MAX_RECEIVE, MAX_SEND};
  s2h_bake_settings bake = {scene(), NULL, NULL};
  s2h_play_settings play = {0, NULL, NULL, 0, false, false, NULL};
  const char *moving[1] = {"phone"};
  s2h_handle handles[4];
  s2h_event event;
  s2h_client *c;
  size_t i, rounds = 0;
  now_s = 100.0;
  at = n_sent = 0;
  c = s2h_create(&settings);
  if (c == NULL) {
    CHECK(fails_memory);
    return;
  }
  for (i = 0; i < 4; ++i) handles[i] = s2h_handle_of(c, ids[i]);
  (void)s2h_bake(c, &bake);
  c->socket = open("/dev/null", O_RDONLY);
  CHECK(c->socket >= 0);
  memcpy(c->nonce, KEY_OF_RFC, sizeof KEY_OF_RFC);
  c->state = S2H__HANDSHAKE;
  c->deadline_s = now_s + 10.0;
  for (;;) {
    size_t before = at;
    while (s2h_poll(c, &event)) {
      CHECK(++rounds < 100000);
      check_event(c, &event);
      if (event.type == S2H_BAKED) {
        play.job = event.job;
        play.moving = moving;
        play.n_moving = 1;
        (void)s2h_play(c, &play);
      } else if (event.type == S2H_PLAYING) {
        (void)s2h_remove(c, "lamp");
        (void)s2h_explain(c, "left");
      }
    }
    CHECK(++rounds < 100000);
    (void)s2h_set_pose(c, handles[0], point_m, NULL);
    if (poses_table) (void)s2h_set_pose(c, handles[1], point_m, NULL);
    (void)s2h_touch(c, handles[2], handles[1], point_m);
    (void)s2h_send_frame(c, now_s);
    check_client(c, handles);
    if (c->state <= S2H__WAITING || (at == n_stream && at == before)) break;
    now_s += 0.001;
  }
  CHECK(!is_cut || c->state <= S2H__WAITING);
  if (at == n_stream && below(4) == 0) { /* silence */
    now_s += 1000.0;
    while (c->state > S2H__WAITING && s2h_poll(c, &event)) check_event(c, &event);
    CHECK(c->state <= S2H__WAITING || c->has_offline || is_slow);
    check_client(c, handles);
  }
  if (c->state > S2H__WAITING || n_sent > 0) check_sent();
  s2h_destroy(c);
  check_sent();
}

/* The parsers alone, on blocks of exactly the bytes that they may read. */
static void parse_exact(void) {
  static uint8_t data[4096];
  size_t i = below(N_TEXTS + 1), n;
  int opcode = 1;
  bool is_odd = true;
  uint8_t *exact;
  if (i < N_TEXTS) {
    n = message_at(i, is_odd, data, &opcode);
  } else {
    n = sizeof head - 1;
    memcpy(data, head, n);
  }
  n = mutate(data, n);
  exact = (uint8_t *)malloc(n + 1);
  CHECK(exact != NULL);
  memcpy(exact, data, n);
  exact = (uint8_t *)realloc(exact, n > 0 ? n : 1);
  CHECK(exact != NULL);
  if (i == N_TEXTS) {
    if (n >= 4 && memcmp(exact + n - 4, "\r\n\r\n", 4) == 0) (void)s2h__head_problem((char *)exact, n, KEY_OF_RFC);
  } else if (opcode == 1) {
    walk(s2h_json_parse((char *)exact, n), 0);
  } else {
    size_t n_values = below(64);
    float *values = (float *)malloc((n_values + 1) * sizeof *values - sizeof *values + (n_values == 0));
    s2h_gains gains;
    CHECK(values != NULL);
    if (s2h_decode_gains(exact, n, &gains, values, n_values)) CHECK(gains.n_hands <= n_values);
    free(values);
  }
  free(exact);
}

/* ---------------------------------------------------------------------------------------------------------- inputs */

enum { PRISTINE, MUTATED_MESSAGES, MUTATED_STREAM, MUTATED_HEAD, RANDOM_FRAMES, RANDOM_BYTES, N_KINDS };

static void make_stream(int kind) {
  static uint8_t data[MAX_STREAM];
  size_t i, n;
  int opcode;
  bool is_odd = false;
  n_stream = 0;
  if (kind == MUTATED_HEAD) {
    memcpy(data, head, sizeof head - 1);
    say(data, mutate(data, sizeof head - 1));
  } else {
    say(head, sizeof head - 1);
  }
  if (kind == RANDOM_BYTES || kind == RANDOM_FRAMES) {
    size_t from = below(N_TEXTS);
    for (i = 0; i < from; ++i) { /* after a sensible beginning */
      n = message_at(i, is_odd, data, &opcode);
      say_message(opcode, data, n, false);
    }
    for (i = below(8); i > 0; --i) {
      static const uint8_t firsts[] = {0x81, 0x82, 0x80, 0x00, 0x01, 0x02, 0x88, 0x89, 0x8A, 0x09, 0x83, 0xC1};
      n = below(i == 1 ? 300 : 60);
      for (opcode = 0; (size_t)opcode < n; ++opcode) data[opcode] = (uint8_t)below(256);
      if (kind == RANDOM_BYTES) say(data, n);
      else say_frame(firsts[below(sizeof firsts)], data, n);
    }
    return;
  }
  for (i = 0; i < N_TEXTS; ++i) {
    is_odd = kind == MUTATED_MESSAGES && below(4) == 0;
    n = message_at(i, is_odd, data, &opcode);
    if (kind == MUTATED_MESSAGES && below(6) == 0) n = mutate(data, n);
    if (kind == MUTATED_MESSAGES && below(40) == 0) continue;
    say_message(opcode, data, n, kind != PRISTINE && below(4) == 0);
    if (below(8) == 0) say_frame(0x89, data, below(126));
  }
  if (is_large) {
    for (i = 0; i < N_ORDERS; ++i) {
      n = (size_t)snprintf((char *)data, 300,
                           "{\"type\": \"order\", \"layout\": %u, \"objects\": [\"phone\", \"table\"], \"n_moving\": "
                           "1, \"hands\": [\"left\", \"right\"], \"sources\": [], \"n_bands\": 2}",
                           (unsigned)(3 + i));
      say_message(1, data, n, false);
    }
    memset(data, ' ', N_LONG);
    memcpy(data, texts[11], strlen(texts[11]));
    say_frame(0x81, data, N_LONG);
  }
  if (kind == MUTATED_STREAM) {
    size_t begin = sizeof head - 1;
    memcpy(data, stream + begin, n_stream - begin);
    n = mutate(data, n_stream - begin);
    n_stream = begin;
    say(data, n);
  }
  if (below(2)) say_frame(0x88, "\x03\xE9" "bye", 5);
}

int main(int argc, char **argv) {
  unsigned long n_inputs = argc > 1 ? strtoul(argv[1], NULL, 10) : 100000;
  static const char *const names[N_EVENT_TYPES] = {"nothing", "online", "offline", "error", "warning",
                                                   "baking", "progress", "baked", "playing", "order",
                                                   "gains", "impact", "state", "answer", "left"};
  size_t i;
  state = 88172645463325252u + (argc > 2 ? strtoull(argv[2], NULL, 10) : 0);
  for (input = 0; input < n_inputs; ++input) {
    int kind = input % 1000 == 0 ? PRISTINE : 1 + (int)below(N_KINDS - 1);
    unsigned long before[N_EVENT_TYPES];
    is_slow = kind != PRISTINE && below(4) == 0;
    is_cut = below(4) == 0;
    poses_table = kind != PRISTINE; /* an error where it does not move */
    is_large = kind == PRISTINE || below(50) == 0;
    fails_memory = kind != PRISTINE && below(8) == 0;
    memcpy(before, n_events, sizeof before);
    make_stream(kind);
    play_game();
    fails_memory = false;
    if (kind == PRISTINE) {
      CHECK(n_events[S2H_GAINS] == before[S2H_GAINS] + 2 && n_events[S2H_ORDER] == before[S2H_ORDER] + 1 + N_ORDERS);
      CHECK(n_events[S2H_WARNING] == before[S2H_WARNING] + 2 && n_sent > N_SCENE);
      CHECK(n_events[S2H_ANSWER] == before[S2H_ANSWER] + 1 && n_events[S2H_ERROR] == before[S2H_ERROR] + 2);
    }
    CHECK(n_blocks == 0);
    parse_exact();
  }
  (void)printf("inputs %lu\nwrong %lu\n", n_inputs, n_wrong);
  for (i = 1; i < N_EVENT_TYPES; ++i) (void)printf("%s %lu\n", names[i], n_events[i]);
  return 0;
}
