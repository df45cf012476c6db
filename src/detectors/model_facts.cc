// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/model_facts.h"

#include <algorithm>

#include "detectors/class_names.h"
#include "detectors/model_description.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr std::int64_t kLargestValues = 1 << 28;  // of an input
constexpr float kGreyInput = 0.5f;                // within 0..1 and within 0..255

[[noreturn]] void RefuseModel(const std::string& path, const std::string& message) {
  throw Error(ErrorKind::kBadInput, {path}, message + "; docs/models.md");
}

std::string Listed(const std::vector<TensorInfo>& tensors) {
  std::string text;
  for (const TensorInfo& info : tensors)
    text +=
        (text.empty() ? "'" : ", '") + info.name + "' " + info.type + " " + ToString(info.shape);
  return text;
}

/// The size of a side, from what the model and the caller say.
int SideOf(const std::string& path, const TensorInfo& image, std::size_t dimension, int wanted) {
  const std::int64_t own = image.shape[dimension];
  if (own > 0 && wanted > 0 && own != wanted)
    RefuseModel(path, "input '" + image.name + "' is " + ToString(image.shape) +
                          ", another size than was asked for: leave --width and --height out");
  if (own <= 0 && wanted <= 0)
    RefuseModel(path, "input '" + image.name + "' takes images of any size (" +
                          ToString(image.shape) +
                          "): give the size to use with --width and --height, multiples of 32 near "
                          "the size of your images");
  if (own > kLargestInput)
    RefuseModel(path, "input '" + image.name + "' is " + ToString(image.shape) +
                          ": images of at most " + std::to_string(kLargestInput) +
                          " pixels a side can be given to it");
  return static_cast<int>(own > 0 ? own : wanted);
}

void FindInputs(ModelFacts& facts, int width_px, int height_px) {
  for (const TensorInfo& info : facts.inputs) {
    if (Fits(info.shape, {-1, 3, -1, -1})) {
      facts.images.push_back(info.name);
      facts.height_px = SideOf(facts.file, info, 2, height_px);
      facts.width_px = SideOf(facts.file, info, 3, width_px);
    } else if (Fits(info.shape, {-1, 2}) && facts.size.empty()) {
      facts.size = info.name;
    } else {
      const bool last = Fits(info.shape, {-1, -1, -1, 3});
      RefuseModel(facts.file, "input '" + info.name + "' is " + ToString(info.shape) +
                                  ", but an image is " + "batch x 3 x height x width" +
                                  (last ? ": export the model with its channels first (NCHW)"
                                        : "; it has " + Listed(facts.inputs)));
    }
  }
  if (facts.images.empty())
    RefuseModel(facts.file, "no input takes an image (batch x 3 x height x width): it has " +
                                Listed(facts.inputs));
}

// The number of images that an input takes at once.
std::int64_t BatchOf(const ModelFacts& facts, const TensorInfo& image) {
  const std::int64_t batch = std::max<std::int64_t>(image.shape[0], 1);
  if (batch <= kLargestValues / (3 * std::int64_t{facts.width_px} * facts.height_px)) return batch;
  RefuseModel(facts.file, "input '" + image.name + "' is " + ToString(image.shape) +
                              ": too many values for one run; export the model for one image");
}

NamedTensors GreyInputs(const ModelFacts& facts) {
  NamedTensors inputs;
  for (const TensorInfo& info : facts.inputs) {
    if (info.name == facts.size) {
      inputs[info.name] = {
          {1, 2}, {static_cast<float>(facts.width_px), static_cast<float>(facts.height_px)}};
      continue;
    }
    Tensor image{{BatchOf(facts, info), 3, facts.height_px, facts.width_px}, {}};
    image.values.assign(ElementCount(image.shape), kGreyInput);
    inputs[info.name] = std::move(image);
  }
  return inputs;
}

}  // namespace

ModelFacts InspectModel(const std::string& path, int width_px, int height_px,
                        const InferenceOptions& options) {
  const Session session(path, options);
  ModelFacts facts;
  facts.file = path;
  facts.inputs = session.inputs();
  facts.outputs = session.outputs();
  facts.class_names = ReadClassNames(session.Metadata("names"));
  FindInputs(facts, width_px, height_px);
  NamedTensors answers = session.Run(GreyInputs(facts));
  for (const TensorInfo& info : facts.outputs)
    facts.answers.push_back(std::move(answers.at(info.name)));
  return facts;
}

}  // namespace sslcd
