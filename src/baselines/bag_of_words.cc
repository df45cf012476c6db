// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/bag_of_words.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace sslcd::baselines {
namespace {

// Index of the nearest centre; the first one on a tie.
int Nearest(const BinaryDescriptor& descriptor, const std::vector<BinaryDescriptor>& centres) {
  int best = 0, least = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const int distance = HammingDistance(descriptor, centres[i]);
    if (distance < least) {
      least = distance;
      best = static_cast<int>(i);
    }
  }
  return best;
}

// Majority vote of each bit.
BinaryDescriptor Majority(const std::vector<const BinaryDescriptor*>& members) {
  BinaryDescriptor centre{};
  for (int bit = 0; bit < 256; ++bit) {
    std::size_t ones = 0;
    for (const BinaryDescriptor* member : members) ones += ((*member)[bit / 64] >> (bit % 64)) & 1u;
    if (2 * ones > members.size()) centre[bit / 64] |= std::uint64_t{1} << (bit % 64);
  }
  return centre;
}

// Distant initial centres: each next one is the member farthest from the previous ones.
std::vector<BinaryDescriptor> Seeds(const std::vector<const BinaryDescriptor*>& members,
                                    int count) {
  std::vector<BinaryDescriptor> seeds{*members[0]};
  std::vector<int> distance(members.size(), std::numeric_limits<int>::max());
  while (static_cast<int>(seeds.size()) < count) {
    for (std::size_t i = 0; i < members.size(); ++i)
      distance[i] = std::min(distance[i], HammingDistance(*members[i], seeds.back()));
    const auto furthest = std::max_element(distance.begin(), distance.end());
    if (*furthest == 0) break;
    seeds.push_back(*members[furthest - distance.begin()]);
  }
  return seeds;
}

}  // namespace

int HammingDistance(const BinaryDescriptor& a, const BinaryDescriptor& b) {
  int bits = 0;
  for (std::size_t i = 0; i < a.size(); ++i) bits += __builtin_popcountll(a[i] ^ b[i]);
  return bits;
}

double Similarity(const WordVector& v, const WordVector& w) {
  double common = 0;  // |v - w| = 2 - 2 sum of the smaller weights, since both sum to one
  for (const auto& [word, weight] : v) {
    const auto other = w.find(word);
    if (other != w.end()) common += std::min(weight, other->second);
  }
  return common;
}

Vocabulary::Vocabulary(const std::vector<std::vector<BinaryDescriptor>>& images, int branching,
                       int levels) {
  std::vector<const BinaryDescriptor*> all;
  for (const auto& image : images)
    for (const BinaryDescriptor& descriptor : image) all.push_back(&descriptor);
  nodes_.emplace_back();
  Split(0, all, branching, levels);
  std::vector<int> images_with(weight_.size(), 0);
  for (const auto& image : images) {
    std::set<int> words;
    for (const BinaryDescriptor& descriptor : image) words.insert(WordOf(descriptor));
    for (const int word : words) ++images_with[word];
  }
  for (std::size_t word = 0; word < weight_.size(); ++word)
    weight_[word] = std::log(static_cast<double>(images.size()) / std::max(1, images_with[word]));
}

void Vocabulary::Split(int node, const std::vector<const BinaryDescriptor*>& members, int branching,
                       int levels) {
  constexpr int kRounds = 5;
  if (levels == 0 || static_cast<int>(members.size()) <= branching) {
    nodes_[node].word = static_cast<int>(weight_.size());
    weight_.push_back(0);
    return;
  }
  std::vector<BinaryDescriptor> centres = Seeds(members, branching);
  std::vector<std::vector<const BinaryDescriptor*>> parts;
  for (int round = 0; round < kRounds; ++round) {
    parts.assign(centres.size(), {});
    for (const BinaryDescriptor* member : members)
      parts[Nearest(*member, centres)].push_back(member);
    for (std::size_t i = 0; i < centres.size(); ++i)
      if (!parts[i].empty()) centres[i] = Majority(parts[i]);
  }
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (parts[i].empty()) continue;
    const int child = static_cast<int>(nodes_.size());
    nodes_.emplace_back();
    nodes_[child].centre = centres[i];
    nodes_[node].children.push_back(child);
    Split(child, parts[i], branching, parts.size() > 1 ? levels - 1 : 0);
  }
}

int Vocabulary::WordOf(const BinaryDescriptor& descriptor) const {
  int node = 0;
  while (!nodes_[node].children.empty()) {
    int best = -1, least = std::numeric_limits<int>::max();
    for (const int child : nodes_[node].children) {
      const int distance = HammingDistance(descriptor, nodes_[child].centre);
      if (distance < least) {
        least = distance;
        best = child;
      }
    }
    node = best;
  }
  return nodes_[node].word;
}

WordVector Vocabulary::Words(const std::vector<BinaryDescriptor>& image) const {
  WordVector words;
  double sum = 0;
  for (const BinaryDescriptor& descriptor : image) {
    const int word = WordOf(descriptor);
    if (!(weight_[word] > 0)) continue;  // a word of every image has no weight
    words[word] += weight_[word];
    sum += weight_[word];
  }
  for (auto& [word, weight] : words) weight /= sum;
  return words;
}

}  // namespace sslcd::baselines
