// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/store/map_session.h"

#include <algorithm>
#include <deque>
#include <numeric>

#include "core/sha256.h"
#include "core/utc_time.h"
#include "sslcd/core/error.h"
#include "sslcd/core/log.h"
#include "store/frame_bytes.h"
#include "store/new_session.h"
#include "store/site.h"
#include "store/view_answers.h"
#include "store/writable_map.h"

namespace sslcd {
namespace {

// Smallest number of frames that are stored together. Storing waits for the disk.
constexpr int kFramesPerBatch = 10;
// New results are stored for readers after this many new frames, if they are a tenth of the map.
constexpr int kFramesPerResult = 200;

}  // namespace

struct SSLCD_HIDDEN MapSession::Impl {
  Impl(const std::string& path, Database::Access access) : map(path, access) {}

  void AddLabels(const LabelTable& labels);
  void Start(SessionInfo session);
  bool Knows(const MapperContext& context) const;
  void UseHost(const MapperContext& context);
  void MakeMapper(const MapperContext& context);
  void Replay();
  void RepeatInput(const StoredInput& input);
  void LearnLabels(const Frame& frame);
  void Append(InputKind kind, std::string content);
  void Store(bool with_results);
  int FramesOfMap() const;
  SessionInfo& session() { return map.info.sessions.back(); }
  const SessionInfo& session() const { return map.info.sessions.back(); }

