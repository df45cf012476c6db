// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace sslcd::baselines {

/// 256 bits, e.g. of ORB or BRIEF.
using BinaryDescriptor = std::array<std::uint64_t, 4>;

/// Hamming distance.
int HammingDistance(const BinaryDescriptor& a, const BinaryDescriptor& b);

/// The words of an image with tf-idf weights, which sum to one.
using WordVector = std::map<int, double>;

/// 1 - |v - w|_1 / 2: 0 for images without a common word, 1 for equal ones (Galvez-Lopez and
/// Tardos, Eq. 2).
double Similarity(const WordVector& v, const WordVector& w);

/// A vocabulary tree: k-means with majority votes of bits, level by level. Deterministic.
class Vocabulary {
 public:
  /// Builds the tree from the descriptors of several images. Its leaves are the words. These images
  /// also give the inverse document frequencies.
  Vocabulary(const std::vector<std::vector<BinaryDescriptor>>& images, int branching, int levels);

  WordVector Words(const std::vector<BinaryDescriptor>& image) const;
  int size() const { return static_cast<int>(weight_.size()); }

 private:
  struct Node {
    BinaryDescriptor centre{};
    std::vector<int> children;
    int word = -1;
  };
  void Split(int node, const std::vector<const BinaryDescriptor*>& members, int branching,
             int levels);
  int WordOf(const BinaryDescriptor& descriptor) const;

  std::vector<Node> nodes_;
  std::vector<double> weight_;  // by word
};

}  // namespace sslcd::baselines
