// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/detectors/detector_3d.h"

#include <algorithm>
#include <cmath>

#include "detectors/decode_3d.h"
#include "detectors/model.h"
#include "perception/projection.h"
#include "sslcd/core/error.h"

namespace sslcd {

Camera CameraOfInput(const Camera& left, const InputMap& map) {
  Camera camera = left;
  camera.fx = left.fx * map.scale_x;
  camera.fy = left.fy * map.scale_y;
  const Vec2 principal_point = map.ToInput(left.cx, left.cy);
  camera.cx = principal_point.x();
  camera.cy = principal_point.y();
  return camera;
}

Detection CuboidInCamera(const ClassCuboid& cuboid, const Camera& camera) {
  const double z = cuboid.depth_m;
  const Vec3 in_left((cuboid.centre_x - camera.cx) * z / camera.fx,
                     (cuboid.centre_y - camera.cy) * z / camera.fy, z);
  const Vec3 centre = in_left - camera.offset;
  const double rotation_y = cuboid.alpha_rad + std::atan2(centre.x(), centre.z());
  Detection detection;
  // KITTI rotates about down, sslcd about up
  detection.T_cam_object = Pose(GravityFrame().Upright(-rotation_y), centre);
  detection.dims = cuboid.dims;
  return detection;
}

struct SSLCD_HIDDEN Detector3d::Impl {
  Model model;
  std::map<int, AnchorPriors> priors;

  std::vector<ClassCuboid> Decode(const std::vector<Tensor>& outputs, const Camera& camera) const {
    const ModelOutput& output = model.description().output;
    return HasAnchors(output.layout)
               ? DecodeAnchors(outputs, output, priors, camera, model.width(), model.height())
               : DecodeMonoFlex(outputs, output, model.width());
  }
};

Detector3d::Detector3d(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Detector3d::Detector3d(Detector3d&&) noexcept = default;
Detector3d& Detector3d::operator=(Detector3d&&) noexcept = default;
Detector3d::~Detector3d() = default;

Detector3d Detector3d::Load(const std::string& model_yaml, const InferenceOptions& options) {
  auto impl = std::make_unique<Impl>(Impl{Model(model_yaml, ModelTask::kDetect3d, options), {}});
  const ModelOutput& output = impl->model.description().output;
  if (HasAnchors(output.layout)) impl->priors = LoadAnchorPriors(output);
  return Detector3d(std::move(impl));
}

std::vector<Detection> Detector3d::Detect(const StereoView& images, const StereoCamera& camera,
                                          TimingTable* timing) const {
  const Model& model = impl_->model;
  const ModelOutput& output = model.description().output;
  if (model.takes_two_images()) CheckImages(images);
  Tensor left = model.EmptyInput(1);
  std::optional<Tensor> right;
  InputMap map;
  {
    const auto timer = model.Time(timing, "prepare");
    const auto prepare = [&](const ImageView& image, const char* what, Tensor& tensor) {
      return Prepare(image, model.description().input, model.width(), model.height(), what,
                     tensor.values.data());
    };
    map = prepare(images.left, "left image", left);
    if (model.takes_two_images())
      prepare(images.right, "right image", right.emplace(model.EmptyInput(1)));
  }
  std::vector<Tensor> outputs;
  {
    const auto timer = model.Time(timing, "run");
    outputs = model.Run(std::move(left), std::move(right));
  }
  const auto timer = model.Time(timing, "decode");
  Camera image_camera = camera.left;
  image_camera.width = images.left.width;
  image_camera.height = images.left.height;
  const Camera input_camera = CameraOfInput(camera.left, map);
  std::vector<Detection> candidates;
  std::vector<ClassBox> boxes;
  for (const ClassCuboid& cuboid : impl_->Decode(outputs, input_camera)) {
    Detection detection = CuboidInCamera(cuboid, input_camera);
    // the cuboid is not in front of the camera
    if (!(detection.dims.minCoeff() > 0) || !(cuboid.depth_m > 0)) continue;
    detection.score = cuboid.found.score;
    detection.label = output.labels.at(cuboid.found.class_number);
    detection.box = cuboid.found.box.Area() > 0
                        ? BoxInImage(cuboid.found.box, map, images.left.width, images.left.height)
                        : ProjectCuboid(detection.T_cam_object, detection.dims, image_camera);
    if (!detection.box || detection.box->Area() <= 0) continue;  // out of view
    candidates.push_back(detection);
    boxes.push_back({cuboid.found.class_number, detection.score, *detection.box});
  }
  std::vector<Detection> detections;
  for (const std::size_t kept : SuppressOverlaps(boxes, output))
    detections.push_back(candidates[kept]);
  return detections;
}

const std::string& Detector3d::name() const { return impl_->model.description().name; }
bool Detector3d::uses_right_image() const { return impl_->model.takes_two_images(); }

}  // namespace sslcd
