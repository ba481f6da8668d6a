// Hardware-independent part of a scene2hap serial amplifier: bytes in, bytes out, and the time from the caller.
//
// The protocol is docs/serial-protocol.md; the same device in Python is scene2hap.devices.reference_device. This code
// needs no Arduino, never allocates and never waits, so that the tests can compile it for the host.
//
// One thread (or loop) calls receive, advance and take_outgoing; an interrupt may call next_frame at any time. The
// queue has one writer and one reader: the loop moves head_, the interrupt moves tail_. A flag requests that the queue
// be emptied.

#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

namespace scene2hap {

inline uint32_t crc32(const uint8_t* data, size_t size) {
  uint32_t crc = 0xFFFFFFFFu;
  for (size_t i = 0; i < size; ++i) {
    crc ^= data[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (0xEDB88320u & (0u - (crc & 1u)));
  }
  return ~crc;
}

// Returns the size of the decoded bytes, or 0 if the input is not COBS. `out` may be `in`.
inline size_t cobs_decode(const uint8_t* in, size_t size, uint8_t* out) {
  size_t read = 0, written = 0;
  while (read < size) {
    const uint8_t code = in[read++];
    if (code == 0 || read + code - 1 > size) return 0;
    for (uint8_t i = 1; i < code; ++i) out[written++] = in[read++];
    if (code != 0xFF && read < size) out[written++] = 0;
  }
  return written;
}

// `out` needs size + size / 254 + 1 bytes.
inline size_t cobs_encode(const uint8_t* in, size_t size, uint8_t* out) {
  size_t code_at = 0, written = 1;
  uint8_t code = 1;
  for (size_t i = 0; i < size; ++i) {
    if (in[i] != 0) {
      out[written++] = in[i];
      ++code;
    }
    if (in[i] == 0 || (code == 0xFF && i + 1 < size)) {
      out[code_at] = code;
      code_at = written++;
      code = 1;
    }
  }
  out[code_at] = code;
  return written;
}

template <uint16_t kSampleRateHz, uint8_t kChannels, uint16_t kQueueFrames>
class Amplifier {
 public:
  static constexpr uint16_t kBlockFrames = 64;
  static constexpr uint32_t kWatchdogUs = 50000, kCreditEveryUs = 5000;

  // Process bytes from the host.
  void receive(const uint8_t* data, size_t size, uint32_t now_us) {
    for (size_t i = 0; i < size; ++i) {
      if (data[i] != 0) {
        if (filled_ < sizeof(run_)) run_[filled_] = data[i];
        if (filled_ <= sizeof(run_)) ++filled_;
      } else if (filled_ > 0) {
        if (filled_ > sizeof(run_) || !frame(cobs_decode(run_, filled_, run_), now_us)) ++damaged_;
        filled_ = 0;
      }
    }
  }

  // Run the watchdog and send credits. Call it at least every 2 ms.
  void advance(uint32_t now_us) {
    if (!muted_ && now_us - fed_us_ > kWatchdogUs) mute();
    if (now_us - credit_us_ >= kCreditEveryUs) credit(now_us);
  }

  // Write at most `most` bytes for the host into `out`. Returns their number.
  size_t take_outgoing(uint8_t* out, size_t most) {
    const size_t n = outgoing_ < most ? outgoing_ : most;
    memcpy(out, out_, n);
    memmove(out_, out_ + n, outgoing_ - n);
    outgoing_ -= n;
    return n;
  }

  // Get the next sample of each channel. Call it kSampleRateHz times a second.
  void next_frame(int16_t* out) {
    if (flush_) {
      tail_ = head_;
      flush_ = false;
    }
    const uint16_t tail = tail_;
    const bool plays = tail != head_;
    // Wherever this sample does not follow the last one, fade from the last one to it: a step would be felt as a knock.
    if (plays != plays_ || (plays && is_after_gap_[tail])) {
      if (!plays && !muted_) ++underruns_;
      memcpy(held_, last_, sizeof(held_));
      ramp_ = kRampFrames;
      plays_ = plays;
    }
    if (ramp_ > 0) --ramp_;
    for (uint8_t c = 0; c < kChannels; ++c) {
      const int32_t sample = plays ? queue_[tail][c] : 0;
      out[c] = last_[c] = static_cast<int16_t>(sample + (held_[c] - sample) * ramp_ / kRampFrames);
    }
    if (plays) tail_ = (tail + 1) % (kQueueFrames + 1);
  }

  bool muted() const { return muted_; }

 private:
  static constexpr size_t kHeader = 12, kSum = 4;
  static constexpr int32_t kRampFrames = kSampleRateHz / 200;  // 5 ms
  static constexpr size_t kLongest = kHeader + 2u * kChannels * kBlockFrames + kSum;
  enum Type : uint8_t { kHello = 1, kFormat = 2, kPcm = 3, kCredit = 4, kMute = 5 };

  static uint16_t u16(const uint8_t* p) { return static_cast<uint16_t>(p[0] | p[1] << 8); }
  static uint32_t u32(const uint8_t* p) { return u16(p) | static_cast<uint32_t>(u16(p + 2)) << 16; }
  static void put16(uint8_t* p, uint16_t v) { p[0] = v & 0xFF, p[1] = v >> 8; }
  static void put32(uint8_t* p, uint32_t v) { put16(p, v & 0xFFFF), put16(p + 2, v >> 16); }

  uint16_t queued() const {
    const uint16_t head = head_, tail = tail_;
    return flush_ ? 0 : static_cast<uint16_t>((head + kQueueFrames + 1 - tail) % (kQueueFrames + 1));
  }

  // Process the decoded bytes in run_. Returns whether they are a valid frame.
  bool frame(size_t size, uint32_t now_us) {
    if (size < kHeader + kSum || run_[0] != 1 || crc32(run_, size - kSum) != u32(run_ + size - kSum)) return false;
    const uint8_t type = run_[1], channels = run_[4], format = run_[5];
    const uint16_t count = u16(run_ + 6);
    const size_t payload = size - kHeader - kSum;
    if (type == kPcm) {
      if (payload != (format == 1 ? size_t{2} * channels * count : 0) || (format != 1 && count)) return false;
      if (greeted_) pcm(u16(run_ + 2), channels, count, now_us);
      return true;
    }
    if (payload != count) return false;
    if (type == kHello) greet();
    if (type == kMute) mute();
    return true;
  }

  void greet() {
    greeted_ = true;
    heard_ = false;
    mute();
    accepted_ = damaged_ = underruns_ = 0;
    uint8_t said[kHeader + 9 + kSum] = {1, kFormat, 0, 0, 0, 0, 9};
    put32(said + kHeader, kSampleRateHz);
    said[kHeader + 4] = kChannels;
    put16(said + kHeader + 5, kQueueFrames);
    put16(said + kHeader + 7, kBlockFrames);
    say(said, sizeof(said));
  }

  void pcm(uint16_t sequence, uint8_t channels, uint16_t count, uint32_t now_us) {
    const uint16_t ahead = static_cast<uint16_t>(sequence - sequence_);
    if ((heard_ && (ahead == 0 || ahead >= 0x8000)) || channels > kChannels) return;
    is_gap_ = is_gap_ || (heard_ && ahead != 1);
    heard_ = true;
    sequence_ = sequence;
    echo_us_ = u32(run_ + 8);
    // While the interrupt has not emptied the queue yet, its free space is unknown. The host sends again.
    const bool is_taken = count && !flush_ && queued() + count <= kQueueFrames;
    if (is_taken) {
      const uint8_t* p = run_ + kHeader;
      uint16_t head = head_;
      for (uint16_t n = 0; n < count; ++n) {
        for (uint8_t c = 0; c < kChannels; ++c) queue_[head][c] = 0;
        for (uint8_t c = 0; c < channels; ++c, p += 2) queue_[head][c] = static_cast<int16_t>(u16(p));
        is_after_gap_[head] = is_gap_ && n == 0;
        head = (head + 1) % (kQueueFrames + 1);
      }
      head_ = head;
      accepted_ += count;
      fed_us_ = now_us;
      muted_ = false;
    }
    if (count) is_gap_ = !is_taken;
    credit(now_us);
  }

  void mute() {
    muted_ = true;
    flush_ = true;
  }

  void credit(uint32_t now_us) {
    credit_us_ = now_us;
    uint8_t said[kHeader + 19 + kSum] = {1, kCredit, 0, 0, 0, 0, 19};
    uint8_t* p = said + kHeader;
    put32(said + 8, echo_us_);
    put16(p, sequence_);
    p[2] = static_cast<uint8_t>(greeted_ | heard_ << 1 | muted_ << 2);
    const uint16_t waiting = queued();
    put16(p + 3, flush_ ? 0 : kQueueFrames - waiting);
    put16(p + 5, waiting);
    put32(p + 7, accepted_);
    put32(p + 11, damaged_);
    put32(p + 15, underruns_);
    say(said, sizeof(said));
  }

  // If the host does not read, credits are dropped; later credits contain the same values.
  void say(uint8_t* frame, size_t size) {
    put32(frame + size - kSum, crc32(frame, size - kSum));
    if (outgoing_ + size + size / 254 + 3 > sizeof(out_)) return;
    out_[outgoing_++] = 0;
    outgoing_ += cobs_encode(frame, size, out_ + outgoing_);
    out_[outgoing_++] = 0;
  }

  uint8_t run_[kLongest + kLongest / 254 + 1];
  size_t filled_ = 0;
  uint8_t out_[256];
  size_t outgoing_ = 0;
  int16_t queue_[kQueueFrames + 1][kChannels] = {};
  volatile uint16_t head_ = 0, tail_ = 0;
  volatile bool flush_ = false, muted_ = true;
  volatile uint32_t underruns_ = 0;
  bool is_after_gap_[kQueueFrames + 1] = {};
  bool is_gap_ = false;
  int16_t held_[kChannels] = {}, last_[kChannels] = {};
  bool plays_ = false;
  int32_t ramp_ = 0;
  bool greeted_ = false, heard_ = false;
  uint16_t sequence_ = 0;
  uint32_t echo_us_ = 0, fed_us_ = 0, credit_us_ = 0, accepted_ = 0, damaged_ = 0;
};

}  // namespace scene2hap
