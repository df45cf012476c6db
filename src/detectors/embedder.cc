// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/detectors/embedder.h"

#include <algorithm>
#include <cmath>

#include "detectors/model.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr std::size_t kLargestBatch = 32;  // bounds memory if the model accepts any batch size

/// The pixels that a box touches; empty if there are none.
ImageView PixelsIn(const ImageView& image, const Box2d& box) {
  const auto column = [&](double x) {
    return static_cast<int>(std::clamp(x, 0., static_cast<double>(image.width)));
  };
  const auto row = [&](double y) {
    return static_cast<int>(std::clamp(y, 0., static_cast<double>(image.height)));
  };
  if (!(box.Area() > 0)) return {};
  const int left = column(std::floor(box.left)), right = column(std::ceil(box.right));
  const int top = row(std::floor(box.top)), bottom = row(std::ceil(box.bottom));
  if (left >= right || top >= bottom) return {};
  ImageView pixels = image;
  pixels.data += top * image.stride + static_cast<std::size_t>(left) * image.channels;
  pixels.width = right - left;
  pixels.height = bottom - top;
  return pixels;
}

std::vector<float> UnitVector(const float* values, std::size_t size) {
  double sum = 0;
  for (std::size_t i = 0; i < size; ++i) sum += static_cast<double>(values[i]) * values[i];
  std::vector<float> unit(values, values + size);
  if (sum > 0)
    for (float& value : unit) value = static_cast<float>(value / std::sqrt(sum));
  return unit;
}

}  // namespace

struct SSLCD_HIDDEN Embedder::Impl {
  Model model;
  int dimension = 0;
};

Embedder::Embedder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Embedder::Embedder(Embedder&&) noexcept = default;
Embedder& Embedder::operator=(Embedder&&) noexcept = default;
Embedder::~Embedder() = default;

Embedder Embedder::Load(const std::string& model_yaml, const InferenceOptions& options) {
  auto impl = std::make_unique<Impl>(Impl{Model(model_yaml, ModelTask::kEmbed, options)});
  impl->dimension = static_cast<int>(impl->model.Run(impl->model.EmptyInput(1))[0].shape[1]);
  return Embedder(std::move(impl));
}

std::vector<std::vector<float>> Embedder::Embed(const ImageView& image,
                                                const std::vector<Box2d>& boxes,
                                                TimingTable* timing) const {
  const Model& model = impl_->model;
  CheckImage(image, "image");
  std::vector<std::vector<float>> embeddings(boxes.size());
  std::vector<std::pair<std::size_t, ImageView>> crops;  // boxes with pixels, by index
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const ImageView pixels = PixelsIn(image, boxes[i]);
    if (pixels.data) crops.emplace_back(i, pixels);
  }
  const std::size_t batch = model.fixed_batch() > 0 ? model.fixed_batch() : kLargestBatch;
  for (std::size_t first = 0; first < crops.size(); first += batch) {
    const std::size_t count = std::min(batch, crops.size() - first);
    Tensor input = model.EmptyInput(static_cast<int>(count));
    {
      const auto timer = model.Time(timing, "prepare");
      const std::size_t size = ElementCount({3, model.height(), model.width()});
      for (std::size_t i = 0; i < count; ++i)
        Prepare(crops[first + i].second, model.description().input, model.width(), model.height(),
                "image", input.values.data() + i * size);
    }
    const auto timer = model.Time(timing, "run");
    const Tensor vectors = model.Run(std::move(input))[0];
    const std::size_t dimension = vectors.shape[1];
    if (static_cast<std::size_t>(vectors.shape[0]) < count)
      throw Error(ErrorKind::kBadInput, {model.description().file},
                  "returns " + ToString(vectors.shape) + " for " + std::to_string(count) +
                      " images: export it with a batch of any size, or of one");
    for (std::size_t i = 0; i < count; ++i)
      embeddings[crops[first + i].first] =
          UnitVector(vectors.values.data() + i * dimension, dimension);
  }
  return embeddings;
}

const std::string& Embedder::name() const { return impl_->model.description().name; }
int Embedder::dimension() const { return impl_->dimension; }

}  // namespace sslcd
