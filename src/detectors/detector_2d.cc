// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/detectors/detector_2d.h"

#include "detectors/decode_2d.h"
#include "detectors/model.h"

namespace sslcd {

struct SSLCD_HIDDEN Detector2d::Impl {
  Model model;
};

Detector2d::Detector2d(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Detector2d::Detector2d(Detector2d&&) noexcept = default;
Detector2d& Detector2d::operator=(Detector2d&&) noexcept = default;
Detector2d::~Detector2d() = default;

Detector2d Detector2d::Load(const std::string& model_yaml, const InferenceOptions& options) {
  return Detector2d(std::make_unique<Impl>(Impl{Model(model_yaml, ModelTask::kDetect2d, options)}));
}

std::vector<ImageDetection> Detector2d::Detect(const ImageView& image, TimingTable* timing) const {
  const Model& model = impl_->model;
  const ModelOutput& output = model.description().output;
  Tensor input = model.EmptyInput(1);
  InputMap map;
  {
    const auto timer = model.Time(timing, "prepare");
    map = Prepare(image, model.description().input, model.width(), model.height(), "image",
                  input.values.data());
  }
  std::vector<Tensor> outputs;
  {
    const auto timer = model.Time(timing, "run");
    outputs = model.Run(std::move(input));
  }
  const auto timer = model.Time(timing, "decode");
  std::vector<ImageDetection> detections;
  const std::vector<ClassBox> boxes = DecodeBoxes(outputs, output, model.width(), model.height());
  for (const std::size_t i : SuppressOverlaps(boxes, output)) {
    const Box2d box = BoxInImage(boxes[i].box, map, image.width, image.height);
    if (box.Area() > 0)
      detections.push_back({output.labels.at(boxes[i].class_number), boxes[i].score, box});
  }
  return detections;
}

const std::string& Detector2d::name() const { return impl_->model.description().name; }

double Detector2d::box_sigma() const { return impl_->model.description().output.box_sigma; }

}  // namespace sslcd