  WritableMap map;
  ViewAligner aligner;  // of the host
  bool without_boxes = false, has_aligner = false;
  std::shared_ptr<ViewAnswers> views = std::make_shared<ViewAnswers>();
  Options options;
  std::optional<Mapper> mapper;
  FilterReport filter;
  std::vector<std::string> stored_hashes;  // of the frames of this session that were stored before
  std::vector<int> stored_numbers;
  // not stored yet
  std::vector<StoredInput> waiting;
  LabelTable new_labels;
  PerCue<int> new_lengths;
  int stored_frames = 0, frames_of_results = 0;
};

MapSession::MapSession(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MapSession::~MapSession() = default;
MapSession::MapSession(MapSession&&) noexcept = default;
MapSession& MapSession::operator=(MapSession&&) noexcept = default;

const SessionInfo& MapSession::info() const { return impl_->session(); }
const Options& MapSession::options() const { return impl_->options; }
int MapSession::stored_frames() const { return impl_->stored_frames; }
FilterReport MapSession::filter() const { return impl_->filter; }
Mapper& MapSession::mapper() { return *impl_->mapper; }

void MapSession::Impl::UseHost(const MapperContext& context) {
  const std::string& path = map.database.path();
  if (context.place_matcher)
    throw Error(ErrorKind::kUsage, path +
                                       ": a map in a file cannot be made with a place matcher "
                                       "of the host, whose answers are not stored");
  without_boxes =
      context.camera && (!map.info.camera || !IsSame(*context.camera, *map.info.camera));
  if (without_boxes)
    Log(LogLevel::kWarning, path +
                                ": this drive has another camera than the first one of the map: "
                                "its detections are associated without their 2D boxes");
  aligner = context.view_aligner;
}

void MapSession::Impl::MakeMapper(const MapperContext& context) {
  UseHost(context);
  MapperContext own;
  own.gravity = GravityFrame::FromUp(map.info.up_axis);
  own.labels = map.info.labels;
  own.camera = map.info.camera;
  has_aligner = has_aligner || aligner || map.has_views;
  if (has_aligner)
    own.view_aligner = [answers = views](const std::vector<ViewPair>& pairs) {
      return answers->Answer(pairs);
    };
  options = OptionsOf(map.info, map.database.path());
  mapper.emplace(options, own);
}

// Whether the mapper is the one that this context would make.
bool MapSession::Impl::Knows(const MapperContext& context) const {
  if (context.view_aligner && !has_aligner) return false;
  for (const auto& [name, label] : context.labels.entries())
    if (map.info.labels[name].symmetry != label.symmetry) return false;
  return true;
}

void MapSession::Impl::RepeatInput(const StoredInput& input) {
  const auto session = std::find_if(map.info.sessions.begin(), map.info.sessions.end(),
                                    [&](const SessionInfo& s) { return s.id == input.session; });
  switch (input.kind) {
    case InputKind::kSequence: mapper->StartSequence(); return;
    case InputKind::kRefinement: {
      const RefinementInput refinement = RefinementOf(input.content);
      views->Repeat(refinement.views);
      mapper->Refine(refinement.when);
      return;
    }
    case InputKind::kFrame: break;
  }
  Frame frame = FrameIn(input, map.database.path());
  if (!session->ended) {
    stored_numbers.push_back(frame.index);
    stored_hashes.push_back(Sha256().Add(input.content).Finish());
  }
  frame.index = NumberInMap(frame.index, *session, map.database.path());
  const FrameReport report = mapper->AddFrame(frame);
  if (!session->ended) filter += report.filter;
}

void MapSession::Impl::Replay() {
  ReadInputs(map.database, map.info.sessions,
             [&](const StoredInput& input) { RepeatInput(input); });
  mapper->TakeChanges();
}

void MapSession::Impl::AddLabels(const LabelTable& labels) {
  for (const auto& [name, label] : labels.entries()) {
    map.info.labels.Set(name, label);
    new_labels.Set(name, label);
  }
}

// After the mapper has all earlier sessions.
void MapSession::Impl::Start(SessionInfo session) {
  frames_of_results = FramesOfMap();
  map.info.sessions.push_back(std::move(session));
  views->AskHost(aligner, this->session().frame_offset);
  mapper->StartSequence();
  Append(InputKind::kSequence, "");
  Store(false);
}

MapSession MapSession::Begin(const std::string& path, const SessionRequest& request,
                             const MapperContext& context, const std::optional<Options>& options) {
  CheckSessionName(request.name);
  auto impl = std::make_unique<Impl>(path, Database::Access::kCreate);
  MapInfo& info = impl->map.info;
  if (info.sessions.empty()) {
    info.up_axis = context.gravity.up;
    info.camera = context.camera;
    info.config = ConfigText(options.value_or(Options()));
    info.created = UtcTime();
  } else {
    CheckBelongs(info, path, context, options);
  }
  SessionInfo session = NewSession(info, path, request);
  impl->AddLabels(context.labels);
  impl->MakeMapper(context);
  impl->Replay();
  impl->Start(std::move(session));
  return MapSession(std::move(impl));
}

void MapSession::BeginNext(const SessionRequest& request, const MapperContext& context) {
  Impl& m = *impl_;
  const std::string& path = m.map.database.path();
  if (!m.session().ended) End();
  CheckBelongs(m.map.info, path, context, std::nullopt);
  SessionInfo session = NewSession(m.map.info, path, request);
  const bool is_known = m.Knows(context);
  m.AddLabels(context.labels);
  m.filter = {};
  m.stored_hashes.clear();
  m.stored_numbers.clear();
  m.stored_frames = 0;
  if (is_known) {
    m.UseHost(context);
    m.mapper->TakeChanges();
  } else {
    m.MakeMapper(context);
    m.Replay();
  }
  m.Start(std::move(session));
}

MapSession MapSession::Resume(const std::string& path, const MapperContext& context) {
  auto impl = std::make_unique<Impl>(path, Database::Access::kWrite);
  MapInfo& info = impl->map.info;
  if (info.sessions.empty() || info.sessions.back().ended)
    throw Error(ErrorKind::kUsage, path + ": has no session to go on with: all have been ended");
  CheckBelongs(info, path, context, std::nullopt);
  impl->MakeMapper(context);
  impl->Replay();
  impl->stored_frames = impl->session().frames;
  impl->frames_of_results = impl->FramesOfMap();
  impl->views->AskHost(impl->aligner, impl->session().frame_offset);
  return MapSession(std::move(impl));
}

bool MapSession::IsStored(const Frame& frame) const {
  const Impl& m = *impl_;
  const auto at = std::lower_bound(m.stored_numbers.begin(), m.stored_numbers.end(), frame.index);
  if (at == m.stored_numbers.end()) return false;
  Frame stored = frame;
  if (m.without_boxes)
    for (Detection& detection : stored.detections) detection.box.reset();
  const auto place = static_cast<std::size_t>(at - m.stored_numbers.begin());
  if (*at == frame.index && Sha256().Add(FrameBytes(stored)).Finish() == m.stored_hashes[place])
    return true;
  throw Error(ErrorKind::kBadInput,
              m.map.database.path() + ": frame " + std::to_string(frame.index) +
                  " is not the one that session '" + m.session().name +
                  "' was begun with: the drive has changed, or is another one. Restore it, or end "
                  "the session as it is (`sslcd_run map end`)");
}

void MapSession::Impl::LearnLabels(const Frame& frame) {
  for (const Detection& detection : frame.detections) {
    if (map.info.labels.entries().count(detection.label) == 0) {
      map.info.labels.Set(detection.label, {});
      new_labels.Set(detection.label, {});
    }
    for (const CueRow& row : kCueRows) {
      const int length = static_cast<int>(detection.appearance[row.cue].size());
      if (length > 0 && map.info.vector_length[row.cue] == 0)
        map.info.vector_length[row.cue] = new_lengths[row.cue] = length;
    }
  }
}

void MapSession::Impl::Append(InputKind kind, std::string content) {
  SessionInfo& now = session();
  now.checksum = NextChecksum(now.checksum, kind, content);
  ++now.inputs;
  waiting.push_back({now.id, kind, std::move(content)});
}

FrameReport MapSession::AddFrame(const Frame& given) {
  Impl& m = *impl_;
  Frame frame = given;
  const int number = NumberInMap(frame.index, m.session(), m.map.database.path());
  if (m.without_boxes)
    for (Detection& detection : frame.detections) detection.box.reset();
  CheckVectorLengths(m.map.info, m.map.database.path(), frame);
  std::string content = FrameBytes(frame);
  frame.index = number;
  FrameReport report = m.mapper->AddFrame(frame);
  m.filter += report.filter;
  m.LearnLabels(frame);
  m.Append(InputKind::kFrame, std::move(content));
  ++m.session().frames;
  m.session().last_frame = frame.index;
  if (report.keyframe && m.session().frames - m.stored_frames >= kFramesPerBatch) {
    const int grown = m.FramesOfMap() - m.frames_of_results;
    m.Store(grown >= kFramesPerResult && 10 * grown >= m.frames_of_results);
  }
  return report;
}

void MapSession::StartSequence() {
  impl_->mapper->StartSequence();
  impl_->Append(InputKind::kSequence, "");
}

BaSummary MapSession::Refine(Refinement when) {
  BaSummary summary = impl_->mapper->Refine(when);
  impl_->Append(InputKind::kRefinement, RefinementBytes({when, impl_->views->TakeRecord()}));
  return summary;
}

int MapSession::Impl::FramesOfMap() const {
  return std::accumulate(map.info.sessions.begin(), map.info.sessions.end(), 0,
                         [](int sum, const SessionInfo& one) { return sum + one.frames; });
}

// What waits stays if that fails.
void MapSession::Impl::Store(bool with_results) {
  StoreBatch(map,
             {&waiting, &session(), new_labels, new_lengths, with_results ? &*mapper : nullptr});
  waiting.clear();
  new_labels = {};
  new_lengths = {};
  stored_frames = session().frames;
  if (with_results) frames_of_results = FramesOfMap();
  Log(LogLevel::kDebug, "stored: " + std::to_string(stored_frames) + " frames");
}

void MapSession::Save() { impl_->Store(true); }

void MapSession::End() {
  impl_->session().ended = true;
  try {
    impl_->Store(true);
  } catch (...) {
    impl_->session().ended = false;
    throw;
  }
}

}  // namespace sslcd
