// Firmware for two hands on a Teensy 3.x or 4.x: input is PCM over USB, output is PWM on two pins for a stereo class-D
// amplifier (such as a PAM8403 or MAX98306). docs/serial-protocol.md has the protocol, README.md the wiring.
//
// Other boards need `analogWrite` of 8 bit or more well above 20 kHz, a timer interrupt, and 3 kB of memory. On a board
// with DACs, write to the DACs instead. A board with a USB sound card needs no firmware of this kind.

#include "amplifier.h"

constexpr uint16_t kSampleRateHz = 4000;
constexpr uint8_t kChannels = 2;
constexpr int kPins[kChannels] = {3, 4};  // left, right
constexpr int kEnablePin = 5;             // the amplifier's shutdown input, high is on
constexpr int kPwmBits = 10;
constexpr float kPwmHz = 58593.75f;  // at which a Teensy 4 at 600 MHz and a Teensy 3 at 60 MHz have 10 bit

scene2hap::Amplifier<kSampleRateHz, kChannels, 400> amplifier;
IntervalTimer sample_timer;

void play() {
  int16_t frame[kChannels];
  amplifier.next_frame(frame);
  for (uint8_t c = 0; c < kChannels; ++c) {
    analogWrite(kPins[c], (static_cast<int32_t>(frame[c]) + 32768) >> (16 - kPwmBits));
  }
}

void setup() {
  pinMode(kEnablePin, OUTPUT);
  digitalWriteFast(kEnablePin, LOW);
  analogWriteResolution(kPwmBits);
  for (int pin : kPins) {
    analogWriteFrequency(pin, kPwmHz);
    analogWrite(pin, 1 << (kPwmBits - 1));
  }
  Serial.begin(921600);  // USB: the number is ignored
  sample_timer.begin(play, 1000000.0f / kSampleRateHz);
}

void loop() {
  uint8_t bytes[64];
  const int waiting = Serial.available();
  if (waiting > 0) {
    const size_t n = Serial.readBytes(reinterpret_cast<char*>(bytes), min(waiting, static_cast<int>(sizeof(bytes))));
    amplifier.receive(bytes, n, micros());
  }
  amplifier.advance(micros());
  const int room = min(Serial.availableForWrite(), static_cast<int>(sizeof(bytes)));
  if (room > 0) {
    const size_t n = amplifier.take_outgoing(bytes, room);
    if (n > 0) Serial.write(bytes, n);
  }
  // The amplifier is off while muted, so that its hiss is not felt.
  digitalWriteFast(kEnablePin, amplifier.muted() ? LOW : HIGH);
}
