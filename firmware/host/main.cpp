// The amplifier on a pseudo-terminal, so that the tests run the sink against the firmware's code.
//
//   c++ -std=c++17 -O2 -o amplifier main.cpp && ./amplifier > heard.raw
//
// Prints the terminal's name on standard error, and the played samples as raw i16 on standard output. Ends when its
// standard input ends.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include "../scene2hap_amplifier/amplifier.h"

constexpr uint16_t kRate = 4000;

static uint64_t micros() {
  using namespace std::chrono;
  return static_cast<uint64_t>(duration_cast<microseconds>(steady_clock::now().time_since_epoch()).count());
}

int main() {
  const int port = posix_openpt(O_RDWR | O_NOCTTY);
  if (port < 0 || grantpt(port) || unlockpt(port)) return 1;
  const int host = open(ptsname(port), O_RDWR | O_NOCTTY);  // kept open, so that the host can connect and disconnect
  termios raw;
  if (host < 0 || tcgetattr(host, &raw)) return 1;
  cfmakeraw(&raw);
  tcsetattr(host, TCSANOW, &raw);
  fcntl(port, F_SETFL, O_NONBLOCK);
  std::fprintf(stderr, "%s\n", ptsname(port));

  static scene2hap::Amplifier<kRate, 2, 400> amplifier;
  const uint64_t began = micros();
  uint64_t played = 0;
  pollfd ends[2] = {{port, POLLIN, 0}, {0, POLLIN, 0}};
  while (true) {
    poll(ends, 2, 1);
    uint8_t bytes[512];
    if (ends[1].revents && read(0, bytes, sizeof(bytes)) <= 0) return 0;
    const uint64_t now = micros();
    const ssize_t got = read(port, bytes, sizeof(bytes));
    if (got > 0) amplifier.receive(bytes, static_cast<size_t>(got), static_cast<uint32_t>(now));
    amplifier.advance(static_cast<uint32_t>(now));
    const size_t answer = amplifier.take_outgoing(bytes, sizeof(bytes));
    if (answer && write(port, bytes, answer) < 0) continue;
    for (; played < (now - began) * kRate / 1000000; ++played) {
      int16_t frame[2];
      amplifier.next_frame(frame);
      std::fwrite(frame, sizeof(frame), 1, stdout);
    }
  }
}
