// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/image_frontend.h"

#include <algorithm>
#include <utility>

#include "frontend/background.h"
#include "frontend/class_file.h"
#include "frontend/ground_check.h"
#include "frontend/object_finder.h"
#include "sslcd/core/error.h"
#include "sslcd/core/log.h"

namespace sslcd {
namespace {

constexpr int kGroundEvery = 10;  // frames from one check of the ground to the next; set by hand
// Frames in the queue between two stages, to even out slow frames; each has two images. Set
// by hand.
constexpr std::size_t kAhead = 4;

// An error of a frame's images, with their names.
template <class F>
void Naming(const Frame& frame, const F& work) {
  try {
    work();
  } catch (const Error& error) {
    throw Error(error.kind(), {frame.image_left}, error.what());
  }
}

}  // namespace

struct SSLCD_HIDDEN ImageFrontend::Impl {
  /// A frame in the pipeline.
  struct Item {
    Frame frame;
    Image left, right;
    std::vector<std::string> warnings;
    bool complete() const { return !left.empty(); }
    StereoView view() const { return {left.view(), right.view()}; }
  };

  ~Impl() { Stop(); }
  // Later stages use earlier ones, so they are destroyed first.
  void Stop() {
    stages = {};
    while (!running.empty()) running.pop_back();
  }

  ImageSequence sequence;
  VisionOptions options;
  FrontendHooks hooks;
  std::optional<StereoOdometry> odometry;
  std::optional<ObjectFinder> finder;

  std::size_t next_frame = 0;
  int rows = 0, followed = 0;  // number of detections; frames with a measured pose
  std::string lost_because;    // reason of the first lost frame
  // One report per stage, since the stages run in parallel.
  FrontendReport loaded, tracked, found;

  Source<Item> stages;
  std::vector<std::unique_ptr<Background<Item>>> running;  // the last stage pulls from the others

  std::optional<Item> Load() {
    if (next_frame == sequence.frames.size()) return std::nullopt;
    Item item;
    item.frame = std::move(sequence.frames[next_frame++]);
    const ScopedTimer timer(loaded.timing, "image loading");
    ++loaded.frames;
    for (const auto& [path, image] :
         {std::pair(&item.frame.image_left, &item.left), {&item.frame.image_right, &item.right}})
      if (!path->empty()) *image = hooks.load(*path);
    if (item.left.empty() || item.right.empty()) {
      ++loaded.images_failed;
      const bool right = !item.left.empty();
      const std::string& path = right ? item.frame.image_right : item.frame.image_left;
      item.warnings.push_back((path.empty() ? "frame " + std::to_string(item.frame.index) +
                                                  " has no " + (right ? "right" : "left") + " image"
                                            : path + ": no image that can be read") +
                              "; the frame goes without detections" +
                              (odometry ? ", its pose is guessed" : ""));
      item.left = item.right = {};
    }
    return item;
  }

  std::optional<Item> Track(std::optional<Item> item) {
    if (!item) return item;
    const ScopedTimer timer(tracked.timing, "stereo odometry");
    OdometryStep step;
    if (item->complete())
      Naming(item->frame, [&] { step = odometry->AddFrame(item->view()); });
    else
      step = odometry->AddMissingFrame();
    item->frame.T_odom_cam = step.T_odom_cam;
    followed += step.status == OdometryStatus::kTracked;
    if (step.status == OdometryStatus::kLost) {
      ++tracked.lost;
      if (lost_because.empty()) lost_because = step.reason;
      if (item->complete())
        item->warnings.push_back(item->frame.image_left + ": odometry lost (" + step.reason +
                                 "), its pose is guessed");
    }
    return item;
  }

  std::optional<Item> Find(std::optional<Item> item) {
    if (!item) return item;
    Frame& frame = item->frame;
    if (item->complete()) {
      Naming(frame, [&] { frame.detections = finder->Find(frame.index, item->view(), found); });
      if (finder->lifts() && frame.index % kGroundEvery == 0) {
        const ScopedTimer timer(found.timing, "ground check");
        CheckGround(item->view(), sequence.camera, frame.detections, options.lift.ground,
                    found.ground);
      }
      for (Detection& detection : frame.detections) detection.row = rows++;
      found.detections += static_cast<int>(frame.detections.size());
      if (hooks.watch) hooks.watch(frame, item->left.view());
    }
    item->left = item->right = {};
    return item;
  }

  // Moves the stages so far to a thread of their own.
  void InBackground() {
    running.push_back(std::make_unique<Background<Item>>(std::move(stages), kAhead));
    stages = [stage = running.back().get()] { return stage->Next(); };
  }
};

ImageFrontend::ImageFrontend(ImageSequence sequence, const VisionOptions& options,
                             const ColourOptions& colour, FrontendHooks hooks, int threads)
    : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  if (std::none_of(sequence.frames.begin(), sequence.frames.end(), [](const Frame& frame) {
        return !frame.image_left.empty() && !frame.image_right.empty();
      }))
    throw Error(ErrorKind::kBadInput,
                "no frame has a left and a right image of one name (left/000000.png, "
                "right/000000.png; image_2, image_3; "
                "grey: image_0, image_1)");
  m.sequence = std::move(sequence);
  m.options = options;
  if (m.sequence.detections && !options.classes.empty())
    m.options.lift.classes = LoadClasses(options.classes);
  m.hooks = std::move(hooks);
  if (m.sequence.odometry) m.odometry.emplace(m.sequence.camera, options.odometry);
  if (m.sequence.detections)
    m.finder.emplace(m.sequence.camera, m.options, colour, std::move(m.sequence.boxes));

  const bool parallel = threads > 1;
  m.stages = [&m] { return m.Load(); };
  if (parallel) m.InBackground();
  if (m.odometry) {
    m.stages = [&m, before = std::move(m.stages)] { return m.Track(before()); };
    if (parallel) m.InBackground();
  }
  if (m.finder) {
    m.stages = [&m, before = std::move(m.stages)] { return m.Find(before()); };
    if (parallel) m.InBackground();
  }
}

ImageFrontend::ImageFrontend(ImageFrontend&&) noexcept = default;

ImageFrontend::~ImageFrontend() = default;

std::optional<Frame> ImageFrontend::Next() {
  if (!impl_->stages) return std::nullopt;
  std::optional<Impl::Item> item = impl_->stages();
  if (!item) {
    impl_->stages = {};
    if (impl_->odometry && impl_->loaded.frames > 1 && impl_->followed == 0)
      throw Error(ErrorKind::kNoSolution, "no odometry: not one of " +
                                              std::to_string(impl_->loaded.frames) +
                                              " frames could be followed: " + impl_->lost_because);
    return std::nullopt;
  }
  for (const std::string& warning : item->warnings) Log(LogLevel::kWarning, warning);
  return std::move(item->frame);
}

void ImageFrontend::AddLabels(LabelTable& labels) const {
  if (!impl_->finder || !impl_->finder->lifts()) return;
  for (const auto& [label, prior] : impl_->options.lift.classes)
    if (labels[label].symmetry == Symmetry::kNone) labels.Set(label, {Symmetry::kPi});
}

FrontendReport ImageFrontend::Finish() {
  impl_->Stop();
  FrontendReport report = impl_->found;
  report.frames = impl_->loaded.frames;
  report.images_failed = impl_->loaded.images_failed;
  report.lost = impl_->tracked.lost;
  report.timing.Append(impl_->loaded.timing);
  report.timing.Append(impl_->tracked.timing);
  return report;
}

}  // namespace sslcd
