// SPDX-License-Identifier: BSD-3-Clause
#include "store/frame_bytes.h"

#include "store/bytes.h"

namespace sslcd {
namespace {

// bits of the byte before a step
constexpr int kHasStep = 1, kStepIsLost = 2;

void AppendDetection(const Detection& detection, ByteWriter& bytes) {
  bytes.Int(detection.row).Text(detection.label).Real(detection.score);
  bytes.Reals(detection.T_cam_object.data(), 7).Reals(detection.dims.data(), 3);
  bytes.Byte(detection.box ? 1 : 0);
  if (detection.box)
    bytes.Real(detection.box->left)
        .Real(detection.box->top)
        .Real(detection.box->right)
        .Real(detection.box->bottom);
  for (const CueRow& row : kCueRows) {
    const std::vector<float>& vector = detection.appearance[row.cue];
    bytes.Int(static_cast<std::int32_t>(vector.size()));
    for (const float value : vector) bytes.Float(value);
  }
}

Detection ReadDetection(ByteReader& bytes) {
  Detection detection;
  detection.row = bytes.Int();
  detection.label = bytes.Text();
  detection.score = bytes.Real();
  bytes.Reals(detection.T_cam_object.data(), 7);
  bytes.Reals(detection.dims.data(), 3);
  if (bytes.Byte() != 0) {
    Box2d box;
    for (double* side : {&box.left, &box.top, &box.right, &box.bottom}) *side = bytes.Real();
    detection.box = box;
  }
  for (const CueRow& row : kCueRows) {
    std::vector<float>& vector = detection.appearance[row.cue];
    vector.resize(static_cast<std::size_t>(bytes.Count(4)));
    for (float& value : vector) value = bytes.Float();
  }
  return detection;
}

}  // namespace

std::string FrameBytes(const Frame& frame) {
  ByteWriter bytes;
  bytes.Int(frame.index).Real(frame.stamp).Reals(frame.T_odom_cam.data(), 7);
  bytes.Byte(frame.step ? kHasStep + (frame.step->lost ? kStepIsLost : 0) : 0);
  if (frame.step) bytes.Real(frame.step->translation_m).Real(frame.step->rotation_rad);
  bytes.Int(static_cast<std::int32_t>(frame.detections.size()));
  for (const Detection& detection : frame.detections) AppendDetection(detection, bytes);
  return bytes.Take();
}

Frame FrameOf(std::string_view text) {
  ByteReader bytes(text);
  Frame frame;
  frame.index = bytes.Int();
  frame.stamp = bytes.Real();
  bytes.Reals(frame.T_odom_cam.data(), 7);
  if (const int flags = bytes.Byte(); (flags & kHasStep) != 0) {
    frame.step = StepUncertainty{(flags & kStepIsLost) != 0};
    frame.step->translation_m = bytes.Real();
    frame.step->rotation_rad = bytes.Real();
  }
  constexpr int kLeastBytes = 105;  // of a detection
  const int count = bytes.Count(kLeastBytes);
  for (int i = 0; i < count; ++i) frame.detections.push_back(ReadDetection(bytes));
  bytes.ExpectEnd();
  return frame;
}

std::string RefinementBytes(const RefinementInput& refinement) {
  ByteWriter bytes;
  bytes.Byte(refinement.when == Refinement::kAtEnd ? 0 : 1);
  bytes.Int(static_cast<std::int32_t>(refinement.views.size()));
  for (const AlignedView& view : refinement.views) {
    bytes.Int(view.a_frame).Int(view.b_frame).Byte(view.T_a_b ? 1 : 0);
    if (view.T_a_b)
      bytes.Reals(view.T_a_b->T_a_b.data(), 7).Reals(view.T_a_b->covariance.data(), 36);
  }
  return bytes.Take();
}

RefinementInput RefinementOf(std::string_view text) {
  ByteReader bytes(text);
  RefinementInput refinement;
  refinement.when = bytes.Byte() == 0 ? Refinement::kAtEnd : Refinement::kOnTheWay;
  constexpr int kLeastBytes = 9;  // of a pair
  refinement.views.resize(static_cast<std::size_t>(bytes.Count(kLeastBytes)));
  for (AlignedView& view : refinement.views) {
    view.a_frame = bytes.Int();
    view.b_frame = bytes.Int();
    if (bytes.Byte() == 0) continue;
    view.T_a_b.emplace();
    bytes.Reals(view.T_a_b->T_a_b.data(), 7);
    bytes.Reals(view.T_a_b->covariance.data(), 36);
  }
  bytes.ExpectEnd();
  return refinement;
}

}  // namespace sslcd
