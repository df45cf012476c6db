// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/recording.h"

#include <iterator>
#include <utility>

#include "detectors/model_description.h"
#include "formats/boxes.h"
#include "sslcd/core/log.h"

namespace sslcd {
namespace {

void WarnOfBoxesBeyond(const BoxesByFrame& boxes, int frames, const std::string& path) {
  const auto count = std::distance(boxes.lower_bound(frames), boxes.end());
  if (count > 0)
    Log(LogLevel::kWarning, path + ": has boxes of " + std::to_string(count) +
                                " frames after the last one (" + std::to_string(frames - 1) +
                                "); they are left out");
}

}  // namespace

bool LiftsBoxes(const ImageRequest& request, const VisionOptions& vision) {
  if (!request.detections) return false;
  if (!request.boxes.empty()) return true;
  return !vision.detector.empty() &&
         TaskOf(LoadModelDescription(vision.detector).output.layout) == ModelTask::kDetect2d;
}

bool MeasuresByStereo(const ImageRequest& request, const VisionOptions& vision) {
  return request.odometry || LiftsBoxes(request, vision);
}

StereoCamera StereoCameraOf(const Dataset& dataset) {
  try {
    return MakeStereoCamera(*dataset.camera, *dataset.camera_right);
  } catch (const Error& error) {
    throw Error(error.kind(), {dataset.name}, error.what());
  }
}

ImageSource InspectImages(const ImageRequest& request, const VisionOptions& vision,
                          const StereoFiles& files, Dataset& dataset) {
  ImageSource source;
  source.lifted_boxes = LiftsBoxes(request, vision);
  source.stereo_odometry = request.odometry;
  source.has_detections = dataset.detections_path.empty() || dataset.rows_read > 0;
  if (!dataset.camera || !dataset.camera_right) return source;
  if (source.stereo_odometry || source.lifted_boxes) {
    const RigCheck check = CheckRig(files, StereoCameraOf(dataset), vision.odometry);
    dataset.camera_right->cx = dataset.camera->cx - check.disparity_at_infinity;
    if (check.row_error) source.row_error_rad = *check.row_error / dataset.camera->fy;
  }
  if (request.alignment)
    source.alignment_range_m = AlignmentRange(files, *dataset.camera, vision.lift.ground.height_m);
  return source;
}

ImageSequence MakeImageSequence(const ImageRequest& request, Dataset& dataset) {
  if (!dataset.camera || !dataset.camera_right)
    throw Error(ErrorKind::kBadInput, {dataset.name},
                "needs calib.txt (raw drives: calib_cam_to_cam.txt) with P2 and P3, of grey images "
                "P0 and P1, to make anything from its images");
  ImageSequence sequence;
  sequence.odometry = request.odometry;
  sequence.detections = request.detections;
  sequence.camera = StereoCameraOf(dataset);
  if (request.detections && !request.boxes.empty()) {
    sequence.boxes = ReadBoxes(request.boxes);
    WarnOfBoxesBeyond(*sequence.boxes, static_cast<int>(dataset.frames.size()), request.boxes);
  }
  sequence.frames = std::move(dataset.frames);
  return sequence;
}

ViewAligner MakeGroundAligner(const ImageRequest& request, const Dataset& dataset,
                              const VisionOptions& vision, const StereoFiles& files,
                              GroundAlignerOptions options) {
  if (!request.alignment || !dataset.camera || !dataset.camera_right || !files.HasPairs())
    return {};
  options.check_rig = vision.odometry.calibrate && !MeasuresByStereo(request, vision);
  try {
    return MakeGroundAligner(files, StereoCameraOf(dataset), vision, std::move(options));
  } catch (const Error& error) {  // a run with given detections needs no stereo pair
    Log(LogLevel::kWarning,
        std::string("images of different passes are not aligned: ") + error.what());
    return {};
  }
}

std::optional<Frame> NextFrame(ImageFrontend& frontend, std::size_t done,
                               std::optional<Error>& failure) {
  try {
    return frontend.Next();
  } catch (const Error& error) {
    if (done == 0 || error.kind() == ErrorKind::kNoSolution) throw;
    failure = error;
    return std::nullopt;
  }
}

}  // namespace sslcd
