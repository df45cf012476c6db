// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/checksum.h"

#include <algorithm>
#include <cstring>

namespace sslcd {
namespace {

// Odd, so that a product with it loses nothing.
constexpr std::uint64_t kFactor = 0x9E3779B97F4A7C15u;

std::uint64_t Mix(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * kFactor;
  return hash ^ hash >> 32;
}

}  // namespace

// Four lanes, each a chain of one-to-one functions, so that processors work on them at one time.
std::uint64_t FastChecksum(const char* bytes, std::size_t size) {
  constexpr std::size_t kLanes = 4, kWord = sizeof(std::uint64_t);
  std::uint64_t lane[kLanes] = {1, 2, 3, 4};
  std::size_t at = 0;
  for (; size - at >= kLanes * kWord; at += kLanes * kWord) {
    std::uint64_t words[kLanes];
    std::memcpy(words, bytes + at, sizeof words);
    for (std::size_t i = 0; i < kLanes; ++i) lane[i] = Mix(lane[i], words[i]);
  }
  for (; at < size; at += kWord) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + at, std::min(kWord, size - at));
    lane[0] = Mix(lane[0], word);
  }
  std::uint64_t hash = size;
  for (const std::uint64_t each : lane) hash = Mix(hash, each);
  return hash;
}

}  // namespace sslcd
